"""Joining a session over zenoh: a place among local processes, a connection, the graph."""

import contextlib
import threading
from collections.abc import Callable, Sequence
from typing import Final

from tftool.base.errors import LinkError
from tftool.base.stamps import seconds
from tftool.world.clock import WallClock
from tftool.world.link.graph import Graph
from tftool.world.link.link_options import Options
from tftool.world.link.zenoh import keys, rendezvous
from tftool.world.link.zenoh.reach import SECURED, ZenohReach, protocol_of
from tftool.world.link.zenoh.rendezvous import Rendezvous
from tftool.world.link.zenoh.transport import Local, Wire

REACHING: Final = 5.0
"""Seconds to wait for a process at the other end of `connect`."""

NEARBY: Final = 1.0
"""Seconds to wait for the processes of this machine that are stopped."""

BUSY: Final = 10.0
"""Seconds to wait for those that run, however slow a busy machine makes them."""

INTRODUCED: Final = 1.0
"""Seconds to wait for tokens of those who are connected."""

ANSWERED: Final = 5.0
"""Seconds in which each of them says which tokens it has; most take milliseconds."""

SHOWN: Final = 0.3
"""Seconds to wait for the tokens of all, once those of some are there."""

_STEP = 0.005


class Opening:
    """A process's resources in a session.

    Attributes:
        wire: Wire that carries everything.
        graph: Graph of the processes that it found.
        unanswering: Process numbers of this machine's processes that have a place there and
            do not answer.
    """

    def __init__(self, options: Options, reach: ZenohReach) -> None:
        """Join; immediately if there is no other process.

        No other process of this machine can enter until `settle` or `close` is called, so that no
        two of them decide at once whether to host.

        Raises:
            LinkError: If there is no place to meet, zenoh is missing or refuses, or no
                process answers where one should.
        """
        self._options = options
        self._place: Rendezvous | None = None
        others: dict[str, int] = {}
        local = Local()
        self._reach = reach
        # Without sockets a password guards this machine's processes; zenoh asks it of all
        # that connect, other machines' too, which cannot know it.
        outward = bool(reach.listen or reach.connect)
        if reach.config is None and (rendezvous.HAS_UNIX_SOCKETS or not outward):
            self._place = place = Rendezvous(options.domain)
            place.enter()
            others = place.others
            passwords = place.folder / rendezvous.PASSWORDS
            local = Local(place.endpoint, tuple(others), place.password, passwords)
        try:
            self.wire = Wire(reach, local)
        except BaseException:
            self._leave()
            raise
        self.graph = Graph(self.wire.zid, options.domain)
        self.unanswering: tuple[int, ...] = ()
        try:
            self._reach_out(others)
            self._take_in_tokens(is_expected=bool(others or reach.connect or reach.config))
        except BaseException:
            # Whatever it is: no other process can join while this one holds the lock.
            self.close()
            raise

    def settle(self) -> None:
        """Let other local processes join from now on."""
        if self._place is not None:
            self._place.settle()

    def tell_frames(self, names: Sequence[str]) -> None:
        """List this process's frames where other local commands find them."""
        if self._place is not None:
            self._place.tell_frames(names)

    def close(self) -> None:
        """Leave, and remove this process's files."""
        with contextlib.suppress(Exception):
            self.wire.close()
        self._leave()

    def _leave(self) -> None:
        if self._place is not None:
            self._place.leave()

    def _reach_out(self, others: dict[str, int]) -> None:
        """Wait for the others, on this machine and at `connect`."""

        # zenoh itself gives up waiting early, and a busy machine is slow to say hello: taking
        # that for silence would host a second world. A stopped process never says it.
        def silent() -> list[int]:
            reached = self.wire.reached
            return [pid for at, pid in others.items() if at not in reached]

        if not _await(lambda: not silent(), NEARBY):
            _await(lambda: all(rendezvous.is_stopped(pid) for pid in silent()), BUSY - NEARBY)
            self.unanswering = tuple(silent())
        reach = self._reach
        if reach.config is not None:
            _await(lambda: bool(self.wire.neighbours), NEARBY)
        elif reach.connect and not _await(
            lambda: bool(self.wire.reached - others.keys()), REACHING
        ):
            raise LinkError(_no_answer_at(reach))

    def _take_in_tokens(self, *, is_expected: bool) -> None:
        """Fill the graph with existing entities; wait if a process should be there."""

        def all_are_known() -> bool:
            for prefix in (keys.LIVELINESS, keys.OURS):
                for token in self.wire.tokens(f"{prefix}/{self._options.domain}/**", ANSWERED):
                    found = keys.parse_token(token)
                    if found is not None:
                        self.graph.add(token, found)
            return self.wire.neighbours <= self.graph.sessions

        def some_are_known() -> bool:
            return all_are_known() or not self.graph.is_empty

        # Connected is not yet introduced: routers take a moment to pass tokens on.
        if _await(some_are_known, INTRODUCED if is_expected else 0.0):
            # Those who only look never show a token: no reason to wait for long.
            _await(all_are_known, SHOWN if is_expected else 0.0)


def _no_answer_at(reach: ZenohReach) -> str:
    """Return advice if no process answers; refused certificates look the same."""
    protocols = {protocol_of(endpoint) for endpoint in reach.connect}
    text = (
        f"no process answers at {', '.join(reach.connect)} within {REACHING:g} s; "
        "is the other side running, and reachable from here?"
    )
    if reach.certificates is not None and protocols & set(SECURED):
        text += (
            " Do the certificates fit? Ours must be signed by the authority the other side was "
            f"given, the other side's by {reach.certificates.authority} and made out to the host "
            "named here."
        )
    if "tcp" in protocols:
        text += " A port that listens with tls/ does not answer tcp/."
    return text


def _await(condition: Callable[[], bool], patience: float) -> bool:
    """Poll until a condition holds, at most `patience` seconds; return whether it does."""
    clock, pause = WallClock(), threading.Event()
    # Measured, not counted: a look takes as long as those take who are asked.
    while not (held := condition()) and clock.elapsed() < seconds(patience):
        pause.wait(_STEP)
    return held
