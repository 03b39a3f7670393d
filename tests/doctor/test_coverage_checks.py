"""Tests of checks for missing statics, late data and outages, each on a small robot."""

import io
from dataclasses import replace

import pytest
from rich.console import Console

from tests.doctor.judged import found, ids
from tests.doctor.robots import NO_TURN, START, Robot, drives, robot, stands
from tftool.base.stamps import seconds
from tftool.doctor.findings import Severity
from tftool.doctor.judge import judge
from tftool.doctor.model import Settings
from tftool.drawing import finding_view
from tftool.recordings.contract import Publisher


def test_a_mount_sent_once_on_tf():
    made = robot()
    made.sent("base_link", "gps", 0.5)
    assert ids(made) == ["single-sample"]


def test_a_goal_sent_once_on_tf_is_a_note_until_messages_are_in_it():
    made = robot()
    made.sent("odom", "goal", 0.5)
    assert ids(made) == []
    made.hears("/range", "goal", kind="sensor_msgs/Range")
    assert ids(made) == ["single-sample"]


def test_statics_that_are_missing_explain_frames_that_are_unknown():
    made = robot(laser=False)
    assert ids(made) == ["static-missing"]
    assert found(made, "unknown-frame").because_of == "static-missing"


def test_a_missing_static_is_named_without_the_slash_of_its_messages():
    made = robot(laser=False, scans=False)
    made.hears("/scan", "/laser")
    finding = found(made, "static-missing")
    assert finding.message.startswith("no transform names laser:")
    assert finding.fixes[-1].text.startswith("and set the frame_id of /scan without its leading")
    assert found(made, "unknown-frame").because_of == "static-missing"


def test_a_recording_without_statics_of_a_robot_at_rest_lacks_their_topic():
    made = Robot()
    made.moving("odom", "base_link", pose=stands)
    made.hears("/front", "front_laser_link")
    made.hears("/back", "back_laser_link")
    assert ids(made) == ["static-missing"]
    finding = found(made, "static-missing")
    assert finding.frames == ("back_laser_link", "front_laser_link")
    # Nothing shows whether the robot sends them.
    assert finding.fixes[1].text == (
        "if nothing sends them, publish the mount for each of the frames:"
    )
    assert finding.fixes[1].command.endswith("--frame-id PARENT --child-frame-id back_laser_link")
    # The topic of static transforms was not recorded, so the robot may have some.
    assert finding.severity is Severity.WARNING


@pytest.mark.parametrize(("ahead", "is_cut"), [(0.0, True), (0.5, False)])
def test_trees_of_one_state_publisher_lack_the_static_transforms_between_them(ahead, is_cut):
    made = Robot()
    made.moving("odom", "base_link")
    made.moving("base_link", "arm", node="/robot_state_publisher")
    # Early ROS 1 dates fixed joints half a second ahead, and has no other static transforms.
    made.moving("hand", "finger", 50, stands, offset=ahead, node="/robot_state_publisher")
    (fix,) = found(made, "split-tree").fixes
    assert ("static, and not in the recording: record /tf and /tf_static" in fix.text) is is_cut
    assert not (is_cut and fix.command)


def test_without_any_part_of_the_robot_all_sensors_lack_their_frames_for_one_reason():
    made = robot(laser=False)
    made.hears("/points", "points2", kind="sensor_msgs/PointCloud2")
    assert ids(made) == ["static-missing"]
    finding = found(made, "static-missing")
    assert finding.frames == ("laser", "points2")
    assert finding.severity is Severity.WARNING
    assert len([one for one in made.judged().findings if one.because_of == "static-missing"]) == 2
    made.moving("base_link", "arm")
    assert found(made, "static-missing").frames == ("laser",)
    (other,) = [one for one in made.judged().findings if one.frames == ("points2",)]
    assert other.severity is Severity.ERROR


@pytest.mark.parametrize(("child", "told"), [("odom", False), ("base_link", False), ("arm", True)])
def test_another_name_of_a_frame_is_only_looked_for_if_tf_has_a_frame_for_it(child, told):
    made = Robot()
    made.moving("map", child)
    made.hears("/points", "points2", kind="sensor_msgs/PointCloud2")
    (fix,) = found(made, "unknown-frame").fixes
    assert fix.text.startswith("find the node that should publish the frame")
    assert ("the name that the frame has in tf" in fix.text) is told


