"""The rotate action: three services and two topics on the wire, one action in a world."""

import secrets
from typing import Any, Final, cast

from tftool.errors import LinkError, MalformedMessage
from tftool.link import keys, types
from tftool.link.keys import Entity
from tftool.link.membership import Membership
from tftool.link.services import Asking, Endpoint, Tasks
from tftool.link.topics import Sender
from tftool.link.transport import Arrived
from tftool.messages import RotateAbsolute, Rotated, Rotating
from tftool.runtime.topics import GoalHandle, Status

KEPT: Final = 100
"""Goals whose ends are remembered, for who asks late."""

LONGEST: Final = 3600.0
"""Seconds a client waits for a goal's end."""

_EVERY_GOAL = bytes(16)
_NO_ERROR, _UNKNOWN_GOAL, _ENDED = 0, 2, 3


class ActionServer:
    """An action of our world, for everybody."""

    def __init__(self, link: Membership, name: str) -> None:
        self._link = link
        self._name = name
        self._goals: dict[bytes, tuple[GoalHandle, int]] = {}
        self._tasks = Tasks()
        node, base = link.main_node, f"{name}/_action"
        self._parts = [
            Endpoint(link, node, f"{base}/send_goal", types.SEND_GOAL, self._send_goal),
            Endpoint(link, node, f"{base}/cancel_goal", types.CANCEL_GOAL, self._cancel_goal),
            Endpoint(link, node, f"{base}/get_result", types.GET_RESULT, self._get_result),
        ]
        self._feedback = Sender(link, node, f"{base}/feedback", types.FEEDBACK, 10, latched=False)
        self._status = Sender(link, node, f"{base}/status", types.STATUS, 1, latched=True)

    def close(self) -> None:
        """Take no goals any more; those under way are given up."""
        for part in self._parts:
            part.close()
        self._feedback.close()
        self._status.close()
        self._tasks.cancel()
        for goal, _ in self._goals.values():
            goal.cancel()

    async def _send_goal(self, payload: bytes) -> bytes:
        goal_id, theta = types.SEND_GOAL_REQUEST.decode(payload)
        now = self._link.world.clock.now()
        if goal_id in self._goals:
            return types.SEND_GOAL_RESPONSE.encode((False, *divmod(now, 1_000_000_000)))

        def feed(value: Rotating) -> None:
            self._feedback.put(types.FEEDBACK_MESSAGE.encode((goal_id, value.remaining)))

        goal = await self._link.world.send_goal(self._name, RotateAbsolute(theta), feed)
        self._goals[goal_id] = goal, now
        while len(self._goals) > KEPT:
            del self._goals[next(iter(self._goals))]
        self._publish_status()
        self._tasks.start(self._see_through(goal))
        return types.SEND_GOAL_RESPONSE.encode((True, *divmod(now, 1_000_000_000)))

    async def _see_through(self, goal: GoalHandle) -> None:
        await goal.result()
        self._publish_status()

    async def _cancel_goal(self, payload: bytes) -> bytes:
        goal_id, _, _ = types.CANCEL_REQUEST.decode(payload)
        chosen = list(self._goals) if goal_id == _EVERY_GOAL else [goal_id]
        canceled = []
        for each in chosen:
            goal, accepted = self._goals.get(each, (None, 0))
            if goal is not None and not goal.done:
                goal.cancel()
                canceled.append((each, *divmod(accepted, 1_000_000_000)))
        if canceled or goal_id == _EVERY_GOAL:
            code = _NO_ERROR
        else:
            code = _ENDED if goal_id in self._goals else _UNKNOWN_GOAL
        return types.CANCEL_RESPONSE.encode((code, canceled))

    async def _get_result(self, payload: bytes) -> bytes:
        (goal_id,) = types.GET_RESULT_REQUEST.decode(payload)
        goal, _ = self._goals.get(goal_id, (None, 0))
        if goal is None:
            return types.GET_RESULT_RESPONSE.encode((0, 0.0))
        result = await goal.result()
        return types.GET_RESULT_RESPONSE.encode(
            (types.STATUS_NUMBERS[result.status], result.value.delta)
        )

    def _publish_status(self) -> None:
        entries = []
        for goal_id, (goal, accepted) in self._goals.items():
            if not goal.done:
                number = types.CANCELING if goal.cancel_requested else types.EXECUTING
            else:
                number = types.STATUS_NUMBERS[goal.ended.status] if goal.ended else types.ABORTED
            entries.append((goal_id, *divmod(accepted, 1_000_000_000), number))
        self._status.put(types.STATUS_MESSAGE.encode((entries,)))


