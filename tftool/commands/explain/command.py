"""Implementation of `tftool explain`: why a lookup succeeds or fails, transform by transform."""

from typing import TYPE_CHECKING, Any

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import visible
from tftool.base.stamps import LATEST, Stamp, seconds
from tftool.commands.explain import ExplainOptions
from tftool.commands.shared.connection import Connection, open_from
from tftool.commands.shared.evidence_sources import evidence_from
from tftool.commands.shared.notices import notice
from tftool.commands.shared.options import moment
from tftool.commands.shared.pairs import refuse_file_as_frame
from tftool.commands.shared.printer import write, write_json
from tftool.doctor.evidence import LIVE, Evidence
from tftool.doctor.explanation import over_time, traced
from tftool.doctor.joint_chain import chained
from tftool.doctor.model import Model, Settings
from tftool.doctor.trace import Question, message_of
from tftool.drawing import explanation_view, joint_chain_view
from tftool.frames.source_options import At, checked_moment
from tftool.opener import named
from tftool.recordings.find import Kind

if TYPE_CHECKING:
    from rich.text import Text


def run(connection: Connection, options: ExplainOptions) -> ExitStatus:
    """Run `tftool explain`: print why a lookup succeeds or fails."""
    source, at = options.source, options.at
    refuse_file_as_frame(options.target, source, options.place)
    if options.place is not None and named(options.place).kind is Kind.DESCRIPTION:
        if options.message or options.asked_at is not None:
            raise UsageError(
                "A robot description contains no times and no messages: leave out --message and "
                "--asked-at."
            )
        return _explain_joints(
            connection, options.place, (options.target, source), for_programs=options.for_programs
        )
    connection.robot.refuse("Only a robot description has joints and arguments")
    topic, _, behind = options.message.partition("@")
    if behind and at is not None:
        raise UsageError(
            f"--message {options.message} already contains a moment, after the @: leave out --at."
        )
    if behind:
        at = moment(behind)
    settings = Settings(cache_time=options.cache_time or seconds(10))

    def look(evidence: Evidence) -> "list[Text]":
        asked = Question(options.target, source, LATEST, None, settings, options.timeout, topic)
        return explanation_view.so_far(traced(Model(evidence, settings), asked))

    evidence = evidence_from(
        connection, options.place, options.lasting, look=None if topic else look
    )
    for text in evidence.damage:
        notice(visible(text))
    model = Model(evidence, settings)
    stamp = LATEST if at is None else _moment(model, at)
    if topic:
        heard, stamp = message_of(model, topic, stamp or None)
        source = source or heard.frame
    asked = None if options.asked_at is None else options.asked_at.stamp(model.start)
    question = Question(options.target, source, stamp, asked, settings, options.timeout, topic)
    found = traced(model, question)
    if model.evidence.kind == LIVE:
        found = over_time(model, question, found)
    _print(explanation_view, found, for_programs=options.for_programs)
    return ExitStatus.DONE if found.available else ExitStatus.NO_TRANSFORM


def _moment(model: Model, at: At) -> Stamp:
    """Return the stamp of a time, which may be after the end, as may be the time of a lookup.

    Raises:
        UsageError: If the time is after the end, and was probably meant as a stamp.
    """
    evidence, epoch = model.evidence, model.epoch
    if evidence.kind != LIVE:
        stamps = (int(one.sorted_stamps[-1]) for one in model.dynamic if len(one.sorted_stamps))
        # Messages may continue after the last transform.
        last = max([*stamps, epoch + evidence.end - evidence.start])
        if at.meant(epoch, last):
            name = visible(evidence.name)
            title = f"recording '{name}'" if evidence.recorded else name
            return checked_moment(at, title, epoch, last - epoch)
    return at.stamp(epoch)


def _explain_joints(
    connection: Connection, description: str, frames: tuple[str, str], *, for_programs: bool
) -> ExitStatus:
    """Print why a lookup in a robot description succeeds or fails, joint by joint."""
    opened = open_from(connection, description, tells=False)
    robot, joints = opened.robot, connection.robot.joints
    assert robot is not None
    told = chained(robot, joints, *frames, description)
    for note in (*robot.notes, *robot.beyond_limits(joints)):
        notice(visible(note))
    _print(joint_chain_view, told, for_programs=for_programs)
    return ExitStatus.DONE if told.available else ExitStatus.NO_TRANSFORM


def _print(view: Any, found: Any, *, for_programs: bool) -> None:
    if for_programs:
        write_json(view.as_object(found))
    else:
        write(view.render(found))
