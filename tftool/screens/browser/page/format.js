// @ts-check
// Numbers as text.

/**
 * Number with fixed decimals; a dash if unknown.
 * @param {number | null} value
 * @param {number} digits
 */
export function number(value, digits) {
  if (value === null || !Number.isFinite(value)) return "–";
  const text = Math.abs(value) >= 1e7 ? value.toExponential(3) : value.toFixed(digits);
  return /^-0(\.0*)?$/.test(text) ? text.slice(1) : text;
}

/**
 * Text in place of the rate of a frame in the model's `statics`.
 * @param {number} still 1 for a static frame, 2 for a frame that only a slider moves
 */
export const stillness = (still) => (still === 2 ? "joint" : "static");

const LONG = 20; // characters; a longer name may not fit beside the rate
const TAIL = 12;

/**
 * Split a name into two parts; the second part is always visible, as names of one device differ
 * at the end. Only left-to-right text of simple characters is split.
 * @param {string} name
 */
export const halves = (name) =>
  name.length > LONG && /^[!-~]+$/.test(name) ? [name.slice(0, -TAIL), name.slice(-TAIL)] : [name];
