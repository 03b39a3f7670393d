"""Command `tftool edit`: change the frames of recordings; repair, join and cut them."""

from pathlib import Path

from tftool.base.stamps import Duration
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    OUTPUT,
    WHEN,
    Force,
    Json,
    argument,
    finite,
    flag,
    moment,
    moment_option,
    option,
    seconds_option,
)
from tftool.frames.source_options import At

NAMES = "Names"
LINKS = "Links"
"""Headings in the help above groups of options."""


class EditOptions(Command, shares=False, poses=True):
    """Change the frames of a recording; repair, join, cut, convert.

    Everything else stays unchanged, byte for byte. Without changes, a damaged recording gets an
    index, several recordings are joined, and the suffix of FILE chooses the container. IN is never
    written to; FILE gets its name only after it was completely written, read again and compared.

    tftool edit run.mcap -o fixed.mcap --set base_link:laser=0.2,0,0.15,0,0,90deg
    tftool edit cut_off.mcap -o whole.mcap
    tftool edit a.bag b.bag -o both --from 10 --to 60
    """

    names: list[str] = argument(
        "Recordings: files, folders, globs. Several are joined.", default=..., metavar="IN..."
    )
    output: Path = option(
        "What to write: .mcap, .db3 or .bag; a name without a suffix is a folder as "
        "rosbag2 records it.",
        "--output",
        "-o",
        default=...,
        metavar="FILE",
        panel=OUTPUT,
    )
    drop: list[str] | None = option(
        "Leave a link out; * stands for any name. Again for more.",
        metavar="PARENT:CHILD",
        panel=LINKS,
    )
    poses: list[str] | None = option(
        "Give a link these numbers: metres, and roll, pitch, yaw in radians (90deg for "
        "degrees) or the quaternion x, y, z, w. Again for more.",
        "--set",
        metavar="PARENT:CHILD=X,Y,Z,R,P,Y",
        panel=LINKS,
    )
    reparent: list[str] | None = option(
        "Hang a child from another parent; it stays where it is. Again for more.",
        metavar="PARENT:CHILD=NEW",
        panel=LINKS,
    )
    statics_first: bool = flag(
        "Put the latest value of every static at the beginning; cuts always do.", panel=LINKS
    )
    statics_from: str | None = option(
        "Take the statics of another recording or a robot description, in place of "
        "those of the same frames.",
        metavar="OTHER",
        panel=LINKS,
    )
    rename: list[str] | None = option(
        "Rename a frame. Again for more.", metavar="OLD=NEW", panel=NAMES
    )
    prefix: str | None = option("Put r1/ before every frame.", metavar="r1/", panel=NAMES)
    strip_slash: bool = flag("Take the slash off /base_link and others.", panel=NAMES)
    everywhere: bool = flag(
        "Change names and stamps in all messages with a header, not in tf alone.", panel=NAMES
    )
    start: At | None = moment_option(
        "Cut everything before: seconds since the start, or a stamp.", "--from"
    )
    end: At | None = option(
        "Cut what follows.", "--to", metavar="MOMENT", parser=moment, panel=WHEN
    )
    by_record_time: bool = flag(
        "--from and --to are times of reception, not stamps of headers.",
        "--record-time",
        panel=WHEN,
    )
    shift: Duration = seconds_option(
        "Add this to the stamps of transforms that move.", default=0, check=finite
    )
    restamp: str | None = option(
        "Stamp transforms that move with the time they were received.", metavar="log", panel=WHEN
    )
    split_every: Duration = seconds_option(
        "Write a folder of files that last so long, each with all statics at its head.",
        default=0,
        panel=OUTPUT,
    )
    ros2: bool = flag("Convert messages of ROS 1 to ROS 2's, in an .mcap too.", panel=OUTPUT)
    force: Force = False
    dry_run: bool = flag("Say what would be done, and write nothing.", panel=OUTPUT)
    for_programs: Json = False
