"""Function that copies the samples of a buffer up to a given time."""

from itertools import pairwise

import numpy as np

from tftool.base.stamps import Stamp
from tftool.buffer.buffer import Buffer, lend
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform


def up_to(whole: Buffer, moment: Stamp) -> Buffer:
    """Return a buffer with the samples of `whole` up to a time, and all static transforms."""
    frames = whole.frames()
    found = Buffer(whole.cache_time, max_frames=max(1, len(frames)))
    for frame in frames:
        # Share the samples without a copy, which matters for recordings of gigabytes.
        if lend(whole, frame, found, moment):
            continue
        samples = whole.samples(frame)
        count = (
            len(samples)
            if samples.is_static
            else int(np.searchsorted(samples.stamps, moment, "right"))
        )
        links = list(zip(samples.parents[:count], samples.authorities[:count], strict=True))
        # Insert each run of samples with the same parent and sender in one call.
        starts = [row for row in range(count) if row == 0 or links[row] != links[row - 1]]
        for first, last in pairwise([*starts, count]):
            parent, authority = links[first]
            run = slice(first, last)
            if samples.is_static:
                row = samples.poses[first].tolist()
                pose = Transform(row[:3], row[3:])
                found.set_transform_static(TransformStamped(0, parent, frame, pose), authority)
            else:
                found.set_transforms(
                    parent,
                    frame,
                    samples.stamps[run],
                    samples.translations[run],
                    samples.rotations[run],
                    authority,
                )
    return found
