"""Evidence (the facts that the doctor judges) from a recording, a scenario or a session."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from tftool.base.errors import UsageError
from tftool.base.plain_text import visible
from tftool.base.stamps import Duration
from tftool.commands.shared.connection import WHOLE, Connection, open_from
from tftool.commands.shared.notices import notice
from tftool.doctor.evidence import Evidence, Scope, evidence_of_frames
from tftool.frames.frames import Frames
from tftool.frames.source_options import DescriptionOptions
from tftool.opener import named, scenario_named
from tftool.recordings.find import Kind
from tftool.scenario.doctor_expectations import NO_RULES, DoctorRules, rules_beside
from tftool.world.frame_listener import HeaderListener

if TYPE_CHECKING:
    from rich.text import Text

EVERYTHING = Scope()
"""Scope that covers a source completely."""


def evidence_from(
    connection: Connection,
    word: str | None,
    lasting: Duration | None = None,
    scope: Scope = EVERYTHING,
    look: "Callable[[Evidence], Sequence[Text]] | None" = None,
) -> Evidence:
    """Return the evidence about the frames of FROM.

    A recording is read completely, a scenario is played to its end, and a session is listened to.

    Args:
        connection: Connection of the command.
        word: FROM as typed; None for the running session or, if none runs, the turtle world.
        lasting: Nanoseconds to listen; None for the default.
        scope: Part of a recording to examine.
        look: Function that returns lines about the findings while a session is listened to.

    Raises:
        InputError: If the word names no source, or the source cannot be read.
        LinkError: If an option such as --join requires a session, but none runs.
        UsageError: If the word names a robot description, or if `scope` selects a part of a source
            that is not a recording.
    """
    kind = None if word is None else named(word).kind
    is_recording = kind is not None and kind.is_recording
    if not is_recording:
        refuse_part(scope)
    if kind is Kind.DESCRIPTION:
        shown = visible(word or "")
        raise UsageError(
            f"'{shown}' is a robot description, without published transforms: "
            f"'tftool doctor RECORDING --urdf {shown}' compares the two, "
            f"'tftool info {shown}' reports its mistakes."
        )
    if kind is Kind.STATICS:
        shown = visible(word or "")
        raise UsageError(
            f"'{shown}' has only static frames, which the doctor does not examine: "
            f"'tftool tree {shown}' shows its frames, 'tftool diff' compares them."
        )
    if is_recording:
        # A recording has its own duration, and --urdf is separate evidence, in `scope`.
        connection, lasting = replace(connection, robot=DescriptionOptions()), None
    # For a robot read by its address, the headers of other topics are evidence, too.
    heard = HeaderListener() if connection.reach.only_reads else None
    watch = None if heard is None else heard.begin

    def glance(frames: Frames) -> "Sequence[Text]":
        return () if look is None else look(evidence_of_frames(frames, scope))

    with open_from(
        connection, word, lasting, until=WHOLE, tells=False, watch=watch, look=glance
    ) as frames:
        evidence = evidence_of_frames(frames, scope)
    for text in () if frames.recording is None else frames.recording.source.oddities:
        notice(visible(text))
    return evidence if heard is None else replace(evidence, headers=heard.headers())


def refuse_part(scope: Scope) -> None:
    """Raise UsageError if `scope` selects a part, for a source that is not a recording."""
    if scope.tf_topics or scope.begin is not None or scope.end is not None:
        raise UsageError(
            "--tf-topic, --from and --to are only allowed for recordings: leave out these options."
        )


def rules_of(source: str | None) -> DoctorRules:
    """Return the doctor's settings for a source: in the scenario itself, or beside the recording.

    Raises:
        InputError: If the file cannot be read.
    """
    if source is None:
        return NO_RULES
    found = named(source)
    if found.kind is Kind.SCENARIO:
        return scenario_named(source).doctor
    rules, file = rules_beside(found.name)
    if file is not None:
        notice(f"Using the doctor's settings in {visible(str(file))}.")
    return rules
