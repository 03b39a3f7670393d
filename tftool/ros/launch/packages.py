"""Functions of ament_index_python, which return the folders of packages."""

from pathlib import Path

from tftool.base.errors import UsageError
from tftool.ros.host.workspace import current


class PackageNotFoundError(KeyError):
    """Error for an unknown package."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


def get_package_share_directory(package_name: str, print_warning: bool = True) -> str:
    """Return a package's share directory; for a package in a workspace, its source folder.

    Raises:
        PackageNotFoundError: If there is no such package.
    """
    try:
        return str(current().share(package_name))
    except UsageError as error:
        raise PackageNotFoundError(str(error)) from None


def get_package_share_path(package_name: str, print_warning: bool = True) -> Path:
    """Return a package's share directory as a Path."""
    return Path(get_package_share_directory(package_name))


def get_package_prefix(package_name: str) -> str:
    """Return a package's share directory, because a package that is not installed has no prefix."""
    return get_package_share_directory(package_name)


def get_packages_with_prefixes() -> dict[str, str]:
    """Return a mapping from the name of every package to its source folder."""
    return {name: str(package.path) for name, package in current().packages.items()}


def get_resources(resource_type: str) -> dict[str, str]:
    """Return {package name: source folder} for the type "packages"; {} for all other types."""
    return get_packages_with_prefixes() if resource_type == "packages" else {}


def has_resource(resource_type: str, resource_name: str) -> str | None:
    """Return the folder that contains a resource; None if there is no such resource."""
    return get_resources(resource_type).get(resource_name)


def get_resource(resource_type: str, resource_name: str) -> tuple[str, str]:
    """Return the content of a resource, which is always "", and the folder that contains it.

    Raises:
        LookupError: If there is no such resource.
    """
    prefix = has_resource(resource_type, resource_name)
    if prefix is None:
        raise LookupError(
            f"Could not find the resource '{resource_name}' of type '{resource_type}'"
        )
    return "", prefix
