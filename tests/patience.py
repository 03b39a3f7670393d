"""Time limits of tests for effects of other processes and threads."""

import threading

PATIENCE = 180
"""Seconds after which a test stops waiting; much more than any wait on a slow, busy machine."""


def answered(ask):
    """Return a function's result; fail if the function does not return in time."""
    given = []
    asking = threading.Thread(target=lambda: given.append(ask()), daemon=True)
    asking.start()
    asking.join(PATIENCE)
    assert given, "it raised, or hangs"
    return given[0]
