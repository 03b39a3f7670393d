"""Parser of robot descriptions in URDF, which reports all mistakes with line and column.

The rules are those of `urdfdom`, ROS's own reader. Namespaces and unknown elements are ignored. A
missing origin is zero, and a missing axis is the x axis. The angles rpy rotate about fixed axes. In
addition, this parser refuses a document type (it could expand without bound), numbers that are not
finite, and an axis of length zero on a movable joint.
"""

import contextlib
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import NoReturn, TypeVar
from xml.parsers import expat

from tftool.base.errors import DescriptionError, InputError, Mistake, UsageError
from tftool.base.named_files import read_named
from tftool.base.plain_text import did_you_mean, near_names
from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.rigid import Transform, Vector3
from tftool.robots.description import (
    JOINT_TYPES,
    LIMITED_TYPES,
    BoxShape,
    CapsuleShape,
    CylinderShape,
    JointLimit,
    JointMimic,
    LinkShape,
    MeshShape,
    RobotDescription,
    RobotJoint,
    RobotLink,
    ShapeGeometry,
    SphereShape,
    Surface,
)
from tftool.robots.xacro_process import expand

T = TypeVar("T")

LARGEST = 64 * 1024 * 1024
"""Maximum size of a description, bytes."""

RADIANS = "URDF uses radians, and 90 degrees are 1.5708"

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
_DECLARATION = re.compile(r"\s*<\?xml\b[^<>]*>")


def load_description(
    path: str | Path, arguments: Mapping[str, str] | None = None, *, plain: bool = False
) -> RobotDescription:
    """Read a URDF file; expand xacro if the file contains xacro and its name ends in .xacro.

    Args:
        path: The file.
        arguments: Values of xacro arguments by name. A xacro file can evaluate Python
            expressions: do not expand files from strangers.
        plain: Whether to raise an error for a file that contains xacro, instead of expanding it.

    Raises:
        InputError: If the file cannot be read, or contains xacro that must not be expanded.
        DescriptionError: If the description has mistakes; the error lists all mistakes with line
            and column.
        UsageError: If the file contains xacro and the extra `xacro` is not installed, or if
            arguments are given to a file without xacro.
    """
    text = _text_of(Path(path))
    if is_xacro(text):
        if plain:
            raise InputError(
                f"'{path}' contains xacro, which scenarios do not expand: expand the file first "
                "(xacro FILE -o robot.urdf)"
            )
        if Path(path).suffix != ".xacro":
            raise InputError(
                f"'{path}' contains xacro, which may run Python, and its name does not end in "
                ".xacro: rename the file, or expand the file first (xacro FILE -o robot.urdf)"
            )
        expanded, notes = expand(Path(path), arguments or {})
        description = parse_description(expanded, f"{path} (expanded)")
        return replace(description, notes=(*notes, *description.notes))
    if arguments:
        given = ", ".join(f"{name}:={value}" for name, value in arguments.items())
        raise UsageError(f"'{path}' contains no xacro, so it has no arguments: leave out {given}")
    return parse_description(text, str(path))


def expand_xacro(path: str | Path, arguments: Mapping[str, str] | None = None) -> str:
    """Return the text of a description after expansion of xacro; text without xacro is unchanged.

    Raises:
        InputError: If the file cannot be read or expanded.
        UsageError: If the extra `xacro` is not installed.
    """
    text = _text_of(Path(path))
    return expand(Path(path), arguments or {})[0] if is_xacro(text) else text


def is_xacro(text: str) -> bool:
    """Whether a description contains xacro that must be expanded.

    The namespace of xacro alone proves nothing, because expanded files keep its declaration. So the
    file must have elements of that namespace, or an attribute with `${…}` or `$(…)`.
    """
    parser = expat.ParserCreate("utf-8")
    found = False

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal found
        found |= tag.startswith("xacro:") or any(
            "${" in value or "$(" in value for value in attributes.values()
        )

    parser.StartElementHandler = start
    try:
        parser.StartDoctypeDeclHandler = _refuse_doctype
        parser.Parse(_without_declaration(text).encode("utf-8", "surrogatepass"), True)
    except (expat.ExpatError, _Doctype):
        return False  # the parser reports the mistake with its position
    return found


