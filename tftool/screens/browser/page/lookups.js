// @ts-check
// Lookups in packed samples, with the same results and errors as lookups in the server's buffer.
// Times are whole nanoseconds since the epoch; null is the latest time.
import { compose, normalized, rpy } from "./maths.js";
import { FIELDS } from "./messages.js";
import { Poses } from "./wire.js";

const NANOSECONDS = 1e9;
const MOST_DEPTH = 1000;
const SHORTEST = 100_000; // nanoseconds: tf2 divides by at least this for a rate
const HISTORY = 120; // times that represent the history

/** Convert seconds to whole nanoseconds; halves are rounded to even, as in Python. */
export function nanoseconds(moment) {
  const value = moment * NANOSECONDS;
  const below = Math.floor(value);
  if (value - below !== 0.5) return Math.round(value);
  return below % 2 === 0 ? below : below + 1;
}

/** Error of a lookup, in the server's words. */
export class Refusal extends Error {}

/** A frame, and the samples of its pose in the parent. */
export class Link {
  /**
   * @param {import("./packed.js").PackedFrame} frame
   * @param {import("./packed.js").Packed} packed
   */
  constructor(frame, packed) {
    this.name = frame.name;
    this.authority = frame.authority;
    this.count = frame.count ?? 0;
    this.isStatic = frame.static ?? false;
    this.slides = false;
    const column = (one) => (one ? packed.column(one, this.count) : new Float64Array(0));
    this.stamps = column(frame.stamps);
    this.parents = column(frame.parents);
    this.poses = (frame.poses ?? []).map(column);
    this.isRounded = packed.header.rounded;
    this.mixed = this.parents.some((parent) => parent !== this.parents[0]);
    this.oldest = this.stamps[0] ?? 0;
    this.newest = this.stamps[this.count - 1] ?? 0;
  }

  get moves() {
    return this.count > 0 && !this.isStatic;
  }

  /**
   * Replace the frame's pose from now on, at all times.
   * @param {number[]} pose in its parent
   */
  hold(pose) {
    this.poses = pose.map((value) => new Float64Array(this.count).fill(value));
    this.isRounded = false;
  }

  /** @returns {number[]} */
  sample(index) {
    const pose = this.poses.map((column) => column[index]);
    return this.isRounded ? normalized(pose) : pose;
  }

  /** Index of the last sample at or before a time; requires oldest <= time < newest. */
  index(time) {
    let low = 0;
    let high = this.count - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.stamps[middle] <= time) low = middle;
      else high = middle;
    }
    return low;
  }

  /**
   * The interpolated pose in the parent; null if the time is outside of the samples.
   * @param {number | null} time
   * @returns {number[] | null}
   */
  at(time) {
    if (this.count === 0) return null;
    if (this.isStatic || time === null || time === this.newest) return this.sample(this.count - 1);
    if (time === this.oldest) return this.sample(0);
    if (!(this.oldest < time && time < this.newest)) return null;
    const index = this.index(time);
    const before = this.stamps[index];
    const share = (time - before) / (this.stamps[index + 1] - before);
    if (this.parents[index] !== this.parents[index + 1]) return this.sample(index);
    return interpolate(this.sample(index), this.sample(index + 1), share);
  }

  /** The parent's index at a time; -1 without a parent. */
  parentAt(time) {
    if (this.count === 0) return -1;
    if (this.isStatic || time === null || time === this.newest) return this.parents[this.count - 1];
    if (!(this.oldest <= time && time < this.newest)) return -1;
    return this.parents[time === this.oldest ? 0 : this.index(time)];
  }
}

/** Interpolate between two poses; the rotation follows the shorter arc. */
export function interpolate(one, other, share) {
  if (share === 0) return one;
  let cosine = one[3] * other[3] + one[4] * other[4] + one[5] * other[5] + one[6] * other[6];
  let take = 1;
  if (cosine < 0) [cosine, take] = [-cosine, -1];
  const place = [0, 1, 2].map((at) => one[at] + share * (other[at] - one[at]));
  if (!(cosine < 1)) {
    return [...place, ...[3, 4, 5, 6].map((at) => one[at] + share * (take * other[at] - one[at]))];
  }
  const angle = Math.acos(cosine);
  const sine = Math.sin(angle);
  const keep = Math.sin((1 - share) * angle) / sine;
  take *= Math.sin(share * angle) / sine;
  return [...place, ...[3, 4, 5, 6].map((at) => keep * one[at] + take * other[at])];
}

