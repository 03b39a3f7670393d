"""Time to write messages as bytes and to read them, in the same run as rosbags."""

import statistics
import time
import tracemalloc

import numpy as np

from tftool.messages.classes import INTERFACES
from tftool.messages.codec import codec

PIXELS = 640 * 480 * 3
"""Number of bytes in the image."""


def pairs():
    """Return (name, tftool's message, rosbags' message, type) of a large and a small message."""
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_JAZZY)
    theirs = store.types
    time_ = theirs["builtin_interfaces/msg/Time"](sec=1, nanosec=2)
    header = theirs["std_msgs/msg/Header"](stamp=time_, frame_id="camera")
    data = np.arange(PIXELS, dtype=np.uint32).astype(np.uint8)
    facts = {"height": 480, "width": 640, "encoding": "rgb8", "is_bigendian": 0, "step": 1920}
    image = INTERFACES.message("sensor_msgs/Image")(**facts, data=data.tobytes())
    image.header.stamp.sec, image.header.stamp.nanosec, image.header.frame_id = 1, 2, "camera"
    yield (
        "Image 0.9 MB",
        image,
        store,
        theirs["sensor_msgs/msg/Image"](header=header, **facts, data=data),
    )
    vector = theirs["geometry_msgs/msg/Vector3"]
    twist = INTERFACES.message("geometry_msgs/Twist")()
    twist.linear.x, twist.angular.z = 1.0, 2.0
    yield (
        "Twist",
        twist,
        store,
        theirs["geometry_msgs/msg/Twist"](
            linear=vector(1.0, 0.0, 0.0), angular=vector(0.0, 0.0, 2.0)
        ),
    )


def together(*ways, rounds=60, calls=1):
    """Return the median microseconds of a call of each function; the functions run in turn."""
    spent = {way: [] for way in ways}
    for _ in range(rounds):
        for way in ways:
            began = time.perf_counter()
            for _ in range(calls):
                way()
            spent[way].append((time.perf_counter() - began) / calls)
    return [statistics.median(spent[way]) * 1e6 for way in ways]


def copies(way, size):
    """Return the peak memory of a call, in multiples of the payload."""
    tracemalloc.start()
    way()
    tracemalloc.reset_peak()
    before, _ = tracemalloc.get_traced_memory()
    way()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return (peak - before) / size


def report() -> str:
    """Measure, and print a few lines."""
    lines = ["wire, messages as CDR (median of 60 rounds, taking turns with rosbags)"]
    for name, ours, store, theirs in pairs():
        own, full = codec(type(ours)), ours.interface__
        payload = own.encode(ours)
        assert payload == bytes(store.serialize_cdr(theirs, full))
        calls = 1 if len(payload) > 10_000 else 200
        ours_us, theirs_us = together(
            lambda own=own, ours=ours: own.encode(ours),
            lambda store=store, theirs=theirs, full=full: store.serialize_cdr(theirs, full),
            calls=calls,
        )
        lines.append(
            f"  {name}: encode {ours_us:.1f} us, rosbags {theirs_us:.1f} us: "
            f"{ours_us / theirs_us:.2f} times{' (wanted: at most 1.5)' if calls == 1 else ''}"
        )
        ours_us, theirs_us = together(
            lambda own=own, payload=payload: own.decode(payload),
            lambda store=store, payload=payload, full=full: store.deserialize_cdr(payload, full),
            calls=calls,
        )
        lines.append(f"  {name}: decode {ours_us:.1f} us, rosbags {theirs_us:.1f} us")
        if calls == 1:
            held = copies(lambda own=own, payload=payload: own.decode(payload), len(payload))
            lines[-1] += f", memory {held:.2f} times the payload (wanted: at most 2)"
    return "\n".join(lines)
