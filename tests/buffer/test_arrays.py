"""Tests of operations on arrays of transforms."""

import builtins

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.strategies import transforms
from tftool.base.errors import UsageError
from tftool.base.stamps import seconds
from tftool.buffer.batch.transform_array import TransformArray
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry import rigid
from tftool.geometry.rigid import Transform

several = st.lists(transforms, min_size=1, max_size=6)


def many(poses, target="a", source="b"):
    return TransformArray(
        target,
        source,
        np.arange(1, len(poses) + 1) * seconds(1),
        np.array([pose.translation for pose in poses]).reshape(-1, 3),
        np.array([rigid.canonical(pose).rotation for pose in poses]).reshape(-1, 4),
        np.ones(len(poses), dtype=bool),
    )


def with_a_gap(poses):
    path = many(poses)
    path.valid[1] = False
    path.translations[1] = np.nan
    path.rotations[1] = np.nan
    return path


def assert_poses(path, poses):
    for row, pose in zip(path, poses, strict=True):
        np.testing.assert_allclose(row.transform.translation, pose.translation, atol=1e-10)
        dot = np.dot(row.transform.rotation, rigid.canonical(pose).rotation)
        assert abs(dot) == pytest.approx(1.0)


@given(several)
def test_the_inverse_is_each_one_s(poses):
    path = many(poses).inverse()

    assert (path.frame_id, path.child_frame_id) == ("b", "a")
    assert_poses(path, [pose.inverse() for pose in poses])


@given(several, transforms)
def test_chaining_with_one_is_chaining_each(poses, other):
    assert_poses(many(poses) @ other, [pose @ other for pose in poses])


@given(several)
def test_chaining_two_is_chaining_row_by_row(poses):
    chained = many(poses) @ many(poses[::-1], "b", "c")

    assert (chained.frame_id, chained.child_frame_id) == ("a", "c")
    assert_poses(chained, [a @ b for a, b in zip(poses, poses[::-1], strict=True)])


def test_quaternions_come_out_with_length_one_and_the_sign_of_a_lookup():
    # For a turn of 200° about z, tf2 returns a positive z and a negative w.
    turned = Transform((0.0, 0.0, 0.0), (0.0, 0.0, 0.984807753012208, -0.17364817766693041))

    back = many([turned]).inverse().rotations[0]
    longer = (many([Transform()]) @ Transform(turned.translation, (0.0, 0.0, 2.0, 0.0))).rotations

    np.testing.assert_allclose(back, [0.0, 0.0, 0.984807753012208, 0.17364817766693041])
    np.testing.assert_allclose(longer, [[0.0, 0.0, 1.0, 0.0]])


@given(several)
def test_matrices_are_each_one_s(poses):
    matrices = many(poses).matrices()

    assert matrices.shape == (len(poses), 4, 4)
    for matrix, pose in zip(matrices, poses, strict=True):
        np.testing.assert_allclose(matrix, pose.matrix(), atol=1e-12)


@given(several)
def test_points_move_one_for_all_one_each_or_several_each(poses):
    path, n = many(poses), len(poses)
    points = np.arange(6.0 * n).reshape(n, 2, 3)

    single, each, clouds = path.apply(points[0, 0]), path.apply(points[:, 0]), path.apply(points)

    for row, pose in enumerate(poses):
        np.testing.assert_allclose(single[row], pose.apply(points[0, 0]), atol=1e-10)
        np.testing.assert_allclose(each[row], pose.apply(points[row, 0]), atol=1e-10)
        np.testing.assert_allclose(clouds[row, 1], pose.apply(points[row, 1]), atol=1e-10)


@pytest.mark.parametrize("shape", [(2,), (4, 3), (3, 4), (3, 2, 2), (4, 2, 3), (3, 1, 1, 3), ()])
def test_points_that_do_not_fit_are_refused(shape):
    with pytest.raises(ValueError, match=r"\(3,\), \(3, 3\) or \(3, k, 3\), not"):
        many([Transform()] * 3).apply(np.zeros(shape))


def test_frames_that_do_not_meet_are_not_chained():
    with pytest.raises(ValueError, match="'a' from 'b' cannot be chained with 'a' from 'b'"):
        many([Transform()]) @ many([Transform()])


def test_unequal_numbers_of_rows_are_not_chained():
    with pytest.raises(ValueError, match="1 transforms cannot be chained with 2"):
        many([Transform()]) @ many([Transform()] * 2, "b", "c")


def test_nothing_else_is_chained():
    with pytest.raises(TypeError):
        many([Transform()]) @ 3


