"""Pairs of frames and their times, parsed from a command's words."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from tftool.base.errors import LookupException, UsageError
from tftool.base.plain_text import visible
from tftool.base.stamps import LATEST, Duration, Stamp, as_seconds, seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.frames.frames import Frames
from tftool.frames.source_options import At
from tftool.recordings.find import METADATA

if TYPE_CHECKING:
    from tftool.frames.pair_samples import Moments

IDENTITY = "A frame seen from itself is always the identity."
"""Note that is printed if target and source are the same frame."""


@dataclass(frozen=True, slots=True)
class FramePair:
    """Two frames, and the time at which the source is looked up in the target.

    Attributes:
        target: Frame in which the transform is expressed.
        source: Frame whose pose is looked up.
        at: Time to look up; 0 for the latest.
        offset: Nanoseconds from now to the time to look up (negative for the past); 0 if `at` is
            used.
        fixed_frame: Fixed frame of a lookup with two times: `source` at the time to look up, and
            `target` at the latest time; None to look up both frames at the same time.
    """

    target: str
    source: str
    at: Stamp = LATEST
    offset: Duration = 0
    fixed_frame: str | None = None

    def moment(self, now: Stamp) -> Stamp:
        """Return the time to look up when the clock reads `now`; 0 for the latest."""
        return now + self.offset if self.offset else self.at

    def ask(self, buffer: Buffer, now: Stamp) -> TransformStamped:
        """Return the transform of the pair at the time to look up, for a clock that reads `now`.

        Raises:
            TransformException: If the transform is not available.
        """
        if self.target == self.source and not buffer.frame_exists(self.target):
            # tf2 returns the identity for a frame in itself, even for an unknown frame.
            raise LookupException(_unknown(self.target), frame=self.target)
        then = self.moment(now)
        if self.fixed_frame is None:
            return buffer.lookup_transform(self.target, self.source, then)
        return buffer.lookup_transform_full(
            self.target, LATEST, self.source, then, self.fixed_frame
        )

    def why_not(self, buffer: Buffer, now: Stamp) -> str:
        """Return why a lookup fails, in the words of tf2_echo; "" if the lookup succeeds."""
        if self.target == self.source and not buffer.frame_exists(self.target):
            return _unknown(self.target)
        then = self.moment(now)
        if self.fixed_frame is None:
            return buffer.why_not(self.target, self.source, then)
        return buffer.why_not_full(self.target, LATEST, self.source, then, self.fixed_frame)

    def newest(self, buffer: Buffer) -> Stamp:
        """Return the newest time at which the pair can be looked up; 0 if all is static."""
        return buffer.newest_common(self.fixed_frame or self.target, self.source)


def _unknown(frame: str) -> str:
    return f'Invalid frame ID "{frame}" - frame does not exist'


def refuse_file_as_frame(target: str, source: str, from_word: str | None) -> None:
    """Raise UsageError if `target` or `source` is a file, not a frame.

    This mistake happens if one of the three words TARGET SOURCE FROM is missing.
    """
    if from_word is not None:
        return
    for word in (target, source):
        path = Path(word)
        if (path.suffix and path.is_file()) or (path / METADATA).is_file():
            raise UsageError(
                f"'{visible(word)}' is a file, but a frame is expected here: write two frames "
                "before the file, as TARGET SOURCE FROM."
            )


def pairs_and_place(
    words: list[str], pair_values: list[str]
) -> tuple[list[tuple[str, str]], str | None]:
    """Parse a command line into pairs of frames and FROM; FROM is None if not given.

    Args:
        words: TARGET SOURCE [FROM], or [FROM] alone.
        pair_values: Values of --pair, TARGET:SOURCE.

    Raises:
        UsageError: If the words have another form, or a value of --pair is not TARGET:SOURCE.
    """
    if len(words) > (1 if pair_values else 3):
        raise UsageError(
            f"With --pair, FROM is the only word, but there are {len(words)}: leave out TARGET and "
            "SOURCE."
            if pair_values
            else f"expected TARGET SOURCE [FROM], not {len(words)} words."
        )
    if not pair_values:
        if len(words) < 2:
            return [], words[0] if words else None
        place = words[2] if len(words) > 2 else None
        refuse_file_as_frame(words[0], words[1], place)
        return [(words[0], words[1])], place
    pairs = []
    for text in pair_values:
        target, colon, source = text.partition(":")
        if not (colon and target and source):
            raise UsageError(f"--pair takes TARGET:SOURCE, such as map:base_link, not '{text}'.")
        pairs.append((target, source))
    return pairs, words[0] if words else None


class SpanOptions(Protocol):
    """Protocol of the options --from, --to, --every, --rate, --at-stamps-of, which select times."""

    first: At | None
    last: At | None
    every: Duration | None
    rate: float | None
    stamps_of: str | None


def is_chosen(options: SpanOptions) -> bool:
    """Return whether an option selects the times: --every, --rate or --at-stamps-of.

    Raises:
        UsageError: If several of these options were given.
    """
    given = [one for one in (options.every, options.rate, options.stamps_of) if one is not None]
    if len(given) > 1:
        raise UsageError(
            "--every, --rate and --at-stamps-of each choose the moments: leave out all but one."
        )
    return bool(given)


def moments_of(options: SpanOptions, frames: Frames) -> "Moments":
    """Return the times at which a pair of frames is looked up.

    Raises:
        InputError: If the recording does not have the topic of --at-stamps-of.
        UsageError: If several options select times, or --at-stamps-of is given without a recording,
            or the span has no data.
    """
    from tftool.frames.pair_samples import Moments

    ends = _span(frames, options.first, options.last)
    is_chosen(options)
    if options.stamps_of is not None:
        if frames.recording is None:
            raise UsageError(
                "--at-stamps-of is only allowed for a recording: leave out --at-stamps-of, or name "
                "a recording."
            )
        stamps = frames.recording.headers(options.stamps_of).stamps
        return Moments(*ends, stamps=stamps, words=f"at the stamps of '{options.stamps_of}'")
    return Moments(*ends, options.every if options.rate is None else seconds(1.0 / options.rate))


def _span(frames: Frames, first: At | None, last: At | None) -> tuple[Stamp | None, Stamp | None]:
    """Return the values of --from and --to as stamps; None for an option that was not given.

    Raises:
        UsageError: If --from is after --to, or the source has no data in this span.
    """
    begin, over = frames.span
    start = None if first is None else first.stamp(begin)
    end = None if last is None else last.stamp(begin)
    if start is not None and end is not None and start > end:
        raise UsageError(f"--from {first} is after --to {last}.")
    if first is not None and first.stamp(begin) > over:
        lasts = as_seconds(over - begin)
        raise UsageError(
            f"{visible(frames.label)} lasts {lasts:g} s: --from {first} is after its end."
            f"{first.meant(begin, over)}"
        )
    if end is not None and end < begin:
        begins = At(begin, is_stamp=True)
        raise UsageError(
            f"{visible(frames.label)} begins at {begins}: --to {last} is before this start."
        )
    return start, end
