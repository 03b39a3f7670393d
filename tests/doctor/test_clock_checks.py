"""Tests of the checks of clocks and stamps, each on a small robot."""

import io
from dataclasses import replace

import pytest
from rich.console import Console

from tests.doctor.judged import found, ids
from tests.doctor.robots import LASTS, START, Robot, drives, robot, stands
from tftool.base.stamps import seconds
from tftool.doctor.explanation import traced
from tftool.doctor.findings import Severity
from tftool.doctor.judge import judge
from tftool.doctor.lookup_reasons import Cause
from tftool.doctor.trace import Question
from tftool.drawing import finding_view
from tftool.recordings.contract import Publisher


def test_two_clocks_name_the_edges_of_the_fewer():
    made = robot(start=136.0, log_from=START)
    made.start = START
    made.moving("base_link", "wheel", hz=30)
    finding = found(made, "clock-mixture")
    assert finding.edges == (("base_link", "wheel"),)
    assert ids(made) == ["clock-mixture"]


@pytest.mark.parametrize(
    ("kind", "frame", "told"),
    [
        ("lane_msgs/VehicleState", "base_link", ["clock-mixture"]),
        ("lane_msgs/VehicleState", "", []),
        ("lane_msgs/DriveCommand", "base_link", []),
    ],
)
def test_messages_of_a_robots_own_type_in_a_frame_of_tf_are_on_its_clock_too(kind, frame, told):
    made = robot(start=136.0, log_from=START)
    made.hears("/ekf", frame, kind=kind)
    _, rows = made.heard["/ekf"]
    rows[:] = [(stamp + seconds(START - 136.0), log, name) for stamp, log, name in rows]
    assert ids(made) == told


def test_a_simulation_with_its_clock_is_healthy():
    made = Robot(start=12.0, log_from=START)
    made.moving("odom", "base_link")
    made.moving("map", "odom", hz=20, pose=stands, offset=1.0)
    made.static("base_link", "laser")
    made.hears("/scan", "laser")
    # The simulator runs at half speed, and /clock shows this.
    assert ids(made) == []
    assert "only differences" in made.judged().model.reference
    made.clock = [(seconds(12.0 + 0.1 * i), seconds(START + 0.1 * i)) for i in range(81)]
    assert ids(made) == []
    assert made.judged().model.reference == ""


@pytest.mark.parametrize("tick", [0, 90, 399])
@pytest.mark.parametrize("years", [2, -2])
def test_a_single_stamp_of_another_year_is_named_and_makes_no_hole(tick, years):
    made = robot(odometry=False)
    made.moving("odom", "base_link")
    stamps = made.records["odom", "base_link", False]
    stamp, *rest = stamps[tick]
    stamps[tick] = (stamp + years * 31_536_000 * 10**9, *rest)

    if tick == 0 and years < 0:
        # Latched messages are old at the start on purpose.
        assert "wild-stamp" not in ids(made, notes=True)
        return
    finding = found(made, "wild-stamp")
    assert finding.edges == (("odom", "base_link"),)
    assert finding.facts["stamp"] == stamps[tick][0]
    assert finding.facts["off"] == pytest.approx(2 * 31_536_000 * 10**9, rel=1e-6)
    assert finding.facts["side"] == ("ahead of" if years > 0 else "behind")
    # The consequences of the wild stamp are not reported in addition.
    assert ids(made) == ["wild-stamp"]
    assert "gap" not in ids(made, notes=True)


def test_two_publishers_of_two_clocks_by_turns_have_no_wild_stamps():
    made = robot(odometry=False)
    made.moving("odom", "base_link", hz=20)
    made.moving("odom", "base_link", hz=10, offset=7200.0)
    assert "wild-stamp" not in ids(made, notes=True)


def test_a_log_line_of_another_time_is_no_wild_stamp():
    made = robot()
    made.hears("/rosout", "", 10.0, "rosgraph_msgs/Log")
    kind, rows = made.heard["/rosout"]
    made.heard["/rosout"] = (kind, [(rows[0][0] - seconds(7200), *rows[0][1:]), *rows[1:]])
    assert ids(made) == []


def test_messages_of_a_sensor_have_wild_stamps_too():
    made = robot()
    made.static("base_link", "laser")
    made.hears("/scan", "laser")
    _, messages = made.heard["/scan"]
    stamp, *rest = messages[30]
    messages[30] = (stamp + seconds(7200), *rest)
    assert found(made, "wild-stamp").topics == ("/scan",)


