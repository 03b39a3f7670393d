// @ts-check
// A point, as a dot visible from any distance.
import { Points, PointsMaterial } from "three";
import { geometry } from "./points.js";

const SIZE = 12; // pixels

/** @param {import("../tracks.js").Shape} shape */
export const ball = (shape, color) =>
  new Points(geometry(shape), new PointsMaterial({ size: SIZE, sizeAttenuation: false, color }));
