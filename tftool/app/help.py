"""The command `tftool help`, which prints what `--help` prints."""

from tftool.app.main import main
from tftool.base.exit_status import ExitStatus
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import argument


class HelpOptions(Command, shares=False):
    """Show the list of commands, or the help of one (man).

    tftool help
    tftool help echo
    """

    name: str | None = argument("What to explain.", metavar="[COMMAND]")


def run(options: HelpOptions) -> ExitStatus:
    """Run `tftool help`."""
    return ExitStatus(main(["--help"] if options.name is None else [options.name, "--help"]))
