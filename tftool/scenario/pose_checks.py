"""What a pose must be, or which refusal stands where one was asked for."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from tftool.base import errors
from tftool.base.errors import TransformException
from tftool.base.escaping import visible
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.planar import wrap
from tftool.geometry.quaternions import angle_between
from tftool.geometry.rigid import Quaternion, Transform
from tftool.scenario import document
from tftool.scenario import units as values
from tftool.scenario.answer_checks import NEAR, AnswerCheck, Form, Judged
from tftool.scenario.document import Node, TextPlace
from tftool.scenario.fields import Key, Reading, listed

SHORT = 30
"""Up to how many characters a value is repeated inside an advice."""


@dataclass(frozen=True, slots=True)
class Tolerance:
    """How far a pose may be off."""

    position: float = NEAR
    angle: float = NEAR

    def words(self, *, position: bool, angle: bool) -> str:
        """What was allowed for, in brackets; nothing where only rounding is."""
        parts = []
        if position and self.position != NEAR:
            parts.append(f"{self.position:g} m")
        if angle and self.angle != NEAR:
            parts.append(f"{self.angle:g} rad")
        return f" (± {', '.join(parts)})" if parts else ""


def _tolerance(node: Node, reading: Reading) -> Tolerance:
    """A number for everything, or a mapping: {position: 1 mm, angle: 0.1 deg}."""
    if not isinstance(node, document.Mapping):
        text = node.text.strip() if isinstance(node, document.Scalar) else ""
        for part, unit in (("position", values.LENGTH), ("angle", values.ANGLE)):
            if len(text) <= SHORT and text.endswith(tuple(unit.factors)):
                raise reading.refuse(
                    node,
                    "one tolerance for metres and radians alike has no unit; "
                    f"write {{{part}: {visible(text)}}}",
                )
        both = values.quantity(values.NUMBER, least=0.0)(node, reading)
        return Tolerance(both, both)
    known = {
        "position": Key(values.quantity(values.LENGTH, least=0.0), NEAR),
        "angle": Key(values.quantity(values.ANGLE, least=0.0), NEAR),
    }
    return Tolerance(**reading.record(node, known, "a tolerance"))


_REFUSALS = tuple(
    sorted(
        name
        for name, kind in vars(errors).items()
        if isinstance(kind, type) and issubclass(kind, TransformException)
    )
)


@dataclass(frozen=True, slots=True)
class RefusalCheck(AnswerCheck):
    """A lookup that must be refused, by an exception of this name or below it."""

    raises: str
    says: str | None

    def judge(self, answer: Transform) -> Judged:
        """Compare an answer."""
        return Judged(False, f"no exception: {_pose_text(answer)}")

    def refused(self, error: TransformException) -> Judged:
        """Compare the refusal."""
        ok = isinstance(error, getattr(errors, self.raises))
        ok = ok and (self.says is None or self.says in str(error))
        return Judged(ok, f"{type(error).__name__}: {error}")

    def __str__(self) -> str:
        says = f" that says '{self.says}'" if self.says else ""
        return f"raises {self.raises}{says}"


@dataclass(frozen=True, slots=True)
class PoseCheck(AnswerCheck):
    """A transform with these parts; what is None is not looked at."""

    x: float | None
    y: float | None
    z: float | None
    rotation: Quaternion | None
    rotation_words: str
    tolerance: Tolerance

    def judge(self, answer: Transform) -> Judged:
        """Compare an answer."""
        wanted = (self.x, self.y, self.z)
        ok = all(
            want is None or abs(want - have) <= self.tolerance.position
            for want, have in zip(wanted, answer.translation, strict=True)
        )
        if self.rotation is not None:
            ok = ok and angle_between(self.rotation, answer.rotation) <= self.tolerance.angle
        return Judged(ok, _pose_text(answer))

    def __str__(self) -> str:
        parts = [
            f"{name} {want:.6g}"
            for name, want in (("x", self.x), ("y", self.y), ("z", self.z))
            if want is not None
        ]
        moved, turned = bool(parts), self.rotation is not None
        if turned:
            parts.append(self.rotation_words)
        if not parts:
            return "can be looked up"
        return f"is {', '.join(parts)}{self.tolerance.words(position=moved, angle=turned)}"


def _pose_text(pose: Transform) -> str:
    x, y, z = pose.translation
    qx, qy, qz, qw = pose.rotation
    where = f"x {x:.6g}, y {y:.6g}, z {z:.6g}"
    return f"{where}, rotation ({qx:.6g}, {qy:.6g}, {qz:.6g}, {qw:.6g})"


_POSE_PARTS = {
    "x": Key(values.length, None),
    "y": Key(values.length, None),
    "z": Key(values.length, None),
    "roll": Key(values.angle, None),
    "pitch": Key(values.angle, None),
    "yaw": Key(values.angle, None),
    "rotation": Key(values.several(values.number, "x, y, z, w", 4), None),
}


def _value(node: Node, reading: Reading) -> tuple[TextPlace, Mapping[str, Any]]:
    """The parts of a pose, and where they stand."""
    return node.place, reading.record(node, _POSE_PARTS, "a value")


class PoseForm(Form):
    """A value with a tolerance, or a refusal; with nothing said, any transform will do."""

    def __init__(self) -> None:
        """Read poses in space."""
        self.fields = {
            "value": Key(_value, None),
            "tolerance": Key(_tolerance, None),
            "raises": Key(values.choice(_REFUSALS, "a transform exception"), None),
            "says": Key(values.text, None),
        }

    def make(self, given: Mapping[str, Any], reading: Reading, place: TextPlace) -> AnswerCheck:
        """Make the check, or note what is wrong."""
        value = given["value"]
        if given["raises"] is not None:
            if value is not None:
                raise reading.refuse(place, "a lookup that raises has no value; keep one of them")
            return RefusalCheck(given["raises"], given["says"])
        if given["says"] is not None:
            raise reading.refuse(place, "'says' goes with 'raises'")
        if value is None:
            return PoseCheck(None, None, None, None, "", Tolerance())
        place, parts = value
        rotation, words = _rotation(parts, reading, place)
        tolerance = given["tolerance"] or Tolerance()
        return PoseCheck(parts["x"], parts["y"], parts["z"], rotation, words, tolerance)


def _rotation(
    parts: Mapping[str, Any], reading: Reading, place: TextPlace
) -> tuple[Quaternion | None, str]:
    """The rotation of a value, and how it was said; angles left out are 0."""
    angles = {key: parts[key] for key in ("roll", "pitch", "yaw") if parts[key] is not None}
    given = parts["rotation"]
    if given is not None:
        if angles:
            raise reading.refuse(place, "a rotation or roll, pitch, yaw: keep one of them")
        norm = math.hypot(*given)
        if abs(norm - 1.0) > 1e-3:
            raise reading.refuse(place, f"a rotation has length 1, not {norm:.6g}")
        unit = Quaternion(*(part / norm for part in given))
        return unit, f"rotation ({', '.join(f'{part:.6g}' for part in given)})"
    if not angles:
        return None, ""
    roll, pitch, yaw = (angles.get(key, 0.0) for key in ("roll", "pitch", "yaw"))
    words = ", ".join(f"{key} {angle:.6g}" for key, angle in angles.items())
    return quaternion_from_rpy(roll, pitch, yaw), words


@dataclass(frozen=True, slots=True)
class TurtlePoseCheck(AnswerCheck):
    """A turtle's published pose with these parts; what is not named is not looked at."""

    wanted: Mapping[str, float]
    tolerance: Tolerance

    def judge(self, answer: Any) -> Judged:
        """Compare an answer."""
        if answer is None:
            return Judged(False, "nothing was published")
        have = {
            "x": answer.x,
            "y": answer.y,
            "theta": answer.theta,
            "linear": answer.linear_velocity,
            "angular": answer.angular_velocity,
        }
        off = {key: abs(have[key] - want) for key, want in self.wanted.items()}
        if "theta" in off:
            off["theta"] = abs(wrap(have["theta"] - self.wanted["theta"]))
        ok = all(
            error <= (self.tolerance.angle if key in _ANGLES else self.tolerance.position)
            for key, error in off.items()
        )
        return Judged(ok, ", ".join(f"{key} {value:.6g}" for key, value in have.items()))

    def __str__(self) -> str:
        parts = ", ".join(f"{key} {want:.6g}" for key, want in self.wanted.items())
        turned = any(key in _ANGLES for key in self.wanted)
        moved = any(key not in _ANGLES for key in self.wanted)
        return f"is {parts}{self.tolerance.words(position=moved, angle=turned)}"


_TURTLE_PARTS = {
    "x": Key(values.length, None),
    "y": Key(values.length, None),
    "theta": Key(values.angle, None),
    "linear": Key(values.speed, None),
    "angular": Key(values.turn_rate, None),
}


_ANGLES = ("theta", "angular")


class TurtlePoseForm(Form):
    """A value with a tolerance."""

    def __init__(self) -> None:
        """Read poses of turtles."""
        self.fields = {
            "value": Key(lambda node, reading: reading.record(node, _TURTLE_PARTS, "a value")),
            "tolerance": Key(_tolerance, Tolerance()),
        }

    def make(self, given: Mapping[str, Any], reading: Reading, place: TextPlace) -> AnswerCheck:
        """Make the check, or note what is wrong."""
        wanted = {key: want for key, want in given["value"].items() if want is not None}
        if not wanted:
            raise reading.refuse(place, f"a value needs one of {listed(_TURTLE_PARTS)}")
        return TurtlePoseCheck(wanted, given["tolerance"])
