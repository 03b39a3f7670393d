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
#define EXACT (1ULL << 53) /* Whole numbers below this are exact as doubles. */

/* What `tftool.frames.native` expects; a build of another interface is not used. */
#define INTERFACE 3

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

typedef struct { double n[7]; } Pose; /* x y z qx qy qz qw */
static const Pose identity = {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}};

/* Records ---------------------------------------------------------------- */

static inline int64_t word_of(const char *words, Py_ssize_t index) {
    int64_t word;
    memcpy(&word, words + WORD * index, sizeof word);
    return word;
}

static inline int64_t stamp_of(const char *records, Py_ssize_t index) {
    return word_of(records, WORD * index);
}

static inline void pose_of(const char *records, Py_ssize_t index, Pose *pose) {
    memcpy(pose->n, records + RECORD * index + WORD, sizeof pose->n);
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

static inline void interpolate(const Pose *first, const Pose *second, double share, Pose *out) {
    const double *a = first->n, *b = second->n;
    double cosine = a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6];
    double take = 1.0;
    if (share == 0.0) {
        *out = *first;
        return;
    }
    if (cosine < 0.0) {
        cosine = -cosine;
        take = -1.0;
    }
    for (int i = 0; i < 3; i++)
        out->n[i] = a[i] + share * (b[i] - a[i]);
    if (cosine < 1.0) {
        double keep;
        if (1.0 - cosine < SHORT_ARC) {
            keep = weight(1.0 - share, 1.0 - cosine, SHORT_TERMS);
            take *= weight(share, 1.0 - cosine, SHORT_TERMS);
        }
        else {
            const double angle = acos(cosine), sine = sin(angle);
            keep = sin((1.0 - share) * angle) / sine;
            take *= sin(share * angle) / sine;
        }
        for (int i = 3; i < 7; i++)
            out->n[i] = keep * a[i] + take * b[i];
    }
    else
        for (int i = 3; i < 7; i++)
            out->n[i] = a[i] + share * (take * b[i] - a[i]);
}

static inline void compose(const Pose *outer, Pose *inner) {
    const double *o = outer->n;
    const double ax = o[3], ay = o[4], az = o[5], aw = o[6];
    const double x = inner->n[0], y = inner->n[1], z = inner->n[2];
    const double bx = inner->n[3], by = inner->n[4], bz = inner->n[5], bw = inner->n[6];
    const double cx = 2.0 * (ay * z - az * y);
    const double cy = 2.0 * (az * x - ax * z);
    const double cz = 2.0 * (ax * y - ay * x);
    inner->n[0] = x + aw * cx + ay * cz - az * cy + o[0];
    inner->n[1] = y + aw * cy + az * cx - ax * cz + o[1];
    inner->n[2] = z + aw * cz + ax * cy - ay * cx + o[2];
    inner->n[3] = aw * bx + ax * bw + ay * bz - az * by;
    inner->n[4] = aw * by + ay * bw + az * bx - ax * bz;
    inner->n[5] = aw * bz + az * bw + ax * by - ay * bx;
    inner->n[6] = aw * bw - ax * bx - ay * by - az * bz;
}

