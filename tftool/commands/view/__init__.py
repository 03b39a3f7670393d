"""`tftool view`: the frames in 3-D, in a browser."""

from pathlib import Path
from typing import Annotated

import typer

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    CacheTime,
    Force,
    From,
    Meshes,
    RunFor,
    option,
    output_file,
    within,
)


class ViewOptions(Command, looks_only=True, recordings=True, descriptions=True, urdf=True):
    """Show the frames in 3-D, in a browser (rviz2 with its TF display).

    The page is served on this machine only, and loads nothing from others. It shows axes, names and
    arrows in any fixed frame, goes back in time through the buffer, and shows the transform of a
    chosen pair. A robot is drawn from its description: FROM itself, the recorded one, or the one on
    /robot_description; sliders move the joints of FROM. With -o the page becomes one file that
    opens anywhere, without tftool: a recording or a scenario as a whole, a session for the time of
    --for.

    tftool view --open
    tftool view robot --port 8800
    tftool view arm.urdf --meshes ~/ws/src --open
    tftool view run.mcap -o run.html
    """

    place: From = None
    port: Annotated[
        int,
        typer.Option(
            metavar="PORT",
            min=0,
            max=65535,
            help="Where to serve the page; the next free one if it is taken.",
        ),
    ] = 8765
    open_browser: Annotated[bool, option("Open the page in your browser.", "--open")] = False
    run_for: RunFor = None
    rate: Annotated[
        float,
        typer.Option(
            "--rate", "-r", metavar="HZ", callback=within(0.1, 120), help="Pictures a second."
        ),
    ] = 30.0
    cache_time: CacheTime = None
    meshes: Meshes = None
    output: Annotated[
        Path | None,
        output_file("Write the page with all of its data into one .html file, and serve nothing."),
    ] = None
    force: Force = False
