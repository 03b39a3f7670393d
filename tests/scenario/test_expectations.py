"""Tests of expectations: a failed one names the expected value, the found value and the time."""

import pytest

from tftool.base.stamps import seconds
from tftool.scenario.load import parse
from tftool.scenario.play import run_scenario

WORLD = """\
duration: 10 s
nodes:
  - turtlesim
  - broadcaster: {turtle: turtle1}
  - static: {parent: map, child: post, x: 3 m, y: 4 m, yaw: 90 deg}
script:
  - {at: 2 s, teleport: {x: 1 m, y: 2 m, theta: 90 deg}}
  - {at: 4 s, broadcast: {parent: post, child: bird, z: 1 m}, for: 2 s}
  - {at: 5 s, say: "halfway [there]"}
expect:
"""


def judge(*expectations):
    """Return the outcomes of expectations in the world above."""
    text = WORLD + "".join(f"  - {one}\n" for one in expectations)
    return run_scenario(parse(text, "s.yaml")).outcomes


def test_a_loop_is_one_tree():
    loop = "duration: 2 s\nnodes: []\nscript:\n" + "".join(
        f"  - {{at: 1 s, broadcast: {{parent: {parent}, child: {child}}}}}\n"
        for parent, child in (("a", "below"), ("a", "b"), ("b", "a"))
    )
    (outcome,) = run_scenario(parse(f"{loop}expect: [{{at: 2 s, trees: 1}}]\n", "s.yaml")).outcomes

    assert outcome.ok


def test_the_lines_of_an_error_about_a_loop_are_one_line():
    text = (
        "duration: 2 s\nnodes: []\nscript:\n"
        "  - {at: 1 s, broadcast: {parent: a, child: b}}\n"
        "  - {at: 1 s, broadcast: {parent: b, child: a}}\n"
        "  - {at: 1 s, broadcast: {parent: c, child: d}}\n"
        "expect: [{at: 2 s, lookup: {target: d, source: b}}]\n"
    )
    (outcome,) = run_scenario(parse(text, "s.yaml")).outcomes

    assert "contains a loop. Frame " in outcome.found
    assert "Frame b exists with parent a. Frame " in outcome.found
    assert "\n" not in outcome.found


@pytest.mark.parametrize(
    "expectation",
    [
        "{at: 3 s, lookup: {target: world, source: turtle1}}",
        "{at: 3 s, lookup: {target: world, source: turtle1}, value: {x: 1, y: 2, yaw: 90 deg}}",
        "{at: 3 s, lookup: {target: world, source: turtle1}, value: {x: 1.1}, tolerance: 0.2}",
        "{at: 3 s, lookup: {target: world, source: turtle1}, value: {yaw: -270 deg}}",
        "{at: 3 s, lookup: {target: world, source: turtle1, time: 1 s}, value: {yaw: 0}}",
        "{at: 3 s, lookup: {target: world, source: turtle1, time: now - 2 s}, value: {yaw: 0}}",
        "{at: 3 s, lookup: {target: map, source: post, time: now}, value: {x: 300 cm}}",
        "{at: 3 s, lookup: {target: map, source: post}, value: {rotation: [0, 0, -1, -1.0e-9]},"
        " tolerance: {position: 1 m, angle: 91 deg}}",
        "{at: 3 s, lookup: {target: map, source: nowhere}, raises: LookupException}",
        "{at: 3 s, lookup: {target: map, source: nowhere}, raises: TransformException}",
        "{at: 3 s, lookup: {target: map, source: turtle1}, raises: ConnectivityException}",
        "{at: 3 s, lookup: {target: /map, source: post}, raises: InvalidArgumentException}",
        "{at: 3.001 s, lookup: {target: world, source: turtle1, time: now},"
        " raises: ExtrapolationException, says: into the future}",
        "{at: 3 s, lookup: {target: turtle1, source: turtle1, source_time: 1 s, fixed: world},"
        " value: {x: 3.544445, y: -4.544445, yaw: -90 deg}}",
        "{at: 1 s, distance: {from: map, to: post}, is: 5 m}",
        "{at: 1 s, distance: {from: map, to: post}, between: [5, 5]}",
        "{at: 1 s, distance: {from: map, to: post}, above: 4.9, below: 5.1}",
        "{at: 3 s, distance: {from: turtle1, to: turtle1, to_time: 1 s, fixed: world},"
        " is: 5.763252, tolerance: 0.01 mm}",
        "{at: 1 s, bearing: {from: map, to: post}, is: 53.130102 deg, tolerance: 1 mrad}",
        "{at: 1 s, bearing: {from: post, to: map}, is: 503.130102 deg, tolerance: 1 mrad}",
        "{at: 1 s, point: {of: post, in: map, x: 1 m}, value: {x: 3, y: 5, z: 0}}",
        "{at: 8 s, speed: {of: turtle1, in: world}, is: 0}",
        "{at: 8 s, turn_rate: {of: post, in: map, over: 1 s}, is: 0 deg/s}",
        "{at: 8.8 s, speed: {of: turtle1, in: turtle1}, is: 0 m/s}",
        "{at: 10 s, rate: turtle1, between: [62.5 Hz, 62.7 Hz]}",
        "{at: 10 s, age: turtle1, below: 1 ms}",
        "{at: 10 s, age: bird, is: 4 s}",
        "{at: 10 s, memory: bird, is: 2 s}",
        "{at: 1 s, frame: turtle1}",
        "{at: 1 s, frame: turtle1, parent: world, static: no, broadcaster: broadcaster}",
        "{at: 1 s, frame: post, static: yes}",
        "{at: 1 s, frame: bird, exists: no}",
        "{at: 1 s, trees: 2}",
        "{at: 1 s, roots: [map, world]}",
        "{at: 1 s, turtles: [turtle1]}",
        "{at: 1 s, pose: turtle1, value: {x: 5.544445 m, y: 5.544445 m, theta: 360 deg}}",
        "{at: 10 s, logged: 'halfway [there]'}",
        "{at: 10 s, logged: {text: halfway, node: script, level: INFO}, is: 1}",
        "{at: 10 s, logged: {text: halfway, level: ERROR}, is: 0}",
        "{at: 4.9 s, logged: halfway, is: 0}",
        "{by: 5 s, frame: bird}",
        "{during: [0 s, 3.9 s], frame: bird, exists: no}",
        "{always: true, frame: post}",
    ],
)
def test_a_true_expectation_holds(expectation):
    (outcome,) = judge(expectation)

    assert outcome.ok, outcome


