import json
import re
import subprocess
import sys
from io import BytesIO
from pathlib import Path

import pytest
import yaml

from tests.recordings.writers import Sent, numbers, write_mcap
from tftool import Buffer, Transform, TransformStamped
from tftool.drawing.picture import lay_out
from tftool.drawing.tree_picture import png

ROOT = Path(__file__).parents[2]


def test_the_tree_of_a_scenario_is_the_same_each_time(tftool):
    result = tftool("tree", "turtles")

    assert result.status == 0
    assert result.err == ""
    lines = result.out.split("\n")
    assert lines[0] == "Recorded at time: 1005.000000"
    assert lines[3] == "world"
    assert lines[4].split() == [
        "├──", "turtle1", "dynamic", "broadcaster1", "62.700", "Hz", "4.992", "s",
        "1000.000000", "1004.992000", "0.008", "s",
    ]  # fmt: skip
    assert tftool("tree", "turtles").out == result.out


def test_without_a_source_it_shows_the_hosted_turtles(tftool):
    result = tftool("tree")

    assert result.err == "No session is running here: hosting scenario 'turtles'.\n"
    assert "turtle2" in result.out


def test_a_chosen_moment_is_simulated_whatever_runs_here(tftool):
    result = tftool("tree", "--at", "0.5")

    assert result.err == "A requested time is always simulated: hosting scenario 'turtles'.\n"
    assert result.out.startswith("Recorded at time: 1000.500000\n")


def test_the_moment_can_be_chosen(tftool):
    result = tftool("tree", "turtles", "--at", "0.5")

    assert "turtle2" not in result.out
    assert result.out.startswith("Recorded at time: 1000.500000\n")


def test_several_trees_are_all_shown(tftool):
    assert "2 separate trees:" in tftool("tree", "two_trees", "--at", "1").out


@pytest.mark.parametrize("way", ["format", "suffix"])
@pytest.mark.parametrize(
    ("form", "suffix", "opening"),
    [
        ("tree", "txt", b"Recorded at time"),
        ("json", "json", b"{"),
        ("yaml", "yml", b"turtle1:\n"),
        ("dot", "gv", b"digraph G {"),
        ("mermaid", "mmd", b""),
        ("svg", "svg", b"<"),
        ("html", "html", b"<!doctype html>"),
        ("pdf", "pdf", b"%PDF"),
        ("png", "png", b"\x89PNG"),
    ],
)
def test_a_file_gets_what_its_suffix_or_the_format_says(
    tftool, tmp_path, way, form, suffix, opening
):
    file = tmp_path / (f"frames.{suffix}" if way == "suffix" else "frames")
    words = ["-o", file] if way == "suffix" else ["-o", file, "--format", form]

    result = tftool("tree", "turtles", *words)

    assert (result.status, result.out) == (0, "")
    assert result.err.endswith(f"Wrote 3 frames to {file}.\n")
    content = file.read_bytes()
    assert content.startswith(opening)
    assert b"turtle1" in content or form in ("pdf", "png")


def test_a_png_names_the_letters_that_its_font_lacks(tftool, tmp_path):
    pytest.importorskip("matplotlib")
    (tmp_path / "odd.yaml").write_text(
        'duration: 6 s\nnodes: [static: {parent: "日本", child: "wörld"}]\n', encoding="utf-8"
    )

    told = tftool("tree", tmp_path / "odd.yaml", "-o", tmp_path / "odd.png").err

    assert "the PNG's font has no letter for 日 本: svg and html show these letters\n" in told


def test_a_long_name_in_a_png_ends_before_the_word_static():
    pytest.importorskip("matplotlib")
    from matplotlib.image import imread

    buffer = Buffer()
    name = "a very long frame name that goes on and on_0123456789_0123456789"
    buffer.set_transform_static(TransformStamped(0, "world", name, Transform()))
    snapshot = buffer.snapshot(0)
    (note,) = [one for one in lay_out(snapshot).texts if one.kind == "note"]
    image = imread(BytesIO(png(snapshot).content))

    # Two pixels are one unit of the picture.
    x, y = round(2 * note.x), round(2 * note.y)
    gap = image[y - 20 : y + 4, x - 14 : x - 4]
    assert gap.min(axis=(0, 1)).tolist() == gap.max(axis=(0, 1)).tolist()


def test_data_for_programs_is_what_it_says_it_is(tftool):
    frames = json.loads(tftool("tree", "turtles", "--format", "json").out)["frames"]
    links = yaml.safe_load(tftool("tree", "turtles", "--format", "yaml").out)

    assert {frame["frame"] for frame in frames} == {"world", "turtle1", "turtle2"}
    assert links["turtle2"]["parent"] == "world"


