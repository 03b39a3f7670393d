"""Checks of what is there when it is needed: holes, statics, waits, caches."""

import math
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tftool.base.stamps import NANOSECONDS
from tftool.doctor.findings import Fix, Hit, Severity
from tftool.doctor.model import WARM_UP, Limits, Model
from tftool.doctor.stamp_stream import NEVER, Heard, Track, rate
from tftool.doctor.wording import several
from tftool.recordings.contract import Stamps


def no_transforms(model: Model, limits: Limits) -> Iterator[Hit]:
    """There is no tf in it at all."""
    if not model.tracks and not model.nameless:
        yield Hit(topics=tuple(t.name for t in model.material.topics if t.transforms))


def gap(model: Model, limits: Limits) -> Iterator[Hit]:
    """A hole in a transform."""
    known = {track.edge: holes(track, limits) for track in model.dynamic}
    for track in model.dynamic:
        found = known[track.edge]
        if not found:
            continue
        begin, end = max(found, key=lambda hole: hole[1] - hole[0])
        also = [
            other.name
            for other in model.dynamic
            if other is not track
            and any(low < end and begin < high for low, high in known[other.edge])
        ]
        steps = track.steps
        regular = steps[steps <= _least_gap(track, limits)] if len(found) <= 3 else steps
        mean = float(regular.mean()) if len(regular) else 0.0
        on_change = bool(mean) and float(regular.std()) / mean > limits["variation"]
        stamps = track.stamps
        missing = int(np.count_nonzero((stamps > begin) & (stamps < end)))
        yield Hit(
            edges=(track.edge,),
            publishers=track.nodes,
            since=begin,
            until=end,
            count=len(found),
            severity=Severity.NOTE if on_change else Severity.WARNING,
            facts={
                "edge": track.name,
                "begin": begin,
                "end": end,
                "length": end - begin,
                "period": track.period,
                "also": also,
                "beside": f"; at the same time: {several(also)}" if also else "",
                "unusable": missing,
                "why": f"; {missing} samples in it are unusable (NaN)" if missing else "",
            },
        )


def _least_gap(track: Track, limits: Limits) -> float:
    return max(limits["periods"] * track.period, limits["seconds"] * NANOSECONDS)


def holes(track: Track, limits: Limits) -> list[tuple[int, int]]:
    """Stamps between which an edge has nothing, although it should."""
    # Between a stamp that is years off and the others nothing is missing.
    stamps = track.sorted_stamps
    if track.wild.any():
        stamps = stamps[~track.wild[track.by_stamp]]
    if len(stamps) < limits["samples"] or not track.period:
        return []
    if len(track.steps) < 0.5 * (len(stamps) - 1):
        return []  # its stamps stand still: that is another fault
    wide = stamps[1:] - stamps[:-1] > _least_gap(track, limits)
    places = wide.nonzero()[0].tolist()
    return [(int(stamps[place]), int(stamps[place + 1])) for place in places]


def edge_stopped(model: Model, limits: Limits) -> Iterator[Hit]:
    """A transform ends long before the recording does."""
    length = model.end - model.start
    alive: list[Track | Heard] = [*model.dynamic, *model.heard]
    latest = max((int(one.logs[-1]) for one in alive if len(one.logs)), default=model.start)
    for track in model.dynamic:
        if len(track.stamps) < 2:
            continue
        last = int(track.logs[-1])
        before = model.end - last
        least = max(limits["periods"] * track.period, limits["seconds"] * NANOSECONDS)
        if before <= least or before <= limits["share"] * length:
            continue
        above = model.parents.get(track.child)
        if above is not None and above.parent != track.parent:
            continue
        # What all ends at once, as a session does that its host leaves, is no link's own fault.
        if latest - last <= least:
            continue
        yield Hit(
            edges=(track.edge,),
            publishers=track.nodes,
            since=last,
            until=model.end,
            count=1,
            facts={
                "edge": track.name,
                "last": int(track.stamps.max()),
                "before": before,
                "period": track.period,
                "below": sorted(model.below(track.child)),
            },
        )


