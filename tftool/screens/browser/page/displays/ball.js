// @ts-check
// One place, of a point, as a dot that is seen from any distance.
import { Points, PointsMaterial } from "three";
import { geometry } from "./points.js";

const SIZE = 12; // pixels

/** @param {import("../tracks.js").Shape} shape */
export const ball = (shape, color) =>
  new Points(geometry(shape), new PointsMaterial({ size: SIZE, sizeAttenuation: false, color }));
