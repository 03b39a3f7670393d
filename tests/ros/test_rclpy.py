import pytest


@pytest.fixture
def node(ros_runtime):
    import rclpy

    rclpy.init()
    return rclpy.create_node("probe")


def spin(node, seconds):
    """Serve a node for so many seconds."""
    import rclpy
    from rclpy.task import Future

    rclpy.spin_until_future_complete(node, Future(), timeout_sec=seconds)


# Starting and ending


def test_a_node_needs_init_and_init_comes_once(ros_runtime):
    import rclpy
    from rclpy.exceptions import NotInitializedException

    with pytest.raises(NotInitializedException):
        rclpy.create_node("early")
    with rclpy.init():
        assert rclpy.ok()
        with pytest.raises(RuntimeError, match="once"):
            rclpy.init()
    assert not rclpy.ok()
    with pytest.raises(RuntimeError, match="initialized"):
        rclpy.shutdown()
    rclpy.try_shutdown()


def test_shutdown_in_a_callback_ends_spin_and_tells_who_asked(node):
    import rclpy

    told = []
    node.context.on_shutdown(lambda: told.append("over"))
    node.create_timer(1.0, rclpy.shutdown)
    rclpy.spin(node)

    assert told == ["over"]
    with pytest.raises(rclpy.executors.ExternalShutdownException):
        rclpy.spin_once(node)


def test_a_node_knows_its_names(ros_runtime):
    import rclpy

    rclpy.init()
    node = rclpy.create_node("probe", namespace="robot1")

    assert node.get_name() == "probe"
    assert node.get_namespace() == "/robot1"
    assert node.get_fully_qualified_name() == "/robot1/probe"
    assert node.resolve_topic_name("scan") == "/robot1/scan"
    assert node.resolve_topic_name("/scan") == "/scan"
    assert node.resolve_topic_name("~/scan") == "/robot1/probe/scan"
    assert node.resolve_topic_name("{ns}/{node}/scan") == "/robot1/robot1/probe/scan"


@pytest.mark.parametrize(
    ("use", "refusal", "told"),
    [
        (
            lambda rclpy, node: rclpy.create_node("2 fast"),
            "InvalidNodeNameException",
            "Invalid node name: only letters, digits and '_' are allowed:\n  '2 fast'\n    ^",
        ),
        (
            lambda rclpy, node: rclpy.create_node("n", namespace="a//b"),
            "InvalidNamespaceException",
            "Invalid namespace: there must be something between two '/':\n  '/a//b'\n      ^",
        ),
        (
            lambda rclpy, node: node.resolve_topic_name("a/2b"),
            "InvalidTopicNameException",
            "Invalid topic name: no part may start with a digit:\n  'a/2b'\n     ^",
        ),
        (
            lambda rclpy, node: node.resolve_service_name("a~"),
            "InvalidServiceNameException",
            "Invalid service name: '~' must come first, with a '/' behind it:\n  'a~'\n    ^",
        ),
    ],
)
def test_what_is_no_name_is_shown_with_the_place(node, use, refusal, told):
    import rclpy
    from rclpy import exceptions

    with pytest.raises(exceptions.NameValidationException) as refused:
        use(rclpy, node)

    assert type(refused.value) is getattr(exceptions, refusal)
    assert str(refused.value) == told


def test_what_is_destroyed_is_used_no_more(node):
    from rclpy.exceptions import InvalidHandle
    from std_msgs.msg import Int32

    sender = node.create_publisher(Int32, "numbers", 10)
    assert node.destroy_publisher(sender)
    assert not node.destroy_publisher(sender)
    with pytest.raises(InvalidHandle, match="publisher of '/numbers' is destroyed"):
        sender.publish(Int32())
    node.destroy_node()
    node.destroy_node()
    with pytest.raises(InvalidHandle, match="node 'probe' is destroyed"):
        node.create_timer(1.0, print)


def test_ros_args_rename_nodes_topics_and_set_parameters(ros_runtime):
    import rclpy

    rclpy.init()
    args = ["--ros-args", "-r", "__node:=other", "-r", "__ns:=/here", "-r", "chatter:=talk"]
    node = rclpy.create_node(
        "probe", cli_args=[*args, "-p", "speed:=2.5", "-p", "other:loud:=true"]
    )

    assert node.get_fully_qualified_name() == "/here/other"
    assert node.resolve_topic_name("chatter") == "/here/talk"
    assert node.declare_parameter("speed", 1.0).value == 2.5
    assert node.declare_parameter("loud", False).value is True


