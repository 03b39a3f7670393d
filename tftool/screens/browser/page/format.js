// @ts-check
// Numbers as text.

/**
 * A number with fixed decimals; a dash for what is not known.
 * @param {number | null} value
 * @param {number} digits
 */
export function number(value, digits) {
  if (value === null || !Number.isFinite(value)) return "–";
  const text = Math.abs(value) >= 1e7 ? value.toExponential(3) : value.toFixed(digits);
  return /^-0(\.0*)?$/.test(text) ? text.slice(1) : text;
}

/**
 * What is said in place of a rate of a frame that the model's `statics` holds.
 * @param {number} still 1 where nothing moves it, 2 where its slider alone does
 */
export const stillness = (still) => (still === 2 ? "joint" : "static");

const LONG = 20; // characters; a name as long as this may have no room beside what is told of it
const TAIL = 12;

/**
 * A name in two parts, of which the second is always to be seen: names of a device differ at
 * their ends. Only what is written from left to right, a character a place, is parted.
 * @param {string} name
 */
export const halves = (name) =>
  name.length > LONG && /^[!-~]+$/.test(name) ? [name.slice(0, -TAIL), name.slice(-TAIL)] : [name];
