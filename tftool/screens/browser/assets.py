"""Files of the page in the package, and the browser's security policy for them."""

import gzip
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from importlib import resources

from tftool.base.errors import TftoolError

# Folder of each file: built files are in a separate one.
_FILES = {
    "index.html": ("page", "text/html; charset=utf-8"),
    "page.css": ("page", "text/css; charset=utf-8"),
    "icon.svg": ("page", "image/svg+xml"),
    "page.js": ("bundle", "text/javascript; charset=utf-8"),
    "unpack.js": ("bundle", "text/javascript; charset=utf-8"),
    "three-LICENSE.txt": ("bundle", "text/plain; charset=utf-8"),
}

SAFETY: Mapping[str, str] = {
    # Only our own files may be loaded, even if a frame's name injects HTML into the page.
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; "
        # A mesh may carry its own textures and buffers.
        "connect-src 'self' data: blob:; "
        "img-src 'self' data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
"""HTTP headers of every response."""


@dataclass(frozen=True)
class Asset:
    """File of the page, with its media type."""

    kind: str
    content: bytes

    @cached_property
    def compressed(self) -> bytes:
        """Content as gzip; compressed once, and always to the same bytes."""
        return gzip.compress(self.content, 6, mtime=0)


def load() -> dict[str, Asset]:
    """Read the page's files, and return each file by the URL path under which it is served.

    Raises:
        TftoolError: If the page was not built, which can happen in a source tree only.
    """
    here = resources.files("tftool.screens.browser")
    try:
        found = {
            f"/{name}": Asset(kind, (here / folder / name).read_bytes())
            for name, (folder, kind) in _FILES.items()
        }
    except FileNotFoundError as error:
        raise TftoolError(
            f"the page is not built: {error.filename} is missing; "
            "run `npm install --no-package-lock && npm run build` in tftool/screens/browser/page"
        ) from error
    return {"/": found["/index.html"], **found}
