"""Parser of rotations and poses pasted as text, in the notations of other programs.

Labels (`x: 0 …`, `rpy="…"`, the words of tf2_echo) or the shape of a matrix identify the notation.
Three or four numbers without labels are ambiguous, and raise an error unless the caller names the
notation.
"""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from tftool.base.errors import UsageError
from tftool.geometry import quaternions
from tftool.geometry.conversions import (
    nearest_rotation,
    quaternion_from_matrix,
    quaternion_from_rpy,
)
from tftool.geometry.notation import static_arguments
from tftool.geometry.notation.notations import FORMS, NAMED_FORMS, NOTATIONS, notation_of
from tftool.geometry.rigid import Quaternion, Transform

LONGEST: Final = 1 << 20
"""Maximum length of a text, characters."""

NOT_SCALED: Final = 1e-3
"""Difference of a quaternion's length from 1 above which a note is printed."""

SLACK: Final = 0.02
"""Maximum difference between a matrix and a rotation, to allow for printed digits."""

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_PI = r"(?:(?:math|np|numpy)\.)?(?:pi\b|PI\b|M_PI\b|π)"
_VALUE = rf"[+-]?(?:{_NUMBER}\s*\*\s*)?{_PI}(?:\s*[*/]\s*{_NUMBER})?|{_NUMBER}(?![\w.])"
_TOKEN = re.compile(
    rf"(?P<pi>(?P<sign>[+-]?)(?:(?P<times>{_NUMBER})\s*\*\s*)?{_PI}(?:\s*(?P<how>[*/])\s*(?P<by>{_NUMBER}))?)"
    rf"|(?P<number>{_NUMBER})"
    r"|(?P<word>[^\W\d][\w.-]*)"
    r"|(?P<other>\S)"
)
_LABELLED = re.compile(
    r"\b(?:(?P<heading>translation|position|origin|rotation|orientation|quaternion)\b"
    r"|(?P<label>q?[xyzw]|roll|pitch|yaw)\b[\"']?\s*[:=]\s*[\"']?"
    rf"(?:\$\{{\s*)?(?P<number>{_VALUE}))",
    re.IGNORECASE,
)
_ATTRIBUTE = r"\b{}\s*=\s*(?:\"([^\"]*)\"|'([^']*)')"
_BRACKETED = r"\s*(?:\((?:xyzw|XYZW)\)\s*)?\[([^\]]*)\]"
_DEGREES = frozenset({"deg", "degs", "degree", "degrees"})
_FILLER = frozenset(
    {
        *("and", "angle", "angles", "array", "axis", "dtype", "euler", "float", "float32"),
        *("float64", "from_quat", "list", "matrix", "np", "np.array", "np.matrix", "numpy"),
        *("order", "quat", "quaternion", "rad", "radian", "radians", "rotation", "q", "r"),
        *("tensor", "torch", "tuple", "vector"),
    }
)
_NAMED: Final = {
    **{form: form for form in FORMS if form != "matrix"},
    **{word: form for form, one in NOTATIONS.items() for word in one.aliases},
}
_PUNCTUATION = frozenset("[](){}<>,;:=|$\"'°*-")


@dataclass(frozen=True, slots=True)
class Written:
    """One transform parsed from a text.

    Attributes:
        transform: The pose, with a quaternion of unit length.
        has_translation: Whether the text contains a translation.
        form: Name of the notation in which the text was written.
        notes: Sentences about unusual features of the text.
    """

    transform: Transform
    has_translation: bool
    form: str
    notes: tuple[str, ...] = ()


