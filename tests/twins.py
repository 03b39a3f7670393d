"""The same package twice in one process: as it runs here, and in plain Python.

The second copy of `tftool.frames` is imported under TFTOOL_PURE=1. Both share everything else,
`TransformStamped` and the exceptions included, so that their answers can be compared.
"""

import importlib
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager

import tftool
from tftool.frames.native import IS_NATIVE, SWITCH

SHARED = {"tftool.frames.sample", "tftool.frames._kernel"}

REASON = "no native kernel is built here, or TFTOOL_PURE is set: there is one path only"

_copies: dict[str, object] = {}


def is_native() -> bool:
    """Whether there are two to compare."""
    return IS_NATIVE


@contextmanager
def pure() -> Iterator[None]:
    """Inside, `tftool.frames` is the plain copy, for what imports it and for what it imports."""
    ours = {name: module for name, module in sys.modules.items() if _is_twin(name)}
    package, switch = tftool.frames, os.environ.get(SWITCH)
    for name in ours:
        del sys.modules[name]
    sys.modules.update(_copies)
    os.environ[SWITCH] = "1"
    try:
        tftool.frames = importlib.import_module("tftool.frames")
        yield
    finally:
        _copies.update((name, module) for name, module in sys.modules.items() if _is_twin(name))
        for name in _copies:
            sys.modules.pop(name, None)
        sys.modules.update(ours)
        tftool.frames = package
        if switch is None:
            del os.environ[SWITCH]
        else:
            os.environ[SWITCH] = switch


def _is_twin(name: str) -> bool:
    return name.split(".")[:2] == ["tftool", "frames"] and name not in SHARED


class Twins:
    """Two buffers of one kind, this process's own and a plain one, that are told the same."""

    def __init__(self, *arguments: object, **options: object) -> None:
        self.logs: tuple[list[tuple[str, str]], list[tuple[str, str]]] = ([], [])
        self.pair = []
        for log, plain in zip(self.logs, (False, True), strict=True):

            def note(level: str, text: str, log: list[tuple[str, str]] = log) -> None:
                log.append((level, text))

            if plain:
                with pure():
                    module = importlib.import_module("tftool.frames.buffer")
                    self.pair.append(module.Buffer(*arguments, log=note, **options))
            else:
                module = importlib.import_module("tftool.frames.buffer")
                self.pair.append(module.Buffer(*arguments, log=note, **options))

    def ask(self, call: str, *words: object, **options: object) -> tuple[object, object]:
        """What both answer to a call of a buffer: a value, or an exception's kind and text."""
        ours = _outcome(getattr(self.pair[0], call), words, options)
        with pure():
            return ours, _outcome(getattr(self.pair[1], call), words, options)


def _outcome(call, words, options):
    try:
        return call(*words, **options)
    except Exception as error:
        return type(error), str(error), vars(error)
