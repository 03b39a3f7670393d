import errno
import gc
import io
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import tftool as package
from tests.patience import PATIENCE
from tftool.app import main as app
from tftool.app.command_line import build_command
from tftool.app.index import COMMANDS, painted
from tftool.base.errors import (
    InputError,
    LookupException,
    NodeFailed,
    TftoolError,
    UsageError,
)
from tftool.buffer.native_kernel import BUILD, IS_NATIVE

ROOT = Path(__file__).parents[2]

# Modules whose import would make every command slow to start, help included.
HEAVY = {
    "numpy",
    "textual",
    "zenoh",
    "rich",
    "yaml",
    "asyncio",
    "transforms3d",
    "websockets",
    "zstandard",
    "lz4",
}


def start(*words, **options):
    environment = {**os.environ, "PYTHONUNBUFFERED": "", **options.pop("env", {})}
    return subprocess.Popen(
        [sys.executable, "-m", "tftool", *words],
        cwd=ROOT,
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        **options,
    )


def test_without_a_word_it_shows_its_help(tftool):
    result = tftool()

    assert result.status == 0
    assert result.out == tftool("--help").out
    assert "Start with 'tftool demo'" in result.out


def test_help_is_a_command_too(tftool):
    assert tftool("help").out == tftool("--help").out
    assert tftool("help", "tree").out == tftool("tree", "--help").out
    assert "Did you mean 'echo'?" in tftool("help", "ech").err
    assert "Did you mean 'echo'?" in tftool("help", "eko").err
    assert "Did you mean 'echo'?" in tftool("eco").err
    assert "mean" not in tftool("xyzzy").err


def test_the_options_of_sessions_are_shown_when_asked(tftool):
    brief, full = tftool("echo", "--help").out, tftool("echo", "--help-session").out

    assert "--connect" not in brief
    assert "--help-session" in brief
    assert "Session and network:\n  --join " in full
    assert "--help-session" not in tftool("check", "--help").out


def test_the_nearest_option_is_named_first(tftool):
    assert "Did you mean --format" in tftool("tree", "--formt", "x").err
    assert "Did you mean --json?" in tftool("tree", "--jsn").err
    assert "Did you mean --at?" in tftool("echo", "--att", "5").err


def test_one_option_is_spelt_alike_in_all_commands():

    # `--rate` is a speed of time in `demo` and `play`, and a frequency in all other commands.
    other = {("demo", "--rate"), ("play", "--rate")}
    # `--set` is a parameter of a node in one command, and the pose of a link in another;
    # `--restamp` is an option of recordings.
    other |= {("edit", "--set"), ("edit", "--restamp")}
    # `--record` takes one recording in some commands, and a folder for many recordings in others.
    other |= {("check", "--record")}
    # `--joint` is a joint to calibrate in one command, and the position of a joint in others.
    other |= {("calibrate", "--joint")}
    spelt = {}
    for command in map(build_command, COMMANDS):
        for param in command.params:
            for name in param.opts:
                if name.startswith("--") and (command.name, name) not in other:
                    alike = (tuple(sorted(param.opts)), param.metavar, getattr(param, "is_flag", 0))
                    spelt.setdefault(name, {}).setdefault(alike, []).append(command.name)

    assert {name: ways for name, ways in spelt.items() if len(ways) > 1} == {}


