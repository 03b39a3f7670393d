"""Tests that randomly changed files in a workspace are read, skipped or refused."""

import random

import pytest

from tftool.base.errors import TftoolError
from tftool.messages.classes import INTERFACES
from tftool.ros.host import parameter_files
from tftool.ros.host.workspace import Workspace

SOUND = {
    "package.xml": "<?xml version='1.0'?>\n<package><name>mutant_msgs</name></package>\n",
    "setup.py": (
        "from glob import glob\nfrom setuptools import setup\nname = 'mine'\n"
        "setup(name=name, data_files=[('share/' + name, glob('launch/*'))],\n"
        "      entry_points={'console_scripts': [f'go = {name}.node:main']})\n"
    ),
    "setup.cfg": "[metadata]\nname = mine\n[options.entry_points]\nconsole_scripts =\n  go = m:f\n",
    "pyproject.toml": "[project]\nname = 'mine'\n[project.scripts]\ngo = 'mine.node:main'\n",
    "msg/One.msg": 'uint8 KIND=3\nfloat64[<=4] numbers\nstring text "hello"\nOne[] others\n',
    "srv/Ask.srv": "string question\n---\nbool answer\n",
    "p.yaml": (
        "/**:\n  ros__parameters: &all\n    speed: 1.5\n    names: [a, b]\n"
        "talker:\n  ros__parameters:\n    <<: *all\n    nested: {deep: {deeper: .inf}}\n"
    ),
}
PIECES = [
    "\0",
    "\xff",
    "{",
    "[",
    "]",
    ":",
    "&a ",
    "*a",
    "<<: ",
    "---",
    "!!timestamp x",
    "'",
    '"',
    "-",
]
PIECES += [
    "(",
    ")",
    "\n",
    "\t",
    "  ",
    "1e999",
    "0x",
    "[[[[" * 200,
    "-" * 5000,
    "999999999999999999",
]


def mutant(text, chance):
    data = list(text)
    for _ in range(chance.randint(1, 6)):
        place = chance.randrange(len(data) + 1)
        match chance.randrange(4):
            case 0:
                del data[place : place + chance.randint(1, 8)]
            case 1:
                data[place:place] = chance.choice(PIECES)
            case 2:
                data[place:place] = data[: chance.randint(1, 40)]
            case 3:
                del data[place:]
    return "".join(data).encode("latin-1" if chance.random() < 0.2 else "utf-8", "replace")


def read(name):
    """Create the class of an interface, as an import does."""
    folder, _, file = name.partition("/")
    if file:
        INTERFACES.find("mutant_msgs", folder, file.partition(".")[0])


@pytest.mark.parametrize("name", SOUND)
def test_a_mutant_of_a_workspaces_file_is_read_skipped_or_refused(name, tmp_path):
    chance = random.Random(name)
    judged = 0
    for _ in range(60):
        path = tmp_path / "src" / "mine" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "src" / "mine" / "package.xml").write_text(SOUND["package.xml"])
        path.write_bytes(mutant(SOUND[name], chance))
        try:
            if name == "p.yaml":
                parameter_files.read_parameters(path)
            else:
                Workspace(tmp_path)
                read(name)
        except TftoolError:
            pass
        judged += 1

    assert judged == 60
