"""Vectors of the command-line tools: parsing, echo, monitor, view_frames, static transforms."""

from collections.abc import Mapping
from typing import Any

import pytest
import yaml

from tests.tf2.loader import Unknown, close, fields
from tftool.base.errors import UsageError
from tftool.base.stamps import seconds
from tftool.buffer.sample import FrameInfo, Snapshot, TransformStamped
from tftool.buffer.traffic import NetDelay, Traffic
from tftool.drawing import echo_view as echo
from tftool.drawing import traffic_view as monitor
from tftool.drawing import tree_picture as drawing
from tftool.geometry.notation.static_arguments import parse
from tftool.geometry.rigid import IDENTITY, Transform
from tftool.world.clock import SimClock
from tftool.world.world import World

Step = Mapping[str, Any]


def only(case: Step, *operations: str) -> list[Step]:
    """Return the steps; raise an error for unknown operations."""
    for step in case["steps"]:
        if step["op"] not in operations:
            raise Unknown(f"operation {step['op']}")
    return case["steps"]


def run_static_publisher_args(case: Step) -> None:
    for step in only(case, "parse"):
        fields(step, "argv", "want", "error", "quirk")
        if "error" in step or "quirk" in step:
            # Upstream accepts a single Euler option by mistake; tftool refuses it.
            wanted = step.get(
                "error", "Cannot specify both new-style (flags) and old-style (arguments)"
            )
            with pytest.raises(UsageError) as refused:
                parse(step["argv"])
            assert str(refused.value).startswith(
                f"error parsing command line arguments: {wanted}"
            ), step
            continue
        said = parse(step["argv"])
        want = step["want"]
        if want == {"help": True}:
            assert said is None
            continue
        assert said is not None
        assert close(said.transform.translation, want["xyz"])
        assert close(said.transform.rotation, want["q"])
        assert (said.parent, said.child) == (want["parent"], want["child"])
        assert said.old_style is want["deprecated_warning"]


def run_echo_format(case: Step) -> None:
    for step in only(case, "echo"):
        fields(step, "stamp", "xyz", "q", "quaternion_tag", "precision", "want")
        found = TransformStamped(step["stamp"], "a", "b", Transform(step["xyz"], step["q"]))
        written = echo.block(
            found, precision=step["precision"], quaternion_tag=step["quaternion_tag"]
        )
        assert written == step["want"]


def frame(name: str, said: Mapping[str, Any] | None) -> FrameInfo:
    """Return a frame with only the data that view_frames writes to YAML."""
    said = said or {}
    oldest = seconds(said.get("oldest_transform", 0.0))
    newest = seconds(said.get("most_recent_transform", 0.0))
    return FrameInfo(
        frame=name,
        parent=said.get("parent"),
        is_static=False,
        authority=said.get("broadcaster"),
        samples=1,
        rate=said.get("rate", 0.0),
        oldest=oldest,
        newest=newest,
        buffer_length=newest - oldest,
        age=0,
        transform=IDENTITY,
        root="world",
        root_from_frame=IDENTITY,
    )


def run_view_frames_dot(case: Step) -> None:
    for step in only(case, "view_frames"):
        fields(step, "yaml", "recorded_sec", "recorded_nsec", "want")
        said = yaml.safe_load(step["yaml"]) or {}
        roots = dict.fromkeys(one["parent"] for one in said.values() if one["parent"] not in said)
        frames = [frame(name, one) for name, one in said.items()]
        frames += [frame(root, None) for root in roots]
        now = step["recorded_sec"] * 10**9 + step["recorded_nsec"]
        assert drawing.dot(Snapshot(now, 0, tuple(frames))).content == step["want"]


def run_monitor_format(case: Step) -> None:
    for step in only(case, "monitor", "net_delay"):
        if step["op"] == "net_delay":
            fields(step, "diffs", "avg", "max")
            delay = NetDelay()
            for difference in step["diffs"]:
                delay.add(difference)
            assert format(delay.tf2_average, "g") == step["avg"]
            assert format(delay.maximum, "g") == step["max"]
            continue
        fields(step, "messages", "lines")
        traffic = Traffic()
        for message in step["messages"]:
            traffic.receive(
                seconds(message["now"]),
                [
                    TransformStamped(seconds(stamp), "world", child, IDENTITY)
                    for child, stamp in message["transforms"]
                ],
                "<no authority available>",
            )
        written = monitor.lines(traffic, as_tf2=True).split("\n")
        assert [line for line in written if line.startswith(("Frame:", "Node:"))] == step["lines"]


def run_static_broadcaster(case: Step) -> None:
    steps = only(case, "broadcast")
    (replacing,) = (step for step in steps if step["variant"] == "replace")
    for step in steps:
        fields(step, "variant", "sends", "latched")
        assert step["variant"] in ("replace", "keep_first", "last_only")
        # Two of the three variants are faults of earlier upstream versions. tftool always replaces
        # in place, as C++ does.
        assert step["sends"] == replacing["sends"]
        world = World(SimClock())
        latched = []
        for sent in step["sends"]:
            world.broadcast(
                [
                    TransformStamped(1, parent, child, Transform((x, 0.0, 0.0)))
                    for parent, child, x in sent
                ],
                "static_broadcaster",
                static=True,
            )
            assert world.tf_static.latest is not None
            latched.append(
                [
                    [one.frame_id, one.child_frame_id, one.transform.translation.x]
                    for one in world.tf_static.latest.transforms
                ]
            )
        assert latched == replacing["latched"]
