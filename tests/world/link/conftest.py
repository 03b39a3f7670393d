"""Sessions of their own for every test: nobody else's process is met."""

import tempfile
from pathlib import Path

import pytest

from tests.patience import PATIENCE
from tftool.base.stamps import seconds
from tftool.world.clock import WallClock
from tftool.world.world import World


@pytest.fixture(autouse=True)
def session_dir(monkeypatch):
    # Not tmp_path: a unix socket's name has about a hundred letters.
    with tempfile.TemporaryDirectory(prefix="tf") as folder:
        monkeypatch.setenv("TFTOOL_SESSION_DIR", folder)
        yield Path(folder)


async def until(condition, *, within=PATIENCE):
    """Wait, on the wall clock, for what other threads and processes bring about."""
    clock = WallClock()
    end = clock.now() + seconds(within)
    while not condition():
        if clock.now() > end:
            raise AssertionError(f"not within {within} s: {condition}")
        await clock.sleep(seconds(0.002))


def new_world():
    return World(WallClock())
