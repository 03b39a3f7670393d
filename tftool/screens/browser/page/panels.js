// @ts-check
// Texts and numbers on the page.
import { number, stillness } from "./format.js";
import { degrees, rpy } from "./maths.js";

/**
 * Element by id. The result is untyped, because tests click every element of the page.
 * @type {(id: string) => any}
 */
export const $ = (id) => document.getElementById(id);

/**
 * Set a text only if the text changes, because a browser computes the layout after each assignment.
 * @param {Element} element
 * @param {string} text
 */
function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** Fill a list with rows of a term and a value, which is a text or an array of numbers. */
export function fill(list, rows) {
  while (list.children.length > 2 * rows.length) list.lastElementChild.remove();
  rows.forEach(([term, value, digits = 4], at) => {
    let name = list.children[2 * at];
    if (!name) {
      name = document.createElement("dt");
      list.append(name, document.createElement("dd"));
    }
    const cell = list.children[2 * at + 1];
    setText(name, term);
    const texts = typeof value === "string" ? [value] : value.map((one) => number(one, digits));
    const looks = texts.length === 1 ? "one" : "";
    if (cell.className !== looks) cell.className = looks;
    while (cell.children.length > texts.length) cell.lastElementChild.remove();
    texts.forEach((text, place) => {
      if (!cell.children[place]) cell.append(document.createElement("span"));
      setText(cell.children[place], text);
    });
  });
}

function poseRows(pose) {
  if (!pose) return [["Position, m", "–"], ["Quaternion", "–"], ["RPY, deg", "–"]];
  return [
    ["Position, m", pose.slice(0, 3)],
    ["Quaternion", pose.slice(3, 7)],
    ["RPY, deg", rpy(pose).map(degrees), 2],
  ];
}

export function showFrame(model, index, fixed, trouble) {
  const { poses } = model;
  const parent = model.parents[index];
  setText($("chosen"), model.names[index]);
  $("trouble").hidden = !trouble;
  setText($("trouble"), trouble);
  const facts = [["Status", trouble ? "Warning" : "Transform OK"], ["Parent", parent < 0 ? "none, a root" : model.names[parent]]];
  if (parent >= 0) {
    facts.push(["Broadcaster", model.authorities[index]]);
    if (model.statics[index]) facts.push(["Kind", stillness(model.statics[index])]);
    else if (poses) {
      facts.push(["Average rate", `${number(poses.rateOf(index), 1)} Hz`]);
      facts.push(["Buffer length", `${number(poses.newestOf(index) - poses.oldestOf(index), 3)} s`]);
      facts.push(["Newest", `${number(Math.max(0, poses.now - poses.newestOf(index)), 3)} s ago`]);
    }
  }
  fill($("link-facts"), facts);
  const same = parent >= 0 && model.names[parent] === fixed;
  setText($("absolute-title"), same ? `In ${fixed}, its parent and the fixed frame` : `In the fixed frame, ${fixed}`);
  fill($("absolute"), poseRows(model.absolute[index]));
  $("relative-title").hidden = $("relative").hidden = parent < 0 || same;
  if (parent >= 0 && !same) {
    setText($("relative-title"), `In its parent, ${model.names[parent]}`);
    fill($("relative"), poseRows(model.relative(index)));
  }
}

export function showPair(pair) {
  $("why").hidden = !pair || pair.found;
  $("answer").hidden = !pair || !pair.found;
  if (!pair) return;
  if (!pair.found) {
    setText($("why"), pair.why);
    return;
  }
  const { translation, rpy: angles } = pair;
  setText($("sentence"), `${pair.source} in ${pair.target}`);
  fill($("numbers"), [
    ["Translation", translation, 6],
    ["Quaternion", pair.rotation, 6],
    ["RPY, rad", angles, 6],
    ["RPY, deg", angles.map((angle) => (angle === null ? null : degrees(angle))), 3],
    ["Distance, m", [translation.includes(null) ? null : Math.hypot(...translation)], 6],
    ["At time", pair.moment === null ? "always (static)" : `${pair.stamp} s`],
  ]);
  setText(
    $("chain"),
    pair.chain.length > 1 ? `Chain, source to target: ${pair.chain.join(" · ")}` : "One and the same frame",
  );
}

/**
 * @param {import("./timeline.js").Timeline} timeline
 * @param {ReturnType<typeof import("./freshness.js").freshness>} state
 */
export function showStatus({ past, playing, moves }, state) {
  const { classList } = document.body;
  classList.toggle("gone", state === "gone" || state === "silent");
  classList.toggle("stale", state === "stale");
  classList.toggle("past", past);
  const text = {
    wait: "connecting", gone: "session ended", silent: "no answer", stale: "no new data",
    past: playing ? "replay" : "past", live: "live",
    stored: !moves && !$("robot").hidden ? "description" : playing && past ? "replay" : "recorded",
  }[state];
  $("status").dataset.state = state;
  setText($("status"), text);
}

