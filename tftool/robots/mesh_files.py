"""Reader of triangles and colours from mesh files: STL, OBJ and COLLADA."""

import struct
from collections.abc import Iterator, Mapping
from itertools import pairwise
from pathlib import PurePosixPath
from typing import NamedTuple, TypeAlias
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt

from tftool.robots.mesh_folders import MeshRefused

Floats: TypeAlias = npt.NDArray[np.float64]
Indices: TypeAlias = npt.NDArray[np.int64]
Rgb: TypeAlias = tuple[float, float, float]

MOST_TRIANGLES = 4_000_000
"""Maximum number of triangles in a mesh."""


class Mesh(NamedTuple):
    """Triangles of one colour in a mesh file.

    Attributes:
        points: Coordinates of the corners, metres, shape (n, 3).
        triangles: Indices in `points` of the three corners of each triangle, shape (m, 3).
        color: Red, green and blue from 0 to 1; None if the file has no colour.
    """

    points: Floats
    triangles: Indices
    color: Rgb | None = None


def read_mesh(name: str, content: bytes) -> list[Mesh]:
    """Read the triangles of a mesh file.

    Args:
        name: Name of the file; the suffix selects the format.
        content: Bytes of the file; untrusted.

    Raises:
        MeshRefused: If the format is not supported, or the file is damaged.
    """
    suffix = PurePosixPath(name).suffix.lower()
    if suffix not in _READERS:
        raise MeshRefused(
            f"'{name}' cannot be drawn on a terminal, which shows only {', '.join(_READERS)}: use "
            "'tftool view'"
        )
    try:
        meshes = _READERS[suffix](content)
    except (ValueError, IndexError, KeyError, struct.error, ElementTree.ParseError) as error:
        raise MeshRefused(f"'{name}' is damaged: {error}") from error
    for one in meshes:
        outside = one.triangles.size and not (
            one.triangles.min() >= 0 and one.triangles.max() < len(one.points)
        )
        if outside or not np.isfinite(one.points).all():
            raise MeshRefused(f"'{name}' is damaged: a triangle has a corner that does not exist")
    if sum(len(one.triangles) for one in meshes) > MOST_TRIANGLES:
        raise MeshRefused(f"'{name}' has more than {MOST_TRIANGLES:,} triangles: simplify the mesh")
    return meshes


_STL_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])


def _stl(content: bytes) -> list[Mesh]:
    count = struct.unpack_from("<I", content, 80)[0] if len(content) >= 84 else -1
    if len(content) == 84 + 50 * count:
        corners = np.frombuffer(content, _STL_TRIANGLE, count, 84)["corners"].reshape(-1, 3)
    else:
        rows = [line.split()[1:4] for line in content.splitlines() if b"vertex" in line]
        corners = np.array(rows, float).reshape(-1, 3)
        if not len(corners) or len(corners) % 3:
            raise ValueError("the bytes are neither a binary nor a text STL file")
    return [Mesh(corners.astype(float), np.arange(len(corners)).reshape(-1, 3))]


def _obj(content: bytes) -> list[Mesh]:
    points: list[list[float]] = []
    triangles: list[tuple[int, int, int]] = []
    for line in content.decode("utf-8", "replace").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            # Negative numbers count backward from the last corner read.
            corners = [one - 1 if one > 0 else len(points) + one for one in corners]
            triangles += [(corners[0], *pair) for pair in pairwise(corners[1:])]
    return [Mesh(np.array(points, float).reshape(-1, 3), np.array(triangles).reshape(-1, 3))]


def _dae(content: bytes) -> list[Mesh]:
    if b"<!DOCTYPE" in content or b"<!ENTITY" in content:
        raise ValueError("a document type (<!DOCTYPE>) is not supported: remove it")
    root = ElementTree.fromstring(content)
    for one in root.iter():
        one.tag = one.tag.rpartition("}")[2]
    ids = {one.attrib["id"]: one for one in root.iter() if "id" in one.attrib}
    unit = root.find("asset/unit")
    scale = 1.0 if unit is None else float(unit.get("meter", 1.0))
    place = np.diag([scale, scale, scale, 1.0])
    if (root.findtext("asset/up_axis") or "Y_UP").strip() == "Y_UP":
        place = place @ np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]])
    found: list[Mesh] = []
    for scene in root.iter("visual_scene"):
        for node in scene.findall("node"):
            found += _node(node, place, ids, 0)
    return found


