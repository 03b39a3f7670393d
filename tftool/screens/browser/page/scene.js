// @ts-check
// The picture: three.js for what has depth, two flat canvases for trails, names and the chain.
import {
  Color,
  ConeGeometry,
  CylinderGeometry,
  DynamicDrawUsage,
  GridHelper,
  InstancedBufferAttribute,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  MOUSE,
  OctahedronGeometry,
  OrthographicCamera,
  PerspectiveCamera,
  Quaternion,
  Scene,
  TetrahedronGeometry,
  TOUCH,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Crowd } from "./crowd.js";
import { THEMES } from "./themes.js";

const AXES = ["#f0454b", "#3fc45c", "#3d84ff"];
const SHAFT = "#cfbf57";
const HEAD = "#ff3d94";
const FEW = 60; // frames that are drawn in full even without a graphics card
const GREY = new Color(0.7, 0.7, 0.7).convertSRGBToLinear().r; // what stale frames turn into

/** Whether pictures are made by the processor, where every pixel and corner is dear. */
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

function fading(mesh) {
  // three has no opacity per instance; one number more per instance gives it. Light comes from
  // where one looks from and is worked out per corner: lamps, per pixel, cost several times that.
  mesh.material.onBeforeCompile = (shader) => {
    shader.vertexShader = `attribute float fade;\nvarying float vFade;\nvarying float vShade;\n${shader.vertexShader.replace(
      "#include <begin_vertex>",
      `#include <begin_vertex>
      vFade = fade;
      vec3 outward = mat3(viewMatrix) * normalize(mat3(instanceMatrix) * normal);
      vShade = 0.62 + 0.38 * max(0.0, dot(outward, vec3(-0.28, 0.34, 0.9)));`,
    )}`;
    shader.fragmentShader = `varying float vFade;\nvarying float vShade;\n${shader.fragmentShader.replace(
      "#include <opaque_fragment>",
      "diffuseColor.a *= vFade;\nif (diffuseColor.a < 0.01) discard;\noutgoingLight *= vShade;\n#include <opaque_fragment>",
    )}`;
  };
  return mesh;
}

