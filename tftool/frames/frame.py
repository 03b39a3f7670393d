"""One named frame, and what it hangs by."""

from tftool.frames.links import NO_PARENT, Constant, Link

_NONE = Constant()


class Frame:
    """One named frame.

    Attributes:
        name: Its name.
        number: Its place in the order of first registration.
        link: What it hangs by; None if nobody ever sent it.
        history: The same, while that moves.
        authority: Who sent its newest sample; None if nobody ever did.
        parent_name: The name of the parent it was last sent with.
        parent_number: That parent's number.
    """

    __slots__ = ("authority", "history", "link", "name", "number", "parent_name", "parent_number")

    def __init__(self, name: str, number: int) -> None:
        self.name = name
        self.number = number
        self.link: Link | None = None
        self.history: Link = _NONE
        self.authority: str | None = None
        self.parent_name: str = ""
        self.parent_number: int = NO_PARENT
