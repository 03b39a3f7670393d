"""Readers of camera poses and calibrations from COLMAP, nerfstudio, kalibr, EuRoC and KITTI."""

import json
import math
import re
from array import array
from collections.abc import Mapping, Sequence
from typing import Any, Final

import yaml

from tftool.base import yaml_guard
from tftool.base.errors import InputError
from tftool.recordings.poses.pose_links import PoseFile, PoseLink

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
    """Return one moving camera with a pose per image, by name, or a frame for each image."""
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
    """Return the links in kalibr's camchain.yaml: each camera in the IMU or previous camera."""
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
        raise InputError(f"'{file.path}': expected P0: to P3:, Tr: or R: and T:, found none.")
    return file.renamed("links", links)


_IDENTITY: Final = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


def _offset(projection: Sequence[float]) -> list[float]:
    """Return the translation of a camera from its projection matrix K [I | t]."""
    fx, _, cx, px, _, fy, cy, py, _, _, _, z = projection
    if not fx or not fy:
        raise InputError("A projection of KITTI's calib.txt has the focal length 0.")
    return [(px - cx * z) / fx, (py - cy * z) / fy, z]


def _rows(turn: Sequence[float], shift: Sequence[float]) -> list[float]:
    return [n for row in range(3) for n in (*turn[3 * row : 3 * row + 3], shift[row])]


def _still(parent: str, child: str, numbers: Sequence[float]) -> PoseLink:
    return PoseLink(parent, child, True, len(numbers), array("q", (0,)), array("d", numbers))


def _matrix(rows: Any) -> list[float]:
    """Return the upper three rows of a transformation matrix, row by row.

    Raises:
        ValueError: If the numbers are not such a matrix.
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
        raise InputError(f"'{file.path}' has more than {_LARGEST_DOCUMENT >> 20} MiB.")
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
    """Context that adds the file's name to errors raised in its block."""

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
