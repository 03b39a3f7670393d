"""TF2 without ROS: coordinate frames over time, and the turtles to learn them with.

Frames:

    open                            open a recording, description, scenario or running session
    Frames                          result of open: a buffer with its time span and source
    Buffer                          tf2's buffer: transforms by stamp, and lookups
    TransformStamped                a transform with its stamp and the names of its frames
    Transform                       rotation and translation: apply, inverse, @, from_matrix
    Quaternion                      a rotation: from_rpy, rpy, inverse, @
    Vector3                         three numbers: norm, dot, cross
    TransformArray                  many transforms of one pair, as numpy arrays
    Snapshot                        the tree of frames at one time
    FrameInfo                       one frame of a snapshot

Stamps and rotations:

    seconds                         convert seconds to nanoseconds
    as_seconds                      convert nanoseconds to seconds
    LATEST                          the stamp 0, for a lookup at the latest common time
    quaternion_from_rpy             a rotation from roll, pitch and yaw
    rpy_from_quaternion             roll, pitch and yaw of a rotation

Recordings and robots:

    open_recording                  read an MCAP, rosbag2, ROS 1 bag or pose file
    Recording                       transforms, topics and time span of a recording
    write_recording                 write a recording
    RecordingWriter                 writer of a recording, message by message
    load_urdf                       read a URDF or xacro
    Robot                           links and joints of a robot description
    JointStates                     positions of joints over time
    export                          write transforms to files of other tools
    Exported                        the files that export has written
    plot                            draw a transform over time, or series of poses
    view                            show frames in 3-D in the browser
    PageView                        result of view: a page to show or to save

Questions:

    diagnose                        find errors in the frames of a source
    Finding                         one result of diagnose: cause, evidence, fixes
    explain                         find out why a lookup fails, edge by edge
    Explanation                     result of explain
    diff                            compare two sources of frames
    Differences                     result of diff: the edges that differ, and by how much
    calibrate                       find a sensor's mounting pose and clock offset from motions
    Calibration                     result of calibrate: mounting pose with intervals
    clock_offset                    find the offset between the clocks of two motions
    ClockOffset                     result of clock_offset: offset with interval
    CalibrationRefused              the motions do not determine the result

Nodes and clocks:

    World                           nodes that share one buffer and one clock
    Node                            base of nodes: publishers, subscriptions, lookups, a coroutine
    SimClock                        simulated time, as fast as the processor
    WallClock                       real time, by the clock of this machine
    Clock                           base class of all clocks
    Phase                           order of timers that end at the same time
    live                            run the nodes of a world, inside an event loop
    run                             run a coroutine on a clock

Errors:

    TftoolError                     base class of all errors of tftool
    TransformException              base class of the errors of a lookup, as in tf2
    LookupException                 a frame is unknown
    ConnectivityException           two frames are in different trees
    ExtrapolationException          the requested time is outside the samples
    BackwardExtrapolationException  the requested time is before the first sample
    ForwardExtrapolationException   the requested time is after the last sample
    NoDataForExtrapolationException an edge has no sample, or a single sample at another time
    InvalidArgumentException        an argument of a lookup, or a sample, is invalid
    TimeoutException                a transform did not arrive in time
    InputError                      a file or text cannot be read
    UsageError                      arguments contradict each other
    NodeFailed                      a node raised an error, which is the __cause__
"""

import sys
from importlib import import_module

# Not imported from `typing`, because every command imports this module first, and should start
# fast. Type checkers recognise the name.
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
    from tftool.frames.calibration.body_motion import CalibrationRefused
    from tftool.frames.calibration.calibrate import Calibration, calibrate
    from tftool.frames.calibration.clock_offset import ClockOffset, clock_offset
    from tftool.frames.differences import Differences, diff
    from tftool.frames.export.export import Exported, export
    from tftool.frames.frames import Frames
    from tftool.geometry.conversions import quaternion_from_rpy, rpy_from_quaternion
    from tftool.geometry.rigid import Quaternion, Transform, Vector3
    from tftool.notebook import PageView, view
    from tftool.opener import open_frames
    from tftool.recordings.recording import Recording, open_recording
    from tftool.recordings.recording_writer import RecordingWriter, write_recording
    from tftool.robots.joint_motion import JointStates
    from tftool.robots.robot_model import Robot, load_urdf
    from tftool.world.clock import Clock, Phase, SimClock, WallClock, run
    from tftool.world.node import Node
    from tftool.world.supervisor import live
    from tftool.world.world import World

    # Only an assignment is public to type checkers under another name.
    open = open_frames

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
    "tftool.frames.calibration.clock_offset": ("ClockOffset", "clock_offset"),
    "tftool.frames.calibration.body_motion": ("CalibrationRefused",),
    "tftool.frames.frames": ("Frames",),
    "tftool.frames.differences": ("Differences", "diff"),
    "tftool.doctor.judge": ("diagnose",),
    "tftool.doctor.explanation": ("Explanation", "explain"),
    "tftool.doctor.findings": ("Finding",),
    "tftool.notebook": ("PageView", "view"),
    "tftool.frames.export.export": ("Exported", "export"),
    "tftool.recordings.recording": ("Recording", "open_recording"),
    "tftool.robots.joint_motion": ("JointStates",),
    "tftool.robots.robot_model": ("Robot", "load_urdf"),
    "tftool.recordings.recording_writer": ("RecordingWriter", "write_recording"),
    "tftool.drawing.figure": ("plot",),
    "tftool.base.stamps": ("LATEST", "as_seconds", "seconds"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}
# Left out of `__all__`: `from tftool import *` keeps Python's own.
_HOME_OF["open"] = "tftool.opener"


def __getattr__(name: str) -> object:
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
