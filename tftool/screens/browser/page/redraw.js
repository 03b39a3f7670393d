// @ts-check
// Dirty flags: set by changes, read once per animation frame.

const LISTS_EVERY = 150; // milliseconds between two refreshes of the lists
const STILL_EVERY = 300; // milliseconds between two pictures in which only time advances

/** Dirty flags of the picture and of the lists beside it. */
export class Redraw {
  constructor(listsEvery = LISTS_EVERY) {
    this.listsEvery = listsEvery;
    this.pictureDue = true;
    this.atOnce = true; // regardless of the update interval
    this.moved = true;
    this.listsDue = true;
    this.pictureAt = -Infinity;
    this.listsAt = -Infinity;
  }

  /**
   * New data: the picture follows when the update interval allows it.
   * @param {boolean} moved whether any frame has moved; if not, the picture is not urgent
   */
  data(moved = true) {
    this.pictureDue = true;
    this.moved ||= moved;
  }

  /** Time has passed: only the lists are updated. */
  words() {
    this.listsDue = true;
  }

  /** The user moved the camera or the time: the picture follows at once. */
  picture() {
    this.pictureDue = this.atOnce = true;
  }

  /** The user chose something: picture and lists follow at once. */
  everything() {
    this.picture();
    this.listsAt = -Infinity;
  }

  /**
   * Parts to draw in the animation frame at `now`; clears the flags of these parts.
   *
   * @param {number} now milliseconds
   * @param {number} interval least time between two pictures of data, milliseconds
   */
  take(now, interval) {
    const least = this.moved ? interval : Math.max(interval, STILL_EVERY);
    const picture = this.pictureDue && (this.atOnce || now - this.pictureAt >= least);
    if (picture) {
      this.pictureDue = this.atOnce = this.moved = false;
      this.listsDue = true;
      this.pictureAt = now;
    }
    const lists = this.listsDue && now - this.listsAt >= this.listsEvery;
    if (lists) {
      this.listsDue = false;
      this.listsAt = now;
    }
    return { picture, lists };
  }

  /** The last picture showed no data: the first one with data must not wait for the interval. */
  nothingShown() {
    this.pictureAt = -Infinity;
  }
}
