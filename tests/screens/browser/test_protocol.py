"""Tests of the messages to the page and from it."""

import itertools
import json
import math
import struct
from pathlib import Path

import pytest

from tftool.base.errors import InputError
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.screens.browser import protocol
from tftool.screens.browser.marks import marks_of
from tftool.screens.browser.page_messages import (
    ANSWERS,
    PageRequest,
    answer,
    as_javascript,
    parse,
)

EPOCH = seconds(1000)


def span(first, last, count):
    return {"from": first, "to": last, "count": count}


SERIES = '{"type": "series", "target": "a", "source": "b", "from": %s, "to": %s, "count": %s}'
TRAILS = '{"type": "trails", "fixed": "map", "frames": %s, "from": 1, "to": 2, "count": 3}'


@pytest.mark.parametrize(
    ("said", "kind", "fields"),
    [
        ('{"type": "show", "at": 1.5}', "show", {"at": 1.5}),
        ('{"type": "show", "at": null}', "show", {"at": None}),
        ('{"type": "show"}', "show", {"at": None}),
        ('{"type": "pair", "target": "a", "source": "b"}', "pair", {"target": "a", "source": "b"}),
        (
            '{"type": "pair", "target": null, "source": null}',
            "pair",
            {"target": None, "source": None},
        ),
        ('{"type": "got", "sequence": 7}', "got", {"sequence": 7}),
        ('{"type": "key", "key": "left"}', "key", {"key": "left"}),
        ('{"type": "past"}', "past", {}),
        ('{"type": "marks"}', "marks", {}),
        (
            '{"type": "series", "target": "a", "source": "b", "from": 1, "to": 2.5, "count": 9}',
            "series",
            {"target": "a", "source": "b", **span(1.0, 2.5, 9)},
        ),
        (
            TRAILS % '["a", "b"]',
            "trails",
            {"fixed": "map", "frames": ("a", "b"), **span(1.0, 2.0, 3)},
        ),
    ],
)
def test_page_requests_are_parsed_into_their_kind_and_fields(said, kind, fields):
    assert parse(said) == PageRequest(kind, fields)


@pytest.mark.parametrize(
    ("said", "told"),
    [
        (b"\x00\x01", "must send text"),
        ("", "not JSON"),
        ("{", "not JSON"),
        ("[" * 100_000, "not JSON"),
        ("null", "show, pair, got, move, key, past, series, trails or marks"),
        ("[]", "show, pair, got, move, key, past, series, trails or marks"),
        ('{"type": "shutdown"}', "show, pair, got, move, key, past, series, trails or marks"),
        ('{"type": ["show"]}', "show, pair, got, move, key, past, series, trails or marks"),
        ('{"type": "show", "at": "now"}', "a number of seconds"),
        ('{"type": "show", "at": NaN}', "a number of seconds"),
        ('{"type": "show", "at": 1e300}', "a number of seconds"),
        ('{"type": "show", "at": 1' + "0" * 400 + "}", "a number of seconds"),
        ('{"type": "pair", "target": "a"}', "names of frames"),
        (
            '{"type": "pair", "target": 1, "source": 2}',
            "'target' .* must be the name of a frame, or null",
        ),
        (
            '{"type": "got", "sequence": "1"}',
            "'sequence' of a message 'got' must be a whole number",
        ),
        ('{"type": "key", "key": "q"}', "up, down, left, right"),
        (
            '{"type": "series", "target": "a"}',
            "'source' .* must be the name of a frame",
        ),
        (
            '{"type": "trails", "fixed": "a"}',
            "'frames' .* must be a list of at most 60",
        ),
        (TRAILS % "[1]", "60 names"),
        (TRAILS % json.dumps(["a"] * 61), "60 names"),
        (SERIES % (5, 4, 10), "after it begins"),
        (SERIES % ("NaN", 4, 10), "a number of seconds"),
        (SERIES % ("null", 4, 10), "a number of seconds"),
        (SERIES % (0, 4, 1), "from 2 to 2000"),
        (SERIES % (0, 4, 10**9), "from 2 to 2000"),
    ],
)
def test_anything_else_is_refused_with_a_sentence(said, told):
    with pytest.raises(InputError, match=told):
        parse(said)


def test_the_pages_side_is_written_from_the_table():
    written = Path(protocol.__file__).with_name("page") / "messages.js"

    assert written.read_text(encoding="utf-8") == as_javascript(), (
        "run python -m tftool.screens.browser.page_messages"
    )


def test_an_answer_has_the_fields_of_the_table_and_no_others():
    span = {"now": 1.0, "oldest": 0.0, "newest": 1.0}

    assert answer("range", span) == {"type": "range", **span}
    assert answer("tracks", {}) == {"type": "tracks"}
    for wrong in ({**span, "more": 1}, {"now": 1.0}):
        with pytest.raises(AssertionError):
            answer("range", wrong)


