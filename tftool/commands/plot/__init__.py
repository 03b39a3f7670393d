"""Command `tftool plot`: a transform over time, in the terminal or as a picture."""

from pathlib import Path

from tftool.base.stamps import Duration
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    OUTPUT,
    Ascii,
    Every,
    Force,
    FromOption,
    Json,
    Light,
    Pairs,
    Rate,
    RunFor,
    StampsOf,
    ToOption,
    argument,
    flag,
    option,
    output_file,
    seconds_option,
)


class PlotOptions(Command, looks_only=True, recordings=True):
    """Plot where SOURCE is in TARGET over time, in the terminal or as a picture.

    The plot shows position, roll pitch yaw, distance, speed and turn rate. Spans in which lookups
    fail are shaded, with the reason. A running session is drawn live until q is pressed; + and -
    zoom, left and right move through time, a digit hides a curve, i shows one curve only. A
    recording or a scenario is drawn as a whole. Times are seconds since the start of FROM.

    tftool plot turtle2 turtle1
    tftool plot map base_link run.mcap --only x,y,yaw --from 5 --to 20
    tftool plot map base_link run.mcap --xy -o path.svg
    tftool plot run.mcap --pair map:base_link --pair map:laser -o both.pdf --dark
    """

    words: list[str] | None = argument(
        "A pair of frames, and the source of the frames. With --pair, only FROM is allowed.",
        metavar="[TARGET SOURCE] [FROM]",
    )
    pairs: Pairs = None
    output: Path | None = output_file("Write a picture: .svg, .pdf or .png.")
    only: list[str] | None = option(
        "Draw only the named quantities: position (x, y, z), rotation (roll, pitch, yaw), "
        "distance, speed, turn-rate, or single curves such as x.",
        metavar="WHAT,...",
    )
    from_above: bool = flag(
        "Draw the path seen from above, y over x, instead of curves over time.", "--xy"
    )
    first: FromOption = None
    last: ToOption = None
    every: Every = None
    rate: Rate = None
    stamps_of: StampsOf = None
    window: Duration | None = seconds_option("How far back a live plot reaches; 20 if not given.")
    lasting: RunFor = None
    ascii_only: Ascii = False
    light: Light = False
    dark: bool = flag("With -o: draw on a dark background.", panel=OUTPUT)
    force: Force = False
    as_json: Json = False
