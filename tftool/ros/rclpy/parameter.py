"""Parameters of rclpy.parameter: names, types and values, as messages and in files."""

import array
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path
from typing import Any, ClassVar

from tftool.messages.classes import INTERFACES
from tftool.world.node_parameters import SCALARS, value_message, value_of


class ParameterType(IntEnum):
    """Type of a parameter's value, with the numbers of rcl_interfaces/ParameterType."""

    NOT_SET = 0
    BOOL = 1
    INTEGER = 2
    DOUBLE = 3
    STRING = 4
    BYTE_ARRAY = 5
    BOOL_ARRAY = 6
    INTEGER_ARRAY = 7
    DOUBLE_ARRAY = 8
    STRING_ARRAY = 9

    @classmethod
    def from_parameter_value(cls, value: Any) -> "ParameterType":
        """Return the parameter type of a Python value.

        Raises:
            TypeError: If a parameter cannot have a value of this Python type.
        """
        if value is None:
            return cls.NOT_SET
        for kind, number in SCALARS.items():  # bool comes before int, because bool is a subclass
            if isinstance(value, kind):
                return cls(number)
        if isinstance(value, list | tuple | array.array):
            kinds = {
                cls.BYTE_ARRAY if isinstance(one, bytes) else cls.from_parameter_value(one)
                for one in value
            }
            if kinds <= {cls.BYTE_ARRAY}:
                return cls.BYTE_ARRAY
            if len(kinds) == 1 and cls.BOOL <= (only := kinds.pop()) <= cls.STRING:
                return cls(only + 5)
        raise TypeError(f"The given value is not one of the allowed types: {value!r}")

    def check(self, value: Any) -> bool:
        """Return whether a Python value has this parameter type."""
        if self >= ParameterType.BYTE_ARRAY and isinstance(value, list | tuple) and not len(value):
            return True
        try:
            return ParameterType.from_parameter_value(value) is self
        except TypeError:
            return False


Type = ParameterType


@dataclass(slots=True)
class Parameter:
    """Name, type and value of one parameter; without `type_`, the value determines the type."""

    Type: ClassVar[type[ParameterType]] = ParameterType

    name: str
    type_: ParameterType = None  # type: ignore[assignment]
    value: Any = None

    def __post_init__(self) -> None:
        if self.type_ is None:
            self.type_ = ParameterType.from_parameter_value(self.value)
        if not isinstance(self.type_, ParameterType):
            raise TypeError("type must be an instance of 'Parameter.Type'")
        if self.value is not None and not self.type_.check(self.value):
            raise ValueError(f"Type '{self.type_}' and value '{self.value}' do not agree")

    @property
    def _value(self) -> Any:
        """Value of the parameter; some ROS programs read this private attribute."""
        return self.value

    def get_parameter_value(self) -> Any:
        """Return the value as an rcl_interfaces ParameterValue message."""
        return value_message(self.value, int(self.type_))

    def to_parameter_msg(self) -> Any:
        """Return the parameter as an rcl_interfaces Parameter message."""
        return INTERFACES.message("rcl_interfaces/Parameter")(
            name=self.name, value=self.get_parameter_value()
        )

    @classmethod
    def from_parameter_msg(cls, param_msg: Any) -> "Parameter":
        """Convert an rcl_interfaces Parameter message to a Parameter."""
        return cls(param_msg.name, ParameterType(param_msg.value.type), value_of(param_msg.value))


def parameter_value_to_python(parameter_value: Any) -> Any:
    """Return the Python value in a ParameterValue message; None for a message without a value.

    Raises:
        RuntimeError: If the message's type number is unknown.
    """
    try:
        return value_of(parameter_value)
    except ValueError as error:
        raise RuntimeError(str(error)) from None


def get_parameter_value(string_value: str) -> Any:
    """Parse a text as YAML, and return the value as a ParameterValue message.

    For a YAML text without a value, such as "null", the value is the text itself.
    """
    from tftool.ros.host.parameter_files import yaml_value

    value = yaml_value(string_value)
    return Parameter("", value=string_value if value is None else value).get_parameter_value()


PARAMETER_SEPARATOR_STRING = "."


def parameter_dict_from_yaml_file(
    parameter_file: str,
    use_wildcard: bool = False,
    target_nodes: list[str] | None = None,
    namespace: str = "",
) -> dict[str, Any]:
    """Read a parameter file; return a mapping from names to Parameter messages.

    Args:
        parameter_file: Path of the YAML file.
        use_wildcard: Whether to include entries under `/**`.
        target_nodes: Names of the nodes whose parameters to return; all nodes if empty.
        namespace: Prefix for the names of the parameters.

    Raises:
        FileNotFoundError: If there is no such file.
        InputError: If the file cannot be read, is not YAML, or is not a parameter file.
    """
    from tftool.ros.host.parameter_files import read_parameters

    if not Path(parameter_file).exists():
        raise FileNotFoundError(f"there is no parameter file '{parameter_file}'")
    wanted = {one.strip("/") for one in target_nodes or ()}
    found = {}
    for node, name, value in read_parameters(Path(parameter_file)):
        plain = node.strip("/")
        chosen = use_wildcard if plain == "**" else not wanted or plain in wanted
        if chosen:
            full = f"{namespace}{PARAMETER_SEPARATOR_STRING}{name}" if namespace else name
            found[full] = Parameter(full, value=value).to_parameter_msg()
    return found