def read(text: str, form: str | None = None, *, degrees: bool = False) -> Written:
    """Parse a rotation or a pose from pasted text.

    Args:
        text: The pasted text.
        form: Notation of numbers without labels, one of `FORMS`; None to recognise the notation.
        degrees: Whether angles are in degrees, if the text does not name a unit. Angles of URDF and
            of static_transform_publisher are always radians.

    Raises:
        UsageError: If the text has no known notation, or fits several notations.
    """
    if len(text) > LONGEST:
        raise UsageError(f"The text is longer than {LONGEST} characters: paste only one rotation.")
    if form is not None and form not in FORMS:
        raise UsageError(f"'{form}' is not a notation of a rotation: use {_listed()}.")
    for reader in (_publisher, _echoed, _described, _labelled):
        found = reader(text, degrees) if form is None else None
        if found is not None:
            return found
    return _bare(text, form, degrees)


def _listed() -> str:
    return f"{', '.join(NAMED_FORMS)}, or an order of axes such as sxyz or rzyx"


# Texts with labels


def _publisher(text: str, _degrees: bool) -> Written | None:
    """Parse a static_transform_publisher command of ROS 2 or ROS 1; None for other text."""
    if "static_transform_publisher" not in text and not re.search(
        r"(?<!\S)--(q?[xyz]|qw|roll|pitch|yaw|(child-)?frame-id)(?=[\s=])", text
    ):
        return None
    said = static_arguments.of_line(text, frames=("parent", "child"))
    if said is None:
        raise UsageError(
            "The line contains --help of static_transform_publisher, not numbers: leave --help out."
        )
    written = _quaternion(said.transform.rotation, "static_transform_publisher's words")
    pose = Transform(said.transform.translation, written.transform.rotation)
    return Written(pose, True, written.form, written.notes)


def _echoed(text: str, _degrees: bool) -> Written | None:
    """Parse a block printed by tf2_echo or ROS 1's tf_echo; None for other text."""
    turn = re.search(rf"Rotation:\s*in Quaternion{_BRACKETED}", text)
    if turn is None:
        return None
    quaternion = _numbers(turn[1], 4, "tf2_echo's quaternion")
    place = re.search(rf"Translation:{_BRACKETED}", text)
    translation = _numbers(place[1], 3, "tf2_echo's translation") if place else (0.0, 0.0, 0.0)
    written = _quaternion(quaternion, "tf2_echo's block")
    pose = Transform(translation, written.transform.rotation)
    return Written(pose, place is not None, written.form, written.notes)


def _described(text: str, _degrees: bool) -> Written | None:
    """Parse the attributes xyz and rpy of URDF's or SDF's `<origin>`; None for other text."""
    turn = re.search(_ATTRIBUTE.format("rpy"), text)
    place = re.search(_ATTRIBUTE.format("xyz"), text)
    if turn is None and (place is None or "<origin" not in text):
        return None
    angles = (0.0, 0.0, 0.0)
    if turn is not None:
        in_degrees = re.search(r"degrees\s*=\s*[\"']true", text) is not None  # SDF
        angles = _angles(_numbers(turn[1] or turn[2] or "", 3, "rpy"), in_degrees)
    translation = _numbers(place[1] or place[2] or "", 3, "xyz") if place else (0.0, 0.0, 0.0)
    pose = Transform(translation, quaternion_from_rpy(*angles))
    return Written(pose, place is not None, "a URDF origin")


