"""Tests of rclpy.event_handler and qos_overriding_options."""

import pytest

from tests.ros.spinning import spin


def test_a_publisher_is_told_when_subscriptions_come_and_go(node):
    from rclpy.event_handler import PublisherEventCallbacks
    from std_msgs.msg import String

    told = []
    events = PublisherEventCallbacks(matched=told.append)
    publisher = node.create_publisher(String, "chat", 10, event_callbacks=events)
    subscription = node.create_subscription(String, "chat", lambda message: None, 10)
    spin(node, 0.1)
    node.destroy_subscription(subscription)
    spin(node, 0.1)

    assert [(one.current_count, one.current_count_change) for one in told] == [(1, 1), (0, -1)]
    assert [one.total_count for one in told] == [1, 1]
    node.destroy_publisher(publisher)
    node.create_subscription(String, "chat", lambda message: None, 10)
    spin(node, 0.1)
    assert len(told) == 2


def test_a_subscription_is_told_which_policy_keeps_a_publisher_away(node):
    from rclpy.event_handler import SubscriptionEventCallbacks
    from rclpy.qos import QoSPolicyKind, qos_profile_sensor_data
    from std_msgs.msg import String

    told, matched = [], []
    node.create_subscription(
        String,
        "chat",
        lambda message: None,
        10,
        event_callbacks=SubscriptionEventCallbacks(
            incompatible_qos=told.append, matched=matched.append
        ),
    )
    node.create_publisher(String, "chat", qos_profile_sensor_data)
    spin(node, 0.1)

    assert [(one.total_count, one.last_policy_kind) for one in told] == [
        (1, QoSPolicyKind.RELIABILITY)
    ]
    assert matched == []


def test_both_ends_are_told_of_every_deadline_that_passes(node):
    from rclpy.duration import Duration
    from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
    from rclpy.qos import QoSProfile
    from std_msgs.msg import String

    quality = QoSProfile(depth=1, deadline=Duration(seconds=1))
    offered, requested = [], []
    publisher = node.create_publisher(
        String, "chat", quality, event_callbacks=PublisherEventCallbacks(deadline=offered.append)
    )
    node.create_subscription(
        String,
        "chat",
        lambda message: None,
        quality,
        event_callbacks=SubscriptionEventCallbacks(deadline=requested.append),
    )
    timer = node.create_timer(0.75, lambda: publisher.publish(String()))
    spin(node, 4)
    assert (offered, requested) == ([], [])
    timer.cancel()
    spin(node, 2.25)

    assert [(one.total_count, one.total_count_change) for one in offered] == [(1, 1), (2, 1)]
    assert [one.total_count for one in requested] == [1, 2]
    node.destroy_publisher(publisher)
    spin(node, 2)
    assert (len(offered), len(requested)) == (2, 4)


def lives(told):
    return [
        (one.alive_count, one.not_alive_count, one.alive_count_change, one.not_alive_count_change)
        for one in told
    ]


def test_a_subscription_is_told_which_publishers_live(node):
    from rclpy.duration import Duration
    from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
    from rclpy.qos import LivelinessPolicy, QoSProfile
    from std_msgs.msg import String

    told, lost = [], []
    quality = QoSProfile(
        depth=1,
        liveliness=LivelinessPolicy.MANUAL_BY_TOPIC,
        liveliness_lease_duration=Duration(seconds=1),
    )
    node.create_subscription(
        String,
        "chat",
        lambda message: None,
        10,
        event_callbacks=SubscriptionEventCallbacks(liveliness=told.append),
    )
    spin(node, 0.1)
    assert told == []
    automatic = node.create_publisher(String, "chat", 10)
    manual = node.create_publisher(
        String, "chat", quality, event_callbacks=PublisherEventCallbacks(liveliness=lost.append)
    )
    spin(node, 3)
    assert lives(told) == [(1, 0, 1, 0), (1, 1, 0, 1)]
    manual.publish(String())
    spin(node, 0.75)
    manual.assert_liveliness()
    spin(node, 0.75)
    assert (lives(told[2:]), lost) == ([(2, 0, 1, -1)], [])
    spin(node, 2)
    assert lives(told[3:]) == [(1, 1, -1, 1)]
    assert [(one.total_count, one.total_count_change) for one in lost] == [(1, 1)]
    node.destroy_publisher(manual)
    spin(node, 0.1)
    node.destroy_publisher(automatic)
    spin(node, 0.1)
    assert lives(told[4:]) == [(1, 0, 0, -1), (0, 0, -1, 0)]


