"""What waits for a simulator's next tick."""

import asyncio
from collections import deque
from collections.abc import Callable
from typing import Any, TypeVar

from tftool.errors import TftoolError
from tftool.runtime.clock import Clock
from tftool.stamps import Stamp

T = TypeVar("T")

Work = Callable[[Stamp], T]
"""Something to do at a tick, given the tick's stamp."""


class Inbox:
    """Work that arrives between two ticks, carried out in order at the next one.

    What arrives in the very instant of a tick waits for the one after it, so that it
    does not matter who was first within an instant.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._waiting: deque[tuple[Stamp, Work[object]]] = deque()
        self._unanswered: set[asyncio.Future[Any]] = set()

    def put(self, work: Work[object]) -> None:
        """Have something done at the next tick."""
        self._waiting.append((self._clock.now(), work))

    def ask(self, work: Work[T]) -> "asyncio.Future[T]":
        """Have something done at the next tick, and await its outcome."""
        answer: asyncio.Future[T] = asyncio.get_running_loop().create_future()

        def carry_out(tick: Stamp) -> None:
            outcome = work(tick)
            if not answer.done():
                answer.set_result(outcome)

        self._unanswered.add(answer)
        answer.add_done_callback(self._unanswered.discard)
        self.put(carry_out)
        return answer

    def deliver(self, tick: Stamp) -> None:
        """Carry out what arrived before this tick."""
        # Asked of the clock: on the wall clock a late tick takes all that came meanwhile.
        moment = self._clock.now()
        while self._waiting and self._waiting[0][0] < moment:
            self._waiting.popleft()[1](tick)

    def close(self, reason: str) -> None:
        """Drop what waits; whoever awaits an outcome is refused with `reason`."""
        self._waiting.clear()
        for answer in list(self._unanswered):
            if not answer.done():
                answer.set_exception(TftoolError(reason))
