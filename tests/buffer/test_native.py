"""Tests that the native kernel and plain Python give the same results."""

import gc
import itertools
import math
import tracemalloc
import weakref
from array import array
from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.strategies import transforms
from tests.twins import REASON, Twins, is_native, worst
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.native_kernel import Door
from tftool.buffer.sample import Snapshot, TransformStamped
from tftool.geometry.quaternions import unit
from tftool.geometry.rigid import Quaternion, Transform, Vector3

pytestmark = pytest.mark.skipif(not is_native(), reason=REASON)

FRAMES = ("a", "b", "c", "d")

unusual = st.sampled_from(
    [
        Transform((1, 2, 3)),
        Transform((math.inf, 0.0, 0.0)),
        Transform((-math.inf, 0.0, -0.0)),
        Transform((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, -3.0)),
        Transform((0.0, 0.0, 0.0), (1e-9, 0.0, 0.0, 1.0)),
        tuple.__new__(Transform, (Vector3(math.nan, 0.0, 0.0), Quaternion(0.0, 0.0, 0.0, 1.0))),
        tuple.__new__(Transform, (Vector3(0.0, 0.0, 0.0), Quaternion(0.0, 0.0, 0.0, 0.0))),
        tuple.__new__(Transform, ((0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0))),
        tuple.__new__(Transform, ((0.0, 1.0), (0.0, 0.0, 0.0, 1.0))),
    ]
)
stamps = st.one_of(
    st.integers(1, 40).map(lambda number: number * 10**8),
    st.sampled_from([0, -5, 7, True, 10**17, 2**62, 2**63 - 1, -(2**63), 2**63, 10**30, 1.5]),
)
samples = st.tuples(
    st.just("set_transform"),
    st.builds(
        TransformStamped,
        stamps,
        st.sampled_from(FRAMES),
        st.sampled_from((*FRAMES, "/b", "")),
        st.one_of(transforms, unusual),
    ),
    st.sampled_from(["", "me", "you"]),
)
statics = st.tuples(
    st.just("set_transform_static"),
    st.builds(TransformStamped, stamps, st.just("b"), st.just("c"), transforms),
    st.just("me"),
)
lookups = st.tuples(
    st.just("lookup_transform"),
    st.sampled_from((*FRAMES, "/a", "nowhere")),
    st.sampled_from(FRAMES),
    st.one_of(stamps, st.integers(1, 4 * 10**9)),
)
fulls = st.tuples(
    st.just("lookup_transform_full"),
    st.sampled_from(FRAMES),
    st.one_of(stamps, st.integers(1, 4 * 10**9)),
    st.sampled_from(FRAMES),
    st.one_of(stamps, st.integers(1, 4 * 10**9)),
    st.sampled_from((*FRAMES, "nowhere")),
)
whether = lookups.map(lambda call: ("can_transform", *call[1:]))
others = st.sampled_from([("clear",), ("snapshot", 10**10), ("snapshot", 10**10, 10**9)])


REACH = 300.0
"""Distance in metres that no chain of three of these poses reaches."""


def same(ours, plain, tolerance=0.0):
    """Return whether two results are equal: numbers up to rounding, everything else exactly."""
    if type(ours) is not type(plain):
        return False
    if isinstance(ours, Transform):
        return same(tuple(ours[0]), tuple(plain[0]), REACH * 1e-15) and same(
            tuple(ours[1]), tuple(plain[1]), 1e-15
        )
    if isinstance(ours, dict):
        return ours.keys() == plain.keys() and all(
            same(ours[key], plain[key], tolerance) for key in ours
        )
    if isinstance(ours, tuple | list):
        return len(ours) == len(plain) and all(
            same(mine, other, tolerance) for mine, other in zip(ours, plain, strict=True)
        )
    if isinstance(ours, float):
        return abs(ours - plain) <= tolerance or repr(ours) == repr(plain)
    if isinstance(ours, Snapshot):
        return same((ours.now, ours.at, ours.frames), (plain.now, plain.at, plain.frames))
    return repr(ours) == repr(plain)


