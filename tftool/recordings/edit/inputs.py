"""Input recordings of an edit."""

import contextlib
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tftool.base.errors import InputError, UsageError
from tftool.recordings.container import ContainerReader
from tftool.recordings.find import Found, Kind, container_in, find, kind_of_file, refusal
from tftool.recordings.poses.pose_container import open_poses
from tftool.recordings.rosbag2.folder import files_of_folder, unpack_file
from tftool.recordings.rosbag2.folder_writer import read_metadata
from tftool.recordings.rosbag2.read import Sqlite


@dataclass(slots=True)
class EditedInput:
    """One recording to edit; a context manager.

    Attributes:
        name: Name as the user gave it.
        tapes: Readers of the files, in order.
        paths: Paths of the files.
        is_folder: Whether the input is a rosbag2 folder.
        metadata: Contents of the folder's metadata.yaml.
        mode: "file" or "message" if rosbag2 compressed whole files or each message; else "".
        damage: Sentences about damage of the folder.
        notes: Other sentences about the folder.
    """

    name: str
    tapes: list[ContainerReader] = field(default_factory=list)
    paths: list[Path] = field(default_factory=list)
    is_folder: bool = False
    metadata: Mapping[str, Any] | None = None
    mode: str = ""
    damage: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    _unpacked: "list[tempfile.TemporaryDirectory[str]]" = field(default_factory=list)

    def __enter__(self) -> "EditedInput":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def size(self) -> int:
        """Size of all files of the input, bytes."""
        return sum(tape.size for tape in self.tapes)

    def close(self) -> None:
        """Close the input's files, and remove decompressed copies."""
        for tape in self.tapes:
            tape.close()
        for folder in self._unpacked:
            folder.cleanup()

    def add(self, path: Path) -> None:
        """Open a file of the input.

        Raises:
            InputError: If the file cannot be read.
        """
        kind = kind_of_file(path)
        place = path
        if kind is Kind.ZSTD:
            folder = tempfile.TemporaryDirectory(prefix="tftool-")
            self._unpacked.append(folder)
            place = Path(folder.name) / path.stem
            cut = unpack_file(path, place)
            if cut:
                self.damage.append(cut)
            kind = kind_of_file(place)
            self.mode = "file"
        self.tapes.append(open_tape(place, kind, unpacks=self.mode == "message"))
        self.paths.append(path)

    def add_poses(self, found: Found) -> None:
        """Convert a pose file to a temporary MCAP file, and open it.

        Raises:
            InputError: If the file cannot be read.
        """
        folder = tempfile.TemporaryDirectory(prefix="tftool-")
        self._unpacked.append(folder)
        place = Path(folder.name) / "poses.mcap"
        open_poses(found).write_mcap(place)
        self.tapes.append(open_tape(place, Kind.MCAP))
        self.paths.append(found.paths[0])


def open_input(name: str) -> EditedInput:
    """Open a recording to edit: a file, a rosbag2 folder, or a glob of files.

    Raises:
        InputError: If there is no such recording, or it cannot be read.
        UsageError: If the name belongs to something else.
    """
    found = find(name)
    if not found.kind.is_recording:
        raise UsageError(f"'{name}' is a {found.kind.value}: a recording is needed here.")
    opened = EditedInput(name)
    opened.notes += found.told()
    try:
        if found.kind is Kind.ROSBAG2:
            folder = found.paths[0]
            opened.is_folder = True
            with contextlib.suppress(OSError, ValueError, KeyError, TypeError):
                opened.metadata = read_metadata(folder)
            compressed = str((opened.metadata or {}).get("compression_mode") or "")
            opened.mode = compressed.lower() if compressed else ""
            paths = files_of_folder(folder, opened.damage)
        else:
            paths = list(found.paths)
        if found.kind is Kind.POSES:
            opened.add_poses(found)
            paths = []
        refused: list[InputError] = []
        for path in paths:
            if path.is_dir():
                raise InputError(f"'{path}' is a folder among files: name recordings one by one.")
            try:
                opened.add(path)
                continue
            except InputError as error:
                refused.append(error)
            except OSError as error:
                refused.append(refusal(path, error))
            opened.damage.append(f"{path.name} is left out: {refused[-1]}")
        if not opened.tapes:
            raise refused[0]
    except OSError as error:
        opened.close()
        raise InputError(f"'{name}' cannot be read: {error.strerror or error}") from error
    except BaseException:
        opened.close()
        raise
    return opened


def open_tape(path: Path, kind: Kind | None = None, *, unpacks: bool = False) -> ContainerReader:
    """Open a file of a recording for reading from beginning to end.

    Raises:
        InputError: If the file is not a recording, or cannot be read.
        OSError: If the file cannot be opened.
    """
    tape = container_in(path, kind or kind_of_file(path)).open(path, by_index=False)
    if isinstance(tape, Sqlite):
        tape.unpacks = unpacks
    return tape
