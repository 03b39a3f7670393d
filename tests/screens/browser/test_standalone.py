"""Tests of the page as one file: its answers are the server's, and its data contains no code."""

import json
import math
import random
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from tftool.app.main import main
from tftool.base.stamps import seconds
from tftool.buffer.buffer import NO_LIMIT, Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.screens.browser import page_messages, protocol
from tftool.screens.browser.page_messages import HEADER, PageRequest
from tftool.screens.browser.standalone import (
    MOST_BYTES,
    StandaloneData,
    standalone_page,
)

NODE = shutil.which("node")
ANSWERS = Path(__file__).parent / "answers.mjs"
EPOCH = 1_700_000_000_123_456_789
needs_node = pytest.mark.skipif(NODE is None, reason="node is not installed")


def turned(random):
    """Return a random unit quaternion."""
    numbers = [random.gauss(0, 1) for _ in range(4)]
    length = math.hypot(*numbers)
    return tuple(number / length for number in numbers)


def drawn_world(seed):
    """Return a world with static edges, several rates, gaps, two trees, and a change of parents."""
    drawn = random.Random(seed)
    buffer = Buffer(NO_LIMIT)
    buffer.set_transform_static(
        TransformStamped(0, "base", "mount", Transform((0.1, 0.2, 0.3), turned(drawn))), "urdf"
    )
    buffer.set_transform_static(
        TransformStamped(0, "mount", "laser", Transform((1.0, 0.0, -3.0), turned(drawn))), "urdf"
    )
    for child, parent, period in (
        ("base", "odom", 0.02),
        ("arm", "base", 0.013),
        ("odom", "map", 0.1),
        ("island", "sea", 0.5),
    ):
        time = drawn.uniform(0.0, 0.3)
        while time < 3.0:
            stamp = EPOCH + seconds(time)
            pose = Transform(tuple(drawn.gauss(0, 5) for _ in range(3)), turned(drawn))
            above = "mount" if child == "arm" and time > 1.5 else parent
            buffer.set_transform(TransformStamped(stamp, above, child, pose), f"/{child}")
            time += period * drawn.uniform(0.5, 1.5)
            if drawn.random() < 0.03:
                time += 0.4
    return buffer


