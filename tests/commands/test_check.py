"""Tests of `tftool check`: status, stdout, stderr, and written files."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

ROOT = Path(__file__).resolve().parents[2]

GOOD = "duration: 2 s\nnodes: [turtlesim]\nexpect:\n  - {at: 1 s, turtles: [turtle1]}\n"
BAD = (
    "duration: 2 s\nexpect:\n"
    "  - {at: 1 s, trees: 0}\n"
    "  - {by: 2 s, distance: {from: a, to: b}, below: 1 m}\n"
)
WRONG = "duration: soon\nnodes: [turtlsim]\n"


@pytest.fixture
def scenarios(tmp_path, monkeypatch):
    """Create a folder with a true, a false and an invalid scenario, and change to it."""
    monkeypatch.chdir(tmp_path)
    for name, text in {"good": GOOD, "bad": BAD, "wrong": WRONG}.items():
        (tmp_path / f"{name}.yaml").write_text(text)
    return tmp_path


def test_a_scenario_whose_expectations_hold_ends_with_status_0(tftool, scenarios):
    result = tftool("check", "good.yaml")

    assert (result.status, result.err) == (0, "")
    assert result.out == (
        "good  ok  1 of 1 expectation held\n1 scenario, none failed: 1 of 1 expectation held\n"
    )


def test_expectations_that_hold_are_listed_with_verbose(tftool, scenarios):
    result = tftool("check", "good.yaml", "--verbose")

    shown = [line.split("  ") for line in result.out.splitlines()]
    assert [[cell.strip() for cell in line if cell] for line in shown][2:] == [
        ["good", "at 1 s: turtles are turtle1", "turtle1 at 1 s", "ok"],
        ["1 scenario, none failed: 1 of 1 expectation held"],
    ]


def test_a_failed_expectation_sets_status_1_and_shows_what_was_found_and_when(tftool, scenarios):
    result = tftool("check", "good.yaml", "bad.yaml")

    assert (result.status, result.err) == (1, "")
    shown = " ".join(result.out.split())
    assert "line 4: by 2 s: distance from a to b below 1 m found at 2 s: LookupException:" in shown
    assert shown.count("FAILED") == 1
    assert result.out.endswith("\n2 scenarios, 1 failed (bad): 2 of 3 expectations held\n")


def test_unreadable_scenarios_end_with_status_3_and_the_others_are_judged(tftool, scenarios):
    result = tftool("check", "wrong.yaml", "good.yaml", "gone.yaml")

    assert result.status == 3
    assert result.err == (
        "tftool: wrong.yaml has 2 mistakes:\n"
        "wrong.yaml:1:11: 'soon' is not a duration such as 2 s\n"
        "     1 | duration: soon\n"
        "       |           ^^^^\n"
        "wrong.yaml:2:9: there is no kind of node 'turtlsim'; did you mean 'turtlesim'?\n"
        "     2 | nodes: [turtlsim]\n"
        "       |         ^^^^^^^^\n"
        "tftool: There is no file or folder 'gone.yaml'.\n"
    )
    assert "good   ok      1 of 1 expectation held\n" in result.out
    assert result.out.endswith("\n3 scenarios, 2 failed (wrong, gone): 1 of 1 expectation held\n")


@pytest.mark.parametrize("word", ["more/*.yaml", "more", "more/"])
def test_a_glob_and_a_folder_stand_for_the_scenarios_in_them(tftool, scenarios, word):
    (scenarios / "more").mkdir()
    (scenarios / "more" / "a.yaml").write_text(GOOD)
    (scenarios / "more" / "b.yaml").write_text(BAD)
    (scenarios / "more" / "notes.txt").write_text("no scenario")

    result = tftool("check", word, "good.yaml")

    assert result.status == 1
    assert result.out.splitlines()[-1] == "3 scenarios, 1 failed (b): 3 of 4 expectations held"


def test_a_folder_without_scenarios_is_said_to_have_none_and_the_rest_is_judged(tftool, scenarios):
    (scenarios / "more").mkdir()
    (scenarios / "more" / "notes.txt").write_text("no scenario")

    result = tftool("check", "more", "good.yaml")

    assert result.status == 3
    assert result.err == "tftool: No scenario (.yaml, .yml) is in the folder 'more'.\n"
    assert result.out.endswith("\n2 scenarios, 1 failed (more): 1 of 1 expectation held\n")


def test_a_folder_does_not_hide_a_built_in_scenario(tftool, scenarios):
    (scenarios / "static").mkdir()
    (scenarios / "static" / "bad.yaml").write_text(BAD)

    assert tftool("check", "static").status == 0
    assert tftool("check", "./static").status == 1


def test_built_in_scenarios_are_known_by_name(tftool, scenarios):
    result = tftool("check", "static", "two_trees")

    assert result.status == 0
    assert "2 scenarios, none failed" in result.out


def test_a_misspelt_name_is_told(tftool, scenarios):
    result = tftool("check", "turtels")

    assert result.status == 3
    assert result.err == (
        "tftool: no scenario is named 'turtels'; did you mean 'turtles'? "
        "The path of a scenario file is also allowed.\n"
    )


@pytest.mark.parametrize(
    ("nodes", "told"),
    [
        (
            ["static: {parent: world, child: a}", "static: {parent: b, child: a}"],
            "odd.yaml:5:5: frame 'a' has two parents: 'world' (line 4) and 'b'",
        ),
        (
            ["static: {parent: a, child: b}", "static: {parent: b, child: a}"],
            "odd.yaml:5:5: the frames form a loop: the parent of 'a' is 'b', whose parent is 'a'",
        ),
        (
            ["static: {parent: turtle1, child: world}", "broadcaster: {turtle: turtle1}"],
            "odd.yaml:5:5: the frames form a loop: "
            "the parent of 'turtle1' is 'world', whose parent is 'turtle1'",
        ),
        (["static: {parent: a, child: /a}"], "odd.yaml:4:5: frame 'a' cannot be its own parent"),
    ],
)
def test_nodes_that_make_no_tree_are_told_where_they_stand(tftool, scenarios, nodes, told):
    lines = ["duration: 2 s", "nodes:", "  - turtlesim", *(f"  - {node}" for node in nodes)]
    (scenarios / "odd.yaml").write_text("\n".join([*lines, "expect: []"]))

    result = tftool("check", "odd.yaml")

    assert result.err.startswith(told)
    assert result.err.splitlines()[-1].endswith("^")


TWO_PARENTS = """\
duration: 2 s
nodes:
  - turtlesim
  - static: {parent: world, child: a}
  - static: {parent: b, child: a}
