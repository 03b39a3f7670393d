"""Transform buffer of tf2_ros and tf2_py, with the registries of types to transform and convert.

A listener's transforms are inserted into its buffer at once, whether its node spins or not. So a
callback can wait for a transform; it waits on tftool's clock.
"""

import asyncio
import copy
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from tftool.base.errors import TransformException
from tftool.base.stamps import Stamp
from tftool.buffer.buffer import Buffer as Frames
from tftool.buffer.sample import TransformStamped
from tftool.messages.classes import INTERFACES
from tftool.ros.host import program, values
from tftool.ros.rclpy.futures import Future
from tftool.ros.rclpy.node import Node
from tftool.ros.rclpy.time import Duration, Time
from tftool.ros.tf2.lookup_hints import LookupHints
from tftool.world import transform_wait as waiting
from tftool.world.clock import Clock, Phase

T = TypeVar("T")

_transform: dict[Any, Callable[[Any, Any], Any]] = {}
_to_msg: dict[Any, Callable[[Any], Any]] = {}
_from_msg: dict[Any, Callable[[Any], Any]] = {}
_convert: dict[tuple[Any, Any], Callable[[Any], Any]] = {}


class TypeException(TransformException):
    """Error for a message type for which no transformation is registered."""

    def __init__(self, errstr: str) -> None:
        super().__init__(errstr)
        self.errstr = errstr


class NotImplementedException(TransformException):
    """Error for a method that a buffer does not implement."""

    def __init__(self) -> None:
        super().__init__("CanTransform or LookupTransform not implemented")


class TransformRegistration:
    """Registry of the functions that transform data of a type."""

    def print_me(self) -> None:
        """Do nothing; the method exists in ROS 2."""

    def add(self, key: Any, callback: Callable[[Any, Any], Any]) -> None:
        """Register `callback(data, transform)` as the function that transforms data of a type."""
        _transform[key] = callback

    def get(self, key: Any) -> Callable[[Any, Any], Any]:
        """Return the function that transforms data of a type.

        Raises:
            TypeException: If no function is registered for the type.
        """
        return _of(_transform, key)


class ConvertRegistration:
    """Registry of the functions that convert between types and messages."""

    def add_from_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Register `callback` as the function that makes an object of a type from a message."""
        _from_msg[key] = callback

    def add_to_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Register `callback` as the function that makes a message from an object of a type."""
        _to_msg[key] = callback

    def add_convert(self, key: tuple[Any, Any], callback: Callable[[Any], Any]) -> None:
        """Register `callback` as the function that converts from one type to another."""
        _convert[key] = callback

    def get_from_msg(self, key: Any) -> Callable[[Any], Any]:
        """Return the function that makes an object of a type from a message."""
        return _of(_from_msg, key)

    def get_to_msg(self, key: Any) -> Callable[[Any], Any]:
        """Return the function that makes a message from an object of a type."""
        return _of(_to_msg, key)

    def get_convert(self, key: tuple[Any, Any]) -> Callable[[Any], Any]:
        """Return the function that converts one type to another."""
        return _of(_convert, key)


def _of(registry: dict[Any, T], key: Any) -> T:
    try:
        return registry[key]
    except KeyError:
        raise TypeException(f"Type {key} is not loaded or supported") from None


def convert(a: Any, b_type: Any) -> Any:
    """Convert `a` to the type `b_type` with the registered functions; copy an object of that type.

    Without a function for this pair of types, the conversion goes through a message.
    """
    if isinstance(a, b_type):
        return copy.deepcopy(a)
    direct = _convert.get((type(a), b_type))
    if direct is not None:
        return direct(a)
    return _of(_from_msg, b_type)(_of(_to_msg, type(a))(a))


NOW = Duration()
"""Timeout of zero: lookups do not wait."""


