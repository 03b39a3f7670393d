"""Opening FROM on the command line, with a progress bar and notes on stderr."""

import math
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.base.stamps import Duration, as_seconds
from tftool.commands.shared.connection import HOME, Connection
from tftool.commands.shared.notices import notice
from tftool.frames.frames import Frames
from tftool.frames.moment import At
from tftool.opener import LISTEN_FOR, named, open_frames, refuse_options_of_files
from tftool.recordings.find import Kind

if TYPE_CHECKING:
    from tftool.commands.shared.progress_bars import Bar, ListeningBar, Look
    from tftool.world.world import World

NO_SESSION = "No session is running here"
A_MOMENT = "A chosen moment is always simulated"
"""Why a scenario that was not named is played."""

WHOLE = math.inf
"""All of a scenario."""

_MOST_NOTES = 8
_LONGEST_NAME = 24


def open_from(
    connection: Connection,
    place: str | None,
    lasting: Duration | None = None,
    *,
    until: At | float | None = None,
    margin: float = 1.0,
    cache_time: Duration | None = None,
    tells: bool = True,
    shares: bool = False,
    watch: "Callable[[World], object] | None" = None,
    look: "Look | None" = None,
) -> Frames:
    """Open the frames of FROM; they are closed together with the connection.

    Without FROM the running session is heard; if there is none, the turtle world is played. A
    running session keeps no past: a moment is refused.

    Args:
        connection: The command's options.
        place: FROM; None for the session that runs.
        lasting: Value of --for: how long to listen or to play.
        until: How far to play a scenario, where --for does not say; see `open_frames`.
        margin: Seconds to play on after that.
        cache_time: How far back the buffer of a scenario or a session remembers.
        tells: Whether to print oddities of the frames.
        shares: Whether the options of sharing are for another of several sources.
        watch: Called with the world of a scenario or a session before it lives.
        look: Returns lines to show below the progress bar about a session's frames so far.

    Raises:
        InputError: If FROM names nothing, or it cannot be read.
        LinkError: If a session was asked for and there is none.
        UsageError: If options do not fit the kind of FROM.
    """
    if lasting is not None:
        until, margin = as_seconds(lasting), 0.0
    if place is None and not isinstance(until, At):
        frames = listen_from(connection, lasting, cache_time=cache_time, watch=watch, look=look)
        if frames is not None:
            return frames
    if place is None and isinstance(until, At) and not connection.reach.only_reads:
        from tftool.commands.shared.hosting import refuse_moment

        refuse_moment(connection)
    if not shares:
        if lasting is not None and place is not None and named(place).kind is not Kind.SCENARIO:
            raise UsageError("--for is for live sources: for a recording use --to.")
        connection.refuse_to_share(place)
    if place is None:
        refuse_options_of_files(connection.robot, connection.recording, None)
        because = A_MOMENT if isinstance(until, At) else NO_SESSION
        notice(f"{because}: hosting scenario '{HOME}'.")
        place = HOME
    with _bar(place) as bar:
        frames = open_frames(
            place,
            **connection.file_options,
            until=until,
            margin=margin,
            cache_time=cache_time,
            watch=watch,
            progress=bar,
        )
    connection.keep(frames)
    _tell(frames, notes=tells)
    return frames


def listen_from(
    connection: Connection,
    lasting: Duration | None = None,
    *,
    cache_time: Duration | None = None,
    watch: "Callable[[World], object] | None" = None,
    look: "Look | None" = None,
) -> Frames | None:
    """Listen to the running session; return None if there is none. See `open_from`.

    Raises:
        LinkError: If a session was asked for and there is none.
    """
    if connection.hosts_alone:
        return None
    from tftool.commands.shared.hosting import join_session

    session = join_session(connection, cache_time=cache_time)
    if session is None:
        return None
    listen_for = LISTEN_FOR if lasting is None else as_seconds(lasting)
    with _listening_bar(listen_for, look) as glance:
        return open_frames(
            **connection.file_options,
            listen_for=listen_for,
            cache_time=cache_time,
            session=session,
            watch=watch,
            glance=glance,
        )


@contextmanager
def _listening_bar(listen_for: float, look: "Look | None") -> "Iterator[ListeningBar | None]":
    """Return a progress bar if a person waits, and print how long it takes if none does."""
    if not sys.stderr.isatty():
        notice(f"Listening for {listen_for:g} s ...")
        yield None
        return
    from tftool.commands.shared.progress_bars import ListeningBar

    with ListeningBar(listen_for, look) as bar:
        yield bar


@contextmanager
def _bar(place: str) -> "Iterator[Bar | None]":
    """Return a progress bar if a person waits."""
    if not sys.stderr.isatty():
        yield None
        return
    from tftool.commands.shared.progress_bars import Bar

    # The end of a path is what tells files apart, and all of it would not fit beside the bar.
    short = place.rstrip("/").rpartition("/")[2][-_LONGEST_NAME:]
    bar = Bar(f"Reading {visible(short)}")
    try:
        yield bar
    finally:
        bar.stop()


def _tell(frames: Frames, *, notes: bool) -> None:
    """Print the skipped files and notes about the frames."""
    for text in () if frames.found is None else frames.found.told():
        notice(visible(text))
    if notes:
        _tell_notes(frames)


def _tell_notes(frames: Frames) -> None:
    notes = frames.notes
    most = _MOST_NOTES if frames.recording is not None else len(notes)
    for text in notes[:most]:
        notice(visible(text))
    if len(notes) > most:
        notice(f"... and {len(notes) - most} more: 'tftool info {visible(frames.name)}'.")
