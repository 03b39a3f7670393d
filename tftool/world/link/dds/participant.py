"""This process as a DDS participant: its readers and writers, and their threads.

This module imports `cyclonedds`. Therefore the module is imported only when a process joins a DDS
domain. Callbacks in the library's threads go through an inbox to the event loop. Written data goes
through an outbox.
"""

import contextlib
import ctypes
import os
import re
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from typing import Any, Final

from cyclonedds.builtin import BuiltinDataReader
from cyclonedds.core import DDSException, Listener, Policy, Qos
from cyclonedds.domain import Domain, DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

from tftool.base.errors import LinkError
from tftool.base.plain_text import shorten
from tftool.base.stamps import Stamp
from tftool.world.endpoints import Quality
from tftool.world.link.dds.dds_types import Raw
from tftool.world.link.dds.settings import MOST_PARTICIPANTS, Network
from tftool.world.link.queues import Inbox, Outbox
from tftool.world.link.seam import nothing
from tftool.world.log import Repeats

_MOST: Final = 160
"""Longest part of an error that is passed on; the bytes of the packet follow it."""

_STAMP: Final = re.compile(r"^[\d.]+ (\[\w*\])?\s*")
_NUMBER: Final = re.compile(r"[0-9a-f.]*\d[0-9a-f.]*")


