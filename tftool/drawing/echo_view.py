"""Result of one transform lookup: in tf2_echo's format, as a JSON object, as a sentence."""

import math
import re
from typing import TYPE_CHECKING, Any

from tftool.base.errors import TransformException
from tftool.base.plain_text import finite, short_duration, visible, visible_lines
from tftool.base.stamps import FRAME_TIMEOUT, NANOSECONDS, Duration, Stamp, as_seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry import quaternions
from tftool.geometry.rigid import distance

if TYPE_CHECKING:
    from rich.text import Text

AXES = ("x", "y", "z")


def in_words(target: str, source: str) -> str:
    """Describe the pair of a lookup of `source` in `target`: "turtle1 in turtle2"."""
    return f"{visible(source)} in {visible(target)}"


def block(
    transform: TransformStamped,
    *,
    precision: int = 3,
    with_distance: bool = False,
    quaternion_tag: str = "",
) -> str:
    """Format a transform as the lines that tf2_echo prints.

    As in tf2_echo, nanoseconds are not padded with zeros: 5 s and 12 ns is `5.12`. `as_object` has
    the exact stamp.

    Args:
        transform: Result of a lookup.
        precision: Number of decimals.
        with_distance: Whether to add a line with the length of the translation.
        quaternion_tag: Text after "Quaternion": " (xyzw)" as in newer releases of tf2_echo.

    Returns:
        Lines, each with its newline.
    """
    pose = transform.transform
    rpy = quaternions.rpy(pose.rotation)
    whole, rest = divmod(transform.stamp, NANOSECONDS)
    lines = [
        f"At time {whole}.{rest}",
        f"- Translation: {_list(pose.translation, precision)}",
        f"- Rotation: in Quaternion{quaternion_tag} {_list(pose.rotation, precision)}",
        f"- Rotation: in RPY (radian) {_list(rpy, precision)}",
        f"- Rotation: in RPY (degree) {_list([math.degrees(angle) for angle in rpy], precision)}",
        "- Matrix:",
        *("".join(f" {number:6.{precision}f}" for number in row) for row in pose.matrix()),
    ]
    if with_distance:
        lines.append(f"- Distance: {distance(pose):.{precision}f}")
    return "\n".join(lines) + "\n"


AXIS_STYLES = ("red", "green", "bright_blue", "")
"""Styles of the numbers of a line, in the order x, y, z, others."""

_NUMBER = re.compile(r"(?<![\w.])-?(?:\d+(?:\.\d+)?(?:e[-+]?\d+)?|nan|inf)(?![\w.])")


def painted(
    transform: TransformStamped, *, precision: int = 3, with_distance: bool = False
) -> "Text":
    """Return the lines of `block` for a terminal, with x, y and z in the colours of the axes.

    Roll, pitch and yaw have the colours of the axes x, y and z. The columns of the matrix have the
    same colours, because the columns are the axes of the source in the target.
    """
    from rich.text import Text

    text = Text()
    for line in block(transform, precision=precision, with_distance=with_distance).splitlines():
        row = Text(line)
        if line.startswith(("At time", "- Distance")):
            row.stylize("dim" if line.startswith("At") else "bold", len(line.rpartition(" ")[0]))
        else:
            for match, style in zip(_NUMBER.finditer(line), AXIS_STYLES, strict=False):
                row.stylize(style, *match.span())
        text.append_text(row).append("\n")
    return text


def live_heading(target: str, source: str, age: Duration | None) -> "Text":
    """Return a line with the pair and its transform's age, in amber or red if the age is high.

    Args:
        target: Frame in which the pose is expressed.
        source: Frame whose pose is shown.
        age: Nanoseconds since the transform's stamp; None for static transforms.
    """
    from rich.text import Text

    heading = Text().append(in_words(target, source), style="bold")
    if age is None:
        return heading.append("  static\n", style="cyan")
    return heading.append(f"  {short_duration(age)} ago\n", style=age_style(age))


def age_style(age: Duration) -> str:
    """Return the text style for an age in nanoseconds: dim, yellow or red."""
    if as_seconds(age) <= FRAME_TIMEOUT / 3:
        return "dim"
    return "yellow" if as_seconds(age) <= FRAME_TIMEOUT else "red"


def failure(now: Stamp, error: TransformException, frames: str) -> str:
    """Format tf2_echo's message for a lookup that fails after earlier successful lookups.

    Args:
        now: Current time of the clock in nanoseconds.
        error: Exception of the lookup.
        frames: The buffer's `all_frames_as_string()`.
    """
    return (
        f"Failure at {as_seconds(now):.3f}\n"
        f"Exception thrown:{visible_lines(str(error))}\n"
        f"The current list of frames is:\n{visible_lines(frames)}\n"
    )


def as_object(transform: TransformStamped, *, with_distance: bool = False) -> dict[str, Any]:
    """Return a transform as a mapping, for --json.

    Numbers have full precision, the stamp is in whole nanoseconds, and NaN becomes null.
    """
    pose = transform.transform
    rpy = quaternions.rpy(pose.rotation)
    result: dict[str, Any] = {
        "stamp_ns": transform.stamp,
        "target": transform.frame_id,
        "source": transform.child_frame_id,
        "translation": _named(AXES, pose.translation),
        "rotation": _named((*AXES, "w"), pose.rotation),
        "rpy": _named(("roll", "pitch", "yaw"), rpy),
    }
    if with_distance:
        result["distance"] = finite(distance(pose))
    return result


def failure_as_object(now: Stamp, error: TransformException) -> dict[str, Any]:
    """Return a failed lookup as a mapping, for --json."""
    return {"failed_at_ns": now, "error": type(error).__name__, "message": str(error)}


def _list(numbers: Any, precision: int) -> str:
    return "[" + ", ".join(f"{number:.{precision}f}" for number in numbers) + "]"


def _named(names: tuple[str, ...], numbers: Any) -> dict[str, float | None]:
    return {name: finite(number) for name, number in zip(names, numbers, strict=True)}
