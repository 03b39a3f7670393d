"""Files that publish static transforms: URDF, launch files, a shell script."""

import json
import re
import shlex
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final
from xml.sax.saxutils import quoteattr

from tftool.base.errors import InputError, UsageError
from tftool.base.stamps import LATEST, Stamp
from tftool.buffer.buffer import Buffer
from tftool.frames.export.export_formats import Format
from tftool.geometry.notation.notations import publisher_words, urdf_origin
from tftool.geometry.rigid import Transform
from tftool.robots.static_publishers import PUBLISHER

_NOT_XML = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
_PLAIN_WORD = re.compile(r"[^\s\"'$\\]+")


@dataclass(frozen=True, slots=True)
class FixedLink:
    """One transform to write as static: the pose of `child` in `parent`.

    Attributes:
        parent: Name of the parent frame.
        child: Name of the child frame.
        pose: Pose of the child in the parent.
        moves: Whether the child is a moving frame.
    """

    parent: str
    child: str
    pose: Transform
    moves: bool = False


def fixed_links(
    buffer: Buffer, *, with_moving: bool = False, time: Stamp = LATEST, root: str | None = None
) -> list[FixedLink]:
    """Return the static transforms of a buffer, in the order in which the frames arrived.

    Args:
        buffer: Source of the frames.
        with_moving: Whether to add moving frames with their poses at `time`.
        time: Time of the poses of moving frames, nanoseconds; 0 for the latest pose of each.
        root: Frame below which frames are returned, without those below a moving frame that is not
            added; None for all frames.

    Raises:
        TransformException: If a moving frame has no pose at that time, or `root` does not exist.
    """
    links = []
    for frame in buffer.frames():
        parent = buffer.parent(frame, time)
        if parent is None:
            continue
        still = buffer.samples(frame).is_static
        if still or with_moving:
            pose = buffer.lookup_transform(parent, frame, LATEST if still else time).transform
            links.append(FixedLink(parent, frame, pose, moves=not still))
    if root is None:
        return links
    if not buffer.frame_exists(root):
        # Raises an error that lists the known frames.
        buffer.lookup_transform(root, links[0].child if links else root)
    below = {root}
    grown = True
    while grown:
        fresh = {one.child for one in links if one.parent in below} - below
        below |= fresh
        grown = bool(fresh)
    return [one for one in links if one.parent in below]


def roots(links: Sequence[FixedLink]) -> list[str]:
    """Return the root frames (parents that are never a child) in order of appearance."""
    children = {one.child for one in links}
    return list(dict.fromkeys(one.parent for one in links if one.parent not in children))


def urdf(links: Sequence[FixedLink], name: str) -> str:
    """Return a URDF with a joint for every transform.

    Args:
        links: Transforms to write. Moving frames get floating joints, which robot_state_publisher
            ignores.
        name: Name of the robot.

    Raises:
        UsageError: If the frames do not form one tree.
        InputError: If a name contains characters that XML forbids.
    """
    tops = roots(links)
    if len(tops) != 1:
        shown = ", ".join(tops[:6]) + (" …" if len(tops) > 6 else "")
        raise UsageError(
            f"A URDF contains one tree, but there are {len(tops)}, with the roots {shown}: choose "
            "one with --root FRAME."
        )
    frames = dict.fromkeys([tops[0], *(one.child for one in links)])
    lines = ['<?xml version="1.0"?>', f"<robot name={_attribute(name)}>"]
    lines += [f"  <link name={_attribute(frame)}/>" for frame in frames]
    for one in links:
        kind = "floating" if one.moves else "fixed"
        joint = _attribute(f"{one.parent}_to_{one.child}")
        lines += [
            f'  <joint name={joint} type="{kind}">',
            f"    <parent link={_attribute(one.parent)}/>",
            f"    <child link={_attribute(one.child)}/>",
            f"    {urdf_origin(one.pose)}",
            "  </joint>",
        ]
    return "\n".join([*lines, "</robot>", ""])


def shell(links: Sequence[FixedLink]) -> str:
    """Return a shell script that runs a static_transform_publisher for each transform."""
    lines = ["#!/bin/sh", "# Publishes static transforms; Ctrl-C ends them all.", "set -e"]
    lines += [
        f"ros2 run tf2_ros {PUBLISHER} {shlex.join(_words(_whole_name(one)))} &" for one in links
    ]
    return "\n".join([*lines, "wait", ""])


