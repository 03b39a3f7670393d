"""rclpy's loggers, speaking into the world's log."""

import inspect
from enum import IntEnum
from typing import Any

from tftool.ros import fibers, program
from tftool.runtime.log import Level


class LoggingSeverity(IntEnum):
    """How much a line matters."""

    UNSET = 0
    DEBUG = 10
    INFO = 20
    WARN = 30
    ERROR = 40
    FATAL = 50


_LEVELS: dict[int, Level] = {10: "DEBUG", 20: "INFO", 30: "WARN", 40: "ERROR", 50: "ERROR"}


class RcutilsLogger:
    """Speaks under one name."""

    def __init__(self, name: str = "") -> None:
        self.name = name
        self._seen: dict[tuple[str, int], int] = {}

    def get_child(self, name: str) -> "RcutilsLogger":
        """A logger named below this one.

        Raises:
            ValueError: If the name is empty.
        """
        if not name:
            raise ValueError("Child logger name must not be empty.")
        return RcutilsLogger(f"{self.name}.{name}" if self.name else name)

    def set_level(self, level: int) -> None:
        """Say nothing that matters less."""
        program.current().log_levels[self.name] = int(LoggingSeverity(level))

    def get_effective_level(self) -> LoggingSeverity:
        """From which level on lines are said."""
        levels = program.current().log_levels
        name = self.name
        while name:
            if levels.get(name):
                return LoggingSeverity(levels[name])
            name = name.rpartition(".")[0]
        return LoggingSeverity(levels.get("") or LoggingSeverity.INFO)

    def is_enabled_for(self, severity: int) -> bool:
        """Whether a line of that level would be said."""
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
    ) -> bool:
        """Say a line; whether it was said.

        `once`, `skip_first` and `throttle_duration_sec` count per line of code.
        """
        if fibers.current() is None or not self.is_enabled_for(severity):
            return False
        owner = program.current()
        if once or skip_first or throttle_duration_sec is not None:
            place = _caller()
            last = self._seen.get(place)
            now = owner.clock.now()
            if last is None:
                self._seen[place] = now
                if skip_first:
                    return False
            elif once:
                return False
            elif throttle_duration_sec is not None:
                if now - last < throttle_duration_sec * 1e9:
                    return False
                self._seen[place] = now
        level = _LEVELS[int(severity)]
        owner.ask(lambda: owner.world.log.add(level, self.name, str(message)))
        return True

    def debug(self, message: object, **kwargs: Any) -> bool:
        """Say something for whoever looks for a fault."""
        return self.log(message, LoggingSeverity.DEBUG, **kwargs)

    def info(self, message: object, **kwargs: Any) -> bool:
        """Say what happens."""
        return self.log(message, LoggingSeverity.INFO, **kwargs)

    def warning(self, message: object, **kwargs: Any) -> bool:
        """Say what is odd."""
        return self.log(message, LoggingSeverity.WARN, **kwargs)

    warn = warning

    def error(self, message: object, **kwargs: Any) -> bool:
        """Say what went wrong."""
        return self.log(message, LoggingSeverity.ERROR, **kwargs)

    def fatal(self, message: object, **kwargs: Any) -> bool:
        """Say what ends everything."""
        return self.log(message, LoggingSeverity.FATAL, **kwargs)


def _caller() -> tuple[str, int]:
    frame = inspect.currentframe()
    while frame is not None and frame.f_code.co_filename == __file__:
        frame = frame.f_back
    return ("", 0) if frame is None else (frame.f_code.co_filename, frame.f_lineno)


_root = RcutilsLogger()


def get_logger(name: str) -> RcutilsLogger:
    """The logger of a name.

    Raises:
        ValueError: If the name is empty.
    """
    if not name:
        raise ValueError("Logger name must not be empty.")
    return RcutilsLogger(name)


def set_logger_level(name: str, level: int, detailed_error: bool = False) -> None:
    """Have the logger of a name say nothing that matters less."""
    program.current().log_levels[name] = int(LoggingSeverity(level))


def get_logger_effective_level(name: str) -> LoggingSeverity:
    """From which level on the logger of a name says lines."""
    return RcutilsLogger(name).get_effective_level()


def get_logging_severity_from_string(level: str) -> LoggingSeverity:
    """The level of a name."""
    return LoggingSeverity[level.upper()]


def initialize() -> None:
    """Nothing to do."""


def shutdown() -> None:
    """Nothing to do."""
