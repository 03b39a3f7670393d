"""The way into a session: a place among this machine's processes, a wire, and who is there."""

import contextlib
import threading
from collections.abc import Callable
from typing import Final

from tftool.errors import LinkError
from tftool.link import keys
from tftool.link.graph import Graph
from tftool.link.membership import Options
from tftool.link.reach import SECURED, Reach, protocol_of
from tftool.link.rendezvous import Rendezvous
from tftool.link.transport import Wire
from tftool.runtime.clock import WallClock
from tftool.stamps import seconds

REACHING: Final = 3.0
"""Seconds to wait for somebody at the other end of `connect`."""

NEARBY: Final = 1.0
"""Seconds to wait for the processes of this machine."""

INTRODUCED: Final = 1.0
"""Seconds to wait for tokens of those who are connected."""

SHOWN: Final = 0.3
"""Seconds to wait for the tokens of all, once those of some are there."""

_STEP = 0.005


class Opening:
    """What a process holds once it is in a session.

    Attributes:
        wire: What carries everything.
        graph: Who else was there when it came.
        silent: How many processes of this machine have a place there and do not answer.
    """

    def __init__(self, options: Options) -> None:
        """Go in; alone, at once.

        No other process of this machine can do so in between until `settle` or `close` is
        called: whoever comes decides what to be while nobody else does.

        Raises:
            LinkError: If there is no place to meet, zenoh is missing or refuses, or nobody
                answers where somebody should.
        """
        self._options = options
        self._place: Rendezvous | None = None
        endpoint = ""
        others: tuple[str, ...] = ()
        if options.reach.config is None:
            self._place = Rendezvous(options.domain)
            self._place.enter()
            endpoint, others = self._place.endpoint, self._place.others
        try:
            self.wire = Wire(options.reach, endpoint, others)
        except BaseException:
            self._leave()
            raise
        self.graph = Graph(self.wire.zid, options.domain)
        self.silent = 0
        reach = options.reach
        try:
            self._reach_out(len(others))
            self._take_in_tokens(is_expected=bool(others or reach.connect or reach.config))
        except BaseException:
            # Whatever it is: nobody else can join while this one holds the door.
            self.close()
            raise

    def settle(self) -> None:
        """Let other processes of this machine in from now on."""
        if self._place is not None:
            self._place.settle()

    def close(self) -> None:
        """Go out, and take away what this process put there."""
        with contextlib.suppress(Exception):
            self.wire.close()
        self._leave()

    def _leave(self) -> None:
        if self._place is not None:
            self._place.leave()

    def _reach_out(self, others: int) -> None:
        """Wait until somebody is there, where somebody should be."""
        # zenoh itself gives up waiting early, and a busy machine is slow to say hello: who
        # took that for nobody would host a second world. A stopped process never says it.
        if not self._await_neighbours(others, NEARBY):
            self.silent = max(0, others - len(self.wire.neighbours))
        reach = self._options.reach
        if reach.config is not None:
            self._await_neighbours(1, NEARBY)
        elif reach.connect and not self._await_neighbours(others + 1, REACHING):
            raise LinkError(_nobody_at(reach))

    def _await_neighbours(self, count: int, patience: float) -> bool:
        return _await(lambda: len(self.wire.neighbours) >= count, patience)

    def _take_in_tokens(self, *, is_expected: bool) -> None:
        """Fill the graph with who is there now, where somebody should be."""

        def all_are_known() -> bool:
            for prefix in (keys.LIVELINESS, keys.OURS):
                for token in self.wire.tokens(f"{prefix}/{self._options.domain}/**"):
                    self.graph.add(token)
            return self.wire.neighbours <= self.graph.sessions

        def some_are_known() -> bool:
            return all_are_known() or not self.graph.is_empty

        # Connected is not yet introduced: routers take a moment to pass tokens on.
        if _await(some_are_known, INTRODUCED if is_expected else 0.0):
            # Those who only look never show a token: no reason to wait for long.
            _await(all_are_known, SHOWN if is_expected else 0.0)


def _nobody_at(reach: Reach) -> str:
    """What to look for where nobody answers: who is refused is told no more than that."""
    protocols = {protocol_of(endpoint) for endpoint in reach.connect}
    text = (
        f"nobody answers at {', '.join(reach.connect)} within {REACHING:g} s; "
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
    """Look until something holds, for so many seconds at most; say whether it does."""
    clock, pause = WallClock(), threading.Event()
    # Measured, not counted: a look takes as long as those take who are asked.
    while not (held := condition()) and clock.elapsed() < seconds(patience):
        pause.wait(_STEP)
    return held
