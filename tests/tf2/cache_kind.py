"""Vectors of kind `cache`: the history of one edge."""

import math
from collections.abc import Mapping
from typing import Any

from tests.tf2.loader import CACHE, Unknown, close, fields
from tftool.buffer import refusals
from tftool.buffer.history import BACKWARD, FORWARD, NO_DATA, TOO_OLD, History, StaticLink

Step = Mapping[str, Any]

NAMES = {
    NO_DATA: "NoDataForExtrapolationException",
    FORWARD: "ForwardExtrapolationException",
    BACKWARD: "BackwardExtrapolationException",
}


class Runner:
    """One history, or one static edge; parents are numbered in the order of their first use."""

    def __init__(self, case: Step) -> None:
        self.link = StaticLink() if case.get("static") else History(case.get("cache_ns", CACHE))
        self.parents: list[str] = []

    def step(self, step: Step) -> None:
        run = getattr(self, f"do_{step['op']}", None)
        if run is None:
            raise Unknown(f"operation {step['op']}")
        run(step)

    def number(self, parent: str) -> int:
        if parent not in self.parents:
            self.parents.append(parent)
        return self.parents.index(parent)

    def do_insert(self, step: Step) -> None:
        fields(step, "stamp", "parent", "xyz", "q", "ok")
        pose = (step.get("xyz", (0.0, 0.0, 0.0)), step.get("q", (0.0, 0.0, 0.0, 1.0)))
        outcome = self.link.insert(step["stamp"], self.number(step["parent"]), pose)
        assert (outcome != TOO_OLD) is step.get("ok", True)

    def do_get(self, step: Step) -> None:
        fields(step, "time", "want", "raises", "msg")
        time = step["time"]
        pose = self.link.at(time)
        if "raises" in step:
            assert isinstance(self.link, History)
            assert all(math.isnan(number) for number in pose)
            assert self.link.parent_at(time) == -1
            refusal = self.link.refusal(time)
            assert NAMES[refusal[0]] == step["raises"]
            if "msg" in step:
                assert refusals.shortfall(refusal, time) == step["msg"]
            return
        want = step["want"]
        assert close(pose[:3], want["xyz"])
        assert close(pose[3:], want["q"])
        assert self.parents[self.link.parent_at(time)] == want["parent"]
        if isinstance(self.link, History):
            assert self.link.stamp_at(time) == want["stamp"]
        else:
            # A static edge has no stamp, so the requested time is compared.
            assert time == want["stamp"]

    def do_items(self, step: Step) -> None:
        fields(step, "want")
        found = [[stamp, self.parents[parent]] for stamp, parent, _ in self.link.items()]
        assert found == step["want"]

    def do_length(self, step: Step) -> None:
        fields(step, "want")
        assert len(self.link) == step["want"]

    def do_latest(self, step: Step) -> None:
        fields(step, "want")
        assert self.link.newest_stamp == step["want"]

    def do_oldest(self, step: Step) -> None:
        fields(step, "want")
        assert self.link.oldest_stamp == step["want"]

    def do_parent(self, step: Step) -> None:
        fields(step, "time", "want")
        number = self.link.parent_at(step["time"])
        assert (None if number < 0 else self.parents[number]) == step["want"]

    def do_clear(self, step: Step) -> None:
        fields(step)
        if isinstance(self.link, History):
            self.link.clear()


def run(case: Step) -> None:
    runner = Runner(case)
    for step in case["steps"]:
        runner.step(step)
