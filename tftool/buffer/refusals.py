"""Sentences with which the buffer refuses, in tf2's words."""

from collections.abc import Callable, Collection, Iterable
from typing import Final

from tftool.base.errors import (
    BackwardExtrapolationException,
    ConnectivityException,
    ExtrapolationException,
    ForwardExtrapolationException,
    InvalidArgumentException,
    LookupException,
    NoDataForExtrapolationException,
)
from tftool.base.stamps import Duration, Stamp, display
from tftool.buffer.history import BACKWARD, FORWARD, NO_DATA, Refusal

# Stamps are kept in 64 bits.
_LONGEST = 2**63

# How much of a name that is too long is told.
_NAME_SHOWN: Final = 32


def unknown(
    frame: str, argument: str, call: str, known: Collection[str], *, target: str, source: str
) -> LookupException:
    """For a name that never came up; `known` is walked only when the remedy is read."""
    return LookupException(
        f'"{frame}" passed to {call} argument {argument} does not exist. ',
        frame=frame,
        target=target,
        source=source,
        known=known,
    )


def invalid(
    frame: str, argument: str, call: str, why: str, *, target: str, source: str
) -> InvalidArgumentException:
    """For a name that can never be asked for."""
    return InvalidArgumentException(
        f'Invalid argument "{frame}" passed to {call} argument {argument} - {why}',
        target=target,
        source=source,
        frame=frame,
    )


def invalid_frame(frame: str, argument: str, why: str) -> str:
    """The sentence `can_transform` has for a name."""
    return f'Invalid frame ID "{frame}" passed to canTransform argument {argument} - {why}'


def unconnected(target: str, source: str) -> ConnectivityException:
    """For two frames of different trees."""
    return ConnectivityException(
        f"Could not find a connection between '{target}' and '{source}' because they are not "
        "part of the same tree.Tf has two or more unconnected trees.",
        target=target,
        source=source,
    )


def loop(frames: str, target: str, source: str) -> LookupException:
    """For a chain that does not end; `frames` is the list of all of them."""
    return LookupException(
        f"The tf tree is invalid because it contains a loop.\n{frames}\n",
        target=target,
        source=source,
        looped=True,
    )


def shortfall(refusal: Refusal, time: Stamp) -> str:
    """Return the sentence of a link that has no data for a moment."""
    kind, available = refusal
    asked, has = display(time), display(available)
    if kind == NO_DATA:
        return (
            f"Lookup would require extrapolation at time {asked}, but only time {has} is in the "
            "buffer"
        )
    if kind == FORWARD:
        return (
            f"Lookup would require extrapolation into the future.  Requested time {asked} but the "
            f"latest data is at time {has}"
        )
    return (
        f"Lookup would require extrapolation into the past.  Requested time {asked} but the "
        f"earliest data is at time {has}"
    )


_EXTRAPOLATIONS: dict[int, type[ExtrapolationException]] = {
    NO_DATA: NoDataForExtrapolationException,
    FORWARD: ForwardExtrapolationException,
    BACKWARD: BackwardExtrapolationException,
}


def extrapolation(
    refusal: Refusal, frame: str, time: Stamp, target: str, source: str
) -> ExtrapolationException:
    """For a link, that of `frame`, which has nothing for the moment."""
    kind, available = refusal
    return _EXTRAPOLATIONS[kind](
        f"{shortfall(refusal, time)}, when looking up transform from frame [{source}] "
        f"to frame [{target}]",
        requested=time,
        available=available,
        frame=frame,
        target=target,
        source=source,
    )


def fits(stamp: Stamp) -> bool:
    """Whether a stamp can be kept."""
    return -_LONGEST <= stamp < _LONGEST


# What a rejected sample is logged as. Numbers as C's %f writes them.


def objections(
    child: str,
    parent: str,
    stamp: Stamp,
    translation: tuple[float, float, float],
    rotation: tuple[float, float, float, float],
    authority: str,
) -> list[str]:
    """Everything that is wrong with a sample, a line each; none if it can be taken.

    Args:
        child: Without its leading slash.
        parent: Without its leading slash.
        stamp: Nanoseconds.
        translation: As it came.
        rotation: Scaled to length one; NaN if that cannot be done.
        authority: Who sent it.
    """
    lines: list[str] = []
    if child == parent:
        lines.append(self_transform(child, authority))
    if not child:
        lines.append(no_child(authority))
    if not parent:
        lines.append(no_parent(child, authority))
    if any(number != number for number in (*translation, *rotation)):
        lines.append(nan_input(child, authority, translation, rotation))
    if rotation[3] != rotation[3]:
        lines.append(denormalized(child, authority, rotation))
    if not fits(stamp):
        lines.append(bad_stamp(child, stamp, authority))
    return lines


