"""The five facts rqt_tf_tree writes beside every link, as every drawing here writes them."""

from dataclasses import dataclass

from tftool.base.stamps import NANOSECONDS, Stamp, display
from tftool.buffer.sample import FrameInfo


@dataclass(frozen=True, slots=True)
class Facts:
    """What is known of one link, as text; numbers lose trailing zeros as they do in rqt_tf_tree."""

    broadcaster: str
    rate: str
    buffer_length: str
    newest: str
    oldest: str

    def lines(self, *, units: bool) -> tuple[str, str, str, str, str]:
        """The five lines in rqt_tf_tree's words, with units behind the numbers if asked for."""
        hertz, second = (" Hz", " s") if units else ("", "")
        return (
            f"Broadcaster: {self.broadcaster}",
            f"Average rate: {self.rate}{hertz}",
            f"Buffer length: {self.buffer_length}{second}",
            f"Most recent transform: {self.newest}{second}",
            f"Oldest transform: {self.oldest}{second}",
        )


def facts(frame: FrameInfo) -> Facts:
    """Write the facts of the link above `frame`; the numbers pass through Python's own floats."""
    return Facts(
        broadcaster=frame.authority or "no recorded authority",
        rate=str(float(f"{frame.rate:.3f}")),
        buffer_length=str(float(f"{frame.buffer_length / NANOSECONDS:.3f}")),
        newest=str(float(display(frame.newest))),
        oldest=str(float(display(frame.oldest))),
    )


def recorded_at(now: Stamp) -> str:
    """The legend: when the snapshot was taken."""
    whole, rest = divmod(now, NANOSECONDS)
    return f"Recorded at time: {whole + rest / 1e9}"