class BufferInterface:
    """Base of buffers, with methods that transform stamped data; subclasses implement lookups."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def _look_up(self, asked: "LookupRequest", timeout: Any) -> Any:
        """Return the requested transform; wait for it, at most for the timeout.

        Raises:
            TransformException: If the transform is not available in time.
            NotImplementedException: If the class does not implement lookups.
        """
        raise NotImplementedException

    def _whether(self, asked: "LookupRequest", timeout: Any) -> tuple[int, str]:
        """Return (whether a lookup succeeds within the timeout, the reason if not)."""
        try:
            self._look_up(asked, timeout)
        except NotImplementedException:
            raise
        except TransformException as error:
            return 0, str(error)
        return 1, ""

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = NOW
    ) -> Any:
        """Return the pose of source in target as a geometry_msgs TransformStamped message.

        With a timeout, the calling thread waits for the transform, at most for that time of
        tftool's clock.

        Raises:
            TransformException: If the transform is not available in time.
        """
        return self._look_up(question(target_frame, source_frame, time), timeout)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = NOW,
    ) -> Any:
        """Return the pose of source at one time in target at another, via a fixed frame.

        Raises:
            TransformException: If the transform is not available in time.
        """
        asked = full_question(target_frame, target_time, source_frame, source_time, fixed_frame)
        return self._look_up(asked, timeout)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Any = NOW,
        return_debug_tuple: bool = False,
    ) -> Any:
        """Return whether a lookup would succeed; with `return_debug_tuple`, the reason too."""
        found = self._whether(question(target_frame, source_frame, time), timeout)
        return found if return_debug_tuple else bool(found[0])

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
        """Return whether a lookup at two times, through a fixed frame, would succeed."""
        asked = full_question(target_frame, target_time, source_frame, source_time, fixed_frame)
        found = self._whether(asked, timeout)
        return found if return_debug_tuple else bool(found[0])

    def transform(
        self, object_stamped: Any, target_frame: str, timeout: Any = NOW, new_type: Any = None
    ) -> Any:
        """Transform stamped data from the frame in its header to another frame.

        Raises:
            TypeException: If no transformation is registered for this type.
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
        """Transform stamped data to another frame at another time, through a fixed frame."""
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        return _converted(do_transform(object_stamped, found), new_type)


def _converted(result: Any, new_type: Any) -> Any:
    return result if new_type is None else convert(result, new_type)


@dataclass(frozen=True, slots=True)
class LookupRequest:
    """Request for the transform between two frames, at one time or at two.

    Attributes:
        target: Frame in which the pose is expressed.
        source: Frame whose pose is requested.
        time: Time of the source frame, in nanoseconds.
        target_time: Time of the target frame, used with a fixed frame.
        fixed: Frame that does not move between the two times; None for a lookup at one time.
    """

    target: str
    source: str
    time: Stamp
    target_time: Stamp = 0
    fixed: str | None = None

    def answer(self, frames: Frames) -> TransformStamped:
        """Return the transform from a buffer; raise if the buffer does not have it."""
        if self.fixed is None:
            return frames.lookup_transform(self.target, self.source, self.time)
        return frames.lookup_transform_full(*self._full)

    def why_not(self, frames: Frames) -> str:
        """Return the reason why the lookup fails; "" if it succeeds."""
        if self.fixed is None:
            return frames.why_not(self.target, self.source, self.time)
        return frames.why_not_full(*self._full)

    async def wait(self, frames: Frames, clock: Clock) -> None:
        """Wait until the lookup succeeds; raise as soon as it never can."""
        if self.fixed is None:
            await waiting.wait_for_transform(frames, clock, self.target, self.source, self.time)
        else:
            await waiting.wait_for_transform_full(frames, clock, *self._full)

    @property
    def _full(self) -> tuple[str, Stamp, str, Stamp, str]:
        return self.target, self.target_time, self.source, self.time, self.fixed or ""


def question(target_frame: str, source_frame: str, time: Any) -> LookupRequest:
    """Check the arguments of a lookup in users' code; return them as a `LookupRequest`.

    Raises:
        TypeError: If a frame is not a string, or the time is not a Time.
    """
    _require_names(target_frame=target_frame, source_frame=source_frame)
    return LookupRequest(target_frame, source_frame, stamp(time))


def full_question(
    target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
) -> LookupRequest:
    """Check the arguments of a lookup at two times; return them as a `LookupRequest`.

    Raises:
        TypeError: If a frame is not a string, or a time is not a Time.
    """
    _require_names(target_frame=target_frame, source_frame=source_frame, fixed_frame=fixed_frame)
    return LookupRequest(
        target_frame, source_frame, stamp(source_time), stamp(target_time), fixed_frame
    )