def test_joint_states_without_transforms_of_joints_need_robot_state_publisher():
    made = robot(laser=False)
    made.hears("/joint_states", "", kind="sensor_msgs/JointState")
    finding = found(made, "static-missing")
    assert "no transform of a joint (no robot_state_publisher?)" in finding.message
    assert finding.fixes[0].text.startswith("check whether robot_state_publisher runs")
    # Only the description could prove that the publisher would send the frame of the scans.
    assert "it publishes only links of the description: look there for laser)" in (
        finding.fixes[0].text
    )
    assert not any("record /tf" in fix.text for fix in finding.fixes)
    made.moving("base_link", "wheel")
    assert "if so, record /tf" in found(made, "static-missing").fixes[0].text


DESCRIBED = """<robot name="r"><link name="base_link"/><link name="lidar"/><link name="lidar_top"/>
<joint name="mast" type="fixed"><parent link="base_link"/><child link="lidar"/></joint>
<joint name="spin" type="continuous"><parent link="lidar"/><child link="lidar_top"/></joint>
</robot>"""


@pytest.mark.parametrize("urdf", ["", DESCRIBED])
def test_a_recording_without_statics_is_told_so_and_no_second_publisher_is_advised(urdf):
    made = robot(laser=False, scans=False)
    made.moving("lidar", "lidar_top")
    made.hears("/points", "lidar_top", kind="sensor_msgs/PointCloud2")
    made.hears("/scan", "laser", kind="sensor_msgs/LaserScan")
    made.urdf = urdf
    told = made.judged().findings
    cures = [fix for one in told for fix in one.fixes if one.id in ("split-tree", "unknown-frame")]
    assert not any("static_transform_publisher" in fix.command for fix in cures)
    assert any("no statics were recorded" in fix.text for fix in cures)

    # Other static transforms were recorded, so this one was not published.
    made.static("base_link", "imu")
    cures = [fix for one in made.judged().findings for fix in one.fixes]
    assert any("static_transform_publisher" in fix.command for fix in cures)


def test_statics_that_come_late():
    made = robot(laser=False)
    made.static("base_link", "laser", at=3.0)
    finding = found(made, "static-late")
    # 30 scans at 10 Hz have earlier stamps; the last of them arrives after the static transform.
    assert finding.topics == ("/scan",)
    assert finding.facts["late"] == pytest.approx(seconds(3.0), abs=seconds(0.02))

    # A static transform that was sent before the recorder started is only received late.
    _, mount, number = made.records["base_link", "laser", True][0]
    made.records["base_link", "laser", True][0] = (seconds(START - 60.0), mount, number)
    assert "static-late" not in ids(made, notes=True)


def test_statics_that_are_offered_to_no_late_subscriber():
    made = robot()
    made.publishers[1] = Publisher("/tf_static", durability="volatile")
    assert found(made, "static-not-latched").topics == ("/tf_static",)
    made.kind = "ROS 1 bag"
    assert found(made, "static-not-latched").severity is Severity.ERROR
    for second in (1.0, 2.0, 3.0):
        made.static("base_link", "laser", at=second)
    assert found(made, "static-not-latched").severity is Severity.WARNING
    assert "waits for the next repetition" in found(made, "static-not-latched").consequence


def test_statics_in_more_messages_than_a_player_keeps_are_a_note():
    """Check static transforms in more than the ten messages that rosbag2 offers later."""
    made = robot()
    for number in range(9):
        made.static("base_link", f"camera_{number}", at=0.1)
    assert ids(made, notes=True) == []
    made.static("base_link", "imu", at=0.2)
    assert found(made, "latched-overwrite").frames == ("laser",)
    # An edit that combines all static transforms does not remove the single messages, so it is no
    # remedy.
    assert not any(fix.command for fix in found(made, "latched-overwrite").fixes)
    # ROS 1's player stores one message per publisher, and here each publisher has at most one.
    early = replace(robot_with_two_mounts().evidence(), kind="ROS 1 bag")
    (note,) = judge(early).findings
    assert (note.id, note.frames) == ("latched-overwrite", ("laser",))


def robot_with_two_mounts() -> Robot:
    made = robot()
    made.static("base_link", "imu", at=0.2)
    return made


def test_a_frame_that_a_localiser_publishes_is_looked_for_there():
    made = robot()
    made.hears("/goal", "map", kind="geometry_msgs/PoseStamped")
    assert "node that should publish the frame" in found(made, "unknown-frame").fixes[0].text


