"""What the native scan offers; each function says what it is the twin of."""

from collections.abc import Callable

INTERFACE: int

class Pairs:
    """Pairs of frame names as they were sent, by number, in the order they first came up.

    All of them come out of messages of one layout.
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
        """`rows.walk` and `Template.cut` of many messages, transform by transform into columns.

        Other threads of Python run meanwhile; the arrays must not change.

        Args:
            buffer: The bytes.
            starts: Where each message begins in it, int64.
            lengths: How many bytes it has, int64.
            numbers: What to call it, int32.
            is_cdr: How they are written.
            ask: Is called with a pair, a message, and a place in that, at the first transform of
                a pair and where there is no room for another one: leads the pair to an edge, and
                aims that at columns with room.

        Returns:
            How many transforms of pairs that lead nowhere were left out; the places of the
            messages that are odd, uint32: those are for `walk`, and nothing of them is taken.

        Raises:
            ValueError: If a message lies outside of the buffer, those before were written the other
                way, or no room was made.
            RuntimeError: If another thread does the same right now.
        """

    def names(self, number: int, /) -> tuple[bytes, bytes]:
        """Parent and child of a pair, in the message's bytes."""

    def lead(self, pair: int, edge: int, is_slashed: bool, /) -> None:
        """Say to which edge a pair's transforms go; to -1, they are left out.

        Args:
            pair: Its number.
            edge: One that has been aimed already.
            is_slashed: Whether its names have a slash that those of the edge do not have.
        """

    def aim(self, edge: int, records: object, messages: object, state: object, /) -> None:
        """Give the columns into which an edge's transforms are to be written.

        Args:
            edge: Its number; those that come up are numbered from 0 on.
            records: int64 of shape (room, 8).
            messages: int32 of shape (room,).
            state: What `columns.Growing` has as such.

        Raises:
            ValueError: If it is none of them.
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
    """What sqlite gives of rosbag2's table `messages`, of some topics.

    Args:
        pages: Pages of the file, leaf pages of the table among them.
        places: The byte of `pages` at which each of those begins, int64.
        streams: A topic and what to call it, in the order of topics, int64 of shape (n, 2).
        senders: Where to write what each row's topic is called, int32.
        times: Its timestamp, int64, and likewise the next two.
        starts: The byte of the pages at which its data begins. Where it goes on on other pages,
            that at which its cell begins, n, as -1 - n.
        lengths: How many bytes its data has.
        size: Bytes of a page.
        usable: Bytes of it that sqlite uses.
        last: The id of the row before the first one.

    Returns:
        How many rows were written, and the id of the last one that was looked at; None, with
        anything in the arrays, where there is one that is no such row, or not newer than the one
        before, or more than there is room for.
    """
