"""Tests of commands for many recordings: by one process, several, or a cluster of Dask workers."""

import gc
import json
import os
import shutil
import signal
import subprocess
import sys
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from threading import Thread
from threading import enumerate as enumerate_threads

import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from tests.commands.test_doctor_recordings import drive
from tests.patience import PATIENCE
from tests.recordings.writers import write_mcap
from tftool.base.stamps import seconds
from tftool.world.clock import WallClock, run


@pytest.fixture
def fleet(tmp_path):
    """Write twelve recordings of three days; each third has a fault, one is no recording."""
    good = write_mcap(tmp_path / "good.mcap", drive())
    bad = write_mcap(tmp_path / "bad.mcap", drive(scans_in="laser_frame"))
    runs = tmp_path / "runs"
    for number in range(12):
        day = runs / f"day{number % 3}"
        day.mkdir(parents=True, exist_ok=True)
        shutil.copy(bad if number % 3 == 0 else good, day / f"run{number:02}.mcap")
    (runs / "day1" / "cut.mcap").touch()
    (runs / "day1" / "notes.txt").write_text("no recording", encoding="utf-8")
    return runs


def rows_of(path):
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def ids_of(rows):
    return {Path(row["source"]).name: row["id"] for row in rows}


def expected():
    ids = {f"run{n:02}.mcap": "none" if n % 3 else "unknown-frame" for n in range(12)}
    return ids | {"cut.mcap": "unreadable"}


def test_a_glob_reaches_into_folders_and_names_what_is_broken(tftool, fleet, tmp_path):
    output = tmp_path / "found.jsonl"
    result = tftool("doctor", f"{fleet}/**/*.mcap", "-o", output)
    assert result.status == 3
    assert ids_of(rows_of(output)) == expected()
    assert result.out.startswith("13 recordings: 4 with errors, 8 fine, 1 unreadable. ")
    assert tftool("doctor", f"{fleet}/*.none", "-o", output).status == 3
    # A glob that matches all files selects only recordings.
    everything = tmp_path / "all.jsonl"
    tftool("doctor", f"{fleet}/**/*", "-o", everything)
    assert ids_of(rows_of(everything)) == expected()


