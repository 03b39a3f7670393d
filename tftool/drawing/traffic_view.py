"""Rates and delays of received transforms: in tf2_monitor's format, as a table, as JSON."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from typing import Any

from rich.cells import cell_len
from rich.text import Text

from tftool.base.plain_text import short_duration, visible
from tftool.base.stamps import FRAME_TIMEOUT, Duration, Stamp, as_seconds
from tftool.buffer.traffic import FrameTraffic, NetDelay, Series, Traffic
from tftool.doctor.findings import STALE_AFTER, STOPPED_AFTER, STOPPED_PERIODS
from tftool.drawing.echo_view import in_words
from tftool.drawing.table_columns import Cell, TableColumn, fit, middle_cut, wrap_words

NONE = "-"


@dataclass(frozen=True, slots=True)
class Chain:
    """Pair of frames to monitor, with the frames between them.

    Attributes:
        target: Frame in which the pose is looked up.
        source: Frame whose pose is looked up.
        frames: Frames from source to target, both included.
        delay: Statistics of the age of the pair's transform at each lookup.
    """

    target: str
    source: str
    frames: tuple[str, ...]
    delay: NetDelay


def lines(traffic: Traffic, chain: Chain | None = None, *, as_tf2: bool = False) -> str:
    """Format a report on received transforms as tf2_monitor does.

    Args:
        traffic: Statistics of the received messages.
        chain: Pair of the report; None for all frames.
        as_tf2: Whether to compute the numbers as tf2_monitor does; see `tftool.buffer.traffic`.

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
    found += [frame_line(link, as_tf2=as_tf2) for link in links_of(traffic, chain)]
    found += ["", "All Broadcasters:"]
    found += [
        sender_line(name, series, as_tf2=as_tf2) for name, series in sorted(traffic.senders.items())
    ]
    return "\n".join(found) + "\n"


def frame_line(link: FrameTraffic, *, as_tf2: bool = False) -> str:
    """Format the line about one frame as tf2_monitor does."""
    average, maximum = _delays(link.series, as_tf2)
    return (
        f"Frame: {visible(link.frame)}, published by {visible(link.sender)}, "
        f"Average Delay: {average}, Max Delay: {maximum}"
    )


def sender_line(name: str, series: Series, *, as_tf2: bool = False) -> str:
    """Format the line about a broadcaster as tf2_monitor does: no comma before "Max Delay"."""
    average, maximum = _delays(series, as_tf2)
    rate = series.tf2_rate if as_tf2 else series.rate
    return (
        f"Node: {visible(name)} {_number(rate)} Hz, Average Delay: {average} Max Delay: {maximum}"
    )


