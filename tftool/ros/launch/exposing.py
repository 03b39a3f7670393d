"""Functions of launch.frontend that parse `$(…)`, and that register users' own substitutions."""

from collections.abc import Callable
from typing import Any, TypeVar

from tftool.ros.launch import parsing
from tftool.ros.launch.substitutions import TextSubstitution

T = TypeVar("T")


def parse_substitution(value: Any) -> list[Any]:
    """Parse a text that may contain `$(…)` into a list of substitutions."""
    return parsing.parsed(value, "a text") or [TextSubstitution(text="")]


def parse_if_substitutions(value: Any) -> Any:
    """Parse a text that contains `$(` into a list of substitutions; return other values unchanged.

    In a list, each text is parsed separately.
    """
    if isinstance(value, list):
        return [parse_if_substitutions(one) for one in value]
    return parse_substitution(value) if isinstance(value, str) and "$(" in value else value


def expose_substitution(name: str) -> Callable[[T], T]:
    """Return a decorator that registers a class or function as the parser of `$(name …)`."""

    def expose(exposed: T) -> T:
        is_method = isinstance(exposed, type) and hasattr(exposed, "parse")
        read: Any = exposed.parse if is_method else exposed  # type: ignore[attr-defined]
        if isinstance(read, type) or not callable(read):
            named = getattr(exposed, "__name__", repr(exposed))
            raise RuntimeError(f"'{named}' is neither a function nor a class with a method parse")

        def make(*words: Any) -> Any:
            kind, settings = read(list(words))
            return kind(**settings)

        parsing.EXPOSED[name] = make
        return exposed

    return expose
