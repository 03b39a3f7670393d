import pytest


@pytest.fixture
def filters(node):
    from geometry_msgs.msg import PointStamped
    from message_filters import Subscriber

    return [Subscriber(node, PointStamped, name) for name in ("a", "b")]


def point(second):
    from geometry_msgs.msg import PointStamped
    from rclpy.time import Time

    made = PointStamped()
    made.header.stamp = Time(seconds=second).to_msg()
    return made


def seconds_of(messages):
    return [m.header.stamp.sec + m.header.stamp.nanosec / 1e9 for m in messages]


def feed(one, *seconds):
    for second in seconds:
        one.signalMessage(point(second))


def test_a_subscription_is_a_filter(node, filters):
    import rclpy
    from geometry_msgs.msg import PointStamped

    heard = []
    filters[0].registerCallback(lambda message, more: heard.append((message, more)), "more")
    node.create_publisher(PointStamped, "a", 10).publish(point(3))
    rclpy.spin_once(node, timeout_sec=0.1)

    assert heard == [(point(3), "more")]
    assert filters[0].getTopic() == "a"
    assert filters[0].topic_name == "/a"
    with pytest.raises(AttributeError):
        _ = filters[0].nothing


def test_equal_stamps_belong_together(filters):
    from message_filters import TimeSynchronizer

    heard = []
    TimeSynchronizer(filters, 2).registerCallback(lambda *pair: heard.append(seconds_of(pair)))
    feed(filters[0], 1, 2, 3)
    feed(filters[1], 3, 1, 2)

    # The queue of length two had dropped the first message.
    assert heard == [[3, 3], [2, 2]]


def test_stamps_within_the_slop_belong_together_the_nearest_first(filters):
    from message_filters import ApproximateTimeSynchronizer

    heard = []
    near = ApproximateTimeSynchronizer(filters, 5, slop=0.1)
    near.registerCallback(lambda *pair: heard.append(seconds_of(pair)))
    feed(filters[0], 1.0, 1.04, 2.0)
    feed(filters[1], 1.05, 2.1, 1.03)

    assert heard == [[1.04, 1.05], [1.0, 1.03]]


def test_a_cache_keeps_the_last_messages(filters):
    from message_filters import Cache
    from rclpy.clock import ClockType
    from rclpy.time import Time

    def at(second):
        return Time(seconds=second, clock_type=ClockType.ROS_TIME)

    cache, heard = Cache(filters[0], 3), []
    cache.registerCallback(heard.append)
    assert cache.getLast() is cache.getLastestTime() is cache.getOldestTime() is None
    feed(filters[0], 1, 2, 3, 4)

    assert seconds_of(heard) == [1, 2, 3, 4]
    assert seconds_of([cache.getLast()]) == [4]
    assert (cache.getOldestTime(), cache.getLastestTime()) == (at(2), at(4))
    assert seconds_of(cache.getInterval(at(2), at(3))) == [2, 3]
    assert seconds_of([cache.getElemAfterTime(at(2.5)), cache.getElemBeforeTime(at(2.5))]) == [3, 2]
    assert cache.getElemAfterTime(at(9)) is cache.getElemBeforeTime(at(1)) is None


def test_a_message_without_a_stamp_is_left_out_or_taken_as_of_now(filters, ros_runtime):
    from message_filters import ApproximateTimeSynchronizer, Cache
    from std_msgs.msg import String

    strict, lenient = Cache(filters[0]), Cache(filters[0], 1, allow_headerless=True)
    heard = []
    pairs = ApproximateTimeSynchronizer(filters, 5, 0.1, allow_headerless=True)
    pairs.registerCallback(lambda *pair: heard.append(pair))
    filters[0].signalMessage(String(data="now"))
    feed(filters[1], ros_runtime.clock.now() / 1e9)

    assert strict.getLast() is None
    assert lenient.getLast() == String(data="now")
    assert lenient.getLastestTime().nanoseconds == ros_runtime.clock.now()
    assert len(heard) == 1
    (warning,) = ros_runtime.log("message_filters_cache")
    assert warning.startswith("String has no header with a stamp, so the message is ignored")


def test_a_stamp_may_be_an_rclpy_time_already(node):
    from message_filters import Cache, SimpleFilter
    from rclpy.time import Time

    class Header:
        stamp = Time(seconds=3)

    class Message:
        header = Header()

    cache = Cache(SimpleFilter(), 5)
    cache.add(Message())

    assert cache.getLastestTime() == Time(seconds=3)
