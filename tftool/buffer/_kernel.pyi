"""Native kernel; each function names its twin in Python."""

from tftool.buffer.sample import TransformStamped

INTERFACE: int

class Fields:
    """Fields of a link, in memory that the kernel can read: see `history`."""

class Door:
    """Methods of a buffer that are called most; each has a twin in `Buffer`.

    They handle the usual cases, and call the twin (`_plain_` and the method's name) for all others:
    a refusal, a link with samples of several parents, an argument given by name.
    """

    def set_transform(self, transform: TransformStamped, authority: str = "") -> bool:
        """Insert a sample of a known link: `Buffer.set_transform`."""

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: int = 0
    ) -> TransformStamped:
        """Look up by a path, cached or not: `Buffer.lookup_transform`."""

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: int,
        source_frame: str,
        source_time: int,
        fixed_frame: str,
    ) -> TransformStamped:
        """Look up by two paths: `Buffer.lookup_transform_full`."""

    def can_transform(self, target_frame: str, source_frame: str, time: int = 0) -> bool:
        """Whether a path has data: `Buffer.can_transform`. The twin answers if it has none."""

def solve(
    up: tuple[object, ...],
    down: tuple[object, ...],
    times: object,
    translations: object,
    rotations: object,
    valid: object,
    /,
) -> int | None:
    """Write the poses of a path at many times; return the number of rows without data.

    None if the kernel cannot use a link.
    """
