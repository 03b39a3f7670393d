"""Robots: joint states to frames, and a robot of 130 links in a browser without a graphics card."""

import time
from collections.abc import Awaitable

import numpy as np

from tests.benchmarks import page
from tftool.base.stamps import seconds
from tftool.robots.joint_states import JointStates
from tftool.robots.robot_model import Robot
from tftool.robots.urdf import parse_description
from tftool.world.nodes.joints import MovingRobot
from tftool.world.world import World

LINKS = 130
ARMS = 10
STATES, JOINTS = 200_000, 6
WANTED_TRANSFORMS = 3e6


def arms(links: int, count: int) -> str:
    """A robot of so many links in so many arms, each link a cylinder and a box."""
    shapes = (
        '<visual><origin xyz="0 0 0.1"/><geometry><cylinder radius="0.03" length="0.2"/>'
        '</geometry></visual><visual><geometry><box size="0.08 0.08 0.08"/></geometry></visual>'
    )
    parts = [f'<link name="base">{shapes}</link>']
    for n in range(links - 1):
        arm, place = n % count, n // count
        parent = f"link{n - count}" if place else "base"
        origin = "0 0 0.2" if place else f"{0.5 * (arm % 5):.1f} {0.5 * (arm // 5):.1f} 0"
        axis = ("0 0 1", "0 1 0", "1 0 0")[place % 3]
        parts.append(
            f'<link name="link{n}">{shapes}</link>'
            f'<joint name="joint{n}" type="revolute"><origin xyz="{origin}"/><axis xyz="{axis}"/>'
            f'<parent link="{parent}"/><child link="link{n}"/>'
            '<limit lower="-0.5" upper="0.5" effort="1" velocity="1"/></joint>'
        )
    return f'<robot name="arms">{"".join(parts)}</robot>'


def transforms_a_second() -> float:
    """Transforms for each second of processor time, the buffer's own work included."""
    robot = Robot(parse_description(arms(JOINTS + 1, 1)))
    stamps = 10**9 + 10_000_000 * np.arange(STATES)
    positions = np.random.default_rng(1).uniform(-0.5, 0.5, (STATES, JOINTS))
    states = JointStates([f"joint{n}" for n in range(JOINTS)], stamps, positions)
    times = []
    for _ in range(7):
        began = time.process_time()
        robot.buffer(states)
        times.append(time.process_time() - began)
    return STATES * JOINTS / sorted(times)[len(times) // 2]


def pictures_a_second() -> float | None:
    """How many pictures a second a headless browser draws of the robot; None without one."""
    from tftool.screens.browser.robots import ShownRobot

    robot = Robot(parse_description(arms(LINKS, ARMS)))

    def move(world: World) -> Awaitable[None]:
        return MovingRobot(world, file=robot, motion="sine", period=seconds(1 / 30)).run()

    ready = f"Object.keys(globalThis.tftool?.robot().links ?? {{}}).length >= {LINKS}"
    return page.pictures_a_second(move, "view=orbit&names=0", ready, ShownRobot(robot))


def report() -> str:
    """Measure, and say it in a few lines."""
    rate = transforms_a_second()
    lines = [
        f"joint states to frames: {rate / 1e6:.1f} M transforms/s "
        f"(wanted: {WANTED_TRANSFORMS / 1e6:.0f} M or more)"
    ]
    lines.append(page.told(f"a robot of {LINKS} links", pictures_a_second()))
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())  # noqa: T201