def _node(
    node: ElementTree.Element, above: Floats, ids: Mapping[str, ElementTree.Element], depth: int
) -> Iterator[Mesh]:
    if depth > 50:
        raise ValueError("the nodes contain each other in a loop")
    place: Floats = above
    for one in node:
        if one.tag in ("matrix", "translate", "rotate", "scale"):
            place = place @ _step(one.tag, _numbers(one))
    for one in node.findall("instance_geometry"):
        bound = {
            material.get("symbol", ""): _color(material.get("target", ""), ids)
            for material in one.iter("instance_material")
        }
        geometry = ids[one.attrib["url"][1:]]
        for mesh in _geometry(geometry, ids, bound):
            points = mesh.points @ place[:3, :3].T + place[:3, 3]
            yield mesh._replace(points=points)
    for one in node.findall("instance_node"):
        yield from _node(ids[one.attrib["url"][1:]], place, ids, depth + 1)
    for one in node.findall("node"):
        yield from _node(one, place, ids, depth + 1)


def _step(kind: str, numbers: Floats) -> Floats:
    if kind == "matrix":
        return numbers.reshape(4, 4)
    step = np.eye(4)
    if kind == "translate":
        step[:3, 3] = numbers
    elif kind == "scale":
        step[:3, :3] = np.diag(numbers)
    else:
        x, y, z = numbers[:3] / np.linalg.norm(numbers[:3])
        angle = np.radians(numbers[3])
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        step[:3, :3] += np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross
    return step


def _geometry(
    geometry: ElementTree.Element,
    ids: Mapping[str, ElementTree.Element],
    bound: Mapping[str, Rgb | None],
) -> Iterator[Mesh]:
    for faces in geometry.iter():
        if faces.tag not in ("triangles", "polylist", "polygons"):
            continue
        inputs = faces.findall("input")
        stride = 1 + max(int(one.get("offset", 0)) for one in inputs)
        vertex = next(one for one in inputs if one.get("semantic") == "VERTEX")
        positions = next(
            one
            for one in ids[vertex.attrib["source"][1:]].findall("input")
            if one.get("semantic") == "POSITION"
        )
        numbers = ids[positions.attrib["source"][1:]].find("float_array")
        if numbers is None:
            raise ValueError("a geometry has no corners")
        points = _numbers(numbers).reshape(-1, 3)
        offset = int(vertex.get("offset", 0))
        lists = [_indices(one)[offset::stride] for one in faces.findall("p")]
        sizes = faces.find("vcount")
        if faces.tag == "polygons":
            triangles = [_fan(one, [len(one)]) for one in lists]
        elif faces.tag == "polylist" and sizes is not None:
            triangles = [_fan(one, _indices(sizes)) for one in lists]
        else:
            triangles = [one.reshape(-1, 3) for one in lists]
        if triangles:
            yield Mesh(points, np.concatenate(triangles), bound.get(faces.get("material", "")))


def _fan(corners: Indices, sizes: Indices | list[int]) -> Indices:
    """Split polygons into triangles around their first vertex."""
    sizes = np.asarray(sizes, int)
    cuts = np.maximum(sizes - 2, 0)
    first = np.repeat(np.cumsum(sizes) - sizes, cuts)
    step = np.arange(len(first)) - np.repeat(np.cumsum(cuts) - cuts, cuts)
    return np.stack([corners[first], corners[first + step + 1], corners[first + step + 2]], 1)


def _color(target: str, ids: Mapping[str, ElementTree.Element]) -> Rgb | None:
    material = ids.get(target[1:])
    effect = None if material is None else material.find("instance_effect")
    shader = None if effect is None else ids.get(effect.get("url", "")[1:])
    if shader is None:
        return None
    for one in shader.iter("diffuse"):
        color = one.find("color")
        if color is not None:
            red, green, blue = np.clip(_numbers(color)[:3], 0.0, 1.0).tolist()
            return red, green, blue
    return None


def _numbers(element: ElementTree.Element) -> Floats:
    return np.array((element.text or "").split(), float)


def _indices(element: ElementTree.Element) -> Indices:
    return np.array((element.text or "").split(), np.int64)


_READERS = {".stl": _stl, ".obj": _obj, ".dae": _dae}
