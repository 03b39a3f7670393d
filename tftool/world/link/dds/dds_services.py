"""Services over DDS as in ROS 2 with Cyclone: a topic for requests and one for responses.

Each message begins with the request's number. Fast DDS sends that number beside the message, where
Cyclone's library cannot read it. So requests of nodes that use Fast DDS get no response, and a
warning names Fast DDS.
"""

import asyncio
import itertools
import os
import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from tftool.base.errors import LinkError
from tftool.base.stamps import Stamp, seconds
from tftool.world.clock import WallClock
from tftool.world.endpoints import Quality
from tftool.world.link.dds import dds_types as names
from tftool.world.link.dds.dds_types import Raw, Types
from tftool.world.link.dds.participant import DdsSample, Participant
from tftool.world.link.graph import SERVER, Graph
from tftool.world.link.seam import WireRequest

QUALITY: Final = Quality(depth=10)
"""Quality of service that ROS 2 uses for services."""

NUMBERED: Final = (("client_guid", "uint64"), ("sequence_number", "int64"))
"""Fields before each request and reply: the client's GUID, and the request's number."""

_HEAD: Final = 4
_NUMBER: Final = 16
_PAUSE: Final = seconds(0.005)

REFUSED: Final = (
    "it is served over {vendor}, which sends the number of a request in a field that DDS's library "
    "for Python cannot access: run the robot with rmw_cyclonedds_cpp or rmw_zenoh_cpp"
)


@dataclass(frozen=True, slots=True)
class ServicePart:
    """State that servers and clients of services share.

    Attributes:
        participant: This process's participant.
        types: Message classes for the library, by type name.
        graph: Graph of the other processes.
        sender: Function that returns the GUID of a message's writer.
    """

    participant: Participant
    types: Types
    graph: Graph
    sender: Callable[[DdsSample], bytes]

    def kinds(self, ros_type: str) -> tuple[type[Raw], type[Raw]]:
        """Return the message classes of a service's requests and replies."""
        raw = self.types.raw
        return (
            raw(f"{ros_type}_Request", beside=NUMBERED),
            raw(f"{ros_type}_Response", beside=NUMBERED),
        )


class CycloneServer:
    """Server of one service, which reads requests and writes replies."""

    def __init__(
        self,
        part: ServicePart,
        name: str,
        ros_type: str,
        on_request: Callable[[WireRequest], object],
        on_stranger: Callable[[str], object],
    ) -> None:
        """Start to serve a service.

        Args:
            part: State that all servers and clients share.
            name: Name of the service.
            ros_type: Type of the service.
            on_request: Function called with every request.
            on_stranger: Function called with the name of a library whose requests cannot be read.
        """
        self._part = part
        self._on_request = on_request
        self._on_stranger = on_stranger
        request, reply = part.kinds(ros_type)
        take_part = part.participant
        self._writer = take_part.writer(f"{names.REPLY}{name}Reply", reply, QUALITY, b"")
        self._reader = take_part.reader(
            f"{names.REQUEST}{name}Request", request, QUALITY, self._asked
        )
        self.gids = self._reader.gid, self._writer.gid

    def close(self) -> None:
        """Stop serving the service."""
        self._reader.close()
        self._writer.close()

    def _asked(self, sample: DdsSample) -> None:
        sender = self._part.sender(sample)
        # An unknown writer is assumed to be Cyclone's; its announcement will follow.
        if sender[:2] not in (names.CYCLONE, b""):
            self._on_stranger(names.vendor(sender))
            return
        self._on_request(CycloneRequest(sample.payload, self._writer.put))


class CycloneRequest:
    """Received request, whose number is sent back with the response."""

    def __init__(self, payload: bytes, reply: Callable[[bytes], object]) -> None:
        self._number = payload[_HEAD : _HEAD + _NUMBER]
        # Both numbers take sixteen bytes, so that the alignment of later fields is unchanged.
        self.payload: bytes = payload[:_HEAD] + payload[_HEAD + _NUMBER :]
        self._reply = reply

    def answer(self, payload: bytes, stamp: Stamp) -> None:
        """Send the response; `answer` must be called only once."""
        self._reply(payload[:_HEAD] + self._number + payload[_HEAD:])

    def refuse(self, reason: str) -> None:
        """Do nothing: ROS 2 has no refusal over DDS, so the client waits until its timeout."""


