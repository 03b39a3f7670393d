// @ts-check
// Where a robot's joints put its links, from the description that lies in the file.
import { compose } from "./maths.js";

/**
 * frame: the child's. turns: about its axis, else it slides along it. leader: the joint whose position
 * decides, its own name unless it mimics another; its position times factor plus offset is this one's.
 * @typedef {{ frame: string, turns: boolean, origin: number[], axis: number[], leader: string, factor: number,
 *   offset: number }} Joint
 */

/**
 * The child's pose in its parent; radians or metres.
 * @param {Joint} joint
 * @param {number} position
 */
export function posed({ turns, origin, axis: [x, y, z] }, position) {
  if (!turns) return compose(origin, [x * position, y * position, z * position, 0, 0, 0, 1]);
  const share = Math.sin(position / 2) / Math.hypot(x, y, z);
  return compose(origin, [0, 0, 0, x * share, y * share, z * share, Math.cos(position / 2)]);
}

/**
 * The links that go along with a joint, and where each comes to be in its parent.
 * @param {Joint[]} joints
 * @param {string} moved the joint
 * @param {number} position
 * @returns {{ frame: string, pose: number[] }[]}
 */
export function drive(joints, moved, position) {
  return joints
    .filter(({ leader }) => leader === moved)
    .map((joint) => ({ frame: joint.frame, pose: posed(joint, joint.factor * position + joint.offset) }));
}
