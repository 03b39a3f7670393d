// @ts-check
// Points, paths, clouds, scans and markers in the picture, with their switches.
import { Group, Quaternion, Vector3 } from "three";
import { ball } from "./displays/ball.js";
import { line, segments } from "./displays/line.js";
import { box, cone, cylinder, sphere, triangles, words } from "./displays/markers.js";
import { points } from "./displays/points.js";
import { compose } from "./maths.js";
import { $ } from "./panels.js";

const SHAPES = { ball, box, cone, cylinder, line, points, segments, sphere, triangles, words };
const COLORS = ["#00a2c7", "#d6409f", "#f76b15", "#8e4ec6", "#46a758", "#c2a400"];

export class Displays {
  /**
   * @param {import("three").Scene} scene
   * @param {import("./tracks.js").Tracks} tracks
   * @param {(topic: string) => void} toggle
   */
  constructor(scene, tracks, toggle) {
    this.tracks = tracks;
    this.toggle = toggle;
    this.group = new Group();
    scene.add(this.group);
    /** @type {Map<string, { message: import("./tracks.js").Message, parts: any[], trouble: string }>} */
    this.shown = new Map();
    /** @type {Map<string, HTMLElement>} */
    this.switches = new Map();
  }

  /**
   * Place the message of every topic.
   * @param {number | null} moment null for the present
   * @param {import("./model.js").Model} model with the poses in the fixed frame
   * @param {Set<string>} undrawn topics that are switched off
   */
  place(moment, model, undrawn) {
    for (const topic of [...this.shown.keys()]) if (!this.tracks.topics.has(topic)) this.drop(topic);
    const now = moment ?? model.poses?.now ?? -Infinity;
    let color = 0;
    for (const { topic } of this.tracks.topics.values()) {
      const message = this.tracks.at(topic, moment);
      const tint = COLORS[color++ % COLORS.length];
      if (this.shown.get(topic)?.message !== message) this.drop(topic);
      if (!message) continue;
      let one = this.shown.get(topic);
      if (!one) {
        one = { message, parts: message.shapes.map((shape) => this.made(shape, tint)), trouble: "" };
        this.shown.set(topic, one);
      }
      one.trouble = "";
      one.parts.forEach((part, index) => {
        const shape = message.shapes[index];
        const pose = whereIs(shape, model);
        if (!pose) one.trouble = `no transform from [${shape.frame}] to the fixed frame`;
        part.visible = pose !== null && !undrawn.has(topic) && now < shape.until;
        if (!pose) return;
        const [place, turn] = [new Vector3().fromArray(pose, 0), new Quaternion().fromArray(pose, 3)];
        part.matrix.compose(place, turn, new Vector3(1, 1, 1));
        part.matrixWorldNeedsUpdate = true;
      });
    }
  }

  /** @param {import("./tracks.js").Shape} shape */
  made(shape, tint) {
    const part = SHAPES[shape.kind](shape, tint);
    part.matrixAutoUpdate = false;
    part.traverse((one) => (one.frustumCulled = false));
    this.group.add(part);
    return part;
  }

  /**
   * Frame and position of the drawn point nearest to a ray; null without a point near the ray.
   * @param {import("three").Raycaster} ray
   */
  pick(ray) {
    /** @type {any} */
    let best = null;
    for (const { message, parts } of this.shown.values()) {
      parts.forEach((part, at) => {
        if (!part.visible) return;
        part.updateMatrixWorld();
        for (const { point, distance, index } of ray.intersectObject(part, true)) {
          // For a cloud, three.js returns the place on the ray nearest to the point.
          if (part.type === "Points" && index !== undefined) {
            point.fromBufferAttribute(part.geometry.attributes.position, index).applyMatrix4(part.matrixWorld);
          }
          const { root, frame } = message.shapes[at];
          if (!best || distance < best.distance) best = { frame: root ?? frame, point: point.toArray(), distance };
        }
      });
    }
    return best;
  }

  /** @param {string} topic */
  drop(topic) {
    for (const part of this.shown.get(topic)?.parts ?? []) {
      this.group.remove(part);
      part.traverse((one) => {
        one.geometry?.dispose();
        one.material?.map?.dispose();
        one.material?.dispose();
        one.dispose?.(); // the matrices of many solids
      });
    }
    this.shown.delete(topic);
  }

  /** Drawn message of each topic, for tests: stamp, number of positions, kinds of shapes. */
  drawn() {
    const found = {};
    for (const [topic, { message, parts }] of this.shown) {
      const seen = message.shapes.filter((_, at) => parts[at].visible);
      if (!seen.length) continue;
      const first = new Vector3().fromArray(seen[0].places(), 0).applyMatrix4(parts[message.shapes.indexOf(seen[0])].matrix).toArray();
      const count = seen.reduce((sum, shape) => sum + shape.count, 0);
      found[topic] = { count, stamp: message.stamp, kinds: seen.map(({ kind }) => kind), first };
    }
    return found;
  }

  /** Draw the switches, and the faults of topics. */
  list(undrawn) {
    const topics = [...this.tracks.topics.values()];
    $("displays").hidden = topics.length === 0;
    for (const [topic, row] of this.switches) {
      if (this.tracks.topics.has(topic)) continue;
      row.remove();
      this.switches.delete(topic);
    }
    for (const { topic, type, faults } of topics) {
      let row = this.switches.get(topic);
      if (!row) {
        row = document.createElement("button");
        row.className = "switch";
        row.textContent = topic;
        row.onclick = () => this.toggle(topic);
        $("topics").append(row);
        this.switches.set(topic, row);
      }
      const trouble = [...faults, this.shown.get(topic)?.trouble ?? ""].filter(Boolean).join("\n");
      row.title = trouble ? `${type}\n${trouble}` : type;
      row.classList.toggle("warn", trouble !== "");
      row.setAttribute("aria-pressed", String(!undrawn.has(topic)));
    }
  }
}

/**
 * Pose of a shape's frame in the fixed frame, at the shape's stamp if known.
 * @param {import("./tracks.js").Shape} shape
 * @param {import("./model.js").Model} model
 */
function whereIs({ frame, root, pose }, model) {
  const of = (name) => model.absolute[model.index.get(name) ?? -1] ?? null;
  if (root === null || pose === null) return of(frame);
  const above = of(root);
  return above ? compose(above, pose) : null;
}
