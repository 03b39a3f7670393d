"""Options for reading pose files: frame names, rate, format, direction, camera axes."""

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, Final

from tftool.base.errors import UsageError

AXES: Final = ("opencv", "opengl")
"""Names of camera axes: "opencv" (z forward, y down) or "opengl" (z back, y up)."""


@dataclass(frozen=True, slots=True)
class PoseOptions:
    """Options for reading one pose file.

    Attributes:
        frames: Names of the frames, "PARENT:CHILD"; None for the format's names.
        pose_rate: Poses per second, for a file without stamps.
        pose_format: Name of the format; None to detect the format from the content.
        inverted: Whether the file's poses are the inverse of the poses that the format requires.
        axes: Axes of the file's cameras, one of `AXES`; None for the format's axes.
        prefix: Name to put before each frame name, followed by a slash.
    """

    frames: str | None = None
    pose_rate: float | None = None
    pose_format: str | None = None
    inverted: bool = False
    axes: str | None = None
    prefix: str = ""

    def __post_init__(self) -> None:
        if self.frames is not None:
            self.pair()
        if self.pose_rate is not None and not (
            math.isfinite(self.pose_rate) and 1e-6 <= self.pose_rate <= 1e6
        ):
            raise UsageError(
                f"--pose-rate must be a number of poses per second, not {self.pose_rate:g}."
            )
        if self.axes is not None and self.axes not in AXES:
            raise UsageError(f"--axes must be {' or '.join(AXES)}, not '{self.axes}'.")

    def pair(self) -> tuple[str, str]:
        """Split `frames` ("PARENT:CHILD") into the names of parent and child.

        Raises:
            UsageError: If the text is not two different names with a colon between.
        """
        parent, _, child = (self.frames or "").partition(":")
        if not parent or not child or ":" in child or parent == child:
            raise UsageError(
                f"--frames must be two names, such as odom:base_link, not '{self.frames}'."
            )
        return parent, child

    def refuse(self, what: str) -> None:
        """Raise an error if any option was given for a source that is not a pose file.

        Args:
            what: Name of the source, as the beginning of a sentence.

        Raises:
            UsageError: If an option was given.
        """
        given = [
            f"--{one.name.replace('_', '-')}"
            for one in fields(self)
            if getattr(self, one.name) != one.default
        ]
        if given:
            raise UsageError(f"{what}: leave out {', '.join(given)}.")


@dataclass(frozen=True, slots=True)
class ChosenOptions:
    """Options for all pose files of one command, and for single files.

    Attributes:
        every: Options for all files that are not in `by_name`.
        by_name: Options for single files, by the word on the command line that names the file.
    """

    every: PoseOptions = PoseOptions()
    by_name: Mapping[str, PoseOptions] = field(default_factory=dict)


_CHOSEN: ContextVar[ChosenOptions] = ContextVar("chosen pose options")
_NONE: Final = ChosenOptions()


@contextmanager
def pose_options(chosen: ChosenOptions) -> Iterator[None]:
    """Apply options to all pose files that are read within this `with` block.

    Code that opens recordings passes only names of recordings, so the options are set once here.
    """
    token = _CHOSEN.set(chosen)
    try:
        yield
    finally:
        _CHOSEN.reset(token)


def options_of(word: str) -> PoseOptions:
    """Return the options for the file that a word names."""
    chosen = _CHOSEN.get(_NONE)
    return chosen.by_name.get(word, chosen.every)


def collect(given: "list[tuple[str | None, str, Any]]") -> ChosenOptions:
    """Return the options of each file.

    An option belongs to the preceding file on the command line. An option before the first file
    belongs to all files.

    Args:
        given: Preceding file (None for all files), name and value of each option.
    """
    every: dict[str, Any] = {}
    named: dict[str, dict[str, Any]] = {}
    for word, name, value in given:
        is_file = word is not None and names_file(word)
        (named.setdefault(word or "", {}) if is_file else every)[name] = value
    return ChosenOptions(
        PoseOptions(**every),
        {word: PoseOptions(**{**every, **own}) for word, own in named.items()},
    )


def names_file(word: str) -> bool:
    """Whether a word names an existing file, with or without a prefix (NAME=FILE)."""
    return path_behind_prefix(word)[1] is not None


def path_behind_prefix(word: str) -> tuple[str, Path | None]:
    """Split NAME=FILE into prefix and file; the prefix is "" if the whole word names a file.

    Returns:
        The prefix, and the path of the file; None in place of the path if the file is missing.
    """
    try:
        if Path(word).exists():
            return "", Path(word) if Path(word).is_file() else None
        name, equals, rest = word.partition("=")
        if equals and name and "/" not in name and Path(rest).is_file():
            return name, Path(rest)
    except (OSError, ValueError):
        pass
    return "", None