export class Stage {
  constructor(under, main, over) {
    this.under = under;
    this.over = over;
    this.main = main;
    this.plain = drawsInSoftware();
    this.renderer = new WebGLRenderer({ canvas: main, antialias: !this.plain, alpha: true });
    this.renderer.setClearAlpha(0);
    this.scene = new Scene();
    this.crowd = new Crowd();
    this.scene.add(this.crowd.mesh);

    const top = new OrthographicCamera(-1, 1, 1, -1, -1e5, 1e5);
    top.up.set(0, 1, 0);
    top.position.set(0, 0, 50);
    const orbit = new PerspectiveCamera(50, 1, 0.01, 1e5);
    orbit.up.set(0, 0, 1);
    orbit.position.set(-6, -6, 5);
    this.cameras = { top, orbit };
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
      this.controls[name] = controls;
    }
    this.controls.top.enableRotate = false;
    this.controls.top.screenSpacePanning = true;
    this.controls.top.mouseButtons = { LEFT: MOUSE.PAN, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
    this.controls.top.touches = { ONE: TOUCH.PAN, TWO: TOUCH.DOLLY_PAN };
    this.width = this.height = 0; // of the window, CSS pixels
    this.ratio = 1; // canvas pixels per CSS pixel
    this.extent = 5; // how far the frames reach from the origin, metres
    this.gridSize = 0;
    /** @type {GridHelper | null} */
    this.grid = null;
    this.theme = THEMES.dark;
    this.capacity = 0;
    /** @type {any[]} */
    this.meshes = [];
    this.point = new Vector3();
    this.signs = new Map(); // names as they were painted
    this.changed = () => {}; // the camera has moved
    this.taken = false; // whether a person moves the camera, and not the page
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
    this.gridSize = 0;
    this.changed();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.over;
    const ratio = this.plain ? 1 : Math.min(2, devicePixelRatio || 1);
    if (this.width === width && this.height === height && this.ratio === ratio) return;
    Object.assign(this, { width, height, ratio });
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    for (const canvas of [this.under, this.over]) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const { top, orbit } = this.cameras;
    top.left = (-width / height) * 5;
    top.right = (width / height) * 5;
    top.top = 5;
    top.bottom = -5;
    orbit.aspect = width / height;
    top.updateProjectionMatrix();
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
    const { top, orbit } = this.cameras;
    const perPixel = Math.max((Math.max(size.x, 1) * 1.2) / free.x, (Math.max(size.y, 1) * 1.2) / free.y);
    top.zoom = 10 / this.height / perPixel;
    const shift = { x: ((inset.right - inset.left) / 2) * perPixel, y: ((inset.top - inset.bottom) / 2) * perPixel };
    top.position.set(middle.x + shift.x, middle.y + shift.y, 50);
    this.controls.top.target.set(middle.x + shift.x, middle.y + shift.y, 0);
    top.updateProjectionMatrix();
    this.controls.top.update();

    const radius = Math.max(size.length() / 2, 0.7);
    const half = Math.tan((orbit.fov * Math.PI) / 360);
    const distance = (radius * 0.8 * this.height) / (half * Math.min(free.x, free.y));
    const away = new Vector3(-0.62, -0.62, 0.55).normalize();
    // The middle of the picture is not the middle of what the panels leave free.
    const metres = (2 * distance * half) / this.height;
    const right = new Vector3(0, 0, 1).cross(away).normalize();
    const upward = away.clone().cross(right);
    middle.addScaledVector(right, ((inset.right - inset.left) / 2) * metres);
    middle.addScaledVector(upward, ((inset.top - inset.bottom) / 2) * metres);
    this.controls.orbit.target.copy(middle);
    orbit.position.copy(middle).addScaledVector(away, distance);
    this.controls.orbit.update();
    this.changed();
  }

  /**
   * Move the camera so that a place comes into the middle of what the panels leave free, and near.
   * @param {number[]} place
   * @param {number} scale of the markers, which are to be seen well
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
    if (this.view === "top") {
      to.zoom = Math.max(camera.zoom, 10 / near);
      perPixel = 10 / this.height / to.zoom;
      to.target.z = controls.target.z;
    } else {
      const half = Math.tan((camera.fov * Math.PI) / 360);
      const distance = Math.min(from.position.distanceTo(from.target), near / half);
      perPixel = (2 * distance * half) / this.height;
      to.position.sub(from.target).setLength(distance);
    }
    // The middle of what is free, and not of the window.
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    const upward = new Vector3().setFromMatrixColumn(camera.matrixWorld, 1);
    to.target.addScaledVector(right, ((inset.right - inset.left) / 2) * perPixel);
    to.target.addScaledVector(upward, ((inset.top - inset.bottom) / 2) * perPixel);
    if (this.view === "top") to.position.set(to.target.x, to.target.y, from.position.z);
    else to.position.add(to.target);
    this.flying = { from, to, lasting, began: performance.now() };
    this.advance(this.flying.began);
  }

  /** Go on flying; `now` in milliseconds. */
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

