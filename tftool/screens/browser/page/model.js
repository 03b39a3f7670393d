// @ts-check
// Model of the frames: tree, poses in the fixed frame, ages, trails.
import { IDENTITY, compose, invert, known, normalized } from "./maths.js";

const HISTORY_SECONDS = 60;
const HISTORY_BYTES = 48e6;

/** The three stages of a frame without new samples: normal, turning grey, turning transparent. */
export function fade(age, timeout) {
  const share = age / timeout;
  if (share > 1) return { grey: 1, alpha: 0 };
  if (share > 2 / 3) return { grey: 1, alpha: 3 * (1 - share) };
  if (share > 1 / 3) return { grey: 3 * share - 1, alpha: 1 };
  return { grey: 0, alpha: 1 };
}

const HUES = 10;
const HALF = HUES / 2;

/**
 * A number for the colour of each name. The same names in any order get the same numbers, and
 * new names change few numbers. The first ten numbers are used first.
 * @param {string[]} names
 * @returns {Map<string, number>}
 */
export function placesOf(names) {
  const given = new Array(HUES).fill(0);
  return new Map(
    [...names].sort().map((name) => {
      let first = 7;
      for (const letter of name) first = (31 * first + (letter.codePointAt(0) ?? 0)) % 1_000_003;
      // The hues of the first half differ most, so the first half is used before the second.
      const [one, other] = [given.slice(0, HALF), given.slice(HALF)];
      const half = Math.min(...one) <= Math.min(...other) ? 0 : HALF;
      const fewest = Math.min(...(half ? other : one));
      const order = one.map((_, step) => half + ((first + step) % HALF));
      const hue = order.find((at) => given[at] === fewest) ?? 0;
      return [name, hue + HUES * given[hue]++];
    }),
  );
}

const moment = (poses) => poses.at ?? poses.now;

export class Model {
  constructor() {
    /** @type {string[]} */
    this.names = [];
    /** @type {number[]} */
    this.parents = []; // index of each frame's parent; -1 for a root
    /** @type {boolean[]} */
    this.statics = [];
    /** @type {string[]} */
    this.authorities = [];
    /** @type {number[][]} */
    this.children = [];
    /** @type {number[]} */
    this.roots = [];
    /** @type {number[]} */
    this.order = []; // parents before their children
    /** @type {number[]} */
    this.looped = []; // frames that no root reaches
    /** @type {number[]} */
    this.rootOf = [];
    /** @type {Map<string | undefined, number>} */
    this.index = new Map();
    /** @type {(number[] | null)[]} */
    this.absolute = []; // poses in the fixed frame
    this.total = 0;
    /** @type {number | null} */
    this.epoch = null;
    this.rate = 1;
    this.revision = -1;
    /** @type {import("./wire.js").Poses | null} */
    this.poses = null;
    /** @type {Map<string, { stamp: number, when: number }>} */
    this.heard = new Map(); // name → { stamp, when }: when the latest common stamp last changed
    this.heardAt = 0; // time of the last live poses, milliseconds
    /** Last time at which the newest stamp of all frames changed: arrival in milliseconds, and the session's time. */
    this.fresh = { newest: Number.NaN, when: 0, now: 0, isFirst: true };
    this.silence = 0; // seconds since the last message, while the connection is interrupted
    /** @type {Map<string, number>} */
    this.places = new Map(); // number of each name's colour, see `placesOf`
    /** @type {import("./wire.js").Poses[]} */
    this.history = [];
    this.historyBytes = 0;
    /** @type {WeakMap<object, { base: number, inverse: number[] | null, known: Map<number, number[] | null> }>} */
    this.spots = new WeakMap(); // poses of the history
  }

