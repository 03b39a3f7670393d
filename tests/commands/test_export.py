"""Tests of `tftool export`; numpy, pyarrow, evo and our own readers read the files back."""

import csv
import errno
import json
import os
import signal
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.spatial.transform import Rotation

import tftool as library
from tests.full_disk import full_disk
from tftool import Buffer, Transform, TransformStamped, seconds
from tftool.base.errors import InputError
from tftool.frames.export import trajectory_files
from tftool.frames.export.trajectory_files import BLOCK
from tftool.geometry.conversions import quaternion_from_rpy

SECOND = seconds(1)
START = 1_700_000_000 * SECOND
EVO = os.environ.get("TFTOOL_EVO_PYTHON") or (sys.executable if find_spec("evo") else "")


@pytest.fixture
def buffer():
    """Return a buffer of a robot that drives and turns through ±π, with a camera that looks down.

    The data has a gap.
    """
    found = Buffer(seconds(1000))
    for n in range(200):
        stamp = START + n * 7_000_001
        place = (1e6 + 0.1 * n, -0.2 * n, 1e-7 * n)
        pose = Transform(place, quaternion_from_rpy(0.001 * n, 0.3, 0.05 * n))
        found.set_transform(TransformStamped(stamp, "odom", "base", pose))
    camera = Transform((0.1, -0.2, 0.3), quaternion_from_rpy(0.1, np.pi / 2, -0.4))
    found.set_transform_static(TransformStamped(0, "base", "camera", camera))
    found.set_transform_static(TransformStamped(0, "base", "gps 'roof'", Transform((0, 0, 2.0))))
    return found


@pytest.fixture
def wanted(buffer):
    return buffer.lookup_transforms("odom", "camera", [START + n * 7_000_001 for n in range(200)])


@pytest.fixture
def run(buffer, tmp_path):
    """Write the same data as a recording."""
    library.export(buffer, path=tmp_path / "run.mcap")
    return tmp_path / "run.mcap"


def same_turns(found, wanted, within):
    return (Rotation.from_quat(found) * Rotation.from_quat(wanted).inv()).magnitude().max() < within


def test_the_pose_of_a_joint_at_rest_is_not_called_static(tftool, tmp_path):
    (tmp_path / "arm.urdf").write_text(
        '<robot name="arm"><link name="base"/><link name="tool"/><joint name="j" type="continuous">'
        '<parent link="base"/><child link="tool"/></joint></robot>'
    )

    result = tftool("export", "base", "tool", tmp_path / "arm.urdf", "-o", tmp_path / "arm.tum")

    assert result.err.endswith("because nothing between the two frames moves in this source.\n")


@pytest.mark.parametrize("words", [["odom", "camera", "-f", "csv"], ["-f", "sh"]])
def test_a_dash_is_no_name_of_a_file(tftool, run, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)

    result = tftool("export", *words[:-2], run, *words[-2:], "-o", "-")

    assert result.status == 2
    assert "but this output can only be written to a file: name a file." in result.err
    assert os.listdir(tmp_path) == ["run.mcap"]


def test_a_recording_becomes_tum(tftool, run, wanted, tmp_path):
    result = tftool("export", "odom", "camera", run, "-o", tmp_path / "run.tum")

    lines = (tmp_path / "run.tum").read_text().splitlines()
    rows = np.array([line.split(" ") for line in lines], dtype=float)
    assert result.status == 0
    assert result.out == ""
    assert "Wrote 200 poses" in result.err
    assert [line.split(" ")[0] for line in lines] == [
        f"{stamp // SECOND}.{stamp % SECOND:09}" for stamp in wanted.stamps.tolist()
    ]
    assert np.abs(rows[:, 1:4] - wanted.translations).max() < 1e-9
    assert same_turns(rows[:, 4:], wanted.rotations, 1e-8)
    assert (np.einsum("ij,ij->i", rows[1:, 4:], rows[:-1, 4:]) > 0.9).all()


def test_json_counts_poses_and_refusals(tftool, run, tmp_path):
    result = tftool("export", "odom", "camera", run, "-o", tmp_path / "run.tum", "--json")

    told = json.loads(result.out)
    assert told["files"] == [str(tmp_path / "run.tum")]
    assert (told["format"], told["count"], told["pairs"][0]["refused"]) == ("tum", 200, 0)
    assert result.err == ""


