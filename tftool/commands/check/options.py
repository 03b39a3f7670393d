"""`tftool check`: play scenarios on simulated time and judge their expectations."""

import re
import shlex
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.commands.shared.options import Json, Junit, option

if TYPE_CHECKING:
    from tftool.base.report import Report
    from tftool.scenario.exercise import Entrant
    from tftool.scenario.scenario import Scenario
    from tftool.scenario.verdict import Verdict

SUFFIXES = (".yaml", ".yml")
"""What scenario files in a folder end in."""

_IN_PLACE = re.compile(r"([A-Za-z_]\w*)=(.*)", re.DOTALL)


def check(
    scenarios: Annotated[
        list[str],
        typer.Argument(
            metavar="SCENARIO...",
            help="Built-in scenarios by name, or scenario files: paths, globs, folders.",
        ),
    ],
    programs: Annotated[
        list[str] | None,
        option(
            "What follows 'tftool run': a program of yours in place of that node, or beside "
            "all of them.",
            "--run",
            metavar="[NODE=]WORDS",
        ),
    ] = None,
    launched: Annotated[
        str | None,
        option(
            "What follows 'tftool launch': a launch file in place of all nodes.",
            "--launch",
            metavar="WORDS",
        ),
    ] = None,
    force: Annotated[
        bool, option("Run them also where a real ROS 2 is sourced.", "--ros-free")
    ] = False,
    junit: Junit = None,
    recordings: Annotated[
        Path | None,
        option(
            "Keep a recording of each scenario in which something did not hold: NAME.mcap.",
            "--record",
            metavar="FOLDER",
        ),
    ] = None,
    verbose: Annotated[
        bool,
        option(
            "Show what held, every line of the nodes' logs, and which folders are skipped.",
            "--verbose",
            "-v",
        ),
    ] = False,
    for_programs: Json = False,
) -> ExitStatus:
    """Play scenarios on simulated time and judge what they expect.

    One line for each, and below it whatever did not hold. The exit status is 0 when
    everything held, 1 when something did not, 3 when a file could not be read.
    With --run and --launch, nodes written for ROS 2 are judged in the scenario, without ROS.

    tftool check turtles
    tftool check scenarios/*.yaml --junit report.xml
    tftool check turtles --run follower=turtle_following.py
    tftool check turtles --launch "pkg_tf turtle_following.launch.py"
    """
    # Heavy imports wait until this command is the chosen one.
    import json
    from dataclasses import replace

    from rich.console import Console

    from tftool.commands.shared.printer import write, write_file
    from tftool.drawing import report_view as judgements

    kept = None if recordings is None else _Kept(recordings)
    with _judge_of(programs or (), launched, force=force, verbose=verbose) as judge:
        judged = [
            _judge(word, judge, kept, own_nodes=launched is None)
            for words in scenarios
            for word in _unfolded(words)
        ]
    reports = [report for report, _ in judged]
    if for_programs:
        sys.stdout.write(json.dumps(judgements.as_rows(reports), indent=2) + "\n")
    else:
        if Console().is_terminal and sys.stderr.isatty():
            # The terminal has the whole sentence already.
            reports = [
                report if readable else replace(report, failure="cannot be read")
                for report, readable in judged
            ]
        write(
            judgements.render_all(reports) if verbose else judgements.render(reports),
            is_wide=not verbose,
        )
        sys.stdout.write(f"{judgements.summary(reports)}\n")
    if junit is not None:
        write_file(junit, judgements.as_junit(reports))
    if not all(readable for _, readable in judged):
        return ExitStatus.UNREADABLE
    return ExitStatus.DONE if all(report.ok for report in reports) else ExitStatus.FAILED


def _unfolded(word: str) -> list[str]:
    """The files that a glob or a folder of scenarios stands for: not every shell unfolds globs."""
    import glob
    import os

    from tftool.recordings.find import METADATA
    from tftool.scenario import builtin

    files: list[str] = []
    if builtin.path_of(word) is None:
        if os.path.isdir(word):
            listed = sorted(os.listdir(word))
            if METADATA not in listed:
                files = [os.path.join(word, one) for one in listed if one.endswith(SUFFIXES)]
        elif not os.path.lexists(word):
            files = sorted(glob.glob(word))
    return files or [word]


