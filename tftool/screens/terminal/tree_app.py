"""The screen of `tftool tree --watch`: the tree as it changes, scrolled, sorted and filtered."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from rich.text import Text
from textual import events
from textual.app import ComposeResult

from tftool.base.fixed_width import fitted, plain
from tftool.buffer.sample import Snapshot
from tftool.drawing.frame_tree import NOTHING, CompactTree, TreeOrder, compact
from tftool.drawing.space import SpacePicture
from tftool.screens.terminal.frames_picture import natural_fixed
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.space_panel import SpacePanel, frames_in_space
from tftool.screens.terminal.text_style import Look, wrapped
from tftool.screens.terminal.world_app import Panel, WorldApp
from tftool.world.world import World

LOOKS_PER_SECOND = 2

Marks = Mapping[str, Sequence[str]]


@dataclass(slots=True)
class TreeWindow:
    """Visible part of a tree: its root, the order, the frames.

    Attributes:
        first: The row at the top.
        order: What decides the order.
        wanted: Letters that the shown frames have in their names.
    """

    first: int = 0
    order: TreeOrder = TreeOrder.tree
    wanted: str = ""

    def lines(
        self, snapshot: Snapshot, marks: Marks, width: int, height: int, *, ascii_only: bool
    ) -> list[Text]:
        """So many lines: the heading, the rows there is room for, and how many there are more."""
        if not snapshot.frames:
            return [Text(NOTHING)][:height]
        found = compact(
            snapshot,
            width,
            ascii_only=ascii_only,
            marks=marks,
            order=self.order,
            wanted=self.wanted,
        )
        heading = list(found.heading)[: max(0, height - 1)]
        room = max(1, height - len(heading))
        if len(found.rows) > room:
            room = max(1, room - 1)
        self.first = max(0, min(self.first, len(found.rows) - room))
        shown = found.rows[self.first : self.first + room]
        lines = [*heading, *shown]
        if len(shown) < len(found.rows) and len(lines) < height:
            lines.append(self._rest(found, len(shown), ascii_only=ascii_only))
        return lines

    def _rest(self, found: CompactTree, shown: int, *, ascii_only: bool) -> Text:
        up, down = ("^", "v") if ascii_only else ("↑", "↓")
        below = len(found.rows) - self.first - shown
        parts = [f"{down} {below} more"] if below else []
        if self.first:
            parts.append(f"{up} {self.first} above")
        return Text("   ".join(parts), style="bold")

    def sort(self) -> None:
        """Take the next order."""
        orders = list(TreeOrder)
        self.order = orders[(orders.index(self.order) + 1) % len(orders)]
        self.first = 0


class TreeWatch(WorldApp):
    """The screen of `tftool tree --watch`.

    Args:
        world: Whose frames.
        marks: Finds faults of frames.
        setting: What the terminal can show.
    """

    CSS = """
    Screen { layout: vertical; background: ansi_default; color: ansi_default; overflow: hidden; }
    Panel { background: ansi_default; color: ansi_default; }
    #rows { height: 1fr; }
    #footer { height: 1; }
    """

    def __init__(
        self,
        world: World,
        marks: Callable[[Snapshot], Marks],
        setting: Setting | None = None,
    ) -> None:
        # The drawing is text, and belongs among the user's text.
        super().__init__(world, setting, terminal_colors=True)
        self._marks_now = marks
        self.window = TreeWindow()
        self.news = ""
        self._types = False
        self._seen: tuple[Snapshot, Marks] | None = None

    def tell(self, sentence: str) -> None:
        """Show this in place of the keys from now on."""
        self.news = sentence
        self.draw()

    # Building

    def compose(self) -> ComposeResult:
        """Make the panels."""
        yield SpacePanel("rows", can_focus=False)
        yield Panel("footer", can_focus=False)

    def on_mount(self) -> None:
        """Start looking."""
        self.set_interval(1.0 / LOOKS_PER_SECOND, self.look)
        self.call_after_refresh(self.look)

    def on_resize(self, event: events.Resize) -> None:
        """Fit everything into the new size."""
        self.call_after_refresh(self.draw)

    # Looking

    def look(self) -> None:
        """Read the present state, and draw it."""
        self._shown(self._look)

    def draw(self) -> None:
        """Draw the state read last, with the present options."""
        self._shown(self._draw)

    def _shown(self, work: Callable[[], None]) -> None:
        if self.is_running and self.query("#footer"):
            self.guarded(work)

    def _look(self) -> None:
        snapshot = self.world.buffer.snapshot(self.world.clock.now())
        self._seen = (snapshot, self._marks_now(snapshot))
        self._draw()

    def _draw(self) -> None:
        if self._seen is None:
            return
        snapshot, marks = self._seen
        rows = self.query_one("#rows", SpacePanel)
        width, height = rows.size
        if rows.in_space:
            fixed = natural_fixed(snapshot, ("", ""))
            frames = frames_in_space(snapshot, fixed)
            picture = SpacePicture(fixed, frames, chosen=rows.camera.follows)
            rows.draw(picture, Look(ascii_only=self.setting.ascii_only))
        else:
            rows.show(
                self.window.lines(
                    snapshot, marks, width, height, ascii_only=self.setting.ascii_only
                )
            )
        self.query_one("#footer", Panel).show([self._footer(width)])

    def _footer(self, width: int) -> Text:
        more = "~" if self.setting.ascii_only else "…"
        if self._types:
            told = fitted(f"filter: {plain(self.window.wanted)}", max(1, width - 1), more=more)
            return Text(told, style="bold").append("_", style="blink")
        if self.news:
            return wrapped(self.news, width)[0].copy()
        line = Text()
        for keys, does in self._hints():
            hint = Text.assemble((keys, "bold"), (f" {does}", "dim"))
            if line.cell_len + hint.cell_len + 2 <= width:
                line.append("  " if line.cell_len else "").append_text(hint)
        return line

    def _hints(self) -> list[tuple[str, str]]:
        if self.query_one("#rows", SpacePanel).in_space:
            hints = [("q", "quit"), ("p", "tree"), ("Shift+arrows", "turn"), ("< >", "zoom")]
            return [*hints, ("w", "view"), ("y", "follow the next frame"), ("a", "show all")]
        updown = "up/down" if self.setting.ascii_only else "↑↓"
        kept = f"filter: {plain(self.window.wanted)}" if self.window.wanted else "filter"
        hints = [
            ("q", "quit"),
            ("s", f"sort: {self.window.order.value}"),
            ("/", kept),
        ]
        if self.window.wanted:
            hints.append(("Esc", "all frames"))
        return [
            *hints,
            ("p", "3-D"),
            (updown, "scroll"),
            ("PgUp PgDn", "page"),
            ("g G", "top, end"),
        ]

    # Keys

    def on_key(self, event: events.Key) -> None:
        """Scroll, sort, filter or leave."""
        event.stop()
        self.news = ""
        rows = self.query_one("#rows", SpacePanel)
        if self._types:
            self._type(event)
        elif event.key in ("q", "Q"):
            self.exit()
            return
        elif event.key == "p":
            rows.in_space = not rows.in_space
        elif rows.press(event.key, self._next_followed(rows)):
            return
        elif event.key == "s":
            self.window.sort()
        elif event.key == "slash":
            self._types = True
        elif event.key == "escape":
            self.window.wanted = ""
        else:
            self._scroll(event.key)
        self.draw()

    def _next_followed(self, rows: SpacePanel) -> str:
        """Return the frame after the one that is followed; none after the last."""
        names = [info.frame for info in self._seen[0].frames] if self._seen else []
        names.append("")
        follows = rows.camera.follows
        return names[(names.index(follows) + 1) % len(names) if follows in names[:-1] else 0]

    def _type(self, event: events.Key) -> None:
        if event.key in ("enter", "escape"):
            self._types = False
            if event.key == "escape":
                self.window.wanted = ""
        elif event.key == "backspace":
            self.window.wanted = self.window.wanted[:-1]
        elif event.character is not None and event.character.isprintable():
            self.window.wanted += event.character
        self.window.first = 0

    def _scroll(self, key: str) -> None:
        page = max(1, self.query_one("#rows", Panel).size.height - 3)
        steps = {
            "up": -1, "k": -1, "down": 1, "j": 1, "pageup": -page, "pagedown": page,
            "space": page, "home": -(10**9), "g": -(10**9), "end": 10**9, "G": 10**9,
        }  # fmt: skip
        self.window.first = max(0, self.window.first + steps.get(key, 0))

    def on_mouse_scroll_down(self, event: events.MouseScrollDown) -> None:
        """Scroll."""
        self.window.first += 3
        self.draw()

    def on_mouse_scroll_up(self, event: events.MouseScrollUp) -> None:
        """Scroll back."""
        self.window.first = max(0, self.window.first - 3)
        self.draw()
