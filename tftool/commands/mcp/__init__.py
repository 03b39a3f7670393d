"""`tftool mcp`: answers agents' questions about the recordings of a folder."""

from pathlib import Path
from typing import Annotated

import typer

from tftool.commands.shared.declaration import Command


class McpOptions(Command, shares=False):
    """Answer questions of an agent about recordings (MCP).

    Communicates over stdin and stdout. Tools: info, tree, echo, explain, doctor, plot, each for a
    file below ROOT. Nothing is written, no session is joined, no scenario is played, no xacro is
    expanded, and no link out of ROOT is followed. Answers are the JSON of the command, cut to 4,000
    characters.

    tftool mcp ~/bags
    """

    root: Annotated[
        Path, typer.Argument(metavar="ROOT", help="Folder below which files may be asked about.")
    ]
