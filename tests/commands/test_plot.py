"""Tests of `tftool plot`: on the terminal, live, and as a picture."""

import json
import re
import sys
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from rich.console import Console

import tftool as library
from tests.command_line import Simulated
from tests.frames.test_series import SECOND, circling
from tftool.app.main import main
from tftool.base.stamps import seconds
from tftool.buffer.batch.transform_array import TransformArray
from tftool.commands.plot.plot_live import PlotSight
from tftool.drawing.line_plot import PlotLook, over_time
from tftool.frames.pair_samples import trajectory_of
from tftool.frames.pair_series import chosen, round_ticks, tick_labels


@pytest.fixture
def run(tmp_path):
    library.export(circling(np.arange(1.0, 21.0, 0.05)), path=tmp_path / "run.mcap")
    return tmp_path / "run.mcap"


def test_a_recording_is_drawn_at_eighty_columns(tftool, run):
    result = tftool("plot", "map", "car", run)

    lines = result.out.splitlines()
    assert result.status == 0
    assert result.err == ""
    assert max(map(len, lines)) <= 80
    assert [line for line in lines if "│" not in line][:3] == [
        "car in map",
        "position, m  x 1.654  y 1.124  z 0.500",
        "rotation, °  roll 0  pitch 0  yaw 124.2",
    ]
    assert lines[2].startswith("         2│")
    assert lines[-1].split() == ["0", "5", "10", "15", "20", "s"]


def test_a_recording_is_drawn_as_high_as_the_terminal(run, monkeypatch, capsys):
    monkeypatch.setattr(Console, "is_terminal", True)
    heights = []
    for lines in (24, 60):
        monkeypatch.setenv("LINES", str(lines))
        monkeypatch.setenv("COLUMNS", "100")
        assert main(["plot", "map", "car", str(run)]) == 0
        heights.append(len(capsys.readouterr().out.splitlines()))

    assert heights[0] < 24
    assert 50 < heights[1] < 60


def test_curves_in_ascii_are_drawn_with_the_signs_in_the_title(tftool, run):
    lines = tftool("plot", "map", "car", run, "--ascii").out.splitlines()

    assert lines[1] == "position, m  1 x 1.654  2 y 1.124  3 z 0.500"
    position = "".join(lines[2:9])
    assert all(2 <= position.count(sign) < 12 for sign in "123")
    assert position.count("-") > 60
    # A curve alone in its panel is drawn with strokes.
    assert next(line for line in lines if line.startswith("distance")).startswith("distance, m  2")


def test_curves_on_a_terminal_without_colours_have_signs(run, monkeypatch, capsys):
    monkeypatch.setattr(Console, "is_terminal", True)
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("COLUMNS", "100")

    assert main(["plot", "map", "car", str(run), "--only", "roll,pitch,yaw"]) == 0

    lines = re.sub("\x1b[^m]*m", "", capsys.readouterr().out).splitlines()
    assert lines[1] == "rotation, °  1 roll 0  2 pitch 0  3 yaw 124.2"
    # Roll and pitch are equal: each one has its own sign on the same line.
    assert any(re.search(r"⠤1⠤+2⠤", line) for line in lines)


def test_a_panel_without_room_says_how_to_see_its_curve():
    stamps = np.arange(3) * seconds(1) + 1
    turns = np.tile([0.0, 0.0, 0.0, 1.0], (3, 1))
    still = TransformArray("map", "car", stamps, np.zeros((3, 3)), turns, np.ones(3, bool))

    look = PlotLook(80, 12, numbered=True)
    lines = over_time([trajectory_of(still)], 1, chosen([]), look).plain.splitlines()

    assert "turn rate, °/s  9: 0  (a taller window shows the curve, or the key i)" in lines
    assert not any("window" in line for line in lines if line.startswith("position"))