def test_a_pdf_goes_down_a_pipe_as_bytes():
    done = subprocess.run(
        [sys.executable, "-m", "tftool", "tree", "turtles", "--format", "pdf", "-o", "-"],
        cwd=ROOT,
        capture_output=True,
        check=True,
    )

    assert done.stdout.startswith(b"%PDF")


@pytest.mark.parametrize(
    ("words", "status", "sentence"),
    [
        (["-o", "frames.bmp"], 2, "'frames.bmp' has no known suffix"),
        (["-o", "/"], 2, "'/' is a folder: name a file in it."),
        (
            ["-o", "/nowhere/frames.svg"],
            3,
            "'/nowhere/frames.svg' cannot be written: there is no folder '/nowhere'",
        ),
        (["--watch"], 2, "--watch needs a terminal"),
        (["--watch", "--format", "json"], 2, "leave out --format"),
        (["--json", "--format", "dot"], 2, "--json and --format dot are two output formats"),
        (["--for", "1"], 2, "--for is only allowed with --watch"),
        (
            ["--at", "1e9"],
            2,
            "scenario 'turtles' ends at 1060: the time 1000000000 is after this end.",
        ),
        (["nosuch"], 3, "no scenario is named 'nosuch'"),
    ],
)
def test_tree_refuses_invalid_arguments_with_a_reason(tftool, words, status, sentence):
    result = tftool("tree", *words)

    assert result.status == status
    assert sentence in result.err
    assert result.out == ""


def test_a_terminal_gets_colour_and_what_fits_its_width(tftool, monkeypatch):
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("COLUMNS", "60")

    result = tftool("tree", "robot")

    assert "\x1b[1mmap\x1b[0m\n" in result.out
    assert "\x1b[2m└── \x1b[0modom" in result.out
    lines = [re.sub(r"\x1b\[[0-9;]*m", "", line) for line in result.out.splitlines()]
    assert max(map(len, lines)) <= 60
    assert [line.split() for line in lines[2:4]] == [
        ["└──", "odom", "localization", "10.2", "Hz", "0.00", "s"],
        ["└──", "base_link", "odometry", "50.2", "Hz", "0.00", "s"],
    ]


def test_on_a_terminal_wide_lines_have_all_there_is(tftool, monkeypatch):
    monkeypatch.setenv("COLUMNS", "60")
    piped = tftool("tree", "robot").out
    monkeypatch.setenv("FORCE_COLOR", "1")

    result = tftool("tree", "robot", "--wide")

    assert re.sub(r"\x1b\[[0-9;]*m", "", result.out) == piped


def test_a_name_that_is_cut_is_said_to_be(tftool, tmp_path, monkeypatch):
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("COLUMNS", "40")
    file = tmp_path / "long.yaml"
    name = "front_left_wheel_encoder_optical_frame"
    file.write_text(
        f"duration: 9 s\nnodes:\n  - static: {{parent: world, child: {name}}}\n", encoding="utf-8"
    )

    assert "--wide prints the full names" in tftool("tree", file).out
    assert name in tftool("tree", file, "--wide").out


def test_no_color_is_kept(tftool, monkeypatch):
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("NO_COLOR", "1")

    assert "\x1b[3" not in tftool("tree", "robot").out


def test_a_pdf_is_not_thrown_at_a_terminal(tftool, monkeypatch):
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)

    result = tftool("tree", "turtles", "--format", "pdf")

    assert result.status == 2
    assert "name a file with -o FILE" in result.err


def test_it_is_drawn_again_and_again_on_the_worlds_own_ticks(tftool, simulated, monkeypatch):
    monkeypatch.setenv("FORCE_COLOR", "1")

    result = tftool("tree", "turtles", "--watch", "--for", "1")

    assert result.status == 0
    # After the head start of three seconds, both turtles exist.
    for moment in ("1003.000", "1003.500", "1004.000"):
        assert f"at {moment}" in result.out
    assert "at 1004.500" not in result.out


def test_a_terminal_that_goes_is_left_as_it_was(tftool, simulated, monkeypatch):
    monkeypatch.setenv("FORCE_COLOR", "1")

    out = tftool("tree", "turtles", "--watch", "--for", "1").out

    assert out.count("\x1b[?1049h") == out.count("\x1b[?1049l") == 1
    assert out.rindex("\x1b[?25h") > out.rindex("\x1b[?25l")


