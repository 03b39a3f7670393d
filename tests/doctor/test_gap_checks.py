"""Tests of checks for transforms that stop, pause, come once or are damaged."""

import math
from dataclasses import replace

import pytest

from tests.doctor.judged import found, ids, turned
from tests.doctor.robots import NO_TURN, START, Robot, drives, robot
from tftool.base.stamps import seconds
from tftool.doctor.findings import Severity
from tftool.doctor.judge import judge
from tftool.recordings.contract import RecordedTopic


def test_an_edge_that_stops_explains_why_scans_cannot_be_placed():
    made = robot(odometry=False)
    made.moving("odom", "base_link", end=5.0)
    assert ids(made) == ["edge-stopped"]
    outran = found(made, "sensor-outruns-tf")
    assert outran.because_of == "edge-stopped"


@pytest.mark.parametrize(("goes_on", "told"), [(5.02, []), (5.5, []), (7.5, ["edge-stopped"])])
def test_links_that_stop_together_before_the_end_are_no_fault_of_the_first_of_them(goes_on, told):
    """Check edges that stop together, as in a session whose host has left."""
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", end=5.0)
    made.moving("base_link", "arm", end=goes_on)
    evidence = replace(made.evidence(), end=seconds(START) + seconds(9))
    assert [finding.id for finding in judge(evidence).findings] == told


def test_a_hole_is_told_with_its_ends():
    made = robot(odometry=False)
    made.moving("odom", "base_link", without=(3.0, 4.0))
    finding = found(made, "gap")
    assert finding.facts["begin"] == seconds(START) + seconds(2.98)
    assert finding.facts["end"] == seconds(START) + seconds(4)
    assert finding.severity is Severity.WARNING
    assert finding.evidence[0].endswith(
        # The robot drives 0.5 m/s.
        "usually every 20 ms); 10 sensor messages in the gap; across the gap: 0° and 0.51 m"
    )


def test_a_hole_that_others_have_too_names_them():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", without=(3.0, 4.0))
    made.moving("base_link", "arm", without=(3.0, 4.0))
    lines = [line for one in made.judged().findings for line in one.evidence]
    assert any("; at the same time: " in line for line in lines)


@pytest.mark.parametrize("held", [True, False])
def test_a_hole_in_a_stall_tells_the_stall(held):
    made = robot(odometry=False)
    made.moving("odom", "base_link", without=(3.0, 4.0))
    if held:
        # The samples from 2.5 s on wait until 4.2 s; the one before arrived at 2.485 s.
        low, high = made.log(2.5), made.log(4.2)
        made.messages = [(high if low < at < high else at, n) for at, n in made.messages]
    (line,) = found(made, "gap").evidence
    told = "no sample arrived for up to 1.72 s, and the next sample was late"
    assert line.endswith(f"; during this gap, {told}") is held


def test_a_hole_of_what_is_published_on_change_is_a_note():
    made = robot()
    at = 0.0
    for burst in range(5):
        for _ in range(4):
            made.sent("base_link", "door", at)
            at += 0.02
        at = 1.5 * (burst + 1)
    assert found(made, "gap").severity is Severity.NOTE


def test_samples_of_nan_are_told_and_explain_the_hole():
    made = robot()
    for tick in range(160):
        bad = 40 <= tick < 60
        pose = (math.nan, 0.0, 0.0, *NO_TURN) if bad else drives(tick * 0.05)
        made.sent("base_link", "arm", tick * 0.05, pose)
    finding = found(made, "nan-transform")
    assert (finding.count, finding.facts["fate"]) == (20, "tf2 drops them")
    assert found(made, "gap").because_of == "nan-transform"


def test_nothing_at_all_is_an_error():
    made = Robot()
    made.hears("/scan", "laser")
    assert ids(made) == ["no-transforms"]


def test_two_samples_at_once_have_not_stopped():
    made = robot()
    for at in (2.0, 2.02):
        made.sent("base_link", "arm", at)
    assert "edge-stopped" not in ids(made)


def test_damage_is_told():
    made = robot()
    made.damage = ("the last chunk is torn",)
    assert found(made, "truncated-recording").evidence == ("the last chunk is torn",)
    made.damage = ("It was not closed.", "It breaks off.")
    assert found(made, "truncated-recording").evidence == ("It was not closed. It breaks off.",)


def test_a_tag_that_is_seen_no_more_has_not_stopped_and_a_mount_has():
    made = robot()
    made.moving("laser", "tag_7", hz=10, end=3.0)
    assert ids(made, notes=True) == []

    irregular = robot()
    for at in (0.1, 0.2, 0.3, 0.4, 2.4, 2.5, 2.6, 4.0):
        irregular.sent("laser", "thing", at)
    assert "edge-stopped" not in ids(irregular)

    # A part without messages is used only for drawing.
    made.moving("base_link", "arm", hz=10, end=3.0)
    assert found(made, "edge-stopped").severity is Severity.NOTE
    made.hears("/range", "arm", kind="sensor_msgs/Range")
    assert found(made, "edge-stopped").severity is Severity.ERROR


