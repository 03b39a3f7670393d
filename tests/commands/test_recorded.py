"""Tests of commands with a real recording as FROM."""

import itertools
import json

import numpy as np
import pytest

pytest.importorskip("rosbags", reason="writes the test files")
pytest.importorskip("mcap", reason="writes the test files")

from tests.recordings.writers import SECOND, Sent, content, numbers, write_mcap, write_rosbag1
from tftool import Transform, TransformStamped, open_recording, seconds, write_recording
from tftool.drawing.recording_view import as_text

SENT = content()


@pytest.fixture
def run(tmp_path):
    return write_mcap(tmp_path / "run.mcap", SENT)


def test_tree_shows_the_edges_of_a_recording(tftool, run):
    result = tftool("tree", run, "--format", "json")

    frames = {one["frame"]: one for one in json.loads(result.out)["frames"]}
    assert result.status == 0
    assert result.err == ""
    assert {name: one["parent"] for name, one in frames.items()} == {
        "map": None,
        "odom": "map",
        "base_link": "odom",
        "arm": "base_link",
        "laser": "base_link",
        "camera": "base_link",
    }


def test_echo_at_a_moment_is_the_lookup(tftool, run):
    result = tftool("echo", "odom", "laser", run, "--at", "0.5", "--json")

    with open_recording(run) as recording:
        stamp = recording.start + SECOND // 2
        found = recording.buffer.lookup_transform("odom", "laser", stamp)
    told = json.loads(result.out)
    assert result.status == 0
    assert told["stamp_ns"] == stamp
    assert tuple(told["translation"].values()) == found.transform.translation


@pytest.mark.parametrize("words", [["echo"], ["plot"], ["export", "-o", "laser.csv"]])
def test_an_unknown_frame_is_answered_with_those_there_are(tftool, run, words, monkeypatch):
    monkeypatch.chdir(run.parent)

    result = tftool(words[0], "odom", "lazer", run, *words[1:])

    hint = next(line for line in result.err.splitlines() if line.startswith("Existing frames: "))
    named, _, meant = hint.removeprefix("Existing frames: ").partition(". ")
    assert result.status == 4
    assert result.out == ""
    assert sorted(named.split(", ")) == ["arm", "base_link", "camera", "laser", "map", "odom"]
    assert meant == "Did you mean laser?"


@pytest.mark.parametrize("words", [["plot"], ["export", "-o", "laser.csv"]])
def test_the_frames_there_are_are_named_once_for_all_pairs(tftool, run, words, monkeypatch):
    monkeypatch.chdir(run.parent)
    pairs = ["--pair", "odom:laser", "--pair", "odom:lazer", "--pair", "mapp:odom"]

    result = tftool(words[0], *pairs, run, *words[1:])

    assert result.status == 4
    (hint,) = (line for line in result.err.splitlines() if line.startswith("Existing frames: "))
    assert hint.endswith("Did you mean laser?")


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["echo", "map", "odom", "run.mcap"], 4, "There are no frames at all.\n"),
        (["plot", "map", "odom", "run.mcap"], 4, "There are no frames at all.\n"),
        (["view", "run.mcap", "-o", "run.html"], 3, "has no frames: there is nothing to show.\n"),
    ],
)
def test_a_recording_without_frames_says_so(tftool, tmp_path, monkeypatch, words, status, told):
    monkeypatch.chdir(tmp_path)
    write_mcap(tmp_path / "run.mcap", [one for one in SENT if not one.topic.startswith("/tf")])

    result = tftool(*words)

    assert result.status == status
    assert told in result.err
    assert [path.name for path in tmp_path.iterdir()] == ["run.mcap"]


def test_a_cut_recording_is_answered_with_a_warning(tftool, run):
    run.write_bytes(run.read_bytes()[:6000])

    result = tftool("tree", run)

    assert result.status == 0
    assert "base_link" in result.out
    assert "The recording breaks off at byte" in result.err


@pytest.mark.parametrize("command", [["info"], ["tree"], ["echo", "a", "b"]])
def test_a_recording_with_converted_line_ends_is_refused_with_the_cause(tftool, tmp_path, command):
    file = tmp_path / "run.mcap"
    file.write_bytes(b"\x89MCAP0\n and so on")

    result = tftool(*command, file)

    assert result.status == 3
    assert "line ends were converted" in result.err
    assert result.out == ""


