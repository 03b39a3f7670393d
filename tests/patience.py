"""How long a test waits for what other processes and threads bring about."""

import threading

PATIENCE = 180
"""Seconds until it is given up: many times what anything here takes on a slow, busy machine."""


def answered(ask):
    """What a function gives, of which a test wants to know whether it hangs."""
    given = []
    asking = threading.Thread(target=lambda: given.append(ask()), daemon=True)
    asking.start()
    asking.join(PATIENCE)
    assert given, "it raised, or hangs"
    return given[0]
