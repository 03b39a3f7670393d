"""Drawable messages of a running session: the last of each topic."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Final

from tftool.base.errors import InputError, TftoolError, TransformException
from tftool.buffer.buffer import Buffer
from tftool.messages.classes import INTERFACES
from tftool.screens.browser.displays.shapes import DrawnMessage, thinned
from tftool.screens.browser.packing import PackedBlock
from tftool.screens.browser.recorded_messages import (
    DISPLAYS,
    MOST_TOPICS,
    Draw,
    DrawnTopic,
    Limits,
    pack_tracks,
)
from tftool.world.endpoints import PUBLISHER, USUAL, Endpoint, Quality
from tftool.world.world import World

PATIENCE: Final = 5
"""Rounds in which a message waits for the transform of its frame at its stamp."""

MOST_BYTES: Final = 6_000_000
"""Bytes of a round, but for the last message of it: a cloud of 200 000 points has 4.8 MB."""

_MOST_FAULTS: Final = 10


@dataclass(slots=True)
class _HeardTopic:
    """One subscribed topic.

    Attributes:
        drawn: Its drawing on the page; its one message is the last one.
        draw: How its messages are drawn.
        quality: Quality of service of its subscription.
        stop: Ends the subscription.
        newest: The last message, until it is drawn.
        waiting: The message that was drawn, until it can be placed.
        rounds: For how many rounds it has waited.
        is_news: Whether a fault was not reported to the page yet.
        block: The last block sent.
    """

    drawn: DrawnTopic
    draw: Draw
    quality: Quality
    stop: Callable[[], None]
    newest: Any = None
    waiting: DrawnMessage | None = None
    rounds: int = 0
    is_news: bool = False
    block: bytes = b""


class LiveDisplays:
    """Subscriber to the drawable topics of a world, including later ones."""

    def __init__(self, world: World, limits: Limits = Limits()) -> None:  # noqa: B008 - is frozen
        """Subscribe."""
        self._world = world
        self._limits = limits
        self._heard: dict[str, _HeardTopic] = {}
        self._refused: set[str] = set()
        self._stop_watching = world.watch(self._look, "view")
        self._look()

    def close(self) -> None:
        """Unsubscribe."""
        self._stop_watching()
        for one in self._heard.values():
            one.stop()
        self._heard.clear()

    @property
    def blocks(self) -> dict[str, bytes]:
        """Return the last message of every topic, for a newly opened page."""
        return {topic: one.block for topic, one in self._heard.items() if one.block}

    def latest(self, most: int) -> list[DrawnTopic]:
        """Return the last message of every topic for storage, thinned to at most `most` points."""
        found: list[DrawnTopic] = []
        for one in self._heard.values():
            self._draw(one)
            last = [one.waiting] if one.waiting is not None else one.drawn.messages
            kept = [replace(each, places=thinned(each.places, most)) for each in last]
            found.append(replace(one.drawn, messages=kept, faults=dict(one.drawn.faults)))
        return found

    def round(self) -> dict[str, bytes]:
        """Return the blocks of topics with new messages; many large ones are spread over rounds.

        Called at the rate of the pages' updates.
        """
        told: dict[str, bytes] = {}
        room = MOST_BYTES
        for topic in tuple(self._heard):
            if room <= 0:
                break
            one = self._heard[topic]
            if self._is_due(one):
                told[topic] = one.block = self._packed(one)
                room -= len(one.block)
                # Those that found no room are the first of the next round.
                self._heard[topic] = self._heard.pop(topic)
        return told

    def _look(self) -> None:
        endpoints = self._world.endpoints
        for topic in endpoints.topics():
            offers = [one for one in endpoints.of(topic, PUBLISHER) if one.interface in DISPLAYS]
            if offers and topic not in self._refused:
                self._listen(topic, offers)

    def _listen(self, topic: str, offers: list[Endpoint]) -> None:
        type_name = offers[0].interface
        # What every publisher gives, so that none of them is left out.
        quality = Quality(
            USUAL.depth,
            is_reliable=all(one.quality.is_reliable for one in offers),
            is_latched=all(one.quality.is_latched for one in offers),
        )
        known = self._heard.get(topic)
        if known is None:
            if len(self._heard) >= MOST_TOPICS:
                return
            kind, draw = DISPLAYS[type_name]
            track = DrawnTopic(f"/{topic}", type_name, kind)
            known = self._heard[topic] = _HeardTopic(track, draw, quality, _nothing)
        elif known.quality == quality or known.drawn.type != type_name:
            return
        heard = known
        # Noted first: to subscribe calls for another look.
        heard.quality = quality
        heard.stop()

        def take(message: Any) -> None:
            heard.newest = message
            heard.drawn.count += 1

        try:
            heard.stop = self._world.subscribe(
                "view", topic, INTERFACES.message(type_name), take, quality
            )
        except TftoolError:
            # It carries messages of another type here.
            self._refused.add(topic)
            del self._heard[topic]

    def _is_due(self, one: _HeardTopic) -> bool:
        """Whether a topic has a new message that is drawn and placed."""
        self._draw(one)
        if one.waiting is not None:
            one.rounds += 1
            if one.rounds > PATIENCE or _is_known(one.waiting, self._world.buffer):
                one.drawn.messages = [one.waiting]
                one.waiting = None
                return True
        return one.is_news

    def _draw(self, one: _HeardTopic) -> None:
        """Draw a topic's newest message, unless one waits to be placed."""
        if one.waiting is not None or one.newest is None:
            return
        message, one.newest = one.newest, None
        one.rounds = 0
        try:
            one.waiting = one.draw(message, self._limits.points)
        except (InputError, ValueError, TypeError) as error:
            faults = one.drawn.faults
            if str(error) in faults or len(faults) < _MOST_FAULTS:
                faults[str(error)] = faults.get(str(error), 0) + 1
                one.is_news = True

    def _packed(self, one: _HeardTopic) -> bytes:
        one.is_news = False
        # A block for each topic: the page forgets them one by one.
        block = PackedBlock()
        tracks = pack_tracks(block, [one.drawn], self._world.buffer, self._world.clock.epoch)
        return block.plain({"tracks": tracks})


def _is_known(one: DrawnMessage, buffer: Buffer) -> bool:
    """Whether the pose of a message's frame at its stamp is known."""
    root, frames = one.frame, buffer.frames()
    if root not in frames:
        return False
    try:
        for _ in range(len(frames)):
            parent = buffer.parent(root)
            if parent is None:
                break
            root = parent
        buffer.lookup_transform(root, one.frame, one.stamp)
    except TransformException:
        return False
    return True


def _nothing() -> None:
    """Do nothing, in place of ending a subscription."""