def test_a_gap_explains_waits_only_where_all_that_is_late_falls_into_it():
    def gapped(latency: float) -> Robot:
        made = robot(odometry=False)
        made.moving("odom", "base_link", 50.0, without=(3.0, 4.0), latency=latency)
        return made

    assert found(gapped(0.005), "sensor-outruns-tf").because_of == "gap"
    # Each transform is 200 ms late, also without the gap.
    assert found(gapped(0.2), "sensor-outruns-tf").because_of is None


@pytest.mark.parametrize(("end", "severity"), [(3.7, Severity.NOTE), (4.2, Severity.WARNING)])
def test_a_gap_names_the_topics_that_were_silent_with_it(end, severity):
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", without=(3.0, end))
    made.hears("/wheels", "odom", 50.0, "nav_msgs/Odometry", end=3.0)
    made.hears("/wheels", "odom", 50.0, "nav_msgs/Odometry", begin=end)
    made.hears("/scan", "base_link", 50.0)
    gap = found(made, "gap")
    assert gap.severity is severity
    assert gap.evidence[0].endswith("at the same time: /wheels")
    # Without sensor data, the robot's own pose is still missing in the gap.
    made.heard.pop("/scan")
    assert found(made, "gap").severity is severity


def test_odometry_that_misses_a_turn_between_two_samples_is_a_note():
    for hz, told in ((3.0, True), (8.0, False)):
        made = robot(odometry=False)
        made.moving("odom", "base_link", hz, lambda t: (0.0, 0.0, 0.0, *turned(2.0 * t)))
        assert ("coarse-odometry" in ids(made, notes=True)) is told
    made = robot(odometry=False)
    made.moving("odom", "base_link", 3.0, lambda t: (0.0, 0.0, 0.0, *turned(2.0 * t)))
    finding = found(made, "coarse-odometry")
    assert finding.severity is Severity.NOTE
    assert finding.facts["turn"] == pytest.approx(2.0 / 3.0)


def test_the_only_transform_of_a_recording_is_a_note():
    made = Robot()
    made.sent("kinect", "camera", 1.0)
    assert found(made, "single-sample").severity is Severity.NOTE
    made.hears("/image", "camera", kind="sensor_msgs/Image")
    assert found(made, "single-sample").severity is Severity.WARNING


@pytest.mark.parametrize(("encoding", "told"), [("protobuf", True), ("cdr", False)])
def test_transforms_in_an_unknown_encoding_are_named(encoding, told):
    made = Robot()
    made.hears("/scan", "laser")
    tf = RecordedTopic("/tf", "tf2_msgs/TFMessage", encoding, count=4, transforms=not told)
    evidence = made.evidence()
    (finding,) = [
        one
        for one in judge(replace(evidence, topics=(*evidence.topics, tf))).findings
        if one.id == "no-transforms"
    ]
    assert ("4 messages on /tf in the encoding protobuf" in finding.message) is told
    (fix,) = finding.fixes
    assert ("check whether the robot sends" in fix.text) is not told


def faces(lasting: float) -> Robot:
    """Return a robot whose detector sends faces, each with a gaze below, for a time in turn."""
    made = robot()
    for number, name in enumerate(("kwxyz", "abcde", "qprst", "lmnop")):
        begin = 0.2 + (1.5 * number if lasting < 4.0 else 0.0)
        for parent, child in (("laser", f"face_{name}"), (f"face_{name}", f"gaze_{name}")):
            made.moving(parent, child, 20.0, begin=begin, end=begin + lasting, node="/detector")
    return made


def test_faces_that_come_and_go_have_not_stopped():
    made = faces(1.4)
    for at, name in ((2.0, "uvwxy"), (3.0, "zabcd")):
        made.sent("laser", f"face_{name}", at, node="/detector")
    assert ids(made) == []
    assert ids(made, notes=True) == ["single-sample"]
    assert "false detection" in found(made, "single-sample").fixes[0].text
    assert ids(faces(5.0), notes=True) == ["edge-stopped"]


def test_noise_of_a_face_that_comes_and_goes_is_a_note():
    for lasting, severity in ((1.4, Severity.NOTE), (7.0, Severity.WARNING)):
        made = faces(lasting)
        made.moving(
            "laser",
            "face_noisy",
            20.0,
            lambda t, half=0.7 * lasting: (
                0.5 * (round(20 * t) % 2) * (t < 1.0 + half),
                0.0,
                1.0,
                *NO_TURN,
            ),
            begin=1.0,
            end=1.0 + lasting,
            node="/detector",
        )
        finding = found(made, "publisher-conflict")
        assert finding.severity is severity
        rates = finding.facts["rates"]
        assert isinstance(rates, list)
        assert sum(rates) == pytest.approx(20.0, rel=0.1)
