// @ts-check
// Many small objects as one mesh, which is put together for every picture. Without a graphics card,
// every instance costs as much as a separate mesh, and every vertex has a cost. If there are many
// frames, each object is therefore a tetrahedron.
import {
  BufferAttribute, BufferGeometry, ConeGeometry, CylinderGeometry, DynamicDrawUsage, Mesh, MeshBasicMaterial, OctahedronGeometry,
} from "three";
import { mergeVertices } from "three/addons/utils/BufferGeometryUtils.js";

const LEAST = 4096; // vertices for which the first buffers have space
const DARK = 0.62; // brightness of faces that the light does not reach

/** @typedef {{ places: number[], normals: number[], index: number[] }} Thing */

/** @param {BufferGeometry} geometry @returns {Thing} */
function thing(geometry) {
  const { attributes, index } = mergeVertices(geometry.deleteAttribute("uv"));
  return { places: [...attributes.position.array], normals: [...attributes.normal.array], index: [...(index?.array ?? [])] };
}

/** A spike of one metre along y, with the given thickness at the beginning. */
function spike(thick) {
  const [half, high] = [-thick / 2, (thick * Math.sqrt(3)) / 2];
  const corners = [0, 1, 0, thick, 0, 0, half, 0, -high, half, 0, high];
  const made = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(corners), 3));
  const outward = corners.map((value, at) => (at < 3 ? value : value / thick));
  made.setAttribute("normal", new BufferAttribute(new Float32Array(outward), 3));
  return made.setIndex([0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2]); // seen from outside, counterclockwise
}

const rod = (sides, open = false) => new CylinderGeometry(1, 1, 1, sides, 1, open).translate(0, 0.5, 0);

/** Objects that a frame is drawn with: axes x, y and z, origin, and line to the parent; also with few vertices. */
export const [FINE, COARSE] = [
  { rod: () => rod(8), hub: new OctahedronGeometry(1, 1), shaft: rod(6, true), head: new ConeGeometry(1, 1, 10).translate(0, 0.5, 0) },
  { rod: () => spike(1.4), hub: spike(1).scale(1, 1.3, 1).translate(0, -0.3, 0), shaft: spike(1.4), head: spike(1) },
].map(({ rod, hub, shaft, head }) => ({
  x: thing(rod().rotateZ(-Math.PI / 2)),
  y: thing(rod()),
  z: thing(rod().rotateX(Math.PI / 2)),
  hub: thing(hub),
  shaft: thing(shaft),
  head: thing(head),
}));

export class Crowd {
  constructor() {
    // One side, so that three.js draws them in one call.
    const material = new MeshBasicMaterial({ vertexColors: true, transparent: true });
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;
    this.places = new Float32Array(0);
    this.colors = new Uint8Array(0);
    this.index = new Uint32Array(0);
    this.corners = this.sides = 0; // numbers of used vertices and faces
    this.begin();
  }

  begin() {
    this.corners = this.sides = 0;
    this.mesh.visible = false;
  }

  /**
   * Add an object, moved by a matrix.
   * @param {Thing} thing
   * @param {import("three").Matrix4} matrix
   * @param {import("three").Vector3} light direction of the light, seen from the object
   * @param {number[]} color red, green, blue and alpha
   */
  add({ places: own, normals, index }, { elements: m }, light, [red, green, blue, alpha]) {
    if (3 * this.corners + own.length > this.places.length || this.sides + index.length > this.index.length) this.grow();
    const { places, colors, corners } = this;
    for (const corner of index) this.index[this.sides++] = corners + corner;
    for (let at = 0; at < own.length; at += 3) {
      const [x, y, z] = [own[at], own[at + 1], own[at + 2]];
      const lit = normals[at] * light.x + normals[at + 1] * light.y + normals[at + 2] * light.z;
      const shade = 255 * (DARK + (1 - DARK) * Math.max(0, lit));
      const place = 3 * this.corners;
      places[place] = m[0] * x + m[4] * y + m[8] * z + m[12];
      places[place + 1] = m[1] * x + m[5] * y + m[9] * z + m[13];
      places[place + 2] = m[2] * x + m[6] * y + m[10] * z + m[14];
      const paint = 4 * this.corners++;
      colors[paint] = red * shade;
      colors[paint + 1] = green * shade;
      colors[paint + 2] = blue * shade;
      colors[paint + 3] = 255 * alpha;
    }
  }

  end() {
    const { geometry } = this.mesh;
    this.mesh.visible = this.sides > 0;
    if (!this.sides) return;
    geometry.setDrawRange(0, this.sides);
    const counts = { position: 3 * this.corners, color: 4 * this.corners, index: this.sides };
    for (const [name, count] of Object.entries(counts)) {
      const attribute = /** @type {BufferAttribute} */ (name === "index" ? geometry.index : geometry.attributes[name]);
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, count);
      attribute.needsUpdate = true;
    }
  }

  /** Double the size of the buffers. */
  grow() {
    const room = Math.max(LEAST, (2 * this.places.length) / 3);
    const wider = (before, made) => (made.set(before), made);
    this.places = wider(this.places, new Float32Array(3 * room));
    this.colors = wider(this.colors, new Uint8Array(4 * room));
    this.index = wider(this.index, new Uint32Array(6 * room));
    const geometry = new BufferGeometry();
    geometry.setIndex(new BufferAttribute(this.index, 1).setUsage(DynamicDrawUsage));
    geometry.setAttribute("position", new BufferAttribute(this.places, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute("color", new BufferAttribute(this.colors, 4, true).setUsage(DynamicDrawUsage));
    this.mesh.geometry.dispose();
    this.mesh.geometry = geometry;
  }
}
