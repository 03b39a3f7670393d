"""Writers of equal content to every container, by other libraries than tftool."""

import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import yaml
from mcap.writer import CompressionType, IndexType
from mcap.writer import Writer as McapWriter
from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag1 import Writer as Rosbag1Writer
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as Rosbag2Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

ROS2 = get_typestore(Stores.ROS2_HUMBLE)
ROS1 = get_typestore(Stores.ROS1_NOETIC)
ROS1.register(
    get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage")
)
TF = "tf2_msgs/msg/TFMessage"
SCAN = "sensor_msgs/msg/LaserScan"
CLOCK = "rosgraph_msgs/msg/Clock"
JOINTS = "sensor_msgs/msg/JointState"
TEXT = "std_msgs/msg/String"
SECOND = 10**9


@dataclass(frozen=True)
class Sent:
    """One message: transforms as (stamp, parent, child, seven numbers), or another message."""

    log_time: int
    topic: str
    transforms: tuple = ()
    scan: tuple | None = None  # stamp and frame
    clock: int | None = None
    node: str = "/robot"
    joints: tuple | None = None  # stamp, names and positions
    text: str | None = None

    @property
    def type(self):
        if self.joints is not None:
            return JOINTS
        if self.text is not None:
            return TEXT
        return TF if self.scan is self.clock is None else SCAN if self.clock is None else CLOCK


def numbers(seed: int) -> tuple:
    """Return a random pose; its quaternion has length one and either sign."""
    draw = np.random.default_rng(seed)
    turn = draw.normal(size=4)
    return (*draw.normal(size=3).tolist(), *(turn / np.linalg.norm(turn)).tolist())


def content(count: int = 60) -> list[Sent]:
    """Return a drive: static frames, one to three frames per message, scans."""
    start = 1_750_000_000 * SECOND
    mounts = ((0, "base_link", "laser", numbers(1)), (0, "base_link", "camera", numbers(2)))
    sent = [Sent(start, "/tf_static", mounts, node="/state_publisher")]
    for tick in range(count):
        stamp = start + tick * SECOND // 50 + 7
        odom = (stamp, "odom", "base_link", numbers(100 + tick))
        arm = (stamp - 1000, "base_link", "arm", numbers(500 + tick))
        late = (stamp, "map", "odom", numbers(900 + tick))
        frames = (odom, arm, late)[: 1 + tick % 3] if tick % 5 else (arm, odom)
        sent.append(Sent(stamp + 2_000_000, "/tf", frames))
        if tick % 4 == 0:
            sent.append(Sent(stamp + 3_000_000, "/scan", scan=(stamp + 11, "laser"), node="/lidar"))
        if tick % 10 == 0:
            sent.append(Sent(stamp + 3_500_000, "/clock", clock=stamp))
    return sent


