// @ts-check
// What picture and list say of every frame, from the model and the choices.
import { number } from "./format.js";
import { fade } from "./model.js";

const MOST_TRAILS = 60;
const HUES = [207, 332, 140, 32, 268, 180, 354, 80, 238, 300];
// A frame is late after so many of its periods, and after so long at least; red a while later.
const LATE = { periods: 3, seconds: 1 };
const BESIDE = 0.4; // how much is left of frames beside the chain
const DEAD = { periods: 10, seconds: 5 };

/**
 * pose, parent: in the fixed frame, null where not known or without a parent. grey, alpha: how far
 * it has faded. shown: whether it is in the picture. trouble: why it cannot be. told: rate or age.
 * late: "late" or "dead" where data stopped coming. color: its own, in the list and of its trail.
 * dim: 1, and less beside the pair's chain.
 * @typedef {{
 *   index: number, name: string, pose: number[] | null, parent: number[] | null,
 *   grey: number, alpha: number, filtered: boolean, shown: boolean, lost: boolean,
 *   trouble: string, told: string, late: string, color: string, dim: number,
 * }} Frame
 */

/**
 * A frame's own colour: the first frames get those that differ most.
 * @param {number} place of the frame, see `placesOf`
 * @param {string} theme
 */
export function colorOf(place, theme) {
  // Where all hues are given out, they come again in another tone.
  const tone = [0, -14, 10][Math.floor(place / HUES.length) % 3];
  // With commas: three reads no other way of writing it.
  return `hsl(${HUES[place % HUES.length]}, 85%, ${(theme === "dark" ? 66 : 45) + tone}%)`;
}

/**
 * How late a link is: "" while its samples come, then "late", then "dead".
 * @param {number} age seconds since its newest sample
 * @param {number} rate its samples a second; 0 where it is not known
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

/** Why there is no pose, in rviz's words, with the reason where there is one. */
function trouble(model, index, fixed, past) {
  const refusal = `No transform from [${model.names[index]}] to [${fixed}]`;
  if (!model.index.has(fixed)) return `${refusal}: frame [${fixed}] does not exist`;
  if (model.looped.includes(index)) return `${refusal}: its chain is a loop`;
  return past ? `${refusal} at the moment shown` : refusal;
}

/**
 * Bring rates and ages up to date, and nothing else.
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

/** How often a frame comes, or how old it is where it stopped coming. */
function told(model, index, late) {
  const { poses } = model;
  if (!poses || model.parents[index] < 0 || model.statics[index]) return "";
  return late ? `${number(model.behind(index), 1)} s` : `${number(poses.rateOf(index), 0)} Hz`;
}

/**
 * The frames that leave trails: those chosen for one, and all that move if switched on.
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
 * A frame's trail up to a moment, from poses the page has kept, or finer ones where those are known.
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

/** Whether a frame moves; unasked, what is mounted on something that moves leaves no trail beside it. */
function leaves(model, index, choices) {
  return model.moves(index) && (choices.byHand.trails || !model.statics[index]);
}

/**
 * The poses along a found pair's chain; none where one of them is not known.
 * @param {import("./model.js").Model} model
 * @param {{ found: boolean, chain: string[] } | null} pair
 * @returns {number[][]}
 */
export function chain(model, pair) {
  if (!pair?.found || !pair.chain) return [];
  const poses = pair.chain.map((name) => model.absolute[model.index.get(name) ?? -1] ?? null);
  return poses.every((pose) => pose !== null) ? poses : [];
}
