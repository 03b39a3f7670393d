"""How the tutorial's nodes get their turtle: ask, see that it is there, then begin."""

import asyncio
from typing import Any

from tftool.errors import TftoolError
from tftool.messages import Spawn
from tftool.runtime.node import Node


class Spawning:
    """The tutorial's start-up machine, stepped by a node's timer.

    One step asks for the turtle, a later one sees the answer, and only the one
    after that begins: with a period of one second, three seconds after the start.
    """

    def __init__(self, node: Node, request: Spawn) -> None:
        self._node = node
        self._request = request
        self._call: asyncio.Task[Any] | None = None
        self._confirmed = False

    def step(self) -> bool:
        """Do what is next; True once the turtle was there before this step."""
        if self._confirmed:
            return True
        if self._call is None:
            if self._node.world.has_service("spawn"):
                self._call = asyncio.get_running_loop().create_task(
                    self._node.call("spawn", self._request)
                )
            else:
                self._node.info("Service is not ready")
        elif not self._call.done():
            self._node.info("Spawn is not finished")
        else:
            self._take_answer(self._call)
        return False

    def cancel(self) -> None:
        """Give up waiting for an answer."""
        if self._call is not None:
            self._call.cancel()

    def _take_answer(self, call: "asyncio.Task[Any]") -> None:
        try:
            # Any answer counts, as in the tutorial: an empty name says that a turtle of
            # that name is there already, and that one will do.
            name = call.result().name
        except TftoolError as refusal:
            self._node.warn(f"Could not spawn '{self._request.name}', asking again: {refusal}")
            self._call = None
        else:
            if name:
                self._node.info(f"Successfully spawned {name}")
            else:
                self._node.warn(f"{self._request.name} is there already, and will do")
            self._confirmed = True
