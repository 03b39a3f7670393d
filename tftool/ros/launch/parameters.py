"""Parameters of nodes in launch files: typed values, mappings and parameter files."""

import os
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, get_args

from tftool.base.errors import UsageError
from tftool.base.named_files import read_named_text
from tftool.ros.host import parameter_files
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.parsing import parsed
from tftool.ros.launch.substitutions import (
    Substitution,
    is_true,
    normalize_to_list_of_substitutions,
    perform,
)

_SINGLE = (str, int, float, bool)


class BadParameterError(UsageError, TypeError):
    """Error for a value, computed while the launch runs, that a parameter cannot have."""


class ParameterValue:
    """Value of a parameter, or substitutions for the value, with the required type."""

    def __init__(self, value: Any, *, value_type: Any = None) -> None:
        """Store a value, or substitutions to evaluate later.

        Raises:
            TypeError: If `value` contains no substitution and is not of the type `value_type`.
        """
        self.value_type = value_type
        # If a single value is wanted, a list of texts is joined to one text.
        if _is_text(value) or (value_type in _SINGLE and _is_parts(value)):
            self.value = normalize_to_list_of_substitutions(value)
        elif value_type is None or _is_of(value, value_type) or _has_texts(value):
            self.value = value
        else:
            shown = getattr(value_type, "__name__", value_type)
            raise TypeError(f"a parameter's value must be {shown}, not {value!r}")

    def evaluate(self, context: LaunchContext) -> Any:
        """Evaluate the substitutions and return the value.

        Raises:
            ValueError: If the value is not of the required type.
        """
        if _is_text(self.value):
            self.value = _typed(perform(context, self.value), self.value_type)
        elif _has_texts(self.value):
            (kind,) = get_args(self.value_type) or (None,)
            found = (ParameterValue(one, value_type=kind) for one in self.value)
            self.value = [one.evaluate(context) for one in found]
        return self.value


class ParameterDescription:
    """Name and value of one parameter in a launch file."""

    def __init__(self, name: Any, value: Any, *, value_type: Any = None) -> None:
        self.name: Any = normalize_to_list_of_substitutions(name)
        self._value = ParameterValue(value, value_type=value_type)

    @property
    def value(self) -> Any:
        """Value of the parameter; substitutions for the value until `evaluate` is called."""
        return self._value.value

    @property
    def value_type(self) -> Any:
        """Type that the value must have; None for any type."""
        return self._value.value_type

    def evaluate(self, context: LaunchContext) -> tuple[str, Any]:
        """Evaluate the substitutions; return the parameter's name and value.

        Raises:
            ValueError: If the value is not of the parameter's type.
        """
        self.name = perform(context, self.name)
        return self.name, self._value.evaluate(context)


class ParameterFile:
    """Parameter file that a launch file passes to nodes.

    Attributes:
        param_file: Path of the file; substitutions for the path until `evaluate` is called.
        allow_substs: Whether to replace the substitutions, `$(…)`, in the file's text.
    """

    def __init__(self, param_file: Any, *, allow_substs: Any = False) -> None:
        self._given = param_file if isinstance(param_file, os.PathLike) else _parts_of(param_file)
        self.param_file: Any = self._given
        self.allow_substs = allow_substs
        self._made: Path | None = None

    def read(self, context: LaunchContext) -> list[tuple[str, str, Any]]:
        """Read the file; return a tuple (node pattern, name, value) for each parameter.

        As in ROS 2, a file that does not exist only causes a warning.

        Raises:
            InputError: If the file cannot be read, or is not a parameter file.
        """
        path = Path(perform(context, self._given))
        if not is_true(perform(context, self.allow_substs)):
            if not path.is_file() and context.launch is not None:
                context.launch.warn(f"Parameter file path is not a file: {path}")
                return []
            return parameter_files.read_parameters(path)
        return parameter_files.read_parameters(
            path, lambda text: perform(context, parsed(text, str(path)))
        )

    def evaluate(self, context: LaunchContext) -> Path:
        """Return the path of the file.

        With `allow_substs`, return the path of a new copy in which every `$(…)` is replaced.

        Raises:
            InputError: If a `$(…)` is unknown.
        """
        path = Path(perform(context, self._given))
        if is_true(perform(context, self.allow_substs)):
            text = perform(context, parsed(read_named_text(path), str(path)))
            handle, made = tempfile.mkstemp(prefix="parameters-", suffix=".yaml")
            with open(handle, "w", encoding="utf-8") as file:
                file.write(text)
            self._made = path = Path(made)
        self.param_file = path
        return path

    def cleanup(self) -> None:
        """Delete the copy of the file if `evaluate` has made one."""
        if self._made is not None:
            self._made.unlink(missing_ok=True)
            self._made, self.param_file = None, self._given