/** The second pose relative to the first. */
function between(first, second) {
  const [x, y, z] = [0, 1, 2].map((at) => second[at] - first[at]);
  const turned = [0, 0, 0, -first[3], -first[4], -first[5], first[6]];
  return compose(turned, [x, y, z, ...second.slice(3)]);
}

/** Give a quaternion the same sign as tf2 does. */
function canonical(pose) {
  const [, , , x, y, z, w] = pose;
  const [xx, yy, zz] = [x * x, y * y, z * z];
  const leading = w * w > 0.25 ? w : xx < yy ? (yy < zz ? z : y) : xx < zz ? z : x;
  return leading < 0 ? [...pose.slice(0, 3), -x, -y, -z, -w] : pose;
}

/** Evenly spaced times from one time to another, nanoseconds. */
function spread(from, to, count) {
  const [first, last] = [nanoseconds(from), nanoseconds(to)];
  return Array.from({ length: count }, (_, step) => first + Math.floor(((last - first) * step) / (count - 1)));
}

export class Lookups {
  /** @param {import("./packed.js").Packed} packed */
  constructor(packed) {
    const { header } = packed;
    this.epoch = BigInt(header.epoch);
    this.now = Math.round(header.now * NANOSECONDS);
    this.total = header.total;
    this.links = header.frames.map((frame) => new Link(frame, packed));
    this.numbers = new Map(this.links.map(({ name }, index) => [name, index]));
    const moving = this.links.filter((link) => link.moves);
    this.oldest = moving.reduce((least, { oldest }) => Math.min(least, oldest), Infinity);
    this.newest = moving.reduce((most, { newest }) => Math.max(most, newest), -Infinity);
    if (!moving.length) this.oldest = this.newest = this.now;
    /** @type {Map<string, number>} */
    this.revisions = new Map();
  }

  /** Evenly spaced times of the history, oldest first. */
  moments() {
    if (this.newest <= this.oldest) return [];
    const count = Math.max(2, Math.min(HISTORY, Math.floor(40_000 / this.links.length)));
    const span = this.newest - this.oldest;
    return Array.from({ length: count }, (_, step) => this.oldest + Math.floor((span * step) / (count - 1)));
  }

  /** Parent of each frame at a time, or the newest parent if no sample covers that time. */
  parents(time) {
    return this.links.map((link) => {
      const parent = link.mixed ? link.parentAt(time) : -1;
      return parent >= 0 ? parent : link.parentAt(null);
    });
  }

  /** All frames at one time: names and poses. */
  picture(time) {
    const parents = this.parents(time);
    const key = parents.join();
    let revision = this.revisions.get(key);
    if (revision === undefined) {
      revision = this.revisions.size + 1;
      this.revisions.set(key, revision);
    }
    const names = {
      type: "frames",
      epoch: String(this.epoch),
      revision,
      names: this.links.map(({ name }) => name),
      parents,
      // 2 for a frame that only a slider moves.
      statics: this.links.map((link, index) => (link.isStatic && parents[index] >= 0 ? 1 + Number(link.slides) : 0)),
      authorities: this.links.map(({ authority }) => authority || "no recorded authority"),
      total: this.total,
      rate: 1,
    };
    const numbers = new Float64Array(this.links.length * FIELDS).fill(Number.NaN);
    this.links.forEach((link, index) => {
      const start = index * FIELDS;
      if (parents[index] < 0) {
        numbers.set([0, 0, 0, 0, 0, 0, 1, Number.NaN, Number.NaN, 0, 0], start);
        return;
      }
      const pose = link.at(time);
      if (pose) numbers.set(canonical(pose), start);
      if (link.moves) numbers.set([link.newest / NANOSECONDS, link.oldest / NANOSECONDS], start + 7);
      const span = Math.max(link.newest - link.oldest, SHORTEST);
      numbers.set([(link.count * NANOSECONDS) / span, link.count], start + 9);
    });
    const poses = new Poses({
      sequence: 0,
      revision,
      count: this.links.length,
      now: this.now / NANOSECONDS,
      at: time === null ? null : time / NANOSECONDS,
      oldest: this.oldest / NANOSECONDS,
      newest: this.newest / NANOSECONDS,
      numbers,
    });
    return { names, poses };
  }