class LibraryLog:
    """Error output of the DDS library, read through a pipe and passed to listeners.

    The library has no function that redirects errors. A domain keeps the value that C's variable
    `stderr` has when the domain is created. Therefore `stderr` is a pipe while a domain is created.
    Writing to the pipe never blocks, and text that does not fit is dropped, because the library
    holds locks while it writes.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._listeners: list[Callable[[str], object]] = []
        self._repeats = Repeats()
        self._stream: int | None = None

    def listen(self, callback: Callable[[str], object]) -> Callable[[], None]:
        """Call `callback`, in another thread, with sentences for the user.

        Returns:
            A function that ends the calls.
        """
        with self._lock:
            self._listeners.append(callback)

        def stop() -> None:
            with self._lock:
                self._listeners.remove(callback)

        return stop

    @contextmanager
    def taking(self) -> Iterator[None]:
        """Capture the errors of a domain that is created in this block.

        On platforms where C's `stderr` is not a variable, such as Windows, nothing is captured.
        """
        try:
            c = ctypes.CDLL(None)
            stderr = ctypes.c_void_p.in_dll(
                c, "__stderrp" if sys.platform == "darwin" else "stderr"
            )
        except (OSError, TypeError, ValueError):
            # On Windows, and if C's `stderr` is not a variable, the errors stay on stderr.
            yield
            return
        before = stderr.value
        stderr.value = self._open(c)
        try:
            yield
        finally:
            # Only the domain uses the pipe; the rest of the process continues to use stderr.
            stderr.value = before

    def _open(self, c: ctypes.CDLL) -> int:
        """Return the C stream that leads into the pipe; create the stream at the first call."""
        if self._stream is None:
            # Never closed, because the library may write even while the process ends.
            read, write = os.pipe()
            os.set_blocking(write, False)
            c.fdopen.restype = ctypes.c_void_p
            stream: int = c.fdopen(write, b"w")
            # Unbuffered, so that an error is readable at once.
            c.setbuf(ctypes.c_void_p(stream), None)
            self._stream = stream
            threading.Thread(target=self._read, args=(read,), name="dds-log", daemon=True).start()
        return self._stream

    def _read(self, read: int) -> None:
        with os.fdopen(read, encoding="utf-8", errors="replace") as lines:
            for line in lines:
                text = _STAMP.sub("", line.strip())
                # Errors that differ only in addresses and counts are of the same kind.
                kind = _NUMBER.sub("#", text)[:40]
                said = self._repeats.said(kind, f"The DDS library: {shorten(text, _MOST)}")
                if not said:
                    continue
                with self._lock:
                    # Listeners are called without the lock, because they may remove themselves.
                    listeners = tuple(self._listeners)
                for listener in listeners:
                    listener(said)


LIBRARY_LOG: Final = LibraryLog()
"""Only instance, because a process has one `stderr`."""


LARGEST: Final = 64 * 1024 * 1024
"""Largest received message in bytes; larger ones are dropped."""

AT_ONCE: Final = 256
"""Largest number of messages taken from a reader at once."""

PATIENCE: Final = 1_000_000_000
"""Nanoseconds that a reliable writer waits for a reader that has not taken earlier messages."""


@dataclass(frozen=True, slots=True)
class DdsSample:
    """Received message.

    Attributes:
        payload: Message in CDR (ROS 2's serialised form).
        writer: Number of the writer in the library.
    """

    payload: bytes
    writer: int


class Domains:
    """Use counts of DDS domains in this process; all uses of a domain share its configuration."""

    def __init__(self) -> None:
        self._held: dict[int, tuple[Any, str, int]] = {}
        self._lock = threading.Lock()

    def enter(self, number: int, network: Network) -> None:
        """Count one use of the domain `number`, and open the domain at the first use.

        Raises:
            LinkError: If the domain is open with another configuration, or cannot be opened.
        """
        config = network.xml()

        with self._lock:
            made, known, count = self._held.get(number, (None, config, 0))
            if known != config:
                raise LinkError(
                    f"this process already uses DDS domain {number} on another network: choose "
                    "another domain, or the same --dds-on"
                )
            if made is None:
                # A user's own configuration decides where the library's errors go.
                taking = nullcontext() if network.config else LIBRARY_LOG.taking()
                try:
                    with taking:
                        made = Domain(number, config)
                except (DDSException, UnicodeEncodeError) as error:
                    raise LinkError(_refused(number, network)) from error
            self._held[number] = made, config, count + 1

    def leave(self, number: int) -> None:
        """Undo one call of `enter`; close the domain after the last use."""
        with self._lock:
            made, config, count = self._held.pop(number)
            if count > 1:
                self._held[number] = made, config, count - 1
            else:
                _end(made)


_DOMAINS: Final = Domains()


class Participant:
    """Participant in one DDS domain, with its readers and writers.

    Attributes:
        entity: Participant object of the library.
        gid: GUID of 16 bytes.
        oversized: Number of received messages that were larger than `LARGEST`.
    """

    def __init__(self, domain: int, network: Network, name: str, user_data: bytes) -> None:
        """Join a domain.

        Args:
            domain: Number of the domain.
            network: Network in which to search for other participants.
            name: Name that other participants see.
            user_data: User data that other participants see.

        Raises:
            LinkError: If the domain cannot be joined.
        """
        self._domain = domain
        self.oversized = 0
        self.inbox = Inbox()
        self._outbox = Outbox()
        self._closing: list[Callable[[], None]] = []
        self._topics: dict[tuple[str, type[Raw]], Any] = {}
        # The library reads a domain's configuration when its first participant is created, and only
        # then.
        _DOMAINS.enter(domain, network)
        try:
            qos = Qos(Policy.EntityName(name), Policy.Userdata(user_data))
            self.entity: Any = DomainParticipant(domain, qos=qos)
        except DDSException as error:
            _DOMAINS.leave(domain)
            raise LinkError(_refused(domain, network)) from error
        # Also on Ctrl-C: the domain must not stay marked as used.
        except BaseException:
            _DOMAINS.leave(domain)
            raise
        self.gid: bytes = self.entity.guid.bytes

    def close(self) -> None:
        """Send queued messages, and leave the domain; no callback follows."""
        self.inbox.close()
        self._outbox.close()
        for close in self._closing:
            close()
        self._closing.clear()
        if self.entity is not None:
            # This also deletes the readers and writers.
            _end(self.entity)
            self._topics.clear()
            self.entity = None
            _DOMAINS.leave(self._domain)

    def reader(
        self,
        topic: str,
        kind: type[Raw],
        quality: Quality,
        on_sample: Callable[[DdsSample], object],
        on_refused: Callable[[int], object] | None = None,
    ) -> "TopicReader":
        """Create a reader of a topic; the event loop calls `on_sample` with the messages.

        Args:
            topic: Name of the topic in DDS.
            kind: Class of the messages.
            quality: Requested quality of service.
            on_sample: Function called with every message.
            on_refused: Function called with the number of the QoS policy that excludes a writer.
        """
        inbox, participant = self.inbox, self

        # Both functions run in threads of the library: they only fill the inbox.
        def on_data_available(reader: Any) -> None:
            # The library's C code would only print an exception.
            with contextlib.suppress(Exception):
                participant._take(reader, on_sample)

        def on_requested_incompatible_qos(_: Any, status: Any) -> None:
            if on_refused is not None:
                inbox.put(on_refused, int(status.last_policy_id))

        # All samples are stored: they are taken at once, and the inbox has the limits.
        policies = _policies(quality, Policy.History.KeepAll)
        # Messages between our own nodes do not use the network.
        policies.append(Policy.IgnoreLocal.Participant)
        # While the library creates a reader, it may hold the lock of a writer of this process,
        # whose thread holds Python's own lock (GIL) and waits for the writer's. A callback for data
        # needs the GIL, so it is set after the creation: otherwise both threads wait forever.
        refusing = Listener(on_requested_incompatible_qos=on_requested_incompatible_qos)
        made = DataReader(
            self.entity, self._topic(topic, kind), qos=_qos(policies), listener=refusing
        )
        made.set_listener(Listener(on_data_available=on_data_available))
        # Samples that arrived before caused no callback.
        self._take(made, on_sample)
        return TopicReader(made)

    def writer(
        self, topic: str, kind: type[Raw], quality: Quality, user_data: bytes
    ) -> "TopicWriter":
        """Create a writer of a topic.

        Args:
            topic: Name of the topic in DDS.
            kind: Class of the messages.
            quality: Offered quality of service.
            user_data: User data of the writer: the hash of its type.
        """
        kept = Policy.History.KeepLast(max(1, quality.depth))
        # Samples that are not stored for late readers are stored until present readers have them.
        keeps_all = quality.keeps_all or (quality.is_reliable and not quality.is_latched)
        policies = _policies(quality, Policy.History.KeepAll if keeps_all else kept)
        policies.append(Policy.Userdata(user_data))
        if quality.is_latched and not quality.keeps_all:
            policies.append(Policy.DurabilityService(0, kept, -1, -1, -1))
        made = DataWriter(self.entity, self._topic(topic, kind), qos=_qos(policies))
        return TopicWriter(made, kind, self._outbox, keeps=quality.is_latched)

    def builtin(self, topic: Any, on_change: Callable[[], object]) -> Any:
        """Return a reader of one of the library's built-in topics.

        Args:
            topic: Built-in topic, a class of the library.
            on_change: Function called, in a thread of the library, when there is a new message.
        """

        class Telling(Listener):  # type: ignore[misc]
            def on_data_available(self, reader: Any) -> None:
                on_change()

        return BuiltinDataReader(self.entity, topic, listener=Telling())

    def tell(self, user_data: bytes) -> None:
        """Replace the participant's user data, which other participants see."""
        self.entity.set_qos(Qos(Policy.Userdata(user_data)))

    def at_close(self, close: Callable[[], None]) -> None:
        """Register a function to call before the participant is deleted."""
        self._closing.append(close)

    def _topic(self, name: str, kind: type[Raw]) -> Any:

        key = name, kind
        if key not in self._topics:
            try:
                self._topics[key] = Topic(self.entity, name, kind)
            except DDSException as error:
                raise LinkError(f"DDS cannot create the topic '{name}' ({error})") from error
        return self._topics[key]

    def _take(self, reader: Any, on_sample: Callable[[DdsSample], object]) -> None:
        """Pass a reader's received messages to the inbox; called in the library's threads."""
        while True:
            taken = reader.take(AT_ONCE)
            for one in taken:
                # A writer's departure is reported as a sample without data.
                if not isinstance(one, Raw):
                    continue
                if len(one.payload) > LARGEST:
                    self.oversized += 1
                    continue
                sample = DdsSample(one.payload, one.sample_info.publication_handle)
                self.inbox.put(on_sample, sample, len(one.payload))
            if len(taken) < AT_ONCE:
                return


class TopicReader:
    """Reader of a topic, which can be closed."""

    def __init__(self, made: Any) -> None:
        self._made = made
        self.gid: bytes = made.guid.bytes

    def close(self) -> None:
        """Close the reader; no further message is passed on."""
        made, self._made = self._made, None
        if made is not None:
            _end(made)

    @property
    def writers(self) -> int:
        """Number of writers that match this reader."""
        return 0 if self._made is None else len(self._made.get_matched_publications())


class TopicWriter:
    """Writer of a topic, which can be closed; see `seam.WirePublisher`.

    Attributes:
        gid: GUID of 16 bytes.
        hide: Function that removes this writer from the announced writers of its node.
    """

    def __init__(self, made: Any, kind: type[Raw], outbox: Outbox, *, keeps: bool) -> None:
        self._made = made
        self._kind = kind
        self._outbox = outbox
        self._keeps = keeps
        self.gid: bytes = made.guid.bytes
        self.hide: Callable[[], None] = nothing

    @property
    def is_wanted(self) -> bool:
        """Whether a message would reach a reader, or be stored for late readers."""
        return self._made is not None and (self._keeps or self.readers > 0)

    @property
    def readers(self) -> int:
        """Number of readers that match this writer."""
        return int(self._made.get_publication_matched_status().current_count)

    def put(self, payload: bytes, stamp: Stamp = 0) -> None:
        """Queue a message for sending; `stamp` is ignored, because DDS stamps messages itself.

        Raises:
            LinkError: If the participant is closed.
        """
        made = self._made
        if made is not None:
            self._outbox.put(lambda: made.write(self._kind(payload)), len(payload))

    def close(self) -> None:
        """Close the writer after all queued messages are sent."""
        made, self._made = self._made, None
        if made is None:
            return
        # Hidden first, because the announcement must not list a deleted writer.
        self.hide()
        try:
            self._outbox.put(lambda: _end(made))
        except LinkError:
            _end(made)


def _end(entity: Any) -> None:
    """Delete an object of the library now, even if references to the object still exist.

    The library itself deletes an object only with the last reference.
    """
    entity.__del__()


def _policies(quality: Quality, history: Any) -> list[Any]:

    return [
        Policy.Reliability.Reliable(PATIENCE)
        if quality.is_reliable
        else Policy.Reliability.BestEffort,
        Policy.Durability.TransientLocal if quality.is_latched else Policy.Durability.Volatile,
        history,
        # ROS 2 uses this encoding only.
        Policy.DataRepresentation(use_cdrv0_representation=True, use_xcdrv2_representation=False),
    ]


def _qos(policies: list[Any]) -> Any:

    return Qos(*policies)


def _refused(domain: int, network: Network) -> str:
    if network.config:
        return (
            "Cyclone DDS refuses the configuration in the environment variable CYCLONEDDS_URI for "
            f"DDS domain {domain}: correct the configuration, or unset the variable"
        )
    return (
        f"tftool cannot create a participant in DDS domain {domain} on {network}: all "
        f"{MOST_PARTICIPANTS + 1} participant numbers of this machine are in use (end some "
        "programs, or choose another --domain), or another program uses the domain's ports"
    )