@given(
    st.lists(
        st.one_of(samples, samples, lookups, lookups, fulls, whether, statics, others), max_size=25
    )
)
def test_random_calls_give_the_same_results_in_the_kernel_and_in_plain_python(calls):
    twins = Twins(seconds(2))

    # At the end, look up every frame in every other frame, which also compares all samples.
    for call in [*calls, *(("lookup_transform", a, b) for a in FRAMES for b in FRAMES)]:
        ours, plain = twins.ask(*call)
        assert same(ours, plain), (ours, plain)
    assert twins.logs[0] == twins.logs[1]


@given(
    st.lists(transforms, min_size=2, max_size=8), st.lists(st.integers(1, 9 * 10**8), max_size=8)
)
def test_between_samples_both_give_the_same(poses, moments):
    twins = Twins(seconds(100))
    for number, pose in enumerate(poses):
        for parent, child in (("a", "b"), ("c", "b"), ("c", "d")):
            stamp = 10**8 * (number + 1) + 10**6 * len(child + parent) * (number % 3)
            # b is a child of a; c has children.
            if (parent, child) != ("c", "b"):
                twins.ask("set_transform", TransformStamped(stamp, parent, child, pose))
        twins.ask("set_transform", TransformStamped(10**8 * (number + 1), "a", "c", pose))

    for moment in [0, *moments, *(10**8 * (number + 1) for number in range(len(poses)))]:
        for target, source in (("a", "b"), ("d", "b"), ("b", "d"), ("c", "d")):
            ours, plain = twins.ask("lookup_transform", target, source, moment)
            assert same(ours, plain), (ours, plain)


@pytest.mark.parametrize(("links", "place_bound"), [(1, 0.0), (5, 1e-15)])
def test_many_lookups_differ_by_rounding_only(links, place_bound):
    compared, place, turn = worst(2 * 10**5, links)

    assert compared == 2 * 10**5
    assert place <= place_bound
    assert turn <= 1e-15


def test_a_rotation_through_many_links_is_of_length_one():
    random = np.random.default_rng(5)
    twins, links = Twins(seconds(10)), 60
    for link in range(links):
        stamps = np.array([seconds(1), seconds(2)])
        turns = random.normal(size=(2, 4))
        twins.ask("set_transforms", f"f{link}", f"f{link + 1}", stamps, np.zeros((2, 3)), turns)

    moments = random.integers(seconds(1), seconds(2), 200)
    for found in twins.ask("lookup_transforms", "f0", f"f{links}", moments):
        assert np.abs(np.linalg.norm(found.rotations, axis=1) - 1.0).max() < 1e-15
    for moment in moments.tolist():
        for found in twins.ask("lookup_transform", "f0", f"f{links}", moment):
            assert abs(math.hypot(*found.transform.rotation) - 1.0) < 1e-15


HALF = math.sqrt(0.5)
# Quarter, half and third turns: in their products, |w| is a half, or slightly more.
EVEN_TURNS = (
    (HALF, 0.0, 0.0, HALF),
    (0.0, -HALF, 0.0, HALF),
    (HALF, HALF, 0.0, 0.0),
    (0.5, 0.5, 0.5, -0.5),
    (0.5, -0.5, 0.5, 0.5),
)


def test_lookups_between_samples_of_equal_rotation_agree_to_the_last_bit():
    moments = np.array([seconds(1), seconds(1.5), seconds(2)])
    for turns in itertools.product(EVEN_TURNS, repeat=2):
        twins = Twins(seconds(10))
        for number, turn in enumerate(turns):
            for stamp in (1, 2):
                pose = Transform((float(stamp), 0.1, -0.7), turn)
                sample = TransformStamped(seconds(stamp), f"f{number}", f"f{number + 1}", pose)
                twins.ask("set_transform", sample)

        for target, source in (("f0", "f2"), ("f2", "f0")):
            ours, plain = twins.ask("lookup_transforms", target, source, moments)
            assert np.array_equal(ours.rotations, plain.rotations)
            assert np.array_equal(ours.translations, plain.translations)
            for row, moment in enumerate(moments.tolist()):
                for single in twins.ask("lookup_transform", target, source, moment):
                    assert single.transform.rotation == tuple(ours.rotations[row].tolist())
                    assert single.transform.translation == tuple(ours.translations[row].tolist())


