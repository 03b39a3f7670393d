"""User's program, which runs inside tftool's process instead of a process of its own.

A program has its own arguments, its own rclpy context and a thread (fiber) on which its `main`
runs. In tftool's world the program is a node; the rclpy nodes that it creates are further nodes.
"""

import asyncio
import inspect
import os
import signal
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
from tftool.world.endpoints import PUBLISHER
from tftool.world.log import Level
from tftool.world.node import Node
from tftool.world.world import World

T = TypeVar("T")

POLLS = 100
"""Failed queries that a program may make in one simulated instant before time advances."""

READINGS = 2_000
"""Readings of the clock in one simulated instant before time advances."""

REQUESTS = 10_000
"""Requests of any kind in one simulated instant before time advances."""

TICK = seconds(0.001)
"""Nanoseconds by which time advances at these limits (a tick), so that a polling loop can end."""

TICKS = 16
"""Number of successive ticks, without a wait between them, after which a tick doubles."""

POLLING = 10
"""Factor by which a request counts more if the program has not waited since the last tick."""

LONGEST_TICK = 64 * TICK
"""Longest tick, in nanoseconds."""


PART = 0.01
"""Longest single sleep, in real seconds, of a program that was asked to end."""


_living: "set[Program]" = set()
"""Programs that are running, in all worlds of this process."""


