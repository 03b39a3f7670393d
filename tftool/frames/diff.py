"""Comparison of two sets of frames: recordings, buffers, descriptions or files, in any mix."""

import os

from tftool.base.errors import UsageError
from tftool.buffer.buffer import Buffer
from tftool.frames.differences import Allowance, Differences, Side, compare
from tftool.frames.frames import Frames
from tftool.recordings.find import Kind, find
from tftool.recordings.recording import Recording, open_recording
from tftool.robots.robot_model import Robot, load_urdf
from tftool.robots.static_publishers import StaticFrames, load_statics

Comparable = Frames | Recording | Robot | Buffer | StaticFrames | str | os.PathLike[str]
"""Source of frames to compare; a path must name a recording, a description or a launch file."""


def diff(
    a: Comparable,
    b: Comparable,
    *,
    mm: float = 1.0,
    deg: float = 0.1,
    rate_percent: float | None = None,
    align_starts: bool = False,
) -> Differences:
    """Compare two sets of frames, link by link; see `differences.compare`::

        for one in tftool.diff("monday.mcap", "robot.urdf").changed:
            print(one.child, *one.changes)

    Args:
        a: The first set: frames, or the path of a file with frames.
        b: The second set.
        mm: Tolerated displacement of a frame, millimetres.
        deg: Tolerated rotation of a frame, degrees.
        rate_percent: Tolerated difference of rates, percent; None to ignore rates.
        align_starts: Whether times count from the start of each set.

    Returns:
        All links with their changes; false if nothing changed.

    Raises:
        InputError: If a path cannot be read, or a set has no frames.
        UsageError: If a path names a scenario, which must be played first.
    """
    allowance = Allowance(mm, deg, rate_percent)
    return compare(side_of(a, "A"), side_of(b, "B"), allowance, align_starts=align_starts)


def side_of(frames: Comparable, name: str) -> Side:
    """Return frames as one side of a comparison.

    Args:
        frames: Source of the frames.
        name: Name for a side without a name: "A" or "B".

    Raises:
        InputError: If a path cannot be read.
        UsageError: If a path names a scenario.
    """
    if isinstance(frames, str | os.PathLike):
        return _opened(os.fspath(frames))
    if isinstance(frames, Frames):
        return Side(frames.label, frames.buffer, frames.span[0], frames.moving or frozenset())
    if isinstance(frames, Buffer):
        stamps = [int(one.stamps[0]) for one in map(frames.samples, frames.frames()) if len(one)]
        return Side(name, frames, min((one for one in stamps if one), default=0))
    if isinstance(frames, Robot):
        return Side(frames.name, frames.buffer(), 0, joints_of(frames))
    return Side(frames.name, frames.buffer, frames.start)


def joints_of(robot: Robot) -> frozenset[str]:
    """Return the names of a robot's links whose pose depends on a joint."""
    return frozenset(one.child for one in robot.joints.values() if one.moves)


def _opened(path: str) -> Side:
    found = find(path)
    if found.kind is Kind.SCENARIO:
        raise UsageError(
            f"'{path}' is a scenario, which must be played first: use 'tftool diff', or give "
            "the buffer of a world."
        )
    if found.kind is Kind.STATICS:
        return side_of(load_statics(found.paths[0], path), path)
    if found.kind is Kind.DESCRIPTION:
        return side_of(load_urdf(found.paths[0]), path)
    with open_recording(path) as recording:
        return side_of(recording, path)
