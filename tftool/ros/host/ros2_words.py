"""The words of ROS 2's own command line, read: `ros2 topic list`, `ros2 service call` and so on."""

import argparse
import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any, NoReturn

from tftool.base.errors import InputError, UsageError
from tftool.base.near_names import did_you_mean
from tftool.messages.classes import INTERFACES, Message
from tftool.messages.schema import FLOATS

PROFILES = ("default", "system_default", "sensor_data", "services_default", "parameters")
"""Names that `--qos-profile` takes; each is a member of rclpy's QoSPresetProfiles."""


class _Parser(argparse.ArgumentParser):
    """Refuses wrong words with a sentence, as all commands do."""

    def error(self, message: str) -> NoReturn:
        usage = self.format_usage().removeprefix("usage: ").strip()
        raise UsageError(f"{self.prog}: {message}. Usage: {' '.join(usage.split())}")


def parse(words: Sequence[str]) -> argparse.Namespace:
    """What `ros2 WORDS` asks for; `noun` and `verb` say which of the commands it is.

    Raises:
        UsageError: If there is no such command, or its words are wrong.
    """
    parser, _ = _parser()
    return parser.parse_args(list(words))


def verbs() -> dict[str, list[str]]:
    """The verbs there are of each command, in the order of the help."""
    return _parser()[1]


def _parser() -> tuple[_Parser, dict[str, list[str]]]:
    listed_verbs: list[Any] = []
    parser = _Parser(prog="ros2", add_help=False)
    nouns = parser.add_subparsers(dest="noun", required=True, metavar="COMMAND")

    def noun(name: str) -> Any:
        verbs = nouns.add_parser(name).add_subparsers(dest="verb", required=True, metavar="VERB")
        listed_verbs.append(verbs)
        return verbs

    def verb(of: Any, name: str, *arguments: str) -> Any:
        parser = of.add_parser(name)
        for argument in arguments:
            parser.add_argument(argument)
        return parser

    def flag(of: Any, *names: str) -> None:
        of.add_argument(*names, action="store_true")

    def quality(of: Any) -> None:
        of.add_argument("--qos-profile", choices=PROFILES)
        of.add_argument("--qos-depth", type=_count)
        of.add_argument("--qos-history", choices=("keep_last", "keep_all"))
        of.add_argument("--qos-reliability", choices=("reliable", "best_effort"))
        of.add_argument("--qos-durability", choices=("volatile", "transient_local"))

    topic = noun("topic")
    listed = verb(topic, "list")
    flag(listed, "-t", "--show-types")
    flag(listed, "--include-hidden-topics")
    echo = verb(topic, "echo", "topic")
    echo.add_argument("type", nargs="?")
    flag(echo, "--once")
    echo.add_argument("--field")
    quality(echo)
    verb(topic, "find", "type")
    for name in ("hz", "bw", "delay"):
        measured = verb(topic, name, "topic")
        measured.add_argument("-w", "--window", type=_count, default=10_000)
    flag(verb(topic, "info", "topic"), "-v", "--verbose")
    verb(topic, "type", "topic")
    pub = verb(topic, "pub", "topic", "type")
    pub.add_argument("values", nargs="?", default="{}")
    pub.add_argument("-r", "--rate", type=_rate, default=1.0)
    pub.add_argument("-t", "--times", type=int, default=0)
    pub.add_argument("-w", "--wait-matching-subscriptions", type=int)
    flag(pub, "-1", "--once")
    quality(pub)

    service = noun("service")
    listed = verb(service, "list")
    flag(listed, "-t", "--show-types")
    flag(listed, "--include-hidden-services")
    verb(service, "type", "service")
    verb(service, "info", "service")
    verb(service, "find", "type")
    call = verb(service, "call", "service", "type")
    call.add_argument("values", nargs="?", default="{}")

    param = noun("param")
    verb(param, "list").add_argument("node", nargs="?")
    verb(param, "get", "node", "name")
    verb(param, "set", "node", "name", "value")
    verb(param, "dump", "node")
    verb(param, "describe", "node").add_argument("names", nargs="+")
    flag(verb(param, "load", "node", "file"), "--no-use-wildcard")

    node = noun("node")
    flag(verb(node, "list"), "-a", "--all")
    flag(verb(node, "info", "node"), "--include-hidden")

    action = noun("action")
    flag(verb(action, "list"), "-t", "--show-types")
    verb(action, "type", "action")
    flag(verb(action, "info", "action"), "-t", "--show-types")
    goal = verb(action, "send_goal", "action", "type", "values")
    flag(goal, "-f", "--feedback")

    interface = noun("interface")
    verb(interface, "show", "type")
    listed = verb(interface, "list")
    flag(listed, "-m", "--only-msgs")
    flag(listed, "-s", "--only-srvs")
    flag(listed, "-a", "--only-actions")
    verb(interface, "package", "package")
    verb(interface, "packages")
    flag(verb(interface, "proto", "type"), "--no-quotes")

    pkg = noun("pkg")
    verb(pkg, "list")
    executables = verb(pkg, "executables")
    executables.add_argument("package", nargs="?")
    flag(executables, "--full-path")
    verb(pkg, "prefix", "package")
    for of in (nouns, *listed_verbs):
        of.help = ", ".join(of.choices)
    return parser, {
        name: list(of.choices) for name, of in zip(nouns.choices, listed_verbs, strict=True)
    }


