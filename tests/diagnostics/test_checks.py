"""Each check trips on a small robot of its own, and stays quiet where its guard says so."""

import math

import pytest

from tests.diagnostics.robots import LASTS, NO_TURN, START, Robot, drives, robot, stands
from tftool.diagnostics.catalogue import CHECKS
from tftool.diagnostics.findings import Finding, Severity
from tftool.diagnostics.model import Settings
from tftool.sources.contract import Publisher
from tftool.stamps import seconds


def found(made: Robot, name: str, settings: Settings | None = None) -> Finding:
    findings = [one for one in made.judged(settings).findings if one.id == name]
    assert findings, f"{name} is not among {[one.id for one in made.judged(settings).findings]}"
    return findings[0]


def ids(made: Robot, *, notes: bool = False) -> list[str]:
    return [
        one.id
        for one in made.judged().findings
        if one.because_of is None and (notes or one.severity is not Severity.NOTE)
    ]


def turned(angle: float, axis: int = 2) -> tuple[float, float, float, float]:
    rotation = [0.0, 0.0, 0.0, math.cos(angle / 2)]
    rotation[axis] = math.sin(angle / 2)
    return (rotation[0], rotation[1], rotation[2], rotation[3])


def test_a_healthy_robot_has_nothing():
    assert ids(robot(), notes=True) == []


def test_two_parents_by_turns_are_a_fight_and_one_change_is_a_switch():
    made = robot()
    made.moving("visual_odom", "base_link", hz=20)
    found_here = found(made, "two-parents")
    assert found_here.edges == (("odom", "base_link"), ("visual_odom", "base_link"))
    assert ids(made) == ["two-parents"]
    assert found(made, "split-tree").because_of == "two-parents"

    picked = robot()
    picked.moving("table", "cup", end=4.0)
    picked.moving("base_link", "cup", begin=4.0)
    picked.moving("odom", "table", pose=stands)
    assert found(picked, "parent-switch").severity is Severity.NOTE
    assert ids(picked) == []


def test_two_statics_with_different_parents_are_a_fight_too():
    made = robot()
    made.static("base_link", "camera")
    made.static("laser", "camera", at=0.5)
    assert set(found(made, "two-parents").edges) == {("base_link", "camera"), ("laser", "camera")}


def away(t: float) -> tuple[float, ...]:
    return (0.5 * t + 1.0, 0.3, 0.0, *NO_TURN)


def test_two_known_publishers_of_different_opinion_are_named():
    made = robot(odometry=False)
    made.moving("odom", "base_link", node="/gazebo")
    made.moving("odom", "base_link", pose=away, hz=30, node="/ekf")
    conflict = found(made, "publisher-conflict")
    assert conflict.publishers == ("/gazebo", "/ekf")
    assert conflict.confidence.value == "certain"
    # They drive 1 m and 0.3 m apart.
    assert conflict.facts["apart"] == pytest.approx(math.hypot(1.0, 0.3), abs=0.02)


def test_two_unknown_publishers_are_seen_from_the_values():
    made = robot(odometry=False)
    made.moving("odom", "base_link")
    made.moving("odom", "base_link", pose=away, hz=30)
    conflict = found(made, "publisher-conflict")
    assert conflict.confidence.value == "likely"
    assert conflict.edges == (("odom", "base_link"),)
    assert "teleport" not in ids(made)


@pytest.mark.parametrize("speed", [15.0, 40.0])
def test_what_is_merely_fast_has_one_publisher(speed):
    made = robot(odometry=False)
    made.moving("odom", "base_link", pose=lambda t: (speed * t, 0.0, 0.0, *NO_TURN))
    assert ids(made) == []


def test_two_publishers_of_equal_values_only_repeat_stamps():
    made = robot()
    made.moving("odom", "base_link")
    assert ids(made) == ["repeated-stamp"]


