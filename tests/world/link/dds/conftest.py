"""DDS domains for every test process, on the loopback interface of this machine."""

import hashlib
import os
import shutil
import subprocess
import tempfile
import threading
from pathlib import Path

import pytest

from tftool.world.link.dds.settings import network

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
    """Return a domain that no other test process of this machine uses at the same time."""
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


PEERS = Path(__file__).parent / "peers"
TOOLS = ("g++", "gcc", "idlc", "fastddsgen", "java")

RECIPE = (
    "fastddsgen -replace -d f tf.idl",
    "idlc -l c -o c tf.idl",
    "idlc -l c -o c service.idl",
    "gcc -O1 -Ic service_peer.c c/service.c -lddsc -o service_peer",
    "gcc -O1 -Ic cyclone_peer.c c/tf.c -lddsc -o cyclone_peer",
    "g++ -O0 -std=c++17 -w -If fast_peer.cpp f/tf.cxx f/tfPubSubTypes.cxx -lfastrtps -lfastcdr "
    "-lpthread -o fast_peer",
)

ON_LOOPBACK = network(()).xml()
"""Configuration of Cyclone DDS for the peer process, the same as tftool's own."""


@pytest.fixture(scope="session")
def peers():
    """Return the folder of the peers on Debian's Cyclone DDS and Fast DDS, built once."""
    missing = [tool for tool in TOOLS if shutil.which(tool) is None]
    if missing and not os.environ.get("CI"):
        pytest.skip(
            f"no {', '.join(missing)}: apt install libfastrtps-dev fastddsgen "
            "default-jre-headless g++ cyclonedds-dev cyclonedds-tools"
        )
    sources = b"".join(path.read_bytes() for path in sorted(PEERS.iterdir()))
    sources += str(RECIPE).encode()
    name = f"tftool-peers-{os.getuid()}-{hashlib.sha256(sources).hexdigest()[:16]}"
    folder = Path(tempfile.gettempdir()) / name
    folder.mkdir(exist_ok=True)
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (folder / "built").exists():
            build(folder)
            (folder / "built").touch()
    return folder


def build(folder):
    for path in PEERS.iterdir():
        shutil.copy(path, folder)
    for part in ("c", "f"):
        (folder / part).mkdir(exist_ok=True)
    for line in RECIPE:
        done = subprocess.run(
            line.split(), cwd=folder, capture_output=True, text=True, timeout=3600
        )
        assert done.returncode == 0, f"{line}\n{done.stdout}\n{done.stderr}"


class Peer:
    """Running peer, and the lines that it has printed."""

    def __init__(self, folder, kind, domain, *words):
        environment = {**os.environ, "CYCLONEDDS_URI": ON_LOOPBACK}
        command = [str(folder / f"{kind}_peer"), str(domain), *map(str, words)]
        self.process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stdin=subprocess.DEVNULL, env=environment, text=True
        )
        self.lines = []
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self.process.stdout:
            self.lines.append(line.split())

    def kill(self):
        self.process.kill()
        self.process.wait()
        self._reader.join()
        self.process.stdout.close()


@pytest.fixture
def peer(peers, domain):
    started = []

    def start(kind, *words):
        started.append(Peer(peers, kind, domain, *words))
        return started[-1]

    yield start
    for one in started:
        one.kill()
