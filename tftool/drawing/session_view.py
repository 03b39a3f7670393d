"""Processes, nodes, topics and services of a session, as lines in aligned columns."""

from collections.abc import Iterable, Mapping, Sequence
from datetime import datetime
from typing import Any

from rich.cells import cell_len
from rich.text import Text

from tftool.base.plain_text import visible
from tftool.drawing.table_columns import TableColumn, fit, middle_cut, padded, wrap_words

ROLES = {"host": "hosts the world", "source": "has its own world", "guest": "joined"}
"""Role of a process in the session, in words."""

INDENT = "  "

_EVERY_NODES = ("rcl_interfaces/", "type_description_interfaces/")
"""Beginnings of the types of the services that every node of ROS 2 has."""


def lines(
    session: Mapping[str, Any],
    *,
    verbose: bool = False,
    width: int | None = None,
    height: int | None = None,
    ascii_only: bool = False,
) -> list[Text]:
    """Return a session's processes, nodes, topics and services as lines; names are escaped.

    Args:
        session: Output of `tftool session --json`.
        verbose: Whether to list the services that every node has.
        width: Width in cells to which long lists are wrapped; None for one line per list.
        height: Height of the terminal in lines; longer output is shortened. None for no limit.
        ascii_only: Whether to draw with ASCII only.
    """
    writer = _Writer(width, "~" if ascii_only else "…")
    told = _processes(writer, session["processes"])
    ours = {node for one in session["processes"] for node in one["nodes"]}
    others = [node for node in session["nodes"] if node not in ours]
    if others:
        told += writer.heading("Other nodes", len(others))
        told += writer.rows([visible(node) for node in others])
    head = list(told)
    told += _topics(writer, session["topics"])
    told += _services(writer, session["services"], verbose=verbose)
    if height is None or width is None or verbose or len(told) < height:
        return told
    return head + _brief(writer, session["topics"], session["services"], ascii_only=ascii_only)


def _processes(writer: "_Writer", processes: Sequence[Mapping[str, Any]]) -> list[Text]:
    return writer.heading("Processes", len(processes)) + writer.rows(
        [f"tftool {visible(one['command'])}" for one in processes],
        [
            TableColumn("", [(f"process {one['pid']}", "dim") for one in processes], drop_order=1),
            TableColumn("", [(ROLES[one["role"]], "") for one in processes]),
            TableColumn(
                "", [(f"since {_clock(one['since'])}", "dim") for one in processes], drop_order=2
            ),
        ],
        [_names(one["nodes"], "no nodes") for one in processes],
    )


def _topics(writer: "_Writer", topics: Mapping[str, Any]) -> list[Text]:
    return writer.heading("Topics", len(topics)) + writer.rows(
        [visible(name) for name in topics],
        [
            TableColumn("", [(f"{one['rate']:.1f} Hz", "") for one in topics.values()], True),
            TableColumn(
                "", [(visible(one["type"]), "cyan") for one in topics.values()], drop_order=1
            ),
        ],
        [
            f"from {_names(one['publishers'], 'none')}, to {_names(one['subscribers'], 'none')}"
            for one in topics.values()
        ],
    )


def _services(writer: "_Writer", services: Mapping[str, Any], *, verbose: bool) -> list[Text]:
    shown = {
        name: service["type"]
        for name, service in services.items()
        if verbose or not _is_left_out(name, service["type"])
    }
    told = writer.heading("Services", len(services), shown=len(shown))
    types = [(visible(ros_type), "cyan") for ros_type in shown.values()]
    told += writer.rows([visible(name) for name in shown], [TableColumn("", types, drop_order=1)])
    folded = len(services) - len(shown)
    if folded:
        sentence = f"and {folded} of parameters and actions (--verbose lists them)"
        told.append(Text(f"{INDENT}{sentence}", style="dim"))
    return told