def test_a_value_that_is_noise_is_written_as_zero():
    stamps = np.arange(5) * seconds(1) + 1
    moves = np.stack([np.linspace(1.0, 3.7e-8, 5), np.ones(5), np.zeros(5)], 1)
    turns = np.tile([0.0, 0.0, 0.0, 1.0], (5, 1))
    path = trajectory_of(TransformArray("map", "car", stamps, moves, turns, np.ones(5, bool)))

    drawn = over_time([path], 1, chosen(["position"]), PlotLook(80, 12)).plain

    assert "x 0  y 1.000  z 0" in drawn


def test_a_small_value_has_the_decimals_of_the_values_beside_it():
    stamps = np.arange(3) * seconds(1) + 1
    moves = np.array([[3.0, 1.0, 0.0], [1.0, 0.5, 0.0], [0.006, 4.14e-6, 0.0]])
    turns = np.tile([0.0, 0.0, 0.0, 1.0], (3, 1))
    path = trajectory_of(TransformArray("map", "car", stamps, moves, turns, np.ones(3, bool)))

    drawn = over_time([path], 1, chosen(["position"]), PlotLook(80, 12)).plain

    assert "x 0.006  y 0.000  z 0" in drawn


def test_a_line_rises_where_the_value_does(tftool, tmp_path):
    from tftool import Buffer, Transform, TransformStamped, seconds

    buffer = Buffer(seconds(1000))
    for n in range(101):
        pose = Transform((0.1 * n, 0.0, 0.0))
        buffer.set_transform(TransformStamped(SECOND + n * SECOND // 10, "map", "car", pose))
    library.export(buffer, path=tmp_path / "ramp.mcap")

    out = tftool("plot", "map", "car", tmp_path / "ramp.mcap", "--only", "x", "--ascii").out

    rows = [line.partition("|")[2] for line in out.splitlines() if "|" in line]
    starts = [len(row) - len(row.lstrip()) for row in rows]
    assert out.isascii()
    assert starts == sorted(starts, reverse=True)
    assert rows[-1][0] != " "
    assert len(rows[0]) == 69


def test_times_without_a_pose_are_shaded_and_reported(tftool, run):
    out = tftool("plot", "map", "car", run, "--every", "0.5", "--to", "40", "--only", "x").out

    shaded = [line.rstrip().count("░") for line in out.splitlines() if "│" in line]
    assert min(shaded) > 30
    assert "No pose from 20.00 s to 40.00 s: the data ends earlier (car in map)." in out


def test_the_path_from_above_is_round(tftool, run):
    out = tftool("plot", "map", "car", run, "--xy").out

    rows = [line.partition("│")[2] for line in out.splitlines() if "│" in line]
    inked = [row for row in rows if row.strip()]
    across = max(map(len, inked)) - min(len(row) - len(row.lstrip()) for row in inked)
    assert "car in map begins at 1.618" in out
    # A cell is twice as high as it is wide.
    assert 0.9 < across / (2 * len(inked)) < 1.1


def test_json_holds_the_values_of_each_curve(tftool, run):
    result = tftool("plot", "map", "car", run, "--only", "distance", "--json")

    (panel,) = json.loads(result.out)["panels"]
    (curve,) = panel["curves"]
    assert (panel["unit"], curve["target"], curve["source"]) == ("m", "map", "car")
    assert curve["times_s"][:2] == pytest.approx([0.0, 0.05])
    # The frame circles the origin at a radius of two metres, half a metre above it.
    assert curve["values"] == pytest.approx([np.hypot(2.0, 0.5)] * len(curve["times_s"]))
    assert tftool("plot", "map", "car", run, "--json", "--xy").status == 2


def test_several_pairs_share_a_panel(tftool, run):
    out = tftool("plot", run, "--pair", "map:car", "--pair", "car:map", "--only", "distance").out

    assert out.splitlines()[0] == "distance, m  car in map 2.062  map in car 2.062"


def test_a_scenario_is_drawn_whole(tftool, simulated):
    result = tftool("plot", "world", "turtle1", "turtles", "--only", "x", "--for", "5")

    assert result.status == 0
    axis = next(line for line in result.out.splitlines() if line.endswith(" s"))
    assert axis.split() == ["0", "2", "4", "s"]


def test_a_live_plot_ends_with_for(monkeypatch, capsys):
    class Terminal(Simulated):
        """Terminal of a world on simulated time, so that a live plot takes no time."""

    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("LINES", "30")

    status = main(["plot", "turtle2", "turtle1", "--for", "2", "--only", "x"], Terminal())

    out = capsys.readouterr().out
    assert status == 0
    assert "position, m" in out
    assert "\x1b[?1049l" in out  # the terminal's main screen is restored


@pytest.mark.parametrize("form", ["svg", "pdf", "png"])
def test_a_picture_is_written(tftool, run, tmp_path, form):
    pytest.importorskip("matplotlib", reason="the extra 'plot' is not installed")
    path = tmp_path / f"plot.{form}"

    result = tftool("plot", "map", "car", run, "-o", path, "--dark")

    assert result.status == 0
    assert "Drew 400 moments" in result.err
    magic = {"svg": b"<?xml", "pdf": b"%PDF", "png": b"\x89PNG"}[form]
    assert path.read_bytes().startswith(magic)


def test_a_picture_names_its_axes_and_what_was_refused(tftool, tmp_path):
    pytest.importorskip("matplotlib", reason="the extra 'plot' is not installed")
    buffer = circling(np.arange(1.0, 3.0, 0.1))
    still = library.TransformStamped(0, "car", r"_$\frac{<b>$", library.Transform())
    buffer.set_transform_static(still)
    library.export(buffer, path=tmp_path / "run.mcap")
    words = ("plot", "map", r"_$\frac{<b>$", tmp_path / "run.mcap", "--every", "0.1", "--to", "3")

    first = tftool(*words, "-o", tmp_path / "a.svg")
    tftool(*words, "-o", tmp_path / "b.svg")

    text = (tmp_path / "a.svg").read_text()
    told = " ".join(re.sub(r"<[^>]*>", " ", text).split())
    assert first.status == 0, first.err
    assert ET.fromstring(text).tag.endswith("svg")
    for wanted in ("position, m", "turn rate, °/s", "time, s", "roll", "No pose from"):
        assert wanted in told
    assert r"$\frac{&lt;b&gt;$" in text
    assert text == (tmp_path / "b.svg").read_text()


def test_without_matplotlib_the_extra_is_named(tftool, run, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)

    result = tftool("plot", "map", "car", run, "-o", tmp_path / "a.svg")

    assert result.status == 2
    assert "pip install 'tftool-tf2[plot]'" in result.err
    assert not (tmp_path / "a.svg").exists()


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["RUN"], 2, "TARGET SOURCE"),
        (["map", "car", "RUN", "--only", "wobble"], 2, "cannot be plotted"),
        (["map", "car", "RUN", "--only", "x", "--xy"], 2, "leave one out"),
        (["map", "car", "RUN", "--dark"], 2, "-o FILE"),
        (["map", "car", "RUN", "--window", "3"], 2, "--window is only allowed for a live plot"),
        (["map", "car", "--window", "3", "-o", "a.svg"], 2, "--window is only allowed for a live"),
        (["map", "car", "RUN", "-o", "a.gif"], 2, ".svg, .pdf or .png"),
        (["map", "car", "RUN", "-o", "run.mcap"], 2, ".svg, .pdf or .png"),
        (["map", "nope", "RUN"], 4, "nope"),
        (["map", "car", "nope.mcap"], 3, "nope.mcap"),
        (["map", "car", "RUN", "--rate", "1", "--every", "1"], 2, "leave out all but one"),
    ],
)
def test_plot_refuses_invalid_arguments(tftool, run, tmp_path, monkeypatch, words, status, told):
    monkeypatch.chdir(tmp_path)

    result = tftool("plot", *[run if word == "RUN" else word for word in words])

    assert (result.status, told in result.err) == (status, True), result.err
    assert sorted(one.name for one in tmp_path.iterdir()) == ["run.mcap"]


