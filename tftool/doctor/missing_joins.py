"""Proposals for missing transforms, derived from the data and the robot description."""

import re
import shlex
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from tftool.doctor.findings import Edge, Fix
from tftool.doctor.model import Model, Tree
from tftool.doctor.stamp_stream import BASES, JOINT_STATES, Heard, Track, last_part
from tftool.doctor.wording import is_ros1, several
from tftool.geometry.rigid import Transform

_PLAIN = frozenset({"base", "link", "frame", "footprint", "body", ""})

_WORLDS = frozenset({"map", "odom", "world", "earth", "ecef", "wgs84", "utm", "enu", "ned"})

_MOUNTED = frozenset(
    {"LaserScan", "PointCloud2", "Imu", "Image", "CameraInfo", "CompressedImage", "Range"}
    | {"NavSatFix", "MagneticField", "DepthImage"}
)


@dataclass(frozen=True, slots=True)
class Join:
    """Proposal for a missing transform.

    Attributes:
        edge: Parent and child to publish; None if unknown.
        why: The evidence, as a clause of a sentence.
        fix: The remedy.
        guess: Whether the evidence is only the name of a frame or a convention.
    """

    edge: Edge | None
    why: str
    fix: Fix
    guess: bool = True


def proposed_join(model: Model, main: Tree, lesser: Tree) -> Join | None:
    """Return a proposal for a transform that connects two trees; None without evidence.

    Args:
        model: Model of the evidence.
        main: The larger tree.
        lesser: The smaller tree.
    """
    if (replaced := _replaced(model, main, lesser)) is not None:
        return replaced
    for tree, other in ((lesser, main), (main, lesser)):
        found = _described(model, tree.root, other.frames) or _in_odometry(model, tree, other)
        if found is not None:
            return found
    if _are_two_robots(main, lesser):
        text = (
            "two robots: connect both to one frame, such as a map in which the localiser of each "
            f"robot publishes the robot's root ({main.root}, {lesser.root})"
        )
        return Join(None, "each of the two trees is a robot of its own", Fix(text))
    for tree, other in ((lesser, main), (main, lesser)):
        found = _localised(tree, other) or _by_another_name(model, tree, other)
        if found is not None:
            return found
    return None


def proposed_frame(model: Model, name: str, kinds: Iterable[str] = ()) -> Join | None:
    """Return a proposal for the transform of a frame that tf lacks; None without evidence.

    Args:
        model: Model of the evidence.
        name: Name of the frame.
        kinds: Types of the messages in this frame.
    """
    alone = Tree(name, frozenset({name}))
    for tree in model.trees:
        found = _described(model, name, tree.frames) or _in_odometry(model, alone, tree)
        if found is not None:
            return found
    bases = [one for tree in model.trees if (one := base_of(tree))]
    base = own_base(model, name) or (bases[0] if len({prefix(one) for one in bases}) == 1 else "")
    if model.lacks_statics and not is_mount(model, name):
        return None
    if is_world(name) or not any(last_part(kind) in _MOUNTED for kind in kinds):
        return None
    fixed = f", fixed to {base}" if base else ""
    text = f"if {name} is a separate part of the robot{fixed}, publish its pose:"
    return Join((base, name) if base else None, "", _mount(model, text, base or "PARENT", name))


def own_trees(
    model: Model, odd: Sequence[Track | Heard], others: Sequence[Track | Heard]
) -> tuple[str, ...]:
    """Return the frames of the trees whose stamps all come from the odd clock.

    The result is empty if a tree has data of both clocks.

    Args:
        model: Model of the evidence.
        odd: Edges and topics on the odd clock.
        others: Edges and topics on the other clock.
    """
    trees: list[set[str]] = []
    for group in (odd, others):
        used = {
            one.child if isinstance(one, Track) else one.frame.lstrip("/")
            for one in group
            if isinstance(one, Track) or one.type != JOINT_STATES
        }
        if not used <= model.frames:
            return ()  # nothing shows where such data belongs
        trees.append({model.tree_of[frame].root for frame in used})
    if trees[0] & trees[1]:
        return ()
    return tuple(sorted(frame for frame in model.frames if model.tree_of[frame].root in trees[0]))


def has_base(model: Model) -> bool:
    """Whether the transforms contain a robot's base frame, such as base_link."""
    return any(base_of(tree) for tree in model.trees)


def is_mount(model: Model, name: str) -> bool:
    """Whether a frame that tf lacks is probably mounted on the robot, judged by its name.

    Links of the robot description count as mounts, but base frames do not. The result is False if
    tf has no frame of a robot at all.
    """
    around = all(is_world(frame) or last_part(frame).startswith("odom") for frame in model.frames)
    if around or last_part(name) in BASES:
        return False
    return name in model.described or _MOUNT.search(last_part(name).lower()) is not None


