"""Base classes of all screens: a Textual app of panels, with common keys and error handling."""

import asyncio
import os
from collections.abc import Callable, Coroutine, Iterable
from textwrap import wrap
from typing import Any, ClassVar

from rich.segment import Segment
from rich.style import Style
from rich.text import Text
from textual import events
from textual.app import App
from textual.binding import Binding, BindingType
from textual.driver import Driver
from textual.geometry import Region, Size
from textual.message import Message
from textual.strip import Strip
from textual.theme import Theme
from textual.widget import Widget

from tftool.base.errors import TftoolError
from tftool.base.stamps import Stamp
from tftool.drawing import theme
from tftool.screens.still_frames import ShownFrames
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.text_style import Look
from tftool.world.stopper import leave_screen


def input_events(sent: str) -> Iterable[Message]:
    """Parse a terminal's input with Textual's parser; yield the keys and mouse moves.

    Textual's parser is not part of Textual's public interface. If a version of Textual has moved
    the parser, no events are returned.
    """
    try:
        from textual._xterm_parser import XTermParser
    except ImportError:
        return ()
    return XTermParser().feed(sent)


def tolerant(driver: type[Driver]) -> type[Driver]:
    """Return a driver class that ignores input bytes which are not UTF-8.

    With Textual's own driver, such bytes end the app with a traceback. A terminal with another
    encoding sends such bytes.

    Args:
        driver: Textual's driver class on this platform; the driver for Windows decodes no bytes.
    """
    if not hasattr(driver, "run_input_thread"):
        return driver
    base: Any = driver

    class TolerantDriver(base):  # type: ignore[misc]
        def run_input_thread(self) -> None:
            while True:
                try:
                    super().run_input_thread()
                except UnicodeDecodeError as error:
                    # Valid input around the bad bytes is processed; the next round continues.
                    for event in input_events(error.object.decode(errors="ignore")):
                        self.process_message(event)
                    continue
                return

    return TolerantDriver


class Panel(Widget):
    """Panel of text lines, in which only changed lines are drawn again."""

    def __init__(self, name: str, title: str = "", *, can_focus: bool = True) -> None:
        super().__init__(id=name)
        self.can_focus = can_focus
        self._title = title
        self._lines: list[Text] | list[list[Segment]] = []
        self._strips: list[Strip] = []
        self._drawn_for: tuple[int, Style] | None = None

    def on_mount(self) -> None:
        """Set the panel's title."""
        if self._title:
            self.border_title = self._title

    def show(self, lines: list[Text] | list[list[Segment]]) -> None:
        """Replace the lines of the panel."""
        width, height = self.size
        ground = self.rich_style
        kept: dict[int, Strip] = {}
        if (width, ground) == self._drawn_for:
            # Making a strip costs more than comparing lines, and most lines stay as they were.
            kept = {
                y: self._strips[y]
                for y in range(min(len(lines), len(self._strips)))
                if _looks_alike(lines[y], self._lines[y])
            }
        before, self._lines, self._drawn_for = self._strips, lines, (width, ground)
        self._strips = [
            kept[y] if y in kept else self._strip(lines[y], width, ground)
            for y in range(min(len(lines), height))
        ]
        for y in range(max(len(before), len(self._strips))):
            if y in kept:
                continue
            if y >= len(before) or y >= len(self._strips) or before[y] != self._strips[y]:
                self.refresh(Region(0, y, width, 1))

    def _strip(self, line: Text | list[Segment], width: int, ground: Style) -> Strip:
        parts = line.render(self.app.console, end="") if isinstance(line, Text) else line
        return Strip(parts).adjust_cell_length(width).apply_style(ground)

    def on_resize(self) -> None:
        """Shorten the lines to the panel's new size."""
        self.show(self._lines)

    def render_line(self, y: int) -> Strip:
        """Return one line of the panel, for Textual."""
        if y < len(self._strips):
            return self._strips[y]
        return Strip.blank(self.size.width, self.rich_style)


def _looks_alike(new: Text | list[Segment], old: Text | list[Segment]) -> bool:
    # rich compares texts without their own style.
    same_style = not isinstance(new, Text) or not isinstance(old, Text) or new.style == old.style
    return same_style and new == old


