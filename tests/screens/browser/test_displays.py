"""Tests of points, paths, clouds, scans and markers, in a file and from a server."""

import asyncio
import importlib.util
import shutil
import struct
import threading
import urllib.request
from types import SimpleNamespace

import numpy as np
import pytest

import tftool
from tests.patience import PATIENCE
from tftool.app.main import main
from tftool.base.stamps import NANOSECONDS, seconds
from tftool.buffer.sample import TransformStamped
from tftool.geometry.rigid import Transform
from tftool.messages.classes import INTERFACES
from tftool.messages.turtle_messages import PointStamped, point_stamped
from tftool.screens.browser.displays import cloud, markers, path, point, scan
from tftool.screens.browser.displays.shapes import Arrival
from tftool.screens.browser.drawn_messages import Limits, LiveDisplays, recorded_tracks
from tftool.world.clock import SimClock
from tftool.world.endpoints import PUBLISHER, SUBSCRIPTION, Endpoint, Quality
from tftool.world.world import World

EPOCH = 1_700_000_000 * NANOSECONDS
CLASSES = SimpleNamespace(new_message=lambda name: INTERFACES.message(name)())
POINTS = np.array([[1.0, 2.0, 3.0], [np.nan, 0.0, 0.0], [-1.0, 0.5, 0.25]])


def stamped(message, at=0.0, frame="sensor"):
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(
        EPOCH + seconds(at), NANOSECONDS
    )
    message.header.frame_id = frame
    return message


def cloud_of(recording, points, at=0.0, frame="sensor"):
    """Add a cloud with other fields before, between and behind x, y and z."""
    message = stamped(recording.new_message("sensor_msgs/msg/PointCloud2"), at, frame)
    message.height, message.width = 1, len(points)
    message.point_step = 24
    message.row_step = 24 * len(points)
    for name, offset in (("i", 0), ("x", 4), ("y", 12), ("z", 16)):
        one = recording.new_message("sensor_msgs/msg/PointField")
        one.name, one.offset, one.datatype, one.count = name, offset, 7, 1
        message.fields.append(one)
    message.data = b"".join(struct.pack("<ffxxxxffxxxx", 9.0, *point) for point in points)
    return message


def scan_of(recording, ranges, at=0.0):
    message = stamped(recording.new_message("sensor_msgs/msg/LaserScan"), at)
    message.angle_min, message.angle_increment = 0.0, np.pi / 2
    message.range_min, message.range_max = 0.5, 10.0
    message.ranges = ranges
    return message


def path_of(recording, places, at=0.0, frame="world"):
    message = stamped(recording.new_message("nav_msgs/msg/Path"), at, frame)
    for x, y in places:
        pose = recording.new_message("geometry_msgs/msg/PoseStamped")
        pose.pose.position.x, pose.pose.position.y = float(x), float(y)
        message.poses.append(pose)
    return message


def point_of(recording, x, y, at=0.0, frame="sensor"):
    message = stamped(recording.new_message("geometry_msgs/msg/PointStamped"), at, frame)
    message.point.x, message.point.y = x, y
    return message


def marker_of(recording, number, kind, *, at=0.0, frame="world", x=0.0, color=(1, 0, 0, 1), **more):
    """Add a marker of the namespace `test`, 10 cm large."""
    message = stamped(recording.new_message("visualization_msgs/msg/Marker"), at, frame)
    message.ns, message.id, message.type = "test", number, kind
    message.pose.position.x, message.pose.orientation.w = x, 1.0
    message.scale.x = message.scale.y = message.scale.z = 0.1
    message.color.r, message.color.g, message.color.b, message.color.a = map(float, color)
    for x, y, z in more.pop("points", ()):
        place = recording.new_message("geometry_msgs/msg/Point")
        place.x, place.y, place.z = float(x), float(y), float(z)
        message.points.append(place)
    for name, value in more.items():
        setattr(message, name, value)
    return message


