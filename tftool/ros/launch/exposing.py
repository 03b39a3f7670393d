"""Registration of users' own elements and `$(…)` for XML and YAML launch files."""

import typing
from collections.abc import Callable
from typing import Any, TypeVar

from tftool.base.errors import UsageError
from tftool.ros.launch import parsing
from tftool.ros.launch.elements import Element
from tftool.ros.launch.substitutions import TextSubstitution, is_true

T = TypeVar("T")

ParseMethod = Callable[["Entity", Any], tuple[Any, dict[str, Any]]]
"""Parse function of an element; returns a callable and its keyword arguments."""

ACTIONS: dict[str, ParseMethod] = {}
"""Parse functions of users' own elements, by tag."""


class Entity:
    """Element of a launch file, with the methods that users' own parse functions call.

    Attributes:
        type_name: Tag of the element.
        parent: Enclosing element; None at the top.
    """

    def __init__(self, element: Element, parent: "Entity | None" = None) -> None:
        self.element = element
        self.type_name = element.tag
        self.parent = parent

    @property
    def children(self) -> list["Entity"]:
        """Child elements."""
        return [Entity(one, self) for one in self.element.all_inside()]

    def get_attr(
        self,
        name: str,
        *,
        data_type: Any = str,
        optional: bool = False,
        can_be_str: bool = True,
    ) -> Any:
        """Return an attribute's value; None if an optional attribute is missing.

        With the data type `List[Entity]`, return the child elements whose tag is `name`.

        Raises:
            AttributeError: If the attribute is missing.
            TypeError: If the attribute has another type.
        """
        if typing.get_args(data_type) == (Entity,):
            inside = [Entity(one, self) for one in self.element.inside(name)]
            if not inside and not optional:
                raise self._missing(name)
            return inside or None
        value = self.element.get(name)
        if value is None:
            if not optional:
                raise self._missing(name)
            return None
        if can_be_str and isinstance(value, str) and "$(" in value:
            return value
        try:
            return _read(value, data_type)
        except (ValueError, UsageError):
            raise TypeError(
                f"{self.element.where}: '{name}' of '{self.type_name}' is not of type "
                f"{data_type}: {value!r}"
            ) from None

    def _missing(self, name: str) -> AttributeError:
        return AttributeError(
            f"{self.element.where}: '{self.type_name}' needs the attribute '{name}'"
        )

    def assert_entity_completely_parsed(self) -> None:
        """Raise an error if an attribute or child element was not read.

        Raises:
            InputError: If an attribute or child element was not read.
        """
        self.element.finish()


def _read(value: Any, data_type: Any) -> Any:
    if typing.get_origin(data_type) is list:
        (kind,) = typing.get_args(data_type)
        parts = value if isinstance(value, list) else str(value).split(",")
        return [_read(part.strip() if isinstance(part, str) else part, kind) for part in parts]
    if data_type is bool:
        return value if isinstance(value, bool) else is_true(str(value))
    return data_type(value) if data_type in (str, int, float) else value


def parse_substitution(value: Any) -> list[Any]:
    """Parse a text that may contain `$(…)` into a list of substitutions."""
    return parsing.parsed(value, "a text") or [TextSubstitution(text="")]


def parse_if_substitutions(value: Any) -> Any:
    """Parse a text that contains `$(` into a list of substitutions; return other values as given.

    The texts in a list are parsed one by one.
    """
    if isinstance(value, list):
        return [parse_if_substitutions(one) for one in value]
    return parse_substitution(value) if isinstance(value, str) and "$(" in value else value


def expose_action(name: str) -> Callable[[T], T]:
    """Register the decorated class or function as the parser of an element `name`."""

    def expose(exposed: T) -> T:
        ACTIONS[name.replace("-", "_")] = _parser_of(exposed)
        return exposed

    return expose


def expose_substitution(name: str) -> Callable[[T], T]:
    """Register the decorated class or function as the parser of `$(name …)`."""

    def expose(exposed: T) -> T:
        read = _parser_of(exposed)

        def make(*words: Any) -> Any:
            kind, settings = read(list(words))
            return kind(**settings)

        parsing.EXPOSED[name] = make
        return exposed

    return expose


def _parser_of(exposed: Any) -> Any:
    read = exposed.parse if isinstance(exposed, type) and hasattr(exposed, "parse") else exposed
    if isinstance(read, type) or not callable(read):
        name = getattr(exposed, "__name__", repr(exposed))
        raise RuntimeError(f"'{name}' is neither a function nor a class with a method parse")
    return read
