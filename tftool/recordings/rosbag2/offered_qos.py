"""A publisher's offered QoS in rosbag2's form."""

import re
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

_POLICIES: Final = {
    "history": ("system_default", "keep_last", "keep_all", "unknown"),
    "reliability": ("system_default", "reliable", "best_effort", "unknown"),
    "durability": ("system_default", "transient_local", "volatile", "unknown"),
    "liveliness": ("system_default", "automatic", "manual_by_node", "manual_by_topic", "unknown"),
}
_POLICY = re.compile(
    rf"^([\s-]*)({'|'.join(_POLICIES)}):[ \t]*['\"]?(\w+)['\"]?[ \t]*$", re.MULTILINE
)


def offers_text(static: bool) -> str:
    """Return the QoS of a publisher of transforms as text.

    Args:
        static: Whether late subscribers get the last message too.
    """
    durability = "transient_local" if static else "volatile"
    return _WORDS.format(depth=1 if static else 100, durability=durability)


def restyled(text: str, version: int) -> str:
    """Return offered QoS with policies in the form of a metadata version."""

    def policy(match: "re.Match[str]") -> str:
        before, name, value = match.groups()
        words = _POLICIES[name]
        if version < NUMBERS_BELOW and value in words:
            value = str(words.index(value))
        elif version >= NUMBERS_BELOW and value.isdecimal() and int(value) < len(words):
            value = words[int(value)]
        return f"{before}{name}: {value}"

    return _POLICY.sub(policy, text)
