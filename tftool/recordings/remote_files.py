"""Remote recordings, which `fsspec` copies to a temporary folder for reading."""

import os
import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tftool.base.errors import InputError, UsageError

_URL = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*(?:::.*)?://")


def is_url(word: str) -> bool:
    """Whether a word is a URL: `s3://bucket/run.mcap`, `https://…`."""
    return _URL.match(word) is not None and not os.path.lexists(word)


@contextmanager
def fetched(place: str) -> Iterator[str]:
    """Yield a local path to a recording; a URL is copied to a temporary folder.

    Args:
        place: A local path, which is returned unchanged, or a URL.

    Raises:
        InputError: If there is no such file, or it cannot be fetched.
        UsageError: If fsspec is not installed.
    """
    if not is_url(place):
        yield place
        return
    with tempfile.TemporaryDirectory(prefix="tftool-") as folder:
        system, path = _opened(place)
        # Keep the name, because it shows the order of a recording's parts.
        name = path.rstrip("/").rpartition("/")[2] or "recording"
        own = os.path.join(folder, re.sub(r"[^\w.-]", "_", name))
        with _failures_told(place):
            if system.isdir(path):
                system.get(path.rstrip("/") + "/", own + os.sep, recursive=True)
            else:
                system.get_file(path, own)
        yield own


def listed(place: str) -> list[str]:
    """Return the files that a URL with `*`, `?` or `[…]` names; other words stay unchanged.

    Raises:
        InputError: If the word names nothing, or a folder cannot be listed.
        UsageError: If fsspec is not installed.
    """
    system, path = _opened(place)
    web = place.lower().startswith(("http:", "https:"))
    # In a web address, "?" begins a query.
    if not re.search(r"[*\[]" if web else r"[*?\[]", path):
        return [place]
    with _failures_told(place):
        found = sorted(system.glob(path))
    if not found:
        raise InputError(f"'{place}' names no file.")
    return [system.unstrip_protocol(one) for one in found]


def _opened(place: str) -> tuple[Any, str]:
    try:
        import fsspec
    except ImportError:
        raise UsageError(
            f"Fetching '{place}' needs an extra: pip install 'tftool-tf2[fleet]'"
        ) from None
    with _failures_told(place):
        system, path = fsspec.core.url_to_fs(place)
    return system, path


@contextmanager
def _failures_told(place: str) -> Iterator[None]:
    """Convert a remote service's errors to tftool's, with the URL, in a `with` block."""
    try:
        yield
    except FileNotFoundError as error:
        raise InputError(f"There is nothing at '{place}'.") from error
    except ImportError as error:
        # fsspec's error names the missing packages.
        raise UsageError(f"'{place}' needs more than the extra 'fleet': {error}") from error
    except Exception as error:
        said = " ".join(str(error).split()) or type(error).__name__
        raise InputError(f"'{place}' cannot be fetched: {said}") from error
