"""Clients that ask services, and the services that answer.

What arrived waits until an executor takes it, as with all entities.
"""

import asyncio
import inspect
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from tftool.errors import TftoolError
from tftool.interfaces.classes import Message, duplicate
from tftool.ros import values
from tftool.ros.client.entities import Entity, Work
from tftool.ros.client.futures import Future

if TYPE_CHECKING:
    from tftool.ros.client.node import Node


class Client(Entity):
    """Asks a service."""

    # An answer completes a future and runs nobody's callback by itself, so whoever
    # waits for it inside a callback gets it.
    passes_busy_group = True

    def __init__(self, node: "Node", kind: Any, name: str, full: str, group: Any) -> None:
        super().__init__(node, group)
        self.srv_type = kind
        self.srv_name = name
        self.full = full
        self._answers: deque[tuple[Future, Any, BaseException | None]] = deque()
        self._tasks: set[asyncio.Task[None]] = set()
        self._pending: set[Future] = set()

    @property
    def service_name(self) -> str:
        """The service's full name."""
        return f"/{self.full}"

    def service_is_ready(self) -> bool:
        """Whether somebody serves it."""
        ready = bool(self.node.program.ask(lambda: self.node.world.has_service(self.full)))
        if not ready:
            self.node.program.looked_in_vain()
        return ready

    def wait_for_service(self, timeout_sec: float | None = None) -> bool:
        """Block until somebody serves it; whether somebody does."""
        return self.node.wait_until(lambda: self.node.world.has_service(self.full), timeout_sec)

    def call_async(self, request: Any) -> Future:
        """Ask; the answer comes while somebody spins.

        Raises:
            TypeError: If the request is of another type.
        """
        if not isinstance(request, self.srv_type.Request):
            raise TypeError(f"Expected {self.srv_type.Request}, got {type(request)}")
        future = Future(executor=self.node.executor)
        copy = duplicate(request)
        self._pending.add(future)

        def send() -> None:
            task = asyncio.get_running_loop().create_task(self._call(copy, future))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)

        self.node.program.ask(send)
        return future

    def call(self, request: Any, timeout_sec: float | None = None) -> Any:
        """Ask, and block until the answer is there; None if it takes longer than allowed.

        Unlike in ROS 2 this may be called inside a callback.
        """
        future = self.call_async(request)
        self.node.wait_for(future, timeout_sec)
        return future.result()

    def remove_pending_request(self, future: Future) -> None:
        """Wait no longer for an answer."""
        self._pending.discard(future)
        future.cancel()

    async def _call(self, request: Any, future: Future) -> None:
        world = self.node.world
        # As in ROS 2, a request nobody serves yet waits for nobody: it stays unanswered.
        handler = world.services().get(self.full)
        if handler is None:
            return
        served_here = getattr(handler, "serves_ros", False)
        try:
            if served_here:
                answer = await world.call(self.full, request)
            else:
                answer = await world.call(
                    self.full, values.pack_request(self.srv_type, self.full, request)
                )
            self._answers.append((future, values.unpack_response(self.srv_type, answer), None))
        except TftoolError as error:
            self._answers.append((future, None, error))
        self.node.wake()

    def ready(self) -> bool:
        """Whether an answer waits."""
        return bool(self._answers)

    def take(self) -> Work:
        """Complete the future of the oldest answer."""
        future, answer, error = self._answers.popleft()

        def work() -> None:
            self._pending.discard(future)
            if future.cancelled():
                return
            if error is not None:
                future.set_exception(error)
            else:
                future.set_result(answer)

        return work

    def withdraw(self) -> None:
        """Wait for no answer any more."""
        super().withdraw()
        for task in list(self._tasks):
            task.cancel()


class _ServiceHandler:
    """What the world calls for a service that a ROS node serves."""

    serves_ros = True

    def __init__(self, service: "Service") -> None:
        self._service = service

    async def __call__(self, request: Any) -> Any:
        return await self._service.asked(request)


class Service(Entity):
    """Answers a service."""

    def __init__(
        self,
        node: "Node",
        kind: Any,
        name: str,
        full: str,
        callback: Callable[[Any, Any], Any],
        group: Any,
    ) -> None:
        super().__init__(node, group)
        self.srv_type = kind
        self.srv_name = name
        self.full = full
        self.callback = callback
        self._requests: deque[tuple[Any, asyncio.Future[Any], bool]] = deque()
        self._open: set[asyncio.Future[Any]] = set()
        self._stop = node.world.serve(full, _ServiceHandler(self))

    @property
    def service_name(self) -> str:
        """The service's full name."""
        return f"/{self.full}"

    async def asked(self, request: Any) -> Any:
        """Keep a request until an executor takes it; its answer."""
        answer: asyncio.Future[Any] = asyncio.get_running_loop().create_future()
        ours = not isinstance(request, Message)
        self._requests.append((values.unpack_request(self.srv_type, request), answer, ours))
        self._open.add(answer)
        self.node.wake()
        try:
            return await answer
        finally:
            self._open.discard(answer)

    def ready(self) -> bool:
        """Whether a request waits."""
        return bool(self._requests)

    def take(self) -> Work:
        """The callback with the oldest request."""
        request, answer, ours = self._requests.popleft()

        def work() -> Any:
            response = self.callback(request, self.srv_type.Response())
            if inspect.iscoroutine(response):
                return self._later(response, answer, ours)
            self._send(response, answer, ours)
            return None

        return work

    async def _later(self, response: Any, answer: "asyncio.Future[Any]", ours: bool) -> None:
        self._send(await response, answer, ours)

    def _send(self, response: Any, answer: "asyncio.Future[Any]", ours: bool) -> None:
        if not isinstance(response, self.srv_type.Response):
            raise TypeError(
                f"the callback of service '{self.srv_name}' must return a "
                f"{self.srv_type.__name__}.Response, not {type(response).__name__}"
            )
        packed = values.pack_response(self.srv_type, response, ours=ours)

        def send() -> None:
            if not answer.done():
                answer.set_result(packed)

        self.node.program.ask(send)

    def withdraw(self) -> None:
        """Serve no more; who still waits is told that no answer will come."""
        super().withdraw()
        self._stop()
        for answer in self._open:
            if not answer.done():
                answer.set_exception(TftoolError(f"the node that served '{self.full}' has left"))
