"""The package twice in one process: with its native kernel, and in plain Python.

The second copy of `tftool.buffer` is imported under TFTOOL_PURE=1. Both copies share everything
else, such as `TransformStamped` and the exceptions, so that their results can be compared.
"""

import importlib
import os
import pkgutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager

import tftool.buffer
from tftool.base.native import SWITCH
from tftool.buffer.native_kernel import IS_NATIVE

SHARED = {"tftool.buffer.sample", "tftool.buffer._kernel"}

# The names are listed once: a process has thousands of modules, and tests often change the copy.
TWINS = {
    "tftool.buffer",
    *(one.name for one in pkgutil.walk_packages(tftool.buffer.__path__, "tftool.buffer.")),
} - SHARED

REASON = "no native kernel is built here, or TFTOOL_PURE is set: there is one path only"

_copies: dict[str, object] = {}


def is_native() -> bool:
    """Return whether the native version is installed."""
    return IS_NATIVE


@contextmanager
def pure() -> Iterator[None]:
    """Make `tftool.buffer` the plain copy inside this block, for all later imports."""
    ours = {name: sys.modules[name] for name in TWINS if name in sys.modules}
    package, switch = tftool.buffer, os.environ.get(SWITCH)
    for name in ours:
        del sys.modules[name]
    sys.modules.update(_copies)
    os.environ[SWITCH] = "1"
    try:
        tftool.buffer = importlib.import_module("tftool.buffer")
        yield
    finally:
        _copies.update((name, sys.modules[name]) for name in TWINS if name in sys.modules)
        for name in _copies:
            sys.modules.pop(name, None)
        sys.modules.update(ours)
        tftool.buffer = package
        if switch is None:
            del os.environ[SWITCH]
        else:
            os.environ[SWITCH] = switch


class Twins:
    """Two buffers, the native one and a plain one, on which the same calls are made."""

    def __init__(self, *arguments: object, **options: object) -> None:
        self.logs: tuple[list[tuple[str, str]], list[tuple[str, str]]] = ([], [])
        self.pair = []
        for log, plain in zip(self.logs, (False, True), strict=True):

            def note(level: str, text: str, log: list[tuple[str, str]] = log) -> None:
                log.append((level, text))

            if plain:
                with pure():
                    module = importlib.import_module("tftool.buffer.buffer")
                    self.pair.append(module.Buffer(*arguments, log=note, **options))
            else:
                module = importlib.import_module("tftool.buffer.buffer")
                self.pair.append(module.Buffer(*arguments, log=note, **options))
        assert type(self.pair[0]) is not type(self.pair[1]), "both are of one class"

    def ask(self, call: str, *words: object, **options: object) -> tuple[object, object]:
        """Return both results of a call: a value, or an exception's class and text."""
        ours = _outcome(getattr(self.pair[0], call), words, options)
        with pure():
            return ours, _outcome(getattr(self.pair[1], call), words, options)


def _outcome(call, words, options):
    try:
        return call(*words, **options)
    except Exception as error:
        return type(error), str(error), vars(error)


def worst(count: int, links: int = 5) -> tuple[int, float, float]:
    """Return the largest difference between both versions in a number of batch lookups.

    Args:
        count: Number of lookups.
        links: Number of edges between the two frames.

    Returns:
        Number of compared lookups, and the differences of positions (relative to the length of the
        path) and of rotations. Every thousandth lookup is also made singly.
    """
    import numpy as np

    random = np.random.default_rng(19)
    twins, samples, way = Twins(2**62), 1000, 0.0
    for link in range(links):
        stamps = 10**9 + np.arange(samples) * 10**7 + random.integers(0, 10**6, samples)
        places = np.cumsum(random.normal(0.0, 0.1, (samples, 3)), axis=0)
        way += float(np.linalg.norm(places, axis=1).max())
        # The first edge turns much between two samples, the last edge hardly at all.
        turns = np.cumsum(random.normal(0.0, 10.0 ** -(link + 1), (samples, 4)), axis=0)
        turns[:, 3] += 1.0 if link else 0.0
        twins.ask("set_transforms", f"f{link}", f"f{link + 1}", stamps, places, turns)
    compared, place, turn = 0, 0.0, 0.0
    while compared < count:
        n = min(count - compared, 10**6)
        moments = random.integers(10**9 + 10**7, 10**9 + (samples - 2) * 10**7, n)
        ours, plain = twins.ask("lookup_transforms", "f0", f"f{links}", moments)
        place = max(place, float(np.abs(ours.translations - plain.translations).max()) / way)
        turn = max(turn, float(np.abs(ours.rotations - plain.rotations).max()))
        for row in range(0, n, 1000):
            single, other = twins.ask("lookup_transform", "f0", f"f{links}", int(moments[row]))
            for mine, theirs in zip(single.transform[1], other.transform[1], strict=True):
                turn = max(turn, abs(mine - theirs))
            for mine, theirs in zip(single.transform[0], other.transform[0], strict=True):
                place = max(place, abs(mine - theirs) / way)
        compared += n
    return compared, place, turn


if __name__ == "__main__":
    told = "{} lookups of {} links: places differ by {:.1e} of the way at most, rotations by {:.1e}"
    for links in (1, 5):
        compared, *most = worst(int(sys.argv[1]) if len(sys.argv) > 1 else 10**7, links)
        print(told.format(compared, links, *most))  # noqa: T201
