"""Our definitions of messages as types of the library: final, and written as XCDR1.

The library checks every message that comes in against its type, and compares types with
those that others state. The bytes themselves it hands through: they are our codec's.
"""

from typing import Any, Final

from tftool.base.errors import LinkError
from tftool.messages.hashes import PLACEHOLDER, type_hash
from tftool.messages.schema import FieldDefinition, Schema
from tftool.world.link.dds.dds_names import dds_type

_NAMES: Final = {
    "bool": "bool",
    "byte": "uint8",
    "char": "uint8",
    "float": "float32",
    "double": "float64",
    "string": "str",
}


class Raw:
    """A message of any type, as its bytes; what the library needs of a class of messages."""

    __slots__ = ("payload", "sample_info")

    def __init__(self, payload: bytes) -> None:
        self.payload = payload
        self.sample_info: Any = None

    def serialize(self, **_: object) -> bytes:
        """The bytes, which are XCDR1 whatever is asked for."""
        return self.payload

    @classmethod
    def deserialize(cls, payload: bytes) -> "Raw":
        """A message that came in."""
        return cls(payload)

    @classmethod
    def deserialize_key(cls, _: bytes) -> None:
        """Nothing: no message of ROS 2 has a key."""
        return


_MADE: Final[dict[tuple[str, str, tuple[tuple[str, str], ...]], type[Raw]]] = {}
"""Classes by the hash of their types: participants of one process have to share them."""


class Types:
    """Classes for the library by the names of their types."""

    def __init__(self, schema: Schema) -> None:
        self._schema = schema

    def raw(self, full: str, *, beside: tuple[tuple[str, str], ...] = ()) -> type[Raw]:
        """The class by which messages of a type go out and come in.

        Args:
            full: The type's full name.
            beside: Fields that lie in front of its own, by name and type.

        Raises:
            InputError: If a definition is missing.
            LinkError: If the library has no such type.
        """
        key = full, type_hash(self._schema, full), beside
        if key not in _MADE:
            made = self._made(full, beside, {})
            _MADE[key] = type("Raw", (Raw,), {"__slots__": (), "__idl__": made.__idl__})
        return _MADE[key]

    def _made(self, full: str, beside: tuple[tuple[str, str], ...], parts: dict[str, Any]) -> Any:
        from cyclonedds.idl import make_idl_struct
        from cyclonedds.idl.annotations import final

        fields = {
            name: self._single(full, FieldDefinition(name, kind), parts) for name, kind in beside
        }
        for field in self._schema.structure(full).fields or (PLACEHOLDER,):
            fields[field.name] = self._field(full, field, parts)
        short = full.rpartition("/")[2]
        return final(make_idl_struct(short, dds_type(full), fields))

    def _field(self, full: str, field: FieldDefinition, parts: dict[str, Any]) -> Any:
        from cyclonedds.idl import types

        kind = self._single(full, field, parts)
        if field.size is not None and field.size >= 0:
            return types.array[kind, field.size]
        if field.bound is not None:
            return types.sequence[kind, field.bound]
        return kind if field.size is None else types.sequence[kind]

    def _single(self, full: str, field: FieldDefinition, parts: dict[str, Any]) -> Any:
        from cyclonedds.idl import types

        if field.type == "wstring":
            raise LinkError(f"{full}: DDS's library for Python has no wide texts ('{field.name}')")
        if "/" in field.type:
            if field.type not in parts:
                parts[field.type] = self._made(field.type, (), parts)
            return parts[field.type]
        if field.text_bound is not None:
            return types.bounded_str[field.text_bound]
        name = _NAMES.get(field.type, field.type)
        return {"bool": bool, "str": str}.get(name) or getattr(types, name)
