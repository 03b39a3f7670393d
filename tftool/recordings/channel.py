"""What every writer of a recording is told about a stream of messages, and does with them."""

from dataclasses import dataclass
from typing import Protocol

from tftool.base.stamps import Stamp


@dataclass(frozen=True, slots=True)
class Channel:
    """One stream of messages to be written: a channel, a row of `topics`, a connection.

    Attributes:
        topic: Its name.
        type: The messages' type, as it is to be written.
        encoding: How they are written: "cdr", "ros1", "json", "protobuf".
        schema_encoding: How the definition is written: "ros2msg", "ros1msg", "protobuf".
        definition: The type's definition.
        metadata: What else belongs to the stream, by MCAP's keys: "offered_qos_profiles",
            "topic_type_hash", and of ROS 1 "callerid", "latching", "md5sum".
    """

    topic: str
    type: str
    encoding: str = "cdr"
    schema_encoding: str = ""
    definition: bytes = b""
    metadata: tuple[tuple[str, str], ...] = ()

    def extra(self, key: str) -> str:
        """Return the metadata under a key; "" for nothing."""
        return dict(self.metadata).get(key, "")


class CopiedPiece(Protocol):
    """Some bytes of another file that are to be written as they are."""

    @property
    def length(self) -> int:
        """Return their number."""

    def copy_to(self, file: int, place: int, crc: int | None = None) -> int:
        """Copy them to a place in the file of a number, and go on with a CRC if there is one."""


class ContainerWriter(Protocol):
    """One file that takes messages; it begins when it is made, and ends with `finish`."""

    @property
    def size(self) -> int:
        """Bytes written so far, those that wait to be included."""

    def channel(self, channel: Channel) -> int:
        """Make a stream known; the number by which `write` takes its messages."""

    def write(
        self,
        channel: int,
        log_time: Stamp,
        payload: bytes,
        publish_time: Stamp | None = None,
        sequence: int = 0,
    ) -> None:
        """Append one message."""

    def finish(self) -> None:
        """Write what closes the file, and close it."""

    def abandon(self) -> None:
        """Close the file as it is."""
