import contextlib
import io
import itertools
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

import tftool
from tftool.cli import app
from tftool.cli.app import main
from tftool.interfaces.schema import Schema
from tftool.ros.host import import_table

ROOT = Path(__file__).parents[1]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)
PROGRAMS = [
    (code, printed)
    for (kind, code), (after, printed) in itertools.pairwise(BLOCKS)
    if kind == "python" and after == "text"
]
LINES = [
    line.partition("#")[0].strip()
    for kind, block in BLOCKS
    if kind == "sh"
    for line in block.splitlines()
    if line.startswith("tftool ")
]


@pytest.mark.parametrize(("code", "printed"), PROGRAMS)
def test_every_program_prints_what_the_readme_says(code, printed):
    out = io.StringIO()

    with contextlib.redirect_stdout(out):
        exec(compile(code, "README.md", "exec"), {"__name__": "readme"})

    assert out.getvalue() == printed


def test_every_program_has_its_output_beside_it():
    assert len(PROGRAMS) == sum(kind == "python" for kind, _ in BLOCKS) > 0


@pytest.mark.parametrize("line", LINES)
def test_every_line_works(line, capsys):
    assert main(shlex.split(line)[1:]) == 0
    assert capsys.readouterr().out


def test_there_are_five_lines():
    assert len(LINES) == 5


def test_the_nodes_pass_their_own_test(tmp_path, monkeypatch):
    files = {code.split()[1]: code for kind, code in BLOCKS if kind == "py"}
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
    rows = set(re.findall(r"^\| `tftool (\w+)", TEXT, re.MULTILINE))

    assert set(app.COMMANDS) <= rows


def test_the_two_commands_bring_their_own_environment():
    blocks = [block for kind, block in BLOCKS if kind == "sh" and "pip install" in block]

    assert [block.count("\n") for block in blocks] == [1, 1]
    assert all(block.startswith("python3 -m venv .venv && ") for block in blocks)
    assert blocks[0].endswith(".venv/bin/tftool demo\n")
    assert blocks[1].endswith(".venv/bin/python -m tests\n")


def test_what_is_covered_names_every_package_and_no_other():
    section = TEXT.partition("### What is covered\n")[2].partition("\n###")[0]
    table = "\n".join(line for line in section.splitlines() if line.startswith("| `"))
    last = next(line for line in section.splitlines() if line.startswith("| interfaces"))
    packages = {name.partition(".")[0] for name in import_table.table()}

    assert packages <= set(re.findall(r"`(\w+)`", table)) <= packages | {"wait_for_message"}
    assert set(re.findall(r"`(\w+)`", last)) - {"src"} == set(Schema().packages())