def test_kitti_is_a_matrix_a_row_and_its_stamps_are_beside_it(tftool, run, wanted, tmp_path):
    tftool("export", "odom", "camera", run, "-o", tmp_path / "run.kitti")

    rows = np.loadtxt(tmp_path / "run.kitti").reshape(-1, 3, 4)
    times = (tmp_path / "run_times.txt").read_text().split()
    assert np.allclose(rows, wanted.matrices()[:, :3], rtol=0, atol=1e-9)
    assert times[1] == "1700000000.007000001"


@pytest.mark.parametrize("broken", ["run.kitti", "run_times.txt"])
@pytest.mark.parametrize("before", [False, True])
def test_the_two_files_of_kitti_come_together_or_not_at_all(
    buffer, tmp_path, monkeypatch, broken, before
):
    names = {"run.kitti": "old poses", "run_times.txt": "old times"} if before else {}
    for name, text in names.items():
        (tmp_path / name).write_text(text)
    rename = os.rename

    def full(old, new, *more, **others):
        if Path(new) == tmp_path / broken and Path(old).name.endswith(".part"):
            raise OSError(errno.EIO, "input/output error")
        rename(old, new, *more, **others)

    monkeypatch.setattr(os, "rename", full)
    with pytest.raises(InputError, match="cannot be written"):
        library.export(buffer, "odom", "camera", path=tmp_path / "run.kitti", force=before)

    assert {one.name: one.read_text() for one in tmp_path.iterdir()} == names


def test_the_two_files_of_kitti_replace_those_of_before(buffer, wanted, tmp_path):
    for name in ("run.kitti", "run_times.txt"):
        (tmp_path / name).write_text("old")

    library.export(buffer, "odom", "camera", path=tmp_path / "run.kitti", force=True)

    assert sorted(one.name for one in tmp_path.iterdir()) == ["run.kitti", "run_times.txt"]
    assert len((tmp_path / "run.kitti").read_text().splitlines()) == len(wanted)
    assert len((tmp_path / "run_times.txt").read_text().splitlines()) == len(wanted)


def test_euroc_has_w_first(tftool, run, wanted, tmp_path):
    words = ("odom", "camera", run, "-o", tmp_path / "run.csv", "--format", "euroc")
    assert tftool("export", *words).status == 0

    head, *lines = (tmp_path / "run.csv").read_text().splitlines()
    rows = np.array([line.split(",") for line in lines])
    assert head.startswith("#timestamp [ns],p_RS_R_x [m]")
    assert rows[:, 0].tolist() == list(map(str, wanted.stamps.tolist()))
    assert same_turns(rows[:, [5, 6, 7, 4]].astype(float), wanted.rotations, 1e-8)


def test_csv_of_several_pairs_names_each(tftool, run, wanted, tmp_path):
    pairs = ("--pair", "odom:camera", "--pair", "base:gps 'roof'")
    words = (run, *pairs, "-o", tmp_path / "run.csv", "--rpy", "--precision", "17")
    assert tftool("export", *words).status == 0

    with (tmp_path / "run.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert {(row["target"], row["source"]) for row in rows} == {
        ("odom", "camera"),
        ("base", "gps 'roof'"),
    }
    one = rows[3]
    turn = [float(one[name]) for name in ("qx", "qy", "qz", "qw")]
    angles = [float(one[name]) for name in ("roll_rad", "pitch_rad", "yaw_rad")]
    assert int(one["stamp_ns"]) == int(wanted.stamps[3])
    assert float(one["x_m"]) == wanted.translations[3, 0]
    assert same_turns([turn], wanted.rotations[3:4], 1e-15)
    assert (Rotation.from_quat(turn) * Rotation.from_euler("xyz", angles).inv()).magnitude() < 1e-14


def test_npz_needs_no_pickle(tftool, run, wanted, tmp_path):
    tftool("export", "odom", "camera", run, "-o", tmp_path / "run.npz")

    with np.load(tmp_path / "run.npz", allow_pickle=False) as found:
        assert np.array_equal(found["stamps"], wanted.stamps)
        assert np.array_equal(found["translations"], wanted.translations)
        assert same_turns(found["rotations"], wanted.rotations, 1e-15)
        assert (str(found["target"]), str(found["source"])) == ("odom", "camera")
        assert found["format_version"] == 1