  grow(count) {
    if (this.meshes.length && count <= this.capacity) return;
    this.capacity = Math.max(64, 2 ** Math.ceil(Math.log2(count)));
    for (const mesh of this.meshes) {
      this.scene.remove(mesh);
      mesh.geometry.dispose();
      mesh.material.dispose();
      mesh.dispose();
    }
    const rod = () => new CylinderGeometry(1, 1, 1, 8).translate(0, 0.5, 0);
    const make = (geometry, color) => {
      const material = new MeshBasicMaterial({ transparent: true });
      const mesh = fading(new InstancedMesh(geometry, material, this.capacity));
      geometry.setAttribute("fade", new InstancedBufferAttribute(new Float32Array(this.capacity), 1).setUsage(DynamicDrawUsage));
      mesh.instanceColor = new InstancedBufferAttribute(new Float32Array(3 * this.capacity), 3).setUsage(DynamicDrawUsage);
      mesh.instanceMatrix.setUsage(DynamicDrawUsage);
      mesh.frustumCulled = false;
      mesh.userData.color = new Color(color);
      this.scene.add(mesh);
      return mesh;
    };
    this.meshes = [
      make(rod().rotateZ(-Math.PI / 2), AXES[0]),
      make(rod(), AXES[1]),
      make(rod().rotateX(Math.PI / 2), AXES[2]),
      make(new OctahedronGeometry(1, 1), "#e9edf3"),
      make(new CylinderGeometry(1, 1, 1, 6, 1, true).translate(0, 0.5, 0), SHAFT),
      make(new ConeGeometry(1, 1, 10).translate(0, 0.5, 0), HEAD),
    ];
    const spike = () => new ConeGeometry(1.4, 1, 3, 1, true).translate(0, 0.5, 0);
    const simple = [
      spike().rotateZ(-Math.PI / 2),
      spike(),
      spike().rotateX(Math.PI / 2),
      new TetrahedronGeometry(1),
      new CylinderGeometry(1, 1, 1, 3, 1, true).translate(0, 0.5, 0),
      new ConeGeometry(1, 1, 4, 1, true).translate(0, 0.5, 0),
    ];
    this.meshes.forEach((mesh, at) => {
      const flat = simple[at].index ? simple[at].toNonIndexed() : simple[at];
      mesh.userData.corners = flat.attributes.position.array;
    });
  }

  /** Draw. `frames`: [{pose, parent pose or null, grey, alpha}, …]; `look`: what is switched on. */
  draw(frames, look) {
    this.resize();
    this.grow(frames.length);
    if (frames.length) {
      this.extent = Math.max(1, ...frames.map(({ pose }) => Math.max(Math.abs(pose[0]), Math.abs(pose[1]))));
    }
    this.drawGrid(look);
    const [xs, ys, zs, hubs, shafts, heads] = this.meshes;
    const length = 0.2 * look.scale;
    const radius = 0.02 * look.scale * 0.75;
    let axes = 0;
    let arrows = 0;
    const matrix = new Matrix4();
    const where = new Vector3();
    const turn = new Quaternion();
    const size = new Vector3();
    const up = new Vector3(0, 1, 0);
    const way = new Vector3();
    const together = this.plain && frames.length > FEW;
    this.crowd.begin();
    const put = (mesh, index, frame) => {
      const { color, corners } = mesh.userData;
      const blend = (own) => own + (GREY - own) * frame.grey;
      if (together) {
        this.crowd.add(corners, matrix, [blend(color.r), blend(color.g), blend(color.b)], frame.alpha);
        return;
      }
      mesh.setMatrixAt(index, matrix);
      mesh.instanceColor.setXYZ(index, blend(color.r), blend(color.g), blend(color.b));
      mesh.geometry.attributes.fade.setX(index, frame.alpha);
    };
    for (const frame of frames) {
      if (frame.alpha <= 0) continue;
      const { pose, parent } = frame;
      if (look.axes) {
        where.fromArray(pose, 0);
        turn.fromArray(pose, 3);
        put(xs, axes, (matrix.compose(where, turn, size.set(length, radius, radius)), frame));
        put(ys, axes, (matrix.compose(where, turn, size.set(radius, length, radius)), frame));
        put(zs, axes, (matrix.compose(where, turn, size.set(radius, radius, length)), frame));
        put(hubs, axes, (matrix.compose(where, turn, size.set(radius * 1.35, radius * 1.35, radius * 1.35)), frame));
        axes++;
      }
      if (look.arrows && parent) {
        way.set(parent[0] - pose[0], parent[1] - pose[1], parent[2] - pose[2]);
        const distance = way.length();
        if (distance > 0.001) {
          const tip = distance < 0.1 * look.scale ? 0.1 * look.scale * distance : 0.1 * look.scale;
          const rod = Math.max(0, distance - tip);
          turn.setFromUnitVectors(up, way.normalize());
          where.fromArray(pose, 0);
          put(shafts, arrows, (matrix.compose(where, turn, size.set(0.009 * look.scale, rod, 0.009 * look.scale)), frame));
          where.addScaledVector(way, rod);
          put(heads, arrows, (matrix.compose(where, turn, size.set(0.034 * look.scale, tip, 0.034 * look.scale)), frame));
          arrows++;
        }
      }
    }
    this.crowd.end();
    for (const mesh of this.meshes) {
      mesh.visible = !together;
      if (together) continue;
      mesh.count = mesh === shafts || mesh === heads ? arrows : axes;
      mesh.instanceMatrix.needsUpdate = true;
      mesh.instanceColor.needsUpdate = true;
      mesh.geometry.attributes.fade.needsUpdate = true;
    }
    this.camera.updateMatrixWorld();
    this.renderer.render(this.scene, this.camera);
  }