  /**
   * The transform of `source` in `target`, as the server writes it.
   * @param {string} target
   * @param {string} source
   * @param {number | null} at
   */
  pair(target, source, at) {
    const answer = { type: "pair", target, source };
    try {
      const { time, pose, chain } = this.lookup(target, source, at);
      const finite = (values) => values.map((value) => (Number.isFinite(value) ? value : null));
      return {
        ...answer,
        found: true,
        stamp: time === null ? "0.000000" : this.display(time),
        moment: time === null ? null : time / NANOSECONDS,
        translation: finite(pose.slice(0, 3)),
        rotation: finite(pose.slice(3)),
        rpy: finite(rpy(pose)),
        chain,
      };
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      return { ...answer, found: false, why: error.message };
    }
  }

  /**
   * @param {string} target
   * @param {string} source
   * @param {number | null} at
   * @returns {{ time: number | null, pose: number[], chain: string[] }}
   */
  lookup(target, source, at) {
    if (target === source) {
      const link = this.links[this.numbers.get(target) ?? -1];
      return { time: at ?? (link?.moves ? link.newest : null), pose: [0, 0, 0, 0, 0, 0, 1], chain: [] };
    }
    const to = this.number(target, "target_frame");
    const from = this.number(source, "source_frame");
    const time = at ?? this.latestCommon(to, from);
    const { up, down, top } = this.walk(to, from, time);
    let pose = this.chained(up, time);
    if (down.length) pose = between(this.chained(down, time), pose);
    return { time, pose: canonical(pose), chain: [...up, top, ...down.reverse()].map((index) => this.links[index].name) };
  }

  /**
   * Transform of a pair at evenly spaced times, as the server writes it; null if a lookup fails.
   * @param {{ target: string, source: string, from: number, to: number, count: number }} asked
   */
  series({ target, source, from, to, count }) {
    const stamps = spread(from, to, count);
    const poses = stamps.map((stamp) => {
      const pose = this.pose(target, source, stamp);
      return pose && [...pose.slice(0, 3), ...rpy(pose)];
    });
    const column = (place) => poses.map((pose) => (pose && Number.isFinite(pose[place]) ? pose[place] : null));
    const [x, y, z, roll, pitch, yaw] = [0, 1, 2, 3, 4, 5].map(column);
    const times = stamps.map((stamp) => stamp / NANOSECONDS);
    return { type: "series", target, source, times, x, y, z, roll, pitch, yaw };
  }

  /**
   * Positions of frames at evenly spaced times, as the server writes them; null if unknown.
   * @param {import("./past.js").Asked} asked
   */
  trails({ fixed, frames, from, to, count }) {
    const stamps = spread(from, to, count);
    /** @type {Record<string, import("./past.js").Places>} */
    const places = Object.create(null); // a frame may have any name
    for (const frame of frames) {
      places[frame] = stamps.map((stamp) => {
        const place = this.pose(fixed, frame, stamp)?.slice(0, 3);
        return place?.every(Number.isFinite) ? place : null;
      });
    }
    return { type: "trails", fixed, from, to, places };
  }

  /** Pose of `source` in `target` at a time; null if the lookup fails. */
  pose(target, source, stamp) {
    try {
      return this.lookup(target, source, stamp).pose;
    } catch (error) {
      if (error instanceof Refusal) return null;
      throw error;
    }
  }

  number(frame, argument) {
    const number = this.numbers.get(frame);
    if (number === undefined) {
      throw new Refusal(`"${frame}" passed to lookupTransform argument ${argument} does not exist. `);
    }
    return number;
  }

  /** Compose the poses of several frames in their parents, lowest first. */
  chained(links, time) {
    return links.reduce((pose, index) => {
      const own = this.links[index].at(time) ?? new Array(7).fill(Number.NaN);
      return pose ? compose(own, pose) : own;
    }, null) ?? [0, 0, 0, 0, 0, 0, 1];
  }

