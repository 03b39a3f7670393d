/* The native kernel: what a lookup, an insert and a batch spend their time in.

   Everything here has a twin in Python that says the same thing for reading (`history`, `path`,
   `geometry.poses`, `batch/`), and the tests run on both. Its rules:

   - It does exactly what its twin does, with the same operations in the same order (built with
     -ffp-contract=off), or it does nothing and returns None: then the twin takes over. What is
     unusual (a refusal, a link that changes parents, a number that is no float) is left to it.
   - It keeps nothing between calls. Samples lie in arrays that Python holds, and are read and
     written through the buffer protocol; every index and length is checked against the buffer.
   - The limited API of CPython 3.11: one build serves every later version with a GIL.

   Layout of a record, as in `history`: a stamp in nanoseconds, x y z, qx qy qz qw; 8 words. */

#define PY_SSIZE_T_CLEAN
#define Py_LIMITED_API 0x030B0000
#include <Python.h>
#include <stdint.h>
#include <string.h>
#include <structmember.h>

#include "_kept.h"

#define WORD 8
#define RECORD (8 * WORD)
#define PARENT_MASK 0xffffffffLL

/* What `tftool.frames.native` expects; a build of another interface is not used. */
#define INTERFACE 4

#if defined(__GNUC__)
#define INLINE static inline __attribute__((always_inline))
#define PREFETCH(place) __builtin_prefetch(place)
#elif defined(_MSC_VER)
#define INLINE static __forceinline
#define PREFETCH(place) (void)(place)
#else
#define INLINE static inline
#define PREFETCH(place) (void)(place)
#endif

/* So many moments are worked on together, number by number: what they take stays in the
   processor's nearest cache, and the compiler turns each loop into vector operations. */
#define BLOCK 128

/* Poses lie as rows, `width` numbers each: first every x, then y z qx qy qz qw. The functions
   of one moment and of many are the same: for one, the width is 1. */
typedef double Rows[7 * BLOCK];
static const double identity[7] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0};

/* Records ---------------------------------------------------------------- */

static inline int64_t word_of(const char *words, Py_ssize_t index) {
    int64_t word;
    memcpy(&word, words + WORD * index, sizeof word);
    return word;
}

static inline int64_t stamp_of(const char *records, Py_ssize_t index) {
    return word_of(records, WORD * index);
}

/* Where a moment is looked for first: by the mean rate of the samples. */
typedef struct {
    Py_ssize_t at;
    double rate; /* Samples a nanosecond. */
} Guess;

/* A guess between the first and the last record; oldest < time < newest, last > 0. */
static inline Guess guess(int64_t oldest, int64_t newest, Py_ssize_t last, int64_t time) {
    Guess made = {0, (double)last / (double)((uint64_t)newest - (uint64_t)oldest)};
    made.at = (Py_ssize_t)((double)((uint64_t)time - (uint64_t)oldest) * made.rate);
    if (made.at > last - 1)
        made.at = last - 1;
    return made;
}

/* The last record at or before a moment, given stamp[0] <= time < stamp[last] and a guess;
   whatever the stamps are, it is less than `last`. Correct the guess once, and search only when
   that fails. */
static inline Py_ssize_t find(const char *records, Py_ssize_t last, int64_t time, Guess guess) {
    Py_ssize_t low = 0, high = last, at = guess.at;
    for (int turn = 0; turn < 2; turn++) {
        const int64_t there = stamp_of(records, at);
        double next = (double)at;
        if (there > time) {
            high = at;
            next -= (double)((uint64_t)there - (uint64_t)time) * guess.rate;
        }
        else if (time < stamp_of(records, at + 1))
            return at;
        else {
            low = at + 1;
            next += (double)((uint64_t)time - (uint64_t)there) * guess.rate;
        }
        if (high - low <= 1)
            break;
        at = next < (double)high ? (next > (double)low ? (Py_ssize_t)next : low) : high - 1;
    }
    while (high - low > 1) {
        const Py_ssize_t middle = low + (high - low) / 2;
        if (stamp_of(records, middle) <= time)
            low = middle;
        else
            high = middle;
    }
    return low < last ? low : last - 1;
}

/* Arcs up to these values of 1 - cos are turned by so many terms, the error below 1e-17. */
#define SHORT_ARC 1e-3
#define SHORT_TERMS 4
#define LONG_ARC 0.1
#define LONG_TERMS 13

/* sin(f θ) / sin θ for u = 1 - cos θ, as a product of terms that are all positive:
   f (1 + b1 (1 + b2 (1 + …))) with b_i = u (i² - f²) / (i (2 i + 1)).
   Eberly, "A Fast and Accurate Algorithm for Computing SLERP", JGT 2011. */
static inline double weight(double f, double u, int terms) {
    double sum = 1.0;
    for (int i = terms; i > 0; i--) {
        const double scale = 1.0 / (i * (2.0 * i + 1.0));
        sum = 1.0 + sum * u * (i * i * scale - f * f * scale);
    }
    return f * sum;
}

/* Arithmetic of poses: twins of `geometry.poses` ------------------------- */

