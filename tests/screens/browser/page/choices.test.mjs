import assert from "node:assert/strict";
import { test } from "node:test";
import { Choices } from "../../../../tftool/screens/browser/page/choices.js";
import { Model } from "../../../../tftool/screens/browser/page/model.js";
import { read, write } from "../../../../tftool/screens/browser/page/share.js";

test("what makes no sense in the address is left at its default, or brought inside its limits", () => {
  const choices = new Choices(read("#view=inside&theme=pink&timeout=-3&speed=7&interval=x&length=1e9&names=0"), "light");

  assert.equal(choices.view, "top");
  assert.equal(choices.theme, "light");
  assert.equal(choices.timeout, 1);
  assert.equal(choices.speed, 1);
  assert.equal(choices.interval, 0);
  assert.equal(choices.length, 60);
  assert.equal(choices.names, false);
});

test("the address carries every choice there and back", () => {
  const choices = new Choices({}, "dark");
  Object.assign(choices, { view: "orbit", grid: false, speed: 0.25, scale: 2, chosen: "a&b=c#d" });
  Object.assign(choices.byHand, { view: true, trails: true });
  choices.setFixed("map");
  choices.setPair("base_link", "laser <x>");
  choices.setNumber("timeout", 7);
  choices.setFilter("only", "^(a|b)+$");
  choices.mark("hidden", "one", true);
  choices.mark("hidden", "two, three", true);
  choices.mark("closed", "map", true);
  choices.mark("trailed", "turtle1", true);
  const camera = [1, 2, 3, 4, 5, 6, 1.5];

  const given = read(write(choices.shared(12.25, camera)));
  assert.equal(given.at, 12.25);
  assert.deepEqual(given.camera, camera);
  assert.deepEqual(new Choices(given), choices);
});

test("what was not chosen by hand is not in the address", () => {
  const choices = new Choices({}, "dark");
  choices.setPair("map", "laser", false);
  Object.assign(choices, { view: "orbit", trails: true });
  const given = read(write(choices.shared(null, undefined)));
  assert.deepEqual([given.target, given.source, given.view, given.trails], [undefined, undefined, undefined, undefined]);
  choices.setPair(undefined, undefined);
  assert.equal(read(write(choices.shared(null, undefined))).pair, "none");
});

test("a wrong filter says what is wrong, and the last right one stays in force", () => {
  const choices = new Choices();
  assert.equal(choices.setFilter("not", "^o|w"), "");
  assert.match(choices.setFilter("not", "("), /regular expression/);

  assert.ok(choices.leavesOut("other"));
  assert.ok(!choices.leavesOut("turtle"));
  assert.equal(choices.setFilter("not", ""), "");
  assert.ok(!choices.leavesOut("other"));
});

test("a number outside its limits is brought inside, and one that is none changes nothing", () => {
  const choices = new Choices();
  choices.setNumber("length", 600);
  choices.setNumber("timeout", Number.NaN);

  assert.equal(choices.length, 60);
  assert.equal(choices.timeout, 15);
});

/** A model with these roots, of which the first has a child. */
function rooted(...roots) {
  const model = new Model();
  const names = [...roots, "child"];
  const none = names.map(() => false);
  const parents = [...roots.map(() => -1), 0];
  model.setNames({ epoch: 1, revision: 1, rate: 1, total: names.length, names, parents, statics: none, authorities: names });
  return model;
}

test("a root stands in for a fixed frame that does not exist, until that one comes back", () => {
  const choices = new Choices();
  choices.setFixed("world");
  const told = [rooted("world"), rooted("map"), rooted("map", "world"), rooted("odom")].map((model) => [
    choices.settleFixed(model), choices.fixed, choices.missed, read(write(choices.shared(null, undefined))).fixed,
  ]);

  assert.deepEqual(told, [
    [false, "world", undefined, "world"],
    [true, "map", "world", "world"],
    [true, "world", undefined, "world"],
    [true, "odom", "world", "world"],
  ]);
});

test("where no fixed frame was chosen, the one in force stays while it exists, and is not missed after", () => {
  const choices = new Choices();
  const told = [rooted("world"), rooted("map", "world"), rooted("map")].map((model) => [
    choices.settleFixed(model), choices.fixed, choices.missed,
  ]);

  assert.deepEqual(told, [[true, "world", undefined], [false, "world", undefined], [true, "map", undefined]]);
});