def _require_names(**frames: object) -> None:
    for argument, frame in frames.items():
        if not isinstance(frame, str):
            raise TypeError(f"{argument} must be a frame's name, not {type(frame).__name__}")


def stamp(time: Any) -> Stamp:
    """Return a Time of rclpy or a builtin_interfaces message in nanoseconds.

    Raises:
        TypeError: If the value is not a Time.
    """
    if isinstance(time, Time):
        return time.nanoseconds
    if hasattr(time, "sec") and hasattr(time, "nanosec"):
        return values.stamp_of(time)
    raise TypeError(
        f"a lookup's time must be an rclpy.time.Time (Time() means the latest), "
        f"not {type(time).__name__}"
    )


def length(timeout: Any) -> int:
    """Return a Duration of rclpy in nanoseconds.

    Raises:
        TypeError: If the value is not a Duration.
    """
    if isinstance(timeout, Duration):
        return timeout.nanoseconds
    raise TypeError(
        f"a timeout must be an rclpy.duration.Duration, not {type(timeout).__name__}: "
        "write Duration(seconds=1.0)"
    )


class BufferCore:
    """Buffer of frames and the transforms between them, without waiting.

    The methods that end in `_core` have the arguments of `Buffer`'s methods except the timeout, and
    raise at once if a transform is not available.

    Attributes:
        frames: tftool's buffer, which stores the transforms.
        hints: Record of failed lookups, which logs hints.
    """

    def __init__(self, cache_time: Duration | None = None) -> None:
        self._program = program.current()
        kept = 10_000_000_000 if cache_time is None else length(cache_time)
        self.frames = Frames(kept, log=self._log)
        self.hints = LookupHints(self._program, self.frames)

    def _log(self, level: str, text: str) -> None:
        owner = self._program
        owner.say("ERROR" if level == "ERROR" else "WARN", owner.name, text)

    def _ask(self, request: Callable[[], Any]) -> Any:
        return self._program.ask(request)

    # Inserts

    def set_transform(self, transform: Any, authority: str) -> None:
        """Insert a sample of a moving transform; a rejection is logged."""
        sample = values.pack_transform(transform)
        self._ask(lambda: self.frames.set_transform(sample, authority))

    def set_transform_static(self, transform: Any, authority: str) -> None:
        """Insert a static transform; a rejection is logged."""
        sample = values.pack_transform(transform)
        self._ask(lambda: self.frames.set_transform_static(sample, authority))

    def clear(self) -> None:
        """Drop all moving transforms; static ones stay."""
        self._ask(self.frames.clear)

    # Lookups

    def answer(self, asked: LookupRequest) -> Any:
        """Look a transform up; return it as a geometry_msgs TransformStamped message."""
        return values.unpack_transform(self._ask(lambda: self._looked_up(asked)))

    def _looked_up(self, asked: LookupRequest) -> TransformStamped:
        try:
            found = asked.answer(self.frames)
        except TransformException as error:
            self.hints.refuse(asked.target, asked.source, error)
            raise
        if asked.fixed is None:
            self.hints.answer(asked.target, asked.source, asked.time)
        return found

    def _whether_now(self, asked: LookupRequest) -> tuple[int, str]:
        reason: str = self._ask(lambda: self._why_not(asked))
        if reason:
            self._program.looked_in_vain()
        return int(not reason), reason

    def _why_not(self, asked: LookupRequest) -> str:
        reason = asked.why_not(self.frames)
        self.hints.wait()
        if reason:
            self.hints.look_in_vain(asked.target, asked.source)
        return reason

    def lookup_transform_core(self, *asked: Any, **named: Any) -> Any:
        """Return the pose of source in target as a geometry_msgs TransformStamped message.

        Raises:
            TransformException: If the transform is not available.
        """
        return self.answer(question(*asked, **named))

    def lookup_transform_full_core(self, *asked: Any, **named: Any) -> Any:
        """Return the pose of source at one time in target at another, via a fixed frame.

        Raises:
            TransformException: If the transform is not available.
        """
        return self.answer(full_question(*asked, **named))

    def can_transform_core(self, *asked: Any, **named: Any) -> tuple[int, str]:
        """Return (whether a lookup would succeed, the reason if not)."""
        return self._whether_now(question(*asked, **named))

    def can_transform_full_core(self, *asked: Any, **named: Any) -> tuple[int, str]:
        """Return (whether a lookup at two times would succeed, the reason if not)."""
        return self._whether_now(full_question(*asked, **named))

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """Return the newest time for which all edges between two frames have data."""
        stamp = self._ask(lambda: self.frames.get_latest_common_time(target_frame, source_frame))
        return Time(nanoseconds=stamp)

    # Lists of frames

    def all_frames_as_yaml(self) -> str:
        """Return a description of all frames in tf2's YAML format."""
        return str(self._ask(self.frames.all_frames_as_yaml))

    def all_frames_as_string(self) -> str:
        """Return a text with every frame and its parent, as tf2 formats it."""
        return str(self._ask(self.frames.all_frames_as_string))

    def _allFramesAsDot(self, time: float = 0.0) -> str:  # noqa: N802
        return str(self._ask(self.frames.all_frames_as_dot))

    def _getFrameStrings(self) -> list[str]:  # noqa: N802
        return list(self._ask(self.frames.frames))

    def _frameExists(self, frame: str) -> bool:  # noqa: N802
        return bool(self._ask(lambda: self.frames.frame_exists(frame)))