  /** Store the names of the frames; return true if the names are of another session. */
  setNames(message) {
    const another = this.epoch !== null && this.epoch !== message.epoch;
    if (another) {
      this.heard.clear();
      this.forget();
    }
    Object.assign(this, {
      epoch: message.epoch,
      revision: message.revision,
      names: message.names,
      parents: message.parents,
      statics: message.statics,
      authorities: message.authorities,
      total: message.total,
      rate: message.rate,
    });
    this.places = placesOf(this.names);
    this.index = new Map(this.names.map((name, index) => [name, index]));
    this.children = this.names.map(() => []);
    this.roots = [];
    this.parents.forEach((parent, index) => (parent < 0 ? this.roots : this.children[parent]).push(index));
    this.order = [...this.roots];
    for (let at = 0; at < this.order.length; at++) this.order.push(...this.children[this.order[at]]);
    // Frames that no root reaches form a loop; these frames are listed, but never traversed.
    const reached = new Set(this.order);
    this.forget(); // the history uses the old indices of the frames
    this.looped = this.names.map((_, index) => index).filter((index) => !reached.has(index));
    this.rootOf = new Array(this.names.length).fill(-1);
    for (const index of this.order) {
      const parent = this.parents[index];
      this.rootOf[index] = parent < 0 ? index : this.rootOf[parent];
    }
    return another;
  }

  forget() {
    this.history = [];
    this.historyBytes = 0;
  }

  /** Store poses; live poses also extend the history for trails. */
  setPoses(poses, when) {
    this.poses = poses;
    if (poses.at !== null) return;
    const last = this.history[this.history.length - 1];
    if (last && poses.now < moment(last)) this.forget();
    this.remember(poses);
    this.heardAt = when;
    if (this.fresh.newest !== poses.newest) {
      this.fresh = { newest: poses.newest, when, now: poses.now, isFirst: Number.isNaN(this.fresh.newest) };
    }
  }

  /** Store poses for trails, in the order of their times. */
  remember(poses) {
    if (poses.revision !== this.revision) return;
    let place = this.history.length;
    while (place > 0 && moment(this.history[place - 1]) > moment(poses)) place--;
    this.history.splice(place, 0, poses);
    this.historyBytes += poses.numbers.byteLength;
    const newest = moment(this.history[this.history.length - 1]);
    while (
      this.history.length > 1 &&
      (moment(this.history[0]) < newest - HISTORY_SECONDS * this.rate || this.historyBytes > HISTORY_BYTES)
    ) {
      this.historyBytes -= this.history[0].numbers.byteLength;
      this.history.shift();
    }
  }

  /** Whether a frame can move against its root. */
  moves(index) {
    for (let frame = index; this.parents[frame] >= 0; frame = this.parents[frame]) {
      if (!this.statics[frame]) return true;
    }
    return false;
  }

  /**
   * The frame on which a frame is mounted: its nearest ancestor that is not static and not moved by a joint in `joints`.
   * @param {string | undefined} name
   * @param {Set<string>} joints frames that joints move
   */
  carrier(name, joints) {
    let at = this.index.get(name) ?? -1;
    if (this.looped.includes(at)) return at;
    while (this.parents[at] >= 0 && (this.statics[at] || joints.has(this.names[at]))) at = this.parents[at];
    return at;
  }

  /** Root of the largest tree, which is the default fixed frame. */
  biggestRoot() {
    const sizes = new Map();
    for (const index of this.order) {
      const root = this.rootOf[index];
      sizes.set(root, (sizes.get(root) ?? 0) + 1);
    }
    let best = this.roots[0];
    for (const [root, size] of sizes) if (size > sizes.get(best)) best = root;
    return this.names[best];
  }

  /** Compute every pose in the fixed frame; null if unknown. */
  solve(fixed) {
    const count = this.names.length;
    this.absolute = new Array(count).fill(null);
    if (!this.poses || this.poses.count !== count) return;
    /** @type {(number[] | null)[]} */
    const inRoot = new Array(count).fill(null);
    for (const index of this.order) {
      const parent = this.parents[index];
      const above = inRoot[parent];
      if (parent < 0) inRoot[index] = IDENTITY;
      else if (above) {
        const pose = this.poses.relative(index);
        inRoot[index] = known(pose) ? compose(above, normalized(pose)) : null;
      }
    }
    const base = this.index.get(fixed);
    if (base === undefined || !inRoot[base]) return;
    const fixedFromRoot = invert(inRoot[base]);
    for (const index of this.order) {
      if (inRoot[index] && this.rootOf[index] === this.rootOf[base]) {
        const pose = compose(fixedFromRoot, inRoot[index]);
        this.absolute[index] = known(pose) ? pose : null;
      }
    }
    this.listen(base);
  }

