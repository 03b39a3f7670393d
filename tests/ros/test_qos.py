"""Tests of quality of service between nodes of one process: delivery and warnings."""

import pytest


def profile(**settings):
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

    latched = DurabilityPolicy.TRANSIENT_LOCAL
    return QoSProfile(
        depth=settings.get("depth", 5),
        durability=latched if settings.get("latched") else DurabilityPolicy.VOLATILE,
        reliability=ReliabilityPolicy.BEST_EFFORT
        if settings.get("lossy")
        else ReliabilityPolicy.RELIABLE,
    )


def spin(node):
    import rclpy
    from rclpy.task import Future

    rclpy.spin_until_future_complete(node, Future(), timeout_sec=0.1)


CASES = [
    ({"lossy": True}, {}, "RELIABILITY"),
    ({}, {"latched": True}, "DURABILITY"),
    ({"lossy": True}, {"latched": True}, "RELIABILITY"),
    ({}, {}, ""),
    ({}, {"lossy": True}, ""),
    ({"latched": True}, {}, ""),
    ({"latched": True}, {"latched": True}, ""),
]


@pytest.mark.parametrize("publisher_first", [True, False])
@pytest.mark.parametrize(("offered", "requested", "policy"), CASES)
def test_two_that_do_not_fit_are_told_so_and_exchange_nothing(
    node, ros_runtime, offered, requested, policy, publisher_first
):
    import rclpy
    from std_msgs.msg import String

    talker, heard = rclpy.create_node("talker"), []

    def publish():
        return talker.create_publisher(String, "chatter", profile(**offered))

    def subscribe():
        node.create_subscription(String, "chatter", heard.append, profile(**requested))

    if publisher_first:
        publisher = publish()
        subscribe()
    else:
        subscribe()
        publisher = publish()
    publisher.publish(String(data="hello"))
    spin(node)

    assert len(heard) == (0 if policy else 1)
    told = [text for text in ros_runtime.log() if "incompatible QoS" in text]
    if not policy:
        assert told == []
        return
    assert sorted(told) == [
        "New publisher discovered on topic '/chatter' (node 'talker'), offering incompatible QoS. "
        f"No messages will be received from it. Last incompatible policy: {policy}",
        "New subscription discovered on topic '/chatter' (node 'probe'), requesting incompatible "
        f"QoS. No messages will be sent to it. Last incompatible policy: {policy}",
    ]


def test_one_that_fits_is_heard_beside_one_that_does_not(node):
    from std_msgs.msg import String

    heard = []
    node.create_subscription(String, "chatter", lambda m: heard.append(m.data), profile())
    node.create_publisher(String, "chatter", profile(lossy=True)).publish(String(data="lost"))
    node.create_publisher(String, "chatter", profile()).publish(String(data="sure"))
    spin(node)

    assert heard == ["sure"]


def test_the_best_that_is_available_fits_whatever_the_other_end_says(node, ros_runtime):
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
    from std_msgs.msg import String

    best = QoSProfile(
        depth=5,
        reliability=ReliabilityPolicy.BEST_AVAILABLE,
        durability=DurabilityPolicy.BEST_AVAILABLE,
    )
    easy, strict = [], []
    node.create_subscription(String, "any", lambda m: easy.append(m.data), best)
    node.create_publisher(String, "any", profile(lossy=True)).publish(String(data="lossy"))
    node.create_publisher(String, "all", best).publish(String(data="kept"))
    node.create_subscription(String, "all", lambda m: strict.append(m.data), profile(latched=True))
    spin(node)

    assert (easy, strict) == (["lossy"], ["kept"])
    assert not any("incompatible QoS" in text for text in ros_runtime.log())


