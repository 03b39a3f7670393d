"""Checks of names: message frames that are not in tf, and several spellings of one frame."""

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence

from tftool.base.plain_text import near_names
from tftool.doctor.check import checks_of, hit_of, threads
from tftool.doctor.findings import Area, Confidence, Fix, Hit, Severity
from tftool.doctor.missing_joins import (
    distinctive_words,
    has_base,
    is_world,
    proposed_frame,
    quoted,
)
from tftool.doctor.model import Limits, Model
from tftool.doctor.ros_words import is_ros1
from tftool.doctor.stamp_stream import PLACED, Heard, family, last_part
from tftool.doctor.wording import span

check = checks_of(Area.NAMES)

_YAML = re.compile(
    r"(?:on|off|yes|no|y|n|true|false|null|~|[-+]?\.?\d[\d_]*(?:\.\d*)?(?:e[-+]?\d+)?|0x[\da-f]+"
    r"|[-+]?\.(?:inf|nan))\Z",
    re.IGNORECASE,
)
_USUAL_TOPICS = ("/tf", "/tf_static", "tf", "tf_static")
MOST_COMPARED = 300_000
"""Maximum number of pairs of names that are compared; more would take seconds."""


@check(
    "unknown-frame",
    Severity.ERROR,
    rule="the frame of a message with a position is in no transform of the whole recording. A "
    "warning if none of the messages is a scan, a point cloud or a range, which costmaps and "
    "maps have to place, or if tf has no base frame; a note if none comes from a sensor, or if "
    "nothing but the frame of a localiser or of the earth is unknown",
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
    why="such lookups fail at every time",
    because_of=(("frame", "static-missing slash-twins namespace-twins case-twins typo-twins"),),
)
def unknown_frame(model: Model, limits: Limits) -> Iterator[Hit]:
    """Messages are in a frame that no transform mentions."""
    if not model.tracks:
        return
    by_name: dict[str, list[Heard]] = defaultdict(list)
    for heard in model.heard:
        known = heard.frame in model.frames or heard.frame[1:] in _slashed(heard, model)
        known = known or heard.frame in model.described
        if heard.frame and heard.is_spatial and not known and not is_navsat_output(heard):
            by_name[heard.frame].append(heard)
    for name, heards in by_name.items():
        count = sum(len(heard.stamps) for heard in heards)
        near = _near(model, name)
        alike = _fitting(model, heards[0].type)
        hint = f"; in tf, {' and '.join(alike)} fits and no message uses it" if alike else ""
        if near and not alike:
            hint = f"; near: {', '.join(near)}"
        if _is_scoped(model, name):
            hint += "; this is a simulator's scoped name"
        robots = [] if is_world(name) else _sharing(heards)
        if robots:
            hint += f"; {len(robots)} robots use this name: {', '.join(robots)}"
        first = min(int(heard.logs[0]) for heard in heards)
        fixes = _renames(model, name, alike, heards)
        yield Hit(
            frames=(name,),
            topics=tuple(sorted(heard.topic for heard in heards)),
            since=first,
            count=count,
            facts={
                "frame": name,
                "named": name,
                "says": [f"{h.topic} ({h.type}, {len(h.stamps)} messages)" for h in heards],
                "near": near,
                "alike": alike,
                "hint": hint,
            },
            severity=_severity(model, name, heards, fixes),
            fixes=fixes,
            alone=len(fixes) > 1 or bool(fixes[0].command),
            group=fixes[0].text,
        )


def is_navsat_output(heard: Heard) -> bool:
    """Whether a topic comes from navsat_transform_node, whose frame nobody publishes in tf."""
    return last_part(heard.type) == "NavSatFix" and last_part(heard.topic) == "filtered"


def _severity(
    model: Model, name: str, heards: Iterable[Heard], fixes: Sequence[Fix]
) -> Severity | None:
    """Return the severity of a finding about a frame that tf lacks; None for an error."""
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
        fixes = [Fix("find the node that should publish the frame, or another name for it in tf")]
    if name.startswith("/"):
        fixes.append(Fix(f'and set frame_id to "{name[1:]}": no frame of tf2 begins with a slash'))
    return tuple(fixes)