def markers_of(recording, *several):
    message = recording.new_message(markers.TYPES[0])
    message.markers = list(several)
    return message


CUBE, SPHERE, ARROW, LIST, WORDS, DELETE, DELETE_ALL = 1, 2, 0, 7, 9, 2, 3


@pytest.fixture
def run(tmp_path):
    """Record a robot that drives along x at 1 m/s for 4 s, with a sensor one metre above."""
    file = tmp_path / "run.mcap"
    with tftool.write_recording(file) as recording:
        mount = TransformStamped(0, "robot", "sensor", Transform((0.0, 0.0, 1.0)))
        recording.static_transforms([mount], EPOCH)
        for tick in range(41):
            at = tick / 10
            stamp = EPOCH + seconds(at)
            pose = TransformStamped(stamp, "world", "robot", Transform((at, 0.0, 0.0)))
            recording.transforms([pose], stamp)
            if tick % 10 == 0:
                for topic, message in (
                    ("/cloud", cloud_of(recording, POINTS, at)),
                    ("/scan", scan_of(recording, [1.0, 2.0, 99.0, 0.1], at)),
                    ("/plan", path_of(recording, [(0, 0), (1, 0), (1, tick)], at)),
                    ("/goal", point_of(recording, 0.5, -0.5, at)),
                ):
                    recording.message(topic, message, stamp)
    return file


def test_a_cloud_gives_its_finite_points_whatever_lies_between(run, tmp_path):
    with tftool.write_recording(tmp_path / "other.mcap") as recording:
        drawn = cloud.draw(cloud_of(recording, POINTS, 1.5), Arrival(0))
        thinned = cloud.draw(cloud_of(recording, np.zeros((10_001, 3))), Arrival(0, most=1000))
        short = cloud_of(recording, POINTS)
        short.data = short.data[:-1]
        nameless = cloud_of(recording, POINTS)
        nameless.fields.pop()
        with pytest.raises(tftool.InputError, match="fewer bytes"):
            cloud.draw(short, Arrival(0))
        with pytest.raises(tftool.InputError, match="no field 'z'"):
            cloud.draw(nameless, Arrival(0))

    assert drawn.shapes[0].places.tolist() == [[1.0, 2.0, 3.0], [-1.0, 0.5, 0.25]]
    assert (drawn.stamp, drawn.shapes[0].frame) == (EPOCH + seconds(1.5), "sensor")
    assert 500 < thinned.count <= 1000


def test_a_scan_gives_where_its_rays_hit_and_a_path_its_places_in_order(run, tmp_path):
    with tftool.write_recording(tmp_path / "other.mcap") as recording:
        hits = scan.draw(scan_of(recording, [1.0, 2.0, float("inf"), 0.1]), Arrival(0))
        line = path.draw(path_of(recording, [(0, 0), (1, 0), (1, 2)]), Arrival(0))
        ball = point.draw(point_of(recording, 4.0, 5.0), Arrival(0))

    np.testing.assert_allclose(hits.shapes[0].places, [[1, 0, 0], [0, 2, 0]], atol=1e-6)
    assert line.shapes[0].places.tolist() == [[0, 0, 0], [1, 0, 0], [1, 2, 0]]
    assert ball.shapes[0].places.tolist() == [[4, 5, 0]]


def keys(drawn):
    return [shape.key for shape in drawn.shapes]


def test_markers_are_added_replaced_and_deleted_by_namespace_and_number():
    def after(before, *several):
        return markers.draw(markers_of(CLASSES, *several), Arrival(EPOCH, before=before))

    first = after(None, marker_of(CLASSES, 1, CUBE), marker_of(CLASSES, 2, SPHERE, ns="other"))
    moved = after(first, marker_of(CLASSES, 1, CUBE, x=5.0, at=1.0))
    fewer = after(moved, marker_of(CLASSES, 2, CUBE, ns="other", action=DELETE))
    named = after(moved, marker_of(CLASSES, 0, CUBE, action=DELETE_ALL))
    none = after(moved, marker_of(CLASSES, 0, CUBE, ns="", action=DELETE_ALL))

    single = markers.draw(marker_of(CLASSES, 7, CUBE), Arrival(EPOCH, before=first))

    assert keys(first) == ["test/1", "other/2"]
    assert keys(single) == ["test/1", "other/2", "test/7"]
    assert keys(moved) == ["other/2", "test/1"]
    assert moved.shapes[1].places.tolist() == [[5.0, 0.0, 0.0]]
    assert moved.stamp == EPOCH + seconds(1)
    assert (keys(fewer), keys(named), keys(none)) == (["test/1"], ["other/2"], [])


