"""Page of `tftool view` with its data in one file, which works without a server.

In place of a server, `page/lookups.js` computes transforms from the packed samples, with the same
numbers as the server. The file loads no other file, and its content security policy permits only
tftool's two scripts, by their digests.
"""

import base64
import hashlib
import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from html import escape
from pathlib import Path
from typing import Any, Final
from urllib.parse import quote, urljoin

import numpy as np

from tftool.base.errors import without_frames
from tftool.base.stamps import Stamp
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import FrameInfo
from tftool.frames.frames import Frames
from tftool.recordings.recording import Recording
from tftool.robots.mesh_folders import MeshFolders, MeshRefused
from tftool.robots.robot_model import Robot
from tftool.screens.browser import assets, protocol
from tftool.screens.browser.drawn_messages import DrawnTopic, pack_tracks
from tftool.screens.browser.marks import marks_of
from tftool.screens.browser.packing import METRES, QUATERNION, PackedBlock, Progress, TooLarge
from tftool.screens.browser.robots import ShownRobot
from tftool.screens.still_frames import first_moment

MOST_BYTES: Final = 10_000_000
"""Bytes of a file beyond which numbers are rounded, to steps finer than any robot's sensors."""

_LARGEST_REFERENCE: Final = 64 * 1024 * 1024


@dataclass(frozen=True, slots=True)
class StandaloneData:
    """Data for a page that works without a server.

    Attributes:
        name: Name of the source for messages, such as "recording 'run.mcap'".
        buffer: Transform buffer with the frames.
        epoch: Stamp that the page shows as 0 s, nanoseconds. The stamp itself must not be 0.
        now: Last time of the data.
        begin: Time to show first; None for the latest transforms.
        robot: Robot among the frames, with the folders of its meshes.
        tracks: Messages to draw besides the frames.
        view: Initial settings of the page, in the form of the text after # in the page's URL.
    """

    name: str
    buffer: Buffer
    epoch: Stamp
    now: Stamp
    begin: Stamp | None = None
    robot: ShownRobot | None = None
    view: str = ""
    tracks: Sequence[DrawnTopic] = ()


@dataclass(frozen=True, slots=True)
class StandalonePage:
    """File that shows the frames in any browser.

    Attributes:
        content: HTML, as bytes.
        is_rounded: Whether numbers were rounded so that the file is not too large.
    """

    content: bytes
    is_rounded: bool


