import json
from pathlib import Path
from xml.etree import ElementTree

import pytest


def test_a_healthy_scenario_has_nothing(tftool):
    result = tftool("doctor", "turtles")
    assert (result.status, result.err) == (0, "")
    assert result.out.startswith("scenario 'turtles': scenario, 60.0 s")
    assert "nothing found;" in result.out


def test_what_is_wrong_is_told_and_is_the_exit_status(tftool):
    result = tftool("doctor", "lost_leader")
    assert result.status == 1
    assert "error  edge-stopped: turtle1 in world stops before the end\n" in result.out
    assert tftool("doctor", "lost_leader", "--fail-on", "never").status == 0
    assert tftool("doctor", "lost_leader", "--ignore", "edge-stopped").status == 0
    assert tftool("doctor", "lost_leader", "--select", "shape,names").status == 0
    wide = ("--limit", "edge-stopped.seconds=100")
    assert tftool("doctor", "lost_leader", *wide).status == 0


def test_for_says_how_long_a_scenario_is_looked_at(tftool):
    # The leader is lost after five seconds.
    assert tftool("doctor", "lost_leader", "--for", "4").status == 0


def test_programs_and_issues_get_it_their_way(tftool):
    found = json.loads(tftool("doctor", "lost_leader", "--json").out)
    assert [one["id"] for one in found["findings"] if one["severity"] == "error"] == [
        "edge-stopped"
    ]
    assert found["findings"][-1]["publishers"] == ["broadcaster1"]
    assert tftool("doctor", "lost_leader", "--markdown").out.startswith("**tftool doctor** `")
    assert tftool("doctor", "turtles", "--json", "--markdown").status == 2


def test_several_sources_end_in_a_table_and_one_unreadable_stops_none(tftool, tmp_path):
    empty = tmp_path / "empty.mcap"
    empty.touch()
    report = tmp_path / "report.xml"
    result = tftool("doctor", "turtles", empty, "lost_leader", "--junit", report)
    assert result.status == 3
    assert "is an empty file" in result.err
    rows = [line.split()[:3] for line in result.out.splitlines()[-3:]]
    assert [row[0] for row in rows][::2] == ["turtles", "lost_leader"]
    assert "unreadable" in result.out
    root = ElementTree.fromstring(report.read_text(encoding="utf-8"))
    assert (root.get("failures"), root.get("errors")) == ("1", "1")


def test_without_a_source_the_session_or_the_turtles_are_examined(tftool):
    result = tftool("doctor")
    assert (result.status, result.err) == (
        0,
        "No session is running here: hosting scenario 'turtles'.\n",
    )


def test_a_check_can_be_explained_and_all_can_be_listed(tftool):
    result = tftool("doctor", "--explain", "split-tree")
    assert result.status == 0
    assert result.out.startswith("split-tree: the frames form more than one tree")
    assert "\nsplit-tree " in tftool("doctor", "--list").out


def test_the_page_of_the_checks_is_as_the_command_prints_it(tftool):
    page = Path(__file__).parents[2] / "docs" / "reference" / "checks.md"
    printed = tftool("doctor", "--list", "--markdown").out
    assert printed.count("\n### ") == 54
    assert page.read_text(encoding="utf-8") == printed


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--explain", "split-three"], "did you mean split-tree?"),
        (["turtles", "--select", "shap"], "did you mean shape?"),
        (["turtles", "--limit", "gap.second=1"], "gap has no threshold 'second'"),
        (["turtles", "--limit", "gap=1"], "write ID.NAME=VALUE"),
        (["turtles", "--limit", "gap.seconds=nan"], "write ID.NAME=VALUE"),
        (["turtles", "--limit", "gop.seconds=1"], "There is no check 'gop'"),
    ],
)
def test_a_word_that_is_none_is_refused_with_what_was_meant(tftool, words, told):
    result = tftool("doctor", *words)
    assert result.status == 2
    assert told in result.err
