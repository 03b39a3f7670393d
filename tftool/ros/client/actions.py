"""rclpy.action: clients and servers of actions."""

import asyncio
import inspect
import itertools
from collections import deque
from collections.abc import Callable
from enum import IntEnum
from typing import Any

from tftool.errors import TftoolError
from tftool.ros import values
from tftool.ros.client.entities import Entity, Work
from tftool.ros.client.futures import Future
from tftool.ros.client.node import Node
from tftool.ros.interfaces.classes import INTERFACES, duplicate
from tftool.runtime.topics import GoalHandle as WorldGoal
from tftool.runtime.topics import Status

_numbers = itertools.count(1)


class GoalResponse(IntEnum):
    """What a server says to a goal."""

    REJECT = 1
    ACCEPT = 2


class CancelResponse(IntEnum):
    """What a server says to a cancellation."""

    REJECT = 1
    ACCEPT = 2


class GoalStatus(IntEnum):
    """How far a goal is, as action_msgs numbers it."""

    STATUS_UNKNOWN = 0
    STATUS_ACCEPTED = 1
    STATUS_EXECUTING = 2
    STATUS_CANCELING = 3
    STATUS_SUCCEEDED = 4
    STATUS_CANCELED = 5
    STATUS_ABORTED = 6


_STATUS: dict[str, GoalStatus] = {
    "succeeded": GoalStatus.STATUS_SUCCEEDED,
    "canceled": GoalStatus.STATUS_CANCELED,
    "aborted": GoalStatus.STATUS_ABORTED,
}


def _new_id() -> Any:
    number = next(_numbers)
    kind = INTERFACES.message("unique_identifier_msgs/UUID")
    return kind(uuid=list(number.to_bytes(16, "big")))


class _Result:
    """What get_result answers: a status number and the result message."""

    def __init__(self, status: int, result: Any) -> None:
        self.status = status
        self.result = result


class _Feedback:
    """What a feedback callback is given."""

    def __init__(self, goal_id: Any, feedback: Any) -> None:
        self.goal_id = goal_id
        self.feedback = feedback


class _Cancelled:
    """What cancel_goal answers."""

    def __init__(self, goals: list[Any]) -> None:
        self.return_code = 0
        self.goals_canceling = goals


class ClientGoalHandle:
    """A goal, as the one who sent it holds it."""

    def __init__(self, client: "ActionClient", goal_id: Any, goal: WorldGoal | None) -> None:
        self._client = client
        self._goal = goal
        self.goal_id = goal_id
        self.accepted = goal is not None
        self.status = int(GoalStatus.STATUS_EXECUTING if goal else GoalStatus.STATUS_UNKNOWN)
        self._result: Future | None = None

    def get_result_async(self) -> Future:
        """A future of the result: `.status` and `.result`."""
        if self._result is None:
            self._result = self._client.watch(self, self._goal)
        return self._result

    def get_result(self) -> Any:
        """Block until the result is there."""
        future = self.get_result_async()
        self._client.node.wait_for(future, None)
        return future.result()

    def cancel_goal_async(self) -> Future:
        """Ask the server to stop; a future of its answer."""
        return self._client.cancel(self, self._goal)

    def cancel_goal(self) -> Any:
        """Ask the server to stop, and block until it has answered."""
        future = self.cancel_goal_async()
        self._client.node.wait_for(future, None)
        return future.result()


