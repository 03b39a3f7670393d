"""Checks of the tree's shape: loops, several trees, wrong order of names."""

from collections import defaultdict, deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from tftool.base.plain_text import count
from tftool.base.stamps import NANOSECONDS
from tftool.doctor.check import REP105, checks_of, hit_of, threads
from tftool.doctor.findings import Area, Confidence, Fix, Hit, Severity
from tftool.doctor.missing_joins import base_of, mount_command, prefix, proposed_join
from tftool.doctor.model import Limits, Model, Tree
from tftool.doctor.stamp_stream import PLACED, Heard, Track, last_part, overlap
from tftool.doctor.wording import is_ros1, metres, several

check = checks_of(Area.SHAPE)

_LARGE = 64  # frames in a loop; in larger loops no further loops are searched

JUDGED_EMPTY = frozenset(
    {
        "sensor_msgs/LaserScan",
        "sensor_msgs/PointCloud2",
        "sensor_msgs/Imu",
        "sensor_msgs/Image",
        "sensor_msgs/CameraInfo",
        "sensor_msgs/Range",
    }
)
"""Types whose messages are useless without a frame; other sensor_msgs types need none."""


@check(
    "loop",
    Severity.ERROR,
    rule="transforms that exist at the same time form a loop",
    headline="the frames form a loop: {circle}",
    consequence='lookups that follow the parents to the root fail: "The tf tree is invalid because '
    'it contains a loop."',
    fixes=(Fix("find the publishers: `{publishers} {tf_topic}`"),),
    causes=("one node publishes body in odom, and another node publishes odom in body",),
    links=threads("rai-opensource/spot_ros2#374"),
)
def loop(model: Model, limits: Limits) -> Iterator[Hit]:
    """Frames form a loop."""
    sent = [track for track in model.tracks if len(track.by_stamp)]
    circling = _circling({(track.child, track.parent) for track in sent})
    above = defaultdict(list)
    for track in sent:
        if (track.child, track.parent) in circling:
            above[track.child].append(track)
    told: set[frozenset[str]] = set()
    done: set[str] = set()
    for start in sorted(above):
        if start in done:
            continue
        # Search for the shortest path up that returns to its start.
        waiting = deque(above[start])
        came: dict[str, Track] = {}
        while waiting:
            last = waiting.popleft()
            here = last.parent
            if here == start:
                way = [last]
                while way[-1].child != start:
                    way.append(came[way[-1].child])
                way.reverse()
                circle = frozenset(track.child for track in way)
                if len(circle) > _LARGE:
                    done |= circle
                if circle not in told and overlap(way):
                    told.add(circle)
                    yield Hit(
                        edges=tuple(track.edge for track in way),
                        frames=tuple(track.child for track in way),
                        publishers=tuple(sorted({n for track in way for n in track.nodes})),
                        facts={
                            "circle": [track.name for track in way],
                            "tf_topic": way[0].topics[0],
                        },
                        alone=True,
                    )
                break
            if here not in came:
                came[here] = last
                waiting += above.get(here, ())


def _circling(links: set[tuple[str, str]]) -> set[tuple[str, str]]:
    """Return the links (child, parent) that are in a loop, or between two loops."""
    for _ in range(2):
        parents, children = defaultdict(set), defaultdict(set)
        for child, parent in links:
            parents[child].add(parent)
            children[parent].add(child)
        # A frame below only one root is not in another tree.
        roots = [name for name in children if name not in parents]
        while roots:
            root = roots.pop()
            for child in children.pop(root, ()):
                parents[child].discard(root)
                if not parents[child]:
                    roots.append(child)
        links = {(parent, child) for parent, below in children.items() for child in below}
    return links


