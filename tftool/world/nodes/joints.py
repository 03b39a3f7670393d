"""Nodes for a robot's joints: robot_state_publisher, joint_state_publisher, a moving robot."""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Final, Literal, get_args

from tftool.base.errors import InputError, UsageError
from tftool.base.stamps import NANOSECONDS, Duration, Stamp, as_seconds, seconds
from tftool.buffer.sample import TransformStamped
from tftool.messages.classes import INTERFACES
from tftool.world.clock import Phase
from tftool.world.endpoints import Quality
from tftool.world.node import Node
from tftool.world.nodes.broadcasters import require_period
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.robots.description import RobotJoint
    from tftool.robots.joint_motion import JointStates
    from tftool.robots.robot_model import Robot

JOINT_STATES: Final = "joint_states"
DESCRIPTION: Final = "robot_description"

LATCHED: Final = Quality(depth=1, is_latched=True)
"""Quality of service of a robot description, which late subscribers get too."""

FASTEST: Final = 1000.0
"""Largest publish frequency that robot_state_publisher accepts, hertz."""

Motion = Literal["still", "sine", "steps", "recorded"]
MOTIONS: Final[tuple[Motion, ...]] = get_args(Motion)


def _described(text: str) -> "Robot":
    """Return the robot that a description (URDF text) defines."""
    # Imported here, with expat, because every scenario imports this module.
    from tftool.robots.robot_model import parse_robot

    return parse_robot(text)


def joint_state_type() -> type[Any]:
    """Return the message class of joint states."""
    return INTERFACES.message("sensor_msgs/msg/JointState")


def description_type() -> type[Any]:
    """Return the message class of a robot description."""
    return INTERFACES.message("std_msgs/msg/String")


def joint_state(stamp: Stamp, positions: Mapping[str, float]) -> Any:
    """Return a JointState message with a stamp and the positions of joints."""
    message = joint_state_type()()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, NANOSECONDS)
    message.name = list(positions)
    message.position = list(positions.values())
    return message


class RobotStatePublisher(Node):
    """Node that broadcasts a robot's frames: fixed joints at the start, others from joint states.

    The node works like ROS 2's node of the same name. A message with unequal numbers of names and
    positions is ignored. A message moves the joints that it names, and joints that mimic these
    joints. Transforms get the stamp of the message.
    """

    phase: ClassVar[Phase] = Phase.BROADCAST

    def __init__(
        self,
        world: World,
        name: str = "robot_state_publisher",
        *,
        robot: "Robot",
        frame_prefix: str = "",
        publish_frequency: float = 20.0,
        ignore_timestamp: bool = False,
        topics: Sequence[str] = (JOINT_STATES, DESCRIPTION),
    ) -> None:
        """Add the node to a world.

        Args:
            world: World to join.
            name: Name of the node.
            robot: The robot, whose description is also published.
            frame_prefix: Prefix of every frame's name, such as `left/`.
            publish_frequency: Largest rate in hertz at which a joint is broadcast; 0 for every
                message.
            ignore_timestamp: Whether to broadcast the frames of every message, even of messages
                with old stamps.
            topics: Topics of joint states and of the description.

        Raises:
            UsageError: If the frequency is out of range.
        """
        if not 0.0 <= publish_frequency <= FASTEST:
            raise UsageError(
                f"publish_frequency must be between 0 and {FASTEST:g} Hz, not {publish_frequency:g}"
            )
        super().__init__(world, name)
        self.robot = robot
        self.topics = topics
        self.declare_parameter("frame_prefix", frame_prefix)
        self.declare_parameter("publish_frequency", float(publish_frequency))
        self.declare_parameter("ignore_timestamp", ignore_timestamp)
        self.declare_parameter("robot_description", robot.description.text)
        self.parameters.on_change(self._on_parameter)
        self._published: dict[str, Stamp] = {}
        self._last_heard: Stamp = 0
        self._told: set[str] = set()
        self._is_running = False

    async def run(self) -> None:
        """Broadcast the fixed joints, and subscribe to joint states for the other joints."""
        self._is_running = True
        self._begin()
        self.subscribe(self.topics[0], joint_state_type(), self._on_joint_state)

    def _begin(self) -> None:
        publisher = self._publishers.get(self.topics[1])
        if publisher is None:
            publisher = self.publisher(self.topics[1], description_type(), LATCHED)
        publisher.publish(description_type()(data=self.robot.description.text))
        for joint in self.robot.joints.values():
            if joint.type in ("floating", "planar"):
                self._tell_once(
                    f"joint '{joint.name}' is {joint.type}: another node has to broadcast "
                    f"'{joint.child}', otherwise the tree is split there"
                )
        still = [
            one
            for one in self.robot.transforms()
            if self.robot.joint_above(one.child_frame_id).type == "fixed"
        ]
        if still:
            self.broadcast_static(*self._framed(still, self.clock.now()))

    def _framed(self, poses: Sequence[TransformStamped], stamp: Stamp) -> list[TransformStamped]:
        prefix = str(self.parameters["frame_prefix"])
        return [
            TransformStamped(
                stamp, prefix + one.frame_id, prefix + one.child_frame_id, one.transform
            )
            for one in poses
        ]

    def _on_parameter(self, name: str, value: object) -> None:
        if name == "robot_description":
            try:
                self.robot = _described(str(value))
            except InputError as error:
                self.error(
                    f"the new robot_description is rejected, and the old one is kept: {error}"
                )
                return
        elif name == "publish_frequency" and not 0.0 <= float(str(value)) <= FASTEST:
            raise UsageError(f"publish_frequency must be between 0 and {FASTEST:g} Hz")
        if self._is_running and name in ("robot_description", "frame_prefix"):
            self._begin()

    def _on_joint_state(self, message: Any) -> None:
        names, positions = list(message.name), list(message.position)
        if len(names) != len(positions):
            shown = ", ".join(names[:3])
            if positions:
                self._tell_once(
                    "ignored an invalid JointState message: "
                    f"{len(names)} names and {len(positions)} positions"
                )
            else:
                self._tell_once(f"ignored a JointState message about {shown} without positions")
            return
        now = self.clock.now()
        if now < self._last_heard:
            self.warn("Moved backwards in time, re-publishing joint transforms!")
            self._published.clear()
        self._last_heard = now
        stamp = message.header.stamp.sec * NANOSECONDS + message.header.stamp.nanosec
        frequency = float(self.parameters["publish_frequency"])
        interval = round(NANOSECONDS / frequency) if frequency else 0
        last = min((self._published.get(name, 0) for name in names), default=now)
        if stamp < min(last, now) + interval and not self.parameters["ignore_timestamp"]:
            return
        moved = self.robot.moved(dict(zip(names, positions, strict=True)), stamp)
        if moved:
            self.broadcast(*self._framed(moved, stamp))
        for name in names:
            self._published[name] = stamp

    def _tell_once(self, sentence: str) -> None:
        if sentence not in self._told:
            self._told.add(sentence)
            self.warn(sentence)


