"""Action server of rclpy.action, which accepts and executes goals."""

import asyncio
from collections.abc import Callable
from enum import IntEnum
from typing import Any

from tftool.base.errors import TftoolError
from tftool.messages.classes import duplicate
from tftool.ros.host import values
from tftool.ros.host.error_text import error_sentence
from tftool.ros.rclpy.action_client import STATUS, GoalStatus
from tftool.ros.rclpy.entities import WorkQueue, outcome
from tftool.ros.rclpy.node_state import NodeState, state_of
from tftool.ros.rclpy.qos import QoSProfile, qos_profile_action_status_default, qos_profile_default
from tftool.ros.rclpy.topics import Publisher
from tftool.world.action_parts import ActionParts, goal_id_message
from tftool.world.topics import GoalHandle as WorldGoal
from tftool.world.topics import Status


class GoalResponse(IntEnum):
    """Decision of an action server whether to accept a new goal."""

    REJECT = 1
    ACCEPT = 2


class CancelResponse(IntEnum):
    """Decision of an action server whether to accept a request to cancel a goal."""

    REJECT = 1
    ACCEPT = 2


class ServerGoalHandle:
    """Handle of one goal in a server's callbacks, to publish feedback and report the result.

    Attributes:
        request: The goal message.
        is_cancel_requested: Whether a cancellation was requested and accepted.
        goal_id: Id of the goal, a UUID message.
    """

    def __init__(self, server: "ActionServer", goal: WorldGoal, request: Any) -> None:
        self._server = server
        self._goal = goal
        self._status: Status | None = None
        self._executing = False
        self.request = request
        self.is_cancel_requested = False
        self.goal_id = goal_id_message(goal.goal_id)

    @property
    def is_active(self) -> bool:
        """Whether the goal has not ended."""
        return self._status is None and not self._goal.done

    @property
    def status(self) -> int:
        """Status of the goal, a number of `GoalStatus`."""
        if self._status is not None:
            return int(STATUS[self._status])
        if self.is_cancel_requested:
            return int(GoalStatus.STATUS_CANCELING)
        return int(GoalStatus.STATUS_EXECUTING if self._executing else GoalStatus.STATUS_ACCEPTED)

    def publish_feedback(self, feedback: Any) -> None:
        """Send a feedback message to the goal's client.

        Raises:
            TypeError: If the message is not of the action's Feedback type.
        """
        kind = self._server.type_.Feedback
        if not isinstance(feedback, kind):
            raise TypeError(f"Expected {kind}, got {type(feedback)}")
        copy = duplicate(feedback)
        self._server.node_state.program.ask(lambda: self._goal.publish_feedback(copy))

    def succeed(self, response: Any = None) -> None:
        """Mark the goal as succeeded."""
        self._status = "succeeded"

    def abort(self, response: Any = None) -> None:
        """Mark the goal as aborted by the server."""
        self._status = "aborted"

    def canceled(self, response: Any = None) -> None:
        """Mark the goal as cancelled at the client's request."""
        self._status = "canceled"

    def execute(self, execute_callback: Any = None) -> None:
        """Schedule the execution of the goal.

        Without `execute_callback`, the server's callback is called with this handle.
        """
        self._executing = True
        self._server.execute(self, execute_callback)

    def destroy(self) -> None:
        """Do nothing; the method exists in ROS 2."""

    def finish(self, result: Any) -> None:
        """End the goal, and send the result message to the client."""
        status = self._status or "aborted"
        copy = duplicate(result)
        self._server.node_state.program.ask(lambda: self._goal.finish(status, copy))


