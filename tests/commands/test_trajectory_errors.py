"""Tests of `tftool diff A B --ape --rpe`: errors of one trajectory compared with another."""

import json
import math
import os
import random
import shutil
import subprocess
import zipfile

import pytest

from tftool import Quaternion
from tftool.geometry.conversions import quaternion_from_rpy

EVO = shutil.which("evo_ape")


def circle(count=50, radius=2.0, rate=10.0):
    """Return stamps, positions and yaw of a body that moves forward on a circle."""
    poses = []
    for step in range(count):
        angle = 2 * math.pi * step / count
        place = (radius * math.cos(angle), radius * math.sin(angle), 0.1 * step)
        poses.append((100.0 + step / rate, place, quaternion_from_rpy(0, 0, angle + math.pi / 2)))
    return poses


def write(path, poses, places=9):
    rows = [
        f"{stamp:.9f} " + " ".join(f"{one:.{places}f}" for one in (*place, *turn))
        for stamp, place, turn in poses
    ]
    path.write_text("\n".join(rows) + "\n")
    return path


def moved(poses, shift=(0.0, 0.0, 0.0), scale=1.0, later=0.0):
    return [
        (stamp + later, tuple(scale * a + b for a, b in zip(place, shift, strict=True)), turn)
        for stamp, place, turn in poses
    ]


@pytest.fixture
def truth(tmp_path):
    return write(tmp_path / "truth.tum", circle(), 15)


def measured(tftool, *words):
    result = tftool("diff", *words, "--json")
    assert result.status == 0, result.err
    return json.loads(result.out)


def test_a_shift_is_an_absolute_error_and_no_relative_one(tftool, truth, tmp_path):
    estimate = write(tmp_path / "estimate.tum", moved(circle(), shift=(0.3, 0.0, 0.4)), 15)

    found = measured(tftool, truth, estimate, "--ape", "--rpe")

    assert found["matched"] == 50
    for name in ("rmse", "mean", "median", "min", "max"):
        assert found["ape"]["m"][name] == pytest.approx(0.5)
    assert found["ape"]["m"]["std"] == pytest.approx(0.0, abs=1e-9)
    assert found["ape"]["deg"]["max"] == pytest.approx(0.0, abs=1e-5)
    assert found["rpe"]["m"]["max"] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("fit", ["first", "se3", "sim3"])
def test_a_fit_takes_a_shift_out(tftool, truth, tmp_path, fit):
    estimate = write(tmp_path / "estimate.tum", moved(circle(), shift=(3.0, -2.0, 1.0)), 15)

    found = measured(tftool, truth, estimate, "--ape", "--fit", fit)

    assert found["ape"]["m"]["max"] == pytest.approx(0.0, abs=1e-9)


def test_sim3_names_the_scale(tftool, truth, tmp_path):
    estimate = write(tmp_path / "estimate.tum", moved(circle(), scale=4.0), 15)

    found = measured(tftool, truth, estimate, "--ape", "--fit", "sim3")

    assert found["scale"] == pytest.approx(0.25)
    assert found["ape"]["m"]["max"] == pytest.approx(0.0, abs=1e-9)
    assert "scale 0.25" in tftool("diff", truth, estimate, "--ape", "--fit", "sim3").out


def test_nearest_leaves_out_what_interpolation_answers(tftool, truth, tmp_path):
    # The poses are half a period late: A has no stamp within 10 ms, but each one is between two
    # stamps of A.
    late = write(tmp_path / "late.tum", moved(circle()[:-1], later=0.05), 15)

    refused = tftool("diff", truth, late, "--ape")
    found = measured(tftool, truth, late, "--ape", "--match", "interpolate")

    assert refused.status == 3
    assert "Only 0 of 49 poses of B can be matched with a pose of A in time" in refused.err
    assert found["matched"] == 49
    # The middle of a chord of 7.2° is r (1 - cos 3.6°) from its arc. Seen from the start of the
    # arc, it is half a chord away.
    chord = math.hypot(2 * 2.0 * math.sin(math.pi / 50), 0.1)
    assert found["ape"]["m"]["mean"] == pytest.approx(chord / 2, rel=1e-6)