def themes() -> list[Theme]:
    """Return the two palettes of `theme` as Textual themes: tftool-dark and tftool-light."""
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


class WorldApp(App[None]):
    """Screen that shows a world until the user quits, presses Ctrl-C, or the world fails.

    Attributes:
        world: World to show.
        setting: Options of the screen.
        ready: Event that is set when the first picture is shown.
        failure: Error of the screen, which the caller reports after the terminal is restored.
        interrupted: Whether Ctrl-C ended the app.
    """

    ENABLE_COMMAND_PALETTE = False
    ALLOW_SELECT = False
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("ctrl+c", "interrupt", show=False, priority=True),
        Binding("ctrl+z", "suspend_process", show=False, priority=True),
    ]

    def __init__(
        self, world: ShownFrames, setting: Setting | None, *, terminal_colors: bool = False
    ) -> None:
        """Create the screen.

        Args:
            world: World to show.
            setting: Options of the screen.
            terminal_colors: Whether to draw in the terminal's own colours.
        """
        self.setting = setting or Setting()
        # Without this, textual shows grey text although NO_COLOR is set.
        super().__init__(ansi_color=terminal_colors or not self.setting.colors)
        self.world = world
        self.ready = asyncio.Event()
        self.failure: Exception | None = None
        self.interrupted = False

    async def run_with_world(
        self, life: Coroutine[Any, Any, None], *, headless: bool = False
    ) -> None:
        """Run the screen on the terminal while its world runs, until the screen or the world ends.

        The terminal is always restored before this function returns or raises.

        Args:
            life: Coroutine that runs the world; cancelled when the user quits.
            headless: Whether to do everything except drawing on a terminal.

        Raises:
            NodeFailed: If a node raised an exception.
            TftoolError: If the screen itself failed.
            KeyboardInterrupt: If the user pressed Ctrl-C.
        """
        # Ctrl-C as a signal, not a key: a node may block the event loop, which reads keys.
        os.environ.setdefault("TEXTUAL_ALLOW_SIGNALS", "1")
        undo = self.world.clock.when_killed.add(leave_screen, "screen")
        screen = asyncio.ensure_future(self.run_async(headless=headless))

        async def lived() -> None:
            # The nodes start after the panels were created, which takes a while.
            await self.ready.wait()
            self.begin(self.world.clock.now())
            await life

        living = asyncio.ensure_future(lived())
        try:
            await asyncio.wait({living, screen}, return_when=asyncio.FIRST_COMPLETED)
        finally:
            if not screen.done():
                self.exit()
                await asyncio.wait({screen})
            living.cancel()
            await asyncio.wait({living})
            life.close()
            undo()
        if not living.cancelled():
            living.result()
        if self.failure is not None:
            raise TftoolError(
                f"the screen failed: {type(self.failure).__name__}: {self.failure}"
            ) from self.failure
        screen.result()
        if self.interrupted:
            raise KeyboardInterrupt

    def begin(self, stamp: Stamp) -> None:
        """Do nothing; called when the world starts, and overridden to count seconds."""

    def get_driver_class(self) -> type[Driver]:
        """Return the class of the driver that reads keys."""
        return tolerant(super().get_driver_class())

    def on_mount(self) -> None:
        """Prepare the event loop for the world's nodes, and set `ready` after the first picture."""
        # If Python can, textual starts new tasks eagerly; the world's nodes in this event loop
        # need the usual order.
        asyncio.get_running_loop().set_task_factory(None)
        # After Ctrl-Z and fg, the shell's text covers the picture, and textual draws only changes.
        self.app_resume_signal.subscribe(self, lambda _: self.refresh(layout=True))
        self.call_after_refresh(self.ready.set)

    def guarded(self, work: Callable[[], None]) -> None:
        """Call a drawing function; if the function raises, store the error and end the screen."""
        try:
            work()
        except Exception as error:
            self.failure = self.failure or error
            self.exit()

    def action_leave(self) -> None:
        """End the screen because the user quits."""
        self.exit()

    def action_interrupt(self) -> None:
        """Handle Ctrl-C, which arrives as a key in raw mode: end the screen as interrupted."""
        self.interrupted = True
        self.exit()


