"""PDF file of a tree picture: one page of the picture's size, in Helvetica, without a library.

Every PDF reader includes Helvetica, but only its Western European letters. Any other letter is
written as its code, such as <U+4E16>.

Boxes are sized by Helvetica's published letter widths. Browsers draw the same pictures with a font
of similar width.
"""

import zlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tftool.drawing.picture import Box, Curve, Picture, Text


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
    """Estimate the width of a text in Helvetica, in the unit of `size`."""
    total = sum(map(_char_width, text)) * size / 1000
    return total * _BOLD if bold else total


def _char_width(char: str) -> int:
    code = ord(char) - 0x20
    if 0 <= code < len(_ASCII):
        return _ASCII[code]
    # From Hangul's first letters on, most characters are about square.
    return _WIDE if ord(char) >= 0x1100 else _OTHER


def fit(text: str, size: float, limit: float, *, bold: bool = False) -> str:
    """Shorten a text in the middle until its width is at most `limit`, in the unit of `size`."""
    if width(text, size, bold=bold) <= limit:
        return text
    budget = limit - width("…", size, bold=bold)
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


_LARGEST = 14_400.0
"""Readers refuse pages longer than this many points; larger drawings are scaled down."""

_FILL = {
    "root": (0.86, 0.914, 1.0),
    "dynamic": (1.0, 1.0, 1.0),
    "stale": (1.0, 0.945, 0.878),
    "static": (0.992, 0.969, 0.906),
    "group": None,
    "more": None,
}
_STROKE = {
    "root": (0.294, 0.498, 0.839),
    "dynamic": (0.561, 0.639, 0.741),
    "stale": (0.851, 0.451, 0.102),
    "static": (0.725, 0.604, 0.271),
    "group": (0.776, 0.808, 0.851),
    "more": (0.541, 0.576, 0.627),
}
_DASH = {"static": "[5 3] 0 d", "more": "[1.5 3] 0 d"}
_INK = {"name": (0.09, 0.11, 0.141), "fact": (0.353, 0.392, 0.447), "note": (0.541, 0.416, 0.09)}
_LINK = (0.427, 0.525, 0.659)
_STATIC_LINK = _STROKE["static"]

# Length of a Bézier curve's handles for a quarter of a circle of radius 1.
_QUARTER = 0.5523


def render(picture: "Picture") -> bytes:
    """Return a picture as the bytes of a PDF file with one page."""
    scale = min(1.0, _LARGEST / max(picture.width, picture.height))
    wide, high = picture.width * scale, picture.height * scale
    parts = [f"{scale:.6f} 0 0 {-scale:.6f} 0 {high:.2f} cm"]
    parts.extend(map(_link, picture.links))
    parts.extend(map(_box, picture.boxes))
    parts.append("BT")
    parts.extend(map(_text, picture.texts))
    parts.append("ET")
    content = zlib.compress("\n".join(parts).encode("latin-1"), 6)
    font = "<< /Type /Font /Subtype /Type1 /BaseFont /{} /Encoding /WinAnsiEncoding >>"
    return _file(
        [
            b"<< /Type /Catalog /Pages 2 0 R >>",
            b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
            (
                f"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {wide:.2f} {high:.2f}] "
                "/Contents 4 0 R /Resources << /Font << /F1 5 0 R /F2 6 0 R >> >> >>"
            ).encode(),
            b"<< /Length %d /Filter /FlateDecode >>\nstream\n%s\nendstream"
            % (len(content), content),
            font.format("Helvetica").encode(),
            font.format("Helvetica-Bold").encode(),
            f"<< /Title {_string(_latin(picture.title))} /Producer (tftool) >>".encode("latin-1"),
        ]
    )


def missing_letters(picture: "Picture") -> str:
    """Return the letters in a picture that Helvetica lacks, without repetitions."""
    return "".join(
        dict.fromkeys(char for text in picture.texts for char in text.text if not _has_letter(char))
    )