def test_a_frame_that_is_static_and_moves():
    made = robot()
    made.static("map", "base_link", at=3.0)
    assert found(made, "static-and-dynamic").frames == ("base_link",)


def test_a_static_that_changes_and_one_that_moves():
    changed = robot()
    changed.static("base_link", "laser", (0.3, 0.0, 0.2, *NO_TURN), at=4.0)
    finding = found(changed, "static-changed")
    assert finding.facts["moved"] == pytest.approx(0.2)

    moves = robot()
    for tick in range(6):
        moves.static("base_link", "arm", (0.1 * tick, 0.0, 0.0, *NO_TURN), at=float(tick))
    assert found(moves, "dynamic-on-static").edges == (("base_link", "arm"),)


def test_a_static_that_is_repeated_is_fine():
    made = robot()
    for tick in range(1, 8):
        made.static("base_link", "laser", at=float(tick))
    assert ids(made, notes=True) == []


def test_a_constant_on_tf_is_a_note_unless_the_robot_is_at_rest():
    made = robot()
    made.moving("base_link", "camera", hz=10, pose=stands)
    assert found(made, "static-on-tf").edges == (("base_link", "camera"),)

    rests = robot(odometry=False)
    rests.moving("odom", "base_link", pose=stands)
    assert ids(rests, notes=True) == []


def test_a_circle_is_named_and_is_no_split_tree():
    made = Robot()
    made.moving("odom", "body")
    made.moving("body", "odom")
    assert ids(made) == ["loop"]
    assert set(found(made, "loop").frames) == {"odom", "body"}


def test_edges_that_never_exist_together_form_no_circle():
    made = Robot()
    made.moving("a", "b", end=3.0)
    made.moving("b", "a", begin=5.0)
    assert "loop" not in ids(made)


def test_a_split_tree_is_worse_where_messages_are_in_it():
    made = robot()
    made.static("camera_link", "camera_optical")
    finding = found(made, "split-tree")
    assert finding.severity is Severity.WARNING
    assert finding.facts["join"] == {"parent": "base_link", "child": "camera_link", "guess": True}
    assert "--frame-id base_link --child-frame-id camera_link" in finding.fixes[0].command

    made.hears("/image", "camera_optical", kind="sensor_msgs/Image")
    finding = found(made, "split-tree")
    assert (finding.severity, finding.topics) == (Severity.ERROR, ("/image",))


def test_two_whole_robots_are_two_trees_by_intention():
    made = Robot()
    for name in ("r1", "r2"):
        made.moving(f"{name}/odom", f"{name}/base_link")
        made.static(f"{name}/base_link", f"{name}/laser")
        made.hears(f"/{name}/scan", f"{name}/laser")
    assert ids(made) == []


def test_names_that_are_empty_or_equal():
    made = robot()
    made.sent("odom", "odom", 1.0)
    made.sent("", "camera", 1.0)
    made.hears("/points", "", kind="sensor_msgs/PointCloud2")
    made.hears("/joint_states", "", kind="sensor_msgs/JointState")
    assert found(made, "self-transform").frames == ("odom",)
    severities = [one.severity for one in made.judged().findings if one.id == "empty-frame"]
    assert severities == [Severity.ERROR, Severity.WARNING]
    topics = [one.topics for one in made.judged().findings if one.id == "empty-frame"]
    assert ("/points",) in topics


def test_a_base_below_map_beside_odom_is_out_of_line():
    made = Robot()
    made.moving("map", "base_link")
    made.moving("map", "odom", pose=stands)
    assert found(made, "rep105-shape").edges == (("map", "base_link"),)

    below = Robot()
    below.moving("body", "odom")
    below.static("body", "laser")
    assert "rep105-shape" not in ids(below)


def test_a_frame_that_no_transform_names_is_told_with_what_fits():
    made = robot(scans=False)
    made.hears("/scan", "laser_frame")
    finding = found(made, "unknown-frame")
    assert (finding.frames, finding.topics) == (("laser_frame",), ("/scan",))
    assert finding.fixes[0].text == "set frame_id of the driver to laser"


