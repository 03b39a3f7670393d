"""What the native scan offers; each function says what it is the twin of."""

INTERFACE: int

class Pairs:
    """Pairs of frame names as they were sent, by number, in the order they first came up."""

    def scan(
        self, buffer: object, starts: object, lengths: object, is_cdr: bool, /
    ) -> tuple[bytearray, bytearray, bytearray]:
        """`rows.walk` of many messages, which begin at `starts` and have `lengths`, both int64.

        Returns:
            For each transform, as four uint32, its pair, its message, and where its stamp and its
            numbers begin in the buffer; of each pair, as two uint32, how many it has, and which
            is the first; which messages are odd, uint32: those are for `walk`, and nothing of
            them is in the first two.

        Other threads of Python run meanwhile; the buffer must not change.

        Raises:
            ValueError: If a message lies outside of the buffer, or that has more than 4 GiB.
            RuntimeError: If another thread does the same right now.
        """

    def names(self, number: int, /) -> tuple[bytes, bytes]:
        """Parent and child of a pair, in the message's bytes."""

def fill(
    buffer: object,
    found: object,
    numbers: object,
    targets: list[tuple[object, object] | int | None],
    /,
) -> None:
    """`Template.cut` of what `Pairs.scan` found.

    Other threads of Python run meanwhile; nothing of it must change.

    Args:
        buffer: The same as there.
        found: Its first result.
        numbers: What to call each message, int32.
        targets: For each pair its records and their messages, int64 of shape (n, 8) and int32 of
            shape (n,), to be written; the number of an earlier pair to write there; None to
            leave it out.

    Raises:
        ValueError: If a target is too short.
    """

def indexed(
    chunk: object,
    index: object,
    starts: object,
    lengths: object,
    log_times: object,
    channel: int,
    /,
) -> bool:
    """Where the messages that an MCAP chunk's message index tells lie, into three int64 arrays.

    Returns:
        False, with anything in the arrays, where it points at what is no message of the channel.
    """

def pointed(
    chunk: object,
    index: object,
    starts: object,
    lengths: object,
    log_times: object,
    connection: int,
    code: int,
    owner: int,
    /,
) -> bool:
    """Where the messages that a ROS 1 chunk's index tells lie, into three int64 arrays.

    Args:
        chunk: Its records.
        index: Of each message seconds, nanoseconds, and where its record begins, uint32.
        starts: Where to write where each message begins.
        lengths: Likewise how long it is.
        log_times: Likewise when it was received.
        connection: Whose messages they are.
        code: The byte of the first one's header that says what record it is.
        owner: The byte of it at which the number of its connection begins.

    Returns:
        False, with anything in the arrays, where it points at what is no message of the
        connection, or one whose header is laid out in another way.
    """

def rows(
    pages: object,
    ids: object,
    topics: object,
    times: object,
    starts: object,
    lengths: object,
    size: int,
    usable: int,
    /,
) -> int:
    """What sqlite gives of rosbag2's table `messages`: id, topic, timestamp, and data.

    Args:
        pages: Leaf pages of the table, one behind the other.
        ids: Where to write each row's id, int64, and likewise the next four.
        topics: Its topic.
        times: Its timestamp.
        starts: The byte of the pages at which its data begins. Where it goes on on other pages,
            that at which its cell begins, n, as -1 - n.
        lengths: How many bytes its data has.
        size: Bytes of a page.
        usable: Bytes of it that sqlite uses.

    Returns:
        How many rows; -1, with anything in the arrays, where there is one that is no such row, or
        more than there is room for.
    """
