"""Triangles of a robot's links, from boxes, cylinders, spheres, and simplified meshes."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.geometry.quaternions import matrix
from tftool.geometry.rigid import Transform
from tftool.robots.description import (
    BoxShape,
    CapsuleShape,
    CylinderShape,
    LinkShape,
    MeshShape,
    RobotJoint,
    RobotLink,
    SphereShape,
)
from tftool.robots.mesh_files import Mesh, Rgb, read_mesh
from tftool.robots.mesh_folders import MeshFolders, MeshRefused

Floats: TypeAlias = npt.NDArray[np.float32]
Indices: TypeAlias = npt.NDArray[np.int64]

MOST_TRIANGLES: Final = 12_000
"""Approximate number of triangles drawn of a robot; a terminal shows no finer detail."""

PLAIN: Final[Rgb] = (0.78, 0.80, 0.84)
"""Colour of shapes without a colour in the description."""

ROD_TO_LENGTH: Final = 0.06
ROD_TO_LONGEST: Final = 0.03
"""Smallest radius of a rod, relative to its own length and to that of the longest rod."""

_AROUND: Final = 20
"""Number of corners of a polygon that replaces a circle."""


@dataclass(frozen=True, slots=True, eq=False)
class Solids:
    """Triangles of shapes that move with frames.

    Attributes:
        frames: Names of the frames.
        ends: For each frame, the end of its rows in `points` and the end of its rows in
            `triangles`.
        points: Corners in coordinates of their frames, metres, shape (n, 3).
        triangles: Indices of three corners each, shape (m, 3).
        colors: Red, green and blue from 0 to 1 of each triangle, shape (m, 3).
    """

    frames: tuple[str, ...]
    ends: tuple[tuple[int, int], ...]
    points: Floats
    triangles: Indices
    colors: Floats

    def placed(self, poses: Mapping[str, Transform]) -> Floats:
        """Return all corners in the frame in which `poses` are expressed, metres, shape (n, 3).

        Corners of frames without a pose are NaN.
        """
        placed = np.full_like(self.points, np.nan)
        first = 0
        for frame, (end, _) in zip(self.frames, self.ends, strict=True):
            pose = poses.get(frame)
            if pose is not None:
                placed[first:end] = self.points[first:end] @ _rotation(pose).T
                placed[first:end] += np.array(pose.translation, np.float32)
            first = end
        return placed

    def parts(self) -> Indices:
        """Return the index in `frames` of each triangle's frame, shape (m,)."""
        ends = [end for _, end in self.ends]
        return np.repeat(np.arange(len(ends)), np.diff([0, *ends]))


def solids_of(
    links: Iterable[RobotLink],
    folders: MeshFolders,
    prefix: str = "",
    most: int = MOST_TRIANGLES,
    joints: Iterable[RobotJoint] = (),
) -> tuple[Solids, list[str]]:
    """Convert the visual shapes of links to triangles.

    Args:
        links: The links; if a link has no visual shape, its collision shapes are used.
        folders: Folders from which meshes may be read.
        prefix: Prefix of a frame's name before the link's name.
        most: Approximate limit on the number of triangles.
        joints: Joints of the robot. A link whose meshes are not found is drawn as rods to its
            joints. All links of a robot without any shape are drawn in this way.

    Returns:
        The triangles, and sentences about meshes that are not shown.
    """
    refused: list[str] = []
    bare: set[str] = set()
    by_frame: dict[str, list[Mesh]] = {}
    for link in links:
        meshes = by_frame.setdefault(prefix + link.name, [])
        for shapes in (link.visuals, link.collisions):
            for shape in shapes if not meshes else ():
                try:
                    meshes += _shape(shape, folders)
                except MeshRefused as refusal:
                    bare.add(link.name)
                    if shapes is link.visuals or not link.visuals:
                        refused.append(str(refusal))
    if not any(by_frame.values()):
        bare.update(name.removeprefix(prefix) for name in by_frame)
    for name, rods in _rods(joints, bare).items():
        meshes = by_frame.get(prefix + name, [])
        meshes += [] if meshes else rods
    everything = [one for meshes in by_frame.values() for one in meshes]
    if sum(len(one.triangles) for one in everything) > most:
        # A grid of that width has about so many corners on these surfaces, and twice as
        # many triangles.
        width = float(np.sqrt(2.0 * sum(map(_area, everything)) / most))
        for meshes in by_frame.values():
            meshes[:] = [coarse(one, width) for one in meshes]
    return _joined(by_frame), list(dict.fromkeys(refused))


