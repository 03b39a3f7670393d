// @ts-check
// Many small things as one mesh. A processor that plays graphics card pays for every instance as
// for a picture of its own, and for every corner; put together here from tetrahedra, hundreds of
// frames are drawn at once.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, MeshBasicMaterial } from "three";

const CORNERS = 4;
const SIDES = [0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2]; // seen from outside, counterclockwise
const SHADES = [0.9, 1, 0.82, 0.66]; // of the corners
const LEAST = 1024;

/** Corners of a spike that goes a metre along y, and is so thick where it begins. */
function spike(thick) {
  const [half, high] = [-thick / 2, (thick * Math.sqrt(3)) / 2];
  return [[0, 1, 0], [thick, 0, 0], [half, 0, -high], [half, 0, high]];
}

/** The shapes a frame is drawn with: along x, y and z, where it is, the way to its parent. */
export const SPIKES = {
  x: spike(1.4).map(([x, y, z]) => [y, -x, z]).flat(),
  y: spike(1.4).flat(),
  z: spike(1.4).map(([x, y, z]) => [x, -z, y]).flat(),
  hub: spike(1).map(([x, y, z]) => [x, y * 1.3 - 0.3, z]).flat(),
  shaft: spike(1.4).flat(),
  head: spike(1).flat(),
};

export class Crowd {
  constructor() {
    // One side, so that three draws them in one go.
    const material = new MeshBasicMaterial({ vertexColors: true, transparent: true });
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;
    this.room = 0; // shapes that fit
    this.count = 0;
    this.places = new Float32Array(0);
    this.colors = new Uint8Array(0);
    this.begin();
  }

  begin() {
    this.count = 0;
    this.mesh.visible = false;
  }

  /**
   * Add a shape, given by its four corners, moved by a matrix.
   * @param {number[]} corners
   * @param {import("three").Matrix4} matrix
   * @param {number} red @param {number} green @param {number} blue @param {number} alpha
   */
  add(corners, { elements: m }, red, green, blue, alpha) {
    if (this.count === this.room) this.grow();
    const { places, colors } = this;
    let place = 3 * CORNERS * this.count;
    let paint = 4 * CORNERS * this.count++;
    for (let corner = 0; corner < CORNERS; corner++) {
      const x = corners[3 * corner];
      const y = corners[3 * corner + 1];
      const z = corners[3 * corner + 2];
      places[place++] = m[0] * x + m[4] * y + m[8] * z + m[12];
      places[place++] = m[1] * x + m[5] * y + m[9] * z + m[13];
      places[place++] = m[2] * x + m[6] * y + m[10] * z + m[14];
      const shade = 255 * SHADES[corner];
      colors[paint++] = red * shade;
      colors[paint++] = green * shade;
      colors[paint++] = blue * shade;
      colors[paint++] = 255 * alpha;
    }
  }

  end() {
    const { geometry } = this.mesh;
    this.mesh.visible = this.count > 0;
    if (!this.count) return;
    geometry.setDrawRange(0, SIDES.length * this.count);
    for (const [name, size] of [["position", 3], ["color", 4]]) {
      const attribute = /** @type {BufferAttribute} */ (geometry.attributes[name]);
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, Number(size) * CORNERS * this.count);
      attribute.needsUpdate = true;
    }
  }

  grow() {
    this.room = Math.max(LEAST, 2 * this.room);
    const [places, colors] = [new Float32Array(3 * CORNERS * this.room), new Uint8Array(4 * CORNERS * this.room)];
    places.set(this.places);
    colors.set(this.colors);
    [this.places, this.colors] = [places, colors];
    const index = new Uint32Array(SIDES.length * this.room);
    for (let at = 0; at < index.length; at++) index[at] = SIDES[at % SIDES.length] + CORNERS * Math.floor(at / SIDES.length);
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    this.mesh.geometry.setIndex(new BufferAttribute(index, 1));
    this.mesh.geometry.setAttribute("position", new BufferAttribute(places, 3).setUsage(DynamicDrawUsage));
    this.mesh.geometry.setAttribute("color", new BufferAttribute(colors, 4, true).setUsage(DynamicDrawUsage));
  }
}