def test_a_row_that_is_not_valid_stays_so():
    path = with_a_gap([Transform()] * 3)

    assert (path @ Transform()).valid.tolist() == [True, False, True]
    assert np.isnan((path @ many([Transform()] * 3, "b", "c")).translations[1]).all()
    assert np.isnan(path.matrices()[1]).any()
    assert not path.inverse().valid[1]


def test_rows_are_picked_as_from_an_array():
    path = many([Transform((float(k), 0.0, 0.0)) for k in range(5)])

    assert path[1] == TransformStamped(seconds(2), "a", "b", Transform((1.0, 0.0, 0.0)))
    assert path[-1].transform.translation.x == 4.0
    assert [row.stamp for row in path[1:4:2]] == [seconds(2), seconds(4)]
    assert path[path.stamps > seconds(3)].translations[:, 0].tolist() == [3.0, 4.0]
    assert path[[4, 0]].translations[:, 0].tolist() == [4.0, 0.0]
    assert len(path[:0]) == 0


def test_it_says_what_it_holds():
    assert repr(with_a_gap([Transform()] * 3)) == (
        "<TransformArray: 3 poses of 'b' in 'a', 2 of them valid>"
    )


def test_velocities_are_those_of_a_steady_motion():
    buffer = Buffer(seconds(100))
    for second in range(1, 6):
        half = 0.25 * second
        pose = Transform((3.0 * second, 1.0, 0.0), (np.sin(half), 0.0, 0.0, np.cos(half)))
        buffer.set_transform(TransformStamped(seconds(second), "a", "b", pose))

    found = buffer.lookup_transforms("a", "b", np.arange(2, 10) * seconds(0.5)).velocities()

    np.testing.assert_allclose(found.linear, [[3.0, 0.0, 0.0]] * 8, atol=1e-12)
    np.testing.assert_allclose(found.angular, [[0.5, 0.0, 0.0]] * 8, atol=1e-12)


def test_turning_is_told_in_the_axes_of_the_target():
    # The child is turned so that its x axis is the target's z axis.
    side = Transform(rotation=(0.0, -np.sqrt(0.5), 0.0, np.sqrt(0.5)))
    poses = [side @ Transform(rotation=(np.sin(k / 2), 0.0, 0.0, np.cos(k / 2))) for k in range(3)]

    np.testing.assert_allclose(many(poses).velocities().angular, [[0.0, 0.0, 1.0]] * 3, atol=1e-12)


@pytest.mark.parametrize("count", [0, 1])
def test_too_few_rows_have_no_velocity(count):
    found = many([Transform()] * count).velocities()

    assert found.linear.shape == (count, 3)
    assert np.isnan(found.angular).all()


def test_beside_a_gap_there_is_no_velocity():
    found = with_a_gap([Transform()] * 4).velocities()

    assert np.isnan(found.linear).any(axis=1).tolist() == [True, False, True, False]


def test_scipy_is_given_the_same():
    pytest.importorskip("scipy", "1.16", reason="RigidTransform came with scipy 1.16")
    poses = [Transform((1.0, 2.0, 3.0), (0.0, 0.6, 0.0, 0.8)), Transform()]
    path = many(poses)

    rigid_transform, rotation = path.to_scipy()

    np.testing.assert_allclose(rigid_transform.as_matrix(), path.matrices(), atol=1e-15)
    np.testing.assert_allclose(rotation.as_quat(), path.rotations, atol=1e-15)


def test_scipy_is_not_given_rows_without_a_pose():
    pytest.importorskip("scipy", "1.16", reason="RigidTransform came with scipy 1.16")

    with pytest.raises(ValueError, match="1 of 3 rows have no pose"):
        with_a_gap([Transform()] * 3).to_scipy()


def test_without_scipy_the_remedy_is_told(monkeypatch):
    real = builtins.__import__

    def refuse(name, *rest):
        if name.startswith("scipy"):
            raise ImportError(name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", refuse)

    with pytest.raises(UsageError, match=r"pip install 'scipy>=1.16'"):
        many([Transform()]).to_scipy()


def test_a_rotation_of_all_zeros_makes_no_valid_row():
    nothing = rigid.transform((1.0, 2.0, 3.0), (0.0, 0.0, 0.0, 0.0))
    path, other = many([Transform()] * 3), many([Transform()] * 3, "b", "c")
    other.rotations[1] = 0.0

    for chained, valid in ((path @ nothing, [False] * 3), (path @ other, [True, False, True])):
        assert chained.valid.tolist() == valid
        assert np.isnan(chained.translations[~chained.valid]).all()
        assert np.isnan(chained.rotations[~chained.valid]).all()
