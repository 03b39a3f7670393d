"""Loading of launch files in Python, XML or YAML."""

import inspect
import os
import shlex
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from types import FunctionType, MappingProxyType, ModuleType
from typing import Any

from tftool.base.errors import InputError, UsageError
from tftool.base.named_files import read_named
from tftool.base.plain_text import near_names
from tftool.ros.host import user_code
from tftool.ros.host.error_text import error_sentence
from tftool.ros.host.import_table import tagged
from tftool.ros.host.importing import load
from tftool.ros.launch import actions, components, lifecycle, nodes, parameters, processes, scope
from tftool.ros.launch.conditions import IfCondition, UnlessCondition
from tftool.ros.launch.description import LaunchDescription, LaunchDescriptionSource
from tftool.ros.launch.elements import Element, begins_as_xml, read
from tftool.ros.launch.parsing import parsed
from tftool.ros.launch.substitutions import TextSubstitution, is_true


class Parser:
    """Class `Parser` of launch.frontend, which parses XML and YAML launch files."""

    @classmethod
    def load(cls, file: Any) -> tuple[Element, "Parser"]:
        """Read an XML or YAML launch file; return its root element and a parser.

        Raises:
            InputError: If the file cannot be read or is not a launch file; the text gives the line.
        """
        if isinstance(file, str | os.PathLike):
            path, data = Path(file), None
        else:
            path, data = Path(getattr(file, "name", "launch file")), file.read()
            data = data.encode() if isinstance(data, str) else data
        return Element("launch", str(path), children=read(path, data)), cls()

    def parse_description(self, entity: Element) -> LaunchDescription:
        """Return the launch description of a launch file's root element."""
        return LaunchDescription(actions_of(entity.all_children()))


def actions_of(elements: Iterable[Element]) -> list[Any]:
    """Convert elements of a launch file to the actions that these elements describe.

    Raises:
        InputError: If a tag or attribute is unknown; the text has the line and the nearest name.
    """
    return [_action(element) for element in elements]


def _action(element: Element) -> Any:
    tag = element.tag.replace("-", "_")
    make = _READERS.get(tag)
    if make is None and tag in tagged():
        make = partial(_plain, load(tagged()[tag]))
    if make is None:
        what = f"there is no '{element.tag}' in a launch file"
        known = [one for one in tagged() if not one.startswith("$")]
        raise element.error(what, element.tag, known)
    condition = _condition(element)
    made = make(element)
    element.finish()
    made.condition = condition
    made.where = element.where
    return made


def _condition(element: Element) -> Any:
    if (text := element.get("if")) is not None:
        return IfCondition(parsed(text, element.where))
    if (text := element.get("unless")) is not None:
        return UnlessCondition(parsed(text, element.where))
    return None


def _text(element: Element, *names: str) -> Any:
    return parsed(element.required(*names), element.where)


def _optional(element: Element, name: str, default: Any = None) -> Any:
    value = element.get(name)
    return default if value is None else parsed(value, element.where)


YAML_FLAGS = {"yes": True, "on": True, "no": False, "off": False}
"""Words besides "true" and "false" for attributes that ROS reads as YAML."""


def _boolean(element: Element, name: str, default: str) -> bool:
    """Return the value of a boolean attribute; raise InputError if the text is not boolean.

    A substitution, `$(…)`, is refused too: its value is unknown before the launch runs.
    """
    text = str(element.get(name, default))
    if (word := text.strip().lower()) in YAML_FLAGS:
        return YAML_FLAGS[word]
    try:
        return is_true(text)
    except UsageError:
        what = f"'{name}' of '{element.tag}' must be true or false, not '{text}'"
        raise element.error(what, "", ()) from None


def _each(element: Element, read: Callable[[Element], Any], *tags: str) -> list[Any]:
    """Call `read` for each child element whose tag is in `tags`; return the results.

    Raise InputError if `read` leaves an attribute or child element unread.
    """
    found = []
    for child in element.children_with(*tags):
        found.append(read(child))
        child.finish()
    return found


def _pair(first: str, second: str) -> Callable[[Element], tuple[Any, Any]]:
    return lambda child: (_text(child, first), _text(child, second))


def _arg(element: Element) -> Any:
    choices = _each(element, lambda child: child.required("value"), "choice")
    return actions.DeclareLaunchArgument(
        str(element.required("name")),
        default_value=_optional(element, "default"),
        description=element.get("description"),
        choices=choices or None,
    )


