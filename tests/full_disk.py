"""A disk that is full after some bytes, as a limit of this process."""

import contextlib
import signal
import sys


@contextlib.contextmanager
def full_disk(size):
    """Let no file of this process grow beyond `size` bytes while the block runs."""
    # Only POSIX has limits of a process; tests on Windows are skipped.
    import resource

    ignored = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    # Python 3.11 would store incomplete bytecode of a module that is imported now, and fail later.
    caching, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        sys.dont_write_bytecode = caching
        signal.signal(signal.SIGXFSZ, ignored)
