"""Tests of joining a session when something goes wrong."""

import itertools
import os
import signal
import socket
import subprocess
import sys

import pytest

from tftool.base.errors import LinkError
from tftool.world.link.link_options import Options
from tftool.world.link.zenoh import middleware as opening
from tftool.world.link.zenoh.middleware import ZenohMiddleware
from tftool.world.link.zenoh.reach import ZenohReach
from tftool.world.link.zenoh.transport import Wire


def test_a_failed_opening_leaves_only_the_lock_file_and_releases_the_lock(session_dir, monkeypatch):
    def fail(wire, key, timeout=1.0):
        raise RuntimeError("zenoh has a bad day")

    with monkeypatch.context() as broken:
        broken.setattr(Wire, "tokens", fail)
        with pytest.raises(RuntimeError, match="a bad day"):
            ZenohMiddleware(Options(), ZenohReach())

    assert [path.name for path in (session_dir / "0").iterdir()] == ["lock"]
    # The lock is free again, so no process waits for it.
    ZenohMiddleware(Options(), ZenohReach()).close()


@pytest.fixture
def neighbour(session_dir):
    """Start a process that is listed in the session, but does not speak zenoh."""
    place = session_dir / "0"
    place.mkdir(mode=0o700)
    words = [sys.executable, "-c", "print(flush=True); input()"]
    with (
        subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process,
        socket.socket(socket.AF_UNIX) as listening,
    ):
        process.stdout.readline()
        listening.bind(str(place / f"{process.pid}-0badcafe.sock"))
        listening.listen()
        yield process
        process.kill()


class LateWire:
    """Connection that reaches the others only after it was checked ten times."""

    zid = "0a"
    neighbours = frozenset()

    def __init__(self, reach, place):
        self.others = frozenset(place.others)
        self.looks = 0

    @property
    def reached(self):
        self.looks += 1
        return self.others if self.looks > 10 else frozenset()

    def tokens(self, key, timeout=1.0):
        return []

    def close(self):
        pass


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs /proc")
@pytest.mark.parametrize("stopped", [False, True])
def test_a_process_that_is_only_busy_is_waited_for(neighbour, monkeypatch, stopped):
    looks = itertools.count()

    class Slow:
        """Clock on which 0.4 s pass at each reading."""

        def elapsed(self):
            return next(looks) * 400_000_000

    monkeypatch.setattr(opening, "WallClock", Slow)
    monkeypatch.setattr(opening, "Wire", LateWire)
    if stopped:
        neighbour.send_signal(signal.SIGSTOP)
        os.waitpid(neighbour.pid, os.WUNTRACED)
    found = ZenohMiddleware(Options(), ZenohReach())
    found.close()

    assert found.unanswering == ((neighbour.pid,) if stopped else ())


def test_a_wait_is_over_at_its_time_however_long_each_look_takes(monkeypatch):
    looks = itertools.count()
    seen = []

    class Slow:
        """Clock on which 0.4 s pass at each reading."""

        def elapsed(self):
            return next(looks) * 400_000_000

    class Deaf(Wire):
        """Connection that never reaches another process."""

        @property
        def reached(self):
            seen.append(0)
            return frozenset()

    monkeypatch.setattr(opening, "WallClock", Slow)
    monkeypatch.setattr(opening, "Wire", Deaf)
    monkeypatch.setattr(opening, "REACHING", 1.0)

    with socket.socket() as mute:
        mute.bind(("127.0.0.1", 0))
        there = f"tcp/127.0.0.1:{mute.getsockname()[1]}"
        with pytest.raises(LinkError, match="no process answers at"):
            ZenohMiddleware(Options(), ZenohReach(connect=(there,)))
    # One check finds no neighbours; the others are at 0, 0.4, 0.8 and 1.2 s.
    assert len(seen) == 1 + 4
