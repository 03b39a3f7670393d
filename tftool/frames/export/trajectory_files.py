"""Writers of trajectory files (TUM, KITTI, EuRoC, CSV, npz, Parquet), and fast number formatting.

Stamps stay whole nanoseconds, because seconds since 1970 have steps of 238 ns as floats. A file
appears under its final name only when it is complete.
"""

import csv
import io
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import BinaryIO, Final, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.base.errors import UsageError
from tftool.base.stamps import SIMULATED_BELOW
from tftool.buffer.batch.transform_array import TransformArray
from tftool.frames.export.export_formats import DECIMALS, Format, Style
from tftool.frames.pair_samples import Trajectory
from tftool.geometry import rigid_arrays as batch
from tftool.recordings.containers import library_name
from tftool.recordings.contract import Progress
from tftool.recordings.target import whole_file, whole_files

Floats: TypeAlias = npt.NDArray[np.float64]
Words: TypeAlias = npt.NDArray[np.uint32]
Stamps: TypeAlias = npt.NDArray[np.int64]

FULL: Final = 17
"""Number of decimals from which a number is written as the shortest text that reads back equal."""

BLOCK: Final = 4096
"""Number of rows formatted together; their text fits into the processor's cache."""

_SCALE: Final = 10**DECIMALS
_LARGEST: Final = 9.0e9
_FOUR: Final = 10_000


def _table(texts: Sequence[bytes]) -> Words:
    return np.frombuffer(b"".join(text.ljust(4, b"\0") for text in texts), dtype=np.uint32)


_PLAIN: Final = _table([b"%04d" % n for n in range(_FOUR)])
_LEADING: Final = _table([b"%d" % n for n in range(_FOUR)])
# Zeros before the first digit become unused bytes.
_LEADING_OR_NOTHING: Final = np.where(np.arange(_FOUR) == 0, 0, _LEADING).astype(np.uint32)
_POINT: Final = _table([b".%d" % n for n in range(10)])


def rows_as_text(
    numbers: Floats, *, stamps: Stamps | None = None, seconds: bool = False, separator: str = ","
) -> bytes:
    """Format rows of numbers as text: one line per row, nine decimals per number.

    Args:
        numbers: Finite numbers below 9e9, shape (n, k).
        stamps: Stamps to write at the beginning of rows, nanoseconds, shape (n,); None for none.
        seconds: Whether stamps are written as seconds with nine decimals, not as nanoseconds.
        separator: Character between numbers.
    """
    scaled = np.rint(np.abs(numbers) * _SCALE).astype(np.int64)
    scaled = np.where(numbers < 0.0, -scaled, scaled)
    parts = []
    if stamps is not None:
        parts.append(_decimals(stamps[:, np.newaxis], b"") if seconds else _whole(stamps))
    between = separator.encode("ascii")
    if stamps is None:
        parts.append(_decimals(scaled[:, :1], b""))
        scaled = scaled[:, 1:]
    parts.append(_decimals(scaled, between))
    parts.append(np.broadcast_to(_table([b"\n"]), (len(numbers), 1)))
    text = np.concatenate(parts, axis=1).view(np.uint8).ravel()
    written: bytes = text[text != 0].tobytes()
    return written


def fits(numbers: Floats) -> bool:
    """Whether `rows_as_text` can format these numbers; other numbers need `exact_rows`."""
    # Comparisons with NaN are false, so NaN does not fit.
    return bool((np.abs(numbers) < _LARGEST).all())


def exact_rows(
    numbers: Floats,
    decimals: int,
    *,
    stamps: Stamps | None = None,
    seconds: bool = False,
    separator: str = ",",
) -> bytes:
    """Format rows with any number of decimals, more slowly than `rows_as_text`."""
    lines = []
    for place, row in enumerate(numbers.tolist()):
        words = [_shortest(one) if decimals >= FULL else f"{one:.{decimals}f}" for one in row]
        if stamps is not None:
            stamp = int(stamps[place])
            words.insert(0, stamp_text(stamp) if seconds else str(stamp))
        lines.append(separator.join(words))
    return "".join(f"{line}\n" for line in lines).encode("ascii")


def stamp_text(stamp: int) -> str:
    """Format a stamp as seconds with nine decimals, without floating point."""
    whole, rest = divmod(abs(stamp), _SCALE)
    return f"{'-' if stamp < 0 else ''}{whole}.{rest:09}"


def _shortest(number: float) -> str:
    text = repr(number)
    # Some readers do not support exponents: write 1e-09 with decimals.
    return text if "e" not in text or "inf" in text else f"{number:.30f}".rstrip("0")


def _whole(values: Stamps) -> Words:
    """Format whole numbers, shape (n,), as text with four characters per word, shape (n, w)."""
    return _digits(values[:, np.newaxis], b"")[:, 0]


