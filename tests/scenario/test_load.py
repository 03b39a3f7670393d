"""Tests of reading scenario files: their meaning, and all mistakes at once."""

from pathlib import Path

import pytest

from tftool.base.errors import InputError, ScenarioError, UsageError
from tftool.base.stamps import seconds
from tftool.geometry.motion import Gains
from tftool.scenario import document, load
from tftool.scenario.scenario import When

SMALLEST = "duration: 1 s\n"


def mistakes(text):
    """Return the mistakes in a text as (line, column, sentence)."""
    with pytest.raises(ScenarioError) as refused:
        load.parse(text, "s.yaml")
    return [(one.line, one.column, one.text) for one in refused.value.mistakes]


def told(text):
    """Return the sentences only."""
    return [sentence for _, _, sentence in mistakes(text)]


def node(yaml):
    """Return the parameters of the only node of a scenario."""
    (entry,) = load.parse(f"duration: 1 s\nnodes:\n  - {yaml}\n", "s.yaml").nodes
    return entry.parameters


TEN = """\
about: ten mistakes
duraton: 30 s
arguments: {source_frame: turtle1}
nodes:
  - turtlesim: {}
  - brodcaster: {turtle: turtle1}
  - follower: {leader: $sorce_frame, period: 1 parsec, period: 2 s}
script:
  - {at: 1 s, keys: "up up lefft up"}
  - {at: 6 m, drive: {turtle: turtle1, linear: fast}, for: 4 s}
expect:
  - {at: 2 s, lookup: {target: turtle2, source: turtle1}, raises: LookupExeption}
  - {by: 20 s, distance: {from: turtle2, to: turtle1}}
"""

TEN_TOLD = """\
ten.yaml has 10 mistakes:
ten.yaml:2:1: a scenario has no key 'duraton'; did you mean 'duration'?
     2 | duraton: 30 s
       | ^^^^^^^
ten.yaml:6:5: there is no kind of node 'brodcaster'; did you mean 'broadcaster'?
     6 |   - brodcaster: {turtle: turtle1}
       |     ^^^^^^^^^^
ten.yaml:7:24: unknown argument '$sorce_frame'; did you mean 'source_frame'?
     7 |   - follower: {leader: $sorce_frame, period: 1 parsec, period: 2 s}
       |                        ^^^^^^^^^^^^
ten.yaml:7:46: '1 parsec' is not a duration: 'parsec' is not an allowed unit; allowed units are \
s, ms, us, µs, ns, min, h
     7 |   - follower: {leader: $sorce_frame, period: 1 parsec, period: 2 s}
       |                                              ^^^^^^^^
ten.yaml:7:56: the key 'period' is given twice, first in line 7
     7 |   - follower: {leader: $sorce_frame, period: 1 parsec, period: 2 s}
       |                                                        ^^^^^^
ten.yaml:9:21: 'lefft' is not a key; did you mean 'left'?
     9 |   - {at: 1 s, keys: "up up lefft up"}
       |                     ^^^^^^^^^^^^^^^^
ten.yaml:10:10: '6 m' is not a duration: m is the unit of a length; allowed units are \
s, ms, us, µs, ns, min, h (minutes are min)
    10 |   - {at: 6 m, drive: {turtle: turtle1, linear: fast}, for: 4 s}
       |          ^^^
ten.yaml:10:48: 'fast' is not a speed such as 2 m/s
    10 |   - {at: 6 m, drive: {turtle: turtle1, linear: fast}, for: 4 s}
       |                                                ^^^^
ten.yaml:12:67: 'LookupExeption' is not a transform exception; did you mean 'LookupException'?
    12 | t: 2 s, lookup: {target: turtle2, source: turtle1}, raises: LookupExeption}
       |                                                             ^^^^^^^^^^^^^^
ten.yaml:13:5: the limit is missing: write below, above, between: [low, high], or is
    13 |   - {by: 20 s, distance: {from: turtle2, to: turtle1}}
       |     ^"""


