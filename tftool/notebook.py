"""Formatters for notebooks: trees as pictures, poses and recordings as tables, a 3-D view.

`import tftool` registers these formatters if IPython runs. The formatted classes are registered by
name without an import, so that unused classes take no time.
"""

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tftool.base.plain_text import short_size, visible

if TYPE_CHECKING:
    from tftool.buffer.batch.transform_array import TransformArray
    from tftool.buffer.buffer import Buffer
    from tftool.buffer.sample import Snapshot
    from tftool.doctor.findings import Finding
    from tftool.frames.frames import Frames
    from tftool.recordings.recording import Recording
    from tftool.robots.robot_model import Robot

ROWS: Final = 10
"""Number of rows shown of a long array, half of them from its end."""

_HEADS: Final = ("stamp", "x", "y", "z", "qx", "qy", "qz", "qw")


def register() -> None:
    """Register the formatters with the running notebook; do nothing outside a notebook."""
    module = sys.modules.get("IPython")
    shell = module.get_ipython() if module is not None else None
    if shell is None or shell.display_formatter is None:
        return
    formatters = shell.display_formatter.formatters
    for kind, module_name, class_name, show in _SHOWN:
        formatters[kind].for_type_by_name(module_name, class_name, show)


def buffer_picture(buffer: "Buffer") -> str:
    """Return the tree of a buffer's frames as SVG, with ages relative to the newest stamp."""
    snapshot = buffer.snapshot(0)
    newest = max((frame.newest for frame in snapshot.frames if frame.newest), default=0)
    return snapshot_picture(buffer.snapshot(newest))


def frames_picture(frames: "Frames") -> str:
    """Return the tree of opened frames as SVG, at the end of the time span."""
    return snapshot_picture(frames.buffer.snapshot(frames.span[1]))


def snapshot_picture(snapshot: "Snapshot") -> str:
    """Return the tree of a snapshot's frames as SVG, like `tftool tree -o`."""
    from tftool.drawing import picture, svg

    return svg.render(picture.lay_out(snapshot))


def array_table(poses: "TransformArray") -> str:
    """Return the first and last poses as an HTML table; an invalid pose has empty cells."""
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
    """Return the contents of a recording as HTML, with the same text as `tftool info`."""
    from tftool.drawing import recording_view as info

    return f"<pre>{escape(info.as_text(recording))}</pre>"


def finding_table(finding: "Finding") -> str:
    """Return a finding of the doctor, with evidence and remedies, as HTML."""
    rows = [("", finding.message), *(("", line) for line in finding.evidence)]
    rows.append(("so", finding.consequence))
    rows.extend(("fix", f"{fix.text} {fix.command}".rstrip()) for fix in finding.fixes)
    return _table(f"{finding.severity.value} {finding.id}", (), rows)


@dataclass(frozen=True, slots=True)
class PageView:
    """Page of `tftool view` with all data, for a notebook's output or a file.

    Attributes:
        html: Text of the page, which loads no other file.
        height: Height in a notebook, pixels.
    """

    html: str
    height: int

    def __repr__(self) -> str:
        return f"<PageView, {short_size(len(self.html))}; .save('view.html') writes it to a file>"

    def _repr_html_(self) -> str:
        # In a frame of its own, it reaches nothing of the notebook.
        return (
            f'<iframe srcdoc="{escape(self.html)}" sandbox="allow-scripts allow-downloads" '
            f'style="width: 100%; height: {self.height}px; border: 0" title="tftool view"></iframe>'
        )

    def save(self, path: str | Path, *, force: bool = False) -> None:
        """Write the page to a file that any browser opens.

        Args:
            path: Path of the file, ending in .html.
            force: Whether to replace an existing file.

        Raises:
            UsageError: If the file exists and `force` is not set.
            InputError: If the file cannot be written.
        """
        from tftool.recordings.target import whole_file

        with whole_file(Path(path), force=force) as file:
            file.write(self.html.encode())


def view(
    shown: "Buffer | Frames | Recording",
    *,
    robot: "Robot | None" = None,
    meshes: Sequence[str | Path] = (),
    height: int = 480,
) -> PageView:
    """Return a page that shows frames in 3-D; a notebook displays the page below the cell.

    Outside a notebook, `.save("view.html")` writes the page to a file.

    Args:
        shown: Source of the frames: a buffer, a recording, or opened frames.
        robot: Robot to draw; None for the robot of the source.
        meshes: Folders with the robot's meshes.
        height: Height in a notebook, pixels.

    Returns:
        Page with all data, as `tftool view -o` writes to a file.

    Raises:
        InputError: If no part of the recording can be read.
        TypeError: If `shown` is not a source of frames.
    """
    from tftool.screens.browser.standalone import page_of

    return PageView(page_of(shown, robot, meshes).content.decode(), height)


def _table(title: str, heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return an HTML table.

    Args:
        title: Caption of the table.
        heads: Headings of the columns; empty for no headings.
        rows: Texts of the cells by row; HTML characters are escaped.
    """

    def cells(tag: str, texts: Sequence[str]) -> str:
        inner = "".join(f"<{tag}>{escape(visible(text))}</{tag}>" for text in texts)
        return f"<tr>{inner}</tr>"

    head = f"<thead>{cells('th', heads)}</thead>" if heads else ""
    body = "".join(cells("td", row) for row in rows)
    return f"<table><caption>{escape(visible(title))}</caption>{head}<tbody>{body}</tbody></table>"


_SHOWN: Final[tuple[tuple[str, str, str, Callable[[Any], str]], ...]] = (
    ("image/svg+xml", "tftool.buffer.buffer", "Buffer", buffer_picture),
    ("image/svg+xml", "tftool.buffer.sample", "Snapshot", snapshot_picture),
    ("text/html", "tftool.buffer.batch.transform_array", "TransformArray", array_table),
    ("image/svg+xml", "tftool.frames.frames", "Frames", frames_picture),
    ("text/html", "tftool.recordings.recording", "Recording", recording_table),
    ("text/html", "tftool.doctor.findings", "Finding", finding_table),
)
