"""What the native kernel offers; each function says what it is the twin of."""

from tftool.buffer.sample import TransformStamped

INTERFACE: int

class Fields:
    """The fields of a link, laid out so that the kernel can read them: see `history`."""

class Door:
    """The methods of a buffer that are called most; each is the twin of the one in `Buffer`.

    They answer what is plain, and call `_plain_` and their name for all else: a refusal, a link
    with samples of several parents, an argument given by its name.
    """

    def set_transform(self, transform: TransformStamped, authority: str = "") -> bool:
        """`Buffer.set_transform` of a sample of a known link that has room."""

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: int = 0
    ) -> TransformStamped:
        """`Buffer.lookup_transform` by a path, cached or not."""

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: int,
        source_frame: str,
        source_time: int,
        fixed_frame: str,
    ) -> TransformStamped:
        """`Buffer.lookup_transform_full` by two paths."""

    def can_transform(self, target_frame: str, source_frame: str, time: int = 0) -> bool:
        """`Buffer.can_transform` by a path; it says no in plain Python."""

def solve(
    up: tuple[object, ...],
    down: tuple[object, ...],
    times: object,
    translations: object,
    rotations: object,
    valid: object,
    /,
) -> int | None:
    """Poses of a path at many moments; how many rows have none. None if a link is not plain."""