def test_ten_mistakes_are_told_at_once_each_with_its_place():
    with pytest.raises(ScenarioError) as refused:
        load.parse(TEN, "ten.yaml")

    assert str(refused.value) == TEN_TOLD
    assert len(refused.value.mistakes) == 10


def test_a_single_mistake_is_told_in_the_singular():
    with pytest.raises(ScenarioError, match=r"^s\.yaml has a mistake:\ns\.yaml:1:1: ") as refused:
        load.parse("about: nothing else\n", "s.yaml")

    assert refused.value.name == "s.yaml"


def test_more_mistakes_than_anyone_reads_are_counted():
    text = SMALLEST + "nodes:\n" + "  - nonsense\n" * 60

    with pytest.raises(ScenarioError, match=r"s\.yaml has 60 mistakes:") as refused:
        load.parse(text, "s.yaml")

    assert str(refused.value).endswith("\n... and 10 more")


def test_a_scenario_says_what_it_holds():
    scenario = load.parse(
        """\
about: An example
arguments: {who: turtle1}
duration: 30 s
cache_time: 5
nodes:
  - turtlesim
  - broadcaster: {turtle: $who}
  - broadcaster: {turtle: turtle2}
  - follower: {name: chaser}
script:
  - {at: 1 s, say: hello}
expect:
  - {at: [1 s, 2 s], trees: 1}
  - {always: true, every: 1 s, roots: [world]}
  - {by: 3 s, frame: $who}
""",
        "folder/example.yaml",
    )

    assert (scenario.name, scenario.file) == ("example", "folder/example.yaml")
    assert (scenario.duration, scenario.cache_time) == (seconds(30), seconds(5))
    assert [(entry.kind, entry.name) for entry in scenario.nodes] == [
        ("turtlesim", "turtlesim"),
        ("broadcaster", "broadcaster1"),
        ("broadcaster", "broadcaster2"),
        ("follower", "chaser"),
    ]
    assert scenario.nodes[1].parameters["turtle"] == "turtle1"
    assert [step.line for step in scenario.script] == [11]
    assert [one.when for one in scenario.expect] == [
        When("at", seconds(1), seconds(1), seconds(0.1)),
        When("at", seconds(2), seconds(2), seconds(0.1)),
        When("during", 0, seconds(30), seconds(1)),
        When("by", 0, seconds(3), seconds(0.1)),
    ]
    assert [str(one) for one in scenario.expect] == [
        "at 1 s: number of trees is 1",
        "at 2 s: number of trees is 1",
        "from 0 s to 30 s: roots are world",
        "by 3 s: frame turtle1 exists",
    ]


# Numbers.


@pytest.mark.parametrize(
    ("written", "nanoseconds"),
    [
        ("30 s", 30 * 10**9),
        ("30", 30 * 10**9),
        ("250 ms", 250 * 10**6),
        ("250ms", 250 * 10**6),
        ("1e-3", 10**6),
        ("1.5e1 s", 15 * 10**9),
        ("2 min", 120 * 10**9),
        ("1 h", 3600 * 10**9),
        ("1001 us", 1_001_000),
        ("0.001000001 s", 1_000_001),
        ("'2 s'", 2 * 10**9),
        (".5", 5 * 10**8),
        # YAML 1.1 would read this as an octal number.
        ("010", 10 * 10**9),
    ],
)
def test_a_duration_is_exact_in_any_unit(written, nanoseconds):
    assert load.parse(f"duration: {written}", "s.yaml").duration == nanoseconds


@pytest.mark.parametrize(
    ("written", "wrong"),
    [
        (
            "5 m",
            "m is the unit of a length; allowed units are "
            "s, ms, us, µs, ns, min, h (minutes are min)",
        ),
        ("90 deg", "deg is the unit of an angle; allowed units are s, ms, us, µs, ns, min, h"),
        ("10 hz", "'hz' is not an allowed unit; allowed units are s, ms, us, µs, ns, min, h"),
        ("10 MS", "'MS' is not an allowed unit; did you mean 'ms'?"),
    ],
)
def test_a_number_with_a_wrong_unit_is_told_which_there_are(written, wrong):
    assert told(f"duration: {written}") == [f"'{written}' is not a duration: {wrong}"]