def test_odometry_that_comes_too_late_for_the_laser():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=5, latency=0.25)
    made.hears("/scan", "laser", hz=20)
    finding = found(made, "sensor-outruns-tf")
    assert (finding.topics, finding.edges) == (("/scan",), (("odom", "base_link"),))
    # The scan directly after a sample waits for the next sample (150 ms later) and its delay.
    assert finding.facts["worst"] == pytest.approx(seconds(0.15 + 0.25 - 0.015), abs=1)
    assert any("no rate is enough" in fix.text for fix in finding.fixes)


@pytest.mark.parametrize(("held", "told"), [(1, "38 % of the samples"), (17, "use a timeout")])
def test_a_lossy_recording_shows_no_timeout(held, told):
    made = robot(odometry=False, scans=False)
    for tick in range(400):
        # 140 of 374 samples: 14 in a row, and a pause.
        if tick % 40 < 14 or held > 1:
            made.sent("odom", "base_link", 0.02 * tick, drives(tick / 50), latency=0.01 * held)
    made.hears("/scan", "laser", hz=20)
    assert told in found(made, "sensor-outruns-tf").fixes[0].text


def test_the_longest_wait_is_that_of_all_messages_that_can_be_placed():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=5, latency=0.05, without=(0.3, 0.9))
    made.hears("/scan", "laser", hz=20)
    # The scan at 0.25 s arrives at 0.265 s, and the next transform at 1.05 s.
    assert found(made, "sensor-outruns-tf").facts["worst"] == pytest.approx(seconds(0.785), abs=1)


def test_a_rate_that_a_link_has_already_is_no_cure():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=10, latency=0.0)
    made.hears("/scan", "laser", hz=5, begin=0.01, latency=0.001)
    finding = found(made, "sensor-outruns-tf")
    assert not any("Hz" in fix.text for fix in finding.fixes)
    assert "arrives before the transforms" in finding.message
    slow = robot(odometry=False, scans=False)
    slow.moving("odom", "base_link", hz=1, latency=-0.02)
    slow.hears("/scan", "laser", hz=5, begin=0.01, latency=0.001)
    finding = found(slow, "sensor-outruns-tf")
    assert any("publish base_link in odom at" in fix.text for fix in finding.fixes)
    assert "20 ms before its stamp" in finding.evidence[0]


def test_a_healthy_laser_may_wait_a_little():
    made = robot()
    made.hears("/range", "laser", hz=100, kind="sensor_msgs/Range", latency=0.002)
    assert ids(made, notes=True) == []


def late_odometry() -> Robot:
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=5, latency=0.04, node="/wheels")
    return made


@pytest.mark.parametrize("kind", ["Imu", "MagneticField", "NavSatFix"])
def test_inputs_of_a_filter_alone_are_not_reported_as_outrunning_tf(kind):
    made = late_odometry()
    made.hears("/imu", "laser", hz=100, kind=f"sensor_msgs/{kind}")
    assert ids(made, notes=True) == []
    made.moving("map", "odom", hz=20, pose=stands, begin=4.0)
    # Samples of an IMU contain at least a direction.
    assert ids(made, notes=True) == (["late-start"] if kind != "NavSatFix" else [])
    made = late_odometry()
    made.hears("/imu", "laser", hz=100, kind=f"sensor_msgs/{kind}")
    made.hears("/scan", "laser")
    assert ids(made, notes=True) == ["sensor-outruns-tf"]


def test_relays_of_one_scan_that_wait_alike_are_one_finding():
    made = late_odometry()
    made.hears("/scan", "laser", latency=0.015)
    made.hears("/stable_scan", "laser", latency=0.018)
    (finding,) = made.judged().findings
    assert (finding.id, finding.topics) == ("sensor-outruns-tf", ("/scan", "/stable_scan"))
    assert finding.message == "/scan, /stable_scan arrive before the transforms they need"
    # Both topics have the same stamps, so the topic that arrives first waits longest.
    assert finding.facts["topic"] == "/scan"

    # A scan with other stamps waits longer, and has a finding of its own.
    made.hears("/rear_scan", "laser", hz=5, begin=0.01)
    alone = [one.topics for one in made.judged().findings if one.id == "sensor-outruns-tf"]
    assert alone == [("/scan", "/stable_scan"), ("/rear_scan",)]


