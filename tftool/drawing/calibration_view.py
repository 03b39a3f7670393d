"""Results of a sensor's calibration (mounting pose, clock offset), as text lines and as JSON."""

import math
from collections.abc import Sequence

from tftool.base.plain_text import visible
from tftool.drawing.recording_view import wrapped
from tftool.frames.calibration.calibrate import Calibration, Interval, Trio
from tftool.frames.calibration.clock_offset import ClockOffset
from tftool.geometry.conversions import rpy_from_quaternion
from tftool.geometry.rigid import Transform


def lines(found: Calibration, width: int | None = None) -> str:
    """Return a calibration as text: mounting pose in tf2's format, clock offset, verdict.

    Args:
        found: The calibration.
        width: Maximum length of a line in cells; None for no limit.
    """
    text: list[str] = []
    moving, fixed = ([visible(name) for name in names] for names in (found.moving, found.fixed))
    if moving[0] == moving[1]:
        moving = [f"{name} of {side}" for name, side in zip(moving, "AB", strict=True)]
    if fixed[0] == fixed[1]:
        fixed = [f"{name} of {side}" for name, side in zip(fixed, "AB", strict=True)]
    for title, pose, interval in (
        (f"Mount: {moving[1]} in {moving[0]}", found.mount, found.interval95),
        (f"Fixed frames: {fixed[1]} in {fixed[0]}", found.fixed_mount, found.fixed_interval95),
    ):
        if pose is not None and interval is not None:
            text += [title, *_pose(pose, interval), ""]
    if found.clock_offset is not None:
        text.append(_clock(found))
    if found.scale is not None:
        text.append(f"Scale of A: {found.scale[0]:.5f} ± {found.scale[1]:.5f}")
    if found.halves_differ is not None:
        metres, degrees = found.halves_differ
        text.append(f"Halves of the recording differ by {metres * 1e3:.1f} mm, {degrees:.2f}°")
    for note in found.notes:
        text += wrapped(visible(note), width)
    text += wrapped(f"{found.verdict}: {visible(found.why)}", width)
    if found.next_motion:
        text += wrapped(f"To record next: {found.next_motion}.", width)
    return "".join(f"{line.rstrip()}\n" for line in text)


def _pose(pose: Transform, interval: Interval) -> list[str]:
    turns = rpy_from_quaternion(pose.rotation)
    place = ", ".join(f"{one:.4f}" for one in pose.translation)
    quaternion = ", ".join(f"{one:.6f}" for one in pose.rotation)
    radians = ", ".join(f"{one:.5f}" for one in turns)
    degrees = ", ".join(f"{math.degrees(one):.3f}" for one in turns)
    millimetres = ", ".join(f"{one * 1e3:.1f}" for one in pose.translation)
    return [
        f"- Translation: [{place}]",
        f"- in mm [{millimetres}] ± {_widths(interval.translation, 1e3, 1)}",
        f"- Rotation: in Quaternion (xyzw) [{quaternion}]",
        f"- Rotation: in RPY (radian) [{radians}]",
        f"- Rotation: in RPY (degree) [{degrees}] ± {_widths(interval.rotation_deg, 1.0, 3)}",
    ]


def _widths(widths: Trio, factor: float, digits: int) -> str:
    words = ("unseen" if one is None else f"{one * factor:.{digits}f}" for one in widths)
    return f"[{', '.join(words)}]"


def _clock(found: Calibration) -> str:
    assert found.clock_offset is not None
    half = "" if found.offset_interval95 is None else f" ± {found.offset_interval95 * 1e3:.2f} ms"
    drift = "" if found.drift_ppm is None else f", drift {found.drift_ppm:.1f} ppm"
    peak = "" if found.clock is None else f" (correlation {found.clock.correlation:.3f})"
    return f"Clock offset: t_A = t_B {found.clock_offset:+.6f} s{half}{drift}{peak}"


def clock_object(found: ClockOffset) -> dict[str, float | None]:
    """Return a clock offset as a mapping, for --json."""
    return {
        "seconds": found.seconds,
        "interval95": found.interval95,
        "correlation": found.correlation,
        "second_peak": found.second,
    }


def as_object(found: Calibration, check: dict[str, object] | None = None) -> dict[str, object]:
    """Return a calibration as a mapping, for --json.

    Args:
        found: The calibration.
        check: Comparison with the published mounting pose; None if none is published.
    """
    clock = None
    if found.clock_offset is not None and found.clock is not None:
        clock = {
            "seconds": found.clock_offset,
            "interval95": found.offset_interval95,
            "correlation": found.clock.correlation,
            "drift_ppm": found.drift_ppm,
        }
    halves = found.halves_differ
    return {
        "verdict": found.verdict,
        "why": found.why,
        "moving": list(found.moving),
        "fixed": list(found.fixed),
        "mount": pose_object(found.mount),
        "fixed_mount": pose_object(found.fixed_mount),
        "interval95": _interval_object(found.interval95),
        "fixed_interval95": _interval_object(found.fixed_interval95),
        "clock_offset": clock,
        "halves_differ": None if halves is None else {"mm": halves[0] * 1e3, "deg": halves[1]},
        "unseen": list(found.unseen),
        "unseen_direction": None
        if found.unseen_direction is None
        else list(found.unseen_direction),
        "inverted": list(found.inverted),
        "next_motion": found.next_motion,
        "scale": None
        if found.scale is None
        else {"value": found.scale[0], "interval95": found.scale[1]},
        "check": check,
    }


def pose_object(pose: Transform | None) -> dict[str, Sequence[float]] | None:
    """Return a pose's translation and rotation as a mapping, for --json; None for no pose."""
    if pose is None:
        return None
    return {"translation": list(pose.translation), "rotation": list(pose.rotation)}


def _interval_object(interval: Interval | None) -> dict[str, list[float | None]] | None:
    if interval is None:
        return None
    return {
        "translation": list(interval.translation),
        "rotation_deg": list(interval.rotation_deg),
    }
