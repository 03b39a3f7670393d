// @ts-check
// The box around everything that was drawn, for a camera that keeps it in view.

/** @typedef {{ low: number[], high: number[] }} Box corners, metres */

const LEAST = 0.5; // metres; a single frame has no size
const MARGIN = 0.1; // of the largest side
const MOST = 0.6; // of the points are what a picture is of
const FAR = 2000; // times as far as those, and a point is not looked at with them

/**
 * The length of a box's longest side, metres.
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
 * How far from the middle of a box a camera with perspective sees all of it.
 * @param {{ low: number[], high: number[] }} box
 * @param {{ right: number[], upward: number[], away: number[] }} seen where the picture's sides and the camera lie
 * @param {{ x: number, y: number }} slope metres that are seen to a side, at a metre's distance
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
 * Those of a picture's points that can be looked at together: where most lie close by, one that is
 * thousands of times as far, as utm is from a robot, would leave nothing of them to be seen.
 * @param {number[][]} points places, whatever may stand behind their three numbers
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
   * Grow around points; the box if one of them lay outside of it, else null.
   * @param {number[][]} points
   */
  grow(points) {
    if (!points.length) return null;
    const now = boxOf(together(points));
    const { box } = this;
    if (box && now.low.every((value, side) => value >= box.low[side]) && now.high.every((value, side) => value <= box.high[side])) {
      return null;
    }
    // Somewhat further at once, or the camera would creep along with every step.
    const margin = MARGIN * spread(now);
    const old = box ?? now;
    this.box = {
      low: now.low.map((value, side) => (value < old.low[side] ? value - margin : old.low[side])),
      high: now.high.map((value, side) => (value > old.high[side] ? value + margin : old.high[side])),
    };
    return this.box;
  }
}
