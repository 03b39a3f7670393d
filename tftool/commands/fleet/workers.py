"""Workers for many recordings: this process, several, or a cluster's."""

import os
import signal
from collections.abc import Callable
from concurrent.futures import (
    Executor,
    Future,
    ProcessPoolExecutor,
)
from contextlib import AbstractContextManager
from multiprocessing import get_context
from typing import Any, Protocol

from tftool.base.errors import UsageError

_ON_CLUSTER = 512
"""Recordings that wait at a cluster at once."""


class Workers(Protocol):
    """Place where the work is done.

    Attributes:
        count: How many recordings are worked on at once.
        window: How many are handed over at once.
        place: Where a recording is, for the workers.
    """

    count: int
    window: int

    def open(self) -> AbstractContextManager[Executor]:
        """An executor; a second one, after the first one broke."""

    def place(self, source: str) -> str:
        """The path or URL under which the workers open a recording."""


class OneProcess:
    """This process does all of it."""

    count = window = 1

    def open(self) -> AbstractContextManager[Executor]:
        """An executor that works when it is asked to."""
        return _Here()

    def place(self, source: str) -> str:
        """As it was named."""
        return source


class _Here(Executor):
    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future


class Processes:
    """Several processes of this machine.

    Args:
        count: How many.
    """

    def __init__(self, count: int) -> None:
        self.count = count
        self.window = 4 * count

    def open(self) -> AbstractContextManager[Executor]:
        """A pool of them."""
        # Spawned, not forked: a fork would carry over threads and locks.
        return ProcessPoolExecutor(
            self.count, mp_context=get_context("spawn"), initializer=_end_with_ctrl_c
        )

    def place(self, source: str) -> str:
        """As it was named."""
        return source


def _end_with_ctrl_c() -> None:
    """Ctrl-C goes to all processes of a terminal; these end by it, and say nothing."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class Cluster:
    """A cluster of Dask workers.

    Args:
        address: Of its scheduler.
    """

    count = 1
    window = _ON_CLUSTER

    def __init__(self, address: str) -> None:
        self.address = address

    def open(self) -> AbstractContextManager[Executor]:
        """An executor of the cluster."""
        from tftool.commands.fleet.cluster import connected

        return connected(self.address)

    def place(self, source: str) -> str:
        """From the root of the file system, which all of them share."""
        from tftool.recordings.remote_files import is_url

        return source if is_url(source) else os.path.abspath(source)


def workers_of(processes: int, scheduler: str) -> Workers:
    """Return the workers that the options of a command choose.

    Raises:
        UsageError: If both say it.
    """
    if not scheduler:
        return OneProcess() if processes == 1 else Processes(processes)
    if processes != 1:
        raise UsageError("--scheduler says who works: leave out --jobs.")
    return Cluster(scheduler)
