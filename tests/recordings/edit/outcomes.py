"""Contents of edited recordings."""

from mcap.reader import SeekingReader
from mcap.stream_reader import StreamReader
from rosbags.highlevel import AnyReader

from tests.recordings.writers import content
from tftool.recordings.recording import open_recording

SENT = content()
START = SENT[0].log_time
NEW_POSE = (1.0, 2.0, 3.0, 0.0, 0.0, 1.0, 0.0)


def messages(path):
    """Return log time and payload of every message, by topic."""
    with open_recording(path) as recording:
        assert recording.damage == ()
        return {
            topic.name: [(raw.log_time, raw.payload) for raw in recording.raw_messages(topic.name)]
            for topic in recording.topics
        }


def edges(path):
    """Return stamp and seven numbers of every transform, by (parent, child)."""
    with open_recording(path) as recording:
        return {
            (edge.parent, edge.child): [
                (stamp, *place, *turn)
                for stamp, place, turn in zip(
                    edge.stamps.tolist(),
                    edge.translations.tolist(),
                    edge.rotations.tolist(),
                    strict=True,
                )
            ]
            for edge in recording.edges
        }


def strictly_read(path):
    """Return the number of messages that another reader finds that checks all CRCs and indexes."""
    files = sorted(path.iterdir()) if path.is_dir() else [path]
    for file in files:
        if file.suffix == ".mcap":
            with file.open("rb") as stream:
                list(StreamReader(stream, validate_crcs=True).records)
            with file.open("rb") as stream:
                reader = SeekingReader(stream, validate_crcs=True)
                found = sum(1 for _ in reader.iter_messages())
                assert reader.get_summary().statistics.message_count == found
    if path.suffix in (".mcap", ".db3"):
        return None
    with AnyReader([path]) as reader:
        return sum(1 for _ in reader.messages())
