"""Tests of behaviour that ROS 2's own tests of rclpy check and that programs use."""

import pytest


def test_of_two_services_of_one_name_the_second_answers_when_the_first_has_left(node):
    import rclpy
    from std_srvs.srv import Trigger

    def answering(text):
        def answer(request, response):
            response.message = text
            return response

        return answer

    first = node.create_service(Trigger, "ask", answering("first"))
    node.create_service(Trigger, "ask", answering("second"))
    client = node.create_client(Trigger, "ask")

    def ask():
        future = client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(node, future, timeout_sec=5.0)
        return future.result().message

    assert ask() == "first"
    node.destroy_service(first)
    assert ask() == "second"


def test_a_parameter_file_may_name_a_node_several_times_and_is_read_as_ros_reads_it(node, tmp_path):
    import rclpy

    file = tmp_path / "wild.yaml"
    file.write_text(
        "/**:\n  ros__parameters:\n    everywhere: 1\n"
        "/**:\n  talker:\n    ros__parameters:\n      by_name: 2\n"
        "robot:\n  '*':\n    ros__parameters:\n      in_robot: 3\n"
        "robot:\n  talker:\n    ros__parameters:\n      exact: 4\n"
        "talker:\n  ros__parameters:\n    without_namespace: 5\n"
        "other:\n  talker:\n    ros__parameters:\n      elsewhere: 6\n"
    )

    def given(namespace):
        made = rclpy.create_node(
            "talker",
            namespace=namespace,
            cli_args=["--ros-args", "--params-file", str(file)],
            automatically_declare_parameters_from_overrides=True,
        )
        names = {"everywhere", "by_name", "in_robot", "exact", "without_namespace", "elsewhere"}
        return {name for name in names if made.has_parameter(name)}

    assert given("/robot") == {"everywhere", "by_name", "in_robot", "exact"}
    assert given("") == {"everywhere", "by_name", "without_namespace"}


def test_a_name_with_a_strange_character_is_refused_in_the_words_of_ros(node):
    from rclpy.expand_topic_name import expand_topic_name
    from rclpy.validate_namespace import validate_namespace
    from rclpy.validate_topic_name import validate_topic_name

    with pytest.raises(ValueError, match="must not contain characters"):
        validate_topic_name("/chat?")
    with pytest.raises(ValueError, match="must not start with a number"):
        validate_topic_name("/chat/4")
    with pytest.raises(ValueError, match="unknown substitution"):
        validate_topic_name("chat/{bad}")
    with pytest.raises(ValueError, match="empty"):
        validate_namespace("")
    with pytest.raises(ValueError, match="must be absolute"):
        validate_namespace("robot")
    with pytest.raises(ValueError, match="node name"):
        expand_topic_name("chat", "bad?", "/")


def test_a_topics_end_may_be_described_bit_by_bit(node):
    from rclpy.topic_endpoint_info import TopicEndpointInfo, TopicEndpointTypeEnum
    from rclpy.type_hash import TypeHash

    info = TopicEndpointInfo(node_name="talker")
    info.endpoint_type = TopicEndpointTypeEnum.PUBLISHER

    assert info == TopicEndpointInfo(
        node_name="talker", endpoint_type=TopicEndpointTypeEnum.PUBLISHER
    )
    told = str(info).splitlines()
    assert told[0] == "Node name: talker"
    assert "Endpoint type: PUBLISHER" in told
    assert "  Reliability: UNKNOWN" in told
    assert str(TypeHash()) == "INVALID"
    assert str(TypeHash(version=1, value=b"\xab" * 32)) == "RIHS01_" + "ab" * 32