def test_info_tells_topics_edges_and_publishers(tftool, tmp_path):
    bag = write_rosbag1(tmp_path / "run.bag", SENT)

    told = json.loads(tftool("info", bag, "--json").out)
    text = tftool("info", bag).out

    edges = {(one["child"], one["parent"]): one for one in told["edges"]}
    count = sum(t[2] == "arm" for one in SENT for t in one.transforms)
    assert told["kind"] == "ROS 1 bag"
    assert {one["name"]: one["count"] for one in told["topics"]}["/scan"] == 15
    assert edges["arm", "base_link"]["count"] == count
    assert edges["arm", "base_link"]["publishers"] == ["/robot"]
    assert edges["laser", "base_link"]["static"] is True
    assert edges["arm", "base_link"]["offset_ns"]["median"] == 2_000_000 + 1000
    assert [tree["root"] for tree in told["trees"]] == ["map"]
    assert told["odd"] == []
    assert "arm in base_link" in text
    assert "/state_publisher" in text


def test_info_measures_the_mean_rate_without_gaps_and_none_of_statics(tftool, tmp_path):
    # 16 ms in the mean, but usually 18 ms; then a gap of 5 s.
    periods = [18, 18, 12] * 20 + [5000] + [18, 18, 12] * 20
    stamps = [
        1_000_000_000 * 1000 + 1_000_000 * at for at in itertools.accumulate(periods, initial=0)
    ]
    sent = [Sent(at, "/tf", ((at, "map", "base", numbers(1)),)) for at in stamps]
    sent += [
        Sent(stamps[0] + 1000, "/tf_static", ((1, "base", name, numbers(2)),))
        for name in ("laser", "imu")
    ]
    write_mcap(tmp_path / "run.mcap", sorted(sent, key=lambda one: one.log_time))

    told = json.loads(tftool("info", tmp_path / "run.mcap", "--json").out)

    (rate,) = [one["rate"] for one in told["edges"] if one["child"] == "base"]
    assert rate == pytest.approx(62.5, rel=1e-3)
    (row,) = [
        line
        for line in tftool("info", tmp_path / "run.mcap").out.splitlines()
        if "/tf_static " in line
    ]
    assert "Hz" not in row


def test_info_counts_in_words_and_shows_no_table_of_nothing(tftool, tmp_path):
    one = write_mcap(tmp_path / "one.mcap", [Sent(1, "/tf", ((1, "map", "base", numbers(1)),))])
    none = write_mcap(tmp_path / "none.mcap", [])

    assert "1 message on 1 topic, 1 transform of 1 edge\n" in tftool("info", one).out
    assert "Frames: 2 in 1 tree with the root map\n" in tftool("info", one).out
    assert "Topics" not in tftool("info", none).out


def test_one_wild_stamp_makes_no_hundred_million_answers(tftool, tmp_path):
    sent = [
        Sent(at * SECOND, "/tf", ((stamp * SECOND, "map", "base", numbers(1)),))
        for at, stamp in enumerate((1_750_000_000, 1_750_000_001, 2_147_000_000))
    ]

    result = tftool("echo", "map", "base", write_mcap(tmp_path / "wild.mcap", sent))

    assert result.status == 2
    assert "397,000,001 times" in result.err


@pytest.mark.parametrize("command", [["echo"], ["explain"], ["plot"], ["export", "-o", "a.tum"]])
def test_a_recording_in_the_place_of_a_frame_is_told(tftool, run, command):
    result = tftool(*command, "base_link", run)

    assert result.status == 2
    assert "a frame is expected here: write two frames before the file" in result.err


def test_topics_there_are_stand_beside_one_there_is_not(tftool, run):
    result = tftool("echo", "map", "base_link", run, "--at-stamps-of", "/xyz")

    assert result.status == 3
    assert "No topic '/xyz' was recorded; there are /clock, /scan, /tf, /tf_static." in result.err