def follows(value, javascript):
    """Return whether a decoded JSON value has a type of the table, without looking inside."""
    plain = {"string": str, "number": (int, float), "boolean": bool}
    if javascript in plain:
        return isinstance(value, plain[javascript])
    if javascript == "number | null":
        return value is None or isinstance(value, (int, float))
    if javascript in ("string[]", "number[]", "(number | null)[]"):
        kind = javascript.removesuffix("[]").strip("()")
        return isinstance(value, list) and all(follows(one, kind) for one in value)
    return isinstance(value, (list, dict))


@pytest.mark.parametrize(
    ("moving", "marked"), [("base_link", [EPOCH + seconds(5)]), ("turtle1", [])]
)
def test_a_jump_is_marked_where_there_is_a_robot_and_not_among_turtles(moving, marked):
    filled = Buffer(seconds(60))
    for tick in range(100):
        # The frame moves a metre per second along x, and jumps half a metre sideways at 5 s.
        pose = Transform((tick / 10, 0.5 if tick >= 50 else 0.0, 0.0))
        stamp = EPOCH + seconds(tick / 10)
        filled.set_transform(TransformStamped(stamp, "map", moving, pose), "driver")
    steps = [one for one in marks_of(filled, EPOCH)["findings"] if one["id"] == "step"]
    assert [EPOCH + seconds(one["since"]) for one in steps] == marked


def test_every_field_of_an_answer_has_the_type_of_the_table():
    filled = buffer()
    snapshot = filled.snapshot(seconds(1004))
    asked = PageRequest("series", {"target": "world", "source": "camera", **span(0.5, 3.5, 4)})
    wanted = PageRequest(
        "trails", {"fixed": "world", "frames": ("camera", "nobody"), **span(0.5, 3.5, 4)}
    )
    answers = [
        protocol.encode_names(EPOCH, 1, snapshot.frames, 3, 1.0, seconds(1001)),
        protocol.encode_range(EPOCH, snapshot),
        protocol.encode_pair(filled, EPOCH, "world", "camera", seconds(1002)),
        protocol.encode_pair(filled, EPOCH, "world", "nobody", 0),
        protocol.encode_series(filled, EPOCH, asked),
        protocol.encode_trails(filled, EPOCH, wanted),
        json.dumps(marks_of(filled, EPOCH)),
    ]
    for text in answers:
        told = json.loads(text)
        types = {name.removesuffix("?"): kind for name, kind in ANSWERS[told.pop("type")].items()}
        assert {
            name: value for name, value in told.items() if not follows(value, types[name])
        } == {}


def test_a_moment_is_never_the_zero_that_means_latest():
    assert protocol.stamp_at(EPOCH, -1000.0) == 1
    assert protocol.stamp_at(EPOCH, -5000.0) == 1
    assert protocol.stamp_at(EPOCH, 0.000000001) == EPOCH + 1


def buffer():
    filled = Buffer()
    for second, x in ((1001, 1.0), (1003, 3.0)):
        pose = Transform((x, 0.0, 0.0))
        filled.set_transform(TransformStamped(seconds(second), "world", "turtle", pose), "mover")
    mounted = Transform((0.0, 0.0, 0.5), (0.0, 0.0, 1.0, 0.0))
    filled.set_transform_static(TransformStamped(0, "turtle", "camera", mounted), "mount")
    return filled


def test_poses_are_a_header_and_eleven_numbers_a_frame():
    snapshot = buffer().snapshot(seconds(1004))

    written = protocol.encode_poses(EPOCH, 5, 2, snapshot, snapshot.frames)

    magic, sequence, revision, count, now, at, oldest, newest = struct.unpack_from(
        "<4sIIIdddd", written
    )
    assert (magic, sequence, revision, count) == (b"TFP1", 5, 2, 3)
    assert (now, oldest, newest) == (4.0, 1.0, 3.0)
    assert math.isnan(at)
    assert [frame.frame for frame in snapshot.frames] == ["turtle", "world", "camera"]
    numbers = struct.unpack_from("<33d", written, 48)
    assert numbers[:11] == (3.0, 0, 0, 0, 0, 0, 1, 3.0, 1.0, 1.0, 2.0)
    assert numbers[22:29] == (0.0, 0.0, 0.5, 0.0, 0.0, 1.0, 0.0)
    assert len(written) == 48 + 3 * 11 * 8


def test_a_frame_without_data_at_the_moment_shown_has_no_pose():
    snapshot = buffer().snapshot(seconds(1004), seconds(1000.5))

    written = protocol.encode_poses(EPOCH, 1, 1, snapshot, snapshot.frames)

    assert all(math.isnan(value) for value in struct.unpack_from("<7d", written, 48))
    assert struct.unpack_from("<d", written, 24) == (0.5,)


