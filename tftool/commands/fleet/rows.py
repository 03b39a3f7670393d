"""Result table to which rows are appended during the work: JSON lines, CSV or Parquet."""

import csv
import io
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

from tftool.base.errors import InputError, UsageError
from tftool.base.named_files import open_regular, reader_there
from tftool.base.plain_text import visible

if TYPE_CHECKING:
    import pyarrow

Row = dict[str, Any]
"""Cells of one finding, or of one recording, by the names of the columns."""


class ColumnKind(Enum):
    """Type of the cells in a column."""

    TEXT = "text"
    TEXTS = "a list of texts"
    EDGES = "a list of parents and children"
    INTEGER = "a whole number"
    NUMBER = "a number"


SUFFIXES = (".jsonl", ".csv", ".parquet")

_ROWS_AT_ONCE = 10_000


class RowFile:
    """File of result rows; all rows of one recording are written at once.

    Rows cannot be appended to a Parquet file. New rows are therefore collected as JSON lines in a
    second file, `NAME.part`, and converted to Parquet by `close`. After a crash, a resumed run
    appends to `NAME.part`.

    Attributes:
        path: Path of the file.
        source: Name of the column that identifies the recording.
    """

    source = "source"

    def __init__(
        self,
        path: Path,
        columns: Mapping[str, ColumnKind],
        outcome_columns: Sequence[str] = (),
        *,
        resume: bool,
    ) -> None:
        """Open the file.

        Args:
            path: Path of the file, whose suffix selects the format: .jsonl, .csv or .parquet.
            columns: Names and types of the columns.
            outcome_columns: Names of the columns that `earlier` returns for existing rows.
            resume: Whether to keep existing rows and append new rows.

        Raises:
            UsageError: If the suffix is unknown, or an optional package is not installed.
            InputError: If the file cannot be opened, or was not written by this command.
        """
        self.path = path
        self._columns = columns
        self._suffix = path.suffix.lower()
        if self._suffix not in SUFFIXES:
            raise UsageError(f"'{path}' has no known suffix: end it in .jsonl, .csv or .parquet.")
        self._is_parquet = self._suffix == ".parquet"
        if self._is_parquet:
            _arrow()
        self._growing = path.with_name(f"{path.name}.part") if self._is_parquet else path
        self._judged = (self.source, *outcome_columns)
        self._done: dict[str, list[Row]] = {}
        try:
            for row in self._held() if resume else ():
                if not set(row) <= columns.keys():
                    raise ValueError  # rows of another command, which have no meaning here
                rows = self._done.setdefault(row[self.source], [])
                rows.append({name: row.get(name) for name in self._judged})
            mode = "ab" if self._done else "wb"
            # Unbuffered, so that the rows of one recording are written together or not at all.
            self._file = io.FileIO(self._growing, mode, opener=reader_there)
        except (OSError, ValueError, KeyError, TypeError) as error:
            reason = (
                getattr(error, "strerror", None) or "the file does not contain rows of this command"
            )
            what = "continued" if resume else "written"
            raise InputError(f"'{path}' cannot be {what}: {reason}.") from error
        if self._suffix == ".csv" and not self._done:
            self._file.write(self._table([self._columns]))

    def holds(self, source: str) -> bool:
        """Return whether the file had rows of a recording when the file was opened."""
        return bool(self.earlier(source))

    def earlier(self, source: str) -> list[Row]:
        """Return the rows of a recording that the file had when it was opened; [] without rows.

        Each row has at least the columns named in `outcome_columns`.
        """
        written = _cell(source) if self._suffix == ".csv" else source
        return self._done.get(str(written)) or (
            self._done.get(_utf8(source), []) if self._is_parquet else []
        )

    def _held(self) -> Iterator[Row]:
        """Yield the rows that the file has when it is opened, with at least `outcome_columns`.

        An incomplete last line is removed from the file.
        """
        if self._is_parquet and self.path.exists() and self.path.stat().st_size:
            arrow = _arrow()
            try:
                table = arrow.parquet.read_table(self.path, columns=list(self._judged))
            except arrow.ArrowException as error:
                raise ValueError from error
            yield from table.to_pylist()
        if not self._growing.exists():
            return
        with open_regular(self._growing) as file:
            whole = file.read()
        # A process that was killed may have written half a line.
        kept = whole[: whole.rfind(b"\n") + 1]
        if len(kept) < len(whole):
            self._growing.write_bytes(kept)
        lines = kept.decode("utf-8").splitlines()
        if self._suffix == ".csv":
            # An empty cell is read as None.
            yield from (
                {name: cell or None for name, cell in row.items()} for row in csv.DictReader(lines)
            )
        else:
            yield from (json.loads(line) for line in lines if line)

    def write(self, rows: Sequence[Row]) -> None:
        """Write all rows of one recording together.

        Raises:
            InputError: If the file cannot be written, for example on a full disk.
        """
        if self._suffix == ".csv":
            content = self._table([_cell(row.get(c)) for c in self._columns] for row in rows)
        else:
            content = "".join(f"{json.dumps(row, allow_nan=False)}\n" for row in rows).encode()
        try:
            self._file.write(content)
        except OSError as error:
            raise InputError(f"'{self.path}' cannot be written: {error.strerror}.") from error

    @staticmethod
    def _table(lines: Any) -> bytes:
        text = io.StringIO(newline="")
        csv.writer(text).writerows(lines)
        return text.getvalue().encode("utf-8", "backslashreplace")

    def close(self) -> None:
        """Close the file; for Parquet, convert the collected rows first.

        Raises:
            InputError: If the file cannot be written.
        """
        self._file.close()
        if not self._is_parquet:
            return
        try:
            self._make_parquet()
        except OSError as error:
            raise InputError(
                f"'{self.path}' cannot be written: {error.strerror or error}. The rows are in "
                f"'{self._growing}': the same command with --resume continues from there."
            ) from error

    def _make_parquet(self) -> None:
        """Merge the rows of the existing file and the new rows into one Parquet file."""
        arrow = _arrow()
        schema = arrow.schema([(name, _type(kind)) for name, kind in self._columns.items()])
        whole = self.path.with_name(f"{self.path.name}.tmp")
        with arrow.parquet.ParquetWriter(whole, schema) as writer:
            if self._done and self.path.exists() and self.path.stat().st_size:
                for batch in arrow.parquet.ParquetFile(self.path).iter_batches():
                    writer.write_batch(batch)
            with self._growing.open("rb") as lines:
                for rows in _blocks(lines):
                    columns = [
                        [_clean(row.get(name), kind) for row in rows]
                        for name, kind in self._columns.items()
                    ]
                    arrays = [
                        arrow.array(column, field.type)
                        for column, field in zip(columns, schema, strict=True)
                    ]
                    writer.write_table(arrow.Table.from_arrays(arrays, schema=schema))
        os.replace(whole, self.path)
        self._growing.unlink()