_MOUNT = re.compile(
    r"link|sensor|laser|lidar|scan(?!match)|range|velodyne|hokuyo|ouster|livox|imu|optical|depth"
    r"|cam(?!era_init)|stereo|kinect|gps|gnss|navsat|antenna|sonar|ultra|radar|bumper"
)
"""Words in the names of mounts; camera_init and scanmatcher_frame are moving frames."""


def is_world(name: str) -> bool:
    """Whether a name is that of a world frame, such as map, and not of a frame on a robot."""
    return not _WORLDS.isdisjoint(last_part(name).lower().split("_"))


def _described(model: Model, root: str, others: frozenset[str]) -> Join | None:
    """Propose the description's joint between a root and a frame in `others`, or return None."""
    joint = model.joint_above.get(root)
    if joint is None or model.prefix + joint.parent not in others:
        return None
    parent, why = model.prefix + joint.parent, f"the robot description joins them by {joint.name}"
    if joint.type != "fixed":
        return Join((parent, root), why, Fix(f"{why}: publish its state"), guess=False)
    fix = _mount(model, f"{why}: start robot_state_publisher, or", parent, root, joint.origin)
    return Join((parent, root), why, fix, guess=False)


def _in_odometry(model: Model, tree: Tree, other: Tree) -> Join | None:
    """Propose the edge from `tree` to `other` that Odometry messages contain, or return None."""
    odometry = model.evidence.odometry
    if odometry is None:
        return None
    for edge in odometry.edges:
        if edge.parent not in tree.frames or edge.child not in other.frames:
            continue
        by = ", ".join(Track(edge, odometry).topics)
        why = f"{len(edge):,} Odometry messages ({by}) say {edge.child} in {edge.parent}"
        mend = f"let the publisher of {by}, or a filter that uses the messages, publish it"
        if edge.child in model.parents:
            # The odometry's own edge would give the child a second parent.
            held = model.parents[edge.child].parent
            mend = f"{edge.child} has the parent {held}, so publish {other.root} in {edge.parent}"
        fix = Fix(
            f"{why}, and nothing publishes this transform: {mend}; to use the messages meanwhile:",
            f"tftool echo {quoted(edge.parent)} {quoted(edge.child)} RECORDING --with-odometry",
        )
        return Join((edge.parent, edge.child), why, fix, guess=False)
    return None


def _replaced(model: Model, main: Tree, lesser: Tree) -> Join | None:
    """Propose the edge that once connected two trees, before its child got another parent.

    Return None if no edge ever connected the trees.
    """
    for track in model.tracks:
        ends = {model.tree_of[name].root for name in track.edge}
        if ends == {main.root, lesser.root}:
            other = model.parents[track.child]
            why = f"{track.name} joined them until {track.child} got the parent {other.parent}"
            fix = Fix(f"{why}: keep one of the two parents")
            if track.static and not other.static:
                fix = ends_at_the_root(model, [other], [track]) or fix
            return Join(track.edge, why, fix, guess=False)
    return None


def ends_at_the_root(model: Model, moving: Sequence[Track], statics: Sequence[Track]) -> Fix | None:
    """Return the remedy for a child frame with both a moving and a static parent.

    The remedy is to end the moving edge at the root of the static mounts. Return None if the result
    would not be a tree.

    Args:
        model: Model of the evidence.
        moving: Moving edges to the child.
        statics: Static edges to the child.
    """
    if {track.parent for track in moving} & {track.parent for track in statics}:
        return None
    # The newest parent may be the moving one. The mounts' root is above the static parent.
    parent = statics[-1].parent
    above = [track.parent for track in model.above(parent)]
    root = above[-1] if above else parent
    if {track.parent for track in moving} & {parent, *above}:
        return None
    return Fix(
        f"publish {root}, the root of the mounts, in {moving[0].parent} instead of "
        f"{moving[0].child}, or leave {parent} out of the mounts"
    )


def _localised(tree: Tree, other: Tree) -> Join | None:
    """Propose the edge from a map frame in `other` to the root of `tree`, an odom frame (REP-105).

    Return None for other trees.
    """
    if not last_part(tree.root).startswith(("odom", "camera_init")):
        return None
    # The map of another robot is not that of this one.
    maps = sorted(
        frame
        for frame in other.frames
        if last_part(frame) == "map" and len({prefix(frame), prefix(tree.root), ""}) < 3
    )
    if not maps:
        return None
    why = f"REP-105 has a localiser publish {tree.root} in {maps[0]}"
    fix = Fix(f"{why}: check whether a localiser runs, and which frames it publishes")
    return Join((maps[0], tree.root), why, fix)


