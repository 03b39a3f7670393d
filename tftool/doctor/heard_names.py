"""Checks of frame names in messages: frames that tf lacks, and names with a slash."""

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence

from tftool.base.plain_text import near_names
from tftool.doctor.check import checks_of, threads
from tftool.doctor.findings import Area, Fix, Hit, Severity
from tftool.doctor.missing_joins import (
    distinctive_words,
    has_base,
    is_world,
    proposed_frame,
)
from tftool.doctor.model import LAP, Limits, Model
from tftool.doctor.name_checks import distance
from tftool.doctor.stamp_stream import BASES, PLACED, Heard, last_part
from tftool.doctor.wording import is_ros1, several, span

check = checks_of(Area.NAMES)


@check(
    "unknown-frame",
    Severity.ERROR,
    rule="the frame of a message with a position, or of a message of a robot's own type, is in no "
    "transform of the whole recording. A "
    "warning if none of the messages is a scan, a point cloud or a range, which costmaps and "
    "maps have to place, or if tf has no base frame. A note if none of the messages comes "
    "from a sensor, or if only the frame of a localiser or of the earth is unknown. A note "
    "also if the messages are raw input of a localiser: tf has no robot, and their node also "
    "sends other messages in the frame; and if all transforms are single (TransformStamped)",
    headline="no transform names {named}",
    detail="{frame}: {says}{hint}",
    consequence="none of these messages can be placed anywhere",
    causes=(
        "a simulator's scoped name (robot/base_link/gpu_lidar)",
        "the driver's default frame_id (laser, imu) against the robot description's",
        "a prefix applied twice",
        "a static that was never published",
    ),
    links=threads("Ekumen-OS/andino_gz#43", "ros2/ros2_documentation#5222", "osrf/vrx#876"),
    needs=("headers",),
    why="lookups of a frame that is in no transform fail at every time",
    because_of=(("frame", "static-missing slash-twins namespace-twins case-twins typo-twins"),),
)
def unknown_frame(model: Model, limits: Limits) -> Iterator[Hit]:
    """Messages are in a frame that no transform mentions."""
    if not model.tracks:
        return
    by_name: dict[str, list[Heard]] = defaultdict(list)
    placed = {heard.frame for heard in model.heard if heard.is_spatial}
    for heard in model.heard:
        known = heard.frame in model.frames or heard.frame[1:] in _slashed(heard, model)
        known = known or heard.frame in model.described
        may_be_placed = heard.is_spatial or (heard.has_own_type and heard.frame not in placed)
        if heard.frame and may_be_placed and not known and not is_navsat_output(heard):
            by_name[heard.frame].append(heard)
    for name, heards in by_name.items():
        count = sum(len(heard.stamps) for heard in heards)
        near = _near(model, name)
        alike = _fitting(model, heards[0].type)
        hint = f"; in tf, {' and '.join(alike)} fits and no message uses it" if alike else ""
        if near and not alike:
            hint = f"; similar names in tf: {', '.join(near)}"
        if _is_scoped(model, name):
            hint += "; this is a simulator's scoped name"
        robots = [] if is_world(name) else _sharing(heards)
        if robots:
            hint += f"; {len(robots)} robots use this name: {', '.join(robots)}"
        told = {heard.topic for heard in heards}
        first = min(int(heard.logs[0]) for heard in heards)
        fixes = _renames(model, name, alike, heards)
        raw, node = _raw_input(model, name) if fixes[0] in _FIND_IT else ([], "")
        if raw:
            told |= {heard.topic for heard in raw}
            fixes = (Fix(f"{node} sends them: check whether its localiser ran and was recorded"),)
        more = sorted({h.topic for h in model.heard if h.frame == name} - told)
        if more:
            hint += f"; also in this frame, without a position: {several(more, 3)}"
        yield Hit(
            frames=(name,),
            topics=tuple(sorted(heard.topic for heard in heards)),
            since=first,
            count=count,
            facts={
                "frame": name,
                "named": name,
                "says": [f"{h.topic} ({h.type}, {len(h.stamps)} messages)" for h in heards + raw],
                "near": near,
                "alike": alike,
                "hint": hint,
            },
            severity=Severity.NOTE if raw else _severity(model, name, heards, fixes),
            fixes=fixes,
            alone=len(fixes) > 1 or bool(fixes[0].command),
            group=fixes[0].text,
        )


_FIND_IT = (
    Fix("find the node that should publish the frame"),
    Fix("find the node that should publish the frame, or the name that the frame has in tf"),
)
"""Remedies for a frame without any evidence; the second, if tf has frames that may be this one."""


