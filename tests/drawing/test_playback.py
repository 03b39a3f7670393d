import pytest

from tftool.base.stamps import seconds
from tftool.drawing.playback_line import Playback, PlaybackMark, after, line, passed

HALF = Playback(seconds(10), seconds(20), 1.5)


def test_the_line_of_a_wide_terminal_tells_all():
    assert line(HALF, 111) == (
        "▶ 10.00 / 20.00 s  ×1.5  ━━━━───── "
        " space pause  → next  [ ] 1 s  { } 10 s  ↑↓ rate  n finding  0 start  q quit"
    )


@pytest.mark.parametrize("ascii_only", [False, True])
def test_the_line_fits_into_every_terminal(ascii_only):
    playback = Playback(seconds(3), seconds(20), 0.5, True, 3)
    for width in range(130):
        told = line(playback, width, ascii_only=ascii_only)

        assert len(told) <= width
        assert told.isascii() or not ascii_only


def test_a_narrow_terminal_keeps_the_time_and_how_to_quit():
    assert line(HALF, 44) == "▶ 10.00 / 20.00 s  ×1.5  ━━━━━━─────  q quit"


def test_paused_in_ascii():
    paused = Playback(seconds(0), seconds(20), 1.0, True, 1)
    assert line(paused, 60, ascii_only=True, with_keys=False) == (
        "||  0.00 / 20.00 s  x1  lap 2  " + "." * 27
    )


def test_a_recording_of_one_moment_is_played_whole():
    assert "━" * 8 in line(Playback(0, 0), 60, with_keys=False)


GAP = PlaybackMark(seconds(5), seconds(10), "no data", is_error=True)
STEP = PlaybackMark(seconds(15), seconds(15), "it steps")


def test_findings_are_marks_on_a_longer_bar():
    told = line(Playback(0, seconds(20), marks=[GAP, STEP]), 80, with_keys=False)
    bar = told.split()[-1]

    assert len(bar) > 50
    assert bar.count("△") == 1
    assert bar.index("△") == pytest.approx(0.75 * len(bar), abs=1)
    assert bar.index("▲") == pytest.approx(0.25 * len(bar), abs=1)
    assert bar.count("▲") == pytest.approx(0.25 * len(bar), abs=2)
    plain = line(Playback(0, seconds(20), marks=[GAP, STEP]), 80, ascii_only=True)
    assert plain.isascii()
    assert "!" in plain


@pytest.mark.parametrize("ascii_only", [False, True])
def test_the_head_is_seen_on_a_bar_full_of_findings(ascii_only):
    whole = PlaybackMark(0, seconds(20), "stops", is_error=True)
    playing = Playback(seconds(5), seconds(20), marks=[whole])

    bar = line(playing, 80, with_keys=False, ascii_only=ascii_only).split()[-1]

    assert bar.strip("!▲") in "|●"
    assert bar.index(bar.strip("!▲")) == pytest.approx(0.25 * len(bar), abs=1)


def test_the_next_finding_and_those_just_passed():
    assert after([GAP, STEP], 0) == seconds(5)
    assert after([GAP, STEP], seconds(5)) == seconds(15)
    assert after([GAP, STEP], seconds(15)) is None
    assert passed([GAP, STEP], seconds(4), seconds(5)) == [GAP]
    assert passed([GAP, STEP], seconds(5), seconds(14)) == []
