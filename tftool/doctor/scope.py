"""What of a recording is looked at: which topics, which time, beside which description."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from tftool.base.errors import InputError
from tftool.base.near_names import near_names
from tftool.base.stamps import Stamp, as_seconds
from tftool.doctor.evidence import Material
from tftool.doctor.recording_evidence import Described, read
from tftool.recordings.contract import Edge, Headers, Source, Transforms

if TYPE_CHECKING:
    from tftool.recordings.recording import Recording


class Moment(Protocol):
    """A moment as it was asked for."""

    def stamp(self, epoch: Stamp) -> Stamp:
        """The moment itself, where what is asked begins at `epoch`."""


@dataclass(frozen=True, slots=True)
class Scope:
    """What of a recording is looked at; all of it where nothing is said.

    Attributes:
        described: The robot's description; None for the recorded one, if any.
        tf_topics: Topics of transforms, in place of all; the static one beside each goes with it.
        begin: Log time from which on; None for the recording's start.
        end: Log time up to which; None for the recording's end.
    """

    described: Described | None = None
    tf_topics: tuple[str, ...] = ()
    begin: Moment | None = None
    end: Moment | None = None

    def material(self, recording: "Recording") -> Material:
        """What a diagnosis looks at, of a recording.

        Raises:
            InputError: If it cannot be read, has none of the topics, or nothing in that time.
        """
        source = recording.source
        if self.tf_topics:
            transforms = source.transforms(_with_statics(source, self.tf_topics))
        else:
            transforms = recording.transforms
        material = read(source, transforms, self.described)
        if self.begin is None and self.end is None:
            return material
        begin = material.start if self.begin is None else self.begin.stamp(material.start)
        end = material.end if self.end is None else self.end.stamp(material.start)
        if begin > material.end or end < material.start or begin >= end:
            length = as_seconds(material.end - material.start)
            raise InputError(f"'{source.name}' has nothing in that time: it lasts {length:.3f} s.")
        return within(material, max(begin, material.start), min(end, material.end))


def _with_statics(source: Source, names: tuple[str, ...]) -> list[str]:
    """The topics of these names, and the static one that goes with each."""
    known = {topic.name for topic in source.topics if topic.transforms}
    found = []
    for name in names:
        if name not in known:
            near = near_names(name, sorted(known)) or sorted(known)[:5]
            hint = f"; there is {', '.join(near)}" if near else ""
            raise InputError(f"'{source.name}' has no transforms on '{name}'{hint}.")
        found += [one for one in (name, f"{name}_static") if one in known]
    return list(dict.fromkeys(found))


def within(material: Material, begin: Stamp, end: Stamp) -> Material:
    """What was received between two log times; of statics, all that was received before, too."""
    read_clock, received = material.clock
    ticks = (received >= begin) & (received <= end)
    return replace(
        material,
        transforms=_cut(material.transforms, begin, end),
        headers={
            topic: _cut_headers(headers, begin, end) for topic, headers in material.headers.items()
        },
        # One reading on each side still tells how the clock runs.
        clock=(read_clock[ticks], received[ticks]) if ticks.any() else material.clock,
        odometry=None if material.odometry is None else _cut(material.odometry, begin, end),
        start=begin,
        end=end,
    )


def _cut(transforms: Transforms, begin: Stamp, end: Stamp) -> Transforms:
    edges = []
    for edge in transforms.edges:
        logs = transforms.log_times_of(edge)
        inside = (logs <= end) & (edge.static | (logs >= begin))
        if inside.any():
            edges.append(
                Edge(
                    edge.parent,
                    edge.child,
                    edge.static,
                    min(edge.slashed, int(np.count_nonzero(inside))),
                    edge.records[inside],
                    edge.messages[inside],
                )
            )
    return replace(transforms, edges=tuple(edges))


def _cut_headers(headers: Headers, begin: Stamp, end: Stamp) -> Headers:
    inside = (headers.log_times >= begin) & (headers.log_times <= end)
    return replace(
        headers,
        stamps=headers.stamps[inside],
        log_times=headers.log_times[inside],
        frames=headers.frames[inside],
    )
