"""Synthetic recordings with known faults: healthy ones, one or two faults, reported cases.

Each recording is made by a function that changes a robot: one that navigates, or an empty one. Its
row lists the findings that must occur, their names, and the permitted consequences. Each recording
has its own random jitter.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from tests.doctor.robots import MOUNT, NO_TURN, START, Pose, Robot, drives, stands
from tftool.base.stamps import seconds
from tftool.recordings.contract import Publisher

IMAGE, IMU, CLOUD = "sensor_msgs/Image", "sensor_msgs/Imu", "sensor_msgs/PointCloud2"
OPTICAL: Pose = (0.0, 0.0, 0.0, -0.5, 0.5, -0.5, 0.5)
URDF = """<robot name="r"><link name="base_link"/><link name="base_scan"/><link name="caster_link"/>
<joint name="scan" type="fixed"><parent link="base_link"/><child link="base_scan"/>
<origin xyz="0.1 0 0.2"/></joint><joint name="caster" type="continuous">
<parent link="base_link"/><child link="caster_link"/></joint></robot>"""

Build = Callable[[Robot], object]


@dataclass(frozen=True)
class Case:
    """Recording, and the ids that must be found, with names that their evidence must contain."""

    name: str
    build: Build
    expect: tuple[str, ...] = ()
    where: tuple[str, ...] = ()
    allow: tuple[str, ...] = ()
    empty: bool = False


def nav(
    made: Robot,
    *,
    without: Iterable[str] = (),
    scan: str = "base_scan",
    image: str = "camera_optical_frame",
    length: float = 8.0,
) -> None:
    """Add the data of a robot that navigates, without some frames."""
    missing = set(without)
    edges = (
        ("map", "odom", 20.0),
        ("odom", "base_footprint", 50.0),
        ("base_link", "wheel_left_link", 30.0),
        ("base_link", "wheel_right_link", 30.0),
    )
    for parent, child, hz in edges:
        if child not in missing:
            pose = {"odom": slow, "base_footprint": drives}.get(child, spins)
            offset = 1.0 if child == "odom" else 0.0
            made.moving(parent, child, hz, pose, end=length, offset=offset, latency=0.006)
    statics = {
        "base_link": ("base_footprint", (0.0, 0.0, 0.1, *NO_TURN)),
        "base_scan": ("base_link", MOUNT),
        "imu_link": ("base_link", (0.0, 0.1, 0.1, *NO_TURN)),
        "camera_link": ("base_link", (0.2, 0.0, 0.3, *NO_TURN)),
        "camera_optical_frame": ("camera_link", OPTICAL),
    }
    made_at = len(made.messages)
    for child, (parent, pose) in statics.items():
        if child not in missing:
            made.static(parent, child, pose, at=-0.05)
    # All static transforms are in one message, as robot_state_publisher sends them.
    for (_, _, static), rows in made.records.items():
        if static:
            rows[:] = [(s, p, made_at if m >= made_at else m) for s, p, m in rows]
    if scan:
        made.hears("/scan", scan, 10.0, end=length)
    made.hears("/imu", "imu_link", 50.0, IMU, end=length, latency=0.002)
    if image:
        made.hears("/image", image, 15.0, IMAGE, end=length, latency=0.025)


def slow(t: float) -> Pose:
    return (0.01 * t, 0.02, 0.0, *NO_TURN)


def spins(t: float) -> Pose:
    return (0.0, 0.2, 0.0, 0.0, math.sin(2.5 * t), 0.0, math.cos(2.5 * t))


def away(t: float) -> Pose:
    return (0.5 * t + 1.0, 0.4, 0.0, *NO_TURN)


# Healthy recordings that look suspicious at first


def arm_at_rest(made: Robot) -> None:
    for parent, child in (("base", "shoulder"), ("shoulder", "elbow"), ("elbow", "wrist")):
        made.moving(parent, child, 100.0, stands)
    made.static("wrist", "tool")


def simulated(made: Robot) -> None:
    made.start, made.log_from = 12.0, START
    nav(made)
    made.clock = [(seconds(12.0 + 0.1 * n), seconds(START + 0.1 * n)) for n in range(95)]


def body_rooted(made: Robot) -> None:
    made.moving("body", "odom")
    made.moving("body", "vision", 20.0)
    made.static("body", "lidar")
    made.hears("/cloud", "lidar", 10.0, CLOUD)


def two_robots(made: Robot) -> None:
    for name in ("r1", "r2"):
        made.moving(f"{name}/odom", f"{name}/base_link")
        made.static(f"{name}/base_link", f"{name}/laser")
        made.hears(f"/{name}/scan", f"{name}/laser")


def slow_localiser(made: Robot) -> None:
    nav(made, without=("odom",))
    made.moving("map", "odom", 2.0, slow, offset=1.0)


def picked_box(made: Robot) -> None:
    nav(made)
    made.moving("map", "box", 20.0, stands, end=4.0)
    made.moving("wheel_left_link", "box", 20.0, spins, begin=4.0)


def families(made: Robot) -> None:
    nav(made)
    for name in ("camera1", "camera2", "camera3", "left_arm", "right_arm", "finger_l", "finger_r"):
        made.static("base_link", name, at=-0.05)


def relocalised(made: Robot) -> None:
    nav(made, without=("odom",))
    made.moving("map", "odom", 20.0, lambda t: (3.0 * (t > 4.0), 0, 0, *NO_TURN), offset=1.0)


def repeated_statics(made: Robot) -> None:
    nav(made)
    for tick in range(7):
        made.static("base_link", "base_scan", MOUNT, at=1.0 + tick)


def drone(made: Robot) -> None:
    made.moving("world", "drone", 30.0, lambda t: (15 * t, math.sin(t), 20.0, *NO_TURN))
    made.static("drone", "lidar")
    made.hears("/cloud", "lidar", 10.0, CLOUD)


def torn(made: Robot) -> None:
    nav(made)
    made.damage = ("the last chunk is torn",)


# Recordings with one fault


def conflict(made: Robot, *names: str) -> None:
    nav(made, without=("base_footprint",))
    first, second = names or ("", "")
    made.moving("odom", "base_footprint", node=first)
    made.moving("odom", "base_footprint", 30.0, away, node=second, latency=0.009)


def twice(made: Robot) -> None:
    made.kind = "ROS 1 bag"
    nav(made, without=("wheel_left_link",))
    for tick in range(240):
        for latency in (0.004, 0.006):
            made.sent("base_link", "wheel_left_link", tick / 30, spins(tick / 30), latency=latency)


def mixture(made: Robot) -> None:
    made.start, made.log_from = 136.0, START
    nav(made, without=("wheel_left_link", "wheel_right_link"))
    made.clock = [(seconds(136.0 + 0.1 * n), seconds(START + 0.1 * n)) for n in range(95)]
    made.start = START
    made.moving("base_link", "wheel_left_link", 30.0, spins)


def looped(made: Robot) -> None:
    nav(made, without=("odom",))
    made.log_from = START + 8.0
    nav(made, without=("odom",))


def volatile(made: Robot) -> None:
    nav(made)
    place = next(n for n, one in enumerate(made.publishers) if one.topic == "/tf_static")
    made.publishers[place] = Publisher("/tf_static", durability="volatile")


def spoiled(made: Robot, *rotation: float, where: float = 0.0) -> None:
    nav(made)
    for tick in range(240):
        bad = 100 <= tick < 130
        pose = (where if bad else 0.1, 0.0, 0.0, *(rotation if bad else NO_TURN))
        made.sent("base_link", "arm_link", tick / 30, pose)


def frozen(made: Robot, stamp: int) -> None:
    nav(made)
    for tick in range(160):
        made.sent("base_link", "arm_link", tick * 0.05, spins(tick * 0.05), stamp=stamp)


def replayed(made: Robot) -> None:
    nav(made)
    made.moving("base_link", "arm_link", 20.0, spins)
    for tick in range(5):
        made.sent("base_link", "arm_link", 7.0, spins(tick), stamp=seconds(START - 30.0 + tick))


def delayed(made: Robot) -> None:
    nav(made, without=("base_footprint",))
    made.moving("odom", "base_footprint", 5.0, latency=0.25)


def wanders(made: Robot) -> None:
    nav(made)
    for tick in range(8):
        made.static("base_link", "gripper", (0.1 * tick, 0.0, 0.0, *NO_TURN), at=float(tick))


def jumps(made: Robot) -> None:
    nav(made, without=("base_footprint",))
    made.moving("odom", "base_footprint", pose=lambda t: (0.5 * t + 2.5 * (t > 5), 0, 0, *NO_TURN))


def out_of_line(made: Robot) -> None:
    nav(made, without=("base_footprint",))
    made.moving("map", "base_footprint")


def odometry(made: Robot, offset: float) -> None:
    nav(made, without=("base_footprint",))
    made.noise = None
    made.moving("odom", "base_footprint")
    told = Robot()
    told.moving("odom", "base_footprint", pose=lambda t: (0.5 * t, offset, 0, *NO_TURN),
                topic="/odom")  # fmt: skip
    made.odometry = told


def described(made: Robot, *joints: str) -> None:
    nav(made)
    made.urdf, made.joints = URDF, frozenset(joints)


def overtaken(made: Robot) -> None:
    nav(made)
    for tick in range(160):
        late = 0.2 if tick % 5 == 0 else 0.005
        made.sent("base_link", "arm_link", tick * 0.05, spins(tick * 0.05), latency=late)


def also(*builds: Build) -> Build:
    """Return a function that applies all functions to the same robot."""

    def build(made: Robot) -> None:
        for one in builds:
            one(made)

    return build


def gap(made: Robot) -> None:
    nav(made, without=("base_footprint",))
    made.moving("odom", "base_footprint", without=(3.0, 4.2))


def stopped(made: Robot) -> None:
    nav(made, without=("base_footprint",))
    made.moving("odom", "base_footprint", end=5.0)


def late_mount(made: Robot) -> None:
    nav(made, without=("base_scan",))
    made.static("base_link", "base_scan", at=3.0)


def tf_on(topic: str) -> Build:
    def build(made: Robot) -> None:
        made.moving("odom", "base_link", topic=topic)
        made.static("base_link", "laser")
        made.hears("/scan", "laser")

    return build


def cloud_after(latency: float) -> Build:
    def build(made: Robot) -> None:
        nav(made, length=20.0)
        made.hears("/detections", "camera_link", 5.0, CLOUD, end=6.0, latency=latency)

    return build


HEALTHY = (
    Case("nav stack", nav),
    Case("arm at rest", arm_at_rest, empty=True),
    Case("simulated time", simulated),
    Case("body-rooted tree", body_rooted, empty=True),
    Case("two prefixed robots", two_robots, empty=True),
    Case("slow localiser", slow_localiser),
    Case("picked-up box", picked_box),
    Case("numbered and mirrored names", families),
    Case("relocalisation by 3 m", relocalised),
    Case("statics repeated", repeated_statics),
    Case("drone at 15 m/s", drone, empty=True),
    Case("torn file", torn, ("truncated-recording",)),
)

FAULTS = (
    Case("visual odometry beside it", also(nav, lambda r: r.moving("camera_odom", "base_footprint",
         20.0, away)), ("two-parents",), ("base_footprint", "camera_odom")),
    Case("named conflict", lambda r: conflict(r, "/gazebo", "/ekf"), ("publisher-conflict",),
         ("base_footprint", "/gazebo", "/ekf")),
    Case("unnamed conflict", conflict, ("publisher-conflict",), ("base_footprint",)),
    Case("two state publishers", twice, ("repeated-stamp",), ("wheel_left_link",)),
    Case("static and dynamic", also(nav, lambda r: r.static("map", "base_footprint", at=3.0)),
         ("static-and-dynamic",), ("base_footprint",), ("split-tree", "rep105-shape")),
    Case("odom above body above odom", also(lambda r: r.moving("odom", "body"),
         lambda r: r.moving("body", "odom")), ("loop",), ("odom", "body"), empty=True),
    Case("mount never published", lambda r: nav(r, without=("camera_link",)), ("split-tree",),
         ("camera_link", "/image")),
    Case("driver's default frame", lambda r: nav(r, scan="laser_frame"), ("unknown-frame",),
         ("laser_frame", "/scan")),
    Case("slash in a header", lambda r: nav(r, scan="/base_scan"), ("slash-twins",), ("/scan",)),
    Case("transform without a name", also(nav, lambda r: r.sent("base_link", "", 2.0)),
         ("empty-frame",)),
    Case("message without a name", lambda r: nav(r, image=""), ()),
    Case("picture without a name", also(nav, lambda r: r.hears("/tags", "", 5.0, IMAGE)),
         ("empty-frame",), ("/tags",)),
    Case("its own parent", also(nav, lambda r: r.sent("odom", "odom", 2.0)), ("self-transform",),
         ("odom",)),
    Case("second part of a split bag", lambda r: nav(r, without=("base_link", "base_scan",
         "imu_link", "camera_link", "camera_optical_frame")), ("static-missing",), ("base_scan",)),
    Case("statics offered volatile", volatile, ("static-not-latched",), ("/tf_static",)),
    Case("wheels by the wall clock", mixture, ("clock-mixture",), ("wheel_left_link",)),
    Case("looped", looped, ("time-jump-back",)),
    Case("odometry dies", stopped, ("edge-stopped",), ("base_footprint",)),
    Case("numbers that are none", lambda r: spoiled(r, *NO_TURN, where=math.nan),
         ("nan-transform",), ("arm_link",)),
    Case("rotation never filled", lambda r: spoiled(r, 0.0, 0.0, 0.0, 0.0), ("bad-quaternion",),
         ("arm_link",), ("gap",)),
    Case("rotation typed by hand", lambda r: spoiled(r, 0.0, 0.0, 0.72, 0.72),
         ("bad-quaternion",), ("arm_link",), ("teleport",)),
    Case("case", lambda r: nav(r, scan="Base_Scan"), ("case-twins",), ("Base_Scan", "base_scan")),
    Case("typo", lambda r: nav(r, scan="base_sacn"), ("typo-twins",), ("base_sacn",)),
    Case("half of the names prefixed", also(nav, lambda r: r.moving("robot1/odom",
         "robot1/base_footprint")), ("namespace-twins",), ("robot1/odom",)),
    Case("remapped /tf", tf_on("/robot1/tf"), ("namespaced-topic",), ("/robot1/tf",), empty=True),
    Case("dated ahead", also(lambda r: nav(r, without=("base_footprint",)),
         lambda r: r.moving("odom", "base_footprint", offset=0.4)), ("future-stamp",),
         ("base_footprint",)),
    Case("dated back", also(lambda r: nav(r, without=("odom",)),
         lambda r: r.moving("map", "odom", 10.0, slow, latency=0.8)), ("stale-stamp",), ("odom",)),
    Case("a stamp of another year", also(nav, lambda r: r.sent("odom", "base_footprint", 4.0,
         stamp=seconds(START) + seconds(63_072_000))), ("wild-stamp",), ("base_footprint",)),
    Case("two clocks", also(nav, lambda r: r.hears("/lidar", "base_scan", 20.0, CLOUD,
         latency=-0.08)), ("clock-offset",), ("/lidar",)),
    Case("stamp of zero", lambda r: frozen(r, 0), ("zero-stamp",), ("arm_link",)),
    Case("stamp set before the loop", lambda r: frozen(r, seconds(START + 1)), ("frozen-stamp",),
         ("arm_link",)),
    Case("old samples", replayed, ("old-data",), ("arm_link",)),
    Case("hole", gap, ("gap",), ("base_footprint",)),
    Case("mount sent once", also(nav, lambda r: r.sent("base_link", "gps_link", 0.5)),
         ("single-sample",), ("gps_link",)),
    Case("odometry too slow", delayed, ("sensor-outruns-tf",), ("base_footprint", "/scan")),
    Case("slow detector", cloud_after(13.0), ("cache-short",), ("/detections",)),
    Case("late mount", late_mount, ("static-late",), ("base_scan", "/scan")),
    Case("mount changed", also(nav, lambda r: r.static("base_link", "base_scan",
         (0.3, 0.0, 0.2, *NO_TURN), at=4.0)), ("static-changed",), ("base_scan",)),
    Case("mover on /tf_static", wanders, ("dynamic-on-static",), ("gripper",)),
    Case("odometry jumps", jumps, ("teleport",), ("base_footprint",)),
    Case("constant on /tf", also(lambda r: nav(r, length=64.0, scan="", image=""),
         lambda r: r.moving("base_link", "gps_link", 10.0, stands, end=64.0)),
         ("static-on-tf",), ("gps_link",)),
    Case("statics in many messages", also(nav, lambda r: [r.static("base_link", f"gps_{one}")
         for one in "abcdefghij"]), ("latched-overwrite",), ("base_scan",)),
    Case("base below map", out_of_line, ("rep105-shape",), ("base_footprint",)),
    Case("optical frame without its axes", also(lambda r: nav(r, without=("camera_optical_frame",)),
         lambda r: r.static("camera_link", "camera_optical_frame", (0, 0, 0, *NO_TURN), at=-0.05)),
         ("optical-convention",), ("camera_optical_frame",)),
    Case("picture in a body frame", lambda r: nav(r, image="camera_link"),
         ("image-not-optical",), ("/image",)),
    Case("odometry of another mind", lambda r: odometry(r, 0.5), ("odometry-tf-mismatch",),
         ("/odom", "base_footprint")),
    Case("caster without a state", lambda r: described(r, "left", "right"),
         ("joint-without-state",), ("caster_link",)),
    Case("out of order", overtaken, ("out-of-order",), ("arm_link",)),
)  # fmt: skip

TWO = (
    Case("unknown frame, hole", lambda r: (gap(r), r.hears("/gps", "gps", 5.0, IMU)),
         ("unknown-frame", "gap"), ("gps", "base_footprint")),
    Case("two clocks, conflict", lambda r: (conflict(r), r.hears("/lidar", "base_scan", 20.0,
         CLOUD, latency=-0.08)), ("clock-offset", "publisher-conflict"), ("/lidar",)),
    Case("slash, rotation", lambda r: (spoiled(r, 0.0, 0.0, 0.72, 0.72), r.hears("/cloud",
         "/base_scan", 5.0, CLOUD)), ("slash-twins", "bad-quaternion"), ("arm_link",),
         ("teleport",)),
    Case("split, jump", lambda r: (jumps(r), r.static("mast", "radar", at=-0.05)),
         ("split-tree", "teleport"), ("mast", "base_footprint")),
    Case("late mount, dead odometry", lambda r: (stopped(r), r.static("base_link", "radar",
         at=3.0), r.hears("/radar", "radar", 10.0, CLOUD, end=4.5)),
         ("static-late", "edge-stopped"), ("radar", "base_footprint")),
    Case("two parents, unknown frame", lambda r: (nav(r, scan="laser_frame"), r.moving("vio",
         "base_footprint", 20.0, away)), ("two-parents", "unknown-frame"), ("laser_frame", "vio")),
    Case("loop, case", lambda r: (r.moving("odom", "body"), r.moving("body", "odom"),
         r.static("body", "lidar"), r.hears("/cloud", "Lidar", 10.0, CLOUD)),
         ("loop", "case-twins"), ("Lidar",), empty=True),
)  # fmt: skip

REENACTED = (
    Case("spot_ros2#374", lambda r: (r.moving("odom", "body"), r.moving("body", "vision"),
         r.moving("body", "odom", 20.0)), ("loop",), ("odom", "body"), empty=True),
    Case("andino_gz#43", lambda r: nav(r, scan="andino/base_link/sensor_ray_front"),
         ("unknown-frame",), ("andino/base_link/sensor_ray_front",)),
    Case("FAST_LIO_SLAM#15", lambda r: (r.moving("camera_init", "body", 10.0),
         r.hears("/cloud", "/camera_init", 10.0, CLOUD)), ("slash-twins",), ("/cloud",),
         empty=True),
    Case("create3_sim#203", mixture, ("clock-mixture",), ("wheel_left_link",)),
    Case("turtlebot4_robot#8", lambda r: (nav(r, scan=""), r.hears("/scan", "base_scan", 10.0,
         latency=-0.4)), ("clock-offset",), ("/scan",)),
    Case("rtabmap_ros#153", lambda r: (nav(r), r.static("base_link", "kinect",
         (0, 0, 0, 0.0, 0.1, 0.0, 0.985), at=-0.05)), ("bad-quaternion",), ("kinect",)),
    Case("apriltag_ros#57", lambda r: (nav(r), r.hears("/usb_cam", "", 10.0, IMAGE),
         r.sent("", "tag_1", 2.0)), ("empty-frame",), ("/usb_cam",)),
    Case("geometry2#181", lambda r: (nav(r), *(r.sent("base_link", child, 0.1, node="/play",
         topic="/tf_static") for child in ("first", "second"))), ("latched-overwrite",)),
    Case("LIO-SAM#519", lambda r: (nav(r), r.moving("map", "base_scan", 10.0)),
         ("static-and-dynamic",), ("base_scan",), ("split-tree",)),
    Case("rtabmap_ros#645", lambda r: conflict(r, "/play", "/rtabmap"), ("publisher-conflict",),
         ("/play",)),
    Case("zed-ros-wrapper#447", lambda r: (nav(r), r.moving("map", "camera_mount", 15.0),
         r.moving("base_link", "camera_mount", 15.0, spins)), ("two-parents",), ("camera_mount",)),
)  # fmt: skip

CASES = (*HEALTHY, *FAULTS, *TWO, *REENACTED)


def made_by(case: Case, salt: int) -> Robot:
    """Return the recording of a case, with the jitter of a random seed."""
    made = Robot(noise=np.random.default_rng([salt, CASES.index(case)]))
    case.build(made)
    return made
