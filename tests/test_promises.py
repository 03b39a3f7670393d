import ast
import inspect
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import get_args

import pytest

import tftool
from tests import typed_program
from tftool.opener import open_frames

# Names on which users' code may rely. Adding a name is a promise; removing one breaks it.
PROMISED = [
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
    "LATEST",
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


def test_the_promised_names_are_these():
    assert sorted(tftool.__all__) == PROMISED
    assert dir(tftool) == sorted([*PROMISED, "__version__", "open"])


@pytest.mark.parametrize("name", PROMISED)
def test_every_promised_name_is_there_under_its_own_name(name):
    value = getattr(tftool, name)

    assert getattr(value, "__name__", name) == name


def test_open_is_reached_by_its_full_name_and_leaves_pythons_own_to_others():
    names: dict[str, object] = {}
    exec("from tftool import *", names)

    assert tftool.open is open_frames
    assert "open" not in tftool.__all__
    assert "open" in dir(tftool)
    assert names.get("open", open) is open


@pytest.mark.parametrize("name", [*PROMISED, "open"])
def test_every_promised_name_is_in_the_help_and_on_its_page(name):
    page = Path(tftool.__file__).parents[1] / "docs" / "reference" / "python.md"

    assert re.search(rf"^    {name} +\S", tftool.__doc__, re.MULTILINE)
    assert f"tftool.{name}" in page.read_text(encoding="utf-8")


def test_a_users_typed_program_runs(tmp_path):
    """Check a program with mypy --strict, and run it."""
    found = typed_program.main(tmp_path)

    assert found["farthest"] == pytest.approx(2.0)
    assert found["count"] == 40
    assert found["refused"] == 1.0
    assert found["error"] == pytest.approx(0.0, abs=1e-12)


def test_another_name_is_refused_as_python_does():
    with pytest.raises(AttributeError, match="no attribute 'Bufer'"):
        _ = tftool.Bufer


@pytest.mark.parametrize("name", PROMISED)
def test_type_checkers_find_every_promised_name(name):
    """Check the names for type checkers; nothing is imported at run time under TYPE_CHECKING."""
    known = set()
    for statement in ast.parse(Path(tftool.__file__).read_text(encoding="utf-8")).body:
        if isinstance(statement, ast.If) and ast.unparse(statement.test) == "TYPE_CHECKING":
            imported = [one for one in statement.body if isinstance(one, ast.ImportFrom)]
            known |= {alias.name for one in imported for alias in one.names}

    assert name in known


@pytest.mark.parametrize("name", ["diagnose", "diff", "explain", "export", "view"])
def test_the_annotation_of_a_recording_argument_includes_recording_and_buffer(name):
    """Check the class itself: pyright accepts no cached property for a protocol's one."""
    takes = next(iter(inspect.signature(getattr(tftool, name)).parameters.values())).annotation
    if isinstance(takes, str):
        takes = eval(takes, {known: getattr(tftool, known) for known in PROMISED})

    assert {tftool.Recording, tftool.Buffer} <= set(get_args(takes))


def test_the_scalar_path_imports_neither_numpy_nor_asyncio():
    code = (
        "import sys\n"
        "from tftool import Buffer, Transform, TransformStamped, seconds\n"
        "Buffer().set_transform(TransformStamped(seconds(1), 'a', 'b', Transform()), 'me')\n"
        "print(sorted({'numpy', 'asyncio', 'rich', 'yaml', 'typer'} & set(sys.modules)))\n"
    )

    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert done.stdout == "[]\n"


def test_a_class_name_stands_for_one_thing():
    """Check that no two classes share a name, except classes with ROS's names in ROS's modules."""
    faces = ("ros/rclpy/", "ros/tf2/", "ros/launch/", "ros/share/")
    root = Path(tftool.__file__).parent
    named = Counter(
        name
        for path in root.rglob("*.py")
        if not path.relative_to(root).as_posix().startswith(faces)
        for name in re.findall(r"^class (\w+)", path.read_text(encoding="utf-8"), re.MULTILINE)
    )

    assert len(named) > 300
    assert [name for name, count in named.items() if count > 1] == []
