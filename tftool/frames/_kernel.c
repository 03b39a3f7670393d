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
#include <math.h>
#include <stdint.h>
#include <string.h>
#include <structmember.h>

#define WORD 8
#define RECORD (8 * WORD)
#define PARENT_MASK 0xffffffffLL
#define EXACT (1ULL << 53) /* Whole numbers below this are exact as doubles. */

/* What `tftool.frames.native` expects; a build of another interface is not used. */
#define INTERFACE 1

typedef struct { double n[7]; } Pose; /* x y z qx qy qz qw */

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

/* The last of `count` records at or before a moment; count > 1, stamp[0] <= time < stamp[count - 1].
   Whatever the stamps are, it is less than count - 1. Guess by the mean rate, correct the guess once, and search only when that fails. */
static inline Py_ssize_t find(const char *records, Py_ssize_t count, int64_t time) {
    Py_ssize_t low = 0, high = count - 1;
    const int64_t oldest = stamp_of(records, 0);
    const double span = (double)((uint64_t)stamp_of(records, high) - (uint64_t)oldest);
    const double rate = (double)high / span;
    double guess = (double)((uint64_t)time - (uint64_t)oldest) * rate;
    for (int turn = 0; turn < 2; turn++) {
        Py_ssize_t at = guess > (double)low ? (guess < (double)high ? (Py_ssize_t)guess : high - 1) : low;
        if (at > high - 1)
            at = high - 1;
        const int64_t there = stamp_of(records, at);
        if (there > time) {
            high = at;
            guess = (double)at - (double)((uint64_t)there - (uint64_t)time) * rate;
        }
        else if (time < stamp_of(records, at + 1))
            return at;
        else {
            low = at + 1;
            guess = (double)at + (double)((uint64_t)time - (uint64_t)there) * rate;
        }
        if (high - low <= 1)
            break;
    }
    while (high - low > 1) {
        const Py_ssize_t middle = low + (high - low) / 2;
        if (stamp_of(records, middle) <= time)
            low = middle;
        else
            high = middle;
    }
    return low < count - 1 ? low : count - 2;
}

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
        const double u = 1.0 - cosine;
        if (u < 1e-3) { keep = weight(1.0 - share, u, 4); take *= weight(share, u, 4); }
        else {
        const double angle = acos(cosine);
        const double sine = sin(angle);
        keep = sin((1.0 - share) * angle) / sine;
        take *= sin(share * angle) / sine; }
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

/* The number of a unit quaternion that tf2 makes positive: `quaternions.leading`. */
static inline double leading(double x, double y, double z, double w) {
    if (w * w > 0.25)
        return w;
    const double xx = x * x, yy = y * y, zz = z * z;
    return xx < yy ? (yy < zz ? z : y) : (xx < zz ? z : x);
}

static inline void canonical(double *turn) {
    if (!(turn[3] > 0.5) && leading(turn[0], turn[1], turn[2], turn[3]) < 0.0)
        for (int i = 0; i < 4; i++)
            turn[i] = -turn[i];
}

/* What a link keeps ------------------------------------------------------ */

/* The fields of both kinds of links. Python's classes inherit them, and Python's code reads and
   writes them by their names; see `History` for what they mean. */
typedef struct {
    PyObject_HEAD
    PyObject *records, *origins, *newest, *newest_pair;
    long long newest_stamp, oldest_stamp, limit, prune_after;
    long long start, count, compact_at, origin, parent;
    char is_static, mixed, borrowed;
} Link;

#define FIELD(name, kind) {#name, kind, offsetof(Link, name), 0, NULL}
#define PRIVATE(name, kind) {"_" #name, kind, offsetof(Link, name), 0, NULL}
static PyMemberDef link_members[] = {
    FIELD(records, T_OBJECT_EX), FIELD(origins, T_OBJECT_EX),
    FIELD(newest_stamp, T_LONGLONG), FIELD(oldest_stamp, T_LONGLONG), FIELD(limit, T_LONGLONG),
    FIELD(start, T_LONGLONG), FIELD(count, T_LONGLONG), FIELD(origin, T_LONGLONG),
    FIELD(parent, T_LONGLONG), FIELD(is_static, T_BOOL), FIELD(mixed, T_BOOL),
    PRIVATE(newest_pair, T_OBJECT_EX), PRIVATE(prune_after, T_LONGLONG),
    PRIVATE(compact_at, T_LONGLONG), PRIVATE(borrowed, T_BOOL), {NULL, 0, 0, 0, NULL},
};

