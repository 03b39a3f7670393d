"""Server of the page: HTTP for the page and a WebSocket for the frames, on one port.

The server listens on 127.0.0.1 only, in the same event loop as the nodes. Other users of this
machine can reach that address too, so requests for frames need the secret in the printed address. A
page of another site must not read a robot's frames through a visitor's browser, so the headers Host
and Origin must name this server.

A page reports when it has drawn the last poses. A slow page skips poses, because only the
newest poses wait to be sent.
"""

import asyncio
import errno
import gzip
import json
import logging
import math
import re
import secrets
import threading
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from http import HTTPStatus
from types import TracebackType
from typing import Any, Protocol
from urllib.parse import parse_qs

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from tftool.base.errors import InputError, TftoolError
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import Snapshot
from tftool.robots.mesh_folders import MeshRefused
from tftool.screens.browser import assets, page_messages, protocol
from tftool.screens.browser.client import Cadence, PageClient, Poses, SharedMoment, TreeMessage
from tftool.screens.browser.drawn_messages import (
    IN_A_FILE,
    DrawnTopic,
    Limits,
    LiveDisplays,
    pack_tracks,
)
from tftool.screens.browser.marks import marks_of
from tftool.screens.browser.packing import PackedBlock
from tftool.screens.browser.robots import ShownRobot
from tftool.screens.browser.standalone import (
    StandaloneData,
    StandalonePage,
    standalone_page,
)
from tftool.screens.terminal.sliders import slide_range
from tftool.world.clock import Clock, Phase, pace_of

HOST = "127.0.0.1"
PORT = 8765
PORTS_TRIED = 20
ROUTER_PORT = 7447
"""Port of ROS's zenoh router, which the page never uses."""

MOST_CLIENTS = 32
RANGE_EVERY = 10
"""Pictures between two updates of the buffer's time span for a page that shows the past."""

DISPLAYS_RATE = 10.0
"""Rate in hertz at which messages to draw are sent to pages."""

TREES_KEPT = 8
"""Largest number of states of the tree whose messages with names are stored."""

# The library logs failed handshakes of any client, which must not reach the terminal.
_LOGGER = logging.getLogger("tftool.view")
_LOGGER.addHandler(logging.NullHandler())
_LOGGER.propagate = False


class ShownWorld(Protocol):
    """Protocol of a world to show: a clock and a buffer, which every `World` has."""

    @property
    def clock(self) -> Clock:
        """Clock on which the frames' stamps are measured."""
        ...

    @property
    def buffer(self) -> Buffer:
        """Transform buffer with the frames."""
        ...