def test_parquet_has_dates_for_stamps(tftool, run, wanted, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet", reason="the extra 'parquet' is not installed")
    pairs = ("--pair", "odom:camera", "--pair", "odom:base")
    tftool("export", run, *pairs, "-o", tmp_path / "run.parquet")

    table = parquet.read_table(tmp_path / "run.parquet")
    assert table.num_rows == 400
    assert table.schema.field("stamp").type.tz == "UTC"
    assert table["stamp"].cast("int64").to_pylist() == table["stamp_ns"].to_pylist()
    assert table["z_m"].to_numpy()[:200].tolist() == wanted.translations[:, 2].tolist()
    assert table["source"].to_pylist()[199:201] == ["camera", "base"]
    assert table.schema.metadata[b"target"] == b"odom,odom"


@pytest.mark.skipif(not EVO, reason="TFTOOL_EVO_PYTHON names no Python that has evo")
def test_evo_reads_the_same_poses(tftool, run, wanted, tmp_path):
    for name, more in (("a.tum", ()), ("a.kitti", ()), ("a.csv", ("--format", "euroc"))):
        tftool("export", "odom", "camera", run, "-o", tmp_path / name, *more)
    program = (
        "import sys, numpy as np\n"
        "from evo.tools import file_interface as read\n"
        "tum = read.read_tum_trajectory_file('a.tum')\n"
        "euroc = read.read_euroc_csv_trajectory('a.csv')\n"
        "kitti = read.read_kitti_poses_file('a.kitti')\n"
        "np.savez('read.npz', tum=tum.poses_se3, euroc=euroc.poses_se3, kitti=kitti.poses_se3,\n"
        "    times=tum.timestamps)\n"
    )

    subprocess.run(
        [EVO, "-W", "ignore", "-c", program], cwd=tmp_path, check=True, capture_output=True
    )

    found = np.load(tmp_path / "read.npz")
    for name in ("tum", "euroc", "kitti"):
        assert np.abs(found[name] - wanted.matrices()).max() < 1e-8
    assert np.abs(found["times"] - wanted.stamps / SECOND).max() < 1e-6


def test_moments_are_chosen(tftool, run, tmp_path):
    def stamps(*options):
        path = tmp_path / "chosen.csv"
        assert tftool("export", "odom", "base", run, "-o", path, "--force", *options).status == 0
        return [int(line.split(",")[0]) - START for line in path.read_text().splitlines()[1:]]

    assert stamps("--every", "0.5") == [0, SECOND // 2, SECOND]
    assert stamps("--rate", "4", "--from", "0.5", "--to", "1") == [
        SECOND // 2,
        3 * SECOND // 4,
        SECOND,
    ]
    assert stamps("--to", "0.0075") == [0, 7_000_001]
    assert stamps("--from", "1700000001.39") == [199 * 7_000_001]


def test_times_without_a_pose_are_left_out_of_the_export_and_counted(tftool, run, tmp_path):
    path = tmp_path / "late.csv"

    result = tftool("export", "odom", "base", run, "-o", path, "--every", "0.5", "--to", "2.5")

    assert len(path.read_text().splitlines()) == 1 + 3
    assert "3 of 6 times have no pose" in result.err
    assert "extrapolation into the future" in result.err


def test_a_scenario_is_played_to_its_end(tftool, simulated, tmp_path):
    scenario, path = tmp_path / "short.yaml", tmp_path / "a.tum"
    nodes = "nodes:\n  - turtlesim: {}\n  - broadcaster: {turtle: turtle1}\n"
    scenario.write_text(f"about: one turtle stands.\nduration: 2 s\n{nodes}")

    whole = tftool("export", "world", "turtle1", scenario, "-o", path)
    lines = path.read_text().splitlines()
    part = tftool("export", "world", "turtle1", scenario, "-o", path, "--for", "1", "--force")

    assert (whole.status, part.status) == (0, 0)
    assert 1.9 < float(lines[-1].split()[0]) - float(lines[0].split()[0]) <= 2.0
    assert 50 < len(path.read_text().splitlines()) < 70


@pytest.mark.parametrize("end", ["urdf", "launch.py", "launch.xml", "launch.yaml", "sh"])
def test_links_are_written_to_be_published_again(tftool, run, buffer, tmp_path, end):
    path = tmp_path / f"statics.{end}"

    result = tftool("export", run, "-o", path, "--root", "camera")
    assert result.status == 2
    assert "below 'camera'" in result.err

    result = tftool("export", run, "-o", path)
    if end in ("launch.xml", "launch.yaml"):
        # A quote would end the quoted word in this format.
        assert result.status == 3
        assert "write a .launch.py" in result.err
        assert not path.exists()
        return
    assert result.status == 0
    assert "Wrote 2 links" in result.err


def test_a_urdf_is_read_back_to_the_last_digits(tftool, run, buffer, tmp_path):
    tftool("export", run, "-o", tmp_path / "robot.urdf")

    robot = library.load_urdf(tmp_path / "robot.urdf")
    assert robot.root == "base"
    for one in robot.transforms():
        held = buffer.lookup_transform(one.frame_id, one.child_frame_id).transform
        assert one.transform.translation == held.translation
        assert same_turns([one.transform.rotation], [held.rotation], 1e-12)


def test_moving_links_are_floating_joints_where_asked(tftool, run, buffer, tmp_path):
    words = (run, "-o", tmp_path / "robot.urdf", "--with-moving", "--at", "0.007000001")
    assert tftool("export", *words).status == 0

    robot = library.load_urdf(tmp_path / "robot.urdf")
    joint = robot.joints["odom_to_base"]
    held = buffer.lookup_transform("odom", "base", START + 7_000_001).transform
    assert (robot.root, joint.type) == ("odom", "floating")
    assert joint.origin.translation == held.translation
    assert "no pose in their parents: base" in tftool("tree", tmp_path / "robot.urdf").err


def test_launch_files_are_played_by_launch(tftool, run, tmp_path):
    for end in ("py", "xml", "yaml"):
        buffer = Buffer()
        buffer.set_transform_static(TransformStamped(0, "a", "b", Transform((1.0, 0.0, 0.0))))
        buffer.set_transform_static(TransformStamped(0, "a", "c", Transform((2.0, 0.0, 0.0))))
        path = tmp_path / f"statics.launch.{end}"
        library.export(buffer, path=path)

        result = tftool("launch", "--simulated", "--for", "1", path)

        assert result.status == 0
        assert "static_transform_publisher-2" in result.out + result.err


@pytest.mark.parametrize("end", ["urdf", "launch.py", "launch.xml", "launch.yaml", "sh"])
def test_names_beyond_two_bytes_are_written_whole(tftool, tmp_path, end):
    names = "m🐢", "straße"
    buffer = Buffer()
    buffer.set_transform_static(TransformStamped(0, *names, Transform()))
    path = tmp_path / f"statics.{end}"
    library.export(buffer, path=path)

    with library.open(path) as frames:
        assert set(frames.buffer.frames()) == set(names)
    if end == "launch.yaml":
        (node,) = yaml.safe_load(path.read_text(encoding="utf-8"))["launch"]
        assert f"--frame-id {names[0]} --child-frame-id {names[1]}" in node["node"]["args"]


@pytest.mark.parametrize("option", [(), ("--foxglove",)])
def test_frames_go_into_mcap_and_come_back(tftool, run, buffer, tmp_path, option):
    reader = pytest.importorskip("mcap.reader", reason="reads what was written")
    path = tmp_path / "frames.mcap"
    assert tftool("export", run, "-o", path, *option).status == 0

    with library.open_recording(path) as found:
        for frame in ("base", "camera", "gps 'roof'"):
            held, wanted = found.buffer.samples(frame), buffer.samples(frame)
            assert held.is_static == wanted.is_static
            assert np.array_equal(held.stamps, wanted.stamps)
            assert np.array_equal(held.poses, wanted.poses)
            assert held.parents.tolist() == wanted.parents.tolist()
    with path.open("rb") as file:
        schemas = {
            (schema.name, schema.encoding, channel.topic)
            for schema, channel, _ in reader.make_reader(file, validate_crcs=True).iter_messages()
        }
    kind = (
        ("foxglove.FrameTransforms", "protobuf")
        if option
        else ("tf2_msgs/msg/TFMessage", "ros2msg")
    )
    assert schemas == {(*kind, "/tf"), (*kind, "/tf_static")}


def test_protobufs_own_reader_understands_foxgloves_frames(buffer, tmp_path):
    descriptors = pytest.importorskip("google.protobuf.descriptor_pb2", reason="no protobuf here")
    from google.protobuf import descriptor_pool, message_factory

    from tftool.frames.export.frame_messages import frame_transforms, frame_transforms_definition

    pool = descriptor_pool.DescriptorPool()
    for file in descriptors.FileDescriptorSet.FromString(frame_transforms_definition()).file:
        pool.Add(file)
    kind = pool.FindMessageTypeByName("foxglove.FrameTransforms")
    sample = buffer.lookup_transform("odom", "base", START)

    read = (
        message_factory.GetMessageClass(kind).FromString(frame_transforms([sample])).transforms[0]
    )

    assert (read.parent_frame_id, read.child_frame_id) == ("odom", "base")
    assert (read.timestamp.seconds, read.timestamp.nanos) == divmod(START, SECOND)
    assert (read.translation.x, read.rotation.w) == (
        sample.transform.translation.x,
        sample.transform.rotation.w,
    )


# Errors


def test_export_replaces_an_existing_file_only_with_force(tftool, run, tmp_path):
    path = tmp_path / "a.tum"
    path.write_text("precious")

    refused = tftool("export", "odom", "base", run, "-o", path)
    kept = path.read_text()
    forced = tftool("export", "odom", "base", run, "-o", path, "--force")

    assert (refused.status, kept, forced.status) == (2, "precious", 0)
    assert "add --force to replace it" in refused.err
    assert path.read_text().startswith("17")


def test_the_input_is_never_written_to(tftool, run, tmp_path):
    before = run.read_bytes()
    (tmp_path / "link.mcap").symlink_to(run)

    for name in ("run.mcap", "link.mcap"):
        result = tftool("export", run, "-o", tmp_path / name, "--force")
        assert result.status == 2
        assert "is the input" in result.err
    assert run.read_bytes() == before


def test_an_output_in_the_folder_that_is_read_can_be_replaced(tftool, run, tmp_path):
    (tmp_path / "o.tum").write_text("old")
    (tmp_path / "broken").symlink_to("nowhere")

    result = tftool("export", "odom", "base", tmp_path, "-o", tmp_path / "o.tum", "--force")

    assert result.status == 0
    assert "old" not in (tmp_path / "o.tum").read_text()
    assert tftool("export", tmp_path, "-o", run, "--force").status == 2


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["odom", "base", "RUN"], 2, "-o FILE"),
        (["odom", "base", "RUN", "-o", "a.doc"], 2, "has no known suffix"),
        (["odom", "base", "RUN", "-o", "a.urdf"], 2, "contains links"),
        (["RUN", "-o", "a.tum"], 2, "TARGET SOURCE"),
        (["odom", "base", "RUN", "more", "-o", "a.tum"], 2, "TARGET SOURCE [FROM], not 4 words"),
        (["RUN", "--pair", "odom", "-o", "a.csv"], 2, "TARGET:SOURCE"),
        (["RUN", "--pair", "odom:base", "--pair", "odom:camera", "-o", "a.tum"], 2, "one pair"),
        (
            ["odom", "base", "RUN", "-o", "a.tum", "--rate", "1", "--every", "1"],
            2,
            "leave out all but one",
        ),
        (["odom", "base", "RUN", "-o", "a.tum", "--rpy"], 2, "columns of CSV"),
        (["odom", "base", "RUN", "-o", "a.tum", "--at", "1"], 2, "--from and --to"),
        (["odom", "base", "RUN", "-o", "a.tum", "--from", "2", "--to", "1"], 2, "is after --to"),
        (["odom", "base", "RUN", "-o", "a.tum", "--from", "100"], 2, "100 s is after its end."),
        (["odom", "base", "RUN", "-o", "a.tum", "--to", "1e9"], 2, "is before this start."),
        (["odom", "base", "RUN", "-o", "a.tum", "--for", "1"], 2, "--for is only allowed for"),
        (["odom", "base", "RUN", "-o", "a.tum", "--at-stamps-of", "/scan"], 3, "/scan"),
        (["odom", "base", "turtles", "-o", "a.tum", "--at-stamps-of", "/scan"], 2, "recording"),
        (["odom", "nope", "RUN", "-o", "a.tum"], 4, "nope"),
        (["odom", "base", "nope.mcap", "-o", "a.tum"], 3, "nope.mcap"),
        (["odom", "base", "RUN", "-o", "no/where/a.tum"], 3, "no folder"),
        (["odom", "base", "RUN", "-o", "/dev/full", "-f", "tum", "--force"], 2, "device"),
        (["RUN", "-o", "a.sh", "--at", "1"], 2, "--with-moving"),
        (
            ["RUN", "-o", "a.sh", "--with-moving"],
            2,
            "contains static transforms only: leave out --with-moving",
        ),
        (["RUN", "-o", "a.urdf", "--foxglove"], 2, "MCAP"),
        (["RUN", "-o", "a.urdf", "--root", "nope"], 4, "nope"),
    ],
)
def test_export_refuses_invalid_arguments_and_writes_no_file(
    tftool, simulated, run, tmp_path, monkeypatch, words, status, told
):
    monkeypatch.chdir(tmp_path)
    before = sorted(tmp_path.iterdir())

    result = tftool("export", *[run if word == "RUN" else word for word in words])

    assert (result.status, told in result.err) == (status, True), result.err
    assert sorted(tmp_path.iterdir()) == before