def payload(sent: Sent, store=ROS2) -> bytes:
    """Return a message's bytes, written by rosbags."""
    types = store.types

    def time(stamp: int):
        return types["builtin_interfaces/msg/Time"](sec=stamp // SECOND, nanosec=stamp % SECOND)

    def header(stamp: int, frame: str):
        seq = {"seq": 5} if store is ROS1 else {}
        return types["std_msgs/msg/Header"](stamp=time(stamp), frame_id=frame, **seq)

    if sent.joints is not None:
        stamp, names, positions = sent.joints
        message = types[JOINTS](
            header=header(stamp, ""),
            name=list(names),
            position=np.array(positions, dtype=np.float64),
            velocity=np.zeros(0),
            effort=np.zeros(0),
        )
    elif sent.text is not None:
        message = types[TEXT](data=sent.text)
    elif sent.clock is not None:
        message = types[CLOCK](clock=time(sent.clock))
    elif sent.scan is not None:
        stamp, frame = sent.scan
        message = types[SCAN](
            header=header(stamp, frame),
            **dict.fromkeys(
                (
                    "angle_min",
                    "angle_max",
                    "angle_increment",
                    "time_increment",
                    "scan_time",
                    "range_min",
                    "range_max",
                ),
                0.5,
            ),
            ranges=np.ones(500, dtype=np.float32),
            intensities=np.zeros(0, dtype=np.float32),
        )
    else:
        message = types[TF](
            transforms=[
                types["geometry_msgs/msg/TransformStamped"](
                    header=header(stamp, parent),
                    child_frame_id=child,
                    transform=types["geometry_msgs/msg/Transform"](
                        translation=types["geometry_msgs/msg/Vector3"](*seven[:3]),
                        rotation=types["geometry_msgs/msg/Quaternion"](*seven[3:]),
                    ),
                )
                for stamp, parent, child, seven in sent.transforms
            ]
        )
    if store is ROS1:
        return bytes(store.serialize_ros1(message, sent.type))
    return bytes(store.serialize_cdr(message, sent.type))


def latched(topic: str) -> list[Qos]:
    """Return the QoS profile that a publisher of static transforms offers."""
    durability = QosDurability.TRANSIENT_LOCAL if "static" in topic else QosDurability.VOLATILE
    never = QosTime(2**31 - 1, 0)
    return [
        Qos(
            QosHistory.KEEP_LAST,
            1,
            QosReliability.RELIABLE,
            durability,
            never,
            never,
            QosLiveliness.AUTOMATIC,
            never,
            False,
        )
    ]


def write_mcap(path: Path, sent: Sequence[Sent], chunk_size: int = 4096, **options) -> Path:
    """Write an MCAP file with the format's own writer."""
    stream = io.BytesIO()
    writer = McapWriter(stream, chunk_size=chunk_size, **options)
    writer.start(profile="ros2")
    channels = {}
    for number, one in enumerate(sent):
        if one.topic not in channels:
            text = ROS2.generate_msgdef(one.type, ros_version=2)[0]
            schema = writer.register_schema(one.type, "ros2msg", text.encode())
            durability = "transient_local" if "static" in one.topic else "volatile"
            never = {"sec": 9223372036, "nsec": 854775807}
            offers = yaml.safe_dump(
                [
                    {
                        "history": "keep_last",
                        "depth": 1,
                        "reliability": "reliable",
                        "durability": durability,
                        "deadline": dict(never),
                        "lifespan": dict(never),
                        "liveliness": "automatic",
                        "liveliness_lease_duration": dict(never),
                        "avoid_ros_namespace_conventions": False,
                    }
                ],
                sort_keys=False,
            )
            channels[one.topic] = writer.register_channel(
                one.topic, "cdr", schema, {"offered_qos_profiles": offers}
            )
        writer.add_message(channels[one.topic], one.log_time, payload(one), one.log_time, number)
    writer.finish()
    path.write_bytes(stream.getvalue())
    return path


def write_rosbag2(
    path: Path, sent: Sequence[Sent], mode=CompressionMode.NONE, plugin=StoragePlugin.SQLITE3
) -> Path:
    """Write a rosbag2 folder with rosbags."""
    writer = Rosbag2Writer(path, version=9, storage_plugin=plugin)
    if mode is not CompressionMode.NONE:
        writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        connections = {}
        for one in sent:
            if one.topic not in connections:
                connections[one.topic] = writer.add_connection(
                    one.topic, one.type, typestore=ROS2, offered_qos_profiles=latched(one.topic)
                )
            writer.write(connections[one.topic], one.log_time, payload(one))
    return path


def write_split(path: Path, sent: Sequence[Sent], parts: int = 3) -> Path:
    """Write a rosbag2 folder of several MCAP files, as a recorder splits them."""
    path.mkdir()
    size = -(-len(sent) // parts)
    names = [f"{path.name}_{part}.mcap" for part in range(parts)]
    for part, name in enumerate(names):
        write_mcap(path / name, sent[part * size : (part + 1) * size])
    document = {"rosbag2_bagfile_information": {"version": 9, "relative_file_paths": names}}
    (path / "metadata.yaml").write_text(yaml.safe_dump(document))
    return path


def write_rosbag1(path: Path, sent: Sequence[Sent], compression=None, chunk_size=4096) -> Path:
    """Write a ROS 1 bag with rosbags."""
    writer = Rosbag1Writer(path)
    writer.chunk_threshold = chunk_size
    if compression is not None:
        writer.set_compression(compression)
    with writer:
        connections = {}
        for one in sent:
            key = one.topic, one.node
            if key not in connections:
                connections[key] = writer.add_connection(
                    one.topic,
                    one.type,
                    typestore=ROS1,
                    callerid=one.node,
                    latching=int("static" in one.topic),
                )
            writer.write(connections[key], one.log_time, payload(one, ROS1))
    return path


CONTAINERS: dict[str, Callable[[Path, Sequence[Sent]], Path]] = {
    "mcap none": lambda p, s: write_mcap(p / "a.mcap", s, compression=CompressionType.NONE),
    "mcap lz4": lambda p, s: write_mcap(p / "a.mcap", s, compression=CompressionType.LZ4),
    "mcap zstd": lambda p, s: write_mcap(p / "a.mcap", s),
    "mcap unchunked": lambda p, s: write_mcap(p / "a.mcap", s, use_chunking=False),
    "mcap without index": lambda p, s: write_mcap(
        p / "a.mcap", s, index_types=IndexType.NONE, use_statistics=False, repeat_channels=False
    ),
    "mcap split": lambda p, s: write_split(p / "a", s),
    "db3": lambda p, s: write_rosbag2(p / "a", s),
    "db3 compressed by message": lambda p, s: write_rosbag2(p / "a", s, CompressionMode.MESSAGE),
    "db3 compressed by file": lambda p, s: write_rosbag2(p / "a", s, CompressionMode.FILE),
    "rosbag2 mcap": lambda p, s: write_rosbag2(p / "a", s, plugin=StoragePlugin.MCAP),
    "ros 1 none": lambda p, s: write_rosbag1(p / "a.bag", s),
    "ros 1 lz4": lambda p, s: write_rosbag1(p / "a.bag", s, Rosbag1Writer.CompressionFormat.LZ4),
    "ros 1 bz2": lambda p, s: write_rosbag1(p / "a.bag", s, Rosbag1Writer.CompressionFormat.BZ2),
}
"""Function for each container format: it writes content into a folder, and returns the path."""
