"""Findings about poses that are sent although nothing was measured."""

import math

import pytest

from tests.doctor.judged import found, ids, turned
from tests.doctor.robots import NO_TURN, Pose, Robot, drives, robot
from tftool.doctor.findings import Confidence, Severity


def detections(node: str = "/detector", invalid: Pose = (0.0, 0.0, 0.0, *NO_TURN)) -> Robot:
    """Return two objects in the frame of a camera; two samples of three are invalid."""
    made = Robot()
    for tick in range(120):
        for number, name in enumerate(("obj1", "obj2")):
            pose = (0.7 + 0.001 * tick, 0.1 * number, -0.1, *NO_TURN)
            made.sent("camera", name, 0.05 * tick, invalid if tick % 3 else pose, node=node)
    return made


def test_zeros_that_a_detector_sends_by_turns_with_poses_are_one_finding():
    made = detections()
    assert ids(made) == ["placeholder-pose"]
    finding = found(made, "placeholder-pose")
    assert finding.severity is Severity.WARNING
    assert finding.edges == (("camera", "obj1"), ("camera", "obj2"))
    assert finding.publishers == ("/detector",)
    assert finding.count == 160
    assert finding.message == (
        "obj1, obj2 in camera are sent as exactly 0 0 0 in 66.7 % of their samples, alternating "
        "with other poses"
    )
    assert finding.fixes[0].text.startswith("check whether /detector has a measurement")


def test_rare_zeros_of_a_detector_explain_its_jumps():
    made = Robot()
    for tick in range(400):
        pose = (0.9, 0.001 * tick, -0.1, *NO_TURN)
        rare = tick in (100, 200, 300)
        made.sent("camera", "obj1", 0.05 * tick, (0.0, 0.0, 0.0, *NO_TURN) if rare else pose)
    assert ids(made) == ["placeholder-pose"]
    assert found(made, "outlier").because_of == "placeholder-pose"


def test_odometry_that_is_reset_sends_no_placeholder():
    made = Robot()
    for tick in range(400):
        # Each reset is one jump to the origin, and the robot drives on from there.
        pose = (0.02 * (tick % 80), 0.0, 0.0, *NO_TURN)
        made.sent("odom", "base_link", 0.05 * tick, pose, node="/base")
    assert "placeholder-pose" not in ids(made, notes=True)


def test_two_values_of_one_node_are_not_two_sources():
    made = detections(invalid=(0.0, 0.0, 0.4, *NO_TURN))
    # A filtered recording has one name for all nodes.
    finding = found(made, "publisher-conflict")
    assert finding.message.endswith("which alternate, the recording names only /detector")
    assert finding.fixes[0].text == (
        "while the robot runs, list the senders: `ros2 topic info --verbose /tf`"
    )
    made.moving("odom", "base_link", node="/driver")
    finding = found(made, "publisher-conflict")
    assert finding.message == (
        "obj1 in camera, obj2 in camera have two different values, which alternate, both "
        "sent by /detector"
    )
    assert not any("joint" in fix.text for fix in finding.fixes)


def two_filters(map_hz: float = 0.0) -> Robot:
    """Return a robot with two filters of one edge under one name, and a localiser above."""
    made = Robot()
    sent = [(tick / 60.0, 0.0) for tick in range(480)]
    sent += [(tick / 30.0 + 0.002, 0.4) for tick in range(240)]
    for at, aside in sorted(sent):
        pose = (0.5 * at, aside, 0.0, *turned(0.01 * at))
        made.sent("odom", "base_link", at, pose, latency=0.004, node="/ekf")
    for tick in range(round(8.0 * map_hz)):
        at = tick / map_hz
        # The localiser uses the newest transform, of either filter.
        made.sent("map", "odom", at, (1.0, -0.4 * (tick % 3 == 0), 0.0, *NO_TURN), node="/ekf")
    return made


def test_two_rates_of_one_edge_are_two_senders_even_under_one_name():
    finding = found(two_filters(), "publisher-conflict")
    assert finding.message.endswith(
        "which alternate, two senders (60 Hz and 30 Hz); the recording names only /ekf"
    )
    assert "/ekf" not in finding.fixes[0].text


def test_a_localiser_that_makes_up_for_two_filters_joins_their_conflict():
    made = two_filters(map_hz=29.0)
    finding = found(made, "publisher-conflict")
    assert ids(made).count("publisher-conflict") == 1
    assert set(finding.edges) == {("odom", "base_link"), ("map", "odom")}
    assert "odom in map makes up for it" in finding.evidence[0]


def freezes(t: float) -> Pose:
    """Return the pose of a moving body that motion capture loses from 3 s to 3.5 s."""
    t = 3.0 if 3.0 <= t < 3.5 else t
    return (0.5 * t, 0.01 * math.sin(20.0 * t), 1.7, *turned(0.1 * t))


