"""Screen of `tftool tree --watch`: a live tree that can be scrolled, sorted and filtered."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

from rich.text import Text
from textual import events
from textual.app import ComposeResult
from textual.binding import BindingType

from tftool.base.plain_text import count
from tftool.base.stamps import Stamp, as_seconds
from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.buffer.traffic import Traffic
from tftool.drawing.frame_tree import NOTHING, TreeOrder, compact
from tftool.drawing.solids import Solids
from tftool.drawing.space import SpacePicture
from tftool.drawing.sparklines import NO_HISTORY, TrafficHistory
from tftool.drawing.table_columns import fitted, plain, rest_of_list
from tftool.drawing.traffic_view import has_stopped
from tftool.screens.terminal.frames_picture import natural_fixed
from tftool.screens.terminal.panel_text import Hint, footer, title_bar
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.space_panel import SPACE_KEYS, SpacePanel, frames_in_space
from tftool.screens.terminal.text_style import wrapped
from tftool.screens.terminal.world_app import FRAME_CSS, Panel, PanelApp, WorldApp
from tftool.world.world import TransformMessage, World

LOOKS_PER_SECOND = 2

HEADINGS = 2
"""Largest number of lines above the frames."""

WITH_SPACE, LEAST_SPACE = 60, 9
"""Smallest columns of a screen, and rows of the picture, for a picture below the tree."""

Marks = Mapping[str, Sequence[str]]


@dataclass(slots=True)
class TreeWindow:
    """Visible part of the tree: first row, sort order and filter.

    Attributes:
        first: Index of the row at the top.
        order: Order of the rows.
        filter: Text that the names of the shown frames contain; "" for all frames.
    """

    first: int = 0
    order: TreeOrder = TreeOrder.tree
    filter: str = ""

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
        """Return the heading, the rows that fit, and a line with the number of hidden rows."""
        if not snapshot.frames:
            return [Text(NOTHING)][:height]
        found = compact(
            snapshot,
            width,
            ascii_only=ascii_only,
            marks=marks,
            order=self.order,
            wanted=self.filter,
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
            below = len(found.rows) - self.first - len(shown)
            lines.append(Text(rest_of_list(below, self.first, ascii_only=ascii_only), "bold"))
        return lines

    def sort(self) -> None:
        """Sort the rows by the next criterion."""
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
 stored       time between a frame's oldest and newest transform here
 age          time since a frame's newest transform

 m            light or dark
 ? or Esc     close these keys
 q            quit
"""