@pytest.mark.parametrize(
    "written", ["soon", "nan", ".inf", "1:30", "1_000", "0x10", "--1", "1 2", "true", "1e"]
)
def test_a_duration_that_is_not_a_plain_number_is_refused(written):
    (sentence,) = told(f"duration: {written}")

    assert sentence.startswith(f"'{written}' is not a duration")


@pytest.mark.parametrize(
    ("written", "wrong"),
    [
        ("1e999999999 s", "'1e999999999 s' is too large: write at most 1e+09"),
        ("-1 s", "-1 s is not a duration from 0.001 to 86400 s"),
        ("25 h", "90000 s is not a duration from 0.001 to 86400 s"),
        ("1e-999999999", "0 s is not a duration from 0.001 to 86400 s"),
    ],
)
def test_a_number_out_of_bounds_is_refused(written, wrong):
    assert told(f"duration: {written}") == [wrong]


def test_numbers_carry_the_units_of_their_kind():
    steps = load.parse(
        """\
duration: 10 s
script:
  - {at: 1 s, drive: {linear: 50 cm/s, angular: 90 deg/s}, for: 250 ms}
  - {at: 2 s, teleport: {x: 5 m, y: 20 cm, theta: 90 deg}}
""",
        "s.yaml",
    ).script

    assert steps[0].action.linear == 0.5
    assert steps[0].action.angular == pytest.approx(1.5707963267948966, abs=1e-15)
    assert steps[0].action.lasting == 250_000_000
    assert (steps[1].action.x, steps[1].action.y) == (5.0, 0.2)
    assert steps[1].action.theta == pytest.approx(1.5707963267948966, abs=1e-15)


def test_a_field_may_begin_with_more_turtles():
    (one,) = node("turtlesim: {turtles: [{name: bob, x: 1 m, y: 20 cm, theta: 180 deg}]}")[
        "turtles"
    ]

    assert (one.name, one.x, one.y) == ("bob", 1.0, 0.2)
    assert one.theta == pytest.approx(3.141592653589793, abs=1e-15)


def test_gains_are_one_number_or_all_of_them():
    assert node("follower: {bearing_gains: 2}")["bearing_gains"] == Gains(2.0)
    assert node("follower: {bearing_gains: {kp: 2, ki: 0.1, kd: 1e-2, integral_limit: 1}}")[
        "bearing_gains"
    ] == Gains(2.0, 0.1, 0.01, 1.0)
    assert node("follower: {spawn: none, fixed_frame: ~}")["spawn"] is None
    assert node("follower: {spawn: {x: 1 m, y: 2 m, theta: 0}}")["spawn"] == (1.0, 2.0, 0.0)


# YAML's traps.


@pytest.mark.parametrize("word", ["no", "on", "yes", "off", "y", "true", "1e3", "007", "1.10"])
def test_a_name_is_what_was_written(word):
    assert node(f"static: {{parent: {word}, child: b}}")["parent"] == word


@pytest.mark.parametrize(
    ("word", "value"), [("yes", True), ("true", True), ("on", True), ("no", False), ("Off", False)]
)
def test_a_flag_takes_the_usual_words(word, value):
    assert node(f"turtlesim: {{holonomic: {word}}}")["holonomic"] is value


def test_a_flag_takes_no_other_word():
    assert told(SMALLEST + "nodes: [turtlesim: {holonomic: perhaps}]") == [
        "'perhaps' is neither true nor false"
    ]


@pytest.mark.parametrize(
    "tag", ["!!python/object/apply:os.system [echo]", "!!python/name:os.system", "!local x"]
)
def test_a_tag_constructs_nothing(tag):
    sentence = told(SMALLEST + f"about: {tag}\n")[0]

    assert sentence.startswith("tags (")
    assert sentence.endswith("are not allowed in scenarios")


def test_a_tag_hides_no_other_mistake():
    text = "duration: !!python/name:os.system soon\nnodes: [turtlsim]\n"

    assert [(line, column) for line, column, _ in mistakes(text)] == [(1, 11), (1, 11), (2, 9)]


