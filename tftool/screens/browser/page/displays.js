// @ts-check
// Points, paths, clouds and scans in the picture, and the switches for them.
import { Group, Quaternion, Vector3 } from "three";
import { ball } from "./displays/ball.js";
import { line } from "./displays/line.js";
import { points } from "./displays/points.js";
import { compose } from "./maths.js";
import { $ } from "./panels.js";

const SHAPES = { ball, line, points };
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
    /** @type {Map<string, { message: import("./tracks.js").Message, shape: any, trouble: string }>} */
    this.shown = new Map();
    /** @type {Map<string, HTMLElement>} */
    this.switches = new Map();
  }

  /**
   * Put every topic's message where it was.
   * @param {number | null} moment
   * @param {import("./model.js").Model} model solved for the fixed frame
   * @param {Set<string>} undrawn topics that are switched off
   */
  place(moment, model, undrawn) {
    for (const [topic, { shape }] of this.shown) if (!this.tracks.topics.has(topic)) this.drop(topic, shape);
    let color = 0;
    for (const { topic, kind } of this.tracks.topics.values()) {
      const message = this.tracks.at(topic, moment);
      const tint = COLORS[color++ % COLORS.length];
      let one = this.shown.get(topic);
      if (one && one.message !== message) {
        this.drop(topic, one.shape);
        one = undefined;
      }
      if (!message) continue;
      if (!one) {
        const shape = SHAPES[kind](message.places(), tint);
        shape.matrixAutoUpdate = false;
        shape.frustumCulled = false;
        this.group.add(shape);
        one = { message, shape, trouble: "" };
        this.shown.set(topic, one);
      }
      const pose = whereIs(message, model);
      one.trouble = pose ? "" : `no transform from [${message.frame}] to the fixed frame`;
      one.shape.visible = pose !== null && !undrawn.has(topic);
      if (pose) {
        const [place, turn] = [new Vector3().fromArray(pose, 0), new Quaternion().fromArray(pose, 3)];
        one.shape.matrix.compose(place, turn, new Vector3(1, 1, 1));
        one.shape.matrixWorldNeedsUpdate = true;
      }
    }
  }

  /**
   * The frame and the place of the nearest point a ray meets; null if it meets none.
   * @param {import("three").Raycaster} ray
   */
  pick(ray) {
    /** @type {any} */
    let best = null;
    for (const { message, shape } of this.shown.values()) {
      if (!shape.visible) continue;
      shape.updateMatrixWorld();
      for (const { point, distance, index } of ray.intersectObject(shape, false)) {
        // Of a cloud, three.js returns the place on the ray that is nearest to the point.
        const { position } = shape.geometry.attributes;
        if (shape.type === "Points" && index !== undefined) point.fromBufferAttribute(position, index).applyMatrix4(shape.matrixWorld);
        if (!best || distance < best.distance) best = { frame: message.root ?? message.frame, point: point.toArray(), distance };
      }
    }
    return best;
  }

  drop(topic, shape) {
    this.group.remove(shape);
    shape.geometry.dispose();
    shape.material.dispose();
    this.shown.delete(topic);
  }

  /** What is in the picture, by topic: how many places, and its message's stamp. */
  drawn() {
    const found = {};
    for (const [topic, { message, shape }] of this.shown) {
      if (!shape.visible) continue;
      const first = new Vector3().fromArray(message.places(), 0).applyMatrix4(shape.matrix).toArray();
      found[topic] = { count: message.places().length / 3, stamp: message.stamp, kind: shape.type, first };
    }
    return found;
  }

  /** The switches, and what is wrong with a topic. */
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
 * Where a message's frame was in the fixed frame, at its own stamp where that is known.
 * @param {import("./tracks.js").Message} message
 * @param {import("./model.js").Model} model
 */
function whereIs({ frame, root, pose }, model) {
  const of = (name) => model.absolute[model.index.get(name) ?? -1] ?? null;
  if (root === null || pose === null) return of(frame);
  const above = of(root);
  return above ? compose(above, pose) : null;
}