def test_a_marker_with_a_lifetime_ends_and_one_that_cannot_be_drawn_is_named():
    brief = marker_of(CLASSES, 1, CUBE)
    brief.lifetime.sec = 2
    first = markers.draw(markers_of(CLASSES, brief), Arrival(EPOCH))
    later = markers_of(CLASSES, marker_of(CLASSES, 2, CUBE, at=2.0), marker_of(CLASSES, 3, 10))
    second = markers.draw(later, Arrival(EPOCH, before=first))

    assert [shape.until for shape in first.shapes] == [EPOCH + seconds(2)]
    assert keys(second) == ["test/2"]
    assert second.faults == ("markers of type 10 are not drawn",)


def test_of_too_many_markers_and_places_so_many_are_drawn_as_have_room():
    many = [marker_of(CLASSES, number, CUBE) for number in range(2100)]
    drawn = markers.draw(markers_of(CLASSES, *many), Arrival(0))
    assert (len(drawn.shapes), drawn.shapes[-1].key) == (2000, "test/2099")
    assert drawn.faults == ("more than 2,000 markers: the newest are drawn",)

    places = [(float(number), 0, 0) for number in range(30)]
    for kind, left in ((LIST, [0, 3, 6, 9, 12, 15, 18, 21, 24, 27]), (11, [0, 1, 2, 3, 4, 5])):
        large = markers_of(CLASSES, marker_of(CLASSES, 1, kind, points=places))
        (shape,) = markers.draw(large, Arrival(0, most=10)).shapes
        assert shape.places[:, 0].tolist() == left
        assert len(shape.colors) == len(left)


def test_an_arrow_points_from_its_first_place_to_its_second():
    scale = CLASSES.new_message("geometry_msgs/msg/Vector3")
    scale.x, scale.y, scale.z = 0.1, 0.2, 0.5
    for end, along in (((0, 0, 2), (0, 0, 1)), ((0, 2, 0), (0, 1, 0)), ((0, 0, -2), (0, 0, -1))):
        arrow = marker_of(CLASSES, 1, ARROW, points=[(0, 0, 0), end], scale=scale)
        shaft, head = markers.draw(markers_of(CLASSES, arrow), Arrival(0)).shapes
        for shape, middle in ((shaft, 0.75), (head, 1.75)):
            np.testing.assert_allclose(shape.places, [np.multiply(middle, along)], atol=1e-6)
            upright = Transform((0.0, 0.0, 0.0), shape.turn).rotate((0.0, 0.0, 1.0))
            np.testing.assert_allclose(upright, along, atol=1e-9)
        np.testing.assert_allclose(shaft.size, (0.1, 0.1, 1.5))
        np.testing.assert_allclose(head.size, (0.2, 0.2, 0.5))

    # Without points, the arrow points along x of its pose.
    scale.x = 1.0
    shaft, head = markers.draw(
        markers_of(CLASSES, marker_of(CLASSES, 1, ARROW, scale=scale)), Arrival(0)
    ).shapes
    assert shaft.places[0][0] < 0.5 < head.places[0][0] < 1.0
    forward = Transform((0.0, 0.0, 0.0), head.turn).rotate((0.0, 0.0, 1.0))
    np.testing.assert_allclose(forward, (1.0, 0.0, 0.0), atol=1e-9)


