"""Client of one Foxglove server in its own thread: connects, subscribes, and reconnects.

This module imports `websockets`. Therefore the module is imported only when a process connects to a
server. Received data goes through an inbox to the event loop of the world.
"""

import asyncio
import contextlib
import os
import re
import ssl
import threading
from collections import Counter
from collections.abc import Callable, Coroutine, Iterator, Sequence
from typing import Any, Final, NamedTuple

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import (
    ConnectionClosed,
    InvalidMessage,
    InvalidStatus,
    NegotiationError,
)
from websockets.typing import Subprotocol

from tftool.base.errors import LinkError
from tftool.base.stamps import Stamp
from tftool.world.action_parts import Tasks
from tftool.world.link.foxglove import protocol
from tftool.world.link.foxglove.protocol import (
    FoxgloveChannel,
    ProtocolError,
    ServerState,
    ros_topic,
)
from tftool.world.link.queues import Inbox

PAUSES: Final = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0)
"""Seconds before each further attempt to connect; the last number is repeated."""

STEADY: Final = 2.0
"""Seconds after which a connection counts as working, so that the next pauses are short again."""

QUIET: Final = 0.2
"""Seconds without a change after which a server's announcements count as complete."""

PATIENCE: Final = 5.0
"""Longest wait in seconds for complete announcements."""

TIMEOUT: Final = 10.0
"""Longest wait in seconds for a connection to open, and for the response to a ping."""

_NOT_FOXGLOVE: Final = "it speaks WebSocket, but not Foxglove's protocol"

_REFUSED: Final = re.compile(r"unknown channel\D*(\d+)|channel (\d+) is not available", re.I)
"""Pattern of sentences about a refused subscription: Foxglove's SDK, older foxglove_bridge."""

_AGAIN: Final = 0.05
"""Seconds before a refused subscription is requested again."""

_MOST_REFUSED: Final = 5
"""Refusals of one channel after which its subscription is given up."""

_WAITING: Final = 4
"""Largest number of unread frames in `websockets`; beyond this number the server has to wait."""


class FoxgloveData(NamedTuple):
    """Received message: its channel, and its bytes in the server's encoding."""

    channel: FoxgloveChannel
    payload: bytes


class ClientReceiver(NamedTuple):
    """Callbacks of a client, which are called in the event loop.

    Attributes:
        changed: Called when the server was connected or lost, or has changed its announcements.
        data: Called with each message.
        time: Called with each time that the server sends.
        warn: Called with sentences for the user.
    """

    changed: Callable[[None], object]
    data: Callable[[FoxgloveData], object]
    time: Callable[[Stamp], object]
    warn: Callable[[str], object]


class _Direct(connect):
    """Connection to exactly the given address: redirects are not followed."""

    def process_redirect(self, exc: Exception) -> Exception:
        """Reject a redirect by returning the exception."""
        return exc


