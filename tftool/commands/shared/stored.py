"""Frames that are all there, whatever FROM names: for commands that read a span of time.

A recording or a description is opened; a scenario is played on simulated time, to its end;
a session that runs is listened to. What is heard is remembered without a limit, whatever
the cache time of the world it comes from.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from tftool.base.errors import LinkError, UsageError
from tftool.base.escaping import visible
from tftool.base.stamps import Duration, Stamp, as_seconds
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import NO_SESSION, join_session, open_session, refuse_to_share
from tftool.commands.shared.notices import tell_listening
from tftool.commands.shared.observe import LISTEN
from tftool.commands.shared.options import LISTENING
from tftool.commands.shared.robot_at_rest import StoredFrames
from tftool.frames.moment import At
from tftool.opener import named
from tftool.recordings.find import Kind
from tftool.world.link.session_world import Session

if TYPE_CHECKING:
    from collections.abc import Callable

    from tftool.buffer.buffer import Buffer
    from tftool.world.world import TransformMessage, World


@dataclass(frozen=True, slots=True)
class HeardFrames:
    """What a world broadcast while it was listened to; see `files.StoredFrames`."""

    name: str
    start: Stamp
    end: Stamp
    buffer: "Buffer"

    def close(self) -> None:
        """Nothing is left open."""


def stored_frames(
    connection: Connection,
    word: str | None,
    lasting: Duration | None = None,
    *,
    listen: Duration = LISTENING,
    is_one_of_several: bool = False,
    beside: "Callable[[World], object] | None" = None,
) -> StoredFrames:
    """All frames that FROM names, over the whole of its time.

    Args:
        connection: What the command's options say.
        word: What FROM names; None for the session that runs, else the turtle world.
        lasting: How long a scenario is played or a session listened to, nanoseconds.
        listen: How long a session is listened to where `lasting` is None.
        is_one_of_several: Whether `lasting` may be meant for another of several sources.
        beside: Is handed a world that is listened to before it lives, to hear more of it.

    Raises:
        InputError: If the word names nothing, or it cannot be read.
        LinkError: If a session was asked for and there is none.
        UsageError: If --for is given where nothing is waited for.
    """
    found = None if word is None else named(word)
    if found is not None and found.kind is not Kind.SCENARIO:
        if lasting is not None and not is_one_of_several:
            raise UsageError("--for is for what goes on; of a recording, --to leaves out the rest.")
        if not is_one_of_several:
            refuse_to_share(connection, word)
        return connection.open_stored(found)
    session = join_session(connection) if word is None else None
    if session is not None:
        return _listened(session, lasting or listen, beside)
    session = open_session(connection, word, simulated=True, because=NO_SESSION)
    return _heard(session, lasting or session.duration or LISTEN, beside)


def session_frames(connection: Connection, lasting: Duration) -> HeardFrames:
    """What the session that runs broadcasts.

    Raises:
        LinkError: If none runs.
    """
    session = join_session(connection)
    if session is None:
        raise LinkError("No session is running here: start one with 'tftool demo'.")
    return _listened(session, lasting)


def _listened(
    session: Session, lasting: Duration, beside: "Callable[[World], object] | None" = None
) -> HeardFrames:
    tell_listening(lasting)
    return _heard(session, lasting, beside)


def _heard(
    session: Session, lasting: Duration, beside: "Callable[[World], object] | None" = None
) -> HeardFrames:
    from tftool.buffer.buffer import NO_LIMIT, Buffer

    world = session.world
    if beside is not None:
        beside(world)
    buffer = Buffer(NO_LIMIT, max_frames=world.buffer.max_frames)

    def hear(message: "TransformMessage", *, is_static: bool) -> None:
        set_transform = buffer.set_transform_static if is_static else buffer.set_transform
        for one in message.transforms:
            set_transform(one, message.authority)

    began = world.clock.epoch if session.is_hosted else world.clock.now()
    stops = [
        world.tf.subscribe(lambda message: hear(message, is_static=False)),
        world.tf_static.subscribe(lambda message: hear(message, is_static=True)),
    ]
    try:
        session.run(session.lasting(lasting))
    finally:
        for stop in stops:
            stop()
    return HeardFrames(session.name, began, world.clock.now(), buffer)


def span(
    stored: StoredFrames, first: At | None, last: At | None
) -> tuple[Stamp | None, Stamp | None]:
    """The stamps of --from and --to in what was read.

    Raises:
        UsageError: If the one lies behind the other, or nothing lies between the two.
    """
    start = None if first is None else first.stamp(stored.start)
    end = None if last is None else last.stamp(stored.start)
    if start is not None and end is not None and start > end:
        raise UsageError(f"--from {first} lies behind --to {last}.")
    if start is not None and start > stored.end:
        lasts = as_seconds(stored.end - stored.start)
        raise UsageError(
            f"{visible(stored.name)} lasts {lasts:g} s: --from {first} is after its end."
        )
    if end is not None and end < stored.start:
        begins = At(stored.start, is_stamp=True)
        raise UsageError(f"{visible(stored.name)} begins at {begins}: --to {last} is before that.")
    return start, end
