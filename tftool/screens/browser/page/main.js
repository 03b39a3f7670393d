// The page: keeps the state, hears the server, draws when something has changed.
import { fade, Model } from "./model.js";
import { number, showFrame, showPair } from "./panels.js";
import { Stage } from "./scene.js";
import { read, write } from "./share.js";
import { Tree } from "./tree.js";
import { Wire } from "./wire.js";

const $ = (id) => document.getElementById(id);
const LISTS_EVERY = 150; // milliseconds between two refreshes of the lists
const STEP = 0.1; // seconds one press of [ or ] goes
const MOST_TRAILS = 60;
const HUES = [207, 332, 140, 32, 268, 180, 354, 80, 238, 300];

const given = read(location.hash);
const state = {
  names: true,
  axes: true,
  arrows: true,
  grid: true,
  trails: false,
  view: "top",
  interval: 0,
  timeout: 15,
  length: 10,
  speed: 1,
  only: "",
  not: "",
  ...given,
  hidden: new Set(given.hidden),
  closed: new Set(given.closed),
  trailed: new Set(given.trailed),
};
if (state.theme !== "light" && state.theme !== "dark") {
  state.theme = matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark";
}
if (state.view !== "orbit") state.view = "top";
state.timeout = Math.max(1, state.timeout);

const model = new Model();
const stage = new Stage($("under"), $("main"), $("over"));
const tree = new Tree($("tree"), {
  choose: (name) => choose(state.chosen === name ? null : name),
  toggle: (name, shown) => {
    state.hidden[shown ? "delete" : "add"](name);
    changed();
  },
  fold: (name, closed) => {
    state.closed[closed ? "add" : "delete"](name);
    remember();
  },
});

let connection = "wait"; // wait, open, ended
let pair = null; // the server's last word about the pair
let reach = { oldest: 0, newest: 0, now: 0 };
let at = state.at ?? null; // the moment looked at; null is the present
let playing = at === null;
let asked = false; // a past moment was asked for and has not come yet
let lastDraw = 0; // when the last animation frame was drawn, for playing
let unsaid = 0; // sequence number to be acknowledged once drawn
let ours = !state.camera; // the camera is still ours to move, nobody took it
let seen = null; // the box of everything that was drawn so far
let listsAt = 0;
let dirty = true;
let touched = true; // by a person, not by the server
let drawnAt = -Infinity;
let filters = { only: null, not: null };
let drawn = []; // what is on screen: { index, name, pose, … }
let frames = []; // per frame: what the list says of it
let lines = []; // the trails on screen
let extent = 5;

// ---- the server

const wire = new Wire({
  open() {
    connection = "open";
    toast("");
    changed();
  },
  ended() {
    connection = connection === "wait" ? "wait" : "ended";
    asked = false;
    changed();
  },
  names(message) {
    const another = model.setNames(message);
    if (another) goLive();
    tree.build(model, state);
    fillChoices();
    // Trails start with what the buffer remembers; once the tree has come to rest.
    // Once more later: what came while the page was busy starting has gaps.
    askPast.timers?.forEach(clearTimeout);
    askPast.timers = [300, 3000].map((wait) => setTimeout(askPast, wait));
    $("left-out").hidden = model.total <= model.names.length;
    $("left-out").textContent =
      `${model.names.length} of ${model.total} frames shown; those farthest from their root are left out.`;
    listsAt = 0;
  },
  past(poses) {
    model.remember(poses);
    dirty = true;
  },
  pair(message) {
    if (message.target !== state.target || message.source !== state.source) return;
    if (pairOutlived(message)) return;
    pair = message;
  },
  range(message) {
    reach = message;
    dirty = true;
  },
  poses(poses) {
    unsaid = poses.sequence;
    dirty = true;
    reach = { oldest: poses.oldest, newest: poses.newest, now: poses.now };
    if (poses.at === null ? at !== null : at === null) return; // late: we look elsewhere by now
    asked = false;
    if (poses.at !== null && poses.at < poses.oldest && model.poses?.at === poses.at) return;
    model.setPoses(poses, performance.now());
  },
});

function askPast() {
  wire.past();
}

/** Whether a pair's numbers of a moment shown must outlive the buffer's memory of it. */
function pairOutlived(message) {
  return at !== null && !message.found && pair?.found && at < reach.oldest && pair.target === message.target && pair.source === message.source;
}

// ---- time

function goLive() {
  at = null;
  playing = true;
  asked = false;
  wire.want("show", { at: null });
  changed();
}

function goTo(moment) {
  at = moment;
  asked = true;
  wire.want("show", { at });
  changed();
}