def single_sample(model: Model, limits: Limits) -> Iterator[Hit]:
    """A moving frame with one sample only."""
    for track in model.dynamic:
        if len(track.stamps) == 1 and len(track.by_stamp) == 1:
            yield Hit(
                edges=(track.edge,),
                publishers=track.nodes,
                topics=track.topics,
                since=int(track.logs[0]),
                facts={"edge": track.name, "stamp": int(track.stamps[0])},
            )


def static_missing(model: Model, limits: Limits) -> Iterator[Hit]:
    """No statics in the recording, and sensors hang in the air."""
    if model.statics or not model.tracks:
        return
    unknown = [
        heard
        for heard in model.heard
        if heard.is_spatial and heard.frame and heard.frame.removeprefix("/") not in model.frames
    ]
    if not unknown:
        return
    static = [topic for topic in model.material.topics if topic.static]
    names = sorted({heard.frame for heard in unknown})
    yield Hit(
        frames=tuple(names),
        topics=tuple(sorted({heard.topic for heard in unknown})),
        count=sum(len(heard.stamps) for heard in unknown),
        facts={
            "frames": names,
            "why": f"{static[0].name} is there and has no message"
            if static
            else "there is no /tf_static in it",
        },
        alone=True,
    )


def static_late(model: Model, limits: Limits) -> Iterator[Hit]:
    """Statics arrive after what needs them."""
    spatial = [heard for heard in model.heard if heard.is_spatial and len(heard.logs)]
    earliest = min((int(heard.logs[0]) for heard in spatial), default=NEVER)
    for track in model.statics:
        if not len(track.logs) or track.logs[0] <= earliest:
            continue
        first = int(track.logs[0])
        below = model.below(track.child)
        missed = [
            (heard, int(np.count_nonzero(heard.logs < first)))
            for heard in spatial
            if heard.frame in below
        ]
        missed = [(heard, count) for heard, count in missed if count]
        late = max((first - int(heard.logs[0]) for heard, _ in missed), default=0)
        if late > limits["seconds"] * NANOSECONDS:
            yield Hit(
                edges=(track.edge,),
                topics=tuple(sorted({heard.topic for heard, _ in missed})),
                publishers=track.nodes,
                since=first,
                count=sum(count for _, count in missed),
                facts={
                    "edge": track.name,
                    "late": late,
                    "missed": [f"{heard.topic} ({count} messages)" for heard, count in missed],
                },
            )


def static_not_latched(model: Model, limits: Limits) -> Iterator[Hit]:
    """Statics are offered volatile: late listeners never get them."""
    static = {topic.name for topic in model.material.topics if topic.static}
    for publisher in model.material.publishers:
        if publisher.topic in static and publisher.durability == "volatile":
            edges = [t.edge for t in model.statics if publisher.topic in t.topics]
            yield Hit(
                edges=tuple(edges),
                topics=(publisher.topic,),
                publishers=(publisher.node,) if publisher.node else (),
                facts={"topic": publisher.topic, "by": publisher.authority},
            )


def latched_overwrite(model: Model, limits: Limits) -> Iterator[Hit]:
    """Statics are spread over several messages; playback latches the last."""
    transforms = model.material.transforms
    held: dict[int, set[str]] = defaultdict(set)
    for edge in transforms.edges:
        if edge.static:
            for message in np.unique(edge.messages).tolist():
                held[message].add(edge.child)
    if len(held) < 2:
        return
    last = max(held, key=lambda message: (int(transforms.log_times[message]), message))
    lost = sorted(set().union(*held.values()) - held[last])
    if lost:
        yield Hit(
            frames=tuple(lost),
            count=len(held),
            facts={"messages": len(held), "lost": lost, "kept": len(held[last])},
            alone=True,
        )


