"""Values that a buffer accepts or returns: stamped transforms, and snapshots of all frames."""

from dataclasses import dataclass, field
from typing import NamedTuple

from tftool.base.stamps import Duration, Stamp
from tftool.geometry.rigid import Transform, refuses_arithmetic


@refuses_arithmetic
class TransformStamped(NamedTuple):
    """Pose of `child_frame_id` in `frame_id` at the time `stamp`.

    `lookup_transform(target, source)` also returns a `TransformStamped`: the pose of the source
    (`child_frame_id`) in the target (`frame_id`).

    Attributes:
        stamp: Nanoseconds.
        frame_id: The parent, or the target of a lookup.
        child_frame_id: The child, or the source of a lookup.
        transform: Maps points from the child frame to the parent frame.
    """

    stamp: Stamp
    frame_id: str
    child_frame_id: str
    transform: Transform


@refuses_arithmetic
class FrameInfo(NamedTuple):
    """State of one frame in a snapshot: its parent, its samples, and its poses in parent and root.

    Attributes:
        frame: Name of the frame.
        parent: Parent at the snapshot's time; None for a root.
        is_static: Whether the transform from the parent is static.
        authority: Sender of the newest sample; None for a frame without samples.
        samples: Number of stored samples.
        rate: Samples per second by tf2's formula, hertz; 10000 for a single sample and for a static
            frame.
        oldest: Stamp of the oldest sample; 0 for a static frame.
        newest: Stamp of the newest sample; 0 for a static frame.
        buffer_length: `newest` − `oldest`, nanoseconds.
        age: Nanoseconds from `newest` to the snapshot's `now`; 0 for static frames and roots.
        transform: Pose in the parent at the snapshot's time, identity for a root; None if there is
            no data at that time.
        root: Root of the frame's tree; None if the frame is in or below a loop.
        root_from_frame: Pose in the root; None if a frame on the way to the root has no data.
    """

    frame: str
    parent: str | None
    is_static: bool
    authority: str | None
    samples: int
    rate: float
    oldest: Stamp
    newest: Stamp
    buffer_length: Duration
    age: Duration
    transform: Transform | None
    root: str | None
    root_from_frame: Transform | None


@dataclass(frozen=True, slots=True)
class Snapshot:
    """State of all frames of a buffer at one time, immutable.

    Attributes:
        now: The clock's time, from which ages are computed, nanoseconds.
        at: The time of the poses, nanoseconds; 0 for the latest time with data of each frame.
        frames: All frames including roots, in the order in which their names were first seen.
    """

    now: Stamp
    at: Stamp
    frames: tuple[FrameInfo, ...]
    _by_name: dict[str, FrameInfo] = field(init=False, repr=False, compare=False)
    _children: dict[str, list[str]] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        children: dict[str, list[str]] = {}
        for info in self.frames:
            if info.parent is not None:
                children.setdefault(info.parent, []).append(info.frame)
        object.__setattr__(self, "_by_name", {info.frame: info for info in self.frames})
        object.__setattr__(self, "_children", children)

    def __contains__(self, frame: object) -> bool:
        return frame in self._by_name

    def roots(self) -> tuple[str, ...]:
        """Return the names of all frames without a parent: one frame for each tree."""
        return tuple(info.frame for info in self.frames if info.parent is None)

    def children(self, name: str) -> tuple[str, ...]:
        """Return the names of the direct children of a frame."""
        return tuple(self._children.get(name, ()))

    def frame(self, name: str) -> FrameInfo:
        """Return the state of one frame in the snapshot.

        Raises:
            KeyError: If there is no frame with that name.
        """
        return self._by_name[name]

    def loops(self) -> tuple[str, ...]:
        """Return the names of the frames in or below a loop, from which no root is reached."""
        return tuple(info.frame for info in self.frames if info.root is None)