def _raw_input(model: Model, name: str) -> tuple[list[Heard], str]:
    """Return the topics of raw messages in a frame, if they are probably the input of a localiser.

    The localiser would publish the frame. The conditions are that tf has no robot, and that one
    node sends all messages in the frame, with and without a position.

    Returns:
        The topics without a position and the name of the node; empty for other frames.
    """
    raw = [heard for heard in model.heard if heard.frame == name and not heard.is_spatial]
    topics = {heard.topic for heard in model.heard if heard.frame == name}
    nodes = {one.node for one in model.evidence.publishers if one.topic in topics}
    is_own = len(nodes) == 1 and all(nodes) and bool(raw)
    return (raw, min(nodes)) if is_own and not has_base(model) else ([], "")


def is_navsat_output(heard: Heard) -> bool:
    """Whether a topic comes from navsat_transform_node, whose frame nobody publishes in tf."""
    return last_part(heard.type) == "NavSatFix" and last_part(heard.topic) == "filtered"


def _severity(
    model: Model, name: str, heards: Iterable[Heard], fixes: Sequence[Fix]
) -> Severity | None:
    """Return the severity of a finding about a frame that tf lacks; None for the default, ERROR."""
    if not model.has_lists:
        return Severity.NOTE
    if any(last_part(heard.type) in PLACED for heard in heards):
        return None if has_base(model) else Severity.WARNING
    # A recording for a localiser has goals and reference poses in its map.
    is_vague = is_world(name) and not any(fix.command for fix in fixes)
    is_sensor = any(heard.type.startswith("sensor_msgs/") for heard in heards)
    return Severity.WARNING if is_sensor and not is_vague else Severity.NOTE


def _sharing(heards: Iterable[Heard]) -> list[str]:
    """Return the namespaces of several robots that publish the same topic; empty for one robot."""
    robots: dict[str, set[str]] = defaultdict(set)
    for heard in heards:
        robot, _, topic = heard.topic.removeprefix("/").partition("/")
        robots[topic].add(robot)
    shared = [found for topic, found in robots.items() if topic and len(found) > 1]
    return sorted(max(shared, key=len, default=()))


def _is_scoped(model: Model, name: str) -> bool:
    """Whether a simulator composed a frame name, such as robot/base_link/gpu_lidar."""
    simulated = len(model.evidence.clock[0]) or any(one.families[0] for one in model.heard)
    return bool(simulated) and name.strip("/").count("/") >= 2


def _slashed(heard: Heard, model: Model) -> Iterable[str]:
    """Return all frames in tf if the frame of a topic has a leading slash; else an empty tuple."""
    return model.frames if heard.frame.startswith("/") else ()


def alike_frames(model: Model, name: str) -> list[str]:
    """Return the frames in tf that an unknown name probably means."""
    kinds = [heard.type for heard in model.heard if heard.frame.removeprefix("/") == name]
    fitting = (frame for kind in kinds for frame in _fitting(model, kind))
    return list(dict.fromkeys((*fitting, *_near(model, name))))


_NUMBER = re.compile(r"\d+")


def _near(model: Model, name: str) -> list[str]:
    """Return the frames in tf that share a distinctive word with an unknown name or resemble it."""
    words = {word for word in distinctive_words(name) if not word.isdigit()}
    found = near_names(last_part(name), sorted(model.frames), 3)
    # Names that differ only in a number belong to two things of one kind.
    found = [one for one in found if _NUMBER.sub("#", one) != _NUMBER.sub("#", name)]
    return [one for one in found if words & distinctive_words(one) or distance(name, one, 1) <= 1]


def _fitting(model: Model, kind: str) -> list[str]:
    """Return the frames whose name fits a message type, such as "laser" for LaserScan.

    Only frames without children and without messages are returned.
    """
    used = {heard.frame for heard in model.heard}
    parents = {track.parent for track in model.tracks}
    words = _KINDS.get(last_part(kind), ())
    leaves = sorted(model.frames - parents - used)
    return [frame for frame in leaves if any(word in frame.lower() for word in words)]


_KINDS = {
    "LaserScan": ("laser", "scan", "lidar"),
    "PointCloud2": ("lidar", "velodyne", "laser", "camera", "depth", "cloud"),
    "Imu": ("imu",),
    "Image": ("camera", "optical"),
    "CameraInfo": ("camera", "optical"),
    "NavSatFix": ("gps", "gnss", "navsat"),
}


