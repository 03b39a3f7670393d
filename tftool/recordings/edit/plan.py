"""Input recordings of `tftool edit`, and checks of its options before anything is written."""

import contextlib
import tempfile
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from tftool.base.errors import InputError, TransformException, UsageError
from tftool.base.plain_text import near_names
from tftool.base.stamps import LAST_STAMP, Stamp, as_seconds, display
from tftool.geometry.rigid import Transform
from tftool.recordings.container import ContainerReader
from tftool.recordings.edit.changes import (
    Changer,
    Edits,
    LinkName,
    Reparenting,
    Window,
    fits,
)
from tftool.recordings.find import Found, Kind, container_in, find, kind_of_file, refusal
from tftool.recordings.poses.pose_container import open_poses
from tftool.recordings.recording import Recording
from tftool.recordings.rosbag2.folder import files_of_folder, unpack_file
from tftool.recordings.rosbag2.format import read_metadata
from tftool.recordings.rosbag2.read import Sqlite


@dataclass(slots=True)
class EditedInput:
    """One recording to edit; a context manager.

    Attributes:
        name: Name as the user gave it.
        readers: Readers of the files, in order.
        paths: Paths of the files.
        is_folder: Whether the input is a rosbag2 folder.
        metadata: Contents of the folder's metadata.yaml.
        mode: rosbag2's compression mode: "file" or "message"; "" without compression.
        damage: Sentences about damage of the folder.
        notes: Other sentences about the folder.
    """

    name: str
    readers: list[ContainerReader] = field(default_factory=list)
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
        return sum(reader.size for reader in self.readers)

    def close(self) -> None:
        """Close the input's files, and remove decompressed copies."""
        for reader in self.readers:
            reader.close()
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
        self.readers.append(open_reader(place, kind, unpacks=self.mode == "message"))
        self.paths.append(path)

    def add_poses(self, found: Found) -> None:
        """Convert a pose file to a temporary MCAP file, and open the MCAP file.

        Raises:
            InputError: If the file cannot be read.
        """
        folder = tempfile.TemporaryDirectory(prefix="tftool-")
        self._unpacked.append(folder)
        place = Path(folder.name) / "poses.mcap"
        poses = open_poses(found)
        self.notes += [*poses.damage, *poses.oddities]
        poses.write_mcap(place)
        self.readers.append(open_reader(place, Kind.MCAP))
        self.paths.append(found.paths[0])


def open_input(name: str) -> EditedInput:
    """Open a recording to edit: a file, a rosbag2 folder, or a glob of files.

    Raises:
        InputError: If the recording is missing, or cannot be read.
        UsageError: If the name belongs to a file that is not a recording.
    """
    found = find(name)
    if not found.kind.is_recording:
        raise UsageError(f"'{name}' is a {found.kind.value}: name a recording instead.")
    opened = EditedInput(name)
    opened.notes += found.notices()
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
                raise InputError(
                    f"'{path}' is a folder, which must be the only input: with several inputs, "
                    "give the path of each recording."
                )
            try:
                opened.add(path)
                continue
            except InputError as error:
                refused.append(error)
            except OSError as error:
                refused.append(refusal(path, error))
            opened.damage.append(f"{path.name} is left out: {refused[-1]}")
        if not opened.readers:
            raise refused[0]
    except OSError as error:
        opened.close()
        raise InputError(f"'{name}' cannot be read: {error.strerror or error}") from error
    except BaseException:
        opened.close()
        raise
    return opened


def open_reader(path: Path, kind: Kind | None = None, *, unpacks: bool = False) -> ContainerReader:
    """Open a file of a recording for reading from beginning to end.

    Raises:
        InputError: If the file is not a recording, or cannot be read.
        OSError: If the file cannot be opened.
    """
    reader = container_in(path, kind or kind_of_file(path)).open(path, by_index=False)
    if isinstance(reader, Sqlite):
        reader.unpacks = unpacks
    return reader


def changer_for(edits: Edits, recordings: Sequence[Recording]) -> Changer:
    """Check all options of an edit, and create the editor of the messages.

    Args:
        edits: The edits.
        recordings: The opened recordings; transforms are read only if an option names links.

    Raises:
        UsageError: If an option names a missing topic or frame, or cannot be carried out.
    """
    _check_names(edits, recordings)
    window = _window(edits, recordings)
    changer = Changer(edits, window, _reparenting(edits, recordings))
    changer.topics = _concerned(edits, recordings)
    return changer


