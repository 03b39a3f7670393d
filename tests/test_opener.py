"""Tests of `tftool.open` for all sources, and of commands that read the same sources."""

import asyncio
import json
from pathlib import Path

import pytest

import tftool as library
from tests.world.link.processes import Process
from tftool import Buffer, Transform, TransformStamped, seconds
from tftool.base.errors import InputError, LinkError, UsageError
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.opener import open_frames

URDF = """
<robot name="arm">
  <link name="base"/><link name="upper"/><link name="tool"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 0.5"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/>
  </joint>
  <joint name="flange" type="fixed">
    <parent link="upper"/><child link="tool"/><origin xyz="0.3 0 0"/>
  </joint>
</robot>
"""
STATICS = "ros2 run tf2_ros static_transform_publisher 0 0 1 0 0 0 base laser\n"


def run_of(path: Path, first: int = 0, count: int = 50, x: float = 0.0) -> Path:
    """Write a recording of `base` in `map` at 10 Hz that begins `first` seconds after 100 s."""
    buffer = Buffer(seconds(1000))
    for step in range(count):
        pose = Transform((x + 0.1 * step, 0.0, 0.0), quaternion_from_rpy(0.0, 0.0, 0.01 * step))
        stamp = seconds(100 + first) + step * seconds(0.1)
        buffer.set_transform(TransformStamped(stamp, "map", "base", pose), "robot")
    mount = TransformStamped(0, "base", "laser", Transform((x, 0.0, 0.4)))
    buffer.set_transform_static(mount, "description")
    library.export(buffer, path=path)
    return path


def several(folder: Path) -> Path:
    """Write two recordings whose names are not in the order of time."""
    folder.mkdir()
    run_of(folder / "a.mcap", first=20, x=7.0)
    run_of(folder / "b.mcap", first=0)
    return folder


def written(path: Path, text: str) -> Path:
    path.write_text(text)
    return path


PLACES = {
    "recording": (lambda folder: run_of(folder / "run.mcap"), "map", "laser", 2.5),
    "folder": (lambda folder: several(folder / "runs"), "map", "laser", 2.5),
    "glob": (lambda folder: several(folder / "runs") / "*.mcap", "map", "laser", 22.5),
    "description": (lambda folder: written(folder / "arm.urdf", URDF), "base", "tool", None),
    "statics": (lambda folder: written(folder / "statics.sh", STATICS), "base", "laser", None),
    "built-in scenario": (lambda _: "turtles", "turtle2", "turtle1", 4.5),
    "scenario": (lambda _: "robot", "map", "laser_link", 3.25),
}
KINDS = {
    "folder": "recording",
    "glob": "recording",
    "description": "robot description",
    "statics": "file of static transforms",
    "built-in scenario": "scenario",
}


@pytest.mark.parametrize("kind", PLACES)
def test_python_and_the_command_line_give_the_same(kind, tftool, tmp_path):
    make, target, source, time = PLACES[kind]
    place = make(tmp_path)
    words = ["--once"] if time is None else ["--at", str(time)]

    shown = tftool("echo", target, source, place, "--json", *words)
    with library.open(place, until=time) as frames:
        stamp = 0 if time is None else frames.at(time)
        found = frames.buffer.lookup_transform(target, source, stamp)

    assert shown.status == 0, shown.err
    told = json.loads(shown.out)
    assert told["stamp_ns"] == found.stamp
    assert told["translation"] == found.transform.translation._asdict()
    assert told["rotation"] == found.transform.rotation._asdict()
    assert frames.kind == KINDS.get(kind, kind)


def test_python_and_the_command_line_hear_the_same_session(tftool, outside):
    with Process("static", "1", "2", "3", "0", "0", "0", "world", "camera") as process:
        process.says("Spinning until stopped")
        shown = json.loads(tftool("tree", "--json", "--join").out)
        with library.open(listen_for=1.0) as frames:
            found = frames.buffer.lookup_transform("world", "camera")
        assert process.interrupt() == 130

    assert frames.kind == "session"
    assert frames.end - frames.start >= seconds(0.9)
    assert frames.recording is None
    assert frames.robot is None
    (camera,) = [one for one in shown["frames"] if one["frame"] == "camera"]
    assert camera["root_from_frame"]["translation"] == list(found.transform.translation)


def test_python_never_hosts():
    with pytest.raises(LinkError, match="No session is running here: start one with 'tftool demo'"):
        library.open()