static int read_records(const Link *link, int flags, Py_buffer *view);
static PyObject *floats(PyTypeObject *type, const double *numbers, Py_ssize_t size);

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

static PyGetSetDef link_getset[] = {
    {"newest", get_newest, set_newest, NULL, NULL}, {NULL, NULL, NULL, NULL, NULL},
};

static int link_traverse(PyObject *self, visitproc visit, void *arg) {
    Link *link = (Link *)self;
    Py_VISIT(Py_TYPE(self));
    Py_VISIT(link->records);
    Py_VISIT(link->origins);
    Py_VISIT(link->newest);
    Py_VISIT(link->newest_pair);
    return 0;
}

static int link_clear(PyObject *self) {
    Link *link = (Link *)self;
    Py_CLEAR(link->records);
    Py_CLEAR(link->origins);
    Py_CLEAR(link->newest);
    Py_CLEAR(link->newest_pair);
    return 0;
}

static void link_dealloc(PyObject *self) {
    PyTypeObject *type = Py_TYPE(self);
    PyObject_GC_UnTrack(self);
    link_clear(self);
    ((freefunc)PyType_GetSlot(type, Py_tp_free))(self);
    Py_DECREF(type);
}

static PyType_Slot link_slots[] = {
    {Py_tp_doc, "The fields of a link, laid out so that the kernel can read them."},
    {Py_tp_members, link_members},
    {Py_tp_getset, link_getset},
    {Py_tp_traverse, link_traverse},
    {Py_tp_clear, link_clear},
    {Py_tp_dealloc, link_dealloc},
    {0, NULL},
};

static PyType_Spec link_spec = {
    "tftool.frames._kernel.Fields", sizeof(Link), 0,
    Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_HAVE_GC, link_slots,
};

/* The types that answers are made of; never let go of, as Python never unloads the module. */
typedef struct {
    PyTypeObject *fields, *stamped, *transform, *vector, *quaternion;
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

/* The pose of a link at a moment (0: the newest): `History.at`. Returns 0 where there is none,
   or where the parent changes nearby; never sets an error. */
static int link_at(const Link *link, int64_t time, Pose *pose) {
    Py_buffer view;
    if (link->is_static)
        return link->newest != NULL && read_floats(link->newest, pose->n, 7);
    if (link->mixed || !read_records(link, PyBUF_SIMPLE, &view))
        return 0;
    const char *records = (const char *)view.buf + RECORD * link->start;
    const Py_ssize_t last = (Py_ssize_t)(link->count - link->start) - 1;
    const int64_t oldest = stamp_of(records, 0), newest = stamp_of(records, last);
    int found = 1;
    if (oldest < time && time < newest) {
        const Py_ssize_t index = find(records, last + 1, time);
        const uint64_t before = (uint64_t)stamp_of(records, index);
        const uint64_t length = (uint64_t)stamp_of(records, index + 1) - before;
        Pose first, second;
        pose_of(records, index, &first);
        pose_of(records, index + 1, &second);
        /* A quotient of whole numbers; of larger ones it would be rounded twice. */
        found = length < EXACT;
        if (found)
            interpolate(&first, &second, (double)((uint64_t)time - before) / (double)length, pose);
    }
    else if (time == newest || time == 0)
        pose_of(records, last, pose);
    else if (time == oldest)
        pose_of(records, 0, pose);
    else
        found = 0;
    PyBuffer_Release(&view);
    return found;
}

/* The poses of several links one after the other, lowest first: `path.chain`. */
static int chain(PyObject *links, PyTypeObject *fields, int64_t time, Pose *pose) {
    static const Pose identity = {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}};
    const Py_ssize_t count = PyTuple_Size(links);
    if (count == 0)
        *pose = identity;
    for (Py_ssize_t i = 0; i < count; i++) {
        PyObject *link = PyTuple_GetItem(links, i);
        Pose step;
        if (!PyObject_TypeCheck(link, fields) || !link_at((const Link *)link, time, i ? &step : pose))
            return 0;
        if (i)
            compose(&step, pose);
    }
    return 1;
}

