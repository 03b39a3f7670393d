import re

import pytest

from tftool.base.errors import UsageError
from tftool.messages.classes import INTERFACES
from tftool.ros.host import executables
from tftool.ros.host.workspace import Workspace
from tftool.ros.testing import RosRuntime


def package(folder, **files):
    folder.mkdir(parents=True)
    for name, text in files.items():
        (folder / name.replace("__", ".")).write_text(text)
    return folder


SETUP = """
from setuptools import setup
name = 'from_' + 'setup'
scripts = [f'{name}_node = mod:main']
setup(name=name, entry_points={'console_scripts': scripts + ['other = mod.sub: run [extra]']})
"""
CFG = """
[metadata]
name = from_cfg
[options.entry_points]
console_scripts =
    one = mod:main
    two=mod:other
"""
TOML = """
[project]
name = "from_toml"
[project.scripts]  # program to run
node = "mod:main"
"quoted-one" = 'mod:other'
[tool.x]
node = "no"
"""


CMAKE = """
project(mixed)
add_executable(counter src/counter.cpp)
# add_executable(old src/old.cpp)
foreach(target a b)
  add_executable( ${target}_node src/${target}.cpp)
endforeach()
add_executable(${PROJECT_NAME}_main main.cpp)
"""


@pytest.mark.parametrize("name", ["counter", "a_node", "mixed_main", "old", "main"])
def test_an_executable_in_cpp_is_named_as_such(tmp_path, name):
    text = "<package><name>mixed</name></package>"
    package(tmp_path / "src" / "mixed", package__xml=text, CMakeLists__txt=CMAKE)
    told = (
        f"package 'mixed' has no executable '{name}' (it has none)"
        if name in ("old", "main")
        else f"'mixed {name}' is compiled from C++, so tftool cannot run it: run it with ROS 2, "
        "and connect to it by tftool's option --dds"
    )

    with pytest.raises(UsageError, match=f"^{re.escape(told)}$"):
        executables.find(Workspace(tmp_path), "mixed", name)


@pytest.mark.parametrize(
    ("file", "text", "name", "scripts"),
    [
        ("setup__py", SETUP, "from_setup", {"from_setup_node": "mod:main", "other": "mod.sub:run"}),
        ("setup__cfg", CFG, "from_cfg", {"one": "mod:main", "two": "mod:other"}),
        ("pyproject__toml", TOML, "from_toml", {"node": "mod:main", "quoted-one": "mod:other"}),
        ("package__xml", "<package><name>from_xml</name></package>", "from_xml", {}),
        ("setup__py", "setup(", "pkg", {}),
        ("setup__py", "print('nothing')", "pkg", {}),
        ("setup__py", "from s import setup\nsetup(entry_points=made())", "pkg", {}),
    ],
)
def test_a_packages_scripts_are_read_and_nothing_is_run(tmp_path, file, text, name, scripts):
    package(tmp_path / "src" / "pkg", **{file: text})

    found = Workspace(tmp_path).package(name)

    assert found.scripts == scripts
    assert found.path == tmp_path / "src" / "pkg"


INSTALLS = """
import os
from glob import glob
from setuptools import setup
package_name = 'arm_demo'
setup(
    name=package_name,
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        (os.path.join('share', package_name), glob('urdf/*')),
        (os.path.join('share', package_name, 'launch'), glob(os.path.join('bring_up', '*.py'))),
        (f'share/{package_name}/config', ['cfg/arm.yaml', 'cfg/gone.yaml', made()]),
        ('share/' + package_name + '/../../out', ['package.xml']),
    ],
)
"""


def test_a_share_directory_holds_what_setup_py_installs_there(tmp_path):
    folder = package(
        tmp_path / "src" / "arm", setup__py=INSTALLS, package__xml="<name>arm_demo</name>"
    )
    package(folder / "urdf", arm__urdf="<robot/>")
    package(folder / "bring_up", arm__launch__py="bring up")
    package(folder / "launch", other__launch__py="other")
    package(folder / "cfg", arm__yaml="gain: 1")

    workspace = Workspace(tmp_path)
    share = workspace.share("arm_demo")

    assert (share / "arm.urdf").read_text() == "<robot/>"
    assert (share / "launch" / "arm.launch.py").read_text() == "bring up"
    assert (share / "launch" / "other.launch.py").read_text() == "other"
    assert (share / "config" / "arm.yaml").read_text() == "gain: 1"
    assert (share / "urdf" / "arm.urdf").is_file()
    assert (share / "package.xml").is_file()
    assert not (tmp_path / "out").exists()
    assert {one.name for one in share.iterdir()} == {
        *("arm.urdf", "launch", "config", "urdf", "bring_up", "cfg", "package.xml", "setup.py"),
    }