  drawGrid(look) {
    let cell = 1;
    while (this.extent / cell > 40) cell *= 10;
    const cells = Math.max(10, 2 * Math.ceil((this.extent * 1.1) / cell));
    if (this.gridSize !== cells * cell) {
      if (this.grid) {
        this.scene.remove(this.grid);
        this.grid.geometry.dispose();
        this.grid.material.dispose();
      }
      this.gridSize = cells * cell;
      this.grid = new GridHelper(this.gridSize, cells, ...this.theme.grid);
      this.grid.rotation.x = Math.PI / 2;
      this.grid.position.z = -1e-4;
      this.scene.add(this.grid);
    }
    if (this.grid) this.grid.visible = look.grid;
  }

  /** Pixels from the top left corner, or null for what lies behind the camera. */
  project(x, y, z) {
    const { point } = this;
    point.set(x, y, z).applyMatrix4(this.camera.matrixWorldInverse);
    if (this.view === "orbit" && point.z > -0.01) return null;
    point.applyMatrix4(this.camera.projectionMatrix);
    return [((point.x + 1) / 2) * this.width, ((1 - point.y) / 2) * this.height];
  }

  /** The trails: [{points, color}, …]. */
  drawUnder(trails) {
    // A layer less to put together while there is nothing on it.
    this.under.hidden = !trails.length;
    if (!trails.length) return;
    const pen = flat(this.under);
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.clearRect(0, 0, this.width, this.height);
    pen.lineCap = pen.lineJoin = "round";
    pen.lineWidth = 2.2;
    for (const { points, color } of trails) {
      pen.strokeStyle = color;
      const stages = 12;
      for (let stage = 0; stage < stages; stage++) {
        const from = Math.floor((stage * (points.length - 1)) / stages);
        const to = Math.floor(((stage + 1) * (points.length - 1)) / stages);
        if (to <= from) continue;
        pen.globalAlpha = 0.08 + (0.85 * (stage + 1)) / stages;
        pen.beginPath();
        let down = false;
        for (let at = from; at <= to; at++) {
          const spot = this.project(points[at][0], points[at][1], points[at][2]);
          if (spot) pen[down ? "lineTo" : "moveTo"](spot[0], spot[1]);
          down = spot !== null;
        }
        pen.stroke();
      }
    }
    pen.globalAlpha = 1;
  }

