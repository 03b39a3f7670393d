"""Headers of a session's messages, for the doctor."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

from tftool.base.stamps import NANOSECONDS
from tftool.messages.classes import INTERFACES
from tftool.world.endpoints import PUBLISHER, Endpoint
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.recordings.contract import Headers

MOST: Final = 50
"""Messages of each topic that are heard: images would take the place of everything else."""

MOST_TOPICS: Final = 500

_HEADER: Final = "std_msgs/msg/Header"


class HeaderListener:
    """Subscriber to the first messages of each topic whose type begins with a header."""

    def __init__(self) -> None:
        self._world: World | None = None
        self._heard: dict[tuple[str, str], list[tuple[int, int, str]]] = {}
        self._stops: dict[tuple[str, str], Callable[[], None]] = {}
        self._is_looking = False

    def begin(self, world: World) -> None:
        """Subscribe to what other processes publish, now and later."""
        self._world = world
        world.watch(self._look, "doctor")

    def _look(self) -> None:
        # To subscribe changes the world, which calls this again.
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
        """Return the received headers in columns, by topic."""
        import numpy as np  # most worlds are never judged

        from tftool.recordings.contract import Headers

        found = {}
        for (topic, interface), rows in self._heard.items():
            if not rows:
                continue
            names = tuple(dict.fromkeys(frame for _, _, frame in rows))
            found[f"/{topic}"] = Headers(
                f"/{topic}",
                interface.replace("/msg/", "/"),
                np.array([stamp for stamp, _, _ in rows], dtype=np.int64),
                np.array([heard for _, heard, _ in rows], dtype=np.int64),
                names,
                np.array([names.index(frame) for _, _, frame in rows], dtype=np.int32),
            )
        return found


def _has_header(interface: str) -> bool:
    if not INTERFACES.has(interface):
        return False
    fields = INTERFACES.structure(interface).fields
    return bool(fields) and (fields[0].name, fields[0].type) == ("header", _HEADER)
