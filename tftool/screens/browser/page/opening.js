// @ts-check
// Opening view if the user has chosen nothing yet: a pair, a camera, trails.

const FOLLOWER = "turtle2";
const LED = ["carrot1", "turtle1"]; // turtle2 follows the first of these frames that exists
const TRAILED = 12; // largest number of moving frames with trails
const WHOLE = 3; // largest number of moving frames with whole trails, as map, odom and base_link
const FLAT = 1e-3; // largest distance from the plane, as a share of the world's size
const LEVEL = 1e-3; // sine of half the angle out of the plane

/**
 * The most informative pair: turtle2 and the frame that turtle2 follows, as in the tutorial; else the
 * last frame of the longest moving chain, in the root of the chain. Null if no tree has two frames.
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
 * Whether all frames are in one horizontal plane and turn only in this plane, so that a view from above is enough.
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
 * Whether moving frames get trails by default: only if there are few moving frames.
 * @param {import("./model.js").Model} model
 */
export function trailsPay(model) {
  const moving = movingLinks(model);
  return moving > 0 && moving <= TRAILED;
}

/**
 * Whether trails are whole paths by default: only if very few frames move.
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
 * Whether a frame has a name that turtlesim gives to turtles.
 * @param {string} name
 */
export function isTurtle(name) {
  return /(^|\/)turtle\d+$/.test(name);
}
