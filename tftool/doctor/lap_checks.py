"""Check for recordings in which time goes back, as at the next lap of a looped bag."""

from collections.abc import Iterator

import numpy as np

from tftool.doctor.check import checks_of, threads
from tftool.doctor.findings import Area, Fix, Hit, Severity
from tftool.doctor.model import LAP, Limits, Model
from tftool.doctor.wording import moment, span

check = checks_of(Area.CLOCKS)


@check(
    "time-jump-back",
    Severity.ERROR,
    rule="within 1 s, at least two streams and at least half of all streams step back by more than "
    "1 s",
    headline="time went back by {steps}, {count:times}{loop}",
    detail="at log time {moment:moment}: from {before:moment} to {after:moment}, {streams} "
    "streams{pause}; all other findings are about the data before it",
    consequence="{so}",
    causes=("play --loop", "a simulation was reset", "NTP set the clock back while running"),
    links=threads("ros2/geometry2#606", "ros/geometry2#43"),
    needs=("log times",),
    why="a listener notices only a step of its own clock; a looped recording would trigger forty "
    "other checks, so all of them use only the first pass",
)
def time_jump_back(model: Model, limits: Limits) -> Iterator[Hit]:
    """Time went back, as in a looped bag or after a reset of a simulation."""
    if not model.laps:
        return
    first, count = model.laps[0], _counts(model)
    so = model.words["jumped_back"]
    if not _is_seen(model):
        so = f"without /clock no listener notices{_mixed(model, sum(count))}"
    steps = sorted(lap.before - lap.after for lap in model.laps)
    is_loop = steps[-1] - steps[0] < max(LAP, 0.1 * steps[-1])
    loop, fix = "", Fix("look at what stepped at that time: a simulation, a player, or a clock")
    if _is_played_again(model):
        loop = ": a recording was played in a loop"
        fix = Fix("play it once ({loop_option}), or restart the listeners at each lap")
        if not is_loop:
            loop = f": data was played again{_beside_live_data(model)}"
            rest = sum(count[1:])
            held = (
                f" (the {len(count) - 1} later parts hold {rest:,} of {sum(count):,} transforms)"
                if 2 * rest > sum(count)
                else ""
            )
            fix = Fix(
                f"cut the recording where time goes back; the first part is{held}:",
                f"tftool edit RECORDING -o PART --record-time --to {moment(first.log - 1_000_000)}",
            )
    yield Hit(
        since=first.log,
        until=model.laps[-1].log,
        count=len(model.laps),
        facts={
            "moment": first.log,
            "before": first.before,
            "after": first.after,
            "back": first.before - first.after,
            "streams": first.streams,
            "pause": _pause(model),
            "count": len(model.laps),
            "steps": " to ".join(dict.fromkeys((span(steps[0]), span(steps[-1])))),
            "loop": loop,
            "so": so,
        },
        fixes=(fix,),
        alone=True,
    )


def _pause(model: Model) -> str:
    """Return a clause about the time before the first jump in which nothing arrived, or ""."""
    stop = model.end - LAP
    # A player sends its static transforms first, about one second earlier.
    arrivals = [one.logs for one in (*model.dynamic, *model.heard)]
    arrivals += [model.evidence.clock[1], *model.evidence.commands.values()]
    last = max(int(logs[logs < stop].max(initial=model.start)) for logs in arrivals)
    if stop - last < _PAUSE:
        return ""
    told = f"no moving transform and no message with a header arrived for {span(model.end - last)}"
    return f"; before it, {told}"


_PAUSE = 10 * LAP
"""Minimum time without arrivals that is told, nanoseconds."""


def _is_seen(model: Model) -> bool:
    """Whether listeners can notice a jump back, because their own clock also goes back."""
    read, _ = model.evidence.clock
    steps_back = bool((np.diff(read) < -LAP).any())
    return steps_back or any(track.families[0] for track in model.dynamic)


def _counts(model: Model) -> list[int]:
    """Return the number of moving transforms in each lap: before, between and after the jumps."""
    logs = np.concatenate([np.zeros(0, np.int64), *(track.all_logs for track in model.dynamic)])
    parts = np.searchsorted([lap.log for lap in model.laps], logs, side="right")
    counts: list[int] = np.bincount(parts, minlength=len(model.laps) + 1).tolist()
    return counts


def _mixed(model: Model, count: int) -> str:
    """Return a clause about a buffer that is not cleared when data from the past arrives.

    The buffer drops transforms older than the cache time, and mixes other old poses with new poses.

    Args:
        model: Model of the evidence.
        count: Number of all moving transforms.
    """
    dropped, cache = 0, model.settings.cache_time
    for track in model.dynamic:
        newest = np.maximum.accumulate(track.all_stamps)
        dropped += int(np.count_nonzero(newest - track.all_stamps > cache))
    told = f" drops {dropped:,} of {count:,} transforms as older than {span(cache)} (TF_OLD_DATA),"
    return f": its buffer{f'{told} and' if dropped else ''} mixes old poses with newer ones"


def _beside_live_data(model: Model) -> str:
    """Return " among live data" if a recording was played beside live publishers, else ""."""
    late = np.concatenate([track.all_logs - track.all_stamps for track in model.dynamic])
    shares = float(np.mean(np.abs(late) < LAP)), float(np.mean(late > 10 * LAP))
    return " among live data" if min(shares) > 0.1 else ""


def _is_played_again(model: Model) -> bool:
    """Whether the transforms after the jump in time are bitwise copies of those before the jump."""
    fewest = again = 0
    for track in model.dynamic:
        rows = np.ascontiguousarray(track.records).view("V64").ravel()
        parts = np.unique(rows[: track.lap]), np.unique(rows[track.lap :])
        # The recorder may have begun or ended in the middle of a lap.
        fewest += min(len(part) for part in parts)
        again += len(np.intersect1d(*parts, assume_unique=True))
    return again > 0.9 * fewest > 0
