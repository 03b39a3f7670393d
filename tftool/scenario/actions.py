"""What may happen in a scenario: the actions of its script, as dataclasses.

Each field names the reader of its value. What is done for them is in `script`.
"""

from dataclasses import dataclass
from typing import ClassVar

from tftool.nodes.teleop import KEYS
from tftool.scenario import values
from tftool.scenario.reading import reads
from tftool.scenario.values import Moment
from tftool.stamps import Duration, seconds


@dataclass(frozen=True, slots=True, kw_only=True)
class Press:
    """Press keys on the teleop node, one after the other."""

    short: ClassVar[str] = "keys"
    keys: tuple[str, ...] = reads(values.words(KEYS, "a key"))
    every: Duration = reads(values.period, seconds(1), beside=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Drive:
    """Command a velocity for a time, then a stop."""

    turtle: str = reads(values.turtle, "turtle1")
    linear: float = reads(values.speed, 0.0)
    angular: float = reads(values.turn_rate, 0.0)
    sideways: float = reads(values.speed, 0.0)
    lasting: Duration = reads(values.duration, key="for", beside=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class SpawnTurtle:
    """Put a turtle on the field; without a name the simulator finds one."""

    short: ClassVar[str] = "name"
    name: str = reads(values.turtle, "")
    x: float = reads(values.length, 5.544445)
    y: float = reads(values.length, 5.544445)
    theta: float = reads(values.angle, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class KillTurtle:
    """Take a turtle off the field."""

    short: ClassVar[str] = "turtle"
    turtle: str = reads(values.turtle)


@dataclass(frozen=True, slots=True, kw_only=True)
class Teleport:
    """Put a turtle somewhere at once."""

    turtle: str = reads(values.turtle, "turtle1")
    x: float = reads(values.length)
    y: float = reads(values.length)
    theta: float = reads(values.angle, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Hop:
    """Turn a turtle and move it along its new heading, at once."""

    turtle: str = reads(values.turtle, "turtle1")
    linear: float = reads(values.length, 0.0)
    angular: float = reads(values.angle, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Rotate:
    """Turn a turtle to a heading by the rotate action."""

    turtle: str = reads(values.turtle, "turtle1")
    theta: float = reads(values.angle)


_channel = values.whole(0, 255)


@dataclass(frozen=True, slots=True, kw_only=True)
class Pen:
    """Change a turtle's pen."""

    turtle: str = reads(values.turtle, "turtle1")
    r: int = reads(_channel, 179)
    g: int = reads(_channel, 184)
    b: int = reads(_channel, 255)
    width: int = reads(_channel, 3)
    off: bool = reads(values.flag, False)


@dataclass(frozen=True, slots=True, kw_only=True)
class ClearField:
    """Wipe all trails."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ResetField:
    """Begin again with one turtle in the centre."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Broadcast:
    """Tell a transform from parent to child, once or again and again for a time."""

    parent: str = reads(values.frame)
    child: str = reads(values.frame)
    x: float = reads(values.length, 0.0)
    y: float = reads(values.length, 0.0)
    z: float = reads(values.length, 0.0)
    roll: float = reads(values.angle, 0.0)
    pitch: float = reads(values.angle, 0.0)
    yaw: float = reads(values.angle, 0.0)
    stamp: Moment = reads(values.moment, Moment("now"))
    every: Duration = reads(values.period, seconds(0.1), beside=True)
    lasting: Duration = reads(values.duration, 0, key="for", beside=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class BroadcastStatic:
    """Tell a transform that holds for all time."""

    parent: str = reads(values.frame)
    child: str = reads(values.frame)
    x: float = reads(values.length, 0.0)
    y: float = reads(values.length, 0.0)
    z: float = reads(values.length, 0.0)
    roll: float = reads(values.angle, 0.0)
    pitch: float = reads(values.angle, 0.0)
    yaw: float = reads(values.angle, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class StopNode:
    """Stop a node and let it leave."""

    short: ClassVar[str] = "node"
    node: str = reads(values.name("a node"))


@dataclass(frozen=True, slots=True, kw_only=True)
class Say:
    """Write a line into the log, for whoever watches."""

    short: ClassVar[str] = "text"
    text: str = reads(values.text)