def _check_names(edits: Edits, recordings: Sequence[Recording]) -> None:
    """Check that the options' old frame names are recorded, and that new names stay distinct.

    Raises:
        UsageError: If an old name is not recorded, or two frames would get the same name.
    """
    wanted: list[LinkName] = [*edits.drop, *edits.poses, *edits.reparent]
    if not (wanted or edits.rename):
        return
    links = {(e.parent, e.child) for one in recordings for e in one.edges}
    frames = {name for link in links for name in link}
    for link in wanted:
        if not any(fits(one, link) for one in links):
            raise UsageError(_no_such_link(link, links))
    for name in edits.rename:
        if name not in frames:
            raise UsageError(_no_such_frame(name, frames))
    after = Counter(edits.name(name) for name in frames)
    clash = [name for name, count in after.items() if count > 1]
    if clash and edits.rename:
        both = sorted(name for name in frames if edits.name(name) == clash[0])
        raise UsageError(
            f"Two frames would have the name '{clash[0]}': {' and '.join(map(repr, both))}: "
            "choose another name."
        )


def _concerned(edits: Edits, recordings: Sequence[Recording]) -> frozenset[str] | None:
    """Return the topics whose transforms the edit changes; None if all topics must be examined."""
    wanted = [*edits.drop, *edits.poses, *edits.reparent]
    if not wanted or edits.names or edits.stamps or edits.statics_from:
        return None
    found: set[str] = set()
    for recording in recordings:
        transforms = recording.transforms
        if recording.damage:
            return None
        for edge in transforms.edges:
            if any(fits((edge.parent, edge.child), link) for link in wanted):
                senders = np.unique(transforms.senders_of(edge)).tolist()
                found |= {transforms.publishers[sender].topic for sender in senders}
    return frozenset(found)


def _window(edits: Edits, recordings: Sequence[Recording]) -> Window | None:
    """Return the time span that --from and --to keep; None without these options."""
    if not edits.cuts:
        return None
    low = edits.start if edits.start is not None else 0
    high = edits.end if edits.end is not None else LAST_STAMP
    if high < low:
        raise UsageError("--to is before --from: exchange the two times.")
    moving = [(one, edge) for one in recordings for edge in one.edges if not edge.static]
    spans: dict[LinkName, tuple[Stamp, Stamp]] = {}
    offsets, logs = [], []
    for recording, edge in moving:
        log_times = recording.transforms.log_times_of(edge)
        moments = log_times if edits.by_record_time else edge.stamps
        first, last = _widened(moments, low, high)
        link = edge.parent, edge.child
        if link in spans:
            first, last = min(first, spans[link][0]), max(last, spans[link][1])
        spans[link] = first, last
        kept = log_times[(moments >= first) & (moments <= last)]
        if len(kept):
            logs.append(int(kept.min()))
        offsets.append(log_times - edge.stamps)
    # In an empty recording start and end are 0.
    received = [
        moment for one in recordings for moment in (one.source.start, one.source.end) if moment
    ]
    if edits.by_record_time or not offsets:
        _refuse_outside(edits, recordings, received)
        return Window(low, high, None, spans if edits.by_record_time else {})
    offset = int(np.median(np.concatenate(offsets)))
    # Messages of other topics may be later than the last transform.
    dated = [edge.stamps[edge.stamps > 0] for _, edge in moving]
    stamped = [int(moment) for one in dated if len(one) for moment in (one.min(), one.max())]
    _refuse_outside(edits, recordings, [*stamped, *(moment - offset for moment in received)])
    end = high if high == LAST_STAMP else high + offset
    start = 0 if edits.start is None else low + offset
    return Window(start, end, (low, high), spans)


