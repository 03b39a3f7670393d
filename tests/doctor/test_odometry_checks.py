"""The checks of jumps and of odometry messages, each on a small robot of its own."""

import math
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("rosbags", reason="writes the test files")

from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_typestore

from tests.doctor.judged import found, ids, turned
from tests.doctor.robots import NO_TURN, Robot, drives, robot, stands
from tests.recordings.writers import ROS1
from tftool import open_recording
from tftool.base.stamps import seconds
from tftool.doctor.evidence import evidence_of
from tftool.doctor.findings import Severity
from tftool.doctor.judge import judge

STORE = get_typestore(Stores.ROS1_NOETIC)


def corrected(t: float) -> tuple[float, ...]:
    """A drive along x that steps by two metres 20 ms after each whole second."""
    return (0.5 * t, 2.0 * (int(t - 0.02) % 2), 0.0, *NO_TURN)


def test_jumps_after_each_message_of_a_satellite_receiver_name_its_topic():
    made = robot(odometry=False)
    made.moving("odom", "base_link", hz=100.0, pose=corrected)
    made.hears("/fix", "base_link", 1.0, "sensor_msgs/NavSatFix", latency=0.01)
    jump = found(made, "teleport")
    assert "after a message of /fix" in jump.evidence[0]

    # One jump is no pattern, and messages at 100 Hz come before everything.
    often = robot(odometry=False)
    often.moving("odom", "base_link", hz=100.0, pose=corrected)
    often.hears("/wheels", "odom", 100.0, "nav_msgs/Odometry")
    jump = found(often, "teleport")
    assert jump.fixes[0].command.startswith("tftool echo odom base_link RECORDING --at 17500000")


def test_each_publisher_of_a_frame_is_searched_for_jumps_by_itself():
    made = robot(odometry=False)
    made.moving("odom", "base_link", pose=stands, node="/stray")
    made.moving("odom", "base_link", pose=drives, hz=30.0, node="/wheels")
    made.moving("odom", "base_link", pose=lambda t: (9.0, *drives(t)[1:]), node="/far", end=1.0)
    assert ids(made) == ["publisher-conflict"]
    assert "teleport" not in [one.id for one in made.judged().findings]

    jumps = robot(odometry=False)
    jumps.moving("odom", "base_link", pose=lambda _: (50.0, 0.0, 0.0, *NO_TURN), node="/camera")
    jumps.moving("odom", "base_link", hz=100.0, pose=corrected, node="/filter")
    jumps.hears("/fix", "base_link", 1.0, "sensor_msgs/NavSatFix", latency=0.01)
    assert {*ids(jumps)} == {"publisher-conflict", "teleport"}
    assert "all poses of /camera are equal" in found(jumps, "publisher-conflict").evidence[0]
    assert "usual 0.5 m/s" in found(jumps, "teleport").evidence[0]


def test_a_part_that_is_only_drawn_jumps_as_a_note():
    made = robot()
    made.moving("base_link", "wheel", pose=lambda t: (2.5 if t > 5 else 0.0, t, 0.0, *NO_TURN))
    assert found(made, "teleport").severity is Severity.NOTE


def far_away(height: float) -> Robot:
    made = robot(odometry=False)
    made.moving("odom", "base_link", pose=lambda t: (0.5 * t, 0.0, height, *NO_TURN))
    made.odometry = Robot()
    made.odometry.moving("odom", "", hz=1.0, topic="/odometry/gps", node="/navsat")
    return made


def test_a_filter_far_below_the_positions_that_it_uses():
    finding = found(far_away(-800.0), "odometry-tf-mismatch")
    assert finding.message == "/odometry/gps and tf have positions far apart for base_link in odom"
    assert "z of the first is -800.00 m in tf, 0 mm in the message" in finding.evidence[0]
    # A drift that is shorter than ten metres beyond the way is no fault.
    assert ids(far_away(-8.0)) == []


def test_of_two_publishers_the_one_near_in_time_is_named():
    made = far_away(-800.0)
    made.publishers = [
        replace(one, node="/ekf") if one.topic == "/tf" else one for one in made.publishers
    ]
    made.moving("odom", "base_link", offset=9000.0, node="/camera")
    finding = found(made, "odometry-tf-mismatch")
    assert finding.fixes[0].text == "look at what /ekf, which sends base_link in odom, uses for z"