  /** Links from source and target up to their common ancestor. */
  walk(target, source, time) {
    const [target_, source_] = [this.links[target].name, this.links[source].name];
    const climb = (frame, ends) => {
      const passed = [];
      while (!ends(frame) && this.links[frame].count) {
        const parent = this.links[frame].parentAt(time);
        if (parent < 0) return { passed, frame, refused: true };
        passed.push(frame);
        frame = parent;
        if (passed.length > MOST_DEPTH) throw this.looped();
      }
      return { passed, frame, refused: false };
    };
    const one = climb(source, (frame) => frame === target);
    if (one.frame === target) return { up: one.passed, down: [], top: target };
    const other = climb(target, (frame) => frame === one.frame || frame === source);
    if (other.frame === source) return { up: [], down: other.passed, top: source };
    if (other.refused) throw this.extrapolation(other.frame, time, target_, source_);
    if (other.frame !== one.frame) {
      if (one.refused) throw this.extrapolation(one.frame, time, target_, source_);
      throw new Refusal(
        `Could not find a connection between '${target_}' and '${source_}' because they are not ` +
          "part of the same tree.Tf has two or more unconnected trees.",
      );
    }
    const [up, down] = [one.passed, other.passed];
    let top = one.frame;
    while (up.length && down.length && up[up.length - 1] === down[down.length - 1]) {
      top = up[up.length - 1];
      up.pop();
      down.pop();
    }
    return { up, down, top };
  }

  /** The newest time for which every frame between two frames has data; null if all are static. */
  latestCommon(target, source) {
    /** @type {number[]} */
    const stamps = [];
    const reached = new Map();
    const stamp = (frame) => (this.links[frame].moves ? this.links[frame].newest : Infinity);
    const least = (values) => {
      const found = values.reduce((one, other) => Math.min(one, other), Infinity);
      return found === Infinity ? null : found;
    };
    let frame = source;
    while (this.links[frame].count) {
      stamps.push(stamp(frame));
      frame = this.links[frame].parentAt(null);
      if (frame === target) return least(stamps);
      if (stamps.length > MOST_DEPTH) throw this.looped();
      reached.set(frame, stamps.length);
    }
    const ours = [];
    frame = target;
    while (this.links[frame].count) {
      ours.push(stamp(frame));
      frame = this.links[frame].parentAt(null);
      if (reached.has(frame)) return least([...ours, ...stamps.slice(0, reached.get(frame))]);
      if (frame === source) return least(ours);
      if (ours.length > MOST_DEPTH) throw this.looped();
    }
    throw new Refusal(
      `Could not find a connection between '${this.links[target].name}' and '${this.links[source].name}' ` +
        "because they are not part of the same tree.Tf has two or more unconnected trees.",
    );
  }

  looped() {
    const parents = this.parents(null);
    const sentences = this.links
      .filter((_, index) => parents[index] >= 0)
      .map(({ name }) => `Frame ${name} exists with parent ${this.links[parents[this.numbers.get(name) ?? 0]].name}.\n`);
    return new Refusal(`The tf tree is invalid because it contains a loop.\n${sentences.join("")}\n`);
  }

  extrapolation(index, time, target, source) {
    const link = this.links[index];
    const asked = this.display(time);
    const [kind, has] =
      link.count <= 1 ? ["", link.newest]
      : time > link.newest ? ["into the future", link.newest]
      : ["into the past", link.oldest];
    const shown = this.display(has);
    const why =
      kind === "" ? `Lookup would require extrapolation at time ${asked}, but only time ${shown} is in the buffer`
      : `Lookup would require extrapolation ${kind}.  Requested time ${asked} but the ` +
        `${kind === "into the future" ? "latest" : "earliest"} data is at time ${shown}`;
    return new Refusal(`${why}, when looking up transform from frame [${source}] to frame [${target}]`);
  }

  /** A time as in tf2's error messages: seconds with six decimals. */
  display(time) {
    const stamp = this.epoch + BigInt(time);
    const whole = stamp / 1_000_000_000n;
    const seconds = Number(whole) + 1e-9 * Number(stamp % 1_000_000_000n);
    return seconds.toFixed(6);
  }
}
