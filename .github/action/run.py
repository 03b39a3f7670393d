"""Script of the action in action.yml, which runs the requested commands and reports the results.

The script reads the action's inputs from the variables INPUT_…, adds the output of each command to
the summary of the job, and ends with the highest exit status of the commands.
"""

import os
import shlex
import subprocess
import sys
from pathlib import Path


def commands(inputs: dict[str, str], reports: Path) -> list[list[str]]:
    """Return the words of each command that the inputs request.

    Raises:
        ValueError: If a quotation mark is not closed, or no command is requested.
    """
    found = []
    if doctor := shlex.split(inputs["DOCTOR"]):
        files = ["--sarif", str(reports / "doctor.sarif"), "--junit", str(reports / "doctor.xml")]
        accepted = ["--baseline", inputs["BASELINE"]] if inputs["BASELINE"] else []
        limit = ["--fail-on", inputs["FAIL_ON"] or "warning"]
        found.append(["doctor", *doctor, *limit, *accepted, *files])
    found += [
        ["diff", *words] for line in inputs["DIFF"].splitlines() if (words := shlex.split(line))
    ]
    if check := shlex.split(inputs["CHECK"]):
        files = ["--junit", str(reports / "check.xml"), "--record", str(reports / "failed")]
        found.append(["check", *check, *files])
    if not found:
        raise ValueError("give the action at least one of 'doctor', 'diff' and 'check'")
    return found


def run(words: list[str]) -> tuple[int, str]:
    """Run a command and print its output in a group of the log.

    Returns:
        The exit status, and the output as Markdown.
    """
    line = shlex.join(["tftool", *words])
    print(f"::group::{line}", flush=True)
    done = subprocess.run(
        [sys.executable, "-m", "tftool", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        errors="replace",
        check=False,
    )
    # The runner executes lines that begin with two colons; the blank prevents this.
    print("".join(f" {line}" for line in done.stdout.splitlines(keepends=True)), end="")
    print("::endgroup::", flush=True)
    if done.returncode:
        print(f"::error title=tftool {words[0]}::{line} ended with status {done.returncode}")
    fence = "`" * max(3, 1 + max((len(run) for run in _ticks(done.stdout)), default=0))
    return done.returncode, f"{fence}console\n$ {line}\n{done.stdout}{fence}\n\n"


def _ticks(text: str) -> list[str]:
    """Return every run of backquotes in a text; a fence around the text must be longer."""
    return "".join(letter if letter == "`" else " " for letter in text).split()


def main() -> int:
    """Run the requested commands; return the highest exit status."""
    names = ("DOCTOR", "FAIL_ON", "BASELINE", "DIFF", "CHECK", "REPORTS")
    inputs = {name: os.environ.get(f"INPUT_{name}", "") for name in names}
    reports = Path(inputs["REPORTS"] or "tftool-reports")
    try:
        wanted = commands(inputs, reports)
    except ValueError as error:
        print(f"::error title=tftool::{error}")
        return 2
    reports.mkdir(parents=True, exist_ok=True)
    done = [run(words) for words in wanted]
    if summary := os.environ.get("GITHUB_STEP_SUMMARY"):
        with open(summary, "a", encoding="utf-8") as file:
            file.writelines(text for _, text in done)
    return max(status for status, _ in done)


if __name__ == "__main__":
    sys.exit(main())