def self_transform(child: str, authority: str) -> str:
    """Child and parent are one."""
    return (
        f'TF_SELF_TRANSFORM: Ignoring transform from authority "{authority}" with frame_id and  '
        f'child_frame_id "{child}" because they are the same'
    )


def no_child(authority: str) -> str:
    """No child named."""
    return (
        f'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "{authority}" because '
        "child_frame_id not set "
    )


def no_parent(child: str, authority: str) -> str:
    """No parent named."""
    return (
        f'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "{child}"  from authority '
        f'"{authority}" because frame_id not set'
    )


def nan_input(
    child: str, authority: str, translation: Iterable[float], rotation: Iterable[float]
) -> str:
    """A number that is none."""
    return (
        f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" from authority '
        f'"{authority}" because of a nan value in the transform ({_plain(translation)}) '
        f"({_plain(rotation)})"
    )


def denormalized(child: str, authority: str, rotation: Iterable[float]) -> str:
    """A quaternion without a direction."""
    return (
        f'TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id "{child}" from '
        f'authority "{authority}" because of an invalid quaternion in the transform '
        f"({_plain(rotation)})"
    )


def old_data(child: str, stamp: Stamp, authority: str) -> str:
    """A sample from before everything that is remembered."""
    return (
        f"TF_OLD_DATA ignoring data from the past for frame {child} at time {display(stamp)} "
        f"according to authority {authority}\nPossible reasons are listed at "
        "http://wiki.ros.org/tf/Errors%20explained"
    )


def and_more(child: str, count: int, authority: str) -> str:
    """For what else was refused of many samples that were set together."""
    samples, were = ("sample", "was") if count == 1 else ("samples", "were")
    return (
        f"and {count} more {samples} for frame {child} according to authority {authority} {were} "
        "refused; what set_transforms gave back says which"
    )


def bad_stamp(child: str, stamp: Stamp, authority: str) -> str:
    """A stamp beyond 64 bits."""
    return (
        f'TF_BAD_STAMP: Ignoring transform for child_frame_id "{child}" from authority '
        f'"{authority}" because its stamp, {stamp} ns, does not fit 64 bits'
    )


def too_many_frames(child: str, authority: str, limit: int) -> str:
    """More names than the buffer takes."""
    return (
        f'TF_TOO_MANY_FRAMES: Ignoring transform for child_frame_id "{child}" from authority '
        f'"{authority}" because the buffer holds {limit} frame names, as many as it takes; '
        "Buffer(max_frames=…) raises that"
    )


def long_name(child: str, parent: str, authority: str, limit: int) -> str:
    """Name the one of two names that is longer than the buffer takes; empty if neither is."""
    for name, field in ((child, "child_frame_id"), (parent, "frame_id")):
        # In UTF-8 no character takes more than four bytes: a short name is not written out.
        if 4 * len(name) <= limit:
            continue
        size = len(name.encode("utf-8", "surrogatepass"))
        if size > limit:
            return (
                f'TF_LONG_NAME: Ignoring transform from authority "{authority}" because its '
                f'{field} "{name[:_NAME_SHOWN]}…" has {size} bytes, and a name may have {limit}; '
                "Buffer(max_name=…) raises that"
            )
    return ""


def short_cache(cache_time: Duration) -> str:
    """A memory so short that its unit was probably mistaken."""
    return (
        f"a cache_time of {cache_time} ns forgets nearly everything at once: it is given in "
        f"nanoseconds, and seconds({cache_time}) makes one of {cache_time} s"
    )


def _plain(numbers: Iterable[float]) -> str:
    return " ".join(f"{number:f}" for number in numbers)


Log = Callable[[str, str], None]
"""Takes a level ("WARN", "ERROR") and a sentence."""


def log_to_logging(level: str, text: str) -> None:
    """Log why a buffer refused, where it was given no log of its own."""
    # Costs 10 ms at start-up, and most programs never get here.
    import logging

    logging.getLogger("tftool.buffer").log(
        logging.ERROR if level == "ERROR" else logging.WARNING, "%s", text
    )
