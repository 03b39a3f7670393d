"""Executors of rclpy, which run the callbacks of nodes in a fixed order, and functions that spin.

The event loop's thread decides which callbacks are ready; the thread that spins runs them. Timers
run last within an instant of simulated time, so that a listener's timer sees all messages that the
simulator and the broadcasters sent in that instant.
"""

import asyncio
import inspect
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any

from tftool.base.stamps import Stamp, seconds
from tftool.ros.host import fibers, program
from tftool.ros.rclpy.context import Context, get_default_context
from tftool.ros.rclpy.entities import NodeEntity, Timer, Work
from tftool.ros.rclpy.futures import Future, Task
from tftool.ros.rclpy.node_parameters import warn_of_unused
from tftool.ros.rclpy.node_state import NodeState, state_of
from tftool.ros.rclpy.qos import QoSProfile

THREADS = 4
"""Default number of callbacks that a MultiThreadedExecutor runs at once, on every machine."""


class ExternalShutdownException(Exception):
    """Error raised by an executor that spins while its context is shut down elsewhere."""

    def __init__(self, *args: object) -> None:
        super().__init__("context has been shut down", *args)


class ShutdownException(Exception):
    """Error for using an executor that was shut down."""


class TimeoutException(Exception):
    """Error for an executor's wait that takes longer than the timeout."""


class ConditionReachedException(Exception):
    """Exception of rclpy for a condition that became true during a wait of an executor."""