/* A tuple of that many floats. */
static PyObject *floats(PyTypeObject *type, const double *numbers, Py_ssize_t size) {
    PyObject *made = PyType_GenericAlloc(type, size);
    for (Py_ssize_t i = 0; made != NULL && i < size; i++) {
        PyObject *number = PyFloat_FromDouble(numbers[i]);
        if (number == NULL || PyTuple_SetItem(made, i, number) < 0)
            Py_CLEAR(made);
    }
    return made;
}

/* Put two new references into a tuple of two; all of them are given up on failure. */
static PyObject *pair_of(PyObject *made, PyObject *first, PyObject *second) {
    if (made != NULL && first != NULL && second != NULL) {
        PyTuple_SetItem(made, 0, first);
        PyTuple_SetItem(made, 1, second);
        return made;
    }
    Py_XDECREF(made);
    Py_XDECREF(first);
    Py_XDECREF(second);
    return NULL;
}

/* A Transform of seven numbers, the rotation given tf2's sign. */
static PyObject *new_transform(const Types *types, Pose *pose) {
    canonical(pose->n + 3);
    PyObject *place = floats(types->vector, pose->n, 3);
    PyObject *turn = place == NULL ? NULL : floats(types->quaternion, pose->n + 3, 4);
    return pair_of(turn == NULL ? NULL : PyType_GenericAlloc(types->transform, 2), place, turn);
}

/* A moment as 64 bits. Returns whether it is an `int` that fits; never sets an error. */
static int read_stamp(PyObject *stamp, int64_t *value) {
    int overflow = 0;
    if (!PyLong_CheckExact(stamp))
        return 0;
    *value = PyLong_AsLongLongAndOverflow(stamp, &overflow);
    return !overflow;
}

/* The newest moment for which every moving link has data: `Path.latest`. */
static int latest(PyObject *moving, PyTypeObject *fields, int64_t *moment) {
    int64_t oldest = 0;
    for (Py_ssize_t i = 0; i < PyTuple_Size(moving); i++) {
        PyObject *link = PyTuple_GetItem(moving, i);
        if (!PyObject_TypeCheck(link, fields))
            return 0;
        const int64_t stamp = ((Link *)link)->newest_stamp;
        if (stamp != 0 && (stamp < oldest || oldest == 0))
            oldest = stamp;
    }
    *moment = oldest;
    return 1;
}

PyDoc_STRVAR(lookup_doc, "lookup(paths, target, source, time)\n--\n\n"
"The answer of `Buffer.lookup_transform` by a path that is known, or None if it is not plain.");

