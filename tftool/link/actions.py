"""An action: three services and two topics on the wire, one action in a world."""

import asyncio
import secrets
from typing import Any, Final, cast

from tftool.errors import LinkError, MalformedMessage
from tftool.interfaces.classes import INTERFACES
from tftool.link.context import LinkContext
from tftool.link.graph import GraphEntity
from tftool.link.seam import Arrived
from tftool.link.services import LONGEST, Answering, Asking, Tasks
from tftool.runtime.doors import Goal
from tftool.runtime.endpoints import Quality
from tftool.runtime.topics import GoalHandle, Status
from tftool.stamps import NANOSECONDS, Stamp
from tftool.wire.codec import codec

KEPT: Final = 100
"""Goals of an action under way or, for who asks late, ended; beyond that none is taken."""

CANCEL_GOAL: Final = "action_msgs/srv/CancelGoal"
STATUS: Final = "action_msgs/msg/GoalStatusArray"

_EXECUTING, _CANCELING, _ABORTED = 2, 3, 6
_NUMBERS: Final = {"succeeded": 4, "canceled": 5, "aborted": _ABORTED}
_NAMES: Final = {number: name for name, number in _NUMBERS.items()}

_FEEDBACK: Final = Quality(depth=10)
_STATUS: Final = Quality(depth=1, is_latched=True)

_EVERY_GOAL = bytes(16)
_NO_ERROR, _REJECTED, _UNKNOWN_GOAL, _ENDED = 0, 1, 2, 3


def _message(ros_type: str, **fields: Any) -> Any:
    return INTERFACES.part(ros_type)(**fields)


def _bytes(message: Any) -> bytes:
    return codec(type(message)).encode(message)


def _read(ros_type: str, payload: bytes) -> Any:
    return codec(INTERFACES.part(ros_type)).decode(payload)


def _id(goal_id: bytes) -> Any:
    return _message("unique_identifier_msgs/msg/UUID", uuid=goal_id)


def _time(stamp: Stamp) -> Any:
    sec, nanosec = divmod(stamp, NANOSECONDS)
    return _message("builtin_interfaces/msg/Time", sec=sec, nanosec=nanosec)


def _info(goal_id: bytes, accepted: Stamp) -> Any:
    return _message("action_msgs/msg/GoalInfo", goal_id=_id(goal_id), stamp=_time(accepted))


class ActionServer:
    """An action of our world, offered to the other processes."""

    def __init__(self, link: LinkContext, name: str, node: str, kind: Any) -> None:
        """Offer an action; the arguments are those of `ServiceServer`."""
        self._link = link
        self._name = name
        self._type: str = kind.interface__
        self._goals: dict[bytes, tuple[Goal, Stamp]] = {}
        self._undecided: set[bytes] = set()
        self._tasks = Tasks()
        node, base = node or link.main_node, f"{name}/_action"
        self._parts = [
            Answering(link, node, f"{base}/{part}", ros_type, handler)
            for part, ros_type, handler in (
                ("send_goal", f"{self._type}_SendGoal", self._send_goal),
                ("cancel_goal", CANCEL_GOAL, self._cancel_goal),
                ("get_result", f"{self._type}_GetResult", self._get_result),
            )
        ]
        publish = link.middleware.publisher
        self._feedback = publish(
            node, f"{base}/feedback", f"{self._type}_FeedbackMessage", _FEEDBACK
        )
        self._status = publish(node, f"{base}/status", STATUS, _STATUS)

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
        asked = _read(f"{self._type}_SendGoal_Request", payload)
        goal_id = bytes(asked.goal_id.uuid)
        now = self._link.world.clock.now()
        is_new = goal_id not in self._goals and goal_id not in self._undecided
        accepted = is_new and self._has_room()
        if accepted:
            # Deciding takes a while, in which the same goal may come again.
            self._undecided.add(goal_id)
            try:
                accepted = await self._start(goal_id, asked.goal, now)
            finally:
                self._undecided.discard(goal_id)
        answer = f"{self._type}_SendGoal_Response"
        return _bytes(_message(answer, accepted=accepted, stamp=_time(now)))

    def _has_room(self) -> bool:
        """Whether one more goal may begin; the oldest that have ended make way for it."""
        ended = [goal_id for goal_id, (goal, _) in self._goals.items() if goal.done]
        surplus = len(self._goals) + len(self._undecided) + 1 - KEPT
        for goal_id in ended[: max(0, surplus)]:
            del self._goals[goal_id]
        if surplus <= len(ended):
            return True
        self._link.say_once(
            f"goals {self._name}",
            f"'{self._name}': {KEPT} goals are under way; until one ends, more are refused.",
        )
        return False

    async def _start(self, goal_id: bytes, request: Any, now: Stamp) -> bool:
        """Hand a goal to its server; whether it takes it."""

        def feed(feedback: Any) -> None:
            said = _message(
                f"{self._type}_FeedbackMessage", goal_id=_id(goal_id), feedback=feedback
            )
            self._feedback.put(_bytes(said), self._link.now())

        goal = await self._link.world.send_goal(self._name, request, feed)
        if goal.decided is not None and not await asyncio.shield(goal.decided):
            return False
        self._goals[goal_id] = goal, now
        self._publish_status()
        self._tasks.start(self._see_through(goal))
        return True

    async def _see_through(self, goal: Goal) -> None:
        await goal.result()
        self._publish_status()

    async def _cancel_goal(self, payload: bytes) -> bytes:
        asked = _read(f"{CANCEL_GOAL}_Request", payload)
        goal_id = bytes(asked.goal_info.goal_id.uuid)
        every = goal_id == _EVERY_GOAL
        chosen = [
            (each, *self._goals[each])
            for each in (list(self._goals) if every else [goal_id])
            if each in self._goals
        ]
        going = [one for one in chosen if not one[1].done]
        for _, goal, _ in going:
            goal.cancel()
        canceled = [
            _info(each, accepted) for each, goal, accepted in going if await goal.cancellation()
        ]
        if canceled:
            code = _NO_ERROR
            self._publish_status()
        elif going:
            code = _REJECTED
        elif every:
            code = _NO_ERROR
        else:
            code = _ENDED if chosen else _UNKNOWN_GOAL
        answer = f"{CANCEL_GOAL}_Response"
        return _bytes(_message(answer, return_code=code, goals_canceling=canceled))

    async def _get_result(self, payload: bytes) -> bytes:
        asked = _read(f"{self._type}_GetResult_Request", payload)
        goal, _ = self._goals.get(bytes(asked.goal_id.uuid), (None, 0))
        answer = f"{self._type}_GetResult_Response"
        if goal is None:
            return _bytes(_message(answer))
        end = await goal.result()
        return _bytes(_message(answer, status=_NUMBERS[end.status], result=end.value))

    def _publish_status(self) -> None:
        entries = []
        for goal_id, (goal, accepted) in self._goals.items():
            if not goal.done:
                number = _CANCELING if goal.cancel_requested else _EXECUTING
            else:
                number = _NUMBERS[goal.ended.status] if goal.ended else _ABORTED
            entries.append(
                _message(
                    "action_msgs/msg/GoalStatus", goal_info=_info(goal_id, accepted), status=number
                )
            )
        self._status.put(_bytes(_message(STATUS, status_list=entries)), self._link.now())


