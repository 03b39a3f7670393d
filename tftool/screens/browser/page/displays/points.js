// @ts-check
// Points of a cloud or a scan, coloured by height if they have no colours.
import { BufferAttribute, BufferGeometry, Color, Points, PointsMaterial, SRGBColorSpace } from "three";

const SIZE = 3; // pixels
const FLAT = 0.05; // metres

/**
 * A message's colour, which is shown unchanged.
 * @param {Float32Array} colors
 */
export const shade = (colors, at = 0) => new Color().setRGB(colors[at], colors[at + 1], colors[at + 2], SRGBColorSpace);

/**
 * The positions of a shape, and the colours of the positions if the shape has colours.
 * @param {import("../tracks.js").Shape} shape
 */
export function geometry(shape) {
  const made = new BufferGeometry();
  made.setAttribute("position", new BufferAttribute(shape.places(), 3));
  const colors = shape.colors();
  if (!colors) return made;
  const light = Float32Array.from(colors);
  for (let at = 0; at < light.length; at += 4) shade(colors, at).toArray(light, at);
  made.setAttribute("color", new BufferAttribute(light, 4));
  return made;
}

/**
 * Material options for a shape's colours, or for its topic's colour.
 * @param {import("../tracks.js").Shape} shape
 */
export function ink(shape, color) {
  const colors = shape.colors();
  return colors ? { vertexColors: true, transparent: colors.some((share, at) => at % 4 === 3 && share < 1) } : { color };
}

/** @param {import("../tracks.js").Shape} shape */
export function points(shape, color) {
  const made = geometry(shape);
  const size = { size: SIZE, sizeAttenuation: false };
  if (shape.colors()) return new Points(made, new PointsMaterial({ ...size, ...ink(shape, color) }));
  const places = shape.places();
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
    made.setAttribute("color", new BufferAttribute(colors, 3));
  }
  const material = new PointsMaterial({ ...size, vertexColors: high });
  if (!high) material.color.set(color);
  return new Points(made, material);
}
