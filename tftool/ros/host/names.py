"""ROS 2 names: rules for valid names, expansion, remapping, and the options after `--ros-args`.

Topic names in tftool are full names without the leading slash.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from tftool.base.errors import UsageError
from tftool.base.plain_text import did_you_mean, near_names

_STRANGE = re.compile(r"[^A-Za-z0-9_]")
_STRANGE_IN_TOPIC = re.compile(r"[^A-Za-z0-9_/~{}]")
_DIGIT_FIRST = re.compile(r"(?<![^/])[0-9]")
_SUBSTITUTION = re.compile(r"\{([^{}]*)\}")


class Fault(NamedTuple):
    """Rule of ROS 2 that a name breaks, and the index of the first wrong character."""

    reason: str
    at: int


def named_twice(name: str) -> str:
    """Return the warning that another process already has a node named `name`."""
    return (
        f"another process of this session has a node named '{name}' too, and both are used. "
        "End one of them, or rename this node: --ros-args -r __node:=…"
    )


@dataclass(frozen=True, slots=True)
class Remap:
    """Remapping rule `node:old:=new`; a rule whose `node` is None applies to all nodes."""

    node: str | None
    old: str
    new: str


@dataclass(slots=True)
class RosOptions:
    """Options after `--ros-args` on a program's command line.

    Attributes:
        name: New name for the program's nodes (`__node:=`); None to keep their names.
        namespace: New namespace for the nodes (`__ns:=`); None to keep their namespaces.
        remaps: Rules for topics, services and actions; the first matching rule applies.
        parameters: Tuples (node pattern, name, value); later tuples override earlier ones.
        levels: Log levels by logger name; the name "" means all loggers.
        logs_to_rosout: Whether nodes publish their log messages on `/rosout`.
    """

    name: str | None = None
    namespace: str | None = None
    remaps: list[Remap] = field(default_factory=list)
    parameters: list[tuple[str, str, Any]] = field(default_factory=list)
    levels: dict[str, str] = field(default_factory=dict)
    logs_to_rosout: bool = True

    def parameters_for(self, name: str, namespace: str) -> dict[str, Any]:
        """Return the parameter values in these options for one node, by parameter name."""
        full = join(namespace, name)
        return {key: value for node, key, value in self.parameters if _fits(node, full, name)}

    def remapped(self, full_name: str, name: str, namespace: str) -> str:
        """Apply a node's remapping rules to a full topic or service name.

        Returns:
            The new full name; `full_name` if no rule matches.
        """
        for rule in self.remaps:
            if rule.node is not None and rule.node.strip("/") not in (name, join(namespace, name)):
                continue
            if expand(rule.old, name, namespace) == full_name:
                return expand(rule.new, name, namespace)
        return full_name


def _fits(pattern: str, full: str, name: str) -> bool:
    if pattern == name:
        # The option comes from the command line. A parameter file's entry for a node without a
        # namespace begins with '/'.
        return True
    pattern = pattern.strip("/")
    if pattern in ("", "**", full):
        return True
    parts = ["(?:.*/)?" if part == "**" else "[^/]+/" if part == "*" else re.escape(part) + "/"
             for part in pattern.split("/")]  # fmt: skip
    return re.fullmatch("".join(parts).removesuffix("/"), full) is not None


def join(namespace: str, name: str) -> str:
    """Join a namespace and a name; return the full name without leading slash."""
    return f"{namespace.strip('/')}/{name}".strip("/")


_STRANGE_CHARACTER = "it must not contain characters other than letters, digits, '_' and '/'"


def node_name_fault(name: str) -> Fault | None:
    """Return the rule of ROS 2 that a node's name breaks; None if the name is valid."""
    strange = _STRANGE.search(name)
    if not name:
        return Fault("it must not be empty", 0)
    if strange is not None:
        return Fault(
            "it must not contain characters other than letters, digits and '_'", strange.start()
        )
    return Fault("it must not start with a number", 0) if name[0].isdigit() else None


def namespace_fault(namespace: str) -> Fault | None:
    """Return the rule of ROS 2 that an absolute namespace breaks; None for a valid namespace."""
    if not namespace:
        return Fault("it must not be empty", 0)
    if not namespace.startswith("/"):
        return Fault("it must be absolute: start with '/'", 0)
    strange = re.search(r"[^A-Za-z0-9_/]", namespace)
    if strange is not None:
        return Fault(_STRANGE_CHARACTER, strange.start())
    return None if namespace == "/" else _fault_of_parts(namespace)


def topic_name_fault(name: str) -> Fault | None:
    """Return the rule of ROS 2 that a topic's name breaks; None if the name is valid.

    The name is checked before expansion and may contain "~" and substitutions such as "{node}".
    """
    strange = _STRANGE_IN_TOPIC.search(name)
    if not name:
        return Fault("it must not be empty", 0)
    if strange is not None:
        return Fault(_STRANGE_CHARACTER, strange.start())
    if "~" in name[1:] or (name.startswith("~") and not name.startswith("~/") and name != "~"):
        return Fault("'~' must be the first character, followed by '/'", name.rindex("~"))
    for found in _SUBSTITUTION.finditer(name):
        if found[1] not in ("node", "ns", "namespace"):
            return Fault(
                "unknown substitution: only {node}, {ns} and {namespace} exist", found.start()
            )
    plain = _SUBSTITUTION.sub(lambda found: "_" * len(found[0]), name)
    if brace := re.search(r"[{}]", plain):
        return Fault("a brace is not closed or not opened", brace.start())
    return _fault_of_parts(plain)


def _fault_of_parts(name: str) -> Fault | None:
    if name.endswith("/"):
        return Fault("it must not end with '/'", len(name) - 1)
    if "//" in name:
        return Fault("it must not contain '//'", name.index("//") + 1)
    digit = _DIGIT_FIRST.search(name)
    return None if digit is None else Fault("a part must not start with a number", digit.start())


