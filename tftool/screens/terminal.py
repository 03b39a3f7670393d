"""The terminal app: the field, the tree, a pair of frames, the log; keys drive turtle1.

It looks at a world and never changes it, but for the keys it hands to `press`.
Time in it is the world's; how often it looks is real time, so that a world at
100 times real time is drawn no more often than one at 1.
"""

import asyncio
from collections.abc import Callable, Coroutine, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from rich.segment import Segment
from rich.text import Text
from textual import events
from textual.app import App, ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Container
from textual.geometry import Region
from textual.strip import Strip
from textual.theme import Theme
from textual.widget import Widget

from tftool.errors import TftoolError
from tftool.screens import panels
from tftool.screens.panels import Hint, Look
from tftool.screens.scene import Moment, Scene
from tftool.stamps import Duration, Stamp, seconds
from tftool.views import canvas, theme

SMALLEST = (30, 10)
"""Columns and rows below which there is nothing but a sentence."""

WITH_PANELS = 56
"""Columns from which the field gets company."""

LOOKS_PER_SECOND = 20
PANELS_EVERY = 3
"""Of that many looks, the text beside the field is written anew in one."""

PATIENCE = seconds(4.0)
"""For how long after the start the frames of the first pair are waited for."""

REST = 4.0
"""For how many times as long as a look took there is no other one."""

STEP, LEAP = seconds(0.1), seconds(1.0)

Press = Callable[[str], object]


@dataclass(frozen=True, slots=True)
class Setting:
    """What the terminal can show, and what is asked for.

    Attributes:
        title: What runs, for the top line.
        pair: Target and source to begin with.
        ascii_only: Draw with ASCII alone.
        colors: Whether colours may be used.
        light: Whether the terminal's ground is light.
        drive_only: Whether the field has the screen to itself, as in teleop.
        banner: Lines to show above the field.
    """

    title: str = "tftool"
    pair: tuple[str, str] = ("turtle2", "turtle1")
    ascii_only: bool = False
    colors: bool = True
    light: bool = False
    drive_only: bool = False
    banner: tuple[str, ...] = ()


def setting_from(environment: Mapping[str, str], encoding: str, wanted: Setting) -> Setting:
    """Complete `wanted` by what the environment says of the terminal.

    Args:
        environment: Its TERM, NO_COLOR, COLORFGBG and LC_ALL count.
        encoding: What the terminal's text is encoded in.
        wanted: What was asked for; it is only ever restricted.
    """
    terminal = environment.get("TERM", "")
    ascii_only = (
        not encoding.lower().replace("-", "").startswith("utf")
        or environment.get("LC_ALL") in {"C", "POSIX"}
        # Its font has neither braille nor quadrant blocks.
        or terminal in {"linux", "vt100", "vt220", "dumb"}
    )
    return replace(
        wanted,
        ascii_only=wanted.ascii_only or ascii_only,
        colors=wanted.colors and not environment.get("NO_COLOR"),
        light=wanted.light or theme.prefers_light(environment),
    )


class Panel(Widget):
    """Lines of text that repaints only those that changed."""

    def __init__(self, name: str, title: str = "", *, can_focus: bool = True) -> None:
        super().__init__(id=name)
        self.can_focus = can_focus
        self._title = title
        self._strips: list[Strip] = []

    def show(self, lines: list[Text] | list[list[Segment]]) -> None:
        """Show these lines from now on."""
        width, height = self.size
        strips = [
            Strip(line.render(self.app.console, end="") if isinstance(line, Text) else line)
            for line in lines[:height]
        ]
        ground = self.rich_style
        strips = [strip.adjust_cell_length(width).apply_style(ground) for strip in strips]
        before, self._strips = self._strips, strips
        for y in range(max(len(before), len(strips))):
            if y >= len(before) or y >= len(strips) or before[y] != strips[y]:
                self.refresh(Region(0, y, width, 1))

    def render_line(self, y: int) -> Strip:
        """Give one line to textual."""
        if y < len(self._strips):
            return self._strips[y]
        return Strip.blank(self.size.width, self.rich_style)


def _themes() -> list[Theme]:
    return [
        Theme(
            name=name,
            primary=theme.hexadecimal(palette.accent),
            accent=theme.hexadecimal(palette.accent),
            foreground=theme.hexadecimal(palette.text),
            background=theme.hexadecimal(palette.ground),
            surface=theme.hexadecimal(palette.panel),
            panel=theme.hexadecimal(palette.panel),
            secondary=theme.hexadecimal(theme.blend(palette.ground, palette.dim, 0.6)),
            dark=palette is theme.DARK,
        )
        for name, palette in (("tftool-dark", theme.DARK), ("tftool-light", theme.LIGHT))
    ]