def test_two_nodes_of_one_name_are_told_apart_with_a_warning(node, ros_runtime):
    import rclpy

    rclpy.create_node("probe")

    assert any("a node named 'probe' is here already" in text for text in ros_runtime.log())


def test_a_nodes_class_may_call_its_own_things_as_it_likes(node, ros_runtime):
    import rclpy
    from rclpy.node import Node

    class Robot(Node):
        def __init__(self):
            super().__init__("robot")
            self.world = self.program = self.graph = self.frames = self.member = "map"
            self.entities = self.authority = self.wake = self.late = self.forget = None
            self.declare_parameter("speed", 1.0)
            self.ticks = []
            self.create_timer(1.0, self._tick)

        def _tick(self):
            self.ticks.append(self.get_parameter("speed").value)

        def _keep(self):
            raise AssertionError("this is the user's own")

        _join = _destroy = _all = _known = _fault = _on_get = _keep

    robot = Robot()
    rclpy.spin_once(robot)
    robot.destroy_timer(next(robot.timers))
    robot.destroy_node()

    assert robot.ticks == [1.0]
    assert "robot" not in node.get_node_names()


def test_destroying_a_node_silences_it(node, ros_runtime):
    import rclpy
    from std_msgs.msg import Int32

    other = rclpy.create_node("sender")
    sender = other.create_publisher(Int32, "numbers", 10)
    with node:
        node.create_subscription(Int32, "numbers", print, 10)
        assert sender.get_subscription_count() == 1
    assert sender.get_subscription_count() == 0
    assert "probe" not in other.get_node_names()


# Topics


def test_messages_arrive_in_order_as_copies_and_a_queue_keeps_the_newest(node):
    import rclpy
    from std_msgs.msg import Int32

    heard, short = [], []
    sender = node.create_publisher(Int32, "numbers", 10)
    node.create_subscription(Int32, "numbers", lambda m: heard.append(m.data), 10)
    node.create_subscription(Int32, "numbers", lambda m: short.append(m.data), 2)
    message = Int32()
    for number in range(5):
        message.data = number
        sender.publish(message)
    spin(node, 0.1)

    assert heard == [0, 1, 2, 3, 4]
    assert short == [3, 4]
    with pytest.raises(TypeError, match=r"Expected .*Int32"):
        sender.publish("5")
    assert rclpy.ok()


def test_a_late_subscriber_gets_what_is_kept_for_it(node):
    from rclpy.qos import DurabilityPolicy, QoSPresetProfiles, QoSProfile
    from std_msgs.msg import String

    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    sender = node.create_publisher(String, "map", latched)
    sender.publish(String(data="old"))
    sender.publish(String(data="new"))
    late, plain = [], []
    node.create_subscription(String, "map", lambda m: late.append(m.data), latched)
    node.create_subscription(
        String, "map", lambda m: plain.append(m.data), QoSPresetProfiles.SENSOR_DATA.value
    )
    spin(node, 0.1)

    assert late == ["new"]
    assert plain == []
    node.destroy_publisher(sender)
    node.create_subscription(String, "map", lambda m: late.append(m.data), latched)
    spin(node, 0.1)
    assert late == ["new"]


def test_a_callback_may_ask_for_the_message_info(node):
    from std_msgs.msg import String

    heard = []
    node.create_subscription(String, "talk", lambda m, info: heard.append(info), 1)
    node.create_publisher(String, "talk", 1).publish(String())
    spin(node, 0.1)

    assert heard[0]["source_timestamp"] == 1000 * 10**9


def test_messages_can_be_had_and_sent_as_their_bytes(node):
    import rclpy
    from rclpy.serialization import deserialize_message, serialize_message
    from std_msgs.msg import Int32, String

    heard = []
    node.create_subscription(Int32, "numbers", heard.append, 10, raw=True)
    sender = node.create_publisher(Int32, "numbers", 10)
    # Plain CDR, little endian: a header of four bytes, then the number's four.
    data = b"\x00\x01\x00\x00\x2a\x00\x00\x00"
    sender.publish(Int32(data=42))
    sender.publish(data)
    rclpy.spin_once(node)
    rclpy.spin_once(node)

    assert heard == [data, data]
    assert deserialize_message(data, Int32) == Int32(data=42)
    text = String(data="día")
    assert deserialize_message(serialize_message(text), String) == text
    with pytest.raises(TypeError, match="expected a message, got str"):
        serialize_message("text")
    with pytest.raises(Exception, match="std_msgs/msg/Int32"):
        sender.publish(b"\x00\x01")


