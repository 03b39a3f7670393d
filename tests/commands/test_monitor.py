import json

import pytest


def test_all_frames_are_reported_in_tf2_monitors_lines(tftool, simulated):
    result = tftool("monitor", "--for", "5")

    assert result.status == 0
    assert "Gathering data on all frames, a report every 10 s ..." in result.err
    assert result.out.split("\n") == [
        "",
        "",
        "",
        "RESULTS: for all Frames",
        "",
        "Frames:",
        "Frame: turtle1, published by broadcaster1, Average Delay: 0, Max Delay: 0",
        "Frame: turtle2, published by broadcaster2, Average Delay: 0, Max Delay: 0",
        "",
        "All Broadcasters:",
        "Node: broadcaster1 62.5 Hz, Average Delay: 0 Max Delay: 0",
        "Node: broadcaster2 62.5 Hz, Average Delay: 0 Max Delay: 0",
        "",
    ]


def test_a_chain_is_read_in_words(tftool, simulated):
    result = tftool("monitor", "turtle2", "turtle1", "--for", "3")

    assert result.status == 0
    assert "Gathering data on turtle1 in turtle2" in result.err
    assert "RESULTS: for turtle1 in turtle2\n" in result.out
    assert "Chain is: turtle1 -> world -> turtle2\n" in result.out
    assert "Net delay     avg = 0.0" in result.out


def test_frames_that_are_not_connected_in_the_time_given_end_it(tftool, simulated):
    result = tftool("monitor", "turtle2", "nosuch", "--for", "2")

    assert (result.status, result.out) == (4, "")
    assert result.err.endswith(
        'tftool: "nosuch" passed to lookupTransform argument source_frame does not exist.\n'
    )


def test_reports_come_once_a_period_and_at_the_end(tftool, simulated):
    result = tftool("monitor", "turtles", "--for", "2.5", "--every", "1", "--json")

    reports = [json.loads(line) for line in result.out.splitlines()]
    assert [report["at_ns"] for report in reports] == [
        1_004_000_000_000,
        1_005_000_000_000,
        1_005_500_000_000,
    ]
    assert reports[-1]["frames"][0]["rate"] == pytest.approx(62.5)


def test_statics_from_before_are_known_and_have_no_rate(tftool, simulated):
    result = tftool("monitor", "robot", "--for", "2", "--json")

    frames = {frame["frame"]: frame for frame in json.loads(result.out)["frames"]}
    assert frames["laser_link"]["static"]
    assert frames["laser_link"]["rate"] is None
    assert frames["odom"]["rate"] == pytest.approx(10.0)


def test_tf2_monitors_own_figures_can_be_had(tftool, simulated):
    out = tftool("monitor", "turtles", "--for", "0.5", "--tf2").out

    # There is one message more than there are gaps between messages.
    assert "Node: broadcaster1 64.5" in out


@pytest.mark.parametrize(
    ("words", "status", "sentence"),
    [
        (["turtle1"], 3, "To report on two frames, name both frames."),
        (["a", "b", "c", "d"], 2, "4 words are too many"),
        (["--for", "0"], 2, "0 is not a positive number."),
        (["--json", "--tf2"], 2, "choose one"),
        (["a", "b", "nosuch"], 3, "no scenario is named 'nosuch'"),
    ],
)
def test_monitor_gives_a_reason_for_invalid_arguments(tftool, simulated, words, status, sentence):
    result = tftool("monitor", *words)

    assert result.status == status
    assert sentence in result.err
    assert result.out == ""


def test_a_terminal_gets_a_table_that_is_drawn_again(tftool, simulated, monkeypatch):
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)

    result = tftool("monitor", "turtle2", "turtle1", "--for", "3")

    assert result.status == 0
    assert "a report every 1 s" in result.err
    for second in (1, 2, 3):
        assert (
            f"turtle1 in turtle2, for {second} s, by way of turtle1, world, turtle2" in result.out
        )
    assert "62.50 Hz" in result.out


def test_a_chain_that_breaks_does_not_end_it(tftool, simulated):
    # In lost_leader the leader disappears, and after a while its frame is dropped.
    result = tftool("monitor", "turtle2", "turtle1", "lost_leader", "--for", "20")

    assert result.status == 0
    assert result.out.count("RESULTS: for turtle1 in turtle2") == 2
