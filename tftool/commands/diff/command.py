"""Compare two sets of frames, and print what differs."""

import json
import sys
from typing import Literal

from tftool.base.errors import LinkError
from tftool.base.escaping import visible
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import Duration
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.contradictions import refuse
from tftool.commands.shared.notices import notice
from tftool.commands.shared.open_from import WHOLE, listen_from, open_from
from tftool.commands.shared.printer import line_width
from tftool.drawing import difference_view as view
from tftool.frames.diff import side_of
from tftool.frames.differences import Allowance, Side, compare
from tftool.world.link.heard_frames import NOTHING_RUNS

SESSION = "session"
"""The word that names the session that runs."""


def run(
    connection: Connection,
    first: str,
    second: str,
    *,
    millimetres: float,
    degrees: float,
    rate_percent: float | None,
    align: Literal["start"] | None,
    everything: bool,
    lasting: Duration | None,
    for_programs: bool,
    markdown: bool,
) -> ExitStatus:
    """Run `tftool diff`; the parameters are its options."""
    refuse(
        (
            for_programs and markdown,
            "--json and --markdown are two ways to print it: leave one out.",
        ),
        (
            first == second == SESSION,
            "The session that runs is one: name what it is compared with.",
        ),
    )
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


def _side(connection: Connection, word: str, lasting: Duration | None) -> Side:
    """Open what a word names, as one side.

    Raises:
        InputError: If it names nothing, or cannot be read.
        LinkError: If it is the session, and none runs.
    """
    if word != SESSION:
        return side_of(open_from(connection, word, lasting, until=WHOLE, shares=True), word)
    frames = listen_from(connection, lasting)
    if frames is None:
        raise LinkError(NOTHING_RUNS)
    return side_of(frames, word)
