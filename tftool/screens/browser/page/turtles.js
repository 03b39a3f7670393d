// @ts-check
// Turtles as flat figures at their frames, head along x, one metre long.
import { Color, DoubleSide, Group, Mesh, MeshBasicMaterial, Shape, ShapeGeometry, Vector2 } from "three";

const MOST = 40; // turtles drawn as figures
const ROUND = 24; // corners of a shell

/** An ellipse as a shape: middle, half axes, turn. */
function ellipse(x, y, long, wide, turn = 0) {
  const points = [];
  for (let at = 0; at < ROUND; at++) {
    const angle = (2 * Math.PI * at) / ROUND;
    points.push(new Vector2(long * Math.cos(angle), wide * Math.sin(angle)).rotateAround(new Vector2(), turn).add(new Vector2(x, y)));
  }
  return new ShapeGeometry(new Shape(points));
}

/** A polygon inside the shell: one plate of the shell. */
function plate(...corners) {
  return new ShapeGeometry(new Shape(corners.map(([x, y]) => new Vector2(x, y))));
}

// Geometry, height above the ground, and lightness relative to the turtle's colour.
const LEG = 0.72;
const PARTS = [
  [ellipse(0.27, 0.25, 0.16, 0.075, 0.7), 0, LEG],
  [ellipse(0.27, -0.25, 0.16, 0.075, -0.7), 0, LEG],
  [ellipse(-0.28, 0.23, 0.13, 0.065, -0.7), 0, LEG],
  [ellipse(-0.28, -0.23, 0.13, 0.065, 0.7), 0, LEG],
  [plate([-0.36, 0.05], [-0.5, 0], [-0.36, -0.05]), 0, LEG],
  [ellipse(0.43, 0, 0.13, 0.1), 0, 0.86],
  [ellipse(0, 0, 0.36, 0.28), 0.002, 0.55],
  [ellipse(0, 0, 0.32, 0.24), 0.004, 1],
  [plate([0.12, 0], [0.06, 0.11], [-0.08, 0.11], [-0.15, 0], [-0.08, -0.11], [0.06, -0.11]), 0.006, 0.7],
  [ellipse(0.48, 0.05, 0.018, 0.018), 0.006, 0.1],
  [ellipse(0.48, -0.05, 0.018, 0.018), 0.006, 0.1],
];

export class Turtles {
  /** @param {import("three").Scene} scene */
  constructor(scene) {
    this.group = new Group();
    scene.add(this.group);
    /** @type {Map<string, { all: Group, paints: { paint: MeshBasicMaterial, light: number }[] }>} */
    this.known = new Map();
  }

  figure(name) {
    let found = this.known.get(name);
    if (!found) {
      const all = new Group();
      all.matrixAutoUpdate = false;
      const paints = PARTS.map(([geometry, height, light], order) => {
        const paint = new MeshBasicMaterial({ side: DoubleSide, transparent: true, depthWrite: false });
        const part = new Mesh(/** @type {any} */ (geometry), paint);
        part.position.z = Number(height) - 0.01;
        part.renderOrder = order + 1;
        all.add(part);
        return { paint, light: Number(light) };
      });
      this.group.add(all);
      found = { all, paints };
      this.known.set(name, found);
    }
    return found;
  }

  /**
   * Place the figures.
   * @param {{ name: string, pose: number[], color: string, alpha: number, grey: number }[]} turtles
   * @param {(group: Group, pose: number[]) => void} place
   */
  draw(turtles, place) {
    for (const { all } of this.known.values()) all.visible = false;
    const own = new Color();
    for (const { name, pose, color, alpha, grey } of turtles.slice(0, MOST)) {
      const { all, paints } = this.figure(name);
      all.visible = true;
      place(all, pose);
      own.setStyle(color);
      const middle = (own.r + own.g + own.b) / 3;
      for (const { paint, light } of paints) {
        paint.color.setRGB(own.r + (middle - own.r) * grey, own.g + (middle - own.g) * grey, own.b + (middle - own.b) * grey);
        paint.color.multiplyScalar(light);
        paint.opacity = alpha;
      }
    }
  }
}
