/* Native kernel: the inner loops of a lookup, an insert and a batch.

   Every function here has a twin: a function in Python (`history`, `solver`, `geometry.poses`,
   `batch/`) with the same result, which is the readable version. The tests run on both. Rules:

   - A function either does exactly what its twin does, with the same operations in the same order
     (built with -ffp-contract=off), or changes nothing and lets the twin run. Unusual cases (a
     refusal, a link that changes parents, a number that is not a float) go to the twin.
   - Between calls the kernel stores only which pairs of frames were looked up recently. Samples are
     in arrays that Python owns. The arrays are read and written through the buffer protocol, and every
     index and length is checked against the buffer.
   - Any call into Python may run the collector, and thereby code that changes or frees what this
     file points to. So every object used across such a call is owned (a reference of ours), and
     facts read before it are read again after it.
   - Limited API of CPython 3.11: one build serves all later versions that have a GIL. */

#define PY_SSIZE_T_CLEAN
#define Py_LIMITED_API 0x030B0000
#include <Python.h>
#include <string.h>
#include <structmember.h>

#include "_chain.h"

/* Version that `tftool.base.native` expects; a build with another version is not used. */
#define INTERFACE 7

/* Shared with Python ------------------------------------------------------ */

/* Fields of both kinds of links. Python's classes inherit them and use them by name; `History`
   documents them. */
#define PARENT_MASK 0xffffffffLL /* The bits of an origin that are the parent's number. */
typedef struct {
    PyObject_HEAD
    PyObject *records, *origins, *_newest, *_newest_pair; /* No records: a static link. */
    long long newest_stamp, oldest_stamp, limit, start, count, origin;
    char mixed;
} Link;

/* Fields that the methods below read. `Buffer` inherits and documents them. */
typedef struct {
    PyObject_HEAD
    PyObject *_paths, *_senders, *_listening, *_pending, *_numbers, *_frames;
    PyObject *_seen; /* Recent pairs, for `is_second`; NULL before the first one. */
    uint32_t random;
} Door;

/* State of the module, which Python never unloads: the types of results and of links. */
typedef struct {
    PyTypeObject *fields, *tuples[4];
    PyObject *blanks[4], *empty, *link; /* Arguments as in `TUPLES`; ""; "link". */
    newfunc make;                /* A tuple's constructor. */
    int is_bare; /* Whether these types are a header and their items, and nothing else. */
} Types;

/* The tuple types of a result: module and name, and the arguments of the constructor that give a
   tuple of the right size. */
enum { VECTOR, QUATERNION, TRANSFORM, STAMPED };
static const Py_ssize_t SIZES[4] = {3, 4, 2, 4};
static const struct {
    const char *module, *name, *blank;
} TUPLES[4] = {
    {"tftool.geometry.rigid", "Vector3", "((OOO))"},
    {"tftool.geometry.rigid", "Quaternion", "((OOOO))"},
    {"tftool.geometry.rigid", "Transform", "((OO))"},
    {"tftool.buffer.sample", "TransformStamped", "((OOOO))"},
};

/* Whether the object exists and is a tuple of that size. */
INLINE int is_tuple(PyObject *object, Py_ssize_t size) {
    return object != NULL && (PyTuple_CheckExact(object) || PyTuple_Check(object))
        && PyTuple_Size(object) == size;
}

/* Read a tuple of that many floats, mostly of the type `usual`. Returns whether it is one; never
   sets an error. */
static int read_floats(PyObject *tuple, PyTypeObject *usual, double *numbers, Py_ssize_t size) {
    if (tuple == NULL || (Py_TYPE(tuple) != usual && !PyTuple_Check(tuple))
        || PyTuple_Size(tuple) != size)
        return 0;
    for (Py_ssize_t i = 0; i < size; i++) {
        PyObject *number = PyTuple_GetItem(tuple, i);
        if (!PyFloat_CheckExact(number))
            return 0;
        numbers[i] = PyFloat_AsDouble(number);
    }
    return 1;
}

/* Read a stamp. Returns whether it is an `int` of 64 bits; never sets an error. */
static int read_stamp(PyObject *stamp, int64_t *value) {
    int overflow = 0;
    if (!PyLong_CheckExact(stamp))
        return 0;
    *value = PyLong_AsLongLongAndOverflow(stamp, &overflow);
    return !overflow;
}

/* Open the records of a moving link in `view`; on success the caller must release it. Returns
   whether the kernel can read them; never sets an error. */
