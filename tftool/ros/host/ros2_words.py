"""Parser of ROS 2's command line: `ros2 topic list`, `ros2 service call` and so on."""

import argparse
import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
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
            for names, how in (*arguments, *(_ASKING if noun not in SESSIONLESS else ())):
                one.add_argument(*names, **how)
        listed[noun] = list(verbs)
        below.help = ", ".join(verbs)
    nouns.help = ", ".join(listed)
    return parser, listed


_Argument: TypeAlias = tuple[tuple[str, ...], dict[str, Any]]

SESSIONLESS = ("interface", "pkg")
"""Commands that files answer: no session is asked."""

_ASKING: tuple[_Argument, ...] = (
    (("--no-daemon",), {"action": "store_true"}),
    (("-s", "--use-sim-time"), {"action": "store_true"}),
    (("--spin-time",), {"type": float}),
)
"""Options about how a graph is asked, which make no difference here."""


def _arguments() -> dict[str, dict[str, list[_Argument]]]:
    """Return the arguments of each command's verbs, as for argparse's `add_argument`."""

    def flag(*names: str) -> _Argument:
        return names, {"action": "store_true"}

    def word(name: str, **how: Any) -> _Argument:
        return (name,), how

    types, values = flag("-t", "--show-types"), word("values", nargs="?", default="{}")
    filtered = word("--filter", dest="wanted", metavar="EXPRESSION", type=_expression)
    topic, service, node, kind = word("topic"), word("service"), word("node"), word("type")
    measured = [topic, filtered, (("-w", "--window"), {"type": _count, "default": 10_000})]
    quality = [
        word("--qos-profile", choices=PROFILES),
        word("--qos-depth", type=_count),
        word("--qos-history", choices=("keep_last", "keep_all")),
        word("--qos-reliability", choices=("reliable", "best_effort")),
        word("--qos-durability", choices=("volatile", "transient_local")),
    ]
    return {
        "topic": {
            "list": [
                types,
                flag("-c", "--count-topics"),
                flag("-v", "--verbose"),
                flag("--include-hidden-topics"),
            ],
            "echo": [
                *(topic, word("type", nargs="?"), flag("--once"), word("--field"), filtered),
                *(flag("--csv"), flag("--flow-style"), flag("--no-arr"), flag("--no-str")),
                (("-l", "--truncate-length"), {"type": _count, "default": 128}),
                flag("-f", "--full-length"),
                *quality,
            ],
            "find": [kind],
            "hz": measured,
            "bw": measured,
            "delay": measured,
            "info": [topic, flag("-v", "--verbose")],
            "type": [topic],
            "pub": [*_publishing(topic, kind, values), *quality],
        },
        "service": {
            "list": [types, flag("-c", "--count-services"), flag("--include-hidden-services")],
            "type": [service],
            "info": [service],
            "find": [kind],
            "call": [service, kind, values, (("-r", "--rate"), {"type": _rate})],
        },
        "param": {
            "list": [word("node", nargs="?"), flag("--param-type")],
            "get": [node, word("name"), flag("--hide-type")],
            "set": [node, word("name"), word("value")],
            "delete": [node, word("name")],
            "dump": [node],
            "describe": [node, word("names", nargs="+")],
            "load": [node, word("file"), flag("--no-use-wildcard")],
        },
        "node": {
            "list": [flag("-a", "--all"), flag("-c", "--count-nodes")],
            "info": [node, flag("--include-hidden")],
        },
        "action": {
            "list": [types, flag("-c", "--count-actions")],
            "type": [word("action")],
            "info": [word("action"), types],
            "send_goal": [word("action"), kind, word("values"), flag("-f", "--feedback")],
        },
        "interface": _of_interfaces(flag, kind),
        "pkg": {
            "list": [],
            "executables": [word("package", nargs="?"), flag("--full-path")],
            "prefix": [word("package"), flag("--share")],
            "xml": [word("package"), word("-t", dest="tag")],
        },
    }


def _publishing(*words: _Argument) -> list[_Argument]:
    return [
        *words,
        (("-r", "--rate"), {"type": _rate, "default": 1.0}),
        (("-t", "--times"), {"type": int, "default": 0}),
        (("-w", "--wait-matching-subscriptions"), {"type": int}),
        (("-1", "--once"), {"action": "store_true"}),
        (("-p", "--print"), {"type": _count, "default": 1, "dest": "each"}),
        (("--keep-alive",), {"type": float, "default": 0.5}),
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


def _expression(text: str) -> Callable[[Any], bool]:
    """Return the function of a message `m` that an expression describes."""
    try:
        code = compile(text, "--filter", "eval")
    except SyntaxError as error:
        raise argparse.ArgumentTypeError(f"'{text}' is no expression: {error.msg}") from None
    # As in ROS 2, the person who types it runs their own code.
    return lambda message: bool(eval(code, {"m": message}))


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


@dataclass(frozen=True, slots=True)
class Shortening:
    """Parts of a message that are left out.

    Attributes:
        length: How many elements of a list, or letters of a text, are shown; None for all.
        no_arr: Whether a list is replaced by its type and length.
        no_str: Whether a text is replaced by its length.
    """

    length: int | None = None
    no_arr: bool = False
    no_str: bool = False


WHOLE = Shortening()


def plain(value: Any, short: Shortening = WHOLE) -> Any:
    """Convert a message for YAML: mappings, lists and single values."""
    if isinstance(value, Message):
        types = value.get_fields_and_field_types() if short.no_arr else {}
        return {
            field.name: _summary(getattr(value, field.name), types[field.name])
            if field.size is not None and short.no_arr
            else plain(getattr(value, field.name), short)
            for field in value.fields__
        }
    if isinstance(value, bytes | bytearray):
        value = list(value)
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, str):
        if short.no_str:
            return f"<string length: <{len(value)}>>"
        is_long = short.length is not None and len(value) > short.length
        return f"{value[: short.length]}..." if is_long else value
    if isinstance(value, list | tuple):
        shown = [plain(one, short) for one in value[: short.length]]
        return shown if len(shown) == len(value) else [*shown, "..."]
    return value


def _summary(value: Any, kind: str) -> str:
    """Return the type of a list, "double[36]" or "sequence<double>", and its length."""
    if not kind.startswith("sequence<"):
        return f"<array type: {kind}>"
    element = kind.removeprefix("sequence<").removesuffix(">")
    name, _, bound = element.partition(", ")
    return f"<sequence type: {name}{bound and f'<{bound}>'}, length: {len(value)}>"


def as_yaml(shown: Any, *, flow_style: bool = False) -> str:
    """Return a value of `plain` as YAML, with its line's end."""
    import yaml  # Not for a command line alone.

    if not isinstance(shown, dict | list):
        return f"{shown}\n"
    text: str = yaml.safe_dump(
        shown,
        sort_keys=False,
        allow_unicode=True,
        default_flow_style=flow_style,
        width=math.inf,
    )
    return text


def as_csv(shown: Any) -> str:
    """Return the single values in a value of `plain`, separated by commas."""
    return ",".join(str(value) for value in _single_values(shown))


def _single_values(value: Any) -> list[Any]:
    if isinstance(value, Mapping):
        value = list(value.values())
    if isinstance(value, list):
        return [one for part in value for one in _single_values(part)]
    return [value]
