"""Explanation of one lookup: the failing edge, the missing time, and the remedies.

An assumed listener makes the lookup in a real buffer, with the samples that arrived before the
lookup, and pruned as in tf2. Reasons and remedies are derived from the path's edges, because tf2's
error text may name an edge that the lookup does not need.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from tftool.base.errors import ExtrapolationException, TransformException
from tftool.base.stamps import CACHE_TIME, LATEST, Duration, Stamp
from tftool.buffer.buffer import Buffer
from tftool.doctor.evidence import evidence_of
from tftool.doctor.findings import Edge
from tftool.doctor.lookup_reasons import (
    CHECK_OF,
    Cause,
    Remedy,
    TraceResult,
    misnamed,
    no_join,
    refusing_link,
    works,
)
from tftool.doctor.model import Model, Settings
from tftool.doctor.publisher_checks import two_parents
from tftool.doctor.stamp_stream import Track
from tftool.doctor.trace import LinkVerdict, LookupTrace, Question, TracedLink
from tftool.doctor.wording import moment, several, span
from tftool.recordings.contract import Stamps

if TYPE_CHECKING:
    from tftool.frames.frames import Frames
    from tftool.recordings.recording import Recording


@dataclass(frozen=True, slots=True)
class Explanation:
    """Explanation of a lookup's result or failure.

    Attributes:
        target: Target frame of the lookup.
        source: Source frame of the lookup.
        stamp: Time of the lookup; 0 for the latest.
        asked: Log time at which the lookup is made, nanoseconds.
        because: Reason for the log time `asked`, such as "at the end"; empty
            if the user gave the time.
        after: Latency of the message with that stamp, nanoseconds; 0 without such a message. None
            for the latest time, and if the user gave the log time.
        available: Whether the lookup succeeds.
        exception: Name of tf2's exception; empty if the lookup succeeds.
        text: Text of tf2's error.
        epoch: The first stamp of moving edges.
        links: Edges of the path from source to target, in this order.
        refusing: Edge without data at the time of the lookup; None if there is no such edge or no
            path.
        answerable_from: Log time from which the lookup succeeds; None for never.
        answerable_until: Log time at which the needed samples are pruned; None for never.
        cause: Cause of the result.
        why: The cause in sentences.
        remedies: Remedies, the smallest first.
        useless: Sentences about common attempts that do not help.
        failed: Fraction of the listening time in which the same lookup would have failed; None
            unless the source is a session.
        in_whole: Whether the lookup succeeds with all samples, as in `tftool echo`.
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
    in_whole: bool = False

    @property
    def check(self) -> str | None:
        """Return the id of the doctor's check that finds this cause; None if there is none."""
        return CHECK_OF.get(self.cause)


def traced(model: Model, question: Question) -> Explanation:
    """Return the explanation of one lookup in the buffer of an assumed listener.

    Args:
        model: Model of the evidence.
        question: The lookup, and the listener that makes it.
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
    refusing = _refusing(trace, way or (), links)
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
    stamps = [track.sorted_stamps for track in way or () if not track.static]
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
        why=(*told.why, *misleading, *(_two_parents(model, links) if known.available else ())),
        remedies=told.remedies,
        useless=told.useless,
        in_whole=way is not None
        and all(len(one) > 0 and one[0] <= trace.moment <= one[-1] for one in stamps),
    )


def _refusing(trace: LookupTrace, path: Sequence[Track], links: Sequence[TracedLink]) -> int | None:
    """Return the index of the failing edge in `path`; None if no edge fails.

    If several edges fail, prefer an edge whose oldest sample is newer than the lookup's time.
    """
    refusing = [
        number for number, link in enumerate(links) if link.verdict is not LinkVerdict.ANSWERS
    ]
    for number in refusing:
        stamps = path[number].sorted_stamps
        if not path[number].static and len(stamps) > 1 and trace.moment < stamps[0]:
            return number
    return refusing[0] if refusing else None


MOMENTS = 1000
"""Number of times, in a session's last seconds, at which a lookup is repeated."""