def _without_declaration(text: str) -> str:
    """Return a text with blanks in place of its XML declaration, which names an outdated encoding.

    Like other readers, accept a declaration after an empty line, or with a misspelt word.
    """
    found = _DECLARATION.match(text)
    if found is None:
        return text
    return re.sub(r"[^\s]", " ", found.group()) + text[found.end() :]


class UnexpandedXacro(InputError):
    """Error for a URDF that contains xacro elements, which tftool does not execute."""


def parse_description(text: str, name: str = "robot_description") -> RobotDescription:
    """Parse the text of a URDF.

    Args:
        text: The whole text.
        name: Name of the description in messages, usually its path.

    Raises:
        DescriptionError: If the description has mistakes; the error lists all mistakes with line
            and column.
        UnexpandedXacro: If the text has elements of xacro, which the publisher of the text must
            expand.
    """
    if "<xacro:" in text and is_xacro(text):
        raise UnexpandedXacro(
            f"'{name}' still has elements of xacro: expand the original file first "
            "(xacro FILE -o robot.urdf)"
        )
    return _Reader(text, name).read()


def _text_of(path: Path) -> str:
    try:
        size = path.stat().st_size
        if size > LARGEST:
            raise InputError(f"'{path}' has {size:,} bytes, but the limit is {LARGEST:,}")
        raw = read_named(path)
    except OSError as error:
        raise InputError(f"cannot read '{path}': {error.strerror or error}") from error
    declared = re.match(rb"""\s*<\?xml[^>]*encoding=["']([\w.-]+)["']""", raw)
    encoding = declared.group(1).decode("ascii") if declared else "utf-8-sig"
    try:
        # Python's codecs such as "hex" are not text encodings.
        return raw.decode("utf-8-sig" if encoding.lower() in ("utf-8", "utf8") else encoding)
    except LookupError as error:
        raise InputError(
            f"'{path}' declares the encoding '{encoding}', which is unknown: save the file as UTF-8"
        ) from error
    except ValueError as error:
        raise InputError(f"'{path}' is not text in {encoding}: {error}") from error


@dataclass(slots=True)
class _Element:
    """An XML element and its position (line and column from 0)."""

    tag: str
    attributes: dict[str, str]
    line: int
    column: int
    children: list["_Element"] = field(default_factory=list)

    def all(self, tag: str) -> Iterator["_Element"]:
        return (child for child in self.children if child.tag == tag)

    def first(self, tag: str) -> "_Element | None":
        return next(self.all(tag), None)


class _Unreadable(Exception):
    """Exception for an unreadable part of the description, whose mistake is already recorded."""


