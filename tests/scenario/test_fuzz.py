"""Tests that any scenario file is read, or refused with sentences."""

from pathlib import Path

import yaml
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tftool.base.errors import InputError, ScenarioError
from tftool.base.plain_text import visible
from tftool.scenario import builtin, load
from tftool.scenario.node_kinds import KINDS
from tftool.scenario.questions import SUBJECTS
from tftool.scenario.script import ACTIONS

TEXTS = [path.read_text(encoding="utf-8") for path in sorted(builtin.folder().glob("*.yaml"))]

WORDS = [
    *["about", "arguments", "duration", "cache_time", "nodes", "script", "expect", "name"],
    *["at", "by", "during", "always", "every", "for", "below", "above", "between", "is"],
    *["tolerance", "value", "raises", "says", "target", "source", "time", "fixed", "from", "to"],
    *["turtle", "leader", "follower", "period", "delay", "x", "y", "theta", "text", "frame"],
    *KINDS,
    *ACTIONS,
    *SUBJECTS,
]

PIECES = [
    *["'", '"', "{", "}", "[", "]", ":", ",", "- ", "\n", "  ", "&a ", "*a", "!!str ", "|", ">"],
    *["$", "$$", "${x}", "$source_frame", "~", "null", "no", "1e-3", "-1 s", "1e400", "\t", "#"],
    *["\x00", "\x1b[31m", "\ud800", "\u202e", "%YAML 1.3\n", "---\n", "...\n", "? ", "<<: ", "@"],
]

scalars = (
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=8)
    | st.sampled_from(["1 s", "90 deg", "turtle1", "now - 5 s", "latest", "world", "up left"])
)

trees = st.recursive(
    scalars,
    lambda inside: (
        st.lists(inside, max_size=4)
        | st.dictionaries(st.sampled_from(WORDS) | st.text(max_size=4), inside, max_size=5)
    ),
    max_leaves=25,
)

scenarios = st.fixed_dictionaries(
    {"duration": st.just("10 s")},
    optional={
        "nodes": st.lists(st.dictionaries(st.sampled_from(list(KINDS)), trees, max_size=2)),
        "script": st.lists(
            st.dictionaries(st.sampled_from(["at", "for", *ACTIONS]), trees, max_size=3)
        ),
        "expect": st.lists(
            st.dictionaries(st.sampled_from(["at", "by", "is", *SUBJECTS]), trees, max_size=3)
        ),
        "arguments": trees,
    },
)


def read(text: str) -> None:
    """Read a text; check that a refusal consists of printable sentences."""
    refused = None
    try:
        scenario = load.parse(text, "fuzz.yaml")
    except ScenarioError as error:
        refused = error
    if refused is None:
        assert scenario.duration > 0
    else:
        assert refused.mistakes
        assert all(visible(line) == line for line in str(refused).split("\n"))
        assert str(refused).encode("utf-8")


@given(st.text())
@example("*")
@example("? a\n: b")
@example("!<tag:yaml.org,2002:python/name:os.system> x")
@example("%TAG ! tag:x\n---\na")
@example("a: &a [*a]")
@example("- - - -\n")
@example('"\\ud800"')
def test_any_text_is_read_or_refused(text):
    read(text)


@given(
    st.sampled_from(TEXTS),
    st.floats(min_value=0, max_value=1),
    st.integers(min_value=0, max_value=12),
    st.sampled_from(PIECES) | st.sampled_from(WORDS) | st.text(max_size=5),
)
def test_a_damaged_scenario_is_read_or_refused(text, place, length, piece):
    start = int(place * len(text))

    read(text[:start] + piece + text[start + length :])


@given(trees | scenarios)
def test_any_tree_of_values_is_read_or_refused(tree):
    read(yaml.safe_dump(tree, allow_unicode=True))


@given(st.binary(max_size=200))
@settings(max_examples=50)
def test_any_bytes_are_read_or_refused(tmp_path_factory, raw):
    path: Path = tmp_path_factory.mktemp("fuzz") / "raw.yaml"
    path.write_bytes(raw)

    try:
        told = load.load(path).name
    except InputError as refused:
        told = str(refused)
    assert all(visible(line) == line for line in told.split("\n"))