def _renames(model: Model, name: str, alike: list[str], heards: list[Heard]) -> tuple[Fix, ...]:
    topic = heards[0].topic
    fixes = []
    if alike:
        fixes.append(Fix(f"if {alike[0]} is the frame of this sensor, {topic} should name it"))
    if _is_scoped(model, name):
        fixes.append(Fix("{scoped}"))
    join = proposed_frame(model, name.removeprefix("/"), [heard.type for heard in heards])
    if join is not None:
        # Evidence for the frame itself comes before similar names.
        fixes = [join.fix, *fixes] if join.why else [*fixes, join.fix]
    if not fixes:
        parts = [one for one in model.frames if not is_world(one) and last_part(one) not in BASES]
        fixes = [_FIND_IT[bool(parts)]]
    if name.startswith("/"):
        fixes.append(Fix(f'and set frame_id to "{name[1:]}": no frame of tf2 begins with a slash'))
    return tuple(fixes)


@check(
    "slash-twins",
    Severity.ERROR,
    rule="the frame in a header begins with a slash, and a transform has the same name without the "
    "slash. A warning in ROS 1, whose tf removes the slash, and for topics other than scans, point "
    "clouds, ranges, images and IMUs. A note if a transform of the frame has the slash too, "
    "and for messages without a position, such as joint states",
    headline="{topic} {aged}names {frame}, {tf}",
    detail="{topic}: {frame}, {count:times}{outside}",
    consequence="every direct tf2 lookup fails: \"in tf2 frame_ids cannot start with a '/'\" "
    "(message filters and tf 1 remove the slash)",
    fixes=(
        Fix('set frame_id to "{known}" in the publisher of {topic}'),
        Fix("to repair a recording:", "tftool edit RECORDING -o CLEAN --strip-slash --everywhere"),
    ),
    causes=("a publisher written for tf 1",),
    links=threads("ros-simulation/stage_ros#68", "gisbi-kim/FAST_LIO_SLAM#15"),
    needs=("headers",),
)
def slash_twins(model: Model, limits: Limits) -> Iterator[Hit]:
    """Messages name the frame /x, tf has the frame x, and tf2 lookups of /x fail."""
    is_old = is_ros1(model.evidence)
    for heard in model.heard:
        known = heard.frame[1:]
        if heard.frame.startswith("/") and known in model.frames:
            # A publisher for tf 1 sends both names of a transform with the slash.
            slashed = [t.slashed for t in model.tracks if known in t.edge]
            is_sensor = last_part(heard.type) in {*PLACED, "Image", "Imu"}
            severity = Severity.WARNING if is_old or not is_sensor else Severity.ERROR
            is_note = any(slashed) or not heard.is_spatial
            outside = _outside(model, heard, known)
            yield Hit(
                frames=(heard.frame, known),
                topics=(heard.topic,),
                since=int(heard.logs[0]) if len(heard.logs) else None,
                count=len(heard.stamps),
                severity=Severity.NOTE if is_note else severity,
                facts={
                    "frame": heard.frame,
                    "known": known,
                    "tf": "as transforms do" if any(slashed) else f"tf knows {known}",
                    "topic": heard.topic,
                    "count": len(heard.stamps),
                    "aged": f"is {outside}, and " if outside else "",
                    "outside": "; lookups at these stamps fail without the slash, too"
                    if outside
                    else "",
                },
                fixes=(_age_first(model, heard),) if outside else (),
                group=outside,
            )


def _age_first(model: Model, heard: Heard) -> Fix:
    """Return the remedy to try first for messages whose stamps no transform covers."""
    late = heard.median_latency
    if not model.evidence.timed or late < LAP:
        return Fix(f"first find out why no transform covers the time of {heard.topic}; then")
    nodes = sorted({one.node for one in model.evidence.publishers if one.topic == heard.topic})
    of = f"{several(nodes)}, which sends it" if any(nodes) else "the node that sends it"
    return Fix(
        f"first find out why {heard.topic} arrives {span(late)} after its stamp: check the queue "
        f"and the load of {of}; then"
    )


def _outside(model: Model, heard: Heard, known: str) -> str:
    """Return a clause with the time between a topic's stamps and the samples of the frame `known`.

    The clause is empty if some of the stamps are between the first and the last sample.
    """
    path = [track for track in model.above(known) if not track.static and len(track.by_stamp)]
    more = " or more" if len(heard.stamps) > 1 else ""
    for track in path:
        first, last = int(track.sorted_stamps[0]), int(track.sorted_stamps[-1])
        if (newest := int(heard.stamps.max())) < first:
            return f"dated {span(first - newest)}{more} before the first sample of {track.name}"
        if (oldest := int(heard.stamps.min())) > last:
            return f"dated {span(oldest - last)}{more} after the last sample of {track.name}"
    return ""
