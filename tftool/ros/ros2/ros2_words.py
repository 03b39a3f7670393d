"""Parser of command lines of `ros2`, such as `ros2 topic list` or `ros2 service call`."""

import argparse
import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any, NoReturn

from tftool.base.errors import UsageError

SESSIONLESS = ("interface", "pkg")
"""Commands that only read files, without a session of running nodes."""

_QUALITY = "--qos-profile --qos-depth --qos-history --qos-reliability --qos-durability"

_COMMANDS = f"""
topic list: -t/--show-types -c/--count-topics -v/--verbose --include-hidden-topics
topic echo: topic [type] --once --field --filter --csv --flow-style --no-arr --no-str
    -l/--truncate-length -f/--full-length {_QUALITY}
topic find: type
topic hz: topic --filter -w/--window
topic bw: topic --filter -w/--window
topic delay: topic --filter -w/--window
topic info: topic -v/--verbose
topic type: topic
topic pub: topic type [values] -r/--rate -t/--times -w/--wait-matching-subscriptions -1/--once
    -p/--print --keep-alive {_QUALITY}
service list: -t/--show-types -c/--count-services --include-hidden-services
service type: service
service info: service
service find: type
service call: service type [values] -r/--rate
param list: [node] --param-type
param get: node name --hide-type
param set: node name value
param delete: node name
param dump: node
param describe: node names
param load: node file --no-use-wildcard
node list: -a/--all -c/--count-nodes
node info: node --include-hidden
action list: -t/--show-types -c/--count-actions
action type: action
action info: action -t/--show-types
action send_goal: action type values -f/--feedback
interface show: type
interface list: -m/--only-msgs -s/--only-srvs -a/--only-actions
interface package: package
interface packages:
interface proto: type --no-quotes
pkg list:
pkg executables: [package] --full-path
pkg prefix: package --share
pkg xml: package -t
"""
"""Arguments of each command, in brackets if they may be left out, and its options."""

_ASKING = ("--no-daemon", "-s/--use-sim-time", "--spin-time")
"""Options of ROS 2 for queries of the graph, which have no effect in tftool."""


def _rate(text: str) -> float:
    with suppress(ValueError):
        if 0.0 < (rate := float(text)) < math.inf:
            return rate
    raise argparse.ArgumentTypeError(f"{text} is not a rate: write a number of Hz above 0")


def _count(text: str) -> int:
    if text.isdecimal() and int(text) > 0:
        return int(text)
    raise argparse.ArgumentTypeError(f"{text} is not a count: write a whole number above 0")


def _expression(text: str) -> Callable[[Any], bool]:
    """Return a function that evaluates the expression of the option --filter for a message.

    In the expression, the name `m` means the message.
    """
    try:
        code = compile(text, "--filter", "eval")
    except SyntaxError as error:
        raise argparse.ArgumentTypeError(
            f"'{text}' is not a Python expression: {error.msg}"
        ) from None
    # As in ROS 2, the person who types it runs their own code.
    return lambda message: bool(eval(code, {"m": message}))


_VALUES: dict[str, dict[str, Any]] = {
    "[values]": {"nargs": "?", "default": "{}"},
    "names": {"nargs": "+"},
    "--field": {},
    "--filter": {"dest": "wanted", "metavar": "EXPRESSION", "type": _expression},
    "--keep-alive": {"type": float, "default": 0.5},
    "--qos-profile": {
        # Each is a member of rclpy's QoSPresetProfiles.
        "choices": ("default", "system_default", "sensor_data", "services_default", "parameters")
    },
    "--qos-depth": {"type": _count},
    "--qos-history": {"choices": ("keep_last", "keep_all")},
    "--qos-reliability": {"choices": ("reliable", "best_effort")},
    "--qos-durability": {"choices": ("volatile", "transient_local")},
    "--spin-time": {"type": float},
    "-l/--truncate-length": {"type": _count, "default": 128},
    "-p/--print": {"type": _count, "default": 1, "dest": "each"},
    "-r/--rate": {"type": _rate},
    "-t": {"dest": "tag"},
    "-t/--times": {"type": int, "default": 0},
    "-w/--wait-matching-subscriptions": {"type": int},
    "-w/--window": {"type": _count, "default": 10_000},
}
"""Settings for argparse of two arguments and the options with a value; other options are flags."""


class _Parser(argparse.ArgumentParser):
    """Argument parser that raises a UsageError instead of printing the usage and exiting."""

    def error(self, message: str) -> NoReturn:
        usage = self.format_usage().removeprefix("usage: ").strip()
        raise UsageError(f"{self.prog}: {message}. Usage: {' '.join(usage.split())}")


def parse(words: Sequence[str]) -> argparse.Namespace:
    """Parse the words after `ros2`.

    Returns:
        Parsed arguments; `noun` and `verb` name the command, such as "topic" and "list".

    Raises:
        UsageError: If there is no such command, or an argument or option is wrong.
    """
    parser, _ = _parser()
    return parser.parse_args(list(words))


def verbs() -> dict[str, list[str]]:
    """Return the verbs of each noun, such as "list" for "topic", in the order of the help text."""
    return _parser()[1]


def _parser() -> tuple[_Parser, dict[str, list[str]]]:
    parser = _Parser(prog="ros2", add_help=False)
    nouns = parser.add_subparsers(dest="noun", required=True, metavar="COMMAND")
    below: dict[str, Any] = {}
    listed: dict[str, list[str]] = {}
    for line in _COMMANDS.replace("\n    ", " ").strip().splitlines():
        command, _, words = line.partition(":")
        noun, verb = command.split()
        if noun not in below:
            made = nouns.add_parser(noun)
            below[noun] = made.add_subparsers(dest="verb", required=True, metavar="VERB")
        listed.setdefault(noun, []).append(verb)
        one = below[noun].add_parser(verb)
        for word in (*words.split(), *(() if noun in SESSIONLESS else _ASKING)):
            otherwise = {"action": "store_true"} if word.startswith("-") else {}
            otherwise |= {"nargs": "?"} if word.startswith("[") else {}
            one.add_argument(*word.strip("[]").split("/"), **_VALUES.get(word, otherwise))
    for noun, known in listed.items():
        below[noun].help = ", ".join(known)
    nouns.help = ", ".join(listed)
    return parser, listed
