"""State of a world as screens show it, at the present or at a past time in the buffer."""

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any, NamedTuple, Protocol

from tftool.base.color import Color
from tftool.base.errors import InputError, TransformException
from tftool.base.stamps import LATEST, Duration, Stamp, as_seconds, seconds
from tftool.buffer.sample import FrameInfo, Snapshot, TransformStamped
from tftool.buffer.snapshot import rate_of
from tftool.drawing import theme
from tftool.drawing.cells import Stroke
from tftool.drawing.plane import Drawn, PlaneFrame, PlanePicture, TurtleField
from tftool.drawing.solids import Solids, solids_of
from tftool.geometry.motion import FIELD
from tftool.geometry.rigid import Transform, heading, transform_from_pose
from tftool.robots.mesh_folders import MeshFolders
from tftool.robots.urdf import parse_description
from tftool.screens.still_frames import ShownFrames
from tftool.screens.terminal.frames_picture import (
    FrameTrails,
    Lookup,
    in_snapshot,
    moving,
    natural_fixed,
    pictured,
)
from tftool.world.nodes.joints import DESCRIPTION, LATCHED, description_type
from tftool.world.nodes.remote_turtles import FarTurtles
from tftool.world.nodes.trail import Trail
from tftool.world.nodes.turtle import PEN_COLOR
from tftool.world.nodes.turtlesim import Turtlesim, simulator_of
from tftool.world.world import World

FLASH = seconds(0.4)
"""Nanoseconds for which a wall is highlighted after a turtle hit it."""

NEAR = 1e-3
"""Largest distance in metres from the end of a turtle's last stroke to its rounded position."""


@dataclass(frozen=True, slots=True)
class Pair:
    """Two frames, and the result of the lookup between these frames.

    If the lookup fails, `found` is None and `refusal` is the error.
    """

    target: str
    source: str
    found: TransformStamped | None = None
    refusal: str = ""


@dataclass(frozen=True, slots=True)
class SceneMoment:
    """State of a scene at one time, as the screen shows it; immutable.

    Attributes:
        stamp: Time that is shown, nanoseconds.
        behind: Nanoseconds from `stamp` to the present; 0 if live.
        elapsed: Nanoseconds since the scene's start.
        snapshot: All frames at that time.
        ages: Seconds since each frame's stamp last changed; 0 for static frames.
        picture: Picture of the frames, seen from above in one fixed frame.
        pair: Selected pair with its transform.
    """

    stamp: Stamp
    behind: Duration
    elapsed: Duration
    snapshot: Snapshot
    ages: dict[str, float]
    picture: PlanePicture
    pair: Pair


class SimulatedTurtle(Protocol):
    """Protocol of a turtle that can be drawn."""

    @property
    def name(self) -> str:
        """Name of the turtle."""

    @property
    def pose(self) -> Any:
        """Last Pose message of the turtle."""

    @property
    def wall_hits(self) -> int:
        """Number of times that the turtle hit the wall."""


class Simulator(Protocol):
    """Protocol of a turtle simulator, in this process or in another process."""

    trail: Trail

    @property
    def turtles(self) -> Mapping[str, SimulatedTurtle]:
        """All turtles by name."""

    @property
    def background(self) -> Color:
        """Colour of the turtles' field."""


class _SeenTurtle(NamedTuple):
    """Stored pose of a turtle on the field, in metres and radians."""

    name: str
    x: float
    y: float
    theta: float


@dataclass(frozen=True, slots=True)
class _Seen:
    """Stored state of the simulator at the time `stamp`.

    `drawn` counts the strokes drawn so far; `wipes` counts how often the drawing was cleared.
    """

    stamp: Stamp
    turtles: tuple[_SeenTurtle, ...]
    walls: frozenset[str]
    background: Color
    wipes: int
    drawn: int


