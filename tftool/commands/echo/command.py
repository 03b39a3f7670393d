"""Implementation of `tftool echo`: a transform at times of a file, or repeatedly from a session."""

import json
import sys
from dataclasses import dataclass, replace
from pathlib import Path

from tftool.base.errors import TransformException, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import LATEST, Stamp, seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.commands.echo import EchoOptions
from tftool.commands.shared.connection import Connection, open_from
from tftool.commands.shared.notices import name_frames, notice, rivalries
from tftool.commands.shared.options import refuse, within
from tftool.commands.shared.pairs import IDENTITY, FramePair, refuse_file_as_frame
from tftool.commands.shared.printer import write
from tftool.drawing import echo_view as view
from tftool.drawing.echo_view import in_words
from tftool.frames.frames import Frames
from tftool.geometry.rigid import Transform
from tftool.opener import named
from tftool.recordings.find import Kind


@dataclass(frozen=True, slots=True)
class Printer:
    """Printer of transforms, or of failed lookups, to stdout."""

    precision: int = 3
    with_distance: bool = False
    for_programs: bool = False

    def found(self, now: Stamp, transform: TransformStamped) -> None:
        """Print a transform."""
        if self.for_programs:
            self._line(view.as_object(transform, with_distance=self.with_distance))
        elif sys.stdout.isatty():
            write(
                view.painted(transform, precision=self.precision, with_distance=self.with_distance),
                end="",
            )
            sys.stdout.flush()
        else:
            self._write(
                view.block(transform, precision=self.precision, with_distance=self.with_distance)
            )

    def failed(self, now: Stamp, refusal: TransformException, buffer: Buffer) -> None:
        """Print the error of a failed lookup."""
        if self.for_programs:
            self._line(view.failure_as_object(now, refusal))
        else:
            self._write(view.failure(now, refusal, buffer.all_frames_as_string()))

    def aged(self, now: Stamp) -> None:
        """Do nothing: text on stdout is not redrawn when the age of a transform changes."""

    def _line(self, what: object) -> None:
        self._write(json.dumps(what, allow_nan=False) + "\n")

    def _write(self, text: str) -> None:
        sys.stdout.write(text)
        sys.stdout.flush()


def run(connection: Connection, options: EchoOptions) -> ExitStatus:
    """Run `tftool echo`: print transforms of a file or a session."""
    frames = options.target, options.source
    options.place, options.rate = _place_or_rate(options.place, options.rate)
    place = options.place
    refuse(
        (
            options.once and options.count not in (None, 1),
            f"--once and --count {options.count} contradict each other: leave one out.",
        ),
        (
            options.at is not None and options.count not in (None, 1),
            f"--at looks up one moment and prints one transform, not {options.count}: leave out "
            "--count.",
        ),
        (
            options.fixed_frame is not None and options.offset is None,
            "--fixed-frame needs --offset: FRAME connects SOURCE at that time with TARGET now.",
        ),
        (
            options.at is not None and options.offset is not None,
            "--at and --offset both set the time of the lookup: leave one out.",
        ),
    )
    refuse_file_as_frame(*frames, place)
    _check_names(*frames, *([] if options.fixed_frame is None else [options.fixed_frame]))
    kind = None if place is None else named(place).kind
    is_file = kind not in (None, Kind.SCENARIO)
    if options.stamps_of is not None and not (
        is_file and options.at is None and options.offset is None
    ):
        raise UsageError("--at-stamps-of needs a recording as FROM: leave out --at and --offset.")
    printer = Printer(options.precision, options.distance, options.for_programs)
    pair = FramePair(*frames, offset=options.offset or 0, fixed_frame=options.fixed_frame)
    is_one_moment = options.stamps_of is None and (
        options.once or options.at is not None or options.offset is not None
    )
    if kind is not None and kind.is_recording and not is_one_moment:
        connection.refuse_to_share(place)
        notice(f"{in_words(*frames)}:")
        opened = open_from(connection, place, cache_time=options.cache_time)
        print_span(opened, options, printer)
    elif is_file or options.at is not None:
        _print_moment(connection, options, pair, printer)
    else:
        from tftool.commands.echo.echo_loop import print_live

        print_live(connection, options, pair, printer)
    return ExitStatus.DONE


