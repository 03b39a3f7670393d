import json
import re

import pytest

from tests.app.test_app import start
from tests.patience import PATIENCE
from tftool.base.errors import LookupException
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.commands.echo.echo_loop import LivePrinter
from tftool.commands.shared.hosting import HOME
from tftool.commands.shared.pairs import FramePair
from tftool.commands.shared.terminal import Redrawing
from tftool.geometry.rigid import Transform
from tftool.world.clock import SimClock

HOSTING = f"No session is running here: hosting scenario '{HOME}'.\n"


def test_one_moment_of_a_scenario_is_exact(tftool):
    result = tftool("echo", "turtle2", "turtle1", "turtles", "--at", "4", "--distance")

    assert result.status == 0
    # The distance after the first command of the tutorial's follower
    assert result.out.split("\n")[-2] == "- Distance: 2.515"
    assert result.out.startswith("At time 1004.0\n- Translation: [2.323, 0.965, 0.000]\n")
    assert result.err == "turtle1 in turtle2, 4 s after scenario 'turtles' began:\n"


def test_two_runs_print_the_same_to_the_last_digit(tftool):
    words = ("echo", "map", "laser_point", "robot", "--at", "12.5", "--precision", "17")

    assert tftool(*words).out == tftool(*words).out != ""


def test_without_a_source_it_hosts_the_turtles_and_says_so(tftool, simulated):
    result = tftool("echo", "turtle1", "world", "--once")

    assert result.status == 0
    assert result.err.startswith(HOSTING + "world in turtle1:\n")
    assert result.out.count("At time") == 1


def test_a_third_word_that_is_a_number_is_the_rate_as_in_tf2_echo(tftool, simulated):
    result = tftool("echo", "turtle1", "world", "4", "--count", "3", "--json")

    first, _, last = (json.loads(line)["stamp_ns"] for line in result.out.splitlines())
    assert last - first == 496_000_000


def test_a_scenario_in_a_file_called_by_a_number_is_a_file(tftool, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "10").write_text(
        "about: x\nduration: 5 s\nnodes:\n  - static: {parent: A, child: B, x: 1 m}\nexpect: []\n"
    )

    result = tftool("echo", "A", "B", "10", "--at", "1")

    assert "scenario '10'" in result.err


@pytest.mark.parametrize(
    ("given", "status", "sentence"),
    [
        (["--rate", "0"], 2, "0 is not between 0.001 and 1000."),
        (["--rate", "nan"], 2, "nan is not between 0.001 and 1000."),
        (["--rate", "-1"], 2, "-1 is not between"),
        (["0"], 2, "0 is not between"),
        (["inf"], 2, "inf is not between"),
        (["5", "--rate", "5"], 2, "The rate is given twice"),
        (["--count", "0"], 2, "--count"),
        (["--once", "--count", "2"], 2, "contradict"),
        (["--at", "3", "--count", "2"], 2, "prints one transform, not 2: leave out --count."),
        (["--precision", "99"], 2, "--precision"),
        (["--at", "-1"], 2, "-1 is not allowed here: give zero or more."),
        (["--at", "nan"], 2, "nan is not allowed here: give zero or more."),
        (["--at", "1", "--offset", "1"], 2, "both set the time of the lookup"),
        (["--offset", "inf"], 2, "inf is not a finite number."),
        (["--fixed-frame", "world"], 2, "needs --offset"),
        (["--offset", "-1", "--fixed-frame", "/world"], 2, "cannot start with a '/'"),
        (["--cache-time", "0"], 2, "0 is not a positive number."),
        (["nosuch", "--once"], 3, "no scenario is named 'nosuch'"),
        (["turtels", "--once"], 3, "did you mean 'turtles'?"),
        (["turtles", "--at", "61"], 2, "lasts 60 s: the time 61 s is after its end."),
        (
            ["turtles", "--at", "1004"],
            2,
            "is after its end. Numbers below 1e8 count from the start: for this stamp, write 4.",
        ),
        (["turtles", "--at", "0.5"], 4, "extrapolation into the past"),
    ],
)
def test_echo_refuses_invalid_arguments_in_one_sentence(tftool, simulated, given, status, sentence):
    result = tftool("echo", "turtle2", "turtle1", *given)

    assert result.status == status
    assert result.out == ""
    assert sentence in result.err.split("\n")[-2]


