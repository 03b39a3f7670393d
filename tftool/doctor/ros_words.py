"""Commands and settings of ROS 1 and ROS 2 for the texts of remedies."""

from collections.abc import Mapping

from tftool.doctor.evidence import Evidence

_ROS2 = {
    "publishers": "ros2 topic info --verbose",
    "sim_time": "set use_sim_time: {setting} for the nodes that publish them; `ros2 param get NODE "
    "use_sim_time` prints a node's setting",
    "which_clock": "`ros2 param get NODE use_sim_time` and `date` on its computer show which",
    "sim_time_of": "use_sim_time: {setting} for the node that publishes {edge}",
    "play_again": "play with --clock and set use_sim_time: true; in Python on humble restart, or "
    "clear the buffer",
    "loop_option": "`ros2 bag play` without --loop",
    "jumped_back": "C++ listeners clear their buffers, Python ones up to humble refuse all new "
    "data as old (TF_OLD_DATA) until the old time is reached again",
    "record": "record /tf and /tf_static",
    "buffer": "Buffer(cache_time=Duration(seconds={needed}))",
    "remap": "--ros-args -r /tf:={moving} -r /tf_static:={static}",
    "scoped": "in Gazebo, give the sensor the name in tf: <gz_frame_id>NAME</gz_frame_id>",
    "latched": "with durability transient_local",
    "volatile": "volatile",
}
_ROS1 = {
    "publishers": "rostopic info",
    "which_clock": "`rosparam get use_sim_time` and `date` on its computer show which",
    "sim_time": "`rosparam set use_sim_time {setting}`, then start the nodes that publish them "
    "again: a node reads it only at its start",
    "sim_time_of": "`rosparam set use_sim_time {setting}` before the publisher of {edge} starts",
    "play_again": "`rosparam set use_sim_time true` before any node starts, and play with --clock; "
    "restart listeners that keep the old data",
    "loop_option": "`rosbag play` without -l",
    "jumped_back": "listeners on simulated time clear their buffers, others refuse all new data as "
    "old (TF_OLD_DATA) until the old time is reached again",
    "record": "record /tf and /tf_static (split recordings: rosbag record --repeat-latched)",
    "buffer": "tf2_ros.Buffer(rospy.Duration({needed}))",
    "remap": "/tf:={moving} /tf_static:={static}",
    "scoped": "in Gazebo, give the sensor the name in tf: <frameName>NAME</frameName>",
    "latched": "latched",
    "volatile": "without latching",
}
_BOTH = {name: f"{text} (ROS 1: {_ROS1[name]})" for name, text in _ROS2.items()}


def is_ros1(evidence: Evidence) -> bool:
    """Whether evidence comes from ROS 1: from a ROS 1 bag, or in the message encoding of ROS 1."""
    return evidence.kind == "ROS 1 bag" or any(one.encoding == "ros1" for one in evidence.topics)


def ros_words(evidence: Evidence) -> Mapping[str, str]:
    """Return the commands and settings of ROS 1 or ROS 2, by placeholder; ROS 2 if unknown."""
    return _ROS1 if is_ros1(evidence) else _ROS2


def in_words(text: str, words: Mapping[str, str] = _BOTH) -> str:
    """Replace the placeholders of commands in a check's text.

    Args:
        text: The text.
        words: Commands and settings, by placeholder; by default of both ROS 1 and ROS 2.
    """
    for name, word in words.items():
        text = text.replace(f"{{{name}}}", word)
    return text
