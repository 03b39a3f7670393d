// @ts-check
// The messages that are drawn beside the frames, by topic and in order of their stamps.

const MOST_KEPT = 200; // messages of a topic that goes on
const MOST_PLACES = 600_000; // of all of them together

/**
 * @typedef {{ stamp: number, frame: string, root: string | null, pose: number[] | null, count: number,
 *   places: import("./packed.js").Column[] }} PackedMessage
 * @typedef {{ topic: string, type: string, kind: "ball" | "line" | "points", count: number, faults: string[],
 *   messages: PackedMessage[] }} PackedTrack
 * @typedef {{ stamp: number, frame: string, root: string | null, pose: number[] | null, count: number, places(): Float32Array }} Message
 * @typedef {{ topic: string, type: string, kind: "ball" | "line" | "points", faults: string[], whole: boolean, messages: Message[] }} Track
 */

/**
 * A message whose places are unpacked when it is first looked at.
 * @param {PackedMessage} message
 * @param {import("./packed.js").Packed} packed
 * @returns {Message}
 */
function opened({ stamp, frame, root, pose, count, places }, packed) {
  /** @type {Float32Array | null} */
  let known = null;
  const unpack = () => {
    const columns = places.map((column) => packed.fresh(column, count));
    const found = new Float32Array(3 * count);
    columns.forEach((column, axis) => {
      for (let at = 0; at < count; at++) found[3 * at + axis] = column[at];
    });
    return found;
  };
  return { stamp, frame, root, pose, count, places: () => (known ??= unpack()) };
}

/**
 * Drop the oldest, but never the last.
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
   * Take in messages, beside those that are known.
   * @param {PackedTrack[]} tracks
   * @param {import("./packed.js").Packed} packed
   * @param {boolean} whole whether these are all there are
   */
  take(tracks, packed, whole) {
    for (const { topic, type, kind, faults, messages } of tracks) {
      const known = this.topics.get(topic);
      const track = known && !whole ? known : { topic, type, kind, faults, whole, messages: [] };
      this.topics.set(topic, track);
      track.faults = faults;
      // What comes last is shown in the present, whatever its stamp: time may have begun anew.
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

  /** Another session speaks: what came from the one before is gone. */
  forget() {
    for (const { topic, whole } of [...this.topics.values()]) if (!whole) this.topics.delete(topic);
  }

  /**
   * What a topic shows at a moment: its last message up to then; null for none.
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