def test_a_share_directory_is_the_sources_where_everything_lies_in_place(tmp_path):
    listed = (
        "[('share/x/launch', __import__('glob').glob('launch/*')), ('share/x', ['package.xml'])]"
    )
    setup = f"setup(name='x', data_files={listed})"
    folder = package(tmp_path / "src" / "x", setup__py=setup, package__xml="<name>x</name>")
    package(folder / "launch", x__launch__py="")

    assert Workspace(tmp_path).share("x") == folder


def test_build_folders_and_hidden_ones_hold_no_packages(tmp_path):
    for folder in ("build", "install", "log", ".git"):
        package(tmp_path / folder / "pkg", package__xml="<package><name>x</name></package>")
    package(tmp_path / "src" / "off", package__xml="<name>off</name>", COLCON_IGNORE="")

    assert Workspace(tmp_path).packages == {}
    with pytest.raises(UsageError, match="there are no packages"):
        Workspace(tmp_path).package("x")


def test_a_workspace_is_found_from_inside_a_package(tmp_path):
    for name in ("a", "b"):
        package(tmp_path / "src" / name, package__xml=f"<package><name>{name}</name></package>")
    for folder in ("src", "test"):  # of a package in C++
        (tmp_path / "src" / "b" / folder).mkdir()

    for start in ("a", "b", "b/test"):
        assert set(Workspace(tmp_path / "src" / start).packages) == {"a", "b"}
    with pytest.raises(UsageError, match="there are a, b"):
        Workspace(tmp_path / "src" / "a").package("zzz")


def test_a_node_installed_as_a_script_is_found_by_its_name(tmp_path):
    folder = package(tmp_path / "pkg", package__xml="<package><name>pkg</name></package>")
    package(folder / "scripts", talk__py="", listen="#!/usr/bin/env python3\n", data="x")
    found = Workspace(tmp_path).package("pkg")

    assert found.script_file("talk") == folder / "scripts" / "talk.py"
    assert found.script_file("listen") == folder / "scripts" / "listen"
    assert found.script_file("data") is None
    assert found.script_file("gone") is None


@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("setup.cfg", b"\xff"),
        ("setup.cfg", b"[broken"),
        ("setup.cfg", b"name = x"),
        ("package.xml", b"<name>\xff</name>"),
        ("setup.py", b"\0"),
        ("msg/Bad.msg", b"\xff"),
    ],
)
def test_a_package_that_cannot_be_read_does_not_stop_the_others(tmp_path, file, text):
    package(tmp_path / "good", package__xml="<package><name>good</name></package>")
    package(tmp_path / "odd", pyproject__toml="")
    (tmp_path / "odd" / file).parent.mkdir(exist_ok=True)
    (tmp_path / "odd" / file).write_bytes(text)

    found = Workspace(tmp_path)

    assert "good" in found.packages
    if file != "setup.py":
        (skipped,) = found.skipped
        assert file.rpartition("/")[2] in skipped
        with pytest.raises(UsageError, match=r"(?s)no package 'zz'.*odd' is skipped: "):
            found.package("zz")


def test_a_setup_file_nested_too_deep_names_no_scripts(tmp_path):
    package(tmp_path / "deep", setup__py=f"setup(name={'-' * 100_000}1)")

    assert Workspace(tmp_path).packages["deep"].scripts == {}


def test_interfaces_of_a_package_named_as_a_module_of_python_are_left_out(tmp_path):
    import sys

    odd = package(tmp_path / "sys", package__xml="<package><name>sys</name></package>")
    package(odd / "msg", Ball__msg="float64 radius\n")
    found = Workspace(tmp_path)

    assert "'sys' has the name of a module of Python" in found.skipped[0]
    with RosRuntime():
        import sys as again

        assert again is sys


def test_a_folder_without_package_xml_is_named(tmp_path):
    package(tmp_path / "src" / "robot", node__py="")

    with pytest.raises(UsageError, match=r"robot' has no package\.xml"):
        Workspace(tmp_path).package("robot")


def test_the_folder_named_is_the_packages_and_not_that_of_its_modules(tmp_path):
    package(tmp_path / "src" / "robot" / "robot", node__py="")

    with pytest.raises(UsageError, match=r"src.robot' has no package\.xml"):
        Workspace(tmp_path).package("robot")


