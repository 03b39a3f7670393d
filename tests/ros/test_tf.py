import math

import pytest

from tftool.base.stamps import seconds
from tftool.buffer.sample import TransformStamped as Sample
from tftool.geometry.rigid import Transform


def transform(parent, child, stamp=None, xyz=(0.0, 0.0, 0.0), xyzw=(0.0, 0.0, 0.0, 1.0)):
    from geometry_msgs.msg import TransformStamped

    made = TransformStamped(child_frame_id=child)
    made.header.frame_id = parent
    if stamp is not None:
        made.header.stamp = stamp.to_msg()
    place, turn = made.transform.translation, made.transform.rotation
    place.x, place.y, place.z = xyz
    turn.x, turn.y, turn.z, turn.w = xyzw
    return made


def test_a_sent_transform_is_found_by_a_listener_without_spinning(node, ros_runtime):
    from rclpy.time import Time
    from tf2_ros import Buffer, TransformBroadcaster, TransformListener

    buffer = Buffer()
    TransformListener(buffer, node)
    now = node.get_clock().now()
    TransformBroadcaster(node).sendTransform([transform("world", "a", now, (1.0, 2.0, 3.0))])
    found = buffer.lookup_transform("world", "a", Time())

    assert found == transform("world", "a", now, (1.0, 2.0, 3.0))
    assert ros_runtime.world.buffer.frame_exists("a")
    assert "probe" in buffer.all_frames_as_yaml()
    assert "a" in buffer.all_frames_as_string()
    assert "a" in buffer._allFramesAsDot()
    assert buffer._frameExists("a")
    assert set(buffer._getFrameStrings()) == {"world", "a"}
    assert buffer.get_latest_common_time("world", "a").nanoseconds == now.nanoseconds


def test_a_clock_that_falls_back_clears_what_a_listener_heard(node, ros_runtime, monkeypatch):
    from rclpy.time import Time
    from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformListener

    buffer = Buffer()
    TransformListener(buffer, node)
    sender, clock = TransformBroadcaster(node), ros_runtime.world.clock
    began = clock.now()

    def send(child, at):
        monkeypatch.setattr(clock, "now", lambda: began + at)
        sender.sendTransform([transform("world", child, Time(nanoseconds=began + at))])

    StaticTransformBroadcaster(node).sendTransform(transform("a", "lens"))
    send("a", 9 * 10**9)
    send("b", 8 * 10**9 + 1)
    assert buffer.can_transform("world", "a", Time())

    send("b", 7 * 10**9)
    assert not buffer.can_transform("world", "a", Time())
    assert buffer.can_transform("world", "b", Time())
    assert buffer.can_transform("a", "lens", Time())
    said = [record.text for record in ros_runtime.world.log.records]
    assert said.count("Detected jump back in time. Clearing tf buffer.") == 1


def test_a_late_listener_has_all_statics_and_ends_when_told(node):
    from rclpy.time import Time
    from tf2_ros import Buffer, StaticTransformBroadcaster, StaticTransformListener

    sender = StaticTransformBroadcaster(node)
    sender.sendTransform(transform("a", "b"))
    sender.sendTransform(transform("b", "c"))
    buffer = Buffer()
    listener = StaticTransformListener(buffer, node)
    assert buffer.can_transform("a", "c", Time())
    listener.unregister()
    sender.sendTransform(transform("c", "d"))

    assert not buffer.can_transform("a", "d", Time())
    possible, reason = buffer.can_transform("a", "d", Time(), return_debug_tuple=True)
    assert not possible
    assert '"d"' not in reason or "does not exist" in reason


