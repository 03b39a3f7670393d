"""Hints for the user about transform lookups that fail repeatedly."""

from collections.abc import Iterator
from typing import Any

from tftool.base.errors import (
    ConnectivityException,
    ExtrapolationException,
    LookupException,
    TransformException,
)
from tftool.base.stamps import Stamp, as_seconds, seconds
from tftool.buffer.buffer import Buffer as Frames
from tftool.buffer.sample import FrameInfo
from tftool.ros.host.program import Program
from tftool.world.endpoints import PUBLISHER

PATIENCE = seconds(3.0)
"""Nanoseconds of failures, without a success, after which the reason is logged."""

MANY = 10
"""Number of lookups at times newer than the data after which a hint is logged."""

ONCE = seconds(2.0)
"""Nanoseconds of age after which a frame's only sample counts as sent once."""


TIME_SOURCE = "time source"
"""Key of the hint that a node needs `use_sim_time`."""


class LookupHints:
    """Record of the lookups in one buffer, which logs hints about repeated failures.

    Each hint is logged once, as a warning of the program that uses the buffer.

    Attributes:
        has_listener: Whether a TransformListener inserts transforms into the buffer.
    """

    def __init__(self, program: Program, frames: Frames) -> None:
        self._program = program
        self._frames = frames
        self._said: set[str] = set()
        self._refused_since: dict[tuple[str, str], Stamp] = {}
        self._asked = 0
        self._early = 0
        self._just_in_time = 0
        self._waits = False
        self.has_listener = False
        program.advice.append(self.summary)

    def record_wait(self) -> None:
        """Record that the program waits for transforms, or tests whether they are available."""
        self._waits = True
        self._check_source_of_time()

    def record_success(self, target: str, source: str, time: Stamp) -> None:
        """Record a lookup that succeeded."""
        self._asked += 1
        self._check_source_of_time()
        self._refused_since.pop((target, source), None)
        # On simulated time a transform arrives in the instant of its stamp; over a network it does
        # not.
        if time and not self._waits and self._program.strict and time == self._program.clock.now():
            self._just_in_time += self._frames.newest_common(target, source) != 0

    def record_failure(self, target: str, source: str, error: TransformException) -> None:
        """Record a lookup that failed; log the reason if it has failed for a long time."""
        self._asked += 1
        self._check_source_of_time()
        now = self._program.clock.now()
        since = self._refused_since.setdefault((target, source), now)
        lasts = now - since >= PATIENCE
        if isinstance(error, LookupException | ConnectivityException):
            self._hint_that_nothing_arrives()
            if lasts and isinstance(error, LookupException):
                self._say_missing(error)
        elif isinstance(error, ExtrapolationException):
            # The age of transforms counts on the clock of their stamps.
            present = next((clock.reading() for clock in self._clocks_by_messages()), now)
            once = next(self._sent_once(target, source, present), None) if lasts else None
            if once is not None:
                # The time is not the cause of these failures.
                self._early = 0
                self._say(
                    f"once {once.frame}",
                    f"'{once.frame}' was sent once, at {as_seconds(once.newest):.3f} s: "
                    "send a transform that never changes with a StaticTransformBroadcaster, and "
                    "any other transform repeatedly",
                )
            elif error.requested > error.available:
                self._early += 1
                if (
                    self._early >= MANY
                    and not (self._program.strict or TIME_SOURCE in self._said)
                    and self._is_early
                ):
                    self._say("early", self._early_text())

    def record_failed_check(self, target: str, source: str) -> None:
        """Record a `can_transform` that returned False; log the reason after many seconds."""
        self._waits = True
        self._hint_that_nothing_arrives()
        now = self._program.clock.now()
        since = self._refused_since.setdefault((target, source), now)
        if now - since >= PATIENCE:
            try:
                self._frames.lookup_transform(target, source)
            except LookupException as error:
                self._say_missing(error)
            except TransformException:
                pass

    def _check_source_of_time(self) -> None:
        """Log a warning if a node publishes `/clock` but the program's nodes do not use that time.

        In this case, the stamps of the transforms are probably times of `/clock`.
        """
        world = self._program.world
        if (
            TIME_SOURCE not in self._said
            and not world.has_own_time
            and world.endpoints.of("clock", PUBLISHER)
            and not any(self._clocks_by_messages())
        ):
            self._say(
                TIME_SOURCE,
                "the stamps of the transforms may be times of /clock, but the nodes of this "
                "program use the machine's time: set use_sim_time, as with --ros-args "
                "-p use_sim_time:=true",
            )

    def _clocks_by_messages(self) -> Iterator[Any]:
        """Yield the clocks of the program's nodes that show the time of `/clock`."""
        clocks = (state.ros_node.get_clock() for state in self._program.nodes)
        return (clock for clock in clocks if clock.is_overridden)

    def summary(self) -> str:
        """Return a hint about lookups at times newer than the data; "" if there were few."""
        return self._early_text() if self._is_early else ""

    @property
    def _is_early(self) -> bool:
        early = self._early + self._just_in_time
        return early >= 3 and 5 * early >= self._asked

    def _early_text(self) -> str:
        text = f"{self._early} of {self._asked} lookups asked for a time newer than the transforms"
        if self._just_in_time:
            text += (
                f". {self._just_in_time} lookups asked for exactly the stamp of a transform; on a "
                "real robot that transform arrives too late"
            )
        return f"{text}: look up Time(), the latest time, or give a timeout"

    def _sent_once(self, target: str, source: str, now: Stamp) -> Iterator[FrameInfo]:
        """Yield `target`, `source` and their ancestors whose only transform was sent long ago."""
        infos = {info.frame: info for info in self._frames.snapshot(now).frames}
        for frame in (target, source):
            seen: set[str] = set()
            info = infos.get(frame)
            while info is not None and info.parent is not None and info.frame not in seen:
                # Samples without a stamp replace each other, and the broadcaster warns about them.
                is_single = info.samples == 1 and not info.is_static and info.newest > 0
                if is_single and info.age >= ONCE:
                    yield info
                seen.add(info.frame)
                info = infos.get(info.parent)

    def _hint_that_nothing_arrives(self) -> None:
        """Log why no transform has arrived, if the buffer is still empty."""
        owner = self._program
        if self._frames.frames():
            return
        if not self.has_listener:
            why = "nothing fills this buffer: create and store a TransformListener(buffer, node)"
        elif any(one.was_served for one in owner.nodes):
            return
        else:
            why = (
                "nothing has arrived yet, as the node has not been spun: look up in a timer's "
                "callback, or give the lookup a timeout"
            )
        self._say("nothing", f"a lookup failed because {why}")

    def _say_missing(self, error: LookupException) -> None:
        if error.frame is not None and "nothing" not in self._said:
            self._say(f"frame {error.frame}", error.remedy)

    def _say(self, what: str, text: str) -> None:
        if what not in self._said:
            self._said.add(what)
            self._program.say("WARN", self._program.name, text)
