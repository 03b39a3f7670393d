"""Action client of rclpy.action, which sends goals, waits for their results and cancels goals."""

import asyncio
from collections.abc import Callable
from enum import IntEnum
from functools import partial
from typing import Any, NamedTuple

from tftool.messages.classes import INTERFACES, duplicate
from tftool.ros.host import values
from tftool.ros.rclpy.entities import Requester
from tftool.ros.rclpy.executors import wait_for
from tftool.ros.rclpy.futures import Future
from tftool.ros.rclpy.node_state import NodeState, state_of
from tftool.world.action_parts import ENDED, goal_id_message
from tftool.world.topics import GoalHandle as WorldGoal


class GoalStatus(IntEnum):
    """Status of an action's goal, with the numbers of action_msgs/GoalStatus."""

    STATUS_UNKNOWN = 0
    STATUS_ACCEPTED = 1
    STATUS_EXECUTING = 2
    STATUS_CANCELING = 3
    STATUS_SUCCEEDED = 4
    STATUS_CANCELED = 5
    STATUS_ABORTED = 6


STATUS: dict[str, GoalStatus] = {name: GoalStatus(number) for name, number in ENDED.items()}


class _Result(NamedTuple):
    """Status number and result message of an action's goal, returned by `get_result`."""

    status: int
    result: Any


class _Feedback(NamedTuple):
    """Argument of a feedback callback: the goal's id and the feedback message."""

    goal_id: Any
    feedback: Any


class ClientGoalHandle:
    """Client's handle of one goal, to wait for the goal's result or to cancel the goal."""

    def __init__(self, client: "ActionClient", goal_id: Any, goal: WorldGoal | None) -> None:
        self._client = client
        self._goal = goal
        self.goal_id = goal_id
        self.accepted = goal is not None
        self.status = int(GoalStatus.STATUS_EXECUTING if goal else GoalStatus.STATUS_UNKNOWN)
        self._result: Future | None = None

    def get_result_async(self) -> Future:
        """Return a future of an object with the goal's status number and result message.

        The object's attributes are `status` and `result`.
        """
        if self._result is None:
            self._result = self._client.watch(self, self._goal)
        return self._result

    def get_result(self) -> Any:
        """Block until the goal ends; return an object with the attributes `status` and `result`."""
        return wait_for(self._client.node_state, self.get_result_async())

    def cancel_goal_async(self) -> Future:
        """Request the goal's cancellation; return a future of the server's response."""
        return self._client.promise(partial(_cancelled, self._goal, self.goal_id))

    def cancel_goal(self) -> Any:
        """Request the goal's cancellation; block until the server responds."""
        return wait_for(self._client.node_state, self.cancel_goal_async())


class ActionClient(Requester):
    """Client that sends goals to an action's server."""

    def __init__(
        self,
        node: Any,
        action_type: Any,
        action_name: str,
        *,
        callback_group: Any = None,
        **profiles: Any,
    ) -> None:
        state = state_of(node)
        super().__init__(state, callback_group or node.default_callback_group)
        self.type_ = action_type
        self._name = action_name
        self.full = state.full(action_name)
        state.keep(self._join)

    def _join(self, _: NodeState) -> "ActionClient":
        self.announce(f"{self.full}/_action/send_goal", f"{self.type_.interface__}_SendGoal")
        return self

    def is_served(self) -> bool:
        """Return whether an action server exists; call this in the event loop's thread."""
        return self.full in self.node_state.world.actions()

    def send_goal_async(
        self,
        goal: Any,
        feedback_callback: Callable[[Any], Any] | None = None,
        goal_uuid: Any = None,
    ) -> Future:
        """Send a goal to the server; return a future of the goal's `ClientGoalHandle`.

        Raises:
            TypeError: If the goal is not a message of this action's Goal type.
        """
        if not isinstance(goal, self.type_.Goal):
            raise TypeError(f"Expected {self.type_.Goal}, got {type(goal)}")
        goal_id = goal_uuid or goal_id_message(self.node_state.world.new_goal_id())
        copy = duplicate(goal)

        def on_feedback(value: Any) -> None:
            if feedback_callback is None:
                return
            message = values.unpack(value, self.type_.Feedback)
            told = feedback_callback
            self.put(lambda: told(_Feedback(goal_id, message)))

        async def send() -> ClientGoalHandle | None:
            if not self.is_served():
                return None
            goal_key = bytes(goal_id.uuid)
            handle = self.node_state.world.send_goal(self.full, copy, on_feedback, goal_id=goal_key)
            # Shielded, because the server decides whether or not this client waits.
            accepted = handle.decided is None or await asyncio.shield(handle.decided)
            return ClientGoalHandle(self, goal_id, handle if accepted else None)

        return self.promise(send)

    def send_goal(self, goal: Any, **kwargs: Any) -> Any:
        """Send a goal and block until the goal's result arrives.

        Returns:
            Object with the attributes `status` and `result`; None if the server rejects the goal.
        """
        handle = wait_for(self.node_state, self.send_goal_async(goal, **kwargs))
        return None if handle is None or not handle.accepted else handle.get_result()

    def watch(self, handle: ClientGoalHandle, goal: WorldGoal | None) -> Future:
        """Return a future of a goal's status and result.

        The handle's status is set when the goal ends. If `goal` is None, because the server has
        rejected the goal, the future never completes.
        """

        async def wait() -> _Result | None:
            if goal is None:
                return None
            end = await goal.result()
            handle.status = int(STATUS[end.status])
            return _Result(handle.status, values.unpack(end.value, self.type_.Result))

        return self.promise(wait)


async def _cancelled(goal: WorldGoal | None, goal_id: Any) -> Any:
    """Request a goal's cancellation; return the response message of the CancelGoal service."""
    response: Any = INTERFACES.part("action_msgs/srv/CancelGoal_Response")
    if goal is None:
        return response(return_code=response.ERROR_UNKNOWN_GOAL_ID)
    if goal.done:
        return response(return_code=response.ERROR_GOAL_TERMINATED)
    goal.cancel()
    if not await goal.cancellation():
        ended = response.ERROR_GOAL_TERMINATED
        return response(return_code=ended if goal.done else response.ERROR_REJECTED)
    info: Any = INTERFACES.message("action_msgs/GoalInfo")
    return response(goals_canceling=[info(goal_id=goal_id)])
