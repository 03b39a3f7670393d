// @ts-check
// Cameras that look along an axis, without perspective: from above, from the side, from the front.
import { MOUSE, OrthographicCamera, TOUCH, Vector3 } from "three";

const REACH = 1e5; // metres
const AWAY = 50; // metres from the box to the camera; without perspective, the value has no effect

/**
 * Direction of view and upward direction of each camera, in ROS's axes: x forward, y left, z up.
 * @type {Record<string, { from: [number, number, number], up: [number, number, number] }>}
 */
export const FLAT = {
  top: { from: [0, 0, 1], up: [0, 1, 0] },
  side: { from: [0, -1, 0], up: [0, 0, 1] },
  front: { from: [1, 0, 0], up: [0, 0, 1] },
};

/** @param {string} name */
export function flatCamera(name) {
  const camera = new OrthographicCamera(-1, 1, 1, -1, -REACH, REACH);
  camera.up.set(...FLAT[name].up);
  camera.position.set(...FLAT[name].from).multiplyScalar(AWAY);
  return camera;
}

/** A picture without perspective can be moved and zoomed, but not turned. */
export function panOnly(controls) {
  controls.enableRotate = false;
  controls.screenSpacePanning = true;
  controls.mouseButtons = { LEFT: MOUSE.PAN, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
  controls.touches = { ONE: TOUCH.PAN, TWO: TOUCH.DOLLY_PAN };
}

/**
 * Look at a box.
 * @param {string} name
 * @param {OrthographicCamera} camera ten metres high at zoom 1
 * @param {any} controls
 * @param {{ middle: Vector3, size: Vector3 }} box
 * @param {{ x: number, y: number }} free pixels that no panel covers
 * @param {{ left: number, right: number, top: number, bottom: number }} inset pixels that panels cover
 * @param {number} height of the picture, pixels
 */
export function fitFlat(name, camera, controls, { middle, size }, free, inset, height) {
  const from = new Vector3(...FLAT[name].from);
  const up = new Vector3(...FLAT[name].up);
  const right = up.clone().cross(from);
  const across = Math.max(1, Math.abs(size.dot(right)));
  const tall = Math.max(1, Math.abs(size.dot(up)));
  const perPixel = Math.max((across * 1.2) / free.x, (tall * 1.2) / free.y);
  camera.zoom = 10 / height / perPixel;
  controls.target
    .set(0, 0, 0)
    .addScaledVector(right, middle.dot(right) + ((inset.right - inset.left) / 2) * perPixel)
    .addScaledVector(up, middle.dot(up) + ((inset.top - inset.bottom) / 2) * perPixel);
  camera.position.copy(controls.target).addScaledVector(from, AWAY);
  camera.updateProjectionMatrix();
  controls.update();
}

/**
 * Ray through a pixel: its origin and direction.
 * @param {import("three").Camera} camera
 * @param {number} x share of the picture from the left, 0 to 1
 * @param {number} y share of the picture from the top
 * @returns {{ origin: number[], way: number[] }}
 */
export function ray(camera, x, y) {
  const near = new Vector3(2 * x - 1, 1 - 2 * y, -1).unproject(camera);
  const far = new Vector3(2 * x - 1, 1 - 2 * y, 1).unproject(camera);
  return { origin: near.toArray(), way: far.sub(near).normalize().toArray() };
}