def test_a_slash_in_a_header_has_its_own_check():
    made = robot(scans=False)
    made.hears("/scan", "/laser")
    assert ids(made) == ["slash-twins"]
    assert found(made, "slash-twins").topics == ("/scan",)


def test_slashes_in_transforms_are_a_note_and_two_of_them_an_error():
    made = robot()
    made.slashed["odom", "base_link", False] = 7
    made.static("base_link", "/camera")
    severities = {
        one.edges: one.severity for one in made.judged().findings if one.id == "leading-slash"
    }
    assert severities == {
        (("odom", "base_link"),): Severity.NOTE,
        (("base_link", "/camera"),): Severity.ERROR,
    }


def test_names_that_differ_in_case_hide_the_frame_that_is_unknown():
    made = robot(scans=False)
    made.hears("/scan", "Laser")
    assert ids(made) == ["case-twins"]
    assert set(found(made, "case-twins").frames) == {"Laser", "laser"}


def test_a_typo_is_one_but_left_and_right_and_numbers_are_a_family():
    made = robot(scans=False)
    made.hears("/scan", "lasre")
    assert ids(made) == ["typo-twins"]

    family = robot()
    for name in ("camera1", "camera2", "left_wheel", "right_wheel"):
        family.static("base_link", name)
    family.hears("/image", "camera3", kind="sensor_msgs/Image")
    assert "typo-twins" not in ids(family)


def test_a_prefix_that_half_of_the_frames_carry():
    made = robot(scans=False)
    made.moving("robot1/odom", "robot1/base_link")
    finding = found(made, "namespace-twins")
    assert finding.facts["prefix"] == "robot1/"
    assert ids(made) == ["namespace-twins"]


def test_transforms_on_a_namespaced_topic():
    made = Robot()
    made.moving("odom", "base_link", topic="/r1/tf")
    assert found(made, "namespaced-topic").severity is Severity.WARNING

    beside = robot()
    beside.moving("other", "thing", topic="/r1/tf")
    assert found(beside, "namespaced-topic").severity is Severity.NOTE


def test_a_note_does_not_hide_an_error():
    made = robot(scans=False)
    made.moving("other", "thing", topic="/r1/tf")
    made.hears("/scan", "nowhere")
    assert found(made, "namespaced-topic").severity is Severity.NOTE
    assert ids(made) == ["unknown-frame"]


@pytest.mark.parametrize("name", ["on", "1", "null", "laser ", "~laser", "a\nb", "x" * 120])
def test_names_that_tools_stumble_over(name):
    made = robot()
    made.static("base_link", name)
    assert found(made, "awkward-name").frames == (name,)


def test_two_clocks_name_the_edges_of_the_fewer():
    made = robot(start=136.0, log_from=START)
    made.start = START
    made.moving("base_link", "wheel", hz=30)
    finding = found(made, "clock-mixture")
    assert finding.edges == (("base_link", "wheel"),)
    assert ids(made) == ["clock-mixture"]


def test_a_simulation_with_its_clock_is_healthy():
    made = Robot(start=12.0, log_from=START)
    made.moving("odom", "base_link")
    made.moving("map", "odom", hz=20, pose=stands, offset=1.0)
    made.static("base_link", "laser")
    made.hears("/scan", "laser")
    # The simulator runs at half the speed; /clock says so.
    assert ids(made) == []
    assert "only differences" in made.judged().model.reference
    made.clock = [(seconds(12.0 + 0.1 * i), seconds(START + 0.1 * i)) for i in range(81)]
    assert ids(made) == []
    assert made.judged().model.reference == ""