def test_the_list_of_commands_cuts_no_sentence_short(tftool, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")

    listed = tftool("--help").out.partition("Learn:\n")[2].partition("Options:\n")[0]

    lines = [line for line in listed.splitlines() if line.startswith("  ")]
    assert len(lines) == len(COMMANDS)
    assert all(line.endswith(".") and "..." not in line for line in lines)


@pytest.mark.parametrize("command", COMMANDS)
def test_the_list_says_of_a_command_what_its_own_help_begins_with(tftool, command):
    summary = COMMANDS[command].partition(" (")[0].rstrip(".")

    own = tftool(command, "--help").out.partition("\n\n")[2]

    assert " ".join(own.split()).startswith(summary)


def test_the_version_says_which_build_runs(tftool):
    assert ("native" if IS_NATIVE else "pure Python") == BUILD
    assert tftool("--version").out == f"tftool {package.__version__} ({BUILD})\n"


def test_the_plain_path_can_be_asked_for():
    told = subprocess.run(
        [sys.executable, "-m", "tftool", "--version"],
        env={**os.environ, "TFTOOL_PURE": "1"},
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
        timeout=PATIENCE,
    )

    assert told.stdout == f"tftool {package.__version__} (pure Python)\n"


def test_a_near_miss_is_told_what_was_meant(tftool):
    result = tftool("monitr")

    assert result.status == 2
    assert result.out == ""
    assert "'monitr'" in result.err
    assert "Did you mean 'monitor'?" in result.err
    assert result.err.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["echo", "turtle1"], "Missing argument 'SOURCE'"),
        (["echo", "a", "b", "--rate", "often"], "'often' is not a number."),
        (["echo", "a", "b", "--domain", "x"], "'x' is not a whole number."),
        (["echo", "a", "b", "--domain", "999"], "999 is not between 0 and 232."),
        (["echo", "a", "b", "--count", "0"], "0 is less than 1."),
        (
            ["echo", "a", "b", "--precission", "2"],
            "No such option: --precission. Did you mean --precision?",
        ),
        (["echo", "a", "b", "--zzz"], "No such option: --zzz. Try"),
        (["tree", "--format", "bmp"], "'bmp' is not one of"),
        (["check", "turtles", "--run"], "Option '--run' requires an argument."),
    ],
)
def test_wrong_usage_is_one_sentence_that_says_where_help_is(tftool, words, sentence):
    result = tftool(*words)

    assert result.status == 2
    assert sentence in result.err
    assert result.err.startswith(f"tftool {words[0]}: ")
    assert f"Try 'tftool {words[0]} --help'." in result.err
    assert result.err.count("\n") == 1


@pytest.mark.parametrize(
    ("error", "status"),
    [
        (UsageError("use it so."), 2),
        (InputError("cannot be read."), 3),
        (LookupException('"\x1b[2J" is not here. '), 4),
        (NodeFailed("follower", ValueError("no")), 1),
        (TftoolError("something else."), 1),
        (TimeoutError("The arm did not answer"), 1),
    ],
)
def test_every_error_has_its_exit_status_and_nothing_in_it_acts_on_the_terminal(
    tftool, monkeypatch, error, status
):
    def fail(*_):
        raise error

    monkeypatch.setattr("tftool.commands.static.command.parse", fail)

    result = tftool("static")

    assert result.status == status
    assert result.err.rstrip("\n") == f"tftool: {str(error).rstrip()}".replace("\x1b", "␛") + (
        "." if isinstance(error, TimeoutError) else ""
    )


def test_an_interrupted_run_says_what_failed_on_its_way_out(tftool, monkeypatch):
    def fail(*_):
        raise KeyboardInterrupt from NodeFailed("arm", OSError("disk full"))

    monkeypatch.setattr("tftool.commands.static.command.parse", fail)

    result = tftool("static")

    assert result.status == 130
    assert result.err == "tftool: node 'arm' failed: OSError: disk full\n"


@pytest.mark.parametrize("command", COMMANDS)
def test_help_of_every_command_opens_with_its_words_and_keeps_its_examples(tftool, command):
    result = tftool(command, "--help")

    assert result.status == 0
    assert result.out.startswith(f"Usage: tftool {command}")
    assert f"\n  tftool {command}" in result.out
    assert "\b" not in result.out
    # The help shows neither times in nanoseconds nor the types of ranges.
    assert not re.search(r"default: \d{8}|<int range>", result.out)
    examples = [row for row in result.out.split("\n\n") if row.startswith(f"  tftool {command}")]
    assert len(examples) == 1


@pytest.mark.parametrize(("encoding", "branch"), [("ascii", "`-- odom"), ("utf-8", "└── odom")])
def test_an_encoding_without_tftools_signs_gets_plain_ones(encoding, branch):
    tree = start("tree", "robot", env={"PYTHONIOENCODING": encoding})

    out, err = tree.communicate(timeout=PATIENCE)

    assert (tree.returncode, err) == (0, "")
    assert f"\n{branch} " in out