/** Come to rest on a moment: never beyond what the buffer holds. */
function scrub(moment) {
  playing = false;
  goTo(Math.min(Math.max(moment, reach.oldest), reach.newest));
}

function playOn(passed) {
  if (at === null || !playing || asked) return;
  const next = Math.max(at, reach.oldest) + passed * model.rate * state.speed;
  if (next >= reach.newest) goLive();
  else goTo(next);
}

// ---- drawing

function changed() {
  dirty = touched = true;
  remember();
}

function matcher(id) {
  const field = $(id);
  try {
    const expression = field.value ? new RegExp(field.value, "u") : null;
    field.setAttribute("aria-invalid", "false");
    return expression;
  } catch (error) {
    field.setAttribute("aria-invalid", "true");
    $("wrong").textContent = error.message;
    $("wrong").hidden = false;
    return filters[id];
  }
}

function solve() {
  if (!model.index.has(state.fixed) && model.roots.length && !state.fixedByHand) {
    state.fixed = biggestRoot();
    $("fixed").value = state.fixed;
  }
  model.solve(state.fixed);
  drawn = [];
  frames = model.names.map((name, index) => {
    const pose = model.absolute[index];
    const { grey, alpha } = fade(model.age(index), state.timeout);
    const filtered = (filters.only && !filters.only.test(name)) || (filters.not && filters.not.test(name)) || false;
    const frame = { index, name, pose, grey, alpha, filtered, lost: !pose, trouble: "", told: "" };
    if (!pose) frame.trouble = trouble(index);
    if (model.poses && model.parents[index] >= 0 && !model.statics[index]) {
      const old = model.poses.now - model.poses.newestOf(index);
      frame.told = old > 1 * model.rate && at === null ? `${number(old, 1)} s` : `${number(model.poses.rateOf(index), 0)} Hz`;
    }
    if (pose && !filtered && !state.hidden.has(name) && alpha > 0) {
      const parent = model.parents[index];
      frame.parent = parent >= 0 ? model.absolute[parent] : null;
      drawn.push(frame);
    }
    return frame;
  });
}

function trouble(index) {
  const name = model.names[index];
  // rviz's words, and the reason where there is one to tell.
  const refusal = `No transform from [${name}] to [${state.fixed}]`;
  if (!model.index.has(state.fixed)) return `${refusal}: frame [${state.fixed}] does not exist`;
  if (model.looped.includes(index)) return `${refusal}: its chain is a loop`;
  return at === null ? refusal : `${refusal} at the moment shown`;
}

/** The root of the tree with the most frames: where a stranger's picture starts. */
function biggestRoot() {
  const sizes = new Map();
  for (const index of model.order) {
    const root = model.rootOf[index];
    sizes.set(root, (sizes.get(root) ?? 0) + 1);
  }
  let best = model.roots[0];
  for (const [root, size] of sizes) if (size > sizes.get(best)) best = root;
  return model.names[best];
}

function trails() {
  if (!model.poses) return [];
  const until = at ?? reach.now;
  const wanted = drawn.filter(({ index, name }) => state.trailed.has(name) || (state.trails && moves(index)));
  return wanted.slice(0, MOST_TRAILS).map(({ index }) => ({
    color: `hsl(${HUES[index % HUES.length]} 85% ${state.theme === "dark" ? 66 : 45}%)`,
    points: model.trail(index, state.fixed, state.length, until),
  }));
}

function moves(index) {
  for (let frame = index; model.parents[frame] >= 0; frame = model.parents[frame]) {
    if (!model.statics[frame]) return true;
  }
  return false;
}

function chain() {
  if (!pair?.found) return [];
  const poses = pair.chain.map((name) => model.absolute[model.index.get(name)] ?? null);
  return poses.includes(null) ? [] : poses;
}

function render(now) {
  requestAnimationFrame(render);
  playOn(Math.min(0.25, (now - lastDraw) / 1000));
  lastDraw = now;
  // Frames keep to the update interval; what a person does shows at once.
  if (!dirty || (!touched && now - drawnAt < state.interval * 1000)) {
    acknowledge();
    return;
  }
  dirty = touched = false;
  // What was drawn before there was anything to draw does not count.
  drawnAt = model.poses?.revision === model.revision ? now : -Infinity;
  solve();
  stage.resize();
  if (drawn.length) extent = Math.max(...drawn.map(({ pose }) => Math.max(Math.abs(pose[0]), Math.abs(pose[1]))), 1);
  lines = trails();
  if (ours && outgrown()) fit(seen);
  picture();
  if (now - listsAt > LISTS_EVERY) {
    listsAt = now;
    tree.refresh(frames, state);
    words();
  } else {
    clearTimeout(render.later);
    render.later = setTimeout(() => {
      listsAt = 0;
      dirty = true;
    }, LISTS_EVERY);
  }
  acknowledge();
}

