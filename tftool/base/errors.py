"""All exceptions of tftool, in one class tree.

Lookups raise exceptions with tf2's names; other code raises other subclasses of TftoolError. The
details of an error, such as the frame, are attributes. Only the module `app` converts exceptions to
exit statuses.
"""

import os
import unicodedata
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

from tftool.base.plain_text import near_names
from tftool.base.stamps import NANOSECONDS, Duration, Stamp, as_seconds


class TftoolError(Exception):
    """Base class of tftool's exceptions; the text names the fault and the remedy.

    The text is fixed when the error is created. An error can be pickled and copied with all its
    attributes, whatever arguments its class takes.
    """

    def __reduce__(self) -> tuple[Any, ...]:
        return _made_again, (type(self), self.args), self._facts()

    def _facts(self) -> dict[str, object]:
        """Return the attributes of the error that are pickled, by name."""
        return dict(self.__dict__)


def _made_again(kind: type[TftoolError], args: tuple[object, ...]) -> TftoolError:
    # `__init__` is not called: its arguments differ, and `args` already contains the text.
    return kind.__new__(kind, *args)


class UsageError(TftoolError):
    """Error for wrong arguments of a command or function (exit status 2)."""


class NodeArgumentsError(UsageError):
    """Error for arguments that a node's program does not accept.

    Attributes:
        status: The exit status that ROS's own program returns for the same arguments.
    """

    def __init__(self, message: str, *, status: int) -> None:
        super().__init__(message)
        self.status = status


class InputError(TftoolError):
    """Error for input that cannot be read, for example a file or a number in it (exit status 3)."""


@dataclass(frozen=True, slots=True)
class Mistake:
    """One mistake in a text file, with its position.

    Attributes:
        file: Name of the file, as the user gave it.
        line: Number of the line, from 1.
        column: Number of the column, from 1.
        text: The fault, as a sentence without its full stop.
        shown: The offending line, safe to print on a terminal; empty if the file has no such line.
        marks: Blanks and carets, to print below `shown`; the carets mark the column.
    """

    file: str
    line: int
    column: int
    text: str
    shown: str = ""
    marks: str = ""

    def __str__(self) -> str:
        head = f"{self.file}:{self.line}:{self.column}: {self.text}"
        if not self.marks:
            return head
        return f"{head}\n  {self.line:>4} | {self.shown}\n       | {self.marks}"

    @classmethod
    def at(
        cls, file: str, lines: Sequence[str], line: int, column: int, text: str, *, width: int = 1
    ) -> "Mistake":
        """Return a mistake with up to 120 characters of the source line, and carets below.

        Args:
            file: Name of the file, as the user gave it.
            lines: All lines of the file.
            line: Number of the line, from 0.
            column: Number of the column, from 0.
            text: The fault, as a sentence without its full stop.
            width: Number of characters to mark.
        """
        whole = lines[line] if line < len(lines) else ""
        start = max(0, column - 60)
        shown = whole[start : start + 120]
        before = sum(_cells(char) for char in whole[start:column])
        inside = whole[column : min(column + width, start + 120)].rstrip()
        marks = " " * before + "^" * max(1, sum(_cells(char) for char in inside))
        return cls(file, line + 1, column + 1, text, showable(shown), marks)


def showable(text: str) -> str:
    """Replace every control character, which a terminal might execute, by a visible character."""
    return "".join(
        char if char.isprintable() else (" " if char == "\t" else "\ufffd") for char in text
    )


def _cells(char: str) -> int:
    """Return the number of terminal columns that a character fills."""
    if unicodedata.combining(char):
        return 0
    return 2 if unicodedata.east_asian_width(char) in "WF" else 1


class DocumentError(InputError):
    """Error with all mistakes of a text file at once (exit status 3).

    Attributes:
        name: Name of the file, as the user gave it.
        mistakes: Every mistake, in the order of the file.
    """

    MOST = 50
    """Maximum number of mistakes in the text: a file of another kind would fill the screen."""

    def __init__(self, name: str, mistakes: Sequence[Mistake]) -> None:
        self.name = name
        self.mistakes = tuple(mistakes)
        count = len(self.mistakes)
        lines = [f"{name} has {'a mistake' if count == 1 else f'{count} mistakes'}:"]
        lines += [str(mistake) for mistake in self.mistakes[: self.MOST]]
        if count > self.MOST:
            lines.append(f"... and {count - self.MOST} more")
        super().__init__("\n".join(lines))


class ScenarioError(DocumentError):
    """Error with all mistakes of a scenario file."""


class DescriptionError(DocumentError):
    """Error with all mistakes of a robot description."""


