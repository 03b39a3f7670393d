"""Checks of a robot description against tf: links without a frame, mounts with other poses."""

import math
from collections.abc import Iterator

import numpy as np

from tftool.doctor.check import checks_of, hit_of, threads
from tftool.doctor.findings import Area, Fix, Hit, Severity
from tftool.doctor.missing_joins import has_base
from tftool.doctor.model import Limits, Model
from tftool.doctor.stamp_stream import JOINT_STATES, PLACED, last_part
from tftool.doctor.wording import several
from tftool.geometry.quaternions import angle_between
from tftool.geometry.rigid_arrays import unit
from tftool.robots.description import RobotJoint
from tftool.robots.robot_model import Robot

check = checks_of(Area.DESCRIPTION)

_STATES = "find out who publishes joint states: `{publishers} {states}`"


@check(
    "urdf-invalid",
    Severity.ERROR,
    rule="the description is not XML, has no root or several roots, a joint names a missing link, "
    "joints form a loop, or a name is used twice. A warning if a recording has transforms of a "
    "base frame",
    headline="the robot description cannot be read",
    detail="{mistakes}",
    consequence="robot_state_publisher refuses it or publishes a part; the doctor does not use it",
    fixes=(Fix("correct the description: `tftool info FILE` shows each mistake with its line"),),
    causes=(
        "a link was renamed and its joint was not",
        "xacro that was not expanded",
    ),
    needs=("description",),
)
def urdf_invalid(model: Model, limits: Limits) -> Iterator[Hit]:
    """The robot description has mistakes."""
    mistakes = model.evidence.mistakes
    if mistakes:
        # A robot whose frames were recorded works, whatever reads its description.
        works = model.evidence.recorded and has_base(model)
        yield Hit(
            count=len(mistakes),
            facts={"mistakes": list(mistakes)},
            severity=Severity.WARNING if works else None,
            alone=True,
        )


@check(
    "joint-without-state",
    Severity.ERROR,
    rule="a movable joint that mimics no other joint is in no JointState message of the recording, "
    "and its link is in no transform. A warning if no scan, point cloud or range is in a "
    "frame below the joint",
    headline="{joint} has no state, so {child} has no frame",
    detail="{joint} ({kind}) moves {below}{silent}",
    consequence="robot_state_publisher publishes nothing below such a joint",
    fixes=(Fix(_STATES),),
    causes=(
        "joint_state_publisher or the joint state broadcaster was not started",
        "a plug-in publishes the driven joints only",
        "casters",
    ),
    links=threads("LeoRover/leo_simulator#6", "iRobotEducation/create3_sim#203"),
    needs=(
        "description",
        "valid description",
        "joint states",
    ),
)
def joint_without_state(model: Model, limits: Limits) -> Iterator[Hit]:
    """A movable joint has no joint state, so its link has no frame."""
    robot, told = model.evidence.robot, model.evidence.joints
    if robot is None or told is None:
        return
    recorded = [one for one in model.evidence.topics if one.type == JOINT_STATES]
    topics = sorted(one.name for one in recorded)
    is_silent = bool(recorded) and not any(one.count for one in recorded)
    for joint in robot.joints.values():
        child = model.prefix + joint.child
        if not joint.moves or joint.mimic is not None or joint.name in told:
            continue
        if child in model.parents:
            continue  # another node publishes its pose
        below = [model.prefix + link for link in links_below(robot, joint)]
        yield Hit(
            edges=((model.prefix + joint.parent, child),),
            frames=(child, *(link for link in below if link != child)),
            facts={
                "joint": joint.name,
                "child": child,
                "below": below,
                "kind": joint.type,
                "states": topics[0] if topics else "/joint_states",
                "silent": f"; {several(topics)} has no message" * is_silent,
            },
            severity=None
            if any(last_part(h.type) in PLACED and h.frame in (child, *below) for h in model.heard)
            else Severity.WARNING,
        )


