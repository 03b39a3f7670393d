"""The page's server: HTTP for the page and a WebSocket for the frames, on one port.

It listens on 127.0.0.1 only and lives in the same event loop as the nodes. A page of
another site must not read a robot's frames through its visitor's browser: both the Host
and the Origin a browser sends are compared with our own address.

A page says when it has drawn what it got. One that is slow is simply not sent the poses
in between: nothing is ever queued for it.
"""

import asyncio
import errno
import logging
import math
from http import HTTPStatus
from types import TracebackType
from typing import Protocol

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from tftool.errors import InputError, TftoolError
from tftool.frames.buffer import Buffer
from tftool.frames.sample import FrameInfo, Snapshot
from tftool.runtime.clock import Clock, Phase
from tftool.screens.browser import assets, protocol
from tftool.stamps import NANOSECONDS, Stamp
from tftool.views.forest import grow

HOST = "127.0.0.1"
PORT = 8765
PORTS_TRIED = 20
ROUTER_PORT = 7447
"""Belongs to the ROS router of a machine that has one; never ours."""

MOST_CLIENTS = 32
IN_FLIGHT = 2
"""Poses a page may be sent before it says it has drawn the first of them."""

RANGE_EVERY = 10
"""Ticks between two words about the buffer's reach to a page that shows the past."""

# What the library has to say of strangers' broken handshakes is not for the user's terminal.
_LOGGER = logging.getLogger("tftool.view")
_LOGGER.addHandler(logging.NullHandler())
_LOGGER.propagate = False


class Source(Protocol):
    """What is shown: a clock and a buffer. Every `World` is one."""

    @property
    def clock(self) -> Clock:
        """Whose time the frames live in."""
        ...

    @property
    def buffer(self) -> Buffer:
        """Where the frames are."""
        ...


