"""Tests of pose files as FROM: each format's rows become frames, or cause an error."""

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tftool.base.errors import InputError, UsageError
from tftool.opener import open_frames
from tftool.recordings.poses.pose_formats import FORMATS

TUM = "1.000000001 1 2 3 0 0 0 1\n2.5 2 2 3 0 0 0.6 0.8\n"


@pytest.fixture
def in_folder(tmp_path, monkeypatch):
    """Change to the folder of the test."""
    monkeypatch.chdir(tmp_path)


TURN = Rotation.from_quat([0.0, 0.0, 0.6, 0.8])


def rows(path, text, **options):
    """Return the rows of the only moving edge of a file: stamps, translations, quaternions."""
    path.write_text(text)
    with open_frames(path, **options) as frames:
        (edge,) = frames.recording.edges
        return edge, edge.stamps.tolist(), edge.translations, edge.rotations


@pytest.mark.parametrize(
    "text",
    [
        TUM,
        "# a comment\n" + TUM.replace(" ", ", "),
        "\ufeff" + TUM.replace("\n", "\r\n"),
        "#timestamp [ns],p_RS_R_x [m],p_y,p_z,q_RS_w [],q_x,q_y,q_z\n"
        "1000000001,1,2,3,1,0,0,0\n2500000000,2,2,3,0.8,0,0,0.6,9,9,9\n",
        "#timestamp, p_RS_R_x [m], p_y, p_z, q_RS_w [], q_x, q_y, q_z\n"
        "1000000001,1,2,3,1,0,0,0\n2500000000,2,2,3,0.8,0,0,0.6\n",
        "stamp_ns,x_m,y_m,z_m,qx,qy,qz,qw\n"
        "1000000001,1,2,3,0,0,0,1\n2500000000,2,2,3,0,0,0.6,0.8\n",
    ],
    ids=["tum", "tum-csv", "windows", "euroc", "euroc-simulated", "csv"],
)
def test_a_trajectory_is_known_by_its_content_and_read_to_the_nanosecond(tmp_path, text):
    edge, stamps, translations, rotations = rows(tmp_path / "misleading.pdf", text)

    assert (edge.parent, edge.child, edge.static) == ("world", "body", False)
    assert stamps == [1_000_000_001, 2_500_000_000]
    assert translations.tolist() == [[1, 2, 3], [2, 2, 3]]
    assert rotations.tolist() == [[0, 0, 0, 1], [0, 0, 0.6, 0.8]]


@pytest.mark.parametrize("beside", ["poses_times.txt", "times.txt"])
def test_kitti_has_its_stamps_in_a_file_beside_it(tmp_path, beside):
    matrix = np.hstack([TURN.as_matrix(), [[1], [2], [3]]]).ravel()
    (tmp_path / beside).write_text("1.5e+00\n2.0\n")
    text = "1 0 0 0 0 1 0 0 0 0 1 0\n" + " ".join(map(repr, matrix.tolist()))

    _, stamps, translations, rotations = rows(tmp_path / "poses.txt", text)

    assert stamps == [1_500_000_000, 2_000_000_000]
    assert translations.tolist() == [[0, 0, 0], [1, 2, 3]]
    assert rotations[1] == pytest.approx([0, 0, 0.6, 0.8], abs=1e-15)


def test_kitti_without_stamps_takes_a_rate(tmp_path):
    text = "1 0 0 0 0 1 0 0 0 0 1 0\n" * 3
    with pytest.raises(InputError, match="--pose-rate HZ"):
        rows(tmp_path / "a.kitti", text)

    _, stamps, *_ = rows(tmp_path / "a.kitti", text, pose_rate=10)

    assert stamps == [100_000_000, 200_000_000, 300_000_000]


def test_colmap_holds_world_to_camera(tmp_path):
    text = "# IMAGE_ID, QW, QX\n2 0.8 0 0 0.6 1 2 3 1 b.png\n\n1 1 0 0 0 4 5 6 1 a b.png\n1 2 3\n"
    (tmp_path / "images.txt").write_text(text)
    with open_frames(tmp_path / "images.txt") as frames:
        pose = frames.buffer.lookup_transform("world", "b.png", 0)
        other = frames.buffer.lookup_transform("world", "a b.png", 0)

    assert other.transform.translation == pytest.approx((-4, -5, -6))
    assert pose.transform.translation == pytest.approx(-TURN.inv().apply([1, 2, 3]))
    assert pose.transform.rotation == pytest.approx((0, 0, -0.6, 0.8))

    edge, stamps, translations, _ = rows(tmp_path / "images.txt", text, pose_rate=1, inverted=True)
    assert (edge.child, stamps) == ("camera", [1_000_000_000, 2_000_000_000])
    assert translations.tolist() == [[4, 5, 6], [1, 2, 3]]