def test_an_alias_stands_for_what_it_names():
    scenario = load.parse(
        "duration: 1 s\nexpect:\n  - {at: 1 s, frame: &f a}\n  - {at: 1 s, frame: *f}\n", "s.yaml"
    )

    assert [one.question.name for one in scenario.expect] == ["a", "a"]


def test_a_mistake_that_an_alias_repeats_is_told_once():
    text = "duration: 1 s\nexpect:\n  - &e {at: 1 s, frme: a}\n  - *e\n"

    assert mistakes(text) == [(3, 18, "unknown key 'frme'; did you mean 'frame'?")]


def test_an_alias_bomb_is_refused():
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 12)]

    assert told("\n".join(lines)) == ["the YAML has more values than the limit of 20,000"]


def test_an_alias_to_what_holds_it_is_refused():
    assert told("nodes: &n [*n]") == ["the alias *n is used inside its own value"]
    assert told("nodes: [*n, &n x]") == ["*n is not an anchor that was defined before"]


def test_deep_nesting_is_refused():
    assert told("nodes: " + "[" * 5000) == ["the YAML has more nested levels than the limit of 20"]


def test_a_text_that_is_too_long_is_refused():
    assert told("#" * (document.LARGEST + 1)) == [
        "the YAML has more characters than the limit of 262,144"
    ]


def test_a_second_document_is_refused():
    assert mistakes("duration: 1 s\n---\nduration: 2 s\n") == [
        (
            2,
            1,
            "a second YAML document starts here, but a file contains one scenario: "
            "remove the line '---'",
        )
    ]


def test_a_key_that_is_no_word_is_refused():
    assert told("[a, b]: c") == ["a key must be one word, not a list or a mapping"]


@pytest.mark.parametrize("text", ["", "# nothing but a comment\n", "\ufeff"])
def test_an_empty_file_is_told_so(text):
    assert told(text) == ["the file is empty"]


def test_invalid_yaml_is_reported_with_its_line_and_column():
    ((line, column, sentence),) = mistakes("duration: 1 s\nnodes: [turtlesim\nexpect: {\n")

    assert (line, column) == (3, 7)
    assert sentence.startswith("this is not YAML: while parsing a flow sequence")


def test_a_control_character_is_told_where():
    assert mistakes("duration: 1 s\nabout: \x1b[31m\n") == [
        (2, 8, "the character 0x001b is not allowed here")
    ]


def test_an_escape_that_names_no_character_is_refused():
    assert told('about: "\\UFFFFFFFF"') == [
        "an escape such as \\x in quotes is not valid: correct it, or use single quotes"
    ]


def test_a_name_that_would_act_on_a_terminal_is_refused():
    (sentence,) = told(SMALLEST + 'nodes: [static: {parent: "\\e[31m", child: b}]')

    assert "\x1b" not in sentence
    assert sentence.endswith("contains characters that cannot be printed")


def test_the_shown_line_is_safe_and_the_caret_stands_right():
    with pytest.raises(ScenarioError) as refused:
        load.parse('nodes: ["\u202e車", trutle]\nduration: 1 s\n', "s.yaml")

    shown, marks = refused.value.mistakes[1].shown, refused.value.mistakes[1].marks
    assert shown == 'nodes: ["\ufffd車", trutle]'
    # The wide character takes two cells, so the caret is one cell further than the column.
    assert marks == " " * 15 + "^" * 6


def test_a_long_line_is_shown_around_the_mistake():
    with pytest.raises(ScenarioError) as refused:
        load.parse(f"duration: 1 s\nnodes: [{'turtlesim, ' * 30} nothing]\n", "s.yaml")

    (mistake,) = [one for one in refused.value.mistakes if "nothing" in one.text]
    assert mistake.column == 340
    assert mistake.shown[len(mistake.marks) - 7 : len(mistake.marks)] == "nothing"


# Arguments.


