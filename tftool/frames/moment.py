"""Times as users give them: seconds since the start of a source, or a stamp."""

from dataclasses import dataclass

from tftool.base.errors import UsageError
from tftool.base.stamps import NANOSECONDS, Duration, Stamp, as_seconds


@dataclass(frozen=True, slots=True)
class At:
    """A time as given for `--at`: seconds since the start of the source, or a stamp.

    Attributes:
        nanoseconds: The time, nanoseconds.
        is_stamp: Whether the time is a stamp; else it counts from the start of the source.
    """

    nanoseconds: int
    is_stamp: bool = False

    def stamp(self, epoch: Stamp) -> Stamp:
        """Return the stamp of this time in a source that begins at `epoch`."""
        return self.nanoseconds if self.is_stamp else epoch + self.nanoseconds

    def __str__(self) -> str:
        whole, rest = divmod(self.nanoseconds, NANOSECONDS)
        digits = f"{whole}.{rest:09}".rstrip("0").rstrip(".")
        return digits if self.is_stamp else f"{digits} s"


def checked_moment(
    at: At, title: str, epoch: Stamp, duration: Duration | None, received: Duration = 0
) -> Stamp:
    """Return the stamp of a time, after checking that it is between start and end.

    Args:
        at: The time.
        title: Name of the recording or session, as the beginning of a sentence.
        epoch: Stamp of the start.
        duration: Time from start to end; None for no end.
        received: Time over which a recording received messages of any topic.

    Raises:
        UsageError: If the time is outside the span.
    """
    stamp = at.stamp(epoch)
    if duration is not None and stamp > epoch + duration:
        if at.is_stamp:
            end = At(epoch + duration, is_stamp=True)
            raise UsageError(f"{title} ends at {end}: {at} is after that.")
        lasts = f"{title} lasts {as_seconds(duration):g} s"
        # Messages on other topics may continue long after the last transform.
        if received > duration + NANOSECONDS:
            lasts = (
                f"The transforms of {title} end at {as_seconds(duration):g} s (messages were "
                f"received for {as_seconds(received):.1f} s)"
            )
            raise UsageError(f"{lasts}: {at} is after their end.")
        raise UsageError(f"{lasts}: {at} is after its end.")
    if stamp < epoch:
        raise UsageError(f"{title} begins at {At(epoch, is_stamp=True)}: {at} is before that.")
    return stamp
