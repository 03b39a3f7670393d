"""Vectors of kinds `async` and `time_jump`: waits on simulated time, and clocks that jump back."""

import asyncio
from collections.abc import Mapping
from typing import Any

import pytest

from tests.tf2 import buffer_kind
from tests.tf2.loader import Unknown, fields
from tftool.base.errors import TransformException
from tftool.buffer.callbacks import LEAST_FALL, Watch, must_clear
from tftool.buffer.sample import TransformStamped
from tftool.world.clock import SimClock, run
from tftool.world.world import World

Step = Mapping[str, Any]

RULES = {"cpp": 1, "python": LEAST_FALL}
"""Backward jump that clears tf2's buffer in C++ and in Python; tftool has the one of Python."""


def run_time_jump(case: Step) -> None:
    runner = buffer_kind.Runner(case)
    watch = Watch(runner.buffer.clear)
    for step in case["steps"]:
        if step["op"] == "jump":
            fields(step, "rule", "delta_ns", "clock_change", "want_clear")
            cleared = must_clear(
                step["delta_ns"],
                source_changed=step["clock_change"],
                least_fall=RULES[step["rule"]],
            )
            assert cleared is step["want_clear"], step
        elif step["op"] == "clock":
            fields(step, "to")
            watch.read(step["to"])
        else:
            runner.step(step)


class Waits:
    """A world on simulated time, and the requests that wait in it."""

    def __init__(self) -> None:
        self.world = World(SimClock())
        self.waits: dict[str, asyncio.Task[TransformStamped]] = {}

    async def step(self, step: Step) -> None:
        run_step = getattr(self, f"do_{step['op']}", None)
        if run_step is None:
            raise Unknown(f"operation {step['op']}")
        await run_step(step)

    async def settle(self) -> None:
        """Run everything that is due at the present instant."""
        await self.world.clock.sleep(0)

    async def do_wait(self, step: Step) -> None:
        fields(step, "id", "target", "source", "time", "timeout", "done")
        self.waits[step["id"]] = asyncio.ensure_future(
            self.world.wait_for_transform(
                step["target"], step["source"], step["time"], step.get("timeout")
            )
        )
        await self.settle()
        assert self.waits[step["id"]].done() is step["done"]

    async def do_wait_full(self, step: Step) -> None:
        fields(step, "id", *buffer_kind.FULL, "done")
        self.waits[step["id"]] = asyncio.ensure_future(
            self.world.wait_for_transform_full(
                step["target"],
                step["target_time"],
                step["source"],
                step["source_time"],
                step["fixed"],
            )
        )
        await self.settle()
        assert self.waits[step["id"]].done() is step["done"]

    async def do_set(self, step: Step) -> None:
        fields(step, "parent", "child", "stamp", "xyz", "q", "static")
        self.world.broadcast(
            [buffer_kind.sample(step)], "authority", static=step.get("static", False)
        )
        await self.settle()

    async def do_done(self, step: Step) -> None:
        fields(step, "id", "want")
        assert self.waits[step["id"]].done() is step["want"]

    async def do_advance(self, step: Step) -> None:
        fields(step, "by")
        await self.world.clock.sleep(step["by"])

    async def do_outcome(self, step: Step) -> None:
        fields(step, "id", "want", "raises", "msg")
        wait = self.waits[step["id"]]
        if "raises" in step:
            with pytest.raises(TransformException) as refused:
                wait.result()
            assert type(refused.value).__name__ == step["raises"]
            assert str(refused.value) == step["msg"]
        else:
            buffer_kind.check_pose(wait.result(), step["want"])


def run_async(case: Step) -> None:
    waits = Waits()

    async def main() -> None:
        try:
            for step in case["steps"]:
                await waits.step(step)
        finally:
            for wait in waits.waits.values():
                wait.cancel()

    run(waits.world.clock, main())
