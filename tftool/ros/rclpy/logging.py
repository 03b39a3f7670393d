"""Loggers of rclpy, which write to tftool's log."""

import inspect
import os
from collections.abc import Iterator
from enum import IntEnum
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

from tftool.base.stamps import Duration, Stamp, seconds
from tftool.messages.classes import INTERFACES
from tftool.ros.host import program
from tftool.world.log import Level
from tftool.world.node_parameters import Answer, answered


class LoggingSeverity(IntEnum):
    """Severity of a log message."""

    UNSET = 0
    DEBUG = 10
    INFO = 20
    WARN = 30
    ERROR = 40
    FATAL = 50


_LEVELS: dict[int, Level] = {10: "DEBUG", 20: "INFO", 30: "WARN", 40: "ERROR", 50: "FATAL"}


class SkipFirst:
    """Placeholder for rclpy's implementation of `skip_first=True`; the class has no effect."""


class RcutilsLogger:
    """Named logger, which drops messages less severe than the logger's level."""

    def __init__(self, name: str = "") -> None:
        self.name = name
        self._calls: dict[tuple[CodeType, int] | None, _Call] = {}

    def get_child(self, name: str) -> "RcutilsLogger":
        """Return the child logger `name` of this logger.

        Raises:
            ValueError: If the name is empty.
        """
        if not name:
            raise ValueError("Child logger name must not be empty.")
        return RcutilsLogger(f"{self.name}.{name}" if self.name else name)

    def set_level(self, level: int) -> None:
        """Set this logger's level, the lowest severity that the logger does not drop."""
        program.current().log_levels[self.name] = int(LoggingSeverity(level))

    def get_effective_level(self) -> LoggingSeverity:
        """Return the level of this logger, else of the nearest parent with a level, else INFO."""
        levels = program.current().log_levels
        name = self.name
        while name:
            if levels.get(name):
                return LoggingSeverity(levels[name])
            name = name.rpartition(".")[0]
        return LoggingSeverity(levels.get("", LoggingSeverity.INFO))

    def is_enabled_for(self, severity: int) -> bool:
        """Return whether messages of a severity are logged."""
        return severity >= self.get_effective_level()

    def log(
        self,
        message: object,
        severity: int,
        *,
        once: bool = False,
        skip_first: bool = False,
        throttle_duration_sec: float | None = None,
        throttle_time_source_type: Any = None,
        name: str = "",
    ) -> bool:
        """Log a message; return whether the message was logged.

        The filters `once`, `skip_first` and `throttle_duration_sec` count separately for each line
        of the user's code that logs. With several filters, a message is logged only if all filters
        permit it.

        Raises:
            ValueError: If a line of code changes its severity, name or filters between two calls,
                which ROS 2 forbids.
        """
        owner = program.running()
        if owner is None:
            return False
        frame = _caller_frame()
        # The last instruction's index distinguishes two calls on one line.
        place = (frame.f_code, frame.f_lasti) if frame is not None else None
        wait = 0 if throttle_duration_sec is None else seconds(throttle_duration_sec)
        made_with = (int(severity), name or self.name, (once, skip_first, wait))
        call = self._calls.setdefault(place, _Call(*made_with))
        for what, before, now in zip(_UNCHANGED, call.made_with, made_with, strict=True):
            if before != now:
                raise ValueError(f"{what} cannot be changed between calls.")
        goes_by = throttle_time_source_type
        now = goes_by.now().nanoseconds if hasattr(goes_by, "now") else owner.clock.now()
        if not self.is_enabled_for(severity) or not call.passes(now):
            return False
        level = _LEVELS[int(severity)]
        speaker = name or self.name
        text = str(message)

        # Read the line number here, because the frame continues while the loop works.
        line = 0 if frame is None else frame.f_lineno

        def say() -> None:
            owner.say(level, speaker, text)
            rosout = _rosout_of(owner, speaker)
            if rosout is not None:
                place = ("", "", 0)
                if frame is not None:
                    place = frame.f_code.co_filename, frame.f_code.co_name, line
                rosout.publish_record(int(severity), speaker, text, place)

        owner.ask(say)
        return True

    def debug(self, message: object, **kwargs: Any) -> bool:
        """Log a message with severity DEBUG; return whether the message was logged."""
        return self.log(message, LoggingSeverity.DEBUG, **kwargs)

    def info(self, message: object, **kwargs: Any) -> bool:
        """Log a message with severity INFO; return whether the message was logged."""
        return self.log(message, LoggingSeverity.INFO, **kwargs)

    def warning(self, message: object, **kwargs: Any) -> bool:
        """Log a message with severity WARN; return whether the message was logged."""
        return self.log(message, LoggingSeverity.WARN, **kwargs)

    warn = warning

    def error(self, message: object, **kwargs: Any) -> bool:
        """Log a message with severity ERROR; return whether the message was logged."""
        return self.log(message, LoggingSeverity.ERROR, **kwargs)

    def fatal(self, message: object, **kwargs: Any) -> bool:
        """Log a message with severity FATAL; return whether the message was logged."""
        return self.log(message, LoggingSeverity.FATAL, **kwargs)


