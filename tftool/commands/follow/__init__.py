"""Command `tftool follow`: a turtle that follows a frame."""

from tftool.base.stamps import Duration, seconds
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    CacheTime,
    RunFor,
    argument,
    finite,
    not_negative,
    option,
    positive,
    seconds_option,
)


class FollowOptions(Command):
    """Let FOLLOWER follow LEADER (the tutorial's turtle_following).

    The command spawns the turtle FOLLOWER. Once a period, the turtle looks up the leader in its own
    frame, and drives there. The defaults are the tutorial's.

    tftool follow
    tftool follow turtle1 turtle3
    tftool follow turtle1 turtle2 --delay 5        where turtle1 was 5 s ago
    """

    leader: str = argument("Frame to follow.", default="turtle1", metavar="[LEADER]")
    follower: str = argument(
        "Turtle to spawn and to drive.", default="turtle2", metavar="[FOLLOWER]"
    )
    place: str | None = argument("Scenario to host: its name or file.", metavar="[FROM]")
    period: Duration = seconds_option(
        "Time between two commands; 1 if not given.", default=seconds(1), panel=None
    )
    delay: Duration = seconds_option(
        "Drive to where the leader was SECONDS ago (the tutorial's time travel).",
        default=0,
        check=not_negative,
        panel=None,
    )
    fixed_frame: str = option(
        "With --delay: frame that does not move during the delay.", default="world", metavar="FRAME"
    )
    kp_distance: float = option(
        "Proportional gain of the speed: m/s per metre of distance.",
        default=0.5,
        callback=finite,
        metavar="GAIN",
    )
    ki_distance: float = option(
        "Integral gain of the speed: m/s per metre of distance and second.",
        default=0.0,
        callback=finite,
        metavar="GAIN",
    )
    kd_distance: float = option(
        "Derivative gain of the speed: m/s for each m/s by which the distance changes.",
        default=0.0,
        callback=finite,
        metavar="GAIN",
    )
    kp_bearing: float = option(
        "Proportional gain of the turn rate: rad/s per radian of bearing.",
        default=1.0,
        callback=finite,
        metavar="GAIN",
    )
    ki_bearing: float = option(
        "Integral gain of the turn rate: rad/s per radian of bearing and second.",
        default=0.0,
        callback=finite,
        metavar="GAIN",
    )
    kd_bearing: float = option(
        "Derivative gain of the turn rate: rad/s for each rad/s by which the bearing changes.",
        default=0.0,
        callback=finite,
        metavar="GAIN",
    )
    integral_limit: float | None = option(
        "Limit on the part of a command that the integral gains contribute.",
        callback=not_negative,
        metavar="LIMIT",
    )
    dead_band: float = option(
        "Distance to the leader at which the follower stops.",
        default=0.0,
        metavar="METRES",
        callback=not_negative,
    )
    max_speed: float | None = option(
        "Largest speed of the follower; if not given, there is no limit.",
        metavar="M/S",
        callback=positive,
    )
    stale_after: Duration | None = seconds_option(
        "Stop when the leader's newest transform is older than SECONDS; if not given, never.",
        panel=None,
    )
    run_for: RunFor = None
    cache_time: CacheTime = None
