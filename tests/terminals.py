"""A real terminal that can be asked what is on it: tmux."""

import os
import shlex
import subprocess
import sys
from itertools import cycle, islice
from pathlib import Path
from threading import Event

ROOT = Path(__file__).parents[1]
TRIES, PAUSE = 3600, 0.05


class Terminal:
    """A tmux with one window, in which a command runs and then its exit status stands."""

    def __init__(self, place, width, height, words, environment):
        self.socket = str(place / "tmux")
        self.pid_file = place / "pid"
        command = shlex.join([sys.executable, *words])
        # exec, so that the number in the file is the command's own.
        line = f"sh -c {shlex.quote(f'echo $$ > {self.pid_file}; exec {command}')}"
        # Ctrl-C is a signal for everything in the window; what waits for the command outlives it.
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
        """Look at the screen until it is as it should be; before each look press the next key."""
        keys = cycle(pressing)
        for _ in range(TRIES):
            self.press(*islice(keys, 1))
            screen = self.screen()
            if condition(screen):
                return screen
            Event().wait(PAUSE)
        raise AssertionError(f"{what} never came; this did:\n{screen}")

    def shows(self, words):
        return self.until(lambda screen: words in screen, words)

    def has_shown(self, words):
        """Wait for words that may have left the screen at its top since."""
        for _ in range(TRIES):
            if words in self.tmux("capture-pane", "-p", "-J", "-S", "-"):
                return
            Event().wait(PAUSE)
        raise AssertionError(f"{words} never came; this did:\n{self.screen()}")

    def facts(self):
        """Whether the other screen is on, the cursor seen, the mouse caught."""
        asked = "#{alternate_on} #{cursor_flag} #{mouse_any_flag}"
        return self.tmux("display-message", "-p", asked).split()

    def signal(self, number):
        os.kill(int(self.pid_file.read_text()), number)

    def ended(self, status):
        """Wait for the end; the terminal is then as it was before."""
        screen = self.shows(f"ended with {status}")
        assert self.facts() == ["0", "1", "0"]
        # Typed keys are echoed again.
        self.press("o", "k", "?")
        self.shows("ok?")
        return screen
