"""How the tutorial's nodes get their turtle: ask, see that it is there, then begin."""

from typing import Any

from tftool.base.errors import TftoolError
from tftool.messages.classes import build
from tftool.messages.turtle_messages import Spawn
from tftool.world.node import Node


class Spawning:
    """The tutorial's start-up machine, stepped by a node's timer.

    One step asks for the turtle, a later one sees the answer, and only the one
    after that begins: with a period of one second, three seconds after the start.
    """

    def __init__(self, node: Node, x: float, y: float, theta: float, name: str) -> None:
        self._node = node
        self._request = build(Spawn.Request, x, y, theta, name)
        self._is_asked = False
        self._answer: Any | TftoolError | None = None
        self._confirmed = False

    def step(self) -> bool:
        """Do what is next; True once the turtle was there before this step."""
        if self._confirmed:
            return True
        if not self._is_asked:
            if self._node.world.has_service("spawn"):
                self._is_asked = True
                self._node.start_soon(self._ask())
            else:
                self._node.info("Service is not ready")
        elif self._answer is None:
            self._node.info("Spawn is not finished")
        else:
            self._take(self._answer)
        return False

    async def _ask(self) -> None:
        try:
            self._answer = await self._node.call("spawn", self._request)
        except TftoolError as refusal:
            self._answer = refusal

    def _take(self, answer: Any | TftoolError) -> None:
        if isinstance(answer, TftoolError):
            self._node.warn(f"Could not spawn '{self._request.name}', asking again: {answer}")
            self._is_asked, self._answer = False, None
            return
        # Any answer counts, as in the tutorial: an empty name says that a turtle of
        # that name is there already, and that one will do.
        if answer.name:
            self._node.info(f"Successfully spawned {answer.name}")
        else:
            self._node.warn(f"{self._request.name} is there already, and will do")
        self._confirmed = True
