"""Search for the robot's mesh files that the 3-D view in the browser requests.

File names in a description are untrusted. Only meshes and textures inside the folders of
`MeshFolders` are served. Absolute paths and `file://` are refused, and so are paths that leave
these folders by `..` or a symbolic link.
"""

import os
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote, unquote
from xml.etree import ElementTree

KINDS = {
    ".stl": "model/stl",
    ".obj": "text/plain; charset=utf-8",
    ".mtl": "text/plain; charset=utf-8",
    ".dae": "text/xml; charset=utf-8",
    ".gltf": "model/gltf+json",
    ".glb": "model/gltf-binary",
    ".bin": "application/octet-stream",
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".jpeg": "image/jpeg",
    ".bmp": "image/bmp",
    ".gif": "image/gif",
    ".webp": "image/webp",
}
"""Media types of the files that are served, by the ending of the file's name."""

SHAPES = (".stl", ".obj", ".dae", ".gltf", ".glb")
"""Endings of mesh files that the browser's page can draw."""

LARGEST = 256 * 1024 * 1024
"""Maximum size of a served file, bytes."""

DEEPEST = 5
"""Number of folder levels below a given folder that are searched for a package."""

UPWARDS = 3
"""Number of folders above a package that are searched for other packages of its workspace."""

MOST_FOLDERS = 5000
"""Maximum number of folders that are searched for one package."""

_PACKAGE = re.compile(r"package://([A-Za-z0-9_][\w.-]*)/(.+)", re.DOTALL)
_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")


class MeshRefused(Exception):
    """Error for a mesh that is not found, not supported or not allowed."""


@dataclass(frozen=True, slots=True)
class ServedFile:
    """Media type and bytes of a file that the 3-D view in the browser requested."""

    kind: str
    content: bytes


