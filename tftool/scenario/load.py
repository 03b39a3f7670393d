"""Reader of scenarios in YAML, which reports the position of every mistake.

The tables `node_kinds.KINDS`, `script.ACTIONS` and `questions.SUBJECTS` define the kinds of nodes,
actions and questions. This module depends on no single kind of node, action or question.
"""

import re
from collections import Counter
from collections.abc import Iterable, Mapping
from operator import attrgetter
from pathlib import Path, PurePath
from types import MappingProxyType
from typing import Any

from tftool.base.errors import Mistake, ScenarioError, TftoolError, UsageError
from tftool.base.stamps import CACHE_TIME, Duration, as_seconds, seconds
from tftool.scenario import builtin, document
from tftool.scenario import doctor_expectations as doctoring
from tftool.scenario import units as values
from tftool.scenario.document import Document, Node, Scalar, text_of
from tftool.scenario.fields import (
    UNREAD,
    Key,
    Reading,
    Unreadable,
    listed,
    quoted,
    suggest,
    tagged,
)
from tftool.scenario.node_kinds import KINDS, check_robots, link_of
from tftool.scenario.scenario import Expectation, NodeEntry, Scenario, Step, When
from tftool.scenario.script import ACTIONS, StopNode
from tftool.world.clock import SimClock
from tftool.world.memory_limit import MAX_BYTES
from tftool.world.world import World

NO_ARGUMENTS: Mapping[str, str] = MappingProxyType({})

KEPT: Mapping[str, str] = MappingProxyType({"script": "", "expectations": "", "teleop": "teleop"})
"""Names of nodes that a run adds itself, with the kind of node that a scenario may give each to."""

JUDGE_EVERY: Duration = seconds(0.1)
"""Nanoseconds between two judgements of "by" and "during", by default."""

_WHEN = ("at", "by", "during", "always")

_WORD = re.compile(r"[A-Za-z_]\w*", re.ASCII)

MOST_JUDGEMENTS = 1_000_000
"""Largest number of judgements of all expectations of a scenario together."""


def load(
    path: Path | str, arguments: Mapping[str, str] = NO_ARGUMENTS, *, expects: bool = True
) -> Scenario:
    """Read a scenario file.

    Args:
        path: Path of the file.
        arguments: Values of arguments that the scenario declares.
        expects: Whether to read expectations. If false, only a built-in scenario's expectations are
            skipped; a user's file is always read completely, to find its mistakes.

    Raises:
        InputError: If the file cannot be read; a `ScenarioError` lists every mistake in the file.
        UsageError: If the scenario does not declare an argument that is given, or the value of
            an argument does not fit.
    """
    expects = expects or not builtin.is_shipped(Path(path))
    return parse(text_of(path), str(path), arguments, expects=expects)


def parse(
    text: str, name: str, arguments: Mapping[str, str] = NO_ARGUMENTS, *, expects: bool = True
) -> Scenario:
    """Read a scenario from a text; see `load`.

    Args:
        text: The YAML text.
        name: Name of the text in messages, usually its path.
        arguments: Values of arguments that the scenario declares.
        expects: Whether to read the expectations.
    """
    source = Document(text, name)
    reading = Reading(source)
    try:
        root = source.read()
        reading.mistakes.extend(source.mistakes)
        return _ScenarioReader(arguments, expects).scenario(root, reading, name)
    except Unreadable as error:
        by_place = attrgetter("line", "column")
        mistakes = sorted(reading.mistakes, key=by_place)
        if arguments and _is_readable(text, name, expects=expects):
            given = ", ".join(f"{key}={value}" for key, value in arguments.items())
            raise UsageError(
                f"scenario {quoted(PurePath(name).stem)} does not accept {quoted(given)}: "
                f"{mistakes[0].text} (line {mistakes[0].line})"
            ) from error
        raise ScenarioError(name, mistakes) from error


def _is_readable(text: str, name: str, *, expects: bool) -> bool:
    """Return whether a scenario can be read with the default values of its arguments."""
    try:
        parse(text, name, expects=expects)
    except ScenarioError:
        return False
    return True