def test_transforms_from_the_future_and_of_long_ago():
    ahead = robot(odometry=False)
    ahead.moving("odom", "base_link", offset=0.5)
    assert found(ahead, "future-stamp").severity is Severity.WARNING

    localised = robot()
    localised.moving("map", "odom", hz=20, pose=stands, offset=1.0)
    assert "future-stamp" not in ids(localised, notes=True)

    late = robot(odometry=False, scans=False)
    late.moving("odom", "base_link", latency=0.8)
    assert found(late, "stale-stamp").severity is Severity.WARNING
    later = robot(odometry=False, scans=False)
    later.moving("odom", "base_link", latency=11.0)
    assert found(later, "stale-stamp").severity is Severity.ERROR


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
    # Log order is that of arrival: those that took longer come behind newer ones.
    assert found(overtaken, "out-of-order").severity is Severity.NOTE


def test_an_edge_that_stops_explains_why_scans_cannot_be_placed():
    made = robot(odometry=False)
    made.moving("odom", "base_link", end=5.0)
    assert ids(made) == ["edge-stopped"]
    outran = found(made, "sensor-outruns-tf")
    assert outran.because_of == "edge-stopped"


def test_a_hole_is_told_with_its_ends():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", without=(3.0, 4.0))
    finding = found(made, "gap")
    assert finding.facts["begin"] == seconds(START) + seconds(2.98)
    assert finding.facts["end"] == seconds(START) + seconds(4)
    assert finding.severity is Severity.WARNING


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


def test_a_mount_sent_once_on_tf():
    made = robot()
    made.sent("base_link", "gps", 0.5)
    assert ids(made) == ["single-sample"]


def test_nothing_at_all_is_an_error():
    made = Robot()
    made.hears("/scan", "laser")
    assert ids(made) == ["no-transforms"]


def test_statics_that_are_missing_explain_frames_that_are_unknown():
    made = robot(laser=False)
    assert ids(made) == ["static-missing"]
    assert found(made, "unknown-frame").because_of == "static-missing"


def test_statics_that_come_late():
    made = robot(laser=False)
    made.static("base_link", "laser", at=3.0)
    finding = found(made, "static-late")
    # 30 scans of 10 Hz are stamped before; the last of them arrives after the static.
    assert finding.topics == ("/scan",)
    assert finding.facts["late"] == pytest.approx(seconds(3.0), abs=seconds(0.02))


def test_statics_that_are_offered_to_no_late_subscriber():
    made = robot()
    made.publishers[1] = Publisher("/tf_static", durability="volatile")
    assert found(made, "static-not-latched").topics == ("/tf_static",)


def test_statics_spread_over_messages_are_a_note():
    made = robot()
    made.static("base_link", "camera", at=0.1)
    assert found(made, "latched-overwrite").frames == ("laser",)


def test_odometry_that_comes_too_late_for_the_laser():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=5, latency=0.25)
    made.hears("/scan", "laser", hz=20)
    finding = found(made, "sensor-outruns-tf")
    assert (finding.topics, finding.edges) == (("/scan",), (("odom", "base_link"),))
    # The scan just after a sample waits for the next one (150 ms on), and that one's delay.
    assert finding.facts["worst"] == pytest.approx(seconds(0.15 + 0.25 - 0.015), abs=1)
    assert any("no rate is enough" in fix.text for fix in finding.fixes)


def test_a_healthy_laser_may_wait_a_little():
    made = robot()
    made.hears("/imu", "laser", hz=100, kind="sensor_msgs/Imu", latency=0.002)
    assert ids(made, notes=True) == []


def test_messages_older_than_the_cache():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", end=20.0)
    made.hears("/cloud", "laser", kind="sensor_msgs/PointCloud2", end=5.0, latency=13.0)
    assert found(made, "cache-short").facts["needed"] == 14
    assert ids(made) == ["cache-short"]
    assert "cache-short" not in [
        one.id for one in made.judged(Settings(cache_time=seconds(30))).findings
    ]


