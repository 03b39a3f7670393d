"""Named settings of a node that can change while it runs."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from tftool.base.errors import UsageError
from tftool.base.near_names import did_you_mean

Value = bool | int | float | str


class Parameters:
    """Declared names with typed values, and callbacks for each change."""

    def __init__(self, owner: str) -> None:
        self._owner = owner
        self._values: dict[str, Value] = {}
        self._listeners: list[Callable[[str, Value], object]] = []

    def declare(self, name: str, default: Value) -> Value:
        """Make a parameter known with its default, whose type it keeps."""
        return self._values.setdefault(name, default)

    def __getitem__(self, name: str) -> Value:
        """The value of a declared parameter."""
        self._check(name)
        return self._values[name]

    def set(self, name: str, value: Value) -> None:
        """Change a declared parameter.

        Raises:
            UsageError: If it was never declared, or the value is of another type.
                An int is taken where a float is declared.
        """
        self._check(name)
        kind = type(self._values[name])
        if kind is float and type(value) is int:
            value = float(value)
        if type(value) is not kind:
            raise UsageError(
                f"parameter '{name}' of node '{self._owner}' takes {kind.__name__}, "
                f"not {type(value).__name__} ({value!r})"
            )
        self._values[name] = value
        for listener in self._listeners:
            listener(name, value)

    def on_change(self, callback: Callable[[str, Value], object]) -> None:
        """Have `callback` called with name and value after every change."""
        self._listeners.append(callback)

    def values(self) -> Mapping[str, Value]:
        """Every parameter as it stands, read-only."""
        return MappingProxyType(self._values)

    def _check(self, name: str) -> None:
        if name in self._values:
            return
        hint = did_you_mean(name, self._values)
        raise UsageError(f"node '{self._owner}' has no parameter '{name}'{hint}")