static int read_records(const Link *link, int flags, Py_buffer *view) {
    /* From 3.12 on this may run Python code (`__buffer__`), which may change the link and its
       records. So own the records meanwhile, and check every number afterwards. */
    PyObject *records = Py_NewRef(link->records);
    const int opened = PyObject_GetBuffer(records, view, flags);
    Py_DECREF(records);
    if (opened < 0) {
        PyErr_Clear();
        return 0;
    }
    if (link->records == records && link->start >= 0 && link->count > link->start && !link->mixed
        && link->count <= view->len / (Py_ssize_t)sizeof(Record)
        && (uintptr_t)view->buf % sizeof(int64_t) == 0)
        return 1;
    PyBuffer_Release(view);
    return 0;
}

/* Fill an edge from a link, with its records in `view`, which the caller releases if the edge has
   records. Returns whether the kernel can use the link; never sets an error. */
static int read_link(const Link *link, Edge *edge, Py_buffer *view) {
    edge->records = NULL;
    if (link->records == NULL)
        return read_floats(link->_newest, &PyTuple_Type, edge->fixed, 7);
    if (!read_records(link, PyBUF_SIMPLE, view))
        return 0;
    edge->records = (const Record *)view->buf + link->start;
    edge->last = (Py_ssize_t)(link->count - link->start) - 1;
    edge->newest = link->newest_stamp;
    edge->oldest = edge->last > 0 ? link->oldest_stamp : edge->newest;
    edge->rate = (double)edge->last / (double)((uint64_t)edge->newest - (uint64_t)edge->oldest);
    return 1;
}

/* Most links of a chain solved here; Python solves longer ones. */
#define MOST_LINKS 128

/* Up to this many links are on the stack; memory for more is allocated. */
#define FEW_LINKS 16

/* A chain with the views that own the records of its links until `close_chain`. */
typedef struct {
    Chain chain;
    Py_buffer *views;
    void *more; /* Memory for many edges and views, or NULL; freed by `close_chain`. */
    Edge few_edges[FEW_LINKS];
    Py_buffer few_views[FEW_LINKS];
} OpenChain;

/* Open the links of two tuples as one chain. A `time` of 0 becomes the newest stamp for which every
   moving link has data, as in `Path.latest`. Adjacent static links become one edge, as in
   `path.folded`. Returns whether the kernel can use all links; never sets an error. The caller
   must call `close_chain` in either case. */
static int open_chain(OpenChain *held, PyTypeObject *fields, PyObject *up, PyObject *down,
                      int64_t *time) {
    Chain *chain = &held->chain;
    int64_t latest = 0;
    const Py_ssize_t ups = PyTuple_Size(up), total = ups + PyTuple_Size(down);
    PyTypeObject *known = fields;
    chain->count = 0;
    chain->ups = ups;
    chain->edges = held->few_edges;
    held->views = held->few_views;
    held->more = NULL;
    if (total > MOST_LINKS)
        return 0;
    if (total > FEW_LINKS) {
        held->more = PyMem_Malloc((size_t)total * (sizeof(Edge) + sizeof(Py_buffer)));
        if (held->more == NULL)
            return 0;
        chain->edges = held->more;
        held->views = (Py_buffer *)(chain->edges + total);
    }
    for (Py_ssize_t i = 0; i < total; i++) {
        PyObject *link = i < ups ? PyTuple_GetItem(up, i) : PyTuple_GetItem(down, i - ups);
        Edge *edge = &chain->edges[chain->count];
        if (Py_TYPE(link) != known && !PyObject_TypeCheck(link, fields))
            return 0;
        known = Py_TYPE(link);
        if (!read_link((const Link *)link, edge, &held->views[chain->count]))
            return 0;
        if (edge->records == NULL && i != 0 && i != ups && edge[-1].records == NULL) {
            compose(edge->fixed, edge[-1].fixed, 1, 1);
            chain->ups -= i < ups;
            continue;
        }
        chain->count++;
        const int64_t newest = ((const Link *)link)->newest_stamp; /* 0 if it never moves. */
        if (newest != 0 && (newest < latest || latest == 0))
            latest = newest;
        /* Prefetch the samples while the other links are opened. */
        if (edge->records != NULL)
            edge->here = aim(edge, *time != 0 ? *time : newest);
    }
    *time = *time != 0 ? *time : latest;
    return 1;
}

/* Release the records of all open links, and the memory of the chain. */
static void close_chain(OpenChain *held) {
    for (Py_ssize_t i = 0; i < held->chain.count; i++)
        if (held->chain.edges[i].records != NULL)
            PyBuffer_Release(&held->views[i]);
    PyMem_Free(held->more);
}

/* Lookups ----------------------------------------------------------------- */

/* Whether two objects are equal plain strings; an object of another type equals nothing. */
static int same_text(PyObject *known, PyObject *given) {
    return PyUnicode_CheckExact(known)
        && (known == given
            || (PyUnicode_CheckExact(given) && PyUnicode_Compare(known, given) == 0));
}

