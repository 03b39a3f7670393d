import itertools
import re
import subprocess
import sys
from pathlib import Path

import pytest

import tftool
from tests.pages import blocks, follow, said_by
from tftool.app.index import COMMANDS
from tftool.messages.schema import Schema
from tftool.ros.host import import_table

ROOT = Path(__file__).parents[1]
README = ROOT / "README.md"
TEXT = README.read_text(encoding="utf-8")
BLOCKS = blocks(README)
DOCS = ROOT / "docs"


def test_it_is_short():
    assert TEXT.count("\n") < 150


def test_every_program_prints_what_the_readme_says():
    programs = [
        (code, printed)
        for (kind, code), (after, printed) in itertools.pairwise(BLOCKS)
        if kind == "python" and after == "text"
    ]

    assert len(programs) == sum(kind == "python" for kind, _ in BLOCKS) > 0
    for code, printed in programs:
        assert said_by(code) == printed


TOUR = [text for kind, text in BLOCKS if kind == "console"]


@pytest.mark.parametrize("text", TOUR, ids=lambda text: text.splitlines()[0])
def test_every_line_of_the_tour_prints_what_is_below_it(text, monkeypatch):
    monkeypatch.setenv("COLUMNS", "110")

    follow(text)


def test_the_tour_has_five_stops():
    assert len(TOUR) == 5


def test_the_nodes_pass_their_own_test(tmp_path, monkeypatch):
    files = {
        code.split()[1]: code for kind, code in blocks(DOCS / "do" / "nodes.md") if kind == "py"
    }
    for name, code in files.items():
        (tmp_path / name).write_text(code, encoding="utf-8")
    monkeypatch.setenv("PYTHONPATH", str(Path(tftool.__file__).parents[1]))

    told = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "tftool.ros.pytest_plugin", "test_carrot.py"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )

    assert list(files) == ["carrot.py", "where.py", "test_carrot.py"]
    assert "1 passed" in told.stdout


def test_every_command_has_its_row():
    table = "\n".join(line for line in TEXT.splitlines() if line.startswith("|"))
    rows = set(re.findall(r"`tftool (\w+)", table))

    assert set(COMMANDS) <= rows


def test_the_two_commands_bring_their_own_environment():
    blocks = [block for kind, block in BLOCKS if kind == "sh" and "pip install" in block]

    assert [block.count("\n") for block in blocks] == [1, 1]
    assert all(re.match(r"python3 -m venv (--\S+ )?\.venv && ", block) for block in blocks)
    assert blocks[0].endswith(".venv/bin/tftool demo\n")
    assert blocks[1].endswith(".venv/bin/python -m tests\n")


def test_the_table_of_ros_packages_names_every_package_and_no_other():
    section = (DOCS / "reference" / "ros.md").read_text(encoding="utf-8")
    table = "\n".join(line for line in section.splitlines() if line.startswith("| `"))
    last = next(line for line in section.splitlines() if line.startswith("| interfaces"))
    packages = {name.partition(".")[0] for name in import_table.table()}

    assert packages <= set(re.findall(r"`(\w+)`", table)) <= packages | {"wait_for_message"}
    assert set(re.findall(r"`(\w+)`", last)) - {"src"} == set(Schema().packages())
