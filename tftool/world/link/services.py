"""One service: ours for other processes, or another process's for our world."""

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any, Final

from tftool.base.errors import LinkError, MalformedMessage, TftoolError
from tftool.messages.classes import INTERFACES
from tftool.messages.codec import codec
from tftool.world.action_parts import Tasks
from tftool.world.link.graph import GraphEntity
from tftool.world.link.link_context import LinkContext
from tftool.world.link.seam import WireRequest

LONGEST: Final = 3600.0
"""Seconds to wait for an answer: a user's node may have work for hours done by a service."""


class Answering:
    """The serving end of one service, whatever its requests mean."""

    def __init__(
        self,
        link: LinkContext,
        node: str,
        name: str,
        ros_type: str,
        handler: Callable[[bytes], Coroutine[Any, Any, bytes]],
    ) -> None:
        self._link = link
        self._name = name
        self._handler = handler
        self._tasks = Tasks()
        self._stop = link.middleware.server(node, name, ros_type, self._asked)

    def close(self) -> None:
        """Answer no request any more."""
        self._stop()
        self._tasks.cancel()

    def _asked(self, request: WireRequest) -> None:
        self._tasks.start(self._answer(request))

    async def _answer(self, request: WireRequest) -> None:
        try:
            payload = await self._handler(request.payload)
        except MalformedMessage as refusal:
            self._link.refuse(self._name, refusal)
            request.refuse(str(refusal))
        except TftoolError as refusal:
            request.refuse(str(refusal))
        except asyncio.CancelledError:
            request.refuse("the server has left")
            raise
        else:
            request.answer(payload, self._link.now())


class Asking:
    """The asking end of one service, whatever its requests mean."""

    def __init__(self, link: LinkContext, name: str, ros_type: str) -> None:
        self._link = link
        self._name = name
        self._client = link.middleware.client(link.main_node, name, ros_type)

    async def ask(self, payload: bytes, timeout: float) -> bytes:
        """Send a request and wait for the answer.

        Raises:
            LinkError: If there is none.
        """
        try:
            return await self._client.ask(payload, self._link.now(), timeout)
        except LinkError as error:
            raise LinkError(f"service '{self._name}': {error}") from error

    def close(self) -> None:
        """Ask no more."""
        self._client.close()


class ServiceServer:
    """A service of our world, offered to the other processes."""

    def __init__(self, link: LinkContext, node: str, name: str, kind: Any) -> None:
        """Offer a service.

        Args:
            link: The link.
            node: The node that serves it, "" where that is not said.
            name: The service's name.
            kind: The service's class.
        """
        self._link = link
        self._name = name
        self._kind = kind
        node = node or link.main_node
        self._answering = Answering(link, node, name, kind.interface__, self._serve)

    def close(self) -> None:
        """Answer no request any more."""
        self._answering.close()

    async def _serve(self, payload: bytes) -> bytes:
        request = codec(self._kind.Request).decode(payload)
        answer = await self._link.world.call(self._name, request)
        return codec(self._kind.Response).encode(answer)


class ServiceClient:
    """A service of another process, as one of our world."""

    def __init__(self, link: LinkContext, name: str, server: GraphEntity) -> None:
        self._kind = INTERFACES.find(*server.ros_type.split("/"))
        self._asking = Asking(link, name, server.ros_type)
        self._withdraw = link.world.serve(
            name, self._call, self._kind, node=server.node, is_remote=True
        )

    def close(self) -> None:
        """Take it out of our world."""
        self._withdraw()
        self._asking.close()

    async def _call(self, request: Any) -> Any:
        payload = codec(self._kind.Request).encode(request)
        return codec(self._kind.Response).decode(await self._asking.ask(payload, LONGEST))
