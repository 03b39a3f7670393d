"""Command `tftool check`: play scenarios on simulated time and judge their expectations."""

from pathlib import Path

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import Json, Junit, argument, flag, option


class CheckOptions(Command, shares=False):
    """Play scenarios on simulated time and judge what they expect.

    One line is printed for each, below it the failed expectations, and after "why:" the doctor's
    findings in the played frames. The exit status is 0 if everything held, 1 if something did not,
    3 if a file could not be read. With --run and --launch, nodes written for ROS 2 are tested in
    the scenario, without ROS. With --as-ros, packages are tested instead: entry points, launch
    files, dependencies.

    tftool check turtles
    tftool check scenarios/*.yaml --junit report.xml
    tftool check turtles --run follower=turtle_following.py
    tftool check turtles --launch "pkg_tf turtle_following.launch.py"
    tftool check --as-ros pkg_tf
    """

    scenarios: list[str] | None = argument(
        "Built-in scenarios by name, or scenario files: paths, globs, folders.",
        metavar="SCENARIO...",
    )
    programs: list[str] | None = option(
        "What follows 'tftool run': a program of yours in place of that node, or beside "
        "all of them.",
        "--run",
        metavar="[NODE=]WORDS",
    )
    launched: str | None = option(
        "What follows 'tftool launch': a launch file in place of all nodes.",
        "--launch",
        metavar="WORDS",
    )
    packages: list[str] | None = option(
        "A package of yours: list what ROS 2 would not find of it, once it is built.",
        "--as-ros",
        metavar="PACKAGE",
    )
    force: bool = flag("Run them also where a real ROS 2 is sourced.", "--ros-free")
    junit: Junit = None
    recordings: Path | None = option(
        "Keep a recording of each scenario in which something did not hold: NAME.mcap.",
        "--record",
        metavar="FOLDER",
    )
    strict: bool = flag("A scenario with a warning, as of two parents, fails.")
    verbose: bool = flag(
        "Show what held, every line of the nodes' logs, and which folders are skipped.",
        "--verbose",
        "-v",
    )
    for_programs: Json = False