def test_transforms_from_the_future_and_of_long_ago():
    ahead = robot(odometry=False)
    ahead.moving("odom", "base_link", offset=0.5)
    assert found(ahead, "future-stamp").severity is Severity.NOTE

    localised = robot()
    localised.moving("map", "odom", hz=20, pose=stands, offset=1.0)
    assert "future-stamp" not in ids(localised, notes=True)

    late = robot(odometry=False, scans=False)
    late.moving("odom", "base_link", latency=0.8)
    assert found(late, "stale-stamp").severity is Severity.NOTE
    # Scans of the present time have to wait for such transforms.
    later = robot(odometry=False)
    later.moving("odom", "base_link", latency=1.1, end=LASTS - 1.0)
    assert ids(later) == ["sensor-outruns-tf"]


def test_a_sensor_whose_clock_is_ahead():
    made = robot(scans=False)
    made.hears("/imu", "laser", hz=100, kind="sensor_msgs/Imu", latency=-0.08)
    finding = found(made, "clock-offset")
    assert finding.facts["ahead"] == seconds(0.08)
    assert ids(made) == ["clock-offset"]


def test_stamps_of_zero_and_stamps_that_stand_still():
    zero = robot()
    for tick in range(160):
        zero.sent("base_link", "arm", tick * 0.05, stamp=0)
    assert ids(zero) == ["zero-stamp"]

    frozen = robot()
    for tick in range(160):
        frozen.sent("base_link", "arm", tick * 0.05, stamp=seconds(START + 1.0))
    assert ids(frozen) == ["frozen-stamp"]
    assert found(frozen, "frozen-stamp").count == 160


def test_time_that_goes_back_hides_what_follows_from_it():
    made = robot()
    made.log_from = START + LASTS
    made.moving("odom", "base_link")
    made.hears("/scan", "laser")
    assert ids(made) == ["time-jump-back"]
    assert found(made, "time-jump-back").count == 1


def test_samples_too_old_to_be_kept_and_samples_that_overtake():
    made = robot()
    made.moving("base_link", "arm", hz=10, end=7.0)
    made.sent("base_link", "arm", 7.0, stamp=seconds(START - 20.0))
    assert found(made, "old-data").edges == (("base_link", "arm"),)

    overtaken = robot()
    for tick in range(100):
        late = 0.2 if tick % 5 == 0 else 0.005
        overtaken.sent("base_link", "arm", tick * 0.05, drives(tick * 0.05), latency=late)
    # The log is in the order of arrival: delayed messages follow newer ones.
    assert found(overtaken, "out-of-order").severity is Severity.NOTE


def test_a_headline_speaks_of_one_link_and_of_several_in_their_grammar():
    one = robot(odometry=False)
    one.moving("odom", "base_link", offset=0.5)
    said = found(one, "future-stamp").message
    assert "base_link in odom is dated" in said
    assert said.endswith("ahead of its arrival")

    one.moving("base_link", "arm", offset=0.5)
    said = found(one, "future-stamp").message
    assert "arm in base_link are dated" in said
    assert said.endswith("ahead of their arrival")


def test_diagnostics_have_no_place_and_may_have_another_clock():
    made = robot(start=12.0, log_from=START)
    made.start = START
    made.hears("/diagnostics", "", kind="diagnostic_msgs/DiagnosticArray")
    assert ids(made, notes=True) == []


def shifted(hours: float) -> Robot:
    """Return a robot whose clock differs from the recorder's clock by some hours."""
    made = robot(log_from=START + hours * 3600.0)
    made.hears("/points", "laser", 5.0, "sensor_msgs/PointCloud2")
    return made


@pytest.mark.parametrize("hours", [143.0, -3.0])
def test_a_recording_that_is_shifted_as_a_whole_is_one_finding(hours):
    made = shifted(hours)
    (note,) = made.judged().findings
    # An older recording that is played again is never ahead of the recorder.
    is_ahead = hours < 0
    severity = Severity.WARNING if is_ahead else Severity.NOTE
    assert (note.id, note.severity) == ("shifted-clock", severity)
    side = "after" if is_ahead else "before"
    assert note.message.startswith(f"all stamps are {abs(hours):g} hours {side} their reception")
    # The waits are computed on the shifted clock.
    made.hears("/cloud", "laser", 5.0, "sensor_msgs/PointCloud2", latency=-0.08)
    assert sorted(ids(made)) == ["clock-offset", *["shifted-clock"] * is_ahead]


