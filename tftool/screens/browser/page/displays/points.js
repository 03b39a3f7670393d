// @ts-check
// Many points, of a cloud or a scan, coloured by their height where they have one.
import { BufferAttribute, BufferGeometry, Color, Points, PointsMaterial } from "three";

const SIZE = 3; // pixels
const FLAT = 0.05; // metres

/** @param {Float32Array} places */
export function points(places, color) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(places, 3));
  let [least, most] = [Infinity, -Infinity];
  for (let at = 2; at < places.length; at += 3) {
    least = Math.min(least, places[at]);
    most = Math.max(most, places[at]);
  }
  const high = most - least > FLAT;
  if (high) {
    const colors = new Float32Array(places.length);
    const one = new Color();
    for (let at = 0; at < places.length; at += 3) {
      one.setHSL(0.7 * (1 - (places[at + 2] - least) / (most - least)), 0.9, 0.5).toArray(colors, at);
    }
    geometry.setAttribute("color", new BufferAttribute(colors, 3));
  }
  const material = new PointsMaterial({ size: SIZE, sizeAttenuation: false, vertexColors: high });
  if (!high) material.color.set(color);
  return new Points(geometry, material);
}
