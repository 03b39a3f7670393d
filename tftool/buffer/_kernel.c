/* The native kernel: what a lookup, an insert and a batch spend their time in.

   Everything here has a twin in Python that says the same thing for reading (`history`, `path`,
   `geometry.poses`, `batch/`), and the tests run on both. Its rules:

   - It does exactly what its twin does, with the same operations in the same order (built with
     -ffp-contract=off), or it does nothing, and the twin takes over. What is unusual (a refusal,
     a link that changes parents, a number that is no float, no room) is left to it.
   - It keeps nothing between calls but which pairs of frames were asked for lately. Samples lie
     in arrays that Python holds, and are read and written through the buffer protocol; every index
     and length is checked against the buffer.
   - The limited API of CPython 3.11: one build serves every later version with a GIL. */

#define PY_SSIZE_T_CLEAN
#define Py_LIMITED_API 0x030B0000
#include <Python.h>
#include <string.h>
#include <structmember.h>

#include "_chain.h"

/* What `tftool.base.native` expects; a build of another interface is not used. */
#define INTERFACE 7

/* What is shared with Python --------------------------------------------- */

/* The fields of both kinds of links. Python's classes inherit them, and Python's code reads and
   writes them by their names; see `History` for what they mean. */
#define PARENT_MASK 0xffffffffLL /* The bits of an origin that are the parent's number. */
typedef struct {
    PyObject_HEAD
    PyObject *records, *origins, *_newest, *_newest_pair; /* No records: it never moves. */
    long long newest_stamp, oldest_stamp, limit, start, count, origin;
    char mixed;
} Link;

/* What the methods of a buffer read: `Buffer` inherits it; see there. */
typedef struct {
    PyObject_HEAD
    PyObject *_paths, *_senders, *_listening, *_pending, *_numbers, *_frames;
    PyObject *_seen; /* Pairs looked up lately, for `is_second`; NULL before the first one. */
    uint32_t random;
} Door;

/* What answers are made of and read by; the state of the module, which Python never unloads. */
typedef struct {
    PyTypeObject *fields, *tuples[4];
    PyObject *blanks[4], *empty, *link; /* As in `TUPLES`; ""; "link". */
    newfunc make;                /* A tuple's constructor. */
    allocfunc allocate;          /* A tuple's memory, cleared. */
} Types;

/* The tuples an answer is made of: where their types are found, and what the arguments are that
   make one of their size. */
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

/* Whether something is there, and a tuple of that size. */
INLINE int is_tuple(PyObject *object, Py_ssize_t size) {
    return object != NULL && PyTuple_Check(object) && PyTuple_Size(object) == size;
}

/* That many floats of a tuple. Returns whether that is what it is; never sets an error. */
static int read_floats(PyObject *tuple, double *numbers, Py_ssize_t size) {
    if (!is_tuple(tuple, size))
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

/* Open the records of a moving link in `view`, which the caller releases. Returns whether the
   kernel can read them; never sets an error. */
static int read_records(const Link *link, int flags, Py_buffer *view) {
    /* From 3.12 on this may run Python code (`__buffer__`), which may change the link and its
       records: the reference is ours meanwhile, and every number is checked afterwards. */
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

/* Make a link ready, its records in `view`. Returns whether it is plain; never sets an error. */
static int read_link(const Link *link, Edge *edge, Py_buffer *view) {
    edge->records = NULL;
    if (link->records == NULL)
        return read_floats(link->_newest, edge->fixed, 7);
    if (!read_records(link, PyBUF_SIMPLE, view))
        return 0;
    edge->records = (const Record *)view->buf + link->start;
    edge->last = (Py_ssize_t)(link->count - link->start) - 1;
    edge->newest = link->newest_stamp;
    edge->oldest = edge->last > 0 ? link->oldest_stamp : edge->newest;
    edge->rate = (double)edge->last / (double)((uint64_t)edge->newest - (uint64_t)edge->oldest);
    return 1;
}

/* Links of the longest chain solved here; Python solves longer ones. */
#define MOST_LINKS 128

/* So many of them lie on the stack; room for more is allocated. */
#define FEW_LINKS 16

/* A chain, and the views that own the records of its links until `close_chain`. */
typedef struct {
    Chain chain;
    Py_buffer *views;
    void *more; /* Memory for edges and views, where they are many; freed by `close_chain`. */
    Edge few_edges[FEW_LINKS];
    Py_buffer few_views[FEW_LINKS];
} OpenChain;

/* Make the links of two tuples ready, to be closed in any case; `time` is when they are read
   first: 0 becomes the newest moment for which every moving link has data, as in `Path.latest`.
   Neighbours that never move become one edge, as in `path.folded`. Returns whether all are plain;
   never sets an error. */
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
        /* Memory brings what is read first while the other links are made ready. */
        if (edge->records != NULL)
            edge->here = aim(edge, *time != 0 ? *time : newest);
    }
    *time = *time != 0 ? *time : latest;
    return 1;
}

