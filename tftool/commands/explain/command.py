"""`tftool explain`: why one lookup answers or refuses, link by link."""

import json
import sys

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import LATEST, seconds
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.evidence_sources import LIVE, material_of
from tftool.commands.shared.options import moment
from tftool.commands.shared.pairs import refuse_file_as_frame
from tftool.commands.shared.printer import write
from tftool.commands.shared.robot_at_rest import load_described, tell_beyond
from tftool.doctor.explanation import over_time, traced
from tftool.doctor.joint_chain import chained
from tftool.doctor.model import Model, Settings
from tftool.doctor.trace import Question, message_of
from tftool.drawing import explanation_view, joint_chain_view
from tftool.frames.moment import At
from tftool.opener import named
from tftool.recordings.find import Found, Kind


def _described(
    connection: Connection, found: Found, target: str, source: str, *, for_programs: bool
) -> ExitStatus:
    """The same in a robot description, joint by joint."""
    robot = load_described(found, connection.robot)
    told = chained(robot, connection.robot.joints, target, source, found.name)
    tell_beyond(robot, connection.robot.joints)
    if for_programs:
        sys.stdout.write(
            json.dumps(joint_chain_view.as_object(told), indent=2, allow_nan=False) + "\n"
        )
    else:
        write(joint_chain_view.render(told))
    return ExitStatus.DONE if told.available else ExitStatus.NO_TRANSFORM


def run(
    connection: Connection,
    target: str,
    source: str,
    place: str | None,
    at: At | None,
    message: str,
    asked_at: At | None,
    cache_time: int | None,
    timeout: int,
    lasting: int | None,
    for_programs: bool,
) -> ExitStatus:
    """Run `tftool explain`; the parameters are its options."""
    # Heavy imports wait until this command is the chosen one.

    refuse_file_as_frame(target, source, place)
    origin = None if place is None else named(place)
    if origin is not None and origin.kind is Kind.DESCRIPTION:
        if message or asked_at is not None:
            raise UsageError(
                "A robot description holds at all times and has no messages: leave out --message "
                "and --asked-at."
            )
        return _described(connection, origin, target, source, for_programs=for_programs)
    connection.robot.refuse("Only a robot description has joints to set and arguments")

    topic, _, behind = message.partition("@")
    if behind and at is not None:
        raise UsageError(f"--message {message} names a moment already: leave out --at.")
    if behind:
        at = moment(behind)
    settings = Settings(cache_time=cache_time or seconds(10))
    model = Model(material_of(connection, place, lasting), settings)
    stamp = LATEST if at is None else at.stamp(model.epoch)
    if topic:
        heard, stamp = message_of(model, topic, stamp or None)
        source = source or heard.frame
    question = Question(
        target,
        source,
        stamp,
        None if asked_at is None else asked_at.stamp(model.start),
        settings,
        timeout,
        topic,
    )
    found = traced(model, question)
    if model.evidence.kind == LIVE:
        found = over_time(model, question, found)
    if for_programs:
        sys.stdout.write(
            json.dumps(explanation_view.as_object(found), indent=2, allow_nan=False) + "\n"
        )
    else:
        write(explanation_view.render(found))
    return ExitStatus.DONE if found.available else ExitStatus.NO_TRANSFORM
