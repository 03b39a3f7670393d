"""The `tftool` command: one Typer app, and the one place where errors become exit statuses."""

import os
import signal
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import cache
from inspect import cleandoc
from types import FrameType
from typing import TYPE_CHECKING, Annotated, Any, cast

if TYPE_CHECKING:
    import typer

DONE = 0
FAILED = 1
WRONG_USAGE = 2
UNREADABLE = 3
NO_TRANSFORM = 4
INTERRUPTED = 130


@cache
def build() -> "typer.Typer":
    """Give the app with every command; what a command needs is imported when it runs."""
    # Imported here and not above, so that a Ctrl-C this early ends as quietly as any other.
    import typer

    app = typer.Typer(
        name="tftool",
        # Help in plain text: rich would cost more than everything else at start-up.
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        add_completion=False,
        context_settings={"help_option_names": ["-h", "--help"]},
    )

    @app.callback(invoke_without_command=True)
    def tftool(
        context: typer.Context,
        version: Annotated[
            bool, typer.Option("--version", help="Say which version this is, and stop.")
        ] = False,
    ) -> None:
        """TF2 without ROS: learn coordinate frames with two turtles, and ask the same
        tool about a real robot.

        Start with 'tftool demo', then 'tftool echo turtle2 turtle1'.
        """
        if version:
            from tftool import __version__

            sys.stdout.write(f"tftool {__version__}\n")
            raise typer.Exit
        if context.invoked_subcommand is None:
            sys.stdout.write(context.get_help() + "\n")

    from tftool.cli.check import check
    from tftool.cli.demo import demo
    from tftool.cli.echo import echo
    from tftool.cli.follow import follow
    from tftool.cli.monitor import monitor
    from tftool.cli.static import static
    from tftool.cli.teleop import teleop
    from tftool.cli.tree import tree
    from tftool.cli.view import view

    for command in (demo, teleop, echo, static, tree, follow, monitor, view, check):
        # A frame may lie at a negative place: -1 is a number there, not an option.
        takes_numbers = {"ignore_unknown_options": True} if command is static else None
        app.command(help=_laid_out(command), context_settings=takes_numbers)(command)
    return app


def _laid_out(command: Callable[..., Any]) -> str:
    """The docstring of a command as its help; examples keep their lines."""
    paragraphs = cleandoc(command.__doc__ or "").split("\n\n")
    # The mark by which click leaves a paragraph as it is.
    return "\n\n".join(f"\b\n{one}" if one.startswith("tftool ") else one for one in paragraphs)


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command and give its exit status; never raises for what a user did.

    Args:
        argv: The words after `tftool`; those of the process when None.

    Returns:
        0 done; 1 an expectation or a node failed; 2 wrong usage; 3 the input cannot
        be read; 4 the transform is not available; 130 interrupted.
    """
    for stream in (sys.stdout, sys.stderr):
        # A name that the terminal cannot show is shown as an escape, not as an error.
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    previous = _interrupt_on(signal.SIGTERM)
    try:
        status = _run(sys.argv[1:] if argv is None else list(argv))
        sys.stdout.flush()
    except KeyboardInterrupt:
        status = INTERRUPTED
    except BrokenPipeError:
        # The reader has seen enough (`| head -1`): that is no failure. What is still
        # buffered would be written at exit, so it goes nowhere.
        with suppress(OSError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        status = DONE
    finally:
        if previous is not None:
            signal.signal(signal.SIGTERM, previous)
    return status


def _interrupt_on(number: signal.Signals) -> Any:
    """Let a signal end the command as Ctrl-C does; None where signals are not ours to set."""

    def interrupt(_number: int, _frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    try:
        return signal.signal(number, interrupt)
    except ValueError:  # not the main thread
        return None


def _run(argv: list[str]) -> int:
    import typer
    from typer.main import get_command

    from tftool.errors import InputError, TftoolError, TransformException, UsageError

    # typer carries its own click since 0.26: its base classes are reached through what it
    # exports, so that either kind is caught.
    wrong_usage = cast(type[Exception], typer.BadParameter.__mro__[1])
    try:
        command = get_command(build())
        with command.make_context("tftool", argv) as context:
            result = command.invoke(context)
    except typer.Exit as done:
        return done.exit_code
    except typer.Abort:
        return INTERRUPTED
    except wrong_usage as error:
        _complain(*_usage_sentence(error))
        return WRONG_USAGE
    except UsageError as error:
        _complain("tftool", str(error))
        return WRONG_USAGE
    except InputError as error:
        _complain("tftool", str(error))
        return UNREADABLE
    except TransformException as error:
        _complain("tftool", str(error))
        return NO_TRANSFORM
    except TftoolError as error:
        _complain("tftool", str(error))
        return FAILED
    return result if isinstance(result, int) else DONE


def _usage_sentence(error: Any) -> tuple[str, str]:
    context = getattr(error, "ctx", None)
    command = context.command_path if context is not None else "tftool"
    return command, f"{error.format_message()} Try '{command} --help'."


def _complain(who: str, sentence: str) -> None:
    from tftool.views.escaping import visible_lines

    sys.stdout.flush()
    sys.stderr.write(f"{who}: {visible_lines(sentence.rstrip())}\n")
