import assert from "node:assert/strict";
import { test } from "node:test";
import { Measure, onPlane } from "../../../../tftool/screens/browser/page/measure.js";

const POSES = { a: [1, 2, 3, 0, 0, 0, 1], b: [4, 6, 3, 0, 0, 0, 1] };
const poseOf = (name) => POSES[name] ?? null;

test("a ray meets the ground in front of it, and nowhere else", () => {
  const ray = { origin: [0, 0, 10], way: [0.6, 0, -0.8] };
  assert.deepEqual(onPlane(ray, [0, 0, 1], [0, 0, 0]), [7.5, 0, 0]);
  assert.equal(onPlane({ ...ray, way: [0.6, 0, 0.8] }, [0, 0, 1], [0, 0, 0]), null);
  assert.equal(onPlane({ ...ray, way: [1, 0, 0] }, [0, 0, 1], [0, 0, 0]), null);
});

test("two frames are measured as they move; a third click begins anew", () => {
  const measure = new Measure();
  measure.turn(true);
  assert.match(measure.told(poseOf, "map"), /first point/);
  measure.click({ name: "a" });
  measure.click(null);
  assert.match(measure.told(poseOf, "map"), /second point/);
  measure.click({ name: "b" });
  assert.equal(measure.told(poseOf, "map"), "a to b: 5.000 m (x 3.000, y 4.000, z 0.000 in map)");
  assert.equal(measure.told((name) => (name === "a" ? [4, 6, 4, 0, 0, 0, 1] : POSES.b), "map"), "a to b: 1.000 m (x 0.000, y 0.000, z -1.000 in map)");
  measure.click({ name: "a", place: [0, 0, 1] });
  assert.deepEqual(measure.places(poseOf), [[1, 2, 4]]);
});

test("a frame without a pose is told, and a place goes along with its frame", () => {
  const measure = new Measure();
  measure.click({ name: "b", place: [-3, -4, -3] });
  measure.click({ name: "gone" });
  assert.match(measure.told(poseOf, "map"), /no pose/);
  measure.ends[1] = { name: "a" };
  assert.equal(measure.told(poseOf, "map"), "(-3.00, -4.00, -3.00) in b to a: 3.000 m (x 0.000, y 0.000, z 3.000 in map)");
});
