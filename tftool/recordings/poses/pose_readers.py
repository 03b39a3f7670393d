"""Readers of pose files: camera poses and calibrations, trajectories, files of `tftool export`."""

import csv
import json
import math
import re
import zipfile
from array import array
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import yaml

from tftool.base import yaml_guard
from tftool.base.errors import InputError, UsageError
from tftool.recordings.poses.pose_links import MOST_POSES, PoseFile, PoseLink

if TYPE_CHECKING:
    import numpy as np


COLMAP_ROW: Final = "an image (IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME)"
MATRIX: Final = "a matrix of 3 or 4 rows with 4 numbers each"
VELODYNE: Final = "velodyne"

_LARGEST_DOCUMENT: Final = 1 << 26
_CALIBRATED: Final = re.compile(r"P[0-9]|Tr(_[a-z_]+)?|R|T|R0_rect|R_rect")


def read_colmap(file: PoseFile) -> list[PoseLink]:
    """Return the links in COLMAP's images.txt, which has two lines per image: pose and points."""
    images: list[tuple[str, list[float]]] = []
    is_image = True
    for line in file.lines():
        if line.startswith("#") or (is_image and not line):
            continue
        if is_image:
            words = line.split(maxsplit=9)
            if len(words) < 10:
                file.fail(COLMAP_ROW, f"{len(words)} words")
            qw, qx, qy, qz, x, y, z = file.floats(words[1:8], COLMAP_ROW)
            images.append((words[9], [x, y, z, qx, qy, qz, qw]))
        is_image = not is_image
    return _images(file, images, 7)


def read_nerfstudio(file: PoseFile) -> list[PoseLink]:
    """Return the links in nerfstudio's transforms.json, which has a matrix per image."""
    try:
        document = json.loads(_text(file))
        frames = document["frames"]
        found = [(str(one["file_path"]), _matrix(one["transform_matrix"])) for one in frames]
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise InputError(
            f"'{file.path}': expected frames with file_path and transform_matrix ({MATRIX}), "
            f"found {_reason(error)}."
        ) from error
    return _images(file, found, 12)


def _images(file: PoseFile, images: list[tuple[str, list[float]]], width: int) -> list[PoseLink]:
    """Return one moving camera if --pose-rate is given, else one static frame per image."""
    if file.options.pose_rate is not None:
        link = file.link(width)
        for _, numbers in sorted(images, key=lambda one: one[0]):
            link.numbers.extend(numbers)
        file.check_count(link)
        file.at_rate(link)
        return [link]
    parent = file.frames[0]
    links: dict[str, PoseLink] = {}
    for name, numbers in images:
        child = file.name(name)
        if child in links:
            raise InputError(f"'{file.path}' has two images named '{child}'.")
        links[child] = _still(parent, child, numbers)
    return list(links.values())


def read_kalibr(file: PoseFile) -> list[PoseLink]:
    """Return the links in kalibr's camchain.yaml: cameras in the IMU or the previous camera."""
    document = _yaml(file)
    cameras = sorted((name for name in document if _is_camera(name)), key=lambda one: int(one[3:]))
    links = []
    with _refused(file, "cameras with T_cam_imu or T_cn_cnm1, each a matrix"):
        for name in cameras:
            values = document[name]
            if "T_cam_imu" in values:
                links.append(_still("imu", name, _matrix(values["T_cam_imu"])))
            elif "T_cn_cnm1" in values:
                before = f"cam{int(name[3:]) - 1}"
                links.append(_still(before, name, _matrix(values["T_cn_cnm1"])))
        if not links:
            raise ValueError("neither")
    return file.renamed("links", links)


def read_euroc_sensor(file: PoseFile) -> list[PoseLink]:
    """Return the link in EuRoC's sensor.yaml: the pose of a sensor in the body, T_BS."""
    document = _yaml(file)
    with _refused(file, "T_BS with rows, cols and data of 16 numbers"):
        data = document["T_BS"]["data"]
        if len(data) != 16:
            raise ValueError(f"{len(data)} numbers")
        rows = [data[start : start + 4] for start in range(0, 16, 4)]
        return file.renamed("links", [_still(*file.default, _matrix(rows))])


def read_kitti_calibration(file: PoseFile) -> list[PoseLink]:
    """Return the links in KITTI's calib.txt: cameras (from projections), velodyne, IMU."""
    found: dict[str, list[float]] = {}
    for line in file.lines():
        key, _, rest = line.partition(":")
        if not _CALIBRATED.fullmatch(key.strip()):
            continue
        numbers = file.floats(rest.split(), "numbers")
        counts = {"R": 9, "T": 3, "R0_rect": 9, "R_rect": 9}
        count = counts.get(key, 12)
        if len(numbers) != count:
            file.fail(f"{count} numbers after '{key}:'", f"{len(numbers)}")
        found[key.strip()] = numbers
    links = []
    offsets = {key: _offset(numbers) for key, numbers in found.items() if key[0] == "P"}
    first = offsets.get("P0", [0.0, 0.0, 0.0])
    for key, offset in sorted(offsets.items()):
        if key != "P0":
            shift = [mine - other for mine, other in zip(first, offset, strict=True)]
            links.append(_still("cam0", f"cam{key[1:]}", _rows(_IDENTITY, shift)))
    camera = "cam0"
    turned = found.get("R0_rect") or found.get("R_rect")
    if turned:
        camera = "cam0_unrectified"
        links.append(_still("cam0", camera, _rows(turned, [0.0, 0.0, 0.0])))
    if "R" in found and "T" in found:
        is_imu = file.path.stem == "calib_imu_to_velo"
        pair = (VELODYNE, "imu") if is_imu else (camera, VELODYNE)
        links.append(_still(*pair, _rows(found["R"], found["T"])))
    named = {"Tr": (camera, VELODYNE), "Tr_velo_to_cam": (camera, VELODYNE)}
    named |= {"Tr_velo_cam": (camera, VELODYNE), "Tr_imu_to_velo": (VELODYNE, "imu")}
    named |= {"Tr_imu_velo": (VELODYNE, "imu")}
    links += [_still(*pair, found[key]) for key, pair in named.items() if key in found]
    if not links:
        raise InputError(
            f"'{file.path}': expected a line that begins with P0:, P1:, P2:, P3: or Tr:, "
            "or two lines that begin with R: and T:, but found no such line."
        )
    return file.renamed("links", links)