class Client:
    """One open page: what it looks at, and what it is sent next.

    Attributes:
        at: The moment it looks at; None follows the present.
        pair: Target and source whose transform it is told.
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
        self._revision = -1
        self._next: list[str | bytes] = []
        self._wake = asyncio.Event()

    def hear(self, message: str | bytes, epoch: Stamp) -> None:
        """Take in what the page said.

        Raises:
            InputError: If it is not one of the page's messages.
        """
        said = protocol.parse(message)
        if isinstance(said, protocol.Got):
            self._drawn = max(self._drawn, min(said.sequence, self.sent))
            self._wake.set()
        elif isinstance(said, protocol.Pair):
            self.pair = said.frames
            self._asked = True
        else:
            self.at = None if said.at is None else protocol.stamp_at(epoch, said.at)
            self._asked = True

    def wants(self) -> bool:
        """Whether poses are to be made for it; asking about the past is answered once."""
        asked, self._asked = self._asked, False
        return asked or self.at is None

    def offer(self, revision: int, names: str, pair: str | None, poses: "Poses") -> None:
        """Put up the newest picture; one that was not taken yet is dropped."""
        if self._next:
            self.skipped += 1
        self._next = [] if self._revision == revision else [names]
        if pair is not None:
            self._next.append(pair)
        self._next.append(poses(self.sent + 1))
        self._pending_revision = revision
        self._wake.set()

    async def tell(self, text: str) -> None:
        """Send a word that is no picture, if nothing waits to be drawn."""
        if self._ready():
            await self.socket.send(text)

    async def feed(self) -> None:
        """Send what is offered whenever the page is ready for it; ends with the connection."""
        while True:
            await self._wake.wait()
            self._wake.clear()
            if not self._next or not self._ready():
                continue
            messages, self._next = self._next, []
            self._revision = self._pending_revision
            self.sent += 1
            for message in messages:
                await self.socket.send(message)

    def _ready(self) -> bool:
        return self.sent - self._drawn < IN_FLIGHT


class Poses:
    """One snapshot, written once for all pages but for the number each one counts by."""

    def __init__(
        self, epoch: Stamp, revision: int, snapshot: Snapshot, frames: list[FrameInfo]
    ) -> None:
        self._written = protocol.encode_poses(epoch, 0, revision, snapshot, frames)

    def __call__(self, sequence: int) -> bytes:
        """The bytes for a page that has been sent `sequence` − 1 pictures."""
        start = len(protocol.MAGIC)
        number = (sequence & 0xFFFFFFFF).to_bytes(4, "little")
        return self._written[:start] + number + self._written[start + 4 :]


class PageServer:
    """Serves the page until it is closed; use as `async with`, and `await run()` inside.

    Attributes:
        port: Where it listens.
        asked_port: Where it was asked to listen.
        clients: The pages that are open.
    """

    def __init__(self, source: Source, *, port: int = PORT, rate: float = 30.0) -> None:
        """Prepare to serve.

        Args:
            source: Whose frames to show.
            port: Where to listen; the next free one is taken instead, 0 takes any.
            rate: Pictures a second.
        """
        self.source = source
        self.asked_port = self.port = port
        self.clients: set[Client] = set()
        self._period = _period(source.clock, rate)
        self._server: Server | None = None
        self._files = assets.load()
        self._names = ""
        self._revision = 0
        self._key: object = None
        self._shown: list[int] = []
        self._ticks = 0

    @property
    def url(self) -> str:
        """Where a browser finds the page."""
        return f"http://{HOST}:{self.port}/"

    async def __aenter__(self) -> "PageServer":
        """Start to listen.

        Raises:
            TftoolError: If no port near the one asked for is free.
        """
        for port in _candidates(self.asked_port):
            try:
                self._server = await serve(
                    self._talk,
                    HOST,
                    port,
                    process_request=self._receive,
                    compression=None,  # a loopback has room; the time is better spent elsewhere
                    max_size=protocol.MOST_BYTES,
                    max_queue=4,
                    logger=_LOGGER,
                    server_header=None,
                )
            except OSError as error:
                if error.errno not in (errno.EADDRINUSE, errno.EACCES):
                    raise
                continue
            self.port = next(iter(self._server.sockets)).getsockname()[1]
            return self
        raise TftoolError(
            f"no port from {self.asked_port} to {self.asked_port + PORTS_TRIED - 1} is free; "
            "name another with --port"
        )

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Tell every page that this was it, and close."""
        if self._server is not None:
            self._server.close()
            await self._server.wait_closed()

    async def run(self) -> None:
        """Take snapshots and offer them to the pages, for ever."""
        clock = self.source.clock
        due = clock.now()
        while True:
            await clock.sleep_until(due, Phase.WATCH)
            began = clock.now()
            await self._tick(began)
            ended = clock.now()
            # Thousands of frames may take longer than a period: never more than half the time.
            due = max(due + self._period, ended + (ended - began))

    async def _tick(self, now: Stamp) -> None:
        self._ticks += 1
        following: tuple[Snapshot, Poses] | None = None
        for client in list(self.clients):
            if client.wants():
                if client.at is not None:
                    self._offer(client, client.at, *self._picture(now, client.at))
                    continue
                following = following or self._picture(now, 0)
                self._offer(client, 0, *following)
            elif self._ticks % RANGE_EVERY == 0:
                following = following or self._picture(now, 0)
                try:
                    epoch = self.source.clock.epoch
                    await client.tell(protocol.encode_range(epoch, following[0]))
                except ConnectionClosed:
                    continue  # its own task is about to notice

    def _picture(self, now: Stamp, at: Stamp) -> tuple[Snapshot, Poses]:
        snapshot = self.source.buffer.snapshot(now, at)
        key = protocol.names_key(snapshot.frames)
        epoch = self.source.clock.epoch
        if key != self._key:
            self._key = key
            self._revision += 1
            self._shown = _chosen(snapshot)
            frames = [snapshot.frames[index] for index in self._shown]
            self._names = protocol.encode_names(
                epoch, self._revision, frames, len(snapshot.frames), self.source.clock.rate
            )
        frames = [snapshot.frames[index] for index in self._shown]
        return snapshot, Poses(epoch, self._revision, snapshot, frames)

    def _offer(self, client: Client, at: Stamp, snapshot: Snapshot, poses: Poses) -> None:
        pair = None
        if client.pair is not None:
            epoch = self.source.clock.epoch
            pair = protocol.encode_pair(self.source.buffer, epoch, *client.pair, at)
        client.offer(self._revision, self._names, pair, poses)

    def _receive(self, connection: ServerConnection, request: Request) -> Response | None:
        """Answer a request for a file; None lets a WebSocket open."""
        ours = [f"{host}:{self.port}" for host in (HOST, "localhost")]
        if request.headers.get_all("Host") not in [[host] for host in ours]:
            return _refuse(HTTPStatus.FORBIDDEN, f"This page is served as {self.url} only.")
        path = request.path.partition("?")[0]
        if path == "/frames":
            origins = request.headers.get_all("Origin")
            if origins not in [[f"http://{host}"] for host in ours]:
                return _refuse(HTTPStatus.FORBIDDEN, "The frames are for this server's own page.")
            if len(self.clients) >= MOST_CLIENTS:
                return _refuse(
                    HTTPStatus.SERVICE_UNAVAILABLE,
                    f"{MOST_CLIENTS} pages are open already; close one of them.",
                )
            return None
        found = self._files.get(path)
        if found is None:
            return _refuse(HTTPStatus.NOT_FOUND, "There is no such page here.")
        return _answer(HTTPStatus.OK, found.kind, found.content)

    async def _talk(self, socket: ServerConnection) -> None:
        client = Client(socket)
        self.clients.add(client)
        feeding = asyncio.ensure_future(client.feed())
        try:
            async for message in socket:
                client.hear(message, self.source.clock.epoch)
        except InputError as error:
            await socket.close(1008, str(error))
        except ConnectionClosed:
            pass
        finally:
            self.clients.discard(client)
            feeding.cancel()
            await asyncio.gather(feeding, return_exceptions=True)


def _period(clock: Clock, rate: float) -> int:
    speed = clock.rate if math.isfinite(clock.rate) else 1.0
    return max(1, round(NANOSECONDS * speed / rate))


def _candidates(port: int) -> list[int]:
    if port == 0:
        return [0]
    ports = range(port, min(port + PORTS_TRIED, 65536))
    return [candidate for candidate in ports if candidate != ROUTER_PORT]


def _chosen(snapshot: Snapshot) -> list[int]:
    """Which frames are shown when there are too many: those nearest to their roots."""
    if len(snapshot.frames) <= protocol.MOST_FRAMES:
        return list(range(len(snapshot.frames)))
    kept = grow(snapshot, most=protocol.MOST_FRAMES).children
    return [index for index, frame in enumerate(snapshot.frames) if frame.frame in kept]


def _refuse(status: HTTPStatus, sentence: str) -> Response:
    return _answer(status, "text/plain; charset=utf-8", f"{sentence}\n".encode())


def _answer(status: HTTPStatus, kind: str, content: bytes) -> Response:
    headers = Headers(
        {
            "Content-Type": kind,
            "Content-Length": str(len(content)),
            "Connection": "close",
            **assets.SAFETY,
        }
    )
    return Response(status.value, status.phrase, headers, content)