def test_transforms_travel_on_tf_as_messages_too(node, ros_runtime):
    import rclpy
    from tf2_msgs.msg import TFMessage

    heard, statics = [], []
    node.create_subscription(TFMessage, "/tf", heard.append, 10)
    ros_runtime.ask(
        lambda: ros_runtime.world.broadcast(
            [Sample(seconds(1000), "world", "m", Transform((1.0, 0.0, 0.0)))], "native"
        )
    )
    sent = transform("world", "n", node.get_clock().now())
    node.create_publisher(TFMessage, "/tf_static", 1).publish(TFMessage(transforms=[sent]))
    latched = rclpy.qos.QoSProfile(depth=1, durability=rclpy.qos.DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_subscription(TFMessage, "/tf_static", statics.append, latched)
    rclpy.spin_once(node)
    rclpy.spin_once(node)

    assert heard[0].transforms[0].child_frame_id == "m"
    assert statics[0].transforms == [sent]


def test_a_lookup_waits_for_its_data_on_simulated_time_even_inside_a_callback(node, ros_runtime):
    import rclpy
    from tf2_ros import Buffer, TransformListener

    buffer = Buffer()
    TransformListener(buffer, node)

    def sender():
        rclpy.init()
        other = rclpy.create_node("sender")
        broadcaster = __import__("tf2_ros").TransformBroadcaster(other)
        other.create_timer(
            2.0,
            lambda: broadcaster.sendTransform(transform("world", "a", other.get_clock().now())),
        )
        rclpy.spin(other)

    ros_runtime.start(sender)
    found = []

    def look():
        found.append(
            buffer.lookup_transform(
                "world", "a", rclpy.time.Time(), rclpy.duration.Duration(seconds=5.0)
            )
        )
        found.append(ros_runtime.elapsed())

    timer = node.create_timer(0.5, look)
    rclpy.spin_once(node)
    timer.cancel()

    assert found[0].child_frame_id == "a"
    assert found[1] == 2.0


def test_a_wait_that_ends_in_vain_raises_the_refusal_itself(node, ros_runtime):
    from rclpy.duration import Duration
    from rclpy.time import Time
    from tf2_ros import Buffer, LookupException

    buffer = Buffer(cache_time=Duration(seconds=3.0))
    with pytest.raises(LookupException, match=r'"a" passed to lookupTransform .* does not exist'):
        buffer.lookup_transform("a", "b", Time(), Duration(seconds=1.5))
    assert ros_runtime.elapsed() == 1.5
    assert not buffer.can_transform("a", "b", Time(), timeout=Duration(seconds=0.5))
    assert not buffer.can_transform_full(
        "a", Time(), "b", Time(), "c", timeout=Duration(seconds=0.5)
    )
    assert ros_runtime.elapsed() == 2.5


def test_a_lookup_across_time_goes_through_a_fixed_frame(node):
    from rclpy.time import Time
    from tf2_ros import Buffer, ExtrapolationException

    buffer = Buffer()
    for second in (10, 20):
        stamp = Time(seconds=second)
        buffer.set_transform(transform("world", "a", stamp, (float(second), 0.0, 0.0)), "test")
    buffer.set_transform_static(transform("world", "b", xyz=(0.0, 1.0, 0.0)), "test")
    asked = ("b", Time(seconds=20), "a", Time(seconds=15), "world")

    assert buffer.lookup_transform_full(*asked).transform.translation.x == 15.0
    assert buffer.lookup_transform_full_core(*asked).transform.translation.y == -1.0
    assert buffer.can_transform_full_core(*asked) == (1, "")
    assert buffer.can_transform_core("world", "a", Time(seconds=15))[0] == 1
    assert buffer.lookup_transform_core("world", "b", Time()).transform.translation.y == 1.0
    with pytest.raises(ExtrapolationException):
        buffer.lookup_transform("world", "a", Time(seconds=30))
    buffer.clear()
    assert not buffer.can_transform("world", "a", Time())


def test_a_future_of_a_transform_is_done_when_its_data_comes(node):
    import rclpy
    from rclpy.time import Time
    from tf2_ros import Buffer

    buffer = Buffer()
    future = buffer.wait_for_transform_async("world", "a", Time(seconds=15))
    full = buffer.wait_for_transform_full_async(
        "a", Time(seconds=10), "a", Time(seconds=20), "world"
    )
    buffer.set_transform(transform("world", "a", Time(seconds=10)), "test")
    assert not future.done()
    buffer.set_transform(transform("world", "a", Time(seconds=20)), "test")

    assert future.result().header.stamp.sec == 15
    assert full.done()
    waiting = buffer.lookup_transform_async("world", "a", Time(seconds=30))
    task = rclpy.get_global_executor().create_task(waiting)
    rclpy.spin_once(node, timeout_sec=0.1)
    assert not task.done()
    buffer.set_transform(transform("world", "a", Time(seconds=40)), "test")
    rclpy.spin_until_future_complete(node, task, timeout_sec=1.0)
    assert task.result().header.stamp.sec == 30


@pytest.mark.parametrize(
    ("ask", "told"),
    [
        (lambda b, t, d: b.lookup_transform("a", "b", 0), "must be an rclpy.time.Time"),
        (lambda b, t, d: b.lookup_transform("a", "b", t(), 1.0), "Duration, not float: write"),
        (lambda b, t, d: b.lookup_transform("a", 3, t()), "source_frame must be a frame's name"),
    ],
)
def test_arguments_of_the_wrong_type_are_refused(node, ask, told):
    from rclpy.duration import Duration
    from rclpy.time import Time
    from tf2_ros import Buffer, TransformBroadcaster

    with pytest.raises(TypeError, match=told):
        ask(Buffer(), Time, Duration)
    with pytest.raises(TypeError, match="expected a TransformStamped, got Time"):
        TransformBroadcaster(node).sendTransform([Time()])


# Data in other frames (numbers: spec, do_transform)


def flip(stamp=None):
    return transform("target", "source", stamp, (10.0, 20.0, 30.0), (1.0, 0.0, 0.0, 0.0))


def triple(v):
    return pytest.approx((v.x, v.y, v.z))


def test_points_vectors_and_poses_move_into_the_targets_frame(ros_runtime):
    import tf2_geometry_msgs as tf2
    from geometry_msgs.msg import PointStamped, PoseStamped, Vector3Stamped

    point, vector, pose = PointStamped(), Vector3Stamped(), PoseStamped()
    for part in (point.point, vector.vector, pose.pose.position):
        part.x, part.y, part.z = 1.0, 2.0, 3.0
    pose.pose.orientation.x, pose.pose.orientation.w = 1.0, 0.0
    moved = tf2.do_transform_point(point, flip())

    assert triple(moved.point) == (11.0, 18.0, 27.0)
    assert moved.header.frame_id == "target"
    assert triple(tf2.do_transform_vector3(vector, flip()).vector) == (1.0, -2.0, -3.0)
    moved = tf2.do_transform_pose_stamped(pose, flip())
    assert triple(moved.pose.position) == (11.0, 18.0, 27.0)
    assert moved.pose.orientation.w == pytest.approx(1.0)
    assert tf2.do_transform_pose(pose.pose, flip()) == moved.pose
    assert pose.header.frame_id == ""


def test_a_covariance_is_turned_block_by_block(ros_runtime):
    import tf2_geometry_msgs as tf2
    from geometry_msgs.msg import PoseWithCovarianceStamped

    pose = PoseWithCovarianceStamped()
    pose.pose.covariance = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0] * 6
    turned = tf2.do_transform_pose_with_covariance_stamped(pose, flip()).pose.covariance

    kept, reversed_ = [1.0, -2.0, -3.0, 4.0, -5.0, -6.0], [-1.0, 2.0, 3.0, -4.0, 5.0, 6.0]
    rows = [kept, reversed_, reversed_] * 2
    assert list(turned) == pytest.approx([number for row in rows for number in row])


