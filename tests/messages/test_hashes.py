"""Tests of type hashes against hashes that ROS 2 publishes and rosbags computes."""

import pytest

from tests.messages import definitions
from tftool.base.errors import InputError
from tftool.messages.classes import INTERFACES, Interfaces
from tftool.messages.hashes import type_hash

MESSAGES = sorted(
    f"{package}/msg/{name}"
    for package in INTERFACES.packages()
    for name in INTERFACES.names(package, "msg")
)

CHAR = "std_msgs/msg/Char"


@pytest.fixture(scope="module")
def store():
    return definitions.store()


@pytest.mark.parametrize(
    ("name", "published"),
    [
        # Hashes shown by `ros2 topic info -v`, `ros2 service info`, `ros2 action info` and
        # rmw_zenoh
        (
            "std_msgs/msg/String",
            "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
        ),
        (
            "tf2_msgs/msg/TFMessage",
            "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
        ),
        (
            "example_interfaces/srv/AddTwoInts",
            "RIHS01_e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a",
        ),
        (
            "action_msgs/srv/CancelGoal",
            "RIHS01_573d8b0a534451d7bc2ac8c5ffde8ac14b8593b7001175d0cd6516dcbeb8689a",
        ),
        (
            "example_interfaces/action/Fibonacci_SendGoal",
            "RIHS01_d1a57fb2a4afe8c21e34fb10db206f16ce6729b28531141472df92277c55b557",
        ),
        (
            "example_interfaces/action/Fibonacci_GetResult",
            "RIHS01_1b0de0d5d29dc955d92f546706568428632771db13ec84c15ec1c1a59f424a57",
        ),
        (
            "example_interfaces/action/Fibonacci_FeedbackMessage",
            "RIHS01_c1de71afd52e49a89c53d8262366884185bc0a02f78ce051c4e46b0a7fe59bb2",
        ),
    ],
)
def test_the_hash_of_a_type_is_the_one_ros_2_publishes(name, published):
    assert type_hash(INTERFACES, name) == published


@pytest.mark.parametrize("name", [name for name in MESSAGES if name != CHAR])
def test_the_hash_of_every_message_is_the_one_rosbags_computes(store, name):
    assert type_hash(INTERFACES, name) == store.hash_rihs01(name)


def test_a_char_is_the_uint8_that_ros_2_describes():
    # rosbags describes this type as a char.
    described = definitions.empty_store()
    described.register(definitions.get_types_from_msg("uint8 data", CHAR))

    assert type_hash(INTERFACES, CHAR) == described.hash_rihs01(CHAR)


def test_arrays_bounds_and_nested_names_count_and_defaults_do_not(store):
    own = Interfaces()
    lines = (
        "string<=5 name{}\nint8[3] three{}\nint16[<=4] few{}\nfloat32[] many\n"
        "string<=7[<=2] texts\ngeometry_msgs/Point[2] ends"
    )
    text = lines.format("", "", "")
    types = definitions.get_types_from_msg(text, "pkg/msg/A")
    store.register(types)

    own.add("pkg", {("msg", "A"): text})
    assert type_hash(own, "pkg/msg/A") == store.hash_rihs01("pkg/msg/A")
    own.add("pkg", {("msg", "A"): lines.format(' "x"', " [1, 2, 3]", " [4]")})
    assert type_hash(own, "pkg/msg/A") == store.hash_rihs01("pkg/msg/A")


def test_a_type_that_refers_to_nothing_we_know_has_no_hash():
    own = Interfaces()
    own.add("pkg", {("msg", "A"): "other/Thing x"})

    with pytest.raises(InputError, match="no interface other/msg/Thing"):
        type_hash(own, "pkg/msg/A")
