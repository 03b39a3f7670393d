"""Tests of frame marks: the fast first check hides no fault, and needs no numpy."""

import subprocess
import sys

from hypothesis import given
from hypothesis import strategies as st

from tftool.base.stamps import SIMULATED_BELOW, seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.doctor.frame_marks import marks
from tftool.doctor.marked_frames import marked
from tftool.geometry.rigid import Transform

NAMES = st.sampled_from(["map", "odom", "base"])
TIMES = st.one_of(
    st.integers(0, 40).map(lambda tenths: seconds(tenths / 10)),
    st.integers(0, 40).map(lambda tenths: SIMULATED_BELOW + seconds(tenths / 10)),
)
SENT = st.lists(
    st.tuples(TIMES, NAMES, st.sampled_from(["arm", "hand", "lamp"]), st.booleans()), max_size=40
)


def holding(sent):
    buffer = Buffer(cache_time=seconds(100))
    for stamp, parent, child, static in sent:
        put = buffer.set_transform_static if static else buffer.set_transform
        put(TransformStamped(stamp, parent, child, Transform()), "node")
    return buffer


def marked_now(buffer):
    return marks(buffer, buffer.snapshot(0))


@given(SENT)
def test_the_quick_look_hides_no_mark(sent):
    buffer = holding(sent)

    assert marked_now(buffer) == marked(buffer)


def test_each_mark_is_found_behind_the_quick_look():
    quiet = [(seconds(i / 10), "map", "arm", False) for i in range(60)]
    stopped = [(seconds(i / 10), "map", "lamp", False) for i in range(20)]
    other_clock = [(SIMULATED_BELOW + seconds(i), "map", "lamp", False) for i in range(20)]
    fought = [(seconds(i / 10), "map" if i % 2 else "odom", "hand", False) for i in range(60)]

    assert marked_now(holding(quiet)) == {}
    assert marked_now(holding(quiet + stopped)) == {"lamp": ("edge-stopped",)}
    assert marked_now(holding(quiet + fought)) == {"hand": ("two-parents",)}
    assert "clock-mixture" in marked_now(holding(quiet + other_clock))["lamp"]


def test_a_tree_in_which_nothing_is_wrong_is_shown_without_numpy():
    program = (
        "import sys\n"
        "from tftool.app.main import main\n"
        "assert main(['tree', 'turtles', '--host']) == 0\n"
        "sys.exit('numpy was imported' if 'numpy' in sys.modules else 0)\n"
    )

    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)

    assert (done.returncode, done.stderr) == (0, "")
    assert "turtle1" in done.stdout
