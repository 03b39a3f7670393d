"""Options for reading FROM when it is a file: joint positions, odometry, cache."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from tftool.base.errors import UsageError


@dataclass(frozen=True, slots=True)
class DescriptionOptions:
    """Options about the robot description in FROM or beside it.

    Attributes:
        joints: Positions by joint, radians or metres.
        arguments: Values of xacro arguments.
        urdf: A description for a recording that has none.
    """

    joints: Mapping[str, float] = field(default_factory=dict)
    arguments: Mapping[str, str] = field(default_factory=dict)
    urdf: Path | None = None

    def refuse(self, what: str) -> None:
        """Refuse these options if FROM is not a robot description.

        Args:
            what: Name of the source, as the beginning of a sentence.

        Raises:
            UsageError: If one was given.
        """
        given = [f"--joint {name}={value:g}" for name, value in self.joints.items()]
        given += [f"{name}:={value}" for name, value in self.arguments.items()]
        given += [] if self.urdf is None else [f"--urdf {self.urdf}"]
        if given:
            raise UsageError(f"{what}: leave out {', '.join(given)}.")


@dataclass(frozen=True, slots=True)
class RecordingOptions:
    """Options for reading a recording.

    Attributes:
        no_cache: Whether columns are read from the recording and not cached.
        with_odometry: Whether odometry and poses count as transforms.
        tf_topics: Topics of transforms, in place of all.
    """

    no_cache: bool = False
    with_odometry: bool = False
    tf_topics: tuple[str, ...] = ()

    def refuse(self, what: str) -> None:
        """Refuse options that would change the answer if FROM is not a recording.

        Args:
            what: Name of the source, as the beginning of a sentence.

        Raises:
            UsageError: If that was given.
        """
        if self.with_odometry:
            raise UsageError(f"{what}: leave out --with-odometry.")
        if self.tf_topics:
            raise UsageError(f"{what}: leave out --tf-topic.")
