"""Options that several commands share, and the parsers of their values.

Durations and times on a command line are parsed as exact decimals; commands get whole nanoseconds.
"""

import math
import re
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from tftool.base.errors import UsageError
from tftool.base.stamps import NANOSECONDS, Duration, as_seconds, seconds
from tftool.frames.source_options import At

if TYPE_CHECKING:
    from decimal import Decimal

MOST = 9e9
"""Largest number of an option: as seconds, nearly the largest stamp of 64 bits."""

LONGEST_SIMULATED = seconds(86_400)
"""Longest simulated time of a command, nanoseconds: a day, as for a scenario."""

FIRST_STAMP = 100_000_000
"""Seconds from which a time is a stamp; a smaller time is counted from the start."""

_FRACTION = re.compile(r"[.,](\d+)")


# Numbers


def finite(value: float | None) -> float | None:
    """Check that a number is from -`MOST` to `MOST`; return the number, or None for None.

    Raises:
        typer.BadParameter: If the value is NaN, infinite, or beyond these limits.
    """
    if value is not None and not math.isfinite(value):
        raise typer.BadParameter(f"{value} is not a finite number.")
    return _bounded(value)


def positive(value: float | None) -> float | None:
    """Check that a number is above zero and at most `MOST`; return the number, None for None.

    Raises:
        typer.BadParameter: If the value is zero, negative, NaN or infinite, or above `MOST`.
    """
    if value is not None and not (math.isfinite(value) and value > 0):
        raise typer.BadParameter(f"{value:g} is not a positive number.")
    return _bounded(value)


def not_negative(value: float | None) -> float | None:
    """Check that a number is from zero to `MOST`; return the number, or None for None.

    Raises:
        typer.BadParameter: If the value is negative, NaN or infinite, or above `MOST`.
    """
    if value is not None and not (math.isfinite(value) and value >= 0):
        raise typer.BadParameter(f"{value:g} is not allowed here: give zero or more.")
    return _bounded(value)


def within(least: float, most: float) -> Callable[[float | None], float | None]:
    """Return a check that accepts numbers from `least` to `most`, and rejects NaN."""

    def check(value: float | None) -> float | None:
        if value is not None and not least <= value <= most:
            raise typer.BadParameter(f"{value:g} is not between {least:g} and {most:g}.")
        return value

    return check


def _bounded(value: float | None) -> float | None:
    if value is not None and abs(value) > MOST:
        raise typer.BadParameter(f"{value:g} is too large: give {MOST:g} at most.")
    return value


# Durations


def duration(check: Callable[[float | None], float | None]) -> Callable[[str | int], Duration]:
    """Return a parser that converts seconds to whole nanoseconds.

    Args:
        check: Check of the number of seconds: `positive`, `not_negative` or `finite`.
    """

    def parse(text: str | int) -> Duration:
        if isinstance(text, int):
            return text  # the default, already in nanoseconds
        try:
            check(float(text))
            found, exact = _nanoseconds(text)
        except ValueError:
            raise typer.BadParameter(f"'{text}' is not a number.") from None
        if exact and not found:
            raise typer.BadParameter(f"{text} is less than a nanosecond: give a longer time.")
        return found

    return parse


def _nanoseconds(text: str) -> "tuple[int, Decimal]":
    """Convert a text with seconds to nanoseconds; return the rounded and the exact number.

    Raises:
        ValueError: If the text is not a number.
    """
    # Imported here, because the help of a command does not need it.
    from decimal import Decimal, InvalidOperation

    try:
        exact = Decimal(text) * NANOSECONDS
    except InvalidOperation as error:
        raise ValueError(text) from error
    return int(exact.to_integral_value("ROUND_HALF_UP")), exact


def refuse_long_simulation(lasting: Duration | None) -> None:
    """Raise UsageError for a simulated duration of more than a day."""
    if lasting is not None and lasting > LONGEST_SIMULATED:
        raise UsageError(
            f"--for {as_seconds(lasting):g} is too long for simulated time, which is limited "
            f"to a day: give --for {as_seconds(LONGEST_SIMULATED):.0f} or less"
        )


# Moments