def check_node_name(name: str) -> None:
    """Raise an error if a node name breaks a rule of ROS 2.

    Raises:
        UsageError: If the name is not valid; the text contains the rule.
    """
    fault = node_name_fault(name)
    if fault is not None:
        raise UsageError(f"'{name}' cannot be a node's name: {fault.reason}")


def check_namespace(namespace: str) -> None:
    """Raise an error if a namespace breaks a rule of ROS 2.

    Raises:
        UsageError: If the namespace is not valid; the text contains the rule.
    """
    fault = namespace_fault(f"/{namespace.strip('/')}")
    if fault is not None:
        raise UsageError(f"'{namespace}' cannot be a namespace: {fault.reason}")


def expand(topic: str, node_name: str, namespace: str) -> str:
    """Return the full name of a topic or service, without leading slash.

    A name is relative (`x`), absolute (`/x`) or private (`~/x`).

    Raises:
        UsageError: If ROS 2 refuses the topic name.
    """
    fault = topic_name_fault(topic)
    if fault is not None:
        raise UsageError(f"'{topic}' cannot be a topic's or service's name: {fault.reason}")
    known = {"node": node_name, "ns": namespace.strip("/"), "namespace": namespace.strip("/")}
    topic = _SUBSTITUTION.sub(lambda found: known[found[1]], topic)
    if topic.startswith("/"):
        return topic.strip("/")
    if topic.startswith("~"):
        return join(join(namespace, node_name), topic[1:].strip("/"))
    return join(namespace, topic)


def parse(argv: Sequence[str]) -> tuple[RosOptions, list[str]]:
    """Split a command line into the options after `--ros-args` and the program's own arguments.

    Raises:
        UsageError: If the part after `--ros-args` is malformed.
        InputError: If a parameter file cannot be read.
    """
    options = RosOptions()
    own: list[str] = []
    words = iter(argv)
    inside = False
    for word in words:
        if word == "--ros-args":
            inside = True
        elif not inside:
            if near_names(word, ["--ros-args"], alike=0.85):
                raise UsageError(f"'{word}' is not a known option; did you mean '--ros-args'?")
            own.append(word)
        elif word == "--":
            inside = False
        else:
            _take(options, word, words)
    return options, own


_LEVELS = ("UNSET", "DEBUG", "INFO", "WARN", "ERROR", "FATAL")

_OPTIONS = {
    "-p": "--param",
    "--param": "--param",
    "-r": "--remap",
    "--remap": "--remap",
    "--params-file": "--params-file",
    "--log-level": "--log-level",
    "-e": "--enclave",
    "--enclave": "--enclave",
    "--log-config-file": "--log-config-file",
    "--log-file-name": "--log-file-name",
}
_FLAGS = ("stdout-logs", "rosout-logs", "external-lib-logs")


def _take(options: RosOptions, word: str, words: Iterable[str]) -> None:
    if word.startswith(("--enable-", "--disable-")) and word.endswith(_FLAGS):
        if word.endswith("-rosout-logs"):
            options.logs_to_rosout = word.startswith("--enable-")
        return
    known = _OPTIONS.get(word)
    if known is None:
        if ":=" in word:  # the old form: a bare rule after --ros-args
            add_remap(options, word)
            return
        hint = did_you_mean(word, _OPTIONS)
        raise UsageError(f"'{word}' is not an option after --ros-args{hint}")
    value = next(iter(words), None)
    if value is None:
        raise UsageError(f"'{word}' after --ros-args needs a value: write the value after '{word}'")
    if known == "--param":
        add_parameter(options, value)
    elif known == "--remap":
        add_remap(options, value)
    elif known == "--params-file":
        # Imported here, because few programs read a parameter file, and YAML takes 10 ms.
        from tftool.ros.host.parameter_files import read_parameters

        options.parameters += read_parameters(Path(value))
    elif known == "--log-level":
        logger, found, rest = value.partition(":=")
        level = (rest if found else logger).upper()
        if level not in _LEVELS:
            raise UsageError(
                f"'{value}' is not a log level: write debug, info, warn, error or fatal, or "
                "LOGGER:=LEVEL for one logger"
            )
        options.levels[logger if found else ""] = level


def add_parameter(options: RosOptions, text: str) -> None:
    """Add the parameter in `text`, which is `name:=value` or `node:name:=value`, to the options."""
    from tftool.ros.host.parameter_files import yaml_value

    name, found, value = text.partition(":=")
    if not found or not name:
        raise UsageError(f"'{text}' is not a valid parameter assignment: write name:=value")
    node, found, rest = name.rpartition(":")
    options.parameters.append((node if found else "", rest, yaml_value(value)))


def add_remap(options: RosOptions, text: str) -> None:
    """Add the remapping rule in `text`, which is `old:=new` or `node:old:=new`, to the options.

    The rules `__node:=new` and `__ns:=new` rename the node and set its namespace.
    """
    old, found, new = text.partition(":=")
    if not found or not old or not new:
        raise UsageError(f"'{text}' is not a valid remapping: write old:=new")
    node, found, rest = old.rpartition(":")
    if rest in ("__node", "__name"):
        check_node_name(new)
        options.name = new
    elif rest == "__ns":
        check_namespace(new)
        options.namespace = new
    else:
        rule = Remap(node if found else None, rest.removeprefix("rostopic://"), new)
        for name in (rule.old, rule.new):
            fault = topic_name_fault(name)
            if fault is not None:
                raise UsageError(
                    f"'{text}' is not a valid remapping, because of the name '{name}': "
                    f"{fault.reason}"
                )
        options.remaps.append(rule)
