"""`tftool follow`: a turtle that follows a frame."""

from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import Duration, as_seconds, seconds
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.notices import notice, tell_record
from tftool.commands.shared.on_screen import simulator_of
from tftool.geometry.motion.pid import Gains
from tftool.world.link.session_world import Session
from tftool.world.log import PROBLEMS, LogRecord
from tftool.world.nodes.broadcasters import Broadcaster
from tftool.world.nodes.follower import Follower

NAME = "turtle_following"


SETTLE = seconds(0.5)
"""How long a joined session is listened to before it counts as not having a frame."""


def _tell(record: LogRecord) -> None:
    """Print the follower's log and its errors; the session prints those of the connection."""
    if record.node == NAME or (record.level in PROBLEMS and record.node != "link"):
        tell_record(record)


async def _last(session: Session, follower: str, run_for: Duration | None) -> None:
    """Run the world for a duration; broadcast a guest's follower if nobody does yet."""
    if not session.is_hosted:
        # Another process may broadcast the follower already: two would be one too many.
        await session.lasting(SETTLE)
        if not session.world.buffer.frame_exists(follower):
            Broadcaster(session.world, f"broadcaster_{follower}", turtle=follower)
    await session.lasting(run_for)


def run(
    connection: Connection,
    leader: str,
    follower: str,
    place: str | None,
    period: int,
    delay: int,
    fixed_frame: str,
    kp_distance: float,
    ki_distance: float,
    kd_distance: float,
    kp_bearing: float,
    ki_bearing: float,
    kd_bearing: float,
    integral_limit: float | None,
    dead_band: float,
    max_speed: float | None,
    stale_after: int | None,
    run_for: int | None,
    cache_time: int | None,
) -> ExitStatus:
    """Run `tftool follow`; the parameters are its options."""
    connection.refuse_read_only("drive")
    session = open_session(
        connection,
        place,
        head_start=0,
        cache_time=cache_time,
        without=lambda node: node.kind == "follower",
        needs_turtles=True,
    )
    world = session.world
    if session.is_hosted and simulator_of(world) is None:
        raise UsageError(f"{session.name} has no turtles: nothing there can spawn {follower!r}.")
    if delay and delay >= world.buffer.cache_time:
        notice(
            f"The buffer remembers {as_seconds(world.buffer.cache_time):g} s, so where "
            f"{visible(leader)} was {as_seconds(delay):g} s ago is forgotten: --cache-time "
            f"{as_seconds(delay + period):g} remembers it."
        )
    world.log.listen(_tell, "console")
    Follower(
        world,
        NAME,
        leader=leader,
        follower=follower,
        period=period,
        delay=delay,
        fixed_frame=fixed_frame,
        distance_gains=Gains(kp_distance, ki_distance, kd_distance, integral_limit),
        bearing_gains=Gains(kp_bearing, ki_bearing, kd_bearing, integral_limit),
        dead_band=dead_band,
        speed_limit=max_speed,
        stale_after=stale_after,
    )
    broadcasters = [node.turtle for node in world.nodes if isinstance(node, Broadcaster)]
    if session.is_hosted and follower not in broadcasters:
        Broadcaster(world, f"broadcaster_{follower}", turtle=follower)
    notice(
        f"{visible(follower)} follows {visible(leader)}, with a lookup every "
        f"{as_seconds(period):g} s."
    )
    session.run(_last(session, follower, run_for))
    return ExitStatus.DONE
