// @ts-check
// The view as part of the page's address, so that a link reproduces the view.

const NUMBERS = ["scale", "interval", "timeout", "length", "speed", "at", "opacity", "side"];
const WORDS = ["fixed", "target", "source", "pair", "chosen", "only", "not", "view", "theme", "plot", "followed"];
const SWITCHES = ["names", "axes", "arrows", "grid", "trails", "visuals", "collisions", "jointaxes", "through", "whole", "play"];
const LISTS = ["hidden", "closed", "trailed", "bare", "undrawn"];

/** Read the address; missing or invalid values are left out. */
export function read(hash) {
  const said = new URLSearchParams(hash.replace(/^#/, ""));
  const state = {};
  for (const key of NUMBERS) {
    const value = Number.parseFloat(said.get(key) ?? "");
    if (Number.isFinite(value)) state[key] = value;
  }
  for (const key of WORDS) if (said.has(key)) state[key] = said.get(key);
  for (const key of SWITCHES) if (said.has(key)) state[key] = said.get(key) === "1";
  for (const key of LISTS) if (said.has(key)) state[key] = said.getAll(key);
  const camera = (said.get("camera") ?? "").split(",").map(Number);
  if (camera.length === 7 && camera.every(Number.isFinite) && camera[6] > 0) state.camera = camera;
  return state;
}

export function write(state) {
  const said = new URLSearchParams();
  for (const key of NUMBERS) if (Number.isFinite(state[key])) said.set(key, String(+state[key].toPrecision(12)));
  for (const key of WORDS) if (state[key]) said.set(key, state[key]);
  for (const key of SWITCHES) if (state[key] !== undefined) said.set(key, state[key] ? "1" : "0");
  for (const key of LISTS) for (const name of state[key] ?? []) said.append(key, name);
  if (state.camera) said.set("camera", state.camera.join(","));
  return `#${said}`;
}

/** File name of a saved live page. */
export const FILE = "tftool-view.html";

/**
 * Link to a page, and where the link works: everywhere ("web"); for those who have the file, in any
 * folder ("file"); on this machine while tftool runs ("here"); or nowhere ("none").
 * @param {string} href the page's own address
 * @param {string} hash the view
 * @returns {{ text: string, reach: "web" | "file" | "here" | "none" }}
 */
export function linkTo(href, hash) {
  const { protocol, hostname, pathname } = new URL(href);
  if (protocol === "file:") return { text: pathname.slice(pathname.lastIndexOf("/") + 1) + hash, reach: "file" };
  if (!/^https?:$/.test(protocol)) return { text: "", reach: "none" };
  const here = hostname === "localhost" || hostname === "127.0.0.1";
  return { text: href.replace(/#.*$/s, "") + hash, reach: here ? "here" : "web" };
}

/**
 * Sentence about the shared link.
 * @param {"web" | "file" | "here" | "none"} reach
 * @param {boolean} copied whether the link is on the clipboard
 */
export function told(reach, copied) {
  if (reach === "here") return `Saved as ${FILE}, which opens anywhere.${copied ? " A link for this machine is copied." : ""}`;
  if (!copied) return reach === "none" ? "This view has no address of its own" : "The link to this view is in the address bar";
  return reach === "file" ? "Copied: the file's name with this view, for those who have the file" : "Link to this view copied";
}

/** Write the view to the page's own address, if it has one. */
export function showAddress(hash) {
  try {
    history.replaceState(null, "", hash);
  } catch {
    // A page in a notebook's output has no address.
  }
}
