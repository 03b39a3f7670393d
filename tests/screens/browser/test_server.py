"""Tests of the page's server, with requests of a browser and with forbidden ones."""

import asyncio
import errno
import gzip
import json
import math
import os
import socket
import struct
from http.client import HTTPConnection
from urllib.parse import parse_qs, quote, urlsplit

import numpy as np
import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from tests.patience import PATIENCE
from tftool.base.errors import TftoolError
from tftool.base.stamps import seconds
from tftool.buffer.buffer import NO_LIMIT
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.screens.browser import server
from tftool.screens.browser.server import PageServer
from tftool.world.clock import WallClock, run
from tftool.world.world import World


def serve(test, *, port=0, rate=500.0):
    """Run `test(world, page)` beside a server of that world."""
    clock = WallClock()

    async def main():
        world = World(clock)
        async with PageServer(world, port=port, rate=rate) as page:
            running = asyncio.ensure_future(page.run())
            try:
                return await asyncio.wait_for(test(world, page), PATIENCE)
            finally:
                running.cancel()

    return run(clock, main())


def put(world, x, *, parent="world", child="turtle", stamp=None):
    now = world.clock.now() if stamp is None else stamp
    world.broadcast([TransformStamped(now, parent, child, Transform((x, 0.0, 0.0)))], "test")


def open_page(page, **more):
    origin = more.pop("origin", page.origin)
    address = page.address("/frames").replace("http://", "ws://")
    return connect(address, origin=origin, compression=None, **more)


class Page:
    """Client that draws at once, and stores the last message of each kind."""

    def __init__(self, connection, *, draws=True):
        self.connection = connection
        self.draws = draws
        self.told = {}
        self.count = 0

    async def hear(self):
        """Receive messages up to the next poses."""
        while True:
            message = await self.connection.recv()
            if isinstance(message, str):
                said = json.loads(message)
                self.told[said["type"]] = said
                continue
            head = struct.unpack_from("<4sIIIdddd", message)
            self.sequence, self.revision, count = head[1:4]
            self.now, self.at, self.oldest, self.newest = head[4:]
            numbers = struct.unpack_from(f"<{11 * count}d", message, 48)
            self.poses = dict(
                zip(
                    self.told["frames"]["names"],
                    [numbers[11 * place : 11 * place + 7] for place in range(count)],
                    strict=True,
                )
            )
            self.count += 1
            if self.draws:
                await self.say(type="got", sequence=self.sequence)
            return

    async def until(self, condition):
        while not condition(self):
            await self.hear()

    async def say(self, **message):
        await self.connection.send(json.dumps(message))


def where(page, path):
    """Return the address of a path of the page's server, with its secret."""
    return page.address(path).removeprefix(page.origin)


def fetch(port, path="/", **headers):
    """Send an HTTP request from another thread, as a browser would."""

    def ask():
        connection = HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
        try:
            connection.putrequest("GET", path, skip_host="Host" in headers)
            for name, value in headers.items():
                connection.putheader(name, value)
            connection.endheaders()
            answer = connection.getresponse()
            return answer.status, dict(answer.getheaders()), answer.read()
        finally:
            connection.close()

    return asyncio.get_running_loop().run_in_executor(None, ask)


def test_the_page_and_its_files_are_served_with_a_strict_policy():
    async def test(world, page):
        assert page.url.startswith(f"http://127.0.0.1:{page.port}/?token=")
        for path, kind in (
            (where(page, "/"), "text/html"),
            (where(page, "/index.html") + "&x=1", "text/html"),
            ("/page.js", "text/javascript"),
            ("/page.css", "text/css"),
            ("/icon.svg", "image/svg+xml"),
            ("/three-LICENSE.txt", "text/plain"),
        ):
            status, headers, body = await fetch(page.port, path)
            assert status == 200
            assert headers["Content-Type"].startswith(kind)
            assert "default-src 'none'" in headers["Content-Security-Policy"]
            assert len(body) == int(headers["Content-Length"]) > 0

    serve(test)


def test_scripts_travel_compressed_to_a_browser_that_takes_it():
    async def test(world, page):
        accepts = {"Accept-Encoding": "gzip, deflate, br"}
        _, headers, packed = await fetch(page.port, "/page.js", **accepts)
        _, plain_headers, plain = await fetch(page.port, "/page.js")
        assert headers["Content-Encoding"] == "gzip"
        assert "Content-Encoding" not in plain_headers
        assert gzip.decompress(packed) == plain
        assert len(packed) < len(plain) / 3

    serve(test)


