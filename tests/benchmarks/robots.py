"""Robots: joint states to frames, and a robot of 130 links in a browser without a graphics card."""

import struct
import tempfile
import time
from collections.abc import Awaitable
from pathlib import Path

import numpy as np

import tftool
from tests.benchmarks import page
from tftool.base.stamps import seconds
from tftool.robots.joint_motion import JointStates
from tftool.robots.robot_model import Robot
from tftool.robots.urdf import parse_description
from tftool.world.nodes.joints import MovingRobot
from tftool.world.world import World

LINKS = 130
ARMS = 10
PARTS, SLIDERS = 300, 30
WANTED_TASK = 100.0
WANTED_FIRST = 6.0
PICTURES = 200
STATES, JOINTS = 200_000, 6
WANTED_TRANSFORMS = 3e6


def arms(links: int, count: int) -> str:
    """Return a robot of many links in several arms; each link is a cylinder and a box."""
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


def machine(folder: Path) -> str:
    """Write a robot of many links with meshes of 2,000 triangles; some links slide."""
    for n in range(10):
        (folder / f"{n}.stl").write_bytes(ball(0.05 + 0.002 * n))
    parts = ['<link name="base"/>']
    for n in range(PARTS - 1):
        kind = "prismatic" if n < SLIDERS else "fixed"
        origin = f"{0.15 * (n % 20):.2f} {0.15 * (n // 20):.2f} 0"
        parts.append(
            f'<link name="part{n}"><visual><geometry><mesh filename="{n % 10}.stl"/></geometry>'
            f'</visual></link><joint name="slide{n}" type="{kind}"><origin xyz="{origin}"/>'
            f'<parent link="base"/><child link="part{n}"/><axis xyz="0 0 1"/>'
            '<limit lower="-0.1" upper="0.1" effort="1" velocity="1"/></joint>'
        )
    return f'<robot name="machine">{"".join(parts)}</robot>'


def ball(radius: float, rings: int = 32) -> bytes:
    """Return a sphere as binary STL."""
    polar, around = np.meshgrid(
        np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, rings + 1), indexing="ij"
    )
    points = radius * np.stack(
        [np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)], axis=-1
    )
    a, b, c, d = points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]
    corners = np.concatenate([np.stack([a, b, c], 2), np.stack([a, c, d], 2)]).reshape(-1, 3, 3)
    record = np.zeros(
        len(corners), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")]
    )
    record["corners"] = corners
    return bytes(80) + struct.pack("<I", len(corners)) + record.tobytes()


def transforms_a_second() -> float:
    """Return transforms per second of processor time, including the buffer's work."""
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
    """Return the pictures per second of the robot in a headless browser; None without a browser."""
    from tftool.screens.browser.robots import ShownRobot

    robot = Robot(parse_description(arms(LINKS, ARMS)))

    def move(world: World) -> Awaitable[None]:
        return MovingRobot(world, file=robot, motion="sine", period=seconds(1 / 30)).run()

    ready = f"Object.keys(globalThis.tftool?.robot().links ?? {{}}).length >= {LINKS}"
    return page.pictures_a_second(move, "view=orbit&names=0", ready, ShownRobot(robot))


def task_time() -> str:
    """Return the page's task time per picture of a machine with sliders, and its first picture."""
    from tftool.screens.browser.robots import ShownRobot

    what = f"{PARTS} links with meshes, {SLIDERS} of which slide"
    if not page.has_browser():
        return f"{what}: no chromium here"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "machine.urdf")
        path.write_text(machine(Path(folder)))
        robot = tftool.load_urdf(path)

        def move(world: World) -> Awaitable[None]:
            return MovingRobot(world, file=robot, motion="sine", period=seconds(1 / 30)).run()

        ready = f"Object.keys(globalThis.tftool?.robot().links ?? {{}}).length >= {PARTS - 1}"
        with page.shown(move, "view=orbit", ready, ShownRobot(robot)) as (stage, driver, first):
            driver.execute_cdp_cmd("Performance.enable", {})

            def spent() -> float:
                metrics = driver.execute_cdp_cmd("Performance.getMetrics", {})["metrics"]
                return next(one["value"] for one in metrics if one["name"] == "TaskDuration")

            times = []
            drawn, task = stage.pictures(), spent()
            end = drawn + PICTURES
            while drawn < end:
                page.pause(0.5)
                pictures, total = stage.pictures(), spent()
                if pictures > drawn:
                    times.append(1e3 * (total - task) / (pictures - drawn))
                drawn, task = pictures, total
    return (
        f"{what}: {np.median(times):.0f} ms of task time a picture (wanted: {WANTED_TASK:.0f} or "
        f"less), first picture after {first:.1f} s (wanted: {WANTED_FIRST:.0f} or less)"
    )


def report() -> str:
    """Measure, and print a few lines."""
    rate = transforms_a_second()
    lines = [
        f"joint states to frames: {rate / 1e6:.1f} M transforms/s "
        f"(wanted: {WANTED_TRANSFORMS / 1e6:.0f} M or more)"
    ]
    lines.append(page.told(f"a robot of {LINKS} links", pictures_a_second()))
    lines.append(task_time())
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())  # noqa: T201