def test_an_argument_from_outside_takes_the_place_of_the_default():
    text = "arguments: {who: a}\nduration: 1 s\nnodes: [static: {parent: '${who}_x', child: $$b}]\n"

    inside = load.parse(text, "s.yaml").nodes[0].parameters
    outside = load.parse(text, "s.yaml", {"who": "z"}).nodes[0].parameters

    assert (inside["parent"], inside["child"]) == ("a_x", "$b")
    assert outside["parent"] == "z_x"


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("arguments: {source_frame: a}\n", "'source'; did you mean 'source_frame'?"),
        ("arguments: {b: a}\n", "'source'; it has b"),
        ("", "'source'; it has none"),
    ],
)
def test_an_argument_that_is_not_declared_is_wrong_usage(text, wrong):
    with pytest.raises(UsageError) as refused:
        load.parse(text + SMALLEST, "s.yaml", {"source": "b"})

    assert str(refused.value) == f"scenario 's' has no argument {wrong}"


def test_an_unknown_argument_is_told_which_there_are():
    expect = "nodes: [static: {parent: $c, child: b}]"

    assert told(SMALLEST + expect) == ["unknown argument '$c'; declare it under 'arguments'"]
    assert told(SMALLEST + "arguments: {x1: 1}\n" + expect) == [
        "unknown argument '$c'; there are x1"
    ]


def test_arguments_are_named_by_a_word_and_single_values():
    assert told(SMALLEST + "arguments: {a b: 1, c: [1], d: $e}") == [
        "'a b' is not a valid name of an argument: use only letters, digits and _",
        "expected a text, not a list",
        "unknown argument '$e'; declare it under 'arguments'",
    ]


def test_a_value_from_outside_is_no_mistake_of_the_file():
    text = "arguments: {d: 5 s}\nduration: 1 s\nnodes: [follower: {delay: $d}]\n"

    told = r"scenario 's' does not accept 'd=soon': 'soon' is not a duration .* \(line 3\)"
    with pytest.raises(UsageError, match=told):
        load.parse(text, "s.yaml", {"d": "soon"})
    with pytest.raises(ScenarioError, match=r"s\.yaml:3:27: 'later' is not a duration"):
        load.parse(text.replace("5 s", "soon"), "s.yaml", {"d": "later"})


# Nodes.


@pytest.mark.parametrize(
    ("nodes", "wrong"),
    [
        ("turtlesim", "expected a list (one node per item); begin each item with '- '"),
        ("[[]]", "expected a mapping (a node's kind), not a list"),
        ("[~]", "no kind of node is given here: write one of turtlesim, broadcaster, "),
        ("[wheel]", "there is no kind of node 'wheel'; there are turtlesim, broadcaster, "),
        (
            "[{broadcaster: ~, turtle: turtle1}]",
            "'turtle' is at the same level as 'broadcaster', not below it: "
            "write 'broadcaster: {turtle: ...}', or indent 'turtle' further",
        ),
        (
            "[{turtlesim: ~, teleop: ~}]",
            "'teleop' is at the same level as 'turtlesim', not below it: begin each node with '- '",
        ),
        ("[broadcaster]", "a broadcaster needs the key 'turtle'"),
        ("[{broadcaster: {turtle: 1a}}]", "'1a' is not a valid name of a turtle: use only letters"),
        ("[{turtlesim: {colour: 1}}]", "a turtlesim has no key 'colour'; it may have holonomic, "),
        (
            "[{turtlesim: {background: {r: 256, g: 0, b: 0}}}]",
            "expected a whole number from 0 to 255",
        ),
        (
            "[{turtlesim: {background: {r: 1.5, g: 0, b: 0}}}]",
            "expected a whole number from 0 to 255",
        ),
        ("[{follower: {period: 0 s}}]", "0 s is not a duration from 0.001 to 86400 s"),
        ("[{follower: {speed_limit: -1}}]", "-1 m/s is not a speed of 0 m/s or more"),
        ("[{follower: {leader: turtle2}}]", "'turtle2' cannot follow itself"),
        ("[{static: {parent: '', child: b}}]", "expected a frame, not blanks"),
    ],
)
def test_a_wrong_node_is_told_what_is_wrong(nodes, wrong):
    assert any(sentence.startswith(wrong) for sentence in told(SMALLEST + f"nodes: {nodes}"))