def test_a_pose_that_is_repeated_until_the_body_is_seen_again_is_told():
    made = Robot()
    made.moving("world", "hat", 16.0, freezes, node="/mocap")
    assert ids(made) == ["frozen-pose"]
    finding = found(made, "frozen-pose")
    assert finding.confidence is Confidence.LIKELY
    # The pose is repeated from 3 s to the last sample before 3.5 s. The jump is the distance
    # between the poses at 3 s and 3.5 s.
    assert finding.message == (
        "hat in world repeats its last pose for up to 438 ms, before a jump of 0.25 m within "
        "62.5 ms"
    )


def measured(t: float) -> Pose:
    """Return the pose of a body whose seven numbers all change, as measured ones do."""
    lift, tilt = 0.01 * math.sin(3.0 * t + 0.1), 0.05 * math.sin(2.0 * t + 0.2)
    x, y, yaw = 0.02, tilt, 0.3 + 0.1 * t
    rotation = (x * math.cos(yaw), y, math.sin(yaw), math.cos(yaw))
    length = math.sqrt(sum(one * one for one in rotation))
    return (0.9 * t, lift, 1.7 + lift, *(one / length for one in rotation))


@pytest.mark.parametrize(("flat", "told"), [(False, ["frozen-pose"]), (True, [])])
def test_a_measured_pose_that_is_repeated_to_the_end_was_lost(flat, told):
    def pose(t: float) -> Pose:
        t = min(t, 6.0)
        # A simulated robot in a plane stops at once, and rests.
        return (0.9 * t, 0.0, 0.0, *NO_TURN) if flat else measured(t)

    made = Robot()
    made.moving("world", "car", 120.0, pose)
    assert ids(made, notes=True) == told
    if told:
        finding = found(made, "frozen-pose")
        assert finding.severity is Severity.WARNING
        # The last sample is a period of 8.3 ms before 8 s.
        assert finding.message == (
            "car in world repeats its last pose for up to 1.99 s, until its last sample"
        )
        assert finding.evidence[0].endswith("; before, it moved at 0.9 m/s")


@pytest.mark.parametrize(("number", "count"), [(5, 1), (4, 0)])
def test_single_repetitions_of_a_measured_pose_are_a_note(number, count):
    made = Robot()
    for tick in range(600):
        lost = tick % 100 == 50 and tick < 100 * number
        made.sent("world", "car", tick / 120.0, measured((tick - lost) / 120.0))
    told = [one for one in made.judged().findings if one.id == "frozen-pose"]
    assert [one.severity for one in told] == [Severity.NOTE] * count
    # A step of two periods at 0.9 m/s.
    assert all(one.message.endswith("before steps of up to 15 mm") for one in told)


def test_a_long_loss_beside_single_repetitions_is_a_warning():
    made = Robot()
    for tick in range(600):
        # The pose is lost for 0.3 s, and the first pose after that time comes twice.
        at = 299 if 299 <= tick < 335 else 335 if tick == 336 else tick
        made.sent("world", "quad", tick / 120.0, measured(at / 120.0))
    assert ids(made) == ["frozen-pose"]
    # 36 periods at 0.9 m/s are 0.27 m.
    assert found(made, "frozen-pose").message == (
        "quad in world repeats its last pose for up to 292 ms, before a jump of 0.27 m within "
        "8.33 ms"
    )


def test_short_losses_that_explain_a_jump_are_a_warning_too():
    made = Robot()
    for tick in range(900):
        lost = tick % 100 if tick % 100 < 24 else 0
        made.sent("world", "quad", tick / 120.0, measured((tick - lost) / 60.0))
    finding = found(made, "frozen-pose")
    assert found(made, "teleport").because_of == "frozen-pose"
    assert finding.severity is Severity.WARNING


@pytest.mark.parametrize("far", [0.25, 3.0])
def test_a_body_that_rests_and_is_then_placed_elsewhere_is_not_frozen(far):
    def pose(t: float) -> Pose:
        x = min(0.5 * t, 1.0) if t < 4.0 else 1.0 + far
        return (x, 0.0, 0.0, *NO_TURN)

    made = Robot()
    made.moving("world", "turtle1", 16.0, pose)
    assert "frozen-pose" not in ids(made, notes=True)


def test_a_body_that_was_lost_may_have_slowed_down():
    def pose(t: float) -> Pose:
        return (0.5 * min(t, 3.0) + (0.06 + 0.2 * (t - 3.5) if t >= 3.5 else 0.0), 0, 0, *NO_TURN)

    made = Robot()
    made.moving("world", "hat", 16.0, pose)
    assert ids(made) == ["frozen-pose"]