def table(
    now: Stamp,
    began: Stamp,
    traffic: Traffic,
    chain: Chain | None = None,
    *,
    width: int,
    height: int,
    ascii_only: bool = False,
) -> Text:
    """Return a table of frames (of the chain, if one is given) and a table of publishers.

    A frame is amber if its transforms arrive long after their stamps, or if none has arrived for
    many periods. A frame is red after a longer silence. The limits are those of the doctor.

    Args:
        now: Current time of the clock in nanoseconds.
        began: Time when listening began, nanoseconds.
        traffic: Statistics of the received messages.
        chain: Pair of the report; None for all frames.
        width: Width in cells.
        height: Height in lines; a last line shows the number of rows that do not fit.
        ascii_only: Whether to draw with ASCII only.
    """
    links = links_of(traffic, chain)
    if chain is not None:
        places = {frame: place for place, frame in enumerate(chain.frames)}
        links.sort(key=lambda link: places[link.frame])
    more = "~" if ascii_only else "…"
    parents = [(visible(link.parent), "dim") for link in links]
    senders = [(visible(link.sender), "dim") for link in links]
    series = [link.series for link in links]
    statics = [link.is_static for link in links]
    columns = [
        TableColumn("in", parents, caps=(24, 12), drop_order=4),
        TableColumn("broadcaster", senders, caps=(24, 16, 11), drop_order=3),
        *_measures(now, series, statics, ascii_only),
    ]
    names = [(visible(link.frame), late_style(now, link.series, link.is_static)) for link in links]
    frames = _rows("frame", names, columns, width, more)

    by_name = sorted(traffic.senders.items())
    of_senders = [one for _, one in by_name]
    measured = _measures(now, of_senders, [False] * len(by_name), ascii_only)
    names = [(visible(name), late_style(now, one, False)) for name, one in by_name]
    broadcasters = _rows("broadcaster", names, measured, width, more)

    words = wrap_words(_title(as_seconds(now - began), chain), width)
    title = [Text(middle_cut(line, width, more=more), style="bold") for line in words]
    room = height - len(title) - 2
    least = min(len(broadcasters), max(3, room // 3))
    frames = _within(frames, room - least)
    broadcasters = _within(broadcasters, room - len(frames))
    return Text("\n").join([*title, Text(), *frames, Text(), *broadcasters])


def _title(seconds: float, chain: Chain | None) -> str:
    if chain is None:
        return f"All frames, for {seconds:.0f} s"
    path = ", ".join(visible(one) for one in chain.frames)
    return (
        f"{in_words(chain.target, chain.source)}, for {seconds:.0f} s, by way of {path}: "
        f"net delay {milliseconds(chain.delay.average)} on average, "
        f"{milliseconds(chain.delay.maximum)} at most"
    )


def _rows(
    heading: str, names: list[Cell], columns: list[TableColumn], width: int, more: str
) -> list[Text]:
    longest = max(cell_len(text) for text, _ in [(heading, ""), *names])
    wanted = min(longest, max(12, width // 3))
    fitted = fit(columns, width, reserved=wanted, longest=longest, more=more)
    return [
        fitted.heading(heading),
        *(
            fitted.row(place, Text(middle_cut(name, fitted.first_width, more=more), style=style))
            for place, (name, style) in enumerate(names)
        ),
    ]


def _within(rows: list[Text], height: int) -> list[Text]:
    """Return the rows that fit into `height` lines; the last line counts the omitted rows."""
    if len(rows) <= max(2, height):
        return rows
    kept = max(1, height - 1)
    return [*rows[:kept], Text(f"{len(rows) - kept} more", style="bold")]


def _measures(
    now: Stamp, series: list[Series], statics: list[bool], ascii_only: bool
) -> list[TableColumn]:
    """Return the columns of rate, delay and time since the last message, for a table of frames.

    Args:
        now: Current time of the clock in nanoseconds.
        series: Statistics of each row.
        statics: Whether the frame of each row is static.
        ascii_only: Whether to draw bars in ASCII.
    """
    digits = delay_digits(one for one, still in zip(series, statics, strict=True) if not still)
    rates = [rate_words(now, one) for one in series]
    heights = [present_rate(now, one) or 0.0 for one in series]
    late = [late_style(now, one, still) for one, still in zip(series, statics, strict=True)]

    def cells(values: list[str]) -> list[Cell]:
        return [
            (NONE, "dim") if still else (value, style)
            for value, still, style in zip(values, statics, late, strict=True)
        ]

    shown = [
        ("static", "dim") if still else (rate, style if is_silent(now, one, still) else "")
        for rate, one, still, style in zip(rates, series, statics, late, strict=True)
    ]
    fastest = max(heights, default=0.0)
    bars = [
        ("" if still else bar(one, fastest, ascii_only=ascii_only), style or "green")
        for one, still, style in zip(heights, statics, late, strict=True)
    ]
    silent = [
        (f"{short_duration(silence(now, one))} ago" if is_silent(now, one, still) else "", style)
        for one, still, style in zip(series, statics, late, strict=True)
    ]
    return [
        TableColumn("rate", shown, align_right=True, drop_order=6),
        TableColumn("", bars, drop_order=1),
        TableColumn(
            "delay",
            cells([milliseconds(one.average_delay, digits) for one in series]),
            True,
            drop_order=5,
        ),
        TableColumn(
            "max",
            cells([milliseconds(one.maximum_delay, digits) for one in series]),
            True,
            drop_order=2,
        ),
        TableColumn("last heard", silent, True),
    ]


BAR = 8
"""Width in cells of the longest bar."""


def bar(rate: float, fastest: float, cells: int = BAR, *, ascii_only: bool) -> str:
    """Return a bar whose length is proportional to `rate`: `cells` cells for the rate `fastest`."""
    if fastest <= 0.0 or rate <= 0.0:
        return ""
    return ("#" if ascii_only else "▇") * max(1, round(cells * rate / fastest))


def silence(now: Stamp, series: Series) -> Duration:
    """Return the time since the last message, nanoseconds; 0 before the first message."""
    return 0 if series.last is None else now - series.last


def is_silent(now: Stamp, series: Series, is_static: bool) -> bool:
    """Whether no transform of a moving frame has arrived for many of its periods."""
    if is_static or series.rate is None:
        return False
    return has_stopped(as_seconds(silence(now, series)), series.rate)


def has_stopped(silent: float, rate: float) -> bool:
    """Whether a publisher of `rate` hertz, silent for `silent` seconds, has stopped."""
    return rate > 0.0 and silent > max(STOPPED_AFTER, STOPPED_PERIODS / rate)


def present_rate(now: Stamp, series: Series) -> float | None:
    """Return the rate of a frame or a publisher, hertz; 0 after a stop, None if unknown."""
    return 0.0 if is_silent(now, series, False) else series.rate


def rate_words(now: Stamp, series: Series) -> str:
    """Format the present rate of a frame or a publisher."""
    rate = present_rate(now, series)
    return NONE if rate is None else f"{rate:.2f} Hz"


def late_style(now: Stamp, series: Series, is_static: bool) -> str:
    """Return the style of a frame's numbers: yellow or red if the frame is late, else ""."""
    if is_silent(now, series, is_static):
        return "red" if as_seconds(silence(now, series)) > FRAME_TIMEOUT else "yellow"
    delay = series.average_delay
    if is_static or delay is None or delay <= STALE_AFTER:
        return ""
    return "yellow"


def as_object(now: Stamp, traffic: Traffic, chain: Chain | None = None) -> dict[str, Any]:
    """Return a report as a mapping, for --json: seconds and hertz, null if unknown."""
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
        for link in links_of(traffic, chain)
    ]
    result["broadcasters"] = [
        {"broadcaster": name, **_object(series)} for name, series in sorted(traffic.senders.items())
    ]
    return result


def links_of(traffic: Traffic, chain: Chain | None) -> list[FrameTraffic]:
    """Return the frames of a report with their statistics, sorted by name."""
    wanted: Collection[str] = traffic.links if chain is None else chain.frames
    return [link for name, link in sorted(traffic.links.items()) if name in wanted]


def _delays(series: Series, as_tf2: bool) -> tuple[str, str]:
    if as_tf2:
        return _number(series.tf2_average_delay), _number(series.tf2_maximum_delay)
    return _number(series.average_delay), _number(series.maximum_delay)


def _object(series: Series) -> dict[str, Any]:
    return {
        "messages": series.total,
        "rate": series.rate,
        "average_delay": series.average_delay,
        "max_delay": series.maximum_delay,
    }


def _number(value: float | None) -> str:
    return "unknown" if value is None else format(value, "g")


def delay_digits(series: Iterable[Series]) -> int:
    """Return the number of decimals with which to show delays in milliseconds."""
    largest = max((abs(one.maximum_delay or 0.0) for one in series), default=0.0)
    return 3 if 0.0 < largest < 0.01 else 1 if largest < 10.0 else 0


def milliseconds(value: float | None, digits: int = 1) -> str:
    """Format a number of seconds as milliseconds."""
    return NONE if value is None else f"{value * 1e3:.{digits}f} ms"