/* The poses on the way from `a` to `b`, to be written to `out`. */
INLINE void interpolate(const double *a, const double *b, const double *share, int n, int width,
                        double *out) {
    double near[BLOCK], sign[BLOCK], keep[BLOCK], take[BLOCK];
    int longer = 0, longest = 0;
    for (int i = 0; i < n; i++) {
        const double *first = a + 3 * width + i, *second = b + 3 * width + i;
        const double cosine = first[0] * second[0] + first[width] * second[width]
            + first[2 * width] * second[2 * width] + first[3 * width] * second[3 * width];
        sign[i] = cosine < 0.0 ? -1.0 : 1.0;
        near[i] = fabs(cosine);
        longer += 1.0 - near[i] > SHORT_ARC;
        longest += 1.0 - near[i] > LONG_ARC;
    }
    if (longer == 0)
        for (int i = 0; i < n; i++) {
            keep[i] = weight(1.0 - share[i], 1.0 - near[i], SHORT_TERMS);
            take[i] = weight(share[i], 1.0 - near[i], SHORT_TERMS);
        }
    else
        for (int i = 0; i < n; i++) {
            keep[i] = weight(1.0 - share[i], 1.0 - near[i], LONG_TERMS);
            take[i] = weight(share[i], 1.0 - near[i], LONG_TERMS);
        }
    for (int i = 0; longest > 0 && i < n; i++)
        if (1.0 - near[i] > LONG_ARC) {
            const double angle = acos(near[i]), sine = sin(angle);
            keep[i] = sin((1.0 - share[i]) * angle) / sine;
            take[i] = sin(share[i] * angle) / sine;
        }
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < n; i++) {
            /* Where a sample is met it is taken as it is: no way leads to infinity. */
            const double here = a[k * width + i];
            const double moved = here + share[i] * (b[k * width + i] - here);
            out[k * width + i] = share[i] == 0.0 ? here : moved;
        }
    for (int k = 3; k < 7; k++)
        for (int i = 0; i < n; i++) {
            const double here = a[k * width + i], there = sign[i] * b[k * width + i];
            const double turned = keep[i] * here + take[i] * there;
            const double straight = here + share[i] * (there - here);
            /* Between equals the rotation stays to the last bit. */
            out[k * width + i] = near[i] < 1.0 ? turned : straight;
        }
}

/* Turn a pose by a rotation. */
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

/* `outer` after `inner`, in place of the latter. */
INLINE void compose(const double *outer, double *inner, int n, int width) {
    for (int i = 0; i < n; i++) {
        const double *o = outer + i;
        turn(o[3 * width], o[4 * width], o[5 * width], o[6 * width], inner + i, width);
        for (int k = 0; k < 3; k++)
            inner[k * width + i] += o[k * width];
    }
}

/* `second` as seen from `first`, in place of the former: turned back, the difference of both. */
INLINE void between(const double *first, double *second, int n, int width) {
    for (int i = 0; i < n; i++) {
        const double *o = first + i;
        for (int k = 0; k < 3; k++)
            second[k * width + i] -= o[k * width];
        turn(-o[3 * width], -o[4 * width], -o[5 * width], o[6 * width], second + i, width);
    }
}

static inline void canonical(double *turn) {
    if (!(turn[3] > 0.5) && leading(turn[0], turn[1], turn[2], turn[3]) < 0.0)
        for (int i = 0; i < 4; i++)
            turn[i] = -turn[i];
}

/* `quaternions.unit`; returns 0 where there is no direction, or none that is plain to see. */
static inline int unit(double *turn) {
    const double square = square_of(turn);
    if (-ROUNDING < square - 1.0 && square - 1.0 < ROUNDING)
        return 1;
    const double scale = 1.0 / sqrt(square);
    for (int i = 0; i < 4; i++)
        turn[i] *= scale;
    return square > 2.0 / DBL_MAX && square < HUGE_VAL;
}

/* What a link keeps, and what a buffer does ------------------------------- */

/* The fields of both kinds of links. Python's classes inherit them, and Python's code reads and
   writes them by their names; see `History` for what they mean. */
typedef struct {
    PyObject_HEAD
    PyObject *records, *origins, *newest, *newest_pair;
    long long newest_stamp, oldest_stamp, limit, start, count, compact_at, origin, parent;
    char is_static, mixed;
} Link;

/* What the methods of a buffer read: `Buffer` inherits it; see there. */
typedef struct {
    PyObject_HEAD
    PyObject *paths, *senders, *listening, *pending;
} Door;

/* Both begin with so many objects. */
#define HELD 4
#define HELD_OF(self) ((PyObject **)((char *)(self) + sizeof(PyObject)))

#define MEMBER(type, name, kind) {#name, kind, offsetof(type, name), 0, NULL}
#define PRIVATE(type, name, kind) {"_" #name, kind, offsetof(type, name), 0, NULL}
static PyMemberDef link_members[] = {
    MEMBER(Link, records, T_OBJECT_EX), MEMBER(Link, origins, T_OBJECT_EX),
    MEMBER(Link, newest_stamp, T_LONGLONG), MEMBER(Link, oldest_stamp, T_LONGLONG),
    MEMBER(Link, limit, T_LONGLONG), MEMBER(Link, start, T_LONGLONG),
    MEMBER(Link, count, T_LONGLONG), MEMBER(Link, origin, T_LONGLONG),
    MEMBER(Link, parent, T_LONGLONG), MEMBER(Link, is_static, T_BOOL),
    MEMBER(Link, mixed, T_BOOL), PRIVATE(Link, newest, T_OBJECT_EX),
    PRIVATE(Link, newest_pair, T_OBJECT_EX), PRIVATE(Link, compact_at, T_LONGLONG),
    {NULL, 0, 0, 0, NULL},
};
static PyMemberDef door_members[] = {
    PRIVATE(Door, paths, T_OBJECT_EX), PRIVATE(Door, senders, T_OBJECT_EX),
    PRIVATE(Door, listening, T_OBJECT_EX), PRIVATE(Door, pending, T_OBJECT_EX),
    {NULL, 0, 0, 0, NULL},
};

static int held_traverse(PyObject *self, visitproc visit, void *arg) {
    Py_VISIT(Py_TYPE(self));
    for (int i = 0; i < HELD; i++)
        Py_VISIT(HELD_OF(self)[i]);
    return 0;
}

static int held_clear(PyObject *self) {
    for (int i = 0; i < HELD; i++)
        Py_CLEAR(HELD_OF(self)[i]);
    return 0;
}

