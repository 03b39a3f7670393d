"""Screens as one animated SVG: each line is drawn once, and shown while it is on the screen."""

from collections.abc import Sequence
from html import escape

from rich.cells import cell_len

WIDE, HIGH = 8.4, 18.0
FONTS = "ui-monospace, SFMono-Regular, Menlo, Consolas, 'DejaVu Sans Mono', monospace"


def animated(screens: Sequence[Sequence], period: float, ground: str, title: str) -> str:
    """Return an SVG that shows screens one after the other, repeatedly.

    Args:
        screens: Screens as lists of textual's strips, all of one size.
        period: Seconds for which each screen is shown.
        ground: Background colour of cells without one.
        title: Title of the picture.
    """
    first = screens[0]
    width, height = first[0].cell_length * WIDE, len(first) * HIGH
    classes: dict[str, str] = {}
    lines: dict[tuple[int, str], list[int]] = {}
    for number, screen in enumerate(screens):
        for row, strip in enumerate(screen):
            lines.setdefault((row, _line(strip, row, ground, classes)), []).append(number)
    total = period * len(screens)
    shown = [_shown(drawn, numbers, len(screens), total) for (_, drawn), numbers in lines.items()]
    styles = "".join(f".{name}{{{style}}}" for style, name in classes.items())
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}">'
        f"<title>{escape(title)}</title>"
        f"<style>text{{font:14px {FONTS};white-space:pre}}{styles}</style>"
        f'<rect width="100%" height="100%" rx="6" fill="{ground}"/>' + "".join(shown) + "</svg>\n"
    )


def _line(strip, row: int, ground: str, classes: dict[str, str]) -> str:
    """Return the characters of a line, and the backgrounds below them."""
    below, above, column = [], [], 0
    for fill, back, bold, text in _runs(strip, ground):
        cells = cell_len(text)
        x, wide = f"{column * WIDE:.1f}", f"{cells * WIDE:.1f}"
        if back != ground:
            name = classes.setdefault(f"fill:{back}", f"s{len(classes)}")
            below.append(
                f'<rect class="{name}" x="{x}" y="{row * HIGH:.0f}" width="{wide}" '
                f'height="{HIGH + 0.5}"/>'
            )
        if text.strip():
            weight = ";font-weight:bold" if bold else ""
            name = classes.setdefault(f"fill:{fill}{weight}", f"s{len(classes)}")
            above.append(
                f'<text class="{name}" x="{x}" y="{row * HIGH + 13.5:.1f}" textLength="{wide}">'
                f"{escape(text)}</text>"
            )
        column += cells
    return "".join(below + above)


def _runs(strip, ground: str) -> list[tuple[str, str, bool, str]]:
    """Yield neighbouring cells of one style; blanks have the style of the cell before them."""
    runs: list[tuple[str, str, bool, str]] = []
    for segment in strip:
        style = segment.style
        fill = style.color.triplet.hex if style and style.color else "#ffffff"
        back = style.bgcolor.triplet.hex if style and style.bgcolor else ground
        look = fill, back, bool(style and style.bold)
        if runs and (runs[-1][:3] == look or (not segment.text.strip() and runs[-1][1] == back)):
            runs[-1] = (*runs[-1][:3], runs[-1][3] + segment.text)
        else:
            runs.append((*look, segment.text))
    return runs


def _shown(drawn: str, numbers: Sequence[int], count: int, total: float) -> str:
    """Return a line that is visible in the screens with these numbers."""
    if not drawn:
        return ""
    if len(numbers) == count:
        return drawn
    on = [number in numbers for number in range(count)]
    turns = [0, *(at for at in range(1, count) if on[at] != on[at - 1])]
    times = ";".join(f"{at / count:.4g}" for at in turns)
    values = ";".join("visible" if on[at] else "hidden" for at in turns)
    hidden = "" if on[0] else ' visibility="hidden"'
    return (
        f'<g{hidden}>{drawn}<animate attributeName="visibility" calcMode="discrete" '
        f'dur="{total:g}s" repeatCount="indefinite" keyTimes="{times}" values="{values}"/></g>'
    )