def test_a_name_that_an_encoding_lacks_is_an_escape():
    asked = start("echo", "ä", "map", "robot", "--at", "1", env={"PYTHONIOENCODING": "ascii"})

    _, err = asked.communicate(timeout=PATIENCE)

    assert asked.returncode == 4
    assert r'"\xe4" passed to lookupTransform' in err


def imported_by(lines, heavy, file):
    """Return the heavy modules that were imported when these command lines had been run."""
    code = (
        "import sys\n"
        "from tftool.app.main import main\n"
        "for words in sys.argv[1].split(','):\n"
        "    assert main(words.split()) == 0\n"
        f"heavy = sorted({heavy!r} & set(sys.modules))\n"
        "open(sys.argv[2], 'w').write(' '.join(heavy))\n"
    )

    subprocess.run(
        [sys.executable, "-c", code, ",".join(lines), str(file)],
        cwd=ROOT,
        capture_output=True,
        check=True,
    )
    return file.read_text()


def test_no_help_imports_anything_heavy(tmp_path):
    lines = [f"{command} --help" for command in ["", *COMMANDS]]

    assert imported_by(lines, HEAVY, tmp_path / "heavy") == ""


def test_the_help_of_echo_imports_nothing_of_what_it_asks(tmp_path):
    asked = {
        "tftool.buffer.sample",
        "tftool.geometry.rigid",
        "tftool.commands.shared.connection",
        "decimal",
    }

    assert imported_by(["echo --help"], asked, tmp_path / "heavy") == ""


def test_a_scenario_that_asks_no_doctor_is_played_without_numpy(tmp_path):
    line = "echo turtle2 turtle1 turtles --at 2"

    assert imported_by([line], {"numpy", "tftool.doctor"}, tmp_path / "heavy") == ""


def test_the_tree_of_a_robot_is_drawn_without_numpy(tmp_path):
    robot = tmp_path / "arm.urdf"
    robot.write_text(
        '<robot name="arm"><link name="base"/><link name="tip"/><joint name="turn" '
        'type="continuous"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/></joint>'
        "</robot>"
    )

    assert imported_by([f"tree {robot}"], {"numpy", "asyncio", "yaml"}, tmp_path / "heavy") == ""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_quietly_with_130(number):
    with start("static", "0", "0", "3", "0", "0", "3.14", "A", "B") as process:
        # The process publishes before it prints this line, so the line shows that it runs.
        assert process.stdout.readline() == "Spinning until stopped - publishing transform\n"
        process.send_signal(number)
        _, err = process.communicate(timeout=PATIENCE)

    assert process.returncode == 130
    assert "Traceback" not in err


def test_a_signal_that_comes_when_only_the_interpreter_has_to_end_changes_nothing():
    code = (
        "import os, signal, sys\n"
        "from tftool.app.main import main\n"
        "sys.argv = ['tftool', '--version']\n"
        "class Late:\n"
        "    def __del__(self, kill=os.kill, pid=os.getpid(), number=signal.SIGINT):\n"
        "        kill(pid, number)\n"
        "main()\n"
        "sys.late = Late()\n"
        "sys.exit(130)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE
    )

    assert (done.returncode, done.stderr) == (130, "")


