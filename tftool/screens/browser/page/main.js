// @ts-check
// The page: connects server, model, choices, time and picture.
import { Raycaster, Vector3 } from "three";
import { Bounds, spread } from "./bounds.js";
import { FLAT, ray } from "./cameras.js";
import { Choices, LIMITS, VIEWS } from "./choices.js";
import { Course } from "./course.js";
import { Displays } from "./displays.js";
import { keepFiles } from "./files.js";
import { number } from "./format.js";
import { chain, describe, retell, trail, trailing } from "./frames.js";
import { freshness, Hearing } from "./freshness.js";
import { KEYS, meant, OTHERS } from "./keys.js";
import { Measure, onPlane } from "./measure.js";
import { fade, Model } from "./model.js";
import { naturalPair, planar, trailsPay, wholePays } from "./opening.js";
import {
  $, fill, makeCollapsible, showBanner, showCounts, showEmpty, showFrame, showPair, showReach, showStatus, showTime, toast,
} from "./panels.js";
import { compose, invert } from "./maths.js";
import { Pace } from "./pace.js";
import { Past } from "./past.js";
import { Picker } from "./picker.js";
import { Redraw } from "./redraw.js";
import { Robot } from "./robot.js";
import { Stage } from "./scene.js";
import { secured } from "./secret.js";
import { FILE, linkTo, read, showAddress, told, write } from "./share.js";
import { Sliders, showRobot } from "./sliders.js";
import { Standalone, packed } from "./standalone.js";
import { Timeline } from "./timeline.js";
import { Tracks } from "./tracks.js";
import { Tree } from "./tree.js";
import { same, Wire } from "./wire.js";

const FLIGHT = 350; // milliseconds
const NEAR_POINT = 6; // pixels from a measured point of a cloud
const LOW = 500; // height in pixels of a window without space for panels
const STEP = 0.1; // seconds for each press of [ or ]
const SWITCHES = ["names", "axes", "arrows", "grid", "trails", "visuals", "collisions", "jointaxes", "through", "whole"];
// Times of requests for the trails' history: once the tree is stable, and once more later,
// because data that arrived during the start has gaps.
const PAST_AFTER = [300, 3000];

