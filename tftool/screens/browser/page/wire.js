// @ts-check
// The connection to the server: decodes messages, and reconnects.
import { FIELD, FIELDS, HEADER, head, MAGIC } from "./messages.js";
import { inflated, isBlock, open, Packed } from "./packed.js";
import { secured } from "./secret.js";

const RETRY = 1000;

/** Decode a binary message; null for anything else. */
export function decode(buffer) {
  if (buffer.byteLength < HEADER) return null;
  const view = new DataView(buffer);
  if (view.getUint32(0) !== MAGIC) return null;
  const found = head(view);
  if (buffer.byteLength !== HEADER + found.count * FIELDS * 8) return null;
  return { ...found, at: Number.isNaN(found.at) ? null : found.at, numbers: new Float64Array(buffer, HEADER) };
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
    return this.numbers[index * FIELDS + FIELD.newest];
  }

  oldestOf(index) {
    return this.numbers[index * FIELDS + FIELD.oldest];
  }

  rateOf(index) {
    return this.numbers[index * FIELDS + FIELD.rate];
  }

  samplesOf(index) {
    return this.numbers[index * FIELDS + FIELD.samples];
  }
}

/**
 * Whether two sets of poses are equal, at the same time or both live.
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
   * Handlers: open(), ended(reason); heard() for every message; names(message), pair(message),
   *  range(message), poses(Poses), series(message), marks(message) for these messages;
   *  tracks(tracks, packed, whole) for drawn messages; robot(message) for a robot's shapes, joints
   *  and sliders; trails(message) for positions of the past; past(Poses) for poses of trails.
   */
  constructor(handlers) {
    this.handlers = handlers;
    /** @type {Map<string, import("./messages.js").Request>} */
    this.wanted = new Map(); // requests to repeat after a reconnection, by type
    this.socket = this.connect();
  }

  connect() {
    const socket = new WebSocket(`ws://${location.host}${secured("/frames")}`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      for (const request of this.wanted.values()) this.send(request);
      this.handlers.open();
    };
    socket.onmessage = ({ data }) => {
      this.handlers.heard();
      if (typeof data === "string") {
        /** @type {import("./messages.js").Answer} */
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

  /** Fetch those messages of a recording that are drawn. */
  async fetchTracks() {
    const answer = await fetch(secured("tracks"));
    if (!answer.ok) return;
    const { header, bytes } = await inflated(await answer.blob());
    this.handlers.tracks(header.tracks ?? [], new Packed(header, bytes), true);
  }

  /**
   * Send a request now, and again after each reconnection.
   * @param {import("./messages.js").Request} request
   */
  want(request) {
    this.wanted.set(request.type, request);
    this.send(request);
  }

  /**
   * Request poses of the past.
   * @param {import("./past.js").Asked} asked
   */
  trails(asked) {
    this.send({ type: "trails", ...asked });
  }

  got(sequence) {
    this.send({ type: "got", sequence });
  }

  /** Move a joint. */
  move(joint, position) {
    this.send({ type: "move", joint, position });
  }

  /** Drive the turtle, if the world has a turtle. */
  press(key) {
    this.send({ type: "key", key });
  }

  /** Request poses from the whole buffer. */
  past() {
    this.send({ type: "past" });
  }

  /** @param {import("./messages.js").Request} request */
  send(request) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(request));
  }
}
