"""Recorded stream of messages, its quality of service, and interfaces of writers of recordings."""

import re
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Final, Protocol

from tftool.base.stamps import Stamp

TRANSIENT_LOCAL: Final = "transient_local"

_OFFER = re.compile(r"(durability|reliability):\s*([\w\"']+)")
_LONGEST_OFFERS = 100_000
_MESSAGE_TEXTS: Final = ("ros1msg", "ros2msg")
_TEXTS: Final = (*_MESSAGE_TEXTS, "ros2idl", "jsonschema")


_OFFERED: Final = """\
- history: keep_last
  depth: {depth}
  reliability: reliable
  durability: {durability}
  deadline:
    sec: 9223372036
    nsec: 854775807
  lifespan:
    sec: 9223372036
    nsec: 854775807
  liveliness: automatic
  liveliness_lease_duration:
    sec: 9223372036
    nsec: 854775807
  avoid_ros_namespace_conventions: false
"""

NUMBERS_BELOW: Final = 9
"""Version of rosbag2's metadata from which QoS policies are words; before, they are numbers."""

_POLICIES: Final = {
    "history": ("system_default", "keep_last", "keep_all", "unknown"),
    "reliability": ("system_default", "reliable", "best_effort", "unknown"),
    "durability": ("system_default", "transient_local", "volatile", "unknown"),
    "liveliness": ("system_default", "automatic", "manual_by_node", "manual_by_topic", "unknown"),
}
_POLICY = re.compile(
    rf"^([\s-]*)({'|'.join(_POLICIES)}):[ \t]*['\"]?(\w+)['\"]?[ \t]*$", re.MULTILINE
)


@dataclass(frozen=True, slots=True)
class Offers:
    """Quality of service (QoS) that the publishers of a topic offered, as far as recorded.

    Attributes:
        durability: Strongest offered durability, "transient_local" or "volatile"; "" if unknown.
        reliability: Strongest offered reliability, "reliable" or "best_effort"; "" if unknown.
        count: Number of publishers whose QoS was recorded.
    """

    durability: str = ""
    reliability: str = ""
    count: int = 0


@lru_cache(maxsize=1024)
def offers_of(text: str) -> Offers:
    """Parse the QoS profiles recorded by rosbag2; policies may be numbers or words."""
    found: dict[str, list[str]] = {"durability": [], "reliability": []}
    for policy, word in _OFFER.findall(text[:_LONGEST_OFFERS]):
        plain = word.strip("\"'")
        names = _POLICIES[policy]
        is_number = plain.isdecimal() and int(plain) < len(names)
        found[policy].append(names[int(plain)] if is_number else plain)

    def best(policy: str, wanted: str, other: str) -> str:
        words = found[policy]
        return wanted if wanted in words else other if other in words else ""

    return Offers(
        best("durability", TRANSIENT_LOCAL, "volatile"),
        best("reliability", "reliable", "best_effort"),
        len(found["durability"]),
    )


@dataclass(frozen=True, slots=True)
class Channel:
    """A recorded stream: a channel in MCAP, a row of `topics` in sqlite, a connection in ROS 1.

    Texts are exactly as recorded. Bytes that are not UTF-8 become surrogate characters.

    Attributes:
        topic: Name of the topic.
        type: Type of the messages.
        encoding: Encoding of the messages: "cdr", "ros1", "json", "protobuf".
        schema_encoding: Language of the definition: "ros2msg", "ros1msg", "protobuf".
        definition: Definition of the type, as bytes.
        metadata: Pairs of key and value: "offered_qos_profiles" and "topic_type_hash" as in MCAP
            files of rosbag2, and for ROS 1 "callerid", "latching", "md5sum".
    """

    topic: str
    type: str
    encoding: str = "cdr"
    schema_encoding: str = ""
    definition: bytes = b""
    metadata: tuple[tuple[str, str], ...] = ()

    def extra(self, key: str) -> str:
        """Return the metadata value of a key; "" if the channel's metadata lacks the key."""
        return dict(self.metadata).get(key, "")

    @property
    def text(self) -> str:
        """Return the definition of the type as text; "" for a binary definition."""
        if self.schema_encoding not in _TEXTS:
            return ""
        return self.definition.decode("utf-8", "backslashreplace")

    @property
    def message_text(self) -> str:
        """Return the type's definition if the definition has the syntax of .msg files, else ""."""
        return self.text if self.schema_encoding in _MESSAGE_TEXTS else ""

    @property
    def node(self) -> str:
        """Return the name of the publishing node; "" if not recorded."""
        return self.extra("callerid")

    @property
    def offers(self) -> Offers:
        """Return the quality of service that the topic's publishers offered."""
        if self.extra("latching") == "1":
            return Offers(TRANSIENT_LOCAL, "", 1)
        return offers_of(self.extra("offered_qos_profiles"))

    def readable(self) -> "Channel":
        """Return a copy of the channel with printable texts: control characters are escaped."""
        texts = (
            self.topic,
            self.type,
            self.encoding,
            *(word for one in self.metadata for word in one),
        )
        if all(text.isascii() for text in texts):
            return self
        metadata = tuple((_readable(key), _readable(value)) for key, value in self.metadata)
        return replace(
            self,
            topic=_readable(self.topic),
            type=_readable(self.type),
            encoding=_readable(self.encoding),
            metadata=metadata,
        )


def _readable(text: str) -> str:
    return text.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")


class ContainerWriter(Protocol):
    """Writer of one recording file; the constructor creates the file, and `finish` completes it."""

    @property
    def size(self) -> int:
        """Bytes written so far, including buffered bytes."""

    def channel(self, channel: Channel) -> int:
        """Register a channel, and return the number that identifies the channel in `write`."""

    def write(
        self,
        channel: int,
        log_time: Stamp,
        payload: bytes,
        publish_time: Stamp | None = None,
        sequence: int = 0,
    ) -> None:
        """Append a message to a channel."""

    def finish(self) -> None:
        """Write the rest of the file, such as an index, and close the file."""

    def abandon(self) -> None:
        """Close the file without an index."""


class RecordedWriter(ContainerWriter, Protocol):
    """Writer of a file that readers can use before the file is complete.

    Attributes:
        counts: Number of messages in each channel, by the number that `channel` returned.
    """

    counts: dict[int, int]

    @property
    def span(self) -> tuple[Stamp, Stamp]:
        """First and last log time of the messages in the file; (0, 0) if the file has none."""

    def flush(self) -> None:
        """Write buffered messages to the file."""

    def rescue(self) -> bool:
        """Complete the file after a failed write, and return whether the file is complete."""


def offers_text(static: bool) -> str:
    """Return the text that rosbag2 records for the QoS profile of a publisher of transforms.

    Args:
        static: Whether the publisher also sends its last message to late subscribers.
    """
    durability = "transient_local" if static else "volatile"
    return _OFFERED.format(depth=1 if static else 100, durability=durability)


def restyled(text: str, version: int) -> str:
    """Rewrite the policies in rosbag2's QoS profiles as numbers or as words.

    Args:
        text: The QoS profiles, in YAML.
        version: Version of `metadata.yaml`. Policies are numbers in versions below `NUMBERS_BELOW`,
            else words.
    """

    def policy(match: "re.Match[str]") -> str:
        before, name, value = match.groups()
        words = _POLICIES[name]
        if version < NUMBERS_BELOW and value in words:
            value = str(words.index(value))
        elif version >= NUMBERS_BELOW and value.isdecimal() and int(value) < len(words):
            value = words[int(value)]
        return f"{before}{name}: {value}"

    return _POLICY.sub(policy, text)