/* Return the value of a key in a dictionary, a new reference; NULL without an error if there is
   none, or the arguments are no dictionary and no plain string.

   Names in a buffer are plain strings, so that no comparison runs code. If a key is nevertheless an
   instance of a subclass, its `__eq__` could run here and free the dictionary or the value: so both
   are owned. An exception is dropped here, and raised again by the plain twin. */
static PyObject *value_of(PyObject *dictionary, PyObject *name) {
    if (dictionary == NULL || !PyDict_Check(dictionary) || !PyUnicode_CheckExact(name))
        return NULL;
    Py_INCREF(dictionary);
    PyObject *value = PyDict_GetItemWithError(dictionary, name);
    if (value != NULL)
        Py_INCREF(value);
    else if (PyErr_Occurred())
        PyErr_Clear();
    Py_DECREF(dictionary);
    return value;
}

/* Follow the parents of a frame up to its root. Stores the links, new references that the caller
   owns, in `links`, and the number of the root in `*root`, which holds the frame's number at first.
   Returns the number of links, or -1, without references, if a link is not plain, has samples of
   several parents, or there are more than MOST_LINKS. Never sets an error. */
static Py_ssize_t climb(const Types *types, PyObject *frames, PyObject **links, int64_t *root) {
    Py_ssize_t count = 0;
    for (; count < MOST_LINKS; count++) {
        if (*root < 0 || *root >= PyList_Size(frames))
            break;
        PyObject *link = PyObject_GetAttr(PyList_GetItem(frames, (Py_ssize_t)*root), types->link);
        if (link == Py_None) {
            Py_DECREF(link);
            return count;
        }
        if (link == NULL || !PyObject_TypeCheck(link, types->fields)
            || ((Link *)link)->mixed || ((Link *)link)->origin < 0) {
            Py_XDECREF(link);
            break;
        }
        links[count] = link;
        *root = ((Link *)link)->origin & PARENT_MASK;
    }
    PyErr_Clear();
    while (count > 0)
        Py_DECREF(links[--count]);
    return -1;
}

/* Return a new tuple of links; it takes their references, also on failure (NULL, error set). */
static PyObject *pack(PyObject **links, Py_ssize_t count) {
    PyObject *tuple = PyTuple_New(count < 0 ? 0 : count);
    for (Py_ssize_t i = 0; i < count; i++)
        if (tuple == NULL)
            Py_DECREF(links[i]);
        else
            PyTuple_SetItem(tuple, i, links[i]);
    return tuple;
}

/* Number of pairs in the table of recent lookups. A pair has one possible place in it. */
#define SEEN 4096

/* Whether a pair of frames was looked up recently; if not, remember the pair. Python caches the
   path of a pair only at its second lookup, so that a single lookup takes no memory. Never sets an
   error. */
static int is_second(Door *door, int64_t target, int64_t source) {
    const int64_t pair = (target + 1) << 32 ^ source;
    const Py_ssize_t size = SEEN * sizeof pair;
    if (door->_seen == NULL && (door->_seen = PyByteArray_FromStringAndSize(NULL, size)) != NULL)
        memset(PyByteArray_AsString(door->_seen), 0, (size_t)size);
    if (door->_seen == NULL || PyByteArray_Size(door->_seen) != size) {
        PyErr_Clear();
        return 1;
    }
    const uint64_t mixed = (uint64_t)pair * 0x9e3779b97f4a7c15ULL; /* Knuth's multiplier. */
    char *place = PyByteArray_AsString(door->_seen) + mixed / (UINT64_MAX / SEEN + 1) * sizeof pair;
    int64_t held;
    memcpy(&held, place, sizeof held);
    /* If two pairs share a place and are looked up by turns, they would always replace each other.
       So the older pair stays every second time, at random (with the constants of C's `rand`). */
    door->random = door->random * 1103515245 + 12345;
    if (held == 0 || door->random >> 31)
        memcpy(place, &pair, sizeof pair);
    return held == pair;
}

/* Return the links between two frames without a cached path as `(up, down)`, a new reference, as
   `FrameTree.walk` finds them if every link has data. NULL, without an error, if the twin must
   find them. */
