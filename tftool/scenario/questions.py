"""Questions of a scenario's expectations, such as a distance, and the code that answers them.

Each class is one kind of question. Each field names the reader of its value; the method `answer`
computes the answer. The decorator `declare` registers the class in `SUBJECTS`, with its key in a
scenario and the form of the expected answer.
"""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar, Final

from tftool.base.errors import LookupException
from tftool.base.stamps import Duration, Stamp, as_seconds, seconds
from tftool.buffer.sample import FrameInfo
from tftool.buffer.solver import Velocity
from tftool.geometry import rigid
from tftool.geometry.rigid import Transform
from tftool.messages.turtle_messages import Pose
from tftool.scenario import units as values
from tftool.scenario.answer_checks import (
    CLEAN_FORM,
    COUNT_FORM,
    FRAME_FORM,
    NAMES_FORM,
    POSE_FORM,
    TURTLE_POSE_FORM,
    Form,
    FrameFacts,
    RangeCheck,
    range_form,
)
from tftool.scenario.doctor_expectations import NO_RULES, DoctorRules, check_or_area
from tftool.scenario.fields import Declared, declare, reads
from tftool.scenario.units import (
    ANGLE,
    DURATION,
    LENGTH,
    NUMBER,
    RATE,
    SPEED,
    TURN_RATE,
    RelativeMoment,
)
from tftool.world.log import LEVELS, LogRecord
from tftool.world.world import World

if TYPE_CHECKING:
    from tftool.frames.transform_log import TransformLog


class ScenarioWorld:
    """World of a scenario with the methods that questions need.

    Attributes:
        world: World of the scenario.
        start: Time at which the scenario began.
    """

    def __init__(self, world: World, start: Stamp, rules: DoctorRules = NO_RULES) -> None:
        self.world = world
        self.start = start
        self.rules = rules
        self.hearing: TransformLog | None = None
        self.lines: dict[Logged, int] = {}

    @property
    def now(self) -> Stamp:
        """Current time of the scenario's clock."""
        return self.world.clock.now()

    def lookup(self, target: str, source: str, time: RelativeMoment) -> Transform:
        """Return the pose of frame `source` in frame `target` at a time of the scenario."""
        stamp = time.stamp(self.start, self.now)
        return self.world.buffer.lookup_transform(target, source, stamp).transform

    def frame(self, name: str) -> FrameInfo:
        """Return the facts about one frame.

        Raises:
            LookupException: If there is no such frame.
        """
        snapshot = self.world.buffer.snapshot(self.now)
        if name not in snapshot:
            names = [info.frame for info in snapshot.frames]
            raise LookupException(f'frame "{name}" does not exist', frame=name, known=names)
        return snapshot.frame(name)

    def roots(self) -> tuple[str, ...]:
        """Return the frames without a parent."""
        return self.world.buffer.snapshot(self.now).roots()

    def trees(self) -> int:
        """Return the number of trees; a loop and all frames below it are one tree."""
        # Imported here, because few scenarios need it.
        from tftool.drawing.drawn_forest import grow

        return len(grow(self.world.buffer.snapshot(self.now)).roots)

    def count(self, record: LogRecord) -> None:
        """Count a log message for the questions about log messages."""
        for question in self.lines:
            if question.counts(record):
                self.lines[question] += 1


SUBJECTS: Final[dict[str, type["Subject"]]] = {}
"""Class of every subject, by its key."""


class Subject(Declared):
    """Base of questions about a scenario, each answered at one time.

    Attributes:
        key: Key of the question in a scenario, such as "distance".
        form: Form that reads the expected answer.
        is_of_frames: Whether the answer depends on transforms.
    """

    key: ClassVar[str]
    form: ClassVar[Form]
    is_of_frames: ClassVar[bool] = True

    def answer(self, scene: ScenarioWorld) -> Any:
        """Return the answer at the current time.

        Raises:
            TransformException: If a lookup fails, so that the question has no answer.
        """
        raise NotImplementedError

    @property
    def problem(self) -> str:
        """Text about fields that contradict each other; "" without a contradiction."""
        return ""