def _print_moment(
    connection: Connection, options: EchoOptions, pair: FramePair, printer: Printer
) -> None:
    """Print a file's transform at the time of --at; without --at, the newest transform."""
    at = options.at
    frames = open_from(connection, options.place, until=at, cache_time=options.cache_time)
    heading = in_words(pair.target, pair.source)
    if at is not None:
        pair = replace(pair, at=frames.moment(at))
        heading += f", at {at}" if at.is_stamp else f", {at} after {frames.title} began"
    notice(f"{heading}:")
    if pair.target == pair.source:
        notice(IDENTITY)
    buffer, now = frames.buffer, frames.span[1]
    try:
        found = pair.ask(buffer, now)
    except TransformException:
        asked = (pair.target, pair.source, pair.fixed_frame)
        name_frames(buffer.frames(), asked, "so far")
        raise
    printer.found(now, found)
    for sentence in rivalries(buffer, buffer.chain(pair.target, pair.source)):
        notice(sentence)


def _place_or_rate(word: str | None, rate: float | None) -> tuple[str | None, float | None]:
    """Return the source of the frames and the rate, from the third word and --rate.

    As in tf2_echo, a third word that is a number is the rate, unless a file has that name.

    Raises:
        UsageError: If the rate is given twice.
    """
    if word is None:
        return word, rate
    try:
        number = float(word)
    except ValueError:
        return word, rate
    if Path(word).exists():
        return word, rate
    if rate is not None:
        raise UsageError(
            f"The rate is given twice, as {word} and as --rate {rate:g}: leave one out."
        )
    return None, within(0.001, 1000)(number)


def _check_names(*frames: str) -> None:
    for frame in frames:
        if not frame:
            raise UsageError("TARGET or SOURCE is empty: write the name of a frame, such as map.")
        if frame.startswith("/"):
            raise UsageError(
                f"Frame \"{frame}\": in tf2 frame_ids cannot start with a '/'. "
                f"Write {frame.lstrip('/') or 'the name without the slash'}."
            )


def print_span(frames: Frames, options: EchoOptions, printer: Printer) -> None:
    """Print a pair's transforms at many times; report on stderr how many lookups failed.

    The times are the stamps of the topic in --at-stamps-of, or evenly spaced by --rate from the
    first stamp on.

    Raises:
        InputError: If the recording does not have the topic.
        UsageError: If there are more times than can be looked up at once.
        TransformException: If every lookup fails.
    """
    pair, topic = (options.target, options.source), options.stamps_of
    # Imported here: it needs numpy, which a lookup at one time does not.
    from tftool.frames.pair_samples import evenly

    buffer = frames.buffer
    name_frames(buffer.frames(), pair)
    if topic is not None and frames.recording is not None:
        stamps = frames.recording.headers(topic).stamps
    elif frames.span[1] == LATEST:
        # Static transforms of a pose file have no time.
        printer.found(LATEST, buffer.lookup_transform(*pair))
        return
    else:
        stamps = evenly(*frames.span, seconds(1.0 / (options.rate or 1.0)))
    path = buffer.lookup_transforms(*pair, stamps, missing="nan")
    rows = path.valid.nonzero()[0]
    if len(stamps) and not len(rows):
        # Raises the error of the first lookup.
        buffer.lookup_transform(*pair, int(stamps[0]))
    for row in rows[: options.count].tolist():
        x, y, z = path.translations[row].tolist()
        qx, qy, qz, qw = path.rotations[row].tolist()
        pose = Transform((x, y, z), (qx, qy, qz, qw))
        stamp = int(stamps[row])
        printer.found(stamp, TransformStamped(stamp, *pair, pose))
    if len(rows) < len(stamps):
        notice(f"{len(stamps) - len(rows)} of {len(stamps)} lookups failed.")
