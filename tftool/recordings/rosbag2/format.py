"""Reader and writer of `metadata.yaml` in rosbag2's folders."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import yaml

from tftool.base import yaml_guard
from tftool.base.named_files import open_regular
from tftool.base.stamps import Stamp
from tftool.recordings.channel import Channel, offers_text, restyled
from tftool.recordings.find import METADATA

_LARGEST_METADATA: Final = 1 << 24

VERSION: Final = 9
"""Default version of the metadata."""


@dataclass(frozen=True, slots=True)
class FileFacts:
    """Facts about one file for the metadata.

    Attributes:
        name: Name of the file in the folder.
        start: Log time of the first message; 0 without messages.
        end: Log time of the last message.
        count: Number of messages.
    """

    name: str
    start: Stamp
    end: Stamp
    count: int


def metadata_text(
    storage: str,
    files: Sequence[FileFacts],
    topics: Mapping[Channel, int],
    *,
    compression: tuple[str, str] = ("", ""),
    old: Mapping[str, Any] | None = None,
) -> str:
    """Return the contents of metadata.yaml.

    Args:
        storage: "mcap" or "sqlite3".
        files: Facts about the files, in order.
        topics: Number of messages of each channel.
        compression: Format and mode of rosbag2's compression of files or messages.
        old: Metadata of the original recording; None for a new recording. The version, and all
            facts that do not follow from the files, are copied from `old`.
    """
    version = int((old or {}).get("version", VERSION))
    filled = [one for one in files if one.count]
    start = min((one.start for one in filled), default=0)
    end = max((one.end for one in filled), default=0)
    document: dict[str, Any] = {
        **(old or {}),
        "version": version,
        "storage_identifier": storage,
        "duration": {"nanoseconds": end - start},
        "starting_time": {"nanoseconds_since_epoch": start},
        "message_count": sum(one.count for one in files),
        "topics_with_message_count": _listed(topics, version),
        "compression_format": compression[0],
        "compression_mode": compression[1],
        "relative_file_paths": [one.name for one in files],
    }
    if version > 4:
        document["files"] = [
            {
                "path": one.name,
                "starting_time": {"nanoseconds_since_epoch": one.start},
                "duration": {"nanoseconds": one.end - one.start},
                "message_count": one.count,
            }
            for one in files
        ]
    if version > 5:
        document.setdefault("custom_data", None)
    if version > 7:
        document.setdefault("ros_distro", "")
    return yaml.safe_dump(
        {"rosbag2_bagfile_information": document}, sort_keys=False, allow_unicode=True
    )


def _listed(topics: Mapping[Channel, int], version: int) -> list[dict[str, Any]]:
    """Return the section of the metadata about topics, with the channels of each topic merged."""
    listed: dict[tuple[str, str], dict[str, Any]] = {}
    for channel, count in topics.items():
        key = channel.topic, channel.type
        if key in listed:
            listed[key]["message_count"] += count
            continue
        metadata = {
            "name": channel.topic,
            "type": channel.type,
            "serialization_format": channel.encoding,
            "offered_qos_profiles": _offers(channel.extra("offered_qos_profiles"), version),
        }
        if version > 6:
            metadata["type_description_hash"] = channel.extra("topic_type_hash")
        listed[key] = {"topic_metadata": metadata, "message_count": count}
    return list(listed.values())


def read_metadata(folder: Path) -> dict[str, Any]:
    """Return the contents of a folder's metadata.yaml.

    Raises:
        OSError: If the file is missing or cannot be read.
        ValueError: If the file is too large, or not YAML.
        KeyError: If the file does not describe a recording.
        TypeError: If a value has another type than rosbag2 writes.
    """
    path = folder / METADATA
    if path.stat().st_size > _LARGEST_METADATA:
        raise ValueError("it is too large")
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        with open_regular(path) as file:
            document: Any = yaml_guard.load(file.read().decode(), loader)
    except (yaml.YAMLError, RecursionError) as error:
        raise ValueError(str(error) or type(error).__name__) from error
    found = document["rosbag2_bagfile_information"]
    if not isinstance(found, dict):
        raise TypeError("the file does not describe a recording")
    return found


def write_metadata(folder: Path, text: str) -> None:
    """Write a folder's metadata.yaml.

    Raises:
        OSError: If the file cannot be written.
    """
    (folder / METADATA).write_text(text, encoding="utf-8")


def _offers(text: str, version: int) -> Any:
    """Return a topic's QoS for a metadata version: text up to version 8, else a list."""
    text = restyled(text, version)
    if version < VERSION:
        return text
    try:
        loaded = yaml_guard.load(text, yaml.SafeLoader) if text.strip() else []
    except (yaml.YAMLError, ValueError, RecursionError):
        return []
    if not isinstance(loaded, list):
        return []
    # Readers need every policy, but some recorders write only some.
    (defaults,) = yaml.safe_load(offers_text(static=False))
    return [{**defaults, **one} for one in loaded if isinstance(one, dict)]
