"""Writing a mount: as one origin of a description, or as a static transform publisher."""

from dataclasses import dataclass
from pathlib import Path
from typing import Final
from xml.parsers import expat

from tftool.base.errors import InputError, LookupException, TransformException, UsageError
from tftool.base.plain_text import visible
from tftool.buffer.batch.transform_array import TransformArray
from tftool.buffer.buffer import NO_LIMIT, Buffer
from tftool.buffer.sample import TransformStamped
from tftool.commands.shared.printer import write_file
from tftool.frames.calibration.calibrate import Calibration
from tftool.frames.export.export import export
from tftool.frames.frames import Frames
from tftool.geometry.notation.notations import publisher_words, urdf_origin
from tftool.geometry.rigid import Transform
from tftool.robots.description import RobotJoint
from tftool.robots.robot_model import Robot
from tftool.robots.urdf import is_xacro

MOUNT_FILES: Final = (".urdf", ".launch.py", ".launch.yaml", ".launch.xml", ".sh")
"""Ends of the names of files that a mount is written to."""


@dataclass(frozen=True, slots=True)
class PublishedMount:
    """Mount as tf or a description has it.

    Attributes:
        mount: The mounted frame in moving_a; None where none is published.
        name: The mounted frame's name there.
        parent: moving_a.
        robot: The description; None without one.
        buffer: Frames to look up the links between.
    """

    mount: Transform | None
    name: str
    parent: str
    robot: Robot | None
    buffer: Buffer

    @classmethod
    def of(
        cls, robot: Robot | None, frames: Frames, paths: list[TransformArray], mounted: str | None
    ) -> "PublishedMount":
        """Find the mount in a description, else in tf.

        Raises:
            LookupException: If `mounted` is no frame that is joined with moving_a.
        """
        parent, name = paths[0].child_frame_id, mounted or paths[1].child_frame_id
        buffer = frames.buffer if robot is None else robot.buffer()
        try:
            mount = buffer.lookup_transform(parent, name).transform
        except TransformException:
            if mounted is not None:
                known = buffer.frame_exists(mounted)
                reason = f"is not joined with '{parent}'" if known else "is no frame"
                label = frames.label if robot is None else robot.name
                raise LookupException(
                    f"--mounted {mounted}: '{mounted}' {reason} in {visible(label)}.",
                    frame=mounted,
                ) from None
            mount = None
        return cls(mount, name, parent, robot, buffer)

    def refuse_without_mount(self) -> None:
        """Refuse to compare with a mount that nobody published.

        Raises:
            UsageError: If none is.
        """
        if self.mount is None:
            raise UsageError(
                f"No mount of '{self.name}' on '{self.parent}' is published: give a "
                "description with --urdf FILE, or the frame with --mounted NAME."
            )


def write_mount(
    output: Path,
    found: Calibration,
    published: PublishedMount,
    chosen: RobotJoint | None,
    urdf: Path | None,
) -> list[str]:
    """Write a mount, and return sentences about it.

    Known transforms on both sides of the changed joint are taken into account.

    Raises:
        UsageError: If the description is made by xacro.
    """
    assert found.mount is not None
    parent, child = found.moving if chosen is None else (chosen.parent, chosen.child)
    if chosen is None and published.name not in (found.moving[1], found.fixed[1]):
        child = published.name  # of --mounted: the frame that tf has for it
    pose = found.mount
    if chosen is not None:
        pose = (
            published.buffer.lookup_transform(parent, published.parent).transform
            @ pose
            @ published.buffer.lookup_transform(published.name, child).transform
        )
    if output.suffix != ".urdf":
        buffer = Buffer(NO_LIMIT)
        buffer.set_transform_static(TransformStamped(0, parent, child, pose), "calibrate")
        export(buffer, path=output, force=True)
        words = " ".join(publisher_words(pose))
        return [f"Wrote {output}: {words} --frame-id {parent} --child-frame-id {child}"]
    assert urdf is not None
    assert chosen is not None
    text = urdf.read_bytes()
    origin = urdf_origin(pose)
    if is_xacro(text.decode("utf-8", "replace")):
        line = _line_of(text, chosen.name)
        raise UsageError(
            f"'{urdf}' is made by xacro: change the origin of joint '{chosen.name}' "
            f"({urdf}{line}) to {origin}"
        )
    write_file(output, with_origin(text, chosen.name, origin))
    return [f"Wrote {output}: joint '{chosen.name}' has {origin}"]


def joint_to_change(output: Path, published: PublishedMount, name: str | None) -> RobotJoint | None:
    """Return the named joint, else the first fixed one on the way from moving_a.

    None if there is none, and the output is not a description.

    Raises:
        UsageError: If the description has no such joint, or the joint is not between the frames.
    """
    chosen = _joint(published, name)
    if chosen is None and output.suffix == ".urdf":
        raise UsageError(
            f"The description has no '{published.name}' below '{published.parent}': name the "
            "frame with --mounted NAME, or the joint with --joint NAME."
        )
    return chosen


def _joint(published: PublishedMount, name: str | None) -> RobotJoint | None:
    robot = published.robot
    if robot is None:
        if name is not None:
            raise UsageError("--joint goes with a description: name it with --urdf FILE.")
        return None
    way: list[RobotJoint] = []
    link = published.name
    while link != published.parent and link != robot.root and link in robot.links:
        way.append(robot.joint_above(link))
        link = way[-1].parent
    if name is not None:
        found = robot.joints.get(name)
        if found is None or (way and found not in way):
            on_it = ", ".join(one.name for one in way) or "none"
            raise UsageError(
                f"No joint '{name}' between '{published.parent}' and '{published.name}': there is "
                f"{on_it}."
            )
        return found
    if link != published.parent:
        return None
    return next((one for one in reversed(way) if not one.moves), None)


def with_origin(text: bytes, joint: str, origin: str) -> bytes:
    """Return a description with a new origin of one joint and no other byte changed.

    Raises:
        InputError: If the text is not XML, or has no such joint.
    """
    parser = expat.ParserCreate()
    depth = 0
    inside = -1
    span: list[int] = []

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal depth, inside
        depth += 1
        here = parser.CurrentByteIndex
        if tag == "joint" and attributes.get("name") == joint and inside < 0 and not span:
            inside = depth
            span[:] = [end_of_tag(here)] * 2
        elif tag == "origin" and depth == inside + 1:
            span[:] = [here, end_of_tag(here)]

    def end(tag: str) -> None:
        nonlocal depth, inside
        if depth == inside:
            inside = -2
        depth -= 1

    def end_of_tag(begin: int) -> int:
        quote = 0
        for place in range(begin, len(text)):
            sign = text[place]
            if quote:
                quote = 0 if sign == quote else quote
            elif sign in b"\"'":
                quote = sign
            elif sign == ord(">"):
                return place + 1
        return len(text)

    parser.StartElementHandler, parser.EndElementHandler = start, end
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        raise InputError(f"The description is no XML: {error}.") from error
    if not span:
        raise InputError(f"The description has no joint '{joint}'.")
    low, high = span
    old = text[low:high]
    if low == high:
        return text[:low] + b"\n    " + origin.encode() + text[high:]
    # An element that is closed apart keeps its end tag.
    new = origin if old.endswith(b"/>") else origin.removesuffix("/>").rstrip() + ">"
    return text[:low] + new.encode() + text[high:]


def _line_of(text: bytes, joint: str) -> str:
    for number, line in enumerate(text.split(b"\n"), 1):
        if b"<joint" in line and joint.encode() in line:
            return f":{number}"
    return ""
