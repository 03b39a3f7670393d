// @ts-check
// Whether what is shown is of now.

const STALE = { periods: 30, seconds: 5 };

/** Whether a server still speaks: one that is stopped, or hangs, keeps its connection. */
export class Hearing {
  constructor() {
    this.at = 0; // when it was heard last, milliseconds
    this.last = 0; // the pause before that, and the longest of late that did not come alone
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
   * Begin anew, where what was not heard says nothing.
   * @param {number} now
   */
  begin(now) {
    this.at = now;
  }

  /**
   * Whether it has said nothing for longer than one that runs would.
   * @param {number} now
   */
  isOver(now) {
    return now - this.at > Math.max(1000 * STALE.seconds, STALE.periods * this.pause);
  }
}

/**
 * "wait" before anything came, "gone" without a server, "silent" where one says nothing, "stale" where a server sends the same again
 * and again although its time goes on, "stored" where all there is is in the page, "past" and "live".
 * @param {"wait" | "open" | "silent" | "ended" | "stored"} connection
 * @param {import("./model.js").Model} model
 * @param {boolean} past whether a moment of the past is looked at
 * @returns {"wait" | "stored" | "gone" | "silent" | "stale" | "past" | "live"}
 */
export function freshness(connection, model, past) {
  if (connection !== "open") return connection === "ended" ? "gone" : connection;
  if (past) return "past";
  return isStale(model) ? "stale" : "live";
}

/** Whether there are links that move, and not one of them has had a sample lately. */
function isStale(model) {
  const { poses } = model;
  if (!poses || poses.at !== null || poses.count !== model.names.length) return false;
  let rate = 0; // of the link that comes most often; one that came but once does not come late
  for (let index = 0; index < poses.count; index++) {
    if (model.parents[index] < 0 || model.statics[index] || poses.samplesOf(index) < 2) continue;
    rate = Math.max(rate, poses.rateOf(index));
  }
  return rate > 0 && model.unheard() > Math.max(STALE.seconds, STALE.periods / rate);
}
