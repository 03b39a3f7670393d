// @ts-check
// The ruler and the plot on the page: ask for what they show, draw it, and go where one clicks.
import { number } from "./format.js";
import { $ } from "./panels.js";
import { bounds, linesOf, newestOf, PLOTS, runs, Scale, shownGaps, ticks, valueAt } from "./ruler.js";

const THUMB = 8; // pixels from the slider's end to the middle of its handle there
const NEAR = 5; // pixels
const LEGEND = 15; // pixels above the lines, for what they are called
// Of lines and of what they are called, which has to be read.
const [RED, GREEN, BLUE, BROWN] = [0, 1, 2, 3];
const TONES = {
  dark: ["#ff7a80", "#4cc38a", "#7fa8ff", "#e0a83a"],
  light: ["#c62a2f", "#18794e", "#2458d3", "#8a5a00"],
};
const TONE_OF = { x: RED, y: GREEN, z: BLUE, roll: RED, pitch: GREEN, yaw: BLUE, distance: BROWN };
const SEVERITIES = { error: "#e5484d", warning: "#d08700", note: "#7a8699" };
const MOST_MOMENTS = 1000;
const SERIES_EVERY = 500; // milliseconds, while the present goes on
const MARKS_EVERY = 5000;

export class Course {
  /**
   * @param {{ want(type: string, fields: any): void, go(moment: number): void, now(): number }} hooks
   */
  constructor(hooks) {
    this.hooks = hooks;
    this.ruler = $("ruler");
    this.plot = $("plot");
    /** @type {{ gaps: [string, number, number][], findings: any[] }} */
    this.marks = { gaps: [], findings: [] };
    /** @type {any} */
    this.series = null;
    this.asked = { key: "", span: "", end: "", series: -Infinity, marks: -Infinity };
    /** @type {{ from: number, to: number, frames: string[] }[]} */
    this.gaps = [];
    /** @type {[number, number]} */
    this.limits = [-1, 1];
    this.scale = new Scale({ oldest: 0, newest: 0 }, 0, 1);
    for (const canvas of [this.ruler, this.plot]) {
      let held = false;
      canvas.addEventListener("pointerdown", (event) => {
        held = true;
        canvas.setPointerCapture(event.pointerId);
        this.go(event.offsetX);
      });
      canvas.addEventListener("pointermove", (event) => {
        if (held) this.go(event.offsetX);
        else this.tell(canvas, event.offsetX);
      });
      for (const type of ["pointerup", "pointercancel"]) canvas.addEventListener(type, () => (held = false));
    }
  }

  /** Go to a pixel's moment; to the finding's own where there is one under it. */
  go(pixel) {
    this.hooks.go(this.finding(pixel)?.since ?? this.scale.moment(pixel));
  }

  finding(pixel) {
    return this.marks.findings.find(
      ({ since, until }) => pixel >= this.scale.pixel(since) - NEAR && pixel <= this.scale.pixel(since) + NEAR && until >= since,
    );
  }

  /** Say what is under the pointer. */
  tell(canvas, pixel) {
    const moment = this.scale.moment(pixel);
    const finding = this.finding(pixel);
    const gap = this.gaps.find(({ from, to }) => moment >= from && moment <= to);
    const lines = [`${number(moment, 3)} s`];
    if (finding) lines.push(`${finding.severity} ${finding.id}: ${finding.message}`);
    if (gap) lines.push(`no data of ${gap.frames.slice(0, 5).join(", ")}${gap.frames.length > 5 ? " …" : ""} for ${number(gap.to - gap.from, 3)} s`);
    canvas.title = lines.join("\n");
  }

  /** What was asked for has come. */
  setSeries(message) {
    this.series = message;
  }

  setMarks(message) {
    this.marks = message;
  }

  /** The connection was made anew, or the tree is another: ask again. */
  forget() {
    this.asked = { key: "", span: "", end: "", series: -Infinity, marks: -Infinity };
  }

  /**
   * Ask for what is shown, where that is not known or has grown old.
   * @param {import("./timeline.js").Reach} reach
   * @param {{ target?: string, source?: string, plot: string }} choices
   */
  ask({ oldest, newest }, { target, source, plot }) {
    const now = this.hooks.now();
    if (!(newest > oldest)) return;
    // A recording is asked about once; of what goes on there is soon more.
    const end = `${oldest} ${newest}`;
    if (now - this.asked.marks > MARKS_EVERY && this.asked.end !== end) {
      this.asked.marks = now;
      this.asked.end = end;
      this.hooks.want("marks", {});
    }
    if (!target || !source || plot === "none") {
      this.series = null;
      this.asked.key = "";
      return;
    }
    const key = JSON.stringify([target, source]);
    const other = key !== this.asked.key;
    if (other) this.series = null;
    if (!other && (now - this.asked.series < SERIES_EVERY || this.asked.span === end)) return;
    const count = Math.max(2, Math.min(MOST_MOMENTS, Math.round(this.plot.clientWidth || 400)));
    this.asked = { ...this.asked, key, series: now, span: end };
    this.hooks.want("series", { target, source, from: oldest, to: newest, count });
  }

