// @ts-check
// Resolution of the 3-D picture: coarser while frames move and pictures take too long,
// the window's own as soon as they rest.

const LEVELS = [1, 0.7, 0.5]; // of the pixels to a side
const SLOW = 30; // milliseconds a picture may take
const FAST = 18;
const SLOWEST = 2 * SLOW; // weight of the newest picture: one slow picture means little
const REST = 250; // milliseconds without a picture
const SHARE = 0.2; // of the newest picture in the mean
const SETTLED = 8; // pictures until a level is judged
const PATIENCE = 90; // fast pictures until a finer level is tried
const HIDDEN = 1000; // milliseconds; no picture takes this long: the page was hidden

export class Pace {
  constructor() {
    this.level = 0;
    this.scale = 1; // of the last picture
    this.drawnAt = -Infinity;
    this.drew = false;
    this.took = 0; // milliseconds, a mean
    this.judged = 0; // pictures at this level
    this.fast = 0; // of them, the last ones
    this.patience = PATIENCE;
  }

  /**
   * Begin an animation frame. True if nothing moves any more, and the picture must be drawn again in full resolution.
   * @param {number} now milliseconds
   */
  tick(now) {
    if (this.drew) this.note(now - this.drawnAt);
    this.drew = false;
    return this.scale < 1 && now - this.drawnAt > REST;
  }

  /**
   * Note a drawn picture, and its resolution as a share of the window's.
   * @param {number} now milliseconds
   */
  draw(now) {
    const moving = now - this.drawnAt <= REST;
    this.drawnAt = now;
    this.drew = true;
    this.scale = moving ? LEVELS[this.level] : 1;
    return this.scale;
  }

  /** @param {number} took milliseconds from a picture to the next animation frame */
  note(took) {
    if (took > HIDDEN) return;
    this.took += (this.judged ? SHARE : 1) * (Math.min(took, SLOWEST) - this.took);
    this.judged++;
    this.fast = took < FAST ? this.fast + 1 : 0;
    if (this.took > SLOW && this.judged >= SETTLED && this.level < LEVELS.length - 1) {
      // A finer level was too slow: it is tried less often.
      if (this.patience > PATIENCE || this.risen) this.patience = Math.min(64 * PATIENCE, 2 * this.patience);
      this.turn(1);
    } else if (this.fast >= this.patience && this.level > 0) {
      this.turn(-1);
      this.risen = true;
    }
  }

  turn(by) {
    this.level += by;
    this.judged = this.fast = 0;
    this.risen = false;
  }
}
