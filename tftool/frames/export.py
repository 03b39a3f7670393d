"""All frames as text: tf2's YAML, sentences and dot, and rows for JSON."""

from collections.abc import Iterable
from typing import Any

from tftool.frames.names import NO_PARENT_NAME
from tftool.frames.sample import FrameInfo, Snapshot
from tftool.geometry.rigid import Transform
from tftool.stamps import Stamp, as_seconds, display


def as_yaml(frames: Iterable[FrameInfo], current_time: Stamp = 0) -> str:
    """The frames as tf2 writes them in YAML.

    Args:
        frames: In the order to be written; those that hang from nothing are left out.
        current_time: If not 0, each frame also says how old its newest sample was then.

    Returns:
        tf2's text, names unquoted: "[]" when there are no frames at all, and nothing
        when none has data.
    """
    frames = list(frames)
    if not frames:
        return "[]"
    lines: list[str] = []
    for info in frames:
        if info.parent is None:
            continue
        lines += [
            f"{info.frame}: ",
            f"  parent: '{info.parent}'",
            f"  broadcaster: '{info.authority or 'no recorded authority'}'",
            f"  rate: {info.rate:.3f}",
            f"  most_recent_transform: {display(info.newest)}",
            f"  oldest_transform: {display(info.oldest)}",
        ]
        if current_time != 0:
            lines.append(f"  transform_delay: {as_seconds(current_time - info.newest):.3f}")
        lines.append(f"  buffer_length: {as_seconds(info.buffer_length):.3f}")
    return "".join(f"{line}\n" for line in lines)


def as_string(frames: Iterable[FrameInfo]) -> str:
    """One sentence for each frame that anybody ever sent, as tf2 has them."""
    return "".join(
        f"Frame {info.frame} exists with parent {info.parent or NO_PARENT_NAME}.\n"
        for info in frames
        if info.authority is not None
    )


def as_dot(frames: Iterable[FrameInfo], current_time: Stamp = 0) -> str:
    """The frames as tf2's core writes them for Graphviz (`view_frames` prints another).

    Names are written as they are: escape them first if they come from strangers.
    """
    frames = list(frames)
    if not frames:
        return 'digraph G {\n"no tf data recieved"}'
    text = "digraph G {\n"
    for info in frames:
        if info.parent is None:
            continue
        age = ""
        if current_time != 0:
            age = f"( {as_seconds(current_time - info.newest):.3f} sec old)"
        text += (
            f'"{info.parent}" -> "{info.frame}"'
            f'[label="Broadcaster: {info.authority or "no recorded authority"}\\n'
            f"Average rate: {info.rate:.3f} Hz\\n"
            f"Most recent transform: {display(info.newest)} {age}\\n"
            f'Buffer length: {as_seconds(info.buffer_length):.3f} sec\\n"];\n'
        )
    for info in frames:
        never_sent = info.authority is None
        if info.parent is not None or (never_sent and current_time == 0):
            continue
        text += "edge [style=invis];\n subgraph cluster_legend { style=bold; color=black; "
        text += 'label ="view_frames Result";\n'
        if current_time != 0:
            text += f'"Recorded at time: {display(current_time)}"[ shape=plaintext ] ;\n '
        text += f'}}->"{info.frame}";\n'
    return text + "}"


def as_rows(snapshot: Snapshot) -> list[dict[str, Any]]:
    """One dictionary for each frame, ready for `json.dumps`.

    Stamps and lengths of time are whole nanoseconds, metres and xyzw quaternions plain
    lists, and what is not known is None.
    """
    return [
        {
            "frame": info.frame,
            "parent": info.parent,
            "static": info.is_static,
            "authority": info.authority,
            "samples": info.samples,
            "rate": info.rate,
            "oldest": info.oldest,
            "newest": info.newest,
            "buffer_length": info.buffer_length,
            "age": info.age,
            "transform": _row(info.transform),
            "root": info.root,
            "root_from_frame": _row(info.root_from_frame),
        }
        for info in snapshot.frames
    ]


def _row(transform: Transform | None) -> dict[str, list[float]] | None:
    if transform is None:
        return None
    return {"translation": list(transform.translation), "rotation": list(transform.rotation)}
