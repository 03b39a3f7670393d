import pytest


def test_parameters_are_declared_with_types_and_read_back(node):
    from rclpy.parameter import Parameter, parameter_value_to_python

    node.declare_parameters(
        "arm", [("reach", 0.5), ("joints", ["a", "b"]), ("speed", Parameter.Type.DOUBLE)]
    )
    node.declare_parameter("arm.free")
    node.declare_parameter("on", True)

    assert node.get_parameter("arm.reach").get_parameter_value().double_value == 0.5
    assert parameter_value_to_python(node.get_parameter("on").get_parameter_value()) is True
    assert node.get_parameter("arm.joints").value == ["a", "b"]
    assert node.has_parameter("arm.speed")
    assert not node.has_parameter("arm.length")
    assert [one.name for one in node.get_parameters(["on", "arm.reach"])] == ["on", "arm.reach"]
    assert set(node.get_parameters_by_prefix("arm")) == {"reach", "joints", "speed", "free"}
    assert node.get_parameter_types(["on"]) == [Parameter.Type.BOOL]
    assert node.get_parameter_type("on") == Parameter.Type.BOOL
    assert node.get_parameter_or("gone").value is None
    assert node.get_parameter_or("gone", Parameter("gone", value=3)).value == 3
    assert node.get_parameter_or("on").value is True
    assert sorted(node.list_parameters(["arm"]).names) == [
        "arm.free", "arm.joints", "arm.reach", "arm.speed",
    ]  # fmt: skip
    node.undeclare_parameter("on")
    assert not node.has_parameter("on")


OWN = ("use_sim_time", "start_type_description_service")
"""Names of the parameters that every node declares."""


@pytest.mark.parametrize(
    ("prefixes", "depth", "names"),
    [
        ([], 0, {*OWN, "arm", "arm.reach", "arm.hand.grip"}),
        ([], 1, {*OWN, "arm"}),
        ([], 2, {*OWN, "arm", "arm.reach"}),
        (["arm"], 0, {"arm", "arm.reach", "arm.hand.grip"}),
        (["arm"], 1, {"arm", "arm.reach"}),
        (["arm.hand", "use_sim_time"], 1, {"arm.hand.grip", "use_sim_time"}),
    ],
)
def test_parameters_are_listed_as_deep_as_asked(node, prefixes, depth, names):
    for name in ("arm", "arm.reach", "arm.hand.grip"):
        node.declare_parameter(name, 1.0)

    assert set(node.list_parameters(prefixes, depth).names) == names


def test_a_parameter_without_a_value_cannot_be_read(node):
    from rclpy.exceptions import ParameterUninitializedException
    from rclpy.parameter import Parameter

    node.declare_parameter("speed", Parameter.Type.DOUBLE)
    with pytest.raises(ParameterUninitializedException, match="'speed' is not initialized"):
        node.get_parameter("speed")
    node.set_parameters([Parameter("speed", value=1.5)])

    assert node.get_parameter("speed").value == 1.5


def test_wrong_declarations_and_accesses_are_refused(node):
    from rclpy.exceptions import (
        InvalidParameterException,
        ParameterAlreadyDeclaredException,
        ParameterNotDeclaredException,
    )
    from rclpy.parameter import Parameter

    node.declare_parameter("speed", 1.0)
    with pytest.raises(ParameterAlreadyDeclaredException):
        node.declare_parameter("speed", 2.0)
    with pytest.raises(ParameterNotDeclaredException, match="did you mean 'speed'"):
        node.set_parameters([Parameter("sped", value=1.0)])
    with pytest.raises(ParameterNotDeclaredException):
        node.describe_parameter("gone")
    with pytest.raises(InvalidParameterException):
        node.declare_parameter("", 1)
    with pytest.raises(TypeError, match="a string, not int"):
        node.declare_parameter(1, 1)
    with pytest.raises(TypeError, match="must be a ParameterDescriptor, not str"):
        node.declare_parameter("described", 1, "what it is for")
    with pytest.raises(TypeError, match="list of strings"):
        node.list_parameters("speed", 0)
    with pytest.raises(TypeError, match="an integer, not float"):
        node.list_parameters([], 0.5)
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


def test_the_time_to_wait_for_a_nodes_services_holds_for_all_together(ros_runtime, tmp_path):
    import rclpy
    from rclpy.parameter_client import AsyncParameterClient

    file = tmp_path / "slow.py"
    file.write_text(
        "import time, rclpy\n"
        "from std_srvs.srv import Trigger\n"
        "rclpy.init()\n"
        "node = rclpy.create_node('slow', start_parameter_services=False)\n"
        "for name in ('get_parameters', 'list_parameters', 'set_parameters'):\n"
        "    time.sleep(0.75)\n"
        "    node.create_service(Trigger, f'~/{name}', lambda request, response: response)\n"
        "rclpy.spin(node)\n"
    )
    ros_runtime.start(file)
    rclpy.init()
    client = AsyncParameterClient(rclpy.create_node("probe"), "slow")

    assert not client.wait_for_services(timeout_sec=1.0)
    assert ros_runtime.elapsed() == pytest.approx(1.0)