static PyObject *lookup(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    const Types *types = PyModule_GetState(module);
    int64_t time;
    Pose pose, other;
    if (count != 4 || !PyDict_Check(args[0]))
        return PyErr_Format(PyExc_TypeError, "lookup takes paths, two names and a moment");
    /* Plain strings: looking for one runs no code of others. */
    if (!PyUnicode_CheckExact(args[1]) || !PyUnicode_CheckExact(args[2]) || !read_stamp(args[3], &time))
        Py_RETURN_NONE;
    PyObject *found = PyDict_GetItemWithError(args[0], args[1]);
    if (found != NULL && PyDict_Check(found))
        found = PyDict_GetItemWithError(found, args[2]);
    if (found == NULL || !PyTuple_Check(found) || PyTuple_Size(found) != 3) {
        if (PyErr_Occurred())
            return NULL;
        Py_RETURN_NONE;
    }
    PyObject *up = PyTuple_GetItem(found, 0), *down = PyTuple_GetItem(found, 1);
    PyObject *moving = PyTuple_GetItem(found, 2);
    const int asked = time != 0;
    if (!PyTuple_Check(up) || !PyTuple_Check(down) || !PyTuple_Check(moving)
        || (!asked && !latest(moving, types->fields, &time))
        || !chain(up, types->fields, time, &pose))
        Py_RETURN_NONE;
    if (PyTuple_Size(down) > 0) {
        if (!chain(down, types->fields, time, &other))
            Py_RETURN_NONE;
        between(&other, &pose);
    }
    if (pose.n[6] != pose.n[6])
        Py_RETURN_NONE;
    PyObject *transform = new_transform(types, &pose);
    PyObject *moment = asked ? Py_NewRef(args[3]) : PyLong_FromLongLong(time);
    PyObject *made = transform && moment ? PyType_GenericAlloc(types->stamped, 4) : NULL;
    if (made != NULL) {
        PyTuple_SetItem(made, 1, Py_NewRef(args[1]));
        PyTuple_SetItem(made, 2, Py_NewRef(args[2]));
        PyTuple_SetItem(made, 3, transform);
        PyTuple_SetItem(made, 0, moment);
        return made;
    }
    Py_XDECREF(transform);
    Py_XDECREF(moment);
    return NULL;
}

PyDoc_STRVAR(at_doc, "at(link, time)\n--\n\n"
"The pose of a link at a moment as a tuple of seven floats, or None if it is not plain.");

static PyObject *at(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    const Types *types = PyModule_GetState(module);
    int64_t time;
    Pose pose;
    if (count != 2)
        return PyErr_Format(PyExc_TypeError, "at takes a link and a moment");
    if (!PyObject_TypeCheck(args[0], types->fields) || !read_stamp(args[1], &time)
        || !link_at((const Link *)args[0], time, &pose))
        Py_RETURN_NONE;
    return floats(&PyTuple_Type, pose.n, 7);
}

/* Inserting -------------------------------------------------------------- */

/* Append a sample to a link: `History.insert` where it is newer than all others, of the same
   origin, and prunes one sample at most. Returns whether it was done; never sets an error. */
static int append(Link *link, int64_t stamp, int64_t origin, Pose *pose) {
    Py_buffer view;
    double *n = pose->n;
    const double square = n[3] * n[3] + n[4] * n[4] + n[5] * n[5] + n[6] * n[6];
    if (!(1.0 - 8e-16 < square && square < 1.0 + 8e-16 && n[0] + n[1] + n[2] < HUGE_VAL))
        return 0;
    if (link->is_static || link->mixed || link->borrowed || link->origins != Py_None
        || link->origin != origin || stamp <= link->newest_stamp
        || !read_records(link, PyBUF_WRITABLE, &view))
        return 0;
    char *records = view.buf;
    int fits = link->count < view.len / RECORD;
    long long start = link->start, oldest = link->oldest_stamp, after = link->prune_after;
    if (fits && link->newest_stamp > after) {
        start++;
        fits = start < link->count && start < link->compact_at;
        if (fits) {
            oldest = stamp_of(records, start);
            after = oldest > INT64_MAX - link->limit ? INT64_MAX : oldest + link->limit;
            fits = link->limit >= 0 && link->newest_stamp <= after;
        }
    }
    if (fits) {
        if (n[6] < -0.5 || (n[6] <= 0.5 && leading(n[3], n[4], n[5], n[6]) < 0.0))
            for (int i = 3; i < 7; i++)
                n[i] *= -1.0;
        char *record = records + RECORD * link->count;
        memcpy(record, &stamp, WORD);
        memcpy(record + WORD, n, sizeof pose->n);
        link->start = start;
        link->oldest_stamp = oldest;
        link->prune_after = after;
        link->newest_stamp = stamp;
        link->count++;
    }
    PyBuffer_Release(&view);
    if (!fits)
        return 0;
    /* Last of all: what is let go of here may run code of others. */
    PyObject *before = link->newest, *pair = link->newest_pair;
    link->newest = NULL;
    link->newest_pair = Py_NewRef(Py_None);
    Py_XDECREF(before);
    Py_XDECREF(pair);
    return 1;
}

