import assert from "node:assert/strict";
import { test } from "node:test";
import { Past } from "../../../../tftool/screens/browser/page/past.js";

const NEWEST = 600;

/** A past, and what it asked for; `answer` gives every frame x = moment at all of what was asked. */
function past() {
  const asked = [];
  const one = new Past((asking) => asked.push(asking));
  const answer = () => {
    for (const { fixed, frames, from, to, count } of asked.splice(0)) {
      const row = Array.from({ length: count }, (_, at) => [from + ((to - from) * at) / (count - 1), 0, 0]);
      one.take({ fixed, from, to, places: Object.fromEntries(frames.map((name) => [name, row])) });
    }
  };
  return { one, asked, answer };
}

test("pieces around the moment and the next one are asked for, once", () => {
  const { one, asked } = past();
  for (let time = 0; time < 3; time++) one.look("map", ["a", "b"], 12, 22, NEWEST, 1);

  assert.deepEqual(asked.map(({ from, to }) => [from, to]), [[10, 15], [15, 20], [20, 25], [25, 30]]);
  assert.deepEqual(asked[0].frames, ["a", "b"]);
  assert.equal(asked[0].count, 151);
});

test("a trail is made of places within its span", () => {
  const { one, answer } = past();
  one.look("map", ["a"], 12, 22, NEWEST, 1);
  assert.deepEqual(one.trail("a", 12, 22), []);
  answer();
  const trail = one.trail("a", 12, 22);

  assert.equal(trail.length, 301);
  assert.ok(trail.every(([x], at) => Math.abs(x - (12 + at / 30)) < 1e-9));
  assert.deepEqual(one.trail("b", 12, 22), []);
});

test("a trail reaches back to the piece that has not come", () => {
  const { one } = past();
  one.look("map", ["a"], 0, 14, 14, 1);
  const row = (x) => ({ a: [[x, 0, 0], [x + 1, 0, 0], [x + 2, 0, 0]] });
  one.take({ fixed: "map", from: 0, to: 5, places: row(0) });
  one.take({ fixed: "map", from: 10, to: 15, places: row(10) });
  assert.deepEqual(one.trail("a", 0, 14), [[10, 0, 0], [11, 0, 0]]);

  one.take({ fixed: "map", from: 5, to: 10, places: row(5) });
  assert.deepEqual(one.trail("a", 0, 14).map(([x]) => x), [0, 1, 5, 6, 10, 11]);
});

test("what is not known is left out", () => {
  const { one } = past();
  one.look("map", ["a"], 0, 4, 4, 1);
  one.take({ fixed: "map", from: 0, to: 5, places: { a: [[0, 0, 0], null, [2, 0, 0], null, [4, 0, 0], null] } });

  assert.deepEqual(one.trail("a", 0, 4), [[0, 0, 0], [2, 0, 0], [4, 0, 0]]);
});

test("another frame is asked for by itself, another fixed frame with all", () => {
  const { one, asked, answer } = past();
  one.look("map", ["a"], 10, 14, 14, 1);
  answer();
  one.look("map", ["a", "b"], 10, 14, 14, 1);
  assert.deepEqual(asked.map(({ frames }) => frames), [["b"]]);
  answer();
  one.look("odom", ["a", "b"], 10, 14, 14, 1);
  assert.deepEqual(asked.map(({ fixed, frames }) => [fixed, frames]), [["odom", ["a", "b"]]]);
});

test("an answer about another fixed frame is dropped", () => {
  const { one } = past();
  one.look("map", ["a"], 10, 14, 14, 1);
  one.take({ fixed: "odom", from: 10, to: 15, places: { a: [[0, 0, 0], [0, 0, 0]] } });

  assert.deepEqual(one.trail("a", 10, 14), []);
});

test("a piece that was not over is asked for again when there is more, and shown until then", () => {
  const { one, asked, answer } = past();
  one.look("map", ["a"], 10, 12, 12, 1);
  answer();
  one.look("map", ["a"], 10, 12.2, 12.3, 1);
  assert.equal(asked.length, 0);
  one.look("map", ["a"], 10, 14, 14, 1);
  assert.equal(asked.length, 1);
  assert.notDeepEqual(one.trail("a", 10, 12), []);
});

test("what was asked for when the connection ended is asked for again", () => {
  const { one, asked, answer } = past();
  one.look("map", ["a"], 10, 14, 14, 1);
  answer();
  one.look("map", ["a", "b"], 10, 14, 14, 1);
  asked.length = 0;
  one.lost();
  one.look("map", ["a", "b"], 10, 14, 14, 1);

  assert.deepEqual(asked.map(({ frames }) => frames), [["b"]]);
});

test("long names and many frames go in several requests, and old pieces are dropped", () => {
  const { one, asked } = past();
  one.look("map", Array.from({ length: 130 }, (_, at) => `f${at}`), 0, 4, 4, 1);
  assert.deepEqual(asked.map(({ frames }) => frames.length), [60, 60, 10]);
  asked.length = 0;
  one.look("map", ["x".repeat(3000), "y".repeat(3000)], 5, 9, 9, 1);
  assert.equal(asked.length, 2);
  for (let moment = 10; moment < 1000; moment += 5) one.look("map", ["a"], moment, moment + 4, 2000, 1);
  assert.ok(one.pieces.size <= 60);
});

test("pieces are as long as five seconds of a page, however fast the session runs", () => {
  const { one, asked } = past();
  one.look("map", ["a"], 100, 190, NEWEST, 10);

  assert.deepEqual(asked.map(({ from, to }) => [from, to]), [[100, 150], [150, 200], [200, 250]]);
});

test("a long span comes in longer pieces, few enough to be kept", () => {
  const { one, asked } = past();
  one.look("map", ["a"], 0, 522, 522, 1);

  assert.ok(asked.length <= 48);
  assert.equal(asked[0].from, 0);
  assert.ok(asked[asked.length - 1].to >= 522);
});