def _labelled(text: str, degrees: bool) -> Written | None:
    """Parse named numbers in YAML, JSON or a printed Python message; None for other text."""
    groups: list[dict[str, float]] = [{}]
    for match in _LABELLED.finditer(text):
        if match["heading"]:
            groups.append({})
            continue
        label, number = match["label"].lower().removeprefix("q"), _value(match["number"])
        if match["label"].lower().startswith("q") and "w" not in groups[-1]:
            # --x --y --z and qx qy qz qw in one group
            if groups[-1].keys() & {"x", "y", "z"} and "q" not in groups[-1]:
                groups.append({})
            groups[-1]["q"] = 1.0
        if label in groups[-1]:
            groups.append({})
        groups[-1][label] = number
    turns = [one for one in groups if {"x", "y", "z", "w"} <= one.keys()]
    angles = [one for one in groups if one.keys() & {"roll", "pitch", "yaw"}]
    places = [
        one for one in groups if {"x", "y", "z"} <= one.keys() and not one.keys() & {"w", "q"}
    ]
    if not turns and not angles:
        return None
    translation = tuple(places[0][axis] for axis in "xyz") if places else (0.0, 0.0, 0.0)
    if turns:
        written = _quaternion([turns[0][axis] for axis in "xyzw"], "labelled x y z w")
    else:
        given = [angles[0].get(name, 0.0) for name in ("roll", "pitch", "yaw")]
        turn = quaternion_from_rpy(*_angles(given, degrees or _says_degrees(text)))
        written = Written(Transform(rotation=turn), False, "labelled roll pitch yaw")
    notes = written.notes
    if max(len(turns), len(angles)) > 1:
        notes = (
            *notes,
            f"The text has {max(len(turns), len(angles))} rotations: this is the first.",
        )
    pose = Transform(translation, written.transform.rotation)
    return Written(pose, bool(places), written.form, notes)


def _says_degrees(text: str) -> bool:
    return "°" in text or any(word in _DEGREES for word in re.findall(r"[a-z]+", text.lower()))


# Numbers without labels


def _bare(text: str, form: str | None, degrees: bool) -> Written:
    """Parse numbers without labels, in any brackets: a matrix, or the notation `form`."""
    numbers: list[float] = []
    in_radians: set[int] = set()
    named = None
    for match in _TOKEN.finditer(text):
        word = match["word"]
        if match["pi"]:
            in_radians.add(len(numbers))
            numbers.append(_of_pi(match))
        elif match["number"]:
            numbers.append(float(match["number"]))
        elif word and word.lower() in _NAMED:
            named = named or _NAMED[word.lower()]
        elif word and word.lower() in _DEGREES:
            degrees = True
        elif word and word.lower() not in _FILLER:
            raise UsageError(f"The text has '{word[:60]}', which is not part of a rotation.")
        elif match["other"] and match["other"] not in _PUNCTUATION:
            raise UsageError(f"The text has '{match['other']}', which is not part of a rotation.")
    degrees = degrees or "°" in text
    if degrees:
        # A multiple of π is in radians, also among degrees.
        numbers = [math.degrees(n) if k in in_radians else n for k, n in enumerate(numbers)]
    if not all(map(math.isfinite, numbers)):
        raise UsageError("The text contains a number that is too large for a float.")
    form = form or named
    count = len(numbers)
    if not count:
        raise UsageError("The text contains no number: paste a rotation, or a pose.")
    if count in (9, 12, 16) and form in (None, "matrix"):
        return _matrix(numbers)
    if form is None:
        raise _ambiguous(count)
    wanted = 9 if form == "matrix" else notation_of(form).count
    if count != wanted:
        raise UsageError(f"The notation {form} needs {wanted} numbers, but there are {count}.")
    return _of_form(form, numbers, degrees)


def _ambiguous(count: int) -> UsageError:
    """Return the error for `count` bare numbers, which fit several notations or none."""
    if count == 4:
        return UsageError(
            "Four bare numbers can be x y z w or w x y z: choose with --as xyzw or --as wxyz."
        )
    if count == 3:
        return UsageError(
            "Three bare numbers can be angles or a rotation vector: choose with --as rpy, "
            "--as ypr, --as rotvec, or an order of axes such as --as szyx."
        )
    given = "1 number is" if count == 1 else f"{count} numbers are"
    return UsageError(
        f"{given} not a rotation: give 4 numbers for a quaternion, 3 for angles, 9 or 16 for a "
        "matrix."
    )


def _value(text: str) -> float:
    match = _TOKEN.fullmatch(text)
    assert match is not None
    return _of_pi(match) if match["pi"] else float(text)


