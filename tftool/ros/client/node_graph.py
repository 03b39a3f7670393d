"""What a node can ask about the others."""

from tftool.ros.client.member import Member
from tftool.runtime.world import World


class NodeGraph:
    """What a node has to do with the graph."""

    _tftool: Member

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        """Block until a node is there."""
        wanted = fully_qualified_node_name.strip("/")
        return self._tftool.wait_until(
            lambda: any(one.name == wanted for one in self._tftool.world.nodes if one.is_shown),
            timeout,
        )

    def get_node_names(self) -> list[str]:
        """The names of all nodes."""

        def names_of() -> list[str]:
            return [one.name for one in self._tftool.world.nodes if one.is_shown]

        found: list[str] = self._tftool.program.ask(names_of)
        return found

    def get_topic_names_and_types(self, no_demangle: bool = False) -> list[tuple[str, list[str]]]:
        """Every topic, and what ROS nodes exchange on it."""

        def topics() -> list[tuple[str, list[str]]]:
            found = []
            for name in sorted(self._tftool.world.topics()):
                ends = [*self._tftool.graph.publishers.get(name, []),
                        *self._tftool.graph.subscriptions.get(name, [])]  # fmt: skip
                kinds = {end.msg_type.interface__ for end in ends}
                found.append((f"/{name}", sorted(kinds) or [_ros_name(self._tftool.world, name)]))
            return found

        listed: list[tuple[str, list[str]]] = self._tftool.program.ask(topics)
        return listed

    def get_service_names_and_types(self) -> list[tuple[str, list[str]]]:
        """Every service."""

        def services() -> list[tuple[str, list[str]]]:
            return [(f"/{name}", []) for name in sorted(self._tftool.world.services())]

        listed: list[tuple[str, list[str]]] = self._tftool.program.ask(services)
        return listed

    def count_publishers(self, topic_name: str) -> int:
        """How many ROS nodes publish a topic."""
        return len(self._tftool.graph.publishers.get(self._tftool.full(topic_name), []))

    def count_subscribers(self, topic_name: str) -> int:
        """How many listen to a topic."""
        full = self._tftool.full(topic_name)

        def count() -> int:
            topic = self._tftool.world.topics().get(full)
            return 0 if topic is None else topic.subscribers

        return int(self._tftool.program.ask(count))


def _ros_name(world: World, topic: str) -> str:
    kind = world.topics()[topic].kind.__name__
    return {
        "Pose2D": "turtlesim/msg/Pose",
        "Twist2D": "geometry_msgs/msg/Twist",
        "Color": "turtlesim/msg/Color",
        "TransformMessage": "tf2_msgs/msg/TFMessage",
        "PointStamped": "geometry_msgs/msg/PointStamped",
    }.get(kind, kind)
