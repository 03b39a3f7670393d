"""Command `tftool check`: play scenarios on simulated time and judge their expectations."""

from pathlib import Path

from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import Json, Junit, argument, flag, option


class CheckOptions(Command, shares=False):
    """Play scenarios on simulated time and check their expectations.

    The output has a line for each scenario, then the failed expectations, and after "why:" the
    doctor's findings in the played frames. The exit status is 0 if all expectations are met, 1
    if not, 3 if a file cannot be read. With --run and --launch, nodes written for ROS 2 are tested
    in the scenario, without ROS. With --as-ros, packages are checked instead of scenarios: entry
    points, launch files, dependencies.

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
        "Run your program in place of NODE, or in addition to all nodes of the scenario. WORDS are "
        "the words that follow 'tftool run'.",
        "--run",
        metavar="[NODE=]WORDS",
    )
    launched: str | None = option(
        "Run a launch file in place of all nodes of the scenario. WORDS are the words that follow "
        "'tftool launch'.",
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
        "Count a scenario with a warning, such as a frame with two parents, as failed."
    )
    verbose: bool = flag(
        "Also show the expectations that are met, all logs of the nodes, and the folders that are "
        "skipped.",
        "--verbose",
        "-v",
    )
    for_programs: Json = False