@pytest.mark.parametrize(
    ("nodes", "ros", "is_shown"),
    [
        (("/driver", "/laser"), "ROS 1 bag", True),
        (("/driver", "/laser"), "rosbag2", False),
        (("/driver", ""), "ROS 1 bag", False),
        (("/driver", "/play_1649593754885150512"), "ROS 1 bag", False),
        (("/driver", "/my_player"), "ROS 1 bag", False),
    ],
)
def test_a_robot_of_ros_1_whose_nodes_are_known_was_not_played_again(nodes, ros, is_shown):
    made = shifted(1.0)
    made.kind = ros
    evidence = made.evidence()
    publishers = tuple(
        Publisher(topic, node) for topic, node in zip(("/tf", "/scan"), nodes, strict=True)
    )
    transforms = replace(evidence.transforms, publishers=(publishers[0],) * 2)
    told = judge(replace(evidence, transforms=transforms, publishers=publishers)).findings
    (shift,) = [one for one in told if one.id == "shifted-clock"]
    assert (shift.severity is Severity.WARNING) is is_shown
    assert shift.evidence[0].endswith("; no publisher has the name of a player") is is_shown
    assert not (is_shown and "played again" in shift.fixes[0].text)


def test_a_stream_that_differs_by_more_than_the_spread_is_named_beside_a_shift():
    made = Robot(log_from=START - 30.0)
    made.moving("odom", "base_link")
    made.hears("/scan", "base_link")
    made.moving("map", "odom", latency=-0.25)
    finding = found(made, "shifted-clock")
    assert finding.message.startswith("most stamps are 30.00 s after their reception")
    assert finding.evidence[0].startswith("2 of 3 streams, and odom in map 255 ms more; ")


@pytest.mark.parametrize(("spread", "told"), [(0.05, "shifted-clock"), (0.3, "stale-stamp")])
def test_all_streams_that_are_late_by_one_constant_show_a_clock(spread, told):
    made = Robot()
    made.static("base_link", "laser")
    made.moving("odom", "base_link", latency=1.39, node="/base")
    made.hears("/scan", "laser", latency=1.39 + spread)
    made.hears("/imu", "laser", 50.0, "sensor_msgs/Imu", latency=1.39)
    late = [one for one in made.judged().findings if one.id in ("shifted-clock", "stale-stamp")]
    assert [(one.id, one.severity) for one in late] == [(told, Severity.NOTE)]
    if told == "shifted-clock":
        assert late[0].message.startswith("most stamps are 1.39 s before their reception")
        # A recording of 8 s that is played again would be late by 8 s or more.
        assert late[0].fixes[0].text.endswith("chronyc tracking`)")


def test_an_imu_on_the_right_clock_is_off_all_others():
    made = shifted(143.0)
    made.hears("/imu", "laser", 50.0, "sensor_msgs/Imu", latency=0.002)
    kind, rows = made.heard["/imu"]
    made.heard["/imu"] = (kind, [(stamp + seconds(143 * 3600), log, f) for stamp, log, f in rows])
    findings = [one for one in made.judged().findings if one.because_of is None]
    assert [one.id for one in findings] == ["clock-offset", "shifted-clock"]
    assert [one.is_shown for one in findings] == [True, False]
    assert findings[0].topics == ("/imu",)
    assert findings[0].message == (
        "base_link in odom, /scan, /points are 143 hours behind the recorder's clock, with which "
        "/imu agrees"
    )


def test_a_gps_that_is_late_is_no_clock_beside_which_an_imu_is_ahead():
    made = Robot(log_from=START - 5.8 * 3600.0)
    made.hears("/imu", "base_link", 100.0, "sensor_msgs/Imu", latency=0.002)
    made.moving("base_link", "imu_link", 100.0, latency=0.002)
    for topic in ("/fix", "/fix_again", "/fix_filtered"):
        made.hears(topic, "base_link", 1.0, "sensor_msgs/NavSatFix", latency=0.11)
    made.hears("/velocity", "base_link", 1.0, "geometry_msgs/TwistStamped", latency=0.11)
    assert ids(made, notes=True) == ["shifted-clock"]


