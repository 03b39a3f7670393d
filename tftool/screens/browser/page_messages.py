"""Messages between the page and its server, defined once for Python and JavaScript.

`REQUESTS` and `ANSWERS` contain the fields of every text message, `HEAD` and `NUMBERS` the layout
of the binary message. Python reads requests and builds answers according to these tables. For the
page, `python -m tftool.screens.browser.page_messages` writes `page/messages.js`: the types of all
messages, which TypeScript checks, and the decoder of the head.

Times are seconds since the clock's epoch. For a hundred days, a float stores such a time to the
nanosecond. The epoch is sent as text.
"""

import json
import struct
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path
from typing import Any, Final

from tftool.base.errors import InputError

MOST_MOMENTS: Final = 2000
"""Largest number of times of a pair in one message: a plot has no more columns."""

MOST_TRAILS: Final = 60
"""Largest number of frames whose trails are in one message."""

MOST_BYTES: Final = 16 * 1024
"""Longest message from a page in bytes: enough for two names of some thousand letters."""

ARROWS: Final = ("up", "down", "left", "right")
"""Keys that drive a turtle."""


@dataclass(frozen=True, slots=True)
class PageRequest:
    """Message from a page.

    Attributes:
        kind: Type, one of `REQUESTS`.
        fields: Checked values by name.
    """

    kind: str
    fields: Mapping[str, Any]

    def __getitem__(self, name: str) -> Any:
        """Return the value of a field."""
        return self.fields[name]


@dataclass(frozen=True, slots=True)
class FieldType:
    """Type of a request's field, for Python and for TypeScript.

    Attributes:
        javascript: The type in TypeScript.
        words: Description of the valid values, for an error text after "must be".
        read: Function that checks and converts a value; raises ValueError for an invalid value.
    """

    javascript: str
    words: str
    read: Callable[[Any], Any]


def _checked(is_right: bool, value: Any) -> Any:
    if not is_right:
        raise ValueError
    return value


def _number(limit: float) -> Callable[[Any], float]:
    # Compared before the conversion, which fails for integers too large for a float.
    return lambda value: float(
        _checked(isinstance(value, (int, float)) and abs(value) < limit, value)
    )


def _name(value: Any) -> Any:
    return _checked(isinstance(value, str), value)


def _whole(low: int, high: int) -> Callable[[Any], Any]:
    return lambda value: _checked(isinstance(value, int) and low <= value <= high, value)


def _names(value: Any) -> tuple[str, ...]:
    _checked(isinstance(value, list) and len(value) <= MOST_TRAILS, value)
    return tuple(_name(one) for one in value)


def _or_null(kind: FieldType) -> FieldType:
    return FieldType(
        f"{kind.javascript} | null",
        f"{kind.words}, or null",
        lambda value: None if value is None else kind.read(value),
    )


_MOMENT = FieldType("number", "a number of seconds since the epoch", _number(1e12))
_NAME = FieldType("string", "a name", _name)
_FRAME = FieldType("string", "the name of a frame", _name)
_SPAN = {
    "from": _MOMENT,
    "to": _MOMENT,
    "count": FieldType(
        "number", f"a whole number from 2 to {MOST_MOMENTS}", _whole(2, MOST_MOMENTS)
    ),
}

REQUESTS: Final[dict[str, dict[str, FieldType]]] = {
    # Show a moment from now on; null for the present.
    "show": {"at": _or_null(_MOMENT)},
    # Send a pair's transform with every picture from now on; null twice ends it.
    "pair": {"target": _or_null(_FRAME), "source": _or_null(_FRAME)},
    # The page has drawn the poses of this sequence number.
    "got": {"sequence": FieldType("number", "a whole number", _whole(-(1 << 63), 1 << 63))},
    # Move a joint: radians or metres.
    "move": {"joint": _NAME, "position": FieldType("number", "a finite number", _number(1e9))},
    # A key that drives a turtle.
    "key": {
        "key": FieldType(
            " | ".join(f'"{key}"' for key in ARROWS),
            f"one of {', '.join(ARROWS)}",
            lambda value: _checked(value in ARROWS, value),
        )
    },
    # Send poses over the whole buffer, once: they have sequence number 0.
    "past": {},
    # Send a pair's transform at evenly spread moments.
    "series": {"target": _FRAME, "source": _FRAME, **_SPAN},
    # Send frames' positions at evenly spread moments.
    "trails": {
        "fixed": _FRAME,
        "frames": FieldType("string[]", f"a list of at most {MOST_TRAILS} names", _names),
        **_SPAN,
    },
    # Send gaps and the doctor's findings, when they are known.
    "marks": {},
}
"""Messages of the page by type, with their fields."""

_POSITIONS = "(number | null)[]"

