"""Search for the files that a command-line argument names, and detection of each file's kind.

The kind of a source is decided by content, never by suffix. Only names, sizes and the first bytes
of files are examined.
"""

import contextlib
import errno
import glob
import os
import re
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any, Final

from tftool.base.errors import InputError, UsageError
from tftool.base.named_files import open_regular
from tftool.recordings.containers import CONTAINERS, SUFFIXES, ZSTD_MAGIC, ContainerFormat
from tftool.recordings.poses.pose_options import options_of, path_behind_prefix

_URL = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*(?:::.*)?://")


def is_url(word: str) -> bool:
    """Whether a word is a URL, such as `s3://bucket/run.mcap` or `https://…`."""
    return _URL.match(word) is not None and not os.path.lexists(word)


@contextmanager
def fetched(place: str) -> Iterator[str]:
    """Yield a local path to a file; the file of a URL is first copied to a temporary folder.

    Args:
        place: A local path, which is yielded unchanged, or a URL.

    Raises:
        InputError: If the file is missing, or cannot be fetched.
        UsageError: If fsspec is not installed.
    """
    if not is_url(place):
        yield place
        return
    with tempfile.TemporaryDirectory(prefix="tftool-") as folder:
        system, path = _opened(place)
        # Keep the name, because it shows the order of a recording's parts.
        name = path.rstrip("/").rpartition("/")[2] or "recording"
        own = os.path.join(folder, re.sub(r"[^\w.-]", "_", name))
        with _failures_told(place):
            if system.isdir(path):
                system.get(path.rstrip("/") + "/", own + os.sep, recursive=True)
            else:
                system.get_file(path, own)
        yield own


def listed(place: str) -> list[str]:
    """Return the files that match a URL with wildcards; return `[place]` without a wildcard.

    The wildcards are `*`, `[…]` and, except in http(s) URLs, `?`.

    Raises:
        InputError: If no file matches, or a folder cannot be listed.
        UsageError: If fsspec is not installed.
    """
    system, path = _opened(place)
    web = place.lower().startswith(("http:", "https:"))
    # In a web address, "?" begins a query.
    if not re.search(r"[*\[]" if web else r"[*?\[]", path):
        return [place]
    with _failures_told(place):
        found = sorted(system.glob(path))
    if not found:
        raise InputError(f"'{place}' is not the URL of a file.")
    return [system.unstrip_protocol(one) for one in found]


def _opened(place: str) -> tuple[Any, str]:
    try:
        import fsspec
    except ImportError:
        raise UsageError(
            f"Fetching '{place}' needs an extra: pip install 'tftool-tf2[fleet]'"
        ) from None
    with _failures_told(place):
        system, path = fsspec.core.url_to_fs(place)
    return system, path


@contextmanager
def _failures_told(place: str) -> Iterator[None]:
    """Convert a remote service's exceptions in a `with` block to errors that name the URL."""
    try:
        yield
    except FileNotFoundError as error:
        raise InputError(f"There is no file at '{place}'.") from error
    except ImportError as error:
        # fsspec's error names the missing packages.
        raise UsageError(
            f"'{place}' needs a package that the extra 'fleet' does not contain: {error}"
        ) from error
    except Exception as error:
        said = " ".join(str(error).split()) or type(error).__name__
        raise InputError(f"'{place}' cannot be fetched: {said}") from error


METADATA = "metadata.yaml"
"""Name of the file with rosbag2's description of a recording."""

ACTIVE: Final = ".active"
"""Ending of a file's name while its recorder writes it, as in ROS 1."""

MOST_FILES = 10_000
"""Maximum number of files in a folder or glob."""

HEAD: Final = 4096
"""Number of bytes at the beginning of a file that decide its kind."""

