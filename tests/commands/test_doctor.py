import json
from pathlib import Path
from xml.etree import ElementTree

import pytest


def test_a_healthy_scenario_has_nothing(tftool):
    result = tftool("doctor", "turtles")
    assert (result.status, result.err) == (0, "")
    assert result.out.startswith("scenario 'turtles': scenario, 60.0 s")
    assert "nothing found;" in result.out


def test_an_error_is_reported_with_status_1_unless_options_allow_it(tftool):
    result = tftool("doctor", "lost_leader")
    assert result.status == 1
    assert "error  edge-stopped: turtle1 in world stops before the end\n" in result.out
    assert tftool("doctor", "lost_leader", "--fail-on", "never").status == 0
    assert tftool("doctor", "lost_leader", "--ignore", "edge-stopped").status == 0
    assert tftool("doctor", "lost_leader", "--select", "shape,names").status == 0
    wide = ("--limit", "edge-stopped.seconds=100")
    assert tftool("doctor", "lost_leader", *wide).status == 0


def test_for_says_how_long_a_scenario_is_looked_at(tftool):
    # The leader disappears after five seconds.
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
    sarif = tmp_path / "report.sarif"
    result = tftool("doctor", "turtles", empty, "lost_leader", "--junit", report, "--sarif", sarif)
    assert result.status == 3
    assert "is an empty file" in result.err
    rows = [line.split()[:3] for line in result.out.splitlines()[-3:]]
    assert [row[0] for row in rows][::2] == ["turtles", "lost_leader"]
    assert "unreadable" in result.out
    root = ElementTree.fromstring(report.read_text(encoding="utf-8"))
    assert (root.get("failures"), root.get("errors")) == ("1", "1")
    run = json.loads(sarif.read_text(encoding="utf-8"))["runs"][0]
    assert [one["ruleId"] for one in run["results"]] == ["edge-stopped"]
    assert not run["invocations"][0]["executionSuccessful"]
    assert tftool("doctor", "turtles", "-o", tmp_path / "a.csv", "--sarif", sarif).status == 2


def test_without_a_source_the_session_or_the_turtles_are_examined(tftool):
    result = tftool("doctor")
    assert (result.status, result.err) == (
        0,
        "No session is running here: hosting scenario 'turtles'.\n",
    )


def test_a_check_can_be_explained_and_all_can_be_listed(tftool):
    result = tftool("doctor", "--explain", "split-tree")
    assert result.status == 0
    assert result.out.startswith("split-tree: the frames form several trees")
    assert "\nsplit-tree " in tftool("doctor", "--list").out


def test_the_page_of_the_checks_is_as_the_command_prints_it(tftool):
    page = Path(__file__).parents[2] / "docs" / "reference" / "checks.md"
    printed = tftool("doctor", "--list", "--markdown").out
    assert printed.count("\n### ") == 74
    assert page.read_text(encoding="utf-8") == printed


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--explain", "split-three"], "did you mean split-tree?"),
        (["turtles", "--select", "shap"], "did you mean shape?"),
        (["turtles", "--limit", "gap.second=1"], "gap has no threshold 'second'"),
        (["turtles", "--limit", "gap=1"], "takes ID.NAME=VALUE"),
        (["turtles", "--limit", "gap.seconds=nan"], "takes ID.NAME=VALUE"),
        (["turtles", "--limit", "gop.seconds=1"], "There is no check 'gop'"),
    ],
)
def test_a_word_that_is_none_is_refused_with_what_was_meant(tftool, words, told):
    result = tftool("doctor", *words)
    assert result.status == 2
    assert told in result.err


TWO_PARENTS = """
duration: 8 s
{doctor}
nodes:
  - static: {{parent: world, child: table}}
  - static: {{parent: floor, child: table, name: other}}
expect:
  - {{at: 4 s, doctor: {expected}}}
"""


