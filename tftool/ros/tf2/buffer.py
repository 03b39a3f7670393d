"""tf2_ros: the buffer with waiting lookups.

A listener's transforms go directly into its buffer, whether its node spins or not, so that waiting
in a callback works, on the world's clock.
"""

import asyncio
from collections.abc import Callable
from typing import Any

from tftool.base.errors import TransformException
from tftool.messages.classes import INTERFACES
from tftool.ros.host import values
from tftool.ros.rclpy.futures import Future
from tftool.ros.rclpy.node import Node
from tftool.ros.rclpy.time import Duration
from tftool.ros.tf2.core import BufferCore
from tftool.ros.tf2.interface import NOW, BufferInterface
from tftool.ros.tf2.lookup_requests import (
    LookupRequest,
    full_question,
    length,
    question,
)
from tftool.world.clock import Phase


class Buffer(BufferCore, BufferInterface):
    """Frames as a node knows them; filled by a `TransformListener`."""

    def __init__(self, cache_time: Duration | None = None, node: Node | None = None) -> None:
        BufferCore.__init__(self, cache_time)
        BufferInterface.__init__(self)
        if node is not None:
            frames: Any = INTERFACES.find("tf2_msgs", "srv", "FrameGraph")
            node.create_service(frames, "tf2_frames", self._answer_frames)

    def _answer_frames(self, request: Any, response: Any) -> Any:
        response.frame_yaml = self.all_frames_as_yaml()
        return response

    # Blocking

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = NOW
    ) -> Any:
        """Return the pose of source in target as a geometry_msgs TransformStamped.

        With a timeout the thread waits, at most for that long by the world's clock.

        Raises:
            TransformException: If it cannot be given.
        """
        asked = question(target_frame, source_frame, time)
        self._wait(asked, timeout)
        return self._answer(asked)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = NOW,
    ) -> Any:
        """Return the pose of source at one time in target at another, through a fixed frame.

        Raises:
            TransformException: If it cannot be given.
        """
        asked = full_question(target_frame, target_time, source_frame, source_time, fixed_frame)
        self._wait(asked, timeout)
        return self._answer(asked)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Any = NOW,
        return_debug_tuple: bool = False,
    ) -> Any:
        """Return whether a lookup would succeed; with `return_debug_tuple`, (whether, why not)."""
        asked = question(target_frame, source_frame, time)
        return self._can(asked, timeout, return_debug_tuple)

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
        """Return whether a lookup between two times would succeed."""
        asked = full_question(target_frame, target_time, source_frame, source_time, fixed_frame)
        return self._can(asked, timeout, return_debug_tuple)

    def _can(self, asked: LookupRequest, timeout: Any, tell_why: bool) -> Any:
        self._wait(asked, timeout)
        whether, why_not = self._whether(asked)
        return (whether, why_not) if tell_why else bool(whether)

    def _wait(self, asked: LookupRequest, timeout: Any) -> None:
        """Wait while the answer may still become available, at most for the timeout."""
        limit = length(timeout)
        if limit > 0:
            self._hints.wait()
            self._ask(lambda: self._until(asked, limit))

    async def _until(self, asked: LookupRequest, limit: int) -> None:
        clock = self._program.clock
        attempt = asyncio.ensure_future(asked.wait(self._frames, clock))
        try:
            await self._program.first_of(attempt, until=clock.now() + limit, phase=Phase.WATCH)
        finally:
            attempt.cancel()
            await asyncio.gather(attempt, return_exceptions=True)

    # Awaited

    def wait_for_transform_async(self, *asked: Any, **named: Any) -> Future:
        """Return a future that gets the transform as soon as it is available."""
        return self._promise(question(*asked, **named))

    def wait_for_transform_full_async(self, *asked: Any, **named: Any) -> Future:
        """Do as `wait_for_transform_async`, between two times."""
        return self._promise(full_question(*asked, **named))

    def _promise(self, asked: LookupRequest) -> Future:
        future = Future(executor=self._program.executor)
        self._hints.wait()

        def attempt() -> bool:
            if future.cancelled():
                return True
            try:
                found = asked.answer(self._frames)
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

        self._ask(start)
        return future

    async def lookup_transform_async(self, *asked: Any, **named: Any) -> Any:
        """Await the transform."""
        await self.wait_for_transform_async(*asked, **named)
        return self.lookup_transform_core(*asked, **named)

    async def lookup_transform_full_async(self, *asked: Any, **named: Any) -> Any:
        """Await the transform between two times."""
        await self.wait_for_transform_full_async(*asked, **named)
        return self.lookup_transform_full_core(*asked, **named)
