"""Executors for many recordings: this process, several processes, or a cluster."""

import logging
import os
import signal
from collections.abc import Callable, Iterator
from concurrent.futures import (
    Executor,
    Future,
    ProcessPoolExecutor,
)
from contextlib import AbstractContextManager, contextmanager
from multiprocessing import get_context
from typing import Any, Protocol

from tftool.base.errors import InputError, UsageError
from tftool.base.escaping import visible
from tftool.recordings.remote_files import is_url

ANSWERS_WITHIN = "20s"
"""How long a scheduler may take to answer."""


@contextmanager
def connected(address: str) -> Iterator[Executor]:
    """Connect to the scheduler of a cluster.

    If a worker ends, another one gets its work.

    Args:
        address: "tcp://HOST:8786".

    Raises:
        UsageError: If Dask is not installed, or this is not an address.
        InputError: If no scheduler answers there.
    """
    try:
        import distributed
    except ImportError:
        raise UsageError(
            "--scheduler needs an extra: pip install 'tftool-tf2[fleet]'; --jobs does not."
        ) from None
    # Its log of workers that come and go is of no use to a user who waits for findings.
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    # Made apart from its constructor, so that it can be closed if that fails. Garbage collection
    # would close it otherwise; within the construction of the next client, that waits for ever for
    # the lock which this construction holds.
    client: Any = object.__new__(distributed.Client)
    try:
        try:
            client.__init__(address, timeout=ANSWERS_WITHIN, set_as_default=False)
        except (OSError, TimeoutError) as error:
            raise InputError(
                f"No Dask scheduler answers at '{visible(address)}': start one with "
                "'dask scheduler' and workers with 'dask worker'."
            ) from error
        except ValueError as error:
            raise UsageError(
                f"'{visible(address)}' is no address of a Dask scheduler: write tcp://HOST:8786."
            ) from error
        yield client.get_executor()
    finally:
        client.close()


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