@pytest.mark.skipif(sys.platform == "win32", reason="needs a limit of file descriptors")
def test_too_few_file_descriptors_are_one_line():
    import resource

    def limit():
        resource.setrlimit(resource.RLIMIT_NOFILE, (16, 16))

    done = subprocess.run(
        [sys.executable, "-m", "tftool", "view"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        preexec_fn=limit,
    )

    assert done.returncode == 3
    assert len(done.stderr.splitlines()) == 1
    assert "ulimit -n" in done.stderr


def test_a_reader_that_goes_away_ends_it_quietly():
    with start("static", "--once", "--frame-id", "A", "--child-frame-id", "B") as process:
        process.stdout.close()
        err = process.stderr.read()
        process.wait(timeout=PATIENCE)

    assert process.returncode == 0
    assert "Traceback" not in err
    assert "Broken" not in err


CHATTY = """import rclpy
rclpy.init()
node = rclpy.create_node("chatty")
node.create_timer(0.05, lambda: print("tick", flush=True))
rclpy.spin(node)
"""

ELSEWHERE = """import rclpy
rclpy.init()
raise BrokenPipeError("the robot has hung up")
"""


@pytest.mark.skipif(sys.platform == "win32", reason="asks the pipe who reads it")
def test_a_reader_that_has_seen_enough_of_a_node_ends_it_quietly(tmp_path):
    (tmp_path / "chatty.py").write_text(CHATTY)
    for words in (["run", tmp_path / "chatty.py"], ["ros2", "topic", "hz", "/tf"]):
        with start(*words) as process:
            process.stdout.readline()
            process.stdout.close()
            err = process.stderr.read()
            process.wait(timeout=PATIENCE)

        assert process.returncode == 0
        assert "Broken" not in err


def test_a_pipe_of_the_nodes_own_that_breaks_is_its_failure(tmp_path):
    (tmp_path / "elsewhere.py").write_text(ELSEWHERE)
    with start("run", tmp_path / "elsewhere.py") as process:
        _, err = process.communicate(timeout=PATIENCE)

    assert process.returncode == 1
    assert "the robot has hung up" in err


def test_a_stdout_that_breaks_is_no_failure(monkeypatch):
    class Broken(io.StringIO):
        def write(self, text):
            raise BrokenPipeError

    monkeypatch.setattr(sys, "stdout", Broken())

    assert app.main(["--help"]) == 0


def test_an_interrupt_that_reaches_it_is_130(monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("tftool.commands.static.command.parse", interrupt)

    assert app.main(["static"]) == 130


def test_as_a_process_it_leaves_at_once_on_a_signal(monkeypatch, capsys):
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    left = []
    monkeypatch.setattr(sys, "argv", ["tftool", "--version"])
    monkeypatch.setattr(os, "_exit", left.append)
    try:
        assert app.main() == 0
        for number in before:
            signal.getsignal(number)(number, None)
    finally:
        gc.enable()
        for number, handler in before.items():
            signal.signal(number, handler)

    assert left == [130, 130]


@pytest.mark.parametrize(
    ("error", "sentence"),
    [
        (
            OSError(errno.ENOSPC, "No space left on device"),
            "the output cannot be written: No space left on device.",
        ),
        (
            PermissionError(errno.EACCES, "Permission denied", "x.sock"),
            "x.sock: Permission denied.",
        ),
    ],
)
def test_a_full_disk_and_its_kin_are_one_sentence(monkeypatch, capsys, error, sentence):
    class Full(io.StringIO):
        def write(self, text):
            raise error

    monkeypatch.setattr(sys, "stdout", Full())

    assert app.main(["--help"]) == 3
    assert capsys.readouterr().err == f"tftool: {sentence}\n"


def test_without_a_stdout_it_does_its_work_all_the_same(monkeypatch):
    monkeypatch.setattr(sys, "stdout", None)

    assert app.main(["--version"]) == 0
    sys.stdout.close()


@pytest.mark.parametrize("command", [name for name in COMMANDS if name != "calibrate"])
def test_help_fits_eighty_columns(tftool, monkeypatch, command):
    monkeypatch.setenv("COLUMNS", "80")

    assert max(map(len, tftool(command, "--help").out.splitlines())) <= 80


def test_help_is_painted_where_it_is_read():
    plain = main_help()
    text = painted(plain)

    assert re.sub("\x1b\\[[0-9;]*m", "", text) == plain
    assert "\x1b[1;33mOptions:\x1b[0m" in text
    assert "\x1b[36m--at SECONDS\x1b[0m" in text
    assert "\x1b[32m  tftool echo map laser\x1b[0m" in text


def main_help():
    return """Usage: tftool echo [OPTIONS]

  Say where it is.

  tftool echo map laser

Options:
  --at SECONDS  When; the latest
                if not said.
"""
