"""The `tftool` command: one Typer app, and the one place where errors become exit statuses."""

import gc
import os
import sys
from enum import IntEnum

# Nothing slow is imported up here: an interrupt before `main` has begun would be a traceback.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from types import FrameType
    from typing import Any

    from tftool.cli.connection import Providers
    from tftool.cli.help import Commands

# As the help shows them, with what it says of each: reading that from the commands themselves
# would import them all. Each is a function of its own name in a module of that name.
GROUPS = {
    "Learn": {
        "demo": "Show turtle2 following turtle1.",
        "teleop": "Drive a turtle with the arrow keys.",
        "follow": "Let FOLLOWER follow LEADER (the tutorial's turtle_following).",
        "static": "Publish where CHILD is in PARENT (static_transform_publisher).",
    },
    "Ask": {
        "echo": "Print where SOURCE is in TARGET (ros2 run tf2_ros tf2_echo).",
        "tree": "Show which frame hangs from which (rqt_tf_tree, view_frames).",
        "monitor": "Show how often and how late transforms arrive (tf2_monitor).",
        "explain": "Say why a lookup refuses: which link, by how much.",
        "doctor": "Say what is wrong with the frames, and what mends it.",
        "convert": "Write one rotation, or pose, in every notation.",
        "ros2": "Ask a session in the words of ROS 2's command line, without ROS.",
    },
    "Look": {
        "view": "Show the frames in 3-D, in a browser (rviz2 with its TF display).",
        "plot": "Plot where SOURCE is in TARGET over time.",
        "robot": "Bring a robot description alive (robot_state_publisher).",
    },
    "Work with files": {
        "info": "Show what a recording or robot description holds.",
        "play": "Play a recording as a live session (ros2 bag play).",
        "record": "Record a session (ros2 bag record).",
        "export": "Write a pair over time, or links, to files of other tools.",
        "diff": "Say what differs between two sets of frames, link by link.",
        "edit": "Change the frames of a recording; repair, join, cut or convert it.",
    },
    "Run your own nodes": {
        "new": "Make a package of nodes to begin with (ros2 pkg create).",
        "run": "Run a node written for ROS 2, unmodified, without ROS (ros2 run).",
        "launch": "Launch what a ROS 2 launch file says, without ROS (ros2 launch).",
        "session": "Show who shares the session that runs here.",
    },
    "Check": {
        "check": "Play scenarios on simulated time and judge what they expect.",
    },
    "Help": {
        "help": "Show the list of commands, or the help of one (man).",
    },
}
"""What the help says of each command, by what one wants."""

COMMANDS = {name: summary for group in GROUPS.values() for name, summary in group.items()}

# What differs from click's reading of a command line.
SETTINGS = {
    # A frame may lie at a negative place: -1 is a number there, not an option.
    "static": {"ignore_unknown_options": True},
    # Nor is it one in a rotation; static_transform_publisher's own options may be pasted, too.
    "convert": {"ignore_unknown_options": True},
    # What follows a node's file is the node's own.
    "run": {"allow_interspersed_args": False},
    # And what follows these words are ROS 2's own options.
    "ros2": {"allow_interspersed_args": False},
}

ALONE = ("check", "convert", "edit", "help", "new")
"""Commands that share no session."""


DESCRIBING = ("echo", "tree", "view", "info", "robot", "export", "diff", "explain")
"""Commands whose FROM may be a robot description."""


RECORDED_ROBOTS = ("echo", "tree", "view", "info", "doctor", "export", "diff")
"""Commands whose FROM may be a recording without the description of its robot."""


RECORDED = ("demo", "echo", "explain", "export", "info", "monitor", "play", "plot", "tree", "view")
"""Commands whose FROM may be a recording."""


class ExitStatus(IntEnum):
    """The exit status of a command."""

    DONE = 0
    FAILED = 1
    """An expectation or a node failed, or a check found something."""
    WRONG_USAGE = 2
    UNREADABLE = 3
    """The input cannot be read."""
    NO_TRANSFORM = 4
    """The transform is not available."""
    INTERRUPTED = 130


