"""rclpy's executors: they take what is ready, in a fixed order, and call the callbacks.

What is ready is decided on the loop's thread; the callbacks run on the fiber that
spins. Timers wait for their turn within an instant, so a listener's timer sees all
that the simulator and the broadcasters of that instant have said.
"""

import asyncio
import inspect
from collections import deque
from collections.abc import Iterator
from typing import Any

from tftool.ros import program
from tftool.ros.client.context import Context, context_of
from tftool.ros.client.entities import Entity, Work
from tftool.ros.client.exceptions import ExternalShutdownException, ShutdownException
from tftool.ros.client.futures import Future, Task
from tftool.ros.client.member import Member, member_of
from tftool.ros.client.timers import Timer
from tftool.stamps import Stamp, seconds

THREADS = 4
"""How many callbacks a MultiThreadedExecutor runs at once unless told; the same everywhere."""


class Executor:
    """Calls the callbacks of its nodes."""

    def __init__(self, *, context: Context | None = None) -> None:
        self._program = program.current()
        self._context = context or context_of(self._program)
        self._members: list[Member] = []
        self._batch: deque[Entity] = deque()
        self._tasks: deque[Task] = deque()
        self._finished: deque[Any] = deque()
        self._wakers: list[asyncio.Future[None]] = []
        self._reached: Stamp = 0
        self._over = False
        self._failure: BaseException | None = None
        self._context.on_change(self._wake_from_anywhere)

    @property
    def context(self) -> Context:
        """Whose shutdown ends it."""
        return self._context

    def __enter__(self) -> "Executor":
        return self

    def __exit__(self, *args: object) -> None:
        self.shutdown()

    def add_node(self, node: Any) -> bool:
        """Serve a node too; False if it is served already."""
        return self.serve(member_of(node))

    def remove_node(self, node: Any) -> None:
        """Serve a node no more."""
        self.leave(member_of(node))

    def get_nodes(self) -> list[Any]:
        """The nodes it serves."""
        return [member.face for member in self._members]

    def serve(self, member: Member) -> bool:
        """Serve a node's things too; False if they are served already."""
        if member in self._members:
            return False

        def add() -> None:
            self._members.append(member)
            member.executor = self
            self.wake()

        self._program.ask(add)
        return True

    def leave(self, member: Member) -> None:
        """Serve a node's things no more."""

        def remove() -> None:
            if member in self._members:
                self._members.remove(member)
            if member.executor is self:
                member.executor = None
            self._batch = deque(one for one in self._batch if one.member is not member)
            self.wake()

        self._program.ask(remove)

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Serve nobody any more."""
        self._over = True
        for member in list(self._members):
            self.leave(member)
        return True

    def create_task(self, callback: Any, *args: Any, **kwargs: Any) -> Task:
        """Run a callback or a coroutine soon; a future of its outcome."""
        task = Task(callback, args, kwargs, executor=self)
        self._schedule(task)
        return task

    def wake(self) -> None:
        """Look again (on the loop's thread)."""
        for waker in self._wakers:
            if not waker.done():
                waker.set_result(None)

    # Spinning

    def spin(self) -> None:
        """Serve until shutdown."""
        while self._context.ok() and not self._over:
            self._step(None)

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Wait for one thing to do, and do it.

        Raises:
            ShutdownException: If the executor was shut down.
            ExternalShutdownException: If the context is shut down.
        """
        if self._over:
            raise ShutdownException
        if not self._context.ok():
            raise ExternalShutdownException
        self._step(self._deadline(timeout_sec))

    def spin_until_future_complete(self, future: Future, timeout_sec: float | None = None) -> None:
        """Serve until a future is done, or the time is up."""
        deadline = self._deadline(timeout_sec)
        future.add_done_callback(lambda _: self._wake_from_anywhere())
        while not (future.done() or future.cancelled()):
            if not self._context.ok() or self._over:
                return
            did_something = self._step(deadline, future)
            # What is due at the deadline itself is still done, however much it is.
            if self._late(deadline) and (not did_something or self._late(deadline, by=1)):
                return

    def spin_once_until_future_complete(
        self, future: Future, timeout_sec: float | None = None
    ) -> None:
        """Wait for one thing to do, or for a future."""
        if not (future.done() or future.cancelled()):
            future.add_done_callback(lambda _: self._wake_from_anywhere())
            self._step(self._deadline(timeout_sec), future)

    def _deadline(self, timeout_sec: float | None) -> Stamp | None:
        if timeout_sec is None or timeout_sec < 0:
            return None
        return self._program.clock.now() + seconds(timeout_sec)

    def _late(self, deadline: Stamp | None, by: int = 0) -> bool:
        return deadline is not None and deadline + by <= self._program.clock.now()

    def _step(self, deadline: Stamp | None, future: Future | None = None) -> bool:
        """Do one thing; False when the time was up or there was another reason to look up."""
        if self._tasks:
            self._advance(self._tasks.popleft(), None)
            return True
        found = self._program.ask(lambda: self._next(deadline, future))
        if self._failure is not None:
            failure, self._failure = self._failure, None
            raise failure
        if found is None:
            self._program.looked_in_vain()
            return False
        entity, work = found
        group = entity.callback_group
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

    def _release(self, group: Any) -> None:
        if group is not None:
            group.ending_execution(None)
            self._finished.append(group)

    def _advance(self, task: Task, group: Any) -> None:
        waits_for = task()
        if task.done() or task.cancelled():
            self._release(group)
            error = task.exception()
            if error is not None:
                raise error
        elif isinstance(waits_for, Future):
            waits_for.add_done_callback(lambda _: self._schedule(task, group))
        else:
            self._schedule(task, group)

    def _schedule(self, task: Task, group: Any = None) -> None:
        if group is None:
            self._tasks.append(task)
        else:
            self._tasks.append(_Continued(task, group, self))
        self._wake_from_anywhere()

    def _wake_from_anywhere(self) -> None:
        # Nobody waits: whoever spins looks before it waits.
        if self._wakers:
            self._program.ask(self.wake)

    # On the loop's thread.

    async def _next(
        self, deadline: Stamp | None, future: Future | None
    ) -> tuple[Entity, Work] | None:
        """The next thing to do; None when there is another reason to look up."""
        clock = self._program.clock
        if self._finished:
            self._finished.clear()
            self.wake()
        while True:
            found = self._take()
            if found is not None:
                return found
            if (
                self._tasks
                or self._over
                or self._failure is not None
                or not self._context.ok()
                or (future is not None and (future.done() or future.cancelled()))
                or (deadline is not None and deadline <= clock.now())
            ):
                return None
            due = self._due()
            if deadline is not None and (due is None or deadline < due):
                due = deadline
            await self._pause(due)

    def _take(self) -> tuple[Entity, Work] | None:
        for collected in (False, True):
            if collected:
                self._batch = deque(filter(self._is_ready, self._entities()))
            while self._batch:
                entity = self._batch.popleft()
                if self._is_ready(entity):
                    if entity.callback_group is not None:
                        entity.callback_group.beginning_execution(entity)
                    return entity, entity.take()
        return None

    def _entities(self) -> Iterator[Entity]:
        """Everything that can become ready, in the order it is served: timers come first."""
        for member in list(self._members):
            yield from (one for one in member.entities if isinstance(one, Timer))
            yield from (one for one in member.entities if not isinstance(one, Timer))

    def _is_ready(self, entity: Entity) -> bool:
        if isinstance(entity, Timer) and self._program.strict and not self._has_turn(entity.due):
            return False
        return entity.ready() and self._may_run(entity)

    def _has_turn(self, due: Stamp) -> bool:
        return due <= self._reached or due < self._program.clock.now()

    def _may_run(self, entity: Entity) -> bool:
        group = entity.callback_group
        return group is None or entity.passes_busy_group or bool(group.can_execute(entity))

    def _due(self) -> Stamp | None:
        moments = [
            entity.due
            for entity in self._entities()
            if isinstance(entity, Timer) and not entity.is_canceled() and self._may_run(entity)
        ]
        return min(moments, default=None)

    async def _pause(self, due: Stamp | None) -> None:
        """Wait for something to arrive, or for a moment's turn."""
        owner = self._program
        waker: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._wakers.append(waker)
        timer = None if due is None else owner.clock.timer(due, owner.turn, owner.rank)

        def reached(future: "asyncio.Future[None]") -> None:
            if not future.cancelled():
                self._reached = max(self._reached, owner.clock.now())
                if not waker.done():
                    waker.set_result(None)

        if timer is not None:
            timer.add_done_callback(reached)
        try:
            await waker
        finally:
            self._wakers.remove(waker)
            if timer is not None:
                timer.cancel()


class _Continued(Task):
    """A callback's coroutine that goes on; its group is busy until it has ended."""

    def __init__(self, task: Task, group: Any, executor: Executor) -> None:
        super().__init__(lambda: None, executor=executor)
        self._task = task
        self._group = group
        self._owner = executor

    def __call__(self) -> Any:
        self._owner._advance(self._task, self._group)
        self.set_result(None)
        return None


class SingleThreadedExecutor(Executor):
    """One callback at a time."""


class MultiThreadedExecutor(Executor):
    """Several callbacks at a time, as far as their groups allow, each on a fiber of its own."""

    def __init__(self, num_threads: int | None = None, *, context: Context | None = None) -> None:
        super().__init__(context=context)
        self._threads = max(1, num_threads or THREADS)
        self._workers = 0

    def spin(self) -> None:
        """Serve until shutdown."""
        self._hire()
        super().spin()

    def spin_until_future_complete(self, future: Future, timeout_sec: float | None = None) -> None:
        """Serve until a future is done, or the time is up."""
        self._hire()
        super().spin_until_future_complete(future, timeout_sec)

    def _hire(self) -> None:
        def work() -> None:
            try:
                Executor.spin(self)
            except KeyboardInterrupt:
                pass
            except BaseException as error:
                self._failure = error
                self._program.ask(self.wake)

        def start() -> None:
            while self._workers < self._threads - 1:
                self._workers += 1
                name = f"{self._program.name}#{self._workers}"
                self._program.start_fiber(self._program.new_fiber(name, work))

        self._program.ask(start)


def executor_of(owner: "program.Program") -> Executor:
    """The executor that `rclpy.spin` uses."""
    if owner.executor is None:
        owner.executor = SingleThreadedExecutor()
    return owner.executor  # type: ignore[no-any-return]


def wait_for(member: Member, future: Future, timeout_sec: float | None) -> None:
    """Block until a future is done, serving the node meanwhile if nobody else does."""
    executor = member.executor or executor_of(member.program)
    added = executor.serve(member)
    try:
        executor.spin_until_future_complete(future, timeout_sec)
    finally:
        if added:
            executor.leave(member)
