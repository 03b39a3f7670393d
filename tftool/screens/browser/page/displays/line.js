// @ts-check
// A line through places (of a path or a marker), or separate lines between pairs of places.
import { Line, LineBasicMaterial, LineSegments } from "three";
import { geometry, ink } from "./points.js";

/** @param {import("../tracks.js").Shape} shape */
export const line = (shape, color) => new Line(geometry(shape), new LineBasicMaterial(ink(shape, color)));

/** @param {import("../tracks.js").Shape} shape */
export const segments = (shape, color) => new LineSegments(geometry(shape), new LineBasicMaterial(ink(shape, color)));
