"""tf2_ros: the buffer.

A listener's transforms go straight into its buffer, whoever spins, so waiting in a
callback works; and it waits on the world's clock.
"""

import asyncio
from collections.abc import Callable
from typing import Any

from tftool.errors import TransformException
from tftool.frames.buffer import Buffer as Frames
from tftool.frames.sample import TransformStamped
from tftool.interfaces.classes import INTERFACES
from tftool.ros import program, values
from tftool.ros.client.futures import Future
from tftool.ros.client.node import Node
from tftool.ros.client.time import Duration, Time
from tftool.ros.tf.registry import Registration, convert
from tftool.runtime import waiting
from tftool.runtime.clock import Phase
from tftool.stamps import Stamp

NOW = Duration()
"""No waiting."""


def _stamp(time: Any) -> Stamp:
    if isinstance(time, Time):
        return time.nanoseconds
    if hasattr(time, "sec") and hasattr(time, "nanosec"):
        return values.stamp_of(time)
    raise TypeError(
        f"a lookup's time must be an rclpy.time.Time (Time() means the latest), "
        f"not {type(time).__name__}"
    )


def _length(timeout: Any) -> int:
    if isinstance(timeout, Duration):
        return timeout.nanoseconds
    raise TypeError(
        f"a timeout must be an rclpy.duration.Duration, not {type(timeout).__name__}: "
        "write Duration(seconds=1.0)"
    )


