"""The way into a session, where something goes wrong on it."""

import itertools

import pytest

from tftool.link.options import Options
from tftool.link.zenoh import opening
from tftool.link.zenoh.opening import Opening
from tftool.link.zenoh.transport import Wire


def test_whatever_goes_wrong_on_the_way_in_nothing_is_left_there(session_dir, monkeypatch):
    def fail(wire, key, timeout=1.0):
        raise RuntimeError("zenoh has a bad day")

    with monkeypatch.context() as broken:
        broken.setattr(Wire, "tokens", fail)
        with pytest.raises(RuntimeError, match="a bad day"):
            Opening(Options())

    assert [path.name for path in (session_dir / "0").iterdir()] == ["lock"]
    # The lock is free again: nobody waits for it.
    Opening(Options()).close()


def test_a_wait_is_over_at_its_time_however_long_each_look_takes(monkeypatch):
    looks = itertools.count()

    class Slow:
        """Each time it is read, 0.4 s have gone by."""

        def elapsed(self):
            return next(looks) * 400_000_000

    monkeypatch.setattr(opening, "WallClock", Slow)
    seen = []

    assert not opening._await(lambda: seen.append(0) or False, 1.0)
    assert len(seen) == 4
    assert opening._await(lambda: True, 0.0)
    assert not opening._await(lambda: False, 0.0)
