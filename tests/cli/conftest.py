from dataclasses import dataclass

import pytest

from tftool.cli.app import main
from tftool.runtime.clock import SimClock


@dataclass(frozen=True)
class Result:
    status: int
    out: str
    err: str


@pytest.fixture
def tftool(capsys, monkeypatch):
    """The command: its words in, status, stdout and stderr out."""
    monkeypatch.setenv("COLUMNS", "100")
    monkeypatch.delenv("NO_COLOR", raising=False)

    def run(*words):
        status = main([str(word) for word in words])
        captured = capsys.readouterr()
        return Result(status, captured.out, captured.err)

    return run


@pytest.fixture
def simulated(monkeypatch):
    """Hosted worlds live on simulated time, from the end of their head start on, unshared."""

    class Simulated(SimClock):
        def __init__(self, rate=1.0, *, head_start=0):
            super().__init__()

    monkeypatch.setattr("tftool.cli.session.WallClock", Simulated)
    monkeypatch.setattr("tftool.cli.session._open_link", lambda chosen: (None, ""))
