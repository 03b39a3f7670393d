"""What a frame may be called.

Setting takes off one leading slash, asking takes off none and refuses it: tf2's
rule, which lets old publishers in and tells whoever asks.
"""

NO_PARENT_NAME = "NO_PARENT"
"""The name that tf2 reserves for the parent of a root."""

EMPTY = "in tf2 frame_ids cannot be empty"
SLASHED = "in tf2 frame_ids cannot start with a '/'"


def stripped(name: str) -> str:
    """The name as it is remembered: without the one leading slash it may have.

    Raises:
        TypeError: If it is not a string.
    """
    if not isinstance(name, str):
        raise TypeError(f"a frame's name is a string, not {name!r}")
    return name[1:] if name.startswith("/") else name


def fault(name: str) -> str:
    """Why a name can never be asked for, in tf2's words; empty if it can."""
    if not isinstance(name, str):
        raise TypeError(f"a frame's name is a string, not {name!r}")
    if not name:
        return EMPTY
    if name.startswith("/"):
        return SLASHED
    return ""
