"""Table of the file formats of recordings: magic bytes, reader and writer of each."""

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tftool.base.errors import UsageError

if TYPE_CHECKING:
    from tftool.recordings.channel import ContainerWriter
    from tftool.recordings.container import ContainerReader

MCAP_MAGIC: Final = b"\x89MCAP0\r\n"
SQLITE_MAGIC: Final = b"SQLite format 3\x00"
ROS1_MAGIC: Final = b"#ROSBAG V2.0\n"
ZSTD_MAGIC: Final = b"\x28\xb5\x2f\xfd"

PACKED_SUFFIX: Final = ".zstd"
"""Ending of the name of a file that rosbag2 compressed as a whole."""


@dataclass(frozen=True, slots=True)
class ContainerFormat:
    """One file format of recordings, with its reader and its writer.

    Attributes:
        name: Short name: "mcap", "db3", "bag".
        words: Name of the format in messages to the user.
        magic: First bytes of a file.
        suffix: Ending of a file's name.
        storage: rosbag2's name of the format; "" if rosbag2 cannot record it.
        reader_at: Module and class of the reader, imported when a file is opened.
        writer_at: Module and class of the writer.
        options: Names of the arguments of the writer other than the path.
        encoding: The only allowed encoding of messages: "cdr" or "ros1"; "" for any.
        keeps_sequences: Whether files store publish times and sequence numbers.
    """

    name: str
    words: str
    magic: bytes
    suffix: str
    storage: str
    reader_at: tuple[str, str]
    writer_at: tuple[str, str]
    options: tuple[str, ...]
    encoding: str = ""
    keeps_sequences: bool = False

    def open(self, path: Path, *, by_index: bool = True) -> "ContainerReader":
        """Open a file of this format for reading.

        Args:
            path: Path of the file.
            by_index: True to read the file by its index, False to read from beginning to end.

        Raises:
            InputError: If the file cannot be read.
            OSError: If the file cannot be opened.
        """
        found: ContainerReader = _imported(self.reader_at)(path, by_index=by_index)
        return found

    def create(self, path: Path, **options: Any) -> "ContainerWriter":
        """Create a file of this format; options that the format's writer lacks are ignored.

        Raises:
            UsageError: If the format lacks the wanted compression, or a package is missing.
            OSError: If the file cannot be written.
        """
        known = {name: value for name, value in options.items() if name in self.options}
        found: ContainerWriter = _imported(self.writer_at)(path, **known)
        return found

    def create_like(self, path: Path, style: Mapping[str, Any], *, profile: str) -> Any:
        """Create an output file of `tftool edit`, for messages that are already encoded.

        Args:
            path: Path of the file.
            style: Attribute `style` of the input's reader; empty if the input has another format.
            profile: MCAP profile to write if `style` has none: "ros1" or "ros2".

        Raises:
            OSError: If the file cannot be written.
        """
        module, name = self.writer_at
        return _imported((module, f"{name}.in_style"))(path, style, profile=profile)


def _imported(place: tuple[str, str]) -> Callable[..., Any]:
    module, name = place
    found: Callable[..., Any] = attrgetter(name)(import_module(f"tftool.recordings.{module}"))
    return found


CONTAINERS: Final = (
    ContainerFormat(
        "mcap",
        "MCAP",
        MCAP_MAGIC,
        ".mcap",
        "mcap",
        ("mcap.read", "Mcap"),
        ("mcap.write", "McapWriter"),
        ("compression", "profile", "library", "chunk_size"),
        keeps_sequences=True,
    ),
    ContainerFormat(
        "db3",
        "rosbag2 (sqlite3)",
        SQLITE_MAGIC,
        ".db3",
        "sqlite3",
        ("rosbag2.read", "Sqlite"),
        ("rosbag2.write", "SqliteWriter"),
        ("compression",),
        encoding="cdr",
    ),
    ContainerFormat(
        "bag",
        "ROS 1 bag",
        ROS1_MAGIC,
        ".bag",
        "",
        ("rosbag1.read", "Rosbag1"),
        ("rosbag1.write", "Ros1Messages"),
        ("compression",),
        encoding="ros1",
    ),
)
"""All container formats; those that rosbag2 can record have a storage."""

SUFFIXES: Final = (*(one.suffix for one in CONTAINERS), PACKED_SUFFIX)
"""Endings of the names of recording files."""


def container_of(path: Path) -> str:
    """Return the name of the file format for a path's suffix; "" if the path has no suffix.

    Raises:
        UsageError: If no file format has this suffix.
    """
    if not path.suffix:
        return ""
    for one in CONTAINERS:
        if one.suffix == path.suffix:
            return one.name
    *others, last = (one.suffix for one in CONTAINERS)
    raise UsageError(
        f"'{path.name}' does not end in the suffix of a recording: use {', '.join(others)} or "
        f"{last}, or no suffix for a rosbag2 folder."
    )


def container_named(name: str) -> ContainerFormat:
    """Return the file format with the name "mcap", "db3" or "bag"."""
    return next(one for one in CONTAINERS if one.name == name)


def container_stored(storage: str) -> ContainerFormat:
    """Return the file format that rosbag2 calls "mcap" or "sqlite3".

    Raises:
        UsageError: If rosbag2 has no such storage.
    """
    for one in CONTAINERS:
        if one.storage == storage and storage:
            return one
    known = " or ".join(one.storage for one in CONTAINERS if one.storage)
    raise UsageError(f"'{storage}' is not a storage of rosbag2: use {known}.")


RECORDED: Final = container_named("mcap")
"""The container that `record` writes; an incomplete file of this format can be read."""


def library_name() -> str:
    """Return tftool's name and version, as written into files."""
    # No module may import the package `tftool` itself, so the version is read in this way.
    version: str = sys.modules["tftool"].__version__
    return f"tftool {version}"
