"""Built-in scenarios: names and files."""

from pathlib import Path

from tftool.base.errors import InputError
from tftool.base.escaping import visible
from tftool.base.near_names import near_names

PACKAGE = Path(__file__).resolve().parents[1]
"""Where tftool is; its scenarios and examples are in it or, in a checkout, beside it."""


def folder() -> Path:
    """Return the folder of the built-in scenarios.

    Raises:
        InputError: If the scenarios are missing.
    """
    return shipped("scenarios", "turtles.yaml")


def shipped(name: str, mark: str) -> Path:
    """Return the folder shipped with tftool that contains a file or folder named `mark`.

    A wheel carries it inside the package; in a checkout, also an editable install of one,
    it lies beside it.

    Raises:
        InputError: If the file is in neither place.
    """
    for place in (PACKAGE / name, PACKAGE.parent / name):
        if (place / mark).exists():
            return place
    raise InputError(f"the built-in {name} are missing beside {PACKAGE}; install tftool again")


def names() -> list[str]:
    """Return the names of the built-in scenarios, sorted."""
    return sorted(path.stem for path in folder().glob("*.yaml"))


def abouts() -> list[tuple[str, str]]:
    """Return every built-in scenario's description, by name."""
    from tftool.scenario.load import load

    return [(path.stem, load(path, {}).about) for path in sorted(folder().glob("*.yaml"))]


def path_of(name: str) -> Path | None:
    """Return the file of a built-in scenario; None for other names.

    `./turtles` and `turtles.yaml` are paths, not names.
    """
    return folder() / f"{name}.yaml" if name in names() else None


def is_shipped(path: Path) -> bool:
    """Whether a file is a built-in scenario, whose expectations are known to be right."""
    return path.parent == folder()


def unknown(word: str) -> str:
    """Return the sentence about a word that is neither a built-in scenario nor a file."""
    near = near_names(word, names())
    hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(names())}."
    shown = visible(word)
    shown = f"{shown[:60]}…" if len(shown) > 60 else shown
    return f"no scenario is named '{shown}'; {hint} A path to a file does as well."