def test_the_publisher_of_the_link_is_not_told_as_that_of_the_scan():
    made = late_odometry()
    made.hears("/scan", "laser")
    told = io.StringIO()
    Console(file=told, width=2000).print(finding_view.render(made.judged(), verbose=True))
    assert "base_link in odom is published by /wheels" in told.getvalue()


def test_messages_older_than_the_cache():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", end=20.0)
    made.hears("/cloud", "laser", kind="sensor_msgs/PointCloud2", end=5.0, latency=13.0)
    assert found(made, "cache-short").facts["needed"] == 14
    assert ids(made) == ["cache-short"]
    assert "cache-short" not in [
        one.id for one in made.judged(Settings(cache_time=seconds(30))).findings
    ]


def test_old_messages_that_nothing_places_need_no_larger_cache():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", end=20.0)
    made.hears("/nav", "wgs84", kind="nav_msgs/Odometry", end=5.0, latency=13.0)
    made.hears("/imu", "laser", kind="sensor_msgs/Imu", end=5.0, latency=13.0)
    assert "cache-short" not in [one.id for one in made.judged().findings]


def test_waits_of_one_period_of_fast_odometry_are_not_reported():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=30, latency=0.001)
    made.hears("/scan", "laser", hz=5, latency=0.001)
    assert ids(made, notes=True) == []
    slower = robot(odometry=False, scans=False)
    slower.moving("odom", "base_link", hz=12, latency=0.001)
    slower.hears("/scan", "laser", hz=5, latency=0.001)
    finding = found(slower, "sensor-outruns-tf")
    # At most one message waits at a time, so a longer queue is no remedy.
    assert not any("queue" in fix.text for fix in finding.fixes)


def test_the_advised_wait_leaves_a_stall_out():
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", hz=10, end=20.0, latency=0.08)
    made.hears("/scan", "laser", latency=0.001, end=20.0)
    rows = made.messages
    for number, (log, sender) in enumerate(rows):
        if seconds(START + 10.0) < log < seconds(START + 10.6):
            rows[number] = (seconds(START + 13.0), sender)
    cure = found(made, "sensor-outruns-tf").fixes[0].text
    assert "are enough for 95 % of the messages; the longest wait is" in cure
    assert int(cure.split("in the lookup: ")[1].split()[0]) < 200


def silent(made: Robot, begin: float, end: float, lost: bool) -> None:
    """Let nothing arrive for a time; data that is not lost arrives at the end of this time."""
    low, high = made.log(begin), made.log(end)
    made.messages = [(high if low < log < high else log, sender) for log, sender in made.messages]
    for topic, (kind, rows) in made.heard.items():
        late = [(stamp, high if low < log < high else log, frame) for stamp, log, frame in rows]
        kept = [row for row, (_, log, _) in zip(late, rows, strict=True) if not low < log < high]
        made.heard[topic] = (kind, kept if lost else late)


@pytest.mark.parametrize("lost", [False, True])
def test_a_network_that_is_gone_for_a_time_is_one_finding(lost):
    made = robot(scans=False)
    made.hears("/scan", "laser")
    silent(made, 3.0, 6.0, lost)
    finding = found(made, "outage")
    assert finding.message == "nothing arrived for 3.02 s on 2 of 2 streams"
    assert ("on 1 of 2 streams, data of that time is missing" in finding.evidence[0]) == lost
    assert finding.topics == ("/scan",)
    # The lidar continues, so not all streams stop.
    made = robot()
    made.hears("/points", "laser", kind="sensor_msgs/PointCloud2")
    made.hears("/image", "laser", kind="sensor_msgs/Image")
    kept = {topic: made.heard[topic] for topic in ("/scan", "/points", "/image")}
    silent(made, 3.0, 6.0, lost)
    made.heard.update(kept)
    assert "outage" not in ids(made)


def test_shorter_times_without_arrivals_are_counted_beside_an_outage():
    made = robot(scans=False)
    made.hears("/scan", "laser")
    for begin, end in ((0.5, 1.0), (3.0, 6.0), (6.5, 7.1)):
        silent(made, begin, end, lost=False)
    # The last odometry before 0.5 s arrives at 0.485 s, and before 6.5 s at 6.485 s.
    also = "on all 2 streams, nothing arrived 2 more times, for up to 615 ms (1.13 s in all)"
    assert found(made, "outage").evidence[0].endswith(also)


