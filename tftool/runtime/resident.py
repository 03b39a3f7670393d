"""What a world knows of those who live in it, and of whoever runs them.

Nodes know their world; the world knows them only as residents, so that neither
module has to know the other.
"""

from typing import ClassVar


class Resident:
    """Somebody who lives in a world.

    Attributes:
        name: Who it is; no two residents of a world share a name.
        rank: Its place among them: who joined first goes first within a phase.
        is_shown: Whether lists of nodes name it; what only carries others stays out.
    """

    name: str
    rank: int
    is_shown: ClassVar[bool] = True

    async def run(self) -> None:
        """What it does; it ends when this returns."""

    def close(self) -> None:
        """Withdraw everything it offers; called at its end."""


class Supervision:
    """What a world asks of whoever runs its residents."""

    def start(self, resident: Resident) -> None:
        """Start one that joined."""
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
