// @ts-check
// The robot's panel: a slider for each movable joint, and missing parts of the robot.
import { number } from "./format.js";
import { $ } from "./panels.js";

const MOST_TOLD = 8;
/** Buttons that move all joints at once. */
const POSES = {
  Zero: () => 0,
  Centre: (least, most) => (least + most) / 2,
  Random: (least, most) => least + Math.random() * (most - least),
};

export class Sliders {
  /**
   * @param {any} list
   * @param {(joint: string, position: number) => void} move
   */
  constructor(list, move) {
    this.list = list;
    this.move = move;
  }

  /** @param {{ name: string, unit: string, range: number[], position: number }[]} sliders */
  show(sliders) {
    const rows = sliders.map((one) => this.row(one));
    const poses = document.createElement("div");
    poses.className = "buttons";
    for (const [name, share] of Object.entries(POSES)) {
      const button = document.createElement("button");
      button.textContent = name;
      button.title = `All joints: ${name.toLowerCase()}`;
      button.onclick = () => rows.forEach(({ set, range: [least, most] }) => set(share(least, most)));
      poses.append(button);
    }
    this.list.replaceChildren(...(rows.length ? [poses] : []), ...rows.map(({ row }) => row));
  }

  /** Add the row of a joint: name, field for the position (angles in degrees), slider between the limits. */
  row({ name, unit, range, position }) {
    const [size, sign, digits] = unit === "rad" ? [180 / Math.PI, "°", 2] : [1, ` ${unit}`, 4];
    const make = (tag, parts) => Object.assign(document.createElement(tag), parts);
    const row = make("div", { className: "slider" });
    const typed = make("input", { type: "number", step: "any", title: "Type a position" });
    const slider = make("input", { type: "range", min: String(range[0]), max: String(range[1]), step: "any" });
    typed.setAttribute("aria-label", `Position of joint ${name},${sign}`);
    slider.setAttribute("aria-label", `Joint ${name}`);
    const tell = (value) => (typed.value = String(+(value * size).toFixed(digits)));
    const set = (value) => {
      const kept = Math.min(range[1], Math.max(range[0], value));
      slider.value = String(kept);
      tell(kept);
      this.move(name, kept);
    };
    slider.oninput = () => set(Number(slider.value));
    typed.onchange = () => {
      const value = Number.parseFloat(typed.value);
      set(Number.isFinite(value) ? value / size : Number(slider.value));
    };
    slider.value = String(position);
    tell(position);
    const limits = range.map((limit) => make("small", { textContent: `${number(limit * size, digits / 2)}${sign}` }));
    row.append(make("span", { textContent: name }), typed, make("small", { textContent: sign }), limits[0], slider, limits[1]);
    return { row, set, range };
  }
}

/** @param {import("./robot.js").Robot} robot */
export function showRobot(robot) {
  const list = $("missing");
  const { missing } = robot;
  if (list.children.length === Math.min(missing.length, MOST_TOLD + 1)) return;
  const lines = missing.slice(0, MOST_TOLD);
  if (missing.length > MOST_TOLD) lines.push(`and ${missing.length - MOST_TOLD} more`);
  list.replaceChildren(
    ...lines.map((text) => {
      const line = document.createElement("li");
      line.textContent = text;
      return line;
    }),
  );
  list.hidden = !missing.length;
}