class Executor:
    """Base class of executors, which run the callbacks of the nodes added to them.

    Attributes:
        spins_once: Whether `spin_once` is running now.
    """

    def __init__(self, *, context: Context | None = None) -> None:
        self._program = program.current()
        self._context = context or get_default_context()
        self._states: list[NodeState] = []
        self._batch: deque[NodeEntity] = deque()
        self._due: Stamp | None = None
        """Time of the next timer that may run, when no entity was ready; None without a timer."""
        self._tasks: deque[tuple[Task, Any]] = deque()
        """Tasks to continue, each with the callback group that the task occupies, or None."""
        self._has_released = False
        """Whether a callback of a group has ended since this executor last looked for work."""
        self._wakers: list[asyncio.Future[None]] = []
        self._reached: Stamp = 0
        self._over = False
        self.spins_once = False
        self._failure: BaseException | None = None
        self._leave_context = self._context.on_change(self._wake_from_anywhere)

    @property
    def context(self) -> Context:
        """Context whose shutdown makes this executor stop spinning."""
        return self._context

    def __enter__(self) -> "Executor":
        return self

    def __exit__(self, *args: object) -> None:
        self.shutdown()

    def add_node(self, node: Any) -> bool:
        """Add a node to this executor; return False if the node was already added."""
        state = state_of(node)
        if state in self._states:
            return False

        def add() -> None:
            self._states.append(state)
            state.executor = self
            state.was_served = True
            self.wake()

        self._program.ask(add)
        return True

    def remove_node(self, node: Any) -> None:
        """Remove a node from this executor."""
        state = state_of(node)

        def remove() -> None:
            if state in self._states:
                self._states.remove(state)
            if state.executor is self:
                state.executor = None
            self._batch = deque(one for one in self._batch if one.node_state is not state)
            self.wake()

        self._program.ask(remove)

    def get_nodes(self) -> list[Any]:
        """Return the nodes that were added to this executor."""
        return [state.ros_node for state in self._states]

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Shut the executor down and remove all its nodes; always return True."""
        if not self._over:
            self._over = True
            self._leave_context()
            self._wake_from_anywhere()
        for state in list(self._states):
            self.remove_node(state.ros_node)
        return True

    def create_task(self, callback: Any, *args: Any, **kwargs: Any) -> Task:
        """Schedule a callback or coroutine; return its `Task`, a future of the result."""
        task = Task(callback, args, kwargs, executor=self)
        self._schedule(task)
        return task

    def wake(self) -> None:
        """Wake the threads in which this executor waits for work.

        Call this in the event loop's thread.
        """
        for waker in self._wakers:
            if not waker.done():
                waker.set_result(None)

    # Spinning

    def spin(self) -> None:
        """Execute the nodes' callbacks until the executor or its context is shut down."""
        while self._context.ok() and not self._over:
            self._step(None)

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Wait until one callback of the nodes is ready, and execute the callback.

        Raises:
            ShutdownException: If the executor was shut down.
            ExternalShutdownException: If the context is shut down.
        """
        if self._over:
            raise ShutdownException
        if not self._context.ok():
            raise ExternalShutdownException
        self.spins_once = True
        try:
            self._step(self._deadline(timeout_sec))
        finally:
            self.spins_once = False

    def spin_until_future_complete(self, future: Future, timeout_sec: float | None = None) -> None:
        """Execute the nodes' callbacks until a future is done or the timeout has passed."""
        deadline = self._deadline(timeout_sec)
        future.watch(lambda _: self._wake_from_anywhere())
        while not (future.done() or future.cancelled()):
            if not self._context.ok() or self._over:
                return
            did_something = self._step(deadline, future)
            # All work that is due at the deadline is still done.
            if self._late(deadline) and (not did_something or self._late(deadline, by=1)):
                return

    def spin_once_until_future_complete(
        self, future: Future, timeout_sec: float | None = None
    ) -> None:
        """Wait for one callback and execute it; return at once if the future is done first."""
        if not (future.done() or future.cancelled()):
            future.watch(lambda _: self._wake_from_anywhere())
            self._step(self._deadline(timeout_sec), future)

    def _deadline(self, timeout_sec: float | None) -> Stamp | None:
        if timeout_sec is None or timeout_sec < 0:
            return None
        return self._program.clock.now() + seconds(timeout_sec)

    def _late(self, deadline: Stamp | None, by: int = 0) -> bool:
        return deadline is not None and deadline + by <= self._program.clock.now()

    def _step(self, deadline: Stamp | None, future: Future | None = None) -> bool:
        """Wait for one callback and execute it; return whether a callback was executed.

        The wait ends at the time `deadline`, when `future` is done, and at a shutdown.
        """
        if self._tasks:
            self._advance(*self._tasks.popleft())
            return True
        found = self._program.ask(partial(self._next, deadline, future))
        self._raise_failure()
        if found is None:
            self._program.count_failed_query()
            return False
        entity, work = found
        group = None if entity.passes_busy_group else entity.callback_group
        try:
            value = work()
        except BaseException:
            self._release(group)
            raise
        if inspect.iscoroutine(value):
            self._advance(Task(value, executor=self), group)
        else:
            self._release(group)
        return True

    def _raise_failure(self) -> None:
        """Raise the exception that a callback has raised in a worker thread, if there is one."""
        failure, self._failure = self._failure, None
        if failure is not None:
            raise failure

    def _release(self, group: Any) -> None:
        if group is not None:
            group.ending_execution(None)
            self._has_released = True

    def _advance(self, task: Task, group: Any) -> None:
        waits_for = task()
        if task.done() or task.cancelled():
            self._release(group)
            error = task.exception()
            if error is not None:
                raise error
        elif isinstance(waits_for, Future):
            waits_for.watch(lambda _: self._schedule(task, group))
        else:
            self._schedule(task, group)

    def _schedule(self, task: Task, group: Any = None) -> None:
        self._tasks.append((task, group))
        self._wake_from_anywhere()

    def _wake_from_anywhere(self) -> None:
        # A spinning thread registers its waker before it looks for work.
        if self._wakers:
            self._program.ask(self.wake)

    # On the loop's thread.

    async def _next(
        self, deadline: Stamp | None, future: Future | None, takes: bool = True
    ) -> tuple[NodeEntity, Work] | None:
        """Wait for work; return the work and the entity that it belongs to.

        Args:
            deadline: Time at which the wait ends; None for no limit.
            future: Future whose completion ends the wait; None for no future.
            takes: Whether to wait for work. If false, only the deadline, the future, a shutdown or
                an error in a worker thread ends the wait.

        Returns:
            Entity and work; None if the wait ended without work.
        """
        clock = self._program.clock
        if self._has_released:
            self._has_released = False
            self.wake()
        while True:
            # Register the waker before the search for work, so that work which another thread adds
            # during the search wakes this thread.
            waker: asyncio.Future[None] = asyncio.get_running_loop().create_future()
            self._wakers.append(waker)
            try:
                found = self._take() if takes else None
                if found is not None:
                    return found
                if (
                    (takes and self._tasks)
                    or self._over
                    or self._failure is not None
                    or not self._context.ok()
                    or (future is not None and (future.done() or future.cancelled()))
                    or (deadline is not None and deadline <= clock.now())
                ):
                    return None
                due = self._due if takes else None
                if deadline is not None and (due is None or deadline < due):
                    due = deadline
                await self._pause(waker, due)
            finally:
                self._wakers.remove(waker)

    def _take(self) -> tuple[NodeEntity, Work] | None:
        """Return the next ready entity and its work.

        If no entity is ready, return None, and store the time of the next timer in `_due`.
        """
        for collected in (False, True):
            if collected:
                self._collect()
            while self._batch:
                entity = self._batch.popleft()
                if self._is_ready(entity):
                    if entity.callback_group is not None and not entity.passes_busy_group:
                        entity.callback_group.beginning_execution(entity)
                    return entity, entity.take()
        return None

    def _collect(self) -> None:
        """Append the ready entities of all nodes to `_batch`, the entities to run next.

        Each node's timers come before the node's other entities.
        """
        self._due = None
        for state in list(self._states):
            for entity in state.entities:
                if not isinstance(entity, Timer):
                    continue
                # A timer of another source of time wakes the executor when this time is set.
                is_timed = not (entity.is_canceled() or entity.clock.is_overridden)
                if self._is_ready(entity):
                    self._batch.append(entity)
                elif is_timed and self._may_run(entity):
                    self._due = entity.due if self._due is None else min(entity.due, self._due)
            for entity in state.entities:
                if not isinstance(entity, Timer) and self._is_ready(entity):
                    self._batch.append(entity)

    def _is_ready(self, entity: NodeEntity) -> bool:
        # Most entities have no work, so this condition is tested first.
        if not entity.ready() or not self._may_run(entity):
            return False
        if not (isinstance(entity, Timer) and self._program.strict) or entity.clock.is_overridden:
            return True
        # At the instant when a timer is due, it waits for its turn among the world's nodes.
        return entity.due <= self._reached or entity.due < self._program.clock.now()

    def _may_run(self, entity: NodeEntity) -> bool:
        """Return whether this executor, and the callback group, permit an entity to run now."""
        if entity.only_ends_spin_once and not self.spins_once:
            return False
        group = entity.callback_group
        return group is None or entity.passes_busy_group or bool(group.can_execute(entity))

    async def _pause(self, waker: "asyncio.Future[None]", due: Stamp | None) -> None:
        """Wait until the future `waker` is done, or until the time `due`; None for no limit."""
        owner = self._program
        if due is None:
            await waker
            return
        timer = owner.clock.timer(due, owner.turn, owner.rank)
        timer.add_done_callback(partial(fibers.finish, waker))
        try:
            await waker
        finally:
            if timer.done():
                self._reached = max(self._reached, owner.clock.now())
            timer.cancel()


