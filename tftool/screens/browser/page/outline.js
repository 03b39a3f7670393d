// @ts-check
// Visible rows of the nested list, and moves between them by keys.

/**
 * @typedef {{ children: number[][], parents: number[], order: number[], roots: number[], looped: number[] }} Forest
 */

/**
 * The frames of the list from top to bottom, each with its depth, from 1.
 * @param {Forest} forest
 * @returns {{ index: number, level: number }[]}
 */
export function listed({ children, roots, looped }) {
  const rows = [];
  const seen = new Set();
  const waiting = [...roots, ...looped].reverse().map((index) => ({ index, level: 1 }));
  // With a stack and not by recursion: a chain may be thousands of frames long.
  for (let row = waiting.pop(); row; row = waiting.pop()) {
    const { index, level } = row;
    if (seen.has(index)) continue;
    seen.add(index);
    rows.push(row);
    for (const child of [...children[index]].reverse()) waiting.push({ index: child, level: level + 1 });
  }
  return rows;
}

/**
 * Rows that a filter shows: matching frames, and their ancestors, which show the place in the tree.
 * @param {Forest} forest
 * @param {(index: number) => boolean} matches
 * @returns {Set<number>}
 */
export function kept({ parents, children }, matches) {
  const left = new Set();
  children.forEach((_, index) => {
    if (!matches(index)) return;
    for (let at = index; at >= 0 && !left.has(at); at = parents[at]) left.add(at);
  });
  return left;
}

/**
 * Row to which a key moves in a list of visible rows, as in a desktop's tree.
 * @param {string} key
 * @param {number} from index of a frame
 * @param {{ visible: number[], parents: number[], opened: (index: number) => boolean | null }} list
 *   opened: null for a row without children
 * @returns {{ go?: number, open?: boolean } | null} null if the key has no effect
 */
export function led(key, from, { visible, parents, opened }) {
  const place = visible.indexOf(from);
  const step = (by) => ({ go: visible[Math.max(0, Math.min(visible.length - 1, place + by))] });
  if (key === "ArrowDown") return step(1);
  if (key === "ArrowUp") return step(-1);
  if (key === "PageDown") return step(10);
  if (key === "PageUp") return step(-10);
  if (key === "Home") return { go: visible[0] };
  if (key === "End") return { go: visible[visible.length - 1] };
  const open = opened(from);
  if (key === "ArrowRight") {
    if (open === null) return {};
    return open ? step(1) : { open: true };
  }
  if (key === "ArrowLeft") {
    if (open) return { open: false };
    return parents[from] >= 0 ? { go: parents[from] } : {};
  }
  return null;
}
