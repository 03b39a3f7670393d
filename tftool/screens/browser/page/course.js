// @ts-check
// Ruler and plot: request their data, draw them, and go to the clicked time.
import { number } from "./format.js";
import { $ } from "./panels.js";
import { bounds, extended, levels, linesOf, newestOf, placeOf, PLOTS, runs, Scale, shownGaps, ticks, valueAt } from "./ruler.js";

const THUMB = 8; // pixels from the slider's end to the middle of its handle
const GUTTER = 46; // pixels at the left, for values; the same number is in page.css
const NEAR = 5; // pixels
const DRAGGED = 3; // pixels
const ZOOM = 0.0015; // zoom for each pixel of the wheel
const LEGEND = 15; // pixels above the lines, for the legend
// Colours of lines and of their names, which must be readable.
const [RED, GREEN, BLUE, BROWN] = [0, 1, 2, 3];
const TONES = {
  dark: ["#ff7a80", "#4cc38a", "#7fa8ff", "#e0a83a"],
  light: ["#c62a2f", "#18794e", "#2458d3", "#8a5a00"],
};
const TONE_OF = { x: RED, y: GREEN, z: BLUE, roll: RED, pitch: GREEN, yaw: BLUE, distance: BROWN };
const SEVERITIES = { error: "#e5484d", warning: "#d08700", note: "#7a8699" };
const MOST_MOMENTS = 1000;
const SERIES_EVERY = 500; // milliseconds, while live
const ZOOMED_EVERY = 120; // milliseconds, while the user zooms or pans
const MOST_LATER = 5000; // poses stored after the end of the series
const MARKS_EVERY = 5000;

export class Course {
  /**
   * @param {import("./timeline.js").Timeline} timeline
   * @param {{ want(request: import("./messages.js").Request): void, now(): number, redraw(): void }} hooks
   */
  constructor(timeline, hooks) {
    this.timeline = timeline;
    this.hooks = hooks;
    /** @type {any[]} poses of the pair that came after the series */
    this.later = [];
    /** @type {number | null} pixel under the pointer */
    this.pointer = null;
    this.ruler = $("ruler");
    this.plot = $("plot");
    /** @type {{ gaps: [string, number, number][], findings: any[] }} */
    this.marks = { gaps: [], findings: [] };
    /** @type {any} */
    this.series = null;
    this.asked = { key: "", span: "", end: "", series: -Infinity, marks: -Infinity, zoomed: 0 };
    /** @type {{ from: number, to: number, frames: string[] }[]} */
    this.gaps = [];
    /** @type {[number, number]} */
    this.limits = [-1, 1];
    this.legended = ""; // text above the lines
    this.scale = new Scale({ oldest: 0, newest: 0 }, 0, 1);
    for (const canvas of [this.ruler, this.plot]) this.wire(canvas);
    $("line").addEventListener("wheel", (event) => this.turn(event), { passive: false });
  }

  /** A click or a drag goes to a time; in a zoomed plot a drag pans. */
  wire(canvas) {
    /** @type {{ x: number, moved: boolean } | null} */
    let held = null;
    const pans = () => canvas === this.plot && this.timeline.window !== null;
    canvas.addEventListener("pointerdown", (event) => {
      held = { x: event.offsetX, moved: false };
      canvas.setPointerCapture(event.pointerId);
      if (!pans()) this.go(event.offsetX);
    });
    canvas.addEventListener("pointermove", (event) => {
      this.point(event.offsetX);
      if (!held) return this.tell(canvas, event.offsetX);
      held.moved ||= Math.abs(event.offsetX - held.x) > DRAGGED;
      if (!pans()) this.go(event.offsetX);
      else if (held.moved) {
        this.timeline.pan(this.scale.moment(held.x) - this.scale.moment(event.offsetX));
        held.x = event.offsetX;
      }
    });
    canvas.addEventListener("pointerup", (event) => {
      if (held && !held.moved && pans()) this.go(event.offsetX);
      held = null;
    });
    canvas.addEventListener("pointercancel", () => (held = null));
    canvas.addEventListener("pointerleave", () => this.point(null));
    canvas.addEventListener("dblclick", () => this.timeline.zoom(0, Infinity));
  }

  point(pixel) {
    this.pointer = pixel;
    this.hooks.redraw();
  }

