"""A node's log on `/rosout`, for other programs."""

from typing import Any

from tftool.messages.classes import INTERFACES
from tftool.ros.host import values
from tftool.ros.rclpy.qos import QoSProfile, qos_profile_rosout_default
from tftool.ros.rclpy.seat import NodeSeat
from tftool.ros.rclpy.topics import Publisher

TOPIC = "rosout"


class RosoutPublisher(Publisher):
    """Publisher of the lines of one node's loggers.

    Attributes:
        logger: The name of the node's logger.
    """

    def __init__(self, seat: NodeSeat, logger: str, profile: QoSProfile | None) -> None:
        """Start publishing.

        Args:
            seat: The node's.
            logger: The name of the node's logger; those of its children begin with it.
            profile: How to publish, None as ROS 2 does.
        """
        kind: Any = INTERFACES.message("rcl_interfaces/Log")
        super().__init__(seat, kind, f"/{TOPIC}", TOPIC, profile or qos_profile_rosout_default)
        self.logger = logger

    def speaks_for(self, logger: str) -> bool:
        """Return whether a logger is the node's, or a child of it."""
        return logger == self.logger or logger.startswith(f"{self.logger}.")

    def tell(self, level: int, logger: str, text: str, place: tuple[str, str, int]) -> None:
        """Publish a line (in the loop's thread); `place` is its file, function and number."""
        file, function, line = place
        message = self.msg_type(
            stamp=values.time_message(self.seat.now()),
            level=level,
            name=logger,
            msg=text,
            file=file,
            function=function,
            line=line,
        )
        self._send(message)