@pytest.mark.parametrize(
    ("delay", "aside", "told"),
    [
        (0.085, 0.0, "tf is 85 ms later than the odometry: at equal times, the positions are 85"),
        (
            -0.5,
            0.0,
            "tf is 500 ms earlier than the odometry: at equal times, the positions are 0.49 m",
        ),
        (0.0, 0.04, None),
    ],
)
def test_a_constant_delay_between_odometry_and_tf_is_told(delay, aside, told):
    made = robot(odometry=False, scans=False)
    made.moving("odom", "car/base_link", 20.0, lambda t: circle(t - delay, aside))
    made.odometry = Robot()
    made.odometry.moving("odom", "base_link", 50.0, circle, topic="/odom")
    if told is None:
        assert "odometry-tf-mismatch" not in ids(made, notes=True)
        return
    finding = found(made, "odometry-tf-mismatch")
    assert finding.severity is Severity.NOTE
    assert finding.evidence[0].startswith(told)


def test_the_poses_of_two_odometry_topics_show_no_delay():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", 20.0, lambda t: circle(t - 0.1))
    made.odometry = Robot()
    for topic, aside in (("/odom", 0.0), ("/truth", 0.001)):
        made.odometry.moving(
            "odom", "base_link", 50.0, lambda t, aside=aside: circle(t, aside), topic=topic
        )
        told = [one.evidence[0] for one in made.judged().findings if one.facts.get("delay")]
        assert len(told) == (topic == "/odom")


def circle(t: float, aside: float = 0.0) -> tuple[float, ...]:
    """Return the pose of a robot on a circle with a radius of 1 m, at 1 m/s."""
    return (math.sin(t), 1.0 - math.cos(t) + aside, 0.0, *turned(t))


def curve(t: float) -> tuple[float, ...]:
    """Return the pose of a robot that drives a left turn with a radius of 2 m at 0.2 m/s."""
    angle = 0.1 * t
    return (2.0 * math.sin(angle), 2.0 - 2.0 * math.cos(angle), 0.0, *turned(angle))


def mirrored(t: float) -> tuple[float, ...]:
    x, y, *rest = curve(t)
    return (x, -y, *rest)


def sideways(t: float) -> tuple[float, ...]:
    """Return the pose of a robot that moves along its y axis only."""
    return (0.0, 0.2 * t, 0.0, *NO_TURN)


@pytest.mark.parametrize(
    ("in_tf", "in_message", "told"),
    [
        (mirrored, curve, "only in /odom"),
        (curve, mirrored, "only in tf"),
        (sideways, lambda t: (0.0, -0.2 * t, 0.0, *NO_TURN), "in tf"),
        (curve, curve, None),
    ],
)
@pytest.mark.parametrize("shift", [0.0, 0.5])
def test_a_y_of_the_opposite_sign_is_told_and_the_motion_shows_which_is_wrong(
    in_tf, in_message, told, shift
):
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", 10.0, in_tf)
    made.odometry = Robot()
    for tick in range(80):
        at = 0.1 * tick
        stamp = seconds(made.start + at + shift)
        made.odometry.sent("odom", "base_link", at, in_message(at), topic="/odom", stamp=stamp)
    if told is None:
        assert "odometry-tf-mismatch" not in ids(made)
        return
    finding = found(made, "odometry-tf-mismatch")
    assert finding.severity is Severity.WARNING
    assert finding.message == "/odom and tf have y of opposite signs for base_link in odom"
    assert finding.evidence[0].endswith(told)
    assert ("the publisher of" in finding.fixes[0].text) is ("only" in told)


