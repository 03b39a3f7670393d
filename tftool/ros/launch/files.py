"""Loading of launch files: Python, XML or YAML to a description."""

from pathlib import Path
from types import FunctionType, ModuleType

from tftool.base.errors import InputError
from tftool.base.near_names import near_names
from tftool.ros.host import user_code
from tftool.ros.host.error_text import error_sentence
from tftool.ros.launch.description import LaunchDescription
from tftool.ros.launch.elements import read
from tftool.ros.launch.frontend import actions_of

MAKES = "generate_launch_description"
"""The function that a launch file in Python defines."""


def load_file(path: Path) -> LaunchDescription:
    """Return the description in a launch file.

    Raises:
        InputError: If it cannot be read, is none, or raises; the user's own line is shown.
    """
    if path.suffix in (".xml", ".yaml", ".yml"):
        return LaunchDescription(actions_of(read(path)))
    return _from_python(path)


def _from_python(path: Path) -> LaunchDescription:
    code = user_code.compile_file(path)
    module = ModuleType("launch_file")
    module.__file__ = str(path.absolute())  # ROS 2's loader makes it so too
    try:
        exec(code, module.__dict__)
        make = module.__dict__.get(MAKES)
        if make is None:
            defined = [name for name, one in vars(module).items() if isinstance(one, FunctionType)]
            near = near_names(MAKES, defined)
            hint = f"; it has '{near[0]}': name that so" if near else ""
            raise InputError(f"'{path}' is no launch file: it has no function {MAKES}(){hint}")
        description = make()
    except InputError:
        raise
    except Exception as error:
        raise InputError(f"{path}: {error_sentence(error)}") from error
    if not isinstance(description, LaunchDescription):
        raise InputError(
            f"{path}: generate_launch_description() must return a LaunchDescription, not "
            f"{type(description).__name__}"
        )
    return description
