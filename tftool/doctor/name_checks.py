"""Checks of names: different names for one frame, and names and topics that tf2 cannot use."""

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import replace

from tftool.doctor.check import checks_of, hit_of, threads
from tftool.doctor.findings import Area, Confidence, Fix, Hit, Severity
from tftool.doctor.missing_joins import (
    quoted,
)
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import family, last_part
from tftool.doctor.wording import several

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
    "leading-slash",
    Severity.NOTE,
    rule="a transform names a frame with a leading slash, which tf2 removes. An error for two "
    "leading slashes, because no lookup can name the frame that remains",
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
                "found": "two leading slashes: no lookup can name this frame"
                if twice
                else "a leading slash, which tf2 removes",
            },
            since=None,
            topics=track.topics,
            count=track.slashed,
            severity=Severity.ERROR if twice else Severity.NOTE,
        )


@check(
    "case-twins",
    Severity.WARNING,
    rule="two names are equal without hyphens, underscores, blanks and case. A note if transforms "
    "connect them",
    headline="{first} and {second} differ only in spelling",
    detail="{users}",
    consequence="the two names are two frames: data in one frame is not in the other",
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
            # A lookup between them works, so data in one frame can be placed in the other.
            roots = {model.tree_of[name].root if name in model.frames else None for name in twins}
            is_joined = len(roots) == 1 and None not in roots
            hit = _twins(model, twins)
            yield replace(hit, severity=Severity.NOTE) if is_joined else hit


@check(
    "typo-twins",
    Severity.WARNING,
    rule="two names of {shortest:g} letters or more, which are not in one tree, differ by one "
    "letter (names of {long:g} letters or more: by two letters). One of the two is in no "
    "transform, or is the root of a smaller tree. Not reported for names that differ in a "
    "number, or in a pair of words such as left and right",
    headline="{first} and {second} look like two spellings of one name",
    detail="{users}",
    consequence="the two names are two frames: data in one frame is not in the other",
    fixes=(Fix("if they are one frame, use one spelling; {most} has more users"),),
    causes=("names typed by hand in two places",),
    limits={"shortest": 5, "long": 10},
    because_of=(("frame", "namespace-twins"),),
)
def typo_twins(model: Model, limits: Limits) -> Iterator[Hit]:
    """Two names differ by one or two letters, and one name is not in tf or in another tree."""
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
    rule="a frame name exists with and without a prefix, in different trees. A note if all "
    "transforms are single (TransformStamped), which no listener of tf receives",
    headline="{first} and {bare} look like one frame: some names have the prefix {prefix}",
    detail="{twins}",
    consequence="{so}",
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
    """The same frame names occur with and without a prefix."""
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
        so = "the frames with the prefix and those without are two trees"
        fix = Fix("look which nodes send them: `{publishers} /tf`")
        if unknown := [name for name in frames if name not in model.frames]:
            topics = several(_topics_in(model, unknown), 3)
            so = f"no transform names {several(unknown, 3)}: nothing can place {topics}"
            fix = Fix(f"look which frame the publishers of {topics} mean")
            if len(unknown) < len(frames):
                text = f"if both are one frame, the messages on {topics} should name the one in tf"
                fix = Fix(text)
        yield Hit(
            frames=tuple(frames),
            topics=_topics_in(model, frames),
            count=len(twins),
            fixes=(fix,),
            facts={
                "prefix": prefix,
                "twins": [f"{name} and {bare}" for name, bare in twins],
                "first": twins[0][0],
                "bare": twins[0][1],
                "so": so,
            },
            severity=None if model.has_lists else Severity.NOTE,
            alone=True,
        )


@check(
    "namespaced-topic",
    Severity.NOTE,
    rule="transforms are sent on a topic other than /tf and /tf_static. If /tf has the same frame, "
    "other checks leave out single transforms (TransformStamped), and copies of the transforms on "
    "/tf",
    headline="transforms are sent on {topics}",
    detail="{missing}",
    consequence="a listener with default topics does not receive these transforms",
    causes=("a robot in a namespace whose /tf is remapped",),
    links=threads("iRobotEducation/create3_docs#402", "ros-navigation/navigation2#5449"),
)
def namespaced_topic(model: Model, limits: Limits) -> Iterator[Hit]:
    """Transforms are sent on /ns/tf, to which default listeners do not subscribe."""
    heard_on = {*_USUAL_TOPICS, *model.settings.tf_topics}
    heard_on |= {f"{topic}_static" for topic in model.settings.tf_topics}
    found = {topic for track in model.tracks for topic in track.topics} | model.copies.keys()
    odd = sorted(found - heard_on)
    if not odd:
        return
    usual = [track for track in model.tracks if set(track.topics) & heard_on]
    is_moving = not all(track.static for track in usual)
    kinds = {topic.name: last_part(topic.type) for topic in model.evidence.topics}
    whole = [topic for topic in odd if kinds.get(topic) != "TransformStamped"]
    first = (whole or odd)[0]
    prefix = first.rsplit("/", 1)[0]
    remap = Fix(
        "start a listener that receives them with:",
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
            fix = Fix("let its publisher use a TransformBroadcaster, or another topic")
            if not any(name.startswith("/") for name in names):  # no recorder writes such names
                fix = Fix(
                    "let the program that wrote the recording write tf2_msgs/TFMessage to /tf"
                )
            facts = {"topics": names, "type": kind}
            yield Hit(topics=tuple(names), facts=facts, fixes=(fix,), alone=True)


@check(
    "awkward-name",
    Severity.NOTE,
    rule="a name has blanks at its ends, invisible characters, a ~, or more than {letters:g} "
    "letters, or YAML 1.1 reads the name as a number or another value",
    headline="{where}: {concerned:a name|names} that many tools misread",
    detail="{frame} {reason}",
    consequence="tools that print or parse the name show or read another one",
    limits={"letters": 100},
)
def awkward_name(model: Model, limits: Limits) -> Iterator[Hit]:
    """A frame name has blanks or control characters, or is a number or a keyword in YAML."""
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
