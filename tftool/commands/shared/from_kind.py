"""What FROM names, by its content: a scenario, a recording, a robot description."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from tftool.base.errors import InputError, UsageError
from tftool.base.escaping import visible
from tftool.recordings.find import Found, Kind, find, names_a_path

if TYPE_CHECKING:
    from tftool.scenario.scenario import Scenario


def named(word: str) -> Found:
    """What a word on the command line names.

    A built-in scenario's name wins; `./turtles` and `turtles.yaml` are paths.

    Raises:
        InputError: If it names nothing, or nothing we read.
    """
    from tftool.scenario import builtin

    path = builtin.path_of(word)
    if path is not None:
        return Found(word, Kind.SCENARIO, (path,))
    if builtin.is_like_a_name(word) and not names_a_path(word):
        raise InputError(builtin.unknown(word))
    return find(word)


def scenario_named(word: str, arguments: Mapping[str, str] | None = None) -> "Scenario":
    """The scenario a word names, read.

    Args:
        word: A built-in scenario's name, or a file.
        arguments: Values for arguments it declares.

    Raises:
        InputError: If there is none, or it cannot be read.
        UsageError: If the word names something else, or an argument is not declared.
    """
    from tftool.scenario.load import load

    found = named(word)
    if found.kind is not Kind.SCENARIO:
        raise UsageError(f"'{visible(word)}' is {kind_in_words(found)}: a scenario is needed here.")
    return load(found.paths[0], arguments or {})


def kind_in_words(found: Found) -> str:
    """What FROM names, with its article."""
    if found.kind is Kind.SEVERAL:
        return "several recordings"
    article = "an" if found.kind is Kind.MCAP else "a"
    return f"{article} {found.kind.value}" + (" recording" if found.kind.is_recording else "")


def kind_word(found: Found) -> str:
    """What FROM names, in a word: whatever is recorded is a recording."""
    return "recording" if found.kind.is_recording else found.kind.value