/* Let go of the records of the links that are ready. */
static void close_chain(OpenChain *held) {
    for (Py_ssize_t i = 0; i < held->chain.count; i++)
        if (held->chain.edges[i].records != NULL)
            PyBuffer_Release(&held->views[i]);
    PyMem_Free(held->more);
}

/* Looking up -------------------------------------------------------------- */

/* Whether two plain strings are equal; one that is none is equal to nothing. */
static int same_text(PyObject *known, PyObject *given) {
    return PyUnicode_CheckExact(known)
        && (known == given
            || (PyUnicode_CheckExact(given) && PyUnicode_Compare(known, given) == 0));
}

/* Return what a dictionary holds under a plain string, a new reference; NULL if there is nothing,
   or it is no dictionary, or no such string. Never sets an error.

   Names in a buffer are plain strings, so that no comparison runs code. Were one another string
   all the same, its `__eq__` could run here and drop the dictionary or the value: that is why both
   are owned. What it raises, the plain twin raises again. */
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

/* Follow the newest parents of a frame up to the root: put the links, new references, into
   `links`, and the root's number in place of the frame's. Returns how many; -1 where a link is not plain, has
   samples of several parents, or there are too many. Never sets an error. */
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

/* Return a tuple of these links, whose references it takes; NULL with an error set on failure. */
static PyObject *pack(PyObject **links, Py_ssize_t count) {
    PyObject *tuple = PyTuple_New(count < 0 ? 0 : count);
    for (Py_ssize_t i = 0; i < count; i++)
        if (tuple == NULL)
            Py_DECREF(links[i]);
        else
            PyTuple_SetItem(tuple, i, links[i]);
    return tuple;
}

/* So many pairs of frames are remembered, mostly each in a place of its own. */
#define SEEN 4096

/* Whether a pair was looked up lately; as a rule it is remembered. What is asked for again is left to
   Python, which caches the path; what is asked for once takes no memory. Never sets an error. */
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
    /* Of two pairs that share a place and take turns, neither would ever be known: the older one
       stays every second time, at random (the numbers are those of C's `rand`). */
    door->random = door->random * 1103515245 + 12345;
    if (held == 0 || door->random >> 31)
        memcpy(place, &pair, sizeof pair);
    return held == pair;
}

/* Return the links between two frames that no path is cached for, as `(up, down)`, a new
   reference: `FrameTree.walk` where every link has data. NULL if that is not plain. Never sets an
   error. */
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
    /* What lies above the common ancestor is on both sides. */
    while (ups > 0 && downs > 0 && up[ups - 1] == down[downs - 1]) {
        Py_DECREF(up[--ups]);
        Py_DECREF(down[--downs]);
    }
    /* These take the references to the links, also where there is no memory. */
    PyObject *sides[2] = {pack(up, ups), pack(down, downs)};
    if (downs >= 0 && top == end && sides[0] != NULL && sides[1] != NULL)
        path = PyTuple_Pack(2, sides[0], sides[1]);
    Py_XDECREF(sides[0]);
    Py_XDECREF(sides[1]);
    PyErr_Clear();
    return path;
}

/* A new tuple of one of the types, to be filled; NULL with an error set on failure. The collector
   is never to see it: of numbers and plain strings is no circle. */