@pytest.mark.skipif(sys.platform == "win32", reason="limits of a process are POSIX")
@pytest.mark.parametrize("name", ["a.tum", "a.kitti", "a.csv", "a.npz", "a.mcap", "a.urdf"])
def test_a_full_disk_leaves_nothing(tftool, run, tmp_path, name):
    pair = () if name.endswith(("mcap", "urdf")) else ("odom", "base")
    before = sorted(tmp_path.iterdir())
    with full_disk(100):
        result = tftool("export", *pair, run, "-o", tmp_path / name)

    assert result.status == 3
    assert "cannot be written" in result.err
    assert sorted(tmp_path.iterdir()) == before


def test_a_folder_without_permission_is_said(tftool, run, tmp_path):
    (tmp_path / "closed").mkdir(mode=0o500)
    if os.access(tmp_path / "closed", os.W_OK):
        pytest.skip("this user, probably root, may write to every folder")

    result = tftool("export", "odom", "base", run, "-o", tmp_path / "closed" / "a.tum")

    assert result.status == 3
    assert "cannot be written: permission denied" in result.err


@pytest.mark.skipif(os.name == "nt", reason="signals are a thing of Unix")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_leaves_nothing(tftool, run, tmp_path, monkeypatch, number):
    # The signal arrives while the second block of rows is written.
    before = sorted(tmp_path.iterdir())
    blocks = []
    write = trajectory_files.rows_as_text

    def interrupted(*arguments, **words):
        blocks.append(1)
        if len(blocks) == 2:
            os.kill(os.getpid(), number)
        return write(*arguments, **words)

    monkeypatch.setattr("tftool.frames.export.trajectory_files.rows_as_text", interrupted)
    result = tftool(
        "export", "odom", "base", run, "-o", tmp_path / "a.tum", "--every", str(1.39 / 2 / BLOCK)
    )

    assert result.status == 130
    assert len(blocks) == 2
    assert sorted(tmp_path.iterdir()) == before


