"""Command `tftool`: general options, and conversion of errors to exit statuses.

Each command is a typer app, which is created when the command is called, so that no other command
is imported.
"""

import atexit
import codecs
import errno
import gc
import os
import sys

from tftool import __version__
from tftool.base.exit_status import ExitStatus

# No slow imports here: Ctrl-C before `main` starts would print a traceback.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import FrameType

    from tftool.commands.shared.connection import Providers


_WRITTEN_PLAINLY = "tftool.plain"
_PLAIN = {
    **dict(zip("─━│┃├└┤●▸×−·↑↓█░²", "--|||`|*>x-|^v#:2", strict=True)),
    "→": "->",
    "←": "<-",
    "…": "...",
    "°": "deg",
    "π": "pi",
    "±": "+-",
}
"""ASCII replacement of each of tftool's symbols, for encodings that lack the symbol."""

RUNS_PROGRAMS = frozenset({"run", "launch", "ros2", "check"})
"""Commands that run users' programs, whose numpy may use all processors."""

DESCRIPTORS = 32
"""Most files and sockets that a command may need open at the same time."""


def _set_up_completion(*, show: bool) -> None:
    """Install the completion script for the user's shell; with `show`, only print the script."""
    from tftool.app import completion

    shell = completion.shell_here()
    if show:
        sys.stdout.write(completion.SCRIPTS[shell])
        return
    files = " and ".join(str(path) for path in completion.install(shell))
    sys.stdout.write(f"Written: {files}. Completion works in every new {shell}.\n")


def main(argv: "Sequence[str] | None" = None, providers: "Providers | None" = None) -> int:
    """Run `tftool` and return the exit status; never raise for wrong input of the user.

    Args:
        argv: Words after `tftool`; None for this process's arguments.
        providers: Functions that create clocks and connections to processes; None except in tests.

    Returns:
        An `ExitStatus`, or the exit status of the program that `tftool run` ran.
    """
    status: int
    is_own = argv is None
    try:
        if argv is None:
            # Nothing created during the start is garbage, and collecting takes a tenth of
            # the time.
            gc.disable()
            _leave_on_signals()
            argv = sys.argv[1:]
        _prepare_streams()
        if "_TFTOOL_COMPLETE" in os.environ:
            return _complete(list(argv))
        _require_descriptors()
        status = _run(list(argv), providers)
        sys.stdout.flush()
        if is_own:
            # The end of the process frees all memory. Without this, Python would search it for
            # garbage first, which takes a tenth of the time of a short command.
            gc.freeze()
    except KeyboardInterrupt as interrupt:
        if interrupt.__cause__ is not None:
            # A node failed while it was stopped: print its error; the run counts as interrupted.
            _complain("tftool", str(interrupt.__cause__))
        status = ExitStatus.INTERRUPTED
    except BrokenPipeError:
        # The pipe's reader has ended (`| head -1`), which is no failure. Text that is still
        # buffered would be written at exit, so it is discarded.
        _forget_output()
        status = ExitStatus.DONE
    except MemoryError:
        _complain("tftool", "There is not enough memory left for this command.")
        status = ExitStatus.UNREADABLE
    except OSError as error:
        if isinstance(error, TimeoutError) and error.errno is None:
            # asyncio's timeout, which is an OSError only by inheritance, not failed output.
            _complain("tftool", f"{error or 'An answer did not arrive in time'}.")
            return ExitStatus.FAILED
        # Functions that open files handle their errors; what remains is mostly stdout.
        _forget_output()
        what = error.filename or "the output cannot be written"
        _complain("tftool", f"{what}: {error.strerror or error}.")
        status = ExitStatus.UNREADABLE
    return status


def _complete(argv: list[str]) -> int:
    """Print the completions of a command line, when called by a shell's completion script."""
    from tftool.app import completion

    completion.complete(argv, os.environ[completion.VARIABLE])
    sys.stdout.flush()
    return ExitStatus.DONE


def _leave_on_signals() -> None:
    """End the process at once on SIGINT and SIGTERM while no event loop runs.

    Before a command runs there is nothing to clean up, and an import may swallow a
    KeyboardInterrupt or show a traceback. An event loop installs other handlers
    (`world.clock.run`), and restores these handlers afterwards. On Windows, an event loop receives
    no signals, and Python's own handlers stay in use.

    During the interpreter's shutdown, signals are ignored: Python has removed the handlers by then,
    and a second Ctrl-C would change the exit status.
    """
    import signal

    def ignore() -> None:
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, signal.SIG_IGN)

    def leave(_number: int, _frame: "FrameType | None") -> None:
        os._exit(ExitStatus.INTERRUPTED)

    if sys.platform != "win32":
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, leave)
        # The function that is registered first is called last.
        atexit.register(ignore)