def test_a_wrench_gains_the_torque_of_its_arm(ros_runtime):
    import tf2_geometry_msgs as tf2
    from geometry_msgs.msg import WrenchStamped

    wrench = WrenchStamped()
    for part in (wrench.wrench.force, wrench.wrench.torque):
        part.x, part.y, part.z = 2.0, 1.0, 3.0
    half = math.sqrt(0.5)
    moved = tf2.do_transform_wrench_stamped(
        wrench, transform("t", "s", None, (0.0, -2.0, 0.0), (0.0, 0.0, -half, half))
    )

    assert triple(moved.wrench.force) == (1.0, -2.0, 3.0)
    assert triple(moved.wrench.torque) == (-5.0, -2.0, 5.0)


def test_a_polygon_and_a_cloud_move_point_by_point(ros_runtime):
    import struct

    import tf2_geometry_msgs as tf2
    from geometry_msgs.msg import Point32, PolygonStamped
    from sensor_msgs.msg import PointCloud2, PointField
    from tf2_sensor_msgs import do_transform_cloud

    polygon = PolygonStamped()
    polygon.polygon.points = [Point32(x=1.0, y=2.0, z=3.0)]
    assert triple(tf2.do_transform_polygon_stamped(polygon, flip()).polygon.points[0]) == (
        11.0,
        18.0,
        27.0,
    )

    cloud = PointCloud2(height=1, width=2, point_step=16, row_step=32)
    cloud.fields = [
        PointField(name=name, offset=4 * index, datatype=PointField.FLOAT32, count=1)
        for index, name in enumerate(("x", "y", "z", "intensity"))
    ]
    cloud.data = struct.pack("<8f", 1, 2, 0, 7, 10, 20, 30, 8)
    cloud.header.stamp.sec = 5
    lifted = transform("target", "s", None, (0.0, 0.0, 100.0), (1.0, 0.0, 0.0, 0.0))
    moved = do_transform_cloud(cloud, lifted)

    assert struct.unpack("<8f", moved.data.tobytes()) == (1, -2, 100, 7, 10, -20, 70, 8)
    assert moved.header.frame_id == "target"
    assert moved.header.stamp.sec == 5
    assert cloud.data.tobytes() == struct.pack("<8f", 1, 2, 0, 7, 10, 20, 30, 8)
    cloud.fields = cloud.fields[:2]
    with pytest.raises(AssertionError, match="needs the fields x, y, and z"):
        do_transform_cloud(cloud, lifted)


