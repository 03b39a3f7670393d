// @ts-check
// Poses around a past time with all recorded samples: requested in pieces of a few
// seconds, and stored while there is space.

const PIECE = 5; // seconds
const PLACES = 30; // positions per second
const MOST_PIECES = 60;
const MANY = 48; // largest number of pieces; for a longer span, each piece is longer
const MOST_ASKED = 60; // frames in one request
const MOST_LETTERS = 4000; // letters of all names in one request
const GROWN = 1; // seconds of new data after which a piece is requested again

/**
 * @typedef {(number[] | null)[]} Places positions evenly spread over a piece; null if unknown
 * @typedef {{ fixed: string, frames: string[], from: number, to: number, count: number }} Asked
 * @typedef {{ known: Map<string, Places>, asked: Set<string>, upto: number }} Piece
 */

export class Past {
  /** @param {(asked: Asked) => void} ask */
  constructor(ask) {
    this.ask = ask;
    this.fixed = "";
    this.long = PIECE; // seconds of the session
    /** @type {Map<number, Piece>} in order of use, the last one at the end */
    this.pieces = new Map();
  }

  /** Drop all pieces, because the tree or the session has changed. */
  forget() {
    this.pieces.clear();
  }

  /** The connection has ended: open requests will not be answered. */
  lost() {
    for (const { known, asked } of this.pieces.values()) {
      asked.clear();
      for (const name of known.keys()) asked.add(name);
    }
  }

  /**
   * Show frames between two times; request the missing pieces and the following pieces.
   * @param {string} fixed
   * @param {string[]} frames
   * @param {number} from
   * @param {number} until
   * @param {number} newest last time with data
   * @param {number} rate seconds of the session in a second
   */
  look(fixed, frames, from, until, newest, rate) {
    const doubled = Math.max(0, Math.ceil(Math.log2((until - from) / (rate * PIECE * MANY))));
    const long = rate * PIECE * 2 ** (until > from ? doubled : 0);
    if (fixed !== this.fixed || long !== this.long) this.forget();
    Object.assign(this, { fixed, long });
    if (!frames.length) return;
    const last = Math.min(Math.floor(newest / this.long), Math.floor(until / this.long) + 1);
    for (let number = Math.floor(from / this.long); number <= last; number++) this.want(number, frames, newest);
    while (this.pieces.size > MOST_PIECES) this.pieces.delete(this.pieces.keys().next().value ?? 0);
  }

  /** @param {number} number @param {string[]} frames @param {number} newest */
  want(number, frames, newest) {
    const [from, to] = [number * this.long, (number + 1) * this.long];
    const piece = this.pieces.get(number) ?? { known: new Map(), asked: new Set(), upto: newest };
    this.pieces.delete(number);
    this.pieces.set(number, piece);
    if (piece.upto < to && newest > piece.upto + GROWN * (this.long / PIECE)) piece.asked.clear();
    if (!piece.asked.size) piece.upto = newest;
    let batch = [];
    let letters = 0;
    for (const name of frames) {
      if (piece.asked.has(name)) continue;
      piece.asked.add(name);
      if (batch.length && (batch.length === MOST_ASKED || letters + name.length > MOST_LETTERS)) {
        this.ask({ fixed: this.fixed, frames: batch, from, to, count: PIECE * PLACES + 1 });
        [batch, letters] = [[], 0];
      }
      batch.push(name);
      letters += name.length;
    }
    if (batch.length) this.ask({ fixed: this.fixed, frames: batch, from, to, count: PIECE * PLACES + 1 });
  }

  /**
   * Store the answer to a request.
   * @param {{ fixed: string, from: number, to: number, places: Record<string, Places> }} told
   */
  take({ fixed, from, to, places }) {
    if (fixed !== this.fixed || Math.abs(to - from - this.long) > 1e-6) return;
    const piece = this.pieces.get(Math.round(from / this.long));
    for (const [name, row] of Object.entries(places)) piece?.known.set(name, row);
  }

  /**
   * Positions of a frame, oldest first, as far back as all pieces are stored. Live data of other
   * times must not replace missing pieces: after a jump, the trail would show another path.
   * @param {string} name
   * @param {number} from
   * @param {number} until
   * @returns {number[][]}
   */
  trail(name, from, until) {
    let points = [];
    for (let number = Math.floor(from / this.long); number * this.long <= until; number++) {
      const places = this.pieces.get(number)?.known.get(name);
      if (!places) {
        points = [];
        continue;
      }
      const step = this.long / (places.length - 1);
      // The last position of a piece is the first position of the next piece.
      for (let at = 0; at < places.length - 1; at++) {
        const moment = number * this.long + at * step;
        const place = places[at];
        if (place && moment >= from && moment <= until) points.push(place);
      }
    }
    return points;
  }
}