class ActionServer(WorkQueue):
    """Server that accepts and executes goals of an action."""

    def __init__(
        self,
        node: Any,
        action_type: Any,
        action_name: str,
        execute_callback: Callable[[ServerGoalHandle], Any],
        *,
        callback_group: Any = None,
        goal_callback: Callable[[Any], Any] | None = None,
        handle_accepted_callback: Callable[[ServerGoalHandle], Any] | None = None,
        cancel_callback: Callable[[ServerGoalHandle], Any] | None = None,
        feedback_pub_qos_profile: QoSProfile = qos_profile_default,
        status_pub_qos_profile: QoSProfile = qos_profile_action_status_default,
        **profiles: Any,
    ) -> None:
        state = state_of(node)
        super().__init__(state, callback_group or node.default_callback_group)
        if not callable(execute_callback):
            raise TypeError("an ActionServer needs a function as its execute_callback")
        self.type_ = action_type
        self._execute = execute_callback
        self._on_goal = goal_callback or (lambda request: GoalResponse.ACCEPT)
        self._on_accepted = handle_accepted_callback or (lambda handle: handle.execute())
        self._on_cancel = cancel_callback or (lambda handle: CancelResponse.REJECT)
        self.full = state.full(action_name)
        self._stops: list[Callable[[], None]] = []
        self._goals: set[WorldGoal] = set()

        def serve(state: NodeState) -> "ActionServer":
            stop = state.world.serve_action(
                self.full, self.arrived, action_type, node=state.authority
            )
            self._stops = [stop]
            self._show_parts(feedback_pub_qos_profile, status_pub_qos_profile)
            return self

        state.keep(serve)

    def _show_parts(self, feedback_profile: QoSProfile, status_profile: QoSProfile) -> None:
        """Offer the services and topics of ROS 2's action protocol, such as `_action/status`."""
        state, made = self.node_state, self.type_.Impl

        def publisher(what: str, kind: Any, profile: QoSProfile) -> Publisher:
            full = f"{self.full}/_action/{what}"
            return Publisher(state, kind, f"/{full}", full, profile)

        feedback = publisher("feedback", made.FeedbackMessage, feedback_profile)
        status = publisher("status", made.GoalStatusMessage, status_profile)
        parts = ActionParts(
            state.world,
            self.full,
            self.type_.interface__,
            on_feedback=feedback.publish,
            on_status=status.publish,
            warn=lambda text: state.program.say("WARN", state.authority, text),
        )
        self._stops += [feedback.withdraw, status.withdraw, parts.close]
        for what, kind, answer in (
            ("send_goal", made.SendGoalService, parts.send_goal),
            ("cancel_goal", made.CancelGoalService, parts.cancel_goal),
            ("get_result", made.GetResultService, parts.get_result),
        ):
            self._stops.append(
                state.world.serve(
                    f"{self.full}/_action/{what}",
                    answer,
                    kind,
                    node=state.authority,
                    shares=True,
                )
            )

    def register_goal_callback(self, goal_callback: Callable[[Any], Any]) -> None:
        """Set the callback that accepts or rejects new goals."""
        self._on_goal = goal_callback

    def register_cancel_callback(self, cancel_callback: Callable[[ServerGoalHandle], Any]) -> None:
        """Set the callback that accepts or rejects requests to cancel a goal."""
        self._on_cancel = cancel_callback

    def register_handle_accepted_callback(
        self, handle_accepted_callback: Callable[[ServerGoalHandle], Any]
    ) -> None:
        """Set the callback that is called with each accepted goal's handle."""
        self._on_accepted = handle_accepted_callback

    def register_execute_callback(
        self, execute_callback: Callable[[ServerGoalHandle], Any]
    ) -> None:
        """Set the callback that executes accepted goals."""
        self._execute = execute_callback

    # On the loop's thread

    def arrived(self, goal: WorldGoal) -> None:
        """Queue a new goal for the executor; reject the goal if the queue is full."""
        goal.decided = asyncio.get_running_loop().create_future()
        if self.is_full:
            self._decide(goal, False)
            return
        self._goals = {one for one in self._goals if not one.done} | {goal}
        request = values.unpack(goal.request, self.type_.Goal)
        handle = ServerGoalHandle(self, goal, request)
        goal.on_cancel = lambda: self.put(lambda: self._consider_cancel(handle, goal))
        self.put(lambda: self._consider(handle, goal))

    def withdraw(self) -> None:
        """Close the server; reject goals that are not accepted yet."""
        for stop in self._stops:
            stop()
        for goal in self._goals:
            self._decide(goal, False)
            goal.decide_cancel(False)

    def _decide(self, goal: WorldGoal, accepted: bool) -> bool:
        """Accept or reject a goal, unless the server has decided about the goal before.

        The client receives the decision. A rejected goal ends.

        Returns:
            The first decision: whether the goal is accepted.
        """
        decided = goal.decided
        assert decided is not None
        if not decided.done():
            decided.set_result(accepted)
            if not accepted:
                goal.finish("aborted", self.type_.Result())
        return decided.result()

    # On the fiber

    async def _consider(self, handle: ServerGoalHandle, goal: WorldGoal) -> None:
        ask = self.node_state.program.ask
        try:
            response = await outcome(self._on_goal(handle.request))
        except Exception:
            # As in ROS 2, the exception ends the executor. Reject the goal, so that the client
            # does not wait for ever.
            ask(lambda: self._decide(goal, False))
            raise
        accepted = ask(lambda: self._decide(goal, response == GoalResponse.ACCEPT))
        if accepted:
            await outcome(self._on_accepted(handle))

    async def _consider_cancel(self, handle: ServerGoalHandle, goal: WorldGoal) -> None:
        accepted = False
        try:
            if handle.is_active:
                accepted = await outcome(self._on_cancel(handle)) == CancelResponse.ACCEPT
            if accepted:
                handle.is_cancel_requested = True
        finally:
            self.node_state.program.ask(lambda: goal.decide_cancel(accepted))

    def execute(self, handle: ServerGoalHandle, callback: Any = None) -> None:
        """Schedule the execution of a goal on the node's executor.

        Without `callback`, the server's callback is called with the handle.

        Raises:
            TftoolError: If the node has no executor.
        """
        chosen = callback or self._execute

        async def work() -> None:
            logger = self.node_state.ros_node.get_logger()
            try:
                result = await outcome(chosen(handle))
            except Exception as error:
                # As in ROS 2, the exception ends only the goal.
                logger.error(f"Error raised in execute callback: {error_sentence(error)}")
                result = self.type_.Result()
            if handle.is_active:
                logger.warning("Goal state not set, assuming aborted.")
            if not isinstance(result, self.type_.Result):
                text = f"an execute_callback must return {self.type_.__name__}.Result"
                logger.warning(f"{text}, not {type(result).__name__}")
                result = self.type_.Result()
            handle.finish(result)

        executor = self.node_state.executor
        if executor is None:
            raise TftoolError(
                "the goal cannot be executed, because its node has no executor: spin the node"
            )
        executor.create_task(work())