class Program(Node):
    """User's program that runs as a node of tftool's world.

    Attributes:
        label: Name of the program in log lines; the program's rclpy node may have the same name.
        argv: The program's `sys.argv`.
        options: Options after `--ros-args`.
        strict: Whether time stops while the program's code runs: true on the simulated clock.
        broadcasts: Whether the program publishes transforms.
        listens: Whether the program looks up transforms.
        failure: Exception that ended the program; None if the program has not failed.
        status: Exit status once the program has ended; None before.
        has_started_programs: Whether the program has started others, by multiprocessing.
        nodes: `NodeState` of each rclpy node; empty after the end of the program.
        unserved: Destroyed nodes that were never spun, each with its number of callbacks.
        event_loops: Event loops of asyncio that the program created, closed at its end.
        lines_with_angles: Lines of code that were already checked for angles in degrees.
        advice: Functions called at the end of the run; each returns a hint about the program's
            transform lookups, or "".
        on_print: Function called with each printed text, and whether the text went to standard
            output.
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
        """Add the program to a world; the program starts when the world runs.

        Args:
            world: World to join.
            name: Name of the executable.
            body: Function to run as the program's `main`; None if the caller's thread runs it.
            argv: The program's `sys.argv`.
            options: Options after `--ros-args`.
            on_exit: Function called in the event loop's thread when the program has ended. Without
                this function, the failure of the program ends the run.
        """
        self.world = world  # The fiber is created before the node joins.
        self.label = name
        self.argv = list(argv)
        self.options = options or RosOptions()
        self.strict = isinstance(world.clock, SimClock)
        self.broadcasts = False
        self.failure: BaseException | None = None
        self.listens = False
        self.status: int | None = None
        self.has_started_programs = False
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
        self._polls_since = self._ticks = 0
        self._is_polling_named = False
        if body is None:
            self.fiber = Fiber.adopt(name)
        else:
            self.fiber = self.new_fiber(name, partial(self._run_code, body), on_busy=self._say_busy)
        self.fiber.owner = self
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
    def is_told(self) -> bool:
        """Whether a wait of the calling thread has already raised KeyboardInterrupt."""
        fiber = fibers.current()
        return self.interrupted if fiber is None else fiber.is_told

    @property
    def turn(self) -> Phase:
        """Phase, within each simulated instant, in which the program's timers run.

        Programs that only publish transforms run first, so that lookups in the same instant find
        the transforms.
        """
        return Phase.BROADCAST if self.broadcasts and not self.listens else Phase.CONSUME

    # The loop's side.

    async def run(self) -> None:
        """Run the program's code to its end, then close its threads, nodes and event loops.

        Raises:
            BaseException: The program's error, if it failed and has no `on_exit`.
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
            raise TftoolError(f"the program ended with exit status {self.status}") from self.failure

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
            if not loop.is_running():  # as in an abandoned fiber
                loop.close()
        self.event_loops.clear()

    def start_fiber(self, fiber: Fiber) -> "asyncio.Task[None]":
        """Start a fiber as another thread of the program; call this in the event loop's thread."""
        fiber.owner = self
        task = asyncio.get_running_loop().create_task(fiber.drive(), name=fiber.name)
        self._others.add(task)
        task.add_done_callback(self._fiber_ended)
        return task

    def new_fiber(self, name: str, body: Callable[[], object], **settings: Any) -> Fiber:
        """Create a fiber that can run `body` as a further thread of this program; do not start it.

        `settings` are further arguments of `Fiber`.
        """
        return Fiber(name, body, strict=self.strict, clock=self.world.clock, **settings)

    def _fiber_ended(self, task: "asyncio.Task[None]") -> None:
        self._others.discard(task)
        if not task.cancelled() and (error := task.exception()) is not None:
            self.say("ERROR", self.name, str(error))

    def _say_busy(self, place: CodeLine | None) -> None:
        where = str(place) if place is not None else "code that is not yours"
        wait = "simulated time waits for it" if self.strict else "its other callbacks wait for it"
        names = ", ".join(f"'{node.name}'" for node in self.nodes) or f"'{self.name}'"
        text = f"{names} has been busy for {fibers.PATIENCE:g} s and {wait}: {where}"
        self.say("WARN", self.name, text)

    def say(self, level: Level, logger: str, text: str) -> None:
        """Add a message of this program to the log; call this in the event loop's thread."""
        self.world.log.add(level, logger, text, program=self.label)

    # The fibers' side.

    def _run_code(self, body: Callable[[], object]) -> None:
        """Call `body`, then warn about nodes that were never spun.

        If the program was asked to end, also destroy the program's nodes.
        """
        try:
            body()
            waiting = [*self.unserved, *((node.name, node.unserved()) for node in self.nodes)]
            for name, count in () if self.interrupted else waiting:
                if count and not name.startswith("_"):
                    told = "its callback" if count == 1 else f"none of its {count} callbacks"
                    never = "never " if count == 1 else ""
                    self.warn(
                        f"node '{name}' has ended without being spun, so {told} was {never}called: "
                        "call rclpy.spin(node)"
                    )
        finally:
            for node in reversed(list(self.nodes)):
                if self.interrupted:
                    node.ros_node.destroy_node()

    def ask(self, request: Callable[[], Any]) -> Any:
        """Call `request` in the event loop's thread and return its result, as `Fiber.ask` does.

        This method can be called from any thread.
        """
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
            raise TftoolError(f"program '{self.name}' has not started: wait until the program runs")
        return asyncio.run_coroutine_threadsafe(_as_coroutine(request), self._loop).result()

    def _ask_beside(self, request: Callable[[], Any]) -> Any:
        # This is the thread of a pool, for which a fiber waits. The event loop waits for the fiber,
        # so the request can run in this thread.
        value = request()
        if inspect.isawaitable(value):
            fibers.discard(value)
            raise TftoolError(
                "on simulated time a thread of a pool cannot wait: start a threading.Thread "
                "instead of using the pool"
            )
        return value

    def now(self) -> Stamp:
        """Return the current time of tftool's clock in nanoseconds."""
        self._count(1.0 / READINGS)
        return self.clock.now()

    def count_failed_query(self, *, must_keep_pace: bool = True) -> None:
        """Count a query, such as a lookup, that failed without waiting.

        A loop that repeats the query would stop simulated time. After many queries, time therefore
        advances by a small step.

        Args:
            must_keep_pace: Whether all steps must be short, because the loop may execute
                callbacks or use transforms; if false, the steps may grow.
        """
        if must_keep_pace:
            self._ticks = 0
        self._count(1.0 / POLLS)

    def sleep(self, duration: Duration) -> None:
        """Block the calling thread for `duration` nanoseconds of tftool's clock.

        Raises:
            KeyboardInterrupt: If the program is asked to end. Later calls block in real time.
        """
        if self.is_told:
            self.wait_after_end(lambda: False, duration)
            return
        self.ask(partial(self.clock.sleep, max(0, duration), self.turn, self.rank))

    def wait_after_end(self, is_over: Callable[[], bool], duration: Duration | None) -> None:
        """Block the calling thread in real time, after the program was asked to end.

        On simulated time, return at once, because simulated time has ended.

        Args:
            is_over: Function called every few milliseconds; True ends the wait.
            duration: Longest wait in nanoseconds; None for `GRACE_AT_END`.
        """
        if fibers.current() is not None:
            # The loop notices that the code pauses, and limits how often the code may do so.
            self.ask(lambda: None)
        limit = seconds(fibers.GRACE_AT_END) if duration is None else duration
        end = time.monotonic_ns() + limit  # real time, as the world's clock may be paused
        # In short parts, so that an exception can be raised in this thread.
        while not (self.strict or is_over()) and (left := end - time.monotonic_ns()) > 0:
            time.sleep(min(left / NANOSECONDS, PART))  # noqa: TID251

    async def first_of(
        self,
        *waits: "asyncio.Future[Any] | asyncio.Event",
        until: Stamp | None = None,
        phase: Phase | None = None,
    ) -> bool:
        """Wait in the event loop until one of the futures is done, or one of the events is set.

        Args:
            waits: Futures and events to wait for; none of the futures is cancelled.
            until: Time at which to stop waiting, in nanoseconds; None for no limit.
            phase: Phase within the instant `until`; None for this program's phase (see `turn`).

        Returns:
            Whether one of the futures is done or one of the events is set.
        """
        futures = {one for one in waits if isinstance(one, asyncio.Future)}
        events = [one for one in waits if isinstance(one, asyncio.Event)]
        own: list[asyncio.Future[Any]] = [asyncio.ensure_future(one.wait()) for one in events]
        if until is not None:
            turn = (self.turn, self.rank) if phase is None else (phase,)
            own.append(self.clock.timer(until, *turn))
        try:
            await asyncio.wait(futures.union(own), return_when=asyncio.FIRST_COMPLETED)
        finally:
            for one in own:
                one.cancel()
        return any(one.done() for one in futures) or any(one.is_set() for one in events)

    def _count(self, share: float) -> None:
        # A loop that polls without waiting would stop simulated time for ever.
        fiber = fibers.current()
        if not self.strict or fiber is None:
            return
        now = self.clock.now()
        if now != self._asked_at:
            self._asked_at, self._asked = now, 0.0
        # A program that has not waited since the last tick probably polls, so its requests count
        # more.
        self._asked += share * POLLING if now == self._polled_until else share
        if self._asked > 1.0 and not self.interrupted:
            self._asked = 0.0
            self._ticks = self._ticks + 1 if now == self._polled_until else 0
            tick = min(TICK << self._ticks // TICKS, LONGEST_TICK)
            fiber.ask(partial(self.clock.sleep, tick, self.turn, self.rank))
            self._warn_of_polling(now)

    def _warn_of_polling(self, start: Stamp) -> None:
        """Log a warning once the code has polled in a loop for `GIVE_UP` real seconds.

        `start` is the time on tftool's clock at which this poll began, nanoseconds.
        """
        now = time.monotonic_ns()  # real time, as simulated time hardly advances
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
            f"'{self.name}' has polled for {fibers.GIVE_UP:g} s, so simulated time is slow: it "
            f"advances in steps of {TICK / NANOSECONDS:g} to {LONGEST_TICK / NANOSECONDS:g} s. "
            f"Instead of polling, wait with time.sleep or a timer, at {where}",
        )


