"""Options for reading frames from a file, and times on the command line."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from tftool.base.errors import UsageError
from tftool.base.stamps import NANOSECONDS, Duration, Stamp, as_seconds


@dataclass(frozen=True, slots=True)
class At:
    """A time from the command line: seconds since the start of the source, or a stamp.

    Attributes:
        nanoseconds: The time, nanoseconds.
        is_stamp: Whether the time is a stamp; else it counts from the start of the source.
    """

    nanoseconds: int
    is_stamp: bool = False

    def stamp(self, epoch: Stamp) -> Stamp:
        """Return the stamp of this time in a source whose first stamp is `epoch`."""
        return self.nanoseconds if self.is_stamp else epoch + self.nanoseconds

    def meant(self, epoch: Stamp, end: Stamp) -> str:
        """Return a hint if the time was probably meant as a stamp, else ""; a space comes first."""
        if self.is_stamp or not epoch <= self.nanoseconds <= end:
            return ""
        since = At(self.nanoseconds - epoch)
        return f" Numbers below 1e8 count from the start: for this stamp, write {str(since)[:-2]}."

    def __str__(self) -> str:
        whole, rest = divmod(self.nanoseconds, NANOSECONDS)
        digits = f"{whole}.{rest:09}".rstrip("0").rstrip(".")
        return digits if self.is_stamp else f"{digits} s"


def checked_moment(
    at: At, title: str, epoch: Stamp, duration: Duration | None, received: Duration = 0
) -> Stamp:
    """Return the stamp of a time that must be within the source.

    Args:
        at: The time.
        title: Name of the recording or session, as the beginning of a sentence.
        epoch: Stamp of the start.
        duration: Time from start to end; None for no end.
        received: Time from the first to the last message of a recording, nanoseconds.

    Raises:
        UsageError: If the time is before the start or after the end.
    """
    stamp = at.stamp(epoch)
    if duration is not None and stamp > epoch + duration:
        if at.is_stamp:
            end = At(epoch + duration, is_stamp=True)
            raise UsageError(f"{title} ends at {end}: the time {at} is after this end.")
        meant = at.meant(epoch, epoch + duration)
        lasts = f"{title} lasts {as_seconds(duration):g} s"
        # Messages on other topics may continue long after the last transform.
        if received > duration + NANOSECONDS:
            lasts = (
                f"The transforms of {title} end at {as_seconds(duration):g} s (messages were "
                f"received for {as_seconds(received):.1f} s)"
            )
            raise UsageError(f"{lasts}: the time {at} is after the last transform.{meant}")
        raise UsageError(f"{lasts}: the time {at} is after its end.{meant}")
    if stamp < epoch:
        raise UsageError(
            f"{title} begins at {At(epoch, is_stamp=True)}: the time {at} is before this start."
        )
    return stamp


@dataclass(frozen=True, slots=True)
class DescriptionOptions:
    """Options for reading a robot description, given as the source or by the option --urdf.

    Attributes:
        joints: Joint positions by name, radians or metres.
        arguments: Values of xacro arguments, by name.
        urdf: Path of a description to use with a recording.
    """

    joints: Mapping[str, float] = field(default_factory=dict)
    arguments: Mapping[str, str] = field(default_factory=dict)
    urdf: Path | None = None

    def refuse(self, what: str) -> None:
        """Raise an error if one of these options was given for a source without a description.

        Args:
            what: Name of the source, as the beginning of a sentence.

        Raises:
            UsageError: If an option was given.
        """
        given = [f"--joint {name}={value:g}" for name, value in self.joints.items()]
        given += [f"{name}:={value}" for name, value in self.arguments.items()]
        given += [] if self.urdf is None else [f"--urdf {self.urdf}"]
        if given:
            raise UsageError(f"{what}: leave out {', '.join(given)}.")


@dataclass(frozen=True, slots=True)
class RecordingOptions:
    """Options for reading a recording.

    Attributes:
        no_cache: Whether to ignore the cache of decoded recordings.
        with_odometry: Whether to use odometry and pose messages as transforms.
        tf_topics: Topics of transforms to read; empty for all.
    """

    no_cache: bool = False
    with_odometry: bool = False
    tf_topics: tuple[str, ...] = ()

    def refuse(self, what: str) -> None:
        """Raise an error if an option that changes the result was given without a recording.

        Args:
            what: Name of the source, as the beginning of a sentence.

        Raises:
            UsageError: If such an option was given.
        """
        if self.with_odometry:
            raise UsageError(f"{what}: leave out --with-odometry, which is for recordings.")
        if self.tf_topics:
            raise UsageError(f"{what}: leave out --tf-topic, which is for recordings.")
