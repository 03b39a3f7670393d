// @ts-check
// Geometry of the time ruler and the plot: places of ticks, gaps, findings and lines.

import { round } from "./scale.js";

const STEPS = [1, 2, 5];
const MINUTES = [60, 120, 300, 600, 900, 1800, 3600, 7200, 14_400, 28_800, 86_400];

/** @typedef {{ oldest: number, newest: number }} Span */

/**
 * Times of ticks, round numbers of seconds, at least `apart` pixels apart.
 * @param {Span} span
 * @param {number} width pixels
 * @param {number} apart
 * @returns {{ at: number, text: string }[]}
 */
export function ticks({ oldest, newest }, width, apart = 70) {
  const length = newest - oldest;
  if (!(length > 0) || width < apart) return [];
  const least = (length * apart) / width;
  const step = stepOver(least);
  const found = [];
  for (let number = Math.ceil(oldest / step - 1e-9); number * step <= newest + step * 1e-9; number++) {
    found.push({ at: number * step, text: told(number * step, step) });
  }
  return found;
}

function stepOver(least) {
  if (least > 30) return MINUTES.find((step) => step >= least) ?? Math.ceil(least / 86_400) * 86_400;
  const power = 10 ** Math.floor(Math.log10(least));
  const factor = STEPS.find((one) => one * power >= least * (1 - 1e-9)) ?? 10;
  return Math.min(30, factor * power);
}

/** Text of a tick: seconds, with minutes and hours for long spans. */
export function told(moment, step = 1) {
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const size = Math.abs(moment);
  const sign = moment < 0 && size >= step / 2 ? "−" : "";
  if (size < 60) return `${sign}${size.toFixed(digits)} s`;
  const seconds = (size % 60).toFixed(digits).padStart(digits ? digits + 3 : 2, "0");
  const minutes = Math.floor(size / 60);
  if (minutes < 60) return `${sign}${minutes}:${seconds}`;
  return `${sign}${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, "0")}:${seconds}`;
}

/** Converts times to pixels and back. */
export class Scale {
  /**
   * @param {Span} span
   * @param {number} left pixel of the oldest moment
   * @param {number} right pixel of the newest
   */
  constructor({ oldest, newest }, left, right) {
    this.oldest = oldest;
    this.newest = newest;
    this.left = left;
    this.right = right;
  }

  pixel(moment) {
    const length = this.newest - this.oldest;
    return length > 0 ? this.left + ((moment - this.oldest) / length) * (this.right - this.left) : this.left;
  }

  /** The moment at a pixel, never outside of the span. */
  moment(pixel) {
    const share = (pixel - this.left) / Math.max(1, this.right - this.left);
    return this.oldest + Math.min(1, Math.max(0, share)) * (this.newest - this.oldest);
  }
}

/**
 * Gaps to show: of the frames in `frames`, or of all frames if empty; adjacent gaps are merged.
 * @param {[string, number, number][]} gaps frame, from, to
 * @param {Set<string>} frames
 * @param {Span} span
 * @returns {{ from: number, to: number, frames: string[] }[]}
 */
export function shownGaps(gaps, frames, { oldest, newest }) {
  const chosen = gaps
    .filter(([frame, from, to]) => (frames.size === 0 || frames.has(frame)) && to > oldest && from < newest)
    .map(([frame, from, to]) => ({ from: Math.max(from, oldest), to: Math.min(to, newest), frames: [frame] }))
    .sort((one, other) => one.from - other.from);
  /** @type {{ from: number, to: number, frames: string[] }[]} */
  const joined = [];
  for (const gap of chosen) {
    const last = joined[joined.length - 1];
    if (!last || gap.from > last.to) joined.push(gap);
    else {
      last.to = Math.max(last.to, gap.to);
      if (!last.frames.includes(gap.frames[0])) last.frames.push(gap.frames[0]);
    }
  }
  return joined;
}

/**
 * Values of the ticks at the side of a plot: round numbers, at least `apart` pixels apart.
 * @param {[number, number]} limits
 * @param {number} height pixels
 * @returns {{ value: number, text: string }[]}
 */
export function levels([least, most], height, apart = 18) {
  const step = round(((most - least) * apart) / Math.max(1, height));
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const found = [];
  for (let number = Math.ceil(least / step); number * step <= most; number++) {
    const text = (number * step + 0).toFixed(digits);
    // More than seven characters do not fit beside the plot.
    const isLong = digits > 4 || text.length > 7;
    found.push({ value: number * step, text: isLong ? (number * step).toExponential(1) : text });
  }
  return found;
}

