"""launch_ros's parameters: values with types, files, and settings for all nodes of a scope."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from tftool.errors import UsageError
from tftool.ros.host import names
from tftool.ros.launch.action import Action
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.parsing import parsed
from tftool.ros.launch.substitutions import Substitution, is_true, perform

_SINGLE = (str, int, float, bool)


class ParameterValue:
    """A parameter's value of a given type."""

    def __init__(self, value: Any, *, value_type: Any = None) -> None:
        self.value, self.value_type = value, value_type

    def evaluate(self, context: LaunchContext) -> Any:
        """The value.

        Raises:
            UsageError: If it is not of that type.
        """
        # A list of texts is one text where one value is wanted.
        parts = self.value_type in _SINGLE and _is_parts(self.value)
        if not (parts or _is_text(self.value)):
            return plain(context, self.value)
        text = perform(context, self.value)
        if self.value_type is str:
            return text
        value = names.yaml_value(text)
        if self.value_type is float and isinstance(value, int):
            value = float(value)
        if isinstance(self.value_type, type) and not isinstance(value, self.value_type):
            raise UsageError(
                f"a parameter's value is to be {self.value_type.__name__}, not '{text}'"
            )
        return value


class ParameterFile:
    """A parameter file; with `allow_substs` its text may hold `$(…)`."""

    def __init__(self, param_file: Any, *, allow_substs: Any = False) -> None:
        self.param_file, self.allow_substs = param_file, allow_substs

    def read(self, context: LaunchContext) -> list[tuple[str, str, Any]]:
        """What it sets: (node, name, value).

        Raises:
            InputError: If it cannot be read, or is laid out otherwise.
        """
        path = Path(perform(context, self.param_file))
        if not is_true(perform(context, self.allow_substs)):
            return names.read_parameters(path)
        return names.read_parameters(path, lambda text: perform(context, parsed(text, str(path))))


def read_all(context: LaunchContext, given: Iterable[Any]) -> list[tuple[str, str, Any]]:
    """What a list of mappings and files sets: (node, name, value)."""
    found: list[tuple[str, str, Any]] = []
    for one in given:
        if isinstance(one, Mapping):
            named = {perform(context, key): value for key, value in one.items()}
            found += [("", name, plain(context, value)) for name, value in names.flatten(named)]
        else:
            file = one if isinstance(one, ParameterFile) else ParameterFile(one)
            found += file.read(context)
    return found


def _is_text(value: Any) -> bool:
    if isinstance(value, str | Substitution):
        return True
    return _is_parts(value) and any(isinstance(one, Substitution) for one in value)


def _is_parts(value: Any) -> bool:
    return (
        isinstance(value, list | tuple)
        and bool(value)
        and all(isinstance(one, str | Substitution) for one in value)
    )


def plain(context: LaunchContext, value: Any) -> Any:
    """A parameter's value, with what stands for texts in it made."""
    if isinstance(value, ParameterValue):
        return value.evaluate(context)
    if isinstance(value, str):
        return value
    if _is_text(value):
        # What a substitution gives is read as YAML, as ROS 2 reads it.
        return names.yaml_value(perform(context, value))
    if isinstance(value, list | tuple):
        return [plain(context, one) for one in value]
    return value


class SetParameter(Action):
    """Sets a parameter for all nodes of the scope."""

    def __init__(self, name: Any, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name, self.value = name, value

    def execute(self, context: LaunchContext) -> Any:
        """Set it."""
        context.parameters.append(("", perform(context, self.name), plain(context, self.value)))


class SetUseSimTime(SetParameter):
    """Sets use_sim_time for all nodes of the scope."""

    def __init__(self, value: Any, **kwargs: Any) -> None:
        super().__init__("use_sim_time", value, **kwargs)


class SetParametersFromFile(Action):
    """Sets what a parameter file says, for all nodes of the scope or one of them."""

    def __init__(self, filename: Any, node_name: Any = None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.file, self.node_name = ParameterFile(filename), node_name

    def execute(self, context: LaunchContext) -> Any:
        """Read and set it."""
        only = perform(context, self.node_name)
        context.parameters += [
            (only or node, name, value) for node, name, value in self.file.read(context)
        ]
