// @ts-check
// Round lengths: the grid's cells and the scale bar.

const CELL = 34; // smallest width of a cell, pixels
const PARTS = 4; // parts of a line, each more faded than the part before

/**
 * The smallest of 1, 2, 5, 10, 20, … that is at least a length.
 * @param {number} length
 */
export function round(length) {
  if (!(length > 0) || !Number.isFinite(length)) return 1;
  const ten = 10 ** Math.floor(Math.log10(length) + 1e-9);
  for (const step of [1, 2, 5]) if (step * ten >= length * (1 - 1e-9)) return tidy(step * ten);
  return tidy(10 * ten);
}

const tidy = (value) => Number(value.toPrecision(12));

/**
 * Width of a grid cell: a power of ten, or a half or a fifth of a power of ten.
 * @param {number} pixel metres
 */
export function cellFor(pixel) {
  return round(CELL * pixel);
}

/**
 * A length as text, in a suitable unit.
 * @param {number} metres
 */
export function spelled(metres) {
  if (metres >= 1000) return `${tidy(metres / 1000)} km`;
  if (metres >= 1) return `${tidy(metres)} m`;
  return metres >= 0.01 ? `${tidy(metres * 100)} cm` : `${tidy(metres * 1000)} mm`;
}

/**
 * The lines of a grid of `count` cells to every side of its centre, fading towards its edge unless
 * it is flat. Every tenth is strong; the ones through the origin are axes.
 * @param {number[]} centre
 * @param {number} cell
 * @param {number} count
 * @param {boolean} [flat]
 * @returns {{ from: number[], to: number[], kind: "x" | "y" | "strong" | "weak", faded: [number, number] }[]}
 */
export function linesOf(centre, cell, count, flat = false) {
  const lines = [];
  const half = count * cell;
  const parts = flat ? 1 : PARTS;
  for (const side of [0, 1]) {
    const first = Math.round(centre[side] / cell);
    for (let at = first - count; at <= first + count; at++) {
      const across = at * cell;
      // A line at constant y is the x axis, where y is 0.
      const kind = at === 0 ? (side === 1 ? "x" : "y") : at % 10 === 0 ? "strong" : "weak";
      const off = Math.abs(at - first) / count;
      const along = centre[1 - side];
      for (let part = -parts; part < parts; part++) {
        const alpha = (/** @type {number} */ end) => (flat ? 1 : Math.max(0, 1 - Math.hypot(off, end / parts) ** 2));
        const faded = /** @type {[number, number]} */ ([alpha(part), alpha(part + 1)]);
        if (!faded[0] && !faded[1]) continue;
        const ends = [part, part + 1].map((end) => along + (end / parts) * half);
        const [from, to] = ends.map((end) => (side === 1 ? [end, across] : [across, end]));
        lines.push({ from, to, kind, faded });
      }
    }
  }
  return /** @type {any} */ (lines);
}