  /** Names, the chosen frame's ring and the pair's chain. Names are only ever painted as text. */
  drawOver(labels, chain, ring) {
    const pen = flat(this.over);
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.clearRect(0, 0, this.width, this.height);
    const spots = chain.map((pose) => this.project(pose[0], pose[1], pose[2]));
    if (spots.length > 1 && spots.every(Boolean)) {
      pen.strokeStyle = pen.fillStyle = this.theme.accent;
      pen.lineWidth = 2;
      pen.setLineDash([2, 7]);
      pen.lineCap = "round";
      pen.beginPath();
      spots.forEach(([x, y], at) => pen[at ? "lineTo" : "moveTo"](x, y));
      pen.stroke();
      pen.setLineDash([]);
      spots.forEach(([x, y], at) => {
        const end = at === 0 || at === spots.length - 1;
        pen.beginPath();
        pen.arc(x, y, end ? 5 : 3, 0, 7);
        pen.fill();
      });
    }
    if (ring) {
      const spot = this.project(ring[0], ring[1], ring[2]);
      if (spot) {
        pen.strokeStyle = this.theme.accent;
        pen.lineWidth = 2;
        pen.beginPath();
        pen.arc(spot[0], spot[1], 13, 0, 7);
        pen.stroke();
      }
    }
    const taken = new Set();
    for (const { name, pose, alpha, grey, first } of labels) {
      const spot = this.project(pose[0], pose[1], pose[2]);
      if (!spot || spot[0] < -200 || spot[0] > this.width + 200 || spot[1] < -40 || spot[1] > this.height + 40) continue;
      const sign = this.sign(name, first ? this.theme.accent : this.theme.text);
      const y = spot[1] + 10;
      // One name per patch of the picture: a heap of names says nothing.
      const half = sign.width / this.ratio / 2;
      const cells = [];
      for (let x = Math.floor((spot[0] - half) / 16); x <= Math.floor((spot[0] + half) / 16); x++) {
        for (let row = Math.floor(y / 7); row <= Math.floor((y + 12) / 7); row++) cells.push(`${x},${row}`);
      }
      if (!first && cells.some((cell) => taken.has(cell))) continue;
      cells.forEach((cell) => taken.add(cell));
      pen.globalAlpha = alpha * (1 - 0.4 * grey);
      pen.drawImage(sign, Math.round(spot[0] - half), Math.round(y - 3), 2 * half, sign.height / this.ratio);
    }
    pen.globalAlpha = 1;
  }

  /** A name painted once, to be put down in every picture: outlines of letters are costly. */
  sign(name, color) {
    const key = `${this.ratio} ${color} ${name}`;
    const known = this.signs.get(key);
    if (known) return known;
    const text = name.length > 48 ? `${name.slice(0, 30)}…${name.slice(-16)}` : name;
    const font = "600 12px system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif";
    const sheet = document.createElement("canvas");
    const pen = flat(sheet);
    pen.font = font;
    sheet.width = Math.ceil((pen.measureText(text).width + 8) * this.ratio);
    sheet.height = Math.ceil(22 * this.ratio);
    pen.scale(this.ratio, this.ratio);
    pen.font = font; // a new size forgets it
    pen.textBaseline = "top";
    pen.lineJoin = "round";
    pen.lineWidth = 4;
    pen.strokeStyle = this.theme.halo;
    pen.strokeText(text, 4, 3);
    pen.fillStyle = color;
    pen.fillText(text, 4, 3);
    if (this.signs.size > 5000) this.signs.clear();
    this.signs.set(key, sheet);
    return sheet;
  }

  /** Everything visible, as one canvas. Call in the same task as `draw`. */
  picture() {
    const sheet = document.createElement("canvas");
    sheet.width = this.under.width;
    sheet.height = this.under.height;
    const pen = flat(sheet);
    pen.fillStyle = this.theme.background;
    pen.fillRect(0, 0, sheet.width, sheet.height);
    for (const layer of [this.under, this.main, this.over]) {
      if (!layer.hidden) pen.drawImage(layer, 0, 0, sheet.width, sheet.height);
    }
    return sheet;
  }
}
