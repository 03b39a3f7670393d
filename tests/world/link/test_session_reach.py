"""Tests of the reach of a session: domains, other machines, certificates, missing packages."""

import asyncio
import json

import pytest

from tests.certificates import certificates, needs_openssl
from tests.world.link.conftest import new_world, until
from tests.world.link.two import Two, play, sample, texts
from tftool.base.errors import LinkError
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.world.link.graph import Role, hosts
from tftool.world.link.link_options import Options
from tftool.world.link.session import Link
from tftool.world.link.zenoh import rendezvous
from tftool.world.link.zenoh.reach import ZenohReach
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world.supervisor import live


def test_domains_of_one_machine_hear_nothing_of_each_other():
    async def look():
        with Link(Options("demo", domain=3)) as host, Link(Options("echo", domain=4)) as other:
            world = new_world()
            host.attach(world, role=Role.HOST)
            other.attach(new_world(), role=Role.HOST)
            assert host.graph.is_empty
            assert not other.middleware.wire.neighbours

    play(look())


def free_port():
    import socket

    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def test_over_tcp_a_guest_reaches_every_process_of_the_other_machine(session_dir, monkeypatch):
    async def reach():
        port = free_port()
        with Link(Options("static")) as inner:
            inside = new_world()
            inner.attach(inside, role=Role.HOST)
            with Link(Options("demo", reach=ZenohReach(listen=(f"tcp/127.0.0.1:{port}",)))) as gate:
                gate.attach(new_world(), role=Role.HOST)
                # Another session folder represents another machine.
                monkeypatch.setenv("TFTOOL_SESSION_DIR", str(session_dir / "far"))
                with Link(
                    Options("echo", reach=ZenohReach(connect=(f"tcp/127.0.0.1:{port}",)))
                ) as far:
                    outside = new_world()
                    far.attach(outside, role=Role.GUEST)
                    inside.broadcast([sample(0, "A")], "static", static=True)
                    await until(lambda: outside.buffer.frame_exists("A"))
                    await until(lambda: len(far.graph.processes()) == 2)
                    outside.broadcast([sample(5, "B")], "far")
                    await until(lambda: inside.buffer.frame_exists("B"))

    play(reach())


def test_a_configuration_of_the_users_own_says_where_to_meet(tmp_path):
    def written(name, **endpoints):
        path = tmp_path / f"{name}.json5"
        where = {kind: {"endpoints": [endpoint]} for kind, endpoint in endpoints.items()}
        scouting = {"multicast": {"enabled": False}}
        path.write_text(json.dumps({"mode": "peer", "scouting": scouting, **where}))
        return Options("demo", reach=ZenohReach(config=path))

    async def meet():
        endpoint = f"tcp/127.0.0.1:{free_port()}"
        with Link(written("gate", listen=endpoint)) as gate:
            here = new_world()
            gate.attach(here, role=Role.HOST)
            Turtlesim(here)
            living = asyncio.ensure_future(live(here))
            here.broadcast([sample(0, "A")], "static", static=True)
            await until(lambda: here.has_service("spawn"))
            with Link(written("far", connect=endpoint, listen="tcp/127.0.0.1:0")) as far:
                there = new_world()
                far.attach(there, role=Role.GUEST)
                await until(lambda: there.buffer.frame_exists("A") and there.has_service("spawn"))
            living.cancel()
            await asyncio.gather(living, return_exceptions=True)

    play(meet())


