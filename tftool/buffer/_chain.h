/* Arithmetic of a lookup: find samples, interpolate between them, compose links.

   Pure C, without Python. Each function has a twin: a function in Python (`history`, `solver`,
   `geometry.poses`, `batch/`) with the same operations in the same order, except that short arcs
   use a series here. */

#ifndef TFTOOL_CHAIN_H
#define TFTOOL_CHAIN_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "_path.h"

/* A function with this attribute is compiled twice, also for processors with vectors of four
   numbers (AVX2). The loader chooses one; only glibc supports that. */
#if defined(__GNUC__) && defined(__x86_64__) && defined(__GLIBC__)
#define WIDE __attribute__((target_clones("avx2", "default")))
#else
#define WIDE
#endif

/* A function with this attribute is compiled for processors with vectors of eight numbers (AVX-512).
   GCC has the builtin from version 12 on. */
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)
#define EIGHTS __attribute__((target("avx512f,avx512dq,avx512vl")))
#endif
#endif

/* Number of rows that are solved together, a multiple of 8. Their work memory fits in the
   first-level cache and in the stack of a small thread, and the compiler vectorises each loop. */
#define BLOCK 64

/* Poses as a structure of arrays: `width` numbers x, then y, z, qx, qy, qz, qw. A single lookup
   uses the same functions, with a width of 1. */
typedef double Rows[7 * BLOCK];

/* A sample as in `history`: the stamp in nanoseconds, x y z, qx qy qz qw. */
typedef struct {
    int64_t stamp;
    double pose[7];
} Record;

/* A link (pose of a child in its parent) opened for lookups: sorted records, or a static pose. */
typedef struct {
    const Record *records; /* NULL for a static link: see `fixed`. */
    ptrdiff_t last;
    int64_t oldest, newest; /* Equal if there is one record. */
    double rate;            /* Records per nanosecond. */
    ptrdiff_t here;         /* First guess of the index for a single lookup. */
    double fixed[7];
} Edge;

/* Search ----------------------------------------------------------------- */

/* Guess the index of the record before a time from the mean rate of the samples. Prefetch that
   record and the next. If there are two records, the index is less than `last`. */
INLINE ptrdiff_t aim(const Edge *edge, int64_t time) {
    const double most = edge->last > 0 ? (double)(edge->last - 1) : 0.0;
    double at = ((double)time - (double)edge->oldest) * edge->rate;
    at = at < most ? at : most;
    const ptrdiff_t here = (ptrdiff_t)(at > 0.0 ? at : 0.0);
    for (int line = 0; line < 3; line++)
        PREFETCH((const char *)(edge->records + here + line) - (line == 2));
    return here;
}

/* Return the index of the last record at or before a time, given stamp[0] <= time < stamp[last]
   and a guess. Corrects the guess twice by the mean rate, then bisects. The index is less than
   `last` even if another thread writes the stamps meanwhile. */
static ptrdiff_t find(const Edge *edge, int64_t time, ptrdiff_t at) {
    const Record *records = edge->records;
    ptrdiff_t low = 0, high = edge->last;
    for (int turn = 0; high - low > 1; turn++) {
        const int64_t there = records[at].stamp;
        if (there > time)
            high = at;
        else if (time < records[at + 1].stamp)
            return at;
        else
            low = at + 1;
        const double next = (double)at + ((double)time - (double)there) * edge->rate;
        if (turn >= 2)
            at = low + (high - low) / 2;
        else
            at = next < (double)high ? (next > (double)low ? (ptrdiff_t)next : low) : high - 1;
    }
    return low < edge->last ? low : edge->last - 1;
}

/* Return the part `since` of `length` nanoseconds as a fraction; NaN after the end of a record. */
INLINE double fraction_of(uint64_t since, uint64_t length) {
    return length > 0 ? (double)since / (double)length : since > 0 ? NAN : 0.0;
}

#ifdef EIGHTS
typedef double Eight __attribute__((vector_size(64)));

