"""Tests of names on the wire, against definitions, published hashes and examples of rmw_zenoh."""

from dataclasses import replace

import pytest

from tests.messages import definitions
from tftool.base.errors import MalformedMessage
from tftool.world.endpoints import Quality
from tftool.world.link.graph import GraphEntity, Process, Role
from tftool.world.link.zenoh import keys
from tftool.world.link.zenoh.keys import Attachment

TF_HASH = "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"
POSE_HASH = "RIHS01_739beba26bcba6920404ba722b7b8321348512f92ea5be235c47251940dd8aa9"
GID = bytes(range(100, 116))


@pytest.fixture(scope="module")
def store():
    return definitions.store()


@pytest.mark.parametrize(
    "ros_type",
    [
        "action_msgs/msg/GoalStatusArray",
        "action_msgs/srv/CancelGoal",
        "geometry_msgs/msg/Twist",
        "rcl_interfaces/srv/GetParameters",
        "rcl_interfaces/srv/SetParameters",
        "std_srvs/srv/Empty",
        "tf2_msgs/msg/TFMessage",
        "turtlesim/action/RotateAbsolute_FeedbackMessage",
        "turtlesim/action/RotateAbsolute_GetResult",
        "turtlesim/action/RotateAbsolute_SendGoal",
        "turtlesim/msg/Color",
        "turtlesim/msg/Pose",
        "turtlesim/srv/Kill",
        "turtlesim/srv/SetPen",
        "turtlesim/srv/Spawn",
        "turtlesim/srv/TeleportAbsolute",
        "turtlesim/srv/TeleportRelative",
    ],
)
def test_the_hash_in_a_key_is_that_of_the_types_definition(store, ros_type):
    assert keys.type_hash(ros_type) == store.hash_rihs01(ros_type)


def test_a_topic_travels_under_the_key_that_rmw_zenoh_gives_it():
    ros_type = "tf2_msgs/msg/TFMessage"

    assert keys.data_key(0, "/tf", ros_type) == f"0/tf/tf2_msgs::msg::dds_::TFMessage_/{TF_HASH}"
    assert keys.any_hash_key(7, "tf", ros_type) == "7/tf/tf2_msgs::msg::dds_::TFMessage_/*"
    assert keys.ros_name("tf2_msgs::msg::dds_::TFMessage_") == ros_type
    assert keys.ros_name("nonsense") == "nonsense"


def test_a_publisher_token_reads_like_one_of_rmw_zenoh():
    publisher = GraphEntity(
        "publisher",
        2,
        "aac3178e146ba6f1fc6e6a4085e77f21",
        "turtlesim",
        "turtle1/pose",
        "turtlesim/msg/Pose",
        Quality(depth=7),
    )

    assert keys.token_key(publisher, 0, 10) == (
        "@ros2_lv/2/aac3178e146ba6f1fc6e6a4085e77f21/0/10/MP/%/%/turtlesim/%turtle1%pose/"
        f"turtlesim::msg::dds_::Pose_/{POSE_HASH}/::,7:,:,:,,"
    )


@pytest.mark.parametrize(
    ("quality", "text"),
    [
        (Quality(depth=10), "::,10:,:,:,,"),
        (Quality(depth=1, is_latched=True), ":1:,1:,:,:,,"),
        (Quality(depth=5, is_reliable=False), "2::,5:,:,:,,"),
        (Quality(depth=0, keeps_all=True), "::2,0:,:,:,,"),
    ],
)
def test_a_quality_of_service_is_written_as_rmw_zenoh_does_and_read_back(quality, text):
    assert keys.quality(quality) == text
    assert keys.read_quality(text) == quality


@pytest.mark.parametrize("text", ["", "x", "9:9:9,x", ":::::::::", "::,99999999999"])
def test_a_quality_that_is_unheard_of_counts_as_default(text):
    assert keys.read_quality(text) == Quality()