def test_in_python_it_draws_into_axes_of_ones_own():
    matplotlib = pytest.importorskip("matplotlib", reason="the extra 'plot' is not installed")
    from matplotlib.figure import Figure

    buffer = circling(np.arange(1.0, 3.0, 0.1))
    path = buffer.lookup_transforms("map", "car", buffer.samples("car").stamps)
    above, below = Figure().subplots(2)

    assert library.plot(path, ax=above, what="yaw") is above
    assert library.plot([path, path.inverse()], ax=below, xy=True) is below

    pair = library.plot(buffer, "map", "car", ax=Figure().subplots(), what="yaw")
    assert np.array_equal(pair.lines[0].get_ydata(), above.lines[0].get_ydata(), equal_nan=True)
    for wrong in ((buffer,), (path, "map", "car"), (path, above)):
        with pytest.raises(TypeError, match="plot\\(recording, 'map', 'base_link'\\)"):
            library.plot(*wrong)
    assert above.get_ylabel() == "rotation, °"
    assert above.get_xlabel() == "time, s"
    assert np.allclose(above.lines[0].get_ydata()[0], 126.0)
    assert (below.get_xlabel(), below.get_ylabel()) == ("x, m", "y, m")
    with pytest.raises(library.UsageError, match="one panel, not 5"):
        library.plot(path, ax=above, what=["position", "yaw", "distance", "speed", "turn rate"])
    assert matplotlib


