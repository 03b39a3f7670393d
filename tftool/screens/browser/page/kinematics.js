// @ts-check
// Forward kinematics of a robot, from the description in the saved page.
import { compose } from "./maths.js";

/**
 * frame: child frame. turns: whether the joint turns about its axis; otherwise, the joint slides. leader: the joint
 * that this joint mimics, else the joint itself; position = leader's position * factor + offset.
 * @typedef {{ frame: string, turns: boolean, origin: number[], axis: number[], leader: string, factor: number,
 *   offset: number }} Joint
 */

/**
 * Pose of the child in its parent, for a position in radians or metres.
 * @param {Joint} joint
 * @param {number} position
 */
export function posed({ turns, origin, axis: [x, y, z] }, position) {
  if (!turns) return compose(origin, [x * position, y * position, z * position, 0, 0, 0, 1]);
  const share = Math.sin(position / 2) / Math.hypot(x, y, z);
  return compose(origin, [0, 0, 0, x * share, y * share, z * share, Math.cos(position / 2)]);
}

/**
 * Links that move with a joint, and their new poses in their parents.
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