class _Reader:
    """Reader of one description, which collects mistakes and builds the description's values."""

    def __init__(self, text: str, name: str) -> None:
        self.text = text
        self.name = name
        self.lines = text.split("\n")
        self.mistakes: list[Mistake] = []
        self.tolerated: list[Mistake] = []

    def read(self) -> RobotDescription:
        robot = self._parsed()
        if robot.tag != "robot":
            self._give_up(robot, f"the root element is <{robot.tag}>, but must be <robot>")
        name = robot.attributes.get("name", "")
        if "name" not in robot.attributes:
            self._note(robot, "the robot has no name")
        materials = self._materials(robot)
        links: dict[str, RobotLink] = {}
        listed = list(robot.all("link"))
        for element in listed:
            # urdfdom reads a link named "", and simulators publish a robot of only that one.
            nameless = len(listed) == 1 and element.attributes.get("name") == ""
            self._add(element, "link", links, self._link(element, materials, nameless))
        joints: dict[str, RobotJoint] = {}
        places: dict[str, _Element] = {}
        for element in robot.all("joint"):
            joint = self._joint(element)
            if joint is not None and self._add(element, "joint", joints, joint):
                places[joint.name] = element
        if not links:
            self._note(robot, "there is no link")
        root = self._tree(robot, links, joints, places)
        self._mimics(joints, places)
        if self.mistakes:
            ordered = sorted(self.mistakes, key=lambda one: (one.line, one.column))
            raise DescriptionError(self.name, ordered)
        tolerated = sorted(self.tolerated, key=lambda one: (one.line, one.column))
        notes = [f"{one.file}:{one.line}:{one.column}: {one.text}" for one in tolerated]
        mistakes = tuple(notes)
        loose = [joint.child for joint in joints.values() if joint.type == "floating"]
        if loose:
            shown = ", ".join(loose[:3]) + (" …" if len(loose) > 3 else "")
            notes.append(
                "floating joints are left out, as by robot_state_publisher, so these links have no "
                f"pose in their parents: {shown}"
            )
        return RobotDescription(name, root, links, joints, tuple(notes), mistakes, self.text)

    # XML

    def _parsed(self) -> _Element:
        parser = expat.ParserCreate("utf-8")
        roots: list[_Element] = []
        stack: list[_Element] = []

        def start(tag: str, attributes: dict[str, str]) -> None:
            line, column = parser.CurrentLineNumber - 1, parser.CurrentColumnNumber
            element = _Element(tag, attributes, line, column)
            (stack[-1].children if stack else roots).append(element)
            stack.append(element)

        def end(_tag: str) -> None:
            stack.pop()

        parser.StartElementHandler = start
        parser.EndElementHandler = end
        parser.StartDoctypeDeclHandler = _refuse_doctype
        try:
            # The parser was created for UTF-8, so a declared encoding must not be used.
            plain = _without_declaration(self.text)
            parser.Parse(plain.encode("utf-8", "surrogatepass"), True)
        except _Doctype:
            line, column = parser.CurrentLineNumber - 1, parser.CurrentColumnNumber
            self._refuse(line, column, "<!DOCTYPE is not allowed: remove it")
        except expat.ExpatError as error:
            said = expat.ErrorString(error.code) or "the parser gives no reason"
            self._refuse(error.lineno - 1, error.offset, f"this is not XML: {said}")
        return roots[0]

    def _note(self, element: _Element, text: str, attribute: str = "") -> None:
        """Add a mistake, after which the description is refused."""
        self.mistakes.append(self._mistake(element, text, attribute))

    def _tolerate(self, element: _Element, text: str, attribute: str = "") -> None:
        """Add a mistake with which the description is read all the same."""
        self.tolerated.append(self._mistake(element, text, attribute))

    def _mistake(self, element: _Element, text: str, attribute: str) -> Mistake:
        line, column, width = element.line, element.column, len(element.tag) + 1
        if attribute:
            line, column, width = self._attribute(element, attribute)
        return Mistake.at(self.name, self.lines, line, column, text, width=width)

    @contextlib.contextmanager
    def _left_out(self) -> Iterator[None]:
        """Tolerate mistakes in a `with` block, because the block's data affects no frame.

        ROS's reader continues after mistakes in a link's appearance or mass, so robots run with
        such files.
        """
        before, self.mistakes = self.mistakes, []
        try:
            with contextlib.suppress(_Unreadable):
                yield
        finally:
            self.tolerated += [replace(one, text=f"{one.text}; left out") for one in self.mistakes]
            self.mistakes = before

    def _attribute(self, element: _Element, attribute: str) -> tuple[int, int, int]:
        """Return line, column and width of an attribute; of the tag if the attribute is missing."""
        wanted = re.compile(rf"(?<![\w:]){re.escape(attribute)}\s*=\s*(\"[^\"]*\"|'[^']*')")
        column = element.column
        for line in range(element.line, min(element.line + 20, len(self.lines))):
            found = wanted.search(self.lines[line], column)
            if found:
                return line, found.start(), found.end() - found.start()
            if ">" in self.lines[line][column:]:
                break
            column = 0
        return element.line, element.column, len(element.tag) + 1

    def _refuse(self, line: int, column: int, text: str) -> NoReturn:
        self.mistakes.append(Mistake.at(self.name, self.lines, line, column, text))
        raise DescriptionError(self.name, self.mistakes) from None

    def _give_up(self, element: _Element, text: str) -> NoReturn:
        self._note(element, text)
        raise DescriptionError(self.name, self.mistakes)

    # Values

    def _word(self, element: _Element, attribute: str) -> str:
        word = element.attributes.get(attribute)
        if not word:
            self._note(element, f"<{element.tag}> has no {attribute}")
            raise _Unreadable
        return word

    def _numbers(
        self, element: _Element, attribute: str, count: int, default: str | None = None
    ) -> tuple[float, ...]:
        text = element.attributes.get(attribute, default)
        if text is None:
            self._note(element, f"<{element.tag}> has no {attribute}")
            raise _Unreadable
        words = text.split()
        numbers = []
        for word in words:
            if not _NUMBER.fullmatch(word) or not math.isfinite(float(word)):
                self._note(element, f"'{word[:40]}' is not a finite number", attribute)
                raise _Unreadable
            numbers.append(float(word))
        if len(numbers) != count:
            wanted = "one number" if count == 1 else f"{count} numbers"
            self._note(element, f"{attribute} must be {wanted}, not {len(numbers)}", attribute)
            raise _Unreadable
        return tuple(numbers)

    def _number(self, element: _Element, attribute: str, default: str | None = None) -> float:
        return self._numbers(element, attribute, 1, default)[0]

    def _origin(self, element: _Element) -> Transform:
        origin = element.first("origin")
        if origin is None:
            return Transform()
        xyz = self._numbers(origin, "xyz", 3, "0 0 0")
        roll, pitch, yaw = self._numbers(origin, "rpy", 3, "0 0 0")
        if max(map(abs, (roll, pitch, yaw))) > math.tau:
            self._tolerate(
                origin,
                f"rpy {roll:g} {pitch:g} {yaw:g} is more than a whole turn: {RADIANS}",
                "rpy",
            )
        return Transform(xyz, quaternion_from_rpy(roll, pitch, yaw))

    def _add(self, element: _Element, what: str, held: dict[str, T], new: T | None) -> bool:
        if new is None:
            return False
        name = element.attributes["name"]
        if name in held:
            self._note(element, f"there is a {what} named '{name}' already", "name")
            return False
        held[name] = new
        return True

    # Links

    def _materials(self, robot: _Element) -> dict[str, Surface]:
        found: dict[str, Surface] = {}
        for element in robot.all("material"):
            if element.attributes.get("name", "") in found:
                name = element.attributes.get("name", "")
                self._note(element, f"there is a material named '{name}' already", "name")
                continue
            with self._left_out():
                material = self._material(element)
                found[material.name] = material
        return found

    def _material(self, element: _Element) -> Surface:
        color = element.first("color")
        rgba = self._numbers(color, "rgba", 4) if color is not None else None
        texture = element.first("texture")
        return Surface(
            element.attributes.get("name", ""),
            (rgba[0], rgba[1], rgba[2], rgba[3]) if rgba else None,
            texture.attributes.get("filename", "") if texture is not None else "",
        )

    def _link(
        self, element: _Element, materials: Mapping[str, Surface], nameless: bool
    ) -> RobotLink | None:
        try:
            name = "" if nameless else self._word(element, "name")
        except _Unreadable:
            return None
        visuals = self._shapes(element, "visual", materials)
        collisions = self._shapes(element, "collision", {})
        mass = None
        inertial = element.first("inertial")
        if inertial is not None:
            with self._left_out():
                mass = self._mass(inertial)
        return RobotLink(name, visuals, collisions, mass)

    def _mass(self, inertial: _Element) -> float:
        self._origin(inertial)
        mass, inertia = inertial.first("mass"), inertial.first("inertia")
        for part, tag in ((mass, "mass"), (inertia, "inertia")):
            if part is None:
                self._note(inertial, f"<inertial> has no <{tag}>")
                raise _Unreadable
        assert mass is not None
        assert inertia is not None
        for moment in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"):
            self._number(inertia, moment)
        return self._number(mass, "value")

    def _shapes(
        self, link: _Element, tag: str, materials: Mapping[str, Surface]
    ) -> tuple[LinkShape, ...]:
        shapes = []
        for element in link.all(tag):
            with self._left_out():
                shapes.append(self._shape(element, materials))
        return tuple(shapes)

    def _shape(self, element: _Element, materials: Mapping[str, Surface]) -> LinkShape:
        origin = self._origin(element)
        geometry = element.first("geometry")
        if geometry is None:
            self._note(element, f"<{element.tag}> has no <geometry>")
            raise _Unreadable
        named = element.first("material")
        material = None
        if named is not None:
            with self._left_out():
                material = self._material(named)
            if material is not None and material.color is None and not material.texture:
                material = materials.get(material.name, material)
        name = element.attributes.get("name", "")
        return LinkShape(name, origin, self._geometry(geometry), material)

    def _geometry(self, geometry: _Element) -> ShapeGeometry:
        for element in geometry.children:
            match element.tag:
                case "box":
                    return BoxShape(Vector3(*self._numbers(element, "size", 3)))
                case "cylinder":
                    return CylinderShape(
                        self._number(element, "radius"), self._number(element, "length")
                    )
                case "capsule":
                    return CapsuleShape(
                        self._number(element, "radius"), self._number(element, "length")
                    )
                case "sphere":
                    return SphereShape(self._number(element, "radius"))
                case "mesh":
                    scale = self._numbers(element, "scale", 3, "1 1 1")
                    return MeshShape(self._word(element, "filename"), Vector3(*scale))
        kinds = "a box, cylinder, sphere, capsule or mesh"
        there = f"<{geometry.children[0].tag}>" if geometry.children else "nothing"
        self._note(geometry, f"<geometry> holds {kinds}, not {there}")
        raise _Unreadable

    # Joints

    def _joint(self, element: _Element) -> RobotJoint | None:
        try:
            name = self._word(element, "name")
            kind = self._word(element, "type")
            if kind not in JOINT_TYPES:
                near = near_names(kind, JOINT_TYPES)
                hint = f"did you mean '{near[0]}'?" if near else f"use one of {_list(JOINT_TYPES)}"
                self._note(element, f"'{kind[:40]}' is not a type of joint; {hint}", "type")
                raise _Unreadable
            ends = []
            for tag in ("parent", "child"):
                end = element.first(tag)
                if end is None:
                    self._note(element, f"joint '{name}' has no <{tag} link=…>")
                    raise _Unreadable
                ends.append(self._word(end, "link"))
            return RobotJoint(
                name,
                kind,
                ends[0],
                ends[1],
                self._origin(element),
                self._axis(element, kind),
                self._limit(element, name, kind),
                self._mimic(element),
            )
        except _Unreadable:
            return None

    def _axis(self, joint: _Element, kind: str) -> Vector3:
        element = joint.first("axis")
        if element is None or kind in ("fixed", "floating"):
            return Vector3(1.0, 0.0, 0.0)
        x, y, z = self._numbers(element, "xyz", 3, "1 0 0")
        length = math.hypot(x, y, z)
        if length == 0.0:
            self._note(element, "the axis of a movable joint must not be zero", "xyz")
            raise _Unreadable
        return Vector3(x / length, y / length, z / length)

    def _limit(self, joint: _Element, name: str, kind: str) -> JointLimit | None:
        element = joint.first("limit")
        if element is None:
            if kind in LIMITED_TYPES:
                self._note(joint, f"{kind} joint '{name}' needs a <limit effort=… velocity=…>")
            return None
        lower, upper = self._number(element, "lower", "0"), self._number(element, "upper", "0")
        if kind in LIMITED_TYPES and lower > upper:
            self._tolerate(
                element,
                f"joint '{name}' has no valid position: its lower limit, {lower:g}, is above its "
                f"upper limit, {upper:g}",
                "lower",
            )
        if kind == "revolute" and (
            in_degrees := [one for one in (lower, upper) if _is_degrees(one)]
        ):
            self._tolerate(
                element,
                f"the limit {in_degrees[0]:g} of joint '{name}' is "
                f"{abs(in_degrees[0]) / math.tau:.0f} turns: {RADIANS}",
                "upper" if in_degrees[0] == upper else "lower",
            )
        return JointLimit(
            lower,
            upper,
            self._number(element, "effort"),
            self._number(element, "velocity"),
        )

    def _mimic(self, joint: _Element) -> JointMimic | None:
        element = joint.first("mimic")
        if element is None:
            return None
        return JointMimic(
            self._word(element, "joint"),
            self._number(element, "multiplier", "1"),
            self._number(element, "offset", "0"),
        )

    # The tree

    def _tree(
        self,
        robot: _Element,
        links: Mapping[str, RobotLink],
        joints: Mapping[str, RobotJoint],
        places: Mapping[str, _Element],
    ) -> str:
        joint_above: dict[str, RobotJoint] = {}
        for joint in joints.values():
            place = places[joint.name]
            for tag, link in (("parent", joint.parent), ("child", joint.child)):
                if link not in links:
                    self._unknown_link(place, joint, tag, link, links)
            if joint.child in joint_above:
                other = joint_above[joint.child].name
                self._note(
                    _end(place, "child"),
                    f"link '{joint.child}' has two parents: "
                    f"it is the child of joint '{other}' already",
                    "link",
                )
            else:
                joint_above[joint.child] = joint
        for loop in _loops(joint_above):
            way = " → ".join([*(joint.parent for joint in loop), loop[0].parent])
            self._note(places[loop[0].name], f"the links form a loop: {way}")
        roots = [name for name in links if name not in joint_above]
        # Only if every joint was read, several roots are a mistake: an unread one joins two trees.
        every_joint_read = len(joints) == sum(1 for _ in robot.all("joint"))
        if len(roots) > 1 and every_joint_read:
            shown = _list([f"'{root}'" for root in roots[:10]])
            more = f" and {len(roots) - 10} more" if len(roots) > 10 else ""
            self._note(
                robot,
                f"{len(roots)} links have no parent, but a robot has one root: {shown}{more}; "
                "connect these links by fixed joints",
            )
        elif not roots and links and not self.mistakes:
            self._note(robot, "every link has a parent, so there is no root")
        return roots[0] if roots else ""

    def _unknown_link(
        self, place: _Element, joint: RobotJoint, tag: str, link: str, links: Iterable[str]
    ) -> None:
        hint = did_you_mean(link, links)
        self._note(
            _end(place, tag),
            f"joint '{joint.name}' has the {tag} '{link[:100]}', but there is no such link{hint}",
            "link",
        )

    def _mimics(self, joints: Mapping[str, RobotJoint], places: Mapping[str, _Element]) -> None:
        for joint in joints.values():
            seen = [joint.name]
            leader = joint
            while leader.mimic is not None:
                name = leader.mimic.joint
                if name not in joints:
                    if leader is joint:
                        self._tolerate(
                            _end(places[joint.name], "mimic"),
                            f"joint '{joint.name}' mimics '{name}', but there is no such joint: "
                            f"'{joint.name}' is treated as an independent joint",
                        )
                    break
                if name in seen:
                    if name == joint.name:
                        self._tolerate(
                            _end(places[joint.name], "mimic"),
                            f"joint '{joint.name}' mimics itself through {_list(seen)}: "
                            f"'{joint.name}' is treated as an independent joint",
                        )
                    break
                seen.append(name)
                leader = joints[name]


def _is_degrees(limit: float) -> bool:
    """Return whether the limit of a revolute joint looks like degrees: 30 to 360 in steps of 5."""
    return 30.0 <= abs(limit) <= 360.0 and limit % 5.0 == 0.0


class _Doctype(Exception):
    """Exception for a document type in the XML, whose entities could expand without bound."""


def _refuse_doctype(*_declared: object) -> None:
    raise _Doctype


def _end(joint: _Element, tag: str) -> _Element:
    return joint.first(tag) or joint


def _loops(joint_above: Mapping[str, RobotJoint]) -> list[list[RobotJoint]]:
    """Return the joints of every loop that the joints form, each loop once."""
    done: set[str] = set()
    loops = []
    for start in joint_above:
        way: list[str] = []
        link = start
        while link in joint_above and link not in done:
            done.add(link)
            way.append(link)
            link = joint_above[link].parent
        if link in way:
            loops.append([joint_above[one] for one in reversed(way[way.index(link) :])])
    return loops


def _list(words: Iterable[str]) -> str:
    return ", ".join(words)
