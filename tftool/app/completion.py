"""Completion in the shell: words offered at Tab, such as commands, options, frames, packages.

The shell's script runs `tftool` with the words typed so far and `_TFTOOL_COMPLETE` set; each
printed line is a proposal. Completion neither hosts nor joins a session. The frames of a running
session are read from files that the processes of the session write.
"""

import contextlib
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tftool.app.index import COMMANDS
from tftool.base.errors import InputError, TftoolError, UsageError
from tftool.scenario import builtin

if TYPE_CHECKING:
    from tftool.ros.host.package_files import Package

VARIABLE: Final = "_TFTOOL_COMPLETE"
"""Environment variable that the scripts set to the name of the shell."""

BEHIND: Final = "_TFTOOL_COMPLETE_BEHIND"
"""Environment variable with the words after the typed one, one per line.

fish's script does not set it: while it completes,
fish's `commandline` ends with the typed word."""

SCRIPTS: Final = {
    "bash": """\
_tftool() {
    local IFS=$'\\n'
    COMPREPLY=($(_TFTOOL_COMPLETE=bash _TFTOOL_COMPLETE_BEHIND="${COMP_WORDS[*]:COMP_CWORD+1}" \\
        tftool "${COMP_WORDS[@]:1:$COMP_CWORD}" 2>/dev/null))
}
complete -o default -F _tftool tftool
""",
    "zsh": """\
autoload -Uz compinit
(( $+functions[compdef] )) || compinit
_tftool() {
    local -a offered
    local behind="${(F)words[CURRENT+1,-1]}"
    offered=("${(@f)$(_TFTOOL_COMPLETE=zsh _TFTOOL_COMPLETE_BEHIND="$behind" \\
        tftool "${(@)words[2,$CURRENT]}" 2>/dev/null)}")
    if [[ -n "${offered[1]}" ]]; then _describe tftool offered; else _files; fi
}
compdef _tftool tftool
""",
    "fish": """\
function __tftool_complete
    _TFTOOL_COMPLETE=fish tftool (commandline -opc)[2..] (commandline -ct) 2>/dev/null
end
complete -c tftool -a '(__tftool_complete)'
""",
}
"""Completion script of each shell, which the shell runs once when it starts."""

FRAMES: Final = {"TARGET", "SOURCE", "A", "B", "FRAME", "LEADER", "PARENT", "CHILD"}
"""Names that the help gives to values that are names of frames."""

SOURCES: Final = {"FROM", "SCENARIO"}
"""Names that the help gives to values that may be a built-in scenario or a file."""

CHECK_IDS: Final = {"ID", "FINDING"}
"""Names that the help gives to values that are ids of the doctor's checks."""

Offer = tuple[str, str]
"""Word to offer, and its description; "" for none."""


def complete(words: Sequence[str], shell: str) -> None:
    """Print the completions of a command line in the format of the shell's completion script.

    Args:
        words: Words after `tftool`; the last word is still being typed.
        shell: Name of the shell: bash, zsh or fish.
    """
    offered: Sequence[Offer] = ()
    with contextlib.suppress(TftoolError, OSError, ValueError):
        offered = offers(words or [""])
    for word, about in offered:
        # Names with line breaks, quotes or escapes are not offered.
        if not word.isprintable() or any(letter in word for letter in " '\"\\$`"):
            continue
        sys.stdout.write(_line(word, about.partition("\n")[0], shell) + "\n")


def _line(word: str, about: str, shell: str) -> str:
    if shell == "bash" or not about:
        return word.replace(":", "\\:") if shell == "zsh" else word
    return f"{word.replace(':', chr(92) + ':')}:{about}" if shell == "zsh" else f"{word}\t{about}"


def offers(words: Sequence[str]) -> list[Offer]:
    """Return the completions of a command line, in the order to show them.

    Args:
        words: Words after `tftool`; the last word is still being typed.
    """
    *before, current = words
    if not before:
        root = {**COMMANDS, **dict.fromkeys(("--version", "--help", "--install-completion"), "")}
        wanted: list[Offer] = [(word, root[word]) for word in root if _is_plain(word, current)]
    elif before[0] == "help":
        wanted = list(COMMANDS.items())
    elif before[0] in COMMANDS:
        wanted = list(_command_offers(before[0], before[1:], current))
    else:
        wanted = []
    return [offer for offer in wanted if offer[0].startswith(current)]


