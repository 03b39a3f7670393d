"""Layout of help: commands by purpose, options by subject."""

import math
import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from inspect import cleandoc
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import typer
from typer.core import TyperCommand, TyperGroup, TyperOption
from typer.main import get_command

from tftool.app.index import COMMANDS, GROUPS, load

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Providers

_SESSION = "help_session"
_ARGUMENT = re.compile(r"[A-Za-z_]\w*:=")


class Shown:
    """Base of commands whose help is coloured on a terminal and paged if longer than the screen.

    Used for a command and for the list of commands.
    """

    def get_help(self, ctx: Any) -> str:
        """Return the help text, or show it in a pager and end the command."""
        # The class beside this one in a base list makes the text.
        text: str = super().get_help(ctx)  # type: ignore[misc]
        if not sys.stdout.isatty() or os.environ.get("TERM") == "dumb":
            return text
        is_long = text.count("\n") + 2 > shutil.get_terminal_size().lines
        if not os.environ.get("NO_COLOR"):
            text = painted(text)
        if is_long and sys.stdin.isatty():
            _page(text)
            ctx.exit()
        return text


def _page(text: str) -> None:
    """Show a text in the user's pager, else in less; print it if there is no pager."""
    import shlex

    command = shlex.split(os.environ.get("PAGER") or "less")
    if shutil.which(command[0]) is None:
        sys.stdout.write(f"{text}\n")
        return
    # Ctrl-C is the pager's: if this process ended before it, the shell and the pager would
    # both read the keyboard.
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        # Colours as they are; the text stays on the screen after q.
        environment = {"LESS": "-RX", **os.environ}
        subprocess.run(command, input=f"{text}\n", text=True, env=environment, check=False)
    finally:
        signal.signal(signal.SIGINT, before)


_HEADING = re.compile(r"^(\S[^:\n]*:)$", re.MULTILINE)
_NAME = re.compile(r"^(  )((?:-[^ ]|\[|[A-Z]).*?|[a-z][\w-]*)(?=\s{2,}\S|$)", re.MULTILINE)
_EXAMPLE = re.compile(r"^(  tftool .*)$", re.MULTILINE)


def painted(text: str) -> str:
    """Colour headings, names of options and commands, and examples."""
    head, colon, lists = text.partition("\n\nArguments:")
    for title in ("Options", *GROUPS):
        if not colon:
            head, colon, lists = text.partition(f"\n\n{title}:")
    lists = _NAME.sub("\\1\x1b[36m\\2\x1b[0m", colon + lists)
    text = _EXAMPLE.sub("\x1b[32m\\1\x1b[0m", head) + lists
    return _HEADING.sub("\x1b[1;33m\\1\x1b[0m", text).replace("Usage:", "\x1b[1mUsage:\x1b[0m", 1)


class Commands(Shown, TyperGroup):
    """The `tftool` command, whose help lists its commands by group.

    A command is built when it is needed: building all commands takes longer than starting Python
    twice.
    """

    def list_commands(self, ctx: Any) -> list[str]:
        """List the names of the commands."""
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Build a command by name; return None for an unknown name."""
        return made(cmd_name, ctx.obj) if cmd_name in COMMANDS else None

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write the groups of commands."""
        width = max(len(name) for name in COMMANDS)
        for title, group in GROUPS.items():
            with formatter.section(title):
                formatter.write_dl([(name.ljust(width), words) for name, words in group.items()])


def made(name: str, providers: "Providers | None" = None) -> Any:
    """Build one command with all its options."""
    declaration = load(name)
    command = declaration.with_options(providers)
    app = typer.Typer(rich_markup_mode=None, add_completion=False)
    settings = dict(declaration.settings)
    app.command(name, cls=Command, help=_laid_out(command), context_settings=settings)(command)
    return get_command(app)


def _laid_out(command: Callable[..., Any]) -> str:
    """Format a command's docstring as its help; examples keep their line breaks."""
    paragraphs = cleandoc(command.__doc__ or "").split("\n\n")
    # The mark by which click leaves a paragraph as it is.
    return "\n\n".join(f"\b\n{one}" if one.startswith("tftool ") else one for one in paragraphs)


