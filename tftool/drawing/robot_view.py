"""Content of a robot description, as text lines and as JSON."""

from typing import Any

from tftool.base.plain_text import count, visible
from tftool.drawing.recording_view import table, wrapped
from tftool.robots.description import RobotJoint
from tftool.robots.robot_model import Robot


def as_text(name: str, robot: Robot, width: int | None = None) -> str:
    """Return the content of a robot description as text lines.

    Args:
        name: Name of the description, as given.
        robot: The described robot.
        width: Longest line in cells; columns without room are left out. None for no limit.
    """
    links, joints = robot.links, robot.joints
    moving = sum(joint.moves for joint in joints.values())
    lines = [
        f"{visible(name)}: description of robot '{visible(robot.name)}'",
        f"{count(len(links), 'link')}, {count(len(joints), 'joint')}, {moving} of them "
        f"{'moves' if moving == 1 else 'move'}",
        f"Root: {visible(robot.root)}",
        _mass(robot),
    ]
    if joints:
        rest = robot.positions()
        lines += ["", "Joints"]
        lines += table(
            ("name", "type", "frames", "limits", "at rest", "mimics"),
            [
                (
                    visible(joint.name),
                    joint.type,
                    f"{visible(joint.child)} in {visible(joint.parent)}",
                    _limits(joint),
                    f"{rest[joint.name]:.4g}" if joint.moves else "-",
                    _mimic(joint),
                )
                for joint in joints.values()
            ],
            width,
            goes=("mimics", "frames", "type"),
        )
    if robot.notes:
        lines += ["", "Odd"]
        for note in robot.notes:
            lines += wrapped(visible(note), width, "  ")
    return "\n".join(lines) + "\n"


def as_object(name: str, robot: Robot) -> dict[str, Any]:
    """Return a robot description as a mapping, for --json; radians, metres, kilograms."""
    rest = robot.positions()
    return {
        "name": name,
        "kind": "robot description",
        "robot": robot.name,
        "root": robot.root,
        "links": [{"name": link.name, "mass": link.mass} for link in robot.links.values()],
        "joints": [
            {
                "name": joint.name,
                "type": joint.type,
                "parent": joint.parent,
                "child": joint.child,
                "lower": joint.limit.lower if joint.limit else None,
                "upper": joint.limit.upper if joint.limit else None,
                "at_rest": rest.get(joint.name),
                "mimics": None
                if joint.mimic is None
                else {
                    "joint": joint.mimic.joint,
                    "multiplier": joint.mimic.multiplier,
                    "offset": joint.mimic.offset,
                },
            }
            for joint in robot.joints.values()
        ],
        "notes": list(robot.notes),
    }


def _mass(robot: Robot) -> str:
    masses = [link.mass for link in robot.links.values() if link.mass is not None]
    if not masses:
        return "Mass: not given"
    return f"Mass: {sum(masses):.4g} kg in {count(len(masses), 'link')}"


def _limits(joint: RobotJoint) -> str:
    if joint.limits is None:
        return "-"
    lower, upper = joint.limits
    return f"{lower:.4g} {joint.unit} … {upper:.4g} {joint.unit}"


def _mimic(joint: RobotJoint) -> str:
    if joint.mimic is None:
        return "-"
    shift = f" {joint.mimic.offset:+.4g}" if joint.mimic.offset else ""
    return f"{joint.mimic.multiplier:.4g} · {visible(joint.mimic.joint)}{shift}"
