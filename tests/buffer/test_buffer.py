import logging
import math

import numpy as np
import pytest

from tftool.base.errors import (
    BackwardExtrapolationException,
    ConnectivityException,
    ForwardExtrapolationException,
    InvalidArgumentException,
    LookupException,
    NoDataForExtrapolationException,
    TransformException,
)
from tftool.base.stamps import seconds
from tftool.buffer.buffer import MAX_FRAMES, NO_LIMIT, Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform


@pytest.fixture
def said():
    return []


@pytest.fixture
def buffer(said):
    return Buffer(log=lambda level, text: said.append((level, text)))


def put(buffer, at, x=0.0, parent="world", child="turtle1", turn=(0, 0, 0, 1), static=False):
    sample = TransformStamped(seconds(at), parent, child, Transform((x, 0.0, 0.0), turn))
    return (buffer.set_transform_static if static else buffer.set_transform)(sample, "test")


def test_the_first_question_about_a_pair_asks_no_subclass_once_more():
    asked = []

    class Other(Buffer):
        def lookup_transform(self, target_frame, source_frame, time=0):
            asked.append(time)
            return super().lookup_transform(target_frame, source_frame, time)

    other = Other()
    put(other, 1, 1.0)
    put(other, 3, 3.0)

    first = other.lookup_transform("world", "turtle1", seconds(2))
    assert first == other.lookup_transform("world", "turtle1", seconds(2))
    assert first.transform.translation.x == pytest.approx(2.0)
    assert asked == [seconds(2)] * 2


@pytest.mark.parametrize(
    ("second", "kind", "told"),
    [
        (8, BackwardExtrapolationException, "2.000 s before the oldest sample of 'turtle1'"),
        (11.5, ForwardExtrapolationException, "0.500 s after the newest sample of 'turtle1'"),
    ],
)
def test_lookup_outside_the_history_says_by_how_much(buffer, second, kind, told):
    put(buffer, 10)
    put(buffer, 11)
    with pytest.raises(kind) as refused:
        buffer.lookup_transform("world", "turtle1", seconds(second))

    assert told in refused.value.remedy
    assert refused.value.requested == seconds(second)
    assert refused.value.available == seconds(10 if second < 10 else 11)
    assert refused.value.frame == "turtle1"
    assert (refused.value.target, refused.value.source) == ("world", "turtle1")


def test_a_miss_too_small_for_the_message_is_told_in_nanoseconds(buffer):
    put(buffer, 4)
    put(buffer, 5)
    with pytest.raises(ForwardExtrapolationException) as refused:
        buffer.lookup_transform("world", "turtle1", seconds(5) + 7)

    assert "Requested time 5.000000 but the latest data is at time 5.000000" in str(refused.value)
    assert "The requested time is 7 ns after the newest sample" in refused.value.remedy


@pytest.mark.parametrize(
    ("second", "told"),
    [(3, "1.000 s after the only sample"), (1, "1.000 s before the only sample")],
)
def test_a_single_sample_is_told_as_one(buffer, second, told):
    put(buffer, 2)
    with pytest.raises(NoDataForExtrapolationException) as refused:
        buffer.lookup_transform("world", "turtle1", seconds(second))

    assert told in refused.value.remedy


def test_a_cleared_link_is_told_as_empty(buffer):
    put(buffer, 2)
    buffer.clear()
    with pytest.raises(NoDataForExtrapolationException) as refused:
        buffer.lookup_transform("world", "turtle1", seconds(2))

    assert refused.value.remedy == "There are no samples of 'turtle1': wait until a sample is sent."


def test_an_unknown_frame_is_told_with_those_that_look_like_it(buffer):
    with pytest.raises(LookupException) as refused:
        buffer.lookup_transform("turtel1", "world")
    assert refused.value.remedy == "No transform has arrived yet, so 'turtel1' is unknown."
    put(buffer, 1)
    with pytest.raises(LookupException) as refused:
        buffer.lookup_transform("turtel1", "world")
    assert (
        refused.value.remedy == "No transform of 'turtel1' has arrived yet; did you mean 'turtle1'?"
    )
    assert refused.value.frame == "turtel1"
    with pytest.raises(LookupException) as refused:
        buffer.lookup_transform("map", "world")
    assert (
        refused.value.remedy == "No transform of 'map' has arrived yet; 2 other frames are known."
    )


def test_a_slash_is_told_how_to_go_without(buffer):
    with pytest.raises(InvalidArgumentException) as refused:
        buffer.lookup_transform("/world", "turtle1")
    assert refused.value.remedy == "Use 'world'."
    with pytest.raises(InvalidArgumentException) as refused:
        buffer.lookup_transform("", "turtle1")
    assert refused.value.remedy == "Give the name of a frame."


