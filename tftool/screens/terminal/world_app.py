"""What every screen over a world is: a textual app that fails and ends in one way."""

import asyncio
from collections.abc import Callable
from typing import ClassVar

from rich.text import Text
from textual import events
from textual.app import App
from textual.binding import Binding, BindingType
from textual.driver import Driver
from textual.geometry import Size

from tftool.base.stamps import Stamp
from tftool.drawing import theme
from tftool.screens.terminal.keyboard import tolerant
from tftool.screens.terminal.panel import Panel, themes
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.text_style import Look
from tftool.world.world import World


class WorldApp(App[None]):
    """A screen that shows a world, until it is left, interrupted or fails.

    Attributes:
        world: The world.
        setting: How to show it.
        ready: Set once it shows.
        failure: What it failed by, for the caller to report once the terminal is restored.
        interrupted: Whether Ctrl-C ended it.
    """

    ENABLE_COMMAND_PALETTE = False
    ALLOW_SELECT = False
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("ctrl+c", "interrupt", show=False, priority=True),
        Binding("ctrl+z", "suspend_process", show=False, priority=True),
    ]

    def __init__(
        self, world: World, setting: Setting | None, *, terminal_colors: bool = False
    ) -> None:
        """Make the screen.

        Args:
            world: What it shows.
            setting: How to show it.
            terminal_colors: Whether it is drawn in the terminal's own colours.
        """
        self.setting = setting or Setting()
        # Without this, textual shows greys where NO_COLOR asks for none.
        super().__init__(ansi_color=terminal_colors or not self.setting.colors)
        self.world = world
        self.ready = asyncio.Event()
        self.failure: Exception | None = None
        self.interrupted = False

    def begin(self, stamp: Stamp) -> None:
        """The world begins to live; what counts time from then says so."""

    def get_driver_class(self) -> type[Driver]:
        """Give what reads the keys."""
        return tolerant(super().get_driver_class())

    def on_mount(self) -> None:
        """Let the world's nodes run, and say when the first picture is there."""
        # textual makes new tasks start eagerly where Python can; the nodes of the world on
        # this loop are to run in the order they always run in.
        asyncio.get_running_loop().set_task_factory(None)
        # Between Ctrl-Z and fg the shell wrote over the picture; textual sends only what changed.
        self.app_resume_signal.subscribe(self, lambda _: self.refresh(layout=True))
        self.call_after_refresh(self.ready.set)

    def guarded(self, work: Callable[[], None]) -> None:
        """Do some drawing; if it raises, that is kept and the screen ends."""
        try:
            work()
        except Exception as error:
            self.failure = self.failure or error
            self.exit()

    def action_leave(self) -> None:
        """End."""
        self.exit()

    def action_interrupt(self) -> None:
        """End as an interrupt does: in raw mode Ctrl-C comes as a key."""
        self.interrupted = True
        self.exit()


class PanelApp(WorldApp):
    """A screen of panels in tftool's own colours, light or dark, with one that tells the keys."""

    KEYS_WIDTH: ClassVar[int]
    """Cells that the panel of the keys takes."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("q,Q", "leave", show=False, priority=True),
        Binding("m", "shade", show=False),
        Binding("question_mark,h", "keys", show=False),
    ]

    def __init__(self, world: World, setting: Setting | None) -> None:
        """Make the screen; see `WorldApp`."""
        super().__init__(world, setting)
        self.title = self.setting.title
        self._light = self.setting.light

    def on_mount(self) -> None:
        """Put on the colours."""
        for one in themes():
            self.register_theme(one)
        self._shade()
        self.screen.set_class(self.setting.ascii_only, "ascii")

    def panel(self, name: str) -> Panel:
        """One of the panels, by its id."""
        return self.query_one(f"#{name}", Panel)

    @property
    def look(self) -> Look:
        """How the panels paint."""
        palette = theme.LIGHT if self._light else theme.DARK
        return Look(palette, self.setting.ascii_only)

    def redraw(self) -> None:
        """Draw everything that changed, now."""
        raise NotImplementedError

    def action_shade(self) -> None:
        """Change between light and dark."""
        self._light = not self._light
        self._shade()
        self.redraw()

    def action_keys(self) -> None:
        """Show or hide what every key does."""
        panel = self.panel("keys")
        panel.display = not panel.display
        self._place_keys(self.size)

    def on_resize(self, event: events.Resize) -> None:
        """Keep the keys in the middle."""
        self._place_keys(event.size)

    def keys_told(self) -> str:
        """Say what the keys do, a line each."""
        raise NotImplementedError

    def _place_keys(self, size: Size) -> None:
        panel = self.panel("keys")
        if not panel.display:
            return
        lines = self.keys_told().splitlines()
        width, height = size
        panel.styles.width = min(self.KEYS_WIDTH, width)
        panel.styles.height = min(len(lines) + 2, height)
        panel.styles.offset = (
            max(0, (width - self.KEYS_WIDTH) // 2),
            max(0, (height - len(lines) - 2) // 2),
        )
        self.call_after_refresh(lambda: panel.show([Text(line) for line in lines]))

    def _shade(self) -> None:
        self.theme = "tftool-light" if self._light else "tftool-dark"