def test_meshes_travel_compressed_to_a_browser_that_takes_it(tmp_path):
    from tests.screens.browser.mesh_files import stl, write_package
    from tests.screens.browser.test_robots import ROBOT
    from tftool.robots.mesh_folders import MeshFolders
    from tftool.robots.robot_model import Robot
    from tftool.robots.urdf import parse_description
    from tftool.screens.browser.robots import ShownRobot

    folders = MeshFolders(write_package(tmp_path) / "urdf" / "arm.urdf")
    shown = ShownRobot(Robot(parse_description(ROBOT)), folders)
    address = folders.address("../meshes/a.stl")

    async def test(world, page):
        page.show_robot(shown)
        _, headers, packed = await fetch(
            page.port, where(page, address), **{"Accept-Encoding": "gzip"}
        )
        assert headers["Content-Encoding"] == "gzip"
        assert gzip.decompress(packed) == stl()

    serve(test)


def test_nothing_else_is_served():
    async def test(world, page):
        for path in ("/../server.py", "/page/main.js", "/etc/passwd", "//", "/frames/x"):
            status, _, body = await fetch(page.port, where(page, path))
            assert (status, body) == (404, b"There is no such page here.\n")

    serve(test)


@pytest.mark.parametrize("host", ["evil.example", "evil.example:8765", "127.0.0.1", ""])
def test_another_host_name_is_refused(host):
    # A name that a foreign name server resolves to 127.0.0.1 must not reach the server.
    async def test(world, page):
        status, _, body = await fetch(page.port, "/", Host=host)
        assert status == 403
        assert page.origin.encode() in body
        assert secret_of(page).encode() not in body

    serve(test)


def secret_of(page):
    return parse_qs(urlsplit(page.url).query)["token"][0]


@pytest.mark.parametrize("path", ["/", "/index.html", "/frames", "/tracks", "/mesh/0/a.stl",
                                  "/standalone.html"])  # fmt: skip
@pytest.mark.parametrize("query", ["", "?token=", "?token=guessed", "?view=a", "?token=\xe9"])
def test_other_users_of_the_machine_get_nothing_without_the_secret(path, query):
    async def test(world, page):
        put(world, 1.0)
        status, _, body = await fetch(page.port, path + quote(query, safe="?=&"))
        assert status == 403
        assert b"lacks the secret: open the address that 'tftool view' printed" in body
        assert b"turtle" not in body
        assert secret_of(page).encode() not in body

    serve(test)


def test_a_socket_without_the_secret_is_refused():
    async def test(world, page):
        address = f"ws://127.0.0.1:{page.port}/frames"
        with pytest.raises(InvalidStatus) as refused:
            await connect(address, origin=page.origin).__aenter__()
        assert refused.value.response.status_code == 403

    serve(test)


def test_every_server_has_a_secret_of_its_own():
    secrets = []

    async def test(world, page):
        secrets.append(secret_of(page))

    for _ in range(2):
        serve(test)
    assert len(set(secrets)) == 2
    assert min(map(len, secrets)) >= 32


def test_the_secret_is_in_no_log(caplog):
    async def test(world, page):
        with caplog.at_level(0, "tftool.view"):
            await fetch(page.port, where(page, "/standalone.html"))
            await fetch(page.port, where(page, "/nothing"))
        assert secret_of(page) not in caplog.text

    serve(test)


@pytest.mark.parametrize(
    "headers",
    [
        {"Origin": "http://evil.example"},
        {"Sec-Fetch-Site": "cross-site"},
        {"Sec-Fetch-Site": "same-site"},
        {"Origin": "null", "Sec-Fetch-Site": "same-origin"},
    ],
)
def test_another_site_gets_no_file(headers):
    async def test(world, page):
        path = where(page, "/standalone.html")
        status, _, body = await fetch(page.port, path, **headers)
        assert (status, body) == (403, b"The file is for this server's own page.\n")

    serve(test)


def much(world):
    """Insert so many samples that a file of them takes seconds to write."""
    count = 300_000
    stamps = world.clock.epoch + np.arange(count) * 1_000_000
    turns = np.tile([0.0, 0.0, 0.0, 1.0], (count, 1))
    places = np.random.default_rng(1).normal(size=(count, 3))
    world.buffer.cache_time = NO_LIMIT
    for child in ("a", "b"):
        world.buffer.set_records("world", child, records(stamps, places, turns))


def records(stamps, places, turns):
    return np.column_stack([stamps, np.hstack([places, turns]).view(np.int64)])