class ActionClient(Entity):
    """Sends goals to an action's server."""

    passes_busy_group = True

    def __init__(
        self,
        node: Node,
        action_type: Any,
        action_name: str,
        *,
        callback_group: Any = None,
        **profiles: Any,
    ) -> None:
        super().__init__(node, callback_group or node.default_callback_group)
        self._type = action_type
        self._name = action_name
        self.full = node._full(action_name)
        self._arrived: deque[Work] = deque()
        self._tasks: set[asyncio.Task[None]] = set()
        node.program.ask(lambda: node.add_entity(self))

    def server_is_ready(self) -> bool:
        """Whether somebody serves the action."""
        world = self.node.world
        ready = bool(self.node.program.ask(lambda: self.full in world.actions()))
        if not ready:
            self.node.program.looked_in_vain()
        return ready

    def wait_for_server(self, timeout_sec: float | None = None) -> bool:
        """Block until somebody serves it; whether somebody does."""
        return self.node.wait_until(lambda: self.full in self.node.world.actions(), timeout_sec)

    def send_goal_async(
        self,
        goal: Any,
        feedback_callback: Callable[[Any], Any] | None = None,
        goal_uuid: Any = None,
    ) -> Future:
        """Send a goal; a future of its `ClientGoalHandle`.

        Raises:
            TypeError: If the goal is of another type.
        """
        if not isinstance(goal, self._type.Goal):
            raise TypeError(f"Expected {self._type.Goal}, got {type(goal)}")
        future = Future(executor=self.node.executor)
        goal_id = goal_uuid or _new_id()
        copy = duplicate(goal)

        def on_feedback(value: Any) -> None:
            if feedback_callback is None:
                return
            message = values.unpack_part(self._type, "Feedback", value)
            told = feedback_callback
            self._put(lambda: told(_Feedback(goal_id, message)))

        async def send() -> None:
            world = self.node.world
            acceptor = world.actions().get(self.full)
            if acceptor is None:
                return
            served_here = getattr(acceptor, "serves_ros", False)
            value = copy if served_here else values.pack_part(self._type, "Goal", copy)
            try:
                handle = await world.send_goal(self.full, value, on_feedback)
            except TftoolError as error:
                refused = error
                self._put(lambda: future.set_exception(refused))
                return
            decided = getattr(handle, "decided", None)
            accepted = True if decided is None else await decided
            held = ClientGoalHandle(self, goal_id, handle if accepted else None)
            self._put(lambda: future.set_result(held))

        self._start(send())
        return future

    def send_goal(self, goal: Any, **kwargs: Any) -> Any:
        """Send a goal, and block until its result is there."""
        future = self.send_goal_async(goal, **kwargs)
        self.node.wait_for(future, None)
        handle = future.result()
        return None if handle is None or not handle.accepted else handle.get_result()

    def watch(self, handle: ClientGoalHandle, goal: WorldGoal | None) -> Future:
        """A future of a goal's end."""
        future = Future(executor=self.node.executor)

        async def wait() -> None:
            if goal is None:
                return
            end = await goal.result()
            status = _STATUS[end.status]
            result = values.unpack_part(self._type, "Result", end.value)

            def arrive() -> None:
                handle.status = int(status)
                future.set_result(_Result(int(status), result))

            self._put(arrive)

        self._start(wait())
        return future

    def cancel(self, handle: ClientGoalHandle, goal: WorldGoal | None) -> Future:
        """A future of the answer to a cancellation."""
        future = Future(executor=self.node.executor)

        def ask() -> None:
            going = goal is not None and not goal.done
            if goal is not None:
                goal.cancel()
                changed = getattr(goal, "on_cancel", None)
                if changed is not None and going:
                    changed()
            info: Any = INTERFACES.message("action_msgs/GoalInfo")(goal_id=handle.goal_id)
            self._put(lambda: future.set_result(_Cancelled([info] if going else [])))

        self.node.program.ask(ask)
        return future

    def destroy(self) -> None:
        """Send no more."""
        self.node.forget(self)

    def _start(self, coroutine: Any) -> None:
        def start() -> None:
            task = asyncio.get_running_loop().create_task(coroutine)
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)

        self.node.program.ask(start)

    def _put(self, work: Work) -> None:
        self._arrived.append(work)
        self.node.wake()

    def ready(self) -> bool:
        """Whether something arrived."""
        return bool(self._arrived)

    def take(self) -> Work:
        """What arrived first."""
        return self._arrived.popleft()

    def withdraw(self) -> None:
        """Wait for nothing any more."""
        super().withdraw()
        for task in list(self._tasks):
            task.cancel()


class ServerGoalHandle:
    """A goal, as its server holds it."""

    def __init__(self, server: "ActionServer", goal: WorldGoal, request: Any) -> None:
        self._server = server
        self._goal = goal
        self._request = request
        self._status: Status | None = None
        self._canceling = False
        self.goal_id = _new_id()

    @property
    def request(self) -> Any:
        """The goal message."""
        return self._request

    @property
    def is_active(self) -> bool:
        """Whether it has not ended."""
        return self._status is None and not self._goal.done

    @property
    def is_cancel_requested(self) -> bool:
        """Whether a cancellation was asked for and accepted."""
        return self._canceling

    @property
    def status(self) -> int:
        """How far it is, as a number of GoalStatus."""
        if self._status is not None:
            return int(_STATUS[self._status])
        return int(GoalStatus.STATUS_CANCELING if self._canceling else GoalStatus.STATUS_EXECUTING)

    def publish_feedback(self, feedback: Any) -> None:
        """Tell the client how far it is.

        Raises:
            TypeError: If the feedback is of another type.
        """
        kind = self._server.type_.Feedback
        if not isinstance(feedback, kind):
            raise TypeError(f"Expected {kind}, got {type(feedback)}")
        copy = duplicate(feedback)
        self._server.node.program.ask(lambda: self._goal.publish_feedback(copy))

    def succeed(self, response: Any = None) -> None:
        """It was reached."""
        self._end("succeeded")

    def abort(self, response: Any = None) -> None:
        """It was given up by the server."""
        self._end("aborted")

    def canceled(self, response: Any = None) -> None:
        """It was given up because the client said so."""
        self._end("canceled")

    def execute(self, execute_callback: Any = None) -> None:
        """Start working on it."""
        self._server.execute(self, execute_callback)

    def destroy(self) -> None:
        """Nothing to do."""

    def _end(self, status: Status) -> None:
        self._status = status

    def finish(self, result: Any) -> None:
        """Hand the result over."""
        status = self._status or "aborted"
        copy = duplicate(result)
        self._server.node.program.ask(lambda: self._goal.finish(status, copy))

    def request_cancel(self) -> None:
        """Note that the client wants it stopped."""
        self._canceling = True


