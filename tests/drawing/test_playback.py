import numpy as np
import pytest

from tftool.base.stamps import seconds
from tftool.doctor.findings import Severity
from tftool.drawing.playback_line import (
    Playback,
    PlaybackMark,
    PlayedTopic,
    after,
    before,
    finding_lines,
    keys,
    lines,
    topic_lines,
)
from tftool.drawing.theme import DARK, hexadecimal

HALF = Playback(seconds(10), seconds(20), 1.5)
GAP = PlaybackMark(seconds(5), seconds(10), "no data", severity=Severity.ERROR)
STEP = PlaybackMark(seconds(15), seconds(15), "it steps")


def drawn(playback, width, *, ascii_only=False):
    """Return the lines of a timeline whose transforms are all in the first half."""
    moments = np.arange(0, playback.total // 2 + 1, seconds(0.1))
    return lines(playback, moments, width, ascii_only=ascii_only)


def test_the_timeline_fills_its_width_with_position_density_bar_and_seconds():
    position, density, bar, axis = (line.plain for line in drawn(HALF, 100))

    assert position == "▶ 10.00 / 20.00 s  ×1.5"
    assert [len(one) for one in (density, bar, axis)] == [100, 100, 100]
    assert set(density[:50]).isdisjoint(density[52:])
    assert bar == "━" * 50 + "●" + "─" * 49
    assert axis.split() == ["0", "5", "10", "15", "20", "s"]


def test_the_end_names_the_keys_that_go_on():
    over = Playback(seconds(20), seconds(20), is_paused=True)

    assert drawn(over, 80)[0].plain.endswith("end: r replays, q quits")
    assert "end" not in drawn(HALF, 80)[0].plain


def test_keys_that_jump_to_findings_are_offered_if_there_are_findings():
    offered = [does for _, does in keys(Playback(0, seconds(20), marks=[GAP]))]

    assert {"pause", "findings", "rate", "quit"} <= set(offered)
    assert "findings" not in [does for _, does in keys(HALF)]
    assert all(key.isascii() for key, _ in keys(HALF, ascii_only=True))


@pytest.mark.parametrize("ascii_only", [False, True])
def test_all_lines_fit_into_every_terminal(ascii_only):
    topics = [PlayedTopic("/scan", 10), PlayedTopic("/tf", 1, np.array([0]))]
    playback = Playback(seconds(3), seconds(20), 0.5, True, 3, [GAP, STEP])
    for width in range(20, 130):
        shown = drawn(playback, width, ascii_only=ascii_only)
        shown += finding_lines(playback, width, 2, ascii_only=ascii_only)
        shown += topic_lines(topics, playback, width, 2, ascii_only=ascii_only)

        assert len(shown) == 8
        assert all(line.cell_len <= width for line in shown)
        assert not ascii_only or all(line.plain.isascii() for line in shown)


def test_paused_in_ascii():
    paused = Playback(seconds(0), seconds(20), 1.0, True, 1)
    position, _, bar, _ = drawn(paused, 58, ascii_only=True)
    assert position.plain == "||  0.00 / 20.00 s  x1  lap 2"
    assert bar.plain == "|" + "." * 57


def test_a_recording_of_one_moment_is_played_whole():
    assert drawn(Playback(0, 0), 60)[2].plain == "━" * 59 + "●"


def test_findings_are_parts_of_the_bar_in_the_colour_of_their_severity():
    text = drawn(Playback(0, seconds(20), marks=[GAP, STEP]), 80)[2]
    bar = text.plain

    assert bar.index("▓") == pytest.approx(60, abs=1)
    assert bar.index("█") == pytest.approx(20, abs=1)
    assert bar.count("═") == pytest.approx(20, abs=2)
    styles = {bar[span.start]: str(span.style) for span in text.spans}
    assert styles["█"] == styles["═"] == hexadecimal(DARK.error)
    assert styles["▓"] == hexadecimal(DARK.warning)
    assert "!" in drawn(Playback(0, seconds(20), marks=[GAP]), 80, ascii_only=True)[2].plain


@pytest.mark.parametrize(("done", "lit"), [(3, None), (7, 0), (11, None), (15.1, 1), (20, None)])
def test_the_finding_at_the_position_is_lit_in_the_list(done, lit):
    playing = Playback(seconds(done), seconds(20), marks=[STEP, GAP])

    shown = [line.plain for line in finding_lines(playing, 80, 5)]

    assert "1/2 error" in shown[0]
    assert "5.00–10.00 s  no data" in shown[0]
    assert "2/2 warning" in shown[1]
    assert "15.00 s  it steps" in shown[1]
    assert [place for place, line in enumerate(shown) if line.startswith("▸")] == (
        [] if lit is None else [lit]
    )
    assert finding_lines(Playback(0, seconds(20)), 80, 5) == []


def test_a_finding_without_a_time_is_only_listed():
    split = PlaybackMark(0, 0, "two trees", severity=Severity.ERROR, is_timed=False)
    playing = Playback(seconds(0), seconds(20), marks=[split, STEP])

    shown = [line.plain for line in finding_lines(playing, 80, 5)]

    assert shown[0].split() == ["1/2", "error", "throughout", "two", "trees"]
    assert "█" not in drawn(playing, 80)[2].plain
    assert before([split, STEP], seconds(15)) is None
    assert after([split, STEP], -1) == seconds(15)


def test_a_note_is_called_a_note():
    note = PlaybackMark(seconds(3), seconds(3), "one sample", severity=Severity.NOTE)

    (shown,) = finding_lines(Playback(0, seconds(20), marks=[note]), 80, 5)

    assert shown.plain.split()[:3] == ["1/1", "note", "3.00"]


def test_a_long_list_of_findings_scrolls_with_the_position():
    marks = [PlaybackMark(seconds(n), seconds(n), f"fault {n}") for n in range(20)]

    shown = [
        line.plain for line in finding_lines(Playback(seconds(15), 10**11, marks=marks), 80, 4)
    ]

    assert len(shown) == 4
    assert any("fault 15" in line and line.startswith("▸") for line in shown)


def test_a_topic_is_lit_while_it_has_messages():
    topics = [
        PlayedTopic("/tf", 41, np.arange(0, seconds(10.1), seconds(0.25))),
        PlayedTopic("/scan", 200),
        PlayedTopic("/map", 1, np.array([seconds(1)])),
    ]

    shown = [line.plain for line in topic_lines(topics, HALF, 40, 3)]

    assert [line[0] for line in shown] == ["●", "·", "·"]
    assert [line.split()[1:] for line in shown] == [
        ["/tf", "2.0", "Hz"],
        ["/scan", "10.0", "Hz"],
        ["/map", "1", "msg"],
    ]
    assert [line.plain for line in topic_lines(topics, HALF, 40, 2)][-1].strip() == "2 more"


@pytest.mark.parametrize("ascii_only", [False, True])
def test_the_head_is_seen_on_a_bar_full_of_findings(ascii_only):
    whole = PlaybackMark(0, seconds(20), "stops", severity=Severity.ERROR)
    playing = Playback(seconds(5), seconds(20), marks=[whole])

    bar = drawn(playing, 80, ascii_only=ascii_only)[2].plain

    assert bar.index(bar.strip("!=█═")) == 20


def test_the_next_finding_and_the_one_before():
    assert after([GAP, STEP], 0) == seconds(5)
    assert after([GAP, STEP], seconds(5)) == seconds(15)
    assert after([GAP, STEP], seconds(15)) is None
    assert before([GAP, STEP], seconds(20)) == seconds(15)
    assert before([GAP, STEP], seconds(15)) == seconds(5)
    assert before([GAP, STEP], seconds(5)) is None
