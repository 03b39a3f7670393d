"""Script of a scenario: the node that carries out the actions, and the classes of actions."""

import asyncio
from collections.abc import Sequence
from typing import Any, ClassVar, Final

from tftool.base.errors import TftoolError
from tftool.base.stamps import Duration, Stamp, as_seconds, seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.motion import CENTRE
from tftool.geometry.rigid import Transform
from tftool.messages.classes import build
from tftool.messages.turtle_messages import (
    Empty,
    Kill,
    RotateAbsolute,
    SetPen,
    Spawn,
    TeleportAbsolute,
    TeleportRelative,
    Twist,
    twist,
)
from tftool.scenario import units as values
from tftool.scenario.fields import Declared, declare, reads
from tftool.scenario.scenario import Outcome, Step
from tftool.scenario.units import RelativeMoment
from tftool.world.node import PATIENCE, Node
from tftool.world.nodes.turtle import PEN_COLOR, PEN_WIDTH
from tftool.world.nodes.turtle_drivers import KEYS, KeyPress
from tftool.world.world import World

SILENCE: Duration = seconds(1)
"""Nanoseconds before the end within which a request without response is not a failure."""


class StepFailed(TftoolError):
    """Error for an action that failed; the text is the reason."""


class Script(Node):
    """Node that carries out a script's actions in order of time.

    Actions of the same time are carried out in the order of the file. An action that fails is
    logged and recorded, and does not prevent later actions.

    Attributes:
        start: Time at which the script began.
        outcomes: Outcomes of the actions that are expected to fail, and of all actions that failed.
    """

    def __init__(self, world: World, steps: Sequence[Step]) -> None:
        """Add the node to a world, with the steps of a scenario."""
        super().__init__(world, "script")
        self.steps = tuple(steps)
        self.start = world.clock.now()
        self.outcomes: list[Outcome] = []

    async def run(self) -> None:
        """Carry out all steps at their times, also while an earlier step waits for a response."""
        self.start = self.clock.now()
        await asyncio.gather(*(self._do(step) for step in self.steps))

    async def _do(self, step: Step) -> None:
        await self.wait_until(self.start + step.at)
        refusal = ""
        try:
            await step.action.do(self)
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
        """Call a service and wait for the response.

        Raises:
            StepFailed: If the run ends before the response.
        """
        asked = self.clock.now()
        try:
            return await super().call(service, request)
        except asyncio.CancelledError:
            silent = self.clock.now() - asked
            if silent < SILENCE:
                raise
            raise StepFailed(
                f"'{service}' did not answer in the last {as_seconds(silent):g} s of the scenario"
            ) from None

    async def wait_until(self, stamp: Stamp) -> None:
        """Wait until `stamp`; other nodes may run first within that instant."""
        await self.clock.sleep_until(stamp, self.phase, self.rank)


REFRESH: Duration = seconds(0.5)
"""Nanoseconds between two commands of a drive; a turtle stops a second after the last one."""

_REFUSED = "the buffer rejected the transform: see the log for the reason"


ACTIONS: Final[dict[str, type["Action"]]] = {}
"""Class of every action, by its key."""


class Action(Declared):
    """Base of actions in a script.

    Attributes:
        key: Key of the action in a scenario, such as "spawn".
    """

    key: ClassVar[str]

    async def do(self, script: Script) -> None:
        """Carry out the action now.

        Raises:
            StepFailed: If the action fails, with the reason.
        """
        raise NotImplementedError


@declare(ACTIONS, "keys", short="keys")
class Press(Action):
    """Action that presses keys on the teleop node, one key per period `every`."""

    keys: tuple[str, ...] = reads(values.words(KEYS, "a key"))
    every: Duration = reads(values.period, seconds(1), beside=True)

    async def do(self, script: Script) -> None:
        """Publish the keys, one key per period."""
        start = script.clock.now()
        for count, key in enumerate(self.keys):
            await script.wait_until(start + count * self.every)
            script.publish("keys", KeyPress(key))


