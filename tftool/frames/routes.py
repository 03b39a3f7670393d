"""Which links answer for which moments: a forest's shape may change within a history."""

from collections.abc import Iterator
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.frames.columns import Column, Columns, Stamps
from tftool.frames.forest import ARRIVED, Forest
from tftool.frames.plans import Plan, plan_of

Rows: TypeAlias = npt.NDArray[np.intp]
"""Numbers of rows."""


def steady_plan(forest: Forest, target: int, source: int) -> Plan | None:
    """The one plan that serves all moments it has data for; None if there is no such plan."""
    walk = forest.walk(target, source, 0)
    if walk.ended != ARRIVED:
        return None
    for number in walk.visited():
        link = forest.frames[number].link
        if link is not None and link.mixed:
            return None
    return plan_of(forest, walk)


def by_moment(
    forest: Forest, columns: Columns, target: int, source: int, times: Stamps
) -> Iterator[tuple[Plan, Rows]]:
    """Each plan that some of the moments need, and the rows that need it.

    Between two stamps at which a link begins, ends or changes its parent, all moments
    share one walk. Rows that no plan is given for are refused.
    """
    marks = _marks(forest, columns, (target, source))
    # Odd on a mark, even between two.
    stretch = np.searchsorted(marks, times, "left") + np.searchsorted(marks, times, "right")
    found, first, member = np.unique(stretch, return_index=True, return_inverse=True)
    plans: dict[tuple[tuple[int, ...], tuple[int, ...]], Plan] = {}
    serves = np.full(len(found), -1)
    for at, row in enumerate(first.tolist()):
        walk = forest.walk(target, source, int(times[row]))
        if walk.ended != ARRIVED:
            continue
        key = (tuple(walk.up), tuple(walk.down))
        if key not in plans:
            plans[key] = plan_of(forest, walk)
        serves[at] = list(plans).index(key)
    serving = serves[member]
    for at, plan in enumerate(plans.values()):
        yield plan, np.flatnonzero(serving == at)


def covered(plan: Plan, columns: Columns, times: Stamps) -> npt.NDArray[np.bool_]:
    """For which moments every link of a plan has data."""
    result = np.ones(len(times), dtype=np.bool_)
    for link in plan.moving:
        column = columns.of(link)
        assert isinstance(column, Column)
        result &= (times >= column.oldest) & (times <= column.newest)
    return result


def _marks(forest: Forest, columns: Columns, frames: tuple[int, ...]) -> Stamps:
    """Every stamp at which a walk up from one of the frames may change."""
    marks: list[Stamps] = [np.zeros(0, dtype=np.int64)]
    waiting, seen = list(frames), set(frames)
    while waiting:
        link = forest.frames[waiting.pop()].link
        if link is None:
            continue
        column = columns.of(link)
        above = {link.parent}
        if isinstance(column, Column):
            marks.append(column.changes())
            if column.parents is not None:
                above.update(np.unique(column.parents).tolist())
        above -= seen
        seen |= above
        waiting.extend(number for number in above if number >= 0)
    return np.unique(np.concatenate(marks))
