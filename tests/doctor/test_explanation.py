"""Tests of the reasons for failed lookups: the edge, the missing time, and the remedies."""

import io
from dataclasses import replace

import pytest
from rich.console import Console

from tests.doctor.robots import LASTS, NO_TURN, START, Robot, robot, stands
from tftool import Buffer, Transform, TransformStamped, diagnose, explain
from tftool.base.errors import InputError
from tftool.base.stamps import LATEST, seconds
from tftool.doctor.explanation import Explanation, over_time, traced
from tftool.doctor.lookup_reasons import Cause
from tftool.doctor.model import Model, Settings
from tftool.doctor.trace import LinkVerdict, Question, message_of
from tftool.drawing.explanation_view import render

T = seconds(START)


def asked(made: Robot, target: str, source: str, at: float, **more: object) -> Explanation:
    model = Model(made.evidence())
    return traced(model, Question(target, source, T + seconds(at), **more))


def test_a_transform_that_has_not_come_yet_is_explained_with_the_wait_needed():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=5, latency=0.25)
    made.hears("/scan", "laser", hz=20)

    found = asked(made, "odom", "laser", 4.25)

    assert not found.available
    assert found.exception == "ForwardExtrapolationException"
    assert "latest data is at time 1750000004.000000" in found.text
    assert found.because == "when the message on /scan with this stamp arrived"
    assert found.asked == T + seconds(4.265)
    assert found.refusing == ("odom", "base_link")
    assert [link.verdict for link in found.links] == [LinkVerdict.ANSWERS, LinkVerdict.FORWARD]
    assert found.links[1].short_by == seconds(0.25)
    assert (found.cause, found.check) == (Cause.LATE, "sensor-outruns-tf")
    # The sample for 4.4 arrives at 4.65. This needs a wait of 385 ms, or 390 ms as tf2 retries
    # every 10 ms.
    assert found.answerable_from == T + seconds(4.65)
    assert (found.remedies[0].least, found.remedies[0].advised) == (seconds(0.385), seconds(0.39))
    assert not found.remedies[1].possible


@pytest.mark.parametrize(("hz", "advised"), [(4, True), (50, False)])
def test_a_higher_rate_is_advised_only_where_the_link_comes_too_seldom(hz, advised):
    """Check the advised rate: a wait of 100 ms needs 10 Hz if no transform is late."""
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=hz, latency=0.0)
    made.hears("/scan", "laser", hz=20, latency=0.0)

    found = asked(made, "odom", "laser", 4.005)

    assert found.cause is Cause.LATE
    assert ("rate" in [remedy.kind for remedy in found.remedies]) is advised


@pytest.mark.parametrize(
    ("hours", "cure"), [(-0.004, "chronyc tracking`)"), (168.0, "played again looks the same")]
)
def test_a_path_across_two_clocks_is_no_matter_of_the_cache(hours, cure):
    made = robot(log_from=START + hours * 3600.0)
    made.hears("/points", "laser", 5.0, "sensor_msgs/PointCloud2")
    offset = seconds(hours * 3600.0)
    made.moving("map", "odom", hz=20, pose=stands)
    rows = made.records["map", "odom", False]
    made.records["map", "odom", False] = [(at + offset, pose, number) for at, pose, number in rows]

    found = asked(made, "map", "base_link", 4.0)

    assert (found.cause, found.check) == (Cause.CLOCK_OFFSET, "clock-offset")
    assert found.why[0].startswith("odom in map is ")
    assert [remedy.text.endswith(cure) for remedy in found.remedies] == [True]


def test_a_frame_with_a_slash_is_used_by_its_messages():
    made = robot()
    made.hears("/camera/info", "/camera_frame", kind="sensor_msgs/CameraInfo")

    found = asked(made, "base_link", "camera_frame", 4.0)

    assert "/camera/info names /camera_frame, 80 times" in found.why
    assert found.remedies[0].command.endswith("--child-frame-id camera_frame")
    assert found.remedies[1].text.startswith('and set frame_id to "camera_frame"')


