"""Explanation of a lookup between two links of a robot description: the joints between them.

A description has no times. So a lookup fails for two reasons only: the description lacks one of the
links, or a joint between the links has no position.
"""

import shlex
from collections.abc import Mapping
from dataclasses import dataclass

from tftool.base.common_ancestor import climbed, up_to_join
from tftool.base.errors import TransformException
from tftool.base.plain_text import near_names
from tftool.doctor.missing_joins import static_publisher
from tftool.doctor.wording import several
from tftool.robots.description import RobotJoint
from tftool.robots.robot_model import Robot


@dataclass(frozen=True, slots=True)
class ChainLink:
    """One joint between two links.

    Attributes:
        joint: The joint.
        position: Joint position, radians or metres; None if the joint is fixed.
        is_given: Whether the user gave the position of `leader`.
        leader: Name of the joint that determines the position: the joint itself, or the joint
            that a mimic joint follows.
        is_known: Whether the pose of the child link is known; False for a floating joint.
    """

    joint: RobotJoint
    position: float | None
    is_given: bool
    leader: str
    is_known: bool


@dataclass(frozen=True, slots=True)
class ChainExplanation:
    """Explanation of a lookup between two links of a description.

    Attributes:
        target: Target link of the lookup.
        source: Source link of the lookup.
        exception: Name of tf2's exception; empty if the lookup succeeds.
        text: Text of tf2's error.
        cause: "works", "unknown-frame", or "split" for a joint without a position.
        links: The joints from source to target, in this order.
        why: The cause in sentences.
        remedies: Remedies, each as a sentence and a shell command, which may be empty.
    """

    target: str
    source: str
    exception: str
    text: str
    cause: str
    links: tuple[ChainLink, ...]
    why: tuple[str, ...]
    remedies: tuple[tuple[str, str], ...]

    @property
    def available(self) -> bool:
        """Whether the lookup succeeds."""
        return not self.exception


def chained(
    robot: Robot, given: Mapping[str, float], target: str, source: str, name: str
) -> ChainExplanation:
    """Return the explanation of a lookup between two links of a description.

    Args:
        robot: The description.
        given: Positions that the user gave, by joint name.
        target: Target link of the lookup.
        source: Source link of the lookup.
        name: Name of the description on the command line.

    Raises:
        UsageError: If a joint is unknown or does not move.
    """
    exception = text = ""
    try:
        robot.buffer(given).lookup_transform(target, source)
    except TransformException as refused:
        exception, text = type(refused).__name__, str(refused).strip("\n")
    unknown = [one for one in dict.fromkeys((target, source)) if one not in robot.links]
    if unknown:
        why, remedies = _unknown(robot, unknown)
        return ChainExplanation(target, source, exception, text, "unknown-frame", (), why, remedies)
    links = tuple(_link(robot, joint, given) for joint in _way(robot, target, source))
    lost = [link for link in links if not link.is_known]
    if lost:
        why, remedies = _lost(lost)
        return ChainExplanation(target, source, exception, text, "split", links, why, remedies)
    why, remedies = _answered(links, target, source, name)
    return ChainExplanation(target, source, exception, text, "works", links, why, remedies)


def _way(robot: Robot, target: str, source: str) -> list[RobotJoint]:
    """Return the joints from source to target; all links have one root, so a path exists."""
    joints = {joint.child: joint for joint in robot.joints.values()}
    legs = up_to_join(source, target, lambda link: climbed(link, joints.get))
    ups, downs = legs or ([], [])
    return [*ups, *reversed(downs)]


def _link(robot: Robot, joint: RobotJoint, given: Mapping[str, float]) -> ChainLink:
    if not joint.moves:
        return ChainLink(joint, None, False, joint.name, joint.type != "floating")
    leader = robot.leader(joint.name, given)
    return ChainLink(
        joint, robot.positions(given)[joint.name], leader in given, leader, is_known=True
    )


Told = tuple[tuple[str, ...], tuple[tuple[str, str], ...]]


def _unknown(robot: Robot, names: list[str]) -> Told:
    why, remedies = [], []
    for name in names:
        if name in robot.joints:
            child = robot.joints[name].child
            why.append(f"'{name}' is a joint of robot '{robot.name}', not a link")
            remedies.append((f"look up the link that it moves: {child}", ""))
            continue
        bare = name.lstrip("/")
        why.append(f"'{name}' is not a link of robot '{robot.name}'")
        near = near_names(name, robot.links, 3)
        if bare != name and bare in robot.links:
            remedies.append((f"leave out ROS 1's leading slash: {bare}", ""))
        elif near:
            remedies.append((f"did you mean {' or '.join(near)}?", ""))
        else:
            remedies.append((f"its links are {several(list(robot.links))}", ""))
    return tuple(why), tuple(remedies)


def _lost(lost: list[ChainLink]) -> Told:
    why = [
        f"the pose of {link.joint.child} in {link.joint.parent} is unknown: joint "
        f"'{link.joint.name}' is floating, so robot_state_publisher skips it, and another node "
        "must publish it"
        for link in lost
    ]
    first = lost[0].joint
    return tuple(why), (
        (
            "use a session or a recording with this transform, or publish it:",
            static_publisher(first.parent, first.child),
        ),
    )


def _answered(links: tuple[ChainLink, ...], target: str, source: str, name: str) -> Told:
    if not links:
        return ("both frames are the same link",), ()
    moving = [link for link in links if link.joint.moves]
    if not moving:
        return ("every joint on the path is fixed: this lookup works at all times",), ()
    leaders = list(dict.fromkeys(link.leader for link in moving))
    open_ones = list(dict.fromkeys(link.leader for link in moving if not link.is_given))
    move = "it moves" if len(leaders) == 1 else "they move"
    why = [
        f"on a running robot, this lookup works once joint states contain {several(leaders)}: "
        f"until then, robot_state_publisher does not publish the frames that {move}"
    ]
    for link in moving:
        limits = link.joint.limits
        follows = link.leader != link.joint.name
        if (
            follows
            and limits
            and link.position is not None
            and not limits[0] <= link.position <= limits[1]
        ):
            why.append(
                f"joint '{link.joint.name}', which follows '{link.leader}', is beyond its limits, "
                f"{limits[0]:.4g} to {limits[1]:.4g} {link.joint.unit}"
            )
    if not open_ones:
        return tuple(why), ()
    why.append(
        f"no position was given for {several(open_ones)}: such a joint is at zero if its limits "
        "allow zero, else in the middle of its limits"
    )
    words = ("tftool", "explain", target, source, name, "--joint", f"{open_ones[0]}=0.5")
    command = " ".join(map(shlex.quote, words))
    return tuple(why), (("to set the position of a joint:", command),)
