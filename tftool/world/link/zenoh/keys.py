"""zenoh's names for ROS: types and hashes, keys, tokens (announcements), attachments.

The names are those of ROS 2 over zenoh (`rmw_zenoh`), so the other process can be a ROS 2 node.
"""

import hashlib
import re
import struct
from dataclasses import dataclass
from functools import cache
from typing import Final

from tftool.base.errors import MalformedMessage
from tftool.base.stamps import Stamp
from tftool.messages import hashes
from tftool.messages.classes import INTERFACES
from tftool.world.endpoints import CLIENT, PUBLISHER, SUBSCRIPTION, Quality
from tftool.world.link.graph import NODE, SERVER, GraphEntity, Process, Role

LIVELINESS: Final = "@ros2_lv"
OURS: Final = "@tftool"

_CODES: Final = {NODE: "NN", PUBLISHER: "MP", SUBSCRIPTION: "MS", SERVER: "SS", CLIENT: "SC"}
_KINDS: Final = {code: kind for kind, code in _CODES.items()}

_BEST_EFFORT, _TRANSIENT_LOCAL, _KEEP_ALL = "2", "1", "2"


_PROCESS = re.compile(
    rf"{re.escape(OURS)}/(?P<domain>\d{{1,9}})/(?P<session>[0-9a-f]{{1,32}})/"
    r"(?P<since>\d{1,19})/(?P<pid>\d{1,9})/(?P<role>host|source|guest)/(?P<command>\w{1,64})",
    re.ASCII,
)


# Types and keys


@cache
def type_hash(ros_type: str) -> str:
    """Return a type's hash (RIHS01); the hash is computed once, from the first definition.

    Raises:
        InputError: If the definition is unknown.
    """
    return hashes.type_hash(INTERFACES, ros_type)


def dds_name(ros_type: str) -> str:
    """Return a type's DDS name: `tf2_msgs::msg::dds_::TFMessage_` for "tf2_msgs/msg/TFMessage"."""
    parts = ros_type.split("/")
    # A type that `ros_name` could not parse is returned unchanged.
    return f"{parts[0]}::{parts[1]}::dds_::{parts[2]}_" if len(parts) == 3 else ros_type


def ros_name(dds_type: str) -> str:
    """Return the ROS name of a type from its DDS name; return other text unchanged."""
    parts = dds_type.split("::")
    if len(parts) != 4 or parts[2] != "dds_" or not parts[3].endswith("_"):
        return dds_type
    return f"{parts[0]}/{parts[1]}/{parts[3][:-1]}"


def data_key(domain: int, name: str, ros_type: str, its_hash: str = "") -> str:
    """Return the zenoh key of a topic's messages or a service's requests.

    Args:
        domain: Number of the ROS domain.
        name: Name of the topic or service.
        ros_type: Type of the topic or service.
        its_hash: Hash of the type in the other process, which can have another ROS release; "" to
            use the hash of this process.
    """
    return f"{domain}/{name.strip('/')}/{dds_name(ros_type)}/{its_hash or type_hash(ros_type)}"


def any_hash_key(domain: int, name: str, ros_type: str) -> str:
    """Return the zenoh key that receives messages with any type hash (ROS releases differ)."""
    return f"{domain}/{name.strip('/')}/{dds_name(ros_type)}/*"


def quality(offered: Quality) -> str:
    """Return a publisher's or subscriber's quality of service as text for a token."""
    reliability = "" if offered.is_reliable else _BEST_EFFORT
    durability = _TRANSIENT_LOCAL if offered.is_latched else ""
    history = _KEEP_ALL if offered.keeps_all else ""
    return f"{reliability}:{durability}:{history},{offered.depth}:,:,:,,"


def read_quality(text: str) -> Quality:
    """Parse the quality of service in a token; missing or unknown fields get defaults."""
    parts = [*text.split(":"), "", "", ""]
    history, _, depth = parts[2].partition(",")
    return Quality(
        int(depth) if depth.isascii() and depth.isdigit() and len(depth) < 10 else Quality().depth,
        is_reliable=parts[0] != _BEST_EFFORT,
        is_latched=parts[1] == _TRANSIENT_LOCAL,
        keeps_all=history == _KEEP_ALL,
    )


# Tokens