def exit_status(error: SystemExit) -> int:
    """Return the exit status of a process that ends with this SystemExit.

    A text in the exception is written to standard error, and the status is then 1.
    """
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


NO_CLOCK = (
    "'use_sim_time' is true, but no node publishes /clock: the time stays 0, and no timer calls "
    "its callback. Start 'tftool play' or a simulator, or leave out use_sim_time"
)

UNTIL_CLOCK = seconds(2.0)
"""Nanoseconds to wait for a publisher of `/clock` before the warning."""


def warn_without_clock(world: World, say: Callable[[str], object]) -> None:
    """Call `say`, once in each world, if no node publishes `/clock` within `UNTIL_CLOCK`.

    Call this in the event loop's thread. In a world that has its own time, do nothing.
    """

    def check(_: object) -> None:
        is_said = any(one.text == NO_CLOCK for one in world.log.records)
        if not (is_said or world.endpoints.of("clock", PUBLISHER)):
            say(NO_CLOCK)

    if not world.has_own_time:
        timer = world.clock.timer(world.clock.now() + UNTIL_CLOCK, Phase.WATCH)
        timer.add_done_callback(check)


def set_program_of_thread(program_of_thread: "Callable[[], Program | None] | None") -> None:
    """Set the function that returns the program of a thread without a fiber.

    If the argument is None, an earlier function is removed.
    """
    global _outsiders
    _outsiders = program_of_thread