def test_two_trees_are_told_as_two(buffer):
    put(buffer, 1)
    put(buffer, 1, parent="map", child="robot")
    with pytest.raises(ConnectivityException) as refused:
        buffer.lookup_transform("robot", "turtle1")

    assert "No chain of transforms connects 'turtle1' with 'robot'" in refused.value.remedy
    assert TransformException("x").remedy == ""
    assert LookupException("x").remedy == ""


def test_a_loop_is_told_as_one(buffer):
    put(buffer, 1, parent="a", child="b")
    put(buffer, 1, parent="b", child="a")
    put(buffer, 1, parent="x", child="y")
    with pytest.raises(LookupException) as refused:
        buffer.lookup_transform("y", "a")

    assert refused.value.looped
    assert "is below one of its own children" in refused.value.remedy
    assert not buffer.can_transform("a", "y", seconds(1))
    snapshot = buffer.snapshot(now=seconds(2))
    assert snapshot.loops() == ("b", "a")
    assert snapshot.roots() == ("x",)
    assert snapshot.frame("a").root_from_frame is None


# Bad input


@pytest.mark.parametrize("time", [1.5, 2.0, None, "now", np.float64(3)])
def test_a_time_that_is_no_whole_number_is_refused_with_the_remedy(buffer, time):
    put(buffer, 1)
    for ask in (buffer.lookup_transform, buffer.can_transform, buffer.why_not, buffer.chain):
        with pytest.raises(TypeError, match=r"stamps are whole nanoseconds.*seconds\(2.5\)"):
            ask("world", "turtle1", time)
    with pytest.raises(TypeError, match="whole nanoseconds"):
        buffer.set_transform(TransformStamped(time, "world", "turtle1", Transform()), "test")
    assert buffer.lookup_transform("world", "turtle1").stamp == seconds(1)


def test_numpys_whole_numbers_are_taken_and_come_out_as_pythons(buffer):
    for at in (1, 2):
        sample = TransformStamped(np.int64(seconds(at)), "world", "turtle1", Transform())
        assert buffer.set_transform(sample, "test")

    found = buffer.lookup_transform("world", "turtle1", np.int64(seconds(1.5)))

    assert type(found.stamp) is int
    assert type(buffer.lookup_transform("world", "turtle1").stamp) is int


@pytest.mark.parametrize("stamp", [2**63, -(2**63) - 1, 10**30])
def test_a_stamp_beyond_64_bits_is_refused_with_a_sentence(buffer, said, stamp):
    sample = TransformStamped(stamp, "world", "turtle1", Transform())
    assert not buffer.set_transform(sample, "test")
    assert "does not fit 64 bits" in said[-1][1]
    assert buffer.frames() == []
    put(buffer, 1)
    assert not buffer.set_transform(sample, "test")
    assert len(said) == 2
    assert buffer.lookup_transform("world", "turtle1").stamp == seconds(1)
    assert not buffer.can_transform("world", "turtle1", stamp)


def test_stamps_at_the_limits_of_64_bits_work(buffer):
    for stamp in (-(2**63), 2**63 - 1):
        child = f"at{stamp}"
        assert buffer.set_transform(TransformStamped(stamp, "world", child, Transform()), "test")
        assert buffer.lookup_transform("world", child, stamp).stamp == stamp


def test_negative_stamps_are_moments_like_others(buffer):
    put(buffer, -2, x=0.0)
    put(buffer, -1, x=2.0)

    found = buffer.lookup_transform("world", "turtle1", seconds(-1.5))

    assert found.transform.translation.x == 1.0
    assert buffer.lookup_transform("world", "turtle1").stamp == seconds(-1)


QUESTIONS = {
    "lookup_transform": lambda buffer, name: buffer.lookup_transform("world", name),
    "of itself": lambda buffer, name: buffer.lookup_transform(name, "world"),
    "full": lambda buffer, name: buffer.lookup_transform_full("world", 0, "turtle1", 0, name),
    "batch": lambda buffer, name: buffer.lookup_transforms("world", name, [seconds(1)]),
    "can_transform": lambda buffer, name: buffer.can_transform("world", name),
    "common time": lambda buffer, name: buffer.get_latest_common_time("world", name),
    "parent": lambda buffer, name: buffer.parent(name),
    "frame_exists": lambda buffer, name: buffer.frame_exists(name),
}


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("frame", [None, 7, b"world", [], {}])
def test_a_name_that_is_no_string_is_a_mistake_of_the_program(buffer, question, frame):
    put(buffer, 1)
    with pytest.raises(TypeError, match=r"a frame's name is a string|str object expected"):
        QUESTIONS[question](buffer, frame)


