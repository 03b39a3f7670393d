"""Log of all transforms received in a session or scenario, with their publishers."""

from collections.abc import Iterable
from typing import TYPE_CHECKING

from tftool.base.stamps import Stamp
from tftool.buffer.sample import TransformStamped

if TYPE_CHECKING:
    from tftool.recordings.contract import Transforms

MOST = 4_000_000
"""Maximum number of transforms in the log: about 300 MB."""


class TransformLog:
    """Log of received transforms, in order of arrival."""

    def __init__(self) -> None:
        self._rows: dict[tuple[str, str, bool], list[tuple[float, ...]]] = {}
        self._stamps: dict[tuple[str, str, bool], list[int]] = {}
        self._messages: dict[tuple[str, str, bool], list[int]] = {}
        self._logs: list[int] = []
        self._senders: list[int] = []
        self._publishers: dict[tuple[str, str], int] = {}
        self._count = 0

    def hear(
        self,
        now: Stamp,
        transforms: Iterable[TransformStamped],
        authority: str,
        *,
        is_static: bool,
    ) -> None:
        """Append the transforms of a message, unless the log already has `MOST` transforms.

        Args:
            now: Time of arrival, nanoseconds.
            transforms: Transforms of the message.
            authority: Name of the sender of the message.
            is_static: Whether the message came on the static topic.
        """
        if self._count >= MOST:
            return
        publisher = ("/tf_static" if is_static else "/tf", authority)
        self._senders.append(self._publishers.setdefault(publisher, len(self._publishers)))
        self._logs.append(now)
        for one in transforms:
            key = (one.frame_id, one.child_frame_id, is_static)
            pose = one.transform
            self._rows.setdefault(key, []).append((0.0, *pose.translation, *pose.rotation))
            self._stamps.setdefault(key, []).append(one.stamp)
            self._messages.setdefault(key, []).append(len(self._logs) - 1)
            self._count += 1

    def __len__(self) -> int:
        return self._count

    def static_edges(self) -> list[tuple[str, str]]:
        """Return parent and child of every static transform."""
        return [(parent, child) for parent, child, is_static in self._rows if is_static]

    def copy(self) -> "TransformLog":
        """Return a copy of the log, for another thread to read."""
        copied = TransformLog()
        copied._rows = {key: rows.copy() for key, rows in self._rows.items()}
        copied._stamps = {key: stamps.copy() for key, stamps in self._stamps.items()}
        copied._messages = {key: places.copy() for key, places in self._messages.items()}
        copied._logs, copied._senders = self._logs.copy(), self._senders.copy()
        copied._publishers, copied._count = self._publishers.copy(), self._count
        return copied

    def transforms(self) -> "Transforms":
        """Return all transforms as columns, separately for each pair of parent and child."""
        # Imported here because most logs are never read, and need no numpy.
        from tftool.recordings.contract import Transforms

        edges = (
            (key, rows, self._stamps[key], self._messages[key]) for key, rows in self._rows.items()
        )
        return Transforms.of_lists(edges, self._logs, self._senders, self._publishers)