@pytest.mark.parametrize(
    ("hours", "words"), [(5.8, "chronyc tracking`)"), (-5.8, "played again looks the same")]
)
def test_stamps_ahead_of_the_recorder_by_hours_are_another_clock_and_not_played(hours, words):
    made = robot(log_from=START - hours * 3600.0)
    made.hears("/points", "laser", 5.0, "sensor_msgs/PointCloud2")
    made.moving("map", "odom", 10.0, stands, offset=-hours * 3600.0, latency=0.002)
    assert found(made, "clock-offset").fixes[0].text.endswith(words)


def test_without_a_clock_stamps_near_1970_may_be_a_simulation_or_not():
    made = robot()
    made.hears("/imu", "laser", 50.0, "sensor_msgs/Imu")
    kind, rows = made.heard["/imu"]
    made.heard["/imu"] = (kind, [(stamp - seconds(START - 3401.0), *row) for stamp, *row in rows])
    mixture = found(made, "clock-mixture")
    assert "/imu is stamped with a clock that counts from 0 (a simulation" in mixture.message
    assert "no /clock was recorded" in mixture.fixes[0].text
    made.clock = [(seconds(START + 0.1 * i), seconds(START + 0.1 * i)) for i in range(81)]
    assert "use_sim_time: false" in found(made, "clock-mixture").fixes[0].text


def test_objects_below_the_base_on_another_clock_are_no_real_device():
    made = Robot(start=12.0, log_from=START)
    made.moving("odom", "base_footprint")
    for tick in range(100):
        made.sent("base_link", "fruit", 0.08 * tick, stamp=seconds(START + 0.08 * tick))
    (fix,) = found(made, "clock-mixture").fixes
    assert "nothing needs to change" not in fix.text
    assert "use_sim_time" in fix.text


@pytest.mark.parametrize("is_described", [True, False])
def test_wheels_on_another_clock_than_their_simulated_robot_are_no_real_device(is_described):
    made = Robot(start=12.0, log_from=START)
    made.moving("odom", "base_link")
    made.clock = [(seconds(12.0 + 0.1 * i), seconds(START + 0.1 * i)) for i in range(81)]
    for tick in range(100):
        made.sent("cart", "wheel", 0.08 * tick, stamp=seconds(START + 0.08 * tick))
    joint = '<joint name="j" type="continuous"><parent link="cart"/><child link="wheel"/></joint>'
    made.urdf = f'<robot name="r"><link name="cart"/><link name="wheel"/>{joint}</robot>'
    if not is_described:
        made.urdf = ""
    (fix,) = found(made, "clock-mixture").fixes
    assert fix.text.startswith("set use_sim_time: true") is is_described

    # robot_state_publisher copies the stamps of joint states, so their publisher is wrong.
    stamps = [stamp for stamp, *_ in made.records["cart", "wheel", False]]
    rows = [(stamp, made.log(0.08 * tick), "") for tick, stamp in enumerate(stamps)]
    made.heard["/joint_states"] = ("sensor_msgs/JointState", rows)
    (fix,) = found(made, "clock-mixture").fixes
    assert fix.text.endswith("the node that publishes /joint_states") is is_described


def test_dating_ahead_by_a_period_or_of_a_constant_is_by_design():
    made = robot()
    made.moving("map", "odom", 20.0, stands, offset=0.05)
    made.moving("base_link", "arm", 10.0, drives, offset=0.1)
    made.moving("base_link", "mount", 50.0, stands, offset=0.5)
    assert ids(made, notes=True) == []
    made.moving("base_link", "neck", 50.0, drives, offset=0.5)
    assert found(made, "future-stamp").edges == (("base_link", "neck"),)


def test_a_slow_simulation_without_a_clock_is_not_late():
    """Check a simulation that takes three seconds for each simulated second, without `/clock`."""
    made = robot(start=12.0, log_from=START)
    made.messages = [(seconds(START) + 3 * (log - seconds(START)), n) for log, n in made.messages]
    made.heard = {
        topic: (kind, [(s, seconds(START) + 3 * (log - seconds(START)), f) for s, log, f in rows])
        for topic, (kind, rows) in made.heard.items()
    }
    assert ids(made, notes=True) == []