@pytest.mark.parametrize(
    ("low", "high", "most", "ticks"),
    [
        (0.022, 7.104, 3, [0, 5, 10]),
        (0.022, 7.104, 6, [0, 2, 4, 6, 8]),
        (-0.4, 0.31, 3, [-0.5, 0, 0.5]),
        (0, 100, 2, [0, 100]),
        (-4, 4, 2, [-5, 0, 5]),
        (-170, 175, 2, [-200, 0, 200]),
        (12.1, 12.2, 6, [12.1, 12.12, 12.14, 12.16, 12.18, 12.2]),
    ],
)
def test_ticks_are_round_and_enclose_the_values(low, high, most, ticks):
    assert round_ticks(low, high, most) == pytest.approx(ticks)


def test_ticks_have_as_many_digits_as_tell_them_apart():
    assert tick_labels([0, 5, 10]) == ["0", "5", "10"]
    assert tick_labels([-0.5, 0.0, 0.5]) == ["-0.5", "0.0", "0.5"]
    assert tick_labels([0.12, 0.14]) == ["0.12", "0.14"]


@pytest.mark.parametrize("height", [8, 9, 10, 12, 14, 18, 23, 30, 44])
@pytest.mark.parametrize("top", [3.0, 8.0, 9.7, 100.0])
def test_ticks_are_evenly_spaced_and_in_the_line_of_their_value(height, top):
    def lines(*values):
        ends = np.array([0.0, *values, top])
        stamps = np.arange(len(ends)) * seconds(1) + 1
        moves = np.stack([ends, np.zeros(len(ends)), np.zeros(len(ends))], 1)
        turns = np.tile([0.0, 0.0, 0.0, 1.0], (len(ends), 1))
        ok = np.ones(len(ends), bool)
        path = trajectory_of(TransformArray("map", "car", stamps, moves, turns, ok))
        text = over_time([path], 1, chosen(["x"]), PlotLook(80, height)).plain.splitlines()
        assert text[0] == "car in map"
        assert len(text) < height
        return [line.partition("│") for line in text if "│" in line]

    labels = [row for row, (label, _, _) in enumerate(lines()) if label.strip()]
    assert labels[0] == 0
    assert len(set(np.diff(labels))) == 1
    for row in labels[1:-1]:
        tick = float(lines()[row][0])
        drawn = lines(*[tick] * 4)
        # This is the middle of the line on which the tick is.
        assert [place for place, line in enumerate(drawn) if line[2][34:35].strip()] == [row]