def _startable(element: Element) -> dict[str, Any]:
    """Return the keyword arguments of `Startable` for an element that starts a node or command."""
    for name in ("emulate_tty", "sigterm_timeout", "sigkill_timeout"):
        element.get(name)
    on_exit = element.get("on_exit")
    if on_exit not in (None, "shutdown"):
        raise element.error(f"on_exit must be 'shutdown', not '{on_exit}'", "", ())
    return {
        "on_exit": actions.Shutdown(reason=f"{element.tag} ended") if on_exit else None,
        "output": element.get("output", "log"),
        "respawn": _optional(element, "respawn", "false"),
        "respawn_delay": _optional(element, "respawn_delay"),
        "prefix": _optional(element, "launch-prefix"),
        "cwd": _optional(element, "cwd"),
        "additional_env": _each(element, _pair("name", "value"), "env") or None,
    }


def _node(element: Element, kind: Callable[..., Any] = nodes.Node, **kwargs: Any) -> Any:
    return kind(
        package=_optional(element, "pkg"),
        executable=_text(element, "exec"),
        name=_optional(element, "name"),
        namespace=_optional(element, "namespace"),
        exec_name=_optional(element, "exec_name"),
        arguments=_words(element.get("args"), element),
        ros_arguments=_words(element.get("ros_args"), element),
        parameters=_each(element, _param, "param"),
        remappings=_each(element, _pair("from", "to"), "remap"),
        **_startable(element),
        **kwargs,
    )


def _lifecycle_node(element: Element) -> Any:
    element.required("name")
    element.required("namespace")
    return _node(element, lifecycle.LifecycleNode)


def _component(element: Element) -> components.ComposableNode:
    condition = _condition(element)
    return components.ComposableNode(
        package=_text(element, "pkg"),
        plugin=_text(element, "plugin"),
        name=_optional(element, "name"),
        namespace=_optional(element, "namespace"),
        parameters=_each(element, _param, "param"),
        remappings=_each(element, _pair("from", "to"), "remap"),
        extra_arguments=_each(element, _param, "extra_arg"),
        condition=condition,
    )


def _node_container(element: Element) -> Any:
    element.required("name")
    element.required("namespace")
    return _node(
        element,
        components.ComposableNodeContainer,
        composable_node_descriptions=_each(element, _component, "composable_node"),
    )


def _load_composable_node(element: Element) -> Any:
    return components.LoadComposableNodes(
        target_container=_text(element, "target"),
        composable_node_descriptions=_each(element, _component, "composable_node"),
    )


def _words(text: Any, element: Element) -> list[Any]:
    """Split a command line into words as a shell does; do not split the values of substitutions."""
    if text is None:
        return []
    words: list[Any] = [[]]
    for part in parsed(text, element.where):
        if not isinstance(part, TextSubstitution):
            words[-1].append(part)
            continue
        try:
            found = shlex.split(part.text)
        except ValueError:
            raise element.error(f"a quote in '{text}' is not closed", "", ()) from None
        if part.text[0].isspace():
            words.append([])
        for number, word in enumerate(found):
            words += [[]] if number else []
            words[-1].append(TextSubstitution(text=word))
        if part.text[-1].isspace():
            words.append([])
    return [word for word in words if word]


_TYPES: Mapping[str, Any] = MappingProxyType(
    {
        "str": str,
        "int": int,
        "float": float,
        "bool": bool,
        "list_of_str": list[str],
        "list_of_int": list[int],
        "list_of_float": list[float],
        "list_of_bool": list[bool],
    }
)


def _param(element: Element, prefix: str = "") -> Any:
    if "from" in element.values:
        return parameters.ParameterFile(
            _text(element, "from"), allow_substs=_boolean(element, "allow_substs", "false")
        )
    name = prefix + str(element.required("name"))
    if element.children_with("param"):
        whole: dict[str, Any] = {}
        for below in _each(element, partial(_param, prefix=f"{name}."), "param"):
            whole.update(below)
        return whole
    value, kind = element.required("value"), element.get("type")
    if kind is not None and kind not in _TYPES:
        raise element.error(
            f"a type must be one of {', '.join(_TYPES)}, not '{kind}'", str(kind), _TYPES
        )
    separator = element.get("value-sep")
    if separator and isinstance(value, str):
        value = [_value(text, element) for text in value.split(str(separator))]
    elif isinstance(value, list):
        value = [_value(one, element) if "$(" in str(one) else one for one in value]
    elif isinstance(value, str) or kind is not None:
        value = _value(value, element)
    try:
        return {name: parameters.ParameterValue(value, value_type=kind and _TYPES[kind])}
    except TypeError as error:
        raise element.error(str(error), "", ()) from None