def test_a_packages_own_interfaces_can_be_imported(tmp_path):
    folder = package(
        tmp_path / "my_shapes", package__xml="<package><name>my_shapes</name></package>"
    )
    package(folder / "msg" / "solids", Ball__msg="float64 radius 2.5\ngeometry_msgs/Point center\n")
    package(folder / "srv", Grow__srv="float64 by\n---\nmy_shapes/Ball ball\n")
    Workspace(tmp_path)
    try:
        with RosRuntime():
            from my_shapes.msg import Ball
            from my_shapes.srv import Grow

            assert Grow.Response().ball == Ball(radius=2.5)
    finally:
        INTERFACES.add("my_shapes", {})


def test_a_package_may_have_both_interfaces_and_python_modules(tmp_path):
    from tftool.ros.host import importing

    folder = package(tmp_path / "both", package__xml="<package><name>both</name></package>")
    package(folder / "msg", Ball__msg="float64 radius 2.5\n")
    (package(folder / "both" / "core") / "__init__.py").touch()
    (folder / "both" / "__init__.py").write_text("KIND = 'own'\n")
    (folder / "both" / "core" / "sizes.py").write_text("from both.msg import Ball\nBALL = Ball()\n")
    node = folder / "node.py"
    node.write_text(
        "import both, both.msg\nfrom both.core.sizes import BALL\nimport rclpy\nrclpy.init()\n"
        "rclpy.create_node('n').get_logger().info(f'{both.KIND} {BALL == both.msg.Ball()}')\n"
    )
    workspace = Workspace(tmp_path)
    try:
        with RosRuntime() as runtime:
            importing.search_last(workspace.module_folders)
            runtime.start(node)
            runtime.sleep(1.0)

        assert runtime.log("n") == ["own True"]
    finally:
        INTERFACES.add("both", {})


def test_python_packages_that_cmake_installs_are_found_under_their_own_names(tmp_path):
    folder = package(
        tmp_path / "src" / "robot",
        package__xml="<package><name>robot</name></package>",
        CMakeLists__txt="project(robot)\nament_python_install_package(robot_lib)\n"
        'ament_python_install_package(\n  deep PACKAGE_DIR "python/deep")\n'
        "ament_python_install_package(${PROJECT_NAME})\n",
    )
    for module in ("robot_lib", "python/deep", "src/robot"):
        (package(folder / module) / "__init__.py").touch()

    found = Workspace(tmp_path).module_folders()
    assert sorted(found) == [str(folder), str(folder / "python"), str(folder / "src")]


def test_programs_that_cmake_installs_run_from_any_folder_under_any_name(tmp_path):
    folder = package(
        tmp_path / "robot",
        package__xml="<package><name>robot</name></package>",
        CMakeLists__txt="project(robot)\ninstall(PROGRAMS\n  robot/deep/talk.py  # a node\n"
        "  ${CMAKE_CURRENT_SOURCE_DIR}/robot/listen.py tools/tool.sh\n"
        "  DESTINATION lib/${PROJECT_NAME}\n)\n"
        "install(PROGRAMS bin/main.py DESTINATION lib/${PROJECT_NAME} RENAME hello)\n"
        "# install(PROGRAMS robot/old.py DESTINATION lib/robot)\n",
    )
    places = ("robot/deep/talk.py", "robot/listen.py", "bin/main.py", "robot/old.py")
    for place in (*places, "tools/tool.sh"):
        (folder / place).parent.mkdir(parents=True, exist_ok=True)
        (folder / place).touch()

    found = Workspace(tmp_path).package("robot").programs
    assert {name: str(path.relative_to(folder)) for name, path in found.items()} == {
        "talk.py": "robot/deep/talk.py",
        "listen.py": "robot/listen.py",
        "hello": "bin/main.py",
    }


def test_folders_that_cmake_installs_are_found_where_ros_would_have_them(tmp_path):
    folder = package(
        tmp_path / "arm",
        package__xml="<package><name>arm</name></package>",
        CMakeLists__txt="install(DIRECTORY description/urdf launch DESTINATION share/arm)\n"
        "install(DIRECTORY bringup/ DESTINATION share/${PROJECT_NAME})\n"
        "install(FILES plain.yaml DESTINATION share/arm/config)\n",
    )
    for place in ("description/urdf/arm.urdf", "launch/arm.launch.py", "bringup/urdf/extra.urdf"):
        (folder / place).parent.mkdir(parents=True, exist_ok=True)
        (folder / place).write_text(place)
    (folder / "plain.yaml").write_text("plain")

    workspace = Workspace(tmp_path)
    share = workspace.share("arm")
    assert (share / "urdf/arm.urdf").read_text() == "description/urdf/arm.urdf"
    assert (share / "urdf/extra.urdf").read_text() == "bringup/urdf/extra.urdf"
    assert (share / "config/plain.yaml").read_text() == "plain"
    assert (share / "launch/arm.launch.py").is_file()


