"""Snapshot of all frames of a buffer, and text of a snapshot as tf2's YAML, sentences or dot."""

from collections.abc import Iterable
from typing import TypeAlias

from tftool.base.stamps import Duration, Stamp, as_seconds, display
from tftool.buffer.forest import NO_PARENT_NAME, Frame, FrameTree
from tftool.buffer.history import IDENTITY, NO_PARENT, Link, Sample
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.geometry import poses, quaternions, rigid
from tftool.geometry.rigid import Transform

# The shortest span, nanoseconds, by which tf2 divides to compute a rate.
_SHORTEST: Duration = 100_000

_Located: TypeAlias = tuple[int, Sample | None, Sample | None]
"""Root's number (negative for a loop), pose in the parent, and pose in the root."""


def snapshot(tree: FrameTree, now: Stamp, at: Stamp) -> Snapshot:
    """Return the state of all frames at the time `at`; 0 means each frame's latest time."""
    sweep = _Sweep(tree, at)
    return Snapshot(now, at, tuple(sweep.info(frame, now) for frame in tree.frames))


def rate(link: Link) -> float:
    """Return the rate of a link's samples in hertz by tf2's formula; 10000 for one sample."""
    return rate_of(len(link), link.newest_stamp - link.oldest_stamp)


def rate_of(samples: int, span: Duration) -> float:
    """Return the rate of `samples` samples in `span` nanoseconds, hertz, by tf2's formula."""
    return samples * 1e9 / max(span, _SHORTEST)


class _Sweep:
    """Computation of the poses of all frames, with a cache for frames on several paths."""

    def __init__(self, tree: FrameTree, at: Stamp) -> None:
        self.frames = tree.frames
        self.at = at
        self.located: dict[Stamp, dict[int, _Located]] = {}
        self.latest: dict[int, tuple[Stamp, int]] = {}

    def info(self, frame: Frame, now: Stamp) -> FrameInfo:
        number, at = frame.number, self.at
        if at == 0:
            latest, newest_root = self.latest_of(number)
            root, _, pose = self.locate(number, latest)
            if root != newest_root:
                # At the latest time of the whole chain, the frame was still in another tree.
                root, pose = newest_root, None
            own = None if frame.link is None else frame.link.newest
        else:
            root, own, pose = self.locate(number, at)
        root_name = None if root < 0 else self.frames[root].name
        root_from_frame = None if pose is None else _transform(pose)
        parent = self.parent(number, at)
        link = frame.link
        if link is None or parent < 0:
            # Arguments by position take a third of the time of arguments by name.
            return FrameInfo(
                frame.name, None, False, frame.authority,
                0, 0.0, 0, 0, 0, 0,
                rigid.IDENTITY, root_name, root_from_frame,
            )  # fmt: skip
        is_static, oldest, newest = link.is_static, link.oldest_stamp, link.newest_stamp
        age = 0 if is_static else now - newest
        return FrameInfo(
            frame.name, self.frames[parent].name, is_static, frame.authority,
            len(link), rate(link), oldest, newest, newest - oldest, age,
            None if own is None else _transform(own), root_name, root_from_frame,
        )  # fmt: skip

    def parent(self, number: int, time: Stamp) -> int:
        """Return a frame's parent at a time; outside the samples' span, the newest parent."""
        link = self.frames[number].link
        if link is None or link.newest is None:
            return NO_PARENT
        if not link.mixed:
            return link.parent
        parent = link.parent_at(time)
        return link.parent if parent < 0 else parent

    def latest_of(self, number: int) -> tuple[Stamp, int]:
        """Return the newest time at which all frames up to the root have data, and the root."""
        chain: list[int] = []
        while True:
            known = self.latest.get(number)
            if known is not None:
                break
            if len(chain) > len(self.frames):
                known = (0, -1)
                break
            parent = self.parent(number, 0)
            if parent < 0:
                known = self.latest[number] = (0, number)
                break
            chain.append(number)
            number = parent
        latest, root = known
        for number in reversed(chain):
            link = self.frames[number].link
            stamp = 0 if link is None else link.newest_stamp
            if stamp != 0 and (latest == 0 or stamp < latest):
                latest = stamp
            self.latest[number] = (latest, root)
        return latest, root

    def locate(self, number: int, time: Stamp) -> _Located:
        """Return the root of a frame at a time, and the frame's poses in its parent and root."""
        located = self.located.get(time)
        if located is None:
            located = self.located[time] = {}
        known = located.get(number)
        if known is not None:
            return known
        chain: list[int] = []
        while known is None:
            parent = self.parent(number, time)
            if parent < 0:
                known = located[number] = (number, None, IDENTITY)
                break
            if len(chain) > len(self.frames):
                known = (-1, None, None)
                break
            chain.append(number)
            number = parent
            known = located.get(number)
        root, _, pose = known
        for number in reversed(chain):
            link = self.frames[number].link
            own = None if link is None else link.at(time)
            if own is not None and own[6] != own[6]:
                own = None
            pose = None if own is None or pose is None else poses.compose(pose, own)
            known = located[number] = (root, own, pose)
        return known


