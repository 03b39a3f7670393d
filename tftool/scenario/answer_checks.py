"""Checks of the answers to a scenario's questions: ranges, poses, exceptions, names.

In the expectation `{distance: {…}, below: 0.5 m}`, `distance` is the question and `below` a key of
the check. A `Form` reads the keys of a check and creates the check. A check compares the answer
with the expected answer, and describes both answers in words.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from tftool.base import errors
from tftool.base.errors import LookupException, TransformException
from tftool.base.plain_text import near_names, visible
from tftool.geometry.conversions import quaternion_from_rpy, rpy_from_quaternion
from tftool.geometry.quaternions import angle_between
from tftool.geometry.rigid import Quaternion, Transform, wrap
from tftool.scenario import document
from tftool.scenario import units as values
from tftool.scenario.document import Node, TextPlace
from tftool.scenario.fields import Key, Reading, listed
from tftool.scenario.units import ANGLE, Unit

NEAR = 1e-6
"""Tolerance of a value if none is given, in metres, radians or other units."""


@dataclass(frozen=True, slots=True)
class Judged:
    """Result of one check: whether the answer is right (`ok`), and the answer as text."""

    ok: bool
    found: str


def _frame_hint(error: TransformException) -> str:
    """Return the hint "did you mean …" in an error about an unknown frame; "" without a hint."""
    remedy = error.remedy if isinstance(error, LookupException) else ""
    return remedy if "did you mean" in remedy else ""


def _in_one_line(error: TransformException) -> str:
    """Return an error's text; tf2's text about a loop has a line for each frame."""
    return " ".join(line for line in str(error).split("\n") if line)


class AnswerCheck(ABC):
    """Base of checks of an answer; `str(check)` describes the expected answer."""

    @abstractmethod
    def judge(self, answer: Any) -> Judged:
        """Compare an answer with the expected answer."""

    def judge_error(self, error: TransformException) -> Judged:
        """Return the check's result for a question that failed with the exception `error`."""
        # Some of tf2's error texts end in ". ", others without it.
        hint = _frame_hint(error)
        text = _in_one_line(error)
        said = f"{text.rstrip(' .')}. {hint}" if hint else text
        return Judged(False, f"{type(error).__name__}: {said}")

    @abstractmethod
    def __str__(self) -> str: ...


Make: TypeAlias = Callable[[Mapping[str, Any], Reading, TextPlace], AnswerCheck]
"""Function that makes a check from the read keys beside a question, or records a mistake."""


@dataclass(frozen=True, slots=True)
class Form:
    """Keys of a kind of check, such as `below` and `above`, and a function to create the check."""

    fields: Mapping[str, Key]
    make: Make


# Numbers.


@dataclass(frozen=True, slots=True)
class RangeCheck(AnswerCheck):
    """Check that a number is below, above, between or near given numbers."""

    unit: Unit
    below: float | None = None
    above: float | None = None
    between: tuple[float, float] | None = None
    equal: float | None = None
    tolerance: float = NEAR

    def judge(self, answer: float) -> Judged:
        """Compare a number with the bounds."""
        ok = True
        if self.below is not None:
            ok = ok and answer < self.below
        if self.above is not None:
            ok = ok and answer > self.above
        if self.between is not None:
            ok = ok and self.between[0] <= answer <= self.between[1]
        if self.equal is not None:
            off = answer - self.equal
            ok = ok and abs(wrap(off) if self.unit is ANGLE else off) <= self.tolerance
        return Judged(ok, self._shown(answer))

    def __str__(self) -> str:
        parts = []
        if self.below is not None:
            parts.append(f"below {self._shown(self.below)}")
        if self.above is not None:
            parts.append(f"above {self._shown(self.above)}")
        if self.between is not None:
            low, high = self.between
            parts.append(f"between {low:g} and {self._shown(high)}")
        if self.equal is not None:
            off = "" if self.tolerance in (0.0, NEAR) else f" ± {self._shown(self.tolerance)}"
            parts.append(f"is {self._shown(self.equal)}{off}")
        return " and ".join(parts)

    def _shown(self, value: float) -> str:
        return f"{value:.6g} {self.unit.name}".rstrip()