@check(
    "split-tree",
    Severity.ERROR,
    rule="there is more than one root. An error if scans, point clouds or ranges are in a frame of "
    "a smaller tree, beside a tree with a base frame. A note if each tree is a whole robot, "
    "if two trees contain one frame in two conventions (odom, odom_ned) and no message is in "
    "one of these trees, or if the recording is shorter than {seconds:g} s. A note too if nothing "
    "in a tree moves, it has no base frame, and of the recorded messages none is in the tree. "
    "Trees with the same remedy in several robots, except for the names, are one finding",
    headline="{named} {many:is|are} not joined to the {trees} of {main_root}",
    detail="tree {number}: {frames}{users}{evidence}",
    consequence="lookups between these frames and {main_root} fail",
    causes=(
        "the mount of a camera or lidar was never published",
        "a SLAM package has frame names of its own (camera_init, body)",
        "base_frame is named differently in two nodes",
        "SLAM or AMCL was not started yet: there is no map",
    ),
    links=threads(
        "appliedAI-Initiative/orb_slam_2_ros#102",
        "hku-mars/FAST_LIO#130",
        "kinglintianxia/autolabor_pro1#2",
    ),
    limits={"seconds": 1.0},
    because_of=(
        ("child", "publisher-conflict two-parents static-and-dynamic"),
        ("anything", "static-missing"),
        ("frame", "slash-twins namespace-twins case-twins typo-twins"),
        ("anything", "namespaced-topic"),
        ("frame", "namespaced-topic"),
        ("frame", "joint-without-state"),
        ("frame", "clock-mixture"),
    ),
)
def split_tree(model: Model, limits: Limits) -> Iterator[Hit]:
    """The frames form several trees, and a transform between them is missing."""
    if len(model.trees) < 2:
        return
    alike: dict[tuple[str, Severity | None], list[Hit]] = defaultdict(list)
    for hit in _split_trees(model, limits):
        own = prefix(str(hit.facts["main_root"]))
        cure = hit.fixes[0].line.replace(own, "") if own else f"{hit.frames} {hit.fixes[0].line}"
        alike[cure, hit.severity].append(hit)
    for hits in alike.values():
        if len(hits) > 1 and all(hit.alone for hit in hits):
            yield from _of_each_robot(hits)
        else:
            yield from hits


def _of_each_robot(hits: Sequence[Hit]) -> Iterator[Hit]:
    """Yield hits about one cause, once for each of several robots, as parts of one finding."""
    roots = several([hit.facts["main_root"] for hit in hits])
    others = several([hit.facts["root"] for hit in hits[1:]])
    fix = replace(hits[0].fixes[0], text=f"{hits[0].fixes[0].text}; so for {others}")
    for hit in hits:
        facts = {**hit.facts, "main_root": roots, "trees": "trees"}
        yield replace(hit, facts=facts, fixes=(fix,), alone=False, group=roots)


def _split_trees(model: Model, limits: Limits) -> Iterator[Hit]:
    """Yield a hit for each tree beside the main one."""
    main = next((tree for tree in model.trees if base_of(tree)), model.trees[0])
    others = [tree for tree in model.trees if tree is not main]
    for number, tree in enumerate(others, start=2):
        if tree.is_circle:
            continue
        topics = _messages_in(model, tree)
        own = _own_robot(model, tree) or main
        join = proposed_join(model, own, tree)
        is_placed = any(last_part(h.type) in PLACED and h.frame in tree.frames for h in model.heard)
        severity = Severity.ERROR if is_placed and base_of(own) else Severity.WARNING
        is_short = model.evidence.recorded and (
            model.end - model.start < limits["seconds"] * NANOSECONDS
        )
        is_robot = join is not None and join.edge is None
        is_idle = not topics and _is_idle(model, tree)
        if is_short or is_robot or is_idle or _is_convention(tree, topics):
            severity = Severity.NOTE
        mount = "" if join is not None else mount_command(model, own, tree.root)
        fix = nothing_says(model, "{named}", mount) if join is None else join.fix
        used = [f"{topic} ({number} messages)" for topic, number in topics.items()]
        yield Hit(
            frames=(tree.root, *sorted(tree.frames - {tree.root})),
            topics=tuple(topics),
            severity=severity,
            facts={
                "root": tree.root,
                "named": tree.root,
                "main_root": own.root,
                "trees": "tree",
                "number": number,
                "used": used,
                "users": f"; used by {several(used)}"
                if used
                else "; no message is in these frames",
                "evidence": f"; {join.why}" if join is not None and join.why else "",
                "join": None
                if join is None or join.edge is None
                else {"parent": join.edge[0], "child": join.edge[1], "guess": join.guess},
            },
            fixes=(fix,),
            alone=join is not None,
            group=f"{own.root} {mount}",
        )