@pytest.mark.parametrize(
    ("doctor", "expected", "status"),
    [
        ("", "clean", 1),
        ("", "{ignore: [two-parents]}", 1),
        ("", "{ignore: [two-parents, split-tree]}", 0),
        ("", "{ignore: [publishers, shape]}", 0),
        ("doctor: {ignore: [two-parents, split-tree]}", "clean", 0),
        ("doctor: {ignore: [shape]}", "{ignore: [two-parents]}", 0),
    ],
)
def test_a_scenario_expects_what_the_doctor_says(tftool, tmp_path, doctor, expected, status):
    file = tmp_path / "two.yaml"
    file.write_text(TWO_PARENTS.format(doctor=doctor, expected=expected), encoding="utf-8")
    result = tftool("check", file, "--json")
    assert result.status == status
    # An ignored check may still explain the finding of another check.
    assert ('"found": "two-parents: table changes between the parents' in result.out) is (
        status == 1 and "two-parents" not in expected
    )


def test_a_doctor_expectation_is_judged_at_its_own_time(tftool, tmp_path):
    lost = Path(__file__).parents[2] / "scenarios" / "lost_leader.yaml"
    text = lost.read_text(encoding="utf-8")
    more = "  - {at: 4 s, doctor: clean}\n  - {at: 20 s, doctor: {ignore: [coverage]}}\n"
    file = tmp_path / "lost.yaml"
    file.write_text(text + more, encoding="utf-8")
    assert tftool("check", file).status == 0
    file.write_text(text + "  - {at: 20 s, doctor: clean}\n", encoding="utf-8")
    result = tftool("check", file)
    assert result.status == 1
    assert "edge-stopped: turtle1 in world stops before the end" in result.out


@pytest.mark.parametrize(
    ("doctor", "told"),
    [
        ("{ignore: [two-parent]}", "did you mean 'two-parents'?"),
        ("{limits: {gap.second: 2}}", "there is no threshold 'gap.second'; did you mean 'gap.sec"),
        ("{limits: {gap.seconds: -2}}", "gap.seconds: -2"),
        ("{ignored: []}", "doctor has no key 'ignored'; did you mean 'ignore'?"),
    ],
)
def test_a_list_with_a_mistake_is_refused_with_its_place(tftool, tmp_path, doctor, told):
    file = tmp_path / "two.yaml"
    file.write_text(
        TWO_PARENTS.format(doctor=f"doctor: {doctor}", expected="clean"), encoding="utf-8"
    )
    result = tftool("check", file)
    assert (result.status, told in result.err) == (3, True)
    assert f"{file}:3:" in result.err


def test_a_scenario_s_own_list_is_kept_by_the_doctor(tftool, tmp_path):
    file = tmp_path / "two.yaml"
    rules = "doctor: {ignore: [two-parents], limits: {edge-stopped.seconds: 3}}"
    file.write_text(TWO_PARENTS.format(doctor=rules, expected="clean"), encoding="utf-8")
    result = tftool("doctor", file, "--json")
    found = json.loads(result.out)
    assert "two-parents" not in [one["id"] for one in found["findings"]]
    assert {"id": "two-parents", "reason": "left out, as was asked"} in found["skipped"]


def test_checks_that_are_not_selected_are_listed_as_skipped(tftool):
    result = tftool("doctor", "turtles", "--select", "shape")
    rows = [line.split(maxsplit=2) for line in result.out.splitlines()]
    assert ["-", "publishers", "skipped, not selected"] in rows
    assert ["✓", "shape", "3 frames in 1 tree"] in rows
    assert ["-", "names", "skipped, not selected"] in rows


def broken(tmp_path, tftool):
    """Write a recording with a finding: the built-in robot without its lidar's mount."""
    place = tmp_path / "broken.mcap"
    made = tftool("record", "--in", "robot", "-o", str(place), "--for", "5")
    assert made.status == 0, made.err
    cut = tmp_path / "cut.mcap"
    assert tftool("edit", str(place), "-o", str(cut), "--drop", "odom:base_link").status == 0
    return str(cut)


