"""One pair of frames, asked again and again, and its answers on stdout as tf2_echo prints them."""

import asyncio
import json
import sys
from collections.abc import Callable
from dataclasses import dataclass

from tftool.base.errors import TransformException
from tftool.base.stamps import Duration, Stamp
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.commands.shared.notices import notice
from tftool.commands.shared.redraw import Redrawing
from tftool.commands.shared.rival_publishers import rivalries
from tftool.commands.shared.waiter import FramePair, Waiter
from tftool.drawing import echo_view as view
from tftool.world.clock import Phase, pace_of
from tftool.world.link.session_world import twins
from tftool.world.world import World


@dataclass(frozen=True, slots=True)
class Printer:
    """How answers are written to stdout."""

    precision: int = 3
    with_distance: bool = False
    for_programs: bool = False

    def found(self, now: Stamp, found: TransformStamped) -> None:
        """Print an answer."""
        if self.for_programs:
            self._line(view.as_object(found, with_distance=self.with_distance))
        elif sys.stdout.isatty():
            from tftool.commands.shared.printer import write

            write(
                view.painted(found, precision=self.precision, with_distance=self.with_distance),
                end="",
            )
            sys.stdout.flush()
        else:
            self._write(
                view.block(found, precision=self.precision, with_distance=self.with_distance)
            )

    def failed(self, now: Stamp, refusal: TransformException, buffer: Buffer) -> None:
        """Print a refusal."""
        if self.for_programs:
            self._line(view.failure_as_object(now, refusal))
        else:
            self._write(view.failure(now, refusal, buffer.all_frames_as_string()))

    def aged(self, now: Stamp) -> None:
        """Leave what is printed as it is."""

    def _line(self, what: object) -> None:
        self._write(json.dumps(what, allow_nan=False) + "\n")

    def _write(self, text: str) -> None:
        sys.stdout.write(text)
        sys.stdout.flush()


class LivePrinter:
    """How answers are shown where each takes the place of the one before."""

    def __init__(
        self, redrawing: Redrawing, pair: FramePair, precision: int, with_distance: bool
    ) -> None:
        """Prepare to show answers about `pair`."""
        self.redrawing = redrawing
        self.pair = pair
        self.precision = precision
        self.with_distance = with_distance
        self._shown: TransformStamped | None = None

    def found(self, now: Stamp, found: TransformStamped) -> None:
        """Show an answer and how old it is."""
        self._shown = found
        age = now - found.stamp if found.stamp else None
        heading = view.live_heading(self.pair.target, self.pair.source, age)
        answer = view.painted(found, precision=self.precision, with_distance=self.with_distance)
        answer.rstrip()
        self.redrawing.show(heading.append_text(answer))

    def aged(self, now: Stamp) -> None:
        """Show the answer that stands there again, with the age it has by now."""
        if self._shown is not None:
            self.found(now, self._shown)

    def failed(self, now: Stamp, refusal: TransformException, buffer: Buffer) -> None:
        """Show a refusal, as much of it as there is room for."""
        self._shown = None
        from rich.text import Text

        words = view.in_words(self.pair.target, self.pair.source)
        told = view.failure(now, refusal, buffer.all_frames_as_string()).rstrip()
        text = Text().append(f"{words}\n", style="bold").append(told, style="yellow")
        self.redrawing.show(text)


class Echo:
    """One pair of frames, looked up in one world until enough answers are printed."""

    def __init__(
        self,
        world: World,
        pair: FramePair,
        printer: Printer | LivePrinter,
        *,
        period: Duration,
        count: int | None = None,
        patience: Duration | None = None,
        tells: bool = True,
        departures: Callable[[], int] = lambda: 0,
    ) -> None:
        """Prepare to ask.

        Args:
            world: Whose frames.
            pair: What to look up.
            printer: How to print it.
            period: Nanoseconds between two answers.
            count: How many answers to print; None for no end.
            patience: How long to wait for the first, in nanoseconds; None for ever.
            tells: Whether to say why it waits; on simulated time there is no need to.
            departures: Gives how many processes that sent transforms have left; after each
                further departure the wait starts again, for something new.
        """
        self.world = world
        self.pair = pair
        self.printer = printer
        self.period = period
        self.count = count
        self.departures = departures
        self.waiter = Waiter(world, pair, patience=patience, tells=tells)

    async def run(self) -> None:
        """Print answers until there are enough.

        Raises:
            TransformException: If the first does not come in time, or never will.
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
            # Late by more than a period: what was missed is not made up for.
            due = max(due, pace.now() - self.period)

    async def _renewed(self) -> None:
        """Wait for something new after a sender left; what is shown meanwhile grows old.

        Raises:
            TransformException: If it does not come in time, or never will.
        """
        clock, pace = self.world.clock, pace_of(self.world.clock)
        waiting = asyncio.ensure_future(self.waiter.wait(stale=self.pair.newest(self.world.buffer)))
        try:
            while not waiting.done():
                timer = pace.timer(pace.now() + self.period)
                try:
                    await asyncio.wait((waiting, timer), return_when=asyncio.FIRST_COMPLETED)
                finally:
                    timer.cancel()
                if not waiting.done():
                    self.printer.aged(clock.now())
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
