"""Command `tftool play`: play a recording as a live session."""

from typing import Literal

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    Ascii,
    Light,
    RunFor,
    argument,
    flag,
    moment_option,
    option,
    within,
)
from tftool.frames.source_options import At
from tftool.world.link.link_options import REACHES

ROBOTS = " or ".join(flag for reach in REACHES if reach.is_robots for flag in reach.FLAGS)


class PlayOptions(Command, recordings=True):
    """Play a recording as a live session (ros2 bag play).

    The recorded transforms are broadcast in the order of reception, static transforms first, under
    the names of their nodes if these are recorded. /clock is published too, for other tftool
    commands, and for nodes with use_sim_time. 'tftool view', 'tftool echo' and your own nodes
    receive everything live.

    A terminal shows the timeline with the doctor's findings, the topics and the frames. Space
    pauses, the right arrow sends the next message, [ and ] seek by a second, { and } by ten
    seconds, up and down change the rate, n goes to the next finding, 0 to the start. At the end, r
    replays and q quits; --for ends the playback without a key.

    tftool play run.mcap
    tftool play run.mcap --from 12.5 --to 20 --rate 0.5 --loop
    tftool play run.bag --restamp now --all
    """

    file: str = argument(
        "Recording to play: a file, a folder or a glob.", default=..., metavar="RECORDING"
    )
    rate: float = option(
        "Speed of the playback: 2 is twice as fast as real time.",
        "--rate",
        "-r",
        default=1.0,
        metavar="TIMES",
        callback=within(0.01, 100),
    )
    begin: At | None = moment_option(
        "Where to begin: seconds since the start, or a stamp.", "--from"
    )
    until: At | None = moment_option("Where to end: seconds since the start, or a stamp.", "--to")
    loop: bool = flag("Start over at the end.")
    paused: bool = flag("Start paused; space continues.")
    restamp: Literal["now"] | None = option(
        "With 'now': give transforms the present time as stamps, and publish no /clock.",
        "--restamp",
        metavar="now",
    )
    everything: bool = flag(
        "Also publish all other topics whose type is known, with the recorded stamps.", "--all"
    )
    force: bool = flag(f"With {ROBOTS}: play even if /tf already has publishers.")
    run_for: RunFor = None
    ascii_only: Ascii = False
    light: Light = False
