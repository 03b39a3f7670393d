// @ts-check
// A line through places, of a path.
import { BufferAttribute, BufferGeometry, Line, LineBasicMaterial } from "three";

/** @param {Float32Array} places */
export function line(places, color) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(places, 3));
  return new Line(geometry, new LineBasicMaterial({ color }));
}
