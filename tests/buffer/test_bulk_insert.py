"""Tests that a batch insert has the same effect as inserts of single samples."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.strategies import transforms
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer, adopt_records
from tftool.buffer.sample import TransformStamped
from tftool.geometry import rigid
from tftool.geometry.rigid import Transform

odd = st.sampled_from(
    [
        Transform((math.nan, 0.0, 0.0)),
        Transform((math.inf, 0.0, 0.0)),
        rigid.transform((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)),
        Transform(rotation=(0.0, 0.0, math.nan, 1.0)),
        Transform(rotation=(0.0, 0.0, 3e200, 4e200)),
        Transform(rotation=(0.0, 0.0, 0.6, -0.8)),
        Transform((1.0, 2.0, 3.0), (0.0, 2.0, 0.0, 0.0)),
    ]
)
groups = st.lists(
    st.tuples(
        st.sampled_from(["world", "/world", "map", "turtle1", ""]),
        st.lists(st.tuples(st.integers(0, 30), st.one_of(odd, transforms)), max_size=12),
        st.sampled_from(["as they are", "sorted", "twice", "after"]),
    ),
    max_size=4,
)


def arranged(rows, how, newest):
    if how == "twice":
        return rows + rows
    if how == "after":
        return [(newest + 1 + k, pose) for k, (_, pose) in enumerate(rows)]
    return rows if how == "as they are" else sorted(rows, key=lambda row: row[0])


def together(buffer, parent, child, rows, authority="me"):
    return buffer.set_transforms(
        parent,
        child,
        np.array([stamp for stamp, _ in rows], dtype=np.int64),
        np.array([pose.translation for _, pose in rows]).reshape(-1, 3),
        np.array([pose.rotation for _, pose in rows]).reshape(-1, 4),
        authority,
    )


def remembered(buffer, child):
    if not buffer.frame_exists(child):
        return None
    held = buffer.samples(child)
    info = buffer.snapshot(0).frame(child)
    columns = [
        column.tolist() for column in (held.stamps, held.parents, held.poses, held.authorities)
    ]
    return columns, info.parent, info.oldest, info.newest, info.authority


@given(groups, st.integers(0, 12))
def test_setting_together_is_setting_one_by_one(groups, limit):
    told, told_at_once = [], []
    single = Buffer(limit, log=lambda *line: told.append(line))
    bulk = Buffer(limit, log=lambda *line: told_at_once.append(line))
    heard, heard_at_once = [], []
    single.listen(lambda *sample: heard.append(sample))
    bulk.listen(lambda *sample: heard_at_once.append(sample))
    for parent, given_rows, how in groups:
        rows = arranged(
            given_rows,
            how,
            single.get_latest_common_time("turtle1", "turtle1")
            if (single.frame_exists("turtle1"))
            else 0,
        )
        told.clear()
        told_at_once.clear()

        taken = [
            single.set_transform(TransformStamped(stamp, parent, "turtle1", pose), "me")
            for stamp, pose in rows
        ]
        report = together(bulk, parent, "turtle1", rows)

        assert report.accepted.tolist() == taken
        assert bool(report) is all(taken)
        assert remembered(bulk, "turtle1") == remembered(single, "turtle1")
        assert bulk.frames() == single.frames()
        if taken.count(False) <= 10:
            assert told_at_once == told
    assert heard_at_once == heard or any(math.nan in sample[0] for sample in heard)
    for time in range(32):
        assert bulk.parent("turtle1", time) == single.parent("turtle1", time)
        assert bulk.why_not("world", "turtle1", time) == single.why_not("world", "turtle1", time)


@given(groups, st.lists(st.tuples(st.integers(0, 40), transforms), max_size=8))
def test_single_samples_go_on_where_many_ended(groups, more):
    single, bulk = (Buffer(12, log=lambda *_: None) for _ in range(2))
    for parent, rows, _ in groups:
        for stamp, pose in rows:
            single.set_transform(TransformStamped(stamp, parent, "turtle1", pose))
        together(bulk, parent, "turtle1", rows, "")
    for stamp, pose in more:
        for buffer in (single, bulk):
            buffer.set_transform(TransformStamped(stamp, "world", "turtle1", pose))

    assert remembered(bulk, "turtle1") == remembered(single, "turtle1")


def line(count, start=1):
    stamps = np.arange(start, start + count, dtype=np.int64) * seconds(1)
    translations = np.zeros((count, 3))
    translations[:, 0] = np.arange(count)
    rotations = np.zeros((count, 4))
    rotations[:, 3] = 1.0
    return stamps, translations, rotations


def test_many_samples_can_be_looked_up():
    buffer = Buffer(seconds(100))

    report = buffer.set_transforms("world", "turtle1", *line(11), "me")

    assert report
    assert len(report) == 11
    assert buffer.lookup_transform("world", "turtle1", seconds(3.5)).transform.translation.x == 2.5


def test_a_plan_made_before_sees_what_came_after():
    buffer = Buffer(seconds(100))
    buffer.set_transforms("world", "turtle1", *line(3))
    buffer.lookup_transform("world", "turtle1")

    buffer.set_transforms("map", "turtle1", *line(3, 4))

    assert buffer.can_transform("map", "turtle1")
    assert not buffer.can_transform("world", "turtle1")


def test_a_pending_request_is_answered_by_a_bulk_insert():
    buffer = Buffer(seconds(100))
    told = []
    buffer.request(lambda handle, there: told.append(there), "world", "turtle1", seconds(3))

    buffer.set_transforms("world", "turtle1", *line(11))

    assert told == [True]


def test_a_static_link_gives_way():
    buffer = Buffer(seconds(100))
    buffer.set_transform_static(TransformStamped(0, "world", "turtle1", Transform()))

    buffer.set_transforms("world", "turtle1", *line(3))

    assert not buffer.snapshot(0).frame("turtle1").is_static


def test_rows_are_refused_each_for_its_reason():
    lines = []
    buffer = Buffer(seconds(5), log=lambda level, text: lines.append((level, text.split()[0])))
    stamps, translations, rotations = line(20)
    stamps[12] = seconds(1)
    translations[2, 1] = np.nan
    rotations[4] = 0.0

    report = buffer.set_transforms("world", "turtle1", stamps, translations, rotations)

    assert report.refused.tolist() == [2, 4, 12]
    assert {code: rows.tolist() for code, rows in report.reasons.items()} == {
        "TF_NAN_INPUT": [2, 4],
        "TF_DENORMALIZED_QUATERNION": [4],
        "TF_OLD_DATA": [12],
    }
    assert lines == [
        ("ERROR", "TF_NAN_INPUT:"),
        ("ERROR", "TF_NAN_INPUT:"),
        ("ERROR", "TF_DENORMALIZED_QUATERNION:"),
        ("WARN", "TF_OLD_DATA"),
    ]


@pytest.mark.parametrize(
    ("count", "rest"),
    [
        (1000, "and 990 more samples for frame turtle1 according to authority me were refused"),
        (11, "and 1 more sample for frame turtle1 according to authority me was refused"),
    ],
)
def test_of_many_refused_rows_the_log_gets_ten_and_the_number(count, rest):
    lines = []
    buffer = Buffer(log=lambda level, text: lines.append(text))
    stamps, translations, rotations = line(count)
    translations[:] = np.nan

    report = buffer.set_transforms("world", "turtle1", stamps, translations, rotations, "me")

    assert len(report.refused) == count
    assert len(lines) == 11
    assert lines[-1].startswith(rest)
    assert buffer.frames() == []


def test_names_beyond_the_limit_are_refused_together():
    lines = []
    buffer = Buffer(log=lambda level, text: lines.append(text), max_frames=1)

    report = buffer.set_transforms("world", "turtle1", *line(50))

    assert report.reasons["TF_TOO_MANY_FRAMES"].tolist() == list(range(50))
    assert len(lines) == 1


def test_a_half_turn_of_the_other_sign_is_no_record_to_keep_as_it_is():
    columns, borrowed = Buffer(), Buffer()
    rows = [(seconds(1), Transform((0.0, 0.0, 0.0), (0.0, 0.0, -1.0, 0.0)))]

    together(columns, "world", "turtle1", rows)
    borrowed.set_records("world", "turtle1", records_of(rows), "me")

    found = [one.lookup_transform("world", "turtle1").transform for one in (columns, borrowed)]
    assert found[0].rotation == found[1].rotation == (0.0, 0.0, 1.0, 0.0)


def test_a_name_that_is_too_long_is_refused_once_for_all_its_samples():
    lines = []
    buffer = Buffer(log=lambda level, text: lines.append(text), max_name=6)

    report = buffer.set_transforms("world", "turtle1", *line(50), "me")

    assert report.reasons["TF_LONG_NAME"].tolist() == list(range(50))
    assert len(lines) == 1
    assert 'from authority "me"' in lines[0]
    assert buffer.frames() == []


def test_no_samples_change_nothing():
    buffer = Buffer()

    assert buffer.set_transforms("world", "turtle1", [], [], [])
    assert buffer.frames() == []


@pytest.mark.parametrize(
    ("change", "kind", "told"),
    [
        ({"stamps": [0.5, 1.5]}, TypeError, r"np.rint\(stamps \* 1e9\)"),
        ({"stamps": [[1, 2]]}, ValueError, r"stamps must have the shape \(n,\), not \(1, 2\)"),
        (
            {"translations": np.zeros((3, 3))},
            ValueError,
            r"translations for 2 stamps must have the shape \(2, 3\), not \(3, 3\)",
        ),
        (
            {"rotations": np.zeros((2, 3))},
            ValueError,
            r"rotations for 2 stamps must have the shape \(2, 4\), not \(2, 3\)",
        ),
        (
            {"translations": np.full((2, 3), "1")},
            TypeError,
            "translations must be an array of real numbers",
        ),
    ],
)
def test_columns_of_a_wrong_shape_or_type_are_refused_by_name(change, kind, told):
    stamps, translations, rotations = line(2)
    given = {"stamps": stamps, "translations": translations, "rotations": rotations} | change

    with pytest.raises(kind, match=told):
        Buffer().set_transforms("world", "turtle1", **given)


def test_strided_and_read_only_arrays_are_taken():
    stamps, translations, rotations = (part[::2] for part in line(6))
    for part in (stamps, translations, rotations):
        part.flags.writeable = False
    buffer = Buffer()

    assert buffer.set_transforms("world", "turtle1", stamps, translations, rotations)
    assert buffer.snapshot(0).frame("turtle1").samples == 3


def records_of(rows):
    records = np.empty((len(rows), 8), dtype=np.int64)
    numbers = records.view(np.float64)
    for record, number, (stamp, pose) in zip(records, numbers, rows, strict=True):
        record[0] = stamp
        number[1:] = (*pose.translation, *pose.rotation)
    return records


@given(groups)
def test_records_leave_what_columns_leave(drawn):
    columns, borrowed = (
        Buffer(seconds(1000), log=lambda level, text: None, max_frames=100) for _ in range(2)
    )
    newest = 0
    for number, (parent, rows, how) in enumerate(drawn):
        rows = arranged(rows, how, newest)
        newest = max([newest, *(stamp for stamp, _ in rows)])
        child = f"child{number % 2}"
        report = together(columns, parent, child, rows)
        same = borrowed.set_records(parent, child, records_of(rows), "me")
        assert report if same is None else report.accepted.tolist() == same.accepted.tolist()
        assert remembered(borrowed, child) == remembered(columns, child)
    assert sorted(borrowed.frames()) == sorted(columns.frames())


def test_a_recorded_half_turn_is_given_its_sign_though_w_is_zero():
    pose = Transform((0.0, 0.0, 0.0), (0.0, 0.0, -1.0, 0.0))
    buffer = Buffer()

    buffer.set_records("world", "turtle1", records_of([(1, pose)]), "me")

    assert buffer.lookup_transform("world", "turtle1").transform.rotation == (0, 0, 1, 0)
    assert buffer.samples("turtle1").rotations.tolist() == [[0, 0, 1, 0]]


@pytest.mark.parametrize("place", [0, 1, 8191, 8192, 8193, 9999])
@pytest.mark.parametrize(
    ("column", "number"),
    [(1, np.nan), (2, -np.inf), (4, 1e-3), (6, np.nan), (7, -1.0), (7, 1.0 + 5e-16)],
)
def test_one_row_among_many_is_judged_as_by_columns(place, column, number):
    rows = records_of([(stamp, Transform((1.0, 2.0, 3.0))) for stamp in range(1, 10_001)])
    rows.view(np.float64)[place, column] = number
    columns, borrowed = (Buffer(seconds(1), log=lambda level, text: None) for _ in range(2))
    numbers = rows.view(np.float64)

    borrowed.set_records("world", "turtle1", rows, "me")
    columns.set_transforms("world", "turtle1", rows[:, 0], numbers[:, 1:4], numbers[:, 4:], "me")

    assert remembered(borrowed, "turtle1") == remembered(columns, "turtle1")


@pytest.mark.parametrize("place", [1, 8191, 8192, 9999])
def test_rows_are_adopted_together_or_not_at_all(place):
    rows = records_of([(stamp, Transform((1.0, 2.0, 3.0))) for stamp in range(1, 10_001)])
    sound = rows.copy()
    rows[place, 0] = rows[place - 1, 0]
    buffer = Buffer()

    assert not adopt_records(buffer, "world", "turtle1", rows)
    assert buffer.frames() == []
    assert adopt_records(buffer, "world", "turtle1", sound)
    assert len(buffer.samples("turtle1")) == 10_000


def test_records_that_span_more_than_is_kept_are_pruned_as_columns_are():
    rows = [(seconds(stamp), Transform((1.0, 2.0, 3.0))) for stamp in range(1, 101)]
    columns, borrowed = Buffer(seconds(10)), Buffer(seconds(10))

    together(columns, "world", "a", rows)
    borrowed.set_records("world", "a", records_of(rows), "me")

    assert borrowed.samples("a").stamps.tolist() == columns.samples("a").stamps.tolist()
    assert not borrowed.can_transform("world", "a", seconds(5))


@pytest.mark.parametrize("rows", [np.ones((4, 8)), np.ones((4, 7), np.int64), np.ones(8, np.int64)])
def test_records_of_another_shape_or_kind_are_refused(rows):
    buffer = Buffer()

    with pytest.raises(TypeError, match=r"records must be an int64 array of shape \(n, 8\)"):
        buffer.set_records("world", "a", rows)
    assert buffer.frames() == []


def test_many_samples_of_one_stamp_are_compared_with_the_last_of_them_either_way():
    numbers = [*range(40), 39, 20, 0, 1, 0, *range(40)]
    rows = [(5, Transform((float(x), 0.0, 0.0))) for x in numbers]
    one_by_one, at_once = Buffer(seconds(10)), Buffer(seconds(10))
    for stamp, pose in rows:
        one_by_one.set_transform(TransformStamped(stamp, "world", "a", pose), "me")
    together(at_once, "world", "a", rows)

    assert len(one_by_one.samples("a")) > 40
    assert (at_once.samples("a").poses == one_by_one.samples("a").poses).all()
