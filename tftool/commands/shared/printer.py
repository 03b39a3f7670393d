"""Results on stdout, as wide as the terminal or a line each where there is none; and in files."""

import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from tftool.base.errors import InputError
from tftool.base.named_files import reader_there

if TYPE_CHECKING:
    from rich.console import RenderableType

LOG_WIDTH = 2000
"""How wide a line gets where there is no terminal to wrap it for."""


def line_width() -> int | None:
    """Cells a line on stdout may take; None where no terminal shows it."""
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else None


def write(what: "RenderableType", *, end: str = "\n", is_wide: bool = True) -> None:
    """Write a renderable to stdout, and `end` after it.

    Args:
        what: What is written.
        end: What comes after it.
        is_wide: Whether lines are up to `LOG_WIDTH` long where there is no terminal: in a log,
            which may be searched by line, what is one sentence stays in one.
    """
    from rich.console import Console

    console = Console()
    if is_wide and not console.is_terminal:
        console.width = LOG_WIDTH
    # Written by us: rich ends the process with 1 when a reader (`| head`) is gone.
    with console.capture() as captured:
        console.print(what, end=end)
    for line in captured.get().splitlines():
        sys.stdout.write(f"{line.rstrip()}\n")


def write_file(path: Path, content: str | bytes) -> None:
    """Write a file as a whole, a text in UTF-8.

    Raises:
        InputError: If that fails.
        UsageError: If the name is `-`.
    """
    from tftool.recordings.target import refuse_stdout

    refuse_stdout(path)
    try:
        with open(path, "wb", opener=reader_there) as file:
            file.write(content if isinstance(content, bytes) else content.encode())
    except OSError as error:
        raise InputError(f"'{path}' cannot be written: {error.strerror or error}.") from error
