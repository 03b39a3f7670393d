"""Where `doctor` and `explain` get what they look at: a recording, a scenario, a session."""

from dataclasses import replace
from typing import TYPE_CHECKING

from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.base.stamps import Duration
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import NO_SESSION, join_session, open_session
from tftool.commands.shared.notices import notice, tell_listening
from tftool.commands.shared.observe import LISTEN
from tftool.commands.shared.options import LISTENING
from tftool.doctor.evidence import Evidence, Scope, evidence_of_log, evidence_of_recording
from tftool.opener import named, scenario_named
from tftool.recordings.find import Kind
from tftool.scenario.doctor_expectations import NO_RULES, DoctorRules, heard_in, rules_beside
from tftool.world.link.session_world import Session

if TYPE_CHECKING:
    from tftool.base.stamps import Stamp

WHOLE = Scope()
"""All of a source."""

LIVE = "live session"
"""The kind of what a session that runs gives."""


def material_of(
    connection: Connection,
    word: str | None,
    lasting: Duration | None = None,
    scope: Scope = WHOLE,
) -> Evidence:
    """What is known of the frames that FROM names.

    A recording is read whole, a scenario played on simulated time, a session listened to.

    Args:
        connection: What the command's options say.
        word: What FROM names; None for the session that runs, else the turtle world.
        lasting: How long to listen, nanoseconds; the usual time when None.
        scope: What of a recording is looked at.

    Raises:
        InputError: If the word names nothing, or it cannot be read.
        LinkError: If a session was asked for and there is none.
        UsageError: If the word names a robot description, or what is no recording is to be
            looked at in part.
    """
    found = None if word is None else named(word)
    if found is not None and found.kind.is_recording:
        from tftool.commands.shared import recorded

        with recorded.read(found, options=connection.recording) as recording:
            return evidence_of_recording(recording, scope)
    if scope.tf_topics or scope.begin is not None or scope.end is not None:
        raise UsageError("--tf-topic, --from and --to are for recordings.")
    if found is not None and found.kind is Kind.DESCRIPTION:
        raise UsageError(
            f"'{visible(found.name)}' is a robot description, which publishes nothing to judge: "
            f"'tftool doctor RECORDING --urdf {visible(found.name)}' compares the two, "
            f"'tftool info {visible(found.name)}' reports its mistakes."
        )
    if found is not None and found.kind is Kind.STATICS:
        raise UsageError(
            f"'{visible(found.name)}' holds what never changes: "
            f"'tftool tree {visible(found.name)}' shows its frames, 'tftool diff' compares them."
        )
    if word is None:
        session = join_session(connection)
        if session is not None:
            lasting = lasting or LISTENING
            tell_listening(lasting)
            return _described(_heard(session, lasting, LIVE), scope)
    session = open_session(connection, word, simulated=True, because=NO_SESSION)
    whole = session.duration or LISTEN
    return _described(_heard(session, lasting or whole, "scenario"), scope)


def _described(material: Evidence, scope: Scope) -> Evidence:
    """What was heard, beside the description that was given."""
    if scope.described is None:
        return material
    return replace(material, robot=scope.described.robot, mistakes=scope.described.mistakes)


def _heard(session: Session, lasting: Duration, kind: str) -> Evidence:
    """Listen to a world for `lasting` nanoseconds."""
    world = session.world
    hearing, stops = heard_in(world)
    began: Stamp = world.clock.now()
    try:
        session.run(session.listened(lasting))
    finally:
        for stop in stops:
            stop()
    return evidence_of_log(hearing, session.name, kind, began, world.clock.now())


def rules_of(word: str | None) -> DoctorRules:
    """What a scenario, or the list beside a recording, asks of the doctor.

    Raises:
        InputError: If it cannot be read.
    """
    if word is None:
        return NO_RULES
    found = named(word)
    if found.kind is Kind.SCENARIO:
        return scenario_named(word).doctor
    rules, file = rules_beside(found.name)
    if file is not None:
        notice(f"Following {visible(str(file))}.")
    return rules