def test_a_mount_that_odometry_displaced_is_mended_at_the_end_of_the_odometry():
    made = robot(odometry=False, laser=False)
    made.static("r1/base_link", "base_link")
    made.static("base_link", "laser")
    made.moving("odom", "base_link", begin=1.0)
    made.odometry = Robot()
    made.odometry.moving("odom", "r1/base_link", topic="/odom")

    found = asked(made, "odom", "r1/base_link", 4.0)

    assert found.remedies[0].text.startswith(
        "publish r1/base_link, the root of the mounts, in odom"
    )
    (doctor,) = [one for one in made.judged().findings if one.id == "static-and-dynamic"]
    assert doctor.fixes[0].text == found.remedies[0].text


def test_ros_1_stores_a_static_and_moving_frame_as_the_kind_that_came_first():
    for kind, begin, answers in (
        ("ROS 1 bag", -1.0, True),
        ("ROS 1 bag", 1.0, False),
        ("rosbag2", -1.0, False),
    ):
        made = robot(laser=False)
        made.kind = kind
        made.static("base_link", "laser", at=begin)
        made.moving("base_link", "laser", 2.0)
        # The newest sample of the laser is of 4.0 s.
        assert asked(made, "base_link", "laser", 4.25).available is answers


def test_waiting_so_long_answers():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=5, latency=0.25)
    made.hears("/scan", "laser", hz=20)

    assert asked(made, "odom", "laser", 4.25, timeout=seconds(0.385)).available
    assert not asked(made, "odom", "laser", 4.25, timeout=seconds(0.384)).available


def test_a_dropped_sample_needs_a_larger_cache_and_the_size_told_is_just_enough():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", end=20.0)
    made.hears("/cloud", "laser", kind="sensor_msgs/PointCloud2", hz=1, end=6.0, latency=13.0)

    found = asked(made, "odom", "laser", 5.0)

    assert (found.cause, found.links[1].verdict) == (Cause.CACHE, LinkVerdict.PRUNED)
    least = found.remedies[0].least
    # At 18.0 the newest sample is 17.98. ROS 2 prunes before it inserts the next sample, so a
    # period less is enough; ROS 1 prunes afterwards.
    assert least == seconds(12.98)
    for cache, answers in ((least, True), (least - seconds(0.04), False)):
        again = asked(made, "odom", "laser", 5.0, settings=Settings(cache_time=cache))
        assert again.available is answers


def test_a_text_that_quotes_a_link_off_the_way_is_said_to_mislead():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", end=20.0)
    made.moving("map", "odom", hz=20, pose=stands, end=20.0, offset=1.0)
    made.hears("/cloud", "laser", kind="sensor_msgs/PointCloud2", hz=1, end=6.0, latency=13.0)

    found = asked(made, "odom", "laser", 5.0)

    assert found.remedies[0].least == seconds(12.98)
    # The time is the oldest sample of odom in map, whose stamps are a second ahead; tf2 pruned
    # before the last sample arrived.
    assert "earliest data is at time 1750000008.900000" in found.text
    assert "quotes 1750000008.900, a time of odom, but odom is not on the path" in found.why[-1]


def test_a_lookup_before_the_first_data_of_a_link_can_never_be_answered():
    made = robot()
    made.moving("map", "odom", hz=20, pose=stands, offset=1.0)

    found = asked(made, "map", "laser", 0.3)

    assert (found.cause, found.refusing) == (Cause.BEFORE_START, ("map", "odom"))
    assert found.answerable_from is None
    assert found.links[-1].short_by == seconds(0.7)
    assert "the first 10 messages of /scan are lost" in found.remedies[0].text


def test_an_edge_that_ended_does_not_come_back():
    made = robot(odometry=False)
    made.moving("odom", "base_link", end=5.0)

    found = asked(made, "odom", "laser", 6.0)

    assert (found.cause, found.answerable_from) == (Cause.STOPPED, None)
    assert found.links[1].short_by == seconds(1.02)


def test_a_question_after_the_recording_blames_no_link_that_went_on_until_its_end():
    made = robot(odometry=False)
    made.moving("odom", "base_link", end=LASTS)

    found = asked(made, "odom", "laser", LASTS + 4)

    assert (found.cause, found.check) == (Cause.AFTER_END, None)
    assert found.why == (
        "the last sample of base_link in odom in the recording is at 1750000007.980, 4.02 s before "
        "the requested time",
    )
    assert found.remedies[0].text == "look up 1750000007.980 or earlier"