def test_a_clock_of_ros_time_is_a_ros_clock_and_no_ended_context_sleeps(node):
    import rclpy
    from rclpy.clock import Clock, ROSClock
    from rclpy.clock_type import ClockType
    from rclpy.context import Context
    from rclpy.duration import Duration
    from rclpy.exceptions import NotInitializedException
    from rclpy.time_source import CLOCK_TOPIC, TimeSource

    assert isinstance(Clock(clock_type=ClockType.ROS_TIME), ROSClock)
    assert not isinstance(Clock(), ROSClock)
    with pytest.raises(NotInitializedException):
        Clock().sleep_for(Duration(seconds=1), context=Context())
    source = TimeSource(node=node)
    source.attach_clock(ROSClock())
    with pytest.raises(ValueError, match="ROS_TIME"):
        source.attach_clock(Clock())
    assert CLOCK_TOPIC == "/clock"
    context = Context()
    rclpy.init(context=context, domain_id=12)
    assert context.get_domain_id() == 12
    context.destroy()
    assert not context.ok()


def test_a_timers_info_has_the_nodes_time(node):
    from rclpy.clock_type import ClockType
    from rclpy.time import Time
    from rclpy.timer import TimerInfo

    from tests.ros.spinning import spin

    told = []

    def note(info: TimerInfo):
        told.append(info)

    node.create_timer(0.5, note)
    spin(node, 0.75)

    assert told[0].expected_call_time.clock_type is ClockType.ROS_TIME
    assert TimerInfo(expected_call_time=5).expected_call_time == Time(nanoseconds=5)


def test_types_can_be_told_apart(node):
    from rclpy import type_support
    from rclpy.exceptions import NoTypeSupportImportedException
    from std_msgs.msg import String
    from std_srvs.srv import Empty

    class Kind(type):
        _TYPE_SUPPORT = None

    class Mock(metaclass=Kind):
        pass

    type_support.check_for_type_support(String)
    type_support.check_for_type_support(Empty)
    type_support.check_is_valid_msg_type(String)
    type_support.check_is_valid_srv_type(Empty)
    with pytest.raises(RuntimeError):
        type_support.check_is_valid_msg_type(Empty)
    with pytest.raises(RuntimeError):
        type_support.check_is_valid_srv_type(String)
    with pytest.raises(NoTypeSupportImportedException):
        type_support.check_for_type_support(Mock)
    with pytest.raises(AttributeError):
        type_support.check_for_type_support(object())


def test_a_log_method_refuses_another_severity(node):
    from rclpy.logging import LoggingSeverity

    logger = node.get_logger()
    with pytest.raises(TypeError, match="multiple values for argument 'severity'"):
        logger.fatal("stop", severity=LoggingSeverity.DEBUG)


def test_levels_of_loggers_have_messages_and_can_be_forgotten(node, monkeypatch, tmp_path):
    import rclpy.logging
    from rcl_interfaces.msg import LoggerLevel
    from rcl_interfaces.srv import GetLoggerLevels, SetLoggerLevels

    asked = SetLoggerLevels.Request(levels=[LoggerLevel(name="talker", level=40)])
    assert asked.levels[0].level == LoggerLevel.LOG_LEVEL_ERROR
    assert GetLoggerLevels.Request(names=["talker"]).names == ["talker"]
    rclpy.logging.set_logger_level("talker", rclpy.logging.LoggingSeverity.ERROR)
    rclpy.logging.clear_config()
    assert rclpy.logging.get_logger_effective_level("talker").name == "INFO"
    with pytest.raises(RuntimeError):
        rclpy.logging.get_logging_severity_from_string("LOUD")
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    assert rclpy.logging.get_logging_directory() == tmp_path


def test_with_verbose_a_run_says_what_of_the_workspace_it_skips(tmp_path, monkeypatch, capsys):
    from tftool.app.main import main

    (tmp_path / "odd").mkdir()
    (tmp_path / "odd" / "setup.cfg").write_text("x = 1\n")
    (tmp_path / "node.py").write_text("print('ran')\n")
    monkeypatch.chdir(tmp_path)

    assert main(["run", "--verbose", "--simulated", "--for", "1", "node.py"]) == 0
    assert "odd' is skipped" in capsys.readouterr().err
    assert main(["run", "--simulated", "--for", "1", "node.py"]) == 0
    assert "is skipped" not in capsys.readouterr().err