_MOST_NAMES = 4
BESIDE = ("-wal", "-shm", "-journal")
"""Endings of the additional files that sqlite writes for a database."""
_MCAP_MANGLED = (b"\x89MCAP0\n", b"\x89MCAP0\r\r\n")
_OLD_BAG = b"#ROSRECORD"
_CONTROL = re.compile(rb"[\x00-\x08\x0e-\x1a\x1c-\x1f]")
"""Bytes that do not occur in text: control characters except white space and ESC."""
_LFS = b"version https://git-lfs"
_OTHERS = {
    b"\x1f\x8b": "a gzip archive: unpack it first (gunzip)",
    b"BZh": "a bzip2 archive: unpack it first (bunzip2)",
    b"\x04\x22\x4d\x18": "an lz4 archive: unpack it first (lz4 -d)",
    b"PK\x03\x04": "a zip archive: unpack it first (unzip)",
    b"\xfd7zXZ\x00": "an xz archive: unpack it first (unxz)",
    b"RRF2": "a recording of Rerun, which tftool cannot read",
    b"\x7fELF": "a program",
    b"%PDF": "a PDF",
    b"\x89PNG": "a picture",
}


class Kind(Enum):
    """Kind of a file or folder; the value is the kind's name in messages to the user."""

    SCENARIO = "scenario"
    DESCRIPTION = "robot description"
    STATICS = "file of static transforms"
    MCAP = "MCAP"
    SQLITE = "rosbag2 (sqlite3)"
    ROS1 = "ROS 1 bag"
    ZSTD = "compressed file"
    POSES = "pose file"
    ROSBAG2 = "rosbag2"
    SEVERAL = "several recordings"

    @property
    def is_recording(self) -> bool:
        """Whether `open_recording` can read a source of this kind."""
        return self not in (Kind.SCENARIO, Kind.DESCRIPTION, Kind.STATICS)

    @property
    def in_words(self) -> str:
        """Kind with an article, such as "an MCAP recording" or "a robot description"."""
        if self is Kind.SEVERAL:
            return "several recordings"
        article = "an" if self is Kind.MCAP else "a"
        is_recording = self.is_recording and self is not Kind.POSES
        return f"{article} {self.value}" + (" recording" if is_recording else "")


_CONTAINERS: Final = {Kind(one.words): one for one in CONTAINERS}
_RECORDINGS: Final = (*_CONTAINERS, Kind.ZSTD)


def container_in(path: Path, kind: Kind) -> ContainerFormat:
    """Return the file format of a recording, from the kind of the file.

    Raises:
        InputError: If files of that kind are not recordings.
    """
    found = _CONTAINERS.get(kind)
    if found is None:
        raise InputError(f"'{path}' is a {kind.value}, not a recording.")
    return found


@dataclass(frozen=True, slots=True)
class Found:
    """Result of a search: the kind and the files of a source.

    Attributes:
        name: Name of the source, as the user gave it.
        kind: Kind of the source. ROSBAG2 is a folder with rosbag2's metadata.
        paths: The file or folder; for SEVERAL, the files and folders of all recordings, sorted
            by name.
        passed_over: Files in the folder, or matches of the glob, that are not recordings.
    """

    name: str
    kind: Kind
    paths: tuple[Path, ...]
    passed_over: tuple[Path, ...] = ()

    def notices(self) -> list[str]:
        """Return sentences about skipped files, and about the format of pose files."""
        if self.kind is Kind.POSES:
            from tftool.recordings.poses.pose_formats import convention_of

            return [convention_of(self.name, self.paths[0])]
        if not self.passed_over:
            return []
        names = ", ".join(map(_said, self.passed_over[:_MOST_NAMES]))
        more = len(self.passed_over) - _MOST_NAMES
        beside = f" and {more} more" if more > 0 else ""
        return [f"Ignored, because these are not recordings: {names}{beside}."]


def _said(path: Path) -> str:
    with contextlib.suppress(OSError):
        if not path.stat().st_size:
            return f"'{path.name}' (empty)"
    return f"'{path.name}'"