static void held_dealloc(PyObject *self) {
    PyTypeObject *type = Py_TYPE(self);
    PyObject_GC_UnTrack(self);
    held_clear(self);
    ((freefunc)PyType_GetSlot(type, Py_tp_free))(self);
    Py_DECREF(type);
}

/* What answers are made of and read by; the state of the module, which Python never unloads. */
typedef struct {
    PyTypeObject *fields, *stamped, *transform, *vector, *quaternion;
    PyObject *empty; /* "". */
} Types;

/* That many floats of a tuple. Returns whether that is what it is; never sets an error. */
static int read_floats(PyObject *tuple, double *numbers, Py_ssize_t size) {
    if (!PyTuple_Check(tuple) || PyTuple_Size(tuple) != size)
        return 0;
    for (Py_ssize_t i = 0; i < size; i++) {
        PyObject *number = PyTuple_GetItem(tuple, i);
        if (!PyFloat_CheckExact(number))
            return 0;
        numbers[i] = PyFloat_AsDouble(number);
    }
    return 1;
}

/* A moment as 64 bits. Returns whether it is an `int` that fits; never sets an error. */
static int read_stamp(PyObject *stamp, int64_t *value) {
    int overflow = 0;
    if (!PyLong_CheckExact(stamp))
        return 0;
    *value = PyLong_AsLongLongAndOverflow(stamp, &overflow);
    return !overflow;
}

/* Whether a moving link is one the kernel reads: its records in `view`, to be released. */
static int read_records(const Link *link, int flags, Py_buffer *view) {
    if (link->records == NULL || link->start < 0 || link->count <= link->start)
        return 0;
    if (PyObject_GetBuffer(link->records, view, flags) < 0) {
        PyErr_Clear();
        return 0;
    }
    if (link->count <= view->len / RECORD)
        return 1;
    PyBuffer_Release(view);
    return 0;
}

/* One link made ready for moments: records in order, or a pose that never changes. */
typedef struct {
    Py_buffer view, origins_view;
    const char *records, *origins; /* NULL: `fixed`; NULL: they are all alike. */
    Py_ssize_t last, here;         /* `here`: where the last moment was found, or may be. */
    int64_t oldest, newest;
    double fixed[7];
} Edge;

/* Fetch both neighbours of each moment, and how far it lies between them. Where a link has no
   data for a moment, `valid` becomes 0 and what is fetched is of no use. */
INLINE void fetch(Edge *edge, const int64_t *times, int n, int width, double *first,
                  double *second, double *share, unsigned char *valid) {
    const char *records = edge->records;
    const Py_ssize_t last = edge->last;
    Py_ssize_t here = edge->here;
    for (int i = 0; i < n; i++) {
        const int64_t time = times[i];
        if (!(edge->oldest < time && time < edge->newest)) {
            /* Of equal stamps at the newest end it is the last, at the oldest end the first. */
            here = time == edge->oldest && time != edge->newest ? 0 : last;
            valid[i] &= time == edge->oldest || time == edge->newest;
        }
        else if (here == last || !(stamp_of(records, here) <= time && time < stamp_of(records, here + 1))) {
            if (here + 2 <= last && stamp_of(records, here + 1) <= time
                && time < stamp_of(records, here + 2))
                here++;
            else
                here = find(records, last, time, guess(edge->oldest, edge->newest, last, time));
        }
        const Py_ssize_t next = here < last ? here + 1 : last;
        const int64_t before = stamp_of(records, here);
        const uint64_t length = (uint64_t)stamp_of(records, next) - (uint64_t)before;
        const int parts = edge->origins != NULL
            && ((word_of(edge->origins, here) ^ word_of(edge->origins, next)) & PARENT_MASK);
        share[i] = parts || !length ? 0.0 : (double)((uint64_t)time - (uint64_t)before) / (double)length;
        for (int k = 0; k < 7; k++) {
            memcpy(&first[k * width + i], records + RECORD * here + WORD + WORD * k, WORD);
            memcpy(&second[k * width + i], records + RECORD * next + WORD + WORD * k, WORD);
        }
    }
    edge->here = here;
}

/* The same pose for each moment. */
INLINE void fill(const double *pose, int n, int width, double *out) {
    for (int k = 0; k < 7; k++)
        for (int i = 0; i < n; i++)
            out[k * width + i] = pose[k];
}

/* The poses of several links one after the other, lowest first, for each moment: `path.chain`.
   Where `pose` has begun already, these go on from it. */
INLINE void climb(Edge *edges, Py_ssize_t count, const int64_t *times, int n, int width, double *pose,
                  int begun, unsigned char *valid) {
    Rows first, second, step;
    double share[BLOCK];
    if (!begun && !count)
        fill(identity, n, width, pose);
    for (Py_ssize_t e = 0; e < count; e++) {
        double *out = begun ? step : pose;
        if (edges[e].records != NULL) {
            fetch(&edges[e], times, n, width, first, second, share, valid);
            interpolate(first, second, share, n, width, out);
        }
        else
            fill(edges[e].fixed, n, width, out);
        if (begun)
            compose(step, pose, n, width);
        begun = 1;
    }
}

/* Looking up -------------------------------------------------------------- */

/* So many links are made ready before the first is read: meanwhile memory brings their samples. */
#define AHEAD 8

/* Make a link ready for a moment. Returns whether it is plain; what `records` are of is then to
   be released. Never sets an error. */
static int prepare(const Link *link, int64_t time, Edge *edge) {
    edge->records = edge->origins = NULL;
    if (link->is_static)
        return link->newest != NULL && read_floats(link->newest, edge->fixed, 7);
    if (link->mixed || !read_records(link, PyBUF_SIMPLE, &edge->view))
        return 0;
    edge->records = (const char *)edge->view.buf + RECORD * link->start;
    edge->here = edge->last = (Py_ssize_t)(link->count - link->start) - 1;
    edge->oldest = stamp_of(edge->records, 0);
    edge->newest = link->newest_stamp;
    if (edge->last > 0 && edge->oldest < time && time < edge->newest) {
        edge->here = guess(edge->oldest, edge->newest, edge->last, time).at;
        for (int line = 0; line < 3; line++)
            PREFETCH(edge->records + RECORD * edge->here + RECORD * line - (line == 2));
    }
    return 1;
}

