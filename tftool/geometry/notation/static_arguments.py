"""Command-line arguments of static_transform_publisher, in tf2's two styles."""

import math
import re
import shlex
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

from tftool.base.errors import UsageError
from tftool.base.plain_text import near_names
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.rigid import Transform

TRANSLATION = ("x", "y", "z")
QUATERNION = ("qx", "qy", "qz", "qw")
EULER = ("roll", "pitch", "yaw")
# Order of the angles in the positional style: yaw first.
OLD_EULER = ("yaw", "pitch", "roll")
FRAMES = ("frame-id", "child-frame-id")

NO_ROTATION = "A quaternion of four zeros is not a rotation: write 0 0 0 1 for no turn."
"""Error message for four zeros."""

OPTIONS = tuple(f"--{name}" for name in (*TRANSLATION, *QUATERNION, *EULER, *FRAMES))

# The whole word must be a number; tf2 reads 3.14abc as 3.14.
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")

Rotation = Literal["none", "euler", "quaternion"]


@dataclass(frozen=True, slots=True)
class StaticArguments:
    """One static transform from the command line of static_transform_publisher.

    Attributes:
        transform: The pose of `child` in `parent`; the quaternion is exactly as given.
        parent: The parent frame, as written.
        child: The child frame, as written.
        old_style: Whether the numbers were given without option names.
        rotation: Notation of the rotation in the arguments.
        angles: Roll, pitch and yaw in radians, as given; zeros for a quaternion.
    """

    transform: Transform
    parent: str
    child: str
    old_style: bool
    rotation: Rotation
    angles: tuple[float, float, float] = (0.0, 0.0, 0.0)


def parse(argv: Sequence[str]) -> StaticArguments | None:
    """Parse the arguments of static_transform_publisher.

    The options `--x --y --z`, `--roll --pitch --yaw` or `--qx --qy --qz --qw`, `--frame-id` and
    `--child-frame-id` may be in any order, each followed by its value. Without options, there are
    eight words `x y z yaw pitch roll parent child`, or nine words `x y z qx qy qz qw parent child`.

    Returns:
        The parsed arguments; None if help is requested.

    Raises:
        UsageError: If the arguments are wrong. The error has tf2's own text and a remedy.
    """
    words, given, asks_for_help = _split(argv)
    if asks_for_help:
        return None
    euler = [name for name in EULER if name in given]
    quaternion = [name for name in QUATERNION if name in given]
    if euler and quaternion:
        raise _refusal(
            "Cannot specify both quaternion and Euler rotations",
            f"--{euler[0]} and --{quaternion[0]} both set the rotation: leave one out.",
        )
    if len(words) in (8, 9):
        if given:
            option = next(iter(given))
            raise _refusal(
                "Cannot specify both new-style (flags) and old-style (arguments)",
                f"Leave out --{option}, or give every number by an option such as --x 1.",
            )
        return _old_style(words)
    if words:
        raise _refusal("Extra unparsed arguments on command-line", _about_extra(words))

    parent, child = (given.get(name, "") for name in FRAMES)
    if not parent:
        raise _refusal("Frame id must not be empty", "Name the parent with --frame-id PARENT.")
    if not child:
        raise _refusal(
            "Child frame id must not be empty", "Name the child with --child-frame-id CHILD."
        )
    # Every option was checked in the order of the command line.
    numbers = {name: float(text) for name, text in given.items() if name not in FRAMES}
    x, y, z = (numbers.get(name, 0.0) for name in TRANSLATION)
    roll, pitch, yaw = (numbers.get(name, 0.0) for name in EULER)
    if quaternion:
        turn = _rotation(numbers.get(name, float(name == "qw")) for name in QUATERNION)
        return StaticArguments(Transform((x, y, z), turn), parent, child, False, "quaternion")
    return StaticArguments(
        Transform((x, y, z), quaternion_from_rpy(roll, pitch, yaw)),
        parent,
        child,
        False,
        "euler" if euler else "none",
        (roll, pitch, yaw),
    )


def of_line(line: str, *, frames: Sequence[str] = ()) -> StaticArguments | None:
    """Parse a shell line with static_transform_publisher, of ROS 2 or ROS 1.

    Args:
        line: The line. Only the part after the word "static_transform_publisher" is parsed; without
            this word, the whole line.
        frames: Parent and child for a line without `--frame-id` or `--child-frame-id`.

    Returns:
        The parsed arguments; None if help is requested.

    Raises:
        UsageError: If the line cannot be parsed.
    """
    try:
        words = shlex.split(line.replace("\\\n", " "), comments=True)
    except ValueError as error:
        raise UsageError(f"The line has a quote without its closing quote: {error}.") from None
    start = next((n for n, word in enumerate(words) if "static_transform_publisher" in word), -1)
    rest = words[start + 1 :]
    # Words after which the line no longer contains arguments.
    for end in ("--ros-args", "&", "&&", ";", "|", ">"):
        rest = rest[: rest.index(end)] if end in rest else rest
    rest = [part for word in rest for part in _parted(word.removesuffix(";"))]
    named = any(word in OPTIONS for word in rest)
    if not named and len(rest) in (9, 10) and _is_number(rest[-1]) and not _is_number(rest[-2]):
        rest = rest[:-1]  # ROS 1: the last word is the period
    if named and frames:
        for option, frame in zip(("--frame-id", "--child-frame-id"), frames, strict=True):
            rest += [] if option in rest else [option, frame]
    return parse(rest)


