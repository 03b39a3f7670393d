"""Parsing of a command line by typer, with help grouped by subject and short errors."""

import gc
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from difflib import SequenceMatcher
from inspect import cleandoc
from itertools import pairwise
from typing import TYPE_CHECKING, Any, cast

import typer
from typer.core import TyperCommand, TyperOption
from typer.main import get_command

from tftool.app.index import COMMANDS, load, show_help
from tftool.app.main import main
from tftool.base.errors import UsageError
from tftool.base.exit_status import ExitStatus
from tftool.commands.shared.declaration import (
    POSE_OPTIONS,
    SESSION_OPTIONS,
    Command,
    Invocation,
    typer_function,
)
from tftool.commands.shared.notices import complain
from tftool.commands.shared.options import argument
from tftool.recordings.poses.pose_options import collect, names_file, pose_options

if TYPE_CHECKING:
    from tftool.commands.shared.connection import Providers


_SESSION = "help_session"
_ARGUMENT = re.compile(r"[A-Za-z_]\w*:=")

PLAINLY = (
    (r"is not a valid int( range)?\b", "is not a whole number"),
    (r"is not a valid float( range)?\b", "is not a number"),
    (r"is not in the range (\S+)<=x<=(\S+?)\.?$", r"is not between \1 and \2."),
    (r"is not in the range x>=(\S+?)\.?$", r"is less than \1."),
    (r"(?<![.?])$", "."),
)
"""Patterns of click's technical error texts, each with a replacement in plain words."""

UNLIKE = 0.5
"""Least similarity, from 0 to 1, of a word that is suggested for a mistyped word."""


def run_command(words: Sequence[str], providers: "Providers | None" = None) -> int:
    """Run the command named by the first word, and return the exit status.

    Raises:
        UsageError: If there is no such command.
        TftoolError: Any error that the command raises.
    """
    name, *rest = words
    if name not in COMMANDS:
        raise UsageError(_did_you_mean(f"No such command '{name}'", name, COMMANDS, "'"))
    # Since 0.26, typer contains a copy of click: its base classes are found through typer's
    # classes, so that the errors of either version are caught.
    wrong_usage = cast(type[Exception], typer.BadParameter.__mro__[1])
    command = build_command(name)
    invocation = Invocation(providers, lambda words: run_command(words, providers))
    try:
        with command.make_context(f"tftool {name}", rest, obj=invocation) as context:
            if not gc.isenabled():
                # A file of 100 KB can create 60,000 frames: with Python's default thresholds, the
                # collector takes a fifth of the time and finds nothing.
                gc.freeze()
                gc.set_threshold(50_000, 20, 100)
                gc.enable()
            status = command.invoke(context)
    except typer.Exit as done:
        return done.exit_code
    except typer.Abort:
        return ExitStatus.INTERRUPTED
    except wrong_usage as error:
        complain(f"tftool {name}", f"{_sentence_of(error)} Try 'tftool {name} --help'.")
        return ExitStatus.WRONG_USAGE
    return status if isinstance(status, int) else ExitStatus.DONE


def unknown_option(word: str, options: Iterable[str]) -> UsageError:
    """Return the error for an unknown option before the name of a command, with similar options."""
    return UsageError(_did_you_mean(f"No such option: {word}", word, options))


def _did_you_mean(refusal: str, word: str, known: Iterable[str], quote: str = "") -> str:
    near = " or ".join(f"{quote}{one}{quote}" for one in _similar_words(word, known))
    meant = f" Did you mean {near}?" if near else ""
    return f"{refusal}.{meant} Try 'tftool --help'."


def _sentence_of(error: Any) -> str:
    """Return the text of a click error in plain words, with suggestions for a mistyped option."""
    sentence: str = error.format_message()
    near = [one for one in getattr(error, "possibilities", None) or () if "help" not in one]
    if hasattr(error, "possibilities"):
        sentence = error.message
        near = _similar_words(str(getattr(error, "option_name", "")), near)
    if near:
        # click sorts the suggestions alphabetically; here the most similar is first.
        sentence = f"{error.message.rstrip('.')}. Did you mean {' or '.join(near)}?"
    for pattern, words in PLAINLY:
        sentence = re.sub(pattern, words, sentence)
    return sentence


def _similar_words(mistyped: str, candidates: Iterable[str]) -> list[str]:
    """Return the candidates that are similar to a mistyped word, the most similar first."""

    def likeness_of(one: str) -> float:
        # The first letter is rarely mistyped.
        same = one.lstrip("-")[:1] == mistyped.lstrip("-")[:1]
        return SequenceMatcher(None, mistyped, one).ratio() + 0.1 * same

    likeness = {one: likeness_of(one) for one in candidates}
    best = max(likeness.values(), default=0.0)
    return sorted(
        (one for one in candidates if likeness[one] > max(best - 0.1, UNLIKE)),
        key=lambda one: -likeness[one],
    )


