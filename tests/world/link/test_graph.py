"""Tests of the graph of nodes, topics and services, from announcements only."""

from tftool.world.link import graph
from tftool.world.link.graph import Graph, GraphEntity, Process, Role
from tftool.world.link.link_context import LinkContext
from tftool.world.link.link_options import Options


def talker(session="ab", number=1, name="tf"):
    gid = f"{session}{number}{name}".encode()
    return GraphEntity("publisher", 0, session, f"node{number}", name, "t/msg/T", gid=gid)


def enter(there, *found):
    for one in found:
        there.add(str(one), one)


def test_ones_own_entries_are_passed_over():
    there = Graph("me", 0)

    assert there.add("key", talker("me")) is None
    assert there.is_empty
    assert there.remove("key") is None


def test_an_entry_counts_once_and_goes_when_it_is_withdrawn():
    there = Graph("me", 0)

    assert there.add("key", talker()) == talker()
    assert there.add("key", talker()) is None
    assert there.entities("publisher", name="tf") == [talker()]
    assert there.entities("subscription") == []
    assert there.remove("key") == talker()
    assert there.is_empty


def test_other_domains_are_heard_of_and_kept_out():
    there = Graph("me", 0)
    enter(there, GraphEntity("node", 5, "ab", "far"))

    assert there.foreign_domains == {5}
    assert there.is_empty


def test_a_flood_of_entries_is_kept_within_bounds(monkeypatch):
    monkeypatch.setattr(graph, "MOST", 10)
    there = Graph("me", 0)
    enter(there, *(talker(number=number) for number in range(100)))

    assert len(there.entities()) == 10


def test_so_many_other_domains_are_remembered_and_no_more(monkeypatch):
    monkeypatch.setattr(graph, "MOST_DOMAINS", 3)
    there = Graph("me", 0)
    enter(there, *(GraphEntity("node", number, "ab", "far") for number in range(1, 10)))

    assert there.foreign_domains == {1, 2, 3}


class Nothing:
    """Middleware that transports nothing."""

    def __init__(self, graph, unanswering=()):
        self.graph = graph
        self.unanswering = unanswering


def test_a_message_that_names_no_sender_is_the_only_ones_that_publishes_there():
    there = Graph("me", 0)
    enter(there, *(talker(number=n, name=topic) for n, topic in enumerate(("tf", "tf_static"))))
    context = LinkContext(Options(), Nothing(there))

    assert context.authority(b"", "tf") == "node0"
    assert context.authority(b"", "tf_static") == "node1"
    assert context.authority(b"", "other") == "publisher_unknown"
    assert context.authority(b"\x01\x02\x03\x04\x05", "other") == "publisher_01020304"


def test_processes_stand_in_the_order_in_which_they_joined():
    there = Graph("me", 0)
    late = Process(0, "aa", 20, 1, Role.GUEST, "echo")
    early = Process(0, "bb", 10, 2, Role.HOST, "demo")
    enter(there, late, early)

    assert there.processes() == [early, late]
    assert there.process("bb") == early
    assert there.process("cc") is None
    assert graph.hosts(there.processes()) == [early]


def test_a_publisher_is_known_by_its_gid_or_by_being_the_only_one_it_can_be():
    there = Graph("me", 0)
    ours, ros = talker("aa", 1), talker("bb", 2)
    enter(there, Process(0, "aa", 1, 1, Role.HOST, "demo"), ours, ros)

    assert there.publisher(ours.gid, "tf").node == "node1"
    assert there.publisher(bytes(range(16)), "tf").node == "node2"
    enter(there, talker("cc", 3))
    assert there.publisher(bytes(range(16)), "tf") is None


def test_processes_that_do_not_answer_are_named_with_what_to_do():
    there = Graph("me", 0)

    assert LinkContext(Options(), Nothing(there)).unanswering == ""
    assert LinkContext(Options(), Nothing(there, (7,))).unanswering == (
        "Process 7 of this machine does not answer (stopped with Ctrl-Z?): resume it "
        "(fg, or kill -CONT 7), or end it (kill -9 7)."
    )
    several = LinkContext(Options(), Nothing(there, (7, 8))).unanswering
    assert several.startswith("Processes 7, 8 of this machine do not answer")