def _of_pi(match: "re.Match[str]") -> float:
    value = math.pi * float(match["times"] or 1.0)
    if match["by"]:
        by = float(match["by"])
        if match["how"] == "/" and by == 0.0:
            raise UsageError(f"The text has '{match[0]}', which divides by zero.")
        value = value / by if match["how"] == "/" else value * by
    return -value if match["sign"] == "-" else value


def _of_form(form: str, numbers: Sequence[float], degrees: bool) -> Written:
    notation = notation_of(form)
    name = notation.read_as or notation.title
    if notation.is_quaternion:
        return _quaternion(notation.read(numbers), name)
    in_radians = notation.scaled(numbers, math.radians) if degrees else numbers
    try:
        turn = Quaternion(*notation.read(in_radians))
    except ValueError as error:
        raise UsageError(f"{error}.") from None
    notes = _beyond(numbers, degrees) if notation.wraps else ()
    unit = "degrees" if degrees else "radians"
    return Written(Transform(rotation=turn), False, f"{name}, {unit}", notes)


def _beyond(numbers: Sequence[float], degrees: bool) -> tuple[str, ...]:
    beyond = [number for number in numbers if abs(number) > 2.0 * math.pi]
    if degrees or not beyond:
        return ()
    return (f"{beyond[0]:g} radians are more than a full turn: for degrees add --degrees.",)


def _quaternion(numbers: Sequence[float], form: str) -> Written:
    x, y, z, w = numbers
    length = math.hypot(x, y, z, w)
    turn = quaternions.unit((x, y, z, w))
    if math.isnan(turn[0]):
        raise UsageError(static_arguments.NO_ROTATION)
    notes: tuple[str, ...] = ()
    if abs(length - 1.0) > NOT_SCALED:
        notes = (f"The quaternion has length {length:.6g}, and was scaled to 1.",)
    return Written(Transform(rotation=turn), False, form, notes)


def _matrix(numbers: Sequence[float]) -> Written:
    count = len(numbers)
    width = 3 if count == 9 else 4
    rows = [tuple(numbers[start : start + width]) for start in range(0, count, width)]
    translation = tuple(row[3] for row in rows[:3]) if width == 4 else (0.0, 0.0, 0.0)
    if count == 16 and max(abs(a - b) for a, b in zip(rows[3], (0, 0, 0, 1), strict=True)) > 1e-6:
        hint = (
            "; transpose the matrix if it is written column by column" if any(rows[3][:3]) else ""
        )
        raise UsageError(
            "The last row of a 4×4 matrix must be 0 0 0 1, not "
            f"{' '.join(f'{n:g}' for n in rows[3])}{hint}."
        )
    near, apart = nearest_rotation([row[:3] for row in rows[:3]])
    if not apart < SLACK:
        raise UsageError(
            "The matrix is not a rotation: its rows are not perpendicular unit vectors, "
            "or the matrix mirrors."
        )
    notes: tuple[str, ...] = ()
    if apart > 1e-6:
        notes = (
            f"The matrix differs from a rotation by {apart:.2g}, probably by rounding: the nearest "
            "rotation is used.",
        )
    turn = quaternion_from_matrix(near)
    name = f"{len(rows)}×{width} matrix"
    return Written(Transform(translation, turn), width == 4, name, notes)


def _angles(numbers: Sequence[float], degrees: bool) -> tuple[float, float, float]:
    x, y, z = (math.radians(number) if degrees else number for number in numbers)
    return x, y, z


def _numbers(text: str, count: int, what: str) -> tuple[float, ...]:
    words = [word.strip("\"'") for word in re.split(r"[\s,;]+", text) if word]
    found = []
    for word in words:
        bare = word.removeprefix("${").removesuffix("}")
        if not re.fullmatch(_VALUE, bare):
            raise UsageError(f"{what} has '{word[:60]}' instead of a number.")
        found.append(_value(bare))
    if len(found) != count or not all(map(math.isfinite, found)):
        raise UsageError(f"{what} needs {count} finite numbers, but there are {len(found)}.")
    return tuple(found)
