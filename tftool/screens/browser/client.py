"""One open page: its outgoing pictures, and when they are sent."""

import asyncio
from collections.abc import Mapping
from dataclasses import dataclass

from websockets.asyncio.server import ServerConnection

from tftool.base.stamps import Duration, Stamp, seconds
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.screens.browser import page_messages, protocol

FORGIVEN = seconds(1)
"""Turns that came later than this in all are not made up for."""


class Cadence:
    """Pace of a steady rate, with a pause after each turn at least as long as the turn.

    A turn that comes late moves none of those after it, as long as all of them are short: the
    average rate stays the requested one.
    """

    def __init__(self, period: Duration, start: Stamp) -> None:
        """Start at `start`, with a turn every `period`."""
        self._period = period
        self._due = start

    def after(self, began: Stamp, ended: Stamp) -> Stamp:
        """Return the time of the next turn after one with this start and end."""
        self._due += self._period
        # Thousands of frames may take longer than a period: never more than half the time.
        earliest = ended + (ended - began)
        if earliest - self._due > FORGIVEN:
            self._due = earliest
        return max(self._due, earliest)


IN_FLIGHT = 2
"""Poses a page may be sent before it says it has drawn the first of them."""


@dataclass(frozen=True, slots=True)
class TreeMessage:
    """The names of one state of the tree, as sent.

    Attributes:
        revision: Number.
        text: The message.
        shown: Shown frames of the snapshot.
    """

    revision: int
    text: str
    shown: list[int]


class Poses:
    """One snapshot, serialised once for all pages except for the sequence number."""

    def __init__(
        self, epoch: Stamp, revision: int, snapshot: Snapshot, frames: list[FrameInfo]
    ) -> None:
        self._written = protocol.encode_poses(epoch, 0, revision, snapshot, frames)

    def __call__(self, sequence: int) -> bytes:
        """Return the bytes for a page that has received `sequence` − 1 pictures."""
        start = len(page_messages.MAGIC)
        number = (sequence & 0xFFFFFFFF).to_bytes(4, "little")
        return self._written[:start] + number + self._written[start + 4 :]


@dataclass(frozen=True, slots=True)
class SharedMoment:
    """Data for all pages that show the same time."""

    snapshot: Snapshot
    tree: TreeMessage
    poses: Poses


class PageClient:
    """One open page: what it shows, and what it receives next.

    Attributes:
        at: Time shown by the page; None for the present.
        pair: Target and source whose transform it is sent.
        sent: Poses sent so far.
        skipped: Poses not sent because the page was busy.
    """

    def __init__(self, socket: ServerConnection) -> None:
        self.socket = socket
        self.at: Stamp | None = None
        self.pair: tuple[str, str] | None = None
        self.sent = 0
        self.skipped = 0
        self._asked = False
        self._drawn = 0
        self._revision = self._next_revision = -1
        self._next: list[str | bytes] = []
        self._word: str | None = None
        self._robot: str | None = None
        self._displays: dict[str, bytes] = {}
        self._wake = asyncio.Event()

    def hear(self, request: page_messages.PageRequest, epoch: Stamp) -> None:
        """Handle a request to show a moment or a pair, or an acknowledgement."""
        if request.kind == "got":
            self._drawn = max(self._drawn, min(request["sequence"], self.sent))
            self._wake.set()
            return
        if request.kind == "pair":
            target, source = request["target"], request["source"]
            self.pair = None if target is None else (target, source)
        else:
            self.at = None if request["at"] is None else protocol.stamp_at(epoch, request["at"])
        self._asked = True

    def wants(self) -> bool:
        """Whether the page needs new poses; a request about the past is answered once."""
        asked, self._asked = self._asked, False
        return asked or self.at is None

    def offer(self, tree: TreeMessage, pair: str | None, poses: Poses) -> None:
        """Offer the newest picture; an earlier unsent one is dropped."""
        if self._next:
            self.skipped += 1
        self._next = [] if self._revision == tree.revision else [tree.text]
        if pair is not None:
            self._next.append(pair)
        self._next.append(poses(self.sent + 1))
        self._next_revision = tree.revision
        self._wake.set()

    def tell(self, text: str) -> None:
        """Offer a message other than a picture; an earlier unsent one is dropped."""
        self._word = text
        self._wake.set()

    def show_robot(self, text: str) -> None:
        """Offer the robot; only the last one is sent."""
        self._robot = text
        self._wake.set()

    def show_displays(self, blocks: Mapping[str, bytes]) -> None:
        """Offer messages to draw, by topic; of each topic the last is sent."""
        self._displays.update(blocks)
        self._wake.set()

    async def feed(self) -> None:
        """Send offered data whenever the page is ready; ends with the connection."""
        while True:
            await self._wake.wait()
            self._wake.clear()
            robot, self._robot = self._robot, None
            if robot is not None:
                await self.socket.send(robot)
            word, self._word = self._word, None
            if word is not None:
                await self.socket.send(word)
            # Not before the names: a page of another session starts again with them.
            while self._displays and self.sent:
                await self.socket.send(self._displays.pop(next(iter(self._displays))))
            if not self._next or not self._ready():
                continue
            messages, self._next = self._next, []
            self._revision = self._next_revision
            self.sent += 1
            for message in messages:
                await self.socket.send(message)
            if self._displays:
                self._wake.set()

    def _ready(self) -> bool:
        return self.sent - self._drawn < IN_FLIGHT