def test_a_twist_keeps_the_parts_a_turtle_does_not_read(node):
    from geometry_msgs.msg import Twist

    heard = []
    node.create_subscription(Twist, "cmd_vel", heard.append, 1)
    sent = Twist()
    sent.linear.x, sent.linear.z, sent.angular.x = 1.0, 2.0, 3.0
    node.create_publisher(Twist, "cmd_vel", 1).publish(sent)
    spin(node, 0.1)

    assert heard == [sent]


def test_a_topic_carries_one_type(node):
    from geometry_msgs.msg import Twist
    from turtlesim.msg import Pose

    node.create_publisher(Twist, "turtle1/cmd_vel", 1)
    with pytest.raises(Exception, match="'turtle1/cmd_vel' carries Twist2D, not Pose2D"):
        node.create_subscription(Pose, "turtle1/cmd_vel", print, 1)


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda node: node.create_publisher(int, "a", 1), "expected a message class"),
        (lambda node: node.create_timer(1.0, None), "a callback must be callable"),
        (lambda node: node.create_client(int, "a"), "expected a service class"),
    ],
)
def test_what_is_no_type_or_callback_is_refused(node, make, told):
    with pytest.raises(TypeError, match=told):
        make(node)


def test_the_graph_can_be_asked(node):
    from std_msgs.msg import Int32

    node.create_publisher(Int32, "numbers", 1)
    node.create_subscription(Int32, "numbers", print, 1)

    assert ("/numbers", ["std_msgs/msg/Int32"]) in node.get_topic_names_and_types()
    assert ("/tf", ["tf2_msgs/msg/TFMessage"]) in node.get_topic_names_and_types()
    assert node.count_publishers("numbers") == node.count_subscribers("numbers") == 1
    assert node.count_subscribers("nothing") == 0
    assert "/probe/set_parameters" in dict(node.get_service_names_and_types())
    assert [one.topic_name for one in node.publishers] == ["/numbers"]
    assert [one.topic_name for one in node.subscriptions] == ["/numbers"]
    assert list(node.clients) == []
    assert len(list(node.services)) == 6
    assert node.wait_for_node("/probe", 1.0)
    assert not node.wait_for_node("/nobody", 0.5)


# Timers


def test_a_timer_can_be_stopped_started_and_asked(node, ros_runtime):
    fired = []
    timer = node.create_timer(1.0, lambda: fired.append(ros_runtime.elapsed()))
    spin(node, 2.5)
    assert timer.time_until_next_call() == 500_000_000
    assert timer.time_since_last_call() == 500_000_000
    timer.cancel()
    assert timer.is_canceled()
    spin(node, 2.0)
    timer.reset()
    spin(node, 1.5)
    timer.timer_period_ns = 250_000_000
    spin(node, 1.0)

    assert fired == [1.0, 2.0, 5.5, 6.5, 6.75, 7.0]
    assert node.destroy_timer(timer)


def test_a_late_timer_skips_what_it_missed_and_stays_on_its_grid(node, ros_runtime):
    fired = []

    def slow():
        fired.append(ros_runtime.elapsed())
        if len(fired) == 1:
            ros_runtime.sleep(2.3)

    node.create_timer(1.0, slow)
    spin(node, 6.0)

    assert fired == [1.0, 3.3, 4.0, 5.0, 6.0]


def test_a_timer_tells_when_it_was_due(node):
    infos = []
    node.create_timer(0.5, lambda info: infos.append(info))
    spin(node, 0.5)

    assert infos[0].expected_call_time == infos[0].actual_call_time


def test_what_never_waits_cannot_hold_simulated_time_still(node, ros_runtime):
    from std_msgs.msg import Int32

    fast = []
    timer = node.create_timer(0, lambda: fast.append(1))
    spin(node, 0.5)
    timer.cancel()
    assert len(fast) == pytest.approx(500, abs=2)

    sender = node.create_publisher(Int32, "numbers", 10)
    while ros_runtime.elapsed() < 0.502:
        sender.publish(Int32())

    node.create_subscription(Int32, "numbers", sender.publish, 10)
    sender.publish(Int32())
    spin(node, 0.002)
    assert ros_runtime.elapsed() == pytest.approx(0.504, abs=0.002)


def test_a_rate_paces_a_loop(node, ros_runtime):
    rate = node.create_rate(4)
    for _ in range(8):
        rate.sleep()

    assert ros_runtime.elapsed() == 2.0
    rate.destroy()
    with pytest.raises(Exception, match="shutdown"):
        rate.sleep()


# Services


