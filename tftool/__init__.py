"""TF2 without ROS: coordinate frames over time, and the turtles to learn them with."""

import sys

# Not from `typing`: this module is imported by every command before it can do anything,
# and says nothing about types while it runs. Type checkers know the name.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from tftool.comparing.asking import diff
    from tftool.comparing.compare import Differences
    from tftool.diagnostics.asking import diagnose, explain
    from tftool.diagnostics.explanation import Explanation
    from tftool.diagnostics.findings import Finding
    from tftool.errors import (
        BackwardExtrapolationException,
        ConnectivityException,
        ExtrapolationException,
        ForwardExtrapolationException,
        InputError,
        InvalidArgumentException,
        LookupException,
        NoDataForExtrapolationException,
        NodeFailed,
        TftoolError,
        TimeoutException,
        TransformException,
        UsageError,
    )
    from tftool.frames.batch.arrays import TransformArray
    from tftool.frames.buffer import Buffer
    from tftool.frames.sample import FrameInfo, Snapshot, TransformStamped
    from tftool.geometry.conversions import quaternion_from_rpy, rpy_from_quaternion
    from tftool.geometry.rigid import Quaternion, Transform, Vector3
    from tftool.notebook import PageView, view
    from tftool.runtime.clock import Clock, Phase, SimClock, WallClock, run
    from tftool.runtime.node import Node
    from tftool.runtime.supervisor import live
    from tftool.runtime.world import World
    from tftool.sinks.export import Exported, export
    from tftool.sources.joint_states import JointStates
    from tftool.sources.recording import Recording, open_recording
    from tftool.sources.robot import Robot, load_urdf
    from tftool.sources.writing.recording import RecordingWriter, write_recording
    from tftool.stamps import LATEST, as_seconds, seconds
    from tftool.views.figure import plot

__version__ = "0.1.0"

__all__ = [
    "LATEST",
    "BackwardExtrapolationException",
    "Buffer",
    "Clock",
    "ConnectivityException",
    "Differences",
    "Explanation",
    "Exported",
    "ExtrapolationException",
    "Finding",
    "ForwardExtrapolationException",
    "FrameInfo",
    "InputError",
    "InvalidArgumentException",
    "JointStates",
    "LookupException",
    "NoDataForExtrapolationException",
    "Node",
    "NodeFailed",
    "PageView",
    "Phase",
    "Quaternion",
    "Recording",
    "RecordingWriter",
    "Robot",
    "SimClock",
    "Snapshot",
    "TftoolError",
    "TimeoutException",
    "Transform",
    "TransformArray",
    "TransformException",
    "TransformStamped",
    "UsageError",
    "Vector3",
    "WallClock",
    "World",
    "as_seconds",
    "diagnose",
    "diff",
    "explain",
    "export",
    "live",
    "load_urdf",
    "open_recording",
    "plot",
    "quaternion_from_rpy",
    "rpy_from_quaternion",
    "run",
    "seconds",
    "view",
    "write_recording",
]

# Where each name lives. It is imported when it is first asked for, so that `import tftool`
# costs nothing, and a command pays for what it uses.
_HOMES = {
    "tftool.errors": (
        "BackwardExtrapolationException",
        "ConnectivityException",
        "ExtrapolationException",
        "ForwardExtrapolationException",
        "InputError",
        "InvalidArgumentException",
        "LookupException",
        "NoDataForExtrapolationException",
        "NodeFailed",
        "TftoolError",
        "TimeoutException",
        "TransformException",
        "UsageError",
    ),
    "tftool.frames.batch.arrays": ("TransformArray",),
    "tftool.frames.buffer": ("Buffer",),
    "tftool.frames.sample": ("FrameInfo", "Snapshot", "TransformStamped"),
    "tftool.geometry.conversions": ("quaternion_from_rpy", "rpy_from_quaternion"),
    "tftool.geometry.rigid": ("Quaternion", "Transform", "Vector3"),
    "tftool.runtime.clock": ("Clock", "Phase", "SimClock", "WallClock", "run"),
    "tftool.runtime.node": ("Node",),
    "tftool.runtime.supervisor": ("live",),
    "tftool.runtime.world": ("World",),
    "tftool.comparing.asking": ("diff",),
    "tftool.comparing.compare": ("Differences",),
    "tftool.diagnostics.asking": ("diagnose", "explain"),
    "tftool.diagnostics.explanation": ("Explanation",),
    "tftool.diagnostics.findings": ("Finding",),
    "tftool.notebook": ("PageView", "view"),
    "tftool.sinks.export": ("Exported", "export"),
    "tftool.sources.recording": ("Recording", "open_recording"),
    "tftool.sources.joint_states": ("JointStates",),
    "tftool.sources.robot": ("Robot", "load_urdf"),
    "tftool.sources.writing.recording": ("RecordingWriter", "write_recording"),
    "tftool.views.figure": ("plot",),
    "tftool.stamps": ("LATEST", "as_seconds", "seconds"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}


def __getattr__(name: str) -> object:
    from importlib import import_module

    if name not in _HOME_OF:
        raise AttributeError(f"module 'tftool' has no attribute '{name}'")
    value: object = getattr(import_module(_HOME_OF[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


if "IPython" in sys.modules:
    from tftool.notebook import register

    register()