@dataclass(frozen=True, slots=True, eq=False)
class Waits:
    """How long a listener waits for a topic's messages to be placed in a frame.

    Attributes:
        waits: Nanoseconds after its arrival, shape (n,); NEVER for what never can be placed.
        link: The edge that holds it up most.
        links: The moving edges on the way.
    """

    waits: Stamps
    link: Track
    links: tuple[Track, ...]

    @property
    def served(self) -> Stamps:
        """The waits of those that can be placed at some time."""
        served: Stamps = self.waits[self.waits != NEVER]
        return served

    def serves(self, percent: float) -> int:
        """The wait, nanoseconds, that serves `percent` of all requests that are ever served."""
        return int(np.percentile(self.served, percent, method="higher"))


def waits_of(model: Model, heard: Heard, fixed: str, *, warm: bool = True) -> Waits | None:
    """How long each message waits to be placed in a frame; None where no edge on the way moves.

    Args:
        model: What is known of the frames.
        heard: The messages.
        fixed: Where they are to be placed.
        warm: Whether the first and the last second of the recording are left out.
    """
    path = model.path(heard.frame, fixed)
    links = [track for track in path or () if not track.static and len(track.by_stamp)]
    if not links or any(not t.static and not len(t.by_stamp) for t in path or ()):
        return None
    low, high = model.warm if warm else (model.start, model.end)
    begin = max(int(track.sorted_stamps[0]) for track in links)
    # What is older than the first transform is no matter of waiting: see `late_start`.
    inside = (heard.logs >= low) & (heard.logs <= high) & (heard.stamps >= begin)
    stamps, arrivals = heard.stamps[inside], heard.arrivals[inside]
    if not len(stamps):
        return None
    served = np.stack([track.served_from(stamps) for track in links])
    latest = served.max(axis=0)
    waits = np.where(latest == NEVER, NEVER, np.maximum(latest - arrivals, 0))
    blame = np.bincount(served.argmax(axis=0)[waits > 0], minlength=len(links))
    return Waits(waits, links[int(blame.argmax())], tuple(links))


def sensor_outruns_tf(model: Model, limits: Limits) -> Iterator[Hit]:
    """Lookups at the sensor's stamps refuse; how many, and what wait cures them."""
    fixed = model.sensor_frame
    for heard in model.heard:
        if not heard.is_spatial or len(heard.stamps) < limits["messages"]:
            continue
        waits = waits_of(model, heard, fixed)
        if waits is None:
            continue
        served = waits.served
        never = 1.0 - len(served) / len(waits.waits)
        p50, p95, worst = (
            (waits.serves(50), waits.serves(95), int(served.max())) if len(served) else (0, 0, 0)
        )
        refused = float(np.count_nonzero(waits.waits > 0)) / len(waits.waits)
        if p95 > limits["seconds"] * NANOSECONDS or never > limits["never"]:
            severity = Severity.WARNING
        elif refused > limits["refused"] and p95 > limits["note"] * NANOSECONDS:
            severity = Severity.NOTE
        else:
            continue
        link = waits.link
        yield Hit(
            edges=(link.edge,),
            frames=(heard.frame, fixed),
            topics=(heard.topic,),
            publishers=link.nodes,
            since=int(heard.logs[0]),
            count=int(np.count_nonzero(waits.waits > 0)),
            severity=severity,
            facts={
                "topic": heard.topic,
                "fixed": fixed,
                "refused": refused,
                "never": never,
                "p50": p50,
                "p95": p95,
                "worst": worst,
                "timeout": rounded_up(worst),
                "link": link.name,
                "period": link.period,
                "latency": link.median_latency,
                "path": [list(track.edge) for track in waits.links],
            },
            fixes=_cures(heard, waits, limits["seconds"]),
            alone=True,
        )