class Scene:
    """Observer of a world, which stores past states of the turtle simulator.

    Args:
        world: World to observe.
        simulator: Simulator whose turtles are drawn; None without turtles.

    Attributes:
        start: Time from which the screen counts seconds.
        solids: Shapes of a robot, once a robot description is known; else None.
        missed: Name of a missing turtle for which a key was pressed; a message is logged when the
            turtle appears.
    """

    def __init__(self, world: ShownFrames, simulator: Simulator | None = None) -> None:
        self.world = world
        self.simulator = simulator
        self.start: Stamp = world.clock.epoch
        self.solids: Solids | None = None
        self.missed = ""
        self._news: dict[str, tuple[Stamp, Stamp]] = {}
        self._seen: deque[_Seen] = deque()
        # Trails that were cleared, stored while the screen can go back to them.
        self._wiped: dict[int, tuple[int, tuple[Stroke, ...]]] = {}
        self._strokes: tuple[Stroke, ...] = ()
        self._hits: dict[str, int] = {}
        self._lit: dict[str, Stamp] = {}
        self._trails = FrameTrails(world.buffer)
        self._field_frame = ""

    def look(self) -> None:
        """Store the present state of the simulator; called a few dozen times a second."""
        now = self.world.clock.now()
        simulator = self.simulator
        if simulator is None or not (simulator.turtles or self._seen):
            return
        if self.missed in simulator.turtles:
            # Otherwise the outdated error would remain the newest line of the log.
            self.world.log.info("screen", f"{self.missed} is here now: the keys drive it")
            self.missed = ""
        turtles = tuple(
            _SeenTurtle(turtle.name, turtle.pose.x, turtle.pose.y, turtle.pose.theta)
            for turtle in simulator.turtles.values()
        )
        trail = simulator.trail
        before = self._seen[-1] if self._seen else None
        if before is None or (trail.wipes, trail.drawn) != (before.wipes, before.drawn):
            if before is not None and trail.wipes != before.wipes:
                self._wiped[before.wipes] = before.drawn, self._strokes
            same = before is not None and trail.wipes == before.wipes
            known = before.drawn if before is not None and same else 0
            old = max(0, len(trail.segments) - (trail.drawn - known))
            new: Sequence[Stroke] = list(islice(trail.segments, old, None))
            # Strokes of a far simulator arrive later than its poses, so their turtle is not known.
            if isinstance(simulator, Turtlesim):
                new = _inked(new, turtles)
            self._strokes = (*(self._strokes[len(self._strokes) - old :] if same else ()), *new)
        for turtle in simulator.turtles.values():
            if turtle.wall_hits > self._hits.get(turtle.name, 0):
                self._lit.update(dict.fromkeys(_sides(turtle.pose.x, turtle.pose.y), now))
            self._hits[turtle.name] = turtle.wall_hits
        walls = frozenset(side for side, lit in self._lit.items() if now - lit < FLASH)
        self._seen.append(
            _Seen(now, turtles, walls, simulator.background, trail.wipes, trail.drawn)
        )
        # The newest state from before the buffer's start stays: it is the state at the start.
        reach = now - self.world.buffer.cache_time
        while len(self._seen) > 1 and self._seen[1].stamp <= reach:
            self._seen.popleft()
        for wipes in [one for one in self._wiped if one < self._seen[0].wipes]:
            del self._wiped[wipes]

    def oldest(self) -> Stamp:
        """Return the earliest time that can be shown."""
        now = self.world.clock.now()
        snapshot = self.world.buffer.snapshot(now)
        held = [info.oldest for info in snapshot.frames if info.oldest and not info.is_static]
        return min(max(min(held, default=now), now - self.world.buffer.cache_time), now)

    def moment(self, at: Stamp | None, target: str, source: str, fixed: str = "") -> SceneMoment:
        """Return the state of the scene at one time.

        Args:
            at: Time to show; None for the present.
            target: Frame in which the pair's pose is expressed.
            source: Frame whose pose is shown.
            fixed: Frame in which the picture is drawn; "" for the root of the pair's tree.
        """
        now = self.world.clock.now()
        stamp = now if at is None else at
        snapshot = self.world.buffer.snapshot(stamp, LATEST if at is None else at)
        if at is not None:
            frames = tuple(self._as_of(info, at) for info in snapshot.frames)
            snapshot = Snapshot(snapshot.now, snapshot.at, frames)
        ages = self._ages(snapshot, now, at)
        return SceneMoment(
            stamp=stamp,
            behind=now - stamp,
            elapsed=stamp - self.start,
            snapshot=snapshot,
            ages=ages,
            picture=self._picture(snapshot, ages, at, (target, source), fixed),
            pair=self._pair(snapshot, target, source, LATEST if at is None else at),
        )

    def newest(self, target: str, source: str) -> Stamp | None:
        """Return the newest time of a pair's transform; None for static or unconnected pairs."""
        try:
            return self.world.buffer.get_latest_common_time(target, source) or None
        except TransformException:
            return None

    def again(self, moment: SceneMoment, target: str, source: str, fixed: str = "") -> SceneMoment:
        """Return a past state for another pair or fixed frame, from the stored snapshot."""
        snapshot, pair = moment.snapshot, (target, source)
        wanted = self._fixed(snapshot, pair, fixed)
        if moment.picture.fixed != wanted:
            picture = self._picture(snapshot, moment.ages, moment.stamp, pair, wanted)
            moment = replace(moment, picture=picture)
        elif moment.picture.pair != pair:
            moment = replace(moment, picture=replace(moment.picture, pair=pair))
        for frame in (target, source):
            if frame not in snapshot:
                refusal = f"there was no frame '{frame}' then"
                return replace(moment, pair=Pair(target, source, refusal=refusal))
        to, of = snapshot.frame(target), snapshot.frame(source)
        if to.root_from_frame is None or of.root_from_frame is None or to.root != of.root:
            refusal = f"'{target}' and '{source}' were not connected then"
            return replace(moment, pair=Pair(target, source, refusal=refusal))
        target_from_source = to.root_from_frame.inverse() @ of.root_from_frame
        found = TransformStamped(moment.stamp, target, source, target_from_source)
        return replace(moment, pair=Pair(target, source, found))

    def _pair(self, snapshot: Snapshot, target: str, source: str, at: Stamp) -> Pair:
        if not (target and source and snapshot.frames):
            return Pair("", "", refusal="there are no frames yet")
        try:
            found = self.world.buffer.lookup_transform(target, source, at)
        except TransformException as refusal:
            return Pair(target, source, refusal=str(refusal))
        return Pair(target, source, found)

    def _as_of(self, info: FrameInfo, at: Stamp) -> FrameInfo:
        """Return a frame's facts at the past time `at`; later samples are ignored."""
        if info.parent is None or info.is_static or info.newest <= at:
            return info
        stamps = self.world.buffer.samples(info.frame).stamps
        held = stamps[stamps <= at]
        if not len(held):
            return info._replace(samples=0, rate=0.0, buffer_length=0, age=0)
        oldest, newest = int(held[0]), int(held[-1])
        return info._replace(
            samples=len(held),
            rate=rate_of(len(held), newest - oldest),
            oldest=oldest,
            newest=newest,
            buffer_length=newest - oldest,
            age=at - newest,
        )

    def _ages(self, snapshot: Snapshot, now: Stamp, at: Stamp | None) -> dict[str, float]:
        """Return the age of each frame in seconds, as in rviz: the time since its stamp changed.

        For a past time `at`, the age is the time since the newest stamp, because times of arrival
        are not stored.
        """
        ages: dict[str, float] = {}
        for info in snapshot.frames:
            if info.is_static or info.parent is None:
                ages[info.frame] = 0.0
            elif at is not None:
                ages[info.frame] = max(0.0, as_seconds(at - info.newest))
            else:
                news = self._news.get(info.frame)
                if news is None or news[0] != info.newest:
                    # If first seen now, the frame may be old: its stamp is the best estimate.
                    since = now if news is not None else min(now, max(info.newest, 1))
                    news = self._news[info.frame] = info.newest, since
                ages[info.frame] = as_seconds(now - news[1])
        return ages

    def _fixed(self, snapshot: Snapshot, pair: tuple[str, str], fixed: str) -> str:
        return fixed if fixed in snapshot else natural_fixed(snapshot, pair)

    def _picture(
        self,
        snapshot: Snapshot,
        ages: dict[str, float],
        at: Stamp | None,
        pair: tuple[str, str],
        wanted: str,
    ) -> PlanePicture:
        fixed = self._fixed(snapshot, pair, wanted)
        lookup = in_snapshot(snapshot) if at is not None else self._latest(snapshot, fixed)
        seen = self._at(at)
        there = () if seen is None else seen.turtles
        turtles = frozenset(turtle.name for turtle in there)
        picture = pictured(snapshot, fixed, lookup, ages, turtles)
        ways = [
            name
            for name in moving(snapshot, fixed)
            if name not in turtles and (not turtles or name != self._field_frame)
        ]
        if at is None:
            trails = self._trails.follow(fixed, ways, snapshot.now)
        else:
            if self._trails.fixed:
                self._trails.follow(self._trails.fixed, ways, snapshot.now)
            trails = self._trails.until(fixed, ways, at)
        picture = replace(picture, trails=trails, pair=pair)
        return picture if seen is None else self._with_field(picture, snapshot, lookup, seen, at)

    def _latest(self, snapshot: Snapshot, fixed: str) -> Lookup:
        """Return a function that looks up the latest poses relative to `fixed`."""
        inside = in_snapshot(snapshot)
        if fixed in snapshot and snapshot.frame(fixed).parent is None:
            return inside

        def lookup(target: str, source: str) -> Transform | None:
            try:
                return self.world.buffer.lookup_transform(target, source, LATEST).transform
            except TransformException:
                return None

        return lookup

    def _with_field(
        self,
        picture: PlanePicture,
        snapshot: Snapshot,
        lookup: Lookup,
        seen: _Seen,
        at: Stamp | None,
    ) -> PlanePicture:
        """Add the turtles' field to the picture, in the parent frame of the turtles' frames."""
        parents = [
            parent
            for turtle in seen.turtles
            if turtle.name in snapshot and (parent := snapshot.frame(turtle.name).parent)
        ]
        self._field_frame = next(iter(parents), self._field_frame)
        pose = lookup(picture.fixed, self._field_frame) if self._field_frame else None
        if pose is None and self._field_frame in snapshot:
            # The robot's frame is in another tree, or its pose is unknown.
            return picture
        pose = pose or Transform.identity()
        field = TurtleField(
            pose.translation.x, pose.translation.y, heading(pose), seen.background, seen.walls
        )
        strangers = tuple(
            _frameless(turtle, pose) for turtle in seen.turtles if turtle.name not in snapshot
        )
        drawn, strokes = self._wiped.get(seen.wipes, (self._seen[-1].drawn, self._strokes))
        forgotten = drawn - len(strokes)
        if at is not None:
            strokes = strokes[: max(0, seen.drawn - forgotten)]
        return replace(
            picture,
            frames=picture.frames + strangers,
            field=field,
            pen=Drawn(strokes, forgotten, seen.wipes),
        )

    def _at(self, at: Stamp | None) -> _Seen | None:
        if not self._seen:
            return None
        if at is None:
            return self._seen[-1]
        return next((seen for seen in reversed(self._seen) if seen.stamp <= at), self._seen[0])


