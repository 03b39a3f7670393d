"""Formatting of facts in the sentences of the checks, ROS's commands in them, lines of evidence.

Similar observations of many frames share one line of evidence.
"""

import math
import string
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from typing import Any

from tftool.base.stamps import NANOSECONDS, SIMULATED_BELOW
from tftool.doctor.evidence import Evidence
from tftool.doctor.findings import Fact, Hit

MOST_NAMED = 5
"""Maximum number of items of a list that are printed."""

_MANY_DEGREES = 999.5
"""Angle, degrees, that does not fit into three digits."""


def span(nanoseconds: float) -> str:
    """Format a duration with three digits: "20 ms", "1.02 s"."""
    seconds = nanoseconds / 1e9
    size = abs(seconds)
    if size >= 3.16e7:
        return f"{seconds / 31_556_952:.3g} years"
    if size >= 864_000:
        return f"{seconds / 86_400:.3g} days"
    if size >= 7200:
        return f"{seconds / 3600:.3g} hours"
    if size >= 120:
        return f"{seconds / 60:.3g} minutes"
    if size >= 1:
        return f"{seconds:.2f} s"
    if size >= 0.1:
        return f"{seconds * 1e3:.0f} ms"
    if size >= 1e-4:
        return f"{seconds * 1e3:.3g} ms"
    return f"{seconds * 1e6:.0f} µs" if size >= 5e-7 else "0 ms"


def arrival(latency: float) -> str:
    """Format the time from stamp to arrival: "20 ms after its stamp", "20 ms before its stamp"."""
    if abs(latency) < 1e5:
        return "as soon as it is stamped"
    return f"{span(abs(latency))} {'after' if latency > 0 else 'before'} its stamp"


def moment(stamp: int) -> str:
    """Format a stamp in seconds with three decimals."""
    sign = "-" if stamp < 0 else ""
    milliseconds = (abs(stamp) + 500_000) // 1_000_000
    return f"{sign}{milliseconds // 1000}.{milliseconds % 1000:03}"


