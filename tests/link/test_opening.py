"""The way into a session, where something goes wrong on it."""

import pytest

from tftool.link.membership import Options
from tftool.link.opening import Opening
from tftool.link.transport import Wire


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
