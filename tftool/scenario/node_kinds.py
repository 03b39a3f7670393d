"""Kinds of nodes that a scenario may start, in a table with one entry for each kind.

An entry names the node's class, and the parameters that a scenario may set. A parameter has the
same name and the same default as in the class.
"""

import inspect
from collections.abc import Callable, Collection, Iterable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from tftool.base.color import Color
from tftool.base.errors import InputError, Mistake, UsageError
from tftool.buffer.forest import stripped
from tftool.buffer.sample import TransformStamped
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.motion import Gains
from tftool.geometry.rigid import Transform
from tftool.messages.classes import build
from tftool.messages.turtle_messages import Spawn
from tftool.robots.description import JointPosition
from tftool.scenario import document
from tftool.scenario import units as values
from tftool.scenario.fields import Key, Reader, Reading, Unreadable, listed, quoted, suggest
from tftool.world.node import Node
from tftool.world.nodes.broadcasters import (
    Broadcaster,
    DynamicCarrot,
    FixedCarrot,
    Noise,
    StaticBroadcaster,
)
from tftool.world.nodes.follower import Follower
from tftool.world.nodes.joints import MOTIONS, MovingRobot
from tftool.world.nodes.mobile_robot import LaserPoint, MapCorrection, RobotOdometry, ScanMatcher
from tftool.world.nodes.points import MessageBroadcaster, PointDrawer
from tftool.world.nodes.turtle_drivers import DrawSquare, Mimic, Teleop
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.robots.robot_model import Robot


def robot_file(node: document.Node, reading: Reading) -> "Robot":
    """Load the robot description at a path; xacro files are rejected, because xacro runs code."""
    # Imported here: it imports numpy, which other scenarios do not need.
    from tftool.robots.robot_model import Robot
    from tftool.robots.urdf import load_description

    path = _beside(node, reading, "a robot description")
    try:
        return Robot(load_description(path, plain=True))
    except (InputError, UsageError) as error:
        raise reading.refuse(node, str(error)) from None


def joint_recording(node: document.Node, reading: Reading) -> tuple[Any, ...]:
    """Read the path of a recording, and return its joint states."""
    from tftool.recordings.recording import open_recording

    path = _beside(node, reading, "a recording")
    try:
        with open_recording(path) as recording:
            return recording.joint_states.states
    except (InputError, UsageError) as error:
        raise reading.refuse(node, str(error)) from None


def joint_positions(node: document.Node, reading: Reading) -> dict[str, float]:
    """Read positions of joints by name: radians or metres, or text with a unit such as `30 deg`."""
    found = {
        name: reading.try_read(_position, value)
        for name, (_, value) in reading.entries(node, "joint: position").items()
    }
    reading.whole(found.values())
    return found


def _position(node: document.Node, reading: Reading) -> float:
    text = reading.text(node, "a position").strip()
    unit = text.lstrip("+-0123456789.eE").strip() if text[:1] not in "mk" else text
    is_length = unit in values.LENGTH.factors
    read: Reader = values.length if is_length else values.angle
    position: float = read(reading.part(node, text), reading)
    return JointPosition(position, "m" if is_length else "rad") if unit else position


def _beside(node: document.Node, reading: Reading, wanted: str) -> Path:
    text = reading.text(node, wanted)
    path = Path(reading.source.name).parent / text
    if not path.exists():
        raise reading.refuse(node, f"there is no file {quoted(text)} beside the scenario")
    return path


class NodeKind:
    """Kind of node: readers of its parameters, and a function that creates the node.

    Attributes:
        make: Class of the node, or a function that creates the node.
        fields: Reader and default of each parameter, by name.
    """

    __slots__ = ("fields", "make")

    def __init__(
        self,
        make: Callable[..., Node],
        usual: str = "",
        *,
        required: Collection[str] = (),
        **readers: Reader,
    ) -> None:
        """Describe a kind of node.

        Args:
            make: Class of the node, or a function that creates the node.
            usual: Names of parameters with a common reader in `USUAL`, separated by blanks.
            required: Parameters that a scenario must set, even if the class has a default.
            readers: Readers of further parameters, by name.
        """
        self.make = make
        readers |= {name: USUAL[name] for name in usual.split()}
        # In the order of the signature, in which error texts list the keys.
        self.fields: Mapping[str, Key] = {
            name: Key(readers[name])
            if name in required or one.default is inspect.Parameter.empty
            else Key(readers[name], one.default)
            for name, one in inspect.signature(make).parameters.items()
            if name in readers
        }

    def defaults(self) -> dict[str, Any]:
        """Return the default values of the parameters."""
        return {name: field.default for name, field in self.fields.items()}

    def build(self, world: World, name: str, parameters: Mapping[str, Any]) -> Node:
        """Create a node in a world.

        Raises:
            UsageError: If the parameters contradict each other.
        """
        return self.make(world, name, **parameters)