def _rate(text: str) -> float:
    with suppress(ValueError):
        if 0.0 < (rate := float(text)) < math.inf:
            return rate
    raise argparse.ArgumentTypeError(f"{text} is no number of Hz above 0")


def _count(text: str) -> int:
    if text.isdecimal() and int(text) > 0:
        return int(text)
    raise argparse.ArgumentTypeError(f"{text} is no whole number above 0")


def interface(name: str, kind: str) -> Any:
    """The class of an interface, "package/srv/Name" or "package/Name".

    Raises:
        UsageError: If it is not known; the nearest is told.
    """
    package, _, own = name.strip("/").partition("/")
    own = own.removeprefix(f"{kind}/")
    if not own or own not in INTERFACES.names(package, kind):
        known = [f"{one}/{kind}/{n}" for one in INTERFACES.packages()
                 for n in INTERFACES.names(one, kind)]  # fmt: skip
        hint = did_you_mean(f"{package}/{kind}/{own}", known)
        raise UsageError(f"there is no interface '{name}' of kind {kind}{hint}")
    try:
        return INTERFACES.find(package, kind, own)
    except InputError as error:
        raise UsageError(str(error)) from None


def definition(name: str) -> str:
    """The text of an interface's definition.

    Raises:
        UsageError: If it is not known.
    """
    package, _, own = name.partition("/")
    kind, _, short = own.rpartition("/")
    for one in [kind] if kind else ["msg", "srv", "action"]:
        if short in INTERFACES.names(package, one):
            return INTERFACES.text(package, one, short)
    interface(name, kind or "msg")
    raise UsageError(f"there is no interface '{name}'")


KINDS = {"msg": "Messages", "srv": "Services", "action": "Actions"}
"""The kinds of interfaces, and the headings that `ros2 interface list` gives them."""


def interfaces(package: str | None = None, kinds: Sequence[str] = tuple(KINDS)) -> list[str]:
    """Return the full names of the interfaces of some kinds, of one package or of all.

    Raises:
        UsageError: If there is no such package; a near name is offered.
    """
    if package is not None and package not in INTERFACES.packages():
        hint = did_you_mean(package, INTERFACES.packages())
        raise UsageError(f"there is no package of interfaces '{package}'{hint}")
    return [
        f"{one}/{kind}/{name}"
        for one in ([package] if package else sorted(INTERFACES.packages()))
        for kind in kinds
        for name in sorted(INTERFACES.names(one, kind))
    ]


def prototype(name: str) -> Any:
    """Return a message, request or goal of an interface with every field at its default.

    Raises:
        UsageError: If there is no such interface; a near name is offered.
    """
    parts = name.strip("/").split("/")
    kind = parts[1] if len(parts) == 3 else "msg"
    found = interface(name, kind if kind in KINDS else "msg")
    part = {"srv": "Request", "action": "Goal"}.get(kind)
    return (getattr(found, part) if part else found)()


def fill(message: Any, values: Any, where: str = "") -> None:
    """Set a message's fields from what YAML gave.

    Raises:
        UsageError: If a field is not there, or a value does not fit it; the field is named.
    """
    known = [field.name for field in message.fields__]
    if values is None or values == "":
        return
    if not isinstance(values, Mapping):
        what = f"'{where}'" if where else type(message).__name__
        raise UsageError(f"{what} takes fields, '{{name: value}}', not {values!r}: {known}")
    fields = {field.name: field for field in message.fields__}
    for name, value in values.items():
        path = f"{where}.{name}" if where else str(name)
        field = fields.get(name)
        if field is None:
            hint = did_you_mean(str(name), known)
            names = ", ".join(known) or "none"
            raise UsageError(
                f"{type(message).__name__} has no field '{path}' (it has {names}){hint}"
            )
        current = getattr(message, name)
        if isinstance(current, Message):
            fill(current, value, path)
            continue
        try:
            setattr(message, name, _fitting(field, value, path))
        except (AssertionError, TypeError, ValueError, OverflowError) as error:
            raise UsageError(f"'{path}' cannot be {value!r}: {error}") from None


def _fitting(field: Any, value: Any, path: str) -> Any:
    if field.size is not None and not isinstance(field.kind, str):
        if not isinstance(value, list):
            raise TypeError("it takes a list")
        made = []
        for number, one in enumerate(value):
            element = field.kind()
            fill(element, one, f"{path}[{number}]")
            made.append(element)
        return made
    if field.kind in FLOATS:
        if isinstance(value, list):
            return [float(one) for one in value]
        return float(value) if type(value) is int else value
    return value


def plain(value: Any) -> Any:
    """A message as YAML can show it: mappings, lists and single values."""
    if isinstance(value, Message):
        return {field.name: plain(getattr(value, field.name)) for field in value.fields__}
    if isinstance(value, bytes | bytearray):
        return list(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, list | tuple):
        return [plain(one) for one in value]
    return value
