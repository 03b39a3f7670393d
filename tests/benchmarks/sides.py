"""Process to measure: it reads a line of words, and answers with a line of numbers."""

import subprocess
from collections.abc import Sequence
from pathlib import Path


class Side:
    """One of the compared programs; it runs until `end`."""

    def __init__(self, command: Sequence[str | Path], env: dict[str, str] | None = None) -> None:
        self._process = subprocess.Popen(
            list(command), stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=env
        )

    def tell(self, *words: object) -> None:
        """Send a command without waiting; `answer` waits for the result."""
        assert self._process.stdin is not None
        self._process.stdin.write(" ".join(map(str, words)) + "\n")
        self._process.stdin.flush()

    def answer(self) -> list[float]:
        """Return the result of the oldest command without an answer."""
        assert self._process.stdout is not None
        return [float(word) for word in self._process.stdout.readline().split()]

    def ask(self, *words: object) -> list[float]:
        """Send a command, and wait for its result."""
        self.tell(*words)
        return self.answer()

    def end(self) -> None:
        """End the process."""
        self._process.communicate()
