// @ts-check
// The messages that are drawn in addition to the frames, by topic and in the order of their stamps.

const MOST_KEPT = 200; // messages of a live topic
const MOST_PLACES = 600_000; // positions of all messages of a live topic together

/**
 * @typedef {{ kind: string, frame: string, root: string | null, pose: number[] | null, count: number,
 *   places: import("./packed.js").Column[], colors?: import("./packed.js").Column[], turn?: number[], size?: number[],
 *   text?: string, until?: number }} PackedShape
 * @typedef {{ stamp: number, shapes: PackedShape[] }} PackedMessage
 * @typedef {{ topic: string, type: string, count: number, faults: string[], messages: PackedMessage[] }} PackedTrack
 * @typedef {{ kind: string, frame: string, root: string | null, pose: number[] | null, count: number, until: number,
 *   turn: number[], size: number[], text: string, places(): Float32Array, colors(): Float32Array | null }} Shape
 * @typedef {{ stamp: number, count: number, shapes: Shape[] }} Message
 * @typedef {{ topic: string, type: string, faults: string[], whole: boolean, messages: Message[] }} Track
 */

/**
 * Columns combined into rows, read at the first use.
 * @param {import("./packed.js").Column[]} columns
 * @param {number} count
 * @param {import("./packed.js").Packed} packed
 */
function rows(columns, count, packed, scale = 1) {
  /** @type {Float32Array | null} */
  let known = null;
  const unpack = () => {
    const found = new Float32Array(columns.length * count);
    columns.forEach((column, place) => {
      const numbers = packed.fresh(column, count);
      for (let at = 0; at < count; at++) found[columns.length * at + place] = numbers[at] * scale;
    });
    return found;
  };
  return () => (known ??= unpack());
}

/**
 * A message whose places are unpacked at the first use.
 * @param {PackedMessage} message
 * @param {import("./packed.js").Packed} packed
 * @returns {Message}
 */
function opened({ stamp, shapes }, packed) {
  const made = shapes.map(({ places, colors, ...rest }) => ({
    until: Infinity,
    turn: [0, 0, 0, 1],
    size: [1, 1, 1],
    text: "",
    ...rest,
    places: rows(places, rest.count, packed),
    colors: colors ? rows(colors, rest.count, packed, 1 / 255) : () => null,
  }));
  return { stamp, count: made.reduce((sum, { count }) => sum + count, 0), shapes: made };
}

/**
 * Drop the oldest messages beyond the limits, but never the last message.
 * @param {Message[]} messages
 */
function shorten(messages) {
  let kept = 0;
  let places = 0;
  while (kept < Math.min(messages.length, MOST_KEPT)) {
    places += messages[messages.length - 1 - kept].count;
    if (kept && places > MOST_PLACES) break;
    kept++;
  }
  messages.splice(0, messages.length - kept);
}

export class Tracks {
  constructor() {
    /** @type {Map<string, Track>} */
    this.topics = new Map();
  }

  /**
   * Add messages to the stored messages.
   * @param {PackedTrack[]} tracks
   * @param {import("./packed.js").Packed} packed
   * @param {boolean} whole whether these are all messages
   */
  take(tracks, packed, whole) {
    for (const { topic, type, faults, messages } of tracks) {
      const known = this.topics.get(topic);
      const track = known && !whole ? known : { topic, type, faults, whole, messages: [] };
      this.topics.set(topic, track);
      track.faults = faults;
      // The last message is the current one even if its stamp is older, because time may have restarted.
      const first = messages[0]?.stamp ?? Infinity;
      while (!whole && track.messages.length && track.messages[track.messages.length - 1].stamp >= first) track.messages.pop();
      for (const message of messages) {
        let place = track.messages.length;
        while (place > 0 && track.messages[place - 1].stamp > message.stamp) place--;
        track.messages.splice(place, 0, opened(message, packed));
      }
      if (!whole) shorten(track.messages);
    }
  }

  /** Drop the messages of the previous session. */
  forget() {
    for (const { topic, whole } of [...this.topics.values()]) if (!whole) this.topics.delete(topic);
  }

  /**
   * Last message of a topic up to a time; null if there is no such message.
   * @param {string} topic
   * @param {number | null} moment null for the latest
   */
  at(topic, moment) {
    const messages = this.topics.get(topic)?.messages ?? [];
    if (moment === null) return messages[messages.length - 1] ?? null;
    let low = 0;
    let high = messages.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (messages[middle].stamp <= moment + 1e-9) low = middle + 1;
      else high = middle;
    }
    return messages[low - 1] ?? null;
  }
}
