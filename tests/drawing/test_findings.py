"""Tests of a diagnosis as text, for programs, for an issue, and for a build server."""

import io
import json
import re
from dataclasses import replace
from xml.etree import ElementTree

import pytest
from rich.console import Console

from tests.doctor.robots import NO_TURN, START, Robot, robot
from tftool.doctor import wording
from tftool.doctor.findings import Severity
from tftool.doctor.judge import CHECKS
from tftool.drawing import finding_view as findings


def jumping() -> Robot:
    made = robot(odometry=False)
    made.moving(
        "odom", "base_link", pose=lambda t: (0.5 * t + (2.5 if t > 5 else 0.0), 0, 0, *NO_TURN)
    )
    made.static("camera_link", "camera_optical", (0.0, 0.0, 0.0, -0.5, 0.5, -0.5, 0.5))
    made.hears("/points", "camera_optical", kind="sensor_msgs/PointCloud2")
    return made


def shown(what) -> str:
    console = Console(file=io.StringIO(), width=300, color_system=None)
    console.print(what)
    return "\n".join(line.rstrip() for line in console.file.getvalue().split("\n"))


def test_a_report_says_what_was_read_what_is_wrong_what_is_fine_and_how_much():
    # 400 transforms of odometry and two static ones; base_link, laser, odom and the camera's two
    # frames.
    assert shown(findings.render(jumping().judged())).splitlines() == [
        "made up: columns, 8.0 s, 4 topics, 5 frames, 2 trees, 402 transforms",
        "",
        "error  split-tree: camera_link is not joined to the tree of odom",
        "       tree 2: camera_link, camera_optical; used by /points (80 messages)",
        "       so:  lookups between these frames and odom fail",
        "       fix: nothing in the data says where to join camera_link; if it is mounted on the "
        "robot, measure where, and publish it:",
        "            ros2 run tf2_ros static_transform_publisher --x X --y Y --z Z --yaw A "
        "--frame-id base_link --child-frame-id camera_link",
        "",
        "warning  teleport: base_link in odom jumps 2.51 m within 20 ms",
        "       base_link in odom: 2.51 m and 0° at 1750000005.020, once; usual 0.5 m/s",
        "       so:  data placed before and after the jump does not fit together; REP-105 "
        "wants this transform "
        "continuous",
        "       fix: compare the jump with the sensors; before it:",
        "            tftool echo odom base_link RECORDING --at 1750000005",
        "            after it:",
        "            tftool echo odom base_link RECORDING --at 1750000005.02",
        "",
        "publishers fine · names fine · clocks fine (latency: tf 5 ms, /scan 15 ms, /points 15 ms)"
        " · coverage fine · robot description: skipped, no URDF given",
        "1 error, 1 warning. `tftool doctor --explain split-tree` tells more; "
        "`--markdown` prints this for an issue.",
    ]


def test_a_clean_report_counts_the_checks():
    diagnosis = robot().judged()
    last = shown(findings.render(diagnosis)).splitlines()[-1]
    assert last == f"nothing found; {diagnosis.ran} checks ran, 9 skipped (--verbose says why)"
    assert "skipped: static-not-latched: what publishers offer" in shown(
        findings.render(diagnosis, verbose=True)
    )


def test_stamps_that_are_days_old_are_not_called_fine():
    made = Robot(log_from=START + 24 * 86_400)
    made.moving("odom", "base_link", end=0.02)
    rows = shown(findings.render(made.judged())).splitlines()
    (clocks,) = [row for row in rows if "clocks" in row]
    assert "✓" not in clocks
    assert clocks.endswith("stamps of tf are 24 days before their arrival")


@pytest.mark.parametrize(("start", "told"), [(946_686_201.0, True), (1_400_000_000.0, False)])
def test_a_recorder_in_the_year_2000_has_no_clock_that_was_set(start, told):
    for made in (robot(start=start), robot(start=start, laser=False)):
        text = shown(findings.render(made.judged()))
        clock = "recorded at 946686201.005 (1 January 2000), before ROS existed"
        assert (clock in text) is told