_IDENTITY: Final = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


def _offset(projection: Sequence[float]) -> list[float]:
    """Return the translation of a camera from its projection matrix K [I | t]."""
    fx, _, cx, px, _, fy, cy, py, _, _, _, z = projection
    if not fx or not fy:
        raise InputError(
            "A projection matrix in KITTI's calib.txt has the focal length 0: correct the file."
        )
    return [(px - cx * z) / fx, (py - cy * z) / fy, z]


def _rows(turn: Sequence[float], shift: Sequence[float]) -> list[float]:
    return [n for row in range(3) for n in (*turn[3 * row : 3 * row + 3], shift[row])]


def _still(parent: str, child: str, numbers: Sequence[float]) -> PoseLink:
    return PoseLink(parent, child, True, len(numbers), array("q", (0,)), array("d", numbers))


def _matrix(rows: Any) -> list[float]:
    """Return the upper three rows of a transformation matrix, row by row.

    Raises:
        ValueError: If the numbers are not a transformation matrix.
    """
    if not isinstance(rows, list) or len(rows) not in (3, 4):
        raise ValueError("no matrix")
    if any(not isinstance(row, list) or len(row) != 4 for row in rows):
        raise ValueError("no matrix")
    numbers = [float(number) for row in rows[:3] for number in row]
    if not all(map(math.isfinite, numbers)):
        raise ValueError("a number that is not finite")
    return numbers


def _text(file: PoseFile) -> str:
    with file.open() as opened:
        data = opened.read(_LARGEST_DOCUMENT + 1)
    if len(data) > _LARGEST_DOCUMENT:
        raise InputError(f"'{file.path}' has more than {_LARGEST_DOCUMENT >> 20} MiB: split it.")
    return data.decode("utf-8-sig", "backslashreplace")


def _yaml(file: PoseFile) -> Mapping[Any, Any]:
    # OpenCV's first line is not YAML.
    text = re.sub(r"\A%YAML:.*\n", "", _text(file))
    with _refused(file, "YAML with names and values"):
        document = yaml_guard.load(text)
        if not isinstance(document, dict):
            raise ValueError("something else")
    return document


class _refused:  # noqa: N801 - used as a function
    """Context manager that converts errors in the `with` block to errors that name the file."""

    def __init__(self, file: PoseFile, expected: str) -> None:
        self._file = file
        self._expected = expected

    def __enter__(self) -> None:
        return None

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        wrong = (ValueError, KeyError, TypeError, yaml.YAMLError, RecursionError)
        if isinstance(error, wrong):
            raise InputError(
                f"'{self._file.path}': expected {self._expected}, found {_reason(error)}."
            ) from error


def _reason(error: BaseException) -> str:
    if isinstance(error, KeyError):
        return f"no {error}"
    return " ".join(str(error).split())[:200]


def _is_camera(name: object) -> bool:
    return isinstance(name, str) and bool(re.fullmatch(r"cam[0-9]{1,4}", name))


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
    """Return the link in EuRoC's data.csv: stamp in ns, position, quaternion with w first."""
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
            raise InputError(
                f"{error} Or put stamps into '{beside[0].name}' in the same folder."
            ) from None
        return [link]
    for words in file.rows(path=times):
        link.stamps.append(file.seconds(words[0], "a stamp in seconds", times))
        if len(link.stamps) > count:
            break
    if len(link.stamps) != count:
        more = "more" if len(link.stamps) > count else f"{len(link.stamps)}"
        raise InputError(
            f"'{path}' has {count} poses, and '{times}' has {more} stamps: the two files do "
            "not belong together. To ignore the stamps, give --pose-rate HZ."
        )
    return [link]


def read_csv(file: PoseFile) -> list[PoseLink]:
    """Return the links in a CSV file with named columns, as `tftool export` writes it."""
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
        InputError: If an array of `tftool export` is missing, or the shapes do not match.
    """
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
        InputError: If a column of `tftool export` is missing.
        UsageError: If the extra `parquet` is not installed.
    """
    try:
        import pyarrow.parquet
    except ImportError as missing:
        raise UsageError("Parquet needs an extra: pip install 'tftool-tf2[parquet]'") from missing
    try:
        with file.open() as opened:
            head = pyarrow.parquet.ParquetFile(opened)
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
        raise InputError(
            f"'{file.path}' has stamps outside 0 to {2**31} seconds: check the unit of its stamps."
        )
    numbers, moments = array("d"), array("q")
    numbers.frombytes(poses.tobytes())
    moments.frombytes(stamps.astype("int64").tobytes())
    return PoseLink(file.name(names[0]), file.name(names[1]), stamps=moments, numbers=numbers)
