// @ts-check
// Whether the picture shows the present.

const STALE = { periods: 30, seconds: 5 };

/** Detector of a server that has stopped sending, although its connection is still open. */
export class Hearing {
  constructor() {
    this.at = 0; // time of the last message, milliseconds
    this.last = 0; // pause before the last message, and the longest recent pause that was not an exception
    this.pause = 0;
  }

  /** @param {number} now */
  heard(now) {
    const pause = now - this.at;
    this.pause = Math.max(Math.min(pause, this.last), 0.99 * this.pause);
    this.last = pause;
    this.at = now;
  }

  /**
   * Start again, and ignore earlier pauses.
   * @param {number} now
   */
  begin(now) {
    this.at = now;
  }

  /**
   * Whether the pause since the last message is longer than the pauses of a running server.
   * @param {number} now
   */
  isOver(now) {
    return now - this.at > Math.max(1000 * STALE.seconds, STALE.periods * this.pause);
  }
}

/**
 * State of the data: "wait" before the first data, "gone" without a server, "silent" if the server sends nothing, "stale" if the
 * server repeats the same data although its time advances, "stored" for a saved page, "past" for a past time, "live".
 * @param {"wait" | "open" | "silent" | "ended" | "stored"} connection
 * @param {import("./model.js").Model} model
 * @param {boolean} past whether a past time is shown
 * @returns {"wait" | "stored" | "gone" | "silent" | "stale" | "past" | "live"}
 */
export function freshness(connection, model, past) {
  if (connection !== "open") return connection === "ended" ? "gone" : connection;
  if (past) return "past";
  return isStale(model) ? "stale" : "live";
}

/** Whether frames move, but none of them has a recent sample. */
function isStale(model) {
  const { poses } = model;
  if (!poses || poses.at !== null || poses.count !== model.names.length) return false;
  let rate = 0; // period of the fastest frame; a frame with one sample is never late
  for (let index = 0; index < poses.count; index++) {
    if (model.parents[index] < 0 || model.statics[index] || poses.samplesOf(index) < 2) continue;
    rate = Math.max(rate, poses.rateOf(index));
  }
  return rate > 0 && model.unheard() > Math.max(STALE.seconds, STALE.periods / rate);
}
