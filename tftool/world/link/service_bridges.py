"""Services and actions that a world and other processes offer to each other."""

import asyncio
from collections.abc import Awaitable, Callable, Coroutine
from functools import partial
from typing import Any, Final, cast

from tftool.base.errors import LinkError, MalformedMessage, TftoolError
from tftool.messages.classes import INTERFACES
from tftool.messages.codec import codec
from tftool.world.action_parts import (
    CANCEL_GOAL,
    ENDED,
    STATUS,
    ActionParts,
    Tasks,
    goal_id_message,
    goal_info,
    message,
)
from tftool.world.endpoints import CLIENT, Quality
from tftool.world.link.graph import GraphEntity
from tftool.world.link.link_context import LinkContext
from tftool.world.link.seam import Arrived, WireRequest
from tftool.world.topics import GoalHandle, Status

LONGEST: Final = 3600.0
"""Longest wait in seconds for a response, as a service may work for an hour."""


class Answering:
    """Server that answers requests of other processes for one service of this process's world."""

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
        """Stop serving, and cancel unfinished requests."""
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
    """Client of a service in another process; requests and responses are bytes in CDR."""

    def __init__(self, link: LinkContext, name: str, ros_type: str) -> None:
        self._link = link
        self._name = name
        self._ros_type = ros_type
        self._client = link.middleware.client(link.main_node, name, ros_type)
        self._hide: Callable[[], None] | None = None

    async def ask(self, payload: bytes, timeout: float) -> bytes:
        """Send a request, and wait at most `timeout` seconds for the response.

        Raises:
            LinkError: If no response arrives, or the server sends an error.
        """
        # Announced with the first request, because every world knows all services, and the graph
        # would be full. A user's node announces its own client.
        if self._hide is None and not self._link.world.clients.of(self._name, CLIENT):
            announce = self._link.middleware.announce_client
            self._hide = announce(self._link.main_node, self._name, self._ros_type)
        try:
            return await self._client.ask(payload, self._link.now(), timeout)
        except LinkError as error:
            raise LinkError(f"service '{self._name}': {error}") from error

    def close(self) -> None:
        """Close the client of the service."""
        self._client.close()
        if self._hide is not None:
            self._hide()


def serve_service(link: LinkContext, node: str, name: str, kind: Any) -> Answering:
    """Serve a service of this process's world for other processes.

    Args:
        link: State of the session connection.
        node: Name of the node that serves the service; "" if unknown.
        name: Name of the service.
        kind: ROS class of the service.
    """

    async def serve(payload: bytes) -> bytes:
        request = codec(kind.Request).decode(payload)
        return codec(kind.Response).encode(await link.world.call(name, request))

    return Answering(link, node or link.main_node, name, kind.interface__, serve)


class ServiceClient:
    """Service of another process, made available to the nodes of this process's world."""

    def __init__(self, link: LinkContext, name: str, server: GraphEntity) -> None:
        kind = INTERFACES.find(*server.ros_type.split("/"))
        self._asking = Asking(link, name, server.ros_type)
        call = _caller(self._asking, kind)
        self._withdraw = link.world.serve(name, call, kind, node=server.node, is_remote=True)

    def close(self) -> None:
        """Remove the service of the other process from this world."""
        self._withdraw()
        self._asking.close()


def _caller(asking: Asking, kind: Any) -> Callable[[Any], Coroutine[Any, Any, Any]]:
    """Return a function that calls a service of another process with a request of `kind`."""

    async def call(request: Any) -> Any:
        payload = codec(kind.Request).encode(request)
        return codec(kind.Response).decode(await asking.ask(payload, LONGEST))

    return call


_NAMES: Final = {number: name for name, number in ENDED.items()}

_FEEDBACK: Final = Quality(depth=10)
_STATUS: Final = Quality(depth=1, is_latched=True)


def _bytes(message: Any) -> bytes:
    return codec(type(message)).encode(message)


def _read(ros_type: str, payload: bytes) -> Any:
    return codec(INTERFACES.part(ros_type)).decode(payload)


class ActionServer:
    """Server that offers one action of this process's world to other processes."""

    def __init__(self, link: LinkContext, node: str, name: str, kind: Any) -> None:
        """Serve an action; for the arguments see `serve_service`."""
        interface: str = kind.interface__
        node, base = node or link.main_node, f"{name}/_action"
        publish = link.middleware.publisher
        self._feedback = publish(
            node, f"{base}/feedback", f"{interface}_FeedbackMessage", _FEEDBACK
        )
        self._status = publish(node, f"{base}/status", STATUS, _STATUS)
        self.parts = ActionParts(
            link.world,
            name,
            interface,
            on_feedback=lambda said: self._feedback.put(_bytes(said), link.now()),
            on_status=lambda said: self._status.put(_bytes(said), link.now()),
            warn=lambda text: link.say_once(f"goals {name}", text),
        )
        self._services = [
            Answering(link, node, f"{base}/{part}", ros_type, _in_bytes(ros_type, answer))
            for part, ros_type, answer in (
                ("send_goal", f"{interface}_SendGoal", self.parts.send_goal),
                ("cancel_goal", CANCEL_GOAL, self.parts.cancel_goal),
                ("get_result", f"{interface}_GetResult", self.parts.get_result),
            )
        ]

    def close(self) -> None:
        """Stop serving the action; running goals are cancelled."""
        for service in self._services:
            service.close()
        self._feedback.close()
        self._status.close()
        self.parts.close()
        self.parts.give_up()


