"""Options that several commands share, and what their numbers may be."""

import math
from collections.abc import Callable
from typing import Annotated

import typer

from tftool.errors import UsageError

MOST = 9e9
"""The largest number an option takes: as seconds, about what a stamp of 64 bits can hold."""

LONGEST_SIMULATED = 86_400.0
"""How many seconds of simulated time a command plays: a day, as long as a scenario may last."""


def finite(value: float | None) -> float | None:
    """Let a finite number pass.

    Raises:
        typer.BadParameter: If it is NaN or infinite, or beyond `MOST`.
    """
    if value is not None and not math.isfinite(value):
        raise typer.BadParameter(f"{value} is not a finite number.")
    return _bounded(value)


def _bounded(value: float | None) -> float | None:
    if value is not None and abs(value) > MOST:
        raise typer.BadParameter(f"{value:g} is too large: beyond {MOST:g}.")
    return value


def positive(value: float | None) -> float | None:
    """Let a finite number above zero pass.

    Raises:
        typer.BadParameter: If it is zero, negative, NaN or infinite, or beyond `MOST`.
    """
    if value is not None and not (math.isfinite(value) and value > 0):
        raise typer.BadParameter(f"{value:g} is not a positive number.")
    return _bounded(value)


def not_negative(value: float | None) -> float | None:
    """Let a finite number from zero on pass.

    Raises:
        typer.BadParameter: If it is negative, NaN or infinite, or beyond `MOST`.
    """
    if value is not None and not (math.isfinite(value) and value >= 0):
        raise typer.BadParameter(f"{value:g} is not zero or more.")
    return _bounded(value)


def simulated_seconds(value: float | None) -> None:
    """Let what can be lived through on simulated time pass.

    Raises:
        UsageError: If it is more than a day.
    """
    if value is not None and value > LONGEST_SIMULATED:
        raise UsageError(
            f"--for {value:g} is too long for simulated time, of which a day is played at most: "
            f"--for {LONGEST_SIMULATED:.0f}"
        )


def within(least: float, most: float) -> Callable[[float | None], float | None]:
    """Make a check that lets numbers from `least` to `most` pass; NaN is not among them."""

    def check(value: float | None) -> float | None:
        if value is not None and not least <= value <= most:
            raise typer.BadParameter(f"{value:g} is not between {least:g} and {most:g}.")
        return value

    return check


CacheTime = Annotated[
    float | None,
    typer.Option(
        metavar="SECONDS",
        callback=positive,
        help="How far back the buffer remembers; 10 unless the scenario says otherwise.",
    ),
]

ForPrograms = Annotated[bool, typer.Option("--json", help="Print JSON.")]
