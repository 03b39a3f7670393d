"""Tests that the content of a file decides which kind of source it is."""

import os
import sqlite3

import pytest

from tftool.base.errors import InputError
from tftool.recordings.find import Kind, find, names_a_path

MCAP = b"\x89MCAP0\r\n" + bytes(40)
ROS1 = b"#ROSBAG V2.0\n" + bytes(40)


def sqlite_file(path):
    with sqlite3.connect(path) as base:
        base.execute("create table topics (id integer)")
    base.close()


@pytest.mark.parametrize(
    ("content", "kind"),
    [
        (MCAP, Kind.MCAP),
        (ROS1, Kind.ROS1),
        (b"\x28\xb5\x2f\xfd" + bytes(8), Kind.ZSTD),
        (b'<?xml version="1.0"?>\n<robot name="r"/>', Kind.DESCRIPTION),
        (b'\xef\xbb\xbf\n <robot name="r"/>', Kind.DESCRIPTION),
        (b"about: something\nnodes: []\n", Kind.SCENARIO),
    ],
)
def test_a_file_is_known_by_its_content(tmp_path, content, kind):
    path = tmp_path / "misleading.pdf"
    path.write_bytes(content)

    found = find(str(path))

    assert found.kind is kind
    assert found.paths == (path,)
    assert names_a_path(str(path))


def test_a_database_is_known_by_its_content(tmp_path):
    path = tmp_path / "run.bag"
    sqlite_file(path)

    assert find(str(path)).kind is Kind.SQLITE


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"", "empty file"),
        (b"\x89MCAP0\n" + bytes(40), r"line ends were converted .* fetch the file again"),
        (b"#ROSRECORD V1.2\n" + bytes(40), r"ROSRECORD V1.2.*rosbag fix"),
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:0", "git lfs pull"),
        (b"\x1f\x8b\x08" + bytes(40), "gunzip"),
        (bytes(40), "neither a recording"),
        (b"\xc3\x28\x81 noise without a zero or a control character", "neither a recording"),
        (b"\x07\x1f about: noise", "neither a recording"),
    ],
)
def test_a_file_that_is_no_source_is_refused_with_what_it_is(tmp_path, content, told):
    path = tmp_path / "run.mcap"
    path.write_bytes(content)

    with pytest.raises(InputError, match=told):
        find(str(path))


def test_a_file_is_what_its_suffix_says_where_its_content_says_nothing(tmp_path):
    written, recorded, robot = (tmp_path / name for name in ("a.yaml", "a.mcap", "a.urdf"))
    written.touch()
    recorded.touch()
    robot.write_text("hello")

    with pytest.raises(InputError, match=r"empty file \(0 bytes\)\.$"):
        find(str(written))
    with pytest.raises(InputError, match="nothing was recorded"):
        find(str(recorded))
    assert find(str(robot)).kind is Kind.DESCRIPTION


@pytest.mark.parametrize("name", ["README.md", "pyproject.toml", "passwd"])
def test_a_text_without_keys_of_a_scenario_is_none(tmp_path, name):
    (tmp_path / name).write_text("root: x\n[tool]\nmade = 1\n")

    with pytest.raises(InputError, match="neither a recording"):
        find(str(tmp_path / name))


def test_a_python_file_that_starts_no_transforms_names_the_command_that_runs_it(tmp_path):
    (tmp_path / "talker.py").write_text("import rclpy\n")

    with pytest.raises(InputError, match=r"'tftool run .*talker\.py' runs a ROS node"):
        find(str(tmp_path / "talker.py"))


def test_nothing_is_refused(tmp_path):
    missing = str(tmp_path / "run.mcap")

    assert not names_a_path(missing)
    with pytest.raises(InputError, match="There is no file or folder"):
        find(missing)
    with pytest.raises(InputError, match="'' names no file or folder"):
        find("")