def test_a_pose_on_two_topics_does_not_arrive_out_of_order():
    made = robot()
    for tick in range(100):
        at = 0.05 * tick
        made.sent("world", "hat", at + 0.001, (at, 0.0, 0.0, *NO_TURN), node="/mocap")
        made.sent("world", "hat", at, (at, 0.0, 0.0, *NO_TURN), topic="/hat", node="/mocap")
    assert "out-of-order" not in ids(made, notes=True)


def flips(angle: float, *, length: float = 0.025, every: float = 100.0) -> Robot:
    """Return a turning body whose rotation is wrong for some samples from 3 s on."""

    def pose(t: float) -> Pose:
        wrong = t >= 3.0 and (t - 3.0) % every < length
        return (0.1 * t, 0.0, 1.7, *turned(0.1 * t + (angle if wrong else 0.0)))

    made = Robot()
    made.moving("world", "drone", 100.0, pose)
    return made


@pytest.mark.parametrize(("every", "often"), [(100.0, ""), (2.0, ", 3 times")])
def test_samples_between_a_jump_and_the_jump_back_are_outliers(every, often):
    made = flips(2.8, every=every)
    assert ids(made) == ["outlier"]
    finding = found(made, "outlier")
    # Half a turn and less: 2.8 rad are 160.4 degrees.
    assert finding.message == f"drone in world jumps 160° away for 30 ms, and back{often}"
    assert "3 samples at" in finding.evidence[0]
    # The last right sample is at 2.99 s, and the first wrong one at 3 s.
    assert finding.fixes[0].command == "tftool echo world drone RECORDING --at 1750000002.99"
    assert finding.fixes[1].command == "tftool echo world drone RECORDING --at 1750000003"
    assert "markers" in finding.fixes[2].text


def test_two_poses_for_one_stamp_are_told_as_such():
    made = Robot()
    for tick in range(100):
        made.sent("camera", "marker", 0.1 * tick, (0.0, 0.0, 1.0, *NO_TURN))
        if tick == 50:
            made.sent("camera", "marker", 0.1 * tick, (0.3, 0.0, 1.0, *turned(2.8)))
    finding = found(made, "outlier")
    assert finding.message == "marker in camera has two poses, 0.30 m apart, for one stamp"
    assert finding.fixes[0].command == "tftool echo camera marker RECORDING --at 1750000004.9"
    assert finding.fixes[1].command == "tftool echo camera marker RECORDING --at 1750000005"


@pytest.mark.parametrize(("angle", "told"), [(2.8, True), (1.5, False)])
def test_half_a_turn_that_lasts_asks_for_the_markers(angle, told):
    finding = found(flips(angle, length=1.0), "teleport")
    assert ("markers" in finding.fixes[-1].text) is told


def test_a_lasting_jump_beside_an_outlier_is_reported_too():
    def pose(t: float) -> Pose:
        wrong = 3.0 <= t < 3.025
        return (0.1 * t + (0.4 if t >= 5.0 else 0.0), 0.0, 2.5 if wrong else 1.7, *NO_TURN)

    made = Robot()
    made.moving("world", "drone", 100.0, pose)
    assert sorted(ids(made)) == ["outlier", "teleport"]
    assert "jumps 0.40 m" in found(made, "teleport").message
    assert found(made, "teleport").count == 1


def test_an_outlier_ends_where_the_pose_comes_back_and_its_last_step_is_no_teleport():
    def pose(t: float) -> Pose:
        # The last pose before the jump is off itself, as the first poses after it show.
        angle = {300: 0.44, 301: 1.2, 302: 0.15, 303: 0.17, 304: 0.17, 305: 0.3}
        return (0.1 * t, 0.0, 1.7, *turned(angle.get(round(100 * t), 0.44 if t < 3 else 0.4)))

    made = Robot()
    made.moving("world", "drone", 100.0, pose)
    finding = found(made, "outlier")
    assert "1 sample at" in finding.evidence[0]
    assert finding.message == "drone in world jumps 43.5° away for 10 ms, and back"
    assert ids(made) == ["outlier"]


@pytest.mark.parametrize(
    ("angle", "hz", "back", "told"),
    [
        (0.45, 60.0, 0.0, True),  # 0.45 rad are 25.8°, at 27 rad/s
        (0.3, 100.0, 0.0, False),  # 17.2°
        (0.45, 30.0, 0.0, False),  # 13.5 rad/s
        (0.45, 60.0, 0.2, False),  # it turns back by 0.25 rad only
    ],
)
def test_a_single_sample_that_turns_too_fast_away_and_back_is_an_outlier(angle, hz, back, told):
    made = Robot()
    for tick in range(400):
        turn = angle if tick == 200 else back * (tick > 200)
        made.sent("world", "drone", tick / hz, (0.001 * tick, 0.0, 1.7, *turned(turn)))
    assert ids(made) == (["outlier"] if told else [])


