"""Tests of `tftool view` beside another command, each in a separate process."""

import asyncio
import json
import sys
import tempfile

import pytest
from websockets.asyncio.client import connect

from tests.patience import PATIENCE
from tests.world.link.processes import Process

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals as POSIX has them")


@pytest.fixture(autouse=True)
def session_dir(monkeypatch):
    # The folder is not tmp_path, because the path of a unix socket is limited to about 100 letters.
    with tempfile.TemporaryDirectory(prefix="tf") as folder:
        monkeypatch.setenv("TFTOOL_SESSION_DIR", folder)
        yield folder


def address_of(view):
    """Return the address that a `tftool view` prints: host:port, and the query with its secret."""
    line = view.lines[view.says("are at http://") - 1]
    place, _, query = line.partition("http://")[2].strip().partition("/")
    return place, query


def told_by(address, *, holds):
    """Listen as a page does until `holds` accepts a text message; return this message."""

    async def listen():
        place, query = address
        url = f"ws://{place}/frames{query}"
        async with connect(url, origin=f"http://{place}", compression=None) as page:
            await page.send(json.dumps({"type": "pair", "target": "turtle2", "source": "turtle1"}))
            async for message in page:
                if isinstance(message, bytes):
                    sequence = int.from_bytes(message[4:8], "little")
                    await page.send(json.dumps({"type": "got", "sequence": sequence}))
                elif holds(said := json.loads(message)):
                    return said
        raise AssertionError("the page's server ended")

    return asyncio.run(asyncio.wait_for(listen(), PATIENCE))


def test_view_joins_the_session_that_runs_and_shows_its_frames():
    # `view` would not host this world by itself.
    with Process("echo", "map", "laser_point", "robot", "--rate", "20", "--json") as host:
        host.says('"translation"')
        with Process("view", "--port", "0") as view:
            address = address_of(view)
            assert "Joined the session of 'tftool echo'" in view.text
            told = told_by(address, holds=lambda said: "laser_point" in said.get("names", []))
            assert {"map", "odom", "base_link", "laser_link"} <= set(told["names"])
            assert view.interrupt() == 130
    assert "Traceback" not in view.text


def test_view_hosts_where_nothing_runs_and_others_see_the_same_turtles():
    with Process("view", "--port", "0") as view:
        address = address_of(view)
        assert "No session is running here: hosting scenario 'turtles'." in view.text
        answer = told_by(address, holds=lambda said: said.get("found"))
        assert answer["chain"] == ["turtle1", "world", "turtle2"]
        with Process("echo", "turtle2", "turtle1", "--once", "--join") as echo:
            echo.says("Joined the session of 'tftool view'")
            echo.says("- Translation:")
            assert echo.end() == 0


def test_a_view_that_joined_goes_on_with_the_next_session():
    with Process("echo", "map", "laser_point", "robot", "--rate", "20", "--json") as host:
        host.says('"translation"')
        view = Process("view", "--port", "0", "--join")
        address = address_of(view)
        host.interrupt()
    with view, Process("follow", "turtle1", "turtle2") as host:
        host.says("hosting scenario 'turtles'")
        assert told_by(address, holds=lambda said: said.get("found"))["source"] == "turtle1"


def test_view_asked_to_join_where_nothing_runs_says_what_to_do():
    with Process("view", "--port", "0", "--join") as view:
        view.says("No session is running in domain 0: start one with 'tftool demo'")
        assert view.end() == 3
    assert "Traceback" not in view.text