@check(
    "slash-twins",
    Severity.ERROR,
    rule="a frame in a header begins with a slash, and tf knows the name without it. In ROS 1 a "
    "warning, as its tf strips the slash; a note if the transforms have the slash too",
    headline="{topic} names {frame}, {tf}",
    detail="{topic}: {frame}, {count:times}{outside}",
    consequence="every direct tf2 lookup refuses (message filters and tf 1 strip the slash): "
    "\"in tf2 frame_ids cannot start with a '/'\"",
    fixes=(
        Fix('set frame_id to "{known}" in the publisher of {topic}'),
        Fix("in a recording:", "tftool edit RECORDING -o CLEAN --strip-slash --everywhere"),
    ),
    causes=("a publisher written for tf 1",),
    links=threads("ros-simulation/stage_ros#68", "gisbi-kim/FAST_LIO_SLAM#15"),
    needs=("headers",),
)
def slash_twins(model: Model, limits: Limits) -> Iterator[Hit]:
    """Messages name /x, tf knows x: every direct tf2 lookup refuses."""
    is_old = is_ros1(model.evidence)
    for heard in model.heard:
        known = heard.frame[1:]
        if heard.frame.startswith("/") and known in model.frames:
            slashed = [t.slashed == len(t.all_stamps) for t in model.tracks if known in t.edge]
            severity = Severity.NOTE if all(slashed) else Severity.WARNING
            outside = _outside(model, heard, known)
            yield Hit(
                frames=(heard.frame, known),
                topics=(heard.topic,),
                since=int(heard.logs[0]) if len(heard.logs) else None,
                count=len(heard.stamps),
                severity=severity if is_old else None,
                facts={
                    "frame": heard.frame,
                    "known": known,
                    "tf": "as the transforms do" if all(slashed) else f"tf knows {known}",
                    "topic": heard.topic,
                    "count": len(heard.stamps),
                    "outside": f"; all are {outside}: lookups fail without the slash, too"
                    if outside
                    else "",
                },
            )


def _outside(model: Model, heard: Heard, known: str) -> str:
    """Return the time from a topic's stamps to the frame's samples, as a clause of a sentence.

    The clause is empty if some of the stamps are between the first and the last sample.
    """
    path = [track for track in model.above(known) if not track.static and len(track.by_stamp)]
    for track in path:
        first, last = int(track.sorted_stamps[0]), int(track.sorted_stamps[-1])
        if (newest := int(heard.stamps.max())) < first:
            return f"stamped {span(first - newest)} or more before the first sample of {track.name}"
        if (oldest := int(heard.stamps.min())) > last:
            return f"stamped {span(oldest - last)} or more after the last sample of {track.name}"
    return ""


@check(
    "leading-slash",
    Severity.NOTE,
    rule="a transform names a frame with a leading slash, which tf2 removes; an error for "
    "two slashes, since no query can name the rest",
    headline="{where} {concerned:is|are} published with a leading slash",
    detail="{edge}: {found}",
    consequence="harmless to tf2; tools that compare names see two frames",
    causes=("a publisher written for tf 1",),
    because_of=(("anything", "slash-twins"),),
)
def leading_slash(model: Model, limits: Limits) -> Iterator[Hit]:
    """Names in transforms have a leading slash."""
    for track in model.tracks:
        twice = [name for name in track.edge if name.startswith("/")]
        if not twice and not track.slashed:
            continue
        yield hit_of(
            track,
            {
                "count": track.slashed,
                "found": "two leading slashes: no query can reach it"
                if twice
                else "a leading slash, which tf2 strips",
            },
            since=None,
            topics=track.topics,
            count=track.slashed,
            severity=Severity.ERROR if twice else Severity.NOTE,
        )


