"""Command `tftool view`: the frames in 3-D, in a browser."""

from pathlib import Path

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    CacheTime,
    Force,
    From,
    Meshes,
    RunFor,
    flag,
    option,
    output_file,
    within,
)


class ViewOptions(Command, looks_only=True, recordings=True, descriptions=True, urdf=True):
    """Show the frames in 3-D, in a browser (rviz2 with its TF display).

    The page is served on this machine only, and loads nothing from other sites. The page shows
    axes, names and arrows in any fixed frame, goes back in time through the buffer, and shows the
    transform of a chosen pair. A robot is drawn from its description, which may be FROM itself, in
    the recording, or on /robot_description. If FROM is a description, sliders move the joints. With
    -o, the page becomes one file that opens anywhere without tftool. The file contains a whole
    recording or scenario, or a session for the time of --for.

    tftool view --open
    tftool view robot --port 8800
    tftool view arm.urdf --meshes ~/ws/src --open
    tftool view run.mcap -o run.html
    """

    place: From = None
    port: int = option(
        "Port of the page; if another program uses this port, the next free port.",
        default=8765,
        metavar="PORT",
        min=0,
        max=65535,
    )
    open_browser: bool = flag("Open the page in your browser.", "--open")
    run_for: RunFor = None
    rate: float = option(
        "Updates of the page per second.",
        "--rate",
        "-r",
        default=30.0,
        metavar="HZ",
        callback=within(0.1, 120),
    )
    cache_time: CacheTime = None
    meshes: Meshes = None
    output: Path | None = output_file(
        "Write the page with all of its data into one .html file, and serve nothing."
    )
    force: Force = False
