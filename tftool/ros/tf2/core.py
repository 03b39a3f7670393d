"""tf2_py: the buffer's core, with lookups that succeed or fail at once."""

from collections.abc import Callable
from typing import Any

from tftool.base.errors import TransformException
from tftool.buffer.buffer import Buffer as Frames
from tftool.buffer.sample import TransformStamped
from tftool.ros.host import program, values
from tftool.ros.rclpy.time import Duration, Time
from tftool.ros.tf2.lookup_hints import LookupHints
from tftool.ros.tf2.lookup_requests import (
    LookupRequest,
    full_question,
    length,
    question,
)


class BufferCore:
    """Frames and the transforms between them.

    The methods that end in `_core` have the arguments of `Buffer`'s waiting methods except the
    timeout, and refuse at once.
    """

    def __init__(self, cache_time: Duration | None = None) -> None:
        self._program = program.current()
        kept = 10_000_000_000 if cache_time is None else length(cache_time)
        self._frames = Frames(kept, log=self._log)
        self._hints = LookupHints(self._program, self._frames)

    @property
    def frames(self) -> Frames:
        """The buffer itself."""
        return self._frames

    @property
    def hints(self) -> LookupHints:
        """Hints about its failed lookups."""
        return self._hints

    def _log(self, level: str, text: str) -> None:
        owner = self._program
        owner.say("ERROR" if level == "ERROR" else "WARN", owner.name, text)

    def _ask(self, request: Callable[[], Any]) -> Any:
        return self._program.ask(request)

    # Setting

    def set_transform(self, transform: Any, authority: str) -> None:
        """Insert a sample of a moving link; a rejection is logged."""
        sample = values.pack_transform(transform)
        self._ask(lambda: self._frames.set_transform(sample, authority))

    def set_transform_static(self, transform: Any, authority: str) -> None:
        """Insert a static link; a rejection is logged."""
        sample = values.pack_transform(transform)
        self._ask(lambda: self._frames.set_transform_static(sample, authority))

    def clear(self) -> None:
        """Drop all moving transforms."""
        self._ask(self._frames.clear)

    # Asking

    def _answer(self, asked: LookupRequest) -> Any:
        return values.unpack_transform(self._ask(lambda: self._looked_up(asked)))

    def _looked_up(self, asked: LookupRequest) -> TransformStamped:
        try:
            found = asked.answer(self._frames)
        except TransformException as error:
            self._hints.refuse(asked.target, asked.source, error)
            raise
        if asked.fixed is None:
            self._hints.answer(asked.target, asked.source, asked.time)
        return found

    def _whether(self, asked: LookupRequest) -> tuple[int, str]:
        reason: str = self._ask(lambda: self._why_not(asked))
        if reason:
            self._program.looked_in_vain()
        return int(not reason), reason

    def _why_not(self, asked: LookupRequest) -> str:
        reason = asked.why_not(self._frames)
        self._hints.wait()
        if reason:
            self._hints.look_in_vain(asked.target, asked.source)
        return reason

    def lookup_transform_core(self, *asked: Any, **named: Any) -> Any:
        """Return the pose of source in target as a geometry_msgs TransformStamped.

        Raises:
            TransformException: If it cannot be given.
        """
        return self._answer(question(*asked, **named))

    def lookup_transform_full_core(self, *asked: Any, **named: Any) -> Any:
        """Return the pose of source at one time in target at another, through a fixed frame.

        Raises:
            TransformException: If it cannot be given.
        """
        return self._answer(full_question(*asked, **named))

    def can_transform_core(self, *asked: Any, **named: Any) -> tuple[int, str]:
        """Return (whether a lookup would succeed, why not)."""
        return self._whether(question(*asked, **named))

    def can_transform_full_core(self, *asked: Any, **named: Any) -> tuple[int, str]:
        """Return (whether a lookup between two times would succeed, why not)."""
        return self._whether(full_question(*asked, **named))

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Time:
        """Return the newest time at which both are known."""
        stamp = self._ask(lambda: self._frames.get_latest_common_time(target_frame, source_frame))
        return Time(nanoseconds=stamp)

    # Looking round

    def all_frames_as_yaml(self) -> str:
        """Return every frame as tf2's YAML."""
        return str(self._ask(self._frames.all_frames_as_yaml))

    def all_frames_as_string(self) -> str:
        """Return every frame and its parent."""
        return str(self._ask(self._frames.all_frames_as_string))

    def _allFramesAsDot(self, time: float = 0.0) -> str:  # noqa: N802
        return str(self._ask(self._frames.all_frames_as_dot))

    def _getFrameStrings(self) -> list[str]:  # noqa: N802
        return list(self._ask(self._frames.frames))

    def _frameExists(self, frame: str) -> bool:  # noqa: N802
        return bool(self._ask(lambda: self._frames.frame_exists(frame)))
