"""Readers of trajectories: TUM, TUM with commas, EuRoC, KITTI, and files of `tftool export`."""

import csv
from array import array
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from tftool.base.errors import InputError, UsageError
from tftool.recordings.poses.pose_links import MOST_POSES, PoseFile, PoseLink

if TYPE_CHECKING:
    import numpy as np

TUM_ROW: Final = "8 numbers (stamp x y z qx qy qz qw)"
EUROC_ROW: Final = "8 numbers or more (stamp in ns, x y z, qw qx qy qz)"
KITTI_ROW: Final = "12 numbers (the upper three rows of a matrix)"
TABLE_COLUMNS: Final = ("stamp_ns", "x_m", "y_m", "z_m", "qx", "qy", "qz", "qw")
"""Columns of the CSV and Parquet files that `tftool export` writes."""


def read_tum(file: PoseFile) -> list[PoseLink]:
    """Return the link in a TUM trajectory: stamp in seconds, position, quaternion with w last."""
    link = file.link()
    for words in file.rows():
        if len(words) != 8:
            file.fail(TUM_ROW, f"{len(words)} words")
        link.numbers.extend(file.floats(words[1:], TUM_ROW))
        link.stamps.append(file.seconds(words[0], TUM_ROW))
        file.check_count(link)
    return [link]


def read_euroc(file: PoseFile) -> list[PoseLink]:
    """Return the link in EuRoC's data.csv: nanoseconds, position, quaternion with w first."""
    link = file.link()
    for words in file.rows():
        if len(words) < 8:
            file.fail(EUROC_ROW, f"{len(words)} words")
        x, y, z, qw, qx, qy, qz = file.floats(words[1:8], EUROC_ROW)
        link.numbers.extend((x, y, z, qx, qy, qz, qw))
        link.stamps.append(file.nanoseconds(words[0], EUROC_ROW))
        file.check_count(link)
    return [link]


def read_kitti(file: PoseFile) -> list[PoseLink]:
    """Return the link in KITTI's poses, with stamps from a second file or --pose-rate."""
    link = file.link(width=12)
    for words in file.rows():
        if len(words) != 12:
            file.fail(KITTI_ROW, f"{len(words)} words")
        link.numbers.extend(file.floats(words, KITTI_ROW))
        file.check_count(link)
    count = len(link.numbers) // 12
    path = file.path
    beside = (path.with_name(f"{path.stem}_times.txt"), path.with_name("times.txt"))
    times = next((one for one in beside if one.is_file() and one != path), None)
    if times is None or file.options.pose_rate is not None:
        try:
            file.at_rate(link)
        except InputError as error:
            raise InputError(f"{error} Or put stamps into '{beside[0].name}' beside it.") from None
        return [link]
    for words in file.rows(path=times):
        link.stamps.append(file.seconds(words[0], "a stamp in seconds", times))
        if len(link.stamps) > count:
            break
    if len(link.stamps) != count:
        more = "more" if len(link.stamps) > count else f"{len(link.stamps)}"
        raise InputError(
            f"'{path}' has {count} poses, and '{times}' has {more} stamps: they do not belong "
            "together. --pose-rate HZ ignores the stamps."
        )
    return [link]


def read_csv(file: PoseFile) -> list[PoseLink]:
    """Return the links in a CSV file of `tftool export`, whose columns have names."""
    links: dict[tuple[str, str], PoseLink] = {}
    columns: list[int] = []
    names: list[int] = []
    expected = ""
    for line in file.lines():
        words = next(csv.reader([line]), [])
        if not words:
            continue
        if not columns:
            is_head = set(TABLE_COLUMNS) <= set(words)
            head = words if is_head else list(TABLE_COLUMNS)
            columns = [head.index(one) for one in TABLE_COLUMNS]
            names = [head.index(one) for one in ("target", "source") if one in head]
            expected, width = f"{len(head)} values ({','.join(head)})", len(head)
            if is_head:
                continue
        if len(words) != width:
            file.fail(expected, f"{len(words)}")
        pair = file.frames
        if len(names) == 2:
            pair = file.name(words[names[0]]), file.name(words[names[1]])
        link = links.setdefault(pair, PoseLink(*pair))
        link.numbers.extend(file.floats([words[one] for one in columns[1:]], expected))
        link.stamps.append(file.nanoseconds(words[columns[0]], expected))
        file.check_count(link)
    return file.renamed("pairs", list(links.values()))


