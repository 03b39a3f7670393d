import pytest

from tftool.base.errors import InputError, UsageError
from tftool.ros.host import names, parameter_files


@pytest.mark.parametrize(
    ("given", "full"),
    [
        ("scan", "space/scan"),
        ("/scan", "scan"),
        ("~/scan", "space/node/scan"),
        ("~", "space/node"),
        ("a/b", "space/a/b"),
        ("{node}/b", "space/node/b"),
        ("/{namespace}/b", "space/b"),
    ],
)
def test_names_expand_to_full_ones(given, full):
    assert names.expand(given, "node", "/space") == full


@pytest.mark.parametrize(
    ("given", "at"),
    [
        ("", 0),
        ("a//b", 2),
        ("1a", 0),
        ("a b", 1),
        ("a-b", 1),
        ("a/1", 2),
        ("~a", 0),
        ("a/~", 2),
        ("{no}", 0),
        ("{node", 0),
        ("a/", 1),
        ("/", 0),
    ],
)
def test_an_invalid_topic_name_is_refused_and_its_fault_is_located(given, at):
    assert names.topic_name_fault(given).at == at
    with pytest.raises(UsageError, match="cannot be a topic's"):
        names.expand(given, "node", "")


def test_the_tutorials_names_are_names():
    for name in ("~", "~/pose", "/turtle1/pose", "a_b/c1", "{node}/x", "_hidden"):
        assert names.topic_name_fault(name) is None
    assert names.namespace_fault("/") is None
    assert names.namespace_fault("/robot1/arm") is None
    assert names.namespace_fault("robot").at == 0
    assert names.namespace_fault("/a-b").at == 2
    assert names.node_name_fault("").reason == "it must not be empty"
    assert names.node_name_fault("2x").reason == "it must not start with a number"


def test_ros_arguments_are_taken_out_of_a_nodes_own():
    options, own = names.parse(
        ["a", "--ros-args", "-r", "x:=y", "-p", "n:=2.0", "--log-level", "debug", "--", "b",
         "--ros-args", "--remap", "me:__node:=you", "--param", "you:list:=[1, 2]",
         "--log-level", "you:=warn", "--disable-stdout-logs", "-e", "/secret", "z:=w"]
    )  # fmt: skip

    assert own == ["a", "b"]
    assert options.name == "you"
    assert options.remaps == [names.Remap(None, "x", "y"), names.Remap(None, "z", "w")]
    assert options.parameters_for("you", "") == {"n": 2.0, "list": [1, 2]}
    assert options.parameters_for("other", "") == {"n": 2.0}
    assert options.levels == {"": "DEBUG", "you": "WARN"}


@pytest.mark.parametrize("slip", ["--ros-arg", "-ros-args", "--ros_args", "--rosargs"])
def test_a_slip_in_what_begins_ros_2s_arguments_is_told(slip):
    with pytest.raises(UsageError, match="did you mean '--ros-args'"):
        names.parse([slip, "-p", "speed:=2.0"])


@pytest.mark.parametrize("level", ["bogus", "me:=wran", "me:="])
def test_a_log_level_that_is_none_is_told(level):
    with pytest.raises(UsageError, match=f"'{level}' is not a log level: write debug, info"):
        names.parse(["--ros-args", "--log-level", level])


def test_a_rename_may_hold_for_one_node_alone():
    options, _ = names.parse(["--ros-args", "-r", "one:a:=b"])

    assert options.remapped("a", "one", "") == "b"
    assert options.remapped("a", "two", "") == "a"