class FoxgloveClient:
    """Client of one Foxglove server, which reconnects after each loss until `close` is called."""

    def __init__(
        self,
        address: str,
        inbox: Inbox,
        receiver: ClientReceiver,
        *,
        place: str = "",
        pauses: Sequence[float] = PAUSES,
    ) -> None:
        """Start to connect, in a new thread.

        Args:
            address: Address of the server.
            inbox: Queue of calls to the event loop.
            receiver: Callbacks.
            place: Address as shown to the user, without secrets.
            pauses: Seconds before each further attempt to connect.
        """
        self._address = address
        self._inbox = inbox
        self._receiver = receiver
        self._place = place or address
        self._pauses = pauses
        self._lock = threading.Lock()
        self._state = ServerState()
        self._is_change_due = False
        self._wanted: set[tuple[str, str]] = set()
        self._heard: dict[int, FoxgloveChannel] = {}
        self._subscriptions: dict[int, int] = {}
        self._refusals: Counter[int] = Counter()
        self._count = 0
        self._tasks = Tasks()
        self._connection: ClientConnection | None = None
        self._first = threading.Event()
        self._failure = ""
        self._is_closed = False
        self._loop = asyncio.new_event_loop()
        self._woken = asyncio.Event()
        self._thread = threading.Thread(target=self._run, name="tftool foxglove", daemon=True)
        self._thread.start()

    # In any thread

    def wait(self) -> None:
        """Wait until the server has announced its channels.

        Raises:
            LinkError: If the server cannot be reached, or is not a Foxglove server.
        """
        self._first.wait(TIMEOUT + PATIENCE)
        if self._failure or not self._first.is_set():
            reason = self._failure or "it does not answer"
            raise LinkError(
                f"No Foxglove server answers at {self._place}: {reason}. Check that "
                "foxglove_bridge runs there ('ros2 run foxglove_bridge foxglove_bridge'; its "
                "default port is 8765)."
            )

    @contextlib.contextmanager
    def state(self) -> Iterator[ServerState]:
        """Yield the server's announcements, which a lock keeps unchanged inside this block."""
        with self._lock:
            yield self._state

    def want(self, name: str, ros_type: str, *, again: bool = False) -> None:
        """Subscribe to a topic, now or when the server announces the topic.

        Args:
            name: Name of the topic, without a leading slash.
            ros_type: Type of the topic.
            again: Whether to end an existing subscription and subscribe anew, to get messages that
                the server stores.
        """
        self._call(self._want, (name, ros_type), again)

    def forget(self, name: str, ros_type: str) -> None:
        """Unsubscribe from a topic."""
        self._call(self._forget, (name, ros_type))

    def close(self) -> None:
        """Disconnect, and wait for the thread's end."""
        self._call(self._stop)
        self._thread.join(TIMEOUT)

    def _call(self, function: Callable[..., None], *arguments: Any) -> None:
        # The loop may just have been closed.
        with contextlib.suppress(RuntimeError):
            self._loop.call_soon_threadsafe(function, *arguments)

    # In the client's thread

    def _run(self) -> None:
        asyncio.set_event_loop(self._loop)
        try:
            self._loop.run_until_complete(self._live())
        finally:
            self._loop.close()
            self._first.set()

    def _stop(self) -> None:
        self._is_closed = True
        self._woken.set()
        if self._connection is not None:
            self._start(self._connection.close())

    async def _live(self) -> None:
        """Connect, and reconnect after each loss, until the client is closed."""
        failures = lost = 0
        while not self._is_closed:
            began = self._loop.time()
            reason = await self._connected()
            if self._is_closed:
                return
            was_there = bool(self._state.name)
            if not self._first.is_set():
                self._failure = reason
                self._first.set()
                return
            if was_there:
                lost += 1
                self._warn(
                    f"The connection to {self._place} has ended ({reason}); the data received so "
                    f"far stays. Trying again ({lost})."
                )
            with self._lock:
                self._state = ServerState()
            self._tell_change()
            failures = 0 if self._loop.time() - began > STEADY else failures + 1
            pause = self._pauses[min(failures, len(self._pauses)) - 1 if failures else 0]
            # Not `asyncio.sleep`, which nothing could end early.
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(self._woken.wait(), pause)

    async def _connected(self) -> str:
        """Connect, and read until the connection ends; return the reason for its end."""
        try:
            async with _Direct(
                self._address,
                subprotocols=[Subprotocol(one) for one in protocol.SUBPROTOCOLS],
                compression=None,
                max_size=protocol.LARGEST,
                max_queue=_WAITING,
                open_timeout=TIMEOUT,
                close_timeout=1.0,
                ping_interval=TIMEOUT,
                ping_timeout=TIMEOUT,
                proxy=None,
            ) as connection:
                if connection.subprotocol is None:
                    return _NOT_FOXGLOVE
                self._connection = connection
                await self._read(connection)
        except ProtocolError as error:
            return f"it sent {error}"
        except ConnectionClosed as error:
            return _of_closed(error)
        except Exception as error:
            # Any error that a server causes is reported: otherwise the thread would end silently.
            return _of_failure(error)
        finally:
            self._connection = None
        return "the server has closed it"

    async def _read(self, connection: ClientConnection) -> None:
        """Process the messages of a connection until the connection ends."""
        self._heard.clear()
        self._subscriptions.clear()
        self._refusals.clear()
        quiet: asyncio.TimerHandle | None = None
        try:
            async for message in connection:
                if isinstance(message, bytes):
                    self._take_binary(message)
                    continue
                await self._take_text(connection, message)
                if not self._first.is_set():
                    if quiet is not None:
                        quiet.cancel()
                    if self._state.name:
                        quiet = self._loop.call_later(QUIET, self._first.set)
        finally:
            if quiet is not None:
                quiet.cancel()

    def _take_binary(self, frame: bytes) -> None:
        found = protocol.message_data(frame)
        if found is not None:
            number, payload = found
            channel = self._heard.get(number)
            # A message that was sent before its subscription ended has no channel any more.
            if channel is not None:
                data = FoxgloveData(channel, payload)
                self._inbox.put(self._receiver.data, data, len(payload))
            return
        stamp = protocol.server_time(frame)
        if stamp is not None:
            self._inbox.put(self._receiver.time, stamp, len(frame))

    async def _take_text(self, connection: ClientConnection, text: str) -> None:
        with self._lock:
            operation = self._state.take(text)
            warnings, self._state.warnings = self._state.warnings, []
        for one in warnings:
            if not self._ask_again_later(one):
                self._warn(f"{self._place} says: {one}")
        if operation == "serverInfo" and "connectionGraph" in self._state.capabilities:
            await connection.send(protocol.request("subscribeConnectionGraph"))
        if operation in ("advertise", "unadvertise"):
            self._subscribe()
        if operation and operation != "status":
            self._tell_change()

    def _tell_change(self) -> None:
        """Report that the server's announcements changed, once for several quick changes."""
        with self._lock:
            is_due, self._is_change_due = self._is_change_due, True
        if not is_due:
            self._inbox.put(self._changed, None)

    def _changed(self, _: None) -> None:
        with self._lock:
            self._is_change_due = False
        self._receiver.changed(None)

    def _warn(self, sentence: str) -> None:
        # With a size, so that the inbox can drop it: a server may send many texts.
        self._inbox.put(self._receiver.warn, sentence, len(sentence))

    # Subscriptions

    def _want(self, topic: tuple[str, str], again: bool) -> None:
        is_new = topic not in self._wanted
        self._wanted.add(topic)
        if again and not is_new:
            self._unsubscribe([one for one in self._subscriptions if self._topic_of(one) == topic])
        self._subscribe()

    def _forget(self, topic: tuple[str, str]) -> None:
        self._wanted.discard(topic)
        self._unsubscribe([one for one in self._subscriptions if self._topic_of(one) == topic])

    def _topic_of(self, channel: int) -> tuple[str, str]:
        return ros_topic(self._heard[self._subscriptions[channel]])

    def _subscribe(self) -> None:
        """Subscribe to wanted channels, and unsubscribe from channels that are gone or changed."""
        channels = self._state.channels
        gone = [
            number
            for number, subscription in self._subscriptions.items()
            if channels.get(number) != self._heard[subscription]
        ]
        self._unsubscribe(gone)
        asked = []
        for number, channel in channels.items():
            if number in self._subscriptions or ros_topic(channel) not in self._wanted:
                continue
            self._count += 1
            self._subscriptions[number] = self._count
            self._heard[self._count] = channel
            asked.append({"id": self._count, "channelId": number})
        if asked:
            self._send(protocol.request("subscribe", subscriptions=asked))

    def _ask_again_later(self, sentence: str) -> bool:
        """Subscribe again later if a server's warning says that a subscription was refused.

        Return whether the warning says this.

        Servers made with Foxglove's SDK announce a channel slightly before the channel accepts
        subscriptions. The server refuses a quick subscription, and without a second subscription no
        message would ever arrive.
        """
        found = _REFUSED.search(sentence)
        channel = int(found[1] or found[2]) if found else None
        if channel not in self._subscriptions:
            return False
        self._refusals[channel] += 1
        if self._refusals[channel] > _MOST_REFUSED:
            return False
        self._loop.call_later(_AGAIN, self._ask_again, channel, self._subscriptions[channel])
        return True

    def _ask_again(self, channel: int, subscription: int) -> None:
        if self._subscriptions.get(channel) == subscription:
            asked = [{"id": subscription, "channelId": channel}]
            self._send(protocol.request("subscribe", subscriptions=asked))

    def _unsubscribe(self, channels: Sequence[int]) -> None:
        ended = [self._subscriptions.pop(number) for number in channels]
        for subscription in ended:
            del self._heard[subscription]
        if ended:
            self._send(protocol.request("unsubscribe", subscriptionIds=ended))

    def _send(self, text: str) -> None:
        if self._connection is not None:
            self._start(self._connection.send(text))

    def _start(self, work: Coroutine[Any, Any, None]) -> None:
        async def done() -> None:
            # The reader also notices that the connection was closed, and reports the reason.
            with contextlib.suppress(ConnectionClosed):
                await work

        self._tasks.start(done())


