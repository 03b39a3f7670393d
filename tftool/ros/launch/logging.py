"""Loggers of launch.logging for launch files, separate from those of Python's `logging`.

A launch writes no log files, unless a launch file requests a handler for a file.
"""

import logging
import os
import sys
from collections.abc import Callable
from logging import FileHandler, Handler, StreamHandler
from pathlib import Path

from tftool.base.errors import UsageError
from tftool.ros.rclpy.logging import get_logging_directory

__all__ = ["FileHandler", "Handler", "LaunchConfig", "StreamHandler", "get_logger", "reset"]

_PLAIN = "[{levelname}] [{name}]: {message}"
_FORMATS = {"default": _PLAIN, "default_with_timestamp": "{created:.7f} " + _PLAIN}


class _Screen(Handler):
    """Log handler that looks up `sys.stdout` for each record, because a program can replace it."""

    def emit(self, record: logging.LogRecord) -> None:
        """Write one log record as a line."""
        sys.stdout.write(f"{self.format(record)}\n")


class LaunchConfig:
    """Settings of launch's loggers: level, formats and folder of log files."""

    def __init__(self) -> None:
        self._files: dict[str, Handler] = {}
        self.reset()

    def reset(self) -> None:
        """Close all log files, and restore the initial settings."""
        for handler in self._files.values():
            handler.close()
        self.manager = logging.Manager(logging.RootLogger(logging.INFO))
        self._log_dir: str | None = None
        self._files = {}
        self._factory: Callable[..., Handler] = FileHandler
        self._screen = _Screen()
        self._log_format: logging.Formatter | None = None
        _take_variable("OVERRIDE_LAUNCH_SCREEN_FORMAT", self.set_screen_format)
        _take_variable("OVERRIDE_LAUNCH_LOG_FORMAT", self.set_log_format)

    @property
    def level(self) -> int:
        """Lowest level that is logged."""
        return self.manager.root.level

    @level.setter
    def level(self, level: int | str) -> None:
        self.manager.root.setLevel(level)

    @property
    def log_dir(self) -> str:
        """Folder of log files; by default ROS 2's folder of log files."""
        return self._log_dir or os.path.normpath(get_logging_directory())

    @log_dir.setter
    def log_dir(self, folder: str | None) -> None:
        if folder is not None and not Path(folder).is_dir():
            raise ValueError(f"the folder of log files '{folder}' does not exist: create it first")
        self._log_dir = folder

    @property
    def log_handler_factory(self) -> Callable[..., Handler]:
        """Function that takes the path of a log file and returns a log handler."""
        return self._factory

    @log_handler_factory.setter
    def log_handler_factory(self, factory: Callable[..., Handler] | None) -> None:
        self._factory = factory or FileHandler

    def set_screen_format(self, screen_format: str, *, screen_style: str | None = None) -> None:
        """Set the format of log lines on the screen: "default", or a format such as "{message}"."""
        self._screen.setFormatter(_formatter(screen_format, screen_style))

    def set_log_format(self, log_format: str, *, log_style: str | None = None) -> None:
        """Set the format of lines in log files: "default", or a format such as "{message}"."""
        if log_format == "default":
            # The default format contains the time in log files, but not on the screen.
            _formatter(log_format, log_style)
            log_format = "default_with_timestamp"
        self._log_format = _formatter(log_format, log_style)
        for handler in self._files.values():
            handler.setFormatter(self._log_format)

    def get_screen_handler(self) -> Handler:
        """Return the log handler that writes to the screen."""
        return self._screen

    def get_log_file_path(self, file_name: str = "launch.log") -> str:
        """Return the path of the file `file_name` in the folder of log files."""
        return os.path.join(self.log_dir, file_name)

    def get_log_file_handler(self, file_name: str = "launch.log") -> Handler:
        """Return the log handler that writes to the file; create a handler at the first call."""
        if file_name not in self._files:
            Path(self.log_dir).mkdir(parents=True, exist_ok=True)
            made = self._factory(self.get_log_file_path(file_name), encoding="utf-8")
            made.setFormatter(self._log_format)
            self._files[file_name] = made
        return self._files[file_name]


def _take_variable(name: str, set_format: Callable[[str], None]) -> None:
    """Call `set_format` with an environment variable's value; "default" for an unset variable."""
    given = os.environ.get(name) or "default"
    try:
        set_format(given)
    except ValueError as error:
        raise UsageError(
            f"the environment variable {name} must be a format with braces, such as "
            f"'{{message}}', not '{given}': {error}"
        ) from None


def _formatter(text: str, style: str | None) -> logging.Formatter:
    if text in _FORMATS and style is not None:
        raise ValueError(f"the format '{text}' mixes styles: omit the style {style!r}")
    return logging.Formatter(_FORMATS.get(text, text), style=style or "{")  # type: ignore[arg-type]


launch_config = LaunchConfig()


def get_logger(name: str | None = None) -> logging.Logger:
    """Return the launch logger named `name`, which writes to the screen."""
    logger = launch_config.manager.getLogger(name or "launch")
    logger.propagate = False
    logger.addHandler(launch_config.get_screen_handler())
    return logger


def reset() -> None:
    """Remove all launch loggers, and restore the initial settings."""
    launch_config.reset()
