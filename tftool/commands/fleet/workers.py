"""Executors for many recordings: this process, several processes, or a cluster."""

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
from tftool.recordings.remote_files import is_url

_ON_CLUSTER = 512
"""Recordings that wait at a cluster at once."""


class Workers(Protocol):
    """Base of the executors.

    Attributes:
        count: How many recordings are worked on at once.
        window: How many are handed over at once.
        place: A recording's path for the workers.
    """

    count: int
    window: int

    def open(self) -> AbstractContextManager[Executor]:
        """Return an executor; after a failure, a new one."""

    def place(self, source: str) -> str:
        """Return the path or URL under which the workers open a recording."""


class OneProcess:
    """Executor that does all work in this process."""

    count = window = 1

    def open(self) -> AbstractContextManager[Executor]:
        """Return an executor that does the work at once."""
        return _Here()

    def place(self, source: str) -> str:
        """Return the name unchanged."""
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
    """Executor with several processes on this machine.

    Args:
        count: How many.
    """

    def __init__(self, count: int) -> None:
        self.count = count
        self.window = 4 * count

    def open(self) -> AbstractContextManager[Executor]:
        """Return a pool of processes."""
        # Spawned, not forked: a fork would carry over threads and locks.
        return ProcessPoolExecutor(
            self.count, mp_context=get_context("spawn"), initializer=_end_with_ctrl_c
        )

    def place(self, source: str) -> str:
        """Return the name unchanged."""
        return source


def _end_with_ctrl_c() -> None:
    """Let Ctrl-C end a worker silently: the terminal sends it to every process."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class Cluster:
    """A cluster of Dask workers.

    Args:
        address: Address of its scheduler.
    """

    count = 1
    window = _ON_CLUSTER

    def __init__(self, address: str) -> None:
        self.address = address

    def open(self) -> AbstractContextManager[Executor]:
        """Return an executor of the cluster."""
        from tftool.commands.fleet.cluster import connected

        return connected(self.address)

    def place(self, source: str) -> str:
        """Return the absolute path: all workers share the file system."""
        return source if is_url(source) else os.path.abspath(source)


def workers_of(processes: int, scheduler: str) -> Workers:
    """Return the executor that the command's options choose.

    Raises:
        UsageError: If both are given.
    """
    if not scheduler:
        return OneProcess() if processes == 1 else Processes(processes)
    if processes != 1:
        raise UsageError("--scheduler replaces --jobs: leave --jobs out.")
    return Cluster(scheduler)
