"""Dask cluster as an executor; the only file that imports Dask."""

import logging
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import Any

from tftool.base.errors import InputError, UsageError
from tftool.base.escaping import visible

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