def test_messages_before_the_first_transform_are_lost():
    made = robot()
    made.moving("map", "odom", hz=20, pose=stands, begin=2.0, offset=1.0)
    finding = found(made, "late-start")
    assert (finding.severity, finding.facts["lost"]) == (Severity.NOTE, 30)


@pytest.mark.parametrize("ahead", [0.1, 1.0, 2.0])
def test_a_localiser_that_dates_its_transforms_ahead_is_healthy(ahead):
    made = robot()
    made.moving("map", "odom", hz=20, pose=stands, offset=ahead)
    assert ids(made, notes=True) == []


def test_damage_is_told():
    made = robot()
    made.damage = ("the last chunk is torn",)
    assert found(made, "truncated-recording").evidence == ("the last chunk is torn",)


@pytest.mark.parametrize(
    ("rotation", "severity"),
    [((0.0, 0.0, 0.0, 0.0), Severity.ERROR), ((0.0, 0.0, 0.0, 1.1), Severity.WARNING)],
)
def test_rotations_that_are_none(rotation, severity):
    made = robot()
    made.static("base_link", "camera", (0.0, 0.0, 0.0, *rotation))
    assert found(made, "bad-quaternion").severity is severity


def test_a_jump_of_odometry_and_none_of_a_localiser():
    def jumps(t: float) -> tuple[float, ...]:
        return (0.5 * t + (2.5 if t > 5.0 else 0.0), 0.0, 0.0, *NO_TURN)

    made = robot(odometry=False)
    made.moving("odom", "base_link", pose=jumps)
    finding = found(made, "teleport")
    assert finding.facts["jump"] == pytest.approx(2.5 + 0.5 / 50)
    assert finding.count == 1

    spins = robot(odometry=False)
    spins.moving(
        "odom", "base_link", pose=lambda t: (0.5 * t, 0.0, 0.0, *turned(2.0 if t > 5 else 0.0))
    )
    assert found(spins, "teleport").facts["turn"] == pytest.approx(2.0)

    localised = robot()
    localised.moving("map", "odom", hz=20, pose=jumps)
    assert "teleport" not in ids(localised)


def test_an_optical_frame_with_the_axes_of_the_body():
    made = robot()
    made.static("base_link", "camera_link")
    made.static("camera_link", "camera_optical_frame", (0.0, 0.0, 0.0, *NO_TURN))
    # From body to optical axes is a third of a turn about a diagonal.
    assert found(made, "optical-convention").facts["off"] == pytest.approx(120.0)

    right = robot()
    right.static("base_link", "camera_link")
    right.static("camera_link", "camera_optical_frame", (0.0, 0.0, 0.0, -0.5, 0.5, -0.5, 0.5))
    assert ids(right) == []


def test_pictures_in_a_body_frame_are_a_note():
    made = robot()
    made.hears("/image", "laser", kind="sensor_msgs/Image")
    assert found(made, "image-not-optical").severity is Severity.NOTE


def test_mounts_that_look_mistyped_are_notes():
    made = robot()
    made.static("base_link", "camera", (1200.0, 0.0, 0.0, *NO_TURN))
    made.static("base_link", "sonar", (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0))
    assert found(made, "suspect-units").edges == (("base_link", "camera"),)
    assert found(made, "suspect-order").edges == (("base_link", "sonar"),)
    assert ids(made) == []


def test_stamps_and_numbers_of_any_size_are_judged():
    made = robot()
    for stamp in (0, -1, 2**63 - 1, -(2**63), seconds(START)):
        for number in (0.0, 1e308, -1e308, math.inf):
            made.sent("base_link", "arm", 1.0, (number, number, 0.0, *NO_TURN), stamp=stamp)
            made.sent("odom", "base_link", 1.0, (number, 0.0, 0.0, *NO_TURN), stamp=stamp)
    assert {"nan-transform", "zero-stamp"} <= set(ids(made))


