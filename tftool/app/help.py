"""`tftool help`: the same as `--help`."""

from typing import Annotated

import typer

from tftool.app.main import main
from tftool.base.exit_status import ExitStatus


def help(
    command: Annotated[
        str | None, typer.Argument(metavar="[COMMAND]", help="What to explain.")
    ] = None,
) -> ExitStatus:
    """Show the list of commands, or the help of one (man).

    tftool help
    tftool help echo
    """
    return ExitStatus(main(["--help"] if command is None else [command, "--help"]))