class JointStatePublisher(Node):
    """Node that publishes a robot's joint positions repeatedly; `move` changes a position.

    The node works like ROS 2's node of the same name. A joint begins at zero if its limits include
    zero, else in the middle of its limits. A mimic joint follows the joint that it mimics.
    """

    phase: ClassVar[Phase] = Phase.SIMULATE

    def __init__(
        self,
        world: World,
        name: str = "joint_state_publisher",
        *,
        robot: "Robot | None" = None,
        positions: Mapping[str, float] | None = None,
        rate: float = 10.0,
        sources: Sequence[str] = (),
        topics: Sequence[str] = (JOINT_STATES, DESCRIPTION),
    ) -> None:
        """Add the node to a world.

        Args:
            world: World to join.
            name: Name of the node.
            robot: The robot; None to wait for its description on a topic.
            positions: Initial positions of joints, radians or metres.
            rate: Rate of publishing, hertz.
            sources: Topics of joint states from other nodes, which set the same joints.
            topics: Topics of joint states and of the description.

        Raises:
            UsageError: If a joint is unknown, or the rate is out of range.
        """
        if not 0.0 < rate <= FASTEST:
            raise UsageError(f"rate must be above 0 and at most {FASTEST:g} Hz, not {rate:g}")
        super().__init__(world, name)
        self.robot = robot
        self.topics = topics
        self.sources = tuple(sources)
        self._period = require_period(round(NANOSECONDS / rate))
        self._given = dict(positions or {})
        if robot is not None:
            robot.positions(self._given)

    @property
    def positions(self) -> dict[str, float]:
        """Positions of all movable joints by name, with mimic joints; empty without a robot."""
        return {} if self.robot is None else self.robot.positions(self._given)

    def move(self, joint: str, position: float) -> None:
        """Set the position of a joint, and of the joints that mimic this joint.

        Raises:
            UsageError: If there is no such joint, or the joint cannot move.
        """
        if self.robot is not None:
            self.robot.positions({joint: position})
        self._given[joint] = position

    async def run(self) -> None:
        """Publish the joint positions every period until the end of the run."""
        # The publisher exists before the first message, so that others see who will publish.
        self.publisher(self.topics[0], joint_state_type())
        if self.robot is None:
            self.subscribe(self.topics[1], description_type(), self._on_description, LATCHED)
        for topic in self.sources:
            self.subscribe(topic, joint_state_type(), self._on_joint_state)
        async for now in self.every(self._period, immediately=True):
            positions = self.positions
            if positions:
                self.publish(self.topics[0], joint_state(now, positions))

    def _on_description(self, message: Any) -> None:
        try:
            robot = _described(message.data)
        except InputError as error:
            self.error(f"the description on '{self.topics[1]}' cannot be read: {error}")
            return
        unknown = [name for name in self._given if not robot.takes(name)]
        for name in unknown:
            self.warn(f"robot '{robot.name}' has no joint '{name}' that moves")
            del self._given[name]
        self.robot = robot

    def _on_joint_state(self, message: Any) -> None:
        for name, position in zip(message.name, message.position, strict=False):
            if self.robot is not None and self.robot.takes(name) and math.isfinite(position):
                self._given[name] = position


