// @ts-check
// Solids and texts of markers: one solid at each place of a shape, with one rotation and size.
import {
  BoxGeometry, CanvasTexture, Color, ConeGeometry, CylinderGeometry, DoubleSide, Group, InstancedMesh, Matrix4,
  Mesh, MeshLambertMaterial, Quaternion, SphereGeometry, Sprite, SpriteMaterial, SRGBColorSpace, Vector3,
} from "three";
import { geometry, ink, shade } from "./points.js";

const SEGMENTS = 32; // of round solids
const LETTER = 64; // pixels of a letter's height

// A cylinder's axis is z in ROS, y in three.js. Each solid fills a cube of one metre.
const upright = (made) => made.rotateX(Math.PI / 2);
const UNITS = {
  box: () => new BoxGeometry(),
  sphere: () => new SphereGeometry(0.5, SEGMENTS, SEGMENTS / 2),
  cylinder: () => upright(new CylinderGeometry(0.5, 0.5, 1, SEGMENTS)),
  cone: () => upright(new ConeGeometry(0.5, 1, SEGMENTS)),
};

/** Opacity of solids with these colours: three.js has one opacity for all solids of a mesh. */
function glass(colors) {
  const opacity = colors?.[3] ?? 1;
  return { opacity, transparent: opacity < 1 };
}

/** @param {keyof typeof UNITS} kind */
const solid = (kind) =>
  /** @param {import("../tracks.js").Shape} shape */
  (shape, tint) => {
    const [places, colors] = [shape.places(), shape.colors()];
    const made = new InstancedMesh(UNITS[kind](), new MeshLambertMaterial(glass(colors)), places.length / 3);
    const [turn, size] = [new Quaternion().fromArray(shape.turn), new Vector3().fromArray(shape.size)];
    for (let at = 0; 3 * at < places.length; at++) {
      made.setMatrixAt(at, new Matrix4().compose(new Vector3().fromArray(places, 3 * at), turn, size));
      made.setColorAt(at, colors ? shade(colors, 4 * at) : new Color(tint));
    }
    return made;
  };

export const box = solid("box");
export const sphere = solid("sphere");
export const cylinder = solid("cylinder");
export const cone = solid("cone");

/** @param {import("../tracks.js").Shape} shape three places a triangle */
export function triangles(shape, color) {
  const made = geometry(shape);
  made.computeVertexNormals();
  return new Mesh(made, new MeshLambertMaterial({ side: DoubleSide, ...ink(shape, color) }));
}

/** @param {import("../tracks.js").Shape} shape text that faces the camera; the size's z is the height of a letter */
export function words(shape, color) {
  const canvas = document.createElement("canvas");
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  const lines = shape.text.split("\n");
  const font = `${LETTER}px sans-serif`;
  pen.font = font;
  canvas.width = Math.ceil(Math.max(1, ...lines.map((line) => pen.measureText(line).width)));
  canvas.height = Math.ceil(1.2 * LETTER * lines.length);
  pen.font = font; // set again, because a canvas resets its font when it is resized
  const colors = shape.colors();
  pen.fillStyle = `#${(colors ? shade(colors) : new Color(color)).getHexString()}`;
  pen.globalAlpha = colors?.[3] ?? 1;
  lines.forEach((line, at) => pen.fillText(line, 0, LETTER * (1 + 1.2 * at)));
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  const sprite = new Sprite(new SpriteMaterial({ map }));
  const height = shape.size[2] / LETTER;
  sprite.scale.set(canvas.width * height, canvas.height * height, 1);
  sprite.position.fromArray(shape.places());
  // A group, as the caller sets the pose of the message's frame on the returned object.
  return new Group().add(sprite);
}