  /** The wheel zooms around the time under the pointer; sideways, or with Shift, it pans. */
  turn(event) {
    event.preventDefault();
    const sideways = event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY);
    const far = sideways ? event.deltaX || event.deltaY : event.deltaY;
    const { oldest, newest } = this.timeline.span;
    if (!(newest > oldest)) return;
    if (sideways) this.timeline.pan((far / (this.scale.right - this.scale.left)) * (newest - oldest));
    else this.timeline.zoom(this.scale.moment(event.clientX - this.ruler.getBoundingClientRect().left), Math.exp(far * ZOOM));
    this.hooks.redraw();
  }

  /** Go to the time of a pixel, or to the time of the finding at the pixel. */
  go(pixel) {
    this.timeline.scrub(this.finding(pixel)?.since ?? this.scale.moment(pixel));
  }

  finding(pixel) {
    return this.marks.findings.find(
      ({ since, until }) => pixel >= this.scale.pixel(since) - NEAR && pixel <= this.scale.pixel(since) + NEAR && until >= since,
    );
  }

  /** Show the values under the pointer. */
  tell(canvas, pixel) {
    const moment = this.scale.moment(pixel);
    const finding = this.finding(pixel);
    const gap = this.gaps.find(({ from, to }) => moment >= from && moment <= to);
    const lines = [`${number(moment, 3)} s`];
    if (finding) lines.push(`${finding.severity} ${finding.id}: ${finding.message}`);
    if (gap) lines.push(`no data of ${gap.frames.slice(0, 5).join(", ")}${gap.frames.length > 5 ? " …" : ""} for ${number(gap.to - gap.from, 3)} s`);
    canvas.title = lines.join("\n");
  }

  /** Store requested data. */
  setSeries(message) {
    this.series = message;
    const from = message.times[0];
    this.later = this.later.filter(({ moment }) => moment >= from);
  }

  /** Add the pair's newest pose to the plot, because the series is requested less often. */
  add({ found, target, source, moment, translation, rpy }) {
    const last = this.later[this.later.length - 1];
    if (last && (last.target !== target || last.source !== source || last.moment > moment)) this.later = [];
    if (!found || moment === null || last?.moment === moment) return;
    const [x, y, z] = translation;
    const [roll, pitch, yaw] = rpy;
    this.later.push({ target, source, moment, x, y, z, roll, pitch, yaw });
    if (this.later.length > MOST_LATER) this.later.shift();
  }

  setMarks(message) {
    this.marks = message;
  }

  /** Request all data again, after a reconnection or a change of the tree. */
  forget() {
    this.asked = { key: "", span: "", end: "", series: -Infinity, marks: -Infinity, zoomed: 0 };
  }

  /**
   * Request shown data that is unknown or old.
   * @param {{ target?: string, source?: string, plot: string }} choices
   */
  ask({ target, source, plot }) {
    const now = this.hooks.now();
    const { reach, zoomed, span: { oldest, newest } } = this.timeline;
    if (!(newest > oldest)) return;
    // A recording's data is requested once, a session's regularly.
    const end = `${reach.oldest} ${reach.newest}`;
    if (now - this.asked.marks > MARKS_EVERY && this.asked.end !== end) {
      this.asked.marks = now;
      this.asked.end = end;
      this.hooks.want({ type: "marks" });
    }
    if (!target || !source || plot === "none") {
      this.series = null;
      this.asked.key = "";
      return;
    }
    const key = JSON.stringify([target, source]);
    const other = key !== this.asked.key;
    if (other) this.series = null;
    const span = `${oldest} ${newest}`;
    const wait = zoomed === this.asked.zoomed ? SERIES_EVERY : ZOOMED_EVERY;
    if (!other && (now - this.asked.series < wait || this.asked.span === span)) return;
    const count = Math.max(2, Math.min(MOST_MOMENTS, Math.round(this.plot.clientWidth || 400)));
    this.asked = { ...this.asked, key, series: now, span, zoomed };
    this.hooks.want({ type: "series", target, source, from: oldest, to: newest, count });
  }

  /**
   * @param {{ target?: string, source?: string, plot: string, theme: string }} choices
   * @param {string[]} chain the frames between the pair
   */
  draw(choices, chain) {
    const { at, reach, span } = this.timeline;
    const width = this.ruler.clientWidth;
    this.scale = new Scale(span, GUTTER, width - THUMB);
    this.gaps = shownGaps(this.marks.gaps, new Set(chain), span);
    const style = getComputedStyle(document.documentElement);
    const ink = { text: style.getPropertyValue("--soft") || "#888", edge: style.getPropertyValue("--edge") || "#ccc", tones: TONES[choices.theme] };
    this.drawRuler(ink, span);
    const { series } = this;
    const plotted = choices.plot !== "none" && series !== null && series.target === choices.target && series.source === choices.source;
    if (this.plot.hidden === plotted) this.plot.hidden = !plotted;
    if (plotted) this.drawPlot(ink, at, at ?? reach.newest, /** @type {keyof typeof PLOTS} */ (choices.plot));
  }

  drawRuler(ink, span) {
    const { pen, width, height } = fresh(this.ruler);
    pen.font = "10.5px system-ui, sans-serif";
    pen.textBaseline = "top";
    pen.fillStyle = `${SEVERITIES.error}66`;
    for (const { from, to } of this.gaps) {
      pen.fillRect(this.scale.pixel(from), height - 6, Math.max(2, this.scale.pixel(to) - this.scale.pixel(from)), 6);
    }
    for (const { at, text } of ticks(span, width - GUTTER - THUMB)) {
      const pixel = this.scale.pixel(at);
      pen.fillStyle = ink.text;
      pen.fillRect(Math.round(pixel), height - 5, 1, 5);
      const size = pen.measureText(text).width;
      pen.fillText(text, Math.min(width - size, Math.max(GUTTER - THUMB, pixel - size / 2)), 1);
    }
    for (const { since, severity } of [...this.marks.findings].reverse()) {
      if (since < span.oldest || since > span.newest) continue;
      const pixel = this.scale.pixel(since);
      pen.fillStyle = SEVERITIES[severity] ?? ink.text;
      pen.beginPath();
      pen.moveTo(pixel, height);
      pen.lineTo(pixel - 4.5, height - 8);
      pen.lineTo(pixel + 4.5, height - 8);
      pen.fill();
    }
  }

  drawPlot(ink, at, looked, plot) {
    const { pen, width, height } = fresh(this.plot);
    if (!width) return; // in a low window there is no plot
    const series = extended(this.series, at === null ? this.later : []);
    const lines = linesOf(series, plot);
    const { unit } = PLOTS[plot];
    const [least, most] = (this.limits = bounds(lines));
    const tall = height - LEGEND - 4;
    const y = (value) => height - 2 - ((value - least) / (most - least)) * tall;
    pen.font = "10.5px system-ui, sans-serif";
    pen.textBaseline = "middle";
    pen.textAlign = "right";
    for (const { value, text } of levels(this.limits, tall)) {
      pen.fillStyle = ink.edge;
      pen.fillRect(GUTTER, Math.round(y(value)), width - GUTTER - THUMB, 1);
      pen.fillStyle = ink.text;
      pen.fillText(text, GUTTER - 6, Math.min(height - 6, y(value)));
    }
    pen.textBaseline = "top";
    pen.fillText(unit, GUTTER - 6, 1);
    pen.textAlign = "left";
    pen.fillStyle = `${SEVERITIES.error}22`;
    for (const { from, to } of this.gaps) {
      pen.fillRect(this.scale.pixel(from), LEGEND, Math.max(1, this.scale.pixel(to) - this.scale.pixel(from)), height);
    }
    pen.save();
    pen.beginPath();
    pen.rect(GUTTER, 0, width - GUTTER - THUMB + 1, height);
    pen.clip();
    this.drawLines(pen, ink, series.times, lines, y, plot === "rpy");
    pen.fillStyle = ink.text;
    pen.fillRect(Math.round(this.scale.pixel(looked)), LEGEND, 1, height);
    if (this.pointer !== null) {
      pen.globalAlpha = 0.5;
      pen.fillRect(Math.round(this.pointer), LEGEND, 1, height);
    }
    pen.restore();
    this.legend(pen, ink, series.times, lines, at, unit);
  }

  drawLines(pen, ink, times, lines, y, circular) {
    pen.lineWidth = 1.5;
    pen.lineJoin = "round";
    for (const { name, values } of lines) {
      pen.strokeStyle = ink.tones[TONE_OF[name]];
      pen.beginPath();
      for (const run of runs(values, circular)) {
        run.forEach(([at, value], place) => {
          const pixel = this.scale.pixel(times[at]);
          if (place === 0) pen.moveTo(pixel, y(value));
          pen.lineTo(pixel + (run.length === 1 ? 1 : 0), y(value));
        });
      }
      pen.stroke();
    }
  }

  /** Name and value of each line (under the pointer, at the shown time, or the newest), above the lines at the right. */
  legend(pen, ink, times, lines, at, unit) {
    const moment = this.pointer === null ? at : this.scale.moment(this.pointer);
    const place = moment === null ? null : placeOf(times, moment);
    const value = (values) =>
      moment === null ? newestOf(values) : place === null ? null : valueAt(values, place, unit === "°");
    const parts = lines.map(({ name, values }) => ({ text: `${name} ${number(value(values), 3)} ${unit}`, tone: ink.tones[TONE_OF[name]] }));
    if (this.pointer !== null) parts.unshift({ text: `at ${number(moment, 3)} s`, tone: ink.text });
    this.legended = parts.map(({ text }) => text).join("  ");
    let right = this.plot.clientWidth - THUMB;
    pen.textBaseline = "top";
    for (const { text, tone } of parts.reverse()) {
      right -= pen.measureText(text).width;
      pen.fillStyle = tone;
      pen.fillText(text, right, 1);
      right -= 12;
    }
  }
}

/** Clear a canvas, and set the canvas to the size in which it is shown. */
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