def _is_plain(word: str, current: str) -> bool:
    """Return whether to offer `word`: after a typed dash only options, else only other words."""
    return word.startswith("-") == current.startswith("-")


def _command_offers(name: str, before: Sequence[str], current: str) -> Iterator[Offer]:
    """Yield the completions for a word of one command.

    Args:
        name: Name of the command.
        before: Words between the command and the word being typed.
        current: Beginning of the word being typed.
    """
    from tftool.app.command_line import build_command

    params = build_command(name).params
    options = {one: param for param in params for one in (*param.opts, *param.secondary_opts)}
    arguments = [param for param in params if param.param_type_name == "argument"]
    if before and (option := options.get(before[-1])) is not None and _takes_value(option):
        yield from _values(option.type, _value_name(option), before)
        return
    if current.startswith("-"):
        for param in params:
            if param.param_type_name == "option" and not getattr(param, "hidden", False):
                yield max(param.opts, key=len), param.help or ""
        return
    place = _count(before, options)
    if name in _WORDS:
        yield from _WORDS[name](before[-place:] if place else [])
    called = [word for param in arguments for word in _value_name(param).split()]
    if called:
        last = min(place, len(called) - 1)
        repeats = called[-1].endswith("...") or called[-1].endswith("…")
        if place < len(called) or repeats:
            kind = arguments[min(place, len(arguments) - 1)].type
            yield from _values(kind, called[last], before)


def _takes_value(option: Any) -> bool:
    return not (getattr(option, "is_flag", False) or getattr(option, "count", False))


def _count(before: Sequence[str], options: dict[str, Any]) -> int:
    """Count the words in `before` that are neither options nor values of options."""
    words, is_value = 0, False
    for word in before:
        if is_value:
            is_value = False
        elif word in options:
            is_value = _takes_value(options[word])
        elif not word.startswith("-"):
            words += 1
    return words


def _value_name(param: Any) -> str:
    """Return the name that the help gives to a parameter's value, such as FRAME."""
    return str(param.metavar or "")


def _values(kind: Any, value_name: str, before: Sequence[str]) -> Iterator[Offer]:
    """Yield the completions of a value.

    Args:
        kind: Type of the parameter in click.
        value_name: Name of the value in the help, such as FRAME.
        before: Words before the value.
    """
    bare = value_name.strip("[]{}<>.…")
    choices = getattr(kind, "choices", None)
    if choices is not None:
        yield from ((str(getattr(one, "value", one)), "") for one in choices)
    elif bare in FRAMES:
        yield from ((name, "") for name in _frames(before))
    elif bare in SOURCES:
        yield from ((name, "scenario") for name in builtin.names())
    elif bare.partition(",")[0] in CHECK_IDS:
        from tftool.doctor.judge import CHECKS

        yield from ((one.id, one.summary) for one in CHECKS.values())
    elif bare == "STEP":
        from tftool.commands.new import EXAMPLES

        yield from ((step, "") for step in EXAMPLES)


def _frames(before: Sequence[str]) -> list[str]:
    """Return the frame names of the file on the command line, or else of the running session."""
    named = _frames_of_a_file([*_following_words(), *before])
    if named is not None:
        return named
    from tftool.world.link.link_options import REACHES, domain_here

    domain = domain_here()
    if "--domain" in before[:-1]:
        domain = int(before[before.index("--domain") + 1])
    return REACHES[0].frames_known(domain)


def _following_words() -> list[str]:
    """Return the words after the word being typed, which often include FROM."""
    return os.environ.get(BEHIND, "").split("\n")


def _frames_of_a_file(words: Sequence[str]) -> list[str] | None:
    """Return the frames of the first readable file among the words; None without such a file."""
    for word in words:
        # Unlike `Path.expanduser`, this does not raise for an unknown user.
        path = Path(os.path.expanduser(word))
        if not word or word.startswith("-") or not path.exists():
            continue
        with contextlib.suppress(InputError, UsageError, OSError, ValueError):
            return _read_frames(str(path))
    return None


