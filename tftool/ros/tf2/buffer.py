"""Transform buffers of tf2_ros and tf2_py, and registries of types to transform and convert.

A listener inserts each transform into its buffer on arrival, even while its node does not spin. A
callback can therefore wait for a transform; the timeout counts seconds of tftool's clock.
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
    """Error for a type of data for which no transformation or conversion is registered."""

    def __init__(self, errstr: str) -> None:
        super().__init__(errstr)
        self.errstr = errstr


class NotImplementedException(TransformException):
    """Error for a method that a class of buffers does not implement."""

    def __init__(self) -> None:
        super().__init__("CanTransform or LookupTransform not implemented")


class TransformRegistration:
    """Registry of functions that transform data, one function for each type of data."""

    def print_me(self) -> None:
        """Do nothing; the method exists in ROS 2."""

    def add(self, key: Any, callback: Callable[[Any, Any], Any]) -> None:
        """Register `callback(data, transform)`, which transforms data of the type `key`."""
        _transform[key] = callback

    def get(self, key: Any) -> Callable[[Any, Any], Any]:
        """Return the function that transforms data of the type `key`.

        Raises:
            TypeException: If no function is registered for the type.
        """
        return _of(_transform, key)


class ConvertRegistration:
    """Registry of functions that convert one type of data to another type."""

    def add_from_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Register `callback`, which converts a message to an object of the type `key`."""
        _from_msg[key] = callback

    def add_to_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Register `callback`, which converts an object of the type `key` to a message."""
        _to_msg[key] = callback

    def add_convert(self, key: tuple[Any, Any], callback: Callable[[Any], Any]) -> None:
        """Register `callback`, which converts the first type in `key` to the second type."""
        _convert[key] = callback

    def get_from_msg(self, key: Any) -> Callable[[Any], Any]:
        """Return the function that converts a message to an object of the type `key`."""
        return _of(_from_msg, key)

    def get_to_msg(self, key: Any) -> Callable[[Any], Any]:
        """Return the function that converts an object of the type `key` to a message."""
        return _of(_to_msg, key)

    def get_convert(self, key: tuple[Any, Any]) -> Callable[[Any], Any]:
        """Return the function that converts the first type in `key` to the second type."""
        return _of(_convert, key)


def _of(registry: dict[Any, T], key: Any) -> T:
    try:
        return registry[key]
    except KeyError:
        raise TypeException(f"Type {key} is not loaded or supported") from None


def convert(a: Any, b_type: Any) -> Any:
    """Convert the object `a` to the type `b_type`; return a copy if `a` has this type.

    If no function is registered for the two types, `a` is converted to a message first.
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
    """Base class of buffers, which transforms stamped data; subclasses implement the lookups."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def _look_up(self, request: "LookupRequest", timeout: Any) -> Any:
        """Return the requested transform; wait at most `timeout` until it is available.

        Raises:
            TransformException: If the transform is not available in time.
            NotImplementedException: If the class does not implement lookups.
        """
        raise NotImplementedException

    def _check(self, request: "LookupRequest", timeout: Any) -> tuple[int, str]:
        """Return whether a lookup succeeds within the timeout, as (1, "") or (0, reason)."""
        try:
            self._look_up(request, timeout)
        except NotImplementedException:
            raise
        except TransformException as error:
            return 0, str(error)
        return 1, ""

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = NOW
    ) -> Any:
        """Return the pose of the source frame in the target frame, as a TransformStamped message.

        Args:
            target_frame: Frame in which the pose is expressed.
            source_frame: Frame whose pose is requested.
            time: Time of the pose; `Time()` for the latest.
            timeout: Longest wait for the transform on tftool's clock, as a Duration.

        Raises:
            TransformException: If the transform is not available in time.
        """
        return self._look_up(lookup_request(target_frame, source_frame, time), timeout)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = NOW,
    ) -> Any:
        """Return the pose of the source frame at one time in the target frame at another time.

        Args:
            target_frame: Frame in which the pose is expressed.
            target_time: Time of the target frame.
            source_frame: Frame whose pose is requested.
            source_time: Time of the source frame.
            fixed_frame: Frame that does not move between the two times.
            timeout: Longest wait for the transform on tftool's clock, as a Duration.

        Raises:
            TransformException: If the transform is not available in time.
        """
        request = full_request(target_frame, target_time, source_frame, source_time, fixed_frame)
        return self._look_up(request, timeout)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Any = NOW,
        return_debug_tuple: bool = False,
    ) -> Any:
        """Return whether `lookup_transform` would succeed.

        With `return_debug_tuple`, return (1, "") or (0, reason) instead.
        """
        found = self._check(lookup_request(target_frame, source_frame, time), timeout)
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
        """Return whether `lookup_transform_full` would succeed.

        With `return_debug_tuple`, return (1, "") or (0, reason) instead.
        """
        request = full_request(target_frame, target_time, source_frame, source_time, fixed_frame)
        found = self._check(request, timeout)
        return found if return_debug_tuple else bool(found[0])

    def transform(
        self, object_stamped: Any, target_frame: str, timeout: Any = NOW, new_type: Any = None
    ) -> Any:
        """Transform a stamped message from the frame in its header to another frame.

        Args:
            object_stamped: Message with a header.
            target_frame: Frame of the result.
            timeout: Longest wait for the transform on tftool's clock, as a Duration.
            new_type: Type to which the result is converted; None for the type of the message.

        Raises:
            TypeException: If no transformation is registered for the type of the message.
            TransformException: If the transform is not available in time.
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
        """Transform a stamped message to another frame at another time, through a fixed frame.

        For the arguments see `transform` and `lookup_transform_full`.
        """
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
    """Request for the transform between two frames.

    Attributes:
        target: Frame in which the pose is expressed.
        source: Frame whose pose is requested.
        time: Time of the source frame, in nanoseconds; 0 for the latest.
        target_time: Time of the target frame, in nanoseconds, for a lookup with a fixed frame.
        fixed: Frame that does not move between the two times; None for a lookup at one time.
    """

    target: str
    source: str
    time: Stamp
    target_time: Stamp = 0
    fixed: str | None = None

    def answer(self, frames: Frames) -> TransformStamped:
        """Look up the transform in the buffer `frames`.

        Raises:
            TransformException: If the lookup fails.
        """
        if self.fixed is None:
            return frames.lookup_transform(self.target, self.source, self.time)
        return frames.lookup_transform_full(*self._full)

    def failure_reason(self, frames: Frames) -> str:
        """Return the reason why the lookup in the buffer `frames` fails; "" if it succeeds."""
        if self.fixed is None:
            return frames.why_not(self.target, self.source, self.time)
        return frames.why_not_full(*self._full)

    async def wait(self, frames: Frames, clock: Clock) -> None:
        """Wait until the lookup succeeds; raise an error as soon as it can never succeed."""
        if self.fixed is None:
            await waiting.wait_for_transform(frames, clock, self.target, self.source, self.time)
        else:
            await waiting.wait_for_transform_full(frames, clock, *self._full)

    @property
    def _full(self) -> tuple[str, Stamp, str, Stamp, str]:
        return self.target, self.target_time, self.source, self.time, self.fixed or ""


