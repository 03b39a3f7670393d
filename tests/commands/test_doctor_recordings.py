"""Tests of the doctor on recordings written by other libraries."""

import csv
import dataclasses
import json
from pathlib import Path

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from tests.recordings.writers import SECOND, Sent, write_mcap, write_rosbag1
from tftool import diagnose, explain, open_recording

START = 1_750_000_000 * SECOND
STILL = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
MOUNT = (0.1, 0.0, 0.2, 0.0, 0.0, 0.0, 1.0)


def drive(scans_in="laser"):
    """Return four seconds of messages at 50 Hz, at half a metre per second, and scans at 10 Hz."""
    sent = [Sent(START, "/tf_static", ((0, "base_link", "laser", MOUNT),), node="/urdf")]
    for tick in range(200):
        stamp = START + tick * SECOND // 50
        pose = (0.01 * tick, *STILL[1:])
        sent.append(Sent(stamp + 5_000_000, "/tf", ((stamp, "odom", "base_link", pose),)))
        if tick % 5 == 0:
            sent.append(Sent(stamp + 15_000_000, "/scan", scan=(stamp, scans_in), node="/lidar"))
    return sent


def test_a_healthy_recording_has_nothing(tftool, tmp_path):
    run = write_mcap(tmp_path / "run.mcap", drive())
    result = tftool("doctor", run)
    assert (result.status, result.err) == (0, "")
    assert "nothing found;" in result.out
    assert tftool("info", run).out.endswith("\nDoctor: nothing is wrong.\n")


@pytest.mark.parametrize("write", [write_mcap, write_rosbag1])
def test_an_unknown_frame_id_is_reported_by_doctor_info_and_explain(tftool, tmp_path, write):
    run = write(tmp_path / "run", drive(scans_in="laser_frame"))
    result = tftool("doctor", run, "--json")
    (finding,) = json.loads(result.out)["findings"]
    assert result.status == 1
    assert (finding["id"], finding["topics"], finding["count"]) == (
        "unknown-frame", ["/scan"], 40,
    )  # fmt: skip
    assert "Doctor: 1 error (unknown-frame)." in tftool("info", run).out
    explained = tftool("explain", "odom", "laser_frame", run, "--message", "/scan@2")
    assert explained.status == 4
    assert "set frame_id of the driver to laser" in explained.out


def test_a_scan_is_explained_by_when_it_arrived(tftool, tmp_path):
    run = write_mcap(tmp_path / "run.mcap", drive())
    result = tftool("explain", "odom", "laser", run, "--message", "/scan@2")
    assert result.status == 0
    assert "when the message on /scan with this stamp arrived (15 ms later)" in result.out
    with open_recording(run) as recording:
        assert diagnose(recording) == []
        assert explain(recording, "odom", "laser", START + 2 * SECOND).available


@pytest.fixture
def runs(tmp_path):
    """Write a healthy recording, one with an unknown frame, and a file that is no recording."""
    write_mcap(tmp_path / "a.mcap", drive())
    write_mcap(tmp_path / "b.mcap", drive(scans_in="laser_frame"))
    (tmp_path / "c.mcap").touch()
    return [tmp_path / name for name in ("a.mcap", "b.mcap", "c.mcap")]


@pytest.mark.parametrize("jobs", [1, 2])
def test_many_recordings_become_rows_and_a_broken_one_stops_none(tftool, runs, tmp_path, jobs):
    output = tmp_path / "found.jsonl"
    result = tftool("doctor", *runs, "-j", jobs, "-o", output)
    rows = [json.loads(line) for line in output.read_text(encoding="utf-8").splitlines()]
    assert result.status == 3
    assert {Path(row["source"]).name: row["id"] for row in rows} == {
        "a.mcap": "none", "b.mcap": "unknown-frame", "c.mcap": "unreadable",
    }  # fmt: skip
    assert result.out.startswith("3 recordings: 1 with errors, 1 fine, 1 unreadable. ")


@pytest.mark.parametrize("suffix", ["jsonl", "csv"])
def test_resume_skips_finished_recordings_and_repeats_an_incomplete_line(
    tftool, runs, tmp_path, suffix
):
    output = tmp_path / f"found.{suffix}"
    assert tftool("doctor", *runs[:2], "-o", output).status == 1
    whole = output.read_bytes()
    output.write_bytes(whole[:-20])

    result = tftool("doctor", *runs[:2], "-o", output, "--resume")

    assert result.out.startswith("1 recording: 1 with errors. ")
    assert "(1 were in the file already: " in result.out
    assert output.read_bytes() == whole


def test_no_cell_is_a_formula(tftool, tmp_path):
    run = write_mcap(tmp_path / "run.mcap", drive(scans_in="=cmd()"))
    output = tmp_path / "found.csv"
    tftool("doctor", run, "-o", output)
    with output.open(encoding="utf-8", newline="") as file:
        cells = [cell for row in csv.reader(file) for cell in row]
    assert not [cell for cell in cells if cell.startswith(("=", "+", "-", "@"))]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["-o", "found.xlsx"], "end it in .jsonl, .csv or .parquet"),
        (["--resume"], "only allowed with -o FILE: add -o FILE"),
        (["-o", "found.csv", "--select", "shap"], "did you mean shape?"),
    ],
)
def test_a_sweep_that_cannot_be_is_refused(tftool, runs, tmp_path, monkeypatch, words, told):
    monkeypatch.chdir(tmp_path)
    result = tftool("doctor", runs[0], *words)
    assert (result.status, told in result.err) == (2, True)
    assert not (tmp_path / "found.csv").exists()