@declare(ACTIONS, "drive")
class Drive(Action):
    """Action that commands a velocity of a turtle for a duration, and then a stop."""

    turtle: str = reads(values.turtle, "turtle1")
    linear: float = reads(values.speed, 0.0)
    angular: float = reads(values.turn_rate, 0.0)
    sideways: float = reads(values.speed, 0.0)
    lasting: Duration = reads(values.duration, key="for", beside=True)

    async def do(self, script: Script) -> None:
        """Publish the velocity repeatedly for the duration; then publish a stop."""
        topic = script.publisher(f"{self.turtle}/cmd_vel", Twist)
        at = script.clock.now()
        end = at + self.lasting
        heard = topic.subscribers > 0
        while at < end:
            topic.publish(twist(self.linear, self.angular, self.sideways))
            at = min(at + REFRESH, end)
            await script.wait_until(at)
            heard = heard or topic.subscribers > 0
        topic.publish(twist())
        if not heard:
            raise StepFailed(f"nothing subscribes to '{topic.name}'")


@declare(ACTIONS, "spawn", short="name")
class SpawnTurtle(Action):
    """Action that spawns a turtle; if no name is given, the simulator chooses a name."""

    name: str = reads(values.turtle, "")
    x: float = reads(values.length, CENTRE)
    y: float = reads(values.length, CENTRE)
    theta: float = reads(values.angle, 0.0)

    async def do(self, script: Script) -> None:
        """Call the service that spawns the turtle."""
        request = build(Spawn.Request, self.x, self.y, self.theta, self.name)
        spawned = await script.call("spawn", request)
        if not spawned.name:
            raise StepFailed(f"the simulator refused a turtle named '{self.name}'")


@declare(ACTIONS, "kill", short="turtle")
class KillTurtle(Action):
    """Action that removes a turtle."""

    turtle: str = reads(values.turtle)

    async def do(self, script: Script) -> None:
        """Call the service that removes the turtle."""
        # The response has no fields, as in ROS 2.
        is_there = script.world.has_service(f"{self.turtle}/set_pen")
        await script.call("kill", build(Kill.Request, self.turtle))
        if not is_there:
            raise StepFailed(f"there is no turtle '{self.turtle}'")


@declare(ACTIONS, "teleport")
class Teleport(Action):
    """Action that moves a turtle to a pose at once."""

    turtle: str = reads(values.turtle, "turtle1")
    x: float = reads(values.length)
    y: float = reads(values.length)
    theta: float = reads(values.angle, 0.0)

    async def do(self, script: Script) -> None:
        """Call the turtle's service teleport_absolute."""
        request = build(TeleportAbsolute.Request, self.x, self.y, self.theta)
        await script.call(f"{self.turtle}/teleport_absolute", request)


@declare(ACTIONS, "hop")
class Hop(Action):
    """Action that turns a turtle by an angle, then moves it forward, both without delay."""

    turtle: str = reads(values.turtle, "turtle1")
    linear: float = reads(values.length, 0.0)
    angular: float = reads(values.angle, 0.0)

    async def do(self, script: Script) -> None:
        """Call the turtle's service teleport_relative."""
        request = build(TeleportRelative.Request, self.linear, self.angular)
        await script.call(f"{self.turtle}/teleport_relative", request)


@declare(ACTIONS, "rotate")
class Rotate(Action):
    """Action that turns a turtle to a heading by the ROS action rotate_absolute."""

    turtle: str = reads(values.turtle, "turtle1")
    theta: float = reads(values.angle)

    async def do(self, script: Script) -> None:
        """Send the goal, and do not wait until the turn has ended."""
        goal = build(RotateAbsolute.Goal, self.theta)
        script.world.send_goal(f"{self.turtle}/rotate_absolute", goal, patience=PATIENCE)


_channel = values.whole(0, 255)


