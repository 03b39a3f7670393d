"""TF2 without ROS: coordinate frames over time, and the turtles to learn them with."""

import sys

# Not from `typing`: this module is imported by every command before it can do anything,
# and says nothing about types while it runs. Type checkers know the name.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from tftool.base.errors import (
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
    from tftool.base.stamps import LATEST, as_seconds, seconds
    from tftool.buffer.batch.transform_array import TransformArray
    from tftool.buffer.buffer import Buffer
    from tftool.buffer.sample import FrameInfo, Snapshot, TransformStamped
    from tftool.doctor.explanation import Explanation, explain
    from tftool.doctor.findings import Finding
    from tftool.doctor.judge import diagnose
    from tftool.drawing.figure import plot
    from tftool.frames.calibration.calibrate import Calibration, calibrate
    from tftool.frames.calibration.clock_offset import (
        CalibrationRefused,
        ClockOffset,
        clock_offset,
    )
    from tftool.frames.diff import diff
    from tftool.frames.differences import Differences
    from tftool.frames.export.export import Exported, export
    from tftool.frames.frames import Frames
    from tftool.geometry.conversions import quaternion_from_rpy, rpy_from_quaternion
    from tftool.geometry.rigid import Quaternion, Transform, Vector3
    from tftool.notebook import PageView, view
    from tftool.opener import open_frames as open  # noqa: F401
    from tftool.recordings.recording import Recording, open_recording
    from tftool.recordings.recording_writer import RecordingWriter, write_recording
    from tftool.robots.joint_states import JointStates
    from tftool.robots.robot_model import Robot, load_urdf
    from tftool.world.clock import Clock, Phase, SimClock, WallClock, run
    from tftool.world.node import Node
    from tftool.world.supervisor import live
    from tftool.world.world import World

__version__ = "0.1.0"

__all__ = [
    "LATEST",
    "BackwardExtrapolationException",
    "Buffer",
    "Calibration",
    "CalibrationRefused",
    "Clock",
    "ClockOffset",
    "ConnectivityException",
    "Differences",
    "Explanation",
    "Exported",
    "ExtrapolationException",
    "Finding",
    "ForwardExtrapolationException",
    "FrameInfo",
    "Frames",
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
    "calibrate",
    "clock_offset",
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
    "tftool.base.errors": (
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
    "tftool.buffer.batch.transform_array": ("TransformArray",),
    "tftool.buffer.buffer": ("Buffer",),
    "tftool.buffer.sample": ("FrameInfo", "Snapshot", "TransformStamped"),
    "tftool.geometry.conversions": ("quaternion_from_rpy", "rpy_from_quaternion"),
    "tftool.geometry.rigid": ("Quaternion", "Transform", "Vector3"),
    "tftool.world.clock": ("Clock", "Phase", "SimClock", "WallClock", "run"),
    "tftool.world.node": ("Node",),
    "tftool.world.supervisor": ("live",),
    "tftool.world.world": ("World",),
    "tftool.frames.calibration.calibrate": ("Calibration", "calibrate"),
    "tftool.frames.calibration.clock_offset": (
        "CalibrationRefused",
        "ClockOffset",
        "clock_offset",
    ),
    "tftool.frames.diff": ("diff",),
    "tftool.frames.frames": ("Frames",),
    "tftool.frames.differences": ("Differences",),
    "tftool.doctor.judge": ("diagnose",),
    "tftool.doctor.explanation": ("Explanation", "explain"),
    "tftool.doctor.findings": ("Finding",),
    "tftool.notebook": ("PageView", "view"),
    "tftool.frames.export.export": ("Exported", "export"),
    "tftool.recordings.recording": ("Recording", "open_recording"),
    "tftool.robots.joint_states": ("JointStates",),
    "tftool.robots.robot_model": ("Robot", "load_urdf"),
    "tftool.recordings.recording_writer": ("RecordingWriter", "write_recording"),
    "tftool.drawing.figure": ("plot",),
    "tftool.base.stamps": ("LATEST", "as_seconds", "seconds"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}
# Left out of `__all__`: `from tftool import *` keeps Python's own.
_HOME_OF["open"] = "tftool.opener"


def __getattr__(name: str) -> object:
    from importlib import import_module

    if name not in _HOME_OF:
        raise AttributeError(f"module 'tftool' has no attribute '{name}'")
    home = import_module(_HOME_OF[name])
    value: object = getattr(home, "open_frames" if name == "open" else name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__", "open"])


if "IPython" in sys.modules:
    from tftool.notebook import register

    register()
