"""A package's share directory, laid out as installed, without copying files."""

import os
import shutil
import tempfile
import weakref
from collections.abc import Mapping
from pathlib import Path, PurePosixPath


class ShareFolder:
    """A folder that shows a package's sources, and some files at other paths as well.

    Attributes:
        path: The folder; it goes when this object does.
    """

    def __init__(self, source: Path, installed: Mapping[str, Path]) -> None:
        """Lay it out.

        Args:
            source: The package's sources, shown as they lie.
            installed: Places below the folder, and the files that are found there.
        """
        self.path = Path(tempfile.mkdtemp(prefix="tftool-share-")).resolve()
        weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)
        parents = {str(one) for place in installed for one in PurePosixPath(place).parents}
        for parent in sorted(parents):
            self._show(source, parent, parents)
        for place, file in installed.items():
            target = self.path / place
            if not target.exists():
                _link(file, target)

    def _show(self, source: Path, below: str, parents: set[str]) -> None:
        """Link the files of one source folder, except generated folders."""
        (self.path / below).mkdir(parents=True, exist_ok=True)
        there = source / below
        for one in there.iterdir() if there.is_dir() else ():
            place = str(PurePosixPath(below, one.name))
            if not (one.name.startswith(".") or one.name == "__pycache__" or place in parents):
                _link(one, self.path / place)


def _link(file: Path, target: Path) -> None:
    try:
        os.symlink(file.resolve(), target, target_is_directory=file.is_dir())
    except OSError:
        # Windows asks for a privilege to make a link.
        if file.is_file():
            shutil.copy2(file, target)
