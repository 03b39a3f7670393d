// @ts-check
// The moment that is looked at: the present, or one in the past, at rest or being played.

/**
 * What the buffer holds, in seconds of the session.
 * @typedef {{ oldest: number, newest: number, now: number }} Reach
 */

/**
 * ask(at): request the poses of a moment, null for the present. moved(): the moment or the way it
 * runs has changed. reached(reach): the buffer holds another span now.
 * @typedef {{ ask(at: number | null): void, moved(): void, reached(reach: Reach): void }} Hooks
 */

const SHORTEST = 0.01; // seconds that the ruler is zoomed to at most
const LONGEST_TICK = 0.25; // seconds; a page that was hidden does not leap

export class Timeline {
  /**
   * @param {Hooks} hooks
   * @param {number | null} at moment to begin with; null is the present
   */
  constructor(hooks, at = null) {
    this.hooks = hooks;
    this.at = at;
    this.playing = at === null;
    this.awaiting = false; // poses were requested and have not come yet
    /** @type {Reach} */
    this.reach = { oldest: 0, newest: 0, now: 0 };
    /** The part of the reach that the ruler and the plot show. */
    this.span = { oldest: 0, newest: 0 };
    /** @type {{ from: number, length: number, follows: boolean } | null} zoomed to, null for all */
    this.window = null;
    this.zoomed = 0; // how often a person zoomed or panned
    this.rate = 1; // session seconds per second
    this.speed = 1; // of play, chosen by a person
    this.tickedAt = 0;
    this.moves = true; // whether any frame is dynamic
    this.ends = false; // nothing more comes: there is no present to run into
    this.loops = false; // what is played to its end begins anew
  }

  get past() {
    return this.at !== null;
  }

  /** Whether the buffer no longer holds the moment shown. */
  get forgotten() {
    return this.at !== null && this.at < this.reach.oldest;
  }

  /**
   * Take in what the buffer holds: the one place that does, so that the slider's bounds never lag.
   * @param {Reach} reach
   */
  setReach({ oldest, newest, now }) {
    this.reach = { oldest, newest, now };
    this.settle();
    this.hooks.reached(this.reach);
  }

  /** Keep the window within the buffer, and along with the moment shown once it has been inside. */
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
   * Show a shorter or longer span, with a moment at the same place of the ruler.
   * @param {number} moment
   * @param {number} factor of the span; Infinity for all of it
   */
  zoom(moment, factor) {
    const { oldest, newest } = this.span;
    const length = Math.max(SHORTEST, (newest - oldest) * factor);
    this.window = { from: moment - (moment - oldest) * (length / (newest - oldest)), length, follows: false };
    this.turned();
  }

  /**
   * Show an earlier or later part.
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
   * Come to rest on a moment, never beyond what the buffer holds.
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

  /** Pause or play on; pausing the present rests on its newest moment. */
  toggle() {
    if (this.at === null && !this.ends) this.scrub(this.reach.newest);
    else {
      this.playing = !this.playing;
      // What has run to its end begins anew.
      if (this.ends && (this.at ?? this.reach.newest) >= this.reach.newest) this.show(this.reach.oldest);
      this.hooks.moved();
    }
  }

  /**
   * Let time pass until `now`, in milliseconds: a played past runs into the present.
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
   * Whether poses of moment `at` (null: the present) are those looked at. Late ones are not.
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

  /** Poses of a past moment will come once more: play waits for them. */
  awaitAgain() {
    this.awaiting = this.at !== null;
  }

  /** The connection has ended: what was requested will not come. */
  lost() {
    this.awaiting = false;
  }
}