def test_two_sensors_of_one_clock_are_one_finding():
    made = robot()
    for topic in ("/imu", "/magnet"):
        made.hears(topic, "laser", 50.0, "sensor_msgs/Imu", latency=-0.4)
    (finding,) = (one for one in made.judged().findings if one.id == "clock-offset")
    assert finding.topics == ("/imu", "/magnet")
    assert finding.message == "/imu, /magnet are 400 ms ahead of the other clocks"
    # A robot's clock is off by more than a minute. Its streams have different delays, and the
    # network delays the last messages.
    made = Robot(log_from=START)
    made.static("base_link", "laser")
    for begin, end, late in ((0.0, 6.5, 0.0), (6.5, 8.0, 2.0)):
        times = {"begin": begin, "end": end}
        made.moving("odom", "base_link", latency=late - 79.68, **times)
        made.hears("/odom", "odom", 10.0, "nav_msgs/Odometry", latency=late - 79.6, **times)
        made.hears("/scan", "laser", latency=late - 79.83, **times)
    assert "79.83 s after their reception, constant to 0 ms" in found(made, "shifted-clock").message
    made.hears("/map", "odom", 1.0, "nav_msgs/OccupancyGrid")
    (finding,) = (one for one in made.judged().findings if one.id == "clock-offset")
    words = "/odom, /scan, base_link in odom are 79.60 s to 79.83 s ahead of the recorder's clock"
    assert finding.message == words


def test_a_topic_that_two_computers_send_has_no_offset_of_its_own():
    made = robot()
    made.hears("/imu", "laser", 50.0, "sensor_msgs/Imu", latency=-1340.0)
    for late in (-1340.0, 0.0):
        made.hears("/diagnostics", "", 2.0, "diagnostic_msgs/DiagnosticArray", latency=late)
    finding = found(made, "clock-offset")
    (line,) = finding.evidence
    assert "/imu: -22.3 minutes" in line
    assert "/diagnostics" not in line


def test_the_consequence_of_stamps_is_that_of_the_data():
    made = robot()
    made.hears("/imu", "laser", 50.0, "sensor_msgs/Imu", latency=-0.4)
    assert found(made, "clock-offset").consequence.endswith("has to wait 400 ms longer, or fails")
    for end, told in ((LASTS, "do not use these samples"), (0.0, "at any other time fail")):
        made = robot()
        made.moving("base_link", "arm", end=end)
        made.sent("base_link", "arm", 5.0, stamp=0)
        assert f"{told}; " in found(made, "zero-stamp").consequence


def test_a_scan_that_arrives_one_scan_later_is_on_time():
    made = robot(scans=False)
    made.hears("/scan", "laser", 6.5, latency=0.152)
    assert "clock-offset" not in ids(made, notes=True)
    late = robot(scans=False)
    late.hears("/scan", "laser", 20.0, latency=0.252)
    finding = found(late, "clock-offset")
    assert "a delay in its driver, or another clock" in finding.message
    assert not any("synchronise" in fix.text for fix in finding.fixes)
    # A simulation has one clock.
    simulated = robot(start=12.0, scans=False)
    simulated.hears("/scan", "laser", 20.0, latency=0.252)
    assert "clock-offset" not in ids(simulated, notes=True)


def test_many_frames_that_say_the_same_are_one_line_of_evidence():
    made = robot()
    for number in range(12):
        made.moving("base_link", f"link{number}", hz=20, latency=0.0, offset=0.5, node="/rsp")
    made.moving("base_link", "gripper", hz=20, latency=0.0, offset=0.9, node="/rsp")
    made.moving("base_link", "hand", hz=20, latency=0.0, offset=0.9, node="/rsp")
    finding = found(made, "future-stamp")

    assert len(finding.edges) == 14
    assert finding.evidence == (
        "12 frames of /rsp: 500 ms ahead (median)",
        "gripper in base_link, hand in base_link: 900 ms ahead (median)",
    )
    verbose = io.StringIO()
    Console(file=verbose, width=2000).print(finding_view.render(made.judged(), verbose=True))
    assert "link11 in base_link" in verbose.getvalue()


def frozen_marker(frame: str) -> Robot:
    made = robot()
    made.hears("/wall_marker", frame, 10.0, "visualization_msgs/Marker", begin=1.0)
    kind, rows = made.heard["/wall_marker"]
    made.heard["/wall_marker"] = (kind, [(rows[0][0], *row[1:]) for row in rows])
    return made


