"""A user's program, which `ros2 run` would start as a process.

It has its arguments, its rclpy context and a fiber on which its `main` runs. For the world it is a
node; its own nodes join beside it.
"""

import asyncio
import inspect
import sys
import threading
import time
from collections.abc import Awaitable, Callable, Sequence
from functools import partial
from typing import Any, ClassVar, TypeVar

from tftool.base.errors import TftoolError
from tftool.base.stamps import NANOSECONDS, Duration, Stamp, seconds
from tftool.ros.host import fibers
from tftool.ros.host.fibers import CodeLine, Fiber
from tftool.ros.host.names import RosOptions
from tftool.world.clock import Phase, SimClock
from tftool.world.log import Level
from tftool.world.node import Node
from tftool.world.world import World

T = TypeVar("T")

POLLS = 100
"""How often a program may look in vain at one simulated instant before time moves on."""

READINGS = 2_000
"""How often it may read the clock at one simulated instant before time moves on."""

REQUESTS = 10_000
"""How often it may ask for anything at one simulated instant before time moves on."""

TICK = seconds(0.001)
"""How far simulated time moves then: a loop that only polls must see an end of its waiting."""


_living: "set[Program]" = set()
"""The programs that run at the moment, in whatever world."""


class ProgramNode(Node):
    """A node made by a program: its name, subscriptions and services."""

    _is_passive: ClassVar[bool] = True

    def __init__(self, program: "Program", name: str) -> None:
        self.program = program
        super().__init__(program.world, name)