def normalize_parameters(parameters: Any) -> list[Any]:
    """Check a node's parameters; join the names in nested mappings by dots.

    Returns:
        A mapping for each mapping, and a ParameterFile for each file.

    Raises:
        TypeError: If `parameters` is not a list, or an item is not a mapping or a file.
    """
    if not isinstance(parameters, Sequence) or isinstance(parameters, str | bytes):
        raise TypeError(f"parameters must be a list of mappings and files, not {parameters!r}")
    found: list[Any] = []
    for one in parameters:
        if isinstance(one, Mapping):
            found.append(normalize_parameter_dict(one))
        elif isinstance(one, ParameterFile | ParameterDescription):
            found.append(one)
        else:
            found.append(ParameterFile(one))
    return found


def normalize_parameter_dict(parameters: Any) -> dict[tuple[Substitution, ...], Any]:
    """Convert nested mappings of parameters to one mapping, whose names are joined by dots.

    Each key of the result is a name as a tuple of substitutions.

    Raises:
        TypeError: If a name is not a string, or a parameter cannot have a value of this type.
    """
    if not isinstance(parameters, Mapping):
        raise TypeError(f"parameters must be a mapping from names to values, not {parameters!r}")
    found: dict[tuple[Substitution, ...], Any] = {}
    for key, value in parameters.items():
        name = _parts_of(key)
        if isinstance(value, Mapping):
            dot = _parts_of(".")
            for below, one in normalize_parameter_dict(value).items():
                found[(*name, *dot, *below)] = one
        else:
            found[tuple(name)] = _normalized(value)
    return found


def _normalized(value: Any) -> Any:
    if isinstance(value, (ParameterValue, bytes, *_SINGLE)):
        return value
    if _is_text(value):
        return tuple(_parts_of(value))
    if not isinstance(value, Sequence):
        raise TypeError(f"{value!r} cannot be a parameter's value: give a number, a text or a list")
    found: list[Any] = [one if isinstance(one, _SINGLE) else tuple(_parts_of(one)) for one in value]
    kinds = {type(one) for one in found}
    if kinds == {int, float}:
        return [float(one) for one in found]
    if len(kinds - {tuple}) > 1:
        raise TypeError(_not_uniform(value))
    return found


def evaluate_parameters(context: LaunchContext, parameters: Iterable[Any]) -> tuple[Any, ...]:
    """Evaluate the substitutions in a result of `normalize_parameters`.

    Returns:
        A mapping from name to value for each mapping, and the path of each parameter file.

    Raises:
        TypeError: If a resulting value has a type that its parameter cannot have.
    """
    found: list[Any] = []
    for one in parameters:
        if isinstance(one, ParameterFile):
            found.append(one.evaluate(context))
        elif isinstance(one, Mapping):
            found.append(evaluate_parameter_dict(context, one))
        else:
            one.evaluate(context)
            found.append(one)
    return tuple(found)


def evaluate_parameter_dict(
    context: LaunchContext, parameters: Mapping[Any, Any]
) -> dict[str, Any]:
    """Evaluate the substitutions in a result of `normalize_parameter_dict`.

    Returns:
        A mapping from name to value.

    Raises:
        TypeError: If a resulting value has a type that its parameter cannot have.
    """
    found: dict[str, Any] = {}
    for key, value in parameters.items():
        name = perform(context, key)
        try:
            found[name] = _evaluated(context, value)
        except ValueError as error:
            raise BadParameterError(f"parameter '{name}': {error}") from None
    return found


