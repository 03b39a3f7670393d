"""Tests of `tftool diff`, from arguments to output lines."""

import json

import pytest

import tftool as library
from tests.frames.test_compare import START, frames
from tftool import Transform, TransformStamped
from tftool.geometry.conversions import quaternion_from_rpy


@pytest.fixture
def runs(tmp_path):
    """Write two recordings; in the second one the laser is moved by 12.5 mm."""
    library.export(frames(), path=tmp_path / "a.mcap")
    moved = Transform((0.1, 0.2, 0.3125), quaternion_from_rpy(0.1, 0.2, 0.3))
    library.export(frames(laser=moved), path=tmp_path / "b.mcap")
    return tmp_path / "a.mcap", tmp_path / "b.mcap"


def test_the_same_recording_differs_in_nothing(tftool, runs):
    result = tftool("diff", runs[0], runs[0])

    assert result.status == 0
    assert result.out.splitlines()[-1] == "2 links, the same within 1 mm and 0.1°."


def test_a_calibration_is_one_line_a_link(tftool, runs):
    result = tftool("diff", *runs)

    told = [line for line in result.out.splitlines() if "laser" in line]
    assert result.status == 1
    assert len(told) == 1
    wanted = "laser in base moved 12.5 0 x 0 y 0 z +12.5 mm, roll 0 pitch 0 yaw 0°"
    assert " ".join(told[0].split()) == wanted
    assert "1 of 2 links differs by more than 1 mm or 0.1°" in result.out


def test_each_measure_alone_makes_a_difference(tftool, runs):
    told = tftool("diff", *runs, "--rate-percent", "5").out

    assert "by more than 1 mm or 0.1° or 5 % of the rate" in told


def test_the_tolerance_decides_the_status(tftool, runs):
    assert tftool("diff", *runs, "--mm", "13").status == 0
    assert tftool("diff", *runs, "--mm", "12").status == 1
    assert "laser in base" in tftool("diff", *runs, "--mm", "13", "--all").out


def test_json_holds_every_link(tftool, runs):
    found = json.loads(tftool("diff", *runs, "--json").out)

    assert found["differs"] is True
    links = {one["child"]: one for one in found["links"]}
    assert links["laser"]["changes"] == ["pose"]
    assert links["laser"]["apart"]["mm"] == pytest.approx(12.5)
    assert links["base"]["a"] == {
        "parent": "map",
        "kind": "moving",
        "samples": 100,
        "rate_hz": pytest.approx(10.0),
    }


def test_markdown_is_a_table_in_which_no_name_acts(tftool, tmp_path):
    buffer = frames()
    evil = TransformStamped(0, "base", "<img src=x>|`\x1b[31m", Transform())
    buffer.set_transform_static(evil)
    library.export(buffer, path=tmp_path / "a.mcap")
    library.export(frames(), path=tmp_path / "b.mcap")

    out = tftool("diff", tmp_path / "a.mcap", tmp_path / "b.mcap", "--markdown").out

    row = next(line for line in out.splitlines() if "img" in line)
    assert row.startswith("| `<img src=x>¦ˋ␛[31m in base` | `gone` |")
    assert "\x1b" not in out


def test_the_worst_difference_of_a_moving_frame_has_its_time_since_the_start(tftool, tmp_path):
    library.export(frames(), path=tmp_path / "a.mcap")
    library.export(frames(off=0.02), path=tmp_path / "b.mcap")

    out = tftool("diff", tmp_path / "a.mcap", tmp_path / "b.mcap").out

    assert "RMS of 100; worst 20 mm, 0° at 5.000 s" in out


def test_scenarios_are_played_and_compared(tftool, simulated):
    same = tftool("diff", "turtles", "turtles", "--for", "3")
    other = tftool("diff", "turtles", "carrot", "--for", "3")

    assert same.status == 0
    assert other.status == 1
    assert "carrot1 in turtle1" in other.out


def test_spans_apart_are_said(tftool, tmp_path):
    library.export(frames(), path=tmp_path / "a.mcap")
    library.export(frames(start=START + 10**13), path=tmp_path / "b.mcap")
    words = ("diff", tmp_path / "a.mcap", tmp_path / "b.mcap")

    result = tftool(*words)
    assert result.status == 1
    assert "--align start" in result.err
    assert "base in map not compared - - no time in common" in " ".join(result.out.split())
    assert result.out.endswith("1 of 2 links compared, the same within 1 mm and 0.1°.\n")
    assert json.loads(tftool(*words, "--json").out)["differs"] is True
    assert "`not compared`" in tftool(*words, "--markdown").out
    assert tftool(*words, "--align", "start").err == ""


def test_joints_are_compared_between_descriptions_but_not_with_a_recording(tftool, tmp_path):
    text = (
        '<robot name="r"><link name="map"/><link name="base"/>'
        '<joint name="drive" type="continuous"><parent link="map"/><child link="base"/>'
        '<origin xyz="0 0 0.5"/><axis xyz="0 1 0"/></joint></robot>'
    )
    (tmp_path / "a.urdf").write_text(text)
    (tmp_path / "b.urdf").write_text(text.replace("0 0 0.5", "0 0 0.7"))
    (tmp_path / "c.urdf").write_text(text.replace("0 1 0", "1 0 0"))
    library.export(frames(), path=tmp_path / "run.mcap")
    first, second, third, run = (
        tmp_path / name for name in ("a.urdf", "b.urdf", "c.urdf", "run.mcap")
    )

    moved = tftool("diff", first, second, "--joint", "drive=0")
    turned = tftool("diff", first, third)
    recorded = tftool("diff", run, second)

    row = "base in map moved 200 0 x 0 y 0 z +200 mm, roll 0 pitch 0 yaw 0°"
    assert (moved.status, row in " ".join(moved.out.split())) == (1, True)
    row = "base in map other joint 0 0 the axis is turned by 90°"
    assert (turned.status, row in " ".join(turned.out.split())) == (1, True)
    assert recorded.out.endswith(
        "1 of 2 links differs by more than 1 mm or 0.1°, 1 not measured.\n"
    )


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["A"], 2, "Missing argument"),
        (["A", "nope.mcap"], 3, "nope.mcap"),
        (["A", "session"], 3, "No session is running"),
        (["session", "session"], 2, "both the running session"),
        (["A", "A", "--json", "--markdown"], 2, "leave one out"),
        (["A", "A", "--mm", "-1"], 2, "give zero or more"),
        (["A", "A", "--mm", "nan"], 2, "give zero or more"),
        (["A", "A", "--align", "end"], 2, "end"),
    ],
)
def test_diff_refuses_invalid_arguments_with_a_reason(tftool, simulated, runs, words, status, told):
    result = tftool("diff", *[runs[0] if word == "A" else word for word in words])

    assert (result.status, told in result.err) == (status, True), result.err
