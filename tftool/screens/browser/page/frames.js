// @ts-check
// Appearance of every frame in picture and list, from the model and the choices.
import { number } from "./format.js";
import { fade } from "./model.js";

const MOST_TRAILS = 60;
const HUES = [207, 332, 140, 32, 268, 180, 354, 80, 238, 300];
// Samples of a frame are late after this number of periods, and at least this time; then the frame becomes red.
const LATE = { periods: 3, seconds: 1 };
const BESIDE = 0.4; // opacity of frames outside of the chain
const DEAD = { periods: 10, seconds: 5 };

/**
 * pose, parent: poses of the frame and its parent in the fixed frame, null if unknown. grey, alpha:
 * degree of fading. shown: whether the frame is in the picture. trouble: why the frame has no pose.
 * told: rate or age as text. late: "late" or "dead" if data stopped. color: colour of the name in the
 * list and of the trail. dim: opacity; 1, or less outside of the pair's chain.
 * @typedef {{
 *   index: number, name: string, pose: number[] | null, parent: number[] | null,
 *   grey: number, alpha: number, filtered: boolean, shown: boolean, lost: boolean,
 *   trouble: string, told: string, late: string, color: string, dim: number,
 * }} Frame
 */

/**
 * Colour of a frame; the first frames get the colours that differ most.
 * @param {number} place of the frame, see `placesOf`
 * @param {string} theme
 */
export function colorOf(place, theme) {
  // After the last hue, the hues repeat in another tone.
  const tone = [0, -14, 10][Math.floor(place / HUES.length) % 3];
  // With commas, because three.js parses no other notation.
  return `hsl(${HUES[place % HUES.length]}, 85%, ${(theme === "dark" ? 66 : 45) + tone}%)`;
}

/**
 * Lateness of a frame: "" while samples arrive, then "late", then "dead".
 * @param {number} age seconds since the newest sample
 * @param {number} rate samples per second; 0 if unknown
 */
export function lateness(age, rate) {
  const beyond = ({ periods, seconds }) => age > Math.max(seconds, rate > 0 ? periods / rate : 0);
  if (beyond(DEAD)) return "dead";
  return beyond(LATE) ? "late" : "";
}

/**
 * @param {import("./model.js").Model} model solved for the fixed frame
 * @param {import("./choices.js").Choices} choices
 * @param {boolean} past whether a past moment is shown
 * @param {{ found: boolean, chain: string[] } | null} pair
 * @returns {Frame[]}
 */
export function describe(model, choices, past, pair = null) {
  const along = pair?.found ? new Set(pair.chain) : null;
  return model.names.map((name, index) => {
    const pose = model.absolute[index] ?? null;
    const { grey, alpha } = fade(model.age(index), choices.timeout);
    const filtered = choices.leavesOut(name);
    const parent = model.parents[index];
    const late = lateOf(model, index, past);
    return {
      index,
      name,
      pose,
      parent: parent >= 0 ? (model.absolute[parent] ?? null) : null,
      grey,
      alpha,
      filtered,
      shown: pose !== null && !filtered && !choices.hidden.has(name) && alpha > 0,
      lost: pose === null,
      trouble: pose === null ? trouble(model, index, choices.fixed, past) : "",
      told: told(model, index, late),
      late,
      dim: !along || along.has(name) || choices.chosen === name ? 1 : BESIDE,
      color: colorOf(model.places.get(name) ?? index, choices.theme),
    };
  });
}

/** Error text for a frame without a pose, worded as in rviz, with the reason if known. */
function trouble(model, index, fixed, past) {
  const refusal = `No transform from [${model.names[index]}] to [${fixed}]`;
  if (!model.index.has(fixed)) return `${refusal}: frame [${fixed}] does not exist`;
  if (model.looped.includes(index)) return `${refusal}: its chain is a loop`;
  return past ? `${refusal} at the moment shown` : refusal;
}

/**
 * Update rates and ages only.
 * @param {import("./model.js").Model} model
 * @param {Frame[]} frames
 * @param {boolean} past whether a past moment is shown
 */
export function retell(model, frames, past) {
  if (frames.length !== model.names.length) return;
  for (const frame of frames) {
    frame.late = lateOf(model, frame.index, past);
    frame.told = told(model, frame.index, frame.late);
  }
}

function lateOf(model, index, past) {
  if (past || !model.poses || model.parents[index] < 0 || model.statics[index]) return "";
  return lateness(model.behind(index), model.poses.rateOf(index));
}

/** Rate of a frame, or its age if samples have stopped. */
function told(model, index, late) {
  const { poses } = model;
  if (!poses || model.parents[index] < 0 || model.statics[index]) return "";
  return late ? `${number(model.behind(index), 1)} s` : `${number(poses.rateOf(index), 0)} Hz`;
}

/**
 * Frames with trails: the chosen ones, and all moving ones if switched on.
 * @param {import("./model.js").Model} model
 * @param {Frame[]} drawn
 * @param {import("./choices.js").Choices} choices
 */
export function trailing(model, drawn, choices) {
  if (!model.poses) return [];
  return drawn
    .filter(({ index, name }) => choices.trailed.has(name) || (choices.trails && leaves(model, index, choices)))
    .slice(0, MOST_TRAILS);
}

/**
 * Trail of a frame up to a time, from stored poses, or from requested poses with more samples.
 * @param {import("./model.js").Model} model
 * @param {Frame} frame
 * @param {import("./choices.js").Choices} choices
 * @param {number} until newest moment, seconds of the session
 * @param {number[][] | null} [fine]
 */
export function trail(model, { index, name, color, pose }, choices, until, fine = null) {
  const length = choices.whole ? Infinity : choices.length;
  const points = fine ? [...fine, ...(pose ? [pose] : [])] : model.trail(index, choices.fixed, length, until);
  return { name, color, points, ahead: /** @type {number[][]} */ ([]), whole: choices.whole };
}

/** Whether a frame gets a trail by default, which is so if it moves relative to its parent. */
function leaves(model, index, choices) {
  return model.moves(index) && (choices.byHand.trails || !model.statics[index]);
}

/**
 * Poses along the chain of a pair; empty if a pose is unknown.
 * @param {import("./model.js").Model} model
 * @param {{ found: boolean, chain: string[] } | null} pair
 * @returns {number[][]}
 */
export function chain(model, pair) {
  if (!pair?.found || !pair.chain) return [];
  const poses = pair.chain.map((name) => model.absolute[model.index.get(name) ?? -1] ?? null);
  return poses.every((pose) => pose !== null) ? poses : [];
}