@declare(ACTIONS, "set_pen")
class Pen(Action):
    """Action that sets the colour and width of a turtle's pen, or lifts the pen."""

    turtle: str = reads(values.turtle, "turtle1")
    r: int = reads(_channel, PEN_COLOR.r)
    g: int = reads(_channel, PEN_COLOR.g)
    b: int = reads(_channel, PEN_COLOR.b)
    width: int = reads(_channel, PEN_WIDTH)
    off: bool = reads(values.flag, False)

    async def do(self, script: Script) -> None:
        """Call the turtle's service set_pen."""
        request = build(SetPen.Request, self.r, self.g, self.b, self.width, int(self.off))
        await script.call(f"{self.turtle}/set_pen", request)


@declare(ACTIONS, "clear")
class ClearField(Action):
    """Action that erases all trails."""

    async def do(self, script: Script) -> None:
        """Call the simulator's service of the same name as the action: `clear` or `reset`."""
        await script.call(self.key, Empty.Request())


@declare(ACTIONS, "reset")
class ResetField(ClearField):
    """Action that resets the field to one turtle in the centre."""


class FrameAction(Action):
    """Base of actions that broadcast the pose of frame `child` in frame `parent`."""

    parent: str = reads(values.frame)
    child: str = reads(values.frame)
    x: float = reads(values.length, 0.0)
    y: float = reads(values.length, 0.0)
    z: float = reads(values.length, 0.0)
    roll: float = reads(values.angle, 0.0)
    pitch: float = reads(values.angle, 0.0)
    yaw: float = reads(values.angle, 0.0)

    @property
    def transform(self) -> Transform:
        """Pose of frame `child` in frame `parent`."""
        rotation = quaternion_from_rpy(self.roll, self.pitch, self.yaw)
        return Transform((self.x, self.y, self.z), rotation)


@declare(ACTIONS, "broadcast")
class Broadcast(FrameAction):
    """Action that broadcasts a transform, once or repeatedly for a duration."""

    stamp: RelativeMoment = reads(values.moment, RelativeMoment("now"))
    every: Duration = reads(values.period, seconds(0.1), beside=True)
    lasting: Duration = reads(values.duration, 0, key="for", beside=True)

    async def do(self, script: Script) -> None:
        """Broadcast the transform, once or every period."""
        pose = self.transform
        at = script.clock.now()
        end = at + self.lasting
        whole = True
        while True:
            stamp = self.stamp.stamp(script.start, at)
            sample = TransformStamped(stamp, self.parent, self.child, pose)
            whole = script.broadcast(sample) and whole
            at += self.every
            if at > end:
                break
            await script.wait_until(at)
        if not whole:
            raise StepFailed(_REFUSED)


@declare(ACTIONS, "static")
class BroadcastStatic(FrameAction):
    """Action that broadcasts a static transform."""

    async def do(self, script: Script) -> None:
        """Broadcast the static transform once."""
        now = script.clock.now()
        pose = self.transform
        if not script.broadcast_static(TransformStamped(now, self.parent, self.child, pose)):
            raise StepFailed(_REFUSED)


@declare(ACTIONS, "stop", short="node")
class StopNode(Action):
    """Action that stops a node, and removes the node from the world."""

    node: str = reads(values.name("a node"))

    async def do(self, script: Script) -> None:
        """Remove the node; for a node of a user's program, end the whole program."""
        # The node may be missing: stopped before, or omitted by the command that hosts.
        gone = [node for node in script.world.nodes if node.name == self.node]
        for node in gone:
            # A user's program ends with its node. Read by `getattr`, because the module that runs
            # such programs is imported only if there are any.
            script.world.remove(getattr(node, "program", node))
        if not gone:
            script.warn(f"No node is named '{self.node}' now, so no node was stopped")


@declare(ACTIONS, "say", short="text")
class Say(Action):
    """Action that logs a text for the people who watch the scenario."""

    text: str = reads(values.text)

    async def do(self, script: Script) -> None:
        """Log the message with level INFO."""
        script.info(self.text)
