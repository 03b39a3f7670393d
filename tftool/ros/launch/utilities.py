"""launch.utilities, for users' extensions of launch."""

from collections.abc import Iterable, Sequence
from typing import Any

from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.substitutions import Substitution, TextSubstitution


def perform_substitutions(context: LaunchContext, subs: Iterable[Substitution]) -> str:
    """Return the joined texts of substitutions."""
    return "".join(context.perform_substitution(one) for one in subs)


def normalize_to_list_of_substitutions(subs: Any) -> list[Substitution]:
    """Return a text, a substitution, or several as a list of substitutions.

    Raises:
        TypeError: If something is neither.
    """
    if isinstance(subs, str):
        return [TextSubstitution(text=subs)]
    if isinstance(subs, Substitution):
        return [subs]
    if not isinstance(subs, Iterable):
        raise TypeError(f"expected a text or substitutions, not {subs!r}")
    return [_one(sub) for sub in subs]


def _one(sub: Any) -> Substitution:
    if isinstance(sub, Substitution):
        return sub
    if not isinstance(sub, str):
        raise TypeError(f"expected a text or a substitution, not {sub!r}")
    return TextSubstitution(text=sub)


def ensure_argument_type(
    argument: object,
    types: "type | Sequence[type]",
    argument_name: str,
    caller: str | None = None,
) -> None:
    """Check that an argument has one of some types.

    Raises:
        TypeError: If the argument has another type, or the types are no types.
    """
    allowed = types if isinstance(types, Iterable) else [types]
    if not any(is_a(argument, one) for one in allowed):
        whose = f" of {caller}" if caller else ""
        names = ", ".join(str(one) for one in allowed)
        raise TypeError(
            f"argument '{argument_name}'{whose} must be of type {names}, not {type(argument)}"
        )


def is_a(obj: object, entity_type: type) -> bool:
    """Whether an object is of a type."""
    return isinstance(obj, entity_type)


def is_a_subclass(obj: object, entity_type: type) -> bool:
    """Whether a class, or an object's class, is a subclass of another."""
    kind = obj if isinstance(obj, type) else type(obj)
    return issubclass(kind, entity_type)


def isclassinstance(obj: object) -> bool:
    """Whether an object has a class, as every object has."""
    return hasattr(obj, "__class__")


def normalize_to_list_of_entities(entities: Any) -> list[Any]:
    """Return actions and descriptions as a flat list."""
    if not isinstance(entities, Iterable):
        return [entities]
    return [one for entity in entities for one in normalize_to_list_of_entities(entity)]
