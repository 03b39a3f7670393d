"""Tests that the page can read only meshes in known folders."""

import pytest

from tests.screens.browser.mesh_files import stl, write_package
from tftool.robots.mesh_folders import MeshFolders, MeshRefused

MESH = "package://arm_description/meshes/a.stl"


@pytest.fixture
def package(tmp_path):
    return write_package(tmp_path / "src")


@pytest.fixture
def secret(tmp_path):
    """Write a mesh and another file outside of the package."""
    (tmp_path / "secret.stl").write_bytes(stl())
    (tmp_path / "passwd").write_text("root:x:0:0")
    return tmp_path / "secret.stl"


@pytest.fixture(autouse=True)
def no_ros(monkeypatch):
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)


def where(package, how):
    """Return the folders for a user who starts the command in some way."""
    return {
        "beside": lambda: MeshFolders(package / "urdf" / "arm.urdf"),
        "given": lambda: MeshFolders(given=[package]),
        "workspace": lambda: MeshFolders(given=[package.parent.parent]),
        "neighbour": lambda: MeshFolders(
            write_package(package.parent, "other") / "urdf" / "arm.urdf"
        ),
    }[how]()


@pytest.mark.parametrize("how", ["beside", "given", "workspace", "neighbour"])
def test_a_package_is_found_around_beside_and_below_what_is_given(package, how):
    folders = where(package, how)
    address = folders.address(MESH)

    assert address == "/mesh/0/meshes/a.stl"
    assert folders.read(address).content == stl()
    assert folders.read("/mesh/0/textures/red.png").kind == "image/png"


def test_a_folder_beside_the_package_that_is_none_is_not_served(package):
    private = package.parent / "private"
    private.mkdir()
    (private / "plan.stl").write_bytes(stl())
    folders = where(package, "beside")

    with pytest.raises(MeshRefused, match="package 'private'"):
        folders.address("package://private/plan.stl")
    assert folders.roots == []


@pytest.mark.parametrize(
    ("variable", "inside"), [("ROS_PACKAGE_PATH", ""), ("AMENT_PREFIX_PATH", "share")]
)
def test_ros_says_where_packages_are(package, tmp_path, monkeypatch, variable, inside):
    share = tmp_path / "ros" / inside
    share.mkdir(parents=True)
    package.rename(share / package.name)
    monkeypatch.setenv(variable, f"/nowhere:{tmp_path / 'ros'}")

    assert MeshFolders().address(MESH) == "/mesh/0/meshes/a.stl"


@pytest.mark.parametrize(
    ("description", "name", "address"),
    [
        ("arm.urdf", "meshes/a.stl", "/mesh/0/meshes/a.stl"),
        ("urdf/arm.urdf", "../meshes/a.stl", "/mesh/0/meshes/a.stl"),
        ("urdf/arm.urdf", "../urdf/../meshes/a.stl", "/mesh/0/meshes/a.stl"),
    ],
)
def test_paths_beside_the_description_stay_in_its_package(package, description, name, address):
    folders = MeshFolders(package / description)

    assert folders.address(name) == address
    assert folders.read(address).content == stl()


@pytest.mark.parametrize(
    "name",
    [
        "package://arm_description/../../secret.stl",
        "package://arm_description/meshes/../../../secret.stl",
        "package://../secret.stl",
        "package://..",
        "package:///etc/passwd",
        "package://arm_description/../../passwd",
        "../../../secret.stl",
        "../../secret.stl",
        "/etc/passwd",
        "{secret}",
        "file://{secret}",
        "FILE://{secret}",
        "file:///etc/passwd",
        "http://example.com/a.stl",
        "C:/secret.stl",
        "..\\..\\secret.stl",
        "package://arm_description/..\\..\\secret.stl",
        "package://arm_description/package.xml",
        "package://arm_description/meshes",
        "package://arm_description/meshes/none.stl",
        "package://nobody/meshes/a.stl",
        "meshes/a.stl\0.png",
        "",
        ".",
    ],
)
def test_nothing_else_has_an_address(package, secret, name):
    for folders in (where(package, "beside"), where(package, "given"), MeshFolders()):
        with pytest.raises(MeshRefused):
            folders.address(name.replace("{secret}", str(secret)))


@pytest.mark.parametrize(
    "path",
    [
        "../../secret.stl",
        "..%2f..%2fsecret.stl",
        "%2e%2e/%2e%2e/secret.stl",
        "meshes/../../../secret.stl",
        "meshes/out.stl",
        "outside/secret.stl",
        "/etc/passwd",
        "%2fetc%2fpasswd",
        "package.xml",
        "meshes/a.stl%00",
        "meshes",
        "",
    ],
)
def test_no_address_leads_out_of_the_folders(package, secret, path):
    folders = where(package, "given")
    folders.address(MESH)
    (package / "meshes" / "out.stl").symlink_to(secret)
    (package / "outside").symlink_to(secret.parent)

    with pytest.raises(MeshRefused):
        folders.read(f"/mesh/0/{path}")


@pytest.mark.parametrize("address", ["/mesh/1/meshes/a.stl", "/mesh/-1/a.stl", "/mesh/x", "/mesh/"])
def test_only_folders_that_are_in_use_are_served(package, address):
    folders = where(package, "given")
    folders.address(MESH)

    with pytest.raises(MeshRefused):
        folders.read(address)


def test_a_link_that_stays_inside_is_followed_and_one_to_another_kind_is_not(package):
    (package / "meshes" / "b.stl").symlink_to("a.stl")
    (package / "meshes" / "c.stl").symlink_to("../package.xml")
    (package / "meshes" / "loop.stl").symlink_to("loop.stl")
    folders = where(package, "given")

    assert folders.read(folders.address(MESH.replace("a.stl", "b.stl"))).content == stl()
    for name in ("c.stl", "loop.stl"):
        with pytest.raises(MeshRefused):
            folders.address(MESH.replace("a.stl", name))


def test_names_with_spaces_and_signs_are_found(package):
    (package / "meshes" / "left arm #1%.stl").write_bytes(stl())
    folders = where(package, "given")
    address = folders.address("package://arm_description/meshes/left arm #1%.stl")

    assert address == "/mesh/0/meshes/left%20arm%20%231%25.stl"
    assert folders.read(address).content == stl()
