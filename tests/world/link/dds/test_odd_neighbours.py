"""Tests of neighbours with other definitions, with equal names, and of too many neighbours."""

import asyncio
import socket
import subprocess
import sys
from contextlib import ExitStack, suppress

import pytest

from tests.world.link.conftest import until
from tests.world.link.dds.test_session import joined, nodes_of, transform
from tftool.app.main import main
from tftool.base.stamps import seconds
from tftool.messages.classes import INTERFACES, Interfaces
from tftool.messages.hashes import type_hash
from tftool.world.clock import WallClock
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION, TF, Endpoint, Quality
from tftool.world.link.dds.dds_types import Types
from tftool.world.link.dds.discovery import LATEST_OF_ALL, Information
from tftool.world.link.dds.participant import Participant
from tftool.world.link.dds.settings import MOST_PARTICIPANTS, network
from tftool.world.link.graph import NODE
from tftool.world.link.session_world import twins

STRING = INTERFACES.message("std_msgs/msg/String")


def test_a_type_of_the_same_name_and_another_definition_is_named_and_not_read(domain):
    other = Interfaces()
    other.recorded("std_msgs/msg/String", "int32 data")
    other.define("std_msgs/msg/String", "int32 data")
    beside = f"typehash={type_hash(other, 'std_msgs/msg/String')};".encode()

    async def scene():
        async with joined(domain, read_only=True) as (world, link):
            heard = []
            world.topic("chatter", STRING).subscribe(heard.append, "test")
            robot = Participant(domain, network(()), "robot", b"enclave=/;")
            try:
                raw = Types(other).raw("std_msgs/msg/String")
                writer = robot.writer("rt/chatter", raw, Quality(), beside)
                await until(lambda: link.graph.entities(PUBLISHER, name="chatter"))
                await until(
                    lambda: any("another definition" in one.text for one in world.log.records)
                )
                writer.put(b"\0\1\0\0\5\0\0\0")
                told = [one.text for one in world.log.records]
            finally:
                robot.close()
            await until(lambda: link.graph.is_empty)
            return told, heard, link.refused

    told, heard, refused = asyncio.run(scene())
    assert (heard, refused) == ([], 0)
    assert any(
        "'robot' publishes 'chatter' with another definition of std_msgs/msg/String" in one
        for one in told
    )


def test_two_robots_of_equal_names_are_told_apart_and_said(domain):
    async def scene():
        async with joined(domain) as (one, _), joined(domain) as (two, _):
            one.broadcast([transform("odom", "base")], "wheels")
            two.broadcast([transform("odom", "base")], "wheels")
            async with joined(domain, read_only=True) as (world, link):
                await until(lambda: len(link.graph.entities(PUBLISHER, name="tf")) == 2)
                await until(lambda: nodes_of(link, "tf") == {"wheels"})
                await until(lambda: twins(world))
                return twins(world)

    assert asyncio.run(scene()) == [
        "2 nodes called 'wheels' send transforms: was the node started twice?"
    ]


def test_a_reliable_reader_takes_what_a_best_effort_publisher_offers(domain):
    async def scene():
        async with joined(domain) as (robot, _), joined(domain, read_only=True) as (world, _):
            heard = []
            world.topic("chatter", STRING).subscribe(heard.append, "test")
            publisher = Endpoint(
                PUBLISHER, "talker", "chatter", STRING.interface__, Quality(is_reliable=False)
            )
            robot.endpoints.add(publisher)
            topic = robot.topic("chatter", STRING)
            while not heard:
                topic.publish(STRING(data="hello"), publisher)
                await WallClock().sleep(seconds(0.01))
            return heard[0].data

    assert asyncio.run(scene()) == "hello"