def test_a_moment_in_a_hole_waits_for_its_end():
    made = robot(odometry=False)
    made.moving("odom", "base_link", without=(3.0, 5.0))

    found = asked(made, "odom", "laser", 4.0)

    assert found.cause is Cause.GAP
    assert found.answerable_from == T + seconds(5.005)


def test_a_mount_sent_once_answers_for_its_own_stamp():
    made = robot()
    made.sent("base_link", "gps", 0.5)
    assert asked(made, "base_link", "gps", 4.0).cause is Cause.SINGLE
    assert asked(made, "base_link", "gps", 0.5, asked=T + seconds(1)).available


def test_two_clocks_never_meet():
    made = robot(start=136.0, log_from=START)
    made.start = START
    made.moving("base_link", "wheel", hz=30)
    model = Model(made.evidence())

    found = traced(model, Question("odom", "wheel", seconds(140)))

    assert found.cause is Cause.CLOCK_MIXTURE
    assert found.refusing == ("base_link", "wheel")
    assert "no /clock was recorded" in found.remedies[0].text


@pytest.mark.parametrize(
    ("target", "source", "cause", "told"),
    [
        (
            "odom",
            "lasre",
            Cause.UNKNOWN_FRAME,
            "look up laser, or set frame_id of the driver to laser",
        ),
        ("odom", "/laser", Cause.NAME, 'frame_id "laser"'),
        (
            "odom",
            "camera_link",
            Cause.SPLIT,
            "nothing in the data says where to join camera_link; if it is mounted on the robot, "
            "measure where, and publish it:",
        ),
    ],
)
def test_names_and_joins_that_are_missing(target, source, cause, told):
    made = robot()
    made.static("camera_link", "lens")

    found = asked(made, target, source, 4.0)

    assert (found.cause, found.available) == (cause, False)
    assert found.remedies[0].text == told


def test_a_lookup_that_works_asks_whether_the_node_has_a_listener():
    found = asked(robot(), "odom", "laser", 4.0)
    assert (found.available, found.cause, found.check) == (True, Cause.WORKS, None)
    assert "does the node have a TransformListener" in found.why[0]


def test_inside_a_circle_it_answers_and_the_circle_is_told():
    made = Robot()
    made.moving("odom", "body")
    made.moving("body", "odom")
    found = asked(made, "odom", "body", 4.0, asked=T + seconds(5))
    assert (found.available, found.cause) == (True, Cause.LOOP)


def test_a_static_that_comes_later_is_waited_for():
    made = robot(laser=False)
    made.static("base_link", "laser", at=3.0)
    found = asked(made, "odom", "laser", 2.0)
    assert found.cause in (Cause.LATE,)
    assert found.answerable_from == T + seconds(3.005)


def test_the_message_nearest_to_a_moment_is_found():
    model = Model(robot().evidence())
    heard, stamp = message_of(model, "/scan", T + seconds(4.04))
    assert (heard.frame, stamp) == ("laser", T + seconds(4))
    with pytest.raises(InputError, match="Topics with headers: /scan"):
        message_of(model, "/scam", None)


def test_a_buffer_can_be_asked_too():
    buffer = Buffer()
    for tick in range(100):
        pose = Transform((0.1 * tick, 0.0, 0.0), NO_TURN)
        buffer.set_transform(
            TransformStamped(T + seconds(0.1 * tick), "odom", "base_link", pose), "ekf"
        )
    buffer.set_transform(TransformStamped(T, "base_link", "gps", Transform()), "gps_node")

    (finding,) = [one for one in diagnose(buffer) if one.id == "single-sample"]
    assert finding.publishers == ("gps_node",)

    found = explain(buffer, "odom", "gps", T + seconds(5))
    assert (found.cause, found.refusing) == (Cause.SINGLE, ("base_link", "gps"))
    assert found.links[1].publisher == "ekf"
    assert explain(buffer, "odom", "base_link", T + seconds(5)).available


def test_values_are_frozen():
    (finding,) = [one for one in robot(laser=False).judged().findings if one.id == "static-missing"]
    with pytest.raises(AttributeError):
        finding.id = "other"
    with pytest.raises(TypeError):
        finding.facts["frames"] = []
    assert asked(robot(), "odom", "laser", LASTS / 2) == asked(robot(), "odom", "laser", LASTS / 2)