static PyObject *walk(Door *door, const Types *types, PyObject *target, PyObject *source) {
    PyObject *up[MOST_LINKS], *down[MOST_LINKS], *path = NULL;
    PyObject *first = value_of(door->_numbers, source), *last = value_of(door->_numbers, target);
    int64_t top, end;
    const int is_plain = first != NULL && last != NULL && first != last && read_stamp(first, &top)
        && read_stamp(last, &end) && door->_frames != NULL && PyList_Check(door->_frames)
        && !is_second(door, end, top);
    Py_XDECREF(first);
    Py_XDECREF(last);
    if (!is_plain)
        return NULL;
    PyObject *frames = Py_NewRef(door->_frames);
    Py_ssize_t ups = climb(types, frames, up, &top);
    Py_ssize_t downs = ups < 0 ? -1 : climb(types, frames, down, &end);
    Py_DECREF(frames);
    /* Links above the common ancestor are on both sides. */
    while (ups > 0 && downs > 0 && up[ups - 1] == down[downs - 1]) {
        Py_DECREF(up[--ups]);
        Py_DECREF(down[--downs]);
    }
    /* `pack` takes over the references to the links, even if there is no memory. */
    PyObject *sides[2] = {pack(up, ups), pack(down, downs)};
    if (downs >= 0 && top == end && sides[0] != NULL && sides[1] != NULL)
        path = PyTuple_Pack(2, sides[0], sides[1]);
    Py_XDECREF(sides[0]);
    Py_XDECREF(sides[1]);
    PyErr_Clear();
    return path;
}

/* Return a new tuple of one of the types, to be filled; NULL with an error set on failure. The
   collector does not track the tuple, because numbers and plain strings form no cycle. */
static PyObject *blank(const Types *types, int i) {
    if (types->is_bare) {
        /* To make the tuple without its constructor saves 9 % of a lookup. Every item must be NULL
           or valid, even if an error frees the tuple before it is filled. */
        PyVarObject *bare = PyObject_GC_NewVar(PyVarObject, types->tuples[i], SIZES[i]);
        if (bare != NULL)
            memset(bare + 1, 0, (size_t)SIZES[i] * sizeof(PyObject *));
        return (PyObject *)bare;
    }
    PyObject *made = types->make(types->tuples[i], types->blanks[i], NULL);
    if (made != NULL)
        PyObject_GC_UnTrack(made);
    return made;
}

/* Store an item in a tuple, if both exist; the tuple takes over the reference. Returns the item,
   borrowed; on failure releases the item and returns NULL with an error set. */
static PyObject *set(PyObject *tuple, Py_ssize_t place, PyObject *item) {
    if (tuple != NULL && item != NULL)
        return PyTuple_SetItem(tuple, place, item) == 0 ? item : NULL;
    Py_XDECREF(item);
    return NULL;
}

/* Return a new TransformStamped whose pose has no numbers yet; NULL, without an error, if there is
   no memory. */
static PyObject *prepare(const Types *types, int64_t stamp, PyObject *target, PyObject *source) {
    PyObject *made = blank(types, STAMPED), *transform = set(made, 3, blank(types, TRANSFORM));
    if (set(transform, 0, blank(types, VECTOR)) && set(transform, 1, blank(types, QUATERNION))
        && set(made, 0, PyLong_FromLongLong(stamp)) && set(made, 1, Py_NewRef(target))
        && set(made, 2, Py_NewRef(source)))
        return made;
    Py_XDECREF(made);
    PyErr_Clear();
    return NULL;
}

/* Fill in the pose of a prepared result, whose reference is taken, and return it; NULL with an
   error set on failure. */
static PyObject *answer(PyObject *made, const double *pose) {
    PyObject *transform = PyTuple_GetItem(made, 3);
    PyObject *halves[2] = {PyTuple_GetItem(transform, 0), PyTuple_GetItem(transform, 1)};
    for (int k = 0; k < 7; k++)
        if (!set(halves[k > 2], k > 2 ? k - 3 : k, PyFloat_FromDouble(pose[k]))) {
            Py_DECREF(made);
            return NULL;
        }
    return made;
}

/* Solve the pose of source in target by a cached or new path; a `*time` of 0 becomes the latest
   common stamp. If `made` is given, `*made` becomes the prepared result, which the caller owns,
   also if 0 is returned. Returns 0 if the twin must answer; never sets an error. */
static int solve_path(Door *door, const Types *types, PyObject *target, PyObject *source,
                      int64_t *time, double *pose, PyObject **made) {
    PyObject *of_target = value_of(door->_paths, target), *up, *down;
    PyObject *path = value_of(of_target, source);
    OpenChain held;
    int is_open = 0;
    if (path == NULL)
        path = walk(door, types, target, source);
    if ((is_tuple(path, 3) || is_tuple(path, 2)) && PyTuple_Check(up = PyTuple_GetItem(path, 0))
        && PyTuple_Check(down = PyTuple_GetItem(path, 1))) {
        /* The result is prepared here, while memory fetches the samples. Making tuples may run the
           collector, and thereby code that drops the path from the buffer: so `path` is owned. */
        is_open = open_chain(&held, types->fields, up, down, time)
            && (made == NULL || (*made = prepare(types, *time, target, source)) != NULL);
        if (is_open)
            solve_one(&held.chain, *time, pose);
        close_chain(&held);
    }
    Py_XDECREF(path);
    Py_XDECREF(of_target);
    return is_open && pose[6] == pose[6];
}