def links_below(robot: Robot, joint: RobotJoint) -> list[str]:
    """Return all of the robot's links whose pose depends on the joint `joint`.

    These are the links below the joint, and the links below all joints that mimic it.
    """
    joints_below: dict[str, list[RobotJoint]] = {}
    followers: dict[str, list[RobotJoint]] = {}
    for other in robot.joints.values():
        joints_below.setdefault(other.parent, []).append(other)
        if other.mimic is not None:
            followers.setdefault(other.mimic.joint, []).append(other)
    found: dict[str, None] = {}
    waiting = [joint]
    while waiting:
        one = waiting.pop(0)
        if one.child not in found:
            found[one.child] = None
            waiting += joints_below.get(one.child, ())
            waiting += followers.get(one.name, ())
    return list(found)


@check(
    "urdf-frame-unpublished",
    Severity.WARNING,
    rule="a link of the robot description is in no transform of the whole recording. A note if no "
    "message is in the frame of the link",
    headline="no transform contains {where} of the robot description",
    detail="{frame}: {reason}",
    consequence="nothing can be placed in these frames",
    causes=(
        "robot_state_publisher does not run, or with another description than the robot's",
        "/tf_static was not recorded",
        "a movable joint has no state",
    ),
    links=threads("iRobotEducation/create3_sim#203"),
    needs=(
        "description",
        "valid description",
    ),
    because_of=(
        ("frame", "static-missing unknown-frame split-tree"),
        ("frame", "joint-without-state"),
    ),
)
def urdf_frame_unpublished(model: Model, limits: Limits) -> Iterator[Hit]:
    """A link of the robot description is never published in tf."""
    robot = model.evidence.robot
    if robot is None:
        return
    joint_of = {joint.child: joint for joint in robot.joints.values()}
    missing = [link for link in robot.links if model.prefix + link not in model.frames]
    for link in missing:
        frame, joint = model.prefix + link, joint_of.get(link)
        if joint is None:
            reason = "the root of the description"
        elif joint.type == "fixed":
            reason = f"fixed to {joint.parent}: no static transform names it"
        elif joint.type == "floating":
            reason = f"floating in {joint.parent}: robot_state_publisher leaves it out"
        else:
            reason = f"moved by {joint.name} ({joint.type}): no joint state has its position"
        yield Hit(
            edges=() if joint is None else ((model.prefix + joint.parent, frame),),
            frames=(frame,),
            facts={"frame": frame, "reason": reason},
            severity=None if any(h.frame == frame for h in model.heard) else Severity.NOTE,
        )


@check(
    "urdf-tf-mismatch",
    Severity.WARNING,
    rule="a static and the fixed joint of the same two links differ by more than {metres:g} "
    "m or {degrees:g}°",
    headline="{where} {concerned:differs|differ} from the robot description",
    detail="{edge}: {apart:m} and {turned:deg} apart; {joint} has {says}, tf {has}",
    consequence="programs that use the description and programs that use tf place this part "
    "differently",
    fixes=(Fix("find its publishers: `{publishers} /tf_static` lists them"),),
    causes=(
        "a calibration is published beside the description",
        "the robot runs with an older description",
    ),
    limits={"metres": 0.001, "degrees": 0.1},
    needs=(
        "description",
        "valid description",
    ),
    because_of=(("edge", "static-changed"),),
)
def urdf_tf_mismatch(model: Model, limits: Limits) -> Iterator[Hit]:
    """A static transform differs from the fixed joint in the robot description."""
    robot = model.evidence.robot
    if robot is None:
        return
    statics = {track.edge: track for track in model.statics if len(track.by_stamp)}
    for joint in robot.joints.values():
        track = statics.get((model.prefix + joint.parent, model.prefix + joint.child))
        if joint.type != "fixed" or track is None:
            continue
        place = track.last
        apart = math.dist(track.translations[place].tolist(), joint.origin.translation)
        qx, qy, qz, qw = unit(track.rotations[place]).tolist()
        turned = angle_between((qx, qy, qz, qw), joint.origin.rotation)
        if apart > limits["metres"] or turned > np.radians(limits["degrees"]):
            yield hit_of(
                track,
                {
                    "joint": joint.name,
                    "apart": apart,
                    "turned": turned,
                    "says": _numbers(joint.origin.translation),
                    "has": _numbers(track.translations[place].tolist()),
                },
                frames=(track.child,),
                count=1,
            )


def _numbers(numbers: "list[float] | tuple[float, ...]") -> str:
    return " ".join(f"{number:g}" for number in numbers)
