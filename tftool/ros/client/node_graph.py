"""What a node can ask about the others."""

from tftool.link import types
from tftool.ros import values
from tftool.ros.client.member import Member
from tftool.runtime.endpoints import PUBLISHER, SUBSCRIPTION
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
            world = self._tftool.world
            found = {name: {_ros_name(world, name)} for name in world.topics()}
            for name in world.endpoints.topics():
                ends = [
                    *world.endpoints.of(name, PUBLISHER),
                    *world.endpoints.of(name, SUBSCRIPTION),
                ]
                found[name] = {end.interface for end in ends}
            return [(f"/{name}", sorted(kinds)) for name, kinds in sorted(found.items())]

        listed: list[tuple[str, list[str]]] = self._tftool.program.ask(topics)
        return listed

    def get_service_names_and_types(self) -> list[tuple[str, list[str]]]:
        """Every service, and its type where that is known."""

        def services() -> list[tuple[str, list[str]]]:
            offers = self._tftool.world.services()
            return [
                (f"/{name}", [known] if (known := values.type_of(offer.kind)) else [])
                for name, offer in sorted(offers.items())
            ]

        listed: list[tuple[str, list[str]]] = self._tftool.program.ask(services)
        return listed

    def count_publishers(self, topic_name: str) -> int:
        """How many publish a topic, of those that say so."""
        full = self._tftool.full(topic_name)
        endpoints = self._tftool.world.endpoints
        return int(self._tftool.program.ask(lambda: len(endpoints.of(full, PUBLISHER))))

    def count_subscribers(self, topic_name: str) -> int:
        """How many listen to a topic."""
        full = self._tftool.full(topic_name)

        def count() -> int:
            topic = self._tftool.world.topics().get(full)
            return 0 if topic is None else topic.subscribers

        return int(self._tftool.program.ask(count))


def _ros_name(world: World, topic: str) -> str:
    kind = world.topics()[topic].kind
    return types.topic_name(kind) or str(kind.__name__)
