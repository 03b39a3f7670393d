"""A rover with an arm that drives in a circle, as in the picture of the view."""

import asyncio
import math

from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.robots.robot_model import Robot
from tftool.robots.urdf import parse_description
from tftool.screens.browser.robots import ShownRobot
from tftool.world.nodes.joints import MovingRobot
from tftool.world.world import World

PERIOD = 0.05
"""Time between two steps of the drive, seconds."""


def _visual(shape: str, colour: str, xyz: str = "0 0 0", rpy: str = "0 0 0") -> str:
    return (
        f'<visual><origin xyz="{xyz}" rpy="{rpy}"/><geometry>{shape}</geometry>'
        f'<material name="{colour}"/></visual>'
    )


def _joint(name: str, kind: str, parent: str, child: str, xyz: str, axis: str) -> str:
    limit = '<limit lower="-0.9" upper="0.9" effort="1" velocity="1"/>'
    return (
        f'<joint name="{name}" type="{kind}"><origin xyz="{xyz}"/><parent link="{parent}"/>'
        f'<child link="{child}"/>'
        + ("" if kind == "fixed" else f'<axis xyz="{axis}"/>{limit if kind == "revolute" else ""}')
        + "</joint>"
    )


def description() -> str:
    """Return the rover's URDF."""
    colours = {"hull": "0.92 0.55 0.15 1", "dark": "0.33 0.36 0.41 1", "pale": "0.85 0.87 0.9 1"}
    colours["eye"] = "0.2 0.55 0.95 1"
    parts = [
        f'<material name="{name}"><color rgba="{rgba}"/></material>'
        for name, rgba in colours.items()
    ]
    links = {
        "base_link": [
            _visual('<box size="0.9 0.5 0.18"/>', "hull", "0 0 0.25"),
            _visual('<box size="0.7 0.4 0.06"/>', "dark", "-0.05 0 0.37"),
        ],
        "arm_base": [_visual('<cylinder radius="0.1" length="0.12"/>', "dark", "0 0 0.06")],
        "upper_arm": [
            _visual('<cylinder radius="0.055" length="0.45"/>', "pale", "0 0 0.225"),
            _visual('<sphere radius="0.08"/>', "hull"),
        ],
        "forearm": [
            _visual('<cylinder radius="0.045" length="0.4"/>', "pale", "0 0 0.2"),
            _visual('<sphere radius="0.065"/>', "hull"),
        ],
        "gripper": [
            _visual('<box size="0.05 0.16 0.05"/>', "dark", "0 0 0.025"),
            _visual('<box size="0.03 0.02 0.12"/>', "dark", "0 0.06 0.1"),
            _visual('<box size="0.03 0.02 0.12"/>', "dark", "0 -0.06 0.1"),
        ],
        "mast": [_visual('<cylinder radius="0.025" length="0.5"/>', "dark", "0 0 0.25")],
        "camera": [_visual('<box size="0.1 0.2 0.08"/>', "eye")],
    }
    joints = [
        _joint("waist", "continuous", "base_link", "arm_base", "0.25 0 0.4", "0 0 1"),
        _joint("shoulder", "revolute", "arm_base", "upper_arm", "0 0 0.12", "0 1 0"),
        _joint("elbow", "revolute", "upper_arm", "forearm", "0 0 0.45", "0 1 0"),
        _joint("wrist", "fixed", "forearm", "gripper", "0 0 0.4", "0 0 1"),
        _joint("mast_mount", "fixed", "base_link", "mast", "-0.3 0 0.4", "0 0 1"),
        _joint("camera_mount", "fixed", "mast", "camera", "0.03 0 0.5", "0 0 1"),
    ]
    for side, y in (("left", 0.3), ("right", -0.3)):
        for end, x in (("front", 0.3), ("rear", -0.3)):
            name = f"{end}_{side}_wheel"
            tyre = '<cylinder radius="0.16" length="0.1"/>'
            hub = '<cylinder radius="0.07" length="0.11"/>'
            links[name] = [
                _visual(tyre, "dark", rpy="1.5708 0 0"),
                _visual(hub, "pale", rpy="1.5708 0 0"),
            ]
            joints.append(_joint(f"{name}_mount", "fixed", "base_link", name, f"{x} {y} 0.16", ""))
    parts += [f'<link name="{name}">{"".join(visuals)}</link>' for name, visuals in links.items()]
    return f'<robot name="rover">{"".join(parts)}{"".join(joints)}</robot>'


def rover() -> ShownRobot:
    """Return the rover as the page draws it."""
    return ShownRobot(Robot(parse_description(description())))


def drive(world: World, shown: ShownRobot) -> None:
    """Drive the rover in a circle and move its arm, with past poses for the trails."""
    arm = MovingRobot(world, file=shown.robot, motion="sine", period=seconds(PERIOD))
    world.driving = asyncio.gather(arm.run(), _circle(world))  # asyncio does not store it


async def _circle(world: World) -> None:
    clock = world.clock
    while True:
        now = clock.now()
        angle = 0.35 * (now - clock.epoch) / 1e9
        x, y = math.cos(angle), math.sin(angle)
        yaw = angle + math.pi / 2
        turned = (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))
        poses = [
            TransformStamped(now, "map", "odom", Transform((0.2, -0.1, 0.0))),
            TransformStamped(now, "odom", "base_link", Transform((x, y, 0.0), turned)),
        ]
        world.broadcast(poses, "drive")
        await clock.sleep(seconds(PERIOD))
