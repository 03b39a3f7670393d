"""The `tftool` command: one Typer app, and the one place where errors become exit statuses."""

import gc
import os
import sys

from tftool.base.exit_status import ExitStatus

# Nothing slow is imported up here: an interrupt before `main` has begun would be a traceback.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import FrameType

    from tftool.app.help_layout import Commands
    from tftool.commands.shared.connection import Providers


def build() -> "Commands":
    """Return the app; each command is built on first use, and imports only what it needs.

    The `obj` of the app's context holds the providers of clocks and links; None means the real
    ones.
    """
    from typing import Annotated, cast

    import typer
    from typer.main import get_command

    from tftool.app.help_layout import Commands

    app = typer.Typer(
        name="tftool",
        cls=Commands,
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
            bool, typer.Option("--version", "-V", help="Say which version this is, and stop.")
        ] = False,
        install: Annotated[
            bool,
            typer.Option(
                "--install-completion", help="Let Tab complete in the shell (bash, zsh, fish)."
            ),
        ] = False,
        show: Annotated[
            bool, typer.Option("--show-completion", help="Print the shell's script for that.")
        ] = False,
    ) -> None:
        """TF2 without ROS: learn coordinate frames with two turtles, and ask the same
        tool about a real robot.

        Start with 'tftool demo', then 'tftool echo turtle2 turtle1'.

        Exit status: 0 done; 1 an expectation or a node failed, or a check found something;
        2 wrong usage; 3 the input cannot be read; 4 the transform is not available;
        130 interrupted.
        """
        if version:
            from tftool import __version__
            from tftool.buffer.native_kernel import BUILD

            sys.stdout.write(f"tftool {__version__} ({BUILD})\n")
            raise typer.Exit
        if install or show:
            _set_up_completion(show=show)
            raise typer.Exit
        if context.invoked_subcommand is None:
            sys.stdout.write(context.get_help() + "\n")

    return cast(Commands, get_command(app))


def _set_up_completion(*, show: bool) -> None:
    """Install completion for this shell, or print the script that would be installed."""
    from tftool.app import completion

    shell = completion.shell_here()
    if show:
        sys.stdout.write(completion.SCRIPTS[shell])
        return
    files = " and ".join(str(path) for path in completion.install(shell))
    sys.stdout.write(f"Written: {files}. It works in every {shell} that starts now.\n")


def main(argv: "Sequence[str] | None" = None, providers: "Providers | None" = None) -> int:
    """Run the command and return its exit status; never raise for anything the user typed.

    Args:
        argv: The words after `tftool`; None for the words of this process.
        providers: Sources of clocks and links; None for the real ones.

    Returns:
        An `ExitStatus`, or the status of the program that `tftool run` ran.
    """
    status: int
    try:
        if argv is None:
            # Nothing that is made while starting is garbage; looking for it takes a tenth of
            # the time.
            gc.disable()
            _leave_on_signals()
            argv = sys.argv[1:]
        from tftool.base import (
            process_streams as streams,  # an interrupt in an import would be a traceback before
        )

        streams.prepare()
        if "_TFTOOL_COMPLETE" in os.environ:
            return _complete(list(argv))
        streams.require_descriptors()
        status = _run(list(argv), providers)
        sys.stdout.flush()
    except KeyboardInterrupt as interrupt:
        if interrupt.__cause__ is not None:
            # A node failed on the way out: that is said, and the run was interrupted all the same.
            _complain("tftool", str(interrupt.__cause__))
        status = ExitStatus.INTERRUPTED
    except BrokenPipeError:
        # The reader has seen enough (`| head -1`): that is no failure. Text still
        # buffered would be written at exit, so it goes nowhere.
        streams.forget_output()
        status = ExitStatus.DONE
    except MemoryError:
        _complain("tftool", "The memory that is left does not suffice for that.")
        status = ExitStatus.UNREADABLE
    except OSError as error:
        if isinstance(error, TimeoutError) and error.errno is None:
            # asyncio's own: an OSError by its family alone, and no output has gone wrong.
            _complain("tftool", f"{error or 'Something did not answer in time'}.")
            return ExitStatus.FAILED
        # Who opens a file answers for it; the rest is mostly stdout on a full disk.
        streams.forget_output()
        what = error.filename or "the output cannot be written"
        _complain("tftool", f"{what}: {error.strerror or error}.")
        status = ExitStatus.UNREADABLE
    return status


def _complete(argv: list[str]) -> int:
    """Print the completions of these words."""
    from tftool.app import completion

    completion.complete(argv, os.environ[completion.VARIABLE])
    sys.stdout.flush()
    return ExitStatus.DONE


def _leave_on_signals() -> None:
    """End the process at once on SIGINT and SIGTERM while no event loop runs.

    Before a command runs there is nothing to clean up, and an import may swallow a
    KeyboardInterrupt or show it as a traceback. An event loop installs its own handlers
    (`world.clock.run`), and restores the handlers of this function afterwards. Windows has no
    signals in the loop; Python's own handlers work there.

    During the interpreter's own shutdown, signals are ignored: Python has removed its handlers by
    then, and a second Ctrl-C would change an exit status that is already known.
    """
    import atexit
    import signal

    def ignore() -> None:
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, signal.SIG_IGN)

    def leave(_number: int, _frame: "FrameType | None") -> None:
        os._exit(ExitStatus.INTERRUPTED)

    if sys.platform != "win32":
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, leave)
        # The first one registered is called last.
        atexit.register(ignore)


def _run(argv: list[str], providers: "Providers | None") -> int:
    from typing import cast

    import typer

    from tftool.base import process_streams as streams
    from tftool.base.errors import InputError, TftoolError, TransformException, UsageError

    # typer carries its own click since 0.26: its base classes are reached through what it
    # exports, so that either kind is caught.
    wrong_usage = cast(type[Exception], typer.BadParameter.__mro__[1])
    try:
        commands = build()
        with commands.make_context("tftool", argv, obj=providers) as context:
            if not gc.isenabled():
                # A file of 100 KB can make 60,000 frames: with Python's own thresholds the
                # collector takes a fifth of the time and finds nothing.
                gc.freeze()
                gc.set_threshold(50_000, 20, 100)
                gc.enable()
            result = commands.invoke(context)
    except typer.Exit as done:
        return done.exit_code
    except typer.Abort:
        return ExitStatus.INTERRUPTED
    except wrong_usage as error:
        from tftool.app.usage_errors import sentence_of

        _complain(*sentence_of(error, argv))
        return ExitStatus.WRONG_USAGE
    except UsageError as error:
        _complain("tftool", str(error))
        return ExitStatus.WRONG_USAGE
    except InputError as error:
        _complain("tftool", str(error))
        return ExitStatus.UNREADABLE
    except TransformException as error:
        _complain("tftool", str(error))
        return ExitStatus.NO_TRANSFORM
    except TftoolError as error:
        if isinstance(error.__cause__, BrokenPipeError) and streams.has_no_reader():
            # A node of one's own prints, too, and its reader may have seen enough.
            raise error.__cause__ from None
        _complain("tftool", str(error))
        return ExitStatus.FAILED
    return result if isinstance(result, int) else ExitStatus.DONE


def _complain(who: str, sentence: str) -> None:
    from tftool.commands.shared.notices import complain

    complain(who, sentence)
