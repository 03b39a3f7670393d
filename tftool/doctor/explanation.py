"""One lookup's exact trace: which link refuses, by how much, and what would let it through.

The listener is imagined: at the moment it asks it holds what had arrived by then, pruned as
tf2 prunes. What it would be told is asked of a buffer that holds the same; why, and what
helps, comes from the links and never from that text, which may quote a link that the answer
does not need.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from tftool.base.errors import ExtrapolationException, TransformException
from tftool.base.stamps import LATEST, Duration, Stamp
from tftool.doctor.findings import Edge
from tftool.doctor.model import Model
from tftool.doctor.reasons import (
    Cause,
    Remedy,
    TraceResult,
    misnamed,
    no_join,
    refusing_link,
    works,
)
from tftool.doctor.stamp_stream import Track
from tftool.doctor.trace import LinkVerdict, LookupTrace, Question, TracedLink
from tftool.doctor.wording import moment, span
from tftool.recordings.contract import Stamps

CHECK_OF = {
    Cause.LATE: "sensor-outruns-tf",
    Cause.CLOCK_OFFSET: "clock-offset",
    Cause.CLOCK_MIXTURE: "clock-mixture",
    Cause.STOPPED: "edge-stopped",
    Cause.GAP: "gap",
    Cause.BEFORE_START: "late-start",
    Cause.CACHE: "cache-short",
    Cause.UNKNOWN_FRAME: "unknown-frame",
    Cause.SPLIT: "split-tree",
    Cause.SINGLE: "single-sample",
    Cause.NAME: "slash-twins",
    Cause.LOOP: "loop",
}
"""The check that looks for each cause."""


@dataclass(frozen=True, slots=True)
class Explanation:
    """Why a lookup answers or refuses.

    Attributes:
        target: The frame asked for.
        source: The frame asked about.
        stamp: The moment asked about; 0 for the latest.
        asked: The log time at which it is asked.
        because: Why then: "when /scan of that stamp arrived"; empty where it was said.
        after: How long after the stamp that is, on the clock of the stamps, nanoseconds.
        available: Whether it answers.
        exception: What tf2 raises; empty where it answers.
        text: What that says.
        epoch: The first stamp of what moves.
        links: The way from source to target, in this order.
        refusing: The edge that refuses; None where none does, or there is no way.
        answerable_from: Log time from which on it answers; None where it never does.
        answerable_until: Log time at which what it needs is pruned; None where it never is.
        cause: Why.
        why: The same in sentences.
        remedies: What helps, the least first.
        useless: What people try and does not help, in sentences.
        failed: Of a session that was listened to, for which share of that time the same
            question would have been refused; None elsewhere.
    """

    target: str
    source: str
    stamp: Stamp
    asked: Stamp
    because: str
    after: Duration | None
    available: bool
    exception: str
    text: str
    epoch: Stamp
    links: tuple[TracedLink, ...]
    refusing: Edge | None
    answerable_from: Stamp | None
    answerable_until: Stamp | None
    cause: Cause
    why: tuple[str, ...] = ()
    remedies: tuple[Remedy, ...] = ()
    useless: tuple[str, ...] = ()
    failed: float | None = None

    @property
    def check(self) -> str | None:
        """The id of the check that looks for this cause; None where it works."""
        return CHECK_OF.get(self.cause)


def traced(model: Model, question: Question) -> Explanation:
    """Trace one lookup through what a listener would hold.

    Args:
        model: What is known of the frames.
        question: What is asked, when, and by which listener.
    """
    trace = LookupTrace(model, question)
    exception, text, quoted = "", "", None
    try:
        trace.buffer().lookup_transform(question.target, question.source, question.stamp)
    except TransformException as refused:
        exception, text = type(refused).__name__, str(refused).strip("\n")
        if isinstance(refused, ExtrapolationException):
            quoted = (refused.frame, refused.available)
    named = misnamed(trace)
    way = None if named is not None else trace.way()
    trace.settle(way or ())
    links = tuple(trace.link(track) for track in way or ())
    refusing = next(
        (number for number, link in enumerate(links) if link.verdict is not LinkVerdict.ANSWERS),
        None,
    )
    begin, end = trace.answerable(way) if way is not None else (None, None)
    known = TraceResult(trace, way, links, refusing, begin, end, available=not exception)
    if named is not None:
        told = named
    elif way is None:
        told = no_join(known)
    elif known.available:
        told = works(known)
    else:
        told = refusing_link(known)
    misleading = _misleading(links, quoted)
    return Explanation(
        target=question.target,
        source=question.source,
        stamp=question.stamp,
        asked=trace.asked,
        because=trace.because,
        after=trace.after,
        available=known.available,
        exception=exception,
        text=text,
        epoch=model.epoch,
        links=links,
        refusing=None if refusing is None or known.available else links[refusing].edge,
        answerable_from=begin,
        answerable_until=end,
        cause=told.cause,
        why=(*told.why, *misleading),
        remedies=told.remedies,
        useless=told.useless,
    )


MOMENTS = 1000
"""At how many moments of a session's last seconds a question is asked again."""


