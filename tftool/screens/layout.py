"""Who gets how much of the screen."""

from dataclasses import dataclass

SMALLEST = (30, 10)
"""Columns and rows below which there is nothing but a sentence."""

WITH_PANELS = 56
"""Columns from which the field gets company."""

PAIR_LINES = 6
"""Lines the echo needs to say everything shortly."""

BLOCK_LINES, BLOCK_WIDTH = 12, 62
"""Lines and columns from which it says everything as tf2_echo does."""


@dataclass(frozen=True, slots=True)
class ScreenLayout:
    """Sizes with their borders, in cells; 0 for whatever is left.

    Attributes:
        small: Whether there is room for nothing.
        alone: Whether the field has no panels beside it.
        portrait: Whether they stand under it.
        field: The field's width and height.
        tree: The tree's height.
        pair: The echo's height.
    """

    small: bool = False
    alone: bool = False
    portrait: bool = False
    field: tuple[int, int] = (0, 0)
    tree: int = 0
    pair: int = 0


def arranged(width: int, height: int, banner: int, frames: int) -> ScreenLayout:
    """Share a screen out.

    Args:
        width: Its columns.
        height: Its rows.
        banner: How many of them a banner takes.
        frames: How many lines the tree would like.
    """
    if width < SMALLEST[0] or height < SMALLEST[1]:
        return ScreenLayout(small=True)
    if width < WITH_PANELS:
        return ScreenLayout(alone=True)
    # A top line and a line of keys; and every panel has a border.
    room = height - 2 - banner
    beside = min(room - 2, (width - (28 if width < 84 else 38)) // 2)
    under = min((width - 2) // 2, room - 12)
    if under > 1.15 * beside:
        return ScreenLayout(portrait=True, field=(0, under + 2))
    pair = (BLOCK_LINES if room >= 40 else PAIR_LINES) + 2
    least_log = max(3, room // 4)
    tree = min(max(4, frames + 3), max(5, room - pair - least_log))
    return ScreenLayout(field=(2 * beside + 2, 0), tree=tree, pair=pair)