def build_command(name: str) -> Any:
    """Build the typer command called `name`, with all options."""
    command = load(name)
    # Help in plain text, because importing rich takes longer than the rest of the start.
    app = typer.Typer(rich_markup_mode=None, add_completion=False)
    settings = {"help_option_names": ["-h", "--help"], **command.kind.settings}
    text = _help_text(command.__doc__ or "")
    app.command(name, cls=LaidOutCommand, help=text, context_settings=settings)(
        typer_function(command)
    )
    return get_command(app)


def _help_text(docstring: str) -> str:
    """Return the help text made from a docstring; examples keep their line breaks."""
    paragraphs = cleandoc(docstring).split("\n\n")
    # \b tells click not to wrap a paragraph.
    return "\n\n".join(f"\b\n{one}" if one.startswith("tftool ") else one for one in paragraphs)


class LaidOutCommand(TyperCommand):
    """Command whose help groups options by subject; --help-session adds session options."""

    def __init__(self, name: str | None, **words: Any) -> None:
        super().__init__(name, **words)
        if any(param.name in SESSION_OPTIONS for param in self.params):
            self.params.append(_help_session())

    def parse_args(self, ctx: Any, args: list[str]) -> Any:
        """Parse the command line.

        A word NAME:=VALUE becomes --argument NAME:=VALUE. Each option for pose files is stored
        with the file before the option.
        """
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
        if any(param.name in POSE_OPTIONS for param in self.params):
            ctx.meta[_POSES] = list(self._pose_options(args))
        return super().parse_args(ctx, args)

    def _pose_options(self, args: list[str]) -> "Iterator[tuple[str | None, str, Any]]":
        """Yield (preceding file, name of the option, value) for each option for pose files.

        The file is None if no file precedes the option.
        """
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
        """Run the command; each option for pose files applies to the file before the option."""
        given = ctx.meta.get(_POSES)
        if not given:
            return super().invoke(ctx)
        with pose_options(collect(given)):
            return super().invoke(ctx)

    def get_help(self, ctx: Any) -> str:
        """Print the help, and raise `typer.Exit` to end the command."""
        show_help(super().get_help(ctx))
        raise typer.Exit

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write the command's arguments and options, grouped below headings."""
        sections: dict[str, list[tuple[str, str]]] = {"Arguments": [], "Options": []}
        for param in self.get_params(ctx):
            title = _title(param)
            if title == SESSION and not ctx.meta.get(_SESSION):
                continue
            record = param.get_help_record(ctx)
            if record is not None:
                sections.setdefault(title, []).append(record)
        # Options that every command has are last.
        sections["Help"] = sections.pop("Help", [])
        for title, rows in sections.items():
            if rows:
                with formatter.section(title):
                    formatter.write_dl(rows)


def _number(word: str) -> float:
    """Parse a number; return NaN for other text, which `parse_args` then rejects."""
    try:
        return float(word)
    except ValueError:
        return math.nan


_POSES = "tftool.pose_options"
"""Key of the pose files' options in a context's `meta`."""

SESSION = "Session and network"


def _title(param: Any) -> str:
    """Return the heading in the help under which a parameter is listed."""
    if param.param_type_name == "argument":
        return "Arguments"
    if param.name in ("help", _SESSION):
        return "Help"
    if param.name in SESSION_OPTIONS:
        return SESSION
    return getattr(param, "rich_help_panel", None) or "Options"


def _help_session() -> Any:
    """Return the option --help-session, which also lists the options of sessions in the help."""

    def show(ctx: Any, param: Any, value: bool) -> None:
        if value:
            ctx.meta[_SESSION] = True
            ctx.get_help()

    return TyperOption(
        param_decls=["--help-session", _SESSION],
        is_flag=True,
        expose_value=False,
        is_eager=True,
        callback=show,
        help=f"Show this help with the options for {SESSION.lower()}.",
    )


class HelpOptions(Command, shares=False):
    """Show the list of commands, or the help of one command (man).

    tftool help
    tftool help echo
    """

    name: str | None = argument("Command to explain.", metavar="[COMMAND]")


def run(options: HelpOptions) -> ExitStatus:
    """Run `tftool help`: print the list of commands, or the help of one command."""
    return ExitStatus(main(["--help"] if options.name is None else [options.name, "--help"]))
