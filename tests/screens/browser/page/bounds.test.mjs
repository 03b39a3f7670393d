import assert from "node:assert/strict";
import { test } from "node:test";
import { Bounds, distanceFor, spread } from "../../../../tftool/screens/browser/page/bounds.js";

test("the box holds every point it ever grew around", () => {
  const bounds = new Bounds();
  const points = [[0, 0, 0], [4, -2, 1], [-3, 5, 0]];
  for (const point of points) bounds.grow([point]);

  for (const point of points) {
    point.forEach((value, side) => assert.ok(bounds.box.low[side] <= value && value <= bounds.box.high[side]));
  }
});

test("only a point outside of the box makes it grow, and then by a margin", () => {
  const bounds = new Bounds();
  bounds.grow([[0, 0, 0], [10, 0, 0]]);
  assert.equal(bounds.grow([[5, 0, 0]]), null);

  const { high } = bounds.grow([[0, 0, 0], [20, 0, 0]]);
  assert.equal(high[0], 22);
});

test("nothing drawn makes no box, and a single frame has a size to look at", () => {
  const bounds = new Bounds();
  assert.equal(bounds.grow([]), null);
  assert.ok(spread(bounds.grow([[1, 1, 1]])) > 0);
});

const STRAIGHT = { right: [1, 0, 0], upward: [0, 1, 0], away: [0, 0, 1] };

test("a camera is as near as it can be with all of a box in the picture", () => {
  const flat = { low: [-2, -1, 0], high: [2, 1, 0] };
  assert.equal(distanceFor(flat, STRAIGHT, { x: 0.5, y: 0.5 }), 4);
  assert.equal(distanceFor(flat, STRAIGHT, { x: 0.5, y: 0.2 }), 5);
  // What is nearer to the camera looks larger.
  assert.equal(distanceFor({ low: [8, -1, 4], high: [12, 1, 10] }, STRAIGHT, { x: 0.5, y: 0.5 }), 7);
});
