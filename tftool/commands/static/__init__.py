"""Command `tftool static`: publish one static transform."""

from typing import Annotated

import typer

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import argument, flag, option

Metres = Annotated[str | None, typer.Option(metavar="METRES")]
Part = Annotated[str | None, typer.Option(metavar="NUMBER")]
Radians = Annotated[str | None, typer.Option(metavar="RADIANS")]


class StaticOptions(
    Command,
    # Coordinates may be negative: -1 is a number here, not an option.
    settings={"ignore_unknown_options": True},
):
    """Publish where CHILD is in PARENT (static_transform_publisher).

    The transform is valid at all times. The command runs until it is interrupted. Lengths are in
    metres, angles in radians.

    tftool static --z 3 --yaw 3.14 --frame-id A --child-frame-id B
    tftool static 0 0 3 0 0 3.14 A B          x y z yaw pitch roll: 3.14 is ROLL
    tftool static 0 0 3 0 0 0 1 A B           x y z qx qy qz qw
    """

    words: list[str] | None = argument("", metavar="[X Y Z YAW PITCH ROLL PARENT CHILD]")
    x: Metres = None
    y: Metres = None
    z: Metres = None
    roll: Radians = None
    pitch: Radians = None
    yaw: Radians = None
    qx: Part = None
    qy: Part = None
    qz: Part = None
    qw: Part = None
    frame_id: str | None = option(
        "Parent: frame in which the transform is given.", "--frame-id", metavar="PARENT"
    )
    child_frame_id: str | None = option(
        "Child: frame whose pose is given.", "--child-frame-id", metavar="CHILD"
    )
    once: bool = flag(
        "Publish the transform, print it, and stop. Programs that start later do not receive the "
        "transform."
    )
