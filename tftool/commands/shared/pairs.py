"""The pairs of frames a command works on, and at which moments: its words become values."""

from pathlib import Path
from typing import TYPE_CHECKING

from tftool.base.errors import UsageError
from tftool.base.escaping import visible
from tftool.base.stamps import Duration, Stamp, seconds
from tftool.recordings.find import METADATA

if TYPE_CHECKING:
    from tftool.commands.shared.robot_at_rest import StoredFrames
    from tftool.frames.pair_samples import Moments


def pairs_and_place(words: list[str], given: list[str]) -> tuple[list[tuple[str, str]], str | None]:
    """The pairs that were named, and FROM.

    Args:
        words: TARGET SOURCE [FROM], or [FROM] alone.
        given: What --pair said, as TARGET:SOURCE.

    Raises:
        UsageError: If they do not fit together.
    """
    if len(words) > (1 if given else 3):
        raise UsageError(
            "With --pair, one word at most is FROM."
            if given
            else f"TARGET SOURCE [FROM] are three words at most, not {len(words)}."
        )
    if not given:
        if len(words) < 2:
            return [], words[0] if words else None
        place = words[2] if len(words) > 2 else None
        refuse_file_as_frame(words[0], words[1], place)
        return [(words[0], words[1])], place
    pairs = []
    for text in given:
        target, colon, source = text.partition(":")
        if not (colon and target and source):
            raise UsageError(f"--pair {text}: write TARGET:SOURCE, as in map:base_link.")
        pairs.append((target, source))
    return pairs, words[0] if words else None


def refuse_file_as_frame(target: str, source: str, place: str | None) -> None:
    """See that no file stands where a frame's name is wanted, as where one of three was forgotten.

    Raises:
        UsageError: If one does.
    """
    if place is not None:
        return
    for word in (target, source):
        path = Path(word)
        if (path.suffix and path.is_file()) or (path / METADATA).is_file():
            raise UsageError(
                f"'{visible(word)}' is a recording, or another file, and stands where a frame's "
                "name does: FROM comes behind two frames, TARGET SOURCE FROM."
            )


def refuse_several_choices(*given: object) -> None:
    """Refuse more than one of --every, --rate and --at-stamps-of; None is not given.

    Raises:
        UsageError: If there are more.
    """
    if sum(one is not None for one in given) > 1:
        raise UsageError("--every, --rate and --at-stamps-of each choose the moments: give one.")


def moments_of(
    stored: "StoredFrames",
    ends: tuple[Stamp | None, Stamp | None],
    every: Duration | None,
    rate: float | None,
    topic: str | None,
) -> "Moments":
    """At which moments a pair is asked for.

    Args:
        stored: Whose frames.
        ends: First and last stamp.
        every: The period, nanoseconds.
        rate: The same, hertz.
        topic: Ask at the stamps of its messages.

    Raises:
        InputError: If there is no such topic.
        UsageError: If more than one of them is given, or a topic where nothing is recorded.
    """
    from tftool.frames.pair_samples import Moments
    from tftool.recordings.recording import Recording

    refuse_several_choices(every, rate, topic)
    if topic is not None:
        if not isinstance(stored, Recording):
            raise UsageError("--at-stamps-of goes with a recording.")
        stamps = stored.headers(topic).stamps
        return Moments(*ends, stamps=stamps, words=f"at the stamps of '{topic}'")
    period = every if rate is None else seconds(1.0 / rate)
    return Moments(*ends, period)