def test_what_only_came_after_time_went_back_is_left_out():
    made = robot()
    made.log_from = START + LASTS
    made.moving("odom", "base_link")
    made.hears("/scan", "laser")
    made.moving("base_link", "arm", pose=stands)
    made.hears("/late", "nowhere")
    assert ids(made) == ["time-jump-back"]


def test_a_threshold_can_be_changed_and_is_then_told():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", without=(3.0, 4.0))
    assert "gap" in ids(made)
    wide = Settings(limits={"gap": {"seconds": 2.0}})
    assert "gap" not in [one.id for one in made.judged(wide).findings]
    narrow = Settings(limits={"gap": {"seconds": 0.7}})
    assert found(made, "gap", narrow).evidence[-1] == "with seconds = 0.7"


def urdf(*joints: str) -> str:
    """Joints written "wheel: continuous base_link wheel_link"."""
    links: dict[str, None] = {}
    text = ""
    for joint in joints:
        name, _, rest = joint.partition(": ")
        kind, parent, child, *more = rest.split()
        links |= dict.fromkeys((parent, child))
        limit = '<limit effort="1" velocity="1" lower="-1" upper="1"/>' * (kind == "revolute")
        text += (
            f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
            f"{limit}{' '.join(more)}</joint>"
        )
    return f'<robot name="r">{"".join(f"<link name={n!r}/>" for n in links)}{text}</robot>'


LASER_JOINT = "laser_joint: fixed base_link laser <origin xyz='0.1 0 0.2'/>"


def test_a_robot_that_is_as_its_description_says_has_nothing():
    made = robot()
    made.urdf = urdf(LASER_JOINT)
    made.joints = frozenset()
    assert ids(made, notes=True) == []
    assert not [one for one in made.judged().skipped if one.id.startswith(("urdf", "joint"))]


def test_a_joint_without_state_explains_the_links_below_it():
    made = robot()
    made.urdf = urdf(
        LASER_JOINT,
        "caster: continuous base_link caster_link",
        "roller: fixed caster_link roller_link",
        "twin: continuous base_link twin_link <mimic joint='caster'/>",
    )
    made.joints = frozenset({"wheel"})
    finding = found(made, "joint-without-state")
    assert finding.message == "caster has no state: caster_link has no frame"
    assert finding.frames == ("caster_link", "roller_link", "twin_link")
    assert ids(made) == ["joint-without-state"]
    assert found(made, "urdf-frame-unpublished").because_of == "joint-without-state"

    made.joints = frozenset({"caster"})
    assert "joint-without-state" not in ids(made)
    # Joint states that nothing turned into transforms: robot_state_publisher did not run.
    assert found(made, "urdf-frame-unpublished").because_of is None


def test_a_joint_whose_frame_another_node_publishes_needs_no_state():
    made = robot()
    made.urdf = urdf(LASER_JOINT, "caster: continuous base_link caster_link")
    made.joints = frozenset()
    made.moving("base_link", "caster_link")
    assert ids(made) == []


def test_links_that_tf_lacks_are_told_with_the_reason_of_their_joint():
    made = robot()
    made.urdf = urdf(LASER_JOINT, "cam: fixed base_link camera", "arm: revolute base_link arm_link")
    finding = found(made, "urdf-frame-unpublished")
    assert finding.frames == ("camera", "arm_link")
    assert finding.evidence == (
        "camera: fixed to base_link: the statics are missing",
        "arm_link: moved by arm (revolute): no state of it was published",
    )
    # What the description promises is no unknown frame, wherever messages are.
    made.hears("/image", "camera", kind="sensor_msgs/CompressedImage")
    assert ids(made) == ["urdf-frame-unpublished"]


def test_a_prefix_of_all_frames_is_not_a_difference():
    made = Robot()
    made.moving("r1/odom", "r1/base_link")
    made.static("r1/base_link", "r1/laser")
    made.urdf = urdf(LASER_JOINT)
    assert ids(made) == []


