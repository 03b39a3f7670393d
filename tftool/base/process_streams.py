"""Standard streams that can print any text, and report failed writes."""

import codecs
import errno
import os
import sys
from contextlib import suppress

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
"""What tftool's own signs are on a terminal, or in a file, whose encoding lacks them."""

DESCRIPTORS = 32
"""Files and sockets that a command may come to need at once."""


def prepare() -> None:
    """Ensure that stdout and stderr exist and accept any text."""
    codecs.register_error(_WRITTEN_PLAINLY, _written_plainly)
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:  # closed by what started us
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        elif hasattr(stream, "reconfigure"):
            stream.reconfigure(errors=_WRITTEN_PLAINLY)


def _written_plainly(error: UnicodeError) -> tuple[str | bytes, int]:
    """Encode characters that an encoding lacks: tftool's own signs as ASCII, others as escapes."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    char = error.object[error.start]
    if char in _PLAIN:
        return _PLAIN[char], error.start + 1
    return char.encode("ascii", "backslashreplace").decode(), error.start + 1


def require_descriptors() -> None:
    """Raise the limit of open files if few are left; some libraries crash at the limit.

    Raises:
        OSError: If the limit cannot be raised; the message names the remedy.
    """
    probes: list[int] = []
    try:
        while len(probes) < DESCRIPTORS:
            probes.append(os.dup(2))
    except OSError as error:
        if error.errno == errno.EBADF:  # no stderr, so nothing to try it with
            return
        raise OSError(
            error.errno,
            f"tftool needs {DESCRIPTORS} files and sockets, and may open only {len(probes)} more; "
            "ulimit -n 256 raises that",
            "too few file descriptors",
        ) from None
    finally:
        for probe in probes:
            os.close(probe)


def has_no_reader() -> bool:
    """Whether stdout is a pipe without a reader."""
    import select

    if not hasattr(select, "poll"):
        return True
    watched = select.poll()
    try:
        watched.register(sys.stdout.fileno(), 0)
    except (OSError, ValueError):  # a stdout that is no file has no number
        return False
    return any(event & select.POLLERR for _, event in watched.poll(0))


def forget_output() -> None:
    """Discard the text buffered for stdout."""
    with suppress(OSError, ValueError):  # a stdout that is no file has no number
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
