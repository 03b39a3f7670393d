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
        "Run a program of yours in place of NODE, or beside all nodes of the scenario. WORDS are "
        "those after 'tftool run'.",
        "--run",
        metavar="[NODE=]WORDS",
    )
    launched: str | None = option(
        "Run a launch file in place of all nodes of the scenario. WORDS are those after 'tftool "
        "launch'.",
        "--launch",
        metavar="WORDS",
    )
    packages: list[str] | None = option(
        "List the parts of your package that ROS 2 would not find after building the package.",
        "--as-ros",
        metavar="PACKAGE",
    )
    force: bool = flag(
        "Run the programs without ROS even if a real ROS 2 is sourced.", "--ros-free"
    )
    junit: Junit = None
    recordings: Path | None = option(
        "Write a recording NAME.mcap of each scenario with an expectation that failed.",
        "--record",
        metavar="FOLDER",
    )
    strict: bool = flag(
        "Let a scenario fail that has a warning, such as the one about two parents."
    )
    verbose: bool = flag(
        "Also show the expectations that held, all logs of the nodes, and the folders that are "
        "skipped.",
        "--verbose",
        "-v",
    )
    for_programs: Json = False
