"""`tftool play`: a recording as a live session."""

from typing import Annotated, Literal

import typer

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import RunFor, moment_option, option, within
from tftool.frames.moment import At
from tftool.world.link.link_options import REACHES

ROBOTS = " or ".join(flag for reach in REACHES if reach.is_robots for flag in reach.FLAGS)


class PlayOptions(Command, recordings=True):
    """Play a recording as a live session (ros2 bag play).

    Its transforms are broadcast as they were received, statics first, under the names of their
    nodes if these are recorded. /clock is published too: other tftools use it, and nodes of ROS 2
    with use_sim_time. 'tftool view', 'tftool echo' and your own nodes receive everything live.

    On a terminal, space pauses, the right arrow sends the next message, [ and ] seek by a second, {
    and } by ten, up and down change the rate, n goes to the doctor's next finding, 0 to the start,
    q quits. Findings are marked on the line, and printed when they are passed.

    tftool play run.mcap
    tftool play run.mcap --from 12.5 --to 20 --rate 0.5 --loop
    tftool play run.bag --restamp now --all
    """

    file: Annotated[
        str, typer.Argument(metavar="RECORDING", help="What to play: a file, a folder, a glob.")
    ]
    rate: Annotated[
        float,
        typer.Option(
            "--rate",
            "-r",
            metavar="TIMES",
            callback=within(0.01, 100),
            help="How many times real time.",
        ),
    ] = 1.0
    begin: Annotated[
        At | None, moment_option("Where to begin: seconds since the start, or a stamp.", "--from")
    ] = None
    until: Annotated[At | None, moment_option("Where to end, likewise.", "--to")] = None
    loop: Annotated[bool, option("Start over at the end.", "--loop")] = False
    paused: Annotated[bool, option("Begin standing still.", "--paused")] = False
    restamp: Annotated[
        Literal["now"] | None,
        option(
            "Give transforms stamps of the present, and publish no /clock.",
            "--restamp",
            metavar="now",
        ),
    ] = None
    everything: Annotated[
        bool,
        option("Send every other topic too whose type is known, with its own stamps.", "--all"),
    ] = False
    force: Annotated[
        bool, option(f"Over {ROBOTS}: play beside publishers of /tf that are there.", "--force")
    ] = False
    run_for: RunFor = None