def test_a_service_answers_a_client(node):
    import rclpy
    from example_interfaces.srv import AddTwoInts

    def add(request, response):
        response.sum = request.a + request.b
        return response

    service = node.create_service(AddTwoInts, "add_two_ints", add)
    asker = rclpy.create_node("asker")
    client = asker.create_client(AddTwoInts, "add_two_ints")
    assert client.wait_for_service(timeout_sec=1.0)
    future = client.call_async(AddTwoInts.Request(a=2, b=3))
    executor = rclpy.get_global_executor()
    executor.add_node(node)
    executor.add_node(asker)
    executor.spin_until_future_complete(future, timeout_sec=1.0)

    assert future.result().sum == 5
    node.destroy_service(service)
    assert not client.service_is_ready()
    assert not client.wait_for_service(timeout_sec=0.5)


def test_a_request_nobody_serves_stays_unanswered(node):
    import rclpy
    from std_srvs.srv import Trigger

    future = node.create_client(Trigger, "nobody").call_async(Trigger.Request())
    rclpy.spin_until_future_complete(node, future, timeout_sec=1.0)

    assert not future.done()
    with pytest.raises(TypeError, match="Expected"):
        node.create_client(Trigger, "nobody").call_async("now")


def test_waiting_for_an_answer_inside_a_callback_works(node):
    import rclpy
    from std_srvs.srv import SetBool

    other = rclpy.create_node("server")

    async def answer(request, response):
        response.success = request.data
        return response

    other.create_service(SetBool, "switch", answer)
    client = node.create_client(SetBool, "switch")
    answers = []

    def ask():
        future = client.call_async(SetBool.Request(data=True))
        rclpy.spin_until_future_complete(node, future, timeout_sec=1.0)
        answers.append(future.result().success)
        answers.append(client.call(SetBool.Request(data=False), timeout_sec=1.0).success)

    timer = node.create_timer(1.0, ask)
    executor = rclpy.get_global_executor()
    executor.add_node(other)
    executor.add_node(node)
    executor.spin_once(timeout_sec=2.0)
    timer.cancel()

    assert answers == [True, False]


def test_a_wrong_answer_of_a_service_is_named(node):
    import rclpy
    from std_srvs.srv import Trigger

    node.create_service(Trigger, "go", lambda request, response: None)
    client = node.create_client(Trigger, "go")
    future = client.call_async(Trigger.Request())

    with pytest.raises(TypeError, match=r"service 'go' must return a Trigger\.Response, not None"):
        rclpy.spin_until_future_complete(node, future)


def test_our_own_nodes_may_ask_a_users_service(node, ros_runtime):
    import threading  # noqa: F401

    from turtlesim.srv import Spawn as RosSpawn

    from tftool.messages import Spawn

    def spawn(request, response):
        response.name = f"{request.name} at {request.x}"
        return response

    node.create_service(RosSpawn, "spawn", spawn)
    answers = []

    async def ask():
        answers.append(await ros_runtime.world.call("spawn", Spawn(1.5, 2.0, name="me")))

    import asyncio

    ros_runtime.ask(lambda: [asyncio.get_running_loop().create_task(ask())])
    spin(node, 0.1)

    assert answers[0].name == "me at 1.5"


# Coroutines, guard conditions, executors


def test_a_coroutine_callback_may_await_an_answer(node):
    import rclpy
    from std_srvs.srv import Trigger

    rclpy.get_global_executor().add_node(server := rclpy.create_node("server"))
    server.create_service(
        Trigger, "go", lambda request, response: Trigger.Response(success=True, message="went")
    )
    client = node.create_client(Trigger, "go")
    heard = []

    async def ask():
        answer = await client.call_async(Trigger.Request())
        heard.append(answer.message)

    timer = node.create_timer(0.5, ask)
    spin(node, 0.7)
    timer.cancel()

    assert heard == ["went"]


