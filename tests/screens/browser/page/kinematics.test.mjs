import assert from "node:assert/strict";
import { test } from "node:test";
import { drive, posed } from "../../../../tftool/screens/browser/page/kinematics.js";
import { compose, rotate } from "../../../../tftool/screens/browser/page/maths.js";

const REST = [0, 0, 0, 0, 0, 0, 1];
const joint = (fields) => ({
  frame: "link", turns: true, origin: REST, axis: [0, 0, 1], leader: "turn", factor: 1, offset: 0, ...fields,
});
const close = (found, wanted) => found.forEach((value, at) => assert.ok(Math.abs(value - wanted[at]) < 1e-12, `${found}`));

test("two links in a plane reach where the law of cosines says", () => {
  const [first, second] = [0.7, -1.9];
  const hand = compose(
    compose(posed(joint({}), first), posed(joint({ origin: [2, 0, 0, 0, 0, 0, 1] }), second)),
    [1.5, 0, 0, 0, 0, 0, 1],
  );

  close(hand.slice(0, 3), [
    2 * Math.cos(first) + 1.5 * Math.cos(first + second),
    2 * Math.sin(first) + 1.5 * Math.sin(first + second),
    0,
  ]);
});

test("a joint slides along its axis as its origin turns it", () => {
  const half = Math.SQRT1_2; // a quarter turn about x: y becomes z
  close(posed(joint({ turns: false, origin: [1, 2, 3, half, 0, 0, half], axis: [0, 1, 0] }), 0.25), [1, 2, 3.25, half, 0, 0, half]);
});

test("a turn leaves its axis where it is, however long it is written", () => {
  const pose = posed(joint({ axis: [3, -1, 2] }), 2.1);

  close(rotate(pose, 3, -1, 2), [3, -1, 2]);
  close([Math.hypot(...pose.slice(3))], [1]);
});

test("joints that mimic the one moved go along, others stay", () => {
  const joints = [
    joint({}),
    joint({ frame: "finger", leader: "turn", factor: -2, offset: 0.1 }),
    joint({ frame: "other", leader: "lift" }),
  ];
  const moved = drive(joints, "turn", 0.3);

  assert.deepEqual(moved.map(({ frame }) => frame), ["link", "finger"]);
  close(moved[1].pose, [0, 0, 0, 0, 0, Math.sin(-0.25), Math.cos(-0.25)]);
});
