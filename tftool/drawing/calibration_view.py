"""Results of a sensor's calibration (mounting pose, clock offset), as text lines and as JSON."""

import math
from collections.abc import Sequence

from tftool.base.plain_text import visible
from tftool.drawing.recording_view import wrapped
from tftool.frames.calibration.calibrate import Calibration, Interval, Trio
from tftool.frames.calibration.clock_offset import ClockOffset
from tftool.geometry.conversions import rpy_from_quaternion
from tftool.geometry.rigid import Transform


def lines(calibration: Calibration, width: int | None = None) -> str:
    """Return a calibration as text: mounting pose in tf2's format, clock offset, verdict.

    Args:
        calibration: The calibration.
        width: Maximum length of a line in cells; None for no limit.
    """
    text: list[str] = []
    moving, fixed = (
        [visible(name) for name in names] for names in (calibration.moving, calibration.fixed)
    )
    if moving[0] == moving[1]:
        moving = [f"{name} of {side}" for name, side in zip(moving, "AB", strict=True)]
    if fixed[0] == fixed[1]:
        fixed = [f"{name} of {side}" for name, side in zip(fixed, "AB", strict=True)]
    for title, pose, interval in (
        (f"Mount: {moving[1]} in {moving[0]}", calibration.mount, calibration.interval95),
        (
            f"Fixed frames: {fixed[1]} in {fixed[0]}",
            calibration.fixed_mount,
            calibration.fixed_interval95,
        ),
    ):
        if pose is not None and interval is not None:
            text += [title, *_pose(pose, interval), ""]
    if calibration.clock_offset is not None:
        text.append(_clock(calibration))
    if calibration.scale is not None:
        text.append(f"Scale of A: {calibration.scale[0]:.5f} ± {calibration.scale[1]:.5f}")
    if calibration.halves_differ is not None:
        metres, degrees = calibration.halves_differ
        text.append(f"Halves of the recording differ by {metres * 1e3:.1f} mm, {degrees:.2f}°")
    for note in calibration.notes:
        text += wrapped(visible(note), width)
    text += wrapped(f"{calibration.verdict}: {visible(calibration.why)}", width)
    if calibration.next_motion:
        text += wrapped(f"To record next: {calibration.next_motion}.", width)
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


def clock_object(offset: ClockOffset) -> dict[str, float | None]:
    """Return a clock offset as a mapping, for --json."""
    return {
        "seconds": offset.seconds,
        "interval95": offset.interval95,
        "correlation": offset.correlation,
        "second_peak": offset.second,
    }


def as_object(
    calibration: Calibration, check: dict[str, object] | None = None
) -> dict[str, object]:
    """Return a calibration as a mapping, for --json.

    Args:
        calibration: The calibration.
        check: Comparison with the published mounting pose; None if none is published.
    """
    clock = None
    if calibration.clock_offset is not None and calibration.clock is not None:
        clock = {
            "seconds": calibration.clock_offset,
            "interval95": calibration.offset_interval95,
            "correlation": calibration.clock.correlation,
            "drift_ppm": calibration.drift_ppm,
        }
    halves = calibration.halves_differ
    return {
        "verdict": calibration.verdict,
        "why": calibration.why,
        "moving": list(calibration.moving),
        "fixed": list(calibration.fixed),
        "mount": pose_object(calibration.mount),
        "fixed_mount": pose_object(calibration.fixed_mount),
        "interval95": _interval_object(calibration.interval95),
        "fixed_interval95": _interval_object(calibration.fixed_interval95),
        "clock_offset": clock,
        "halves_differ": None if halves is None else {"mm": halves[0] * 1e3, "deg": halves[1]},
        "unseen": list(calibration.unseen),
        "unseen_direction": None
        if calibration.unseen_direction is None
        else list(calibration.unseen_direction),
        "inverted": list(calibration.inverted),
        "next_motion": calibration.next_motion,
        "scale": None
        if calibration.scale is None
        else {"value": calibration.scale[0], "interval95": calibration.scale[1]},
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