static inline void between(const Pose *first, Pose *second) {
    const double *o = first->n;
    const double ax = o[3], ay = o[4], az = o[5], aw = o[6];
    const double x = second->n[0] - o[0], y = second->n[1] - o[1], z = second->n[2] - o[2];
    const double bx = second->n[3], by = second->n[4], bz = second->n[5], bw = second->n[6];
    const double cx = 2.0 * (az * y - ay * z);
    const double cy = 2.0 * (ax * z - az * x);
    const double cz = 2.0 * (ay * x - ax * y);
    second->n[0] = x + aw * cx - ay * cz + az * cy;
    second->n[1] = y + aw * cy - az * cx + ax * cz;
    second->n[2] = z + aw * cz - ax * cy + ay * cx;
    second->n[3] = aw * bx - ax * bw - ay * bz + az * by;
    second->n[4] = aw * by - ay * bw - az * bx + ax * bz;
    second->n[5] = aw * bz - az * bw - ax * by + ay * bx;
    second->n[6] = aw * bw + ax * bx + ay * by + az * bz;
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
    long long newest_stamp, oldest_stamp, limit, prune_after;
    long long start, count, compact_at, origin, parent;
    char is_static, mixed, borrowed;
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
    MEMBER(Link, mixed, T_BOOL), PRIVATE(Link, newest_pair, T_OBJECT_EX),
    PRIVATE(Link, prune_after, T_LONGLONG), PRIVATE(Link, compact_at, T_LONGLONG),
    PRIVATE(Link, borrowed, T_BOOL), {NULL, 0, 0, 0, NULL},
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

/* A new tuple of that many floats; NULL with an error set on failure. */
static PyObject *floats(PyTypeObject *type, const double *numbers, Py_ssize_t size) {
    PyObject *made = PyType_GenericAlloc(type, size);
    for (Py_ssize_t i = 0; made != NULL && i < size; i++) {
        PyObject *number = PyFloat_FromDouble(numbers[i]);
        if (number == NULL || PyTuple_SetItem(made, i, number) < 0)
            Py_CLEAR(made);
    }
    return made;
}

/* `newest`: what was set, or what was appended since, made when it is first asked for. */
static PyObject *get_newest(PyObject *self, void *Py_UNUSED(closure)) {
    Link *link = (Link *)self;
    Py_buffer view;
    if (link->newest == NULL && read_records(link, PyBUF_SIMPLE, &view)) {
        Pose pose;
        pose_of(view.buf, (Py_ssize_t)link->count - 1, &pose);
        PyBuffer_Release(&view);
        if ((link->newest = floats(&PyTuple_Type, pose.n, 7)) == NULL)
            return NULL;
    }
    return Py_NewRef(link->newest == NULL ? Py_None : link->newest);
}

static int set_newest(PyObject *self, PyObject *value, void *Py_UNUSED(closure)) {
    PyObject *before = ((Link *)self)->newest;
    ((Link *)self)->newest = Py_XNewRef(value);
    Py_XDECREF(before);
    return 0;
}

/* Looking up -------------------------------------------------------------- */

/* So many links are made ready before the first is read: meanwhile memory brings their samples. */
#define AHEAD 8

/* A link made ready for a moment: the pose it has, or records to find it in. */
typedef struct {
    Py_buffer view;
    const char *records; /* NULL: `pose` is the answer. */
    Py_ssize_t last;
    Guess guess;
    Pose pose;
} Step;

/* Make a link ready for a moment (0: its newest). Returns whether it is plain and has a pose
   then; what `records` are of is then to be released. Never sets an error. */
static int prepare(const Link *link, int64_t time, Step *step) {
    step->records = NULL;
    if (link->is_static)
        return link->newest != NULL && read_floats(link->newest, step->pose.n, 7);
    const int64_t oldest = link->oldest_stamp, newest = link->newest_stamp;
    const int between = oldest < time && time < newest;
    if (link->mixed || (!between && time != newest && time != oldest && time != 0)
        || !read_records(link, PyBUF_SIMPLE, &step->view))
        return 0;
    const char *records = (const char *)step->view.buf + RECORD * link->start;
    step->last = (Py_ssize_t)(link->count - link->start) - 1;
    if (between && step->last > 0) {
        step->records = records;
        step->guess = guess(oldest, newest, step->last, time);
        PREFETCH(records + RECORD * step->guess.at);
        PREFETCH(records + RECORD * step->guess.at + RECORD);
        PREFETCH(records + RECORD * step->guess.at + 2 * RECORD - 1);
        return 1;
    }
    pose_of(records, time == oldest && time != newest ? 0 : step->last, &step->pose);
    PyBuffer_Release(&step->view);
    return !between;
}

/* The pose of a link that is ready: `History.at`. Returns 0 where the samples are too far apart
   to be told exactly. */
static int pose_at(const Step *step, int64_t time, Pose *pose) {
    const Py_ssize_t index = find(step->records, step->last, time, step->guess);
    const uint64_t before = (uint64_t)stamp_of(step->records, index);
    const uint64_t length = (uint64_t)stamp_of(step->records, index + 1) - before;
    Pose first, second;
    pose_of(step->records, index, &first);
    pose_of(step->records, index + 1, &second);
    /* A quotient of whole numbers; of larger ones it would be rounded twice. */
    if (length >= EXACT)
        return 0;
    interpolate(&first, &second, (double)((uint64_t)time - before) / (double)length, pose);
    return 1;
}

/* The poses of several links one after the other, lowest first: `path.chain`. Returns 0 if one
   is not plain or has none; never sets an error. */
static int chain(PyObject *links, PyTypeObject *fields, int64_t time, Pose *pose) {
    const Py_ssize_t count = PyTuple_Size(links);
    PyTypeObject *known = fields;
    Step steps[AHEAD];
    int found = 1;
    *pose = identity;
    for (Py_ssize_t first = 0; found && first < count; first += AHEAD) {
        const int most = count - first < AHEAD ? (int)(count - first) : AHEAD;
        int ready = 0;
        for (; found && ready < most; ready += found) {
            PyObject *link = PyTuple_GetItem(links, first + ready);
            found = Py_TYPE(link) == known || PyObject_TypeCheck(link, fields);
            if (found) {
                known = Py_TYPE(link);
                found = prepare((const Link *)link, time, &steps[ready]);
            }
        }
        for (int i = 0; i < ready; i++) {
            Step *step = &steps[i];
            if (step->records != NULL) {
                found = found && pose_at(step, time, &step->pose);
                PyBuffer_Release(&step->view);
            }
            if (first + i == 0)
                *pose = step->pose;
            else if (found)
                compose(&step->pose, pose);
        }
    }
    return found;
}

/* Whether two plain strings are equal; one that is none is equal to nothing. */
static int same_text(PyObject *known, PyObject *given) {
    return known == given
        || (PyUnicode_CheckExact(known) && PyUnicode_Compare(known, given) == 0);
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
                      int64_t *time, Pose *pose) {
    PyObject *path = path_of(door, target, source);
    Pose other;
    if (path == NULL || (*time == 0 && !latest(path, types->fields, time, NULL))
        || !chain(PyTuple_GetItem(path, 0), types->fields, *time, pose))
        return 0;
    PyObject *down = PyTuple_GetItem(path, 1);
    if (PyTuple_Size(down) > 0) {
        if (!chain(down, types->fields, *time, &other))
            return 0;
        between(&other, pose);
    }
    canonical(pose->n + 3);
    return pose->n[6] == pose->n[6];
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

/* A TransformStamped; NULL with an error set on failure. */
static PyObject *answer(const Types *types, int64_t stamp, PyObject *target, PyObject *source, const Pose *pose) {
    PyObject *numbers[2] = {floats(types->vector, pose->n, 3), floats(types->quaternion, pose->n + 3, 4)};
    PyObject *parts[4] = {PyLong_FromLongLong(stamp), Py_NewRef(target), Py_NewRef(source), tuple_of(types->transform, numbers, 2)};
    return tuple_of(types->stamped, parts, 4);
}

/* What `Buffer` does in plain Python, as it was asked. */
static PyObject *plainly(PyObject *self, const char *name, PyObject *const *args, Py_ssize_t count,
                         PyObject *names) {
    const Py_ssize_t named = names == NULL ? 0 : PyTuple_Size(names);
    PyObject *call = PyObject_GetAttrString(self, name), *given = PyTuple_New(count), *by_name = PyDict_New(), *result = NULL;
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
    Pose pose;
    if (names == NULL && (count == 2 || (count == 3 && read_stamp(args[2], &time)))
        && solve_path((const Door *)self, types, args[0], args[1], &time, &pose))
        return answer(types, time, args[0], args[1], &pose);
    return PLAINLY(lookup_transform);
}

/* The same where target and source may be one frame, whose name another path has shown good. */
static int solve_leg(const Door *door, const Types *types, PyObject *target, PyObject *source,
                     int64_t *time, Pose *pose) {
    *pose = identity;
    return (*time != 0 && same_text(target, source))
        || solve_path(door, types, target, source, time, pose);
}

METHOD(lookup_transform_full) {
    const Types *types = PyType_GetModuleState(door);
    int64_t here, there;
    Pose inner, outer;
    if (names == NULL && count == 5 && read_stamp(args[1], &here) && read_stamp(args[3], &there)
        && !same_text(args[0], args[2])
        && solve_leg((const Door *)self, types, args[4], args[2], &there, &inner)
        && solve_leg((const Door *)self, types, args[0], args[4], &here, &outer)) {
        compose(&outer, &inner);
        if (unit(inner.n + 3)) {
            canonical(inner.n + 3);
            return answer(types, here, args[0], args[2], &inner);
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

/* Take words out of an array. Returns whether it let go of them, which none does that a batch
   reads; never sets an error. */
static int cut(PyObject *records, Py_ssize_t from, Py_ssize_t to) {
    if (PySequence_DelSlice(records, from, to) == 0)
        return 1;
    PyErr_Clear();
    return 0;
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

/* Have room for a sample in a link's records, that no batch reads if the sample is not the newest.
   Returns whether it could be had; never sets an error. */
static int make_room(Link *link, int64_t stamp) {
    Py_ssize_t room = PyObject_Size(link->records) / WORD;
    if (link->start < 0 || link->count <= link->start || link->count > room) {
        PyErr_Clear();
        return 0;
    }
    if (link->start >= link->compact_at) {
        /* What is pruned makes room for as many. */
        const Py_ssize_t start = (Py_ssize_t)link->start, count = (Py_ssize_t)link->count - start;
        if (!cut(link->records, 0, WORD * start))
            return 0;
        link->start = 0;
        link->count = count;
        link->compact_at = LARGER(count >> SLACK, LEAST_SLACK);
        if (!grow(link->records, start))
            return 0;
    }
    else if (stamp <= link->newest_stamp) {
        /* One in front takes no room behind. */
        if (stamp < link->oldest_stamp && link->count < room)
            return cut(link->records, WORD * room - WORD, WORD * room);
        return grow(link->records, 1);
    }
    else if (link->count == room)
        return grow(link->records, LARGER(LARGER(SMALLER(room, MOST_ROOM), LEAST_ROOM), room >> ROOM));
    return 1;
}

/* A moment so much later, or the last one there is. */
static inline int64_t later(int64_t stamp, int64_t span) {
    return stamp > INT64_MAX - span ? INT64_MAX : stamp + span;
}

/* Put a sample into a link: `History.insert` where no other one has its stamp, and all are of the
   same origin. Returns whether it was done; never sets an error. */
static int put(Link *link, int64_t stamp, int64_t origin, Pose *pose) {
    Py_buffer view;
    double *n = pose->n;
    const double square = square_of(n + 3);
    if (!(1.0 - ROUNDING < square && square < 1.0 + ROUNDING && n[0] + n[1] + n[2] < HUGE_VAL))
        return 0;
    if (link->is_static || link->mixed || link->borrowed || link->origins != Py_None
        || link->origin != origin || link->limit < 0 || link->records == NULL)
        return 0;
    /* Making room calls Python, whose collector may run code that gives the link other records. */
    PyObject *records_held = Py_NewRef(link->records);
    const int has_room = make_room(link, stamp);
    Py_DECREF(records_held);
    if (!has_room || !read_records(link, PyBUF_WRITABLE, &view))
        return 0;
    char *records = view.buf;
    const int64_t newest = link->newest_stamp;
    Py_ssize_t start = (Py_ssize_t)link->start, count = (Py_ssize_t)link->count, place = count;
    int64_t oldest = link->oldest_stamp, after = link->prune_after;
    while (newest > after && start + 1 < count) {
        oldest = stamp_of(records, ++start);
        after = later(oldest, link->limit);
    }
    int fits = newest <= after;
    if (fits && stamp <= newest) {
        const Py_ssize_t last = count - 1 - start;
        fits = (uint64_t)newest - (uint64_t)stamp <= (uint64_t)link->limit;
        if (stamp < oldest)
            place = start - 1;
        else if (fits && stamp < newest && last > 0) {
            place = start + find(records + RECORD * start, last, stamp, guess(oldest, newest, last, stamp));
            fits &= stamp_of(records, place++) != stamp;
        }
        else
            fits = 0;
    }
    fits &= place >= 0 && (place < start || count < view.len / RECORD);
    if (fits) {
        char *record = records + RECORD * place;
        canonical(n + 3);
        if (place < start) {
            oldest = stamp;
            after = later(oldest, link->limit);
            start = place;
        }
        else
            memmove(record + RECORD, record, RECORD * (count++ - place));
        memcpy(record, &stamp, WORD);
        memcpy(record + WORD, n, sizeof pose->n);
        link->start = start;
        link->count = count;
        link->oldest_stamp = oldest;
        link->prune_after = after;
    }
    PyBuffer_Release(&view);
    if (!fits)
        return 0;
    /* Last of all: what is let go of here may run code of others. */
    PyObject *pair = link->newest_pair, *before = NULL;
    link->newest_pair = Py_NewRef(Py_None);
    if (stamp > newest) {
        link->newest_stamp = stamp;
        before = link->newest;
        link->newest = NULL;
    }
    Py_XDECREF(before);
    Py_XDECREF(pair);
    return 1;
}

/* Remember a sample of plain parts, of a link that is known by its child. Returns whether it
   was done; never sets an error. */
static int insert(const Door *door, const Types *types, PyObject *sample, PyObject *authority) {
    int64_t stamp, origin;
    Pose pose;
    if (Py_TYPE(sample) != types->stamped || PyTuple_Size(sample) != 4 || door->senders == NULL
        || !PyDict_Check(door->senders))
        return 0;
    PyObject *parent = PyTuple_GetItem(sample, 1), *child = PyTuple_GetItem(sample, 2);
    PyObject *transform = PyTuple_GetItem(sample, 3);
    if (!PyUnicode_CheckExact(child) || !PyUnicode_CheckExact(parent)
        || !PyUnicode_CheckExact(authority) || Py_TYPE(transform) != types->transform
        || PyTuple_Size(transform) != 2 || !read_stamp(PyTuple_GetItem(sample, 0), &stamp)
        || !read_floats(PyTuple_GetItem(transform, 0), pose.n, 3)
        || !read_floats(PyTuple_GetItem(transform, 1), pose.n + 3, 4))
        return 0;
    PyObject *sender = PyDict_GetItemWithError(door->senders, child);
    if (sender == NULL || !PyTuple_Check(sender) || PyTuple_Size(sender) != 4)
        return 0;
    PyObject *link = PyTuple_GetItem(sender, 3);
    return same_text(PyTuple_GetItem(sender, 0), parent)
        && same_text(PyTuple_GetItem(sender, 1), authority)
        && read_stamp(PyTuple_GetItem(sender, 2), &origin)
        && PyObject_TypeCheck(link, types->fields) && put((Link *)link, stamp, origin, &pose);
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

static PyGetSetDef link_getset[] = {
    {"newest", get_newest, set_newest, NULL, NULL}, {NULL, NULL, NULL, NULL, NULL},
};

#define HOLDER(name, what, ...)                                                                   \
    static PyType_Slot name##_slots[] = {                                                         \
        {Py_tp_doc, what}, {Py_tp_members, name##_members}, {Py_tp_traverse, held_traverse},      \
        {Py_tp_clear, held_clear}, {Py_tp_dealloc, held_dealloc}, __VA_ARGS__, {0, NULL},         \
    }
HOLDER(link, "The fields of a link, laid out so that the kernel can read them.", {Py_tp_getset, link_getset});
HOLDER(door, "The methods of a buffer that are called most.", {Py_tp_methods, door_methods});

#define FLAGS Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_HAVE_GC
static PyType_Spec link_spec = {"tftool.frames._kernel.Fields", sizeof(Link), 0, FLAGS, link_slots};
static PyType_Spec door_spec = {"tftool.frames._kernel.Door", sizeof(Door), 0, FLAGS, door_slots};

/* A batch ---------------------------------------------------------------- */

/* So many moments are worked on together, number by number: what they take stays in the
   processor's nearest cache, and the compiler turns each loop into vector operations. */
#define BLOCK 128

/* One link of a batch: records in order, or a pose that never changes. */
typedef struct {
    Py_buffer view, origins_view;
    const char *records, *origins; /* NULL: `fixed`; NULL: they are all alike. */
    Py_ssize_t count, here;        /* `here`: where the last moment was found. */
    Pose fixed;
} Edge;

typedef double Row[BLOCK];
typedef Row Rows[7];

typedef struct {
    Rows first, second, step, up, down;
    Row passed, length, arc, sign, keep, take;
} Room;

#if defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__))
#define DISPATCH 1
#endif
/* Fetch both neighbours of each moment, and how far it lies between them. Where a link has no
   data for a moment, `valid` becomes 0 and what is fetched is of no use. */
INLINE void fetch(Edge *edge, const int64_t *times, int n, Room *room, unsigned char *valid) {
    const char *records = edge->records;
    const Py_ssize_t last = edge->count - 1;
    const int64_t oldest = stamp_of(records, 0), newest = stamp_of(records, last);
    Py_ssize_t here = edge->here;
    for (int i = 0; i < n; i++) {
        const int64_t time = times[i];
        if (!(oldest < time && time < newest)) {
            /* Of equal stamps at the newest end it is the last, at the oldest end the first. */
            here = time == oldest && time != newest ? 0 : last;
            valid[i] &= time == oldest || time == newest;
        }
        else if (here == last || !(stamp_of(records, here) <= time && time < stamp_of(records, here + 1))) {
            if (here + 2 <= last && stamp_of(records, here + 1) <= time
                && time < stamp_of(records, here + 2))
                here++;
            else
                here = find(records, last, time, guess(oldest, newest, last, time));
        }
        const Py_ssize_t next = here < last ? here + 1 : last;
        const int64_t before = stamp_of(records, here);
        uint64_t passed = (uint64_t)time - (uint64_t)before;
        const uint64_t length = (uint64_t)stamp_of(records, next) - (uint64_t)before;
        if (edge->origins != NULL
            && ((word_of(edge->origins, here) ^ word_of(edge->origins, next)) & PARENT_MASK))
            passed = 0;
        room->passed[i] = (double)passed;
        room->length[i] = length ? (double)length : 1.0;
        const char *first = records + RECORD * here, *second = records + RECORD * next;
        for (int k = 0; k < 7; k++)
            memcpy(&room->first[k][i], first + WORD + WORD * k, WORD);
        for (int k = 0; k < 7; k++)
            memcpy(&room->second[k][i], second + WORD + WORD * k, WORD);
    }
    edge->here = here;
}

/* The pose on the way between what was fetched, for each moment: twin of `interpolate`. */
INLINE void blend(Room *room, int n, Rows out) {
    double *share = room->passed, *arc = room->arc, *sign = room->sign;
    double *keep = room->keep, *take = room->take;
    int longer = 0, longest = 0;
    for (int i = 0; i < n; i++) {
        const double cosine = room->first[3][i] * room->second[3][i]
            + room->first[4][i] * room->second[4][i] + room->first[5][i] * room->second[5][i]
            + room->first[6][i] * room->second[6][i];
        const double near = fabs(cosine);
        share[i] = share[i] / room->length[i];
        sign[i] = cosine < 0.0 ? -1.0 : 1.0;
        arc[i] = near < 1.0 ? 1.0 - near : 0.0;
        longer += arc[i] > SHORT_ARC;
        longest += arc[i] > LONG_ARC;
    }
    if (longer == 0)
        for (int i = 0; i < n; i++) {
            keep[i] = weight(1.0 - share[i], arc[i], SHORT_TERMS);
            take[i] = weight(share[i], arc[i], SHORT_TERMS);
        }
    else
        for (int i = 0; i < n; i++) {
            keep[i] = weight(1.0 - share[i], arc[i], LONG_TERMS);
            take[i] = weight(share[i], arc[i], LONG_TERMS);
        }
    for (int i = 0; longest > 0 && i < n; i++)
        if (arc[i] > LONG_ARC) {
            const double angle = acos(1.0 - arc[i]), sine = sin(angle);
            keep[i] = sin((1.0 - share[i]) * angle) / sine;
            take[i] = sin(share[i] * angle) / sine;
        }
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < n; i++) {
            /* Where a sample is met it is taken as it is: no way leads to infinity. */
            const double a = room->first[k][i];
            const double moved = a + share[i] * (room->second[k][i] - a);
            out[k][i] = share[i] == 0.0 ? a : moved;
        }
    for (int k = 3; k < 7; k++)
        for (int i = 0; i < n; i++) {
            const double a = room->first[k][i], b = sign[i] * room->second[k][i];
            const double turned = keep[i] * a + take[i] * b;
            const double straight = a + share[i] * (b - a);
            /* Between equals the rotation stays to the last bit. */
            out[k][i] = arc[i] == 0.0 ? straight : turned;
        }
}

/* Put two poses of each moment together, in the second. */
INLINE void join(void (*how)(const Pose *, Pose *), Rows first, Rows second, int n) {
    for (int i = 0; i < n; i++) {
        Pose one, other;
        for (int k = 0; k < 7; k++) {
            one.n[k] = first[k][i];
            other.n[k] = second[k][i];
        }
        how(&one, &other);
        for (int k = 0; k < 7; k++)
            second[k][i] = other.n[k];
    }
}

/* The poses of several links one after the other, for each moment, in `pose`. */
INLINE void climb(Edge *edges, Py_ssize_t count, const int64_t *times, int n, Room *room, Rows pose,
      unsigned char *valid) {
    for (Py_ssize_t e = 0; e < count; e++) {
        double(*step)[BLOCK] = e ? room->step : pose;
        if (edges[e].records != NULL) {
            fetch(&edges[e], times, n, room, valid);
            blend(room, n, step);
        }
        else
            for (int k = 0; k < 7; k++)
                for (int i = 0; i < n; i++)
                    step[k][i] = edges[e].fixed.n[k];
        if (e)
            join(compose, step, pose, n);
    }
}

/* One block: poses of source in target, or NaN where `valid` becomes 0. */
INLINE void
solve_block(Edge *up, Py_ssize_t ups, Edge *down, Py_ssize_t downs, const int64_t *times, int n,
            Room *room, double *places, double *turns, unsigned char *valid) {
    for (int i = 0; i < n; i++)
        valid[i] = times[i] != 0;
    if (ups)
        climb(up, ups, times, n, room, room->up, valid);
    else
        for (int k = 0; k < 7; k++)
            for (int i = 0; i < n; i++)
                room->up[k][i] = k == 6;
    climb(down, downs, times, n, room, room->down, valid);
    if (downs)
        join(between, room->down, room->up, n);
    double(*pose)[BLOCK] = room->up, *place = room->keep, *turn = room->take;
    for (int i = 0; i < n; i++) {
        place[i] = valid[i] ? 1.0 : NAN;
        turn[i] = place[i] * (leading(pose[3][i], pose[4][i], pose[5][i], pose[6][i]) < 0.0 ? -1.0 : 1.0);
    }
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < 3; k++)
            places[3 * i + k] = pose[k][i] * place[i];
        for (int k = 0; k < 4; k++)
            turns[4 * i + k] = pose[3 + k][i] * turn[i];
    }
}

#define SOLVE_PARAMETERS                                                                          \
    Edge *up, Py_ssize_t ups, Edge *down, Py_ssize_t downs, const int64_t *times, int n,          \
        Room *room, double *places, double *turns, unsigned char *valid
#define SOLVE_ARGUMENTS up, ups, down, downs, times, n, room, places, turns, valid

static void solve_plain(SOLVE_PARAMETERS) { solve_block(SOLVE_ARGUMENTS); }

#ifdef DISPATCH
/* The same, where the processor works on four numbers at once. */
__attribute__((target("avx2"))) static void solve_avx2(SOLVE_PARAMETERS) { solve_block(SOLVE_ARGUMENTS); }
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
static Edge * read_edges(PyObject *links) {
    const Py_ssize_t count = PyTuple_Size(links);
    Edge *edges = PyMem_Calloc(count ? count : 1, sizeof(Edge));
    if (edges == NULL)
        return (Edge *)PyErr_NoMemory();
    for (Py_ssize_t i = 0; i < count; i++) {
        PyObject *link = PyTuple_GetItem(links, i);
        Edge *edge = &edges[i];
        if (read_floats(link, edge->fixed.n, 7))
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
        edge->count = edge->view.len / RECORD;
        if (edge->count < 1 || edge->view.len % RECORD
            || (edge->origins != NULL && edge->origins_view.len / WORD < edge->count)) {
            PyErr_SetString(PyExc_ValueError, "records are rows of 64 bytes, one or more, an origin for each");
            goto failed;
        }
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
    Edge *up = NULL, *down = NULL;
    Room *room = NULL;
    if (!PyArg_ParseTuple(args, "O!O!y*w*w*w*:solve", &PyTuple_Type, &links[0], &PyTuple_Type, &links[1],
                          &views[0], &views[1], &views[2], &views[3]))
        return NULL;
    const Py_ssize_t ups = PyTuple_Size(links[0]), downs = PyTuple_Size(links[1]);
    const Py_ssize_t rows = views[0].len / WORD;
    for (int i = 0; i < 4; i++)
        if (views[i].len != rows * sizes[i] || (sizes[i] > 1 && (uintptr_t)views[i].buf % WORD)) {
            PyErr_SetString(PyExc_ValueError, "moments, translations, rotations and valid are "
                "aligned rows of 8, 24, 32 and 1 bytes, of each equally many");
            goto done;
        }
    if ((up = read_edges(links[0])) == NULL || (down = read_edges(links[1])) == NULL)
        goto done;
    if ((room = PyMem_Malloc(sizeof(Room))) == NULL) {
        PyErr_NoMemory();
        goto done;
    }
    void (*chosen)(SOLVE_PARAMETERS) = solve_plain;
#ifdef DISPATCH
    if (__builtin_cpu_supports("avx2"))
        chosen = solve_avx2;
#endif
    const int64_t *times = views[0].buf;
    double *places = views[1].buf, *turns = views[2].buf;
    unsigned char *valid = views[3].buf;
    Py_ssize_t missing = 0;
    Py_BEGIN_ALLOW_THREADS
    for (Py_ssize_t row = 0; row < rows; row += BLOCK) {
        const int n = rows - row < BLOCK ? (int)(rows - row) : BLOCK;
        chosen(up, ups, down, downs, times + row, n, room, places + 3 * row, turns + 4 * row, valid + row);
        for (int i = 0; i < n; i++)
            missing += !valid[row + i];
    }
    Py_END_ALLOW_THREADS
    result = PyLong_FromSsize_t(missing);
done:
    PyMem_Free(room);
    release_edges(up, ups);
    release_edges(down, downs);
    for (int i = 0; i < 4; i++)
        PyBuffer_Release(&views[i]);
    return result;
}

/* Records that are kept as they are ---------------------------------------- */

PyDoc_STRVAR(are_kept_doc, "are_kept(records, begin, end)\n--\n\n"
"Whether these records can be a history's as they are; see `_kernel.pyi`.");

static PyObject *are_kept(PyObject *Py_UNUSED(module), PyObject *args) {
    Py_buffer view;
    Py_ssize_t begin, end;
    if (!PyArg_ParseTuple(args, "y*nn:are_kept", &view, &begin, &end))
        return NULL;
    if (begin < 0 || begin > end || end > view.len / RECORD) {
        PyBuffer_Release(&view);
        return PyErr_Format(PyExc_ValueError, "there are no such records");
    }
    const char *records = view.buf;
    int kept = 1;
    for (Py_ssize_t row = begin; row < end && kept; row++) {
        Pose pose;
        pose_of(records, row, &pose);
        kept = is_kept(pose.n) && (row == 0 || stamp_of(records, row) > stamp_of(records, row - 1));
    }
    PyBuffer_Release(&view);
    return PyBool_FromLong(kept);
}

/* The module ------------------------------------------------------------- */

static PyMethodDef methods[] = {
    {"are_kept", are_kept, METH_VARARGS, are_kept_doc}, {"solve", solve, METH_VARARGS, solve_doc},
    {NULL, NULL, 0, NULL},
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
