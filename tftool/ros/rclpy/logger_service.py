"""Services for reading and setting the levels of a node's loggers, on request."""

from collections.abc import Callable, Iterator
from typing import Any

from tftool.messages.classes import INTERFACES
from tftool.ros.host import program
from tftool.ros.rclpy.logging import LoggingSeverity, set_logger_level

_NO_LEVEL = "Failed reason: Invalid logger level."


def logger_services() -> Iterator[tuple[str, Any, Callable[[Any, Any], Any]]]:
    """Yield each service's name below its node, its type, and its handler."""
    level_kind: Any = INTERFACES.message("rcl_interfaces/LoggerLevel")
    result_kind: Any = INTERFACES.message("rcl_interfaces/SetLoggerLevelsResult")

    def get(request: Any, response: Any) -> Any:
        levels = program.current().log_levels
        response.levels = [
            level_kind(name=name, level=levels.get(name, LoggingSeverity.UNSET))
            for name in request.names
        ]
        return response

    def change(wanted: Any) -> Any:
        try:
            set_logger_level(wanted.name, wanted.level)
        except ValueError:
            return result_kind(successful=False, reason=_NO_LEVEL)
        return result_kind(successful=True)

    def set_levels(request: Any, response: Any) -> Any:
        response.results = [change(one) for one in request.levels]
        return response

    for name, kind, answer in (
        ("get_logger_levels", "GetLoggerLevels", get),
        ("set_logger_levels", "SetLoggerLevels", set_levels),
    ):
        yield name, INTERFACES.find("rcl_interfaces", "srv", kind), answer