def standalone_page(
    data: StandaloneData, *, most: int = MOST_BYTES, progress: Progress | None = None
) -> StandalonePage:
    """Return a page of frames as one HTML file that needs no server.

    Args:
        data: Data for the page.
        most: Desired size in bytes. For a larger page, positions are rounded to a micrometre and
            quaternions to 1e-7; the rounded page may still be larger.
        progress: Function called with the progress.

    Raises:
        TftoolError: If the page was not built, which can happen in a source tree only.
    """
    files = assets.load()
    frame = _Frame.of(files)
    room = max(0, (most - len(frame.head) - len(frame.tail)) // 4 * 3)
    is_rounded = False
    try:
        packed = _packed(data, files, is_rounded=False, most=room, progress=progress)
    except TooLarge:
        is_rounded = True
        packed = _packed(data, files, is_rounded=True, most=None, progress=progress)
    return StandalonePage(frame.around(packed), is_rounded)


def page_of(
    shown: Buffer | Frames | Recording, robot: Robot | None, meshes: Sequence[str | Path]
) -> StandalonePage:
    """Return the page of a buffer, a recording, or opened frames.

    Args:
        shown: Source of the frames.
        robot: Robot to draw; None for the robot of the source.
        meshes: Folders with the robot's meshes.

    Raises:
        InputError: If no part of the recording can be read.
        TypeError: If `shown` is not a source of frames.
    """
    if isinstance(shown, Frames):
        name, buffer, robot = shown.title, shown.buffer, robot or shown.robot
        span: tuple[int, int] | None = None if shown.start is None else shown.span
    elif isinstance(shown, Recording):
        name, buffer, robot = f"recording '{shown.name}'", shown.buffer, robot or shown.robot
        span = shown.span
    elif isinstance(shown, Buffer):
        name, buffer, span = "a buffer", shown, protocol.reach(shown.snapshot(0).frames)
    else:
        raise without_frames(shown)
    begin, end = span or (1, 1)
    begin = max(1, begin)
    drawn = None if robot is None else ShownRobot(robot, MeshFolders(given=[*map(Path, meshes)]))
    first = first_moment(buffer, begin, max(begin, end))
    return standalone_page(StandaloneData(name, buffer, begin, max(begin, end), first, drawn))


@dataclass(frozen=True, slots=True)
class _Frame:
    """HTML text before and after the packed data."""

    head: bytes
    tail: bytes

    @classmethod
    def of(cls, files: dict[str, assets.Asset]) -> "_Frame":
        text = files["/index.html"].content.decode()
        style = files["/page.css"].content.decode()
        icon = "data:image/svg+xml," + quote(files["/icon.svg"].content.decode())
        script = files["/page.js"].content.decode()
        unpack = files["/unpack.js"].content.decode()
        policy = (
            "default-src 'none'; "
            f"script-src '{_digest(unpack)}' '{_digest(script)}'; style-src '{_digest(style)}'; "
            "connect-src data: blob:; img-src data: blob:; base-uri 'none'; form-action 'none'"
        )
        text = text.replace('href="icon.svg"', f'href="{icon}"')
        text = text.replace('src="icon.svg"', f'src="{icon}"')
        text = text.replace(
            '<link rel="stylesheet" href="page.css">', f"<style>{_inert(style)}</style>"
        )
        text = text.replace(
            '<meta charset="utf-8">',
            '<meta charset="utf-8">\n    '
            f'<meta http-equiv="Content-Security-Policy" content="{escape(policy)}">',
        )
        head, script_tag, tail = text.partition('<script src="page.js"></script>')
        assert script_tag, "the page names its script"
        assert "icon.svg" not in text
        assert "page.css" not in text
        return cls(
            f'{head}<script id="packed" type="application/octet-stream">'.encode(),
            f"</script>\n    <script>{_inert(unpack)}</script>{tail}".encode(),
        )

    def around(self, packed: bytes) -> bytes:
        return self.head + base64.b64encode(packed) + self.tail


def _digest(script: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()


def _inert(text: str) -> str:
    """Check that a script or style cannot end its HTML element; return the text unchanged."""
    assert not re.search(r"</(script|style)|<!--", text, re.IGNORECASE)
    return text


def _packed(
    data: StandaloneData,
    files: dict[str, assets.Asset],
    *,
    is_rounded: bool,
    most: int | None,
    progress: Progress | None,
) -> bytes:
    block = PackedBlock(is_rounded=is_rounded)
    header = _header(data, block)
    # Compressed together with the data, which saves half a megabyte per file.
    header["script"] = block.section(files["/page.js"].content)
    return block.deflated(header, most=most, progress=progress)


def _header(data: StandaloneData, block: PackedBlock) -> dict[str, Any]:
    snapshot = data.buffer.snapshot(data.now)
    shown = [snapshot.frames[index] for index in protocol.chosen(snapshot)]
    since = protocol.since
    robot, meshes = _robot(data.robot, shown, block)
    return {
        "name": data.name,
        "epoch": str(data.epoch),
        "now": since(data.epoch, data.now),
        "begin": None if data.begin is None else since(data.epoch, data.begin),
        "view": data.view,
        "rounded": block.is_rounded,
        "total": len(snapshot.frames),
        "frames": _frames(data, shown, block),
        "robot": robot,
        "files": meshes,
        "marks": marks_of(data.buffer, data.epoch),
        "tracks": pack_tracks(block, data.tracks, data.buffer, data.epoch),
    }


def _frames(
    data: StandaloneData, shown: list[FrameInfo], block: PackedBlock
) -> list[dict[str, Any]]:
    places = {frame.frame: place for place, frame in enumerate(shown)}
    told: list[dict[str, Any]] = []
    for frame in shown:
        samples = data.buffer.samples(frame.frame)
        one: dict[str, Any] = {"name": frame.frame, "authority": frame.authority}
        told.append(one)
        if not len(samples):
            continue
        names, which = np.unique(samples.parents.astype(str), return_inverse=True)
        # A parent that is not shown counts as no parent.
        parents = np.array([places.get(name, -1) for name in names.tolist()])[which]
        one |= {
            "static": samples.is_static,
            "count": len(samples),
            "parents": block.wholes(parents.astype(np.int64)),
            "poses": [
                block.doubles(samples.poses[:, place], METRES if place < 3 else QUATERNION)
                for place in range(7)
            ],
        }
        if not samples.is_static:
            one["stamps"] = block.wholes(samples.stamps - data.epoch)
    return told


def _robot(
    robot: ShownRobot | None, shown: Iterable[FrameInfo], block: PackedBlock
) -> tuple[dict[str, Any] | None, list[dict[str, Any]]]:
    """Return the robot's message, and a list of the mesh and texture files.

    The message is None without a robot. The contents of the files are appended to `block`.
    """
    if robot is None:
        return None, []
    if robot.mover is not None:
        # A file publishes nothing: the page moves the joints, from their present positions.
        robot = replace(robot, mover=None, rest=dict(robot.mover.positions))
    robot.place(frozenset(frame.frame for frame in shown))
    message: dict[str, Any] = json.loads(robot.as_text())
    wanted = [
        address
        for link in message["links"]
        for shape in (*link["visuals"], *link["collisions"])
        for address in (shape.get("address"), shape.get("texture"))
        if address
    ]
    files: list[dict[str, Any]] = []
    seen: set[str] = set()
    while wanted:
        address = wanted.pop()
        if address in seen:
            continue
        seen.add(address)
        try:
            served = robot.folders.read(address)
        except MeshRefused:
            # The page then reports that the mesh cannot be drawn, as it does with a server.
            continue
        files.append(
            {"address": address, "kind": served.kind, "content": block.section(served.content)}
        )
        wanted += [urljoin(address, name) for name in _named_in(address, served.content)]
    return message, files


def _named_in(address: str, content: bytes) -> list[str]:
    """Return the relative names of the files that a mesh in COLLADA or glTF refers to."""
    kind = address[address.rfind(".") :].lower()
    if len(content) > _LARGEST_REFERENCE:
        return []
    if kind == ".dae":
        found = re.findall(rb"<init_from>\s*(?:<ref>)?\s*([^<]+?)\s*<", content)
        return [name.decode("utf-8", "replace") for name in found]
    if kind != ".gltf":
        return []
    try:
        said = json.loads(content)
    except (ValueError, RecursionError):
        return []
    entries = [
        entry
        for key in ("buffers", "images")
        if isinstance(said, dict) and isinstance(said.get(key), list)
        for entry in said[key]
    ]
    names = [entry.get("uri") for entry in entries if isinstance(entry, dict)]
    return [name for name in names if isinstance(name, str) and not name.startswith("data:")]