def test_two_nodes_of_one_name_are_refused():
    text = SMALLEST + "nodes:\n  - turtlesim: {name: a}\n  - teleop: {name: a}\n"

    assert mistakes(text) == [
        (4, 5, "the node of line 3 is also named 'a': give one of them another name")
    ]


@pytest.mark.parametrize("name", ["script", "expectations", "teleop"])
def test_a_name_that_a_play_needs_itself_is_refused(name):
    assert told(SMALLEST + f"nodes: [turtlesim: {{name: {name}}}]") == [
        f"the name '{name}' is reserved; choose another name"
    ]
    assert load.parse(SMALLEST + "nodes: [teleop]", "s.yaml").nodes[0].name == "teleop"


def test_none_may_come_from_an_argument():
    text = SMALLEST + "arguments: {s: none}\nnodes: [follower: {stale_after: $s}]"

    assert load.parse(text, "s.yaml").nodes[0].parameters["stale_after"] is None
    assert load.parse(text, "s.yaml", {"s": "2 s"}).nodes[0].parameters["stale_after"] == seconds(2)


# Script and expectations.


@pytest.mark.parametrize(
    ("entry", "wrong"),
    [
        ("{at: 1 s}", "an action needs one of keys, drive, spawn, kill, "),
        ("{at: 1 s, flyy: 1}", "unknown key 'flyy'; an action is one of keys, drive, "),
        (
            "{at: 1 s, kill: a, reset: ~}",
            "an action can have only one of these keys: write kill, reset as",
        ),
        ("{kill: turtle1}", "an action (kill) needs the key 'at'"),
        ("{at: 3 s, kill: a}", "3 s is after the end of the scenario, which lasts 1 s"),
        ("{at: 1 s, drive: {}}", "an action (drive) needs the key 'for'"),
        ("{at: 1 s, kill: ~}", "kill needs the key 'turtle'"),
        ("{at: 1 s, kill: a, for: 2 s}", "an action (kill) has no key 'for'; it may have at"),
        ("{at: 1 s, reset: now}", "expected a mapping (empty), not 'now'"),
        ("{at: 1 s, keys: ''}", "expected a key, not blanks"),
        ("{at: 1 s, keys: up x}", "'x' is not a key; it may be up, down, "),
        ("{at: 1 s, stop: turtlesm}", "no node is named 'turtlesm'; did you mean 'turtlesim'?"),
        ("{at: 1 s, stop: wheel}", "no node is named 'wheel'; there are turtlesim, teleop"),
        ("just a text", "expected a mapping"),
    ],
)
def test_a_wrong_action_is_told_what_is_wrong(entry, wrong):
    text = SMALLEST + f"nodes: [turtlesim]\nscript:\n  - {entry}\n"

    assert any(sentence.startswith(wrong) for sentence in told(text))


LOOKUP = "lookup: {target: a, source: b}"