@pytest.mark.parametrize(
    ("begin", "share"),
    [(0.0, 0.0), (2.0, 0.25), (6.0, 0.75)],
)
def test_a_session_tells_for_how_long_a_lookup_would_have_failed(begin, share):
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", begin=begin)
    made.moving("base_link", "arm")
    model = Model(made.evidence())
    question = Question("odom", "arm")
    found = over_time(model, question, traced(model, question))
    assert found.available
    assert found.failed == pytest.approx(share, abs=0.01)
    told = f"this lookup works now; it would have failed for {share * 100:.0f} % of the last 7.98 s"
    assert (told in found.why) is bool(share)


def test_a_lookup_that_never_worked_in_a_session_failed_100_percent_of_the_time():
    model = Model(robot().evidence())
    question = Question("odom", "nowhere")
    found = over_time(model, question, traced(model, question))
    assert (found.available, found.failed) == (False, 1.0)
    assert found.why[0].startswith(
        "this lookup fails now, and would have failed for 100 % of the last"
    )


def test_a_question_for_the_latest_is_one_for_the_last_moment_in_common():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", end=2.0)
    made.moving("base_link", "arm", begin=5.0)
    model = Model(made.evidence())
    found = traced(model, Question("odom", "arm"))
    assert not found.available
    # The odometry ended at 1.98 and the arm began at 5, so there is no common time.
    assert found.links[0].verdict is LinkVerdict.BACKWARD
    assert found.links[0].short_by == seconds(3.02)
    assert found.cause is Cause.BEFORE_START


@pytest.mark.parametrize(
    ("joint", "joints", "told"),
    [
        ('type="continuous"', frozenset(), "no joint state contains 'lift'"),
        ('type="continuous"', frozenset({"lift"}), "no transform of robot_state_publisher arrived"),
        ('type="fixed"', None, "which is fixed: no transform of robot_state_publisher arrived"),
        ('type="floating"', None, "which is floating: robot_state_publisher skips it"),
    ],
)
def test_a_link_that_only_the_description_has_is_told_with_its_joint(joint, joints, told):
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=20)
    made.urdf = (
        '<robot name="r"><link name="base_link"/><link name="fork"/>'
        f'<joint name="lift" {joint}><parent link="base_link"/><child link="fork"/></joint></robot>'
    )
    made.joints = joints

    found = asked(made, "odom", "fork", 4)

    assert found.cause is Cause.UNKNOWN_FRAME
    assert any("by joint 'lift' of base_link" in why and told in why for why in found.why)


@pytest.mark.parametrize("width", [50, 60, 70])
def test_on_a_narrow_terminal_what_a_link_says_stands_below_it_in_whole_words(width):
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=5, latency=0.25)
    made.hears("/scan", "laser", hz=20)
    console = Console(width=width, file=io.StringIO(), color_system=None)

    console.print(render(asked(made, "odom", "laser", 4.25)))

    lines = [line.rstrip() for line in console.file.getvalue().splitlines()]
    assert max(map(len, lines)) <= width
    name = ["base_link", "in", "odom", "5", "Hz"]
    link = next(at for at, line in enumerate(lines) if line.split()[:5] == name)
    assert lines[link + 1] == "    REFUSES: newest is 250 ms too old"


def test_headings_stand_above_their_columns_where_messages_are_below_their_rows():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=5, latency=0.25)
    made.hears("/scan", "laser", hz=20)
    console = Console(width=80, file=io.StringIO(), color_system=None)

    console.print(render(asked(made, "odom", "laser", 4.25)))

    lines = console.file.getvalue().splitlines()
    (heading,) = [line for line in lines if line.startswith("  link  ")]
    (row,) = [line for line in lines if line.startswith("  base_link in odom")]
    assert row.index("5 Hz") == heading.index("kind")
    assert row[heading.index("samples") - 2 :].strip().isdigit()


def test_where_there_is_room_a_link_is_one_row():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=5, latency=0.25)
    made.hears("/scan", "laser", hz=20)
    console = Console(width=120, file=io.StringIO(), color_system=None)

    console.print(render(asked(made, "odom", "laser", 4.25)))

    (row,) = [line for line in console.file.getvalue().splitlines() if "5 Hz" in line]
    assert row.rstrip().endswith("REFUSES: newest is 250 ms too old")