def _in_bytes(
    ros_type: str, answer: Callable[[Any], Awaitable[Any]]
) -> Callable[[bytes], Coroutine[Any, Any, bytes]]:
    async def handle(payload: bytes) -> bytes:
        return _bytes(await answer(_read(f"{ros_type}_Request", payload)))

    return handle


class ActionClient:
    """Action of another process, made available to the nodes of this process's world."""

    def __init__(self, link: LinkContext, name: str, server: GraphEntity) -> None:
        self._link = link
        self._name = name
        self._type = server.ros_type.removesuffix("_SendGoal")
        self._goals: dict[bytes, GoalHandle] = {}
        self._tasks = Tasks()
        base = f"{name}/_action"

        kind = INTERFACES.find(*self._type.split("/"))
        serve = partial(link.world.serve, node=server.node, is_remote=True, shares=True)

        def part(what: str, service: Any) -> Asking:
            asking = Asking(link, f"{base}/{what}", service.interface__)
            # A program may also call the service itself, without an action client.
            self._withdrawals.append(serve(f"{base}/{what}", _caller(asking, service), service))
            return asking

        self._withdrawals: list[Callable[[], None]] = []
        self._send = part("send_goal", kind.Impl.SendGoalService)
        self._cancel = part("cancel_goal", kind.Impl.CancelGoalService)
        self._result = part("get_result", kind.Impl.GetResultService)
        feedback = f"{self._type}_FeedbackMessage"
        self._stop_feedback = link.middleware.listen(
            f"{base}/feedback", feedback, self._on_feedback
        )
        self._withdrawals.append(
            link.world.serve_action(name, self._accept, kind, node=server.node, is_remote=True)
        )

    def close(self) -> None:
        """Remove the other process's action from this world; running goals end as aborted."""
        for withdraw in self._withdrawals:
            withdraw()
        self._stop_feedback()
        self._tasks.cancel()
        for part in (self._send, self._cancel, self._result):
            part.close()

    def _accept(self, goal: GoalHandle) -> None:
        goal_id = goal.goal_id
        # A program may use an id twice; the server then refuses the second goal.
        self._goals.setdefault(goal_id, goal)
        goal.decided = asyncio.get_running_loop().create_future()
        goal.on_cancel = lambda: self._tasks.start(self._call_off(goal_id, goal))
        self._tasks.start(self._follow(goal_id, goal, goal.decided))

    async def _follow(
        self, goal_id: bytes, goal: GoalHandle, decided: "asyncio.Future[bool]"
    ) -> None:
        """Send a goal to the other process, and track the goal until its end."""
        status: Status = "aborted"
        result: Any = INTERFACES.part(f"{self._type}_Result")()
        try:
            asked = message(
                f"{self._type}_SendGoal_Request",
                goal_id=goal_id_message(goal_id),
                goal=goal.request,
            )
            answer = await self._send.ask(_bytes(asked), goal.patience or LONGEST)
            accepted = _read(f"{self._type}_SendGoal_Response", answer).accepted
            decided.set_result(accepted)
            if accepted:
                question = message(
                    f"{self._type}_GetResult_Request", goal_id=goal_id_message(goal_id)
                )
                answer = await self._result.ask(_bytes(question), LONGEST)
                ended = _read(f"{self._type}_GetResult_Response", answer)
                status = cast("Status", _NAMES.get(ended.status, "aborted"))
                result = ended.result
        except (LinkError, MalformedMessage, AssertionError) as error:
            self._link.world.log.warn("link", f"{self._name}: {error}")
        finally:
            if self._goals.get(goal_id) is goal:
                del self._goals[goal_id]
            if not decided.done():
                decided.set_result(False)
            goal.finish(status, result)

    async def _call_off(self, goal_id: bytes, goal: GoalHandle) -> None:
        info = goal_info(goal_id, 0)
        accepted = False
        try:
            asked = message(f"{CANCEL_GOAL}_Request", goal_info=info)
            answer = await self._cancel.ask(_bytes(asked), goal.patience or LONGEST)
            accepted = bool(_read(f"{CANCEL_GOAL}_Response", answer).goals_canceling)
        except (LinkError, MalformedMessage) as error:
            self._link.world.log.warn("link", f"{self._name}: {error}")
        finally:
            goal.decide_cancel(accepted)

    def _on_feedback(self, message: Arrived) -> None:
        try:
            said = _read(f"{self._type}_FeedbackMessage", message.payload)
        except MalformedMessage as refusal:
            self._link.refuse(f"{self._name}/_action/feedback", refusal)
            return
        goal = self._goals.get(bytes(said.goal_id.uuid))
        if goal is not None:
            goal.publish_feedback(said.feedback)
