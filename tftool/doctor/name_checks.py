"""Checks of names: frames that messages use and tf lacks, and names that mean the same."""

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator

from tftool.base.near_names import near_names
from tftool.doctor.findings import Confidence, Fix, Hit, Severity
from tftool.doctor.model import Limits, Model
from tftool.doctor.shape_checks import base_of, quoted, static_publisher
from tftool.doctor.stamp_stream import Heard, last_part

_FAMILY = re.compile(
    r"\d+|(?<![a-z])(?:left|right|front|rear|back|upper|lower|top|bottom|fl|fr|rl|rr|[lrxyz])(?![a-z])"
)
_YAML = re.compile(
    r"(?:on|off|yes|no|y|n|true|false|null|~|[-+]?\.?\d[\d_]*(?:\.\d*)?(?:e[-+]?\d+)?|0x[\da-f]+"
    r"|[-+]?\.(?:inf|nan))\Z",
    re.IGNORECASE,
)
_USUAL_TOPICS = ("/tf", "/tf_static", "tf", "tf_static")
MOST_COMPARED = 300_000
"""Pairs of names that are compared; more would take seconds."""


def unknown_frame(model: Model, limits: Limits) -> Iterator[Hit]:
    """Messages are in a frame that no transform mentions."""
    if not model.tracks:
        return
    by_name: dict[str, list[Heard]] = defaultdict(list)
    for heard in model.heard:
        known = heard.frame in model.frames or heard.frame[1:] in _slashed(heard, model)
        known = known or heard.frame in model.described
        if heard.frame and heard.is_spatial and not known:
            by_name[heard.frame].append(heard)
    for name, heards in by_name.items():
        count = sum(len(heard.stamps) for heard in heards)
        near = near_names(last_part(name), sorted(model.frames), 3)
        alike = _fitting(model, heards[0].type)
        hint = f"; in tf, {' and '.join(alike)} fits and no message uses it" if alike else ""
        if near and not alike:
            hint = f"; near: {', '.join(near)}"
        if name.count("/") >= 2:
            hint += "; this is a simulator's scoped name"
        first = min(int(heard.logs[0]) for heard in heards)
        yield Hit(
            frames=(name,),
            topics=tuple(sorted(heard.topic for heard in heards)),
            since=first,
            count=count,
            facts={
                "frame": name,
                "says": [f"{h.topic} ({h.type}, {len(h.stamps)} messages)" for h in heards],
                "near": near,
                "alike": alike,
                "hint": hint,
            },
            fixes=_renames(model, name, alike),
            alone=True,
        )


def _slashed(heard: Heard, model: Model) -> Iterable[str]:
    """What `slash-twins` speaks about."""
    return model.frames if heard.frame.startswith("/") else ()


def alike_frames(model: Model, name: str) -> list[str]:
    """Frames that were probably meant by one that tf does not know."""
    kinds = [heard.type for heard in model.heard if heard.frame == name]
    near = near_names(last_part(name), sorted(model.frames), 3)
    return list(dict.fromkeys((*(f for kind in kinds for f in _fitting(model, kind)), *near)))


def _fitting(model: Model, kind: str) -> list[str]:
    """Frames without children that no message is in, and that are named like such a sensor's."""
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


def _renames(model: Model, name: str, alike: list[str]) -> tuple[Fix, ...]:
    fixes = [Fix(f"set frame_id of the driver to {alike[0]}")] if alike else []
    if name.count("/") >= 2:
        fixes.append(
            Fix("in Gazebo, give the sensor the name in tf: <gz_frame_id>NAME</gz_frame_id>")
        )
    base = base_of(model.trees[0]) or model.trees[0].root
    text = (
        "or, if it is a frame of its own, publish where it is:"
        if fixes
        else ("set frame_id of the driver to the name in tf, or publish where the frame is:")
    )
    return (*fixes, Fix(text, static_publisher(base, name)))


def slash_twins(model: Model, limits: Limits) -> Iterator[Hit]:
    """Messages say /x, tf knows x: every lookup refuses."""
    for heard in model.heard:
        if heard.frame.startswith("/") and heard.frame[1:] in model.frames:
            yield Hit(
                frames=(heard.frame, heard.frame[1:]),
                topics=(heard.topic,),
                since=int(heard.logs[0]) if len(heard.logs) else None,
                count=len(heard.stamps),
                facts={
                    "frame": heard.frame,
                    "known": heard.frame[1:],
                    "topic": heard.topic,
                    "count": len(heard.stamps),
                },
            )