def _of_closed(error: ConnectionClosed) -> str:
    """Return the reason why a connection ended, as the end of a sentence."""
    close = error.rcvd or error.sent
    if close is None:
        return "it broke off"
    if close.code == 1009:
        return f"it sent a message of more than {protocol.LARGEST >> 20} MB"
    if close.code in (1000, 1001):
        return "the server has closed it"
    return f"closed with {close.code} {close.reason}".rstrip()


def _of_failure(error: Exception) -> str:
    """Return the reason why a connection could not be made, as the end of a sentence."""
    if isinstance(error, ssl.SSLCertVerificationError):
        return (
            f"its certificate is not trusted: {error.verify_message} (set SSL_CERT_FILE to "
            "the certificate of the authority that signed it)"
        )
    if isinstance(error, TimeoutError):
        return "it does not answer"
    if isinstance(error, InvalidStatus):
        return f"it answers with HTTP {error.response.status_code}"
    if isinstance(error, NegotiationError):
        return _NOT_FOXGLOVE
    if isinstance(error, InvalidMessage):
        return "the program at this address is not a web server"
    if isinstance(error, OSError):
        # asyncio replaces the system's error text, and joins the texts of several addresses.
        found = re.search(r"\[Errno (\d+)\]", str(error))
        return os.strerror(int(found[1])) if found else error.strerror or str(error)
    return str(error)
