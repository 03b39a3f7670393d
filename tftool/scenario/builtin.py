"""Built-in scenarios: their names and files."""

from pathlib import Path

from tftool.base.errors import InputError
from tftool.base.plain_text import near_names, visible

PACKAGE = Path(__file__).resolve().parents[1]
"""Folder of the package; scenarios and examples are in it or, in a checkout, beside it."""


def folder() -> Path:
    """Return the folder of the built-in scenarios.

    Raises:
        InputError: If the scenarios are missing.
    """
    return shipped("scenarios", "turtles.yaml")


def shipped(name: str, required_file: str) -> Path:
    """Return the folder `name` of tftool's own files, which must contain `required_file`.

    In an installed wheel, the folder is inside the package. In a source checkout or an editable
    install, the folder is beside the package.

    Raises:
        InputError: If the folder is missing.
    """
    for place in (PACKAGE / name, PACKAGE.parent / name):
        if (place / required_file).exists():
            return place
    raise InputError(f"the built-in {name} are missing beside {PACKAGE}: install tftool again")


def names() -> list[str]:
    """Return the names of the built-in scenarios, sorted."""
    return sorted(path.stem for path in folder().glob("*.yaml"))


def abouts() -> list[tuple[str, str]]:
    """Return (name, description) of every built-in scenario."""
    from tftool.scenario.load import load

    return [(path.stem, load(path, {}).about) for path in sorted(folder().glob("*.yaml"))]


def path_of(name: str) -> Path | None:
    """Return the file of a built-in scenario; None for other names.

    `./turtles` and `turtles.yaml` are paths, not names.
    """
    return folder() / f"{name}.yaml" if name in names() else None


def is_shipped(path: Path) -> bool:
    """Return whether a file is a built-in scenario, whose expectations are tested by tftool."""
    return path.parent == folder()


def unknown(word: str) -> str:
    """Return the error text for a word that is neither a built-in scenario nor a file."""
    near = near_names(word, names())
    hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(names())}."
    shown = visible(word)
    shown = f"{shown[:60]}…" if len(shown) > 60 else shown
    return f"no scenario is named '{shown}'; {hint} The path of a scenario file is also allowed."