class Buffer(BufferCore, BufferInterface):
    """Buffer of a node, with lookups that wait; a `TransformListener` fills it."""

    def __init__(self, cache_time: Duration | None = None, node: Node | None = None) -> None:
        BufferCore.__init__(self, cache_time)
        BufferInterface.__init__(self)
        if node is not None:
            frames: Any = INTERFACES.find("tf2_msgs", "srv", "FrameGraph")
            node.create_service(frames, "tf2_frames", self._answer_frames)

    def _answer_frames(self, request: Any, response: Any) -> Any:
        response.frame_yaml = self.all_frames_as_yaml()
        return response

    # Lookups that block

    def _look_up(self, asked: LookupRequest, timeout: Any) -> Any:
        self._wait(asked, timeout)
        return self.answer(asked)

    def _whether(self, asked: LookupRequest, timeout: Any) -> tuple[int, str]:
        self._wait(asked, timeout)
        return self._whether_now(asked)

    def _wait(self, asked: LookupRequest, timeout: Any) -> None:
        """Wait for a transform that may still become available, at most for the timeout."""
        limit = length(timeout)
        if limit > 0:
            self.hints.wait()
            self._ask(lambda: self._until(asked, limit))

    async def _until(self, asked: LookupRequest, limit: int) -> None:
        clock = self._program.clock
        attempt = asyncio.ensure_future(asked.wait(self.frames, clock))
        try:
            await self._program.first_of(attempt, until=clock.now() + limit, phase=Phase.WATCH)
        finally:
            attempt.cancel()
            await asyncio.gather(attempt, return_exceptions=True)

    # Lookups that return futures

    def wait_for_transform_async(self, *asked: Any, **named: Any) -> Future:
        """Return a future that completes with the transform as soon as it is available."""
        return self.promise(question(*asked, **named))

    def wait_for_transform_full_async(self, *asked: Any, **named: Any) -> Future:
        """Return a future that completes with the transform between two times when available."""
        return self.promise(full_question(*asked, **named))

    def promise(self, asked: LookupRequest) -> Future:
        """Return a future that completes with the requested transform once it is available."""
        future = Future(executor=self._program.executor)
        self.hints.wait()

        def attempt() -> bool:
            if future.cancelled():
                return True
            try:
                found = asked.answer(self.frames)
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

            stops.append(self.frames.listen(on_sample))

        self._ask(start)
        return future

    async def lookup_transform_async(self, *asked: Any, **named: Any) -> Any:
        """Await a transform, and return it."""
        await self.wait_for_transform_async(*asked, **named)
        return self.lookup_transform_core(*asked, **named)

    async def lookup_transform_full_async(self, *asked: Any, **named: Any) -> Any:
        """Await a transform between two times, and return it."""
        await self.wait_for_transform_full_async(*asked, **named)
        return self.lookup_transform_full_core(*asked, **named)