  /**
   * @param {import("./timeline.js").Timeline} timeline
   * @param {{ target?: string, source?: string, plot: string, theme: string }} choices
   * @param {string[]} chain the frames between the pair
   */
  draw({ at, reach }, choices, chain) {
    const width = this.ruler.clientWidth;
    this.scale = new Scale(reach, THUMB, width - THUMB);
    this.gaps = shownGaps(this.marks.gaps, new Set(chain), reach);
    const style = getComputedStyle(document.documentElement);
    const ink = { text: style.getPropertyValue("--soft") || "#888", edge: style.getPropertyValue("--edge") || "#ccc", tones: TONES[choices.theme] };
    this.drawRuler(ink, reach);
    const { series } = this;
    const plotted = choices.plot !== "none" && series !== null && series.target === choices.target && series.source === choices.source;
    if (this.plot.hidden === plotted) this.plot.hidden = !plotted;
    if (plotted) this.drawPlot(ink, at, reach.newest, /** @type {keyof typeof PLOTS} */ (choices.plot));
  }

  drawRuler(ink, reach) {
    const { pen, width, height } = fresh(this.ruler);
    pen.font = "10.5px system-ui, sans-serif";
    pen.textBaseline = "top";
    pen.fillStyle = `${SEVERITIES.error}66`;
    for (const { from, to } of this.gaps) {
      pen.fillRect(this.scale.pixel(from), height - 6, Math.max(2, this.scale.pixel(to) - this.scale.pixel(from)), 6);
    }
    for (const { at, text } of ticks(reach, width - 2 * THUMB)) {
      const pixel = this.scale.pixel(at);
      pen.fillStyle = ink.text;
      pen.fillRect(Math.round(pixel), height - 5, 1, 5);
      const size = pen.measureText(text).width;
      pen.fillText(text, Math.min(width - size, Math.max(0, pixel - size / 2)), 1);
    }
    for (const { since, severity } of [...this.marks.findings].reverse()) {
      if (since < reach.oldest || since > reach.newest) continue;
      const pixel = this.scale.pixel(since);
      pen.fillStyle = SEVERITIES[severity] ?? ink.text;
      pen.beginPath();
      pen.moveTo(pixel, height);
      pen.lineTo(pixel - 4.5, height - 8);
      pen.lineTo(pixel + 4.5, height - 8);
      pen.fill();
    }
  }

  drawPlot(ink, at, newest, plot) {
    const { pen, width, height } = fresh(this.plot);
    const lines = linesOf(this.series, plot);
    const [least, most] = (this.limits = bounds(lines));
    const y = (value) => height - 2 - ((value - least) / (most - least)) * (height - LEGEND - 4);
    pen.font = "10.5px system-ui, sans-serif";
    pen.fillStyle = `${SEVERITIES.error}22`;
    for (const { from, to } of this.gaps) {
      pen.fillRect(this.scale.pixel(from), LEGEND, Math.max(1, this.scale.pixel(to) - this.scale.pixel(from)), height);
    }
    if (least < 0 && most > 0) {
      pen.fillStyle = ink.edge;
      pen.fillRect(THUMB, Math.round(y(0)), width - 2 * THUMB, 1);
    }
    pen.lineWidth = 1.5;
    pen.lineJoin = "round";
    const { times } = this.series;
    for (const { name, values } of lines) {
      pen.strokeStyle = ink.tones[TONE_OF[name]];
      pen.beginPath();
      for (const run of runs(values, plot === "rpy")) {
        run.forEach(([at, value], place) => {
          const pixel = this.scale.pixel(times[at]);
          if (place === 0) pen.moveTo(pixel, y(value));
          pen.lineTo(pixel + (run.length === 1 ? 1 : 0), y(value));
        });
      }
      pen.stroke();
    }
    pen.fillStyle = ink.text;
    pen.fillRect(Math.round(this.scale.pixel(at ?? newest)), LEGEND, 1, height);
    this.legend(pen, ink, lines, at, PLOTS[plot].unit);
    pen.fillStyle = ink.text;
    pen.textBaseline = "top";
    pen.fillText(`${number(least, 2)} … ${number(most, 2)} ${PLOTS[plot].unit}`, THUMB, 1);
  }

  /** Each line's name and value at the moment, or its newest one in the present, at the right end above the lines. */
  legend(pen, ink, lines, at, unit) {
    const { times } = this.series;
    const exact = ((at - times[0]) / (times[times.length - 1] - times[0])) * (times.length - 1);
    let right = this.plot.clientWidth - THUMB;
    pen.textBaseline = "top";
    for (const { name, values } of [...lines].reverse()) {
      const text = `${name} ${number(at === null ? newestOf(values) : valueAt(values, exact, unit === "°"), 3)} ${unit}`;
      right -= pen.measureText(text).width;
      pen.fillStyle = ink.tones[TONE_OF[name]];
      pen.fillText(text, right, 1);
      right -= 12;
    }
  }
}

/** A canvas as large as it is shown, empty. */
function fresh(canvas) {
  const width = canvas.clientWidth;
  const height = canvas.clientHeight;
  const ratio = devicePixelRatio || 1;
  const [across, down] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== across || canvas.height !== down) [canvas.width, canvas.height] = [across, down];
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  return { pen, width, height };
}
