// @ts-check
// Whether what is shown is of now.

const STALE = { periods: 30, seconds: 5 };

/**
 * "wait" before anything came, "gone" without a server, "stale" where a server sends the same again
 * and again although its time goes on, "stored" where all there is is in the page, "past" and "live".
 * @param {"wait" | "open" | "ended" | "stored"} connection
 * @param {import("./model.js").Model} model
 * @param {boolean} past whether a moment of the past is looked at
 * @returns {"wait" | "stored" | "gone" | "stale" | "past" | "live"}
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