def test_a_task_runs_on_the_executor_and_keeps_its_result(node):
    import rclpy

    executor = rclpy.get_global_executor()
    executor.add_node(node)

    async def work(number):
        return number * 2

    task = executor.create_task(work, 21)
    plain = executor.create_task(lambda: "done")
    executor.spin_until_future_complete(task, timeout_sec=1.0)
    executor.spin_once_until_future_complete(plain, timeout_sec=1.0)

    assert task.result() == 42
    assert plain.result() == "done"
    broken = executor.create_task(lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        executor.spin_until_future_complete(broken)


def test_a_future_tells_and_can_be_given_up():
    from tftool.ros.client.futures import Future

    told = []
    future = Future()
    future.add_done_callback(told.append)
    assert future.remove_done_callback(told.append)
    future.add_done_callback(lambda one: told.append(one.result()))
    future.set_result(3)
    future.add_done_callback(lambda one: told.append("late"))
    refused = Future()
    refused.set_exception(ValueError("no"))
    given_up = Future()
    given_up.cancel()

    assert told == [3, "late"]
    assert isinstance(refused.exception(), ValueError)
    with pytest.raises(ValueError, match="no"):
        refused.result()
    assert given_up.cancelled()


def test_a_guard_condition_calls_back_once(node):
    called = []
    guard = node.create_guard_condition(lambda: called.append(1))
    guard.trigger()
    guard.trigger()
    spin(node, 0.1)

    assert called == [1]


def test_a_multi_threaded_executor_lets_other_callbacks_through_while_one_blocks(ros_runtime):
    import rclpy
    from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
    from rclpy.executors import MultiThreadedExecutor

    def main():
        rclpy.init()
        node = rclpy.create_node("busy")
        trace = ros_runtime.trace = []

        def slow():
            trace.append(("slow", ros_runtime.elapsed()))
            node.get_clock().sleep_for(rclpy.duration.Duration(seconds=1.2))

        def quick():
            trace.append(("quick", ros_runtime.elapsed()))

        node.create_timer(0.5, slow, callback_group=MutuallyExclusiveCallbackGroup())
        node.create_timer(0.4, quick, callback_group=ReentrantCallbackGroup())
        executor = MultiThreadedExecutor(num_threads=2)
        executor.add_node(node)
        executor.spin()

    ros_runtime.start(main)
    ros_runtime.sleep(2.0)

    assert ros_runtime.trace == [
        ("quick", 0.4),
        ("slow", 0.5),
        ("quick", 0.8),
        ("quick", 1.2),
        ("quick", 1.6),
        ("slow", 1.7),
        ("quick", 2.0),
    ]


def test_a_failing_callback_of_a_multi_threaded_executor_fails_its_program():
    from tftool.errors import NodeFailed
    from tftool.ros.testing import RosRuntime

    def main():
        import rclpy

        rclpy.init()
        node = rclpy.create_node("broken")
        node.create_timer(0.5, lambda: 1 / 0)
        executor = rclpy.executors.MultiThreadedExecutor()
        executor.add_node(node)
        executor.spin()

    def test():
        with RosRuntime() as runtime:
            runtime.start(main)
            with pytest.raises(Exception, match="ended"):
                runtime.sleep(1)

    with pytest.raises(NodeFailed, match="ZeroDivisionError"):
        test()


def test_an_executor_can_be_shut_down(node):
    from rclpy.executors import ShutdownException, SingleThreadedExecutor

    with SingleThreadedExecutor() as executor:
        assert executor.add_node(node)
        assert not executor.add_node(node)
        assert executor.get_nodes() == [node]
    assert executor.get_nodes() == []
    with pytest.raises(ShutdownException):
        executor.spin_once(timeout_sec=0.0)


def test_a_loop_that_only_polls_sees_time_pass(node, ros_runtime):
    import rclpy

    fired = []
    node.create_timer(0.05, lambda: fired.append(1))
    while not fired:
        rclpy.spin_once(node, timeout_sec=0)
    end = node.get_clock().now() + rclpy.duration.Duration(seconds=0.01)
    while node.get_clock().now() < end:
        pass

    assert ros_runtime.elapsed() < 0.2


# Logging


def test_loggers_speak_under_their_names_from_their_level_on(node, ros_runtime):
    from rclpy.logging import LoggingSeverity, get_logger, set_logger_level

    logger = node.get_logger()
    logger.debug("unheard")
    logger.info("one")
    logger.warn("two")
    logger.get_child("part").error("three")
    get_logger("free").fatal("four")
    logger.set_level(LoggingSeverity.ERROR)
    logger.warning("unheard")
    set_logger_level("probe", LoggingSeverity.DEBUG)
    logger.debug("five")

    said = [(record.node, record.level, record.text) for record in ros_runtime.world.log.records]
    assert said == [
        ("probe", "INFO", "one"),
        ("probe", "WARN", "two"),
        ("probe.part", "ERROR", "three"),
        ("free", "FATAL", "four"),
        ("probe", "DEBUG", "five"),
    ]
    assert logger.is_enabled_for(LoggingSeverity.DEBUG)
    for make in (lambda: get_logger(""), lambda: logger.get_child("")):
        with pytest.raises(ValueError, match="must not be empty"):
            make()


def test_a_line_can_be_said_once_or_seldom(node, ros_runtime):
    for _ in range(3):
        node.get_logger().info("once", once=True)
        node.get_logger().info("seldom", throttle_duration_sec=1.5)
        node.get_logger().info("not first", skip_first=True)
        ros_runtime.sleep(1.0)

    assert ros_runtime.log("probe") == ["once", "seldom", "not first", "seldom", "not first"]


def test_two_filters_of_a_line_hold_together(node, ros_runtime):
    logger = node.get_logger()
    for turn in range(4):
        logger.info(f"second {turn}", once=True, skip_first=True)
        logger.info(f"later {turn}", throttle_duration_sec=1.5, skip_first=True)
        logger.info("a", once=True), logger.info("b", once=True)
        ros_runtime.sleep(1.0)
    logger.log("named", 20, name="other")
    with pytest.raises(TypeError, match="thrice"):
        logger.info("a", thrice=True)

    assert ros_runtime.log("probe") == ["a", "b", "second 1", "later 2"]
    assert ros_runtime.log("other") == ["named"]


# Times


def test_times_and_durations_calculate_and_compare(ros_runtime):
    from rclpy.clock import Clock, ClockType
    from rclpy.duration import Duration
    from rclpy.time import Time

    time = Time(seconds=2, nanoseconds=5)

    assert time.nanoseconds == 2_000_000_005
    assert time.seconds_nanoseconds() == (2, 5)
    assert (time + Duration(seconds=1.5)).nanoseconds == 3_500_000_005
    assert time - Duration(nanoseconds=5) == Time(seconds=2)
    assert (time - Time(seconds=1)).nanoseconds == 1_000_000_005
    assert Time(seconds=1) < time <= time
    assert time > Time(seconds=1)
    assert time >= time
    assert Time.from_msg(time.to_msg(), clock_type=ClockType.SYSTEM_TIME) == time
    assert repr(Time()) == "Time(nanoseconds=0, clock_type=SYSTEM_TIME)"
    assert Duration(seconds=1) < Duration(seconds=2) <= Duration(seconds=2)
    assert Duration(seconds=3) > Duration(seconds=2) >= Duration(seconds=2)
    assert Duration(seconds=1) + Duration(seconds=2) == Duration(seconds=3)
    assert Duration(seconds=3) - Duration(seconds=2) == Duration(seconds=1)
    assert (Duration(seconds=1) * 2).nanoseconds == 2_000_000_000
    assert Duration.from_msg(Duration(seconds=-1.5).to_msg()) == Duration(seconds=-1.5)
    assert str(Duration(nanoseconds=3)) == "3 nanoseconds"
    assert repr(Duration(nanoseconds=3)) == "Duration(nanoseconds=3)"
    assert len({time, Time(seconds=2, nanoseconds=5)}) == 1
    clock = Clock(clock_type=ClockType.ROS_TIME)
    assert clock.now().clock_type is ClockType.ROS_TIME
    assert clock.sleep_until(clock.now() + Duration(seconds=2))
    assert ros_runtime.elapsed() == 2.0


@pytest.mark.parametrize(
    ("make", "error", "told"),
    [
        (lambda t, d, c: t.Time(seconds=-1), ValueError, "negative"),
        (lambda t, d, c: t.Time(nanoseconds=-1), ValueError, "negative"),
        (lambda t, d, c: t.Time(clock_type=1), TypeError, "ClockType"),
        (lambda t, d, c: t.Time(seconds=1e12), OverflowError, "too large"),
        (lambda t, d, c: d.Duration(seconds=1e12), OverflowError, "too large"),
        (
            lambda t, d, c: t.Time() < t.Time(clock_type=c.ClockType.ROS_TIME),
            TypeError,
            "different clock types",
        ),
        (lambda t, d, c: t.Time() < 3, TypeError, "Can't compare"),
        (lambda t, d, c: d.Duration() < 3, TypeError, "Can't compare"),
        (lambda t, d, c: t.Time() + t.Time(), TypeError, "unsupported operand"),
        (lambda t, d, c: c.Clock(clock_type=1), TypeError, "ClockType"),
    ],
)
def test_wrong_times_are_refused(ros_runtime, make, error, told):
    import rclpy.clock
    import rclpy.duration
    import rclpy.time

    with pytest.raises(error, match=told):
        make(rclpy.time, rclpy.duration, rclpy.clock)


# Quality of service


def test_a_profile_says_enough_or_is_refused(ros_runtime):
    from rclpy.qos import (
        HistoryPolicy,
        InvalidQoSProfileException,
        QoSPresetProfiles,
        QoSProfile,
        ReliabilityPolicy,
        qos_profile_sensor_data,
    )

    assert QoSPresetProfiles.get_from_short_key("sensor_data") is qos_profile_sensor_data or (
        QoSPresetProfiles.get_from_short_key("sensor_data").value == qos_profile_sensor_data
    )
    assert ReliabilityPolicy.get_from_short_key("best_effort") == ReliabilityPolicy.BEST_EFFORT
    assert ReliabilityPolicy.RELIABLE.short_key == "reliable"
    assert "keep_last" in HistoryPolicy.short_keys()
    assert QoSProfile(depth=3) == QoSProfile(depth=3)
    assert "depth=3" in repr(QoSProfile(depth=3))
    with pytest.raises(InvalidQoSProfileException, match="required"):
        QoSProfile()
    with pytest.raises(InvalidQoSProfileException, match="without a depth"):
        QoSProfile(history=HistoryPolicy.KEEP_LAST)
    with pytest.raises(TypeError, match="no setting 'size'"):
        QoSProfile(size=3)
    with pytest.raises(ValueError, match="depth"):
        QoSProfile(depth=-1)


def test_a_depth_must_be_a_number(node):
    from std_msgs.msg import String

    with pytest.raises(TypeError, match="Expected QoSProfile or int"):
        node.create_publisher(String, "a", "10")


# Threads of the user's own


def test_a_nodes_own_thread_takes_turns_too(ros_runtime, tmp_path):
    file = tmp_path / "threaded.py"
    file.write_text(
        """
import threading
import time

import rclpy
from std_msgs.msg import Float64

rclpy.init()
node = rclpy.create_node('threaded')
thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
thread.start()
out = node.create_publisher(Float64, 'times', 10)
begin = time.time()
for _ in range(3):
    time.sleep(0.5)
    out.publish(Float64(data=time.time() - begin))
node.create_timer(0.25, rclpy.shutdown)
thread.join()
out.publish(Float64(data=time.monotonic()))
assert not thread.is_alive()
"""
    )
    from std_msgs.msg import Float64

    heard = []
    ros_runtime.world.topic("times", Float64).subscribe(lambda m: heard.append(m.data))
    program = ros_runtime.start(file)
    ros_runtime.sleep(5)

    assert heard[:3] == [0.5, 1.0, 1.5]
    assert heard[3] == pytest.approx(1.75, abs=0.002)
    assert program.status == 0


def test_what_a_thread_raises_is_said_and_ends_it_alone(ros_runtime, tmp_path):
    file = tmp_path / "threaded.py"
    file.write_text(
        "import threading\n"
        "def work():\n"
        "    raise ValueError('too far')\n"
        "thread = threading.Thread(target=work, name='worker')\n"
        "thread.start()\n"
        "thread.join()\n"
    )
    program = ros_runtime.start(file)
    ros_runtime.sleep(1)

    (said,) = ros_runtime.log(program.name)
    assert said.startswith("thread 'worker' failed: ValueError: too far\n")
    assert "threaded.py:3, in work: raise ValueError('too far')" in said
    assert program.status == 0


def test_arguments_without_those_of_ros_can_be_had(ros_runtime):
    from rclpy.utilities import (
        get_rmw_implementation_identifier,
        remove_ros_args,
        timeout_sec_to_nsec,
    )

    assert remove_ros_args(["a", "--ros-args", "-r", "x:=y"]) == ["a"]
    assert timeout_sec_to_nsec(1.5) == 1_500_000_000
    assert timeout_sec_to_nsec(None) == -1
    assert get_rmw_implementation_identifier() == "tftool"


def test_a_context_of_ones_own_begins_and_ends(ros_runtime):
    import rclpy
    from rclpy.context import Context

    with Context() as context:
        assert context.ok()
        assert context.get_domain_id() == 0
        rclpy.create_node("inside", context=context)
    assert not context.ok()
    with rclpy.init(args=["x", "--ros-args", "-p", "n:=3"]):
        assert rclpy.create_node("a").declare_parameter("n", 1).value == 3


def test_a_task_can_be_given_up(ros_runtime):
    from tftool.ros.client.futures import Future, Task

    waited = Future()

    async def wait():
        await waited

    task = Task(wait)
    assert task() is waited
    task.cancel()
    assert task.cancelled()
    assert task() is None


def test_a_service_that_goes_answers_with_a_sentence(node, ros_runtime):
    import rclpy
    from std_srvs.srv import Trigger

    service = node.create_service(Trigger, "go", lambda request, response: response)
    asker = rclpy.create_node("asker")
    client = asker.create_client(Trigger, "go")
    future = client.call_async(Trigger.Request())
    ros_runtime.sleep(0.1)
    service.destroy()
    rclpy.spin_until_future_complete(asker, future, timeout_sec=1.0)

    with pytest.raises(Exception, match="the node that served 'go' has left"):
        future.result()
    other = client.call_async(Trigger.Request())
    client.remove_pending_request(other)
    assert other.cancelled()


def test_the_simulators_services_take_ros_requests(node, ros_runtime):
    from std_srvs.srv import Empty
    from turtlesim.srv import Kill, SetPen, Spawn, TeleportAbsolute, TeleportRelative

    from tftool.nodes.turtlesim import Turtlesim

    ros_runtime.ask(lambda: Turtlesim(ros_runtime.world))

    def ask(kind, service, **fields):
        client = node.create_client(kind, service)
        assert client.wait_for_service(timeout_sec=1.0)
        return client.call(kind.Request(**fields), timeout_sec=1.0)

    assert ask(Spawn, "spawn", x=1.0, y=2.0).name == "turtle2"
    assert ask(TeleportAbsolute, "turtle2/teleport_absolute", x=3.0, y=4.0) is not None
    assert ask(TeleportRelative, "turtle2/teleport_relative", linear=1.0) is not None
    assert ask(SetPen, "turtle2/set_pen", r=255, width=5) is not None
    ros_runtime.sleep(0.1)
    turtle = ros_runtime.world.node("turtlesim").turtles["turtle2"]
    assert tuple(turtle.place)[:2] == pytest.approx((4.0, 4.0))
    assert ask(Kill, "kill", name="turtle2") is not None
    assert ask(Empty, "clear") is not None
    assert ask(Empty, "reset") is not None
    assert list(ros_runtime.world.node("turtlesim").turtles) == ["turtle1"]


def test_points_travel_as_our_own_nodes_send_them(node, ros_runtime):
    from geometry_msgs.msg import PointStamped as RosPoint

    from tftool.messages import PointStamped

    heard = []
    node.create_subscription(RosPoint, "points", heard.append, 1)
    ros_runtime.ask(
        lambda: ros_runtime.world.topic("points", PointStamped).publish(
            PointStamped(1_500_000_000, "world", 1.0, 2.0, 3.0)
        )
    )
    spin(node, 0.1)

    assert heard[0].header.stamp.nanosec == 500_000_000
    assert (heard[0].header.frame_id, heard[0].point.z) == ("world", 3.0)


def test_an_event_lets_a_callback_wait_for_an_answer_in_another_thread(ros_runtime, tmp_path):
    file = tmp_path / "waiter.py"
    file.write_text(
        """
from threading import Event

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from std_srvs.srv import Trigger

rclpy.init()
node = rclpy.create_node('waiter')
group = ReentrantCallbackGroup()


def answer(request, response):
    response.message = 'here'
    return response


node.create_service(Trigger, 'go', answer, callback_group=group)
client = node.create_client(Trigger, 'go', callback_group=group)


def ask():
    timer.cancel()
    event = Event()
    future = client.call_async(Trigger.Request())
    future.add_done_callback(lambda _: event.set())
    assert not event.is_set()
    event.wait(5.0)
    node.get_logger().info(future.result().message)
    event.clear()
    node.get_logger().info(str(event.wait(timeout=1.0)))


timer = node.create_timer(0.5, ask, callback_group=group)
executor = MultiThreadedExecutor()
executor.add_node(node)
executor.spin()
"""
    )
    ros_runtime.start(file)
    ros_runtime.sleep(3)

    assert ros_runtime.log("waiter") == ["here", "False"]


def test_a_log_level_asked_for_on_the_command_line_holds(ros_runtime):
    import rclpy

    rclpy.init()
    node = rclpy.create_node("probe", cli_args=["--ros-args", "--log-level", "debug"])
    node.get_logger().debug("heard")

    assert ros_runtime.log("probe") == ["heard"]


def test_a_pool_may_ask_and_log_but_not_wait_on_simulated_time(node, ros_runtime):
    from concurrent.futures import ThreadPoolExecutor

    from tftool.errors import TftoolError

    with ThreadPoolExecutor() as pool:
        assert pool.submit(node.get_topic_names_and_types).result()
        pool.submit(node.get_logger().info, "from the pool").result()
        with pytest.raises(TftoolError, match="thread of a pool cannot wait"):
            pool.submit(node.wait_for_node, "probe", 1.0).result()

    assert ros_runtime.log("probe") == ["from the pool"]