def over_time(model: Model, question: Question, found: Explanation) -> Explanation:
    """Return `found` with the fraction of the session in which the lookup would have failed.

    Args:
        model: The evidence of a session.
        question: The lookup at the end of the session.
        found: Explanation of the lookup at the end of the session.
    """
    trace = LookupTrace(model, question)
    way = None if misnamed(trace) is not None else trace.way()
    # A new listener has a sample of each link after one or two of the link's periods.
    grace = 2 * max((track.period for track in way or ()), default=0)
    begin = min(model.start + grace, (model.start + model.end) // 2)
    asks = np.linspace(begin, model.end, MOMENTS).astype(np.int64)
    holds = np.zeros(MOMENTS, dtype=bool) if way is None else _holds(way, asks, question)
    failed = float(np.count_nonzero(~holds)) / MOMENTS
    length = span(model.end - model.start)
    words = (
        "works now; it would have failed" if found.available else "fails now, and would have failed"
    )
    share = f"{failed * 100:.0f} %" if failed >= 0.005 or not failed else "less than 1 %"
    told = f"this lookup {words} for {share} of the last {length}"
    why = (told, *found.why) if failed or not found.available else found.why
    return replace(found, failed=failed, why=why)


def _holds(
    path: Sequence[Track], asks: Stamps, question: Question
) -> "np.ndarray[tuple[int], np.dtype[np.bool_]]":
    """Return a mask of the log times `asks` at which the lookup succeeds.

    Args:
        path: Edges of the lookup's path.
        asks: Log times, nanoseconds, shape (n,).
        question: The lookup.
    """
    holds = np.ones(len(asks), dtype=bool)
    newest, oldest = [], []
    for track in path:
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


def _two_parents(model: Model, links: tuple[TracedLink, ...]) -> tuple[str, ...]:
    """Return a note for each frame of a path that is sent with several parents."""
    children = {link.child for link in links}
    parents = {
        child: [parent for parent, _ in hit.edges]
        for hit in two_parents(model)
        for child in hit.frames
    }
    return tuple(
        f"{child} has the parents {several(parents[child])}, and the one sent last before the "
        "time of the lookup counts: see two-parents in 'tftool doctor'"
        for child in parents
        if child in children
    )


def _misleading(
    links: tuple[TracedLink, ...], quoted: tuple[str | None, Stamp] | None
) -> tuple[str, ...]:
    """Return a note if tf2's error text is about a frame outside the path; else an empty tuple.

    Args:
        links: Edges of the lookup's path.
        quoted: Frame and stamp in the error text; None without such an error.
    """
    if quoted is None or not links or quoted[0] in {link.child for link in links}:
        return ()
    frame, stamp = quoted
    return (
        f"tf2's text quotes {moment(stamp)}, a time of {frame}, but {frame} is not on the "
        "path: ignore this time",
    )


def explain(
    recording: "Recording | Buffer | Frames",
    target_frame: str,
    source_frame: str,
    time: Stamp = LATEST,
    *,
    asked_at: Stamp | None = None,
    cache_time: Duration = CACHE_TIME,
    timeout: Duration = 0,
) -> Explanation:
    """Explain why a lookup succeeds or fails, with the state of each edge on its path.

    Args:
        recording: A recording, a buffer, or opened frames.
        target_frame: Frame in which to express the result.
        source_frame: Frame to look up.
        time: Time of the lookup, nanoseconds; 0 for the latest.
        asked_at: Log time at which the lookup is made. None for the arrival of the message with the
            stamp `time` in the source frame; without such a message, `time` itself. For the latest
            time and for a buffer, None is the end of the data.
        cache_time: Cache time of the listener, nanoseconds.
        timeout: Timeout of the listener's lookup, nanoseconds.

    Raises:
        InputError: If nothing of the recording can be read.
        TypeError: If the source has no frames.
    """
    settings = Settings(cache_time=cache_time)
    model = Model(evidence_of(recording), settings)
    if asked_at is None and not model.evidence.timed:
        asked_at = model.end
    return traced(model, Question(target_frame, source_frame, time, asked_at, settings, timeout))
