"""Substitutions of ROS's launch: texts that are computed only while the launch runs."""

import math
import os
import shlex
import shutil
import subprocess
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, Final

from tftool.base.errors import InputError, UsageError
from tftool.base.named_files import read_named_text
from tftool.base.plain_text import did_you_mean
from tftool.ros.launch import commands, packages
from tftool.ros.launch.context import LaunchContext
from tftool.ros.launch.logging import launch_config

ROS2: Final = "ros2"
XACRO: Final = "xacro"
"""Name of the ROS command that tftool runs without a process."""

ON_STDERR: Final = ("fail", "warn", "ignore", "capture")
"""Allowed values of `on_stderr` of a `Command`."""


class SubstitutionFailure(UsageError):
    """Error for a substitution whose text cannot be computed."""


class Substitution:
    """Base class of substitutions: texts that are computed only while the launch runs."""

    def perform(self, context: LaunchContext) -> str:
        """Return the text of the substitution."""
        raise NotImplementedError

    def describe(self) -> str:
        """Return a description of the substitution, without evaluating it."""
        return f"{type(self).__name__}()"

    def __truediv__(self, other: Any) -> "PathJoinSubstitution":
        return PathJoinSubstitution([self, other])


SomeSubstitutionsType = Any
"""Type of a text, a substitution, or a list of texts and substitutions, for annotations."""


def perform(context: LaunchContext, value: Any) -> str:
    """Return the text of a substitution, or the joined texts of a list of substitutions."""
    if value is None:
        return ""
    if isinstance(value, Substitution):
        return value.perform(context)
    if isinstance(value, str):
        return value
    if isinstance(value, Path):
        return str(value)
    if isinstance(value, Iterable):
        return "".join(perform(context, one) for one in value)
    return str(value)


def describe(value: Any) -> str:
    """Return a description of a substitution, or of a list of substitutions, without evaluation."""
    if isinstance(value, Substitution):
        return value.describe()
    if isinstance(value, Sequence) and value and not isinstance(value, str):
        return " + ".join(describe(one) for one in value)
    return repr(str(value or ""))


def is_true(text: str) -> bool:
    """Return True for the text "true" or "1", and False for "false" or "0".

    Raises:
        UsageError: If the text is none of these four.
    """
    word = text.strip().lower()
    if word in ("true", "1"):
        return True
    if word in ("false", "0"):
        return False
    raise UsageError(f"a condition must be 'true', 'false', '1' or '0', not '{text}'")


class TextSubstitution(Substitution):
    """Substitution that is a constant text."""

    def __init__(self, *, text: str) -> None:
        if not isinstance(text, str):
            raise TypeError(
                f"TextSubstitution expected a str object in the 'text' argument, got {text!r}"
            )
        self.text = text

    def perform(self, context: LaunchContext) -> str:
        """Return the constant text."""
        return self.text

    def describe(self) -> str:
        """Return the text in quotes."""
        return f"'{self.text}'"


class LaunchConfiguration(Substitution):
    """Substitution for the value of a launch argument."""

    def __init__(self, variable_name: Any, *, default: Any = None) -> None:
        self.variable_name = variable_name
        self.default = default

    def perform(self, context: LaunchContext) -> str:
        """Return the argument's present value, or the default."""
        name = perform(context, self.variable_name)
        if name in context.launch_configurations:
            return context.launch_configurations[name]
        if self.default is not None:
            return perform(context, self.default)
        hint = did_you_mean(name, context.launch_configurations)
        raise SubstitutionFailure(
            f"launch configuration '{name}' does not exist here: declare it with "
            f"DeclareLaunchArgument before its first use, or pass {name}:=…{hint}"
        )

    def describe(self) -> str:
        """Return the description "LaunchConfig('name')"."""
        return f"LaunchConfig({describe(self.variable_name)})"


class LaunchLogDir(Substitution):
    """Substitution for the folder of log files."""

    def perform(self, context: LaunchContext) -> str:
        """Return the path of the folder of log files."""
        return launch_config.log_dir