def test_info_tells_what_is_odd(tftool, tmp_path):
    start = 1_750_000_000 * SECOND
    sent = [
        Sent(start, "/tf_static", ((0, "base", "lidar", numbers(1)),)),
        Sent(start + 1, "/tf_static", ((0, "base", "lidar", numbers(2)),)),
        Sent(start + 2, "/tf", ((12 * SECOND, "map", "base", numbers(3)),)),
        Sent(start + 3, "/tf", ((start + 3, "front-left-camera", "marker", numbers(4)),)),
        Sent(start + SECOND, "/tf", ((start + SECOND, "front-left-camera", "marker", numbers(4)),)),
    ]
    run = write_mcap(tmp_path / "run.mcap", sent)

    odd = "\n".join(json.loads(tftool("info", run, "--json").out)["odd"])

    assert "'lidar' has 2 different static values" in odd
    assert "Two clocks" in odd
    assert "2 separate trees" in odd
    with open_recording(run) as recording:
        for width in range(50, 65):
            narrow = as_text(recording, width).splitlines()
            told = narrow[narrow.index("Odd") + 1 :]
            assert max(map(len, told)) <= width
            # Names may contain hyphens, and are never broken.
            assert odd.split() == " ".join(told).split()
    (row,) = (line for line in tftool("info", run).out.splitlines() if "base in map  " in line)
    assert "other clock" in row


def test_info_breaks_sentences_between_words_at_the_width_of_the_terminal(run):
    with open_recording(run) as recording:
        whole = as_text(recording).partition("messages on")[2].split()
        for width in (40, 60, 79):
            lines = as_text(recording, width).splitlines()
            facts = lines[: lines.index("Topics")]
            assert max(map(len, facts)) <= width
            told = " ".join(facts).partition("messages on")[2].split()
            assert told == whole[: whole.index("Topics")]


def test_info_of_a_scenario_says_what_plays_it(tftool, tmp_path):
    own = tmp_path / "own.yaml"
    own.write_text("duration: 1 s\nnodes: []\n")
    for scenario in ("turtles", own):
        result = tftool("info", scenario)

        assert result.status == 2
        assert f"tftool check {scenario}" in result.err


