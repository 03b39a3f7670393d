"""World for unit tests of ROS nodes, without ROS and on simulated time.

The test is itself a program in the simulated world. No simulated time passes between the test's
calls, and `rclpy.spin_once(node, timeout_sec=10.0)` takes no real time.
"""

import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tftool.base.stamps import seconds
from tftool.ros.host import names, user_code
from tftool.ros.host.fibers import EndedError
from tftool.ros.host.importing import environment, ros_free, ros_modules
from tftool.ros.host.program import Program, set_program_of_thread
from tftool.ros.host.workspace import Workspace, use_workspace
from tftool.ros.running import ProgramFailed
from tftool.world.clock import Phase, SimClock, run
from tftool.world.log import LogRecord
from tftool.world.supervisor import live
from tftool.world.world import World


@contextmanager
def ros_imports(root: Path, program_of_fixture: Callable[[], Program | None]) -> Iterator[None]:
    """Make ROS 2's modules and a workspace's packages importable until the block ends.

    Test files and their fixtures need these imports; each test adds the imports of its world.

    The folder `root` of the tests is inside the workspace. `program_of_fixture` returns the program
    of the fixture that is being set up.
    """
    with environment(), ros_modules() as finder:
        # Tests sleep and start threads as nodes do, so they need the same time.
        finder.tested = root
        # Use the interfaces, share folders and modules of the workspace around the tests.
        workspace = Workspace(root)
        use_workspace(workspace)
        added = workspace.module_folders()
        sys.path[:0] = added
        set_program_of_thread(program_of_fixture)
        try:
            yield
        finally:
            set_program_of_thread(None)
            for folder in added:
                sys.path.remove(folder)


class RosRuntime:
    """Context manager with a simulated world, whose event loop runs in a second thread.

    Attributes:
        clock: Simulated clock of the world, which starts at 1000 s.
        world: World of the nodes.
        program: Program in the world that represents the test.
    """

    def __init__(self) -> None:
        self.clock = SimClock()
        self.world = World(self.clock)
        self._imports = ros_free(force=True)
        self._failure: BaseException | None = None
        self._is_told = False

    def __enter__(self) -> "RosRuntime":
        self._finder = self._imports.__enter__()
        self.program = Program(self.world, "test", None, on_exit=lambda _: self.world.stop())
        self.program.fiber.end = self._ended
        self._thread = threading.Thread(target=self._live, name="tftool", daemon=True)
        self._thread.start()
        # A first request ensures that the loop runs.
        self.ask(lambda: None)
        return self

    def __exit__(self, *args: object) -> None:
        try:
            self.program.fiber.release()
            self._thread.join()
        finally:
            self._imports.__exit__(None, None, None)
        if self._failure is not None and not self._is_told:
            raise self._failure

    def _ended(self) -> BaseException:
        """Return the exception to raise in a test that still waits after the end of the world."""
        failure = self.world.failure
        if failure is None:
            return EndedError("the world has ended")
        self._is_told = True
        return ProgramFailed(failure.node, failure.__cause__ or failure)

    def _live(self) -> None:
        try:
            run(self.clock, live(self.world))
        except Exception as error:
            self._failure = error

    def ask(self, request: Callable[[], Any]) -> Any:
        """Call `request` in the world's event loop and return the result.

        If the result is awaitable, the event loop awaits it first.

        Raises:
            NodeFailed: If a node, or a program started by the test, has failed.
        """
        __tracebackhide__ = True
        return self.program.ask(request)

    def sleep(self, duration: float) -> None:
        """Advance simulated time by `duration` seconds; nodes and programs run meanwhile.

        Raises:
            NodeFailed: If a node, or a program started by the test, has failed.
        """
        __tracebackhide__ = True
        self.program.ask(lambda: self.clock.sleep(seconds(duration), Phase.WATCH))

    def elapsed(self) -> float:
        """Return the simulated seconds since the world was created."""
        return (self.clock.now() - self.clock.epoch) / 1e9

    def start(
        self,
        what: "Path | str | Callable[[], object]",
        *argv: str,
        on_exit: Callable[[Program], object] | None = None,
    ) -> Program:
        """Start a further program in the world, from a Python file or a function.

        Args:
            what: Path of the file, or a function such as a module's `main`.
            argv: Words of the command line after the file's name, including `--ros-args`.
            on_exit: Function called when the program has ended for any reason. Without this
                function, a program that fails ends the world and fails the test.

        Raises:
            InputError: If the file cannot be read or is not valid Python.
            UsageError: If the part after `--ros-args` is malformed.
        """
        if callable(what):
            body: Any = what
            name = getattr(what, "__module__", "program").rpartition(".")[2]
        else:
            body, name = user_code.file_body(Path(what)), Path(what).stem
        options, _ = names.parse(argv)
        taken = {node.name for node in self.world.nodes}
        number = 1
        while f"{name}-{number}" in taken:
            number += 1
        return self.ask(  # type: ignore[no-any-return]
            lambda: Program(
                self.world,
                f"{name}-{number}",
                body,
                argv=[str(what) if isinstance(what, str | Path) else name, *argv],
                options=options,
                on_exit=on_exit,
            )
        )

    def log(self, node: str | None = None) -> list[str]:
        """Return the texts of the log messages so far, of the node named `node` or of all nodes."""
        records: Sequence[LogRecord] = list(self.world.log.records)
        return [record.text for record in records if node is None or record.node == node]
