import assert from "node:assert/strict";
import { test } from "node:test";
import { arrange } from "../../../../tftool/screens/browser/page/labels.js";
import { Model } from "../../../../tftool/screens/browser/page/model.js";
import { isTurtle, naturalPair, planar, trailsPay } from "../../../../tftool/screens/browser/page/opening.js";
import { cellFor, linesOf, round, spelled } from "../../../../tftool/screens/browser/page/scale.js";

/** A model of links, given as "parent child", with "!" after those that are static. */
function model(...links) {
  const names = [...new Set(links.flatMap((link) => link.replace("!", "").split(" ")))];
  const made = new Model();
  const above = new Map(links.map((link) => link.replace("!", "").split(" ").reverse()));
  const still = new Set(links.filter((link) => link.endsWith("!")).map((link) => link.slice(0, -1).split(" ")[1]));
  made.setNames({
    epoch: 1, revision: 1, rate: 1, total: names.length, names,
    parents: names.map((name) => (above.has(name) ? names.indexOf(above.get(name)) : -1)),
    statics: names.map((name) => still.has(name)),
    authorities: names.map(() => ""),
  });
  return made;
}

test("the pair of the tutorial is what turtle2 follows", () => {
  assert.deepEqual(naturalPair(model("world turtle1", "world turtle2")), { target: "turtle2", source: "turtle1" });
  const carrot = model("world turtle1", "world turtle2", "turtle1 carrot1!");
  assert.deepEqual(naturalPair(carrot), { target: "turtle2", source: "carrot1" });
});

test("elsewhere it is the end of the longest chain that moves, in its root", () => {
  const robot = model("map odom", "odom base", "base laser!", "laser point", "base bumper!", "base arm!", "arm hand!", "hand eye!");
  assert.deepEqual(naturalPair(robot), { target: "map", source: "eye" });
  assert.deepEqual(naturalPair(model("map station!", "world turtle1")), { target: "world", source: "turtle1" });
  assert.deepEqual(naturalPair(model("a b!", "b c!")), { target: "a", source: "c" });
  assert.equal(naturalPair(model()), null);
});

test("turtles in two trees are no pair", () => {
  assert.deepEqual(naturalPair(model("world turtle1", "map turtle2")), { target: "world", source: "turtle1" });
});

test("a world is planar while nothing leaves its plane", () => {
  const yaw = [1, 2, 0, 0, 0, Math.sin(1), Math.cos(1)];
  assert.ok(planar([yaw, null, [5, 5, 0, 0, 0, 0, 1]]));
  assert.ok(planar([]));
  assert.ok(!planar([yaw, [0, 0, 0.2, 0, 0, 0, 1]]));
  assert.ok(!planar([[0, 0, 0, 0.1, 0, 0, Math.sqrt(0.99)]]));
});

test("trails are left by a few, and not by a crowd", () => {
  assert.ok(trailsPay(model("world turtle1")));
  assert.ok(!trailsPay(model("world camera!")));
  assert.ok(!trailsPay(model(...Array.from({ length: 50 }, (_, index) => `world f${index}`))));
});

test("turtles are known by their names", () => {
  assert.deepEqual(["turtle1", "sim/turtle12", "turtle", "turtles1", "my_turtle1x"].map(isTurtle), [true, true, false, false, false]);
});

test("lengths are round and spelled in the unit that suits", () => {
  assert.deepEqual([0.011, 0.2, 0.21, 1, 3, 70].map(round), [0.02, 0.2, 0.5, 1, 5, 100]);
  assert.deepEqual([0.005, 0.2, 1, 50, 2000].map(spelled), ["5 mm", "20 cm", "1 m", "50 m", "2 km"]);
  for (const pixel of [1e-4, 0.003, 0.02, 0.5, 30]) {
    const wide = cellFor(pixel) / pixel;
    assert.ok(wide >= 34 && wide <= 34 * 2.5, `${wide}`);
  }
});

test("a grid reaches equally far to all sides, with its axes in it", () => {
  const lines = linesOf([10, 0], 1, 20, true);
  const xs = lines.flatMap(({ from, to }) => [from[0], to[0]]);
  assert.deepEqual([Math.min(...xs), Math.max(...xs)], [-10, 30]);
  assert.deepEqual(new Set(lines.filter(({ kind }) => kind === "y").flatMap(({ from, to }) => [from[0], to[0]])), new Set([0]));
  assert.ok(lines.every(({ faded }) => faded[0] === 1));
  assert.ok(linesOf([0, 0], 1, 20).every(({ faded }) => Math.min(...faded) < 1));
});

const PICTURE = { width: 400, height: 400 };
const overlap = (one, other) =>
  one.left < other.left + 60 && other.left < one.left + 60 && one.top < other.top + 14 && other.top < one.top + 14;

test("names do not stand on each other, and what moved aside has a line", () => {
  const wanted = Array.from({ length: 8 }, () => ({ x: 200, y: 200, width: 60, height: 14 }));
  const stands = arrange(wanted, PICTURE);
  assert.ok(stands.every((stand) => stand !== null));
  stands.forEach((one, at) => stands.slice(at + 1).forEach((other) => assert.ok(!overlap(one, other))));
  assert.ok(!stands[0].moved);
  assert.ok(stands.at(-1).moved);
});

test("where there is no room a name is left out, but never the one that was picked", () => {
  const wanted = Array.from({ length: 300 }, (_, at) => ({ x: 200, y: 200, width: 60, height: 14, first: at === 299 }));
  const stands = arrange(wanted, PICTURE);
  assert.ok(stands.some((stand) => stand === null));
  assert.ok(stands[299] !== null);
});

test("a name stays where it stood, and off what is reserved", () => {
  const [stand] = arrange([{ x: 200, y: 200, width: 60, height: 14, was: 2 }], PICTURE);
  assert.equal(stand.place, 2);
  const [moved] = arrange([{ x: 200, y: 200, width: 60, height: 14 }], PICTURE, [[170, 205, 60, 20]]);
  assert.notEqual(moved.place, 0);
});

test("a name is inside the picture, at whatever side its frame is", () => {
  for (const [x, y] of [[395, 200], [5, 200], [200, 3], [200, 397], [0, 0], [400, 400]]) {
    const [{ left, top }] = arrange([{ x, y, width: 60, height: 14 }], PICTURE);
    assert.ok(left >= 0 && left + 60 <= 400 && top >= 0 && top + 14 <= 400, `${left} ${top}`);
  }
});