def test_a_quaternion_of_zero_means_no_turn(ros_runtime):
    import tf2_geometry_msgs as tf2
    from geometry_msgs.msg import PointStamped

    nothing = transform("t", "s", None, (1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0))

    assert tf2.do_transform_point(PointStamped(), nothing).point.x == 1.0


def test_a_buffer_transforms_data_with_a_header(node):
    import tf2_geometry_msgs  # noqa: F401
    from geometry_msgs.msg import PointStamped
    from rclpy.time import Time
    from std_msgs.msg import String
    from tf2_ros import Buffer, TypeException, convert
    from tf2_ros.buffer_interface import ConvertRegistration

    buffer = Buffer()
    buffer.set_transform_static(flip(), "test")
    point = PointStamped()
    point.header.frame_id = "source"

    assert buffer.transform(point, "target").point.x == 10.0
    assert buffer.transform_full(point, "target", Time(), "target").point.y == 20.0
    with pytest.raises(TypeException, match="is not loaded or supported"):
        buffer.transform(String(), "target")
    assert convert(point, PointStamped) == point
    ConvertRegistration().add_convert((PointStamped, tuple), lambda p: (p.point.x,))
    assert buffer.transform(point, "target", new_type=tuple) == (10.0,)
    ConvertRegistration().add_from_msg(list, lambda p: [p.point.x])
    assert convert(point, list) == [0.0]


# Euler angles and quaternions


def test_quaternions_of_the_tutorial(ros_runtime):
    import tf_transformations as tft

    assert tft.quaternion_from_euler(0, 0, 0) == (0.0, 0.0, 0.0, 1.0)
    assert tft.quaternion_from_euler(0, 0, math.pi / 2) == pytest.approx(
        (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))
    )
    roll, pitch, yaw = 0.1, -0.7, 2.2
    q = tft.quaternion_from_euler(roll, pitch, yaw)
    assert tft.euler_from_quaternion(q) == pytest.approx((roll, pitch, yaw))
    assert tft.quaternion_multiply(q, tft.quaternion_inverse(q)) == pytest.approx((0, 0, 0, 1))
    assert tft.quaternion_conjugate(q)[3] == q[3]
    assert tft.quaternion_about_axis(0.4, (0, 0, 2)) == pytest.approx(
        tft.quaternion_from_euler(0, 0, 0.4)
    )
    assert tft.quaternion_slerp((0, 0, 0, 1), q, 1.0) == pytest.approx(q)
    assert tft.quaternion_slerp(q, q, 0.5) == pytest.approx(q)
    assert tft.quaternion_slerp((0, 0, 0, 1), tft.quaternion_from_euler(0, 0, -1), 0.5) == (
        pytest.approx(tft.quaternion_from_euler(0, 0, -0.5))
    )
    with pytest.raises(ValueError, match="zero"):
        tft.quaternion_about_axis(1.0, (0, 0, 0))
    with pytest.raises(ValueError, match="'sxyz'"):
        tft.quaternion_from_euler(0, 0, 0, "xyz")


