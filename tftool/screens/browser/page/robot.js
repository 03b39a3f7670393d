// @ts-check
// A robot's links as solids: shapes of the robot description, meshes from the server.
import {
  ArrowHelper,
  Box3,
  BoxGeometry,
  CapsuleGeometry,
  Color,
  CylinderGeometry,
  DirectionalLight,
  DoubleSide,
  Group,
  HemisphereLight,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  ShaderMaterial,
  PlaneGeometry,
  Quaternion,
  SphereGeometry,
  SRGBColorSpace,
  TextureLoader,
  Vector3,
} from "three";
import { ColladaLoader } from "three/addons/loaders/ColladaLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";
import { STLLoader } from "three/addons/loaders/STLLoader.js";
import { toCreasedNormals } from "three/addons/utils/BufferGeometryUtils.js";
import { fetchFile } from "./files.js";

import { Places, Solids } from "./solids.js";

const GREY = [0.75, 0.75, 0.77, 1]; // if the description has no colour
const COLLISION = [0.95, 0.45, 0.2, 0.45];
const MISSING = [0.95, 0.25, 0.3, 0.8];
const MISSING_SIZE = 0.1; // metres
const AXIS = "#ffd400";
const AXIS_LENGTH = 0.2; // metres
const SIDES = { fine: 48, plain: 32 }; // number of sides of round shapes; plain: without a graphics card
const CREASE = 0.7; // radians between two facets from which on their edge is sharp
const SHADOW = 2.2; // width of the shadow, in widths of the robot

/**
 * @typedef {{ kind: string, origin: number[], size?: number[], radius?: number, length?: number,
 *   address?: string, scale?: number[], color?: number[], texture?: string }} Shape
 * @typedef {{ frame: string, visuals: Shape[], collisions: Shape[] }} Link
 * @typedef {{ name: string, links: Link[], missing: string[], motion: import("./kinematics.js").Joint[],
 *   joints: { name: string, frame: string, axis: number[], slides: boolean }[],
 *   sliders: { name: string, unit: string, range: number[], position: number }[] }} Description
 * @typedef {{ fixed?: string, grid: boolean, visuals: boolean, collisions: boolean, jointaxes: boolean, opacity: number, bare: Set<string> }} Look
 */

export class Robot {
  /**
   * @param {import("three").Scene} scene
   * @param {() => void} changed called when a mesh was loaded, or failed
   * @param {boolean} plain whether there is no graphics card; then every vertex is costly
   */
  constructor(scene, changed, plain) {
    this.scene = scene;
    this.changed = changed;
    this.sides = plain ? SIDES.plain : SIDES.fine;
    this.group = new Group();
    this.group.visible = false;
    /** @type {Map<string, { number: number, all: Group, visuals: Group, collisions: Group, axes: Group, loose: boolean }>} */
    this.links = new Map(); // loose: whether the link has parts that are drawn one by one
    this.places = new Places(0);
    /** Shapes that are drawn together: all shapes without textures. */
    this.solids = { visuals: new Solids(this.places), collisions: new Solids(this.places) };
    /** Collision shapes not shown so far: loaded when first shown. @type {[string, Shape][]} */
    this.unloaded = [];
    /** @type {string[]} */
    this.missing = [];
    /** @type {Map<string, Promise<import("three").Object3D>>} */
    this.meshes = new Map();
    this.textures = new TextureLoader();
    this.waiting = 0; // meshes still loading
    /** @type {Set<string>} frames of links with a shape, visible or for collisions */
    this.shaped = new Set();
    const above = new HemisphereLight("#ffffff", "#5a6270", 2.2);
    above.position.set(0, 0, 1);
    const sun = new DirectionalLight("#ffffff", 1.6);
    sun.position.set(-3, -4, 8);
    // The lights are in the scene, because markers need lights also without a robot.
    scene.add(above, sun, sun.target, this.group);
    this.shadow = shade();
    scene.add(this.shadow);
    /** @type {Box3 | null} around its shapes, in the fixed frame */
    this.box = null;
    this.boxed = ""; // state for which `box` was computed
    /** @type {Set<string>} frames that joints move */
    this.joints = new Set();
  }

  /** Frames that have a shape. */
  has(frame) {
    return this.shaped.has(frame);
  }

