/* Parts of both the kernel and the scan of recordings: hints to compilers, and a test whether a history
   can store a sample unchanged.

   The same test in Python is in `batch.insert.adopt`. */

#ifndef TFTOOL_PATH_H
#define TFTOOL_PATH_H

#include <float.h>
#include <math.h>

#if defined(__GNUC__)
#define INLINE static inline __attribute__((always_inline))
#define PREFETCH(place) __builtin_prefetch(place)
#define APART static __attribute__((noinline))
#else
#define INLINE static inline
#define APART static
#define PREFETCH(place) (void)(place)
#endif

#define ROUNDING 8e-16 /* Largest error of the squared length of a unit quaternion. */

/* Return the component that tf2 makes positive in a unit quaternion: `quaternions.leading`. */
static inline double leading(double x, double y, double z, double w) {
    if (w * w > 0.25)
        return w;
    const double xx = x * x, yy = y * y, zz = z * z;
    return xx < yy ? (yy < zz ? z : y) : (xx < zz ? z : x);
}

/* Return the squared length of a quaternion; its components are `width` numbers apart. */
static inline double square_of(const double *q, int width) {
    return q[0] * q[0] + q[width] * q[width] + q[2 * width] * q[2 * width]
        + q[3 * width] * q[3 * width];
}

/* Whether a pose (x y z, qx qy qz qw) is stored unchanged: finite, with a unit quaternion of tf2's
   sign. */
static inline int is_normalised(const double *n) {
    const double *turn = n + 3, square = square_of(turn, 1);
    /* A NaN or infinite component gives a squared length that is not near 1. */
    return fabs(n[0]) <= DBL_MAX && fabs(n[1]) <= DBL_MAX && fabs(n[2]) <= DBL_MAX
        && 1.0 - ROUNDING < square && square < 1.0 + ROUNDING
        && !(leading(turn[0], turn[1], turn[2], turn[3]) < 0.0);
}

#endif
