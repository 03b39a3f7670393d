"""Screen of `tftool tree --watch`: a live tree, scrolled, sorted and filtered."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

from rich.text import Text
from textual import events
from textual.app import ComposeResult
from textual.binding import BindingType

from tftool.base.fixed_width import fitted, plain
from tftool.base.short_numbers import count
from tftool.base.stamps import as_seconds
from tftool.buffer.sample import Snapshot
from tftool.buffer.traffic import Traffic
from tftool.drawing.frame_tree import NOTHING, CompactTree, TreeOrder, compact
from tftool.drawing.solids import Solids
from tftool.drawing.space import SpacePicture
from tftool.drawing.sparklines import NO_HISTORY, TrafficHistory
from tftool.screens.terminal.frames_picture import natural_fixed
from tftool.screens.terminal.panel_text import title_bar
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.space_panel import SPACE_KEYS, SpacePanel, frames_in_space
from tftool.screens.terminal.text_style import wrapped
from tftool.screens.terminal.world_app import Panel, PanelApp, WorldApp
from tftool.world.world import TransformMessage, World

LOOKS_PER_SECOND = 2

Marks = Mapping[str, Sequence[str]]


@dataclass(slots=True)
class TreeWindow:
    """Visible part of a tree: its root, order, and frames.

    Attributes:
        first: The row at the top.
        order: Sorting key.
        wanted: Letters that the shown frames have in their names.
    """

    first: int = 0
    order: TreeOrder = TreeOrder.tree
    wanted: str = ""

    def lines(
        self,
        snapshot: Snapshot,
        marks: Marks,
        width: int,
        height: int,
        *,
        ascii_only: bool,
        history: TrafficHistory = NO_HISTORY,
    ) -> list[Text]:
        """Return lines: the heading, the rows that fit, and the number of others."""
        if not snapshot.frames:
            return [Text(NOTHING)][:height]
        found = compact(
            snapshot,
            width,
            ascii_only=ascii_only,
            marks=marks,
            order=self.order,
            wanted=self.wanted,
            history=history,
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
        """Change to the next order."""
        orders = list(TreeOrder)
        self.order = orders[(orders.index(self.order) + 1) % len(orders)]
        self.first = 0


KEYS = f"""\
 Up, Down     scroll by a line (also k, j, the wheel)
 PgUp, PgDn   scroll by a page
 g G          the top, the end
 s            sort by name, rate, age, broadcaster
 /            only frames with the letters typed; Esc: all of them

{SPACE_KEYS}
 m            light or dark
 ? or Esc     close these keys
 q            quit
