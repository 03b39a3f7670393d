"""Command `tftool explain`: why a lookup succeeds or fails, link by link."""

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
        "Ask for the stamp of a message of this topic, when it arrived: the first one, "
        "or the nearest to --at or to the moment behind its @.",
        default="",
        metavar="TOPIC[@MOMENT]",
    )
    asked_at: At | None = moment_option(
        "When it is asked, as log time; if not said, when the message of that stamp "
        "arrived, else at the moment itself.",
        panel=None,
    )
    cache_time: CacheTime = None
    timeout: Duration = option(
        "How long the listener waits.", default=0, metavar="SECONDS", parser=duration(not_negative)
    )
    lasting: RunFor = None
    for_programs: Json = False
