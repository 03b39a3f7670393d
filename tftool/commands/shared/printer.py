"""Output of results: to stdout, at the terminal's width or unwrapped, and to files."""

import json
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from tftool.base.named_files import reader_there
from tftool.recordings.target import failed, refuse_stdout, whole_file

if TYPE_CHECKING:
    from rich.console import RenderableType

LOG_WIDTH = 2000
"""Longest line in characters if stdout is not a terminal."""


def line_width() -> int | None:
    """Return the width of stdout in cells; None if stdout is not a terminal."""
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else None


def write(renderable: "RenderableType", *, end: str = "\n", is_wide: bool = True) -> None:
    """Print a renderable of rich to stdout, followed by `end`.

    Args:
        renderable: Renderable to print.
        end: Text after the renderable.
        is_wide: Whether lines may be up to `LOG_WIDTH` long if stdout is not a terminal, so that a
            log file has each sentence in one line.
    """
    from rich.console import Console

    console = Console()
    if is_wide and not console.is_terminal:
        console.width = LOG_WIDTH
    # Not written by rich, which ends the process with 1 if the pipe's reader (`| head`) ended.
    with console.capture() as captured:
        console.print(renderable, end=end)
    for line in captured.get().splitlines():
        sys.stdout.write(f"{line.rstrip()}\n")


def write_json(content: object, *, indent: int | None = 2) -> None:
    """Print a value as JSON; raise ValueError for NaN and infinity, which JSON does not have."""
    text = json.dumps(content, indent=indent, allow_nan=False, default=str)
    sys.stdout.write(f"{text}\n")


def write_file(path: Path, content: str | bytes) -> None:
    """Write bytes, or text as UTF-8, to a file.

    An existing file is replaced only when the new file is complete, so that a full disk loses no
    data. A pipe or device is written directly.

    Raises:
        InputError: If the file cannot be written.
        UsageError: If the path is `-`.
    """
    refuse_stdout(path)
    data = content if isinstance(content, bytes) else content.encode()
    # A symbolic link stays; its target is replaced.
    there = path.resolve() if path.is_symlink() else path
    try:
        if there.is_file() or not there.exists():
            with whole_file(there, force=True) as file:
                file.write(data)
            return
        with open(path, "wb", opener=reader_there) as file:
            file.write(data)
    except OSError as error:
        raise failed(path, error) from error
