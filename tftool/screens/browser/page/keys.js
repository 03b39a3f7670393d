// @ts-check
// Key bindings: one table for the keyboard and for the help on the page.

/** Key, its control, and the control's action. */
export const KEYS = [
  ["t", "top", "from above"],
  ["s", "side", "from the side"],
  ["e", "front", "from the front"],
  ["o", "orbit", "turn around it"],
  ["f", "fit", "show everything"],
  ["n", "names", "names"],
  ["a", "axes", "axes"],
  ["r", "arrows", "arrows to parents"],
  ["g", "grid", "grid"],
  ["m", "trails", "trails"],
  ["d", "measure", "measure between two points"],
  [" ", "play", "play or pause"],
  ["[", "back", "a little earlier"],
  ["]", "forth", "a little later"],
  ["l", "live", "follow the present"],
  ["p", "panels", "all panels, or the picture alone"],
  ["?", "ask", "this page"],
];

/** Keys of the list of frames and of fields, shown with the others. */
export const OTHERS = [
  ["/", "find a frame"],
  ["↑ ↓ ← →", "drive the turtle; in the list of frames, move through it"],
  ["Enter", "choose the frame"],
  ["Esc", "close, let go of the frame"],
];

/**
 * Control of a key; undefined if the focused element uses the key.
 * @param {{ key: string, ctrlKey?: boolean, metaKey?: boolean, altKey?: boolean }} event
 * @param {"text" | "button" | "other"} focus text: letters are typed; button: space presses it
 * @returns {string | undefined}
 */
export function meant({ key, ctrlKey, metaKey, altKey }, focus) {
  if (ctrlKey || metaKey || altKey || focus === "text") return undefined;
  if (focus === "button" && key === " ") return undefined;
  return KEYS.find(([letter]) => letter === key.toLowerCase())?.[1];
}
