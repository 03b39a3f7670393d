"""Domains of their own for every test process, all of it on the loopback of this machine."""

import tempfile
from pathlib import Path

import pytest

pytest.importorskip("cyclonedds", reason="cyclonedds is not installed: pip install '.[dds]'")

fcntl = pytest.importorskip("fcntl", reason="domains are shared out by file locks")

VARIABLES = (
    "CYCLONEDDS_URI",
    "ROS_AUTOMATIC_DISCOVERY_RANGE",
    "ROS_DOMAIN_ID",
    "ROS_LOCALHOST_ONLY",
    "ROS_STATIC_PEERS",
)


@pytest.fixture(scope="session")
def domain():
    """A domain that no other test process of this machine uses meanwhile."""
    for number in range(1, 100):
        path = Path(tempfile.gettempdir()) / f"tftool-test-domain-{number}"
        with path.open("w") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                continue
            yield number
            return
    raise AssertionError("all domains are in use")


@pytest.fixture(autouse=True)
def plain_environment(monkeypatch, domain):
    for name in VARIABLES:
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