/* Call the plain twin, a method of `Buffer`, with the same arguments; return its result. */
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

/* `solve_path` for positional arguments: a target, a source and, optionally, a time. */
static int solve_plain(PyObject *self, const Types *types, PyObject *const *args, Py_ssize_t count,
                       PyObject *names, int64_t *time, double *pose, PyObject **made) {
    *time = 0;
    return names == NULL && (count == 2 || (count == 3 && read_stamp(args[2], time)))
        && solve_path((Door *)self, types, args[0], args[1], time, pose, made);
}

/* Each method returns a new reference as its entry in `door_methods` says, or calls its twin. */
METHOD(lookup_transform) {
    const Types *types = PyType_GetModuleState(door);
    PyObject *made = NULL;
    int64_t time;
    double pose[7];
    if (solve_plain(self, types, args, count, names, &time, pose, &made))
        return answer(made, pose);
    Py_XDECREF(made);
    return PLAINLY(lookup_transform);
}

/* Solves the lookup, and returns only whether there is a result. */
METHOD(can_transform) {
    int64_t time;
    double pose[7];
    return solve_plain(self, PyType_GetModuleState(door), args, count, names, &time, pose, NULL)
        ? Py_NewRef(Py_True) : PLAINLY(can_transform);
}

/* Like `solve_path`, but the two frames may be equal: the pose is then the identity. The other lookup
   must have found that frame. */
static int solve_leg(Door *door, const Types *types, PyObject *target, PyObject *source,
                     int64_t *time, double *pose) {
    for (int k = 0; k < 7; k++)
        pose[k] = k == 6;
    return (*time != 0 && same_text(target, source))
        || solve_path(door, types, target, source, time, pose, NULL);
}

/* The product of two lookups. In all other cases the twin answers or raises the error. */
METHOD(lookup_transform_full) {
    const Types *types = PyType_GetModuleState(door);
    Door *buffer = (Door *)self;
    PyObject *made;
    int64_t here, there;
    double inner[7], outer[7];
    if (names == NULL && count == 5 && read_stamp(args[1], &here) && read_stamp(args[3], &there)
        && !same_text(args[0], args[2]) && solve_leg(buffer, types, args[4], args[2], &there, inner)
        && solve_leg(buffer, types, args[0], args[4], &here, outer)) {
        compose(outer, inner, 1, 1);
        normalise(inner + 3, 1, 1);
        if ((made = prepare(types, here, args[0], args[2])) != NULL)
            return answer(made, inner);
    }
    return PLAINLY(lookup_transform_full);
}

/* Inserts ----------------------------------------------------------------- */

/* Whether the records of a link are an array that no batch is reading, so that samples may be moved
   within it. Never sets an error. */
static int is_free(const Link *link) {
    /* An array with exported buffers refuses to delete anything, even an empty slice. The call may
       run the collector, and thereby code that gives the link other records. */
    PyObject *held = Py_NewRef(link->records);
    const int done = PySequence_DelSlice(held, 0, 0) == 0 && link->records == held;
    Py_DECREF(held);
    PyErr_Clear();
    return done;
}

/* Pruned records are removed once there are more than SLACK and a SLACK_PARTth of all. */
#define SLACK 32
#define SLACK_PART 8

/* Insert a sample: `History.insert` for a stamp that no other sample has, if all samples have the
   same origin. If `may_grow`, the link gets more memory if necessary. Returns whether the sample was
   inserted; never sets an error. */