def test_a_list_of_spheres_has_a_colour_for_each_in_the_pose_of_the_marker():
    colors = [CLASSES.new_message("std_msgs/msg/ColorRGBA") for _ in range(2)]
    colors[0].g, colors[1].b, colors[1].a = 1.0, 1.0, 0.5
    several = marker_of(CLASSES, 1, LIST, x=3.0, points=[(0, 0, 0), (1, 2, 0)], colors=colors)
    (shape,) = markers.draw(markers_of(CLASSES, several), Arrival(0)).shapes

    assert (shape.kind, shape.places.tolist()) == ("sphere", [[3.0, 0.0, 0.0], [4.0, 2.0, 0.0]])
    assert shape.colors.tolist() == [[0, 255, 0, 0], [0, 0, 255, 128]]


def test_no_marker_of_a_session_is_lost_between_two_rounds():
    world = World(SimClock())
    displays = LiveDisplays(world)
    world.broadcast([TransformStamped(0, "world", "robot", Transform())], "test", static=True)
    publisher = world.publisher("test", "marks", INTERFACES.message(markers.TYPES[0]))
    for number in range(3):
        one = marker_of(CLASSES, number, CUBE, x=float(number))
        one.header.stamp.sec = one.header.stamp.nanosec = 0
        publisher.publish(markers_of(CLASSES, one))

    assert set(displays.round()) == {"marks"}
    (kept,) = displays.latest(100)
    assert [keys(message) for message in kept.messages] == [["test/0", "test/1", "test/2"]]


def test_of_many_messages_so_many_are_drawn_as_have_room(run):
    with tftool.open_recording(run) as recording:
        every = recorded_tracks(recording, Limits())
        few = recorded_tracks(recording, Limits(points=1, all_points=3))

    assert {one.topic: len(one.messages) for one in every} == {
        "/cloud": 5, "/scan": 5, "/plan": 5, "/goal": 5,
    }  # fmt: skip
    assert {one.topic: len(one.messages) for one in few} == {
        "/cloud": 3, "/scan": 3, "/plan": 3, "/goal": 3,
    }  # fmt: skip


def shown(page, topic, moment):
    """Return the drawn position of a topic's first point, once the message of a moment is shown."""
    found = page.until(
        lambda: (
            (one := page.said("tftool.displays()").get(topic)) and one["stamp"] == moment and one
        )
    )
    return found["count"], [round(number, 3) for number in found["first"]]


def check_displays(page):
    page.until(lambda: len(page.said("tftool.displays()")) == 4)
    page.scrub(2.5)
    # The message of 2 s is drawn at the sensor's pose at 2 s, not at its latest pose.
    assert shown(page, "/cloud", 2.0) == (2, [3.0, 2.0, 4.0])
    assert shown(page, "/scan", 2.0) == (2, [3.0, 0.0, 1.0])
    assert shown(page, "/goal", 2.0) == (1, [2.5, -0.5, 1.0])
    assert shown(page, "/plan", 2.0) == (3, [0.0, 0.0, 0.0])
    page.find("#topics button").click()
    page.until(lambda: len(page.said("tftool.displays()")) == 3)
    assert page.complaints() == []


needs_browser = pytest.mark.skipif(
    not (
        shutil.which("chromium")
        and shutil.which("chromedriver")
        and importlib.util.find_spec("selenium")
    ),
    reason="no chromium and chromedriver: apt-get install chromium chromium-driver",
)