def test_where_there_is_nothing_nothing_is_written(tmp_path):
    with pytest.raises(library.UsageError, match="no frame"):
        library.export(Buffer(), path=tmp_path / "a.mcap")
    moving = Buffer()
    moving.set_transform(TransformStamped(START, "odom", "base", Transform()))
    with pytest.raises(library.UsageError, match="--with-moving adds moving frames"):
        library.export(moving, path=tmp_path / "a.urdf")
    assert list(tmp_path.iterdir()) == []


def test_statics_below_a_moving_frame_are_named(tmp_path):
    robot = Buffer()
    robot.set_transform(TransformStamped(START, "base", "arm", Transform()))
    robot.set_transform_static(TransformStamped(0, "arm", "tool", Transform()))
    told = "Static transforms connect no frame below 'base' with it.*: they are below 'arm'"
    with pytest.raises(library.UsageError, match=told):
        library.export(robot, path=tmp_path / "a.urdf", root="base")

    assert library.export(robot, path=tmp_path / "a.urdf", root="arm").count == 1


def test_in_python_a_file_is_written_in_one_line(buffer, tmp_path):
    done = library.export(
        buffer, path=tmp_path / "a.csv", pairs=[("odom", "base"), ("odom", "camera")]
    )

    assert (done.count, done.refused, done.paths) == (400, 0, (tmp_path / "a.csv",))
    with pytest.raises(library.UsageError, match="'word' is not a format"):
        library.export(buffer, "odom", "base", path=tmp_path / "b.csv", format="word")
    with pytest.raises(library.UsageError, match="Only one frame"):
        library.export(buffer, "odom", path=tmp_path / "b.csv")


def test_a_call_in_the_old_order_names_the_new_one(buffer, tmp_path):
    for given, named in (
        ((buffer, tmp_path / "run.tum", "odom", "base"), {}),
        ((buffer, tmp_path / "run.mcap"), {}),
        ((buffer,), {"path": tmp_path / "run.tum", "target_frame": "odom", "source_frame": "base"}),
    ):
        with pytest.raises(
            TypeError, match=r"export\(recording, 'map', 'base_link', path='run.tum'\)"
        ):
            library.export(*given, **named)
    assert not list(tmp_path.iterdir())