class ActionClient:
    """An action of another process, as one of our world."""

    def __init__(self, link: Membership, name: str, server: Entity) -> None:
        self._link = link
        self._name = name
        self._goals: dict[bytes, GoalHandle] = {}
        self._tasks = Tasks()
        package = server.ros_type.partition("/")[0]
        base = f"{name}/_action"

        def part(what: str, ros_type: str) -> Asking:
            known = next(iter(link.graph.entities(keys.SERVER, name=f"{base}/{what}")), None)
            type_hash = keys.TYPE_HASHES[ros_type] if known is None else known.type_hash
            own = ros_type.replace("turtlesim/", f"{package}/", 1)
            return Asking(
                link,
                f"{base}/{what}",
                Entity(0, "", 0, 0, "SS", "", f"{base}/{what}", own, type_hash),
            )

        self._send = part("send_goal", types.SEND_GOAL)
        self._cancel = part("cancel_goal", types.CANCEL_GOAL)
        self._result = part("get_result", types.GET_RESULT)
        feedback = types.FEEDBACK.replace("turtlesim/", f"{package}/", 1)
        key = keys.any_hash_key(link.options.domain, f"{base}/feedback", feedback)
        self._stop_feedback = link.wire.subscriber(key, self._on_feedback)
        self._withdraw = link.world.serve_action(name, self._accept)

    def close(self) -> None:
        """Take it out of our world; goals under way end as aborted."""
        self._withdraw()
        self._stop_feedback()
        self._tasks.cancel()
        for part in (self._send, self._cancel, self._result):
            part.close()

    def _accept(self, goal: GoalHandle) -> None:
        goal_id = secrets.token_bytes(16)
        self._goals[goal_id] = goal
        goal.on_cancel = lambda: self._tasks.start(self._call_off(goal_id))
        self._tasks.start(self._follow(goal_id, goal))

    async def _follow(self, goal_id: bytes, goal: GoalHandle) -> None:
        """Send a goal, and see it to its end."""
        status: Status = "aborted"
        delta = 0.0
        try:
            payload = types.SEND_GOAL_REQUEST.encode((goal_id, goal.request.theta))
            accepted, _, _ = types.SEND_GOAL_RESPONSE.decode(await self._send.ask(payload))
            if accepted:
                answer = await self._result.ask(
                    types.GET_RESULT_REQUEST.encode((goal_id,)), LONGEST
                )
                number, delta = types.GET_RESULT_RESPONSE.decode(answer)
                status = cast("Status", types.STATUS_NAMES.get(number, "aborted"))
        except (LinkError, MalformedMessage) as error:
            self._link.world.log.warn("link", f"{self._name}: {error}")
        finally:
            self._goals.pop(goal_id, None)
            goal.finish(status, Rotated(delta))

    async def _call_off(self, goal_id: bytes) -> None:
        try:
            await self._cancel.ask(types.CANCEL_REQUEST.encode((goal_id, 0, 0)))
        except LinkError as error:
            self._link.world.log.warn("link", f"{self._name}: {error}")

    def _on_feedback(self, message: Arrived) -> None:
        try:
            goal_id, remaining = types.FEEDBACK_MESSAGE.decode(message.payload)
        except MalformedMessage as refusal:
            self._link.refuse(f"{self._name}/_action/feedback", refusal)
            return
        goal: Any = self._goals.get(goal_id)
        if goal is not None:
            goal.publish_feedback(Rotating(remaining))
