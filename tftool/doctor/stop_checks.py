"""Check for transforms that end long before the recording does."""

from collections.abc import Iterator, Mapping

import numpy as np

from tftool.base.stamps import NANOSECONDS, seconds
from tftool.doctor.check import checks_of, hit_of
from tftool.doctor.evidence import is_player
from tftool.doctor.findings import STOPPED_PERIODS, Area, Fix, Hit, Severity
from tftool.doctor.gap_checks import REPORTS, is_detection, needed_in
from tftool.doctor.model import LAP, Limits, Model
from tftool.doctor.stamp_stream import BASES, NEVER, Heard, Track, last_part
from tftool.doctor.wording import several, span
from tftool.recordings.contract import Stamps

check = checks_of(Area.COVERAGE)


@check(
    "edge-stopped",
    Severity.ERROR,
    rule="the last sample of a transform arrives more than {periods:g} periods, {seconds:g} s and "
    "a share of {share:g} of the recording before its end, while other streams continue. The "
    "transform has {samples:g} samples or more, and is not a detection of a camera: a frame "
    "without child frames, or one of three or more objects of one publisher that come and go. "
    "{commands:g} or more commands to move, without a header, such as Twist, also count as another "
    "stream. Before a backward jump of time, the last second does not count. A warning if all "
    "moving transforms end. A note if a player of recordings sent the transforms and no /clock "
    "continues, and if all messages of the robot end too and only constant transforms continue. A "
    "warning if the recording has no later scan, point cloud or range in the frame or below it. In "
    "this last case, a note for a frame without children, and for a part of a robot that did not "
    "move or has been silent for less than 60 s",
    headline="{where} {concerned:stops|stop} before the end",
    detail="{edge}: last stamp {last:moment}, which arrived {before:span} before the end; came "
    "every {period:span}{beside}",
    consequence="lookups at later times fail; the newest transform is an old pose",
    causes=(
        "a node that crashed",
        "a lost sensor",
    ),
    limits={
        "periods": STOPPED_PERIODS,
        "seconds": 2.0,
        "share": 0.05,
        "samples": 5,
        "commands": 10,
    },
    needs=("log times",),
    because_of=(
        ("stream", "clock-mixture"),
        ("child", "publisher-conflict two-parents"),
        ("edge", "parent-switch"),
    ),
)
def edge_stopped(model: Model, limits: Limits) -> Iterator[Hit]:
    """A transform ends long before the recording does."""
    length = model.end - model.start
    alive: list[Track | Heard] = [*model.dynamic]
    alive += [heard for heard in model.heard if not heard.type.startswith(REPORTS)]
    # After a pause of all streams, the first of them may arrive just before the clock jumps.
    stop = model.end - LAP if model.laps else NEVER
    ends = {id(one): int(one.logs[one.logs < stop].max(initial=model.start)) for one in alive}
    latest = max(ends.values(), default=model.start)
    for track in model.dynamic:
        if len(track.stamps) < limits["samples"]:
            continue
        last = int(track.logs[-1])
        before = model.end - last
        least = max(limits["periods"] * track.period, limits["seconds"] * NANOSECONDS)
        if before <= least or before <= limits["share"] * length:
            continue
        above = model.parents.get(track.child)
        if above is not None and above.parent != track.parent:
            continue
        if is_detection(model, track):
            continue
        # If all links end at once, as when a session's host exits, it is not the fault of one link.
        all_end = latest - last <= least
        driven = _going_on(model.evidence.commands, last, least, limits) if all_end else ""
        is_soon = last - model.start <= _AT_ONCE * length
        if all_end and not driven and (model.laps or not is_soon):
            continue
        cure = f"check whether its publisher still runs: `{{publishers}} {track.topics[0]}`"
        if source := _stopped_with(model, track):
            cure = (
                f"{source}, which has the same stamps, stops at the same time: look at its "
                f"publisher: `{{publishers}} {source}`"
            )
        is_played = model.was_played and all(map(is_player, track.nodes))
        if is_played:
            cure = "a player published it: check whether the played recording ends there"
        others_go_on = any(ends[id(other)] - last > least for other in model.dynamic)
        together = [] if source or others_go_on else _ended_with(model, alive, track, limits)
        ended_too = f"{several(together)} {'ends' if len(together) == 1 else 'end'}"
        if together and not is_played:
            cure = (
                f"{ended_too}, too: look at the robot at this time, and at its connection to the "
                "recorder"
            )
        heard = {one.topic: one.logs[one.logs < stop] for one in alive if isinstance(one, Heard)}
        heard = {topic: times for topic, times in heard.items() if _keeps_its_rate(times, last)}
        if driven:
            cure = (
                "all transforms and sensor data end here: look at the robot's drivers at this "
                "time, and at the connection to the recorder"
            )
        severity, ended = None, int(track.stamps.max())
        clock = model.evidence.clock[1]
        if is_played and all_end and bool((clock > last + least).any()):
            cure = f"all data but /clock ends at {span(last - model.start)}; {cure}"
            severity = Severity.WARNING
        elif not others_go_on:
            severity = Severity.NOTE if is_played and all_end else Severity.WARNING
        elif not is_soon and _is_shut_down(model, alive, last + least):
            severity = Severity.NOTE
        elif model.evidence.recorded and not needed_in(model, track, ended, NEVER):
            is_part = model.is_minor(track) or (
                len(model.below(track.child)) == 1 and last_part(track.child) not in BASES
            )
            # A joint that moved and has been silent for long has stopped.
            is_lost = model.is_minor(track) and track.moves and before > _SILENT
            severity = Severity.NOTE if is_part and not is_lost else Severity.WARNING
        yield hit_of(
            track,
            {
                "last": ended,
                "before": before,
                "period": track.period,
                "beside": driven
                or ("" if others_go_on else _going_on(heard, last, least, limits))
                + (f"; {ended_too} at the same time" if together else ""),
                "below": sorted(model.below(track.child)),
            },
            since=last,
            until=model.end,
            count=1,
            severity=severity,
            fixes=(Fix(cure),),
        )


