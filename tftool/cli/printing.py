"""Results on stdout: as wide as the terminal, or a line each where there is none."""

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import RenderableType

LOG_WIDTH = 2000
"""How wide a line gets where there is no terminal to wrap it for."""


def write(what: "RenderableType", *, end: str = "\n") -> None:
    """Write a renderable to stdout, and `end` after it.

    In a log, which may be searched by line, what is one sentence stays in one.
    """
    from rich.console import Console

    console = Console()
    if not console.is_terminal:
        console.width = LOG_WIDTH
    # Written by us: rich ends the process with 1 when a reader (`| head`) is gone.
    with console.capture() as captured:
        console.print(what, end=end)
    for line in captured.get().splitlines():
        sys.stdout.write(f"{line.rstrip()}\n")
