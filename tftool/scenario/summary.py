"""Summary of a finished scenario: the final poses, and the outcome of each expectation."""

import json
import math
from collections.abc import Mapping, Sequence
from contextlib import nullcontext, suppress
from dataclasses import dataclass

from tftool.base.errors import NodeFailed
from tftool.base.plain_text import count, visible
from tftool.base.stamps import Duration, as_seconds
from tftool.buffer.sample import Snapshot
from tftool.geometry.rigid import distance, heading
from tftool.scenario.play import Watch, build
from tftool.scenario.scenario import Scenario, Verdict
from tftool.world.clock import SimClock, run

MOST_FRAMES = 20
"""Largest number of frames whose final poses and distances are listed."""


@dataclass(frozen=True, slots=True)
class Played:
    """Scenario that was played to its end, with the final frames.

    Attributes:
        scenario: Scenario that was played.
        snapshot: All frames at the end of the scenario.
        verdict: Verdict on the run.
        defaults: Default values of the arguments; the expectations assume these values.
    """

    scenario: Scenario
    snapshot: Snapshot
    verdict: Verdict
    defaults: Mapping[str, str]

    def changed(self) -> list[str]:
        """Return the names of arguments with other values than the defaults."""
        given = self.scenario.arguments
        return [name for name, value in given.items() if value != self.defaults.get(name)]


def play_through(
    scenario: Scenario,
    defaults: Mapping[str, str],
    duration: Duration | None = None,
    *,
    watch: Watch = nullcontext,
) -> Played:
    """Play a scenario on simulated time, with all actions of its script.

    Args:
        scenario: Scenario to play.
        defaults: Default values of the scenario's arguments.
        duration: Nanoseconds to play; None for the scenario's own duration.
        watch: Function that returns a context manager for the run, such as a recording.
    """
    clock = SimClock()
    play = build(scenario, clock)
    until = None if duration is None else clock.now() + duration
    # The verdict reports the failed node.
    with watch(play.world), suppress(NodeFailed):
        run(clock, play.live(until))
    snapshot = play.world.buffer.snapshot(clock.now())
    return Played(scenario, snapshot, play.verdict(), defaults)


def written(played: Played) -> str:
    """Return the summary as text lines."""
    scenario, verdict, snapshot = played.scenario, played.verdict, played.snapshot
    changed = played.changed()
    given = _settings(scenario.arguments, changed)
    lines = [
        f"{visible(scenario.name)}: {visible(scenario.about)}".rstrip(": "),
        f"Played {as_seconds(verdict.lasted):g} s of simulated time"
        + (f" with {given}." if given else "."),
        "",
    ]
    moved = [info for info in snapshot.frames if info.parent is not None]
    shown = moved[:MOST_FRAMES]
    width = max((len(visible(info.frame)) for info in shown), default=0)
    for info in shown:
        pose, name = info.root_from_frame, visible(info.frame)
        if pose is None or info.root is None:
            lines.append(f"  {name:{width}}  place not known")
            continue
        x, y, _ = pose.translation
        lines.append(
            f"  {name:{width}}  x {x:7.3f}  y {y:7.3f}  heading {math.degrees(heading(pose)):6.1f}°"
            f"  in {visible(info.root)}"
        )
    if len(moved) > len(shown):
        lines.append(f"  and {len(moved) - len(shown)} more")
    for first, second, apart in _distances(played):
        lines.append(f"  {visible(first)} is {apart:.3f} m from {visible(second)}.")
    reached = [outcome for outcome in verdict.outcomes if outcome.reached]
    lines.append("")
    if verdict.failure:
        lines.append(f"It ended early: {visible(verdict.failure)}")
    if not reached:
        lines.append("It has no expectations up to this time.")
        return "\n".join(lines)
    held = sum(outcome.ok for outcome in reached)
    written_for = _settings(played.defaults, changed)
    lines.append(
        f"{held} of {count(len(reached), 'expectation')} held"
        + (f"; they are written for {written_for}." if written_for else ".")
    )
    lines += [
        f"  line {outcome.line}: {outcome.when}: {visible(outcome.expectation)} "
        f"{visible(outcome.expected)}, but it was {visible(outcome.found)}"
        for outcome in reached
        if not outcome.ok
    ]
    later = len(verdict.outcomes) - len(reached)
    if later:
        lines.append(f"{later} more would have been judged later.")
    return "\n".join(lines)


def as_json(played: Played) -> str:
    """Return the summary as JSON, for --json."""
    verdict = played.verdict
    frames = {}
    for info in played.snapshot.frames:
        pose = info.root_from_frame
        if info.parent is not None and pose is not None:
            x, y, z = pose.translation
            frames[info.frame] = {"in": info.root, "x": x, "y": y, "z": z, "heading": heading(pose)}
    return json.dumps(
        {
            "scenario": played.scenario.name,
            "arguments": dict(played.scenario.arguments),
            "seconds": as_seconds(verdict.lasted),
            "frames": frames,
            "distances": [
                {"from": first, "to": second, "metres": apart}
                for first, second, apart in _distances(played)
            ],
            "expectations": [
                {
                    "when": outcome.when,
                    "expectation": outcome.expectation,
                    "expected": outcome.expected,
                    "found": outcome.found,
                    "reached": outcome.reached,
                    "ok": outcome.ok,
                }
                for outcome in verdict.outcomes
            ],
            "failure": verdict.failure,
            "ok": verdict.ok,
        }
    )


def _settings(values: Mapping[str, str], names: Sequence[str]) -> str:
    return ", ".join(f"{visible(name)}={visible(values[name])}" for name in names)


def _distances(played: Played) -> list[tuple[str, str, float]]:
    """Return distances between moving frames at the end, in metres.

    Returns:
        (frame, first moving frame of the same tree, distance) for each further moving frame.
    """
    moving = [
        info
        for info in played.snapshot.frames
        if info.parent is not None and not info.is_static and info.root_from_frame is not None
    ][:MOST_FRAMES]
    found = []
    for info in moving[1:]:
        first = next(one for one in moving if one.root == info.root)
        if first is not info and first.root_from_frame and info.root_from_frame:
            apart = distance(first.root_from_frame.inverse() @ info.root_from_frame)
            found.append((info.frame, first.frame, apart))
    return found
