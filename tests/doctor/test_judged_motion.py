"""Findings about motion capture, several robots and clocks, as on recordings of real robots."""

import pytest

from tests.doctor.judged import found, ids
from tests.doctor.robots import NO_TURN, Robot


def held_up(parent: str, *, moves: bool) -> Robot:
    """Return a body at 100 Hz that rests, moves by 2 m during a stall of 1.7 s, and rests.

    Pauses of 0.12 s before the stall are many. The first pose after the stall is an old one.
    """
    made = Robot()
    at = 0.0
    for tick in range(700):
        at += 0.01
        if tick % 30 == 29:
            at += 0.11
        if tick == 400:
            at += 1.69
        away = (0.0 if tick < 400 else 0.6 if tick == 400 else 2.0) * moves
        made.sent(parent, "car", at, (away + 1e-4 * (tick % 3), 0.0, 0.0, *NO_TURN))
    return made


@pytest.mark.parametrize(
    ("parent", "moves", "told"),
    [("world", True, ["gap"]), ("world", False, []), ("odom", True, ["gap", "teleport"])],
)
def test_a_body_that_moved_while_its_poses_were_held_up_has_a_gap_and_no_jump(parent, moves, told):
    made = held_up(parent, moves=moves)
    assert ids(made) == told
    if told:
        assert found(made, "gap").facts["length"] == pytest.approx(1.7e9, rel=0.01)
