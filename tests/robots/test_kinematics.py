"""Tests of forward kinematics against yourdfpy, with random joint positions."""

import io

import numpy as np
import pytest

from tftool.robots.joint_motion import JointStates
from tftool.robots.robot_model import Robot
from tftool.robots.urdf import parse_description

yourdfpy = pytest.importorskip("yourdfpy", reason="yourdfpy is not installed")

COUNT = 1000


def arm(seed, joints=7):
    """Return an arm with joints in any directions, and a gripper whose fingers mimic each other."""
    draw = np.random.default_rng(seed)
    links = [f'<link name="link{n}"/>' for n in range(joints + 1)]
    parts = []
    for n in range(joints):
        kind = ("revolute", "continuous", "prismatic", "fixed")[int(draw.integers(4)) if n else 0]
        xyz, rpy, way = draw.normal(size=(3, 3))
        # yourdfpy treats a slide along an axis that is not a unit vector differently.
        way /= np.linalg.norm(way)
        xyz, rpy, axis = (" ".join(map(repr, one.tolist())) for one in (xyz, rpy, way))
        parts.append(
            f'<joint name="joint{n}" type="{kind}"><origin xyz="{xyz}" rpy="{rpy}"/>'
            f'<axis xyz="{axis}"/><parent link="link{n}"/><child link="link{n + 1}"/>'
            '<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>'
        )
    parts.append(
        '<link name="finger"/><joint name="grip" type="prismatic"><axis xyz="0 1 0"/>'
        f'<parent link="link{joints}"/><child link="finger"/>'
        '<mimic joint="joint0" multiplier="-0.5" offset="0.25"/>'
        '<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>'
    )
    return f'<robot name="arm">{"".join(links + parts)}</robot>'


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.filterwarnings("ignore")
def test_every_link_is_where_another_implementation_has_it(seed):
    text = arm(seed)
    robot = Robot(parse_description(text))
    other = yourdfpy.URDF.load(
        io.BytesIO(text.encode()), load_meshes=False, load_collision_meshes=False
    )
    names = [joint.name for joint in robot.joints.values() if joint.moves and not joint.mimic]
    assert sorted(other.actuated_joint_names) == sorted(names)

    vectors = np.random.default_rng(seed).uniform(-3, 3, (COUNT, len(names)))
    stamps = 10**9 + np.arange(COUNT)
    buffer = robot.buffer(JointStates(names, stamps, vectors))
    ours = {
        link: buffer.lookup_transforms("link0", link, stamps).matrices()
        for link in robot.links
        if link != "link0"
    }

    worst = 0.0
    for row in range(COUNT):
        other.update_cfg(dict(zip(names, vectors[row], strict=True)))
        for link, matrices in ours.items():
            theirs = other.get_transform(link, "link0")
            worst = max(worst, float(np.abs(theirs - matrices[row]).max()))
    assert worst <= 1e-12
