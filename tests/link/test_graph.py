"""Who is there, from tokens alone."""

from tftool.link import graph, keys
from tftool.link.graph import Graph, Process, Role, parse_process
from tftool.link.keys import Entity
from tftool.link.membership import Membership, Options


def talker(session="ab", number=1, name="tf"):
    return Entity(0, session, number, number, "MP", f"node{number}", name, "t/msg/T", "h", "q")


def test_a_process_comes_back_from_its_token_and_names_are_made_plain():
    process = Process(3, "ab12", 1_700_000_000_000_000_000, 42, Role.HOST, "demo")

    assert parse_process(process.token()) == process
    assert parse_process(process.token().replace("/host/", "/ghost/")) is None
    assert parse_process("@tftool/3/ab12") is None
    odd = Process(0, "ab", 1, 2, Role.SOURCE, "de mo/../x")
    assert parse_process(odd.token()).command == "de_mo____x"


def test_ones_own_tokens_and_what_is_no_token_are_passed_over():
    there = Graph("me", 0)

    assert there.add(talker("me").token()) is None
    assert there.add("@ros2_lv/nonsense") is None
    assert there.is_empty
    assert there.remove("@ros2_lv/nonsense") is None


def test_a_token_counts_once_and_goes_when_it_is_withdrawn():
    there = Graph("me", 0)
    token = talker().token()

    assert there.add(token) == talker()
    assert there.add(token) is None
    assert there.entities("MP", name="tf") == [talker()]
    assert there.entities("MS") == []
    assert there.remove(token) == talker()
    assert there.is_empty


def test_other_domains_are_heard_of_and_kept_out():
    there = Graph("me", 0)
    there.add(Entity(5, "ab", 0, 0, "NN", "far").token())

    assert there.foreign_domains == {5}
    assert there.is_empty


def test_a_flood_of_tokens_is_kept_within_bounds(monkeypatch):
    monkeypatch.setattr(graph, "MOST", 10)
    there = Graph("me", 0)
    for number in range(100):
        there.add(talker(number=number).token())

    assert len(there.entities()) == 10


def test_so_many_other_domains_are_remembered_and_no_more(monkeypatch):
    monkeypatch.setattr(graph, "MOST_DOMAINS", 3)
    there = Graph("me", 0)
    for number in range(1, 10):
        there.add(Entity(number, "ab", 0, 0, "NN", "far").token())

    assert there.foreign_domains == {1, 2, 3}


def test_a_message_that_names_no_sender_is_the_only_ones_that_publishes_there():
    there = Graph("me", 0)
    for number, topic in enumerate(("tf", "tf_static")):
        there.add(talker(number=number, name=topic).token())
    membership = Membership(Options(), None, there)
    nobody = bytes(16)

    assert membership.authority(nobody, "tf") == "node0"
    assert membership.authority(nobody, "tf_static") == "node1"


def test_processes_stand_in_the_order_in_which_they_joined():
    there = Graph("me", 0)
    late = Process(0, "aa", 20, 1, Role.GUEST, "echo")
    early = Process(0, "bb", 10, 2, Role.HOST, "demo")
    for one in (late, early):
        there.add(one.token())

    assert there.processes() == [early, late]
    assert there.process("bb") == early
    assert there.process("cc") is None
    assert graph.hosts(there.processes()) == [early]


def test_a_publisher_is_known_by_its_gid_or_by_being_the_only_one_it_can_be():
    there = Graph("me", 0)
    ours, ros = talker("aa", 1), talker("bb", 2)
    there.add(Process(0, "aa", 1, 1, Role.HOST, "demo").token())
    there.add(ours.token())
    there.add(ros.token())

    assert there.publisher(keys.gid_of(ours.token()), "tf").node == "node1"
    assert there.publisher(bytes(range(16)), "tf").node == "node2"
    there.add(talker("cc", 3).token())
    assert there.publisher(bytes(range(16)), "tf") is None
