"""Robot for the page: shapes, joints, and sentences about meshes that cannot be shown."""

import json
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import Any

from tftool.geometry.rigid import Transform
from tftool.recordings.description_frames import prefix_of
from tftool.robots.description import (
    BoxShape,
    CapsuleShape,
    CylinderShape,
    LinkShape,
    MeshShape,
    SphereShape,
    Surface,
)
from tftool.robots.mesh_folders import SHAPES, MeshFolders, MeshRefused
from tftool.robots.robot_model import Robot
from tftool.screens.browser.page_messages import answer
from tftool.screens.terminal.sliders import Positions, slide_range

MOST_SHAPES = 5000
"""Largest number of shapes of one robot that are drawn."""


@dataclass(slots=True)
class ShownRobot:
    """Robot that the page shows.

    Attributes:
        robot: Description of the robot.
        folders: Folders of the robot's meshes.
        mover: Node of this process that moves the joints; None without such a node.
        prefix: Text before the link's name in the name of each frame of the robot.
        rest: Initial joint positions if the page itself moves the joints; None if a node does so.
    """

    robot: Robot
    folders: MeshFolders = field(default_factory=MeshFolders)
    mover: Positions | None = None
    prefix: str = ""
    rest: Mapping[str, float] | None = None

    def place(self, frames: Collection[str]) -> bool:
        """Guess `prefix` from the names of all frames; return whether `prefix` has changed."""
        prefix = prefix_of(self.robot, frames)
        changed = prefix != self.prefix
        self.prefix = prefix
        return changed

    @property
    def missing(self) -> list[str]:
        """Sentences about meshes and textures that are not shown."""
        found: list[str] = json.loads(self.as_text())["missing"]
        return found

    def as_text(self) -> str:
        """Return the JSON message with the shapes, joints and sliders of the robot."""
        missing: list[str] = []
        count = 0
        links = []
        for link in self.robot.links.values():
            shapes = {}
            for kind, given in (("visuals", link.visuals), ("collisions", link.collisions)):
                kept = given[: max(0, MOST_SHAPES - count)]
                count += len(kept)
                shapes[kind] = [self._shape(shape, missing) for shape in kept]
            if shapes["visuals"] or shapes["collisions"]:
                links.append({"frame": self.prefix + link.name, **shapes})
        return json.dumps(
            answer(
                "robot",
                {
                    "name": self.robot.name,
                    "links": links,
                    "joints": [
                        {
                            "name": joint.name,
                            "frame": self.prefix + joint.child,
                            "axis": list(joint.axis),
                            "slides": joint.type == "prismatic",
                        }
                        for joint in self.robot.joints.values()
                        if joint.moves
                    ],
                    "sliders": self._sliders(),
                    "motion": self._motion(),
                    "missing": list(dict.fromkeys(missing)),
                },
            )
        )

    def _sliders(self) -> list[dict[str, Any]]:
        positions = self.rest if self.mover is None else self.mover.positions
        if positions is None:
            return []
        return [
            {
                "name": joint.name,
                "unit": joint.unit,
                "range": list(slide_range(joint)),
                "position": positions[joint.name],
            }
            for joint in self.robot.joints.values()
            if joint.moves and self.robot.leader(joint.name) == joint.name
        ]

    def _motion(self) -> list[dict[str, Any]]:
        """Return the data with which `page/kinematics.js` computes the poses of moved joints."""
        if self.rest is None:
            return []
        told: list[dict[str, Any]] = []
        for joint in self.robot.joints.values():
            if joint.moves:
                leader, factor, offset = self.robot.drive(joint.name)
                told.append(
                    {
                        "frame": self.prefix + joint.child,
                        "turns": joint.type != "prismatic",
                        "origin": _seven(joint.origin),
                        "axis": list(joint.axis),
                        "leader": leader,
                        "factor": factor,
                        "offset": offset,
                    }
                )
        return told

    def _shape(self, shape: LinkShape, missing: list[str]) -> dict[str, Any]:
        return {
            "origin": _seven(shape.origin),
            **self._geometry(shape.geometry, missing),
            **self._surface(shape.material, missing),
        }

    def _geometry(self, geometry: Any, missing: list[str]) -> dict[str, Any]:
        if isinstance(geometry, BoxShape):
            return {"kind": "box", "size": list(geometry.size)}
        if isinstance(geometry, CylinderShape | CapsuleShape):
            kind = "cylinder" if isinstance(geometry, CylinderShape) else "capsule"
            return {"kind": kind, "radius": geometry.radius, "length": geometry.length}
        if isinstance(geometry, SphereShape):
            return {"kind": "sphere", "radius": geometry.radius}
        assert isinstance(geometry, MeshShape)
        try:
            address = self.folders.address(geometry.filename)
            if not geometry.filename.lower().endswith(SHAPES):
                raise MeshRefused(
                    f"'{geometry.filename}' is not a supported mesh ({', '.join(SHAPES)})"
                )
        except MeshRefused as refusal:
            missing.append(str(refusal))
            return {"kind": "missing"}
        return {"kind": "mesh", "address": address, "scale": list(geometry.scale)}

    def _surface(self, surface: Surface | None, missing: list[str]) -> dict[str, Any]:
        if surface is None:
            return {}
        told: dict[str, Any] = {}
        if surface.color is not None:
            told["color"] = list(surface.color)
        if surface.texture:
            try:
                told["texture"] = self.folders.address(surface.texture)
            except MeshRefused as refusal:
                missing.append(str(refusal))
        return told


def _seven(pose: Transform) -> list[float]:
    return [*pose.translation, *pose.rotation]
