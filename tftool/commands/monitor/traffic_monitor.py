"""Report on received transforms, and the session that fills it."""

import json
import os
import sys
from collections.abc import Callable, Coroutine
from contextlib import ExitStack
from enum import Enum, auto
from typing import Any

from rich import box
from rich.console import Console, Group, RenderableType
from rich.panel import Panel
from rich.text import Text

from tftool.base.errors import TransformException
from tftool.base.stamps import Duration, Stamp, as_seconds, seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.buffer.traffic import NetDelay, Traffic
from tftool.commands.shared.notices import notice
from tftool.commands.shared.on_screen import screen_lacks
from tftool.commands.shared.pair_wait import PairWait
from tftool.commands.shared.pairs import FramePair
from tftool.commands.shared.terminal import Redrawing
from tftool.drawing import theme
from tftool.drawing import traffic_view as view
from tftool.drawing.echo_view import in_words
from tftool.screens.terminal.panel_text import title_bar
from tftool.screens.terminal.text_style import Look
from tftool.world.clock import Phase, pace_of
from tftool.world.supervisor import beside
from tftool.world.topics import Topic
from tftool.world.world import TransformMessage, World

ASK_EVERY = seconds(0.5)
"""How often the delay of a chain is measured; tf2_monitor's own figure."""


class ReportStyle(Enum):
    """Output format of a report."""

    TABLE = auto()
    LINES = auto()
    TF2 = auto()
    JSON = auto()


class TrafficReport:
    """Received transforms, the delay of one chain, and the report about them."""

    def __init__(self, frames: tuple[str, str] | None, style: ReportStyle) -> None:
        """Make an empty report.

        Args:
            frames: Target and source of the chain to report on; None for all frames.
            style: Form of the report.
        """
        self.frames = frames
        self.style = style
        self.traffic = Traffic()
        self.chain: view.Chain | None = None

    def begin(self, buffer: Buffer, now: Stamp) -> None:
        """Find the chain, and insert static transforms as a late subscriber receives them."""
        if self.frames is not None:
            chain = tuple(buffer.chain(*self.frames)) or self.frames[:1]
            self.chain = view.Chain(*self.frames, chain, NetDelay())
        for info in buffer.snapshot(now).frames:
            if info.is_static and info.parent is not None and info.transform is not None:
                sample = TransformStamped(now, info.parent, info.frame, info.transform)
                self.traffic.receive(now, [sample], info.authority or "", is_static=True)

    def measure(self, buffer: Buffer, now: Stamp) -> None:
        """Record the age of the chain's newest answer; a static chain has none."""
        if self.chain is None:
            return
        try:
            found = buffer.lookup_transform(self.chain.target, self.chain.source)
        except TransformException:
            # tf2_monitor would end here; a missing link comes back, or shows in the rates.
            return
        if found.stamp:
            self.chain.delay.add(as_seconds(now - found.stamp))

    def announce(self, period: Duration, duration: Duration | None) -> None:
        """Print the subject and the interval of reports to stderr."""
        about = "all frames" if self.frames is None else in_words(*self.frames)
        if period == duration:
            notice(f"Gathering data on {about} for {round(as_seconds(duration), 3):g} s ...")
        else:
            notice(f"Gathering data on {about}, a report every {as_seconds(period):g} s ...")

    def table(self, console: Console, now: Stamp, began: Stamp) -> RenderableType:
        """Return the report as a framed table that fits the terminal."""
        ascii_only = console.options.ascii_only
        # A small terminal has no room for a frame; the line below all of it is the cursor's.
        is_framed = console.width >= 60 and console.height >= 12
        shown = view.table(
            now,
            began,
            self.traffic,
            self.chain,
            width=console.width - 4 * is_framed,
            height=console.height - 1 - 3 * is_framed,
            ascii_only=ascii_only,
        )
        if not is_framed:
            return shown
        palette = theme.LIGHT if theme.prefers_light(os.environ) else theme.DARK
        look = Look(palette, ascii_only)
        frame = Panel(
            shown,
            title=Text(" Frames ", theme.ink(palette.text)),
            title_align="left",
            border_style=theme.ink(palette.dim),
            box=box.ASCII if ascii_only else box.ROUNDED,
        )
        return Group(
            title_bar("tftool monitor", as_seconds(now - began), console.width, look), frame
        )

    def write(self, now: Stamp) -> None:
        """Write the report to stdout, as lines or JSON."""
        if self.style is ReportStyle.JSON:
            text = json.dumps(view.as_object(now, self.traffic, self.chain), allow_nan=False) + "\n"
        else:
            text = view.lines(self.traffic, self.chain, as_tf2=self.style is ReportStyle.TF2)
        sys.stdout.write(text)
        sys.stdout.flush()


async def watch_session(
    world: World, report: TrafficReport, *, period: Duration, lasting: Duration | None
) -> None:
    """Listen to a world and report, once a period.

    The time begins once the frames are connected; the last report is at its end.

    Args:
        world: World to listen to.
        report: The report to fill and to write.
        period: Nanoseconds between two reports.
        lasting: Duration, nanoseconds; None for ever.

    Raises:
        TransformException: If the frames are not connected in as much time, or never will be.
    """
    clock, pace = world.clock, pace_of(world.clock)
    if report.frames is not None:
        advice = "--for SECONDS ends the wait."
        wait = PairWait(world, FramePair(*report.frames), patience=lasting, advice=advice)
        await wait.wait()
    began = clock.now()
    end = None if lasting is None else pace.now() + lasting
    # A node that holds up the loop would keep this from ever being over.
    pace.limit(end)

    def subscribe(topic: Topic[TransformMessage], is_static: bool) -> Callable[[], None]:
        def receive(message: TransformMessage) -> None:
            report.traffic.receive(
                clock.now(), message.transforms, message.authority, is_static=is_static
            )

        return topic.subscribe(receive, "monitor")

    async def measure() -> None:
        due = pace.now()
        while report.chain is not None:
            due = max(due + ASK_EVERY, pace.now())
            await pace.sleep_until(due, Phase.WATCH)
            report.measure(world.buffer, clock.now())

    async def repeat(write: Callable[[], None]) -> None:
        due = pace.now()
        while end is None or due < end:
            due = due + period if end is None else min(due + period, end)
            await pace.sleep_until(due, Phase.WATCH)
            write()

    with ExitStack() as stack:
        for topic, is_static in ((world.tf, False), (world.tf_static, True)):
            stack.callback(subscribe(topic, is_static))
        report.begin(world.buffer, began)
        if report.style is ReportStyle.TABLE and not screen_lacks():
            stack.callback(lambda: Console().print(report.table(Console(), clock.now(), began)))
            await _shown(world, report, beside(repeat(lambda: None), measure()))
            return
        report.announce(period, lasting)
        if report.style is ReportStyle.TABLE:
            redrawing = stack.enter_context(Redrawing(clock))
            console = redrawing.console
            writing = repeat(lambda: redrawing.show(report.table(console, clock.now(), began)))
        else:
            writing = repeat(lambda: report.write(clock.now()))
        await beside(writing, measure())


async def _shown(world: World, report: TrafficReport, life: Coroutine[Any, Any, None]) -> None:
    """Show the report on a full screen until q is pressed or `life` is over."""
    from tftool.screens.terminal.screen_options import Setting, setting_from
    from tftool.screens.terminal.traffic_app import TrafficWatch
    from tftool.screens.terminal.world_app import show

    encoding = sys.stdout.encoding or "ascii"
    setting = setting_from(os.environ, encoding, Setting(title="tftool monitor"))
    await show(TrafficWatch(world, report.traffic, report.chain, setting), life)