class MeshFolders:
    """Folders from which meshes are served to the 3-D view in the browser.

    Attributes:
        roots: Folders with served files; a file's address is `/mesh/<index of the folder>/<path>`.
    """

    def __init__(self, description: Path | None = None, given: Sequence[Path] = ()) -> None:
        """Find the folders that may contain meshes.

        Args:
            description: File of the robot's description, or None. The ROS package that contains the
                file, and packages beside this package, are searched.
            given: Folders that contain ROS packages, or are packages themselves.
        """
        self.roots: list[Path] = []
        self._given = [folder.resolve() for folder in given]
        self._beside = None if description is None else description.resolve().parent
        self._packages: dict[str, Path | None] = {}

    def address(self, name: str) -> str:
        """Return the address at which the browser finds a mesh or texture.

        Args:
            name: File name in the description: `package://…`, or a relative path.

        Raises:
            MeshRefused: If the file is missing in the folders, or must not be served.
        """
        root, path = self._place(name)
        found = self._inside(root, path)
        if root not in self.roots:
            self.roots.append(root)
        shown = quote(found.as_posix())
        return f"/mesh/{self.roots.index(root)}/{shown}"

    def read(self, address: str) -> ServedFile:
        """Return the mesh or texture at an address that the browser requests.

        Raises:
            MeshRefused: If the file is missing, or must not be served.
        """
        match = re.fullmatch(r"/mesh/(\d{1,6})/(.+)", address)
        if match is None or int(match[1]) >= len(self.roots):
            raise MeshRefused("No mesh has this address: reload the page.")
        root = self.roots[int(match[1])]
        path = root / self._inside(root, unquote(match[2]))
        try:
            if path.stat().st_size > LARGEST:
                raise MeshRefused(f"'{path.name}' is larger than {LARGEST:,} bytes.")
            return ServedFile(KINDS[path.suffix.lower()], path.read_bytes())
        except OSError as error:
            raise MeshRefused(f"'{path.name}' cannot be read: {error.strerror}.") from error

    def _place(self, name: str) -> tuple[Path, str]:
        """Split a mesh's name into the folder to search, and the mesh's path in this folder."""
        match = _PACKAGE.fullmatch(name)
        if match:
            package = self._package(match[1])
            if package is None:
                raise MeshRefused(
                    f"package '{match[1]}' of '{name}' is not found: name its folder with "
                    "--meshes FOLDER"
                )
            return package, match[2]
        if _SCHEME.match(name):
            raise MeshRefused(f"'{name}' cannot be shown: use package:// or a relative path")
        if name.startswith(("/", "\\")):
            raise MeshRefused(
                f"'{name}' cannot be shown: absolute paths are not allowed, use package:// or a "
                "relative path"
            )
        for root in self._relative_roots():
            try:
                self._inside(root, name)
            except MeshRefused:
                continue
            return root, name
        # A path such as ../meshes/arm.stl refers to the package that contains the description.
        if self._beside is not None:
            for package in self._around():
                path = Path(os.path.normpath(self._beside / name))
                if path.is_relative_to(package):
                    return package, path.relative_to(package).as_posix()
        roots = self._relative_roots()
        if not roots:
            raise MeshRefused(f"'{name}' is not found: name its folder with --meshes FOLDER")
        return roots[0], name

    def _relative_roots(self) -> list[Path]:
        return [*([] if self._beside is None else [self._beside]), *self._given]

    def _inside(self, root: Path, name: str) -> Path:
        """Return a file's path relative to `root`, after a check that `root` contains the file.

        Raises:
            MeshRefused: If the path leads out of the folder, or is not a mesh or texture.
        """
        if "\0" in name or "\\" in name:
            raise MeshRefused(
                f"the name of the mesh {name!r} contains a backslash or a zero character"
            )
        path = Path(os.path.normpath(root / name))
        if not path.is_relative_to(root):
            raise MeshRefused(
                f"'{name}' is outside of the folder '{root.name}', so it cannot be shown"
            )
        if path.suffix.lower() not in KINDS:
            raise MeshRefused(f"'{name}' is not a mesh or texture ({', '.join(SHAPES)})")
        try:
            real = path.resolve(strict=True)
        except (OSError, RuntimeError):
            raise MeshRefused(f"there is no file '{name}' in '{root.name}'") from None
        if not real.is_relative_to(root.resolve()):
            raise MeshRefused(
                f"'{name}' is a symbolic link that leads out of the folder '{root.name}'"
            )
        if real.suffix.lower() not in KINDS or not real.is_file():
            raise MeshRefused(f"'{name}' is not a mesh or texture ({', '.join(SHAPES)})")
        return path.relative_to(root)

    def _package(self, name: str) -> Path | None:
        if name not in self._packages:
            found = next((one for one in self._candidates(name) if one.is_dir()), None)
            self._packages[name] = None if found is None else found.resolve()
        return self._packages[name]

    def _candidates(self, name: str) -> Iterator[Path]:
        for folder in self._given:
            if folder.name == name or package_name(folder) == name:
                yield folder
            yield folder / name
            yield from _below(folder, name)
        for package in self._around():
            if package.name == name or package_name(package) == name:
                yield package
        # Other packages are usually in the same folder; folders without package.xml are not served.
        for package in self._around():
            if (package.parent / name / "package.xml").is_file():
                yield package.parent / name
        for variable, inside in (("ROS_PACKAGE_PATH", ""), ("AMENT_PREFIX_PATH", "share")):
            for entry in filter(None, os.environ.get(variable, "").split(os.pathsep)):
                yield Path(entry) / inside / name

    def _around(self) -> list[Path]:
        """Return the ROS packages whose folders contain the description, the innermost first."""
        if self._beside is None:
            return []
        above = [self._beside, *self._beside.parents][:6]
        return [folder for folder in above if (folder / "package.xml").is_file()]


def package_name(folder: Path) -> str:
    """Return the package name in the package.xml of a folder; "" without such a file or name."""
    try:
        raw = (folder / "package.xml").read_bytes()
        if len(raw) > 1 << 20 or b"<!DOCTYPE" in raw or b"<!ENTITY" in raw:
            return ""
        return (ElementTree.fromstring(raw).findtext("name") or "").strip()
    except (OSError, ElementTree.ParseError, ValueError):
        return ""


def packages_around(file: Path, name: str) -> Iterator[Path]:
    """Yield folders that may be the package `name`, in the workspace that contains a file.

    The search goes up from the file's package to the workspace's src, at most `UPWARDS` folders.
    """
    above = file.resolve().parents
    own = next((folder for folder in above if (folder / "package.xml").is_file()), None)
    if own is None:
        yield from _below(above[0], name)
        return
    if package_name(own) == name:
        yield own
    for root in own.parents[:UPWARDS]:
        if root in (Path(root.anchor), Path.home()):
            return
        yield from _below(root, name)
        if root.name == "src":
            return


def _below(folder: Path, name: str) -> Iterator[Path]:
    """Yield folders below `folder` that may be the package `name`, least nested first."""
    level: Iterable[Path] = [folder]
    seen = 0
    for _ in range(DEEPEST):
        deeper = []
        for one in level:
            try:
                children = sorted(
                    child
                    for child in one.iterdir()
                    if child.is_dir() and not child.is_symlink() and child.name[:1] != "."
                )
            except OSError:
                continue
            for child in children:
                seen += 1
                if seen > MOST_FOLDERS:
                    return
                if (child / "package.xml").is_file() and (
                    child.name == name or package_name(child) == name
                ):
                    yield child
                deeper.append(child)
        level = deeper
