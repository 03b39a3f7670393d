"""Tests of `tftool convert`, from arguments to output lines."""

import io
import json
import math
import sys

import pytest


def test_it_writes_every_notation(tftool):
    result = tftool("convert", "--as", "xyzw", "0", "0", "-0.7", "0.7")

    lines = dict(line.split("  ", 1) for line in result.out.splitlines() if line[0] != " ")
    found = {name: text.strip() for name, text in lines.items()}
    assert result.status == 0
    assert found["roll pitch yaw"] == "0 0 -1.570796 rad · 0 0 -90 deg"
    assert found["axis, angle"] == "0 0 -1, 1.570796 rad · 90 deg"
    assert found["static publisher"].startswith("--x 0 --y 0 --z 0 --qx 0 --qy 0 --qz -0.7071067")
    assert "length 0.989949" in result.err
    assert "Read as quaternion x y z w" in result.err


def test_json_holds_all_orders_in_full(tftool):
    result = tftool("convert", "rpy", "0.1", "-0.2", "-pi/2", "--json")

    found = json.loads(result.out)
    assert len(found["euler_rad"]) == 24
    assert found["rpy_rad"] == pytest.approx([0.1, -0.2, -math.pi / 2], abs=1e-15)
    assert found["euler_rad"]["rzyx"] == pytest.approx([-math.pi / 2, -0.2, 0.1], abs=1e-12)
    assert result.err == ""


def test_a_chain_goes_on_in_the_child(tftool):
    # After a quarter turn to the left, one metre ahead is one metre to the left.
    result = tftool(
        "convert", "--yaw", "1.5707963267948966", "--then", "--x 1", "--into", "matrix4"
    )

    rows = [[float(word) for word in line.split()] for line in result.out.splitlines()]
    assert [row[3] for row in rows] == pytest.approx([0.0, 1.0, 0.0, 1.0], abs=1e-12)


def test_the_inverse_undoes(tftool):
    there = tftool("convert", "--x", "1", "--y", "2", "--yaw", "-0.5", "--into", "static").out
    back = tftool("convert", *there.split(), "--inverse", "--then", there, "--into", "matrix4")
    chained = tftool("convert", there.strip(), "--then", there, "--inverse", "--into", "matrix4")

    assert back.status == chained.status == 0
    assert back.out == chained.out


def test_close_to_a_pole_roll_and_yaw_are_said_to_go_together(tftool):
    origin = '<origin xyz="0 0 0" rpy="0 1.5708 0"/>'

    assert "turn about the same axis there" in tftool("convert", origin).err
    assert (
        "turn about the same axis there" not in tftool("convert", origin.replace("1.5", "0.5")).err
    )


def test_degrees_are_read_and_printed(tftool):
    out = tftool("convert", "rpy", "0", "0", "90", "--degrees", "--into", "ypr").out

    assert [float(word) for word in out.split()] == pytest.approx([90.0, 0.0, 0.0])


def test_stdin_is_read(tftool, monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.StringIO("x: 0\ny: 0\nz: 0\nw: 1\n"))

    assert tftool("convert", "--into", "wxyz").out == "1 0 0 0\n"


def test_every_order_is_listed_when_asked(tftool):
    out = tftool("convert", "rpy", "0", "0", "1", "--all").out

    assert sum(line.startswith("Euler ") for line in out.splitlines()) == 24


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["0", "0", "0.7", "0.7"], "--as xyzw or --as wxyz"),
        (["--as", "nonsense", "1"], "not a notation of a rotation"),
        (["rpy", "0", "0", "1", "--into", "nonsense"], "not a notation: choose one of xyzw"),
        (["rpy", "0", "0", "1", "--into", "xyzw", "--json"], "leave out --json"),
        (["--nonsense", "1", "2", "3"], "'nonsense'"),
        (["\x1b[31m0 0 0 1"], "␛"),
    ],
)
def test_wrong_words_are_wrong_usage(tftool, words, told):
    result = tftool("convert", *words)

    assert result.status == 2
    assert told in result.err
    assert result.out == ""