def test_relative_errors_are_taken_per_frames_metres_and_degrees(tftool, truth, tmp_path):
    estimate = write(tmp_path / "estimate.tum", moved(circle(), scale=1.1), 15)
    chord = math.hypot(2 * 2.0 * math.sin(math.pi / 50), 0.1)

    def mean(per):
        return measured(tftool, truth, estimate, "--rpe", "--per", per)["rpe"]["m"]["mean"]

    assert mean("1") == pytest.approx(0.1 * chord, rel=1e-6)
    # Twelve chords turn by 86.4°, so the thirteenth passes 90°. The straight distance is a sine
    # shorter than the path.
    turned = math.hypot(2 * 2.0 * math.sin(13 * math.pi / 50), 1.3)
    assert mean("90deg") == pytest.approx(0.1 * turned, rel=1e-6)
    # B travels 1.1 chords per frame, and passes one metre with the fourth.
    four = math.hypot(2 * 2.0 * math.sin(4 * math.pi / 50), 0.4)
    assert 1.1 * chord * 3 < 1.0 < 1.1 * chord * 4
    assert mean("1m") == pytest.approx(0.1 * four, rel=1e-6)


def test_a_pair_names_the_chain_of_each_side(tftool, truth, tmp_path):
    estimate = write(tmp_path / "estimate.tum", circle(), 15)

    once = tftool("diff", truth, estimate, "--ape", "--pair", "world:body")
    twice = tftool(
        "diff", truth, estimate, "--frames", "odom:base", "--ape",
        "--pair", "world:body", "--pair", "odom:base",
    )  # fmt: skip
    wrong = tftool("diff", truth, estimate, "--ape", "--pair", "world:hand")

    assert once.status == twice.status == 0
    assert "base in odom" in twice.out
    assert wrong.status == 4
    assert "hand" in wrong.err


def test_several_chains_need_a_pair(tftool, tmp_path):
    script = tmp_path / "statics.sh"
    script.write_text(
        "ros2 run tf2_ros static_transform_publisher --x 1 --frame-id a --child-frame-id b\n"
        "ros2 run tf2_ros static_transform_publisher --x 1 --frame-id a --child-frame-id c\n"
    )

    result = tftool("diff", script, script, "--ape")

    assert result.status == 3
    assert "--pair TARGET:SOURCE" in result.err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--fit", "se3"), "need --ape or --rpe"),
        (("-o", "x.svg"), "need --ape or --rpe"),
        (("--ape", "--markdown"), "use --json"),
        (("--ape", "--align", "start"), "cannot be combined with --ape"),
        (("--rpe", "--per", "0"), "--per must be a number of poses, metres or degrees"),
        (("--rpe", "--per", "1.5"), "--per must be a number of poses, metres or degrees"),
        (("--rpe", "--per", "10cm"), "--per must be a number of poses, metres or degrees"),
        (("--ape", "-o", "x.gif"), "end it in .svg, .pdf or .png"),
        (("--ape", *(("--pair", "a:b") * 3)), "--pair is given more than twice: give one pair"),
    ],
)
def test_options_that_do_not_fit_are_refused(tftool, truth, words, told):
    result = tftool("diff", truth, truth, *words)

    assert result.status == 2
    assert told in result.err


def test_a_straight_line_leaves_the_rotation_open(tftool, tmp_path):
    line = [(100.0 + n, (float(n), 0.0, 0.0), Quaternion(0.0, 0.0, 0.0, 1.0)) for n in range(5)]
    path = write(tmp_path / "line.tum", line)

    result = tftool("diff", path, path, "--ape", "--fit", "se3")

    assert result.status == 3
    assert "--fit first" in result.err


