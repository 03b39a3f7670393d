"""Tests of the completions that the shell offers when Tab is pressed."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import tftool as library
from tests.terminals import Terminal
from tftool.app import completion
from tftool.app.index import COMMANDS


@pytest.fixture
def offered(tftool, monkeypatch):
    """Return a function that returns the completions for words; the last word is being typed."""

    def ask(*words, shell="bash"):
        monkeypatch.setenv(completion.VARIABLE, shell)
        result = tftool(*words)
        assert (result.status, result.err) == (0, "")
        return result.out.splitlines()

    return ask


def test_commands_come_first_and_options_with_a_dash(offered):
    assert offered("") == list(COMMANDS)
    assert offered("ec") == ["echo"]
    assert offered("--v") == ["--version"]
    assert offered() == list(COMMANDS)


def test_help_takes_a_command(offered):
    assert offered("help", "mon") == ["monitor"]


def test_options_of_a_command_are_offered_by_their_long_names(offered):
    found = offered("echo", "a", "b", "--")

    assert {"--once", "--at", "--precision", "--domain"} <= set(found)
    assert all(word.startswith("--") for word in found)


def test_a_value_that_is_one_of_a_few_is_offered(offered):
    assert offered("doctor", "--fail-on", "") == ["error", "warning", "note", "never"]


def test_words_of_ros_2_and_ids_of_checks_are_offered(offered):
    assert offered("ros2", "to") == ["topic"]
    assert offered("ros2", "topic", "e") == ["echo"]
    assert offered("ros2", "topik", "") == offered("ros2", "topic", "echo", "") == []
    assert "loop\t" in offered("doctor", "--explain", "loo", shell="fish")[0]
    assert offered("doctor", "--select", "split") == ["split-tree"]
    assert offered("new", "here", "--example", "ti") == ["time_travel"]


def test_scenarios_are_offered_where_one_may_stand_and_again_where_several_may(offered):
    assert offered("demo", "tur") == ["turtles"]
    assert offered("check", "turtles", "carr") == ["carrot"]
    assert offered("echo", "map", "laser_link", "rob") == ["robot"]


def test_frames_are_those_that_living_processes_listed(offered, tmp_path, monkeypatch):
    monkeypatch.setattr(
        "tftool.world.link.zenoh.rendezvous.frames_known", lambda domain: FRAMES[domain]
    )

    assert offered("echo", "") == ["base_link", "map"]
    assert offered("echo", "map", "ba") == ["base_link"]
    assert offered("explain", "--domain", "7", "la") == ["laser"]


FRAMES = {0: ["base_link", "map", "two words", "$(reboot)", "a\x1b[2J"], 7: ["laser"]}


def test_packages_and_their_nodes_and_launch_files_are_offered(
    offered, tftool, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    tftool("new", "chase", "--example", "carrot")

    assert offered("run", "ch") == ["chase"]
    assert offered("run", "chase", "fixed") == ["fixed_carrot"]
    assert offered("launch", "chase", "") == ["carrot.launch.py"]


def test_completion_of_an_unknown_command_or_after_a_bad_value_is_empty(offered):
    assert offered("nonsense", "") == []
    assert offered("echo", "--domain", "x", "") == []


def test_each_shell_gets_what_it_understands(offered):
    assert offered("ech", shell="bash") == ["echo"]
    assert offered("ech", shell="fish") == [f"echo\t{COMMANDS['echo']}"]
    assert offered("ech", shell="zsh") == [f"echo:{COMMANDS['echo']}"]


@pytest.mark.parametrize(("shell", "start"), [("bash", ".bashrc"), ("zsh", ".zshrc")])
def test_it_is_installed_once_and_leaves_the_rest_of_a_start_file_alone(
    tftool, tmp_path, monkeypatch, shell, start
):
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("SHELL", f"/bin/{shell}")
    monkeypatch.delenv("XDG_DATA_HOME", raising=False)
    (tmp_path / start).write_text("alias ll='ls -l'")

    first, second = tftool("--install-completion"), tftool("--install-completion")

    assert (first.status, second.status) == (0, 0)
    lines = (tmp_path / start).read_text().splitlines()
    assert lines[0] == "alias ll='ls -l'"
    assert len(lines) == 2
    script = tmp_path / ".local" / "share" / "tftool" / f"completion.{shell}"
    assert str(script) in lines[1]
    assert script.read_text() == tftool("--show-completion").out


@pytest.fixture
def homeless(monkeypatch):
    """Remove the user's home, as for a user that a service or a container creates."""

    def none():
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.setattr(Path, "home", none)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)


