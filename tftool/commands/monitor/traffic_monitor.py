"""Everything that arrives in one world, reported once a period."""

import json
import sys
from collections.abc import Callable
from enum import Enum, auto

from tftool.base.errors import TransformException
from tftool.base.stamps import Duration, as_seconds, seconds
from tftool.buffer.sample import TransformStamped
from tftool.buffer.traffic import NetDelay, Traffic
from tftool.commands.shared.notices import notice
from tftool.commands.shared.pair_wait import PairWait
from tftool.commands.shared.pairs import FramePair
from tftool.commands.shared.redraw import Redrawing
from tftool.drawing import traffic_view as view
from tftool.drawing.echo_view import in_words
from tftool.world.clock import Clock, Phase, pace_of
from tftool.world.supervisor import beside
from tftool.world.world import TransformMessage, World

ASK_EVERY = seconds(0.5)
"""How often the delay of a chain is measured; tf2_monitor's own figure."""


class ReportStyle(Enum):
    """How a report is written."""

    TABLE = auto()
    LINES = auto()
    TF2 = auto()
    JSON = auto()


class Monitor:
    """Everything that arrives in one world, reported once a period."""

    def __init__(
        self,
        world: World,
        frames: tuple[str, str] | None,
        style: ReportStyle,
        *,
        period: Duration,
        tells: bool = True,
    ) -> None:
        """Prepare to listen.

        Args:
            world: Where to listen.
            frames: Target and source of the chain to report on; None for all frames.
            style: How to report.
            period: Nanoseconds between two reports.
            tells: Whether to say what it waits for.
        """
        self.world = world
        self.frames = frames
        self.style = style
        self.period = period
        self.tells = tells
        self.traffic = Traffic()
        self.chain: view.Chain | None = None

    async def run(self, duration: Duration | None) -> None:
        """Listen and report, for `duration` nanoseconds or for ever.

        The last report is at the end of that time, which begins once the frames are connected.

        Raises:
            TransformException: If the frames are not connected in as much time, or never will be.
        """
        clock, pace = self.world.clock, pace_of(self.world.clock)
        if self.frames is not None:
            await self._find_chain(*self.frames, patience=duration)
        began = clock.now()
        end = None if duration is None else pace.now() + duration
        # A node that holds up the loop would keep this from ever being over.
        pace.limit(end)
        stops = [
            self.world.tf.subscribe(lambda message: self._hear(message, False), "monitor"),
            self.world.tf_static.subscribe(lambda message: self._hear(message, True), "monitor"),
        ]
        self._hear_statics()
        self._announce(duration)
        try:
            if self.style is ReportStyle.TABLE:
                with Redrawing(clock) as redrawing:

                    def show() -> None:
                        console = redrawing.console
                        redrawing.show(
                            view.table(
                                clock.now(),
                                began,
                                self.traffic,
                                self.chain,
                                width=console.width,
                                # The line below it is the cursor's.
                                height=console.height - 1,
                                ascii_only=console.options.ascii_only,
                            )
                        )

                    await beside(self._report_until(pace, end, show), self._ask(pace))
            else:
                await beside(self._report_until(pace, end, self._write), self._ask(pace))
        finally:
            for stop in stops:
                stop()

    async def _report_until(
        self, clock: Clock, end: int | None, report: Callable[[], None]
    ) -> None:

        due = clock.now()
        while end is None or due < end:
            due += self.period
            if end is not None:
                due = min(due, end)
            await clock.sleep_until(due, Phase.WATCH)
            report()

    async def _find_chain(self, target: str, source: str, patience: Duration | None) -> None:
        """Wait until the two frames are connected, as tf2_monitor does."""
        advice = "--for SECONDS ends the wait."
        pair = FramePair(target, source)
        waiter = PairWait(self.world, pair, patience=patience, tells=self.tells, advice=advice)
        await waiter.wait()
        frames = tuple(self.world.buffer.chain(target, source)) or (target,)

        self.chain = view.Chain(target, source, frames, NetDelay())

    async def _ask(self, pace: Clock) -> None:
        """Measure how old the latest answer is; a static one has no age."""
        clock = self.world.clock
        due = pace.now()
        while self.chain is not None:
            due = max(due + ASK_EVERY, pace.now())
            await pace.sleep_until(due, Phase.WATCH)
            try:
                found = self.world.buffer.lookup_transform(self.chain.target, self.chain.source)
            except TransformException:
                # tf2_monitor would end here; what is missing comes back, or is seen in the rates.
                continue
            if found.stamp:
                self.chain.delay.add(as_seconds(clock.now() - found.stamp))

    def _hear(self, message: TransformMessage, is_static: bool) -> None:
        self.traffic.receive(
            self.world.clock.now(), message.transforms, message.authority, is_static=is_static
        )

    def _hear_statics(self) -> None:
        """Take in what was published before, as a late subscriber gets it."""
        now = self.world.clock.now()
        for info in self.world.buffer.snapshot(now).frames:
            if info.is_static and info.parent is not None and info.transform is not None:
                sample = TransformStamped(now, info.parent, info.frame, info.transform)
                self.traffic.receive(now, [sample], info.authority or "", is_static=True)

    def _announce(self, duration: Duration | None) -> None:

        about = "all frames" if self.frames is None else in_words(*self.frames)
        if self.period == duration:
            notice(f"Gathering data on {about} for {round(as_seconds(duration), 3):g} s ...")
        else:
            notice(f"Gathering data on {about}, a report every {as_seconds(self.period):g} s ...")

    def _write(self) -> None:

        if self.style is ReportStyle.JSON:
            now = self.world.clock.now()
            text = json.dumps(view.as_object(now, self.traffic, self.chain), allow_nan=False) + "\n"
        else:
            text = view.lines(self.traffic, self.chain, as_tf2=self.style is ReportStyle.TF2)
        sys.stdout.write(text)
        sys.stdout.flush()
