"""Playback of a recording's topics except tf: each message's bytes are sent at its time."""

import heapq
from collections.abc import Callable, Iterator
from typing import Final

import numpy as np

from tftool.base.errors import InputError, MalformedMessage
from tftool.base.stamps import Stamp, seconds
from tftool.messages.classes import INTERFACES, Interfaces
from tftool.messages.codec import Codec, codec
from tftool.messages.layouts import ROS1
from tftool.messages.schema import full_name
from tftool.recordings.channel import TRANSIENT_LOCAL
from tftool.recordings.container_reader import Recorded
from tftool.recordings.contract import RawMessage, RecordedTopic
from tftool.recordings.timeline import PlayClock
from tftool.world.endpoints import Quality
from tftool.world.link.seam import WirePublisher
from tftool.world.link.session import Link, is_plain

AHEAD: Final = seconds(1)
"""Nanoseconds by which messages may be out of order in a recording and are still sent in order."""

MOST_WAITING: Final = 10_000
MOST_WAITING_BYTES: Final = 256_000_000


class TopicFeed:
    """Player of the topics of a recording, except transforms, `/clock` and topics of unknown types.

    Attributes:
        topics: Names of the topics that are sent.
        left_out: For each topic that is not sent, a sentence with the reason.
    """

    def __init__(self, link: Link, source: Recorded, clock: PlayClock, node: str) -> None:
        """Announce the publishers of the topics.

        Args:
            link: Connection to the session, which sends the messages.
            source: The recording.
            clock: Clock of the playback, which converts the log time of a message to the time to
                send the message.
            node: Name of the node that publishes the topics.
        """
        self._link = link
        self._source = source
        self._clock = clock
        self._senders: dict[str, WirePublisher] = {}
        self._convert: dict[str, Callable[[bytes], bytes]] = {}
        self.left_out: list[str] = []
        latched = {one.topic for one in source.publishers if one.durability == TRANSIENT_LOCAL}
        for topic in source.topics:
            if topic.transforms or topic.name.strip("/") == "clock":
                continue
            try:
                ros_type, convert = _type_and_conversion(topic)
            except (InputError, MalformedMessage) as error:
                self.left_out.append(f"'{topic.name}' is not sent: {error}")
                continue
            if convert is not None:
                self._convert[topic.name] = convert
            self._senders[topic.name] = link.middleware.publisher(
                node, topic.name.strip("/"), ros_type, Quality(is_latched=topic.name in latched)
            )
        self.topics = tuple(self._senders)
        self._messages: Iterator[RawMessage] = iter(())
        self._waiting: list[tuple[Stamp, int, RawMessage]] = []
        self._bytes = self._number = 0
        self._read_to: Stamp | None = 0

    def seek(self, moment: Stamp) -> None:
        """Continue from a time of the playback in nanoseconds; read the file from its beginning."""
        self._messages = self._source.messages(self.topics) if self.topics else iter(())
        self._waiting.clear()
        self._bytes, self._read_to = 0, 0
        self._read(moment)
        while self._waiting and self._waiting[0][0] < moment:
            self._take()
            self._read(moment)

    def send_until(self, moment: Stamp) -> None:
        """Send all messages whose time is not after `moment`, nanoseconds of the playback."""
        self._read(moment)
        while self._waiting and self._waiting[0][0] <= moment:
            message = self._take()
            self._send(message)
            self._read(moment)

    def next_due(self) -> Stamp | None:
        """Return the playback time of the next message, nanoseconds; None at the end."""
        return self._waiting[0][0] if self._waiting else None

    def close(self) -> None:
        """Close the publishers."""
        for sender in self._senders.values():
            sender.close()

    def _take(self) -> RawMessage:
        message = heapq.heappop(self._waiting)[2]
        self._bytes -= len(message.payload)
        return message

    def _read(self, moment: Stamp) -> None:
        """Read the file a little ahead of the time `moment`; messages are stored sorted by time."""
        while (
            self._read_to is not None
            and (self._read_to <= moment + AHEAD or not self._waiting)
            and len(self._waiting) < MOST_WAITING
            and self._bytes < MOST_WAITING_BYTES
        ):
            message = next(self._messages, None)
            if message is None:
                self._read_to = None
                return
            due = int(self._clock.of(np.array([message.log_time], dtype=np.int64))[0])
            self._read_to = max(self._read_to, due)
            self._number += 1
            heapq.heappush(self._waiting, (due, self._number, message))
            self._bytes += len(message.payload)

    def _send(self, message: RawMessage) -> None:
        topic = message.sender.topic
        sender = self._senders[topic]
        if not sender.is_wanted:
            return
        convert = self._convert.get(topic)
        try:
            payload = message.payload if convert is None else convert(message.payload)
        except MalformedMessage as refusal:
            self._link.refuse(topic, refusal)
            return
        sender.put(payload, self._link.now())


def _type_and_conversion(topic: RecordedTopic) -> tuple[str, Callable[[bytes], bytes] | None]:
    """Return the ROS 2 type of a recorded topic, and a function that converts messages to CDR.

    The function is None if the recorded messages are in CDR already.

    Raises:
        InputError: If the topic cannot be sent; the text is the reason.
        MalformedMessage: If the type cannot be converted.
    """
    if not is_plain(topic.name.strip("/")):
        raise InputError(f"the name of topic '{topic.name}' is not valid in ROS 2")
    if topic.encoding not in ("cdr", "ros1"):
        raise InputError(f"the encoding of the messages, '{topic.encoding}', is unknown in ROS 2")
    full = full_name(topic.type)
    if topic.encoding == "ros1":
        if not INTERFACES.has(full):
            raise InputError(f"ROS 1's type {topic.type} is not known in ROS 2")
        read = Codec(Interfaces().recorded(topic.type, topic.definition), ROS1).decode
        write = codec(INTERFACES.message(full)).encode

        def convert(payload: bytes) -> bytes:
            return write(read(payload))

        return full, convert
    if not INTERFACES.has(full):
        if not topic.definition.strip():
            raise InputError(f"the type {topic.type} is unknown, and not defined in the recording")
        INTERFACES.define(full, topic.definition)
    INTERFACES.message(full)
    return full, None
