"""Tests of calibration with simulated motions whose mount and clock offset are known."""

from dataclasses import replace

import numpy as np
import pytest

import tftool
from tests.frames.motions import errors, product, quaternions, turned, world


def solved(made, **options):
    return tftool.calibrate(made.a, made.b, **options)


@pytest.mark.parametrize("offset", [0.0, -0.05, 12.5, 1.5e8])
def test_a_clock_offset_of_any_size_is_found(offset):
    made = world(3, offset=offset)

    found = tftool.clock_offset(made.a, made.b)

    assert found.seconds == pytest.approx(offset, abs=0.002)
    assert abs(found.seconds - offset) <= max(found.interval95, 0.001)
    assert found.correlation > 0.96


def test_motions_of_two_bodies_are_refused():
    one, other = world(1), world(2)

    with pytest.raises(tftool.CalibrationRefused, match="do not agree at any clock offset"):
        tftool.clock_offset(one.a, other.b)


def test_a_motion_that_repeats_itself_is_refused():
    made = world(1, seconds=20.0)
    times = np.arange(0.0, 30.0, 0.02)
    yaw = np.sin(2.0 * np.pi * times / 3.0)
    turns = np.stack([0 * yaw, 0 * yaw, np.sin(yaw / 2), np.cos(yaw / 2)], axis=1)
    path = type(made.a)(
        "odom", "base", (times * 1e9).astype(np.int64), np.zeros((len(times), 3)), turns,
        np.ones(len(times), dtype=bool),
    )  # fmt: skip

    with pytest.raises(tftool.CalibrationRefused, match="repeats itself"):
        tftool.clock_offset(path, path)


def test_mount_join_and_offset_are_within_the_required_figures():
    noise = (0.003, 0.3)
    shifts, turns, offsets, joins = [], [], [], []
    for seed in range(6):
        made = world(seed, noise=noise, seconds=60.0)
        found = solved(made)
        assert found.verdict == "solved"
        shift, turn = errors(found.mount, made.mount)
        shifts.append(np.linalg.norm(shift))
        turns.append(np.linalg.norm(turn))
        offsets.append(abs(found.clock_offset - made.offset))
        joins.append(np.linalg.norm(errors(found.fixed_mount, made.fixed_mount)[0]))

    assert np.median(shifts) <= 0.2 * noise[0]
    assert np.median(turns) <= 0.15 * noise[1]
    assert np.median(offsets) <= 0.0005
    assert np.median(joins) <= 0.5 * noise[0]


def test_intervals_hold():
    inside = []
    for seed in range(12):
        made = world(seed, seconds=30.0, rates=(50.0, 20.0), noise=(0.01, 0.5))
        found = solved(made)
        shift, turn = errors(found.mount, made.mount)
        inside += list(np.abs(shift) <= found.interval95.translation)
        inside += list(np.abs(turn) <= found.interval95.rotation_deg)

    # The intervals should contain 95 %; fewer than 60 of 72 would be a fault, not bad luck.
    assert sum(inside) >= 60


def test_outliers_lose_their_weight():
    made = world(4, outliers=0.2, seconds=60.0)
    found = solved(made)
    shift, turn = errors(found.mount, made.mount)

    assert np.linalg.norm(shift) < 0.003
    assert np.linalg.norm(turn) < 0.3


def test_a_motion_about_one_axis_leaves_the_height_unseen():
    made = world(5, kind="axis")
    found = solved(made)
    shift, turn = errors(found.mount, made.mount)

    assert found.verdict == "partial"
    assert found.unseen == ("z",)
    assert found.interval95.translation[2] is None
    assert found.mount.translation.z == pytest.approx(0.0, abs=0.002)
    assert np.linalg.norm(shift[:2]) < 0.003
    assert np.linalg.norm(turn) < 0.2
    assert "second axis" in found.next_motion