@declare(SUBJECTS, "lookup", form=POSE_FORM)
class Lookup(Subject):
    """Question for a frame's pose in another frame, with two times if there is a fixed frame."""

    target: str = reads(values.frame)
    source: str = reads(values.frame)
    time: RelativeMoment | None = reads(values.moment, None)
    target_time: RelativeMoment | None = reads(values.moment, None)
    source_time: RelativeMoment | None = reads(values.moment, None)
    fixed: str | None = reads(values.frame, None)

    @property
    def problem(self) -> str:
        """Text about fields that contradict each other; "" without a contradiction."""
        if self.fixed is None and (self.target_time or self.source_time):
            return "two times need a fixed frame: give 'fixed'"
        if self.fixed is not None and self.time is not None:
            return "'fixed' needs two times, not one 'time'"
        return ""

    def answer(self, scene: ScenarioWorld) -> Transform:
        """Return the pose of source in target."""
        if self.fixed is None:
            return scene.lookup(self.target, self.source, self.time or RelativeMoment())
        latest = RelativeMoment()
        found = scene.world.buffer.lookup_transform_full(
            self.target,
            (self.target_time or latest).stamp(scene.start, scene.now),
            self.source,
            (self.source_time or latest).stamp(scene.start, scene.now),
            self.fixed,
        )
        return found.transform

    def __str__(self) -> str:
        target, source, how = self.words
        return f"{source} in {target}{how}"

    @property
    def words(self) -> tuple[str, str, str]:
        """Parts of a sentence about the lookup: the target, the source, and the times."""
        if self.fixed is None:
            return self.target, self.source, "" if self.time is None else f" ({self.time})"
        latest = RelativeMoment()
        return (
            f"{self.target} ({self.target_time or latest})",
            f"{self.source} ({self.source_time or latest})",
            f", through {self.fixed},",
        )


class Between(Subject):
    """Base of questions about frame `end` relative to frame `start`, with the times of `Lookup`."""

    start: str = reads(values.frame, key="from")
    end: str = reads(values.frame, key="to")
    time: RelativeMoment | None = reads(values.moment, None)
    start_time: RelativeMoment | None = reads(values.moment, None, key="from_time")
    end_time: RelativeMoment | None = reads(values.moment, None, key="to_time")
    fixed: str | None = reads(values.frame, None)

    @property
    def problem(self) -> str:
        """Text about fields that contradict each other; "" without a contradiction."""
        return self.lookup.problem

    @property
    def lookup(self) -> Lookup:
        """Lookup of the pose of frame `end` in frame `start`."""
        return Lookup(
            target=self.start,
            source=self.end,
            time=self.time,
            target_time=self.start_time,
            source_time=self.end_time,
            fixed=self.fixed,
        )


@declare(SUBJECTS, "distance", form=range_form(LENGTH))
class Distance(Between):
    """Question for the distance between the origins of two frames."""

    def answer(self, scene: ScenarioWorld) -> float:
        """Return the distance between the origins of `start` and `end`, in metres."""
        return math.hypot(*self.lookup.answer(scene).translation)

    def __str__(self) -> str:
        start, end, how = self.lookup.words
        return f"distance from {start} to {end}{how}"


@declare(SUBJECTS, "bearing", form=range_form(ANGLE))
class Bearing(Between):
    """Question for the direction of the origin of frame `end`, seen from frame `start`."""

    def answer(self, scene: ScenarioWorld) -> float:
        """Return the angle to `end` in radians, counter-clockwise from the x axis of `start`."""
        return rigid.bearing(self.lookup.answer(scene))

    def __str__(self) -> str:
        start, end, how = self.lookup.words
        return f"bearing of {end} from {start}{how}"