def test_a_machine_full_of_participants_is_said_with_what_to_do(domain, capsys):
    first = 7410 + 250 * domain
    with ExitStack() as stack:
        for index in range(MOST_PARTICIPANTS + 1):
            taken = stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
            taken.bind(("127.0.0.1", first + 2 * index))
        assert main(["tree", "--dds"]) == 3
    said = " ".join(capsys.readouterr().err.split())
    assert "all 121 participant numbers of this machine are in use" in said
    assert "--domain" in said


def test_a_recording_is_not_played_beside_a_robot_unless_forced(domain, tmp_path, peer, capsys):
    writers = pytest.importorskip("tests.recordings.writers", reason="writes the test files")
    file = writers.write_mcap(tmp_path / "run.mcap", writers.content(20))
    foreign = peer("cyclone", "pub", 100_000)
    asyncio.run(until(lambda: ["ready"] in foreign.lines))

    assert main(["play", str(file), "--dds"]) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert "/tf has publishers here" in said
    assert "--force" in said
    assert main(["play", str(file), "--dds", "--force"]) == 0


def test_echo_waits_for_a_robots_frames_and_prints_them(peer, domain, capsys):
    peer("cyclone", "pub", 100_000)

    assert main(["echo", "base", "laser", "--dds", "--once"]) == 0
    assert "- Translation: [0.500, 0.000, 0.000]" in capsys.readouterr().out


def test_explain_listens_until_a_robots_statics_have_come(peer, domain, capsys):
    foreign = peer("fast", "pub", 100_000)
    asyncio.run(until(lambda: ["ready"] in foreign.lines))

    assert main(["explain", "base", "laser", "--dds", "--for", "0.1"]) == 0
    assert "laser in base" in capsys.readouterr().out


def test_a_read_only_process_has_no_publishers(domain):
    async def scene():
        async with joined(domain) as (_, link), joined(domain, read_only=True) as (world, looking):
            world.broadcast([transform("odom", "base")], "wheels")
            await until(lambda: link.graph.entities(SUBSCRIPTION, name="tf"))
            await until(lambda: looking.graph.entities(SUBSCRIPTION, name="tf"))
            return link.graph.entities(PUBLISHER)

    assert asyncio.run(scene()) == []


def test_nodes_of_releases_before_iron_are_named_too(domain):
    form = Information(24)

    async def scene():
        async with joined(domain, read_only=True) as (_, link):
            robot = Participant(domain, network(()), "robot", b"enclave=/;")
            try:
                raw = Types(INTERFACES).raw("tf2_msgs/msg/TFMessage")
                writer = robot.writer("rt/tf", raw, TF, b"")
                informing = robot.writer("ros_discovery_info", form.raw(), LATEST_OF_ALL, b"")
                nodes = {"arm/driver": (set(), {writer.gid})}
                informing.put(form.encode(robot.gid, nodes))
                await until(lambda: nodes_of(link, "tf") == {"arm/driver"})
                return {one.node for one in link.graph.entities(NODE)}
            finally:
                robot.close()

    assert asyncio.run(scene()) == {"arm/driver"}


def test_garbage_on_the_network_is_one_line_and_counted(domain, tmp_path, monkeypatch):
    monkeypatch.setenv("TFTOOL_SESSION_DIR", str(tmp_path))
    words = ["monitor", "--dds", "--domain", str(domain), "--json", "--for", "6"]
    garbage = b"RTPS\2\3\1\x10" + bytes(12) + b"\xe0\xff\x10\x00" + bytes(range(200))
    with (
        subprocess.Popen(
            [sys.executable, "-m", "tftool", *words],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        ) as command,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender,
    ):
        while command.poll() is None:
            for offset in range(10, 30):
                sender.sendto(garbage, ("127.0.0.1", 7400 + 250 * domain + offset))
            with suppress(subprocess.TimeoutExpired):
                command.wait(0.01)
        told = command.stderr.read()

    assert command.returncode == 0, told
    lines = [line for line in told.splitlines() if "malformed" in line]
    assert "The DDS library: recv: malformed packet" in lines[0]
    assert "times so far)" in lines[-1]
    assert len(lines) < 6