def test_a_picture_is_drawn_and_never_overwritten_unasked(tftool, truth, tmp_path):
    pytest.importorskip("matplotlib")
    picture = tmp_path / "errors.svg"

    drawn = tftool("diff", truth, truth, "--ape", "--rpe", "-o", picture)
    again = tftool("diff", truth, truth, "--ape", "--rpe", "-o", picture)

    assert drawn.status == 0
    assert "APE, m" in picture.read_text()
    assert "RPE, °" in picture.read_text()
    assert again.status == 2
    assert "--force" in again.err


# Comparison with evo


def made_pair(number):
    """Return two simulated trajectories with different rates, gaps, noise, drift and frames."""
    dice = random.Random(number)
    count = dice.randrange(80, 200)
    truth, estimate = [], []
    for step in range(count):
        time = 50.0 + 0.1 * step + dice.uniform(-0.002, 0.002)
        angle = 0.05 * step
        place = (3 * math.cos(angle), 2 * math.sin(2 * angle), 0.02 * step)
        turn = (0.2 * math.sin(angle), 0.3 * math.cos(1.3 * angle), 1.7 * angle)
        if dice.random() < 0.9:
            truth.append((time, place, quaternion_from_rpy(*turn)))
        if dice.random() < 0.8:
            moved = tuple(1.02 * one + 0.3 + dice.gauss(0.0, 0.02) for one in place)
            turned = tuple(one + 0.1 + dice.gauss(0.0, 0.01) for one in turn)
            later = dice.uniform(-0.009, 0.009)
            estimate.append((time + later, moved, quaternion_from_rpy(*turned)))
    return truth, estimate


def judged(folder, tool, *words):
    """Return the statistics that evo computes in a separate process."""
    (folder / "result.zip").unlink(missing_ok=True)
    home = {**os.environ, "HOME": str(folder), "MPLBACKEND": "Agg"}
    command = [tool, "tum", "truth.tum", "estimate.tum", *words]
    command += ["--save_results", "result.zip", "--no_warnings"]
    subprocess.run(command, cwd=folder, env=home, check=True, capture_output=True)
    stats = json.loads(zipfile.ZipFile(folder / "result.zip").read("stats.json"))
    return {name: stats[name] for name in ("rmse", "mean", "median", "std", "min", "max")}


@pytest.mark.skipif(EVO is None, reason="evo is not installed")
@pytest.mark.parametrize("number", range(10))
def test_the_figures_are_those_of_evo(tftool, tmp_path, number):
    truth, estimate = made_pair(number)
    write(tmp_path / "truth.tum", truth)
    write(tmp_path / "estimate.tum", estimate)
    fit, align = [
        ("none", []),
        ("first", ["--align_origin"]),
        ("se3", ["--align"]),
        ("sim3", ["--align", "--correct_scale"]),
    ][number % 4]
    per, delta = [
        ("1", ["--delta", "1", "--delta_unit", "f"]),
        ("7", ["--delta", "7", "--delta_unit", "f"]),
        ("0.5m", ["--delta", "0.5", "--delta_unit", "m"]),
        ("20deg", ["--delta", "20", "--delta_unit", "d"]),
    ][number // 2 % 4]

    paths = tmp_path / "truth.tum", tmp_path / "estimate.tum"
    found = measured(tftool, *paths, "--ape", "--rpe", "--fit", fit, "--per", per)

    for unit, part in (("m", "trans_part"), ("deg", "angle_deg")):
        absolute = judged(tmp_path, "evo_ape", *align, "--pose_relation", part)
        relative = judged(tmp_path, "evo_rpe", *align, *delta, "--pose_relation", part)
        assert found["ape"][unit] == pytest.approx(absolute, rel=1e-9, abs=1e-9)
        assert found["rpe"][unit] == pytest.approx(relative, rel=1e-9, abs=1e-9)