def _parted(word: str) -> list[str]:
    option, equals, value = word.partition("=")
    return [option, value] if equals and option in OPTIONS else [word]


def _is_number(word: str) -> bool:
    return _NUMBER.fullmatch(word) is not None


def _split(argv: Sequence[str]) -> tuple[list[str], dict[str, str], bool]:
    """Return (positional arguments, values of options by name, whether help is requested)."""
    words: list[str] = []
    given: dict[str, str] = {}
    asks_for_help = False
    rest = iter(argv)
    for word in rest:
        if word in ("--help", "-h"):
            asks_for_help = True
        elif word in OPTIONS:
            value = next(rest, None)
            if value is None:
                raise _refusal(
                    f"Not enough arguments for {word}",
                    f"Write the value of {word} as the next word.",
                )
            name = word.removeprefix("--")
            if name not in FRAMES:
                _number(word, value)
            given[name] = value
        else:
            words.append(word)
    return words, given, asks_for_help


def _rotation(numbers: Iterable[float]) -> tuple[float, ...]:
    turn = tuple(numbers)
    if not any(turn):
        raise UsageError(NO_ROTATION)
    return turn


def _old_style(words: list[str]) -> StaticArguments:
    *texts, parent, child = words
    turns = OLD_EULER if len(texts) == 6 else QUATERNION
    names = (*TRANSLATION, *turns)
    numbers = {name: _number(name, text) for name, text in zip(names, texts, strict=True)}
    if not parent:
        raise _refusal(
            "Frame id must not be empty",
            "Write the parent frame as the word before the child frame.",
        )
    if not child:
        raise _refusal(
            "Child frame id must not be empty", "Write the child frame as the last word."
        )
    translation = tuple(numbers[name] for name in TRANSLATION)
    if turns is QUATERNION:
        turn = _rotation(numbers[name] for name in QUATERNION)
        return StaticArguments(Transform(translation, turn), parent, child, True, "quaternion")
    roll, pitch, yaw = (numbers[name] for name in EULER)
    return StaticArguments(
        Transform(translation, quaternion_from_rpy(roll, pitch, yaw)),
        parent,
        child,
        True,
        "euler",
        (roll, pitch, yaw),
    )


def _number(name: str, text: str) -> float:
    value = float(text) if _NUMBER.fullmatch(text) else math.nan
    if not math.isfinite(value):
        raise _refusal(
            f"Failed to parse {name} argument as float", f"'{text}' is not a finite number."
        )
    return value


def _about_extra(words: list[str]) -> str:
    for word in words:
        option, equals, value = word.partition("=")
        if equals and option in OPTIONS:
            return f"Write {option} {value} instead of {word}."
        if word.startswith("--"):
            near = near_names(option, OPTIONS)
            return f"There is no {option}." + (f" Did you mean {near[0]}?" if near else "")
    return (
        f"Without options, 8 words are needed (x y z yaw pitch roll PARENT CHILD) or 9 words "
        f"(x y z qx qy qz qw PARENT CHILD), not {len(words)}."
    )


def _refusal(tf2_text: str, remedy: str) -> UsageError:
    return UsageError(f"error parsing command line arguments: {tf2_text}. {remedy}")


def beyond_a_turn(arguments: StaticArguments) -> list[str]:
    """Return a sentence about an angle of more than a full turn, which is probably in degrees."""
    return [
        f"Angles are radians, and {angle:g} is more than a full turn; "
        f"{angle:g} degrees would be {math.radians(angle):.6g}."
        for angle in arguments.angles
        if abs(angle) > 2.0 * math.pi
    ][:1]


def advice(arguments: StaticArguments) -> list[str]:
    """Return a sentence for each probable mistake in the arguments."""
    sentences = []
    if arguments.old_style:
        sentences.append("Old-style arguments are deprecated; see --help for new-style arguments.")
    roll, pitch, yaw = arguments.angles
    if arguments.old_style and roll and not pitch and not yaw:
        numbers = " ".join(f"{number:g}" for number in arguments.transform.translation)
        sentences.append(
            f"The sixth number is roll: {roll:g} turns about the x axis. To turn about z, "
            f"write the angle as the fourth number: {numbers} {roll:g} 0 0 "
            f"{arguments.parent} {arguments.child}"
        )
    sentences += beyond_a_turn(arguments)
    length = math.hypot(*arguments.transform.rotation)
    if arguments.rotation == "quaternion" and abs(length - 1.0) > 0.01:
        sentences.append(f"The quaternion has length {length:.4g}, not 1; receivers scale it.")
    return sentences
