"""Many transforms in numpy arrays: the result of `Buffer.lookup_transforms`."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np
import numpy.typing as npt

from tftool.base.errors import UsageError
from tftool.buffer.sample import TransformStamped
from tftool.geometry import rigid_arrays as batch
from tftool.geometry.rigid import Quaternion, Transform, Vector3
from tftool.geometry.rigid_arrays import Floats

if TYPE_CHECKING:
    from scipy.spatial.transform import RigidTransform, Rotation


class Velocities(NamedTuple):
    """Linear and angular velocities, row by row.

    Attributes:
        linear: Metres per second along the axes of the target frame, shape (n, 3).
        angular: Radians per second about the axes of the target frame, shape (n, 3).
    """

    linear: Floats
    angular: Floats


@dataclass(frozen=True, slots=True, eq=False)
class SampleColumns:
    """Samples of one child frame, oldest first: the result of `Buffer.samples`.

    The arrays are read-only copies. Samples with equal stamps are in the order of insertion.

    Attributes:
        frame: The child.
        is_static: Whether the frame is static; a static frame has one sample, with stamp 0.
        stamps: Nanoseconds, int64, shape (n,), ascending.
        parents: The parent of each sample, `str` objects, shape (n,).
        poses: x, y, z in metres and a unit quaternion x, y, z, w, shape (n, 7).
        authorities: Sender of each sample, `str` objects, shape (n,).
    """

    frame: str
    is_static: bool
    stamps: npt.NDArray[np.int64]
    parents: npt.NDArray[np.object_]
    poses: Floats
    authorities: npt.NDArray[np.object_]

    def __len__(self) -> int:
        return len(self.stamps)

    def __repr__(self) -> str:
        return f"<SampleColumns: {len(self)} samples of {self.frame!r}>"

    @property
    def translations(self) -> Floats:
        """Translations of all samples, metres, shape (n, 3)."""
        return self.poses[:, :3]

    @property
    def rotations(self) -> Floats:
        """Rotations of all samples: unit quaternions in xyzw order, shape (n, 4)."""
        return self.poses[:, 3:]


@dataclass(frozen=True, slots=True, eq=False)
class TransformArray:
    """Poses of one frame in another at many times.

    Row i is the pose of `child_frame_id` in `frame_id` at `stamps[i]`: the transform maps points
    from the child frame to the parent frame. An index returns a `TransformStamped`; a slice, a
    mask or an array of indices returns a `TransformArray`.

    Attributes:
        frame_id: The target of the lookup.
        child_frame_id: The source of the lookup.
        stamps: Nanoseconds, int64, shape (n,).
        translations: Metres, shape (n, 3).
        rotations: Unit quaternions in xyzw order, shape (n, 4).
        valid: Whether each row has a pose, bool, shape (n,); rows without a pose are NaN.
    """

    frame_id: str
    child_frame_id: str
    stamps: npt.NDArray[np.int64]
    translations: Floats
    rotations: Floats
    valid: npt.NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.stamps)

    @overload
    def __getitem__(self, rows: int) -> TransformStamped: ...
    @overload
    def __getitem__(self, rows: "slice | npt.NDArray[Any] | list[int]") -> "TransformArray": ...
    def __getitem__(self, rows: Any) -> "TransformStamped | TransformArray":
        stamps = self.stamps[rows]
        if np.ndim(stamps) == 0:
            x, y, z = self.translations[rows].tolist()
            qx, qy, qz, qw = self.rotations[rows].tolist()
            pose = Transform(Vector3(x, y, z), Quaternion(qx, qy, qz, qw))
            return TransformStamped(int(stamps), self.frame_id, self.child_frame_id, pose)
        return TransformArray(
            self.frame_id,
            self.child_frame_id,
            stamps,
            self.translations[rows],
            self.rotations[rows],
            self.valid[rows],
        )

    def __iter__(self) -> Iterator[TransformStamped]:
        return (self[row] for row in range(len(self)))

    def __repr__(self) -> str:
        held = int(np.count_nonzero(self.valid))
        return (
            f"<TransformArray: {len(self)} poses of '{self.child_frame_id}' in "
            f"'{self.frame_id}', {held} of them valid>"
        )

    def matrices(self) -> Floats:
        """Return homogeneous matrices of all rows, shape (n, 4, 4); NaN in invalid rows."""
        return batch.matrices(self.translations, self.rotations)

    def apply(self, points: npt.ArrayLike) -> Floats:
        """Transform points, given in `child_frame_id`, to `frame_id`.

        Args:
            points: Metres. Shape (3,): one point, transformed by each of the n rows. Shape (n, 3):
                point i is transformed by row i. Shape (n, k, 3): k points for each row.

        Returns:
            A new array of shape (n, 3) or (n, k, 3).

        Raises:
            ValueError: If the points have another shape.
        """
        given = np.asarray(points, dtype=np.float64)
        n = len(self)
        if given.shape != (3,) and (
            given.ndim not in (2, 3) or given.shape[0] != n or given.shape[-1] != 3
        ):
            raise ValueError(
                f"points for {n} transforms must have the shape (3,), ({n}, 3) or ({n}, k, 3), "
                f"not {given.shape}"
            )
        if given.ndim == 3:
            return batch.rotate(self.rotations[:, None, :], given) + self.translations[:, None, :]
        return batch.rotate(self.rotations, given) + self.translations

    def inverse(self) -> "TransformArray":
        """Return the inverse of each row: the poses of `frame_id` in `child_frame_id`."""
        back = batch.conjugate(self.rotations)
        return TransformArray(
            self.child_frame_id,
            self.frame_id,
            self.stamps,
            -batch.rotate(back, self.translations),
            batch.canonical(back),
            self.valid,
        )

    def __matmul__(self, other: "TransformArray | Transform") -> "TransformArray":
        """Chain row by row: `a_from_b @ b_from_c` is `a_from_c`.

        If `other` is a `Transform`, each row is multiplied by `other`; names and stamps are kept.

        A row is valid if both of its factors are valid; a quaternion of zeros is not valid.

        Raises:
            ValueError: If the numbers of rows differ, or the inner frame names differ.
        """
        if isinstance(other, Transform):
            translations = np.array(other.translation)
            rotations = batch.unit(np.array(other.rotation))
            child, valid = self.child_frame_id, self.valid
        elif isinstance(other, TransformArray):
            if other.frame_id != self.child_frame_id:
                raise ValueError(
                    f"'{self.frame_id}' from '{self.child_frame_id}' cannot be chained with "
                    f"'{other.frame_id}' from '{other.child_frame_id}': the child of the first "
                    "must be the parent of the second"
                )
            if len(other) != len(self):
                raise ValueError(
                    f"{len(self)} transforms cannot be chained with {len(other)} transforms: "
                    "give equal numbers of both"
                )
            translations, rotations = other.translations, other.rotations
            child, valid = other.child_frame_id, self.valid & other.valid
        else:
            return NotImplemented
        moved = batch.rotate(self.rotations, translations) + self.translations
        turned = batch.canonical(batch.multiply(self.rotations, rotations))
        # A product with zeros or NaN has no unit length: its row is not valid.
        valid = valid & (np.einsum("ij,ij->i", turned, turned) > 0.5)
        moved[~valid] = np.nan
        turned[~valid] = np.nan
        return TransformArray(self.frame_id, child, self.stamps, moved, turned, valid)

    def velocities(self) -> Velocities:
        """Return the child's linear velocity (at its origin) and angular velocity in `frame_id`.

        Row i is the mean velocity from pose i - 1 to pose i + 1. The first row uses poses 0 and 1,
        the last row uses the last two poses. A row is NaN if one of its two poses is invalid, or if
        both have the same stamp.
        """
        n = len(self)
        here = np.arange(n)
        before, after = np.maximum(here - 1, 0), np.minimum(here + 1, max(n - 1, 0))
        lasted = (self.stamps[after] - self.stamps[before]) * 1e-9
        lasted = np.where(lasted == 0.0, np.nan, lasted)[:, None]
        moved = self.translations[after] - self.translations[before]
        turned = batch.multiply(self.rotations[after], batch.conjugate(self.rotations[before]))
        return Velocities(moved / lasted, batch.rotation_vectors(turned) / lasted)

    def to_scipy(self) -> "tuple[RigidTransform, Rotation]":
        """Return scipy's `RigidTransform`, and the rotations separately as scipy's `Rotation`.

        Raises:
            UsageError: If scipy is not installed, or older than 1.16.
            ValueError: If a row is not valid.
        """
        try:
            from scipy.spatial.transform import RigidTransform, Rotation
        except ImportError as missing:
            raise UsageError(
                "to_scipy needs scipy 1.16 or newer: pip install 'scipy>=1.16'"
            ) from missing
        if not self.valid.all():
            count = int(np.count_nonzero(~self.valid))
            raise ValueError(
                f"{count} of {len(self)} rows have no pose: convert only the valid rows, "
                "poses[poses.valid].to_scipy()"
            )
        rotation = Rotation.from_quat(self.rotations)
        return RigidTransform.from_components(self.translations, rotation), rotation