def _inked(strokes: Sequence[Stroke], turtles: Sequence[_SeenTurtle]) -> list[Stroke]:
    """Return the strokes, with each turtle's colour in place of the simulator's default colour.

    Args:
        strokes: The newest strokes, oldest first. Each turtle's last stroke ends at the turtle.
        turtles: Present turtles.
    """
    ends = {turtle.name: (turtle.x, turtle.y) for turtle in turtles}
    found: list[Stroke] = []
    for x0, y0, x1, y1, color, width in reversed(strokes):
        near = (name for name, (x, y) in ends.items() if abs(x - x1) + abs(y - y1) < NEAR)
        name = next(near, None)
        if name is not None:
            ends[name] = x0, y0
            color = theme.of_name(name) if color == PEN_COLOR else color
        found.append((x0, y0, x1, y1, color, width))
    return found[::-1]


def _sides(x: float, y: float) -> list[str]:
    far = FIELD - 1e-5
    sides = {"left": x <= 0.0, "bottom": y <= 0.0, "right": x >= far, "top": y >= far}
    return [side for side, met in sides.items() if met]


def _frameless(turtle: _SeenTurtle, pose: Transform) -> PlaneFrame:
    """Return the picture's element for a turtle without a frame.

    Args:
        turtle: Position of the turtle in the simulator.
        pose: Pose of the turtles' field in the picture.
    """
    there = pose @ transform_from_pose(turtle.x, turtle.y, turtle.theta)
    ahead = there.rotate((1.0, 0.0, 0.0))[:2]
    return PlaneFrame(
        turtle.name,
        there.translation.x,
        there.translation.y,
        (ahead,),
        is_turtle=True,
        is_frame=False,
    )


def scene_of(world: World) -> Scene:
    """Return the scene of a world, with the turtles of a simulator here or in another process."""
    scene = Scene(world, simulator_of(world) or FarTurtles(world))

    def take(solids: "Solids") -> None:
        scene.solids = solids

    take_solids(world, "screen", take, lambda told: world.log.warn("screen", told))
    return scene


def take_solids(
    world: World,
    owner: str,
    take: Callable[[Solids], object],
    tell: Callable[[str], object],
) -> None:
    """Call `take` with the robot's shapes when a description arrives on /robot_description.

    Args:
        world: World in which the description is published.
        owner: Name of the subscriber.
        take: Function called with the shapes.
        tell: Function called with sentences about shapes that are not drawn.
    """

    def described(message: Any) -> None:
        try:
            robot = parse_description(message.data)
        except InputError as error:
            tell(f"the description on /{DESCRIPTION} is not drawn: {error}")
            return
        solids, missing = solids_of(
            robot.links.values(), MeshFolders(), joints=robot.joints.values()
        )
        take(solids)
        if missing:
            tell(f"{len(missing)} shapes are not drawn: {missing[0]}")

    world.subscribe(owner, DESCRIPTION, description_type(), described, LATCHED)
