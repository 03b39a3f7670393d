"""A recording as it lies in its file, in pieces that are copied or taken apart.

Reading for editing is not reading for asking: nothing of what a message has beside its bytes
may be lost, and what is not changed is passed on as it lies there.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

from tftool.base.stamps import Stamp
from tftool.recordings.channel import Channel
from tftool.recordings.container import ChunkedFile
from tftool.recordings.mcap.write import CopiedAttachment


class Taken(NamedTuple):
    """One message, with all that its container keeps of it.

    Attributes:
        channel: The number of its channel in its file.
        log_time: When it was received, nanoseconds.
        payload: Its bytes.
        publish_time: When it was sent; `log_time` where it is not kept.
        sequence: Its number at its publisher; 0 where it is not kept.
    """

    channel: int
    log_time: Stamp
    payload: bytes
    publish_time: Stamp
    sequence: int


def described(
    messages: list[Taken], channels: Mapping[int, Channel], file: ChunkedFile
) -> list[Taken]:
    """Return the messages whose channel is known."""
    found = [one for one in messages if one.channel in channels]
    if len(found) < len(messages):
        file.note("Messages are left out of which nothing tells on which topic they are.")
    return found


class Block(Protocol):
    """Some messages that lie together in a file.

    Attributes:
        start: Log time of the first one.
        end: Of the last.
        channels: How many messages of each channel it has; None if that shows only when it is
            taken apart.
        whole: Whether it may be copied as it is.
    """

    start: Stamp
    end: Stamp
    channels: Mapping[int, int] | None
    whole: bool

    def sound(self) -> bool:
        """Whether what it holds is what was written, as far as it carries proof of that."""

    def messages(self) -> list[Taken]:
        """Its messages, in their order; those up to the damage, where there is any."""


@dataclass(slots=True)
class Extras:
    """Content of a file beside messages.

    Attributes:
        attachments: MCAP's attachments, which stay in their file.
        metadata: MCAP's metadata records, each the body.
    """

    attachments: list[CopiedAttachment] = field(default_factory=list)
    metadata: list[bytes] = field(default_factory=list)


class Tape(Protocol):
    """One file of a recording, read from front to back.

    Attributes:
        container: "mcap", "db3" or "bag".
        size: Bytes of it.
        channels: Its channels by their numbers; more may come up while it is read.
        extras: What it holds beside messages; complete once it is read.
        style: How its container is written, for a writer of the same kind.
    """

    container: str
    size: int
    channels: dict[int, Channel]
    extras: Extras
    style: dict[str, Any]

    @property
    def damage(self) -> list[str]:
        """What is wrong with it, as sentences; reading may add to them."""

    def blocks(self) -> Iterator[Block]:
        """Its pieces, in their order."""

    def close(self) -> None:
        """Close the file."""
