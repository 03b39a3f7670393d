"""Implementation of `tftool calibrate`: find, compare, print, draw and write a mounting pose."""

import json
import math
import sys
from html import escape
from pathlib import Path
from typing import Final, NoReturn

import numpy as np

from tftool.base.errors import InputError, TransformException, UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import visible
from tftool.base.stamps import NANOSECONDS
from tftool.buffer.batch.transform_array import TransformArray
from tftool.buffer.buffer import Buffer
from tftool.commands.calibrate import CalibrateOptions
from tftool.commands.calibrate.mount_files import (
    MOUNT_FILES,
    PublishedMount,
    joint_to_change,
    write_mount,
)
from tftool.commands.shared.notices import notice
from tftool.commands.shared.options import refuse
from tftool.commands.shared.printer import line_width, write_file, write_json
from tftool.commands.shared.progress_bars import Bar
from tftool.drawing import calibration_view
from tftool.drawing import calibration_view as view
from tftool.frames.calibration.body_motion import (
    ANGLES,
    AXES,
    BodyMotion,
    CalibrationRefused,
    Floats,
    difference,
    poses_of,
)
from tftool.frames.calibration.calibrate import Calibration, calibrate
from tftool.frames.calibration.clock_offset import clock_offset, path_of
from tftool.frames.frames import Frames
from tftool.frames.pair_samples import links_between, sample
from tftool.geometry import rigid_arrays as batch
from tftool.opener import open_frames
from tftool.recordings.target import refuse_existing
from tftool.recordings.tf_topics import implying
from tftool.robots.robot_model import load_urdf