def _own_robot(model: Model, tree: Tree) -> Tree | None:
    """Return the first tree with a base frame whose root has the same prefix as the root of `tree`.

    Return None if the root of `tree` has no prefix, or if `tree` contains a base frame.
    """
    own = prefix(tree.root)
    if not own or base_of(tree):
        return None
    return next((o for o in model.trees if base_of(o) and prefix(o.root) == own), None)


def nothing_says(model: Model, root: str, mount: str = "") -> Fix:
    """Return the remedy for a root frame if no data shows the missing parent.

    Args:
        model: Model of the evidence.
        root: Name of the root frame.
        mount: Command that publishes the root as a sensor's mount; empty for other frames.
    """
    # In ROS 1, constants on /tf may be the statics.
    is_old = is_ros1(model.evidence)
    is_cut = model.lacks_statics or not (model.statics or is_old)
    is_cut &= model.evidence.recorded
    if is_cut and model.is_parted:
        return Fix(
            "robot_state_publisher sends frames of several trees, so the transforms that join them "
            f"are static, and not in the recording: {model.words['record']}"
        )
    if is_cut:
        look = (
            "check whether the robot sends static transforms: "
            f"`{model.words['publishers']} /tf_static`"
        )
        measure = "; if nothing sends it, measure where it is, and publish it:" * bool(mount)
        return Fix(
            f"the recording has no static transforms, and one of them may join {root}: {look}; if "
            f"so, {model.words['record']}{measure}",
            mount,
        )
    measure = "; if it is mounted on the robot, measure where, and publish it:" * bool(mount)
    return Fix(f"nothing in the data says where to join {root}{measure}", mount)


def _is_convention(tree: Tree, topics: Mapping[str, int]) -> bool:
    """Whether a tree contains only a frame and copies with other axes, such as odom and odom_ned.

    The result is False if any messages are in frames of the tree; `topics` counts these messages.
    """
    others = {f"{tree.root}_{axes}" for axes in ("ned", "enu", "frd", "flu")}
    return not topics and len(tree.frames) > 1 and tree.frames <= {tree.root, *others}


def _is_idle(model: Model, tree: Tree) -> bool:
    """Whether a tree has only constant transforms and no base frame, beside recorded messages."""
    moves = any(track.moves for track in model.tracks if track.child in tree.frames)
    return not moves and not base_of(tree) and any(heard.is_spatial for heard in model.heard)


def _messages_in(model: Model, tree: Tree) -> dict[str, int]:
    """Return the number of messages in a tree's frames, by topic."""
    counts: dict[str, int] = defaultdict(int)
    for heard in model.heard:
        if heard.is_spatial and heard.frame.removeprefix("/") in tree.frames:
            counts[heard.topic] += len(heard.stamps)
    return dict(sorted(counts.items()))


@check(
    "self-transform",
    Severity.WARNING,
    rule="parent and child of a transform have the same name",
    headline="{where}: a frame is its own parent",
    detail="{frame}: {count:times}",
    consequence="tf2 drops each such transform, and prints an error",
    fixes=(
        Fix("look at the frame names in the settings of its publisher: `{publishers} {tf_topic}`"),
    ),
    causes=(
        "published_frame and odom_frame of cartographer are equal",
        "base frame and odometry frame of rf2o are equal",
    ),
    links=threads("cartographer-project/cartographer#1883", "ethz-asl/voxblox#315"),
)
def self_transform(model: Model, limits: Limits) -> Iterator[Hit]:
    """A frame is its own parent."""
    for track in model.nameless:
        if track.parent and track.parent == track.child:
            yield hit_of(
                track,
                {"frame": track.child, "count": len(track.stamps)},
                frames=(track.child,),
                topics=track.topics,
            )


