"""Tests of YAML files that expand to too much data, with every command that reads YAML."""

import pytest

from tests.base.test_yaml_guard import BOMB, MERGES


@pytest.mark.parametrize("text", [BOMB, MERGES, "[" * 5000, "&a [*a]", "/n: {p: !!timestamp x}"])
def test_no_file_of_yaml_stops_the_command_that_reads_it(tftool, tmp_path, text, monkeypatch):
    monkeypatch.delenv("ROS_DISTRO", raising=False)
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    file = tmp_path / "given.launch.yaml"
    file.write_text(text)
    node = tmp_path / "node.py"
    node.write_text("")

    words = ["run", "--host", node, "--ros-args", "--params-file", file]
    results = [tftool("launch", file, "--show-args"), tftool("check", file), tftool(*words)]

    assert [result.status for result in results] == [3, 3, 3]
    assert all(str(file) in result.err for result in results)