def _run(argv: list[str], providers: "Providers | None") -> int:
    from tftool.base.errors import InputError, TftoolError, TransformException, UsageError

    try:
        rest = _own_options(argv)
        if rest is None:
            return ExitStatus.DONE
        if rest[:1] and rest[0] not in RUNS_PROGRAMS:
            # numpy's BLAS starts a thread for each processor, and each thread first spends a tenth
            # of a second in a waiting loop. The matrices of tftool's own commands need one thread.
            os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
        from tftool.app.command_line import run_command

        return run_command(rest, providers)
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
        if isinstance(error.__cause__, BrokenPipeError) and _has_no_reader():
            # A user's node may print to a pipe whose reader has ended.
            raise error.__cause__ from None
        _complain("tftool", str(error))
        return ExitStatus.FAILED


def _own_options(words: list[str]) -> list[str] | None:
    """Process the options before the name of a command, such as --version.

    Returns:
        The command and the words after the command; None if only options were given.

    Raises:
        UsageError: If an option does not exist.
    """
    from tftool.app.index import OPTIONS, overview, show_help

    known = {name: names[0] for names in OPTIONS for name in names}
    asked: list[str] = []
    rest = list(words)
    while rest and rest[0].startswith("-") and rest[0] != "-":
        word = rest.pop(0)
        if word == "--":
            break
        if word not in known:
            from tftool.app.command_line import unknown_option

            raise unknown_option(word, known)
        asked.append(known[word])
    if "--help" in asked or not (asked or rest):
        show_help(overview())
    elif "--version" in asked:
        from tftool.buffer.native_kernel import BUILD

        sys.stdout.write(f"tftool {__version__} ({BUILD})\n")
    elif asked:
        _set_up_completion(show="--install-completion" not in asked)
    else:
        return rest
    return None


def _complain(who: str, sentence: str) -> None:
    from tftool.commands.shared.notices import complain

    complain(who, sentence)


# The process's streams


def _prepare_streams() -> None:
    """Ensure that stdout and stderr are open, and can print every character."""
    codecs.register_error(_WRITTEN_PLAINLY, _replace_character)
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:  # closed by the parent process
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        elif hasattr(stream, "reconfigure"):
            stream.reconfigure(errors=_WRITTEN_PLAINLY)


def _replace_character(error: UnicodeError) -> tuple[str | bytes, int]:
    """Encode a character that the encoding of a stream lacks; for `codecs.register_error`.

    Symbols that tftool prints become ASCII, other characters become backslash escapes.

    Returns:
        The replacement, and the position after the character.
    """
    if not isinstance(error, UnicodeEncodeError):
        raise error
    char = error.object[error.start]
    if char in _PLAIN:
        return _PLAIN[char], error.start + 1
    return char.encode("ascii", "backslashreplace").decode(), error.start + 1


def _require_descriptors() -> None:
    """Raise an error if this process may open fewer than `DESCRIPTORS` further files.

    Some libraries crash when the limit of open files is reached.

    Raises:
        OSError: If too few files may be opened; the error text names the remedy.
    """
    probes: list[int] = []
    try:
        while len(probes) < DESCRIPTORS:
            probes.append(os.dup(2))
    except OSError as error:
        if error.errno == errno.EBADF:  # no stderr to duplicate
            return
        raise OSError(
            error.errno,
            f"tftool needs {DESCRIPTORS} files and sockets, and may open only {len(probes)} more; "
            "'ulimit -n 256' raises this limit",
            "too few file descriptors",
        ) from None
    finally:
        for probe in probes:
            os.close(probe)


def _has_no_reader() -> bool:
    """Return whether stdout is a pipe that no process reads."""
    import select

    if not hasattr(select, "poll"):
        return True
    watched = select.poll()
    try:
        watched.register(sys.stdout.fileno(), 0)
    except (OSError, ValueError):  # stdout without a file descriptor
        return False
    return any(event & select.POLLERR for _, event in watched.poll(0))


def _forget_output() -> None:
    """Discard the text that is buffered for stdout."""
    from contextlib import suppress

    with suppress(OSError, ValueError):  # stdout without a file descriptor
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