  /** Drawn parts of each link, for tests: numbers of visuals, collisions and axes. */
  drawn() {
    const links = {};
    for (const [frame, { all, visuals, collisions, axes }] of this.links) {
      if (!all.visible) continue;
      const count = (group) => (group.visible ? group.children.length : 0);
      links[frame] = [count(visuals), count(collisions), count(axes)];
    }
    return { links };
  }

  /** @param {Description} description */
  show(description) {
    for (const { all } of this.links.values()) {
      this.group.remove(all);
      all.traverse(release);
    }
    this.links.clear();
    this.meshes.clear();
    for (const solids of Object.values(this.solids)) solids.dispose();
    this.places.texture.dispose();
    this.places = new Places(description.links.length + description.joints.length);
    this.solids = { visuals: new Solids(this.places), collisions: new Solids(this.places) };
    this.group.add(this.solids.visuals.mesh, this.solids.collisions.mesh);
    this.missing = [...description.missing];
    this.boxed = "";
    for (const link of description.links) {
      for (const shape of link.visuals) this.add(link.frame, "visuals", shape, shape.color ?? GREY);
    }
    this.unloaded = description.links.flatMap((link) => link.collisions.map((shape) => /** @type {[string, Shape]} */ ([link.frame, shape])));
    this.shaped = new Set(description.links.filter(({ visuals, collisions }) => visuals.length + collisions.length).map(({ frame }) => frame));
    this.joints = new Set(description.joints.map(({ frame }) => frame));
    for (const joint of description.joints) {
      const way = new Vector3(...joint.axis);
      const arrow = new ArrowHelper(way, new Vector3(), AXIS_LENGTH, AXIS, AXIS_LENGTH / 4, AXIS_LENGTH / 8);
      this.link(joint.frame).axes.add(arrow);
    }
    this.group.visible = true;
  }

  link(frame) {
    let link = this.links.get(frame);
    if (!link) {
      const [all, visuals, collisions, axes] = [new Group(), new Group(), new Group(), new Group()];
      all.matrixAutoUpdate = false;
      all.visible = false;
      all.add(visuals, collisions, axes);
      this.group.add(all);
      link = { number: this.links.size, all, visuals, collisions, axes, loose: false };
      this.links.set(frame, link);
    }
    return link;
  }

  /**
   * @param {string} frame
   * @param {"visuals" | "collisions"} kind
   * @param {Shape} shape
   * @param {number[]} color
   */
  add(frame, kind, shape, color) {
    const link = this.link(frame);
    const solids = this.solids[kind];
    const holder = new Group();
    holder.position.fromArray(shape.origin, 0);
    holder.quaternion.fromArray(shape.origin, 3);
    holder.updateMatrix();
    holder.matrixAutoUpdate = false;
    link[kind].add(holder);
    const geometry = solid(shape, this.sides);
    if (geometry && shape.kind !== "missing" && !shape.texture) {
      solids.add(link.number, geometry, holder.matrix, linear(color));
      return;
    }
    if (geometry) {
      const material = paint(shape.kind === "missing" ? MISSING : color);
      if (shape.kind === "missing") material.wireframe = true;
      if (shape.texture) this.texture(material, shape.texture);
      holder.add(new Mesh(geometry, material));
      link.loose = true;
      return;
    }
    const address = shape.address ?? "";
    this.waiting++;
    this.mesh(address).then(
      (found) => {
        const copy = found.clone(true);
        const sized = new Group();
        sized.scale.fromArray(shape.scale ?? [1, 1, 1]);
        sized.add(copy);
        sized.updateMatrixWorld(true);
        /** @type {Mesh[]} */
        const parts = [];
        copy.traverse((part) => {
          if (part instanceof Mesh) parts.push(part);
        });
        for (const part of parts) {
          // STL and OBJ have no colour; the other formats have materials.
          const plain = /\.(stl|obj)$/i.test(address) || kind === "collisions";
          const tone = plain ? linear(color) : toneOf(part);
          if (tone && !shape.texture) {
            solids.add(link.number, part.geometry, new Matrix4().multiplyMatrices(holder.matrix, part.matrixWorld), tone);
            part.removeFromParent();
            continue;
          }
          if (plain) part.material = paint(color);
          else part.material = Array.isArray(part.material) ? part.material.map((one) => one.clone()) : part.material.clone();
          if (shape.texture && !Array.isArray(part.material)) this.texture(part.material, shape.texture);
          remember(part.material);
          link.loose = true;
        }
        holder.add(sized);
        this.arrived();
      },
      (error) => {
        const box = paint(MISSING);
        box.wireframe = true;
        link.loose = true;
        holder.add(new Mesh(new BoxGeometry(MISSING_SIZE, MISSING_SIZE, MISSING_SIZE), box));
        const name = decodeURIComponent(address.split("/").slice(3).join("/"));
        const sentence = `'${name}' cannot be drawn: ${error instanceof Error ? error.message : error}`;
        if (!this.missing.includes(sentence)) this.missing.push(sentence);
        this.arrived();
      },
    );
  }