def test_messages_that_repeat_one_stamp_are_no_matter_of_the_cache_or_the_network():
    assert ids(frozen_marker("base_link"), notes=True) == ["frozen-stamp"]
    finding = found(frozen_marker("base_link"), "frozen-stamp")
    assert (finding.topics, finding.count) == (("/wall_marker",), 70)
    # A marker in odom needs no moving transform.
    assert ids(frozen_marker("odom"), notes=True) == []


def test_frozen_stamps_are_the_only_findings_and_get_no_advice_about_clocks():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", end=30.0)
    for tick in range(60):
        made.sent("base_link", "arm", tick * 0.5, stamp=seconds(START + 1.0))
        made.sent("map", "odom", tick * 0.5, stamp=seconds(START + 1.0))
    marked = frozen_marker("base_link").heard["/wall_marker"]
    made.heard["/wall_marker"] = (marked[0], [(s, t + seconds(12), f) for s, t, f in marked[1]])
    told = [(one.id, one.edges, one.topics) for one in made.judged().findings]
    assert told == [
        ("frozen-stamp", (("base_link", "arm"),), ()),
        ("frozen-stamp", (("map", "odom"),), ()),
        ("frozen-stamp", (), ("/wall_marker",)),
    ]
    assert not any("chrony" in fix.text for one in made.judged().findings for fix in one.fixes)


def test_no_stamp_that_stands_still_is_to_be_stamped_anew():
    made = robot()
    for tick in range(160):
        made.sent("map", "odom", tick * 0.05, stamp=seconds(START + 1.0))
        made.sent("base_link", "arm", tick * 0.05, stamp=seconds(START + 1.0))
    findings = [one for one in made.judged().findings if one.id == "frozen-stamp"]
    assert len(findings) == 2
    assert {one.fixes[0].text for one in findings} == {
        "look at where its publisher takes its stamps from: `ros2 topic info --verbose /tf`"
    }


def test_stamps_that_repeat_while_a_slow_simulation_stands_are_not_frozen():
    """Check a localiser at 50 Hz of real time, with a simulation that steps every two seconds."""
    made = Robot(start=12.0, log_from=START)
    for step in range(10):
        made.sent("odom", "base_link", 2.0 * step, drives(step), stamp=seconds(12.0 + 0.06 * step))
        for tick in range(100):
            at = 2.0 * step + tick / 50
            made.sent("map", "odom", at, stamp=seconds(12.0 + 0.06 * step))
    made.kind = "ROS 1 bag"
    told = ids(made, notes=True)
    assert "frozen-stamp" not in told
    assert "repeated-stamp" in told


def test_seconds_of_a_slow_network_are_no_part_of_a_clock_that_was_never_set():
    made = Robot(log_from=START + 184 * 86_400)
    made.moving("odom", "base_link")
    for child in ("arm", "hand"):
        made.moving("base_link", child, end=LASTS - 2.8, latency=2.8)
    found_shift = found(made, "shifted-clock")
    assert found_shift.message.startswith("all stamps are 184 days before their reception")
    assert "3 of 3 streams" in found_shift.evidence[0]
    # Parts of the same robot have different delays, so the late part is a finding.
    assert ids(made) == ["stale-stamp"]
    late = found(made, "stale-stamp")
    assert {child for _, child in late.edges} == {"arm", "hand"}
    assert late.fixes[0].text.startswith("base_link in odom of the same tree arrived in time")
    # A detector needs time for its results, so its delay is no finding.
    made = Robot(log_from=START + 184 * 86_400)
    made.moving("odom", "base_link")
    made.moving("base_link", "marker_7", end=LASTS - 2.8, latency=2.8)
    assert ids(made) == []


def test_a_map_in_odometry_may_jump_as_odometry_in_a_map():
    made = robot()
    made.moving("odom", "map", 20.0, lambda t: (0.5 * (t > 4), 0.0, 0.0, 0.0, 0.0, 0.0, 1.0))
    assert "teleport" not in ids(made)


