import json
from functools import partialmethod

import pytest

from tftool.commands.shared import on_screen as onscreen
from tftool.screens.terminal import turtle_app as terminal
from tftool.screens.terminal.world_app import WorldApp

BAD = """\
about: Nothing holds.
duration: 2 s
nodes: [turtlesim, broadcaster: {turtle: turtle1}]
expect:
  - {at: 1 s, turtles: [turtle1, turtle9]}
  - {at: 2 s, turtles: [turtle1]}
"""


@pytest.fixture
def on_terminal(monkeypatch):
    """Replace the terminal by one for which screens are drawn but not shown."""
    monkeypatch.setattr("tftool.commands.demo.command.screen_lacks", lambda: "")
    run = WorldApp.run_with_world
    monkeypatch.setattr(WorldApp, "run_with_world", partialmethod(run, headless=True))
    apps = []
    started = terminal.TurtleApp.on_mount

    def noting(self):
        apps.append(self)
        return started(self)

    monkeypatch.setattr(terminal.TurtleApp, "on_mount", noting)
    return apps


def test_without_a_terminal_the_scenario_is_played_and_summed_up(tftool):
    result = tftool("demo", "turtles")

    lines = result.out.splitlines()
    assert result.status == 0
    assert lines[0] == "turtles: turtle2 follows turtle1, the tutorial's demo."
    assert lines[1] == "Played 60 s of simulated time."
    assert lines[3].startswith("  turtle1  x ")
    assert lines[3].endswith("°  in world")
    assert "  turtle2 is 0.000 m from turtle1." in lines
    assert lines[-1].endswith(" expectations held.")
    assert result.err == ""


def test_all_scenarios_are_listed(tftool):
    plain, listed = tftool("demo", "--list"), tftool("demo", "--list", "--json")

    names = [line.split()[0] for line in plain.out.splitlines()]
    assert plain.status == listed.status == 0
    assert {"turtles", "carrot", "robot", "two_trees"} <= set(names)
    assert [one["name"] for one in json.loads(listed.out)] == names == sorted(names)
    assert "turtles      turtle2 follows turtle1, the tutorial's demo." in plain.out


def test_on_a_narrow_terminal_the_list_breaks_between_words(tftool, monkeypatch):
    piped = tftool("demo", "--list").out.splitlines()
    monkeypatch.setenv("COLUMNS", "50")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)

    lines = tftool("demo", "--list").out.splitlines()

    rows = []
    for line in lines:
        if line.startswith(" " * 13):
            rows[-1] += " " + line.lstrip()
        else:
            rows.append(line)
    assert max(map(len, lines)) <= 50
    assert len(lines) > len(piped)
    assert rows == piped


def test_two_runs_print_the_same(tftool):
    assert tftool("demo").out == tftool("demo").out


def test_a_scenario_that_ends_early_is_judged_up_to_there(tftool):
    result = tftool("demo", "turtles", "--for", 5)

    assert result.status == 0
    assert "Played 5 s of simulated time." in result.out
    assert "more would have been judged later." in result.out


def test_an_expectation_that_fails_is_told_and_is_the_exit_status(tftool, tmp_path):
    (tmp_path / "bad.yaml").write_text(BAD)

    result = tftool("demo", tmp_path / "bad.yaml")

    assert result.status == 1
    assert "1 of 2 expectations held." in result.out
    assert "line 5: at 1 s" in result.out


def test_the_summary_names_the_set_arguments_and_those_the_expectations_assume(tftool):
    result = tftool("demo", "turtles", "--source-frame", "nosuch")

    assert result.status == 1
    assert "Played 60 s of simulated time with source_frame=nosuch." in result.out
    assert "expectations held; they are written for source_frame=turtle1." in result.out


@pytest.mark.parametrize("seconds", [90_000, 9e9])
def test_a_run_without_end_is_refused(tftool, seconds):
    for words in (["demo"], ["run", "--simulated", "x.py"], ["launch", "--simulated", "x.py"]):
        result = tftool(words[0], "--for", seconds, *words[1:])

        assert result.status == 2
        assert "is too long for simulated time, which is limited to a day" in result.err


def test_a_scenario_may_expect_nothing(tftool, tmp_path):
    (tmp_path / "quiet.yaml").write_text("duration: 1 s\n")

    result = tftool("demo", tmp_path / "quiet.yaml")

    assert result.status == 0
    assert result.out.splitlines()[0] == "quiet"
    assert "It has no expectations up to this time." in result.out


def test_the_leader_can_be_another_frame(tftool):
    found = json.loads(tftool("demo", "carrot", "--source-frame", "carrot1", "--json").out)

    assert found["ok"] is True
    (apart,) = [one for one in found["distances"] if one["from"] == "turtle2"]
    assert apart["to"] == "turtle1"
    assert found["frames"]["carrot1"]["in"] == "world"
    assert {outcome["ok"] for outcome in found["expectations"]} == {True}


def test_any_argument_can_be_set(tftool):
    by_option = tftool("demo", "carrot", "--source-frame", "carrot1")
    by_name = tftool("demo", "carrot", "--set", "source_frame=carrot1")

    assert by_option == by_name