expect:
  - {at: 1 s, turtles: [turtle1]}
"""


def test_a_warning_counts_and_fails_where_that_is_asked(tftool, scenarios):
    (scenarios / "odd.yaml").write_text(TWO_PARENTS)

    result = tftool("check", "odd.yaml")
    assert result.status == 0
    assert "ok, 1 warning" in result.out
    assert result.out.endswith("1 of 1 expectation held, 1 warning\n")

    strict = tftool("check", "odd.yaml", "--strict")
    assert strict.status == 1
    assert "warnings fail (--strict):" in strict.out
    assert tftool("check", "good.yaml", "--strict").status == 0


def test_a_failing_scenario_says_first_what_the_doctor_finds(tftool, scenarios):
    (scenarios / "odd.yaml").write_text(TWO_PARENTS.replace("turtle1", "turtle2"))

    result = tftool("check", "odd.yaml")
    assert result.status == 1
    lines = [line.strip() for line in result.out.splitlines()]
    assert lines[1].startswith("why: two-parents: a changes between the parents world, b")
    assert any(line.startswith("line 7:") for line in lines[2:])

    (row,) = json.loads(tftool("check", "odd.yaml", "--json").out)
    assert row["why"][0].startswith("two-parents: ")
    assert len(row["warnings"]) == 1
    assert tftool("check", "odd.yaml", "--record", "kept").status == 1
    assert (scenarios / "kept" / "odd.mcap").exists()


NAMELESS = """\
duration: 2 s
nodes: [turtlesim]
script:
  - {at: 1 s, broadcast: {parent: a, child: a}}
expect:
  - {at: 2 s, frame: a}
"""


def test_a_failing_scenario_without_transforms_says_why_there_are_none(tftool, scenarios):
    (scenarios / "nameless.yaml").write_text(NAMELESS)
    (scenarios / "lost.yaml").write_text(GOOD.replace("[turtle1]", "[turtle2]"))

    (bad,), (nameless,), (lost,) = (
        json.loads(tftool("check", f"{name}.yaml", "--json").out)
        for name in ("bad", "nameless", "lost")
    )

    assert bad["why"] == ["no-transforms: no node sent a transform"]
    (why,) = nameless["why"]
    assert why.startswith("no-transforms: every transform was rejected: TF_SELF_TRANSFORM: ")
    # The turtles need no transform.
    assert (lost["ok"], lost["why"]) == (False, [])


JUMP = """\
duration: 4 s
nodes:
  - turtlesim
  - broadcaster: {turtle: turtle1}
