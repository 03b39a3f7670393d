"""`tftool explain`: why one lookup answers or refuses, link by link."""

import json
import sys
from typing import TYPE_CHECKING, Annotated

import typer

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import LATEST, Duration, seconds
from tftool.commands.shared.options import (
    AtOption,
    CacheTime,
    From,
    Json,
    RunFor,
    Source,
    Target,
    duration,
    moment,
    moment_option,
    not_negative,
    option,
)
from tftool.frames.moment import At

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Connection
    from tftool.recordings.find import Found


def explain(
    connection: "Connection",
    target: Target,
    source: Source,
    place: From = None,
    at: AtOption = None,
    message: Annotated[
        str,
        option(
            "Ask for the stamp of a message of this topic, when it arrived: the first one, "
            "or the nearest to --at or to the moment behind its @.",
            metavar="TOPIC[@MOMENT]",
        ),
    ] = "",
    asked_at: Annotated[
        At | None,
        moment_option(
            "When it is asked, as log time; if not said, when the message of that stamp "
            "arrived, else at the moment itself.",
            panel=None,
        ),
    ] = None,
    cache_time: CacheTime = None,
    timeout: Annotated[
        Duration,
        typer.Option(
            metavar="SECONDS", parser=duration(not_negative), help="How long the listener waits."
        ),
    ] = 0,
    lasting: RunFor = None,
    for_programs: Json = False,
) -> ExitStatus:
    """Say why a lookup refuses: which link, by how much, and what would let it through.

    A listener is imagined that holds what had arrived when it asks. The exit status is 0
    when the lookup answers, 4 when it does not.

    tftool explain odom base_scan run.mcap --message /scan@4.25
    tftool explain map base_link run.mcap --at 12.5 --cache-time 5
    tftool explain base_link tool0 robot.urdf --joint elbow=0.5
    """
    # Heavy imports wait until this command is the chosen one.
    from tftool.commands.shared.evidence_sources import LIVE, material_of
    from tftool.commands.shared.pairs import refuse_file_as_frame
    from tftool.commands.shared.printer import write
    from tftool.doctor.explanation import over_time, traced
    from tftool.doctor.model import Model, Settings
    from tftool.doctor.trace import Question, message_of
    from tftool.drawing import explanation_view as view
    from tftool.opener import named
    from tftool.recordings.find import Kind

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
        sys.stdout.write(json.dumps(view.as_object(found), indent=2, allow_nan=False) + "\n")
    else:
        write(view.render(found))
    return ExitStatus.DONE if found.available else ExitStatus.NO_TRANSFORM


def _described(
    connection: "Connection", found: "Found", target: str, source: str, *, for_programs: bool
) -> ExitStatus:
    """The same in a robot description, joint by joint."""
    from tftool.commands.shared.printer import write
    from tftool.commands.shared.robot_at_rest import load_described, tell_beyond
    from tftool.doctor.joint_chain import chained
    from tftool.drawing import joint_chain_view as view

    robot = load_described(found, connection.robot)
    told = chained(robot, connection.robot.joints, target, source, found.name)
    tell_beyond(robot, connection.robot.joints)
    if for_programs:
        sys.stdout.write(json.dumps(view.as_object(told), indent=2, allow_nan=False) + "\n")
    else:
        write(view.render(told))
    return ExitStatus.DONE if told.available else ExitStatus.NO_TRANSFORM