class SingleThreadedExecutor(Executor):
    """Executor that runs one callback at a time, in the thread that spins."""


class MultiThreadedExecutor(Executor):
    """Executor that runs callbacks at the same time if their callback groups permit it.

    Worker threads run the callbacks, never the thread that spins. A long callback therefore does
    not delay the return of `spin_until_future_complete` once the future is done, as in ROS 2.
    """

    def __init__(self, num_threads: int | None = None, *, context: Context | None = None) -> None:
        super().__init__(context=context)
        self._threads = max(1, num_threads or THREADS)
        self._workers = 0
        self._let_go: Future | None = None
        """Future that is done when the last worker has stopped; None without workers."""

    def spin(self) -> None:
        """Execute the nodes' callbacks until the executor or its context is shut down."""
        self._lead(Future(), None)

    def spin_until_future_complete(self, future: Future, timeout_sec: float | None = None) -> None:
        """Execute the nodes' callbacks until a future is done or the timeout has passed."""
        if self._let_go is not None:
            # A callback waits for the future, and may occupy the last worker thread.
            super().spin_until_future_complete(future, timeout_sec)
        else:
            self._lead(future, self._deadline(timeout_sec))

    def _lead(self, future: Future, deadline: Stamp | None) -> None:
        """Let worker threads run callbacks until `future` is done or the deadline passes."""
        future.watch(lambda _: self._wake_from_anywhere())
        let_go = self._let_go = Future()
        self._program.ask(lambda: self._hire(let_go))
        try:
            while not (future.done() or future.cancelled() or self._late(deadline)):
                if not self._context.ok() or self._over:
                    return
                self._program.ask(partial(self._next, deadline, future, takes=False))
                self._raise_failure()
        finally:
            self._let_go = None
            let_go.set_result(None)

    def _hire(self, let_go: Future) -> None:
        def work() -> None:
            try:
                Executor.spin_until_future_complete(self, let_go)
            except KeyboardInterrupt:
                pass
            except BaseException as error:
                self._failure = error
            finally:
                self._program.ask(left)

        def left() -> None:
            self._workers -= 1
            if self._let_go is not None and self._let_go is not let_go:
                # This worker was still busy when another spin began, which needs a new worker.
                self._hire(self._let_go)
            self.wake()

        for number in range(self._workers, self._threads):
            self._workers += 1
            name = f"{self._program.name}#{number + 1}"
            self._program.start_fiber(self._program.new_fiber(name, work))