def test_echo_prints_the_whole_span_at_a_rate(tftool, run):
    result = tftool("echo", "odom", "laser", run, "--rate", "10", "--json")

    with open_recording(run) as recording:
        stamps = recording.buffer.samples("base_link").stamps
        first, last = int(stamps[0]), int(stamps[-1])
        begin = recording.start
    told = [json.loads(line) for line in result.out.splitlines()]
    expected = np.arange(begin, last + 1, SECOND // 10)
    assert [one["stamp_ns"] for one in told] == expected[expected >= first].tolist()


def test_echo_of_a_pair_without_an_answer_says_why(tftool, run):
    result = tftool("echo", "odom", "nowhere", run)

    assert result.status == 4
    assert "nowhere" in result.err
    assert tftool("echo", "odom", "laser", run, "--join").status == 2


def test_echo_answers_at_the_moments_of_messages(tftool, run):
    result = tftool("echo", "odom", "laser", run, "--at-stamps-of", "/scan", "--json")

    told = [json.loads(line)["stamp_ns"] for line in result.out.splitlines()]
    scans = [one.scan[0] for one in SENT if one.scan]
    with open_recording(run) as recording:
        valid = recording.buffer.lookup_transforms("odom", "laser", scans, missing="nan").valid
    assert told == np.array(scans)[valid].tolist()
    assert valid.all()
    missing = tftool("echo", "map", "laser", run, "--at-stamps-of", "/scan")
    assert "1 of 15 lookups failed." in missing.err
    assert tftool("echo", "odom", "laser", run, "--at-stamps-of", "/scam").status == 3
    assert tftool("echo", "odom", "laser", "--at-stamps-of", "/scan").status == 2


HOSTILE = "\x1b[31mred\x1b[0m\r\n\u202eabc<script>"


def test_hostile_names_reach_the_terminal_as_text(tmp_path, tftool):
    moved = (5 * SECOND, HOSTILE, f"{HOSTILE}/child", numbers(1))
    path = write_mcap(tmp_path / "run.mcap", [Sent(5 * SECOND, "/tf", (moved,))])

    for words in (["info"], ["tree"], ["monitor"], ["info", "--json"]):
        result = tftool(words[0], path, *words[1:])
        assert result.status == 0
        for char in ("\x1b", "\r", "\u202e"):
            assert char not in result.out.replace("\x1b[?25l", "").replace("\x1b[?25h", "")
            assert char not in result.err


def test_files_of_a_folder_that_are_no_recordings_are_named_in_a_line(tftool, tmp_path):
    runs, whole = tmp_path / "runs", tmp_path / "whole"
    for folder in (runs, whole):
        (folder / "notes").mkdir(parents=True)
        for name in ("a.mcap", "b.mcap"):
            with write_recording(folder / name) as recording:
                pose = TransformStamped(seconds(1), "map", name[0], Transform())
                recording.transforms([pose], log_time=seconds(1))
    (runs / "empty.bag").touch()
    (runs / "junk.bin").write_bytes(bytes(range(256)))
    (runs / ".hidden").touch()
    (runs / "a.mcap-wal").touch()
    (runs / "gone").symlink_to(tmp_path / "nowhere")

    for words in (
        ["tree"], ["info"], ["doctor"], ["edit", "-o", tmp_path / "all.mcap"], ["diff", runs],
    ):  # fmt: skip
        result = tftool(words[0], *words[1:], runs)
        assert result.status in (0, 1), result.err
        (line,) = {line for line in result.err.splitlines() if "Ignored" in line}
        assert (
            line
            == "Ignored, because these are not recordings: 'empty.bag' (empty), 'gone', 'junk.bin'."
        )
    assert "Ignored" not in tftool("tree", whole).err
    for number in range(9):
        (whole / f"{number}.txt").write_text("x", "utf-8")
    told = tftool("tree", f"{whole}/*").err
    assert "'0.txt', '1.txt', '2.txt', '3.txt' and 5 more." in told


@pytest.mark.parametrize(
    "words",
    [
        ["echo", "odom", "base_link", "RUN"],
        ["echo", "odom", "base_link", "RUN", "--once"],
        ["tree", "RUN"],
        ["tree", "RUN", "--at", "0.1"],
    ],
)
def test_a_recording_has_no_cache_time_of_lookups(tftool, run, words):
    asked = [run if word == "RUN" else word for word in words]

    assert tftool(*asked).status == 0
    refused = tftool(*asked, "--cache-time", "1")
    assert (refused.status, refused.out) == (2, "")
    assert f"'{run}' is read completely" in " ".join(refused.err.split())
    assert tftool("monitor", run, "--cache-time", "1").status == 0


def test_a_recording_that_goes_on_without_transforms_names_both_lengths(tftool, tmp_path):
    run = tmp_path / "run.mcap"
    with write_recording(run) as recording:
        chat = recording.new_message("std_msgs/String")
        for tenth in range(100):
            log = 1_000_000_000_000 + tenth * 100_000_000
            if tenth <= 20:
                recording.transforms([TransformStamped(log, "map", "base", Transform())], log)
            recording.message("/chat", chat, log)

    asked = tftool("echo", "map", "base", str(run), "--at", "5")
    judged = tftool("doctor", str(run))

    assert asked.status == 2
    assert (
        "end at 2 s (messages were received for 9.9 s): the time 5 s is after the last transform"
        in asked.err
    )
    assert "MCAP, 9.9 s (its transforms end at 2.0 s)" in judged.out


@pytest.mark.parametrize("late", [(), (1_000_000_000,)], ids=["in order", "one sample late"])
def test_a_monitored_chain_is_as_old_as_its_slowest_link(tftool, tmp_path, late):
    run, origin = tmp_path / "run.mcap", 1_000_000_000_000
    # The edge map -> odom arrives 20 ms late every 100 ms, and is missing from 4.1 to 7.9 s.
    slow = [
        (stamp, stamp + 20_000_000, "map", "odom") for stamp in range(0, 10 * SECOND, SECOND // 10)
    ]
    sent = [one for one in slow if not 4 * SECOND < one[0] < 8 * SECOND]
    sent += [(now, now, "odom", "base") for now in range(0, 1002 * SECOND // 100, SECOND // 50)]
    sent += [(stamp, stamp + SECOND // 2, "odom", "base") for stamp in late]
    with write_recording(run) as recording:
        for stamp, log, parent, child in sorted(sent, key=lambda one: one[1]):
            pose = TransformStamped(origin + stamp, parent, child, Transform())
            recording.transforms([pose], log_time=origin + log)

    result = tftool("monitor", "map", "base", run, "--cache-time", "1", "--json")

    # Ages at every half second from 20 ms on. From 5.52 to 7.52 s the cache of one second has no
    # common time. At 5.02 s it has the common time 5 s, as tf2 prunes by the stamp before the
    # newest one.
    ages = [0.02] * 8 + [0.52, 1.02] + [0.02] * 4
    delay = json.loads(result.out)["net_delay"]
    assert delay["average"] == pytest.approx(sum(ages) / len(ages))
    assert delay["max"] == pytest.approx(1.02)
