"""File or folder that is written under a temporary name, and renamed when complete.

When all bytes are on the disk, one rename gives the file or folder its final name. Until then a
recording that already has this name stays unchanged.
"""

import errno
import os
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import BinaryIO, Final

from tftool.base.errors import InputError, UsageError
from tftool.recordings.containers import SUFFIXES

PART: Final = ".part"
"""Suffix of a file's name while it is written."""


def refuse_stdout(path: Path) -> None:
    """Raise an error if the path is `-`, because writing to stdout is not supported.

    Raises:
        UsageError: If the file name is `-`.
    """
    if str(path) == "-":
        raise UsageError(
            "'-' means stdout, but this output can only be written to a file: name a file."
        )


def refuse_existing(path: Path, *, force: bool) -> None:
    """Raise an error if the path exists and `force` is false, or if the path is `-` (stdout).

    Raises:
        UsageError: In both cases; a broken symbolic link also counts as existing.
    """
    refuse_stdout(path)
    if not force and os.path.lexists(path):
        raise UsageError(f"'{path}' exists: add --force to replace it, or choose another name.")


def part_of(path: Path) -> Path:
    """Return the temporary path under which an output is written.

    Raises:
        UsageError: If the path has no name, such as `.` or `/`.
    """
    if not path.name:
        raise UsageError(f"'{path}' is not a name of a file.")
    return path.with_name(path.name + PART)


class Target:
    """A file or folder that is written completely or not at all; a context manager.

    Attributes:
        path: Final path of the file or folder.
        part: Path of the incomplete file or folder.
    """

    def __init__(self, path: Path, *, folder: bool = False, force: bool = False) -> None:
        """Create the temporary file or folder, after a check of existing files.

        Args:
            path: Final path of the file or folder.
            folder: Whether to write a folder.
            force: Whether existing files may be replaced.

        Raises:
            UsageError: If the path exists and `force` is not given.
            InputError: If the file cannot be written.
        """
        self.path = path
        self.part = part_of(path)
        self._folder = folder
        refuse_existing(path, force=force)
        if os.path.lexists(path):
            if path.exists() and not path.is_file() and not path.is_dir():
                raise UsageError(f"'{path}' is a device or a pipe: name a regular file.")
            if path.is_dir() and not _is_recording_folder(path):
                raise UsageError(
                    f"'{path}' is a folder that contains more than a recording. --force does not "
                    "replace such a folder: choose another name."
                )
        try:
            self._clear()
            if folder:
                self.part.mkdir()
            else:
                self.part.open("xb").close()
        except OSError as error:
            raise failed(path, error) from error

    def __enter__(self) -> "Target":
        return self

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        if kind is None:
            self.commit()
        else:
            self.discard()

    def commit(self) -> None:
        """Write everything to the disk, then give the file its final name.

        Raises:
            InputError: If the file cannot be completed. The incomplete file is removed.
        """
        try:
            files = [one for one in self.part.iterdir() if one.is_file()] if self._folder else []
            for one in [*files, self.part]:
                synced(one)
            if os.path.lexists(self.path):
                self._replace()
            else:
                self.part.rename(self.path)
            synced(self.path.parent)
        except OSError as error:
            self.discard()
            raise failed(self.path, error) from error

    def _replace(self) -> None:
        if not self._folder and not self.path.is_dir():
            self.part.replace(self.path)
            return
        # A folder cannot be replaced in one step: move the old folder aside first.
        old = Path(tempfile.mkdtemp(prefix=f".{self.path.name}.", dir=self.path.parent))
        self.path.rename(old / self.path.name)
        try:
            self.part.rename(self.path)
        except BaseException:
            (old / self.path.name).rename(self.path)
            old.rmdir()
            raise
        remove(old)

    def discard(self) -> None:
        """Remove the temporary file; an existing file with the final name stays."""
        with suppress(OSError):
            self._clear()

    def _clear(self) -> None:
        remove(self.part)


