"""What may be asked of a scenario: the questions of its expectations, as dataclasses.

Each field names the reader of its value. `expectations` answers them.
"""

from dataclasses import dataclass
from typing import ClassVar

from tftool.runtime.log import LEVELS
from tftool.scenario import values
from tftool.scenario.reading import reads
from tftool.scenario.values import Moment
from tftool.stamps import Duration, seconds


@dataclass(frozen=True, slots=True, kw_only=True)
class Lookup:
    """The pose of `source` in `target` at a moment, or through a fixed frame at two."""

    target: str = reads(values.frame)
    source: str = reads(values.frame)
    time: Moment | None = reads(values.moment, None)
    target_time: Moment | None = reads(values.moment, None)
    source_time: Moment | None = reads(values.moment, None)
    fixed: str | None = reads(values.frame, None)

    @property
    def problem(self) -> str:
        """What is wrong with the whole, empty when nothing is."""
        return _two_times(self.time, self.target_time, self.source_time, self.fixed)

    def __str__(self) -> str:
        if self.fixed is None:
            return f"{self.source} in {self.target}{self.when}"
        source, target = _at(self.source, self.source_time), _at(self.target, self.target_time)
        return f"{source} in {target}, through {self.fixed},"

    @property
    def when(self) -> str:
        """The one moment asked about, in words; empty for the latest."""
        return "" if self.time is None else f" ({self.time})"


@dataclass(frozen=True, slots=True, kw_only=True)
class Between:
    """Two frames, the second one seen from the first; see `Lookup` for the times."""

    start: str = reads(values.frame, key="from")
    end: str = reads(values.frame, key="to")
    time: Moment | None = reads(values.moment, None)
    start_time: Moment | None = reads(values.moment, None, key="from_time")
    end_time: Moment | None = reads(values.moment, None, key="to_time")
    fixed: str | None = reads(values.frame, None)

    @property
    def problem(self) -> str:
        """What is wrong with the whole, empty when nothing is."""
        return _two_times(self.time, self.start_time, self.end_time, self.fixed)

    @property
    def lookup(self) -> Lookup:
        """The lookup that answers it."""
        return Lookup(
            target=self.start,
            source=self.end,
            time=self.time,
            target_time=self.start_time,
            source_time=self.end_time,
            fixed=self.fixed,
        )


class Distance(Between):
    """How far the origins of two frames are apart."""

    def __str__(self) -> str:
        if self.fixed is None:
            return f"distance from {self.start} to {self.end}{self.lookup.when}"
        start, end = _at(self.start, self.start_time), _at(self.end, self.end_time)
        return f"distance from {start} to {end}, through {self.fixed},"


class Bearing(Between):
    """In which direction, seen from one frame, another one lies."""

    def __str__(self) -> str:
        if self.fixed is None:
            return f"bearing of {self.end} from {self.start}{self.lookup.when}"
        start, end = _at(self.start, self.start_time), _at(self.end, self.end_time)
        return f"bearing of {end} from {start}, through {self.fixed},"


def _at(frame: str, time: Moment | None) -> str:
    return f"{frame} ({time or Moment()})"


def _two_times(
    time: Moment | None, target_time: Moment | None, source_time: Moment | None, fixed: str | None
) -> str:
    if fixed is None and (target_time or source_time):
        return "two times need a fixed frame to go through: 'fixed'"
    if fixed is not None and time is not None:
        return "through a fixed frame there are two times, not one 'time'"
    return ""


@dataclass(frozen=True, slots=True, kw_only=True)
class PointOf:
    """Where a point fixed in one frame lies in another."""

    frame: str = reads(values.frame, key="of")
    target: str = reads(values.frame, key="in")
    x: float = reads(values.length, 0.0)
    y: float = reads(values.length, 0.0)
    z: float = reads(values.length, 0.0)
    time: Moment = reads(values.moment, Moment())

    def __str__(self) -> str:
        return f"point ({self.x:g}, {self.y:g}, {self.z:g}) of {self.frame} in {self.target}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Motion:
    """How one frame moves in another, taken over a while."""

    frame: str = reads(values.frame, key="of")
    target: str = reads(values.frame, key="in")
    time: Moment = reads(values.moment, Moment())
    over: Duration = reads(values.period, seconds(0.1))


class SpeedOf(Motion):
    """How fast the origin of a frame moves."""

    def __str__(self) -> str:
        return f"speed of {self.frame} in {self.target}"


class TurnRateOf(Motion):
    """How fast a frame turns about the z axis, anticlockwise."""

    def __str__(self) -> str:
        return f"turn rate of {self.frame} in {self.target}"


@dataclass(frozen=True, slots=True, kw_only=True)
class RateOf:
    """At which rate a frame comes in."""

    short: ClassVar[str] = "frame"
    frame: str = reads(values.frame)

    def __str__(self) -> str:
        return f"rate of {self.frame}"


@dataclass(frozen=True, slots=True, kw_only=True)
class AgeOf:
    """How old a frame's newest sample is."""

    short: ClassVar[str] = "frame"
    frame: str = reads(values.frame)

    def __str__(self) -> str:
        return f"age of {self.frame}"


@dataclass(frozen=True, slots=True, kw_only=True)
class MemoryOf:
    """How far back a frame is remembered: newest minus oldest sample."""

    short: ClassVar[str] = "frame"
    frame: str = reads(values.frame)

    def __str__(self) -> str:
        return f"remembered span of {self.frame}"


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameOf:
    """Whether a frame is known, under which parent, from whom."""

    short: ClassVar[str] = "name"
    name: str = reads(values.frame)

    def __str__(self) -> str:
        return f"frame {self.name}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Trees:
    """How many trees the frames make."""

    short: ClassVar[str] = "count"
    count: int = reads(values.whole(0, 100_000))

    def __str__(self) -> str:
        return "number of trees"


@dataclass(frozen=True, slots=True, kw_only=True)
class Roots:
    """Which frames hang from nothing."""

    short: ClassVar[str] = "names"
    names: tuple[str, ...] = reads(values.several(values.frame, "frames"))

    def __str__(self) -> str:
        return "roots"


@dataclass(frozen=True, slots=True, kw_only=True)
class Turtles:
    """Which turtles are on the field."""

    short: ClassVar[str] = "names"
    names: tuple[str, ...] = reads(values.several(values.turtle, "turtles"))

    def __str__(self) -> str:
        return "turtles"


@dataclass(frozen=True, slots=True, kw_only=True)
class PoseOf:
    """The pose a turtle published last."""

    short: ClassVar[str] = "turtle"
    turtle: str = reads(values.turtle)

    def __str__(self) -> str:
        return f"pose of {self.turtle}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Logged:
    """How many lines of the log hold a text."""

    short: ClassVar[str] = "text"
    text: str = reads(values.text)
    node: str | None = reads(values.name("a node"), None)
    level: str | None = reads(values.choice(LEVELS, "a level"), None)

    def __str__(self) -> str:
        by = f" by {self.node}" if self.node else ""
        return f"log lines{by} with '{self.text}'"
