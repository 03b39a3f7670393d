"""Recorders of a world's transforms, in a buffer and a list, and of message headers."""

import asyncio
from collections.abc import Callable, Coroutine, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final, TypeVar

from tftool.base.stamps import NANOSECONDS, Duration
from tftool.buffer.buffer import NO_LIMIT, Buffer
from tftool.frames.transform_log import TransformLog
from tftool.messages.classes import INTERFACES
from tftool.world.clock import Clock, run
from tftool.world.endpoints import PUBLISHER, Endpoint
from tftool.world.world import TransformMessage, World

if TYPE_CHECKING:
    from tftool.recordings.contract import Headers

T = TypeVar("T")


@contextmanager
def heard_in(world: World, cache_time: Duration | None) -> Iterator[tuple[Buffer, TransformLog]]:
    """Record a world's transforms in a second buffer, and in a list in order of arrival.

    Args:
        world: World whose transforms are recorded.
        cache_time: Cache time of the second buffer, nanoseconds; None to keep everything. A second
            buffer is needed because the world's own buffer drops old transforms.
    """
    buffer = Buffer(cache_time or NO_LIMIT, max_frames=world.buffer.max_frames)
    log, stop = logged_in(world, buffer)
    try:
        yield buffer, log
    finally:
        stop()


def logged_in(
    world: World, buffer: Buffer | None = None
) -> tuple[TransformLog, Callable[[], None]]:
    """Record a world's transforms in order of arrival; also insert them into `buffer`, if given.

    Returns:
        The record, and a function that ends the recording.
    """
    log = TransformLog()

    def hear(message: TransformMessage, *, is_static: bool) -> None:
        log.hear(world.clock.now(), message.transforms, message.authority, is_static=is_static)
        if buffer is not None:
            set_transform = buffer.set_transform_static if is_static else buffer.set_transform
            for one in message.transforms:
                set_transform(one, message.authority)

    stops = [
        world.tf.subscribe(lambda message: hear(message, is_static=False)),
        world.tf_static.subscribe(lambda message: hear(message, is_static=True)),
    ]

    def stop() -> None:
        for one in stops:
            one()

    return log, stop


def run_apart(clock: Clock, work: Coroutine[Any, Any, T]) -> T:
    """Run a coroutine on a world's clock, in a new thread if this thread has a running loop."""
    try:
        asyncio.get_running_loop()
    except RuntimeError:
        return run(clock, work)
    # Event loops cannot be nested: in a notebook, the caller's loop waits for this thread.
    with ThreadPoolExecutor(1, "tftool.open") as pool:
        return pool.submit(run, clock, work).result()


MOST: Final = 50
"""Largest number of messages received per topic, so that images do not displace other messages."""

MOST_TOPICS: Final = 500

_HEADER: Final = "std_msgs/msg/Header"


class HeaderListener:
    """Recorder of the headers of the first 50 messages on each topic of other processes."""

    def __init__(self) -> None:
        self._world: World | None = None
        self._heard: dict[tuple[str, str], list[tuple[int, int, str]]] = {}
        self._stops: dict[tuple[str, str], Callable[[], None]] = {}
        self._is_looking = False

    def begin(self, world: World) -> None:
        """Subscribe to all present and future topics of the other processes in a world."""
        self._world = world
        world.watch(self._look, "doctor")

    def _look(self) -> None:
        # Subscribing changes the world, which calls this function again.
        if self._is_looking or self._world is None:
            return
        self._is_looking = True
        try:
            for topic in self._world.endpoints.topics():
                for one in self._world.endpoints.of(topic, PUBLISHER):
                    self._subscribe(self._world, one)
        finally:
            self._is_looking = False

    def _subscribe(self, world: World, publisher: Endpoint) -> None:
        key = publisher.topic, publisher.interface
        is_known = key in self._heard or len(self._heard) >= MOST_TOPICS
        if is_known or not publisher.is_remote or not _has_header(publisher.interface):
            return
        rows = self._heard[key] = []

        def hear(message: Any) -> None:
            if len(rows) < MOST:
                stamp = message.header.stamp
                time = stamp.sec * NANOSECONDS + stamp.nanosec
                rows.append((time, world.clock.now(), message.header.frame_id))
            elif key in self._stops:
                self._stops.pop(key)()

        kind = INTERFACES.message(publisher.interface)
        self._stops[key] = world.topic(publisher.topic, kind).subscribe(hear, "doctor")

    def headers(self) -> "dict[str, Headers]":
        """Return the received headers by topic: arrays of stamps, arrival times and frame ids."""
        # Imported here because most worlds are never judged, and need no numpy.
        from tftool.recordings.contract import Headers

        return {
            f"/{topic}": Headers.of_rows(f"/{topic}", interface.replace("/msg/", "/"), rows)
            for (topic, interface), rows in self._heard.items()
            if rows
        }


def _has_header(interface: str) -> bool:
    if not INTERFACES.has(interface):
        return False
    fields = INTERFACES.structure(interface).fields
    return bool(fields) and (fields[0].name, fields[0].type) == ("header", _HEADER)