/** Tell the server that what it sent is dealt with, so that it sends what is newest then. */
function acknowledge() {
  if (unsaid) wire.got(unsaid);
  unsaid = 0;
}

function picture() {
  const scale = 10 ** Number($("scale").value);
  stage.draw(drawn, { ...state, scale, extent });
  const special = new Set([state.chosen, ...(pair?.found ? [pair.source, pair.target] : [])]);
  const labels = drawn
    .filter(({ name }) => state.names || special.has(name))
    .map(({ name, pose, alpha, grey }) => ({ name, pose, alpha, grey, first: special.has(name) }))
    .sort((one, other) => other.first - one.first);
  stage.drawUnder(lines);
  const chosen = model.index.get(state.chosen);
  stage.drawOver(labels, chain(), chosen === undefined ? null : model.absolute[chosen]);
}

/** Everything on the page that is words and numbers. */
function words() {
  const past = at !== null;
  document.body.classList.toggle("past", past);
  const [status, text] =
    connection === "open" ? (past ? ["past", playing ? "replay" : "past"] : ["live", "live"])
    : connection === "ended" ? ["ended", "session ended, waiting for it to come back"]
    : ["wait", "connecting"];
  $("status").dataset.state = status;
  if ($("status").textContent !== text) $("status").textContent = text;

  $("count").textContent = model.names.length ? String(model.names.length) : "";
  $("all").checked = state.hidden.size === 0;
  const missing = state.fixed && model.names.length && !model.index.has(state.fixed);
  $("empty").hidden = connection === "wait" ? false : model.names.length > 0 && !missing;
  $("empty").textContent =
    connection === "wait" ? "Connecting to the session…"
    : missing ? `Frame [${state.fixed}] does not exist.\nChoose another fixed frame.`
    : "No tf data.  Actual error: no frame exists yet.\nFrames appear here as soon as somebody broadcasts a transform.";

  const index = model.index.get(state.chosen);
  $("facts").hidden = index === undefined;
  if (index !== undefined) {
    showFrame(model, index, state.fixed, frames[index]?.lost ? frames[index].trouble : "");
    $("with-trail").setAttribute("aria-pressed", String(state.trailed.has(state.chosen)));
  }
  showPair(pair);

  const { oldest, newest } = reach;
  const line = $("scrub");
  if (!line.matches(":active")) {
    line.min = String(oldest);
    line.max = String(newest);
    line.value = String(at ?? newest);
  }
  line.disabled = newest <= oldest;
  const left = past && at < oldest;
  $("moment").textContent =
    past ? `${number(at, 3)} s (${number(at - newest, 2)})${left ? ", left the buffer" : ""}`
    : `${number(reach.now, 2)} s, buffer ${number(newest - oldest, 1)} s`;
  $("live").setAttribute("aria-pressed", String(!past));
  const label = playing ? "Pause" : "Play";
  if ($("play").getAttribute("aria-label") !== label) {
    $("play").setAttribute("aria-label", label);
    $("play").textContent = playing ? "❚❚" : "▶";
  }
}

/** Whether something drawn left the box of all that was drawn before; the box grows with it. */
function outgrown() {
  if (!drawn.length) return false;
  const now = boxOf([...drawn.map(({ pose }) => pose), ...lines.flatMap(({ points }) => points)]);
  if (seen && now.low.every((value, side) => value >= seen.low[side]) && now.high.every((value, side) => value <= seen.high[side])) {
    return false;
  }
  // Somewhat further at once, lest the camera creeps along with every step.
  const most = Math.max(...now.high.map((value, side) => value - now.low[side]), 0.5);
  const old = seen ?? now;
  seen = {
    low: now.low.map((value, side) => (value < old.low[side] ? value - 0.1 * most : old.low[side])),
    high: now.high.map((value, side) => (value > old.high[side] ? value + 0.1 * most : old.high[side])),
  };
  return true;
}

function boxOf(poses) {
  const box = { low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] };
  for (const pose of poses) {
    for (let side = 0; side < 3; side++) {
      box.low[side] = Math.min(box.low[side], pose[side]);
      box.high[side] = Math.max(box.high[side], pose[side]);
    }
  }
  return box;
}

