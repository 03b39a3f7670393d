// @ts-check
// Rigid transforms as numbers: [x, y, z, qx, qy, qz, qw]. NaN means unknown, and propagates.

/** @type {number[]} */
export const IDENTITY = [0, 0, 0, 0, 0, 0, 1];

export function rotate(t, x, y, z) {
  const [, , , qx, qy, qz, qw] = t;
  const ux = 2 * (qy * z - qz * y);
  const uy = 2 * (qz * x - qx * z);
  const uz = 2 * (qx * y - qy * x);
  return [
    x + qw * ux + qy * uz - qz * uy,
    y + qw * uy + qz * ux - qx * uz,
    z + qw * uz + qx * uy - qy * ux,
  ];
}

export function compose(a, b) {
  const [x, y, z] = rotate(a, b[0], b[1], b[2]);
  const [, , , ax, ay, az, aw] = a;
  const [, , , bx, by, bz, bw] = b;
  return [
    a[0] + x,
    a[1] + y,
    a[2] + z,
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}

export function invert(t) {
  const turned = [0, 0, 0, -t[3], -t[4], -t[5], t[6]];
  const [x, y, z] = rotate(turned, -t[0], -t[1], -t[2]);
  return [x, y, z, -t[3], -t[4], -t[5], t[6]];
}

/** Normalise a quaternion of a pose; received quaternions may have another length than 1. */
export function normalized(t) {
  const length = Math.hypot(t[3], t[4], t[5], t[6]);
  return [t[0], t[1], t[2], t[3] / length, t[4] / length, t[5] / length, t[6] / length];
}

/** Roll, pitch and yaw in radians, fixed axes x y z, as tf2_echo prints them. */
export function rpy(t) {
  const [, , , x, y, z, w] = t;
  const sine = Math.max(-1, Math.min(1, 2 * (w * y - z * x)));
  if (Math.abs(sine) > 1 - 1e-12) {
    // At ±90° of pitch, roll and yaw turn about the same axis: the whole angle becomes roll.
    const roll = 2 * Math.atan2(x, w);
    return [Math.atan2(Math.sin(roll), Math.cos(roll)), Math.sign(sine) * (Math.PI / 2), 0];
  }
  return [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    Math.asin(sine),
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  ];
}

export const degrees = (radians) => (radians * 180) / Math.PI;
export const known = (t) => t !== null && t.every((value) => Math.abs(value) < 1e12);
