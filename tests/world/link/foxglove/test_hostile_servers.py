"""Tests of servers that send malformed data: an error, limited memory, and the session goes on."""

import asyncio
import base64
import contextlib
import hashlib
import json
import struct
import subprocess
import threading
import time

import pytest
from websockets.sync.server import serve

from tests.certificates import certificates, needs_openssl
from tests.world.link.conftest import until
from tests.world.link.foxglove.conftest import TF, joined, transform
from tftool.base.errors import LinkError, UsageError
from tftool.messages.transforms import encode_transforms
from tftool.world.clock import WallClock
from tftool.world.link.foxglove.client import ClientReceiver, FoxgloveClient
from tftool.world.link.foxglove.protocol import MOST_DEFINITIONS, ServerState
from tftool.world.link.link_options import reach_at
from tftool.world.link.queues import Inbox

INFO = json.dumps({"op": "serverInfo", "name": "stranger", "capabilities": []})


def channel(number=1, topic="/tf", kind=TF, encoding="cdr", **more):
    return {"id": number, "topic": topic, "encoding": encoding, "schemaName": kind, **more}


def advertised(*channels):
    return json.dumps({"op": "advertise", "channels": channels})


def data(payload, subscription=1):
    return struct.pack("<BIQ", 1, subscription, 0) + payload


GOOD = encode_transforms([transform("odom", "base", WallClock().now())])


@contextlib.contextmanager
def server(*connections, subprotocols=("foxglove.websocket.v1",), **options):
    """Start a server that runs a script for each connection; the last script serves further ones.

    A script is called with the connection; its exception ends the connection.
    """
    left = list(connections)

    def handle(connection):
        script = left.pop(0) if len(left) > 1 else left[0]
        with contextlib.suppress(Exception):
            script(connection)

    made = serve(
        handle,
        "127.0.0.1",
        0,
        subprotocols=subprotocols,
        compression=None,
        max_size=None,
        **options,
    )
    thread = threading.Thread(target=made.serve_forever)
    thread.start()
    try:
        yield f"ws://127.0.0.1:{made.socket.getsockname()[1]}"
    finally:
        made.shutdown()
        thread.join()


def sends(*messages, ends=False):
    """Return a script that announces its channels, and sends messages once it is subscribed."""

    def script(connection):
        connection.send(INFO)
        connection.send(advertised(channel()))
        asked = json.loads(connection.recv())
        number = asked["subscriptions"][0]["id"]
        for message in messages:
            connection.send(message(number) if callable(message) else message)
        if not ends:
            for _ in connection:
                pass

    return script


def good(number):
    return data(GOOD, number)


def heard_by(address, condition):
    """Return the log of a connection while a world reads a server until a condition is true."""

    async def scene():
        with joined(address) as (world, link):
            said = []
            world.log.listen(lambda record: said.append(record.text), "test")
            await until(lambda: condition(world, link))
            return " | ".join(said), link

    return asyncio.run(scene())


def test_the_older_subprotocol_is_spoken_too():
    with server(sends(good)) as address:
        heard_by(address, lambda world, _: "base" in world.buffer.frames())


ODD = {
    "no JSON": "{",
    "no object": "[1]",
    "deep": "[" * 100_000,
    "a huge number": '{"op": "advertise", "channels": [{"id": ' + "9" * 5000 + "}]}",
    "channels that are none": '{"op": "advertise", "channels": 5}',
    "a channel without a topic": '{"op": "advertise", "channels": [{"id": 9, "encoding": "cdr"}]}',
    "a number out of range": advertised(channel(1 << 40)),
    "a definition that is a list": advertised(channel(9, schema=["x"])),
    "a message cut off": b"\x01\x00\x00",
    "a time cut off": b"\x02\x00",
    "a time beyond 2038": struct.pack("<BQ", 2, 1 << 63),
    "a message beyond the limit": bytes(65 * 1024 * 1024),
}


@pytest.mark.parametrize("odd", ODD.values(), ids=ODD.keys())
def test_a_protocol_violation_ends_the_connection_and_the_next_connection_works(odd):
    with server(sends(odd), sends(good)) as address:
        said, _ = heard_by(address, lambda world, _: "base" in world.buffer.frames())
    assert f"The connection to {address} has ended (" in said


