"""launch files in XML and in YAML: the same elements, the same actions."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path
from typing import Any
from xml.parsers import expat

from tftool.errors import InputError
from tftool.ros.launching import actions, nodes, substitutions
from tftool.ros.launching.conditions import IfCondition, UnlessCondition
from tftool.ros.launching.description import LaunchDescription, LaunchDescriptionSource
from tftool.ros.launching.substitutions import TextSubstitution


@dataclass(slots=True)
class Element:
    """One element: a tag of XML, a key of YAML.

    Attributes:
        tag: What it is.
        values: Its attributes.
        children: What is inside.
        where: "file:line".
    """

    tag: str
    where: str
    values: dict[str, Any] = field(default_factory=dict)
    children: list["Element"] = field(default_factory=list)
    asked: set[str] = field(default_factory=set)

    def get(self, name: str, default: Any = None) -> Any:
        """An attribute, or something else."""
        self.asked.add(name)
        return self.values.get(name, default)

    def need(self, *names: str) -> Any:
        """An attribute that must be there, under one of its names.

        Raises:
            InputError: If it is missing.
        """
        for name in names:
            self.asked.add(name)
        for name in names:
            if name in self.values:
                return self.values[name]
        raise InputError(f"{self.where}: '{self.tag}' needs '{names[0]}'")

    def inside(self, *tags: str) -> list["Element"]:
        """The children with one of some tags."""
        self.asked.update(tags)
        return [child for child in self.children if child.tag in tags]

    def finish(self) -> None:
        """Refuse attributes nobody asked for.

        Raises:
            InputError: If there is one; the nearest that is known is told.
        """
        for name in self.values:
            if name not in self.asked:
                near = get_close_matches(name, self.asked, n=1)
                hint = f"; did you mean '{near[0]}'?" if near else ""
                raise InputError(f"{self.where}: '{self.tag}' has no attribute '{name}'{hint}")


# Reading


def from_xml(path: Path) -> LaunchDescription:
    """The description in an XML file.

    Raises:
        InputError: If it cannot be read or says something unknown; the line is told.
    """
    parser = expat.ParserCreate()
    stack: list[Element] = [Element("", str(path))]

    def start(tag: str, values: dict[str, Any]) -> None:
        element = Element(tag, f"{path}:{parser.CurrentLineNumber}", dict(values))
        stack[-1].children.append(element)
        stack.append(element)

    def refuse(*_: Any) -> None:
        raise InputError(f"{path}:{parser.CurrentLineNumber}: entities are not read")

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: stack.pop()
    parser.EntityDeclHandler = refuse
    try:
        parser.Parse(path.read_bytes(), True)
    except OSError as error:
        raise InputError(f"cannot read '{path}': {error.strerror}") from None
    except expat.ExpatError as error:
        where = f"{path}:{error.lineno}:{error.offset + 1}"
        raise InputError(f"{where}: {expat.ErrorString(error.code)}") from None
    root = stack[0].children[0]
    if root.tag != "launch":
        raise InputError(f"{root.where}: a launch file's root is 'launch', not '{root.tag}'")
    return LaunchDescription(_actions(root.children))


def from_yaml(path: Path) -> LaunchDescription:
    """The description in a YAML file.

    Raises:
        InputError: If it cannot be read or says something unknown; the line is told.
    """
    import yaml

    try:
        root = yaml.compose(path.read_text(encoding="utf-8"), Loader=yaml.SafeLoader)
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is no UTF-8 text"
        raise InputError(f"cannot read '{path}': {reason}") from None
    except yaml.YAMLError as error:
        mark: Any = getattr(error, "problem_mark", None)
        where = f"{path}:{mark.line + 1}:{mark.column + 1}" if mark else str(path)
        raise InputError(f"{where}: {getattr(error, 'problem', None) or 'not YAML'}") from None
    if not isinstance(root, yaml.MappingNode) or [key.value for key, _ in root.value] != ["launch"]:
        raise InputError(f"{path}: a launch file has one key at its top, 'launch'")
    top = Element("launch", str(path))
    _children(root.value[0][1], top, path)
    return LaunchDescription(_actions(top.children))


def _children(node: Any, parent: Element, path: Path) -> None:
    """Hang what a list of one-key mappings says below an element."""
    import yaml

    where = f"{path}:{node.start_mark.line + 1}"
    if not isinstance(node, yaml.SequenceNode):
        raise InputError(f"{where}: '{parent.tag}' is a list of actions, each begun with '- '")
    for item in node.value:
        where = f"{path}:{item.start_mark.line + 1}"
        if not isinstance(item, yaml.MappingNode) or len(item.value) != 1:
            raise InputError(f"{where}: an action is one key with its attributes below it")
        key, value = item.value[0]
        parent.children.append(_element(key.value, value, path))


def _element(tag: str, node: Any, path: Path) -> Element:
    import yaml

    element = Element(tag, f"{path}:{node.start_mark.line + 1}")
    if isinstance(node, yaml.SequenceNode):
        _children(node, element, path)
        return element
    if not isinstance(node, yaml.MappingNode):
        raise InputError(f"{element.where}: '{tag}' needs its attributes below it, 'name: value'")
    for key, value in node.value:
        nested = isinstance(value, yaml.SequenceNode) and any(
            isinstance(one, yaml.MappingNode) for one in value.value
        )
        if nested and key.value == "children":
            _children(value, element, path)
        elif nested:
            element.children += [_element(key.value, one, path) for one in value.value]
        else:
            loader = yaml.SafeLoader("")
            element.values[key.value] = loader.construct_object(value, deep=True)
    return element


# Meaning


def _actions(elements: Iterable[Element]) -> list[Any]:
    return [_action(element) for element in elements]


def _action(element: Element) -> Any:
    make = _MEANINGS.get(element.tag.replace("-", "_"))
    if make is None:
        near = get_close_matches(element.tag, _MEANINGS, n=1)
        hint = f"; did you mean '{near[0]}'?" if near else ""
        raise InputError(f"{element.where}: there is no '{element.tag}' in a launch file{hint}")
    condition: Any = None
    if (text := element.get("if")) is not None:
        condition = IfCondition(parsed(text, element.where))
    elif (text := element.get("unless")) is not None:
        condition = UnlessCondition(parsed(text, element.where))
    made = make(element)
    element.finish()
    made.condition = condition
    return made


def _text(element: Element, *names: str) -> Any:
    return parsed(element.need(*names), element.where)


def _optional(element: Element, name: str) -> Any:
    value = element.get(name)
    return None if value is None else parsed(value, element.where)


def _arg(element: Element) -> Any:
    choices = [child.need("value") for child in element.inside("choice")]
    return actions.DeclareLaunchArgument(
        str(element.need("name")),
        default_value=_optional(element, "default"),
        description=element.get("description"),
        choices=choices or None,
    )


def _node(element: Element) -> Any:
    arguments = element.get("args")
    ros_arguments = element.get("ros_args")
    element.get("output"), element.get("respawn"), element.get("respawn_delay")
    element.get("launch-prefix"), element.get("emulate_tty")
    return nodes.Node(
        package=_text(element, "pkg"),
        executable=_text(element, "exec"),
        name=_optional(element, "name"),
        namespace=_optional(element, "namespace"),
        exec_name=_optional(element, "exec_name"),
        arguments=_words(arguments, element),
        ros_arguments=_words(ros_arguments, element),
        parameters=[_param(child) for child in element.inside("param")],
        remappings=[
            (_text(child, "from"), _text(child, "to")) for child in element.inside("remap")
        ],
    )


def _words(text: Any, element: Element) -> list[Any]:
    if text is None:
        return []
    # A substitution may hold blanks: words end only between them.
    words: list[Any] = [[]]
    for part in parsed(text, element.where):
        if isinstance(part, TextSubstitution):
            first, *others = part.text.split(" ")
            words[-1] += [TextSubstitution(text=first)] if first else []
            words += [[TextSubstitution(text=one)] if one else [] for one in others]
        else:
            words[-1].append(part)
    return [word for word in words if word]


def _param(element: Element, prefix: str = "") -> Any:
    if "from" in element.values:
        return nodes.ParameterFile(parsed(element.need("from"), element.where))
    name = prefix + str(element.need("name"))
    below = element.inside("param")
    if below:
        whole: dict[str, Any] = {}
        for child in below:
            whole.update(_param(child, f"{name}."))
        return whole
    value = element.need("value")
    kinds: dict[Any, Any] = {"str": str, "int": int, "float": float, "bool": bool}
    kind = kinds.get(element.get("type"))
    if not isinstance(value, str):
        return {name: value}
    return {name: nodes.ParameterValue(parsed(value, element.where), value_type=kind)}


def _include(element: Element) -> Any:
    arguments = [
        (_text(child, "name"), _text(child, "value")) for child in element.inside("arg", "let")
    ]
    source = LaunchDescriptionSource(None, _text(element, "file"))
    return actions.IncludeLaunchDescription(source, launch_arguments=arguments)


def _group(element: Element) -> Any:
    scoped = str(element.get("scoped", "true")).lower() in ("true", "1")
    return actions.GroupAction(_actions(element.children), scoped=scoped)


def _executable(element: Element) -> Any:
    shell = str(element.get("shell", "false")).lower() in ("true", "1")
    element.get("output")
    return actions.ExecuteProcess(
        cmd=_words(element.need("cmd"), element),
        name=_optional(element, "name"),
        cwd=_optional(element, "cwd"),
        shell=shell,
    )


def _timer(element: Element) -> Any:
    return actions.TimerAction(period=_text(element, "period"), actions=_actions(element.children))


_MEANINGS: dict[str, Callable[[Element], Any]] = {
    "arg": _arg,
    "let": lambda e: actions.SetLaunchConfiguration(_text(e, "name"), _text(e, "value")),
    "node": _node,
    "include": _include,
    "group": _group,
    "push_ros_namespace": lambda e: nodes.PushRosNamespace(_text(e, "namespace")),
    "set_env": lambda e: actions.SetEnvironmentVariable(_text(e, "name"), _text(e, "value")),
    "unset_env": lambda e: actions.UnsetEnvironmentVariable(_text(e, "name")),
    "set_parameter": lambda e: nodes.SetParameter(
        _text(e, "name"), nodes.ParameterValue(_text(e, "value"))
    ),
    "set_remap": lambda e: nodes.SetRemap(_text(e, "from"), _text(e, "to")),
    "executable": _executable,
    "timer": _timer,
    "log": lambda e: actions.LogInfo(msg=_text(e, "message")),
    "shutdown": lambda e: actions.Shutdown(reason=str(e.get("reason", "reason not given"))),
}


# Substitutions: $(var name), $(find-pkg-share pkg), nested as deep as one likes.


def parsed(text: Any, where: str) -> list[Any]:
    """A text with its `$(…)` parts as substitutions.

    Raises:
        InputError: If a part is not closed, or not known.
    """
    parts, rest = _parse(str(text), 0, where, closing=False)
    if rest != len(str(text)):
        raise InputError(f"{where}: '{text}' has a ')' too many")
    return parts


def _parse(text: str, start: int, where: str, *, closing: bool) -> tuple[list[Any], int]:
    parts: list[Any] = []
    plain = ""
    at = start
    while at < len(text):
        if text.startswith("$(", at):
            if plain:
                parts.append(TextSubstitution(text=plain))
                plain = ""
            made, at = _substitution(text, at + 2, where)
            parts.append(made)
        elif closing and (text[at] == ")" or text[at] == " "):
            break
        else:
            plain += text[at]
            at += 1
    if plain:
        parts.append(TextSubstitution(text=plain))
    return parts, at


def _substitution(text: str, start: int, where: str) -> tuple[Any, int]:
    """One `$(name argument argument)`, from after its bracket."""
    words: list[list[Any]] = []
    at = start
    while at < len(text) and text[at] != ")":
        if text[at] == " ":
            at += 1
        elif text[at] in "'\"":
            end = text.find(text[at], at + 1)
            if end < 0:
                raise InputError(f"{where}: a quote in '{text}' is not closed")
            inner, _ = _parse(text[at + 1 : end], 0, where, closing=False)
            words.append(inner)
            at = end + 1
        else:
            word, at = _parse(text, at, where, closing=True)
            words.append(word)
    if at >= len(text):
        raise InputError(f"{where}: '$(' in '{text}' is not closed by ')'")
    if not words or not isinstance(words[0][0], TextSubstitution):
        raise InputError(f"{where}: '$()' in '{text}' names nothing")
    name = words[0][0].text
    make = _SUBSTITUTIONS.get(name)
    if make is None:
        near = get_close_matches(name, _SUBSTITUTIONS, n=1)
        hint = f"; did you mean '$({near[0]} …)'?" if near else ""
        raise InputError(f"{where}: '$({name} …)' is not known{hint}")
    try:
        return make(*words[1:]), at + 1
    except TypeError:
        raise InputError(f"{where}: '$({name} …)' is given the wrong number of words") from None


_SUBSTITUTIONS: dict[str, Callable[..., Any]] = {
    "var": lambda name, default=None: substitutions.LaunchConfiguration(name, default=default),
    "env": lambda name, default=None: substitutions.EnvironmentVariable(
        name, default_value=default
    ),
    "find-pkg-share": substitutions.FindPackageShare,
    "find-pkg-prefix": substitutions.FindPackageShare,
    "dirname": substitutions.ThisLaunchFileDir,
    "filename": substitutions.ThisLaunchFile,
    "eval": lambda *words: substitutions.PythonExpression(_spaced(words)),
    "command": lambda command, on_stderr=None: substitutions.Command(command),
    "anon": substitutions.AnonName,
    "not": substitutions.NotSubstitution,
    "and": substitutions.AndSubstitution,
    "or": substitutions.OrSubstitution,
    "equals": substitutions.EqualsSubstitution,
    "not-equals": substitutions.NotEqualsSubstitution,
}


def _spaced(words: Iterable[list[Any]]) -> list[Any]:
    joined: list[Any] = []
    for word in words:
        joined += [TextSubstitution(text=" "), *word] if joined else word
    return joined