/* Whether two plain strings are equal; one that is none is equal to nothing. */
static int same_text(PyObject *known, PyObject *given) {
    return known == given
        || (PyUnicode_CheckExact(known) && PyUnicode_Compare(known, given) == 0);
}

PyDoc_STRVAR(insert_doc, "insert(senders, transform, authority)\n--\n\n"
"Remember a plain sample of a link that is known by its child. Returns whether it was done.");

static PyObject *insert(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    const Types *types = PyModule_GetState(module);
    int64_t stamp, origin;
    Pose pose;
    if (count != 3 || !PyDict_Check(args[0]))
        return PyErr_Format(PyExc_TypeError, "insert takes senders, a sample and an authority");
    if (Py_TYPE(args[1]) != types->stamped || PyTuple_Size(args[1]) != 4)
        Py_RETURN_FALSE;
    PyObject *parent = PyTuple_GetItem(args[1], 1), *child = PyTuple_GetItem(args[1], 2);
    PyObject *transform = PyTuple_GetItem(args[1], 3);
    if (!PyUnicode_CheckExact(child) || !PyUnicode_CheckExact(parent) || !PyUnicode_CheckExact(args[2])
        || Py_TYPE(transform) != types->transform || PyTuple_Size(transform) != 2
        || !read_stamp(PyTuple_GetItem(args[1], 0), &stamp)
        || !read_floats(PyTuple_GetItem(transform, 0), pose.n, 3)
        || !read_floats(PyTuple_GetItem(transform, 1), pose.n + 3, 4))
        Py_RETURN_FALSE;
    PyObject *sender = PyDict_GetItemWithError(args[0], child);
    if (sender == NULL || !PyTuple_Check(sender) || PyTuple_Size(sender) != 4) {
        if (PyErr_Occurred())
            return NULL;
        Py_RETURN_FALSE;
    }
    PyObject *link = PyTuple_GetItem(sender, 3);
    if (!same_text(PyTuple_GetItem(sender, 0), parent) || !same_text(PyTuple_GetItem(sender, 1), args[2])
        || !read_stamp(PyTuple_GetItem(sender, 2), &origin)
        || !PyObject_TypeCheck(link, types->fields))
        Py_RETURN_FALSE;
    return PyBool_FromLong(append((Link *)link, stamp, origin, &pose));
}

/* A batch ---------------------------------------------------------------- */

/* So many moments are worked on together, number by number: what they take stays in the
   processor's nearest cache, and the compiler turns each loop into vector operations. */
#define BLOCK 128

