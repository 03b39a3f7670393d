"""What arrives, how often and how late: tf2_monitor's lines, a table, an object."""

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from tftool.frames.traffic import FrameTraffic, NetDelay, Series, Traffic
from tftool.stamps import Stamp
from tftool.views.echo import in_words
from tftool.views.escaping import visible

NONE = "-"


@dataclass(frozen=True, slots=True)
class Chain:
    """The two frames a monitor was asked about, and what hangs between them.

    Attributes:
        target: The frame looked up in.
        source: The frame looked up.
        frames: From source to target, both included.
        delay: How old the latest answer was, each time it was asked for.
    """

    target: str
    source: str
    frames: tuple[str, ...]
    delay: NetDelay


def lines(traffic: Traffic, chain: Chain | None = None, *, as_tf2: bool = False) -> str:
    """Write a report as tf2_monitor does.

    Args:
        traffic: What came.
        chain: The pair it is about; None for all frames.
        as_tf2: Whether to print tf2_monitor's own numbers; see `frames.traffic`.

    Returns:
        Lines, each with its newline.
    """
    found = ["", "", ""]
    if chain is None:
        found.append("RESULTS: for all Frames")
    else:
        found.append(f"RESULTS: for {in_words(chain.target, chain.source)}")
        found.append("Chain is: " + " -> ".join(visible(one) for one in chain.frames))
        average = chain.delay.tf2_average if as_tf2 else chain.delay.average
        found.append(
            f"Net delay     avg = {_number(average)}: max = {_number(chain.delay.maximum)}"
        )
    found += ["", "Frames:"]
    found += [frame_line(link, as_tf2=as_tf2) for link in _links(traffic, chain)]
    found += ["", "All Broadcasters:"]
    found += [
        sender_line(name, series, as_tf2=as_tf2) for name, series in sorted(traffic.senders.items())
    ]
    return "\n".join(found) + "\n"


def frame_line(link: FrameTraffic, *, as_tf2: bool = False) -> str:
    """One frame, as tf2_monitor writes it."""
    average, maximum = _delays(link.series, as_tf2)
    return (
        f"Frame: {visible(link.frame)}, published by {visible(link.sender)}, "
        f"Average Delay: {average}, Max Delay: {maximum}"
    )


def sender_line(name: str, series: Series, *, as_tf2: bool = False) -> str:
    """One broadcaster, as tf2_monitor writes it (the missing comma is its own)."""
    average, maximum = _delays(series, as_tf2)
    rate = series.tf2_rate if as_tf2 else series.rate
    return (
        f"Node: {visible(name)} {_number(rate)} Hz, Average Delay: {average} Max Delay: {maximum}"
    )


def table(now: Stamp, began: Stamp, traffic: Traffic, chain: Chain | None = None) -> RenderableType:
    """The same to look at: one table of frames, one of broadcasters."""
    seconds = (now - began) / 1e9
    if chain is None:
        title = Text(f"All frames, for {seconds:.0f} s")
    else:
        path = ", ".join(visible(one) for one in chain.frames)
        title = Text(
            f"{in_words(chain.target, chain.source)}, for {seconds:.0f} s, by way of {path}: "
            f"net delay {_milliseconds(chain.delay.average)} on average, "
            f"{_milliseconds(chain.delay.maximum)} at most"
        )
    frames = Table("frame", "in", "broadcaster", box=None, pad_edge=False)
    senders = Table("broadcaster", box=None, pad_edge=False)
    for one in (frames, senders):
        for heading in ("rate", "average delay", "most"):
            one.add_column(heading, justify="right")
    for link in _links(traffic, chain):
        frames.add_row(
            Text(visible(link.frame)),
            Text(visible(link.parent)),
            Text(visible(link.sender)),
            *(("static", NONE, NONE) if link.is_static else _measured(link.series)),
        )
    for name, series in sorted(traffic.senders.items()):
        senders.add_row(Text(visible(name)), *_measured(series))
    return Group(title, Text(), frames, Text(), senders)


def as_object(now: Stamp, traffic: Traffic, chain: Chain | None = None) -> dict[str, Any]:
    """The same for programs: seconds and hertz, null where nothing can be measured."""
    result: dict[str, Any] = {"at_ns": now}
    if chain is not None:
        result |= {
            "target": chain.target,
            "source": chain.source,
            "chain": list(chain.frames),
            "net_delay": {"average": chain.delay.average, "max": chain.delay.maximum},
        }
    result["frames"] = [
        {
            "frame": link.frame,
            "parent": link.parent,
            "broadcaster": link.sender,
            "static": link.is_static,
            **_object(link.series),
        }
        for link in _links(traffic, chain)
    ]
    result["broadcasters"] = [
        {"broadcaster": name, **_object(series)} for name, series in sorted(traffic.senders.items())
    ]
    return result


def _links(traffic: Traffic, chain: Chain | None) -> list[FrameTraffic]:
    wanted: Collection[str] = traffic.links if chain is None else chain.frames
    return [link for name, link in sorted(traffic.links.items()) if name in wanted]


def _delays(series: Series, as_tf2: bool) -> tuple[str, str]:
    if as_tf2:
        return _number(series.tf2_average_delay), _number(series.tf2_maximum_delay)
    return _number(series.average_delay), _number(series.maximum_delay)


def _measured(series: Series) -> tuple[str, str, str]:
    rate = series.rate
    return (
        NONE if rate is None else f"{rate:.2f} Hz",
        _milliseconds(series.average_delay),
        _milliseconds(series.maximum_delay),
    )


def _object(series: Series) -> dict[str, Any]:
    return {
        "messages": series.total,
        "rate": series.rate,
        "average_delay": series.average_delay,
        "max_delay": series.maximum_delay,
    }


def _number(value: float | None) -> str:
    return "unknown" if value is None else format(value, "g")


def _milliseconds(value: float | None) -> str:
    return NONE if value is None else f"{value * 1e3:.1f} ms"