@pytest.mark.parametrize("frame", ["s", "r"])
@pytest.mark.parametrize(
    "letters",
    ["xyz", "xyx", "xzy", "xzx", "yzx", "yzy", "yxz", "yxy", "zxy", "zxz", "zyx", "zyz"],
)
@pytest.mark.parametrize("angles", [(0.3, 0.6, -1.1), (-2.0, 1.2, 2.5), (0.4, 0.0, 0.7)])
def test_every_order_of_axes_undoes_itself(frame, letters, angles):
    from tftool.ros.tf2 import euler

    matrix = euler.euler_matrix(*angles, frame + letters)
    again = euler.euler_matrix(*euler.euler_from_matrix(matrix, frame + letters), frame + letters)

    assert again == pytest.approx(matrix, abs=1e-12)


@pytest.mark.parametrize("pitch", [math.pi / 2, -math.pi / 2])
def test_where_the_turns_are_not_unique_the_last_is_zero(pitch):
    from tftool.ros.tf2 import euler

    found = euler.euler_from_matrix(euler.euler_matrix(0.5, pitch, 0.2))

    assert found[1] == pytest.approx(pitch)
    assert found[2] == 0.0
    assert euler.euler_matrix(*found) == pytest.approx(
        euler.euler_matrix(0.5, pitch, 0.2), abs=1e-9
    )


def test_matrices_compose_and_come_apart(ros_runtime):
    import tf_transformations as tft

    placed = tft.compose_matrix(angles=(0.1, 0.2, 0.3), translate=(1, 2, 3))
    q = tft.quaternion_from_matrix(placed)

    assert list(tft.translation_from_matrix(placed)) == [1, 2, 3]
    assert q == pytest.approx(tft.quaternion_from_euler(0.1, 0.2, 0.3))
    whole = tft.concatenate_matrices(tft.translation_matrix((1, 2, 3)), tft.quaternion_matrix(q))
    assert whole == pytest.approx(placed)
    assert tft.concatenate_matrices(placed, tft.inverse_matrix(placed)) == pytest.approx(
        tft.identity_matrix()
    )
    for turned in ((3.0, 0.0, 0.0), (0.0, 3.0, 0.0), (0.0, 0.0, 3.0)):
        q = tft.quaternion_from_euler(*turned)
        assert tft.quaternion_from_matrix(tft.quaternion_matrix(q)) == pytest.approx(q)
    assert tft.vector_norm((3, 4)) == 5.0
    assert list(tft.unit_vector((3, 4))) == [0.6, 0.8]
    assert tft.quaternion_matrix((0, 0, 0, 0)) == pytest.approx(tft.identity_matrix())
    with pytest.raises(NotImplementedError):
        tft.compose_matrix(scale=(1, 1, 1))


def test_the_core_answers_at_once_or_refuses(node):
    import tf2_py
    from rclpy.duration import Duration
    from rclpy.time import Time
    from tf2_ros import TransformException

    core = tf2_py.BufferCore(Duration(seconds=30.0))
    stamp = Time(seconds=5)
    core.set_transform(transform("map", "robot", stamp, (1.0, 2.0, 0.0)), "me")

    found = core.lookup_transform_core("map", source_frame="robot", time=Time())
    assert found.transform.translation.y == 2.0
    assert core.can_transform_core("map", "robot", stamp) == (1, "")
    whether, why_not = core.can_transform_full_core("map", stamp, "arm", stamp, "map")
    assert not whether
    assert '"arm"' in why_not
    with pytest.raises(TransformException):
        core.lookup_transform_full_core("map", stamp, "robot", Time(seconds=9), "map")
    with pytest.raises(TypeError, match="source_frame"):
        core.lookup_transform_core("map", time=Time())