/* Arcs up to these values of 1 - cos are turned by so many terms, the error below 1e-17. */
#define SHORT_ARC 1e-3
#define SHORT_TERMS 4
#define LONG_ARC 0.1
#define LONG_TERMS 13

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
#if defined(__GNUC__)
#define INLINE static inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define INLINE static __forceinline
#else
#define INLINE static inline
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
                here = find(records, edge->count, time);
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
        Pose first, second;
        pose_of(records, here, &first);
        pose_of(records, next, &second);
        for (int k = 0; k < 7; k++) {
            room->first[k][i] = first.n[k];
            room->second[k][i] = second.n[k];
        }
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
        for (int i = 0; e && i < n; i++) {
            Pose outer, inner;
            for (int k = 0; k < 7; k++) {
                outer.n[k] = step[k][i];
                inner.n[k] = pose[k][i];
            }
            compose(&outer, &inner);
            for (int k = 0; k < 7; k++)
                pose[k][i] = inner.n[k];
        }
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
    for (int i = 0; downs && i < n; i++) {
        Pose first, second;
        for (int k = 0; k < 7; k++) {
            first.n[k] = room->down[k][i];
            second.n[k] = room->up[k][i];
        }
        between(&first, &second);
        for (int k = 0; k < 7; k++)
            room->up[k][i] = second.n[k];
    }
    for (int i = 0; i < n; i++) {
        Pose pose;
        for (int k = 0; k < 7; k++)
            pose.n[k] = valid[i] ? room->up[k][i] : NAN;
        canonical(pose.n + 3);
        memcpy(places + 3 * i, pose.n, 3 * sizeof(double));
        memcpy(turns + 4 * i, pose.n + 3, 4 * sizeof(double));
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

static PyObject *solve(PyObject *Py_UNUSED(module), PyObject *const *args, Py_ssize_t count) {
    static const Py_ssize_t sizes[4] = {8, 24, 32, 1};
    Py_buffer views[4];
    int held = 0;
    Edge *up = NULL, *down = NULL;
    Room *room = NULL;
    PyObject *result = NULL;
    if (count != 6 || !PyTuple_Check(args[0]) || !PyTuple_Check(args[1]))
        return PyErr_Format(PyExc_TypeError, "solve takes two tuples of links and four arrays");
    const Py_ssize_t ups = PyTuple_Size(args[0]), downs = PyTuple_Size(args[1]);
    for (; held < 4; held++)
        if (PyObject_GetBuffer(args[2 + held], &views[held], held ? PyBUF_WRITABLE : PyBUF_SIMPLE) < 0)
            goto done;
    const Py_ssize_t rows = views[0].len / WORD;
    for (int i = 0; i < 4; i++)
        if (views[i].len != rows * sizes[i] || (sizes[i] > 1 && (uintptr_t)views[i].buf % WORD)) {
            PyErr_SetString(PyExc_ValueError, "moments, translations, rotations and valid are "
                "aligned rows of 8, 24, 32 and 1 bytes, of each equally many");
            goto done;
        }
    if ((up = read_edges(args[0])) == NULL || (down = read_edges(args[1])) == NULL)
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
    release_edges(up, up == NULL ? 0 : ups);
    release_edges(down, down == NULL ? 0 : downs);
    while (held > 0)
        PyBuffer_Release(&views[--held]);
    return result;
}

/* The module ------------------------------------------------------------- */

static PyMethodDef methods[] = {
    {"lookup", (PyCFunction)(void (*)(void))lookup, METH_FASTCALL, lookup_doc},
    {"at", (PyCFunction)(void (*)(void))at, METH_FASTCALL, at_doc},
    {"insert", (PyCFunction)(void (*)(void))insert, METH_FASTCALL, insert_doc},
    {"solve", (PyCFunction)(void (*)(void))solve, METH_FASTCALL, solve_doc},
    {NULL, NULL, 0, NULL},
};

/* A class of a module of ours that is a tuple and nothing more; NULL with an error set if not. */
static PyTypeObject * tuple_type(const char *module, const char *name) {
    PyObject *home = PyImport_ImportModule(module);
    PyObject *type = home == NULL ? NULL : PyObject_GetAttrString(home, name);
    Py_XDECREF(home);
    if (type == NULL)
        return NULL;
    PyObject *plain = PyObject_GetAttrString((PyObject *)&PyTuple_Type, "__basicsize__");
    PyObject *size = PyObject_GetAttrString(type, "__basicsize__");
    const int same = plain && size && PyObject_RichCompareBool(plain, size, Py_EQ) == 1;
    Py_XDECREF(plain);
    Py_XDECREF(size);
    if (same && PyType_Check(type) && PyType_IsSubtype((PyTypeObject *)type, &PyTuple_Type))
        return (PyTypeObject *)type;
    Py_DECREF(type);
    if (!PyErr_Occurred())
        PyErr_Format(PyExc_TypeError, "%s.%s is no plain tuple", module, name);
    return NULL;
}

static int module_exec(PyObject *module) {
    Types *types = PyModule_GetState(module);
    types->fields = (PyTypeObject *)PyType_FromSpec(&link_spec);
    if (types->fields == NULL || PyModule_AddType(module, types->fields) < 0
        || PyModule_AddIntConstant(module, "INTERFACE", INTERFACE) < 0)
        return -1;
    if ((types->vector = tuple_type("tftool.geometry.rigid", "Vector3")) == NULL
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
