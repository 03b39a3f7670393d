"""Tests of results of scenarios as a table, as rows and as a JUnit report."""

import io
from xml.etree import ElementTree

from rich.console import Console

from tftool.base.report import Judgement, Report
from tftool.drawing import report_view as judgements

GOOD = Report(
    "turtles",
    "scenarios/turtles.yaml",
    (Judgement("at 3 s: number of trees is 1", True, "is 1", "1", 3.0, 7),),
    lasted=60.0,
)
BAD = Report(
    "own",
    "own.yaml",
    (
        Judgement("by 9 s: distance from a to b below 1 m", False, "below 1 m", "2 m", 9.0, 4),
        Judgement("at 50 s: number of trees is 1", False, "is 1", "not reached", None, 5),
    ),
    lasted=10.0,
    failure="node 'script' failed: TftoolError: no node serves 'clear'\nand more",
)
EMPTY = Report("empty", "empty.yaml", ())
NASTY = Report(
    "[bold]<x>&\x1b[31m",
    'a"b.yaml',
    (Judgement("at 1 s: frame [red]x[/red]\x00\ud800 exists", False, "]]>", "<&\x1b", 1.0, 1),),
)


def text(*reports, width=90, render=judgements.render_all):
    """Return the text on a terminal of that width without colour."""
    console = Console(file=io.StringIO(), width=width, color_system=None)
    console.print(render(reports))
    return console.file.getvalue()


def brief(*reports, width=90):
    """Return the same text with only the failures in full."""
    return [
        line.rstrip() for line in text(*reports, width=width, render=judgements.render).split("\n")
    ]


def test_a_scenario_is_one_line_and_only_what_failed_is_told_in_full():
    assert brief(GOOD, BAD, EMPTY) == [
        "turtles  ok      1 of 1 expectation held",
        "own      FAILED  0 of 2 expectations held",
        # The cause comes first: the expectation fails because of it.
        "                 node 'script' failed: TftoolError: no node serves 'clear'",
        "                 and more",
        "                 line 4: by 9 s: distance from a to b below 1 m",
        "                   found at 9 s: 2 m",
        "                 line 5: at 50 s: number of trees is 1",
        "                   found: not reached",
        "empty    ok      nothing is expected",
        "",
    ]


def test_the_brief_report_of_an_unreadable_scenario_has_no_count_of_expectations():
    unreadable = Report("own", "own.yaml", (), failure="own.yaml has 2 mistakes:\nand more")

    assert brief(unreadable) == ["own  FAILED  own.yaml has 2 mistakes", ""]


def test_few_words_fit_into_a_narrow_terminal_too():
    shown = brief(GOOD, BAD, NASTY, width=40)

    assert all(len(line) <= 40 for line in shown)
    assert "\x1b" not in "".join(shown)


def test_the_table_shows_what_was_expected_found_and_when():
    rows = [line.split("  ") for line in text(GOOD, BAD, EMPTY, width=130).splitlines()]
    cells = [[cell.strip() for cell in row if cell.strip()] for row in rows]

    assert cells[0] == ["scenario", "expected", "found"]
    assert cells[2:] == [
        ["turtles", "at 3 s: number of trees is 1", "1 at 3 s", "ok"],
        [],
        ["own", "node 'script' failed: TftoolError: no node serves 'clear'", "FAILED"],
        ["by 9 s: distance from a to b below 1 m", "2 m at 9 s", "FAILED"],
        ["at 50 s: number of trees is 1", "not reached", "FAILED"],
        [],
        ["empty", "nothing", "ok"],
    ]


def test_the_table_fits_into_a_narrow_terminal_and_loses_nothing():
    shown = text(GOOD, BAD, width=60)

    assert all(len(line) <= 60 for line in shown.splitlines())
    assert "".join(shown.split()).count("FAILED") == 3


def test_names_from_strangers_do_nothing_in_the_table():
    shown = text(NASTY, width=140)

    assert "[bold]<x>&␛[31m" in shown
    assert "frame [red]x[/red]␀" in shown
    assert "\x1b" not in shown


def test_the_summary_is_one_sentence():
    assert judgements.summary([GOOD]) == "1 scenario, none failed: 1 of 1 expectation held"
    assert judgements.summary([GOOD, BAD, EMPTY]) == (
        "3 scenarios, 1 failed (own): 1 of 3 expectations held"
    )


def test_rows_hold_the_facts_as_they_are():
    assert judgements.as_rows([GOOD, NASTY]) == [
        {
            "scenario": "turtles",
            "file": "scenarios/turtles.yaml",
            "ok": True,
            "lasted": 60.0,
            "failure": "",
            "warnings": [],
            "why": [],
            "expectations": [
                {
                    "expectation": "at 3 s: number of trees is 1",
                    "line": 7,
                    "ok": True,
                    "expected": "is 1",
                    "found": "1",
                    "at": 3.0,
                }
            ],
        },
        {
            "scenario": "[bold]<x>&\x1b[31m",
            "file": 'a"b.yaml',
            "ok": False,
            "lasted": 0.0,
            "failure": "",
            "warnings": [],
            "why": [],
            "expectations": [
                {
                    "expectation": "at 1 s: frame [red]x[/red]\x00\ud800 exists",
                    "line": 1,
                    "ok": False,
                    "expected": "]]>",
                    "found": "<&\x1b",
                    "at": 1.0,
                }
            ],
        },
    ]


def test_the_junit_report_counts_and_tells():
    root = ElementTree.fromstring(judgements.as_junit([GOOD, BAD, EMPTY]))

    assert root.attrib == {
        "name": "tftool check",
        "tests": "5",
        "failures": "2",
        "errors": "1",
    }
    good, bad, empty = root
    assert good.attrib == {
        "name": "turtles",
        "time": "60.000",
        "tests": "1",
        "failures": "0",
        "errors": "0",
    }
    assert good[0].attrib == {
        "classname": "turtles",
        "name": "at 3 s: number of trees is 1",
        "file": "scenarios/turtles.yaml",
        "time": "3.000",
    }
    assert bad[0][0].tag == "failure"
    assert bad[0][0].attrib == {"message": "expected below 1 m, found 2 m at 9 s"}
    assert bad[0][0].text == "own.yaml:4: expected below 1 m, found 2 m at 9 s"
    assert bad[2][0].tag == "error"
    assert bad[2][0].attrib == {
        "message": "node 'script' failed: TftoolError: no node serves 'clear'"
    }
    assert bad[2][0].text.endswith("\nand more")
    assert empty[0].attrib["name"] == "plays to its end"


def test_the_junit_report_is_well_formed_whatever_the_names():
    written = judgements.as_junit([NASTY]).encode("utf-8")

    suite = ElementTree.fromstring(written)[0]

    assert suite.attrib["name"] == "[bold]<x>&␛[31m"
    assert suite[0].attrib["file"] == 'a"b.yaml'
    assert suite[0][0].text == 'a"b.yaml:1: expected ]]>, found <&␛ at 1 s'
