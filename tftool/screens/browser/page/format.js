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