def test_nerfstudio_looks_along_minus_z_and_the_frame_along_z(tmp_path):
    matrix = np.eye(4)
    matrix[:3, 3] = 1, 2, 3
    frames = [{"file_path": "a.png", "transform_matrix": matrix.tolist()}]
    text = json.dumps({"camera_model": "OPENCV", "frames": frames})

    _, _, translations, rotations = rows(tmp_path / "t.json", text)
    assert translations.tolist() == [[1, 2, 3]]
    assert Rotation.from_quat(rotations[0]).apply([0, 0, 1]) == pytest.approx([0, 0, -1])

    _, _, _, rotations = rows(tmp_path / "t.json", text, axes="opencv")
    assert Rotation.from_quat(rotations[0]).apply([0, 0, 1]) == pytest.approx([0, 0, 1])


@pytest.mark.parametrize("key", ["T_cam_imu", "T_cn_cnm1"])
def test_kalibr_maps_into_the_camera(tmp_path, key):
    matrix = [[1, 0, 0, 0.5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    camera = "cam0" if key == "T_cam_imu" else "cam1"

    edge, _, translations, _ = rows(tmp_path / "c.yaml", f"{camera}:\n  {key}: {matrix}\n")

    assert (edge.parent, edge.child, edge.static) == (
        "imu" if key == "T_cam_imu" else "cam0",
        camera,
        True,
    )
    assert translations.tolist() == [[-0.5, 0, 0]]


def test_static_poses_have_no_time(tftool, tmp_path):
    matrix = [[1, 0, 0, 0.5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    path = tmp_path / "c.yaml"
    path.write_text(f"cam0:\n  T_cam_imu: {matrix}\n")

    told = tftool("echo", "imu", "cam0", path)

    assert told.out.startswith("At time 0.0\n- Translation: [-0.500, ")


def test_euroc_sensor_maps_into_the_body(tmp_path):
    data = [1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    text = f"#Default\nsensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: {data}\n"

    edge, _, translations, _ = rows(tmp_path / "s.yaml", text, frames="base:cam0")

    assert (edge.parent, edge.child) == ("base", "cam0")
    assert translations.tolist() == [[0.5, 0, 0]]


def test_kitti_calibration_has_cameras_and_the_velodyne(tmp_path):
    (tmp_path / "calib.txt").write_text(
        "P0: 700 0 600 0 0 700 180 0 0 0 1 0\n"
        "P1: 700 0 600 -378 0 700 180 0 0 0 1 0\n"
        "Tr: 0 -1 0 0.1 0 0 -1 0.2 1 0 0 0.3\n"
    )
    with open_frames(tmp_path / "calib.txt") as frames:
        right = frames.buffer.lookup_transform("cam0", "cam1", 0).transform
        laser = frames.buffer.lookup_transform("cam0", "velodyne", 0).transform

    assert right.translation == pytest.approx((0.54, 0, 0))
    assert laser.translation == pytest.approx((0.1, 0.2, 0.3))
    # The laser's forward axis is the camera's z axis.
    assert Rotation.from_quat(laser.rotation).apply([1, 0, 0]) == pytest.approx([0, 0, 1])


def test_the_table_of_the_docs_is_that_of_the_formats():
    page = (Path(__file__).parents[2] / "docs" / "do" / "poses.md").read_text()
    rows = [line.split(" | ") for line in page.splitlines() if line.startswith("| `")]
    told = [(row[0].strip("| `"), row[2].replace("`", ""), row[3].strip(" |")) for row in rows]

    assert told == [(one.name, f"{one.parent}, {one.child}", one.convention) for one in FORMATS]


def test_odd_rows_are_counted(tmp_path):
    text = "2 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n3 nan 0 0 0 0 0 1\n4 0 0 0 0 0 0 0\n"
    (tmp_path / "a").write_text(text)
    with open_frames(tmp_path / "a") as frames:
        notes = " ".join(frames.notes)
        (edge,) = frames.recording.edges

    assert edge.stamps.tolist() == [1_000_000_000, 1_000_000_000, 2_000_000_000]
    for told in ("1 row with NaN", "1 row with a zero quaternion", "1 row out of order"):
        assert told in notes
    assert "1 row with the stamp of another row" in notes


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("1 0 0 0 0 0 0 1\n2 3\n", r"a:2': expected 8 numbers .* found 2 words"),
        ("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 zero 1\n", r"a:2': expected .* found 'zero'"),
        ("1 0 0 0 0 0 0 1\n-2 0 0 0 0 0 0 1\n", r"a:2': .* the stamp '-2'"),
        ("1403636579763555584,1,2,3,0,0,0,1\n", "fits csv .* and euroc .*--pose-format"),
        ("2 0 0 0 0 1 0 0 0 0 1 0\n", "no stamps"),
        ('{"frames": [{"file_path": "a"}]}', "found no 'transform_matrix'"),
        ("cam0:\n  T_cam_imu: [1, 2]\n", "found no matrix"),
        ("T_BS:\n  data: [1]\n", "found 1 numbers"),
        ("P0: 1 2\n", r"a:1': expected 12 numbers after 'P0:', found 2"),
        ("nan nan nan 0 0 0 0 1\n", "the stamp 'nan'"),
    ],
)
def test_pose_files_that_cannot_be_read_are_refused_with_the_reason(tmp_path, text, told):
    (tmp_path / "a").write_text(text)

    with pytest.raises(InputError, match=told):
        open_frames(tmp_path / "a")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (TUM, "a' has its own stamps: leave out --pose-rate"),
        ("P0: 1 0 0 0 0 1 0 0 0 0 1 0\nTr: 1 0 0 0 0 1 0 0 0 0 1 0\n", "a' is static: leave out"),
    ],
)
def test_a_rate_is_refused_for_a_file_that_needs_none(tmp_path, text, told):
    (tmp_path / "a").write_text(text)

    with pytest.raises(UsageError, match=told):
        open_frames(tmp_path / "a", pose_rate=10)


def test_a_named_format_decides_between_two(tmp_path):
    text = "1403636579763555584,1,2,3,0,0,0,1\n"

    *_, last = rows(tmp_path / "a", text, pose_format="csv")
    *_, first = rows(tmp_path / "a", text, pose_format="euroc")

    assert last.tolist() == [[0, 0, 0, 1]]
    assert first.tolist() == [[0, 0, 1, 0]]
    with pytest.raises(UsageError, match="euroc-sensor"):
        rows(tmp_path / "a", text, pose_format="nothing")


def test_options_follow_their_files(tftool, in_folder, tmp_path):
    (tmp_path / "a.txt").write_text(TUM)
    (tmp_path / "b.txt").write_text(TUM)

    done = tftool(
        *("edit", "a.txt", "--frames", "odom:base", "gt=b.txt", "--inverted", "-o", "run.mcap")
    )
    assert done.status == 0, done.err
    with open_frames(tmp_path / "run.mcap") as frames:
        edges = {(one.parent, one.child): one for one in frames.recording.edges}

    assert edges["odom", "base"].translations.tolist() == [[1, 2, 3], [2, 2, 3]]
    assert edges["gt/world", "gt/body"].translations[0].tolist() == [-1, -2, -3]


def test_options_of_pose_files_are_refused_elsewhere(tftool):
    result = tftool("tree", "turtles", "--frames", "a:b")

    assert result.status == 2
    assert "leave out --frames" in result.err


@pytest.mark.parametrize("form", ["tum", "kitti", "euroc", "csv", "npz", "parquet"])
def test_exported_poses_are_read_back_within_rounding(tftool, in_folder, tmp_path, form):
    if form == "parquet":
        pytest.importorskip("pyarrow")
    noise = np.random.default_rng(5)
    poses = np.hstack([noise.normal(size=(20, 3)), Rotation.random(20, random_state=5).as_quat()])
    stamps = 1_700_000_000_000_000_001 + np.arange(20) * 100_000_003
    lines = [
        f"{stamp // 10**9}.{stamp % 10**9:09} " + " ".join(map(repr, pose))
        for stamp, pose in zip(stamps.tolist(), poses.tolist(), strict=True)
    ]
    (tmp_path / "in.tum").write_text("\n".join(lines))

    written = tftool("export", "world", "body", "in.tum", "-f", form, "-o", "out.x")
    assert written.status == 0, written.err
    with open_frames(tmp_path / "out.x") as frames:
        (edge,) = frames.recording.edges

    assert edge.stamps.tolist() == stamps.tolist()
    assert edge.translations == pytest.approx(poses[:, :3], abs=5.1e-10)
    sign = np.sign((edge.rotations * poses[:, 3:]).sum(axis=1))[:, None]
    assert edge.rotations * sign == pytest.approx(poses[:, 3:], abs=2e-9)


def test_a_file_of_zero_quaternions_holds_no_poses(tmp_path):
    file = tmp_path / "zero.tum"
    file.write_text("1.0 0 0 0 0 0 0 0\n2.0 0 0 0 0 0 0 0\n", encoding="utf-8")

    with pytest.raises(InputError, match=r"has no poses\. .*2 rows"):
        open_frames(str(file))
