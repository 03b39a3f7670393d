"""Tests of nodes that do not end by themselves, in separate processes."""

import os
import signal
import subprocess
import sys
import termios

import pytest

from tests.patience import PATIENCE
from tftool.world.stopper import FAILED, INTERRUPTED

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs signals")

PROGRAM = """\
import asyncio, resource, sys, tty
from tftool import Node, SimClock, WallClock, World, live, run, seconds
from tftool.base.errors import NodeFailed
from tftool.messages.turtle_messages import twist
from tftool.world.nodes.turtlesim import Turtlesim
from tftool.world import clock as clocks

class Busy(Node):
    async def run(self):
        print("up", flush=True)
        {body}

clocks.STANDSTILL = 0.5
clock = {clock}()
world = World(clock)
Busy(world, "busy")
try:
    run(clock, live(world, until={until}))
except NodeFailed as failure:
    sys.exit(f"tftool: {{failure}}")
except KeyboardInterrupt as interrupt:
    print("interrupted by", interrupt.__cause__, flush=True)
    sys.exit(130)
"""

HOLDS = "while True: pass"
HEEDS_NOTHING = """
        while True:
            try:
                await asyncio.Event().wait()
            except asyncio.CancelledError:
                pass
"""
PUBLISHES = """
        Turtlesim(self.world)
        await self.clock.sleep(1)
        for count in (1_000, 1_000_000):
            for _ in range(count):
                self.publish("turtle1/cmd_vel", twist(1.0, 1.0))
            print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, flush=True)
        self.world.stop()
"""


def line_with(text, program):
    return next(number for number, line in enumerate(program.splitlines(), 1) if text in line)


class Program:
    """Program with a node named busy, in a separate process."""

    def __init__(self, folder, body, *, clock="WallClock", until="None", stdin=None):
        self.text = PROGRAM.format(body=body.strip(), clock=clock, until=until)
        file = folder / "busy.py"
        file.write_text(self.text)
        self.process = subprocess.Popen(
            [sys.executable, str(file)],
            stdin=stdin or subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        assert self.process.stdout.readline() == "up\n"

    def kill(self, number):
        os.kill(self.process.pid, number)

    def ended(self):
        """Return the program's status, and its remaining output on stdout and stderr."""
        status = self.process.wait(PATIENCE)
        # `communicate` would lose output that arrived together with a line that was read before.
        return status, self.process.stdout.read(), self.process.stderr.read()


@pytest.fixture
def start(tmp_path):
    begun = []

    def begin(*words, **settings):
        begun.append(Program(tmp_path, *words, **settings))
        return begun[-1]

    yield begin
    for program in begun:
        program.process.kill()
        program.process.communicate()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("clock", ["WallClock", "SimClock"])
def test_a_node_that_holds_the_loop_is_named_and_the_second_signal_ends_it(start, number, clock):
    program = start(HOLDS, clock=clock)
    program.kill(number)
    said = program.process.stderr.readline()
    program.kill(number)

    line = line_with("while True", program.text)
    assert said == (
        f"tftool: node 'busy' (busy.py:{line}) has not returned for 2 s; "
        "a second Ctrl-C ends the process\n"
    )
    assert program.ended() == (INTERRUPTED, "", "")


def test_a_node_that_swallows_its_cancellation_is_named_at_the_line_it_waits_at(start):
    program = start(HEEDS_NOTHING)
    program.kill(signal.SIGINT)
    said = program.process.stderr.readline()
    program.kill(signal.SIGINT)

    line = line_with("Event().wait()", program.text)
    assert f"node 'busy' (busy.py:{line}) has not returned for 2 s" in said
    assert program.ended()[0] == INTERRUPTED


def test_a_node_that_heeds_the_first_signal_ends_the_run_and_is_not_named(start):
    program = start("await self.clock.sleep(seconds(1000))")
    program.kill(signal.SIGINT)

    assert program.ended() == (130, "interrupted by None\n", "")


def test_a_failure_during_an_interrupt_is_named_as_the_cause(start):
    program = start(
        """
        try:
            await self.clock.sleep(seconds(1000))
        finally:
            raise OSError("disk full")
"""
    )
    program.kill(signal.SIGTERM)

    status, out, _ = program.ended()
    assert status == 130
    assert out.startswith("interrupted by node 'busy' failed: OSError: disk full (busy.py:")


@pytest.mark.parametrize(
    ("body", "clock"),
    [(HOLDS, "WallClock"), (HEEDS_NOTHING, "WallClock"), (HEEDS_NOTHING, "SimClock")],
)
def test_the_end_of_a_run_ends_a_node_that_does_not_return_and_names_it(start, body, clock):
    program = start(body, clock=clock, until="clock.now() + seconds(0.2)")

    status, _, said = program.ended()
    line = line_with("Event().wait()" if "Event" in body else "while True", program.text)
    assert status == FAILED
    assert said == (
        f"tftool: node 'busy' has not returned 2 s after the end of the run (busy.py:{line})\n"
    )


def test_a_node_that_holds_up_simulated_time_is_ended_if_the_run_has_an_end(start):
    program = start(HOLDS, clock="SimClock", until="clock.now() + seconds(10)")

    status, _, said = program.ended()
    assert status == FAILED
    assert "node 'busy' has not returned" in said


def test_the_terminal_is_as_it_was_when_the_second_signal_ends_the_process(start):
    ours, theirs = os.openpty()
    try:
        before = termios.tcgetattr(theirs)
        program = start(
            f"""
        tty.setraw(0)
        print("raw", flush=True)
        {HOLDS}
""",
            stdin=theirs,
        )
        assert program.process.stdout.readline() == "raw\n"
        assert termios.tcgetattr(theirs) != before
        program.kill(signal.SIGINT)
        program.process.stderr.readline()
        program.kill(signal.SIGINT)

        assert program.ended()[0] == INTERRUPTED
        assert termios.tcgetattr(theirs) == before
    finally:
        os.close(ours)
        os.close(theirs)


def test_messages_published_by_a_node_that_never_pauses_are_not_kept(start):
    program = start(PUBLISHES)

    status, out, _ = program.ended()
    assert status == 0
    before, after = (int(line) for line in out.splitlines())
    # The unit is kilobytes on Linux and bytes on macOS; the values themselves would be about sixty
    # megabytes.
    assert (after - before) * (1 if sys.platform == "darwin" else 1024) < 20e6