def test_samples_sent_again_late_repeat_stamps_and_explain_out_of_order():
    made = robot()
    for tick in range(160):
        made.sent("base_link", "arm", tick * 0.05, drives(tick * 0.05))
        if tick > 2 and tick % 4 == 0:
            made.sent("base_link", "arm", (tick - 2) * 0.05, drives((tick - 2) * 0.05), latency=0.2)
    made.kind = "ROS 1 bag"
    assert ids(made, notes=True) == ["repeated-stamp"]
    assert found(made, "out-of-order").because_of == "repeated-stamp"


def test_a_localiser_of_ros_2_may_repeat_the_pose_of_its_last_scan():
    made = robot()
    for tick in range(100):
        made.sent("map", "odom", tick * 0.05, drives(tick // 5 * 0.25), stamp=made.log(tick // 5))
    assert "repeated-stamp" not in ids(made, notes=True)
    made.kind = "ROS 1 bag"
    assert "repeated-stamp" in ids(made, notes=True)


def test_constants_that_ros_1_dates_ahead_tell_no_clock_of_a_simulation():
    made = Robot(start=3.0, log_from=START)
    made.moving("odom", "base_link", hz=10)
    made.moving("base_link", "wheel", hz=10)
    for plate in ("bottom", "top"):
        made.moving("base_link", plate, hz=5, pose=stands, offset=0.5)
    made.static("base_link", "laser")
    made.hears("/scan", "laser", latency=0.002)
    assert "stale-stamp" not in ids(made, notes=True)


@pytest.mark.parametrize("hours", [15 / 3600, -168.0])
def test_a_localiser_on_the_recorders_clock_is_off_the_others_and_no_more(hours):
    made = shifted(-hours)
    made.kind = "ROS 1 bag"
    made.moving("map", "odom", hz=20, pose=stands, offset=0.05)
    rows = made.records["map", "odom", False]
    made.records["map", "odom", False] = [
        (stamp - seconds(hours * 3600), pose, number) for stamp, pose, number in rows
    ]
    finding = found(made, "clock-offset")
    assert finding.edges == (("map", "odom"),)
    off = "14.98 s ahead of" if hours > 0 else "168 hours behind"
    assert finding.message == (
        f"base_link in odom, /scan, /points are {off} the recorder's clock, with which odom in map "
        "agrees"
    )
    assert ("played again" in finding.fixes[0].text) == (hours < -1)
    # No other data shows the two clocks.
    assert ids(made, notes=True) == ["clock-offset"]
    asked = traced(made.judged().model, Question("map", "laser", seconds(START + 4.0)))
    assert asked.cause is Cause.CLOCK_OFFSET
    assert asked.remedies[0].kind == "clock"


def test_a_localiser_beside_a_recorded_one_is_told_as_two_sources():
    made = shifted(168.0)
    made.moving("map", "odom", hz=20, pose=stands)
    rows = made.records["map", "odom", False]
    live = [(stamp + seconds(168 * 3600), pose, number) for stamp, pose, number in rows]
    made.records["map", "odom", False] = [*live, *rows[::2]]
    finding = found(made, "clock-offset")
    assert finding.evidence[0].startswith(
        "odom in map: 0 ms, base_link in odom, /scan, /points: 168 hours"
    )
    assert "odom in map is on two clocks: 80 of its samples" in finding.evidence[0]
    # A command that drops the transform would remove the samples of both sources.
    assert not any(fix.command for fix in finding.fixes)
    assert finding.severity is Severity.ERROR
    assert ids(made) == ["clock-offset"]


def test_a_delay_that_varies_is_not_a_clock():
    made = robot(odometry=False, scans=False)
    for tick in range(160):
        made.sent("odom", "base_link", tick * 0.05, drives(tick * 0.05), latency=1.0 + tick / 400)
    late = found(made, "stale-stamp")
    assert late.evidence[0].endswith("1.20 s late (median), from 1.04 s to 1.36 s for 80 %")
    assert not late.fixes

    steady = robot(odometry=False, scans=False)
    steady.moving("odom", "base_link", latency=0.8)
    assert "clocks" in found(steady, "stale-stamp").fixes[0].text


def test_stamps_that_come_in_time_on_another_topic_show_that_tf_queues():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", latency=2.0)
    made.hears("/odom", "odom", 50.0, "nav_msgs/Odometry", latency=0.01)
    finding = found(made, "stale-stamp")
    assert finding.severity is Severity.WARNING
    assert finding.fixes[0].text.startswith("/odom has the same stamps, 10 ms late")


def test_a_localiser_out_of_order_hangs_on_the_odometry_that_its_scans_wait_for():
    made = robot(odometry=False)
    made.moving("odom", "base_link", hz=1)
    for tick in range(70):
        # Ten scans are sent at once, the newest first.
        released = tick // 10 + 1.1
        at = tick * 0.1
        made.sent("map", "odom", at, latency=released - at - 0.01 * (tick % 10))
    assert found(made, "out-of-order").because_of == "sensor-outruns-tf"


def test_a_sensor_alone_is_off_the_recorders_clock():
    made = Robot()
    made.hears("/scan", "laser", latency=-1.8)
    assert found(made, "clock-offset").message == "/scan is 1.80 s ahead of the recorder's clock"
    made.hears("/points", "laser", kind="sensor_msgs/PointCloud2")
    assert found(made, "clock-offset").message == "/scan is 1.80 s ahead of the other clocks"
    # Without a transform, the axes of an image are unknown.
    made.hears("/image", "camera", kind="sensor_msgs/Image")
    assert found(made, "image-not-optical").because_of == "no-transforms"


@pytest.mark.parametrize("shift", [0.0, 0.013])
def test_a_recording_that_is_played_in_a_loop_repeats_bit_for_bit(shift):
    made = Robot()
    for lap in range(3):
        for tick in range(200):
            at, pose = tick * 0.04, drives(tick * 0.04 + lap * shift)
            log = made.log(8.0 * lap + at)
            for parent, child in (("odom", "base_link"), ("base_link", "arm")):
                made.sent(parent, child, 8.0 * lap + at, pose, stamp=made.log(at))
                assert made.messages[-1][0] >= log
    back = found(made, "time-jump-back")
    # A simulation that is reset does not repeat the same numbers.
    assert ("played in a loop" in back.message) is (shift == 0.0)
    assert ("without --loop" in back.fixes[0].text) is (shift == 0.0)


@pytest.mark.parametrize(("year", "severity"), [(2014, None), (2022, Severity.NOTE)])
def test_equal_repeats_matter_only_to_a_tf2_that_prints_them(year, severity):
    made = Robot(start=START - (2025 - year) * 31_556_952.0)
    for tick in range(100):
        for _ in range(2 if tick % 6 == 0 else 1):
            made.sent("odom", "base_link", tick * 0.05, drives(tick * 0.05))
    made.kind = "ROS 1 bag"
    repeats = [one for one in made.judged().findings if one.id == "repeated-stamp"]
    assert [one.severity for one in repeats] == ([] if severity is None else [severity])


def test_scans_of_several_copies_of_a_driver_are_counted():
    made = robot(scans=False)
    for _ in range(3):
        made.hears("/scan", "laser")
    finding = found(made, "sent-twice")
    assert finding.evidence == ("/scan: 240 messages have 80 different stamps",)
    assert finding.is_shown
    assert "sent-twice" not in ids(robot(), notes=True)


def test_publishers_on_two_clocks_are_compared_when_their_data_arrives():
    made = robot(odometry=False, laser=False, scans=False)
    made.moving("odom", "base_link", node="/filter")
    made.moving("odom", "base_link", pose=stands, offset=-20_000.0, node="/camera")
    conflict = found(made, "publisher-conflict")
    assert conflict.publishers == ("/filter", "/camera")
    # Two publishers one after the other are no conflict: a node may have been started again.
    after = robot(odometry=False, laser=False, scans=False)
    after.moving("odom", "base_link", node="/filter", end=4.0)
    after.moving("odom", "base_link", pose=stands, begin=4.1, node="/camera")
    assert "publisher-conflict" not in ids(after)


def test_data_of_rosbag_play_beside_live_nodes_is_told_as_such():
    made = shifted(168.0)
    made.moving("map", "odom", hz=20, pose=stands)
    rows = made.records["map", "odom", False]
    live = [(stamp + seconds(168 * 3600), pose, number) for stamp, pose, number in rows]
    made.records["map", "odom", False] = live
    assert "looks the same" in found(made, "clock-offset").fixes[0].text
    made.sent("base_link", "arm", 1.0, node="/play_1649593754885150512")
    assert found(made, "clock-offset").fixes[0].text.startswith("a recording was played")
