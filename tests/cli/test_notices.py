import os
import sys

import pytest

from tftool.cli.notices import notice, tell_record, wants_color
from tftool.runtime.log import LogRecord
from tftool.stamps import seconds


def record(level, text="Oh no!"):
    return LogRecord(seconds(1700000000.5) + 7, level, "robot.arm", text)


def test_a_line_is_laid_out_as_ros_2_lays_it_out(capsys):
    tell_record(record("INFO"))
    tell_record(record("FATAL", "two\nlines"), label="arm-3")

    assert capsys.readouterr().err == (
        "[INFO] [1700000000.500000007] [robot.arm]: Oh no!\n"
        "[arm-3] [FATAL] [1700000000.500000007] [robot.arm]: two\nlines\n"
    )


@pytest.mark.parametrize(
    ("level", "shown"),
    [
        ("DEBUG", "\033[32m[DEBUG] [1700000000.500000007] [robot.arm]: ␛[5m\033[0m\n"),
        ("INFO", "[INFO] [1700000000.500000007] [robot.arm]: ␛[5m\n"),
        ("WARN", "\033[33m[WARN] [1700000000.500000007] [robot.arm]: ␛[5m\033[0m\n"),
        ("ERROR", "\033[31m[ERROR] [1700000000.500000007] [robot.arm]: ␛[5m\033[0m\n"),
        ("FATAL", "\033[31m[FATAL] [1700000000.500000007] [robot.arm]: ␛[5m\033[0m\n"),
    ],
)
def test_levels_have_ros_2s_colors_and_texts_bring_none(capsys, monkeypatch, level, shown):
    monkeypatch.setenv("RCUTILS_COLORIZED_OUTPUT", "1")
    tell_record(record(level, "\033[5m"))

    assert capsys.readouterr().err == shown


@pytest.mark.parametrize(
    ("environment", "is_terminal", "wanted"),
    [
        ({}, True, True),
        ({}, False, False),
        ({"NO_COLOR": "1"}, True, False),
        ({"TERM": "dumb"}, True, False),
        ({"RCUTILS_COLORIZED_OUTPUT": "1"}, False, True),
        ({"RCUTILS_COLORIZED_OUTPUT": "0"}, True, False),
    ],
)
def test_colors_are_for_terminals_unless_told_otherwise(environment, is_terminal, wanted):
    assert wants_color(environment, is_terminal=is_terminal) is wanted


@pytest.mark.skipif(sys.platform == "win32", reason="needs a pseudo-terminal")
def test_on_a_terminal_a_sentence_is_broken_between_its_words(monkeypatch):
    import pty
    import termios

    reading, writing = pty.openpty()
    termios.tcsetwinsize(writing, (24, 30))
    sentence = "No session is running here: hosting scenario 'turtles'."
    with os.fdopen(writing, "w") as terminal:
        monkeypatch.setattr("sys.stderr", terminal)
        notice(sentence)
        shown = os.read(reading, 1000).decode().splitlines()
    os.close(reading)

    assert max(map(len, shown)) <= 30
    assert len(shown) == 2
    assert " ".join(shown) == sentence
