"""Tests of messages about frames that too many nodes publish."""

import pytest

from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.commands.echo.command import Printer
from tftool.commands.echo.echo_loop import Echo
from tftool.commands.shared.notices import rivalries
from tftool.commands.shared.pairs import FramePair
from tftool.geometry.rigid import Transform
from tftool.world.clock import SimClock
from tftool.world.link.session_world import Session, twins
from tftool.world.supervisor import live
from tftool.world.world import World


def sent(senders):
    buffer = Buffer()
    for number, sender in enumerate(senders, start=1):
        sample = TransformStamped(seconds(number / 10), "world", "robot", Transform())
        buffer.set_transform(sample, sender)
    return buffer


def test_two_nodes_that_send_one_child_in_turns_are_named():
    buffer = sent(["left", "right"] * 3)

    assert buffer.rivals("robot") == ("left", "right")
    (told,) = rivalries(buffer, buffer.frames())
    assert told.startswith("robot is broadcast by 2 nodes in turns, 'left' and 'right'")


@pytest.mark.parametrize("senders", [["one"] * 6, ["before"] * 3 + ["after"] * 3])
def test_a_single_sender_and_a_replaced_sender_are_not_rivals(senders):
    buffer = sent(senders)

    assert buffer.rivals("robot") == ()
    assert buffer.rivals("nowhere") == ()
    assert rivalries(buffer, buffer.frames()) == []


@pytest.mark.parametrize(
    ("frames", "told_last"),
    [
        (4, "1 more frame has several broadcasters."),
        (5, "2 more frames have several broadcasters."),
    ],
)
def test_many_rivalries_are_counted(frames, told_last):
    buffer = Buffer()
    for number in range(1, 9):
        for child in range(frames):
            sample = TransformStamped(seconds(number), "world", f"f{child}", Transform())
            buffer.set_transform(sample, f"node{number % 2}")

    told = rivalries(buffer, sorted(buffer.frames()))

    assert len(told) == 4
    assert told[-1] == told_last


def test_two_nodes_of_one_name_that_send_transforms_are_told():
    from tftool.world.endpoints import PUBLISHER, Endpoint, Quality

    world = World(SimClock())
    assert twins(world) == []
    for _ in range(2):
        kind = "tf2_msgs/msg/TFMessage"
        world.endpoints.add(Endpoint(PUBLISHER, "talker", "tf", kind, Quality()))

    assert twins(world) == ["2 nodes called 'talker' send transforms: was the node started twice?"]


def test_echo_says_it_once(capsys):
    clock = SimClock()
    world = World(clock)
    for number in range(1, 7):
        stamp = clock.now() - seconds(number / 10)
        sample = TransformStamped(stamp, "world", "robot", Transform())
        world.buffer.set_transform(sample, f"node{number % 2}")
    echo = Echo(world, FramePair("world", "robot"), Printer(), period=seconds(1), count=3)

    async def alive(until):
        await live(world, until=until)

    Session(world, True, "test", alive).run(echo.run())

    assert capsys.readouterr().err.count("is broadcast by 2 nodes in turns") == 1