def _by_another_name(model: Model, tree: Tree, other: Tree) -> Join | None:
    """Propose an edge between the root of `tree` and a frame of `other` with a similar name.

    For example, base_footprint and base_link are similar names. Return None without similar names.
    """
    root = tree.root
    for name in sorted(other.frames):
        if prefix(name) != prefix(root) or distinctive_words(name) != distinctive_words(root):
            continue
        why = f"the names {name} and {root} are similar: both may be frames of one part"
        if model.lacks_statics and model.evidence.recorded:
            return Join((name, root), why, _mount(model, why, name, root))
        return Join(
            (name, root), why, Fix(f"{why}: check which of the two its publisher should use")
        )
    return None


def _mount(model: Model, text: str, parent: str, child: str, pose: Transform | None = None) -> Fix:
    """Return the remedy for a missing static transform: a command that publishes the transform.

    If the recording lacks all static transforms, the remedy is to record or add them.
    """
    if not model.lacks_statics or not model.evidence.recorded:
        return Fix(text, static_publisher(parent, child, pose, ros1=is_ros1(model.evidence)))
    if model.lacks_state_publisher:
        return Fix(
            f"{start_of_publisher(model, [child])}; to repair the recording:",
            "tftool edit RECORDING -o WHOLE --statics-from DESCRIPTION",
        )
    # The robot probably sends it: a second publisher would contradict the first one.
    return Fix(
        f"no statics were recorded: if {child} in {parent} is static, record /tf_static too, or "
        "take the statics from another recording or the robot description:",
        "tftool edit RECORDING -o WHOLE --statics-from OTHER",
    )


def start_of_publisher(model: Model, frames: Sequence[str]) -> str:
    """Return the remedy for frames that robot_state_publisher would publish, if it does not run.

    Without the description, nothing proves that the frames are links of the robot.
    """
    text = "check whether robot_state_publisher runs; if not, start it with the robot's description"
    if unproved := [frame for frame in frames if frame not in model.described]:
        text += f" (it publishes only links of the description: look there for {several(unproved)})"
    return text


def distinctive_words(name: str) -> frozenset[str]:
    """Return the distinctive words of a frame name, such as "laser" for base_laser_link."""
    return frozenset(last_part(name).lower().split("_")) - _PLAIN


def _are_two_robots(main: Tree, lesser: Tree) -> bool:
    """Whether each tree has a base frame, and the bases belong to two robots."""
    ours, theirs = _bases(main), _bases(lesser)
    if not ours or not theirs:
        return False
    same_names = {last_part(name) for name in ours} & {last_part(name) for name in theirs}
    return bool(same_names) or {prefix(n) for n in ours}.isdisjoint(prefix(n) for n in theirs)


def _bases(tree: Tree) -> set[str]:
    names = {frame for frame in tree.frames if last_part(frame) in BASES}
    return names if len(tree.frames) > 1 else set()


def prefix(name: str) -> str:
    """Return the part of a frame name up to its last slash, such as the name of a robot."""
    return name.removesuffix(last_part(name))


def base_of(tree: Tree) -> str:
    """Return the name of a tree's base frame, such as base_link; empty without a base frame."""
    for name in (*BASES, "body"):
        found = sorted(frame for frame in tree.frames if last_part(frame) == name)
        if found:
            return found[0]
    return ""


def own_base(model: Model, name: str) -> str:
    """Return the base frame with the prefix of a frame name; empty without a prefix or a base."""
    bases = [one for tree in model.trees if (one := base_of(tree))]
    return next((one for one in bases if prefix(name) and prefix(one) == prefix(name)), "")


def static_publisher(
    parent: str, child: str, pose: Transform | None = None, *, ros1: bool = False
) -> str:
    """Return the shell command that publishes a static transform.

    If the pose is None, the command contains placeholders such as X and YAW.
    """
    if ros1:
        known = () if pose is None else (*pose.translation, *pose.rotation)
        numbers = " ".join(f"{one:.9g}" for one in known) or "X Y Z YAW PITCH ROLL"
        return (
            f"rosrun tf2_ros static_transform_publisher {numbers} {quoted(parent)} {quoted(child)}"
        )
    numbers = "--x X --y Y --z Z --yaw A"
    if pose is not None:
        names = ("x", "y", "z", "qx", "qy", "qz", "qw")
        values = (*pose.translation, *pose.rotation)
        numbers = " ".join(f"--{a} {b:.9g}" for a, b in zip(names, values, strict=True))
    return (
        f"ros2 run tf2_ros static_transform_publisher {numbers} "
        f"--frame-id {quoted(parent)} --child-frame-id {quoted(child)}"
    )


def mount_command(model: Model, main: Tree, root: str) -> str:
    """Return the shell command that publishes a sensor's mount on a robot; empty for other frames.

    Args:
        model: Model of the evidence.
        main: The robot's tree.
        root: Root of another tree: the frame of the sensor.
    """
    base = base_of(main)
    if not base or model.lacks_statics or not is_mount(model, root):
        return ""
    return static_publisher(base, root, ros1=is_ros1(model.evidence))


def quoted(name: str) -> str:
    """Quote a name for a shell's command line."""
    return shlex.quote(name)
