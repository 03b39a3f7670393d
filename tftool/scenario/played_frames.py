"""The frames of a scenario, played on simulated time."""

import math
from collections.abc import Callable
from dataclasses import replace

from tftool.base.escaping import visible
from tftool.base.stamps import Duration, seconds
from tftool.frames.frames import Frames
from tftool.frames.moment import At, checked_moment
from tftool.recordings.find import Found
from tftool.scenario.load import load
from tftool.scenario.play import build
from tftool.world.clock import SimClock
from tftool.world.frame_listener import heard_in, run_apart
from tftool.world.world import World

USUAL = seconds(5)
"""How long a scenario is played unless more is asked for."""


def played(
    found: Found,
    until: Duration | float | At | None,
    margin: Duration,
    cache_time: Duration | None,
    watch: Callable[[World], object] | None,
) -> Frames:
    """Play a scenario on simulated time, and return all its transforms.

    Args:
        found: File.
        until: The last moment: a duration, infinity for all of it, or a moment that must lie
            inside; `USUAL` if None.
        margin: Seconds to play on after a moment, for transforms that arrive after their stamp.
        cache_time: Cache time of the buffers, in place of the scenario's own; unlimited if None.
        watch: Called with its world before it lives.

    Raises:
        NodeFailed: If a node raised.
        UsageError: If the moment is outside the span.
    """
    scenario = replace(load(found.paths[0], expects=False), expect=())
    if cache_time is not None:
        scenario = replace(scenario, cache_time=cache_time)
    clock = SimClock()
    start, whole = clock.epoch, scenario.duration
    if until is None:
        end, margin = start + min(USUAL, whole), 0
    elif isinstance(until, At):
        end = checked_moment(until, f"scenario '{visible(scenario.name)}'", start, whole)
    elif math.isinf(until):
        end, margin = start + whole, 0
    else:
        end = start + int(until)
    play = build(scenario, clock)
    if watch is not None:
        watch(play.world)
    # What the listener forgets counts from `end` on.
    memory = None if cache_time is None else cache_time + margin
    with heard_in(play.world, memory) as (buffer, log):
        run_apart(clock, play.live(end + margin))
    return Frames("scenario", scenario.name, buffer=buffer, span=(start, end), log=log, found=found)
