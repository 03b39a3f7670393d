"""Parser of ROS 2's command line: `ros2 topic list`, `ros2 service call` and so on."""

import argparse
import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from typing import Any, NoReturn, TypeAlias

from tftool.base.errors import InputError, UsageError
from tftool.base.near_names import did_you_mean
from tftool.messages.classes import INTERFACES, Message
from tftool.messages.schema import FLOATS

PROFILES = ("default", "system_default", "sensor_data", "services_default", "parameters")
"""Names that `--qos-profile` takes; each is a member of rclpy's QoSPresetProfiles."""


class _Parser(argparse.ArgumentParser):
    """Parser that refuses wrong words with a sentence, as all commands do."""

    def error(self, message: str) -> NoReturn:
        usage = self.format_usage().removeprefix("usage: ").strip()
        raise UsageError(f"{self.prog}: {message}. Usage: {' '.join(usage.split())}")


def parse(words: Sequence[str]) -> argparse.Namespace:
    """Parse `ros2 WORDS`; `noun` and `verb` give the command.

    Raises:
        UsageError: If there is no such command, or its words are wrong.
    """
    parser, _ = _parser()
    return parser.parse_args(list(words))


def verbs() -> dict[str, list[str]]:
    """Return the verbs of each command, in the order of the help."""
    return _parser()[1]


def _parser() -> tuple[_Parser, dict[str, list[str]]]:
    parser = _Parser(prog="ros2", add_help=False)
    nouns = parser.add_subparsers(dest="noun", required=True, metavar="COMMAND")
    listed: dict[str, list[str]] = {}
    for noun, verbs in _arguments().items():
        below = nouns.add_parser(noun).add_subparsers(dest="verb", required=True, metavar="VERB")
        for verb, arguments in verbs.items():
            one = below.add_parser(verb)
            for names, how in arguments:
                one.add_argument(*names, **how)
        listed[noun] = list(verbs)
        below.help = ", ".join(verbs)
    nouns.help = ", ".join(listed)
    return parser, listed


_Argument: TypeAlias = tuple[tuple[str, ...], dict[str, Any]]


def _arguments() -> dict[str, dict[str, list[_Argument]]]:
    """Return the arguments of each command's verbs, as for argparse's `add_argument`."""

    def flag(*names: str) -> _Argument:
        return names, {"action": "store_true"}

    def word(name: str, **how: Any) -> _Argument:
        return (name,), how

    types, values = flag("-t", "--show-types"), word("values", nargs="?", default="{}")
    topic, service, node, kind = word("topic"), word("service"), word("node"), word("type")
    measured = [topic, (("-w", "--window"), {"type": _count, "default": 10_000})]
    quality = [
        word("--qos-profile", choices=PROFILES),
        word("--qos-depth", type=_count),
        word("--qos-history", choices=("keep_last", "keep_all")),
        word("--qos-reliability", choices=("reliable", "best_effort")),
        word("--qos-durability", choices=("volatile", "transient_local")),
    ]
    return {
        "topic": {
            "list": [types, flag("--include-hidden-topics")],
            "echo": [topic, word("type", nargs="?"), flag("--once"), word("--field"), *quality],
            "find": [kind],
            "hz": measured,
            "bw": measured,
            "delay": measured,
            "info": [topic, flag("-v", "--verbose")],
            "type": [topic],
            "pub": [*_publishing(topic, kind, values), *quality],
        },
        "service": {
            "list": [types, flag("--include-hidden-services")],
            "type": [service],
            "info": [service],
            "find": [kind],
            "call": [service, kind, values],
        },
        "param": {
            "list": [word("node", nargs="?")],
            "get": [node, word("name")],
            "set": [node, word("name"), word("value")],
            "dump": [node],
            "describe": [node, word("names", nargs="+")],
            "load": [node, word("file"), flag("--no-use-wildcard")],
        },
        "node": {"list": [flag("-a", "--all")], "info": [node, flag("--include-hidden")]},
        "action": {
            "list": [types],
            "type": [word("action")],
            "info": [word("action"), types],
            "send_goal": [word("action"), kind, word("values"), flag("-f", "--feedback")],
        },
        "interface": _of_interfaces(flag, kind),
        "pkg": {
            "list": [],
            "executables": [word("package", nargs="?"), flag("--full-path")],
            "prefix": [word("package")],
        },
    }


def _publishing(*words: _Argument) -> list[_Argument]:
    return [
        *words,
        (("-r", "--rate"), {"type": _rate, "default": 1.0}),
        (("-t", "--times"), {"type": int, "default": 0}),
        (("-w", "--wait-matching-subscriptions"), {"type": int}),
        (("-1", "--once"), {"action": "store_true"}),
    ]


def _of_interfaces(flag: Callable[..., _Argument], kind: _Argument) -> dict[str, list[_Argument]]:
    return {
        "show": [kind],
        "list": [
            flag("-m", "--only-msgs"),
            flag("-s", "--only-srvs"),
            flag("-a", "--only-actions"),
        ],
        "package": [(("package",), {})],
        "packages": [],
        "proto": [kind, flag("--no-quotes")],
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
    """Return the class of an interface, "package/srv/Name" or "package/Name".

    Raises:
        UsageError: If it is unknown, with the nearest name.
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
    """Return the text of an interface's definition.

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
    """Return the full names of the interfaces of some kinds, of one package or all.

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
    """Set a message's fields from parsed YAML.

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
    """Convert a message for YAML: mappings, lists and single values."""
    if isinstance(value, Message):
        return {field.name: plain(getattr(value, field.name)) for field in value.fields__}
    if isinstance(value, bytes | bytearray):
        return list(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, list | tuple):
        return [plain(one) for one in value]
    return value