ANSWERS: Final[dict[str, dict[str, str]]] = {
    # Names and parents of the frames, whenever they change.
    "frames": {
        "epoch": "string",
        "revision": "number",
        "names": "string[]",
        "parents": "number[]",
        "statics": "number[]",
        "authorities": "string[]",
        "total": "number",
        "rate": "number",
        "begin?": "number",
    },
    # The transform of the chosen pair, or why there is none.
    "pair": {
        "target": "string",
        "source": "string",
        "found": "boolean",
        "why?": "string",
        "stamp?": "string",
        "moment?": "number | null",
        "translation?": _POSITIONS,
        "rotation?": _POSITIONS,
        "rpy?": _POSITIONS,
        "chain?": "string[]",
    },
    # Shapes, joints and sliders of the robot.
    "robot": {
        "name": "string",
        "links": 'import("./robot.js").Link[]',
        "joints": "{ name: string, frame: string, axis: number[], slides: boolean }[]",
        "sliders": "{ name: string, unit: string, range: number[], position: number }[]",
        "motion": 'import("./kinematics.js").Joint[]',
        "missing": "string[]",
    },
    # The span of the buffer, while a past moment is shown.
    "range": {"now": "number", "oldest": "number", "newest": "number"},
    # A pair's transform at many moments: metres, radians, null where there is none.
    "series": {
        "target": "string",
        "source": "string",
        "times": "number[]",
        **dict.fromkeys(("x", "y", "z", "roll", "pitch", "yaw"), _POSITIONS),
    },
    # Positions of frames at many moments.
    "trails": {
        "fixed": "string",
        "from": "number",
        "to": "number",
        "places": "Record<string, (number[] | null)[]>",
    },
    # Gaps of edges and the doctor's findings.
    "marks": {
        "gaps": "[string, number, number][]",
        "findings": "{ id: string, severity: string, message: string, since: number, "
        "until: number }[]",
    },
    # Recorded messages can be fetched.
    "tracks": {},
}
"""Text messages to the page by type, each field with its type for TypeScript; `?` for a field that
may be missing."""

MAGIC: Final = b"TFP1"

HEAD: Final = {
    "sequence": "I",
    "revision": "I",
    "count": "I",
    "now": "d",
    "at": "d",
    "oldest": "d",
    "newest": "d",
}
"""Head of the binary message after the magic number, little-endian: sequence number, revision of
the names, number of frames; then times: now, the shown one (NaN for the present), and the span of
the buffer."""

HEADER: Final = struct.Struct(f"<4s{''.join(HEAD.values())}")

NUMBERS: Final = ("x", "y", "z", "qx", "qy", "qz", "qw", "newest", "oldest", "rate", "samples")
"""Numbers of each frame after the head, doubles: its pose in its parent (NaN without data), its
span, its rate in hertz, and its number of samples."""


def parse(message: str | bytes) -> PageRequest:
    """Parse a message from a page, and check the fields.

    Raises:
        InputError: If the message is not one of `REQUESTS`; the error text names the wrong field.
    """
    if isinstance(message, bytes):
        raise InputError("the message is bytes, but a page must send text")
    try:
        given = json.loads(message)
    except (ValueError, RecursionError) as error:
        raise InputError("the message is not JSON") from error
    kind = given.get("type") if isinstance(given, dict) else None
    if not isinstance(kind, str) or kind not in REQUESTS:
        *most, last = REQUESTS
        raise InputError(f'a message must have the "type" {", ".join(most)} or {last}')
    fields = {}
    for name, field in REQUESTS[kind].items():
        try:
            fields[name] = field.read(given.get(name))
        except ValueError:
            raise InputError(f"'{name}' of a message '{kind}' must be {field.words}") from None
    if kind == "pair" and (fields["target"] is None) != (fields["source"] is None):
        raise InputError("a pair must be two names of frames, or null twice")
    if "from" in fields and not fields["from"] < fields["to"]:
        raise InputError("a series must end after it begins")
    return PageRequest(kind, fields)


def answer(kind: str, fields: Mapping[str, Any]) -> dict[str, Any]:
    """Return a message for the page, with exactly the fields that `ANSWERS` lists."""
    known = ANSWERS[kind]
    needed = {name for name in known if not name.endswith("?")}
    assert needed <= fields.keys() <= {name.removesuffix("?") for name in known}, kind
    return {"type": kind, **fields}


def as_javascript() -> str:
    """Return the text of `page/messages.js`."""
    lines = [
        "// @ts-check",
        "// Written by `python -m tftool.screens.browser.page_messages` from its tables: change "
        "those.",
        "",
        "/**",
    ]
    for family, several in (
        ("Request", {kind: _types(fields) for kind, fields in REQUESTS.items()}),
        ("Answer", ANSWERS),
    ):
        for kind, fields in several.items():
            typed = "".join(f", {name}: {javascript}" for name, javascript in fields.items())
            lines.append(f' * @typedef {{{{ type: "{kind}"{typed} }}}} {kind.title()}{family}')
        union = " | ".join(f"{kind.title()}{family}" for kind in several)
        lines.append(f" * @typedef {{{union}}} {family}")
    sizes = [struct.calcsize(f"<{code}") for code in HEAD.values()]
    starts = accumulate(sizes, initial=len(MAGIC))
    getters = {"I": "getUint32", "d": "getFloat64"}
    lines += [
        " */",
        "",
        f"export const MAGIC = 0x{MAGIC.hex()};",
        f"export const HEADER = {HEADER.size}; // bytes",
        f"export const FIELDS = {len(NUMBERS)}; // numbers of a frame",
        "export const FIELD = { "
        + ", ".join(f"{name}: {place}" for place, name in enumerate(NUMBERS))
        + " };",
        "",
        "/**",
        " * Head of a binary message with poses.",
        " * @param {DataView} view",
        " */",
        "export const head = (view) => ({",
        *(
            f"  {name}: view.{getters[code]}({start}, true),"
            for (name, code), start in zip(HEAD.items(), starts, strict=False)
        ),
        "});",
    ]
    return "\n".join(lines) + "\n"


def _types(fields: Mapping[str, FieldType]) -> dict[str, str]:
    return {name: field.javascript for name, field in fields.items()}


if __name__ == "__main__":
    file = Path(__file__).with_name("page") / "messages.js"
    file.write_text(as_javascript(), encoding="utf-8")