def test_a_peer_that_talks_in_another_domain_is_said_once(session_dir, monkeypatch):
    async def look():
        port = free_port()
        options = Options("demo", domain=3, reach=ZenohReach(listen=(f"tcp/127.0.0.1:{port}",)))
        with Link(options) as gate:
            gate.attach(new_world(), role=Role.HOST)
            monkeypatch.setenv("TFTOOL_SESSION_DIR", str(session_dir / "far"))
            reach = ZenohReach(connect=(f"tcp/127.0.0.1:{port}",))
            with Link(Options("echo", reach=reach)) as far:
                world = new_world()
                far.attach(world, role=Role.HOST)
                await until(lambda: texts(world))
                gate_world = far.graph.foreign_domains
                assert gate_world == {3}
                assert texts(world) == [
                    "Another process runs in domain 3; this process runs in domain 0. "
                    "Neither process receives messages of the other. "
                    "To join: --domain 3."
                ]

    play(look())


def test_nobody_at_the_other_end_is_a_sentence(monkeypatch):
    monkeypatch.setattr("tftool.world.link.zenoh.middleware.REACHING", 0.2)

    with pytest.raises(LinkError, match=r"no process answers at tcp/127\.0\.0\.1:\d+ within"):
        Link(Options(reach=ZenohReach(connect=(f"tcp/127.0.0.1:{free_port()}",))))


def test_an_endpoint_that_cannot_be_is_a_sentence_and_leaves_nothing(session_dir):
    with pytest.raises(LinkError, match="the connection to the session cannot be opened"):
        Link(Options(reach=ZenohReach(listen=("pigeon/over:there",))))

    assert [path.name for path in (session_dir / "0").iterdir()] == ["lock"]


def test_a_link_without_zenoh_says_what_is_missing(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "zenoh", None)

    with pytest.raises(LinkError, match=r"'eclipse-zenoh', which cannot be imported.*--host"):
        Link(Options())


def test_where_there_are_no_unix_sockets_the_loopback_serves(monkeypatch):
    monkeypatch.setattr("tftool.world.link.zenoh.rendezvous.HAS_UNIX_SOCKETS", False)

    async def send():
        async with Two() as two:
            two.there.broadcast([sample(1)], "guest")
            two.here.broadcast([sample(0, "A")], "static", static=True)
            await until(lambda: two.there.buffer.frame_exists("A"))
            two.host.close()
            await until(lambda: not two.guest.graph.processes())

    play(send())


@needs_openssl
def test_over_tls_only_who_has_a_certificate_is_let_in(session_dir, monkeypatch, tmp_path):
    files = certificates(tmp_path)

    async def reach():
        endpoint = (f"tls/localhost:{free_port()}",)
        gate_options = Options("demo", reach=ZenohReach(listen=endpoint, certificates=files))
        with Link(gate_options) as gate:
            gate.attach(new_world(), role=Role.HOST)
            monkeypatch.setenv("TFTOOL_SESSION_DIR", str(session_dir / "far"))
            with Link(
                Options("echo", reach=ZenohReach(connect=endpoint, certificates=files))
            ) as far:
                assert hosts(far.graph.processes())
            monkeypatch.setattr("tftool.world.link.zenoh.middleware.REACHING", 1.0)
            (tmp_path / "stranger").mkdir()
            stranger = certificates(tmp_path / "stranger")
            with pytest.raises(LinkError, match="no process answers at tls/localhost") as refusal:
                Link(Options("echo", reach=ZenohReach(connect=endpoint, certificates=stranger)))
            assert f"certificate must be signed by {stranger.authority}" in str(refusal.value)
            plain = (endpoint[0].replace("tls/", "tcp/"),)
            with pytest.raises(LinkError, match="listens with tls/ does not answer tcp/"):
                Link(Options("echo", reach=ZenohReach(connect=plain)))

    play(reach())


def test_the_frames_of_a_session_are_listed_for_command_lines_while_a_process_lives():
    async def listed():
        async with Two() as two:
            static = TransformStamped(0, "world", "shelf", Transform((0.0, 0.0, 1.0)))
            two.here.buffer.set_transform_static(static, "me")
            await until(lambda: rendezvous.frames_known(0) == ["shelf", "world"])
            assert rendezvous.frames_known(1) == []

        assert rendezvous.frames_known(0) == []

    play(listed())
