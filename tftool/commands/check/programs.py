"""Users' programs that replace nodes of a scenario while the scenario is judged."""

import re
import shlex
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tftool.base.errors import UsageError
from tftool.base.plain_text import visible_lines
from tftool.base.report import Judgement, Report
from tftool.commands.shared.notices import FoldedLog, notice
from tftool.ros.host.importing import ros_free
from tftool.ros.host.installation import InstalledPart, installed_parts
from tftool.ros.host.package_files import Package
from tftool.ros.host.workspace import Workspace, missing_package, use_workspace
from tftool.scenario.exercise import Entrant, Exercise
from tftool.scenario.scenario import Scenario, Verdict

_IN_PLACE = re.compile(r"([A-Za-z_]\w*)=(.*)", re.DOTALL)


@contextmanager
def judge_with(
    programs: Sequence[str], launched: str | None, *, force: bool, verbose: bool
) -> Iterator[Callable[..., Verdict]]:
    """Yield a function that judges a scenario in which the user's programs run.

    Args:
        programs: Values of --run: "FILE", or "NODE=FILE" to run the file in place of a node.
        launched: Value of --launch: a launch file and its arguments.
        force: Whether to run without ROS although a ROS environment is sourced.
        verbose: Whether to print every line of the programs' logs.

    Raises:
        UsageError: If a value is not a command line.
    """
    entrants = [_entrant(text) for text in programs]
    launch = () if launched is None else _words("--launch", launched)
    for one in entrants:
        if not one.node:
            notice(
                f"'{visible_lines(one.words[0])}' runs in addition to the scenario's own nodes; "
                "--run NODE=FILE runs it instead of NODE."
            )
    workspace = Workspace(Path.cwd())
    for skipped in workspace.skipped if verbose else ():
        notice(visible_lines(skipped))
    log = FoldedLog(prints_all=verbose)

    def judge(scenario: Scenario, **given: Any) -> Verdict:
        try:
            return exercise.judge(scenario, **given)
        finally:
            log.end()

    with ros_free(force=force, simulated=True):
        use_workspace(workspace)
        exercise = Exercise(workspace, entrants, launch, tell=log.tell)
        yield judge


def _entrant(text: str) -> Entrant:
    """Parse [NODE=]WORDS, a value of --run; return the program with the node that it replaces."""
    match = _IN_PLACE.fullmatch(text)
    node, rest = (match[1], match[2]) if match else ("", text)
    return Entrant(_words("--run", rest), node)


def _words(option: str, text: str) -> tuple[str, ...]:
    """Split an option's value into words as a shell does.

    Raises:
        UsageError: If there is no word, or a quote is not closed.
    """
    try:
        words = tuple(shlex.split(text))
    except ValueError as error:
        raise UsageError(f"{option} {text!r} has a quoting mistake: {str(error).lower()}") from None
    if not words:
        raise UsageError(f"{option} is empty: give the words that follow 'tftool {option[2:]}'")
    return words


def judge_packages(names: Sequence[str]) -> list[Report]:
    """Check ROS packages, each given by its name or folder; return one report for each.

    Raises:
        UsageError: If there is no such package.
        InputError: If a file of a package cannot be read.
    """
    workspace = Workspace(Path.cwd())
    return [_report(_package(workspace, name), workspace) for name in names]


def _package(workspace: Workspace, name: str) -> Package:
    found = workspace.packages.get(name)
    for package in () if found else workspace.packages.values():
        if package.path == Path(name).resolve():
            found = package
    if found is None:
        raise UsageError(missing_package(name, workspace))
    return found


def _report(package: Package, workspace: Workspace) -> Report:
    parts: dict[str, InstalledPart] = {}
    for part in installed_parts(package, workspace.packages):
        parts.setdefault(part.subject, part)
    judgements = [
        Judgement(part.subject, not part.fault, "found by ROS 2", part.fault or "declared")
        for part in parts.values()
    ]
    return Report(package.name, str(package.path), tuple(judgements))
