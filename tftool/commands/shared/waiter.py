"""Waiting until a pair of frames can be looked up, and saying why on stderr meanwhile."""

import asyncio
import re

from tftool.base.errors import (
    BackwardExtrapolationException,
    TimeoutException,
    TransformException,
)
from tftool.base.escaping import visible_lines
from tftool.base.stamps import LATEST, Duration, Stamp, as_seconds, seconds
from tftool.commands.shared.notices import name_frames, notice
from tftool.commands.shared.pairs import FramePair
from tftool.drawing import echo_view as view
from tftool.world.clock import pace_of
from tftool.world.world import World

EXPLAINED = ("CLOCK_MIXTURE", "NAME", "SINGLE", "SPLIT", "STOPPED")
"""The causes of a wait that a line can tell; a frame that is missing is hinted at otherwise."""

SETTLED = seconds(0.75)
"""How long frames have time to arrive before it is said what is missing."""


class Waiter:
    """Waits until a pair of frames can be looked up in a world."""

    def __init__(
        self,
        world: World,
        pair: FramePair,
        *,
        patience: Duration | None = None,
        tells: bool = True,
        advice: str = "--timeout SECONDS ends the wait.",
    ) -> None:
        """Prepare to wait.

        Args:
            world: Whose frames.
            pair: What is to be looked up.
            patience: How long to wait, in nanoseconds; None for ever.
            tells: Whether to say why it waits; on simulated time there is no need to.
            advice: What ends a wait for a frame that never comes, when patience does not.
        """
        self.world = world
        self.pair = pair
        self.patience = patience
        self.tells = tells
        self.advice = advice
        self._hinted = False
        self._told = ""

    async def wait(self, stale: Stamp = LATEST) -> None:
        """Wait until the question can be answered; whatever comes in may change that.

        Args:
            stale: The newest moment of what is not sent any more: that is no answer.

        Raises:
            TransformException: If the answer does not come in time, or never will.
        """
        clock, buffer = self.world.clock, self.world.buffer
        pace = pace_of(clock)
        news = asyncio.Event()
        stop = buffer.listen(lambda *_: news.set())
        timers = [pace.timer(pace.now() + SETTLED)]
        if self.patience is not None:
            timers.append(pace.timer(pace.now() + self.patience))
        for timer in timers:
            timer.add_done_callback(lambda _: news.set())
        settled, end = timers[0], timers[-1] if self.patience is not None else None
        self._told = ""
        try:
            while True:
                try:
                    self.pair.ask(buffer, clock.now())
                    if not stale or self.pair.newest(buffer) != stale:
                        return
                except TransformException as refusal:
                    if self._is_over(refusal, end):
                        self._hint()
                        raise
                else:
                    if end is not None and end.done():
                        raise TimeoutException(self._nothing_new())
                if self.tells and settled.done():
                    self._tell()
                news.clear()
                await news.wait()
        finally:
            stop()
            for timer in timers:
                timer.cancel()

    def _is_over(self, refusal: TransformException, end: "asyncio.Future[None] | None") -> bool:
        if end is not None and end.done():
            return True
        # One moment that lies before all that is remembered will not come back.
        return self.pair.at != LATEST and isinstance(refusal, BackwardExtrapolationException)

    def _tell(self) -> None:
        """Say why it waits, if that is another reason than the one told last."""
        reason = self.pair.why_not(self.world.buffer, self.world.clock.now())
        reason = reason or self._nothing_new()
        # The times in it change with every sample; the reason does not.
        kind = re.sub(r"-?\d+\.\d{6}", "<time>", reason)
        if kind != self._told:
            self._told = kind
            words = view.in_words(self.pair.target, self.pair.source)
            because = visible_lines(self._because())
            notice(f"Waiting for {words}: {visible_lines(reason.rstrip())}{because}")
            kept = self.world.buffer.cache_time
            if -self.pair.offset >= kept:
                notice(
                    f"--offset goes back {as_seconds(-self.pair.offset):g} s, and the buffer "
                    f"remembers {as_seconds(kept):g} s: --cache-time "
                    f"{as_seconds(-self.pair.offset) + 5:g} makes that enough."
                )
        self._hint()

    def _because(self) -> str:
        """The cause and the cure, where `explain` knows more than that something is not there."""
        # Heavy imports wait until there is something to say.
        from tftool.doctor.explanation import explain

        buffer, now = self.world.buffer, self.world.clock.now()
        if self.pair.fixed_frame is not None or not buffer.frames():
            return ""
        found = explain(buffer, self.pair.target, self.pair.source, self.pair.moment(now))
        if found.available or found.cause.name not in EXPLAINED:
            return ""
        cures = [remedy for remedy in found.remedies if remedy.possible]
        cure = f" Cure: {cures[0].text} {cures[0].command}".rstrip() if cures else ""
        return f" Cause: {found.why[0]}.{cure}"

    def _nothing_new(self) -> str:
        return "nothing new has come since its sender left"

    def _hint(self) -> None:
        """Name the frames there are, when one of those asked for is not among them."""
        if self._hinted:
            return
        asked = (self.pair.target, self.pair.source, self.pair.fixed_frame)
        advice = self.advice if self.patience is None else ""
        self._hinted = name_frames(self.world.buffer.frames(), asked, "so far", advice)