def names_a_path(word: str) -> bool:
    """Whether a word names something in the file system: a file, a folder, or a matching glob."""
    try:
        return os.path.lexists(word) or bool(_globbed(word) or path_behind_prefix(word)[0])
    except ValueError:
        return False  # the word contains a zero character


def _meant(path: Path) -> str:
    """Return a hint if the same path exists in a subfolder, such as a workspace's src; else ""."""
    if path.is_absolute() or ".." in path.parts:
        return ""
    with contextlib.suppress(OSError):
        below = [os.path.join(one, path) for one in sorted(os.listdir())]
        # Skip folders that cannot be read.
        found = next((one for one in below if os.path.exists(one)), "")
        return f" Did you mean '{found}'?" if found else ""
    return ""


def find(word: str) -> Found:
    """Return the files that a path, a glob or NAME=FILE names, with their kind.

    Raises:
        InputError: If the file is missing, is of an unknown kind, or cannot be read.
    """
    if not word:  # The path "" would be the current folder.
        raise InputError("'' names no file or folder: write a path.")
    path = Path(word)
    try:
        prefix, behind = path_behind_prefix(word)
        if prefix and behind is not None:
            return _prefixed(word, behind)
        if not path.exists():
            matches = _globbed(word)
            if matches:
                return _several(word, matches)
            if path.is_symlink():
                raise InputError(f"'{word}' is a broken symbolic link to {os.readlink(path)}")
            if word.startswith(("ws://", "wss://")):
                raise InputError(
                    f"'{word}' is a robot's Foxglove server, but a file is needed: "
                    f"'tftool record -o run.mcap {word}' records a file."
                )
            if is_url(word):
                raise InputError(
                    f"'{word}' is a URL, which only 'tftool info' and 'tftool doctor' "
                    "read: save the recording to a file first."
                )
            active = Path(f"{word}{ACTIVE}")
            if active.exists():
                raise InputError(
                    f"There is no '{word}', only '{active}': a recorder still writes this file, or "
                    f"was killed. 'tftool edit {active} -o {word}' repairs the recording."
                )
            raise InputError(f"There is no file or folder '{word}'.{_meant(path)}")
        if path.is_dir():
            return _folder(word, path)
        if path.name == METADATA and _is_metadata(path):
            return Found(word, Kind.ROSBAG2, (path.parent,))
        return Found(word, _kind_with_options(word, path), (path,))
    except PermissionError as error:
        raise InputError(f"'{error.filename or word}' cannot be read: permission denied.") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"'{word}' cannot be read: {reason}") from error


def _kind_with_options(word: str, path: Path) -> Kind:
    """Return the kind of a file; refuse options of pose files for any other file.

    Raises:
        UsageError: If a file of another kind has options of pose files.
    """
    options = options_of(word)
    if options.pose_format is not None:
        return Kind.POSES
    kind = kind_of_file(path)
    if kind is not Kind.POSES:
        options.refuse(f"'{word}' is {kind.in_words}, not a pose file")
    return kind


def _prefixed(word: str, path: Path) -> Found:
    """Return the pose file that an argument of the form NAME=FILE names.

    Raises:
        InputError: If the file is not a pose file.
    """
    kind = _kind_with_options(word, path)
    if kind is not Kind.POSES:
        raise InputError(
            f"'{word}' is {kind.in_words}, but only pose files can have a prefix (NAME=FILE): "
            "leave out the prefix."
        )
    return Found(word, kind, (path,))


_DESCRIBING = {".urdf", ".xacro"}
_SCENARIO = re.compile(rb'^({\s*)?"?(about|duration|nodes|script|expect)"?\s*:', re.MULTILINE)
_WRITTEN = {*_DESCRIBING, ".yaml", ".yml", ".xml", ".py"}
"""Suffixes of files that people write by hand, so that they are never recordings."""


