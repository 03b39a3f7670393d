"""Plain English in docstrings, comments and messages: what `python -m tests` refuses.

A docstring opens with a verb or a noun, not with a question word; refused phrases are listed
below. The comment `prose: ok` at the end of a line permits the line. Messages and the texts of the
doctor may say "what is"; the doctor's texts are checked by a separate table.
"""

import ast
import io
import re
import sys
import tokenize
from pathlib import Path

OPENERS = re.compile(r"(What|Those|That which|Which|Who|Whose|Where|When|How|Why|Likewise)\b")
DIALECT = re.compile(
    r"\b(lets? go of|[Ww]hat (stands|lies|hangs)|(is|are|was|were) (told|said) of"
    r"|told (of|whose))\b"
)
EXCEPTION = "prose: ok"
LONGEST_NAME = 80
# Docstrings of the doctor's checks are sentences for users, such as "What is sent to ...".
OPENINGS_FOR_USERS = re.compile(r"tftool/doctor/\w*_checks\.py$")


def faults(root: Path) -> list[str]:
    """Return a line for each fault in the package and in the names of its tests."""
    found = []
    for path in sorted((root / "tftool").rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        name = path.relative_to(root).as_posix()
        lines = text.split("\n")
        found += [
            f"{name}:{number}: {fault}"
            for number, fault in (*_openings(text, name), *_turns(text))
            if EXCEPTION not in lines[number - 1]
        ]
    for path in sorted((root / "tests").rglob("test_*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.FunctionDef) or not node.name.startswith("test_"):
                continue
            if len(node.name) > LONGEST_NAME:
                place = f"{path.relative_to(root).as_posix()}:{node.lineno}"
                found.append(f"{place}: the name of a test has {len(node.name)} letters")
    return found


def _openings(text: str, name: str) -> list[tuple[int, str]]:
    if OPENINGS_FOR_USERS.search(name):
        return []
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    return [
        (node.body[0].lineno, f"a docstring opens with '{found[0]}'")
        for node in ast.walk(ast.parse(text))
        if isinstance(node, documented)
        and (found := OPENERS.match(ast.get_docstring(node) or "")) is not None
    ]


def _turns(text: str) -> list[tuple[int, str]]:
    kinds = (tokenize.COMMENT, tokenize.STRING)
    found = []
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type in kinds:
            for offset, line in enumerate(token.string.split("\n")):
                if (match := DIALECT.search(line)) is not None:
                    found.append((token.start[0] + offset, f"'{match[0]}' has to be read twice"))
    return found


if __name__ == "__main__":
    told = faults(Path(__file__).resolve().parent.parent)
    print(*told, sep="\n" if told else "")  # noqa: T201
    sys.exit(1 if told else 0)
