"""Message classes for the DDS library, and the names of ROS 2's topics and types in DDS."""

import re
from typing import Any, Final, NamedTuple

from cyclonedds.idl import make_idl_struct, types
from cyclonedds.idl.annotations import final

from tftool.base.errors import LinkError
from tftool.messages.hashes import PLACEHOLDER, type_hash
from tftool.messages.schema import FieldDefinition, Schema
from tftool.world.link.graph import Process, Role

_NAMES: Final = {
    "bool": "bool",
    "byte": "uint8",
    "char": "uint8",
    "float": "float32",
    "double": "float64",
    "string": "str",
}


class Raw:
    """Message of any type as bytes; the library requires a class with these methods."""

    __slots__ = ("payload", "sample_info")

    def __init__(self, payload: bytes) -> None:
        self.payload = payload
        self.sample_info: Any = None

    def serialize(self, **_: object) -> bytes:
        """Return the message's bytes, always in the encoding XCDR1."""
        return self.payload

    @classmethod
    def deserialize(cls, payload: bytes) -> "Raw":
        """Return a message with the received bytes."""
        return cls(payload)

    @classmethod
    def deserialize_key(cls, _: bytes) -> None:
        """Return None: ROS 2's messages have no key."""
        return


_MADE: Final[dict[tuple[str, str, tuple[tuple[str, str], ...]], type[Raw]]] = {}
"""Classes by the hash of their types, shared by all participants of this process."""


class Types:
    """Message classes for the library, made from definitions and stored by type name."""

    def __init__(self, schema: Schema) -> None:
        self._schema = schema

    def raw(self, full: str, *, beside: tuple[tuple[str, str], ...] = ()) -> type[Raw]:
        """Return the class with which the library sends and receives messages of a type.

        Args:
            full: Full name of the type.
            beside: Extra fields, (name, type) each, that precede the fields of the type.

        Raises:
            InputError: If a definition is missing.
            LinkError: If the library has no such type.
        """
        key = full, type_hash(self._schema, full), beside
        if key not in _MADE:
            made = self._made(full, beside, {})
            _MADE[key] = type("Raw", (Raw,), {"__slots__": (), "__idl__": made.__idl__})
        return _MADE[key]

    def _made(self, full: str, beside: tuple[tuple[str, str], ...], parts: dict[str, Any]) -> Any:

        fields = {
            name: self._single(full, FieldDefinition(name, kind), parts) for name, kind in beside
        }
        for field in self._schema.structure(full).fields or (PLACEHOLDER,):
            fields[field.name] = self._field(full, field, parts)
        short = full.rpartition("/")[2]
        return final(make_idl_struct(short, dds_type(full), fields))

    def _field(self, full: str, field: FieldDefinition, parts: dict[str, Any]) -> Any:

        kind = self._single(full, field, parts)
        if field.size is not None and field.size >= 0:
            return types.array[kind, field.size]
        if field.bound is not None:
            return types.sequence[kind, field.bound]
        return kind if field.size is None else types.sequence[kind]

    def _single(self, full: str, field: FieldDefinition, parts: dict[str, Any]) -> Any:

        if field.type == "wstring":
            raise LinkError(
                f"{full}: the DDS library for Python cannot send a wstring ('{field.name}')"
            )
        if "/" in field.type:
            if field.type not in parts:
                parts[field.type] = self._made(field.type, (), parts)
            return parts[field.type]
        if field.text_bound is not None:
            return types.bounded_str[field.text_bound]
        name = _NAMES.get(field.type, field.type)
        return {"bool": bool, "str": str}.get(name) or getattr(types, name)


TOPIC: Final = "rt/"
REQUEST: Final = "rq/"
REPLY: Final = "rr/"
"""Prefixes of the DDS names of ROS's topics, requests and replies; other names are not ROS's."""

DISCOVERY: Final = "ros_discovery_info"
"""Topic on which every participant publishes which node has which endpoints."""

CYCLONE: Final = b"\x01\x10"
FAST_DDS: Final = b"\x01\x0f"
"""Ids of the libraries' vendors, with which the GUIDs of their participants begin."""

VENDORS: Final = {CYCLONE: "Cyclone DDS", FAST_DDS: "Fast DDS"}

ENCLAVE: Final = "enclave=/;"
"""User data that ROS 2 writes for every participant."""

_TYPE = re.compile(r"(\w+)::(msg|srv|action)::dds_::(\w+)_", re.ASCII)
_HASH = re.compile(rb"typehash=(RIHS01_[0-9a-f]{64});")
_OURS = re.compile(
    r"tftool=(?P<role>\w+),(?P<pid>\d{1,9}),(?P<since>\d{1,19}),(?P<command>[\w-]{1,40});",
    re.ASCII,
)


class Part(NamedTuple):
    """Meaning of a DDS topic in ROS.

    Attributes:
        prefix: One of `TOPIC`, `REQUEST`, `REPLY`.
        name: Name of the topic or service, without a leading slash.
        ros_type: Type of the topic or service, such as "std_msgs/msg/String".
    """

    prefix: str
    name: str
    ros_type: str


def dds_type(ros_type: str) -> str:
    """Return a ROS type's name in DDS, such as "tf2_msgs::msg::dds_::TFMessage_"."""
    package, kind, name = ros_type.split("/")
    return f"{package}::{kind}::dds_::{name}_"


def ros_part(topic: str, type_name: str) -> Part | None:
    """Return the ROS topic or service of a DDS topic; None if ROS has no topic of that form."""
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
    """Return the type hash that an endpoint's user data contain; "" without a hash."""
    found = _HASH.search(user_data)
    return found[1].decode() if found else ""


def vendor(gid: bytes) -> str:
    """Return the name of the DDS library of an endpoint or participant, from its GUID."""
    return VENDORS.get(gid[:2], "another DDS library")


def process_data(process: Process) -> bytes:
    """Return the user data with which a tftool process announces itself."""
    ours = f"tftool={process.role},{process.pid},{process.since},{process.command};"
    return f"{ENCLAVE}{ours}".encode()


def process_shown(user_data: bytes, domain: int, session: str) -> Process | None:
    """Return the tftool process that a participant's user data describe; else None."""
    found = _OURS.search(user_data.decode(errors="replace"))
    if found is None or found["role"] not in tuple(Role):
        return None
    role = Role(found["role"])
    return Process(domain, session, int(found["since"]), int(found["pid"]), role, found["command"])
