"""Options for a DDS connection, and checks for contradictions between options."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Final

from tftool.base.errors import UsageError
from tftool.world.link.reach import LinkOption, Reach

if TYPE_CHECKING:
    from tftool.world.link.link_options import Options
    from tftool.world.link.seam import Middleware

NO_WHEEL: Final = (
    "DDS needs the package 'cyclonedds', which is missing here ({error}): pip install "
    "'tftool-tf2[dds]'. If there is no wheel (Linux on arm64, Python 3.14), build the package "
    "from source with Cyclone DDS, or run zenoh-bridge-ros2dds on the robot and use --connect."
)


@dataclass(frozen=True, slots=True)
class DdsReach(Reach):
    """Networks that a DDS connection may use; by default only the loopback of this machine.

    Attributes:
        places: Interfaces to use, and addresses to connect to.
    """

    OPTIONS: ClassVar[Mapping[str, LinkOption]] = {
        "dds": LinkOption(
            bool,
            "--dds",
            "Join ROS 2 over DDS instead of zenoh, on this machine's loopback only (DDS still "
            "receives on 0.0.0.0).",
        ),
        "dds_on": LinkOption(
            list[str] | None,
            "--dds-on",
            "Join ROS 2 over DDS on an interface (eth0), or with a machine (192.168.1.5). Repeat "
            "the option for more. DDS here has no TLS: everyone in that network can read and "
            "write.",
            "PLACE",
        ),
    }
    FLAGS: ClassVar[tuple[str, ...]] = ("--dds",)
    ALONE: ClassVar[str] = (
        "--dds uses DDS: leave out --listen, --connect, --zenoh-config and --tls-*, which only "
        "apply to zenoh."
    )
    is_robots: ClassVar[bool] = True

    places: tuple[str, ...] = ()

    @classmethod
    def read(cls, given: Mapping[str, Any]) -> "DdsReach":
        """Create a `DdsReach` from the given options; see `Reach.read`."""
        return cls(tuple(given.get("dds_on") or ()))

    def place(self, domain: int) -> str:
        """Return the domain, and its interfaces or addresses, as text for messages."""
        return f"DDS domain {domain} on {', '.join(self.places) or 'the loopback'}"

    def join(self, options: "Options") -> "Middleware":
        """Join a session over DDS; see `Reach.join`.

        Raises:
            UsageError: If the extra `dds` is not installed.
            LinkError: If the domain cannot be joined.
        """
        try:
            from tftool.world.link.dds.middleware import DdsMiddleware
        except (ImportError, OSError) as error:
            raise UsageError(NO_WHEEL.format(error=error)) from error
        return DdsMiddleware(options, self)
