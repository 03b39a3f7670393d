"""What happens in a scenario: each action, done when its time comes.

To add an action: a dataclass in `actions`, a coroutine that does it, and one
entry in `ACTIONS`.
"""

import asyncio
from collections.abc import Awaitable, Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from tftool.errors import TftoolError
from tftool.frames.sample import TransformStamped
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.rigid import Transform
from tftool.messages import (
    Clear,
    KeyPress,
    Kill,
    Killed,
    Reset,
    RotateAbsolute,
    SetPen,
    Spawn,
    Spawned,
    TeleportAbsolute,
    TeleportRelative,
    Twist2D,
)
from tftool.runtime.node import Node
from tftool.runtime.world import World
from tftool.scenario import actions
from tftool.scenario.schema import Step
from tftool.scenario.verdict import Outcome
from tftool.stamps import Duration, Stamp, as_seconds, seconds

REFRESH: Duration = seconds(0.5)
"""How often a drive repeats its command; a turtle stops a second after the last one."""


PATIENCE: Duration = seconds(1)
"""How long before the end a service must have been asked for its silence to count."""


class StepFailed(TftoolError):
    """A step was refused, and why."""


class Script(Node):
    """Does every step at its time; steps of one instant in the order of the file.

    A step that fails is told and noted; the others are done all the same.

    Attributes:
        start: The moment the script began.
        outcomes: What came of the steps that were to fail, and of those that failed.
    """

    def __init__(self, world: World, steps: Sequence[Step]) -> None:
        """Act in `world`."""
        super().__init__(world, "script")
        self.steps = tuple(steps)
        self.start = world.clock.now()
        self.outcomes: list[Outcome] = []

    async def run(self) -> None:
        """Do all steps; one that waits for an answer holds up no other."""
        self.start = self.clock.now()
        await asyncio.gather(*(self._do(step) for step in self.steps))

    async def _do(self, step: Step) -> None:
        await self.wait_until(self.start + step.at)
        refusal = ""
        try:
            await _DO[type(step.action)](step.action, self)
        except TftoolError as error:
            refusal = f"{error}"
        if not (refusal or step.fails):
            return
        if refusal and not step.fails:
            self.error(f"Step '{step.name}' in line {step.line} failed: {refusal}")
        self.outcomes.append(
            Outcome(
                expectation=f"step '{step.name}'",
                line=step.line,
                when=f"at {as_seconds(step.at):g} s",
                expected="fails" if step.fails else "is done",
                found=f"refused: {refusal}" if refusal else "done",
                at=self.clock.now() - self.start,
                ok=step.fails == bool(refusal),
            )
        )

    async def call(self, service: str, request: Any) -> Any:
        """Ask a service and wait for its answer.

        Raises:
            StepFailed: If the run ends and there is none.
        """
        asked = self.clock.now()
        try:
            return await super().call(service, request)
        except asyncio.CancelledError:
            silent = self.clock.now() - asked
            if silent < PATIENCE:
                raise
            raise StepFailed(
                f"'{service}' has not answered for {as_seconds(silent):g} s, up to the end"
            ) from None

    async def wait_until(self, stamp: Stamp) -> None:
        """Wait for a moment, in this node's place within it."""
        await self.clock.sleep_until(stamp, self.phase, self.rank)


async def _press(action: actions.Press, script: Script) -> None:
    start = script.clock.now()
    for count, key in enumerate(action.keys):
        await script.wait_until(start + count * action.every)
        script.publish("keys", KeyPress(key))


async def _drive(action: actions.Drive, script: Script) -> None:
    topic = script.world.topic(f"{action.turtle}/cmd_vel", Twist2D)
    at = script.clock.now()
    end = at + action.lasting
    heard = topic.subscribers > 0
    while at < end:
        topic.publish(Twist2D(action.linear, action.angular, action.sideways))
        at = min(at + REFRESH, end)
        await script.wait_until(at)
        heard = heard or topic.subscribers > 0
    topic.publish(Twist2D())
    if not heard:
        raise StepFailed(f"nobody listens to '{topic.name}'")


