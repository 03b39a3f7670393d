"""Tests of the GitHub action and of the hooks for pre-commit, run as their users run them."""

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml

from tftool.app.index import COMMANDS

ROOT = Path(__file__).parents[2]
ACTION = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
HOOKS = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
BODY = ACTION["runs"]["steps"][-1]

URDF = """<robot name="r"><link name="base"/><link name="laser"/><joint name="j" type="fixed">
<parent link="base"/><child link="{child}"/></joint></robot>"""

LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node
def generate_launch_description():
    return LaunchDescription([Node(package='tf2_ros', executable='static_transform_publisher',
        arguments=['0', '0', '{height}', '0', '0', '0', 'a', 'b'])])
"""


@pytest.fixture
def act(tmp_path):
    """Return a function that runs the last step of the action with inputs, as a runner does."""
    python = tmp_path / "temp" / "tftool" / "bin" / "python"
    python.parent.mkdir(parents=True)
    python.write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} "$@"\n')
    python.chmod(0o755)

    def run(**inputs):
        given = {name: one.get("default", "") for name, one in ACTION["inputs"].items()}
        given |= {name.replace("_", "-"): text for name, text in inputs.items()}
        variables = {
            name: re.sub(r"\$\{\{ inputs\.([\w-]+) \}\}", lambda m: given[m[1]], text)
            for name, text in BODY["env"].items()
        }
        runner = {
            "RUNNER_TEMP": str(tmp_path / "temp"),
            "GITHUB_ACTION_PATH": str(ROOT),
            "GITHUB_STEP_SUMMARY": str(tmp_path / "summary.md"),
        }
        return subprocess.run(
            ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", BODY["run"]],
            env={**os.environ, **runner, **variables},
            cwd=tmp_path,
            capture_output=True,
            text=True,
            check=False,
        )

    return run


def test_the_action_runs_what_was_asked_for_and_ends_with_the_worst_status(act, tmp_path):
    done = act(doctor="lost_leader", diff="turtles turtles\nturtles carrot", check="static")

    assert done.returncode == 1
    reports = tmp_path / "tftool-reports"
    results = json.loads((reports / "doctor.sarif").read_text())["runs"][0]["results"]
    assert [one["ruleId"] for one in results] == ["edge-stopped"]
    assert ElementTree.parse(reports / "doctor.xml").getroot().get("failures") == "1"
    assert ElementTree.parse(reports / "check.xml").getroot().get("failures") == "0"
    summary = (tmp_path / "summary.md").read_text()
    assert [line for line in summary.splitlines() if line.startswith("$ ")] == [
        "$ tftool doctor lost_leader --fail-on warning --sarif tftool-reports/doctor.sarif "
        "--junit tftool-reports/doctor.xml",
        "$ tftool diff turtles turtles",
        "$ tftool diff turtles carrot",
        "$ tftool check static --junit tftool-reports/check.xml --record tftool-reports/failed",
    ]
    failed = [line for line in done.stdout.splitlines() if line.startswith("::error")]
    assert [re.match(r"::error title=tftool (\w+)", line)[1] for line in failed] == [
        "doctor",
        "diff",
    ]


def test_the_action_passes_where_nothing_is_wrong(act):
    assert act(doctor="lost_leader", fail_on="never").returncode == 0


def test_a_finding_of_the_baseline_does_not_fail_and_is_suppressed_in_the_report(act, tmp_path):
    words = [sys.executable, "-m", "tftool", "doctor", "lost_leader", "--json"]
    accepted = subprocess.run(words, capture_output=True, check=False).stdout
    (tmp_path / "accepted.json").write_bytes(accepted)

    assert act(doctor="lost_leader", baseline="accepted.json").returncode == 0

    report = (tmp_path / "tftool-reports" / "doctor.sarif").read_text()
    (result,) = json.loads(report)["runs"][0]["results"]
    assert result["suppressions"] == [{"kind": "external", "status": "accepted"}]


def test_an_unreadable_recording_has_its_own_status(act):
    assert act(doctor="nowhere.mcap", check="static").returncode == 3


@pytest.mark.parametrize(
    ("inputs", "told"), [({}, "at least one of"), ({"check": "'a"}, "No closing quotation")]
)
def test_inputs_that_make_no_command_are_refused(act, inputs, told):
    done = act(**inputs)

    assert done.returncode == 2
    assert told in done.stdout


def test_no_input_is_code(act, tmp_path):
    act(check="$(touch made) `touch made`; touch made")

    assert not (tmp_path / "made").exists()
    # The texts of the steps contain no expression either: the runner would paste its value into the
    # shell's code.
    assert not any("${{" in step.get("run", "") for step in ACTION["runs"]["steps"])


def test_every_hook_runs_a_command():
    assert all(hook["entry"].split()[0] == "tftool" for hook in HOOKS)
    assert {hook["entry"].split()[1] for hook in HOOKS} <= set(COMMANDS)


@pytest.mark.parametrize(
    ("hook", "name", "text", "wrong"),
    [
        ("tftool-descriptions", "urdf/r.urdf", URDF.format(child="laser"), URDF.format(child="b")),
        (
            "tftool-statics",
            "launch/mounts.launch.py",
            LAUNCH.format(height="0.2"),
            LAUNCH.format(height="0,2"),
        ),
        (
            "tftool-descriptions",
            "urdf/r.urdf",
            URDF.format(child="laser"),
            URDF.format(child="laser").replace("</joint>", '<origin rpy="0 0 90"/></joint>'),
        ),
        (
            "tftool-statics",
            "launch/mounts.launch.py",
            LAUNCH.format(height="0.2"),
            LAUNCH.format(height="0.2").replace("'0', 'a'", "'90', 'a'"),
        ),
        (
            "tftool-scenarios",
            "scenarios/a.yaml",
            "duration: 1 s\nnodes: [static: {parent: a, child: b}]\nexpect:\n"
            "  - {at: 1 s, lookup: {target: a, source: b}}\n",
            "duration: 1 s\nnodes: [static: {parent: a, child: b}]\nexpect:\n"
            "  - {at: 1 s, lookup: {target: a, source: c}}\n",
        ),
    ],
)
def test_a_hook_takes_its_files_and_stops_a_mistake(tmp_path, hook, name, text, wrong):
    (found,) = (one for one in HOOKS if one["id"] == hook)
    assert re.search(found["files"], name)
    statuses = []
    for number, content in enumerate((text, text, wrong)):
        file = tmp_path / str(number) / name
        file.parent.mkdir(parents=True)
        file.write_text(content)
    for numbers in ((0, 1), (0, 1, 2)):
        files = [str(tmp_path / str(number) / name) for number in numbers]
        words = [sys.executable, "-m", *found["entry"].split(), *files]
        statuses.append(subprocess.run(words, capture_output=True, check=False).returncode)
    assert statuses[0] == 0
    assert statuses[1] != 0
