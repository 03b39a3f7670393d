"""`tftool check`: play scenarios on simulated time and judge their expectations."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from tftool.messages import Report

LOG_WIDTH = 2000
"""How wide a line gets where there is no terminal to wrap it for."""


def check(
    scenarios: Annotated[
        list[str],
        typer.Argument(
            metavar="SCENARIO...", help="Built-in scenarios by name, or paths of scenario files."
        ),
    ],
    junit: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Write a JUnit report for a build server."),
    ] = None,
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="Show what held, too.")] = False,
    for_programs: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> int:
    """Play scenarios on simulated time and judge what they expect.

    One line for each, and below it whatever did not hold. The exit status is 0 when
    everything held, 1 when something did not, 3 when a file could not be read.

    tftool check turtles
    tftool check scenarios/*.yaml --junit report.xml
    """
    # Heavy imports wait until this command is the chosen one.
    import json

    from rich.console import Console

    from tftool.errors import InputError
    from tftool.views import findings
    from tftool.views.escaping import visible

    judged = [_judge(word) for word in scenarios]
    reports = [report for report, _ in judged]
    if for_programs:
        sys.stdout.write(json.dumps(findings.as_rows(reports), indent=2) + "\n")
    else:
        console = Console()
        if not (verbose or console.is_terminal):
            # A log may be searched by line: what is one sentence stays in one.
            console.width = LOG_WIDTH
        # Written by us: rich ends the process with 1 when a reader (`| head`) is gone.
        with console.capture() as table:
            console.print(findings.render_all(reports) if verbose else findings.render(reports))
        for line in table.get().splitlines():
            sys.stdout.write(f"{line.rstrip()}\n")
        sys.stdout.write(f"{findings.summary(reports)}\n")
    if junit is not None:
        try:
            junit.write_text(findings.as_junit(reports), encoding="utf-8")
        except OSError as error:
            reason = error.strerror or error
            raise InputError(f"'{visible(str(junit))}' cannot be written: {reason}.") from error
    if not all(readable for _, readable in judged):
        return 3
    return 0 if all(report.ok for report in reports) else 1


def _judge(word: str) -> "tuple[Report, bool]":
    """Report on one scenario, and whether it could be read; what could not is told at once."""
    from tftool.errors import InputError
    from tftool.messages import Report
    from tftool.scenario import builtin
    from tftool.scenario.load import load
    from tftool.scenario.play import run_scenario
    from tftool.views.escaping import visible_lines

    try:
        scenario = load(builtin.find(word))
    except InputError as error:
        sys.stderr.write(f"tftool: {visible_lines(str(error))}\n")
        return Report(Path(word).stem or word, word, (), failure=str(error)), False
    return run_scenario(scenario).report(), True