@pytest.mark.parametrize(
    ("target", "source", "status", "sentence"),
    [
        ("", "a", 2, "TARGET or SOURCE is empty"),
        ("/a", "b", 2, "in tf2 frame_ids cannot start with a '/'"),
        ("turtle1", "turtel2", 4, '"turtel2" passed to lookupTransform argument source_frame'),
        ("[bold]", "\x1b[31m", 4, '"[bold]" passed to lookupTransform argument target_frame'),
    ],
)
def test_a_name_that_is_no_frame_is_told(tftool, target, source, status, sentence):
    result = tftool("echo", target, source, "turtles", "--at", "2")

    assert result.status == status
    assert sentence in result.err
    assert "\x1b" not in result.err


def test_an_unknown_frame_is_answered_with_the_closest_existing_name(tftool):
    err = tftool("echo", "turtle1", "turtel2", "turtles", "--at", "2").err

    assert err.count("Existing frames so far: turtle1, world, turtle2.") == 1
    assert "Did you mean turtle2?" in err


def test_waiting_ends_when_patience_does(tftool, simulated):
    result = tftool("echo", "turtle1", "nosuch", "--timeout", "2")

    assert result.status == 4
    assert result.err.count("Waiting for nosuch in turtle1:") == 1


def test_a_frame_in_itself_is_said_to_be_the_identity(tftool):
    result = tftool("echo", "turtle1", "turtle1", "turtles", "--at", "2")

    assert result.status == 0
    assert "A frame seen from itself is always the identity.\n" in result.err
    assert "- Translation: [0.000, 0.000, 0.000]\n" in result.out


def test_a_short_memory_forgets(tftool):
    words = ["echo", "turtle2", "turtle1", "turtles", "--at", "9"]

    assert tftool(*words).status == 0
    assert tftool(*words, "--cache-time", "0.1").status == 0


def test_head_ends_a_hosted_echo_quietly():
    with start("echo", "turtle2", "turtle1", "--rate", "50") as process:
        assert process.stdout.readline().startswith("At time ")
        process.stdout.close()
        err = process.stderr.read()
        process.wait(timeout=PATIENCE)

    assert process.returncode == 0
    # A node of a slow machine may also log that it is behind its timer.
    told = [line for line in err.splitlines() if "behind its own timer" not in line]
    assert told == [HOSTING.rstrip("\n"), "turtle1 in turtle2:"]


def test_an_unreadable_scenario_says_why(tftool, tmp_path):
    broken = tmp_path / "broken.yaml"
    broken.write_bytes(b"\xff\xfe\x00")

    result = tftool("echo", "a", "b", broken, "--once")

    assert result.status == 3
    assert str(broken) in result.err


def test_on_a_terminal_answers_take_the_place_of_the_last(monkeypatch, capsys):
    monkeypatch.setenv("FORCE_COLOR", "1")
    clock = SimClock()
    answer = TransformStamped(clock.now(), "world", "turtle1", Transform((1.0, 2.0, 3.0)))

    with Redrawing(clock) as redrawing:
        printer = LivePrinter(redrawing, FramePair("world", "turtle1"), 3, True)
        for _ in range(2):
            printer.found(clock.now(), answer)
        printer.failed(clock.now(), LookupException("gone"), Buffer())

    out = capsys.readouterr().out
    assert out.count("\x1b[1mturtle1 in world\x1b[0m\x1b[2m  0.00 s ago") == 2
    assert "\x1b[31m1.000\x1b[0m, \x1b[32m2.000\x1b[0m, \x1b[94m3.000\x1b[0m" in out
    # The second answer, and the refusal, first move the cursor up over the twelve lines of the
    # first answer. The end draws the four lines of the refusal once more.
    assert out.count("\x1b[1A\x1b[2K") == 2 * 11 + 3
    assert "Exception thrown:gone" in out
    assert out.count("\x1b[?25h") == out.count("\x1b[?25l") == 1


def test_on_a_terminal_one_answer_is_coloured_and_its_words_are_the_same(tftool, monkeypatch):
    words = ("echo", "turtle2", "turtle1", "turtles", "--at", "4")
    piped = tftool(*words).out
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)

    painted = tftool(*words).out

    assert re.sub(r"\x1b\[[0-9;]*m", "", painted) == piped
    assert "\x1b[31m2.323\x1b[0m, \x1b[32m0.965\x1b[0m, \x1b[94m0.000\x1b[0m" in painted
