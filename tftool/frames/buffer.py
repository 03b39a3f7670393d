"""The buffer: remembers transforms over time and answers how frames lie to each other."""

from typing import TYPE_CHECKING, Final, Literal

from tftool.errors import TransformException
from tftool.frames import export, names, refusals, sweep, velocity
from tftool.frames.chains import joined
from tftool.frames.plans import Plan
from tftool.frames.requests import NEVER, Callback
from tftool.frames.sample import FrameInfo, Snapshot, TransformStamped
from tftool.frames.store import Store
from tftool.geometry import quaternions, rigid
from tftool.geometry.rigid import Transform
from tftool.stamps import Duration, Stamp, whole

if TYPE_CHECKING:
    import numpy.typing as npt

    from tftool.frames.arrays import TransformArray

__all__ = ["NEVER", "Buffer"]

_NO_PLANS: dict[str, Plan] = {}
_new: Final = tuple.__new__


class Buffer(Store):
    """Named frames over time, as tf2 keeps them.

    It knows no clock and waits for nothing: time comes in with the samples and with
    the questions, in nanoseconds, and 0 in a question means the latest.
    """

    # Looking up

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Stamp = 0
    ) -> TransformStamped:
        """The pose of source in target: moves points given in source into target.

        Args:
            target_frame: What the answer is expressed in.
            source_frame: What is asked about.
            time: The moment; 0 for the newest one for which the whole chain has data.

        Returns:
            With the moment it holds for as its stamp, or 0 if it holds at all times.

        Raises:
            InvalidArgumentException: If a name is empty or starts with a slash.
            LookupException: If a name never came up, or the chain runs in a loop.
            ConnectivityException: If the two frames are of different trees.
            ExtrapolationException: If a link has no data for that moment.
            TypeError: If `time` is not a whole number.
        """
        if time.__class__ is not int:
            time = whole(time)
        pose: Transform | None = None
        try:
            plan = self._lookups.plans[target_frame][source_frame]
        except KeyError:
            pass
        else:
            moment = time or plan.latest()
            pose = plan.solve(moment)
        if pose is None:
            moment, sample = self._lookups.pose(target_frame, source_frame, time)
            pose = rigid.transform(sample[:3], sample[3:])
        return _new(TransformStamped, (moment, target_frame, source_frame, pose))

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Stamp,
        source_frame: str,
        source_time: Stamp,
        fixed_frame: str,
    ) -> TransformStamped:
        """Where source was at its time, in target as target is at its own time.

        Both are looked up against `fixed_frame`, which is taken not to move in between.

        Raises:
            TransformException: As `lookup_transform`; frames are always checked, even equal ones.
        """
        plans = self._lookups.plans
        if not (
            # Whose names were found good before.
            source_frame in plans.get(fixed_frame, _NO_PLANS)
            and fixed_frame in plans.get(target_frame, _NO_PLANS)
        ):
            for frame, argument in (
                (target_frame, "target_frame"),
                (source_frame, "source_frame"),
                (fixed_frame, "fixed_frame"),
            ):
                self._lookups.number(frame, argument, "lookupTransform", target_frame, source_frame)
        inner = self.lookup_transform(fixed_frame, source_frame, source_time).transform
        stamp, _, _, outer = self.lookup_transform(target_frame, fixed_frame, target_time)
        found = joined(outer.translation + outer.rotation, inner.translation + inner.rotation)
        turn = quaternions.canonical(quaternions.unit(found[3:]))
        pose = rigid.transform(found[:3], turn)
        return _new(TransformStamped, (stamp, target_frame, source_frame, pose))

    def lookup_transforms(
        self,
        target_frame: str,
        source_frame: str,
        times: "npt.ArrayLike",
        *,
        missing: Literal["raise", "nan"] = "raise",
        threads: int | None = None,
    ) -> "TransformArray":
        """Row by row what `lookup_transform` gives, for many moments at once, in numpy.

        Args:
            target_frame: What the answers are expressed in.
            source_frame: What is asked about.
            times: Whole nanoseconds, shape (n,), in any order; 0 for the latest.
            missing: What becomes of a moment for which there is no pose: "raise", or "nan"
                for a row of NaN that is not `valid`. A wrong name raises in any case.
            threads: How many to work with; None for one a core where that pays.

        Raises:
            TransformException: As `lookup_transform`, for the first row that is refused.
            TypeError: If the times are no whole numbers.
            ValueError: If the shape is another.
        """
        # The single lookup does without numpy; who asks for many has it.
        from tftool.frames import bulk

        return bulk.lookup_transforms(
            self._forest, self._lookups, target_frame, source_frame, times, missing, threads
        )

    def lookup_transforms_full(
        self,
        target_frame: str,
        target_times: "npt.ArrayLike",
        source_frame: str,
        source_times: "npt.ArrayLike",
        fixed_frame: str,
        *,
        missing: Literal["raise", "nan"] = "raise",
        threads: int | None = None,
    ) -> "TransformArray":
        """Row by row what `lookup_transform_full` gives.

        One of the two kinds of times may be a single moment; see `lookup_transforms`.

        Raises:
            TransformException: As `lookup_transform_full`, for the first row that is refused.
            TypeError: If the times are no whole numbers.
            ValueError: If the shapes do not fit.
        """
        from tftool.frames import bulk

        return bulk.lookup_transforms_full(
            self._forest,
            self._lookups,
            target_frame,
            target_times,
            source_frame,
            source_times,
            fixed_frame,
            missing,
            threads,
        )

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Stamp:
        """The newest moment for which every link between two frames has data; 0 if none moves.

        Raises:
            TransformException: If a name is unknown or invalid, or nothing joins the two.
        """
        plan = self._lookups.plans.get(target_frame, _NO_PLANS).get(source_frame)
        if plan is not None:
            return plan.latest()
        call = "get_latest_common_time"
        number = self._lookups.number
        return self._lookups.latest_common(
            number(target_frame, "target_frame", call, target_frame, source_frame),
            number(source_frame, "source_frame", call, target_frame, source_frame),
        )

    def newest_common(self, target_frame: str, source_frame: str) -> Stamp:
        """As `get_latest_common_time`, but 0 where that would refuse."""
        try:
            return self.get_latest_common_time(target_frame, source_frame)
        except TransformException:
            return 0

    def lookup_velocity(
        self, tracking_frame: str, observation_frame: str, time: Stamp, interval: Duration
    ) -> velocity.Velocity:
        """How `tracking_frame` moves in `observation_frame`, by tf2's formula.

        See `velocity.full` for what tf2's numbers mean, and `lookup_twist` for plain ones.
        """
        return velocity.full(
            self,
            tracking_frame,
            observation_frame,
            observation_frame,
            (0.0, 0.0, 0.0),
            tracking_frame,
            time,
            interval,
        )

    def lookup_velocity_full(
        self,
        tracking_frame: str,
        observation_frame: str,
        reference_frame: str,
        reference_point: tuple[float, float, float],
        reference_point_frame: str,
        time: Stamp,
        interval: Duration,
    ) -> velocity.Velocity:
        """How `tracking_frame` moves in `observation_frame`, told in `reference_frame`.

        tf2's formula to the letter; see `velocity.full`.
        """
        return velocity.full(
            self,
            tracking_frame,
            observation_frame,
            reference_frame,
            reference_point,
            reference_point_frame,
            time,
            interval,
        )

    def lookup_twist(
        self, tracking_frame: str, observation_frame: str, time: Stamp, interval: Duration
    ) -> velocity.Velocity:
        """The velocity of the origin of `tracking_frame`, and how it turns, in `observation_frame`.

        Raises:
            TransformException: As `lookup_transform`.
            TypeError: If a moment or the interval is not a whole number.
            ValueError: If the interval is not positive.
        """
        return velocity.twist(self, tracking_frame, observation_frame, time, interval)

    # Asking whether

    def can_transform(self, target_frame: str, source_frame: str, time: Stamp = 0) -> bool:
        """Whether `lookup_transform` would answer; it never raises for a name or a time."""
        if time.__class__ is not int:
            time = whole(time)
        plan = self._lookups.plans.get(target_frame, _NO_PLANS).get(source_frame)
        if plan is not None and plan.covers(time or plan.latest()):
            return True
        return self._lookups.why_not(target_frame, source_frame, time) is None

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Stamp,
        source_frame: str,
        source_time: Stamp,
        fixed_frame: str,
    ) -> bool:
        """Whether `lookup_transform_full` would answer."""
        return not self.why_not_full(
            target_frame, target_time, source_frame, source_time, fixed_frame
        )

    def why_not(self, target_frame: str, source_frame: str, time: Stamp = 0) -> str:
        """Why `can_transform` says no, in tf2's words; empty if it says yes."""
        reason = self._lookups.why_not(target_frame, source_frame, whole(time))
        return "" if reason is None else str(reason)

    def why_not_full(
        self,
        target_frame: str,
        target_time: Stamp,
        source_frame: str,
        source_time: Stamp,
        fixed_frame: str,
    ) -> str:
        """Why `can_transform_full` says no, in tf2's words; empty if it says yes."""
        for frame, argument in (
            (target_frame, "target_frame"),
            (source_frame, "source_frame"),
            (fixed_frame, "fixed_frame"),
        ):
            if why := self._lookups.fault(frame):
                return refusals.invalid_frame(frame, argument, why)
        # The other way round than in the lookup, as in tf2.
        return self.why_not(target_frame, fixed_frame, target_time) or self.why_not(
            fixed_frame, source_frame, source_time
        )

    # Waiting

    def request(
        self, callback: Callback, target_frame: str, source_frame: str, time: Stamp = 0
    ) -> int:
        """Be told once the transform can be looked up.

        Args:
            callback: Called from inside the set that makes it possible, in the order of the
                requests: with the handle, and True; or False once that moment is forgotten.
                What it raises goes where what a listener raises does; see `listen`.
            target_frame: As in `lookup_transform`.
            source_frame: As in `lookup_transform`.
            time: As in `lookup_transform`; 0 is never forgotten.

        Returns:
            0 if it can be looked up now, NEVER if it never can again (in both cases
            `callback` is not kept), else a handle for `cancel`.
        """
        return self._requests.add(callback, ((target_frame, source_frame, whole(time)),))

    def request_full(
        self,
        callback: Callback,
        target_frame: str,
        target_time: Stamp,
        source_frame: str,
        source_time: Stamp,
        fixed_frame: str,
    ) -> int:
        """The same for `lookup_transform_full`."""
        return self._requests.add(
            callback,
            (
                (target_frame, fixed_frame, whole(target_time)),
                (fixed_frame, source_frame, whole(source_time)),
            ),
        )

    def cancel(self, handle: int) -> None:
        """Let go of a request; its callback is not called any more."""
        self._requests.cancel(handle)

    # Looking at the whole

    def snapshot(self, now: Stamp, at: Stamp = 0) -> Snapshot:
        """All frames at one moment.

        Args:
            now: What the clock reads; ages are told against it.
            at: The moment to show; 0 for each frame at the latest moment of its chain.
        """
        return sweep.snapshot(self._forest, whole(now), whole(at))

    def frames(self) -> list[str]:
        """Every name that ever came up, in that order; of one sample the child first."""
        return [frame.name for frame in self._forest.frames]

    def frame_exists(self, frame: str) -> bool:
        """Whether a name ever came up; tf2's own NO_PARENT always did."""
        return frame in self._forest.numbers or frame == names.NO_PARENT_NAME

    def parent(self, frame: str, time: Stamp = 0) -> str | None:
        """What a frame hung from at a moment; None for a root, and where nobody knows."""
        number = self._forest.numbers.get(frame)
        if number is None:
            return None
        link = self._forest.frames[number].link
        above = -1 if link is None else link.parent_at(time)
        return None if above < 0 else self._forest.frames[above].name

    def chain(self, target_frame: str, source_frame: str, time: Stamp = 0) -> list[str]:
        """The frames from source to target, both included; empty if they are the same.

        Raises:
            TransformException: As `lookup_transform`.
        """
        return self._lookups.chain(target_frame, source_frame, whole(time))

    def all_frames_as_yaml(self, current_time: Stamp = 0) -> str:
        """tf2's YAML of all frames; see `export.as_yaml`."""
        return export.as_yaml(self._infos(), current_time)

    def all_frames_as_string(self) -> str:
        """tf2's sentences about all frames; see `export.as_string`."""
        return export.as_string(self._infos())

    def all_frames_as_dot(self, current_time: Stamp = 0) -> str:
        """tf2's dot of all frames; see `export.as_dot`."""
        return export.as_dot(self._infos(), current_time)

    def _infos(self) -> tuple[FrameInfo, ...]:
        return self.snapshot(0).frames