HARMLESS = {
    "an unknown operation": '{"op": "surprise", "x": [1]}',
    "no operation": "{}",
    "an operation that is a list": '{"op": ["advertise"]}',
    "an unknown binary message": b"\xff\x00\x01",
    "nothing": b"",
    "a subscription that is not ours": data(GOOD, 4_000_000_000),
    "channels that were never there": '{"op": "unadvertise", "channelIds": [7, 8]}',
}


@pytest.mark.parametrize("odd", HARMLESS.values(), ids=HARMLESS.keys())
def test_irrelevant_messages_are_ignored_silently(odd):
    with server(sends(odd, good)) as address:
        said, _ = heard_by(address, lambda world, _: "base" in world.buffer.frames())
    assert said == ""


def test_malformed_messages_are_counted_and_said_once():
    wrong = [lambda number, end=end: data(GOOD[:end], number) for end in range(4, len(GOOD), 5)]
    with server(sends(*wrong, good)) as address:
        said, link = heard_by(address, lambda world, _: "base" in world.buffer.frames())
    assert said.count("On 'tf': tf2_msgs/TFMessage refused") == 1
    assert link.refused == len(wrong)


def test_malformed_protobuf_is_counted(robots):
    whole = bytes.fromhex("0a120a0408051006120161 1a0162".replace(" ", ""))

    async def scene():
        robot = robots()
        topic = robot.topic(
            "/tf", "foxglove.FrameTransforms", encoding="protobuf", schema_encoding="protobuf"
        )
        with joined(robot.address) as (_, link):
            await until(lambda: "/tf" in robot.subscribed)
            for end in range(1, len(whole)):
                topic.log(whole[:end])
            topic.log(bytes(3 * 1024 * 1024))
            await until(lambda: link.refused == len(whole))

    asyncio.run(scene())


@pytest.mark.parametrize(
    ("definition", "said"),
    [
        ("int8 transforms\n", "the server has another definition of tf2_msgs/TFMessage"),
        ("tf2_msgs/TFMessage[] transforms\n", "contains itself"),
        ("not a definition at all\x1b[31m\n", "cannot be read"),
        (
            "p/A1 a\n"
            + "".join(
                f"{'=' * 80}\nMSG: p/A{n}\n" + "".join(f"p/A{n + 1} x{i}\n" for i in range(20))
                for n in range(1, 20)
            )
            + f"{'=' * 80}\nMSG: p/A20\nint8 x\n",
            "cannot be read",
        ),
    ],
    ids=["other fields", "a circle", "rubbish", "an explosion"],
)
def test_a_wrong_definition_is_named_and_other_topics_are_read(definition, said):
    def script(connection):
        connection.send(INFO)
        wrong = channel(1, schemaEncoding="ros2msg", schema=definition)
        connection.send(advertised(wrong, channel(2)))
        asked = json.loads(connection.recv())["subscriptions"]
        for one in asked:
            connection.send(
                data(encode_transforms([transform("a", f"c{one['channelId']}")]), one["id"])
            )
        for _ in connection:
            pass

    with server(script) as address:
        found, _ = heard_by(address, lambda world, _: "c2" in world.buffer.frames())
    assert said in found


@pytest.mark.parametrize(
    "refusal", ["Unknown channel ID: 1", "Channel 1 is not available; ignoring subscription"]
)
def test_a_refused_subscription_is_asked_for_again(refusal):
    def script(connection):
        connection.send(INFO)
        connection.send(advertised(channel()))
        connection.recv()
        connection.send(json.dumps({"op": "status", "level": 2, "message": refusal}))
        again = json.loads(connection.recv())["subscriptions"]
        assert [one["channelId"] for one in again] == [1]
        connection.send(good(again[0]["id"]))
        for _ in connection:
            pass

    with server(script) as address:
        said, _ = heard_by(address, lambda world, _: "base" in world.buffer.frames())
    assert not said


def test_a_subscription_that_is_always_refused_is_given_up_with_a_word():
    refusals = []

    def script(connection):
        connection.send(INFO)
        connection.send(advertised(channel()))
        for request in connection:
            if json.loads(request)["op"] != "subscribe":
                continue
            refusals.append("Unknown channel ID: 1")
            connection.send(json.dumps({"op": "status", "level": 2, "message": refusals[-1]}))
            if len(refusals) == 6:
                connection.send(advertised(channel(2, "/last", "p/msg/T")))

    with server(script) as address:
        said, _ = heard_by(address, lambda _, link: len(link.graph.entities()) == 2)
    assert len(refusals) == 6
    assert "says: Unknown channel ID: 1" in said