def kind_of_file(path: Path) -> Kind:
    """Return the kind of one file, by its first bytes.

    Raises:
        InputError: If the file is empty, or of an unknown kind.
        OSError: If the file cannot be read.
    """
    mode = path.stat().st_mode
    if not stat.S_ISREG(mode):
        what = "a pipe" if stat.S_ISFIFO(mode) else "a device"
        raise InputError(
            f"'{path}' is {what}, which cannot be searched: save the data to a file first."
        )
    with path.open("rb") as file:
        head = file.read(HEAD)
    if not head:
        nothing = "" if path.suffix in _WRITTEN else ": nothing was recorded"
        raise InputError(f"'{path}' is an empty file (0 bytes){nothing}.")
    for one in CONTAINERS:
        if head.startswith(one.magic):
            return Kind(one.words)
    if head.startswith(ZSTD_MAGIC):
        return Kind.ZSTD
    if head.startswith(_MCAP_MANGLED):
        raise InputError(
            f"'{path}' is an MCAP file whose line ends were converted (git without "
            "'*.mcap binary' in .gitattributes?) and cannot be restored: fetch the file again."
        )
    if head.startswith(_OLD_BAG):
        version = head[1:16].split(b"\n")[0].decode("ascii", "replace")
        raise InputError(
            f"'{path}' is a bag of an early version ({version}): 'rosbag fix' of ROS 1 "
            "converts the bag to version 2.0."
        )
    if head.startswith(_LFS):
        raise InputError(
            f"'{path}' is only git's pointer to a large file: 'git lfs pull' fetches the file."
        )
    if head.startswith((b"PK\x03\x04", b"PAR1")) and _are_poses(path, head):
        return Kind.POSES
    for magic, what in _OTHERS.items():
        if head.startswith(magic):
            raise InputError(f"'{path}' is {what}.")
    return _kind_of_text(path, head)


def _kind_of_text(path: Path, head: bytes) -> Kind:
    text = head
    if text.startswith((b"\xff\xfe", b"\xfe\xff")):
        text = head.decode("utf-16", "replace").encode()
    if _CONTROL.search(text):
        raise _nothing(path)
    start = text.removeprefix(b"\xef\xbb\xbf").lstrip()
    if path.suffix in _DESCRIBING:
        return Kind.DESCRIPTION
    if start.startswith(b"<"):
        root = re.search(rb"<([A-Za-z_][\w.:-]*)", start)
        return Kind.STATICS if root is not None and root[1] == b"launch" else Kind.DESCRIPTION
    is_launched = re.search(rb"^(launch\s*:|def generate_launch_description)", start, re.MULTILINE)
    is_scenario = _SCENARIO.search(start)
    is_script = b"static_transform_publisher" in start and not is_scenario
    if is_launched or is_script:
        return Kind.STATICS
    if not (is_scenario or _is_text(text)):
        raise _nothing(path)
    if not is_scenario and _are_poses(path, head):
        return Kind.POSES
    if not is_scenario and path.suffix in SUFFIXES:
        raise InputError(
            f"'{path}' is text, but its suffix is that of a recording: rename or replace it."
        )
    # The mistakes of a YAML file are listed when it is loaded as a scenario.
    if not is_scenario and path.suffix not in (".yaml", ".yml"):
        raise _nothing(path)
    return Kind.SCENARIO


def _are_poses(path: Path, head: bytes) -> bool:
    # Imported here because pose readers import packages that other files do not need.
    from tftool.recordings.poses.pose_formats import recognised

    return recognised(head, str(path)) is not None


def _is_text(head: bytes) -> bool:
    """Whether the first bytes of a file are UTF-8 text; the last character may be incomplete."""
    try:
        head.decode()
    except UnicodeDecodeError as error:
        return len(head) == HEAD and error.start >= HEAD - 3
    return True


