"""Prediction errors of motion at constant velocity: how far each sample is from its prediction."""

import numpy as np

from tftool.base.stamps import NANOSECONDS
from tftool.doctor.stamp_stream import Places, Track
from tftool.geometry.rigid_arrays import (
    Floats,
    angles_between,
    conjugate,
    multiply,
    rotation_vectors,
    unit,
)

RADIAN = 0.5
"""Metres that a radian counts for where one number stands for a distance and an angle."""


def motion_errors(track: Track, places: Places) -> Floats:
    """Return each sample's distance from its prediction by the two before it.

    The rotation between two samples may be a whole turn more or less, as for a fast wheel: the best
    of the three values is used.

    Args:
        track: The samples.
        places: Rows of the track in the order of their stamps, shape (n,).

    Returns:
        Metres, a radian as `RADIAN` of them, shape (n,); NaN for the first two, and where two
        stamps are equal.
    """
    errors = np.full(len(places), np.nan)
    if len(places) < 3:
        return errors
    times = track.stamps[places] / NANOSECONDS
    steps = np.diff(times)
    with np.errstate(all="ignore"):
        ratio = np.where(steps[:-1] > 0.0, steps[1:] / steps[:-1], np.nan)
    where, turned = track.translations[places], unit(track.rotations[places])
    led = where[1:-1] + (where[1:-1] - where[:-2]) * ratio[:, None]
    missed = np.sqrt(np.einsum("ij,ij->i", where[2:] - led, where[2:] - led))
    first = rotation_vectors(multiply(conjugate(turned[:-2]), turned[1:-1]))
    angles = np.sqrt(np.einsum("ij,ij->i", first, first))
    axes = first / np.where(angles > 0.0, angles, 1.0)[:, None]
    best = np.full(len(angles), np.inf)
    for turns in (-1, 0, 1):
        half = 0.5 * (angles + 2.0 * np.pi * turns) * ratio
        led_turn = np.column_stack((axes * np.sin(half)[:, None], np.cos(half)))
        # What does not turn at all has no axis for a whole turn.
        led_turn = np.where((angles > 0.0)[:, None], led_turn, (0.0, 0.0, 0.0, 1.0))
        best = np.fmin(best, angles_between(multiply(turned[1:-1], led_turn), turned[2:]))
    errors[2:] = missed + RADIAN * best
    return errors
