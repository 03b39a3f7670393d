"""The doors between our nodes' small values and the messages that topics and services carry.

A node of ours names `Pose2D` or `Spawn`; the world gives it one of these, and what is behind
it carries `turtlesim/msg/Pose` and `turtlesim/srv/Spawn`, as users' nodes and other processes
know them. `messages/turtle_messages.py` says which value is which message.
"""

import asyncio
import inspect
from collections.abc import AsyncIterator, Callable
from typing import Any, Final, Generic, TypeVar

from tftool.messages import turtle_messages as values
from tftool.world.endpoints import Endpoint
from tftool.world.topics import (
    Acceptor,
    GoalHandle,
    GoalResult,
    Handler,
    Status,
    Topic,
    Unmade,
    streamed,
)

T = TypeVar("T")

_new: Final = tuple.__new__


class ValueTopic(Generic[T]):
    """A topic of messages, for those who publish and take values; see `Topic`.

    Attributes:
        topic: The topic of messages behind it.
        kind: The type of the values.
    """

    __slots__ = ("_message", "_pack", "_value", "kind", "topic")

    def __init__(self, topic: Topic[Any], kind: type[T]) -> None:
        self.topic = topic
        self.kind = kind
        self._pack = values.packer(kind, topic.kind)
        # The message that was converted last: every subscriber is told the same one.
        self._message: Any = None
        self._value: T | None = None

    @property
    def name(self) -> str:
        """The topic's name, without a leading slash."""
        return self.topic.name

    @property
    def latest(self) -> T | None:
        """The value published last, None before the first."""
        held = self.topic.held
        return None if held is None else self.value_of(held)

    @property
    def count(self) -> int:
        """How many values were published."""
        return self.topic.count

    @property
    def subscribers(self) -> int:
        """How many listen at the moment, those in other processes included."""
        return self.topic.subscribers

    @property
    def sender(self) -> Endpoint | None:
        """The publisher of the value that is being delivered; None when not known."""
        return self.topic.sender

    def publish(self, value: T, sender: Endpoint | None = None) -> None:
        """Keep `value` and tell every subscriber at once, and who sent it if that is known.

        Raises:
            TypeError: If `value` is not of the topic's kind.
        """
        if not isinstance(value, self.kind):
            raise TypeError(
                f"topic '{self.name}' carries {self.kind.__name__}, not {type(value).__name__}"
            )
        topic = self.topic
        if topic.readers or topic.relay is not None:
            topic.publish(self.message_of(value), sender)
        else:
            topic.tell(_new(Unmade, (value, self._pack)), sender)

    def message_of(self, value: T) -> Any:
        """The message that says the same as a value."""
        message = self._pack(value)
        self._message, self._value = message, value
        return message

    def value_of(self, message: Any) -> T:
        """The value that says the same as a message."""
        if isinstance(message, Unmade):
            held: T = message.value
            return held
        if message is not self._message or self._value is None:
            self._message, self._value = message, values.as_value(message, self.kind)
        value: T = self._value
        return value

    def taker(self, callback: Callable[[T], object]) -> Callable[[Any], object]:
        """What takes messages, and calls `callback` with their values."""
        value_of = self.value_of

        def take(message: Any) -> object:
            # Nearly always: one call less for each pose.
            return callback(message.value if type(message) is Unmade else value_of(message))

        return take

    def subscribe(self, callback: Callable[[T], object], owner: str = "") -> Callable[[], None]:
        """Have `callback` called with every value to come; see `Topic.subscribe`."""
        return self.topic.subscribe(self.taker(callback), owner, takes_unmade=True)

    def stream(self, depth: int = 100) -> AsyncIterator[T]:
        """Values to come, one by one; see `Topic.stream`."""
        return streamed(self.subscribe, depth)


def serving(handler: Handler, kind: type[Any]) -> Handler:
    """What answers a service's messages by a handler of values.

    Args:
        handler: Takes a value, and gives the value that answers it, now or when awaited.
        kind: The type of its requests.
    """
    response = values.interface_class(kind).Response

    async def later(answer: Any) -> Any:
        return values.as_message(await answer, response)

    def handle(request: Any) -> Any:
        answer = handler(values.as_value(request, kind))
        return later(answer) if inspect.isawaitable(answer) else values.as_message(answer, response)

    return handle


def accepting(accept: Acceptor, kind: type[Any]) -> Acceptor:
    """What takes an action's goals by an acceptor of values, whose goals are of type `kind`."""
    return lambda handle: accept(ValueGoal(handle, kind))


class ValueGoal:
    """One goal of an action, for a node of ours that asks or answers in values; see `GoalHandle`.

    Attributes:
        request: What was asked for.
    """

    def __init__(self, handle: GoalHandle, kind: type[Any]) -> None:
        """See a goal as one of values.

        Args:
            handle: The goal in messages, which the other side holds.
            kind: The type of our goals.
        """
        self._handle = handle
        self._action = values.interface_class(kind)
        self._values = values.ACTIONS[kind][1:]
        self.request = values.as_value(handle.request, kind)

    @property
    def cancel_requested(self) -> bool:
        """Whether the client wants it stopped, and the server agreed."""
        return self._handle.cancel_requested

    @property
    def decided(self) -> "asyncio.Future[bool] | None":
        """Whether the server takes the goal; None for one that takes every goal."""
        return self._handle.decided

    @property
    def feedback(self) -> Any:
        """The last feedback, None before the first."""
        said = self._handle.feedback
        return None if said is None else values.as_value(said, self._values[1])

    def cancel(self) -> None:
        """Ask the server to stop."""
        self._handle.cancel()

    async def cancellation(self) -> bool:
        """Wait for what the server says to the last cancellation; whether it agrees."""
        return await self._handle.cancellation()

    async def result(self) -> GoalResult:
        """Wait for the end."""
        return self._in_values(await self._handle.result())

    @property
    def done(self) -> bool:
        """Whether the goal has ended."""
        return self._handle.done

    @property
    def ended(self) -> GoalResult | None:
        """How it ended; None while it is under way."""
        end = self._handle.ended
        return None if end is None else self._in_values(end)

    def publish_feedback(self, value: Any) -> None:
        """Tell the client how far it is."""
        self._handle.publish_feedback(values.as_message(value, self._action.Feedback))

    def finish(self, status: Status, value: Any) -> None:
        """End the goal; the first end counts."""
        self._handle.finish(status, values.as_message(value, self._action.Result))

    def _in_values(self, end: GoalResult) -> GoalResult:
        return GoalResult(end.status, values.as_value(end.value, self._values[0]))


Goal = GoalHandle | ValueGoal
"""A goal as its client holds it: in messages, or in values where it asked in them."""
