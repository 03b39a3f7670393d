"""Implementation of `tftool static`: publish one static transform."""

import inspect
import os
import sys

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import visible
from tftool.buffer.sample import TransformStamped
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_empty_session
from tftool.commands.shared.notices import notice
from tftool.commands.static import StaticOptions
from tftool.drawing.notation_view import static_lines
from tftool.geometry.notation.static_arguments import StaticArguments, advice, parse
from tftool.world.link.session_world import Session


def publish(connection: Connection, arguments: StaticArguments, *, spin: bool) -> None:
    """Publish a static transform and print it; with `spin`, publish until interrupted.

    Raises:
        UsageError: If buffers would reject the transform, or --read-only was given.
    """
    connection.refuse_read_only("publish")
    if arguments.parent == arguments.child:
        raise UsageError(
            f"cannot publish static transform from '{arguments.parent}' to '{arguments.child}': "
            "child_frame_id cannot equal frame_id."
        )
    session = open_empty_session(connection, follows=True)
    session.run(_published(session, arguments, spin))


async def _published(session: Session, said: StaticArguments, spin: bool) -> None:
    world = session.world
    name = f"static_transform_publisher_{os.getpid()}"
    sample = TransformStamped(world.clock.now(), said.parent, said.child, said.transform)
    world.broadcast([sample], name, static=True)
    if not world.static_transforms(name):
        raise UsageError(world.log.records[-1].text)
    for sentence in advice(said):
        notice(visible(sentence))
    if spin:
        sys.stdout.write("Spinning until stopped - publishing transform\n")
    sys.stdout.write(static_lines(said.parent, said.child, said.transform))
    sys.stdout.flush()
    if spin:
        await session.lasting(None)


def run(connection: Connection, options: StaticOptions) -> ExitStatus:
    """Run `tftool static`: parse the arguments and publish the transform."""
    given = vars(options)
    words = [
        word
        for name in inspect.get_annotations(StaticOptions)
        if name not in ("words", "once") and given[name] is not None
        for word in (f"--{name.replace('_', '-')}", given[name])
    ]
    said = parse([*(options.words or ()), *words])
    if said is None:  # pragma: no cover - help never comes this far
        return ExitStatus.DONE
    publish(connection, said, spin=not options.once)
    return ExitStatus.DONE
