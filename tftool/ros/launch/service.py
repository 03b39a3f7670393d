"""Class LaunchService of ROS's launch, with which a Python program runs launch descriptions."""

import asyncio
import sys
import threading
from collections.abc import Coroutine, Sequence
from typing import Any

from tftool.base.stamps import as_seconds
from tftool.ros.host import program
from tftool.ros.host.shims import SLICE
from tftool.ros.host.workspace import Workspace
from tftool.ros.launch.actions import IncludeLaunchDescription
from tftool.ros.launch.arguments import find_launch_file, parse_arguments
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import LaunchDescription
from tftool.ros.launch.engine import Launch
from tftool.ros.launch.events import Event


class LaunchService:
    """Service that runs launch descriptions inside the program that created the service."""

    def __init__(
        self, *, argv: Any = None, noninteractive: bool = False, debug: bool = False
    ) -> None:
        self.context = LaunchContext(argv=argv)
        self._entities: list[Any] = []
        self._launch: Launch | None = None
        self._owner: program.Program | None = None
        self._threads: set[int] = set()  # threads whose callers get a coroutine
        self.errors: list[str] = []  # of the launch itself and of its processes

    def include_launch_description(self, launch_description: LaunchDescription) -> None:
        """Add a launch description for the next `run`; if the launch is running, execute it now."""
        launch = self._launch
        if launch is None or self._owner is None:
            self._entities.append(launch_description)
        else:
            self._owner.ask(lambda: launch.do([launch_description]))

    def run(self, *, shutdown_when_idle: bool = True) -> int:
        """Execute the launch descriptions; block until everything that they started has ended.

        Returns:
            Exit status: 0, or 1 if the launch or one of its processes failed.
        """
        self.begin(keep_alive=not shutdown_when_idle)
        return self.wait()

    def wait(self) -> int:
        """Block until the launch that `begin` started has ended.

        Returns:
            Exit status: 0, or 1 if the launch or one of its processes failed.
        """
        launch = self._launch
        if launch is None:
            return 0
        try:
            program.current().ask(launch.ended.wait)
        except KeyboardInterrupt:
            self._end(launch)
            raise
        return int(bool(launch.failed))

    def begin(self, *, keep_alive: bool = False) -> Launch:
        """Start the launch and return it at once.

        With `keep_alive`, the launch continues after its last process has ended.
        """
        self._owner = owner = program.current()

        def say(level: str, who: str, text: str) -> None:
            if level == "ERROR":
                self.errors.append(f"{who}: {text}")
            sys.stderr.write(f"[{level}] [{who}]: {text}\n" if level else f"[{who}] {text}\n")

        def start() -> list[Launch]:
            name = owner.world.free_name("launch")
            description = LaunchDescription(self._entities)
            made = Launch(
                owner.world,
                description,
                context=self.context,
                say=say,
                name=name,
                contained=True,
                keep_alive=keep_alive,
            )
            self._threads = {threading.get_ident()}
            return [made]

        (self._launch,) = owner.ask(start)
        return self._launch

    async def run_async(self, *, shutdown_when_idle: bool = True) -> int:
        """Run the launch in a coroutine until the launch has ended; return its exit status, 0 or 1.

        Cancelling the coroutine ends the launch.
        """
        launch = self.begin(keep_alive=not shutdown_when_idle)
        self._threads.add(threading.get_ident())
        try:
            while not launch.ended.is_set():
                # The event loop belongs to the user, and its time is the world's.
                await asyncio.sleep(as_seconds(SLICE))  # noqa: TID251
        except asyncio.CancelledError:
            self._end(launch)
            raise
        return int(bool(launch.failed))

    @property
    def failed_itself(self) -> bool:
        """Whether the launch itself has failed, for example by an error in a description."""
        return self._launch is not None and "launch" in self._launch.failed

    def emit_event(self, event: Event) -> None:
        """Pass an event to the launch's event handlers, if the launch is running."""
        launch = self._launch
        if launch is not None and self._owner is not None:
            self._owner.ask(lambda: launch.emit(event))

    def shutdown(self, force_sync: bool = False) -> Coroutine[Any, Any, None] | None:
        """End the launch, if it is running.

        Args:
            force_sync: Whether to return None even in the thread of the launch's event loop.

        Returns:
            As in ROS 2, a coroutine to await if called in the thread of the launch's event loop;
            None in other threads, and if no launch is running.
        """
        launch = self._launch
        if launch is None or launch.ended.is_set():
            return None
        self._end(launch)
        awaits = not force_sync and threading.get_ident() in self._threads
        return _nothing() if awaits else None

    def _end(self, launch: Launch) -> None:
        # Functions of a launch file run on the event loop's thread, which belongs to no program.
        if self._owner is not None:
            self._owner.ask(lambda: launch.shut_down("the program asked for it"))


def run_launch_file(workspace: Workspace, words: Sequence[str]) -> None:
    """Run `ros2 launch WORDS` inside the calling program, until the launch has ended.

    Raises:
        UsageError: If there is no such launch file, or the arguments are malformed.
        SystemExit: If the launch failed.
    """
    path, rest = find_launch_file(workspace, words)
    arguments = parse_arguments(rest).items()
    service = LaunchService()
    included = IncludeLaunchDescription(str(path), launch_arguments=arguments)
    service.include_launch_description(LaunchDescription([included]))
    if service.run():
        raise SystemExit(1)


async def _nothing() -> None:
    """Do nothing; callers of `shutdown` may await this coroutine, as in ROS 2."""
