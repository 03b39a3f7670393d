"""One service: ours for everybody, or somebody else's for our world."""

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any, Final

from tftool.errors import LinkError, MalformedMessage, TftoolError
from tftool.interfaces.classes import Message
from tftool.link import keys, types
from tftool.link.keys import Attachment, Entity
from tftool.link.membership import Membership
from tftool.link.transport import Question
from tftool.link.types import ServiceType
from tftool.runtime.endpoints import Quality

QUALITY: Final = Quality(depth=10)
"""ROS 2's quality of services."""

PATIENCE: Final = 5.0
"""Seconds that nodes of ours wait for an answer."""

LONGEST: Final = 3600.0
"""Seconds that users' nodes wait, which may have work for hours done by a service."""


class Tasks:
    """Tasks that somebody must hold on to, and cancel at the end."""

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


class Endpoint:
    """The serving end of one service on the wire."""

    def __init__(
        self,
        link: Membership,
        node: str,
        name: str,
        ros_type: str,
        handler: Callable[[bytes], Coroutine[Any, Any, bytes]],
    ) -> None:
        self._link = link
        self._name = name
        self._handler = handler
        self._tasks = Tasks()
        key = keys.any_hash_key(link.options.domain, name, ros_type)
        self._stop = link.wire.server(key, self._asked)
        self._hide = link.show(link.entity(keys.SERVER, node, name, ros_type, QUALITY))

    def close(self) -> None:
        """Answer nobody any more."""
        self._hide()
        self._stop()
        self._tasks.cancel()

    def _asked(self, question: Question) -> None:
        self._tasks.start(self._answer(question))

    async def _answer(self, question: Question) -> None:
        try:
            asked = keys.parse_attachment(question.attachment)
            payload = await self._handler(question.payload)
        except MalformedMessage as refusal:
            self._link.refuse(self._name, refusal)
            question.refuse(str(refusal))
        except TftoolError as refusal:
            question.refuse(str(refusal))
        except asyncio.CancelledError:
            question.refuse("the server has left")
            raise
        else:
            now = self._link.world.clock.now()
            # The number and the asker come back, so that the asker knows which answer it is.
            question.answer(payload, Attachment(asked.sequence, now, asked.gid).encode())


class Asking:
    """The asking end of one service on the wire."""

    def __init__(self, link: Membership, name: str, server: Entity) -> None:
        self._link = link
        self._name = name
        # Under the server's own hash: it may be of another release.
        self._key = (
            f"{link.options.domain}/{name}/{keys.dds_name(server.ros_type)}/{server.type_hash}"
        )
        self._entity = link.entity(keys.CLIENT, link.main_node, name, server.ros_type, QUALITY)
        self._gid = keys.gid_of(self._entity.token())
        self._hide: Callable[[], None] | None = None
        self._sequence = 0

    async def ask(self, payload: bytes, timeout: float) -> bytes:
        """Send a request and wait for the answer.

        Raises:
            LinkError: If there is none.
        """
        # Whoever never asks is no client.
        self._hide = self._hide or self._link.show(self._entity)
        self._sequence += 1
        try:
            return await self._link.wire.ask(
                self._key,
                payload,
                self._link.attachment(self._sequence, self._gid),
                timeout=timeout,
            )
        except LinkError as error:
            raise LinkError(f"service '{self._name}': {error}") from error

    def close(self) -> None:
        """Ask no more."""
        if self._hide is not None:
            self._hide()


class ServiceServer:
    """A service of our world, for everybody."""

    def __init__(self, link: Membership, name: str, node: str, kind: ServiceType) -> None:
        self._link = link
        self._name = name
        self._kind = kind
        node = node or link.main_node
        self._endpoint = Endpoint(link, node, name, kind.ros_type, self._serve)

    def close(self) -> None:
        """Answer nobody any more."""
        self._endpoint.close()

    async def _serve(self, payload: bytes) -> bytes:
        request = self._kind.request.decode(payload)
        return self._kind.response.encode(await self._link.world.call(self._name, request))


class ServiceClient:
    """A service of another process, as one of our world: it takes values and messages alike."""

    def __init__(self, link: Membership, name: str, server: Entity) -> None:
        self._name = name
        self._type = server.ros_type
        self._asking = Asking(link, name, server)
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
