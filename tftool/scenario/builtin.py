"""The scenarios that come with tftool, and the way from a word on the command line to a file."""

import difflib
from pathlib import Path

from tftool.errors import InputError
from tftool.views.escaping import visible

_PACKAGE = Path(__file__).resolve().parents[1]

ENDINGS = (".yaml", ".yml")


def folder() -> Path:
    """Where the built-in scenarios are.

    A wheel carries them inside the package; in a checkout, also an editable
    install of one, they lie beside it.

    Raises:
        InputError: If they are in neither place.
    """
    for place in (_PACKAGE / "scenarios", _PACKAGE.parent / "scenarios"):
        if (place / "turtles.yaml").is_file():
            return place
    raise InputError(f"the built-in scenarios are missing beside {_PACKAGE}; install tftool again")


def names() -> list[str]:
    """The names of the built-in scenarios, sorted."""
    return sorted(path.stem for path in folder().glob("*.yaml"))


def find(name_or_path: str | Path) -> Path:
    """The file a word means: a built-in scenario's by its name, or the path itself.

    A built-in name wins; `./turtles` and `turtles.yaml` are paths.

    Raises:
        InputError: If there is neither.
    """
    word = str(name_or_path)
    path = Path(word)
    is_name = path.name == word and path.suffix not in ENDINGS
    if is_name and word in names():
        return folder() / f"{word}.yaml"
    try:
        if path.is_dir():
            raise InputError(f"'{visible(word)}' is a folder; give a scenario file in it")
        if path.exists() or not is_name:
            return path
    except (OSError, ValueError) as error:
        raise InputError(f"cannot read '{visible(word)}': {error}") from error
    near = difflib.get_close_matches(word.lower(), names(), n=1)
    hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(names())}."
    raise InputError(
        f"no scenario is named '{visible(word)}'; {hint} A path to a file does as well."
    )