@pytest.mark.parametrize(
    "shown",
    [
        GraphEntity("node", 0, "ab12", "turtlesim"),
        GraphEntity("node", 0, "ab12", "robot1/arm/planner"),
        GraphEntity(
            "server", 5, "ab12", "sim", "a/set_pen", "turtlesim/srv/SetPen",
            Quality(is_reliable=False), type_hash="h",
        ),
    ],
)  # fmt: skip
def test_a_token_tells_what_it_was_made_from(shown):
    key = keys.token_key(shown, 1, 7)

    assert keys.parse_token(key) == replace(shown, gid=keys.gid_of(key))


def test_a_process_comes_back_from_its_token_and_names_are_made_plain():
    process = Process(3, "ab12", 1_700_000_000_000_000_000, 42, Role.HOST, "demo")
    key = keys.process_key(process)

    assert keys.parse_token(key) == process
    assert keys.parse_token(key.replace("/host/", "/ghost/")) is None
    assert keys.parse_token("@tftool/3/ab12") is None
    odd = Process(0, "ab", 1, 2, Role.SOURCE, "de mo/../x")
    assert keys.parse_token(keys.process_key(odd)).command == "de_mo____x"


def test_the_token_of_a_humble_talker_is_read():
    token = (
        "@ros2_lv/0/f1eec80b0794deb18ff9ee5a0182029d/0/10/SS/%/%robot1/server/%add_two_ints/"
        "example_interfaces::srv::dds_::AddTwoInts_/TypeHashNotSupported/::,10:,:,:,,"
    )

    entity = keys.parse_token(token)

    assert entity is not None
    assert (entity.node, entity.name) == ("robot1/server", "add_two_ints")
    assert entity.ros_type == "example_interfaces/srv/AddTwoInts"
    assert entity.type_hash == "TypeHashNotSupported"


@pytest.mark.parametrize(
    "token",
    [
        "",
        "@ros2_lv/0/ab/0/0/NN/%/%",
        "@other/0/ab/0/0/NN/%/%/node",
        "@ros2_lv/x/ab/0/0/NN/%/%/node",
        "@ros2_lv/0/ab/-1/0/NN/%/%/node",
        "@ros2_lv/99999999999999999999/ab/0/0/NN/%/%/node",
        "@ros2_lv/0/ab/0/0/MP/%/%/node",
        "@ros2_lv/0/ab/0/0/ZZ/%/%/node",
        "@ros2_lv/0/ab/0/0/NN/%/%/node/%t/type/hash/qos",
    ],
)
def test_a_token_that_is_none_of_ros_2_is_passed_over(token):
    assert keys.parse_token(token) is None


def test_an_attachment_is_33_bytes_and_comes_back():
    attachment = Attachment(-1, 1_700_000_000_000_000_000, GID)
    raw = attachment.encode()

    assert len(raw) == 33
    assert raw[16] == 16
    assert raw[17:] == GID
    assert keys.parse_attachment(raw) == attachment


def test_the_named_attachment_of_early_jazzy_is_read_too():
    raw = (
        b"\x0fsequence_number"
        + (5).to_bytes(8, "little")
        + b"\x10source_timestamp"
        + (123456789).to_bytes(8, "little")
        + b"\x0asource_gid\x10"
        + GID
    )

    assert keys.parse_attachment(raw) == Attachment(5, 123456789, GID)
    for end in range(len(raw)):
        with pytest.raises(MalformedMessage):
            keys.parse_attachment(raw[:end])


@pytest.mark.parametrize("raw", [b"", bytes(16), bytes(33), bytes(1000), b"\x0fsequence_number"])
def test_an_attachment_of_no_known_form_is_refused(raw):
    with pytest.raises(MalformedMessage):
        keys.parse_attachment(raw)


def test_a_gid_is_16_bytes_made_from_the_token():
    one, other = keys.gid_of("@ros2_lv/0/a"), keys.gid_of("@ros2_lv/0/b")

    assert len(one) == 16
    assert one != other
    assert one == keys.gid_of("@ros2_lv/0/a")