@pytest.mark.parametrize(
    ("expectation", "sentence", "found", "at"),
    [
        (
            "{at: 3 s, distance: {from: map, to: post}, below: 0.5}",
            "at 3 s: distance from map to post below 0.5 m",
            "5 m",
            3,
        ),
        (
            "{by: 2 s, distance: {from: map, to: post}, is: 4 m, tolerance: 1 mm}",
            "by 2 s: distance from map to post is 4 m ± 0.001 m",
            "5 m",
            2,
        ),
        (
            "{during: [1 s, 9 s], pose: turtle1, value: {x: 5.544445 m}}",
            "from 1 s to 9 s: pose of turtle1 is x 5.54444",
            "x 1, y 2, theta 1.5708, linear 0, angular 0",
            2.1,
        ),
        (
            "{at: 3 s, lookup: {target: map, source: nowhere}}",
            "at 3 s: nowhere in map can be looked up",
            'LookupException: "nowhere" passed to lookupTransform argument source_frame '
            "does not exist. ",
            3,
        ),
        (
            "{at: 3 s, lookup: {target: map, source: post}, raises: LookupException, says: x}",
            "at 3 s: post in map raises LookupException that says 'x'",
            "no exception: x 3, y 4, z 0, rotation (0, 0, 0.707107, 0.707107)",
            3,
        ),
        (
            "{at: 3 s, lookup: {target: map, source: post, time: now - 1 s}, value: {x: 1, yaw: 0},"
            " tolerance: {angle: 1 mrad}}",
            "at 3 s: post in map (now - 1 s) is x 1, yaw 0 (± 0.001 rad)",
            "x 3, y 4, z 0, roll 0, pitch 0, yaw 1.5708",
            3,
        ),
        (
            "{at: 3 s, speed: {of: turtle1, in: world}, above: 50 cm/s}",
            "at 3 s: speed of turtle1 in world above 0.5 m/s",
            "0 m/s",
            3,
        ),
        (
            "{at: 3 s, turn_rate: {of: turtle1, in: world}, is: 1}",
            "at 3 s: turn rate of turtle1 in world is 1 rad/s",
            "0 rad/s",
            3,
        ),
        (
            "{at: 3 s, rate: nowhere, above: 1 Hz}",
            "at 3 s: rate of nowhere above 1 Hz",
            'LookupException: frame "nowhere" does not exist',
            3,
        ),
        (
            "{at: 3 s, rate: posst, above: 1 Hz}",
            "at 3 s: rate of posst above 1 Hz",
            'LookupException: frame "posst" does not exist. '
            "No transform of 'posst' has arrived yet; did you mean 'post'?",
            3,
        ),
        (
            "{at: 3 s, frame: post, static: no, parent: world, broadcaster: me}",
            "at 3 s: frame post is dynamic, hangs under world, comes from me",
            "static, under map, from static",
            3,
        ),
        ("{at: 3 s, frame: post, exists: no}", "at 3 s: frame post does not exist", None, 3),
        ("{at: 3 s, frame: bat}", "at 3 s: frame bat exists", "no such frame", 3),
        (
            "{at: 3 s, frame: posst}",
            "at 3 s: frame posst exists",
            "no such frame; did you mean 'post'?",
            3,
        ),
        ("{at: 3 s, frame: map, static: yes}", "at 3 s: frame map is static", "a root", 3),
        ("{at: 3 s, trees: 1}", "at 3 s: number of trees is 1", "2", 3),
        ("{at: 3 s, roots: []}", "at 3 s: roots are none", "map, world", 3),
        (
            "{at: 3 s, frame: post, parent: mpa}",
            "at 3 s: frame post hangs under mpa",
            "static, under map, from static; did you mean 'map'?",
            3,
        ),
        (
            "{at: 3 s, roots: [mapp, worlds]}",
            "at 3 s: roots are mapp, worlds",
            "map, world; did you mean 'map', 'world'?",
            3,
        ),
        ("{at: 3 s, roots: [map, maps]}", "at 3 s: roots are map, maps", "map, world", 3),
        ("{at: 3 s, turtles: [bob]}", "at 3 s: turtles are bob", "turtle1", 3),
        (
            "{at: 3 s, pose: bob, value: {x: 1}}",
            "at 3 s: pose of bob is x 1",
            "nothing was published",
            3,
        ),
        (
            "{at: 9 s, logged: {text: halfway, node: script}, is: 2}",
            "at 9 s: log lines by script with 'halfway' is 2",
            "1",
            9,
        ),
        (
            "{at: 3 s, distance: {from: map, to: post, to_time: now - 1 s, fixed: map}, is: 4}",
            "at 3 s: distance from map (latest) to post (now - 1 s), through map, is 4 m",
            "5 m",
            3,
        ),
        (
            "{at: 3 s, bearing: {from: post, to: post, to_time: 1 s, fixed: map}, above: 1}",
            "at 3 s: bearing of post (1 s) from post (latest), through map, above 1 rad",
            "0 rad",
            3,
        ),
        (
            "{at: 3 s, lookup: {target: post, source: bat, source_time: now, fixed: map}}",
            "at 3 s: bat (now) in post (latest), through map, can be looked up",
            None,
            3,
        ),
        (
            "{at: 3 s, bearing: {from: map, to: post}, between: [0 deg, 1 deg]}",
            "at 3 s: bearing of post from map between 0 and 0.0174533 rad",
            "0.927295 rad",
            3,
        ),
    ],
)
def test_a_false_expectation_reports_both_values_and_the_time(expectation, sentence, found, at):
    (outcome,) = judge(expectation)

    assert not outcome.ok
    assert f"{outcome.when}: {outcome.expectation} {outcome.expected}" == sentence
    assert found is None or outcome.found == found
    assert outcome.at == seconds(at)
    assert outcome.line == 11


