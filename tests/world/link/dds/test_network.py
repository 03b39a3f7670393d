"""Tests of the packets that leave this machine, in a network namespace with a fake LAN."""

import json
import shutil
import subprocess
import sys

import pytest

SETUP = """
echo 1 > /proc/sys/net/ipv6/conf/all/disable_ipv6
ip link set lo up
ip link add lan0 type veth peer name lan1
ip link set lan1 up
ip addr add 10.99.0.1/24 dev lan0
ip link set lan0 up multicast on
ip route add default dev lan0
exec "$@"
"""

CHILD = """
import asyncio, json, subprocess, sys
from pathlib import Path
from tests.world.link.conftest import until
from tests.world.link.dds.test_session import joined, transform

def sent():
    lines = Path("/proc/net/dev").read_text().splitlines()
    return int(next(line for line in lines if "lan0" in line).split(":")[1].split()[8])

async def scene(reach):
    async with joined(7, **reach) as (robot, _):
        robot.broadcast([transform("base", "laser")], "mounting", static=True)
        words = [sys.executable, "-m", "tftool", "tree", "--domain", "7", *sys.argv[1:]]
        asked = await asyncio.create_subprocess_exec(*words, stdout=subprocess.PIPE)
        seen, _ = await asked.communicate()
    return seen.decode()

before = sent()
seen = asyncio.run(scene({}))
after = sent()
from tftool.world.link.dds.participant import Participant
from tftool.world.link.dds.settings import network
Participant(8, network(("lan0",), {}), "control", b"").close()
print(json.dumps({"before": before, "after": after, "control": sent(), "seen": seen}))
"""


@pytest.fixture(scope="module")
def fenced():
    """Return a function that runs a program in a separate network."""
    for tool in ("unshare", "ip"):
        if shutil.which(tool) is None:
            pytest.skip(f"no '{tool}' to make a network with: apt install iproute2 util-linux")
    begin = ["unshare", "-n", "sh", "-ec", SETUP, "sh"]
    trial = subprocess.run([*begin, "true"], capture_output=True, text=True)
    if trial.returncode:
        pytest.skip(f"a network of its own is not permitted here: {trial.stderr.strip()}")
    return begin


def test_no_packet_leaves_the_loopback_unless_an_interface_is_named(fenced):
    words = [*fenced, sys.executable, "-c", CHILD, "--dds"]
    done = subprocess.run(words, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout.splitlines()[-1])

    assert "laser" in found["seen"]
    assert "mounting" in found["seen"]
    assert found["before"] == found["after"] == 0
    # The counter works: other machines are searched at once on the named interface.
    assert found["control"] > 0
