"""Command `tftool tree`: the tree of frames as text, data or a picture."""

from enum import StrEnum
from pathlib import Path

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    OUTPUT,
    Ascii,
    AtOption,
    CacheTime,
    Force,
    From,
    Json,
    Light,
    RunFor,
    flag,
    option,
    output_file,
)


class TreeFormat(StrEnum):
    """Output format of a tree."""

    tree = "tree"
    json = "json"
    yaml = "yaml"
    dot = "dot"
    mermaid = "mermaid"
    svg = "svg"
    html = "html"
    pdf = "pdf"
    png = "png"


class TreeOptions(Command, looks_only=True, recordings=True, descriptions=True, urdf=True):
    """Show the tree of frames (rqt_tf_tree, view_frames).

    If there are several trees, all are shown. For the transform from each frame to its parent, the
    output has: whether the transform is static, broadcaster, rate, length of the history in the
    buffer, age of the newest data. A frame that changes between two parents, has stopped, or has
    another clock than other frames is marked with the id of the doctor's check. A scenario is shown
    5 s after its start, a recording at its end, unless --at is given.

    tftool tree                   the tree of what runs here
    tftool tree robot -o robot.svg --at 12.5
    tftool tree --watch
    """

    place: From = None
    form: TreeFormat | None = option(
        f"Format to write: {', '.join(TreeFormat)}; if not given, the suffix of -o decides.",
        "--format",
        "-f",
        metavar="FORMAT",
        panel=OUTPUT,
    )
    output: Path | None = output_file("File to write; - is stdout.")
    force: Force = False
    as_json: Json = False
    wide: bool = flag(
        "Print all columns and full names on a terminal too, even if lines are longer than its "
        "width.",
        panel=OUTPUT,
    )
    at: AtOption = None
    watch: bool = flag("Show the tree live; keys scroll, sort and filter.", "--watch", "-w")
    run_for: RunFor = None
    ascii_only: Ascii = False
    light: Light = False
    cache_time: CacheTime = None
