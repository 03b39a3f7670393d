"""Writer of a recording: transforms and messages in a file that `open_recording` reads."""

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from tftool.base.stamps import Stamp
from tftool.buffer.sample import TransformStamped
from tftool.messages.classes import INTERFACES, Message
from tftool.messages.codec import codec
from tftool.messages.transforms import encode_transforms
from tftool.recordings.channel import Channel, ContainerWriter
from tftool.recordings.containers import (
    container_named,
    container_of,
    container_stored,
    library_name,
)
from tftool.recordings.message_conversion import TRANSFORMS, ros2_channel
from tftool.recordings.rosbag2.write import FolderWriter
from tftool.recordings.target import Target, failed


class RecordingWriter:
    """A recording being written, returned by `write_recording`; a context manager.

    At the end of the `with` block the complete file gets its final name. If an exception leaves the
    block, the written data is removed, and an old file with that name stays.
    """

    def __init__(self, target: Target, container: ContainerWriter) -> None:
        """Create a recording from the writer of its file.

        Args:
            target: File or folder to write.
            container: Writer of the file.
        """
        self._target = target
        self.container = container
        self._numbers: dict[Channel, int] = {}
        self._last = 0

    def __enter__(self) -> "RecordingWriter":
        return self

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        if kind is None:
            self.close()
            return
        self.discard()
        if isinstance(error, OSError):
            raise failed(self._target.path, error) from error

    def __repr__(self) -> str:
        return f"<RecordingWriter {str(self._target.path)!r}>"

    def transforms(
        self,
        samples: Iterable[TransformStamped],
        log_time: Stamp | None = None,
        topic: str = "/tf",
    ) -> None:
        """Append one TFMessage with some transforms.

        Args:
            samples: Transforms of the message.
            log_time: Time of reception, nanoseconds; None for the newest stamp.
            topic: Name of the topic.
        """
        self._write_transforms(samples, log_time, topic, static=False)

    def static_transforms(
        self,
        samples: Iterable[TransformStamped],
        log_time: Stamp | None = None,
        topic: str = "/tf_static",
    ) -> None:
        """Append one TFMessage with static transforms; see `transforms`."""
        self._write_transforms(samples, log_time, topic, static=True)

    def _write_transforms(
        self, samples: Iterable[TransformStamped], log_time: Stamp | None, topic: str, static: bool
    ) -> None:
        chosen = tuple(samples)
        if log_time is None:
            log_time = max((one.stamp for one in chosen), default=0) or self._last
        channel = ros2_channel(topic, TRANSFORMS, static=static)
        self.raw(channel, log_time, encode_transforms(chosen))

    def message(self, topic: str, message: Message, log_time: Stamp) -> None:
        """Append one message, whose type must be included in tftool.

        Raises:
            InputError: If the type is unknown, or a value does not fit its field.
        """
        kind = type(message)
        self.raw(ros2_channel(topic, kind.interface__), log_time, codec(kind).encode(message))

    def raw(
        self,
        channel: Channel,
        log_time: Stamp,
        payload: bytes,
        publish_time: Stamp | None = None,
        sequence: int = 0,
    ) -> None:
        """Append one message, given as bytes.

        Args:
            channel: Channel of the message.
            log_time: Time of reception, nanoseconds.
            payload: Bytes of the message, in the channel's encoding.
            publish_time: Time of publication, nanoseconds; `log_time` if not recorded.
            sequence: Publisher's sequence number.
        """
        number = self._numbers.get(channel)
        if number is None:
            number = self._numbers[channel] = self.container.channel(channel)
        self._last = max(self._last, log_time)
        self.container.write(number, log_time, payload, publish_time, sequence)

    def new_message(self, kind: str) -> Any:
        """Return an empty message of a type: `new_message("std_msgs/String")`.

        Raises:
            InputError: If the type is not known.
        """
        return INTERFACES.message(kind)()

    def close(self) -> None:
        """Complete the recording, and give it its final name.

        Raises:
            InputError: If the recording cannot be completed. The written data is removed.
        """
        try:
            self.container.finish()
        except OSError as error:
            self.discard()
            raise failed(self._target.path, error) from error
        except BaseException:
            self.discard()
            raise
        self._target.commit()

    def discard(self) -> None:
        """Remove the written data, but not an existing file with the name of the recording."""
        self.container.abandon()
        self._target.discard()


def write_recording(
    path: "str | os.PathLike[str]",
    *,
    compression: str | None = None,
    storage: str = "mcap",
    profile: str = "ros2",
    force: bool = False,
) -> RecordingWriter:
    """Create a recording: MCAP, rosbag2 or a ROS 1 bag, depending on the path's suffix.

        with tftool.write_recording("run.mcap") as recording:
            recording.static_transforms([laser_in_base])
            recording.transforms([base_in_odom])

    The recording is written under a temporary name, and renamed when complete.

    Args:
        path: Path that ends in ".mcap", ".db3" or ".bag"; without a suffix, a rosbag2 folder.
        compression: For MCAP "zstd", "lz4" or "none"; None means "zstd" if installed, else "none".
            For ROS 1 bags "bz2", "lz4" or "none"; None means "none".
        storage: Storage of a folder: "mcap" or "sqlite3".
        profile: Profile of an MCAP file: "ros2", or "" for none.
        force: Whether an existing file may be replaced.

    Raises:
        UsageError: If the file exists and `force` is not given, the suffix is unknown,
            or the compression is unknown or not installed.
        InputError: If the file cannot be written.
    """
    place = Path(path)
    name = container_of(place)
    target = Target(place, folder=not name, force=force)
    try:
        form = container_stored(storage)
        file = target.part / f"{place.name}_0{form.suffix}"
        if name:
            form, file = container_named(name), target.part
        container = form.create(
            file, compression=compression, profile=profile, library=library_name()
        )
        if not name:
            container = FolderWriter(target.part, file, storage, container)
    except OSError as error:
        target.discard()
        raise failed(place, error) from error
    except BaseException:
        target.discard()
        raise
    return RecordingWriter(target, container)