def build() -> "Commands":
    """Give the app; a command is made when it is asked for, and imports what it needs.

    The `obj` of its context says where clocks and links come from; the real ones when None.
    """
    from typing import Annotated, cast

    import typer
    from typer.main import get_command

    from tftool.cli.help import Commands

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
            from tftool.frames.native import BUILD

            sys.stdout.write(f"tftool {__version__} ({BUILD})\n")
            raise typer.Exit
        if install or show:
            from tftool.cli import completion

            shell = completion.shell_here()
            if show:
                sys.stdout.write(completion.SCRIPTS[shell])
            else:
                files = " and ".join(str(path) for path in completion.install(shell))
                sys.stdout.write(f"Written: {files}. It works in every {shell} that starts now.\n")
            raise typer.Exit
        if context.invoked_subcommand is None:
            sys.stdout.write(context.get_help() + "\n")

    return cast(Commands, get_command(app))


def load(name: str, providers: "Providers | None") -> "Callable[..., Any]":
    """Import a command, and give it all its options."""
    from importlib import import_module

    from tftool.cli.connection_options import (
        RECORDING_OPTIONS,
        ROBOT_OPTIONS,
        URDF_OPTION,
        with_connection,
    )

    command: Callable[..., Any] = getattr(import_module(f"tftool.cli.commands.{name}"), name)
    if name in ALONE:
        return command
    options = {
        **(ROBOT_OPTIONS if name in DESCRIBING else {}),
        **(URDF_OPTION if name in RECORDED_ROBOTS else {}),
        **(RECORDING_OPTIONS if name in RECORDED else {}),
    }
    return with_connection(command, providers, options)


def main(argv: "Sequence[str] | None" = None, providers: "Providers | None" = None) -> int:
    """Run the command and give its exit status; never raises for what a user did.

    Args:
        argv: The words after `tftool`; those of the process when None.
        providers: Where clocks and links come from; the real ones when None.

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
        from tftool.cli import streams  # an interrupt in an import would be a traceback before

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
        # The reader has seen enough (`| head -1`): that is no failure. What is still
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
        # Who opens a file answers for it; what is left is mostly stdout on a full disk.
        streams.forget_output()
        what = error.filename or "the output cannot be written"
        _complain("tftool", f"{what}: {error.strerror or error}.")
        status = ExitStatus.UNREADABLE
    return status


def _complete(argv: list[str]) -> int:
    """Print what the shell may offer behind these words."""
    from tftool.cli import completion

    completion.complete(argv, os.environ[completion.VARIABLE])
    sys.stdout.flush()
    return ExitStatus.DONE


def _leave_on_signals() -> None:
    """Let SIGINT and SIGTERM end the process at once while no event loop runs.

    There is nothing to clean up then, and a KeyboardInterrupt that strikes inside an
    import may be swallowed there, or shown as a traceback. A loop brings its own
    handlers (`runtime.clock.run`), and gives these back. On Windows it has none, and
    Python's own do.

    Once nothing is left but the interpreter's own end, signals are ignored: it takes
    Python's handlers away first, and a second Ctrl-C would change a status that is known.
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
        # What is registered first is called last.
        atexit.register(ignore)


def _run(argv: list[str], providers: "Providers | None") -> int:
    from typing import cast

    import typer

    from tftool.cli import streams
    from tftool.errors import InputError, TftoolError, TransformException, UsageError

    # typer carries its own click since 0.26: its base classes are reached through what it
    # exports, so that either kind is caught.
    wrong_usage = cast(type[Exception], typer.BadParameter.__mro__[1])
    try:
        commands = build()
        with commands.make_context("tftool", argv, obj=providers) as context:
            gc.enable()
            result = commands.invoke(context)
    except typer.Exit as done:
        return done.exit_code
    except typer.Abort:
        return ExitStatus.INTERRUPTED
    except wrong_usage as error:
        from tftool.cli.misusing import sentence_of

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
    from tftool.cli.notices import complain

    complain(who, sentence)