class _ScenarioReader:
    """Reader of a scenario in one pass; actions, for example, are checked against earlier nodes.

    Attributes:
        given_arguments: Arguments from the command line.
        expects: Whether expectations are read.
        duration: Duration of the scenario; None before the duration is read.
        names: Names of the scenario's nodes; None until all nodes are read.
        judgements: Number of judgements in the run, for the expectations read so far.
        warnings: Mistakes of nodes that do not prevent playing the scenario.
    """

    def __init__(self, arguments: Mapping[str, str], expects: bool) -> None:
        self.given_arguments = arguments
        self.expects = expects
        self.duration: Duration | None = None
        self.names: tuple[str, ...] | None = None
        self.judgements = 0
        self.warnings: list[Mistake] = []

    def scenario(self, root: Node, reading: Reading, name: str) -> Scenario:
        """Read the whole scenario, in an order in which each part needs only earlier parts."""
        known = {
            "about": Key(values.text, ""),
            "arguments": Key(self.arguments, NO_ARGUMENTS),
            "duration": Key(self.length),
            "cache_time": Key(values.time(), CACHE_TIME),
            "doctor": Key(doctoring.rules, doctoring.NO_RULES),
            "nodes": Key(self.nodes, ()),
            "script": Key(self.script, ()),
            "expect": Key(self.expect if self.expects else lambda *_: (), ()),
        }
        entries = reading.entries(root, listed(known))
        if "arguments" not in entries:
            self.check_arguments({}, reading)
        if "nodes" not in entries:
            self.names = ()
        found = reading.values(root.place, entries, known, "a scenario")
        if reading.mistakes:
            raise Unreadable
        return Scenario(
            name=PurePath(name).stem or name,
            file=name,
            about=found["about"],
            arguments=found["arguments"],
            duration=found["duration"],
            cache_time=found["cache_time"],
            nodes=found["nodes"],
            script=found["script"],
            expect=found["expect"],
            doctor=found["doctor"],
            source=reading.source.text,
            warnings=tuple(self.warnings),
        )

    # Arguments, which the other parts use.

    def arguments(self, node: Node, reading: Reading) -> Mapping[str, str]:
        """Return the declared arguments with their values: from the command line, else defaults."""
        entries = reading.entries(node, "name: default")
        declared: dict[str, str] = {}
        whole = True
        for name, (key, value) in entries.items():
            if _WORD.fullmatch(name) is None:
                whole = False
                reading.note(
                    key,
                    f"{quoted(name)} is not a valid name of an argument: use only letters, digits "
                    "and _",
                )
                continue
            # A default is read as text; each use of the argument parses it.
            default = reading.try_read(values.text, value)
            whole = whole and default is not UNREAD
            declared[name] = default
        reading.arguments = {key: text for key, text in declared.items() if text is not UNREAD}
        if not whole:
            raise Unreadable
        self.check_arguments(declared, reading)
        reading.arguments = {**declared, **self.given_arguments}
        return MappingProxyType(reading.arguments)

    def check_arguments(self, declared: Mapping[str, str], reading: Reading) -> None:
        """Raise UsageError if the user gives an argument that the scenario does not declare."""
        for name in self.given_arguments:
            if name not in declared:
                have = f"; it has {listed(declared)}" if declared else "; it has none"
                raise UsageError(
                    f"scenario {quoted(PurePath(reading.source.name).stem)} has no argument "
                    f"{quoted(name)}{suggest(name, declared) or have}"
                )

    def length(self, node: Node, reading: Reading) -> Duration:
        """Read the duration of the scenario."""
        self.duration = values.time(least=values.SHORTEST)(node, reading)
        return self.duration

    def moment(self, node: Node, reading: Reading) -> Duration:
        """Read a time since the start; the time must not be after the scenario's end."""
        at: Duration = values.duration(node, reading)
        if self.duration is not None and at > self.duration:
            raise reading.refuse(
                node,
                f"{as_seconds(at):g} s is after the end of the scenario, "
                f"which lasts {as_seconds(self.duration):g} s",
            )
        return at

    # Nodes.

    def nodes(self, node: Node, reading: Reading) -> tuple[NodeEntry, ...]:
        """Read the scenario's nodes, and give each node a unique name."""
        items = [self.node(item, reading) for item in reading.items(node, "one node per item")]
        counts = Counter(kind for kind, _, _ in items)
        numbers: Counter[str] = Counter()
        found: list[NodeEntry] = []
        taken: dict[str, int] = {}
        whole = True
        for item, (kind, given_name, parameters) in zip(
            reading.items(node, ""), items, strict=True
        ):
            numbers[kind] += 1
            name = given_name or (f"{kind}{numbers[kind]}" if counts[kind] > 1 else kind)
            if name in KEPT and KEPT[name] != kind:
                whole = False
                reading.note(item, f"the name '{name}' is reserved; choose another name")
            if name in taken:
                whole = False
                reading.note(
                    item,
                    f"the node of line {taken[name]} is also named {quoted(name)}: give one of "
                    "them another name",
                )
            taken.setdefault(name, item.place.line + 1)
            if kind == "" or parameters is UNREAD:
                whole = False
            else:
                found.append(NodeEntry(kind, name, MappingProxyType(parameters)))
        if counts[""] == 0:
            self.names = tuple(taken)
        if not whole:
            raise Unreadable
        self.warnings += check_robots(reading.items(node, ""), items, reading)
        self.check_tree(reading.items(node, ""), items, reading)
        return tuple(found)

    def check_tree(
        self, nodes: Iterable[Node], items: Iterable[tuple[str, str, Any]], reading: Reading
    ) -> None:
        """Record a mistake for each node that gives a frame a second parent, or closes a loop."""
        parents: dict[str, tuple[str, int]] = {}
        for item, (kind, _, parameters) in zip(nodes, items, strict=True):
            link = None if parameters is UNREAD else link_of(kind, parameters)
            if link is None:
                continue
            parent, child = link
            above = [parent]
            while above[-1] != child and above[-1] in parents and len(above) <= len(parents):
                above.append(parents[above[-1]][0])
            known, line = parents.get(child, (parent, 0))
            if parent == child:
                text = f"frame {quoted(child)} cannot be its own parent"
            elif known != parent:
                text = (
                    f"frame {quoted(child)} has two parents: {quoted(known)} (line {line}) "
                    f"and {quoted(parent)}, but a frame can have only one parent"
                )
            elif above[-1] == child:
                path = ", whose parent is ".join(quoted(one) for one in above)
                text = f"the frames form a loop: the parent of {quoted(child)} is {path}"
            else:
                parents.setdefault(child, (parent, item.place.line + 1))
                continue
            self.warnings.append(reading.source.mistake(item.place, text))

    def node(self, item: Node, reading: Reading) -> tuple[str, str, Any]:
        """Return a node's kind, name and parameters; "" for an unknown kind or no name."""
        if isinstance(item, Scalar) and not item.is_nothing:
            # Just the kind: `- turtlesim`.
            entries: Mapping[str, tuple[Scalar, Node]] = {item.text: (item, Scalar(item.place, ""))}
        else:
            read = reading.try_read(lambda node, r: r.entries(node, "a node's kind"), item)
            if read is UNREAD:
                return "", "", UNREAD
            entries = read
        if not entries:
            reading.note(item, f"no kind of node is given here: write one of {listed(KINDS)}")
            return "", "", UNREAD
        (kind, (key, value)), *more = entries.items()
        if kind not in KINDS:
            near = suggest(kind, KINDS) or f"; there are {listed(KINDS)}"
            reading.note(key, f"there is no kind of node {quoted(kind)}{near}")
            return "", "", UNREAD
        for word, (other, _) in more:
            hint = (
                f"write '{kind}: {{{word}: ...}}', or indent '{word}' further"
                if word in KINDS[kind].fields or word == "name"
                else "begin each node with '- '"
            )
            reading.note(
                other, f"{quoted(word)} is at the same level as '{kind}', not below it: {hint}"
            )
        known = {**KINDS[kind].fields, "name": Key(values.name("a node"), "")}
        parameters = reading.try_read(lambda node, r: r.record(node, known, f"a {kind}"), value)
        if parameters is UNREAD:
            return kind, self.name_of(value), UNREAD
        name = parameters.pop("name")
        try:
            # Created once in a separate world, so that the node checks its parameters itself.
            # The user's limit of memory is not checked here: it is no fault of the file.
            KINDS[kind].build(World(SimClock(), max_bytes=MAX_BYTES), name or kind, parameters)
        except TftoolError as error:
            reading.note(key, str(error))
            return kind, name, UNREAD
        return kind, name, UNREAD if more else parameters

    @staticmethod
    def name_of(value: Node) -> str:
        """Return the name in a node's mapping, even if other keys are wrong; "" without a name."""
        for key, entry in value.entries if isinstance(value, document.Mapping) else ():
            if key.text == "name" and isinstance(entry, Scalar):
                return entry.text
        return ""

    # Script and expectations.

    def script(self, node: Node, reading: Reading) -> tuple[Step, ...]:
        """Read the actions of the script."""
        read = [
            reading.try_read(self.step, item) for item in reading.items(node, "one action per item")
        ]
        return tuple(reading.whole(read))

    def step(self, node: Node, reading: Reading) -> Step:
        """Read one action of the script and its time."""
        common = {"at": Key(self.moment), "fails": Key(values.flag, False)}
        name, action, given = tagged(node, reading, "an action", ACTIONS, common, {})
        if isinstance(action, StopNode) and self.names is not None:
            known = (*self.names, "teleop")
            if action.node not in known:
                near = suggest(action.node, known) or f"; there are {listed(known)}"
                raise reading.refuse(node, f"no node is named {quoted(action.node)}{near}")
        return Step(given["at"], action, node.place.line + 1, name, given["fails"])

    def expect(self, node: Node, reading: Reading) -> tuple[Expectation, ...]:
        """Read the expectations of the scenario."""
        read = [
            reading.try_read(self.expectation, item)
            for item in reading.items(node, "one expectation per item")
        ]
        return tuple(one for several in reading.whole(read) for one in several)

    def expectation(self, node: Node, reading: Reading) -> tuple[Expectation, ...]:
        """Read an expectation; return one `Expectation` for each time condition in it."""
        # Imported here, because most commands judge no expectations.
        from tftool.scenario.questions import SUBJECTS

        beside = {name: subject.form.fields for name, subject in SUBJECTS.items()}
        common = {
            "at": Key(self.moments, None),
            "by": Key(self.moment, None),
            "during": Key(values.several(self.moment, "first and last moment", 2), None),
            "always": Key(values.flag, None),
            "every": Key(values.period, None),
        }
        said = [key for key in _WHEN if key in reading.entries(node, listed(_WHEN))]
        if len(said) != 1:
            wrong = f"{listed(said)} exclude each other" if said else "the time is missing"
            reading.note(
                node, f"{wrong}; write one of at: 2 s, by: 20 s, during: [1 s, 5 s], always: true"
            )
        name, question, values_by_key = tagged(
            node, reading, "an expectation", SUBJECTS, common, beside
        )
        times = reading.try_read(lambda _, r: self.times(node.place, values_by_key, r), node)
        check = SUBJECTS[name].form.make({**vars(question), **values_by_key}, reading, node.place)
        if times is UNREAD:
            raise Unreadable
        line = node.place.line + 1
        return tuple(Expectation(when, question, check, line) for when in times)

    def moments(self, node: Node, reading: Reading) -> tuple[Duration, ...]:
        """Read one time or a list of times since the start."""
        if isinstance(node, document.Sequence):
            found: tuple[Duration, ...] = values.several(self.moment, "moments")(node, reading)
            if not found:
                raise reading.refuse(
                    node, "the list of times is empty: write at least one, such as 2 s"
                )
            return found
        return (self.moment(node, reading),)

    def times(
        self, position: document.TextPlace, values_by_key: Mapping[str, Any], reading: Reading
    ) -> tuple[When, ...]:
        """Read the times at which an expectation is judged."""
        said = [key for key in _WHEN if values_by_key[key] is not None]
        if len(said) != 1:
            raise Unreadable  # already reported
        every = JUDGE_EVERY if values_by_key["every"] is None else values_by_key["every"]
        if said == ["at"]:
            if values_by_key["every"] is not None:
                raise reading.refuse(
                    position, "'every' is only allowed together with 'by', 'during' or 'always'"
                )
            return tuple(When("at", at, at, every) for at in values_by_key["at"])
        end = self.duration or 0
        if said == ["always"] and not values_by_key["always"]:
            raise reading.refuse(
                position, "'always: false' tests nothing: leave the expectation out"
            )
        first, last = {
            "by": (0, values_by_key["by"]),
            "during": values_by_key["during"],
            "always": (0, end),
        }[said[0]]
        if first > last:
            raise reading.refuse(
                position,
                "the first time of 'during' is after the last time: exchange the two times",
            )
        self.judgements += (last - first) // every
        if self.judgements > MOST_JUDGEMENTS:
            raise reading.refuse(
                position,
                f"the scenario makes more than {MOST_JUDGEMENTS:,} checks: give 'every' a longer "
                "time",
            )
        return (When("by" if said == ["by"] else "during", first, last, every),)