def _transform(sample: Sample) -> Transform:
    x, y, z, qx, qy, qz, qw = sample
    return rigid.transform((x, y, z), quaternions.canonical((qx, qy, qz, qw)))


# Snapshots as text


def as_yaml(frames: Iterable[FrameInfo], current_time: Stamp = 0) -> str:
    """Format all frames as tf2's YAML.

    Args:
        frames: Frames in the order to be written; frames without a parent are left out.
        current_time: Nanoseconds; if not 0, the text gives the age of each frame's newest sample at
            this time.

    Returns:
        The text in tf2's form, with unquoted names; "[]" without frames, and "" if no frame has
        data.
    """
    frames = list(frames)
    if not frames:
        return "[]"
    lines: list[str] = []
    for info in frames:
        if info.parent is None:
            continue
        lines += [
            f"{info.frame}: ",
            f"  parent: '{info.parent}'",
            f"  broadcaster: '{info.authority or 'no recorded authority'}'",
            f"  rate: {info.rate:.3f}",
            f"  most_recent_transform: {display(info.newest)}",
            f"  oldest_transform: {display(info.oldest)}",
        ]
        if current_time != 0:
            lines.append(f"  transform_delay: {as_seconds(current_time - info.newest):.3f}")
        lines.append(f"  buffer_length: {as_seconds(info.buffer_length):.3f}")
    return "".join(f"{line}\n" for line in lines)


def as_string(frames: Iterable[FrameInfo]) -> str:
    """Format one sentence for each child frame, as tf2 does."""
    return "".join(
        f"Frame {info.frame} exists with parent {info.parent or NO_PARENT_NAME}.\n"
        for info in frames
        if info.authority is not None
    )


def as_dot(frames: Iterable[FrameInfo], current_time: Stamp = 0) -> str:
    """Format the frames as tf2's core does for Graphviz (`view_frames` prints another form).

    Names are written unchanged, so the caller must escape untrusted names.
    """
    frames = list(frames)
    if not frames:
        return 'digraph G {\n"no tf data recieved"}'
    text = "digraph G {\n"
    for info in frames:
        if info.parent is None:
            continue
        age = ""
        if current_time != 0:
            age = f"( {as_seconds(current_time - info.newest):.3f} sec old)"
        text += (
            f'"{info.parent}" -> "{info.frame}"'
            f'[label="Broadcaster: {info.authority or "no recorded authority"}\\n'
            f"Average rate: {info.rate:.3f} Hz\\n"
            f"Most recent transform: {display(info.newest)} {age}\\n"
            f'Buffer length: {as_seconds(info.buffer_length):.3f} sec\\n"];\n'
        )
    for info in frames:
        never_sent = info.authority is None
        if info.parent is not None or (never_sent and current_time == 0):
            continue
        text += "edge [style=invis];\n subgraph cluster_legend { style=bold; color=black; "
        text += 'label ="view_frames Result";\n'
        if current_time != 0:
            text += f'"Recorded at time: {display(current_time)}"[ shape=plaintext ] ;\n '
        text += f'}}->"{info.frame}";\n'
    return text + "}"