def _brief(
    writer: "_Writer",
    topics: Mapping[str, Any],
    services: Mapping[str, Any],
    *,
    ascii_only: bool,
) -> list[Text]:
    """Return short lines for a small terminal: one per topic, and few for all services."""
    shown = {name: one for name, one in topics.items() if "/_action/" not in name}
    arrow = "->" if ascii_only else "→"
    most = max(16, (writer.width or 80) // 2)
    room = most - cell_len(arrow) - 2
    left = [_few(one["publishers"], room // 2, writer.more) for one in shown.values()]
    widest = max(map(cell_len, left), default=0)
    right = [
        _few(one["subscribers"], room - widest, writer.more, after=one["publishers"])
        for one in shown.values()
    ]
    ways = [
        (f"{padded(senders, widest)} {arrow} {receivers}", "dim")
        for senders, receivers in zip(left, right, strict=True)
    ]
    rates = [(f"{one['rate']:.1f} Hz", "" if one["rate"] else "dim") for one in shown.values()]
    told = writer.heading("Topics", len(topics), f", from {arrow} to", shown=len(shown))
    told += writer.rows(
        [visible(name) for name in shown],
        [TableColumn("", rates, True), TableColumn("", ways, caps=(most, 16), drop_order=1)],
    )
    names = [visible(name) for name, one in services.items() if not _is_left_out(name, one["type"])]
    told += writer.heading("Services", len(services), shown=len(names))
    listed = wrap_words(", ".join(names), max(10, (writer.width or 80) - len(INDENT)))
    told += [Text(f"{INDENT}{line}") for line in listed] if names else []
    folded = len(topics) - len(shown), len(services) - len(names)
    if any(folded):
        words = f"and {folded[0]} topics, {folded[1]} services of parameters and actions"
        told.append(Text(f"{INDENT}{words} (--verbose)", style="dim"))
    return told


def _few(nodes: Iterable[str], width: int, more: str, *, after: Sequence[str] = ()) -> str:
    """Return the names of nodes in at most `width` cells; `more` marks a shortened name.

    If the names are too long, return the first name and the number of other nodes. The names in
    `after` (publishers of the same topic) come last, so that other names are shown.
    """
    found = sorted(set(nodes), key=lambda node: (node in after, node))
    names = ", ".join(map(visible, found)) or "-"
    if len(found) > 1 and cell_len(names) > width:
        rest = f" +{len(found) - 1}"
        return middle_cut(visible(found[0]), max(1, width - len(rest)), more=more) + rest
    return middle_cut(names, width, more=more)


class _Writer:
    """Writer of rows in aligned columns; without a width, each row is one line of any length."""

    def __init__(self, width: int | None, more: str) -> None:
        self.width = width
        self.more = more

    def heading(
        self, what: str, count: int, more: str = "", *, shown: int | None = None
    ) -> list[Text]:
        """Return the lines of a heading, such as "Topics (12, 5 shown)".

        Args:
            what: Kind of the listed things, in the plural.
            count: Number of all things.
            more: Text after the heading.
            shown: Number of the listed things; None for all.
        """
        part = "" if shown in (None, count) else f", {shown} shown"
        # On a terminal, a blank line keeps the lists apart.
        above = [Text()] * (self.width is not None and what != "Processes")
        return [*above, Text.assemble((f"{what} ({count}{part})", "bold"), (more, "dim"))]

    def rows(
        self, names: Sequence[str], columns: Sequence[TableColumn] = (), lists: Sequence[str] = ()
    ) -> list[Text]:
        """Return a row for each name: the name, its cells of `columns`, its text of `lists`.

        With a width, the text of `lists` is wrapped in lines below the row.
        """
        if not names:
            return []
        longest = max(map(cell_len, names))
        room = 10**6 if self.width is None else self.width - len(INDENT)
        wanted = min(longest, max(16, room // 2))
        fitted = fit(columns, room, reserved=wanted, longest=longest, more=self.more)
        told = []
        for place, name in enumerate(names):
            shown = middle_cut(name, fitted.first_width, more=self.more)
            row = Text(INDENT).append_text(fitted.row(place, Text(shown)))
            if lists and self.width is None:
                rest = fitted.width - row.cell_len + len(INDENT)
                row.append(" " * rest + INDENT + lists[place])
            told.append(row)
            if lists and self.width is not None:
                told += [
                    Text(2 * INDENT + line, style="dim")
                    for line in wrap_words(lists[place], max(10, self.width - 2 * len(INDENT)))
                ]
        return told


def _clock(since: float) -> str:
    return datetime.fromtimestamp(since).strftime("%H:%M:%S")


def _names(nodes: Iterable[str], none: str) -> str:
    return ", ".join(visible(node) for node in sorted(set(nodes))) or none


def _is_left_out(name: str, ros_type: str) -> bool:
    """Whether to omit a service, because every node has the service or its name is hidden."""
    hidden = any(part.startswith("_") for part in name.split("/"))
    return hidden or ros_type.startswith(_EVERY_NODES)
