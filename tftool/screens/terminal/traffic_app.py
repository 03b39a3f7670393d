"""Screen of `tftool monitor`: rates and delays of all frames as curves."""

from typing import ClassVar

from textual import events
from textual.app import ComposeResult
from textual.binding import Binding, BindingType

from tftool.base.plain_text import count, natural_key, visible
from tftool.base.stamps import as_seconds
from tftool.buffer.traffic import FrameTraffic, Traffic
from tftool.drawing.echo_view import in_words
from tftool.drawing.sparklines import LOOKS, TrafficHistory
from tftool.drawing.traffic_curves import LONGEST, WITH_SCALE, TrafficLayout, curves, senders
from tftool.drawing.traffic_view import Chain, links_of, milliseconds, present_rate
from tftool.screens.terminal.panel_text import Hint, footer, title_bar
from tftool.screens.terminal.screen_options import Setting
from tftool.screens.terminal.world_app import FRAME_CSS, Panel, PanelApp
from tftool.world.world import World

PERIOD = as_seconds(LONGEST) / LOOKS
"""Seconds between two updates, so that the stored values cover the whole curves."""

RATED_OVER = round(2.0 / PERIOD)
"""Number of updates over which a rate is counted, two seconds."""

KEYS = """\
 Up, Down     scroll by a frame (also k, j, the wheel)
 s            sort by name, rate, delay
 m            light or dark
 ? or Esc     close these keys
 q            quit; the report stays in the terminal
"""

_ORDERS = ("name", "rate", "delay")


class TrafficWatch(PanelApp):
    """Screen of `tftool monitor`.

    Args:
        world: World whose clock is used.
        traffic: Statistics of the received messages.
        chain: Pair to report; None for all frames.
        setting: Options of the screen.
    """

    keys_help = KEYS

    CSS = f"""{FRAME_CSS}
    #frames {{ height: 1fr; }}
    """
    BINDINGS: ClassVar[list[BindingType]] = [
        *(Binding(keys, f"scroll({by})", show=False, priority=True)
          for keys, by in (("up,k", -1), ("down,j", 1), ("pageup", -10), ("pagedown", 10))),
        Binding("s", "sort", show=False),
        Binding("escape", "close", show=False),
    ]  # fmt: skip

    def __init__(
        self, world: World, traffic: Traffic, chain: Chain | None, setting: Setting | None = None
    ) -> None:
        super().__init__(world, setting)
        self._traffic, self._chain = traffic, chain
        self._history = TrafficHistory()
        self._began = world.clock.now()
        self._order = "chain" if chain is not None else "name"
        self._first = 0

    def compose(self) -> ComposeResult:
        """Create the panels of this screen."""
        yield Panel("header", can_focus=False)
        yield Panel("frames", "Frames", can_focus=False)
        yield Panel("senders", "Broadcasters", can_focus=False)
        yield Panel("footer", can_focus=False)
        yield Panel("keys", "Keys: ? or Esc closes them", can_focus=False)

    def on_mount(self) -> None:
        """Start the regular updates of the screen."""
        self.set_interval(PERIOD, self.look_again)
        self.call_after_refresh(self.look_again)

    def on_resize(self, event: events.Resize) -> None:
        """Draw everything in the new size of the terminal."""
        self.call_after_refresh(self.redraw)

    def look_again(self) -> None:
        """Store the current rates and delays, and draw the curves."""
        self._history.look(self.world.clock.now(), self._traffic, over=RATED_OVER)
        self.redraw()

    def redraw(self) -> None:
        """Draw the stored rates and delays."""
        if self.is_running and self.query("#footer"):
            self.guarded(self._draw)

    def _draw(self) -> None:
        now, look = self.world.clock.now(), self.look
        frames, below = self.panel("frames"), self.panel("senders")
        # Rows with border and heading; at most a third of the screen.
        wanted = min(len(self._traffic.senders) + 3, self.size.height // 3)
        links = self._links()
        below.display = self.size.height >= 16 and not self._names_senders(links)
        below.styles.height = wanted
        room = max(1, self.size.height - 5 - wanted * below.display)
        self._first = max(0, min(self._first, len(links) - room + 1 if len(links) > room else 0))

        def layout(panel: Panel) -> TrafficLayout:
            fills = self.setting.colors
            return TrafficLayout(*panel.size, look.palette, look.ascii_only, self._first, fills)

        frames.show(curves(now, links, self._history, layout(frames)))
        below.show(senders(now, self._traffic, layout(below)))
        elapsed = as_seconds(now - self._began)
        self.panel("header").show([title_bar(self._title(links), elapsed, self.size.width, look)])
        hints = [
            Hint("s", f"sort: {self._order}"),
            Hint("up/down" if look.ascii_only else "↑↓", "scroll"),
            Hint("m", "light or dark"),
            Hint("?", "keys"),
            Hint("q", "quit"),
        ]
        self.panel("footer").show([footer(hints, self.size.width, look)])

    def _names_senders(self, links: list[FrameTraffic]) -> bool:
        """Return whether the panel of frames already names all publishers.

        The panel does so if each publisher has one frame, and the names fit.
        """
        has_room = WITH_SCALE * len(links) <= self.size.height - 5
        return has_room and sorted(one.sender for one in links) == sorted(self._traffic.senders)

    def _title(self, links: list[FrameTraffic]) -> str:
        chain = self._chain
        if chain is None:
            return f"{self.title}: {count(len(links), 'frame')}"
        average, most = milliseconds(chain.delay.average), milliseconds(chain.delay.maximum)
        by_way = ", ".join(visible(one) for one in chain.frames)
        words = f"{self.title}: {in_words(chain.target, chain.source)}"
        return f"{words}, net delay {average}, at most {most}, by way of {by_way}"

    def _links(self) -> list[FrameTraffic]:
        links = links_of(self._traffic, self._chain)
        if self._order == "chain" and self._chain is not None:
            places = {frame: place for place, frame in enumerate(self._chain.frames)}
            return sorted(links, key=lambda link: places[link.frame])
        if self._order == "rate":
            now = self.world.clock.now()
            return sorted(links, key=lambda link: -(present_rate(now, link.series) or 0.0))
        if self._order == "delay":
            return sorted(links, key=lambda link: -(link.series.average_delay or 0.0))
        # Static frames have no curve; they are listed last, so that the curves stay together.
        return sorted(links, key=lambda link: (link.is_static, natural_key(link.frame)))

    # Keys

    def action_scroll(self, by: int) -> None:
        """Scroll the frames by some rows."""
        self._first = max(0, self._first + by)
        self.redraw()

    def action_sort(self) -> None:
        """Sort the frames by the next criterion: name, rate, delay, or order in the chain."""
        orders = (*(["chain"] if self._chain is not None else []), *_ORDERS)
        self._order = orders[(orders.index(self._order) + 1) % len(orders)]
        self._first = 0
        self.redraw()

    def action_close(self) -> None:
        """Hide the key help."""
        self.panel("keys").display = False

    def on_mouse_scroll_down(self, event: events.MouseScrollDown) -> None:
        """Scroll the frames down by a row."""
        self.action_scroll(1)

    def on_mouse_scroll_up(self, event: events.MouseScrollUp) -> None:
        """Scroll the frames up by a row."""
        self.action_scroll(-1)
