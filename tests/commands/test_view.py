import html
import re
import socket
import urllib.parse
import urllib.request
import webbrowser
from pathlib import Path

import pytest

ADDRESS = r"http://127\.0\.0\.1:\d+/\?token=[\w-]{32}"


def test_view_says_where_the_page_is_and_ends_when_told(simulated, tftool):
    result = tftool("view", "turtles", "--for", "2", "--port", "0")

    assert (result.status, result.err) == (0, "")
    assert re.fullmatch(
        r"The frames of scenario 'turtles' are at http://127\.0\.0\.1:\d+/\?token=[\w-]{32}\n",
        result.out,
    )


def test_on_a_narrow_terminal_the_address_has_a_line_of_its_own(simulated, tftool, monkeypatch):
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("COLUMNS", "60")

    result = tftool("view", "turtles", "--for", "2", "--port", "0")

    assert re.fullmatch(
        r"The frames of scenario 'turtles' are at\nhttp://127\.0\.0\.1:\d+/\?token=[\w-]{32}\n",
        result.out,
    )


def test_view_takes_the_next_port_when_one_is_taken_and_says_so(simulated, tftool):
    with socket.create_server(("127.0.0.1", 0)) as holder:
        taken = holder.getsockname()[1]
        result = tftool("view", "static", "--for", "1", "--port", taken)

    said = re.fullmatch(rf"Port {taken} is not free: port (\d+) is used\.\n", result.err)
    assert result.status == 0
    assert int(said[1]) > taken
    assert f"http://127.0.0.1:{said[1]}/?token=" in result.out


@pytest.mark.parametrize(("opens", "told"), [(True, ""), (False, "No browser could be started")])
def test_view_opens_the_page_on_request(simulated, tftool, monkeypatch, opens, told):
    opened = []

    def browser(url):
        file = Path(urllib.request.url2pathname(urllib.parse.urlsplit(url).path))
        # Every user of the machine can read a command line, but only we can read this file.
        assert "token" not in url
        assert file.parent.stat().st_mode & 0o077 == 0
        opened.append(html.unescape(file.read_text()))
        return opens

    monkeypatch.setattr(webbrowser, "open", browser)
    result = tftool("view", "static", "--for", "1", "--port", "0", "--open")

    assert result.status == 0
    address = re.search(r"http://\S+", result.out)[0]
    assert f'url={address}"' in opened[0]
    assert told in result.err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--port", "99999"], "99999 is not between 0 and 65535."),
        (["--port", "-1"], "-1 is not between 0 and 65535."),
        (["--rate", "0"], "0 is not between 0.1 and 120"),
        (["--rate", "nan"], "nan is not between"),
        (["--for", "-2"], "-2 is not a positive number"),
    ],
)
def test_view_refuses_numbers_that_make_no_sense(tftool, words, told):
    result = tftool("view", *words)

    assert result.status == 2
    assert told in result.err
    assert result.err.count("\n") == 1


def test_view_of_an_unknown_scenario_is_refused(simulated, tftool):
    assert tftool("view", "no_such_world").status == 3