@pytest.mark.parametrize(
    ("pose", "differs"),
    [
        ((0.1, 0.0, 0.2009, *NO_TURN), False),
        ((0.1, 0.0, 0.202, *NO_TURN), True),
        ((0.1, 0.0, 0.2, *turned(math.radians(0.09))), False),
        ((0.1, 0.0, 0.2, *turned(math.radians(0.2))), True),
    ],
)
def test_a_mount_that_differs_from_its_fixed_joint(pose, differs):
    made = robot(laser=False)
    made.static("base_link", "laser", pose)
    made.urdf = urdf(LASER_JOINT)
    assert ("urdf-tf-mismatch" in ids(made)) is differs


def test_a_description_with_mistakes_is_told_and_the_rest_is_skipped():
    made = robot()
    made.urdf = urdf("a: fixed one two", "b: fixed three four")
    assert ids(made) == ["urdf-invalid"]
    reasons = {one.id: one.reason for one in made.judged().skipped}
    assert reasons["urdf-tf-mismatch"] == "the robot description has mistakes"


def test_the_description_knows_the_join_that_is_missing():
    made = robot()
    made.static("camera_link", "lens")
    made.urdf = urdf(
        LASER_JOINT,
        "mast: fixed laser camera_link <origin xyz='1 2 3'/>",
        "glass: fixed camera_link lens <origin xyz='0.1 0 0.2'/>",
    )
    finding = found(made, "split-tree")
    assert finding.facts["join"] == {"parent": "laser", "child": "camera_link", "guess": False}
    assert "--x 1 --y 2 --z 3 " in finding.fixes[0].command


def test_a_movable_joint_at_rest_is_no_constant():
    made = robot()
    made.moving("base_link", "door", hz=10, pose=stands)
    made.urdf = urdf(LASER_JOINT, "hinge: revolute base_link door")
    made.joints = frozenset({"hinge"})
    assert ids(made, notes=True) == []


def says(pose, latency=0.004, child="base_link"):
    """What odometry messages say."""
    told = Robot()
    told.moving("odom", child, pose=pose, topic="/odom", latency=latency)
    return told


def test_odometry_and_transform_of_one_name_that_disagree():
    made = robot()
    made.odometry = says(drives)
    assert ids(made, notes=True) == []
    made.odometry = says(lambda t: (0.5 * t + 0.04, 0.0, 0.0, *NO_TURN))
    assert ids(made) == []
    made.odometry = says(lambda t: (0.5 * t + 0.06, 0.0, 0.0, *NO_TURN))
    finding = found(made, "odometry-tf-mismatch")
    assert (finding.severity, finding.topics, finding.edges, finding.count) == (
        Severity.WARNING, ("/odom",), (("odom", "base_link"),), 400,
    )  # fmt: skip
    made.odometry = says(lambda t: (0.5 * t, 0.0, 0.0, *turned(math.radians(3.0))))
    assert found(made, "odometry-tf-mismatch").facts["turned"] == pytest.approx(math.radians(3))
    # At times they may: more than half is too often.
    made.odometry = says(lambda t: (0.5 * t + (1.0 if t > 4.5 else 0.0), 0.0, 0.0, *NO_TURN))
    assert ids(made) == []


def test_odometry_of_a_pair_that_tf_does_not_join_is_a_note():
    made = robot()
    made.static("laser", "lens")
    made.odometry = says(drives, child="laser")
    finding = found(made, "odometry-tf-mismatch")
    assert (finding.severity, finding.edges) == (Severity.NOTE, (("odom", "laser"),))
    assert finding.evidence == ("/odom says laser in odom; in tf laser hangs from base_link",)


def test_every_check_of_the_catalogue_is_tripped_here():
    text = __file__
    with open(text, encoding="utf-8") as file:
        source = file.read()
    assert [name for name in CHECKS if f'"{name}"' not in source] == []
