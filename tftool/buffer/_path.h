/* Which samples a history stores unchanged: for the kernel, and for the scan that writes them.

   Its twin is `batch.insert.adopt`. */

#ifndef TFTOOL_PATH_H
#define TFTOOL_PATH_H

#include <float.h>
#include <math.h>

#define ROUNDING 8e-16 /* So far from 1 is the square of a unit quaternion at most. */

/* The number of a unit quaternion that tf2 makes positive: `quaternions.leading`. */
static inline double leading(double x, double y, double z, double w) {
    if (w * w > 0.25)
        return w;
    const double xx = x * x, yy = y * y, zz = z * z;
    return xx < yy ? (yy < zz ? z : y) : (xx < zz ? z : x);
}

/* The square of the length of a quaternion whose numbers lie so far apart. */
static inline double square_of(const double *q, int width) {
    return q[0] * q[0] + q[width] * q[width] + q[2 * width] * q[2 * width]
        + q[3 * width] * q[3 * width];
}

/* Whether a pose, x y z and x y z w, is stored as it is: finite, with a unit quaternion whose sign
   is tf2's. */
static inline int is_normalised(const double *n) {
    const double *turn = n + 3, square = square_of(turn, 1);
    /* Where one of the four is no number, or infinite, neither is their square's sum near 1. */
    return fabs(n[0]) <= DBL_MAX && fabs(n[1]) <= DBL_MAX && fabs(n[2]) <= DBL_MAX
        && 1.0 - ROUNDING < square && square < 1.0 + ROUNDING
        && !(leading(turn[0], turn[1], turn[2], turn[3]) < 0.0);
}

#endif
