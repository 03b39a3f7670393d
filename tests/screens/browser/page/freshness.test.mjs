import assert from "node:assert/strict";
import { test } from "node:test";
import { freshness, Hearing } from "../../../../tftool/screens/browser/page/freshness.js";
import { Model } from "../../../../tftool/screens/browser/page/model.js";

/** A server that was heard so many times, so many milliseconds apart. */
function heard(times, apart) {
  const hearing = new Hearing();
  hearing.begin(100_000);
  for (let time = 1; time <= times; time++) hearing.heard(100_000 + time * apart);
  return hearing;
}

test("a server that stops to speak is silent after some seconds", () => {
  const hearing = heard(100, 33);
  assert.equal(hearing.isOver(hearing.at + 4_900), false);
  assert.equal(hearing.isOver(hearing.at + 5_100), true);
});

test("one that speaks seldom is waited for longer", () => {
  const hearing = heard(5, 10_000);
  // In the past there is a word at each tenth picture alone.
  assert.equal(hearing.isOver(hearing.at + 100_000), false);
  assert.equal(hearing.isOver(hearing.at + 400_000), true);
});

test("how long it was silent does not make its next silence a longer one", () => {
  const hearing = heard(100, 33);
  hearing.heard(hearing.at + 60_000);
  assert.equal(hearing.isOver(hearing.at + 5_100), true);
});

test("a pause is forgotten when it speaks often again", () => {
  const hearing = heard(3, 4_000);
  for (let time = 0; time < 1_000; time++) hearing.heard(hearing.at + 33);
  assert.equal(hearing.isOver(hearing.at + 5_100), true);
});

test("a server that is silent is told before all that it said", () => {
  const model = new Model();
  assert.equal(freshness("silent", model, false), "silent");
  assert.equal(freshness("silent", model, true), "silent");
  assert.equal(freshness("ended", model, true), "gone");
  assert.equal(freshness("open", model, true), "past");
  assert.equal(freshness("open", model, false), "live");
});