@pytest.mark.parametrize(("static_at", "answers"), [(0.0, True), (7.92, False)])
def test_of_a_frame_that_is_sent_as_static_and_as_moving_the_last_kind_counts(static_at, answers):
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link")
    made.static("base_footprint", "base_link", at=static_at)
    question = Question("odom", "laser", asked=T + seconds(7.93))
    assert traced(Model(made.evidence()), question).available is answers


def test_a_frame_that_nothing_publishes_is_told_in_one_sentence():
    found = asked(robot(laser=False, scans=False), "odom", "laser", 4.0)
    assert found.remedies[0].text.startswith("nothing in this recording publishes laser:")


def test_the_frame_of_a_filtered_position_needs_no_mount():
    made = robot()
    made.hears("/gps/filtered", "gps", 1.0, "sensor_msgs/NavSatFix")
    found = asked(made, "odom", "gps", 4.0)
    assert [remedy.command for remedy in found.remedies] == [""]


def test_a_joint_that_ended_long_ago_needs_its_publisher_and_no_larger_cache():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", 10.0, end=40.0)
    made.moving("base_link", "wheel", 10.0, end=5.0)
    found = traced(Model(made.evidence()), Question("odom", "wheel"))
    assert (found.cause, found.check) == (Cause.STOPPED, "edge-stopped")
    # The wheel's last sample is at 4.9 s, and the last sample of all frames is at 39.9 s.
    assert "wheel in base_link ended at 1750000004.900, 35.00 s before" in found.why[0]
    assert [remedy.kind for remedy in found.remedies] == ["publisher"]


def test_another_number_in_a_name_is_another_thing_and_no_misspelling():
    made = robot()
    made.static("base_link", "landmark_21")
    for name, near in (("landmark_31", False), ("lanmark_21", True)):
        found = asked(made, "base_link", name, 5.0)
        assert ("landmark_21" in found.remedies[0].text) is near


def test_a_rotation_that_ros_1_drops_is_told_although_ros_2_answers():
    made = robot(scans=False)
    made.static("odom", "camera", (0.0, 0.0, 0.0, 0.0, 0.0, 0.6, 0.9))
    for kind, told in (("ROS 1 bag", True), ("MCAP", False)):
        made.kind = kind
        found = asked(made, "odom", "camera", 5.0)
        assert ("ROS 1 drops camera in odom" in found.why[0]) is told


def test_a_fixed_frame_that_is_not_recorded_names_the_root_that_is():
    made = Robot()
    made.moving("world", "drone")
    assert "the root of all frames in tf is world" in asked(made, "odom", "drone", 5.0).why
    assert not any("root" in one for one in asked(made, "world", "arm", 5.0).why)


def test_a_tree_without_a_map_lacks_the_parent():
    made = robot()
    made.moving("map", "odom")
    for number in range(5):
        made.moving("camera_frame", f"tag_{number}", 4.0)
    found = asked(made, "base_link", "tag_0", 4.0)
    assert found.why[0].startswith("camera_frame has no parent")
    assert "join camera_frame" in found.remedies[0].text


def test_both_unknown_names_are_told_and_a_slash_comes_last():
    made = robot()
    made.hears("/gps", "/world", kind="nav_msgs/Odometry")
    found = asked(made, "world", "gps", 4.0)
    assert "no transform contains gps either" in found.why
    first, second = (remedy.text for remedy in found.remedies)
    assert "publishes world: start its publisher" in first
    assert second.startswith('and set frame_id to "world"')


def test_transforms_of_a_type_that_no_listener_reads_are_said_to_be_of_no_use():
    made = robot()
    evidence = made.evidence()
    for kind, told in (("geometry_msgs/TransformStamped", True), ("tf2_msgs/TFMessage", False)):
        topics = tuple(replace(topic, type=kind) for topic in evidence.topics)
        model = Model(replace(evidence, topics=topics))
        explained = traced(model, Question("odom", "laser", LATEST))
        why = " ".join(explained.why)
        assert ("a listener does not receive laser in base_link, base_link in odom:" in why) is told
        console = Console(width=200)
        with console.capture() as printed:
            console.print(render(explained))
        assert ("answers here, but no listener receives these transforms" in printed.get()) is told
