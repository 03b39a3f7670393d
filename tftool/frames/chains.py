"""Links one after the other: where a lookup spends its time."""

import math
import struct
from math import sin
from typing import Final, TypeAlias

from tftool.frames.links import IDENTITY, NOWHERE, RECORD, Link, Sample
from tftool.stamps import Stamp

# Compiled, this is quicker than to look the name up each time; `sin` is C's own there.
_acos: Final = math.acos
_unpack_two: Final = struct.Struct("q7dq7d").unpack_from

_Pair: TypeAlias = tuple[
    Stamp, float, float, float, float, float, float, float,
    Stamp, float, float, float, float, float, float, float,
]  # fmt: skip
"""Two samples next to each other, each with its stamp before it."""


def chained(links: tuple[Link, ...], time: Stamp) -> Sample:
    """The poses of several links one after the other, lowest first; NOWHERE if one has none.

    This is where a lookup spends its time, so everything is written out: a call for each
    link, each search and each product would double the cost.

    Args:
        links: Each one's parent is the next one's child.
        time: The moment; 0 for each link's newest.

    Returns:
        The pose of the first link's child in the last link's parent.
    """
    if time == 0 or not links:
        return _newest(links)
    # What compiled code is to keep as plain floats.
    tx: float
    ty: float
    tz: float
    ax: float
    ay: float
    az: float
    aw: float
    ux: float
    uy: float
    uz: float
    bx: float
    by: float
    bz: float
    bw: float
    pair: _Pair
    first = True
    for link in links:
        newest = link.newest_stamp
        if link.oldest_stamp < time < newest:
            before = link.previous_stamp
            if time >= before:
                # Most questions fall between the last two, and those are at hand.
                one, two, after = link.previous, link.newest, newest
                if one is None or two is None:
                    return NOWHERE
                tx, ty, tz, ax, ay, az, aw = one
                ux, uy, uz, bx, by, bz, bw = two
            else:
                # Samples come almost periodically: guess first, search if that is wrong.
                index = link.start + (time - link.oldest_stamp) // link.period
                try:
                    pair = _unpack_two(link.records, RECORD * index)
                except struct.error:
                    # Beyond the newest one.
                    pair = _unpack_two(link.records, RECORD * link.index(time))
                if not pair[0] <= time < pair[8]:
                    pair = _unpack_two(link.records, RECORD * link.index(time))
                before, tx, ty, tz, ax, ay, az, aw, after, ux, uy, uz, bx, by, bz, bw = pair
            if before != time and not (link.mixed and link.parts(time)):
                ratio = (time - before) / (after - before)
                tx += ratio * (ux - tx)
                ty += ratio * (uy - ty)
                tz += ratio * (uz - tz)
                # As quaternions.slerp.
                cosine = ax * bx + ay * by + az * bz + aw * bw
                take = 1.0
                if cosine < 0.0:
                    cosine = -cosine
                    take = -1.0
                if cosine < 1.0:
                    angle = _acos(cosine)
                    sine = sin(angle)
                    keep = sin((1.0 - ratio) * angle) / sine
                    take *= sin(ratio * angle) / sine
                else:
                    # Too near for acos to tell; on an arc this short the chord is the arc.
                    keep = 1.0 - ratio
                    take *= ratio
                ax = keep * ax + take * bx
                ay = keep * ay + take * by
                az = keep * az + take * bz
                aw = keep * aw + take * bw
        elif newest == time or link.is_static:
            one = link.newest
            if one is None:
                return NOWHERE
            tx, ty, tz, ax, ay, az, aw = one
        else:
            one = link.exactly(time)
            if one is None:
                return NOWHERE
            tx, ty, tz, ax, ay, az, aw = one
        if first:
            # One by one, which is quicker than as tuples.
            first = False
            x = tx
            y = ty
            z = tz
            qx = ax
            qy = ay
            qz = az
            qw = aw
        else:
            cx = 2.0 * (ay * z - az * y)
            cy = 2.0 * (az * x - ax * z)
            cz = 2.0 * (ax * y - ay * x)
            x += aw * cx + ay * cz - az * cy + tx
            y += aw * cy + az * cx - ax * cz + ty
            z += aw * cz + ax * cy - ay * cx + tz
            qx, qy, qz, qw = (
                aw * qx + ax * qw + ay * qz - az * qy,
                aw * qy + ay * qw + az * qx - ax * qz,
                aw * qz + az * qw + ax * qy - ay * qx,
                aw * qw - ax * qx - ay * qy - az * qz,
            )
    return x, y, z, qx, qy, qz, qw


def joined(outer: Sample, inner: Sample) -> Sample:
    """One pose after another: `a_from_c` from `a_from_b` and `b_from_c`."""
    ox, oy, oz, ax, ay, az, aw = outer
    x, y, z, bx, by, bz, bw = inner
    # As quaternions.rotate and quaternions.multiply.
    cx = 2.0 * (ay * z - az * y)
    cy = 2.0 * (az * x - ax * z)
    cz = 2.0 * (ax * y - ay * x)
    return (
        x + aw * cx + ay * cz - az * cy + ox,
        y + aw * cy + az * cx - ax * cz + oy,
        z + aw * cz + ax * cy - ay * cx + oz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by + ay * bw + az * bx - ax * bz,
        aw * bz + az * bw + ax * by - ay * bx,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def _newest(links: tuple[Link, ...]) -> Sample:
    whole = IDENTITY
    for link in links:
        if link.newest is None:
            return NOWHERE
        whole = joined(link.newest, whole)
    return whole