/* The poses of several links one after the other, lowest first: `path.chain`. Returns 0 if one
   is not plain or has none; never sets an error. */
static int chain(PyObject *links, PyTypeObject *fields, int64_t time, double *pose) {
    const Py_ssize_t count = PyTuple_Size(links);
    PyTypeObject *known = fields;
    Edge edges[AHEAD];
    unsigned char valid = 1;
    Py_ssize_t done = 0;
    do {
        int ready = 0;
        for (; valid && ready < AHEAD && done + ready < count; ready += valid) {
            PyObject *link = PyTuple_GetItem(links, done + ready);
            valid = Py_TYPE(link) == known || PyObject_TypeCheck(link, fields);
            if (valid) {
                known = Py_TYPE(link);
                valid = (unsigned char)prepare((const Link *)link, time, &edges[ready]);
            }
        }
        if (valid)
            climb(edges, ready, &time, 1, 1, pose, done > 0, &valid);
        for (int i = 0; i < ready; i++)
            if (edges[i].records != NULL)
                PyBuffer_Release(&edges[i].view);
        done += ready;
    } while (valid && done < count);
    return valid;
}

/* Whether two plain strings are equal; one that is none is equal to nothing. */
static int same_text(PyObject *known, PyObject *given) {
    return known == given
        || (PyUnicode_CheckExact(known) && PyUnicode_Check(given)
            && PyUnicode_Compare(known, given) == 0);
}

/* The path between two frames that is kept: NULL if there is none, or it is not plain. Never
   sets an error: plain strings are looked for, which runs no code of others. */
static PyObject *path_of(const Door *door, PyObject *target, PyObject *source) {
    PyObject *found = door->paths;
    if (found == NULL || !PyDict_Check(found) || !PyUnicode_CheckExact(target)
        || !PyUnicode_CheckExact(source))
        return NULL;
    found = PyDict_GetItemWithError(found, target);
    if (found != NULL && PyDict_Check(found))
        found = PyDict_GetItemWithError(found, source);
    if (found == NULL || !PyTuple_Check(found) || PyTuple_Size(found) != 3)
        return NULL;
    for (Py_ssize_t i = 0; i < 3; i++)
        if (!PyTuple_Check(PyTuple_GetItem(found, i)))
            return NULL;
    return found;
}

/* The newest moment for which every moving link has data: `Path.latest`. With `covered`, whether
   all of them have data at that moment, or at `*moment` if it is not 0: `Path.covers`. Returns
   whether the links are plain; never sets an error. */
static int latest(PyObject *path, PyTypeObject *fields, int64_t *moment, int *covered) {
    PyObject *moving = PyTuple_GetItem(path, 2);
    const Py_ssize_t count = PyTuple_Size(moving);
    int64_t oldest = 0;
    for (Py_ssize_t i = 0; i < count; i++) {
        PyObject *link = PyTuple_GetItem(moving, i);
        if (!PyObject_TypeCheck(link, fields))
            return 0;
        const int64_t stamp = ((Link *)link)->newest_stamp;
        if (stamp != 0 && (stamp < oldest || oldest == 0))
            oldest = stamp;
    }
    if (*moment == 0)
        *moment = oldest;
    for (Py_ssize_t i = 0; covered != NULL && i < count; i++) {
        const Link *link = (const Link *)PyTuple_GetItem(moving, i);
        *covered &= *moment == link->newest_stamp || *moment == 0
            || (link->oldest_stamp <= *moment && *moment < link->newest_stamp);
    }
    return 1;
}

/* The pose of source in target by a path that is kept, of tf2's sign, and the moment it holds
   for in place of 0: `Path.solve`. Returns 0 if that is not plain; never sets an error. */
static int solve_path(const Door *door, const Types *types, PyObject *target, PyObject *source,
                      int64_t *time, double *pose) {
    PyObject *path = path_of(door, target, source);
    double other[7];
    if (path == NULL || (*time == 0 && !latest(path, types->fields, time, NULL))
        || !chain(PyTuple_GetItem(path, 0), types->fields, *time, pose))
        return 0;
    PyObject *down = PyTuple_GetItem(path, 1);
    if (PyTuple_Size(down) > 0) {
        if (!chain(down, types->fields, *time, other))
            return 0;
        between(other, pose, 1, 1);
    }
    canonical(pose + 3);
    return pose[6] == pose[6];
}

/* Put new references into a new tuple; all of them are given up on failure. */
static PyObject *tuple_of(PyTypeObject *type, PyObject **parts, Py_ssize_t size) {
    int whole = 1;
    for (Py_ssize_t i = 0; i < size; i++)
        whole &= parts[i] != NULL;
    PyObject *made = whole ? PyType_GenericAlloc(type, size) : NULL;
    for (Py_ssize_t i = 0; i < size; i++)
        if (made == NULL)
            Py_XDECREF(parts[i]);
        else
            PyTuple_SetItem(made, i, parts[i]);
    return made;
}

/* A new tuple of so many floats, four at most; NULL with an error set on failure. */
static PyObject *floats(PyTypeObject *type, const double *numbers, Py_ssize_t size) {
    PyObject *parts[4];
    for (Py_ssize_t i = 0; i < size; i++)
        parts[i] = PyFloat_FromDouble(numbers[i]);
    return tuple_of(type, parts, size);
}