def _refuse_outside(
    edits: Edits, recordings: Sequence[Recording], moments: Sequence[Stamp]
) -> None:
    """Raise an error if --from is after the end of the recordings, or --to before their start.

    Args:
        edits: The edits with the cut.
        recordings: Recordings to cut.
        moments: Times of messages, in any order.

    Raises:
        UsageError: If the cut keeps nothing.
    """
    if not moments:
        return
    first, last = min(moments), max(moments)
    if edits.start is not None and edits.start > last:
        # Users count seconds from the first stamp; stamps of 0 are not set.
        begins = [one.source.start if edits.by_record_time else one.start for one in recordings]
        start = min(filter(None, begins), default=0)
        raise UsageError(
            f"Nothing was recorded after --from: the recording ends {as_seconds(last - start):.3f}"
            f" s after its start, at {display(last)}."
        )
    if edits.end is not None and edits.end < first:
        raise UsageError(
            f"Nothing was recorded before --to: the recording begins at {display(first)}."
        )


def _reparenting(edits: Edits, recordings: Sequence[Recording]) -> Reparenting | None:
    """Return the function that computes poses in new parents; None without --reparent."""
    if not edits.reparent:
        return None
    if len(recordings) > 1:
        raise UsageError(
            "--reparent needs a single recording: join the recordings first, then edit the result "
            "with --reparent."
        )
    recording = recordings[0]
    static = {edge.child: edge.parent for edge in recording.edges if edge.static}
    parents: dict[str, set[str]] = {}
    for edge in recording.edges:
        parents.setdefault(edge.child, set()).add(edge.parent)
    frames = parents.keys() | {name for found in parents.values() for name in found}
    for (parent, child), new in edits.reparent.items():
        if new not in frames:
            raise UsageError(_no_such_frame(new, frames))
        if child in _above(new, parents):
            raise UsageError(
                f"'{new}' is below '{child}' in the tree, so '{new}' cannot become the parent of "
                f"'{child}': choose another frame."
            )
        is_static = static.get(child) == parent
        if is_static and not _joined_by_statics(parent, new, static):
            raise UsageError(
                f"'{child}' is static, but '{new}' moves relative to '{parent}': a static "
                f"'{child}' cannot become the child of '{new}'."
            )
    buffer = recording.buffer

    def found(link: LinkName, stamp: Stamp) -> Transform | None:
        try:
            return buffer.lookup_transform(edits.reparent[link], link[0], stamp).transform
        except TransformException:
            return None

    return found


def _widened(moments: "np.ndarray", low: Stamp, high: Stamp) -> tuple[Stamp, Stamp]:
    """Widen the time span from `low` to `high` to the nearest times in `moments` outside the span.

    Interpolation at `low` and `high` needs the samples at the new ends.
    """
    before, behind = moments[moments <= low], moments[moments >= high]
    first = int(before.max()) if len(before) else low
    last = int(behind.min()) if len(behind) else high
    return first, last


def _above(frame: str, parents: Mapping[str, set[str]]) -> set[str]:
    """Return a frame and all ancestors that the frame has at any time."""
    found, waiting = {frame}, [frame]
    while waiting:
        for parent in parents.get(waiting.pop(), ()):
            if parent not in found:
                found.add(parent)
                waiting.append(parent)
    return found


def _joined_by_statics(one: str, other: str, static: Mapping[str, str]) -> bool:
    """Whether only static transforms connect two frames, so that their pose is constant."""

    def up(frame: str) -> list[str]:
        found = [frame]
        while frame in static and static[frame] not in found:
            frame = static[frame]
            found.append(frame)
        return found

    return not set(up(one)).isdisjoint(up(other))


def _no_such_link(link: LinkName, links: "set[LinkName]") -> str:
    parent, child = link
    others = sorted(p for p, c in links if c == child)
    if others:
        hint = f"the parent of '{child}' is '{others[0]}': name {others[0]}:{child}."
    else:
        hint = _near(f"{parent}:{child}", {f"{one}:{below}" for one, below in links})
    return f"No link {parent}:{child} was recorded; {hint}"


def _no_such_frame(name: str, frames: "set[str]") -> str:
    return f"No frame '{name}' was recorded; {_near(name, frames)}"


def _near(name: str, names: "set[str]") -> str:
    near = near_names(name, sorted(names), 3)
    if near:
        return f"did you mean {' or '.join(near)}?"
    if not names:
        return "the recording contains no transforms."
    shown = ", ".join(sorted(names)[:8])
    return f"there are {shown}{' ...' if len(names) > 8 else '.'}"
