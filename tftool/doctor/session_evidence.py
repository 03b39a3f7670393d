"""What a world's topics carried while something listened, as material for a diagnosis."""

import numpy as np

from tftool.base.stamps import Stamp
from tftool.doctor.evidence import Material
from tftool.frames.transform_log import TransformLog
from tftool.recordings.contract import RecordedTopic


class Hearing(TransformLog):
    """Transforms as they arrived, with who sent them."""

    def material(self, name: str, kind: str, start: Stamp, end: Stamp) -> Material:
        """All of it; see `of_log`."""
        return of_log(self, name, kind, start, end)


def of_log(log: TransformLog, name: str, kind: str, start: Stamp, end: Stamp) -> Material:
    """Return what a diagnosis looks at, of transforms as they arrived.

    Args:
        log: What arrived.
        name: The name of the source, for people.
        kind: What the source is.
        start: When listening began.
        end: When it ended.
    """
    transforms = log.transforms()
    publishers = transforms.publishers
    counts = np.bincount(transforms.senders, minlength=len(publishers)).tolist()
    topics = tuple(
        RecordedTopic(
            topic,
            "tf2_msgs/TFMessage",
            count=sum(n for p, n in zip(publishers, counts, strict=True) if p.topic == topic),
            transforms=True,
            static=topic == "/tf_static",
        )
        for topic in sorted({publisher.topic for publisher in publishers})
    )
    return Material(
        name=name,
        kind=kind,
        transforms=transforms,
        topics=topics,
        publishers=publishers,
        start=start,
        end=end,
        recorded=False,
    )