class Buffer:
    """What a node knows of frames; filled by a `TransformListener`."""

    def __init__(self, cache_time: Duration | None = None, node: Node | None = None) -> None:
        self._program = program.current()
        length = 10_000_000_000 if cache_time is None else _length(cache_time)
        self._frames = Frames(length, log=self._log)
        self._waiting: list[asyncio.Task[None]] = []
        self.registration = Registration()
        if node is not None:
            frames: Any = INTERFACES.find("tf2_msgs", "srv", "FrameGraph")
            node.create_service(frames, "tf2_frames", self._answer_frames)

    @property
    def frames(self) -> Frames:
        """The buffer itself."""
        return self._frames

    def _log(self, level: str, text: str) -> None:
        log = self._program.world.log
        (log.error if level == "ERROR" else log.warn)(self._program.name, text)

    def _answer_frames(self, request: Any, response: Any) -> Any:
        response.frame_yaml = self.all_frames_as_yaml()
        return response

    # Setting

    def set_transform(self, transform: Any, authority: str) -> bool:
        """Take a moving link's sample in."""
        sample = values.pack_transform(transform)
        return bool(self._program.ask(lambda: self._frames.set_transform(sample, authority)))

    def set_transform_static(self, transform: Any, authority: str) -> bool:
        """Take a link in that holds for all time."""
        sample = values.pack_transform(transform)
        return bool(self._program.ask(lambda: self._frames.set_transform_static(sample, authority)))

    def clear(self) -> None:
        """Forget all that moves."""
        self._program.ask(self._frames.clear)

    # Asking

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = NOW
    ) -> Any:
        """The pose of source in target, as a geometry_msgs TransformStamped.

        With a timeout the thread waits for it at most so long, by the world's clock.

        Raises:
            TransformException: If it cannot be given.
        """
        _require_names(target_frame=target_frame, source_frame=source_frame)
        stamp = _stamp(time)
        self._wait(lambda: self._ready(target_frame, source_frame, stamp), _length(timeout))
        return self._answer(
            lambda: self._frames.lookup_transform(target_frame, source_frame, stamp)
        )

    def lookup_transform_core(self, target_frame: str, source_frame: str, time: Any) -> Any:
        """The same without waiting."""
        return self.lookup_transform(target_frame, source_frame, time)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = NOW,
    ) -> Any:
        """The pose of source at one time in target at another, through a fixed frame.

        Raises:
            TransformException: If it cannot be given.
        """
        _require_names(
            target_frame=target_frame, source_frame=source_frame, fixed_frame=fixed_frame
        )
        asked = (target_frame, _stamp(target_time), source_frame, _stamp(source_time), fixed_frame)
        self._wait(lambda: self._ready_full(asked), _length(timeout))
        return self._answer(lambda: self._frames.lookup_transform_full(*asked))

    def lookup_transform_full_core(self, *args: Any) -> Any:
        """The same without waiting."""
        return self.lookup_transform_full(*args)

    def _answer(self, ask: Callable[[], TransformStamped]) -> Any:
        return values.unpack_transform(self._program.ask(ask))

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Any = NOW,
        return_debug_tuple: bool = False,
    ) -> Any:
        """Whether a lookup would succeed; with `return_debug_tuple`, (whether, why not)."""
        stamp = _stamp(time)
        self._wait(lambda: self._ready(target_frame, source_frame, stamp), _length(timeout))
        reason = self._program.ask(lambda: self._frames.why_not(target_frame, source_frame, stamp))
        if reason:
            self._program.looked_in_vain()
        return (int(not reason), reason) if return_debug_tuple else not reason

    def can_transform_core(self, target_frame: str, source_frame: str, time: Any) -> Any:
        """(whether a lookup would succeed, why not)."""
        return self.can_transform(target_frame, source_frame, time, return_debug_tuple=True)

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = NOW,
        return_debug_tuple: bool = False,
    ) -> Any:
        """Whether a lookup between two moments would succeed."""
        asked = (target_frame, _stamp(target_time), source_frame, _stamp(source_time), fixed_frame)
        self._wait(lambda: self._ready_full(asked), _length(timeout))
        reason = self._program.ask(lambda: self._frames.why_not_full(*asked))
        return (int(not reason), reason) if return_debug_tuple else not reason

    def can_transform_full_core(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> Any:
        """(whether a lookup between two moments would succeed, why not)."""
        return self.can_transform_full(
            target_frame,
            target_time,
            source_frame,
            source_time,
            fixed_frame,
            return_debug_tuple=True,
        )

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """The newest moment at which both are known."""
        stamp = self._program.ask(
            lambda: self._frames.get_latest_common_time(target_frame, source_frame)
        )
        return Time(nanoseconds=stamp)

    # Waiting

    def _wait(self, ready: Callable[[], Any], timeout: int) -> None:
        if timeout > 0:
            self._program.ask(lambda: self._until(ready, timeout))

    async def _until(self, ready: Callable[[], Any], timeout: int) -> None:
        """Wait for data, as long as `ready` makes another attempt, at most `timeout`."""
        clock = self._program.clock
        deadline = clock.now() + timeout
        attempt = asyncio.ensure_future(ready())
        timer = clock.timer(deadline, Phase.WATCH)
        try:
            await asyncio.wait([attempt, timer], return_when=asyncio.FIRST_COMPLETED)
        finally:
            timer.cancel()
            attempt.cancel()
            await asyncio.gather(attempt, return_exceptions=True)

    async def _ready(self, target: str, source: str, stamp: Stamp) -> None:
        await waiting.wait_for_transform(self._frames, self._program.clock, target, source, stamp)

    async def _ready_full(self, asked: tuple[str, Stamp, str, Stamp, str]) -> None:
        await waiting.wait_for_transform_full(self._frames, self._program.clock, *asked)

    def wait_for_transform_async(self, target_frame: str, source_frame: str, time: Any) -> Future:
        """A future that is done, with the transform, as soon as it can be given."""
        stamp = _stamp(time)
        return self._promise(
            lambda: self._frames.lookup_transform(target_frame, source_frame, stamp)
        )

    def wait_for_transform_full_async(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> Future:
        """The same between two moments."""
        asked = (target_frame, _stamp(target_time), source_frame, _stamp(source_time), fixed_frame)
        return self._promise(lambda: self._frames.lookup_transform_full(*asked))

    def _promise(self, look: Callable[[], TransformStamped]) -> Future:
        executor = self._program.executor
        future = Future(executor=executor)

        def attempt() -> bool:
            if future.cancelled():
                return True
            try:
                found = look()
            except TransformException:
                return False
            future.set_result(values.unpack_transform(found))
            return True

        def start() -> None:
            if attempt():
                return
            stops: list[Callable[[], None]] = []

            def on_sample(*_: object) -> None:
                if attempt():
                    for stop in stops:
                        stop()

            stops.append(self._frames.listen(on_sample))

        self._program.ask(start)
        return future

    async def lookup_transform_async(self, target_frame: str, source_frame: str, time: Any) -> Any:
        """The transform, awaited."""
        await self.wait_for_transform_async(target_frame, source_frame, time)
        return self.lookup_transform(target_frame, source_frame, time)

    async def lookup_transform_full_async(self, *args: Any) -> Any:
        """The transform between two moments, awaited."""
        await self.wait_for_transform_full_async(*args)
        return self.lookup_transform_full(*args)

    # Transforming data

    def transform(
        self,
        object_stamped: Any,
        target_frame: str,
        timeout: Any = NOW,
        new_type: Any = None,
    ) -> Any:
        """Data with a header, seen in another frame.

        Raises:
            TypeException: If nobody registered how to transform such data.
        """
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        return _converted(do_transform(object_stamped, found), new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Any,
        fixed_frame: str,
        timeout: Any = NOW,
        new_type: Any = None,
    ) -> Any:
        """Data with a header, seen in another frame at another time."""
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        return _converted(do_transform(object_stamped, found), new_type)

    # Looking round

    def all_frames_as_yaml(self) -> str:
        """Every frame, as tf2 writes YAML."""
        return str(self._program.ask(self._frames.all_frames_as_yaml))

    def all_frames_as_string(self) -> str:
        """Every frame and its parent."""
        return str(self._program.ask(self._frames.all_frames_as_string))

    def _allFramesAsDot(self, time: float = 0.0) -> str:  # noqa: N802
        return str(self._program.ask(self._frames.all_frames_as_dot))

    def _getFrameStrings(self) -> list[str]:  # noqa: N802
        return list(self._program.ask(self._frames.frames))

    def _frameExists(self, frame: str) -> bool:  # noqa: N802
        return bool(self._program.ask(lambda: self._frames.frame_exists(frame)))


def _require_names(**frames: object) -> None:
    for argument, frame in frames.items():
        if not isinstance(frame, str):
            raise TypeError(f"{argument} must be a frame's name, not {type(frame).__name__}")


def _converted(result: Any, new_type: Any) -> Any:
    return result if new_type is None else convert(result, new_type)


BufferCore = Buffer
BufferInterface = Buffer