@pytest.mark.parametrize("stamp", ["1", 1.5, None])
def test_a_stamp_that_is_no_whole_number_is_refused_of_a_parent_as_of_a_lookup(buffer, stamp):
    put(buffer, 1)
    with pytest.raises(TypeError, match=r"stamps are whole nanoseconds|int object expected"):
        buffer.parent("turtle1", stamp)
    with pytest.raises(TypeError, match=r"stamps are whole nanoseconds|int object expected"):
        buffer.lookup_transform("world", "turtle1", stamp)


@pytest.mark.parametrize("place", [0, 1])
def test_a_whole_number_beyond_all_floats_is_no_coordinate(place):
    parts = [[0, 0, 0], [0, 0, 0, 1]]
    parts[place][0] = 10**5000
    with pytest.raises(ValueError, match="too large"):
        Transform(*parts)


@pytest.mark.parametrize(("parent", "child"), [("world", "é" * 2049), ("x" * 4097, "turtle1")])
def test_a_name_of_more_bytes_than_the_limit_is_refused_and_its_sender_told(
    buffer, said, parent, child
):
    put(buffer, 1)

    assert not put(buffer, 2, parent=parent, child=child)
    assert not put(buffer, 2, parent=parent, child=child, static=True)

    assert buffer.frames() == ["turtle1", "world"]
    (level, told), again = said
    assert level == "ERROR"
    assert again == (level, told)
    assert "TF_LONG_NAME" in told
    assert 'from authority "test"' in told
    assert "the limit is 4096" in told
    assert len(told) < 300


def test_a_name_as_long_as_the_limit_is_taken_and_the_limit_can_be_chosen():
    assert put(Buffer(), 1, child="é" * 2048)
    assert put(Buffer(max_name=10**6), 1, child="x" * 10**6)
    assert not put(Buffer(max_name=3, log=lambda level, text: None), 1, child="four")


def test_a_strangers_hundred_thousand_names_are_bounded(said):
    buffer = Buffer(log=lambda level, text: said.append(text))
    accepted = sum(put(buffer, 1, child=f"stranger{n}") for n in range(100_000))

    assert accepted == MAX_FRAMES - 1
    assert len(buffer.frames()) == MAX_FRAMES
    assert f"already has {MAX_FRAMES} frame names" in said[-1]
    assert "max_frames" in said[-1]
    # Stored samples are not lost, and known frames are still accepted.
    assert put(buffer, 2, child="stranger7")
    assert not put(buffer, 2, parent="new parent", child="stranger7")
    assert buffer.lookup_transform("world", "stranger7", seconds(1.5)).stamp == seconds(1.5)


def test_the_number_of_frames_can_be_raised_or_lowered(said):
    buffer = Buffer(max_frames=2, log=lambda level, text: said.append(text))

    assert put(buffer, 1)
    assert not put(buffer, 1, child="turtle2")
    assert Buffer(max_frames=10**6).max_frames == 10**6


def test_a_buffer_says_what_it_is():
    buffer = Buffer(seconds(2.5))
    buffer.set_transform(TransformStamped(1, "map", "base", Transform()), "me")

    assert repr(buffer) == "<Buffer: 2 frames, keeps 2.5 s>"
    assert repr(Buffer(NO_LIMIT)) == "<Buffer: 0 frames, keeps all>"


def test_a_name_may_hold_anything(buffer):
    odd = "[bold]\x1b[2J a'b\"\\\n"
    put(buffer, 1, child=odd)

    assert buffer.lookup_transform("world", odd).child_frame_id == odd
    assert buffer.frames() == [odd, "world"]


@pytest.mark.parametrize("cache_time", [-1, 1.5])
def test_a_cache_time_that_is_none_is_refused(cache_time):
    with pytest.raises((ValueError, TypeError), match=r"cache_time|whole nanoseconds"):
        Buffer(cache_time)


def test_infinite_turns_are_refused_and_infinite_places_are_not(buffer, said):
    assert not put(buffer, 1, turn=(math.inf, 0, 0, 1))
    assert put(buffer, 1, x=math.inf)
    assert put(buffer, 2, x=-math.inf)
    assert buffer.lookup_transform("world", "turtle1").transform.translation.x == -math.inf
    assert not put(buffer, 3, x=math.nan)
    assert [text.split(":")[0] for _, text in said] == [
        "TF_NAN_INPUT",
        "TF_DENORMALIZED_QUATERNION",
        "TF_NAN_INPUT",
    ]
    assert {level for level, _ in said} == {"ERROR"}