def test_endless_advertise_is_bounded_and_the_frames_go_on():
    definition = "int8 x\n" * 1000

    def many(first):
        more = {"schema": definition, "schemaEncoding": "ros2msg"}
        return [channel(n, f"/t{n}", f"p/msg/T{n}", **more) for n in range(first, first + 500)]

    def script(connection):
        connection.send(INFO)
        connection.send(advertised(channel()))
        number = json.loads(connection.recv())["subscriptions"][0]["id"]
        for first in range(2, 12_000, 500):
            connection.send(advertised(*many(first)))
        connection.send(good(number))
        for _ in connection:
            pass

    with server(script) as address:
        said, link = heard_by(address, lambda world, _: "base" in world.buffer.frames())
    assert "offers more than 5000 channels: further channels are ignored" in said
    assert len(link.graph.entities()) <= 5000

    state = ServerState()
    for first in range(2, 7_000, 500):
        state.take(advertised(*many(first)))
        state.take(json.dumps({"op": "unadvertise", "channelIds": [*range(first, first + 50)]}))
    assert sum(len(one.definition) for one in state.channels.values()) <= MOST_DEFINITIONS


def test_channels_that_come_and_go_for_ever_leave_nothing():
    def script(connection):
        connection.send(INFO)
        connection.send(advertised(channel()))
        number = json.loads(connection.recv())["subscriptions"][0]["id"]
        for n in range(2, 3000):
            connection.send(advertised(channel(n, f"/t{n}")))
            connection.send(json.dumps({"op": "unadvertise", "channelIds": [n]}))
        connection.send(good(number))
        for _ in connection:
            pass

    with server(script) as address:
        heard_by(
            address,
            lambda world, link: "base" in world.buffer.frames() and len(link.graph.entities()) == 1,
        )


def test_a_server_that_offers_nothing_is_an_empty_session():
    def script(connection):
        connection.send(INFO)
        for _ in connection:
            pass

    with server(script) as address:
        _, link = heard_by(address, lambda *_: True)
    assert link.graph.is_empty


def test_a_server_of_another_kind_is_refused():
    with (
        server(sends(), subprotocols=None) as address,
        pytest.raises(LinkError, match="it speaks WebSocket, but not Foxglove's protocol"),
    ):
        heard_by(address, lambda *_: True)


def test_a_redirect_is_not_followed(moving):
    def elsewhere(connection, request):
        response = connection.respond(302, "")
        response.headers["Location"] = moving.address
        return response

    with (
        server(sends(), process_request=elsewhere) as address,
        pytest.raises(LinkError, match="it answers with HTTP 302"),
    ):
        heard_by(address, lambda *_: True)


# Connections that break after every number of bytes


def frame(payload, opcode):
    size = len(payload)
    head = bytes([size]) if size < 126 else b"\x7e" + size.to_bytes(2)
    return bytes([0x80 | opcode]) + head + payload


EXCHANGE = frame(INFO.encode(), 1) + frame(advertised(channel()).encode(), 1)
"""Messages that a server sends without a request."""