def test_of_two_packages_of_one_name_the_one_below_src_counts(tmp_path):
    for place in ("docker/robot", "src/robot"):
        package(tmp_path / place, package__xml="<package><name>robot</name></package>")

    assert Workspace(tmp_path).package("robot").path == tmp_path / "src" / "robot"


def test_two_programs_of_one_module_share_no_globals(tmp_path):
    from tftool.ros.host import user_code

    folder = package(tmp_path / "pkg", node__py="import aside\ncount = []\n")
    (folder / "aside.py").write_text("seen = []\n")
    (folder / "node.py").write_text(
        "import aside\ncount = []\ndef main():\n    count.append(1)\n"
        "    aside.seen.append(1)\n    import rclpy\n    rclpy.init()\n"
        "    rclpy.create_node('n').get_logger().info(f'{len(count)} {len(aside.seen)}')\n"
    )
    with RosRuntime() as runtime:
        for _ in range(2):
            runtime.start(user_code.entry_point_body("node", "main", root=folder))
            runtime.sleep(0.1)

        assert runtime.log() == ["1 1", "1 1"]


def test_a_console_script_that_names_nothing_says_so(tmp_path):
    from tftool.ros.host import user_code

    folder = package(tmp_path / "pkg", node__py="")
    ended = []
    with RosRuntime() as runtime:
        from tftool.ros.host.program import Program

        body = user_code.entry_point_body("node", "main", root=folder)
        runtime.ask(lambda: Program(runtime.world, "it", body, on_exit=ended.append))
        runtime.sleep(0.1)

    assert "names node:main, but there is no 'main' in" in str(ended[0].failure)


def test_a_linked_package_is_found_and_other_links_are_not_followed(tmp_path):
    package(tmp_path / "away" / "linked", package__xml="<package><name>linked</name></package>")
    package(tmp_path / "away" / "other", package__xml="<package><name>other</name></package>")
    source = tmp_path / "ws" / "src"
    source.mkdir(parents=True)
    (source / "mine").symlink_to(tmp_path / "away" / "linked")
    (source / "loop").symlink_to(tmp_path)

    assert list(Workspace(tmp_path / "ws").packages) == ["linked"]


def test_tested_modules_get_the_test_loader_except_those_of_tftool(tmp_path, monkeypatch):
    import sys

    from tftool.ros.host import importing

    (tmp_path / "tftool").mkdir()
    (tmp_path / "tftool" / "late.py").write_text("")
    (tmp_path / "helpers.py").write_text("")
    finder = importing._Finder()
    finder.tested = tmp_path
    monkeypatch.setattr(sys, "meta_path", [finder, *sys.meta_path])

    theirs = finder.find_spec("helpers", [str(tmp_path)])
    ours = finder.find_spec("tftool.late", [str(tmp_path / "tftool")])

    assert isinstance(theirs.loader, importing._TestedLoader)
    assert not isinstance(ours.loader, importing._TestedLoader)


def test_a_file_that_needs_no_package_of_the_workspace_reads_none(ros_runtime, tmp_path):
    from tftool.ros.host import importing
    from tftool.ros.host.workspace import Workspace

    folder = tmp_path / "src" / "helpers"
    (folder / "helpers").mkdir(parents=True)
    (folder / "helpers" / "__init__.py").write_text("WORD = 'found'\n")
    (folder / "setup.py").write_text("from setuptools import setup\nsetup(name='helpers')\n")
    workspace = Workspace(tmp_path)
    asked = []

    def folders():
        asked.append(True)
        return workspace.module_folders()

    importing.search_last(folders)
    file = tmp_path / "talk.py"
    told = "rclpy.create_node('talk').get_logger().info({})\n"
    file.write_text("import math\nimport rclpy\nrclpy.init()\n" + told.format("'up'"))
    ros_runtime.start(file)
    ros_runtime.sleep(1)
    assert (ros_runtime.log("talk"), asked) == (["up"], [])

    file.write_text("import helpers\nimport rclpy\nrclpy.init()\n" + told.format("helpers.WORD"))
    ros_runtime.start(file)
    ros_runtime.sleep(1)
    assert (ros_runtime.log("talk"), asked) == (["up", "found"], [True])


def test_of_packages_of_one_name_the_nearest_to_the_file_is_used(tmp_path):
    xml = "<package><name>robot</name></package>"
    first, second = (
        package(tmp_path / chapter / "src" / "robot", package__xml=xml)
        for chapter in ("chapter_1", "chapter_2")
    )

    for folder in (first, second):
        near = folder.parent / "bringup" / "launch" / "a.launch.py"
        assert Workspace(tmp_path, near).packages["robot"].path == folder