def lookup_request(target_frame: str, source_frame: str, time: Any) -> LookupRequest:
    """Check the arguments of `lookup_transform`; return a `LookupRequest`.

    Raises:
        TypeError: If a frame is not a string, or the time is not a Time.
    """
    _require_names(target_frame=target_frame, source_frame=source_frame)
    return LookupRequest(target_frame, source_frame, stamp(time))


def full_request(
    target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
) -> LookupRequest:
    """Check the arguments of `lookup_transform_full`; return a `LookupRequest`.

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
    """Return the nanoseconds in an rclpy Time or a builtin_interfaces Time message.

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


def nanoseconds_of(timeout: Any) -> int:
    """Return the nanoseconds in an rclpy Duration.

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
    """Buffer of transforms, whose lookups do not wait.

    The methods that end in `_core` have the arguments of `Buffer`'s methods without the timeout,
    and raise an error at once if a transform is not available.

    Attributes:
        frames: tftool's buffer, which stores the transforms.
        hints: Record of failed lookups, which logs hints.
    """

    def __init__(self, cache_time: Duration | None = None) -> None:
        self._program = program.current()
        kept = 10_000_000_000 if cache_time is None else nanoseconds_of(cache_time)
        self.frames = Frames(kept, log=self._log)
        self.hints = LookupHints(self._program, self.frames)

    def _log(self, level: str, text: str) -> None:
        owner = self._program
        owner.say("ERROR" if level == "ERROR" else "WARN", owner.name, text)

    def _ask(self, request: Callable[[], Any]) -> Any:
        return self._program.ask(request)

    # Inserts

    def set_transform(self, transform: Any, authority: str) -> None:
        """Insert a transform of `/tf`; log the reason if the buffer rejects the transform."""
        sample = values.pack_transform(transform)
        self._ask(lambda: self.frames.set_transform(sample, authority))

    def set_transform_static(self, transform: Any, authority: str) -> None:
        """Insert a static transform; log the reason if the buffer rejects the transform."""
        sample = values.pack_transform(transform)
        self._ask(lambda: self.frames.set_transform_static(sample, authority))

    def clear(self) -> None:
        """Remove all transforms except static transforms."""
        self._ask(self.frames.clear)

    # Lookups

    def answer(self, request: LookupRequest) -> Any:
        """Look up the requested transform; return a geometry_msgs TransformStamped message."""
        return values.unpack_transform(self._ask(lambda: self._looked_up(request)))

    def _looked_up(self, request: LookupRequest) -> TransformStamped:
        try:
            found = request.answer(self.frames)
        except TransformException as error:
            self.hints.record_failure(request.target, request.source, error)
            raise
        if request.fixed is None:
            self.hints.record_success(request.target, request.source, request.time)
        return found

    def _check_now(self, request: LookupRequest) -> tuple[int, str]:
        reason: str = self._ask(lambda: self._why_not(request))
        if reason:
            self._program.count_failed_query()
        return int(not reason), reason

    def _why_not(self, request: LookupRequest) -> str:
        reason = request.failure_reason(self.frames)
        self.hints.record_wait()
        if reason:
            self.hints.record_failed_check(request.target, request.source)
        return reason

    def lookup_transform_core(self, *args: Any, **kwargs: Any) -> Any:
        """Return the pose of the source frame in the target frame, as a TransformStamped message.

        Raises:
            TransformException: If the transform is not available.
        """
        return self.answer(lookup_request(*args, **kwargs))

    def lookup_transform_full_core(self, *args: Any, **kwargs: Any) -> Any:
        """Return the pose of the source frame at one time in the target frame at another time.

        Raises:
            TransformException: If the transform is not available.
        """
        return self.answer(full_request(*args, **kwargs))

    def can_transform_core(self, *args: Any, **kwargs: Any) -> tuple[int, str]:
        """Return whether `lookup_transform_core` would succeed, as (1, "") or (0, reason)."""
        return self._check_now(lookup_request(*args, **kwargs))

    def can_transform_full_core(self, *args: Any, **kwargs: Any) -> tuple[int, str]:
        """Return whether `lookup_transform_full_core` would succeed, as (1, "") or (0, reason)."""
        return self._check_now(full_request(*args, **kwargs))

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """Return the newest time at which all transforms between two frames are known."""
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
    """Buffer whose lookups can wait; a `TransformListener` inserts the transforms."""

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

    def _look_up(self, request: LookupRequest, timeout: Any) -> Any:
        self._wait(request, timeout)
        return self.answer(request)

    def _check(self, request: LookupRequest, timeout: Any) -> tuple[int, str]:
        self._wait(request, timeout)
        return self._check_now(request)

    def _wait(self, request: LookupRequest, timeout: Any) -> None:
        """Wait until the lookup succeeds or can never succeed, at most until the timeout."""
        limit = nanoseconds_of(timeout)
        if limit > 0:
            self.hints.record_wait()
            self._ask(lambda: self._until(request, limit))

    async def _until(self, request: LookupRequest, limit: int) -> None:
        clock = self._program.clock
        attempt = asyncio.ensure_future(request.wait(self.frames, clock))
        try:
            await self._program.first_of(attempt, until=clock.now() + limit, phase=Phase.WATCH)
        finally:
            attempt.cancel()
            await asyncio.gather(attempt, return_exceptions=True)

    # Lookups that return futures

    def wait_for_transform_async(self, *args: Any, **kwargs: Any) -> Future:
        """Return a future that completes with the transform as soon as the lookup succeeds."""
        return self.promise(lookup_request(*args, **kwargs))

    def wait_for_transform_full_async(self, *args: Any, **kwargs: Any) -> Future:
        """Return a future of the transform between two frames, each at its own time."""
        return self.promise(full_request(*args, **kwargs))

    def promise(self, request: LookupRequest) -> Future:
        """Return a future that completes with the transform as soon as the lookup succeeds."""
        future = Future(executor=self._program.executor)
        self.hints.record_wait()

        def attempt() -> bool:
            if future.cancelled():
                return True
            try:
                found = request.answer(self.frames)
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

    async def lookup_transform_async(self, *args: Any, **kwargs: Any) -> Any:
        """Wait until a transform is available, and return it."""
        await self.wait_for_transform_async(*args, **kwargs)
        return self.lookup_transform_core(*args, **kwargs)

    async def lookup_transform_full_async(self, *args: Any, **kwargs: Any) -> Any:
        """Wait for the transform between two frames, each at its own time; return the transform."""
        await self.wait_for_transform_full_async(*args, **kwargs)
        return self.lookup_transform_full_core(*args, **kwargs)
