"""Options for reading frames from a file: joint positions, odometry, cache."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from tftool.base.errors import UsageError


@dataclass(frozen=True, slots=True)
class DescriptionOptions:
    """Options for reading a robot description: FROM itself, or --urdf for a recording.

    Attributes:
        joints: Positions by joint, radians or metres.
        arguments: Values of xacro arguments, by name.
        urdf: Path of the description for a recording without one.
    """

    joints: Mapping[str, float] = field(default_factory=dict)
    arguments: Mapping[str, str] = field(default_factory=dict)
    urdf: Path | None = None

    def refuse(self, what: str) -> None:
        """Raise an error if any of these options was given, for a source without a description.

        Args:
            what: Name of the source, as the beginning of a sentence.

        Raises:
            UsageError: If an option was given.
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
        no_cache: Whether to read without the cache of columns.
        with_odometry: Whether odometry and poses are used as transforms.
        tf_topics: Topics of transforms to read; empty for all.
    """

    no_cache: bool = False
    with_odometry: bool = False
    tf_topics: tuple[str, ...] = ()

    def refuse(self, what: str) -> None:
        """Raise an error if an option that changes the result was given, for another source.

        Args:
            what: Name of the source, as the beginning of a sentence.

        Raises:
            UsageError: If such an option was given.
        """
        if self.with_odometry:
            raise UsageError(f"{what}: leave out --with-odometry.")
        if self.tf_topics:
            raise UsageError(f"{what}: leave out --tf-topic.")