  arrived() {
    this.waiting--;
    this.changed();
  }

  texture(material, address) {
    material.map = this.textures.load(address, () => this.changed());
    material.map.colorSpace = SRGBColorSpace;
    material.color = new Color(1, 1, 1);
  }

  /**
   * Compute the box around the robot when all meshes are loaded, if only joints move the robot in the
   * fixed frame. The lowest point of the box is then the level of the ground.
   * @param {string | undefined} fixed
   * @param {import("./model.js").Model} model
   * @param {number} placed links
   */
  settle(fixed, model, placed) {
    const key = `${fixed} ${this.waiting} ${placed}`;
    if (key === this.boxed) return;
    this.boxed = key;
    this.box = null;
    const [link] = this.links.keys();
    if (!placed || model.carrier(fixed, this.joints) !== model.carrier(link, this.joints)) return;
    const box = new Box3();
    this.solids.visuals.surround(box);
    for (const { all, loose } of this.links.values()) {
      if (!loose || !all.visible) continue;
      all.updateMatrixWorld(true);
      box.expandByObject(all);
    }
    if (box.isEmpty()) return;
    this.box = box;
    const size = box.getSize(new Vector3());
    box.getCenter(this.shadow.position).setZ(box.min.z);
    this.shadow.scale.set(SHADOW * size.x, SHADOW * size.y, 1);
  }

  /**
   * Frame and position at which a ray hits the robot; null if the ray misses the robot.
   * @param {import("three").Raycaster} ray
   */
  pick(ray) {
    const hit = this.group.visible ? this.solids.visuals.pick(ray) : null;
    const frame = hit && [...this.links].find(([, { number }]) => number === hit.link)?.[0];
    return hit && frame ? { frame, point: hit.point.toArray(), distance: hit.distance } : null;
  }

  /** Fetch a mesh, once for all links that use it. */
  mesh(address) {
    let found = this.meshes.get(address);
    if (!found) {
      found = load(address);
      this.meshes.set(address, found);
    }
    return found;
  }

  /**
   * Move the links to their frames.
   * @param {import("./frames.js").Frame[]} frames
   * @param {import("./model.js").Model} model
   * @param {Look} look
   */
  place(frames, model, look) {
    if (!this.group.visible) return;
    if (look.collisions) {
      for (const [frame, shape] of this.unloaded.splice(0)) this.add(frame, "collisions", shape, COLLISION);
    }
    for (const { all } of this.links.values()) all.visible = false;
    this.places.clear();
    const turn = new Quaternion();
    const where = new Vector3();
    const one = new Vector3(1, 1, 1);
    let placed = 0;
    for (const { name, pose, filtered } of frames) {
      const link = this.links.get(name);
      if (!link || !pose || filtered || look.bare.has(name)) continue;
      placed++;
      link.all.visible = true;
      link.all.matrix.compose(where.fromArray(pose, 0), turn.fromArray(pose, 3), one);
      this.places.put(link.number, link.all.matrix);
      // A link without separate parts needs no object in the scene.
      link.all.matrixWorldAutoUpdate = link.loose || look.jointaxes;
      link.all.matrixWorldNeedsUpdate = true;
      link.visuals.visible = look.visuals;
      link.collisions.visible = look.collisions;
      link.axes.visible = look.jointaxes;
    }
    this.solids.visuals.show(look.visuals, look.opacity);
    this.settle(look.fixed, model, placed);
    this.shadow.visible = this.box !== null && look.grid && look.visuals;
    this.solids.collisions.show(look.collisions, 1);
    if (this.opacity !== look.opacity || this.painted !== this.waiting) {
      this.opacity = look.opacity;
      this.painted = this.waiting;
      for (const { visuals } of this.links.values()) visuals.traverse((part) => fadePart(part, look.opacity));
    }
  }
}