def range_form(unit: Unit, default: RangeCheck | None = None, tolerance: float = NEAR) -> Form:
    """Return the form by which a scenario's check of a number is read.

    The form has the keys `below`, `above`, `between`, `is` and `tolerance`. Without any of these
    keys, the check is `default`.
    """
    one = values.quantity(unit)
    fields = {
        "below": Key(one, None),
        "above": Key(one, None),
        "between": Key(values.several(one, "lower and upper bound", 2), None),
        "is": Key(one, None),
        "tolerance": Key(values.quantity(unit, least=0.0), None),
    }

    def make(given: Mapping[str, Any], reading: Reading, place: TextPlace) -> RangeCheck:
        if all(given[key] is None for key in ("below", "above", "between", "is")):
            if default is not None:
                return default
            raise reading.refuse(
                place, "the limit is missing: write below, above, between: [low, high], or is"
            )
        if given["tolerance"] is not None and given["is"] is None:
            raise reading.refuse(place, "'tolerance' is only allowed together with 'is'")
        between = given["between"]
        if between is not None and between[0] > between[1]:
            raise reading.refuse(
                place,
                f"no number is between {between[0]:g} and {between[1]:g}: write the smaller "
                "number first",
            )
        near = tolerance if given["tolerance"] is None else given["tolerance"]
        return RangeCheck(unit, given["below"], given["above"], between, given["is"], near)

    return Form(fields, make)


# Frames and names.


def _nearest(names: Iterable[str], existing: Collection[str]) -> str:
    """Return a hint "; did you mean …" for those `names` that do not exist.

    Args:
        names: Names in the expectation.
        existing: Existing names.

    Returns:
        The hint; "" if all names exist, or no existing name is similar.
    """
    found = [near_names(name, existing) for name in names if name not in existing]
    near = [f"'{similar[0]}'" for similar in found if similar]
    return f"; did you mean {', '.join(near)}?" if near else ""


@dataclass(frozen=True, slots=True)
class FrameFacts:
    """Facts about a frame; parent, static and broadcaster are None for an unknown frame.

    Attributes:
        exists: Whether the frame is known.
        parent: Name of the frame's parent.
        static: Whether the transform to the parent is static.
        broadcaster: Name of the frame's publisher.
        known: Names of all frames.
    """

    exists: bool
    parent: str | None = None
    static: bool | None = None
    broadcaster: str | None = None
    known: Collection[str] = field(default=(), compare=False)


@dataclass(frozen=True, slots=True)
class FrameCheck(AnswerCheck):
    """Check of a frame's expected facts; expected facts that are None are not checked."""

    name: str
    wanted: FrameFacts

    def judge(self, answer: FrameFacts) -> Judged:
        """Compare a frame's facts with the expected facts."""
        if not answer.exists:
            hint = _nearest([self.name], answer.known)
            return Judged(not self.wanted.exists, f"no such frame{hint}")
        ok = self.wanted.exists
        for key in ("parent", "static", "broadcaster"):
            want = getattr(self.wanted, key)
            ok = ok and (want is None or want == getattr(answer, key))
        if answer.parent is None:
            return Judged(ok, "a root")
        kind = "static" if answer.static else "dynamic"
        hint = "" if self.wanted.parent is None else _nearest([self.wanted.parent], answer.known)
        return Judged(ok, f"{kind}, under {answer.parent}, from {answer.broadcaster}{hint}")

    def __str__(self) -> str:
        if not self.wanted.exists:
            return "does not exist"
        parts = []
        if self.wanted.static is not None:
            parts.append("is static" if self.wanted.static else "is dynamic")
        if self.wanted.parent is not None:
            parts.append(f"hangs under {self.wanted.parent}")
        if self.wanted.broadcaster is not None:
            parts.append(f"comes from {self.wanted.broadcaster}")
        return ", ".join(parts) or "exists"


_FRAME_FACTS: Mapping[str, Key] = {
    "exists": Key(values.flag, True),
    "parent": Key(values.frame, None),
    "static": Key(values.flag, None),
    "broadcaster": Key(values.name("a node"), None),
}


def _frame_check(given: Mapping[str, Any], reading: Reading, place: TextPlace) -> FrameCheck:
    facts = FrameFacts(**{key: given[key] for key in _FRAME_FACTS})
    if not facts.exists and facts != FrameFacts(False):
        raise reading.refuse(
            place,
            "with 'exists: false' no other property of the frame is allowed: leave out other keys",
        )
    return FrameCheck(given["name"], facts)


FRAME_FORM = Form(_FRAME_FACTS, _frame_check)


@dataclass(frozen=True, slots=True)
class NamesCheck(AnswerCheck):
    """Check that an answer contains exactly the expected names, in any order."""

    wanted: frozenset[str]

    def judge(self, answer: Iterable[str]) -> Judged:
        """Compare names with the expected names."""
        found = frozenset(answer)
        # Names that matched are no candidates for "did you mean".
        hint = _nearest(sorted(self.wanted - found), found - self.wanted)
        return Judged(found == self.wanted, f"{listed(sorted(found)) or 'none'}{hint}")

    def __str__(self) -> str:
        return f"are {listed(sorted(self.wanted)) or 'none'}"