/* A TransformStamped; NULL with an error set on failure. */
static PyObject *answer(const Types *types, int64_t stamp, PyObject *target, PyObject *source,
                        const double *pose) {
    PyObject *numbers[2] = {floats(types->vector, pose, 3), floats(types->quaternion, pose + 3, 4)};
    PyObject *parts[4] = {PyLong_FromLongLong(stamp), Py_NewRef(target), Py_NewRef(source),
                          tuple_of(types->transform, numbers, 2)};
    return tuple_of(types->stamped, parts, 4);
}

/* What `Buffer` does in plain Python, as it was asked. */
static PyObject *plainly(PyObject *self, const char *name, PyObject *const *args, Py_ssize_t count,
                         PyObject *names) {
    const Py_ssize_t named = names == NULL ? 0 : PyTuple_Size(names);
    PyObject *call = PyObject_GetAttrString(self, name), *result = NULL;
    PyObject *given = PyTuple_New(count), *by_name = PyDict_New();
    int whole = call != NULL && given != NULL && by_name != NULL;
    for (Py_ssize_t i = 0; whole && i < count; i++)
        PyTuple_SetItem(given, i, Py_NewRef(args[i]));
    for (Py_ssize_t i = 0; whole && i < named; i++)
        whole = PyDict_SetItem(by_name, PyTuple_GetItem(names, i), args[count + i]) == 0;
    if (whole)
        result = PyObject_Call(call, given, by_name);
    Py_XDECREF(call);
    Py_XDECREF(given);
    Py_XDECREF(by_name);
    return result;
}

#define METHOD(name)                                                                              \
    static PyObject *name(PyObject *self, PyTypeObject *door, PyObject *const *args,              \
                          Py_ssize_t count, PyObject *names)
#define PLAINLY(name) plainly(self, "_plain_" #name, args, count, names)

METHOD(lookup_transform) {
    const Types *types = PyType_GetModuleState(door);
    int64_t time = 0;
    double pose[7];
    if (names == NULL && (count == 2 || (count == 3 && read_stamp(args[2], &time)))
        && solve_path((const Door *)self, types, args[0], args[1], &time, pose))
        return answer(types, time, args[0], args[1], pose);
    return PLAINLY(lookup_transform);
}

/* The same where target and source may be one frame, whose name another path has shown good. */
static int solve_leg(const Door *door, const Types *types, PyObject *target, PyObject *source,
                     int64_t *time, double *pose) {
    fill(identity, 1, 1, pose);
    return (*time != 0 && same_text(target, source))
        || solve_path(door, types, target, source, time, pose);
}

METHOD(lookup_transform_full) {
    const Types *types = PyType_GetModuleState(door);
    int64_t here, there;
    double inner[7], outer[7];
    if (names == NULL && count == 5 && read_stamp(args[1], &here) && read_stamp(args[3], &there)
        && !same_text(args[0], args[2])
        && solve_leg((const Door *)self, types, args[4], args[2], &there, inner)
        && solve_leg((const Door *)self, types, args[0], args[4], &here, outer)) {
        compose(outer, inner, 1, 1);
        if (unit(inner + 3)) {
            canonical(inner + 3);
            return answer(types, here, args[0], args[2], inner);
        }
    }
    return PLAINLY(lookup_transform_full);
}

METHOD(can_transform) {
    const Types *types = PyType_GetModuleState(door);
    int64_t time = 0;
    int covered = 1;
    if (names == NULL && (count == 2 || (count == 3 && read_stamp(args[2], &time)))) {
        PyObject *path = path_of((const Door *)self, args[0], args[1]);
        if (path != NULL && latest(path, types->fields, &time, &covered) && covered)
            Py_RETURN_TRUE;
    }
    return PLAINLY(can_transform);
}

/* Inserting --------------------------------------------------------------- */

/* So many pruned records are left where they are, at least and as a part of all (a shift to the
   right): as in `history`. */
#define LEAST_SLACK 32
#define SLACK 3

/* Room for samples to come is as much again as there is, at least so much, and so much at most or
   that part of all: each time it is made, everything may have to be copied. */
#define LEAST_ROOM 8
#define MOST_ROOM 128
#define ROOM 4

#define LARGER(a, b) ((a) > (b) ? (a) : (b))
#define SMALLER(a, b) ((a) < (b) ? (a) : (b))

/* Take words out of a link's records, that are held. Returns whether it let go of them, which none
   does that a batch reads; never sets an error. */
static int cut(const Link *link, PyObject *records, Py_ssize_t from, Py_ssize_t to) {
    const int64_t start = link->start, count = link->count;
    PyObject *first = PyLong_FromSsize_t(from), *last = PyLong_FromSsize_t(to);
    PyObject *words = first == NULL || last == NULL ? NULL : PySlice_New(first, last, NULL);
    /* To make the slice may run the collector, and that code which changes the link. */
    const int same = link->records == records && link->start == start && link->count == count;
    const int done = words != NULL && same && PyObject_DelItem(records, words) == 0;
    Py_XDECREF(first);
    Py_XDECREF(last);
    Py_XDECREF(words);
    if (!done)
        PyErr_Clear();
    return done;
}

/* Have so many records of zeros more at the end of an array. Returns whether it grew, which none
   does that a batch reads; never sets an error. */
static int grow(PyObject *records, Py_ssize_t more) {
    PyObject *zeros = PyObject_CallFunction((PyObject *)&PyBytes_Type, "n", RECORD * more);
    PyObject *none = zeros == NULL ? NULL : PyObject_CallMethod(records, "frombytes", "O", zeros);
    Py_XDECREF(zeros);
    Py_XDECREF(none);
    if (none == NULL)
        PyErr_Clear();
    return none != NULL;
}

/* Have room for a sample in a link's records, which are held, and which no batch reads if the
   sample is not the newest. Returns whether it could be had; never sets an error. */