_outsiders: "Callable[[], Program | None] | None" = None


def running() -> Program | None:
    """Return the program that the calling thread belongs to; None if it belongs to no program."""
    fiber = fibers.current()
    owner: Program | None = None if fiber is None else fiber.owner
    if owner is None and fiber is None and len(_living) == 1:
        # Another library started this thread, for example a pool. If only one program runs, the
        # thread works for this program.
        (owner,) = _living
    if owner is None and fiber is None and _outsiders is not None:
        owner = _outsiders()
    return owner


def current() -> Program:
    """Return the program that the calling thread belongs to.

    Raises:
        TftoolError: If the thread belongs to no program.
    """
    owner = running()
    if owner is None and _is_forked:
        raise TftoolError(
            "a process that multiprocessing has started cannot use rclpy in tftool: use "
            "threading.Thread, or run the nodes as programs of their own"
        )
    if owner is None:
        raise TftoolError(
            "this rclpy is part of tftool and only works in a program that tftool runs: start "
            "the file with 'tftool run' or 'tftool launch', or use the pytest fixture "
            "'ros_runtime'"
        )
    return owner


_is_forked = False
"""Whether this process is a copy of a process in which programs ran."""

if sys.platform != "win32":
    _SIGNALS = (signal.SIGINT, signal.SIGTERM)
    _unblock = partial(signal.pthread_sigmask, signal.SIG_UNBLOCK, _SIGNALS)

    def _after_fork() -> None:
        """Detach a child process, such as one of multiprocessing, from its parent's world.

        The world's event loop runs only in the parent, so each request of the child would wait for
        ever. The child inherits the parent's signal handlers, which would pass the child's signals
        to the parent.
        """
        global _is_forked
        if _living:
            _is_forked = True
            _living.clear()
            fibers.forget_current()
            signal.set_wakeup_fd(-1)
            signal.signal(signal.SIGINT, signal.default_int_handler)
            signal.signal(signal.SIGTERM, signal.SIG_DFL)
        _unblock()

    os.register_at_fork(
        # A signal that arrives before the child is detached must wait until then.
        before=partial(signal.pthread_sigmask, signal.SIG_BLOCK, _SIGNALS),
        after_in_parent=_unblock,
        after_in_child=_after_fork,
    )
