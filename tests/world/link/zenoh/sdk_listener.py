"""Listener on played data with another implementation of ROS 2 over zenoh; see `sdk_peer`.

`python sdk_listener.py PORT DEFINITIONS`
"""

import json
import sys
import threading

from zenoh_ros2_sdk import ROS2Subscriber, ZenohSession, get_registry
from zenoh_ros2_sdk.qos import QosDurability, QosProfile

PORT, DEFINITIONS = int(sys.argv[1]), sys.argv[2]


def tell(**what):
    sys.stdout.write(json.dumps(what) + "\n")
    sys.stdout.flush()


def hear(topic):
    def heard(message):
        for one in message.transforms:
            stamp, at = one.header.stamp, one.transform.translation
            tell(
                topic=topic,
                child=one.child_frame_id,
                stamp=stamp.sec * 10**9 + stamp.nanosec,
                at=[at.x, at.y, at.z],
            )

    return heard


session = ZenohSession.get_instance("127.0.0.1", PORT)
registry = get_registry(DEFINITIONS)
for name in ("tf2_msgs/msg/TFMessage", "rosgraph_msgs/msg/Clock", "sensor_msgs/msg/LaserScan"):
    registry.load_message_type(name)

TF = {"msg_type": "tf2_msgs/msg/TFMessage", "router_port": PORT}
latched = QosProfile(durability=QosDurability.TRANSIENT_LOCAL, history_depth=100)
listening = [
    ROS2Subscriber("/tf", callback=hear("tf"), **TF),
    ROS2Subscriber("/tf_static", callback=hear("tf_static"), qos=latched, **TF),
    ROS2Subscriber(
        "/clock",
        callback=lambda told: tell(clock=told.clock.sec * 10**9 + told.clock.nanosec),
        msg_type="rosgraph_msgs/msg/Clock",
        router_port=PORT,
    ),
    ROS2Subscriber(
        "/scan",
        callback=lambda told: tell(scan=told.header.frame_id, count=len(told.ranges)),
        msg_type="sensor_msgs/msg/LaserScan",
        router_port=PORT,
    ),
]
threading.Event().wait()
