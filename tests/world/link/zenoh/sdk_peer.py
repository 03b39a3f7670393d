"""Peer of another implementation of ROS 2, zenoh-ros2-sdk, as a process that a test controls.

`python sdk_peer.py PORT DEFINITIONS` joins the router at 127.0.0.1:PORT, and prints its received
messages and responses as one JSON object per line.
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
registry.load_message_type("std_msgs/msg/String")
registry.load_message_type("rcl_interfaces/msg/Parameter")
types = session.store.types

TF = {"msg_type": "tf2_msgs/msg/TFMessage", "router_port": PORT}
latched = QosProfile(durability=QosDurability.TRANSIENT_LOCAL, history_depth=100)
listening = [
    ROS2Subscriber("/tf", callback=hear("tf"), **TF),
    ROS2Subscriber("/tf_static", callback=hear("tf_static"), qos=latched, **TF),
]
STRING = {"msg_type": "std_msgs/msg/String", "router_port": PORT}
listening.append(
    ROS2Subscriber("/chatter", callback=lambda message: tell(chatter=message.data), **STRING)
)
words = ROS2Publisher("/words", node_name="foreign_talker", **STRING)
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
    words.publish(data="größe")
    twists.publish(linear=Vector3(1.0, 0.0, 0.0), angular=Vector3(0.0, 0.0, 0.5))


def ask(kind, **request):
    name = {"GetParameters": "get_parameters", "SetParameters": "set_parameters"}[kind]
    client = ROS2ServiceClient(
        f"/turtlesim/{name}",
        srv_type=f"rcl_interfaces/srv/{kind}",
        router_port=PORT,
        timeout=180.0,
    )
    return client.call(**request)


def change(name, number):
    none = np.array([], dtype=np.int64)
    value = types["rcl_interfaces/msg/ParameterValue"](
        2, False, number, 0.0, "", none.astype(np.uint8), none.astype(bool), none,
        none.astype(np.float64), [],
    )  # fmt: skip
    parameter = types["rcl_interfaces/msg/Parameter"](name, value)
    (result,) = ask("SetParameters", parameters=[parameter]).results
    return {"successful": bool(result.successful), "reason": result.reason}


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
                "/spawn", srv_type="turtlesim/srv/Spawn", router_port=PORT, timeout=180.0
            )
            answer = client.call(
                x=np.float32(3.0), y=np.float32(4.0), theta=np.float32(0.0), name="sdk_turtle"
            )
            tell(spawned=None if answer is None else answer.name)
            for tried in (255, 256):
                tell(set=tried, **change("background_r", tried))
            answer = ask("GetParameters", names=["background_r", "holonomic"])
            tell(parameters=[[one.type, int(one.integer_value)] for one in answer.values])
    threading.Event().wait(0.1)