def test_transforms_dated_ahead_have_no_tick_if_there_is_a_note_about_them():
    for latency, ticks in ((-0.205, 0), (0.005, 1)):
        made = robot(odometry=False, scans=False)
        made.moving("odom", "base_link", latency=latency)
        rows = shown(findings.render(made.judged())).splitlines()
        (clocks,) = [row for row in rows if "clocks" in row]
        assert clocks.count("✓") == ticks
        assert ("tf dated 205 ms ahead" in clocks) is not bool(ticks)


def test_a_late_transform_does_not_hide_that_all_stamps_are_shifted():
    made = robot(odometry=False, scans=False, log_from=START + 24 * 86_400)
    made.moving("odom", "base_link", latency=1.5, node="/base")
    made.moving("base_link", "wheel", node="/base")
    made.hears("/odom", "odom", 50.0, "nav_msgs/Odometry")
    made.hears("/scan", "laser", 10.0)
    told = shown(findings.render(made.judged()))
    assert "warning  stale-stamp" in told
    assert "s late (median, without the 24 days by which the clock is off)" in told
    assert "no clock is wrong" not in told
    assert "clocks: most stamps are 24 days before their arrival" in told


def test_notes_are_counted_and_shown_on_request():
    made = robot()
    made.hears("/image", "laser", kind="sensor_msgs/Image")
    brief, whole = (shown(findings.render(made.judged(), verbose=v)) for v in (False, True))
    assert brief.splitlines()[-1].endswith("; 1 note: --verbose")
    assert "image-not-optical" not in brief
    assert "note  image-not-optical" in whole
    made.moving("odom", "base_link", end=5.0, pose=lambda _: (9.0, 0.0, 0.0, *NO_TURN))
    assert "warning (1 more note: --verbose). " in shown(findings.render(made.judged()))


def test_an_issue_counts_the_findings_that_it_lists():
    made = robot()
    made.hears("/image", "laser", kind="sensor_msgs/Image")
    made.moving("odom", "base_link", end=5.0, pose=lambda _: (9.0, 0.0, 0.0, *NO_TURN))
    text = findings.as_markdown(made.judged())
    assert "image-not-optical" not in text
    assert text.splitlines()[-1] == f"{text.count('| warning |')} warning."


def test_a_consequence_is_one_line_below_its_cause():
    made = robot(odometry=False)
    made.moving("odom", "base_link", end=5.0)
    brief = shown(findings.render(made.judged()))
    assert "       with it: sensor-outruns-tf\n" in brief
    assert "because of" not in brief
    assert "because of edge-stopped" in shown(findings.render(made.judged(), verbose=True))


def test_programs_get_names_as_they_are_and_whole_nanoseconds():
    made = jumping()
    made.static("base_link", "\x1b[31mred")
    text = json.dumps(findings.as_object(made.judged()), allow_nan=False)
    read = json.loads(text)
    assert read["schema"] == "tftool.doctor/2"
    assert read["read"]["transforms"] == 403
    assert read["summary"]["error"] == 1
    split = next(one for one in read["findings"] if one["id"] == "split-tree")
    assert split["facts"]["join"] is None
    assert split["fixes"][0]["command"].endswith("--child-frame-id camera_link")
    assert (
        "\x1b[31mred"
        in next(one for one in read["findings"] if one["id"] == "awkward-name")["frames"]
    )


@pytest.mark.parametrize("name", ["\x1b[2J", "[red]x[/red]", "a\nb", "‮abc"])
def test_no_name_acts_on_a_terminal(name):
    made = robot(scans=False)
    made.hears("/scan", name)
    text = shown(findings.render(made.judged(), verbose=True))
    assert "\x1b" not in text
    assert "‮" not in text
    assert "a\nb" not in text
    if name.startswith("["):
        assert name in text


def test_no_name_acts_in_an_issue():
    made = robot(scans=False)
    made.hears("/scan", "`|<img src=x>\n```\n# x")
    text = findings.as_markdown(made.judged())
    rows = [line for line in text.splitlines() if line.startswith("| error")]
    assert len(rows) == 1
    # The row has three cells, so it has four unescaped bars.
    assert rows[0].count("|") == 4
    assert "\n# x" not in text
    assert "````text" in text
    assert text.splitlines()[0].startswith("**tftool doctor** `made up: ")


