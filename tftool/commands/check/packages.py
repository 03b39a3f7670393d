"""Check whether ROS 2 would find all parts of a user's package after a build."""

from collections.abc import Sequence
from pathlib import Path

from tftool.base.errors import UsageError
from tftool.base.report import Judgement, Report
from tftool.ros.host.installation import InstalledPart, installed_parts
from tftool.ros.host.package_files import Package
from tftool.ros.host.workspace import Workspace, missing_package


def judge_packages(names: Sequence[str]) -> list[Report]:
    """Check packages given by name or folder, and return the report.

    Raises:
        UsageError: If there is no such package.
        InputError: If a file of one cannot be read.
    """
    workspace = Workspace(Path.cwd())
    return [_report(_package(workspace, name), workspace) for name in names]


def _package(workspace: Workspace, name: str) -> Package:
    found = workspace.packages.get(name)
    for package in () if found else workspace.packages.values():
        if package.path == Path(name).resolve():
            found = package
    if found is None:
        raise UsageError(missing_package(name, workspace))
    return found


def _report(package: Package, workspace: Workspace) -> Report:
    parts: dict[str, InstalledPart] = {}
    for part in installed_parts(package, workspace.packages):
        parts.setdefault(part.subject, part)
    judgements = [
        Judgement(part.subject, not part.fault, "found by ROS 2", part.fault or "declared")
        for part in parts.values()
    ]
    return Report(package.name, str(package.path), tuple(judgements))