@needs_browser
def test_markers_are_drawn_with_their_frames_colours_and_lifetimes(chromium, tmp_path):
    from tests.screens.browser.test_file import opened

    file = tmp_path / "marked.mcap"
    with tftool.write_recording(file) as recording:
        for tick in range(41):
            at = tick / 10
            pose = TransformStamped(
                EPOCH + seconds(at), "world", "robot", Transform((at, 0.0, 0.0))
            )
            recording.transforms([pose], EPOCH + seconds(at))
        brief = marker_of(recording, 4, SPHERE, at=1.0)
        brief.lifetime.sec = 1
        messages = {
            1.0: [
                marker_of(recording, 1, CUBE, at=1.0, frame="robot", x=0.5),
                marker_of(recording, 2, WORDS, at=1.0, text="here <b>\nit is"),
                marker_of(recording, 3, 4, at=1.0, points=[(0, 0, 0), (1, 0, 0)]),
                brief,
            ],
            3.0: [marker_of(recording, 1, CUBE, at=3.0, action=DELETE)],
        }
        for at, several in messages.items():
            recording.message("/marks", markers_of(recording, *several), EPOCH + seconds(at))
    page_file = tmp_path / "marked.html"
    assert main(["view", str(file), "-o", str(page_file)]) == 0
    page = opened(chromium, page_file, "fixed=world")

    def kinds():
        return page.said("tftool.displays()").get("/marks", {"kinds": []})["kinds"]

    page.scrub(1.5)
    page.until(lambda: kinds() == ["box", "words", "line", "sphere"])
    # The marker is drawn at the robot's pose at 1 s.
    first = page.said("tftool.displays()")["/marks"]["first"]
    assert [round(number, 3) for number in first] == [1.5, 0.0, 0.0]
    page.scrub(2.5)
    page.until(lambda: kinds() == ["box", "words", "line"])
    page.scrub(3.5)
    page.until(lambda: kinds() == ["words", "line"])
    assert page.complaints() == []


@needs_browser
def test_a_session_shows_them_as_they_come_where_their_frames_were(chromium, stage, tmp_path):
    from tests.screens.browser.driving import Page
    from tests.screens.browser.test_file import opened

    for at, x in ((1.0, 3.0), (2.0, 5.0)):
        stage.put(x, at=at)

    def early(world):
        points = world.publisher("test", "early", PointStamped)
        points.publish(point_stamped(world.clock.epoch + seconds(1), "turtle", 0.0, 1.0, 0.0))

    stage.do(early)
    page = Page(chromium, stage, "fixed=world")
    # The point was published before the page was opened. It is drawn at the turtle's pose at 1 s,
    # not at the latest pose.
    assert shown(page, "/early", 1.0) == (1, [3.0, 1.0, 0.0])

    def late(world):
        epoch = world.clock.epoch
        points = world.publisher("test", "turtle3/turtle_point_stamped", PointStamped)
        points.publish(point_stamped(epoch + seconds(1), "world", 4.0, 2.0, 0.0))
        points.publish(point_stamped(epoch + seconds(1.5), "turtle", 0.5, 0.0, 0.0))
        points.publish(point_stamped(epoch + seconds(3), "turtle", 0.5, 0.0, 0.0))
        # The transform arrives after the point.
        pose = TransformStamped(epoch + seconds(3), "world", "turtle", Transform((7.0, 0.0, 0.0)))
        world.broadcast([pose], "test")
        many = cloud_of(CLASSES, np.full((20_000, 3), 2.0), frame="turtle")
        many.header.stamp.sec, many.header.stamp.nanosec = divmod(epoch + seconds(2), NANOSECONDS)
        world.publisher("test", "cloud", type(many), Quality(is_reliable=False)).publish(many)

    stage.do(late)
    assert shown(page, "/turtle3/turtle_point_stamped", 3.0) == (1, [7.5, 0.0, 0.0])
    assert shown(page, "/cloud", 2.0) == (20_000, [7.0, 2.0, 2.0])
    page.find("#topics button").click()
    page.until(lambda: len(page.said("tftool.displays()")) == 2)
    assert page.complaints() == []

    # A saved file contains the last message of each topic.
    with urllib.request.urlopen(stage.address("/standalone.html")) as answer:
        (tmp_path / "saved.html").write_bytes(answer.read())
    saved = opened(chromium, tmp_path / "saved.html", "fixed=world")
    assert shown(saved, "/early", 1.0) == (1, [3.0, 1.0, 0.0])
    assert shown(saved, "/cloud", 2.0) == (20_000, [7.0, 2.0, 2.0])