def read_npz(file: PoseFile) -> list[PoseLink]:
    """Return the link in a NumPy archive of `tftool export`.

    Raises:
        InputError: If the file has other arrays, or their shapes do not match.
    """
    import zipfile

    try:
        with file.open() as opened:
            with zipfile.ZipFile(opened) as archive:
                if sum(one.file_size for one in archive.infolist()) > MOST_POSES * 72:
                    raise ValueError(f"more than {MOST_POSES:,} poses")
            opened.seek(0)
            with np.load(opened, allow_pickle=False) as found:
                arrays = {name: found[name] for name in found.files}
        stamps, shifts, turns = (arrays[one] for one in ("stamps", "translations", "rotations"))
        targets, sources = (np.atleast_1d(arrays[one]).tolist() for one in ("target", "source"))
        places = arrays.get("pair", np.zeros(len(stamps), dtype=np.int64))
        if (
            shifts.shape != (len(stamps), 3)
            or turns.shape != (len(stamps), 4)
            or places.shape != (len(stamps),)
            or stamps.dtype.kind not in "iu"
            or len(targets) != len(sources)
            or (len(places) and not 0 <= places.min() <= places.max() < len(targets))
        ):
            raise ValueError("arrays of other shapes")
        poses = np.hstack([shifts, turns]).astype(np.float64)
    except (
        zipfile.BadZipFile,
        KeyError,
        ValueError,
        TypeError,
        EOFError,
        NotImplementedError,
    ) as e:
        raise InputError(
            f"'{file.path}': expected the arrays stamps (n,), translations (n, 3), rotations "
            f"(n, 4), target and source, found {e}."
        ) from e
    pairs = zip(map(str, targets), map(str, sources), strict=True)
    return file.renamed(
        "pairs",
        [
            _link_of(file, pair, stamps[places == place], poses[places == place])
            for place, pair in enumerate(pairs)
        ],
    )


def read_parquet(file: PoseFile) -> list[PoseLink]:
    """Return the links in a Parquet table of `tftool export`.

    Raises:
        InputError: If the file has other columns.
        UsageError: If the extra `parquet` is not installed.
    """
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as missing:
        raise UsageError("Parquet needs an extra: pip install 'tftool-tf2[parquet]'") from missing
    try:
        with file.open() as opened:
            head = parquet.ParquetFile(opened)
            if head.metadata.num_rows > MOST_POSES:
                raise InputError(f"'{file.path}' has more than {MOST_POSES:,} poses: split it.")
            wanted = [*TABLE_COLUMNS, "target", "source"]
            table = head.read([one for one in wanted if one in head.schema_arrow.names])
        stamps = table["stamp_ns"].to_numpy()
        poses = np.stack(
            [table[one].to_numpy().astype(np.float64) for one in TABLE_COLUMNS[1:]], axis=1
        )
        names = dict(head.schema_arrow.metadata or {})
        pairs = [(names.get(b"target", b"").decode(), names.get(b"source", b"").decode())]
        places = np.zeros(len(stamps), dtype=np.int64)
        if {"target", "source"} <= set(table.column_names):
            both = list(zip(table["target"].to_pylist(), table["source"].to_pylist(), strict=True))
            pairs = list(dict.fromkeys(both))
            numbers = {pair: place for place, pair in enumerate(pairs)}
            places = np.array([numbers[one] for one in both], dtype=np.int64)
    except (pyarrow.ArrowException, KeyError, ValueError, TypeError) as error:
        raise InputError(
            f"'{file.path}': expected the columns {', '.join(TABLE_COLUMNS)}, found {error}."
        ) from error
    return file.renamed(
        "pairs",
        [
            _link_of(file, pair, stamps[places == place], poses[places == place])
            for place, pair in enumerate(pairs)
        ],
    )


def _link_of(
    file: PoseFile, pair: tuple[Any, Any], stamps: "np.ndarray", poses: "np.ndarray"
) -> PoseLink:
    names = (str(pair[0] or file.frames[0]), str(pair[1] or file.frames[1]))
    if len(stamps) and (int(stamps.min()) < 0 or int(stamps.max()) >= 2**31 * 10**9):
        raise InputError(f"'{file.path}' has stamps outside of the seconds 0 to {2**31}.")
    numbers, moments = array("d"), array("q")
    numbers.frombytes(poses.tobytes())
    moments.frombytes(stamps.astype("int64").tobytes())
    return PoseLink(file.name(names[0]), file.name(names[1]), stamps=moments, numbers=numbers)
