"""Tests that pages in docs/ name existing files, and show the real output of commands."""

import re
import tomllib
import warnings
from pathlib import Path

import pytest

from tests.pages import blocks, follow, said_by
from tftool.app.main import main

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
pytestmark = pytest.mark.skipif(not DOCS.exists(), reason="docs/ is not beside these tests")


def pages():
    return [*DOCS.rglob("*.md"), ROOT / "CHANGELOG.md"]


def named(page):
    return str(page.relative_to(ROOT))


FILE = re.compile(r"(?:# |<!-- )([\w./-]+\.(?:py|yaml|urdf))(?: -->)?\n")
"""First line of a code block that contains a file: the file's name in a comment."""

EXCERPT = re.compile(r"^<!-- From (\S+)\. -->\n```\w+\n(.*?)^```$", re.MULTILINE | re.DOTALL)
"""Excerpt of a file in a page that is shown without Sphinx, such as the README."""


def excerpts(page):
    """Return the parts of files that a page shows: (name, text)."""
    return EXCERPT.findall(page.read_text(encoding="utf-8"))


WITH_BLOCKS = [page for page in sorted(DOCS.rglob("*.md")) if blocks(page)]


@pytest.mark.parametrize("page", WITH_BLOCKS, ids=named)
def test_a_page_can_be_followed_line_by_line(page, tmp_path, monkeypatch):
    """Check commands and programs of a page against the output below them."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")
    monkeypatch.setenv("TFTOOL_SESSION_DIR", str(tmp_path / "sessions"))
    previous, shown = None, [text for _, text in excerpts(page)]
    for kind, text in blocks(page):
        if text in shown:
            continue
        first = text.partition("\n")[0]
        if kind == "console":
            follow(text)
        elif kind == "text" and previous is not None:
            assert said_by(previous) == text
        elif named_file := FILE.fullmatch(first + "\n"):
            (tmp_path / named_file[1]).write_text(text, encoding="utf-8")
        previous = text if kind == "python" and not FILE.match(text) else None


def test_every_program_of_a_page_has_its_output_below_it():
    # architecture.md shows parts of files to add; the other pages show programs.
    for page in DOCS.glob("*/*.md"):
        kinds = [kind for kind, _ in blocks(page)]
        shown = [text for _, text in excerpts(page)]
        lonely = [
            at
            for at, (kind, text) in enumerate(blocks(page))
            if kind == "python"
            and not FILE.match(text)
            and text not in shown
            and kinds[at + 1 :][:1] != ["text"]
        ]
        assert not lonely, page.name


@pytest.mark.parametrize("page", [page for page in WITH_BLOCKS if excerpts(page)], ids=named)
def test_every_excerpt_of_a_file_on_a_page_is_in_that_file(page):
    for name, text in excerpts(page):
        assert text in (ROOT / name).read_text(encoding="utf-8"), name


def test_pages_to_learn_from_need_no_site_to_be_read():
    for page in DOCS.glob("learn/*.md"):
        assert not re.findall(r"^```\{(?!toctree)", page.read_text("utf-8"), re.MULTILINE), (
            page.name
        )


def test_the_picture_of_the_turtles_frames_is_what_the_program_draws(tmp_path):
    drawn = tmp_path / "turtles.svg"
    assert main(["tree", "turtles", "-o", str(drawn)]) == 0

    # The command to draw it again: tftool tree turtles -o docs/learn/turtles.svg
    assert (DOCS / "learn" / "turtles.svg").read_text("utf-8") == drawn.read_text("utf-8")


def test_the_site_is_built_without_a_warning(tmp_path):
    pytest.importorskip("furo")
    pytest.importorskip("myst_parser")
    from sphinx.cmd.build import build_main

    with warnings.catch_warnings():
        # Warnings of the build are errors (-W); warnings of its libraries are ignored.
        warnings.simplefilter("ignore")
        words = ["-q", "-W", "--keep-going", "-d", str(tmp_path / "kept")]
        status = build_main([*words, str(DOCS), str(tmp_path / "site")])

    assert status == 0
    front = (tmp_path / "site" / "index.html").read_text(encoding="utf-8")
    scene = re.search(r'<iframe src="([^"#]+)#', front)[1]
    assert "<title>tftool view</title>" in (tmp_path / "site" / scene).read_text("utf-8")
    # The page fetches nothing from other servers.
    assert not re.findall(r"<(?:script|link|img)[^>]*(?:src|href)=\"(?:https?:)?//", front)


def test_the_layers_shown_are_those_of_the_contract():
    text = (DOCS / "architecture.md").read_text(encoding="utf-8")
    shown = text.split("<!-- A test compares this block with the contract. -->\n```text\n")[1]

    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    layers = contracts["tool"]["importlinter"]["contracts"][0]["layers"]
    assert shown.split("\n```")[0].splitlines() == layers


def test_the_table_of_environment_variables_is_complete_and_correct():
    page = (DOCS / "reference" / "commands.md").read_text(encoding="utf-8")
    table = page.split("## Environment variables\n")[1].split("\n## ")[0]
    listed = {
        name
        for row in table.splitlines()
        if row.startswith("| `")
        for name in re.findall(r"`([A-Z_]{4,})`", row.split("|")[1])
    }

    sources = "".join(one.read_text("utf-8") for one in (ROOT / "tftool").rglob("*.py"))
    read = set(re.findall(r'"([A-Z][A-Z_]+)"', sources))
    ours = {name for name in read if name.startswith("TFTOOL_") and "_COMPLETE" not in name}
    assert ours <= listed
    assert listed <= read


def test_every_file_and_folder_named_is_there():
    named = {
        word
        for page in pages()
        for word in re.findall(r"`([\w./-]+(?:/|\.(?:py|md|yml|toml)))`", page.read_text("utf-8"))
    }

    assert len(named) > 40
    # Pages omit the package `tftool/` before a room; files of a page begin with their name in its
    # blocks.
    places = (ROOT, ROOT / "tftool", ROOT / "examples" / "learning_tf" / "learning_tf")
    own = {
        text.partition("\n")[0][2:]
        for page in pages()
        for _, text in blocks(page)
        if FILE.match(text)
    }
    missing = [word for word in named - own if not any((place / word).exists() for place in places)]
    assert missing == []


def test_links_between_pages_lead_somewhere():
    for page in pages():
        for link in re.findall(r"\]\(([^)#:]+)\)", page.read_text(encoding="utf-8")):
            assert (page.parent / link).exists(), f"{page.name}: {link}"
