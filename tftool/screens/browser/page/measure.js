// @ts-check
// Measures between two points: frames, which it goes along with, or places on a plane.
import { number } from "./format.js";

/** @typedef {{ name: string } | { place: number[] }} End */

/**
 * Where a ray meets a plane, in front of where it begins; null if it does not.
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
    /** @type {End[]} */
    this.ends = [];
  }

  /** @param {boolean} on */
  turn(on) {
    this.on = on;
    this.ends = [];
  }

  /**
   * Take an end; a third one begins anew.
   * @param {End | null} end
   */
  click(end) {
    if (!end) return;
    if (this.ends.length === 2) this.ends = [];
    this.ends.push(end);
  }

  /**
   * Where the ends are now; null for a frame that has no pose.
   * @param {(name: string) => number[] | null} poseOf
   * @returns {(number[] | null)[]}
   */
  places(poseOf) {
    return this.ends.map((end) => ("place" in end ? end.place : (poseOf(end.name)?.slice(0, 3) ?? null)));
  }

  /**
   * What there is to say.
   * @param {(name: string) => number[] | null} poseOf
   */
  told(poseOf) {
    const [from, to] = this.places(poseOf);
    if (this.ends.length < 2) return this.ends.length ? "Click the second point" : "Click the first point: a frame, or a place";
    if (!from || !to) return "A frame that is measured has no pose here";
    const way = to.map((value, axis) => value - from[axis]);
    const [x, y, z] = way.map((value) => number(value, 3));
    return `${this.named(0)} to ${this.named(1)}: ${number(Math.hypot(...way), 3)} m (x ${x}, y ${y}, z ${z})`;
  }

  named(which) {
    const end = this.ends[which];
    return "name" in end ? end.name : `(${end.place.map((value) => number(value, 2)).join(", ")})`;
  }
}