class MovingRobot(RobotStatePublisher):
    """Node for scenarios that moves a robot: publishes its description, joint states and frames."""

    def __init__(
        self,
        world: World,
        name: str = "robot",
        *,
        file: "Robot",
        joints: Mapping[str, float] | None = None,
        motion: Motion = "still",
        recording: "Sequence[JointStates]" = (),
        cycle: Duration = seconds(4),
        period: Duration = seconds(0.05),
        frame_prefix: str = "",
    ) -> None:
        """Add the node to a world.

        Args:
            world: World to join.
            name: Name of the node.
            file: The robot, loaded from the file that the scenario names.
            joints: Fixed positions of joints, which sine and steps do not move.
            motion: Motion of the other joints: "still"; "sine" between the limits of a joint
                (without limits, -1 and 1); "steps" to the middle, the upper limit, the middle and
                the lower limit, a quarter of a cycle each; or "recorded", from `recording`.
            recording: Joint states for the motion "recorded".
            cycle: Nanoseconds in which the first joint goes to both limits and back. Each
                further joint takes a little longer, so that no two joints move alike.
            period: Nanoseconds between two joint states.
            frame_prefix: Prefix of every frame's name, and namespace of the topics, so that the
                joint states of one robot do not move another robot.

        Raises:
            UsageError: If a joint is unknown, or a recording is missing or not needed.
        """
        if motion == "recorded" and not any(len(states) for states in recording):
            raise UsageError(
                "'motion: recorded' needs a recording with joint states: name one with 'recording'"
            )
        if motion != "recorded" and recording:
            raise UsageError("'recording' is only allowed together with 'motion: recorded'")
        file.positions(joints)
        namespace = frame_prefix.strip("/")
        super().__init__(
            world,
            name,
            robot=file,
            frame_prefix=frame_prefix,
            publish_frequency=0.0,
            topics=[f"{namespace}/{topic}".lstrip("/") for topic in (JOINT_STATES, DESCRIPTION)],
        )
        self.joints, self.motion, self.recording = dict(joints or {}), motion, tuple(recording)
        self.cycle, self.period = require_period(cycle), require_period(period)
        self._start: Stamp = 0

    async def run(self) -> None:
        """Move the joints until the end of the run."""
        await super().run()
        self._start = self.clock.now()
        if self.motion == "recorded":
            await self._replay()
            return
        async for now in self.every(self.period, immediately=True):
            positions = self.robot.positions({**self._swung(now), **self.joints})
            self.publish(self.topics[0], joint_state(now, positions))

    def _swung(self, now: Stamp) -> dict[str, float]:
        if self.motion == "still":
            return {}
        free = [
            joint
            for joint in self.robot.joints.values()
            if joint.moves and joint.mimic is None and joint.name not in self.joints
        ]
        return {joint.name: self._place(joint, number, now) for number, joint in enumerate(free)}

    def _place(self, joint: "RobotJoint", number: int, now: Stamp) -> float:
        lower, upper = joint.limits or (-1.0, 1.0)
        middle, reach = (lower + upper) / 2.0, (upper - lower) / 2.0
        share = as_seconds(now - self._start) / (as_seconds(self.cycle) * (1.0 + 0.1 * number))
        if self.motion == "sine":
            return middle + reach * math.sin(math.tau * share)
        return (middle, upper, middle, lower)[math.floor(4.0 * share) % 4]

    async def _replay(self) -> None:
        """Publish the recorded joint states at the recorded intervals."""
        rows = sorted(
            (int(stamp), place, row)
            for place, states in enumerate(self.recording)
            for row, stamp in enumerate(states.stamps)
        )
        for stamp, place, row in rows:
            due = self._start + stamp - rows[0][0]
            await self.clock.sleep_until(due, self.phase, self.rank)
            states = self.recording[place]
            positions = dict(zip(states.names, states.positions[row].tolist(), strict=True))
            self.publish(self.topics[0], joint_state(due, {**positions, **self.joints}))