@declare(SUBJECTS, "point", form=POSE_FORM)
class PointOf(Subject):
    """Question for a point's position in frame `target`; the point is fixed in frame `frame`."""

    frame: str = reads(values.frame, key="of")
    target: str = reads(values.frame, key="in")
    x: float = reads(values.length, 0.0)
    y: float = reads(values.length, 0.0)
    z: float = reads(values.length, 0.0)
    time: RelativeMoment = reads(values.moment, RelativeMoment())

    def answer(self, scene: ScenarioWorld) -> Transform:
        """Return the position as a pose with identity rotation."""
        target_from_frame = scene.lookup(self.target, self.frame, self.time)
        return Transform(target_from_frame.apply((self.x, self.y, self.z)))

    def __str__(self) -> str:
        return f"point ({self.x:g}, {self.y:g}, {self.z:g}) of {self.frame} in {self.target}"


class Motion(Subject):
    """Base of questions about a frame's motion in frame `target`, averaged over a duration."""

    frame: str = reads(values.frame, key="of")
    target: str = reads(values.frame, key="in")
    time: RelativeMoment = reads(values.moment, RelativeMoment())
    over: Duration = reads(values.period, seconds(0.1))

    def velocity(self, scene: ScenarioWorld) -> Velocity:
        """Return the velocity of the frame at the question's time."""
        stamp = self.time.stamp(scene.start, scene.now)
        return scene.world.buffer.lookup_twist(self.frame, self.target, stamp, self.over)


@declare(SUBJECTS, "speed", form=range_form(SPEED))
class SpeedOf(Motion):
    """Question for the speed of the origin of one frame in another frame."""

    def answer(self, scene: ScenarioWorld) -> float:
        """Return the speed in m/s."""
        return math.hypot(*self.velocity(scene).linear)

    def __str__(self) -> str:
        return f"speed of {self.frame} in {self.target}"


@declare(SUBJECTS, "turn_rate", form=range_form(TURN_RATE))
class TurnRateOf(Motion):
    """Question for the turn rate of a frame about the z axis of frame `target`."""

    def answer(self, scene: ScenarioWorld) -> float:
        """Return the turn rate in rad/s."""
        return self.velocity(scene).angular.z

    def __str__(self) -> str:
        return f"turn rate of {self.frame} in {self.target}"


class OfFrame(Subject):
    """Base of questions for a number about one frame, such as its rate."""

    short: ClassVar[str] = "frame"
    noun: ClassVar[str]
    measure: ClassVar[Callable[[FrameInfo], float]]
    frame: str = reads(values.frame)

    def answer(self, scene: ScenarioWorld) -> float:
        """Return the number that the subclass's function `measure` computes."""
        return type(self).measure(scene.frame(self.frame))

    def __str__(self) -> str:
        return f"{self.noun} of {self.frame}"


@declare(SUBJECTS, "rate", form=range_form(RATE), noun="rate", measure=lambda info: info.rate)
class RateOf(OfFrame):
    """Question for the rate at which a frame is published."""


@declare(
    SUBJECTS,
    "age",
    form=range_form(DURATION),
    noun="age",
    measure=lambda info: as_seconds(info.age),
)
class AgeOf(OfFrame):
    """Question for the age of a frame's newest sample."""


@declare(
    SUBJECTS,
    "memory",
    form=range_form(DURATION),
    noun="remembered span",
    measure=lambda info: as_seconds(info.buffer_length),
)
class MemoryOf(OfFrame):
    """Question for the duration of a frame's history, from the oldest to the newest sample."""


@declare(SUBJECTS, "frame", form=FRAME_FORM, short="name")
class FrameOf(Subject):
    """Question for the facts about a frame, such as parent and publisher; see `FrameFacts`."""

    name: str = reads(values.frame)

    def answer(self, scene: ScenarioWorld) -> FrameFacts:
        """Return the facts about the frame."""
        snapshot = scene.world.buffer.snapshot(scene.now)
        known = [info.frame for info in snapshot.frames]
        if self.name not in snapshot:
            return FrameFacts(False, known=known)
        info = snapshot.frame(self.name)
        return FrameFacts(True, info.parent, info.is_static, info.authority, known)

    def __str__(self) -> str:
        return f"frame {self.name}"