def test_one_file_is_written_at_a_time():
    async def test(world, page):
        much(world)
        path = where(page, "/standalone.html")
        answers = await asyncio.gather(*(fetch(page.port, path) for _ in range(4)))
        assert sorted(status for status, _, _ in answers) == [200, 503, 503, 503]
        assert {body for status, _, body in answers if status == 503} == {
            b"Another file is being written: try again later.\n"
        }
        assert (await fetch(page.port, path))[0] == 200

    serve(test)


def test_a_file_is_given_up_when_its_asker_leaves():
    async def test(world, page):
        much(world)
        path = where(page, "/standalone.html")
        _, writer = await asyncio.open_connection("127.0.0.1", page.port)
        writer.write(f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{page.port}\r\n\r\n".encode())
        await writer.drain()
        while (await fetch(page.port, path))[0] != 503:
            pass
        writer.close()
        while (await fetch(page.port, path, **{"Sec-Fetch-Site": "none"}))[0] == 503:
            pass

    serve(test)


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", "http://127.0.0.1:1", "file://", None]
)
def test_a_foreign_origin_gets_no_frames(origin):
    async def test(world, page):
        with pytest.raises(InvalidStatus) as refused:
            await open_page(page, origin=origin).__aenter__()
        assert refused.value.response.status_code == 403
        assert page.clients == set()

    serve(test)


def test_localhost_is_us_too():
    async def test(world, page):
        put(world, 1.0)
        url = f"localhost:{page.port}"
        query = urlsplit(page.url).query
        status, _, _ = await fetch(page.port, f"/?{query}", Host=url)
        assert status == 200
        async with connect(f"ws://{url}/frames?{query}", origin=f"http://{url}") as connection:
            client = Page(connection)
            await client.hear()
            assert client.poses["turtle"][0] == 1.0

    serve(test)


def test_frames_come_and_move():
    async def test(world, page):
        put(world, 1.0)
        async with open_page(page) as connection:
            client = Page(connection)
            await client.hear()
            assert client.told["frames"]["names"] == ["turtle", "world"]
            assert client.poses["turtle"] == (1.0, 0, 0, 0, 0, 0, 1)
            assert math.isnan(client.at)
            put(world, 2.0)
            await client.until(lambda client: client.poses["turtle"][0] == 2.0)
            put(world, 3.0, parent="turtle", child="carrot")
            await client.until(lambda client: "carrot" in client.poses)
            assert client.told["frames"]["parents"] == [1, -1, 0]

    serve(test)


def test_a_page_that_comes_before_any_frame_is_told_there_are_none():
    async def test(world, page):
        async with open_page(page) as connection:
            client = Page(connection)
            await client.hear()
            assert client.poses == {}
            put(world, 1.0)
            await client.until(lambda client: "turtle" in client.poses)

    serve(test)


def test_a_second_page_joins_and_both_go_on():
    async def test(world, page):
        put(world, 1.0)
        async with open_page(page) as one, open_page(page) as two:
            pages = Page(one), Page(two)
            for client in pages:
                await client.hear()
            put(world, 2.0)
            for client in pages:
                await client.until(lambda client: client.poses["turtle"][0] == 2.0)
            assert len(page.clients) == 2

    serve(test)


def test_the_past_is_shown_to_the_one_who_asks():
    async def test(world, page):
        epoch = world.clock.epoch
        for second in (1, 2, 3):
            put(world, float(second), stamp=epoch + seconds(second))
        async with open_page(page) as one, open_page(page) as two:
            past, present = Page(one), Page(two)
            await past.hear()
            await past.say(type="show", at=1.25)
            await past.until(lambda client: client.at == 1.25)
            assert past.poses["turtle"][0] == pytest.approx(1.25)
            assert (past.oldest, past.newest) == (1.0, 3.0)
            await present.hear()
            assert present.poses["turtle"][0] == 3.0
            await past.say(type="show", at=None)
            await past.until(lambda client: math.isnan(client.at))
            assert past.poses["turtle"][0] == 3.0

    serve(test)


def test_a_page_in_the_past_still_hears_how_far_the_buffer_reaches():
    async def test(world, page):
        epoch = world.clock.epoch
        put(world, 1.0, stamp=epoch + seconds(1))
        async with open_page(page) as connection:
            client = Page(connection)
            await client.hear()
            await client.say(type="show", at=1.0)
            await client.until(lambda client: client.at == 1.0)
            put(world, 2.0, stamp=epoch + seconds(2))
            while client.told.get("range", {}).get("newest") != 2.0:
                said = json.loads(await connection.recv())
                client.told[said["type"]] = said
            assert client.told["range"]["oldest"] == 1.0

    serve(test)


