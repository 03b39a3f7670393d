import assert from "node:assert/strict";
import { test } from "node:test";
import { Bounds, distanceFor, spread, together } from "../../../../tftool/screens/browser/page/bounds.js";

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

test("a frame in another country is not looked at together with a robot", () => {
  const robot = [[0, 0, 0], [1, 0, 0], [1, 2, 0], [1, 2, 0.5, 0, 0, 0, 1]];
  const utm = [-500_000, 4_000_000, 0];
  assert.deepEqual(together([...robot, utm]), robot);
  assert.equal(new Bounds().grow([utm, ...robot]).high[1], 2);

  // Where it drove to, and where two are all there is, is looked at as a whole.
  const driven = [...robot, [800, -300, 0]];
  assert.deepEqual(together(driven), driven);
  assert.deepEqual(together([robot[0], utm]), [robot[0], utm]);
});

const STRAIGHT = { right: [1, 0, 0], upward: [0, 1, 0], away: [0, 0, 1] };

test("a camera is as near as it can be with all of a box in the picture", () => {
  const flat = { low: [-2, -1, 0], high: [2, 1, 0] };
  assert.equal(distanceFor(flat, STRAIGHT, { x: 0.5, y: 0.5 }), 4);
  assert.equal(distanceFor(flat, STRAIGHT, { x: 0.5, y: 0.2 }), 5);
  // What is nearer to the camera looks larger.
  assert.equal(distanceFor({ low: [8, -1, 4], high: [12, 1, 10] }, STRAIGHT, { x: 0.5, y: 0.5 }), 7);
});
