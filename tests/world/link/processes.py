"""Commands as separate processes, and their output."""

import contextlib
import io
import os
import signal
import subprocess
import sys
import threading
from dataclasses import dataclass
from pathlib import Path

from tests.patience import PATIENCE
from tftool.app.main import main

ROOT = Path(__file__).parents[3]


class Process:
    """`tftool WORDS` in a separate process; its stdout and stderr are collected."""

    def __init__(self, *words, prefix=(), cwd=ROOT):
        self.lines = []
        self._heard = threading.Condition()
        self._silent = False  # whether it has closed its output
        self.started = subprocess.Popen(
            [*prefix, sys.executable, "-u", "-m", "tftool", *map(str, words)],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            cwd=cwd,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
        )
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self.started.stdout:
            with self._heard:
                self.lines.append(line.rstrip("\n"))
                self._heard.notify_all()
        with self._heard:
            self._silent = True
            self._heard.notify_all()

    @property
    def pid(self):
        return self.started.pid

    @property
    def text(self):
        return "\n".join(self.lines)

    def says(self, words, *, after=0):
        """Wait until a line contains `words`; return the number of lines up to this one."""

        def found():
            lines = enumerate(self.lines[after:], after + 1)
            return next((number for number, line in lines if words in line), None)

        return self.until(found, repr(words))

    def until(self, condition, what):
        """Check after every line whether `condition()` is true; return its value."""
        with self._heard:
            self._heard.wait_for(lambda: condition() or self._silent, PATIENCE)
            met = condition()
        if met:
            return met
        raise AssertionError(
            f"{self.started.args[3:]} never said {what} (status {self.started.poll()}); "
            f"it said:\n{self.text}"
        )

    def kill(self):
        self.started.kill()
        return self.end()

    def interrupt(self):
        self.started.send_signal(signal.SIGINT)
        return self.end()

    def end(self):
        status = self.started.wait(PATIENCE)
        self._reader.join(PATIENCE)
        self.started.stdout.close()
        return status

    def __enter__(self):
        return self

    def __exit__(self, *error):
        if self.started.poll() is None:
            self.kill()
        elif not self.started.stdout.closed:
            self.end()


def run(*words, cwd=ROOT):
    """Run `tftool WORDS` to its end."""
    return subprocess.run(
        [sys.executable, "-m", "tftool", *map(str, words)],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        timeout=PATIENCE,
        check=False,
    )


@dataclass(frozen=True)
class Done:
    """Result of a command that has ended."""

    returncode: int
    stdout: str
    stderr: str


def run_here(*words):
    """Run `tftool WORDS` to its end in this process, beside commands in other processes."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        status = main([str(word) for word in words])
    return Done(status, out.getvalue(), err.getvalue())