class Program(Node):
    """One executable.

    Attributes:
        label: Name it was started under; its node may take it over in the world.
        argv: Its `sys.argv`.
        options: Options of `--ros-args`.
        strict: Whether time stops while the program runs: on the simulated clock.
        broadcasts: Whether the program sends transforms.
        listens: Whether the program looks up transforms; timers of one that only sends run before
            those of the others in the same instant.
        failure: Its error, unless it ended well.
        status: Its exit status once it has ended, None before.
        nodes: The seats (`rclpy.seat.NodeSeat`) of the nodes it made, withdrawn at the end.
        unserved: Destroyed nodes, each with its number of callbacks if none was served.
        event_loops: Event loops of asyncio that it made, closed at the end.
        lines_with_angles: Lines of it whose angles were looked at: whether they are degrees.
        advice: Functions that sum its lookups up at the end: a sentence, or "".
        on_print: Receives what it prints, with whether that goes to its standard output.
    """

    is_shown: ClassVar[bool] = False

    def __init__(
        self,
        world: World,
        name: str,
        body: Callable[[], object] | None,
        *,
        argv: Sequence[str] = (),
        options: RosOptions | None = None,
        on_exit: Callable[["Program"], object] | None = None,
    ) -> None:
        """Join the world; `body` is the code to run, None adopts the calling thread.

        Args:
            world: World to join.
            name: The executable's name.
            body: Its `main`.
            argv: Its `sys.argv`.
            options: Options of `--ros-args`.
            on_exit: Called on the loop's thread once it has ended; without one a program
                that fails ends the run.
        """
        self.world = world  # The fiber is made before it joins.
        self.label = name
        self.argv = list(argv)
        self.options = options or RosOptions()
        self.strict = isinstance(world.clock, SimClock)
        self.broadcasts = False
        self.failure: BaseException | None = None
        self.listens = False
        self.status: int | None = None
        self.context: Any = None
        self.executor: Any = None
        self.nodes: list[Any] = []
        self.unserved: list[tuple[str, int]] = []
        self.event_loops: list[asyncio.AbstractEventLoop] = []
        self.log_levels: dict[str, int] = {}
        self.lines_with_angles: set[Any] = set()
        self.advice: list[Callable[[], str]] = []
        self.on_print: Callable[[str, bool], object] | None = None
        self._on_exit = on_exit
        self._others: set[asyncio.Task[None]] = set()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._loop_thread = 0
        self._asked_at: Stamp = 0
        self._asked = 0.0
        self._polled_until: Stamp = 0
        self._polls_since = 0
        self._is_polling_named = False
        if body is None:
            self.fiber = Fiber.adopt(name)
        else:
            self.fiber = self.new_fiber(name, body, on_busy=self._say_busy)
        self._own(self.fiber)
        super().__init__(world, name)

    @property
    def is_begun(self) -> bool:
        """Whether the program has started."""
        return self._loop is not None

    @property
    def interrupted(self) -> bool:
        """Whether the program was asked to end."""
        return self.fiber.interrupted

    @property
    def turn(self) -> Phase:
        """Return the turn of the program's timers within an instant."""
        return Phase.BROADCAST if self.broadcasts and not self.listens else Phase.CONSUME

    # The loop's side.

    async def run(self) -> None:
        """Run the body; what it leaves open is closed.

        Raises:
            BaseException: Its error, if it failed and nobody waits for its exit.
        """
        self._loop = asyncio.get_running_loop()
        self._loop_thread = threading.get_ident()
        _living.add(self)
        try:
            await self.fiber.drive()
        except Exception as error:
            self.failure = error
        finally:
            _living.discard(self)
            others = list(self._others)
            for other in others:
                other.cancel()
            if others:
                await asyncio.gather(*others, return_exceptions=True)
            self._leave()
        if self._on_exit is not None:
            self._on_exit(self)
        elif self.status and self.failure is not None:
            if isinstance(self.failure, Exception):
                raise self.failure
            raise TftoolError(f"it ended with exit status {self.status}") from self.failure

    def _leave(self) -> None:
        raised = self.failure or self.fiber.error
        if isinstance(raised, KeyboardInterrupt) and self.interrupted:
            self.status, raised = 130, None
        elif isinstance(raised, SystemExit):
            self.status = exit_status(raised)
        else:
            self.status = 0 if raised is None else 1
        self.failure = raised
        for node in reversed(list(self.nodes)):
            node.withdraw()
        self.nodes.clear()
        for loop in self.event_loops:
            if not loop.is_running():  # as it is in a fiber that was left alone
                loop.close()
        self.event_loops.clear()

    def start_fiber(self, fiber: Fiber) -> "asyncio.Task[None]":
        """Drive one more thread of this program (in the loop's thread)."""
        self._own(fiber)
        task = asyncio.get_running_loop().create_task(fiber.drive(), name=fiber.name)
        self._others.add(task)
        task.add_done_callback(self._fiber_ended)
        return task

    def new_fiber(self, name: str, body: Callable[[], object], **settings: Any) -> Fiber:
        """Make one more thread for this program, not started yet."""
        return Fiber(name, body, strict=self.strict, clock=self.world.clock, **settings)

    def _fiber_ended(self, task: "asyncio.Task[None]") -> None:
        self._others.discard(task)
        if not task.cancelled() and (error := task.exception()) is not None:
            self.say("ERROR", self.name, str(error))

    def _own(self, fiber: Fiber) -> None:
        fiber.owner = self

    def _say_busy(self, place: CodeLine | None) -> None:
        where = str(place) if place is not None else "code that is not yours"
        wait = "simulated time waits for it" if self.strict else "its other callbacks wait for it"
        names = ", ".join(f"'{node.name}'" for node in self.nodes) or f"'{self.name}'"
        text = f"{names} has been busy for {fibers.PATIENCE:g} s and {wait}: {where}"
        self.say("WARN", self.name, text)

    def say(self, level: Level, speaker: str, text: str) -> None:
        """Log a line of this program (in the loop's thread)."""
        self.world.log.add(level, speaker, text, program=self.label)

    # The fibers' side.

    def ask(self, request: Callable[[], Any]) -> Any:
        """Run something in the loop's thread, from any thread; see `Fiber.ask`."""
        __tracebackhide__ = True
        fiber = fibers.current()
        if fiber is not None:
            self._count(1.0 / REQUESTS)
            return fiber.ask(request)
        if threading.get_ident() == self._loop_thread:
            return request()
        if self.strict:
            return self._ask_beside(request)
        if self._loop is None:
            raise TftoolError(f"program '{self.name}' is not running yet")
        return asyncio.run_coroutine_threadsafe(_as_coroutine(request), self._loop).result()

    def _ask_beside(self, request: Callable[[], Any]) -> Any:
        # A pool's thread, for which a fiber waits: the loop stands still meanwhile.
        value = request()
        if inspect.isawaitable(value):
            fibers.discard(value)
            raise TftoolError(
                "on simulated time a thread of a pool cannot wait: use threading.Thread"
            )
        return value

    def now(self) -> Stamp:
        """Return the world's time."""
        self._count(1.0 / READINGS)
        return self.clock.now()

    def looked_in_vain(self) -> None:
        """Record a failed query, such as for a missing transform, that did not wait."""
        self._count(1.0 / POLLS)

    def sleep(self, duration: Duration) -> None:
        """Block this thread for a duration; when asked to end, return at once."""
        if self.interrupted:
            return
        self.ask(partial(self.clock.sleep, max(0, duration), self.turn, self.rank))

    async def first_of(
        self,
        *waits: "asyncio.Future[Any]",
        until: Stamp | None = None,
        phase: Phase | None = None,
    ) -> bool:
        """Wait for the first of some futures (in the loop), which are not cancelled.

        Args:
            waits: Futures to wait for.
            until: The moment at which to stop waiting; None for none.
            phase: The turn within that moment; this program's own unless given.

        Returns:
            Whether one of them is done.
        """
        timers = []
        if until is not None:
            turn = (self.turn, self.rank) if phase is None else (phase,)
            timers.append(self.clock.timer(until, *turn))
        try:
            await asyncio.wait({*waits, *timers}, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for timer in timers:
                timer.cancel()
        return any(one.done() for one in waits)

    def _count(self, share: float) -> None:
        # A loop that looks without ever waiting would hold simulated time still for ever.
        fiber = fibers.current()
        if not self.strict or fiber is None:
            return
        now = self.clock.now()
        if now != self._asked_at:
            self._asked_at, self._asked = now, 0.0
        self._asked += share
        if self._asked > 1.0 and not self.interrupted:
            self._asked = 0.0
            fiber.ask(partial(self.clock.sleep, TICK, self.turn, self.rank))
            self._note_polling(now)

    def _note_polling(self, start: Stamp) -> None:
        """Report a loop that has polled for long although nothing happens; once."""
        now = time.monotonic_ns()  # real, for simulated time hardly moves meanwhile
        if start != self._polled_until:
            self._polls_since = now
        self._polled_until = self.clock.now()
        patience = seconds(fibers.GIVE_UP)
        if not self._is_polling_named and now - self._polls_since > patience:
            self._is_polling_named = True
            place = fibers.user_line(sys._getframe(1))
            self.ask(lambda: self._say_polling(place))

    def _say_polling(self, place: CodeLine | None) -> None:
        where = str(place) if place is not None else "code that is not yours"
        self.say(
            "WARN",
            self.name,
            f"'{self.name}' has polled for {fibers.GIVE_UP:g} s, and simulated time moves on by "
            f"only {TICK / NANOSECONDS:g} s at a time: wait with time.sleep or a timer: {where}",
        )


def exit_status(error: SystemExit) -> int:
    """Return the exit status that a process would have."""
    code = error.code
    if code is None:
        return 0
    if isinstance(code, int):
        return code & 0xFF
    sys.stderr.write(f"{code}\n")
    return 1


async def _as_coroutine(request: Callable[[], Any]) -> Any:
    value = request()
    return await value if isinstance(value, Awaitable) else value


def let_outsiders_join(found: "Callable[[], Program | None] | None") -> None:
    """Make `found` determine the running program on threads without a fiber; None ends that."""
    global _outsiders
    _outsiders = found


_outsiders: "Callable[[], Program | None] | None" = None


def running() -> Program | None:
    """Return the program whose code is running; None outside of one."""
    fiber = fibers.current()
    owner: Program | None = None if fiber is None else fiber.owner
    if owner is None and fiber is None and len(_living) == 1:
        # A thread that no program started, a pool's say: there is only one it can work for.
        (owner,) = _living
    if owner is None and fiber is None and _outsiders is not None:
        owner = _outsiders()
    return owner


def current() -> Program:
    """Return the program whose code is running.

    Raises:
        TftoolError: Outside of one.
    """
    owner = running()
    if owner is None:
        raise TftoolError(
            "this rclpy is part of tftool: start the file with 'tftool run' or 'tftool launch', "
            "or use the pytest fixture 'ros_runtime'"
        )
    return owner
