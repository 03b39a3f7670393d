// @ts-check
// The connection to the server: decodes what comes, connects again when it ends.
import { inflated, isBlock, open, Packed } from "./packed.js";
import { secured } from "./secret.js";

const HEADER = 48;
export const FIELDS = 11; // numbers of a frame
const RETRY = 1000;

/** What a binary message holds; null for anything else. */
export function decode(buffer) {
  if (buffer.byteLength < HEADER) return null;
  const head = new DataView(buffer);
  if (head.getUint32(0) !== 0x54465031) return null; // "TFP1"
  const count = head.getUint32(12, true);
  if (buffer.byteLength !== HEADER + count * FIELDS * 8) return null;
  const at = head.getFloat64(24, true);
  return {
    sequence: head.getUint32(4, true),
    revision: head.getUint32(8, true),
    count,
    now: head.getFloat64(16, true),
    at: Number.isNaN(at) ? null : at,
    oldest: head.getFloat64(32, true),
    newest: head.getFloat64(40, true),
    numbers: new Float64Array(buffer, HEADER),
  };
}

export class Poses {
  /** @param {NonNullable<ReturnType<typeof decode>>} packet */
  constructor(packet) {
    this.sequence = packet.sequence; // 0 for poses of the past
    this.revision = packet.revision;
    this.count = packet.count;
    this.now = packet.now;
    this.at = packet.at; // null for the present
    this.oldest = packet.oldest;
    this.newest = packet.newest;
    this.numbers = packet.numbers;
  }

  /** Pose of frame `index` in its parent, numbers in a fresh array; NaN without data. */
  relative(index) {
    const start = index * FIELDS;
    return Array.from(this.numbers.subarray(start, start + 7));
  }

  newestOf(index) {
    return this.numbers[index * FIELDS + 7];
  }

  oldestOf(index) {
    return this.numbers[index * FIELDS + 8];
  }

  rateOf(index) {
    return this.numbers[index * FIELDS + 9];
  }

  samplesOf(index) {
    return this.numbers[index * FIELDS + 10];
  }
}

/**
 * Whether every frame is where it was: at the same moment, or in the present both times.
 * @param {Poses} one
 * @param {Poses | null} other
 */
export function same(one, other) {
  if (!other || one.at !== other.at || one.revision !== other.revision) return false;
  for (let start = 0; start < one.numbers.length; start += FIELDS) {
    for (let at = start; at < start + 7; at++) if (!Object.is(one.numbers[at], other.numbers[at])) return false;
  }
  return true;
}

export class Wire {
  /**
   * Handlers: open(), ended(reason), heard(), whenever something comes; names(message),
   *  pair(message), range(message), poses(Poses),
   *  tracks(tracks, packed, whole), messages that are drawn; series(message), marks(message),
   *  robot(message), its shapes, joints and sliders; trails(message), where frames were;
   *  past(Poses), which are drawn nowhere but in trails.
   */
  constructor(handlers) {
    this.handlers = handlers;
    this.wanted = new Map(); // what to say again after a reconnection, by type
    this.socket = this.connect();
  }

  connect() {
    const socket = new WebSocket(`ws://${location.host}${secured("/frames")}`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      for (const message of this.wanted.values()) socket.send(message);
      this.handlers.open();
    };
    socket.onmessage = ({ data }) => {
      this.handlers.heard();
      if (typeof data === "string") {
        const message = JSON.parse(data);
        const name = message.type === "frames" ? "names" : message.type;
        if (name === "tracks") this.fetchTracks();
        else this.handlers[name]?.(message);
        return;
      }
      if (isBlock(data)) {
        const { header, bytes } = open(data);
        this.handlers.tracks(header.tracks ?? [], new Packed(header, bytes), false);
        return;
      }
      const packet = decode(data);
      if (packet) this.handlers[packet.sequence ? "poses" : "past"](new Poses(packet));
    };
    socket.onclose = ({ code, reason }) => {
      this.handlers.ended({ code, reason });
      setTimeout(() => (this.socket = this.connect()), RETRY);
    };
    return socket;
  }

  /** Fetch the messages of a recording that are drawn. */
  async fetchTracks() {
    const answer = await fetch(secured("tracks"));
    if (!answer.ok) return;
    const { header, bytes } = await inflated(await answer.blob());
    this.handlers.tracks(header.tracks ?? [], new Packed(header, bytes), true);
  }

  /** Say something now, and again whenever the connection is made anew. */
  want(type, fields) {
    const message = JSON.stringify({ type, ...fields });
    this.wanted.set(type, message);
    this.send(message);
  }

  /**
   * Ask where frames were.
   * @param {import("./past.js").Asked} asked
   */
  trails(asked) {
    this.send(JSON.stringify({ type: "trails", ...asked }));
  }

  got(sequence) {
    this.send(JSON.stringify({ type: "got", sequence }));
  }

  /** Put a joint elsewhere. */
  move(joint, position) {
    this.send(JSON.stringify({ type: "move", joint, position }));
  }

  /** Drive the turtle of a world that has one: "up", "down", "left" or "right". */
  press(key) {
    this.send(JSON.stringify({ type: "key", key }));
  }

  /** Ask for poses from all over the buffer. */
  past() {
    this.send(JSON.stringify({ type: "past" }));
  }

  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(message);
  }
}