def test_infinite_places_whose_sum_is_no_number_are_taken_as_well(buffer):
    corner = Transform((math.inf, -math.inf, 0.0))
    for at in (1, 2):
        assert buffer.set_transform(TransformStamped(at, "world", "corner", corner), "test")
        assert buffer.lookup_transform("world", "corner").transform == corner


def test_huge_and_tiny_quaternions_mean_their_direction(buffer):
    put(buffer, 1, turn=(0, 0, 3e200, 4e200))
    assert buffer.lookup_transform("world", "turtle1").transform.rotation == pytest.approx(
        (0, 0, 0.6, 0.8)
    )
    put(buffer, 2, turn=(0, 0, 3e-100, -4e-100))
    assert buffer.lookup_transform("world", "turtle1").transform.rotation == pytest.approx(
        (0, 0, -0.6, 0.8)
    )


def test_a_buffer_nobody_gave_a_log_tells_pythons_logging(caplog):
    buffer = Buffer()
    with caplog.at_level(logging.WARNING, logger="tftool.buffer"):
        put(buffer, 20)
        assert not put(buffer, 1)
        assert not put(buffer, 1, child="world")

    assert [(record.levelname, record.message.split()[0]) for record in caplog.records] == [
        ("WARNING", "TF_OLD_DATA"),
        ("ERROR", "TF_SELF_TRANSFORM:"),
    ]


# Listening


def test_listeners_are_told_every_accepted_sample_as_it_is_kept(buffer):
    heard = []
    stop = buffer.listen(
        lambda sample, static, authority: heard.append((sample, static, authority))
    )
    put(buffer, 1, turn=(0, 0, 0, -2))
    put(buffer, 2)
    put(buffer, 2, x=math.nan)
    buffer.set_transform_static(TransformStamped(0, "/world", "/post", Transform()), "mason")
    stop()
    put(buffer, 3)

    assert [(sample.stamp, static, authority) for sample, static, authority in heard] == [
        (seconds(1), False, "test"),
        (seconds(2), False, "test"),
        (0, True, "mason"),
    ]
    assert heard[0][0].transform.rotation == (0, 0, 0, 1)
    assert (heard[2][0].frame_id, heard[2][0].child_frame_id) == ("world", "post")


def test_a_callback_that_fails_keeps_nobody_else_from_being_told(buffer, said):
    heard = []

    def failing(*told):
        heard.append("failing")
        raise RuntimeError(f"mistake {len(heard)}")

    buffer.listen(failing, "drawer")
    buffer.listen(lambda *told: heard.append("listener"))
    buffer.request(failing, "world", "turtle1", seconds(1))
    buffer.request(lambda *told: heard.append("waiter"), "world", "turtle1", seconds(1))

    put(buffer, 1)

    assert heard == ["failing", "listener", "failing", "waiter"]
    assert [level for level, _ in said] == ["ERROR", "ERROR"]
    assert "a listener of 'drawer' failed: RuntimeError: mistake 1 (test_buffer.py:" in said[0][1]
    assert "a listener failed: RuntimeError: mistake 3 (test_buffer.py:" in said[1][1]
    assert buffer.can_transform("world", "turtle1")


@pytest.mark.parametrize("static", [False, True])
@pytest.mark.parametrize(
    "sample",
    [
        "x",
        "abcd",
        None,
        Transform(),
        TransformStamped(1, "world", "turtle1", None),
        TransformStamped(1, "world", "turtle1", ((0, 0, 0), (0, 0, 0, 1))),
    ],
)
def test_a_value_that_is_no_sample_is_refused_with_the_expected_type(buffer, sample, static):
    put(buffer, 0.5)
    setter = buffer.set_transform_static if static else buffer.set_transform

    with pytest.raises(TypeError, match=r"expected a TransformStamped\(stamp, .* not "):
        setter(sample, "me")

    assert buffer.snapshot(0).frame("turtle1").samples == 1


def test_a_cache_time_that_looks_like_seconds_is_warned_of_with_the_remedy(said):
    Buffer(10, log=lambda level, text: said.append((level, text)))
    Buffer(0, log=lambda level, text: said.append((level, text)))
    Buffer(seconds(0.001), log=lambda level, text: said.append((level, text)))

    assert [level for level, _ in said] == ["WARN"]
    assert "with a cache_time of 10 ns nearly all samples are dropped at once" in said[0][1]
    assert "for 10 s write seconds(10)" in said[0][1]


