"""A link's history as numpy columns, and a question's many moments as int64."""

import numpy as np
import numpy.typing as npt

from tftool.frames import refusals
from tftool.frames.history import History
from tftool.frames.links import WORDS, Link, Sample
from tftool.geometry.batch import Floats
from tftool.stamps import whole

Stamps = npt.NDArray[np.int64]
"""Nanoseconds, shape (n,)."""


class Column:
    """What a moving link remembered when it was asked: its samples, oldest first.

    Attributes:
        stamps: Nanoseconds, shape (k,).
        samples: x, y, z and a unit quaternion x, y, z, w, shape (k, 7).
        parents: A parent's number for each sample; None where all have the same one.
    """

    __slots__ = ("parents", "samples", "stamps")

    def __init__(self, history: History) -> None:
        flat, parents = history.columns()
        records = np.frombuffer(flat, dtype=np.int64).reshape(-1, WORDS)
        self.stamps: Stamps = np.ascontiguousarray(records[:, 0])
        self.samples: Floats = np.ascontiguousarray(records.view(np.float64)[:, 1:])
        self.parents = None if parents is None else np.frombuffer(parents, dtype=np.int32)

    @property
    def oldest(self) -> int:
        """The first stamp; later than every stamp when there is none."""
        return int(self.stamps[0]) if len(self.stamps) else 2**63 - 1

    @property
    def newest(self) -> int:
        """The last stamp; earlier than every stamp when there is none."""
        return int(self.stamps[-1]) if len(self.stamps) else -(2**63)

    def changes(self) -> Stamps:
        """Where the parent may be another one than before: both ends, and each change."""
        ends = self.stamps[[0, -1]] if len(self.stamps) else self.stamps
        if self.parents is None:
            return ends
        changed = np.flatnonzero(self.parents[1:] != self.parents[:-1]) + 1
        return np.concatenate((ends, self.stamps[changed]))


class Columns:
    """The columns of every link that a question touches, each copied once."""

    __slots__ = ("_held",)

    def __init__(self) -> None:
        # The link is kept too: a number is only an identity while its object lives.
        self._held: dict[int, tuple[Link, Column | Sample | None]] = {}

    def of(self, link: Link) -> "Column | Sample | None":
        """A moving link's column, a constant's one sample."""
        held = self._held.get(id(link))
        if held is None:
            held = (link, Column(link) if isinstance(link, History) else link.newest)
            self._held[id(link)] = held
        return held[1]


def stamps_of(times: npt.ArrayLike, name: str) -> Stamps:
    """Moments as a contiguous int64 array, whatever whole numbers they come as.

    Args:
        times: Shape (n,).
        name: What they are called in a refusal.

    Raises:
        TypeError: If they are no whole numbers.
        ValueError: If the shape is another, or one does not fit 64 bits.
    """
    given = np.asarray(times)
    if given.ndim == 0:
        raise ValueError(f"{name} have the shape (n,), not (): one goes as a list, [{given}]")
    if given.ndim != 1:
        raise ValueError(f"{name} have the shape (n,), not {given.shape}")
    if given.size == 0:
        return np.zeros(0, dtype=np.int64)
    kind = given.dtype.kind
    if kind == "O":
        wholes = [whole(time) for time in given]
        unfit = [time for time in wholes if not refusals.fits(time)]
        if unfit:
            raise ValueError(f"{name} hold {unfit[0]} ns, which does not fit 64 bits")
        return np.array(wholes, dtype=np.int64)
    if kind == "u" and given.max() >= 2**63:
        raise ValueError(f"{name} hold {given.max()} ns, which does not fit 64 bits")
    if kind not in "iu":
        remedy = {
            "f": f"np.rint({name} * 1e9).astype(np.int64) makes them of seconds",
            "M": f"{name}.astype('datetime64[ns]').astype(np.int64) makes them of dates",
        }.get(kind, "seconds(2.5) makes one of 2.5 seconds")
        raise TypeError(f"{name} are whole nanoseconds (int64), not {given.dtype}: {remedy}")
    return np.ascontiguousarray(given, dtype=np.int64)
