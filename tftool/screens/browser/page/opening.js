// @ts-check
// What a view opens with where a person has chosen nothing yet: a pair, a way to look, trails.

const FOLLOWER = "turtle2";
const LED = ["carrot1", "turtle1"]; // what it follows, the first that there is
const TRAILED = 12; // frames that move; more trails than that are a tangle
const WHOLE = 3; // frames that move, of a robot with its odometry and a correction of it
const FLAT = 1e-3; // of the world's size, at most, off the plane
const LEVEL = 1e-3; // sine of half the angle out of the plane

/**
 * The pair that says most: what turtle2 follows, as in the tutorial; else the frame at the end of
 * the longest chain that moves, in the root above it. Null where there are no two frames in one tree.
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
 * Whether all frames lie in one level plane, and turn in it only: then a map says everything.
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
 * Whether what moves leaves trails unasked: not in a crowd.
 * @param {import("./model.js").Model} model
 */
export function trailsPay(model) {
  const moving = movingLinks(model);
  return moving > 0 && moving <= TRAILED;
}

/**
 * Whether the whole path is drawn unasked: where little moves, it is the picture.
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