def _decimals(scaled: npt.NDArray[np.int64], before: bytes) -> Words:
    """Format numbers with nine decimals as digits in 32-bit words, shape (n, k·w).

    Args:
        scaled: Numbers times 1e9, shape (n, k).
        before: Bytes to write before each number.
    """
    count, width = scaled.shape
    size = np.abs(scaled)
    whole = size // _SCALE
    rest = size - whole * _SCALE
    upper = rest // _FOUR
    first = upper // _FOUR
    text = np.concatenate(
        [
            _digits(whole, before, negative=scaled < 0),
            np.stack(
                [
                    _POINT[first],
                    _PLAIN[upper - first * _FOUR],
                    _PLAIN[rest - upper * _FOUR],
                ],
                axis=2,
            ),
        ],
        axis=2,
    )
    return text.reshape(count, width * text.shape[2])


def _digits(
    values: npt.NDArray[np.int64], before: bytes, *, negative: npt.NDArray[np.bool_] | None = None
) -> Words:
    """Format whole numbers as text in 32-bit words, shape (n, k, w).

    Args:
        values: Whole numbers, shape (n, k).
        before: Bytes to write before each number.
        negative: Mask of the numbers with a minus sign; None for the numbers below 0.
    """
    size = np.abs(values)
    signs = _table([before, before + b"-"])
    words = [signs[((values < 0) if negative is None else negative).astype(np.intp)]]
    groups = [size]
    while int(groups[-1].max(initial=0)) >= _FOUR:
        groups.append(groups[-1] // _FOUR)
    for number in range(len(groups) - 1, -1, -1):
        group = groups[number]
        if number == len(groups) - 1:
            words.append((_LEADING if number == 0 else _LEADING_OR_NOTHING)[group])
            continue
        above = groups[number + 1]
        own = group - above * _FOUR
        lead = _LEADING if number == 0 else _LEADING_OR_NOTHING
        words.append(np.where(above > 0, _PLAIN[own], lead[own]))
    return np.stack(words, axis=2)


CSV_COLUMNS: Final = ("stamp_ns", "x_m", "y_m", "z_m", "qx", "qy", "qz", "qw")
RPY_COLUMNS: Final = ("roll_rad", "pitch_rad", "yaw_rad")
EUROC_HEADER: Final = (
    "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],"
    "q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n"
)
NPZ_VERSION: Final = 1
"""Value of `format_version` in npz files; raised when names or their order change."""

_BYTES_PER_ROW: Final = 110


TrajectoryWriter: TypeAlias = Callable[
    [Sequence[Trajectory], Path, Style, bool, Progress | None], list[Path]
]
"""Function that writes pairs to a path, and returns the paths of the written files.

If the format supports a single pair, only the first is written. The boolean tells whether existing
files may be replaced.
"""


def _write_tum(
    found: Sequence[Trajectory], path: Path, style: Style, force: bool, progress: Progress | None
) -> list[Path]:
    """Write a TUM file: `sec.nnnnnnnnn x y z qx qy qz qw`, one line per pose."""
    rows = found[0].answered()
    with whole_file(path, force=force) as file:
        write = _writer(file, rows, style.decimals, progress)
        for block in _blocks(rows):
            write(block.stamps, _poses(block), seconds=True, separator=" ")
    return [path]


def _write_kitti(
    found: Sequence[Trajectory], path: Path, style: Style, force: bool, progress: Progress | None
) -> list[Path]:
    """Write a KITTI file, with the three rows of a pose's matrix in a line, and a file of stamps.

    Both files appear when they are complete, the file with poses last.
    """
    times = path.with_name(f"{path.stem}_times.txt")
    rows = found[0].answered()
    with whole_files(times, path, force=force) as (beside, file):
        write = _writer(file, rows, style.decimals, progress)
        for block in _blocks(rows):
            matrices = batch.matrices(block.translations, block.rotations)
            write(None, matrices[:, :3].reshape(-1, 12), separator=" ")
            beside.write("".join(f"{stamp_text(one)}\n" for one in block.stamps.tolist()).encode())
    return [path, times]


def _write_euroc(
    found: Sequence[Trajectory], path: Path, style: Style, force: bool, progress: Progress | None
) -> list[Path]:
    """Write a EuRoC file: whole nanoseconds, position, quaternion with w first."""
    rows = found[0].answered()
    with whole_file(path, force=force) as file:
        file.write(EUROC_HEADER.encode())
        write = _writer(file, rows, style.decimals, progress)
        for block in _blocks(rows):
            write(block.stamps, _poses(block)[:, [0, 1, 2, 6, 3, 4, 5]])
    return [path]


def _write_csv(
    found: Sequence[Trajectory], path: Path, style: Style, force: bool, progress: Progress | None
) -> list[Path]:
    """Write a CSV file with a header; with several pairs, rows begin with target and source."""
    with whole_file(path, force=force) as file:
        names = (*CSV_COLUMNS, *(RPY_COLUMNS if style.rpy else ()))
        several = len(found) > 1
        file.write(_csv_line(("target", "source", *names) if several else names))
        for one in found:
            rows = one.answered()
            before = _csv_line((one.target, one.source))[:-1] + b"," if several else b""
            write = _writer(file, rows, style.decimals, progress, before)
            for block in _blocks(rows):
                numbers = _poses(block)
                if style.rpy:
                    numbers = np.hstack([numbers, batch.roll_pitch_yaw(block.rotations)])
                write(block.stamps, numbers)
    return [path]


def _write_npz(
    found: Sequence[Trajectory], path: Path, style: Style, force: bool, progress: Progress | None
) -> list[Path]:
    """Write a NumPy archive without pickles: stamps, translations, rotations (x y z w).

    Rows of several pairs are concatenated; the array `pair` has the number of each row's pair.
    """
    rows = [one.answered() for one in found]
    several = len(rows) > 1
    columns = {
        "stamps": _joined([one.stamps for one in rows]),
        "translations": _joined([one.translations for one in rows]),
        "rotations": _joined([one.rotations for one in rows]),
        "target": np.array([one.target for one in found] if several else found[0].target),
        "source": np.array([one.source for one in found] if several else found[0].source),
        "format_version": np.array(NPZ_VERSION),
    }
    if several:
        columns["pair"] = np.repeat(np.arange(len(rows)), [len(one) for one in rows])
    with whole_file(path, force=force) as file:
        np.savez(file, allow_pickle=False, **columns)
    return [path]


def _write_parquet(
    found: Sequence[Trajectory], path: Path, style: Style, force: bool, progress: Progress | None
) -> list[Path]:
    """Write a Parquet file with the columns of the CSV format.

    If stamps count from 1970, the file also has a column `stamp` of the type timestamp.

    Raises:
        UsageError: If the extra `parquet` is not installed.
    """
    try:
        import pyarrow.parquet
    except ImportError as missing:
        raise UsageError("Parquet needs an extra: pip install 'tftool-tf2[parquet]'") from missing
    rows = [one.answered() for one in found]
    stamps = _joined([one.stamps for one in rows])
    numbers = _joined([_poses(one) for one in rows])
    columns: dict[str, object] = {}
    if len(found) > 1:
        for name, words in (
            ("target", [one.target for one in found]),
            ("source", [one.source for one in found]),
        ):
            places = np.repeat(np.arange(len(rows), dtype=np.int32), [len(one) for one in rows])
            columns[name] = pyarrow.DictionaryArray.from_arrays(places, words)
    if len(stamps) and int(stamps.min()) >= SIMULATED_BELOW:
        columns["stamp"] = pyarrow.array(stamps, pyarrow.timestamp("ns", tz="UTC"))
    columns["stamp_ns"] = stamps
    columns |= {name: numbers[:, place] for place, name in enumerate(CSV_COLUMNS[1:])}
    if style.rpy:
        angles = batch.roll_pitch_yaw(_joined([one.rotations for one in rows]))
        columns |= {name: angles[:, place] for place, name in enumerate(RPY_COLUMNS)}
    table = pyarrow.table(columns).replace_schema_metadata(
        {
            "target": ",".join(one.target for one in found),
            "source": ",".join(one.source for one in found),
            "tftool": library_name(),
        }
    )
    with whole_file(path, force=force) as file:
        pyarrow.parquet.write_table(table, file, compression="zstd")
    return [path]


TRAJECTORY_WRITERS: Final[Mapping[Format, TrajectoryWriter]] = MappingProxyType(
    {
        Format.tum: _write_tum,
        Format.kitti: _write_kitti,
        Format.euroc: _write_euroc,
        Format.csv: _write_csv,
        Format.npz: _write_npz,
        Format.parquet: _write_parquet,
    }
)
"""Function that writes each format of pairs over time."""


def _poses(rows: TransformArray) -> batch.Floats:
    return np.hstack([rows.translations, rows.rotations])


def _joined(parts: "Sequence[np.ndarray]") -> "np.ndarray":
    return parts[0] if len(parts) == 1 else np.concatenate(parts)


def _blocks(rows: TransformArray) -> Iterator[TransformArray]:
    for start in range(0, len(rows), BLOCK):
        yield rows[start : start + BLOCK]


def _writer(
    file: BinaryIO,
    rows: TransformArray,
    decimals: int,
    progress: Progress | None,
    before: bytes = b"",
) -> "Callable[..., None]":
    """Return a function that writes lines of numbers to `file`; each line begins with `before`."""
    done = 0

    def write(
        stamps: "np.ndarray | None",
        numbers: batch.Floats,
        *,
        seconds: bool = False,
        separator: str = ",",
    ) -> None:
        nonlocal done
        if decimals == DECIMALS and fits(numbers):
            text = rows_as_text(numbers, stamps=stamps, seconds=seconds, separator=separator)
        else:
            text = exact_rows(
                numbers, decimals, stamps=stamps, seconds=seconds, separator=separator
            )
        if before:
            text = before + text[:-1].replace(b"\n", b"\n" + before) + b"\n"
        file.write(text)
        done += len(numbers)
        if progress is not None:
            progress(done * _BYTES_PER_ROW, len(rows) * _BYTES_PER_ROW)

    return write


def _csv_line(words: Sequence[str]) -> bytes:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(words)
    return text.getvalue().encode()