function fit(box) {
  const side = (id) => ($(id).offsetParent ? $(id).getBoundingClientRect() : null);
  const left = side("left");
  const right = side("right");
  stage.fit(box, {
    left: left && innerWidth > 640 ? left.right : 0,
    right: right && innerWidth > 640 ? innerWidth - right.left : 0,
    top: $("bar").getBoundingClientRect().bottom,
    bottom: 80,
  });
  if (state.scale === undefined) {
    const spread = Math.max(...box.high.map((value, at) => value - box.low[at]), 0.5);
    // Axes a twentieth of the scene: rviz's 1 suits a room, not a gripper nor a field.
    // Smaller in a crowd.
    const crowd = Math.max(1, Math.cbrt(drawn.length / 12));
    setScale(Math.min(100, Math.max(0.01, spread / 4 / crowd)));
  }
}

// ---- choices

function fillChoices() {
  const wanted = { fixed: state.fixed, target: state.target, source: state.source };
  for (const [id, value] of Object.entries(wanted)) {
    const options = model.names.map((name) => new Option(name, name));
    // What is asked for stays choosable while it does not exist.
    if (value !== undefined && !model.index.has(value)) options.unshift(new Option(value, value));
    if (id !== "fixed") options.unshift(new Option("choose…", ""));
    $(id).replaceChildren(...options);
    $(id).value = value ?? "";
  }
}

function choose(name) {
  state.chosen = name ?? undefined;
  listsAt = 0;
  changed();
}

function setPair(target, source) {
  Object.assign(state, { target: target || undefined, source: source || undefined });
  $("target").value = state.target ?? "";
  $("source").value = state.source ?? "";
  pair = null;
  listsAt = 0;
  if (state.target && state.source) wire.want("pair", { target: state.target, source: state.source });
  else wire.want("pair", { target: null, source: null });
  if (at !== null) asked = true;
  changed();
}

function setFixed(name) {
  state.fixed = name;
  state.fixedByHand = true;
  seen = null;
  $("fixed").value = name;
  listsAt = 0;
  changed();
}

function setView(view) {
  state.view = view;
  stage.setView(view);
  for (const id of ["top", "orbit"]) $(id).setAttribute("aria-pressed", String(id === view));
  changed();
}

function setSwitch(id, on) {
  state[id] = on;
  $(id).setAttribute("aria-pressed", String(on));
  changed();
}

function setTheme(theme) {
  state.theme = theme;
  document.documentElement.dataset.theme = theme;
  stage.setTheme(theme);
  changed();
}

function setScale(scale) {
  $("scale").value = String(Math.log10(scale));
  $("scale-shown").textContent = `${scale >= 10 ? scale.toFixed(0) : scale.toPrecision(2)}×`;
  dirty = true;
}

function filter() {
  $("wrong").hidden = true;
  filters = { only: matcher("only"), not: matcher("not") };
  state.only = $("only").value;
  state.not = $("not").value;
  listsAt = 0;
  changed();
}

function toast(text) {
  clearTimeout(toast.timer);
  $("toast").textContent = text;
  $("toast").hidden = !text;
  if (text) toast.timer = setTimeout(() => toast(""), 3000);
}

// ---- the address

function address(moment = playing ? null : at) {
  return write({
    ...state,
    hidden: [...state.hidden],
    closed: [...state.closed],
    trailed: [...state.trailed],
    at: moment ?? undefined,
    camera: ours ? undefined : stage.cameraState(),
  });
}

function remember() {
  clearTimeout(remember.timer);
  remember.timer = setTimeout(() => history.replaceState(null, "", address()), 400);
}

async function share() {
  // What is asked for by hand shows the very moment, even if it is being played through.
  history.replaceState(null, "", address(at));
  try {
    await navigator.clipboard.writeText(location.href);
    toast("Link to this view copied");
  } catch {
    toast("The link to this view is in the address bar");
  }
}

function shot() {
  picture();
  stage.picture().toBlob((blob) => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = "tftool-view.png";
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
    toast("Picture saved");
  }, "image/png");
}

// ---- wiring

