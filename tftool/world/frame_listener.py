"""Recorder of a world's transforms in a separate buffer."""

import asyncio
from collections.abc import Coroutine, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

from tftool.base.stamps import Duration
from tftool.buffer.buffer import NO_LIMIT, Buffer
from tftool.frames.transform_log import TransformLog
from tftool.world.clock import Clock, run
from tftool.world.world import TransformMessage, World

T = TypeVar("T")


@contextmanager
def heard_in(world: World, cache_time: Duration | None) -> Iterator[tuple[Buffer, TransformLog]]:
    """Record every transform of a world in a separate buffer, and in order of arrival.

    Args:
        world: World that broadcasts them.
        cache_time: How far back the buffer remembers; all of it if None. The world's own buffer
            prunes, and a later question may ask for any moment.
    """
    buffer = Buffer(cache_time or NO_LIMIT, max_frames=world.buffer.max_frames)
    log = TransformLog()

    def hear(message: TransformMessage, *, is_static: bool) -> None:
        log.hear(world.clock.now(), message.transforms, message.authority, is_static=is_static)
        set_transform = buffer.set_transform_static if is_static else buffer.set_transform
        for one in message.transforms:
            set_transform(one, message.authority)

    stops = [
        world.tf.subscribe(lambda message: hear(message, is_static=False)),
        world.tf_static.subscribe(lambda message: hear(message, is_static=True)),
    ]
    try:
        yield buffer, log
    finally:
        for stop in stops:
            stop()


def run_apart(clock: Clock, work: Coroutine[Any, Any, T]) -> T:
    """Run work on a world's clock; in a new thread if a loop already runs here."""
    try:
        asyncio.get_running_loop()
    except RuntimeError:
        return run(clock, work)
    from concurrent.futures import ThreadPoolExecutor

    # A loop cannot run inside another one: in a notebook the caller's waits meanwhile.
    with ThreadPoolExecutor(1, "tftool.open") as pool:
        return pool.submit(run, clock, work).result()