def test_parameters_are_set_one_after_the_other_until_one_is_not_declared(node):
    from rclpy.exceptions import ParameterNotDeclaredException
    from rclpy.parameter import Parameter

    node.declare_parameter("first", 1)
    with pytest.raises(ParameterNotDeclaredException, match="nowhere"):
        node.set_parameters([Parameter("first", value=2), Parameter("nowhere", value=3)])

    assert node.get_parameter("first").value == 2
    with pytest.raises(TypeError, match="42 is not a Parameter"):
        node.set_parameters([42])


def test_parameters_that_a_pre_set_callback_returns_are_validated(node):
    from rclpy.exceptions import ParameterNotDeclaredException
    from rclpy.parameter import Parameter

    node.declare_parameter("first", 1)
    change = [Parameter("first", value=2)]

    def add_another(parameters):
        return [*parameters, Parameter("nowhere", value=3)]

    node.add_pre_set_parameters_callback(add_another)
    with pytest.raises(ParameterNotDeclaredException, match="nowhere"):
        node.set_parameters_atomically(change)
    node.remove_pre_set_parameters_callback(add_another)
    node.add_pre_set_parameters_callback(lambda parameters: [])
    result = node.set_parameters_atomically(change)

    assert (result.successful, node.get_parameter("first").value) == (False, 1)
    assert "parameter list cannot be empty" in result.reason


def test_a_descriptor_changes_all_but_name_and_type_unless_the_value_no_longer_fits(node):
    from rcl_interfaces.msg import IntegerRange, ParameterDescriptor, ParameterType, ParameterValue
    from rclpy.exceptions import InvalidParameterValueException, ParameterImmutableException

    node.declare_parameter("gain", 5)
    node.declare_parameter("fixed", "x", ParameterDescriptor(read_only=True))
    narrow = [IntegerRange(from_value=0, to_value=3, step=1)]

    with pytest.raises(InvalidParameterValueException, match="out of range"):
        node.set_descriptor("gain", ParameterDescriptor(integer_range=narrow))
    assert node.describe_parameter("gain").integer_range == []

    told = ParameterDescriptor(
        name="other", type=ParameterType.PARAMETER_STRING, integer_range=narrow
    )
    two = ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=2)
    assert node.set_descriptor("gain", told, two).integer_value == 2
    described = node.describe_parameter("gain")
    assert (described.name, described.type) == ("gain", ParameterType.PARAMETER_INTEGER)
    assert node.get_parameter("gain").value == 2
    with pytest.raises(ParameterImmutableException):
        node.set_descriptor("fixed", ParameterDescriptor())


def test_a_parameter_without_a_value_gives_way_to_an_alternative(node):
    from rcl_interfaces.msg import ParameterValue
    from rclpy.parameter import Parameter, get_parameter_value, parameter_value_to_python

    node.declare_parameter("later", Parameter.Type.INTEGER)

    assert node.get_parameter_or("later", Parameter("other", value=7)).value == 7
    assert node.has_parameter("start_type_description_service")
    with pytest.raises(ValueError, match="do not agree"):
        Parameter("x", Parameter.Type.NOT_SET, 42)
    with pytest.raises(ValueError, match="ParameterValue is not a default value"):
        node.declare_parameter("x", ParameterValue())
    assert get_parameter_value("null").string_value == "null"
    with pytest.raises(RuntimeError, match="42"):
        parameter_value_to_python(ParameterValue(type=42))
    with pytest.warns(UserWarning, match="'y' is declared without a value"):
        node.declare_parameters("", [("y",)])


