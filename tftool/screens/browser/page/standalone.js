// @ts-check
// Replacement of the server's connection: answers from the data of a saved page.
import { drive } from "./kinematics.js";
import { Lookups, nanoseconds } from "./lookups.js";
import { Packed } from "./packed.js";

/** @returns {Packed | null} data of a saved page; null for a page from a server */
export function packed() {
  const found = /** @type {any} */ (globalThis).tftoolPacked;
  return found ? new Packed(found.header, found.bytes) : null;
}

export class Standalone {
  /**
   * @param {any} handlers as those of `Wire`
   * @param {Packed} packed
   */
  constructor(handlers, packed) {
    this.handlers = handlers;
    this.lookups = new Lookups(packed);
    this.robot = packed.header.robot;
    for (const { frame } of this.robot?.motion ?? []) {
      const link = this.lookups.links[this.lookups.numbers.get(frame) ?? -1];
      if (link) link.slides = true;
    }
    this.marks = packed.header.marks;
    /** @type {number | null} */
    this.at = null;
    /** @type {import("./messages.js").PairRequest} */
    this.frames = { type: "pair", target: null, source: null };
    this.revision = -1;
    this.sequence = 0;
    this.due = false;
    // As with a server, nothing is answered before the page is ready.
    queueMicrotask(() => {
      handlers.open();
      if (this.robot) handlers.robot(this.robot);
      handlers.tracks(packed.header.tracks ?? [], packed, true);
      this.later();
    });
  }

  /** @param {import("./messages.js").Request} request */
  want(request) {
    if (request.type === "show") this.at = request.at === null ? null : nanoseconds(request.at);
    if (request.type === "pair") this.frames = request;
    if (request.type === "marks") queueMicrotask(() => this.handlers.marks(this.marks));
    else if (request.type === "series") queueMicrotask(() => this.handlers.series(this.lookups.series(request)));
    else this.later();
  }

  /** Repeated requests are answered once. */
  later() {
    if (this.due) return;
    this.due = true;
    queueMicrotask(() => {
      this.due = false;
      this.answer();
    });
  }

  answer() {
    const { names, poses } = this.lookups.picture(this.at);
    if (names.revision !== this.revision) this.handlers.names(names);
    this.revision = names.revision;
    const { target, source } = this.frames;
    if (target !== null && source !== null) this.handlers.pair(this.lookups.pair(target, source, this.at));
    poses.sequence = ++this.sequence;
    this.handlers.poses(poses);
  }

  past() {
    for (const moment of this.lookups.moments()) {
      const { names, poses } = this.lookups.picture(moment);
      if (names.revision === this.revision) this.handlers.past(poses);
    }
  }

  trails(asked) {
    queueMicrotask(() => this.handlers.trails(this.lookups.trails(asked)));
  }

  got() {}

  press() {}

  /** Move a joint, and the links that depend on it. */
  move(joint, position) {
    for (const { frame, pose } of drive(this.robot.motion, joint, position)) {
      this.lookups.links[this.lookups.numbers.get(frame) ?? -1]?.hold(pose);
    }
    this.later();
  }
}
