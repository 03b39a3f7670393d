/* Native scan: find the transforms of many recorded messages and write them into columns.

   `transform_rows.walk` is its twin: the readable version in Python. Without a compiler,
   `message_cutter` in `recordings/` uses numpy. The tests run on both. Rules, as in the kernel of
   `buffer/`:

   - A message is either read exactly as the twin reads it, or left to the twin. The twin also judges
     everything unusual about a message (byte order, a length that does not fit, bytes left over),
     and names it in its error.
   - Messages come from outside, so no number in them is trusted: every offset is checked against
     the end of the message, every message against the end of the buffer, every write against the
     end of its array.
   - Limited API of CPython 3.11: one build serves all later versions that have a GIL. */

#define PY_SSIZE_T_CLEAN
#define Py_LIMITED_API 0x030B0000
#include <Python.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "../buffer/_path.h"

/* Version that `tftool.messages.transform_rows` expects; a build with another version is not used. */
#define INTERFACE 4

#define SMALLEST 72              /* Bytes of a transform with empty names: stamp, two lengths, doubles. */
#define LONGEST_NAME 4096        /* As in `transform_rows`. */
/* Limits on hostile files; messages beyond them are left to the twin. */
#define MOST_PAIRS (1 << 17)     /* Pairs of names in the table. */
#define MOST_LOOKS 256           /* Pairs with one hash: only a file made for an attack has more. */
#define MOST_BYTES (16 << 20)    /* Bytes of all names together. */
#define RECORD 64                /* Bytes of a sample: a stamp and seven doubles. */
#define LONGEST_RUN 32           /* Messages written edge by edge: they stay in the cache meanwhile. */
#define NEAR 4096                /* Bytes from the current message to the bytes that are prefetched. */
#define HEAD 31                  /* Bytes of an MCAP message record before its payload. */
#define MESSAGE 5                /* Opcode of an MCAP message record. */
#define ENTRY 12                 /* Bytes of an entry in a ROS 1 chunk's index. */
#define ROS1_MESSAGE 2           /* Op code of a ROS 1 message record. */
#define LARGEST_HEADER (1 << 20) /* Largest header of a ROS 1 record, bytes. */
#define LEAF 0x0d                /* First byte of an sqlite page with rows of a table. */

