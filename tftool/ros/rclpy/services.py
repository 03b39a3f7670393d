"""Clients and servers of ROS services.

Requests and responses are queued until an executor of the node processes them.
"""

import asyncio
from collections.abc import Callable
from enum import IntEnum
from functools import partial
from typing import Any

from tftool.base.errors import TftoolError
from tftool.messages.classes import duplicate
from tftool.ros.host import values
from tftool.ros.rclpy.entities import MOST_WAITING, Requester, WorkQueue, outcome
from tftool.ros.rclpy.executors import wait_for
from tftool.ros.rclpy.futures import Future
from tftool.ros.rclpy.node_state import NodeState

START_TYPE_DESCRIPTION_SERVICE_PARAM = "start_type_description_service"
"""Parameter that starts a type description service in ROS 2; without effect in tftool."""


class ServiceIntrospectionState(IntEnum):
    """Amount of data about requests and responses that ROS 2 publishes for debugging."""

    OFF = 0
    METADATA = 1
    CONTENTS = 2


class ServiceEnd(WorkQueue):
    """Base class of clients and servers of a service."""

    def __init__(self, state: NodeState, kind: Any, name: str, full: str, group: Any) -> None:
        super().__init__(state, group)
        self.srv_type = kind
        self.srv_name = name
        self.full = full

    @property
    def service_name(self) -> str:
        """Full name of the service."""
        return f"/{self.full}"

    def configure_introspection(
        self, clock: Any, service_event_qos_profile: Any, introspection_state: int
    ) -> None:
        """Store `introspection_state`; unlike ROS 2, tftool publishes no service events."""
        self.introspection_state = ServiceIntrospectionState(introspection_state)


class Client(ServiceEnd, Requester):
    """Client that sends requests to a service."""

    def __init__(self, state: NodeState, kind: Any, name: str, full: str, group: Any) -> None:
        super().__init__(state, kind, name, full, group)
        self.announce(full, kind.interface__)

    def is_served(self) -> bool:
        """Return whether a server is available; call this in the event loop's thread."""
        return self.node_state.world.has_service(self.full)

    service_is_ready = Requester.server_is_ready
    wait_for_service = Requester.wait_for_server

    def call_async(self, request: Any) -> Future:
        """Send a request; return a future of the response.

        The future completes while an executor spins the client's node.

        Raises:
            TypeError: If the request is not a message of the service's Request type.
        """
        if not isinstance(request, self.srv_type.Request):
            raise TypeError(f"Expected {self.srv_type.Request}, got {type(request)}")
        return self.promise(partial(self._call, duplicate(request)))

    def call(self, request: Any, timeout_sec: float | None = None) -> Any:
        """Send a request, and block until the response arrives.

        Unlike in ROS 2, a callback may call this method.

        Raises:
            TimeoutError: If no response arrives in `timeout_sec` seconds.
        """
        future = self.call_async(request)
        response = wait_for(self.node_state, future, timeout_sec)
        if (
            timeout_sec is not None
            and not future.done()
            and not self.node_state.program.interrupted
        ):
            self.remove_pending_request(future)
            raise TimeoutError(
                f"service '{self.service_name}' has not responded in {timeout_sec:g} s"
            )
        return response

    def remove_pending_request(self, future: Future) -> None:
        """Cancel the future that `call_async` returned for a request."""
        future.cancel()

    async def _call(self, request: Any) -> Any:
        # As in ROS 2, a request without a server is dropped, and gets no response.
        if not self.is_served():
            return None
        answer = await self.node_state.world.call(self.full, duplicate(request))
        return values.unpack(answer, self.srv_type.Response)


class Service(ServiceEnd):
    """Server that responds to requests of a service."""

    def __init__(
        self,
        state: NodeState,
        kind: Any,
        name: str,
        full: str,
        callback: Callable[[Any, Any], Any],
        group: Any,
    ) -> None:
        super().__init__(state, kind, name, full, group)
        self.callback = callback
        self._open: set[asyncio.Future[Any]] = set()
        self._stop = state.world.serve(full, self.respond, kind, node=state.authority, shares=True)

    async def respond(self, request: Any) -> Any:
        """Queue a request for the executor; return the response when the callback has run.

        Raises:
            TftoolError: If the queue of requests is full.
        """
        if self.is_full:
            raise TftoolError(
                f"service '{self.full}' has {MOST_WAITING} requests waiting, which its node "
                f"'{self.node_state.authority}' does not process: check that the node spins"
            )
        answer: asyncio.Future[Any] = asyncio.get_running_loop().create_future()
        self._open.add(answer)
        self.put(partial(self._answer, values.unpack(request, self.srv_type.Request), answer))
        try:
            return await answer
        finally:
            self._open.discard(answer)

    async def _answer(self, request: Any, answer: "asyncio.Future[Any]") -> None:
        response = await outcome(self.callback(request, self.srv_type.Response()))
        if not isinstance(response, self.srv_type.Response):
            raise TypeError(
                f"the callback of service '{self.srv_name}' must return a "
                f"{self.srv_type.__name__}.Response, not {type(response).__name__}"
            )
        sent = duplicate(response)

        def send() -> None:
            if not answer.done():
                answer.set_result(sent)

        self.node_state.program.ask(send)

    def withdraw(self) -> None:
        """Stop the server; clients that wait for a response get an error."""
        self._stop()
        for answer in self._open:
            if not answer.done():
                answer.set_exception(TftoolError(f"the node that served '{self.full}' has ended"))
