"""Readers of single values: numbers with units, names, choices, times.

Every number has a default unit. A scenario may state another unit, such as `30 deg` in place of
radians.
"""

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Decimal
from typing import Literal

from tftool.base.stamps import NANOSECONDS, Duration, Stamp
from tftool.scenario.document import Node, Scalar
from tftool.scenario.fields import Reader, Reading, quoted, suggest

_NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*", re.DOTALL)

_DEGREE = math.pi / 180.0


@dataclass(frozen=True, slots=True)
class Unit:
    """Kind of quantity, such as a length, with the factor of each unit; the first factor is 1."""

    kind: str
    factors: Mapping[str, float]

    @property
    def name(self) -> str:
        """Default unit, for numbers that are written without a unit; "" for plain numbers."""
        return next(iter(self.factors), "")


DURATION = Unit(
    "a duration",
    {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "ns": 1e-9, "min": 60.0, "h": 3600.0},
)
LENGTH = Unit("a length", {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "km": 1e3})
ANGLE = Unit("an angle", {"rad": 1.0, "mrad": 1e-3, "deg": _DEGREE, "°": _DEGREE})
RATE = Unit("a rate", {"Hz": 1.0, "kHz": 1e3})
SPEED = Unit("a speed", {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3})
TURN_RATE = Unit("a turn rate", {"rad/s": 1.0, "deg/s": _DEGREE, "°/s": _DEGREE})
NUMBER = Unit("a number", {})

_UNITS = (DURATION, LENGTH, ANGLE, RATE, SPEED, TURN_RATE)

FARTHEST = 1e9
"""Largest number in a scenario, in its own unit."""

LONGEST = 24 * 3600.0
"""Longest duration in a scenario in seconds: a day."""


def _measure(node: Node, reading: Reading, unit: Unit) -> tuple[str, str]:
    """Split a text into number and unit, and check both; a missing unit becomes the default."""
    text = reading.text(node, unit.kind)
    match = _NUMBER.fullmatch(text)
    if match is None or len(text) > 60:
        example = f" such as 2 {unit.name}" if unit.name else ""
        raise reading.refuse(node, f"{quoted(text)} is not {unit.kind}{example}")
    digits, written = match[1], match[2]
    if written and written not in unit.factors:
        raise reading.refuse(node, f"{quoted(text)} is not {unit.kind}: {_about(written, unit)}")
    # Compared as a float, because 1e999999999 as a Decimal would be written out.
    if not abs(float(digits)) <= FARTHEST:
        raise reading.refuse(node, f"{quoted(text)} is too large: write at most {FARTHEST:.0e}")
    return digits, written or unit.name


def _about(written: str, unit: Unit) -> str:
    if not unit.factors:
        return f"leave out the unit {quoted(written)}"
    may = f"allowed units are {', '.join(unit.factors)}"
    for other in _UNITS:
        if written in other.factors:
            minutes = " (minutes are min)" if (written, unit) == ("m", DURATION) else ""
            return f"{written} is the unit of {other.kind}; {may}{minutes}"
    for known in unit.factors:
        if known.lower() == written.lower():
            return f"{quoted(written)} is not an allowed unit; did you mean '{known}'?"
    return f"{quoted(written)} is not an allowed unit; {may}"


def quantity(unit: Unit, *, least: float = -math.inf) -> Reader:
    """Return a reader of numbers of at least `least`, converted to the default unit."""

    def read(node: Node, reading: Reading) -> float:
        digits, written = _measure(node, reading, unit)
        value = float(digits) * unit.factors.get(written, 1.0)
        if value < least:
            blank = f" {unit.name}" if unit.name else ""
            raise reading.refuse(
                node, f"{value:g}{blank} is not {unit.kind} of {least:g}{blank} or more"
            )
        return value

    return read


def time(*, least: float = 0.0) -> Reader:
    """Return a reader of durations from `least` seconds to a day, exact to the nanosecond."""

    def read(node: Node, reading: Reading) -> Duration:
        digits, written = _measure(node, reading, DURATION)
        exact = Decimal(0)
        if abs(float(digits)) > 1e-30:
            # The factors are powers of ten or integers, so no digit is lost.
            exact = Decimal(digits) * Decimal(repr(DURATION.factors[written]))
        if not least <= float(exact) <= LONGEST:
            raise reading.refuse(
                node, f"{float(exact):g} s is not a duration from {least:g} to {LONGEST:g} s"
            )
        return int((exact * NANOSECONDS).to_integral_value(ROUND_HALF_UP))

    return read


SHORTEST = 1e-3
"""Shortest period in a scenario in seconds, so that a run makes progress."""

duration = time()
period = time(least=SHORTEST)
length = quantity(LENGTH)
distance = quantity(LENGTH, least=0.0)
angle = quantity(ANGLE)
speed = quantity(SPEED)
top_speed = quantity(SPEED, least=0.0)
turn_rate = quantity(TURN_RATE)
rate = quantity(RATE, least=0.0)
number = quantity(NUMBER)
positive = quantity(NUMBER, least=0.0)


def whole(minimum: int, maximum: int) -> Reader:
    """Return a reader of integers from `minimum` to `maximum`."""

    def read(node: Node, reading: Reading) -> int:
        value = quantity(NUMBER)(node, reading)
        if not (value.is_integer() and minimum <= value <= maximum):
            raise reading.refuse(
                node, f"expected a whole number from {minimum} to {maximum}, not {value:g}"
            )
        return int(value)

    return read