static int make_room(Link *link, PyObject *records, int64_t stamp) {
    const Py_ssize_t room = PyObject_Size(records) / WORD;
    if (link->start < 0 || link->count <= link->start || link->count > room) {
        PyErr_Clear();
        return 0;
    }
    if (link->start >= link->compact_at) {
        /* What is pruned makes room for as many. */
        const Py_ssize_t start = (Py_ssize_t)link->start, count = (Py_ssize_t)link->count - start;
        if (!cut(link, records, 0, WORD * start))
            return 0;
        link->start = 0;
        link->count = count;
        link->compact_at = LARGER(count >> SLACK, LEAST_SLACK);
        if (!grow(records, start))
            return 0;
    }
    else if (stamp <= link->newest_stamp) {
        /* One record more or one less: either is done where nobody reads them. One in front takes
           no room behind, and one that is there already takes none in the end. */
        if (link->count + (stamp >= link->oldest_stamp) < room)
            return cut(link, records, WORD * room - WORD, WORD * room);
        return grow(records, 1);
    }
    else if (link->count == room)
        return grow(records, LARGER(LARGER(SMALLER(room, MOST_ROOM), LEAST_ROOM), room >> ROOM));
    return 1;
}

/* Put a sample into a link: `History.insert` where no other one has its stamp,
   and all are of the same origin. Returns whether it was done; never sets an error. */
static int put(Link *link, int64_t stamp, int64_t origin, double *pose) {
    Py_buffer view;
    const double square = square_of(pose + 3);
    if (!(1.0 - ROUNDING < square && square < 1.0 + ROUNDING && pose[0] + pose[1] + pose[2] < HUGE_VAL))
        return 0;
    if (link->is_static || link->mixed || link->origins != Py_None || link->origin != origin
        || link->limit < 0 || link->records == NULL)
        return 0;
    /* Making room calls Python, whose collector may run code that gives the link other records. */
    PyObject *held = Py_NewRef(link->records);
    const int has_room = make_room(link, held, stamp);
    Py_DECREF(held);
    if (!has_room || !read_records(link, PyBUF_WRITABLE, &view))
        return 0;
    char *records = view.buf;
    const int64_t newest = link->newest_stamp;
    const uint64_t limit = (uint64_t)link->limit;
    Py_ssize_t start = (Py_ssize_t)link->start, count = (Py_ssize_t)link->count, place = count;
    int64_t oldest = link->oldest_stamp;
    while ((uint64_t)newest - (uint64_t)oldest > limit && start + 1 < count)
        oldest = stamp_of(records, ++start);
    int fits = 1;
    if (stamp < oldest)
        place = start - 1;
    else if (stamp <= newest) {
        const Py_ssize_t last = count - 1 - start;
        fits &= stamp < newest && last > 0;
        if (fits)
            place = start + 1
                + find(records + RECORD * start, last, stamp, guess(oldest, newest, last, stamp));
        fits &= stamp_of(records, place - 1) != stamp;
    }
    fits &= stamp > newest || (uint64_t)newest - (uint64_t)stamp <= limit;
    fits &= place >= 0 && (place < start || count < view.len / RECORD);
    if (fits) {
        char *record = records + RECORD * place;
        canonical(pose + 3);
        if (place < start) {
            oldest = stamp;
            start = place;
        }
        else
            memmove(record + RECORD, record, RECORD * (count++ - place));
        memcpy(record, &stamp, WORD);
        memcpy(record + WORD, pose, 7 * WORD);
        link->start = start;
        link->count = count;
        link->oldest_stamp = oldest;
        link->newest_stamp = stamp > newest ? stamp : newest;
    }
    PyBuffer_Release(&view);
    if (!fits)
        return 0;
    /* Last of all: what is let go of here may run code of others. */
    PyObject *pair = link->newest_pair, *before = link->newest;
    link->newest_pair = Py_NewRef(Py_None);
    link->newest = Py_NewRef(Py_None);
    Py_XDECREF(before);
    Py_XDECREF(pair);
    return 1;
}

/* Remember a sample of plain parts, of a link that is known by its child. Returns whether it
   was done; never sets an error. */
static int insert(const Door *door, const Types *types, PyObject *sample, PyObject *authority) {
    int64_t stamp, origin;
    double pose[7];
    if (Py_TYPE(sample) != types->stamped || PyTuple_Size(sample) != 4 || door->senders == NULL
        || !PyDict_Check(door->senders))
        return 0;
    PyObject *parent = PyTuple_GetItem(sample, 1), *child = PyTuple_GetItem(sample, 2);
    PyObject *transform = PyTuple_GetItem(sample, 3);
    if (!PyUnicode_CheckExact(child) || !PyUnicode_CheckExact(parent)
        || !PyUnicode_CheckExact(authority) || Py_TYPE(transform) != types->transform
        || PyTuple_Size(transform) != 2 || !read_stamp(PyTuple_GetItem(sample, 0), &stamp)
        || !read_floats(PyTuple_GetItem(transform, 0), pose, 3)
        || !read_floats(PyTuple_GetItem(transform, 1), pose + 3, 4))
        return 0;
    PyObject *sender = PyDict_GetItemWithError(door->senders, child);
    if (sender == NULL || !PyTuple_Check(sender) || PyTuple_Size(sender) != 4)
        return 0;
    PyObject *link = PyTuple_GetItem(sender, 3);
    return same_text(PyTuple_GetItem(sender, 0), parent)
        && same_text(PyTuple_GetItem(sender, 1), authority)
        && read_stamp(PyTuple_GetItem(sender, 2), &origin)
        && PyObject_TypeCheck(link, types->fields) && put((Link *)link, stamp, origin, pose);
}

