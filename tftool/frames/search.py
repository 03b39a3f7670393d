"""Which sample each of many moments comes after."""

import numpy as np
import numpy.typing as npt

from tftool.frames.columns import Column, Stamps

Indices = npt.NDArray[np.intp]

# A bucket that holds more samples than this is searched instead.
_MOST_STEPS = 3


class Buckets:
    """Finds samples by cutting a history's time into short spans of equal length.

    For moments in no order: two fetches and a comparison instead of a binary search.
    Spans are a power of two of nanoseconds long, and at most half as long as the samples
    are apart, so that nearly always one comparison decides.
    """

    __slots__ = ("_before", "_next", "_oldest", "_shift", "_stamps", "_steps")

    def __init__(self, stamps: Stamps) -> None:
        self._stamps = stamps
        self._oldest = int(stamps[0])
        span = int(stamps[-1]) - self._oldest
        self._shift = max((span // (2 * len(stamps))).bit_length() - 1, 0)
        count = (span >> self._shift) + 1
        starts = self._oldest + (np.arange(count, dtype=np.int64) << self._shift)
        before = np.searchsorted(stamps, starts, "right") - 1
        self._before: Indices = before
        after = np.append(before[1:], len(stamps) - 1)
        self._steps = int((after - before).max())
        # The stamp at which the sample after each one begins; there is none after the last.
        self._next: Stamps = np.append(stamps[1:], np.int64(2**63 - 1))

    def find(
        self, times: Stamps, index: Indices, spare: Stamps, later: npt.NDArray[np.bool_]
    ) -> None:
        """Write into `index` the last sample at or before each moment."""
        if self._steps > _MOST_STEPS:
            index[:] = np.searchsorted(self._stamps, times, "right") - 1
            return
        np.subtract(times, self._oldest, out=spare)
        np.right_shift(spare, self._shift, out=spare)
        np.take(self._before, spare, out=index, mode="clip")
        for _ in range(self._steps):
            np.take(self._next, index, out=spare, mode="clip")
            np.less_equal(spare, times, out=later)
            np.add(index, later, out=index)


def find_sorted(stamps: Stamps, times: Stamps, index: Indices) -> None:
    """Write into `index` the last sample at or before each moment; moments in order.

    Where samples are fewer than moments, it is the samples that are searched for.
    """
    first, last = (stamps.searchsorted(times[[0, -1]], "right") - 1).tolist()
    if last - first > len(times):
        np.subtract(np.searchsorted(stamps[first : last + 1], times, "right"), 1 - first, out=index)
        return
    # Counted up from one sample to the next: other than `repeat`, that lets threads run.
    index.fill(0)
    np.add.at(index, times.searchsorted(stamps[first + 1 : last + 1], "left"), 1)
    index[0] += first
    np.add.accumulate(index, 0, None, index)


def settle_oldest(column: Column, times: Stamps, index: Indices) -> None:
    """Of several samples at the oldest stamp, take the first that came."""
    stamps = column.stamps
    if len(stamps) > 2 and stamps[0] == stamps[1] and stamps[0] != stamps[-1]:
        index[times == stamps[0]] = 0