def _triple(default_x: float, default_y: float, third_key: str, third_default: float) -> Reader:
    """Return a reader of {x, y, z} or {x, y, theta} as a tuple."""
    known = {
        "x": Key(values.length, default_x),
        "y": Key(values.length, default_y),
        third_key: Key(values.angle if third_key == "theta" else values.length, third_default),
    }

    def read(node: document.Node, reading: Reading) -> tuple[float, ...]:
        return tuple(reading.record(node, known, "a place").values())

    return read


def _gains(node: document.Node, reading: Reading) -> Gains:
    """Read a controller's gains: a mapping with kp, ki, kd and limits, or the number kp."""
    if isinstance(node, document.Scalar):
        return Gains(values.number(node, reading))
    limit = values.or_none(values.positive)
    known = {
        "kp": Key(values.number),
        "ki": Key(values.number, 0.0),
        "kd": Key(values.number, 0.0),
        "integral_limit": Key(limit, None),
        "output_limit": Key(limit, None),
    }
    return Gains(**reading.record(node, known, "a set of gains"))


def _color(node: document.Node, reading: Reading) -> Color:
    channel = Key(values.whole(0, 255))
    return Color(**reading.record(node, {"r": channel, "g": channel, "b": channel}, "a colour"))


def _turtle(node: document.Node, reading: Reading) -> Any:
    """Read a turtle that exists from the start; return the turtle as a Spawn request."""
    known = {
        "name": Key(values.turtle),
        "x": Key(values.length),
        "y": Key(values.length),
        "theta": Key(values.angle, 0.0),
    }
    return build(Spawn.Request, **reading.record(node, known, "a turtle"))


def _static(
    world: World,
    name: str,
    *,
    parent: str,
    child: str,
    x: float = 0.0,
    y: float = 0.0,
    z: float = 0.0,
    roll: float = 0.0,
    pitch: float = 0.0,
    yaw: float = 0.0,
) -> StaticBroadcaster:
    """Create a static broadcaster of one transform: metres, and radians about fixed axes."""
    pose = Transform((x, y, z), quaternion_from_rpy(roll, pitch, yaw))
    stamped = TransformStamped(world.clock.now(), parent, child, pose)
    return StaticBroadcaster(world, name, transforms=[stamped])


USUAL: Final[Mapping[str, Reader]] = {
    **dict.fromkeys(("parent", "child", "frame_id", "target_frame", "origin"), values.frame),
    **dict.fromkeys(("map_frame", "odom", "base", "laser"), values.frame),
    **dict.fromkeys(("holonomic", "reset", "whole_seconds"), values.flag),
    **dict.fromkeys(("period", "cycle", "correct_every", "patience"), values.period),
    **dict.fromkeys(("x", "y", "z"), values.length),
    **dict.fromkeys(("roll", "pitch", "yaw"), values.angle),
    **dict.fromkeys(("radius", "position", "drift", "dead_band"), values.distance),
    **dict.fromkeys(("angle", "turn_drift"), values.quantity(values.ANGLE, least=0.0)),
    **dict.fromkeys(("speed", "scale_linear"), values.speed),
    **dict.fromkeys(("turn_rate", "turn_error", "scale_angular"), values.turn_rate),
    "turtle": values.turtle,
    "seed": values.whole(0, 2**32 - 1),
}
"""Readers of parameters that have the same meaning in every kind of node."""

_PLANE = _triple(0.0, 0.0, "theta", 0.0)
_SPAWN = _triple(4.0, 2.0, "theta", 0.0)

