"""Text in the panels of the terminal app, and the help for its keys."""

import math
from collections.abc import Iterable, Sequence
from contextlib import suppress
from typing import NamedTuple

import numpy as np
from rich.cells import cell_len
from rich.style import Style
from rich.text import Text

from tftool.base.color import Color
from tftool.base.errors import TransformException
from tftool.base.stamps import as_seconds, seconds
from tftool.buffer.sample import FrameInfo, Snapshot, TransformStamped
from tftool.drawing import theme
from tftool.drawing.drawn_forest import ASCII, UNICODE, branches, grow
from tftool.drawing.line_plot import PAIR_LABELS, PlotSpan, pair_plot
from tftool.drawing.table_columns import fitted, padded, plain
from tftool.drawing.traffic_view import has_stopped
from tftool.geometry.conversions import rpy_from_quaternion
from tftool.screens.terminal.log_lines import FAR, since_start
from tftool.screens.terminal.scene import Scene, SceneMoment
from tftool.screens.terminal.screen_options import BLOCK_LINES
from tftool.screens.terminal.text_style import Look, wrapped


class Row(NamedTuple):
    """Row of the tree panel: the characters of the tree before the frame's name, and the frame."""

    guide: str
    info: FrameInfo


def rows(snapshot: Snapshot, *, ascii_only: bool = False) -> list[Row]:
    """Return a row for each frame, tree by tree; frames in a loop are last."""
    guides = (ASCII if ascii_only else UNICODE)[1]
    return [
        Row(guides.lead(one) if one.info.root is not None else "", one.info)
        for one in branches(grow(snapshot))
    ]