class CycloneClient:
    """Client of one service, which joins the graph with its first request or announcement."""

    def __init__(self, part: ServicePart, name: str, ros_type: str) -> None:
        self._part = part
        self._name = name
        self._ros_type = ros_type
        self._guid = int.from_bytes(os.urandom(8), "little")
        self._numbers = itertools.count(1)
        self._waiting: dict[int, asyncio.Future[bytes]] = {}
        self._close: list[Callable[[], None]] = []
        self._gids = b"", b""
        self._announced = 0
        self._is_matched: Callable[[], bool] = bool

    async def ask(self, payload: bytes, stamp: Stamp, timeout: float) -> bytes:
        """Send a request, and wait for the response at most `timeout` seconds."""
        vendors = {
            # The first bytes of a GUID identify the library.
            one.gid[:2]
            for one in self._part.graph.entities(SERVER, name=self._name)
            if one.ros_type == self._ros_type
        }
        # Without a server the vendor is unknown: then the request waits for a server.
        if vendors and names.CYCLONE not in vendors:
            raise LinkError(REFUSED.format(vendor=names.vendor(next(iter(vendors)))))
        number = next(self._numbers)
        answer: asyncio.Future[bytes] = asyncio.get_running_loop().create_future()
        self._waiting[number] = answer
        try:
            async with asyncio.timeout(timeout):
                await self._send(number, payload)
                return await answer
        except TimeoutError:
            raise LinkError(f"no server answered in {timeout:g} s, or all have left") from None
        finally:
            # Also after a timeout or a cancellation, so that a late reply is ignored.
            del self._waiting[number]

    async def _send(self, number: int, payload: bytes) -> None:
        self._open()
        clock = WallClock()
        # A request that is written before both sides are matched is lost.
        while not self._is_matched():
            await clock.sleep(_PAUSE)
        beside = struct.pack("<Qq", self._guid, number)
        self._put(payload[:_HEAD] + beside + payload[_HEAD:])

    def announce(self) -> tuple[bytes, bytes]:
        """Show the client in the graph until `withdraw` is called as often as `announce`.

        Returns:
            GUIDs of the client's reader and writer.
        """
        self._open()
        self._announced += 1
        return self._gids

    def withdraw(self) -> None:
        """Undo one call of `announce`; after the last call is undone, close the client."""
        self._announced -= 1
        self.close()

    def _open(self) -> None:
        if self._close:
            return
        request, reply = self._part.kinds(self._ros_type)
        take_part = self._part.participant
        # The reader first, so that it exists before any reply arrives.
        reader = take_part.reader(f"{names.REPLY}{self._name}Reply", reply, QUALITY, self._answered)
        writer = take_part.writer(f"{names.REQUEST}{self._name}Request", request, QUALITY, b"")
        self._close = [reader.close, writer.close]
        self._gids = reader.gid, writer.gid
        self._put = writer.put
        self._is_matched = lambda: writer.readers > 0 and reader.writers > 0

    def _answered(self, sample: DdsSample) -> None:
        payload = sample.payload
        # The second byte of CDR's header: servers may write either order.
        order = "<" if payload[1] & 1 else ">"
        guid, number = struct.unpack_from(f"{order}Qq", payload, _HEAD)
        # All clients of a service receive all replies, and each client counts from 1.
        answer = self._waiting.get(number)
        if guid == self._guid and answer is not None and not answer.done():
            answer.set_result(payload[:_HEAD] + payload[_HEAD + _NUMBER :])

    def close(self) -> None:
        """Close the client's reader and writer, unless the client is announced."""
        if self._announced:
            return
        for close in self._close:
            close()
        self._close = []
