"""Tests of definitions in recordings, against rosbags' reading of the same text."""

import random
import struct

import pytest

from tftool.base.errors import InputError, MalformedMessage
from tftool.messages.classes import INTERFACES, Interfaces
from tftool.messages.codec import Codec
from tftool.messages.layouts import ROS1

RULE = "=" * 80

POSE_STAMPED = f"""# A Pose with reference coordinate frame and timestamp
Header header
Pose pose

{RULE}
MSG: std_msgs/Header
# sequence ID: consecutively increasing ID
uint32 seq
time stamp
string frame_id

{RULE}
MSG: geometry_msgs/Pose
Point position
Quaternion orientation

{RULE}
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z

{RULE}
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
"""

HEADER = struct.pack("<III", 7, 3_000_000_000, 5) + struct.pack("<I", 3) + b"map"


def test_a_ros_1_message_is_read_by_the_definitions_that_came_with_it():
    kind = Interfaces().recorded("geometry_msgs/PoseStamped", POSE_STAMPED)

    read = Codec(kind, ROS1).decode(HEADER + struct.pack("<7d", 1, 2, 3, 0, 0, 0, 1))

    assert read.header.seq == 7
    # Seconds are unsigned in ROS 1.
    assert (read.header.stamp.sec, read.header.stamp.nanosec) == (3_000_000_000, 5)
    assert read.header.frame_id == "map"
    assert (read.pose.position.z, read.pose.orientation.w) == (3.0, 1.0)


def test_a_time_and_a_duration_of_ros_1_are_two_numbers_each():
    kind = Interfaces().recorded("pkg/Span", "time at\nduration left\nduration[] more")
    payload = struct.pack("<IIii", 1, 2, -3, -4) + struct.pack("<Iii", 1, -5, 6)

    read = Codec(kind, ROS1).decode(payload)

    assert (read.at.sec, read.at.nanosec) == (1, 2)
    assert (read.left.sec, read.left.nanosec) == (-3, -4)
    assert (read.more[0].sec, read.more[0].nanosec) == (-5, 6)
    assert Codec(kind, ROS1).encode(read) == payload


def test_rosbags_reads_the_same_message_from_the_same_definitions():
    typesys = pytest.importorskip(
        "rosbags.typesys", reason="rosbags, of the extra 'test', is missing"
    )
    store = typesys.get_typestore(typesys.Stores.EMPTY)
    store.register(typesys.get_types_from_msg(POSE_STAMPED, "geometry_msgs/msg/PoseStamped"))
    store.register(
        typesys.get_types_from_msg("int32 sec\nuint32 nanosec", "builtin_interfaces/msg/Time")
    )
    payload = HEADER.replace(struct.pack("<I", 3_000_000_000), struct.pack("<I", 9)) + bytes(56)

    theirs = store.deserialize_ros1(payload, "geometry_msgs/msg/PoseStamped")
    ours = Codec(Interfaces().recorded("geometry_msgs/PoseStamped", POSE_STAMPED), ROS1).decode(
        payload
    )

    assert ours.header.seq == theirs.header.seq
    assert ours.header.stamp.sec == theirs.header.stamp.sec
    assert ours.header.frame_id == theirs.header.frame_id
    assert ours.pose.orientation.w == theirs.pose.orientation.w


def test_the_header_of_the_oldest_recordings_is_the_one_of_today():
    text = f"Header header\n{RULE}\nMSG: roslib/Header\nuint32 seq\ntime stamp\nstring frame_id"
    kind = Interfaces().recorded("sensor_msgs/Old", text)

    assert Codec(kind, ROS1).decode(HEADER).header.frame_id == "map"


def test_a_package_with_a_header_of_its_own_means_its_own():
    text = f"Header header\n{RULE}\nMSG: pkg/Header\nint8 own"

    assert Interfaces().recorded("pkg/Said", text)().header.own == 0


def test_a_header_of_ros_2_written_as_ros_1_has_the_number_that_ros_1_counts_with():
    kind = INTERFACES.message("std_msgs/Header")
    header = kind(frame_id="map")
    header.stamp.sec = 5

    payload = Codec(kind, ROS1).encode(header)

    assert payload == struct.pack("<IIII", 0, 5, 0, 3) + b"map"
    assert Codec(kind, ROS1).decode(HEADER[:4] + payload[4:]) == header


def test_definitions_of_a_recording_change_no_other_class():
    before = INTERFACES.message("geometry_msgs/PoseStamped")
    one, other = Interfaces(), Interfaces()

    changed = one.recorded("geometry_msgs/PoseStamped", "int8 other")

    assert [field.name for field in changed.fields__] == ["other"]
    assert INTERFACES.message("geometry_msgs/PoseStamped") is before
    assert other.message("geometry_msgs/PoseStamped")().header.frame_id == ""