@declare(SUBJECTS, "trees", form=COUNT_FORM, short="count")
class Trees(Subject):
    """Question for the number of trees that the frames form."""

    count: int = reads(values.whole(0, 100_000))

    def answer(self, scene: ScenarioWorld) -> int:
        """Return the number of trees that the frames form."""
        return scene.trees()

    def __str__(self) -> str:
        return "number of trees"


@declare(SUBJECTS, "roots", form=NAMES_FORM, short="names")
class Roots(Subject):
    """Question for the frames without a parent."""

    names: tuple[str, ...] = reads(values.several(values.frame, "frames"))

    def answer(self, scene: ScenarioWorld) -> tuple[str, ...]:
        """Return the names of the frames without a parent."""
        return scene.roots()

    def __str__(self) -> str:
        return "roots"


@declare(SUBJECTS, "turtles", form=NAMES_FORM, short="names")
class Turtles(Subject):
    """Question for the turtles on the field."""

    is_of_frames: ClassVar[bool] = False

    names: tuple[str, ...] = reads(values.several(values.turtle, "turtles"))

    def answer(self, scene: ScenarioWorld) -> list[str]:
        """Return the names of the turtles."""
        # Topics may exist before and after their turtle; its services exist only with it.
        ending = "/teleport_absolute"
        services = scene.world.services()
        return [name.removesuffix(ending) for name in services if name.endswith(ending)]

    def __str__(self) -> str:
        return "turtles"


@declare(SUBJECTS, "pose", form=TURTLE_POSE_FORM, short="turtle")
class PoseOf(Subject):
    """Question for a turtle's last published pose."""

    is_of_frames: ClassVar[bool] = False

    turtle: str = reads(values.turtle)

    def answer(self, scene: ScenarioWorld) -> Any:
        """Return the turtle's last Pose message; None before the first message."""
        topic = scene.world.topics().get(f"{self.turtle}/pose")
        return topic.latest if topic is not None and topic.kind is Pose else None

    def __str__(self) -> str:
        return f"pose of {self.turtle}"


@declare(
    SUBJECTS,
    "logged",
    form=range_form(NUMBER, default=RangeCheck(NUMBER, above=0.0), tolerance=0.0),
    short="text",
)
class Logged(Subject):
    """Question for the number of log messages with a text; node and level may be given, too."""

    is_of_frames: ClassVar[bool] = False

    text: str = reads(values.text)
    node: str | None = reads(values.name("a node"), None)
    level: str | None = reads(values.choice(LEVELS, "a level"), None)

    def answer(self, scene: ScenarioWorld) -> int:
        """Return the number of matching log messages."""
        return scene.lines.get(self, 0)

    def counts(self, record: LogRecord) -> bool:
        """Return whether a log message matches the text, node and level of this question."""
        return (
            self.text in record.text
            and self.node in (None, record.node)
            and self.level in (None, record.level)
        )

    def __str__(self) -> str:
        by = f" by {self.node}" if self.node else ""
        return f"log lines{by} with '{self.text}'"


@declare(SUBJECTS, "doctor", form=CLEAN_FORM, short="findings")
class Diagnosed(Subject):
    """Question for the doctor's findings in all transforms since the scenario's start."""

    findings: str = reads(values.choice(("clean",), "what the doctor finds"), "clean")
    ignore: tuple[str, ...] = reads(values.several(check_or_area, "checks"), ())

    def answer(self, scene: ScenarioWorld) -> list[str]:
        """Return the findings as text, without findings of ignored checks."""
        from tftool.doctor.judge import faults_in_log

        if scene.hearing is None:
            return []
        faults = faults_in_log(
            scene.hearing,
            "scenario",
            (scene.start, scene.now),
            scene.world.buffer.cache_time,
            limits=scene.rules.limits,
            ignore=(*scene.rules.ignore, *self.ignore),
        )
        return [f"{fault.id}: {fault.message}" for fault in faults]

    def __str__(self) -> str:
        without = f" without {', '.join(self.ignore)}" if self.ignore else ""
        return f"the doctor's findings{without}"