def _nothing(path: Path) -> InputError:
    return InputError(
        f"'{path}' is neither a recording (MCAP, rosbag2, ROS 1 bag), nor a pose file, nor a robot "
        "description (URDF, xacro), nor a scenario (YAML)."
        + (f" 'tftool run {path}' runs a ROS node." if path.suffix == ".py" else "")
    )


def _is_metadata(path: Path) -> bool:
    with open_regular(path) as file:
        return b"rosbag2_bagfile_information" in file.read(HEAD)


def _folder(word: str, path: Path) -> Found:
    """Return the recording or recordings that a folder contains."""
    if (path / METADATA).exists():
        return Found(word, Kind.ROSBAG2, (path,))
    entries = sorted(path.iterdir())
    paths, kinds, others = _recordings(entries)
    if not paths:
        raise InputError(
            f"No recording (MCAP, rosbag2, ROS 1 bag) is in the folder '{word}', "
            f"which has {len(entries)} {'entry' if len(entries) == 1 else 'entries'}."
        )
    if len(paths) == 1:
        return Found(word, kinds.pop(), paths, others)
    # Files with a common stem are parts of one recording without metadata, else separate ones.
    stored = [kind for kind, one in _CONTAINERS.items() if one.storage]
    is_split = kinds in [{kind} for kind in stored] and len({_stem(one) for one in paths}) == 1
    if is_split:
        return Found(word, Kind.ROSBAG2, (path,), others)
    return Found(word, Kind.SEVERAL, paths, others)


def _several(word: str, matches: list[str]) -> Found:
    paths, kinds, others = _recordings([Path(match) for match in matches])
    if not paths:
        raise InputError(
            f"None of the {len(matches)} files that match '{word}' is a recording (MCAP, rosbag2, "
            "ROS 1 bag)."
        )
    return Found(word, kinds.pop() if len(paths) == 1 else Kind.SEVERAL, paths, others)


def _recordings(
    entries: list[Path],
) -> tuple[tuple[Path, ...], set[Kind], tuple[Path, ...]]:
    """Return the recordings among some paths, their kinds, and the other paths.

    Raises:
        PermissionError: If there is no recording, and permission to read some files is missing.
    """
    if len(entries) > MOST_FILES:
        raise InputError(
            f"{len(entries)} files are too many to open at once: name at most {MOST_FILES} files."
        )
    found, kinds, others = [], set(), []
    refused: PermissionError | None = None
    for entry in entries:
        kind = None
        is_folder = False
        try:
            is_folder = entry.is_dir()
            if not is_folder:
                kind = kind_of_file(entry)
            elif (entry / METADATA).exists():
                kind = Kind.ROSBAG2
        except PermissionError as error:
            # The entry may be a recording: opening the entry later will report the error.
            found.append(entry)
            refused = refused or error
            continue
        except (InputError, OSError):
            pass  # for example a broken link
        if kind is Kind.ROSBAG2 or kind in _RECORDINGS:
            found.append(entry)
            kinds.add(kind)
        elif not (is_folder or entry.name.startswith(".") or entry.name.endswith(BESIDE)):
            others.append(entry)
    if refused is not None and not kinds:
        raise refused
    return tuple(found), kinds, tuple(others)


def refusal(path: Path, error: OSError) -> InputError:
    """Convert an error from opening one of several files to an `InputError`.

    Raises:
        OSError: `error` itself, if too many files are open.
    """
    if error.errno in (errno.EMFILE, errno.ENFILE):
        raise error
    if isinstance(error, PermissionError):
        return InputError(f"'{path}' cannot be read: permission denied.")
    return InputError(f"'{path}' cannot be read: {error.strerror or error}.")


def _stem(path: Path) -> str:
    """Return a file name without suffix and without number at the end: "run_" of `run_0.mcap`."""
    return path.name.partition(".")[0].rstrip("0123456789")


def _globbed(word: str) -> list[str]:
    if not glob.has_magic(word):
        return []
    return sorted(glob.glob(word))