def asked_of(path, moments, pairs):
    """Return the answers of the page in a file, run by node."""
    asked = path.with_suffix(".json")
    asked.write_text(json.dumps([{"at": at, "pairs": pairs} for at in moments]))
    done = subprocess.run(
        [NODE, str(ANSWERS), str(path), str(asked)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def server_numbers(buffer, now, at):
    snapshot = buffer.snapshot(now, at)
    message = protocol.encode_poses(EPOCH, 0, 1, snapshot, snapshot.frames)
    head = HEADER.unpack(message[: HEADER.size])
    return snapshot, head, np.frombuffer(message[HEADER.size :], dtype="<f8")


@needs_node
@pytest.mark.parametrize("seed", [1, 2])
def test_every_answer_is_the_servers(tmp_path, seed):
    buffer, now = drawn_world(seed), EPOCH + seconds(3.1)
    path = tmp_path / "page.html"
    path.write_bytes(standalone_page(StandaloneData("a test", buffer, EPOCH, now)).content)
    drawn = random.Random(seed)
    stamps = buffer.samples("base").stamps
    moments = [None, *(int(stamps[place]) - EPOCH for place in (0, 5, -1))]
    moments += [drawn.randrange(-seconds(0.2), seconds(3.3)) for _ in range(16)]
    names = [*buffer.frames(), "unknown"]
    pairs = [[target, source] for target in names for source in names]

    told = asked_of(path, moments, pairs)

    assert told["moments"] == [
        moment - EPOCH for moment in protocol.moments(buffer.snapshot(now).frames)
    ]
    span = {"from": -0.25, "to": 3.3, "count": 301}
    asked = PageRequest("series", {"target": "map", "source": "laser", **span})
    wanted = json.loads(protocol.encode_series(buffer, EPOCH, asked))
    assert told["series"].keys() == wanted.keys()
    for key in ("times", *protocol.SERIES):
        found, known = (np.array(one[key], dtype=float) for one in (told["series"], wanted))
        assert 10 < np.isnan(known).sum() < 200 or key == "times"
        np.testing.assert_allclose(found, known, rtol=1e-9, atol=1e-12)
    asked = PageRequest("trails", {"fixed": "map", "frames": ("laser", "base", "nobody"), **span})
    wanted = json.loads(protocol.encode_trails(buffer, EPOCH, asked))
    assert told["trails"].keys() == wanted.keys()
    for frame, places in wanted["places"].items():
        found = told["trails"]["places"][frame]
        assert [place is None for place in found] == [place is None for place in places]
        for one, other in zip(found, places, strict=True):
            assert one == (other if other is None else pytest.approx(other, abs=1e-5))
    refused = 0
    for at, answer in zip(moments, told["answers"], strict=True):
        stamp = 0 if at is None else EPOCH + at
        snapshot, head, numbers = server_numbers(buffer, now, stamp)
        names_told = json.loads(protocol.encode_names(EPOCH, 1, snapshot.frames, 8, 1.0))
        names_told["total"] = len(snapshot.frames)
        answer["names"]["revision"] = 1
        assert answer["names"] == names_told
        assert answer["reach"] == [head[4], head[6], head[7]]
        found = np.array([math.nan if one is None else one for one in answer["numbers"]])
        np.testing.assert_allclose(found, numbers, rtol=1e-12, atol=1e-12)
        for (target, source), pair in zip(pairs, answer["pairs"], strict=True):
            wanted = json.loads(protocol.encode_pair(buffer, EPOCH, target, source, stamp))
            assert {**pair, **NUMBERS} == {**wanted, **NUMBERS}
            if not pair["found"]:
                refused += 1
                continue
            for key in NUMBERS:
                np.testing.assert_allclose(pair[key], wanted[key], rtol=1e-9, atol=1e-12)
    assert 100 < refused < len(moments) * len(pairs) - 100


NUMBERS = dict.fromkeys(("translation", "rotation", "rpy"), 0)


@needs_node
def test_a_page_too_large_is_rounded_to_a_micrometre_and_marked_as_rounded(tmp_path):
    buffer, now = drawn_world(3), EPOCH + seconds(3.1)
    path = tmp_path / "page.html"
    data = StandaloneData("a test", buffer, EPOCH, now)
    exact, rounded = standalone_page(data), standalone_page(data, most=1)
    path.write_bytes(rounded.content)

    answer = asked_of(path, [seconds(1.7)], [])["answers"][0]

    assert (exact.is_rounded, rounded.is_rounded) == (False, True)
    assert len(rounded.content) < len(exact.content) < MOST_BYTES
    _, _, numbers = server_numbers(buffer, now, EPOCH + seconds(1.7))
    found = np.array([math.nan if one is None else one for one in answer["numbers"]])
    shape = (-1, len(page_messages.NUMBERS))
    apart = np.abs(found - numbers).reshape(shape)
    assert 0.0 < np.nanmax(apart[:, :3]) < 2e-6
    assert np.nanmax(apart[:, 3:7]) < 2e-6
    assert np.nanmax(apart[:, 7:]) == 0.0


WILD = [
    "</script><script>alert(1)</script>",
    "<!--<script>",
    "a\u2028b",
    "é漢 🐢",
    "\x1b[2J",
    "'\"&",
]


def test_no_name_gets_out_of_the_packed_data(tmp_path):
    buffer = Buffer()
    for name in WILD:
        pose = TransformStamped(EPOCH, "world", name, Transform())
        buffer.set_transform(pose, "</script><script>alert(2)</script>")
    name = "recording '</title></script>.mcap'"
    page = standalone_page(StandaloneData(name, buffer, EPOCH, EPOCH, view="</script>"))

    text = page.content.decode("ascii", errors="strict" if page.content.isascii() else "replace")
    assert "alert(" not in text
    # The data, and the script that unpacks it; the page's own script is part of the data.
    assert len(re.findall("<script", text)) == len(re.findall("</script", text)) == 2
    assert not re.search(r"(?:src|href|url\(|@import)[^>]{0,20}?//(?!www\.w3\.org)", text)


def written(tmp_path, *words, file="run.html"):
    status = main(["view", *map(str, words), "-o", str(tmp_path / file)])
    return status, tmp_path / file


def test_a_scenario_and_a_description_become_files(tmp_path, capsys):
    status, path = written(tmp_path, "robot")

    assert status == 0
    assert path.read_bytes().startswith(b"<!doctype html>")
    assert "it opens in any browser, from disk" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "status", "sentence"),
    [
        (["-o", "run.txt"], 2, "end it in .html"),
        (["-o", "there.html"], 2, "add --force to replace it"),
        (["-o", "no/such/folder/run.html"], 3, "there is no folder"),
        (["--force"], 2, "is only allowed with -o"),
        (["-o", "run.html", "--cache-time", "5"], 2, "leave out --cache-time"),
    ],
)
def test_an_impossible_output_is_refused_with_a_sentence_and_changes_no_file(
    tmp_path, monkeypatch, capsys, words, status, sentence
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "there.html").write_text("mine")

    assert main(["view", "two_trees", *words]) == status

    assert sentence in capsys.readouterr().err
    assert [(one.name, one.read_text()) for one in tmp_path.iterdir()] == [("there.html", "mine")]


def test_force_replaces_a_file(tmp_path):
    (tmp_path / "run.html").write_text("mine")
    status = main(["view", "two_trees", "--force", "-o", str(tmp_path / "run.html")])

    assert status == 0
    assert "doctype html" in (tmp_path / "run.html").read_text()