def moment(text: str) -> At:
    """Parse a time: seconds since the start, or a stamp.

    `12.5` and `+12.5` are seconds since the start. Numbers from 10⁸ on, such as `1663952504.7`, are
    stamps, unless they begin with `+`. Dates such as `2022-09-23T17:01:44.7Z` are stamps too, in
    UTC if no time zone is given.

    Raises:
        typer.BadParameter: If the text is neither a number nor a date.
    """
    if re.match(r"\d{4}-?\d\d-?\d\d[T ]", text):
        return _date(text)
    if re.fullmatch(r"[0-9]{18,19}", text):
        raise typer.BadParameter(
            f"'{text}' is too large for seconds; if it is nanoseconds, write "
            f"{text[:-9]}.{text[-9:]}."
        )
    try:
        not_negative(float(text))
        found, exact = _nanoseconds(text)
    except ValueError:
        raise typer.BadParameter(
            f"'{text}' is not a time: give seconds since the start, such as 12.5, or a stamp, "
            "such as 1663952504.7 or 2022-09-23T17:01:44.7Z."
        ) from None
    return At(found, exact >= FIRST_STAMP * NANOSECONDS and not text.startswith("+"))


def _date(text: str) -> At:
    # Python's parser of dates drops digits below a microsecond.
    fraction = _FRACTION.search(text)
    try:
        found = datetime.fromisoformat(_FRACTION.sub("", text, count=1))
    except ValueError as error:
        raise typer.BadParameter(f"'{text}' is not a date and time: {error}.") from None
    if found.tzinfo is None:
        found = found.replace(tzinfo=UTC)
    whole = round((found - datetime(1970, 1, 1, tzinfo=UTC)).total_seconds()) * NANOSECONDS
    digits = fraction[1][:9].ljust(9, "0") if fraction else "0"
    if whole <= 0:
        raise typer.BadParameter(f"'{text}' is before 1970: give a later time.")
    return At(whole + int(digits), is_stamp=True)


# Contradictions

Rule = tuple[object, str]
"""Condition under which options are refused, and the text of the error."""


def refuse(*rules: Rule) -> None:
    """Raise UsageError with the sentence of the first rule whose condition is true."""
    for holds, sentence in rules:
        if holds:
            raise UsageError(sentence)


# Options

WHEN = "When"
ROBOT = "Robot descriptions"
OUTPUT = "Output"
MANY = "Many recordings"
"""Headings in the help above groups of options; all others are below "Options"."""


def option(
    help_text: str,
    *names: str,
    default: Any = None,
    metavar: str | None = None,
    panel: str | None = None,
    **further: Any,
) -> Any:
    """Return the declaration of a command's option, to be the value of a field.

    Args:
        help_text: Text of the help.
        names: Names of the option; if none are given, the name is made from the field's name.
        default: Value if the option is not given; `...` for an option that must be given, and for
            an option inside `Annotated`.
        metavar: Name of the value in the help.
        panel: Heading above the option in the help; None for the usual heading.
        further: Further arguments of `typer.Option`.
    """
    return typer.Option(
        default, *names, metavar=metavar, rich_help_panel=panel, help=help_text, **further
    )


def flag(help_text: str, *names: str, panel: str | None = None) -> Any:
    """Return the declaration of an option without a value, which is True if given; see `option`."""
    return option(help_text, *names, default=False, panel=panel)


def argument(help_text: str, *, default: Any = None, metavar: str, **further: Any) -> Any:
    """Return the declaration of an argument, a word without an option's name; see `option`."""
    return typer.Argument(default, metavar=metavar, help=help_text, **further)


def output_file(help_text: str) -> Any:
    """Return the declaration of a command's option `-o FILE`; `help_text` is its help."""
    return option(help_text, "-o", "--output", metavar="FILE", panel=OUTPUT)


def seconds_option(
    help_text: str,
    *names: str,
    default: Any = None,
    check: Callable[[float | None], float | None] = positive,
    panel: str | None = WHEN,
) -> Any:
    """Return the declaration of an option that is typed in seconds and stored in nanoseconds.

    `help_text` must name the default, because typer would show the default in nanoseconds.

    Args:
        help_text: Text of the help.
        names: Names of the option; if none are given, the name is made from the field's name.
        default: Value if the option is not given, in nanoseconds; see `option`.
        check: Check of the number of seconds.
        panel: Heading above the option in the help; None for the usual heading.
    """
    more: dict[str, Any] = {"parser": duration(check), "show_default": False}
    return option(help_text, *names, default=default, metavar="SECONDS", panel=panel, **more)


def moment_option(
    help_text: str, *names: str, default: Any = None, panel: str | None = WHEN
) -> Any:
    """Return the declaration of an option whose value is a time; `help_text` is its help."""
    return option(help_text, *names, default=default, metavar="MOMENT", panel=panel, parser=moment)


def decimals(help_text: str, *, default: int) -> Any:
    """Return the declaration of a command's option `--precision N`; `help_text` is its help."""
    names = "--precision", "-p"
    return option(help_text, *names, default=default, metavar="N", panel=OUTPUT, min=0, max=17)