ROBOT = """<robot name="r">
  <link name="base_link"/><link name="laser"/><link name="caster_link"/>
  <joint name="laser_joint" type="fixed">
    <parent link="base_link"/><child link="laser"/><origin xyz="0.1 0 0.25"/>
  </joint>
  <joint name="caster" type="continuous">
    <parent link="base_link"/><child link="caster_link"/>
  </joint>
</robot>"""


def ids_of(result):
    return [one["id"] for one in json.loads(result.out)["findings"] if not one["because_of"]]


def test_a_description_beside_a_recording_or_in_it_is_compared(tftool, tmp_path):
    states = Sent(START, "/joint_states", joints=(START, ("wheel",), (0.0,)))
    file = tmp_path / "robot.urdf"
    file.write_text(ROBOT, encoding="utf-8")
    run = write_mcap(tmp_path / "run.mcap", [*drive(), states])
    inside = write_mcap(
        tmp_path / "inside.mcap", [*drive(), states, Sent(START, "/robot_description", text=ROBOT)]
    )
    expected = ["joint-without-state", "urdf-tf-mismatch"]
    assert ids_of(tftool("doctor", run, "--urdf", file, "--json")) == expected
    assert ids_of(tftool("doctor", inside, "--json")) == expected
    with open_recording(run) as recording:
        found = [one.id for one in diagnose(recording, urdf=file) if one.because_of is None]
    assert found == expected
    assert ids_of(tftool("doctor", run, "--json")) == []


def test_a_description_with_mistakes_is_a_finding_and_a_missing_one_is_refused(tftool, tmp_path):
    file = tmp_path / "robot.urdf"
    file.write_text(ROBOT.replace('child link="laser"', 'child link="lasre"'), encoding="utf-8")
    run = write_mcap(tmp_path / "run.mcap", drive())
    result = tftool("doctor", run, "--urdf", file)
    assert result.status == 1
    assert "warning  urdf-invalid: the robot description cannot be read" in result.out
    assert f"{file}:4:" in result.out
    assert tftool("doctor", run, "--urdf", tmp_path / "none.urdf").status == 3


def test_a_part_of_a_recording_is_looked_at(tftool, tmp_path):
    sent = [one for one in drive() if not (one.topic == "/tf" and START + 1.5e9 < one.log_time
            < START + 2.5e9)]  # fmt: skip
    run = write_mcap(tmp_path / "run.mcap", sent)
    assert "gap" in ids_of(tftool("doctor", run, "--json"))
    assert ids_of(tftool("doctor", run, "--to", "1.4", "--json")) == []
    assert ids_of(tftool("doctor", run, "--from", "2.6", "--json")) == []
    assert ids_of(tftool("doctor", run, "--from", "1750000002.6", "--json")) == []
    result = tftool("doctor", run, "--from", "9")
    assert (result.status, "has no data between --from and --to" in result.err) == (3, True)
    result = tftool("doctor", run, "--from", "2", "--to", "1")
    assert (result.status, "--to is before --from: exchange" in result.err) == (2, True)
    assert tftool("doctor", "turtles", "--from", "1").status == 2


def test_transforms_of_a_namespace_are_looked_at_where_that_is_said(tftool, tmp_path):
    moved = [
        dataclasses.replace(one, topic=f"/r1{one.topic}") if one.topic.startswith("/tf") else one
        for one in drive()
    ]
    run = write_mcap(tmp_path / "run.mcap", moved)
    assert ids_of(tftool("doctor", run, "--json")) == ["namespaced-topic"]
    assert ids_of(tftool("doctor", run, "--tf-topic", "/r1/tf", "--json")) == []
    result = tftool("doctor", run, "--tf-topic", "/r2/tf")
    assert (result.status, "there is /r1/tf" in result.err) == (3, True)


def test_the_list_beside_a_recording_is_followed(tftool, tmp_path):
    run = write_mcap(tmp_path / "run.mcap", drive(scans_in="laser_frame"))
    rules = tmp_path / "run.doctor.yaml"
    rules.write_text("ignore: [unknown-frame]\n", encoding="utf-8")
    result = tftool("doctor", run)
    assert (result.status, result.err) == (0, f"Using the doctor's settings in {rules}.\n")
    output = tmp_path / "found.jsonl"
    assert tftool("doctor", run, "-o", output).status == 0

    rules.write_text("ignore: [unknown-fram]\n", encoding="utf-8")
    result = tftool("doctor", run)
    assert (result.status, "did you mean 'unknown-frame'?" in result.err) == (3, True)
    assert tftool("doctor", run, "-o", output).status == 3
    assert "run.doctor.yaml" in output.read_text(encoding="utf-8")
