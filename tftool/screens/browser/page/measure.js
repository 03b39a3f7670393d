// @ts-check
// Measurement between two points, which are frames or positions in frames, and may move.
import { number } from "./format.js";
import { compose } from "./maths.js";

/** @typedef {{ name: string, place?: number[] }} End a frame, or a position in the frame */

/**
 * Intersection of a ray with a plane, in front of the ray's origin; null without an intersection.
 * @param {{ origin: number[], way: number[] }} ray
 * @param {number[]} normal
 * @param {number[]} through
 * @returns {number[] | null}
 */
export function onPlane({ origin, way }, normal, through) {
  const dot = (one, other) => one[0] * other[0] + one[1] * other[1] + one[2] * other[2];
  const steep = dot(way, normal);
  if (Math.abs(steep) < 1e-9) return null;
  const away = dot(through.map((value, axis) => value - origin[axis]), normal) / steep;
  return away >= 0 ? origin.map((value, axis) => value + away * way[axis]) : null;
}

export class Measure {
  constructor() {
    this.on = false;
    this.length = ""; // distance between the two ends as text, set by `told`
    /** @type {End[]} */
    this.ends = [];
  }

  /** @param {boolean} on */
  turn(on) {
    this.on = on;
    this.ends = [];
  }

  /**
   * Set the next end; a third end starts a new measurement.
   * @param {End | null} end
   */
  click(end) {
    if (!end) return;
    if (this.ends.length === 2) this.ends = [];
    this.ends.push(end);
  }

  /**
   * Current positions of the ends; null for a frame without a pose.
   * @param {(name: string) => number[] | null} poseOf
   * @returns {(number[] | null)[]}
   */
  places(poseOf) {
    return this.ends.map(({ name, place = [0, 0, 0] }) => {
      const pose = poseOf(name);
      return pose && compose(pose, [...place, 0, 0, 0, 1]).slice(0, 3);
    });
  }

  /**
   * Text of the measurement; x, y and z are along the axes of the fixed frame.
   * @param {(name: string) => number[] | null} poseOf in the fixed frame
   * @param {string | undefined} fixed
   */
  told(poseOf, fixed) {
    const [from, to] = this.places(poseOf);
    this.length = "";
    if (this.ends.length < 2) return this.ends.length ? "Click the second point" : "Click the first point: a frame, or a place";
    if (!from || !to) return "A frame that is measured has no pose here";
    const way = to.map((value, axis) => value - from[axis]);
    this.length = `${number(Math.hypot(...way), 3)} m`;
    const [x, y, z] = way.map((value) => number(value, 3));
    return `${this.named(0)} to ${this.named(1)}: ${this.length} (x ${x}, y ${y}, z ${z} in ${fixed})`;
  }

  named(which) {
    const { name, place } = this.ends[which];
    return place ? `(${place.map((value) => number(value, 2)).join(", ")}) in ${name}` : name;
  }
}