static int put(Link *link, int64_t stamp, int64_t origin, double *pose, int may_grow) {
    Py_buffer view;
    const double square = square_of(pose + 3, 1);
    if (!(1.0 - ROUNDING < square && square < 1.0 + ROUNDING
          && pose[0] + pose[1] + pose[2] < HUGE_VAL))
        return 0;
    const int is_full = link->start > SLACK + link->count / SLACK_PART;
    /* `is_free` may change anything read before it, so it comes before the checks below. */
    if (link->records == NULL || ((is_full || stamp <= link->newest_stamp) && !is_free(link))
        || !read_records(link, PyBUF_WRITABLE, &view))
        return 0;
    /* Until the records are released no Python code runs, so these facts stay true. */
    if (link->origins != Py_None || link->origin != origin || link->limit < 0
        || is_full != (link->start > SLACK + link->count / SLACK_PART)) {
        PyBuffer_Release(&view);
        return 0;
    }
    if (may_grow && !is_full && link->count == view.len / (Py_ssize_t)sizeof(Record)) {
        /* Python reserves memory, and may change all that was read above: so read it again. */
        PyBuffer_Release(&view);
        PyObject *done = PyObject_CallMethod((PyObject *)link, "_have_room", NULL);
        PyErr_Clear();
        Py_XDECREF(done);
        return done != NULL && put(link, stamp, origin, pose, 0);
    }
    Record *records = view.buf;
    const int64_t newest = link->newest_stamp;
    const uint64_t limit = (uint64_t)link->limit;
    if (is_full) {
        link->count -= link->start;
        memmove(records, records + link->start, sizeof(Record) * link->count);
        link->start = 0;
    }
    Py_ssize_t start = (Py_ssize_t)link->start, count = (Py_ssize_t)link->count, place = count;
    int64_t oldest = link->oldest_stamp;
    while ((uint64_t)newest - (uint64_t)oldest > limit && start + 1 < count)
        oldest = records[++start].stamp;
    if (stamp < oldest)
        place = start - 1;
    else
        while (place > start && records[place - 1].stamp > stamp)
            place--;
    const int fits = place < start
        ? place >= 0 && (uint64_t)newest - (uint64_t)stamp <= limit
        : place > start && records[place - 1].stamp != stamp
            && count < view.len / (Py_ssize_t)sizeof(Record);
    PyObject *pair = NULL, *before = NULL;
    if (fits) {
        canonical(pose + 3, 1);
        if (place < start) {
            oldest = stamp;
            start = place;
        }
        else if (place < count++)
            memmove(records + place + 1, records + place, sizeof(Record) * (count - 1 - place));
        records[place].stamp = stamp;
        memcpy(records[place].pose, pose, sizeof records[place].pose);
        link->start = start;
        link->count = count;
        link->oldest_stamp = oldest;
        link->newest_stamp = stamp > newest ? stamp : newest;
        pair = link->_newest_pair;
        before = link->_newest;
        link->_newest_pair = Py_NewRef(Py_None);
        link->_newest = Py_NewRef(Py_None);
    }
    PyBuffer_Release(&view);
    /* Released last: this may run Python code. */
    Py_XDECREF(before);
    Py_XDECREF(pair);
    return fits;
}

/* Insert a sample if the buffer already knows its child, parent and authority. Returns whether the
   sample was inserted; never sets an error. */
static int insert(const Door *door, const Types *types, PyObject *sample, PyObject *authority) {
    int64_t stamp, origin;
    double pose[7];
    if (Py_TYPE(sample) != types->tuples[STAMPED] || PyTuple_Size(sample) != 4)
        return 0;
    /* Owned until the end, because code that runs during the insert may drop it from the buffer. */
    PyObject *sender = value_of(door->_senders, PyTuple_GetItem(sample, 2));
    PyObject *transform = PyTuple_GetItem(sample, 3), *link;
    const int done = is_tuple(sender, 4)
        && same_text(PyTuple_GetItem(sender, 0), PyTuple_GetItem(sample, 1))
        && same_text(PyTuple_GetItem(sender, 1), authority)
        && read_stamp(PyTuple_GetItem(sender, 2), &origin)
        && Py_TYPE(transform) == types->tuples[TRANSFORM] && PyTuple_Size(transform) == 2
        && read_stamp(PyTuple_GetItem(sample, 0), &stamp)
        && read_floats(PyTuple_GetItem(transform, 0), types->tuples[VECTOR], pose, 3)
        && read_floats(PyTuple_GetItem(transform, 1), types->tuples[QUATERNION], pose + 3, 4)
        && PyObject_TypeCheck(link = PyTuple_GetItem(sender, 3), types->fields)
        && put((Link *)link, stamp, origin, pose, 1);
    Py_XDECREF(sender);
    return done;
}

/* After the insert, Python notifies listeners and pending requests. */
METHOD(set_transform) {
    const Types *types = PyType_GetModuleState(door);
    const Door *buffer = (const Door *)self;
    PyObject *authority = count == 2 ? args[1] : types->empty;
    if (names != NULL || count < 1 || count > 2 || buffer->_listening == NULL
        || !PyTuple_Check(buffer->_listening) || buffer->_pending == NULL
        || !PyDict_Check(buffer->_pending) || !insert(buffer, types, args[0], authority))
        return PLAINLY(set_transform);
    if (PyTuple_Size(buffer->_listening) > 0 || PyDict_Size(buffer->_pending) > 0) {
        PyObject *done = PyObject_CallMethod(self, "_tell_of", "OO", args[0], authority);
        if (done == NULL)
            return NULL;
        Py_DECREF(done);
    }
    Py_RETURN_TRUE;
}

