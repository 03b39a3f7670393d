"""Vectors of kind `buffer`: samples, lookups, and refusals with their exact texts."""

import math
from collections.abc import Callable, Mapping
from typing import Any

import pytest

from tests.tf2.loader import CACHE, VELOCITY, Unknown, close, fields
from tftool.base.errors import ExtrapolationException, TransformException
from tftool.buffer.buffer import NEVER, Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform, transform

Step = Mapping[str, Any]

NO_TURN = (0.0, 0.0, 0.0, 1.0)


def sample(step: Step) -> TransformStamped:
    # The pose is not checked, like a pose decoded from a message.
    pose = transform(tuple(step.get("xyz", (0.0, 0.0, 0.0))), tuple(step.get("q", NO_TURN)))
    return TransformStamped(step["stamp"], step["parent"], step["child"], pose)


def check_pose(found: TransformStamped, want: Step) -> None:
    assert close(found.transform.translation, want["xyz"])
    assert close(found.transform.rotation, want["q"])
    assert found.stamp == want["stamp"]


class Runner:
    """One buffer, with its log messages and callbacks during a step."""

    def __init__(self, case: Step) -> None:
        self.logged: list[str] = []
        self.fired: list[tuple[str, str]] = []
        self.handles: dict[str, int] = {}
        self.quirk = "quirk" in case
        self.buffer = Buffer(
            case.get("cache_ns", CACHE), log=lambda level, text: self.logged.append(text)
        )

    def step(self, step: Step) -> None:
        run = getattr(self, f"do_{step['op']}", None)
        if run is None:
            raise Unknown(f"operation {step['op']}")
        self.logged.clear()
        self.fired.clear()
        run(step)

    # Setting

    def do_set(self, step: Step) -> None:
        fields(
            step,
            *("parent", "child", "stamp", "xyz", "q", "static", "authority"),
            *("ok", "log", "fires", "fires_unordered_ok"),
        )
        set_ = self.buffer.set_transform_static if step.get("static") else self.buffer.set_transform
        accepted = set_(sample(step), step.get("authority", "authority"))
        assert accepted is step.get("ok", True)
        assert [line.split()[0].rstrip(":") for line in self.logged] == step.get("log", [])
        if "fires" in step:
            self.check_fired(step)

    def check_fired(self, step: Step) -> None:
        wanted = [tuple(one) for one in step["fires"]]
        if self.quirk and wanted == [("r", "failure")]:
            # Upstream lets a request for the latest time expire; tftool fulfils it.
            wanted = [("r", "available")]
        if step.get("fires_unordered_ok"):
            # Upstream's order depends on how it removes requests from its list; the set is the
            # same.
            wanted.sort()
        assert self.fired == wanted

    def do_set_chain(self, step: Step) -> None:
        fields(step, "n", "stamp")
        for number in range(step["n"]):
            stored = TransformStamped(step["stamp"], f"f{number}", f"f{number + 1}", Transform())
            assert self.buffer.set_transform(stored, "authority")

    def do_clear(self, step: Step) -> None:
        fields(step)
        self.buffer.clear()

    # Lookups

    def refused_or(self, step: Step, ask: Callable[[], Any]) -> Any:
        """Return the result; None if the lookup was refused as wanted."""
        if "raises" not in step:
            return ask()
        with pytest.raises(TransformException) as refused:
            ask()
        assert type(refused.value).__name__ == step["raises"]
        if "msg" in step:
            assert str(refused.value) == step["msg"]
        if isinstance(refused.value, ExtrapolationException):
            assert refused.value.remedy
        return None

    def do_lookup(self, step: Step) -> None:
        fields(step, "target", "source", "time", "want", "raises", "msg")
        target, source = step["target"], step["source"]
        # The second lookup may use the plan that the first one stored.
        for _ in range(2):
            found = self.refused_or(
                step, lambda: self.buffer.lookup_transform(target, source, step["time"])
            )
            if found is not None:
                check_pose(found, step["want"])
                assert (found.frame_id, found.child_frame_id) == (target, source)

    def do_lookup_rows(self, step: Step) -> None:
        fields(step, "time", "stamp", "rows")
        for target, source, xyz, q in step["rows"]:
            want = {"xyz": xyz, "q": q, "stamp": step["stamp"]}
            for _ in range(2):
                check_pose(self.buffer.lookup_transform(target, source, step["time"]), want)

    def full(self, step: Step) -> tuple[str, int, str, int, str]:
        return (
            step["target"],
            step["target_time"],
            step["source"],
            step["source_time"],
            step["fixed"],
        )

    def do_lookup_full(self, step: Step) -> None:
        fields(step, *FULL, "want", "raises", "msg")
        found = self.refused_or(step, lambda: self.buffer.lookup_transform_full(*self.full(step)))
        if found is not None:
            check_pose(found, step["want"])

    def do_latest_common_time(self, step: Step) -> None:
        fields(step, "a", "b", "want", "raises")
        for _ in range(2):
            found = self.refused_or(
                step, lambda: self.buffer.get_latest_common_time(step["a"], step["b"])
            )
            assert found == step.get("want")

    # Checks of availability

    def do_can(self, step: Step) -> None:
        fields(step, "target", "source", "time", "want", "msg")
        question = step["target"], step["source"], step["time"]
        for _ in range(2):
            assert self.buffer.can_transform(*question) is step["want"]
        if "msg" in step:
            assert self.buffer.why_not(*question) == step["msg"]
        assert bool(self.buffer.why_not(*question)) is not step["want"]

    def do_can_full(self, step: Step) -> None:
        fields(step, *FULL, "want", "msg")
        question = self.full(step)
        assert self.buffer.can_transform_full(*question) is step["want"]
        if "msg" in step:
            assert self.buffer.why_not_full(*question) == step["msg"]

    def do_request(self, step: Step) -> None:
        fields(step, "id", "target", "source", "time", "want")
        name = step["id"]

        def called(handle: int, available: bool) -> None:
            assert handle == self.handles[name]
            self.fired.append((name, "available" if available else "failure"))

        handle = self.buffer.request(called, step["target"], step["source"], step["time"])
        self.handles[name] = handle
        assert {0: "immediate", NEVER: "never"}.get(handle, "pending") == step["want"]

    def do_cancel(self, step: Step) -> None:
        fields(step, "id")
        self.buffer.cancel(self.handles[step["id"]])

    # Velocities

    def check_velocity(self, step: Step, ask: Callable[[], Any]) -> None:
        found = self.refused_or(step, ask)
        if found is None:
            return
        want = step["want"]
        assert close(found.linear, want["linear"], VELOCITY)
        assert close(found.angular, want["angular"], VELOCITY)
        assert abs(found.stamp - want["stamp"]) <= 1000
        assert (found.frame, found.body) == (want["frame"], want["body"])

    def do_velocity(self, step: Step) -> None:
        fields(step, "tracking", "observation", "time", "interval", "want", "raises", "msg")
        question = step["tracking"], step["observation"], step["time"], step["interval"]
        self.check_velocity(step, lambda: self.buffer.lookup_velocity(*question))
        if self.quirk:
            # Upstream's numbers are in the fields named after upstream. The numbers below are the
            # physical ones: p at radius 1, turning at 1 rad/s, is now at 0.5 rad.
            plain = self.buffer.lookup_twist(*question)
            assert close(plain.linear, (-math.sin(0.5), math.cos(0.5), 0.0), 2e-3)
            assert close(plain.angular, (0.0, 0.0, 1.0), VELOCITY)

    def do_velocity_full(self, step: Step) -> None:
        fields(
            step,
            *("tracking", "observation", "reference", "point", "point_frame"),
            *("time", "interval", "want", "raises", "msg"),
        )
        # The element-wise shift is upstream's formula, in the field named after upstream.
        self.check_velocity(
            step,
            lambda: self.buffer.lookup_velocity_full(
                step["tracking"],
                step["observation"],
                step["reference"],
                step["point"],
                step["point_frame"],
                step["time"],
                step["interval"],
            ),
        )

    # Whole buffer

    def do_frames(self, step: Step) -> None:
        fields(step, "want")
        assert self.buffer.frames() == step["want"]

    def do_exists(self, step: Step) -> None:
        fields(step, "frame", "want")
        assert self.buffer.frame_exists(step["frame"]) is step["want"]

    def do_parent(self, step: Step) -> None:
        fields(step, "frame", "time", "want")
        assert self.buffer.parent(step["frame"], step["time"]) == step["want"]

    def do_yaml(self, step: Step) -> None:
        fields(step, "time", "want")
        assert self.buffer.all_frames_as_yaml(step["time"]) == step["want"]

    def do_dot(self, step: Step) -> None:
        fields(step, "time", "want")
        assert self.buffer.all_frames_as_dot(step["time"]) == step["want"]

    def do_string(self, step: Step) -> None:
        fields(step, "want")
        assert self.buffer.all_frames_as_string() == step["want"]

    def do_chain(self, step: Step) -> None:
        fields(step, "target", "source", "want")
        assert self.buffer.chain(step["target"], step["source"]) == step["want"]

    def do_chain_upstream(self, step: Step) -> None:
        fields(step, *FULL, "want")
        # ROS 2 loses frames; tftool returns the whole path, which contains upstream's frames.
        found = self.buffer.chain(step["target"], step["source"])
        if step["target"] == step["source"]:
            assert found == []
        else:
            assert found[0] == step["source"]
            assert found[-1] == step["target"]
            assert set(step["want"]) <= set(found)


FULL = ("target", "target_time", "source", "source_time", "fixed")


def run(case: Step) -> None:
    runner = Runner(case)
    for step in case["steps"]:
        runner.step(step)
