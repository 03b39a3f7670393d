"""Hidden services and topics with which ROS 2 implements an action, for the actions of a world."""

import asyncio
from collections.abc import Callable, Coroutine
from typing import TYPE_CHECKING, Any, Final

from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.messages.classes import INTERFACES
from tftool.world.topics import GoalHandle

if TYPE_CHECKING:
    from tftool.world.world import World

KEPT: Final = 100
"""Largest number of goals stored for each action: running goals, and ended goals for late requests.
If this many goals are running, a new goal is rejected."""

CANCEL_GOAL: Final = "action_msgs/srv/CancelGoal"
STATUS: Final = "action_msgs/msg/GoalStatusArray"

ACTIVE: Final = {"executing": 2, "canceling": 3}
ENDED: Final = {"succeeded": 4, "canceled": 5, "aborted": 6}
"""Number in action_msgs/GoalStatus of each final state of a goal."""

_EVERY_GOAL = bytes(16)
_NO_ERROR, _REJECTED, _UNKNOWN_GOAL, _ENDED = 0, 1, 2, 3


class Tasks:
    """Set of running asyncio tasks, which are cancelled when their owner closes."""

    def __init__(self) -> None:
        self._tasks: set[asyncio.Task[None]] = set()

    def start(self, work: Coroutine[Any, Any, None]) -> None:
        """Run a coroutine concurrently, as a task of this set."""
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def cancel(self) -> None:
        """Cancel all tasks that are still running."""
        for task in tuple(self._tasks):
            task.cancel()


def message(ros_type: str, **fields: Any) -> Any:
    """Create a message by the full name of its type, such as "pkg/action/Go_SendGoal_Response"."""
    return INTERFACES.part(ros_type)(**fields)


def goal_id_message(goal_id: bytes) -> Any:
    """Convert a goal's id of 16 bytes to a UUID message."""
    return message("unique_identifier_msgs/msg/UUID", uuid=goal_id)


def goal_info(goal_id: bytes, accepted: Stamp) -> Any:
    """Return a GoalInfo message with a goal's id and the time of its acceptance."""
    return message(
        "action_msgs/msg/GoalInfo", goal_id=goal_id_message(goal_id), stamp=_time(accepted)
    )


def _time(stamp: Stamp) -> Any:
    sec, nanosec = divmod(stamp, NANOSECONDS)
    return message("builtin_interfaces/msg/Time", sec=sec, nanosec=nanosec)