def _file(objects: list[bytes]) -> bytes:
    """Return the bytes of a PDF file from its objects; the last object is the catalogue."""
    out = bytearray(b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n")
    offsets = []
    for number, body in enumerate(objects, start=1):
        offsets.append(len(out))
        out += b"%d 0 obj\n%s\nendobj\n" % (number, body)
    start = len(out)
    out += b"xref\n0 %d\n0000000000 65535 f \n" % (len(objects) + 1)
    for offset in offsets:
        out += b"%010d 00000 n \n" % offset
    out += b"trailer\n<< /Size %d /Root 1 0 R /Info %d 0 R >>\nstartxref\n%d\n%%%%EOF\n" % (
        len(objects) + 1,
        len(objects),
        start,
    )
    return bytes(out)


def _link(link: "Curve") -> str:
    dash = "[5 4] 0 d" if link.static else "[] 0 d"
    ink = _colour(_STATIC_LINK if link.static else _LINK, "RG")
    return f"{ink} 1.6 w {dash} {link.x0:.2f} {link.y0:.2f} m {_numbers(*link.bends)} c S"


def _box(box: "Box") -> str:
    fill = _FILL[box.kind]
    style = [_colour(_STROKE[box.kind], "RG"), "1.2 w", _DASH.get(box.kind, "[] 0 d")]
    if fill is not None:
        style.append(_colour(fill, "rg"))
    radius = box.height / 2 if box.kind == "root" else 9.0
    return " ".join([*style, _rounded(box, radius), "B" if fill is not None else "S"])


def _rounded(box: "Box", radius: float) -> str:
    left, top, right, bottom = box.x, box.y, box.x + box.width, box.y + box.height
    handle = radius * (1 - _QUARTER)
    return " ".join(
        [
            f"{_numbers(left + radius, top)} m",
            f"{_numbers(right - radius, top)} l",
            f"{_numbers(right - handle, top, right, top + handle, right, top + radius)} c",
            f"{_numbers(right, bottom - radius)} l",
            f"{_numbers(right, bottom - handle, right - handle, bottom, right - radius, bottom)} c",
            f"{_numbers(left + radius, bottom)} l",
            f"{_numbers(left + handle, bottom, left, bottom - handle, left, bottom - radius)} c",
            f"{_numbers(left, top + radius)} l",
            f"{_numbers(left, top + handle, left + handle, top, left + radius, top)} c h",
        ]
    )


def _text(text: "Text") -> str:
    bold = text.kind == "name"
    latin = _latin(text.text)
    if latin != text.text:
        # Codes are longer than the letters that they replace: keep to the text's width.
        latin = fit(latin, text.size, max(width(text.text, text.size, bold=bold), 90.0), bold=bold)
    font = "/F2" if bold else "/F1"
    ink = _colour(_INK[text.kind], "rg")
    place = f"1 0 0 -1 {_numbers(text.x, text.y)} Tm"
    return f"{ink} {font} {text.size:.2f} Tf {place} {_string(latin)} Tj"


def _latin(text: str) -> str:
    """Replace letters that Helvetica lacks by their codes, <U+…>."""
    return "".join(char if _has_letter(char) else f"<U+{ord(char):04X}>" for char in text)


def _has_letter(char: str) -> bool:
    try:
        char.encode("cp1252")
    except UnicodeEncodeError:
        return False
    return True


def _string(text: str) -> str:
    """Return a text as a PDF string in WinAnsi encoding, with one character per byte."""
    quoted = text.replace("\\", r"\\").replace("(", r"\(").replace(")", r"\)")
    return f"({quoted.encode('cp1252').decode('latin-1')})"


def _colour(rgb: tuple[float, float, float], operator: str) -> str:
    return f"{_numbers(*rgb)} {operator}"


def _numbers(*values: float) -> str:
    return " ".join(f"{value:.2f}" for value in values)