_WIDTH, _HEIGHT, _EDGE = 900.0, 240.0, 56.0
_MOST_POINTS: Final = 1500
_INKS: Final = ("#2452c9", "#c0392b", "#1e8449")
_STYLE: Final = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 940px; margin: 2em auto; padding: 0 1em; }
pre { background: #8882; padding: 1em; overflow-x: auto; }
svg { width: 100%; height: auto; } svg text { font-size: 12px; fill: currentColor; }
:root { color-scheme: light dark; }
"""

Curve = tuple[str, Floats, Floats]
"""Name of a curve, its x values, its y values."""


def page(calibration: Calibration, a: TransformArray, b: TransformArray) -> str:
    """Return the HTML page about the motions `a` and `b`: result, trajectories, residuals, axes."""
    parts = [f"<pre>{escape(calibration_view.lines(calibration))}</pre>"]
    first, second = BodyMotion.of(a), BodyMotion.of(b)
    if calibration.inverted[1]:
        second = second.inverted()
    if calibration.clock is not None:
        curve = calibration.clock.lags, calibration.clock.curve
        parts.append(_figure("Correlation of the rotations", "offset, s", "", [("", *curve)]))
    if calibration.mount is not None and calibration.fixed_mount is not None:
        parts += _aligned(calibration, first, second)
    title = visible(f"{calibration.moving[1]} on {calibration.moving[0]}")
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{escape(title)}</title>'
        f"<style>{_STYLE}</style><h1>Calibration: {escape(title)}</h1>{''.join(parts)}</html>\n"
    )


def _aligned(calibration: Calibration, a: BodyMotion, b: BodyMotion) -> list[str]:
    """Return HTML drawings of two motions, before and after their alignment.

    The drawings compare A · X with Y · B, which should be equal. A and B are the motions `a` and
    `b`, X is the mounting pose, and Y is the pose of B's fixed frame in A's fixed frame.
    """
    assert calibration.mount is not None
    assert calibration.fixed_mount is not None
    assert calibration.clock_offset is not None
    times = b.times + (calibration.clock_offset - (a.start - b.start) / NANOSECONDS)
    places, turns, valid = a.at(times)
    places, turns, times = places[valid], turns[valid], times[valid]
    count = len(times)

    def all_rows(values: tuple[float, ...]) -> Floats:
        return np.broadcast_to(np.array(values), (count, len(values)))

    mounted = places + batch.rotate(turns, all_rows(calibration.mount.translation))
    turned = batch.multiply(turns, all_rows(calibration.mount.rotation))
    join = all_rows(calibration.fixed_mount.rotation)
    seen = b.positions[valid]
    reached = batch.rotate(join, seen) + np.array(calibration.fixed_mount.translation)
    reached_turns = batch.multiply(join, b.rotations[valid])
    distances = np.linalg.norm(mounted - reached, axis=1) * 1e3
    angles = np.degrees(batch.angles_between(turned, reached_turns))
    spins = batch.rotation_vectors(batch.multiply(batch.conjugate(turns[:-10]), turns[10:]))
    degrees = np.degrees(spins)
    return [
        _figure("Before, from above", "x, m", "y, m", [
            ("A", places[:, 0], places[:, 1]), ("B", seen[:, 0], seen[:, 1]),
        ]),
        _figure("After: A · X and Y · B, from above", "x, m", "y, m", [
            ("A · X", mounted[:, 0], mounted[:, 1]), ("Y · B", reached[:, 0], reached[:, 1]),
        ]),
        _figure("Distance between them", "time, s", "mm", [("", times, distances)]),
        _figure("Angle between them", "time, s", "°", [("", times, angles)]),
        _figure("Turns about the axes of A, over ten poses of B", "time, s", "°", [
            (name, times[:-10], degrees[:, place]) for place, name in enumerate("xyz")
        ]),
    ]  # fmt: skip


def _figure(title: str, across: str, up: str, curves: list[Curve]) -> str:
    xs, ys = (np.concatenate([one[axis][np.isfinite(one[2])] for one in curves]) for axis in (1, 2))
    if not len(xs):
        return ""
    (left, right), (low, high) = _ends(xs), _ends(ys)

    def place(x: Floats, y: Floats) -> tuple[Floats, Floats]:
        return (
            _EDGE + (x - left) / (right - left) * (_WIDTH - 2 * _EDGE),
            _HEIGHT - 30.0 - (y - low) / (high - low) * (_HEIGHT - 50.0),
        )

    drawn = []
    for number, (name, x, y) in enumerate(curves):
        step = -(-len(x) // _MOST_POINTS)
        kept = np.isfinite(y[::step])
        h, v = place(x[::step][kept], y[::step][kept])
        points = " ".join(f"{one:.1f},{two:.1f}" for one, two in zip(h, v, strict=True))
        ink = _INKS[number % 3]
        drawn.append(f'<polyline points="{points}" fill="none" stroke="{ink}" stroke-width="1.3"/>')
        drawn.append(f'<text x="{_WIDTH - 70:.0f}" y="{30 + 16 * number}" fill="{ink}" '
                     f'style="fill: {ink}">{escape(name)}</text>')  # fmt: skip
    for value, column, row in (
        (left, _EDGE, _HEIGHT - 10),
        (right, _WIDTH - _EDGE, _HEIGHT - 10),
        (low, 4.0, _HEIGHT - 30),
        (high, 4.0, 26.0),
    ):
        drawn.append(f'<text x="{column:.0f}" y="{row:.0f}">{value:.4g}</text>')
    middle = _WIDTH / 2
    drawn.append(f'<text x="{middle:.0f}" y="{_HEIGHT - 10:.0f}">{escape(across)}</text>')
    drawn.append(f'<text x="4" y="{_HEIGHT / 2:.0f}">{escape(up)}</text>')
    return (
        f'<h2>{escape(title)}</h2><svg viewBox="0 0 {_WIDTH:.0f} {_HEIGHT:.0f}" role="img" '
        f'aria-label="{escape(title)}">{"".join(drawn)}</svg>'
    )


def _ends(values: Floats) -> tuple[float, float]:
    low, high = float(values.min()), float(values.max())
    return (low, high) if high > low else (low - 0.5, high + 0.5)


def run(options: CalibrateOptions) -> ExitStatus:
    """Run `tftool calibrate`: solve the calibration; print, compare, draw and write the result."""
    refuse(
        (
            len(options.places) > 2,
            "Two motions are needed: give one FROM that contains both, or one FROM for each.",
        ),
        (
            len(options.moving or []) > 2,
            "--moving can be given at most twice, once for each motion.",
        ),
        (
            options.time_only
            and (
                options.planar
                or options.scale
                or options.check
                or options.output is not None
                or options.report is not None
            ),
            "--time-only measures only the clock offset: leave out the options of the mount.",
        ),
        (
            options.joint is not None and options.output is None,
            "--joint is only allowed with -o FILE: add -o FILE.",
        ),
    )
    _refuse_outputs(options.output, options.report, options.urdf, force=options.force)
    opened = [
        open_frames(place, until=math.inf, no_cache=options.no_cache) for place in options.places
    ]
    try:
        _tell_faults(opened)
        chains = _chains(opened, options.moving or [])
        paths = [_path(*chain) for chain in chains]
        if options.time_only:
            return _print_clocks(paths, for_programs=options.for_programs)
        if options.output is not None and paths[0].child_frame_id == paths[1].child_frame_id:
            raise UsageError(
                f"Both motions have the moving frame '{paths[0].child_frame_id}': give the frames "
                "of each pose file other names with --frames PARENT:CHILD after the file."
            )
        robot = None if options.urdf is None else load_urdf(options.urdf)
        published = PublishedMount.of(robot, opened[0], paths, options.mounted)
        if options.check:
            published.refuse_without_mount()
        chosen = (
            None
            if options.output is None
            else joint_to_change(options.output, published, options.joint)
        )
        bar = Bar("Calibrating")
        try:
            found = calibrate(
                *paths,
                planar=options.planar,
                scale=options.scale,
                published=published.mount,
                seed=options.seed,
                progress=bar,
            )
        finally:
            bar.stop()
    finally:
        for frames in opened:
            frames.close()
    is_outside = _print(
        found, published if options.check else None, for_programs=options.for_programs
    )
    if options.report is not None:
        write_file(options.report, page(found, *paths))
        notice(visible(f"Wrote {options.report}."))
    if not found:
        return ExitStatus.FAILED
    if options.output is not None:
        for sentence in write_mount(options.output, found, published, chosen, options.urdf):
            notice(visible(sentence))
    return ExitStatus.FAILED if is_outside else ExitStatus.DONE


def _tell_faults(opened: list[Frames]) -> None:
    """Print how each file is read, and which of its contents are damaged, sorted or left out."""
    for frames in opened:
        for text in () if frames.found is None else frames.found.notices():
            notice(visible(text))
        if frames.recording is not None:
            for text in (*frames.recording.damage, *frames.recording.source.oddities):
                notice(visible(text))


def _refuse_outputs(
    output: Path | None, report: Path | None, urdf: Path | None, *, force: bool
) -> None:
    for path, wanted in ((output, MOUNT_FILES), (report, (".html",))):
        if path is not None:
            if not path.name.endswith(tuple(wanted)):
                raise UsageError(f"'{path}' has no known suffix: end it in {', '.join(wanted)}.")
            refuse_existing(path, force=force)
    if output is not None and output.suffix == ".urdf" and urdf is None:
        raise UsageError(
            "-o robot.urdf needs the robot description that is to be changed: add --urdf FILE."
        )


def _print(calibration: Calibration, checked: PublishedMount | None, *, for_programs: bool) -> bool:
    """Print a calibration; return whether the published mount is outside the result's interval."""
    outside, compared = ((), None) if checked is None else _compared(calibration, checked)
    if for_programs:
        written = json.dumps(view.as_object(calibration, compared), indent=2, allow_nan=False)
        sys.stdout.write(written + "\n")
        return bool(outside)
    sys.stdout.write(view.lines(calibration, line_width()))
    for sentence in outside:
        sys.stdout.write(f"{sentence}\n")
    if checked is not None and calibration and not outside:
        sys.stdout.write(
            "The published mount is inside of the interval, or differs from the result by at most "
            "1 mm and 0.1°.\n"
        )
    return bool(outside)


# Motions

Chain = tuple[Frames, str]
"""Frames of a file, and the value of --moving for a motion; empty for the file's only chain."""


def _chains(opened: list[Frames], values: list[str]) -> list[Chain]:
    """Return the file and the --moving value of each motion; "" for a value that was not given.

    Args:
        opened: One or two opened files.
        values: Values of --moving.

    Raises:
        UsageError: If a single file lacks two values, or one motion includes the published mount.
    """
    if len(opened) == 1:
        if len(values) != 2:
            raise UsageError(
                f"'{visible(opened[0].name)}' is the only FROM, so this source must contain both "
                "motions: give --moving FIXED:MOVING twice."
            )
        _refuse_shared_mount(opened[0].buffer, values)
        return [(opened[0], values[0]), (opened[0], values[1])]
    if len(values) == 1 and not _has(opened[0], values[0]) and _has(opened[1], values[0]):
        values = ["", *values]
    return list(zip(opened, [*values, "", ""][:2], strict=True))


def _has(frames: Frames, value: str) -> bool:
    """Return whether `frames` has the frames or the topic that a value of --moving names."""
    if value.startswith("/"):
        return frames.recording is not None and value in _topics(frames)
    return all(frames.buffer.frame_exists(name) for name in _pair(value))


def _topics(frames: Frames) -> list[str]:
    recording = frames.recording
    return [] if recording is None else [one.name for one in implying(recording.topics)]


def _refuse_shared_mount(buffer: Buffer, values: list[str]) -> None:
    """Raise UsageError if the transforms of one motion include the published mounting pose."""
    pairs = [_pair(word) for word in values if not word.startswith("/")]
    if len(pairs) < 2:
        return
    try:
        links = [links_between(buffer, *pair) for pair in pairs]
    except TransformException:
        return
    moving = [{one for one in side if not buffer.samples(one).is_static} for side in links]
    shared = sorted(moving[0] & moving[1])
    for word, path, (_, other) in zip(values, links, (pairs[1], pairs[0]), strict=True):
        below = next((one for one in path if buffer.parent(one) == other), None)
        if below is not None:
            _refuse_chain(word, other, below)
    if shared:
        _refuse_chain(values[1], buffer.parent(shared[0]) or "", shared[0])


def _refuse_chain(word: str, parent: str, child: str) -> NoReturn:
    raise UsageError(
        f"--moving {word} passes through {parent} → {child}: the result would be this "
        "published transform itself. Give two motions that were measured independently, such as a "
        "topic of Odometry (--moving /vo/odometry)."
    )


def _pair(word: str) -> tuple[str, str]:
    fixed, colon, moving = word.partition(":")
    if not (colon and fixed and moving):
        raise UsageError(
            f"--moving takes FIXED:MOVING, such as odom:base_link, or a /topic, not '{word}'."
        )
    return fixed, moving


def _path(frames: Frames, word: str) -> TransformArray:
    if not word:
        try:
            return path_of(frames)
        except InputError:
            raise UsageError(
                f"'{visible(frames.name)}' has several motions: name one motion with "
                "--moving FIXED:MOVING, or with --moving /TOPIC."
            ) from None
    if not word.startswith("/"):
        return sample(frames.buffer, *_pair(word)).answered()
    topics, recording = _topics(frames), frames.recording
    if recording is None or word not in topics:
        there = f"topics of these types: {', '.join(topics[:5]) or 'none'}"
        label = visible(frames.label)
        raise InputError(f"{label} has no topic '{word}' of type Odometry or PoseStamped; {there}.")
    edges = recording.source.transforms([word]).edges
    if not edges:
        raise InputError(f"'{word}' in {frames.label} has no messages.")
    edge = max(edges, key=len)
    return poses_of(edge)


def _print_clocks(paths: list[TransformArray], *, for_programs: bool) -> ExitStatus:
    try:
        found = clock_offset(*paths)
    except CalibrationRefused as refusal:
        if for_programs:
            sys.stdout.write(
                json.dumps(
                    {
                        "verdict": "refused",
                        "why": str(refusal),
                        "next_motion": refusal.next_motion or None,
                    }
                )
                + "\n"
            )
        else:
            sys.stdout.write(f"refused: {refusal}\nTo record next: {refusal.next_motion}.\n")
        return ExitStatus.FAILED
    if for_programs:
        write_json({"clock_offset": view.clock_object(found)}, indent=None)
    else:
        sys.stdout.write(
            f"Clock offset: t_A = t_B {found.seconds:+.6f} s ± {found.interval95 * 1e3:.2f} ms "
            f"(correlation {found.correlation:.3f})\n"
        )
    return ExitStatus.DONE


# The published mount


LEAST_DIFFERENCE: Final = (0.001, 0.1)
"""Metres and degrees by which a mount may always differ, even beyond its 95 % interval."""


def _compared(
    calibration: Calibration, published: PublishedMount
) -> tuple[list[str], dict[str, object] | None]:
    """Compare the published mount with the result: return the differences as sentences and data."""
    if published.mount is None or calibration.mount is None or calibration.interval95 is None:
        return [], None
    shift, turn = np.split(difference(calibration.mount, published.mount), 2)
    outside, told = [], []
    for names, values, widths, unit, factor, least in (
        (AXES, shift, calibration.interval95.translation, " mm", 1e3, LEAST_DIFFERENCE[0]),
        (ANGLES, turn, calibration.interval95.rotation_deg, "°", 1.0, LEAST_DIFFERENCE[1]),
    ):
        for name, value, width in zip(names, values, widths, strict=True):
            if width is not None and abs(value) > max(width, least):
                outside.append(name)
                told.append(
                    f"{published.name}: {name} differs by {value * factor:.1f}{unit} "
                    f"± {width * factor:.{1 if width * factor >= 0.1 else 2}f}{unit}"
                )
    seen = [
        one for one, width in zip(shift, calibration.interval95.translation, strict=True) if width
    ]
    return told, {
        "joint": published.name,
        "published": view.pose_object(published.mount),
        "differs": {"mm": math.hypot(*seen) * 1e3, "deg": float(np.linalg.norm(turn))},
        "outside": outside,
    }
