// @ts-check
// The displayed time: the present, or a past time, paused or playing.

/**
 * Span of the buffer, in seconds of the session.
 * @typedef {{ oldest: number, newest: number, now: number }} Reach
 */

/**
 * ask(at): request the poses at a time, null for the present. moved(): the displayed time or its
 * rate has changed. reached(reach): the buffer's span has changed.
 * @typedef {{ ask(at: number | null): void, moved(): void, reached(reach: Reach): void }} Hooks
 */

const SHORTEST = 0.01; // seconds of the smallest span of the ruler
const LONGEST_TICK = 0.25; // seconds; a page that was hidden must not jump

export class Timeline {
  /**
   * @param {Hooks} hooks
   * @param {number | null} at first displayed time; null for the present
   */
  constructor(hooks, at = null) {
    this.hooks = hooks;
    this.at = at;
    this.playing = at === null;
    this.awaiting = false; // poses were requested and have not arrived
    /** @type {Reach} */
    this.reach = { oldest: 0, newest: 0, now: 0 };
    /** The part of the buffer's span that ruler and plot show. */
    this.span = { oldest: 0, newest: 0 };
    /** @type {{ from: number, length: number, follows: boolean } | null} zoomed to, null for all */
    this.window = null;
    this.zoomed = 0; // number of zooms and pans
    this.rate = 1; // session seconds per second
    this.speed = 1; // playback speed, chosen by the user
    this.tickedAt = 0;
    this.moves = true; // whether any frame is dynamic
    this.ends = false; // whether this is a recording, in which playback ends
    this.loops = false; // playback repeats from the start
  }

  get past() {
    return this.at !== null;
  }

  /** Whether the displayed time is no longer in the buffer. */
  get forgotten() {
    return this.at !== null && this.at < this.reach.oldest;
  }

  /**
   * Store the buffer's span. Only this function does, so that the slider's limits are never old.
   * @param {Reach} reach
   */
  setReach({ oldest, newest, now }) {
    this.reach = { oldest, newest, now };
    this.settle();
    this.hooks.reached(this.reach);
  }

  /** Keep the zoomed window within the buffer; let the window follow the displayed time. */
  settle() {
    const { window, reach } = this;
    const { oldest, newest } = reach;
    if (!window || window.length >= newest - oldest) {
      this.window = null;
      this.span = { oldest, newest };
      return;
    }
    const looked = this.at ?? newest;
    if (looked >= window.from && looked <= window.from + window.length) window.follows = true;
    else if (window.follows) window.from = looked < window.from ? looked : looked - window.length;
    window.from = Math.min(Math.max(window.from, oldest), newest - window.length);
    this.span = { oldest: window.from, newest: window.from + window.length };
  }

  /**
   * Zoom, so that one time stays at the same position of the ruler.
   * @param {number} moment
   * @param {number} factor of the span; Infinity for the whole buffer
   */
  zoom(moment, factor) {
    const { oldest, newest } = this.span;
    const length = Math.max(SHORTEST, (newest - oldest) * factor);
    this.window = { from: moment - (moment - oldest) * (length / (newest - oldest)), length, follows: false };
    this.turned();
  }

  /**
   * Pan to an earlier or later part.
   * @param {number} seconds
   */
  pan(seconds) {
    if (!this.window) return;
    this.window.from += seconds;
    this.window.follows = false;
    this.turned();
  }

  turned() {
    this.zoomed++;
    this.settle();
    this.hooks.reached(this.reach);
  }

  goLive() {
    this.playing = true;
    this.show(null);
  }

  /**
   * Stop at a time within the buffer's span.
   * @param {number} moment
   */
  scrub(moment) {
    this.playing = false;
    this.show(Math.min(Math.max(moment, this.reach.oldest), this.reach.newest));
  }

  /**
   * Scrub forwards or, with a negative number, backwards.
   * @param {number} seconds
   */
  step(seconds) {
    this.scrub((this.at ?? this.reach.newest) + seconds * this.rate);
  }

  /** Pause or continue; a pause while live stops at the newest time. */
  toggle() {
    if (this.at === null && !this.ends) this.scrub(this.reach.newest);
    else {
      this.playing = !this.playing;
      // Playback at its end starts again.
      if (this.ends && (this.at ?? this.reach.newest) >= this.reach.newest) this.show(this.reach.oldest);
      this.hooks.moved();
    }
  }

  /**
   * Advance playback to `now`, in milliseconds; it may reach the present.
   * @param {number} now
   */
  tick(now) {
    const passed = Math.min(LONGEST_TICK, (now - this.tickedAt) / 1000);
    this.tickedAt = now;
    if (this.at === null || !this.playing || this.awaiting) return;
    const next = Math.max(this.at, this.reach.oldest) + passed * this.rate * this.speed;
    if (next < this.reach.newest) this.show(next);
    else if (this.loops) this.show(this.reach.oldest);
    else this.ends ? this.scrub(next) : this.goLive();
  }

  /**
   * Whether poses at the time `at` (null: the present) are for the displayed time, and not outdated.
   * @param {number | null} at
   */
  accepts(at) {
    if ((at === null) !== (this.at === null)) return false;
    this.awaiting = false;
    return true;
  }

  /** @param {number | null} at */
  show(at) {
    this.at = at;
    this.awaiting = at !== null;
    this.settle();
    this.hooks.ask(at);
    this.hooks.moved();
  }

  /** Poses of a past time will be sent again: playback waits for them. */
  awaitAgain() {
    this.awaiting = this.at !== null;
  }

  /** The connection has ended: open requests will not be answered. */
  lost() {
    this.awaiting = false;
  }
}
