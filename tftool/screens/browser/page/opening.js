// @ts-check
// Opening view if the user has chosen nothing yet: a pair, a camera, trails.

const FOLLOWER = "turtle2";
const LED = ["carrot1", "turtle1"]; // frames that turtle2 follows, the first that exists
const TRAILED = 12; // moving frames; more trails would be a tangle
const WHOLE = 3; // frames that move, of a robot with its odometry and a correction of it
const FLAT = 1e-3; // of the world's size, at most, off the plane
const LEVEL = 1e-3; // sine of half the angle out of the plane

/**
 * The most informative pair: turtle2 and the frame it follows, as in the tutorial; else the end of
 * the longest moving chain, in its root. Null if no tree has two frames.
 * @param {import("./model.js").Model} model
 * @returns {{ target: string, source: string } | null}
 */
export function naturalPair(model) {
  const follower = model.index.get(FOLLOWER);
  const led = LED.find((name) => model.index.has(name));
  if (follower !== undefined && led !== undefined && model.rootOf[follower] === model.rootOf[model.index.get(led) ?? -1]) {
    return { target: FOLLOWER, source: led };
  }
  const depths = new Array(model.names.length).fill(0);
  let best = -1;
  let most = [-1, -1, -1];
  for (const index of model.order) {
    const parent = model.parents[index];
    if (parent < 0) continue;
    depths[index] = depths[parent] + 1;
    const rank = [Number(model.moves(index)), Number(!model.children[index].length), depths[index]];
    const at = rank.findIndex((value, place) => value !== most[place]);
    if (at >= 0 && rank[at] > most[at]) [best, most] = [index, rank];
  }
  return best < 0 ? null : { target: model.names[model.rootOf[best]], source: model.names[best] };
}

/**
 * Whether all frames are in one horizontal plane and turn only in it: then a map is enough.
 * @param {(number[] | null)[]} poses in one frame
 */
export function planar(poses) {
  let [low, high, far] = [Infinity, -Infinity, 0];
  for (const pose of poses) {
    if (!pose) continue;
    if (Math.hypot(pose[3], pose[4]) > LEVEL) return false;
    low = Math.min(low, pose[2]);
    high = Math.max(high, pose[2]);
    far = Math.max(far, Math.abs(pose[0]), Math.abs(pose[1]));
  }
  return !(high - low > FLAT * Math.max(1, far));
}

/**
 * Whether moving frames get trails by default: not if there are many.
 * @param {import("./model.js").Model} model
 */
export function trailsPay(model) {
  const moving = movingLinks(model);
  return moving > 0 && moving <= TRAILED;
}

/**
 * Whether the whole path is drawn by default: if few frames move.
 * @param {import("./model.js").Model} model
 */
export function wholePays(model) {
  const moving = movingLinks(model);
  return moving > 0 && moving <= WHOLE;
}

function movingLinks(model) {
  return model.order.filter((index) => model.parents[index] >= 0 && !model.statics[index]).length;
}

/**
 * Whether a frame is a turtle, by the names that turtlesim gives them.
 * @param {string} name
 */
export function isTurtle(name) {
  return /(^|\/)turtle\d+$/.test(name);
}
