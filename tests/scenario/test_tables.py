"""Tests that the tables of scenario contents agree with the code and with its page."""

import inspect

import pytest

from tftool.scenario import builtin
from tftool.scenario.fields import parts_of
from tftool.scenario.load import parse
from tftool.scenario.node_kinds import KINDS
from tftool.scenario.play import run_scenario
from tftool.scenario.questions import SUBJECTS
from tftool.scenario.script import ACTIONS, Press


@pytest.mark.parametrize("kind", KINDS)
def test_a_node_takes_every_parameter_a_scenario_may_give_it(kind):
    taken = inspect.signature(KINDS[kind].make).parameters

    for name in KINDS[kind].fields:
        assert name in taken
        assert taken[name].kind is inspect.Parameter.KEYWORD_ONLY


def test_the_example_on_the_page_about_the_format_is_true():
    page = (builtin.folder() / "README.md").read_text(encoding="utf-8")
    example = page.split("```yaml\n")[1].split("```")[0]

    assert run_scenario(parse(example, "example.yaml")).ok


def test_the_page_about_the_format_names_everything_there_is():
    page = (builtin.folder() / "README.md").read_text(encoding="utf-8")

    words = [*KINDS, *ACTIONS, *SUBJECTS, *parts_of(Press)]
    words += [name for kind in KINDS.values() for name in kind.fields]
    words += [key for kind in ACTIONS.values() for key in parts_of(kind)]
    words += [key for subject in SUBJECTS.values() for key in parts_of(subject)]
    words += [key for subject in SUBJECTS.values() for key in subject.form.fields]
    assert [word for word in words if f"`{word}`" not in page] == []