def dated(stamp: int) -> str:
    """Format a stamp in seconds, with its date or with "(no date)"."""
    if stamp < SIMULATED_BELOW:
        return f"{moment(stamp)} (no date)"
    day = datetime(1970, 1, 1, tzinfo=UTC) + timedelta(microseconds=stamp // 1000)
    return f"{moment(stamp)} ({day.day} {day:%B %Y})"


def metres(length: float) -> str:
    """Format a length: "2.50 m", "3.1 mm"."""
    size = abs(length)
    if size >= 0.1:
        return f"{length:.2f} m"
    return f"{length * 1e3:.3g} mm" if size >= 5e-6 else "0 mm"


def several(names: Sequence[object], most: int = MOST_NAMED) -> str:
    """Format a long list as the first items and the number of other items: "a, b and 12 more"."""
    shown = [str(name) for name in names[:most]]
    rest = len(names) - len(shown)
    return f"{', '.join(shown)} and {rest} more" if rest else ", ".join(shown)


@dataclass(frozen=True, slots=True)
class NearNumbers:
    """Range from the smallest to the largest of several nearly equal numbers."""

    low: float
    high: float


def filled(template: str, facts: Mapping[str, Fact]) -> str:
    """Replace the placeholders in a check's sentence by formatted facts."""
    return _FORMATTER.vformat(template, (), facts)


class _Words(string.Formatter):
    """Formatter of placeholders in the sentences of checks, such as {wait:span}.

    The formats are span (duration), moment and dated (stamp), m (metres), deg (radians as degrees),
    % (fraction), times (number), and a choice such as is|are between singular and plural.
    """

    def format_field(self, value: Any, format_spec: str) -> Any:
        if isinstance(value, NearNumbers):
            low, high = (self.format_field(end, format_spec) for end in (value.low, value.high))
            if low == high:
                return low
            number, _, unit = low.rpartition(" ")
            return f"{number if high.endswith(f' {unit}') and number else low} to {high}"
        one, is_choice, many = format_spec.partition("|")
        if is_choice:
            number = len(value) if isinstance(value, list | tuple) else value
            return one if number == 1 else many
        match format_spec:
            case "span":
                return span(value)
            case "moment":
                return moment(value)
            case "dated":
                return dated(value)
            case "m":
                return metres(value)
            case "deg":
                degrees = math.degrees(value)
                if degrees > _MANY_DEGREES:
                    return f"{degrees:,.0f}°"
                return f"{degrees:.3g}°" if value > 1e-4 else "0°"
            case "%":
                return f"{value * 100:.3g} %"
            case "times":
                return "once" if value == 1 else f"{value:,} times"
        if isinstance(value, list | tuple):
            return several(value)
        if not format_spec and isinstance(value, float):
            return f"{value:.3g}"
        if not format_spec and isinstance(value, int):
            return f"{value:,}"
        return super().format_field(value, format_spec)


_FORMATTER = _Words()


ALIKE = 0.1
"""Maximum relative difference of numbers that are printed in one line."""

MOST_IN_LINE = 3
"""Maximum number of frames or topics named in one line; for more, the publisher is named."""

_SUBJECTS = ("edge", "what", "frame", "topic", "child")
_MOMENTS = ("moment", "dated")


def evidence_lines(detail: str, hits: Sequence[Hit]) -> list[str]:
    """Return a line of evidence for each hit; similar hits about many frames share one line.

    Args:
        detail: Template of a line, with placeholders for facts.
        hits: Hits of one finding.
    """
    subject, colon, rest = detail.partition(": ")
    name = subject.strip("{}")
    if not colon or subject != f"{{{name}}}" or name not in _SUBJECTS:
        return [filled(detail, _facts(hit)) for hit in hits]
    told = [(key, spec or "") for _, key, spec, _ in string.Formatter().parse(rest) if key]
    groups: list[list[Hit]] = []
    for hit in hits:
        for group in groups:
            if _is_alike(group[0], hit, told):
                group.append(hit)
                break
        else:
            groups.append([hit])
    return [_line(name, rest, group, told) for group in groups]


def _facts(hit: Hit) -> dict[str, Fact]:
    return {"frames": several(hit.frames), **hit.facts}


def _is_alike(first: Hit, other: Hit, fields: Sequence[tuple[str, str]]) -> bool:
    """Whether two hits have the same publishers and nearly equal facts, and so share a line.

    Args:
        first: One hit.
        other: The other hit.
        fields: Names and formats of the facts in the line.
    """
    kinds = [(bool(one.edges), bool(one.topics), one.publishers) for one in (first, other)]
    if kinds[0] != kinds[1]:
        return False
    for key, spec in fields:
        mine, theirs = _facts(first).get(key), _facts(other).get(key)
        if mine == theirs:
            continue
        if not isinstance(mine, int | float) or not isinstance(theirs, int | float):
            return False
        near = NANOSECONDS if spec in _MOMENTS else ALIKE * max(abs(mine), abs(theirs))
        if abs(mine - theirs) > near:
            return False
    return True


def _line(name: str, rest: str, hits: Sequence[Hit], fields: Sequence[tuple[str, str]]) -> str:
    """Return one line of evidence for several similar hits, with ranges of differing numbers.

    Args:
        name: Name of the fact that is the subject of the line, such as "edge".
        rest: Template of the line after the subject.
        hits: The hits.
        fields: Names and formats of the facts in the line.
    """
    facts = _facts(hits[0])
    for key, _ in fields:
        values = [_facts(hit).get(key) for hit in hits]
        numbers = [value for value in values if isinstance(value, int | float)]
        if numbers and min(numbers) != max(numbers):
            facts[key] = NearNumbers(min(numbers), max(numbers))
    return f"{_subject(name, hits)}: {filled(rest, facts)}"


def _subject(name: str, hits: Sequence[Hit]) -> str:
    names = list(dict.fromkeys(str(_facts(hit)[name]) for hit in hits))
    if len(names) <= MOST_IN_LINE:
        return ", ".join(names)
    what = "frames" if hits[0].edges or hits[0].frames else "topics"
    if hits[0].publishers:
        return f"{len(names)} {what} of {several(hits[0].publishers)}"
    return f"{len(names)} {what} ({several(names, MOST_IN_LINE)})"


def rounded_up(nanoseconds: int) -> int:
    """Round a wait up to a multiple of 10 ms, the interval at which tf2 repeats a lookup.

    The result is at least 1 ms longer than the wait, so that a lookup with this timeout succeeds.
    """
    return math.ceil((nanoseconds + 1_000_000) / 10_000_000) * 10_000_000


def least_rate(link: str, period: int, later: int, wait: float) -> str:
    """Return a sentence with the rate that an edge needs; empty if another rate is no remedy.

    This is so if the present rate is high enough. It is also so if more than three times that rate
    is needed only because the transforms are late.

    Args:
        link: Name of the edge that delays a lookup.
        period: Period of the edge, nanoseconds; 0 if unknown.
        later: Latency of the edge minus the latency of the message, nanoseconds.
        wait: Timeout of the listener's lookup, seconds.
    """
    left = wait - later / NANOSECONDS
    told = f"a {wait * 1e3:g} ms wait"
    if left <= 0:
        return (
            f"no rate is enough for {told}: from stamp to arrival, the transforms take "
            f"{later / 1e6:.0f} ms (median) longer than the messages"
        )
    needed = math.ceil(10 / left) / 10
    # A rate that is only a few percent higher changes nothing.
    if 0 < needed * period < 1.2 * NANOSECONDS:
        return ""
    if 2 * left < wait and needed * period > 3.0 * NANOSECONDS:
        return ""
    return f"publish {link} at {needed:g} Hz or more, enough for {told}"


# Commands and settings of ROS 1 and ROS 2

_ROS2 = {
    "publishers": "ros2 topic info --verbose",
    "find_unset": "look at its publisher: `ros2 topic info --verbose {tf_topic}`",
    "sim_time": "set use_sim_time: {setting} for the nodes that publish them; `ros2 param get NODE "
    "use_sim_time` prints a node's setting",
    "which_clock": "`ros2 param get NODE use_sim_time` and `date` on its computer show which",
    "sim_time_of": "use_sim_time: {setting} for the node that publishes {edge}",
    "play_again": "play with --clock and set use_sim_time: true; in Python on humble restart, or "
    "clear the buffer",
    "loop_option": "`ros2 bag play` without --loop",
    "jumped_back": "C++ listeners clear their buffers, Python ones up to humble refuse all new "
    "data as old (TF_OLD_DATA) until the old time is reached again",
    "record": "record /tf and /tf_static",
    "buffer": "Buffer(cache_time=Duration(seconds={needed}))",
    "remap": "--ros-args -r /tf:={moving} -r /tf_static:={static}",
    "scoped": "in Gazebo, give the sensor the name in tf: <gz_frame_id>NAME</gz_frame_id>",
    "latched": "with durability transient_local",
    "volatile": "volatile",
}
_ROS1 = {
    "publishers": "rostopic info",
    "find_unset": "look at its publisher: `rostopic info {tf_topic}`",
    "which_clock": "`rosparam get use_sim_time` and `date` on its computer show which",
    "sim_time": "`rosparam set use_sim_time {setting}`, then start the nodes that publish them "
    "again: a node reads it only at its start",
    "sim_time_of": "`rosparam set use_sim_time {setting}` before the publisher of {edge} starts",
    "play_again": "`rosparam set use_sim_time true` before any node starts, and play with --clock; "
    "restart listeners that keep the old data",
    "loop_option": "`rosbag play` without -l",
    "jumped_back": "listeners on simulated time clear their buffers, others refuse all new data as "
    "old (TF_OLD_DATA) until the old time is reached again",
    "record": "record /tf and /tf_static (split recordings: rosbag record --repeat-latched)",
    "buffer": "tf2_ros.Buffer(rospy.Duration({needed}))",
    "remap": "/tf:={moving} /tf_static:={static}",
    "scoped": "in Gazebo, give the sensor the name in tf: <frameName>NAME</frameName>",
    "latched": "latched",
    "volatile": "without latching",
}
_POSES = {**_ROS2, "find_unset": "set the times of these rows in the file, or remove the rows"}
_BOTH = {name: f"{text} (ROS 1: {_ROS1[name]})" for name, text in _ROS2.items()}


def is_ros1(evidence: Evidence) -> bool:
    """Whether evidence comes from ROS 1: from a ROS 1 bag, or in the message encoding of ROS 1."""
    return evidence.kind == "ROS 1 bag" or any(one.encoding == "ros1" for one in evidence.topics)


def is_ros(evidence: Evidence) -> bool:
    """Whether evidence may come from ROS: a topic has one of ROS's encodings, or none is known."""
    encodings = {one.encoding for one in evidence.topics} - {""}
    return not encodings or bool(encodings & {"cdr", "ros1"})


def ros_words(evidence: Evidence) -> Mapping[str, str]:
    """Return the words of a pose file, of ROS 1 or of ROS 2, by placeholder; ROS 2 if unknown."""
    if evidence.kind.startswith("poses"):
        return _POSES
    return _ROS1 if is_ros1(evidence) else _ROS2


def in_words(text: str, words: Mapping[str, str] = _BOTH) -> str:
    """Replace the placeholders of commands in a check's text.

    Args:
        text: The text.
        words: Mapping from placeholder to command or setting. The default names both those of
            ROS 1 and those of ROS 2.
    """
    for name, word in words.items():
        text = text.replace(f"{{{name}}}", word)
    return text