def test_only_what_a_baseline_lacks_fails(tftool, tmp_path):
    source = broken(tmp_path, tftool)
    first = tftool("doctor", source, "--json")
    assert first.status == 1
    report = json.loads(first.out)
    assert report["schema"] == "tftool.doctor/2"
    accepted = tmp_path / "accepted.json"
    accepted.write_text(first.out, encoding="utf-8")

    again = tftool("doctor", source, "--baseline", str(accepted))
    assert again.status == 0
    assert "(in the baseline)" in again.out

    # An older report has no fingerprints, but the names from which fingerprints are made.
    for row in report["findings"]:
        del row["fingerprint"]
    accepted.write_text(json.dumps([report]), encoding="utf-8")
    assert tftool("doctor", source, "turtles", "--baseline", str(accepted)).status == 0

    report["findings"] = report["findings"][1:]
    accepted.write_text(json.dumps(report), encoding="utf-8")
    assert tftool("doctor", source, "--baseline", str(accepted)).status == 1


@pytest.mark.parametrize("content", ["{", "[]]", "3", '{"findings": []}', '[{"source": "a"}]'])
def test_a_baseline_that_is_no_report_is_refused(tftool, tmp_path, content):
    old = tmp_path / "old.json"
    old.write_text(content, encoding="utf-8")
    result = tftool("doctor", "turtles", "--baseline", str(old))
    assert result.status == 3
    assert "tftool doctor FROM --json > OLD.json" in result.err
    assert tftool("doctor", "turtles", "--baseline", str(tmp_path / "none.json")).status == 3


def test_steps_are_a_table_or_json(tftool):
    result = tftool("doctor", "robot", "--steps", "--json")
    assert result.status == 0
    assert json.loads(result.out)["schema"] == "tftool.steps/1"
    assert tftool("doctor", "robot", "--steps", "--pair", "odom:base_link").out.strip()
    refused = tftool("doctor", "robot", "--steps", "--pair", "odom:cup")
    assert refused.status != 0
    assert "cup" in refused.err
    assert tftool("doctor", "robot", "--pair", "odom:base_link").status == 2


def test_repeated_and_unsorted_rows_of_a_pose_file_are_no_damage(tftool, tmp_path):
    poses = tmp_path / "run.tum"
    poses.write_text("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n")

    result = tftool("doctor", poses, "--json")

    assert result.status == 0
    assert json.loads(result.out)["findings"] == []
    assert "run.tum: 1 row out of order, sorted." in result.err
    assert "run.tum: 1 row with the stamp of another row." in result.err
    assert "Damage" not in tftool("info", poses).out
    poses.write_text("1 0 0 0 0 0 0 1\n2 nan 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n")
    (found,) = json.loads(tftool("doctor", poses, "--json").out)["findings"]
    assert found["id"] == "truncated-recording"


def test_a_stamp_0_in_a_pose_file_is_fixed_in_the_file(tftool, tmp_path):
    (tmp_path / "run.tum").write_text("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n")

    result = tftool("doctor", tmp_path / "run.tum")

    assert "warning  zero-stamp" in result.out
    assert "ros2 topic" not in result.out


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--select", "gap", "--ignore", "gap"], "--ignore leaves out every check"),
        (["--select", "gap,edge-stopped", "--ignore", "coverage"], "leaves out every check"),
        (["--list", "--json"], "--list only prints text about checks: leave out turtles, --json."),
        (["--list", "--explain", "gap"], "--list only prints text about checks: leave out"),
        (["--explain", "gap", "--markdown"], "leave out turtles, --markdown."),
        (["--explain", "gap", "--fail-on", "warning", "--domain", "3"], "--fail-on, --domain."),
    ],
)
def test_options_without_effect_are_refused(tftool, options, told):
    result = tftool("doctor", "turtles", *options)

    assert (result.status, result.out) == (2, "")
    assert told in result.err