script:
  - {at: 2 s, teleport: {turtle: turtle1, x: 1, y: 1}}
expect:
  - {at: 1 s, frame: nosuch}
"""


def test_a_remedy_is_printed_with_its_command(tftool, scenarios):
    (scenarios / "jump.yaml").write_text(JUMP)
    command = re.compile(r"before it: tftool echo world turtle1 RECORDING --at [0-9.]+$", re.M)

    assert command.search(tftool("check", "jump.yaml").out)
    (row,) = json.loads(tftool("check", "jump.yaml", "--json").out)
    assert command.search(row["why"][0])
    tftool("doctor", "jump.yaml", "--junit", "jump.xml")
    junit = (scenarios / "jump.xml").read_text()
    assert re.search(r"before it: tftool echo [^;:]+; after it: tftool echo [^;:]+<", junit)
    tftool("doctor", "jump.yaml", "--sarif", "jump.sarif")
    (result,) = json.loads((scenarios / "jump.sarif").read_text())["runs"][0]["results"]
    assert command.search(result["message"]["text"])


def test_frames_of_one_parent_each_are_not_told(tftool, scenarios):
    nodes = ["fixed_carrot", "fixed_carrot: {name: again}", "broadcaster: {turtle: turtle1}"]
    lines = ["duration: 2 s", "nodes:", "  - turtlesim", *(f"  - {node}" for node in nodes)]
    (scenarios / "even.yaml").write_text("\n".join([*lines, "expect: []"]))

    assert tftool("check", "even.yaml").err == ""


def test_json_is_for_programs(tftool, scenarios):
    result = tftool("check", "good.yaml", "bad.yaml", "--json")

    rows = json.loads(result.out)
    assert result.status == 1
    assert [(row["scenario"], row["file"], row["ok"]) for row in rows] == [
        ("good", "good.yaml", True),
        ("bad", "bad.yaml", False),
    ]
    assert rows[1]["expectations"][1]["expected"] == "below 1 m"
    assert rows[1]["expectations"][1]["at"] == 2.0


def test_junit_is_for_build_servers(tftool, scenarios):
    result = tftool("check", "good.yaml", "bad.yaml", "wrong.yaml", "--junit", "report.xml")

    root = ElementTree.parse(scenarios / "report.xml").getroot()
    assert result.status == 3
    assert (root.attrib["tests"], root.attrib["failures"], root.attrib["errors"]) == ("4", "1", "1")


def test_a_report_goes_to_no_file_called_dash(tftool, scenarios):
    result = tftool("check", "good.yaml", "--junit", "-")

    assert result.status == 2
    assert "'-' means stdout" in result.err
    assert not (scenarios / "-").exists()


def test_a_report_that_cannot_be_written_is_told(tftool, scenarios):
    result = tftool("check", "good.yaml", "--junit", "no/such/folder.xml")

    assert result.status == 3
    assert "1 of 1 expectation held" in result.out
    assert result.err == (
        "tftool: 'no/such/folder.xml' cannot be written: there is no folder 'no/such'.\n"
    )


def test_names_from_strangers_do_nothing_on_the_terminal(tftool, scenarios):
    (scenarios / "[bold]x.yaml").write_text('duration: 1 s\nexpect: [{at: 1 s, frame: "[red]a"}]\n')

    result = tftool("check", "[bold]x.yaml")

    assert result.status == 1
    assert "[bold]x" in result.out
    assert "frame [red]a exists" in result.out


def test_without_a_scenario_it_says_how_it_is_used(tftool):
    result = tftool("check")

    assert result.status == 2
    assert "no scenario is given: write a name or a file, or a package" in result.err


def test_a_reader_that_has_seen_enough_is_no_failure(scenarios):
    command = [sys.executable, "-m", "tftool", "check", "turtles", "static", "robot"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment
    ) as running:
        running.stdout.close()
        told = running.stderr.read()

    assert (running.returncode, told) == (0, b"")
