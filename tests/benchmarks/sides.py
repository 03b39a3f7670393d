"""A process that is measured: told a line of words, it answers with a line of numbers."""

import subprocess
from collections.abc import Sequence
from pathlib import Path


class Side:
    """One of those that are compared, kept alive and asked in turn with the others."""

    def __init__(self, command: Sequence[str | Path], env: dict[str, str] | None = None) -> None:
        self._process = subprocess.Popen(
            list(command), stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=env
        )

    def tell(self, *words: object) -> None:
        """Have it begin; `answer` waits for what comes of it."""
        assert self._process.stdin is not None
        self._process.stdin.write(" ".join(map(str, words)) + "\n")
        self._process.stdin.flush()

    def answer(self) -> list[float]:
        """What came of the oldest command not answered yet."""
        assert self._process.stdout is not None
        return [float(word) for word in self._process.stdout.readline().split()]

    def ask(self, *words: object) -> list[float]:
        """Tell, and wait for the answer."""
        self.tell(*words)
        return self.answer()

    def end(self) -> None:
        """Let it go."""
        self._process.communicate()
