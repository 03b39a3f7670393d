import pytest


@pytest.fixture
def node(ros_runtime):
    import rclpy

    rclpy.init()
    return rclpy.create_node("probe")


def test_parameters_are_declared_with_types_and_read_back(node):
    from rclpy.parameter import Parameter, parameter_value_to_python

    node.declare_parameters(
        "arm",
        [("reach", 0.5), ("joints", ["a", "b"]), ("speed", Parameter.Type.DOUBLE), ("free",)],
    )
    node.declare_parameter("on", True)

    assert node.get_parameter("arm.reach").get_parameter_value().double_value == 0.5
    assert parameter_value_to_python(node.get_parameter("on").get_parameter_value()) is True
    assert node.get_parameter("arm.joints").value == ["a", "b"]
    assert node.has_parameter("arm.speed")
    assert not node.has_parameter("arm.length")
    assert [one.name for one in node.get_parameters(["on", "arm.reach"])] == ["on", "arm.reach"]
    assert set(node.get_parameters_by_prefix("arm")) == {"reach", "joints", "speed", "free"}
    assert node.get_parameter_types(["on"]) == [Parameter.Type.BOOL]
    assert node.get_parameter_or("gone").value is None
    assert node.get_parameter_or("gone", Parameter("gone", value=3)).value == 3
    assert node.get_parameter_or("on").value is True
    assert sorted(node.list_parameters(["arm"]).names) == [
        "arm.free", "arm.joints", "arm.reach", "arm.speed",
    ]  # fmt: skip
    node.undeclare_parameter("on")
    assert not node.has_parameter("on")


def test_a_parameter_without_a_value_cannot_be_read(node):
    from rclpy.exceptions import ParameterUninitializedException
    from rclpy.parameter import Parameter

    node.declare_parameter("speed", Parameter.Type.DOUBLE)
    with pytest.raises(ParameterUninitializedException, match="'speed' is not initialized"):
        node.get_parameter("speed")
    node.set_parameters([Parameter("speed", value=1.5)])

    assert node.get_parameter("speed").value == 1.5


def test_wrong_declarations_and_accesses_are_refused(node):
    from rclpy.exceptions import ParameterAlreadyDeclaredException, ParameterNotDeclaredException
    from rclpy.parameter import Parameter

    node.declare_parameter("speed", 1.0)
    with pytest.raises(ParameterAlreadyDeclaredException):
        node.declare_parameter("speed", 2.0)
    with pytest.raises(ParameterNotDeclaredException, match="did you mean 'speed'"):
        node.set_parameters([Parameter("sped", value=1.0)])
    with pytest.raises(ParameterNotDeclaredException):
        node.describe_parameter("gone")
    with pytest.raises(TypeError):
        node.declare_parameter("", 1)
    with pytest.raises(TypeError, match="not one of the allowed types"):
        node.declare_parameter("mixed", [1, "a"])
    with pytest.raises(ValueError, match="do not agree"):
        Parameter("a", Parameter.Type.INTEGER, "x")
    with pytest.raises(TypeError, match=r"Parameter\.Type"):
        Parameter("a", 3, 3)


def test_types_ranges_and_read_only_are_kept(node):
    from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
    from rclpy.exceptions import (
        InvalidParameterValueException,
        ParameterImmutableException,
    )
    from rclpy.parameter import Parameter

    digits = [IntegerRange(from_value=0, to_value=9)]
    node.declare_parameter(
        "n", 5, ParameterDescriptor(integer_range=digits, description="a number")
    )
    node.declare_parameter("x", 0.5, ParameterDescriptor(
        floating_point_range=[FloatingPointRange(from_value=0.0, to_value=1.0)]))  # fmt: skip
    node.declare_parameter("fixed", 1, ParameterDescriptor(read_only=True))
    node.declare_parameter("any", 1, ParameterDescriptor(dynamic_typing=True))
    node.declare_parameter("open")

    def reason(name, value):
        return node.set_parameters([Parameter(name, value=value)])[0].reason

    assert "out of range" in reason("n", 10)
    assert "out of range" in reason("x", 1.5)
    assert "read-only" in reason("fixed", 2)
    assert "is not allowed" in reason("n", "a")
    assert "cannot be undeclared" in reason("n", None)
    assert reason("any", "text") == ""
    assert reason("open", 2.5) == ""
    assert reason("n", 9) == ""
    assert node.get_parameter("n").value == 9
    assert node.describe_parameter("n").description == "a number"
    assert node.describe_parameters(["x"])[0].type == Parameter.Type.DOUBLE
    with pytest.raises(ParameterImmutableException):
        node.undeclare_parameter("fixed")
    with pytest.raises(InvalidParameterValueException, match="out of range"):
        node.declare_parameter("m", 50, ParameterDescriptor(integer_range=digits))
    node.set_descriptor("n", ParameterDescriptor(description="another"))
    assert node.describe_parameter("n").description == "another"


