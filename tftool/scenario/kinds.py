"""The kinds of nodes a scenario may start: one entry each.

An entry names the class and the typed parameters that a scenario may give it;
every parameter is handed on under its own name.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from tftool.frames.sample import TransformStamped
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.rigid import Transform
from tftool.messages import Color, Spawn
from tftool.motion.pid import Gains
from tftool.motion.pursuit import TUTORIAL_BEARING, TUTORIAL_DISTANCE
from tftool.nodes.broadcasters import Broadcaster, DynamicCarrot, FixedCarrot, StaticBroadcaster
from tftool.nodes.follower import TUTORIAL_SPAWN, Follower
from tftool.nodes.points import MessageBroadcaster, PointDrawer
from tftool.nodes.robot import LaserPoint, MapCorrection, RobotOdometry
from tftool.nodes.squares import DrawSquare, Mimic
from tftool.nodes.teleop import SCALE_ANGULAR, SCALE_LINEAR, Teleop
from tftool.nodes.turtlesim import BACKGROUND, Turtlesim
from tftool.runtime.node import Node
from tftool.runtime.world import World
from tftool.scenario import document, values
from tftool.scenario.reading import Field, Reader, Reading
from tftool.stamps import seconds


@dataclass(frozen=True, slots=True)
class Kind:
    """How a node of one kind is read and made.

    Attributes:
        make: The class, or a function that does as a class does.
        fields: Its parameters, by their names.
    """

    make: Callable[..., Node]
    fields: Mapping[str, Field]

    def defaults(self) -> dict[str, Any]:
        """The parameters of a node about which nothing is said."""
        return {name: field.default for name, field in self.fields.items()}

    def build(self, world: World, name: str, parameters: Mapping[str, Any]) -> Node:
        """Make a node, which joins `world` by that.

        Raises:
            UsageError: If the parameters do not go together.
        """
        return self.make(world, name, **parameters)


def _triple(x: float, y: float, last: str, last_value: float) -> Reader:
    """A reader of {x, y, z} or {x, y, theta}, as a tuple."""
    known = {
        "x": Field(values.length, x),
        "y": Field(values.length, y),
        last: Field(values.angle if last == "theta" else values.length, last_value),
    }

    def read(node: document.Node, reading: Reading) -> tuple[float, ...]:
        return tuple(reading.record(node, known, "a place").values())

    return read


def _gains(node: document.Node, reading: Reading) -> Gains:
    """Gains of a controller: {kp, ki, kd, integral_limit, output_limit}, or kp alone."""
    if isinstance(node, document.Scalar):
        return Gains(values.number(node, reading))
    limit = values.or_none(values.positive)
    known = {
        "kp": Field(values.number),
        "ki": Field(values.number, 0.0),
        "kd": Field(values.number, 0.0),
        "integral_limit": Field(limit, None),
        "output_limit": Field(limit, None),
    }
    return Gains(**reading.record(node, known, "a set of gains"))


def _color(node: document.Node, reading: Reading) -> Color:
    channel = Field(values.whole(0, 255))
    return Color(**reading.record(node, {"r": channel, "g": channel, "b": channel}, "a colour"))


def _turtle(node: document.Node, reading: Reading) -> Spawn:
    """A turtle to begin with."""
    known = {
        "name": Field(values.turtle),
        "x": Field(values.length),
        "y": Field(values.length),
        "theta": Field(values.angle, 0.0),
    }
    return Spawn(**reading.record(node, known, "a turtle"))


def _static(
    world: World,
    name: str,
    *,
    parent: str,
    child: str,
    x: float,
    y: float,
    z: float,
    roll: float,
    pitch: float,
    yaw: float,
) -> StaticBroadcaster:
    """A static broadcaster of one transform, written out."""
    pose = Transform((x, y, z), quaternion_from_rpy(roll, pitch, yaw))
    stamped = TransformStamped(world.clock.now(), parent, child, pose)
    return StaticBroadcaster(world, name, transforms=[stamped])


_PLACE = {
    "x": Field(values.length, 0.0),
    "y": Field(values.length, 0.0),
    "z": Field(values.length, 0.0),
    "roll": Field(values.angle, 0.0),
    "pitch": Field(values.angle, 0.0),
    "yaw": Field(values.angle, 0.0),
}

KINDS: Mapping[str, Kind] = MappingProxyType(
    {
        "turtlesim": Kind(
            Turtlesim,
            {
                "holonomic": Field(values.flag, False),
                "background": Field(_color, BACKGROUND),
                "turtles": Field(values.several(_turtle, "one turtle an item"), ()),
            },
        ),
        "broadcaster": Kind(
            Broadcaster,
            {"turtle": Field(values.turtle), "frame_id": Field(values.frame, "world")},
        ),
        "static": Kind(
            _static, {"parent": Field(values.frame), "child": Field(values.frame), **_PLACE}
        ),
        "fixed_carrot": Kind(
            FixedCarrot,
            {
                "parent": Field(values.frame, "turtle1"),
                "child": Field(values.frame, "carrot1"),
                "offset": Field(_triple(0.0, 2.0, "z", 0.0), (0.0, 2.0, 0.0)),
                "period": Field(values.period, seconds(0.1)),
            },
        ),
        "dynamic_carrot": Kind(
            DynamicCarrot,
            {
                "parent": Field(values.frame, "turtle1"),
                "child": Field(values.frame, "carrot1"),
                "radius": Field(values.distance, 10.0),
                "whole_seconds": Field(values.flag, False),
                "period": Field(values.period, seconds(0.1)),
            },
        ),
        "follower": Kind(
            Follower,
            {
                "leader": Field(values.frame, "turtle1"),
                "follower": Field(values.turtle, "turtle2"),
                "period": Field(values.period, seconds(1)),
                "delay": Field(values.duration, 0),
                "fixed_frame": Field(values.or_none(values.frame), "world"),
                "distance_gains": Field(_gains, TUTORIAL_DISTANCE),
                "bearing_gains": Field(_gains, TUTORIAL_BEARING),
                "dead_band": Field(values.distance, 0.0),
                "speed_limit": Field(values.or_none(values.top_speed), None),
                "stale_after": Field(values.or_none(values.period), None),
                "spawn": Field(values.or_none(_triple(4.0, 2.0, "theta", 0.0)), TUTORIAL_SPAWN),
            },
        ),
        "draw_square": Kind(
            DrawSquare,
            {"turtle": Field(values.turtle, "turtle1"), "reset": Field(values.flag, True)},
        ),
        "mimic": Kind(
            Mimic,
            {"leader": Field(values.turtle, "turtle1"), "copy": Field(values.turtle, "turtle2")},
        ),
        "teleop": Kind(
            Teleop,
            {
                "turtle": Field(values.turtle, "turtle1"),
                "scale_linear": Field(values.speed, SCALE_LINEAR),
                "scale_angular": Field(values.turn_rate, SCALE_ANGULAR),
            },
        ),
        "odometry": Kind(
            RobotOdometry,
            {
                "odom": Field(values.frame, "odom"),
                "base": Field(values.frame, "base_link"),
                "start": Field(_triple(0.0, 0.0, "theta", 0.0), (0.0, 0.0, 0.0)),
                "speed": Field(values.speed, 0.5),
                "turn_rate": Field(values.turn_rate, 0.25),
                "scale_error": Field(values.number, 0.02),
                "turn_error": Field(values.turn_rate, 0.01),
                "period": Field(values.period, seconds(0.02)),
            },
        ),
        "localization": Kind(
            MapCorrection,
            {
                "map_frame": Field(values.frame, "map"),
                "odom": Field(values.frame, "odom"),
                "base": Field(values.frame, "base_link"),
                "correct_every": Field(values.period, seconds(2)),
                "period": Field(values.period, seconds(0.1)),
            },
        ),
        "laser": Kind(
            LaserPoint,
            {
                "landmark": Field(_triple(3.0, 1.0, "z", 0.2), (3.0, 1.0, 0.2)),
                "base": Field(values.frame, "base_link"),
                "laser": Field(values.frame, "laser_link"),
                "child": Field(values.frame, "laser_point"),
                "period": Field(values.period, seconds(0.1)),
            },
        ),
        "message_broadcaster": Kind(
            MessageBroadcaster,
            {
                "turtle": Field(values.turtle, "turtle3"),
                "frame_id": Field(values.frame, "world"),
                "spawn": Field(_triple(4.0, 2.0, "theta", 0.0), TUTORIAL_SPAWN),
                "period": Field(values.period, seconds(1)),
            },
        ),
        "point_drawer": Kind(
            PointDrawer,
            {
                "target_frame": Field(values.frame, "turtle1"),
                "turtle": Field(values.turtle, "turtle3"),
                "patience": Field(values.period, seconds(1)),
            },
        ),
    }
)