_UNCHANGED = ("Logger severity", "Logger name", "Logging filter parameters")


class _Call:
    """Record of one line of the user's code that logs: severity, logger, filters and counts."""

    def __init__(self, severity: int, name: str, filters: tuple[bool, bool, Duration]) -> None:
        self.made_with = (severity, name, filters)
        once, self._skip, self._throttle = filters
        self._left = 1 if once else None
        self._last: Stamp = 0

    def passes(self, now: Stamp) -> bool:
        """Return whether the filters permit a message at the time `now`; count the message."""
        if self._throttle:
            if now < self._last + self._throttle:
                return False
            self._last = now
        if self._skip:
            self._skip = False
            return False
        if self._left is not None:
            self._left -= 1
            return self._left >= 0
        return True


def _rosout_of(owner: program.Program, logger: str) -> Any:
    """Return the /rosout publisher of the node that a logger belongs to.

    The node's logger is `logger` itself or its nearest parent. Return None if there is no such
    node.
    """
    told = [state.rosout for state in owner.nodes if state.rosout is not None]
    fitting = (one for one in told if one.speaks_for(logger))
    return max(fitting, key=lambda rosout: len(rosout.logger), default=None)


def _caller_frame() -> FrameType | None:
    frame = inspect.currentframe()
    while frame is not None and frame.f_code.co_filename == __file__:
        frame = frame.f_back
    return frame


_root_logger = RcutilsLogger()


def get_logger(name: str) -> RcutilsLogger:
    """Return the logger named `name`.

    Raises:
        ValueError: If the name is empty.
    """
    if not name:
        raise ValueError("Logger name must not be empty.")
    return RcutilsLogger(name)


def set_logger_level(name: str, level: int, detailed_error: bool = False) -> None:
    """Set the level of the logger `name`, which then drops less severe messages."""
    program.current().log_levels[name] = int(LoggingSeverity(level))


def get_logger_effective_level(name: str) -> LoggingSeverity:
    """Return the lowest severity that the logger `name` does not drop."""
    return RcutilsLogger(name).get_effective_level()


def get_logging_severity_from_string(log_severity: str) -> LoggingSeverity:
    """Return the severity for a name such as "info".

    Raises:
        RuntimeError: If there is no severity of this name.
    """
    try:
        return LoggingSeverity[log_severity.upper()]
    except KeyError:
        raise RuntimeError(
            f"'{log_severity}' is not a severity of logging: use LoggingSeverity.INFO, for example"
        ) from None


def clear_config() -> None:
    """Forget the level set for each logger, so that all loggers use the default level again."""
    program.current().log_levels.clear()


def get_logging_directory() -> Path:
    """Return ROS 2's folder of log files.

    The folder is the value of `ROS_LOG_DIR`, else `log` in the folder `ROS_HOME`, else
    `~/.ros/log`.
    """
    told = os.environ.get("ROS_LOG_DIR")
    home = os.environ.get("ROS_HOME") or "~/.ros"
    return Path(told).expanduser() if told else Path(home).expanduser() / "log"


def initialize() -> None:
    """Do nothing, because tftool's logging needs no initialisation."""


def shutdown() -> None:
    """Do nothing, because tftool's logging needs no shutdown."""


_NO_LEVEL = "Failed reason: Invalid logger level."


def logger_services() -> Iterator[tuple[str, Any, Answer]]:
    """Yield (name, type, handler) of the services that read and set a node's logger levels.

    The names are relative to the node's name.
    """
    level_kind: Any = INTERFACES.message("rcl_interfaces/LoggerLevel")
    result_kind: Any = INTERFACES.message("rcl_interfaces/SetLoggerLevelsResult")

    def get(asked: Any) -> Any:
        levels = program.current().log_levels
        return [
            level_kind(name=name, level=levels.get(name, LoggingSeverity.UNSET))
            for name in asked.names
        ]

    def change(wanted: Any) -> Any:
        try:
            set_logger_level(wanted.name, wanted.level)
        except ValueError:
            return result_kind(successful=False, reason=_NO_LEVEL)
        return result_kind(successful=True)

    return answered(
        "rcl_interfaces",
        ("get_logger_levels", "levels", get),
        ("set_logger_levels", "results", lambda asked: [change(one) for one in asked.levels]),
    )
