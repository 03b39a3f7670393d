"""Loggers of launch.logging for launch files, separate from those of Python's `logging`.

A launch writes no log files.
"""

import logging
import os
import sys
from logging import FileHandler, Handler, StreamHandler
from pathlib import Path

from tftool.base.errors import UsageError
from tftool.ros.rclpy.logging import get_logging_directory

__all__ = ["FileHandler", "Handler", "LaunchConfig", "StreamHandler", "get_logger", "reset"]

_PLAIN = "[{levelname}] [{name}]: {message}"
_FORMATS = {"default": _PLAIN, "default_with_timestamp": "{created:.7f} " + _PLAIN}
_VARIABLE = "OVERRIDE_LAUNCH_SCREEN_FORMAT"


class _Screen(Handler):
    """Log handler that looks up `sys.stdout` for each record, because a program can replace it."""

    def emit(self, record: logging.LogRecord) -> None:
        """Write one log record as a line."""
        sys.stdout.write(f"{self.format(record)}\n")


class LaunchConfig:
    """Settings of launch's loggers: level, format on the screen, and folder of log files."""

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Restore the initial settings.

        Raises:
            UsageError: If the format in the environment variable is not a format with braces.
        """
        self.manager = logging.Manager(logging.RootLogger(logging.INFO))
        self._log_dir: str | None = None
        self._screen = _Screen()
        given = os.environ.get(_VARIABLE) or "default"
        try:
            self.set_screen_format(given)
        except ValueError as error:
            raise UsageError(
                f"the environment variable {_VARIABLE} must be a format with braces, such as "
                f"'{{message}}', not '{given}': {error}"
            ) from None

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

    def set_screen_format(self, screen_format: str, *, screen_style: str | None = None) -> None:
        """Set the format of log lines: "default", or a format such as "{message}"."""
        if screen_format in _FORMATS and screen_style is not None:
            raise ValueError(
                f"the format '{screen_format}' mixes styles: omit the style {screen_style!r}"
            )
        text, style = _FORMATS.get(screen_format, screen_format), screen_style or "{"
        self._screen.setFormatter(logging.Formatter(text, style=style))  # type: ignore[arg-type]

    def get_screen_handler(self) -> Handler:
        """Return the log handler that writes to the screen."""
        return self._screen


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