class ActionParts:
    """Server of the services of one action (send_goal, cancel_goal, get_result) in ROS 2's form.

    The server tracks every goal that any client sends to the action in this world, and passes the
    contents of the topics `feedback` and `status` to callbacks.
    """

    def __init__(
        self,
        world: "World",
        name: str,
        interface: str,
        *,
        on_feedback: Callable[[Any], object],
        on_status: Callable[[Any], object],
        warn: Callable[[str], object],
    ) -> None:
        """Start to track an action's goals.

        Args:
            world: World with the action's server.
            name: Name of the action.
            interface: Type of the action, "package/action/Name".
            on_feedback: Function called with each FeedbackMessage.
            on_status: Function called with all goals' states when the state of a goal changes.
            warn: Function called with a sentence for the log.
        """
        self._world = world
        self._name = name
        self._type = interface
        self._on_feedback = on_feedback
        self._on_status = on_status
        self._warn = warn
        self._goals: dict[bytes, tuple[GoalHandle, Stamp]] = {}
        self._undecided: set[bytes] = set()
        self._tasks = Tasks()
        self._is_closed = False
        self._stop = world.watch_goals(name, self._follow, name)

    def close(self) -> None:
        """Stop tracking; goals that still run are not reported any more."""
        self._is_closed = True
        self._stop()
        self._tasks.cancel()

    def give_up(self) -> None:
        """Request the cancellation of all goals."""
        for goal, _ in self._goals.values():
            goal.cancel()

    async def send_goal(self, request: Any) -> Any:
        """Handle a SendGoal request; return the response when the action's server has decided."""
        goal_id = bytes(request.goal_id.uuid)
        now = self._world.clock.now()
        is_new = goal_id not in self._goals and goal_id not in self._undecided
        accepted = is_new and self._has_room()
        if accepted:
            # Deciding takes a while, during which a client may send the same goal again.
            self._undecided.add(goal_id)
            try:
                goal = self._world.send_goal(self._name, request.goal, goal_id=goal_id)
                accepted = await self._await_decision(goal)
            finally:
                self._undecided.discard(goal_id)
        return message(f"{self._type}_SendGoal_Response", accepted=accepted, stamp=_time(now))

    def _has_room(self) -> bool:
        """Return whether there is room for one more goal; ended goals are dropped first."""
        if self._drop_ended(len(self._undecided)) <= 0:
            return True
        self._warn(
            f"'{self._name}': {KEPT} goals run, which is the maximum: further goals are refused "
            "until one ends."
        )
        return False

    def _drop_ended(self, undecided: int) -> int:
        """Drop ended goals until one more goal is within the limit.

        Args:
            undecided: Number of goals on which the action's server has not decided yet.

        Returns:
            Number of goals that are still too many; 0 or less if the new goal is allowed.
        """
        surplus = len(self._goals) + undecided + 1 - KEPT
        ended = [goal_id for goal_id, (goal, _) in self._goals.items() if goal.done]
        for goal_id in ended[: max(0, surplus)]:
            del self._goals[goal_id]
        return surplus - len(ended)

    def _follow(self, goal: GoalHandle) -> None:
        def feed(feedback: Any) -> None:
            if not self._is_closed:
                self._on_feedback(
                    message(
                        f"{self._type}_FeedbackMessage",
                        goal_id=goal_id_message(goal.goal_id),
                        feedback=feedback,
                    )
                )

        goal.feeds.append(feed)
        self._tasks.start(self._see_through(goal))

    async def _see_through(self, goal: GoalHandle) -> None:
        if await self._await_decision(goal):
            await goal.result()
            self._publish_status()

    async def _await_decision(self, goal: GoalHandle) -> bool:
        """Wait until the action's server decides on a goal; track an accepted goal.

        Returns:
            Whether the goal was accepted.
        """
        if goal.decided is not None and not await asyncio.shield(goal.decided):
            return False
        if goal.goal_id not in self._goals:
            self._drop_ended(0)
            self._goals[goal.goal_id] = goal, self._world.clock.now()
            self._publish_status()
        return True

    async def cancel_goal(self, request: Any) -> Any:
        """Handle a CancelGoal request for one goal or all goals; return the response."""
        goal_id = bytes(request.goal_info.goal_id.uuid)
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
            goal_info(each, accepted) for each, goal, accepted in going if await goal.cancellation()
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
        return message(f"{CANCEL_GOAL}_Response", return_code=code, goals_canceling=canceled)

    async def get_result(self, request: Any) -> Any:
        """Handle a GetResult request: wait until the goal has ended; return the response."""
        goal, _ = self._goals.get(bytes(request.goal_id.uuid), (None, 0))
        answer = f"{self._type}_GetResult_Response"
        if goal is None:
            return message(answer)
        end = await goal.result()
        return message(answer, status=ENDED[end.status], result=end.value)

    def _publish_status(self) -> None:
        entries = []
        for goal_id, (goal, accepted) in self._goals.items():
            if not goal.done:
                number = ACTIVE["canceling" if goal.cancel_requested else "executing"]
            else:
                number = ENDED[goal.ended.status if goal.ended else "aborted"]
            entries.append(
                message(
                    "action_msgs/msg/GoalStatus",
                    goal_info=goal_info(goal_id, accepted),
                    status=number,
                )
            )
        self._on_status(message(STATUS, status_list=entries))