def test_a_past_request_is_answered_with_the_history_of_the_buffer():
    async def test(world, page):
        for second in (1, 2, 3):
            put(world, float(second), stamp=world.clock.epoch + seconds(second))
        async with open_page(page) as connection:
            client = Page(connection)
            await client.hear()
            await client.say(type="past")
            await client.say(type="past")  # the second request is one too many, and ignored
            told = []
            while len(told) < 120:
                await client.hear()
                if client.sequence == 0:
                    told.append((client.at, client.poses["turtle"][0]))
            assert told[0] == (1.0, 1.0)
            assert told[-1] == (3.0, 3.0)
            assert all(x == pytest.approx(at) for at, x in told)

    serve(test)


def test_a_frame_that_changed_its_parent_is_shown_under_the_parent_of_the_moment():
    async def test(world, page):
        epoch = world.clock.epoch
        for second, parent in ((1, "a"), (2, "a"), (3, "b"), (4, "b")):
            put(world, 1.0, parent=parent, stamp=epoch + seconds(second))
        async with open_page(page) as connection:
            client = Page(connection)
            parents = []
            await client.hear()
            for at in (None, 1.5, None, 1.5):
                wanted = str(math.nan if at is None else at)
                await client.say(type="show", at=at)
                while str(client.at) != wanted:
                    await client.hear()
                names = client.told["frames"]["names"]
                place = client.told["frames"]["parents"][names.index("turtle")]
                parents.append((names[place], client.revision))
            assert parents == [("b", 1), ("a", 2), ("b", 1), ("a", 2)]

    serve(test)


def test_a_pair_is_told_with_every_picture():
    async def test(world, page):
        put(world, 1.0, stamp=world.clock.epoch)
        put(world, 5.0, stamp=world.clock.epoch, child="turtle2")
        async with open_page(page) as connection:
            client = Page(connection)
            await client.say(type="pair", target="turtle2", source="turtle")
            await client.until(lambda client: "pair" in client.told)
            assert client.told["pair"]["translation"] == [-4.0, 0.0, 0.0]
            assert client.told["pair"]["chain"] == ["turtle", "world", "turtle2"]
            await client.say(type="pair", target="turtle2", source="<nobody>")
            await client.until(lambda client: not client.told["pair"]["found"])
            assert "<nobody>" in client.told["pair"]["why"]
            await client.say(type="pair", target=None, source=None)
            client.told.pop("pair")
            await client.until(lambda client: client.count > 6)

    serve(test)


async def closing(connection):
    """Listen until the server closes the connection; return its code and reason."""
    try:
        while True:
            await connection.recv()
    except ConnectionClosed as closed:
        return closed.rcvd.code, closed.rcvd.reason


@pytest.mark.parametrize("garbage", ["nonsense", b"\xff\xfe", "[1, 2]", '{"type": "x"}'])
def test_garbage_ends_the_connection_with_a_sentence_and_nobody_elses(garbage):
    async def test(world, page):
        put(world, 1.0)
        async with open_page(page) as bad, open_page(page) as good:
            await bad.send(garbage)
            code, reason = await closing(bad)
            assert code == 1008
            assert len(reason) > 10
            client = Page(good)
            await client.until(lambda client: client.count == 3)

    serve(test)


async def close_code(reader):
    """Read a server's websocket frames up to its closing frame."""
    while True:
        first, length = await reader.readexactly(2)
        if length == 126:
            (length,) = struct.unpack("!H", await reader.readexactly(2))
        body = await reader.readexactly(length)
        if first & 0x0F == 8:
            return struct.unpack_from("!H", body)[0]


def test_a_hundred_megabytes_are_refused_unread():
    async def test(world, page):
        put(world, 1.0)
        reader, writer = await asyncio.open_connection("127.0.0.1", page.port)
        writer.write(
            f"GET {where(page, '/frames')} HTTP/1.1\r\nHost: 127.0.0.1:{page.port}\r\n"
            f"Origin: http://127.0.0.1:{page.port}\r\n"
            "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n".encode()
        )
        assert (await reader.readuntil(b"\r\n\r\n")).startswith(b"HTTP/1.1 101 ")
        # The header of a text message of that length; no byte of the text needs to follow.
        writer.write(b"\x81\xff" + struct.pack("!Q", 100_000_000) + b"mask")
        assert await close_code(reader) == 1009
        writer.close()
        async with open_page(page) as good:
            await Page(good).hear()

    serve(test)