@pytest.mark.parametrize(
    ("pattern", "fits"),
    [
        ("/**", True),
        # As in ROS 2, this is a node without a namespace.
        ("node", False),
        ("/space/node", True),
        ("/*/node", True),
        ("/**/node", True),
        ("/space/*", True),
        ("/other/node", False),
        ("nod", False),
    ],
)
def test_a_parameter_file_names_nodes_by_patterns(tmp_path, pattern, fits):
    file = tmp_path / "p.yaml"
    file.write_text(f"'{pattern}':\n  ros__parameters:\n    a: {{b: 1}}\n")
    options, _ = names.parse(["--ros-args", "--params-file", str(file)])

    assert options.parameters_for("node", "space") == ({"a.b": 1} if fits else {})


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("a: [", r"p\.yaml:\d+:\d+: "),
        ("node: {a: 1}", "the file contains no parameters: write 'node_name:'"),
        ("\xff", "it is not UTF-8 text"),
    ],
)
def test_a_wrong_parameter_file_is_refused(tmp_path, text, told):
    file = tmp_path / "p.yaml"
    file.write_bytes(text.encode("latin-1"))

    with pytest.raises(InputError, match=told):
        parameter_files.read_parameters(file)


def test_a_value_that_is_no_yaml_is_a_text():
    assert parameter_files.yaml_value("[1, 2") == "[1, 2"
    assert parameter_files.yaml_value("") == ""


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2", 2),
        ("-0x1F", -31),
        ("010", 8),
        ("2.0", 2.0),
        ("1e3", 1000.0),
        (".5", 0.5),
        (".inf", float("inf")),
        ("yes", True),
        ("[1, 2.5]", [1, 2.5]),
        ("12:30", "12:30"),
        ("2024-01-05", "2024-01-05"),
        ("2024-13-45", "2024-13-45"),
        ("1_000", "1_000"),
        ("!!int x", "!!int x"),
        ("turtle1", "turtle1"),
    ],
)
def test_a_value_is_what_ros_2_takes_it_for(text, value):
    found = parameter_files.yaml_value(text)

    assert found == value
    assert type(found) is type(value)


def test_a_parameter_file_is_read_like_a_single_value(tmp_path):
    file = tmp_path / "params.yaml"
    file.write_text("a:\n  ros__parameters: {day: 2024-01-05, at: 12:30, far: 1e3}\n")

    assert parameter_files.read_parameters(file) == [
        ("/a", "day", "2024-01-05"),
        ("/a", "at", "12:30"),
        ("/a", "far", 1000.0),
    ]


def test_a_tab_after_a_value_is_read_as_libyaml_reads_it(tmp_path):
    file = tmp_path / "params.yaml"
    file.write_text("a:\n  ros__parameters:\n    port: 2368\t\t# of the lidar\n")

    assert parameter_files.read_parameters(file) == [("/a", "port", 2368)]


def test_names_can_be_asked_for_as_in_rclpy(ros_runtime):
    from rclpy.exceptions import (
        InvalidNamespaceException,
        InvalidNodeNameException,
        InvalidParameterException,
        InvalidServiceNameException,
        InvalidTopicNameException,
    )
    from rclpy.expand_topic_name import expand_topic_name
    from rclpy.validate_full_topic_name import validate_full_topic_name
    from rclpy.validate_namespace import validate_namespace
    from rclpy.validate_node_name import validate_node_name
    from rclpy.validate_parameter_name import validate_parameter_name
    from rclpy.validate_topic_name import validate_topic_name

    assert validate_node_name("robot")
    assert validate_namespace("/hall")
    assert validate_topic_name("~/scan")
    assert validate_full_topic_name("/hall/scan")
    assert validate_parameter_name("arm.length")
    assert expand_topic_name("~/scan", "robot", "/hall") == "/hall/robot/scan"
    for refusal, ask in (
        (InvalidNodeNameException, lambda: validate_node_name("my robot")),
        (InvalidNamespaceException, lambda: validate_namespace("hall")),
        (InvalidTopicNameException, lambda: validate_topic_name("a//b")),
        (InvalidServiceNameException, lambda: validate_topic_name("a b", is_service=True)),
        (InvalidTopicNameException, lambda: validate_full_topic_name("scan")),
        (InvalidServiceNameException, lambda: validate_full_topic_name("/", is_service=True)),
        (InvalidParameterException, lambda: validate_parameter_name("")),
        (InvalidNodeNameException, lambda: expand_topic_name("scan", "", "/")),
    ):
        with pytest.raises(refusal):
            ask()