def _value(text: Any, element: Element) -> list[Any]:
    return parsed(text, element.where) or [TextSubstitution(text="")]


def _include(element: Element) -> Any:
    arguments = _each(element, _pair("name", "value"), "arg", "let")
    source = LaunchDescriptionSource(None, _text(element, "file"))
    return actions.IncludeLaunchDescription(source, launch_arguments=arguments)


def _group(element: Element) -> Any:
    kept = dict(_each(element, _kept, "keep"))
    return actions.GroupAction(
        actions_of(child for child in element.all_children() if child.tag != "keep"),
        scoped=_boolean(element, "scoped", "true"),
        forwarding=_boolean(element, "forwarding", "true"),
        launch_configurations=kept,
    )


def _kept(child: Element) -> tuple[str, Any]:
    return str(child.required("name")), _text(child, "value")


def _reset(element: Element) -> Any:
    return actions.ResetLaunchConfigurations(dict(_each(element, _kept, "keep")))


def _executable(element: Element) -> Any:
    shell, text = _boolean(element, "shell", "false"), element.required("cmd")
    return processes.ExecuteProcess(
        # A shell interprets the quotes itself.
        cmd=[parsed(text, element.where)] if shell else _words(text, element),
        name=_optional(element, "name"),
        shell=shell,
        **_startable(element),
    )


def _timer(element: Element) -> Any:
    return actions.TimerAction(
        period=_text(element, "period"), actions=actions_of(element.all_children())
    )


def _append_env(element: Element) -> Any:
    return actions.AppendEnvironmentVariable(
        _text(element, "name"),
        _text(element, "value"),
        prepend=_boolean(element, "prepend", "false"),
        separator=_optional(element, "separator", ":"),
    )


_READERS: dict[str, Callable[[Element], Any]] = {
    "arg": _arg,
    "node": _node,
    "lifecycle_node": _lifecycle_node,
    "node_container": _node_container,
    "load_composable_node": _load_composable_node,
    "include": _include,
    "group": _group,
    "append_env": _append_env,
    "set_remap": lambda e: scope.SetRemap(_text(e, "from"), _text(e, "to")),
    "executable": _executable,
    "reset": _reset,
    "timer": _timer,
    "ros_timer": _timer,
    "log": lambda e: actions.LogInfo(msg=_text(e, "message")),
}
"""Parse functions of elements whose attributes are not just the arguments of an action."""


def _plain(kind: Any, element: Element) -> Any:
    """Create an action of the class `kind`, with the element's attributes as keyword arguments."""
    given: dict[str, Any] = {}
    for one in inspect.signature(kind).parameters.values():
        if one.kind is not one.VAR_KEYWORD and one.name != "condition":
            needed = one.default is one.empty
            value = _text(element, one.name) if needed else _optional(element, one.name)
            given |= {} if value is None else {one.name: value}
    return kind(**given)


MAKES = "generate_launch_description"
"""Name of the function that a launch file in Python defines."""


def load_file(path: Path) -> LaunchDescription:
    """Read a launch file and return its launch description.

    Raises:
        InputError: If the file cannot be read, is not a launch file, or its Python code raises an
            exception; the text shows the line.
    """
    is_python = path.suffix not in (".xml", ".yaml", ".yml")
    if is_python and path.suffix != ".py":
        # As in ROS 2, a file with another suffix, such as x.launch, is recognized by its content.
        with suppress(OSError):
            is_python = not begins_as_xml(read_named(path))
    return _from_python(path) if is_python else LaunchDescription(actions_of(read(path)))


def _from_python(path: Path) -> LaunchDescription:
    code = user_code.compile_file(path)
    module = ModuleType("launch_file")
    module.__file__ = str(path.absolute())  # as ROS 2's loader does
    try:
        exec(code, module.__dict__)
        make = module.__dict__.get(MAKES)
        if make is None:
            defined = [name for name, one in vars(module).items() if isinstance(one, FunctionType)]
            near = near_names(MAKES, defined)
            hint = f"; rename its function '{near[0]}'" if near else ""
            raise InputError(f"'{path}' is not a launch file: it has no function {MAKES}(){hint}")
        description = make()
    except InputError:
        raise
    except Exception as error:
        raise InputError(f"{path}: {error_sentence(error)}") from error
    if not isinstance(description, LaunchDescription):
        raise InputError(
            f"{path}: generate_launch_description() must return a LaunchDescription, not "
            f"{type(description).__name__}"
        )
    return description