class ActionClient:
    """An action of another process, as one of our world."""

    def __init__(self, link: LinkContext, name: str, server: GraphEntity) -> None:
        self._link = link
        self._name = name
        self._type = server.ros_type.removesuffix("_SendGoal")
        self._goals: dict[bytes, GoalHandle] = {}
        self._tasks = Tasks()
        base = f"{name}/_action"

        def part(what: str, ros_type: str) -> Asking:
            return Asking(link, f"{base}/{what}", ros_type)

        self._send = part("send_goal", f"{self._type}_SendGoal")
        self._cancel = part("cancel_goal", CANCEL_GOAL)
        self._result = part("get_result", f"{self._type}_GetResult")
        feedback = f"{self._type}_FeedbackMessage"
        self._stop_feedback = link.middleware.listen(
            f"{base}/feedback", feedback, self._on_feedback
        )
        self._withdraw = link.world.serve_action(
            name,
            self._accept,
            INTERFACES.find(*self._type.split("/")),
            node=server.node,
            is_remote=True,
        )

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
        goal.decided = asyncio.get_running_loop().create_future()
        goal.on_cancel = lambda: self._tasks.start(self._call_off(goal_id, goal))
        self._tasks.start(self._follow(goal_id, goal, goal.decided))

    async def _follow(
        self, goal_id: bytes, goal: GoalHandle, decided: "asyncio.Future[bool]"
    ) -> None:
        """Send a goal, and see it to its end."""
        status: Status = "aborted"
        result: Any = INTERFACES.part(f"{self._type}_Result")()
        try:
            asked = _message(
                f"{self._type}_SendGoal_Request",
                goal_id=_id(goal_id),
                goal=goal.request,
            )
            answer = await self._send.ask(_bytes(asked), goal.patience or LONGEST)
            accepted = _read(f"{self._type}_SendGoal_Response", answer).accepted
            decided.set_result(accepted)
            if accepted:
                question = _message(f"{self._type}_GetResult_Request", goal_id=_id(goal_id))
                answer = await self._result.ask(_bytes(question), LONGEST)
                ended = _read(f"{self._type}_GetResult_Response", answer)
                status = cast("Status", _NAMES.get(ended.status, "aborted"))
                result = ended.result
        except (LinkError, MalformedMessage, AssertionError) as error:
            self._link.world.log.warn("link", f"{self._name}: {error}")
        finally:
            self._goals.pop(goal_id, None)
            if not decided.done():
                decided.set_result(False)
            goal.finish(status, result)

    async def _call_off(self, goal_id: bytes, goal: GoalHandle) -> None:
        info = _info(goal_id, 0)
        accepted = False
        try:
            asked = _message(f"{CANCEL_GOAL}_Request", goal_info=info)
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
