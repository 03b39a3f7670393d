"""Command `tftool info`: contents of a recording or robot description."""

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import Jobs, Json, Resume, Rows, Scheduler, argument


class InfoOptions(Command, recordings=True, descriptions=True, urdf=True):
    """Show what a recording or robot description contains (ros2 bag info).

    For a recording: topics with types, counts and publishers; frames and trees; every edge (a frame
    and its parent) with its rate, its publisher (the node in ROS 1 bags, else the topic), and its
    delay from stamp to reception; damage, unusual facts, and the doctor's findings. For a robot
    description: joints with limits and mimics, the root, masses if given. For several descriptions
    and launch files: the number of transforms of each, and every mistake. The exit status is 3 if a
    description or launch file has a mistake, even one with which other commands read the file. For
    several recordings: a line each; with -o, a row each in a file. On a narrow terminal columns are
    left out: 'tftool info run.mcap | cat' prints them all.

    tftool info run.mcap
    tftool info robot.urdf
    tftool info 'runs/**/*.mcap' -j 8 -o runs.csv
    """

    places: list[str] = argument(
        "A recording (file, folder, glob), a robot description, or a launch file or "
        "script of static transforms.",
        default=...,
        metavar="FROM...",
    )
    for_programs: Json = False
    output: Rows = None
    processes: Jobs = 1
    resume: Resume = False
    scheduler: Scheduler = ""