// Data packed into a saved page.
const inside = packed();
if (inside) keepFiles(inside);
const given = read(location.hash || (inside?.header.view ?? ""));
const choices = new Choices(given, matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark");
const redraw = new Redraw();
const pace = new Pace();
const model = new Model();
const bounds = new Bounds();
const stage = new Stage($("floor"), $("under"), $("main"), $("over"));
stage.taken = given.camera !== undefined;
const robot = new Robot(stage.scene, () => redraw.everything(), stage.plain);
const tracks = new Tracks();
const displays = new Displays(stage.scene, tracks, (topic) => {
  choices.mark("undrawn", topic, !choices.undrawn.has(topic));
  changed();
});

/** @type {{ connection: "wait" | "open" | "silent" | "ended" | "stored", hearing: Hearing, pair: any, unacknowledged: number, recorded: boolean }} */
const server = { connection: "wait", recorded: false, hearing: new Hearing(), pair: null, unacknowledged: 0 };
/**
 * Contents of the screen: all frames, drawn frames, trails, and the pair's distance as in the panel.
 * @type {{ frames: import("./frames.js").Frame[], drawn: any[], lines: ReturnType<typeof trail>[], distance: string }}
 */
const shown = { frames: [], drawn: [], lines: [], distance: "" };
/** @type {{ past: number[], address: number | undefined }} */
const timers = { past: [], address: undefined };
/** @type {string | undefined} the frame under the pointer, in the picture or in the list */
let hovered;

const measure = new Measure();
/** @type {{ name: string, fixed: string | undefined, place: number[] } | null} last position of the followed frame */
let carried = null;

const timeline = new Timeline(
  {
    ask: (at) => wire.want({ type: "show", at }),
    moved() {
      redraw.picture();
      remember();
    },
    reached: () => showReach(timeline),
  },
  given.at ?? inside?.header.begin ?? null,
);
timeline.speed = choices.speed;
timeline.ends = inside !== null;
// The address may request autoplay, as for a page on the web.
if (inside && given.play && !calm()) timeline.playing = timeline.loops = true;

const tree = new Tree($("tree"), {
  choose: (name) => choose(choices.chosen === name ? undefined : name),
  fly: (name) => flyTo(name),
  hover: (name) => hover(name),
  toggle(name, visible) {
    choices.mark("hidden", name, !visible);
    changed();
  },
  solid(name, visible) {
    choices.mark("bare", name, !visible);
    changed();
  },
  fold(name, closed) {
    choices.mark("closed", name, closed);
    remember();
  },
});

// ---- the server

const handlers = {
  open() {
    server.connection = inside ? "stored" : "open";
    server.hearing.begin(performance.now());
    toast("");
    changed();
  },
  heard() {
    server.hearing.heard(performance.now());
    if (server.connection === "silent") server.connection = "open";
  },
  ended() {
    if (server.connection === "open" || server.connection === "silent") server.connection = "ended";
    timeline.lost();
    past.lost();
    changed();
  },
  names(message) {
    const another = model.setNames(message);
    timeline.rate = model.rate;
    timeline.moves = model.names.some((_, index) => model.parents[index] >= 0 && !model.statics[index]);
    const recorded = message.begin ?? null; // the time that a recording shows first
    if (another) tracks.forget();
    if (recorded !== null) {
      server.recorded = timeline.ends = $("live").hidden = true;
      if (another || timeline.at === null) {
        timeline.playing = false;
        timeline.show(recorded);
      }
    } else if (another) timeline.goLive();
    tree.build(model, choices);
    course.forget();
    past.forget();
    fillPickers();
    open();
    timers.past.forEach(clearTimeout);
    timers.past = PAST_AFTER.map((wait) => setTimeout(() => wire.past(), wait));
    redraw.everything();
  },
  past(poses) {
    model.remember(poses);
    redraw.data();
  },
  pair(message) {
    const { pair } = server;
    if (message.target !== choices.target || message.source !== choices.source) return;
    // Numbers of a shown time stay after the buffer has pruned it.
    if (timeline.forgotten && !message.found && pair?.found) return;
    server.pair = message;
    if (!timeline.past) course.add(message);
    redraw.data(false);
  },
  trails(message) {
    past.take(message);
    redraw.data();
  },
  robot(message) {
    robot.show(message);
    if (!choices.byHand.view) setView("orbit", false);
    sliders.show(message.sliders);
    $("robot").hidden = false;
    redraw.everything();
  },
  tracks(found, packed, whole) {
    tracks.take(found, packed, whole);
    redraw.everything();
  },
  series(message) {
    course.setSeries(message);
    redraw.picture();
  },
  marks(message) {
    course.setMarks(message);
    redraw.picture();
  },
  range(message) {
    timeline.setReach(message);
    redraw.data(false);
  },
  poses(poses) {
    server.unacknowledged = poses.sequence;
    timeline.setReach(poses);
    redraw.data(false);
    if (!timeline.accepts(poses.at)) return; // outdated, because another time is shown now
    // Poses of a shown time stay after the buffer has pruned it.
    if (poses.at !== null && poses.at < poses.oldest && model.poses?.at === poses.at) return;
    redraw.data(!same(poses, model.poses));
    model.setPoses(poses, performance.now());
  },
};
if (inside) {
  document.title = `${inside.header.name} · tftool view`;
  $("live").hidden = true;
}
const wire = inside ? new Standalone(handlers, inside) : new Wire(handlers);

const past = new Past((asked) => wire.trails(asked));

const course = new Course(timeline, {
  want: (request) => wire.want(request),
  now: () => performance.now(),
  redraw: drawCourse,
});

function drawCourse() {
  course.draw(choices, server.pair?.found ? server.pair.chain : []);
}

const pickers = {
  fixed: new Picker($("fixed"), $("offers"), (name) => name && setFixed(name), false),
  target: new Picker($("target"), $("offers"), (name) => setPair(name, choices.source), true),
  source: new Picker($("source"), $("offers"), (name) => setPair(choices.target, name), true),
};

const sliders = new Sliders($("sliders"), (joint, position) => wire.move(joint, position));

/** Acknowledge a message, so that the server sends the newest state next. */
function acknowledge() {
  if (server.unacknowledged) wire.got(server.unacknowledged);
  server.unacknowledged = 0;
}

// ---- drawing

/** The user chose something: show it at once, and store it in the address. */
function changed() {
  redraw.everything();
  remember();
}

function render(now) {
  requestAnimationFrame(render);
  if (pace.tick(now)) redraw.picture();
  timeline.tick(now);
  if (stage.flying) stage.advance(now);
  const due = redraw.take(now, choices.interval * 1000);
  const before = shown.distance;
  if (due.lists) shown.distance = distance(server.pair);
  if (due.picture) {
    if (model.poses?.revision !== model.revision) redraw.nothingShown();
    solve();
    stage.scale = pace.draw(now);
    stage.resize();
    if (!stage.taken) follow();
    carry();
    paint();
  } else if (shown.distance !== before) paintOver();
  course.ask(choices);
  if (due.lists) {
    drawCourse();
    if (!due.picture) retell(model, shown.frames, timeline.past); // ages advance without a picture
    tree.refresh(shown.frames, choices, robot);
    words();
  }
  acknowledge();
}

function solve() {
  if (choices.settleFixed(model)) {
    pickers.fixed.value = choices.fixed ?? "";
    bounds.reset();
  }
  model.solve(choices.fixed);
  if (!choices.byHand.view && choices.view === "top" && !planar(model.absolute)) {
    setView("orbit", false);
    bounds.reset();
  }
  shown.frames = describe(model, choices, timeline.past, server.pair);
  shown.drawn = shown.frames.filter((frame) => frame.shown);
  shown.lines = pathsTo(timeline.at);
  robot.place(shown.frames, model, choices);
}

/** Compute the trails, with all samples for a past time. @param {number | null} at */
function pathsTo(at) {
  const { reach, rate } = timeline;
  const frames = trailing(model, shown.drawn, choices);
  const { fixed, whole } = choices;
  if (at === null || fixed === undefined) return frames.map((frame) => trail(model, frame, choices, reach.now));
  const from = whole ? reach.oldest : Math.max(reach.oldest, at - choices.length * rate);
  const until = whole ? reach.newest : at;
  // First, because pieces for another fixed frame are of no use for this fixed frame.
  past.look(fixed, frames.map(({ name }) => name), from, until, reach.newest, rate);
  return frames.map((frame) => {
    const line = trail(model, frame, choices, at, past.trail(frame.name, from, at));
    if (whole) line.ahead = past.trail(frame.name, at, until);
    return line;
  });
}

/** Paint the computed frames, trails, names, and the pair's chain. */
function paint() {
  const { drawn, lines } = shown;
  displays.place(model.poses?.at ?? null, model, choices.undrawn);
  stage.draw(drawn, { ...choices, scale: 10 ** Number($("scale").value), level: robot.box?.min.z ?? 0 });
  stage.drawUnder(lines, chain(model, server.pair));
  paintOver();
}

/** Paint the layer over the frames. */
function paintOver() {
  const { pair } = server;
  const special = new Set([choices.chosen, hovered, ...(pair?.found ? [pair.source, pair.target] : [])]);
  const labels = shown.drawn
    .filter(({ name }) => choices.names || special.has(name))
    .map((frame) => ({ ...frame, first: special.has(frame.name) }))
    .sort((one, other) => Number(other.first) - Number(one.first));
  const rings = [{ pose: poseOf(choices.chosen), strong: true }, { pose: poseOf(hovered), strong: false }];
  stage.drawOver(labels, { chain: chain(model, pair), distance: shown.distance }, rings);
  if (measure.on) paintMeasure();
}

/** Distance of the pair's frames, as text; empty if the distance is unknown or rounds to 0. */
function distance(pair) {
  if (!pair?.found || pair.translation.includes(null)) return "";
  const length = number(Math.hypot(...pair.translation), 3);
  return Number(length) === 0 ? "" : `${length} m`;
}

function words() {
  stage.inset = insets();
  stage.covered = covered();
  const connection = server.recorded && server.connection === "open" ? "stored" : server.connection;
  const state = freshness(connection, model, timeline.past);
  showStatus(timeline, state);
  showBanner(state, model, choices);
  showCounts(model, choices.hidden);
  showEmpty(server.connection, model, choices.fixed);
  const index = model.index.get(choices.chosen);
  $("facts").hidden = index === undefined;
  if (index !== undefined) {
    showFrame(model, index, choices.fixed, shown.frames[index]?.trouble ?? "");
    $("with-trail").setAttribute("aria-pressed", String(choices.trailed.has(choices.chosen)));
  }
  showPair(server.pair);
  showRobot(robot);
  displays.list(choices.undrawn);
  $("with-camera").setAttribute("aria-pressed", String(choices.chosen !== undefined && choices.followed === choices.chosen));
  $("measured").hidden = !measure.on;
  if (measure.on) $("measured").textContent = measure.told(poseOf, choices.fixed);
  showTime(timeline);
}

// ---- the camera

/** Move the camera with the followed frame. */
function carry() {
  const { followed: name, fixed } = choices;
  const pose = name === undefined ? null : poseOf(name);
  if (name === undefined || !pose) {
    carried = null;
    return;
  }
  stage.taken = true;
  if (carried && carried.name === name && carried.fixed === fixed) {
    stage.carry(pose[0] - carried.place[0], pose[1] - carried.place[1], pose[2] - carried.place[2]);
  }
  carried = { name, fixed, place: pose.slice(0, 3) };
}

/** @param {string | undefined} name */
function poseOf(name) {
  return model.absolute[model.index.get(name) ?? -1] ?? null;
}

/** End of a measurement under the pointer: a frame, or a place on a solid, in a cloud, on the ground. */
function under(event) {
  const frame = nearest(event);
  if (frame) return { name: frame.name };
  const { from } = FLAT[choices.view] ?? FLAT.top;
  const { origin, way } = ray(stage.camera, event.clientX / innerWidth, event.clientY / innerHeight);
  const caster = new Raycaster(new Vector3(...origin), new Vector3(...way));
  caster.params.Points.threshold = caster.params.Line.threshold = NEAR_POINT * stage.pixel();
  const hits = [robot.pick(caster), displays.pick(caster)].filter((hit) => hit !== null);
  hits.sort((one, other) => one.distance - other.distance);
  const point = hits[0]?.point ?? onPlane({ origin, way }, from, [0, 0, robot.box?.min.z ?? 0]);
  const name = hits[0]?.frame ?? choices.fixed;
  const pose = poseOf(name);
  return point && pose && name !== undefined ? { name, place: compose(invert(pose), [...point, 0, 0, 0, 1]).slice(0, 3) } : null;
}

/** Draw the measurement over everything else. */
function paintMeasure() {
  const spots = measure.places(poseOf).map((place) => place && stage.project(place[0], place[1], place[2]));
  measure.told(poseOf, choices.fixed);
  stage.drawMeasure(spots.filter((spot) => spot !== null), measure.length);
}

/** Keep everything drawn in view until the user moves the camera. */
function follow() {
  const { drawn, lines } = shown;
  const solid = robot.box ? [robot.box.min.toArray(), robot.box.max.toArray()] : [];
  const box = bounds.grow([...solid, ...drawn.map(({ pose }) => pose), ...lines.flatMap(({ points, ahead }) => [...points, ...ahead])]);
  if (box) fit(box);
}

/** Pixels of the picture covered by panels, at each side. */
function insets() {
  const side = (id) => ($(id).offsetParent ? $(id).getBoundingClientRect() : null);
  const left = side("left");
  const right = side("right");
  return {
    left: left && innerWidth > 640 ? left.right : 0,
    right: right && innerWidth > 640 ? innerWidth - right.left : 0,
    top: document.body.classList.contains("alone") ? 2 : $("bar").getBoundingClientRect().bottom,
    bottom: foot(),
  };
}

/** Height in pixels of the timeline at the bottom of the window; 2 without a timeline. */
const foot = () => (!$("time").offsetParent ? 2 : innerHeight - $("time").getBoundingClientRect().top);

/** Areas covered by panels: left, top, width and height of each. */
function covered() {
  return [...document.querySelectorAll("#bar, #left, #right > .panel, #time")]
    .map((panel) => panel.getBoundingClientRect())
    .filter(({ width }) => width)
    .map(({ left, top, width, height }) => [left, top, width, height]);
}

function fit(box) {
  stage.fit(box, insets());
  if (choices.scale === undefined) {
    // Axes of a twentieth of the scene: rviz's fixed size of 1 m fits a room, but not a gripper or a field.
    // Axes are smaller if there are many frames.
    const crowd = Math.max(1, Math.cbrt(shown.drawn.length / 12));
    showScale(Math.min(100, Math.max(0.01, spread(box) / 4 / crowd)));
  }
}

/** Whether the user's system asks for reduced motion. */
function calm() {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/** Center a frame, and move near enough to see the axes of the frame. */
function flyTo(name) {
  const pose = model.absolute[model.index.get(name) ?? -1];
  if (!pose) return;
  stage.fly(pose, 10 ** Number($("scale").value), calm() ? 0 : FLIGHT, insets());
}

function refit() {
  stage.taken = false;
  bounds.reset();
  follow();
}

// ---- choices

function fillPickers() {
  // A requested frame stays in the list even while the frame does not exist.
  const asked = [choices.fixed, choices.wanted, choices.target, choices.source].map((name) => name ?? "");
  const absent = asked.filter((name) => name && !model.index.has(name));
  Picker.names = [...new Set([...absent, ...model.names])];
  for (const [id, picker] of Object.entries(pickers)) picker.value = choices[id] ?? "";
}

/**
 * Highlight a frame in the picture and in the list.
 * @param {string | undefined} name
 */
function hover(name) {
  if (hovered === name) return;
  hovered = name;
  tree.light(name);
  redraw.picture();
}

/** @param {string | undefined} name */
function choose(name) {
  choices.chosen = name;
  changed();
}

/** Choose an opening view, unless the user has chosen. */
function open() {
  const pair = choices.byHand.pair ? null : naturalPair(model);
  if (pair && (pair.target !== choices.target || pair.source !== choices.source)) {
    setPair(pair.target, pair.source, false);
  }
  if (!choices.byHand.trails) setSwitch("trails", trailsPay(model), false);
  // For live data the newest part matters more.
  if (!choices.byHand.whole) setSwitch("whole", timeline.ends && wholePays(model), false);
}

function setPair(target, source, byHand = true) {
  choices.setPair(target, source, byHand);
  pickers.target.value = choices.target ?? "";
  pickers.source.value = choices.source ?? "";
  server.pair = null;
  const [to = null, of = null] = [choices.target, choices.source];
  const both = to !== null && of !== null;
  wire.want({ type: "pair", target: both ? to : null, source: both ? of : null });
  timeline.awaitAgain();
  changed();
}

function setFixed(name) {
  choices.setFixed(name);
  pickers.fixed.value = name;
  solve();
  refit();
  changed();
}

function setView(view, byHand = true) {
  choices.byHand.view ||= byHand;
  choices.view = view;
  stage.setView(view);
  for (const id of VIEWS) $(id).setAttribute("aria-pressed", String(id === view));
  changed();
}

function setSwitch(id, on, byHand = true) {
  if (id in choices.byHand) choices.byHand[id] ||= byHand;
  choices[id] = on;
  $(id).setAttribute("aria-pressed", String(on));
  changed();
}

function setTheme(theme) {
  choices.theme = theme;
  document.documentElement.dataset.theme = theme;
  stage.setTheme(theme);
  changed();
}

function showScale(scale) {
  $("scale").value = String(Math.log10(scale));
  $("scale-shown").textContent = `${scale >= 10 ? scale.toFixed(0) : scale.toPrecision(2)}×`;
  redraw.data();
}

function filter() {
  const wrong = ["only", "not"].map((id) => {
    const error = choices.setFilter(id, $(id).value);
    $(id).setAttribute("aria-invalid", String(error !== ""));
    return error;
  });
  $("wrong").textContent = wrong.find((error) => error) ?? "";
  $("wrong").hidden = !$("wrong").textContent;
  changed();
}

// ---- the address

/** @param {number | null} at moment the address shows; null for the present */
function address(at) {
  return write(choices.shared(at, stage.taken ? stage.cameraState() : undefined));
}

function remember() {
  clearTimeout(timers.address);
  timers.address = setTimeout(() => showAddress(address(timeline.playing ? null : timeline.at)), 400);
}

async function share() {
  // A shared link shows the current time, even during playback.
  const hash = address(timeline.at);
  showAddress(hash);
  const link = linkTo(location.href, hash);
  let copied = link.text !== "";
  try {
    if (copied) await navigator.clipboard.writeText(link.text);
  } catch {
    copied = false;
  }
  if (!inside) save(secured(`standalone.html?view=${encodeURIComponent(hash.slice(1))}`), FILE);
  toast(told(link.reach, copied));
}

/** Let the browser save the file at an address. */
function save(address, name) {
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
}

/** Draw the picture in the window's full resolution. */
function whole() {
  stage.scale = 1;
  paint();
  return stage.picture();
}

function shot() {
  whole().toBlob((blob) => {
    if (!blob) return;
    const address = URL.createObjectURL(blob);
    save(address, "tftool-view.png");
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
    toast("Picture saved");
  }, "image/png");
}

// ---- wiring

stage.changed = () => {
  redraw.picture();
  remember();
};
for (const id of SWITCHES) {
  $(id).onclick = () => setSwitch(id, !choices[id]);
  setSwitch(id, choices[id], false);
}
for (const view of VIEWS) $(view).onclick = () => setView(view);
$("measure").onclick = () => {
  measure.turn(!measure.on);
  $("measure").setAttribute("aria-pressed", String(measure.on));
  changed();
};
$("with-camera").onclick = () => {
  const follows = choices.followed !== choices.chosen;
  choices.followed = follows ? choices.chosen : undefined;
  if (follows && choices.chosen !== undefined) flyTo(choices.chosen);
  changed();
};
$("fit").onclick = refit;
$("theme").onclick = () => setTheme(choices.theme === "dark" ? "light" : "dark");
$("share").onclick = share;
$("shot").onclick = shot;
$("swap").onclick = () => setPair(choices.source, choices.target);
$("unchoose").onclick = () => choose(undefined);
$("as-source").onclick = () => setPair(choices.target, choices.chosen);
$("as-target").onclick = () => setPair(choices.chosen, choices.source);
$("as-fixed").onclick = () => setFixed(choices.chosen);
$("with-trail").onclick = () => {
  const name = choices.chosen;
  if (name !== undefined) choices.mark("trailed", name, !choices.trailed.has(name));
  changed();
};
$("all").onchange = () => {
  choices.hidden = new Set($("all").checked ? [] : model.names);
  changed();
};
for (const id of ["only", "not"]) {
  $(id).value = choices[id];
  $(id).oninput = filter;
}
$("scale").oninput = () => {
  choices.scale = 10 ** Number($("scale").value);
  showScale(choices.scale);
  changed();
};
for (const id of ["interval", "timeout", "length"]) {
  $(id).value = String(choices[id]);
  $(id).onchange = () => {
    choices.setNumber(id, Number.parseFloat($(id).value));
    if (id === "length") setSwitch("whole", false);
    $(id).value = String(choices[id]);
    changed();
  };
}
$("opacity").value = String(choices.opacity);
$("opacity").oninput = () => {
  choices.opacity = Number($("opacity").value);
  changed();
};
$("scrub").oninput = () => timeline.scrub(Number($("scrub").value));
$("back").onclick = () => timeline.step(-STEP);
$("forth").onclick = () => timeline.step(STEP);
$("play").onclick = () => {
  timeline.toggle();
  changed();
};
$("live").onclick = () => timeline.goLive();
$("quantity").value = choices.plot;
$("quantity").onchange = () => {
  choices.plot = $("quantity").value;
  changed();
};
$("speed").value = String(choices.speed);
$("speed").onchange = () => {
  timeline.speed = choices.speed = Number($("speed").value);
  changed();
};
// A link to another view, opened in this window.
addEventListener("hashchange", () => location.reload());

/** Kind of the focused element, which decides which keys it uses itself. */
function focused(target) {
  if (!(target instanceof HTMLElement)) return "other";
  if (target.matches("textarea, input:not([type=checkbox], [type=range])")) return "text";
  return target.matches("button, select, summary, input[type=checkbox]") ? "button" : "other";
}
addEventListener("keydown", (event) => {
  if (event.key === "Escape") {
    if (!$("help").hidden) showHelp(false);
    else if (document.body.dataset.drawer) openDrawer("");
    else choose(undefined);
    return;
  }
  if (event.key === "/" && focused(event.target) !== "text") {
    event.preventDefault();
    openDrawer("left");
    $("only").focus();
    return;
  }
  const arrow = /^Arrow(Up|Down|Left|Right)$/.exec(event.key)?.[1];
  if (arrow && (event.target === document.body || event.target === $("over"))) {
    event.preventDefault();
    wire.press(arrow.toLowerCase());
    return;
  }
  const id = meant(event, focused(event.target));
  if (id) {
    event.preventDefault();
    $(id).click();
  }
});
// A clicked button releases the focus, so that keys keep their meaning.
addEventListener("click", (event) => {
  if (!event.detail || !(event.target instanceof Element)) return; // pressed by a key
  const button = event.target.closest("button, summary, input[type=checkbox], input[type=range]");
  if (button instanceof HTMLElement) button.blur();
});
$("speed").addEventListener("change", () => $("speed").blur());

function showHelp(on) {
  $("help").hidden = !on;
  if (on) $("help-close").focus();
}
$("ask").onclick = () => showHelp($("help").hidden);
$("help-close").onclick = () => showHelp(false);
$("help").onclick = (event) => event.target === $("help") && showHelp(false);
fill($("help-keys"), [...KEYS.map(([key, , does]) => [key === " " ? "Space" : key.toUpperCase(), does]), ...OTHERS]);

// A notebook's cell has space for the picture only.
function showPanels(on) {
  document.body.classList.toggle("alone", !on);
  $("panels").setAttribute("aria-pressed", String(on));
  bounds.reset();
  changed();
}
$("panels").onclick = () => showPanels(document.body.classList.contains("alone"));
makeCollapsible();
if (innerHeight < LOW) showPanels(false);

// On a small screen panels are drawers: one is open at a time.
function openDrawer(name) {
  const now = document.body.dataset.drawer === name ? "" : name;
  document.body.dataset.drawer = now;
  for (const button of document.querySelectorAll(".drawer")) {
    button.setAttribute("aria-expanded", String(button instanceof HTMLElement && button.dataset.drawer === now));
  }
}
for (const button of document.querySelectorAll(".drawer")) {
  if (button instanceof HTMLElement) button.onclick = () => openDrawer(button.dataset.drawer ?? "");
}

// The user can resize the list of frames.
function setSide(width) {
  choices.setNumber("side", width);
  if (choices.side !== undefined) document.documentElement.style.setProperty("--side", `${choices.side}px`);
  $("grip").setAttribute("aria-valuenow", String(choices.side ?? $("left").offsetWidth));
  remember();
}
$("grip").setAttribute("aria-valuemin", String(LIMITS.side[0]));
$("grip").setAttribute("aria-valuemax", String(LIMITS.side[1]));
$("grip").onpointerdown = (event) => $("grip").setPointerCapture(event.pointerId);
$("grip").onpointermove = (event) => {
  if ($("grip").hasPointerCapture(event.pointerId)) setSide(event.clientX - $("left").getBoundingClientRect().left);
};
$("grip").onkeydown = (event) => {
  const by = { ArrowLeft: -20, ArrowRight: 20 }[event.key];
  if (by) setSide($("left").offsetWidth + by);
};

// A frame is chosen by a click near its origin; a drag moves the camera.
const NEAR = 18; // pixels
const DRAGGED = 4; // pixels
/** @type {[number, number] | null} */
let pressed = null;
/** @returns {import("./frames.js").Frame | null} */
function nearest(event) {
  let best = null;
  let least = NEAR;
  for (const frame of shown.drawn) {
    const spot = stage.project(frame.pose[0], frame.pose[1], frame.pose[2]);
    const distance = spot ? Math.hypot(spot[0] - event.clientX, spot[1] - event.clientY) : Infinity;
    if (distance < least) [least, best] = [distance, frame];
  }
  return best;
}
$("over").addEventListener("pointerdown", (event) => (pressed = [event.clientX, event.clientY]));
$("over").addEventListener("pointerup", (event) => {
  if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > DRAGGED) return;
  if (measure.on) {
    measure.click(under(event));
    changed();
    return;
  }
  choose(nearest(event)?.name);
});
$("over").addEventListener("pointermove", (event) => {
  if (event.buttons) return;
  const frame = nearest(event);
  $("over").classList.toggle("hit", frame !== null);
  hover(frame?.name);
});
$("over").addEventListener("pointerleave", () => hover(undefined));
$("over").addEventListener("dblclick", (event) => {
  const frame = nearest(event);
  if (!frame) return;
  choose(frame.name);
  flyTo(frame.name);
});
addEventListener("resize", changed);
// A narrow window breaks the bar into lines; the panels begin below the bar.
new ResizeObserver(() => {
  const { bottom } = $("bar").getBoundingClientRect();
  document.documentElement.style.setProperty("--top", `${bottom + 10}px`);
}).observe($("bar"));
new ResizeObserver(() => {
  document.documentElement.style.setProperty("--foot", `${foot() + 10}px`);
  // The free area has changed. Until the user moves the camera, everything is kept in view.
  bounds.reset();
  redraw.picture();
}).observe($("time"));

// While no message arrives, no picture is drawn, but ages and the server's state must be updated.
setInterval(() => {
  const now = performance.now();
  // A hidden page draws nothing, and requests nothing.
  if (document.hidden) server.hearing.begin(now);
  if (server.connection === "open" && server.hearing.isOver(now)) server.connection = "silent";
  const isCut = server.connection === "ended" || server.connection === "silent";
  model.silence = isCut ? (now - model.heardAt) / 1000 : 0;
  redraw.words();
}, 500);

setSide(choices.side);
setTheme(choices.theme);
setView(choices.view, false);
showScale(choices.scale ?? 1);
filter();
if (given.camera) {
  stage.resize();
  stage.setCameraState(given.camera);
}
if (timeline.at !== null) timeline.show(timeline.at);
if (choices.target && choices.source) setPair(choices.target, choices.source);
requestAnimationFrame(render);

// State of the picture, for tests and for debugging.
Object.assign(globalThis, {
  tftool: {
    robot: () => ({ waiting: robot.waiting, missing: robot.missing, ...robot.drawn() }),
    drawn: () =>
      shown.drawn.map(({ name, pose, parent, grey, alpha, dim }) => ({
        name,
        pose,
        grey,
        alpha,
        dim,
        arrow: parent !== null,
        pixel: stage.project(pose[0], pose[1], pose[2]),
      })),
    fade,
    hovered: () => hovered,
    distance: () => shown.distance,
    ground: () => ({ cell: stage.ground.cell, level: robot.box?.min.z ?? 0, reach: stage.seen().reach }),
    moment: () => model.poses?.at ?? null,
    pair: () => server.pair,
    reach: () => timeline.reach,
    displays: () => displays.drawn(),
    pixelOf: (x, y, z) => stage.project(x, y, z),
    camera: () => stage.cameraState(),
    course: () => ({
      gaps: course.gaps,
      findings: course.marks.findings.map(({ id, since }) => ({ id, since, pixel: course.scale.pixel(since) })),
      series: course.series,
      limits: course.limits,
      legend: course.legended,
      span: timeline.span,
      later: course.later.length,
      pixel: (moment) => course.scale.pixel(moment),
    }),
    plain: () => stage.plain,
    trails: () => shown.lines.map(({ points }) => points.length),
    ahead: () => shown.lines.map(({ ahead }) => ahead.map((point) => point.slice(0, 3))),
    trailOf: (name) => shown.lines.find((line) => line.name === name)?.points.map((point) => point.slice(0, 3)),
    remembered: () => model.history.length,
    scale: () => stage.scale,
    picture: whole,
  },
});
