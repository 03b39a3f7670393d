"""The frames of FROM at one moment, with all that is known of them by then.

For commands that ask and are done (``tree``, ``explain``, ``doctor``)::

    def depth(
        connection: Connection,
        target: Annotated[str, typer.Argument(metavar="TARGET", help="...")],
        place: From = None,
        at: AtOption = None,
    ) -> ExitStatus:
        from tftool.commands.shared.observe import observe

        seen = observe(connection, place, at)
        seen.buffer.lookup_transform(target, "map", seen.moment)
        ...
        return ExitStatus.DONE

`From` and `AtOption` are in `cli.options`. A command that takes recordings only asks
`named(word).kind.is_recording`; one that plays scenarios only, `scenario_named(word)`.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from tftool.base.escaping import visible
from tftool.base.stamps import LATEST, Duration, Stamp, seconds
from tftool.buffer.sample import TransformStamped
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import (
    A_MOMENT,
    NO_SESSION,
    join_session,
    open_session,
    refuse_options_of_files,
    refuse_to_forget,
    refuse_to_share,
)
from tftool.commands.shared.notices import notice
from tftool.commands.shared.robot_at_rest import RobotAtRest
from tftool.frames.moment import At, checked_moment
from tftool.geometry.rigid import Transform
from tftool.opener import named
from tftool.recordings.find import Kind
from tftool.world.clock import run
from tftool.world.link.session_world import twins

if TYPE_CHECKING:
    from tftool.buffer.buffer import Buffer
    from tftool.buffer.sample import Snapshot

LISTEN = seconds(5)
"""How long a scenario is played before it is observed, as view_frames listens."""

LISTEN_LIVE = seconds(2)
"""How long a session that runs is listened to: enough for a rate."""


@dataclass(frozen=True, slots=True)
class Observed:
    """Frames up to a moment: no more of them come.

    Attributes:
        name: Where they are from, in sentences: "scenario 'turtles'".
        buffer: All that is known of them.
        epoch: The moment from which `--at` counts.
        now: The moment at which they are observed; ages are told against it.
        moment: The stamp that was asked for; 0, which means the latest, if none was.
        moving: Of a robot description, the frames whose joint moves; None for other frames.
    """

    name: str
    buffer: "Buffer"
    epoch: Stamp
    now: Stamp
    moment: Stamp = LATEST
    moving: frozenset[str] | None = None

    def snapshot(self) -> "Snapshot":
        """All frames as they were then, each at the latest moment of its chain."""
        return self.buffer.snapshot(self.now)

    def marks(self, snapshot: "Snapshot") -> dict[str, tuple[str, ...]]:
        """The frames that something is wrong with, and the ids of the doctor's checks.

        Args:
            snapshot: These frames, as `snapshot` gives them.
        """
        if self.moving is not None:
            return {}  # a description at rest sends nothing
        from tftool.doctor.frame_marks import marks

        return marks(self.buffer, snapshot)


def observe(
    connection: Connection,
    word: str | None = None,
    at: At | None = None,
    *,
    cache_time: Duration | None = None,
) -> Observed:
    """Give what is known of the frames of FROM at a moment.

    A recording is read up to that moment, to its end when none is given; a scenario is played
    on simulated time, for `LISTEN` when none is given; a session that runs is listened to for
    `LISTEN_LIVE`. A moment is never one of a session that runs.

    Args:
        connection: What the command's options say.
        word: What FROM names; None for the session that runs, else the turtle world.
        at: The moment; None for the latest.
        cache_time: How far back a simulated world's or session's buffer remembers.

    Raises:
        InputError: If the word names nothing, or it cannot be read.
        LinkError: If a session was asked for and there is none.
        UsageError: If the moment lies before the beginning or after the end.
    """
    found = None if word is None else named(word)
    if found is not None and found.kind is not Kind.SCENARIO:
        refuse_to_share(connection, word)
        refuse_to_forget(found, cache_time)
        stored = connection.open_stored(found)
        kind = "recording" if found.kind.is_recording else found.kind.value
        name, start = f"{kind} '{visible(stored.name)}'", stored.start
        moment = LATEST if at is None else checked_moment(at, name, start, stored.end - start)
        buffer = _up_to(stored.buffer, moment) if moment else stored.buffer
        moving = stored.moving if isinstance(stored, RobotAtRest) else None
        return Observed(name, buffer, start, moment or stored.end, moment, moving)
    refuse_options_of_files(connection, word)
    if word is None and at is None:
        joined = join_session(connection, cache_time=cache_time)
        if joined is not None:
            joined.run(joined.listened(LISTEN_LIVE))
            for sentence in twins(joined.world):
                notice(sentence)
            clock = joined.world.clock
            return Observed(joined.name, joined.world.buffer, clock.epoch, clock.now())
    session = open_session(
        connection,
        word,
        simulated=True,
        cache_time=cache_time,
        because=NO_SESSION if at is None else A_MOMENT,
    )
    end = checked_moment(
        at or At(LISTEN), session.name, session.world.clock.epoch, session.duration
    )
    world = session.world

    async def alive() -> None:
        await session.live(end)

    run(world.clock, alive())
    return Observed(
        session.name, world.buffer, world.clock.epoch, end, LATEST if at is None else end
    )


def _up_to(whole: "Buffer", moment: Stamp) -> "Buffer":
    """What of a buffer is stamped up to a moment; what holds at all times stays."""
    import numpy as np

    from tftool.buffer.buffer import Buffer

    frames = whole.frames()
    found = Buffer(whole.cache_time, max_frames=max(1, len(frames)))
    for frame in frames:
        # A recording of gigabytes need not be copied for one moment.
        if whole.lend(frame, found, moment):
            continue
        samples = whole.samples(frame)
        count = (
            len(samples)
            if samples.is_static
            else int(np.searchsorted(samples.stamps, moment, "right"))
        )
        links = list(zip(samples.parents[:count], samples.authorities[:count], strict=True))
        # A run of samples of one parent and sender goes in at once.
        starts = [row for row in range(count) if row == 0 or links[row] != links[row - 1]]
        for first, last in pairwise([*starts, count]):
            parent, authority = links[first]
            run = slice(first, last)
            if samples.is_static:
                row = samples.poses[first].tolist()
                pose = Transform(row[:3], row[3:])
                found.set_transform_static(TransformStamped(0, parent, frame, pose), authority)
            else:
                found.set_transforms(
                    parent,
                    frame,
                    samples.stamps[run],
                    samples.translations[run],
                    samples.rotations[run],
                    authority,
                )
    return found
