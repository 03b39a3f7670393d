"""A ROS 2 peer that is not ours, as a process: zenoh-ros2-sdk, told by the test what to do.

`python sdk_peer.py PORT DEFINITIONS`: joins the router at 127.0.0.1:PORT and prints,
one JSON object a line, what it hears and what it is answered.
"""

import json
import sys
import threading
import time

import numpy as np
from zenoh_ros2_sdk import (
    ROS2Publisher,
    ROS2ServiceClient,
    ROS2Subscriber,
    ZenohSession,
    get_registry,
    get_service_names_and_types,
    get_topic_names_and_types,
)
from zenoh_ros2_sdk.qos import QosDurability, QosProfile

PORT, DEFINITIONS = int(sys.argv[1]), sys.argv[2]


def tell(**what):
    sys.stdout.write(json.dumps(what) + "\n")
    sys.stdout.flush()


def hear(topic):
    def heard(message):
        for one in message.transforms:
            at = one.transform.translation
            tell(
                topic=topic,
                parent=one.header.frame_id,
                child=one.child_frame_id,
                x=at.x,
                w=one.transform.rotation.w,
            )

    return heard


session = ZenohSession.get_instance("127.0.0.1", PORT)
registry = get_registry(DEFINITIONS)
registry.load_message_type("tf2_msgs/msg/TFMessage")
registry.load_message_type("geometry_msgs/msg/Twist")
types = session.store.types

TF = {"msg_type": "tf2_msgs/msg/TFMessage", "router_port": PORT}
latched = QosProfile(durability=QosDurability.TRANSIENT_LOCAL, history_depth=100)
listening = [
    ROS2Subscriber("/tf", callback=hear("tf"), **TF),
    ROS2Subscriber("/tf_static", callback=hear("tf_static"), qos=latched, **TF),
]
transforms = ROS2Publisher("/tf", node_name="foreign_broadcaster", **TF)
twists = ROS2Publisher("/turtle1/cmd_vel", msg_type="geometry_msgs/msg/Twist", router_port=PORT)
Vector3 = types["geometry_msgs/msg/Vector3"]


def send():
    now = time.time_ns()
    stamp = types["builtin_interfaces/msg/Time"](now // 10**9, now % 10**9)
    transforms.publish(
        transforms=[
            types["geometry_msgs/msg/TransformStamped"](
                types["std_msgs/msg/Header"](stamp, "world"),
                "foreign",
                types["geometry_msgs/msg/Transform"](
                    Vector3(1.5, -2.5, 3.5),
                    types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.6, 0.8),
                ),
            )
        ]
    )
    twists.publish(linear=Vector3(1.0, 0.0, 0.0), angular=Vector3(0.0, 0.0, 0.5))


tell(ready=True)
asked = False
while True:
    send()
    if not asked:
        names = dict(get_topic_names_and_types(router_port=PORT))
        services = dict(get_service_names_and_types(router_port=PORT))
        if "/spawn" in services and "/turtle1/pose" in names:
            asked = True
            tell(topics=names, services=services)
            client = ROS2ServiceClient(
                "/spawn", srv_type="turtlesim/srv/Spawn", router_port=PORT, timeout=10.0
            )
            answer = client.call(
                x=np.float32(3.0), y=np.float32(4.0), theta=np.float32(0.0), name="sdk_turtle"
            )
            tell(spawned=None if answer is None else answer.name)
    threading.Event().wait(0.1)