async def _spawn(action: actions.SpawnTurtle, script: Script) -> None:
    request = Spawn(action.x, action.y, action.theta, action.name)
    spawned: Spawned = await script.call("spawn", request)
    if not spawned.name:
        raise StepFailed(f"the simulator refused a turtle named '{action.name}'")


async def _kill(action: actions.KillTurtle, script: Script) -> None:
    killed: Killed = await script.call("kill", Kill(action.turtle))
    if not killed.found:
        raise StepFailed(f"there is no turtle '{action.turtle}'")


async def _teleport(action: actions.Teleport, script: Script) -> None:
    request = TeleportAbsolute(action.x, action.y, action.theta)
    await script.call(f"{action.turtle}/teleport_absolute", request)


async def _hop(action: actions.Hop, script: Script) -> None:
    request = TeleportRelative(action.linear, action.angular)
    await script.call(f"{action.turtle}/teleport_relative", request)


async def _rotate(action: actions.Rotate, script: Script) -> None:
    goal = RotateAbsolute(action.theta)
    await script.world.send_goal(f"{action.turtle}/rotate_absolute", goal)


async def _set_pen(action: actions.Pen, script: Script) -> None:
    request = SetPen(action.r, action.g, action.b, action.width, int(action.off))
    await script.call(f"{action.turtle}/set_pen", request)


async def _clear(action: actions.ClearField, script: Script) -> None:
    await script.call("clear", Clear())


async def _reset(action: actions.ResetField, script: Script) -> None:
    await script.call("reset", Reset())


_REFUSED = "the buffer refused it; the log says why"


def _transform(action: actions.Broadcast | actions.BroadcastStatic) -> Transform:
    rotation = quaternion_from_rpy(action.roll, action.pitch, action.yaw)
    return Transform((action.x, action.y, action.z), rotation)


async def _broadcast(action: actions.Broadcast, script: Script) -> None:
    pose = _transform(action)
    at = script.clock.now()
    end = at + action.lasting
    whole = True
    while True:
        stamp = action.stamp.stamp(script.start, at)
        sample = TransformStamped(stamp, action.parent, action.child, pose)
        whole = script.broadcast(sample) and whole
        at += action.every
        if at > end:
            break
        await script.wait_until(at)
    if not whole:
        raise StepFailed(_REFUSED)


async def _static(action: actions.BroadcastStatic, script: Script) -> None:
    now = script.clock.now()
    pose = _transform(action)
    if not script.broadcast_static(TransformStamped(now, action.parent, action.child, pose)):
        raise StepFailed(_REFUSED)


async def _stop(action: actions.StopNode, script: Script) -> None:
    # It may be gone already: stopped before, or left out by whoever hosts this world.
    gone = [node for node in script.world.nodes if node.name == action.node]
    for node in gone:
        # A program of the user's ends with its node. Asked this way, because what runs such
        # programs is loaded by nobody who has none.
        script.world.remove(getattr(node, "program", node))
    if not gone:
        script.warn(f"No node is named '{action.node}' (any more); nothing is stopped")


async def _say(action: actions.Say, script: Script) -> None:
    script.info(action.text)


ACTIONS: Mapping[str, tuple[type, Callable[[Any, Script], Awaitable[None]]]] = MappingProxyType(
    {
        "keys": (actions.Press, _press),
        "drive": (actions.Drive, _drive),
        "spawn": (actions.SpawnTurtle, _spawn),
        "kill": (actions.KillTurtle, _kill),
        "teleport": (actions.Teleport, _teleport),
        "hop": (actions.Hop, _hop),
        "rotate": (actions.Rotate, _rotate),
        "set_pen": (actions.Pen, _set_pen),
        "clear": (actions.ClearField, _clear),
        "reset": (actions.ResetField, _reset),
        "broadcast": (actions.Broadcast, _broadcast),
        "static": (actions.BroadcastStatic, _static),
        "stop": (actions.StopNode, _stop),
        "say": (actions.Say, _say),
    }
)

_DO = dict(ACTIONS.values())
