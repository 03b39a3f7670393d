"""The one way in for YAML: what a text stands for is bounded, and only plain values come out."""

import pytest
import yaml

from tftool.base import yaml_guard

BOMB = "a: &a [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n" + "".join(
    f"{after}: &{after} [{', '.join([f'*{before}'] * 10)}]\n"
    for before, after in zip("abcdefgh", "bcdefghi", strict=True)
)
MERGES = "a: &a {x: 1}\n" + "".join(
    f"{after}: &{after} {{<<: [{', '.join([f'*{before}'] * 12)}]}}\n"
    for before, after in zip("abcdefgh", "bcdefghi", strict=True)
)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (BOMB, "more than 200,000 values are too many"),
        (MERGES, "more than 200,000 values are too many"),
        ("[" * 5000, "more than 100 levels of nesting are too deep"),
        ("- " * 5000 + "x", "more than 100 levels of nesting are too deep"),
        ("&a [*a]", r"\*a is used inside its own definition"),
        ("a: &a {b: *a}", r"\*a is used inside its own definition"),
        ("x" * (4 * 1024 * 1024 + 1), "characters are too many"),
        ("!!timestamp x", "not the timestamp that it is tagged as"),
        ("!!int x", "not the int that it is tagged as"),
        ("[!!float {a: 1}]", "mapping"),
        ("!!python/object/apply:os.system [ls]", "could not determine a constructor"),
        ("a: [", "while parsing|expected"),
    ],
)
def test_what_is_out_of_bounds_or_no_plain_value_is_refused(text, told):
    with pytest.raises(yaml.YAMLError, match=told):
        yaml_guard.load(text)


def test_plain_values_come_out_as_they_are():
    text = "a: &a [1, 2.5, yes, null]\nb: *a\nc: {<<: {d: x}, e: 2001-01-01}\n"

    assert yaml_guard.load(text) == yaml.safe_load(text)
    assert yaml_guard.load("") is None
    assert yaml_guard.load("{}") == {}