def test_a_history_of_many_sizes_keeps_the_same_samples():
    twins = Twins(seconds(1))
    pose = Transform((1.0, 2.0, 3.0), (0.0, 0.0, 0.6, -0.8))
    for number in range(1, 400):
        late = -17 * 10**7 if number % 7 == 0 else 0
        stamp = 10**9 + number * 10**7 + late
        ours, plain = twins.ask("set_transform", TransformStamped(stamp, "a", "b", pose), "me")
        assert ours == plain
        ours, plain = twins.ask("samples", "b")
        assert ours.stamps.tolist() == plain.stamps.tolist()
        assert ours.poses.tobytes() == plain.poses.tobytes()


def columns_read(monkeypatch):
    """Return a list of the columns that batches of the native package read from now on.

    The list holds the columns, as a batch in another thread would.
    """
    from tftool.buffer.batch import edge_columns as columns

    read = []

    class Kept(columns.Column):
        def __init__(self, history):
            super().__init__(history)
            read.append(self)

    monkeypatch.setattr(columns, "Column", Kept)
    return read


def test_late_samples_are_put_where_they_belong_while_a_batch_reads(monkeypatch):
    read = columns_read(monkeypatch)
    twins = Twins(seconds(1))
    random = Random(4)
    held = []
    for number in range(500):
        # Samples are in order, late, before all others, too old, or have an existing stamp.
        late = random.choice([0, 0, 0, random.randrange(40), 90, 130])
        stamp = (100 + number // 2 - late) * 10**7 + random.choice([0, 0, number])
        pose = Transform((float(number), 0.0, 0.0))
        ours, plain = twins.ask("set_transform", TransformStamped(stamp, "a", "b", pose), "me")
        assert ours == plain
        if number % 10 == 0:
            ours, plain = twins.ask("samples", "b")
            assert ours.stamps.tolist() == plain.stamps.tolist()
            assert ours.poses.tobytes() == plain.poses.tobytes()
            # Some columns are held for a while, as by a batch in another thread.
            column = read[-1]
            held = [*held[-(number % 3) :], (column, column.records.copy())]
        assert all(np.array_equal(column.records, before) for column, before in held)
    assert twins.logs[0] == twins.logs[1] != []


def test_answers_are_of_the_types_they_always_were():
    buffer = Buffer()
    buffer.set_transform(TransformStamped(5, "a", "b", Transform((1.0, 2.0, 3.0))))
    buffer.lookup_transform("a", "b")

    found = buffer.lookup_transform("a", "b")

    assert found == TransformStamped(5, "a", "b", Transform((1.0, 2.0, 3.0)))
    assert [type(part) for part in (found, found.transform, *found.transform)] == [
        TransformStamped,
        Transform,
        Vector3,
        Quaternion,
    ]
    assert hash(found) == hash(TransformStamped(5, "a", "b", Transform((1.0, 2.0, 3.0))))


# Arguments that tftool's own code never passes, and that must not crash the kernel

LENGTHS = st.sampled_from([0, 1, 7, 8, 9, 63, 64, 65, 128, 256, 1000])
NUMBERS = st.one_of(
    st.integers(-3, 40), st.sampled_from([-(2**63), 2**63 - 1, 2**62, 2**58, -(2**58), 10**17])
)
BYTES = st.builds(bytearray, LENGTHS)


@st.composite
def hostile_buffers(draw):
    content = draw(st.sampled_from([b"", bytes(64), bytes(range(256)) * 4, b"\xff" * 640]))
    kind = draw(st.sampled_from(["array", "bytes", "bytearray", "view", "none", "list", "odd"]))
    words = array("q")
    words.frombytes(content[: len(content) // 8 * 8])
    return {
        "array": words,
        "bytes": content,
        "bytearray": bytearray(content),
        "view": memoryview(words)[: draw(st.integers(0, 30))],
        "none": None,
        "list": [1, 2],
        "odd": memoryview(bytearray(content + b"123"))[1:],
    }[kind]


FIELDS = st.sampled_from(["start", "count", "newest_stamp", "oldest_stamp", "limit"])


def changed(data, link):
    """Return an edge with some fields replaced by random invalid values."""
    for name in data.draw(st.lists(FIELDS)):
        setattr(link, name, data.draw(NUMBERS))
    if data.draw(st.booleans()):
        link.records = data.draw(hostile_buffers())
    return link


PLAINLY = "plainly"


class Bare(Door):
    """Buffer with the kernel's methods only; a text replaces the methods of plain Python."""

    def __init__(self, paths=None, senders=None, listening=(), pending=None):
        self._paths = paths
        self._senders = senders
        self._listening = listening
        self._pending = {} if pending is None else pending

    def _plainly(self, *arguments, **named):
        return PLAINLY

    _plain_lookup_transform = _plain_lookup_transform_full = _plainly
    _plain_can_transform = _plain_set_transform = _plainly


@given(st.data())
def test_fields_that_no_history_has_are_survived(data):
    from tftool.buffer.history import History

    link = History(10**9)
    for stamp in (1, 2, 3):
        link.insert(stamp * 10**9, 5, Transform())
    changed(data, link)
    path = ((link,) * data.draw(st.integers(1, 9)), (link,) * data.draw(st.integers(0, 2)), (link,))
    door = Bare({"a": {"b": path, "c": path}, "b": {"c": path}}, {"b": ("a", "", 5, link)})
    moment, then = data.draw(NUMBERS), data.draw(NUMBERS)

    found = (
        door.lookup_transform("a", "b", moment),
        door.lookup_transform_full("a", moment, "c", then, "b"),
        door.lookup_transform_full("a", moment, "b", then, "a"),
    )
    assert all(one is PLAINLY or isinstance(one, TransformStamped) for one in found)
    assert door.can_transform("a", "b", moment) in (True, PLAINLY)
    sample = TransformStamped(moment, "a", "b", Transform())
    assert door.set_transform(sample) in (True, PLAINLY)


def test_an_insert_survives_changes_made_during_a_garbage_collection():
    from tftool.buffer.history import History

    def of_another_authority(senders):
        senders["b"][3].insert(5000, 5 + (1 << 32), Transform())

    for change in (of_another_authority, dict.clear):
        link = History(10**9)
        for stamp in (100, 200, 300):
            link.insert(stamp, 5, Transform())
        links = [link]
        senders = {"b": ("a", "", 5, link)}
        if change is dict.clear:
            # Then the dictionary has the only reference to the history.
            links.clear()
        del link
        door, late = Bare(senders=senders), TransformStamped(150, "a", "b", Transform())
        waiting = [change]

        def run(phase, _, waiting=waiting, senders=senders):
            if waiting:
                waiting.pop()(senders)

        before = gc.get_threshold()
        # Python stores one slice object for reuse; further slices are new objects.
        slices = [slice(number, number + 1) for number in range(3)]
        gc.callbacks.append(run)
        try:
            gc.set_threshold(1)
            found = door.set_transform(late)
        finally:
            gc.set_threshold(*before)
            gc.callbacks.remove(run)

        assert found in (True, PLAINLY)
        assert len(slices) == 3
        for link in links:
            assert link.origins is None or len(link.origins) == link.count


@given(st.data())
def test_lengths_that_no_batch_has_are_survived(data):
    from tftool.buffer import _kernel
    from tftool.buffer.history import History, StaticLink

    bare = History.__new__(History)
    empty = History(10**9)
    links = [StaticLink((0.0,) * 7), StaticLink(), StaticLink((0,) * 7), None, (), bare, empty]
    for stamps in ((1,), (1, 2, 3)):
        link = History(10**9)
        for stamp in stamps:
            link.insert(stamp * 10**9, 5, Transform())
        links += [link, changed(data, link)]
    up = tuple(data.draw(st.lists(st.sampled_from(links), max_size=3)))
    down = tuple(data.draw(st.lists(st.sampled_from(links), max_size=40)))
    n = data.draw(st.integers(0, 4))
    sizes = [8, 24, 32, 1]
    wrong = data.draw(st.integers(-1, 6))
    if 0 <= wrong < 4:
        sizes[wrong] += 1
    arrays = [bytearray(size * n) for size in sizes]
    arrays[0][:] = array("q", [data.draw(NUMBERS) for _ in range(n)]).tobytes()[: len(arrays[0])]
    arrays[0].extend(bytes(sizes[0] * n - len(arrays[0])))

    try:
        missing = _kernel.solve(up, down, *arrays)
    except ValueError:
        assert 0 <= wrong < 4
        assert n
        return
    assert missing is None or 0 <= missing <= n


def test_no_moments_may_lie_anywhere():
    from tftool.buffer import _kernel

    # From Python 3.13 on, an empty bytearray has such a pointer.
    nothing = memoryview(bytearray(16))

    assert [_kernel.solve((), (), *[nothing[k:k]] * 4) for k in range(9)] == [0] * 9


@pytest.mark.parametrize("arguments", [(), (1,), (1, 2, 3, 4), ({}, 1, 2, 3, 4, 5, 6)])
def test_wrong_arguments_of_a_batch_are_told(arguments):
    from tftool.buffer import _kernel

    with pytest.raises(TypeError, match="takes"):
        _kernel.solve(*arguments)


@pytest.mark.parametrize(
    "arguments", [(), ("a",), ("a", "b", 3, 4, 5, 6, 7), (None,) * 5, (1.5,) * 3]
)
@pytest.mark.parametrize(
    "name", ["lookup_transform", "lookup_transform_full", "can_transform", "set_transform"]
)
def test_arguments_of_the_wrong_number_or_type_are_left_to_plain_python(name, arguments):
    link = object()
    for door in (Bare(), Bare({}, {}), Bare([], []), Bare({"a": {"b": link}}, {"b": link})):
        assert getattr(door, name)(*arguments) == PLAINLY
        assert getattr(door, name)(*arguments, time=0) == PLAINLY


def test_a_door_that_nothing_was_put_into_asks_plainly():
    door = Bare.__new__(Bare)

    assert door.lookup_transform("a", "b") == PLAINLY
    assert door.can_transform("a", "b") == PLAINLY
    assert door.set_transform(TransformStamped(1, "a", "b", Transform())) == PLAINLY


@pytest.mark.parametrize(
    "sender",
    [None, (), (1, 2, 3, 4), ("a", None, 5, None), ("a", "", "five", None), ("a", "", 5, "link")],
)
def test_a_sender_that_is_none_is_left_to_the_plain_path(sender):
    sample = TransformStamped(1, "a", "b", Transform())

    assert Bare({}, {"b": sender}).set_transform(sample) == PLAINLY


@pytest.mark.parametrize("path", [None, (), (1, 2, 3), ((1,), (), ()), ((), (1,), ())])
def test_a_path_that_is_none_is_left_to_the_plain_path(path):
    door = Bare({"a": {"b": path}})

    assert door.lookup_transform("a", "b", 0) == PLAINLY


class Kept(dict):
    """Object that is freed when nothing holds it any more."""


@pytest.mark.parametrize("name", ["_paths", "_senders", "_listening", "_pending"])
def test_objects_held_by_a_door_are_freed_with_it(name):
    for leads_back in (False, True):
        door, kept = Bare(), Kept()
        setattr(door, name, kept)
        if leads_back:
            kept[door] = None
        gone = weakref.ref(kept)
        del door, kept
        if leads_back:
            gc.collect()

        assert gone() is None


def test_the_collector_never_sees_an_answer():
    """Check that the garbage collector never sees a result that is incomplete or cached.

    Code that the collector runs could otherwise look at missing items.
    """
    buffer = Buffer(seconds(10))
    buffer.set_transform(TransformStamped(5, "a", "b", Transform((1.0, 0.0, 0.0))))

    for answer in (
        buffer.lookup_transform("a", "b"),
        buffer.lookup_transform("a", "b", 5),
        buffer.lookup_transform_full("a", 5, "b", 5, "a"),
    ):
        pose = answer.transform
        parts = (answer, pose, pose.translation, pose.rotation)
        assert not any(map(gc.is_tracked, parts))


def grown(random, frames):
    """Return samples of a forest: chains of static edges, moving edges, changed parents, loops."""
    for child in range(1, frames):
        parent = max(0, child - random.choice((1, 1, 1, 2, 7)))
        pose = Transform(
            (random.uniform(-1, 1), random.uniform(-1, 1), 0.5),
            unit(tuple(random.gauss(0, 1) for _ in range(4))),
        )
        kind = random.random()
        if kind < 0.5:
            yield "set_transform_static", TransformStamped(0, f"f{parent}", f"f{child}", pose)
        elif kind < 0.95:
            for stamp in range(random.choice((1, 3)), 6):
                above = f"f{parent}"
                if kind > 0.9 and stamp == 4:
                    above = f"f{random.randrange(frames)}"
                yield "set_transform", TransformStamped(seconds(stamp), above, f"f{child}", pose)


@pytest.mark.parametrize("seed", range(4))
def test_first_and_later_questions_of_a_pair_are_answered_as_in_plain_python(seed):
    random, frames = Random(seed), 40
    twins = Twins(seconds(10))
    for call, sample in grown(random, frames):
        twins.ask(call, sample, "me")
    answered = 0
    for _ in range(100):
        ends = f"f{random.randrange(frames)}", f"f{random.randrange(frames)}"
        moment = random.choice((0, 0, seconds(1), seconds(2.25), seconds(3.5), seconds(5)))
        for _ in range(random.choice((1, 1, 3))):
            ours, plain = twins.ask("lookup_transform", *ends, moment)
            assert same(ours, plain)
            answered += isinstance(ours, TransformStamped)
            assert same(*twins.ask("can_transform", *ends, moment))
    assert answered > 12


def test_pairs_that_are_asked_for_once_take_no_memory():
    buffer = Buffer(seconds(10))
    for child in range(1, 400):
        for stamp in (1, 2):
            sample = TransformStamped(stamp, f"f{child // 3}", f"f{child}", Transform())
            buffer.set_transform(sample, "me")
    names = [f"f{number}" for number in range(400)]
    random = Random(1)
    buffer.lookup_transform("f7", "f300", 1)
    tracemalloc.start()
    for target, source in random.sample(list(itertools.permutations(names, 2)), 20_000):
        buffer.lookup_transform(target, source, 1)
    held, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()

    # A cached path takes more than 200 bytes.
    assert held < 20_000 * 20


def test_arguments_by_name_and_wrong_ones_are_as_in_plain_python():
    twins = Twins(seconds(10))
    for stamp in (1, 2):
        twins.ask("set_transform", TransformStamped(stamp, "a", "b", Transform()), authority="me")
    both = [
        twins.ask("lookup_transform", "a", source_frame="b", time=1),
        twins.ask("lookup_transform", target_frame="a", source_frame="b"),
        twins.ask("can_transform", "a", "b", time=5),
        twins.ask("lookup_transform_full", "a", 1, "b", source_time=2, fixed_frame="b"),
        twins.ask("lookup_transform_full", "a", 1, "a", 2, "a"),
        twins.ask("lookup_transform_full", "c", 1, "c", 2, "c"),
    ]

    assert all(same(ours, plain) for ours, plain in both)
    for wrong in (("a",), ("a", "b", 1, 2)):
        ours, plain = twins.ask("lookup_transform", *wrong)
        assert ours[0] is plain[0] is TypeError
        assert ours[1].split("lookup_transform()")[1] == plain[1].split("lookup_transform()")[1]


@pytest.mark.parametrize("name", [5, None, b"b", ["b"]])
def test_names_that_are_no_strings_are_refused_as_in_plain_python(name):
    twins = Twins(seconds(10))
    for stamp in (1, 2):
        twins.ask("set_transform", TransformStamped(stamp, "a", "b", Transform()), "me")
    twins.ask("lookup_transform_full", "a", 1, "b", 2, "a")

    for asked in (("a", 1, name, 2, "a"), ("a", 1, "b", 2, name), (name, 1, "b", 2, "a")):
        ours, plain = twins.ask("lookup_transform_full", *asked)
        assert ours == plain
        assert ours[0] is TypeError


@pytest.mark.parametrize("repeated", [100, 50, 1])
def test_samples_that_are_there_already_take_no_memory(repeated):
    buffer = Buffer(seconds(10), log=lambda level, text: None)
    for stamp in range(1, 101):
        buffer.set_transform(TransformStamped(stamp, "a", "b", Transform()), "me")
    again = TransformStamped(repeated, "a", "b", Transform())
    tracemalloc.start()
    for _ in range(20_000):
        buffer.set_transform(again, "me")
    grown, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()

    assert len(buffer.samples("b")) == 100
    # A record has 64 bytes; meanwhile Python reserves memory for about two thousand small objects.
    assert grown < 64 * 5000


def test_moments_that_lie_at_any_byte_are_asked_for():
    buffer = Buffer()
    for stamp in (1, 3):
        pose = Transform((float(stamp), 0.0, 0.0))
        buffer.set_transform(TransformStamped(seconds(stamp), "a", "b", pose))
    raw = bytes(4) + np.array([seconds(1), seconds(2)]).tobytes()

    found = buffer.lookup_transforms("a", "b", np.frombuffer(raw, np.int64, offset=4))

    assert found.translations[:, 0].tolist() == [1.0, 2.0]


def test_listeners_and_requests_are_told_of_what_the_kernel_took():
    buffer = Buffer()
    told = []
    buffer.set_transform(TransformStamped(1, "a", "b", Transform()), "me")
    stop = buffer.listen(lambda sample, static, authority: told.append((sample.stamp, authority)))
    buffer.set_transform(TransformStamped(2, "a", "b", Transform()), "me")
    buffer.request(lambda handle, answered: told.append(answered), "a", "b", 3)
    stop()
    buffer.set_transform(TransformStamped(3, "a", "b", Transform()), "me")
    buffer.set_transform(TransformStamped(4, "a", "b", Transform()), "me")

    assert told == [(2, "me"), True]


def test_a_batch_and_inserts_go_together(monkeypatch):
    # Columns that a batch reads cannot grow. So the insert copies them, and the batch reads the old
    # ones.
    read = columns_read(monkeypatch)
    buffer = Buffer(seconds(1))
    pose = Transform((1.0, 0.0, 0.0))
    for number in range(1, 200):
        buffer.set_transform(TransformStamped(number * 10**7, "a", "b", pose))
    buffer.samples("b")
    (column,) = read
    before = column.records.copy()

    for number in range(200, 600):
        stamp = number * 10**7 - (3 * 10**7 if number % 5 == 0 else 0)
        assert buffer.set_transform(TransformStamped(stamp, "a", "b", pose))
        assert buffer.set_transform(TransformStamped(stamp - 9 * 10**8, "a", "b", pose))

    assert np.array_equal(column.records, before)
    assert buffer.lookup_transform("a", "b").stamp == 599 * 10**7


@given(
    st.lists(transforms, min_size=2, max_size=6),
    st.lists(st.one_of(st.integers(-5, 80), st.sampled_from([2**63 - 1, -(2**63)])), max_size=300),
    st.booleans(),
)
def test_a_batch_and_its_plain_twin_agree(poses, moments, ordered):
    twins = Twins(seconds(100))
    twins.ask("set_transform_static", TransformStamped(0, "c", "b", poses[0]))
    for number, pose in enumerate(poses):
        for link, (parent, child) in enumerate((("a", "b"), ("a", "d"), ("c", "a"))):
            # Some samples have equal stamps, and d changes its parent.
            stamp = 10**7 * (1 + number // 2 * 2 + link % 2)
            parent = "c" if child == "d" and number == 3 else parent
            twins.ask("set_transform", TransformStamped(stamp, parent, child, pose))
    asked = [moment * 10**6 if abs(moment) < 100 else moment for moment in moments]
    asked = np.array(sorted(asked) if ordered else asked, dtype=np.int64)

    for target, source in (("a", "b"), ("d", "b"), ("b", "d")):
        ours, plain = twins.ask("lookup_transforms", target, source, asked, missing="nan")
        assert ours.stamps.tolist() == plain.stamps.tolist()
        assert ours.valid.tolist() == plain.valid.tolist()
        np.testing.assert_allclose(ours.translations, plain.translations, 0, REACH * 1e-15)
        np.testing.assert_allclose(ours.rotations, plain.rotations, 0, 1e-15)
        twins_raised = twins.ask("lookup_transforms", target, source, asked)
        if isinstance(twins_raised[0], tuple):
            assert repr(twins_raised[0]) == repr(twins_raised[1])


def test_a_path_of_more_links_than_the_kernel_reads_is_answered_plainly():
    twins, links = Twins(seconds(10)), 130
    for link in range(links):
        for stamp in (1, 2):
            pose = Transform((float(stamp), 0.5, 0.0), (0.0, 0.0, 0.6, 0.8))
            sample = TransformStamped(seconds(stamp), f"f{link}", f"f{link + 1}", pose)
            twins.ask("set_transform", sample)

    for end in (127, 128, 129, 130):
        ours, plain = twins.ask("lookup_transform", "f0", f"f{end}", seconds(1.5))
        assert repr(ours) == repr(plain)
        ours, plain = twins.ask("lookup_transforms", "f0", f"f{end}", [seconds(1.5)])
        assert repr(ours.rotations) == repr(plain.rotations)
