"""Hash of a message type's definition, as ROS 2 computes it (REP 2016, RIHS01).

The hash is the SHA-256 of a fixed JSON form of the type's description, with the descriptions of
nested types. The JSON has names and types of fields, but no defaults, constants or comments.
"""

import hashlib
import json
from typing import Any, Final

from tftool.messages.schema import FieldDefinition, Schema, Structure

_NESTED, _BOUNDED_STRING, _BOUNDED_WSTRING = 1, 21, 22
_NUMBERS: Final = {
    "int8": 2,
    "uint8": 3,
    # The description follows IDL, in which a char of a .msg file is a uint8.
    "char": 3,
    "int16": 4,
    "uint16": 5,
    "int32": 6,
    "uint32": 7,
    "int64": 8,
    "uint64": 9,
    "float32": 10,
    "float": 10,
    "float64": 11,
    "double": 11,
    "bool": 15,
    "byte": 16,
    "string": 17,
    "wstring": 18,
}
_ARRAY, _BOUNDED_SEQUENCE, _SEQUENCE = 48, 96, 144

PLACEHOLDER: Final = FieldDefinition("structure_needs_at_least_one_member", "uint8")
"""Field that an empty structure has in IDL."""


def type_hash(schema: Schema, full: str) -> str:
    """Return the type hash (RIHS01) of a message, a service, or a part of a service or action.

    Args:
        schema: Schema with the definition.
        full: Full name of the structure: "std_msgs/msg/String", "std_srvs/srv/Empty",
            "turtlesim/action/RotateAbsolute_SendGoal".

    Raises:
        InputError: If there is no structure with that name, or a nested type is not defined.
    """
    described: dict[str, dict[str, Any]] = {}
    _describe(schema, schema.structure(full), described)
    own = described.pop(full)
    text = json.dumps(
        {
            "type_description": own,
            "referenced_type_descriptions": [described[name] for name in sorted(described)],
        }
    )
    return f"RIHS01_{hashlib.sha256(text.encode()).hexdigest()}"


def _describe(schema: Schema, structure: Structure, described: dict[str, dict[str, Any]]) -> None:
    if structure.name in described:
        return
    described[structure.name] = {
        "type_name": structure.name,
        "fields": [_described(field) for field in structure.fields or (PLACEHOLDER,)],
    }
    for field in structure.fields:
        if field.type not in _NUMBERS:
            _describe(schema, schema.structure(field.type), described)


def _described(field: FieldDefinition) -> dict[str, Any]:
    number = _NUMBERS.get(field.type, _NESTED)
    if field.text_bound is not None:
        number = _BOUNDED_STRING if field.type == "string" else _BOUNDED_WSTRING
    capacity = 0
    if field.size is not None and field.size >= 0:
        number, capacity = number + _ARRAY, field.size
    elif field.bound is not None:
        number, capacity = number + _BOUNDED_SEQUENCE, field.bound
    elif field.size is not None:
        number += _SEQUENCE
    return {
        "name": field.name,
        "type": {
            "type_id": number,
            "capacity": capacity,
            "string_capacity": field.text_bound or 0,
            "nested_type_name": "" if field.type in _NUMBERS else field.type,
        },
    }
