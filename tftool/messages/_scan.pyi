"""Native scan of recorded messages; each function names its twin in Python."""

from collections.abc import Callable

INTERFACE: int

class Pairs:
    """Table of pairs of frame names, numbered in the order in which they first occur.

    All messages of one table have the same layout.
    """

    def take(
        self,
        buffer: object,
        starts: object,
        lengths: object,
        numbers: object,
        is_cdr: bool,
        ask: Callable[[int, int, int], None],
        /,
    ) -> tuple[int, bytes]:
        """Write many messages' transforms into columns: `transform_rows.walk`, `Template.cut`.

        Other Python threads run meanwhile; the arrays must not change.

        Args:
            buffer: Bytes that contain the messages.
            starts: Offset of each message in the buffer, int64.
            lengths: Bytes of each message, int64.
            numbers: Number of each message, as written into the columns, int32.
            is_cdr: Whether the layout is CDR, else ROS 1's.
            ask: Function called with a pair, a message number and the transform's index in that
                message, at the first transform of a pair and when its columns are full. It must
                call `lead` for the pair, and `aim` for the edge with larger columns.

        Returns:
            The number of transforms dropped because their pair has no edge, and the indices of the
            messages that only `walk` can judge, uint32. No transform of these is written.

        Raises:
            ValueError: If a message is outside of the buffer, the table holds pairs of the other
                layout, or `ask` made no room.
            RuntimeError: If another thread is scanning with this table.
        """

    def names(self, number: int, /) -> tuple[bytes, bytes]:
        """Return parent and child of a pair, as bytes of the message."""

    def lead(self, pair: int, edge: int, is_slashed: bool, /) -> None:
        """Set the edge of a pair's transforms; -1 drops them.

        Args:
            pair: Number of the pair.
            edge: Number of an edge with columns, set by `aim`.
            is_slashed: Whether a name of the pair has a leading slash that the edge's name lacks.
        """

    def aim(self, edge: int, records: object, messages: object, state: object, /) -> None:
        """Set the columns of an edge's transforms.

        Args:
            edge: Number of the edge; a new edge gets the next number, from 0.
            records: Samples, int64, shape (room, 8).
            messages: Message number of each sample, int32, shape (room,).
            state: As `columns.Growing.state`.

        Raises:
            ValueError: If there is no such edge, or the state is too short.
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
    """Write offset, length and log time of each message in an MCAP message index to int64 arrays.

    Returns:
        False, with undefined contents of the arrays, if an entry does not point at a message of
        the channel.
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
    """Write offset, length and time of each message in a ROS 1 chunk's index to int64 arrays.

    Args:
        chunk: Records of the chunk.
        index: For each message seconds, nanoseconds and the offset of its record, uint32.
        starts: Output: offset of each message.
        lengths: Output: bytes of each message.
        log_times: Output: time of reception, nanoseconds.
        connection: Number of the connection.
        code: Offset of the op code in the first message's header.
        owner: Offset of the connection's number in that header.

    Returns:
        False, with undefined contents of the arrays, if an entry does not point at a message of
        the connection, or a header differs in layout from the first.
    """

def rows(
    pages: object,
    places: object,
    streams: object,
    senders: object,
    times: object,
    starts: object,
    lengths: object,
    size: int,
    usable: int,
    last: int,
    /,
) -> tuple[int, int] | None:
    """Read rows of some topics from leaf pages of rosbag2's table `messages`.

    Args:
        pages: Pages of the file, including leaf pages of the table.
        places: Offset in `pages` of each leaf page, int64.
        streams: Topic and stream number, in the order of topics, int64, shape (n, 2).
        senders: Output: stream number of each row, int32.
        times: Output: timestamp, int64.
        starts: Output: offset of the data in `pages`, int64. If the data continues on overflow
            pages, -1 - n with the offset n of the row's cell.
        lengths: Output: bytes of the data, int64.
        size: Bytes of a page.
        usable: Bytes of a page that sqlite uses.
        last: Id of the row before the first page.

    Returns:
        The number of written rows and the id of the last row read. None, with undefined contents of
        the arrays, if a row has another form or a smaller id than the one before, or the arrays
        are too short.
    """
