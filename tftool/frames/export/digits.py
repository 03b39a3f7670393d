"""Fast formatting of millions of numbers, with four decimal digits per table lookup, in numpy.

A block of rows becomes one array of bytes with equal space for every number; unused bytes are
removed at the end. A number is scaled to a multiple of its last decimal, and rounded only once.
"""

from collections.abc import Sequence
from typing import Final, TypeAlias

import numpy as np
import numpy.typing as npt

from tftool.frames.export.export_formats import DECIMALS

Floats: TypeAlias = npt.NDArray[np.float64]
Words: TypeAlias = npt.NDArray[np.uint32]
Stamps: TypeAlias = npt.NDArray[np.int64]

FULL: Final = 17
"""Number of decimals from which a number is written as the shortest text that reads back equal."""

BLOCK: Final = 4096
"""Number of rows formatted together; their text fits into the processor's cache."""

_SCALE: Final = 10**DECIMALS
_LARGEST: Final = 9.0e9
_FOUR: Final = 10_000


def _table(texts: Sequence[bytes]) -> Words:
    return np.frombuffer(b"".join(text.ljust(4, b"\0") for text in texts), dtype=np.uint32)


_PLAIN: Final = _table([b"%04d" % n for n in range(_FOUR)])
_LEADING: Final = _table([b"%d" % n for n in range(_FOUR)])
# Zeros before the first digit become unused bytes.
_LEADING_OR_NOTHING: Final = np.where(np.arange(_FOUR) == 0, 0, _LEADING).astype(np.uint32)
_POINT: Final = _table([b".%d" % n for n in range(10)])


def rows(
    numbers: Floats, *, stamps: Stamps | None = None, seconds: bool = False, separator: str = ","
) -> bytes:
    """Return the text of a block of rows, one line each, with nine decimals per number.

    Args:
        numbers: Finite numbers below 9e9, shape (n, k).
        stamps: Stamps for the beginning of rows, nanoseconds, shape (n,); None for no stamps.
        seconds: Whether stamps are written as seconds with nine decimals, not as nanoseconds.
        separator: Character between numbers.
    """
    scaled = np.rint(np.abs(numbers) * _SCALE).astype(np.int64)
    scaled = np.where(numbers < 0.0, -scaled, scaled)
    parts = []
    if stamps is not None:
        parts.append(_decimals(stamps[:, np.newaxis], b"") if seconds else _whole(stamps))
    between = separator.encode("ascii")
    if stamps is None:
        parts.append(_decimals(scaled[:, :1], b""))
        scaled = scaled[:, 1:]
    parts.append(_decimals(scaled, between))
    parts.append(np.broadcast_to(_table([b"\n"]), (len(numbers), 1)))
    text = np.concatenate(parts, axis=1).view(np.uint8).ravel()
    written: bytes = text[text != 0].tobytes()
    return written


def fits(numbers: Floats) -> bool:
    """Whether `rows` can format these numbers; else use `exact_rows`."""
    # Comparisons with NaN are false, so NaN does not fit.
    return bool((np.abs(numbers) < _LARGEST).all())


def exact_rows(
    numbers: Floats,
    decimals: int,
    *,
    stamps: Stamps | None = None,
    seconds: bool = False,
    separator: str = ",",
) -> bytes:
    """Return the text of rows with any number of decimals; slower than `rows`. See `FULL`."""
    lines = []
    for place, row in enumerate(numbers.tolist()):
        words = [_shortest(one) if decimals >= FULL else f"{one:.{decimals}f}" for one in row]
        if stamps is not None:
            stamp = int(stamps[place])
            words.insert(0, stamp_text(stamp) if seconds else str(stamp))
        lines.append(separator.join(words))
    return "".join(f"{line}\n" for line in lines).encode("ascii")


def stamp_text(stamp: int) -> str:
    """Format a stamp as seconds with nine decimals, without floating point."""
    whole, rest = divmod(abs(stamp), _SCALE)
    return f"{'-' if stamp < 0 else ''}{whole}.{rest:09}"


def _shortest(number: float) -> str:
    text = repr(number)
    # Some readers do not support exponents: write 1e-09 with decimals.
    return text if "e" not in text or "inf" in text else f"{number:.30f}".rstrip("0")


def _whole(values: Stamps) -> Words:
    """Return the text of whole numbers, shape (n,), as words of four digits, shape (n, w)."""
    return _digits(values[:, np.newaxis], b"")[:, 0]


def _decimals(scaled: npt.NDArray[np.int64], before: bytes) -> Words:
    """Return the text of scaled numbers, shape (n, k), as words of four digits, shape (n, k·w)."""
    count, width = scaled.shape
    size = np.abs(scaled)
    whole = size // _SCALE
    rest = size - whole * _SCALE
    upper = rest // _FOUR
    first = upper // _FOUR
    text = np.concatenate(
        [
            _digits(whole, before, negative=scaled < 0),
            np.stack(
                [
                    _POINT[first],
                    _PLAIN[upper - first * _FOUR],
                    _PLAIN[rest - upper * _FOUR],
                ],
                axis=2,
            ),
        ],
        axis=2,
    )
    return text.reshape(count, width * text.shape[2])


def _digits(
    values: npt.NDArray[np.int64], before: bytes, *, negative: npt.NDArray[np.bool_] | None = None
) -> Words:
    """Return the text of whole numbers, shape (n, k), as words: `before`, sign and digits."""
    size = np.abs(values)
    signs = _table([before, before + b"-"])
    words = [signs[((values < 0) if negative is None else negative).astype(np.intp)]]
    groups = [size]
    while int(groups[-1].max(initial=0)) >= _FOUR:
        groups.append(groups[-1] // _FOUR)
    for number in range(len(groups) - 1, -1, -1):
        group = groups[number]
        if number == len(groups) - 1:
            words.append((_LEADING if number == 0 else _LEADING_OR_NOTHING)[group])
            continue
        above = groups[number + 1]
        own = group - above * _FOUR
        lead = _LEADING if number == 0 else _LEADING_OR_NOTHING
        words.append(np.where(above > 0, _PLAIN[own], lead[own]))
    return np.stack(words, axis=2)
