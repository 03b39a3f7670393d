import json
import math

import pytest

from tftool.base.errors import LookupException
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.drawing import echo_view as echo
from tftool.geometry.rigid import Transform

UPSIDE_DOWN = TransformStamped(
    0, "A", "B", Transform((0, 0, 3), (0.9999996829318346, 0, 0, 0.0007963267107332633))
)


def test_the_static_example_prints_as_tf2_echo_prints_it():
    assert echo.block(UPSIDE_DOWN).split("\n") == [
        "At time 0.0",
        "- Translation: [0.000, 0.000, 3.000]",
        "- Rotation: in Quaternion [1.000, 0.000, 0.000, 0.001]",
        "- Rotation: in RPY (radian) [3.140, -0.000, 0.000]",
        "- Rotation: in RPY (degree) [179.909, -0.000, 0.000]",
        "- Matrix:",
        "  1.000  0.000  0.000  0.000",
        "  0.000 -1.000 -0.002  0.000",
        "  0.000  0.002 -1.000  3.000",
        "  0.000  0.000  0.000  1.000",
        "",
    ]


def test_nanoseconds_are_not_padded_and_programs_get_them_exactly():
    found = TransformStamped(5_000_000_012, "a", "b", Transform())

    assert echo.block(found).startswith("At time 5.12\n")
    assert echo.as_object(found)["stamp_ns"] == 5_000_000_012


def test_precision_reaches_every_number_and_wide_ones_push_out():
    found = TransformStamped(seconds(2), "a", "b", Transform((1, -1000, 0)))

    lines = echo.block(found, precision=6, quaternion_tag=" (xyzw)").split("\n")

    assert lines[1] == "- Translation: [1.000000, -1000.000000, 0.000000]"
    assert lines[2].startswith("- Rotation: in Quaternion (xyzw) [0.000000,")
    assert lines[7] == " 0.000000 1.000000 0.000000 -1000.000000"
    assert "- Translation: [1, -1000, 0]" in echo.block(found, precision=0)


def test_distance_is_one_more_line():
    found = TransformStamped(0, "a", "b", Transform((3, 4, 0)))

    assert echo.block(found, with_distance=True).split("\n")[-2] == "- Distance: 5.000"
    assert echo.as_object(found, with_distance=True)["distance"] == 5.0


def test_a_failure_reads_like_tf2_echos():
    refusal = LookupException(
        '"x\x1b" passed to lookupTransform argument target_frame does not exist. '
    )

    assert echo.failure(seconds(12.3456), refusal, "Frame a exists with parent b.\n") == (
        "Failure at 12.346\n"
        'Exception thrown:"x␛" passed to lookupTransform argument target_frame does not exist. \n'
        "The current list of frames is:\n"
        "Frame a exists with parent b.\n"
        "\n"
    )
    assert echo.failure_as_object(7, refusal) == {
        "failed_at_ns": 7,
        "error": "LookupException",
        "message": str(refusal),
    }


def test_programs_get_full_precision_and_null_for_what_is_no_number():
    found = TransformStamped(1, "A", "[b]", Transform((math.inf, 0.1, 0), (0, 0, 0, 1)))

    data = echo.as_object(found)

    assert json.loads(json.dumps(data, allow_nan=False)) == data
    assert data["target"] == "A"
    assert data["source"] == "[b]"
    assert data["translation"] == {"x": None, "y": 0.1, "z": 0.0}
    assert data["rotation"]["w"] == 1.0
    assert data["rpy"]["yaw"] == 0.0


def test_a_lookup_is_said_in_words():
    assert echo.in_words("turtle2", "turtle1") == "turtle1 in turtle2"
    assert echo.in_words("a\n", "\x1b[31m") == "␛[31m in a␊"


@pytest.mark.parametrize(("age", "style"), [(2, "dim"), (6, "yellow"), (16, "red")])
def test_the_age_of_an_answer_is_amber_then_red(age, style):
    heading = echo.live_heading("map", "laser", seconds(age))

    assert heading.plain == f"laser in map  {age}.0 s ago\n"
    assert heading.spans[-1].style == style
    assert echo.live_heading("map", "laser", None).plain == "laser in map  static\n"