def failure_text(error: BaseException) -> str:
    """Format an exception in one line: type, text, and the file and line that raised the exception.

    The line is the innermost line of the user's code, else the innermost line of the traceback. For
    an exception of tftool's own classes, only a line of the user's code is named.
    """
    kind, text = type(error).__name__, str(error)
    line = line_of(error, users_only=isinstance(error, TftoolError))
    return kind + (f": {text}" if text else "") + (f" ({line})" if line else "")


def line_of(error: BaseException, *, users_only: bool = False) -> str:
    """Return the innermost line of the user's code in an error's traceback, as "busy.py:10".

    Without a line of the user's code, return the innermost line of any code, or "" if `users_only`.
    """
    users = innermost = ""
    trace = error.__traceback__
    while trace is not None:
        file = trace.tb_frame.f_code.co_filename
        innermost = f"{os.path.basename(file)}:{trace.tb_lineno}"
        users = innermost if is_users_file(file) else users
        trace = trace.tb_next
    return users or ("" if users_only else innermost)


def is_users_file(file: str) -> bool:
    """Return whether a source file is outside tftool and Python's standard library."""
    if file.startswith((_PACKAGE, "<frozen")):
        return False
    return "site-packages" in file or not file.startswith(_LIBRARY)


_PACKAGE = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
_LIBRARY = os.path.dirname(os.path.realpath(os.__file__))


class NodeFailed(TftoolError):
    """Error that ends a run because a node raised an exception, which is stored as `__cause__`."""

    def __init__(self, node: str, error: BaseException, what: str = "") -> None:
        """Create the error for a node that raised `error`; `what` replaces the text of `error`."""
        super().__init__(f"node '{node}' {what or f'failed: {failure_text(error)}'}")
        self.node = node


class TransformException(TftoolError):
    """Error for a transform that is not available (exit status 4); base class of lookup errors.

    The text is exactly the text of tf2's exception; `remedy` says what to do.

    Attributes:
        frame: The unknown or misspelt frame, or the frame without data, that causes the error; None
            if no single frame causes the error.
        target: The target frame of the lookup; None if unknown.
        source: The source frame of the lookup; None if unknown.
    """

    def __init__(
        self,
        message: str,
        *,
        frame: str | None = None,
        target: str | None = None,
        source: str | None = None,
    ) -> None:
        super().__init__(message)
        self.frame = frame
        self.target = target
        self.source = source

    @property
    def remedy(self) -> str:
        """Return a sentence of advice, often with facts, such as a duration; "" without advice."""
        return ""


class LookupException(TransformException):
    """Error for an unknown `frame`, or a tree with a loop.

    Attributes:
        looped: Whether the frames form a loop, or a chain of more than 1000 frames.
    """

    def __init__(
        self,
        message: str,
        *,
        frame: str | None = None,
        target: str | None = None,
        source: str | None = None,
        known: Collection[str] = (),
        looped: bool = False,
    ) -> None:
        """Create the error for an unknown frame or a loop.

        Args:
            message: Text of tf2's exception.
            frame: The unknown frame.
            target: The target frame of the lookup.
            source: The source frame of the lookup.
            known: Frame names received so far. Names that the caller appends later are ignored.
            looped: Whether the frames form a loop.
        """
        super().__init__(message, frame=frame, target=target, source=source)
        self.looped = looped
        self._known = known
        self._count = len(known)

    @property
    def remedy(self) -> str:
        """Return advice on a loop, similar frame names, or else the number of known frames."""
        if self.looped:
            return (
                "The frames form a loop: a frame is below one of its own children. "
                "Check which nodes publish the transforms in the loop."
            )
        if self.frame is None:
            return ""
        # Computed only for printing: a waiting program may create this error thousands of times.
        known = self._names()
        near = near_names(self.frame, known, 3)
        if near:
            names = " or ".join(f"'{name}'" for name in near)
            return f"No transform of '{self.frame}' has arrived yet; did you mean {names}?"
        if not known:
            return f"No transform has arrived yet, so '{self.frame}' is unknown."
        return (
            f"No transform of '{self.frame}' has arrived yet; {len(known)} other frames are known."
        )

    def _names(self) -> list[str]:
        """Return the frame names that had been received when the error was created."""
        return list(islice(self._known, self._count))

    def _facts(self) -> dict[str, object]:
        return {**super()._facts(), "_known": self._names()}


class ConnectivityException(TransformException):
    """Error for two frames in different trees."""

    @property
    def remedy(self) -> str:
        """Return a sentence that advises to look at the roots of the two trees."""
        return (
            f"No chain of transforms connects '{self.source}' with '{self.target}' at that time: "
            "'tftool tree' shows the tree of each frame."
        )


