"""A real terminal, tmux, whose contents a test can read."""

import os
import shlex
import subprocess
import sys
import weakref
from contextlib import suppress
from itertools import cycle, islice
from pathlib import Path
from select import select

from tests.patience import PATIENCE

ROOT = Path(__file__).parents[1]
LOOKS = 3_000
"""Number of times a test reads the screen before it fails; new output precedes each reading."""
UNHEARD = 0.5
"""Seconds after which a key without effect is pressed again, or an empty screen is read again."""


class Terminal:
    """A tmux with one window, in which a command runs; afterwards its exit status is printed."""

    def __init__(self, place, width, height, words, environment):
        self.socket = str(place / "tmux")
        self.pid_file = place / "pid"
        command = shlex.join([sys.executable, *words])
        # exec, so that the number in the file is the number of the command itself
        line = f"sh -c {shlex.quote(f'echo $$ > {self.pid_file}; exec {command}')}"
        # Ctrl-C is a signal for all programs of the window, and the shell that waits must survive
        # it.
        line = f'trap : INT; {line}; echo "ended with $?"; exec cat'
        kept = {
            key: os.environ[key]
            for key in ("PATH", "HOME", "TFTOOL_SESSION_DIR")
            if key in os.environ
        }
        self.environment = {
            **kept,
            "LC_ALL": "C.UTF-8",
            "PYTHONPATH": str(ROOT),
            "SHELL": "/bin/sh",
            **environment,
        }
        self.tmux("new-session", "-d", "-x", str(width), "-y", str(height), line)
        # The terminal's output is also copied to this file, so that a test can wait for output.
        copy = place / "written"
        os.mkfifo(copy)
        self.written = os.open(copy, os.O_RDONLY | os.O_NONBLOCK)
        weakref.finalize(self, os.close, self.written)
        self.tmux("pipe-pane", "-O", f"exec cat > {shlex.quote(str(copy))}")

    def tmux(self, *words):
        done = subprocess.run(
            ["tmux", "-u", "-f", "/dev/null", "-S", self.socket, *words],
            check=True,
            capture_output=True,
            text=True,
            env=self.environment,
            cwd=ROOT,
        )
        return done.stdout

    def screen(self):
        return self.tmux("capture-pane", "-p")

    def press(self, *keys):
        for key in keys:
            self.tmux("send-keys", key)

    def until(self, condition, what, *, pressing=()):
        """Look at the screen until `condition` accepts it; press the next key before each look."""
        keys = cycle(pressing)
        return self._seen(
            self.screen,
            condition,
            what,
            lambda: self.press(*islice(keys, 1)),
            UNHEARD if pressing else PATIENCE,
        )

    def shows(self, words):
        return self.until(lambda screen: words in screen, words)

    def has_shown(self, words):
        """Wait for words that may have scrolled off the screen."""
        self._seen(
            lambda: self.tmux("capture-pane", "-p", "-J", "-S", "-"),
            lambda text: words in text,
            words,
        )

    def _seen(self, look, condition, what, before=lambda: None, patience=PATIENCE):
        """Look again after every output, until `condition` accepts the result of `look`."""
        silent = 0.0
        for _ in range(LOOKS):
            before()
            self._drain()
            seen = look()
            if condition(seen):
                return seen
            ready, _, _ = select([self.written], [], [], patience)
            silent = 0.0 if ready else silent + patience
            if silent >= PATIENCE:
                break
        raise AssertionError(f"{what} never came; this did:\n{self.screen()}")

    def _drain(self):
        with suppress(BlockingIOError):
            while os.read(self.written, 1 << 16):
                pass

    def facts(self):
        """Return whether the alternate screen is on, the cursor visible, the mouse reported."""
        asked = "#{alternate_on} #{cursor_flag} #{mouse_any_flag}"
        return self.tmux("display-message", "-p", asked).split()

    def signal(self, number):
        os.kill(int(self.pid_file.read_text()), number)

    def stops(self):
        """Wait until the command is suspended; it has restored the screen, and prints nothing."""
        state = Path("/proc", self.pid_file.read_text().strip(), "stat")
        # The state follows the name, which is in parentheses and may contain any characters.
        self._seen(
            lambda: state.read_text().rpartition(") ")[2],
            lambda told: told.startswith("T"),
            "the command's stop",
            patience=UNHEARD,
        )

    def ended(self, status):
        """Wait for the end of the command, and check that the terminal is restored."""
        screen = self.shows(f"ended with {status}")
        assert self.facts() == ["0", "1", "0"]
        # Typed keys are echoed again.
        self.press("o", "k", "?")
        self.shows("ok?")
        return screen
