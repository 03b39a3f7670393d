// The panel of the chosen frame, and the panel of the pair.
import { degrees, rpy } from "./maths.js";

const $ = (id) => document.getElementById(id);

export function number(value, digits) {
  if (value === null || !Number.isFinite(value)) return "–";
  const text = Math.abs(value) >= 1e7 ? value.toExponential(3) : value.toFixed(digits);
  return /^-0(\.0*)?$/.test(text) ? text.slice(1) : text;
}

/** Put rows of term and values into a list; a value is text, or an array of numbers. */
export function fill(list, rows) {
  while (list.children.length > 2 * rows.length) list.lastChild.remove();
  rows.forEach(([term, value, digits = 4], at) => {
    let name = list.children[2 * at];
    if (!name) {
      name = document.createElement("dt");
      list.append(name, document.createElement("dd"));
    }
    const cell = list.children[2 * at + 1];
    if (name.textContent !== term) name.textContent = term;
    const texts = typeof value === "string" ? [value] : value.map((one) => number(one, digits));
    cell.className = texts.length === 1 ? "one" : "";
    while (cell.children.length > texts.length) cell.lastChild.remove();
    texts.forEach((text, place) => {
      if (!cell.children[place]) cell.append(document.createElement("span"));
      if (cell.children[place].textContent !== text) cell.children[place].textContent = text;
    });
  });
}

function poseRows(pose) {
  if (!pose) return [["Position", "–"], ["Quaternion", "–"], ["RPY, deg", "–"]];
  return [
    ["Position", pose.slice(0, 3)],
    ["Quaternion", pose.slice(3, 7)],
    ["RPY, deg", rpy(pose).map(degrees), 2],
  ];
}

export function showFrame(model, index, fixed, trouble) {
  const { poses } = model;
  const parent = model.parents[index];
  $("chosen").textContent = model.names[index];
  $("trouble").hidden = !trouble;
  $("trouble").textContent = trouble;
  const facts = [["Status", trouble ? "Warning" : "Transform OK"], ["Parent", parent < 0 ? "none, a root" : model.names[parent]]];
  if (parent >= 0) {
    facts.push(["Broadcaster", model.authorities[index]]);
    if (model.statics[index]) facts.push(["Kind", "static"]);
    else if (poses) {
      facts.push(["Average rate", `${number(poses.rateOf(index), 1)} Hz`]);
      facts.push(["Buffer length", `${number(poses.newestOf(index) - poses.oldestOf(index), 3)} s`]);
      facts.push(["Newest", `${number(Math.max(0, poses.now - poses.newestOf(index)), 3)} s ago`]);
    }
  }
  fill($("link-facts"), facts);
  const same = parent >= 0 && model.names[parent] === fixed;
  $("absolute-title").textContent = same ? `In ${fixed}, its parent and the fixed frame` : `In the fixed frame, ${fixed}`;
  fill($("absolute"), poseRows(model.absolute[index]));
  $("relative-title").hidden = $("relative").hidden = parent < 0 || same;
  if (parent >= 0 && !same) {
    $("relative-title").textContent = `In its parent, ${model.names[parent]}`;
    fill($("relative"), poseRows(model.relative(index)));
  }
}

export function showPair(pair) {
  $("why").hidden = !pair || pair.found;
  $("answer").hidden = !pair || !pair.found;
  if (!pair) return;
  if (!pair.found) {
    $("why").textContent = pair.why;
    return;
  }
  const { translation, rpy: angles } = pair;
  $("sentence").textContent = `${pair.source} in ${pair.target}`;
  fill($("numbers"), [
    ["Translation", translation, 6],
    ["Quaternion", pair.rotation, 6],
    ["RPY, rad", angles, 6],
    ["RPY, deg", angles.map((angle) => (angle === null ? null : degrees(angle))), 3],
    ["Distance", [translation.includes(null) ? null : Math.hypot(...translation)], 6],
    ["At time", pair.moment === null ? "always (static)" : `${pair.stamp} s`],
  ]);
  $("chain").textContent =
    pair.chain.length > 1 ? `Chain, source to target: ${pair.chain.join(" · ")}` : "One and the same frame";
}