static PyObject *blank(const Types *types, int i) {
    /* From 3.14 on a tuple keeps its hash, 0 in memory that is only cleared: it takes Python's own
       constructor, and a tuple to copy, to say that there is none yet. */
    PyObject *made = Py_Version < 0x030E0000
        ? types->allocate(types->tuples[i], SIZES[i])
        : types->make(types->tuples[i], types->blanks[i], NULL);
    if (made != NULL)
        PyObject_GC_UnTrack(made);
    return made;
}

/* Put a new reference into a tuple if there are both. Returns it, or NULL with an error set. */
static PyObject *set(PyObject *tuple, Py_ssize_t place, PyObject *item) {
    if (tuple != NULL && item != NULL)
        return PyTuple_SetItem(tuple, place, item) == 0 ? item : NULL;
    Py_XDECREF(item);
    return NULL;
}

/* A TransformStamped but for the numbers of its pose; NULL if there is no memory. Never sets an
   error. */
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

/* What was prepared, with its numbers; NULL with an error set on failure. */
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

/* The pose of source in target by a path, cached or not, and the moment it holds for in place of
   0; an answer is prepared on the way if one is wanted. Returns 0 if that is not plain; never sets
   an error. */
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
        /* Memory brings the samples meanwhile. To make tuples may run the collector, and that code
           which drops the path from the buffer: this reference to it is ours. */
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

/* `solve_path` for a target, a source and perhaps a moment, all given by their places. */
static int solve_plain(PyObject *self, const Types *types, PyObject *const *args, Py_ssize_t count,
                       PyObject *names, int64_t *time, double *pose, PyObject **made) {
    *time = 0;
    return names == NULL && (count == 2 || (count == 3 && read_stamp(args[2], time)))
        && solve_path((Door *)self, types, args[0], args[1], time, pose, made);
}

/* Each method answers as its entry in `door_methods` says, or has its plain twin answer. */
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

/* It asks for the answer, and tells only whether there is one. */
METHOD(can_transform) {
    int64_t time;
    double pose[7];
    return solve_plain(self, PyType_GetModuleState(door), args, count, names, &time, pose, NULL)
        ? Py_NewRef(Py_True) : PLAINLY(can_transform);
}

/* The same where target and source may be one frame, whose name another path has shown good. */
static int solve_leg(Door *door, const Types *types, PyObject *target, PyObject *source,
                     int64_t *time, double *pose) {
    for (int k = 0; k < 7; k++)
        pose[k] = k == 6;
    return (*time != 0 && same_text(target, source))
        || solve_path(door, types, target, source, time, pose, NULL);
}

/* Two answers, one behind the other; whatever is not plain is refused or answered in Python. */
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

/* Inserting --------------------------------------------------------------- */

/* Whether no batch reads a link's records, and they are an array's: samples among them may be
   moved where they lie. Never sets an error. */
static int is_free(const Link *link) {
    /* An array lets go of nothing while others read it, be it no word at all. To ask may run
       the collector, and that code which gives the link other records. */
    PyObject *held = Py_NewRef(link->records);
    const int done = PySequence_DelSlice(held, 0, 0) == 0 && link->records == held;
    Py_DECREF(held);
    PyErr_Clear();
    return done;
}

/* So many pruned records are too many to leave where they are: more of them than a part of all. */
#define SLACK 32
#define SLACK_PART 8

/* Put a sample into a link where there is room: `History.insert` if no other one has its stamp,
   and all are of the same origin. Returns whether it was done; never sets an error. */
