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
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from typing import Any

from tftool.base.errors import InputError, UsageError
from tftool.base.plain_text import visible
from tftool.recordings.find import is_url

ANSWERS_WITHIN = "20s"
"""Longest wait for a scheduler's response."""


@contextmanager
def connected(address: str) -> Iterator[Executor]:
    """Connect to the scheduler of a Dask cluster.

    If a worker ends, another worker repeats its work.

    Args:
        address: Address of the scheduler, "tcp://HOST:8786".

    Raises:
        UsageError: If Dask is not installed, or the address is invalid.
        InputError: If no scheduler responds at the address.
    """
    try:
        import distributed
    except ImportError:
        raise UsageError(
            "--scheduler needs an extra: pip install 'tftool-tf2[fleet]', or use --jobs on this "
            "machine."
        ) from None
    # Dask logs every start and end of a worker, which does not interest the user.
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    # Created without its constructor, so that it can be closed if the constructor fails. Otherwise
    # garbage collection would close it, and that could happen while the next client is constructed,
    # which would wait forever for a lock.
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
                f"'{visible(address)}' is not the address of a Dask scheduler: write "
                "tcp://HOST:8786."
            ) from error
        yield client.get_executor()
    finally:
        client.close()


_ON_CLUSTER = 512
"""Most recordings submitted to a cluster at the same time."""


@dataclass(frozen=True, slots=True)
class Workers:
    """Factory of executors of one kind: this process, a process pool, or a cluster.

    Attributes:
        count: Number of recordings processed at the same time.
        window: Number of recordings submitted to the executor, both running and waiting.
        open: Function that returns an executor; called again after a failure of the executor.
        is_remote: Whether recordings need absolute paths, on a file system that all workers share.
    """

    count: int
    window: int
    open: Callable[[], AbstractContextManager[Executor]]
    is_remote: bool = False

    def place(self, source: str) -> str:
        """Return the path or URL that a worker uses to open a recording."""
        return os.path.abspath(source) if self.is_remote and not is_url(source) else source


class _Here(Executor):
    """Executor that runs each task in this process, inside the call of `submit`."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future


def processes(count: int) -> ProcessPoolExecutor:
    """Return a pool of `count` processes on this machine."""
    # Spawned, not forked, because a fork copies locks of other threads. The terminal sends Ctrl-C
    # to every process: the default handler ends a worker without a traceback.
    end_with_ctrl_c = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    return ProcessPoolExecutor(count, get_context("spawn"), end_with_ctrl_c)


def workers_of(count: int, scheduler: str) -> Workers:
    """Return the executors that the options --jobs and --scheduler select.

    Raises:
        UsageError: If both options are given.
    """
    if not scheduler:
        return (
            Workers(1, 1, _Here)
            if count == 1
            else Workers(count, 4 * count, partial(processes, count))
        )
    if count != 1:
        raise UsageError("--scheduler and --jobs are two ways to share the work: leave one out.")
    return Workers(1, _ON_CLUSTER, partial(connected, scheduler), is_remote=True)