@check(
    "case-twins",
    Severity.WARNING,
    rule="two names are equal without hyphens, underscores, blanks and case",
    headline="{first} and {second} differ only in spelling",
    detail="{users}",
    consequence="they are two frames: things placed in one are not in the other",
    fixes=(Fix("if they are one frame, use one spelling; {most} has more users"),),
    causes=("names typed by hand in two places",),
    because_of=(("frame", "namespace-twins"),),
)
def case_twins(model: Model, limits: Limits) -> Iterator[Hit]:
    """Two names differ only in case, hyphens, underscores or blanks."""
    alike: dict[str, list[str]] = defaultdict(list)
    for name in _names(model):
        alike[_bare(name)].append(name)
    for twins in alike.values():
        if len(twins) > 1:
            yield _twins(model, twins)


@check(
    "typo-twins",
    Severity.WARNING,
    rule="two names of {shortest:g} letters or more, not in one tree, differ by one letter "
    "(from {long:g} letters on: by two), and one is unknown to tf or the root of a "
    "smaller tree; except numbers, and pairs like left and right",
    headline="{first} and {second} look like two spellings of one name",
    detail="{users}",
    consequence="they are two frames: things placed in one are not in the other",
    fixes=(Fix("if they are one frame, use one spelling; {most} has more users"),),
    causes=("names typed by hand in two places",),
    limits={"shortest": 5, "long": 10},
    because_of=(("frame", "namespace-twins"),),
)
def typo_twins(model: Model, limits: Limits) -> Iterator[Hit]:
    """Two names differ by one or two letters, and one of them is unused or separate."""
    names = _names(model)
    lesser = {tree.root for tree in model.trees[1:]}
    dangling = [name for name in names if name not in model.frames or name in lesser]
    if len(dangling) * len(names) > MOST_COMPARED:
        dangling = dangling[: max(1, MOST_COMPARED // len(names))]
    told: set[frozenset[str]] = set()
    spelled = {name: _Spelled(name) for name in names} if dangling else {}
    for one in dangling:
        for other in names:
            pair = frozenset((one, other))
            if len(pair) < 2 or pair in told or abs(len(one) - len(other)) > 2:
                continue
            if one in model.frames and model.tree_of[one] is model.tree_of.get(other):
                continue
            if _is_typo(spelled[one], spelled[other], limits):
                told.add(pair)
                yield _twins(model, sorted(pair))


class _Spelled:
    """A frame name, with its normalised spelling and its parts for comparisons."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.last_part = last_part(name)
        self.bare = _bare(name)
        self.family = family(name)


def _bare(name: str) -> str:
    """Return a frame name in lower case, without hyphens, underscores and spaces."""
    return re.sub(r"[-_\s]", "", name).casefold()


def _is_typo(one: _Spelled, other: _Spelled, limits: Limits) -> bool:
    shorter = min(len(one.name), len(other.name))
    if shorter < limits["shortest"] or one.last_part == other.last_part:
        return False
    if one.bare == other.bare or one.family == other.family:
        return False
    most = 1 if shorter < limits["long"] else 2
    return distance(one.name, other.name, most) <= most


def distance(one: str, other: str, most: int) -> int:
    """Return the least number of letters to insert, delete, replace or swap between two words.

    Args:
        one: The first word.
        other: The second word.
        most: Largest distance to compute; if the distance is larger, the result is any number above
            `most`.

    Source:
        Damerau, "A technique for computer detection and correction of spelling errors",
        1964; here in its restricted form (optimal string alignment).
    """
    # Skip the common beginning and end, which are most of two names of one robot.
    begin = _shared(one, other)
    one, other = one[begin:], other[begin:]
    end = _shared(one[::-1], other[::-1])
    one, other = one[: len(one) - end], other[: len(other) - end]
    before: list[int] = []
    last = list(range(len(other) + 1))
    for row, letter in enumerate(one, start=1):
        # A cell further from the diagonal than `most` has a larger distance anyway.
        here = [row, *[most + 1] * len(other)]
        for column in range(max(1, row - most), min(len(other), row + most) + 1):
            wanted = other[column - 1]
            cost = min(
                last[column] + 1, here[column - 1] + 1, last[column - 1] + (letter != wanted)
            )
            if row > 1 and column > 1 and (letter, one[row - 2]) == (other[column - 2], wanted):
                cost = min(cost, before[column - 2] + 1)
            here[column] = cost
        before, last = last, here
        # Later rows cannot be less than the minimum of this row, or for a swap of the row before.
        if min(last) > most and min(before) >= most:
            return most + 1
    return last[-1]


def _shared(one: str, other: str) -> int:
    """Return the length of the common prefix of two words."""
    for place, (letter, its) in enumerate(zip(one, other, strict=False)):
        if letter != its:
            return place
    return min(len(one), len(other))


@check(
    "namespace-twins",
    Severity.WARNING,
    rule="a name exists with and without a prefix, in different trees",
    headline="{first} and {bare} look like one frame: some names have the prefix {prefix}",
    detail="{twins}",
    consequence="the frames with the prefix and those without are two trees",
    fixes=(Fix("look which nodes send them: `{publishers} /tf`"),),
    causes=(
        "diff_drive_controller prefixes names with its namespace, robot_state_publisher does not",
        "frame_prefix without its trailing slash, or on names that have it already",
    ),
    links=threads(
        "iRobotEducation/create3_sim#211",
        "ros-controls/ros2_controllers#533",
        "ros/robot_state_publisher#205",
    ),
    because_of=(("child", "static-and-dynamic"),),
)
def namespace_twins(model: Model, limits: Limits) -> Iterator[Hit]:
    """Some frames have a prefix that others lack."""
    names = set(_names(model))
    pairs: dict[str, list[tuple[str, str]]] = defaultdict(list)
    for name in sorted(names):
        prefix, bare = "", name
        while "/" in bare:
            head, _, bare = bare.partition("/")
            prefix += f"{head}/"
            tree = model.tree_of.get(name)
            if bare in names and (tree is None or tree is not model.tree_of.get(bare)):
                pairs[prefix].append((name, bare))
                break
    for prefix, twins in pairs.items():
        frames = [name for pair in twins for name in pair]
        yield Hit(
            frames=tuple(frames),
            topics=_topics_in(model, frames),
            count=len(twins),
            facts={
                "prefix": prefix,
                "twins": [f"{name} and {bare}" for name, bare in twins],
                "first": twins[0][0],
                "bare": twins[0][1],
            },
            alone=True,
        )


@check(
    "namespaced-topic",
    Severity.NOTE,
    rule="transforms are sent on a topic other than /tf and /tf_static",
    headline="transforms are sent on {topics}",
    detail="{missing}",
    consequence="a listener with default topics does not receive them",
    causes=("a robot in a namespace whose /tf is remapped",),
    links=threads("iRobotEducation/create3_docs#402", "ros-navigation/navigation2#5449"),
)
def namespaced_topic(model: Model, limits: Limits) -> Iterator[Hit]:
    """Transforms are sent on /ns/tf, which default listeners do not subscribe."""
    heard_on = {*_USUAL_TOPICS, *model.settings.tf_topics}
    heard_on |= {f"{topic}_static" for topic in model.settings.tf_topics}
    odd = sorted({t for track in model.tracks for t in track.topics} - heard_on)
    if not odd:
        return
    usual = [track for track in model.tracks if set(track.topics) & heard_on]
    is_moving = not all(track.static for track in usual)
    kinds = {topic.name: last_part(topic.type) for topic in model.evidence.topics}
    whole = [topic for topic in odd if kinds.get(topic) != "TransformStamped"]
    first = (whole or odd)[0]
    prefix = first.rsplit("/", 1)[0]
    remap = Fix(
        "a listener hears them with:",
        model.words["remap"].format(moving=first, static=f"{prefix}/tf_static"),
    )
    if not whole:
        remap = Fix("tf2 reads tf2_msgs/TFMessage only, and this topic has another type")
    heard = {name for track in usual for name in track.edge}
    yield Hit(
        frames=tuple(sorted(model.frames - heard)),
        topics=tuple(odd),
        count=sum(len(t.stamps) for t in model.tracks if not set(t.topics) & heard_on),
        facts={
            "topics": odd,
            "prefix": prefix,
            "missing": "/tf has transforms too" if is_moving else "nothing moves on /tf",
        },
        fixes=(
            remap,
            Fix(f"here, --tf-topic {quoted(first)} examines only these"),
        ),
        alone=True,
    )


@check(
    "wrong-type",
    Severity.WARNING,
    rule="transforms on /tf or /tf_static are in messages of a type other than TFMessage",
    headline="{topics} {topics:has|have} the type {type}, which tf2 does not read",
    consequence="no listener receives these transforms: tf2 reads tf2_msgs/TFMessage only",
    fixes=(Fix("send them with a TransformBroadcaster, or on another topic"),),
    causes=("a publisher of single transforms whose topic was named /tf",),
)
def wrong_type(model: Model, limits: Limits) -> Iterator[Hit]:
    """Transforms on /tf have a type that tf2 does not read."""
    by_type: dict[str, list[str]] = defaultdict(list)
    for topic in model.evidence.topics:
        if topic.transforms and topic.name in _USUAL_TOPICS:
            by_type[topic.type].append(topic.name)
    for kind, names in by_type.items():
        if last_part(kind) == "TransformStamped":
            facts = {"topics": names, "type": kind}
            yield Hit(topics=tuple(names), facts=facts, alone=True)


@check(
    "awkward-name",
    Severity.NOTE,
    rule="a name has blanks at its ends, invisible characters, a ~, more than {letters:g} "
    "letters, or is a number or word of YAML 1.1",
    headline="{where}: {concerned:a name|names} that many tools misread",
    detail="{frame} {reason}",
    consequence="tools that print or parse the name show or read another one",
    limits={"letters": 100},
)
def awkward_name(model: Model, limits: Limits) -> Iterator[Hit]:
    """A name with blanks, control characters, or that YAML reads as a number or a word."""
    for name in _names(model):
        reason = _awkward(name, limits)
        if reason:
            yield Hit(frames=(name,), facts={"frame": name, "reason": reason})


def _awkward(name: str, limits: Limits) -> str:
    if name != name.strip():
        return "has blanks at its ends"
    if not name.isprintable():
        return "has characters that cannot be seen"
    if len(name) > limits["letters"]:
        return f"is {len(name)} characters long"
    if "~" in name:
        return "has a ~, which ROS reads as a private name"
    if _YAML.match(name):
        return "is a number or a word of YAML, and tf2's own YAML does not quote names"
    return ""


def _names(model: Model) -> list[str]:
    """Return the frame names in transforms and messages, without leading slashes."""
    heard = {h.frame.removeprefix("/") for h in model.heard if h.is_spatial}
    return sorted((model.frames | heard) - {""})


def _twins(model: Model, twins: list[str]) -> Hit:
    users = {name: _users(model, name) for name in twins}
    most = max(twins, key=lambda name: (users[name], name in model.frames))
    unknown = [name for name in twins if name not in model.frames]
    return Hit(
        frames=tuple(twins),
        topics=_topics_in(model, twins),
        confidence=Confidence.LIKELY,
        facts={
            "first": twins[0],
            "second": twins[1],
            "users": [f"{name}: {users[name]} transforms and messages" for name in twins],
            "most": most,
            "unknown": unknown,
        },
        alone=True,
    )


def _users(model: Model, name: str) -> int:
    transforms = sum(len(track.stamps) for track in model.tracks if name in track.edge)
    return transforms + sum(len(h.stamps) for h in model.heard if h.frame.removeprefix("/") == name)


def _topics_in(model: Model, names: Iterable[str]) -> tuple[str, ...]:
    wanted = set(names)
    return tuple(sorted({h.topic for h in model.heard if h.frame.removeprefix("/") in wanted}))
