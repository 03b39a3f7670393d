"""Separate sessions for every test, without other processes."""

import tempfile
from pathlib import Path

import pytest

from tests.patience import PATIENCE
from tftool.base.stamps import seconds
from tftool.world.clock import WallClock
from tftool.world.world import World


@pytest.fixture(autouse=True)
def session_dir(monkeypatch):
    # The folder is not tmp_path, because the path of a unix socket is limited to about 100 letters.
    with tempfile.TemporaryDirectory(prefix="tf") as folder:
        monkeypatch.setenv("TFTOOL_SESSION_DIR", folder)
        yield Path(folder)


async def until(condition, *, within=PATIENCE):
    """Wait, on the wall clock, for an effect of other threads and processes."""
    clock = WallClock()
    end = clock.now() + seconds(within)
    while not condition():
        if clock.now() > end:
            raise AssertionError(f"not within {within} s: {condition}")
        await clock.sleep(seconds(0.002))


def new_world():
    return World(WallClock())
