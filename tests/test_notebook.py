"""Tests of values in a notebook; the notebook in docs/ is run in IPython's own kernel."""

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import pytest

import tftool
from tftool import Buffer, Transform, TransformStamped, UsageError, seconds

NOTEBOOK = Path(__file__).parents[1] / "docs" / "learn" / "notebook.ipynb"

RUN = """
import json, sys, warnings
warnings.simplefilter("ignore")
import nbformat
from nbclient import NotebookClient
notebook = nbformat.read(sys.argv[1], as_version=4)
NotebookClient(notebook, timeout=300, startup_timeout=300, kernel_name="python3").execute()
print(json.dumps([cell.get("outputs", []) for cell in notebook.cells if cell.cell_type == "code"]))
"""

SHOWN = """
from IPython.core.interactiveshell import InteractiveShell
shell = InteractiveShell.instance()
from tftool import Buffer, Transform, TransformStamped, diagnose
buffer = Buffer()
name = "<script>\\x1b[2J"
buffer.set_transform(TransformStamped(10**9, "world", name, Transform()), "me")
poses = buffer.lookup_transforms("world", name, [10**9])
values = [buffer, buffer.snapshot(0), poses, *diagnose(buffer)]
for value in values:
    for kind, text in shell.display_formatter.format(value)[0].items():
        if kind != "text/plain":
            assert "<script" not in text and "\\x1b" not in text, text
            print(type(value).__name__, kind)
"""


def told(code, *words, place):
    done = subprocess.run(
        [sys.executable, "-c", code, *words],
        cwd=place,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.skipif(not importlib.util.find_spec("nbclient"), reason="nbclient is not installed")
def test_the_notebook_of_the_docs_runs_and_shows_trees_and_tables(tmp_path):
    buffer, poses, why, view = json.loads(told(RUN, str(NOTEBOOK), place=tmp_path))

    (shown,) = [one["data"] for one in buffer if one["output_type"] == "execute_result"]
    assert "laser" in "".join(shown["image/svg+xml"])
    (shown,) = [one["data"] for one in poses if one["output_type"] == "execute_result"]
    table = "".join(shown["text/html"])
    assert "laser in world: 20 poses, 17 valid" in table
    # The header, five rows of each end, and a row of dots between them
    assert table.count("<tr>") == 12
    assert "newest" in "".join(why[0]["text"]) or "ended" in "".join(why[0]["text"])
    (shown,) = [one["data"] for one in view if one["output_type"] == "execute_result"]
    assert "".join(shown["text/html"]).startswith("<iframe srcdoc=")
    assert "view.html" in "".join(shown["text/plain"])


@pytest.mark.skipif(
    not (importlib.util.find_spec("nbclient") and importlib.util.find_spec("matplotlib")),
    reason="nbclient, or the extra 'plot', is not installed",
)
def test_a_notebook_shows_each_plot_once_and_later_figures_of_others_too(tmp_path):
    import nbformat

    made = """
from tftool import Buffer, Transform, TransformStamped, plot
buffer = Buffer()
buffer.set_transform(TransformStamped(10**9, "world", "car", Transform()), "me")
path = buffer.lookup_transforms("world", "car", [10**9])
"""
    cells = {
        made: 0,
        "plot(path)": 1,
        "plot(path);": 1,
        "figure = plot(path)\nfigure": 1,
        "figure": 1,
        "plot(path, what='x')\nplot(path, what='y')": 2,
        "from matplotlib import pyplot\npyplot.figure().subplots();": 1,
        "figure, axes = pyplot.subplots()\nplot(path, ax=axes);": 1,
    }
    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(one) for one in cells])
    nbformat.write(book, tmp_path / "plots.ipynb")

    shown = json.loads(told(RUN, "plots.ipynb", place=tmp_path))

    counts = [sum("image/png" in one.get("data", ()) for one in outputs) for outputs in shown]
    assert dict(zip(cells, counts, strict=True)) == cells


def test_a_view_is_a_frame_of_its_own_that_gives_nothing_away(tmp_path):
    buffer = Buffer()
    pose = TransformStamped(seconds(2), "world", '"></iframe><script>', Transform())
    buffer.set_transform(pose, "</iframe>")

    shown = tftool.view(buffer, height=300)
    shown.save(tmp_path / "view.html")

    written = shown._repr_html_()
    assert written.count("<") == 2
    assert "allow-same-origin" not in written
    assert "height: 300px" in written
    assert (tmp_path / "view.html").read_text("utf-8") == shown.html
    with pytest.raises(UsageError, match="exists"):
        shown.save(tmp_path / "view.html")
    with pytest.raises(TypeError, match="expected a Recording or a Buffer"):
        tftool.view("run.mcap")


@pytest.mark.skipif(not importlib.util.find_spec("IPython"), reason="IPython is not installed")
def test_each_value_has_its_form_and_no_name_acts_in_it(tmp_path):
    lines = told(SHOWN, place=tmp_path).splitlines()

    assert lines[:3] == [
        "Buffer image/svg+xml",
        "Snapshot image/svg+xml",
        "TransformArray text/html",
    ]
    assert set(lines[3:]) == {"Finding text/html"}


def test_the_repr_of_edges_samples_and_findings_is_one_short_printable_line(tmp_path):
    path = tmp_path / "run.mcap"
    with tftool.write_recording(path) as recording:
        for tick in range(1, 400):
            pose = TransformStamped(seconds(tick), "world", "a\x1b[2J", Transform((tick, 0, 0)))
            recording.transforms([pose], log_time=seconds(tick + 2))

    with tftool.open_recording(path) as recording:
        assert repr(recording.edges) == (
            r"(<Edge: 399 dynamic transforms of 'a\x1b[2J' in 'world'>,)"
        )
        samples = recording.buffer.samples("a\x1b[2J")
        assert repr(samples) == r"<SampleColumns: 399 samples of 'a\x1b[2J'>"
        found = {one.id: repr(one) for one in tftool.diagnose(recording)}
    assert found["stale-stamp"].startswith(
        r"<Finding: note stale-stamp, 'a\x1b[2J in world is dated 2"
    )
    assert all(len(text) < 300 and text.isprintable() for text in found.values())


def test_without_a_notebook_nothing_is_registered_and_nothing_is_imported(tmp_path):
    code = "import sys, tftool; print('tftool.notebook' in sys.modules)"

    assert told(code, place=tmp_path) == "False\n"
