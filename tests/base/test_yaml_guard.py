"""Tests of the only reader of YAML: results are limited in size, and contain only plain values."""

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
        (BOMB, "the YAML has more values than the limit of 200,000"),
        (MERGES, "the YAML has more values than the limit of 200,000"),
        ("[" * 5000, "the YAML has more nested levels than the limit of 100"),
        ("- " * 5000 + "x", "the YAML has more nested levels than the limit of 100"),
        ("&a [*a]", r"the alias \*a is used inside its own value"),
        ("a: &a {b: *a}", r"the alias \*a is used inside its own value"),
        ("x" * (4 * 1024 * 1024 + 1), "more characters than the limit"),
        ("!!timestamp x", "has the tag !!timestamp, but is not of this type"),
        ("!!int x", "has the tag !!int, but is not of this type"),
        ("[!!float {a: 1}]", "mapping"),
        ("!!python/object/apply:os.system [ls]", "could not determine a constructor"),
        ("a: [", "while parsing|expected"),
    ],
)
def test_yaml_beyond_the_limits_or_with_invalid_values_is_refused(text, told):
    with pytest.raises(yaml.YAMLError, match=told):
        yaml_guard.load(text)


def test_plain_values_come_out_as_they_are():
    text = "a: &a [1, 2.5, yes, null]\nb: *a\nc: {<<: {d: x}, e: 2001-01-01}\n"

    assert yaml_guard.load(text) == yaml.safe_load(text)
    assert yaml_guard.load("") is None
    assert yaml_guard.load("{}") == {}
