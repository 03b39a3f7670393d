"""What must hold, and when: questions answered from the world, judged in time.

To add a question: a dataclass in `questions`, a function that answers it, and one
entry in `SUBJECTS`.
"""

import asyncio
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar

from tftool.errors import LookupException, TransformException
from tftool.frames.sample import FrameInfo
from tftool.frames.velocity import Velocity
from tftool.geometry import planar
from tftool.geometry.rigid import Transform
from tftool.messages import Pose2D
from tftool.runtime.clock import Phase
from tftool.runtime.log import LogRecord
from tftool.runtime.node import Node
from tftool.runtime.world import World
from tftool.scenario import checks, questions
from tftool.scenario.checks import Form, FrameFacts, Judged, Range, RangeForm
from tftool.scenario.pose_checks import PoseForm, TurtlePoseForm
from tftool.scenario.schema import Expectation
from tftool.scenario.values import (
    ANGLE,
    DURATION,
    LENGTH,
    NUMBER,
    RATE,
    SPEED,
    TURN_RATE,
    Moment,
)
from tftool.scenario.verdict import Outcome
from tftool.stamps import Stamp, as_seconds


class Scene:
    """What questions are put to.

    Attributes:
        world: Where the scenario lives.
        start: The moment it began.
    """

    def __init__(self, world: World, start: Stamp) -> None:
        self.world = world
        self.start = start
        self.lines: dict[questions.Logged, int] = {}

    @property
    def now(self) -> Stamp:
        """The moment it is."""
        return self.world.clock.now()

    def lookup(self, target: str, source: str, time: Moment) -> Transform:
        """Look up a pose, at a moment of the scenario."""
        stamp = time.stamp(self.start, self.now)
        return self.world.buffer.lookup_transform(target, source, stamp).transform

    def frame(self, name: str) -> FrameInfo:
        """All about one frame.

        Raises:
            LookupException: If there is none.
        """
        snapshot = self.world.buffer.snapshot(self.now)
        if name not in snapshot:
            raise LookupException(f'frame "{name}" does not exist', frame=name)
        return snapshot.frame(name)

    def count(self, record: LogRecord) -> None:
        """Count a line of the log for the questions it answers."""
        for question in self.lines:
            if (
                question.text in record.text
                and question.node in (None, record.node)
                and question.level in (None, record.level)
            ):
                self.lines[question] += 1


def _lookup(asked: questions.Lookup, scene: Scene) -> Transform:
    if asked.fixed is None:
        return scene.lookup(asked.target, asked.source, asked.time or Moment())
    latest = Moment()
    found = scene.world.buffer.lookup_transform_full(
        asked.target,
        (asked.target_time or latest).stamp(scene.start, scene.now),
        asked.source,
        (asked.source_time or latest).stamp(scene.start, scene.now),
        asked.fixed,
    )
    return found.transform


def _distance(asked: questions.Distance, scene: Scene) -> float:
    return math.hypot(*_lookup(asked.lookup, scene).translation)


def _bearing(asked: questions.Bearing, scene: Scene) -> float:
    return planar.bearing(_lookup(asked.lookup, scene))


def _point(asked: questions.PointOf, scene: Scene) -> Transform:
    target_from_frame = scene.lookup(asked.target, asked.frame, asked.time)
    return Transform(target_from_frame.apply((asked.x, asked.y, asked.z)))


def _velocity(asked: questions.Motion, scene: Scene) -> Velocity:
    stamp = asked.time.stamp(scene.start, scene.now)
    return scene.world.buffer.lookup_twist(asked.frame, asked.target, stamp, asked.over)


def _frame(asked: questions.FrameOf, scene: Scene) -> FrameFacts:
    snapshot = scene.world.buffer.snapshot(scene.now)
    if asked.name not in snapshot:
        return FrameFacts(False)
    info = snapshot.frame(asked.name)
    return FrameFacts(True, info.parent, info.is_static, info.authority)


def _roots(asked: questions.Roots | questions.Trees, scene: Scene) -> tuple[str, ...]:
    return scene.world.buffer.snapshot(scene.now).roots()


def _turtles(asked: questions.Turtles, scene: Scene) -> list[str]:
    # Topics outlive turtles and come before them; a turtle's services do neither.
    ending = "/teleport_absolute"
    services = scene.world.services()
    return [name.removesuffix(ending) for name in services if name.endswith(ending)]


