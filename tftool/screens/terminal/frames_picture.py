"""From all frames at one moment to a picture of them in one fixed frame, by lookup."""

from collections.abc import Callable, Mapping

from tftool.buffer.sample import FrameInfo, Snapshot
from tftool.drawing.plane import FARTHEST, PlaneFrame, PlanePicture
from tftool.geometry.rigid import Transform

Lookup = Callable[[str, str], Transform | None]
"""The pose of the second frame in the first, or None where there is none."""


def natural_fixed(snapshot: Snapshot, pair: tuple[str, str]) -> str:
    """The frame a picture is drawn in unless another is chosen.

    That is the root of the tree in which both frames of the pair are; where no tree has
    both, the root of the largest one. Empty where there are no frames.
    """
    if pair[0] in snapshot and pair[1] in snapshot:
        roots = {snapshot.frame(name).root for name in pair}
        (root, *others) = roots
        if root is not None and not others:
            return root
    sizes: dict[str, int] = {}
    for info in snapshot.frames:
        if info.root is not None:
            sizes[info.root] = sizes.get(info.root, 0) + 1
    return max(sizes, key=lambda root: sizes[root], default="")


def in_snapshot(snapshot: Snapshot) -> Lookup:
    """A lookup that asks the snapshot alone."""

    def lookup(target: str, source: str) -> Transform | None:
        if target not in snapshot or source not in snapshot:
            return None
        to, of = snapshot.frame(target), snapshot.frame(source)
        if to.root is None or to.root != of.root or not to.root_from_frame:
            return None
        if of.root_from_frame is None:
            return None
        if target == to.root:
            return of.root_from_frame
        return to.root_from_frame.inverse() @ of.root_from_frame

    return lookup


def moving(snapshot: Snapshot, fixed: str) -> list[str]:
    """The frames that may move as seen from `fixed`, but for what is bolted to one of them."""
    moves: dict[str, bool] = {}
    for info in snapshot.frames:
        chain: list[FrameInfo] = []
        one: FrameInfo | None = info
        while one is not None and one.frame not in moves and len(chain) <= len(snapshot.frames):
            chain.append(one)
            above = one.parent or ""
            one = snapshot.frame(above) if above in snapshot else None
        known = one is not None and moves.get(one.frame, False)
        for link in reversed(chain):
            known = known or (link.parent is not None and not link.is_static)
            moves[link.frame] = known
    all_move = moves.get(fixed, False)
    root = snapshot.frame(fixed).root if fixed in snapshot else None
    return [
        info.frame
        for info in snapshot.frames
        if info.frame != fixed
        and info.root == root
        and (all_move or moves[info.frame])
        and not (info.is_static and moves.get(info.parent or "", False))
    ]


def pictured(
    snapshot: Snapshot,
    fixed: str,
    lookup: Lookup,
    ages: Mapping[str, float],
    turtles: frozenset[str] = frozenset(),
) -> PlanePicture:
    """Draw the tree of `fixed`, every frame by a lookup in it; the other trees apart.

    Args:
        snapshot: Which frames there are.
        fixed: What they are drawn in.
        lookup: Gives their poses.
        ages: Seconds since there was news of each.
        turtles: The frames drawn as turtles.
    """
    root = snapshot.frame(fixed).root if fixed in snapshot else None
    frames, nowhere = [], []
    for info in snapshot.frames:
        if info.root != root or root is None:
            continue
        pose = lookup(fixed, info.frame)
        if pose is None or not abs(pose.translation.x) + abs(pose.translation.y) <= FARTHEST:
            nowhere.append(info.frame)
            continue
        frames.append(_seen(info, pose, lookup(fixed, info.parent) if info.parent else None,
                            ages.get(info.frame, 0.0), info.frame in turtles))  # fmt: skip
    nowhere += snapshot.loops()
    others = [one for one in snapshot.roots() if one != root]
    inside = in_snapshot(snapshot)
    apart = tuple(_apart(snapshot, one, inside, ages) for one in others)
    return PlanePicture(fixed, tuple(frames), apart=apart, nowhere=tuple(nowhere))


def _apart(
    snapshot: Snapshot, root: str, lookup: Lookup, ages: Mapping[str, float]
) -> PlanePicture:
    frames = []
    for info in snapshot.frames:
        pose = lookup(root, info.frame) if info.root == root else None
        if pose is not None and abs(pose.translation.x) + abs(pose.translation.y) <= FARTHEST:
            parent = lookup(root, info.parent) if info.parent else None
            frames.append(_seen(info, pose, parent, ages.get(info.frame, 0.0), False))
    return PlanePicture(root, tuple(frames))


def _seen(
    info: FrameInfo, pose: Transform, parent: Transform | None, age: float, is_turtle: bool
) -> PlaneFrame:
    place = pose.translation
    axes = tuple(pose.rotate(axis)[:2] for axis in _AXES)
    return PlaneFrame(
        info.frame,
        place.x,
        place.y,
        axes,
        None if parent is None else (parent.translation.x, parent.translation.y),
        age,
        is_turtle,
    )


_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
