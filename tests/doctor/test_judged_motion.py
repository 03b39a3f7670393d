"""Findings about motion capture, several robots and clocks, as on recordings of real robots."""

import pytest

from tests.doctor.judged import found, ids, turned
from tests.doctor.robots import NO_TURN, Robot


def held_up(parent: str, *, moves: bool, turns: float = 0.0) -> Robot:
    """Return a body at 100 Hz that rests, moves by 2 m during a stall of 1.7 s, and rests.

    Pauses of 0.12 s before the stall are many. The first pose after the stall is an old one.
    """
    made = Robot()
    at = 0.0
    for tick in range(700):
        at += 0.01
        if tick % 30 == 29:
            at += 0.11
        if tick == 400:
            at += 1.69
        away = (0.0 if tick < 400 else 0.6 if tick == 400 else 2.0) * moves
        turn = turned(turns * (tick > 400))
        made.sent(parent, "car", at, (away + 1e-4 * (tick % 3), 0.0, 0.0, *turn))
    return made


@pytest.mark.parametrize(
    ("parent", "moves", "told"),
    [("world", True, ["gap"]), ("world", False, []), ("odom", True, ["gap", "teleport"])],
)
def test_a_body_that_moved_while_its_poses_were_held_up_has_a_gap_and_no_jump(parent, moves, told):
    made = held_up(parent, moves=moves)
    assert ids(made) == told
    if told:
        assert found(made, "gap").facts["length"] == pytest.approx(1.7e9, rel=0.01)


@pytest.mark.parametrize(("turns", "jumps"), [(0.6, False), (3.1, True)])
def test_only_a_flip_after_poses_were_held_up_is_a_jump(turns, jumps):
    assert ("teleport" in ids(held_up("world", moves=True, turns=turns))) is jumps


def fleet(names: tuple[str, ...], *, ahead: str = "") -> Robot:
    """Return robots with maps of their own; the clock of one robot is 20 minutes ahead."""
    made = Robot()
    for name in names:
        by = 1200.0 if name == ahead else 0.0
        made.moving(f"{name}/odom", f"{name}/base_link", offset=by)
        made.hears(f"/{name}/pose", f"{name}/odom", kind="nav_msgs/Odometry")
        made.hears(f"/{name}/sonar", f"{name}/base_link", kind="sensor_msgs/Range")
        shift_stamps(made, by, f"/{name}/pose", f"/{name}/sonar")
    return made


def shift_stamps(made: Robot, by: float, *topics: str) -> None:
    for topic in topics:
        rows = made.heard[topic][1]
        rows[:] = [(stamp + int(by * 1e9), log, frame) for stamp, log, frame in rows]


def test_the_odom_of_a_map_is_that_of_the_same_robot():
    made = fleet(("car0", "car1"))
    made.moving("car1/map", "car1/scanmatcher_frame")
    made.hears("/car1/slam", "car1/map", kind="geometry_msgs/PoseStamped")
    finding = next(
        one for one in made.judged().findings if one.id == "split-tree" and "map" in one.message
    )
    assert finding.message == "car1/map is not joined to the tree of car1/odom"
    assert "publish car1/odom in car1/map" in finding.fixes[0].text


def test_a_missing_localiser_of_each_robot_is_one_finding():
    made = fleet(("car0", "car1"))
    for car in ("car0", "car1"):
        made.moving(f"{car}/map", f"{car}/scanmatcher_frame")
        made.hears(f"/{car}/slam", f"{car}/map", kind="geometry_msgs/PoseStamped")
    findings = [one for one in made.judged().findings if one.id == "split-tree"]
    (finding,) = [one for one in findings if "map" in one.message]
    assert finding.message == (
        "car0/map, car1/map are not joined to the trees of car0/odom, car1/odom"
    )
    assert finding.fixes[0].text.endswith("; so for car1/map")
    assert len(finding.evidence) == 2


@pytest.mark.parametrize("others", [("p4",), ("p4", "p5")])
def test_the_robot_that_agrees_with_the_recorder_is_not_blamed(others):
    made = fleet(("p1", *others), ahead="p1")
    # The robot with another clock may have more streams.
    for number in range(6):
        made.hears(f"/p1/range{number}", "p1/base_link", 7.0, "sensor_msgs/Range")
        shift_stamps(made, 1200.0, f"/p1/range{number}")
    finding = found(made, "clock-offset")
    assert finding.edges == (("p1/odom", "p1/base_link"),)
    assert all(topic.startswith("/p1/") for topic in finding.topics)
    assert finding.message.endswith("are 20 minutes ahead of the other clocks")
    assert finding.consequence == "no lookup across the two clocks can succeed with a cache of 10 s"
    assert "stale-stamp" not in ids(made, notes=True)


def test_wheels_of_a_driver_are_no_joint_states_of_a_description():
    for topic, told in (("/p1/wheels", False), ("/p1/joint_states", True)):
        made = fleet(("p1",))
        made.hears(topic, "", kind="sensor_msgs/JointState")
        made.hears("/p1/scan", "p1/laser")
        finding = found(made, "static-missing")
        assert ("robot_state_publisher" in finding.fixes[0].text) is told
        commands = [fix.command for fix in finding.fixes if fix.command]
        assert told or "p1/base_link" in commands[-1]


def test_stamps_of_bursts_that_are_all_ahead_are_a_shifted_clock():
    made = Robot()
    for tick in range(600):
        # In the second half of each six seconds, all data waits until their end.
        at = tick / 25
        late = 6.0 - at % 6.0 if at % 6.0 >= 3.0 else 0.005
        for child in ("base_link", "arm"):
            pose = (0.1 * at, 0.0, 0.0, *NO_TURN)
            made.sent("odom", child, at + 19.0, pose, latency=late - 19.0)
        made.heard.setdefault("/odom", ("nav_msgs/Odometry", []))[1].append(
            (made.log(at + 19.0), made.log(at + late), "odom")
        )
    shifted = found(made, "shifted-clock")
    assert shifted.facts["streams"] == 3
    # Half of the messages wait for seconds, so the difference is no constant of all.
    assert shifted.message.endswith("in the half of the messages that waited least")
    assert "clock-offset" not in ids(made, notes=True)


@pytest.mark.parametrize(("late", "told"), [(17490.0, True), (20.0, False)])
def test_messages_of_any_type_hours_behind_are_on_another_clock(late, told):
    made = fleet(("car1",))
    made.hears("/car1/control", "", kind="multi_car_msgs/CarControl")
    shift_stamps(made, -late, "/car1/control")
    assert ("clock-offset" in ids(made)) is told
    if told:
        message = found(made, "clock-offset").message
        assert message == "/car1/control is 4.86 hours behind the other clocks"
