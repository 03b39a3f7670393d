"""Functions of launch.utilities for users' own extensions of launch."""

from collections.abc import Iterable, Sequence
from typing import Any

from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.substitutions import Substitution, TextSubstitution


def perform_substitutions(context: LaunchContext, subs: Iterable[Substitution]) -> str:
    """Return the joined texts of several substitutions."""
    return "".join(context.perform_substitution(one) for one in subs)


def normalize_to_list_of_substitutions(subs: Any) -> list[Substitution]:
    """Convert a text, a substitution, or a list of texts and substitutions to substitutions.

    Raises:
        TypeError: If an item is neither a text nor a substitution.
    """
    if isinstance(subs, str):
        return [TextSubstitution(text=subs)]
    if isinstance(subs, Substitution):
        return [subs]
    if not isinstance(subs, Iterable):
        raise TypeError(f"expected a text, a substitution or a list of these, not {subs!r}")
    return [_one(sub) for sub in subs]


def _one(sub: Any) -> Substitution:
    if isinstance(sub, Substitution):
        return sub
    if not isinstance(sub, str):
        raise TypeError(f"expected a text or a substitution, not {sub!r}")
    return TextSubstitution(text=sub)


def ensure_argument_type(
    argument: object, types: "type | Sequence[type]", argument_name: str, caller: str | None = None
) -> None:
    """Raise an error unless an argument is an instance of one of the types.

    Args:
        argument: Value of the argument.
        types: One type, or several types.
        argument_name: Name of the argument, for the error text.
        caller: Name of the function that got the argument, for the error text.

    Raises:
        TypeError: If the argument has another type, or an item of `types` is not a type.
    """
    allowed = types if isinstance(types, Iterable) else [types]
    if not any(is_a(argument, one) for one in allowed):
        whose = f" of {caller}" if caller else ""
        names = ", ".join(str(one) for one in allowed)
        raise TypeError(
            f"argument '{argument_name}'{whose} must be of type {names}, not {type(argument)}"
        )


def is_a(obj: object, entity_type: type) -> bool:
    """Return whether an object is an instance of the class `entity_type`."""
    return isinstance(obj, entity_type)


def is_a_subclass(obj: object, entity_type: type) -> bool:
    """Return whether `obj`, or the class of `obj`, is a subclass of `entity_type`."""
    kind = obj if isinstance(obj, type) else type(obj)
    return issubclass(kind, entity_type)


def isclassinstance(obj: object) -> bool:
    """Return whether an object has a class, which is always true."""
    return hasattr(obj, "__class__")


def normalize_to_list_of_entities(entities: Any) -> list[Any]:
    """Return the actions and launch descriptions in nested lists as one flat list."""
    if not isinstance(entities, Iterable):
        return [entities]
    return [one for entity in entities for one in normalize_to_list_of_entities(entity)]
