"""Command `tftool demo`: a scenario on the screen; without a terminal, its outcome as text."""

from pathlib import Path

from tftool.base.stamps import Duration
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    Ascii,
    Json,
    Light,
    argument,
    flag,
    option,
    seconds_option,
    within,
)


class DemoOptions(Command, hosts_turtles=True, recordings=True):
    """Show turtle2 following turtle1 (ros2 launch turtle_tf2_py turtle_tf2_demo.launch.py).

    On a terminal, the screen shows a picture of the frames, their tree, and a pair of frames over
    time. The arrow keys drive turtle1, [ and ] move through time, F changes the fixed frame, o
    shows another scenario, q quits. After 5 s without a key, turtle1 drives by itself until a key
    is pressed or another terminal joins. Without a terminal, the command plays the scenario and
    the scenario's script on simulated time, prints the outcome, and exits with 1 if an expectation
    failed.

    tftool demo
    tftool demo carrot --source-frame carrot1
    tftool demo time_travel --rate 2 --set delay=3
    """

    scenario: str | None = argument(
        "Scenario to play (built-in name or file), or a recording to show. If not given: the "
        "running session, else the scenario turtles.",
        metavar="[FROM]",
    )
    source_frame: str | None = option(
        "Frame that turtle2 follows: turtle1, carrot1, ...", metavar="FRAME"
    )
    rate: float = option(
        "Speed of the demo: 2 is twice as fast as real time.",
        default=1.0,
        metavar="TIMES",
        callback=within(0.001, 1000),
    )
    lasting: Duration | None = seconds_option(
        "End after so many seconds of the world's time.", "--for", panel=None
    )
    settings: list[str] | None = option(
        "Set any argument of the scenario.", "--set", metavar="NAME=VALUE"
    )
    recording: Path | None = option(
        "Record the world of the demo to an .mcap file.", "--record", metavar="FILE"
    )
    still: bool = flag("Do not let turtle1 drive and draw by itself while no key is pressed.")
    listing: bool = flag("List the built-in scenarios, and end.", "--list")
    ascii_only: Ascii = False
    light: Light = False
    for_programs: Json = False