class _Acceptor:
    """What the world hands goals to."""

    serves_ros = True

    def __init__(self, server: "ActionServer") -> None:
        self._server = server

    def __call__(self, goal: WorldGoal) -> None:
        self._server.arrived(goal)


class ActionServer(Entity):
    """Works on goals."""

    def __init__(
        self,
        node: Node,
        action_type: Any,
        action_name: str,
        execute_callback: Callable[[ServerGoalHandle], Any],
        *,
        callback_group: Any = None,
        goal_callback: Callable[[Any], Any] | None = None,
        handle_accepted_callback: Callable[[ServerGoalHandle], Any] | None = None,
        cancel_callback: Callable[[ServerGoalHandle], Any] | None = None,
        **profiles: Any,
    ) -> None:
        super().__init__(node, callback_group or node.default_callback_group)
        if not callable(execute_callback):
            raise TypeError("an action server needs an execute_callback")
        self.type_ = action_type
        self._execute = execute_callback
        self._on_goal = goal_callback or (lambda request: GoalResponse.ACCEPT)
        self._on_accepted = handle_accepted_callback or (lambda handle: handle.execute())
        self._on_cancel = cancel_callback or (lambda handle: CancelResponse.REJECT)
        self.full = node._full(action_name)
        self._arrived: deque[Work] = deque()
        self._stop: Callable[[], None] = lambda: None

        def serve() -> None:
            self._stop = node.world.serve_action(self.full, _Acceptor(self))
            node.add_entity(self)

        node.program.ask(serve)

    def register_goal_callback(self, callback: Callable[[Any], Any]) -> None:
        """Have `callback` decide about goals."""
        self._on_goal = callback

    def register_cancel_callback(self, callback: Callable[[ServerGoalHandle], Any]) -> None:
        """Have `callback` decide about cancellations."""
        self._on_cancel = callback

    def register_handle_accepted_callback(
        self, callback: Callable[[ServerGoalHandle], Any]
    ) -> None:
        """Have `callback` take accepted goals."""
        self._on_accepted = callback

    def register_execute_callback(self, callback: Callable[[ServerGoalHandle], Any]) -> None:
        """Have `callback` do the work."""
        self._execute = callback

    # On the loop's thread

    def arrived(self, goal: WorldGoal) -> None:
        """Keep a goal until an executor takes it."""
        held: Any = goal
        held.decided = asyncio.get_running_loop().create_future()
        request = values.unpack_part(self.type_, "Goal", goal.request)
        handle = ServerGoalHandle(self, goal, request)
        held.on_cancel = lambda: self._put(lambda: self._consider_cancel(handle))
        self._put(lambda: self._consider(handle, goal))

    def _put(self, work: Work) -> None:
        self._arrived.append(work)
        self.node.wake()

    def ready(self) -> bool:
        """Whether a goal or a cancellation waits."""
        return bool(self._arrived)

    def take(self) -> Work:
        """What arrived first."""
        return self._arrived.popleft()

    def withdraw(self) -> None:
        """Take no more goals."""
        super().withdraw()
        self._stop()

    # On the fiber

    def _consider(self, handle: ServerGoalHandle, goal: WorldGoal) -> None:
        accepted = self._on_goal(handle.request) == GoalResponse.ACCEPT

        def answer() -> None:
            held: Any = goal
            held.decided.set_result(accepted)
            if not accepted:
                goal.finish("aborted", self.type_.Result())

        self.node.program.ask(answer)
        if accepted:
            self._on_accepted(handle)

    def _consider_cancel(self, handle: ServerGoalHandle) -> None:
        if handle.is_active and self._on_cancel(handle) == CancelResponse.ACCEPT:
            handle.request_cancel()

    def execute(self, handle: ServerGoalHandle, callback: Any = None) -> None:
        """Work on a goal, on the executor of the node."""
        chosen = callback or self._execute

        async def work() -> None:
            result = chosen(handle)
            if inspect.isawaitable(result):
                result = await result
            if not isinstance(result, self.type_.Result):
                text = f"an execute_callback must return {self.type_.__name__}.Result"
                self.node.get_logger().warning(f"{text}, not {type(result).__name__}")
                result = self.type_.Result()
            handle.finish(result)

        executor = self.node.executor
        if executor is None:
            raise TftoolError("an action is executed by the executor that spins its node")
        executor.create_task(work())
