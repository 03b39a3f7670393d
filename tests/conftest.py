"""Fixtures and settings that every test shares."""

import gc
import os
import sys
import tempfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from tests.command_line import Result, Simulated
from tftool.app.main import main
from tftool.commands.shared.connection import Connection

# No test compares wall time, so hypothesis must not either. A build machine draws the same examples
# in every run, so that a failure means a change and not bad luck.
TIMELESS = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow]}
settings.register_profile("desk", **TIMELESS)
settings.register_profile("ci", **TIMELESS, derandomize=True, max_examples=40)
# This profile is for changes of the tested code: pytest --hypothesis-profile=deep tests/buffer
settings.register_profile("deep", **TIMELESS, max_examples=1000)
settings.load_profile("ci" if os.environ.get("CI") else "desk")

# If Python writes no bytecode, each of some thousand child processes compiles the package again,
# which takes longer than most tests.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

pytest_plugins = ["pytester", "tftool.ros.pytest_plugin"]


def pytest_collection_modifyitems(items):
    """Exclude random tests from the coverage; other tests run the same code.

    Tracing every line would make random tests three times slower, and they do most of the work.
    """
    for item in items:
        if item.get_closest_marker("hypothesis"):
            item.add_marker(pytest.mark.no_cover)


def pytest_collection_finish():
    """Hide all objects so far from the garbage collector.

    A worker keeps thousands of collected tests, which every collection would look at again.
    """
    gc.collect()
    gc.freeze()


@pytest.fixture(scope="session", autouse=True)
def own_sessions():
    """Use a session folder of this test run, so that no test meets other processes."""
    # The folder is not pytest's, because the path of a unix socket is limited to about 100 letters.
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
    """Use the middleware "memory", which connects worlds of this process; return it, empty."""
    from tests.world.link.memory import MemoryMiddleware

    monkeypatch.setattr(MemoryMiddleware, "members", [])


@pytest.fixture
def outside():
    """Return the providers from which the commands of a test get their clocks and connections."""
    return {"providers": None}


@pytest.fixture
def simulated(outside):
    """Run hosted worlds on simulated time without a session; return a connection for them."""
    outside["providers"] = Simulated()
    return Connection(providers=outside["providers"])


@pytest.fixture
def in_tutorial(monkeypatch):
    """Change to the tutorial's workspace, with no ROS 2 sourced."""
    monkeypatch.chdir(Path(__file__).parent / "tutorial")
    monkeypatch.delenv("ROS_DISTRO", raising=False)
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)


@pytest.fixture
def tftool(outside, capsys, monkeypatch):
    """Return a function that runs a command line; its result has status, stdout and stderr."""
    monkeypatch.setenv("COLUMNS", "100")
    monkeypatch.delenv("NO_COLOR", raising=False)

    def run(*words):
        status = main([str(word) for word in words], outside["providers"])
        captured = capsys.readouterr()
        return Result(status, captured.out, captured.err)

    return run