def test_a_build_server_gets_a_failure_for_each_finding_that_counts():
    rows = [("a.mcap", jumping().judged()), ("b.mcap", "'b.mcap' is an empty file.")]
    root = ElementTree.fromstring(findings.as_junit(rows, Severity.WARNING))
    assert root.get("name") == "tftool doctor"
    assert (root.get("tests"), root.get("failures"), root.get("errors")) == ("3", "2", "1")
    lenient = ElementTree.fromstring(findings.as_junit(rows, Severity.ERROR))
    assert lenient.get("failures") == "1"
    assert ElementTree.fromstring(findings.as_junit(rows, None)).get("failures") == "0"


def test_several_sources_are_compared_in_a_table():
    text = shown(
        findings.compared(
            [("a", jumping().judged()), ("b", robot().judged()), ("c", "it is empty")]
        )
    )
    lines = [line.split() for line in text.splitlines()[2:]]
    assert lines[0] == ["a", "1", "1", "split-tree,", "teleport"]
    assert lines[1] == ["b", "fine"]
    assert lines[2] == ["c", "unreadable:", "it", "is", "empty"]


def test_statistics_tell_rates_latencies_and_gaps():
    lines = shown(findings.statistics(robot().judged().model)).splitlines()
    moving, scans = " ".join(lines[2].split()), " ".join(lines[4].split())
    assert moving == "base_link in odom moving 400 50 Hz 5 ms 5 ms 20 ms"
    assert scans == "/scan in laser topic 80 10 Hz 15 ms 15 ms 100 ms"


@pytest.mark.parametrize("check", CHECKS.values(), ids=CHECKS)
def test_each_check_can_be_explained_without_a_finding(check):
    text = findings.explained(check)
    assert text.startswith(f"{check.id}: {check.summary}\n")
    assert "{" not in text.replace("{ignore", "")
    # A headline of placeholders alone would be a word in capitals without a meaning.
    assert not re.search(r"^says +[A-Z_]+$", text, re.MULTILINE)
    for name, value in check.limits.items():
        assert f"{name} = {value:g}" in text
    for link in check.links:
        assert link in text


def test_each_condition_of_a_rule_is_on_a_line_of_its_own():
    check = replace(CHECKS["gap"], rule="above 0.5 s. A note below 1 s. 5 gaps are enough")

    lines = findings.explained(check).splitlines()

    start = lines.index("rule     above 0.5 s.")
    assert lines[start + 1 : start + 3] == [
        9 * " " + "A note below 1 s.",
        9 * " " + "5 gaps are enough.",
    ]


@pytest.mark.parametrize("check", CHECKS.values(), ids=CHECKS)
def test_on_a_terminal_an_explanation_is_broken_between_words(check):
    text = findings.explained(check, 60)

    assert text.split() == findings.explained(check).split()
    for line in text.splitlines():
        # Only a line that consists of an address or a command may be longer.
        assert len(line) <= 60 or len(line.split()) <= 2


def test_all_checks_are_listed():
    text = shown(findings.listing())
    assert [name for name in CHECKS if f"\n{name} " not in text] == []


def test_nothing_is_told_in_units_too_small_to_read():
    assert [wording.span(one) for one in (-128, 999, 42_000, 0)] == [
        "0 ms",
        "1 µs",
        "42 µs",
        "0 ms",
    ]
    assert [wording.metres(one) for one in (5.96e-9, 0.00031)] == ["0 mm", "0.31 mm"]


def test_a_clean_report_counts_nodes_and_does_not_call_a_shifted_clock_fine():
    made = robot(odometry=False, log_from=START + 1_800_000.0)
    made.moving("odom", "base_link", node="/base")
    made.moving("base_link", "wheel", node="/base")
    told = shown(findings.render(made.judged()))
    assert "1 publisher of transforms" in told
    assert "20.8 days before their arrival" in told
    assert "latency" not in told
