"""`tftool follow`: a turtle that follows a frame."""

from typing import TYPE_CHECKING, Annotated

import typer

from tftool.base.exit_status import ExitStatus
from tftool.base.stamps import Duration, as_seconds, seconds
from tftool.commands.shared.options import (
    CacheTime,
    RunFor,
    finite,
    not_negative,
    option,
    positive,
    seconds_option,
)

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Connection
    from tftool.world.link.session_world import Session
    from tftool.world.log import LogRecord

NAME = "turtle_following"

SETTLE = seconds(0.5)
"""How long a joined session is listened to before it counts as not having a frame."""


def follow(
    connection: "Connection",
    leader: Annotated[str, typer.Argument(metavar="[LEADER]", help="Frame to follow.")] = "turtle1",
    follower: Annotated[
        str, typer.Argument(metavar="[FOLLOWER]", help="Turtle to spawn and to steer.")
    ] = "turtle2",
    place: Annotated[
        str | None,
        typer.Argument(metavar="[FROM]", help="World to host: a scenario's name or file."),
    ] = None,
    period: Annotated[
        Duration, seconds_option("Time between two commands; 1 if not said.", panel=None)
    ] = seconds(1),
    delay: Annotated[
        Duration,
        seconds_option(
            "Go where the leader was so long ago: time travel.",
            check=not_negative,
            panel=None,
        ),
    ] = 0,
    fixed_frame: Annotated[
        str, option("Frame that stands still over the delay.", metavar="FRAME")
    ] = "world",
    kp_distance: Annotated[
        float, typer.Option(callback=finite, metavar="GAIN", help="Speed per metre of distance.")
    ] = 0.5,
    ki_distance: Annotated[
        float, typer.Option(callback=finite, metavar="GAIN", help="Speed per metre and second.")
    ] = 0.0,
    kd_distance: Annotated[
        float, typer.Option(callback=finite, metavar="GAIN", help="Speed per metre a second.")
    ] = 0.0,
    kp_bearing: Annotated[
        float,
        typer.Option(callback=finite, metavar="GAIN", help="Turn rate per radian of bearing."),
    ] = 1.0,
    ki_bearing: Annotated[
        float,
        typer.Option(callback=finite, metavar="GAIN", help="Turn rate per radian and second."),
    ] = 0.0,
    kd_bearing: Annotated[
        float, typer.Option(callback=finite, metavar="GAIN", help="Turn rate per radian a second.")
    ] = 0.0,
    integral_limit: Annotated[
        float | None,
        typer.Option(
            callback=not_negative, metavar="LIMIT", help="Most that an integral adds to a command."
        ),
    ] = None,
    dead_band: Annotated[
        float,
        typer.Option(
            metavar="METRES", callback=not_negative, help="Distance that counts as there."
        ),
    ] = 0.0,
    max_speed: Annotated[
        float | None,
        typer.Option(
            metavar="M/S", callback=positive, help="Most it drives; no limit if not said."
        ),
    ] = None,
    stale_after: Annotated[
        Duration | None,
        seconds_option(
            "Stop when what is known of the leader is older; never, if not said.", panel=None
        ),
    ] = None,
    run_for: RunFor = None,
    cache_time: CacheTime = None,
) -> ExitStatus:
    """Let FOLLOWER follow LEADER (the tutorial's turtle_following).

    Spawns FOLLOWER. Once a period it looks up where the leader is, as the follower sees
    it, and drives there. The defaults are the tutorial's.

    tftool follow
    tftool follow turtle1 turtle3
    tftool follow turtle1 turtle2 --delay 5        where turtle1 was 5 s ago
    """
    from tftool.base.errors import UsageError
    from tftool.base.escaping import visible
    from tftool.commands.shared.hosting import open_session
    from tftool.commands.shared.notices import notice
    from tftool.commands.shared.on_screen import simulator_of
    from tftool.geometry.motion.pid import Gains
    from tftool.world.nodes.broadcasters import Broadcaster
    from tftool.world.nodes.follower import Follower

    connection.refuse_read_only("drive")
    session = open_session(
        connection,
        place,
        head_start=0,
        cache_time=cache_time,
        without=lambda node: node.kind == "follower",
        needs_turtles=True,
        needs_messages=True,
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
        f"{visible(follower)} follows {visible(leader)}, looking every {as_seconds(period):g} s."
    )
    session.run(_last(session, follower, run_for))
    return ExitStatus.DONE


def _tell(record: "LogRecord") -> None:
    """Tell what the follower has to say, and what goes wrong; the link's the session tells."""
    from tftool.commands.shared.notices import tell_record
    from tftool.world.log import PROBLEMS

    if record.node == NAME or (record.level in PROBLEMS and record.node != "link"):
        tell_record(record)


async def _last(session: "Session", follower: str, run_for: Duration | None) -> None:
    """Let the world live for so long; a guest's follower is broadcast where it is not yet."""
    from tftool.world.nodes.broadcasters import Broadcaster

    if not session.is_hosted:
        # Another process may broadcast the follower already: two would be one too many.
        await session.lasting(SETTLE)
        if not session.world.buffer.frame_exists(follower):
            Broadcaster(session.world, f"broadcaster_{follower}", turtle=follower)
    await session.lasting(run_for)
