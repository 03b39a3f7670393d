"""How wide a text is in Helvetica, so that boxes fit what is written into them.

Widths are those of the font's published metrics, in thousandths of its size. Browsers
draw the same sheets with a font of their own that is about as wide.
"""

_ASCII = (
    # 0x20 to 0x7e
    *(278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278),
    *(556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556),
    *(1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778),
    *(667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556),
    *(333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556),
    *(556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584),
)
_OTHER = 620
_WIDE = 1000
_BOLD = 1.07


def width(text: str, size: float, *, bold: bool = False) -> float:
    """Estimate how long a text is, in the unit of `size`."""
    total = sum(map(_char_width, text)) * size / 1000
    return total * _BOLD if bold else total


def _char_width(char: str) -> int:
    code = ord(char) - 0x20
    if 0 <= code < len(_ASCII):
        return _ASCII[code]
    # From Hangul's first letters on, most of what people write is about square.
    return _WIDE if ord(char) >= 0x1100 else _OTHER


def fit(text: str, size: float, room: float, *, bold: bool = False) -> str:
    """Cut a text in its middle until it is no wider than `room`."""
    if width(text, size, bold=bold) <= room:
        return text
    budget = room - width("…", size, bold=bold)
    head, tail = 0, len(text)
    while head < tail:
        from_head = head <= len(text) - tail
        char = text[head] if from_head else text[tail - 1]
        budget -= width(char, size, bold=bold)
        if budget < 0:
            break
        if from_head:
            head += 1
        else:
            tail -= 1
    return f"{text[:head]}…{text[tail:]}"