# The question itself contains the expected answer, so no other key is beside it.
NAMES_FORM = Form({}, lambda given, *_: NamesCheck(frozenset(given["names"])))
COUNT_FORM = Form(
    {},
    lambda given, *_: RangeCheck(values.NUMBER, equal=float(given["count"]), tolerance=0.0),
)


@dataclass(frozen=True, slots=True)
class CleanCheck(AnswerCheck):
    """Check that the doctor has no findings."""

    def judge(self, answer: Iterable[str]) -> Judged:
        """Check that a list of findings is empty."""
        found = list(answer)
        return Judged(not found, "; ".join(found) or "none")

    def __str__(self) -> str:
        return "are none"


CLEAN_FORM = Form({}, lambda *_: CleanCheck())


# Poses.

SHORT = 30
"""Longest value in characters that an error text repeats."""


@dataclass(frozen=True, slots=True)
class Tolerance:
    """Tolerance of a pose: metres for the position, radians for angles."""

    position: float = NEAR
    angle: float = NEAR

    def words(self, *, position: bool, angle: bool) -> str:
        """Return the selected tolerances as text in brackets; leave out default tolerances."""
        parts = []
        if position and self.position != NEAR:
            parts.append(f"{self.position:g} m")
        if angle and self.angle != NEAR:
            parts.append(f"{self.angle:g} rad")
        return f" (± {', '.join(parts)})" if parts else ""


