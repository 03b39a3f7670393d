"""Links (poses of one frame in another) of a pose file, in the convention of the file."""

from array import array
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from decimal import ROUND_HALF_EVEN, Decimal, InvalidOperation
from pathlib import Path
from typing import BinaryIO, Final, NoReturn

from tftool.base.errors import InputError, UsageError
from tftool.base.named_files import open_regular
from tftool.base.stamps import NANOSECONDS, Stamp
from tftool.recordings.poses.pose_options import PoseOptions

MOST_POSES: Final = 10_000_000
"""Maximum number of poses in one file."""

LARGEST_FILE: Final = 1 << 31
"""Maximum size of a file, bytes."""

LONGEST_LINE: Final = 1 << 20
"""Maximum length of a line of text, bytes."""

_LAST: Final = (1 << 31) * NANOSECONDS
_LONGEST_NUMBER: Final = 64


@dataclass(slots=True)
class PoseLink:
    """Poses of one child in its parent, at one or many times.

    Attributes:
        parent: Name of the parent.
        child: Name of the child.
        static: Whether the link has a single pose, valid at all times.
        width: Number of values per pose: 7 (x y z, qx qy qz qw) or 12 (the upper rows of a matrix).
        stamps: Stamp of each pose, nanoseconds.
        numbers: Numbers of all poses, concatenated.
    """

    parent: str
    child: str
    static: bool = False
    width: int = 7
    stamps: "array[int]" = field(default_factory=lambda: array("q"))
    numbers: "array[float]" = field(default_factory=lambda: array("d"))

    def __len__(self) -> int:
        return len(self.stamps)