@check(
    "empty-frame",
    Severity.ERROR,
    rule="the name of a frame is empty. The severity is error for a transform, and warning for the "
    "header of a message with a position. It is note for a transform on a topic that tf2 does not "
    "read, for messages without a stamp, and for velocities, accelerations and forces without a "
    "position. Measurements among these are part of a warning about other messages",
    headline="no frame name in {named}",
    detail="{what}: {detail}, {count:times}",
    consequence="{so}",
    causes=(
        "a message that was never filled",
        "a camera whose frame id was never set",
    ),
    links=threads("christianrauch/apriltag_ros#57", "Intermodalics/tango_ros#157"),
)
def empty_frame(model: Model, limits: Limits) -> Iterator[Hit]:
    """A transform or a message has no frame name."""
    kinds = {topic.name: last_part(topic.type) for topic in model.evidence.topics}
    for track in model.nameless:
        if not track.parent or not track.child:
            # tf2 does not subscribe to topics of single TransformStamped messages.
            is_tf = any(kinds.get(topic) != "TransformStamped" for topic in track.topics)
            which = "parent" if not track.parent else "child"
            yield hit_of(
                track,
                {
                    "what": f"a transform on {', '.join(track.topics)}",
                    "named": f"a transform on {', '.join(track.topics)}",
                    "topic": track.topics[0],
                    "detail": f"its {which} is empty; the other is {track.parent or track.child!r}",
                    "count": len(track.stamps),
                    "so": "tf2 drops such a transform",
                },
                topics=track.topics,
                severity=Severity.ERROR if is_tf else Severity.NOTE,
                fixes=_name_them(model, [track.topics[0]]),
            )
    unnamed = [heard for heard in model.heard if not heard.frame and _needs_frame(heard)]
    placed = [heard for heard in unnamed if _is_placed(heard)]
    if placed:  # measurements of the same robot have the same fault
        placed = [heard for heard in unnamed if heard in placed or _is_measured(heard)]
    for heard in unnamed:
        alike = [other for other in unnamed if (other in placed) is (heard in placed)]
        yield Hit(
            topics=(heard.topic,),
            frames=("",),
            since=int(heard.logs[0]) if len(heard.logs) else None,
            count=len(heard.stamps),
            severity=Severity.WARNING if heard in placed else Severity.NOTE,
            fixes=_name_them(model, [other.topic for other in alike]),
            facts={
                "what": heard.topic,
                "named": f"{count(len(heard.stamps), 'message')} on {heard.topic}",
                "topic": heard.topic,
                "detail": f"{heard.type} with an empty frame_id",
                "count": len(heard.stamps),
                "so": "such a message cannot be placed",
            },
        )


def _needs_frame(heard: Heard) -> bool:
    """Whether the frame name of a topic's messages matters, judged by their type."""
    is_pose = heard.type.endswith("Stamped") and heard.is_spatial
    return heard.type in JUDGED_EMPTY or heard.type.startswith("nav_msgs/") or is_pose


def _is_placed(heard: Heard) -> bool:
    """Whether programs look up the place of a topic's messages."""
    # Commands between two nodes have neither a stamp nor a frame.
    is_vector = last_part(heard.type).startswith(("Twist", "Accel", "Wrench", "Vector3"))
    return bool(heard.stamps.any()) and not is_vector


def _is_measured(heard: Heard) -> bool:
    """Whether a topic's messages are measurements, judged by their type."""
    return heard.type.startswith("sensor_msgs/") or heard.type.endswith("WithCovarianceStamped")


def _name_them(model: Model, topics: Sequence[str]) -> tuple[Fix, ...]:
    """Return the next steps for topics whose messages have no frame name."""
    of_nodes: dict[str, list[str]] = defaultdict(list)
    unknown = []
    for topic in topics:
        nodes = sorted({one.node for one in model.evidence.publishers if one.topic == topic})
        if all(nodes) and nodes:
            of_nodes[several(nodes)].append(topic)
        else:
            unknown.append(f"`{{publishers}} {topic}`")
    fixes = [
        Fix(f"set header.frame_id in {nodes}, which publishes {several(told, 3)}")
        for nodes, told in of_nodes.items()
    ]
    if unknown:
        whose = "its publisher" if len(unknown) == 1 else "the publisher of each topic"
        text = f"find {whose}, and set header.frame_id there: {several(unknown, 3)}"
        fixes.append(Fix(text))
    return tuple(fixes[:_MOST_FIXES])


_MOST_FIXES = 3
"""Maximum number of remedies for topics without a frame name."""