def test_names_travel_with_parents_by_place():
    frames = buffer().snapshot(seconds(1004)).frames

    told = json.loads(protocol.encode_names(EPOCH, 3, frames, 5000, math.inf))

    assert told == {
        "type": "frames",
        "epoch": "1000000000000",
        "revision": 3,
        "names": ["turtle", "world", "camera"],
        "parents": [1, -1, 0],
        "statics": [0, 0, 1],
        "authorities": ["mover", "no recorded authority", "mount"],
        "total": 5000,
        "rate": 1.0,
    }


def test_a_pair_is_told_as_lookup_transform_answers():
    filled = buffer()

    told = json.loads(protocol.encode_pair(filled, EPOCH, "world", "camera", seconds(1002)))

    found = filled.lookup_transform("world", "camera", seconds(1002))
    assert told["found"]
    assert told["translation"] == [2.0, 0.0, 0.5]
    assert told["rotation"] == list(found.transform.rotation)
    assert told["rpy"] == pytest.approx([0.0, 0.0, math.pi])
    assert (told["stamp"], told["moment"]) == ("1002.000000", 2.0)
    assert told["chain"] == ["camera", "turtle", "world"]


def test_a_pair_that_cannot_be_told_says_why():
    told = json.loads(protocol.encode_pair(buffer(), EPOCH, "world", "nobody", 0))

    assert not told["found"]
    assert "nobody" in told["why"]


def test_numbers_json_cannot_write_become_null():
    filled = Buffer()
    far = Transform((1e308, 0.0, 0.0))
    filled.set_transform_static(TransformStamped(0, "a", "b", far), "x")
    filled.set_transform_static(TransformStamped(0, "b", "c", far), "x")

    text = protocol.encode_pair(filled, EPOCH, "a", "c", 0)

    assert json.loads(text)["translation"] == [None, 0.0, 0.0]


def test_the_buffers_reach_is_nothing_while_all_is_static():
    filled = Buffer()
    filled.set_transform_static(TransformStamped(0, "a", "b", Transform()), "x")
    snapshot = filled.snapshot(seconds(1004))

    assert protocol.reach(snapshot.frames) is None
    assert json.loads(protocol.encode_range(EPOCH, snapshot)) == {
        "type": "range",
        "now": 4.0,
        "oldest": 4.0,
        "newest": 4.0,
    }


def test_remembered_moments_are_evenly_spaced_and_fewer_for_many_frames():
    frames = buffer().snapshot(seconds(1004)).frames

    few = protocol.moments(frames)
    many = protocol.moments(frames * 10_000)

    assert (len(few), few[0], few[-1]) == (120, seconds(1001), seconds(1003))
    assert len({after - before for before, after in itertools.pairwise(few)}) <= 2
    assert many == [seconds(1001), seconds(1003)]
    assert protocol.moments([]) == []


def test_trails_leave_out_what_is_too_far_away_to_be_rounded():
    far = Buffer()
    for second, x in ((1001, 1e305), (1002, 2.0)):
        far.set_transform(
            TransformStamped(seconds(second), "world", "turtle", Transform((x, 0.0, 0.0))), "me"
        )
    asked = PageRequest("trails", {"fixed": "world", "frames": ("turtle",), **span(1.0, 2.0, 2)})

    told = json.loads(protocol.encode_trails(far, EPOCH, asked), parse_constant=pytest.fail)

    assert told["places"] == {"turtle": [None, [2.0, 0.0, 0.0]]}


def test_trails_to_a_moment_that_no_stamp_holds_are_answered():
    asked = PageRequest("trails", {"fixed": "world", "frames": ("turtle",), **span(1.0, 1e12, 2)})

    told = json.loads(protocol.encode_trails(buffer(), EPOCH, asked))

    assert told["places"] == {"turtle": [[1.0, 0.0, 0.0], None]}


def test_trails_are_places_at_even_moments_and_null_where_none_is_known():
    asked = PageRequest(
        "trails", {"fixed": "world", "frames": ("turtle", "camera", "nobody"), **span(1.0, 4.0, 4)}
    )

    told = json.loads(protocol.encode_trails(buffer(), EPOCH, asked))

    assert {key: told[key] for key in ("type", "fixed", "from", "to")} == {
        "type": "trails",
        "fixed": "world",
        "from": 1.0,
        "to": 4.0,
    }
    assert told["places"] == {
        "turtle": [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0], None],
        "camera": [[1.0, 0.0, 0.5], [2.0, 0.0, 0.5], [3.0, 0.0, 0.5], None],
        "nobody": [None] * 4,
    }
