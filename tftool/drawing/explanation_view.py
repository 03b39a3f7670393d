"""Explanation of one transform lookup, for a terminal and for --json."""

from collections.abc import Iterator, Sequence
from typing import Any

from rich.console import Console, ConsoleOptions, Group, RenderableType
from rich.measure import Measurement
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from tftool.base.plain_text import MOST_LINES, visible, visible_lines
from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW, Stamp
from tftool.doctor.explanation import Explanation
from tftool.doctor.lookup_reasons import Cause
from tftool.doctor.trace import LinkVerdict, TracedLink
from tftool.doctor.wording import dated, span

SCHEMA = "tftool.explain/1"

_WORDS = {
    LinkVerdict.ANSWERS: "answers",
    LinkVerdict.FORWARD: "newest is {} too old",
    LinkVerdict.BACKWARD: "begins {} after the requested time",
    LinkVerdict.PRUNED: "the needed sample was dropped; the oldest sample left is {} later",
}


def render(explanation: Explanation) -> RenderableType:
    """Return an explanation for a terminal: lookup, tf2's error, transforms, cause, remedies."""
    facts = Table.grid(padding=(0, 2), pad_edge=False)
    facts.add_column(no_wrap=True)
    facts.add_column(overflow="fold")
    if explanation.text:
        facts.add_row("tf2", Text(visible_lines(explanation.text)))
    after = f" ({span(explanation.after)} later)" if explanation.after else ""
    facts.add_row(
        "asked",
        Text(visible(f"{_exactly(explanation.asked)}, {explanation.because}{after}"))
        if explanation.because
        else _exactly(explanation.asked),
    )
    parts: list[RenderableType] = [_headline(explanation), Text(""), Padding(facts, (0, 0, 0, 2))]
    if explanation.links:
        parts += [Text(""), Padding(_Links(explanation), (0, 0, 0, 2))]
    remedies = [(one.text, one.command) for one in explanation.remedies]
    parts += [Text(""), reasons("", explanation.why, remedies, explanation.useless)]
    return Group(*parts)


def reasons(
    tf2: str,
    whys: Sequence[str],
    remedies: Sequence[tuple[str, str]],
    useless: Sequence[str] = (),
) -> Padding:
    """Return a table of a lookup's error and its causes and remedies.

    Args:
        tf2: Text of tf2's error; empty for a successful lookup.
        whys: Causes in sentences.
        remedies: Remedies, each as a sentence and a command; the command may be empty.
        useless: Sentences about attempts that do not help.
    """
    told = Table.grid(padding=(0, 2), pad_edge=False)
    told.add_column(no_wrap=True, min_width=5)
    told.add_column(overflow="fold")
    rows = [("tf2", tf2, "")] if tf2 else []
    rows += [("why", why, "") for why in whys]
    rows += [("cure", *remedy) for remedy in remedies]
    rows += [("not", one, "") for one in useless]
    before = ""
    for word, text, command in rows:
        told.add_row("" if word == before else word, Text(visible(text)))
        if command:
            told.add_row("", Text(visible(command), "bold"))
        before = word
    return Padding(told, (0, 0, 0, 2))


def so_far(explanation: Explanation) -> list[Text]:
    """Return lines for a live view: the present result of the lookup, and its causes."""
    line = Text(visible(f"so far: {explanation.source} in {explanation.target} "))
    line.append(*(("answers", "green") if explanation.available else ("is refused", "bold red")))
    return [line, *(Text(visible(f"        {why}")) for why in explanation.why)]


def _headline(explanation: Explanation) -> Text:
    base = _base(explanation)
    when = "at the latest" if not explanation.stamp else f"at {_exactly(explanation.stamp)}"
    if explanation.stamp and base and not _other_clock(explanation.stamp, base):
        when = f"at {_since(explanation.stamp, base)} s"
    line = Text(visible(f"{explanation.source} in {explanation.target} {when}: "))
    if explanation.cause is Cause.UNREAD:
        return line.append("answers here, but no listener receives these transforms", "yellow")
    if explanation.available:
        return line.append("answers", "green")
    line.append("refused", "bold red").append(_later(explanation))
    if explanation.failed is not None:
        return line
    # A live listener has only the samples received so far; `echo` has the whole recording.
    line.append("; a live robot has only the data received so far")
    return line.append(
        ", but echo uses the whole recording and succeeds" if explanation.in_whole else ""
    )


def _later(explanation: Explanation) -> str:
    """Return a clause about the time at which the lookup would succeed; "" without such a time."""
    if explanation.answerable_from is None:
        return ", and waiting would not help"
    late = explanation.answerable_from - explanation.asked
    if late > 0:
        return f", would answer {span(late)} later"
    if (
        explanation.answerable_until is not None
        and explanation.answerable_until <= explanation.asked
    ):
        return f", would have answered until {_exactly(explanation.answerable_until)}"
    return ""


