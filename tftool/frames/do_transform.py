"""Data that knows its frame, taken to another frame: tf2's do_transform and Buffer.transform.

What a datum is, is told by its type; a program can teach more types with `teach`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, Protocol, TypeVar, cast

from tftool.errors import TransformException
from tftool.frames.sample import TransformStamped
from tftool.geometry import carry
from tftool.geometry.carry import PoseWithCovariance, Twist, Wrench
from tftool.geometry.rigid import Quaternion, Transform, Vector3
from tftool.stamps import Stamp

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

T = TypeVar("T")


class TypeException(TransformException):
    """A datum of a type that nobody taught how to move."""


class Point(Vector3):
    """A place, where `Vector3` is a direction."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class Polygon:
    """Corners."""

    points: tuple[Vector3, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Cloud:
    """Many points, with whatever else is known of each.

    Attributes:
        points: Shape (n, 3).
        fields: Everything else, left as it is.
    """

    points: "npt.NDArray[np.float64]"
    fields: Any = None


@dataclass(frozen=True, slots=True)
class Stamped(Generic[T]):
    """A datum, the moment it is of (0: whenever is latest) and the frame it is given in."""

    stamp: Stamp
    frame_id: str
    datum: T


class Lookups(Protocol):
    """The two questions data are moved by; a `Buffer` answers them."""

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Stamp = 0
    ) -> TransformStamped:
        """The pose of source in target."""

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Stamp,
        source_frame: str,
        source_time: Stamp,
        fixed_frame: str,
    ) -> TransformStamped:
        """The same between two moments."""


_TAUGHT: dict[type, Callable[[Transform, Any], Any]] = {
    Point: lambda transform, datum: Point(*carry.point(transform, datum)),
    Vector3: carry.vector,
    Quaternion: carry.quaternion,
    Transform: carry.pose,
    PoseWithCovariance: carry.pose_with_covariance,
    Wrench: carry.wrench,
    Twist: carry.twist,
    Polygon: lambda transform, datum: Polygon(carry.polygon(transform, datum.points)),
    Cloud: lambda transform, datum: Cloud(carry.points(transform, datum.points), datum.fields),
}

# tf2 lets a cloud keep the moment it was seen at.
_KEEP_STAMP: set[type] = {Cloud}


def teach(kind: type[T], move: Callable[[Transform, T], T], *, keep_stamp: bool = False) -> None:
    """Say how data of one more type are moved.

    Args:
        kind: Their type.
        move: Is given the transform and a datum, and gives a new datum.
        keep_stamp: Whether a moved datum keeps its own stamp instead of the transform's.
    """
    _TAUGHT[kind] = move
    if keep_stamp:
        _KEEP_STAMP.add(kind)


def do_transform(stamped: Stamped[T], transform: TransformStamped) -> Stamped[T]:
    """Move a datum, given in the transform's child, into its parent.

    Returns:
        A new datum with the transform's stamp and frame (a cloud keeps its own stamp).

    Raises:
        TypeException: If nobody taught how to move data of its type.
    """
    datum = stamped.datum
    kind = type(datum)
    move = _TAUGHT.get(kind)
    if move is None:
        raise TypeException(f"Type {kind} is not loaded or supported")
    stamp = stamped.stamp if kind in _KEEP_STAMP else transform.stamp
    return Stamped(stamp, transform.frame_id, cast("T", move(transform.transform, datum)))


def transform(buffer: Lookups, stamped: Stamped[T], target_frame: str) -> Stamped[T]:
    """Take a datum to another frame, at its own moment.

    Raises:
        TransformException: As `Buffer.lookup_transform`; TypeException as `do_transform`.
    """
    found = buffer.lookup_transform(target_frame, stamped.frame_id, stamped.stamp)
    return do_transform(stamped, found)


def transform_full(
    buffer: Lookups,
    stamped: Stamped[T],
    target_frame: str,
    target_time: Stamp,
    fixed_frame: str,
) -> Stamped[T]:
    """Take a datum to another frame as that is at another moment, through a fixed frame.

    Raises:
        TransformException: As `Buffer.lookup_transform_full`; TypeException as `do_transform`.
    """
    found = buffer.lookup_transform_full(
        target_frame, target_time, stamped.frame_id, stamped.stamp, fixed_frame
    )
    return do_transform(stamped, found)
