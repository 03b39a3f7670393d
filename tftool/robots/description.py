"""Values of a robot description: links with their shapes, joints with their limits."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, Self, TypeAlias

from tftool.geometry.rigid import Transform, Vector3

JOINT_TYPES = ("fixed", "revolute", "continuous", "prismatic", "floating", "planar")

LIMITED_TYPES = ("revolute", "prismatic")
"""Types of joints that must have limits."""


@dataclass(frozen=True, slots=True)
class BoxShape:
    """A box centred on its origin.

    Attributes:
        size: Length along x, y and z, metres.
    """

    size: Vector3


@dataclass(frozen=True, slots=True)
class CylinderShape:
    """A cylinder along z, centred on its origin; radius and length in metres."""

    radius: float
    length: float


@dataclass(frozen=True, slots=True)
class CapsuleShape:
    """A cylinder of `length` metres along z, with a hemisphere on each end."""

    radius: float
    length: float


@dataclass(frozen=True, slots=True)
class SphereShape:
    """A sphere centred on its origin; radius in metres."""

    radius: float


@dataclass(frozen=True, slots=True)
class MeshShape:
    """A surface of triangles in a separate file.

    Attributes:
        filename: File name as written: `package://…`, `file://…`, or a relative path.
        scale: Factors along x, y and z.
    """

    filename: str
    scale: Vector3


ShapeGeometry: TypeAlias = BoxShape | CylinderShape | CapsuleShape | SphereShape | MeshShape


@dataclass(frozen=True, slots=True)
class Surface:
    """Colour and texture of a surface.

    Attributes:
        name: Name of the material; may be empty.
        color: Red, green, blue and opacity from 0 to 1; None if the description has no colour.
        texture: File name of the picture on the surface; empty if there is none.
    """

    name: str
    color: tuple[float, float, float, float] | None = None
    texture: str = ""


@dataclass(frozen=True, slots=True)
class LinkShape:
    """A visual or collision shape of a link, with its pose.

    Attributes:
        name: Name of the shape; often empty.
        origin: Pose of the shape in the link.
        geometry: The shape.
        material: Colour and texture; None for a collision shape, or if the description has none.
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
        visuals: Shapes to draw.
        collisions: Collision shapes.
        mass: Mass in kilograms; None if the description has no mass.
    """

    name: str
    visuals: tuple[LinkShape, ...] = ()
    collisions: tuple[LinkShape, ...] = ()
    mass: float | None = None


@dataclass(frozen=True, slots=True)
class JointLimit:
    """Limits of a joint: positions in radians or metres, speed in radians or metres per second.

    Attributes:
        lower: Smallest position.
        upper: Largest position.
        effort: Largest torque in newton metres, or force in newtons.
        velocity: Largest speed.
    """

    lower: float
    upper: float
    effort: float
    velocity: float


@dataclass(frozen=True, slots=True)
class JointMimic:
    """Rule that a joint's position is multiplier · position of `joint` + offset."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


class JointPosition(float):
    """Position of a joint that was given with a unit: a number of radians or metres.

    Attributes:
        unit: "rad" for an angle, "m" for a length.
    """

    __slots__ = ("unit",)
    unit: Literal["rad", "m"]

    def __new__(cls, position: float, unit: Literal["rad", "m"]) -> Self:
        """Create the position from its value in radians or metres."""
        made = super().__new__(cls, position)
        made.unit = unit
        return made


@dataclass(frozen=True, slots=True)
class RobotJoint:
    """Joint between a child link and its parent link.

    Attributes:
        name: Name of the joint.
        type: One of `JOINT_TYPES`.
        parent: The parent link.
        child: The child link.
        origin: The child's pose in the parent at position zero.
        axis: Unit vector in the joint's frame; the joint turns about it or slides along it.
        limit: Limits of position and speed; None if the description has none.
        mimic: Rule by which the joint follows another joint; None for an independent joint.
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
        """Whether the joint has a position, that is, is revolute, continuous or prismatic."""
        return self.type in ("revolute", "continuous", "prismatic")

    @property
    def limits(self) -> tuple[float, float] | None:
        """Minimum and maximum position, radians or metres; None without limits, as for a wheel."""
        if self.limit is None or self.type not in LIMITED_TYPES:
            return None
        return self.limit.lower, self.limit.upper

    @property
    def unit(self) -> str:
        """Unit of the joint's position: "rad" or "m"."""
        return "m" if self.type == "prismatic" else "rad"


@dataclass(frozen=True, slots=True)
class RobotDescription:
    """A robot description: a tree of links, connected by joints.

    Attributes:
        name: The robot's name.
        root: The link that is not a joint's child.
        links: Links by name, in the order of the file.
        joints: Joints by name, in the order of the file.
        notes: Sentences about faults that do not prevent reading.
        mistakes: The sentences of `notes` about mistakes in the file, each with line and column.
        text: Text of the description, with xacro expanded.
    """

    name: str
    root: str
    links: Mapping[str, RobotLink]
    joints: Mapping[str, RobotJoint]
    notes: tuple[str, ...] = ()
    mistakes: tuple[str, ...] = ()
    text: str = field(default="", repr=False)