def test_where_there_is_no_home_there_is_a_sentence(tftool, homeless, monkeypatch):
    monkeypatch.setenv("SHELL", "/bin/bash")

    result = tftool("--install-completion")

    assert result.status == 3
    assert "HOME is not set" in result.err


def test_a_recording_is_read_and_completed_where_there_is_no_home(
    homeless, tmp_path, tftool, offered
):
    run = tmp_path / "run.mcap"
    with library.write_recording(run) as recording:
        recording.transforms([library.TransformStamped(1, "map", "car", library.Transform())])

    assert tftool("info", str(run)).status == 0
    assert offered("echo", str(run), "") == ["car", "map"]


def test_a_user_that_is_none_stands_for_no_recording(offered, monkeypatch):
    monkeypatch.setattr("tftool.world.link.zenoh.rendezvous.frames_known", lambda domain: ["world"])

    assert offered("echo", "~nobody_of_that_name/run.mcap", "") == ["world"]


def test_fish_has_a_folder_for_it(tftool, tmp_path, monkeypatch):
    monkeypatch.setenv("SHELL", "/usr/bin/fish")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))

    assert tftool("--install-completion").status == 0
    assert (tmp_path / "fish" / "completions" / "tftool.fish").is_file()


@pytest.mark.parametrize("shell", ["", "/bin/tcsh"])
def test_another_shell_is_told_which_there_are(tftool, monkeypatch, shell):
    monkeypatch.setenv("SHELL", shell)

    result = tftool("--install-completion")

    assert result.status == 2
    assert "bash, zsh, fish" in result.err


@pytest.mark.skipif(sys.platform == "win32", reason="bash")
def test_bash_takes_the_script_and_completes_with_it(tmp_path):
    # The steps of Tab without a terminal: split the words as bash does, then call the function.
    (tmp_path / "tftool").write_text(f'#!/bin/sh\nexec "{sys.executable}" -m tftool "$@"\n')
    (tmp_path / "tftool").chmod(0o755)
    lines = f"""
{completion.SCRIPTS["bash"]}
PATH="{tmp_path}:$PATH"
COMP_WORDS=(tftool check tur); COMP_CWORD=2
_tftool
echo "${{COMPREPLY[*]}}"
"""
    done = subprocess.run(["bash", "-c", lines], capture_output=True, text=True, check=True)

    assert done.stdout == "turtles\n"