def over_time(model: Model, question: Question, found: Explanation) -> Explanation:
    """Add to an explanation for which share of the time the question would have been refused.

    Args:
        model: What was heard of a session.
        question: What was asked at its end.
        found: What was answered.
    """
    trace = LookupTrace(model, question)
    way = None if misnamed(trace) is not None else trace.way()
    # Who begins to listen has heard of each link after a period of it, at the latest two.
    grace = 2 * max((track.period for track in way or ()), default=0)
    begin = min(model.start + grace, (model.start + model.end) // 2)
    asks = np.linspace(begin, model.end, MOMENTS).astype(np.int64)
    holds = np.zeros(MOMENTS, dtype=bool) if way is None else _holds(way, asks, question)
    failed = float(np.count_nonzero(~holds)) / MOMENTS
    length = span(model.end - model.start)
    words = "works now; it would have failed" if found.available else "fails now, and would have"
    share = f"{failed * 100:.0f} %" if failed >= 0.005 or not failed else "less than 1 %"
    told = f"this lookup {words} for {share} of the last {length}"
    why = (told, *found.why) if failed or not found.available else found.why
    return replace(found, failed=failed, why=why)


def _holds(
    way: Sequence[Track], asks: Stamps, question: Question
) -> "np.ndarray[tuple[int], np.dtype[np.bool_]]":
    """At which of these log times a question is answered."""
    holds = np.ones(len(asks), dtype=bool)
    newest, oldest = [], []
    for track in way:
        if track.static:
            holds &= asks >= int(track.logs[0])
            continue
        usable = np.flatnonzero(track.usable)
        came = np.searchsorted(track.logs[usable], asks, side="right") - 1
        holds &= came >= 0
        if not len(usable):
            continue
        last = np.maximum.accumulate(track.stamps[usable])[np.maximum(came, 0)]
        first = np.minimum.accumulate(track.stamps[usable])[np.maximum(came, 0)]
        newest.append(last)
        oldest.append(np.maximum(first, last - question.settings.cache_time))
    if newest:
        common = np.minimum.reduce(newest)
        at = common if question.stamp == LATEST else np.full(len(asks), question.stamp)
        holds &= (np.maximum.reduce(oldest) <= at) & (at <= common)
    return holds


def _misleading(
    links: tuple[TracedLink, ...], quoted: tuple[str | None, Stamp] | None
) -> tuple[str, ...]:
    """That tf2 quotes a link off the way: above the target it raises what fails first."""
    if quoted is None or not links or quoted[0] in {link.child for link in links}:
        return ()
    frame, stamp = quoted
    return (
        f"tf2's text quotes {moment(stamp)}, a time of {frame}, which is not on the way: "
        "leave it out of account",
    )
