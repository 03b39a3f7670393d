"""Tests of `tftool doctor --mounts`: mounts that contradict the motion, and moved mounts."""

import json
import math

import numpy as np
import pytest

pytest.importorskip("rosbags", reason="writes the test files")

from rosbags.rosbag1 import Writer

from tests.frames.motions import product, quaternions, world
from tests.recordings.writers import ROS1, TF
from tftool import open_recording
from tftool.doctor.evidence import evidence_of
from tftool.doctor.judge import judge

SECOND = 10**9
IMU, ATTITUDE = "sensor_msgs/msg/Imu", "mount-is-attitude"
MADE = {"seconds": 50.0, "rates": (40.0, 20.0), "offset": 0.0, "noise": (0.003, 0.3)}


def kind(name, *values):
    return ROS1.types[name](*values)


def header(stamp, frame):
    time = kind("builtin_interfaces/msg/Time", stamp // SECOND, stamp % SECOND)
    return kind("std_msgs/msg/Header", 1, time, frame)


def pose(name, shift, turn):
    whole = kind("geometry_msgs/msg/Quaternion", *map(float, turn))
    part = "Vector3" if name == "Transform" else "Point"
    return kind(
        f"geometry_msgs/msg/{name}", kind(f"geometry_msgs/msg/{part}", *map(float, shift)), whole
    )


def odometry(stamp, shift, turn):
    zero = kind("geometry_msgs/msg/Vector3", 0.0, 0.0, 0.0)
    twist = kind("geometry_msgs/msg/Twist", zero, zero)
    none = np.zeros(36)
    return kind(
        "nav_msgs/msg/Odometry",
        header(stamp, "vo"),
        "camera",
        kind("geometry_msgs/msg/PoseWithCovariance", pose("Pose", shift, turn), none),
        kind("geometry_msgs/msg/TwistWithCovariance", twist, none),
    )


def transform(stamp, parent, child, shift, turn):
    name = "geometry_msgs/msg/TransformStamped"
    one = kind(name, header(stamp, parent), child, pose("Transform", shift, turn))
    return kind(TF, [one])


def record(file, seed=5, day=0, moves=0.0, turned=0.0, **options):
    """Record wheels on /tf, visual odometry on a topic, and the true mount on /tf_static.

    The camera is turned about z by `turned` degrees, and by `moves` in the middle of the recording.
    """
    made = world(seed, **{**MADE, **options})
    start = (1_750_000_000 + 86_400 * day) * SECOND - int(made.a.stamps[0])
    rotations = made.b.rotations.copy()
    angles = np.full(len(rotations), math.radians(turned))
    angles[len(angles) // 2 :] += math.radians(moves)
    rotations = product(rotations, quaternions(angles[:, None] * [0.0, 0.0, 1.0]))
    first = int(made.a.stamps[0]) + start
    mount = made.mount.translation, made.mount.rotation
    rows = [(first, "/tf_static", transform(first, "base_link", "camera", *mount))]
    rows += [
        (at + start, "/tf", transform(at + start, "odom", "base_link", shift, turn))
        for at, shift, turn in zip(
            made.a.stamps.tolist(), made.a.translations, made.a.rotations, strict=True
        )
    ]
    rows += [
        (at + start, "/vo", odometry(at + start, shift, turn))
        for at, shift, turn in zip(
            made.b.stamps.tolist(), made.b.translations, rotations, strict=True
        )
    ]
    with Writer(file) as writer:
        topics = {}
        for at, topic, message in sorted(rows, key=lambda row: row[0]):
            name = message.__msgtype__
            if topic not in topics:
                topics[topic] = writer.add_connection(topic, name, typestore=ROS1)
            writer.write(topics[topic], at, ROS1.serialize_ros1(message, name))
    return file, made


def mounts(tftool, *words):
    result = tftool("doctor", *words, "--mounts", "--select", "values", "--json")
    found = json.loads(result.out)
    return result, found if isinstance(found, list) else [found]


def ids(found):
    return [one["id"] for one in found["findings"] if one["id"].startswith("mount-c")]


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return record(tmp_path_factory.mktemp("mounts") / "run.bag")


@pytest.mark.parametrize("degrees", [0.0, 1.0, 2.0, 5.0])
def test_a_mount_turned_by_an_edit_contradicts_the_motion(tftool, run, tmp_path, degrees):
    file, made = run
    half = math.radians(degrees) / 2.0
    turn = product(
        np.array([made.mount.rotation]), np.array([[0, 0, math.sin(half), math.cos(half)]])
    )
    words = ",".join(str(float(one)) for one in (*made.mount.translation, *turn[0]))
    edited = tmp_path / "edited.bag"
    assert tftool("edit", file, "--set", f"base_link:camera={words}", "-o", edited).status == 0
    result, (found,) = mounts(tftool, edited)

    assert ids(found) == (["mount-contradicts-motion"] if degrees else []), result.out
    assert result.status == (1 if degrees else 0)
    if degrees:
        assert f"yaw differs by -{degrees:.0f}" in result.out or degrees < 2.0


def test_without_the_option_nothing_is_measured(tftool, run):
    result = tftool("doctor", run[0], "--verbose")
    assert "mount-changed" in result.out
    assert "only with --mounts" in result.out


def test_a_notice_names_the_mounts_that_were_compared(tftool, run):
    assert "1 mount was compared with the motion: camera in base_link." in (
        tftool("doctor", run[0], "--mounts").err
    )
    assert "no mount was compared" in tftool("doctor", "static", "--mounts").err
    assert "mount" not in tftool("doctor", "static").err


def test_a_mount_that_moves_in_the_recording_is_found_at_its_moment(tftool, tmp_path):
    file, _ = record(tmp_path / "moved.bag", moves=3.0)
    result, (found,) = mounts(tftool, file)

    assert result.status == 1
    changed = [one for one in found["findings"] if one["id"] == "mount-changed"]
    assert len(changed) == 1
    # A window is 25 s long, and the camera moves at the beginning of the second window.
    assert changed[0]["since"] == pytest.approx(1_750_000_025 * SECOND, abs=SECOND), changed


def test_of_several_recordings_the_day_the_mount_moved_is_named(tftool, tmp_path):
    days = [record(tmp_path / f"day{day}.bag", day=day, turned=3.0 if day > 1 else 0.0)[0]
            for day in range(4)]  # fmt: skip
    result, found = mounts(tftool, *days)

    assert ["mount-changed" in ids(one) for one in found] == [False, False, True, False]
    assert "17 June 2025" in result.out


def test_a_topic_is_a_motion_whose_mount_is_compared_with_tf(tftool, run):
    file, _ = run
    result = tftool(
        "calibrate", file, "--moving", "odom:base_link", "--moving", "/vo", "--check", "--json"
    )

    assert result.status == 0, result.err
    found = json.loads(result.out)
    assert (found["moving"], found["fixed"]) == (["base_link", "camera"], ["odom", "vo"])
    assert found["check"]["outside"] == []
    assert found["check"]["differs"]["mm"] < 3.0


def test_rows_are_no_place_for_mounts(tftool, run, tmp_path):
    result = tftool("doctor", run[0], "--mounts", "-o", tmp_path / "rows.csv")
    assert result.status == 2
    assert "--mounts cannot be combined with -o" in result.err


def imu(stamp, turn):
    zero, none = kind("geometry_msgs/msg/Vector3", 0.0, 0.0, 0.0), np.zeros(9)
    whole = kind("geometry_msgs/msg/Quaternion", *map(float, turn))
    return kind(IMU, header(stamp, "imu_link"), whole, none, zero, none, zero, none)


@pytest.mark.parametrize(
    ("parent", "swing", "off", "shift", "told"),
    [
        ("plane", 0.1, 0.0, 0.0, True),
        ("base_link", 0.1, 0.0, 0.0, True),
        ("odom", 0.1, 0.0, 0.0, False),  # a display of the sensor's orientation
        ("plane", 0.01, 0.0, 0.0, False),  # it turns by less than 1°
        ("plane", 0.1, 0.005, 0.0, False),
        ("plane", 0.1, 0.0, 0.01, False),
    ],
)
def test_a_mount_that_equals_the_orientation_of_its_imu_is_no_mount(
    tmp_path, parent, swing, off, shift, told
):
    path = tmp_path / "run.bag"
    with Writer(path) as writer:
        topics = {
            name: writer.add_connection(name, of, typestore=ROS1)
            for name, of in (("/tf", TF), ("/tf_static", TF), ("/imu", IMU))
        }
        start, level = 1_750_000_000 * SECOND, (0.0, 0.0, 0.0, 1.0)
        for tick in range(200):
            at = start + tick * SECOND // 20
            half = 0.5 * swing * math.sin(0.1 * tick)
            turn = (0.0, math.sin(half), 0.0, math.cos(half))
            mount = (0.0, math.sin(half + off), 0.0, math.cos(half + off))
            rows = [
                ("/imu", imu(at, turn)),
                ("/tf", transform(at, "odom", "base_link", (0.01 * tick, 0.0, 0.0), level)),
                ("/tf", transform(at, parent, "imu_link", (shift * (tick % 2), 0.0, 0.0), mount)),
            ]
            if not tick:
                rows += [
                    ("/tf_static", transform(at, "base_link", "plane", (0.0, 0.0, 0.0), level))
                ]
            for topic, message in rows:
                data = ROS1.serialize_ros1(message, topics[topic].msgtype)
                writer.write(topics[topic], at + SECOND // 200, data)
    with open_recording(path) as recording:
        found = [one for one in judge(evidence_of(recording)).findings if one.id == ATTITUDE]
    assert len(found) == told
    if told:
        assert found[0].message == (
            f"imu_link in {parent} is the orientation that /imu measures, and no mount"
        )
        assert found[0].evidence[0].startswith("100 % of 200 samples equal the orientation")
