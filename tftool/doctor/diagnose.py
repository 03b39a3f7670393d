"""The diagnosis in Python: of a recording, or of what a buffer holds."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from tftool.base.errors import without_frames
from tftool.base.stamps import CACHE_TIME, LATEST, Duration, Stamp
from tftool.buffer.buffer import Buffer
from tftool.doctor.buffer_evidence import of_buffer
from tftool.doctor.evidence import Material
from tftool.doctor.explanation import Explanation, traced
from tftool.doctor.findings import Finding
from tftool.doctor.judge import judge
from tftool.doctor.model import Model, Settings
from tftool.doctor.recording_evidence import described_by
from tftool.doctor.scope import Scope
from tftool.doctor.trace import Question

if TYPE_CHECKING:
    from tftool.recordings.recording import Recording


def diagnose(
    recording: "Recording | Buffer",
    *,
    select: Sequence[str] = (),
    ignore: Sequence[str] = (),
    cache_time: Duration = CACHE_TIME,
    urdf: str | Path | None = None,
) -> list[Finding]:
    """Say what is wrong with the frames.

    A buffer keeps neither log times nor messages: what needs them is not looked for.

    Args:
        recording: A recording, or a buffer.
        select: Ids or areas of checks to run; all where empty.
        ignore: Ids or areas to leave out.
        cache_time: How far back the listener that is thought of remembers, nanoseconds.
        urdf: A file with the robot's description; None for the one recorded, if any.

    Returns:
        What was found, by area, errors first. Findings with `because_of` are consequences.

    Raises:
        InputError: If nothing of the recording can be read.
        TypeError: If it is neither a recording nor a buffer.
        UsageError: If there is no such check or area, or the description needs xacro, which is
            not installed.
    """
    settings = Settings(cache_time=cache_time)
    scope = Scope(None if urdf is None else described_by(urdf))
    return list(judge(_material(recording, scope), settings, select=select, ignore=ignore).findings)


def explain(
    recording: "Recording | Buffer",
    target_frame: str,
    source_frame: str,
    time: Stamp = LATEST,
    *,
    asked_at: Stamp | None = None,
    cache_time: Duration = CACHE_TIME,
    timeout: Duration = 0,
) -> Explanation:
    """Say why a lookup answers or refuses, link by link.

    Args:
        recording: A recording, or a buffer.
        target_frame: The frame to express things in.
        source_frame: The frame they are given in.
        time: The moment, nanoseconds; 0 for the latest.
        asked_at: The log time at which it is asked; None for the arrival of the message of
            that stamp in the source frame, else the moment itself (of a buffer: now).
        cache_time: How far back the listener remembers, nanoseconds.
        timeout: How long it waits, nanoseconds.

    Raises:
        InputError: If nothing of the recording can be read.
        TypeError: If it is neither a recording nor a buffer.
    """
    settings = Settings(cache_time=cache_time)
    model = Model(_material(recording, Scope()), settings)
    if asked_at is None and not model.material.timed:
        asked_at = model.end
    return traced(model, Question(target_frame, source_frame, time, asked_at, settings, timeout))


def _material(recording: "Recording | Buffer", scope: Scope) -> Material:
    if not isinstance(recording, Buffer):
        if not hasattr(recording, "source"):
            raise without_frames(recording)
        return scope.material(recording)
    material = of_buffer(recording)
    if scope.described is None:
        return material
    return replace(material, robot=scope.described.robot, mistakes=scope.described.mistakes)
