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

    Everything that no option names stays unchanged, byte for byte. A damaged recording gets a new
    index, several recordings are joined, and the suffix of FILE selects the container. IN is never
    changed. FILE appears only when all of it was written, read again and compared.

    tftool edit run.mcap -o fixed.mcap --set base_link:laser=0.2,0,0.15,0,0,90deg
    tftool edit cut_off.mcap -o whole.mcap
    tftool edit a.bag b.bag -o both --from 10 --to 60
    """

    names: list[str] = argument(
        "Recordings: files, folders, globs. Several recordings are joined.",
        default=...,
        metavar="IN...",
    )
    output: Path = option(
        "File to write: .mcap, .db3 or .bag; a name without a suffix becomes a folder, as "
        "rosbag2 records it.",
        "--output",
        "-o",
        default=...,
        metavar="FILE",
        panel=OUTPUT,
    )
    drop: list[str] | None = option(
        "Leave a link out; * matches any name. Repeat the option for more links.",
        metavar="PARENT:CHILD",
        panel=LINKS,
    )
    poses: list[str] | None = option(
        "Set the transform of a link: x, y, z in metres, then roll, pitch, yaw in radians (90deg "
        "for degrees) or a quaternion x, y, z, w. Repeat the option for more links.",
        "--set",
        metavar="PARENT:CHILD=X,Y,Z,R,P,Y",
        panel=LINKS,
    )
    reparent: list[str] | None = option(
        "Give a child another parent; the child keeps its pose. Repeat the option for more links.",
        metavar="PARENT:CHILD=NEW",
        panel=LINKS,
    )
    statics_first: bool = flag(
        "Put the latest value of every static transform at the beginning; --from and --to always "
        "do so.",
        panel=LINKS,
    )
    statics_from: str | None = option(
        "Take the static transforms of another recording or of a robot description; they replace "
        "the recorded static transforms of the same frames.",
        metavar="OTHER",
        panel=LINKS,
    )
    rename: list[str] | None = option(
        "Rename a frame. Repeat the option for more frames.", metavar="OLD=NEW", panel=NAMES
    )
    prefix: list[str] | None = option(
        "Put this prefix before the name of every frame.", metavar="r1/", panel=NAMES
    )
    strip_slash: bool = flag(
        "Remove the leading slash from the names of frames: /base_link becomes base_link.",
        panel=NAMES,
    )
    everywhere: bool = flag(
        "Change names and stamps in all messages with a header, not only in tf.", panel=NAMES
    )
    start: At | None = moment_option(
        "Cut everything before this moment: seconds since the start, or a stamp.", "--from"
    )
    end: At | None = option(
        "Cut everything after this moment.", "--to", metavar="MOMENT", parser=moment, panel=WHEN
    )
    by_record_time: bool = flag(
        "Compare --from and --to with the times at which messages were received, not with the "
        "stamps of headers.",
        "--record-time",
        panel=WHEN,
    )
    shift: Duration = seconds_option(
        "Add SECONDS to the stamps of transforms that are not static.", default=0, check=finite
    )
    restamp: str | None = option(
        "With 'log': stamp transforms that are not static with the time at which they were "
        "received.",
        metavar="log",
        panel=WHEN,
    )
    split_every: Duration = seconds_option(
        "Write a folder of files, each SECONDS long; every file begins with all static transforms.",
        default=0,
        panel=OUTPUT,
    )
    ros2: bool = flag(
        "Convert messages of ROS 1 to those of ROS 2, also in an .mcap file.", panel=OUTPUT
    )
    force: Force = False
    dry_run: bool = flag("Print what would be changed, and write nothing.", panel=OUTPUT)
    for_programs: Json = False