class EnvironmentVariable(Substitution):
    """Substitution for the value of an environment variable."""

    def __init__(self, name: Any, *, default_value: Any = None) -> None:
        self.name = name
        self.default_value = default_value

    def perform(self, context: LaunchContext) -> str:
        """Return the variable's present value, or the default."""
        name = perform(context, self.name)
        if name in context.environment:
            return context.environment[name]
        if self.default_value is not None:
            return perform(context, self.default_value)
        # The words before the colon are those of ROS 2, which programs compare.
        raise SubstitutionFailure(
            f"environment variable '{name}' does not exist: set it, or give a default_value"
        )

    def describe(self) -> str:
        """Return the description "EnvVar('NAME')"."""
        return f"EnvVar({describe(self.name)})"


class LocalSubstitution(Substitution):
    """Substitution for a local value, such as 'event.reason' in an event handler."""

    def __init__(self, expression: str, description: str | None = None) -> None:
        self.expression = expression
        self.description = description

    def perform(self, context: LaunchContext) -> str:
        """Return the local value as text."""
        value: Any = context.locals
        for name in self.expression.split("."):
            if not hasattr(value, name):
                known = ", ".join(one for one in vars(value) if not one.startswith("_"))
                hint = f"it may be {known}" if known else "only an event handler has an event"
                raise SubstitutionFailure(
                    f"'{self.expression}' has no value here, because there is no '{name}': {hint}"
                )
            value = getattr(value, name)
        return str(value)

    def describe(self) -> str:
        """Return the description "LocalVar('event.reason')"."""
        return f"LocalVar('{self.description or self.expression}')"


class PathJoinSubstitution(Substitution):
    """Substitution for a path joined from several parts."""

    def __init__(self, substitutions: Iterable[Any]) -> None:
        self.substitutions = list(substitutions)

    def perform(self, context: LaunchContext) -> str:
        """Return the joined path."""
        return os.path.join(*(perform(context, one) for one in self.substitutions))

    def describe(self) -> str:
        """Return the description "PathJoinSubstitution('parts')"."""
        parts = ", ".join(describe(one) for one in self.substitutions)
        return f"PathJoinSubstitution('{parts}')"

    def __truediv__(self, part: Any) -> "PathJoinSubstitution":
        """Return a substitution for this path with one more part."""
        return PathJoinSubstitution([*self.substitutions, part])


class PathSubstitution(PathJoinSubstitution):
    """Substitution for a path, to which the operator `/` adds further parts."""

    def __init__(self, path: Any) -> None:
        super().__init__([path])


class StringJoinSubstitution(Substitution):
    """Substitution for several texts joined by a delimiter."""

    def __init__(self, substitutions: Iterable[Any], delimiter: Any = "") -> None:
        self.substitutions = list(substitutions)
        self.delimiter = delimiter

    def perform(self, context: LaunchContext) -> str:
        """Return the joined texts."""
        return perform(context, self.delimiter).join(
            perform(context, one) for one in self.substitutions
        )


class PythonExpression(Substitution):
    """Substitution for the value of a Python expression in the launch file."""

    def __init__(self, expression: Any, python_modules: Any = ("math",)) -> None:
        self.expression = expression
        self.python_modules = python_modules

    def perform(self, context: LaunchContext) -> str:
        """Evaluate the expression, and return its value as text."""
        text = perform(context, self.expression)
        given = self.python_modules
        modules = [given] if isinstance(given, str | Substitution) else given
        try:
            names: dict[str, Any] = {**vars(math), "os": os}
            for module in modules:
                name = perform(context, module)
                names[name.partition(".")[0]] = __import__(name)
            return str(eval(text, names))
        except Exception as error:
            raise SubstitutionFailure(
                f"cannot evaluate the expression '{text}': {type(error).__name__}: {error}"
            ) from None

    def describe(self) -> str:
        """Return the description "PythonExpr(expression, [modules])"."""
        given = self.python_modules
        modules = [given] if isinstance(given, str | Substitution) else given
        shown = ", ".join(describe(one) for one in modules)
        return f"PythonExpr({describe(self.expression)}, [{shown}])"


def _this_file(context: LaunchContext) -> Path:
    if not context.files:
        raise SubstitutionFailure(
            "there is no current launch file, because this launch description was made without one"
        )
    return context.files[-1]


class ThisLaunchFile(Substitution):
    """Substitution for the path of the current launch file."""

    def perform(self, context: LaunchContext) -> str:
        """Return the path of the current launch file."""
        return str(_this_file(context))


