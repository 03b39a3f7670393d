"""Coroutines that wait for a transform, with a deadline on a clock.

The coroutines do not poll: the insertion that makes a transform possible wakes the coroutine.
"""

import asyncio

from tftool.base.errors import (
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from tftool.base.stamps import Duration, Stamp, whole
from tftool.buffer.buffer import NEVER, Buffer
from tftool.buffer.sample import TransformStamped
from tftool.world.clock import Clock, Phase


async def wait_for_transform(
    buffer: Buffer,
    clock: Clock,
    target_frame: str,
    source_frame: str,
    time: Stamp = 0,
    timeout: Duration | None = None,
) -> TransformStamped:
    """Return the transform between two frames as soon as the buffer has the transform.

    Args:
        buffer: Buffer with the transforms.
        clock: Clock for the timeout.
        target_frame: Frame in which the pose is expressed.
        source_frame: Frame whose pose is returned.
        time: Time of the transform, nanoseconds; 0 for the latest common time.
        timeout: Longest wait, nanoseconds; None for no limit.

    Raises:
        TimeoutException: If no lookup succeeds in time; the cause is the last lookup's error.
        InvalidArgumentException: If a frame's name is invalid.
        TransformException: If the buffer has already dropped the transforms at that time.
        TypeError: If the time or the timeout is not a whole number.
    """
    deadline = None if timeout is None else clock.now() + whole(timeout)
    return await _wait(buffer, clock, target_frame, source_frame, time, deadline)


async def wait_for_transform_full(
    buffer: Buffer,
    clock: Clock,
    target_frame: str,
    target_time: Stamp,
    source_frame: str,
    source_time: Stamp,
    fixed_frame: str,
    timeout: Duration | None = None,
) -> TransformStamped:
    """Return the transform between frames at two times, via a fixed frame, once available.

    Raises the errors of `wait_for_transform`. If all three frames have the same name, and no such
    frame exists, LookupException is raised at once.
    """
    deadline = None if timeout is None else clock.now() + whole(timeout)
    while True:
        await _wait(buffer, clock, fixed_frame, source_frame, source_time, deadline)
        await _wait(buffer, clock, target_frame, fixed_frame, target_time, deadline)
        try:
            return buffer.lookup_transform_full(
                target_frame, target_time, source_frame, source_time, fixed_frame
            )
        except (InvalidArgumentException, LookupException):
            # A lookup of a frame in itself succeeds for any name, but here names are checked, so
            # waiting again would never end.
            raise
        except TransformException:
            # The first transform was pruned while the second one was waited for.
            continue


async def _wait(
    buffer: Buffer, clock: Clock, target: str, source: str, time: Stamp, deadline: Stamp | None
) -> TransformStamped:
    try:
        return buffer.lookup_transform(target, source, time)
    except InvalidArgumentException:
        raise
    except TransformException:
        pass

    answer: asyncio.Future[TransformStamped] = asyncio.get_running_loop().create_future()

    def answered(handle: int, available: bool) -> None:
        # Looked up during the insertion that made it available; later it may be pruned.
        if answer.done():
            return
        try:
            answer.set_result(buffer.lookup_transform(target, source, time))
        except TransformException as refusal:
            answer.set_exception(refusal)

    def expired(timer: "asyncio.Future[None]") -> None:
        if answer.done() or timer.cancelled():
            return
        try:
            answer.set_result(buffer.lookup_transform(target, source, time))
        except TransformException as refusal:
            late = "Timed out waiting for transform"
            answer.set_exception(
                TimeoutException(late, target=target, source=source, refusal=refusal)
            )

    handle = buffer.request(answered, target, source, time)
    if handle in (0, NEVER):
        return buffer.lookup_transform(target, source, time)
    timer = None if deadline is None else clock.timer(deadline, Phase.WATCH)
    if timer is not None:
        timer.add_done_callback(expired)
    try:
        return await answer
    finally:
        buffer.cancel(handle)
        if timer is not None:
            timer.cancel()