def _going_on(streams: Mapping[str, Stamps], last: int, least: float, limits: Limits) -> str:
    """Return a clause about topics that go on after the last transform; "" without such topics.

    Args:
        streams: Log times of each topic's messages, ascending, nanoseconds.
        last: Log time of the last transform, nanoseconds.
        least: Minimum time from the last transform to the last message, nanoseconds.
        limits: Thresholds of `edge-stopped`.
    """
    told = ""
    for topic, times in streams.items():
        later = times[times > last]
        if len(later) >= limits["commands"] and later[-1] - last > least:
            told += f"; {topic} goes on for {span(int(later[-1]) - last)} ({len(later):,} messages)"
    return told


def _ended_with(
    model: Model, alive: "list[Track | Heard]", track: Track, limits: Limits
) -> list[str]:
    """Return the topics that end at the same moment as an edge.

    Args:
        model: Model of the evidence.
        alive: The moving edges, and the topics with headers that the robot itself sends.
        track: The edge.
        limits: Thresholds of `edge-stopped`.
    """
    times = {one.topic: one.logs for one in alive if isinstance(one, Heard)}
    times |= model.evidence.commands
    near = track.period + _AT_THE_SAME_TIME
    return [
        topic
        for topic, logs in times.items()
        if len(logs) >= limits["commands"] and abs(int(logs[-1] - track.logs[-1])) <= near
    ]


_AT_THE_SAME_TIME = seconds(0.1)
"""Maximum time between the ends of two streams that end at the same moment, nanoseconds."""


def _keeps_its_rate(times: Stamps, last: int) -> bool:
    """Whether a topic has at least half of its usual rate after a time.

    Args:
        times: Log times of the messages, ascending, nanoseconds.
        last: The time, nanoseconds.
    """
    later = np.count_nonzero(times > last)
    before = len(times) - later
    if not before or not later:
        return True
    since, until = float(last - times[0]), float(times[-1] - last)
    return bool(2 * later * since >= before * until)


def _stopped_with(model: Model, track: Track) -> str:
    """Return the first topic from which an edge that stops may be computed; "" without such topic.

    At least 90 % of the edge's stamps are those of messages of the topic, and the topic stops
    within one period of the edge.
    """
    for heard in model.heard:
        is_near = abs(int(heard.logs[-1] - track.logs[-1])) <= track.period
        if is_near and np.isin(track.stamps, heard.stamps).mean() >= _EQUAL:
            return heard.topic
    return ""


_EQUAL = 0.9
"""Minimum fraction of equal stamps of an edge that is computed from a topic."""


def _is_shut_down(model: Model, alive: "list[Track | Heard]", end: float) -> bool:
    """Whether all topics with headers end before a log time, and later transforms are constant.

    Args:
        model: Model of the evidence.
        alive: The moving edges, and the topics with headers that the robot itself sends.
        end: The log time.
    """
    later = [one for one in alive if one.logs[-1] > end]
    heard = any(isinstance(one, Heard) for one in alive)
    commands = any(len(one) and one[-1] > end for one in model.evidence.commands.values())
    constant = all(isinstance(one, Track) and not one.moves for one in later)
    return heard and constant and not commands


_SILENT = 60 * NANOSECONDS
"""Silence, nanoseconds, after which a part that moved has stopped without doubt."""

_AT_ONCE = 0.1
"""Fraction of a recording: all transforms that end before this part of it have ended too early."""
