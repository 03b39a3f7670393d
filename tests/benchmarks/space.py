"""Processor time per 3-D picture of a robot on a terminal."""

import tempfile
import time
from pathlib import Path

import numpy as np

from tftool.drawing.solids import solids_of
from tftool.drawing.space import OrbitCamera, SpaceFrame, SpacePicture
from tftool.drawing.space_canvas import SpaceCanvas, corners_of
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.rigid import Transform
from tftool.robots.mesh_folders import MeshFolders
from tftool.robots.urdf import parse_description

SIZES = ((80, 24), (120, 40), (200, 60))
LINKS, AROUND = 7, 100
TRIANGLES = 121_800
"""Number of triangles in the meshes of a UR5e, which has seven links."""
WANTED = 25.0
PICTURES = 40

_STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])


def tube() -> bytes:
    """Return an STL file of a tube with rings."""
    rings = TRIANGLES // LINKS // AROUND // 2
    angle = np.linspace(0.0, 2.0 * np.pi, AROUND, endpoint=False)
    height = np.linspace(0.0, 0.2, rings + 1)
    radius = (0.04 + 0.015 * np.sin(40.0 * height))[:, None]
    points = np.stack(
        [radius * np.cos(angle), radius * np.sin(angle), np.tile(height[:, None], AROUND)], -1
    ).reshape(-1, 3)
    here = np.arange(rings)[:, None] * AROUND + np.arange(AROUND)
    beside = np.roll(here, -1, 1)
    faces = np.stack([here, beside, beside + AROUND, here, beside + AROUND, here + AROUND], -1)
    rows = np.zeros(faces.size // 3, _STL)
    rows["corners"] = points[faces.reshape(-1, 3)]
    return bytes(80) + len(rows).to_bytes(4, "little") + rows.tobytes()


def made_arm() -> SpacePicture:
    """Return an arm of tubes with the triangles of a UR5e, simplified as by `tftool robot`."""
    mesh = '<visual><geometry><mesh filename="tube.stl"/></geometry></visual>'
    parts = "".join(f'<link name="link{n}">{mesh}</link>' for n in range(LINKS))
    parts += "".join(
        f'<joint name="joint{n}" type="fixed"><parent link="link{n - 1}"/><child link="link{n}"/>'
        "</joint>"
        for n in range(1, LINKS)
    )
    links = parse_description(f'<robot name="arm">{parts}</robot>').links
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "tube.stl").write_bytes(tube())
        solids, _ = solids_of(links.values(), MeshFolders(given=[Path(folder)]))
    pose, frames = Transform.identity(), []
    for n, name in enumerate(links):
        frames.append(SpaceFrame(name, pose, f"link{n - 1}" if n else None))
        turn = quaternion_from_rpy(0.5 * (n % 2), 0.7, 0.0)
        pose = pose @ Transform((0.0, 0.0, 0.2), turn)
    return SpacePicture("link0", tuple(frames), solids)


def cost(picture: SpacePicture, columns: int, rows: int) -> float:
    """Return the median milliseconds of processor time per picture while the camera turns."""
    camera, canvas = OrbitCamera(), SpaceCanvas(columns, rows)
    times = []
    for _ in range(PICTURES):
        camera.turn(1.0, 0.0)
        began = time.process_time()
        canvas.lines(picture, camera.view(picture, corners_of(picture), columns, rows))
        times.append(time.process_time() - began)
    return 1e3 * sorted(times)[PICTURES // 2]


def report() -> str:
    """Measure, and print a few lines."""
    picture = made_arm()
    drawn = 0 if picture.solids is None else len(picture.solids.triangles)
    lines = [f"an arm of {TRIANGLES:,} triangles, {drawn:,} of them drawn, on a terminal"]
    for size in SIZES:
        limit = f" (wanted: {WANTED:.0f} ms at most)" if size == (120, 40) else ""
        lines.append(f"  {size[0]}×{size[1]}: {cost(picture, *size):5.1f} ms a picture{limit}")
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())  # noqa: T201
