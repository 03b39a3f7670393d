"""Every exception of tftool, as one tree.

tf2's names for what tf2 refuses; three more for what the tools refuse. Each
carries its facts as fields. `cli.app` turns them into exit statuses and is the
only place that does.
"""

from tftool.stamps import Stamp


class TftoolError(Exception):
    """Something a user can act on; its text is a sentence that says what and what to do."""


class UsageError(TftoolError):
    """The command was asked for something it does not do (exit status 2)."""


class NodeArgumentsError(UsageError):
    """A node's program was started with arguments it does not take.

    Attributes:
        status: The exit status of the original program, where it is run as such.
    """

    def __init__(self, message: str, *, status: int) -> None:
        super().__init__(message)
        self.status = status


class InputError(TftoolError):
    """Something given cannot be read: a file, a scenario, a number in it (exit status 3)."""


class NodeFailed(TftoolError):
    """A node raised; the run is over. The original error is the cause.

    Attributes:
        node: Name of the node that raised.
    """

    def __init__(self, node: str, error: BaseException) -> None:
        super().__init__(f"node '{node}' failed: {type(error).__name__}: {error}")
        self.node = node


class TransformException(TftoolError):
    """The transform asked for cannot be given (exit status 4); tf2's base class.

    Attributes:
        target: The frame asked for, where it is known.
        source: The frame asked about, where it is known.
    """

    def __init__(
        self, message: str, *, target: str | None = None, source: str | None = None
    ) -> None:
        super().__init__(message)
        self.target = target
        self.source = source


class LookupException(TransformException):
    """A frame is not known, or the tree has a loop.

    Attributes:
        frame: The unknown frame, where that is the reason.
    """

    def __init__(
        self,
        message: str,
        *,
        frame: str | None = None,
        target: str | None = None,
        source: str | None = None,
    ) -> None:
        super().__init__(message, target=target, source=source)
        self.frame = frame


class ConnectivityException(TransformException):
    """The two frames hang in different trees."""


class InvalidArgumentException(TransformException):
    """A frame name that can never be asked for: empty, or with a leading slash."""


class TimeoutException(TransformException):
    """Waiting for a transform took longer than allowed; the last refusal is the cause."""


class ExtrapolationException(TransformException):
    """The moment asked for lies outside what a link of the chain remembers.

    Attributes:
        requested: The moment asked for.
        available: The stored moment nearest to it; 0 when nothing is stored.
    """

    def __init__(
        self,
        message: str,
        *,
        requested: Stamp,
        available: Stamp,
        target: str | None = None,
        source: str | None = None,
    ) -> None:
        super().__init__(message, target=target, source=source)
        self.requested = requested
        self.available = available


class BackwardExtrapolationException(ExtrapolationException):
    """The moment lies before the oldest sample of a link."""


class ForwardExtrapolationException(ExtrapolationException):
    """The moment lies after the newest sample of a link."""


class NoDataForExtrapolationException(ExtrapolationException):
    """A link holds no sample, or a single one at another moment."""


class MalformedMessage(InputError):
    """Bytes that came in are not the message they should be, or one cannot be written.

    Attributes:
        kind: The type it should be.
        reason: What is wrong with it.
    """

    def __init__(self, kind: str, reason: str) -> None:
        super().__init__(f"{kind} refused: {reason}")
        self.kind = kind
        self.reason = reason
