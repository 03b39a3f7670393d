// @ts-check
// The picture: three.js for 3-D shapes, two flat canvases for trails, names and the chain.
import {
  Color,
  Matrix4,
  PerspectiveCamera,
  Quaternion,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { distanceFor } from "./bounds.js";
import { FLAT, fitFlat, flatCamera, panOnly } from "./cameras.js";
import { COARSE, Crowd, FINE } from "./crowd.js";
import { Ground, LAYER as GROUND } from "./ground.js";
import { arrange, MANY, overlap, standAt } from "./labels.js";
import { isTurtle } from "./opening.js";
import { round, spelled } from "./scale.js";
import { THEMES } from "./themes.js";
import { Turtles } from "./turtles.js";

const AXES = ["#f0454b", "#3fc45c", "#3d84ff"];
const LAMP = [-0.28, 0.34, 0.9]; // direction of the light, seen from the camera
const tone = (color) => new Color(color).toArray();
const PAINTS = {
  x: tone(AXES[0]), y: tone(AXES[1]), z: tone(AXES[2]), hub: tone("#e9edf3"), shaft: tone("#cfbf57"), head: tone("#ff3d94"),
};
const OVER_ALL = 100; // render order, beyond that of turtles
const FEW = 60; // frames that are drawn in full even without a graphics card
const MOST_FINE = 400; // frames that are drawn in full with a graphics card
const FONT = "600 12px system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif";
const LINE = 22; // height in pixels of a name with its halo
const ROOMY = 0.84; // share of the picture for the frames' origins; names and axes need the rest
const SMALLEST = 0.56; // metres from the middle to the sides
const CORNER = { width: 124, height: 108 }; // pixels of the scale and the axes in the corner
const ARRANGED_EVERY = 5; // pictures between two placements of names, if there are many names
const GREY = new Color(0.7, 0.7, 0.7).convertSRGBToLinear().r; // colour of stale frames

/** Whether there is no graphics card; then every pixel and vertex is costly. */
function drawsInSoftware() {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return false;
  const known = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(known ? known.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

/**
 * The pen of a flat canvas.
 * @param {HTMLCanvasElement} canvas
 */
function flat(canvas) {
  return /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
}

export class Stage {
  /**
   * @param {HTMLCanvasElement} floor canvas that stores the grid
   * @param {HTMLCanvasElement} under
   * @param {HTMLCanvasElement} main
   * @param {HTMLCanvasElement} over
   */
  constructor(floor, under, main, over) {
    this.floor = floor;
    this.under = under;
    this.over = over;
    this.main = main;
    this.plain = drawsInSoftware();
    this.renderer = new WebGLRenderer({ canvas: main, antialias: !this.plain, alpha: true });
    this.renderer.setClearAlpha(0);
    this.scene = new Scene();
    this.crowd = new Crowd();
    this.scene.add(this.crowd.mesh);
    this.ground = new Ground(this.scene);
    this.turtles = new Turtles(this.scene);

    const orbit = new PerspectiveCamera(50, 1, 0.01, 1e5);
    orbit.up.set(0, 0, 1);
    orbit.position.set(-6, -6, 5);
    this.cameras = { orbit, top: flatCamera("top"), side: flatCamera("side"), front: flatCamera("front") };
    this.controls = {};
    for (const [name, camera] of Object.entries(this.cameras)) {
      const controls = new OrbitControls(camera, over);
      controls.enableDamping = false;
      controls.zoomToCursor = true;
      controls.enabled = false;
      controls.addEventListener("change", () => this.changed());
      controls.addEventListener("start", () => {
        this.taken = true;
        this.flying = null;
      });
      if (name in FLAT) panOnly(controls);
      this.controls[name] = controls;
    }
    this.width = this.height = 0; // of the window, CSS pixels
    this.ratio = 1; // canvas pixels per CSS pixel
    this.scale = 1; // share of the pixels that the 3-D picture uses, see pace.js
    /** View of the grid in the last picture, and in the stored picture of the grid. */
    this.looked = { from: new Matrix4(), through: new Matrix4(), key: "", aside: false };
    this.extent = 5; // extent of the frames around the origin, metres
    /** Pixels that panels cover, at each side. */
    this.inset = { left: 0, right: 0, top: 0, bottom: 0 };
    /** @type {number[][]} */
    this.covered = []; // by panels: left, top, width, height
    /** @type {Map<string, number>} */
    this.stood = new Map(); // positions of names in the previous picture
    this.gone = ARRANGED_EVERY; // pictures since names were placed
    this.theme = THEMES.dark;
    this.point = new Vector3();
    /** @type {number[][]} */
    this.reserved = []; // areas without names
    this.signs = new Map(); // names as they were painted
    this.changed = () => {}; // the camera has moved
    this.taken = false; // whether the user, not the page, moves the camera
    /** @type {{ from: any, to: any, lasting: number, began: number } | null} */
    this.flying = null;
    this.view = "top";
    this.setView("top");
  }

  get camera() {
    return this.cameras[this.view];
  }

  setView(view) {
    this.view = view;
    this.flying = null;
    for (const [name, controls] of Object.entries(this.controls)) controls.enabled = name === view;
    this.changed();
  }

  setTheme(name) {
    this.theme = THEMES[name];
    this.signs.clear();
    this.changed();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.over;
    const ratio = this.plain ? 1 : Math.min(2, devicePixelRatio || 1);
    const scaled = ratio * this.scale;
    if (this.renderer.getPixelRatio() !== scaled) this.renderer.setPixelRatio(scaled);
    if (this.width === width && this.height === height && this.ratio === ratio) return;
    Object.assign(this, { width, height, ratio });
    this.looked.key = "";
    this.renderer.setSize(width, height, false);
    for (const canvas of [this.floor, this.under, this.over]) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const across = (width / height) * 5;
    for (const name of Object.keys(FLAT)) {
      const camera = this.cameras[name];
      Object.assign(camera, { left: -across, right: across, top: 5, bottom: -5 });
      camera.updateProjectionMatrix();
    }
    const { orbit } = this.cameras;
    orbit.aspect = width / height;
    orbit.updateProjectionMatrix();
  }

  /** Look at a box; `inset` keeps the panels' pixels free: {left, right, top, bottom}. */
  fit(box, inset) {
    if (!this.width) return;
    const low = new Vector3(...box.low);
    const high = new Vector3(...box.high);
    const middle = low.clone().add(high).multiplyScalar(0.5);
    const size = high.clone().sub(low);
    const free = {
      x: Math.max(80, this.width - inset.left - inset.right),
      y: Math.max(80, this.height - inset.top - inset.bottom),
    };
    const { orbit } = this.cameras;
    for (const name of Object.keys(FLAT)) {
      fitFlat(name, this.cameras[name], this.controls[name], { middle, size }, free, inset, this.height);
    }

    const half = Math.tan((orbit.fov * Math.PI) / 360);
    const away = new Vector3(-0.62, -0.62, 0.55).normalize();
    const right = new Vector3(0, 0, 1).cross(away).normalize();
    const upward = away.clone().cross(right);
    const slope = (pixels) => (ROOMY * half * pixels) / this.height;
    const ways = { right: right.toArray(), upward: upward.toArray(), away: away.toArray() };
    const least = (SMALLEST * this.height) / (half * Math.min(free.x, free.y));
    const distance = Math.max(least, distanceFor(box, ways, { x: slope(free.x), y: slope(free.y) }));
    // The middle of the picture is not the middle of the area free of panels.
    const metres = (2 * distance * half) / this.height;
    middle.addScaledVector(right, ((inset.right - inset.left) / 2) * metres);
    middle.addScaledVector(upward, ((inset.top - inset.bottom) / 2) * metres);
    this.controls.orbit.target.copy(middle);
    orbit.position.copy(middle).addScaledVector(away, distance);
    this.controls.orbit.update();
    this.changed();
  }

  /**
   * Move the camera to a place, in the middle of the area free of panels.
   * @param {number[]} place
   * @param {number} scale of the markers, which must be visible
   * @param {number} lasting milliseconds; 0 for at once
   * @param {{ left: number, right: number, top: number, bottom: number }} inset
   */
  fly(place, scale, lasting, inset) {
    const { camera } = this;
    const controls = this.controls[this.view];
    this.taken = true;
    const from = { position: camera.position.clone(), target: controls.target.clone(), zoom: camera.zoom };
    const to = { position: camera.position.clone(), target: new Vector3(...place), zoom: camera.zoom };
    const near = 4 * scale; // metres from side to side, at most
    let perPixel;
    if (this.view !== "orbit") {
      to.zoom = Math.max(camera.zoom, 10 / near);
      perPixel = 10 / this.height / to.zoom;
    } else {
      const half = Math.tan((camera.fov * Math.PI) / 360);
      const distance = Math.min(from.position.distanceTo(from.target), near / half);
      perPixel = (2 * distance * half) / this.height;
      to.position.sub(from.target).setLength(distance);
    }
    // The middle of the free area, not of the window.
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    const upward = new Vector3().setFromMatrixColumn(camera.matrixWorld, 1);
    to.target.addScaledVector(right, ((inset.right - inset.left) / 2) * perPixel);
    to.target.addScaledVector(upward, ((inset.top - inset.bottom) / 2) * perPixel);
    if (this.view !== "orbit") to.position.add(to.target).sub(from.target);
    else to.position.add(to.target);
    this.flying = { from, to, lasting, began: performance.now() };
    this.advance(this.flying.began);
  }

  /** Continue a camera flight; `now` in milliseconds. */
  advance(now) {
    if (!this.flying) return;
    const { from, to, lasting, began } = this.flying;
    const share = lasting > 0 ? Math.min(1, Math.max(0, (now - began) / lasting)) : 1;
    const eased = share * share * (3 - 2 * share);
    const { camera } = this;
    const controls = this.controls[this.view];
    camera.position.lerpVectors(from.position, to.position, eased);
    controls.target.lerpVectors(from.target, to.target, eased);
    camera.zoom = from.zoom * (to.zoom / from.zoom) ** eased;
    camera.updateProjectionMatrix();
    controls.update();
    if (share >= 1) this.flying = null;
    this.changed();
  }

  /** Move the camera by a vector, metres. */
  carry(x, y, z) {
    if (!x && !y && !z) return;
    const { camera } = this;
    const ends = this.flying ? [this.flying.from, this.flying.to] : [];
    for (const end of [{ position: camera.position, target: this.controls[this.view].target }, ...ends]) {
      end.position.add(this.point.set(x, y, z));
      end.target.add(this.point);
    }
    camera.updateMatrixWorld();
  }

  cameraState() {
    const { camera } = this;
    const target = this.controls[this.view].target;
    return [...camera.position.toArray(), ...target.toArray(), camera.zoom].map((value) => +value.toPrecision(6));
  }

  setCameraState(state) {
    const { camera } = this;
    camera.position.fromArray(state, 0);
    this.controls[this.view].target.fromArray(state, 3);
    camera.zoom = state[6];
    camera.updateProjectionMatrix();
    this.controls[this.view].update();
  }

  /** Draw. `frames`: [{pose, parent pose or null, grey, alpha}, …]; `look`: the switches. */
  draw(frames, look) {
    this.resize();
    if (frames.length) {
      this.extent = Math.max(1, ...frames.map(({ pose }) => Math.max(Math.abs(pose[0]), Math.abs(pose[1]))));
    }
    this.ground.draw(look.grid, look.level, this.seen(), this.theme.grid);
    this.drawTurtles(frames);
    const things = frames.length > (this.plain ? FEW : MOST_FINE) ? COARSE : FINE;
    const length = 0.2 * look.scale;
    const radius = 0.02 * look.scale * 0.75;
    const [matrix, where, size, way, light] = [new Matrix4(), new Vector3(), new Vector3(), new Vector3(), new Vector3()];
    const [turn, back] = [new Quaternion(), new Quaternion()];
    const up = new Vector3(0, 1, 0);
    const lamp = new Vector3(...LAMP).applyQuaternion(this.camera.quaternion);
    this.crowd.begin();
    for (const { pose, parent, grey, alpha, dim } of frames) {
      if (alpha <= 0) continue;
      const put = (thing, color, across, along, deep) => {
        const [red, green, blue] = color.map((own) => own + (GREY - own) * grey);
        this.crowd.add(thing, matrix.compose(where, turn, size.set(across, along, deep)), light, [red, green, blue, alpha * dim]);
      };
      if (look.axes) {
        where.fromArray(pose, 0);
        turn.fromArray(pose, 3);
        light.copy(lamp).applyQuaternion(back.copy(turn).invert());
        put(things.x, PAINTS.x, length, radius, radius);
        put(things.y, PAINTS.y, radius, length, radius);
        put(things.z, PAINTS.z, radius, radius, length);
        put(things.hub, PAINTS.hub, radius * 1.35, radius * 1.35, radius * 1.35);
      }
      if (!look.arrows || !parent) continue;
      where.fromArray(pose, 0);
      way.set(parent[0] - pose[0], parent[1] - pose[1], parent[2] - pose[2]);
      const distance = way.length();
      if (distance <= 0.001) continue;
      const tip = 0.1 * look.scale * (distance < 0.1 * look.scale ? distance : 1);
      const rod = Math.max(0, distance - tip);
      turn.setFromUnitVectors(up, way.normalize());
      light.copy(lamp).applyQuaternion(back.copy(turn).invert());
      put(things.shaft, PAINTS.shaft, 0.009 * look.scale, rod, 0.009 * look.scale);
      where.addScaledVector(way, rod);
      put(things.head, PAINTS.head, 0.034 * look.scale, tip, 0.034 * look.scale);
    }
    this.crowd.end();
    // Parts visible through solids are drawn last, with the depth buffer cleared.
    this.crowd.mesh.renderOrder = look.through ? OVER_ALL : 0;
    this.crowd.mesh.onBeforeRender = look.through ? () => this.renderer.clearDepth() : () => {};
    this.camera.updateMatrixWorld();
    if (this.plain) this.putAside(look.grid);
    this.renderer.render(this.scene, this.camera);
  }

  /** Draw the grid once for each view, on a canvas of its own. */
  putAside(shown) {
    const { looked, camera, ground, floor, renderer } = this;
    const key = shown ? `${this.view} ${ground.key}` : "";
    const rests = key === looked.key && camera.matrixWorld.equals(looked.from) && camera.projectionMatrix.equals(looked.through);
    if (!rests) {
      Object.assign(looked, { key, aside: false });
      looked.from.copy(camera.matrixWorld);
      looked.through.copy(camera.projectionMatrix);
    } else if (key && !looked.aside) {
      looked.aside = true;
      renderer.setPixelRatio(this.ratio);
      camera.layers.set(GROUND);
      renderer.render(this.scene, camera);
      camera.layers.set(0);
      const pen = flat(floor);
      pen.clearRect(0, 0, floor.width, floor.height);
      pen.drawImage(this.main, 0, 0);
      renderer.setPixelRatio(this.ratio * this.scale);
    }
    floor.hidden = !looked.aside;
    if (looked.aside) ground.lines.visible = false;
  }

  /** Metres per pixel at the point that the camera looks at, this point, and the extent of the view or the frames. */
  seen() {
    const { x, y } = this.controls[this.view].target;
    const corner = Math.hypot(this.width, this.height) / 2;
    const pixel = this.pixel();
    if (this.view === "top") return { pixel, middle: [x, y], reach: corner * pixel, flat: true };
    const world = this.extent + Math.max(Math.abs(x), Math.abs(y));
    return { pixel, middle: [x, y], reach: Math.max(1.3 * world, corner * pixel), flat: false };
  }

  /** Metres per pixel at the point looked at. */
  pixel() {
    const { orbit } = this.cameras;
    if (this.view !== "orbit") return 10 / (this.height || 1) / this.camera.zoom;
    const distance = orbit.position.distanceTo(this.controls.orbit.target) || 1;
    return (2 * distance * Math.tan((orbit.fov * Math.PI) / 360)) / (this.height || 1);
  }

  drawTurtles(frames) {
    const where = new Vector3();
    const turn = new Quaternion();
    const size = new Vector3(1, 1, 1);
    this.turtles.draw(
      frames.filter(({ name, alpha }) => alpha > 0 && isTurtle(name)),
      (group, pose) => {
        group.matrix.compose(where.fromArray(pose, 0), turn.fromArray(pose, 3), size);
        group.matrixWorldNeedsUpdate = true;
      },
    );
  }

  /** Pixels from the top left corner, or null for a place behind the camera. */
  project(x, y, z) {
    const { point } = this;
    point.set(x, y, z).applyMatrix4(this.camera.matrixWorldInverse);
    if (this.view === "orbit" && point.z > -0.01) return null;
    point.applyMatrix4(this.camera.projectionMatrix);
    return [((point.x + 1) / 2) * this.width, ((1 - point.y) / 2) * this.height];
  }

  /**
   * Draw trails, and the pair's chain, which must not hide the axes.
   * @param {any[]} trails {points, ahead, color, whole}; whole: whether to include the path ahead
   * @param {number[][]} chain
   */
  drawUnder(trails, chain) {
    // An empty layer is hidden, which saves compositing it.
    this.under.hidden = !trails.length && chain.length < 2;
    if (this.under.hidden) return;
    const pen = flat(this.under);
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.clearRect(0, 0, this.width, this.height);
    pen.lineCap = pen.lineJoin = "round";
    pen.lineWidth = 2.2;
    for (const { points, ahead, color, whole } of trails) {
      pen.strokeStyle = color;
      pen.globalAlpha = 0.35;
      this.drawPath(pen, ahead, 0, ahead.length - 1);
      const stages = whole ? 1 : 12;
      for (let stage = 0; stage < stages; stage++) {
        const from = Math.floor((stage * (points.length - 1)) / stages);
        const to = Math.floor(((stage + 1) * (points.length - 1)) / stages);
        if (to <= from) continue;
        pen.globalAlpha = 0.08 + (0.85 * (stage + 1)) / stages;
        this.drawPath(pen, points, from, to);
      }
    }
    pen.globalAlpha = 1;
    this.drawChain(pen, this.spots(chain));
  }

  drawPath(pen, points, from, to) {
    pen.beginPath();
    let down = false;
    for (let at = from; at <= to; at++) {
      const spot = this.project(points[at][0], points[at][1], points[at][2]);
      if (spot) pen[down ? "lineTo" : "moveTo"](spot[0], spot[1]);
      down = spot !== null;
    }
    pen.stroke();
  }

  /**
   * Draw names, rings, the pair's distance, scale and axes. Names are only painted as text.
   * @param {any[]} labels
   * @param {{ chain: number[][], distance: string }} pair
   * @param {{ pose: number[] | null | undefined, strong: boolean }[]} rings
   */
  drawOver(labels, pair, rings) {
    const pen = flat(this.over);
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.clearRect(0, 0, this.width, this.height);
    const corner = [10, this.height - this.inset.bottom - CORNER.height, CORNER.width, CORNER.height];
    // Beside the list of frames, or below a short one.
    if (this.covered.some((panel) => overlap(panel, corner))) corner[0] += this.inset.left;
    this.reserved = [...this.covered, corner];
    this.drawLength(pen, pair);
    for (const { pose, strong } of rings) {
      const spot = pose ? this.project(pose[0], pose[1], pose[2]) : null;
      if (!spot) continue;
      pen.strokeStyle = strong ? this.theme.accent : this.theme.text;
      pen.lineWidth = 2;
      pen.beginPath();
      pen.arc(spot[0], spot[1], strong ? 13 : 16, 0, 7);
      pen.stroke();
    }
    this.drawNames(pen, labels);
    this.drawCorner(pen, corner[0] + 8);
  }

  /** Pixels of a chain of frames; empty if one of the frames is behind the camera. @param {number[][]} chain */
  spots(chain) {
    const spots = chain.map((pose) => this.project(pose[0], pose[1], pose[2]));
    return spots.length < 2 || spots.includes(null) ? [] : /** @type {number[][]} */ (spots);
  }

  /** Draw a line from pixel to pixel. */
  drawLine(pen, spots, color, width) {
    pen.strokeStyle = color;
    pen.lineWidth = width;
    pen.lineCap = pen.lineJoin = "round";
    pen.beginPath();
    spots.forEach(([x, y], at) => pen[at ? "lineTo" : "moveTo"](x, y));
    pen.stroke();
  }

  /** Draw the chain of frames: a thick line with dots. */
  drawChain(pen, spots) {
    if (!spots.length) return;
    this.drawLine(pen, spots, this.theme.halo, 7);
    this.drawLine(pen, spots, this.theme.accent, 4);
    pen.fillStyle = this.theme.accent;
    spots.forEach(([x, y], at) => {
      pen.beginPath();
      pen.arc(x, y, at === 0 || at === spots.length - 1 ? 6 : 4, 0, 7);
      pen.fill();
    });
  }

  /** Draw the straight line between the ends of the chain with its length, and the chain through solids. */
  drawLength(pen, { chain, distance }) {
    const spots = this.spots(chain);
    if (!spots.length) return;
    const [first, last] = [spots[0], spots[spots.length - 1]];
    pen.globalAlpha = 0.5;
    this.drawLine(pen, spots, this.theme.accent, 1.5);
    pen.globalAlpha = 1;
    if (spots.length > 2) {
      pen.setLineDash([2, 7]);
      this.drawLine(pen, [first, last], this.theme.accent, 2);
      pen.setLineDash([]);
    }
    if (!distance) return;
    // The text changes often, so that a cached picture of the text would not be reused.
    pen.font = FONT;
    const [width, height] = [pen.measureText(distance).width + 8, LINE];
    const [x, y] = [(first[0] + last[0]) / 2 - width / 2, (first[1] + last[1]) / 2 - height / 2];
    this.reserved.push([x, y, width, height]);
    pen.fillStyle = this.theme.halo;
    pen.fillRect(x, y + 2, width, height - 6);
    this.write(pen, distance, this.theme.accent, Math.round(x), Math.round(y));
  }

  /** Draw names beside their frames; a name that is moved aside gets a line to its frame. */
  drawNames(pen, labels) {
    const seen = [];
    for (const label of labels) {
      const spot = this.project(label.pose[0], label.pose[1], label.pose[2]);
      if (!spot || spot[0] < -60 || spot[0] > this.width + 60 || spot[1] < -40 || spot[1] > this.height + 40) continue;
      const sign = this.sign(label.name, label.first ? this.theme.accent : this.theme.text);
      const [width, height] = [sign.width / this.ratio, sign.height / this.ratio];
      seen.push({ label, sign, x: spot[0], y: spot[1], width, height, first: label.first, was: this.stood.get(label.name) });
    }
    // If there are many names, they move with their frames, and are placed again every few pictures.
    const anew = seen.length <= MANY || ++this.gone >= ARRANGED_EVERY;
    if (anew) this.gone = 0;
    const stands = anew
      ? arrange(seen, this, this.reserved)
      : seen.map((one) => (one.was === undefined && !one.first ? null : standAt(one, one.was ?? 0)));
    this.stood.clear();
    pen.strokeStyle = this.theme.text;
    pen.lineWidth = 1;
    stands.forEach((stand, at) => {
      if (!stand) return;
      const { label, sign, x, y, width, height } = seen[at];
      this.stood.set(label.name, stand.place);
      pen.globalAlpha = label.alpha * (1 - 0.4 * label.grey) * (0.4 + 0.6 * label.dim);
      if (stand.moved) {
        // The line ends at the nearest edge of the name.
        const toX = Math.max(stand.left + 4, Math.min(x, stand.left + width - 4));
        const toY = Math.max(stand.top + 4, Math.min(y, stand.top + height - 4));
        pen.beginPath();
        pen.moveTo(x, y);
        pen.lineTo(toX, toY);
        pen.stroke();
      }
      pen.drawImage(sign, stand.left, stand.top, width, height);
    });
    pen.globalAlpha = 1;
  }

  /** Draw the scale bar and the directions of x, y and z in a free corner. */
  drawCorner(pen, left) {
    const bottom = this.height - this.inset.bottom - 16;
    const pixel = this.pixel();
    const long = round(64 * pixel);
    const wide = long / pixel;
    pen.lineCap = "butt";
    for (const [color, width] of [[this.theme.halo, 5], [this.theme.text, 1.5]]) {
      pen.strokeStyle = color;
      pen.lineWidth = width;
      pen.beginPath();
      pen.moveTo(left, bottom - 5);
      pen.lineTo(left, bottom);
      pen.lineTo(left + wide, bottom);
      pen.lineTo(left + wide, bottom - 5);
      pen.stroke();
    }
    const sign = this.sign(spelled(long), this.theme.text);
    pen.drawImage(sign, Math.round(left + wide + 4), Math.round(bottom - 14), sign.width / this.ratio, sign.height / this.ratio);
    const middle = [left + 34, bottom - 58];
    const turn = new Matrix4().extractRotation(this.camera.matrixWorldInverse);
    const tips = AXES.map((color, side) => ({
      color,
      name: "xyz"[side],
      tip: new Vector3(...[0, 1, 2].map((at) => Number(at === side))).applyMatrix4(turn),
    }));
    // Axes that point away are drawn first.
    for (const { color, name, tip } of tips.sort((one, other) => one.tip.z - other.tip.z)) {
      const [x, y] = [middle[0] + 28 * tip.x, middle[1] - 28 * tip.y];
      pen.strokeStyle = color;
      pen.lineWidth = 3;
      pen.lineCap = "round";
      pen.beginPath();
      pen.moveTo(middle[0], middle[1]);
      pen.lineTo(x, y);
      pen.stroke();
      if (Math.hypot(tip.x, tip.y) < 0.2) continue;
      const letter = this.sign(name, this.theme.text);
      const [width, height] = [letter.width / this.ratio, letter.height / this.ratio];
      pen.drawImage(letter, middle[0] + 38 * tip.x - width / 2, middle[1] - 38 * tip.y - height / 2, width, height);
    }
  }

  /**
   * Draw a measurement: up to two pixels, the line between, and its length.
   * @param {number[][]} spots
   * @param {string} length
   */
  drawMeasure(spots, length) {
    const pen = flat(this.over);
    pen.strokeStyle = pen.fillStyle = this.theme.accent;
    pen.lineWidth = 2.5;
    pen.beginPath();
    spots.forEach(([x, y], at) => pen[at ? "lineTo" : "moveTo"](x, y));
    pen.stroke();
    for (const [x, y] of spots) {
      pen.beginPath();
      pen.arc(x, y, 5, 0, 7);
      pen.fill();
    }
    if (spots.length < 2 || !length) return;
    pen.font = FONT;
    const [x, y] = [(spots[0][0] + spots[1][0]) / 2, (spots[0][1] + spots[1][1]) / 2];
    this.write(pen, length, this.theme.accent, Math.round(x - pen.measureText(length).width / 2), Math.round(y - LINE));
  }

  /** Paint a name once for all pictures, because outlines of letters are costly. */
  sign(name, color) {
    const key = `${this.ratio} ${color} ${name}`;
    const known = this.signs.get(key);
    if (known) return known;
    const text = name.length > 48 ? `${name.slice(0, 30)}…${name.slice(-16)}` : name;
    const sheet = document.createElement("canvas");
    const pen = flat(sheet);
    pen.font = FONT;
    sheet.width = Math.ceil((pen.measureText(text).width + 8) * this.ratio);
    sheet.height = Math.ceil(LINE * this.ratio);
    pen.scale(this.ratio, this.ratio);
    this.write(pen, text, color, 0, 0);
    if (this.signs.size > 5000) this.signs.clear();
    this.signs.set(key, sheet);
    return sheet;
  }

  /** Paint a text with a halo below and to the right of a place. */
  write(pen, text, color, x, y) {
    pen.font = FONT;
    pen.textBaseline = "top";
    pen.lineJoin = "round";
    pen.lineWidth = 4;
    pen.strokeStyle = this.theme.halo;
    pen.strokeText(text, x + 4, y + 3);
    pen.fillStyle = color;
    pen.fillText(text, x + 4, y + 3);
  }

  /** Combine all layers into one canvas. Call in the same task as `draw`. */
  picture() {
    const sheet = document.createElement("canvas");
    sheet.width = this.under.width;
    sheet.height = this.under.height;
    const pen = flat(sheet);
    pen.fillStyle = this.theme.background;
    pen.fillRect(0, 0, sheet.width, sheet.height);
    for (const layer of [this.floor, this.under, this.main, this.over]) {
      if (!layer.hidden) pen.drawImage(layer, 0, 0, sheet.width, sheet.height);
    }
    return sheet;
  }
}
