"""launch's LaunchService: a launch that a program makes and runs by itself."""

import asyncio
import logging
import sys
from typing import Any

from tftool.ros.host import program
from tftool.ros.host.event_loops import SLICE
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.description import LaunchDescription
from tftool.ros.launch.engine import Launch
from tftool.stamps import as_seconds


class LaunchService:
    """Carries launch descriptions out, as the program it is made in."""

    def __init__(
        self, *, argv: Any = None, noninteractive: bool = False, debug: bool = False
    ) -> None:
        self.context = LaunchContext(argv=argv)
        self._entities: list[Any] = []
        self._launch: Launch | None = None

    def include_launch_description(self, launch_description: LaunchDescription) -> None:
        """Carry a description out too, once it runs."""
        self._entities.append(launch_description)

    def run(self, *, shutdown_when_idle: bool = True) -> int:
        """Launch, and block until everything has ended.

        Returns:
            0, or 1 if something failed.
        """
        launch = self._begin()
        program.current().ask(launch.ended.wait)
        return int(bool(launch.failed))

    def _begin(self) -> Launch:
        owner = program.current()

        def say(level: str, who: str, text: str) -> None:
            sys.stderr.write(f"[{level}] [{who}]: {text}\n" if level else f"[{who}] {text}\n")

        def start() -> list[Launch]:
            name = owner.world.free_name("launch")
            description = LaunchDescription(self._entities)
            made = Launch(
                owner.world, description, context=self.context, say=say, name=name, contained=True
            )
            return [made]

        (self._launch,) = owner.ask(start)
        return self._launch

    async def run_async(self, *, shutdown_when_idle: bool = True) -> int:
        """The same beside other coroutines; who cancels it ends the launch."""
        launch = self._begin()
        try:
            while not launch.ended.is_set():
                # The loop is the user's, and its time the world's.
                await asyncio.sleep(as_seconds(SLICE))  # noqa: TID251
        except asyncio.CancelledError:
            self.shutdown()
            raise
        return int(bool(launch.failed))

    def shutdown(self) -> None:
        """End what runs."""
        launch = self._launch
        if launch is not None:
            program.current().ask(lambda: launch.shut_down("the program asked for it"))


def get_logger(name: str | None = None) -> logging.Logger:
    """A logger of Python's own that writes to standard error as launch does."""
    root = logging.getLogger("launch")
    if not root.handlers:
        handler = logging.StreamHandler()
        handler.setFormatter(logging.Formatter("[%(levelname)s] [%(name)s]: %(message)s"))
        root.addHandler(handler)
        root.setLevel(logging.INFO)
        root.propagate = False
    return root if name in (None, "launch") else root.getChild(str(name))
