"""Messages read twice: with native code, and with numpy."""

import struct

import numpy as np

from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.transform_rows import SCAN
from tftool.messages.transforms import encode_transforms
from tftool.recordings.columns import Batch, Table
from tftool.recordings.contract import Publisher
from tftool.recordings.message_cutter import ScanCutter, TemplateCutter

REASON = "no native scan is built here, or TFTOOL_PURE is set: there is one path only"
ROS1_SAMPLE = [(5, "world", "turtle1")]
POSE = Transform((1.0, -2.0, 3.5), (0.0, 0.0, 0.6, 0.8))


def is_native():
    """Return whether the native code is installed."""
    return SCAN is not None


def cdr(transforms):
    """Return a message of (stamp, parent, child) in ROS 2's layout."""
    return encode_transforms([TransformStamped(*one, POSE) for one in transforms])


def ros1(transforms):
    """Return the same message in ROS 1's layout."""
    parts = [struct.pack("<I", len(transforms))]
    for stamp, *names in transforms:
        parts.append(struct.pack("<III", 0, *divmod(stamp, 10**9)))
        parts += [struct.pack("<I", len(name.encode())) + name.encode() for name in names]
        parts.append(struct.pack("<7d", *POSE.translation, *POSE.rotation))
    return b"".join(parts)


def both(layout, messages, at_once=64):
    """Return the columns of some messages, read with numpy and with native code."""
    found = []
    for kind in (TemplateCutter, ScanCutter):
        table = Table()
        cutter = kind(table, layout, False)
        for begin in range(0, len(messages), at_once):
            some = messages[begin : begin + at_once]
            lengths = np.array([len(one) for one in some], dtype=np.int64)
            buffer = np.frombuffer(b"".join(some) or b"\0", dtype=np.uint8)
            log_times = np.arange(begin, begin + len(some))
            senders = np.zeros(len(some), dtype=np.int32)
            first = table.note(log_times, senders)
            numbers = np.arange(first, first + len(some), dtype=np.int32)
            starts = np.cumsum(lengths) - lengths
            cutter.add(Batch(buffer, starts, lengths, log_times, senders), numbers)
        cutter.flush()
        found.append(table.finished((Publisher("/tf"),)))
    return found


def same(first, second):
    """Assert that two sets of columns are equal to the last bit."""
    assert first.damage == second.damage
    assert first.log_times.tolist() == second.log_times.tolist()
    assert [(e.parent, e.child, e.slashed) for e in first.edges] == [
        (e.parent, e.child, e.slashed) for e in second.edges
    ]
    for one, other in zip(first.edges, second.edges, strict=True):
        assert one.records.tobytes() == other.records.tobytes()
        assert one.messages.tolist() == other.messages.tolist()
