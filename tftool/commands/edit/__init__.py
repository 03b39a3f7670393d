"""`tftool edit`: change the frames of recordings; repair, join and cut."""

from pathlib import Path
from typing import Annotated

import typer

from tftool.base.stamps import Duration
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    OUTPUT,
    WHEN,
    Force,
    Json,
    finite,
    moment,
    moment_option,
    option,
    seconds_option,
)
from tftool.frames.moment import At

NAMES = "Names"
LINKS = "Links"
"""Headings of the help."""


class EditOptions(Command, shares=False, poses=True):
    """Change the frames of a recording; repair, join, cut, convert.

    Everything else stays unchanged, byte for byte. Without changes, a damaged recording gets an
    index, several recordings are joined, and the suffix of FILE chooses the container. IN is never
    written to; FILE gets its name only after it was completely written, read again and compared.

    tftool edit run.mcap -o fixed.mcap --set base_link:laser=0.2,0,0.15,0,0,90deg
    tftool edit cut_off.mcap -o whole.mcap
    tftool edit a.bag b.bag -o both --from 10 --to 60
    """

    names: Annotated[
        list[str],
        typer.Argument(
            metavar="IN...", help="Recordings: files, folders, globs. Several are joined."
        ),
    ]
    output: Annotated[
        Path,
        option(
            "What to write: .mcap, .db3 or .bag; a name without a suffix is a folder as "
            "rosbag2 records it.",
            "--output",
            "-o",
            metavar="FILE",
            panel=OUTPUT,
        ),
    ]
    drop: Annotated[
        list[str] | None,
        option(
            "Leave a link out; * stands for any name. Again for more.",
            metavar="PARENT:CHILD",
            panel=LINKS,
        ),
    ] = None
    poses: Annotated[
        list[str] | None,
        option(
            "Give a link these numbers: metres, and roll, pitch, yaw in radians (90deg for "
            "degrees) or the quaternion x, y, z, w. Again for more.",
            "--set",
            metavar="PARENT:CHILD=X,Y,Z,R,P,Y",
            panel=LINKS,
        ),
    ] = None
    reparent: Annotated[
        list[str] | None,
        option(
            "Hang a child from another parent; it stays where it is. Again for more.",
            metavar="PARENT:CHILD=NEW",
            panel=LINKS,
        ),
    ] = None
    statics_first: Annotated[
        bool,
        option(
            "Put the latest value of every static at the beginning; cuts always do.",
            "--statics-first",
            panel=LINKS,
        ),
    ] = False
    statics_from: Annotated[
        str | None,
        option(
            "Take the statics of another recording or a robot description, in place of "
            "those of the same frames.",
            metavar="OTHER",
            panel=LINKS,
        ),
    ] = None
    rename: Annotated[
        list[str] | None, option("Rename a frame. Again for more.", metavar="OLD=NEW", panel=NAMES)
    ] = None
    prefix: Annotated[
        str | None, option("Put r1/ before every frame.", metavar="r1/", panel=NAMES)
    ] = None
    strip_slash: Annotated[
        bool, option("Take the slash off /base_link and others.", "--strip-slash", panel=NAMES)
    ] = False
    everywhere: Annotated[
        bool,
        option(
            "Change names and stamps in all messages with a header, not in tf alone.",
            "--everywhere",
            panel=NAMES,
        ),
    ] = False
    start: Annotated[
        At | None,
        moment_option("Cut everything before: seconds since the start, or a stamp.", "--from"),
    ] = None
    end: Annotated[
        At | None,
        typer.Option(
            "--to", metavar="MOMENT", parser=moment, rich_help_panel=WHEN, help="Cut what follows."
        ),
    ] = None
    by_record_time: Annotated[
        bool,
        option(
            "--from and --to are times of reception, not stamps of headers.",
            "--record-time",
            panel=WHEN,
        ),
    ] = False
    shift: Annotated[
        Duration, seconds_option("Add this to the stamps of transforms that move.", check=finite)
    ] = 0
    restamp: Annotated[
        str | None,
        option(
            "Stamp transforms that move with the time they were received.",
            metavar="log",
            panel=WHEN,
        ),
    ] = None
    split_every: Annotated[
        Duration,
        seconds_option(
            "Write a folder of files that last so long, each with all statics at its head.",
            panel=OUTPUT,
        ),
    ] = 0
    ros2: Annotated[
        bool,
        option("Convert messages of ROS 1 to ROS 2's, in an .mcap too.", "--ros2", panel=OUTPUT),
    ] = False
    force: Force = False
    dry_run: Annotated[
        bool, option("Say what would be done, and write nothing.", "--dry-run", panel=OUTPUT)
    ] = False
    for_programs: Json = False