/** A soft dark disc on the ground below the robot. */
function shade() {
  const material = new ShaderMaterial({
    transparent: true,
    depthWrite: false,
    vertexShader: "varying vec2 at; void main() { at = 2.0 * uv - 1.0; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
    fragmentShader: "varying vec2 at; void main() { float near = max(0.0, 1.0 - length(at)); gl_FragColor = vec4(0.0, 0.0, 0.0, 0.42 * near * near * (3.0 - 2.0 * near)); }",
  });
  const mesh = new Mesh(new PlaneGeometry(1, 1), material);
  mesh.renderOrder = -1;
  mesh.visible = false;
  return mesh;
}

/**
 * Geometry of a primitive shape; null for a mesh. Cylinders are along z, as in ROS.
 * @param {Shape} shape
 * @param {number} sides number of sides of round shapes
 */
function solid({ kind, size = [1, 1, 1], radius = 0, length = 0 }, sides) {
  if (kind === "box") return new BoxGeometry(size[0], size[1], size[2]);
  if (kind === "sphere") return new SphereGeometry(radius, sides, sides / 2);
  if (kind === "cylinder") return new CylinderGeometry(radius, radius, length, sides).rotateX(Math.PI / 2);
  if (kind === "capsule") return new CapsuleGeometry(radius, length, Math.ceil(sides / 4), sides).rotateX(Math.PI / 2);
  if (kind === "missing") return new BoxGeometry(MISSING_SIZE, MISSING_SIZE, MISSING_SIZE);
  return null;
}

/**
 * A description's colour in linear light, and its opacity.
 * @param {number[]} given
 */
function linear(given) {
  const [red, green, blue, alpha] = given;
  const color = new Color().setRGB(red, green, blue, SRGBColorSpace);
  return [color.r, color.g, color.b, alpha];
}

/** Colour of a mesh's part; null if the part has a texture or several materials. */
function toneOf(part) {
  const { material, geometry } = part;
  if (Array.isArray(material) || material.map || material.vertexColors || !material.color) return null;
  if (!geometry.attributes.position || geometry.morphAttributes.position || part.isSkinnedMesh) return null;
  return [material.color.r, material.color.g, material.color.b, material.transparent ? material.opacity : 1];
}

function paint(color) {
  const [red, green, blue, alpha] = color;
  const material = new MeshLambertMaterial({
    color: new Color().setRGB(red, green, blue, SRGBColorSpace),
    side: DoubleSide,
    opacity: alpha,
    transparent: alpha < 1,
  });
  remember(material);
  return material;
}

/** Store the original opacity of a material. */
function remember(material) {
  for (const one of Array.isArray(material) ? material : [material]) one.userData.opaque ??= one.opacity;
}

function fadePart(part, opacity) {
  if (!(part instanceof Mesh)) return;
  for (const material of Array.isArray(part.material) ? part.material : [part.material]) {
    const alpha = (material.userData.opaque ?? 1) * opacity;
    if (material.opacity === alpha) continue;
    material.opacity = alpha;
    material.transparent = alpha < 1;
    material.depthWrite = alpha >= 1;
    material.needsUpdate = true;
  }
}

function release(part) {
  if (!(part instanceof Mesh)) return;
  part.geometry.dispose();
  for (const material of Array.isArray(part.material) ? part.material : [part.material]) material.dispose();
}

/** Fetch and parse a mesh; a failure is an error with a sentence for the user. */
async function load(address) {
  const answer = await fetchFile(address);
  if (!answer.ok) throw new Error((await answer.text()).trim() || `status ${answer.status}`);
  const folder = address.slice(0, address.lastIndexOf("/") + 1);
  const kind = address.slice(address.lastIndexOf(".")).toLowerCase();
  if (kind === ".stl") return new Mesh(toCreasedNormals(new STLLoader().parse(await answer.arrayBuffer()), CREASE));
  if (kind === ".obj") return cleaned(new OBJLoader().parse(await answer.text()));
  if (kind === ".dae") {
    const found = new ColladaLoader().parse(await answer.text(), folder);
    if (!found) throw new Error("the file is not a Collada file");
    // The link determines the upward direction, as in rviz.
    found.scene.rotation.set(0, 0, 0);
    return cleaned(found.scene);
  }
  const found = await new GLTFLoader().parseAsync(await answer.arrayBuffer(), folder);
  return cleaned(found.scene);
}

/** Remove lights and cameras from a loaded mesh. */
function cleaned(scene) {
  const strangers = [];
  scene.traverse((part) => {
    if (part.isLight || part.isCamera) strangers.push(part);
  });
  for (const part of strangers) part.removeFromParent();
  return scene;
}