def launch_python(links: Sequence[FixedLink]) -> str:
    """Return a Python launch file with a static_transform_publisher for each transform."""
    lines = [
        "from launch import LaunchDescription",
        "from launch_ros.actions import Node",
        "",
        "",
        "def generate_launch_description():",
        "    return LaunchDescription([",
    ]
    for one, name in zip(links, _node_names(links), strict=True):
        lines += [
            "        Node(",
            '            package="tf2_ros",',
            f'            executable="{PUBLISHER}",',
            f'            name="{name}",',
            "            arguments=[",
            *(f"                {line}," for line in _listed(_words(_whole_name(one)))),
            "            ],",
            "        ),",
        ]
    return "\n".join([*lines, "    ])", ""])


def launch_xml(links: Sequence[FixedLink]) -> str:
    """Return an XML launch file with a static_transform_publisher for each transform.

    Raises:
        InputError: If ROS would change a frame name that it reads from such a file.
    """
    lines = ['<?xml version="1.0"?>', "<launch>"]
    for one, name in zip(links, _node_names(links), strict=True):
        words = _attribute(_plain(one))
        lines.append(f'  <node pkg="tf2_ros" exec="{PUBLISHER}" name="{name}" args={words}/>')
    return "\n".join([*lines, "</launch>", ""])


def launch_yaml(links: Sequence[FixedLink]) -> str:
    """Return a YAML launch file with a static_transform_publisher for each transform.

    Raises:
        InputError: If ROS would change a frame name that it reads from such a file.
    """
    lines = ["launch:" if links else "launch: []"]
    for one, name in zip(links, _node_names(links), strict=True):
        lines += [
            "  - node:",
            "      pkg: tf2_ros",
            f"      exec: {PUBLISHER}",
            f"      name: {name}",
            f"      args: {_quoted(_plain(one))}",
        ]
    return "\n".join([*lines, ""])


def _listed(words: Sequence[str]) -> list[str]:
    """Return lines of Python code for a list of options, each line with an option and its value."""
    texts = [_quoted(word) for word in words]
    return [f"{name}, {value}" for name, value in zip(texts[::2], texts[1::2], strict=True)]


def _quoted(text: str) -> str:
    """Return a text in quotes and in ASCII, as Python and YAML read it."""
    # JSON's own escapes write a character beyond U+FFFF as two, which Python and YAML do not join.
    return json.dumps(text, ensure_ascii=False).encode("ascii", "backslashreplace").decode()


def _words(link: FixedLink) -> list[str]:
    return [*publisher_words(link.pose), "--frame-id", link.parent, "--child-frame-id", link.child]


def _whole_name(link: FixedLink) -> FixedLink:
    """Return the link unchanged, after a check of its frame names.

    Raises:
        InputError: If a name contains characters that a launch file or script cannot contain.
    """
    for name in (link.parent, link.child):
        if "\0" in name or _NOT_XML.search(name):
            raise InputError(
                f"The frame name {name!r} has characters that a script or launch file cannot "
                "contain."
            )
    return link


def _plain(link: FixedLink) -> str:
    """Return the options of static_transform_publisher as text without quotes.

    Raises:
        InputError: If ROS would read a frame name as several words or as another value.
    """
    for name in (link.parent, link.child):
        if not _PLAIN_WORD.fullmatch(name):
            raise InputError(
                f"This kind of launch file would change the frame name {name!r}: "
                "write a .launch.py or .sh file."
            )
    return " ".join(_words(_whole_name(link)))


def _node_names(links: Sequence[FixedLink]) -> list[str]:
    names: dict[str, None] = {}
    for one in links:
        plain = name = re.sub(r"[^A-Za-z0-9_]", "_", f"static_{one.parent}_to_{one.child}")
        number = 2
        while name in names:
            name = f"{plain}_{number}"
            number += 1
        names[name] = None
    return list(names)


def _attribute(text: str) -> str:
    if _NOT_XML.search(text):
        raise InputError(f"The frame name {text!r} has characters that XML cannot contain.")
    # A reader would convert a tab or a line end to a space.
    return quoteattr(text, {"\t": "&#9;", "\n": "&#10;", "\r": "&#13;"})


LINK_WRITERS: Final[Mapping[Format, Callable[[Sequence[FixedLink], str], str]]] = MappingProxyType(
    {
        Format.urdf: urdf,
        Format.sh: lambda links, _: shell(links),
        Format.launch_py: lambda links, _: launch_python(links),
        Format.launch_xml: lambda links, _: launch_xml(links),
        Format.launch_yaml: lambda links, _: launch_yaml(links),
    }
)
"""Functions that return a file's text for each format, from the links and the file's name."""