KINDS: Mapping[str, NodeKind] = MappingProxyType(
    {
        "turtlesim": NodeKind(
            Turtlesim,
            "holonomic",
            background=_color,
            turtles=values.several(_turtle, "one turtle per item"),
        ),
        "broadcaster": NodeKind(Broadcaster, "turtle frame_id", required=["turtle"]),
        "static": NodeKind(_static, "parent child x y z roll pitch yaw"),
        "fixed_carrot": NodeKind(
            FixedCarrot, "parent child period", offset=_triple(0.0, 2.0, "z", 0.0)
        ),
        "dynamic_carrot": NodeKind(DynamicCarrot, "parent child radius whole_seconds period"),
        "follower": NodeKind(
            Follower,
            "period dead_band",
            leader=values.frame,
            follower=values.turtle,
            delay=values.duration,
            fixed_frame=values.or_none(values.frame),
            distance_gains=_gains,
            bearing_gains=_gains,
            speed_limit=values.or_none(values.top_speed),
            stale_after=values.or_none(values.period),
            spawn=values.or_none(_SPAWN),
        ),
        "draw_square": NodeKind(DrawSquare, "turtle reset"),
        "mimic": NodeKind(Mimic, leader=values.turtle, copy=values.turtle),
        "teleop": NodeKind(Teleop, "turtle scale_linear scale_angular"),
        "odometry": NodeKind(
            RobotOdometry,
            "odom base speed turn_rate turn_error period",
            start=_PLANE,
            scale_error=values.number,
        ),
        "localization": NodeKind(MapCorrection, "map_frame odom base correct_every period"),
        "scan_matcher": NodeKind(
            ScanMatcher, "origin child base position angle seed period", mount=_PLANE
        ),
        "laser": NodeKind(
            LaserPoint, "base laser child period", landmark=_triple(3.0, 1.0, "z", 0.2)
        ),
        "noise": NodeKind(
            Noise,
            "parent child position angle drift turn_drift seed period",
            offset=_triple(0.0, 0.0, "z", 0.0),
        ),
        "robot": NodeKind(
            MovingRobot,
            "cycle period",
            file=robot_file,
            joints=joint_positions,
            motion=values.choice(MOTIONS, "a motion"),
            recording=joint_recording,
            frame_prefix=values.text,
        ),
        "message_broadcaster": NodeKind(MessageBroadcaster, "turtle frame_id period", spawn=_SPAWN),
        "point_drawer": NodeKind(PointDrawer, "target_frame turtle patience"),
    }
)


def link_of(kind: str, parameters: Mapping[str, Any]) -> tuple[str, str] | None:
    """Return (parent, child) of the only transform that a node with these parameters publishes.

    Return None if the node publishes no transform, or if no parameters name the two frames.
    """
    if kind in {"broadcaster", "message_broadcaster"}:
        parent, child = parameters["frame_id"], parameters["turtle"]
    elif {"parent", "child"} <= parameters.keys():
        parent, child = parameters["parent"], parameters["child"]
    elif {"origin", "child"} <= parameters.keys():
        parent, child = parameters["origin"], parameters["child"]
    else:
        return None
    return stripped(parent), stripped(child)


def check_robots(
    nodes: Iterable[document.Node], items: Iterable[tuple[str, str, Any]], reading: Reading
) -> list[Mistake]:
    """Check that one node moves each robot, and that `base` of a node names a robot's base.

    Args:
        nodes: The scenario's nodes, as in the file.
        items: Kind, name and parameters of each node.
        reading: Pass over the document, which gets a mistake for each node that fails the check.

    Returns:
        Warnings about joints beyond their limits, with which the scenario can be played.

    Raises:
        Unreadable: If a node fails the check.
    """
    warnings: list[Mistake] = []
    lines: dict[str, int] = {}
    observers: list[tuple[document.Node, str]] = []
    bases: list[str] = []
    whole = True
    for item, (kind, _, parameters) in zip(nodes, items, strict=True):
        moved: list[str] = []
        if kind == "odometry":
            bases.append(stripped(parameters["base"]))
            moved, key = [f"frame {quoted(bases[-1])}"], "base"
        elif kind == "robot":
            prefix, key = parameters["frame_prefix"], "frame_prefix"
            joints = parameters["file"].joints.values()
            moved = [f"joint {quoted(prefix + one.name)}" for one in joints if one.moves]
            warnings += (
                reading.source.mistake(item.place, text.rstrip("."))
                for text in parameters["file"].beyond_limits(parameters.get("joints") or {})
            )
        elif "base" in parameters:
            observers.append((item, stripped(parameters["base"])))
        known = next((one for one in moved if one in lines), None)
        if known is not None:
            whole = False
            reading.note(
                item,
                f"the node of line {lines[known]} also moves {known}: give one of the two "
                f"another '{key}'",
            )
        lines.update(dict.fromkeys(moved, item.place.line + 1))
    for item, base in observers:
        if len(bases) > 1 and base not in bases:
            whole = False
            near = suggest(base, bases) or f"; there are {listed(bases)}"
            reading.note(item, f"no robot has the base {quoted(base)}{near}")
    if not whole:
        raise Unreadable
    return warnings