class PoseFile:
    """A pose file that is being read, with options and counts of unusual rows.

    Attributes:
        path: Path of the file.
        options: Options for reading.
        default: Default names of parent and child.
        oddities: Number of unusual rows, by a phrase such as "rows out of order".
        is_timed: Whether the stamps come from --pose-rate.
    """

    def __init__(self, path: Path, options: PoseOptions, default: tuple[str, str]) -> None:
        """Prepare to read a file.

        Args:
            path: Path of the file.
            options: Options for reading.
            default: Names of parent and child, if the options have none.
        """
        self.path = path
        self.options = options
        self.default = default
        self.oddities: Counter[str] = Counter()
        self.is_timed = False
        self._place = 0

    @property
    def frames(self) -> tuple[str, str]:
        """Names of parent and child from --frames, or else the default names of the format."""
        return self.default if self.options.frames is None else self.options.pair()

    def link(self, width: int = 7) -> PoseLink:
        """Return an empty link between the file's two frames, for poses of `width` numbers each."""
        return PoseLink(*self.frames, width=width)

    def open(self) -> BinaryIO:
        """Open the file.

        Raises:
            InputError: If the file is too large.
            OSError: If the file cannot be opened.
        """
        file = open_regular(self.path)
        if file.seek(0, 2) > LARGEST_FILE:
            file.close()
            raise InputError(f"'{self.path}' has more than {LARGEST_FILE >> 20} MiB: split it.")
        file.seek(0)
        return file

    def lines(self, path: Path | None = None) -> Iterator[str]:
        """Yield every line of the file (or of another file, `path`) without line ends."""
        name = path or self.path
        own = PoseFile(name, self.options, self.default)
        self._place = 0
        with own.open() as file:
            while line := file.readline(LONGEST_LINE + 1):
                self._place += 1
                if len(line) > LONGEST_LINE:
                    self.fail("a line of less than 1 MiB", f"{len(line)} bytes and more", name)
                text = line.decode("utf-8", "backslashreplace")
                yield text.removeprefix("\ufeff").strip() if self._place == 1 else text.strip()

    def rows(self, comments: str = "#", path: Path | None = None) -> Iterator[list[str]]:
        """Yield the words of every line that is neither empty nor a comment."""
        for line in self.lines(path):
            if line and not line.startswith(comments):
                yield line.replace(",", " ").split()

    def fail(self, expected: str, found: str, path: Path | None = None) -> NoReturn:
        """Raise an error about the current line, with the expected and the found text.

        Raises:
            InputError: Always, with the file and the line.
        """
        raise InputError(
            f"'{path or self.path}:{self._place}': expected {expected}, found {found}."
        )

    def floats(self, words: list[str], expected: str) -> list[float]:
        """Parse words as numbers; raise an `InputError` if a word is not a number."""
        try:
            return [float(word) for word in words]
        except ValueError:
            bad = next(word for word in words if not _is_number(word))
            self.fail(expected, f"'{bad[:40]}'")

    def seconds(self, word: str, expected: str, path: Path | None = None) -> Stamp:
        """Convert a stamp from seconds in decimal text to nanoseconds, without rounding errors."""
        whole, _, part = word.partition(".")
        is_short = word.isascii() and len(word) < 24 and len(part) <= 9
        if is_short and whole.isdigit() and (part.isdigit() or not part):
            stamp = int(whole) * NANOSECONDS + int(part.ljust(9, "0"))
            return self._checked(stamp, word, expected, path)
        return self._decimal(word, NANOSECONDS, expected, path)

    def nanoseconds(self, word: str, expected: str) -> Stamp:
        """Parse a stamp in whole nanoseconds."""
        if word.isascii() and word.isdigit() and len(word) < 24:
            return self._checked(int(word), word, expected, None)
        return self._decimal(word, 1, expected, None)

    def _decimal(self, word: str, unit: int, expected: str, path: Path | None) -> Stamp:
        try:
            if len(word) > _LONGEST_NUMBER:
                raise InvalidOperation
            number = Decimal(word)
            if number and not (number.is_finite() and -20 < number.adjusted() < 20):
                raise InvalidOperation
        except (InvalidOperation, ValueError):
            self.fail(expected, f"the stamp '{word[:40]}'", path)
        exact = (number * unit).to_integral_value(ROUND_HALF_EVEN)
        return self._checked(int(exact), word, expected, path)

    def _checked(self, stamp: Stamp, word: str, expected: str, path: Path | None) -> Stamp:
        if not 0 <= stamp < _LAST:
            self.fail(
                expected,
                f"the stamp '{word[:40]}', which is outside of the seconds 0 to "
                f"{_LAST // NANOSECONDS}",
                path,
            )
        return stamp

    def at_rate(self, link: PoseLink) -> None:
        """Compute a link's stamps from --pose-rate; the first stamp is one period after 0.

        Raises:
            InputError: If --pose-rate was not given.
        """
        rate = self.options.pose_rate
        if rate is None:
            raise InputError(f"'{self.path}' has no stamps: give a rate with --pose-rate HZ.")
        self.is_timed = True
        count = len(link.numbers) // link.width
        # In tf2, stamp 0 means the latest, so the first pose must not have it.
        link.stamps = array("q", (round(place * 1e9 / rate) for place in range(1, count + 1)))

    def check_count(self, link: PoseLink) -> None:
        """Raise an error if a link has more poses than the limit.

        Raises:
            InputError: If there are more than `MOST_POSES` poses.
        """
        if len(link.numbers) > MOST_POSES * link.width:
            raise InputError(f"'{self.path}' has more than {MOST_POSES:,} poses: split it.")

    def name(self, word: str) -> str:
        """Check that a word of the file is a valid frame name, and return the word.

        Raises:
            InputError: If the name is empty, too long, or contains a zero character.
        """
        if not 0 < len(word.encode()) <= 4096 or "\0" in word:
            raise InputError(f"'{self.path}' has an invalid frame name: '{word[:40]}'.")
        return word

    def renamed(self, what: str, links: list[PoseLink]) -> list[PoseLink]:
        """Return the links; if --frames is given, rename the frames of the only link.

        Args:
            what: Plural noun for the links in error messages: "pairs", "links".
            links: Links of the file.

        Raises:
            UsageError: If --frames is given and the file has several links.
        """
        if self.options.frames is not None:
            if len(links) > 1:
                raise UsageError(
                    f"'{self.path}' has {len(links)} {what} with different names, so --frames "
                    "is not allowed: leave out --frames."
                )
            for link in links:
                link.parent, link.child = self.frames
        return links


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
