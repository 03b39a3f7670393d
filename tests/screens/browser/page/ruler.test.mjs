import assert from "node:assert/strict";
import { test } from "node:test";
import { bounds, extended, levels, linesOf, placeOf, runs, Scale, shownGaps, ticks, told, valueAt, newestOf } from "../../../../tftool/screens/browser/page/ruler.js";

test("ticks are round, inside the span, and far enough apart", () => {
  for (const [oldest, newest, width] of [[0, 30, 600], [12.34, 12.9, 500], [-3, 700, 900], [0, 90_000, 400], [0, 1e-3, 300]]) {
    const found = ticks({ oldest, newest }, width);
    const apart = found.slice(1).map(({ at }, place) => ((at - found[place].at) / (newest - oldest)) * width);

    assert.ok(found.length > 1, `${oldest} to ${newest}: ${found.length}`);
    assert.ok(found.every(({ at }) => at >= oldest - 1e-9 && at <= newest + 1e-9));
    assert.ok(apart.every((pixels) => pixels >= 69.9), String(apart));
    assert.equal(new Set(found.map(({ text }) => text)).size, found.length);
  }
  assert.deepEqual(ticks({ oldest: 5, newest: 5 }, 500), []);
});

test("a tick says seconds, minutes and hours", () => {
  assert.deepEqual([told(5), told(0.25, 0.05), told(90), told(3661), told(-2)], ["5 s", "0.25 s", "1:30", "1:01:01", "−2 s"]);
});

test("a pixel's moment is the moment's pixel, and stays in the span", () => {
  const scale = new Scale({ oldest: 10, newest: 20 }, 8, 108);

  assert.equal(scale.pixel(15), 58);
  assert.equal(scale.moment(58), 15);
  assert.equal(scale.moment(-50), 10);
  assert.equal(scale.moment(500), 20);
});

test("gaps that meet are one, of the chain's frames alone, cut at the span", () => {
  const gaps = [["a", 1, 3], ["b", 2, 4], ["c", 5, 9], ["a", 20, 30]];

  assert.deepEqual(shownGaps(gaps, new Set(), { oldest: 0, newest: 7 }), [
    { from: 1, to: 4, frames: ["a", "b"] },
    { from: 5, to: 7, frames: ["c"] },
  ]);
  assert.deepEqual(shownGaps(gaps, new Set(["b"]), { oldest: 0, newest: 7 }), [{ from: 2, to: 4, frames: ["b"] }]);
});

const SERIES = { x: [3, null, 0], y: [4, null, 0], z: [0, null, 2], roll: [Math.PI, null, 0], pitch: [0, null, 0], yaw: [0, null, 1] };

test("lines are metres and degrees, and nothing where there is nothing", () => {
  assert.deepEqual(linesOf(SERIES, "distance"), [{ name: "distance", values: [5, null, 2] }]);
  assert.deepEqual(linesOf(SERIES, "rpy")[0], { name: "roll", values: [180, null, 0] });
  assert.deepEqual(linesOf(SERIES, "xyz").map(({ name }) => name), ["x", "y", "z"]);
});

test("limits hold every value, and are never of no height", () => {
  const [least, most] = bounds([{ values: [null, 3, 3] }]);
  assert.ok(least < 3 && most > 3);
  assert.deepEqual(bounds([{ values: [null] }]), [-1, 1]);
});

test("a level fits beside the plot", () => {
  for (const limits of [[0, 2e9], [1e9 - 1, 1e9 + 1], [-123456, 0], [-0.002, 0.002]]) {
    const found = levels(limits, 60);
    assert.ok(found.length > 0);
    assert.ok(found.every(({ text }) => text.length <= 7), JSON.stringify(found));
  }
});

test("noise below a thousandth does not fill the plot", () => {
  const [least, most] = bounds([{ values: [0, 3e-6, -1e-7] }]);
  assert.ok(most - least >= 0.002 - 1e-12);
  assert.ok(levels([least, most], 60).every(({ text }) => !text.includes("e")));
});

test("a line is cut where nothing is, and where an angle leaps round", () => {
  assert.deepEqual(runs([1, null, 2, 3], false), [[[0, 1]], [[2, 2], [3, 3]]]);
  assert.equal(runs([179, -179], true).length, 2);
  assert.equal(runs([179, -179], false).length, 1);
});

test("between two values lies the straight way; beside nothing, the nearer one", () => {
  assert.equal(valueAt([0, 10, null], 0.25, false), 2.5);
  assert.equal(valueAt([0, 10, null], 1.2, false), 10);
  assert.equal(valueAt([0, 10, null], 1.8, false), null);
  assert.equal(valueAt([179, -179], 0.25, true), 179);
});

test("the newest value of a line is the last one that is known", () => {
  assert.equal(newestOf([1, 2, null, null]), 2);
  assert.equal(newestOf([null]), null);
  assert.equal(newestOf([]), null);
});

test("levels are round and have room between them", () => {
  assert.deepEqual(levels([-1.2, 2.3], 80).map(({ text }) => text), ["-1", "0", "1", "2"]);
  assert.deepEqual(levels([0.01, 0.06], 60).map(({ text }) => text), ["0.02", "0.04", "0.06"]);
});

test("poses that came since go on where the series is no longer known", () => {
  const none = [null, null, null];
  const series = { times: [1, 2, 3], x: [5, 6, null], y: [0, 0, null], z: none, roll: none, pitch: none, yaw: none };
  const pose = (moment, x) => ({ moment, x, y: 0, z: 0, roll: 0, pitch: 0, yaw: 0 });
  const { times, x } = extended(series, [pose(1.5, 9), pose(2.5, 7)]);

  assert.deepEqual([times, x], [[1, 2, 2.5], [5, 6, 7]]);
  assert.equal(placeOf(times, 2.25), 1.5);
  assert.equal(placeOf(times, 9), null);
});
