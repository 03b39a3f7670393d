"""One service: ours for other processes, or another process's for our world."""

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any, Final

from tftool.errors import LinkError, MalformedMessage, TftoolError
from tftool.interfaces.classes import Message
from tftool.link import types
from tftool.link.context import LinkContext
from tftool.link.graph import GraphEntity
from tftool.link.seam import WireRequest
from tftool.link.types import ServiceType

PATIENCE: Final = 5.0
"""Seconds that nodes of ours wait for an answer."""

LONGEST: Final = 3600.0
"""Seconds that users' nodes wait, which may have work for hours done by a service."""


class Tasks:
    """Tasks that are held until they end, and cancelled when their owner closes."""

    def __init__(self) -> None:
        self._tasks: set[asyncio.Task[None]] = set()

    def start(self, work: Coroutine[Any, Any, None]) -> None:
        """Let something run beside everything else."""
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def cancel(self) -> None:
        """End whatever still runs."""
        for task in tuple(self._tasks):
            task.cancel()


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

    def __init__(self, link: LinkContext, name: str, node: str, kind: ServiceType) -> None:
        self._link = link
        self._name = name
        self._kind = kind
        node = node or link.main_node
        self._answering = Answering(link, node, name, kind.ros_type, self._serve)

    def close(self) -> None:
        """Answer no request any more."""
        self._answering.close()

    async def _serve(self, payload: bytes) -> bytes:
        request = self._kind.request.decode(payload)
        return self._kind.response.encode(await self._link.world.call(self._name, request))


class ServiceClient:
    """A service of another process, as one of our world: it takes values and messages alike."""

    def __init__(self, link: LinkContext, name: str, server: GraphEntity) -> None:
        self._name = name
        self._type = server.ros_type
        self._asking = Asking(link, name, server.ros_type)
        self._withdraw = link.world.serve(
            name, self._call, server.ros_type, node=server.node, is_remote=True
        )

    def close(self) -> None:
        """Take it out of our world."""
        self._withdraw()
        self._asking.close()

    async def _call(self, request: Any) -> Any:
        kind = types.named_service(self._type)
        if not types.is_same(request, kind.request):
            raise LinkError(
                f"service '{self._name}' is of type {self._type}, which takes no "
                f"{type(request).__name__}"
            )
        payload = kind.request.encode(request)
        answer = kind.response.decode(await self._asking.ask(payload, patience_for(request)))
        return answer if isinstance(request, Message) else types.answer_to(request, answer)


def patience_for(request: Any) -> float:
    """Seconds to wait for the answer to a request or a goal: messages are users' nodes'."""
    return LONGEST if isinstance(request, Message) else PATIENCE
