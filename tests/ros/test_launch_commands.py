"""Tests of system commands in launch files on simulated time."""

import pytest

from tests.ros.test_launch import described
from tests.ros.tutorial import launch
from tftool.base.errors import NodeFailed


def test_a_command_that_cannot_be_run_does_not_end_the_launch(tmp_path):
    done = described(
        tmp_path, "ExecuteProcess(cmd=['no-such-command'])", "ExecuteProcess(cmd=['echo', 'hi'])"
    )

    assert done.failed == ["no-such-command-1"]
    (died,) = done.said("no-such-command-1")[-1:]
    assert "cannot run 'no-such-command': No such file or directory" in died
    assert "hi" in done.said("echo-2")


def test_a_command_in_a_missing_folder_is_told_with_the_folder(tmp_path):
    done = described(tmp_path, "ExecuteProcess(cmd=['env'], cwd='/nonexistent')")

    assert "cannot run 'env': No such file or directory '/nonexistent'" in done.said("env-1")[-1]


def test_a_command_is_started_again_at_most_as_often_as_allowed(tmp_path):
    done = described(
        tmp_path,
        "ExecuteProcess(cmd=['echo', 'hi'], respawn=True, respawn_delay=0.5, "
        "respawn_max_retries=2, on_exit=[LogInfo(msg='ended')])",
        seconds=30.0,
    )

    assert done.said("echo-1").count("hi") == 3
    assert done.said("launch").count("ended") == 3
    assert done.elapsed == 1.0


def test_a_command_does_not_read_the_input_of_the_launch(tmp_path, monkeypatch):
    monkeypatch.setattr("tftool.ros.launch.commands.LONGEST_HOLD", 0.1)
    done = described(tmp_path, "ExecuteProcess(cmd=['cat'])", seconds=0.1)

    # Without an end of its input, the command waits until the launch ends it.
    assert "cat-1 has not ended after 0.1 s" in " ".join(done.said("launch"))


def test_a_command_that_ends_soon_takes_no_simulated_time(tmp_path):
    done = described(
        tmp_path,
        "ExecuteProcess(cmd=['sleep', '0.2'], on_exit=[Shutdown(reason='over')])",
        seconds=60.0,
    )

    assert done.elapsed == 0.0


def test_a_command_that_goes_on_lets_simulated_time_pass_after_a_while(tmp_path, monkeypatch):
    monkeypatch.setattr("tftool.ros.launch.commands.LONGEST_HOLD", 0.1)
    done = described(
        tmp_path,
        "ExecuteProcess(cmd=['sleep', '1000'])",
        "TimerAction(period=0.2, actions=[Shutdown(reason='over')])",
        seconds=60.0,
    )

    assert any("sleep-1 has not ended after 0.1 s" in text for text in done.said("launch"))
    assert "shutting down: over" in done.said("launch")
    assert done.elapsed < 60.0


def test_an_interrupted_launch_does_not_wait_for_its_command(tmp_path):
    file = tmp_path / "some.launch.py"
    file.write_text(
        "import asyncio\nimport threading\n"
        "from launch import LaunchDescription\n"
        "from launch.actions import ExecuteProcess, OpaqueFunction\n"
        "def interrupt(context):\n"
        "    loop, end = asyncio.get_running_loop(), context.launch.interrupt\n"
        "    threading.Timer(0.3, lambda: loop.call_soon_threadsafe(end)).start()\n"
        "def generate_launch_description():\n"
        "    return LaunchDescription([\n"
        "        ExecuteProcess(cmd=['sleep', '1000']), OpaqueFunction(function=interrupt)])\n"
    )
    done = launch(file, seconds=60)

    assert done.said("sleep-1")[-1] == "process has finished cleanly"
    assert not any("has not ended" in text for text in done.said("launch"))


def test_a_command_for_a_text_has_a_time_limit(tmp_path, monkeypatch):
    monkeypatch.setattr("tftool.ros.launch.commands.LONGEST_RUN", 0.3)
    with pytest.raises(NodeFailed, match=r"'sleep', '30'\] had not ended after 0.3 s"):
        described(tmp_path, "LogInfo(msg=Command('sleep 30'))")