@pytest.fixture
def recorded(tftool, tmp_path, monkeypatch):
    """Record the scenario `robot` to a file in the current folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    result = tftool("export", "robot", "-o", "run.mcap")
    assert result.status == 0, result.err
    return tmp_path / "run.mcap"


def test_frames_are_those_of_a_recording_named_behind_or_before(offered, recorded, monkeypatch):
    monkeypatch.setenv(completion.BEHIND, "run.mcap")
    assert offered("echo", "") == ["base_link", "laser_link", "laser_point", "map", "odom"]
    assert offered("echo", "map", "laser_") == ["laser_link", "laser_point"]

    monkeypatch.setenv(completion.BEHIND, "")
    assert offered("echo", "map", "odom", "run.mcap", "--fixed-frame", "o") == ["odom"]


def test_frames_of_a_large_recording_come_from_its_kept_columns_alone(
    offered, recorded, monkeypatch
):
    from tftool.recordings import cache_heads
    from tftool.recordings import column_cache as cache
    from tftool.recordings.find import find
    from tftool.recordings.recording import open_recording

    monkeypatch.setattr(cache_heads, "WORTHWHILE", 0)
    monkeypatch.setenv(completion.BEHIND, "run.mcap")
    assert offered("echo", "") == []
    with open_recording("run.mcap") as recording:
        transforms = recording.transforms
    kept = cache.ColumnCache(cache_heads.default_folder())
    assert kept.store(cache_heads.key_of(find("run.mcap")), transforms)
    assert offered("echo", "l") == ["laser_link", "laser_point"]

    (entry,) = cache_heads.default_folder().glob("*.columns")
    entry.write_bytes(entry.read_bytes()[:40])
    assert offered("echo", "l") == []


def test_a_short_recording_is_read_once_and_again_when_it_changes(
    offered, tftool, recorded, monkeypatch
):
    from tftool.recordings import cache_heads

    assert tftool("export", "turtles", "-o", "other.mcap").status == 0
    monkeypatch.setenv(completion.BEHIND, "run.mcap")
    assert offered("echo", "l") == ["laser_link", "laser_point"]
    assert len(list(cache_heads.default_folder().glob("*.columns"))) == 1

    with monkeypatch.context() as closed:
        closed.setattr("tftool.recordings.recording.open_recording", None)
        assert offered("echo", "l") == ["laser_link", "laser_point"]

    recorded.with_name("other.mcap").replace(recorded)
    assert offered("echo", "") == ["turtle1", "turtle2", "world"]


def test_frames_of_a_description_are_its_links(offered, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("arm.urdf").write_text(
        '<robot name="arm"><link name="base"/><link name="hand"/><joint name="j" type="fixed">'
        '<parent link="base"/><child link="hand"/></joint></robot>'
    )
    monkeypatch.setenv(completion.BEHIND, "arm.urdf")

    assert offered("echo", "") == ["base", "hand"]


def test_a_file_without_frames_offers_nothing(offered, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("notes.txt").write_text("no frames")
    monkeypatch.setenv(completion.BEHIND, "notes.txt")
    monkeypatch.setattr(
        "tftool.world.link.zenoh.rendezvous.frames_known", lambda domain: FRAMES[domain]
    )

    assert offered("echo", "ma") == ["map"]


@pytest.mark.skipif(shutil.which("tmux") is None, reason="needs tmux")
@pytest.mark.parametrize(
    ("shell", "options"),
    [("bash", ["--norc", "-i"]), ("zsh", ["-f", "-i"]), ("fish", ["--no-config", "-i"])],
)
def test_tab_completes_in_a_real_shell(tmp_path, recorded, shell, options):
    if shutil.which(shell) is None:
        pytest.skip(f"the shell {shell} is not installed")
    (tmp_path / "tftool").write_text(f'#!/bin/sh\nexec "{sys.executable}" -m tftool "$@"\n')
    (tmp_path / "tftool").chmod(0o755)
    (tmp_path / "script").write_text(completion.SCRIPTS[shell])
    run = f"import os; os.execvp({shell!r}, [{shell!r}, *{options!r}])"
    path = f"{tmp_path}:{os.environ['PATH']}"
    terminal = Terminal(tmp_path, 80, 24, ("-c", run), {"PATH": path, "HOME": str(tmp_path)})
    try:
        terminal.press(f'cd "{tmp_path}"; source ./script; clear; echo rea""dy', "Enter")
        terminal.until(lambda screen: screen.startswith("ready"), "ready")
        terminal.press("tftool che", "Tab")
        terminal.shows("tftool check")
        terminal.press("tur", "Tab")
        terminal.shows("tftool check turtles")
        # The completed frame is in the recording that the line names after the cursor. fish does
        # not pass words after the cursor to completions.
        if shell != "fish":
            terminal.press(" && tftool echo b run.mcap", *["Left"] * len(" run.mcap"), "Tab")
            terminal.shows("tftool echo base_link")
    finally:
        terminal.tmux("kill-server")
