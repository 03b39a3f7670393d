import pytest
import typer

from tftool.commands.shared.options import (
    duration,
    finite,
    moment,
    not_negative,
    positive,
)
from tftool.frames.source_options import At


@pytest.mark.parametrize(
    ("text", "nanoseconds"),
    [("1", 10**9), ("0.1", 10**8), ("1e-9", 1), ("1700000000.123456789", 1700000000123456789)],
)
def test_a_duration_is_exact_to_the_nanosecond(text, nanoseconds):
    assert duration(positive)(text) == nanoseconds


@pytest.mark.parametrize(
    ("check", "text", "told"),
    [
        (positive, "0", "0 is not a positive number."),
        (positive, "1e-12", "1e-12 is less than a nanosecond: give a longer time."),
        (not_negative, "-1", "-1 is not allowed here: give zero or more."),
        (finite, "inf", "inf is not a finite number."),
        (finite, "1e300", "1e+300 is too large: give 9e+09 at most."),
        (finite, "soon", "'soon' is not a number."),
        (finite, "", "'' is not a number."),
    ],
)
def test_a_duration_that_cannot_be_says_why(check, text, told):
    with pytest.raises(typer.BadParameter) as refused:
        duration(check)(text)

    assert refused.value.message == told


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("12.5", At(12_500_000_000)),
        ("99999999.9", At(99_999_999_900_000_000)),
        ("100000000", At(10**17, is_stamp=True)),
        ("+100000000", At(10**17)),
        ("1663952504.123456789", At(1663952504123456789, is_stamp=True)),
        ("2022-09-23T17:01:44Z", At(1663952504 * 10**9, is_stamp=True)),
        ("2022-09-23T17:01:44.123456789Z", At(1663952504123456789, is_stamp=True)),
        ("2022-09-23 19:01:44.5+02:00", At(1663952504500000000, is_stamp=True)),
        ("20220923T170144", At(1663952504 * 10**9, is_stamp=True)),
    ],
)
def test_a_moment_is_read_as_it_is_meant(text, meant):
    assert moment(text) == meant


def test_a_moment_counts_from_the_start_unless_it_is_a_stamp():
    assert moment("2").stamp(10**9) == 3 * 10**9
    assert moment("1e9").stamp(10**9) == 10**18


@pytest.mark.parametrize("text", ["noon", "", "nan", "-1", "2022-13-01T00:00:00Z", "1969-01-01T00"])
def test_a_moment_that_is_none_is_refused(text):
    with pytest.raises(typer.BadParameter):
        moment(text)


def test_nanoseconds_are_refused_with_what_they_are_in_seconds():
    """Check that a stamp in nanoseconds, as in `--json`, is refused with its seconds."""
    with pytest.raises(typer.BadParameter) as refused:
        moment("1750000002123456789")

    assert str(refused.value) == (
        "'1750000002123456789' is too large for seconds; if it is nanoseconds, write "
        "1750000002.123456789."
    )
    assert moment("1750000002.123456789") == At(1750000002123456789, is_stamp=True)


@pytest.mark.parametrize("command", ["demo", "monitor", "play", "plot", "robot", "teleop", "tree"])
def test_every_command_with_a_screen_has_the_same_options_for_its_terminal(tftool, command):
    told = tftool(command, "--help").out

    assert "--ascii" in told
    assert "--light" in told


def test_a_tree_is_printed_in_ascii_if_wanted(tftool):
    assert tftool("tree", "static", "--ascii").out.isascii()
    assert not tftool("tree", "static").out.isascii()
