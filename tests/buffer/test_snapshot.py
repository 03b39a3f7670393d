import pytest
import yaml

from tftool.base.stamps import seconds
from tftool.buffer.buffer import Buffer
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import IDENTITY, Transform


@pytest.fixture
def buffer():
    buffer = Buffer()

    def put(parent, child, at, x, authority="node", static=False):
        sample = TransformStamped(seconds(at), parent, child, Transform((x, 0.0, 0.0)))
        (buffer.set_transform_static if static else buffer.set_transform)(sample, authority)

    for at in (1, 2, 3):
        put("map", "odom", at, float(at))
    put("odom", "base", 1, 10.0)
    put("odom", "base", 2, 20.0)
    put("base", "laser", 0, 0.5, "urdf", static=True)
    put("other", "thing", 7, 1.0)
    return buffer


def test_the_latest_is_the_latest_of_each_chain(buffer):
    snapshot = buffer.snapshot(now=seconds(10))

    # base has data until 2 s, so its pose uses odom's pose at 2 s.
    assert snapshot.frame("laser").root_from_frame.translation.x == 2.0 + 20.0 + 0.5
    assert snapshot.frame("odom").root_from_frame.translation.x == 3.0
    assert snapshot.frame("laser").root == "map"
    assert snapshot.frame("thing").root == "other"


def test_a_moment_is_shown_where_there_is_data(buffer):
    snapshot = buffer.snapshot(now=seconds(10), at=seconds(1.5))

    assert snapshot.frame("laser").root_from_frame.translation.x == 1.5 + 15.0 + 0.5
    thing = snapshot.frame("thing")
    assert thing.transform is None
    assert thing.root_from_frame is None
    assert (thing.parent, thing.root) == ("other", "other")


def test_turns_have_the_sign_they_have_in_a_lookup():
    # Twice 130° is 100° in the other direction: tf2 returns a positive w, but the product has a
    # negative one.
    buffer = Buffer()
    turned = Transform((0.0, 0.0, 0.0), (0.0, 0.0, 0.9063077870366499, 0.42261826174069944))
    for parent, child in (("map", "odom"), ("odom", "base")):
        buffer.set_transform(TransformStamped(seconds(1), parent, child, turned))

    for at in (0, seconds(1)):
        shown = buffer.snapshot(0, at).frame("base").root_from_frame.rotation
        assert shown == pytest.approx((0.0, 0.0, -0.7660444431189780, 0.6427876096865394))
        assert shown == buffer.lookup_transform("map", "base", at).transform.rotation


def test_every_fact_of_a_link_is_told(buffer):
    odom, laser = (buffer.snapshot(now=seconds(10)).frame(name) for name in ("odom", "laser"))

    assert (odom.parent, odom.authority, odom.is_static) == ("map", "node", False)
    assert (odom.samples, odom.rate) == (3, 1.5)
    assert (odom.oldest, odom.newest, odom.buffer_length) == (seconds(1), seconds(3), seconds(2))
    assert odom.age == seconds(7)
    assert odom.transform.translation.x == 3.0
    assert (laser.authority, laser.is_static, laser.samples) == ("urdf", True, 1)
    assert (laser.rate, laser.age, laser.newest) == (10000.0, 0, 0)


def test_roots_children_and_order(buffer):
    snapshot = buffer.snapshot(now=0)

    assert [info.frame for info in snapshot.frames] == buffer.frames()
    assert snapshot.roots() == ("map", "other")
    assert snapshot.children("odom") == ("base",)
    assert snapshot.children("laser") == ()
    assert snapshot.loops() == ()
    assert "laser" in snapshot
    assert "lidar" not in snapshot
    root = snapshot.frame("map")
    assert (root.parent, root.authority, root.samples) == (None, None, 0)
    assert root.transform == root.root_from_frame == IDENTITY
    with pytest.raises(KeyError):
        snapshot.frame("lidar")


def test_a_snapshot_is_of_its_moment(buffer):
    before = buffer.snapshot(now=seconds(10))
    buffer.set_transform(TransformStamped(seconds(9), "x", "odom", Transform()), "node")

    assert before.frame("odom").parent == "map"
    assert before != buffer.snapshot(now=seconds(10))
    assert before == before
    assert hash(before) == hash(before)


def test_after_a_clear_what_moved_hangs_from_nothing(buffer):
    buffer.clear()
    snapshot = buffer.snapshot(now=0)

    assert snapshot.frame("odom").parent is None
    assert snapshot.frame("odom").authority == "node"
    assert snapshot.frame("laser").root == "base"


def test_a_child_shows_the_parent_it_had_at_the_moment(buffer):
    buffer.set_transform(TransformStamped(seconds(3), "map", "base", Transform()), "node")

    assert buffer.snapshot(0, seconds(2.5)).frame("base").parent == "odom"
    assert buffer.snapshot(0, seconds(3)).frame("base").parent == "map"
    assert buffer.snapshot(0).frame("base").parent == "map"


def test_yaml_can_be_read_again(buffer):
    said = yaml.safe_load(buffer.all_frames_as_yaml(seconds(10)))

    assert list(said) == ["odom", "base", "laser", "thing"]
    assert said["odom"]["transform_delay"] == 7.0
    assert said["laser"]["rate"] == 10000.0


def test_dot_has_a_legend_for_each_tree_and_each_cleared_frame(buffer):
    assert buffer.all_frames_as_dot(seconds(10)).count("Recorded at time: 10.000000") == 2
    buffer.clear()
    assert buffer.all_frames_as_dot().count("cluster_legend") == 3


def test_a_sender_without_a_name_is_written_as_none(buffer):
    anonymous = Buffer()
    anonymous.set_transform(TransformStamped(1, "a", "b", Transform()))

    assert "broadcaster: 'no recorded authority'" in anonymous.all_frames_as_yaml()
    assert "Broadcaster: no recorded authority" in anonymous.all_frames_as_dot()


def test_a_child_that_moved_to_another_tree_too_lately_has_no_place_in_it_yet():
    buffer = Buffer()

    def put(parent, child, at):
        sample = TransformStamped(seconds(at), parent, child, Transform((1.0, 0.0, 0.0)))
        buffer.set_transform(sample, "node")

    put("b", "b2", 1)
    put("a", "c", 1)
    put("b2", "c", 2)

    # The new chain has data until 1 s only, and at that time c was a child of a.
    moved = buffer.snapshot(now=0).frame("c")
    assert (moved.parent, moved.root) == ("b2", "b")
    assert moved.root_from_frame is None
    assert not buffer.can_transform("b", "c")