@pytest.mark.parametrize(
    ("given", "meant"), [("untill", "until"), ("tf_topic", "tf_topics"), ("listn", "listen")]
)
def test_an_unknown_keyword_is_refused_with_the_known_one(given, meant):
    with pytest.raises(TypeError, match=f"argument '{given}'; did you mean '{meant}'"):
        library.open("turtles", **{given: 12})


def test_it_works_inside_a_running_loop():
    async def cell():
        with library.open("turtles", until=2) as frames:
            return frames.buffer.frames()

    assert {"world", "turtle1", "turtle2"} <= set(asyncio.run(cell()))


def test_a_recording_knows_its_span_and_a_description_has_none(tmp_path):
    with library.open(run_of(tmp_path / "run.mcap")) as frames:
        assert (frames.start, frames.end) == (seconds(100), seconds(104.9))
        assert frames.at(1.5) == seconds(101.5)
        assert frames.recording.topics
        assert frames.title == f"recording '{tmp_path / 'run.mcap'}'"
    with library.open(written(tmp_path / "arm.urdf", URDF), joints={"shoulder": 0.5}) as frames:
        assert frames.start is None
        assert frames.end is None
        assert frames.at(99) == 0
        assert frames.robot.name == "arm"
        upper = frames.buffer.lookup_transform("base", "upper").transform
        assert upper.rotation == pytest.approx(quaternion_from_rpy(0.0, 0.0, 0.5))


def test_several_recordings_are_joined_in_the_order_of_time(tmp_path):
    """Check that the last static transform in time is used, whatever the names of the files."""
    with library.open(several(tmp_path / "runs")) as frames:
        assert (frames.start, frames.end) == (seconds(100), seconds(124.9))
        mount = frames.buffer.lookup_transform("base", "laser").transform

    assert mount.translation.x == 7.0


def test_nothing_of_a_scenario_is_pruned():
    with library.open("turtles", until=20) as frames:
        assert frames.buffer.can_transform("world", "turtle1", frames.at(1))


def test_a_scenario_is_played_for_5_s_or_as_far_as_is_asked(tmp_path):
    short = written(tmp_path / "short.yaml", "duration: 2 s\nnodes:\n  - turtlesim: {}\n")

    spans = [
        (one.end - one.start) / seconds(1)
        for one in (
            open_frames("turtles"),
            open_frames("turtles", until=7.5),
            open_frames("turtles", until=seconds(7)),
            open_frames("square", until=float("inf")),
            open_frames(short),
        )
    ]

    assert spans[:3] == [5.0, 7.5, 7.0]
    assert spans[3] > 20
    assert spans[4] == 2.0


@pytest.mark.parametrize(
    ("place", "options", "told"),
    [
        ("turtles", {"joints": {"a": 1.0}}, "leave out --joint a=1"),
        ("turtles", {"with_odometry": True}, "leave out --with-odometry"),
        ("turtles", {"until": -1.0}, "give more than 0"),
        ("arm.urdf", {"with_odometry": True}, "leave out --with-odometry"),
        ("arm.urdf", {"urdf": "arm.urdf"}, "--urdf is only allowed for a recording"),
        ("arm.urdf", {"cache_time": seconds(1)}, "leave out --cache-time"),
        ("statics.sh", {"joints": {"a": 1.0}}, "leave out --joint a=1"),
    ],
)
def test_options_that_do_not_fit_the_input_are_refused(place, options, told, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    written(tmp_path / "arm.urdf", URDF)
    written(tmp_path / "statics.sh", STATICS)

    with pytest.raises(UsageError) as refused:
        library.open(place, **options)

    assert told in str(refused.value)


def test_an_unknown_scenario_is_refused_with_a_similar_name():
    with pytest.raises(InputError, match="no scenario is named 'turtels'; did you mean 'turtles'"):
        library.open("turtels")


def test_a_diagnosis_and_a_comparison_take_what_was_opened(tmp_path):
    with library.open(run_of(tmp_path / "run.mcap")) as frames:
        recording = library.open_recording(tmp_path / "run.mcap")
        with recording:
            assert library.diagnose(frames) == library.diagnose(recording)
        assert library.explain(frames, "map", "laser", frames.at(1)).available
        assert not library.diff(frames, tmp_path / "run.mcap")
    with library.open("turtles") as frames:
        assert not library.diff(frames, frames)
        assert library.explain(frames, "turtle2", "turtle1", frames.at(4)).available