  /** Store the time for each frame whose latest common stamp with the fixed frame has changed. */
  listen(base) {
    const { poses } = this;
    if (!poses || poses.at !== null) return;
    const newest = (index) => (this.statics[index] ? Infinity : poses.newestOf(index));
    // Smallest stamp between the fixed frame and each of its ancestors.
    const upward = new Map();
    let least = Infinity;
    for (let at = base; at >= 0; at = this.parents[at]) {
      upward.set(at, least);
      if (this.parents[at] >= 0) least = Math.min(least, newest(at));
    }
    const common = new Array(this.names.length).fill(Infinity);
    for (const index of this.order) {
      if (upward.has(index)) common[index] = upward.get(index);
      else if (this.parents[index] >= 0) common[index] = Math.min(common[this.parents[index]], newest(index));
      if (this.rootOf[index] !== this.rootOf[base]) continue;
      const name = this.names[index];
      const before = this.heard.get(name);
      if (!before || before.stamp !== common[index]) {
        this.heard.set(name, { stamp: common[index], when: this.heardAt });
      }
    }
  }

  /** Seconds since the frame's last new sample; 0 for static chains and for past times. */
  age(index) {
    if (!this.poses || this.poses.at !== null) return 0;
    const heard = this.heard.get(this.names[index]);
    if (!heard || heard.stamp === Infinity) return 0;
    return Math.max(0, (this.heardAt - heard.when) / 1000);
  }

  /** Seconds since the last new data; 0 while the session's clock is stopped. */
  unheard() {
    if (!this.poses || this.poses.now === this.fresh.now) return 0;
    return (this.heardAt - this.fresh.when) / 1000;
  }

  /** Seconds since the last new data, to display; for data that was old when the page opened, its age. */
  quiet() {
    if (!this.poses || !this.fresh.isFirst) return this.unheard();
    return Math.max(this.unheard(), (this.poses.now - this.poses.newest) / this.rate);
  }

  /** Seconds since the frame's newest stamp, including the server's silence. */
  behind(index) {
    if (!this.poses) return 0;
    return Math.max(0, this.poses.now - this.poses.newestOf(index)) / this.rate + this.silence;
  }

  relative(index) {
    if (!this.poses || this.parents[index] < 0) return null;
    const pose = this.poses.relative(index);
    return known(pose) ? normalized(pose) : null;
  }

  /** Positions of a frame in the fixed frame up to the time `until`, oldest first: [[x, y, z], …]. */
  trail(index, fixed, seconds, until) {
    const base = this.index.get(fixed);
    if (base === undefined || this.rootOf[index] !== this.rootOf[base]) return [];
    const points = [];
    for (const poses of this.history) {
      const when = moment(poses);
      if (when > until || when < until - seconds * this.rate) continue;
      const point = this.placed(poses, base, index);
      if (point) points.push(point);
    }
    return points;
  }

  /** Position of a frame at one time of the history, computed once. */
  placed(poses, base, index) {
    let spots = this.spots.get(poses);
    if (!spots || spots.base !== base) {
      const there = this.inRoot(poses, base);
      spots = { base, inverse: there && invert(there), known: new Map() };
      this.spots.set(poses, spots);
    }
    let point = spots.known.get(index);
    if (point === undefined) {
      const here = spots.inverse ? this.inRoot(poses, index) : null;
      point = here && spots.inverse ? compose(spots.inverse, here) : null;
      spots.known.set(index, point);
    }
    return point;
  }

  inRoot(poses, index) {
    let pose = IDENTITY;
    for (let at = index; this.parents[at] >= 0; at = this.parents[at]) {
      const relative = poses.relative(at);
      if (!known(relative)) return null;
      pose = compose(normalized(relative), pose);
    }
    return pose;
  }
}
