"""Text files of people, read with their limits: what is no text is told with its place."""

from pathlib import Path

from tftool.base.errors import InputError
from tftool.base.escaping import visible
from tftool.base.named_files import open_named
from tftool.scenario import document


def text_of(path: Path | str) -> str:
    """The text of a file, not more of it than can be a scenario.

    Raises:
        InputError: If it cannot be read, or is no UTF-8.
    """
    try:
        with open_named(Path(path)) as file:
            raw = file.read(4 * document.LARGEST + 1)
    except OSError as error:
        raise InputError(
            f"cannot read '{visible(str(path))}': {error.strerror or error}"
        ) from error
    except ValueError as error:
        raise InputError(f"cannot read '{visible(str(path))}': {error}") from error
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError as error:
        line = raw[: error.start].count(b"\n") + 1
        raise InputError(
            f"'{visible(str(path))}' is not UTF-8 text: byte {error.start + 1}, in line {line}"
        ) from error
