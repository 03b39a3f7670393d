"""What a publisher offered its subscribers, as rosbag2 writes it beside a topic."""

from typing import Final

_WORDS: Final = """\
- history: keep_last
  depth: {depth}
  reliability: reliable
  durability: {durability}
  deadline:
    sec: 9223372036
    nsec: 854775807
  lifespan:
    sec: 9223372036
    nsec: 854775807
  liveliness: automatic
  liveliness_lease_duration:
    sec: 9223372036
    nsec: 854775807
  avoid_ros_namespace_conventions: false
"""

NUMBERS_BELOW: Final = 9
"""Versions of rosbag2's metadata below this write policies as numbers."""

_NUMBERS: Final = {
    "keep_last": "1",
    "reliable": "1",
    "transient_local": "1",
    "volatile": "2",
    "automatic": "1",
}


def offers_text(static: bool, *, depth: int = 1, version: int = 9) -> str:
    """The offer of a publisher of transforms.

    Args:
        static: Whether late subscribers get the last message too.
        depth: How many messages are kept for them.
        version: Of rosbag2's metadata, whose style is kept to.
    """
    durability = "transient_local" if static else "volatile"
    text = _WORDS.format(depth=depth if static else 100, durability=durability)
    if version < NUMBERS_BELOW:
        for word, number in _NUMBERS.items():
            text = text.replace(f": {word}\n", f": {number}\n")
    return text