def test_a_slow_page_misses_pictures_and_nothing_is_queued_for_it():
    async def test(world, page):
        put(world, 1.0)
        async with open_page(page) as connection:
            client = Page(connection, draws=False)
            await client.hear()
            await client.hear()
            (known,) = page.clients
            missed = known.skipped
            put(world, 2.0)
            while known.skipped < missed + 20:
                await world.clock.sleep(seconds(0.002))
            assert known.sent == 2
            await client.say(type="got", sequence=2)
            await client.hear()
            # Dropped pictures are not sent: the first picture that the client gets is the newest.
            assert client.poses["turtle"][0] == 2.0
            assert client.sequence == 3

    serve(test)


def test_a_page_cannot_claim_to_have_drawn_what_it_never_got():
    async def test(world, page):
        put(world, 1.0)
        async with open_page(page) as connection:
            client = Page(connection, draws=False)
            await client.say(type="got", sequence=10**9)
            await client.hear()
            await client.hear()
            (known,) = page.clients
            while known.skipped < 5:
                await world.clock.sleep(seconds(0.002))
            # At most two pictures were sent before the client's message arrived, and two after it.
            assert known.sent <= 4

    serve(test)


def test_the_end_of_the_session_is_told():
    clock = WallClock()

    async def main():
        world = World(clock)
        async with PageServer(world, port=0) as page:
            connection = await open_page(page).__aenter__()
        code, _ = await closing(connection)
        await connection.close()
        return code

    assert run(clock, main()) == 1001


def test_a_taken_port_gives_way_to_the_next_free_one():
    async def test(world, page):
        taken = page.port
        async with PageServer(world, port=taken) as second:
            assert taken < second.port < taken + server.PORTS_TRIED
            assert second.asked_port == taken

    serve(test)


def test_when_no_port_is_free_it_says_so(monkeypatch):
    monkeypatch.setattr(server, "PORTS_TRIED", 1)

    async def main():
        with socket.create_server(("127.0.0.1", 0)) as holder:
            port = holder.getsockname()[1]
            with pytest.raises(TftoolError, match=f"no port from {port} to {port} is free"):
                await PageServer(World(clock), port=port).__aenter__()

    clock = WallClock()
    run(clock, main())


def test_more_pages_than_anybody_needs_are_refused(monkeypatch):
    monkeypatch.setattr(server, "MOST_CLIENTS", 1)

    async def test(world, page):
        async with open_page(page) as first:
            await Page(first).hear()
            with pytest.raises(InvalidStatus) as refused:
                await open_page(page).__aenter__()
            assert refused.value.response.status_code == 503

    serve(test)


def test_of_thousands_of_frames_those_nearest_to_their_root_are_shown():
    async def test(world, page):
        statics = [
            TransformStamped(0, f"f{(index - 1) // 2}", f"f{index}", Transform((1.0, 0.0, 0.0)))
            for index in range(1, 5000)
        ]
        world.broadcast(reversed(statics), "test", static=True)
        async with open_page(page) as connection:
            client = Page(connection)
            await client.hear()
            names = client.told["frames"]["names"]
            assert client.told["frames"]["total"] == 5000
            assert len(client.poses) == 2000
            # Each frame has two children, so the first 2000 by number are nearest to the root.
            assert {int(name[1:]) for name in names} >= set(range(1023))
            for name, parent in zip(names, client.told["frames"]["parents"], strict=True):
                if name != "f0":
                    assert names[parent] == f"f{(int(name[1:]) - 1) // 2}"

    serve(test)


def test_a_page_that_was_not_built_is_said(monkeypatch, tmp_path):
    monkeypatch.setattr(server.assets.resources, "files", lambda package: tmp_path)

    with pytest.raises(TftoolError, match=r"index\.html is missing"):
        PageServer(World(WallClock()))


def test_the_port_of_a_ros_router_is_left_alone(monkeypatch):
    monkeypatch.setattr(server, "PORTS_TRIED", 1)
    clock = WallClock()

    async def main():
        with pytest.raises(TftoolError, match="no port from 7447 to 7447 is free"):
            await PageServer(World(clock), port=7447).__aenter__()

    run(clock, main())


def test_connections_beyond_what_can_be_opened_are_told_of_once():
    said = []

    async def refuse():
        async with PageServer(World(WallClock()), port=0, tell=said.append):
            loop = asyncio.get_running_loop()
            for _ in range(3):
                full = OSError(errno.EMFILE, os.strerror(errno.EMFILE))
                loop.call_exception_handler({"message": "accept", "exception": full})

    asyncio.run(refuse())

    assert len(said) == 1
    assert "ulimit -n" in said[0]