def test_a_multithreaded_executor_returns_from_spinning_while_a_callback_runs(ros_runtime):
    import rclpy
    from rclpy.callback_groups import ReentrantCallbackGroup
    from rclpy.executors import MultiThreadedExecutor
    from rclpy.task import Future
    from std_msgs.msg import Empty

    rclpy.init()
    node = rclpy.create_node("probe")
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    begun, ended, heard = Future(), Future(), []

    def long(message):
        begun.set_result(None)
        for _ in range(50):
            ros_runtime.sleep(0.1)
            if heard:
                break
        ended.set_result(bool(heard))

    group = ReentrantCallbackGroup()
    node.create_subscription(Empty, "long", long, 1, callback_group=group)
    node.create_subscription(Empty, "short", heard.append, 1, callback_group=group)
    node.create_publisher(Empty, "long", 1).publish(Empty())
    executor.spin_until_future_complete(begun)
    node.create_publisher(Empty, "short", 1).publish(Empty())
    executor.spin_until_future_complete(ended)

    assert ended.result()


def test_wait_for_message_and_a_call_work_on_a_context_of_their_own(ros_runtime):
    import rclpy
    from rclpy.context import Context
    from rclpy.wait_for_message import wait_for_message
    from std_msgs.msg import Int32

    context = Context()
    rclpy.init(context=context)
    node = rclpy.create_node("probe", context=context)

    def publish():
        publisher = node.create_publisher(Int32, "number", 1)
        while not node.count_subscribers("number"):
            ros_runtime.sleep(0.1)
        publisher.publish(Int32(data=7))

    ros_runtime.start(publish)

    found, message = wait_for_message(Int32, node, "number", time_to_wait=10.0)

    assert (found, message.data) == (True, 7)


def test_the_end_of_a_context_or_of_a_rate_wakes_who_sleeps_by_it(ros_runtime):
    import rclpy
    from rclpy.clock import Clock
    from rclpy.context import Context
    from rclpy.duration import Duration
    from rclpy.exceptions import ROSInterruptException

    context = Context()
    rclpy.init(context=context)
    node = rclpy.create_node("probe", context=context)
    slow, slower = node.create_rate(1e-6), node.create_rate(1e-6)
    ends = {}

    def sleep(name, wait):
        def body():
            try:
                ends[name] = wait()
            except ROSInterruptException:
                ends[name] = "interrupted"

        ros_runtime.start(body)

    sleep("clock", lambda: Clock().sleep_for(Duration(seconds=1e6), context=context))
    sleep("destroyed", slow.sleep)
    sleep("shut down", slower.sleep)
    ros_runtime.sleep(1.0)
    assert node.destroy_rate(slow)
    assert not node.destroy_rate(slow)
    rclpy.shutdown(context=context)
    ros_runtime.sleep(1.0)

    assert ends == {"clock": False, "destroyed": None, "shut down": "interrupted"}
    with pytest.raises(RuntimeError, match="destroyed"):
        slow.sleep()


def test_two_services_of_one_name_are_counted(node):
    from std_srvs.srv import Trigger

    node.create_service(Trigger, "ask", lambda request, response: response)
    second = node.create_service(Trigger, "ask", lambda request, response: response)
    assert node.count_services("ask") == 2
    node.destroy_service(second)
    assert node.count_services("ask") == 1


def test_a_parameter_without_a_value_is_answered_with_no_values(node):
    from rcl_interfaces.srv import GetParameters
    from rclpy.parameter import Parameter

    node.declare_parameter("unset", Parameter.Type.STRING)
    node.declare_parameter("set", 3)
    client = node.create_client(GetParameters, "probe/get_parameters")

    def values(*names):
        return client.call(GetParameters.Request(names=names), timeout_sec=5.0).values

    assert [one.integer_value for one in values("set")] == [3]
    assert values("set", "unset") == values("set", "gone") == []


def test_init_refuses_an_argument_with_a_surrogate_and_installs_no_signal_handlers(ros_runtime):
    import rclpy
    from rclpy.signals import SignalHandlerOptions, get_current_signal_handlers_options

    with pytest.raises(UnicodeEncodeError):
        rclpy.init(args=["node.py", "Ragnar\udcc3k"])
    assert get_current_signal_handlers_options() == SignalHandlerOptions.NO
    rclpy.init()
    assert get_current_signal_handlers_options() == SignalHandlerOptions.ALL