def _evaluated(context: LaunchContext, value: Any) -> Any:
    if isinstance(value, ParameterValue):
        return value.evaluate(context)
    if isinstance(value, tuple):
        # As in ROS 2, the text of a substitution is parsed as YAML.
        value = _typed(perform(context, value), None)
    elif isinstance(value, list):
        each = (_evaluated(context, one) for one in value)
        value = [tuple(one) if isinstance(one, list) else one for one in each]
        if not _is_uniform(value):
            raise ValueError(_not_uniform(value))
    return tuple(value) if isinstance(value, list) else value


def read_all(context: LaunchContext, parameters: Iterable[Any]) -> list[tuple[str, str, Any]]:
    """Return (node pattern, name, value) for each parameter in mappings and parameter files.

    The node pattern is "" for a parameter from a mapping.
    """
    found: list[tuple[str, str, Any]] = []
    for one in parameters:
        if isinstance(one, ParameterFile):
            found += one.read(context)
            continue
        pairs: Iterable[tuple[str, Any]] = (
            evaluate_parameter_dict(context, one).items()
            if isinstance(one, Mapping)
            else [one.evaluate(context)]
        )
        for name, value in pairs:
            found.append(("", name, list(value) if isinstance(value, tuple) else value))
    return found


def _typed(text: str, kind: Any) -> Any:
    """Parse a text as a parameter's value.

    If `kind` is None, the value may have any type that a parameter can have.

    Raises:
        ValueError: If the text is not a value of this type.
    """
    if kind is str:
        return text
    value = parameter_files.strict_yaml_value(text)
    if kind is None:
        if isinstance(value, list) and not _is_uniform(value):
            raise ValueError(_not_uniform(value))
        if not isinstance(value, (list, *_SINGLE)):
            raise ValueError(
                "Allowed value types are bool, int, float, str and lists of one of them, not "
                f"{type(value).__name__}: '{text}'"
            )
        return value
    (item,) = get_args(kind) or (kind,)
    if item is float:
        value = [_as_float(one) for one in value] if isinstance(value, list) else _as_float(value)
    if not _is_of(value, kind):
        shown = getattr(kind, "__name__", kind) if item is kind else kind
        raise ValueError(f"a parameter's value must be {shown}, not '{text}'")
    return value


def _as_float(value: Any) -> Any:
    return float(value) if type(value) is int else value


def _is_of(value: Any, kind: Any) -> bool:
    if not (items := get_args(kind)):
        return kind is None or type(value) is kind or not isinstance(kind, type)
    return isinstance(value, list | tuple) and all(type(one) in items for one in value)


def _is_uniform(values: Sequence[Any]) -> bool:
    return bool(values) and type(values[0]) in _SINGLE and len({type(one) for one in values}) == 1


def _not_uniform(values: Sequence[Any]) -> str:
    return (
        "Expected a non-empty sequence of bool, int, float or str alone, not "
        f"{list(values)!r}; wrap a text in ParameterValue to give its type"
    )


def _parts_of(value: Any) -> list[Substitution]:
    if isinstance(value, str | Substitution) or _is_parts(value):
        return normalize_to_list_of_substitutions(value)
    if isinstance(value, Path):
        return normalize_to_list_of_substitutions(str(value))
    raise TypeError(f"expected a text, a substitution or a list of these, not {value!r}")


def _is_text(value: Any) -> bool:
    """Return whether a value is a substitution, or a list that contains one."""
    if isinstance(value, Substitution):
        return True
    return _is_parts(value) and any(isinstance(one, Substitution) for one in value)


def _is_parts(value: Any) -> bool:
    return (
        isinstance(value, list | tuple)
        and bool(value)
        and all(isinstance(one, str | Substitution) for one in value)
    )


def _has_texts(value: Any) -> bool:
    """Return whether a list has an item that is evaluated only while the launch runs."""
    return isinstance(value, list | tuple) and any(_is_text(one) for one in value)