stage.changed = changed;
stage.taken = () => (ours = false);
for (const id of ["names", "axes", "arrows", "grid", "trails"]) {
  $(id).onclick = () => setSwitch(id, !state[id]);
  setSwitch(id, state[id]);
}
$("top").onclick = () => setView("top");
$("orbit").onclick = () => setView("orbit");
$("fit").onclick = () => {
  ours = true;
  seen = null;
  if (outgrown()) fit(seen);
};
$("theme").onclick = () => setTheme(state.theme === "dark" ? "light" : "dark");
$("share").onclick = share;
$("shot").onclick = shot;
$("fixed").onchange = () => setFixed($("fixed").value);
$("target").onchange = $("source").onchange = () => setPair($("target").value, $("source").value);
$("swap").onclick = () => setPair(state.source, state.target);
$("unchoose").onclick = () => choose(null);
$("as-source").onclick = () => setPair(state.target, state.chosen);
$("as-target").onclick = () => setPair(state.chosen, state.source);
$("as-fixed").onclick = () => setFixed(state.chosen);
$("with-trail").onclick = () => {
  const has = state.trailed.has(state.chosen);
  state.trailed[has ? "delete" : "add"](state.chosen);
  listsAt = 0;
  changed();
};
$("all").onchange = () => {
  state.hidden = new Set($("all").checked ? [] : model.names);
  listsAt = 0;
  changed();
};
$("only").value = state.only;
$("not").value = state.not;
$("only").oninput = $("not").oninput = filter;
$("scale").oninput = () => {
  state.scale = 10 ** Number($("scale").value);
  setScale(state.scale);
  changed();
};
for (const [id, least, most] of [["interval", 0, 60], ["timeout", 1, 1e6], ["length", 1, 60]]) {
  $(id).value = String(state[id]);
  $(id).onchange = () => {
    const value = Number.parseFloat($(id).value);
    if (Number.isFinite(value)) state[id] = Math.min(most, Math.max(least, value));
    $(id).value = String(state[id]);
    changed();
  };
}
$("scrub").oninput = () => scrub(Number($("scrub").value));
$("back").onclick = () => scrub((at ?? reach.newest) - STEP * model.rate);
$("forth").onclick = () => scrub((at ?? reach.newest) + STEP * model.rate);
$("play").onclick = () => {
  if (at === null) scrub(reach.newest);
  else {
    playing = !playing;
    changed();
  }
  listsAt = 0;
};
$("live").onclick = goLive;
$("speed").value = String(state.speed);
if (!$("speed").value) $("speed").value = String((state.speed = 1));
$("speed").onchange = () => {
  state.speed = Number($("speed").value);
  changed();
};
// A link to another view, put into this very window.
addEventListener("hashchange", () => location.reload());

const keys = {
  t: "top", o: "orbit", f: "fit", n: "names", a: "axes", r: "arrows", g: "grid", m: "trails",
  " ": "play", "[": "back", "]": "forth", l: "live",
};
addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("input, select, button, summary")) return;
  const id = keys[event.key.toLowerCase()];
  if (id) {
    event.preventDefault();
    $(id).click();
  }
});

// A frame is chosen by a click near its origin; a drag moves the camera.
let pressed = null;
function nearest(event) {
  let best = null;
  let least = 18;
  for (const frame of drawn) {
    const spot = stage.project(...frame.pose.slice(0, 3));
    const distance = spot ? Math.hypot(spot[0] - event.clientX, spot[1] - event.clientY) : Infinity;
    if (distance < least) [least, best] = [distance, frame];
  }
  return best;
}
$("over").addEventListener("pointerdown", (event) => (pressed = [event.clientX, event.clientY]));
$("over").addEventListener("pointerup", (event) => {
  if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return;
  choose(nearest(event)?.name ?? null);
});
$("over").addEventListener("pointermove", (event) => {
  if (!event.buttons) $("over").classList.toggle("hit", nearest(event) !== null);
});
addEventListener("resize", changed);
// A narrow window breaks the bar into lines: the panels begin where it ends.
new ResizeObserver(() => {
  const { bottom } = $("bar").getBoundingClientRect();
  document.documentElement.style.setProperty("--top", `${bottom + 10}px`);
}).observe($("bar"));

setTheme(state.theme);
setView(state.view);
setScale(state.scale ?? 1);
state.fixedByHand = state.fixed !== undefined;
filter();
if (state.camera) {
  stage.resize();
  stage.setCameraState(state.camera);
}
if (at !== null) goTo(at);
if (state.target && state.source) setPair(state.target, state.source);
requestAnimationFrame(render);

// What is drawn, for tests and for the curious.
globalThis.tftool = {
  drawn: () =>
    drawn.map(({ name, pose, parent, grey, alpha }) => ({
      name,
      pose,
      grey,
      alpha,
      arrow: Boolean(parent),
      pixel: stage.project(...pose.slice(0, 3)),
    })),
  fade,
  moment: () => model.poses?.at ?? null,
  pair: () => pair,
  reach: () => reach,
  plain: () => stage.plain,
  trails: () => lines.map(({ points }) => points.length),
  remembered: () => model.history.length,
  picture() {
    picture();
    return stage.picture();
  },
};
