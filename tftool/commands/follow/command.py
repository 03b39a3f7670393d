"""Implementation of `tftool follow`: a turtle that follows a frame."""

from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.base.plain_text import visible
from tftool.base.stamps import Duration, as_seconds, seconds
from tftool.commands.follow import FollowOptions
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.notices import notice, tell_record
from tftool.geometry.motion import Gains
from tftool.world.link.session_world import Session
from tftool.world.log import PROBLEMS, LogRecord
from tftool.world.nodes.broadcasters import Broadcaster
from tftool.world.nodes.follower import Follower
from tftool.world.nodes.turtlesim import simulator_of

NAME = "turtle_following"


SETTLE = seconds(0.5)
"""Nanoseconds to listen to a joined session before a frame counts as missing."""


def _tell(record: LogRecord) -> None:
    """Print a log message of the follower node, or a warning or error of another node.

    Messages of the node "link" are omitted, because the session prints them.
    """
    if record.node == NAME or (record.level in PROBLEMS and record.node != "link"):
        tell_record(record)


async def _last(session: Session, follower: str, run_for: Duration | None) -> None:
    """Run the session for a duration; add a broadcaster for the follower if none exists.

    Args:
        session: Hosted or joined session.
        follower: Name of the turtle that follows.
        run_for: Nanoseconds to run; None for no end.
    """
    if not session.is_hosted:
        # Another process may broadcast the follower already: there must be one broadcaster.
        await session.lasting(SETTLE)
        if not session.world.buffer.frame_exists(follower):
            Broadcaster(session.world, f"broadcaster_{follower}", turtle=follower)
    await session.lasting(run_for)


def run(connection: Connection, options: FollowOptions) -> ExitStatus:
    """Run `tftool follow`: spawn a turtle and let it follow a frame."""
    connection.refuse_read_only("drive")
    session = open_session(
        connection,
        options.place,
        head_start=0,
        cache_time=options.cache_time,
        without=lambda node: node.kind == "follower",
        needs_turtles=True,
    )
    world = session.world
    if session.is_hosted and simulator_of(world) is None:
        raise UsageError(
            f"{session.name} has no turtle simulator, so {options.follower!r} cannot be spawned: "
            "choose another scenario, such as turtles."
        )
    if options.delay and options.delay >= world.buffer.cache_time:
        notice(
            f"The buffer keeps {as_seconds(world.buffer.cache_time):g} s, which is too short to "
            f"look up {visible(options.leader)} {as_seconds(options.delay):g} s ago: give "
            f"--cache-time {as_seconds(options.delay + options.period):g}."
        )
    world.log.listen(_tell, "console")
    Follower(
        world,
        NAME,
        leader=options.leader,
        follower=options.follower,
        period=options.period,
        delay=options.delay,
        fixed_frame=options.fixed_frame,
        distance_gains=Gains(
            options.kp_distance, options.ki_distance, options.kd_distance, options.integral_limit
        ),
        bearing_gains=Gains(
            options.kp_bearing, options.ki_bearing, options.kd_bearing, options.integral_limit
        ),
        dead_band=options.dead_band,
        speed_limit=options.max_speed,
        stale_after=options.stale_after,
    )
    broadcasters = [node.turtle for node in world.nodes if isinstance(node, Broadcaster)]
    if session.is_hosted and options.follower not in broadcasters:
        Broadcaster(world, f"broadcaster_{options.follower}", turtle=options.follower)
    notice(
        f"{visible(options.follower)} follows {visible(options.leader)}, with a lookup every "
        f"{as_seconds(options.period):g} s."
    )
    session.run(_last(session, options.follower, options.run_for))
    return ExitStatus.DONE