def test_a_late_latched_subscription_gets_the_kept_messages_of_existing_publishers(node):
    from std_msgs.msg import String

    heard = []
    keeper = node.create_publisher(String, "map", profile(latched=True, depth=2))
    gone = node.create_publisher(String, "map", profile(latched=True))
    for word in ("one", "two", "three"):
        keeper.publish(String(data=word))
    gone.publish(String(data="gone"))
    node.destroy_publisher(gone)
    node.create_subscription(String, "map", lambda m: heard.append(m.data), profile(latched=True))
    node.create_subscription(String, "map", lambda m: heard.append(m.data), profile())
    spin(node)

    assert heard == ["two", "three"]


@pytest.mark.parametrize(
    ("history", "depth", "kept"),
    [("KEEP_ALL", 2, ["0", "1", "2"]), ("KEEP_LAST", 2, ["1", "2"]), ("KEEP_LAST", 0, ["2"])],
)
def test_a_publisher_keeps_all_or_as_many_as_its_depth_and_one_at_least(node, history, depth, kept):
    from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
    from std_msgs.msg import String

    offered = QoSProfile(
        history=HistoryPolicy[history], depth=depth, durability=DurabilityPolicy.TRANSIENT_LOCAL
    )
    out, heard = node.create_publisher(String, "map", offered), []
    for number in range(3):
        out.publish(String(data=str(number)))
    node.create_subscription(String, "map", lambda m: heard.append(m.data), profile(latched=True))
    spin(node)

    assert heard == kept


def test_the_graph_tells_what_is_exchanged_and_who_answers(node):
    from std_msgs.msg import String
    from std_srvs.srv import Trigger

    node.create_publisher(String, "chatter", 10)
    node.create_service(Trigger, "go", lambda request, response: response)

    assert ("/chatter", ["std_msgs/msg/String"]) in node.get_topic_names_and_types()
    assert ("/go", ["std_srvs/srv/Trigger"]) in node.get_service_names_and_types()
    assert node.count_publishers("chatter") == 1
    assert node.count_subscribers("chatter") == 0


def test_a_question_of_another_type_than_the_service_is_refused(node):
    import rclpy
    from std_srvs.srv import SetBool, Trigger

    node.create_service(Trigger, "go", lambda request, response: response)
    asked = node.create_client(SetBool, "go").call_async(SetBool.Request())
    rclpy.spin_until_future_complete(node, asked, timeout_sec=1.0)

    with pytest.raises(Exception, match="is of type std_srvs/srv/Trigger, which takes no"):
        asked.result()


def test_a_profile_says_enough_or_is_refused(ros_runtime):
    from rclpy.qos import (
        HistoryPolicy,
        InvalidQoSProfileException,
        QoSPresetProfiles,
        QoSProfile,
        ReliabilityPolicy,
        qos_profile_sensor_data,
    )

    assert QoSPresetProfiles.get_from_short_key("sensor_data") is qos_profile_sensor_data or (
        QoSPresetProfiles.get_from_short_key("sensor_data").value == qos_profile_sensor_data
    )
    assert ReliabilityPolicy.get_from_short_key("best_effort") == ReliabilityPolicy.BEST_EFFORT
    assert ReliabilityPolicy.RELIABLE.short_key == "reliable"
    assert "keep_last" in HistoryPolicy.short_keys()
    assert QoSProfile(depth=3) == QoSProfile(depth=3)
    assert "depth=3" in repr(QoSProfile(depth=3))
    with pytest.raises(InvalidQoSProfileException, match="required"):
        QoSProfile()
    with pytest.raises(InvalidQoSProfileException, match="without a depth"):
        QoSProfile(history=HistoryPolicy.KEEP_LAST)
    with pytest.raises(TypeError, match="no setting 'size'"):
        QoSProfile(size=3)
    with pytest.raises(ValueError, match="depth"):
        QoSProfile(depth=-1)


def test_a_depth_must_be_a_number(node):
    from std_msgs.msg import String

    with pytest.raises(TypeError, match="Expected QoSProfile or int"):
        node.create_publisher(String, "a", "10")