/**
 * Show which time is displayed if no data arrives, or which fixed frame replaces the chosen one.
 * @param {ReturnType<typeof import("./freshness.js").freshness>} state
 * @param {import("./model.js").Model} model
 * @param {import("./choices.js").Choices} choices
 */
export function showBanner(state, model, { missed, fixed }) {
  const { poses } = model;
  const isCut = state === "gone" || state === "silent";
  const late = isCut || state === "stale";
  $("banner").hidden = !poses || !(late || missed);
  if (!poses) return;
  $("banner").dataset.state = late ? state : "missed";
  if (!late) {
    setText($("banner"), missed ? `Frame [${missed}] does not exist. Until it does, the fixed frame is [${fixed}].` : "");
    return;
  }
  const seen = `${number(isCut ? (poses.at ?? poses.now) : poses.newest, 2)} s`;
  const last = `Last seen: its ${seen}, ${spell(model.silence)} ago.`;
  const said = {
    gone: `The session is gone. ${last} Waiting for it to come back.`,
    silent: `tftool view does not answer. ${last}`,
    stale: `No new data for ${spell(model.quiet())}. The newest transform is of ${seen}.`,
  };
  setText($("banner"), said[state]);
}

/** A growing duration, in words. */
function spell(seconds) {
  if (seconds < 60) return `${Math.floor(seconds)} s`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min`;
  return `${Math.floor(seconds / 3600)} h`;
}

/** Text in place of a picture. */
export function showEmpty(connection, model, fixed) {
  const missing = fixed && model.names.length && !model.index.has(fixed);
  $("empty").hidden = connection === "wait" ? false : model.names.length > 0 && !missing;
  setText(
    $("empty"),
    connection === "wait" ? "Connecting to the session…"
    : missing ? `Frame [${fixed}] does not exist.\nChoose another fixed frame.`
    : connection === "stored" ? "No tf data.  Actual error: no frame exists in this file."
    : "No tf data.  Actual error: no frame exists yet.\nFrames appear here as soon as a transform is broadcast.",
  );
}

export function showCounts(model, hidden) {
  setText($("count"), model.names.length ? String(model.names.length) : "");
  $("all").checked = hidden.size === 0;
  $("left-out").hidden = model.total <= model.names.length;
  setText(
    $("left-out"),
    `${model.names.length} of ${model.total} frames shown; those farthest from their root are left out.`,
  );
}

/**
 * Set the slider to the buffer's span, unless the user is dragging it.
 * @param {import("./timeline.js").Timeline} timeline
 */
export function showReach({ at, ends, moves, reach, span: { oldest, newest } }) {
  const line = $("scrub");
  line.disabled = reach.newest <= reach.oldest;
  // Without a time span, or without moving frames, the slider has no effect.
  $("time").hidden = line.disabled && (ends || !moves);
  if (line.matches(":active")) return;
  line.min = String(oldest);
  line.max = String(newest);
  line.value = String(at ?? newest);
}

/** @param {import("./timeline.js").Timeline} timeline */
export function showTime(timeline) {
  const { at, ends, playing, reach: { oldest, newest, now }, forgotten } = timeline;
  showReach(timeline);
  setText(
    $("moment"),
    at !== null && ends ? `${number(at, 3)} of ${number(newest, 3)} s`
    : at !== null ? `${number(at, 3)} s (${number(at - newest, 2)})${forgotten ? ", left the buffer" : ""}`
    : `${number(now, 2)} s, buffer ${number(newest - oldest, 1)} s`,
  );
  $("live").setAttribute("aria-pressed", String(at === null && !/gone|stale/.test(document.body.className)));
  const label = playing ? "Pause" : "Play";
  if ($("play").getAttribute("aria-label") !== label) {
    $("play").setAttribute("aria-label", label);
    $("play").textContent = playing ? "❚❚" : "▶";
  }
}

/** Add a button to every panel with a heading; the button collapses the panel. */
export function makeCollapsible() {
  for (const panel of document.querySelectorAll("#left, #right > .panel")) {
    const button = document.createElement("button");
    button.className = "plain collapse";
    const show = () => {
      const closed = panel.classList.contains("closed");
      button.textContent = closed ? "▸" : "▾";
      button.setAttribute("aria-expanded", String(!closed));
      button.setAttribute("aria-label", `${closed ? "Open" : "Close"} ${panel.querySelector("h2")?.textContent || "panel"}`);
    };
    button.onclick = () => {
      panel.classList.toggle("closed");
      show();
    };
    show();
    panel.querySelector(".head")?.append(button);
  }
}

/** Show a message that disappears by itself; an empty message hides the last one. */
export function toast(text) {
  clearTimeout(toast.timer);
  $("toast").textContent = text;
  $("toast").hidden = !text;
  if (text) toast.timer = setTimeout(() => toast(""), 3000);
}
/** @type {number | undefined} */
toast.timer = undefined;