def _read_frames(word: str) -> list[str]:
    """Return the frame names of a recording or a description.

    For a long recording, only the column cache is read; without this cache, the result is empty.

    Raises:
        UsageError: If the word names a scenario.
    """
    from tftool.recordings import cache_heads, find

    found = find.find(word)
    if found.kind is find.Kind.DESCRIPTION:
        from tftool.robots.robot_model import load_urdf

        return list(load_urdf(word).links)
    if not found.kind.is_recording:
        raise UsageError("the frames of a scenario are only known while the scenario runs")
    kept = cache_heads.frames_kept(found)
    if kept is None and not cache_heads.key_of(found):
        from tftool.recordings import column_cache, recording

        with recording.open_recording(word) as opened:
            kept = sorted({name for edge in opened.edges for name in (edge.parent, edge.child)})
            folder = cache_heads.default_folder()
            if folder is not None:
                key = cache_heads.key_of(found, any_size=True)
                column_cache.ColumnCache(folder).store(key, opened.transforms)
    return kept or []


def _offered_of_package(
    before: Sequence[str], names_in: Callable[["Package"], Iterable[str]]
) -> Iterator[Offer]:
    """Yield the ROS packages below the current folder, or names of a typed package.

    Args:
        before: Words that were typed after the command.
        names_in: Function that returns the names to offer after the name of a package.
    """
    from tftool.ros.host.workspace import Workspace

    packages = Workspace(Path.cwd()).packages
    if not before:
        yield from ((name, "package") for name in sorted(packages))
    elif len(before) == 1 and before[0] in packages:
        yield from ((name, "") for name in sorted(names_in(packages[before[0]])))


def _launch_files(package: "Package") -> Iterator[str]:
    """Yield the names of the launch files of a package."""
    yield from (path.name for path in (package.path / "launch").glob("*launch.*"))


def _ros2(before: Sequence[str]) -> Iterator[Offer]:
    """Yield the commands of `ros2`, or the verbs of a typed command."""
    from tftool.ros.ros2.ros2_words import verbs

    if len(before) < 2:
        known = verbs()
        yield from ((word, "") for word in (known.get(before[0], []) if before else known))


_WORDS: Final[dict[str, Callable[[Sequence[str]], Iterator[Offer]]]] = {
    "ros2": _ros2,
    "run": lambda before: _offered_of_package(before, lambda package: package.scripts),
    "launch": lambda before: _offered_of_package(before, _launch_files),
}
"""Function that completes the words of a command: packages, launch files, verbs of ROS 2."""


def shell_here() -> str:
    """Return the name of the user's shell, from $SHELL.

    Raises:
        UsageError: If there is no completion script for this shell.
    """
    name = Path(os.environ.get("SHELL", "")).name
    if name not in SCRIPTS:
        raise UsageError(
            f"tftool has no completion script for the shell '{name or 'unknown'}' (variable "
            f"SHELL), only for {', '.join(SCRIPTS)}: 'SHELL=bash tftool --show-completion' prints "
            "bash's script."
        )
    return name


def install(shell: str) -> list[Path]:
    """Install the completion script of a shell; keep other text in the shell's start-up file.

    Returns:
        Files that were written or changed.

    Raises:
        InputError: If a file cannot be written.
    """
    try:
        home = Path.home()
    except RuntimeError:
        raise InputError(
            "The variable HOME is not set, and this user has no home: set HOME to a writable "
            "folder."
        ) from None
    if shell == "fish":
        settings = Path(os.environ.get("XDG_CONFIG_HOME") or home / ".config")
        script, start = settings / "fish" / "completions" / "tftool.fish", None
    else:
        data = Path(os.environ.get("XDG_DATA_HOME") or home / ".local" / "share")
        script, start = data / "tftool" / f"completion.{shell}", home / f".{shell}rc"
    changed = [script]
    try:
        script.parent.mkdir(parents=True, exist_ok=True)
        script.write_text(SCRIPTS[shell], encoding="utf-8")
        if start is not None:
            line = f'[ -f "{script}" ] && . "{script}"  # tftool'
            text = start.read_text(encoding="utf-8") if start.exists() else ""
            if line not in text.splitlines():
                with start.open("a", encoding="utf-8") as file:
                    file.write(f"{'' if text.endswith(chr(10)) or not text else chr(10)}{line}\n")
                changed.append(start)
    except OSError as error:
        raise InputError(f"'{error.filename}' cannot be written: {error.strerror}.") from None
    return changed
