"""How values look in a notebook: trees as pictures, poses and recordings as tables.

`import tftool` registers these where IPython runs. The classes are named, not imported: what a
notebook does not show costs it nothing.
"""

import sys
from collections.abc import Callable, Sequence
from html import escape
from typing import TYPE_CHECKING, Any, Final

from tftool.views.escaping import visible

if TYPE_CHECKING:
    from tftool.diagnostics.findings import Finding
    from tftool.frames.batch.arrays import TransformArray
    from tftool.frames.buffer import Buffer
    from tftool.frames.sample import Snapshot
    from tftool.sources.recording import Recording

ROWS: Final = 10
"""How many rows of a long array are shown, half of them from its end."""

_HEADS: Final = ("stamp", "x", "y", "z", "qx", "qy", "qz", "qw")


def register() -> None:
    """Let the notebook that runs show our values; does nothing where none runs."""
    module = sys.modules.get("IPython")
    shell = module.get_ipython() if module is not None else None
    if shell is None or shell.display_formatter is None:
        return
    formatters = shell.display_formatter.formatters
    for kind, module_name, class_name, show in _SHOWN:
        formatters[kind].for_type_by_name(module_name, class_name, show)


def buffer_picture(buffer: "Buffer") -> str:
    """The frames of a buffer as SVG, ages counted from its newest stamp."""
    snapshot = buffer.snapshot(0)
    newest = max((frame.newest for frame in snapshot.frames if frame.newest), default=0)
    return snapshot_picture(buffer.snapshot(newest))


def snapshot_picture(snapshot: "Snapshot") -> str:
    """The frames of a snapshot as SVG, as `tftool tree -o` draws them."""
    from tftool.views import picture, svg

    return svg.render(picture.lay_out(snapshot))


def array_table(poses: "TransformArray") -> str:
    """The first and last poses as an HTML table; rows without a pose are empty."""
    count = len(poses)
    title = (
        f"{poses.child_frame_id} in {poses.frame_id}: {count} poses, {int(poses.valid.sum())} valid"
    )
    if count <= ROWS:
        shown: list[int | None] = list(range(count))
    else:
        half = ROWS // 2
        shown = [*range(half), None, *range(count - half, count)]
    return _table(title, _HEADS, [_row(poses, index) for index in shown])


def _row(poses: "TransformArray", index: int | None) -> Sequence[str]:
    if index is None:
        return ["…"] * len(_HEADS)
    stamp = str(int(poses.stamps[index]))
    if not poses.valid[index]:
        return [stamp, *[""] * (len(_HEADS) - 1)]
    numbers = (*poses.translations[index], *poses.rotations[index])
    return [stamp, *(f"{number:.6g}" for number in numbers)]


def recording_table(recording: "Recording") -> str:
    """What a recording holds, as `tftool info` says it."""
    from tftool.views import info

    return f"<pre>{escape(info.as_text(recording))}</pre>"


def finding_table(finding: "Finding") -> str:
    """A finding with its evidence and what mends it."""
    rows = [("", finding.message), *(("", line) for line in finding.evidence)]
    rows.append(("so", finding.consequence))
    rows.extend(("fix", f"{fix.text} {fix.command}".rstrip()) for fix in finding.fixes)
    return _table(f"{finding.severity.value} {finding.id}", (), rows)


def _table(title: str, heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """An HTML table; nothing in a name can act."""

    def cells(tag: str, texts: Sequence[str]) -> str:
        inner = "".join(f"<{tag}>{escape(visible(text))}</{tag}>" for text in texts)
        return f"<tr>{inner}</tr>"

    head = f"<thead>{cells('th', heads)}</thead>" if heads else ""
    body = "".join(cells("td", row) for row in rows)
    return f"<table><caption>{escape(visible(title))}</caption>{head}<tbody>{body}</tbody></table>"


_SHOWN: Final[tuple[tuple[str, str, str, Callable[[Any], str]], ...]] = (
    ("image/svg+xml", "tftool.frames.buffer", "Buffer", buffer_picture),
    ("image/svg+xml", "tftool.frames.sample", "Snapshot", snapshot_picture),
    ("text/html", "tftool.frames.batch.arrays", "TransformArray", array_table),
    ("text/html", "tftool.sources.recording", "Recording", recording_table),
    ("text/html", "tftool.diagnostics.findings", "Finding", finding_table),
)
