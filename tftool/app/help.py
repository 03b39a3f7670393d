"""The command `tftool help`, which prints what `--help` prints."""

from typing import Annotated

import typer

from tftool.app.main import main
from tftool.base.exit_status import ExitStatus
from tftool.commands.shared.declaration import declare


@declare(shares=False)
def help(
    name: Annotated[
        str | None, typer.Argument(metavar="[COMMAND]", help="What to explain.")
    ] = None,
) -> ExitStatus:
    """Show the list of commands, or the help of one (man).

    tftool help
    tftool help echo
    """
    return ExitStatus(main(["--help"] if name is None else [name, "--help"]))