def _tolerance(node: Node, reading: Reading) -> Tolerance:
    """Read a tolerance: a number, or a mapping such as {position: 1 mm, angle: 0.1 deg}."""
    if not isinstance(node, document.Mapping):
        text = node.text.strip() if isinstance(node, document.Scalar) else ""
        for part, unit in (("position", values.LENGTH), ("angle", values.ANGLE)):
            if len(text) <= SHORT and text.endswith(tuple(unit.factors)):
                raise reading.refuse(
                    node,
                    f"a tolerance with a unit must name the quantity: write {{{part}: "
                    f"{visible(text)}}}",
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
    """Check that a lookup fails with an exception of the class `raises` or of its subclasses."""

    raises: str
    says: str | None

    def judge(self, answer: Transform) -> Judged:
        """Return a failed check, because the lookup has an answer."""
        return Judged(False, f"no exception: {_pose_text(answer)}")

    def judge_error(self, error: TransformException) -> Judged:
        """Compare the lookup's exception with the expected exception."""
        ok = isinstance(error, getattr(errors, self.raises))
        ok = ok and (self.says is None or self.says in str(error))
        return Judged(ok, f"{type(error).__name__}: {_in_one_line(error)}")

    def __str__(self) -> str:
        says = f" that says '{self.says}'" if self.says else ""
        return f"raises {self.raises}{says}"


_ANGLES = ("theta", "angular")


@dataclass(frozen=True, slots=True)
class PoseCheck(AnswerCheck):
    """Check of the given parts of a pose, such as x or yaw; parts not given are not checked.

    Attributes:
        wanted: Expected numbers, by the name of the part.
        tolerance: Largest differences.
        rotation: Expected rotation; None for any.
        rotation_words: The expected rotation as text.
        in_angles: Whether the rotation is expected, and shown, as roll, pitch and yaw.
    """

    wanted: Mapping[str, float]
    tolerance: Tolerance
    rotation: Quaternion | None = None
    rotation_words: str = ""
    in_angles: bool = False

    def judge(self, answer: Transform) -> Judged:
        """Compare a pose with the expected parts."""
        ok = self._fits(answer.translation._asdict())
        if self.rotation is not None:
            ok = ok and angle_between(self.rotation, answer.rotation) <= self.tolerance.angle
        return Judged(ok, _pose_text(answer, in_angles=self.in_angles))

    def _fits(self, have: Mapping[str, float]) -> bool:
        off = {key: abs(have[key] - want) for key, want in self.wanted.items()}
        if "theta" in off:
            off["theta"] = abs(wrap(have["theta"] - self.wanted["theta"]))
        return all(
            error <= (self.tolerance.angle if key in _ANGLES else self.tolerance.position)
            for key, error in off.items()
        )

    def __str__(self) -> str:
        parts = [f"{key} {want:.6g}" for key, want in self.wanted.items()]
        turned = self.rotation is not None or any(key in _ANGLES for key in self.wanted)
        moved = any(key not in _ANGLES for key in self.wanted)
        if self.rotation is not None:
            parts.append(self.rotation_words)
        if not parts:
            return "can be looked up"
        return f"is {', '.join(parts)}{self.tolerance.words(position=moved, angle=turned)}"


def _pose_text(pose: Transform, *, in_angles: bool = False) -> str:
    x, y, z = pose.translation
    where = f"x {x:.6g}, y {y:.6g}, z {z:.6g}"
    if in_angles:
        # Adding 0.0 makes 0 of -0.
        roll, pitch, yaw = (angle + 0.0 for angle in rpy_from_quaternion(pose.rotation))
        return f"{where}, roll {roll:.6g}, pitch {pitch:.6g}, yaw {yaw:.6g}"
    qx, qy, qz, qw = pose.rotation
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
    """Read the expected parts of a pose, such as x and yaw.

    Returns:
        Position of the parts in the file; values of the parts, by name.
    """
    return node.place, reading.record(node, _POSE_PARTS, "a value")


def _pose_check(given: Mapping[str, Any], reading: Reading, place: TextPlace) -> AnswerCheck:
    value = given["value"]
    if given["raises"] is not None:
        if value is not None:
            raise reading.refuse(place, "'raises' and 'value' exclude each other: leave one out")
        return RefusalCheck(given["raises"], given["says"])
    if given["says"] is not None:
        raise reading.refuse(place, "'says' is only allowed together with 'raises'")
    if value is None:
        return PoseCheck({}, Tolerance())
    place, parts = value
    rotation, words = _rotation(parts, reading, place)
    wanted = {key: parts[key] for key in ("x", "y", "z") if parts[key] is not None}
    in_angles = rotation is not None and parts["rotation"] is None
    return PoseCheck(wanted, given["tolerance"] or Tolerance(), rotation, words, in_angles)


POSE_FORM = Form(
    {
        "value": Key(_value, None),
        "tolerance": Key(_tolerance, None),
        "raises": Key(values.choice(_REFUSALS, "a transform exception"), None),
        "says": Key(values.text, None),
    },
    _pose_check,
)
"""Form of a pose with a tolerance, or an exception; without keys, any pose is accepted."""


def _rotation(
    parts: Mapping[str, Any], reading: Reading, position: TextPlace
) -> tuple[Quaternion | None, str]:
    """Return (rotation, rotation as text) of an expected pose; (None, "") without a rotation."""
    angles = {key: parts[key] for key in ("roll", "pitch", "yaw") if parts[key] is not None}
    given = parts["rotation"]
    if given is not None:
        if angles:
            raise reading.refuse(
                position,
                "a value has a rotation, and also roll, pitch or yaw: leave one of the two out",
            )
        norm = math.hypot(*given)
        if abs(norm - 1.0) > 1e-3:
            raise reading.refuse(
                position, f"the quaternion of a rotation must have length 1, not {norm:.6g}"
            )
        unit = Quaternion(*(part / norm for part in given))
        return unit, f"rotation ({', '.join(f'{part:.6g}' for part in given)})"
    if not angles:
        return None, ""
    roll, pitch, yaw = (angles.get(key, 0.0) for key in ("roll", "pitch", "yaw"))
    words = ", ".join(f"{key} {angle:.6g}" for key, angle in angles.items())
    return quaternion_from_rpy(roll, pitch, yaw), words


class TurtlePoseCheck(PoseCheck):
    """Check of the given parts of a turtle's published pose, such as x or theta."""

    __slots__ = ()

    def judge(self, answer: Any) -> Judged:
        """Compare a turtle's Pose message with the expected parts."""
        if answer is None:
            return Judged(False, "nothing was published")
        have = {
            "x": answer.x,
            "y": answer.y,
            "theta": answer.theta,
            "linear": answer.linear_velocity,
            "angular": answer.angular_velocity,
        }
        ok = self._fits(have)
        return Judged(ok, ", ".join(f"{key} {value:.6g}" for key, value in have.items()))


_TURTLE_PARTS = {
    "x": Key(values.length, None),
    "y": Key(values.length, None),
    "theta": Key(values.angle, None),
    "linear": Key(values.speed, None),
    "angular": Key(values.turn_rate, None),
}


def _turtle_pose_check(
    given: Mapping[str, Any], reading: Reading, place: TextPlace
) -> TurtlePoseCheck:
    wanted = {key: want for key, want in given["value"].items() if want is not None}
    if not wanted:
        raise reading.refuse(
            place, f"'value' is empty: write at least one of {listed(_TURTLE_PARTS)}"
        )
    return TurtlePoseCheck(wanted, given["tolerance"])


TURTLE_POSE_FORM = Form(
    {
        "value": Key(lambda node, reading: reading.record(node, _TURTLE_PARTS, "a value")),
        "tolerance": Key(_tolerance, Tolerance()),
    },
    _turtle_pose_check,
)