def test_callbacks_judge_change_and_hear_of_what_is_set(node):
    from rcl_interfaces.msg import SetParametersResult
    from rclpy.parameter import Parameter

    node.declare_parameter("a", 1)
    node.declare_parameter("b", 1)
    heard = []

    def judge(changes):
        return SetParametersResult(successful=all(one.value < 5 for one in changes), reason="big")

    node.add_on_set_parameters_callback(judge)
    node.add_pre_set_parameters_callback(
        lambda changes: [*changes, Parameter("b", value=changes[0].value + 1)]
    )
    node.add_post_set_parameters_callback(lambda changes: heard.append([c.name for c in changes]))

    assert node.set_parameters_atomically([Parameter("a", value=3)]).successful
    assert node.get_parameter("b").value == 4
    assert not node.set_parameters_atomically([Parameter("a", value=4)]).successful
    assert node.get_parameter("a").value == 3
    assert heard == [["a", "b"]]
    node.remove_on_set_parameters_callback(judge)
    assert node.set_parameters_atomically([Parameter("a", value=9)]).successful


def test_undeclared_parameters_are_taken_where_a_node_says_so(ros_runtime):
    import rclpy
    from rclpy.parameter import Parameter

    rclpy.init()
    node = rclpy.create_node(
        "free",
        allow_undeclared_parameters=True,
        automatically_declare_parameters_from_overrides=True,
        parameter_overrides=[Parameter("given", value=7)],
    )

    assert node.get_parameter("given").value == 7
    assert node.get_parameter("nothing").value is None
    assert node.set_parameters([Parameter("new", value="x")])[0].successful
    assert node.get_parameter("new").value == "x"


def test_other_nodes_get_set_list_and_describe_them(node, ros_runtime):
    import rclpy
    from rcl_interfaces.srv import (
        DescribeParameters,
        GetParameters,
        GetParameterTypes,
        ListParameters,
        SetParameters,
        SetParametersAtomically,
    )
    from rclpy.parameter import Parameter

    node.declare_parameter("speed", 1.0)
    rclpy.get_global_executor().add_node(node)
    asker = rclpy.create_node("asker", start_parameter_services=False)

    def ask(kind, name, **fields):
        client = asker.create_client(kind, f"/probe/{name}")
        return client.call(kind.Request(**fields), timeout_sec=1.0)

    rclpy.get_global_executor().add_node(asker)
    value = Parameter("speed", value=2.0).to_parameter_msg()
    wrong = Parameter("gone", value=2.0).to_parameter_msg()

    assert ask(GetParameters, "get_parameters", names=["speed"]).values[0].double_value == 1.0
    assert list(ask(GetParameterTypes, "get_parameter_types", names=["speed"]).types) == [3]
    assert ask(SetParameters, "set_parameters", parameters=[value]).results[0].successful
    assert not ask(SetParameters, "set_parameters", parameters=[wrong]).results[0].successful
    name = "set_parameters_atomically"
    assert ask(SetParametersAtomically, name, parameters=[value]).result.successful
    assert not ask(SetParametersAtomically, name, parameters=[wrong]).result.successful
    assert "speed" in ask(ListParameters, "list_parameters").result.names
    described = ask(DescribeParameters, "describe_parameters", names=["speed", "gone"])
    assert [one.name for one in described.descriptors] == ["speed"]
    assert node.get_parameter("speed").value == 2.0


def test_parameters_show_compare_and_travel_as_messages(ros_runtime):
    from rclpy.parameter import Parameter, get_parameter_value

    for value in (True, 3, 2.5, "x", [True], [1, 2], [1.5], ["a"], [b"\x01"], []):
        made = Parameter("p", value=value)
        assert Parameter.from_parameter_msg(made.to_parameter_msg()) == made
    assert repr(Parameter("p", value=1)).startswith("Parameter(name='p'")
    assert get_parameter_value("2.5").double_value == 2.5
    assert Parameter.Type.DOUBLE_ARRAY.check([])
    assert not Parameter.Type.DOUBLE.check(object())