def leading_slash(model: Model, limits: Limits) -> Iterator[Hit]:
    """Names in transforms carry a slash, or two."""
    for track in model.tracks:
        twice = [name for name in track.edge if name.startswith("/")]
        if not twice and not track.slashed:
            continue
        yield Hit(
            edges=(track.edge,),
            topics=track.topics,
            publishers=track.nodes,
            count=track.slashed,
            severity=Severity.ERROR if twice else Severity.NOTE,
            facts={
                "edge": track.name,
                "count": track.slashed,
                "found": "two leading slashes: no query can reach it"
                if twice
                else "a leading slash, which tf2 strips",
            },
        )


def case_twins(model: Model, limits: Limits) -> Iterator[Hit]:
    """Names that differ in case, hyphens, underscores or blanks only."""
    alike: dict[str, list[str]] = defaultdict(list)
    for name in _names(model):
        alike[_bare(name)].append(name)
    for twins in alike.values():
        if len(twins) > 1:
            yield _twins(model, twins)


def typo_twins(model: Model, limits: Limits) -> Iterator[Hit]:
    """Names one or two letters apart, one of them dangling."""
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
    """A name, and what of it counts beside its letters when it is compared."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.last_part = last_part(name)
        self.bare = _bare(name)
        self.family = _FAMILY.sub("#", name.lower())


def _bare(name: str) -> str:
    """A name without case, hyphens, underscores and blanks."""
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
    """Letters to insert, drop, change or swap with a neighbour to make one word of another.

    Args:
        one: A word.
        other: Another.
        most: Where they are more, what is returned is some number above it.

    Source:
        Damerau, "A technique for computer detection and correction of spelling errors",
        1964; here in its restricted form (optimal string alignment).
    """
    # What both begin and end with decides nothing, and is most of two names of one robot.
    begin = _shared(one, other)
    one, other = one[begin:], other[begin:]
    end = _shared(one[::-1], other[::-1])
    one, other = one[: len(one) - end], other[: len(other) - end]
    before: list[int] = []
    last = list(range(len(other) + 1))
    for row, letter in enumerate(one, start=1):
        # What lies further from the diagonal than that is more anyway.
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
        # A swap goes on from the row before; else no number below is less than the least here.
        if min(last) > most and min(before) >= most:
            return most + 1
    return last[-1]


def _shared(one: str, other: str) -> int:
    """With how many letters both begin."""
    for place, (letter, its) in enumerate(zip(one, other, strict=False)):
        if letter != its:
            return place
    return min(len(one), len(other))


def namespace_twins(model: Model, limits: Limits) -> Iterator[Hit]:
    """Half of the frames carry a prefix the other half lacks."""
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


def namespaced_topic(model: Model, limits: Limits) -> Iterator[Hit]:
    """Transforms travel on /ns/tf, where default listeners do not listen."""
    heard_on = {*_USUAL_TOPICS, *model.settings.tf_topics}
    heard_on |= {f"{topic}_static" for topic in model.settings.tf_topics}
    odd = sorted({t for track in model.tracks for t in track.topics} - heard_on)
    if not odd:
        return
    usual = [track for track in model.tracks if set(track.topics) & heard_on]
    moving = [track for track in usual if not track.static]
    severity = Severity.WARNING
    if moving:
        joined = _joined(track.edge for track in usual)
        everything = _joined(track.edge for track in model.tracks)
        tied: dict[str, set[str]] = defaultdict(set)
        for frame, group in joined.items():
            tied[everything[frame]].add(group)
        if all(len(groups) == 1 for groups in tied.values()):
            severity = Severity.NOTE
    prefix = odd[0].rsplit("/", 1)[0]
    heard = {name for track in usual for name in track.edge}
    yield Hit(
        frames=tuple(sorted(model.frames - heard)),
        topics=tuple(odd),
        severity=severity,
        count=sum(len(t.stamps) for t in model.tracks if not set(t.topics) & heard_on),
        facts={
            "topics": odd,
            "prefix": prefix,
            "missing": "nothing moves on /tf" if not moving else "/tf has transforms too",
        },
        fixes=(
            Fix(
                "let listeners and rviz hear them:",
                f"--ros-args -r /tf:={odd[0]} -r /tf_static:={prefix}/tf_static",
            ),
            Fix(f"here, --tf-topic {quoted(odd[0])} looks at these alone"),
        ),
        alone=True,
    )


def _joined(edges: Iterable[tuple[str, str]]) -> dict[str, str]:
    """For each frame a frame that stands for all it is joined with."""
    above: dict[str, str] = {}

    def top(name: str) -> str:
        while above.setdefault(name, name) != name:
            above[name] = above[above[name]]
            name = above[name]
        return name

    for parent, child in edges:
        above[top(child)] = top(parent)
    return {name: top(name) for name in list(above)}


def awkward_name(model: Model, limits: Limits) -> Iterator[Hit]:
    """Blanks, control characters, or a name YAML reads as a number or a bool."""
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
    """All names that transforms and messages use, those of messages without their slash."""
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