@contextmanager
def _judge_of(
    programs: "Sequence[str]", launched: str | None, *, force: bool, verbose: bool
) -> "Iterator[Callable[..., Verdict]]":
    """Give what plays and judges a scenario: with its own nodes, or with the user's programs."""
    if not programs and launched is None:
        from tftool.scenario.play import run_scenario

        yield run_scenario
        return

    from tftool.base.escaping import visible_lines
    from tftool.commands.shared.notices import FoldedLog, notice
    from tftool.ros.host.importing import ros_free
    from tftool.ros.host.workspace import Workspace
    from tftool.ros.launch import packages
    from tftool.scenario.exercise import Exercise

    entrants = [_entrant(text) for text in programs]
    launch = () if launched is None else _words("--launch", launched)
    for one in entrants:
        if not one.node:
            notice(
                f"'{visible_lines(one.words[0])}' runs beside the scenario's own nodes; "
                "--run NODE=FILE runs it in the place of one."
            )
    workspace = Workspace(Path.cwd())
    for skipped in workspace.skipped if verbose else ():
        notice(visible_lines(skipped))
    log = FoldedLog(whole=verbose)

    def judge(scenario: "Scenario", **given: Any) -> "Verdict":
        try:
            return exercise.judge(scenario, **given)
        finally:
            log.end()

    with ros_free(force=force):
        packages.use(workspace)
        exercise = Exercise(workspace, entrants, launch, tell=log.tell)
        yield judge


def _entrant(text: str) -> "Entrant":
    """Read [NODE=]WORDS."""
    from tftool.scenario.exercise import Entrant

    match = _IN_PLACE.fullmatch(text)
    node, rest = (match[1], match[2]) if match else ("", text)
    return Entrant(_words("--run", rest), node)


def _words(option: str, text: str) -> tuple[str, ...]:
    """Split words as a shell does.

    Raises:
        UsageError: If there is none, or a quote is not closed.
    """
    try:
        words = tuple(shlex.split(text))
    except ValueError as error:
        raise UsageError(f"{option} {text!r}: {str(error).lower()}") from None
    if not words:
        raise UsageError(f"{option} wants what follows 'tftool {option[2:]}', not nothing")
    return words


def _judge(
    word: str, judge: "Callable[..., Verdict]", kept: "_Kept | None", *, own_nodes: bool
) -> "tuple[Report, bool]":
    """Report on one scenario, and whether it could be read; what could not is told at once."""
    from tftool.base.errors import InputError
    from tftool.base.escaping import visible_lines
    from tftool.base.report import Report
    from tftool.commands.shared.notices import complain, notice
    from tftool.opener import scenario_named

    try:
        scenario = scenario_named(word)
    except InputError as error:
        why = str(error)
        if Path(word).is_dir():  # in which recordings were looked for as well
            why = f"No scenario ({', '.join(SUFFIXES)}) is in the folder '{word}'."
        complain("tftool", why)
        return Report(Path(word).stem or word, word, (), failure=why), False
    for mistake in scenario.not_a_tree if own_nodes else ():
        notice(visible_lines(str(mistake)))
    if kept is None:
        return judge(scenario).report(), True
    return _recorded(scenario, judge, kept.place(scenario.name)).report(), True


class _Kept:
    """The folder in which recordings of one run are kept, each under a name of its own."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._names: set[str] = set()

    def place(self, name: str) -> Path:
        """Where a scenario's recording is kept: by its name, numbered where that is taken."""
        plain = free = re.sub(r"[^0-9A-Za-z_-]", "_", name)
        number = 1
        while free in self._names:
            number += 1
            free = f"{plain}_{number}"
        self._names.add(free)
        return self._folder / f"{free}.mcap"


def _recorded(scenario: "Scenario", judge: "Callable[..., Verdict]", kept: Path) -> "Verdict":
    """Judge a scenario; its recording stays if something did not hold."""
    from functools import partial

    from tftool.base.errors import InputError
    from tftool.base.escaping import visible
    from tftool.commands.shared.notices import notice
    from tftool.commands.shared.record_loop import recorded

    try:
        kept.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = error.strerror or error
        raise InputError(
            f"'{visible(str(kept.parent))}' cannot be written to: {reason}."
        ) from error
    # Beside its name until it is judged: one of an earlier run stays where nothing fails.
    played = kept.with_name(f".{kept.name}")
    verdict = judge(scenario, watch=partial(recorded, path=played, force=True))
    if verdict.ok:
        played.unlink(missing_ok=True)
    else:
        played.replace(kept)
        notice(f"Recorded: {visible(str(kept))}")
    return verdict