KEYS = """\
 Arrow keys   drive turtle1; a press lasts a second
 g t r e      turn to 0, 45, 90, 135 degrees
 d c v b      turn to 180, -135, -90, -45 degrees
 f            give the turn up

 Tab          next panel (Shift+Tab: back)
 Up, Down     in the tree: pick a frame (also j, k)
 Enter        measure from the frame picked
 x            swap the two frames

 [ ]          back and on in time by 0.1 s
 { }          by a second
 l            back to live

 m            light or dark
 q            quit
"""


class TurtleApp(App[None]):
    """The screen of `tftool demo` and `tftool teleop`.

    Args:
        scene: Where to look.
        press: Takes a key that drives: "up", "g", ...; None where nothing can be driven.
        setting: How to show it.
    """

    CSS = """
    Screen { layout: vertical; background: $background; color: $foreground; overflow: hidden; }
    Panel { background: $surface; border: round $secondary; border-title-color: $foreground; }
    Panel:focus { border: round $accent; border-title-color: $accent; border-title-style: bold; }
    .mono Panel:focus { border: heavy $accent; }
    .ascii Panel { border: ascii $secondary; }
    .ascii Panel:focus { border: ascii $accent; }
    #header, #footer, #small { border: none; height: 1; background: $background; }
    #small { height: 1fr; display: none; }
    #banner { border: none; display: none; background: $background; }
    #body { height: 1fr; layout: horizontal; overflow: hidden; }
    #side { width: 1fr; height: 1fr; layout: vertical; overflow: hidden; }
    #keys { layer: above; dock: top; width: 56; display: none; border: round $accent; }
    .ascii #keys { border: ascii $accent; }
    Screen { layers: default above; }
    .portrait #body { layout: vertical; }
    .portrait #side { layout: horizontal; }
    """
    ENABLE_COMMAND_PALETTE = False
    ALLOW_SELECT = False
    BINDINGS: ClassVar[list[BindingType]] = [
        *(
            Binding(key, f"steer('{key}')", show=False, priority=True)
            for key in ("up", "down", "left", "right")
        ),
        *(
            Binding(f"{key},{key.upper()}", f"drive('{key}')", show=False, priority=True)
            for key in "gtredcvbf"
        ),
        Binding("q,Q", "leave", show=False, priority=True),
        Binding("ctrl+c", "interrupt", show=False, priority=True),
        Binding("ctrl+z", "suspend_process", show=False, priority=True),
        Binding("tab", "panel(1)", show=False, priority=True),
        Binding("shift+tab", "panel(-1)", show=False, priority=True),
        Binding("j", "pick(1)", show=False),
        Binding("k", "pick(-1)", show=False),
        Binding("enter,space", "measure", show=False),
        Binding("x", "swap", show=False),
        Binding("left_square_bracket", f"travel({-STEP})", show=False),
        Binding("right_square_bracket", f"travel({STEP})", show=False),
        Binding("left_curly_bracket", f"travel({-LEAP})", show=False),
        Binding("right_curly_bracket", f"travel({LEAP})", show=False),
        Binding("l,escape,end", "live", show=False),
        Binding("m", "shade", show=False),
        Binding("question_mark,h", "keys", show=False),
    ]

    def __init__(
        self, scene: Scene, press: Press | None = None, setting: Setting | None = None
    ) -> None:
        self.setting = setting or Setting()
        # Without this, textual shows greys where NO_COLOR asks for none.
        super().__init__(ansi_color=not self.setting.colors)
        self.scene = scene
        self.failure: Exception | None = None
        self.interrupted = False
        self.title = self.setting.title
        self.ready = asyncio.Event()
        self._press = press
        self._light = self.setting.light
        self._target, self._source = self.setting.pair
        self._picked = False
        self._at: Stamp | None = None
        self._moment: Moment | None = None
        self._stale = True
        self._painted: object = None
        self._count = 0
        self._back = 0
        self._rest_until = 0.0
        self._canvas = canvas.Canvas(0, 0)
        self._journal = panels.Journal(scene.world.log.records)
        self._unlisten = scene.world.log.listen(self._journal.add)

    # Building

    def compose(self) -> ComposeResult:
        """Make the panels; `_arrange` gives them their sizes."""
        yield Panel("header", can_focus=False)
        yield Panel("banner", can_focus=False)
        with Container(id="body"):
            yield Panel("field", "Field")
            with Container(id="side"):
                yield Panel("tree", "Tree")
                yield Panel("pair", "Echo")
                yield Panel("log", "Log")
        yield Panel("footer", can_focus=False)
        yield Panel("small", can_focus=False)
        yield Panel("keys", "Keys", can_focus=False)

    def on_mount(self) -> None:
        """Start looking."""
        # textual makes new tasks start eagerly where Python can; the nodes of the world on
        # this loop are to run in the order they always run in.
        asyncio.get_running_loop().set_task_factory(None)
        for one in _themes():
            self.register_theme(one)
        self._shade()
        self.screen.set_class(self.setting.ascii_only, "ascii")
        self.screen.set_class(not self.setting.colors, "mono")
        for panel in self.query(Panel):
            if panel._title:
                panel.border_title = panel._title
        self.panel("field").focus()
        self.call_after_refresh(self.ready.set)
        self.set_interval(1.0 / LOOKS_PER_SECOND, self._tick)

    def panel(self, name: str) -> Panel:
        """One of the panels: header, field, tree, pair, log, footer."""
        return self.query_one(f"#{name}", Panel)

    @property
    def look(self) -> Look:
        """How the panels paint."""
        palette = theme.LIGHT if self._light else theme.DARK
        return Look(palette, self.setting.ascii_only)

    def on_resize(self, event: events.Resize) -> None:
        """Fit the panels into the new size."""
        self._arrange(event.size.width, event.size.height)
        self.call_after_refresh(self.redraw)

    def _arrange(self, width: int, height: int) -> None:
        small = width < SMALLEST[0] or height < SMALLEST[1]
        for name in ("header", "footer"):
            self.panel(name).display = not small
        self.query_one("#body").display = not small
        self.panel("small").display = small
        banner = self._banner(width) if height >= 24 else []
        self.panel("banner").display = bool(banner) and not small
        self.panel("banner").styles.height = len(banner)
        if small:
            return
        room = height - 2 - len(banner)
        alone = width < WITH_PANELS
        self.query_one("#side").display = not alone
        beside = min(room - 2, (width - (28 if width < 84 else 38)) // 2)
        above = min((width - 2) // 2, room - 12)
        portrait = not alone and above > beside * 1.15
        self.screen.set_class(portrait, "portrait")
        field = self.panel("field")
        if alone:
            field.styles.width, field.styles.height = "1fr", "1fr"
        elif portrait:
            field.styles.width, field.styles.height = "1fr", above + 2
        else:
            field.styles.width, field.styles.height = 2 * beside + 2, "1fr"
        self._share(room, portrait)

    def _banner(self, width: int) -> list[Text]:
        return [line for text in self.setting.banner for line in panels.wrapped(text, width)]

    def _share(self, room: int, portrait: bool) -> None:
        """Share the side out: the tree what it needs, the pair its lines, the log the rest."""
        tree, pair, log = (self.panel(name) for name in ("tree", "pair", "log"))
        for panel in (tree, pair):
            panel.display = not self.setting.drive_only
        for panel in (tree, pair, log):
            panel.styles.width = "1fr" if portrait else "100%"
            panel.styles.height = "1fr"
        if portrait:
            return
        lines = panels.BLOCK_LINES if room >= 40 else panels.PAIR_LINES
        frames = 3 if self._moment is None else len(self._moment.snapshot.frames)
        least_log = max(3, room // 4)
        tree.styles.height = min(max(4, frames + 3), max(5, room - lines - 2 - least_log))
        pair.styles.height = lines + 2

    # Looking

    def _tick(self) -> None:
        loop = asyncio.get_running_loop()
        if loop.time() < self._rest_until:
            return
        began = loop.time()
        try:
            self._count += 1
            self.scene.look()
            self._draw(panels_too=self._count % PANELS_EVERY == 0 or self._stale)
        except Exception as error:
            self._fail(error)
        # A world of thousands of frames is drawn less often, so that it still lives.
        self._rest_until = loop.time() + REST * (loop.time() - began)

    def redraw(self) -> None:
        """Draw everything that changed, now."""
        try:
            self._stale = True
            self._draw(panels_too=True)
        except Exception as error:
            self._fail(error)

    def _fail(self, error: Exception) -> None:
        # Kept for who runs the app: said on a restored terminal, it can be read.
        self.failure = self.failure or error
        self.exit()

    def _draw(self, *, panels_too: bool) -> None:
        if not self.is_running or not self.panel("header").is_attached:
            return
        width, height = self.size
        if self.panel("small").display:
            least = f"{SMALLEST[0]}x{SMALLEST[1]}"
            words = f"This terminal is {width}x{height}; tftool needs {least} or more."
            self.panel("small").show(panels.wrapped(words, width))
            return
        moment = self._moment
        if self._at is None or self._stale or moment is None:
            frames = 0 if moment is None else len(moment.snapshot.frames)
            simulator = self.scene.simulator
            painted = None if simulator is None else simulator.revision
            if not (panels_too or painted != self._painted or painted is None):
                return
            self._painted = painted
            moment = self._moment = self._current()
            if len(moment.snapshot.frames) != frames:
                self._arrange(width, height)
        else:
            now = self.scene.world.clock.now()
            moment = self._moment = replace(moment, behind=now - moment.stamp)
        self._stale = False
        self._draw_field(moment)
        if panels_too:
            self._draw_panels(moment)

    def _current(self) -> Moment:
        kept = self._moment
        if self._at is not None and kept is not None and kept.stamp == self._at:
            return self.scene.again(kept, self._target, self._source)
        found = self.scene.moment(self._at, self._target, self._source)
        pair = self._other_pair(found)
        if pair != (self._target, self._source):
            self._target, self._source = pair
            return self.scene.moment(self._at, *pair)
        return found

    def _other_pair(self, moment: Moment) -> tuple[str, str]:
        """The pair asked for, until its frames are overdue and nobody picked another."""
        asked, snapshot = (self._target, self._source), moment.snapshot
        names = [info.frame for info in snapshot.frames if info.parent is not None]
        soon = self.scene.simulator is not None and moment.elapsed < PATIENCE
        if self._picked or soon or not names or all(name in snapshot for name in asked):
            return asked
        source = self._source if self._source in snapshot else names[-1]
        return snapshot.frame(source).root or names[0], source

    def _draw_field(self, moment: Moment) -> None:
        field = self.panel("field")
        width, height = field.size
        box = 0 if self.setting.colors else 1
        columns, rows = canvas.fit(width - 2 * box, height - 2 * box)
        drawn = self._canvas
        if (drawn.columns, drawn.rows) != (columns, rows):
            drawn = self._canvas = canvas.Canvas(
                columns,
                rows,
                ascii_only=self.setting.ascii_only,
                arrows=not self.setting.colors,
            )
        lines = drawn.lines(moment.picture)
        if box and rows:
            lines = canvas.framed(lines, ascii_only=self.setting.ascii_only)
        left = (width - columns) // 2 - box
        above = (height - rows) // 2 - box
        margin = [Segment(" " * left)] if left > 0 else []
        field.show([[] for _ in range(above)] + [[*margin, *line] for line in lines])

    def _draw_panels(self, moment: Moment) -> None:
        look, clock = self.look, self.scene.world.clock
        width = self.size.width
        self.panel("header").show([panels.header(self.title, moment, clock.rate, width, look)])
        self.panel("footer").show([panels.footer(self._hints(), width, look)])
        self.panel("banner").show(self._banner(width))
        if not self.query_one("#side").display:
            return
        tree, pair, log = (self.panel(name) for name in ("tree", "pair", "log"))
        listed = panels.rows(moment.snapshot, ascii_only=look.ascii_only)
        tree.show(panels.tree(moment, listed, self._source, *tree.size, look))
        pair.show(panels.pair(moment, *pair.size, look))
        log.show(
            self._journal.lines(moment.stamp, self.scene.start, *log.size, look, back=self._back)
        )

    def _hints(self) -> list[Hint]:
        arrows = "arrows" if self.setting.ascii_only else "↑↓←→"
        updown = "up/down" if self.setting.ascii_only else "↑↓"
        focused = self.focused.id if self.focused else ""
        travel = [Hint("[ ]", "past")]
        if self._at is not None:
            travel = [Hint("l", "live"), Hint("[ ]", "time")]
        ends = [Hint("?", "keys"), Hint("q", "quit")]
        if focused == "tree":
            return [
                Hint(updown, "pick"),
                Hint("Enter", "measure from"),
                Hint("x", "swap"),
                *travel,
                Hint("Tab", "panel"),
                *ends,
            ]
        if focused == "pair":
            return [Hint(updown, "source"), Hint("x", "swap"), *travel, Hint("Tab", "panel"), *ends]
        if focused == "log":
            return [Hint(updown, "scroll"), *travel, Hint("Tab", "panel"), *ends]
        drive, turn = [], []
        if self._press is not None:
            drive = [Hint(arrows, "drive")]
            turn = [Hint("gbvcdert", "turn, f cancel")]
        # In the order in which they are left out, the last ones first.
        return [*drive, *travel, Hint("Tab", "panel"), ends[0], *turn, ends[1]]

    # Keys

    def action_drive(self, key: str) -> None:
        """Hand a key to the teleop node."""
        if self._press is not None:
            try:
                self._press(key)
            except TftoolError as refusal:
                self.scene.world.log.warn("screen", str(refusal))

    def action_steer(self, key: str) -> None:
        """Drive; or, in a panel of text, move there."""
        focused = self.focused.id if self.focused else ""
        step = {"up": -1, "down": 1}.get(key, 0)
        if focused in {"tree", "pair"}:
            if step:
                self.action_pick(step)
        elif focused == "log":
            self._back = max(0, min(self._back - step, len(self.scene.world.log.records)))
            self.redraw()
        else:
            self.action_drive(key)

    def action_panel(self, step: int) -> None:
        """Give the keys to the next panel."""
        if step > 0:
            self.screen.focus_next()
        else:
            self.screen.focus_previous()
        self.call_after_refresh(self.redraw)

    def action_pick(self, step: int) -> None:
        """Move through the tree: the frame under the cursor is the pair's source."""
        if self._moment is None:
            return
        names = [row.info.frame for row in panels.rows(self._moment.snapshot)]
        if not names:
            return
        at = names.index(self._source) if self._source in names else -1
        self._source = names[max(0, min(len(names) - 1, at + step))]
        self._picked = True
        self.redraw()

    def action_measure(self) -> None:
        """Make the frame under the cursor the one that is measured in."""
        self._target, self._picked = self._source, True
        self.redraw()

    def action_swap(self) -> None:
        """Ask the other way round."""
        self._target, self._source, self._picked = self._source, self._target, True
        self.redraw()

    def action_travel(self, step: Duration) -> None:
        """Show an earlier moment, or a later one; past now is live."""
        now = self.scene.world.clock.now()
        there = (now if self._at is None else self._at) + step
        self._at = None if there >= now else max(there, self.scene.oldest())
        self.redraw()

    def action_live(self) -> None:
        """Show the present again, and hide the key help."""
        self.panel("keys").display = False
        self._at = None
        self._back = 0
        self.redraw()

    def action_shade(self) -> None:
        """Change between light and dark."""
        self._light = not self._light
        self._shade()
        self.redraw()

    def _shade(self) -> None:
        self.theme = "tftool-light" if self._light else "tftool-dark"

    def action_keys(self) -> None:
        """Show or hide what every key does."""
        keys = self.panel("keys")
        keys.display = not keys.display
        lines = KEYS.splitlines()
        width, height = self.size
        keys.styles.height = len(lines) + 2
        keys.styles.offset = max(0, (width - 56) // 2), max(0, (height - len(lines) - 2) // 2)
        self.call_after_refresh(lambda: keys.show([Text(line) for line in lines]))

    def action_leave(self) -> None:
        """End."""
        self.exit()

    def action_interrupt(self) -> None:
        """End as an interrupt does: in raw mode Ctrl-C comes as a key."""
        self.interrupted = True
        self.exit()


async def show(app: TurtleApp, life: Coroutine[Any, Any, None], *, headless: bool = False) -> None:
    """Put the app on the terminal while its world lives, until one of them ends.

    Whatever ends it, the terminal is restored before this returns or raises.

    Args:
        app: What to show.
        life: Lives the app's world through; cancelled when the user quits.
        headless: Do all of it but draw on a terminal.

    Raises:
        NodeFailed: If a node raised.
        TftoolError: If the screen itself failed.
        KeyboardInterrupt: If the user pressed Ctrl-C.
    """
    screen = asyncio.ensure_future(app.run_async(headless=headless))

    async def lived() -> None:
        # Making the panels takes a while in which no node would get its turn.
        await app.ready.wait()
        app.scene.start = app.scene.world.clock.now()
        await life

    living = asyncio.ensure_future(lived())
    try:
        await asyncio.wait({living, screen}, return_when=asyncio.FIRST_COMPLETED)
    finally:
        if not screen.done():
            app.exit()
            await asyncio.wait({screen})
        living.cancel()
        await asyncio.wait({living})
        life.close()
    if not living.cancelled():
        living.result()
    if app.failure is not None:
        raise TftoolError(
            f"the screen failed: {type(app.failure).__name__}: {app.failure}"
        ) from app.failure
    screen.result()
    if app.interrupted:
        raise KeyboardInterrupt
