"""Tests of names whose class has its own code for comparison, hashing or conversion."""

import subprocess
import sys

import pytest

import tftool
from tests.world.link.processes import ROOT
from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform


class Hostile(str):
    """Name that raises an error when it is compared or converted."""

    __slots__ = ()

    def __eq__(self, other):
        raise RuntimeError("compared")

    def __hash__(self):
        return str.__hash__(self)

    def __str__(self):
        raise RuntimeError("converted")

    def startswith(self, *words):
        raise RuntimeError("searched")


class Slashless(str):
    """Name whose class denies its leading slash."""

    __slots__ = ()

    def startswith(self, *words):
        return False


def filled(name=str):
    buffer = Buffer()
    for stamp in (1, 2):
        sample = TransformStamped(
            seconds(stamp), name("map"), name("base"), Transform((1.0, 0.0, 0.0))
        )
        assert buffer.set_transform(sample, name("odometry"))
    return buffer


@pytest.mark.parametrize("kind", [str, Hostile])
def test_frame_names_are_stored_as_plain_strings(kind):
    buffer = filled(kind)

    assert [type(frame) for frame in buffer.frames()] == [str, str]
    assert buffer.lookup_transform("map", "base").transform.translation.x == 1.0


def test_questions_with_such_names_are_answered_without_running_their_code():
    buffer = filled()
    target, source = Hostile("map"), Hostile("base")

    for _ in range(2):
        found = buffer.lookup_transform(target, source)
        assert (type(found.frame_id), type(found.child_frame_id)) == (str, str)
        assert buffer.can_transform(target, source)
        full = buffer.lookup_transform_full(target, seconds(1), source, seconds(2), target)
        assert full.transform.translation.x == 1.0
        assert buffer.get_latest_common_time(target, source) == seconds(2)
        assert buffer.why_not(target, source) == ""
        assert buffer.chain(target, source) == ["base", "map"]
        assert buffer.parent(source) == "map"
        assert buffer.frame_exists(source)
        assert len(buffer.lookup_transforms(target, source, [seconds(1), seconds(2)])) == 2
        assert buffer.request(lambda *_: None, target, source) == 0


def test_can_transform_says_no_to_an_unknown_name_of_such_a_class():
    assert filled().can_transform(Hostile("map"), Hostile("nothing")) is False


def test_a_class_cannot_hide_its_leading_slash():
    buffer = filled()

    assert buffer.can_transform(Slashless("/map"), "base") is False
    with pytest.raises(tftool.InvalidArgumentException):
        buffer.lookup_transform(Slashless("/map"), "base")


def test_two_threads_that_look_up_and_drop_paths_by_such_names_do_no_harm():
    # This runs in a separate process, because memory that is freed too early would end the process.
    code = """
import threading
from tests.buffer.test_hostile_names import filled
from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform

buffer = filled()

class Dropping(str):
    def __eq__(self, other):
        buffer._solver.drop_paths()
        return str.__eq__(self, other)
    __hash__ = str.__hash__

def ask():
    for number in range(20_000):
        buffer.can_transform(Dropping("map"), Dropping("base"))
        buffer.can_transform("map", "base")
        buffer.set_transform(
            TransformStamped(seconds(3) + number, Dropping("map"), Dropping("base"),
                             Transform((1.0, 0.0, 0.0))), Dropping("odometry"))

threads = [threading.Thread(target=ask) for _ in range(2)]
for one in threads: one.start()
for one in threads: one.join()
print(buffer.can_transform("map", "base"))
"""
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True)

    assert (done.returncode, done.stdout, done.stderr) == (0, "True\n", "")


@pytest.mark.parametrize("links", [1, 20, 120, 200])
def test_long_chains_are_looked_up_in_a_thread_with_a_small_stack(links):
    code = f"""
import threading
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform

buffer = Buffer()
for link in range({links}):
    for stamp in (10**9, 2 * 10**9):
        buffer.set_transform(
            TransformStamped(stamp, f"f{{link}}", f"f{{link + 1}}", Transform((1.0, 0.0, 0.0))))
found = []
def ask():
    for _ in range(2):
        found.append(buffer.lookup_transform("f0", "f{links}", 1_500_000_000))
threading.stack_size(40 * 1024)
thread = threading.Thread(target=ask)
thread.start()
thread.join()
print([one.transform.translation.x for one in found])
"""
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True)

    assert (done.returncode, done.stdout, done.stderr) == (0, f"[{links}.0, {links}.0]\n", "")


def test_many_moments_are_looked_up_in_a_thread_with_a_small_stack():
    code = """
import threading
import numpy as np
from tftool.buffer.buffer import Buffer

buffer = Buffer()
stamps = 10**9 + np.arange(100) * 10**7
turns = np.tile([0.0, 0.0, 0.0, 1.0], (100, 1))
for link in range(120):
    buffer.set_transforms(f"f{link}", f"f{link + 1}", stamps, np.ones((100, 3)), turns)
buffer.lookup_transforms("f0", "f120", stamps)
found = []
def ask():
    found.append(buffer.lookup_transforms("f0", "f120", stamps))
threading.stack_size(48 * 1024)
thread = threading.Thread(target=ask)
thread.start()
thread.join()
print(float(found[0].translations[50, 0]))
"""
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True)

    assert (done.returncode, done.stdout, done.stderr) == (0, "120.0\n", "")
