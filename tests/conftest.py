"""What every test shares."""

import os
import sys
import tempfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from tests.command_line import Result, Simulated
from tftool.app.main import main
from tftool.commands.shared.connection import Connection

# No test compares wall time, so hypothesis may not either; and a build machine draws the
# same examples in every run, so that a red build means a change and not a lucky draw.
TIMELESS = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow]}
settings.register_profile("desk", **TIMELESS)
settings.register_profile("ci", **TIMELESS, derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "desk")

# Where Python is told to cache no bytecode, each of some thousand child processes would compile the
# package anew, which takes longer than most tests.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

pytest_plugins = ["pytester", "tftool.ros.pytest_plugin"]


def pytest_collection_modifyitems(items):
    """Leave random tests out of the coverage: what they run, tests of one case each run too.

    Following every line makes them three times slower, and they are most of what is computed.
    """
    for item in items:
        if item.get_closest_marker("hypothesis"):
            item.add_marker(pytest.mark.no_cover)


@pytest.fixture(scope="session", autouse=True)
def own_sessions():
    """A session folder of our own: no test's process meets anybody else's."""
    # Not pytest's own folder: a unix socket's name has about a hundred letters.
    with tempfile.TemporaryDirectory(prefix="tf") as folder:
        before = os.environ.get("TFTOOL_SESSION_DIR")
        os.environ["TFTOOL_SESSION_DIR"] = str(Path(folder) / "s")
        os.environ.pop("ROS_DOMAIN_ID", None)
        os.environ["XDG_CACHE_HOME"] = str(Path(folder) / "cache")
        yield
        if before is None:
            del os.environ["TFTOOL_SESSION_DIR"]
        else:
            os.environ["TFTOOL_SESSION_DIR"] = before


@pytest.fixture
def by_memory(monkeypatch):
    """The middleware "memory", which connects links of this process; no link is in it yet."""
    from tests.world.link.memory import MemoryMiddleware

    monkeypatch.setattr(MemoryMiddleware, "members", [])


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
    monkeypatch.chdir(Path(__file__).parent / "tutorial")
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