def test_a_buffer_of_ones_own_transforms_what_it_can_look_up(node):
    import tf2_geometry_msgs  # noqa: F401 -- says how points are transformed
    import tf2_ros
    from geometry_msgs.msg import PointStamped
    from rclpy.time import Time

    class Fixed(tf2_ros.BufferInterface):
        def lookup_transform(self, target_frame, source_frame, time, timeout=None):
            return transform(target_frame, source_frame, xyz=(0.0, 0.0, 1.0))

    point = PointStamped()
    point.header.frame_id = "robot"
    moved = Fixed().transform(point, "map")

    assert (moved.header.frame_id, moved.point.z) == ("map", 1.0)
    for ask in (
        lambda bare: bare.lookup_transform("a", "b", Time()),
        lambda bare: bare.lookup_transform_full("a", Time(), "b", Time(), "c"),
        lambda bare: bare.can_transform("a", "b", Time()),
        lambda bare: bare.can_transform_full("a", Time(), "b", Time(), "c"),
    ):
        with pytest.raises(tf2_ros.NotImplementedException):
            ask(tf2_ros.BufferInterface())


def test_spin_once_ends_when_transforms_arrive_and_spin_is_not_woken(node, ros_runtime):
    import rclpy
    from tf2_ros import Buffer, TransformListener

    buffer = Buffer()
    TransformListener(buffer, node)

    def sender():
        from tf2_ros import TransformBroadcaster

        rclpy.init()
        other = rclpy.create_node("sender")
        broadcaster = TransformBroadcaster(other)
        other.create_timer(
            2.0,
            lambda: broadcaster.sendTransform(transform("world", "a", other.get_clock().now())),
        )
        rclpy.spin(other)

    ros_runtime.start(sender)
    tries = 0
    while not buffer.can_transform("world", "a", rclpy.time.Time()):
        rclpy.spin_once(node)
        tries += 1

    assert tries == 1
    assert ros_runtime.elapsed() == 2.0
    rclpy.spin_once(node)
    assert ros_runtime.elapsed() == 4.0
    rclpy.spin_once(node, timeout_sec=0.5)
    assert ros_runtime.elapsed() == 4.5


@pytest.mark.parametrize(
    ("turn", "told"),
    [
        ((0.0, 0.0, 0.0, 0.0), "is all zeros"),
        ((0.0, 0.0, 0.7, 0.8), "has length 1.063, not 1"),
        ((0.0, 0.0, 90.0, 1.0), "use quaternion_from_euler for radians"),
    ],
)
def test_a_rotation_that_ros_would_refuse_is_told_once_where_it_is_sent(
    node, ros_runtime, turn, told
):
    from rclpy.time import Time
    from tf2_ros import TransformBroadcaster

    broadcaster = TransformBroadcaster(node)
    for second in range(1, 21):
        broadcaster.sendTransform(transform("world", "robot", Time(seconds=second), xyzw=turn))

    said = [line for line in ros_runtime.log("probe") if "the rotation of 'robot'" in line]
    assert len(said) == 1
    assert told in said[0]
    # The buffer logs repeated refusals less and less often.
    assert len(ros_runtime.log("buffer")) in (0, 4)


def test_degrees_given_as_an_angle_are_told_once_with_their_line(ros_runtime, tmp_path):
    file = tmp_path / "turn.py"
    file.write_text(
        "from tf_transformations import quaternion_from_euler\n"
        "for _ in range(3):\n"
        "    quaternion_from_euler(0, 0.1, 90)\n"
        "for step in range(20):\n"
        "    quaternion_from_euler(0, 0, step)\n"
        "quaternion_from_euler(0, 0, 6.9)\n"
        "quaternion_from_euler(0, 0, 1000.0)\n"
    )
    program = ros_runtime.start(file)
    ros_runtime.sleep(1.0)

    assert program.status == 0
    assert [text for text in ros_runtime.log() if "degrees" in text] == [
        f"{file}:3: quaternion_from_euler takes radians, and 90 looks like degrees: "
        "math.radians(90)"
    ]
