"""Tests of files that users name; a pipe without a writer must not block."""

import os
import subprocess
import sys
import threading

import pytest

from tests.patience import PATIENCE, answered
from tftool import Transform, TransformStamped, write_recording
from tftool.base.named_files import LARGEST, open_regular, read_named, read_named_text
from tftool.commands.shared.printer import write_file

pytestmark = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes with a name")


@pytest.fixture
def pipe(tmp_path):
    path = tmp_path / "pipe"
    os.mkfifo(path)
    return path


def refused(read, path):
    def ask():
        try:
            read(path)
        except OSError as error:
            return error.strerror
        return "read"

    return answered(ask)


def test_a_pipe_into_which_no_process_writes_is_refused(pipe):
    assert refused(read_named, pipe) == ("no process writes into the pipe: start the writer first")
    assert refused(open_regular, pipe) == "a regular file is needed, not a pipe or a device"


def test_text_from_a_pipe_is_read_to_its_end():
    sent = "größer\r\n" * 20_000
    reading, writing = os.pipe()

    def write():
        with open(writing, "w", encoding="utf-8", newline="") as file:
            file.write(sent)

    # This is more than a pipe stores, so it must be written while the test reads.
    writer = threading.Thread(target=write, daemon=True)
    writer.start()

    assert answered(lambda: read_named_text(f"/dev/fd/{reading}")) == sent.replace("\r\n", "\n")
    writer.join(PATIENCE)
    os.close(reading)


def test_files_are_read_whole_folders_and_what_never_ends_are_refused(tmp_path):
    file = tmp_path / "file"
    file.write_bytes(b"\x00\r\n" * 100_000)

    with open_regular(file) as opened:
        assert opened.read() == read_named(file) == file.read_bytes()
    for read in (open_regular, read_named):
        assert refused(read, tmp_path) == "Is a directory"
    assert (
        refused(read_named, "/dev/zero")
        == f"the pipe has more than {LARGEST >> 20} MiB: save its data to a file"
    )
    assert answered(lambda: read_named("/dev/null")) == b""


def test_text_written_into_a_pipe_arrives_at_its_reader(pipe):
    read = []
    reader = threading.Thread(target=lambda: read.append(pipe.read_bytes()), daemon=True)
    kept = os.open(pipe, os.O_RDWR)
    reader.start()

    sent = "ä" * 200_000
    answered(lambda: write_file(pipe, sent) is None)
    os.close(kept)
    reader.join(PATIENCE)

    assert b"".join(read).decode() == sent


@pytest.mark.parametrize(
    "words",
    [
        ["info", "run.mcap", "--urdf", "pipe.urdf"],
        ["tree", "folder"],
        ["run", "pipe.py"],
        ["launch", "pipe.launch.py"],
        ["launch", "pipe.launch.xml"],
        ["run", "node.py", "--ros-args", "--params-file", "pipe.yaml"],
        ["check", "pipe.yaml"],
        ["tree", "run.mcap", "-o", "pipe.svg"],
        ["info", "run.mcap", "-o", "pipe.jsonl"],
        ["info", "run.mcap", "--resume", "-o", "pipe.jsonl"],
    ],
)
def test_no_command_hangs_where_a_file_is_a_pipe(tmp_path, words):
    with write_recording(tmp_path / "run.mcap") as recording:
        recording.transforms([TransformStamped(1, "map", "base", Transform())], log_time=1)
    (tmp_path / "node.py").write_text("print('it ran')", "utf-8")
    (tmp_path / "folder").mkdir()
    for name in (
        "pipe.urdf",
        "pipe.py",
        "pipe.launch.py",
        "pipe.launch.xml",
        "pipe.yaml",
        "pipe.svg",
        "pipe.jsonl",
    ):
        os.mkfifo(tmp_path / name)
    os.mkfifo(tmp_path / "folder" / "metadata.yaml")

    done = subprocess.run(
        [sys.executable, "-m", "tftool", *words],
        cwd=tmp_path,
        env={**os.environ, "TFTOOL_SESSION_DIR": str(tmp_path / "session")},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )

    assert done.returncode == 3, done.stderr
    assert words[-1].removesuffix("/metadata.yaml") in done.stderr
    assert "Traceback" not in done.stderr