/* Batch lookups ----------------------------------------------------------- */

PyDoc_STRVAR(solve_doc, "solve(up, down, times, translations, rotations, valid)\n--\n\n"
"Write the poses of a path at many times, NaN where there is no data. Returns the number of rows\n"
"without data, or None if the kernel cannot use a link. Other Python threads run meanwhile; the\n"
"records must not change.");

static PyObject *solve(PyObject *module, PyObject *args) {
    static const Py_ssize_t sizes[4] = {8, 24, 32, 1};
    const Types *types = PyModule_GetState(module);
    Py_buffer views[4];
    PyObject *up, *down, *result = NULL;
    Py_ssize_t missing = -1;
    int64_t first = 0;
    OpenChain held;
    if (!PyArg_ParseTuple(args, "O!O!y*w*w*w*:solve", &PyTuple_Type, &up, &PyTuple_Type, &down,
                          &views[0], &views[1], &views[2], &views[3]))
        return NULL;
    const Py_ssize_t rows = views[0].len / sizes[0];
    int fits = 1;
    for (int i = 0; i < 4; i++)
        fits &= views[i].len == rows * sizes[i]
            && (i == 3 || rows == 0 || (uintptr_t)views[i].buf % 8 == 0);
    if (!fits)
        PyErr_SetString(PyExc_ValueError, "moments, translations, rotations and valid are "
            "aligned rows of 8, 24, 32 and 1 bytes, of each equally many");
    else {
        if (open_chain(&held, types->fields, up, down, &first)) {
            Py_BEGIN_ALLOW_THREADS
            missing = solve_rows(&held.chain, rows, views[0].buf, views[1].buf, views[2].buf,
                                 views[3].buf);
            Py_END_ALLOW_THREADS
        }
        close_chain(&held);
        result = missing < 0 ? Py_NewRef(Py_None) : PyLong_FromSsize_t(missing);
    }
    for (int i = 0; i < 4; i++)
        PyBuffer_Release(&views[i]);
    return result;
}

/* The module ------------------------------------------------------------- */

#define MEMBER(type, name, kind) {#name, kind, offsetof(type, name), 0, NULL}
#define OBJECT(type, name) MEMBER(type, name, T_OBJECT_EX)
#define NUMBER(name) MEMBER(Link, name, T_LONGLONG)
static PyMemberDef link_members[] = {
    OBJECT(Link, records), OBJECT(Link, origins), OBJECT(Link, _newest), OBJECT(Link, _newest_pair),
    NUMBER(newest_stamp), NUMBER(oldest_stamp), NUMBER(limit), NUMBER(start), NUMBER(count),
    NUMBER(origin), MEMBER(Link, mixed, T_BOOL), {NULL, 0, 0, 0, NULL},
};
static PyMemberDef door_members[] = {
    OBJECT(Door, _paths), OBJECT(Door, _senders), OBJECT(Door, _listening), OBJECT(Door, _pending),
    OBJECT(Door, _numbers), OBJECT(Door, _frames), OBJECT(Door, _seen),
    {NULL, 0, 0, 0, NULL},
};

/* The objects at the beginning of a link or a buffer. */
#define HELD_OF(self) ((PyObject **)((char *)(self) + sizeof(PyObject)))

/* The collector's functions of a class that owns that many objects: `traverse` visits them and, as
   for every heap type, the type; `clear` releases them to break a cycle. */
#define COLLECTED(name, held)                                                                     \
    static int name##_traverse(PyObject *self, visitproc visit, void *arg) {                      \
        Py_VISIT(Py_TYPE(self));                                                                  \
        for (int i = 0; i < held; i++)                                                            \
            Py_VISIT(HELD_OF(self)[i]);                                                           \
        return 0;                                                                                 \
    }                                                                                             \
    static int name##_clear(PyObject *self) {                                                     \
        for (int i = 0; i < held; i++)                                                            \
            Py_CLEAR(HELD_OF(self)[i]);                                                           \
        return 0;                                                                                 \
    }
COLLECTED(link, 4)
COLLECTED(door, 7)

