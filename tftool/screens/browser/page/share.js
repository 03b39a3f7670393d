// @ts-check
// The view as part of the page's address, so that a link shows just this.

const NUMBERS = ["scale", "interval", "timeout", "length", "speed", "at", "opacity"];
const WORDS = ["fixed", "target", "source", "chosen", "only", "not", "view", "theme"];
const SWITCHES = ["names", "axes", "arrows", "grid", "trails", "visuals", "collisions", "jointaxes"];
const LISTS = ["hidden", "closed", "trailed", "bare"];

/** Read the address; what is missing or makes no sense is left out. */
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
  for (const key of SWITCHES) said.set(key, state[key] ? "1" : "0");
  for (const key of LISTS) for (const name of state[key] ?? []) said.append(key, name);
  if (state.camera) said.set("camera", state.camera.join(","));
  return `#${said}`;
}