def handshake(request):
    key = next(
        line.split(b": ")[1]
        for line in request.split(b"\r\n")
        if line.startswith(b"Sec-WebSocket-K")
    )
    accept = hashlib.sha1(key + b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11").digest()
    return (
        b"HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        b"Sec-WebSocket-Protocol: foxglove.sdk.v1\r\nSec-WebSocket-Accept: "
        + base64.b64encode(accept)
        + b"\r\n\r\n"
    )


def test_a_connection_may_break_at_every_byte():
    """Check connections that end after 0, 1, 2 … bytes; the first connection lasts."""
    size = len(handshake(b"Sec-WebSocket-Key: x\r\n")) + len(EXCHANGE) + len(frame(good(1), 2))
    said, heard, started = [], [], []
    ended = threading.Event()
    cuts = iter([size, *range(size + 1)])

    async def serve_cut(reader, writer):
        with contextlib.suppress(OSError, asyncio.IncompleteReadError):
            request = await reader.readuntil(b"\r\n\r\n")
            whole = handshake(request) + EXCHANGE
            end = next(cuts, None)
            if end is None:
                end = size
                ended.set()
            writer.write(whole[:end])
            await writer.drain()
            if not started:
                # The connection must stay open until the client knows the channels.
                started.append(True)
                with contextlib.suppress(TimeoutError):
                    await asyncio.wait_for(reader.read(), 0.5)
            elif end > len(whole):
                # The client's message has a subscription number that increases, masked with four
                # bytes.
                head = await reader.readexactly(6)
                mask = head[2:6]
                body = await reader.readexactly(head[1] & 127)
                asked = json.loads(bytes(b ^ mask[i % 4] for i, b in enumerate(body)))
                number = asked["subscriptions"][0]["id"]
                writer.write(frame(good(number), 2)[: end - len(whole)])
                await writer.drain()
        writer.close()

    loop = asyncio.new_event_loop()
    listening = loop.run_until_complete(asyncio.start_server(serve_cut, "127.0.0.1", 0))
    port = listening.sockets[0].getsockname()[1]
    thread = threading.Thread(target=loop.run_forever)
    thread.start()
    inbox = Inbox()
    receiver = ClientReceiver(lambda _: None, heard.append, lambda _: None, said.append)
    client = FoxgloveClient(f"ws://127.0.0.1:{port}", inbox, receiver, pauses=(0.0,))
    try:
        client.want("tf", TF)
        assert ended.wait(60)
        deadline = time.monotonic() + 10  # noqa: TID251
        while time.monotonic() < deadline:  # noqa: TID251
            inbox.call_now()
            if sum(one.payload == GOOD for one in heard) >= 2:
                break
    finally:
        client.close()
        loop.call_soon_threadsafe(listening.close)
        loop.call_soon_threadsafe(loop.stop)
        thread.join()
        loop.close()
    assert sum(one.payload == GOOD for one in heard) >= 2
    assert all("has ended (" in one for one in said)


# Servers that disappear and return


def test_a_server_that_restarts_is_joined_again_with_its_statics(robots):
    async def scene():
        robot = robots()
        port = robot.port
        with joined(robot.address) as (world, link):
            said = []
            world.log.listen(lambda record: said.append(record.text), "test")
            for number in range(4):
                statics, tf = robot.topic("/tf_static"), robot.topic("/tf")
                robot.keep(
                    statics, encode_transforms([transform("base", "laser", 0, float(number))])
                )
                await until(lambda r=robot: {"/tf", "/tf_static"} <= set(r.subscribed))
                tf.log(encode_transforms([transform("odom", "base", 1 + number)]))
                await until(lambda n=number: link.received == 2 * (n + 1))
                found = world.buffer.lookup_transform("base", "laser")
                assert found.transform.translation.x == number
                if number < 3:
                    robot.stop()
                    await until(lambda: link.graph.is_empty)
                    # The data of the stopped server stays in the buffer.
                    assert set(world.buffer.frames()) == {"odom", "base", "laser"}
                    assert link.departures == number + 1
                    robot = robots(port=port)
            return said

    said = asyncio.run(scene())
    assert sum("the data received so far stays. Trying again" in one for one in said) == 3


@needs_openssl
def test_certificates_are_checked(robots, tmp_path, monkeypatch):
    made = certificates(tmp_path)
    key = subprocess.run(
        ["openssl", "pkcs8", "-topk8", "-nocrypt", "-in", made.key], check=True, capture_output=True
    ).stdout
    robot = robots(tls_cert=made.certificate.read_bytes(), tls_key=key)
    robot.topic("/tf")
    address = f"wss://localhost:{robot.port}"

    async def scene():
        with joined(address) as (_, link):
            return len(link.graph.entities())

    with pytest.raises(LinkError, match=r"its certificate is not trusted: .*SSL_CERT_FILE"):
        asyncio.run(scene())
    monkeypatch.setenv("SSL_CERT_FILE", str(made.authority))
    assert asyncio.run(scene()) == 1


def test_an_address_is_checked_before_it_is_used():
    assert reach_at("run.mcap") is None
    assert reach_at("https://robot/run.mcap") is None
    assert reach_at("WSS://[::1]:8765/x?y=1").place(0) == "wss://[::1]:8765/x"
    for wrong in ("ws://", "ws://robot:99999", "ws://robot#x", "ws://a b"):
        with pytest.raises(UsageError):
            reach_at(wrong)