def in_view(listed: Sequence[Row], cursor: str, height: int) -> Sequence[Row]:
    """Return the rows that fit into a tree panel of `height` lines, with the cursor's row."""
    at = next((index for index, row in enumerate(listed) if row.info.frame == cursor), 0)
    space = max(1, height - 1)
    if len(listed) > space > 2:
        # The last line says how many rows are not shown.
        space -= 1
    first = max(0, min(at - space // 2, len(listed) - space))
    return listed[first : first + space]


def tree(
    moment: SceneMoment, listed: Sequence[Row], cursor: str, width: int, height: int, look: Look
) -> list[Text]:
    """Return the lines of the tree panel: each frame's rate and age, amber or red if stale.

    Args:
        moment: State to show.
        listed: Rows of the frames, as `rows` returns them.
        cursor: Frame under the cursor, which stays visible.
        width: Width in cells.
        height: Number of lines.
        look: Colours and characters to use.
    """
    dim, accent = look.ink(look.palette.dim), look.ink(look.palette.accent, bold=True)
    if not listed:
        return wrapped("No frames yet.", width, dim)
    columns = _Columns.of(width)
    head = padded("  frame", columns.name) + f"{'Hz':>{columns.rate}}{'age':>{columns.age}}"
    lines = [Text(fitted(head + ("  from" if columns.sender else ""), width, more=""), dim)]
    visible = in_view(listed, cursor, height)
    room = columns.name - 2
    # Indent by one cell per level instead of three if names would be cut otherwise.
    tight = any(len(row.guide) + len(row.info.frame) > room for row in visible)
    for row in visible:
        info = row.info
        age = moment.ages.get(info.frame, 0.0)
        style = look.ink(theme.of_age(look.palette.text, age, look.palette))
        picked = info.frame == cursor
        fresh = not theme.is_stale(age)
        mark = (">" if look.ascii_only else "▸") if picked else " "
        mark += ("*" if look.ascii_only else "◎") if info.frame == moment.pair.target else " "
        guide = fitted(row.guide[:: 3 if tight else 1], max(0, room - 6), more=look.more)
        name = padded(info.frame, max(1, room - cell_len(guide)), more=look.more)
        line = Text.assemble(
            (mark, accent),
            (guide, dim),
            (name, look.ink(look.of_name(info.frame), bold=picked) if fresh else style),
        )
        for text, ink in _facts(info, age, columns, look):
            line.append(text, dim if info.is_static else ink or style)
        if columns.sender:
            sender = padded(info.authority or "", columns.sender, more=look.more)
            line.append("  " + sender, dim)
        lines.append(line)
    if len(visible) < len(listed) and len(lines) < height:
        count_words = f"  {len(listed) - len(visible)} more"
        lines.append(Text(fitted(count_words, width, more=look.more), accent))
    return lines


def field_title(moment: SceneMoment, *, is_chosen: bool) -> str:
    """Return the title of the picture's panel, such as "Frames in world"."""
    fixed = moment.picture.fixed
    if not fixed:
        return "Field"
    return f"Frames in {plain(fixed)}" + (" (fixed)" if is_chosen else "")


class _Columns(NamedTuple):
    """Widths of the tree panel's columns in cells; `sender` is 0 if the publisher does not fit."""

    name: int
    rate: int
    age: int
    sender: int

    @classmethod
    def of(cls, width: int) -> "_Columns":
        rate, age = (5, 7) if width < 34 else (7, 13)
        sender = min(24, width - 46) if width >= 58 else 0
        used = rate + age + (sender + 2 if sender else 0)
        return cls(max(4, width - used), rate, age, sender)


def _facts(
    info: FrameInfo, age: float, columns: _Columns, look: Look
) -> list[tuple[str, Style | None]]:
    """Return a frame's rate and age as text with style, padded to the widths of the columns.

    If the style is None, the text has the style of the row.
    """
    width = columns.rate + columns.age
    if info.root is None:
        return [(f"{'in a loop':>{width}}", None)]
    if info.parent is None:
        return [(" " * width, None)]
    if info.is_static:
        return [(f"{'static':>{width}}", None)]
    none = "-" if look.ascii_only else "–"
    rate, ink = none, None
    if info.samples > 1 and info.rate < 9999.0:
        stopped = has_stopped(age, info.rate)
        rate = "0.0" if stopped else f"{info.rate:.1f}"
        if stopped and not theme.is_stale(age):
            ink = look.ink(look.palette.warning)
    shown = theme.age_words(age)
    if columns.age > 10 and theme.is_stale(age):
        shown += " ago"
    return [(f"{rate:>{columns.rate}}", ink), (f"{shown:>{columns.age}}", None)]


def pair(moment: SceneMoment, width: int, height: int, look: Look) -> list[Text]:
    """Return the lines of the panel with a pair's transform, in every notation if there is room.

    Positive and negative numbers have the same width, so that columns do not shift.
    """
    asked, dim = moment.pair, look.ink(look.palette.dim)
    half = max(1, (width - 4) // 2)
    source, target = (
        (fitted(name, half, more=look.more), look.ink(look.of_name(name), bold=True))
        for name in (asked.source, asked.target)
    )
    lines = [Text.assemble(source, (" in ", dim), target)] if asked.source else []
    if asked.found is None:
        refusal = since_start(asked.refusal, moment.stamp - moment.elapsed)
        return lines + wrapped(refusal, width, look.ink(look.palette.warning))
    narrow = width < 36
    age = stopped_for(moment)
    facts = [_time_of(moment, asked.found, age), *_facts_of(asked.found, narrow=narrow, look=look)]
    if height >= BLOCK_LINES and not narrow:
        facts += _more_facts(asked.found)
    # Numbers of a pair that has stopped are dim: they are not the present ones.
    inks = [look.ink(look.palette.warning if age else look.palette.text)]
    inks += [dim if age else look.ink(look.palette.text)] * (len(facts) - 1)
    for (name, value), ink in zip(facts, inks, strict=True):
        label = f"{name:{2 if narrow else 5}}"
        shown = fitted(value, max(0, width - len(label)), more=look.more)
        lines.append(Text.assemble((label, dim), (shown, ink)))
    return lines


def stopped_for(moment: SceneMoment) -> float:
    """Return how long ago, in seconds, a transform between the shown frames stopped arriving.

    If several transforms have stopped, return the longest time; if none has stopped, 0.
    """
    frames = {info.frame: info for info in moment.snapshot.frames}
    chains: list[set[str]] = []
    for name in (moment.pair.target, moment.pair.source):
        chain: set[str] = set()
        info = frames.get(name)
        while info is not None and info.frame not in chain:
            chain.add(info.frame)
            info = frames.get(info.parent or "")
        chains.append(chain)
    ages = [
        age
        for name in chains[0] ^ chains[1]
        if has_stopped(age := moment.ages.get(name, 0.0), frames[name].rate) or theme.is_stale(age)
    ]
    return max(ages, default=0.0)


def _time_of(moment: SceneMoment, transform: TransformStamped, age: float) -> tuple[str, str]:
    """Return the label and the text of a transform's stamp (seconds since the start) and age."""
    if not transform.stamp:
        return "at", " all times"
    since = as_seconds(transform.stamp - (moment.stamp - moment.elapsed))
    # A stamp of another clock is shown as it is.
    stamp = f"{since:.3f} s" if abs(since) < FAR else f"{as_seconds(transform.stamp):.3f}"
    return "at", f" {stamp}" + (f", {theme.age_words(age)} old" if age else "")


def _facts_of(found: TransformStamped, *, narrow: bool, look: Look) -> list[tuple[str, str]]:
    translation, rotation = found.transform
    degrees = [math.degrees(angle) for angle in rpy_from_quaternion(rotation)]
    away = _away(*translation, look)
    if narrow:
        return [
            ("p", _numbers(translation, 2, 7)),
            ("q", _numbers(rotation, 2, 6)),
            ("r", _numbers(degrees, 1, 7)),
            ("", f" {away}"),
        ]
    return [
        ("xyz", _numbers(translation, 3, 8)),
        ("quat", _numbers(rotation, 3, 8)),
        ("rpy", _numbers(degrees, 1, 8) + _degree(look)),
        ("away", f" {away}"),
    ]


def _more_facts(transform: TransformStamped) -> list[tuple[str, str]]:
    """Return labels and texts of a transform's other notations: radians and the matrix."""
    radians = rpy_from_quaternion(transform.transform.rotation)
    matrix = transform.transform.matrix()
    rows = [("mat" if not place else "", _numbers(row, 3, 8)) for place, row in enumerate(matrix)]
    return [("rad", _numbers(radians, 3, 8)), *rows]


def _away(x: float, y: float, z: float, look: Look) -> str:
    """Return a point's distance and direction from the origin, such as "1.200 m, 30.0° left"."""
    away, bearing = math.hypot(x, y, z), math.degrees(math.atan2(y, x))
    if away < 0.001:
        return f"{away:.3f} m"
    if math.hypot(x, y) < 0.001 * away:
        return f"{away:.3f} m, {'above' if z > 0.0 else 'below'}"
    if abs(bearing) < 0.05:
        return f"{away:.3f} m, ahead"
    side = "left" if bearing > 0 else "right"
    return f"{away:.3f} m, {abs(bearing):.1f}{_degree(look)} {side}"


def _number(value: float, digits: int) -> str:
    shown = f"{value:.{digits}f}"
    # No minus sign before a zero.
    return shown.lstrip("-") if not shown.strip("-0.") else shown


def _numbers(values: Iterable[float], digits: int, width: int) -> str:
    """Format numbers in columns of `width` cells; a longer number widens its column."""
    return "".join(f" {_number(value, digits):>{width - 1}}" for value in values)


def _degree(look: Look) -> str:
    return "d" if look.ascii_only else "°"


def scenarios(
    offered: Sequence[tuple[str, str]], cursor: int, width: int, height: int, look: Look
) -> list[Text]:
    """Return the lines of the list of scenarios, with descriptions and a cursor.

    If descriptions do not fit, the whole description of the selected scenario is below the list.

    Args:
        offered: Names and descriptions.
        cursor: Index of the selected scenario.
        width: Width in cells.
        height: Number of lines.
        look: Colours and characters to use.
    """
    below = description_lines(offered, width)
    below = below if height > below + 3 else 0
    height -= below
    first = max(0, min(cursor - height // 2, len(offered) - height))
    wide = _widest(offered)
    dim, accent = look.ink(look.palette.dim), look.ink(look.palette.accent, bold=True)
    lines = []
    for place in range(first, min(len(offered), first + height)):
        name, about = offered[place]
        picked = place == cursor
        mark = (">" if look.ascii_only else "▸") if picked else " "
        lines.append(
            Text.assemble(
                (f"{mark} ", accent),
                (padded(name, wide), accent if picked else look.ink(look.palette.text)),
                (fitted(about, max(0, width - wide - 2), more=look.more), dim),
            )
        )
    if below:
        words = wrapped(offered[cursor][1], width - 2, look.ink(look.palette.text))
        lines += [Text(), *(Text.assemble("  ", line) for line in words)]
    return lines


def description_lines(offered: Sequence[tuple[str, str]], width: int) -> int:
    """Return how many lines the longest description needs below the list of scenarios.

    Returns 0 if every description fits into its line of the list.

    Args:
        offered: Names and descriptions.
        width: Width in cells.
    """
    room = width - _widest(offered) - 2
    cut = [about for _, about in offered if cell_len(about) > room]
    return 1 + max(len(wrapped(about, width - 2)) for about in cut) if cut else 0


def _widest(offered: Sequence[tuple[str, str]]) -> int:
    return max((cell_len(name) for name, _ in offered), default=0) + 2


def header(title: str, moment: SceneMoment, rate: float, width: int, look: Look) -> Text:
    """Return the top line: title, time, and whether the screen shows the present or the past."""
    elapsed, behind = as_seconds(moment.elapsed), as_seconds(moment.behind)
    return title_bar(title, elapsed, width, look, behind=behind, rate=rate)


def title_bar(
    title: str, elapsed: float, width: int, look: Look, *, behind: float = 0.0, rate: float = 1.0
) -> Text:
    """Return a line with title, seconds since the start, and "live" or the age of the shown time.

    Args:
        title: Title at the left.
        elapsed: Seconds since the start.
        width: Width in cells.
        look: Colours and characters to use.
        behind: Seconds from the shown time to the present; 0 if live.
        rate: Simulated seconds per real second.
    """
    if behind:
        sign = "<<" if look.ascii_only else "◀◀"
        state, ink = f"{sign} {behind:.1f} s ago", look.palette.warning
    else:
        state, ink = ("* live" if look.ascii_only else "● live"), look.palette.accent
    if rate != 1.0 and math.isfinite(rate):
        state += f" {'x' if look.ascii_only else '×'}{rate:g}"
    return bar(title, f"{elapsed:.1f} s", (state, ink), width, look)


def bar(title: str, clock: str, state: tuple[str, Color], width: int, look: Look) -> Text:
    """Return a line with the title at the left, and a time and a coloured text at the right."""
    words, ink = state
    right = Text.assemble(
        (clock + "  ", look.ink(look.palette.text)), (words, look.ink(ink, bold=True)), " "
    )
    left = padded(" " + title, max(0, width - right.cell_len - 1), more=look.more) + " "
    return Text.assemble((left, look.ink(look.palette.text, bold=True)), right)


class Hint(NamedTuple):
    """Key and its action, as one hint of the footer."""

    keys: str
    does: str


def footer(hints: Sequence[Hint], width: int, look: Look) -> Text:
    """Return the line of key help: as many hints as fit, and always the last hint."""
    strong, weak = look.ink(look.palette.accent, bold=True), look.ink(look.palette.dim)

    def written(hint: Hint) -> Text:
        return Text.assemble((hint.keys, strong), (" " + hint.does, weak))

    *optional, last = [written(hint) for hint in hints]
    line, room = Text(" "), width - 1 - last.cell_len
    for hint in optional:
        if hint.cell_len + 2 > room:
            continue
        line.append_text(hint)
        line.append("  ")
        room -= hint.cell_len + 2
    line.append_text(last)
    return line


DRIVING = """\
 Arrow keys   drive turtle1; a press lasts a second
 g t r e      turn to 0, 45, 90, 135 degrees
 d c v b      turn to 180, -135, -90, -45 degrees
 f            cancel the turn

"""

LOOKING = """\
 Tab          next panel (Shift+Tab: back)
 Up, Down     in the tree: pick a frame (also j, k)
 Enter        make the picked frame the target
 x            swap the two frames
 F            draw the picture in the picked frame (again: in the root)

 + - 0        zoom in, zoom out, show everything (also the wheel)
 Shift+Arrow  move the picture (or drag it)
 p            3-D picture, or the view from above; in 3-D:
              Shift+Arrow turns, w changes the view, y keeps the picked
              frame in the middle, < > zoom out and in, a shows all

 [ ]          back and forward in time by 0.1 s
 { }          by a second
 l            back to live

 L            open the log, or close it (Esc closes it too)
"""

CHOOSING = """\
 o            another scenario
"""

LEAVING = """\
 m            light or dark
 ? or Esc     close these keys
 q            quit
"""


def key_help(*, drives: bool, chooses: bool) -> str:
    """Return the help text with one line for each key that works.

    Args:
        drives: Whether there is a turtle to drive.
        chooses: Whether another scenario can be chosen.
    """
    return f"{DRIVING if drives else ''}{LOOKING}{CHOOSING if chooses else ''}{LEAVING}"


def hints(
    panel: str,
    *,
    drives: bool,
    past: bool,
    ascii_only: bool,
    chooses: bool = False,
    in_space: bool | None = False,
    alone: bool = False,
) -> Sequence[Hint]:
    """Return the keys that can be used now, the most important first.

    Args:
        panel: Name of the panel that has the focus.
        drives: Whether there is a turtle to drive.
        past: Whether an earlier time is shown.
        ascii_only: Whether to write keys in ASCII.
        chooses: Whether another scenario can be chosen.
        in_space: Whether the picture is in 3-D; None if the picture cannot be in 3-D.
        alone: Whether the picture is the only panel.
    """
    arrows, updown = ("arrows", "up/down") if ascii_only else ("↑↓←→", "↑↓")
    travel = [Hint("l", "live"), Hint("[ ]", "time")] if past else [Hint("[ ]", "past")]
    always = [*travel, *([] if alone else [Hint("Tab", "panel")]), Hint("?", "keys")]
    if panel == "scenarios":
        return [
            Hint(updown, "choose"),
            Hint("Enter", "show it"),
            Hint("Esc", "back"),
            Hint("q", "quit"),
        ]
    end = Hint("q", "quit")
    if panel == "tree":
        pick = [Hint(updown, "pick"), Hint("Enter", "measure from"), Hint("x", "swap")]
        return [*pick, *always, end]
    if panel == "pair":
        return [Hint(updown, "source"), Hint("x", "swap"), *always, end]
    if panel == "log":
        return [Hint(updown, "scroll"), *always, end]
    look = [Hint("F", "fix frame"), Hint("+ - 0", "zoom")]
    if in_space:
        look += [Hint("p", "top view"), Hint(f"Shift+{arrows}", "orbit")]
    elif in_space is not None:
        look.append(Hint("p", "3-D"))
    other = [Hint("o", "scenarios")] if chooses else []
    if not drives:
        return [*always, *look, *other, end]
    turn = [Hint("g r d v", "turn, f cancels")]
    return [Hint(arrows, "drive"), *always, *look, *other, *turn, end]


SPAN = seconds(10.0)
"""Nanoseconds that the plot shows."""


class PairPlot:
    """Plot of a pair's distance and yaw over time, with a mark at the shown time."""

    def __init__(self) -> None:
        self._key: object = None
        self._lines: list[Text] = []

    def lines(
        self, moment: SceneMoment, scene: Scene, width: int, height: int, look: Look
    ) -> list[Text]:
        """Return the lines of the plot: the last seconds, or the seconds around a past time.

        Args:
            moment: State to show.
            scene: Scene in which the pair is looked up.
            width: Width in cells.
            height: Number of lines.
            look: Colours and characters to use.
        """
        now = moment.stamp + moment.behind
        # While the data is shorter than the span, the curve grows from the left.
        begin = max(scene.start, now - SPAN)
        span = PlotSpan(begin, begin + SPAN, scene.start)
        if moment.behind:
            first = now - SPAN if moment.behind <= SPAN else moment.stamp - SPAN // 2
            span = PlotSpan(first, first + SPAN, scene.start, moment.stamp)
        pair = moment.pair
        columns = max(1, width - PAIR_LABELS - 1)
        period = max(1, SPAN // (2 * columns))
        # At fixed times, so that a moving curve does not change its shape.
        stamps = np.arange(span.first // period + 1, span.last // period + 1) * period
        newest = scene.newest(pair.target, pair.source)
        if newest is not None and span.first < newest <= span.last:
            stamps = np.append(stamps[stamps < newest], newest)
        else:
            # The curve of a static pair ends at the present too.
            stamps = stamps[stamps <= now]
        age = 0.0 if moment.behind else stopped_for(moment)
        note = f"{theme.age_words(age)} old" if age else ""
        key = (pair.target, pair.source, span, newest, note, width, height, look)
        if key == self._key:
            return self._lines
        self._key = key
        path = None
        with suppress(TransformException):
            path = scene.world.buffer.lookup_transforms(
                pair.target, pair.source, stamps[stamps > 0], missing="nan", threads=1
            )
        if path is None or not pair.target or not path.valid.any():
            words = "No pose to plot in this span."
            if newest is not None and newest < span.first:
                old = stopped_for(moment) or as_seconds(now - newest)
                words += f" The newest is {theme.age_words(old)} old."
            self._lines = wrapped(words, width, look.ink(look.palette.dim))
            return self._lines
        ascii_only = look.ascii_only
        self._lines = pair_plot(
            path, span, width, height, look.palette, ascii_only=ascii_only, note=note
        )
        return self._lines
