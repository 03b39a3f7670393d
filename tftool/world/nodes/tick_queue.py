"""What waits for a simulator's next tick."""

import asyncio
from collections import deque
from collections.abc import Callable
from typing import Any, TypeVar

from tftool.base.errors import TftoolError
from tftool.base.stamps import Stamp
from tftool.world.clock import Clock

T = TypeVar("T")

Work = Callable[[Stamp], T]
"""Something to do at a tick, given the tick's stamp."""


MOST_WAITING = 10_000
"""How much work may wait for a tick; a publisher that never pauses lets none come."""


class TickQueue:
    """Work that arrives between two ticks, carried out in order at the next one.

    What arrives in the very instant of a tick waits for the one after it, so that the order
    within an instant does not matter.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._waiting: deque[tuple[Stamp, Work[object]]] = deque()
        self._unanswered: set[asyncio.Future[Any]] = set()

    def put(self, work: Work[object]) -> bool:
        """Have something done at the next tick; False where too much waits already."""
        if len(self._waiting) >= MOST_WAITING:
            return False
        self._waiting.append((self._clock.now(), work))
        return True

    def ask(self, work: Work[T]) -> "asyncio.Future[T]":
        """Have something done at the next tick, and await its outcome.

        The future's exception is a TftoolError where too much waits already.
        """
        answer: asyncio.Future[T] = asyncio.get_running_loop().create_future()

        def carry_out(tick: Stamp) -> None:
            outcome = work(tick)
            if not answer.done():
                answer.set_result(outcome)

        if not self.put(carry_out):
            answer.set_exception(TftoolError(f"{MOST_WAITING} requests wait for the next tick"))
            return answer
        self._unanswered.add(answer)
        answer.add_done_callback(self._unanswered.discard)
        return answer

    def deliver(self, tick: Stamp) -> None:
        """Carry out what arrived before this tick."""
        # Asked of the clock: on the wall clock a late tick takes all that came meanwhile.
        moment = self._clock.now()
        while self._waiting and self._waiting[0][0] < moment:
            self._waiting.popleft()[1](tick)

    def close(self, reason: str) -> None:
        """Drop what waits; those that await an outcome are refused with `reason`."""
        self._waiting.clear()
        for answer in list(self._unanswered):
            if not answer.done():
                answer.set_exception(TftoolError(reason))
