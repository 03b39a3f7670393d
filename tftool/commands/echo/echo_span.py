"""One pair over the whole span of a recording, printed at many times."""

import numpy as np

from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.commands.echo.echo_printer import Printer
from tftool.commands.shared.notices import name_frames, notice
from tftool.frames.frames import Frames
from tftool.frames.pair_samples import evenly
from tftool.geometry.rigid import Transform


def print_span(
    frames: Frames,
    pair: tuple[str, str],
    printer: Printer,
    *,
    rate: float | None,
    topic: str | None,
    most: int | None,
) -> None:
    """Print a pair at many times; report on stderr at how many there is no answer.

    Args:
        frames: The recording.
        pair: Target and source.
        printer: How an answer is printed.
        rate: Moments a second, from the first stamp on; once a second if None.
        topic: Ask at the stamps of its messages instead.
        most: How many to print; all if None.

    Raises:
        InputError: If it has no such topic.
        UsageError: If there are more moments than can be asked for at once.
        TransformException: If the pair cannot be looked up at any of them.
    """
    buffer = frames.buffer
    name_frames(buffer.frames(), pair)
    if topic is not None and frames.recording is not None:
        stamps = frames.recording.headers(topic).stamps
    else:
        stamps = evenly(*frames.span, seconds(1.0 / (rate or 1.0)))
    path = buffer.lookup_transforms(*pair, stamps, missing="nan")
    rows = np.flatnonzero(path.valid)
    if len(stamps) and not len(rows):
        # Says why, of the first.
        buffer.lookup_transform(*pair, int(stamps[0]))
    for row in rows[:most].tolist():
        x, y, z = path.translations[row].tolist()
        qx, qy, qz, qw = path.rotations[row].tolist()
        pose = Transform((x, y, z), (qx, qy, qz, qw))
        stamp = int(stamps[row])
        printer.found(stamp, TransformStamped(stamp, *pair, pose))
    if len(rows) < len(stamps):
        notice(f"{len(stamps) - len(rows)} of {len(stamps)} lookups were refused.")
