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
    """Say why a lookup fails: which link, by how much, and how to make it succeed.

    A link is the transform from a frame to its parent. The lookup uses the samples that a listener
    had received at that moment. The exit status is 0 if the lookup succeeds, 4 if it fails.

    tftool explain odom base_scan run.mcap --message /scan@4.25
    tftool explain map base_link run.mcap --at 12.5 --cache-time 5
    tftool explain base_link tool0 robot.urdf --joint elbow=0.5
    """

    target: Target
    source: Source
    place: From = None
    at: AtOption = None
    message: str = option(
        "Look up at the stamp of a message of this topic, with the data received until the message "
        "arrived. The message nearest to MOMENT or --at is used; without a time, the first.",
        default="",
        metavar="TOPIC[@MOMENT]",
    )
    asked_at: At | None = moment_option(
        "Time on the log's clock at which the listener looks up; if not given, the arrival of the "
        "message; without --message, the time of --at.",
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