/* Load eight records as whole records, and write them transposed: their stamps, and `width`
   numbers x, then y and so on. A batch takes 20 % less time than with 112 single numbers. */
INLINE void transpose(const Record *records, const ptrdiff_t *places, int width, int64_t *stamps,
                      double *pose) {
    Eight row[8], pair[8], four[8];
    for (int i = 0; i < 8; i++)
        memcpy(&row[i], records + places[i], sizeof row[i]);
    for (int i = 0; i < 8; i += 2) {
        pair[i] = __builtin_shufflevector(row[i], row[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        pair[i + 1] = __builtin_shufflevector(row[i], row[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int i = 0; i < 8; i += i % 4 == 1 ? 3 : 1) {
        four[i] = __builtin_shufflevector(pair[i], pair[i + 2], 0, 1, 8, 9, 4, 5, 12, 13);
        four[i + 2] = __builtin_shufflevector(pair[i], pair[i + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
    /* `four[k]` and `four[k + 4]` hold the columns k and k + 4 of the records. */
    for (int k = 0; k < 8; k++) {
        const Eight up = four[k % 4], low = four[k % 4 + 4];
        const Eight column = k < 4 ? __builtin_shufflevector(up, low, 0, 1, 2, 3, 8, 9, 10, 11)
                                   : __builtin_shufflevector(up, low, 4, 5, 6, 7, 12, 13, 14, 15);
        memcpy(k == 0 ? (void *)stamps : pose + (k - 1) * width, &column, sizeof column);
    }
}

/* Load the records at each place and the next, and the fractions, in groups of eight. */
INLINE void fetch_eights(const Edge *edge, const int64_t *times, int n, int width, double *first,
                         double *second, double *fraction, ptrdiff_t *places) {
    int64_t before[BLOCK], after[BLOCK];
    /* Extra rows of the last group repeat the last place; their results are not used. */
    for (int i = n; i % 8 != 0; i++)
        places[i] = places[n - 1];
    for (int i = 0; i < n; i += 8) {
        transpose(edge->records, places + i, width, before + i, first + i);
        for (int k = i; k < i + 8; k++)
            places[k] += places[k] < edge->last;
        transpose(edge->records, places + i, width, after + i, second + i);
    }
    for (int i = 0; i < n; i++)
        fraction[i] = fraction_of((uint64_t)times[i] - (uint64_t)before[i],
                                  (uint64_t)after[i] - (uint64_t)before[i]);
}
#endif

/* Load the records before and after each time, and the fraction of the way between them. The
   fraction is NaN if the link has no data at that time, which makes the pose, and every pose
   composed with it, NaN. */
INLINE void fetch(const Edge *edge, const int64_t *times, int n, int width, int eights,
                  double *first, double *second, double *fraction, ptrdiff_t *places) {
    const Record *records = edge->records;
    const ptrdiff_t last = edge->last;
    for (int i = 0; i < n; i++)
        places[i] = width > 1 ? aim(edge, times[i]) : edge->here;
    for (int i = 0; i < n; i++) {
        const int64_t time = times[i];
        ptrdiff_t at = places[i];
        if (edge->oldest < time && time < edge->newest) {
            if (width > 1) {
                /* Usually this record or a neighbour. Branches would be mispredicted in a batch,
                   so there are none. */
                at -= (at > 0) & (records[at].stamp > time);
                at += (at < last - 1) & (records[at + 1].stamp <= time);
            }
            if (!(records[at].stamp <= time && time < records[at + 1].stamp))
                at = find(edge, time, at);
        }
        else /* Of samples with an equal stamp: at the newest time the last, at the oldest the first. */
            at = time == edge->oldest && time != edge->newest ? 0 : last;
        places[i] = at;
        if (eights)
            continue;
        const Record *here = records + at, *next = here + (at < last);
        fraction[i] = fraction_of((uint64_t)time - (uint64_t)here->stamp,
                                  (uint64_t)next->stamp - (uint64_t)here->stamp);
        for (int k = 0; k < 7; k++) {
            first[k * width + i] = here->pose[k];
            second[k * width + i] = next->pose[k];
        }
    }
#ifdef EIGHTS
    if (eights)
        fetch_eights(edge, times, n, width, first, second, fraction, places);
#endif
}

/* Arithmetic of poses: twins of `geometry.poses` ------------------------- */

/* Up to this value of 1 - cos the series has this many terms; its error is below 1e-17. */
#define SHORT_ARC 1e-3
#define TERMS 4

/* Return sin(f θ) / sin θ - f for u = 1 - cos θ: the weight of one end of an arc, minus its weight
   on the chord. The series has only positive terms, so that nothing cancels:
   f (1 + b1 (1 + b2 (1 + …))) with b_i = u (i² - f²) / (i (2 i + 1)).
   Eberly, "A Fast and Accurate Algorithm for Computing SLERP", JGT 2011. */
INLINE double slerp_weight(double f, double u) {
    double sum = 1.0, more = 0.0;
    const double less = u * f * f;
    for (int i = TERMS; i > 0; i--) {
        const double scale = 1.0 / (i * (2.0 * i + 1.0));
        more = sum * (u * (i * i * scale) - less * scale);
        sum = 1.0 + more;
    }
    return f * more;
}

/* Interpolate: write to `out` the poses at `fraction` of the arc from `a` to `b`. */
INLINE void interpolate(const double *a, const double *b, const double *fraction, int n, int width,
                        double *out, double *near, double *sign, double *first_weight,
                        double *second_weight) {
    int longest = 0;
    for (int i = 0; i < n; i++) {
        const double *first = a + 3 * width + i, *second = b + 3 * width + i;
        const double cosine = first[0] * second[0] + first[width] * second[width]
            + first[2 * width] * second[2 * width] + first[3 * width] * second[3 * width];
        sign[i] = cosine < 0.0 ? -1.0 : 1.0;
        near[i] = fabs(cosine) < 1.0 ? fabs(cosine) : 1.0;
        longest += 1.0 - near[i] > SHORT_ARC;
    }
    for (int i = 0; i < n; i++) {
        first_weight[i] = slerp_weight(1.0 - fraction[i], 1.0 - near[i]);
        second_weight[i] = sign[i] * slerp_weight(fraction[i], 1.0 - near[i]);
    }
    for (int k = 0; k < 7; k++)
        for (int i = 0; i < n; i++) {
            /* At a sample's own time the sample is copied, as 0 times infinity would be NaN.
               Between equal rotations the result is equal to them, to the last bit. */
            const double here = a[k * width + i], there = b[k * width + i];
            const double chord = here + fraction[i] * ((k < 3 ? there : sign[i] * there) - here);
            const double weighted = first_weight[i] * here + second_weight[i] * there;
            const double arc = k < 3 ? chord : chord + weighted;
            out[k * width + i] = fraction[i] == 0.0 ? here : arc;
        }
    for (int i = 0; longest > 0 && i < n; i++)
        if (1.0 - near[i] > SHORT_ARC && fraction[i] > 0.0) {
            const double angle = acos(near[i]), sine = sin(angle);
            const double weight = sin((1.0 - fraction[i]) * angle) / sine;
            const double taken = sign[i] * (sin(fraction[i] * angle) / sine);
            for (int k = 3; k < 7; k++)
                out[k * width + i] = weight * a[k * width + i] + taken * b[k * width + i];
        }
}

/* Rotate a pose in place. */
INLINE void turn(double ax, double ay, double az, double aw, double *pose, int width) {
    const double x = pose[0], y = pose[width], z = pose[2 * width];
    const double bx = pose[3 * width], by = pose[4 * width], bz = pose[5 * width];
    const double bw = pose[6 * width];
    const double cx = 2.0 * (ay * z - az * y);
    const double cy = 2.0 * (az * x - ax * z);
    const double cz = 2.0 * (ax * y - ay * x);
    pose[0] = x + aw * cx + ay * cz - az * cy;
    pose[width] = y + aw * cy + az * cx - ax * cz;
    pose[2 * width] = z + aw * cz + ax * cy - ay * cx;
    pose[3 * width] = aw * bx + ax * bw + ay * bz - az * by;
    pose[4 * width] = aw * by + ay * bw + az * bx - ax * bz;
    pose[5 * width] = aw * bz + az * bw + ax * by - ay * bx;
    pose[6 * width] = aw * bw - ax * bx - ay * by - az * bz;
}

/* Replace `inner` by `outer * inner`. */
INLINE void compose(const double *outer, double *inner, int n, int width) {
    for (int i = 0; i < n; i++) {
        const double *o = outer + i;
        turn(o[3 * width], o[4 * width], o[5 * width], o[6 * width], inner + i, width);
        for (int k = 0; k < 3; k++)
            inner[k * width + i] += o[k * width];
    }
}

/* Replace `second` by its pose relative to `first`: the difference, rotated back. */
INLINE void relative(const double *first, double *second, int n, int width) {
    for (int i = 0; i < n; i++) {
        const double *o = first + i;
        for (int k = 0; k < 3; k++)
            second[k * width + i] -= o[k * width];
        turn(-o[3 * width], -o[4 * width], -o[5 * width], o[6 * width], second + i, width);
    }
}

/* Give quaternions the sign that tf2 gives them: `quaternions.canonical`. */
INLINE void canonical(double *q, int width) {
    const double sign = leading(q[0], q[width], q[2 * width], q[3 * width]) < 0.0 ? -1.0 : 1.0;
    for (int k = 0; k < 4; k++)
        q[k * width] *= sign;
}

/* Scale products of unit quaternions to length one and give them tf2's sign: `quaternions.unit`,
   then `canonical`. */
INLINE void normalise(double *turn, int n, int width) {
    for (int i = 0; i < n; i++) {
        double *q = turn + i;
        const double square = square_of(q, width);
        const double scale = fabs(square - 1.0) < ROUNDING ? 1.0 : 1.0 / sqrt(square);
        for (int k = 0; k < 4; k++)
            q[k * width] *= scale;
        canonical(q, width);
    }
}

/* Work memory, owned by the caller: each array has space for `width` times. A single lookup needs
   300 bytes of stack, a block 21 KB: lookups must also succeed in a thread with a stack of 64 KB.
   Separate arrays, so that the compiler knows that none overlaps another. */
typedef struct {
    double *first, *second, *step, *other;      /* 7 numbers for each time. */
    double *fraction, *near, *sign, *first_weight, *second_weight;  /* 1 number for each time. */
    ptrdiff_t *places;
    int eights; /* Whether to use vectors of eight numbers. */
} Workspace;

/* Compose the poses of several links, lowest first, at each time: `solver.chain`. */
INLINE void compose_links(const Edge *edges, ptrdiff_t count, const int64_t *times, int n,
                          int width, double *pose, const Workspace *work) {
    double *const step = work->step;
    for (ptrdiff_t e = 0; e < count || e == 0; e++) {
        double *out = e > 0 ? step : pose;
        if (count > 0 && edges[e].records != NULL) {
            fetch(&edges[e], times, n, width, work->eights, work->first, work->second,
                  work->fraction, work->places);
            /* A single time that is the stamp of a sample, as in most lookups of the latest
               pose, needs no interpolation. This saves 7 % of a lookup. */
            if (width == 1 && work->fraction[0] == 0.0)
                memcpy(out, work->first, 7 * sizeof *out);
            else
                interpolate(work->first, work->second, work->fraction, n, width, out, work->near,
                            work->sign, work->first_weight, work->second_weight);
        }
        else
            for (int k = 0; k < 7; k++)
                for (int i = 0; i < n; i++)
                    out[k * width + i] = count > 0 ? edges[e].fixed[k] : k == 6;
        if (e > 0)
            compose(step, pose, n, width);
    }
}

/* Chains ------------------------------------------------------------------- */

/* The open links from source upward, then those from target upward. The caller owns the edges. */
typedef struct {
    Edge *edges;
    ptrdiff_t ups, count;
} Chain;

/* Write the poses of source in target, or NaN in all numbers: `Path.solve`. */
INLINE void solve_chain(const Chain *chain, const int64_t *times, int n, int width, double *pose,
                      const Workspace *work) {
    compose_links(chain->edges, chain->ups, times, n, width, pose, work);
    if (chain->count > chain->ups) {
        compose_links(chain->edges + chain->ups, chain->count - chain->ups, times, n, width,
                      work->other, work);
        relative(work->other, pose, n, width);
    }
    normalise(pose + 3 * width, n, width);
}

/* Write the pose of source in target at one time, or NaN in all numbers. */
INLINE void solve_one(const Chain *chain, int64_t time, double *pose) {
    double first[7], second[7], step[7], other[7], fraction[1], near[1];
    double sign[1], first_weight[1], second_weight[1];
    ptrdiff_t places[1];
    const Workspace work = {first, second, step, other, fraction, near, sign, first_weight,
                            second_weight, places, 0};
    solve_chain(chain, &time, 1, 1, pose, &work);
}

/* Write the poses of source in target at many times, block by block. A row without data becomes
   NaN, and its `valid` 0. Returns the number of rows without data. */
INLINE ptrdiff_t solve_blocks(const Chain *chain, ptrdiff_t rows, const int64_t *times,
                              double *places, double *turns, unsigned char *valid, int eights) {
    ptrdiff_t missing = 0;
    Rows pose, first, second, step, other;
    double fraction[BLOCK], near[BLOCK], sign[BLOCK], first_weight[BLOCK], second_weight[BLOCK];
    ptrdiff_t indices[BLOCK];
    const Workspace work = {first, second, step, other, fraction, near, sign, first_weight,
                            second_weight, indices, eights};
    for (ptrdiff_t start = 0; start < rows; start += BLOCK) {
        const int n = rows - start < BLOCK ? (int)(rows - start) : BLOCK;
        solve_chain(chain, times + start, n, BLOCK, pose, &work);
        const double *w = pose + 6 * BLOCK;
        for (int i = 0; i < n; i++)
            valid[start + i] = (times[start + i] != 0) & (w[i] == w[i]);
        for (ptrdiff_t i = 0, row = start; i < n; i++, row++) {
            missing += !valid[row];
            const double known = valid[row] ? 1.0 : NAN;
            for (int k = 0; k < 3; k++)
                places[3 * row + k] = pose[k * BLOCK + i] * known;
            for (int k = 0; k < 4; k++)
                turns[4 * row + k] = pose[(3 + k) * BLOCK + i] * known;
        }
    }
    return missing;
}

WIDE static ptrdiff_t solve_plainly(const Chain *chain, ptrdiff_t rows, const int64_t *times,
                                    double *places, double *turns, unsigned char *valid) {
    return solve_blocks(chain, rows, times, places, turns, valid, 0);
}

#ifdef EIGHTS
EIGHTS static ptrdiff_t solve_by_eights(const Chain *chain, ptrdiff_t rows, const int64_t *times,
                                        double *places, double *turns, unsigned char *valid) {
    return solve_blocks(chain, rows, times, places, turns, valid, 1);
}
#endif

/* `solve_blocks`, compiled for this processor. */
static ptrdiff_t solve_rows(const Chain *chain, ptrdiff_t rows, const int64_t *times,
                            double *places, double *turns, unsigned char *valid) {
#ifdef EIGHTS
    if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        return solve_by_eights(chain, rows, times, places, turns, valid);
#endif
    return solve_plainly(chain, rows, times, places, turns, valid);
}

#endif
