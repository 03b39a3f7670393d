"""What a world knows of its nodes, and of the supervisor that runs them.

Nodes know their world; the world knows them only as residents, so that neither
module has to know the other.
"""

import asyncio
from collections.abc import Coroutine
from typing import Any, ClassVar, TypeVar

T = TypeVar("T")


class Resident:
    """Something that runs in a world under a name: a node, or a program that carries nodes.

    Attributes:
        name: Its name; no two residents of a world share one.
        rank: Its place among them: within a phase the one that joined first goes first.
        is_shown: Whether lists of nodes name it; a program that only carries nodes stays out.
    """

    name: str
    rank: int
    is_shown: ClassVar[bool] = True

    async def run(self) -> None:
        """What it does; it ends when this returns."""

    def close(self) -> None:
        """Withdraw everything it offers; called at its end."""


class Supervision:
    """What a world asks of the supervisor that runs its residents."""

    def start(self, resident: Resident) -> None:
        """Start one that joined."""
        raise NotImplementedError

    def start_soon(
        self, resident: Resident, work: Coroutine[Any, Any, T]
    ) -> "asyncio.Task[T | None]":
        """Run something beside a resident's `run`, as a part of it."""
        raise NotImplementedError

    def end(self, resident: Resident) -> None:
        """Stop one that leaves."""
        raise NotImplementedError

    def stop(self) -> None:
        """End the run."""
        raise NotImplementedError

    def fail(self, resident: Resident, error: BaseException) -> None:
        """End the run because one raised."""
        raise NotImplementedError

    def end_by(self, error: Exception) -> None:
        """End the run by an error that is of no resident."""
        raise NotImplementedError
