"""`tftool static`: publish one transform that holds for all time."""

import os
import sys
from typing import TYPE_CHECKING, Annotated

import typer

from tftool.base.exit_status import ExitStatus
from tftool.commands.shared.options import option

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Connection
    from tftool.geometry.notation.static_arguments import StaticArguments
    from tftool.world.link.session_world import Session

Metres = Annotated[str | None, typer.Option(metavar="METRES")]
Part = Annotated[str | None, typer.Option(metavar="NUMBER")]
Radians = Annotated[str | None, typer.Option(metavar="RADIANS")]


def static(
    connection: "Connection",
    words: Annotated[
        list[str] | None,
        typer.Argument(metavar="[X Y Z YAW PITCH ROLL PARENT CHILD]", show_default=False),
    ] = None,
    x: Metres = None,
    y: Metres = None,
    z: Metres = None,
    roll: Radians = None,
    pitch: Radians = None,
    yaw: Radians = None,
    qx: Part = None,
    qy: Part = None,
    qz: Part = None,
    qw: Part = None,
    frame_id: Annotated[
        str | None, option("Frame it is given in.", "--frame-id", metavar="PARENT")
    ] = None,
    child_frame_id: Annotated[
        str | None, option("Frame it places.", "--child-frame-id", metavar="CHILD")
    ] = None,
    once: Annotated[
        bool,
        option(
            "Publish, say what, and stop. Who is there keeps it; who comes later does "
            "not hear of it.",
            "--once",
        ),
    ] = False,
) -> ExitStatus:
    """Publish where CHILD is in PARENT (static_transform_publisher).

    It holds for all time. Runs until interrupted. Lengths are metres, angles radians.

    tftool static --z 3 --yaw 3.14 --frame-id A --child-frame-id B
    tftool static 0 0 3 0 0 3.14 A B          x y z yaw pitch roll: 3.14 is ROLL
    tftool static 0 0 3 0 0 0 1 A B           x y z qx qy qz qw
    """
    from tftool.geometry.notation.static_arguments import parse

    given = {
        "x": x, "y": y, "z": z, "roll": roll, "pitch": pitch, "yaw": yaw,
        "qx": qx, "qy": qy, "qz": qz, "qw": qw,
        "frame-id": frame_id, "child-frame-id": child_frame_id,
    }  # fmt: skip
    options = [
        word for name, value in given.items() if value is not None for word in (f"--{name}", value)
    ]
    said = parse([*(words or ()), *options])
    if said is None:  # pragma: no cover - help never comes this far
        return ExitStatus.DONE
    publish(connection, said, spin=not once)
    return ExitStatus.DONE


def publish(connection: "Connection", said: "StaticArguments", *, spin: bool) -> None:
    """Publish a static transform, say what it is, and hold on to it.

    Raises:
        UsageError: If no buffer would take it, or nothing is to be published.
    """
    from tftool.base.errors import UsageError
    from tftool.commands.shared.hosting import open_empty_session

    connection.refuse_read_only("publish")
    if said.parent == said.child:
        raise UsageError(
            f"cannot publish static transform from '{said.parent}' to '{said.child}': "
            "child_frame_id cannot equal frame_id."
        )
    session = open_empty_session(connection)
    session.run(_published(session, said, spin))


async def _published(session: "Session", said: "StaticArguments", spin: bool) -> None:
    from tftool.base.errors import UsageError
    from tftool.base.escaping import visible
    from tftool.buffer.sample import TransformStamped
    from tftool.commands.shared.notices import notice
    from tftool.drawing.pose_words import lines
    from tftool.geometry.notation.static_arguments import advice

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
    sys.stdout.write(lines(said.parent, said.child, said.transform))
    sys.stdout.flush()
    if spin:
        await session.lasting(None)