def test_a_client_asks_for_and_changes_another_nodes_parameters(node, tmp_path):
    import rclpy
    from rcl_interfaces.msg import ParameterType
    from rclpy.parameter import Parameter
    from rclpy.parameter_client import AsyncParameterClient

    robot = rclpy.create_node("robot")
    robot.declare_parameter("speed", 1.0)
    robot.declare_parameter("arm.length", 2)
    file = tmp_path / "p.yaml"
    file.write_text(
        "/**: {ros__parameters: {speed: 4.0}}\nrobot: {ros__parameters: {speed: 5.0}}\n"
    )
    client = AsyncParameterClient(node, "robot")
    executor = rclpy.get_global_executor()
    executor.add_node(robot)
    told = []

    def answer(future):
        rclpy.spin_until_future_complete(node, future, timeout_sec=5.0)
        return future.result()

    assert client.wait_for_services(timeout_sec=1.0)
    assert client.services_are_ready()
    assert "arm.length" in answer(client.list_parameters(["arm"])).result.names
    assert answer(client.get_parameters(["speed"])).values[0].double_value == 1.0
    assert (
        answer(client.get_parameter_types(["arm.length"])).types[0]
        == ParameterType.PARAMETER_INTEGER
    )
    assert answer(client.describe_parameters(["speed"])).descriptors[0].name == "speed"
    change = [Parameter("speed", value=2.5)]
    assert answer(client.set_parameters(change, callback=told.append)).results[0].successful
    rclpy.spin_once(node, timeout_sec=0.0)
    assert told[0].result().results[0].successful
    assert robot.get_parameter("speed").value == 2.5
    wrong = [Parameter("speed", value=3.0), Parameter("arm.length", value="long")]
    assert not answer(client.set_parameters_atomically(wrong)).result.successful
    assert robot.get_parameter("speed").value == 2.5
    assert answer(client.load_parameter_file(str(file))).results[0].successful
    assert robot.get_parameter("speed").value == 5.0
    assert answer(client.load_parameter_file_atomically(str(file), True)).result.successful
    assert not answer(client.delete_parameters(["speed"])).results[0].successful
    assert not AsyncParameterClient(node, "nobody").wait_for_services(timeout_sec=0.1)


def test_callbacks_for_parameter_events_are_called_for_every_change_until_removed(node):
    import rclpy
    from rclpy.parameter import Parameter
    from rclpy.parameter_client import AsyncParameterClient
    from rclpy.parameter_event_handler import ParameterEventHandler

    robot = rclpy.create_node("robot", namespace="hall")
    robot.declare_parameter("speed", 1.0)
    handler = ParameterEventHandler(node)
    heard = []
    one = handler.add_parameter_callback(
        "speed", "hall/robot", lambda p: heard.append(("speed", p.value.double_value))
    )
    every = handler.add_parameter_event_callback(
        lambda e: heard.append((e.node, [p.name for p in handler.get_parameters_from_event(e)]))
    )
    own = AsyncParameterClient(node, "robot").on_parameter_event(
        lambda e: heard.append([p.name for p in e.deleted_parameters])
    )

    def spin():
        for _ in range(8):
            rclpy.spin_once(node, timeout_sec=0)

    robot.set_parameters([Parameter("speed", value=2.0)])
    spin()
    assert heard == [("speed", 2.0), ("/hall/robot", ["speed"]), []]
    heard.clear()
    handler.remove_parameter_callback(one)
    node.destroy_subscription(own)
    robot.declare_parameter("name", "r2")
    node.declare_parameter("mine", 1)
    spin()
    assert heard == [("/hall/robot", ["name"]), ("/probe", ["mine"])]
    heard.clear()
    handler.remove_parameter_event_callback(every)
    with pytest.raises(RuntimeError, match="exist"):
        handler.remove_parameter_event_callback(every)
    handler.destroy()
    robot.undeclare_parameter("name")
    spin()
    assert heard == []
    assert handler.configure_nodes_filter()
    assert not handler.configure_nodes_filter(["/robot"])


def test_a_parameter_file_is_read_as_messages(node, tmp_path):
    from rclpy.parameter import parameter_dict_from_yaml_file

    file = tmp_path / "p.yaml"
    file.write_text(
        "/**: {ros__parameters: {all: 1}}\n"
        "robot: {ros__parameters: {arm: {length: 2.0}}}\n"
        "other: {ros__parameters: {speed: 3}}\n"
    )

    assert sorted(parameter_dict_from_yaml_file(str(file))) == ["arm.length", "speed"]
    chosen = parameter_dict_from_yaml_file(str(file), True, ["/robot"], namespace="x")
    assert {name: p.value.double_value for name, p in chosen.items()} == {
        "x.all": 0.0,
        "x.arm.length": 2.0,
    }