/**
 * A series up to the last known pose, followed by newer poses.
 * @param {any} series
 * @param {any[]} poses each with `moment` and the series' columns
 */
export function extended(series, poses) {
  const columns = ["x", "y", "z", "roll", "pitch", "yaw"];
  let end = series.x.length;
  while (end > 0 && series.x[end - 1] === null) end--;
  const later = poses.filter(({ moment }) => end === 0 || moment > series.times[end - 1]);
  const all = { ...series, times: [...series.times.slice(0, end), ...later.map(({ moment }) => moment)] };
  for (const name of columns) all[name] = [...series[name].slice(0, end), ...later.map((pose) => pose[name])];
  return all;
}

/**
 * Index of a time in a series, with a fraction; null outside of the series.
 * @param {number[]} times
 * @param {number} moment
 */
export function placeOf(times, moment) {
  const step = (times[times.length - 1] - times[0]) / Math.max(1, times.length - 1);
  if (!times.length || moment < times[0] - step || moment > times[times.length - 1] + step) return null;
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= moment) low = middle;
    else high = middle;
  }
  return high === low ? low : low + Math.min(1, Math.max(0, (moment - times[low]) / (times[high] - times[low] || 1)));
}

/** Quantities of a pair that can be plotted, with the names of their lines. */
export const PLOTS = {
  xyz: { lines: ["x", "y", "z"], unit: "m" },
  distance: { lines: ["distance"], unit: "m" },
  rpy: { lines: ["roll", "pitch", "yaw"], unit: "°" },
};

/**
 * The lines of a plot, from the series in an answer of a server or a file.
 * @param {any} series
 * @param {keyof typeof PLOTS} plot
 * @returns {{ name: string, values: (number | null)[] }[]}
 */
export function linesOf(series, plot) {
  return PLOTS[plot].lines.map((name) => {
    if (name !== "distance") {
      const turn = plot === "rpy" ? 180 / Math.PI : 1;
      return { name, values: series[name].map((value) => (value === null ? null : value * turn)) };
    }
    const { x, y, z } = series;
    return { name, values: x.map((value, at) => (value === null ? null : Math.hypot(value, y[at], z[at]))) };
  });
}

const LEAST_HEIGHT = 0.002; // metres or degrees; the legend has three decimals

/**
 * Limits of several lines, with a margin; limits are never so narrow that noise fills the plot.
 * @param {{ values: (number | null)[] }[]} lines
 * @returns {[number, number]}
 */
export function bounds(lines) {
  let least = Infinity;
  let most = -Infinity;
  for (const { values } of lines) {
    for (const value of values) {
      if (value === null) continue;
      least = Math.min(least, value);
      most = Math.max(most, value);
    }
  }
  if (least > most) return [-1, 1];
  const margin = Math.max((most - least) * 0.08, Math.abs(most) * 1e-6, (LEAST_HEIGHT - most + least) / 2);
  return [least - margin, most + margin];
}

/**
 * Split a line where values are missing, and where an angle wraps around.
 * @param {(number | null)[]} values
 * @param {boolean} circular whether they are degrees
 * @returns {[number, number][][]} runs of [index, value]
 */
export function runs(values, circular) {
  /** @type {[number, number][][]} */
  const found = [];
  /** @type {number | null} */
  let before = null;
  values.forEach((value, at) => {
    if (value !== null) {
      if (before === null || (circular && Math.abs(value - before) > 180)) found.push([]);
      found[found.length - 1].push([at, value]);
    }
    before = value;
  });
  return found;
}

/**
 * Last known value of a line, because the newest values are often unknown.
 * @param {(number | null)[]} values
 */
export function newestOf(values) {
  for (let at = values.length - 1; at >= 0; at--) if (values[at] !== null) return values[at];
  return null;
}

/**
 * Linear interpolation between two values of a line; null if one of the values is missing.
 * @param {(number | null)[]} values
 * @param {number} place index, with a fraction
 * @param {boolean} circular whether they are degrees
 */
export function valueAt(values, place, circular) {
  const low = Math.min(values.length - 1, Math.max(0, Math.floor(place)));
  const high = Math.min(values.length - 1, low + 1);
  const [one, other] = [values[low], values[high]];
  const share = Math.min(1, Math.max(0, place - low));
  if (one === null || other === null) return share < 0.5 ? one : other;
  if (circular && Math.abs(other - one) > 180) return share < 0.5 ? one : other;
  return one + share * (other - one);
}
