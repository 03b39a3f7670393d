// @ts-check
// Bounding box of everything drawn, for a camera that keeps it in view.

/** @typedef {{ low: number[], high: number[] }} Box corners, metres */

const LEAST = 0.5; // metres; a single frame has no size
const MARGIN = 0.1; // of the largest side
const MOST = 0.6; // share of the points that must be in the picture
const FAR = 2000; // points farther than this many times their distance are left out

/**
 * Length of a box's longest side, metres.
 * @param {Box} box
 */
export function spread(box) {
  return Math.max(...box.high.map((value, side) => value - box.low[side]), LEAST);
}

/**
 * @param {number[][]} points
 * @returns {Box}
 */
export function boxOf(points) {
  const box = { low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] };
  for (const point of points) {
    for (let side = 0; side < 3; side++) {
      box.low[side] = Math.min(box.low[side], point[side]);
      box.high[side] = Math.max(box.high[side], point[side]);
    }
  }
  return box;
}

/**
 * Distance from the middle of a box at which a perspective camera sees all of it.
 * @param {{ low: number[], high: number[] }} box
 * @param {{ right: number[], upward: number[], away: number[] }} seen directions of the picture's sides and of the camera
 * @param {{ x: number, y: number }} slope metres seen to each side, at a distance of one metre
 */
export function distanceFor({ low, high }, { right, upward, away }, slope) {
  const middle = low.map((value, side) => (value + high[side]) / 2);
  let distance = 0;
  for (let corner = 0; corner < 8; corner++) {
    const place = middle.map((value, side) => ((corner >> side) & 1 ? high : low)[side] - value);
    const along = (way) => way.reduce((sum, value, side) => sum + value * place[side], 0);
    distance = Math.max(distance, along(away) + Math.max(Math.abs(along(right)) / slope.x, Math.abs(along(upward)) / slope.y));
  }
  return distance;
}

/**
 * Points that fit into one picture: if most points are close together, a point thousands of times
 * as far away (as utm from a robot) would shrink them to nothing.
 * @param {number[][]} points places; numbers after the first three are ignored
 */
export function together(points) {
  if (spread(boxOf(points)) < FAR * LEAST) return points;
  const middle = [0, 1, 2].map((side) => points.map((point) => point[side]).sort((a, b) => a - b)[(points.length - 1) >> 1]);
  const away = points.map((point) => Math.hypot(...middle.map((value, side) => point[side] - value)));
  const most = [...away].sort((a, b) => a - b)[Math.ceil(MOST * points.length) - 1];
  return points.filter((_, place) => away[place] <= FAR * Math.max(most, LEAST));
}

export class Bounds {
  constructor() {
    /** @type {Box | null} */
    this.box = null;
  }

  reset() {
    this.box = null;
  }

  /**
   * Grow the box to contain points; return it if one was outside, else null.
   * @param {number[][]} points
   */
  grow(points) {
    if (!points.length) return null;
    const now = boxOf(together(points));
    const { box } = this;
    if (box && now.low.every((value, side) => value >= box.low[side]) && now.high.every((value, side) => value <= box.high[side])) {
      return null;
    }
    // A margin, so that the camera does not move with every step.
    const margin = MARGIN * spread(now);
    const old = box ?? now;
    this.box = {
      low: now.low.map((value, side) => (value < old.low[side] ? value - margin : old.low[side])),
      high: now.high.map((value, side) => (value > old.high[side] ? value + margin : old.high[side])),
    };
    return this.box;
  }
}