def name(noun: str = "a name") -> Reader:
    """Return a reader of names: any printable text that is not blank."""

    def read(node: Node, reading: Reading) -> str:
        value = reading.text(node, noun)
        if not value.strip():
            raise reading.refuse(node, f"expected {noun}, not blanks")
        if not value.isprintable():
            raise reading.refuse(
                node, f"{quoted(value)} contains characters that cannot be printed"
            )
        return value

    return read


frame = name("a frame")

_TOPIC = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


def turtle(node: Node, reading: Reading) -> str:
    """Read a turtle's name: only letters, digits and _, because topic names contain the name."""
    value: str = name("a turtle")(node, reading)
    if _TOPIC.fullmatch(value) is None:
        raise reading.refuse(
            node,
            f"{quoted(value)} is not a valid name of a turtle: use only letters, digits and "
            "_, and no digit first",
        )
    return value


def text(node: Node, reading: Reading) -> str:
    """Read any text; unprintable characters are replaced."""
    value = reading.text(node, "a text")
    return "".join(char if char.isprintable() or char == "\n" else "\ufffd" for char in value)


_TRUTHS = {"true": True, "yes": True, "on": True, "false": False, "no": False, "off": False}


def flag(node: Node, reading: Reading) -> bool:
    """Read true or false; yes, on, no and off are accepted too."""
    value = reading.text(node, "true or false")
    if value.lower() not in _TRUTHS:
        raise reading.refuse(node, f"{quoted(value)} is neither true nor false")
    return _TRUTHS[value.lower()]


def or_none(read_one: Reader) -> Reader:
    """Return a reader that reads None from `none` or an empty value, else uses `read_one`."""

    def read(node: Node, reading: Reading) -> object:
        if isinstance(node, Scalar) and (node.is_nothing or reading.text(node, "") == "none"):
            return None
        return read_one(node, reading)

    return read


def choice(choices: Iterable[str], noun: str) -> Reader:
    """Return a reader that accepts one word of `choices`; `noun` names the value in messages."""
    known = tuple(choices)

    def read(node: Node, reading: Reading) -> str:
        value = reading.text(node, noun)
        if value not in known:
            near = suggest(value, known) or f"; it may be {', '.join(known)}"
            raise reading.refuse(node, f"{quoted(value)} is not {noun}{near}")
        return value

    return read


def words(choices: Iterable[str], noun: str) -> Reader:
    """Return a reader of one or more words of `choices`, separated by blanks."""
    choices = tuple(choices)

    def read(node: Node, reading: Reading) -> tuple[str, ...]:
        found = tuple(reading.text(node, noun).split())
        if not found:
            raise reading.refuse(node, f"expected {noun}, not blanks")
        for word in found:
            if word not in choices:
                near = suggest(word, choices) or f"; it may be {', '.join(choices)}"
                raise reading.refuse(node, f"{quoted(word)} is not {noun}{near}")
        return found

    return read


def several(read_one: Reader, noun: str, count: int | None = None) -> Reader:
    """Return a reader of a list (of `count` items, if given) with `read_one` for each item."""

    def read(node: Node, reading: Reading) -> tuple[object, ...]:
        items = reading.items(node, noun)
        if count is not None and len(items) != count:
            raise reading.refuse(node, f"{noun} takes {count} values, not {len(items)}")
        found = [reading.try_read(read_one, item) for item in items]
        return tuple(reading.whole(found))

    return read


@dataclass(frozen=True, slots=True)
class RelativeMoment:
    """Time in a question: the latest time, or an offset from the start or the present.

    Attributes:
        kind: Origin of `offset`: "start" of the scenario, or "now", when the question is asked.
            "latest" means the latest time with data, without an offset.
        offset: Nanoseconds after the origin.
    """

    kind: Literal["latest", "now", "start"] = "latest"
    offset: Duration = 0

    def stamp(self, start: Stamp, now: Stamp) -> Stamp:
        """Return the time as a stamp, nanoseconds; 0 for the latest time.

        Args:
            start: Start of the scenario.
            now: Present time.
        """
        if self.kind == "latest":
            return 0
        return (start if self.kind == "start" else now) + self.offset

    def __str__(self) -> str:
        if self.kind == "latest":
            return "latest"
        amount = f"{abs(self.offset) / NANOSECONDS:g} s"
        if self.kind == "start":
            return amount
        return f"now - {amount}" if self.offset else "now"


_AGO = re.compile(r"\s*now\s*(?:-\s*(.+))?")


def moment(node: Node, reading: Reading) -> RelativeMoment:
    """Read a time: `latest`, `now`, `now - 5 s`, or seconds since the scenario's start."""
    value = reading.text(node, "a moment")
    if value.strip() == "latest":
        return RelativeMoment()
    ago = _AGO.fullmatch(value)
    if ago is not None and ago[1] is None:
        return RelativeMoment("now")
    if ago is not None:
        return RelativeMoment("now", -duration(reading.part(node, ago[1]), reading))
    if _NUMBER.fullmatch(value) is None:
        near = suggest(value, ("latest", "now")) or "; it may be latest, now, now - 5 s, or 12.5 s"
        raise reading.refuse(node, f"{quoted(value)} is not a time{near}")
    return RelativeMoment("start", duration(node, reading))