def test_negative_variances_are_read_from_the_messages(tmp_path):
    path = tmp_path / "run.bag"
    kind = "nav_msgs/msg/Odometry"
    made = {name.split("/")[-1]: STORE.types[name] for name in STORE.types}
    zero = made["Vector3"](0.0, 0.0, 0.0)
    pose = made["Pose"](made["Point"](1.0, 2.0, 3.0), made["Quaternion"](0.0, 0.0, 0.0, 1.0))
    with Writer(path) as writer:
        connection = writer.add_connection("/odometry/gps", kind, typestore=STORE)
        for number, variance in enumerate((0.5, -1.0, -1.25, -0.25, 0.0)):
            covariance = np.zeros(36)
            covariance[7] = variance
            time = STORE.types["builtin_interfaces/msg/Time"](100 + number, 0)
            message = STORE.types[kind](
                made["Header"](number, time, "odom"),
                "base_link",
                made["PoseWithCovariance"](pose, covariance),
                made["TwistWithCovariance"](made["Twist"](zero, zero), np.full(36, -5.0)),
            )
            writer.write(connection, (100 + number) * 10**9, STORE.serialize_ros1(message, kind))
    with open_recording(path) as recording:
        evidence = evidence_of(recording)
    # -1 says that a variance is not known.
    assert evidence.negative == {"/odometry/gps": (2, 5, -1.25)}
    transforms = robot().evidence()
    findings = judge(replace(transforms, negative=evidence.negative)).findings
    assert [one.id for one in findings if one.id == "negative-variance"] == []
    odometry = replace(transforms, negative=evidence.negative, odometry=transforms.transforms)
    (wrong,) = [one for one in judge(odometry).findings if one.id == "negative-variance"]
    assert wrong.evidence == ("/odometry/gps: 2 of 5 messages, -1.25 at least",)


@pytest.mark.parametrize(("wrong", "severity"), [(1, Severity.WARNING), (40, Severity.ERROR)])
def test_a_single_number_that_is_none_is_no_error(wrong, severity):
    made = robot()
    rows = made.records["odom", "base_link", False]
    nan = (float("nan"), *rows[0][1][1:])
    rows[100 : 100 + wrong] = [(s, nan, m) for s, _, m in rows[100 : 100 + wrong]]
    assert found(made, "nan-transform").severity is severity