def _rods(joints: Iterable[RobotJoint], links: Collection[str]) -> dict[str, list[Mesh]]:
    """Return simple shapes for links without meshes: a ball at the origin, and rods to the joints.

    Args:
        joints: Joints of the robot.
        links: Names of the links to draw.

    Returns:
        Shapes by the name of the link.
    """
    origins = [(one.parent, one.child, np.array(one.origin.translation)) for one in joints]
    longest = max((float(np.linalg.norm(end)) for _, _, end in origins), default=0.0)
    rods: dict[str, list[Mesh]] = {}
    for parent, child, end in origins:
        length = float(np.linalg.norm(end))
        radius = max(ROD_TO_LENGTH * length, ROD_TO_LONGEST * longest)
        if parent in links and length > radius:
            along = end / length
            aside = np.cross(along, np.eye(3)[int(np.abs(along).argmin())])
            aside /= np.linalg.norm(aside)
            axes = np.stack([aside, np.cross(along, aside), along])
            rod = _turned(np.array([[radius, 0.0], [radius, length]]))
            rods.setdefault(parent, []).append(Mesh(rod.points @ axes, rod.triangles))
        if child in links:
            angles = np.linspace(-np.pi / 2.0, np.pi / 2.0, _AROUND // 2 + 1)
            ball = 1.5 * radius * np.stack([np.cos(angles), np.sin(angles)], 1)
            rods.setdefault(child, []).append(_turned(ball))
    return rods


def coarse(mesh: Mesh, width: float) -> Mesh:
    """Simplify a mesh: merge the corners in each cube of a grid, and drop collapsed triangles.

    Source:
        Rossignac and Borrel, "Multi-resolution 3D approximations for rendering complex
        scenes", 1993.
    """
    if not len(mesh.triangles):
        return mesh
    cubes = np.floor((mesh.points - mesh.points.min(0)) / width).astype(np.int64)
    sides = cubes.max(0) + 1
    key = (cubes[:, 0] * sides[1] + cubes[:, 1]) * sides[2] + cubes[:, 2]
    _, cube = np.unique(key, return_inverse=True)
    counts = np.bincount(cube)
    points = np.stack([np.bincount(cube, axis) / counts for axis in mesh.points.T], 1)
    triangles = cube[mesh.triangles]
    first, second, third = triangles.T
    triangles = triangles[(first != second) & (second != third) & (third != first)]
    # Merging can make both sides of a thin wall equal: one of them is enough.
    _, kept = np.unique(np.sort(triangles, 1), axis=0, return_index=True)
    return Mesh(points, triangles[kept], mesh.color)


def _area(mesh: Mesh) -> float:
    first, second, third = (mesh.points[mesh.triangles[:, corner]] for corner in range(3))
    return float(np.linalg.norm(np.cross(second - first, third - first), axis=1).sum() / 2.0)


def _rotation(pose: Transform) -> Floats:
    return np.array(matrix(pose.rotation), np.float32)


def _joined(by_frame: Mapping[str, Sequence[Mesh]]) -> Solids:
    points, triangles, colors = [np.zeros((0, 3))], [np.zeros((0, 3), int)], [np.zeros((0, 3))]
    ends: list[tuple[int, int]] = []
    corners = faces = 0
    for meshes in by_frame.values():
        for one in meshes:
            points.append(one.points)
            triangles.append(one.triangles + corners)
            colors.append(np.tile(one.color or PLAIN, (len(one.triangles), 1)))
            corners, faces = corners + len(one.points), faces + len(one.triangles)
        ends.append((corners, faces))
    return Solids(
        tuple(by_frame),
        tuple(ends),
        np.concatenate(points).astype(np.float32),
        np.concatenate(triangles),
        np.concatenate(colors).astype(np.float32),
    )


def _shape(shape: LinkShape, folders: MeshFolders) -> list[Mesh]:
    """Return a shape's triangles in the frame of its link, in the description's colour."""
    given = None if shape.material is None else shape.material.color
    color = None if given is None else given[:3]
    rotation, origin = _rotation(shape.origin), np.array(shape.origin.translation)
    return [
        Mesh(one.points @ rotation.T + origin, one.triangles, color or one.color)
        for one in _surface(shape, folders)
    ]


def _surface(shape: LinkShape, folders: MeshFolders) -> list[Mesh]:
    geometry = shape.geometry
    if isinstance(geometry, MeshShape):
        name = geometry.filename
        meshes = read_mesh(name, folders.read(folders.address(name)).content)
        return [one._replace(points=one.points * np.array(geometry.scale)) for one in meshes]
    if isinstance(geometry, BoxShape):
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
        halves = [half for a, b, c, d in sides for half in ((a, b, c), (a, c, d))]
        return [Mesh(corners * np.array(geometry.size) / 2.0, np.array(halves))]
    angles = np.linspace(0.0, np.pi / 2.0, _AROUND // 4 + 1)
    bow = np.stack([np.cos(angles), np.sin(angles)], 1) * geometry.radius
    half = 0.0 if isinstance(geometry, SphereShape) else geometry.length / 2.0
    if isinstance(geometry, CylinderShape):
        bow = np.array([[geometry.radius, 0.0], [0.0, 0.0]])
    assert isinstance(geometry, CylinderShape | CapsuleShape | SphereShape)
    above = bow + np.array([0.0, half])
    return [_turned(np.concatenate([above[::-1] * np.array([1.0, -1.0]), above]))]


def _turned(outline: npt.NDArray[np.float64]) -> Mesh:
    """Rotate an outline around the z axis to a surface; `outline` has rows (radius, height)."""
    angles = np.arange(_AROUND) * (2.0 * np.pi / _AROUND)
    radii, heights = outline[:, 0][:, None], outline[:, 1][:, None]
    rings = np.stack(
        [radii * np.cos(angles), radii * np.sin(angles), heights + 0.0 * angles], axis=-1
    )
    here = np.arange(len(outline) - 1)[:, None] * _AROUND + np.arange(_AROUND)
    beside = np.roll(here, -1, axis=1)
    over = here + _AROUND, beside + _AROUND
    triangles = np.stack([here, beside, over[1], here, over[1], over[0]], axis=-1)
    return Mesh(rings.reshape(-1, 3), triangles.reshape(-1, 3))