TROUBLE = """
duration: 12 s
nodes:
  - static: {parent: world, child: table}
script:
  - {at: 0 s, broadcast: {parent: world, child: cart, x: 1}, every: 0.1 s, for: 12 s}
  - {at: 0 s, broadcast: {parent: cart, child: lamp, x: 1}, every: 0.1 s, for: 3 s}
  - {at: 0 s, broadcast: {parent: world, child: cup, x: 1}, every: 0.1 s, for: 12 s}
  - {at: 0.05 s, broadcast: {parent: cart, child: cup, x: 1}, every: 0.1 s, for: 11 s}
"""


def test_a_frame_with_a_finding_is_marked_in_the_tree(tftool, tmp_path):
    file = tmp_path / "trouble.yaml"
    file.write_text(TROUBLE, encoding="utf-8")
    result = tftool("tree", file, "--at", "8")
    assert "lamp (edge-stopped) " in result.out
    assert "cup (two-parents) " in result.out
    assert "'tftool doctor --explain " in result.out
    told = json.loads(tftool("tree", file, "--at", "8", "-f", "json").out)["frames"]
    assert {one["frame"]: one["marks"] for one in told if one["marks"]} == {
        "lamp": ["edge-stopped"], "cup": ["two-parents"],
    }  # fmt: skip
    # After three seconds, the lamp is still published.
    assert "edge-stopped" not in tftool("tree", file, "--at", "3").out


def test_a_wrong_limit_of_memory_is_no_fault_of_the_scenario(tftool, monkeypatch):
    monkeypatch.setenv("TFTOOL_BUFFER_MB", "abc")

    result = tftool("tree", "turtles")

    assert result.status == 2
    assert result.err == (
        "tftool: TFTOOL_BUFFER_MB='abc' is not a number of megabytes: set it to 512, or unset it.\n"
    )


def test_two_static_parents_stand_beside_the_frame(tftool, simulated, monkeypatch, tmp_path):
    played = tmp_path / "cam.yaml"
    played.write_text(
        "duration: 1 s\nnodes:\n"
        "  - static: {parent: map, child: cam}\n  - static: {parent: odom, child: cam}\n",
        encoding="utf-8",
    )
    sent = [
        Sent(k, "/tf_static", ((0, parent, "cam", numbers(1)),))
        for k, parent in ((1, "map"), (2, "odom"), (3, "map"))
    ]
    recorded = write_mcap(tmp_path / "run.mcap", sent)

    assert "cam (two-parents)" in tftool("tree", played).out
    monkeypatch.setenv("FORCE_COLOR", "1")
    assert "two-parents" in tftool("tree", played, "--watch", "--for", "1").out
    monkeypatch.delenv("FORCE_COLOR")
    result = tftool("tree", recorded)
    assert "cam (two-parents)" in result.out
    assert (
        "'cam' has a static transform in each of 2 parents: the last one, in 'map', is used, "
        "not 'odom'.\n"
    ) in result.err
    result = tftool("explain", "map", "cam", recorded)
    assert result.status == 0
    assert "cam has the parents map, odom, and the one sent last" in " ".join(result.out.split())


def test_nothing_stands_beside_frames_that_are_as_they_should_be(tftool):
    for name in ("turtles", "robot", "square"):
        assert "doctor" not in tftool("tree", name).out


@pytest.mark.skipif(sys.platform == "win32", reason="limits of a process are POSIX")
@pytest.mark.parametrize(
    "words",
    [["tree", "robot", "--at", "1", "--force", "-o"], ["check", "turtles", "--junit"]],
)
def test_a_file_that_cannot_be_completed_leaves_the_one_before(tmp_path, words):
    kept = tmp_path / "kept.txt"
    kept.write_text("before")
    code = (
        "from tests.full_disk import full_disk\n"
        "from tftool.app.main import main\n"
        "with full_disk(20):\n"
        "    raise SystemExit(main())\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, *words, kept], capture_output=True, text=True, cwd=ROOT
    )

    assert done.returncode == 3, done.stderr
    assert "cannot be written: File too large" in done.stderr
    assert [(one.name, one.read_text()) for one in tmp_path.iterdir()] == [("kept.txt", "before")]


def test_a_file_is_replaced_only_by_force(tftool, simulated, tmp_path):
    file = tmp_path / "tree.svg"
    file.write_text("mine")

    refused = tftool("tree", "robot", "-o", file)
    assert refused.status == 2
    assert "--force" in refused.err
    assert file.read_text() == "mine"
    assert tftool("tree", "robot", "-o", file, "--force").status == 0
    assert file.read_text().startswith("<svg")
