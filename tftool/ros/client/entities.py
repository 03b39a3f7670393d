"""What a node has that can become ready.

Each thing keeps what arrived until an executor takes it. `ready` and `take` run on
the loop's thread; what `take` returns runs on the fiber that spins.
"""

import asyncio
from collections import deque
from collections.abc import Callable, Coroutine
from typing import Any

from tftool.ros.client.member import Member

Work = Callable[[], Any]
"""What is left to do on the fiber once an entity was taken from; may return a coroutine."""


class Entity:
    """Something of a node that can become ready."""

    passes_busy_group = False

    def __init__(self, member: Member, group: Any) -> None:
        self.member = member
        self.callback_group = group

    def ready(self) -> bool:
        """Whether there is something to take."""
        return False

    def take(self) -> Work:
        """What to do next."""
        raise NotImplementedError

    def withdraw(self) -> None:
        """Stop listening (on the loop's thread)."""

    def destroy(self) -> None:
        """Stop listening, and leave the node."""
        self.member.forget(self)


class Inbox(Entity):
    """Something whose work arrives piece by piece, and is done in that order."""

    def __init__(self, member: Member, group: Any) -> None:
        super().__init__(member, group)
        self._arrived: deque[Work] = deque()

    def put(self, work: Work) -> None:
        """Take a piece in (on the loop's thread)."""
        self._arrived.append(work)
        self.member.wake()

    def ready(self) -> bool:
        """Whether a piece waits."""
        return bool(self._arrived)

    def take(self) -> Work:
        """The piece that arrived first."""
        return self._arrived.popleft()


class Asker(Inbox):
    """Something that asks others in the world, and gets their answers as work."""

    # An answer completes a future and runs nobody's callback by itself, so whoever
    # waits for it inside a callback gets it.
    passes_busy_group = True

    def __init__(self, member: Member, group: Any) -> None:
        super().__init__(member, group)
        self._asking: set[asyncio.Task[None]] = set()

    def ask(self, question: Coroutine[Any, Any, None]) -> None:
        """Have a question asked on the loop's thread; it ends with this entity."""

        def start() -> None:
            task = asyncio.get_running_loop().create_task(question)
            self._asking.add(task)
            task.add_done_callback(self._asking.discard)

        self.member.program.ask(start)

    def withdraw(self) -> None:
        """Wait for no answer any more."""
        super().withdraw()
        for task in list(self._asking):
            task.cancel()


class GuardCondition(Entity):
    """Calls back when triggered."""

    def __init__(self, member: Member, callback: Callable[[], Any], group: Any) -> None:
        super().__init__(member, group)
        self.callback = callback
        self._triggered = False

    def trigger(self) -> None:
        """Have the callback called soon."""

        def set_off() -> None:
            self._triggered = True
            self.member.wake()

        self.member.program.ask(set_off)

    def ready(self) -> bool:
        """Whether it was triggered."""
        return self._triggered

    def take(self) -> Work:
        """The callback."""
        self._triggered = False
        return self.callback