def test_one_callback_registered_twice_is_called_until_both_are_stopped(buffer):
    heard = []

    def hear(*_):
        heard.append("sample")

    stop = buffer.listen(hear)
    buffer.listen(hear)
    stop()
    stop()
    put(buffer, 1)

    assert heard == ["sample"]


def test_a_listener_may_stop_itself_and_others(buffer):
    heard = []
    stops = []

    def first(sample, static, authority):
        heard.append("first")
        for stop in stops:
            stop()

    stops.append(buffer.listen(first))
    stops.append(buffer.listen(lambda sample, static, authority: heard.append("second")))
    put(buffer, 1)
    put(buffer, 2)

    assert heard == ["first", "second"]


# Lookup plans


def test_an_answer_follows_the_tree_when_that_changes(buffer):
    put(buffer, 1, parent="a", child="b", x=1.0)
    put(buffer, 1, parent="b", child="c", x=1.0)
    assert buffer.lookup_transform("a", "c").transform.translation.x == 2.0
    put(buffer, 2, parent="a", child="c", x=5.0)
    assert buffer.lookup_transform("a", "c").transform.translation.x == 5.0
    assert buffer.lookup_transform("a", "c", seconds(1)).transform.translation.x == 2.0
    put(buffer, 0, parent="a", child="b", x=7.0, static=True)
    assert buffer.lookup_transform("a", "c", seconds(1)).transform.translation.x == 8.0
    put(buffer, 0, parent="a", child="b", x=9.0, static=True)
    assert buffer.lookup_transform("a", "c", seconds(1)).transform.translation.x == 10.0
    buffer.clear()
    assert not buffer.can_transform("a", "c")
    assert buffer.lookup_transform("a", "b").transform.translation.x == 9.0


def test_a_run_of_statics_counts_as_one_link(buffer):
    for n in range(5):
        put(buffer, 0, parent=f"s{n}", child=f"s{n + 1}", x=1.0, turn=(0, 0, 1, 1), static=True)
    put(buffer, 1, parent="s5", child="moving", x=1.0)
    put(buffer, 3, parent="s5", child="moving", x=3.0)

    for _ in range(2):
        found = buffer.lookup_transform("s0", "moving", seconds(2))
        # Four quarter turns are a full turn; the fifth adds one more.
        assert found.transform.translation == pytest.approx((1.0, 2.0, 0.0), abs=1e-12)
        assert found.transform.rotation == pytest.approx((0, 0, math.sqrt(0.5), math.sqrt(0.5)))
        assert buffer.lookup_transform("s0", "s5", seconds(9)).stamp == seconds(9)


def test_more_pairs_may_be_asked_for_than_are_remembered(buffer, monkeypatch):
    monkeypatch.setattr("tftool.buffer.solver.MOST_PATHS", 3)
    for n in range(6):
        put(buffer, 1, child=f"t{n}", x=float(n))

    for n in range(6):
        assert buffer.lookup_transform("world", f"t{n}").transform.translation.x == n
        assert buffer.lookup_transform(f"t{n}", "t0").transform.translation.x == -n


def test_a_thousand_links_are_a_chain_and_one_more_is_a_loop(buffer):
    for n in range(1001):
        put(buffer, 1, parent=f"f{n}", child=f"f{n + 1}", x=1.0)

    for _ in range(2):
        assert buffer.lookup_transform("f1", "f1001").transform.translation.x == 1000.0
    with pytest.raises(LookupException) as refused:
        buffer.lookup_transform("f0", "f1001")
    assert refused.value.looped
    assert len(buffer.snapshot(0).frames) == 1002


@pytest.mark.parametrize("name", [None, 5, b"world"])
def test_a_name_that_is_no_string_is_refused_by_name(buffer, name):
    for parent, child in ((name, "turtle1"), ("world", name)):
        with pytest.raises(TypeError, match=r"a frame's name is a string, not"):
            buffer.set_transform(TransformStamped(1, parent, child, Transform()), "test")

    assert buffer.frames() == []


def test_the_parents_of_a_frame_are_those_of_the_samples_it_remembers():
    buffer = Buffer(cache_time=seconds(10))
    for second, parent in ((1, "a"), (2, "b"), (3, "b")):
        buffer.set_transform(TransformStamped(seconds(second), parent, "c", Transform()))

    assert buffer.parents("c") == {"a", "b"}
    assert buffer.parents("a") == buffer.parents("unheard") == set()

    for second in (13, 14):
        buffer.set_transform(TransformStamped(seconds(second), "b", "c", Transform()))
    buffer.set_transform_static(TransformStamped(0, "w", "s", Transform()))

    assert buffer.parents("c") == {"b"}
    assert buffer.parents("s") == {"w"}