class _Links:
    """Table with a row for each transform between a frame and its parent on a lookup's path.

    On a narrow terminal, the outcome of a row is written below the row. If the terminal is very
    narrow, the other columns are not aligned and have no heading.
    """

    def __init__(self, found: Explanation) -> None:
        self._found = found

    def __rich_console__(
        self, console: Console, options: ConsoleOptions
    ) -> Iterator[RenderableType]:
        rows = self._rows()
        table = Table.grid(padding=(0, 2), pad_edge=False)
        for row in rows:
            table.add_row(*row)
        if Measurement.get(console, options.update(max_width=10_000), table).maximum <= (
            options.max_width
        ):
            yield table
            return
        links = [row[:-1] for row in rows]
        widths = [max(cell.cell_len for cell in column) for column in zip(*links, strict=True)]
        fits = sum(widths) + 2 * (len(widths) - 1) <= options.max_width
        if fits:
            for cells in links:
                for cell, width in zip(cells, widths, strict=True):
                    cell.pad_right(width - cell.cell_len)
            yield Text("  ").join(links[0])
        for *link, says in rows[1:]:
            line = Text("  ").join(link)
            line.rstrip()
            yield line
            if says:
                yield Padding(says, (0, 0, 0, 2))

    def _rows(self) -> list[tuple[Text, ...]]:
        found = self._found
        base = _base(found)
        at = "at the latest" if not found.stamp else f"at {_since(found.stamp, base)}"
        held = "held, s since the start" if base else "held"
        rows = [tuple(Text(word, "dim") for word in ("link", "kind", held, "samples", at))]
        left_out = range(MOST_LINES // 2, len(found.links) - MOST_LINES // 2)
        for number, link in enumerate(found.links):
            if number in left_out and link.edge != found.refusing:
                if number == left_out[0]:
                    more = Text(f"… {len(left_out):,} more links …", "dim")
                    rows.append((more, *(Text() for _ in rows[0][1:])))
                continue
            style = "bold" if link.edge == found.refusing else ""
            says = Text("answers", "green")
            if link.verdict is not LinkVerdict.ANSWERS:
                says = Text(f"REFUSES: {_refusal(link)}", "bold red")
            count = "" if link.is_static or not link.count else f"{link.count:,}"
            words = (visible(link.name), _kind(link), _held(link, base), count)
            rows.append((*(Text(word, style) for word in words), says))
        return rows


def _kind(link: TracedLink) -> str:
    if link.is_static:
        return "static"
    return f"{NANOSECONDS / link.period:.3g} Hz" if link.period else "once"


def _held(link: TracedLink, base: Stamp) -> str:
    if link.oldest is None or link.newest is None:
        return "nothing"
    if link.is_static:
        return f"since {_since(link.oldest, base)}"
    if _other_clock(link.newest, base):
        return f"{dated(link.oldest)} …"
    if link.count == 1:
        return _since(link.oldest, base)
    return f"{_since(link.oldest, base)} … {_since(link.newest, base)}"


def _refusal(link: TracedLink) -> str:
    if link.verdict is LinkVerdict.NO_DATA:
        return (
            "one sample is valid only at its own stamp" if link.count else "no sample received yet"
        )
    if abs(link.short_by) > SIMULATED_BELOW:
        return f"{span(link.short_by)} apart: stamps of another clock"
    return _WORDS[link.verdict].format(span(link.short_by))


def _base(explanation: Explanation) -> Stamp:
    """Return the stamp that is shown as 0 s: the first stamp, or 0 for times of a simulation."""
    if explanation.stamp and explanation.stamp < SIMULATED_BELOW:
        return 0
    return explanation.epoch if explanation.epoch >= SIMULATED_BELOW else 0


def _other_clock(stamp: Stamp, base: Stamp) -> bool:
    return (stamp < SIMULATED_BELOW) != (base < SIMULATED_BELOW)


def _since(stamp: Stamp, base: Stamp) -> str:
    if _other_clock(stamp, base):
        return dated(stamp)
    return f"{(stamp - base) / NANOSECONDS:.3f}"


def _exactly(stamp: Stamp) -> str:
    sign = "-" if stamp < 0 else ""
    return f"{sign}{abs(stamp) // NANOSECONDS}.{abs(stamp) % NANOSECONDS:09}"


def as_object(explanation: Explanation) -> dict[str, Any]:
    """Return an explanation as a mapping, for --json; times in nanoseconds, unescaped names."""
    return {
        "schema": SCHEMA,
        "target": explanation.target,
        "source": explanation.source,
        "stamp": explanation.stamp,
        "asked": explanation.asked,
        "available": explanation.available,
        "available_in_whole": explanation.in_whole,
        "exception": explanation.exception or None,
        "text": explanation.text or None,
        "links": [
            {
                "parent": link.parent,
                "child": link.child,
                "kind": "static" if link.is_static else "dynamic",
                "publisher": link.publisher,
                "held": {"count": link.count, "oldest": link.oldest, "newest": link.newest},
                "period": link.period,
                "latency": {"median": link.latency},
                "verdict": link.verdict.value,
                "short_by": link.short_by,
            }
            for link in explanation.links
        ],
        "refusing": None if explanation.refusing is None else list(explanation.refusing),
        "answerable": {"from": explanation.answerable_from, "until": explanation.answerable_until},
        "cause": explanation.cause.value,
        "check": explanation.check,
        "why": list(explanation.why),
        "remedies": [
            {
                "kind": one.kind,
                "text": one.text,
                "command": one.command or None,
                "least": one.least,
                "advised": one.advised,
                "possible": one.possible,
            }
            for one in explanation.remedies
        ],
        "useless": list(explanation.useless),
        "failed_share": explanation.failed,
    }
