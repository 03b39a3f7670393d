"""Joint positions of a robot over time."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Stamps: TypeAlias = npt.NDArray[np.int64]
Floats: TypeAlias = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class JointStates:
    """Positions of some joints at many times.

    Attributes:
        names: The joints, in the order of the columns.
        stamps: Nanoseconds, shape (n,).
        positions: Radians or metres, shape (n, len(names)).
    """

    names: Sequence[str]
    stamps: Stamps
    positions: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "names", tuple(self.names))
        object.__setattr__(self, "stamps", np.asarray(self.stamps, dtype=np.int64))
        object.__setattr__(self, "positions", np.asarray(self.positions, dtype=np.float64))
        count = len(self.stamps) if self.stamps.ndim == 1 else -1
        if self.positions.shape != (count, len(self.names)):
            raise ValueError(
                f"stamps has shape {self.stamps.shape} and positions {self.positions.shape}; "
                f"{len(self.names)} joints need (n,) and (n, {len(self.names)})"
            )
        if len(set(self.names)) != len(self.names):
            raise ValueError("a joint is named twice")

    def __len__(self) -> int:
        return len(self.stamps)
