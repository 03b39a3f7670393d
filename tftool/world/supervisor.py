"""Starting and stopping of a world's nodes, and the report of the first failure."""

import asyncio
from collections.abc import Callable, Coroutine
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from tftool.base.errors import NodeFailed, TftoolError, line_of
from tftool.base.stamps import Stamp, as_seconds
from tftool.world.clock import Clock, Phase, SimClock
from tftool.world.stopper import PATIENCE, Overdue, abandon, line_of_task

if TYPE_CHECKING:
    from tftool.world.world import World

T = TypeVar("T")


class Resident:
    """Base of a node, or of a user's program that contains nodes, in a world.

    A node imports and uses its world, but the world depends only on this base class.

    Attributes:
        name: Name, unique in the world.
        rank: Number in the order of joining; within a phase, lower numbers run first.
        is_shown: Whether lists of nodes show the name; false for a program, because its nodes are
            listed.
    """

    name: str
    rank: int
    is_shown: ClassVar[bool] = True

    async def run(self) -> None:
        """Do the resident's work; the resident ends when this coroutine returns."""

    def close(self) -> None:
        """Close the resident's services and subscriptions; called when the resident ends."""


async def live(world: "World", *, until: Stamp | None = None) -> None:
    """Run a world's nodes until the run ends.

    The run ends at `until` (after all timers of that instant), at `world.stop()`, or, without
    `until`, with the last node. Then the remaining nodes are cancelled, and their `finally` blocks
    are awaited.

    Args:
        world: World whose nodes run, including nodes that join later.
        until: Last time of the run, nanoseconds.

    Raises:
        NodeFailed: If a node raised an exception; the error names the first node that failed, with
            the exception as cause.
        BrokenPipeError: If a listener writes to a pipe whose reader has ended.
        ValueError: If the time `until` has passed; `until` is a stamp, not a duration.
    """
    clock = world.clock
    # In real time, `stamp` may be over before this call, which is allowed.
    earliest = clock.now() if isinstance(clock, SimClock) else clock.epoch
    if until is not None and until < earliest:
        raise ValueError(
            f"until={until} is {as_seconds(earliest - until):g} s in the past: 'until' is a "
            "stamp, such as world.clock.now() + seconds(10). For a duration, call "
            "world.run(seconds(10))"
        )
    supervisor = Supervisor(world.clock, until is not None)
    world._supervisor = supervisor
    if until is not None:
        world.clock.limit(until)
    end = None if until is None else world.clock.timer(until, Phase.END)
    if end is not None:
        end.add_done_callback(lambda _: supervisor.stop())
    try:
        # A copy of the list, because a starting node may add others, which start themselves.
        for node in list(world.nodes):
            supervisor.start(node)
        await supervisor.over
    finally:
        if end is not None:
            end.cancel()
        world.failure = supervisor.failure
        # Tasks and errors of a node that is ending are supervised, too.
        await supervisor.cancel()
        world._supervisor = None
        world.clock.limit(None)
        world.failure = supervisor.failure
        # Checked last, because a node may also fail while it ends, even after a cancelled run.
        if supervisor.failure is not None:
            raise supervisor.failure
    if supervisor.error is not None:
        raise supervisor.error


async def beside(
    work: Coroutine[Any, Any, T],
    helper: Coroutine[Any, Any, object],
    on_cancel: Callable[[], object] | None = None,
) -> T:
    """Await `work` while the coroutine `helper` runs; cancel `helper` when `work` ends.

    If `helper` ends first, `work` continues.

    Args:
        work: Coroutine whose result is returned.
        helper: Coroutine to run meanwhile; `helper` starts before `work`.
        on_cancel: Function called before `work` and `helper` are cancelled because the caller is
            cancelled.

    Returns:
        Result of `work`.

    Raises:
        Exception: Any exception of `work` or `helper`, also during their cancellation. An exception
            of `helper` ends `work`.
    """
    loop = asyncio.get_running_loop()
    helping = loop.create_task(helper)
    working = loop.create_task(work)
    both = {helping, working}
    try:
        await asyncio.wait(both, return_when=asyncio.FIRST_COMPLETED)
        # The helper ended first; its error, if any, is raised here.
        if not working.done():
            helping.result()
            await asyncio.wait({working})
    except asyncio.CancelledError:
        if on_cancel is not None:
            on_cancel()
        raise
    finally:
        for task in both:
            task.cancel()
        await asyncio.gather(*both, return_exceptions=True)
        for task in (helping, working):
            # An error while the work ends counts, even if the work was cancelled.
            if task.done() and not task.cancelled() and (error := task.exception()) is not None:
                raise error
    return working.result()