class ThisLaunchFileDir(Substitution):
    """Substitution for the folder of the current launch file."""

    def perform(self, context: LaunchContext) -> str:
        """Return the folder of the current launch file."""
        return str(_this_file(context).parent)


class AnonName(Substitution):
    """Substitution for a unique name, made from a name and a number."""

    def __init__(self, name: Any) -> None:
        self.name = name

    def perform(self, context: LaunchContext) -> str:
        """Return "name_number"; within one launch, a name always gets the same number."""
        name = perform(context, self.name)
        return f"{name}_{context.number(name)}"


class FindPackageShare(Substitution):
    """Substitution for the share directory of a package."""

    def __init__(self, package: Any) -> None:
        self.package = package

    def perform(self, context: LaunchContext) -> str:
        """Return the package's share directory; for a package in a workspace, its source folder."""
        return str(context.workspace.share(perform(context, self.package)))

    @staticmethod
    def find(package_name: str) -> str:
        """Return a package's share directory without a launch context."""
        return packages.get_package_share_directory(package_name)

    def describe(self) -> str:
        """Return the description "FindPackageShare(pkg='name')"."""
        return f"FindPackageShare(pkg={describe(self.package)})"


FindPackage = FindPackagePrefix = FindPackageShare


class FindExecutable(Substitution):
    """Substitution for the path of a system command."""

    def __init__(self, *, name: Any) -> None:
        self.name = name

    def perform(self, context: LaunchContext) -> str:
        """Return the path of the command; return "ros2" and "xacro", which tftool runs, unchanged.

        Raises:
            SubstitutionFailure: If there is no such command.
        """
        name = perform(context, self.name)
        if name in (ROS2, XACRO):
            # ExecuteProcess runs `ros2` itself, and Command runs `xacro`.
            return name
        found = shutil.which(name)
        if found is None:
            raise SubstitutionFailure(f"there is no command '{name}' on the PATH")
        return found


class FileContent(Substitution):
    """Substitution for the content of a text file."""

    def __init__(self, path: Any) -> None:
        self.path = path

    def perform(self, context: LaunchContext) -> str:
        """Return the file's text."""
        path = perform(context, self.path)
        try:
            return read_named_text(Path(path))
        except (OSError, UnicodeDecodeError) as error:
            reason = getattr(error, "strerror", None) or "it is not UTF-8 text"
            raise SubstitutionFailure(f"cannot read '{path}': {reason}") from None


class ExecutableInPackage(Substitution):
    """Substitution for the path of a package's executable."""

    def __init__(self, executable: Any, package: Any) -> None:
        self.executable, self.package = executable, package

    def perform(self, context: LaunchContext) -> str:
        """Return the path of the executable's source file.

        A console script has no file before installation; for such a script, return the path that an
        installation into the package's source folder would give.
        """
        name = perform(context, self.executable)
        package = context.workspace.package(perform(context, self.package))
        if name in package.scripts:
            return str(package.path_of_script(name))
        found = package.script_file(name)
        if found is None:
            raise SubstitutionFailure(f"package '{package.name}' has no executable '{name}'")
        return str(found)


def _expanded(words: list[str]) -> str:
    """Return the output of a `xacro` command line, which tftool executes itself.

    The words are "xacro", the path of a file, and arguments `name:=value`.

    Raises:
        SubstitutionFailure: If the command line is not valid, or the file cannot be expanded.
    """
    from tftool.robots.urdf import expand_xacro

    rest = [word for word in words[1:] if word != "--inorder"]
    files = [word for word in rest if ":=" not in word and not word.startswith("-")]
    options = [word for word in rest if word.startswith("-")]
    if len(files) != 1 or options:
        raise SubstitutionFailure(f"xacro needs one file, then arguments NAME:=VALUE, not {rest}")
    arguments = dict(word.split(":=", 1) for word in rest if ":=" in word)
    try:
        return expand_xacro(files[0], arguments)
    except (InputError, UsageError) as error:
        raise SubstitutionFailure(str(error)) from error


