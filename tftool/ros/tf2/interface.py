"""tf2_ros: methods that every buffer has once it can look transforms up."""

from typing import Any

from tftool.ros.rclpy.time import Duration
from tftool.ros.tf2.registry import NotImplementedException, Registration, convert

NOW = Duration()
"""No waiting."""


class BufferInterface:
    """Transforms stamped data; subclasses look the transforms up."""

    def __init__(self) -> None:
        self.registration = Registration()

    def _refuse(self, *asked: Any, **named: Any) -> Any:
        """Look nothing up.

        Raises:
            NotImplementedException: If the class does not implement it.
        """
        raise NotImplementedException

    lookup_transform = lookup_transform_full = can_transform = can_transform_full = _refuse

    def transform(
        self, object_stamped: Any, target_frame: str, timeout: Any = NOW, new_type: Any = None
    ) -> Any:
        """Transform stamped data to another frame.

        Raises:
            TypeException: If it is not registered how to transform such data.
        """
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        return _converted(do_transform(object_stamped, found), new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Any,
        fixed_frame: str,
        timeout: Any = NOW,
        new_type: Any = None,
    ) -> Any:
        """Transform stamped data to another frame at another time."""
        do_transform = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        return _converted(do_transform(object_stamped, found), new_type)


def _converted(result: Any, new_type: Any) -> Any:
    return result if new_type is None else convert(result, new_type)
