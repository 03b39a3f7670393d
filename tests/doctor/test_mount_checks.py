"""Mounts against the motions that they join."""

import json
import re

import numpy as np
import pytest

import tftool as library
from tests.frames.motions import path, product, quaternions, world
from tftool import Quaternion, TransformArray
from tftool.geometry.conversions import rpy_from_quaternion

MOUNT_CHECKS = "mount-contradicts-motion,mount-changed"


@pytest.fixture(scope="module")
def made():
    return world(5, seconds=60.0, rates=(50.0, 20.0), offset=0.0)


@pytest.fixture(scope="module")
def run(made, tmp_path_factory):
    file = tmp_path_factory.mktemp("mounts") / "run.mcap"
    return recorded(file, named(made.a, "odom", "base_link"), named(made.b, "world", "camera"))


def described(file, mount, yaw_off=0.0):
    """A description in which the camera's mount is turned by so many degrees."""
    turn = mount.rotation @ Quaternion.from_rpy(0.0, 0.0, np.radians(yaw_off))
    xyz = " ".join(f"{one:.9f}" for one in mount.translation)
    rpy = " ".join(f"{one:.9f}" for one in rpy_from_quaternion(turn))
    file.write_text(
        '<robot name="rover"><link name="base_link"/><link name="camera"/>'
        '<joint name="mount" type="fixed"><parent link="base_link"/><child link="camera"/>'
        f'<origin xyz="{xyz}" rpy="{rpy}"/></joint></robot>',
        encoding="utf-8",
    )
    return file


def recorded(file, *paths):
    with library.write_recording(file) as recording:
        for one in paths:
            for row in one:
                recording.transforms([row])
    return file


def named(path, frame, child):
    return TransformArray(frame, child, path.stamps, path.translations, path.rotations, path.valid)


def findings(tftool, run, urdf, *more):
    result = tftool("doctor", run, "--urdf", urdf, "--select", MOUNT_CHECKS, "--json", *more)
    return {one["id"]: one for one in json.loads(result.out)["findings"]}


@pytest.mark.parametrize("yaw_off", [0.0, 1.0, 5.0])
def test_a_turned_mount_is_found_and_a_right_one_is_not(tftool, made, run, tmp_path, yaw_off):
    urdf = described(tmp_path / "robot.urdf", made.mount, yaw_off)

    found = findings(tftool, run, urdf, "--mounts")
    assert list(found) == (["mount-contradicts-motion"] if yaw_off else [])
    if yaw_off:
        (told, *_) = re.findall(r"yaw differs by (-?[\d.]+)", json.dumps(found))
        assert float(told) == pytest.approx(-yaw_off, abs=0.2)
    assert findings(tftool, run, urdf) == {}


def test_a_mount_that_moves_half_way_is_found_with_its_time(tftool, made, tmp_path):
    half = made.b.stamps > made.b.stamps[0] + 30 * 10**9
    slip = np.tile(quaternions(np.radians([[0.0, 0.0, 4.0]])), (int(half.sum()), 1))
    later = product(made.b.rotations[half], slip)
    rotations = np.concatenate([made.b.rotations[~half], later])
    moved = path(made.b.stamps, "world", "camera", made.b.translations, rotations)
    run = recorded(tmp_path / "run.mcap", named(made.a, "odom", "base_link"), moved)

    found = findings(tftool, run, described(tmp_path / "robot.urdf", made.mount), "--mounts")
    assert "mount-changed" in found
    assert "yaw differs by" in json.dumps(found["mount-changed"])
