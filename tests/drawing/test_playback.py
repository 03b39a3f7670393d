import pytest

from tftool.base.stamps import seconds
from tftool.drawing.playback_line import (
    Playback,
    PlaybackMark,
    after,
    before,
    finding_line,
    keys,
    line,
    passed,
)
from tftool.drawing.theme import DARK, hexadecimal

HALF = Playback(seconds(10), seconds(20), 1.5)


def test_the_line_of_a_wide_terminal_tells_all():
    assert line(HALF, 100).plain == ("▶ 10.00 / 20.00 s  ×1.5  " + "━" * 38 + "─" * 37)


def test_keys_that_jump_to_findings_are_offered_if_there_are_findings():
    offered = [does for _, does in keys(Playback(0, seconds(20), marks=[GAP]))]

    assert {"pause", "findings", "rate", "quit"} <= set(offered)
    assert "findings" not in [does for _, does in keys(HALF)]
    assert all(key.isascii() for key, _ in keys(HALF, ascii_only=True))


@pytest.mark.parametrize("ascii_only", [False, True])
def test_the_line_fits_into_every_terminal(ascii_only):
    playback = Playback(seconds(3), seconds(20), 0.5, True, 3)
    for width in range(130):
        told = line(playback, width, ascii_only=ascii_only).plain

        assert len(told) <= width
        assert told.isascii() or not ascii_only


def test_a_narrow_terminal_keeps_the_time_without_a_bar():
    assert line(HALF, 30).plain == "▶ 10.00 / 20.00 s  ×1.5"


def test_paused_in_ascii():
    paused = Playback(seconds(0), seconds(20), 1.0, True, 1)
    assert line(paused, 58, ascii_only=True).plain == ("||  0.00 / 20.00 s  x1  lap 2  " + "." * 27)


def test_a_recording_of_one_moment_is_played_whole():
    assert "━" * 8 in line(Playback(0, 0), 60).plain


GAP = PlaybackMark(seconds(5), seconds(10), "no data", is_error=True)
STEP = PlaybackMark(seconds(15), seconds(15), "it steps")


def test_findings_are_parts_of_a_longer_bar_in_the_colour_of_their_severity():
    text = line(Playback(0, seconds(20), marks=[GAP, STEP]), 80)
    told = text.plain
    start = told.index("●")
    bar = told[start:]

    assert len(bar) > 50
    assert bar.index("▓") == pytest.approx(0.75 * len(bar), abs=1)
    assert bar.index("█") == pytest.approx(0.25 * len(bar), abs=1)
    assert bar.count("═") == pytest.approx(0.25 * len(bar), abs=2)
    styles = {told[span.start]: str(span.style) for span in text.spans}
    assert styles["█"] == styles["═"] == hexadecimal(DARK.error)
    assert styles["▓"] == hexadecimal(DARK.warning)
    plain = line(Playback(0, seconds(20), marks=[GAP, STEP]), 80, ascii_only=True).plain
    assert plain.isascii()
    assert "!" in plain


@pytest.mark.parametrize(
    ("done", "told"),
    [
        (0, "1/2 error  5.00–10.00 s  no data"),
        (7, "1/2 error  5.00–10.00 s  no data"),
        (11, "1/2 error  5.00–10.00 s  no data"),
        (14, "2/2 warning  15.00 s  it steps"),
        (20, "2/2 warning  15.00 s  it steps"),
    ],
)
def test_the_finding_nearest_to_the_head_is_told_with_its_number(done, told):
    playing = Playback(seconds(done), seconds(20), marks=[STEP, GAP])

    assert finding_line(playing, 80).plain == told
    assert finding_line(playing, 12).plain == told[:11] + "…"
    assert finding_line(playing, 80, ascii_only=True).plain.isascii()
    assert finding_line(Playback(0, seconds(20)), 80).plain == ""


@pytest.mark.parametrize("ascii_only", [False, True])
def test_the_head_is_seen_on_a_bar_full_of_findings(ascii_only):
    whole = PlaybackMark(0, seconds(20), "stops", is_error=True)
    playing = Playback(seconds(5), seconds(20), marks=[whole])

    bar = line(playing, 80, ascii_only=ascii_only).plain.split()[-1]

    assert bar.strip("!=█═") in "|●"
    assert bar.index(bar.strip("!=█═")) == pytest.approx(0.25 * len(bar), abs=1)


def test_the_next_finding_and_those_just_passed():
    assert after([GAP, STEP], 0) == seconds(5)
    assert after([GAP, STEP], seconds(5)) == seconds(15)
    assert after([GAP, STEP], seconds(15)) is None
    assert before([GAP, STEP], seconds(20)) == seconds(15)
    assert before([GAP, STEP], seconds(15)) == seconds(5)
    assert before([GAP, STEP], seconds(5)) is None
    assert passed([GAP, STEP], seconds(4), seconds(5)) == [GAP]
    assert passed([GAP, STEP], seconds(5), seconds(14)) == []