def commit_together(targets: Sequence[Target]) -> None:
    """Rename files that belong together to their final names: either all files or none.

    The last file refers to the other files. So an old version of the last file is moved away
    first, and the new version is renamed last. Even if the process is killed, the last file never
    refers to files of another version.

    Raises:
        InputError: If a file cannot be renamed; all names are then as before.
    """
    held: list[tuple[Path, Path]] = []
    done: list[Path] = []
    path = targets[-1].path
    try:
        for target in targets:
            synced(target.part)
        for target in reversed(targets):
            if os.path.lexists(target.path):
                folder = Path(tempfile.mkdtemp(prefix=f".{target.path.name}.", dir=path.parent))
                held.append((folder / target.path.name, target.path))
                target.path.rename(held[-1][0])
        for target in targets:
            path = target.path
            target.part.rename(path)
            done.append(path)
        synced(path.parent)
    except BaseException as error:
        for one in reversed(done):
            remove(one)
        for old, name in reversed(held):
            if os.path.lexists(old):
                old.rename(name)
            remove(old.parent)
        if isinstance(error, OSError):
            raise failed(path, error) from error
        raise
    for old, _ in held:
        remove(old.parent)


@contextmanager
def whole_file(path: Path, *, force: bool = False) -> Iterator[BinaryIO]:
    """Open a temporary file for writing, which is renamed to `path` at the end.

    After an error, the temporary file is removed.

    Raises:
        UsageError: If the path exists and `force` is not given.
        InputError: If the file cannot be written.
    """
    with Target(path, force=force) as target:
        try:
            with target.part.open("wb") as file:
                yield file
        except OSError as error:
            raise failed(path, error) from error


@contextmanager
def whole_files(*paths: Path, force: bool = False) -> Iterator[list[BinaryIO]]:
    """Open temporary files for writing, which are renamed to `paths` when all are complete.

    Args:
        paths: Final paths. The last path is that of the main file, which is renamed last.
        force: Whether existing files may be replaced.

    Raises:
        UsageError: If a path exists and `force` is not given.
        InputError: If a file cannot be written.
    """
    targets: list[Target] = []
    try:
        # Created one by one, so that all created before an error are discarded.
        targets.extend(Target(path, force=force) for path in paths)
        try:
            with ExitStack() as stack:
                yield [stack.enter_context(target.part.open("wb")) for target in targets]
        except OSError as error:
            raise failed(paths[-1], error) from error
        commit_together(targets)
    except BaseException:
        for target in targets:
            target.discard()
        raise


def remove(path: Path) -> None:
    """Remove a file or folder, if it exists."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


def synced(path: Path) -> None:
    """Flush a file or folder to the disk, if the file system can do so."""
    number = os.open(path, os.O_RDONLY)
    try:
        os.fsync(number)
    except OSError as error:
        # Some file systems do not sync folders, and devices cannot be synced.
        if error.errno not in (errno.EINVAL, errno.ENOTSUP):
            raise
    finally:
        os.close(number)


def failed(path: Path, error: OSError) -> InputError:
    """Return the error for a file that cannot be written, with the reason in a sentence."""
    if error.errno == errno.ENOSPC:
        return InputError(f"'{path}' cannot be written: the disk is full.")
    if error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
        return InputError(f"'{path}' cannot be written: {(error.strerror or str(error)).lower()}.")
    if error.errno == errno.ENOENT and not path.parent.exists():
        return InputError(f"'{path}' cannot be written: there is no folder '{path.parent}'.")
    return InputError(f"'{path}' cannot be written: {error.strerror or error}.")


def check_room(path: Path, size: int) -> None:
    """Raise an error if the disk has not enough free space for a file.

    Raises:
        InputError: If fewer than `size` bytes are free.
    """
    try:
        free = shutil.disk_usage(path.parent).free
    except OSError as error:
        raise failed(path, error) from error
    if free < size:
        raise InputError(
            f"'{path}' needs up to {_megabytes(size)}, but only {_megabytes(free)} are free on its "
            "disk: free space, or name a file on another disk."
        )


def _megabytes(size: int) -> str:
    return f"{size / 1e6:.1f} MB"


def _is_recording_folder(path: Path) -> bool:
    """Whether a folder contains only the files of a recording."""
    return all(
        one.is_file() and (one.name == "metadata.yaml" or one.suffix in SUFFIXES)
        for one in path.iterdir()
    )
