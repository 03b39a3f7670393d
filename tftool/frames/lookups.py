"""Questions put to a forest by walking it; plans are left behind for those who ask again."""

from tftool.errors import TransformException
from tftool.frames import export, names, refusals, sweep
from tftool.frames.forest import ARRIVED, LOOP, REFUSED, Forest, Walk
from tftool.frames.links import IDENTITY, Sample
from tftool.frames.plans import MOST_PLANS, Plan, plan_of
from tftool.frames.requests import AVAILABLE, EXPIRED, PENDING, Question
from tftool.stamps import Duration, Stamp

_LOOKUP = "lookupTransform"


class Lookups:
    """What can be asked of a forest.

    Attributes:
        plans: By target and then by source; all dropped when the forest changes its shape.
    """

    __slots__ = ("_cache_time", "_forest", "_planned", "plans")

    def __init__(self, forest: Forest, cache_time: Duration) -> None:
        self._forest = forest
        self._cache_time = cache_time
        self.plans: dict[str, dict[str, Plan]] = {}
        self._planned = 0

    def pose(self, target: str, source: str, time: Stamp) -> tuple[Stamp, Sample]:
        """The pose of source in target and the moment it holds for, without a plan.

        Leaves a plan behind where that is possible.

        Raises:
            TransformException: As `Buffer.lookup_transform` says.
        """
        forest = self._forest
        if target == source:
            if time == 0:
                number = forest.numbers.get(target)
                time = 0 if number is None else forest.newest_stamp(number)
            return time, IDENTITY
        target_number = self.number(target, "target_frame", _LOOKUP, target, source)
        source_number = self.number(source, "source_frame", _LOOKUP, target, source)
        time = time or self.latest_common(target_number, source_number)
        walk = forest.walk(target_number, source_number, time)
        if walk.ended != ARRIVED:
            raise self._refusal(walk, time, target, source)
        plan = plan_of(forest, walk)
        pose = plan.solve(time)
        assert pose is not None, "a link that answers for its parent answers for its pose"
        self._remember(target_number, source_number, walk, plan)
        return time, pose.translation + pose.rotation

    def latest_common(self, target: int, source: int) -> Stamp:
        """The newest moment for which every link between two frames has data.

        Raises:
            TransformException: If nothing joins them, or a chain does not end.
        """
        ended, latest = self._forest.latest_common(target, source)
        if ended == ARRIVED:
            return latest
        frames = self._forest.frames
        target_name, source_name = frames[target].name, frames[source].name
        if ended == LOOP:
            raise self._looped(target_name, source_name)
        raise refusals.unconnected(target_name, source_name)

    def why_not(self, target: str, source: str, time: Stamp) -> str | TransformException | None:
        """Why a lookup would be refused, as `can_transform` has it; None if it would not."""
        if target == source:
            return None
        for frame, argument in ((target, "target_frame"), (source, "source_frame")):
            if why := self.fault(frame):
                return refusals.invalid_frame(frame, argument, why)
        numbers = self._forest.numbers
        target_number, source_number = numbers[target], numbers[source]
        try:
            time = time or self.latest_common(target_number, source_number)
        except TransformException as refused:
            return refused
        walk = self._forest.walk(target_number, source_number, time)
        if walk.ended == ARRIVED:
            self._remember(target_number, source_number, walk, plan_of(self._forest, walk))
            return None
        return self._refusal(walk, time, target, source)

    def chain(self, target: str, source: str, time: Stamp) -> list[str]:
        """The frames from source to target, both included; empty if they are the same."""
        if target == source:
            return []
        time, _ = self.pose(target, source, time)
        forest = self._forest
        walk = forest.walk(forest.numbers[target], forest.numbers[source], time)
        # The two sides meet above the last link of either.
        link = forest.frames[(walk.up or walk.down)[-1]].link
        meeting = -1 if link is None else link.parent_at(time)
        return [forest.frames[number].name for number in (*walk.up, meeting, *walk.down[::-1])]

    def examine(self, question: Question, first: bool) -> tuple[int, tuple[str, ...]]:
        """How a waiting question stands, and which frames must change before that can."""
        target, source, time = question
        if target == source:
            return AVAILABLE, ()
        forest = self._forest
        for name in (target, source):
            if name not in forest.numbers:
                # Nothing but this name's coming up can help.
                return PENDING, (name,)
        target_number, source_number = forest.numbers[target], forest.numbers[source]
        ended, latest = forest.latest_common(target_number, source_number)
        # A question for the latest never becomes too old.
        expired = latest != 0 and time != 0 and time + self._cache_time < latest
        if expired and not first:
            return EXPIRED, ()
        walk = forest.walk(target_number, source_number, time or latest)
        if walk.ended == ARRIVED and (time != 0 or ended == ARRIVED):
            return AVAILABLE, ()
        if expired:
            return EXPIRED, ()
        newest = forest.walk(target_number, source_number, 0)
        seen = dict.fromkeys([*walk.visited(), *newest.visited()])
        return PENDING, tuple(forest.frames[number].name for number in seen)

    def number(self, frame: str, argument: str, call: str, target: str, source: str) -> int:
        """A frame's number.

        Raises:
            TransformException: If it can never have one, or has none yet.
        """
        if why := names.fault(frame):
            raise refusals.invalid(frame, argument, call, why, target=target, source=source)
        number = self._forest.numbers.get(frame)
        if number is None:
            raise refusals.unknown(
                frame, argument, call, self._forest.numbers.keys(), target=target, source=source
            )
        return number

    def fault(self, frame: str) -> str:
        """What is wrong with a frame's name, as `can_transform` has it; empty if nothing is."""
        if why := names.fault(frame):
            return why
        return "" if frame in self._forest.numbers else "frame does not exist"

    def drop_plans(self) -> None:
        """Forget every plan."""
        if self._planned:
            self.plans.clear()
            self._planned = 0

    def _remember(self, target: int, source: int, walk: Walk, plan: Plan) -> None:
        """Keep the plan of a walk that arrived, if no link on the way leads elsewhere at times."""
        forest = self._forest
        if not walk.timeless:
            # What leads elsewhere, or has no data, may lie above the way.
            walk = forest.walk(target, source, 0)
            links = [forest.frames[number].link for number in walk.visited()]
            if walk.ended != ARRIVED or any(link is not None and link.mixed for link in links):
                return
            plan = plan_of(forest, walk)
        if self._planned >= MOST_PLANS:
            self.drop_plans()
        self.plans.setdefault(forest.frames[target].name, {})[forest.frames[source].name] = plan
        self._planned += 1

    def _refusal(self, walk: Walk, time: Stamp, target: str, source: str) -> TransformException:
        """What a walk that did not arrive is refused with."""
        if walk.ended == LOOP:
            return self._looped(target, source)
        if walk.ended == REFUSED:
            frame = self._forest.frames[walk.refused]
            assert frame.link is not None
            return refusals.extrapolation(
                frame.link.refusal(time), frame.name, time, target, source
            )
        return refusals.unconnected(target, source)

    def _looped(self, target: str, source: str) -> TransformException:
        frames = export.as_string(sweep.snapshot(self._forest, 0, 0).frames)
        return refusals.loop(frames, target, source)
