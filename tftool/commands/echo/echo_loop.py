"""Repeated lookups of one transform in a session, printed as tf2_echo prints them."""

import asyncio
import contextlib
from collections.abc import Callable

from rich.text import Text

from tftool.base.errors import TransformException
from tftool.base.stamps import Duration, Stamp, seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.commands.echo import EchoOptions
from tftool.commands.echo.command import Printer
from tftool.commands.shared.connection import Connection
from tftool.commands.shared.hosting import open_session
from tftool.commands.shared.notices import notice, rivalries
from tftool.commands.shared.pair_wait import PairWait
from tftool.commands.shared.pairs import IDENTITY, FramePair
from tftool.commands.shared.terminal import Redrawing, can_redraw
from tftool.drawing import echo_view as view
from tftool.world.clock import Phase, pace_of
from tftool.world.link.session_world import twins
from tftool.world.world import World


def print_live(
    connection: Connection, options: EchoOptions, pair: FramePair, printer: Printer
) -> None:
    """Look up a transform of a session repeatedly, and print or redraw each result."""
    session = open_session(connection, options.place, cache_time=options.cache_time)
    count = 1 if options.once else options.count
    redraws = count is None and not printer.for_programs and can_redraw()
    if not redraws:
        notice(f"{view.in_words(pair.target, pair.source)}:")
    if pair.target == pair.source:
        notice(IDENTITY)
    with contextlib.ExitStack() as stack:
        shown: Printer | LivePrinter = printer
        if redraws:
            redrawing = stack.enter_context(Redrawing(session.world.clock))
            shown = LivePrinter(redrawing, pair, printer.precision, printer.with_distance)
        echoing = Echo(
            session.world,
            pair,
            shown,
            period=seconds(1.0 / (options.rate or 1.0)),
            count=count,
            patience=options.timeout,
            departures=session.departures,
        )
        session.run(echoing.run())


class LivePrinter:
    """Printer that draws each transform in place of the previous transform on the terminal."""

    def __init__(
        self, redrawing: Redrawing, pair: FramePair, precision: int, with_distance: bool
    ) -> None:
        """Create a printer for transforms of `pair`."""
        self.redrawing = redrawing
        self.pair = pair
        self.precision = precision
        self.with_distance = with_distance
        self._shown: TransformStamped | None = None

    def found(self, now: Stamp, transform: TransformStamped) -> None:
        """Show a transform and its age."""
        self._shown = transform
        age = now - transform.stamp if transform.stamp else None
        heading = view.live_heading(self.pair.target, self.pair.source, age)
        answer = view.painted(transform, precision=self.precision, with_distance=self.with_distance)
        answer.rstrip()
        self.redrawing.show(heading.append_text(answer))

    def aged(self, now: Stamp) -> None:
        """Redraw the last transform with the current age."""
        if self._shown is not None:
            self.found(now, self._shown)

    def failed(self, now: Stamp, refusal: TransformException, buffer: Buffer) -> None:
        """Show the error of a failed lookup, shortened to the terminal's height."""
        self._shown = None
        words = view.in_words(self.pair.target, self.pair.source)
        told = view.failure(now, refusal, buffer.all_frames_as_string()).rstrip()
        text = Text().append(f"{words}\n", style="bold").append(told, style="yellow")
        self.redrawing.show(text)


class Echo:
    """Loop that looks up one transform periodically until enough transforms are printed."""

    def __init__(
        self,
        world: World,
        pair: FramePair,
        printer: Printer | LivePrinter,
        *,
        period: Duration,
        count: int | None = None,
        patience: Duration | None = None,
        departures: Callable[[], int] = lambda: 0,
    ) -> None:
        """Prepare the lookups.

        Args:
            world: World whose buffer has the frames.
            pair: Frames to look up.
            printer: Printer of the results.
            period: Nanoseconds between two lookups.
            count: Number of transforms to print; None for no end.
            patience: Longest wait for the first transform, nanoseconds; None for no limit.
            departures: Function that returns how many publishers of transforms have disconnected so
                far. After each disconnection, `Echo` waits for new data.
        """
        self.world = world
        self.pair = pair
        self.printer = printer
        self.period = period
        self.count = count
        self.departures = departures
        self.waiter = PairWait(world, pair, patience=patience)

    async def run(self) -> None:
        """Look up and print transforms until `count` transforms are printed.

        Raises:
            TransformException: If the first transform is not available within `patience`, or the
                buffer shows that waiting cannot help.
        """
        clock, pace = self.world.clock, pace_of(self.world.clock)
        await self.waiter.wait()
        left = self.departures()
        due = pace.now()
        printed = 0
        said: set[str] = set()
        while True:
            if self.departures() != left:
                left = self.departures()
                await self._renewed()
                due = pace.now()
            now = clock.now()
            try:
                self.printer.found(now, self.pair.ask(self.world.buffer, now))
                printed += 1
                for sentence in self._oddities():
                    if sentence not in said:
                        said.add(sentence)
                        notice(sentence)
            except TransformException as refusal:
                self.printer.failed(now, refusal, self.world.buffer)
            if printed == self.count:
                return
            due += self.period
            await pace.sleep_until(due, Phase.WATCH)
            # If late by more than a period, missed lookups are skipped.
            due = max(due, pace.now() - self.period)

    async def _renewed(self) -> None:
        """Wait for new data after a publisher disconnected; meanwhile show the old transform's age.

        Raises:
            TransformException: If no new data arrives in time, or waiting cannot help.
        """
        clock, pace = self.world.clock, pace_of(self.world.clock)
        newest = self.pair.newest(self.world.buffer)
        waiting = asyncio.ensure_future(self.waiter.wait(newest))
        try:
            # If the clock jumped back, the buffer was cleared, and new data has an older time.
            while not waiting.done() and self.pair.newest(self.world.buffer) in (0, newest):
                timer = pace.timer(pace.now() + self.period)
                try:
                    await asyncio.wait((waiting, timer), return_when=asyncio.FIRST_COMPLETED)
                finally:
                    timer.cancel()
                if not waiting.done():
                    self.printer.aged(clock.now())
            if waiting.done():
                await waiting
        finally:
            waiting.cancel()

    def _oddities(self) -> list[str]:
        buffer = self.world.buffer
        try:
            frames = buffer.chain(self.pair.target, self.pair.source)
        except TransformException:
            return []
        return [*rivalries(buffer, frames), *twins(self.world)]
