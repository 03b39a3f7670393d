// @ts-check
// One place, of a point, as a dot that is seen from any distance.
import { BufferAttribute, BufferGeometry, Points, PointsMaterial } from "three";

const SIZE = 12; // pixels

/** @param {Float32Array} places */
export function ball(places, color) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(places, 3));
  return new Points(geometry, new PointsMaterial({ size: SIZE, sizeAttenuation: false, color }));
}