def test_a_type_without_a_definition_in_the_recording_is_the_one_of_ros_2():
    own = Interfaces()

    assert own.recorded("std_msgs/msg/String")().data == ""
    # Definitions of fields may be missing too: early rosbag2 stored no definitions.
    assert own.recorded("pkg/Said", "geometry_msgs/Point at")().at.x == 0.0


def test_two_definitions_of_one_type_are_each_used_for_the_message_they_came_with():
    own = Interfaces()
    first = own.recorded("pkg/First", f"Part p\n{RULE}\nMSG: pkg/Part\nint8 old")
    second = own.recorded("pkg/Second", f"Part p\n{RULE}\nMSG: pkg/Part\nfloat64 new")
    again = own.recorded("pkg/First", f"# said so\nPart p\n{RULE}\nMSG: pkg/Part\nint8 old # old")

    assert hasattr(first().p, "old")
    assert hasattr(second().p, "new")
    assert again is first


def test_a_services_event_is_read_from_the_definition_of_the_service():
    own = Interfaces()

    kind = own.recorded(
        "std_srvs/srv/SetBool_Event", "bool data\n---\nbool success\nstring message"
    )

    assert [field.name for field in kind.fields__] == ["info", "request", "response"]
    assert own.recorded("pkg/srv/Add_Request", "int8 a\n---\nint8 sum")().a == 0


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("pkg", "int8 x", "'pkg' is not the name of an interface: write 'package/Name'"),
        ("pkg/foo/A", "int8 x", "not the name of an interface"),
        ("pkg/msg/../A", "int8 x", "not the name of an interface"),
        ("pkg/A\0", "int8 x", "not the name of an interface"),
        ("pkg/A", "a b c d", "pkg/msg/A: field 'b': there is no interface pkg/msg/a"),
        ("pkg/A", "int8", "pkg/msg/A: 'int8' is not a field"),
        ("pkg/A", "no/such/Type x", "'no/such/Type' is not the name of an interface"),
        ("pkg/A", f"int8 x\n{RULE}\nint8 y", "does not begin with 'MSG: name'"),
        (
            "pkg/A",
            f"int8 x\n{RULE}\nIDL: pkg/msg/B\nmodule pkg",
            "in IDL, but only .msg definitions",
        ),
        ("pkg/A", "int8 X=three", "pkg/msg/A: 'X': 'three' is not a value of type int8"),
        ("pkg/A", "int8 x three", "pkg/msg/A: 'x': 'three' is not a value of type int8"),
        ("pkg/A", f"int8 x {'9' * 5000}", "is not a value of type int8"),
        ("pkg/A", f"int8[{'9' * 5000}] x", "is not a valid size of an array"),
        ("pkg/A", "int8[<=] x", "is not a valid size of an array"),
        ("pkg/A", "A a", "contains itself"),
        ("pkg/A", "\n".join(f"int8 x{n}" for n in range(10_001)), "more than 10000 fields"),
        (
            "pkg/A",
            "L0 x"
            + "".join(f"\n{RULE}\nMSG: pkg/L{n}\nL{n + 1} x" for n in range(1000))
            + f"\n{RULE}\nMSG: pkg/L1000\nint8 x",
            "more than 64 levels of messages",
        ),
    ],
)
def test_a_wrong_definition_in_a_recording_is_refused_with_the_reason(name, text, told):
    with pytest.raises(InputError) as refused:
        Interfaces().recorded(name, text)

    assert told in str(refused.value)


def test_mutated_definitions_are_read_or_refused_and_so_are_messages_of_theirs():
    chance = random.Random(2026)
    pieces = [RULE, "MSG: a/B", "---", "[", "]", "<=", "9" * 12, "Header", "time", "\0", "é", "#"]
    read = refused = 0
    for _ in range(1500):
        place = chance.randrange(len(POSE_STAMPED))
        piece = chance.choice([*pieces, chr(chance.randrange(32, 127))])
        text = POSE_STAMPED[:place] + piece + POSE_STAMPED[place + chance.randrange(6) :]
        try:
            kind = Interfaces().recorded("geometry_msgs/PoseStamped", text)
            Codec(kind, ROS1).decode(HEADER + bytes(56))
            read += 1
        except (InputError, MalformedMessage):
            refused += 1

    assert read > 100
    assert refused > 100


def test_constants_are_read_as_ros_1_writes_them():
    kind = Interfaces().recorded("pkg/A", "int32 TEN=010\nbyte LOW=-1\nstring TEXT=a b")

    assert (kind.TEN, kind.LOW, kind.TEXT) == (10, b"\xff", "a b")