static inline uint32_t u32_at(const uint8_t *bytes) {
    uint32_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

static inline uint64_t u64_at(const uint8_t *bytes) {
    uint64_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

static inline int32_t i32_at(const char *words, Py_ssize_t index) {
    int32_t word;
    memcpy(&word, words + 4 * index, sizeof word);
    return word;
}

static inline int64_t i64_at(const char *words, Py_ssize_t index) {
    int64_t word;
    memcpy(&word, words + 8 * index, sizeof word);
    return word;
}

/* Pairs of frame names --------------------------------------------------- */

/* A pair of names, stored as the bytes of a message from the first length to the end of the second
   name. So one comparison checks both names, their lengths and the padding. */
typedef struct {
    uint32_t hash, place, size; /* First byte in `bytes`, number of bytes. */
    uint32_t parent, child;     /* Bytes of each name: the parent after its length, the child at the end. */
    uint32_t next;              /* Guess of the next pair: the pair that followed last time. */
    int32_t target;             /* Number of its columns, or UNKNOWN or NOWHERE. */
    int32_t slashed;            /* Whether a leading slash of a name was dropped. */
} Pair;

#define UNKNOWN (-2)
#define NOWHERE (-1)

/* State of an edge's growing columns, as in `columns.Growing.state`. */
enum { COUNT, LAST, ORDERED, KEPT, SLASHED, MOVED, STATE };

/* Columns of an edge, with memory for `room` rows. The views are exports of Python's arrays, which
   therefore cannot move while a target holds them. */
typedef struct {
    Py_buffer records, messages, state;
    int64_t room, moved;
    int64_t row; /* Next row to write. */
    uint64_t run; /* Number of the latest call of `write_run` that uses these columns. */
} Target;

/* A transform in a message: its pair, the bytes of its names, and the offsets of its stamp, which
   the names follow, and of its numbers. */
typedef struct { uint32_t pair, names, stamp, numbers; } Found;

/* Messages of one call of `take`: offset and bytes of each, and its number in the columns. */
typedef struct {
    const uint8_t *buffer;
    const char *starts, *lengths, *numbers;
    Py_ssize_t count;
} Messages;

typedef struct {
    PyObject_HEAD
    Pair *pairs;
    uint32_t *slots; /* Hash table: number of a pair plus one; 0 if empty. */
    uint8_t *bytes;
    uint32_t count, room, mask, used, size;
    Found *found; /* Transforms of the current message. */
    uint64_t longest, runs;
    Target *targets;
    Py_ssize_t targeted;
    int is_cdr; /* The layout, CDR or ROS 1; equal for all messages, because the padding of names differs. */
    int busy; /* 1 while a thread scans without the GIL; 2 while it calls `ask` with the GIL. */
} Pairs;

static uint32_t hash_of(const uint8_t *bytes, uint32_t size, uint64_t hash) {
    while (size >= 8) {
        hash = (hash ^ u64_at(bytes)) * 0x9e3779b97f4a7c15ULL;
        hash ^= hash >> 29;
        bytes += 8, size -= 8;
    }
    uint64_t rest = size;
    for (uint32_t i = 0; i < size; i++)
        rest = rest << 8 | bytes[i];
    hash = (hash ^ rest) * 0x9e3779b97f4a7c15ULL;
    return (uint32_t)(hash ^ hash >> 32);
}

/* Whether `size` bytes, at least 8, are equal. For a few words, as usual, memcmp costs more. */
static inline int same(const uint8_t *one, const uint8_t *other, uint32_t size) {
    for (uint32_t i = 0; i + 8 < size; i += 8) {
        if (u64_at(one + i) != u64_at(other + i))
            return 0;
    }
    return u64_at(one + size - 8) == u64_at(other + size - 8);
}

static inline int is_pair(const Pairs *self, const Pair *pair, const uint8_t *parent,
                          uint32_t parent_size, const uint8_t *child, uint32_t child_size) {
    const uint8_t *bytes = self->bytes + pair->place;
    return pair->parent == parent_size && pair->child == child_size
        && memcmp(bytes + 4, parent, parent_size) == 0
        && memcmp(bytes + pair->size - child_size, child, child_size) == 0;
}

/* Reallocate an array; on failure it is unchanged. Returns whether there was memory. */
static int grow(void **array, uint64_t bytes) {
    void *larger = realloc(*array, (size_t)bytes);
    if (larger != NULL)
        *array = larger;
    return larger != NULL;
}

static int make_room(Pairs *self, uint32_t more) {
    if (self->bytes == NULL || self->used + more > self->size) {
        uint32_t size = self->size ? self->size : 1 << 12;
        while (size < self->used + more)
            size *= 2;
        if (!grow((void **)&self->bytes, size))
            return 0;
        self->size = size;
    }
    if (self->count < self->room)
        return 1;
    const uint32_t room = self->room ? 2 * self->room : 64;
    if (!grow((void **)&self->pairs, (uint64_t)room * sizeof *self->pairs)
        || !grow((void **)&self->slots, (uint64_t)room * 2 * sizeof *self->slots))
        return 0;
    self->room = room;
    self->mask = 2 * room - 1;
    memset(self->slots, 0, (size_t)room * 2 * sizeof *self->slots);
    for (uint32_t number = 0; number < self->count; number++) {
        uint32_t slot = self->pairs[number].hash & self->mask;
        while (self->slots[slot])
            slot = (slot + 1) & self->mask;
        self->slots[slot] = number + 1;
    }
    return 1;
}

/* Return the number of a pair, and add the pair if it is new; -1 if a limit is reached.

   bytes   the bytes of the pair as described at `Pair`, `size` of them */
static int64_t number_of(Pairs *self, const uint8_t *bytes, uint32_t size, uint32_t parent_size,
                         uint32_t child_size) {
    const uint8_t *parent = bytes + 4, *child = bytes + size - child_size;
    const uint32_t hash = hash_of(child, child_size, hash_of(parent, parent_size, parent_size));
    if (self->room) {
        uint32_t slot = hash & self->mask;
        for (int looks = 0; self->slots[slot]; slot = (slot + 1) & self->mask) {
            if (++looks > MOST_LOOKS)
                return -1;
            const uint32_t number = self->slots[slot] - 1;
            if (self->pairs[number].hash == hash
                && is_pair(self, &self->pairs[number], parent, parent_size, child, child_size))
                return number;
        }
    }
    if (self->count >= MOST_PAIRS || self->used + size > MOST_BYTES || !make_room(self, size))
        return -1;
    const uint32_t number = self->count++;
    self->pairs[number] = (Pair){hash, self->used, size, parent_size, child_size, number, UNKNOWN, 0};
    memcpy(self->bytes + self->used, bytes, size);
    self->used += size;
    uint32_t slot = hash & self->mask;
    while (self->slots[slot])
        slot = (slot + 1) & self->mask;
    self->slots[slot] = number + 1;
    return number;
}

/* Messages --------------------------------------------------------------- */

#define ODD (-1)
#define NO_MEMORY (-2)

/* Return the offset of the numbers after the names. CDR aligns doubles to 8 bytes, counted from the
   end of its 4-byte header. */
static inline uint64_t numbers_at(uint64_t end, int is_cdr) {
    return is_cdr ? ((end + 3) & ~7ULL) + 4 : end;
}

/* Parse a message: `transform_rows.walk`. Stores its transforms in `found` and returns their number,
   or ODD or NO_MEMORY. Reads `bytes` only up to `size`.

   last    in and out: the previous pair, for the guess of the next */
static inline int64_t walk(Pairs *self, const uint8_t *bytes, uint64_t size, int is_cdr, uint32_t *last) {
    uint64_t position = is_cdr ? 4 : 0;
    if (size < position + 4 || (is_cdr && (bytes[0] != 0 || bytes[1] != 1)))
        return ODD;
    const uint64_t count = u32_at(bytes + position);
    position += 4;
    if (count * SMALLEST > size - position)
        return ODD;
    if (count > self->longest) {
        if (!grow((void **)&self->found, 2 * count * sizeof *self->found))
            return NO_MEMORY;
        self->longest = 2 * count;
    }
    Found *found = self->found;
    for (uint64_t row = 0; row < count; row++) {
        const uint64_t stamp = is_cdr ? position : position + 4, begin = stamp + 8;
        if (*last < self->count) {
            /* Publishers send the same frames in the same order. So compare with the pair that
               followed last time, before the table is searched. */
            const uint32_t number = self->pairs[*last].next;
            const Pair *pair = &self->pairs[number];
            position = numbers_at(begin + pair->size, is_cdr);
            if (position + 56 <= size && same(self->bytes + pair->place, bytes + begin, pair->size)) {
                found[row] = (Found){number, pair->size, (uint32_t)stamp, (uint32_t)position};
                *last = number;
                position += 56;
                continue;
            }
        }
        uint32_t sizes[2];
        position = begin;
        for (int k = 0; k < 2; k++) {
            if (is_cdr)
                position = (position + 3) & ~3ULL;
            if (position + 4 > size)
                return ODD;
            const uint32_t length = u32_at(bytes + position);
            if (length > LONGEST_NAME || position + 4 + length > size)
                return ODD;
            sizes[k] = length;
            position += 4 + length;
        }
        const uint32_t names = (uint32_t)(position - begin);
        position = numbers_at(position, is_cdr);
        if (position + 56 > size)
            return ODD;
        const int64_t pair = number_of(self, bytes + begin, names, sizes[0], sizes[1]);
        if (pair < 0)
            return ODD;
        if (*last < self->count)
            self->pairs[*last].next = (uint32_t)pair;
        *last = (uint32_t)pair;
        found[row] = (Found){(uint32_t)pair, names, (uint32_t)stamp, (uint32_t)position};
        position += 56;
    }
    return size - position > (is_cdr ? 7 : 0) ? ODD : (int64_t)count;
}

/* Open the buffers of all arguments; the caller must call `release_all`. On failure none is open,
   and an error is set. */
static int read_all(PyObject *const *arguments, Py_buffer *views, const int *flags, int count) {
    for (int k = 0; k < count; k++) {
        if (PyObject_GetBuffer(arguments[k], &views[k], flags[k]) < 0) {
            while (k > 0)
                PyBuffer_Release(&views[--k]);
            return 0;
        }
    }
    return 1;
}

static void release_all(Py_buffer *views, int count) {
    while (count > 0)
        PyBuffer_Release(&views[--count]);
}

/* Columns ---------------------------------------------------------------- */

/* Append one transform, which has the same offsets in `count` messages, to the columns of its edge
   from row `target->row`; there must be room. It runs without the GIL, so it touches only memory that
   the views own. The structures are passed by value, as the compiler must assume that writing to the
   columns changes all memory. */
static inline void write_column(const Messages messages, Py_ssize_t first, int64_t count, const Found found,
                                const Target *target, int64_t slashed) {
    int64_t *state = target->state.buf;
    int64_t row = target->row, kept = state[KEPT], latest = state[LAST], is_ordered = state[ORDERED];
    char *record = (char *)target->records.buf + RECORD * row, *numbers = (char *)target->messages.buf + 4 * row;
    int64_t before = row > 0 ? i64_at(record - RECORD, 0) : 0;
    for (Py_ssize_t k = first; k < first + count; k++, row++, record += RECORD, numbers += 4) {
        const uint8_t *bytes = messages.buffer + i64_at(messages.starts, k), *time = bytes + found.stamp;
        const int64_t stamp = (int64_t)(int32_t)u32_at(time) * 1000000000 + u32_at(time + 4);
        const int32_t message = i32_at(messages.numbers, k);
        double pose[7];
        /* One by one, because gcc would copy a block through the stack. */
        for (int n = 0; n < 7; n++)
            memcpy(&pose[n], bytes + found.numbers + 8 * n, 8);
        memcpy(record, &stamp, sizeof stamp);
        PREFETCH((const void *)((uintptr_t)record + LONGEST_RUN * RECORD));
        for (int n = 0; n < 7; n++)
            memcpy(record + 8 + 8 * n, &pose[n], 8);
        memcpy(numbers, &message, sizeof message);
        if (kept == row && is_normalised(pose) && (row == 0 || stamp > before))
            kept = row + 1;
        before = stamp;
        is_ordered = is_ordered && message >= latest;
        latest = message;
    }
    state[KEPT] = kept;
    state[LAST] = latest;
    state[ORDERED] = is_ordered;
    state[SLASHED] += slashed * count;
    state[COUNT] = row;
}

/* Append one transform of message `k` to the columns of its edge; returns whether there was room. */
static inline int is_written(Pairs *self, const Messages *messages, Py_ssize_t k, const Found *found) {
    const Pair *pair = &self->pairs[found->pair];
    Target *target = &self->targets[pair->target];
    const int64_t *state = target->state.buf;
    target->row = state[COUNT];
    /* Another reader may have replaced the columns since `aim`. Then `ask` must call `aim` again. */
    if (state[MOVED] != target->moved || target->row < 0 || target->row >= target->room)
        return 0;
    write_column(*messages, k, 1, *found, target, pair->slashed);
    return 1;
}

/* Whether the message `other` has the same transforms, at the same offsets, as the message `bytes` of
   the same length, whose `count` transforms are in `found`. Not inlined: gcc would have too few
   registers. */
APART int is_alike(const Found *found, int64_t count, const uint8_t *bytes, const uint8_t *other, int is_cdr) {
    if (is_cdr ? u64_at(bytes) != u64_at(other) : u32_at(bytes) != u32_at(other))
        return 0;
    for (int64_t row = 0; row < count; row++) {
        const uint32_t names = found[row].stamp + 8;
        if (!same(bytes + names, other + names, found[row].names))
            return 0;
    }
    return 1;
}

/* Write the messages after message `k` that have the same transforms at the same offsets, edge by
   edge: a third less time than message by message. Message `k` is written already; its transforms,
   `count` of them, are in `found`. Returns the number of messages written. */
APART int64_t write_run(Pairs *self, const Messages *messages, Py_ssize_t k, int64_t count, int is_cdr) {
    int64_t most = messages->count - k - 1, run = 0;
    most = most < LONGEST_RUN ? most : LONGEST_RUN;
    self->runs++;
    for (int64_t row = 0; row < count; row++) {
        const int32_t number = self->pairs[self->found[row].pair].target;
        if (number < 0)
            return 0;
        Target *target = &self->targets[number];
        const int64_t *state = target->state.buf;
        target->row = state[COUNT];
        /* An edge that occurs twice in a message needs its rows in the order of the messages. */
        if (state[MOVED] != target->moved || target->row < 0 || target->row > target->room || target->run == self->runs)
            return 0;
        target->run = self->runs;
        most = most < target->room - target->row ? most : target->room - target->row;
    }
    const uint8_t *bytes = messages->buffer + i64_at(messages->starts, k);
    const int64_t length = i64_at(messages->lengths, k);
    for (; run < most && i64_at(messages->lengths, k + 1 + run) == length; run++) {
        const uint8_t *other = messages->buffer + i64_at(messages->starts, k + 1 + run);
        /* Prefetch, because another processor may have unpacked these bytes: saves 4 % of the time to
           read an lz4 recording. */
        for (int64_t line = 0; line < length; line += 64)
            PREFETCH((const void *)((uintptr_t)other + NEAR + (uintptr_t)line));
        if (!is_alike(self->found, count, bytes, other, is_cdr))
            break;
    }
    for (int64_t row = 0; row < count && run; row++) {
        const Pair *pair = &self->pairs[self->found[row].pair];
        write_column(*messages, k + 1, run, self->found[row], &self->targets[pair->target], pair->slashed);
    }
    return run;
}

/* Call `ask`, which provides columns with room for a pair, by `aim` and `lead`. Returns 1, or 0
   with an error set. Needs the GIL. */
static int is_aimed(Pairs *self, PyObject *ask, uint32_t pair, int32_t message, Py_ssize_t rank) {
    self->busy = 2;
    PyObject *answer = PyObject_CallFunction(ask, "Iin", (unsigned)pair, (int)message, rank);
    self->busy = 1;
    Py_XDECREF(answer);
    if (answer == NULL)
        return 0;
    const int32_t number = self->pairs[pair].target;
    if (number == NOWHERE)
        return 1;
    if (number >= 0) {
        const Target *target = &self->targets[number];
        const int64_t *state = target->state.buf;
        if (state[MOVED] == target->moved && state[COUNT] >= 0 && state[COUNT] < target->room)
            return 1;
    }
    PyErr_SetString(PyExc_ValueError, "the arrays of the edge are full");
    return 0;
}

PyDoc_STRVAR(take_doc, "Write the transforms of messages into columns; see `_scan.pyi`.");

static PyObject *take(PyObject *object, PyObject *const *arguments, Py_ssize_t count) {
    Pairs *self = (Pairs *)object;
    static const int flags[] = {PyBUF_SIMPLE, PyBUF_SIMPLE, PyBUF_SIMPLE, PyBUF_SIMPLE};
    Py_buffer views[4];
    if (count != 6) {
        PyErr_SetString(PyExc_TypeError, "take needs 6 arguments: a buffer, three arrays, is_cdr, and a function");
        return NULL;
    }
    const int is_cdr = PyObject_IsTrue(arguments[4]);
    if (is_cdr < 0 || !read_all(arguments, views, flags, 4))
        return NULL;
    const uint8_t *buffer = views[0].buf;
    const uint64_t size = (uint64_t)views[0].len;
    const Py_ssize_t messages = views[1].len / 8;
    PyObject *result = NULL;
    uint32_t *odds = NULL;
    int fits = views[2].len / 8 == messages && views[3].len / 4 == messages && messages <= INT32_MAX;
    for (Py_ssize_t k = 0; k < messages && fits; k++) {
        const int64_t start = i64_at(views[1].buf, k), length = i64_at(views[2].buf, k);
        fits = start >= 0 && length >= 0 && length <= UINT32_MAX && (uint64_t)start <= size
            && (uint64_t)length <= size - (uint64_t)start;
    }
    if (!fits) {
        PyErr_SetString(PyExc_ValueError, "a message extends beyond the buffer");
        goto done;
    }
    if (self->busy) {
        PyErr_SetString(PyExc_RuntimeError, "another thread uses these pairs");
        goto done;
    }
    if (self->count && self->is_cdr != is_cdr) {
        PyErr_SetString(PyExc_ValueError, "these pairs were read from messages in another layout");
        goto done;
    }
    self->is_cdr = is_cdr;
    const Messages all = {buffer, views[1].buf, views[2].buf, views[3].buf, messages};
    uint32_t last = UINT32_MAX, first = UINT32_MAX;
    Py_ssize_t odd_count = 0, odd_room = 0;
    long long left_out = 0;
    int failed = 0, is_told = 0;
    self->busy = 1;
    PyThreadState *state = PyEval_SaveThread();
    for (Py_ssize_t k = 0; k < messages && !failed && !is_told; k++) {
        const uint8_t *bytes = buffer + i64_at(views[1].buf, k);
        const uint64_t length = (uint64_t)i64_at(views[2].buf, k);
        /* Two calls, so that the compiler makes a copy of the function for each layout. */
        const int64_t transforms = is_cdr ? walk(self, bytes, length, 1, &last) : walk(self, bytes, length, 0, &last);
        const int32_t message = i32_at(all.numbers, k);
        for (int64_t row = 0; row < transforms; row++) {
            const Found *found = &self->found[row];
            const Pair *pair = &self->pairs[found->pair];
            if (pair->target >= 0 && is_written(self, &all, k, found))
                continue;
            if (pair->target != NOWHERE) {
                PyEval_RestoreThread(state);
                is_told = !is_aimed(self, arguments[5], found->pair, message, (Py_ssize_t)row);
                state = PyEval_SaveThread();
                if (is_told)
                    break;
            }
            if (pair->target == NOWHERE)
                left_out++;
            else
                is_written(self, &all, k, found);
        }
        if (transforms > 0 && !is_told) {
            /* Look for a run only after two messages that begin with the same pair. */
            const uint32_t pair = self->found[0].pair;
            if (pair == first)
                k += write_run(self, &all, k, transforms, is_cdr);
            first = pair;
        }
        if (transforms >= 0)
            continue;
        if (odd_count == odd_room) {
            odd_room = odd_room ? 2 * odd_room : 64;
            failed = !grow((void **)&odds, (uint64_t)odd_room * sizeof *odds);
        }
        failed |= transforms == NO_MEMORY;
        if (!failed)
            odds[odd_count++] = (uint32_t)k;
    }
    PyEval_RestoreThread(state);
    self->busy = 0;
    if (failed)
        PyErr_NoMemory();
    else if (!is_told)
        result = Py_BuildValue("(Ly#)", left_out, odds ? (const char *)odds : "", odd_count * (Py_ssize_t)sizeof *odds);
done:
    free(odds);
    release_all(views, 4);
    return result;
}

static void release_target(Target *target) {
    PyBuffer_Release(&target->records);
    PyBuffer_Release(&target->messages);
    PyBuffer_Release(&target->state);
}

PyDoc_STRVAR(aim_doc, "Set the columns of an edge; see `_scan.pyi`.");

static PyObject *aim(PyObject *object, PyObject *const *arguments, Py_ssize_t count) {
    Pairs *self = (Pairs *)object;
    static const int flags[] = {PyBUF_WRITABLE, PyBUF_WRITABLE, PyBUF_WRITABLE};
    Py_buffer views[3];
    if (count != 4) {
        PyErr_SetString(PyExc_TypeError, "aim needs 4 arguments: the number of an edge, and three arrays");
        return NULL;
    }
    const Py_ssize_t number = PyLong_AsSsize_t(arguments[0]);
    if ((number == -1 && PyErr_Occurred()) || !read_all(arguments + 1, views, flags, 3))
        return NULL;
    if (self->busy == 1 || number < 0 || number > self->targeted || number >= MOST_PAIRS
        || views[2].len < STATE * 8 || (uintptr_t)views[2].buf % 8) {
        PyErr_SetString(PyExc_ValueError, "no such edge, or the state array of the edge is too short");
        goto failed;
    }
    if (number == self->targeted) {
        /* The array is doubled when the number is a power of two, so no capacity is stored. */
        if ((number & (number - 1)) == 0
            && !grow((void **)&self->targets, (uint64_t)(number ? 2 * number : 1) * sizeof *self->targets)) {
            PyErr_NoMemory();
            goto failed;
        }
        self->targeted++;
    } else {
        release_target(&self->targets[number]);
    }
    const Py_ssize_t rows = views[0].len / RECORD, others = views[1].len / 4;
    self->targets[number] = (Target){views[0], views[1], views[2], rows < others ? rows : others,
                                     ((int64_t *)views[2].buf)[MOVED], 0, 0};
    return Py_NewRef(Py_None);
failed:
    release_all(views, 3);
    return NULL;
}

PyDoc_STRVAR(lead_doc, "Set the edge of a pair's transforms; see `_scan.pyi`.");

static PyObject *lead(PyObject *object, PyObject *const *arguments, Py_ssize_t count) {
    Pairs *self = (Pairs *)object;
    if (count != 3) {
        PyErr_SetString(PyExc_TypeError, "lead needs 3 arguments: a pair, the number of an edge, and is_slashed");
        return NULL;
    }
    const Py_ssize_t pair = PyLong_AsSsize_t(arguments[0]), number = PyLong_AsSsize_t(arguments[1]);
    const int slashed = PyObject_IsTrue(arguments[2]);
    if (PyErr_Occurred())
        return NULL;
    if (self->busy == 1 || pair < 0 || pair >= (Py_ssize_t)self->count || number < NOWHERE || number >= self->targeted) {
        PyErr_SetString(PyExc_IndexError, "no such pair, or no such edge");
        return NULL;
    }
    self->pairs[pair].target = (int32_t)number;
    self->pairs[pair].slashed = slashed;
    return Py_NewRef(Py_None);
}

PyDoc_STRVAR(names_doc, "Return both names of a pair; see `_scan.pyi`.");

static PyObject *names(PyObject *object, PyObject *argument) {
    const Pairs *self = (Pairs *)object;
    const long long number = PyLong_AsLongLong(argument);
    if (number == -1 && PyErr_Occurred())
        return NULL;
    if (self->busy == 1 || number < 0 || number >= self->count) {
        PyErr_SetString(PyExc_IndexError, "no such pair");
        return NULL;
    }
    const Pair *pair = &self->pairs[number];
    const char *bytes = (const char *)self->bytes + pair->place;
    return Py_BuildValue("(y#y#)", bytes + 4, (Py_ssize_t)pair->parent, bytes + pair->size - pair->child,
                         (Py_ssize_t)pair->child);
}

static void pairs_dealloc(PyObject *object) {
    Pairs *self = (Pairs *)object;
    PyTypeObject *type = Py_TYPE(object);
    free(self->pairs);
    free(self->slots);
    free(self->bytes);
    free(self->found);
    while (self->targeted > 0)
        release_target(&self->targets[--self->targeted]);
    free(self->targets);
    freefunc release = PyType_GetSlot(type, Py_tp_free);
    release(object);
    Py_DECREF(type);
}

static PyMethodDef pairs_methods[] = {
    {"take", (PyCFunction)(void (*)(void))take, METH_FASTCALL, take_doc},
    {"aim", (PyCFunction)(void (*)(void))aim, METH_FASTCALL, aim_doc},
    {"lead", (PyCFunction)(void (*)(void))lead, METH_FASTCALL, lead_doc},
    {"names", names, METH_O, names_doc},
    {NULL, NULL, 0, NULL},
};

static PyType_Slot pairs_slots[] = {
    {Py_tp_doc, "Table of pairs of frame names; see `_scan.pyi`."},
    {Py_tp_methods, pairs_methods},
    {Py_tp_dealloc, pairs_dealloc},
    {0, NULL},
};

static PyType_Spec pairs_spec = {
    "tftool.messages._scan.Pairs", sizeof(Pairs), 0, Py_TPFLAGS_DEFAULT, pairs_slots,
};

/* Indexes ---------------------------------------------------------------- */

PyDoc_STRVAR(indexed_doc, "Find the messages of an MCAP message index; see `_scan.pyi`.");

static PyObject *indexed(PyObject *module, PyObject *const *arguments, Py_ssize_t count) {
    (void)module;
    static const int flags[] = {PyBUF_SIMPLE, PyBUF_SIMPLE, PyBUF_WRITABLE, PyBUF_WRITABLE, PyBUF_WRITABLE};
    Py_buffer views[5];
    if (count != 6) {
        PyErr_SetString(PyExc_TypeError, "indexed needs 6 arguments: a chunk, an index, three arrays, and a channel");
        return NULL;
    }
    const long channel = PyLong_AsLong(arguments[5]);
    if ((channel == -1 && PyErr_Occurred()) || !read_all(arguments, views, flags, 5))
        return NULL;
    const uint8_t *data = views[0].buf;
    const uint64_t size = (uint64_t)views[0].len;
    const Py_ssize_t messages = views[1].len / 16;
    int fits = views[2].len / 8 >= messages && views[3].len / 8 >= messages && views[4].len / 8 >= messages;
    for (Py_ssize_t k = 0; k < messages && fits; k++) {
        const int64_t log_time = i64_at(views[1].buf, 2 * k);
        const uint64_t place = (uint64_t)i64_at(views[1].buf, 2 * k + 1);
        fits = 0;
        if (size < HEAD || place > size - HEAD)
            break;
        const uint8_t *head = data + place;
        const uint64_t length = u64_at(head + 1);
        if (head[0] != MESSAGE || (head[9] | head[10] << 8) != channel || length < HEAD - 9
            || length > size - place - 9)
            break;
        const int64_t start = (int64_t)(place + HEAD), bytes = (int64_t)(length - (HEAD - 9));
        memcpy((char *)views[2].buf + 8 * k, &start, 8);
        memcpy((char *)views[3].buf + 8 * k, &bytes, 8);
        memcpy((char *)views[4].buf + 8 * k, &log_time, 8);
        fits = 1;
    }
    release_all(views, 5);
    return PyBool_FromLong(fits);
}

PyDoc_STRVAR(pointed_doc, "Find the messages of a ROS 1 chunk's index; see `_scan.pyi`.");

static PyObject *pointed(PyObject *module, PyObject *const *arguments, Py_ssize_t count) {
    (void)module;
    static const int flags[] = {PyBUF_SIMPLE, PyBUF_SIMPLE, PyBUF_WRITABLE, PyBUF_WRITABLE, PyBUF_WRITABLE};
    Py_buffer views[5];
    if (count != 8) {
        PyErr_SetString(PyExc_TypeError, "pointed needs 8 arguments: a chunk, an index, three arrays, and three numbers");
        return NULL;
    }
    const unsigned long connection = PyLong_AsUnsignedLong(arguments[5]), code = PyLong_AsUnsignedLong(arguments[6]),
                        owner = PyLong_AsUnsignedLong(arguments[7]);
    if (PyErr_Occurred() || !read_all(arguments, views, flags, 5))
        return NULL;
    const uint8_t *data = views[0].buf;
    const uint64_t size = (uint64_t)views[0].len;
    const Py_ssize_t messages = views[1].len / ENTRY;
    uint64_t head = 0;
    int fits = views[2].len / 8 >= messages && views[3].len / 8 >= messages && views[4].len / 8 >= messages;
    for (Py_ssize_t k = 0; k < messages && fits; k++) {
        const uint8_t *entry = (const uint8_t *)views[1].buf + ENTRY * k;
        const uint64_t place = u32_at(entry + 8);
        fits = 0;
        if (place + 8 > size)
            break;
        const uint64_t length = u32_at(data + place);
        /* `code` and `owner` are offsets of fields in the first header, which all others must equal. */
        head = k ? head : length;
        if (length != head || head > LARGEST_HEADER || head > size - place - 8 || code >= head
            || owner >= head || head - owner < 4)
            break;
        const uint8_t *header = data + place + 4;
        const uint64_t bytes = u32_at(header + head);
        if (header[code] != ROS1_MESSAGE || u32_at(header + owner) != connection || bytes > size - place - 8 - head)
            break;
        const int64_t told[] = {(int64_t)(place + 8 + head), (int64_t)bytes,
                                (int64_t)u32_at(entry) * 1000000000 + u32_at(entry + 4)};
        for (int column = 0; column < 3; column++)
            memcpy((char *)views[2 + column].buf + 8 * k, &told[column], 8);
        fits = 1;
    }
    release_all(views, 5);
    return PyBool_FromLong(fits);
}

/* sqlite's pages --------------------------------------------------------- */

/* Read sqlite's variable-length integer: up to nine bytes of seven bits. Returns the number of its
   bytes; 0 if it continues after the end. */
static int varint(const uint8_t *bytes, const uint8_t *end, uint64_t *number) {
    uint64_t found = 0;
    for (int k = 0; k < 9 && bytes + k < end; k++) {
        found = k == 8 ? found << 8 | bytes[k] : found << 7 | (bytes[k] & 0x7f);
        if (k == 8 || bytes[k] < 0x80) {
            *number = found;
            return k + 1;
        }
    }
    return 0;
}

/* Read an integer column by its serial type. Returns its bytes; -1 if the column is not an integer. */
static int whole(uint64_t type, const uint8_t *bytes, const uint8_t *end, int64_t *number) {
    static const int sizes[] = {-1, 1, 2, 3, 4, 6, 8, -1, 0, 0};
    if (type > 9 || sizes[type] < 0 || end - bytes < sizes[type])
        return -1;
    uint64_t found = sizes[type] && bytes[0] & 0x80 ? UINT64_MAX : 0;
    for (int k = 0; k < sizes[type]; k++)
        found = found << 8 | bytes[k];
    *number = type >= 8 ? (int64_t)type - 8 : (int64_t)found;
    return sizes[type];
}

/* Return the stream of a topic from pairs (topic, stream) in the order of topics; -1 for none. */
static int64_t stream_of(const char *pairs, Py_ssize_t count, int64_t topic) {
    Py_ssize_t low = 0, high = count;
    while (low < high) {
        const Py_ssize_t middle = low + (high - low) / 2;
        if (i64_at(pairs, 2 * middle) < topic)
            low = middle + 1;
        else
            high = middle;
    }
    return low < count && i64_at(pairs, 2 * low) == topic ? i64_at(pairs, 2 * low + 1) : -1;
}

PyDoc_STRVAR(rows_doc, "Read the rows of a table's leaf pages; see `_scan.pyi`.");

static PyObject *rows(PyObject *module, PyObject *const *arguments, Py_ssize_t count) {
    (void)module;
    enum { PAGES, PLACES, STREAMS, SENDERS, TIMES, STARTS, LENGTHS, VIEWS };
    static const int flags[] = {PyBUF_SIMPLE, PyBUF_SIMPLE, PyBUF_SIMPLE, PyBUF_WRITABLE,
                                PyBUF_WRITABLE, PyBUF_WRITABLE, PyBUF_WRITABLE};
    Py_buffer views[VIEWS];
    if (count != VIEWS + 3) {
        PyErr_SetString(PyExc_TypeError, "rows needs 10 arguments: pages, their offsets, streams, four arrays, and three numbers");
        return NULL;
    }
    const long size = PyLong_AsLong(arguments[VIEWS]), usable = PyLong_AsLong(arguments[VIEWS + 1]);
    long long last = PyLong_AsLongLong(arguments[VIEWS + 2]);
    if (PyErr_Occurred() || !read_all(arguments, views, flags, VIEWS))
        return NULL;
    Py_ssize_t room = views[SENDERS].len / 4, found = 0;
    for (int k = TIMES; k < VIEWS; k++)
        room = views[k].len / 8 < room ? views[k].len / 8 : room;
    const uint8_t *pages = views[PAGES].buf;
    const char *streams = views[STREAMS].buf;
    const Py_ssize_t topics = views[STREAMS].len / 16, leaves = views[PLACES].len / 8;
    int is_odd = usable < 480 || usable > size || views[PAGES].len < size;
    for (Py_ssize_t leaf = 0; leaf < leaves && !is_odd; leaf++) {
        const int64_t place = i64_at(views[PLACES].buf, leaf);
        is_odd = 1;
        if (place < 0 || place > views[PAGES].len - size)
            break;
        const uint8_t *page = pages + place, *end = page + usable;
        const int cells = page[3] << 8 | page[4];
        if (page[0] != LEAF || 8 + 2 * cells > usable || cells > room - found)
            break;
        is_odd = 0;
        for (int k = 0; k < cells; k++) {
            const uint8_t *cell = page + (page[8 + 2 * k] << 8 | page[9 + 2 * k]);
            const uint8_t *start = cell;
            uint64_t payload, head, types[4];
            int64_t id, row[2];
            int step;
            if (cell >= end || !(step = varint(cell, end, &payload)))
                goto odd;
            cell += step;
            if (!(step = varint(cell, end, (uint64_t *)&id)) || id <= last)
                goto odd;
            last = id;
            const uint8_t *record = cell + step, *type = record;
            if (!(step = varint(type, end, &head)) || head > payload || head > (uint64_t)(end - record))
                goto odd;
            const uint8_t *body = record + head;
            type += step;
            for (int column = 0; column < 4; column++) {
                if (!(step = varint(type, body, &types[column])))
                    goto odd;
                type += step;
            }
            if (type != body || types[0] != 0 || types[3] < 12 || types[3] % 2)
                goto odd;
            for (int column = 0; column < 2; column++) {
                if ((step = whole(types[column + 1], body, end, &row[column])) < 0)
                    goto odd;
                body += step;
            }
            const uint64_t length = (types[3] - 12) / 2;
            if (length > (uint64_t)INT32_MAX || payload != (uint64_t)(body - record) + length)
                goto odd;
            /* A longer record continues on overflow pages. A negative start marks it for Python. */
            const int is_here = payload <= (uint64_t)usable - 35;
            if (is_here && length > (uint64_t)(end - body))
                goto odd;
            const int32_t stream = (int32_t)stream_of(streams, topics, row[0]);
            if (stream < 0)
                continue;
            const int64_t told[] = {row[1], is_here ? body - pages : -1 - (start - pages), (int64_t)length};
            memcpy((char *)views[SENDERS].buf + 4 * found, &stream, 4);
            for (int column = 0; column < 3; column++)
                memcpy((char *)views[TIMES + column].buf + 8 * found, &told[column], 8);
            found++;
        }
        continue;
    odd:
        is_odd = 1;
    }
    release_all(views, VIEWS);
    return is_odd ? Py_NewRef(Py_None) : Py_BuildValue("(nL)", found, last);
}

/* The module ------------------------------------------------------------- */

static PyMethodDef methods[] = {
    {"rows", (PyCFunction)(void (*)(void))rows, METH_FASTCALL, rows_doc},
    {"pointed", (PyCFunction)(void (*)(void))pointed, METH_FASTCALL, pointed_doc},
    {"indexed", (PyCFunction)(void (*)(void))indexed, METH_FASTCALL, indexed_doc},
    {NULL, NULL, 0, NULL},
};

static int module_exec(PyObject *module) {
    const uint16_t one = 1;
    if (!*(const uint8_t *)&one) {
        PyErr_SetString(PyExc_ImportError, "recordings are little-endian, and this machine is not");
        return -1;
    }
    PyObject *type = PyType_FromSpec(&pairs_spec);
    const int failed = type == NULL || PyModule_AddType(module, (PyTypeObject *)type) < 0
                    || PyModule_AddIntConstant(module, "INTERFACE", INTERFACE) < 0;
    Py_XDECREF(type);
    return failed ? -1 : 0;
}

static PyModuleDef_Slot module_slots[] = {{Py_mod_exec, module_exec}, {0, NULL}};

static PyModuleDef definition = {
    PyModuleDef_HEAD_INIT, "tftool.messages._scan", "The native scan; see `_scan.pyi`.",
    0, methods, module_slots, NULL, NULL, NULL,
};

PyMODINIT_FUNC
PyInit__scan(void) {
    return PyModuleDef_Init(&definition);
}