FRAME_CSS = """
Screen { layout: vertical; background: $background; color: $foreground; overflow: hidden; }
Screen { layers: default above; }
Panel { background: $surface; border: round $secondary; border-title-color: $foreground; }
Panel { border-subtitle-color: $foreground; }
.ascii Panel { border: ascii $secondary; }
#header, #footer { border: none; height: 1; background: $background; }
#body { height: 1fr; layout: horizontal; overflow: hidden; }
.portrait #body { layout: vertical; }
#side { width: 1fr; height: 1fr; layout: vertical; overflow: hidden; }
#keys { layer: above; dock: top; display: none; border: round $accent; }
.ascii #keys { border: ascii $accent; }
"""
"""CSS of the panels that all screens have."""


class PanelApp(WorldApp):
    """Screen of panels in tftool's colours, light or dark, with a panel of key help."""

    keys_help: str
    """Text of the key help, with one line for each key."""

    KEYS_WIDTH: ClassVar[int] = 77
    """Largest width in cells of the panel with the key help."""

    CSS = FRAME_CSS

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("q,Q", "leave", show=False, priority=True),
        Binding("m", "shade", show=False),
        Binding("question_mark,h", "keys", show=False),
    ]

    def __init__(self, world: ShownFrames, setting: Setting | None) -> None:
        """Create the screen; see `WorldApp`."""
        super().__init__(world, setting)
        self.title = self.setting.title
        self._light = self.setting.light
        self._keys_page = 0

    def on_mount(self) -> None:
        """Apply tftool's colours to the screen."""
        for one in themes():
            self.register_theme(one)
        self._shade()
        self.screen.set_class(self.setting.ascii_only, "ascii")

    def panel(self, name: str) -> Panel:
        """Return the panel with the id `name`."""
        return self.query_one(f"#{name}", Panel)

    @property
    def look(self) -> Look:
        """Palette and characters that the panels use."""
        palette = theme.LIGHT if self._light else theme.DARK
        return Look(palette, self.setting.ascii_only)

    def redraw(self) -> None:
        """Draw everything that has changed."""
        raise NotImplementedError

    def action_shade(self) -> None:
        """Switch between light and dark colours."""
        self._light = not self._light
        self._shade()
        self.redraw()

    def action_keys(self) -> None:
        """Show the key help, its next page, or hide it after the last page."""
        panel = self.panel("keys")
        self._keys_page = self._keys_page + 1 if panel.display else 0
        panel.display = self._keys_page < len(self._keys_pages(self.size))
        self._place_keys(self.size)

    def on_resize(self, event: events.Resize) -> None:
        """Move the key help to the middle of the screen."""
        self._place_keys(event.size)

    def _place_keys(self, size: Size) -> None:
        panel = self.panel("keys")
        if not panel.display:
            return
        pages = self._keys_pages(size)
        self._keys_page = min(self._keys_page, len(pages) - 1)
        lines = pages[self._keys_page]
        width, height = size
        panel.styles.width = min(self.KEYS_WIDTH, width)
        panel.styles.height = min(len(lines) + 2, height)
        panel.styles.offset = (
            max(0, (width - self.KEYS_WIDTH) // 2),
            max(0, (height - len(lines) - 2) // 2),
        )
        panel.show([Text(line) for line in lines])

    def _keys_pages(self, size: Size) -> list[list[str]]:
        """Return the lines of the key help, in as many pages as a screen of this size needs."""
        width, height = (max(1, cells - 2) for cells in (min(self.KEYS_WIDTH, size[0]), size[1]))
        lines = [
            part
            for line in self.keys_help.splitlines()
            for part in wrap(line, width, subsequent_indent=" " * 14) or [""]
        ]
        if len(lines) > height:
            lines = [line for line in lines if line]
        if len(lines) <= height:
            return [lines]
        step = max(1, height - 1)  # the last line of a page names the next page
        pages = [lines[start : start + step] for start in range(0, len(lines), step)]
        for number, page in enumerate(pages[:-1], 1):
            page.append(f" ?            more keys (page {number} of {len(pages)})")
        return pages

    def _shade(self) -> None:
        self.theme = "tftool-light" if self._light else "tftool-dark"
