from dataclasses import dataclass
from pathlib import Path

import pytest

from tftool.app.main import main
from tftool.commands.shared.connection import Connection, Providers
from tftool.world.clock import SimClock


@dataclass(frozen=True)
class Result:
    status: int
    out: str
    err: str


class Simulated(Providers):
    """Worlds live on simulated time, from the end of their head start on, and unshared."""

    def wall_clock(self, rate=1.0, *, head_start=0):
        return SimClock()

    def still_clock(self, epoch, now):
        return SimClock(epoch)

    def link(self, options):
        return None


@pytest.fixture
def outside():
    """Where the commands of a test have their clocks and links from: "providers"."""
    return {"providers": None}


@pytest.fixture
def simulated(outside):
    """Hosted worlds live on simulated time and unshared; a connection that sees to it."""
    outside["providers"] = Simulated()
    return Connection(providers=outside["providers"])


@pytest.fixture
def in_tutorial(monkeypatch):
    """The working directory is the tutorial's workspace, and no ROS 2 is sourced."""
    monkeypatch.chdir(Path(__file__).parent.parent / "tutorial")
    monkeypatch.delenv("ROS_DISTRO", raising=False)
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)


@pytest.fixture
def tftool(outside, capsys, monkeypatch):
    """The command: its words in, status, stdout and stderr out."""
    monkeypatch.setenv("COLUMNS", "100")
    monkeypatch.delenv("NO_COLOR", raising=False)

    def run(*words):
        status = main([str(word) for word in words], outside["providers"])
        captured = capsys.readouterr()
        return Result(status, captured.out, captured.err)

    return run