def test_parquet_has_a_row_a_finding_and_is_gone_on_with(tftool, fleet, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet", reason="the extra 'parquet'")
    output = tmp_path / "found.parquet"
    some = sorted(map(str, fleet.glob("day*/run*.mcap")))
    assert tftool("doctor", *some[:3], "-o", output).status == 1
    result = tftool("doctor", *some, "-o", output, "--resume")
    assert "(3 were in the file already: " in result.out
    table = parquet.read_table(output).to_pylist()
    assert ids_of(table) == {k: v for k, v in expected().items() if k != "cut.mcap"}
    found = next(row for row in table if row["id"] == "unknown-frame")
    assert (found["frames"], found["topics"], found["count"]) == (["laser_frame"], ["/scan"], 40)
    assert [one.name for one in tmp_path.glob("found*")] == ["found.parquet"]


@pytest.mark.parametrize("suffix", ["jsonl", "csv", "parquet"])
def test_resume_counts_earlier_findings_for_the_exit_status(tftool, fleet, tmp_path, suffix):
    """Check that findings in the existing file of an interrupted run also set the exit status."""
    if suffix == "parquet":
        pytest.importorskip("pyarrow.parquet", reason="the extra 'parquet'")
    output = tmp_path / f"found.{suffix}"
    some = sorted(map(str, fleet.glob("day*/run*.mcap")))
    first = tftool("doctor", *some, "-o", output)
    told = first.out.partition(": ")[2].partition(".")[0]

    again = tftool("doctor", *some, "-o", output, "--resume")

    assert (first.status, again.status) == (1, 1)
    assert told.startswith("4 with errors")
    assert f"({len(some)} were in the file already: {told})" in again.out
    assert tftool("doctor", *some, "-o", output, "--resume", "--fail-on", "never").status == 0


@pytest.mark.parametrize("suffix", ["jsonl", "csv"])
def test_resume_keeps_the_status_of_an_unreadable_recording(tftool, fleet, tmp_path, suffix):
    output = tmp_path / f"found.{suffix}"
    broken = fleet / "day1" / "cut.mcap"
    for command in ("doctor", "info"):
        assert tftool(command, broken, "-o", output).status == 3
        assert tftool(command, broken, "-o", output, "--resume").status == 3


@pytest.mark.parametrize("suffix", ["jsonl", "csv", "parquet"])
@pytest.mark.parametrize(("first", "then"), [("info", "doctor"), ("doctor", "info")])
def test_rows_of_another_command_are_not_gone_on_with(tftool, fleet, tmp_path, first, then, suffix):
    """Check that rows of another command are refused, because they lack the new results."""
    if suffix == "parquet":
        pytest.importorskip("pyarrow.parquet", reason="the extra 'parquet'")
    output = tmp_path / f"found.{suffix}"
    for recording in ("day0/run00.mcap", "day1/cut.mcap"):
        tftool(first, fleet / recording, "-o", output, "--resume")
        before = output.read_bytes()

        result = tftool(then, fleet / recording, "-o", output, "--resume")

        assert (result.status, result.out) == (3, "")
        assert "the file does not contain rows of this command" in " ".join(result.err.split())
        assert output.read_bytes() == before
        output.unlink()


JUMP = """\
duration: 4 s
nodes: [turtlesim, broadcaster: {turtle: turtle1}]
script:
  - {at: 2 s, teleport: {turtle: turtle1, x: 10, y: 10}}
"""


def test_a_scenario_is_played_for_its_rows(tftool, tmp_path):
    (tmp_path / "jump.yaml").write_text(JUMP)
    (tmp_path / "calm.yaml").write_text(f"{JUMP}doctor: {{ignore: [teleport]}}\n")
    output = tmp_path / "found.jsonl"

    result = tftool("doctor", tmp_path / "jump.yaml", tmp_path / "calm.yaml", "-o", output)

    assert ids_of(rows_of(output)) == {"jump.yaml": "teleport", "calm.yaml": "none"}
    assert (result.status, result.err) == (1, "")
    assert tftool("doctor", tmp_path / "jump.yaml", "-o", output, "--from", "1").status == 2


@pytest.mark.parametrize(
    "words", [["--junit", "report.xml"], ["--json"], ["--markdown"], ["--verbose"]]
)
def test_a_report_that_would_not_be_written_is_refused(tftool, fleet, tmp_path, words):
    output = tmp_path / "found.csv"

    result = tftool("doctor", fleet, "-o", output, *words)

    assert (result.status, result.out) == (2, "")
    assert f"-o writes rows instead of a report: leave out {words[0]}." in result.err
    assert not output.exists()


def test_rows_of_a_process_that_was_killed_become_part_of_the_table(tftool, fleet, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet", reason="the extra 'parquet'")
    some = sorted(map(str, fleet.glob("day*/run*.mcap")))[:3]
    left = tmp_path / "left.jsonl"
    tftool("doctor", *some[:2], "-o", left)
    # The interrupted run leaves the rows that it has written, the last one incomplete.
    (tmp_path / "found.parquet.part").write_bytes(left.read_bytes() + b'{"source": "ha')
    result = tftool("doctor", *some, "-o", tmp_path / "found.parquet", "--resume")
    assert "(2 were in the file already: " in result.out
    table = parquet.read_table(tmp_path / "found.parquet")
    assert set(table.column("source").to_pylist()) == set(some)


def test_names_that_are_no_text_are_in_every_file(tftool, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet", reason="the extra 'parquet'")
    strange = tmp_path / os.fsdecode(b"r\xfcn.mcap")
    write_mcap(tmp_path / "run.mcap", drive()).rename(strange)
    for suffix in ("jsonl", "csv", "parquet"):
        output = tmp_path / f"found.{suffix}"
        assert tftool("doctor", strange, "-o", output).status == 0
        assert (
            "(1 were in the file already: "
            in tftool("doctor", strange, "-o", output, "--resume").out
        )
    assert parquet.read_table(tmp_path / "found.parquet").num_rows == 1


def test_an_output_that_holds_something_else_is_left_alone(tftool, fleet, tmp_path):
    pytest.importorskip("pyarrow", reason="the extra 'parquet'")
    run = next(fleet.glob("day1/run*.mcap"))
    for suffix in ("jsonl", "csv", "parquet"):
        output = tmp_path / f"found.{suffix}"
        output.write_text("what,ever\n1,2\n", encoding="utf-8")
        result = tftool("doctor", run, "-o", output, "--resume")
        assert (result.status, "contain rows of this command" in result.err) == (3, True)
        assert output.read_text(encoding="utf-8") == "what,ever\n1,2\n"


def test_info_gives_a_line_or_a_row_a_recording(tftool, fleet, tmp_path):
    one, broken = fleet / "day1" / "run01.mcap", fleet / "day1" / "cut.mcap"
    result = tftool("info", one, broken)
    assert result.status == 3
    lines = [line.split() for line in result.out.splitlines()]
    assert lines[1][:7] == [str(one), "MCAP", "4.0", "s", "241", "201", "3"]
    assert lines[-2] == ["Unreadable"]
    assert "empty file" in " ".join(lines[-1])

    output = tmp_path / "runs.jsonl"
    result = tftool("info", f"{fleet}/**/*.mcap", "-j", "2", "-o", output)
    assert result.out.startswith("13 recordings: 12 whole, 1 unreadable. ")
    rows = {Path(row["source"]).name: row for row in rows_of(output)}
    assert rows["run01.mcap"]["transforms"] == 201
    assert rows["run01.mcap"]["edges"] == [["base_link", "laser"], ["odom", "base_link"]]
    assert "empty file" in rows["cut.mcap"]["unreadable"]


def test_recordings_are_fetched_by_url(tftool, fleet, tmp_path):
    pytest.importorskip("fsspec", reason="the extra 'fleet'")
    output = tmp_path / "found.jsonl"
    result = tftool("doctor", f"file://{fleet}/day0/*.mcap", "-o", output)
    assert (result.status, ids_of(rows_of(output))) == (
        1, {k: v for k, v in expected().items() if v == "unknown-frame"},
    )  # fmt: skip
    one = f"file://{fleet}/day0/run00.mcap"
    shown = tftool("doctor", one)
    assert shown.out.startswith(f"{one}: MCAP")
    told = tftool("info", one)
    assert (told.status, told.out.partition(",")[0]) == (0, f"{one}: MCAP")
    elsewhere = tftool("tree", one)
    assert elsewhere.status == 3
    assert f"'{one}' is a URL, which only 'tftool info' and 'tftool doctor' read" in elsewhere.err
    for url in (f"file://{fleet}/none.mcap", "none://bucket/run.mcap", f"file://{fleet}/*.bag"):
        assert tftool("doctor", url).status == 3
        assert "Traceback" not in tftool("doctor", url).err


def test_a_place_that_needs_another_package_is_wrong_usage(tftool):
    pytest.importorskip("fsspec", reason="the extra 'fleet'")
    if find_spec("s3fs") is not None:
        pytest.skip("s3fs, whose absence is tested, is installed")

    result = tftool("info", "s3://bucket/run.mcap")

    assert result.status == 2
    assert (
        "'s3://bucket/run.mcap' needs a package that the extra 'fleet' does not contain: "
        in result.err
    )
    assert "s3fs" in result.err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--scheduler", "tcp://127.0.0.1:1"], "only allowed with -o FILE: add -o FILE"),
        (
            ["-o", "x.jsonl", "-j", "2", "--scheduler", "tcp://127.0.0.1:1"],
            "--scheduler and --jobs are two ways",
        ),
        (["-o", "x.jsonl", "--scheduler", "nothing"], "is not the address of a Dask scheduler"),
    ],
)
def test_a_cluster_that_cannot_be_is_refused(tftool, fleet, tmp_path, monkeypatch, words, told):
    pytest.importorskip("distributed", reason="the extra 'fleet'")
    monkeypatch.chdir(tmp_path)
    result = tftool("doctor", fleet / "day0" / "run00.mcap", *words)
    assert (result.status, told in result.err) == (2, True)


class DaskCluster:
    """Scheduler of Dask and two workers, in separate processes."""

    def __init__(self, folder):
        self.processes = []
        file = folder / "scheduler.json"
        here = ["--host", "127.0.0.1", "--no-dashboard"]
        self._start("dask_scheduler", *here, "--port", "0", "--scheduler-file", str(file))
        found = []

        def written():
            # The file exists before its content is complete.
            with suppress(OSError, ValueError):
                found.append(json.loads(file.read_text(encoding="utf-8"))["address"])
            return found

        wait_until(written)
        self.address = found[0]
        own = [*here, "--nthreads", "1", "--no-nanny", "--local-directory", str(folder)]
        self.workers = [self._start("dask_worker", self.address, *own) for _ in range(2)]

    def _start(self, module, *words):
        process = subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.{module}", *words],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.processes.append(process)
        return process

    def stop(self):
        for process in self.processes:
            process.kill()
            process.wait()


def wait_until(holds):
    """Wait for an effect of another process, polled on the clock of a world."""
    clock = WallClock()

    async def looked():
        end = clock.now() + seconds(PATIENCE)
        while not holds():
            assert clock.now() < end
            await clock.sleep(seconds(0.02))

    run(clock, looked())


@pytest.fixture
def cluster(tmp_path):
    pytest.importorskip("distributed", reason="the extra 'fleet'")
    made = DaskCluster(tmp_path)
    yield made
    made.stop()


def test_a_refused_scheduler_leaves_no_thread_behind(tftool, fleet, tmp_path):
    pytest.importorskip("distributed", reason="the extra 'fleet'")
    output = tmp_path / "found.jsonl"
    # The command itself must end the thread, so the garbage collector is off.
    gc.disable()
    try:
        result = tftool("doctor", fleet, "-o", output, "--scheduler", "nothing")
        assert "is not the address of a Dask scheduler" in result.err
        assert "IO loop" not in [thread.name for thread in enumerate_threads()]
    finally:
        gc.enable()


def test_a_cluster_goes_on_when_one_of_its_workers_is_killed(tftool, fleet, tmp_path, cluster):
    output = tmp_path / "found.jsonl"

    def kill_one():
        wait_until(lambda: output.exists() and output.stat().st_size)
        cluster.workers[0].send_signal(signal.SIGKILL)

    killer = Thread(target=kill_one)
    killer.start()
    result = tftool("doctor", f"{fleet}/**/*.mcap", "-o", output, "--scheduler", cluster.address)
    killer.join()
    assert (result.status, result.err) == (3, "")
    assert ids_of(rows_of(output)) == expected()
    assert len(rows_of(output)) == 13