def _blocks(lines: BinaryIO) -> Iterator[list[Row]]:
    block: list[Row] = []
    for line in lines:
        block.append(json.loads(line))
        if len(block) == _ROWS_AT_ONCE:
            yield block
            block = []
    if block:
        yield block


def _arrow() -> Any:
    """Import pyarrow, which reads and writes Parquet.

    Raises:
        UsageError: If the package is not installed.
    """
    try:
        import pyarrow.parquet
    except ImportError:
        raise UsageError(
            "Writing Parquet needs an extra: pip install 'tftool-tf2[parquet]', or write .jsonl "
            "or .csv."
        ) from None
    return pyarrow


def _type(kind: ColumnKind) -> "pyarrow.DataType":
    arrow = _arrow()
    edge = arrow.struct([("parent", arrow.string()), ("child", arrow.string())])
    return {
        ColumnKind.TEXT: arrow.string(),
        ColumnKind.TEXTS: arrow.list_(arrow.string()),
        ColumnKind.EDGES: arrow.list_(edge),
        ColumnKind.INTEGER: arrow.int64(),
        ColumnKind.NUMBER: arrow.float64(),
    }[kind]


def _clean(value: Any, kind: ColumnKind) -> Any:
    """Return the value of a Parquet cell, with invalid UTF-8 replaced by escape sequences."""
    if value is None or kind in (ColumnKind.INTEGER, ColumnKind.NUMBER):
        return value
    if kind is ColumnKind.EDGES:
        return [{"parent": _utf8(parent), "child": _utf8(child)} for parent, child in value]
    return [_utf8(text) for text in value] if kind is ColumnKind.TEXTS else _utf8(value)


def _utf8(text: str) -> str:
    return text.encode("utf-8", "backslashreplace").decode()


def _cell(value: object) -> object:
    """Convert a value to a cell of a CSV file."""
    if isinstance(value, list):
        return json.dumps(value) if value else ""
    if isinstance(value, str):
        # A spreadsheet must not read a name as a formula, nor a line break as a new row.
        text = visible(value)
        return f"'{text}" if text[:1] in ("=", "+", "-", "@") else text
    return "" if value is None else value