class Supervisor:
    """Supervisor of the tasks of the nodes in one run.

    Attributes:
        over: Future that is set when the run must end.
        failure: Error about the first node that failed; None if none failed.
        error: Error that ended the run, if no node raised the error; else None.
    """

    def __init__(self, clock: Clock, has_end: bool) -> None:
        self._clock = clock
        self.over: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self.failure: NodeFailed | None = None
        self.error: Exception | None = None
        self._has_end = has_end
        self._is_ending = False
        self._nodes: list[Resident] = []
        self._tasks: dict[asyncio.Task[Any], Resident] = {}

    def start(self, resident: Resident) -> None:
        """Start a resident (a node or a program) that has joined the world."""
        self._nodes.append(resident)
        self._start(resident, self._run(resident))

    def start_soon(
        self, resident: Resident, work: Coroutine[Any, Any, T]
    ) -> "asyncio.Task[T | None]":
        """Run a coroutine concurrently with a resident's `run`, as part of the resident."""
        task = self._start(resident, self._guarded(resident, work))
        # Cancelled before its first step, it would never have been awaited.
        task.add_done_callback(lambda _: work.close())
        return task

    def end(self, resident: Resident) -> None:
        """Cancel the tasks of a resident that leaves the world, and close the resident."""
        if resident in self._nodes:
            self._nodes.remove(resident)
        for task, owner in self._tasks.items():
            if owner is resident:
                task.cancel()
        resident.close()

    def stop(self) -> None:
        """End the run, by setting `over`."""
        if not self.over.done():
            self.over.set_result(None)

    def fail(self, resident: Resident, error: BaseException, what: str = "") -> None:
        """End the run because a resident raised `error`; only the first failure is reported.

        `what` replaces the text of the error in the report.
        """
        if self.failure is None:
            self.failure = NodeFailed(resident.name, error, what)
            self.failure.__cause__ = error
        self.stop()

    def _has_not_returned(self, resident: Resident, error: BaseException, line: str) -> None:
        line = f" ({line})" if line else ""
        what = f"has not returned {PATIENCE:g} s after the end of the run{line}"
        self.fail(resident, error, what)

    def end_by(self, error: Exception) -> None:
        """End the run because of an error that belongs to no node or program."""
        self.error = self.error or error
        self.stop()

    async def cancel(self) -> None:
        """Cancel all running tasks, and wait until they have ended."""
        self._is_ending = True
        while self._tasks:
            tasks = list(self._tasks)
            for task in tasks:
                task.cancel()
            for task in await self._clock.wait_for_end(tasks):
                self._has_not_returned(self._tasks[task], Overdue(), line_of_task(task))
                abandon(task)
            # Tasks that were started meanwhile are checked in the next round.
            for task in tasks:
                self._tasks.pop(task, None)
        for resident in self._nodes:
            resident.close()

    def _start(self, resident: Resident, work: Coroutine[Any, Any, T]) -> "asyncio.Task[T]":
        # The stopper finds the nodes among all tasks by this name.
        name = f"node '{resident.name}'"
        task = asyncio.get_running_loop().create_task(work, name=name)
        self._tasks[task] = resident
        # Not by a `finally` in the task, which does not run if the task never starts.
        task.add_done_callback(self._ended)
        return task

    async def _run(self, resident: Resident) -> None:
        try:
            await self._guarded(resident, resident.run())
        except asyncio.CancelledError:
            if resident in self._nodes and not self._is_ending:
                self.fail(resident, TftoolError("it awaited something that was cancelled"))
            raise

    async def _guarded(self, resident: Resident, work: Coroutine[Any, Any, T]) -> T | None:
        """Await a coroutine of a resident; an exception of `work` makes the resident fail."""
        try:
            return await work
        except Overdue as overdue:
            self._has_not_returned(resident, overdue, line_of(overdue, users_only=True))
        except (Exception, SystemExit, KeyboardInterrupt) as error:
            # The stopper handles signals, so this KeyboardInterrupt is raised by the node's code.
            self.fail(resident, error)
        return None

    def _ended(self, task: "asyncio.Task[Any]") -> None:
        # The node's subscriptions stay, because many nodes only have subscriptions.
        self._tasks.pop(task, None)
        if not self._tasks and not self._has_end:
            self.stop()