@check(
    "rep105-shape",
    Severity.NOTE,
    rule="map and odom exist, and base is a child of map beside odom; or odom is a child of "
    "a base below map; or map is below odom; or base_footprint and base_link are both "
    "children of odom. A warning if base_footprint never moves in odom, while base_link moves in "
    "base_footprint by more than {metres:g} m",
    headline="map, odom and base are not arranged as in REP-105: {where}",
    detail="{found}",
    consequence="{so}",
    causes=("a localiser publishes map to base_link",),
    links=(
        REP105,
        *threads("rsasaki0109/lidar_slam_ros2#86", "ros-navigation/navigation2#5095"),
    ),
    limits={"metres": 1.0},
    because_of=(
        ("child", "publisher-conflict two-parents"),
        ("frame", "slash-twins namespace-twins case-twins typo-twins"),
    ),
)
def rep105_shape(model: Model, limits: Limits) -> Iterator[Hit]:
    """The frames map, odom and base are not arranged as in REP-105."""
    named: dict[str, list[str]] = defaultdict(list)
    for frame in sorted(model.frames):
        named[last_part(frame)].append(frame)
    parent_of = {child: track.parent for child, track in model.parents.items()}
    for foot in named["base_footprint"]:
        held = model.parents.get(foot)
        if held is None or held.parent not in named["odom"] or held.moves:
            continue
        for link in named["base_link"]:
            track = model.parents.get(link)
            if track is None or track.parent != foot or not len(track.by_stamp):
                continue
            moved = float(np.ptp(track.translations[track.by_stamp, :2], axis=0).max())
            if moved > limits["metres"]:
                text = f"{held.name} never moves, while {track.name} moves by {metres(moved)}"
                hit = _shape(model, held.edge, text, track.edge)
                sender = ", ".join(held.nodes) or f"the publisher of {held.name}"
                cure = (
                    f"find out why {sender} moves {link} in {foot}, and not {foot} in {held.parent}"
                )
                so = f"programs that use {foot} as the robot's frame see a robot that stands still"
                yield replace(
                    hit,
                    severity=Severity.WARNING,
                    facts={"found": text, "so": so},
                    fixes=(Fix(cure),),
                )
    if not named["map"] or not named["odom"]:
        return
    for name in ("base_footprint", "base_link"):
        for base in named[name]:
            above = parent_of.get(base, "")
            chain = [track.parent for track in model.above(base)]
            if above in named["map"] and not set(named["odom"]) & set(chain):
                found = f"{base} is a child of {above}, beside odom"
                for odom in named["odom"]:
                    track = model.parents.get(odom)
                    if track is not None and not track.moves and len(model.below(odom)) == 1:
                        found += f"; {track.name} never moves, and {odom} has no children"
                yield _shape(model, (above, base), found)
            for odom in named["odom"]:
                if parent_of.get(odom) == base and set(chain) & set(named["map"]):
                    yield _shape(model, (base, odom), f"{odom} is a child of {base}, below map")
    for one in named["map"]:
        chain = [track.parent for track in model.above(one)]
        if set(chain) & set(named["odom"]):
            yield _shape(model, (chain[0], one), f"{one} is a child of {chain[0]}, below odom")
    for foot in named["base_footprint"]:
        for link in named["base_link"]:
            above = parent_of.get(foot, "")
            if above in named["odom"] and parent_of.get(link) == above:
                text = f"{foot} and {link} are both children of {above}"
                yield _shape(model, (above, link), text, (above, foot))


def _shape(model: Model, edge: tuple[str, str], found: str, *more: tuple[str, str]) -> Hit:
    track = model.parents[edge[1]]
    nodes = ", ".join(track.nodes) or f"its publisher (`{{publishers}} {track.topics[0]}`)"
    return Hit(
        edges=(edge, *more),
        frames=tuple(dict.fromkeys(name for one in (edge, *more) for name in one)),
        confidence=Confidence.LIKELY,
        facts={
            "found": found,
            "so": "programs that expect REP-105 (odom in map, base in odom) get another pose or "
            "none",
        },
        fixes=(Fix(f"look at the frame names in the settings of {nodes}"),),
    )