def test_the_last_message_of_a_topic_is_sent_within_the_bytes_of_a_round():
    world = World(SimClock())
    displays = LiveDisplays(world)
    place = point_stamped(world.clock.epoch, "world", 1.0, 2.0, 0.0)
    goal = world.publisher("test", "goal", PointStamped)
    for x in range(3):
        place.point.x = float(x)
        goal.publish(place)
    kind = INTERFACES.message(cloud.TYPES[0])
    large = cloud_of(CLASSES, np.random.default_rng(1).normal(size=(200_000, 3)), frame="lidar")
    world.broadcast([TransformStamped(0, "world", "lidar", Transform())], "test", static=True)
    for topic in ("a", "b", "c"):
        world.publisher("test", topic, kind).publish(large)
    world.publisher("test", "broken", kind).publish(kind())
    world.publisher("test", "text", INTERFACES.message("std_msgs/msg/String"))

    rounds = [displays.round() for _ in range(4)]

    assert [set(one) for one in rounds] == [{"goal", "a", "b"}, {"c", "broken"}, set(), set()]
    assert all(sum(map(len, one.values())) < 11e6 for one in rounds)
    assert b'"count":3' in rounds[0]["goal"]
    assert b"the cloud has no field 'x' of floats (1 messages)" in rounds[1]["broken"]
    assert set(displays.blocks) == {"goal", "a", "b", "c", "broken"}
    displays.close()
    assert world.topics()["goal"].subscribers == 0


def test_the_latest_displays_are_the_last_message_of_each_topic_thinned_out():
    world = World(SimClock())
    displays = LiveDisplays(world)
    goal = world.publisher("test", "goal", PointStamped)
    many = cloud_of(CLASSES, np.random.default_rng(1).normal(size=(1000, 3)), frame="lidar")
    world.publisher("test", "cloud", type(many)).publish(many)
    for x in (1.0, 2.0):
        goal.publish(point_stamped(world.clock.epoch, "world", x, 0.0, 0.0))

    for _ in range(2):  # before and after the rounds that send to pages
        kept = {track.topic: track for track in displays.latest(300)}
        assert [one.shapes[0].places.tolist() for one in kept["/goal"].messages] == [
            [[2.0, 0.0, 0.0]]
        ]
        assert [one.count for one in kept["/cloud"].messages] == [250]
        for _ in range(8):
            displays.round()
    assert b'"count":1000' in displays.blocks["cloud"]


def test_a_message_waits_for_the_transform_of_its_stamp_but_not_for_ever():
    world = World(SimClock())
    displays = LiveDisplays(world)
    points = world.publisher("test", "goal", PointStamped)
    points.publish(point_stamped(world.clock.epoch, "nowhere", 1.0, 2.0, 0.0))
    waited = [len(displays.round()) for _ in range(8)]
    assert sum(waited) == 1
    assert waited[0] == 0

    points.publish(point_stamped(world.clock.epoch + 5, "robot", 1.0, 2.0, 0.0))
    assert displays.round() == {}
    pose = TransformStamped(world.clock.epoch + 5, "world", "robot", Transform((4.0, 0.0, 0.0)))
    world.broadcast([pose], "test")
    assert b'"root":"world","pose":[4.0,' in displays.round()["goal"]


def test_a_topic_of_another_type_is_left_alone_and_a_changed_quality_followed():
    world = World(SimClock())
    displays = LiveDisplays(world)
    world.topic("odd", INTERFACES.message("std_msgs/msg/String"))
    odd = Endpoint(PUBLISHER, "other", "odd", point.TYPES[0], Quality(), is_remote=True)
    world.endpoints.add(odd)
    first = world.publisher("first", "goal", PointStamped, Quality(is_latched=True))
    second = world.publisher("second", "goal", PointStamped, Quality(is_reliable=False))

    world.broadcast([TransformStamped(0, "world", "robot", Transform())], "test", static=True)
    for publisher in (first, second):
        publisher.publish(point_stamped(world.clock.epoch, "world", 1.0, 0.0, 0.0))
        assert set(displays.round()) == {"goal"}
    subscriptions = world.endpoints.of("goal", SUBSCRIPTION)
    assert [(one.quality.is_reliable, one.quality.is_latched) for one in subscriptions] == [
        (False, False)
    ]