def test_the_join_hides_the_direction_that_the_mount_hides():
    made = world(5, kind="axis")
    found = solved(made)
    shift, _ = errors(found.fixed_mount, made.fixed_mount)

    assert found.fixed_interval95.translation[2] is None
    assert None not in found.fixed_interval95.rotation_deg
    assert np.linalg.norm(shift[:2]) < 0.01


def test_planar_is_refused_where_the_body_tilts():
    found = solved(world(5, seconds=20.0), planar=True)

    assert not found
    assert "leave out --planar" in found.why


def test_unseen_parts_are_kept_from_the_published_mount():
    made = world(5, kind="axis")
    found = solved(made, published=made.mount)

    assert found.mount.translation.z == pytest.approx(made.mount.translation.z, abs=1e-6)


def test_planar_motions_leave_the_tilt_unseen_too():
    made = world(6, kind="planar")
    found = solved(made)
    shift, turn = errors(found.mount, made.mount)

    assert found.verdict == "partial"
    assert set(found.unseen) == {"z", "roll", "pitch"}
    fixed = found.fixed_interval95
    assert [one is None for one in fixed.translation] == [False, False, True]
    assert [one is None for one in fixed.rotation_deg] == [True, True, False]
    assert np.linalg.norm(shift[:2]) < 0.003
    assert abs(turn[2]) < 0.2


def test_a_body_that_does_not_turn_is_refused_with_the_motion_to_record():
    found = solved(world(7, kind="still"))

    assert not found
    assert found.verdict == "refused"
    assert found.mount is None
    assert "turn" in found.next_motion


def test_a_short_recording_is_refused():
    made = world(7, seconds=4.0)

    assert "at least 5 s" in solved(made).why
    assert "too few poses: 3 with different stamps" in tftool.calibrate(made.a[:3], made.b).why


def test_an_inverted_second_motion_is_found_out_and_said():
    made = world(8, upside=True)
    found = solved(made)
    shift, _ = errors(found.mount, made.mount)

    assert found.inverted == (False, True)
    assert found.moving == ("base_link", "camera")
    assert "inverted" in found.notes[0]
    assert np.linalg.norm(shift) < 0.003


def test_a_scale_is_estimated_where_it_is_asked_for():
    made = world(9, scale=1.05, seconds=60.0)
    found = solved(made, scale=True)
    trusting = solved(made)

    assert found.scale[0] == pytest.approx(1.0 / 1.05, abs=0.003)
    assert np.linalg.norm(errors(found.mount, made.mount)[0]) < 0.004
    assert trusting.scale is None


def test_the_drift_of_a_clock_is_estimated_over_a_long_recording():
    made = world(10, ppm=50.0, seconds=200.0, rates=(50.0, 20.0))
    found = solved(made)

    assert found.drift_ppm == pytest.approx(50.0, abs=10.0)
    assert solved(world(10)).drift_ppm is None


def wandering(poses, degrees, metres):
    """Return poses whose fixed frame turns and moves slowly, as the frame of an odometry does."""
    share = np.linspace(-1.0, 1.0, len(poses))[:, None]
    bend = np.sin(2.0 * share)
    turns = quaternions(np.radians(degrees) * bend * [0.2, 0.1, 1.0])
    places = turned(turns, poses.translations) + metres * bend * [1.0, -0.5, 0.2]
    return replace(poses, translations=places, rotations=product(turns, poses.rotations))


@pytest.mark.parametrize("seed", range(3))
def test_a_chain_that_drifts_slowly_is_fitted_in_short_pieces(seed):
    made = world(seed, seconds=60.0, noise=(0.001, 0.1))
    found = tftool.calibrate(wandering(made.a, 3.0, 0.1), made.b)
    shift, turn = errors(found.mount, made.mount)
    assert np.abs(shift).max() < 0.006
    assert np.abs(turn).max() < 0.3
    assert np.mean(np.abs(shift) <= found.interval95.translation) >= 2 / 3
