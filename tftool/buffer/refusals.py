"""Error and log messages of the buffer, in tf2's wording."""

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

# Stamps must fit into 64 bits.
_LONGEST = 2**63

# Number of letters of a too long name that are shown.
_NAME_SHOWN: Final = 32


def unknown(
    frame: str, argument: str, call: str, known: Collection[str], *, target: str, source: str
) -> LookupException:
    """Return the error for an unknown frame, with similar names among `known` as a hint."""
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
    """Return the error for an invalid frame name."""
    return InvalidArgumentException(
        f'Invalid argument "{frame}" passed to {call} argument {argument} - {why}',
        target=target,
        source=source,
        frame=frame,
    )


def invalid_frame(frame: str, argument: str, why: str) -> str:
    """Return `can_transform`'s sentence about an invalid frame name."""
    return f'Invalid frame ID "{frame}" passed to canTransform argument {argument} - {why}'


def unconnected(target: str, source: str) -> ConnectivityException:
    """Return the error for two frames in different trees."""
    return ConnectivityException(
        f"Could not find a connection between '{target}' and '{source}' because they are not "
        "part of the same tree.Tf has two or more unconnected trees.",
        target=target,
        source=source,
    )


def loop(frames: str, target: str, source: str) -> LookupException:
    """Return the error for a chain with a loop; `frames` is tf2's text about all frames."""
    return LookupException(
        f"The tf tree is invalid because it contains a loop.\n{frames}\n",
        target=target,
        source=source,
        looped=True,
    )


def shortfall(refusal: Refusal, time: Stamp) -> str:
    """Return tf2's sentence that a frame has no data at the requested time (extrapolation)."""
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
    """Return the error for a lookup at a time at which `frame` has no data."""
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
    """Whether a stamp fits into 64 bits."""
    return -_LONGEST <= stamp < _LONGEST


# Log lines for rejected samples, with numbers as in C's %f.


def objections(
    child: str,
    parent: str,
    stamp: Stamp,
    translation: tuple[float, float, float],
    rotation: tuple[float, float, float, float],
    authority: str,
) -> list[str]:
    """Return a log line for each fault of a sample; empty if the sample is valid.

    Args:
        child: Child frame, without its leading slash.
        parent: Parent frame, without its leading slash.
        stamp: Nanoseconds.
        translation: The translation as given, metres.
        rotation: Quaternion scaled to unit length; NaN if it cannot be scaled.
        authority: Sender of the sample.
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
    """Return the log line for a child that is its own parent."""
    return (
        f'TF_SELF_TRANSFORM: Ignoring transform from authority "{authority}" with frame_id and  '
        f'child_frame_id "{child}" because they are the same'
    )


def no_child(authority: str) -> str:
    """Return the log line for an empty child name."""
    return (
        f'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "{authority}" because '
        "child_frame_id not set "
    )


def no_parent(child: str, authority: str) -> str:
    """Return the log line for an empty parent name."""
    return (
        f'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "{child}"  from authority '
        f'"{authority}" because frame_id not set'
    )


def nan_input(
    child: str, authority: str, translation: Iterable[float], rotation: Iterable[float]
) -> str:
    """Return the log line for a sample with a number that is NaN."""
    return (
        f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" from authority '
        f'"{authority}" because of a nan value in the transform ({_plain(translation)}) '
        f"({_plain(rotation)})"
    )


def denormalized(child: str, authority: str, rotation: Iterable[float]) -> str:
    """Return the log line for a quaternion that cannot be scaled to unit length."""
    return (
        f'TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id "{child}" from '
        f'authority "{authority}" because of an invalid quaternion in the transform '
        f"({_plain(rotation)})"
    )


def old_data(child: str, stamp: Stamp, authority: str) -> str:
    """Return the log line for a sample that is too old for the buffer's `cache_time`."""
    return (
        f"TF_OLD_DATA ignoring data from the past for frame {child} at time {display(stamp)} "
        f"according to authority {authority}\nPossible reasons are listed at "
        "http://wiki.ros.org/tf/Errors%20explained"
    )


def and_more(child: str, count: int, authority: str) -> str:
    """Return the log line that counts the further rejected samples of a bulk insertion."""
    samples, were = ("sample", "was") if count == 1 else ("samples", "were")
    return (
        f"and {count} more {samples} for frame {child} according to authority {authority} {were} "
        "refused; the result of set_transforms lists all refused samples"
    )


def bad_stamp(child: str, stamp: Stamp, authority: str) -> str:
    """Return the log line for a stamp that does not fit into 64 bits."""
    return (
        f'TF_BAD_STAMP: Ignoring transform for child_frame_id "{child}" from authority '
        f'"{authority}" because its stamp, {stamp} ns, does not fit 64 bits'
    )


def too_many_frames(child: str, authority: str, limit: int) -> str:
    """Return the log line for a new frame name above the maximum number of frame names."""
    return (
        f'TF_TOO_MANY_FRAMES: Ignoring transform for child_frame_id "{child}" from authority '
        f'"{authority}" because the buffer already has {limit} frame names; '
        "Buffer(max_frames=…) raises this limit"
    )


def long_name(child: str, parent: str, authority: str, limit: int) -> str:
    """Return the log line for a frame name above `limit` bytes; "" if neither name is too long."""
    for name, field in ((child, "child_frame_id"), (parent, "frame_id")):
        # A character in UTF-8 has at most four bytes, so a short name needs no encoding.
        if 4 * len(name) <= limit:
            continue
        size = len(name.encode("utf-8", "surrogatepass"))
        if size > limit:
            return (
                f'TF_LONG_NAME: Ignoring transform from authority "{authority}" because its '
                f'{field} "{name[:_NAME_SHOWN]}…" has {size} bytes, but the limit is {limit}; '
                "Buffer(max_name=…) raises this limit"
            )
    return ""


def short_cache(cache_time: Duration) -> str:
    """Return the warning for a cache so short that the unit is probably wrong."""
    return (
        f"with a cache_time of {cache_time} ns nearly all samples are dropped at once: the unit is "
        f"nanoseconds; for {cache_time} s write seconds({cache_time})"
    )


def _plain(numbers: Iterable[float]) -> str:
    return " ".join(f"{number:f}" for number in numbers)


Log = Callable[[str, str], None]
"""Function called with a level ("WARN", "ERROR") and a sentence."""


def log_to_logging(level: str, text: str) -> None:
    """Log a line about a rejected sample with `logging`; the default of a buffer's `log`."""
    # Imported here because it takes 10 ms at start-up, and most programs never log.
    import logging

    logging.getLogger("tftool.buffer").log(
        logging.ERROR if level == "ERROR" else logging.WARNING, "%s", text
    )