Target = Annotated[
    str, typer.Argument(metavar="TARGET", help="Frame in which the pose is expressed.")
]
Source = Annotated[str, typer.Argument(metavar="SOURCE", help="Frame whose pose is looked up.")]

From = Annotated[
    str | None,
    typer.Argument(
        metavar="[FROM]",
        help="Source of the frames: a scenario (name or file), a recording (file, folder, glob), "
        "a robot description, or a robot's Foxglove server (ws://robot:8765); if not given, "
        "the running session, else the scenario turtles.",
        show_default=False,
    ),
]

AtOption = Annotated[
    At | None,
    moment_option(
        "Use the frames at this time: seconds since the start of FROM, or a stamp (1e8 or more, or "
        "an ISO date and time).",
        "--at",
        "-t",
        default=...,
    ),
]

FromOption = Annotated[
    At | None,
    moment_option(
        "Leave out everything before this time: seconds since the start of FROM, or a stamp.",
        "--from",
        default=...,
    ),
]

ToOption = Annotated[
    At | None,
    moment_option(
        "Leave out everything after this time: seconds since the start of FROM, or a stamp.",
        "--to",
        default=...,
    ),
]

Every = Annotated[
    Duration | None,
    seconds_option(
        "Time between two lookups; if not given, lookups use the stamps of the fastest link.",
        "--every",
        default=...,
    ),
]

Pairs = Annotated[
    list[str] | None,
    option(
        "A pair of frames. Repeat the option for more pairs.",
        "--pair",
        metavar="TARGET:SOURCE",
        default=...,
    ),
]

StampsOf = Annotated[
    str | None,
    option(
        "Look up at the stamps of the messages of this recorded topic.",
        "--at-stamps-of",
        metavar="TOPIC",
        panel=WHEN,
        default=...,
    ),
]

Rate = Annotated[
    float | None,
    typer.Option(
        "--rate",
        "-r",
        metavar="HZ",
        rich_help_panel=WHEN,
        callback=within(0.001, 1000),
        help="Lookups per second, in place of --every.",
    ),
]

CacheTime = Annotated[
    Duration | None,
    seconds_option(
        "Time for which the buffer keeps transforms; if not given, that of the scenario, else 10 "
        "s.",
        default=...,
    ),
]

RunFor = Annotated[Duration | None, seconds_option("Stop after SECONDS.", "--for", default=...)]

SkippedFolders = Annotated[
    bool, option("Print which folders are skipped.", "--verbose", "-v", default=...)
]

RosFree = Annotated[
    bool, option("Run without ROS even if a real ROS 2 is sourced.", "--ros-free", default=...)
]

Simulated = Annotated[
    bool,
    option(
        "Use simulated time: the run ends at once, with the same result every time.",
        "--simulated",
        default=...,
    ),
]

Junit = Annotated[
    Path | None,
    option("Write a JUnit report for a build server.", "--junit", metavar="FILE", default=...),
]

Force = Annotated[bool, option("Replace existing files.", "--force", panel=OUTPUT, default=...)]

Meshes = Annotated[
    list[Path] | None,
    typer.Option(
        "--meshes",
        metavar="FOLDER",
        rich_help_panel=ROBOT,
        file_okay=False,
        exists=True,
        help="Folder with the packages that contain the meshes. Repeat the option for more "
        "folders. Files outside of these folders are never shown.",
    ),
]

Json = Annotated[bool, option("Print JSON.", "--json", panel=OUTPUT, default=...)]

Ascii = Annotated[
    bool,
    option(
        "Draw with ASCII characters only, for fonts that lack other characters.",
        "--ascii",
        default=...,
    ),
]

Light = Annotated[
    bool,
    option(
        "Use colors for a terminal with a light background; on a screen, the key m switches "
        "between light and dark.",
        "--light",
        default=...,
    ),
]

Rows = Annotated[
    Path | None,
    option(
        "Write rows to a .jsonl, .csv or .parquet file, also for a single recording.",
        "--output",
        "-o",
        metavar="FILE",
        panel=MANY,
        default=...,
    ),
]
Jobs = Annotated[
    int,
    typer.Option(
        "--jobs",
        "-j",
        min=1,
        max=256,
        metavar="N",
        rich_help_panel=MANY,
        help="Number of recordings to process at the same time.",
    ),
]
Resume = Annotated[
    bool,
    option(
        "Skip the recordings whose rows are already in the file of -o.",
        "--resume",
        panel=MANY,
        default=...,
    ),
]
Scheduler = Annotated[
    str,
    option(
        "Process the recordings on a cluster of Dask workers that you trust: tcp://HOST:8786.",
        metavar="ADDRESS",
        panel=MANY,
        default=...,
    ),
]