class TreeWatch(PanelApp, inherit_bindings=False):
    """Screen of `tftool tree --watch`.

    Args:
        world: World with the frames.
        marks: Function that returns the doctor's findings about frames.
        setting: Options of the screen.

    Attributes:
        solids: Shapes of a robot; None until a robot description arrives.
    """

    keys_help = KEYS

    CSS = f"""{FRAME_CSS}
    #rows, #space {{ height: 1fr; }}
    .tiny #rows {{ border: none; }}
    """
    # While the user types a filter, all other keys are letters of it.
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
        self._is_alone = False
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
        """Show a sentence in place of the key help in the bottom line, until a key is pressed."""
        self.news = sentence
        self.redraw()

    # Building

    def compose(self) -> ComposeResult:
        """Create the panels of this screen."""
        yield Panel("header", can_focus=False)
        yield Panel("rows", "Frames", can_focus=False)
        yield SpacePanel("space", "In space", can_focus=False)
        yield Panel("footer", can_focus=False)
        yield Panel("keys", "Keys: ? or Esc closes them", can_focus=False)

    def on_mount(self) -> None:
        """Start the regular updates of the screen."""
        self.set_interval(1.0 / LOOKS_PER_SECOND, self.look_again)
        self.call_after_refresh(self.look_again)

    def on_resize(self, event: events.Resize) -> None:
        """Arrange the panels for the new size of the terminal."""
        is_tiny = event.size.height < 8 or event.size.width < 30
        self.screen.set_class(is_tiny, "tiny")
        self.panel("header").display = not is_tiny
        self._arrange()
        self.call_after_refresh(self.redraw)

    def _arrange(self) -> None:
        """Show the tree, with the 3-D picture below if there is room, or only the picture."""
        rows, space = self.panel("rows"), self.space
        height = self.size.height - 2 - self._rows_above()
        needs = 0 if self._seen is None else self._tree_needs()
        has_room = 0 < needs <= height - LEAST_SPACE and self.size.width >= WITH_SPACE
        rows.display = not self._is_alone
        rows.styles.height = needs if has_room else "1fr"
        space.display = space.in_space = self._is_alone or has_room

    def _tree_needs(self) -> int:
        """Return the number of rows of the whole tree, with its border."""
        return HEADINGS + 2 + (0 if self._seen is None else len(self._seen[0].frames))

    def _rows_above(self) -> int:
        """Return the number of rows that a subclass shows above the tree."""
        return 0

    @property
    def space(self) -> SpacePanel:
        """Panel of the 3-D picture."""
        return self.query_one(SpacePanel)

    # Looking

    def look_again(self) -> None:
        """Take a snapshot of the frames, and draw it."""
        self._shown(self._look)

    def redraw(self) -> None:
        """Draw the last snapshot with the current order and filter."""
        self._shown(self._draw)

    def _shown(self, work: Callable[[], None]) -> None:
        if self.is_running and self.query("#footer"):
            self.guarded(work)

    def _look(self) -> None:
        now = self.world.clock.now()
        snapshot = self.world.buffer.snapshot(now)
        self._history.look(now, self._traffic)
        marks = self._marks_now(snapshot)
        snapshot = replace(
            snapshot, frames=tuple(self._present(now, one) for one in snapshot.frames)
        )
        before, self._seen = self._seen, (snapshot, marks)
        if before is None or len(before[0].frames) != len(snapshot.frames):
            self._arrange()
            self.call_after_refresh(self.redraw)
        self._draw()

    def _present(self, now: Stamp, info: FrameInfo) -> FrameInfo:
        """Return a frame's facts; the rate is 0 if no new transform arrives."""
        link = self._traffic.links.get(info.frame)
        heard = None if link is None else link.series.last
        # A sender of old stamps is not silent.
        silent = info.age if heard is None else min(info.age, now - heard)
        if info.parent is None or info.is_static or not has_stopped(as_seconds(silent), info.rate):
            return info
        return info._replace(rate=0.0)

    def _draw(self) -> None:
        if self._seen is None:
            return
        snapshot, marks = self._seen
        rows, space = self.panel("rows"), self.space
        if space.in_space:
            fixed = natural_fixed(snapshot, ("", ""))
            frames = frames_in_space(snapshot, fixed)
            space.draw(
                SpacePicture(fixed, frames, self.solids, chosen=space.camera.follows), self.look
            )
        if rows.display:
            ascii_only, history = self.setting.ascii_only, self._history
            rows.show(
                self.window.lines(
                    snapshot, marks, *rows.size, ascii_only=ascii_only, history=history
                )
            )
        words = f"{self.title}: {count(len(snapshot.frames), 'frame')}"
        elapsed = as_seconds(self.world.clock.now() - self._began)
        self.panel("header").show([title_bar(words, elapsed, self.size.width, self.look)])
        self.panel("footer").show([self._footer(self.size.width)])

    def _footer(self, width: int) -> Text:
        look = self.look
        if self._types:
            words = f" filter: {plain(self.window.filter)}"
            told = fitted(words, max(1, width - 1), more=look.more)
            return Text(told, style="bold").append("_", style="blink")
        if self.news:
            return wrapped(self.news, width, look.ink(look.palette.warning))[0].copy()
        orbit = [Hint("Shift+arrows", "turn"), Hint("< >", "zoom"), Hint("w", "view")]
        orbit += [Hint("y", "follow the next frame"), Hint("a", "show all")]
        end = [Hint("?", "keys"), Hint("q", "quit")]
        if self._is_alone:
            return footer([Hint("p", "tree"), *orbit, *end], width, look)
        wanted = self.window.filter
        hints = [
            Hint("s", f"sort: {self.window.order.value}"),
            Hint("/", f"filter: {plain(wanted)}" if wanted else "filter"),
            *([Hint("Esc", "all frames")] if wanted else []),
            Hint("p", "3-D"),
            Hint("up/down" if look.ascii_only else "↑↓", "scroll"),
        ]
        more = [Hint("PgUp PgDn", "page"), Hint("g G", "top, end")]
        return footer([*hints, *(orbit if self.space.in_space else more), *end], width, look)

    # Keys

    def on_key(self, event: events.Key) -> None:
        """Handle a key: scroll, sort, filter or leave."""
        event.stop()
        self.news = ""
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
            self._is_alone = not self._is_alone
            self._arrange()
            self.call_after_refresh(self.redraw)
        elif self.space.press(event.key, self._next_followed()):
            return
        elif event.key == "s":
            self.window.sort()
        elif event.key == "slash":
            self._types = True
        elif event.key == "escape":
            self.window.filter = ""
            self.panel("keys").display = False
        else:
            self._scroll(event.key)
        self.redraw()

    def _next_followed(self) -> str:
        """Return the next frame that the camera is to follow; "" after the last frame."""
        names = [info.frame for info in self._seen[0].frames] if self._seen else []
        names.append("")
        follows = self.space.camera.follows
        return names[(names.index(follows) + 1) % len(names) if follows in names[:-1] else 0]

    def _type(self, event: events.Key) -> None:
        if event.key in ("enter", "escape"):
            self._types = False
            if event.key == "escape":
                self.window.filter = ""
        elif event.key == "backspace":
            self.window.filter = self.window.filter[:-1]
        elif event.character is not None and event.character.isprintable():
            self.window.filter += event.character
        self.window.first = 0

    def _scroll(self, key: str) -> None:
        page = max(1, self.query_one("#rows", Panel).size.height - 3)
        steps = {
            "up": -1, "k": -1, "down": 1, "j": 1, "pageup": -page, "pagedown": page,
            "space": page, "home": -(10**9), "g": -(10**9), "end": 10**9, "G": 10**9,
        }  # fmt: skip
        self.window.first = max(0, self.window.first + steps.get(key, 0))

    def on_mouse_scroll_down(self, event: events.MouseScrollDown) -> None:
        """Scroll the tree down by three rows."""
        self.window.first += 3
        self.redraw()

    def on_mouse_scroll_up(self, event: events.MouseScrollUp) -> None:
        """Scroll the tree up by three rows."""
        self.window.first = max(0, self.window.first - 3)
        self.redraw()