@needs_browser
def test_a_file_shows_them_where_they_were(chromium, run, tmp_path):
    from tests.screens.browser.test_file import opened

    assert main(["view", str(run), "-o", str(tmp_path / "run.html")]) == 0

    check_displays(opened(chromium, tmp_path / "run.html", "fixed=world"))


@needs_browser
def test_a_point_of_a_cloud_is_measured_exactly_whatever_frame_is_fixed(chromium, run, tmp_path):
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.actions.wheel_input import ScrollOrigin

    from tests.screens.browser.test_cameras import clicked, pixels
    from tests.screens.browser.test_file import opened

    def brought_into_view(*place):
        x, y = pixels(page, *place)
        over = page.find("#over")
        if 300 < x < over.size["width"] - 300 and 100 < y < over.size["height"] - 150:
            return True
        wheel = ActionChains(page.driver)
        wheel.scroll_from_origin(ScrollOrigin.from_element(over), 0, 300).perform()
        return False

    def measured(first, second):
        for place in (first, second):
            page.until(lambda place=place: brought_into_view(*place))
        clicked(page, first)
        page.until(lambda: "second point" in page.text("#measured"))
        clicked(page, second)
        return page.until(lambda: " m (" in page.text("#measured") and page.text("#measured"))

    assert main(["view", str(run), "-o", str(tmp_path / "run.html")]) == 0
    page = opened(chromium, tmp_path / "run.html", "fixed=world&at=2&view=side")
    assert shown(page, "/cloud", 2.0)[1] == [3.0, 2.0, 4.0]
    page.find("#measure").click()
    # The cloud stays where the sensor was, so the point belongs to the root frame.
    from_point = "(3.00, 2.00, 4.00) in world to robot: 4.583 m (x -1.000, y -2.000, z -4.000"
    assert measured((3, 2, 4), (2, 0, 0)) == f"{from_point} in world)"

    page.pick("fixed", "robot")
    page.until(lambda: shown(page, "/cloud", 2.0)[1] == [1.0, 2.0, 4.0])
    assert page.text("#measured") == f"{from_point} in robot)"
    # From (1, 2, 3), the sensor's origin is at a distance of the square root of 14.
    assert measured((1, 2, 4), (0, 0, 1)).startswith(
        "(3.00, 2.00, 4.00) in world to sensor: 3.742 m"
    )


@needs_browser
def test_a_server_shows_them_where_they_were(chromium, run):
    from tests.screens.browser.driving import Page
    from tftool.commands.shared.connection import Connection
    from tftool.commands.shared.on_screen import at_rest
    from tftool.opener import open_frames
    from tftool.screens.browser.drawn_messages import tracks_named
    from tftool.screens.browser.server import PageServer
    from tftool.world.clock import run as run_on

    with open_frames(run) as frames:
        shown = at_rest(Connection(), frames)
    found = SimpleNamespace()
    ready = threading.Event()

    async def serve():
        async with PageServer(shown, port=0) as page:
            page.show_tracks(lambda limits: tracks_named(str(run), limits))
            found.url, found.over = page.url, asyncio.Event()
            found.loop = asyncio.get_running_loop()
            running = asyncio.ensure_future(page.run())
            ready.set()
            await found.over.wait()
            running.cancel()

    thread = threading.Thread(target=lambda: run_on(shown.clock, serve()))
    thread.start()
    assert ready.wait(PATIENCE)
    try:
        check_displays(Page(chromium, found, "fixed=world&at=0.5"))
    finally:
        found.loop.call_soon_threadsafe(found.over.set)
        thread.join(PATIENCE)