#define CALL METH_METHOD | METH_FASTCALL | METH_KEYWORDS
#define ENTRY(name, doc) {#name, (PyCFunction)(void (*)(void))name, CALL, #name doc}
static PyMethodDef door_methods[] = {
    ENTRY(set_transform, "($self, transform, authority='')\n--\n\n"
        "Insert one sample of a moving frame, published by `authority`.\n\n"
        "Returns True if stored; False, with a line in the log, if refused."),
    ENTRY(lookup_transform, "($self, target_frame, source_frame, time=0)\n--\n\n"
        "Return the pose of source in target, which maps points from source to target.\n\n"
        "A `time` of 0 means the newest stamp for which the whole chain has data. The stamp of\n"
        "the result is the time of the pose, or 0 if every link is static.\n\n"
        "Raises TransformException if there is no such transform, TypeError if `time` is no int."),
    ENTRY(lookup_transform_full, "($self, target_frame, target_time, source_frame, source_time, "
        "fixed_frame)\n--\n\n"
        "Return the pose of source at its time in target at target's time.\n\n"
        "Both are looked up relative to `fixed_frame`, which is assumed not to move in between.\n\n"
        "Raises TransformException as `lookup_transform` does; frames are always checked."),
    ENTRY(can_transform, "($self, target_frame, source_frame, time=0)\n--\n\n"
        "Whether `lookup_transform` would succeed; false for an unknown frame or missing data."),
    {NULL, NULL, 0, NULL},
};
static PyMethodDef no_methods[] = {{NULL, NULL, 0, NULL}};
static PyMethodDef module_methods[] = {
    {"solve", solve, METH_VARARGS, solve_doc}, {NULL, NULL, 0, NULL},
};

/* Return a new class, a new reference, and add it to the module; NULL with an error set on
   failure. */
static PyTypeObject *holder(PyObject *module, const char *name, size_t size, const char *doc,
                            PyMemberDef *members, PyMethodDef *methods, traverseproc traverse,
                            inquiry clear) {
    PyType_Slot slots[] = {
        {Py_tp_doc, (void *)doc}, {Py_tp_members, members}, {Py_tp_methods, methods},
        {Py_tp_traverse, (void *)traverse}, {Py_tp_clear, (void *)clear}, {0, NULL},
    };
    PyType_Spec spec = {name, (int)size, 0,
                        Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_HAVE_GC, slots};
    PyObject *made = PyType_FromModuleAndSpec(module, &spec, NULL);
    if (made != NULL && PyModule_AddType(module, (PyTypeObject *)made) < 0)
        Py_CLEAR(made);
    return (PyTypeObject *)made;
}

/* Fill the module and its state. Returns -1 with an error set on failure. */
static int module_exec(PyObject *module) {
    Types *types = PyModule_GetState(module);
    PyTypeObject *door = holder(module, "tftool.buffer._kernel.Door", sizeof(Door),
        "Native versions of the methods of a buffer that are called most.", door_members,
        door_methods, door_traverse, door_clear);
    Py_XDECREF((PyObject *)door);
    if (door == NULL
        || (types->fields = holder(module, "tftool.buffer._kernel.Fields", sizeof(Link),
            "Fields of a link, in memory that the kernel can read.",
            link_members, no_methods, link_traverse, link_clear)) == NULL
        || (types->empty = PyUnicode_InternFromString("")) == NULL
        || (types->link = PyUnicode_InternFromString("link")) == NULL)
        return -1;
    types->make = (newfunc)PyType_GetSlot(&PyTuple_Type, Py_tp_new);
    /* From 3.14 on a tuple stores its hash, which only the constructor marks as unknown. */
    types->is_bare = Py_Version < 0x030E0000;
    for (int i = 0; i < 4; i++) {
        PyObject *home = PyImport_ImportModule(TUPLES[i].module);
        PyObject *type = home == NULL ? NULL : PyObject_GetAttrString(home, TUPLES[i].name);
        Py_XDECREF(home);
        types->tuples[i] = (PyTypeObject *)type;
        PyObject *size = type == NULL ? NULL : PyObject_GetAttrString(type, "__basicsize__");
        types->is_bare &= size != NULL && PyLong_AsLong(size) == (long)sizeof(PyVarObject);
        Py_XDECREF(size);
        if (size == NULL
            || (types->blanks[i] = Py_BuildValue(TUPLES[i].blank, Py_None, Py_None, Py_None,
                                                 Py_None)) == NULL)
            return -1;
    }
    return PyModule_AddIntConstant(module, "INTERFACE", INTERFACE);
}

static PyModuleDef_Slot module_slots[] = {{Py_mod_exec, module_exec}, {0, NULL}};

static PyModuleDef definition = {
    PyModuleDef_HEAD_INIT, "tftool.buffer._kernel", "The native kernel; see `_kernel.pyi`.",
    sizeof(Types), module_methods, module_slots, NULL, NULL, NULL,
};

PyMODINIT_FUNC
PyInit__kernel(void) {
    return PyModuleDef_Init(&definition);
}