METHOD(set_transform) {
    const Types *types = PyType_GetModuleState(door);
    const Door *buffer = (const Door *)self;
    PyObject *authority = count == 2 ? args[1] : types->empty;
    if (names != NULL || count < 1 || count > 2 || buffer->listening == NULL
        || !PyTuple_Check(buffer->listening) || buffer->pending == NULL
        || !PyDict_Check(buffer->pending) || !insert(buffer, types, args[0], authority))
        return PLAINLY(set_transform);
    if (PyTuple_Size(buffer->listening) > 0 || PyDict_Size(buffer->pending) > 0) {
        PyObject *done = PyObject_CallMethod(self, "_tell_of", "OO", args[0], authority);
        if (done == NULL)
            return NULL;
        Py_DECREF(done);
    }
    Py_RETURN_TRUE;
}

#define CALL METH_METHOD | METH_FASTCALL | METH_KEYWORDS
#define ENTRY(name, doc) {#name, (PyCFunction)(void (*)(void))name, CALL, #name doc}
static PyMethodDef door_methods[] = {
    ENTRY(set_transform, "($self, transform, authority='')\n--\n\n"
        "Remember a sample of a link that moves, from whom `authority` says.\n\n"
        "Returns whether it was taken. If not, the log was told why, and nothing is lost."),
    ENTRY(lookup_transform, "($self, target_frame, source_frame, time=0)\n--\n\n"
        "The pose of source in target: moves points given in source into target.\n\n"
        "`time` is the moment; 0 is the newest one for which the whole chain has data. The stamp\n"
        "of the answer is the moment it holds for, or 0 if it holds at all times.\n\n"
        "Raises TransformException where there is no answer, TypeError for a time that is no\n"
        "whole number."),
    ENTRY(lookup_transform_full, "($self, target_frame, target_time, source_frame, source_time, "
        "fixed_frame)\n--\n\n"
        "Where source was at its time, in target as target is at its own time.\n\n"
        "Both are looked up against `fixed_frame`, which is taken not to move in between.\n\n"
        "Raises TransformException as `lookup_transform` does; frames are always checked."),
    ENTRY(can_transform, "($self, target_frame, source_frame, time=0)\n--\n\n"
        "Whether `lookup_transform` would answer; it never raises for a name or a time."),
    {NULL, NULL, 0, NULL},
};

#define HOLDER(name, what, ...)                                                                   \
    static PyType_Slot name##_slots[] = {                                                         \
        {Py_tp_doc, what}, {Py_tp_members, name##_members}, {Py_tp_traverse, held_traverse},      \
        {Py_tp_clear, held_clear}, {Py_tp_dealloc, held_dealloc}, __VA_ARGS__, {0, NULL},         \
    }
HOLDER(link, "The fields of a link, laid out so that the kernel can read them.", {0, NULL});
HOLDER(door, "The methods of a buffer that are called most.", {Py_tp_methods, door_methods});

#define FLAGS Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_HAVE_GC
static PyType_Spec link_spec = {"tftool.frames._kernel.Fields", sizeof(Link), 0, FLAGS, link_slots};
static PyType_Spec door_spec = {"tftool.frames._kernel.Door", sizeof(Door), 0, FLAGS, door_slots};

/* A batch ---------------------------------------------------------------- */

/* The links from source upward, and from target upward. */
typedef struct {
    Edge *up, *down;
    Py_ssize_t ups, downs;
} Way;

/* One block: poses of source in target, or NaN where `valid` becomes 0. */
INLINE void solve_block(const Way *way, const int64_t *times, int n, double *places, double *turns,
                        unsigned char *valid) {
    Rows pose, other;
    for (int i = 0; i < n; i++)
        valid[i] = times[i] != 0;
    climb(way->up, way->ups, times, n, BLOCK, pose, 0, valid);
    climb(way->down, way->downs, times, n, BLOCK, other, 0, valid);
    if (way->downs)
        between(other, pose, n, BLOCK);
    for (int i = 0; i < n; i++) {
        const double *turn = pose + 3 * BLOCK + i, known = valid[i] ? 1.0 : NAN;
        const double sign = leading(turn[0], turn[BLOCK], turn[2 * BLOCK], turn[3 * BLOCK]) < 0.0 ? -known : known;
        for (int k = 0; k < 3; k++)
            places[3 * i + k] = pose[k * BLOCK + i] * known;
        for (int k = 0; k < 4; k++)
            turns[4 * i + k] = turn[k * BLOCK] * sign;
    }
}

typedef void Solve(const Way *, const int64_t *, int, double *, double *, unsigned char *);

static void solve_plain(const Way *way, const int64_t *times, int n, double *places, double *turns,
                        unsigned char *valid) {
    solve_block(way, times, n, places, turns, valid);
}

#if defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__))
/* The same, where the processor works on four numbers at once. */
__attribute__((target("avx2"))) static void
solve_avx2(const Way *way, const int64_t *times, int n, double *places, double *turns, unsigned char *valid) {
    solve_block(way, times, n, places, turns, valid);
}
#define SOLVE (__builtin_cpu_supports("avx2") ? solve_avx2 : solve_plain)
#else
#define SOLVE solve_plain
#endif

static void release_edges(Edge *edges, Py_ssize_t count) {
    for (Py_ssize_t i = 0; edges != NULL && i < count; i++) {
        PyBuffer_Release(&edges[i].view);
        PyBuffer_Release(&edges[i].origins_view);
    }
    PyMem_Free(edges);
}

/* Make the links of a batch ready: each a sample of seven floats, or records and the origins of
   each (None: all alike). NULL with an error set if one is neither. */
