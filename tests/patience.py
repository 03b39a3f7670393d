"""How long a test waits for what other processes and threads bring about."""

PATIENCE = 180
"""Seconds until it is given up: many times what anything here takes on a slow, busy machine."""