def test_odometry_that_repeats_its_pose_with_new_stamps_moves_in_steps():
    for repeats, speed, severity in (
        (4, 0.5, Severity.WARNING),
        (4, 0.02, Severity.NOTE),
        (2, 0.5, None),
    ):
        made = robot(odometry=False, scans=False)
        made.moving(
            "odom",
            "base_link",
            20.0,
            lambda t, r=repeats, v=speed: (v * (round(20.0 * t) // r) * r / 20.0, 0, 0, *NO_TURN),
        )
        told = [one for one in made.judged().findings if one.id == "repeated-pose"]
        assert [one.severity for one in told] == ([severity] if severity else [])
        if severity is Severity.WARNING:
            assert "75 % of the samples" in told[0].message
            assert "a new pose every 200 ms, 0.10 m" in told[0].evidence[0]


def test_the_time_between_poses_is_that_of_their_stamps_if_two_streams_alternate():
    def pose(t: float) -> tuple[float, ...]:
        return (0.05 * int(10.0 * t + 1e-6), 0.0, 0.0, *NO_TURN)

    made = robot(odometry=False, scans=False)
    for tick in range(800):
        made.sent("odom", "base_link", 0.01 * tick, pose(0.01 * tick))
        if tick % 5 == 0:
            made.sent("odom", "base_link", 0.01 * tick + 1e-4, pose(0.01 * tick))
    finding = found(made, "repeated-pose")
    # Ten samples and two of the second stream have one pose.
    assert "91.7 % of the samples" in finding.message
    assert "a new pose every 100 ms, 50 mm" in finding.evidence[0]


def test_a_localiser_that_takes_back_the_odometry_is_told():
    for share, told in ((1.0, ["odometry-cancelled"]), (0.1, [])):
        made = robot()
        made.moving("map", "odom", 10.0, lambda t, s=share: (-0.5 * s * t, 0.0, 0.0, *NO_TURN))
        assert ids(made) == told
    made = robot()
    made.moving("map", "odom", 10.0, lambda t: (-0.5 * t, 0.0, 0.0, *NO_TURN))
    assert "although it goes 2.00 m in odom" in found(made, "odometry-cancelled").message


@pytest.mark.parametrize(("share", "told"), [(0.5, True), (0.1, False)])
def test_a_localiser_that_turns_odometry_in_one_direction_is_a_note(share, told):
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", 10.0, lambda t: (0.2 * t, 0.0, 0.0, *turned(0.3 * t)))
    # One correction per half second.
    made.moving("map", "odom", 10.0, lambda t: (0, 0, 0, *turned(-share * 0.15 * int(2 * t))))
    notes = [one for one in made.judged().findings if one.id == "odometry-corrected"]
    assert [one.severity for one in notes] == [Severity.NOTE] * told
    if told:
        # From 2 s to 7.9 s: 11 corrections of 4.3°; in 7.9 s the robot turns by 2.37 rad.
        assert "odom in map turns by 47.3° in one direction" in notes[0].message
        assert "turns by 136° in odom" in notes[0].message


@pytest.mark.parametrize(("step", "told"), [(0.375, True), (0.15, False)])
def test_odometry_that_turns_too_far_is_a_warning_from_half_a_turn_on(step, told):
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", 20.0, lambda t: (0.0, 0.0, 0.0, *turned(3.0 * t)))
    made.moving("map", "odom", 10.0, lambda t: (0, 0, 0, *turned(-step * int(2 * t))))
    notes = [one for one in made.judged().findings if one.id == "odometry-corrected"]
    assert [one.severity for one in notes] == [Severity.WARNING] * told
    if told:
        # From 0 s to 7.95 s at 3 rad/s: 23.85 rad, 1,366.5°.
        assert "turns by 1,367° in odom" in notes[0].message


def test_commands_after_the_last_transform_are_read_unless_all_are_zero(tmp_path):
    path = tmp_path / "run.bag"
    twist, tf = "geometry_msgs/msg/Twist", "tf2_msgs/msg/TFMessage"
    made = {name.split("/")[-1]: ROS1.types[name] for name in ROS1.types}
    zero, ahead = made["Vector3"](0.0, 0.0, 0.0), made["Vector3"](0.2, 0.0, 0.0)
    turn = made["Quaternion"](0.0, 0.0, 0.0, 1.0)
    with Writer(path) as writer:
        frames = writer.add_connection("/tf", tf, typestore=ROS1)
        wheels = writer.add_connection("/cmd_vel", twist, typestore=ROS1)
        arm = writer.add_connection("/arm/cmd_vel", twist, typestore=ROS1)
        for number in range(200, 400):
            log = number * 10**8
            if number < 300:
                at = ROS1.types["builtin_interfaces/msg/Time"](*divmod(log, 10**9))
                pose = made["Transform"](made["Vector3"](0.01 * number, 0.0, 0.0), turn)
                header = made["Header"](number, at, "odom")
                message = ROS1.types[tf]([made["TransformStamped"](header, "base_link", pose)])
                writer.write(frames, log, ROS1.serialize_ros1(message, tf))
            for connection, linear in ((wheels, ahead), (arm, zero)):
                command = ROS1.serialize_ros1(made["Twist"](linear, zero), twist)
                writer.write(connection, log, command)
    with open_recording(path) as recording:
        evidence = evidence_of(recording)
    assert {topic: len(times) for topic, times in evidence.commands.items()} == {"/cmd_vel": 200}
    (stopped,) = [one for one in judge(evidence).findings if one.id == "edge-stopped"]
    assert "/cmd_vel goes on for 10.00 s (100 messages)" in stopped.evidence[0]


@pytest.mark.parametrize("node", ["/play_1600000001234567890", "/display_1600000001234567890"])
def test_a_log_of_a_player_shows_that_old_data_was_replayed(tmp_path, node):
    path = tmp_path / "again.bag"
    tf, kind = "tf2_msgs/msg/TFMessage", "rosgraph_msgs/msg/Log"
    made = {name.split("/")[-1]: ROS1.types[name] for name in ROS1.types}
    with Writer(path) as writer:
        frames = writer.add_connection("/tf", tf, typestore=ROS1)
        rosout = writer.add_connection("/rosout", kind, typestore=ROS1)
        for number in range(100):
            stamp = 15 * 10**17 + number * 10**8
            at = ROS1.types["builtin_interfaces/msg/Time"](*divmod(stamp, 10**9))
            for child in ("base_link", "arm"):
                pose = made["Transform"](
                    made["Vector3"](0.01 * number, 0.0, 0.0), made["Quaternion"](0.0, 0.0, 0.0, 1.0)
                )
                header = made["Header"](number, at, "odom")
                message = ROS1.types[tf]([made["TransformStamped"](header, child, pose)])
                writer.write(frames, stamp + 10**17, ROS1.serialize_ros1(message, tf))
            if number == 50:
                header = made["Header"](0, at, "")
                log = ROS1.types[kind](header, 2, node, "hello", "a.cpp", "main", 1, ["/tf"])
                writer.write(rosout, stamp + 10**17, ROS1.serialize_ros1(log, kind))
    with open_recording(path) as recording:
        evidence = evidence_of(recording)
    assert evidence.played == ("/rosout" if "/play" in node else "")
    (shifted,) = [one for one in judge(evidence).findings if one.id == "shifted-clock"]
    told = "; /rosout names a player: the data was replayed from another recording"
    assert shifted.evidence[0].endswith(told) is ("/play" in node)


@pytest.mark.parametrize(("speed", "severity"), [(0.4, Severity.NOTE), (2.0, Severity.WARNING)])
def test_a_pose_of_motion_capture_that_is_sent_twice_moves_in_steps(speed, severity):
    made = Robot()
    for tick in range(400):
        made.sent("world", "drone", 0.01 * tick, (speed * 0.02 * (tick // 2), 0.0, 1.0, *NO_TURN))
    finding = found(made, "repeated-pose")
    assert finding.severity is severity
    assert "50 % of the samples repeat the previous pose" in finding.message


@pytest.mark.parametrize("rests", [False, True])
def test_the_time_of_a_jump_begins_when_a_repeated_pose_was_new(rests):
    def pose(t: float) -> tuple[float, ...]:
        step = int(20.0 * t + 1e-6)
        # A robot that rests for 2 s before the jump repeats its pose, too.
        step -= 0 if t >= 4.0 or not rests else max(0, step - 40)
        return (0.05 * step + (3.0 if t >= 4.0 else 0.0), 0.0, 0.0, *NO_TURN)

    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", 200.0, pose)
    finding = found(made, "teleport")
    assert finding.message.endswith("within 5 ms" if rests else "within 50 ms")
    assert ("the previous pose is sent 10 times" in finding.evidence[0]) is not rests


@pytest.mark.parametrize("late", [0.02, 0.5])
def test_a_topic_that_begins_with_a_jump_is_named(late):
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", pose=lambda t: (3.0 if t >= 4.0 else 0.0, 0.0, 0.0, *NO_TURN))
    made.hears("/wheels", "odom", 20.0, "nav_msgs/Odometry", begin=4.0 - late, latency=0.005)
    told = "; the first message of /wheels arrived 20 ms before the jump"
    assert found(made, "teleport").evidence[0].endswith(told) is (late == 0.02)


@pytest.mark.parametrize("later", [False, True])
def test_a_localiser_does_not_jump_between_samples_of_one_stamp(later):
    made = robot(odometry=False)
    made.moving("odom", "base_link", pose=lambda t: (3.0 if t >= 4.0 else 0.0, 0.0, 0.0, *NO_TURN))
    for tick in range(80):
        far = 0.9 * (tick % 16 // 8)
        made.sent("map", "odom", 0.1 * tick, (far if later else 0.0, 0.0, 0.0, *NO_TURN))
        made.sent("map", "odom", 0.1 * tick, (far, 0.0, 0.0, *NO_TURN))
    told = [one for one in made.judged().findings if one.id == "teleport"]
    # A jump of the odometry is a finding of its own.
    edges = sorted(one.edges for one in told)
    assert edges == [(("map", "odom"),)] * later + [(("odom", "base_link"),)]
    assert all(one.fixes[0].command != one.fixes[1].command for one in told)
