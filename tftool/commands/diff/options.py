"""`tftool diff`: what differs between two sets of frames."""

import json
import sys
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import Duration, seconds
from tftool.commands.shared.options import OUTPUT, Json, RunFor, not_negative, option

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Connection
    from tftool.frames.differences import Side

SESSION = "session"
"""The word that names the session that runs."""


def diff(
    connection: "Connection",
    first: Annotated[
        str,
        typer.Argument(
            metavar="A",
            help="A recording, a robot description, a scenario, a launch file or script of static "
            "transforms, or the word 'session' for the one that runs.",
        ),
    ],
    second: Annotated[str, typer.Argument(metavar="B", help="What it is compared with.")],
    millimetres: Annotated[
        float,
        typer.Option(
            "--mm", metavar="MM", callback=not_negative, help="How far a frame may lie elsewhere."
        ),
    ] = 1.0,
    degrees: Annotated[
        float,
        typer.Option(
            "--deg", metavar="DEGREES", callback=not_negative, help="How far it may be turned."
        ),
    ] = 0.1,
    rate_percent: Annotated[
        float | None,
        typer.Option(
            metavar="PERCENT",
            callback=not_negative,
            help="How much a rate may differ; rates do not count if not said.",
        ),
    ] = None,
    align: Annotated[
        Literal["start"] | None,
        option("Compare what moves from each one's own start, not by stamps.", metavar="start"),
    ] = None,
    everything: Annotated[
        bool, option("List links that do not differ, too.", "--all", panel=OUTPUT)
    ] = False,
    lasting: RunFor = None,
    for_programs: Json = False,
    markdown: Annotated[
        bool, option("Print it for an issue on the web.", "--markdown", panel=OUTPUT)
    ] = False,
) -> ExitStatus:
    """Say what differs between two sets of frames, link by link.

    Links that came, went, hang from another frame, or are static in one and move in the
    other; statics in millimetres and degrees; what moves at the stamps both have: root mean
    square, worst, and when. Exit status 1 when anything differs by more than 1 mm or 0.1°,
    or by --mm, --deg, --rate-percent.

    tftool diff monday.mcap robot.urdf
    tftool diff calibrated.launch.py session --mm 0.5
    tftool diff run1.mcap run2.mcap --align start --json
    """
    from tftool.base.escaping import visible
    from tftool.commands.shared.notices import notice
    from tftool.commands.shared.printer import line_width
    from tftool.drawing import difference_view as view
    from tftool.frames.differences import Allowance, compare

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


def _side(connection: "Connection", word: str, lasting: Duration | None) -> "Side":
    """The frames that a word names, as one side.

    Raises:
        InputError: If it names nothing, or cannot be read.
        LinkError: If it is the session, and none runs.
    """
    from tftool.commands.shared.robot_at_rest import RobotAtRest
    from tftool.commands.shared.stored import session_frames, stored_frames
    from tftool.frames.diff import joints_of
    from tftool.frames.differences import Side

    if word == SESSION:
        heard = session_frames(connection, lasting or seconds(5))
        return Side(heard.name, heard.buffer, heard.start)
    found = stored_frames(connection, word, lasting, is_one_of_several=True)
    joints = joints_of(found.robot) if isinstance(found, RobotAtRest) else frozenset()
    return Side(found.name, found.buffer, found.start, joints)
