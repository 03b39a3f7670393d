"""Wait until a transform can be looked up; the reason for the wait is printed to stderr."""

import asyncio
import re

from tftool.base.errors import (
    BackwardExtrapolationException,
    ExtrapolationException,
    TimeoutException,
    TransformException,
)
from tftool.base.plain_text import visible_lines
from tftool.base.stamps import LATEST, Duration, Stamp, as_seconds, seconds
from tftool.buffer.buffer import Buffer
from tftool.commands.shared.notices import name_frames, notice
from tftool.commands.shared.pairs import FramePair
from tftool.drawing import echo_view as view
from tftool.world.clock import Clock, Phase, pace_of
from tftool.world.supervisor import beside
from tftool.world.world import World

EXPLAINED = ("CLOCK_MIXTURE", "NAME", "SINGLE", "SPLIT", "STOPPED")
"""Causes of a wait whose explanation fits in a line; a missing frame has a separate hint."""

SETTLED = seconds(0.75)
"""Nanoseconds before the reason for the wait is first printed, and between two checks of it."""

NOTHING_NEW = "no new transform has arrived since the publisher left"


class PairWait:
    """Waiter that returns when one transform can be looked up.

    The lookup is repeated whenever a transform is inserted into the buffer.
    """

    def __init__(
        self,
        world: World,
        pair: FramePair,
        *,
        patience: Duration | None = None,
        advice: str = "--timeout SECONDS ends the wait.",
    ) -> None:
        """Prepare the wait.

        Args:
            world: World whose buffer has the frames.
            pair: Frames and time to look up.
            patience: Longest wait, nanoseconds; None for no limit.
            advice: Advice to print if a frame does not appear in time.
        """
        self.world = world
        self.pair = pair
        self.patience = patience
        self.advice = advice
        self._hinted = False

    async def wait(self, newer_than: Stamp = LATEST) -> None:
        """Wait until the transform can be looked up.

        Args:
            newer_than: Newest stamp of a disconnected publisher; only a later stamp ends the wait.

        Raises:
            TransformException: If the transform is not available in time, or waiting cannot help.
        """
        pace = pace_of(self.world.clock)
        answered = beside(self._answered(newer_than), self._tell_reasons(pace))
        task = asyncio.ensure_future(answered)
        try:
            if self.patience is None:
                await task
                return
            timer = pace.timer(pace.now() + self.patience)
            try:
                await asyncio.wait((task, timer), return_when=asyncio.FIRST_COMPLETED)
            finally:
                timer.cancel()
            if not task.done():
                self.pair.ask(self.world.buffer, self.world.clock.now())
                raise TimeoutException(NOTHING_NEW)
            await task
        except TransformException:
            self._hint()
            raise
        finally:
            task.cancel()

    async def _answered(self, newer_than: Stamp) -> None:
        pair, clock = self.pair, self.world.clock
        if pair.target == pair.source:
            await _existing(self.world.buffer, pair.target)
        if newer_than:
            target = pair.fixed_frame or pair.target
            await self.world.wait_for_transform(target, pair.source, newer_than + 1)
            return
        while True:
            await self._available(LATEST)
            now = clock.now()
            try:
                pair.ask(self.world.buffer, now)
            except ExtrapolationException as refusal:
                if refusal.requested > refusal.available:
                    await self._available(pair.moment(now))
                elif pair.offset:
                    # The requested time follows the clock: wait until the buffer has data for it.
                    await clock.sleep_until(refusal.available - pair.offset, Phase.WATCH)
                elif isinstance(refusal, BackwardExtrapolationException):
                    raise
                else:
                    # With a single sample, tf2 does not say that the requested time is earlier.
                    await self._available(refusal.available + 1)
            else:
                return

    async def _available(self, time: Stamp) -> None:
        """Wait until the transform can be looked up at `time`."""
        pair = self.pair
        if pair.fixed_frame is None:
            await self.world.wait_for_transform(pair.target, pair.source, time)
        else:
            await self.world.wait_for_transform_full(
                pair.target, LATEST, pair.source, time, pair.fixed_frame
            )

    async def _tell_reasons(self, pace: Clock) -> None:
        """Print why the lookup fails, and again whenever the reason changes."""
        told = ""
        while True:
            await pace.sleep(SETTLED, Phase.WATCH)
            buffer, now = self.world.buffer, self.world.clock.now()
            reason = self.pair.why_not(buffer, now) or NOTHING_NEW
            # The times in the text change with every sample, but the reason is the same.
            kind = re.sub(r"-?\d+\.\d{6}", "<time>", reason)
            if kind != told:
                told = kind
                words = view.in_words(self.pair.target, self.pair.source)
                because = visible_lines(self._because())
                notice(f"Waiting for {words}: {visible_lines(reason.rstrip())}{because}")
                self._tell_short_cache(buffer.cache_time)
            self._hint()

    def _tell_short_cache(self, cache_time: Duration) -> None:
        back = -self.pair.offset
        if back >= cache_time:
            notice(
                f"--offset goes back {as_seconds(back):g} s, but the buffer only keeps "
                f"{as_seconds(cache_time):g} s: --cache-time {as_seconds(back) + 5:g} is enough."
            )

    def _because(self) -> str:
        """Return the cause of the wait and a suggested fix as text; "" without a known cause."""
        # Imported here because it is slow, and needed only for an explanation.
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

    def _hint(self) -> None:
        """Print the existing frames, at most once, if a requested frame does not exist."""
        if self._hinted:
            return
        asked = (self.pair.target, self.pair.source, self.pair.fixed_frame)
        advice = self.advice if self.patience is None else ""
        self._hinted = name_frames(self.world.buffer.frames(), asked, "so far", advice)


async def _existing(buffer: Buffer, frame: str) -> None:
    """Wait until a frame exists.

    A lookup of a frame in itself does not wait: tf2 returns the identity even for unknown frames.
    """
    news = asyncio.Event()
    stop = buffer.listen(lambda *_: news.set())
    try:
        while not buffer.frame_exists(frame):
            news.clear()
            await news.wait()
    finally:
        stop()