class Command(Substitution):
    """Substitution for the output of a command."""

    def __init__(self, command: Any, *, on_stderr: Any = "fail") -> None:
        """Store a command; `perform` runs the command.

        Args:
            command: The command and its arguments, as typed in a shell.
            on_stderr: Reaction to output on standard error: "fail", "warn", "ignore", or "capture"
                to append the text to the result.
        """
        self.command = command
        self.on_stderr = on_stderr

    def perform(self, context: LaunchContext) -> str:
        """Run the command, and return its standard output."""
        words = shlex.split(perform(context, self.command))
        if words and words[0].rpartition("/")[2] == XACRO:
            return _expanded(words)
        on_stderr = perform(context, self.on_stderr)
        if on_stderr not in ON_STDERR:
            raise SubstitutionFailure(
                f"on_stderr must be one of {', '.join(map(repr, ON_STDERR))}, not '{on_stderr}'"
            )
        captured = on_stderr == "capture"
        try:
            done = subprocess.run(
                words,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT if captured else subprocess.PIPE,
                text=True,
                check=True,
                stdin=subprocess.DEVNULL,
                timeout=commands.LONGEST_RUN,
            )
        except subprocess.TimeoutExpired:
            limit = f"{commands.LONGEST_RUN:g} s"
            raise SubstitutionFailure(
                f"the command {words} had not ended after {limit}, and the launch needs its "
                "output: use ExecuteProcess for a command that keeps running"
            ) from None
        except (OSError, subprocess.CalledProcessError) as error:
            raise SubstitutionFailure(f"the command {words} failed: {error}") from None
        if done.stderr and on_stderr != "ignore":
            sentence = f"the command {words} wrote to its standard error: {done.stderr.strip()}"
            if on_stderr == "fail":
                raise SubstitutionFailure(f"{sentence} (on_stderr='ignore' permits this)")
            if context.launch is not None:
                context.launch.warn(sentence)
        return done.stdout


# Functions of launch.utilities


def perform_substitutions(context: LaunchContext, subs: Iterable[Substitution]) -> str:
    """Return the joined texts of several substitutions."""
    return "".join(context.perform_substitution(one) for one in subs)


def normalize_to_list_of_substitutions(subs: Any) -> list[Substitution]:
    """Convert a text, a substitution, or a list of texts and substitutions to substitutions.

    Raises:
        TypeError: If an item is neither a text nor a substitution.
    """
    if isinstance(subs, str):
        return [TextSubstitution(text=subs)]
    if isinstance(subs, Substitution):
        return [subs]
    if not isinstance(subs, Iterable):
        raise TypeError(f"expected a text, a substitution or a list of these, not {subs!r}")
    return [_one(sub) for sub in subs]


def _one(sub: Any) -> Substitution:
    if isinstance(sub, Substitution):
        return sub
    if not isinstance(sub, str):
        raise TypeError(f"expected a text or a substitution, not {sub!r}")
    return TextSubstitution(text=sub)


def ensure_argument_type(
    argument: object, types: "type | Sequence[type]", argument_name: str, caller: str | None = None
) -> None:
    """Raise an error unless an argument is an instance of one of the types.

    Args:
        argument: Value of the argument.
        types: One type, or several types.
        argument_name: Name of the argument, for the error text.
        caller: Name of the function that got the argument, for the error text.

    Raises:
        TypeError: If the argument has another type, or an item of `types` is not a type.
    """
    allowed = types if isinstance(types, Iterable) else [types]
    if not any(is_a(argument, one) for one in allowed):
        whose = f" of {caller}" if caller else ""
        names = ", ".join(str(one) for one in allowed)
        raise TypeError(
            f"argument '{argument_name}'{whose} must be of type {names}, not {type(argument)}"
        )


def is_a(obj: object, entity_type: type) -> bool:
    """Return whether an object is an instance of the class `entity_type`."""
    return isinstance(obj, entity_type)


def is_a_subclass(obj: object, entity_type: type) -> bool:
    """Return whether `obj`, or the class of `obj`, is a subclass of `entity_type`."""
    kind = obj if isinstance(obj, type) else type(obj)
    return issubclass(kind, entity_type)


def isclassinstance(obj: object) -> bool:
    """Return whether an object has a class, which is always true."""
    return hasattr(obj, "__class__")


def normalize_to_list_of_entities(entities: Any) -> list[Any]:
    """Return the actions and launch descriptions in nested lists as one flat list."""
    if not isinstance(entities, Iterable):
        return [entities]
    return [one for entity in entities for one in normalize_to_list_of_entities(entity)]
