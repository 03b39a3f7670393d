"""Tests of the built-in scenarios: each is found, read, and meets its expectations."""

import pytest

from tftool.base.errors import InputError
from tftool.scenario import builtin
from tftool.scenario.load import load
from tftool.scenario.play import run_scenario

EXPECTED = [
    "calibrate",
    "carrot",
    "long_memory",
    "lost_leader",
    "mimic",
    "orbit",
    "robot",
    "square",
    "static",
    "time_travel",
    "turtles",
    "two_trees",
]


def test_the_promised_scenarios_are_there():
    assert set(EXPECTED) <= set(builtin.names())


@pytest.mark.parametrize("name", builtin.names())
def test_every_expectation_of_a_built_in_scenario_holds(name):
    verdict = run_scenario(load(builtin.path_of(name)))

    assert verdict.failure == ""
    assert [outcome for outcome in verdict.outcomes if not outcome.ok] == []
    assert len(verdict.outcomes) >= 7
    assert verdict.ok


@pytest.mark.parametrize("name", builtin.names())
def test_a_built_in_scenario_says_what_it_shows(name):
    scenario = load(builtin.path_of(name))

    assert scenario.about.endswith(".")
    assert scenario.name == name


def test_a_wheel_carries_them_inside_the_package(tmp_path, monkeypatch):
    inside = tmp_path / "tftool" / "scenarios"
    inside.mkdir(parents=True)
    (inside / "turtles.yaml").write_text("duration: 1 s\n")
    monkeypatch.setattr(builtin, "PACKAGE", tmp_path / "tftool")

    assert builtin.folder() == inside
    assert builtin.names() == ["turtles"]


def test_a_checkout_has_them_beside_the_package(tmp_path, monkeypatch):
    beside = tmp_path / "scenarios"
    beside.mkdir()
    (beside / "turtles.yaml").write_text("duration: 1 s\n")
    monkeypatch.setattr(builtin, "PACKAGE", tmp_path / "tftool")

    assert builtin.path_of("turtles") == beside / "turtles.yaml"


def test_an_installation_without_them_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(builtin, "PACKAGE", tmp_path / "tftool")

    with pytest.raises(InputError, match="the built-in scenarios are missing"):
        builtin.folder()


@pytest.mark.parametrize("word", ["nothing_like_it", "./turtles", "turtles.yaml", ""])
def test_a_word_that_names_no_built_in_scenario_has_no_path(word):
    assert builtin.path_of(word) is None