def test_a_stream_that_begins_in_an_outage_is_not_silent():
    made = robot(odometry=False, scans=False)
    for begin, end in ((0.0, 4.0), (14.0, 20.0)):
        made.moving("base_link", "arm", begin=begin, end=end)
        made.moving("arm", "hand", begin=begin, end=end)
    for begin, end in ((0.0, 5.9), (10.0, 20.0)):
        made.hears("/scan", "laser", begin=begin, end=end)
    made.moving("odom", "base_link", begin=8.0, end=20.0)
    # The arm is silent from 3.985 s to 14.005 s, and the lidar from 5.815 s to 10.015 s.
    finding = found(made, "outage")
    assert finding.message == ("nothing arrived for 10.02 s on 2 of 4 streams, and for 4.20 s on 3")
    assert finding.facts["begin"] == seconds(START) + seconds(3.985)


@pytest.mark.parametrize("ahead", [0.0, 80.0])
def test_each_outage_is_told_whatever_the_offset_of_the_clock(ahead):
    """Check two outages in which the lidar's and the odometry's data is lost."""
    made = Robot(log_from=START - ahead)
    made.static("base_link", "laser")
    for begin, end in ((0.0, 6.0), (9.0, 20.0), (26.0, 40.0)):
        made.moving("odom", "base_link", begin=begin, end=end)
        made.hears("/scan", "laser", begin=begin, end=end)
    finding = found(made, "outage")
    assert finding.message == (
        "nothing arrived for 6.02 s on 2 of 2 streams, the longest of 2 outages (9.04 s in all)"
    )
    assert finding.count == 2
    assert "on 2 of 2 streams, data of that time is missing (up to 6.10 s)" in finding.evidence[0]
    # Some data of the outage is lost, but less than half.
    held = robot(scans=False)
    held.hears("/scan", "laser", end=3.0)
    held.hears("/scan", "laser", begin=4.0)
    silent(held, 2.0, 6.0, lost=False)
    told = found(held, "outage").evidence[0]
    assert "on 1 of 2 streams, data of that time is missing (up to 1.10 s)" in told


def test_messages_as_late_as_their_transforms_are_placed():
    made = robot(odometry=False, scans=False)
    # The delay varies too much for a shift of the clock.
    for begin, end, late in ((0.0, 6.0, 12.0), (6.0, 8.0, 15.0)):
        made.moving("odom", "base_link", begin=begin, end=end, latency=late)
        made.hears("/scan", "laser", begin=begin, end=end, latency=late)
    assert "cache-short" not in ids(made, notes=True)
    late = robot(scans=False)
    late.hears("/scan", "laser", latency=12.0)
    assert found(late, "cache-short").severity is Severity.WARNING


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


def test_statics_on_tf_are_not_missing():
    # ROS 1 before tf2 sends mounts periodically on /tf.
    made = robot(laser=False, scans=False)
    made.moving("base_link", "base_laser", hz=10, pose=stands)
    made.hears("/scan", "laser")
    assert ids(made) == ["unknown-frame"]
    assert "base_laser" in found(made, "unknown-frame").fixes[0].text


def test_a_player_latches_one_message_for_each_publisher_that_is_known():
    made = robot(laser=False, scans=False)
    made.sent("base_link", "laser", 0.0, topic="/tf_static", node="/lidar")
    made.sent("base_link", "camera", 0.0, topic="/tf_static", node="/camera")
    assert ids(made, notes=True) == []
    made.sent("base_link", "imu", 0.1, topic="/tf_static", node="/camera")
    finding = found(made, "latched-overwrite")
    assert (finding.frames, finding.publishers) == (("camera",), ("/camera",))


@pytest.mark.parametrize("frame", ["map", "odom"])
def test_a_goal_in_a_world_frame_waits_for_no_transform_of_the_robot(frame):
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", latency=0.005)
    made.moving("map", "odom", 5.0, latency=0.2)
    made.hears("/goal", frame, kind="geometry_msgs/PoseStamped")
    assert ids(made, notes=True) == []


def test_a_mount_sent_on_tf_that_holds_up_a_sensor_belongs_on_tf_static():
    made = robot(laser=False)
    made.moving("base_link", "laser", 4.0, stands)
    cures = [fix.text for fix in found(made, "sensor-outruns-tf").fixes]
    assert any("laser in base_link" in cure and "/tf_static" in cure for cure in cures)