def _cures(heard: Heard, waits: Waits, wait: float) -> tuple[Fix, ...]:
    """What serves those that are ever served; nothing where waiting is not the trouble."""
    worst = int(waits.served.max(initial=0))
    if worst < 10_000_000:
        return ()
    p95 = math.ceil(waits.serves(95) / 1e6)
    later = waits.link.median_latency - heard.median_latency
    depth = max(1, math.ceil(worst / NANOSECONDS * rate(heard)))
    ahead = Fix(
        f"or date {waits.link.name} {math.ceil(worst / 1e6)} ms further ahead (transform_tolerance)"
    )
    return (
        Fix(
            f"wait for it: a timeout of {rounded_up(worst) // 10**6} ms serves all that are ever "
            f"served ({p95} ms serve 95 %)"
        ),
        Fix(least_rate(later, wait)),
        *((ahead,) if waits.link.is_localisation else ()),
        Fix(f"let the queue of the message filter hold {depth} messages"),
    )


def rounded_up(nanoseconds: int) -> int:
    """To the next 10 ms, at which tf2 asks again."""
    return math.ceil(nanoseconds / 10_000_000) * 10_000_000


def least_rate(later: int, wait: float) -> str:
    """What rate lets a link keep up, where it arrives `later` nanoseconds after the sensor's."""
    left = wait - later / NANOSECONDS
    told = f"a {wait * 1e3:g} ms wait"
    if left <= 0:
        return (
            f"no rate is enough for {told}: each transform arrives {later / 1e6:.0f} ms later "
            "after its stamp than the message"
        )
    return f"or publish it at {math.ceil(10 / left) / 10:g} Hz or more, enough for {told}"


def cache_short(model: Model, limits: Limits) -> Iterator[Hit]:
    """Messages are older than the cache when they arrive."""
    for heard in model.heard:
        if not heard.is_spatial or len(heard.stamps) < 3:
            continue
        latency = heard.latency[heard.stamps != 0]
        if not len(latency):
            continue
        if float(np.percentile(latency, 95)) > model.settings.cache_time:
            worst = int(latency.max())
            yield Hit(
                topics=(heard.topic,),
                frames=(heard.frame,),
                since=int(heard.logs[0]),
                count=int(np.count_nonzero(latency > model.settings.cache_time)),
                facts={
                    "topic": heard.topic,
                    "late": int(np.median(latency)),
                    "worst": worst,
                    "cache": model.settings.cache_time,
                    "needed": math.ceil(worst / NANOSECONDS) + 1,
                },
            )


def late_start(model: Model, limits: Limits) -> Iterator[Hit]:
    """Lookups cannot succeed before t: an edge begins late or is dated ahead."""
    fixed = model.fixed_frame
    for heard in model.heard:
        if not heard.is_spatial or not len(heard.stamps):
            continue
        links = [
            t for t in model.path(heard.frame, fixed) or () if not t.static and len(t.by_stamp)
        ]
        if not links:
            continue
        last = max(links, key=lambda track: int(track.sorted_stamps[0]))
        begin = int(last.sorted_stamps[0])
        stamped = heard.stamps[heard.stamps != 0]
        lost = int(np.count_nonzero(stamped < begin))
        # A localiser that dates its transforms ahead loses the first second of every recording.
        usual = WARM_UP
        if last.is_localisation:
            usual = max(usual, min(-last.median_latency, 2 * WARM_UP))
        if lost and begin - int(stamped.min()) > usual + limits["seconds"] * NANOSECONDS:
            yield Hit(
                edges=(last.edge,),
                topics=(heard.topic,),
                since=int(heard.logs[0]),
                count=lost,
                facts={
                    "edge": last.name,
                    "begin": begin,
                    "lost": lost,
                    "topic": heard.topic,
                    "fixed": fixed,
                },
            )


def truncated_recording(model: Model, limits: Limits) -> Iterator[Hit]:
    """What could not be read."""
    if model.material.damage:
        yield Hit(facts={"damage": " ".join(model.material.damage)}, alone=True)
