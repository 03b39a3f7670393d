"""Robot descriptions: links with their shapes, joints with their limits."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from tftool.geometry.rigid import Transform, Vector3

JOINT_TYPES = ("fixed", "revolute", "continuous", "prismatic", "floating", "planar")

LIMITED_TYPES = ("revolute", "prismatic")
"""Those that must say how far they go."""


@dataclass(frozen=True, slots=True)
class BoxShape:
    """A box centred on its origin.

    Attributes:
        size: Length along x, y and z, metres.
    """

    size: Vector3


@dataclass(frozen=True, slots=True)
class CylinderShape:
    """A cylinder along z, centred on its origin; metres."""

    radius: float
    length: float


@dataclass(frozen=True, slots=True)
class CapsuleShape:
    """A cylinder along z with a hemisphere on each end; metres, `length` without the ends."""

    radius: float
    length: float


@dataclass(frozen=True, slots=True)
class SphereShape:
    """A sphere centred on its origin; metres."""

    radius: float


@dataclass(frozen=True, slots=True)
class MeshShape:
    """A surface in a separate file.

    Attributes:
        filename: File name as written: `package://…`, `file://…`, or a relative path.
        scale: Factors along x, y and z.
    """

    filename: str
    scale: Vector3


ShapeGeometry: TypeAlias = BoxShape | CylinderShape | CapsuleShape | SphereShape | MeshShape


@dataclass(frozen=True, slots=True)
class Surface:
    """Appearance of a surface.

    Attributes:
        name: Name; may be empty.
        color: Red, green, blue and opacity from 0 to 1; None where it is not given.
        texture: File name of a picture, empty without one.
    """

    name: str
    color: tuple[float, float, float, float] | None = None
    texture: str = ""


@dataclass(frozen=True, slots=True)
class LinkShape:
    """A visual or collision shape of a link.

    Attributes:
        name: Name, often empty.
        origin: Pose in the link.
        geometry: Shape.
        material: Material; None for collisions and where none is named.
    """

    name: str
    origin: Transform
    geometry: ShapeGeometry
    material: Surface | None = None


@dataclass(frozen=True, slots=True)
class RobotLink:
    """A rigid part of a robot, with its own frame.

    Attributes:
        name: Name of the link and of its frame.
        visuals: Drawn shapes.
        collisions: Collision shapes.
        mass: Kilograms; None without an inertial element.
    """

    name: str
    visuals: tuple[LinkShape, ...] = ()
    collisions: tuple[LinkShape, ...] = ()
    mass: float | None = None


@dataclass(frozen=True, slots=True)
class JointLimit:
    """Limits of a joint's position and speed; radians or metres, and per second.

    Attributes:
        lower: Smallest position.
        upper: Largest position.
        effort: Newton metres, or newtons.
        velocity: Largest speed.
    """

    lower: float
    upper: float
    effort: float
    velocity: float


@dataclass(frozen=True, slots=True)
class JointMimic:
    """A joint that mimics another: position = multiplier · leader's position + offset."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class RobotJoint:
    """Joint between a link and its parent.

    Attributes:
        name: Name.
        type: One of `JOINT_TYPES`.
        parent: The parent link.
        child: The child link.
        origin: The child's pose in the parent at position zero.
        axis: Unit vector in the joint's frame about which it turns or along which it slides.
        limit: None for a joint without.
        mimic: Joint that this joint follows, if any.
    """

    name: str
    type: str
    parent: str
    child: str
    origin: Transform
    axis: Vector3
    limit: JointLimit | None = None
    mimic: JointMimic | None = None

    @property
    def moves(self) -> bool:
        """Whether the joint has one position: revolute, continuous or prismatic."""
        return self.type in ("revolute", "continuous", "prismatic")

    @property
    def limits(self) -> tuple[float, float] | None:
        """Minimum and maximum position; None for a joint without limits, such as a wheel."""
        if self.limit is None or self.type not in LIMITED_TYPES:
            return None
        return self.limit.lower, self.limit.upper

    @property
    def unit(self) -> str:
        """Unit of the joint's position: rad or m."""
        return "m" if self.type == "prismatic" else "rad"


@dataclass(frozen=True, slots=True)
class RobotDescription:
    """A robot description: a tree of links.

    Attributes:
        name: The robot's name.
        root: The link that is not a joint's child.
        links: Contents by name, in the order of the file.
        joints: Contents by name, in the order of the file.
        notes: Oddities that are still readable, as sentences.
        text: Text, with xacro expanded.
    """

    name: str
    root: str
    links: Mapping[str, RobotLink]
    joints: Mapping[str, RobotJoint]
    notes: tuple[str, ...] = ()
    text: str = field(default="", repr=False)