static Edge *read_edges(PyObject *links) {
    const Py_ssize_t count = PyTuple_Size(links);
    Edge *edges = PyMem_Calloc(count ? count : 1, sizeof(Edge));
    if (edges == NULL)
        return (Edge *)PyErr_NoMemory();
    for (Py_ssize_t i = 0; i < count; i++) {
        PyObject *link = PyTuple_GetItem(links, i);
        Edge *edge = &edges[i];
        if (read_floats(link, edge->fixed, 7))
            continue;
        if (!PyTuple_Check(link) || PyTuple_Size(link) != 2) {
            PyErr_SetString(PyExc_TypeError, "a link is a pose of seven floats, or records and origins");
            goto failed;
        }
        PyObject *origins = PyTuple_GetItem(link, 1);
        if (PyObject_GetBuffer(PyTuple_GetItem(link, 0), &edge->view, PyBUF_SIMPLE) < 0
            || (origins != Py_None && PyObject_GetBuffer(origins, &edge->origins_view, PyBUF_SIMPLE) < 0))
            goto failed;
        edge->records = edge->view.buf;
        edge->origins = edge->origins_view.buf;
        edge->last = edge->view.len / RECORD - 1;
        if (edge->last < 0 || edge->view.len % RECORD
            || (edge->origins != NULL && edge->origins_view.len / WORD <= edge->last)) {
            PyErr_SetString(PyExc_ValueError, "records are rows of 64 bytes, one or more, an origin for each");
            goto failed;
        }
        edge->oldest = stamp_of(edge->records, 0);
        edge->newest = stamp_of(edge->records, edge->last);
    }
    return edges;
failed:
    release_edges(edges, count);
    return NULL;
}

PyDoc_STRVAR(solve_doc, "solve(up, down, times, translations, rotations, valid)\n--\n\n"
"Write the poses of a path at many moments, NaN where a link has no data. Returns how many rows\n"
"have none. Other threads of Python run meanwhile; the records must not change.");

static PyObject *solve(PyObject *Py_UNUSED(module), PyObject *args) {
    static const Py_ssize_t sizes[4] = {8, 24, 32, 1};
    Py_buffer views[4];
    PyObject *links[2], *result = NULL;
    Way way = {NULL, NULL, 0, 0};
    if (!PyArg_ParseTuple(args, "O!O!y*w*w*w*:solve", &PyTuple_Type, &links[0], &PyTuple_Type, &links[1],
                          &views[0], &views[1], &views[2], &views[3]))
        return NULL;
    way.ups = PyTuple_Size(links[0]);
    way.downs = PyTuple_Size(links[1]);
    const Py_ssize_t rows = views[0].len / WORD;
    for (int i = 0; i < 4; i++)
        if (views[i].len != rows * sizes[i] || (sizes[i] > 1 && (uintptr_t)views[i].buf % WORD)) {
            PyErr_SetString(PyExc_ValueError, "moments, translations, rotations and valid are "
                "aligned rows of 8, 24, 32 and 1 bytes, of each equally many");
            goto done;
        }
    if ((way.up = read_edges(links[0])) == NULL || (way.down = read_edges(links[1])) == NULL)
        goto done;
    Solve *const solve_rows = SOLVE;
    const int64_t *times = views[0].buf;
    double *places = views[1].buf, *turns = views[2].buf;
    unsigned char *valid = views[3].buf;
    Py_ssize_t missing = 0;
    Py_BEGIN_ALLOW_THREADS
    for (Py_ssize_t row = 0; row < rows; row += BLOCK) {
        const int n = rows - row < BLOCK ? (int)(rows - row) : BLOCK;
        solve_rows(&way, times + row, n, places + 3 * row, turns + 4 * row, valid + row);
        for (int i = 0; i < n; i++)
            missing += !valid[row + i];
    }
    Py_END_ALLOW_THREADS
    result = PyLong_FromSsize_t(missing);
done:
    release_edges(way.up, way.ups);
    release_edges(way.down, way.downs);
    for (int i = 0; i < 4; i++)
        PyBuffer_Release(&views[i]);
    return result;
}

/* The module ------------------------------------------------------------- */

static PyMethodDef methods[] = {
    {"solve", solve, METH_VARARGS, solve_doc}, {NULL, NULL, 0, NULL},
};

/* A class of a module of ours that is a kind of tuple; NULL with an error set if not. */
static PyTypeObject *tuple_type(const char *module, const char *name) {
    PyObject *home = PyImport_ImportModule(module);
    PyObject *type = home == NULL ? NULL : PyObject_GetAttrString(home, name);
    Py_XDECREF(home);
    if (type != NULL
        && !(PyType_Check(type) && PyType_IsSubtype((PyTypeObject *)type, &PyTuple_Type))) {
        PyErr_Format(PyExc_TypeError, "%s.%s is no tuple", module, name);
        Py_CLEAR(type);
    }
    return (PyTypeObject *)type;
}

static int module_exec(PyObject *module) {
    Types *types = PyModule_GetState(module);
    PyObject *door = PyType_FromModuleAndSpec(module, &door_spec, NULL);
    const int added = door == NULL ? -1 : PyModule_AddType(module, (PyTypeObject *)door);
    Py_XDECREF(door);
    types->fields = (PyTypeObject *)PyType_FromSpec(&link_spec);
    if (added < 0 || types->fields == NULL || PyModule_AddType(module, types->fields) < 0
        || PyModule_AddIntConstant(module, "INTERFACE", INTERFACE) < 0
        || (types->empty = PyUnicode_InternFromString("")) == NULL
        || (types->vector = tuple_type("tftool.geometry.rigid", "Vector3")) == NULL
        || (types->quaternion = tuple_type("tftool.geometry.rigid", "Quaternion")) == NULL
        || (types->transform = tuple_type("tftool.geometry.rigid", "Transform")) == NULL
        || (types->stamped = tuple_type("tftool.frames.sample", "TransformStamped")) == NULL)
        return -1;
    return 0;
}

static PyModuleDef_Slot module_slots[] = {{Py_mod_exec, module_exec}, {0, NULL}};

static PyModuleDef definition = {
    PyModuleDef_HEAD_INIT, "tftool.frames._kernel", "The native kernel; see `_kernel.pyi`.",
    sizeof(Types), methods, module_slots, NULL, NULL, NULL,
};

PyMODINIT_FUNC
PyInit__kernel(void) {
    return PyModuleDef_Init(&definition);
}
