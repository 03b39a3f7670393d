// @ts-check
// The grid on the ground: cells large enough to be distinguished, as far as the world extends.
import { BufferAttribute, BufferGeometry, Color, LineBasicMaterial, LineSegments } from "three";
import { cellFor, linesOf } from "./scale.js";

/** Parts that can be drawn alone. */
export const LAYER = 1;

const AXES = { x: "#c4474c", y: "#3f9a52" };

export class Ground {
  /** @param {import("three").Scene} scene */
  constructor(scene) {
    const material = new LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false });
    this.lines = new LineSegments(new BufferGeometry(), material);
    this.lines.frustumCulled = false;
    this.lines.renderOrder = -1;
    this.lines.position.z = -1e-4;
    this.lines.layers.enable(LAYER);
    scene.add(this.lines);
    this.key = "";
    this.cell = 1;
  }

  /**
   * @param {boolean} shown
   * @param {number} level metres above the origin
   * @param {{ pixel: number, middle: number[], reach: number, flat: boolean }} seen metres per pixel, the point
   *   looked at, and the extent of the view or the world around it, metres; flat: seen from above
   * @param {string[]} colors of strong and weak lines
   */
  draw(shown, level, { pixel, middle, reach, flat }, colors) {
    this.lines.visible = shown;
    this.cell = cellFor(pixel);
    if (!shown) return;
    const { cell } = this;
    const wide = 10 * cell;
    const count = Math.max(10, Math.min(60, 10 * Math.ceil(reach / wide + 0.5)));
    const centre = middle.map((value) => Math.round(value / wide) * wide);
    this.lines.position.z = level - 1e-4;
    const key = `${level} ${cell} ${count} ${centre} ${flat} ${colors}`;
    if (key === this.key) return;
    this.key = key;
    const places = [];
    const paints = [];
    const color = new Color();
    for (const { from, to, kind, faded } of linesOf(centre, cell, count, flat)) {
      color.set(kind === "x" || kind === "y" ? AXES[kind] : kind === "strong" ? colors[0] : colors[1]);
      places.push(from[0], from[1], 0, to[0], to[1], 0);
      for (const alpha of faded) paints.push(color.r, color.g, color.b, alpha);
    }
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry();
    this.lines.geometry.setAttribute("position", new BufferAttribute(new Float32Array(places), 3));
    this.lines.geometry.setAttribute("color", new BufferAttribute(new Float32Array(paints), 4));
  }
}
