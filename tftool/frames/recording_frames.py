"""Frames of a recording, and sentences about faults found while reading it."""

from collections.abc import Iterator

from tftool.base.plain_text import count
from tftool.frames.frames import Frames
from tftool.frames.source_options import DescriptionOptions, RecordingOptions
from tftool.recordings.cache_heads import default_folder
from tftool.recordings.column_cache import ColumnCache
from tftool.recordings.contract import Progress
from tftool.recordings.description_frames import DescribedFrames
from tftool.recordings.find import Found
from tftool.recordings.recording import Recording, open_recording
from tftool.recordings.tf_topics import implying
from tftool.robots.robot_model import Robot, load_urdf


def recording_notes(recording: Recording) -> list[str]:
    """Return sentences about damage, unusual transforms and added frames of a recording."""
    return [
        *recording.damage,
        *recording.source.oddities,
        *odometry_notes(recording),
        *_described_notes(recording.described),
        *(
            f"{text}." if times == 1 else f"{text} ({times} times)."
            for text, times in recording.oddities.items()
        ),
    ]


def odometry_notes(recording: Recording) -> Iterator[str]:
    """Yield sentences about odometry and poses that are used, or could be used, as transforms."""
    for topic in recording.odometry:
        messages = count(topic.count, "message")
        yield f"'{topic.name}' ({topic.type}, {messages}) is used as transforms."
    if not recording.edges:
        found = [f"'{topic.name}' ({topic.type})" for topic in implying(recording.topics)]
        if found:
            yield (
                "No transform was recorded; --with-odometry uses these messages instead: "
                f"{', '.join(found[:5])}{' …' if len(found) > 5 else ''}."
            )


def _described_notes(described: DescribedFrames | None) -> Iterator[str]:
    """Yield sentences about frames that were added from a robot description."""
    if described is None:
        return
    added = len(described.still) + len(described.moving)
    if added:
        yield (
            f"The robot's description added {count(added, 'frame')} that are not in tf; joint "
            f"states move {len(described.moving)} of these frames."
        )
    if described.gaps:
        shown = ", ".join(described.gaps[:5]) + (" …" if len(described.gaps) > 5 else "")
        yield (
            f"Neither tf nor joint states have the poses of {count(len(described.gaps), 'link')}: "
            f"{shown}."
        )


def read_recording(
    found: Found, options: DescriptionOptions, reading: RecordingOptions, progress: Progress | None
) -> Frames:
    """Return the frames of a recording and of the robot description in `--urdf`, if any."""
    robot = _robot_beside(options)
    folder = None if reading.no_cache else default_folder()
    recording = open_recording(
        found.name,
        progress=progress,
        robot=robot,
        cache=None if folder is None else ColumnCache(folder),
        with_odometry=reading.with_odometry,
        tf_topics=reading.tf_topics,
    )
    try:
        _ = recording.transforms
    except BaseException:
        recording.close()
        raise
    return Frames(
        "recording",
        recording.name,
        recording=recording,
        found=found,
        notes=lambda: recording_notes(recording),
    )


def _robot_beside(options: DescriptionOptions) -> Robot | None:
    """Return the robot of the description in `--urdf`; None without that option."""
    if options.joints:
        options.refuse("The joints of a recording cannot be set")
    if options.urdf is None and not options.arguments:
        return None
    if options.urdf is None:
        options.refuse("xacro arguments need a robot description: name one with --urdf FILE")

    assert options.urdf is not None
    return load_urdf(options.urdf, options.arguments)
