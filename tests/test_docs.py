"""The pages in docs/ name what is there."""

import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
pytestmark = pytest.mark.skipif(not DOCS.exists(), reason="docs/ is not beside these tests")


def pages():
    return [*DOCS.glob("*.md"), ROOT / "CHANGELOG.md"]


def test_the_layers_shown_are_those_of_the_contract():
    text = (DOCS / "architecture.md").read_text(encoding="utf-8")
    shown = text.split("<!-- A test compares this block with the contract. -->\n```text\n")[1]

    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    layers = contracts["tool"]["importlinter"]["contracts"][0]["layers"]
    assert shown.split("\n```")[0].splitlines() == [one.replace("tftool.", "") for one in layers]


def test_every_file_and_folder_named_is_there():
    named = {
        word
        for page in pages()
        for word in re.findall(r"`([\w./-]+(?:/|\.(?:py|md|yml|toml)))`", page.read_text("utf-8"))
    }

    assert len(named) > 40
    # A room is named without the package it lies in.
    missing = [
        word for word in named if not any((at / word).exists() for at in (ROOT, ROOT / "tftool"))
    ]
    assert missing == []


def test_links_between_pages_lead_somewhere():
    for page in pages():
        for link in re.findall(r"\]\(([^)#:]+)\)", page.read_text(encoding="utf-8")):
            assert (page.parent / link).exists(), f"{page.name}: {link}"