class InvalidArgumentException(TransformException):
    """Error for an invalid name of a `frame`: empty, or with a leading slash."""

    @property
    def remedy(self) -> str:
        """Return advice to omit the leading slash, or to give a name if the name is empty."""
        plain = (self.frame or "").lstrip("/")
        return f"Use '{plain}'." if plain else "Give the name of a frame."


class TimeoutException(TransformException):
    """Error for a wait that exceeded its timeout before the transform was available.

    Attributes:
        refusal: The error of the last failed lookup; None if no lookup failed.
    """

    def __init__(
        self,
        message: str,
        *,
        target: str | None = None,
        source: str | None = None,
        refusal: TransformException | None = None,
    ) -> None:
        super().__init__(message, target=target, source=source)
        self.refusal = self.__cause__ = refusal

    @property
    def remedy(self) -> str:
        """Return the advice of the last failed lookup; "" if no lookup failed."""
        return "" if self.refusal is None else self.refusal.remedy


_FEW_NANOSECONDS = 100_000
"""Limit below which a time was probably meant in seconds."""


class ExtrapolationException(TransformException):
    """Error for a lookup at a time before the first or after the last sample of the child `frame`.

    Attributes:
        requested: The requested time, nanoseconds.
        available: The time of the nearest sample, nanoseconds; 0 if there are no samples.
    """

    def __init__(
        self,
        message: str,
        *,
        requested: Stamp,
        available: Stamp,
        frame: str | None = None,
        target: str | None = None,
        source: str | None = None,
    ) -> None:
        super().__init__(message, frame=frame, target=target, source=source)
        self.requested = requested
        self.available = available
        if hint := self._hint():
            # A traceback prints notes; the error's text is exactly tf2's.
            self.add_note(hint)

    def _hint(self) -> str:
        """Return a hint if the caller probably passed seconds instead of nanoseconds; else ""."""
        if not 0 < self.requested < _FEW_NANOSECONDS or self.missed < NANOSECONDS // 1000:
            return ""
        asked = self.requested
        return f"Times are whole nanoseconds: {asked} is {asked} ns, seconds({asked}) is {asked} s."

    @property
    def missed(self) -> Duration:
        """Return the nanoseconds between the requested time and the nearest sample."""
        return abs(self.requested - self.available)

    def _by(self) -> str:
        # The message rounds both times to microseconds, so that they often look equal.
        return f"{as_seconds(self.missed):.3f} s" if self.missed >= 500_000 else f"{self.missed} ns"


class BackwardExtrapolationException(ExtrapolationException):
    """Error for a lookup at a time before the oldest sample of the child `frame`."""

    @property
    def remedy(self) -> str:
        """Return a sentence with the time between lookup and oldest sample, and with advice."""
        return self._hint() or (
            f"The requested time is {self._by()} before the oldest sample of '{self.frame}': look "
            "up a later time, or time 0 (the latest), or give the buffer a longer cache_time."
        )


class ForwardExtrapolationException(ExtrapolationException):
    """Error for a lookup at a time after the newest sample of the child `frame`."""

    @property
    def remedy(self) -> str:
        """Return a sentence with the time between newest sample and lookup, and with advice."""
        return (
            f"The requested time is {self._by()} after the newest sample of '{self.frame}': look "
            "up time 0 (the latest), or wait for the next sample."
        )


class NoDataForExtrapolationException(ExtrapolationException):
    """Error for a child `frame` without samples, or with a single sample at another time."""

    @property
    def remedy(self) -> str:
        """Return a sentence with the time between lookup and nearest sample, and with advice."""
        if self.available == 0:
            return f"There are no samples of '{self.frame}': wait until a sample is sent."
        side = "after" if self.requested > self.available else "before"
        return self._hint() or (
            f"The requested time is {self._by()} {side} the only sample of '{self.frame}': look up "
            "time 0 (the latest), or wait for more samples."
        )


class MalformedMessage(InputError):
    """Error for bytes that cannot be decoded as a message, or a message that cannot be serialised.

    Attributes:
        kind: The expected message type.
        reason: The fault.
    """

    def __init__(self, kind: str, reason: str) -> None:
        super().__init__(f"{kind} refused: {reason}")
        self.kind = kind
        self.reason = reason


class LinkError(InputError):
    """Error for a session (processes that exchange transforms) that cannot be opened or joined."""


def without_frames(given: object) -> TypeError:
    """Return a TypeError for an argument that is neither a recording nor a buffer."""
    hint = ""
    if isinstance(given, str | os.PathLike):
        hint = f": tftool.open_recording({os.fspath(given)!r}) opens a recording"
    return TypeError(f"expected a Recording or a Buffer, not {given!r:.80}{hint}")