@pytest.mark.parametrize(
    ("kind", "told"),
    [("visualization_msgs/Marker", []), ("sensor_msgs/PointCloud2", ["sensor-outruns-tf"])],
)
def test_a_marker_may_come_before_its_transform_but_a_point_cloud_may_not(kind, told):
    made = robot(odometry=False, scans=False)
    made.moving("odom", "base_link", 5.0)
    made.hears("/drawn", "base_link", 20.0, kind, latency=0.001)
    assert ids(made) == told


def test_a_single_transform_on_a_topic_of_its_own_is_not_read_by_tf2():
    made = robot()
    made.sent("world", "", 1.0, topic="/pose")
    evidence = made.evidence()
    topics = tuple(
        replace(one, type="geometry_msgs/TransformStamped") if one.name == "/pose" else one
        for one in evidence.topics
    )
    (empty,) = [
        one for one in judge(replace(evidence, topics=topics)).findings if one.id == "empty-frame"
    ]
    assert empty.severity is Severity.NOTE


def test_odometry_that_stalls_and_comes_in_a_burst_is_a_note():
    made = robot()
    for tick in range(400):
        at = 0.02 * tick
        held = max(0.0, 5.5 - at) if at > 3.0 else 0.0
        made.hears("/odom", "odom", 50.0, "nav_msgs/Odometry", begin=at, end=at + 0.02,
                   latency=max(0.01, held))  # fmt: skip
    finding = found(made, "stall")
    assert (finding.severity, finding.topics, finding.count) == (Severity.NOTE, ("/odom",), 1)
    assert finding.facts["length"] == 2_490_000_000
    assert finding.facts["period"] == 20_000_000
    # A pause in the stamps is no stall: nothing was held up.
    paused = robot()
    paused.hears("/odom", "odom", 50.0, "nav_msgs/Odometry", end=3.0)
    paused.hears("/odom", "odom", 50.0, "nav_msgs/Odometry", begin=5.5)
    assert "stall" not in ids(paused, notes=True)


@pytest.mark.parametrize(("held", "told"), [(1.2, True), (0.8, False)])
def test_a_slow_stream_stalls_for_fewer_periods(held, told):
    made = robot(odometry=False)
    for tick in range(100):
        at = 0.2 * tick
        late = max(0.01, 10.0 + held - at) if at >= 10.2 else 0.01
        made.sent("odom", "base_link", at, (0.1 * at, 0.0, 0.0, *NO_TURN), latency=late)
    assert ("stall" in ids(made, notes=True)) is told


def test_a_player_that_pauses_is_no_outage():
    made = robot()
    made.hears("/points", "laser", 5.0, "sensor_msgs/PointCloud2")
    pause = seconds(3.0)
    later = made.log(4.0)
    made.messages = [(log + pause * (log > later), who) for log, who in made.messages]
    for topic, (kind, rows) in made.heard.items():
        moved = [(stamp, log + pause * (log > later), frame) for stamp, log, frame in rows]
        made.heard[topic] = (kind, moved)
    assert "outage" not in ids(made, notes=True)


@pytest.mark.parametrize(("shown", "told"), [(True, ["outage"]), (False, ["gap"])])
def test_a_recorder_that_stalls_again_and_again_is_an_outage(shown, told):
    """Check silences of 0.4 s, after which `/clock` arrives in a burst or at its usual period."""
    made = robot(start=100.0, log_from=START, odometry=False, scans=False)

    def held(at: float) -> float:
        return at + 1.0 - at % 1.0 if at > 1.0 and at % 1.0 > 0.6 else at

    for tick in range(1000):
        at = tick * 0.02
        if held(at) == at:
            made.sent("odom", "base_link", at, (0.1 * at, 0.0, 0.0, *NO_TURN))
            made.hears("/scan", "laser", 50.0, begin=at, end=at + 0.02)
        if held(at) == at or (shown and at % 1.0 > 0.8):
            made.clock.append((seconds(100.0 + at), made.log(held(at)) + tick))
    finding = found(made, told[0])
    assert [one for one in ids(made) if one in ("gap", "outage")] == told
    if shown:
        assert finding.count == 19
        assert "/clock" in finding.evidence[0]
        assert "recorder" in finding.fixes[0].text