"""


class TreeWatch(PanelApp, inherit_bindings=False):
    """Screen of `tftool tree --watch`.

    Args:
        world: Source of the frames.
        marks: Finds faults of frames.
        setting: Abilities of the terminal.

    Attributes:
        solids: The shapes of a robot among the frames, once its description is known.
    """

    CSS = """
    Screen { layout: vertical; background: $background; color: $foreground; overflow: hidden; }
    Screen { layers: default above; }
    Panel { background: $surface; border: round $secondary; border-title-color: $foreground; }
    .ascii Panel { border: ascii $secondary; }
    #header, #footer { border: none; height: 1; background: $background; }
    #rows { height: 1fr; }
    .tiny #rows { border: none; }
    #keys { layer: above; dock: top; width: 68; display: none; border: round $accent; }
    .ascii #keys { border: ascii $accent; }
    """
    KEYS_WIDTH = 68
    # Every other key is a letter while a filter is typed.
    BINDINGS: ClassVar[list[BindingType]] = WorldApp.BINDINGS

    def __init__(
        self,
        world: World,
        marks: Callable[[Snapshot], Marks],
        setting: Setting | None = None,
    ) -> None:
        super().__init__(world, setting)
        self._marks_now = marks
        self.window = TreeWindow()
        self.news = ""
        self._types = False
        self._seen: tuple[Snapshot, Marks] | None = None
        self.solids: Solids | None = None
        self._traffic = Traffic()
        self._history = TrafficHistory()
        self._began = world.clock.now()
        world.tf.subscribe(self._receive, "screen")

    def _receive(self, message: TransformMessage) -> None:
        now = self.world.clock.now()
        self._traffic.receive(now, message.transforms, message.authority, is_static=False)

    def tell(self, sentence: str) -> None:
        """Show this in place of the keys from now on."""
        self.news = sentence
        self.redraw()

    # Building

    def keys_told(self) -> str:
        """Return the key help."""
        return KEYS

    def compose(self) -> ComposeResult:
        """Create the panels."""
        yield Panel("header", can_focus=False)
        yield SpacePanel("rows", "Frames", can_focus=False)
        yield Panel("footer", can_focus=False)
        yield Panel("keys", "Keys: ? or Esc closes them", can_focus=False)

    def on_mount(self) -> None:
        """Start the updates."""
        self.set_interval(1.0 / LOOKS_PER_SECOND, self.look_again)
        self.call_after_refresh(self.look_again)

    def on_resize(self, event: events.Resize) -> None:
        """Fit everything into the new size."""
        is_tiny = event.size.height < 8 or event.size.width < 30
        self.screen.set_class(is_tiny, "tiny")
        self.panel("header").display = not is_tiny
        self.call_after_refresh(self.redraw)

    # Looking

    def look_again(self) -> None:
        """Read the present state, and draw it."""
        self._shown(self._look)

    def redraw(self) -> None:
        """Draw the last state with the present options."""
        self._shown(self._draw)

    def _shown(self, work: Callable[[], None]) -> None:
        if self.is_running and self.query("#footer"):
            self.guarded(work)

    def _look(self) -> None:
        now = self.world.clock.now()
        snapshot = self.world.buffer.snapshot(now)
        self._history.look(now, self._traffic)
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
            picture = SpacePicture(fixed, frames, self.solids, chosen=rows.camera.follows)
            rows.draw(picture, self.look)
        else:
            rows.border_subtitle = ""
            rows.show(
                self.window.lines(
                    snapshot,
                    marks,
                    width,
                    height,
                    ascii_only=self.setting.ascii_only,
                    history=self._history,
                )
            )
        self.panel("header").show([self._header(snapshot)])
        self.panel("footer").show([self._footer(self.size.width)])

    def _header(self, snapshot: Snapshot) -> Text:
        words = f"{self.title}: {count(len(snapshot.frames), 'frame')}"
        elapsed = as_seconds(self.world.clock.now() - self._began)
        return title_bar(words, elapsed, self.size.width, self.look)

    def _footer(self, width: int) -> Text:
        more = "~" if self.setting.ascii_only else "…"
        if self._types:
            told = fitted(f"filter: {plain(self.window.wanted)}", max(1, width - 1), more=more)
            return Text(told, style="bold").append("_", style="blink")
        look = self.look
        if self.news:
            return wrapped(self.news, width, look.ink(look.palette.warning))[0].copy()
        line = Text()
        strong, weak = look.ink(look.palette.accent, bold=True), look.ink(look.palette.dim)
        for keys, does in self._hints():
            hint = Text.assemble((keys, strong), (f" {does}", weak))
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
            ("?", "keys"),
        ]

    # Keys

    def on_key(self, event: events.Key) -> None:
        """Handle a key: scroll, sort, filter or leave."""
        event.stop()
        self.news = ""
        rows = self.query_one("#rows", SpacePanel)
        if self._types:
            self._type(event)
        elif event.key in ("q", "Q"):
            self.exit()
            return
        elif event.key in ("question_mark", "h"):
            self.action_keys()
        elif event.key == "m":
            self.action_shade()
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
            self.panel("keys").display = False
        else:
            self._scroll(event.key)
        self.redraw()

    def _next_followed(self, rows: SpacePanel) -> str:
        """Return the frame after the followed one; none after the last."""
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
        """Scroll down."""
        self.window.first += 3
        self.redraw()

    def on_mouse_scroll_up(self, event: events.MouseScrollUp) -> None:
        """Scroll up."""
        self.window.first = max(0, self.window.first - 3)
        self.redraw()
