"""`tftool mcp`: answers agents' questions about the recordings of a folder."""

from pathlib import Path
from typing import Annotated

import typer

from tftool.commands.shared.declaration import declare


@declare(shares=False)
def mcp(
    root: Annotated[
        Path, typer.Argument(metavar="ROOT", help="Folder below which files may be asked about.")
    ],
) -> None:
    """Answer questions of an agent about recordings (MCP).

    It speaks over stdin and stdout. Tools: info, tree, echo, explain, doctor, plot, each about
    a file below ROOT. Nothing is written, no session is joined, no scenario played, no xacro
    expanded, no link followed that leads out of ROOT. Answers are the JSON of the command, cut
    to 4,000 characters.

    tftool mcp ~/bags
    """
