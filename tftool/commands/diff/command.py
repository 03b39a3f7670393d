"""`tftool diff`: what differs between two sets of frames."""

import json
import sys
from typing import Literal

from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import Duration, seconds
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.notices import notice
from tftool.commands.shared.printer import line_width
from tftool.commands.shared.robot_at_rest import RobotAtRest
from tftool.commands.shared.stored import session_frames, stored_frames
from tftool.drawing import difference_view as view
from tftool.frames.diff import joints_of
from tftool.frames.differences import Allowance, Side, compare

SESSION = "session"
"""The word that names the session that runs."""


def _side(connection: Connection, word: str, lasting: Duration | None) -> Side:
    """The frames that a word names, as one side.

    Raises:
        InputError: If it names nothing, or cannot be read.
        LinkError: If it is the session, and none runs.
    """
    if word == SESSION:
        heard = session_frames(connection, lasting or seconds(5))
        return Side(heard.name, heard.buffer, heard.start)
    found = stored_frames(connection, word, lasting, is_one_of_several=True)
    joints = joints_of(found.robot) if isinstance(found, RobotAtRest) else frozenset()
    return Side(found.name, found.buffer, found.start, joints)


def run(
    connection: Connection,
    first: str,
    second: str,
    millimetres: float,
    degrees: float,
    rate_percent: float | None,
    align: Literal["start"] | None,
    everything: bool,
    lasting: int | None,
    for_programs: bool,
    markdown: bool,
) -> ExitStatus:
    """Run `tftool diff`; the parameters are its options."""
    if for_programs and markdown:
        raise UsageError("--json and --markdown are two ways to print it: leave one out.")
    if first == second == SESSION:
        raise UsageError("The session that runs is one: name what it is compared with.")
    found = compare(
        _side(connection, first, lasting),
        _side(connection, second, lasting),
        Allowance(millimetres, degrees, rate_percent),
        align_starts=align == "start",
    )
    for note in found.notes:
        notice(visible(note))
    if for_programs:
        sys.stdout.write(json.dumps(view.as_object(found), indent=2, allow_nan=False) + "\n")
    elif markdown:
        sys.stdout.write(view.as_markdown(found))
    else:
        sys.stdout.write(view.lines(found, line_width(), everything=everything))
    return ExitStatus.FAILED if found else ExitStatus.DONE