def test_a_path_that_holds_one_folder_further_down_is_told(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    wanted = tmp_path / "src" / "frames" / "scenarios" / "follow.yaml"
    wanted.parent.mkdir(parents=True)
    wanted.write_text("duration: 1 s")

    with pytest.raises(InputError, match=r"Did you mean 'src/frames/scenarios/follow\.yaml'\?"):
        find("frames/scenarios/follow.yaml")
    with pytest.raises(InputError, match=r"folder 'frames/scenarios/lead\.yaml'\.$"):
        find("frames/scenarios/lead.yaml")


def test_a_link_to_nothing_says_where_it_leads(tmp_path):
    (tmp_path / "link").symlink_to(tmp_path / "gone")

    with pytest.raises(InputError, match=r"is a broken symbolic link to .*gone"):
        find(str(tmp_path / "link"))


def test_a_pipe_is_refused_without_reading_it(tmp_path):
    os.mkfifo(tmp_path / "pipe")

    with pytest.raises(InputError, match="is a pipe"):
        find(str(tmp_path / "pipe"))


def test_a_file_that_may_not_be_read_is_refused(tmp_path):
    path = tmp_path / "run.mcap"
    path.write_bytes(MCAP)
    path.chmod(0)
    if os.access(path, os.R_OK):
        pytest.skip("this user, probably root, may read every file")

    with pytest.raises(InputError, match="permission denied"):
        find(str(path))


def test_a_folder_with_metadata_is_one_recording(tmp_path):
    bag = tmp_path / "run.bag"
    bag.mkdir()
    (bag / "metadata.yaml").write_text("rosbag2_bagfile_information: {version: 9}\n")

    assert find(str(bag)).kind is Kind.ROSBAG2
    assert find(str(bag / "metadata.yaml")).paths == (bag,)


def test_a_folder_with_one_recording_is_that_recording(tmp_path):
    (tmp_path / "run.mcap").write_bytes(MCAP)
    (tmp_path / "notes.txt").write_text("hello")

    found = find(str(tmp_path))

    assert (found.kind, found.paths) == (Kind.MCAP, (tmp_path / "run.mcap",))


def test_parts_without_metadata_are_one_recording(tmp_path):
    for part in range(2):
        (tmp_path / f"run_{part}.mcap").write_bytes(MCAP)

    assert find(str(tmp_path)).kind is Kind.ROSBAG2


def test_a_folder_and_a_glob_of_several_name_them_in_order(tmp_path):
    for name in ("b.mcap", "a.bag"):
        (tmp_path / name).write_bytes(MCAP if name.endswith("mcap") else ROS1)
    paths = (tmp_path / "a.bag", tmp_path / "b.mcap")

    assert (find(str(tmp_path)).kind, find(str(tmp_path)).paths) == (Kind.SEVERAL, paths)
    assert find(str(tmp_path / "*")).paths == paths
    assert names_a_path(str(tmp_path / "*.mcap"))


def test_a_folder_of_something_else_is_refused(tmp_path):
    (tmp_path / "notes.txt").write_text("hello")

    with pytest.raises(InputError, match=r"No recording .* which has 1 entry"):
        find(str(tmp_path))


def test_a_scenario_of_signs_that_are_cut_where_the_first_bytes_end_is_one(tmp_path):
    for start in range(4):
        (tmp_path / "s.yaml").write_text("x" * start + "€" * 3000, encoding="utf-8")

        assert find(str(tmp_path / "s.yaml")).kind is Kind.SCENARIO


def test_broken_links_in_a_folder_do_not_keep_a_recording_from_being_found(tmp_path):
    folder = tmp_path / "all"
    folder.mkdir()
    (folder / "nothing").symlink_to("nowhere")
    (folder / "circle").symlink_to("circle")

    with pytest.raises(InputError, match="2 entries"):
        find(str(folder))
    (folder / "run.bag").write_bytes(b"#ROSBAG V2.0\n")

    assert find(str(folder)).paths == (folder / "run.bag",)
    assert find(str(folder / "*")).paths == (folder / "run.bag",)