@pytest.mark.parametrize(
    ("entry", "wrong"),
    [
        ("{trees: 1}", "the time is missing; write one of at: 2 s, by: 20 s, "),
        ("{at: 1 s, by: 1 s, trees: 1}", "at, by exclude each other; write one of at: 2 s, "),
        (
            "{at: 1 s, every: 1 s, trees: 1}",
            "'every' is only allowed together with 'by', 'during' or 'always'",
        ),
        ("{at: [], trees: 1}", "the list of times is empty"),
        ("{always: false, trees: 1}", "'always: false' tests nothing: leave the expectation out"),
        ("{during: [1 s, 0 s], trees: 1}", "the first time of 'during' is after the last time"),
        ("{during: [1 s], trees: 1}", "first and last moment takes 2 values, not 1"),
        ("{at: 2 s, trees: 1}", "2 s is after the end of the scenario, which lasts 1 s"),
        ("{at: 1 s, trees: 1.5}", "expected a whole number from 0 to 100000, not 1.5"),
        ("{at: 1 s, roots: world}", "expected a list (frames); begin each item with '- '"),
        (
            "{at: 1 s, rate: a, between: [2, 1]}",
            "no number is between 2 and 1: write the smaller number first",
        ),
        (
            "{at: 1 s, rate: a, above: 1, tolerance: 1}",
            "'tolerance' is only allowed together with 'is'",
        ),
        (
            "{at: 1 s, lookup: {target: a, source: b}, value: {x: 1}, tolerance: 5 cm}",
            "a tolerance with a unit must name the quantity: write {position: 5 cm}",
        ),
        (
            "{at: 1 s, lookup: {target: a, source: b}, value: {x: 1}, tolerance: 5 deg}",
            "a tolerance with a unit must name the quantity: write {angle: 5 deg}",
        ),
        (
            "{at: 1 s, frame: a, exists: no, parent: b}",
            "with 'exists: false' no other property of the frame",
        ),
        (
            "{at: 1 s, pose: turtle1, value: {}}",
            "'value' is empty: write at least one of x, y, theta, linear, ",
        ),
        (f"{{at: 1 s, {LOOKUP}, says: x}}", "'says' is only allowed together with 'raises'"),
        (
            f"{{at: 1 s, {LOOKUP}, raises: LookupException, value: {{x: 1}}}}",
            "'raises' and 'value' exclude each other: leave one out",
        ),
        (
            f"{{at: 1 s, {LOOKUP}, value: {{rotation: [0, 0, 0, 1], yaw: 1}}}}",
            "a value has a rotation, and also roll, pitch or yaw: leave one of the two out",
        ),
        (
            f"{{at: 1 s, {LOOKUP}, value: {{rotation: [0, 0, 1, 1]}}}}",
            "the quaternion of a rotation must have length 1, not 1.41421",
        ),
        (
            "{at: 1 s, lookup: {target: a, source: b, source_time: now}}",
            "two times need a fixed frame: give 'fixed'",
        ),
        (
            "{at: 1 s, distance: {from: a, to: b, time: now, fixed: w}, is: 0}",
            "'fixed' needs two times, not one 'time'",
        ),
        (
            "{at: 1 s, lookup: {target: a, source: b, time: lately}}",
            "'lately' is not a time; did you mean 'latest'?",
        ),
        (
            "{at: 1 s, lookup: {target: a, source: b, time: once}}",
            "'once' is not a time; it may be latest, now, now - 5 s, or 12.5 s",
        ),
        (
            "{at: 1 s, lookup: {target: a, source: b, time: now - x}}",
            "'x' is not a duration such as 2 s",
        ),
        ("{at: 1 s, logged: {text: a, level: LOUD}}", "'LOUD' is not a level; it may be DEBUG"),
    ],
)
def test_a_wrong_expectation_is_told_what_is_wrong(entry, wrong):
    sentences = told(SMALLEST + f"expect:\n  - {entry}\n")

    assert any(sentence.startswith(wrong) for sentence in sentences), sentences


def test_expectations_that_would_look_for_ever_are_refused():
    text = "duration: 24 h\nexpect:\n  - {always: true, every: 1 ms, trees: 1}\n"

    assert told(text) == [
        "the scenario makes more than 1,000,000 checks: give 'every' a longer time"
    ]


# Files.


def test_a_file_is_read_with_its_name(tmp_path: Path):
    path = tmp_path / "mine.yaml"
    path.write_bytes(b"\xef\xbb\xbfduration: 1 s\r\nabout: with a mark and DOS lines\r\n")

    scenario = load.load(path)

    assert (scenario.name, scenario.about) == ("mine", "with a mark and DOS lines")


def test_a_file_that_is_not_there_is_told(tmp_path: Path):
    with pytest.raises(InputError, match=r"cannot read '.*gone\.yaml': No such file"):
        load.load(tmp_path / "gone.yaml")


def test_a_path_that_cannot_be_is_told():
    with pytest.raises(InputError, match="cannot read"):
        load.load("a\0b.yaml")


def test_a_file_that_is_no_text_is_told_where(tmp_path: Path):
    path = tmp_path / "raw.yaml"
    path.write_bytes(b"duration: 1 s\nabout: \xff\n")

    with pytest.raises(InputError, match="is not UTF-8 text: byte 22, in line 2"):
        load.load(path)