def get_global_executor(owner: "program.Program | None" = None) -> Executor:
    """Return the executor that `spin` uses by default; create the executor at the first call."""
    owner = owner or program.current()
    if owner.executor is None:
        owner.executor = SingleThreadedExecutor()
    executor: Executor = owner.executor
    return executor


@contextmanager
def serving(executor: Any, node: Any) -> Iterator[None]:
    """Add a node to an executor during the `with` block.

    A node that was already added before the block remains in the executor.
    """
    added = executor.add_node(node)
    try:
        yield
    finally:
        if added:
            executor.remove_node(node)


def wait_for(state: NodeState, future: Future, timeout_sec: float | None = None) -> Any:
    """Execute a node's callbacks until a future is done or the timeout passes.

    `timeout_sec` is the longest wait in seconds; None for no limit.

    Returns:
        Result of the future; None if the future is not done in time.
    """
    executor = state.executor or get_global_executor(state.program)
    if state.executor is None and executor.context is not state.context:
        with SingleThreadedExecutor(context=state.context) as executor:
            executor.add_node(state.ros_node)
            executor.spin_until_future_complete(future, timeout_sec)
    else:
        with serving(executor, state.ros_node):
            executor.spin_until_future_complete(future, timeout_sec)
    return future.result()


def spin(node: Any, executor: Executor | None = None) -> None:
    """Execute a node's callbacks until rclpy is shut down."""
    chosen = executor or get_global_executor()
    with serving(chosen, node):
        warn_of_unused(node)
        chosen.spin()


def spin_once(
    node: Any, *, executor: Executor | None = None, timeout_sec: float | None = None
) -> None:
    """Wait until one callback of a node is ready, and execute the callback."""
    chosen = executor or get_global_executor()
    with serving(chosen, node):
        chosen.spin_once(timeout_sec)


def spin_until_future_complete(
    node: Any, future: Future, executor: Executor | None = None, timeout_sec: float | None = None
) -> None:
    """Execute a node's callbacks until a future is done or the timeout has passed.

    Unlike in ROS 2, a callback may call this function.
    """
    chosen = executor or node.executor or get_global_executor()
    with serving(chosen, node):
        chosen.spin_until_future_complete(future, timeout_sec)


def wait_for_message(
    msg_type: Any,
    node: Any,
    topic: str,
    *,
    qos_profile: QoSProfile | int = 1,
    time_to_wait: float = -1,
) -> tuple[bool, Any]:
    """Block until a topic's next message arrives.

    `time_to_wait` is the longest wait in seconds; negative for no limit.

    Returns:
        (True, the message); (False, None) at the timeout or if rclpy was shut down.
    """
    arrived = Future()

    def keep(message: Any) -> None:
        if not arrived.done():
            arrived.set_result(message)

    subscription = node.create_subscription(msg_type, topic, keep, qos_profile)
    # The waiting callback may prevent the node's other callbacks from running.
    subscription.passes_busy_group = True
    try:
        wait_for(state_of(node), arrived, None if time_to_wait < 0 else time_to_wait)
    finally:
        node.destroy_subscription(subscription)
    return arrived.done(), arrived.result()