@pytest.mark.parametrize(
    ("offered", "requested", "policy"),
    [
        ({"deadline": 2}, {"deadline": 1}, "DEADLINE"),
        ({}, {"deadline": 1}, "DEADLINE"),
        ({"deadline": 1}, {"deadline": 1}, ""),
        ({"deadline": 1}, {}, ""),
        ({"liveliness_lease_duration": 2}, {"liveliness_lease_duration": 1}, "LIVELINESS"),
        ({"liveliness": "AUTOMATIC"}, {"liveliness": "MANUAL_BY_TOPIC"}, "LIVELINESS"),
        ({"liveliness": "MANUAL_BY_TOPIC"}, {"liveliness": "AUTOMATIC"}, ""),
    ],
)
def test_less_often_than_is_asked_for_does_not_fit(node, offered, requested, policy):
    from rclpy.duration import Duration
    from rclpy.event_handler import SubscriptionEventCallbacks
    from rclpy.qos import (
        LivelinessPolicy,
        QoSCompatibility,
        QoSPolicyKind,
        QoSProfile,
        qos_check_compatible,
    )
    from std_msgs.msg import String

    def profile(settings):
        return QoSProfile(
            depth=1,
            **{
                key: LivelinessPolicy[value] if key == "liveliness" else Duration(seconds=value)
                for key, value in settings.items()
            },
        )

    told, heard = [], []
    node.create_subscription(
        String,
        "chat",
        heard.append,
        profile(requested),
        event_callbacks=SubscriptionEventCallbacks(incompatible_qos=told.append),
    )
    publisher = node.create_publisher(String, "chat", profile(offered))
    publisher.publish(String())
    spin(node, 0.1)

    assert [one.last_policy_kind for one in told] == ([QoSPolicyKind[policy]] if policy else [])
    assert len(heard) == (0 if policy else 1)
    verdict, reason = qos_check_compatible(profile(offered), profile(requested))
    assert verdict is (QoSCompatibility.ERROR if policy else QoSCompatibility.OK)
    assert bool(reason) == bool(policy)


def test_parameters_choose_the_quality_of_a_topic_that_allows_it(ros_runtime):
    import rclpy
    from rclpy.parameter import Parameter
    from rclpy.qos import ReliabilityPolicy
    from rclpy.qos_overriding_options import QoSOverridingOptions
    from std_msgs.msg import String

    rclpy.init()
    node = rclpy.create_node(
        "talker",
        parameter_overrides=[
            Parameter("qos_overrides./chat.publisher.reliability", value="best_effort"),
            Parameter("qos_overrides./chat.publisher.depth", value=3),
        ],
    )
    options = QoSOverridingOptions.with_default_policies()
    publisher = node.create_publisher(String, "chat", 10, qos_overriding_options=options)

    assert publisher.qos_profile.reliability is ReliabilityPolicy.BEST_EFFORT
    assert publisher.qos_profile.depth == 3
    assert node.get_parameter("qos_overrides./chat.publisher.history").value == "keep_last"


@pytest.mark.parametrize("value", ["no_such", 5])
def test_a_quality_that_is_none_is_refused(ros_runtime, value):
    import rclpy
    from rclpy.parameter import Parameter
    from rclpy.qos_overriding_options import (
        InvalidQosOverridesError,
        QosCallbackResult,
        QoSOverridingOptions,
    )
    from std_msgs.msg import String

    def refuse(profile):
        return QosCallbackResult(successful=False, reason="too deep")

    rclpy.init()
    name = "qos_overrides./chat.publisher.reliability" if value != 5 else "other"
    node = rclpy.create_node("talker", parameter_overrides=[Parameter(name, value=value)])
    options = QoSOverridingOptions.with_default_policies(callback=refuse)

    with pytest.raises(InvalidQosOverridesError, match=r"no_such|too deep"):
        node.create_publisher(String, "chat", 10, qos_overriding_options=options)


def test_ends_of_topics_and_services_have_what_else_people_call(node):
    from rclpy.qos import qos_profile_system_default
    from rclpy.service_introspection import ServiceIntrospectionState
    from std_msgs.msg import String
    from std_srvs.srv import Empty

    publisher = node.create_publisher(String, "chat", 10)
    subscription = node.create_subscription(String, "chat", lambda message: None, 10)
    client = node.create_client(Empty, "ask")
    client.configure_introspection(
        clock=node.get_clock(),
        service_event_qos_profile=qos_profile_system_default,
        introspection_state=ServiceIntrospectionState.METADATA,
    )

    assert publisher.wait_for_all_acked()
    assert subscription.get_publisher_count() == 1
    assert client.introspection_state is ServiceIntrospectionState.METADATA