@pytest.mark.parametrize(
    ("words", "status", "sentence"),
    [
        (["--rate", "0"], 2, "0 is not between 0.001 and 1000"),
        (["--rate", "nan"], 2, "nan is not between 0.001 and 1000"),
        (["--rate", "1e300"], 2, "1e+300 is not between 0.001 and 1000"),
        (["--for", "1e300"], 2, "1e+300 is too large: give 9e+09 at most"),
        (["--rate", "fast"], 2, "'fast' is not a number"),
        (["--for", "-1"], 2, "-1 is not a positive number"),
        (["--set", "delay"], 2, "--set takes NAME=VALUE"),
        (["--set", "=3"], 2, "--set takes NAME=VALUE"),
        (["--set", "a=1", "--set", "a=2"], 2, "'a' is set twice"),
        (["--set", "leader=x"], 2, "has no argument 'leader'"),
        (["time_travel", "--set", "delay=abc"], 2, "'abc' is not a duration such as 2 s"),
        (["nosuch"], 3, "nosuch"),
    ],
)
def test_invalid_demo_arguments_are_refused_with_a_sentence(tftool, words, status, sentence):
    result = tftool("demo", *words)

    assert result.status == status
    assert result.out == ""
    assert sentence in result.err
    assert "Traceback" not in result.err


def test_a_node_that_fails_is_named_in_the_summary(tftool, monkeypatch):
    from tftool.world.nodes.broadcasters import Broadcaster

    async def run(self):
        raise ValueError("out of [bold]paint[/]")

    monkeypatch.setattr(Broadcaster, "run", run)

    result = tftool("demo")

    assert result.status == 1
    assert "It ended early: node 'broadcaster1' failed: ValueError: out of [bold]paint[/]" in (
        result.out
    )


def test_many_frames_are_summed_up_shortly(tftool, tmp_path):
    steps = "\n".join(
        f"  - {{at: 0 s, static: {{parent: map, child: f{n}, x: {n} m}}}}" for n in range(30)
    )
    (tmp_path / "many.yaml").write_text(f"duration: 1 s\nscript:\n{steps}\n")

    result = tftool("demo", tmp_path / "many.yaml")

    assert result.status == 0
    assert "  f19  x  19.000" in result.out
    assert "  and 10 more" in result.out


def test_on_a_terminal_the_world_is_shown_until_its_time_is_over(tftool, on_terminal):
    result = tftool("demo", "--rate", 20, "--for", 3, "--light", "--ascii")

    (app,) = on_terminal
    assert result.status == 0
    assert result.out == ""
    assert app.title == "tftool demo turtles"
    assert app.setting.light
    assert app.setting.ascii_only
    assert "turtle1" in app.scene.simulator.turtles
    assert app.scene.world.clock.elapsed() > 3e9


def test_on_a_terminal_a_world_without_turtles_cannot_be_driven(tftool, on_terminal):
    assert tftool("demo", "static", "--rate", 20, "--for", 1).status == 0

    (app,) = on_terminal
    assert app.press_key is None


def test_on_a_terminal_driving_is_left_to_a_person(tftool, on_terminal):
    assert tftool("demo", "mimic", "--rate", 20, "--for", 3).status == 0

    (app,) = on_terminal
    assert list(app.scene.simulator.turtles) == ["turtle1", "turtle2"]
    assert app.scene.simulator.turtles["turtle1"].pose.linear_velocity == 0.0
    assert len(app.scene.simulator.trail.segments) == 0


def test_on_a_terminal_a_failing_node_is_named_on_stderr(tftool, on_terminal, monkeypatch):
    from tftool.world.nodes.broadcasters import Broadcaster

    async def run(self):
        raise ValueError("out of paint")

    monkeypatch.setattr(Broadcaster, "run", run)

    result = tftool("demo")

    assert result.status == 1
    told = "tftool: node 'broadcaster1' failed: ValueError: out of paint (test_demo.py:"
    assert result.err.startswith(told)
    assert result.err.count("\n") == 1


@pytest.mark.parametrize(("term", "lacks"), [("xterm", ""), ("dumb", "TERM=dumb has no screen")])
def test_a_terminal_is_where_all_three_streams_are(monkeypatch, term, lacks):
    class Screen:
        def isatty(self):
            return True

    monkeypatch.setenv("TERM", term)
    for stream in ("stdin", "stdout", "stderr"):
        monkeypatch.setattr(f"sys.{stream}", Screen())
    assert onscreen.screen_lacks() == lacks

    monkeypatch.setattr("sys.stdin", None)
    assert onscreen.screen_lacks() == (lacks or "stdin is not a terminal")


def test_a_dumb_terminal_gets_the_reason_why_there_is_no_screen(tftool, simulated, monkeypatch):
    monkeypatch.setenv("TERM", "dumb")
    quiet = tftool("demo", "static")
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    watched = tftool("demo", "static")

    assert (quiet.status, quiet.err) == (0, "")
    assert watched.out == quiet.out
    assert "TERM=dumb has no screen" in watched.err