def _pose(asked: questions.PoseOf, scene: Scene) -> Pose2D | None:
    topic = scene.world.topics().get(f"{asked.turtle}/pose")
    latest = topic.latest if topic is not None else None
    return latest if isinstance(latest, Pose2D) else None


@dataclass(frozen=True, slots=True)
class Subject:
    """A kind of question: how it is asked, what its answer may be held to, who answers."""

    question: type
    form: Form
    answer: Callable[[Any, Scene], Any]


SUBJECTS: Mapping[str, Subject] = MappingProxyType(
    {
        "lookup": Subject(questions.Lookup, PoseForm(), _lookup),
        "distance": Subject(questions.Distance, RangeForm(LENGTH), _distance),
        "bearing": Subject(questions.Bearing, RangeForm(ANGLE), _bearing),
        "point": Subject(questions.PointOf, PoseForm(), _point),
        "speed": Subject(
            questions.SpeedOf,
            RangeForm(SPEED),
            lambda asked, scene: math.hypot(*_velocity(asked, scene).linear),
        ),
        "turn_rate": Subject(
            questions.TurnRateOf,
            RangeForm(TURN_RATE),
            lambda asked, scene: _velocity(asked, scene).angular.z,
        ),
        "rate": Subject(
            questions.RateOf, RangeForm(RATE), lambda asked, scene: scene.frame(asked.frame).rate
        ),
        "age": Subject(
            questions.AgeOf,
            RangeForm(DURATION),
            lambda asked, scene: as_seconds(scene.frame(asked.frame).age),
        ),
        "memory": Subject(
            questions.MemoryOf,
            RangeForm(DURATION),
            lambda asked, scene: as_seconds(scene.frame(asked.frame).buffer_length),
        ),
        "frame": Subject(questions.FrameOf, checks.FactsForm(), _frame),
        "trees": Subject(
            questions.Trees, checks.CountForm(), lambda asked, scene: len(_roots(asked, scene))
        ),
        "roots": Subject(questions.Roots, checks.NamesForm(), _roots),
        "turtles": Subject(questions.Turtles, checks.NamesForm(), _turtles),
        "pose": Subject(questions.PoseOf, TurtlePoseForm(), _pose),
        "logged": Subject(
            questions.Logged,
            RangeForm(NUMBER, default=Range(NUMBER, above=0.0), tolerance=0.0),
            lambda asked, scene: scene.lines.get(asked, 0),
        ),
    }
)

_ANSWERS = {subject.question: subject.answer for subject in SUBJECTS.values()}


def judge(expectation: Expectation, scene: Scene) -> Judged:
    """Look at one expectation now."""
    question = expectation.question
    check: checks.Check = expectation.check
    try:
        answer = _ANSWERS[type(question)](question, scene)
    except TransformException as error:
        return check.refused(error)
    return check.judge(answer)


class Expectations(Node):
    """Judges every expectation when its time comes, after everything else of that instant.

    Attributes:
        outcomes: What came of each, None for those whose time has not come.
    """

    phase: ClassVar[Phase] = Phase.WATCH

    def __init__(self, world: World, expected: Sequence[Expectation]) -> None:
        """Watch over `world`; log lines count from now on."""
        super().__init__(world, "expectations")
        self.expected = tuple(expected)
        self.outcomes: list[Outcome | None] = [None] * len(self.expected)
        self._scene = Scene(world, world.clock.now())
        for expectation in self.expected:
            if isinstance(expectation.question, questions.Logged):
                self._scene.lines[expectation.question] = 0
        self._stops.append(world.log.listen(self._scene.count))

    async def run(self) -> None:
        """Judge them all, each in its own time."""
        self._scene.start = self.clock.now()
        await asyncio.gather(*(self._judge(index) for index in range(len(self.expected))))

    async def _judge(self, index: int) -> None:
        expectation = self.expected[index]
        when = expectation.when
        at = when.first
        while True:
            await self.clock.sleep_until(self._scene.start + at, self.phase, self.rank)
            judged = judge(expectation, self._scene)
            # "by" is over when it holds, "during" when it does not, both at the last moment.
            settled = {"at": True, "by": judged.ok, "during": not judged.ok}[when.kind]
            if settled or at >= when.last:
                break
            at = min(at + when.every, when.last)
        self.outcomes[index] = Outcome(
            expectation=f"{expectation.question}",
            line=expectation.line,
            when=f"{when}",
            expected=f"{expectation.check}",
            found=judged.found,
            at=at,
            ok=judged.ok,
        )
