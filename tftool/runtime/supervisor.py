"""Start nodes, stop them, report the first failure."""

import asyncio

from tftool.errors import NodeFailed
from tftool.runtime.clock import Phase
from tftool.runtime.node import Node
from tftool.runtime.world import Supervision, World
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
        await supervisor.cancel()


class _Supervisor(Supervision):
    """The tasks of the nodes of one run."""

    def __init__(self, has_end: bool) -> None:
        self.over: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._has_end = has_end
        self._nodes: list[Node] = []
        self._tasks: dict[Node, asyncio.Task[None]] = {}

    def start(self, node: Node) -> None:
        self._nodes.append(node)
        self._tasks[node] = asyncio.get_running_loop().create_task(self._run(node), name=node.name)

    def end(self, node: Node) -> None:
        task = self._tasks.get(node)
        if task is not None:
            task.cancel()
        node.close()

    def stop(self) -> None:
        if not self.over.done():
            self.over.set_result(None)

    def fail(self, node: Node, error: BaseException) -> None:
        if not self.over.done():
            failure = NodeFailed(node.name, error)
            failure.__cause__ = error
            self.over.set_exception(failure)

    async def cancel(self) -> None:
        """Cancel what still runs, and wait for it; a failure on the way out counts too."""
        tasks = list(self._tasks.values())
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        for node in self._nodes:
            node.close()
        if self.over.done() and not self.over.cancelled():
            # Asked for here, so that a failure nobody awaited is not reported twice.
            self.over.exception()

    async def _run(self, node: Node) -> None:
        try:
            await node.run()
        except Exception as error:
            self.fail(node, error)
        finally:
            # What it subscribed to goes on: many nodes only listen.
            self._tasks.pop(node, None)
            if not self._tasks and not self._has_end:
                self.stop()
