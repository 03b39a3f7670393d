"""Server's state of one open page: the page's requests, and the messages to send to the page."""

import asyncio
from collections.abc import Mapping
from dataclasses import dataclass

from websockets.asyncio.server import ServerConnection

from tftool.base.stamps import Duration, Stamp, seconds
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.screens.browser import page_messages, protocol

FORGIVEN = seconds(1)
"""Delay in nanoseconds beyond which the schedule shifts instead of catching up."""


class Cadence:
    """Schedule of repeated work at a steady rate; work takes at most half of the time.

    After a short delay, later runs keep their planned times, and the average rate stays the
    requested rate.
    """

    def __init__(self, period: Duration, start: Stamp) -> None:
        """Create a schedule that begins at `start`, with a run every `period` nanoseconds."""
        self._period = period
        self._due = start

    def after(self, began: Stamp, ended: Stamp) -> Stamp:
        """Return the time of the next run, after a run that lasted from `began` to `ended`."""
        self._due += self._period
        # Thousands of frames may take longer than a period: use at most half of the time.
        earliest = ended + (ended - began)
        if earliest - self._due > FORGIVEN:
            self._due = earliest
        return max(self._due, earliest)


IN_FLIGHT = 2
"""Largest number of messages with poses that are sent before the page acknowledges the first."""


@dataclass(frozen=True, slots=True)
class TreeMessage:
    """Message with the names of all shown frames, for one state of the tree.

    Attributes:
        revision: Number that identifies this state of the tree.
        text: The message as JSON.
        shown: Indices of the shown frames in the snapshot.
    """

    revision: int
    text: str
    shown: list[int]


class Poses:
    """Binary message with the poses of one snapshot, encoded once for all pages.

    Each page gets the same bytes with its own sequence number.
    """

    def __init__(
        self, epoch: Stamp, revision: int, snapshot: Snapshot, frames: list[FrameInfo]
    ) -> None:
        self._written = protocol.encode_poses(epoch, 0, revision, snapshot, frames)

    def __call__(self, sequence: int) -> bytes:
        """Return the message as bytes, with the sequence number of one page."""
        start = len(page_messages.MAGIC)
        number = (sequence & 0xFFFFFFFF).to_bytes(4, "little")
        return self._written[:start] + number + self._written[start + 4 :]


@dataclass(frozen=True, slots=True)
class SharedMoment:
    """Messages about one time, shared by all pages that show this time."""

    snapshot: Snapshot
    tree: TreeMessage
    poses: Poses


class PageClient:
    """Server's state of one open page: what the page shows, and what to send next.

    Attributes:
        at: Time shown by the page; None for the present.
        pair: Target and source of the pair whose transform the page shows.
        sent: Number of messages with poses sent so far.
        skipped: Number of messages with poses not sent because the page was busy.
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
        """Handle a request for a time or a pair of frames, or an acknowledgement of drawn poses."""
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
        """Return whether to send poses: always at the present time, else once per request."""
        asked, self._asked = self._asked, False
        return asked or self.at is None

    def offer(self, tree: TreeMessage, pair: str | None, poses: Poses) -> None:
        """Replace the waiting messages about frames: tree (if it has changed), pair and poses."""
        if self._next:
            self.skipped += 1
        self._next = [] if self._revision == tree.revision else [tree.text]
        if pair is not None:
            self._next.append(pair)
        self._next.append(poses(self.sent + 1))
        self._next_revision = tree.revision
        self._wake.set()

    def tell(self, text: str) -> None:
        """Set the next text message to send; a text message still waiting to be sent is dropped."""
        self._word = text
        self._wake.set()

    def show_robot(self, text: str) -> None:
        """Set the robot message to send; a robot message still waiting to be sent is dropped."""
        self._robot = text
        self._wake.set()

    def show_displays(self, blocks: Mapping[str, bytes]) -> None:
        """Set the messages to draw, by topic; only the last message of a topic is sent."""
        self._displays.update(blocks)
        self._wake.set()

    async def feed(self) -> None:
        """Send waiting messages whenever the page is ready, until the connection is closed."""
        while True:
            await self._wake.wait()
            self._wake.clear()
            robot, self._robot = self._robot, None
            if robot is not None:
                await self.socket.send(robot)
            word, self._word = self._word, None
            if word is not None:
                await self.socket.send(word)
            # Not before the frames' names, because a page resets itself when it receives them.
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
