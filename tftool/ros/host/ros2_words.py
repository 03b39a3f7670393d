"""Parser of ROS 2's command line: `ros2 topic list`, `ros2 service call` and so on."""

import argparse
import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any, NoReturn, TypeAlias

from tftool.base.errors import UsageError

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