class PageServer:
    """Server of the page; use `async with`, and `await run()` inside.

    Attributes:
        port: Port on which the server listens.
        asked_port: Requested port.
        clients: Pages that are open.
    """

    def __init__(
        self,
        source: ShownWorld,
        *,
        port: int = PORT,
        rate: float = 30.0,
        tell: Callable[[str], object] = _LOGGER.warning,
        name: str = "a session",
        secret: str | None = None,
        begin: Stamp | None = None,
    ) -> None:
        """Prepare the server without opening a port.

        Args:
            source: Clock and buffer of the frames.
            port: Port to listen on, or the next free port if the port is in use; 0 for any port.
            rate: Updates of the page per second.
            tell: Function called with sentences for the user.
            name: Name of the source, for a saved page.
            secret: Token that requests for frames must contain; None for a new token.
            begin: Time that a page shows first, if the frames were recorded; None for the present.
        """
        self.source = source
        self._name = name
        self._begin = begin
        self._press: Callable[[str], object] | None = None
        self._tell = tell
        self._is_full = False
        self.asked_port = self.port = port
        self.clients: set[PageClient] = set()
        self._period = _period(source.clock, rate)
        self._displays_period = _period(source.clock, DISPLAYS_RATE)
        self._server: Server | None = None
        self._files = assets.load()
        self._robot: ShownRobot | None = None
        self._robot_text = ""
        self._read_tracks: Callable[[Limits], Sequence[DrawnTopic]] | None = None
        self._live: LiveDisplays | None = None
        self._tracks: asyncio.Future[bytes] | None = None
        self._trees: dict[object, TreeMessage] = {}
        self._revision = 0
        self._ticks = 0
        self._secret = secret or secrets.token_urlsafe(24)
        self._writing: threading.Event | None = None
        """Event that stops the writing of a page's file; None while none is written."""

    def show_robot(self, robot: ShownRobot) -> None:
        """Show `robot` on all pages, in place of any other robot."""
        self._robot = robot
        robot.place(frozenset(self.source.buffer.frames()))
        self._tell_robot()

    def show_tracks(self, read: Callable[[Limits], Sequence[DrawnTopic]]) -> None:
        """Set the function that reads messages to draw; called when the first page opens."""
        self._read_tracks = read

    def show_live(self, displays: LiveDisplays) -> None:
        """Set the displays that draw messages of a running session."""
        self._live = displays

    def take_keys(self, press: Callable[[str], object]) -> None:
        """Call `press` with the page's arrow keys: "up", "down", "left" and "right"."""
        self._press = press

    def _tell_robot(self) -> None:
        if self._robot is not None:
            self._robot_text = self._robot.as_text()
            for client in self.clients:
                client.show_robot(self._robot_text)

    def _move(self, joint: str, position: float) -> None:
        """Move a joint of the shown robot; an unknown joint is ignored."""
        robot = self._robot
        if robot is not None and robot.mover is not None and robot.robot.takes(joint):
            lower, upper = slide_range(robot.robot.joints[joint])
            robot.mover.move(joint, min(upper, max(lower, position)))
            # Stored for pages that open later.
            self._robot_text = ""

    @property
    def origin(self) -> str:
        """Scheme, host and port of the page, without the secret."""
        return f"http://{HOST}:{self.port}"

    @property
    def url(self) -> str:
        """Address of the page with the secret; the address must not be logged."""
        return self.address("/")

    def address(self, path: str) -> str:
        """Return the address of a path on the server, with the secret."""
        return f"{self.origin}{path}?token={self._secret}"

    async def __aenter__(self) -> "PageServer":
        """Start to listen.

        Raises:
            TftoolError: If no port near the requested port is free.
        """
        for port in _candidates(self.asked_port):
            try:
                self._server = await serve(
                    self._talk,
                    HOST,
                    port,
                    process_request=self._receive,
                    compression=None,  # the loopback is fast, and compression would take longer
                    max_size=page_messages.MOST_BYTES,
                    max_queue=4,
                    logger=_LOGGER,
                    server_header=None,
                )
            except OSError as error:
                if error.errno not in (errno.EADDRINUSE, errno.EACCES):
                    raise
                continue
            self.port = next(iter(self._server.sockets)).getsockname()[1]
            asyncio.get_running_loop().set_exception_handler(self._note)
            return self
        raise TftoolError(
            f"no port from {self.asked_port} to {self.asked_port + PORTS_TRIED - 1} is free: "
            "choose another port with --port"
        )

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Notify every page that the server ends, and close the server."""
        if self._writing is not None:
            self._writing.set()
        if self._server is not None:
            self._server.close()
            await self._server.wait_closed()

    def _note(self, loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        """Report a lack of file descriptors, but only once; let asyncio report other errors."""
        error = context.get("exception")
        if not isinstance(error, OSError) or error.errno not in (errno.EMFILE, errno.ENFILE):
            loop.default_exception_handler(context)
        elif not self._is_full:
            self._is_full = True
            self._tell("no more pages can be served: too few file descriptors (ulimit -n)")

    async def run(self) -> None:
        """Send poses to the pages until cancelled."""
        clock = pace_of(self.source.clock)
        due = displays_due = clock.now()
        cadence = Cadence(self._period, due)
        while True:
            await clock.sleep_until(due, Phase.WATCH)
            began = clock.now()
            self._tick(self.source.clock.now())
            if self._live is not None and clock.now() >= displays_due:
                displays_due = self._tell_displays(self._live, clock)
            due = cadence.after(began, clock.now())

    def _tick(self, now: Stamp) -> None:
        self._ticks += 1
        following: SharedMoment | None = None
        for client in list(self.clients):
            if client.wants():
                if client.at is not None:
                    self._offer(client, self._picture(now, client.at))
                    continue
                following = following or self._picture(now, 0)
                self._offer(client, following)
            elif self._ticks % RANGE_EVERY == 0:
                following = following or self._picture(now, 0)
                client.tell(protocol.encode_range(self.source.clock.epoch, following.snapshot))

    def _tell_displays(self, displays: LiveDisplays, clock: Clock) -> Stamp:
        """Pass the new drawable messages to all pages; return the time of the next call."""
        began = clock.now()
        blocks = displays.round()
        for client in self.clients:
            client.show_displays(blocks)
        ended = clock.now()
        # Without an open page, messages are only stored for pages that open later.
        period = self._displays_period * (1 if self.clients else 10)
        return max(began + period, ended + 2 * (ended - began))

    def _picture(self, now: Stamp, at: Stamp) -> SharedMoment:
        snapshot = self.source.buffer.snapshot(now, at)
        tree = self._tree(snapshot)
        frames = [snapshot.frames[index] for index in tree.shown]
        return SharedMoment(
            snapshot, tree, Poses(self.source.clock.epoch, tree.revision, snapshot, frames)
        )

    def _tree(self, snapshot: Snapshot) -> TreeMessage:
        """Return the message with the frames' names, made once for each state of the tree."""
        key = protocol.names_key(snapshot.frames)
        tree = self._trees.get(key)
        if tree is None:
            self._revision += 1
            shown = protocol.chosen(snapshot)
            text = protocol.encode_names(
                self.source.clock.epoch,
                self._revision,
                [snapshot.frames[index] for index in shown],
                len(snapshot.frames),
                self.source.clock.rate,
                self._begin,
            )
            tree = TreeMessage(self._revision, text, shown)
            # A page may show a past time at which a frame had another parent: more than one tree
            # is in use, but few are.
            while len(self._trees) >= TREES_KEPT:
                del self._trees[next(iter(self._trees))]
            self._trees[key] = tree
            # New frames may reveal the prefix of the links' names.
            if self._robot is not None and self._robot.place(
                frozenset(self.source.buffer.frames())
            ):
                self._tell_robot()
        return tree

    def _offer(self, client: PageClient, picture: SharedMoment) -> None:
        pair = None
        if client.pair is not None:
            pair = protocol.encode_pair(
                self.source.buffer, self.source.clock.epoch, *client.pair, picture.snapshot.at
            )
        client.offer(picture.tree, pair, picture.poses)

    async def _receive(self, connection: ServerConnection, request: Request) -> Response | None:
        """Return the response to a request for a file; None to open a WebSocket."""
        ours = [f"{host}:{self.port}" for host in (HOST, "localhost")]
        if request.headers.get_all("Host") not in [[host] for host in ours]:
            return _refuse(HTTPStatus.FORBIDDEN, f"This page is served as {self.origin}/ only.")
        path, _, query = request.path.partition("?")
        # Scripts and styles are the same for everybody, and contain no data of the frames.
        if path not in self._files or path in ("/", "/index.html"):
            given = parse_qs(query).get("token", [""])[-1]
            if not secrets.compare_digest(given.encode(), self._secret.encode()):
                return _refuse(
                    HTTPStatus.FORBIDDEN,
                    "This address lacks the secret: open the address that 'tftool view' printed.",
                )
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
        if path.startswith("/mesh/"):
            return await self._mesh(path, _takes_gzip(request))
        if path == "/tracks" and self._read_tracks is not None:
            return _answer(HTTPStatus.OK, "application/octet-stream", await self._packed_tracks())
        if path == "/standalone.html":
            sites = request.headers.get_all("Sec-Fetch-Site")
            origins = request.headers.get_all("Origin")
            # A link that a person follows has no Origin, and says "none" or "same-origin".
            is_ours = all(site in ("same-origin", "none") for site in sites)
            if not is_ours or any(
                one not in [f"http://{host}" for host in ours] for one in origins
            ):
                return _refuse(HTTPStatus.FORBIDDEN, "The file is for this server's own page.")
            return await self._standalone(connection, query)
        found = self._files.get(path)
        if found is None:
            return _refuse(HTTPStatus.NOT_FOUND, "There is no such page here.")
        if not _takes_gzip(request):
            return _answer(HTTPStatus.OK, found.kind, found.content)
        answer = _answer(HTTPStatus.OK, found.kind, found.compressed)
        answer.headers["Content-Encoding"] = "gzip"
        return answer

    async def _mesh(self, path: str, is_packed: bool) -> Response:
        if self._robot is None:
            return _refuse(HTTPStatus.NOT_FOUND, "There is no robot here.")
        try:
            served = self._robot.folders.read(path)
        except MeshRefused as refusal:
            return _refuse(HTTPStatus.NOT_FOUND, str(refusal))
        if not is_packed or served.kind.startswith("image/"):
            return _answer(HTTPStatus.OK, served.kind, served.content)
        # Large meshes take a tenth of a second to compress, so it is done in another thread.
        compressed = partial(gzip.compress, served.content, 1, mtime=0)
        content = await asyncio.get_running_loop().run_in_executor(None, compressed)
        answer = _answer(HTTPStatus.OK, served.kind, content)
        answer.headers["Content-Encoding"] = "gzip"
        return answer

    async def _packed_tracks(self) -> bytes:
        """Return the recorded messages to draw as packed data, computed once in another thread."""

        def packed() -> bytes:
            assert self._read_tracks is not None
            block, buffer = PackedBlock(), self.source.buffer
            epoch = self.source.clock.epoch
            header = {"tracks": pack_tracks(block, self._read_tracks(Limits()), buffer, epoch)}
            return block.deflated(header, level=1)

        if self._tracks is None:
            self._tracks = asyncio.get_running_loop().run_in_executor(None, packed)
        return await asyncio.shield(self._tracks)

    async def _standalone(self, connection: ServerConnection, query: str) -> Response:
        """Return a page that contains the whole buffer and needs no server.

        Only one page is written at a time; writing stops if the client or the server closes.
        """
        if self._writing is not None:
            return _refuse(
                HTTPStatus.SERVICE_UNAVAILABLE, "Another file is being written: try again later."
            )
        given_up = self._writing = threading.Event()
        view = parse_qs(query).get("view", [""])[0]
        clock, buffer = self.source.clock, self.source.buffer
        data = StandaloneData(self._name, buffer, clock.epoch, clock.now(), None, self._robot, view)
        if self._live is not None:
            data = replace(data, tracks=self._live.latest(IN_A_FILE.points))
        read = self._read_tracks

        def progress(done: int, whole: int) -> None:
            if given_up.is_set():
                raise asyncio.CancelledError

        def written() -> StandalonePage | None:
            whole = data if read is None else replace(data, tracks=read(IN_A_FILE))
            try:
                return standalone_page(whole, progress=progress)
            except asyncio.CancelledError:
                return None

        # In another thread, because a recording takes seconds.
        writing = asyncio.get_running_loop().run_in_executor(None, written)
        leaving = asyncio.ensure_future(connection.wait_closed())
        try:
            both: set[asyncio.Future[Any]] = {writing, leaving}
            await asyncio.wait(both, return_when=asyncio.FIRST_COMPLETED)
            given_up.set()
            page = await writing
        finally:
            given_up.set()
            leaving.cancel()
            self._writing = None
        if page is None:
            return _refuse(HTTPStatus.SERVICE_UNAVAILABLE, "The server stops.")
        answer = _answer(HTTPStatus.OK, "text/html; charset=utf-8", page.content)
        # To be saved, not opened here, where our page's security policy would block its script.
        answer.headers["Content-Disposition"] = "attachment"
        return answer

    async def _talk(self, socket: ServerConnection) -> None:
        client = PageClient(socket)
        self.clients.add(client)
        if self._robot is not None:
            self._robot_text = self._robot_text or self._robot.as_text()
            client.show_robot(self._robot_text)
        if self._read_tracks is not None:
            await socket.send(json.dumps(page_messages.answer("tracks", {})))
        if self._live is not None:
            client.show_displays(self._live.blocks)
        feeding = asyncio.ensure_future(client.feed())
        telling: asyncio.Future[None] | None = None
        judging: asyncio.Future[None] | None = None
        try:
            async for message in socket:
                request = page_messages.parse(message)
                buffer, epoch = self.source.buffer, self.source.clock.epoch
                match request.kind:
                    case "move":
                        self._move(request["joint"], request["position"])
                    case "key":
                        if self._press is not None:
                            self._press(request["key"])
                    case "series":
                        await socket.send(protocol.encode_series(buffer, epoch, request))
                    case "trails":
                        await socket.send(protocol.encode_trails(buffer, epoch, request))
                    case "marks":
                        if judging is None or judging.done():
                            judging = asyncio.ensure_future(self._tell_marks(socket))
                    case "past":
                        if telling is None or telling.done():
                            telling = asyncio.ensure_future(self._tell_past(socket))
                    case _:
                        client.hear(request, epoch)
        except InputError as error:
            await socket.close(1008, str(error))
        except ConnectionClosed:
            pass
        finally:
            self.clients.discard(client)
            tasks = [task for task in (feeding, telling, judging) if task is not None]
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)

    async def _tell_past(self, socket: ServerConnection) -> None:
        """Send the poses at times spread over the whole buffer, which the page draws as trails."""
        clock, now = pace_of(self.source.clock), self.source.clock.now()
        for moment in protocol.moments(self.source.buffer.snapshot(now).frames):
            began = clock.now()
            await socket.send(self._picture(now, moment).poses(0))
            await clock.sleep(self._period // 8 + 2 * (clock.now() - began), Phase.WATCH)

    async def _tell_marks(self, socket: ServerConnection) -> None:
        """Send the message with gaps and the doctor's findings, computed in another thread."""
        told = await asyncio.get_running_loop().run_in_executor(
            None, marks_of, self.source.buffer, self.source.clock.epoch
        )
        await socket.send(json.dumps(told))


def _period(clock: Clock, rate: float) -> int:
    speed = clock.rate if math.isfinite(clock.rate) else 1.0
    return max(1, round(NANOSECONDS * speed / rate))


def _candidates(port: int) -> list[int]:
    if port == 0:
        return [0]
    ports = range(port, min(port + PORTS_TRIED, 65536))
    return [candidate for candidate in ports if candidate != ROUTER_PORT]


def _refuse(status: HTTPStatus, sentence: str) -> Response:
    return _answer(status, "text/plain; charset=utf-8", f"{sentence}\n".encode())


def _takes_gzip(request: Request) -> bool:
    accepted = ",".join(request.headers.get_all("Accept-Encoding"))
    return "gzip" in re.split(r"[,\s]+", accepted)


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