def test_by_tells_the_first_moment_at_which_it_held():
    (outcome,) = judge("{by: 9 s, every: 0.5 s, frame: bird}")

    assert (outcome.ok, outcome.at) == (True, seconds(4))


def test_the_last_moment_is_looked_at_even_off_the_grid():
    (outcome,) = judge("{during: [1 s, 3.95 s], every: 2 s, frame: bird, exists: no}")

    assert (outcome.ok, outcome.at) == (True, seconds(3.95))


def test_expectations_are_judged_after_everything_else_of_their_instant():
    # The script acts at the same time at which the expectation is checked.
    (outcome,) = judge("{at: 4 s, lookup: {target: post, source: bird, time: now}, value: {z: 1}}")

    assert outcome.ok


def test_a_verdict_becomes_a_report():
    scenario = parse(WORLD + "  - {at: 3 s, trees: 1}\n", "folder/s.yaml")

    report = run_scenario(scenario).report()

    assert (report.name, report.file, report.ok, report.lasted) == ("s", "folder/s.yaml", False, 10)
    (judgement,) = report.judgements
    assert judgement.subject == "at 3 s: number of trees is 1"
    assert (judgement.expected, judgement.found, judgement.at, judgement.line) == (
        "is 1",
        "2",
        3.0,
        11,
    )