def test_keys_zoom_go_back_and_hide_curves():
    sight = PlotSight(seconds(10))
    now = seconds(1000)
    assert sight.span(now) == (seconds(990), now)

    sight.press("+")
    first, last = sight.span(now)
    assert (first, last) == (now - int(seconds(10) / 1.5), now)
    sight.press("left")
    assert sight.span(now)[1] == now - (last - first) // 4
    assert sight.back == (last - first) // 4
    sight.press("0")
    assert sight.span(now) == (seconds(990), now)
    for _ in range(50):
        sight.press("-")
        sight.press("left")
    assert sight.span(now)[0] >= now - seconds(40)
    for _ in range(50):
        sight.press("right")
    assert sight.span(now)[1] == now
    sight.press("2")
    assert sight.hidden == {2}
    sight.press("2")
    assert sight.hidden == frozenset()
    sight.press("i")
    assert sight.hidden == {*range(2, 10)}
    sight.press("i")
    assert sight.hidden == {1, *range(3, 10)}
    sight.press("0")
    assert sight.hidden == frozenset()
    sight.press("q")
    assert sight.ended


def test_a_hidden_curve_leaves_the_axis_to_the_others():
    stamps = np.arange(5) * seconds(1) + 1
    moves = np.stack([np.arange(5) * 0.25, np.arange(5) * 100.0, np.zeros(5)], 1)
    turns = np.tile([0.0, 0.0, 0.0, 1.0], (5, 1))
    path = trajectory_of(TransformArray("map", "car", stamps, moves, turns, np.ones(5, bool)))
    look = PlotLook(80, 12, numbered=True, hidden=frozenset({2}))

    shown = over_time([path], 1, chosen(["position"]), PlotLook(80, 12)).plain
    hidden = over_time([path], 1, chosen(["position"]), look).plain

    assert "400" in shown
    assert "2 y 400" in hidden
    assert "1.0│" in hidden
    assert "400│" not in hidden


def test_noise_does_not_fill_the_height_and_a_hidden_panel_is_a_title():
    stamps = np.arange(50) * seconds(0.1) + 1
    noise = np.random.default_rng(1).normal(0.0, 1e-9, 50)
    moves = np.stack([noise + 3.0, noise, noise], 1)
    turns = np.tile([0.0, 0.0, 0.0, 1.0], (50, 1))
    path = trajectory_of(TransformArray("map", "car", stamps, moves, turns, np.ones(50, bool)))
    quantities = chosen(["x", "distance"])

    both = over_time([path], 1, quantities, PlotLook(80, 24)).plain.splitlines()
    one = over_time([path], 1, quantities, PlotLook(80, 24, numbered=True, hidden=frozenset({1})))

    curve = [line for line in both if "\u2800" < line[15:16] <= "\u28ff"]
    assert len(curve) == 2
    lines = one.plain.splitlines()
    assert lines[1].startswith("distance")
    assert len(lines) == pytest.approx(len(both), abs=2)


def test_in_ascii_curves_that_coincide_are_an_equals_sign(tftool, run):
    out = tftool("plot", "map", "car", run, "--only", "roll,pitch,yaw", "--ascii").out

    # Roll and pitch are 0 all the time.
    assert re.search(r"1=+2=", out)


def test_the_curves_of_different_panels_have_different_colours():
    stamps = np.arange(3) * seconds(1) + 1
    turns = np.tile([0.0, 0.0, 0.0, 1.0], (3, 1))
    still = TransformArray("map", "car", stamps, np.zeros((3, 3)), turns, np.ones(3, bool))
    drawn = over_time([trajectory_of(still)], 1, chosen(["distance", "speed"]), PlotLook(80, 20))

    titles = ["distance, m", "speed, m/s"]
    ends = [drawn.plain.index(title) + len(title) + 2 for title in titles]
    colours = [
        {str(one.style) for one in drawn.spans if one.start <= at < one.end} - {"bold"}
        for at in ends
    ]
    assert colours[0].isdisjoint(colours[1])
