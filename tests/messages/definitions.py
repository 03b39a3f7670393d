"""ROS definitions of the messages that a link carries, and their hashes as rosbags computes them.

rosbags hashes messages itself. Services and actions consist of messages (request, response, event;
goal, result, feedback), which are composed here as ROS 2's generator does.
"""

import pytest

typesys = pytest.importorskip("rosbags.typesys", reason="rosbags, of the extra 'test', is missing")
Stores, get_types_from_msg = typesys.Stores, typesys.get_types_from_msg
get_typestore = typesys.get_typestore

MESSAGES = {
    "turtlesim/msg/Pose": (
        "float32 x\nfloat32 y\nfloat32 theta\nfloat32 linear_velocity\nfloat32 angular_velocity"
    ),
    "turtlesim/msg/Color": "uint8 r\nuint8 g\nuint8 b",
}
NUMBERS = [f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)]
PLAIN = {kind.replace("uint", "UInt").replace("int", "Int"): kind for kind in NUMBERS} | {
    "Float32": "float32",
    "Float64": "float64",
    "Byte": "byte",
}
DATA = PLAIN | {"Bool": "bool", "Char": "uint8", "String": "string"}
MESSAGES |= {f"example_interfaces/msg/{name}": f"{kind} data" for name, kind in DATA.items()}
MESSAGES |= {
    f"example_interfaces/msg/{name}MultiArray": (
        f"example_interfaces/MultiArrayLayout layout\n{kind}[] data"
    )
    for name, kind in PLAIN.items()
}
MESSAGES |= {
    "example_interfaces/msg/Empty": "",
    "example_interfaces/msg/MultiArrayDimension": "string label\nuint32 size\nuint32 stride",
    "example_interfaces/msg/MultiArrayLayout": (
        "example_interfaces/MultiArrayDimension[] dim\nuint32 data_offset"
    ),
}
MESSAGES |= {
    f"turtlesim_msgs/msg/{name}": MESSAGES[f"turtlesim/msg/{name}"] for name in ("Pose", "Color")
}

EVENT_INFO = (
    "uint8 event_type\nbuiltin_interfaces/Time stamp\nuint8[16] client_gid\nint64 sequence_number"
)

SERVICES = {
    "turtlesim/srv/Spawn": ("float32 x\nfloat32 y\nfloat32 theta\nstring name", "string name"),
    "turtlesim/srv/Kill": ("string name", ""),
    "turtlesim/srv/SetPen": ("uint8 r\nuint8 g\nuint8 b\nuint8 width\nuint8 off", ""),
    "turtlesim/srv/TeleportAbsolute": ("float32 x\nfloat32 y\nfloat32 theta", ""),
    "turtlesim/srv/TeleportRelative": ("float32 linear\nfloat32 angular", ""),
    "std_srvs/srv/Empty": ("", ""),
    "example_interfaces/srv/AddTwoInts": ("int64 a\nint64 b", "int64 sum"),
    "action_msgs/srv/CancelGoal": (
        "action_msgs/GoalInfo goal_info",
        "int8 return_code\naction_msgs/GoalInfo[] goals_canceling",
    ),
    "rcl_interfaces/srv/GetParameters": (
        "string[] names",
        "rcl_interfaces/ParameterValue[] values",
    ),
    "rcl_interfaces/srv/SetParameters": (
        "rcl_interfaces/Parameter[] parameters",
        "rcl_interfaces/SetParametersResult[] results",
    ),
}

ACTIONS = {
    "example_interfaces/action/Fibonacci": ("int32 order", "int32[] sequence", "int32[] sequence"),
    "turtlesim/action/RotateAbsolute": ("float32 theta", "float32 delta", "float32 remaining"),
}


def empty_store():
    """Return a rosbags type store without types."""
    return get_typestore(Stores.EMPTY)


def store():
    """Return a rosbags type store with every type above, and the types of their fields."""
    types = get_typestore(Stores.ROS2_JAZZY)
    # The definition has gid as char[16]; ROS 2 hashes its form in IDL, uint8[16].
    del types.fielddefs["service_msgs/msg/ServiceEventInfo"]
    del types.types["service_msgs/msg/ServiceEventInfo"]
    register(types, "service_msgs/msg/ServiceEventInfo", EVENT_INFO)
    for name, text in MESSAGES.items():
        register(types, name, text)
    for name, (request, response) in SERVICES.items():
        _service(types, name, request, response)
    for name, (goal, result, feedback) in ACTIONS.items():
        uuid = "unique_identifier_msgs/UUID goal_id\n"
        register(types, f"{name}_Goal", goal)
        register(types, f"{name}_Result", result)
        register(types, f"{name}_Feedback", feedback)
        _service(
            types,
            f"{name}_SendGoal",
            f"{uuid}{name}_Goal goal",
            "bool accepted\nbuiltin_interfaces/Time stamp",
        )
        _service(types, f"{name}_GetResult", uuid, f"int8 status\n{name}_Result result")
        register(types, f"{name}_FeedbackMessage", f"{uuid}{name}_Feedback feedback")
    return types


def _service(types, name, request, response):
    register(types, f"{name}_Request", request)
    register(types, f"{name}_Response", response)
    register(
        types,
        f"{name}_Event",
        "service_msgs/ServiceEventInfo info\n"
        f"{name}_Request[<=1] request\n{name}_Response[<=1] response",
    )
    register(
        types,
        name,
        f"{name}_Request request_message\n{name}_Response response_message\n"
        f"{name}_Event event_message",
    )


def register(types, name, text):
    """Add a structure to a type store, whatever its folder is."""
    if name not in types.fielddefs:
        found = get_types_from_msg(text, name)
        # rosbags stores types of a srv folder under srv/msg; ROS 2 hashes them under srv.
        types.register({_plain(key): _plain(value) for key, value in found.items()})


def _plain(part):
    if isinstance(part, str):
        return part.replace("/srv/msg/", "/srv/").replace("/action/msg/", "/action/")
    return type(part)(_plain(one) for one in part) if isinstance(part, tuple | list) else part
