"""Start nodes, stop them, report the first failure."""

import asyncio

from tftool.errors import NodeFailed
from tftool.runtime.clock import Phase
from tftool.runtime.resident import Resident, Supervision
from tftool.runtime.world import World
from tftool.stamps import Stamp


async def live(world: World, *, until: Stamp | None = None) -> None:
    """Let a world's nodes run until an end is reached.

    The end is `until` (everything due in that instant still happens), `world.stop()`,
    or, without `until`, the return of the last node. Whatever still runs then is
    cancelled, and its `finally` waited for.

    Args:
        world: Whose nodes to run, those that join later included.
        until: The last moment to live through.

    Raises:
        NodeFailed: If a node raised; the first one is named, its error is the cause.
    """
    supervisor = _Supervisor(until is not None)
    world.supervise(supervisor)
    end = None if until is None else world.clock.timer(until, Phase.END)
    if end is not None:
        end.add_done_callback(lambda _: supervisor.stop())
    try:
        for node in list(world.nodes):
            supervisor.start(node)
        await supervisor.over
    finally:
        world.supervise(None)
        if end is not None:
            end.cancel()
        world.failure = supervisor.failure
        await supervisor.cancel()
    # Asked last: a node may also fail on its way out.
    if supervisor.failure is not None:
        raise supervisor.failure


class _Supervisor(Supervision):
    """The tasks of the nodes of one run."""

    def __init__(self, has_end: bool) -> None:
        self.over: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self.failure: NodeFailed | None = None
        self._has_end = has_end
        self._nodes: list[Resident] = []
        self._tasks: dict[Resident, asyncio.Task[None]] = {}

    def start(self, resident: Resident) -> None:
        self._nodes.append(resident)
        task = asyncio.get_running_loop().create_task(self._run(resident), name=resident.name)
        self._tasks[resident] = task
        # Not by a `finally` in it: one that leaves as it comes never gets so far as to begin.
        task.add_done_callback(lambda _: self._ended(resident))

    def end(self, resident: Resident) -> None:
        task = self._tasks.get(resident)
        if task is not None:
            task.cancel()
        if resident in self._nodes:
            self._nodes.remove(resident)
        resident.close()

    def stop(self) -> None:
        if not self.over.done():
            self.over.set_result(None)

    def fail(self, resident: Resident, error: BaseException) -> None:
        if self.failure is None:
            self.failure = NodeFailed(resident.name, error)
            self.failure.__cause__ = error
        self.stop()

    async def cancel(self) -> None:
        """Cancel what still runs, and wait for it."""
        tasks = list(self._tasks.values())
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        for resident in self._nodes:
            resident.close()

    async def _run(self, resident: Resident) -> None:
        try:
            await resident.run()
        except Exception as error:
            self.fail(resident, error)

    def _ended(self, resident: Resident) -> None:
        # What it subscribed to goes on: many nodes only listen.
        self._tasks.pop(resident, None)
        if not self._tasks and not self._has_end:
            self.stop()
