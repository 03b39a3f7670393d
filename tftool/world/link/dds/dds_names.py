"""How ROS 2's names, types and qualities are written in DDS, and read back."""

import re
from typing import Final, NamedTuple

from tftool.world.link.graph import Process, Role

TOPIC: Final = "rt/"
REQUEST: Final = "rq/"
REPLY: Final = "rr/"
"""How the names of ROS's topics, requests and replies begin; other names are not ROS's."""

DISCOVERY: Final = "ros_discovery_info"
"""The topic on which every participant says which node has which endpoints."""

CYCLONE: Final = b"\x01\x10"
FAST_DDS: Final = b"\x01\x0f"
"""The vendors' ids, with which the GUIDs of their participants begin."""

VENDORS: Final = {CYCLONE: "Cyclone DDS", FAST_DDS: "Fast DDS"}

ENCLAVE: Final = "enclave=/;"
"""What ROS 2 writes beside every participant."""

_TYPE = re.compile(r"(\w+)::(msg|srv|action)::dds_::(\w+)_", re.ASCII)
_HASH = re.compile(rb"typehash=(RIHS01_[0-9a-f]{64});")
_OURS = re.compile(
    r"tftool=(?P<role>\w+),(?P<pid>\d{1,9}),(?P<since>\d{1,19}),(?P<command>[\w-]{1,40});",
    re.ASCII,
)


class Part(NamedTuple):
    """What a DDS topic is to ROS.

    Attributes:
        prefix: One of `TOPIC`, `REQUEST`, `REPLY`.
        name: The topic's or service's name, without a leading slash.
        ros_type: The type of the topic or service, "std_msgs/msg/String".
    """

    prefix: str
    name: str
    ros_type: str


def dds_type(ros_type: str) -> str:
    """The name of a type in DDS: "tf2_msgs::msg::dds_::TFMessage_"."""
    package, kind, name = ros_type.split("/")
    return f"{package}::{kind}::dds_::{name}_"


def ros_part(topic: str, type_name: str) -> Part | None:
    """What a DDS topic is to ROS; None where its names are not of ROS's making."""
    found = _TYPE.fullmatch(type_name)
    prefix, name = topic[:3], topic[3:]
    if found is None or prefix not in (TOPIC, REQUEST, REPLY) or not name:
        return None
    ros_type = "/".join(found.groups())
    if prefix == TOPIC:
        return Part(prefix, name, ros_type)
    ending, suffix = ("Request", "_Request") if prefix == REQUEST else ("Reply", "_Response")
    if not (name.endswith(ending) and ros_type.endswith(suffix)):
        return None
    return Part(prefix, name.removesuffix(ending), ros_type.removesuffix(suffix))


def hash_shown(user_data: bytes) -> str:
    """The hash of an endpoint's type, where it is written beside it; else ""."""
    found = _HASH.search(user_data)
    return found[1].decode() if found else ""


def vendor(gid: bytes) -> str:
    """Which library an endpoint or participant is of, by its GUID."""
    return VENDORS.get(gid[:2], "another DDS library")


def process_data(process: Process) -> bytes:
    """What is written beside the participant of a tftool."""
    ours = f"tftool={process.role},{process.pid},{process.since},{process.command};"
    return f"{ENCLAVE}{ours}".encode()


def process_shown(user_data: bytes, domain: int, session: str) -> Process | None:
    """The tftool that a participant belongs to; None for any other program."""
    found = _OURS.search(user_data.decode(errors="replace"))
    if found is None or found["role"] not in tuple(Role):
        return None
    role = Role(found["role"])
    return Process(domain, session, int(found["since"]), int(found["pid"]), role, found["command"])