static int put(Link *link, int64_t stamp, int64_t origin, double *pose) {
    Py_buffer view;
    const double square = square_of(pose + 3, 1);
    if (!(1.0 - ROUNDING < square && square < 1.0 + ROUNDING
          && pose[0] + pose[1] + pose[2] < HUGE_VAL))
        return 0;
    const int is_full = link->start > SLACK + link->count / SLACK_PART;
    /* That is asked first: nothing that was looked at before need be so any more. */
    if (link->records == NULL || ((is_full || stamp <= link->newest_stamp) && !is_free(link))
        || !read_records(link, PyBUF_WRITABLE, &view))
        return 0;
    /* Nothing below runs Python code before the records are released: these facts still hold
       there. */
    if (link->origins != Py_None || link->origin != origin || link->limit < 0
        || is_full != (link->start > SLACK + link->count / SLACK_PART)) {
        PyBuffer_Release(&view);
        return 0;
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
    /* Last of all: what is let go of here may run code of others. */
    Py_XDECREF(before);
    Py_XDECREF(pair);
    return fits;
}

/* Remember a sample of plain parts, of a link that is known by its child. Returns whether it
   was done; never sets an error. */
static int insert(const Door *door, const Types *types, PyObject *sample, PyObject *authority) {
    int64_t stamp, origin;
    double pose[7];
    if (Py_TYPE(sample) != types->tuples[STAMPED] || PyTuple_Size(sample) != 4)
        return 0;
    /* Ours until the end: what runs while the sample is put in may drop it from the buffer. */
    PyObject *sender = value_of(door->_senders, PyTuple_GetItem(sample, 2));
    PyObject *transform = PyTuple_GetItem(sample, 3), *link;
    const int done = is_tuple(sender, 4)
        && same_text(PyTuple_GetItem(sender, 0), PyTuple_GetItem(sample, 1))
        && same_text(PyTuple_GetItem(sender, 1), authority)
        && read_stamp(PyTuple_GetItem(sender, 2), &origin)
        && Py_TYPE(transform) == types->tuples[TRANSFORM] && PyTuple_Size(transform) == 2
        && read_stamp(PyTuple_GetItem(sample, 0), &stamp)
        && read_floats(PyTuple_GetItem(transform, 0), pose, 3)
        && read_floats(PyTuple_GetItem(transform, 1), pose + 3, 4)
        && PyObject_TypeCheck(link = PyTuple_GetItem(sender, 3), types->fields)
        && put((Link *)link, stamp, origin, pose);
    Py_XDECREF(sender);
    return done;
}

/* Who listens or waits is told by Python, once the sample is in. */
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

/* A batch ---------------------------------------------------------------- */

PyDoc_STRVAR(solve_doc, "solve(up, down, times, translations, rotations, valid)\n--\n\n"
"Write the poses of a path at many moments, NaN where a link has no data. Returns how many rows\n"
"have none, or None where a link is not plain. Other threads of Python run meanwhile; the records\n"
"must not change.");

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

/* The objects that a link or a buffer begins with. */
#define HELD_OF(self) ((PyObject **)((char *)(self) + sizeof(PyObject)))

/* What the collector needs of a class that holds so many objects: to show it all of them and the
   type, as every heap type must, and to let go of them, where it found them in a cycle. */
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
static PyMethodDef no_methods[] = {{NULL, NULL, 0, NULL}};
static PyMethodDef module_methods[] = {
    {"solve", solve, METH_VARARGS, solve_doc}, {NULL, NULL, 0, NULL},
};

/* A new class of the module, under its name there; NULL with an error set on failure. */
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
        "The methods of a buffer that are called most.", door_members, door_methods,
        door_traverse, door_clear);
    Py_XDECREF((PyObject *)door);
    if (door == NULL
        || (types->fields = holder(module, "tftool.buffer._kernel.Fields", sizeof(Link),
            "The fields of a link, laid out so that the kernel can read them.",
            link_members, no_methods, link_traverse, link_clear)) == NULL
        || (types->empty = PyUnicode_InternFromString("")) == NULL
        || (types->link = PyUnicode_InternFromString("link")) == NULL)
        return -1;
    types->make = (newfunc)PyType_GetSlot(&PyTuple_Type, Py_tp_new);
    types->allocate = (allocfunc)PyType_GetSlot(&PyTuple_Type, Py_tp_alloc);
    for (int i = 0; i < 4; i++) {
        PyObject *home = PyImport_ImportModule(TUPLES[i].module);
        PyObject *type = home == NULL ? NULL : PyObject_GetAttrString(home, TUPLES[i].name);
        Py_XDECREF(home);
        types->tuples[i] = (PyTypeObject *)type;
        if (type == NULL
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
