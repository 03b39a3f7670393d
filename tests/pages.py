"""Code blocks of a page: command lines, programs, and their output."""

import contextlib
import io
import re
import shlex

from tftool.app.main import main


def blocks(page):
    """Return (language, text) of the code blocks of a page, in order."""
    text = page.read_text(encoding="utf-8")
    return re.findall(r"^```(\w+)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def printed(words):
    """Return the output of a command, mixed as on a terminal, and the exit status."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        status = main(words)
    return out.getvalue().splitlines(), status


def fits(found, wanted):
    """Return whether lines match those of a page, where … stands for omitted text.

    Within a line, … stands for the rest of the line; alone, for any number of lines.
    """
    if not wanted:
        return not found
    if wanted[0] == "…":
        return any(fits(found[at:], wanted[1:]) for at in range(len(found) + 1))
    if not found:
        return False
    start, dots, _ = wanted[0].partition("…")
    same = found[0].startswith(start) if dots else found[0].rstrip() == wanted[0].rstrip()
    return same and fits(found[1:], wanted[1:])


def said_by(program):
    """Return the output of a program."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(program, "page", "exec"), {"__name__": "page"})
    return out.getvalue()


def follow(text):
    """Run the lines that begin with $; check that each ends and prints as on the page."""
    for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        line, *wanted = part.splitlines()
        line, _, remark = line.partition("  # exit status ")
        found, status = printed(shlex.split(line)[1:])
        assert (line, status) == (line, int(remark or 0)), "\n".join(found)
        assert fits(found, wanted), f"{line}\n" + "\n".join(found)
