"""What a recording is written into, by the name it is to have."""

from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Final

from tftool.base.errors import UsageError
from tftool.base.stamps import Stamp
from tftool.recordings.channel import Channel, ContainerWriter
from tftool.recordings.compression import best_compression
from tftool.recordings.mcap.write import McapWriter
from tftool.recordings.message_conversion import as_ros1
from tftool.recordings.rosbag1.write import Rosbag1Writer
from tftool.recordings.rosbag2.folder_writer import FileFacts, metadata_text, write_metadata
from tftool.recordings.rosbag2.write import SqliteWriter

CONTAINERS: Final = {".mcap": "mcap", ".db3": "db3", ".bag": "bag"}
"""The container that each suffix names."""

STORAGES: Final = {"mcap": ".mcap", "sqlite3": ".db3"}
"""What a folder of rosbag2's may hold, and the suffix of its files."""


def container_of(path: Path) -> str:
    """The container that a name asks for; "" for a folder.

    Raises:
        UsageError: If it asks for one that is not written.
    """
    if not path.suffix:
        return ""
    found = CONTAINERS.get(path.suffix)
    if found is None:
        raise UsageError(
            f"'{path.name}' names no container to write: .mcap, .db3 and .bag do, and a name "
            "without a suffix is a folder as rosbag2 records it."
        )
    return found


class Ros1Messages:
    """A ROS 1 bag that is given messages of ROS 2; see `ContainerWriter`."""

    def __init__(self, bag: Rosbag1Writer) -> None:
        """Take the bag."""
        self._bag = bag
        self._payloads: dict[int, Callable[[bytes], bytes]] = {}

    @property
    def size(self) -> int:
        """Bytes written so far, those that wait included."""
        return self._bag.size

    def channel(self, channel: Channel) -> int:
        """Make a stream known.

        Raises:
            InputError: If ROS 1 has nothing like its type.
        """
        conversion = as_ros1(channel)
        number = self._bag.channel(conversion.channel)
        self._payloads[number] = conversion.payload
        return number

    def write(
        self,
        channel: int,
        log_time: Stamp,
        payload: bytes,
        publish_time: Stamp | None = None,
        sequence: int = 0,
    ) -> None:
        """Append one message."""
        self._bag.write(channel, log_time, self._payloads[channel](payload))

    def finish(self) -> None:
        """Close the file."""
        self._bag.finish()

    def abandon(self) -> None:
        """Close the file as it is."""
        self._bag.abandon()


class FolderWriter:
    """A folder of one file and its metadata, as rosbag2 records it; see `ContainerWriter`."""

    def __init__(self, folder: Path, file: Path, storage: str, inner: ContainerWriter) -> None:
        """Take the folder and what writes its file.

        Args:
            folder: The folder.
            file: The file in it.
            storage: "mcap" or "sqlite3".
            inner: What writes the file.
        """
        self._folder = folder
        self._file = file
        self._storage = storage
        self._inner = inner
        self._channels: dict[int, Channel] = {}
        self._counts: Counter[int] = Counter()
        self._low: Stamp = 2**63 - 1
        self._high: Stamp = 0

    @property
    def size(self) -> int:
        """Bytes written so far, those that wait included."""
        return self._inner.size

    def channel(self, channel: Channel) -> int:
        """Make a stream known."""
        number = self._inner.channel(channel)
        self._channels.setdefault(number, channel)
        return number

    def write(
        self,
        channel: int,
        log_time: Stamp,
        payload: bytes,
        publish_time: Stamp | None = None,
        sequence: int = 0,
    ) -> None:
        """Append one message."""
        self._inner.write(channel, log_time, payload, publish_time, sequence)
        self._counts[channel] += 1
        self._low, self._high = min(self._low, log_time), max(self._high, log_time)

    def finish(self) -> None:
        """Close the file, and write the metadata."""
        self._inner.finish()
        count = sum(self._counts.values())
        facts = FileFacts(self._file.name, self._low if count else 0, self._high, count)
        topics = {channel: self._counts[number] for number, channel in self._channels.items()}
        write_metadata(self._folder, metadata_text(self._storage, [facts], topics))

    def abandon(self) -> None:
        """Close the file as it is."""
        self._inner.abandon()


def open_container(
    part: Path,
    name: Path,
    *,
    storage: str = "mcap",
    compression: str | None = None,
    profile: str = "ros2",
    library: str = "",
) -> ContainerWriter:
    """Begin what a name asks for; given messages of ROS 2.

    Args:
        part: Where it is written.
        name: What it is to be called.
        storage: What a folder holds: "mcap" or "sqlite3".
        compression: Of the container; what is usual in it if None.
        profile: Of an MCAP file.
        library: Likewise.

    Raises:
        UsageError: If it has no such compression, or that is not installed.
        OSError: If it cannot be written.
    """
    container = container_of(name)
    if storage not in STORAGES:
        raise UsageError(f"'{storage}' is no storage of rosbag2: {' and '.join(STORAGES)} are.")
    file = part
    if not container:
        file = part / f"{name.name}_0{STORAGES[storage]}"
        container = CONTAINERS[STORAGES[storage]]
    inner: ContainerWriter
    if container == "mcap":
        inner = McapWriter(
            file, profile=profile, library=library, compression=compression or best_compression()
        )
    elif container == "bag":
        inner = Ros1Messages(Rosbag1Writer(file, compression=compression or "none"))
    else:
        if compression not in (None, "none"):
            raise UsageError(f"rosbag2's sqlite files are not compressed with {compression}.")
        inner = SqliteWriter(file)
    return inner if file is part else FolderWriter(part, file, storage, inner)
