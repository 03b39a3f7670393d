// @ts-check
// The robot's panel: a slider for each joint that is moved from here, and what is missing of it.
import { number } from "./format.js";
import { $ } from "./panels.js";

const MOST_TOLD = 8;

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
    this.list.replaceChildren(...sliders.map((one) => this.row(one)));
  }

  row({ name, unit, range, position }) {
    const row = document.createElement("label");
    row.className = "slider";
    const title = document.createElement("span");
    title.textContent = name;
    title.title = name;
    const told = document.createElement("output");
    const slider = document.createElement("input");
    slider.type = "range";
    [slider.min, slider.max] = range.map(String);
    slider.step = "any";
    slider.value = String(position);
    slider.setAttribute("aria-label", `Joint ${name}`);
    const tell = () => (told.textContent = `${number(Number(slider.value), 3)} ${unit}`);
    slider.oninput = () => {
      tell();
      this.move(name, Number(slider.value));
    };
    tell();
    row.append(title, slider, told);
    return row;
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
