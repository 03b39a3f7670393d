"""The node `robot` of scenarios: a robot from a description beside the scenario, moving."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from tftool.base.errors import InputError, UsageError
from tftool.scenario import document
from tftool.scenario import units as values
from tftool.scenario.fields import Reader, Reading, quoted
from tftool.world.node import Node
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.robots.robot_model import Robot
    from tftool.world.nodes.joints import Motion

MOTIONS = ("still", "sine", "steps", "recorded")


def robot_file(node: document.Node, reading: Reading) -> "Robot":
    """Read the description a scenario names, beside the scenario; xacro is code, and refused."""
    # numpy comes with it, which other scenarios do without.
    from tftool.robots.robot_model import Robot
    from tftool.robots.urdf import load_description

    path = _beside(node, reading, "a robot description")
    try:
        return Robot(load_description(path, plain=True))
    except (InputError, UsageError) as error:
        raise reading.refuse(node, str(error)) from None


def joint_recording(node: document.Node, reading: Reading) -> tuple[Any, ...]:
    """Read the joint states of the recording a scenario names, beside the scenario."""
    from tftool.recordings.recording import open_recording

    path = _beside(node, reading, "a recording")
    try:
        with open_recording(path) as recording:
            return recording.joint_states.states
    except (InputError, UsageError) as error:
        raise reading.refuse(node, str(error)) from None


def joint_positions(node: document.Node, reading: Reading) -> dict[str, float]:
    """Positions by joint: a bare number is radians or metres, `30 deg` and `5 cm` say which."""
    found = {
        name: reading.try_read(_position, value)
        for name, (_, value) in reading.entries(node, "joint: position").items()
    }
    reading.whole(found.values())
    return found


def _position(node: document.Node, reading: Reading) -> float:
    text = reading.text(node, "a position").strip()
    unit = text.lstrip("+-0123456789.eE").strip() if text[:1] not in "mk" else text
    read: Reader = values.length if unit in values.LENGTH.factors else values.angle
    position: float = read(reading.part(node, text), reading)
    return position


def _beside(node: document.Node, reading: Reading, wanted: str) -> Path:
    text = reading.text(node, wanted)
    path = Path(reading.source.name).parent / text
    if not path.exists():
        raise reading.refuse(node, f"there is no file {quoted(text)} beside the scenario")
    return path


def moving_robot(
    world: World,
    name: str,
    *,
    file: "Robot",
    joints: dict[str, float] | None = None,
    motion: "Motion" = "still",
    recording: tuple[Any, ...] = (),
    cycle: int = 4_000_000_000,
    period: int = 50_000_000,
    frame_prefix: str = "",
) -> Node:
    """The node; see `nodes.joints.MovingRobot`."""
    from tftool.world.nodes.joints import MovingRobot

    return MovingRobot(
        world,
        name,
        file=file,
        joints=joints,
        motion=motion,
        recording=recording,
        cycle=cycle,
        period=period,
        frame_prefix=frame_prefix,
    )


FIELDS: dict[str, Reader] = {
    "file": robot_file,
    "joints": joint_positions,
    "motion": values.choice(MOTIONS, "a motion"),
    "recording": joint_recording,
    "cycle": values.period,
    "period": values.period,
    "frame_prefix": values.text,
}
