"""Command `tftool explain`: why a lookup succeeds or fails, transform by transform."""

from tftool.base.stamps import Duration
from tftool.commands.shared.declaration import Command
from tftool.commands.shared.options import (
    AtOption,
    CacheTime,
    From,
    Json,
    RunFor,
    Source,
    Target,
    duration,
    moment_option,
    not_negative,
    option,
)
from tftool.frames.source_options import At


class ExplainOptions(Command, looks_only=True, recordings=True, descriptions=True):
    """Say why a lookup refuses: which link, by how much, and what would let it through.

    The lookup uses the samples that a listener had received at that moment. The exit status is 0 if
    the lookup answers, 4 if it does not.

    tftool explain odom base_scan run.mcap --message /scan@4.25
    tftool explain map base_link run.mcap --at 12.5 --cache-time 5
    tftool explain base_link tool0 robot.urdf --joint elbow=0.5
    """

    target: Target
    source: Source
    place: From = None
    at: AtOption = None
    message: str = option(
        "Look up at the stamp of a message of this topic, as of its arrival: the first message, "
        "or the one nearest to --at or to the moment after @.",
        default="",
        metavar="TOPIC[@MOMENT]",
    )
    asked_at: At | None = moment_option(
        "Log time at which the listener asks; if not given, the arrival of the message, or "
        "without --message the moment of --at.",
        panel=None,
    )
    cache_time: CacheTime = None
    timeout: Duration = option(
        "Time that the listener waits for the transform.",
        default=0,
        metavar="SECONDS",
        parser=duration(not_negative),
    )
    lasting: RunFor = None
    for_programs: Json = False
