"""Tests of every notation of a rotation."""

import pytest

from tftool.geometry.conversions import quaternion_from_rpy
from tftool.geometry.notation.notations import EULER, NOTATIONS
from tftool.geometry.quaternions import angle_between
from tftool.geometry.rigid import Quaternion

TURN = quaternion_from_rpy(0.3, -0.4, 2.5)


@pytest.mark.parametrize("form", [*NOTATIONS, *EULER])
def test_a_notation_reads_what_it_writes(form):
    notation = (NOTATIONS | EULER)[form]

    numbers = notation.write(TURN)

    assert len(numbers) == notation.count
    assert angle_between(Quaternion(*notation.read(numbers)), TURN) < 1e-12