def test_a_slow_body_that_often_turns_to_the_opposite_side_and_back_has_outliers():
    def pose(t: float) -> Pose:
        return (0.1 * t, 0.0, 1.7, *turned(3.1 if t % 2.0 > 1.7 else 0.05 * t))

    made = Robot()
    made.moving("world", "drone", 12.0, pose)
    assert found(made, "outlier").count == 3  # the last one lasts until the end


def test_a_wheel_that_turns_by_half_a_turn_per_sample_has_no_outliers():
    made = robot()
    angle = 0.0
    for tick in range(160):
        angle += 3.0 if tick % 10 == 5 else 0.1
        made.sent("base_link", "wheel", 0.05 * tick, (0.0, 0.2, 0.1, *turned(angle, axis=1)))
    assert "outlier" not in ids(made, notes=True)


@pytest.mark.parametrize(("angle", "length"), [(0.4, 0.025), (2.8, 1.0), (2.8, 100.0)])
def test_small_long_and_lasting_jumps_are_no_outliers(angle, length):
    assert "outlier" not in ids(flips(angle, length=length), notes=True)


def test_samples_that_are_stamped_on_arrival_in_bunches_are_a_note():
    for pause, told in ((0.001, True), (0.0067, False)):
        made = robot()
        for tick in range(100):
            for number in range(3):
                at = 0.02 * tick + pause * number
                made.sent("world", "cap", at, drives(at), latency=0.001)
        assert ("bunched-stamps" in ids(made, notes=True)) is told


@pytest.mark.parametrize("copies", [True, False])
def test_pairs_of_samples_that_are_stamped_on_arrival_are_a_note(copies):
    made = robot()
    for tick in range(600):
        # A client that polls every 10 ms gets two samples of 120 Hz in one poll of five.
        at = 0.01 * (tick * 5 // 6) + 0.0001 * (tick % 6 == 1)
        pose = tick - (copies and tick % 6 == 1)
        made.sent("world", "drone", at, (0.01 * pose, 0.0, 1.0, *NO_TURN), latency=0.0005)
    assert ("bunched-stamps" in ids(made, notes=True)) is not copies
    if not copies:
        told = found(made, "bunched-stamps").evidence[0]
        assert "16.7 % of the steps are below" in told
        assert "moves as far in the short steps" in told


# Latitude 0, longitude 0 has the easting 166021.443 in zone 31. The last case is the example of the
# Python package utm: latitude 51.2, longitude 7.5.
@pytest.mark.parametrize(
    ("x", "y", "told"),
    [
        (-166021.443, 0.0, ["utm-origin"]),
        (0.0, 166021.443, ["utm-origin"]),
        (-166021.443, -10_000_000.0, ["utm-origin"]),
        (-395201.310, -5673135.241, []),
    ],
)
def test_utm_coordinates_of_a_position_of_zeros_are_told(x, y, told):
    for edge in (("odom", "utm"), ("utm", "map")):
        made = robot() if edge[0] == "odom" else Robot()
        made.static(*edge, (x, y, 0.0, *NO_TURN))
        made.moving("odom" if edge[0] == "odom" else "map", "body")
        assert ids(made) == told


def test_a_single_wrong_sample_among_slow_steps_and_turns_is_an_outlier():
    made = Robot()
    for tick in range(200):
        # The large usual steps are slow: they follow pauses.
        where = 1.5 if tick == 100 else 1.0 + 0.08 * (tick // 8 % 2)
        pose = (0.0, 0.0, where, *turned(0.2 * (tick > 99) + 0.4 * (tick > 100), 1))
        made.sent("camera", "tool", tick / 25 + 0.1 * (tick // 8), pose)
    assert ids(made) == ["outlier"]


@pytest.mark.parametrize(
    ("parent", "number", "hz", "told"),
    [
        ("optitrack", 12, 100.0, True),
        ("world", 12, 100.0, True),
        ("camera", 12, 100.0, False),
        ("world", 8, 100.0, False),
        ("world", 12, 20.0, False),
    ],
)
def test_many_small_turns_that_no_body_makes_are_outliers(parent, number, hz, told):
    made = Robot()
    for tick in range(1000):
        flips = tick >= 200 and tick % 20 < 2 and tick < 200 + 20 * number
        pose = (0.001 * tick, 0.0, 1.0, *turned(0.35 * flips))
        made.sent(parent, "body", tick / hz, pose)
    assert ("outlier" in ids(made)) is told
    if told:
        finding = found(made, "outlier")
        assert finding.count == number
        assert "jumps 20.1° away for 20 ms, and back, 12 times" in finding.message