class Command(Shown, TyperCommand):
    """A command that groups its options by subject, and lists session options only on request."""

    def __init__(self, name: str | None, **words: Any) -> None:
        super().__init__(name, **words)
        if any(_is_of_session(param) for param in self.params):
            self.params.append(_help_session())

    def parse_args(self, ctx: Any, args: list[str]) -> Any:
        """Parse the command line; a word like NAME:=VALUE is an argument of a robot description."""
        if any(param.name == "argument" for param in self.params):
            args = [
                part
                for before, word in pairwise(["", *args])
                for part in (
                    ("--argument", word)
                    if _ARGUMENT.match(word) and before != "--argument"
                    else (word,)
                )
            ]
        ctx.meta[_POSES] = list(self._pose_options(args))
        return super().parse_args(ctx, args)

    def _pose_options(self, args: list[str]) -> "Iterator[tuple[str | None, str, Any]]":
        """Collect the options of each pose file: the file before the option, its name and its
        value.
        """
        from tftool.commands.shared.declaration import POSE_OPTIONS
        from tftool.recordings.poses.pose_options import names_file

        options = {one: param for param in self.params for one in param.opts if one[0] == "-"}
        file: str | None = None
        words = iter(args)
        for word in words:
            flag, equals, value = word.partition("=")
            param = options.get(flag) if flag.startswith("-") else None
            if param is not None:
                taken: Any = True
                if not getattr(param, "is_flag", False):
                    taken = value if equals else next(words, "")
                if param.name in POSE_OPTIONS:
                    yield file, param.name, _number(taken) if param.name == "pose_rate" else taken
            elif names_file(word):
                file = word

    def invoke(self, ctx: Any) -> Any:
        """Run the command; the options behind a pose file apply to that file only."""
        given = ctx.meta.get(_POSES)
        if not given:
            return super().invoke(ctx)
        from tftool.recordings.poses.pose_options import collect, pose_options

        with pose_options(collect(given)):
            return super().invoke(ctx)

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write the arguments, then the options by their headings."""
        sections: dict[str, list[tuple[str, str]]] = {"Arguments": [], "Options": []}
        for param in self.get_params(ctx):
            title = _title(param)
            if title == SESSION and not ctx.meta.get(_SESSION):
                continue
            record = param.get_help_record(ctx)
            if record is not None:
                sections.setdefault(title, []).append(record)
        # What every command has goes last.
        sections["Help"] = sections.pop("Help", [])
        for title, rows in sections.items():
            if rows:
                with formatter.section(title):
                    formatter.write_dl(rows)


def _number(word: str) -> float:
    """Parse a number; return invalid text unchanged, for the parser to refuse."""
    try:
        return float(word)
    except ValueError:
        return math.nan


_POSES = "tftool.pose_options"
"""Under which name a context keeps the options of pose files."""

SESSION = "Session and network"


def _title(param: Any) -> str:
    """Return the heading under which a parameter is listed."""
    if param.param_type_name == "argument":
        return "Arguments"
    if _is_of_session(param):
        return SESSION
    if param.name in ("help", _SESSION):
        return "Help"
    return getattr(param, "rich_help_panel", None) or "Options"


def _is_of_session(param: Any) -> bool:
    if param.name in ("help", _SESSION):
        return False
    # The list of commands does without it: it describes none of them.
    from tftool.commands.shared.declaration import SESSION_OPTIONS

    return param.name in SESSION_OPTIONS


def _help_session() -> Any:
    """Return the option that shows the help including the options of sessions."""

    def show(ctx: Any, param: Any, value: bool) -> None:
        if value:
            ctx.meta[_SESSION] = True
            typer.echo(ctx.get_help())
            ctx.exit()

    return _option(show, ["--help-session"], f"Show this and the options of {SESSION.lower()}.")


def _option(callback: Callable[..., None], names: Sequence[str], text: str) -> Any:
    return TyperOption(
        param_decls=[*names, _SESSION],
        is_flag=True,
        expose_value=False,
        is_eager=True,
        callback=callback,
        help=text,
    )
