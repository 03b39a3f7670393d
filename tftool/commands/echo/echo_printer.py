"""Printing of the answers of `tftool echo` to stdout."""

import json
import sys
from dataclasses import dataclass

from tftool.base.errors import TransformException
from tftool.base.stamps import Stamp
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.drawing import echo_view as view


@dataclass(frozen=True, slots=True)
class Printer:
    """Printer of answers to stdout."""

    precision: int = 3
    with_distance: bool = False
    for_programs: bool = False

    def found(self, now: Stamp, found: TransformStamped) -> None:
        """Print an answer."""
        if self.for_programs:
            self._line(view.as_object(found, with_distance=self.with_distance))
        elif sys.stdout.isatty():
            from tftool.commands.shared.printer import write

            write(
                view.painted(found, precision=self.precision, with_distance=self.with_distance),
                end="",
            )
            sys.stdout.flush()
        else:
            self._write(
                view.block(found, precision=self.precision, with_distance=self.with_distance)
            )

    def failed(self, now: Stamp, refusal: TransformException, buffer: Buffer) -> None:
        """Print an error."""
        if self.for_programs:
            self._line(view.failure_as_object(now, refusal))
        else:
            self._write(view.failure(now, refusal, buffer.all_frames_as_string()))

    def aged(self, now: Stamp) -> None:
        """Do nothing: printed answers stay."""

    def _line(self, what: object) -> None:
        self._write(json.dumps(what, allow_nan=False) + "\n")

    def _write(self, text: str) -> None:
        sys.stdout.write(text)
        sys.stdout.flush()