def token_key(entity: GraphEntity, node_id: int, entity_id: int) -> str:
    """Return the key of the liveliness token with which rmw_zenoh announces an entity.

    Args:
        entity: The entity. Without a type hash, the hash of this process is used.
        node_id: Number of the entity's node within the session.
        entity_id: Number of the entity within the session; for a node, the same as `node_id`.
    """
    namespace, _, node = entity.node.rpartition("/")
    parts = [LIVELINESS, str(entity.domain), entity.session, str(node_id), str(entity_id)]
    parts += [_CODES[entity.kind], "%", _mangle("/" + namespace), node]
    if entity.kind != NODE:
        parts += [
            _mangle("/" + entity.name),
            dds_name(entity.ros_type),
            entity.type_hash or type_hash(entity.ros_type),
            quality(entity.quality),
        ]
    return "/".join(parts)


def parse_token(key: str) -> GraphEntity | Process | None:
    """Parse the key of a token; return None if the key is malformed."""
    if key.startswith(f"{OURS}/"):
        return _parse_process(key)
    parts = key.split("/")
    if len(parts) not in (9, 13) or parts[0] != LIVELINESS:
        return None
    _, domain, session, node_id, entity_id, code, _, namespace, node, *endpoint = parts
    numbers = (domain, node_id, entity_id)
    if not all(number.isascii() and number.isdigit() and len(number) < 19 for number in numbers):
        return None
    kind = _KINDS.get(code)
    if kind is None or (kind == NODE) != (not endpoint):
        return None
    name, dds_type, type_hash, qos = endpoint or ("", "", "", "")
    return GraphEntity(
        kind,
        int(domain),
        session,
        f"{_unmangle(namespace)}/{node}".strip("/"),
        _unmangle(name).strip("/"),
        ros_name(dds_type),
        read_quality(qos) if endpoint else Quality(),
        gid_of(key),
        type_hash,
    )


def process_key(process: Process) -> str:
    """Return the key of the token that announces a tftool process."""
    command = re.sub(r"\W", "_", process.command, flags=re.ASCII)[:64] or "_"
    facts = f"{process.session}/{process.since}/{process.pid}/{process.role.value}"
    return f"{OURS}/{process.domain}/{facts}/{command}"


def _parse_process(key: str) -> Process | None:
    found = _PROCESS.fullmatch(key)
    if found is None:
        return None
    return Process(
        int(found["domain"]),
        found["session"],
        int(found["since"]),
        int(found["pid"]),
        Role(found["role"]),
        found["command"],
    )


def _mangle(name: str) -> str:
    return name.replace("/", "%")


def _unmangle(name: str) -> str:
    return name.replace("%", "/")


# Attachments


@dataclass(frozen=True, slots=True)
class Attachment:
    """Metadata that zenoh sends with a message.

    Attributes:
        sequence: Number of the message; for a response, number of the request.
        stamp: Time of sending on the sender's clock, nanoseconds.
        gid: Id of the sender, 16 bytes.
    """

    sequence: int
    stamp: Stamp
    gid: bytes

    def encode(self) -> bytes:
        """Return the attachment as bytes."""
        return _ATTACHMENT.pack(self.sequence, self.stamp, 16, self.gid)


_ATTACHMENT = struct.Struct("<qqB16s")
_NUMBERS = struct.Struct("<q")
_NAMED = (b"\x0fsequence_number", b"\x10source_timestamp", b"\x0asource_gid")


def parse_attachment(raw: bytes) -> Attachment:
    """Parse an attachment of `rmw_zenoh`, in the present format or that of early Jazzy releases.

    Raises:
        MalformedMessage: If the bytes have another format.
    """
    if len(raw) == _ATTACHMENT.size:
        sequence, stamp, length, gid = _ATTACHMENT.unpack(raw)
        if length == 16:
            return Attachment(sequence, stamp, gid)
    elif raw.startswith(_NAMED[0]):
        return _named_attachment(raw)
    raise MalformedMessage("attachment", f"{len(raw)} bytes lack a number, stamp or sender")


def _named_attachment(raw: bytes) -> Attachment:
    numbers = []
    position = 0
    for name in _NAMED[:2]:
        value = position + len(name)
        if raw[position:value] != name or len(raw) < value + 8:
            raise MalformedMessage("attachment", f"the field {name[1:].decode()} is missing")
        numbers.append(_NUMBERS.unpack_from(raw, value)[0])
        position = value + 8
    # The sender's bytes are preceded by their number.
    rest = raw[position:]
    name = _NAMED[2] + b"\x10"
    gid = rest[len(name) :]
    if not rest.startswith(name) or len(gid) != 16:
        raise MalformedMessage("attachment", "the field source_gid is missing")
    return Attachment(numbers[0], numbers[1], gid)


def gid_of(token: str) -> bytes:
    """Return the 16-byte gid of a publisher, computed from the publisher's token.

    ROS 2 also computes gids from tokens, with another hash. Gids are only compared for equality.
    """
    return hashlib.blake2b(token.encode(), digest_size=16).digest()
